//! The other directions that a blow may have come from, run beside the one that is shown.
//!
//! Where nobody knows it, those are the rest of [`AS_HITS_COME`]; where a person doubts an angle,
//! an offset or an hour, two to each side of the value, so far out that all directions, equally
//! likely, have the spread that was given. They have the step error of the one that is shown.

use crate::answer::compiled::Compiled;
use crate::injury::{Felt, Injury, PerInjury};
use crate::run::{kept::Keep, ordered, ordered::until, refusal::Refusal};
use crate::run::{threads::beside, watch::Watch};
use crate::scenario::direction::{AS_HITS_COME, Directions};
use crate::scenario::{Scenario, doubt, fields, set};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Duration;

/// How often the watch is asked.
const LOOK_EVERY: Duration = Duration::from_millis(5);
/// Fields of a direction that a person may doubt.
const DOUBTED: [&str; 4] =
    ["impact.angle_deg", "impact.offset_mm", "impact.angle_clock", "impact.offset_clock"];

/// The scenario from each of the other directions that its blow may have come from.
pub fn other_scenarios(scenario: &Scenario) -> Vec<Scenario> {
    let Some(object) = scenario.projectile() else { return Vec::new() };
    if object.directions == Directions::NotKnown {
        let side = scenario.eye_side();
        let turned = |direction: &[f64; 4]| {
            let mut turned = scenario.clone();
            let object = turned.projectile_mut()?;
            object.directions = Directions::AsGiven;
            object.turn_to(side, *direction);
            Some(turned)
        };
        return AS_HITS_COME[1..].iter().filter_map(turned).collect();
    }
    let doubted: Vec<(&fields::Field, f64)> = DOUBTED
        .iter()
        .filter_map(|path| {
            let sd = scenario.doubt.get(*path).copied().filter(|sd| *sd > 0.0)?;
            Some((fields::find(path)?, sd))
        })
        .collect();
    let far = (doubted.len() as f64 + 0.5).sqrt();
    let moved = |(field, sd): &(&fields::Field, f64), sign: f64| {
        let (value, bounds) = doubt::number(field, scenario)?;
        let to = value + sign * far * sd;
        let to = if field.unit == "h" {
            to.rem_euclid(bounds.max)
        } else if field.path == DOUBTED[0] {
            to.clamp(bounds.min, bounds.max)
        } else {
            to.clamp(-bounds.max, bounds.max)
        };
        let mut moved = scenario.clone();
        moved.doubt.retain(|path, _| !DOUBTED.contains(&path.as_str()));
        set::put_number(&mut moved, field, to);
        Some(moved)
    };
    doubted.iter().flat_map(|of| [moved(of, -1.0), moved(of, 1.0)]).flatten().collect()
}

/// What tissues feel of each of them, on all cores. What goes through the eye hurts all of it.
///
/// # Errors
/// [`Refusal::Cancelled`] if the watch stopped it.
pub fn other_directions(scenario: &Scenario, watch: Watch) -> Result<Vec<Felt>, Refusal> {
    let others = other_scenarios(scenario);
    if others.is_empty() {
        return Ok(Vec::new());
    }
    let (stop, done) = (AtomicBool::new(false), AtomicUsize::new(0));
    let count = others.len();
    let run = |i: usize| match felt(&others[i], &stop) {
        Err(Refusal::Cancelled) => None,
        felt => Some(felt.ok().flatten()),
    };
    let mut all = Vec::new();
    let work = || {
        ordered::run((0, count), &stop, run, |_, felt: Option<Felt>| {
            all.push(felt);
            done.store(all.len(), Ordering::Relaxed);
            ControlFlow::Continue(())
        });
        done.store(count, Ordering::Relaxed);
    };
    beside(work, || {
        loop {
            let share = done.load(Ordering::Relaxed) as f64 / count as f64;
            if share >= 1.0 {
                return;
            }
            if watch(share).is_break() {
                return stop.store(true, Ordering::Relaxed);
            }
            std::thread::sleep(LOOK_EVERY);
        }
    });
    if all.len() < count {
        Err(Refusal::Cancelled)
    } else {
        Ok(all.into_iter().flatten().collect())
    }
}

fn felt(scenario: &Scenario, stop: &AtomicBool) -> Result<Option<Felt>, Refusal> {
    let checked = scenario.check()?;
    let case = Compiled::new(&checked);
    let plan = case.plan(&checked)?;
    match case.run(&plan, Keep::default(), &mut until(stop)) {
        Ok(run) => Ok(case.felt(&run)),
        Err(Refusal::Cancelled) => Err(Refusal::Cancelled),
        Err(_) => Ok(case.blow.map(|blow| Felt {
            measures: [f64::INFINITY; Injury::ALL.len()],
            errors: PerInjury::default(),
            way_in: blow.way_in,
            weight: 1.0,
        })),
    }
}
