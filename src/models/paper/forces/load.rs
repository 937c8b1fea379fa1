//! How a force on an arc of the cornea is shared among shell nodes.
//!
//! The whole force acts along the inward normal at the location angle theta, (cos theta,
//! -sin theta). Node s takes the share of [theta - w, theta + w] that overlaps its own arc of
//! 360/N degrees, divided by the sum, so the total is exact for any theta, w and mesh. The loaded
//! arc is first clipped to the opening: bone shields the rest.

use crate::models::paper::eye::Eye;
use crate::scenario::ForcePulse;
use nalgebra::Vector2;
use std::f64::consts::PI;

/// How a force on an arc of the cornea is shared among shell nodes.
#[derive(Debug, Clone, PartialEq)]
pub struct ArcLoad {
    /// Node index and its share; the shares add up to 1.
    pub shares: Vec<(usize, f64)>,
    /// Unit vector of the force.
    pub direction: Vector2<f64>,
    /// Share of the asked arc that lies behind bone, 0 to 1.
    pub shielded: f64,
    /// The loaded arc after clipping, front angles in radians.
    pub arc: (f64, f64),
}

impl ArcLoad {
    /// Spreads a force over the arc that `input` asks for.
    pub fn new(input: &ForcePulse, eye: &Eye) -> Self {
        let theta = input.angle_deg.to_radians();
        let width = input.half_width_deg.to_radians();
        let opening = eye.opening_rad;
        let (low, high) = ((theta - width).max(-opening), (theta + width).min(opening));
        let half_arc = PI / eye.landmarks.shell.len() as f64;
        let overlap = |&i: &usize| {
            // An arc that reaches past the posterior pole meets the node from the other side.
            let turns = [-2.0 * PI, 0.0, 2.0 * PI].into_iter();
            let overlaps = turns.map(|turn| {
                let phi = eye.nodes[i].front_angle() + turn;
                (high.min(phi + half_arc) - low.max(phi - half_arc)).max(0.0)
            });
            let overlap: f64 = overlaps.sum();
            // Rounding at the edge of an arc must not load a node that only touches it.
            (overlap > 1e-12 * half_arc).then_some((i, overlap))
        };
        let overlaps: Vec<(usize, f64)> = eye.landmarks.shell.iter().filter_map(overlap).collect();
        let total: f64 = overlaps.iter().map(|(_, overlap)| overlap).sum();
        Self {
            shares: overlaps.into_iter().map(|(i, overlap)| (i, overlap / total)).collect(),
            direction: Vector2::new(libm::cos(theta), -libm::sin(theta)),
            shielded: (1.0 - (high - low) / (2.0 * width)).max(0.0),
            arc: (low, high),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::EyeInput;

    #[test]
    fn an_arc_past_the_opening_is_clipped_and_the_shielded_share_is_stated() {
        let eye = Eye::build(&EyeInput::default());
        let blow = ForcePulse { angle_deg: 30.0, half_width_deg: 20.0, ..ForcePulse::default() };
        let load = ArcLoad::new(&blow, &eye);
        assert!((load.shielded - 0.25).abs() < 1e-12);
        let total: f64 = load.shares.iter().map(|s| s.1).sum();
        assert!((total - 1.0).abs() < 1e-12);
        for (node, _) in load.shares {
            let phi = eye.nodes[node].front_angle().to_degrees();
            assert!(phi > 5.0 - 1e-9 && phi < 45.0);
        }
        // One of twenty degrees loads four nodes equally.
        let load = ArcLoad::new(&ForcePulse::default(), &eye);
        assert_eq!(load.shares.len(), 4);
        assert!(load.shares.iter().all(|(_, share)| (share - 0.25).abs() < 1e-12));
    }
}
