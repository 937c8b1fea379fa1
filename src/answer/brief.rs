//! One run among many: results and flags without traces.
//!
//! A [`single`] run makes no second run. A [`checked`] one states its step error as answers do and
//! shortens its step until that is within [`promise_percent`]. A [`compared`] one is set beside a
//! run of twice as many steps, whose error is a sixteenth at fourth order: the difference is the
//! error itself, without a safety factor. No step helps once the mesh has folded.
//!
//! The automatic step, a share of the stability limit, is too short in a stiff eye and too long for
//! the edges of a pulse in a soft one. So a run among many may take up to 0.95 of the limit, but no
//! more than a cap, which comes from the comparisons of a few runs.

use crate::answer::directions::other_directions;
use crate::answer::{compiled::Compiled, results::Results, solve::solve_by};
use crate::injury::{Felt, Injury, PerInjury, hit, told};
use crate::run::rules::{LONGEST_SHARE, next_share, share_for};
use crate::run::{flags::FlagKind, kept::Keep, model::Run, plan::Plan, raised::of_motion};
use crate::run::{refusal::Refusal, watch::Watch};
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
    pub flags: Vec<FlagKind>,
    /// The step error, where it was checked.
    pub check: Option<Check>,
    /// The 80 % range of each risk, 0 to 1, with the step error that was found, or else promised.
    pub ranges: Option<PerInjury<(f64, f64)>>,
}

/// What a check of the step error found, in %.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Check {
    /// The error at the step that was tried first.
    pub first: f64,
    /// The error at the step that was taken in the end.
    pub last: f64,
    /// The step that was tried first, in s.
    pub tried: f64,
    /// The step, in s, at which the first error would just be the promised one.
    pub good_step: f64,
}

impl BriefAnswer {
    /// Whether the mesh folded, so that the values are beyond the model's validity.
    pub fn folded(&self) -> bool {
        self.flags.contains(&FlagKind::MeshFolded)
    }

    /// Whether the eye was pressed flat, of which no error is stated.
    pub fn pressed_flat(&self) -> bool {
        self.flags.contains(&FlagKind::EyeFlat)
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
        && !plan.integrator.method().adaptive()
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
    let first = answer.errors.time_step.headline();
    let tried = plan.step;
    let good_step = plan.step * shortening(&plan, promise, first);
    if scenario.numerics.step_us.is_none() {
        for _ in 0..MAX_ATTEMPTS {
            let error = answer.errors.time_step.headline();
            if error <= promise || answer.run.folded_at().is_some() {
                break;
            }
            plan.step *= next_share(promise, error, plan.integrator.method().order);
            answer = solve_by(answer.case, plan, watch)?;
        }
    }
    answer.others = other_directions(scenario, watch)?;
    let range = |injury: &Injury| Some(answer.risk(*injury)?.hit.ends());
    let ranges: Option<Vec<(f64, f64)>> = Injury::ALL.iter().map(range).collect();
    let stated = answer.errors.time_step_percent();
    Ok(BriefAnswer {
        ranges: ranges.and_then(|ranges| ranges.try_into().ok()),
        values: answer.results(),
        flags: answer.flags.iter().map(|flag| flag.kind).collect(),
        check: stated.map(|last| Check { first, last, tried, good_step }),
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
    let mut first = None;
    for attempt in 0.. {
        plan.multiple *= 2.0;
        plan.local_tolerance *= 0.1;
        let fine = run(&plan)?;
        let difference = case.results(&coarse).difference_percent(&case.results(&fine));
        let error = difference.headline();
        let first = *first.get_or_insert(error);
        let done = error <= promise
            || coarse.folded_at().is_some()
            || scenario.numerics.step_us.is_some()
            || attempt == MAX_ATTEMPTS;
        if done {
            let mut answer = brief(&case, &coarse);
            answer.check = (!answer.pressed_flat()).then(|| Check {
                first,
                tried: plan.step,
                last: error,
                good_step: plan.step * shortening(&plan, promise, first),
            });
            return Ok(answer);
        }
        coarse = fine;
    }
    unreachable!("the last attempt is always taken")
}

/// The factor on the step that brings a step error to `promise`, both in %.
fn shortening(plan: &Plan, promise: f64, error: f64) -> f64 {
    share_for(promise, error, plan.integrator.method().order)
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
