//! Total error against time: mesh levels, integrators and steps on one scale.
//!
//! A trial is one integrator at one step on one level. Its total error is the mesh error of the
//! level, from the two finer ones as in [`crate::answer::mesh_error`], and its step error: the
//! difference from a reference on the same mesh. Times are medians of rounds interleaved over all
//! trials, so that a busy moment hits them alike.
//!
//! The work is a list of jobs from coarse to fine, so that what was stopped goes on where it was.
//!
//! Left out: methods that choose their own step, whose tolerance a scenario does not hold, and
//! steps so short that only a step error shows them.

use crate::answer::mesh_error::{MeshError, OnMesh, at_level, witnesses};
use crate::answer::{compiled::Compiled, results::Results};
use crate::many::statistics::median;
use crate::models::rules;
use crate::run::{kept::Keep, plan::Plan, quantity::Quantity, refusal::Refusal, rules::Element};
use crate::run::{refusal::unstopped, watch::Watch};
use crate::scenario::{CheckedScenario, Integrator, Scenario};
use std::collections::HashSet;
use std::ops::ControlFlow;
use std::time::Instant;

/// The finest level that is tried for a scenario.
pub fn finest_tried(scenario: &Scenario) -> u32 {
    let mesh = &rules(scenario).mesh;
    mesh.finest.min(mesh.finest_in_study.max(scenario.eye.level))
}

/// Shares of the stability limit that are tried beside that of an answer.
const SHARES: [f64; 3] = [0.95, 0.6, 0.3];
/// Below this share of the error of all that is faster a run is on the front: less is no gain.
const WORTH: f64 = 0.98;
/// Runs of which the median time is taken.
pub const ROUNDS: usize = 3;
/// The reference's step as a share of its stability limit: beside mesh errors its own is nothing.
const REFERENCE_SHARE: f64 = 0.15;
/// Total errors that the cheapest trial is named for, in %.
pub const TOLERANCES: [f64; 6] = [50.0, 20.0, 10.0, 5.0, 2.0, 1.0];

/// One integrator at one step on one level, with its results and times.
#[derive(Debug, Clone, PartialEq)]
pub struct Trial {
    /// The level.
    pub level: u32,
    /// Integrator and step.
    pub plan: Plan,
    /// Whether an answer is computed so by itself.
    pub is_answer: bool,
    /// Longest step taken, in s.
    pub step: f64,
    /// The results; none where the run diverged.
    pub results: Option<Results>,
    /// Springs or cells that were computed.
    pub elements: f64,
    /// Wall times, in s.
    pub times: Vec<f64>,
}

/// The error of a trial in one result, and its time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Total {
    /// The level.
    pub level: u32,
    /// Integrator and step.
    pub plan: Plan,
    /// Whether an answer is computed so by itself.
    pub is_answer: bool,
    /// Longest step taken, in s.
    pub step: f64,
    /// Springs or cells that were computed.
    pub elements: f64,
    /// Median wall time, in s.
    pub seconds: f64,
    /// Error by the mesh, in %.
    pub mesh: f64,
    /// Error by the step, in %.
    pub by_step: f64,
    /// Whether its error is clearly below that of every faster trial.
    pub on_front: bool,
}

impl Total {
    /// Both errors together, in %.
    pub fn error(&self) -> f64 {
        self.mesh + self.by_step
    }
}

/// The cheapest of trials from the fastest to the slowest whose error is within `percent`.
pub fn cheapest(totals: &[Total], percent: f64) -> Option<usize> {
    totals.iter().position(|total| total.error() <= percent)
}

/// All that is known of a scenario, from coarse to fine.
#[derive(Debug, Clone, PartialEq)]
pub struct Accuracy {
    /// The scene that was measured.
    pub scenario: Scenario,
    /// What the work is counted in.
    pub element: Element,
    /// Levels 1, 2, 3, ... by the automatic step of a run alone.
    pub levels: Vec<OnMesh>,
    /// What step errors are against, of the levels that are reached.
    pub references: Vec<Results>,
    /// Every trial, by level.
    pub trials: Vec<Trial>,
    /// Jobs done, from the first.
    pub done: usize,
    /// All jobs.
    pub all: usize,
}

impl Accuracy {
    /// The mesh error of a level, in % of each result, once the two finer ones are known.
    pub fn mesh(&self, level: u32) -> Option<Results> {
        let on = |level: u32| self.levels.get(level as usize - 1);
        let [coarser, finer] = witnesses(&self.scenario, level).map(on);
        Some(MeshError::of(&self.scenario, level, on(level)?, [coarser?, finer?]).errors)
    }

    /// The trials whose error in a result is known, from the fastest to the slowest.
    pub fn of(&self, quantity: Quantity) -> Vec<Total> {
        let one = |trial: &Trial| {
            let reference = self.references.get(trial.level as usize - 1)?;
            let by_step = trial.results?.difference_percent(reference)[quantity]?;
            Some(Total {
                level: trial.level,
                plan: trial.plan,
                is_answer: trial.is_answer,
                step: trial.step,
                elements: trial.elements,
                seconds: median(trial.times.clone())?,
                mesh: self.mesh(trial.level)?[quantity]?,
                by_step,
                on_front: false,
            })
        };
        let mut totals: Vec<Total> = self.trials.iter().filter_map(one).collect();
        totals.retain(|total| total.error().is_finite());
        totals.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
        let mut best = f64::INFINITY;
        for total in &mut totals {
            total.on_front = total.error() < WORTH * best;
            best = if total.on_front { total.error() } else { best };
        }
        totals
    }

    /// The results of which some trial's error is known.
    pub fn results(&self) -> Vec<Quantity> {
        Quantity::ALL.iter().copied().filter(|of| !self.of(*of).is_empty()).collect()
    }

    /// The result to show: the chosen one where its error is known, else pressure, else damage.
    pub fn to_show(&self, chosen: Option<Quantity>) -> Option<Quantity> {
        let known = self.results();
        let mut own = chosen.into_iter().chain([Quantity::Pressure, Quantity::Damage]);
        own.find(|of| known.contains(of)).or(known.first().copied())
    }

    fn add(&mut self, job: &Job, cases: &[Compiled], watch: Watch) -> Result<(), Refusal> {
        let case = || &cases[job.level as usize - 1];
        match job.what {
            What::Level => self.levels.push(at_level(&self.scenario, job.level, watch)?),
            What::Reference => {
                let run = case().run(&job.plan, Keep::default(), watch)?;
                self.references.push(case().results(&run));
            }
            What::Trial(place) => {
                let trial = &mut self.trials[place];
                let began = Instant::now();
                let run = case().run(&job.plan, Keep::default(), watch);
                let took = began.elapsed().as_secs_f64();
                if let Ok(run) = unstopped(run).ok_or(Refusal::Cancelled)? {
                    let each = case().elements_per_evaluation();
                    trial.elements = (run.cost.evaluations * each) as f64;
                    trial.results = Some(case().results(&run));
                }
                trial.times.push(took);
            }
        }
        self.done += 1;
        Ok(())
    }
}

#[derive(Clone, Copy)]
enum What {
    /// The automatic step on a level.
    Level,
    /// What step errors on a level are against.
    Reference,
    /// The trial of this place among all.
    Trial(usize),
}

/// One piece of the work, with its cost in springs or cells.
struct Job {
    what: What,
    level: u32,
    plan: Plan,
    cost: f64,
}

/// All jobs from coarse to fine; then the further rounds.
fn jobs(scenario: &Scenario, cases: &[Compiled], trials: &[Trial]) -> Vec<Job> {
    let most = cases.len() as u32;
    let job = |what: What, level: u32| {
        let case = &cases[level.min(most) as usize - 1];
        let plan = match what {
            What::Level => answer(case),
            What::Reference => case.plan_at(case.rules().reference, REFERENCE_SHARE),
            What::Trial(place) => trials[place].plan,
        };
        let evaluations = plan.window / plan.step * plan.integrator.evaluations() as f64;
        // Above the finest level that is tried work is taken to grow with the cube.
        let finer = f64::from(level) / f64::from(level.min(most));
        let cost = evaluations * case.eye.elements_per_evaluation() as f64 * finer.powi(3);
        Job { what, level, plan, cost }
    };
    let round = || trials.iter().enumerate().map(|(i, trial)| job(What::Trial(i), trial.level));
    let (mut jobs, mut levels) = (Vec::new(), 0);
    for level in 1..=most {
        let reached = witnesses(scenario, level)[1].max(levels);
        jobs.extend((levels + 1..=reached).map(|next| job(What::Level, next)));
        levels = reached;
        jobs.push(job(What::Reference, level));
        jobs.extend(round().filter(|job| job.level == level));
    }
    jobs.extend((1..ROUNDS).flat_map(|_| round()));
    jobs
}

fn answer(case: &Compiled) -> Plan {
    let automatic = case.rules().answer;
    case.plan_at(automatic.integrator, automatic.share)
}

/// The trials on a level, the plan of an answer first.
fn trials(case: &Compiled) -> Vec<Trial> {
    let fixed = |integrator: &&Integrator| !integrator.chooses_its_steps();
    let others = case.rules().integrators.iter().filter(fixed);
    let others = others.flat_map(|of| SHARES.map(|share| case.plan_at(*of, share)));
    let mut plans: Vec<Plan> = [answer(case)].into_iter().chain(others).collect();
    // In a short window several steps come to the same.
    let mut seen = HashSet::new();
    plans.retain(|plan| seen.insert((plan.integrator, case.steps(plan))));
    let trial = |plan: Plan| Trial {
        level: case.level(),
        plan,
        is_answer: plan == answer(case),
        step: case.longest_step(&plan),
        results: None,
        elements: 0.0,
        times: Vec::new(),
    };
    plans.into_iter().map(trial).collect()
}

/// Measures what `known`, of the same scenario and finest level, lacks: levels 1 to `finest`,
/// whose mesh errors come from two more. `show` is told what there is after each job.
///
/// # Errors
/// Whatever a run refuses, and [`Refusal::Cancelled`] if the watch stops it.
pub fn measure(
    scenario: &CheckedScenario,
    finest: u32,
    known: Option<Accuracy>,
    watch: Watch,
    show: &mut dyn FnMut(&Accuracy),
) -> Result<Accuracy, Refusal> {
    let case = |level| -> Result<Compiled, Refusal> {
        let mut other = Scenario::from(scenario.clone());
        other.eye.level = level;
        other.numerics = other.numerics.automatic();
        Ok(Compiled::new(&other.check()?))
    };
    let cases: Vec<Compiled> = (1..=finest).map(case).collect::<Result<_, _>>()?;
    let mut accuracy = known.unwrap_or_else(|| Accuracy {
        scenario: Scenario::clone(scenario),
        element: cases[0].rules().element,
        levels: Vec::new(),
        references: Vec::new(),
        trials: cases.iter().flat_map(trials).collect(),
        done: 0,
        all: 0,
    });
    let jobs = jobs(scenario, &cases, &accuracy.trials);
    accuracy.all = jobs.len();
    let whole: f64 = jobs.iter().map(|job| job.cost).sum();
    let mut done: f64 = jobs[..accuracy.done].iter().map(|job| job.cost).sum();
    for job in &jobs[accuracy.done..] {
        let mut part = |share: f64| watch(((done + share.min(1.0) * job.cost) / whole).min(1.0));
        accuracy.add(job, &cases, &mut part)?;
        done += job.cost;
        show(&accuracy);
        if watch((done / whole).min(1.0)) == ControlFlow::Break(()) {
            return Err(Refusal::Cancelled);
        }
    }
    Ok(accuracy)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::watch::{stop_if, unwatched};

    fn short() -> CheckedScenario {
        let scenario = Scenario { window_ms: Some(0.3), ..Scenario::default() };
        scenario.check().unwrap()
    }

    #[test]
    fn a_measurement_goes_on_where_it_was_stopped_and_finer_levels_are_more_exact() {
        const FINEST: u32 = 3;
        let scenario = short();
        let mut last = None;
        let mut keep = |accuracy: &Accuracy| last = Some(accuracy.clone());
        let mut early = |share| stop_if(share > 0.3);
        let stopped = measure(&scenario, FINEST, None, &mut early, &mut keep);
        assert_eq!(stopped.unwrap_err(), Refusal::Cancelled);
        let before = last.clone().unwrap();
        let whole = measure(&scenario, FINEST, last, &mut unwatched, &mut |_| {}).unwrap();
        assert!(before.done > 3 && before.done < whole.done);
        assert_eq!(whole.levels[0], before.levels[0]);
        assert!(whole.trials.iter().all(|trial| trial.times.len() == ROUNDS));

        let totals = whole.of(Quantity::Damage);
        assert!(totals.is_sorted_by(|a, b| a.seconds <= b.seconds));
        let front: Vec<&Total> = totals.iter().filter(|total| total.on_front).collect();
        assert!(front.is_sorted_by(|a, b| a.error() > b.error()));
        let least = |level| {
            let of = totals.iter().filter(|total| total.level == level);
            of.map(Total::error).fold(f64::INFINITY, f64::min)
        };
        assert!(least(1) > least(FINEST), "{totals:?}");
        assert_eq!(whole.to_show(None), Some(Quantity::Damage));
        assert_eq!(whole.to_show(Some(Quantity::Apex)), Some(Quantity::Apex));
        for percent in TOLERANCES {
            let within = |total: &Total| total.error() <= percent;
            let first = cheapest(&totals, percent).unwrap_or(totals.len());
            assert!(totals.get(first).is_none_or(within) && !totals[..first].iter().any(within));
        }
    }

    /// The watch stops it at its first word beyond `limit`, and hears nothing after that.
    #[test]
    fn it_can_be_stopped_within_every_run_that_it_makes() {
        let scenario = short();
        for limit in [0.0, 0.05, 0.3, 0.62, 0.9] {
            let (mut last, mut after) = (0.0, 0);
            let mut watch = |share| {
                assert!((last..=1.0).contains(&share), "{share} after {last}");
                after += usize::from(last > limit);
                last = share;
                stop_if(share > limit)
            };
            let outcome = measure(&scenario, 1, None, &mut watch, &mut |_| {});
            assert_eq!(outcome.unwrap_err(), Refusal::Cancelled);
            assert_eq!(after, 0, "{limit}");
            assert!(last - limit < 0.1, "{limit}: only at {last}");
        }
    }
}
