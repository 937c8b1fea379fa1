//! What the samples of an ensemble say together: bands, what drives them, and their counts.
//!
//! The bands hold every sample that ran. Those whose mesh folded are beyond the model's validity
//! and are counted, but they stay: they are the hardest hit, and bands without them too low.
//!
//! Left out: how sure the quantiles themselves are.

use crate::answer::{brief::BriefAnswer, uncertain::UncertainInput};
use crate::many::ensemble::{Ensemble, PILOT};
use crate::many::statistics::{quantile, rank_correlation};
use crate::run::quantity::Quantity;

/// A result that leaves its band by less than this share of it has not left it.
const WIDTH_OF_NOTHING: f64 = 1e-3;
/// A weaker rank correlation explains nothing.
const SMALLEST_DRIVER: f64 = 0.1;

/// Median and a band, which holds nine in ten, of a risk eight in ten.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Band {
    /// The share [`TAIL`] lies below.
    pub low: f64,
    /// Half lies below.
    pub median: f64,
    /// The share [`TAIL`] lies above.
    pub high: f64,
}

/// The share of the samples beyond each end of a band.
pub const TAIL: f64 = 0.05;

/// What the checks of the step error found.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Checks {
    /// Samples checked, unfolded.
    pub count: usize,
    /// How many of them had to take a shorter step.
    pub refined: usize,
    /// How many of those after the pilot, whose step was what the unchecked ones take.
    pub missed: usize,
    /// Largest error at the step tried first, after the pilot, in %, if any was checked there.
    pub first: Option<f64>,
    /// Largest error at the step taken, in %.
    pub last: f64,
    /// The same of results that lead, in %.
    pub leading: f64,
}

impl Ensemble {
    /// Whether the ensemble was stopped before its last sample.
    pub fn stopped(&self) -> bool {
        self.samples.len() < self.asked as usize
    }

    /// The samples that the bands hold, each with its number: all that ran.
    pub fn valid(&self) -> impl Iterator<Item = (usize, &BriefAnswer)> {
        let all = self.samples.iter().enumerate();
        all.filter_map(|(index, sample)| Some((index, sample.outcome.as_ref().ok()?)))
    }

    /// Which samples the bands hold, in words.
    pub fn which(&self) -> String {
        let folded = self.folded();
        let folded = (folded > 0)
            .then(|| format!(" The mesh of {folded} folded, beyond the model's validity."));
        format!("those that ran.{}", folded.unwrap_or_default())
    }

    /// Samples whose mesh folded.
    pub fn folded(&self) -> usize {
        self.valid().filter(|(_, point)| point.folded()).count()
    }

    /// What samples were flagged with or refused for, and how many of each, by name.
    pub fn counts(&self) -> Vec<(String, usize)> {
        let names = self.samples.iter().flat_map(|sample| match &sample.outcome {
            Ok(point) => point.flags.iter().map(|flag| flag.name().to_owned()).collect(),
            Err(name) => vec![format!("refused: {name}")],
        });
        let mut counts = std::collections::BTreeMap::new();
        names.for_each(|name| *counts.entry(name).or_insert(0) += 1);
        counts.into_iter().collect()
    }

    /// The values of one result over the valid samples; none where a sample has none.
    pub fn values(&self, of: Quantity) -> Option<Vec<f64>> {
        self.valid().map(|(_, point)| point.values[of]).collect()
    }

    /// The band of a result; none where the scene has no such result, or no sample, and none of a
    /// risk, which has a range of its own.
    pub fn band(&self, of: Quantity) -> Option<Band> {
        if of.is_risk() {
            return None;
        }
        let mut values = self.values(of)?;
        values.sort_by(f64::total_cmp);
        let finite = values.iter().all(|v| v.is_finite());
        let at = |p| quantile(&values, p).filter(|_| finite);
        Some(Band { low: at(TAIL)?, median: at(0.5)?, high: at(1.0 - TAIL)? })
    }

    /// Whether a result of the scenario as it stands lies outside its band, and what may be why: of
    /// the inputs at an end of what they are drawn from the one that drives the result most.
    pub fn outside(&self, of: Quantity) -> Option<Option<&UncertainInput>> {
        let (band, nominal) = (self.band(of)?, self.nominal.as_ref()?[of]?);
        // What is not drawn has a band of no width, and rounding is no news.
        let slack = WIDTH_OF_NOTHING * band.median.abs();
        let inside = (band.low - slack..=band.high + slack).contains(&nominal);
        let at_an_end = |(input, r): (usize, f64)| {
            let input = &self.inputs[input];
            (input.stands_at_an_end() && r.abs() >= SMALLEST_DRIVER).then_some(input)
        };
        (!inside).then(|| self.drivers(of).into_iter().find_map(at_an_end))
    }

    /// The results that have a band.
    pub fn results(&self) -> Vec<Quantity> {
        Quantity::ALL.iter().copied().filter(|of| self.band(*of).is_some()).collect()
    }

    /// Each input's index and rank correlation with a result, if any, the strongest first.
    pub fn drivers(&self, of: Quantity) -> Vec<(usize, f64)> {
        let Some(values) = self.values(of) else { return Vec::new() };
        let with = |input: usize| {
            let drawn =
                self.valid().map(|(sample, _)| self.drawn[sample * self.inputs.len() + input]);
            let drawn: Vec<f64> = drawn.collect();
            (input, rank_correlation(&drawn, &values))
        };
        let mut found: Vec<(usize, f64)> = (0..self.inputs.len()).map(with).collect();
        found.sort_by(|a, b| b.1.abs().total_cmp(&a.1.abs()));
        found
    }

    /// What the checks of unfolded samples found.
    pub fn checks(&self) -> Checks {
        let mut checks = Checks::default();
        for (index, sample) in self.samples.iter().enumerate() {
            let kept = sample.outcome.as_ref().ok().filter(|point| !point.folded());
            let Some(check) = kept.and_then(|point| point.check) else { continue };
            let refined = check.missed;
            checks.count += 1;
            checks.refined += usize::from(refined);
            if index >= PILOT as usize {
                checks.missed += usize::from(refined);
                checks.first = Some(checks.first.unwrap_or(0.0).max(check.first));
            }
            checks.last = checks.last.max(check.last);
            checks.leading = checks.leading.max(check.leading);
        }
        checks
    }
}
