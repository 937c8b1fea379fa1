//! The second derivatives of the density: exact but for the shares of a kind, whose slopes over its
//! own thirteen numbers are differenced.

use crate::injury::clinic::Setting;
use crate::verify::clinics::count::beta_binomial;
use crate::verify::clinics::posterior::{LAMBDA, Posterior, Row, UNKNOWNS, Z, published_kind};
use crate::verify::clinics::shares::{Bent, INJURIES, LOCAL};
use nalgebra::{DMatrix, DVector};

impl Posterior {
    /// The second derivatives: of the shares of a kind by differences of their slopes over its own
    /// thirteen numbers, from there on exactly.
    pub fn curvature(&self, at: &DVector<f64>) -> DMatrix<f64> {
        let mut sum = self.prior_curvature(at);
        for series in &self.series {
            let lab = series.setting == Setting::Laboratory;
            let count = series.kinds.len() as f64;
            let each: Vec<Bent> = series
                .kinds
                .iter()
                .map(|&kind| {
                    let local = self.in_setting(at, kind, series.setting);
                    self.kinds[kind].bent(series.setting, &local)
                })
                .collect();
            let by_unknowns: Vec<DMatrix<f64>> =
                series.kinds.iter().map(|&kind| self.local_slopes(at, kind, lab)).collect();
            for row in &series.rows {
                let j = row.injury;
                let share = each.iter().map(|bent| bent.shares.value[j]).sum::<f64>() / count;
                let (first, second) = self.steep(row, share);
                let mut slope = DVector::zeros(UNKNOWNS);
                for (bent, by) in each.iter().zip(&by_unknowns) {
                    let local = DVector::from_column_slice(&bent.shares.slope[j]) / count;
                    slope += by.tr_mul(&local);
                }
                sum.ger(second, &slope, &slope, 1.0);
                for ((bent, by), &kind) in each.iter().zip(&by_unknowns).zip(&series.kinds) {
                    let weight = first / count;
                    sum += weight * by.tr_mul(&(&bent.curvature[j] * by));
                    for i in 0..INJURIES {
                        self.bend_point(at, (kind, i), weight * bent.shares.slope[j][i], &mut sum);
                    }
                }
            }
        }
        sum
    }

    /// Slope and curvature of a row's term over its share.
    fn steep(&self, row: &Row, share: f64) -> (f64, f64) {
        const STEP: f64 = 1e-6;
        let at = |share| beta_binomial(row.hurt, row.eyes, share, self.choices.concentration).1;
        let step = STEP * share.max(1e-3);
        (at(share), (at(share + step) - at(share - step)) / (2.0 * step))
    }

    /// How the thirteen numbers of a kind change with the unknowns.
    fn local_slopes(&self, at: &DVector<f64>, kind: usize, lab: bool) -> DMatrix<f64> {
        let mut slopes = DMatrix::zeros(LOCAL, UNKNOWNS);
        for i in 0..LOCAL {
            let mut one = [0.0; LOCAL];
            one[i] = 1.0;
            let mut slope = DVector::zeros(UNKNOWNS);
            self.spread_slope(at, kind, &one, lab, &mut slope);
            slopes.set_row(i, &slope.transpose());
        }
        slopes
    }

    /// Adds the second derivatives of a kind's point of 50 %, times `weight`.
    fn bend_point(
        &self,
        at: &DVector<f64>,
        (kind, injury): (usize, usize),
        weight: f64,
        sum: &mut DMatrix<f64>,
    ) {
        let k = 2 * INJURIES + injury;
        sum[(k, k)] -= weight * self.own(at, kind, injury);
        for l in 0..=kind {
            let z = Z + INJURIES * l + injury;
            let bent = weight * Self::kappa(at, injury) * self.root[(kind, l)];
            sum[(k, z)] -= bent;
            sum[(z, k)] -= bent;
        }
    }

    fn prior_curvature(&self, at: &DVector<f64>) -> DMatrix<f64> {
        let mut sum = DMatrix::zeros(UNKNOWNS, UNKNOWNS);
        for (i, sd) in self.prior_spreads().iter().enumerate() {
            sum[(i, i)] = -1.0 / (sd * sd);
        }
        for (j, (off, known)) in self.published(at).into_iter().enumerate() {
            let mut slope = self.point_slope(at, published_kind(), j);
            slope[LAMBDA + j] += 1.0;
            sum.ger(-1.0 / (known * known), &slope, &slope, 1.0);
            self.bend_point(at, (published_kind(), j), -off / (known * known), &mut sum);
        }
        sum
    }
}
