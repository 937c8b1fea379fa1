//! Integrators: kick-drift compositions with the drag solved exactly inside the drift.
//!
//! The motion m a = F(x, t) - c v splits into a kick, v += F/m dt at fixed x, and a drift, which
//! is exact: v decays by exp(-c/m dt) and x moves by v (1 - exp(-c/m dt)) m/c. A symmetric
//! composition kick b1, drift a1, kick b2, ... has even order. The last kick of a step and the
//! first of the next share one force evaluation.
//!
//! | name | kicks a step | order | stable for omega h up to |
//! |---|---|---|---|
//! | semi-implicit Euler, drag explicit (the paper) | 1 | 1 | 2 (less with drag) |
//! | velocity Verlet | 1 | 2 | 2 |
//! | `SRKN6b` (Blanes and Moan 2002) | 6 | 4 | 5.026 |
//! | `SRKN11b` (Blanes and Moan 2002) | 11 | 6 | 9.07 |
//! | RK4, drag explicit | 4 | 4 | 2.828 |
//! | Dormand-Prince 5(4), adaptive, drag explicit | 6 | 5 | 0.997 |
//!
//! See [`super::stability`] for what the limits mean and for the gaps below them.
//!
//! S. Blanes and P. C. Moan, J. Comput. Appl. Math. 142 (2002) 313-330. Their Runge-Kutta-Nystrom
//! conditions hold with linear drag in the drift, because the kick depends on positions alone.
//!
//! The paper prints v = (a - `a_previous`) dt, which gives zero under constant acceleration; its
//! scheme is read as v += a dt, x += v dt.

use super::kernel::{self, Stage, Survey};
use super::load::{Piece, Segment};
use super::runge_kutta::{DOPRI5, RK4, RungeKutta};
use super::state::State;
use super::system::System;

/// A method that moves the eye through time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Integrator {
    /// The paper's: v += a dt, x += v dt, with explicit drag.
    SemiImplicitEuler,
    /// Half kick, drift with exact drag, half kick.
    VelocityVerlet,
    /// Six-stage composition of order four.
    Srkn6b,
    /// Eleven-stage composition of order six.
    Srkn11b,
    /// The classical method.
    Rk4,
    /// The Dormand-Prince pair, which chooses its own steps.
    Dopri5,
}

/// Coefficients of a symmetric composition; the kicks are one more than the drifts.
struct Coefficients {
    kicks: &'static [f64],
    drifts: &'static [f64],
}

const VERLET: Coefficients = Coefficients {
    kicks: &[0.5, 0.5],
    drifts: &[1.0],
};

const SRKN6B: Coefficients = {
    const B: [f64; 3] = [
        0.082_984_406_417_405_2,
        0.396_309_801_498_368,
        -0.039_056_304_922_348_6,
    ];
    const A: [f64; 2] = [0.245_298_957_184_271, 0.604_872_665_711_080];
    const B4: f64 = 1.0 - 2.0 * (B[0] + B[1] + B[2]);
    const A3: f64 = 0.5 - A[0] - A[1];
    Coefficients {
        kicks: &[B[0], B[1], B[2], B4, B[2], B[1], B[0]],
        drifts: &[A[0], A[1], A3, A3, A[1], A[0]],
    }
};

const SRKN11B: Coefficients = {
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
    Coefficients {
        kicks: &[
            B[0], B[1], B[2], B[3], B[4], B6, B6, B[4], B[3], B[2], B[1], B[0],
        ],
        drifts: &[
            A[0], A[1], A[2], A[3], A[4], A6, A[4], A[3], A[2], A[1], A[0],
        ],
    }
};

impl Integrator {
    /// All integrators.
    pub const ALL: [Self; 6] = [
        Self::SemiImplicitEuler,
        Self::VelocityVerlet,
        Self::Srkn6b,
        Self::Srkn11b,
        Self::Rk4,
        Self::Dopri5,
    ];

    /// Name as typed on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::SemiImplicitEuler => "semi-implicit-euler",
            Self::VelocityVerlet => "velocity-verlet",
            Self::Srkn6b => "srkn6b",
            Self::Srkn11b => "srkn11b",
            Self::Rk4 => "rk4",
            Self::Dopri5 => "dopri5",
        }
    }

    /// Whether it chooses its own steps.
    pub fn adaptive(self) -> bool {
        self == Self::Dopri5
    }

    /// Order of convergence.
    pub fn order(self) -> i32 {
        match self {
            Self::SemiImplicitEuler => 1,
            Self::VelocityVerlet => 2,
            Self::Srkn6b | Self::Rk4 => 4,
            Self::Dopri5 => 5,
            Self::Srkn11b => 6,
        }
    }

    /// Force evaluations a step.
    pub fn evaluations_per_step(self) -> usize {
        match self {
            Self::SemiImplicitEuler | Self::VelocityVerlet => 1,
            Self::Rk4 => 4,
            Self::Srkn6b | Self::Dopri5 => 6,
            Self::Srkn11b => 11,
        }
    }

    /// Omega times step where an undamped oscillator first grows, if that is a gap below the limit.
    pub fn first_gap(self) -> Option<f64> {
        match self {
            Self::Srkn6b => Some(3.163),
            Self::Srkn11b => Some(3.135),
            _ => None,
        }
    }

    /// Largest stable omega times step with a little drag.
    pub fn stability_limit(self) -> f64 {
        match self {
            Self::SemiImplicitEuler | Self::VelocityVerlet => 2.0,
            Self::Srkn6b => 5.026,
            Self::Srkn11b => 9.07,
            Self::Rk4 => 2.828,
            Self::Dopri5 => 0.997,
        }
    }
}

/// One integrator at one step length, ready to be applied.
pub trait Stepper {
    /// Moves `state`, whose acceleration is up to date, by one step under the load law `piece`,
    /// not past the end of the segment it was prepared for.
    fn step(&mut self, system: &System, state: &mut State, piece: Piece) -> Survey;

    /// Force evaluations made so far.
    fn evaluations(&self) -> usize;
}

/// A composition at one step length.
struct Composition {
    step: f64,
    evaluations: usize,
    /// Share of the speed kept by an explicit drag ahead of the first kick.
    keep_before: [f64; 2],
    stages: Vec<Stage>,
    /// Time of each kick from the start of the step.
    times: Vec<f64>,
    last_kick: f64,
}

impl Composition {
    fn new(coefficients: &Coefficients, decay: [f64; 2], h: f64) -> Self {
        let mut time = 0.0;
        let mut times = Vec::new();
        let stages = coefficients
            .kicks
            .iter()
            .zip(coefficients.drifts)
            .map(|(b, a)| {
                times.push(time);
                time += a * h;
                Stage {
                    kick: b * h,
                    drift: decay.map(|rate| exact_reach(rate, a * h)),
                    keep: decay.map(|rate| (-rate * a * h).exp()),
                }
            })
            .collect();
        Self {
            step: h,
            evaluations: 0,
            keep_before: [1.0, 1.0],
            stages,
            times,
            last_kick: coefficients.kicks[coefficients.drifts.len()] * h,
        }
    }

    fn semi_implicit_euler(decay: [f64; 2], h: f64) -> Self {
        Self {
            step: h,
            evaluations: 0,
            keep_before: decay.map(|rate| 1.0 - rate * h),
            stages: vec![Stage {
                kick: h,
                drift: [h, h],
                keep: [1.0, 1.0],
            }],
            times: vec![0.0],
            last_kick: 0.0,
        }
    }
}

/// Distance per initial speed when the speed decays at `rate` for `t` seconds.
fn exact_reach(rate: f64, t: f64) -> f64 {
    if rate == 0.0 {
        t
    } else {
        -(-rate * t).exp_m1() / rate
    }
}

impl Stepper for Composition {
    fn step(&mut self, system: &System, state: &mut State, piece: Piece) -> Survey {
        let pulse = system.load().pulse;
        let start = state.time;
        let mut speed = state.load_speed(system);
        for (i, (stage, time)) in self.stages.iter().zip(&self.times).enumerate() {
            let force = pulse.force(piece, start + time);
            let lost = if i == 0 {
                kernel::start(system, state, self.keep_before, *stage)
            } else {
                kernel::kick_drift(system, state, force, *stage)
            };
            state.dissipated += lost;
            // The load acts on the globe only, so one factor takes the drift's decay back out.
            let after = state.load_speed(system);
            state.work += stage.kick * force * 0.5 * (speed + after / stage.keep[0]);
            speed = after;
        }
        let end = start + self.step;
        let force = pulse.force(piece, end);
        let survey = kernel::evaluate(system, state, force, self.last_kick);
        let after = state.load_speed(system);
        state.work += self.last_kick * force * 0.5 * (speed + after);
        state.time = end;
        self.evaluations += self.stages.len();
        survey
    }

    fn evaluations(&self) -> usize {
        self.evaluations
    }
}

/// Prepares `integrator` for a segment in `steps` steps, or, if it chooses its own, for steps no
/// longer than these whose local error stays below `tolerance`.
pub(super) fn stepper(
    integrator: Integrator,
    system: &System,
    segment: Segment,
    steps: usize,
    tolerance: f64,
) -> Box<dyn Stepper> {
    let h = (segment.end - segment.start) / steps as f64;
    let composition = |coefficients| Box::new(Composition::new(coefficients, system.decay, h));
    match integrator {
        Integrator::SemiImplicitEuler => {
            Box::new(Composition::semi_implicit_euler(system.decay, h))
        }
        Integrator::VelocityVerlet => composition(&VERLET),
        Integrator::Srkn6b => composition(&SRKN6B),
        Integrator::Srkn11b => composition(&SRKN11B),
        Integrator::Rk4 => Box::new(RungeKutta::new(&RK4, system, segment, steps, None)),
        Integrator::Dopri5 => Box::new(RungeKutta::new(
            &DOPRI5,
            system,
            segment,
            steps,
            Some(tolerance),
        )),
    }
}
