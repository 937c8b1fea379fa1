//! The most likely points of 50 %, how far they are known, and how well they tell what was counted.
//!
//! Newton's method, damped until the density rises, with Cholesky's factors of nalgebra: the
//! curvature that it needs is also what says how far the points are known (Laplace's approximation),
//! and a library of optimizers would bring its own numbers of lines and crates for one loop.
//!
//! A row is scored by ln of the mean chance of its count over draws from that approximation: fitted
//! with it, or with all rows of its kind left out.

use crate::injury::points::{COVARIANCE, FittedInjury, FittedPoint};
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
    derived: 1.0,
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
        let normal = DVector::from_fn(UNKNOWNS, |i, _| {
            let share = f64::from(sobol_burley::sample(number, i as u32, 1));
            normal::quantile(share.clamp(1e-6, 1.0 - 1e-6))
        });
        &self.at + &self.root * normal
    }

    /// ln of the mean chance of each row of `rows`, which need not be those that were fitted.
    pub fn scores<'a>(
        &self,
        felt: &[FeltRow],
        rows: impl Iterator<Item = &'a Outcome>,
        choices: Choices,
    ) -> Vec<f64> {
        let asked = Posterior::new(felt, rows, choices);
        let all: Vec<Vec<f64>> =
            (0..DRAWS).into_par_iter().map(|n| asked.rows(&self.draw(n))).collect();
        let count = all.first().map_or(0, Vec::len);
        let mean = |i: usize| {
            let most = all.iter().map(|row| row[i]).fold(f64::NEG_INFINITY, f64::max);
            let sum: f64 = all.iter().map(|row| libm::exp(row[i] - most)).sum();
            most + libm::log(sum / f64::from(DRAWS))
        };
        (0..count).map(mean).collect()
    }
}

impl Fitted {
    /// What ships: points of 50 % with how they hang together, to four digits.
    pub fn table(&self) -> Vec<FittedInjury> {
        let known = |slope: &DVector<f64>| slope.dot(&(&self.covariance * slope)).sqrt();
        let each = |(j, injury): (usize, &Injury)| {
            let mut slopes = vec![self.posterior.all_slope(j)];
            let kinds = 0..KINDS.len();
            slopes.extend(kinds.map(|k| self.posterior.point_slope(&self.at, k, j)));
            let logs = std::iter::once(self.posterior.all(&self.at, j))
                .chain((0..KINDS.len()).map(|k| self.posterior.point(&self.at, k, j)));
            let keys = std::iter::once("all").chain(KINDS.iter().map(|kind| kind.key));
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
            let (eyes, kinds_differ, lambda) = self.posterior.spreads(&self.at, j);
            FittedInjury {
                injury: injury.key().to_owned(),
                eyes: rounded(eyes),
                kinds_differ: rounded(kinds_differ),
                laboratory: (
                    rounded(self.at[lambda]),
                    rounded(self.covariance[(lambda, lambda)].sqrt()),
                ),
                points: points.collect(),
            }
        };
        Injury::ALL.iter().enumerate().map(each).collect()
    }
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
        text += &format!(
            "    (injury: {:?}, eyes: {:?}, kinds_differ: {:?}, laboratory: {:?}, points: [\n",
            of.injury, of.eyes, of.kinds_differ, of.laboratory
        );
        for point in &of.points {
            let with: Vec<String> = point.with.iter().map(|with| format!("{with:.2}")).collect();
            text += &format!(
                "        (kind: {:?}, half: {:?}, known: {:?}, with: [{}]),\n",
                point.kind,
                point.half,
                point.known,
                with.join(", ")
            );
        }
        text += "    ]),\n";
    }
    text + "]\n"
}

/// How well rows are told: fitted with them, and with their kind left out.
#[derive(Debug, Clone)]
pub struct Scored {
    /// The row.
    pub row: &'static Outcome,
    /// ln of its chance after a fit to all.
    pub fitted: f64,
    /// The same after a fit without its kind.
    pub left_out: f64,
}

/// The rows that a fit takes.
pub fn fitted_rows() -> impl Iterator<Item = &'static Outcome> + Clone {
    outcomes().iter().filter(|row| !row.fit.is_empty())
}

/// Fits to all, and without each kind in turn, and scores every row of one kind.
pub fn study(felt: &[FeltRow], choices: Choices) -> (Fitted, Vec<Scored>) {
    let whole = fit(felt, fitted_rows(), choices);
    let of = |kind: usize| {
        fitted_rows().filter(move |row| row.kinds() == [kind] && row.fit != "laboratory")
    };
    let scored: Vec<Vec<Scored>> = (0..KINDS.len())
        .into_par_iter()
        .map(|kind| {
            let rest = fitted_rows().filter(|row| !row.kinds().contains(&kind));
            if of(kind).next().is_none() {
                return Vec::new();
            }
            let without = fit(felt, rest, choices);
            let fitted = whole.scores(felt, of(kind), choices);
            let left_out = without.scores(felt, of(kind), choices);
            let rows = of(kind).zip(fitted).zip(left_out);
            rows.map(|((row, fitted), left_out)| Scored { row, fitted, left_out }).collect()
        })
        .collect();
    (whole, scored.concat())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::injury::points::Covariance;
    use crate::verify::clinics::felt::stored;

    fn var(name: &str, usual: f64) -> f64 {
        std::env::var(name).ok().and_then(|v| v.parse().ok()).unwrap_or(usual)
    }

    #[test]
    fn slopes_and_curvatures_are_those_of_the_density() {
        let choices = Choices {
            concentration: 20.0,
            derived: 0.5,
            common_shift: 0.1,
            laboratory: 0.25,
            prior: 0.2,
            covariance: Covariance { shared: 0.7, near: 0.3 },
        };
        let posterior = Posterior::new(&stored(), fitted_rows(), choices);
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
            assert!((found - slope[i]).abs() < 1e-3 * (1.0 + found.abs()), "{i} {found} {}", slope[i]);
            let found = (above.1 - below.1) / 2e-5;
            let off = (&found - curvature.column(i)).amax();
            assert!(off < 1e-2 * (1.0 + found.amax()), "{i} {off} {}", found.amax());
        }
    }

    #[test]
    fn explore() {
        let choices = Choices {
            concentration: var("CONC", 20.0),
            derived: var("DERIVED", 1.0),
            common_shift: var("COMMON", 0.1),
            laboratory: 0.25,
            prior: 0.2,
            covariance: Covariance { shared: var("SHARED", 0.7), near: var("NEAR", 0.3) },
        };
        let began = std::time::Instant::now();
        let felt = stored();
        let (whole, scored) = study(&felt, choices);
        println!("took {:?}, value {}", began.elapsed(), whole.value);
        let mean = |of: &dyn Fn(&Scored) -> f64, fit: &str| {
            let rows: Vec<f64> = scored.iter().filter(|s| s.row.fit == fit).map(of).collect();
            (rows.iter().sum::<f64>() / rows.len() as f64, rows.len())
        };
        println!("first: fitted {:?} left out {:?}", mean(&|s| s.fitted, "first"), mean(&|s| s.left_out, "first"));
        println!("more: fitted {:?} left out {:?}", mean(&|s| s.fitted, "more"), mean(&|s| s.left_out, "more"));
        for s in &scored {
            println!("{:24} {:12} {:18} {:>4}/{:<4} {:.2} {:.2}", s.row.study.chars().take(24).collect::<String>(), s.row.kinds, s.row.injury, s.row.hurt, s.row.eyes, s.fitted, s.left_out);
        }
        for j in 0..6 {
            println!("{j} mu {:.3} sigma {:.3} kappa {:.3} lambda {:.3}", libm::exp10(whole.at[j]), libm::exp(whole.at[6 + j]), libm::exp(whole.at[12 + j]), whole.at[18 + j]);
        }
        println!("common {:.3}", whole.at[UNKNOWNS - 1]);
        if let Ok(path) = std::env::var("POINTS") {
            std::fs::write(path, as_ron(&whole.table())).unwrap();
        }
        for (k, kind) in KINDS.iter().enumerate() {
            let points: Vec<String> = (0..6).map(|j| {
                let slope = whole.posterior.point_slope(&whole.at, k, j);
                let sd = (slope.transpose() * &whole.covariance * &slope)[(0, 0)].sqrt();
                format!("{:.2} x{:.2}", libm::exp10(whole.posterior.point(&whole.at, k, j)), libm::exp10(sd))
            }).collect();
            println!("{:12} {}", kind.key, points.join("  "));
        }
    }
}
