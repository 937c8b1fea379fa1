//! A polygon filled with dots, the denser the more there is of what it shows.

use crate::tui::view::raster::{Ink, Raster};

/// Which dots of a square of four by four come first (Bayer 1973).
const ORDER: [[u8; 4]; 4] = [[0, 8, 2, 10], [12, 4, 14, 6], [3, 11, 1, 9], [15, 7, 13, 5]];

/// Sets `share` of the dots within a polygon whose corners are in dots.
pub(super) fn fill(raster: &mut Raster, corners: &[(f64, f64)], share: f64, ink: Ink) {
    let (width, height) = raster.size();
    let span = |of: fn(&(f64, f64)) -> f64, most: i32| {
        let low = corners.iter().map(of).fold(f64::INFINITY, f64::min);
        let high = corners.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
        let within = |v: f64| v.clamp(0.0, f64::from(most)) as i32;
        within(low.floor())..within(high.ceil())
    };
    for y in span(|c| c.1, height) {
        for x in span(|c| c.0, width) {
            let first = f64::from(ORDER[y as usize % 4][x as usize % 4]);
            let at = (f64::from(x) + 0.5, f64::from(y) + 0.5);
            if first < 16.0 * share && inside(corners, at) {
                raster.dot(x, y, ink);
            }
        }
    }
}

/// Whether a ray from a point to the right leaves the polygon an odd number of times.
fn inside(corners: &[(f64, f64)], (x, y): (f64, f64)) -> bool {
    let next = corners.iter().cycle().skip(1);
    let crossed = corners.iter().zip(next).filter(|(a, b)| {
        let between = (a.1 > y) != (b.1 > y);
        between && x < a.0 + (y - a.1) / (b.1 - a.1) * (b.0 - a.0)
    });
    crossed.count() % 2 == 1
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_point_is_inside_whatever_way_a_polygon_turns() {
        let mut square = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (0.0, 4.0)];
        for _ in 0..2 {
            assert!(inside(&square, (1.0, 3.0)));
            assert!(!inside(&square, (5.0, 3.0)) && !inside(&square, (-1.0, 3.0)));
            square.reverse();
        }
    }

    #[test]
    fn every_share_sets_as_many_dots_of_a_square() {
        for step in 0..=16 {
            let share = f64::from(step) / 16.0;
            let set = ORDER
                .iter()
                .flatten()
                .filter(|o| f64::from(**o) < 16.0 * share);
            assert_eq!(set.count(), step as usize);
        }
    }
}
