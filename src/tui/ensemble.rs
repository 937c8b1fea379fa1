//! How far the answer may be off as the app holds it: an ensemble, its job, the output looked at.

use std::sync::Arc;

use super::worker::{Ticket, overseen};
use crate::scenario::Scenario;
use crate::study::ensemble::{Ensemble, run};
use crate::study::{Refusal, Watch};

/// Samples behind the band on the main screen, computed while nothing else is wanted.
pub const FEW: u32 = 256;
/// Samples of the screen of its own.
pub const MANY: u32 = 1000;
/// The seed of the app's ensembles: the same scenario shows the same band.
const SEED: u32 = 1;

/// What is asked of a worker.
#[derive(Debug, Clone, PartialEq)]
pub struct Sampling {
    /// The scenario.
    pub scenario: Scenario,
    /// How many samples.
    pub count: u32,
}

/// What the worker does. What is stopped gives the samples done.
///
/// # Errors
/// Whatever the scenario itself is refused for.
pub fn ensemble(question: &Sampling, watch: Watch) -> Result<Ensemble, Refusal> {
    let count = (question.count, SEED);
    overseen(watch, |stop, watch| {
        run(&question.scenario, count, stop, watch)
    })
}

/// What is under way.
#[derive(Debug, Clone, PartialEq)]
pub struct Job {
    /// Its ticket.
    pub ticket: Ticket,
    /// What was asked.
    pub question: Sampling,
    /// How much of it is done.
    pub share: f64,
    /// Whether it was asked to stop.
    pub stopping: bool,
}

/// All that the screens know.
#[derive(Default)]
pub struct Spread {
    /// The last one that ended, and for which scenario.
    pub done: Option<(Scenario, Arc<Ensemble>)>,
    /// The one under way.
    pub job: Option<Job>,
    /// Why there is no newer one, and for which scenario.
    pub complaint: Option<(Scenario, String)>,
    /// The output looked at, counted among those that the ensemble has.
    pub output: usize,
}

impl Spread {
    /// The ensemble of exactly this scenario, its name left aside.
    pub fn of(&self, scenario: &Scenario) -> Option<&Ensemble> {
        let (asked, ensemble) = self.done.as_ref()?;
        (*asked == key(scenario)).then_some(ensemble.as_ref())
    }

    /// Why this scenario has no newer one.
    pub fn complaint(&self, scenario: &Scenario) -> Option<&str> {
        let (asked, why) = self.complaint.as_ref()?;
        (*asked == key(scenario)).then_some(why)
    }
}

/// Whether the bands hold every sample that was asked for and none whose mesh folded.
pub fn is_whole(ensemble: &Ensemble) -> bool {
    ensemble.valid().count() >= ensemble.asked as usize && ensemble.folded() == 0
}

/// What of a scenario matters.
pub fn key(scenario: &Scenario) -> Scenario {
    Scenario {
        // No name would be refused.
        name: "any".to_owned(),
        ..scenario.clone()
    }
}
