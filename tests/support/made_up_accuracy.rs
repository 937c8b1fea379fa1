//! A made-up measurement of speed against error, the same on every machine.

use contrecoup::dynamics::{Integrator, LOCAL_TOLERANCE, Plan};
use contrecoup::study::accuracy::{Accuracy, Level, Point};
use contrecoup::study::{Element, Quantity, Results};

/// Method, step in us, tolerance, time in ms, error in %, whether on the front.
type Row = (Integrator, f64, f64, f64, f64, bool);

const ROWS: [Row; 14] = {
    use Integrator::{Dopri5, Rk4, SemiImplicitEuler, Srkn6b, Srkn11b, VelocityVerlet};
    const T: f64 = LOCAL_TOLERANCE;
    [
        (SemiImplicitEuler, 2.0, T, 0.35, 20.0, true),
        (SemiImplicitEuler, 0.5, T, 1.4, 5.0, false),
        (SemiImplicitEuler, 0.1, T, 7.0, 1.0, false),
        (VelocityVerlet, 2.0, T, 0.4, 2.0, true),
        (VelocityVerlet, 1.0, T, 0.8, 0.5, true),
        (VelocityVerlet, 0.2, T, 4.0, 0.02, false),
        (Srkn6b, 6.0, T, 0.9, 0.04, true),
        (Srkn6b, 3.0, T, 1.8, 2.5e-3, true),
        (Srkn6b, 1.0, T, 5.4, 3e-5, false),
        (Srkn11b, 8.0, T, 1.4, 3e-3, true),
        (Srkn11b, 2.0, T, 5.0, 1e-6, true),
        (Rk4, 3.0, T, 1.5, 0.3, false),
        (Dopri5, 4.0, 1e-3, 2.0, 0.2, false),
        (Dopri5, 4.0, 1e-8, 12.0, 0.0, true),
    ]
};

/// The same error for every result of a scene that springs alone solve.
fn all(error: f64) -> Results {
    use Quantity::{Contact, Pressure, RetinaByEnergy, RuptureByEnergy, RuptureByPressure};
    let absent = [
        Contact,
        Pressure,
        RetinaByEnergy,
        RuptureByEnergy,
        RuptureByPressure,
    ];
    Results::from_fn(|of| (!absent.contains(&of)).then_some(error))
}

/// The measurement.
pub fn made_up() -> Accuracy {
    let plan = |integrator, step: f64, local_tolerance| Plan {
        integrator,
        step: step * 1e-6,
        window: 3e-3,
        multiple: 1.0,
        local_tolerance,
    };
    let point = |&(integrator, step, tolerance, time, error, on_front): &Row| {
        let mut errors = all(error / 10.0);
        errors[Quantity::Apex] = Some(error);
        let evaluations = (time * 2000.0) as usize;
        Point {
            plan: plan(integrator, step, tolerance),
            step: step * 1e-6,
            evaluations,
            element_evaluations: evaluations * 900,
            seconds: time * 1e-3,
            errors,
            on_front,
        }
    };
    let level = |level: u32, error| Level {
        level,
        seconds: 1e-3,
        element_evaluations: 1_000_000,
        results: all(1.0),
        errors: all(error),
        folded: false,
    };
    Accuracy {
        points: ROWS.iter().map(point).collect(),
        best: [Some(3), Some(4), Some(6), Some(9)],
        reference: plan(Integrator::Srkn11b, 0.5, LOCAL_TOLERANCE),
        reference_results: all(1.0),
        levels: vec![level(1, 12.0), level(2, 0.0)],
        ns_per_spring: Some(1.2),
        omega_bound: Some(1e6),
        element: Element::Spring,
        folded: false,
    }
}
