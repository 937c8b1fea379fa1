//! How likely points of 50 % are, by what was counted: the density that the fit climbs.
//!
//! For injury j, kind k: `L_jk = mu_j - b_jk` is log10 of the kind's point of 50 %, of which
//! [`crate::verify::clinics::shares`] makes what a clinic finds. Over kinds,
//! `b_j = kappa_j C^(1/2) z_j` is a Gaussian process (see [`crate::injury::points`]). Speeds are
//! off by `u_k` for each kind and by c for all. A count is beta-binomial of the share, with
//! concentration [`Choices::concentration`].
//!
//! In laboratories `L_jk` + `lambda_j` counts, which published points of 50 % tell of.
//!
//! Unknowns in their order: mu, ln sigma, ln kappa, lambda (six each), z by kind (six each), u by
//! kind, c.

use crate::injury::clinic::Setting;
use crate::injury::points::Covariance;
use crate::injury::{Injury, KINDS, Outcome, PerInjury};
use crate::verify::clinics::count::beta_binomial;
use crate::verify::clinics::felt::FeltRow;
use crate::verify::clinics::shares::{INJURIES, KindShares, LOCAL, SHIFT, Shares};
use libm::{exp, log, log10};
use nalgebra::{DMatrix, DVector};

/// What is chosen and not fitted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Choices {
    /// Of a beta-binomial count: the fewer, the more series differ.
    pub concentration: f64,
    /// How far all speeds may be off together: a standard deviation of log10.
    pub common_shift: f64,
    /// How far laboratories may lie from clinics: a standard deviation of log10 of the measure.
    pub laboratory: f64,
    /// Added in quadrature to what the laboratory's points are known to, before clinics are asked.
    pub prior: f64,
    /// How kinds hang together.
    pub covariance: Covariance,
}

/// What was counted in one series, of kinds whose mean it is.
#[derive(Debug, Clone)]
pub(super) struct Series {
    pub(super) kinds: Vec<usize>,
    pub(super) setting: Setting,
    pub(super) rows: Vec<Row>,
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Row {
    /// Among the rows that were given.
    place: usize,
    pub(super) injury: usize,
    pub(super) eyes: f64,
    pub(super) hurt: f64,
}

/// All that the density needs.
#[derive(Debug, Clone)]
pub struct Posterior {
    pub(super) kinds: Vec<KindShares>,
    pub(super) series: Vec<Series>,
    /// Square root of the covariance over kinds.
    pub(super) root: DMatrix<f64>,
    pub(super) choices: Choices,
}

/// How many unknowns there are.
pub const UNKNOWNS: usize = 4 * INJURIES + (INJURIES + 1) * KINDS.len() + 1;
pub(super) const LAMBDA: usize = 3 * INJURIES;
pub(super) const Z: usize = 4 * INJURIES;
const U: usize = Z + INJURIES * KINDS.len();
const COMMON: usize = UNKNOWNS - 1;

/// The kind that published points of 50 % of the laboratory are told of.
const PUBLISHED_KIND: &str = "airsoft";

impl Posterior {
    /// Of these counts, by what tissues felt.
    ///
    /// # Panics
    /// Never: no two kinds are alike.
    pub fn new<'a>(
        felt: &[FeltRow],
        outcomes: impl Iterator<Item = &'a Outcome>,
        choices: Choices,
    ) -> Self {
        let mut series: Vec<(&str, Series)> = Vec::new();
        for outcome in outcomes {
            let (kinds, setting) = (outcome.kinds(), outcome.setting);
            let Some(injury) = outcome.injury() else { continue };
            let row = Row {
                place: series.iter().map(|(_, series)| series.rows.len()).sum(),
                injury: injury as usize,
                eyes: outcome.eyes.into(),
                hurt: outcome.hurt.into(),
            };
            let same = |(study, s): &&mut (&str, Series)| {
                *study == outcome.study && s.kinds == kinds && s.setting == setting
            };
            match series.iter_mut().find(same) {
                Some((_, series)) => series.rows.push(row),
                None => series.push((&outcome.study, Series { kinds, setting, rows: vec![row] })),
            }
        }
        let root = choices.covariance.over_kinds().cholesky();
        Self {
            kinds: KINDS.iter().map(|kind| KindShares::of(kind, felt)).collect(),
            series: series.into_iter().map(|(_, series)| series).collect(),
            root: root.expect("a covariance has a root").l(),
            choices,
        }
    }

    /// Where the climb begins: the laboratory's points, `abrasion` added to that of the abrasion.
    pub fn start(abrasion: f64) -> DVector<f64> {
        let mut at = DVector::zeros(UNKNOWNS);
        for (j, injury) in Injury::ALL.iter().enumerate() {
            let curve = injury.curve();
            at[j] = laboratory_point(j);
            at[INJURIES + j] = log(libm::hypot(curve.eyes, 0.1));
            at[2 * INJURIES + j] = log(curve.known + 0.05);
        }
        at[INJURIES - 1] += abrasion;
        at
    }

    pub(super) fn kappa(at: &DVector<f64>, injury: usize) -> f64 {
        exp(at[2 * INJURIES + injury])
    }

    /// b of a kind: how far its point of 50 % lies below that of all.
    pub(super) fn own(&self, at: &DVector<f64>, kind: usize, injury: usize) -> f64 {
        let sum: f64 =
            (0..=kind).map(|l| self.root[(kind, l)] * at[Z + INJURIES * l + injury]).sum();
        Self::kappa(at, injury) * sum
    }

    /// The thirteen numbers of a kind.
    fn local(&self, at: &DVector<f64>, kind: usize) -> [f64; LOCAL] {
        std::array::from_fn(|i| match i {
            SHIFT => at[U + kind] + at[COMMON],
            i if i >= INJURIES => at[i],
            i => at[i] - self.own(at, kind, i),
        })
    }

    /// How eyes and kinds differ, and the place of what laboratories add.
    pub fn spreads(&self, at: &DVector<f64>, injury: usize) -> (f64, f64, usize) {
        (exp(at[INJURIES + injury]), Self::kappa(at, injury), LAMBDA + injury)
    }

    /// log10 of the point of 50 % of a kind.
    pub fn point(&self, at: &DVector<f64>, kind: usize, injury: usize) -> f64 {
        at[injury] - self.own(at, kind, injury)
    }

    /// How log10 of a kind's point changes with the unknowns.
    pub fn point_slope(&self, at: &DVector<f64>, kind: usize, injury: usize) -> DVector<f64> {
        let mut slope = DVector::zeros(UNKNOWNS);
        slope[injury] = 1.0;
        slope[2 * INJURIES + injury] = -self.own(at, kind, injury);
        for l in 0..=kind {
            slope[Z + INJURIES * l + injury] = -Self::kappa(at, injury) * self.root[(kind, l)];
        }
        slope
    }

    /// The thirteen numbers of a kind as this setting has them: in laboratories lambda is added.
    pub(super) fn in_setting(
        &self,
        at: &DVector<f64>,
        kind: usize,
        setting: Setting,
    ) -> [f64; LOCAL] {
        let mut local = self.local(at, kind);
        if setting == Setting::Laboratory {
            for j in 0..INJURIES {
                local[j] += at[LAMBDA + j];
            }
            // Speeds were measured there.
            local[SHIFT] = 0.0;
        }
        local
    }

    /// ln of the chance of each row, in the order of the outcomes that have an injury.
    pub fn rows(&self, at: &DVector<f64>) -> Vec<f64> {
        let mut rows = vec![0.0; self.series.iter().map(|series| series.rows.len()).sum()];
        for series in &self.series {
            let shares = self.shares_of(at, series);
            for row in &series.rows {
                let share =
                    shares.iter().map(|s| s.value[row.injury]).sum::<f64>() / shares.len() as f64;
                let concentration = self.choices.concentration;
                rows[row.place] = beta_binomial(row.hurt, row.eyes, share, concentration).0;
            }
        }
        rows
    }

    /// The share of each injury that a series of one kind would count.
    pub fn told(&self, at: &DVector<f64>, kind: usize, setting: Setting) -> PerInjury<f64> {
        self.kinds[kind].shares(setting, &self.in_setting(at, kind, setting)).value
    }

    /// Shares of each kind of a series.
    fn shares_of(&self, at: &DVector<f64>, series: &Series) -> Vec<Shares> {
        let of = |&k: &usize| {
            self.kinds[k].shares(series.setting, &self.in_setting(at, k, series.setting))
        };
        series.kinds.iter().map(of).collect()
    }

    /// ln of the density but for a constant, and its slopes.
    pub fn value(&self, at: &DVector<f64>) -> (f64, DVector<f64>) {
        let (mut sum, mut slope) = self.prior(at);
        for series in &self.series {
            let lab = series.setting == Setting::Laboratory;
            let each = self.shares_of(at, series);
            let count = each.len() as f64;
            let mut local = vec![[0.0; LOCAL]; each.len()];
            for row in &series.rows {
                let share = each.iter().map(|s| s.value[row.injury]).sum::<f64>() / count;
                let concentration = self.choices.concentration;
                let (value, steep) = beta_binomial(row.hurt, row.eyes, share, concentration);
                sum += value;
                for (local, shares) in local.iter_mut().zip(&each) {
                    for (local, slope) in local.iter_mut().zip(shares.slope[row.injury]) {
                        *local += steep / count * slope;
                    }
                }
            }
            for (local, kind) in local.iter().zip(&series.kinds) {
                self.spread_slope(at, *kind, local, lab, &mut slope);
            }
        }
        (sum, slope)
    }

    /// Adds the slopes over the thirteen numbers of a kind to those over all unknowns.
    pub(super) fn spread_slope(
        &self,
        at: &DVector<f64>,
        kind: usize,
        local: &[f64; LOCAL],
        lab: bool,
        slope: &mut DVector<f64>,
    ) {
        for j in 0..INJURIES {
            slope[j] += local[j];
            slope[INJURIES + j] += local[INJURIES + j];
            slope[2 * INJURIES + j] -= local[j] * self.own(at, kind, j);
            for l in 0..=kind {
                let by_z = Self::kappa(at, j) * self.root[(kind, l)];
                slope[Z + INJURIES * l + j] -= local[j] * by_z;
            }
            if lab {
                slope[LAMBDA + j] += local[j];
            }
        }
        if !lab {
            slope[U + kind] += local[SHIFT];
            slope[COMMON] += local[SHIFT];
        }
    }

    /// How far the laboratory's points lie above what was published, and what that is known to.
    pub(super) fn published(&self, at: &DVector<f64>) -> PerInjury<(f64, f64)> {
        std::array::from_fn(|j| {
            let curve = Injury::ALL[j].curve();
            let told = self.point(at, published_kind(), j) + at[LAMBDA + j];
            (told - laboratory_point(j), curve.known)
        })
    }

    /// Standard deviations of the unknowns before anything was counted.
    pub(super) fn prior_spreads(&self) -> Vec<f64> {
        let mut spreads = vec![1.0; UNKNOWNS];
        for (j, injury) in Injury::ALL.iter().enumerate() {
            spreads[j] = libm::hypot(injury.curve().known, self.choices.prior);
            spreads[INJURIES + j] = 0.3;
            spreads[2 * INJURIES + j] = 0.35;
            spreads[LAMBDA + j] = self.choices.laboratory;
        }
        for (k, kind) in KINDS.iter().enumerate() {
            spreads[U + k] = kind.unsure;
        }
        spreads[COMMON] = self.choices.common_shift;
        spreads
    }

    fn prior(&self, at: &DVector<f64>) -> (f64, DVector<f64>) {
        let mut slope = DVector::zeros(UNKNOWNS);
        let (mut sum, means) = (0.0, Self::start(0.0));
        for (i, sd) in self.prior_spreads().into_iter().enumerate() {
            let z = (at[i] - means[i]) / sd;
            sum -= 0.5 * z * z;
            slope[i] = -z / sd;
        }
        for (j, (off, known)) in self.published(at).into_iter().enumerate() {
            sum -= 0.5 * (off / known) * (off / known);
            let steep = -off / (known * known);
            slope.axpy(steep, &self.point_slope(at, published_kind(), j), 1.0);
            slope[LAMBDA + j] += steep;
        }
        (sum, slope)
    }
}

/// log10 of the laboratory's point of 50 %, in the unit of the measure.
fn laboratory_point(injury: usize) -> f64 {
    let injury = Injury::ALL[injury];
    log10(injury.curve().half * injury.measure().row().factor)
}

/// Place of the kind that published points are told of.
pub(super) fn published_kind() -> usize {
    KINDS.iter().position(|kind| kind.key == PUBLISHED_KIND).unwrap_or(0)
}
