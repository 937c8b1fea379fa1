//! A made-up measurement of total error against time, the same on every machine.

use contrecoup::answer::mesh_error::OnMesh;
use contrecoup::answer::results::Results;
use contrecoup::many::accuracy::Accuracy;
use contrecoup::many::accuracy::Trial;
use contrecoup::run::plan::LOCAL_TOLERANCE;
use contrecoup::run::plan::Plan;
use contrecoup::run::quantity::Quantity;
use contrecoup::run::rules::Element;
use contrecoup::scenario::Integrator;
use contrecoup::scenario::Scenario;

/// Method, step in us, time in ms, step error in %; all on level 1, finer ones take longer.
type Row = (Integrator, f64, f64, f64);

const ROWS: [Row; 8] = {
    use Integrator::{Rk4, SemiImplicitEuler, Srkn6b, Srkn11b, VelocityVerlet};
    [
        (Srkn6b, 4.0, 0.9, 0.04),
        (SemiImplicitEuler, 2.0, 0.35, 20.0),
        (SemiImplicitEuler, 0.5, 1.4, 5.0),
        (VelocityVerlet, 2.0, 0.4, 2.0),
        (VelocityVerlet, 1.0, 0.8, 0.5),
        (Srkn6b, 3.0, 1.8, 2.5e-3),
        (Srkn11b, 8.0, 1.4, 3e-3),
        (Rk4, 3.0, 1.5, 0.3),
    ]
};

/// Every result on levels 1, 2, 3, ...
const LEVELS: [f64; 5] = [26.0, 21.0, 19.0, 18.9, 18.85];
/// Levels that runs were made on.
const RUN: u32 = 3;

/// The same for every result of a scene that springs alone solve.
fn all(value: f64) -> Results {
    let absent = [Quantity::Contact, Quantity::Pressure];
    let there = |of: Quantity| !of.is_risk() && !absent.contains(&of);
    Results::from_fn(|of| there(of).then_some(value))
}

/// The measurement, with so many of its levels run.
pub fn made_up() -> Accuracy {
    let level = |value: &f64| OnMesh { results: all(*value), folded: None, elements: 1e6 };
    let run = |level: u32, place: usize| {
        let (integrator, step, time, error) = ROWS[place];
        let step = step * 1e-6 / f64::from(level);
        Trial {
            level,
            plan: Plan {
                integrator,
                step,
                window: 3e-3,
                multiple: 1.0,
                local_tolerance: LOCAL_TOLERANCE,
            },
            is_answer: place == 0,
            step,
            results: Some(all(LEVELS[level as usize - 1] * (1.0 + 0.01 * error))),
            elements: 1e6,
            times: vec![time * 1e-3 * f64::from(level.pow(3))],
        }
    };
    let places = |level| (0..ROWS.len()).map(move |place| run(level, place));
    Accuracy {
        scenario: Scenario::default(),
        element: Element::Spring,
        levels: LEVELS.iter().map(level).collect(),
        references: LEVELS.map(all)[..RUN as usize].to_vec(),
        trials: (1..=RUN).flat_map(places).collect(),
        done: 32,
        all: 32,
    }
}
