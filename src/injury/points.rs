//! Points of 50 % that were fitted to what clinics counted, and what they say of any object.
//!
//! How far a kind's point lies below that of all, `b_j`, has over kinds that are d apart the
//! covariance `kappa_j^2 (s exp(-d^2/2) + (1 - s) exp(-d^2/(2 n^2)))`: a share s that neighbours
//! have in common, the rest a kind's own, which two objects share only where they are nearly the
//! same (n). So a squash ball tells of a racquetball and little of a BB, and nothing jumps.
//!
//! With C that matrix over the fitted kinds and c its column for an object, w = C^-1 c: the
//! object's point is mu (1 - sum w) + w L, its variance that of this sum by the covariance of the
//! fit, plus kappa^2 (1 - c w) for what is its own. `contrecoup verify fit` finds the table again.
//!
//! Left out: that kappa and the spread of eyes are themselves known to a fifth or so.

use crate::injury::kind::{Injury, PerInjury};
use crate::injury::object_kind::{Features, KINDS, apart_squared};
use libm::{exp, log10};
use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};
use std::sync::LazyLock;

/// How kinds hang together.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Covariance {
    /// What neighbours have in common, s.
    pub shared: f64,
    /// How far apart two objects may be to be the same kind, n.
    pub near: f64,
}

/// The one that the table was fitted with: it tells kinds that were left out best of those tried.
pub const COVARIANCE: Covariance = Covariance { shared: 0.7, near: 0.3 };

impl Covariance {
    /// Of two objects, over kappa squared.
    pub fn of(&self, a: &Features, b: &Features) -> f64 {
        let d2 = apart_squared(a, b);
        let own = exp(-0.5 * d2 / (self.near * self.near));
        self.shared * exp(-0.5 * d2) + (1.0 - self.shared) * own
    }

    /// Of all kinds.
    pub fn over_kinds(&self) -> DMatrix<f64> {
        let features: Vec<Features> =
            KINDS.iter().map(super::object_kind::ObjectKind::features).collect();
        DMatrix::from_fn(KINDS.len(), KINDS.len(), |a, b| self.of(&features[a], &features[b]))
    }
}

/// One line of the table: a kind's point of 50 % of one injury, in the unit of its measure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FittedPoint {
    /// The kind, by its key; `all` for what a kind unlike any would have, `laboratory` for how many
    /// times more laboratories' eyes bear than living ones.
    pub kind: String,
    /// Where half of all eyes are hurt.
    pub half: f64,
    /// How far log10 of it is known: a standard deviation.
    pub known: f64,
    /// Its correlation with each line before it.
    pub with: Vec<f64>,
}

/// What was fitted of one injury.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct FittedInjury {
    /// The injury, by its key.
    pub injury: String,
    /// How eyes differ: a standard deviation of log10 of the measure.
    pub eyes: f64,
    /// How kinds of object differ: the same.
    pub kinds_differ: f64,
    /// `all`, each kind, `laboratory`.
    pub points: Vec<FittedPoint>,
}

/// The line of laboratories.
pub const LABORATORY: &str = "laboratory";
/// The table.
const TABLE: &str = include_str!("points.ron");

/// One injury, ready to be asked.
struct Ready {
    fitted: FittedInjury,
    /// log10 of the points, SI.
    logs: DVector<f64>,
    covariance: DMatrix<f64>,
}

struct Table {
    injuries: Vec<Ready>,
    inverse: DMatrix<f64>,
    features: Vec<Features>,
}

/// The table as it is written.
///
/// # Panics
/// Never: a test reads it.
pub fn fitted() -> Vec<FittedInjury> {
    ron::from_str(TABLE).expect("the table of points can be read")
}

static READY: LazyLock<Table> = LazyLock::new(|| {
    let ready = |(injury, fitted): (&Injury, FittedInjury)| {
        let factor = injury.measure().row().factor;
        let points = &fitted.points;
        let logs = points.iter().map(|point| {
            log10(point.half) - if point.kind == LABORATORY { 0.0 } else { log10(factor) }
        });
        let covariance = DMatrix::from_fn(points.len(), points.len(), |a, b| {
            let (first, last) = (a.min(b), a.max(b));
            let with = if a == b { 1.0 } else { points[last].with[first] };
            with * points[a].known * points[b].known
        });
        Ready { logs: DVector::from_iterator(points.len(), logs), covariance, fitted }
    };
    let inverse = COVARIANCE.over_kinds().try_inverse();
    Table {
        injuries: Injury::ALL.iter().zip(fitted()).map(ready).collect(),
        inverse: inverse.expect("no two kinds are alike"),
        features: KINDS.iter().map(super::object_kind::ObjectKind::features).collect(),
    }
});

/// A point of 50 %.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Point {
    /// log10 of the measure at which half of all eyes are hurt, SI.
    pub log: f64,
    /// How far it is known: a standard deviation.
    pub known: f64,
    /// How eyes differ: a standard deviation of log10 of the measure.
    pub eyes: f64,
}

/// What an object has of each line of the table, and what is its own; without features it is like
/// no kind.
fn weights(of: Option<&Features>) -> (DVector<f64>, f64) {
    let table = &*READY;
    let mut weights = DVector::zeros(KINDS.len() + 2);
    let Some(of) = of else {
        weights[0] = 1.0;
        return (weights, 1.0);
    };
    let column = DVector::from_fn(KINDS.len(), |k, _| COVARIANCE.of(of, &table.features[k]));
    let of_kinds = &table.inverse * &column;
    weights[0] = 1.0 - of_kinds.sum();
    weights.rows_mut(1, KINDS.len()).copy_from(&of_kinds);
    (weights, (1.0 - column.dot(&of_kinds)).max(0.0))
}

/// The points of an object: of living eyes, or of those of donors and animals in laboratories.
pub fn points(of: Option<&Features>, in_laboratory: bool) -> PerInjury<Point> {
    let (mut weights, own) = weights(of);
    weights[KINDS.len() + 1] = f64::from(u8::from(in_laboratory));
    std::array::from_fn(|j| {
        let ready = &READY.injuries[j];
        let kappa = ready.fitted.kinds_differ;
        let variance = weights.dot(&(&ready.covariance * &weights)) + own * kappa * kappa;
        Point {
            log: weights.dot(&ready.logs),
            known: variance.max(0.0).sqrt(),
            eyes: ready.fitted.eyes,
        }
    })
}

/// How far the points of two objects are known to lie from each other, by injury: a standard
/// deviation of log10, in which what both share is taken out.
pub fn apart_known(a: Option<&Features>, b: Option<&Features>) -> PerInjury<f64> {
    let ((of_a, own_a), (of_b, own_b)) = (weights(a), weights(b));
    let between = &of_a - &of_b;
    // What each has of its own may be shared as well.
    let both = match (a, b) {
        (Some(a), Some(b)) => {
            let column = |of: &Features| {
                DVector::from_fn(KINDS.len(), |k, _| COVARIANCE.of(of, &READY.features[k]))
            };
            COVARIANCE.of(a, b) - column(a).dot(&(&READY.inverse * column(b)))
        }
        _ => 0.0,
    };
    std::array::from_fn(|j| {
        let ready = &READY.injuries[j];
        let kappa = ready.fitted.kinds_differ;
        let own = kappa * kappa * (own_a + own_b - 2.0 * both);
        (between.dot(&(&ready.covariance * &between)) + own).max(0.0).sqrt()
    })
}

/// The kind nearest to an object and the square of how far apart they are.
pub fn nearest(of: &Features) -> (usize, f64) {
    let distances = READY.features.iter().map(|features| apart_squared(of, features));
    let nearest = distances.enumerate().min_by(|a, b| a.1.total_cmp(&b.1));
    nearest.unwrap_or((0, f64::INFINITY))
}

/// How far an object flies beyond the speeds at which its likes hit eyes, in decades: a mean over
/// kinds by how near they are.
pub fn beyond_usual(of: &Features, speed_m_s: f64) -> f64 {
    let (mut sum, mut all) = (0.0, 0.0);
    for (kind, features) in KINDS.iter().zip(&READY.features) {
        let near = exp(-0.5 * apart_squared(of, features));
        let off =
            log10(speed_m_s / kind.usual_m_s).abs() - 2.0 * libm::hypot(kind.spread, kind.unsure);
        sum += near * off.max(0.0);
        all += near;
    }
    if all > 0.0 { sum / all } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_has_every_injury_and_kind_in_their_order() {
        for (injury, fitted) in Injury::ALL.iter().zip(fitted()) {
            assert_eq!(fitted.injury, injury.key());
            let keys: Vec<&str> = fitted.points.iter().map(|point| point.kind.as_str()).collect();
            assert_eq!(keys[0], "all");
            let kinds = KINDS.iter().map(|kind| kind.key).chain([LABORATORY]);
            assert!(keys[1..].iter().copied().eq(kinds));
            for (i, point) in fitted.points.iter().enumerate() {
                assert!(point.half > 0.0 && point.known > 0.0 && point.with.len() == i);
            }
        }
    }

    #[test]
    fn a_kind_has_its_own_point_and_what_is_like_none_that_of_all() {
        for (k, kind) in KINDS.iter().enumerate() {
            for (point, ready) in points(Some(&kind.features()), false).iter().zip(&READY.injuries)
            {
                assert!((point.log - ready.logs[k + 1]).abs() < 1e-9);
                assert!((point.known - ready.fitted.points[k + 1].known).abs() < 1e-6);
            }
        }
        let far = points(Some(&[40.0, 40.0, 40.0]), false);
        for ((far, none), ready) in far.iter().zip(&points(None, false)).zip(&READY.injuries) {
            assert!((far.log - ready.logs[0]).abs() < 1e-9);
            assert!(
                (far.known - none.known).abs() < 1e-9 && none.known > ready.fitted.kinds_differ
            );
        }
    }

    #[test]
    fn two_of_a_kind_lie_no_way_apart_and_unlike_ones_as_far_as_both_are_known() {
        let [squash, golf] = ["squash", "golf"]
            .map(|key| KINDS.iter().find(|kind| kind.key == key).unwrap().features());
        assert!(apart_known(Some(&squash), Some(&squash)).iter().all(|known| *known < 1e-6));
        let apart = apart_known(Some(&squash), Some(&golf));
        let [a, b] = [squash, golf].map(|of| points(Some(&of), false));
        for j in 0..apart.len() {
            assert!(apart[j] > 0.0 && apart[j] < 1.5 * libm::hypot(a[j].known, b[j].known));
        }
    }
}
