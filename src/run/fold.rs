//! How a mesh folded: where, how many of its quads, since when and for how long.
//!
//! It is looked at where steps end: one comparison with the least of the quads, which the forces
//! tell anyway; all are gone through only where one is inside out.

use crate::run::places::Region;
use nalgebra::Point2;

/// A mesh of which a quad turned inside out.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fold {
    /// When a quad first was inside out, in s.
    pub since: f64,
    /// For how long one or more were inside out, in s, as step ends find it.
    pub lasted: f64,
    /// Whether one was still inside out as the run ended.
    pub stays: bool,
    /// How many quads were inside out at some time.
    pub quads: usize,
    /// Quads of the whole mesh.
    pub of: usize,
    /// The middle at rest of the one that was farthest inside out at first, in m from the middle of
    /// the globe, x towards the back, along the blow at the axisymmetric eye.
    pub at: Point2<f64>,
    /// The part that it belongs to: lens, globe or fat.
    pub part: Region,
    /// Whether it has a fellow on the other side of the axis that was inside out as well.
    pub both_sides: bool,
}

impl Fold {
    /// Angle from the front at which it began, in rad; positive above.
    pub fn front_angle(&self) -> f64 {
        libm::atan2(self.at.y, -self.at.x)
    }

    /// Distance from the middle of the globe at which it began, in m.
    pub fn radius(&self) -> f64 {
        self.at.coords.norm()
    }
}

/// Watches for it over the steps of one run.
#[derive(Debug, Clone)]
pub(crate) struct FoldWatch {
    /// Whether each quad was inside out at some time.
    seen: Vec<bool>,
    fold: Option<Fold>,
    /// End of the last step, in s.
    before: f64,
}

impl FoldWatch {
    /// A watch over a mesh of so many quads.
    pub fn new(quads: usize) -> Self {
        Self { seen: vec![false; quads], fold: None, before: 0.0 }
    }

    /// Takes in the end of a step, at `time` s. `ratio` is a quad's size over that at rest, `least`
    /// the least of all, and `place` a quad's middle at rest and its part.
    #[inline]
    pub fn record(
        &mut self,
        time: f64,
        least: f64,
        ratio: impl Fn(usize) -> f64,
        place: impl Fn(usize) -> (Point2<f64>, Region),
    ) {
        if let Some(fold) = &mut self.fold {
            if fold.stays {
                fold.lasted += time - self.before;
            }
            fold.stays = least <= 0.0;
        }
        self.before = time;
        if least <= 0.0 {
            self.count(time, ratio, place);
        }
    }

    #[cold]
    fn count(
        &mut self,
        time: f64,
        ratio: impl Fn(usize) -> f64,
        place: impl Fn(usize) -> (Point2<f64>, Region),
    ) {
        let mut worst = (f64::INFINITY, 0);
        for (quad, seen) in self.seen.iter_mut().enumerate() {
            let ratio = ratio(quad);
            *seen |= ratio <= 0.0;
            if ratio < worst.0 {
                worst = (ratio, quad);
            }
        }
        // What is zero by one way of rounding need not be by another.
        if let Some(seen) = self.seen.get_mut(worst.1) {
            *seen = true;
        }
        let quads = self.seen.iter().filter(|seen| **seen).count();
        if let Some(fold) = &mut self.fold {
            fold.quads = quads;
            return;
        }
        let (at, part) = place(worst.1);
        let fellow = |(quad, _): (usize, &bool)| {
            let (other, _) = place(quad);
            at.y * other.y < 0.0
                && (other - Point2::new(at.x, -at.y)).norm() < 1e-6 * at.coords.norm()
        };
        let mut seen = self.seen.iter().enumerate().filter(|(_, seen)| **seen);
        self.fold = Some(Fold {
            since: time,
            lasted: 0.0,
            stays: true,
            quads,
            of: self.seen.len(),
            at,
            part,
            both_sides: seen.any(fellow),
        });
    }

    /// What was seen.
    pub fn fold(&self) -> Option<Fold> {
        self.fold
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Four quads round the middle, the second and the fourth each other's mirror image.
    fn middle(quad: usize) -> Point2<f64> {
        [[-1.0, 0.0], [0.0, 1.0], [1.0, 0.0], [0.0, -1.0]].map(Point2::from)[quad]
    }

    /// What is seen of quads with these ratios at the ends of steps of 1 s.
    fn seen(steps: &[[f64; 4]]) -> Option<Fold> {
        let mut watch = FoldWatch::new(4);
        for (time, ratios) in (0..).zip(steps) {
            let least = ratios.iter().copied().fold(f64::INFINITY, f64::min);
            let place = |quad| (middle(quad), Region::Interior);
            watch.record(f64::from(time), least, |quad| ratios[quad], place);
        }
        watch.fold()
    }

    const REST: [f64; 4] = [1.0; 4];

    #[test]
    fn a_mesh_that_opens_again_is_told_from_one_that_stays_folded() {
        let folded = [1.0, -0.1, 1.0, 1.0];
        assert_eq!(seen(&[REST, REST]), None);
        let instant = seen(&[REST, folded, REST, REST]).unwrap();
        assert_eq!((instant.since, instant.lasted, instant.stays), (1.0, 1.0, false));
        let twice = seen(&[REST, folded, REST, folded, folded, REST]).unwrap();
        assert_eq!((twice.since, twice.lasted, twice.stays), (1.0, 3.0, false));
        let stays = seen(&[REST, REST, folded, folded]).unwrap();
        assert_eq!((stays.since, stays.lasted, stays.stays), (2.0, 1.0, true));
    }

    #[test]
    fn every_quad_that_folds_counts_once_and_the_worst_of_the_first_says_where() {
        let fold = seen(&[REST, [1.0, -0.1, 1.0, -0.2], [-0.5, -0.1, 1.0, 1.0], REST]).unwrap();
        assert_eq!((fold.quads, fold.of, fold.both_sides), (3, 4, true));
        assert_eq!(fold.at, middle(3));
        assert!((fold.front_angle().to_degrees() + 90.0).abs() < 1e-9);
        let fold = seen(&[[0.0, 1.0, 1.0, 1.0]]).unwrap();
        assert_eq!((fold.quads, fold.both_sides, fold.front_angle()), (1, false, 0.0));
    }
}
