//! How likely points of 50 % are, by what was counted: the density that the fit climbs.
//!
//! For injury j, kind k: `L_jk = mu_j - b_jk` is log10 of the kind's point of 50 %, and an eye is
//! hurt with `r = Phi((log10 m - L_jk)/sigma_j)`, where m is what its tissue felt at one of seven
//! speeds (Gauss and Hermite's points of a normal distribution of log10 of the speed) from one of
//! six directions. Over kinds, `b_j = kappa_j C^(1/2) z_j` is a Gaussian process (see
//! [`crate::injury::points`]). Speeds are off by `u_k` for each kind and by c for all. Who comes to
//! a clinic follows [`crate::injury::clinic`]; a count is beta-binomial of the share, with
//! concentration [`Choices::concentration`], as series differ by more than chance.
//!
//! In laboratories `L_jk` + `lambda_j` counts, which published points of 50 % tell of.
//!
//! Unknowns in their order: mu, ln sigma, ln kappa, lambda (six each), z by kind (six each), u by
//! kind, c. Of a kind only thirteen numbers matter to its counts: L and ln sigma of each injury and
//! the shift of log10 of its speeds.

use crate::injury::clinic::Setting;
use crate::injury::points::Covariance;
use crate::injury::way_in::{self, WayIn};
use crate::injury::{Injury, KINDS, ObjectKind, Outcome, PerInjury};
use crate::normal;
use crate::scenario::direction::AS_HITS_COME;
use crate::verify::clinics::felt::{FeltRow, FeltTable};
use libm::{exp, lgamma, log, log10};
use nalgebra::{DMatrix, DVector};

const INJURIES: usize = Injury::ALL.len();
/// Numbers that matter to the counts of one kind: L and ln sigma of each injury, and the shift.
const LOCAL: usize = 2 * INJURIES + 1;
const SHIFT: usize = 2 * INJURIES;

/// Points and weights of Gauss and Hermite for a normal distribution.
const NODES: [(f64, f64); 7] = [
    (-3.750_439_717_725_742, 5.482_688_559_722_18e-4),
    (-2.366_759_410_734_541, 0.030_757_123_967_586_497),
    (-1.154_405_394_739_968, 0.240_123_178_605_012_7),
    (0.0, 0.457_142_857_142_857_1),
    (1.154_405_394_739_968, 0.240_123_178_605_012_7),
    (2.366_759_410_734_541, 0.030_757_123_967_586_497),
    (3.750_439_717_725_742, 5.482_688_559_722_18e-4),
];

/// What is chosen and not fitted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Choices {
    /// Of a beta-binomial count: the fewer, the more series differ.
    pub concentration: f64,
    /// Weight of a count that is derived.
    pub derived: f64,
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
struct Series {
    kinds: Vec<usize>,
    setting: Setting,
    rows: Vec<Row>,
}

#[derive(Debug, Clone, Copy)]
struct Row {
    /// Among the rows that were given.
    place: usize,
    injury: usize,
    eyes: f64,
    hurt: f64,
    weight: f64,
}

/// All that the density needs.
#[derive(Debug, Clone)]
pub struct Posterior {
    tables: Vec<FeltTable>,
    series: Vec<Series>,
    /// Square root of the covariance over kinds.
    root: DMatrix<f64>,
    choices: Choices,
    /// For small hard kinds: log10 of energy over area of 1 m/s, J/m2.
    enters: Vec<Option<f64>>,
}

/// How many unknowns there are.
pub const UNKNOWNS: usize = 4 * INJURIES + (INJURIES + 1) * KINDS.len() + 1;
const LAMBDA: usize = 3 * INJURIES;
const Z: usize = 4 * INJURIES;
const U: usize = Z + INJURIES * KINDS.len();
const COMMON: usize = UNKNOWNS - 1;

/// log10 of the energy over area at 1 m/s of what may go in, J/m2.
fn enters_at_1_m_s(kind: &ObjectKind) -> Option<f64> {
    let scenario = kind.scenario();
    let object = scenario.projectile()?;
    WayIn::of(object)?;
    let area = std::f64::consts::FRAC_PI_4 * object.diameter_m() * object.diameter_m();
    Some(log10(0.5 * object.mass_kg() / area))
}

/// The kind that published points of 50 % of the laboratory are told of.
const PUBLISHED_KIND: &str = "airsoft";

fn density(x: f64) -> f64 {
    exp(-0.5 * x * x) / std::f64::consts::TAU.sqrt()
}

/// Shares of each injury among those who came, and how they change with the thirteen numbers.
struct Shares {
    value: PerInjury<f64>,
    slope: [[f64; LOCAL]; INJURIES],
}

/// ln of a beta-binomial chance of `hurt` of `eyes`, and its slope over the share.
fn beta_binomial(hurt: f64, eyes: f64, share: f64, concentration: f64) -> (f64, f64) {
    let p = share.clamp(1e-5, 1.0 - 1e-5);
    let (a, b) = (p * concentration, (1.0 - p) * concentration);
    let beta = |a: f64, b: f64| lgamma(a) + lgamma(b) - lgamma(a + b);
    let choose = lgamma(eyes + 1.0) - lgamma(hurt + 1.0) - lgamma(eyes - hurt + 1.0);
    let value = choose + beta(hurt + a, eyes - hurt + b) - beta(a, b);
    let slope = digamma(hurt + a) - digamma(eyes - hurt + b) - digamma(a) + digamma(b);
    let clamped = p != share;
    (value, if clamped { 0.0 } else { concentration * slope })
}

/// Slope of ln gamma, by its recurrence and its asymptotic series.
fn digamma(mut x: f64) -> f64 {
    let mut sum = 0.0;
    while x < 8.0 {
        sum -= 1.0 / x;
        x += 1.0;
    }
    let y = 1.0 / (x * x);
    sum + log(x) - 0.5 / x - y * (1.0 / 12.0 - y * (1.0 / 120.0 - y * (1.0 / 252.0 - y / 240.0)))
}

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
                weight: if outcome.is_derived() { choices.derived } else { 1.0 },
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
            tables: KINDS.iter().map(|kind| FeltTable::of(kind, felt)).collect(),
            series: series.into_iter().map(|(_, series)| series).collect(),
            root: root.expect("a covariance has a root").l(),
            choices,
            enters: KINDS.iter().map(enters_at_1_m_s).collect(),
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

    fn kappa(at: &DVector<f64>, injury: usize) -> f64 {
        exp(at[2 * INJURIES + injury])
    }

    /// b of a kind: how far its point of 50 % lies below that of all.
    fn own(&self, at: &DVector<f64>, kind: usize, injury: usize) -> f64 {
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

    fn shares(&self, kind: usize, setting: Setting, local: &[f64; LOCAL]) -> Shares {
        let (mut all, mut with) = (0.0, [0.0; INJURIES]);
        let (mut all_slope, mut with_slope) = ([0.0; LOCAL], [[0.0; LOCAL]; INJURIES]);
        let object = &KINDS[kind];
        for (node, weight) in NODES {
            let speed = log10(object.usual_m_s) + object.spread * node + local[SHIFT];
            let (logs, rises) = self.tables[kind].at(speed);
            for (direction, (logs, rises)) in logs.iter().zip(&rises).enumerate() {
                let weight = weight / AS_HITS_COME.len() as f64;
                let mut risks = [0.0; INJURIES];
                // By L, ln sigma and the shift: each risk has but its own three.
                let mut own = [[0.0; 3]; INJURIES];
                for j in 0..INJURIES {
                    let sigma = exp(local[INJURIES + j]);
                    let z = (logs[j] - local[j]) / sigma;
                    let steep = density(z) / sigma;
                    risks[j] = normal::below(z);
                    own[j] = [-steep, -z * density(z), steep * rises[j]];
                }
                if let Some(energy) = self.enters[kind] {
                    let [angle_deg, _, offset_mm, _] = AS_HITS_COME[direction];
                    let z = way_in::z(energy + 2.0 * speed, angle_deg, offset_mm);
                    let enters = normal::below(z);
                    let whole = 1.0 - enters;
                    own[0] = own[0].map(|slope| slope * whole);
                    own[0][2] += (1.0 - risks[0]) * density(z) * 2.0 / way_in::SPREAD;
                    risks[0] = 1.0 - (1.0 - risks[0]) * whole;
                }
                let (coming, slopes) = (setting.coming(&risks), setting.slopes(&risks));
                all += weight * coming.all;
                for i in 0..INJURIES {
                    with[i] += weight * coming.with[i];
                    for (k, place) in [i, INJURIES + i, SHIFT].into_iter().enumerate() {
                        all_slope[place] += weight * slopes.all[i] * own[i][k];
                        for (of, with) in with_slope.iter_mut().zip(&slopes.with) {
                            of[place] += weight * with[i] * own[i][k];
                        }
                    }
                }
            }
        }
        let seen = setting.seen();
        Shares {
            value: std::array::from_fn(|j| seen[j] * with[j] / all),
            slope: std::array::from_fn(|j| {
                std::array::from_fn(|i| {
                    seen[j] * (with_slope[j][i] * all - with[j] * all_slope[i]) / (all * all)
                })
            }),
        }
    }

    /// The thirteen numbers of a kind as this setting has them: in laboratories lambda is added.
    fn in_setting(&self, at: &DVector<f64>, kind: usize, setting: Setting) -> [f64; LOCAL] {
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
            let shares: Vec<Shares> = series
                .kinds
                .iter()
                .map(|&k| self.shares(k, series.setting, &self.in_setting(at, k, series.setting)))
                .collect();
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
        self.shares(kind, setting, &self.in_setting(at, kind, setting)).value
    }

    /// ln of the density but for a constant, and its slopes.
    pub fn value(&self, at: &DVector<f64>) -> (f64, DVector<f64>) {
        let (mut sum, mut slope) = self.prior(at);
        for series in &self.series {
            let lab = series.setting == Setting::Laboratory;
            let each: Vec<(usize, Shares)> = series
                .kinds
                .iter()
                .map(|&k| {
                    (k, self.shares(k, series.setting, &self.in_setting(at, k, series.setting)))
                })
                .collect();
            let count = each.len() as f64;
            let mut local = vec![[0.0; LOCAL]; each.len()];
            for row in &series.rows {
                let share = each.iter().map(|(_, s)| s.value[row.injury]).sum::<f64>() / count;
                let concentration = self.choices.concentration;
                let (value, steep) = beta_binomial(row.hurt, row.eyes, share, concentration);
                sum += row.weight * value;
                for (local, (_, shares)) in local.iter_mut().zip(&each) {
                    for (local, slope) in local.iter_mut().zip(shares.slope[row.injury]) {
                        *local += row.weight * steep / count * slope;
                    }
                }
            }
            for (local, (kind, _)) in local.iter().zip(&each) {
                self.spread_slope(at, *kind, local, lab, &mut slope);
            }
        }
        (sum, slope)
    }

    /// Adds the slopes over the thirteen numbers of a kind to those over all unknowns.
    fn spread_slope(
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
                    self.bent(kind, series.setting, &local)
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
                sum.ger(row.weight * second, &slope, &slope, 1.0);
                for ((bent, by), &kind) in each.iter().zip(&by_unknowns).zip(&series.kinds) {
                    let weight = row.weight * first / count;
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

    /// Shares of one kind and their second derivatives.
    fn bent(&self, kind: usize, setting: Setting, local: &[f64; LOCAL]) -> Bent {
        const STEP: f64 = 1e-4;
        let mut curvature = vec![DMatrix::zeros(LOCAL, LOCAL); INJURIES];
        for i in 0..LOCAL {
            let moved = |by: f64| {
                let mut local = *local;
                local[i] += by;
                self.shares(kind, setting, &local).slope
            };
            let (above, below) = (moved(STEP), moved(-STEP));
            for j in 0..INJURIES {
                for k in 0..LOCAL {
                    let bent = (above[j][k] - below[j][k]) / (4.0 * STEP);
                    curvature[j][(i, k)] += bent;
                    curvature[j][(k, i)] += bent;
                }
            }
        }
        Bent { shares: self.shares(kind, setting, local), curvature }
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

    /// How far the laboratory's points lie above what was published, and what that is known to.
    fn published(&self, at: &DVector<f64>) -> PerInjury<(f64, f64)> {
        std::array::from_fn(|j| {
            let curve = Injury::ALL[j].curve();
            let told = self.point(at, published_kind(), j) + at[LAMBDA + j];
            (told - laboratory_point(j), curve.known)
        })
    }

    /// Standard deviations of the unknowns before anything was counted.
    fn prior_spreads(&self) -> Vec<f64> {
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

/// Shares of one kind among those who came, with their second derivatives by injury.
struct Bent {
    shares: Shares,
    curvature: Vec<DMatrix<f64>>,
}

/// log10 of the laboratory's point of 50 %, in the unit of the measure.
fn laboratory_point(injury: usize) -> f64 {
    let injury = Injury::ALL[injury];
    log10(injury.curve().half * injury.measure().row().factor)
}

/// Place of the kind that published points are told of.
fn published_kind() -> usize {
    KINDS.iter().position(|kind| kind.key == PUBLISHED_KIND).unwrap_or(0)
}
