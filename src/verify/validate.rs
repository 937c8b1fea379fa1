//! Every published experiment run again on three neighbouring meshes, and what was read beside what was
//! measured.
//!
//! Left out: judgement. A row that misses stays in the table with its ratio.

use crate::answer::solve::{Answer, solve};
use crate::run::flags::FlagKind;
use crate::run::kept::Keep;
use crate::run::refusal::Refusal;
use crate::run::watch::unwatched;
use crate::scenario::{Model, Physiological, Scenario};
use crate::verify::experiments::{Band, EXPERIMENTS, Experiment, Reading};
use rayon::prelude::*;

/// How many meshes: that of the experiment and the next finer ones.
pub const MESHES: usize = 3;

/// Something on each mesh, or why there is nothing.
pub type OnEach<T, E = String> = [Result<T, E>; MESHES];

/// One experiment, run.
#[derive(Debug, Clone)]
pub struct Row {
    /// The published experiment.
    pub experiment: &'static Experiment,
    /// What the model gives, in the unit of the reading.
    pub predicted: OnEach<f64>,
    /// Of a fitted row the same with all moduli as published.
    pub published: Option<OnEach<f64>>,
    /// Largest step error of the leading results of the runs, in %.
    pub step_error: Option<f64>,
    /// What limits the results of any mesh.
    pub flags: Vec<FlagKind>,
}

impl Row {
    /// What is predicted on each mesh over what was measured.
    pub fn ratios(&self) -> [Option<f64>; MESHES] {
        let typical = self.experiment.measured.typical();
        let ratio = |value: &Result<f64, String>| Some(value.as_ref().ok()? / typical);
        self.predicted.each_ref().map(ratio)
    }

    /// Whether the prediction of each mesh lies where the measurement says.
    pub fn inside(&self) -> [bool; MESHES] {
        let measured = self.experiment.measured;
        let inside = |value: &Result<f64, String>| value.as_ref().is_ok_and(|v| measured.holds(*v));
        self.predicted.each_ref().map(inside)
    }

    /// Whether all do.
    pub fn is_met(&self) -> bool {
        self.inside() == [true; MESHES]
    }

    /// By which factor the farthest of them misses what agrees; 1 where all agree, none where a run gave
    /// nothing.
    pub fn miss(&self) -> Option<f64> {
        let (low, high) = self.experiment.measured.limits();
        let of = |value: &f64| (low / value).max(value / high).max(1.0);
        let each = self.predicted.iter().map(|p| p.as_ref().ok().map(of));
        each.reduce(|a, b| Some(a?.max(b?)))?
    }
}

/// Runs every experiment, with its own model unless `change` gives it another.
pub fn validate(change: impl Fn(Scenario) -> Scenario + Sync) -> Vec<Row> {
    rows_of(EXPERIMENTS.iter(), change)
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

/// Runs each scenario with its errors and flags, in the order of `experiments`.
pub(crate) fn rows_of(
    experiments: impl Iterator<Item = &'static Experiment>,
    change: impl Fn(Scenario) -> Scenario + Sync,
) -> Vec<Row> {
    let mut rows: Vec<(usize, Row)> = by_scenario(experiments)
        .into_par_iter()
        .flat_map_iter(|(scenario, members)| {
            let scenario = change(scenario);
            let fitted = members.iter().any(|(_, e)| e.fitted);
            let published = fitted.then(|| answers(&as_published(scenario.clone())));
            let answers = answers(&scenario);
            members.into_iter().map(move |(place, experiment)| {
                let read = |answers: &OnEach<Answer, Refusal>| {
                    answers.each_ref().map(|answer| read(experiment, answer))
                };
                let solved = || answers.iter().filter_map(|a| a.as_ref().ok());
                let mut flags: Vec<FlagKind> = Vec::new();
                for flag in solved().flat_map(|answer| &answer.flags) {
                    if !flags.contains(&flag.kind) && limits(experiment.reading, flag.kind) {
                        flags.push(flag.kind);
                    }
                }
                let row = Row {
                    experiment,
                    predicted: read(&answers),
                    published: published.as_ref().map(read),
                    step_error: solved()
                        .map(|answer| answer.errors.time_step_percent())
                        .reduce(f64::max),
                    flags,
                };
                (place, row)
            })
        })
        .collect();
    rows.sort_by_key(|(place, _)| *place);
    rows.into_iter().map(|(_, row)| row).collect()
}

/// What is read of each experiment on each mesh.
pub(crate) fn readings(
    experiments: impl Iterator<Item = &'static Experiment>,
    change: impl Fn(Scenario) -> Scenario,
) -> Vec<[Option<f64>; MESHES]> {
    experiments
        .map(|experiment| {
            answers(&change((experiment.scenario)())).map(|answer| read(experiment, &answer).ok())
        })
        .collect()
}

/// `scenario` with the published bulk modulus of fat.
fn as_published(mut scenario: Scenario) -> Scenario {
    if let Model::Physiological(model) = &mut scenario.model {
        model.fat_bulk_mpa = Physiological::PUBLISHED_FAT_BULK_MPA;
    }
    scenario
}

/// Answers of the scenario's own mesh and of the next finer ones.
fn answers(scenario: &Scenario) -> OnEach<Answer, Refusal> {
    std::array::from_fn(|finer| {
        let mut scenario = scenario.clone();
        scenario.eye.level += finer as u32;
        let keep = Keep {
            traces: true,
            frames: None,
        };
        solve(&scenario.check()?, keep, &mut unwatched)
    })
}

/// Whether a flag matters to a reading. That at a way of the object is taken before its window ends, which
/// cuts what comes after on purpose.
fn limits(reading: Reading, kind: FlagKind) -> bool {
    let ends = matches!(kind, FlagKind::ContactCut | FlagKind::WindowShort);
    !(ends && matches!(reading, Reading::ForceAt(_)))
}

/// Reads one figure.
fn read(experiment: &Experiment, answer: &Result<Answer, Refusal>) -> Result<f64, String> {
    let answer = answer.as_ref().map_err(Refusal::to_string)?;
    let value = match experiment.reading {
        Reading::ForceAt(way) => answer.run.traces.as_ref().and_then(|traces| {
            let after = traces.intrusion.iter().position(|&x| x >= 1e-3 * way)?;
            let before = after.checked_sub(1)?;
            let (x0, x1) = (traces.intrusion[before], traces.intrusion[after]);
            let force = &traces.contact_force;
            let share = (1e-3 * way - x0) / (x1 - x0);
            Some(force[before] + share * (force[after] - force[before]))
        }),
        Reading::Of(quantity) => answer.result(quantity),
        Reading::Sensor => answer.run.detail("peak_sensor_pressure_mpa"),
        Reading::TimeOf(quantity) => answer.peak(quantity).map(|peak| 1e3 * peak.time),
        Reading::Volume => {
            let least = answer.run.detail("least_globe_volume_percent");
            let most = answer.run.detail("largest_globe_volume_percent");
            let ends = [least, most].into_iter().flatten();
            ends.max_by(|a, b| (a - 100.0).abs().total_cmp(&(b - 100.0).abs()))
        }
    };
    let finite = value.filter(|value| value.is_finite());
    finite.ok_or_else(|| "the run does not reach it".to_owned())
}

/// Squared distance of `value` from what was measured, in standard deviations. Where a source gives none,
/// a factor of 1.3 counts as one.
pub(crate) fn squared_misfit(measured: Band, value: f64) -> f64 {
    let logs = |limit: f64| libm::log(value / limit) / libm::log(1.3f64);
    let z = match measured {
        Band::Spread(mean, sd) => (value - mean) / sd,
        Band::Single(single, _) => logs(single),
        Band::Between(..) | Band::Below(_) | Band::Above(_) if measured.holds(value) => 0.0,
        Band::Between(low, high) => logs(if value < low { low } else { high }),
        Band::Below(limit) | Band::Above(limit) => logs(limit),
    };
    z * z
}
