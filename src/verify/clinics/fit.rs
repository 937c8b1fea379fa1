//! The most likely points of 50 %, how far they are known, and how well they tell what was counted.
//!
//! Newton's method, damped until the density rises, with Cholesky's factors of nalgebra: the
//! curvature that it needs is also what says how far the points are known (Laplace's
//! approximation), and a library of optimizers would bring its own numbers of lines and crates for
//! one loop.
//!
//! A row is scored by ln of the mean chance of its count over draws from that approximation: fitted
//! with it, or with all rows of its kind left out.

use crate::injury::points::{COVARIANCE, FittedInjury, FittedPoint, LABORATORY};
use crate::injury::{Injury, KINDS, Outcome, outcomes};
use crate::normal;
use crate::verify::clinics::felt::FeltRow;
use crate::verify::clinics::posterior::{Choices, Posterior, UNKNOWNS};
use nalgebra::{DMatrix, DVector};
use rayon::prelude::*;

/// Steps of Newton's method at most.
const STEPS: usize = 100;
/// The least curvature that a direction is taken to have.
const LEAST_CURVATURE: f64 = 0.3;
/// Draws that a score is a mean over.
const DRAWS: u32 = 300;

/// What is chosen and not fitted: what tells kinds that were left out best of what was tried.
pub const CHOICES: Choices = Choices {
    concentration: 20.0,
    common_shift: 0.1,
    laboratory: 0.25,
    prior: 0.2,
    covariance: COVARIANCE,
};

/// What was fitted.
#[derive(Debug, Clone)]
pub struct Fitted {
    /// What it was fitted to.
    pub posterior: Posterior,
    /// The most likely unknowns.
    pub at: DVector<f64>,
    /// Their covariance.
    pub covariance: DMatrix<f64>,
    /// ln of the density there.
    pub value: f64,
    /// Square root of the covariance.
    root: DMatrix<f64>,
}

/// Climbs from one start to the top.
fn climb(posterior: &Posterior, start: DVector<f64>) -> (DVector<f64>, f64) {
    let mut at = start;
    let (mut value, mut slope) = posterior.value(&at);
    let mut damping = 1.0;
    for _ in 0..STEPS {
        let curvature = -posterior.curvature(&at);
        let mut rose = false;
        for _ in 0..30 {
            let mut damped = curvature.clone();
            for i in 0..UNKNOWNS {
                damped[(i, i)] += damping;
            }
            let step = damped.cholesky().map(|root| root.solve(&slope));
            if let Some(step) = step {
                let next = &at + &step;
                let (there, new_slope) = posterior.value(&next);
                if there > value {
                    let gained = there - value;
                    (at, value, slope) = (next, there, new_slope);
                    damping = (damping * 0.2).max(1e-9);
                    rose = gained > 1e-8;
                    break;
                }
            }
            damping *= 4.0;
        }
        if !rose {
            break;
        }
    }
    (at, value)
}

/// Fits to rows; the abrasion's curve has two optima, so several starts are taken.
///
/// # Panics
/// Never: there is a start.
pub fn fit<'a>(
    felt: &[FeltRow],
    rows: impl Iterator<Item = &'a Outcome>,
    choices: Choices,
) -> Fitted {
    let posterior = Posterior::new(felt, rows, choices);
    let starts = [0.0, 0.5, -0.5];
    let climbed = starts.par_iter().map(|by| climb(&posterior, Posterior::start(*by)));
    let all: Vec<(DVector<f64>, f64)> = climbed.collect();
    let mut best = all.into_iter();
    let first = best.next().expect("there are starts");
    let (at, value) = best.fold(first, |best, next| if next.1 > best.1 { next } else { best });
    let own = (-posterior.curvature(&at)).symmetric_eigen();
    let shrunk = own.eigenvalues.map(|value| value.max(LEAST_CURVATURE));
    let root = &own.eigenvectors * DMatrix::from_diagonal(&shrunk.map(|v| 1.0 / v.sqrt()));
    Fitted { covariance: &root * root.transpose(), posterior, at, value, root }
}

impl Fitted {
    /// A draw of the unknowns: the same number gives the same for good.
    pub fn draw(&self, number: u32) -> DVector<f64> {
        let normal = DVector::from_fn(UNKNOWNS, |i, _| normal::draw(number, i as u32));
        &self.at + &self.root * normal
    }
}

impl Fitted {
    /// What ships: points of 50 % with how they hang together, to four digits.
    pub fn table(&self) -> Vec<FittedInjury> {
        let known = |slope: &DVector<f64>| slope.dot(&(&self.covariance * slope)).sqrt();
        let each = |(j, injury): (usize, &Injury)| {
            let (eyes, kinds_differ, lambda) = self.posterior.spreads(&self.at, j);
            let mut slopes = vec![unit(j)];
            let kinds = 0..KINDS.len();
            slopes.extend(kinds.map(|k| self.posterior.point_slope(&self.at, k, j)));
            slopes.push(unit(lambda));
            let logs = std::iter::once(self.at[j])
                .chain((0..KINDS.len()).map(|k| self.posterior.point(&self.at, k, j)))
                .chain([self.at[lambda]]);
            let keys =
                std::iter::once("all").chain(KINDS.iter().map(|kind| kind.key)).chain([LABORATORY]);
            let points = keys.zip(logs).enumerate().map(|(i, (kind, log))| FittedPoint {
                kind: kind.to_owned(),
                half: rounded(libm::exp10(log)),
                known: rounded(known(&slopes[i])),
                with: (0..i)
                    .map(|l| {
                        let both = slopes[i].dot(&(&self.covariance * &slopes[l]));
                        rounded(both / (known(&slopes[i]) * known(&slopes[l])))
                    })
                    .collect(),
            });
            FittedInjury {
                injury: injury.key().to_owned(),
                eyes: rounded(eyes),
                kinds_differ: rounded(kinds_differ),
                points: points.collect(),
            }
        };
        Injury::ALL.iter().enumerate().map(each).collect()
    }
}

/// How one of the unknowns changes with all of them.
fn unit(place: usize) -> DVector<f64> {
    DVector::from_fn(UNKNOWNS, |i, _| f64::from(u8::from(i == place)))
}

/// To four digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.3e}").parse().unwrap_or(value)
}

/// The shipped table as RON, a line a point.
pub fn as_ron(table: &[FittedInjury]) -> String {
    let mut text = String::from(
        "// Points of 50 % by kind of object, fitted to what clinics counted: contrecoup verify fit --points\n[\n",
    );
    for of in table {
        let FittedInjury { injury, eyes, kinds_differ, .. } = of;
        let head = format!("(injury: {injury:?}, eyes: {eyes:?}, kinds_differ: {kinds_differ:?}");
        text.extend(["    ", &head, ", points: [\n"]);
        for FittedPoint { kind, half, known, with } in &of.points {
            let with: Vec<String> = with.iter().map(|with| format!("{with:.2}")).collect();
            let point = format!("(kind: {kind:?}, half: {half:?}, known: {known:?}, with: [");
            text.extend(["        ", &point, &with.join(", "), "]),\n"]);
        }
        text += "    ]),\n";
    }
    text + "]\n"
}

/// How well a row is told, by ln of the chance of its count.
#[derive(Debug, Clone)]
pub struct Scored {
    /// The row.
    pub row: &'static Outcome,
    /// The share that the most likely points tell.
    pub told: f64,
    /// After a fit to all.
    pub fitted: f64,
    /// After a fit without its kind.
    pub left_out: f64,
    /// By the laboratory's points alone.
    pub laboratory: f64,
}

/// Mean scores of rows.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeanScore {
    /// How many rows.
    pub rows: usize,
    /// Fitted with them.
    pub fitted: f64,
    /// With their kind left out.
    pub left_out: f64,
    /// By the laboratory's points alone.
    pub laboratory: f64,
}

/// A fit with the score of each row of one kind.
#[derive(Debug, Clone)]
pub struct Study {
    /// The fit to all rows.
    pub fitted: Fitted,
    /// Each row of one kind.
    pub scored: Vec<Scored>,
}

impl Study {
    /// The mean score of the rows that `holds`.
    pub fn mean(&self, holds: impl Fn(&Outcome) -> bool) -> MeanScore {
        let of: Vec<&Scored> = self.scored.iter().filter(|s| holds(s.row)).collect();
        let mean = |score: fn(&Scored) -> f64| {
            of.iter().map(|scored| score(scored)).sum::<f64>() / of.len() as f64
        };
        MeanScore {
            rows: of.len(),
            fitted: mean(|s| s.fitted),
            left_out: mean(|s| s.left_out),
            laboratory: mean(|s| s.laboratory),
        }
    }
}

/// The rows that the shipped points are fitted to.
pub fn fitted_rows() -> impl Iterator<Item = &'static Outcome> + Clone {
    outcomes().iter().filter(|row| !row.fit.is_empty())
}

/// Those of them that models are compared on.
pub fn first_rows() -> impl Iterator<Item = &'static Outcome> + Clone {
    fitted_rows().filter(|row| row.fit != "more")
}

/// Fits to rows, and without each kind in turn, and scores every row of one kind.
pub fn study<I>(felt: &[FeltRow], rows: &I, choices: Choices) -> Study
where
    I: Iterator<Item = &'static Outcome> + Clone + Send + Sync,
{
    let whole = fit(felt, rows.clone(), choices);
    let scored = (0..KINDS.len()).into_par_iter().map(|kind| {
        let single = |row: &&Outcome| row.kinds() == [kind] && row.fit != "laboratory";
        let own: Vec<&'static Outcome> = rows.clone().filter(single).collect();
        if own.is_empty() {
            return Vec::new();
        }
        let of = || own.iter().copied();
        let without = fit(felt, rows.clone().filter(|row| !row.kinds().contains(&kind)), choices);
        let asked = Posterior::new(felt, of(), choices);
        let scores = [
            mean_chances(&asked, |n| whole.draw(n)),
            mean_chances(&asked, |n| without.draw(n)),
            mean_chances(&asked, of_laboratory),
        ];
        let row = |(i, row): (usize, &'static Outcome)| {
            let injury = row.injury().map_or(0, |injury| injury as usize);
            Scored {
                row,
                told: whole.posterior.told(&whole.at, kind, row.setting)[injury],
                fitted: scores[0][i],
                left_out: scores[1][i],
                laboratory: scores[2][i],
            }
        };
        of().enumerate().map(row).collect()
    });
    let scored: Vec<Vec<Scored>> = scored.collect();
    Study { fitted: whole, scored: scored.concat() }
}

/// ln of the mean chance of each row over draws of the unknowns.
fn mean_chances(asked: &Posterior, draw: impl Fn(u32) -> DVector<f64> + Sync) -> Vec<f64> {
    let all: Vec<Vec<f64>> = (0..DRAWS).into_par_iter().map(|n| asked.rows(&draw(n))).collect();
    let mean = |i: usize| {
        let most = all.iter().map(|row| row[i]).fold(f64::NEG_INFINITY, f64::max);
        let sum: f64 = all.iter().map(|row| libm::exp(row[i] - most)).sum();
        most + libm::log(sum / f64::from(DRAWS))
    };
    (0..all.first().map_or(0, Vec::len)).map(mean).collect()
}

/// A draw of the curves that a laboratory's points alone make: the thing to beat.
fn of_laboratory(number: u32) -> DVector<f64> {
    let mut at = Posterior::start(0.0);
    for (j, injury) in Injury::ALL.iter().enumerate() {
        let curve = injury.curve();
        at[j] += curve.known * normal::draw(number, j as u32);
        at[Injury::ALL.len() + j] = libm::log(curve.eyes);
    }
    at
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::injury::points::fitted;
    use crate::verify::clinics::felt::stored;

    #[test]
    fn slopes_and_curvatures_are_those_of_the_density() {
        let posterior = Posterior::new(&stored(), fitted_rows(), CHOICES);
        // Nowhere special.
        let at = Posterior::start(0.1).map_with_location(|i, _, x| x + 0.05 * libm::sin(i as f64));
        let (_, slope) = posterior.value(&at);
        let curvature = posterior.curvature(&at);
        for i in 0..UNKNOWNS {
            let moved = |by: f64| {
                let mut at = at.clone();
                at[i] += by;
                posterior.value(&at)
            };
            let (above, below) = (moved(1e-5), moved(-1e-5));
            let found = (above.0 - below.0) / 2e-5;
            assert!(
                (found - slope[i]).abs() < 1e-3 * (1.0 + found.abs()),
                "{i} {found} {}",
                slope[i]
            );
            let found = (above.1 - below.1) / 2e-5;
            let off = (&found - curvature.column(i)).amax();
            assert!(off < 1e-2 * (1.0 + found.amax()), "{i} {off} {}", found.amax());
        }
    }

    #[test]
    fn what_is_shipped_is_what_the_stored_runs_give_again() {
        let found = fit(&stored(), fitted_rows(), CHOICES).table();
        for (found, shipped) in found.iter().zip(fitted()) {
            assert!((found.eyes / shipped.eyes - 1.0).abs() < 0.01, "{found:?}");
            assert!((found.kinds_differ / shipped.kinds_differ - 1.0).abs() < 0.01, "{found:?}");
            for (found, shipped) in found.points.iter().zip(&shipped.points) {
                assert!((found.half / shipped.half - 1.0).abs() < 0.01, "{found:?} {shipped:?}");
                assert!((found.known / shipped.known - 1.0).abs() < 0.02, "{found:?} {shipped:?}");
            }
        }
    }

    #[test]
    fn stored_runs_come_out_again() {
        let rows = stored();
        let cheap = rows.iter().filter(|row| row.direction == 0 && row.cornea_kj_m2.is_some());
        for row in cheap.filter(|row| ["airsoft", "gel-ball", "cork"].contains(&&*row.kind)) {
            assert_eq!(row.rerun(), *row);
        }
        let aslant = rows.iter().find(|row| row.kind == "gel-ball" && row.direction == 1).unwrap();
        assert_eq!(aslant.rerun(), *aslant);
    }
}
