//! Every published experiment run again on three neighbouring meshes, beside what was measured.
//!
//! Left out: judgement. A row that misses stays in the table with its ratio.

use crate::answer::{compiled::Compiled, solve::Answer, solve::solve};
use crate::run::{flags::FlagKind, kept::Keep, model::Run, refusal::Refusal, watch::unwatched};
use crate::scenario::{Model, Physiological, Scenario};
use crate::verify::experiments::{EXPERIMENTS, Experiment, Gauge};
use rayon::prelude::*;

/// How many meshes: that of the experiment and the next finer ones.
pub const MESHES: usize = 3;

/// Something on each mesh, or why there is nothing.
pub type OnEach<T, E = String> = [Result<T, E>; MESHES];

/// One experiment, run.
#[derive(Debug, Clone)]
pub struct Rerun {
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

impl Rerun {
    fn read(experiment: &'static Experiment, answers: &OnEach<Answer, Refusal>) -> Self {
        let solved = || answers.iter().filter_map(|answer| answer.as_ref().ok());
        let mut flags: Vec<FlagKind> = Vec::new();
        for flag in solved().flat_map(|answer| &answer.flags) {
            if !flags.contains(&flag.kind) && limits(experiment.reading, flag.kind) {
                flags.push(flag.kind);
            }
        }
        let step_errors = solved().filter_map(|answer| answer.errors.time_step_percent());
        Self {
            experiment,
            predicted: answers.each_ref().map(|answer| {
                let answer = answer.as_ref().map_err(Refusal::to_string)?;
                read_run(experiment, &answer.case, &answer.run)
            }),
            published: None,
            step_error: step_errors.reduce(f64::max),
            flags,
        }
    }

    /// What is predicted on each mesh over what was measured.
    pub fn ratios(&self) -> [Option<f64>; MESHES] {
        let typical = self.experiment.measured.typical();
        self.predicted.each_ref().map(|value| Some(value.as_ref().ok()? / typical))
    }

    /// Whether the prediction of each mesh lies where the measurement says.
    pub fn inside(&self) -> [bool; MESHES] {
        let measured = self.experiment.measured;
        self.predicted.each_ref().map(|value| value.as_ref().is_ok_and(|v| measured.holds(*v)))
    }

    /// Whether the prediction of every mesh does.
    pub fn is_met(&self) -> bool {
        self.inside() == [true; MESHES]
    }
}

/// Runs every experiment, the fitted ones also with the published modulus.
pub fn rerun_all() -> Vec<Rerun> {
    let (mut rows, published) = rayon::join(
        || rerun(EXPERIMENTS.iter(), |scenario| scenario),
        || rerun(fitted(), |s| with_fat(s, Physiological::PUBLISHED_FAT_BULK_MPA)),
    );
    // The fitted ones come first.
    for (row, published) in rows.iter_mut().zip(published) {
        row.published = Some(published.predicted);
    }
    rows
}

/// The experiments that the free number was fitted to.
pub fn fitted() -> impl Iterator<Item = &'static Experiment> {
    EXPERIMENTS.iter().filter(|experiment| experiment.fitted)
}

/// `scenario` with a bulk modulus of orbital fat, in `MPa`.
pub(crate) fn with_fat(mut scenario: Scenario, mpa: f64) -> Scenario {
    if let Model::Physiological(model) = &mut scenario.model {
        model.fat_bulk_mpa = mpa;
    }
    scenario
}

/// Runs each scenario, as `change` makes it, once for all experiments that share it.
pub(crate) fn rerun(
    experiments: impl Iterator<Item = &'static Experiment>,
    change: impl Fn(Scenario) -> Scenario + Sync,
) -> Vec<Rerun> {
    let mut groups: Vec<(Scenario, Vec<&'static Experiment>)> = Vec::new();
    for experiment in experiments {
        let scenario = change((experiment.scenario)());
        match groups.iter_mut().find(|(known, _)| *known == scenario) {
            Some((_, members)) => members.push(experiment),
            None => groups.push((scenario, vec![experiment])),
        }
    }
    let read = |(scenario, members): (Scenario, Vec<&'static Experiment>)| {
        let answers = answers(&scenario);
        members.into_iter().map(move |experiment| Rerun::read(experiment, &answers))
    };
    let mut rows: Vec<Rerun> = groups.into_par_iter().flat_map_iter(read).collect();
    rows.sort_by_key(|row| EXPERIMENTS.iter().position(|of| of.key == row.experiment.key));
    rows
}

/// Answers of the scenario's own mesh and of the next finer ones.
fn answers(scenario: &Scenario) -> OnEach<Answer, Refusal> {
    let on = |finer: u32| {
        let mut scenario = scenario.clone();
        scenario.eye.level += finer;
        let keep = Keep { traces: true, frames: None };
        solve(&scenario.check()?, keep, &mut unwatched)
    };
    let (finest, (finer, own)) = rayon::join(|| on(2), || rayon::join(|| on(1), || on(0)));
    [own, finer, finest]
}

/// Whether a flag matters to a reading: at a way of the object the window ends on purpose.
fn limits(reading: Gauge, kind: FlagKind) -> bool {
    let ends =
        matches!(kind, FlagKind::ContactCut | FlagKind::WindowShort | FlagKind::WindowCapped);
    !(ends && matches!(reading, Gauge::ForceAt(_)))
}

/// Reads one figure of a run that kept its traces.
pub(crate) fn read_run(experiment: &Experiment, case: &Compiled, run: &Run) -> Result<f64, String> {
    let value = match experiment.reading {
        Gauge::ForceAt(way) => run.traces.as_ref().and_then(|traces| {
            let after = traces.intrusion.iter().position(|&x| x >= 1e-3 * way)?;
            let before = after.checked_sub(1)?;
            let (x0, x1) = (traces.intrusion[before], traces.intrusion[after]);
            let force = &traces.contact_force;
            let share = (1e-3 * way - x0) / (x1 - x0);
            Some(force[before] + share * (force[after] - force[before]))
        }),
        Gauge::Of(quantity) => case.results(run)[quantity],
        Gauge::Sensor => run.detail("peak_sensor_pressure_mpa"),
        Gauge::TimeOf(quantity) => run.readings.peak(quantity).map(|peak| 1e3 * peak.time),
        Gauge::Volume => {
            let least = run.detail("least_globe_volume_percent");
            let most = run.detail("largest_globe_volume_percent");
            let ends = [least, most].into_iter().flatten();
            ends.max_by(|a, b| (a - 100.0).abs().total_cmp(&(b - 100.0).abs()))
        }
    };
    let finite = value.filter(|value| value.is_finite());
    finite.ok_or_else(|| "the run does not reach it".to_owned())
}
