//! How each integrator makes a step: one row each, coefficients included.
//!
//! Its name, order and cost stand with [`Integrator`], which every room knows. A further one is a
//! name there and a row here, which the compiler then asks for; the tests of order, stability and
//! energy take it in by themselves. Only one that is neither a composition nor a Runge-Kutta method
//! needs a [`Stepper`] of its own as well.
//!
//! The paper prints v = (a - `a_previous`) dt, which gives zero under constant acceleration; its
//! scheme is read as v += a dt, x += v dt.
//!
//! One that is stable for omega h up to c may take steps of c / omega, with the bound of omega from
//! [`frequency`](crate::models::paper::eye::frequency); each c is where the spectral radius of one
//! step of the oscillator passes 1 (a test scans it). Drag adds three conditions:
//!
//! * Semi-implicit Euler with its explicit drag of rate g needs (omega h)^2 + 2 g h <= 4.
//! * Drag that is the same everywhere never lowers the limit of a composition. Drag that differs
//!   between tissues can, because negative sub-steps amplify by up to exp(0.6 g h); g h is kept
//!   below 2, and for the Runge-Kutta methods within their interval on the real axis.
//! * Without drag the high-order compositions have hair-thin gaps far below their limit, which
//!   grow by at most 2.4e-3 a step. Any drag above g h = 0.005 closes them; below that the step
//!   stays under the first gap.
//!
//! Sources: S. Blanes and P. C. Moan, J. Comput. Appl. Math. 142 (2002) 313-330; J. R. Dormand and
//! P. J. Prince, J. Comput. Appl. Math. 6 (1980) 19-26.

use crate::models::paper::time::runge_kutta::{RungeKutta, Tableau};
use crate::models::paper::time::stepper::{Drag, Stepper};
use crate::models::paper::{forces::system::System, time::composition::Composition};
use crate::run::plan::Plan;
use crate::scenario::Integrator;

/// Drag rate times step that closes the gaps.
const CLOSING_DRAG: f64 = 0.005;
/// Largest drag rate times step.
const MAX_DRAG: f64 = 2.0;

/// How an integrator makes a step, and up to which it is stable.
#[derive(Debug)]
pub struct Method {
    /// Largest stable angular frequency times step with a little drag; a test scans it.
    pub stability_limit: f64,
    /// Where an undamped oscillator first grows, if that is a gap below the limit.
    pub first_gap: Option<f64>,
    /// How drag is treated.
    pub drag: Drag,
    /// How a step is made.
    pub(crate) scheme: MethodKind,
}

/// How a step is made.
#[derive(Debug)]
pub(crate) enum MethodKind {
    /// Kicks and drifts in turn, in shares of the step; the kicks are one more than the drifts.
    Composition { kicks: &'static [f64], drifts: &'static [f64] },
    /// An explicit Runge-Kutta method.
    RungeKutta(Tableau),
}

impl Method {
    /// How an integrator makes a step.
    pub fn of(integrator: Integrator) -> &'static Self {
        match integrator {
            Integrator::SemiImplicitEuler => &SEMI_IMPLICIT_EULER,
            Integrator::VelocityVerlet => &VELOCITY_VERLET,
            Integrator::Srkn6b => &SRKN6B,
            Integrator::Srkn11b => &SRKN11B,
            Integrator::Rk4 => &RK4,
            Integrator::Dopri5 => &DOPRI5,
        }
    }

    /// Largest step in s for which it is stable on `system` whatever its shape.
    pub(crate) fn step_limit(&self, system: &System) -> f64 {
        // An eye without stiffness has no limit; it must still be seen to move.
        let omega = system.omega_bound.max(1.0);
        let most = system.decay[0].max(system.decay[1]);
        let least = system.decay[0].min(system.decay[1]);
        if self.drag == Drag::WithKick {
            // Root of (omega h)^2 + 2 g h = 4, in the form that does not cancel.
            return 4.0 / (most + (most * most + 4.0 * omega * omega).sqrt());
        }
        let by_stiffness = self.stability_limit / omega;
        let open = least * by_stiffness < CLOSING_DRAG;
        let stable = match self.first_gap {
            Some(gap) if open => gap / omega,
            _ => by_stiffness,
        };
        // Verlet's sub-steps never amplify, but a speed must not vanish within one.
        stable.min(MAX_DRAG / most.max(f64::MIN_POSITIVE))
    }

    /// A stepper for `system` by this method.
    pub(crate) fn stepper<'a>(
        &'static self,
        system: &'a System,
        plan: &Plan,
    ) -> Box<dyn Stepper + 'a> {
        match &self.scheme {
            MethodKind::Composition { kicks, drifts } => {
                let (keep_before, stages) = ([1.0; 2], Vec::with_capacity(drifts.len()));
                let drag = self.drag;
                Box::new(Composition { system, kicks, drifts, drag, keep_before, stages })
            }
            MethodKind::RungeKutta(tableau) => Box::new(RungeKutta::new(system, tableau, plan)),
        }
    }
}

static SEMI_IMPLICIT_EULER: Method = Method {
    stability_limit: 2.0,
    first_gap: None,
    drag: Drag::WithKick,
    scheme: MethodKind::Composition { kicks: &[1.0, 0.0], drifts: &[1.0] },
};

static VELOCITY_VERLET: Method = Method {
    stability_limit: 2.0,
    first_gap: None,
    drag: Drag::Exact,
    scheme: MethodKind::Composition { kicks: &[0.5, 0.5], drifts: &[1.0] },
};

static SRKN6B: Method = Method {
    stability_limit: 5.026,
    first_gap: Some(3.163),
    drag: Drag::Exact,
    scheme: {
        const B: [f64; 3] =
            [0.082_984_406_417_405_2, 0.396_309_801_498_368, -0.039_056_304_922_348_6];
        const A: [f64; 2] = [0.245_298_957_184_271, 0.604_872_665_711_080];
        const B4: f64 = 1.0 - 2.0 * (B[0] + B[1] + B[2]);
        const A3: f64 = 0.5 - A[0] - A[1];
        MethodKind::Composition {
            kicks: &[B[0], B[1], B[2], B4, B[2], B[1], B[0]],
            drifts: &[A[0], A[1], A3, A3, A[1], A[0]],
        }
    },
};

static SRKN11B: Method = Method {
    stability_limit: 9.07,
    first_gap: Some(3.135),
    drag: Drag::Exact,
    scheme: {
        const B: [f64; 5] = [
            0.041_464_998_518_262_4,
            0.198_128_671_918_067,
            -0.040_006_192_104_153_3,
            0.075_253_984_301_580_7,
            -0.011_511_387_420_687_9,
        ];
        const A: [f64; 5] = [
            0.123_229_775_946_271,
            0.290_553_797_799_558,
            -0.127_049_212_625_417,
            -0.246_331_761_062_075,
            0.357_208_872_795_928,
        ];
        const B6: f64 = 0.5 - (B[0] + B[1] + B[2] + B[3] + B[4]);
        const A6: f64 = 1.0 - 2.0 * (A[0] + A[1] + A[2] + A[3] + A[4]);
        MethodKind::Composition {
            kicks: &[B[0], B[1], B[2], B[3], B[4], B6, B6, B[4], B[3], B[2], B[1], B[0]],
            drifts: &[A[0], A[1], A[2], A[3], A[4], A6, A[4], A[3], A[2], A[1], A[0]],
        }
    },
};

static RK4: Method = Method {
    stability_limit: 2.828,
    first_gap: None,
    drag: Drag::InRates,
    scheme: MethodKind::RungeKutta(Tableau {
        nodes: &[0.0, 0.5, 0.5, 1.0, 1.0],
        stages: &[
            &[],
            &[0.5],
            &[0.0, 0.5],
            &[0.0, 0.0, 1.0],
            &[1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0],
        ],
        error: &[],
    }),
};

static DOPRI5: Method = Method {
    stability_limit: 0.997,
    first_gap: None,
    drag: Drag::InRates,
    scheme: MethodKind::RungeKutta(Tableau {
        nodes: &[0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0, 1.0],
        stages: &[
            &[],
            &[0.2],
            &[3.0 / 40.0, 9.0 / 40.0],
            &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
            &[19372.0 / 6561.0, -25360.0 / 2187.0, 64448.0 / 6561.0, -212.0 / 729.0],
            &[9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0],
            &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0],
        ],
        error: &[
            71.0 / 57600.0,
            0.0,
            -71.0 / 16695.0,
            71.0 / 1920.0,
            -17253.0 / 339_200.0,
            22.0 / 525.0,
            -1.0 / 40.0,
        ],
    }),
};

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shares_add_up_and_the_cost_is_that_of_the_scheme() {
        for integrator in Integrator::ALL {
            let (row, name) = (Method::of(*integrator), integrator.name());
            let (evaluations, chooses) = match &row.scheme {
                MethodKind::Composition { drifts, .. } => (drifts.len(), false),
                MethodKind::RungeKutta(tableau) => {
                    (tableau.evaluations(), !tableau.error.is_empty())
                }
            };
            assert_eq!(integrator.evaluations(), evaluations, "{name}");
            assert_eq!(integrator.chooses_its_steps(), chooses, "{name}");
            let whole = |shares: &[f64]| (shares.iter().sum::<f64>() - 1.0).abs() < 1e-14;
            match &row.scheme {
                MethodKind::Composition { kicks, drifts } => {
                    assert_eq!(kicks.len(), drifts.len() + 1);
                    assert!(whole(kicks) && whole(drifts), "{name}");
                }
                MethodKind::RungeKutta(tableau) => {
                    assert_eq!(tableau.nodes.len(), tableau.stages.len());
                    assert_eq!(tableau.nodes.last(), Some(&1.0));
                    for (node, stage) in tableau.nodes.iter().zip(tableau.stages) {
                        assert!((stage.iter().sum::<f64>() - node).abs() < 1e-13);
                    }
                }
            }
        }
    }
}
