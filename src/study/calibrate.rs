//! The one calibration of the Physiological model, so that anybody can repeat it.
//!
//! Three numbers are free, because the evidence leaves them open: the effective bulk modulus of the
//! globe's content and how much sclera and fat stiffen at the rate of a blow. The sum of squared
//! misfits over the fitted experiments is made least over their logarithms, within the published
//! spread: a scan of low-discrepancy points first, then a search along the axes from the best few of them.
//! The misfit of a row is its distance from the measured value in standard deviations (where a source
//! gives none, in units of the logarithm of 1.3), and 0 where the figure lies on the right side of a
//! one-sided limit or inside a band.
//!
//! Many points fit nearly as well as the best. Of those the one with most rows inside what was
//! measured, scatter included, is taken, and of several the one with the least misfit.
//!
//! Left out: weights between rows, and anything that was not fitted, which stays unseen here.

use super::case::{Refusal, Watch};
use super::experiments::{Band, EXPERIMENTS, Experiment, Reading};
use super::validate::{Row, readings, rows_of};
use crate::scenario::{Model, Physiological, Scenario};
use rayon::prelude::*;
use std::ops::ControlFlow;

/// A number that the evidence leaves open.
#[derive(Debug, Clone, Copy)]
pub struct Free {
    /// The field's path.
    pub path: &'static str,
    /// What it is.
    pub what: &'static str,
    /// Least and greatest value tried.
    pub range: (f64, f64),
    /// Where the range comes from.
    pub source: &'static str,
    get: fn(&Physiological) -> f64,
    set: fn(&mut Physiological, f64),
}

impl Free {
    /// Its value in `model`.
    pub fn of(&self, model: &Physiological) -> f64 {
        (self.get)(model)
    }
}

/// Everything that is fitted.
pub static FREE: [Free; 3] = [
    Free {
        path: "model.bulk_modulus_mpa",
        what: "effective bulk modulus, MPa",
        range: (20.0, 2200.0),
        source: "water is 2,200 MPa; coats and blood that give way make it less",
        get: |p| p.bulk_modulus_mpa,
        set: |p, v| p.bulk_modulus_mpa = v,
    },
    Free {
        path: "model.sclera_stiffening",
        what: "dynamic stiffening of the sclera",
        range: (0.385, 11.5),
        source: "1 to 30 MPa over 2.6 MPa; about 10 times at 29 strains a second (Kim 2012)",
        get: |p| p.sclera_stiffening,
        set: |p, v| p.sclera_stiffening = v,
    },
    Free {
        path: "model.fat_stiffening",
        what: "dynamic stiffening of the fat",
        range: (0.1, 10.0),
        source: "0.3 to 47 kPa at rest, times 10 at rate",
        get: |p| p.fat_stiffening,
        set: |p, v| p.fat_stiffening = v,
    },
];

/// A share of the logarithm that counts as one standard deviation where a source gives no spread.
const LOG_SD: f64 = 0.262;
/// Share of the area that counts as one standard deviation beyond the band.
const AREA_SD: f64 = 0.005;
/// Results of a mesh that folds scatter by about this share from one set of numbers to the next.
const SCATTER: f64 = 0.04;
/// Points of the scan that a search starts from.
const STARTS: usize = 4;
/// First and last step of the search, in logarithms.
const STEPS: (f64, f64) = (0.4, 0.02);
/// A point fits nearly as well as the best if its misfit is no more than this above it: 95 % for one
/// number if misfits are normal.
const NEARLY: f64 = 3.84;

/// What a calibration found.
#[derive(Debug, Clone)]
pub struct Fit {
    /// The best model.
    pub model: Physiological,
    /// Its sum of squared misfits.
    pub misfit: f64,
    /// The fitted rows at the best model.
    pub rows: Vec<Row>,
    /// For each free number, its range over all points tried that fit nearly as well.
    pub nearly: [(f64, f64); 3],
    /// Points tried.
    pub tried: usize,
}

/// One point and its misfit.
#[derive(Debug, Clone, Copy)]
struct Tried {
    at: [f64; 3],
    misfit: f64,
    /// How many rows lie inside what was measured, scatter included.
    inside: usize,
}

/// To three digits: what is printed is what was run.
fn rounded(value: f64) -> f64 {
    let unit = 10f64.powf(2.0 - value.log10().floor());
    (value * unit).round() / unit
}

fn model_at(at: [f64; 3]) -> Physiological {
    let mut model = Physiological::default();
    for (free, log) in FREE.iter().zip(at) {
        (free.set)(&mut model, rounded(log.exp()));
    }
    model
}

/// `scenario` with `model` in place of its own, if it is physiological.
fn fitted_with(scenario: Scenario, model: Physiological) -> Scenario {
    match scenario.model {
        Model::Paper | Model::Axisymmetric(_) => scenario,
        Model::Physiological(_) => Scenario {
            model: Model::Physiological(model),
            ..scenario
        },
    }
}

/// Squared misfit of one row.
fn squared(experiment: &Experiment, predicted: f64) -> f64 {
    let (low, high) = experiment.measured.limits();
    let beyond = |value: f64| (low - value).max(value - high).max(0.0);
    let z = match (experiment.measured, experiment.reading) {
        (Band::Spread(mean, sd), _) => (predicted - mean) / sd,
        (Band::Between(..), Reading::FarthestArea) => beyond(predicted) / AREA_SD,
        (Band::Between(low, high), _) => beyond(predicted) / (0.5 * (high - low)),
        (Band::Single(value, _), _) => (predicted / value).ln() / LOG_SD,
        (Band::Below(_) | Band::Above(_), _) if experiment.measured.holds(predicted) => 0.0,
        (Band::Below(limit) | Band::Above(limit), _) => (predicted / limit).ln() / LOG_SD,
    };
    z * z
}

/// Whether `predicted` and what lies within its scatter agree with what was measured.
fn surely_inside(experiment: &Experiment, predicted: f64) -> bool {
    let rest = match experiment.reading {
        Reading::FarthestArea => 1.0,
        _ => 0.0,
    };
    [1.0 - SCATTER, 1.0 + SCATTER]
        .into_iter()
        .all(|share| experiment.measured.holds(rest + share * (predicted - rest)))
}

fn fitted() -> impl Iterator<Item = &'static Experiment> {
    EXPERIMENTS.iter().filter(|e| e.fitted)
}

fn misfit(at: [f64; 3]) -> Tried {
    let model = model_at(at);
    let predicted = readings(fitted(), |scenario| fitted_with(scenario, model));
    let inside = fitted()
        .zip(&predicted)
        .filter(|(e, value)| value.is_some_and(|value| surely_inside(e, value)))
        .count();
    let misfit = fitted()
        .zip(predicted)
        .map(|(experiment, predicted)| {
            // What cannot be run does not fit.
            predicted.map_or(f64::INFINITY, |value| squared(experiment, value))
        })
        .sum();
    Tried { at, misfit, inside }
}

/// Sum of squared misfits of `model`, whose free numbers are first brought into what is tried.
pub fn misfit_of(model: &Physiological) -> f64 {
    misfit(inside(logarithms(model))).misfit
}

fn logarithms(model: &Physiological) -> [f64; 3] {
    std::array::from_fn(|i| (FREE[i].get)(model).ln())
}

fn inside(at: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|i| at[i].clamp(FREE[i].range.0.ln(), FREE[i].range.1.ln()))
}

/// Fits the free numbers after a scan of `scan` points; `watch` hears the share done, roughly.
///
/// # Errors
/// [`Refusal::Cancelled`] if the watch stopped it.
pub fn calibrate(scan: u32, watch: Watch) -> Result<Fit, Refusal> {
    let mut tried: Vec<Tried> = Vec::new();
    let points: Vec<[f64; 3]> = (0..scan)
        .map(|i| {
            std::array::from_fn(|axis| {
                let (low, high) = FREE[axis].range;
                let share = f64::from(sobol_burley::sample(i, axis as u32, 1));
                low.ln() + share * (high / low).ln()
            })
        })
        .collect();
    for chunk in points.chunks(rayon::current_num_threads().max(1)) {
        tried.par_extend(chunk.par_iter().map(|&at| misfit(at)));
        heard(watch, 0.5 * tried.len() as f64 / points.len() as f64)?;
    }
    let mut starts: Vec<Tried> = tried
        .iter()
        .filter(|t| t.misfit.is_finite())
        .copied()
        .collect();
    starts.sort_by(|a, b| a.misfit.total_cmp(&b.misfit));
    starts.truncate(STARTS);
    let searches = (starts.len() + 1) as f64;
    for (i, start) in starts.iter_mut().enumerate() {
        let less = |a: &Tried, b: &Tried| a.misfit < b.misfit;
        let heard = |share| heard(watch, 0.5 + 0.5 * (i as f64 + share) / searches);
        *start = search(*start, less, &mut tried, heard)?;
    }
    let least =
        least(&starts).unwrap_or_else(|| misfit(inside(logarithms(&Physiological::default()))));
    let limit = least.misfit + NEARLY;
    let better = |a: &Tried, b: &Tried| {
        let most_inside = b.inside.cmp(&a.inside);
        a.misfit <= limit && most_inside.then(a.misfit.total_cmp(&b.misfit)).is_lt()
    };
    let chosen = tried
        .iter()
        .fold(least, |best, t| if better(t, &best) { *t } else { best });
    let heard = |share| heard(watch, 1.0 - 0.5 * (1.0 - share) / searches);
    let best = search(chosen, better, &mut tried, heard)?;
    let near = || tried.iter().filter(|t| t.misfit <= limit);
    let model = model_at(best.at);
    let mut nearly = [(f64::INFINITY, f64::NEG_INFINITY); 3];
    for point in near() {
        for (range, log) in nearly.iter_mut().zip(point.at) {
            *range = (range.0.min(log.exp()), range.1.max(log.exp()));
        }
    }
    Ok(Fit {
        model,
        misfit: best.misfit,
        rows: rows_of(fitted(), |scenario| fitted_with(scenario, model)),
        nearly,
        tried: tried.len(),
    })
}

/// Goes along the axes from `start` to whatever is `better`, with ever smaller steps; keeps in `tried`
/// what it passed, and tells `heard` the share done, roughly.
fn search(
    start: Tried,
    better: impl Fn(&Tried, &Tried) -> bool,
    tried: &mut Vec<Tried>,
    mut heard: impl FnMut(f64) -> Result<(), Refusal>,
) -> Result<Tried, Refusal> {
    let mut best = start;
    let mut step = STEPS.0;
    while step > STEPS.1 {
        let around: Vec<[f64; 3]> = (0..6)
            .map(|axis| {
                let mut at = best.at;
                at[axis / 2] += if axis % 2 == 0 { step } else { -step };
                inside(at)
            })
            .collect();
        let found: Vec<Tried> = around.par_iter().map(|&at| misfit(at)).collect();
        tried.extend(&found);
        let next = found
            .iter()
            .fold(best, |best, t| if better(t, &best) { *t } else { best });
        if next.at == best.at {
            step *= 0.5;
        }
        best = next;
        heard(((STEPS.0 / step).ln() / (STEPS.0 / STEPS.1).ln()).min(1.0))?;
    }
    Ok(best)
}

fn least(tried: &[Tried]) -> Option<Tried> {
    let finite = tried.iter().filter(|t| t.misfit.is_finite());
    finite.copied().min_by(|a, b| a.misfit.total_cmp(&b.misfit))
}

fn heard(watch: &mut dyn FnMut(f64) -> ControlFlow<()>, share: f64) -> Result<(), Refusal> {
    match watch(share) {
        ControlFlow::Break(()) => Err(Refusal::Cancelled),
        ControlFlow::Continue(()) => Ok(()),
    }
}
