//! The lens: an ellipse in the section, and how much of a triangle lies in it.
//!
//! On the paper's mesh five nodes lie in the ellipse and three springs join them: by nodes, the
//! lens is these three. As the mesh gets finer such a lens grows towards its full size like 1/k,
//! and every result follows it slowly. By area a spring takes the lens modulus for the share of
//! its triangles that lies in the ellipse, so that the lens has its size at every level.
//!
//! The area is exact: scaled, the ellipse is the unit circle, and each edge of the triangle adds
//! the area between it and the centre, a triangle where it runs inside and a sector where it runs
//! outside.

use nalgebra::{Point2, Vector2};

/// Centre and semi-axes, in m.
const CENTRE_X_M: f64 = -6.4e-3;
const HALF_THICKNESS_M: f64 = 2.2e-3;
const HALF_HEIGHT_M: f64 = 4.6e-3;

/// The point as seen from the centre, in semi-axes.
fn scaled(p: Point2<f64>) -> Vector2<f64> {
    Vector2::new((p.x - CENTRE_X_M) / HALF_THICKNESS_M, p.y / HALF_HEIGHT_M)
}

/// Whether a point, in m, lies in the lens.
pub(crate) fn holds(p: Point2<f64>) -> bool {
    let q = scaled(p);
    q.x * q.x + q.y * q.y <= 1.0
}

/// Area of the triangle that lies in the lens, in m2.
pub(crate) fn area_within(corners: [Point2<f64>; 3]) -> f64 {
    let [a, b, c] = corners.map(scaled);
    let swept = swept_by(a, b) + swept_by(b, c) + swept_by(c, a);
    (0.5 * swept * HALF_THICKNESS_M * HALF_HEIGHT_M).abs()
}

/// Twice the signed area of the unit circle between its centre and the line from `a` to `b`.
fn swept_by(a: Vector2<f64>, b: Vector2<f64>) -> f64 {
    let along = b - a;
    let sector = |p: Vector2<f64>, q: Vector2<f64>| libm::atan2(p.perp(&q), p.dot(&q));
    // The line is inside where |a + s along| < 1, between the roots of a quadratic.
    let (length_squared, half) = (along.norm_squared(), a.dot(&along));
    let discriminant = half * half - length_squared * (a.norm_squared() - 1.0);
    if discriminant <= 0.0 || length_squared == 0.0 {
        return sector(a, b);
    }
    let root = discriminant.sqrt();
    let [enter, leave] = [-root, root].map(|r| ((r - half) / length_squared).clamp(0.0, 1.0));
    let (p, q) = (a + along * enter, a + along * leave);
    let outside = |p: Vector2<f64>, q: Vector2<f64>| if p == q { 0.0 } else { sector(p, q) };
    outside(a, p) + p.perp(&q) + outside(q, b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    fn at(x: f64, y: f64) -> Point2<f64> {
        Point2::new(CENTRE_X_M + x * HALF_THICKNESS_M, y * HALF_HEIGHT_M)
    }

    /// In areas of the square of semi-axes.
    fn share(corners: [Point2<f64>; 3]) -> f64 {
        area_within(corners) / (HALF_THICKNESS_M * HALF_HEIGHT_M)
    }

    #[test]
    fn as_much_of_a_triangle_counts_as_lies_in_the_lens() {
        let around = [at(-9.0, -5.0), at(9.0, -5.0), at(0.0, 9.0)];
        for (corners, area) in [
            ([at(0.1, 0.1), at(0.5, 0.1), at(0.1, 0.6)], 0.1),
            ([at(1.1, 0.0), at(2.0, 0.0), at(2.0, 1.0)], 0.0),
            // Its corner's angle at the centre is less than a right one, but no part of it is near.
            ([at(-3.0, 1.5), at(3.0, 1.5), at(0.0, 9.0)], 0.0),
            // Around the lens it holds all of it, whichever way it turns.
            (around, PI),
            ([around[1], around[0], around[2]], PI),
            // Edges through the centre cut a sector.
            ([at(0.0, 0.0), at(5.0, 0.0), at(0.0, 5.0)], PI / 4.0),
        ] {
            assert!((share(corners) - area).abs() < 1e-13, "{corners:?}");
        }
        // Parts of a triangle add up to it.
        let [a, b, c] = [at(-0.3, 0.2), at(1.7, 0.4), at(0.2, 1.3)];
        let middle = at(0.8, 0.7);
        let parts = share([a, b, middle]) + share([b, c, middle]) + share([c, a, middle]);
        assert!((share([a, b, c]) - parts).abs() < 1e-14);
    }
}
