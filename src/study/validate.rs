//! Every published experiment run again, and what was read beside what was measured.
//!
//! Left out: judgement. A row that misses stays in the table with its ratio.

use super::case::{Case, Refusal, unwatched};
use super::experiments::{EXPERIMENTS, Experiment, Reading};
use super::flags::FlagKind;
use super::solve::{Answer, solve};
use crate::eye::Eye;
use crate::recording::{Keep, Recording, Spacing};
use crate::scenario::{Model, Scenario};
use rayon::prelude::*;

/// Time between frames that the shortening is read from, in s.
const FRAMES: f64 = 20e-6;

/// One experiment, run.
#[derive(Debug, Clone)]
pub struct Row {
    /// The published experiment.
    pub experiment: &'static Experiment,
    /// What the model gives, SI, or why it gives nothing.
    pub predicted: Result<f64, String>,
    /// What the next finer mesh gives, SI.
    pub finer: Option<f64>,
    /// Step error of the leading results, in %.
    pub step_error: Option<f64>,
    /// What limits the result.
    pub flags: Vec<FlagKind>,
}

impl Row {
    /// Predicted over measured.
    pub fn ratio(&self) -> Option<f64> {
        let predicted = self.predicted.as_ref().ok()?;
        Some(predicted / self.experiment.measured.typical())
    }

    /// Whether that of the next finer mesh does.
    pub fn finer_inside(&self) -> Option<bool> {
        Some(self.experiment.measured.holds(self.finer?))
    }

    /// Whether the prediction lies where the measurement says.
    pub fn inside(&self) -> bool {
        self.predicted
            .as_ref()
            .is_ok_and(|value| self.experiment.measured.holds(*value))
    }
}

/// Runs every experiment, with its fitted model unless `change` gives it another.
pub fn validate(change: impl Fn(Scenario) -> Scenario + Sync) -> Vec<Row> {
    rows_of(EXPERIMENTS.iter(), change)
}

fn keep(experiments: &[&Experiment]) -> Keep {
    let frames = experiments.iter().any(|e| e.reading == Reading::Shortening);
    Keep {
        traces: true,
        frames: frames.then_some(Spacing::even(FRAMES)),
    }
}

/// Experiments that share a scenario, each with its place in the list.
fn by_scenario(
    experiments: impl Iterator<Item = &'static Experiment>,
) -> Vec<(Scenario, Vec<(usize, &'static Experiment)>)> {
    let mut groups: Vec<(Scenario, Vec<_>)> = Vec::new();
    for (place, experiment) in experiments.enumerate() {
        let scenario = (experiment.scenario)();
        match groups.iter_mut().find(|(known, _)| *known == scenario) {
            Some((_, members)) => members.push((place, experiment)),
            None => groups.push((scenario, vec![(place, experiment)])),
        }
    }
    groups
}

/// Runs each scenario once, with its step error and flags, in the order of `experiments`.
pub(super) fn rows_of(
    experiments: impl Iterator<Item = &'static Experiment>,
    change: impl Fn(Scenario) -> Scenario + Sync,
) -> Vec<Row> {
    let mut rows: Vec<(usize, Row)> = by_scenario(experiments)
        .into_par_iter()
        .flat_map_iter(|(scenario, members)| {
            let scenario = change(scenario);
            let asked: Vec<_> = members.iter().map(|m| m.1).collect();
            let answer = scenario
                .check()
                .map_err(Refusal::Scenario)
                .and_then(|scenario| solve(&scenario, keep(&asked), &mut unwatched));
            let finer = finer(&scenario, keep(&asked));
            members.into_iter().map(move |(place, experiment)| {
                let row = match &answer {
                    Ok(answer) => Row {
                        experiment,
                        predicted: read_of(experiment.reading, answer)
                            .ok_or_else(|| "the run does not reach it".to_owned()),
                        finer: finer
                            .as_ref()
                            .and_then(|(eye, recording)| read(experiment.reading, eye, recording)),
                        step_error: Some(answer.errors.time_step_percent()),
                        flags: answer.flags.iter().map(|f| f.kind).collect(),
                    },
                    Err(refusal) => Row {
                        experiment,
                        predicted: Err(refusal.to_string()),
                        finer: None,
                        step_error: None,
                        flags: Vec::new(),
                    },
                };
                (place, row)
            })
        })
        .collect();
    rows.sort_by_key(|(place, _)| *place);
    rows.into_iter().map(|(_, row)| row).collect()
}

/// What is read of each experiment by a single run, without errors and flags; `None` where there is
/// nothing to read.
pub(super) fn readings(
    experiments: impl Iterator<Item = &'static Experiment>,
    change: impl Fn(Scenario) -> Scenario,
) -> Vec<Option<f64>> {
    let groups = by_scenario(experiments);
    let mut found = vec![None; groups.iter().map(|g| g.1.len()).sum()];
    for (scenario, members) in groups {
        let asked: Vec<_> = members.iter().map(|m| m.1).collect();
        let Ok((eye, recording)) = single(&change(scenario), keep(&asked)) else {
            continue;
        };
        for (place, experiment) in members {
            found[place] = read(experiment.reading, &eye, &recording);
        }
    }
    found
}

/// What is read of an answer.
fn read_of(reading: Reading, answer: &Answer) -> Option<f64> {
    let recording = Recording {
        extremes: *answer.left.section()?,
        traces: answer.traces.clone(),
        frames: answer.frames.clone(),
    };
    read(reading, &answer.case.section()?.eye, &recording)
}

/// The same on the next finer mesh, if that runs.
fn finer(scenario: &Scenario, keep: Keep) -> Option<(Eye, Recording)> {
    let mut finer = scenario.clone();
    finer.eye.level += 1;
    single(&finer, keep).ok()
}

fn single(scenario: &Scenario, keep: Keep) -> Result<(Eye, Recording), Refusal> {
    let case = Case::new(&scenario.check()?);
    let mut plan = case.plan(scenario)?;
    // An answer takes a finer run as well; this one stands alone.
    plan.step *= 0.5;
    let solution = case.run(&plan, keep, &mut unwatched)?;
    Ok((case.eye, solution.recording))
}

/// Reads one figure, SI.
fn read(reading: Reading, eye: &Eye, recording: &Recording) -> Option<f64> {
    let extremes = &recording.extremes;
    let value = match reading {
        Reading::ForceAtTravel(travel) => {
            let traces = recording.traces.as_ref()?;
            let after = traces.apex.iter().position(|&x| x >= travel)?;
            let force = &traces.contact_force;
            if after == 0 {
                force[0]
            } else {
                let (x0, x1) = (traces.apex[after - 1], traces.apex[after]);
                let share = (travel - x0) / (x1 - x0);
                force[after - 1] + share * (force[after] - force[after - 1])
            }
        }
        Reading::PeakPressure => extremes.fluid?.pressure.value,
        Reading::FarthestArea => {
            let (least, most) = extremes.fluid?.area_ratio;
            if 1.0 - least > most - 1.0 {
                least
            } else {
                most
            }
        }
        Reading::Apex => extremes.apex.value,
        Reading::Widening => extremes.meridian_growth.value,
        Reading::TimeOfWidening => extremes.meridian_growth.time,
        Reading::Shortening => shortening(eye, recording)?,
    };
    value.is_finite().then_some(value)
}

/// Largest shortening between the corneal apex and the posterior pole, as a share of it.
fn shortening(eye: &Eye, recording: &Recording) -> Option<f64> {
    let marks = &eye.landmarks;
    // The two nodes of the apex and the two opposite them, a straddle of the axis each.
    let half = marks.shell.len() / 2;
    let opposite = marks.apex.map(|node| {
        let place = marks.shell.iter().position(|&n| n == node)?;
        Some(marks.shell[(place + half) % marks.shell.len()])
    });
    let (front, back) = (marks.apex, [opposite[0]?, opposite[1]?]);
    let length = |x: &dyn Fn(usize) -> f64| {
        let mean = |pair: [usize; 2]| 0.5 * (x(pair[0]) + x(pair[1]));
        mean(back) - mean(front)
    };
    let rest = length(&|node| eye.nodes[node].position.x);
    let shares = recording.frames.iter().map(|frame| {
        let now = length(&|node| frame.positions[node].x);
        1.0 - now / rest
    });
    Some(shares.fold(0.0, f64::max))
}

/// Whether an experiment's scenario has the model that was fitted.
pub fn uses_the_fit(experiment: &Experiment) -> bool {
    matches!((experiment.scenario)().model, Model::Physiological(_))
}
