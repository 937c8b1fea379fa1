//! Speed against error: every integrator over its usable steps, and every mesh level.
//!
//! A point is one integrator at one step on the scenario's mesh. Its error is against a reference
//! on the same mesh, so it is the step error alone; its time is the median of runs interleaved with
//! those of all other points, so that a busy moment hits them alike. The points that no
//! other beats in both make the Pareto front of this work-precision diagram. Levels are compared with
//! the finest one computed, which tells the mesh error.

use crate::answer::compiled::Compiled;
use crate::answer::mesh_error::{OnMesh, at_level};
use crate::answer::results::Results;
use crate::many::statistics::median;
use crate::run::kept::Keep;
use crate::run::plan::{LOCAL_TOLERANCE, Plan};
use crate::run::refusal::Refusal;
use crate::run::rules::Element;
use crate::run::watch::Watch;
use crate::scenario::Integrator;
use crate::scenario::{CheckedScenario, Scenario};
use std::ops::ControlFlow;
use std::time::Instant;

/// Shares of the stability limit that are tried.
const SHARES: [f64; 7] = [0.95, 0.8, 0.6, 0.4, 0.2, 0.1, 0.05];
/// Local tolerances that an adaptive method is tried with.
const TOLERANCES: [f64; 5] = [1e-2, 1e-3, 1e-4, 1e-6, 1e-8];
/// Points that cost more evaluations than this, per level squared, are left out.
const MAX_EVALUATIONS: f64 = 8e4;
/// Share of the limit that the reference takes, with the method of highest order: half of the least
/// that is tried, so that no point is compared with itself.
const REFERENCE_SHARE: f64 = 0.025;
/// The same where only the total of step and mesh errors matters, beside which such a reference is exact.
pub(crate) const REFERENCE_OF_TOTALS: f64 = 0.15;
/// Runs of which the median time is taken.
const ROUNDS: usize = 7;
/// Errors that a best choice is named for, in %.
pub const TARGETS: [f64; 4] = [10.0, 1.0, 0.1, 0.01];

/// One integrator at one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Point {
    /// The method and its step.
    pub plan: Plan,
    /// Longest step taken, in s.
    pub step: f64,
    /// Force evaluations.
    pub evaluations: usize,
    /// Springs or cells computed.
    pub element_evaluations: usize,
    /// Median wall time, in s.
    pub seconds: f64,
    /// Error of each result against the reference, in %.
    pub errors: Results,
    /// Whether no other point is both faster and more accurate.
    pub on_front: bool,
}

impl Point {
    /// The largest of the leading results' errors, in %.
    pub fn error(&self) -> f64 {
        self.errors.headline()
    }
}

/// One mesh level, by the automatic integrator and step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Level {
    /// Its number.
    pub level: u32,
    /// Median wall time, in s.
    pub seconds: f64,
    /// Springs or cells computed.
    pub element_evaluations: usize,
    /// Results.
    pub results: Results,
    /// Difference of each result from the finest level, in %.
    pub errors: Results,
    /// Whether the mesh folded.
    pub folded: bool,
}

/// A work-precision report.
#[derive(Debug, Clone, PartialEq)]
pub struct Accuracy {
    /// All points, by integrator and falling step.
    pub points: Vec<Point>,
    /// Index of the cheapest point for each of [`TARGETS`], if any meets it.
    pub best: [Option<usize>; TARGETS.len()],
    /// The reference's method and step.
    pub reference: Plan,
    /// The reference's results.
    pub reference_results: Results,
    /// Levels, the last being what the others are compared with.
    pub levels: Vec<Level>,
    /// Nanoseconds a spring evaluation takes at the automatic step, recording included; none where
    /// springs alone do not solve the scene.
    pub ns_per_spring: Option<f64>,
    /// Upper bound of the angular frequency of a section, in rad/s.
    pub omega_bound: Option<f64>,
    /// What the work is counted in.
    pub element: Element,
    /// Whether the mesh folded in the reference: then nothing here is a promise.
    pub folded: bool,
}

/// Whether a plan costs no more than is worth a point.
pub(crate) fn is_affordable(case: &Compiled, plan: &Plan) -> bool {
    let most = MAX_EVALUATIONS * case.window() / 3e-3;
    let evaluations = case.window() / plan.step * plan.integrator.method().evaluations() as f64;
    evaluations <= most * f64::from(case.level())
}

fn plans(case: &Compiled) -> Vec<Plan> {
    let mut plans = Vec::new();
    for &integrator in case.rules().integrators {
        let limit = case.step_limit(integrator);
        let plan = |share: f64, local_tolerance| Plan {
            integrator,
            step: share * limit,
            window: case.window(),
            multiple: 1.0,
            local_tolerance,
        };
        if integrator.method().adaptive() {
            plans.extend(TOLERANCES.map(|t| plan(0.95, t)));
        } else {
            let mut tried: Vec<Plan> = SHARES
                .map(|share| plan(share, LOCAL_TOLERANCE))
                .into_iter()
                .filter(|p| is_affordable(case, p))
                .collect();
            // In a short window several steps come to the same.
            tried.dedup_by_key(|p| case.eye.steps(p));
            plans.extend(tried);
        }
    }
    plans
}

/// Marks the Pareto front: the points that no other point beats in time and error.
fn mark_front(points: &mut [Point]) {
    let all: Vec<(f64, f64)> = points.iter().map(|p| (p.seconds, p.error())).collect();
    for (point, &(time, error)) in points.iter_mut().zip(&all) {
        point.on_front = error.is_finite()
            && !all
                .iter()
                .any(|&(t, e)| t <= time && e <= error && (t < time || e < error));
    }
}

/// A watch over a part of the work: it is told of the share that this part has of the whole.
fn part(watch: Watch, from: f64, size: f64) -> impl FnMut(f64) -> ControlFlow<()> {
    move |share| watch(from + size * share.min(1.0))
}

/// The report for `scenario`, with levels up to `finest`.
///
/// # Errors
/// Whatever a run refuses, and [`Refusal::Cancelled`] if the watch stops it.
pub fn measure(scenario: &CheckedScenario, finest: u32, watch: Watch) -> Result<Accuracy, Refusal> {
    let case = Compiled::new(scenario);
    let method = case.rules().reference;
    let reference = Plan {
        integrator: method,
        step: REFERENCE_SHARE * case.step_limit(method),
        window: case.window(),
        multiple: 1.0,
        local_tolerance: LOCAL_TOLERANCE,
    };
    let solved = case.run(&reference, Keep::default(), &mut part(watch, 0.0, 0.1))?;
    let folded = solved.folded_at().is_some();
    let truth = case.results(&solved);

    let plans = plans(&case);
    let mut times = vec![Vec::new(); plans.len()];
    let mut last = vec![None; plans.len()];
    for round in 0..ROUNDS {
        for (i, plan) in plans.iter().enumerate() {
            let job = (round * plans.len() + i) as f64;
            let each = 0.5 / (ROUNDS * plans.len()) as f64;
            // The look at the watch costs nothing beside the steps between two looks.
            let mut watch = part(watch, 0.1 + job * each, each);
            let started = Instant::now();
            let solved = case.run(plan, Keep::default(), &mut watch);
            times[i].push(started.elapsed().as_secs_f64());
            if matches!(solved, Err(Refusal::Cancelled)) || watch(1.0).is_break() {
                return Err(Refusal::Cancelled);
            }
            last[i] = solved.ok();
        }
    }
    let elements = case.eye.elements_per_evaluation();
    let mut points: Vec<Point> = plans
        .iter()
        .zip(times.into_iter().zip(last))
        .filter_map(|(plan, (times, solved))| {
            let solved = solved?;
            Some(Point {
                plan: *plan,
                step: case.eye.longest_step(plan),
                evaluations: solved.cost.evaluations,
                element_evaluations: solved.cost.evaluations * elements,
                seconds: median(times)?,
                errors: case.results(&solved).difference_percent(&truth),
                on_front: false,
            })
        })
        .collect();
    mark_front(&mut points);
    let best = TARGETS.map(|target| {
        (0..points.len())
            .filter(|&i| points[i].error() <= target)
            .min_by(|&a, &b| points[a].seconds.total_cmp(&points[b].seconds))
    });
    let ns_per_spring = points
        .iter()
        .filter(|p| p.plan.integrator == Integrator::Srkn6b)
        .map(|p| p.seconds * 1e9 / p.element_evaluations as f64)
        .reduce(f64::min);

    let mut levels = Vec::new();
    for level in 1..=finest {
        let share = |level: u32| f64::from(level.pow(3)) / f64::from(finest.pow(3));
        let from = 0.6 + 0.4 * share(level - 1);
        let mut watch = part(watch, from, 0.4 * (share(level) - share(level - 1)));
        levels.push(measure_level(scenario, level, &mut watch)?);
    }
    let finest_results = levels.last().map(|l| l.results);
    for level in &mut levels {
        if let Some(finest) = &finest_results {
            level.errors = level.results.difference_percent(finest);
        }
    }
    Ok(Accuracy {
        points,
        best,
        reference,
        reference_results: truth,
        levels,
        ns_per_spring,
        omega_bound: None,
        element: case.rules().element,
        folded,
    })
}

fn measure_level(scenario: &Scenario, level: u32, watch: Watch) -> Result<Level, Refusal> {
    let mut other = scenario.clone();
    other.eye.level = level;
    other.numerics = crate::scenario::NumericsInput::default();
    let case = Compiled::new(&other.check()?);
    let plan = case.plan_alone(&other)?;
    let rounds = if level < 3 { 3 } else { 1 };
    let mut times = Vec::new();
    let mut evaluations = 0;
    let each = 1.0 / f64::from(rounds + 1);
    for round in 0..rounds {
        let mut watch = part(watch, f64::from(round) * each, each);
        let started = Instant::now();
        evaluations = case
            .run(&plan, Keep::default(), &mut watch)?
            .cost
            .evaluations;
        times.push(started.elapsed().as_secs_f64());
    }
    let mut watch = part(watch, 1.0 - each, each);
    let OnMesh {
        results, folded, ..
    } = at_level(&other, level, &mut watch)?;
    Ok(Level {
        level,
        seconds: median(times).expect("at least one round"),
        element_evaluations: evaluations * case.eye.elements_per_evaluation(),
        errors: results.difference_percent(&results),
        results,
        folded: folded.is_some(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::watch::unwatched;

    /// The watch stops it at its first word beyond `limit`, and hears nothing after that.
    #[test]
    fn it_can_be_stopped_within_every_run_that_it_makes() {
        let scenario = Scenario {
            window_ms: 0.4,
            ..Scenario::default()
        };
        for limit in [0.0, 0.05, 0.3, 0.62, 0.9] {
            let (mut last, mut after) = (0.0, 0);
            let outcome = measure(&scenario.check().unwrap(), 2, &mut |share| {
                assert!((last..=1.0).contains(&share), "{share} after {last}");
                after += usize::from(last > limit);
                last = share;
                if share > limit {
                    ControlFlow::Break(())
                } else {
                    ControlFlow::Continue(())
                }
            });
            assert_eq!(outcome.unwrap_err(), Refusal::Cancelled);
            assert_eq!(after, 0, "{limit}");
            assert!(last - limit < 0.1, "{limit}: only at {last}");
        }
    }

    #[test]
    fn the_front_is_beaten_by_nobody_and_the_choices_meet_their_targets() {
        let scenario = Scenario {
            window_ms: 0.4,
            ..Scenario::default()
        };
        let report = measure(&scenario.check().unwrap(), 2, &mut unwatched).unwrap();
        let front: Vec<&Point> = report.points.iter().filter(|p| p.on_front).collect();
        assert!(!front.is_empty());
        for a in &front {
            for b in &report.points {
                assert!(!(b.seconds < a.seconds && b.error() < a.error()));
            }
        }
        for (target, best) in TARGETS.iter().zip(report.best) {
            assert!(report.points[best.unwrap()].error() <= *target);
        }
        assert_eq!(report.levels.len(), 2);
        assert_eq!(report.levels[1].errors.headline(), 0.0);
    }
}
