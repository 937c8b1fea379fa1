//! Total error against time: mesh levels, integrators and steps on one scale.
//!
//! A run is one integrator at one step on one level. Its total error is the mesh error of the level, from the
//! two finer ones as in [`crate::answer::mesh_error`], and its step error: the difference from a reference on the same
//! mesh. Times are medians of rounds interleaved over all runs, so that a busy moment hits them alike.
//!
//! The work is a list of jobs from coarse to fine, so that what was stopped goes on where it was.
//!
//! Left out: methods that choose their own step, whose tolerance a scenario does not hold, and steps so short
//! that only a step error shows them; [`crate::answer::accuracy`] has both.

use crate::answer::accuracy::{REFERENCE_OF_TOTALS, is_affordable};
use crate::answer::compiled::Compiled;
use crate::answer::mesh_error::{MeshError, OnMesh, at_level, witnesses};
use crate::answer::results::Results;
use crate::many::statistics::median;
use crate::models::rules;
use crate::run::kept::Keep;
use crate::run::plan::{LOCAL_TOLERANCE, Plan};
use crate::run::quantity::Quantity;
use crate::run::refusal::Refusal;
use crate::run::watch::Watch;
use crate::scenario::{CheckedScenario, Model, NumericsInput, Scenario};
use std::ops::ControlFlow;
use std::time::Instant;

/// The finest level that is tried for a scenario.
pub fn finest_tried(scenario: &Scenario) -> u32 {
    let mesh = &rules(&scenario.model).mesh;
    mesh.finest
        .min(mesh.finest_in_study.max(scenario.eye.level))
}

/// Shares of the stability limit that are tried beside that of an answer.
const SHARES: [f64; 3] = [0.95, 0.6, 0.3];
/// Below this share of the error of all that is faster a run is on the front: less is no gain.
const WORTH: f64 = 0.98;
/// Runs of which the median time is taken.
pub const ROUNDS: usize = 3;

/// What is known of a mesh level.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct OnLevel {
    /// Its results by the automatic step of a run alone.
    pub results: Results,
    /// When its mesh folded, in s.
    pub folded: Option<f64>,
    /// Springs or cells that were computed.
    pub elements: f64,
    /// The results that step errors are against, once they are known.
    pub reference: Option<Results>,
}

/// One integrator at one step on one level.
#[derive(Debug, Clone, PartialEq)]
pub struct Run {
    /// The level.
    pub level: u32,
    /// Integrator and step.
    pub plan: Plan,
    /// Whether an answer is computed so by itself.
    pub is_answer: bool,
    /// Longest step taken, in s.
    pub step: f64,
    /// What came of it; none where it diverged.
    pub results: Option<Results>,
    /// Wall times, in s.
    pub times: Vec<f64>,
}

/// The error of a run in one result, and its time.
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
    /// Median wall time, in s.
    pub seconds: f64,
    /// Error by the mesh, in %.
    pub mesh: f64,
    /// Error by the step, in %.
    pub by_step: f64,
    /// Whether it is more exact than all that is faster, by more than a trifle.
    pub on_front: bool,
}

impl Total {
    /// Both errors together, in %.
    pub fn error(&self) -> f64 {
        self.mesh + self.by_step
    }
}

/// All that is known of a scenario, from coarse to fine.
#[derive(Debug, Clone, PartialEq)]
pub struct Totals {
    /// The model that was measured.
    pub model: Model,
    /// Levels 1, 2, 3, ...
    pub levels: Vec<OnLevel>,
    /// Every run that was begun, by level.
    pub runs: Vec<Run>,
    /// Jobs done, from the first.
    pub done: usize,
    /// All jobs.
    pub all: usize,
}

impl Totals {
    /// The mesh error of a level, in % of each result, once the two finer ones are known.
    pub fn mesh(&self, level: u32) -> Option<Results> {
        let on = |level: u32| {
            let known = self.levels.get(level as usize - 1)?;
            Some(OnMesh {
                results: known.results,
                folded: known.folded,
                elements: known.elements,
            })
        };
        let [coarser, finer] = witnesses(&self.model, level).map(on);
        let (own, coarser, finer) = (on(level)?, coarser?, finer?);
        Some(MeshError::of(&self.model, level, &own, [&coarser, &finer]).errors)
    }

    /// The runs whose error in a result is known, from the fastest to the slowest.
    pub fn of(&self, quantity: Quantity) -> Vec<Total> {
        let one = |run: &Run| {
            let reference = self.levels.get(run.level as usize - 1)?.reference?;
            let by_step = run.results?.difference_percent(&reference)[quantity]?;
            Some(Total {
                level: run.level,
                plan: run.plan,
                is_answer: run.is_answer,
                step: run.step,
                seconds: median(run.times.clone())?,
                mesh: self.mesh(run.level)?[quantity]?,
                by_step,
                on_front: false,
            })
        };
        let mut totals: Vec<Total> = self.runs.iter().filter_map(one).collect();
        totals.retain(|total| total.error().is_finite());
        totals.sort_by(|a, b| a.seconds.total_cmp(&b.seconds));
        let mut best = f64::INFINITY;
        for total in &mut totals {
            total.on_front = total.error() < WORTH * best;
            if total.on_front {
                best = total.error();
            }
        }
        totals
    }

    /// The results of which some run's error is known.
    pub fn results(&self) -> Vec<Quantity> {
        let all = Quantity::ALL.iter().copied();
        all.filter(|of| !self.of(*of).is_empty()).collect()
    }
}

/// One piece of the work.
#[derive(Clone, Copy)]
enum Job {
    /// The automatic step on a level.
    Level(u32),
    /// What step errors on a level are against.
    Reference(u32),
    /// A run of this place among all.
    Run(usize),
}

/// What is to be done.
struct Work {
    cases: Vec<Compiled>,
    choices: Vec<(u32, Plan)>,
    jobs: Vec<(Job, f64)>,
}

impl Work {
    fn of(scenario: &Scenario) -> Result<Self, Refusal> {
        let most = finest_tried(scenario);
        let case = |level| -> Result<Compiled, Refusal> {
            let mut other = scenario.clone();
            other.eye.level = level;
            other.numerics = NumericsInput::default();
            Ok(Compiled::new(&other.check()?))
        };
        let cases: Vec<Compiled> = (1..=most).map(case).collect::<Result<_, _>>()?;
        let mut choices = Vec::new();
        for (level, case) in (1..).zip(&cases) {
            choices.extend(plans(case).into_iter().map(|plan| (level, plan)));
        }
        let cost = |level: u32, plan: &Plan| {
            let case = &cases[level.min(most) as usize - 1];
            let evaluations =
                plan.window / plan.step * plan.integrator.method().evaluations() as f64;
            let finer = f64::from(level) / f64::from(level.min(most));
            evaluations * case.eye.elements_per_evaluation() as f64 * finer.powi(3)
        };
        let answer = |level: u32| answer(&cases[level.min(most) as usize - 1]);
        let mut jobs = Vec::new();
        let mut levels = 0;
        for level in 1..=most {
            while levels < witnesses(&scenario.model, level)[1] {
                levels += 1;
                jobs.push((Job::Level(levels), cost(levels, &answer(levels))));
            }
            let reference = reference(&cases[level as usize - 1]);
            jobs.push((Job::Reference(level), cost(level, &reference)));
            jobs.extend(
                round(&choices, &cost)
                    .filter(|(_, at, _)| *at == level)
                    .map(|(j, _, c)| (j, c)),
            );
        }
        for _ in 1..ROUNDS {
            jobs.extend(round(&choices, &cost).map(|(job, _, cost)| (job, cost)));
        }
        Ok(Self {
            cases,
            choices,
            jobs,
        })
    }

    /// Does one job.
    fn add(
        &self,
        job: Job,
        scenario: &Scenario,
        into: &mut Totals,
        watch: Watch,
    ) -> Result<(), Refusal> {
        match job {
            Job::Level(level) => {
                let OnMesh {
                    results,
                    folded,
                    elements,
                } = at_level(scenario, level, watch)?;
                into.levels.push(OnLevel {
                    results,
                    folded,
                    elements,
                    reference: None,
                });
            }
            Job::Reference(level) => {
                let case = &self.cases[level as usize - 1];
                let run = case.run(&reference(case), Keep::default(), watch)?;
                into.levels[level as usize - 1].reference = Some(case.results(&run));
            }
            Job::Run(place) => {
                let (level, plan) = self.choices[place];
                let case = &self.cases[level as usize - 1];
                let began = Instant::now();
                let ran = case.run(&plan, Keep::default(), watch);
                let took = began.elapsed().as_secs_f64();
                if matches!(ran, Err(Refusal::Cancelled)) {
                    return Err(Refusal::Cancelled);
                }
                if place == into.runs.len() {
                    into.runs.push(Run {
                        level,
                        plan,
                        is_answer: plan == answer(case),
                        step: case.eye.longest_step(&plan),
                        results: None,
                        times: Vec::new(),
                    });
                }
                let run = &mut into.runs[place];
                run.results = ran.ok().map(|ran| case.results(&ran));
                run.times.push(took);
            }
        }
        into.done += 1;
        Ok(())
    }
}

/// Every run once, with its level and its cost.
fn round<'a>(
    choices: &'a [(u32, Plan)],
    cost: &'a impl Fn(u32, &Plan) -> f64,
) -> impl Iterator<Item = (Job, u32, f64)> + 'a {
    let runs = choices.iter().enumerate();
    runs.map(|(place, (level, plan))| (Job::Run(place), *level, cost(*level, plan)))
}

fn plan(case: &Compiled, integrator: crate::scenario::Integrator, share: f64) -> Plan {
    Plan {
        integrator,
        step: share * case.step_limit(integrator),
        window: case.window(),
        multiple: 1.0,
        local_tolerance: LOCAL_TOLERANCE,
    }
}

/// How an answer is computed.
fn answer(case: &Compiled) -> Plan {
    let automatic = case.rules().answer;
    plan(case, automatic.integrator, automatic.share)
}

fn reference(case: &Compiled) -> Plan {
    plan(case, case.rules().reference, REFERENCE_OF_TOTALS)
}

/// What is tried on a level, the answer's own plan first.
fn plans(case: &Compiled) -> Vec<Plan> {
    let mut plans = vec![answer(case)];
    for &integrator in case.rules().integrators {
        if !integrator.method().adaptive() {
            plans.extend(SHARES.map(|share| plan(case, integrator, share)));
        }
    }
    plans.retain(|plan| is_affordable(case, plan));
    // In a short window several steps come to the same.
    let mut seen: Vec<(crate::scenario::Integrator, usize)> = Vec::new();
    plans.retain(|plan| {
        let of = (plan.integrator, case.eye.steps(plan));
        let fresh = !seen.contains(&of);
        seen.push(of);
        fresh
    });
    plans
}

/// Measures what `known`, of the same scenario, lacks; `show` is told what there is after each job.
///
/// # Errors
/// Whatever a run refuses, and [`Refusal::Cancelled`] if the watch stops it.
pub fn measure(
    scenario: &CheckedScenario,
    known: Option<Totals>,
    watch: Watch,
    show: &mut dyn FnMut(&Totals),
) -> Result<Totals, Refusal> {
    let work = Work::of(scenario)?;
    let mut totals = known.unwrap_or(Totals {
        model: scenario.model,
        levels: Vec::new(),
        runs: Vec::new(),
        done: 0,
        all: work.jobs.len(),
    });
    let whole: f64 = work.jobs.iter().map(|(_, cost)| cost).sum();
    let mut done: f64 = work.jobs[..totals.done].iter().map(|(_, cost)| cost).sum();
    for (job, cost) in &work.jobs[totals.done..] {
        let mut part = |share: f64| watch(((done + share.min(1.0) * cost) / whole).min(1.0));
        work.add(*job, scenario, &mut totals, &mut part)?;
        done += cost;
        show(&totals);
        if watch((done / whole).min(1.0)) == ControlFlow::Break(()) {
            return Err(Refusal::Cancelled);
        }
    }
    Ok(totals)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::watch::unwatched;

    #[test]
    fn a_measurement_goes_on_where_it_was_stopped_and_finer_levels_are_more_exact() {
        let scenario = Scenario {
            window_ms: 0.3,
            ..Scenario::default()
        };
        let scenario = scenario.check().unwrap();
        let mut last = None;
        let stopped = measure(
            &scenario,
            None,
            &mut |share| {
                if share > 0.3 {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            },
            &mut |totals| last = Some(totals.clone()),
        );
        assert_eq!(stopped.unwrap_err(), Refusal::Cancelled);
        let part = last.unwrap();
        let before = part.clone();
        let whole = measure(&scenario, Some(part), &mut unwatched, &mut |_| {}).unwrap();
        assert!(before.done > 3 && before.done < whole.done);
        assert_eq!(whole.levels[0], OnLevel { ..before.levels[0] });
        assert!(whole.runs.iter().all(|run| run.times.len() == ROUNDS));

        let totals = whole.of(Quantity::Damage);
        assert!(totals.is_sorted_by(|a, b| a.seconds <= b.seconds));
        let front: Vec<&Total> = totals.iter().filter(|total| total.on_front).collect();
        assert!(front.is_sorted_by(|a, b| a.error() > b.error()));
        let least = |level| {
            let of = totals.iter().filter(|total| total.level == level);
            of.map(Total::error).fold(f64::INFINITY, f64::min)
        };
        assert!(least(1) > least(4), "{} {}", least(1), least(4));
        assert!(whole.results().contains(&Quantity::Damage));
    }
}
