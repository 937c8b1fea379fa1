//! How far the answer may be off because the inputs are not known: many runs over their spreads.
//!
//! Sample i puts the i-th point of an Owen-scrambled Sobol sequence through the distributions of
//! its inputs, one dimension an [`UncertainInput`]. What a sample gives depends on the scenario,
//! the seed and its number alone, so the result is the same bits for any number of threads, a run
//! that was stopped after k samples is an ensemble of k, and may go on from there to the whole.
//!
//! Samples are single runs. The first [`PILOT`] are set beside runs of twice as many steps, which
//! gives the longest step that the others may take: a stiff eye that keeps the promise at its
//! longest stable step says nothing of soft ones, which may take longer. Of the others every
//! [`CHECK_EVERY`]th is compared as well, and refined where it misses [`promise_percent`].
//!
//! A sample keeps its results and no text, some 0.8 kB, in one piece of memory for all of them.
//!
//! What samples say together is a [`Band`](crate::many::bands::Band) for each result.
//!
//! Left out: the mesh error, which all samples share, inputs that hang together, and bands of
//! risks, which hold what is not known of eyes already.

use crate::answer::brief::{BriefAnswer, compared, promise_percent, single};
use crate::answer::results::Results;
use crate::answer::uncertain::{UncertainInput, inputs, put};
use crate::many::statistics::median;
use crate::run::{ordered, ordered::until, refusal::Refusal, refusal::unstopped, threads};
use crate::scenario::{CheckedScenario, Scenario};
use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

/// Fewest samples: a band of fewer says nothing.
pub const FEWEST_SAMPLES: u32 = 8;
/// Most samples that the sequence has for one seed.
pub const MAX_SAMPLES: u32 = 1 << 16;
/// Samples that are checked before all others.
pub const PILOT: u32 = 8;
/// After the pilot, one sample in this many is checked.
pub const CHECK_EVERY: u32 = 64;
/// The share of the longest good step of the pilot that the others may take.
const HEADROOM: f64 = 0.8;
/// One sample in this many is timed together with a run of the scenario itself.
const TIME_EVERY: usize = 50;

/// One sample.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// The answer, or the name of the refusal.
    pub outcome: Result<BriefAnswer, String>,
}

/// The times of an ensemble.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Timing {
    /// From the first sample to the last, in s.
    pub wall: f64,
    /// On all cores together, in s.
    pub cores: f64,
    /// A run of the scenario itself, results only, in s: the median of those among the samples.
    pub single: Option<f64>,
    /// Threads that shared the samples.
    pub threads: usize,
}

/// Many runs of one scenario.
#[derive(Clone)]
pub struct Ensemble {
    /// The inputs that are drawn.
    pub inputs: Vec<UncertainInput>,
    /// Results of the scenario as it stands.
    pub nominal: Option<Results>,
    /// The samples done, in their order.
    pub samples: Vec<Sample>,
    /// The values drawn for them: those of all inputs of the first, then of the next.
    pub drawn: Vec<f64>,
    /// How many were asked for.
    pub asked: u32,
    /// The seed.
    pub seed: u32,
    /// The longest step that was allowed after the pilot, in s.
    pub cap: Option<f64>,
    /// The step error that its runs keep to, in %.
    pub promise: f64,
    /// The times of its runs.
    pub timing: Timing,
}

/// What a refusal is counted under.
fn name(refusal: &Refusal) -> &'static str {
    match refusal {
        Refusal::Scenario(_) => "not_allowed",
        Refusal::IntegratorUnfit { .. } => "integrator_unfit",
        Refusal::StepAboveLimit { .. } => "step_above_limit",
        Refusal::WentThrough(_) => "went_through",
        Refusal::NotFinite { .. } => "not_finite",
        Refusal::StepTooShort { .. } | Refusal::WindowTooLong { .. } => "too_much_work",
        Refusal::ToleranceNotMet { .. } => "tolerance_not_met",
        Refusal::Cancelled => "cancelled",
    }
}

/// Called with the ensemble so far after each sample, on any thread; `Break` stops the rest.
pub type OnSample<'a> = &'a (dyn Fn(&Ensemble) -> ControlFlow<()> + Sync);

struct Job<'a> {
    scenario: &'a CheckedScenario,
    inputs: &'a [UncertainInput],
    seed: u32,
    cap: f64,
    stop: &'a AtomicBool,
}

impl Job<'_> {
    /// The scenario with sample number `index` in place of its nominal values.
    fn drawn(&self, index: u32) -> (Scenario, Vec<f64>) {
        let mut changed = Scenario::clone(self.scenario);
        changed.doubt.clear();
        let draw = |(dimension, input): (u32, &UncertainInput)| {
            // The sequence has 23 bits; the middle of its cell is never 0 or 1.
            let u =
                f64::from(sobol_burley::sample(index, dimension, self.seed)) + 0.5 / 8_388_608.0;
            input.value(u)
        };
        let values: Vec<f64> = (0..).zip(self.inputs).map(draw).collect();
        put(&mut changed, self.inputs, &values);
        (changed, values)
    }

    /// Sample number `index`; nothing if it was stopped.
    fn run(&self, index: u32) -> Option<(Sample, Vec<f64>)> {
        let (mut scenario, drawn) = self.drawn(index);
        let checked = match scenario.check() {
            Ok(checked) => checked,
            Err(error) => {
                let field = error.problems.first().map_or("", |p| p.field.as_str());
                return Some((Sample { outcome: Err(format!("{field} not allowed")) }, drawn));
            }
        };
        let mut watch = until(self.stop);
        let wants_check = index < PILOT || index.is_multiple_of(CHECK_EVERY);
        let run = if wants_check { compared } else { single };
        let mut outcome = run(&checked, Some(self.cap), &mut watch);
        if let Err(Refusal::StepAboveLimit { .. }) = outcome {
            // Left out, the stiff eyes would be missing from the bands.
            scenario.numerics.step_us = None;
            let free = scenario.check().map_err(Refusal::Scenario);
            outcome = free.and_then(|free| run(&free, Some(self.cap), &mut watch));
        }
        let outcome = unstopped(outcome)?.map_err(|refusal| name(&refusal).to_owned());
        Some((Sample { outcome }, drawn))
    }

    /// Adds the samples up to `to`; gives what single runs of the scenario took meanwhile, in s.
    fn gather(&self, to: u32, on_sample: OnSample, into: &mut Ensemble) -> Vec<f64> {
        let from = into.samples.len();
        let lacking = (to as usize).saturating_sub(from);
        into.samples.reserve_exact(lacking);
        into.drawn.reserve_exact(lacking * self.inputs.len());
        let mut singles = Vec::new();
        let job = |index: usize| {
            // Timed among the samples, so that a busy machine slows both alike.
            let single = index.is_multiple_of(TIME_EVERY).then(|| {
                let began = Instant::now();
                let _ = single(self.scenario, None, &mut until(self.stop));
                began.elapsed().as_secs_f64()
            });
            let began = Instant::now();
            let sample = self.run(index as u32)?;
            Some((sample, began.elapsed().as_secs_f64(), single))
        };
        ordered::run((from, to as usize), self.stop, job, |_, ((sample, drawn), took, single)| {
            into.samples.push(sample);
            into.drawn.extend(drawn);
            into.timing.cores += took;
            singles.extend(single);
            on_sample(into)
        });
        singles
    }
}

/// The longest step that the pilot allows, in s: a little below those at which the samples that
/// missed the promise would just keep it, or that any took. Infinite if all have folded.
fn longest_step(pilot: &[Sample]) -> f64 {
    let points = pilot.iter().filter_map(|s| s.outcome.as_ref().ok());
    let checks = points.filter(|p| !p.folded()).filter_map(|p| p.check);
    let tried = checks.clone().map(|check| check.tried).reduce(f64::max);
    let missed = checks.filter(|check| check.missed);
    let good = missed.map(|check| check.good_step).reduce(f64::min);
    good.or(tried).map_or(f64::INFINITY, |step| HEADROOM * step)
}

/// Runs `count` samples of `scenario`, or those that `known`, of the same scenario and seed,
/// lacks. Where `on_sample` breaks, or `stop` is set, the samples done so far are the result.
///
/// # Errors
/// Whatever the scenario itself is refused for.
pub fn run(
    scenario: &CheckedScenario,
    (count, seed): (u32, u32),
    known: Option<Ensemble>,
    stop: &AtomicBool,
    on_sample: OnSample,
) -> Result<Ensemble, Refusal> {
    let inputs = inputs(scenario);
    let began = Instant::now();
    // Nothing is known yet: the pilot takes the longest stable steps.
    let mut job = Job { scenario, inputs: &inputs, seed, cap: f64::INFINITY, stop };
    let count = count.min(MAX_SAMPLES);
    let mut ensemble = match known {
        Some(known) => Ensemble { asked: count, ..known },
        None => Ensemble {
            inputs: inputs.clone(),
            nominal: unstopped(single(scenario, None, &mut until(stop)))
                .transpose()?
                .map(|answer| answer.values),
            samples: Vec::new(),
            drawn: Vec::new(),
            asked: count,
            seed,
            cap: None,
            promise: promise_percent(scenario),
            timing: Timing { wall: 0.0, cores: 0.0, single: None, threads: threads::count() },
        },
    };
    let before = ensemble.timing.wall;
    let pilot = count.min(PILOT);
    let mut singles = job.gather(pilot, on_sample, &mut ensemble);
    let first = ensemble.samples.len().min(pilot as usize);
    job.cap = longest_step(&ensemble.samples[..first]);
    ensemble.cap = Some(job.cap).filter(|cap| cap.is_finite());
    if first == pilot as usize {
        singles.extend(job.gather(count, on_sample, &mut ensemble));
    }
    ensemble.timing.single = median(singles).or(ensemble.timing.single);
    ensemble.timing.wall = before + began.elapsed().as_secs_f64();
    Ok(ensemble)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::brief::Check;
    use crate::run::{flags::FlagKinds, quantity::Quantity, watch::stop_if};
    use crate::scenario::set::set;

    fn quick() -> Scenario {
        let mut scenario = Scenario { window_ms: Some(0.3), ..Scenario::default() };
        set(&mut scenario, "impact.force_n", "300 ± 20").unwrap();
        scenario
    }

    /// The same with all that is published held to be known, but for one input.
    fn sure(but: &str) -> Scenario {
        let mut sure = quick();
        let published = inputs(&quick()).into_iter().filter(|input| input.source.is_some());
        let known = published.map(|input| input.field.path).filter(|path| *path != but);
        sure.doubt.extend(known.map(|path| (path.to_owned(), 0.0)));
        sure
    }

    /// Runs it, or what `known` lacks, until there are `most` samples.
    fn part(scenario: &Scenario, of: (u32, u32), known: Option<Ensemble>, most: usize) -> Ensemble {
        let early = |so_far: &Ensemble| stop_if(so_far.samples.len() >= most);
        run(&scenario.check().unwrap(), of, known, &AtomicBool::new(false), &early).unwrap()
    }

    fn ensemble(scenario: &Scenario, count: u32, seed: u32) -> Ensemble {
        part(scenario, (count, seed), None, usize::MAX)
    }

    #[test]
    fn a_stopped_one_is_a_smaller_one_and_goes_on_to_the_whole() {
        let whole = ensemble(&quick(), 40, 1);
        for most in [3, 8, 16] {
            let early = part(&quick(), (40, 1), None, most);
            assert!(early.stopped() && !whole.stopped());
            assert_eq!(early.samples, whole.samples[..most]);
            let rest = part(&quick(), (40, 1), Some(early), usize::MAX);
            assert_eq!((rest.samples, rest.cap), (whole.samples.clone(), whole.cap));
        }
    }

    #[test]
    fn seeds_differ_and_what_is_known_for_sure_has_no_band() {
        let mut sure = sure("");
        let first = ensemble(&sure, 8, 1);
        assert_eq!(first.inputs.len(), 1);
        let b = first.band(Quantity::Damage).unwrap();
        assert_ne!(first.samples, ensemble(&sure, 8, 2).samples);
        assert!(b.low < b.median && b.median < b.high);
        assert!(first.drivers(Quantity::Damage)[0].1 > 0.99, "more force, more damage");
        sure.doubt.insert("impact.force_n".to_owned(), 0.0);
        let none = ensemble(&sure, 8, 1).band(Quantity::Damage).unwrap();
        assert!(none.low == none.median && none.median == none.high);
    }

    #[test]
    fn a_result_outside_its_band_is_found_with_the_input_at_an_end_of_its_spread() {
        let inputs = inputs(&quick());
        let ends = inputs.iter().filter(|i| i.source.is_some() && i.stands_at_an_end());
        let ends: Vec<&str> = ends.map(|input| input.field.path).collect();
        assert_eq!(ends, ["eye.lens_kpa", "eye.fat_kpa"]);
        let mut fat = sure("eye.fat_kpa");
        fat.doubt.insert("impact.force_n".to_owned(), 0.0);
        // Soft fat lets the eye go farther than the paper's own, which stands at the stiff end.
        let soft = ensemble(&fat, 32, 1);
        let apart = |of| soft.outside(of).map(|why| why.map(|input| input.field.path));
        assert_eq!(apart(Quantity::Energy), Some(Some("eye.fat_kpa")));
        let mut forced = ensemble(&sure(""), 32, 1);
        assert!(forced.outside(Quantity::Energy).is_none());
        forced.nominal.as_mut().unwrap()[Quantity::Energy] = Some(1e3);
        let why = forced.outside(Quantity::Energy);
        assert!(why.is_some_and(|why| why.is_none()), "no input stands at an end");
    }

    #[test]
    fn only_samples_that_miss_the_promise_shorten_the_step_of_the_others() {
        let sample = |first, tried, good_step| {
            let (last, missed) = (0.01, first > 0.1);
            let check = Some(Check { first, last, leading: last, missed, tried, good_step });
            let (values, flags) = (Results::from_fn(|_| None), FlagKinds::default());
            let answer = BriefAnswer { values, flags, check, ranges: None };
            Sample { outcome: Ok(answer) }
        };
        let (stiff, soft) = (sample(0.01, 2e-6, 3e-6), sample(0.2, 6e-6, 5e-6));
        let mixed = longest_step(&[stiff.clone(), soft]);
        assert!((mixed / (HEADROOM * 5e-6) - 1.0).abs() < 1e-12);
        let kept = longest_step(&[stiff, sample(0.02, 4e-6, 9e-6)]);
        assert!((kept / (HEADROOM * 4e-6) - 1.0).abs() < 1e-12);
        assert!(longest_step(&[]).is_infinite());
    }

    #[test]
    fn drawn_scenes_keep_the_rest_and_every_input_moves() {
        let (scenario, inputs) = (quick().check().unwrap(), inputs(&quick()));
        let stop = &AtomicBool::new(false);
        let job = Job { scenario: &scenario, inputs: &inputs, seed: 1, cap: f64::INFINITY, stop };
        let (one, drawn) = job.drawn(0);
        assert_eq!(one.window_ms, scenario.window_ms);
        assert!(drawn.iter().zip(job.drawn(1).1).all(|(a, b)| *a != b));
    }

    #[test]
    fn samples_that_may_not_be_are_counted_by_name() {
        let mut scenario = quick();
        set(&mut scenario, "impact.angle_deg", "40").unwrap();
        set(&mut scenario, "eye.opening_deg", "40 ± 5").unwrap();
        let ensemble = ensemble(&scenario, 16, 1);
        let refused = "refused: impact.angle_deg not allowed";
        let count = ensemble.counts().iter().find(|(n, _)| n == refused).unwrap().1;
        assert!((4..13).contains(&count), "{count}");
        assert_eq!(ensemble.valid().count() + count, 16);
    }
}
