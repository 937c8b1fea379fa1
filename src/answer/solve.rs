//! One scenario answered: results, their errors, and what limits them.
//!
//! The step error of each result comes from a second run with another step: the idea is in
//! [`crate::run::rules`], the second run and all numbers with each model.

use crate::answer::compiled::Compiled;
use crate::answer::directions::other_directions;
use crate::answer::results::{Limits, Results};
use crate::answer::validity::{Spoiled, spoiled};
use crate::injury::{DamageIndex, Felt, Injury, PerInjury, Risk, assess, hit, worse};
use crate::run::flags::{Flag, FlagKind, LATE_PEAK_SHARE, has};
use crate::run::kept::{Keep, Peak};
use crate::run::raised::{TwoRuns, of_motion};
use crate::run::{model::Run, ordered::until, plan::Plan, quantity::Quantity, refusal::Refusal};
use crate::run::{rules::next_share, threads::beside, watch::Watch};
use crate::scenario::{CheckedScenario, Scenario};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

/// How far each result may be off.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Errors {
    /// By the time step, in % of each result; none of an eye that is pressed flat.
    pub time_step: Results,
    /// By the mesh, in % of each result, once it has been estimated.
    pub mesh: Option<Results>,
    /// The limits that finer meshes tend to, once they have been estimated.
    pub limits: Option<Limits>,
    /// Energy residual, in % of the work in.
    pub energy_balance: f64,
}

impl Errors {
    /// Largest step error of a leading result, in %; none where none is stated.
    pub fn time_step_percent(&self) -> Option<f64> {
        Some(self.time_step.worst()?.1)
    }

    /// Largest mesh error of a leading result that has a limit, in %; none until it is estimated.
    pub fn mesh_percent(&self) -> Option<f64> {
        Some(self.mesh.as_ref()?.worst()?.1)
    }

    /// The results that have no limit as the mesh gets finer, or none that could be seen.
    pub fn without_limit(&self) -> impl Iterator<Item = Quantity> {
        let mesh = self.mesh.as_ref();
        let unknown = move |of: &Quantity| mesh.is_some_and(|mesh| mesh[*of].is_none());
        self.time_step.present().map(|(of, _)| of).filter(unknown)
    }
}

/// The share of what hurts half of all eyes below which no injury hangs on what a tissue felt.
const OF_NO_ACCOUNT: f64 = 0.1;

/// What a run that ended too early says of a result.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cut {
    /// It may still grow, and never falls.
    AtLeast,
    /// It may still grow or fall.
    NotFinal,
}

/// A scenario's answer.
#[derive(Debug, Clone)]
pub struct Answer {
    /// The eye, and what hits it.
    pub case: Compiled,
    /// The integrator and the step that were asked of it.
    pub plan: Plan,
    /// Longest step taken, in s; where steps follow the motion, the step at rest.
    pub step: f64,
    /// Largest stable step of the integrator, in s, of the eye at rest.
    pub step_limit: f64,
    /// What the run gave and cost.
    pub run: Run,
    /// How far the results may be off.
    pub errors: Errors,
    /// What tissues felt of the other directions that the blow may have come from.
    pub others: Vec<Felt>,
    /// The risk of each injury, kept from the first time that somebody asks, as screens do in every
    /// frame; empty before.
    pub assessed: OnceLock<Option<PerInjury<Risk>>>,
    /// What limits the results: the flags of the run, and those that follow from the errors.
    pub flags: Vec<Flag>,
    /// Springs or cells computed in the run.
    pub element_evaluations: usize,
    /// Time the run took, the mesh and the second run left out.
    pub solve_time: Duration,
    /// Time that everything took.
    pub total_time: Duration,
}

impl Answer {
    /// Every result.
    pub fn results(&self) -> Results {
        Results::from_fn(|of| self.result(of))
    }

    /// One result in its unit, if the scene has it; a risk over all directions.
    pub fn result(&self, of: Quantity) -> Option<f64> {
        match Injury::of(of).filter(|_| !self.others.is_empty()) {
            Some(injury) => Some(1e2 * hit(self.case.blow.as_ref()?, injury, &self.felt()).told),
            None => self.case.result(of, &self.run),
        }
    }

    /// The paper's index and its parts.
    pub fn index(&self) -> DamageIndex {
        DamageIndex::of(&self.run.readings)
    }

    /// The peak behind a result, in SI, with its time; none for a result that is no peak.
    pub fn peak(&self, of: Quantity) -> Option<Peak> {
        self.run.readings.peak(of)
    }

    /// Whether a flag of this kind limits the results.
    pub fn has(&self, kind: FlagKind) -> bool {
        has(&self.flags, kind)
    }

    /// Whether the eye was pressed flat: no window and no step tells more.
    pub fn pressed_flat(&self) -> bool {
        self.has(FlagKind::EyeFlat)
    }

    /// Simulated time that was asked for, in s; where none was, how long the run lasted.
    pub fn window(&self) -> f64 {
        if self.case.ends_by_itself() { self.run.simulated } else { self.case.window() }
    }

    /// Why nothing that was computed can be believed, and what to do about it, if that is so.
    pub fn spoiled(&self) -> Option<Spoiled> {
        spoiled(&self.flags, self.case.rules())
    }

    /// The risk of each injury: a globe first, as it must not be missed, then by what is told; none
    /// where [`Self::silence`] says why.
    pub fn risks(&self) -> Vec<Risk> {
        let mut risks = self.assessed().map_or_else(Vec::new, |risks| risks.to_vec());
        if let [_, rest @ ..] = &mut risks[..] {
            rest.sort_by(|a, b| b.share().told.total_cmp(&a.share().told));
        }
        risks
    }

    /// The risk of one injury.
    pub fn risk(&self, injury: Injury) -> Option<Risk> {
        Some(self.assessed()?[injury as usize])
    }

    /// Takes what tissues felt of the other directions.
    pub(crate) fn set_others(&mut self, others: Vec<Felt>) {
        self.others = others;
        self.assessed = OnceLock::new();
    }

    /// The risk of each injury in their order; none where [`Self::silence`] says why.
    pub(crate) fn assessed(&self) -> Option<&PerInjury<Risk>> {
        self.assessed.get_or_init(|| self.assess()).as_ref()
    }

    fn assess(&self) -> Option<PerInjury<Risk>> {
        let felt = self.felt();
        if felt.is_empty() || self.silence().is_some() {
            return None;
        }
        let blow = self.case.blow.as_ref()?;
        // Bone that breaks lets an object in, and what presses an eye flatter than any test did may
        // do more than is read; where likes of it were counted, so it was there.
        let breaks = self.has(FlagKind::BoneMayBreak) && blow.near.is_none();
        let flatter = self.has(FlagKind::BeyondTests) && (blow.unusual || blow.near.is_none());
        let cut = |j: usize| self.at_least(Injury::ALL[j].measure()) || breaks || flatter;
        let usable = self.no_risks().is_none();
        Some(assess(blow, &felt, &std::array::from_fn(cut)).map(|risk| Risk { usable, ..risk }))
    }

    /// Why no risk can be told of what was computed, and what to do about it, if that is so.
    pub fn no_risks(&self) -> Option<Spoiled> {
        let flat = Spoiled {
            why: "eye pressed flat: worse than the model can tell".to_owned(),
            next: "take the globe as open until it is seen to be closed",
        };
        if !self.pressed_flat() {
            return self.spoiled();
        }
        // Blows of a kind that clinics counted were fitted through eyes as flat.
        let fitted = self.case.blow.is_some_and(|blow| blow.near.is_some() && !blow.unusual);
        (!fitted).then_some(flat)
    }

    /// The chance that this blow is worse than another for each injury, with what both share taken
    /// out; none where either tells no risks.
    pub fn worse(&self, other: &Self) -> Option<PerInjury<f64>> {
        let told = |answer: &Self| !answer.risks().is_empty() && answer.no_risks().is_none();
        let (own, others) = (self.case.blow.as_ref()?, other.case.blow.as_ref()?);
        let (a, b) = (self.felt(), other.felt());
        let chance = |j: usize| worse(Injury::ALL[j], (own, &a), (others, &b));
        (told(self) && told(other)).then(|| std::array::from_fn(chance))
    }

    /// What the tissues felt, from each direction that the blow may have come from.
    pub fn felt(&self) -> Vec<Felt> {
        let Some(own) = self.case.felt(&self.run) else { return Vec::new() };
        let steps: PerInjury<f64> = std::array::from_fn(|j| {
            let injury = Injury::ALL[j];
            // An eye that is pressed flat has no step error, but one mesh differs from another.
            let flat = if self.pressed_flat() { injury.curve().mesh_unknown } else { 0.0 };
            self.errors.time_step[injury.measure()].map_or(flat, |step| 0.01 * step)
        });
        let with_steps = |felt: Felt| {
            let errors = std::array::from_fn(|j| libm::hypot(felt.errors[j], steps[j]));
            Felt { errors, ..felt }
        };
        std::iter::once(own).chain(self.others.iter().copied()).map(with_steps).collect()
    }

    /// Why there are no risks, in one line; none where there are.
    pub fn silence(&self) -> Option<&'static str> {
        let any = self.run.readings[Injury::GlobeRupture.measure()];
        if any.is_none() && !self.run.missed {
            return Some(self.case.rules().silence);
        }
        let missed = self.run.missed && self.others.is_empty();
        missed.then_some("none: the object never touches the eye")
    }

    /// How a run that ended too early limits a result; none if it is final.
    pub fn cut(&self, of: Quantity) -> Option<Cut> {
        use FlagKind::{ContactCut, EyeFlat, PulseCut, WindowCapped, WindowShort};
        let has = |kinds: &[FlagKind]| self.flags.iter().any(|flag| kinds.contains(&flag.kind));
        // A risk rests on what its tissue felt.
        let of = Injury::of(of).map_or(of, Injury::measure);
        if has(&[PulseCut, ContactCut, WindowCapped, EyeFlat]) {
            // What goes back gives energy back, of which the index holds a share.
            let falls = matches!(of, Quantity::Energy | Quantity::Damage);
            return Some(if falls { Cut::NotFinal } else { Cut::AtLeast });
        }
        let from = LATE_PEAK_SHARE * self.run.simulated;
        let late = |of| self.peak(of).is_some_and(|peak| peak.value > 0.0 && peak.time > from);
        // The index grows with its parts.
        let grows = match of {
            Quantity::Damage => late(Quantity::ShellGrowth) || late(Quantity::MeridianGrowth),
            of => late(of),
        };
        (grows && has(&[WindowShort])).then_some(Cut::AtLeast)
    }

    /// Whether the run ended while a result may still grow, which is then at least so large.
    pub fn at_least(&self, of: Quantity) -> bool {
        self.cut(of) == Some(Cut::AtLeast)
    }
}

/// Answers `scenario`; `watch` is told the share done and may stop it. An automatic step is
/// shortened while a leading result's step error is above 1 % and that helps.
///
/// # Errors
/// Refuses an unstable step, motion that leaves the finite numbers, and what the watch stops.
pub fn solve(scenario: &CheckedScenario, keep: Keep, watch: Watch) -> Result<Answer, Refusal> {
    let begun = Instant::now();
    let mut answer = solve_case(Compiled::new(scenario), scenario, keep, watch)?;
    answer.set_others(other_directions(scenario, watch)?);
    answer.total_time = begun.elapsed();
    Ok(answer)
}

/// Answers `case`, which was compiled from `scenario`.
pub(crate) fn solve_case(
    case: Compiled,
    scenario: &Scenario,
    keep: Keep,
    watch: Watch,
) -> Result<Answer, Refusal> {
    let begun = Instant::now();
    let mut plan = case.plan(scenario)?;
    let automatic = scenario.numerics.step_us.is_none();
    let rule = &case.rules().refinement;
    let mut attempts = if automatic { rule.attempts } else { 0 };
    let mut best: Option<(Plan, Measured)> = None;
    loop {
        let share = match measured(&case, &plan, keep, watch) {
            Ok(solved) => {
                let before = best.as_ref().map(|(_, solved)| solved);
                let error = |run: &Measured| run.errors.time_step.headline();
                let helps = before.is_none_or(|before| error(&solved) < 0.75 * error(before));
                let share = shorter(&case, &plan, &solved).filter(|_| helps);
                // Where the mesh folded, a shorter step need not be the better one.
                if before.is_none_or(|before| solved.is_better_than(before, rule.balance_percent)) {
                    best = Some((plan, solved));
                }
                share
            }
            // The bound of the step is for the mesh as it was built; crushed, it can be stiffer.
            Err(Refusal::NotFinite { .. }) if attempts > 0 => Some(0.5),
            Err(Refusal::NotFinite { .. }) if best.is_some() => None,
            Err(refusal) => return Err(refusal),
        };
        match share {
            Some(share) if attempts > 0 => plan.step *= share,
            _ => break,
        }
        attempts -= 1;
    }
    let Some((plan, solved)) = best else { return Err(Refusal::Cancelled) };
    let mut answer = finish(case, plan, solved);
    answer.total_time = begun.elapsed();
    Ok(answer)
}

/// The share of its step that a run should have taken; none where it was good, or no step helps.
fn shorter(case: &Compiled, plan: &Plan, solved: &Measured) -> Option<f64> {
    let error = solved.errors.time_step.headline();
    let rule = &case.rules().refinement;
    // Of a blow that is not over where time runs out no step makes more than a lower bound.
    if [FlagKind::EyeFlat, FlagKind::WindowCapped].iter().any(|kind| has(&solved.run.flags, *kind))
    {
        None
    } else if solved.errors.energy_balance > rule.balance_percent {
        Some(0.5)
    } else if solved.run.fold.is_none() && error > rule.error_percent {
        let order = case.order(plan.integrator);
        Some(next_share(rule.error_percent, error, order))
    } else {
        None
    }
}

/// Answers `case` by exactly `plan`.
pub(crate) fn solve_by(case: Compiled, plan: Plan, watch: Watch) -> Result<Answer, Refusal> {
    let solved = measured(&case, &plan, Keep::default(), watch)?;
    Ok(finish(case, plan, solved))
}

/// A run and its step error.
struct Measured {
    run: Run,
    errors: Errors,
    /// Largest difference between the leading results of the two runs, in %.
    disagreement: f64,
    time: Duration,
    total_time: Duration,
}

impl Measured {
    /// By its energy where one does not keep it to `balance_percent`, else by its step error.
    fn is_better_than(&self, other: &Self, balance_percent: f64) -> bool {
        let balance = |run: &Self| run.errors.energy_balance.max(balance_percent);
        let error = |run: &Self| run.errors.time_step.headline();
        (balance(self), error(self)) <= (balance(other), error(other))
    }
}

fn measured(case: &Compiled, plan: &Plan, keep: Keep, watch: Watch) -> Result<Measured, Refusal> {
    let started = Instant::now();
    let (second, factor) = case.second_plan(plan);
    let abandoned = AtomicBool::new(false);
    // The second run needs nothing of the first, so both go side by side.
    let other = || case.run(&second, Keep::default(), &mut until(&abandoned));
    let (second, (first, time)) = beside(other, || {
        let first = case.run(plan, keep, watch);
        let time = started.elapsed();
        if first.is_err() {
            abandoned.store(true, Ordering::Relaxed);
        }
        (first, time)
    });
    let run = first?;
    let results = case.results(&run);
    let difference = case.results(&second?).difference_percent(&results);
    let disagreement = difference.headline();
    let estimate = &case.rules().estimate;
    let (family, share) = estimate.family;
    let mut time_step = difference
        .map(|_, difference| difference.map(|d| factor * d + estimate.floor_percent))
        .raised(family, share)
        .no_finer_than_rounding(&results);
    if run.missed {
        // All of an eye that is not hit is exactly 0, but not how the object flies on.
        let exact = |of| results[of] == Some(0.0);
        time_step = time_step.map(|of, error| error.map(|e| if exact(of) { 0.0 } else { e }));
    }
    let errors =
        Errors { time_step, mesh: None, limits: None, energy_balance: 100.0 * run.energy_residual };
    Ok(Measured { run, errors, disagreement, time, total_time: started.elapsed() })
}

/// The largest step error, in %, but for what a tissue felt that is, with its error, less than a
/// tenth of what hurts half of all eyes: no injury hangs on it.
fn worst_of_account(case: &Compiled, run: &Run, errors: &Results) -> Option<(Quantity, f64)> {
    let results = case.results(run);
    let half = |of: Quantity| {
        let injury = Injury::ALL.iter().find(|injury| injury.measure() == of)?;
        Some(libm::exp10(case.blow.as_ref()?.point(*injury).log) * of.row().factor)
    };
    let idle = |of: Quantity, error: f64| {
        let felt = half(of).zip(results[of]);
        felt.is_some_and(|(half, felt)| felt * (1.0 + 1e-2 * error) < OF_NO_ACCOUNT * half)
    };
    errors.map(|of, error| error.filter(|error| !idle(of, *error))).worst_listed(&results)
}

fn finish(case: Compiled, plan: Plan, solved: Measured) -> Answer {
    let Measured { mut run, mut errors, disagreement, time, total_time } = solved;
    if has(&run.flags, FlagKind::EyeFlat) {
        // Steps and meshes may agree there, but nobody knows whether an eye does.
        let nothing = Results::default();
        (errors.time_step, errors.mesh) = (nothing, Some(nothing));
        errors.limits = Some(Limits::default());
    }
    let two_runs =
        TwoRuns { worst: worst_of_account(&case, &run, &errors.time_step), disagreement };
    let mut flags = of_motion(&run, case.rules().element, Some(two_runs));
    flags.append(&mut run.flags);
    Answer {
        step: case.longest_step(&plan),
        step_limit: case.step_limit(plan.integrator),
        element_evaluations: run.cost.evaluations * case.elements_per_evaluation(),
        run,
        errors,
        others: Vec::new(),
        assessed: OnceLock::new(),
        flags,
        solve_time: time,
        total_time,
        plan,
        case,
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::run::watch::unwatched;
    use crate::scenario::library::tests::preset;

    /// The answer to a scenario, with what is kept of it.
    pub(crate) fn answered_with(scenario: &Scenario, keep: Keep) -> Answer {
        solve(&scenario.check().unwrap(), keep, &mut unwatched).unwrap()
    }

    /// The answer to a scenario.
    pub(crate) fn answered(scenario: &Scenario) -> Answer {
        answered_with(scenario, Keep::default())
    }

    #[test]
    fn only_what_may_still_grow_at_the_end_of_the_run_is_at_least_so_large() {
        let of = |window_ms, name: &str| answered(&preset(name, &[("window_ms", window_ms)]));
        let (cut, whole) = (of("0.2", "bb-56"), of("3", "bb-56"));
        assert!(!Quantity::ALL.iter().any(|of| whole.at_least(*of)));
        assert!(cut.at_least(Quantity::Pressure) && cut.at_least(Quantity::GlobeRupture));
        // What bounces takes energy along.
        assert_eq!(cut.cut(Quantity::Energy), Some(Cut::NotFinal));
        assert_eq!(cut.cut(Quantity::Damage), Some(Cut::NotFinal));
        assert!(cut.risks()[0].cut && !whole.risks()[0].cut);
        // The pulse is over, its waves are not: what moves still grows, a force has had its peak.
        let paper = of("0.21", "paper-300n");
        assert!(paper.at_least(Quantity::MeridianGrowth) && paper.at_least(Quantity::Damage));
        assert!(!paper.at_least(Quantity::ForceTop));
        assert!(of("0.1", "paper-300n").at_least(Quantity::ForceTop), "the pulse is cut");
    }

    #[test]
    fn an_error_of_what_hurts_nobody_is_of_no_account() {
        let bb = |speed| answered(&preset("bb-56", &[("speed", speed), ("window_ms", "0.5")]));
        let worst = |answer: &Answer, error| {
            let mut errors = Results::default();
            errors[Quantity::Contact] = Some(1.0);
            errors[Quantity::EquatorStretch] = Some(error);
            worst_of_account(&answer.case, &answer.run, &errors)
        };
        let (slow, fast) = (bb("2"), bb("56"));
        assert_eq!(worst(&slow, 30.0), Some((Quantity::Contact, 1.0)));
        assert_eq!(
            worst(&slow, 1e12),
            Some((Quantity::EquatorStretch, 1e12)),
            "it may be anything"
        );
        assert!(worst(&slow, f64::NAN).is_some_and(|(of, _)| of == Quantity::EquatorStretch));
        assert_eq!(worst(&fast, 30.0), Some((Quantity::EquatorStretch, 30.0)));
    }

    #[test]
    fn a_run_that_met_its_cap_is_not_run_again() {
        let case = Compiled::new(&preset("bb-56", &[]).check().unwrap());
        let plan = case.plan(&preset("bb-56", &[])).unwrap();
        let after = |flags: Vec<Flag>| {
            let mut time_step = Results::default();
            time_step[Quantity::Contact] = Some(50.0);
            let errors = Errors { time_step, mesh: None, limits: None, energy_balance: 2.0 };
            let run = Run { flags, ..Run::default() };
            let (time, total_time) = (Duration::ZERO, Duration::ZERO);
            let solved = Measured { run, errors, disagreement: 50.0, time, total_time };
            shorter(&case, &plan, &solved)
        };
        let flag = |kind| vec![Flag::new(kind, "", None)];
        assert_eq!(after(Vec::new()), Some(0.5));
        assert_eq!(after(flag(FlagKind::RimStops)), Some(0.5));
        assert_eq!(after(flag(FlagKind::WindowCapped)), None);
    }

    #[test]
    fn a_result_is_the_largest_of_its_trace_or_its_end() {
        let keep = Keep { traces: true, frames: None };
        let answer = answered_with(&Scenario::default(), keep);
        let traces = answer.run.traces.as_ref().unwrap();
        for (quantity, trace) in Quantity::ALL.iter().filter_map(|q| Some((*q, q.row().trace?))) {
            let values = (trace.values)(traces);
            let Some(result) = answer.result(quantity) else {
                assert!(values.is_empty(), "{}", trace.label);
                continue;
            };
            let found = match answer.peak(quantity) {
                Some(_) => values.iter().copied().fold(0.0, f64::max),
                None => values[values.len() - 1],
            };
            // Between two steps it may have been a little larger.
            let share = found * quantity.row().factor / result;
            assert!((0.99..=1.0 + 1e-12).contains(&share), "{} {share}", trace.label);
        }
    }
}
