//! Many samples over the doubt in the inputs: a few beside the score when nothing else is wanted,
//! many when they are asked for.

use std::sync::Arc;

use super::guest::MOST_SAMPLES;
use super::model::Model;
use super::task::{Question, Report, Task};
use super::worker::overseen;
use crate::scenario::Scenario;
use crate::study::ensemble::{Ensemble, run};
use crate::study::{Refusal, Watch};

/// Samples behind the band on the main screen, computed while nothing else is wanted.
pub const FEW: u32 = 256;
/// Samples that a person who asks for them waits for.
pub const MANY: u32 = 1000;
/// The seed of the app's ensembles: the same scenario shows the same band.
const SEED: u32 = 1;

/// Asks for an ensemble.
#[derive(Debug, Clone, PartialEq)]
pub struct RunSamples {
    /// What is sampled, with the doubt about its inputs.
    pub scenario: Scenario,
    /// How many samples.
    pub count: u32,
}

impl Question for RunSamples {
    type Answer = Ensemble;

    /// What is stopped gives the samples done.
    fn answer(&self, watch: Watch) -> Result<Ensemble, Refusal> {
        let count = (self.count, SEED);
        let scenario = self.scenario.check()?;
        overseen(watch, |stop, watch| run(&scenario, count, stop, watch))
    }
}

/// The samples that there are, and those under way.
#[derive(Default)]
pub struct Samples {
    /// The last ones that ended, and for which scenario.
    pub done: Option<(Scenario, Arc<Ensemble>)>,
    /// The ones under way.
    pub task: Task<RunSamples>,
}

impl Samples {
    /// The ensemble of exactly this scenario, its name left aside.
    pub fn of(&self, scenario: &Scenario) -> Option<&Ensemble> {
        let (asked, ensemble) = self.done.as_ref()?;
        (*asked == key(scenario)).then_some(ensemble.as_ref())
    }

    /// Why this scenario has no newer one.
    pub fn complaint(&self, scenario: &Scenario) -> Option<&str> {
        let (asked, why) = self.task.complaint.as_ref()?;
        (asked.scenario == key(scenario)).then_some(why)
    }
}

/// Whether the bands hold every sample that was asked for and none whose mesh folded.
pub fn is_whole(ensemble: &Ensemble) -> bool {
    ensemble.valid().count() >= ensemble.asked as usize && ensemble.folded() == 0
}

/// What of a scenario matters.
fn key(scenario: &Scenario) -> Scenario {
    Scenario {
        // No name would be refused.
        name: "any".to_owned(),
        ..scenario.clone()
    }
}

/// Runs a few samples of what is on show if nothing else is wanted, for the band beside the score.
pub(super) fn run_when_idle(model: &mut Model) {
    if !model.idle {
        return;
    }
    let scenario = &model.work.scenario;
    let answered = |shown: &super::model::Shown| shown.scenario == *scenario;
    let settled = model.run.job.is_none() && model.shown.as_ref().is_some_and(answered);
    if settled && model.ensemble.of(scenario).is_none() && model.ensemble.task.job.is_none() {
        start(model, FEW);
    }
}

/// Runs so many samples, unless that is under way. A smaller run gives way to a larger one.
pub(super) fn start(model: &mut Model, count: u32) {
    let count = if model.guest {
        count.min(MOST_SAMPLES)
    } else {
        count
    };
    let job = model.ensemble.task.job.as_ref();
    if job.is_none_or(|job| job.ending || job.question.count < count) {
        let scenario = key(&model.work.scenario);
        let question = RunSamples { scenario, count };
        model.ensemble.task.ask(question, &mut model.out);
    }
}

/// Gives up what is under way if the scenario became another, or if the many samples are no longer
/// wanted: what is done of them still serves the main screen.
pub(super) fn attend(model: &mut Model, many: bool) {
    let Some(job) = &model.ensemble.task.job else {
        return;
    };
    if job.question.scenario != key(&model.work.scenario) {
        model.ensemble.task.stop(None, &mut model.out);
    } else if job.question.count > FEW && !many && !job.ending {
        model.ensemble.task.end(&mut model.out);
    }
}

/// Keeps the larger one of what was known and what has come.
pub(super) fn hear(model: &mut Model, report: &mut Option<Report>) {
    let samples = &mut model.ensemble;
    let Some((asked, Some(ensemble))) = samples.task.hear(report) else {
        return;
    };
    if ensemble.stopped() {
        let done = ensemble.samples.len();
        let text = format!("stopped after {done} of {}", ensemble.asked);
        samples.task.complaint = Some((asked.clone(), text));
    }
    let known = samples.of(&asked.scenario).map_or(0, |e| e.samples.len());
    if ensemble.samples.len() > known {
        samples.done = Some((asked.scenario.clone(), Arc::new(ensemble)));
    }
}
