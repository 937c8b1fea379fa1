//! One run among many: results and flags without traces.
//!
//! A [`single`] run makes no second run. A [`checked`] one states its step error as answers do and
//! shortens its step until that of the leading results is within [`promise_percent`]. A
//! [`compared`] one is set beside a run of twice as many steps, whose error is 2^-p of its own at
//! order p: with d the difference, its own is s d/(1 - 2^-p). At fourth order d is the error itself
//! and s is 1; eyes of cells have p = 1 and an s of their own. What is stated is the largest error
//! of all results, those that only an injury is read from included. No step helps once the mesh has
//! folded.
//!
//! The automatic step, a share of the stability limit, is too short in a stiff eye and too long for
//! the edges of a pulse in a soft one. So a run among many may take up to 0.95 of the limit, but no
//! more than a cap, which comes from the comparisons of a few runs.

use crate::answer::directions::other_directions;
use crate::answer::{compiled::Compiled, results::Results, solve::Answer, solve::solve_by};
use crate::injury::{Felt, Injury, PerInjury, hit, told};
use crate::run::rules::{LONGEST_SHARE, next_share, share_for};
use crate::run::{flags::FlagKind, flags::FlagKinds, kept::Keep, model::Run, plan::Plan};
use crate::run::{raised::of_motion, refusal::Refusal, watch::Watch};
use crate::scenario::{CheckedScenario, Scenario};

/// How often a step is shortened, each time at most to a half.
const MAX_ATTEMPTS: usize = 6;

/// The step error that runs of `scenario` among many keep to, in %.
pub fn promise_percent(scenario: &CheckedScenario) -> f64 {
    Compiled::new(scenario).rules().promise_percent
}

/// The answer of one run among many.
#[derive(Debug, Clone, PartialEq)]
pub struct BriefAnswer {
    /// Every result.
    pub values: Results,
    /// What limits them; flags that need the step error only where it was checked.
    pub flags: FlagKinds,
    /// The step error, where it was checked.
    pub check: Option<Check>,
    /// The 80 % range of each risk, 0 to 1, with the step error that was found, or else promised.
    pub ranges: Option<PerInjury<(f64, f64)>>,
}

/// What a check of the step error found, in %.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Check {
    /// The largest error of a result at the step that was tried first.
    pub first: f64,
    /// The largest error of a result at the step that was taken in the end.
    pub last: f64,
    /// The same of those that lead, which the promise is of.
    pub leading: f64,
    /// Whether a leading result missed the promise at first, so that the step was shortened.
    pub missed: bool,
    /// The step that was tried first, in s.
    pub tried: f64,
    /// The step, in s, at which the first error of leading results would just be the promised one.
    pub good_step: f64,
}

impl BriefAnswer {
    /// Whether the mesh folded, so that the values are beyond the model's validity.
    pub fn folded(&self) -> bool {
        self.flags.contains(FlagKind::MeshFolded)
    }

    /// Whether the eye was pressed flat, of which no error is stated.
    pub fn pressed_flat(&self) -> bool {
        self.flags.contains(FlagKind::EyeFlat)
    }
}

fn brief(case: &Compiled, run: &Run) -> BriefAnswer {
    let motion = of_motion(run, case.rules().element, None);
    BriefAnswer {
        values: case.results(run),
        flags: motion.iter().chain(&run.flags).map(|flag| flag.kind).collect(),
        check: None,
        ranges: None,
    }
}

/// The automatic step, but up to `cap`, in s, as far as stability allows; one that is set stays.
fn plan(scenario: &Scenario, case: &Compiled, cap: Option<f64>) -> Result<Plan, Refusal> {
    let mut plan = case.plan(scenario)?;
    if let (Some(cap), None) = (cap, scenario.numerics.step_us)
        && !plan.integrator.chooses_its_steps()
        && case.rules().may_lengthen
    {
        plan.step = cap.min(LONGEST_SHARE * case.step_limit(plan.integrator));
    }
    Ok(plan)
}

/// Runs a scenario once, with steps up to `cap`, in s, or else the automatic ones. Risks are means
/// over the directions that the blow may have come from.
///
/// # Errors
/// As for any run.
pub fn single(
    scenario: &CheckedScenario,
    cap: Option<f64>,
    watch: Watch,
) -> Result<BriefAnswer, Refusal> {
    let case = Compiled::new(scenario);
    let plan = plan(scenario, &case, cap)?;
    let run = case.run(&plan, Keep::default(), watch)?;
    let mut answer = brief(&case, &run);
    let others = other_directions(scenario, watch)?;
    if let (Some(own), Some(blow)) = (case.felt(&run), &case.blow) {
        let several = !others.is_empty();
        let step = 0.01 * case.rules().promise_percent;
        let all: Vec<Felt> = std::iter::once(own).chain(others).collect();
        if several {
            for injury in Injury::ALL {
                let sum: f64 = all.iter().map(|felt| told(blow, *injury, felt)).sum();
                answer.values[injury.result()] = Some(1e2 * sum / all.len() as f64);
            }
        }
        let with_step =
            |felt: Felt| Felt { errors: felt.errors.map(|e| libm::hypot(e, step)), ..felt };
        let all: Vec<Felt> = all.into_iter().map(with_step).collect();
        answer.ranges = Some(std::array::from_fn(|j| hit(blow, Injury::ALL[j], &all).ends()));
    }
    Ok(answer)
}

/// Runs a scenario with its step error, and again with shorter steps while that is too large.
///
/// # Errors
/// As for any run.
pub fn checked(scenario: &CheckedScenario, watch: Watch) -> Result<BriefAnswer, Refusal> {
    let case = Compiled::new(scenario);
    let promise = case.rules().promise_percent;
    let mut plan = case.plan(scenario)?;
    let mut answer = solve_by(case, plan, watch)?;
    let stated = |answer: &Answer| {
        let worst = answer.errors.time_step.worst_listed(&answer.results());
        worst.map_or(0.0, |(_, error)| error)
    };
    let leading = |answer: &Answer| answer.errors.time_step.headline();
    let (first, at_first, tried) = (stated(&answer), leading(&answer), plan.step);
    let order = answer.case.order(plan.integrator);
    let (missed, good_step) = (at_first > promise, tried * share_for(promise, at_first, order));
    if scenario.numerics.step_us.is_none() {
        for _ in 0..MAX_ATTEMPTS {
            let error = leading(&answer);
            if error <= promise || answer.run.folded_at().is_some() {
                break;
            }
            plan.step *= next_share(promise, error, order);
            answer = solve_by(answer.case, plan, watch)?;
        }
    }
    answer.set_others(other_directions(scenario, watch)?);
    let is_known = answer.errors.time_step_percent().is_some();
    let (last, leading) = (stated(&answer), leading(&answer));
    Ok(BriefAnswer {
        ranges: answer.assessed().map(|risks| risks.map(|risk| risk.hit.ends())),
        values: answer.results(),
        flags: answer.flags.iter().map(|flag| flag.kind).collect(),
        check: is_known.then_some(Check { first, last, leading, missed, tried, good_step }),
    })
}

/// Runs a scenario with steps up to `cap`, in s, then with twice as many until two runs agree.
///
/// # Errors
/// As for any run.
pub fn compared(
    scenario: &CheckedScenario,
    cap: Option<f64>,
    watch: Watch,
) -> Result<BriefAnswer, Refusal> {
    let case = Compiled::new(scenario);
    let mut plan = plan(scenario, &case, cap)?;
    let promise = case.rules().promise_percent;
    let mut run = |plan: &Plan| case.run(plan, Keep::default(), &mut *watch);
    let mut coarse = run(&plan)?;
    let order = case.order(plan.integrator);
    let factor = case.rules().estimate.doubled_safety / (1.0 - 0.5_f64.powi(order));
    let (family, share) = case.rules().estimate.family;
    let mut first = None;
    for attempt in 0.. {
        plan.multiple *= 2.0;
        plan.local_tolerance *= 0.1;
        let fine = run(&plan)?;
        let results = case.results(&coarse);
        let errors = results
            .difference_percent(&case.results(&fine))
            .map(|_, difference| difference.map(|d| factor * d))
            .raised(family, share);
        let last = errors.worst_listed(&results).map_or(0.0, |(_, error)| error);
        let leading = errors.headline();
        let (first, at_first) = *first.get_or_insert((last, leading));
        let done = leading <= promise
            || coarse.folded_at().is_some()
            || scenario.numerics.step_us.is_some()
            || attempt == MAX_ATTEMPTS;
        if done {
            let mut answer = brief(&case, &coarse);
            answer.check = (!answer.pressed_flat()).then(|| Check {
                first,
                last,
                leading,
                missed: at_first > promise,
                tried: plan.step,
                good_step: plan.step * share_for(promise, at_first, order),
            });
            return Ok(answer);
        }
        coarse = fine;
    }
    unreachable!("the last attempt is always taken")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::watch::unwatched;

    /// Whether all results are those of steps that are as short as `exact`'s.
    fn assert_right(answer: &BriefAnswer, exact: &BriefAnswer) {
        for (quantity, a) in answer.values.present() {
            let b = exact.values[quantity].unwrap();
            assert!((a / b - 1.0).abs() < 1e-3, "{a} {b}");
        }
    }

    #[test]
    fn both_checks_shorten_the_step_until_the_promise_is_kept() {
        let scenario = CheckedScenario::default();
        let promise = promise_percent(&scenario);
        let stated = checked(&scenario, &mut unwatched).unwrap();
        let check = stated.check.unwrap();
        assert!(check.last <= promise && check.first >= check.last);
        let free = compared(&scenario, Some(1.0), &mut unwatched).unwrap();
        let tight = compared(&scenario, Some(1e-6), &mut unwatched).unwrap();
        assert!(tight.check.unwrap().first < free.check.unwrap().first);
        assert_right(&stated, &tight);
        assert_right(&free, &tight);
    }

    #[test]
    fn a_rough_step_is_refined_and_what_it_would_have_been_is_said() {
        let promise = promise_percent(&CheckedScenario::default());
        let mut scenario = Scenario::default();
        scenario.numerics.integrator = Some(crate::scenario::Integrator::VelocityVerlet);
        let answer = compared(&scenario.check().unwrap(), Some(1.0), &mut unwatched).unwrap();
        let check = answer.check.unwrap();
        assert!(check.first > promise && check.last <= promise);
        let exact = compared(&CheckedScenario::default(), Some(1e-6), &mut unwatched).unwrap();
        assert_right(&answer, &exact);
    }

    #[test]
    fn a_step_of_the_persons_own_stays() {
        let mut scenario = Scenario::default();
        scenario.numerics.step_us = Some(2.0);
        let case = Compiled::new(&scenario.check().unwrap());
        assert_eq!(plan(&scenario, &case, Some(1.0)).unwrap().step, 2e-6);
    }
}
