//! Many samples over the doubt in the inputs: a few beside the score when nothing else is wanted,
//! many where they are asked for. What was stopped goes on from there.

use std::sync::Arc;

use crate::many::ensemble::{Ensemble, run};
use crate::run::{refusal::Refusal, watch::Watch};
use crate::scenario::Scenario;
use crate::tui::{request::TaskQuestion, task::Task, worker::idle_pool, worker::run_watched};

/// Samples behind the band on the main screen, computed while nothing else is wanted.
pub const FEW: u32 = 256;
/// Samples that a person who asks for them waits for.
pub const MANY: u32 = 1000;
/// The fewest samples that a band is drawn of while more of them come.
pub const FIRST: usize = 16;
/// The seed of the app's ensembles: the same scenario shows the same band.
const SEED: u32 = 1;

/// Asks for an ensemble.
#[derive(Clone)]
pub struct RunSamples {
    /// The scenario that is sampled, with the doubt about its inputs.
    pub scenario: Scenario,
    /// How many samples.
    pub count: u32,
    /// What is known already.
    pub known: Option<Arc<Ensemble>>,
    /// Whether nobody asked.
    pub idle: bool,
}

impl TaskQuestion for RunSamples {
    type Answer = Ensemble;

    fn answer(&self, watch: Watch) -> Result<Ensemble, Refusal> {
        self.fill_in(watch, &mut |_| {})
    }

    /// What is stopped gives the samples done.
    fn fill_in(&self, watch: Watch, show: &mut dyn FnMut(Ensemble)) -> Result<Ensemble, Refusal> {
        let scenario = self.scenario.check()?;
        run_watched(watch, show, |stop, progress| {
            let known = self.known.as_deref().cloned();
            let run = || {
                run(&scenario, (self.count, SEED), known, stop, &|so_far| {
                    let share = so_far.samples.len() as f64 / f64::from(self.count);
                    progress.report(share, || so_far.clone())
                })
            };
            if self.is_idle() { idle_pool().install(run) } else { run() }
        })
    }

    fn is_idle(&self) -> bool {
        self.idle
    }
}

/// The samples that there are, and those under way.
#[derive(Default)]
pub struct Samples {
    /// The last ones, and for which scenario.
    pub done: Option<(Scenario, Arc<Ensemble>)>,
    /// The ones under way.
    pub task: Task<RunSamples>,
}

impl Samples {
    /// What is known of exactly this scenario, its name left aside.
    pub(super) fn known(&self, scenario: &Scenario) -> Option<&Arc<Ensemble>> {
        let (asked, ensemble) = self.done.as_ref()?;
        (*asked == key(scenario)).then_some(ensemble)
    }

    /// The samples of this scenario, once they are finished or at least [`FIRST`].
    pub fn of(&self, scenario: &Scenario) -> Option<&Ensemble> {
        let enough = |e: &&Arc<Ensemble>| !e.stopped() || e.samples.len() >= FIRST;
        self.known(scenario).filter(enough).map(Arc::as_ref)
    }

    /// Why this scenario has no newer one.
    pub fn complaint(&self, scenario: &Scenario) -> Option<&str> {
        let (asked, why) = self.task.complaint.as_ref()?;
        (asked.scenario == key(scenario)).then_some(why)
    }

    /// How far the samples under way are, in words.
    pub fn pace(&self) -> Option<String> {
        self.task.pace(Some(self.task.job.as_ref()?.question.count as usize))
    }
}

/// Whether the bands hold every sample that was asked for and none whose mesh folded.
pub fn is_whole(ensemble: &Ensemble) -> bool {
    ensemble.valid().count() >= ensemble.asked as usize && ensemble.folded() == 0
}

/// The scenario without its name, which changes no sample.
pub(super) fn key(scenario: &Scenario) -> Scenario {
    // No name would be refused.
    Scenario { name: "any".to_owned(), ..scenario.clone() }
}
