//! The share of each injury that a clinic finds in those who came after blows of one kind.
//!
//! An eye is hurt with `r = Phi((log10 m - L)/sigma)`, where m is what its tissue felt at one of
//! seven speeds (Gauss and Hermite's points of a normal distribution of log10 of the speed) from
//! one of six directions. Who comes and what is found follow [`crate::injury::clinic`]. Only
//! thirteen numbers of a kind matter: L and ln sigma of each injury and the shift of log10 of its
//! speeds.

use crate::injury::clinic::Setting;
use crate::injury::way_in::{self, WayIn};
use crate::injury::{Injury, ObjectKind, PerInjury};
use crate::normal;
use crate::scenario::direction::AS_HITS_COME;
use crate::verify::clinics::felt::{FeltRow, FeltTable};
use libm::{exp, log10};
use nalgebra::DMatrix;

/// How many injuries there are.
pub(super) const INJURIES: usize = Injury::ALL.len();
/// Numbers that matter to the counts of one kind: L and ln sigma of each injury, and the shift.
pub(super) const LOCAL: usize = 2 * INJURIES + 1;
/// The place of the shift among them.
pub(super) const SHIFT: usize = 2 * INJURIES;

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

/// Shares of each injury among those who came, and how they change with the thirteen numbers.
pub(super) struct Shares {
    pub(super) value: PerInjury<f64>,
    pub(super) slope: [[f64; LOCAL]; INJURIES],
}

/// Shares of one kind among those who came, with their second derivatives by injury.
pub(super) struct Bent {
    pub(super) shares: Shares,
    pub(super) curvature: Vec<DMatrix<f64>>,
}

/// What the shares of one kind need.
#[derive(Debug, Clone)]
pub(super) struct KindShares {
    object: &'static ObjectKind,
    table: FeltTable,
    /// Of what may go in: log10 of energy over area of 1 m/s, J/m2.
    enters: Option<f64>,
}

/// log10 of the energy over area at 1 m/s of what may go in, J/m2.
fn enters_at_1_m_s(kind: &ObjectKind) -> Option<f64> {
    let scenario = kind.scenario();
    let object = scenario.projectile()?;
    WayIn::of(object)?;
    let area = std::f64::consts::FRAC_PI_4 * object.diameter_m() * object.diameter_m();
    Some(log10(0.5 * object.mass_kg() / area))
}

fn density(x: f64) -> f64 {
    exp(-0.5 * x * x) / std::f64::consts::TAU.sqrt()
}

impl KindShares {
    /// Of a kind, by what tissues felt of it.
    pub(super) fn of(object: &'static ObjectKind, felt: &[FeltRow]) -> Self {
        Self { object, table: FeltTable::of(object, felt), enters: enters_at_1_m_s(object) }
    }

    /// Shares among those who came, of these thirteen numbers.
    pub(super) fn shares(&self, setting: Setting, local: &[f64; LOCAL]) -> Shares {
        let (mut all, mut with) = (0.0, [0.0; INJURIES]);
        let (mut all_slope, mut with_slope) = ([0.0; LOCAL], [[0.0; LOCAL]; INJURIES]);
        let object = self.object;
        for (node, weight) in NODES {
            let speed = log10(object.usual_m_s) + object.spread * node + local[SHIFT];
            let (logs, rises) = self.table.at(speed);
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
                if let Some(energy) = self.enters {
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

    /// Those and their second derivatives, by differences of their slopes.
    pub(super) fn bent(&self, setting: Setting, local: &[f64; LOCAL]) -> Bent {
        const STEP: f64 = 1e-4;
        let mut curvature = vec![DMatrix::zeros(LOCAL, LOCAL); INJURIES];
        for i in 0..LOCAL {
            let moved = |by: f64| {
                let mut local = *local;
                local[i] += by;
                self.shares(setting, &local).slope
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
        Bent { shares: self.shares(setting, local), curvature }
    }
}
