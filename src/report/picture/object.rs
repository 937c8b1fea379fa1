//! The object as it is drawn: round where it is free; where it presses, the layers over it cut it.
//!
//! From its rear pole, a radius behind the middle of what is left of it, to what it meets on its
//! way it has some length left. A ball is drawn as an ellipse that gives up 0.64 of what it lost,
//! and the rest is cut off by the eye; it grows in width as the length goes, by at most a quarter.
//! That bulge is drawn, not computed.

use nalgebra::{Point2, Vector2};

use crate::report::picture::shell::Outline;
use crate::report::picture::{Part, Shape, ellipse, left, sides};
use crate::run::drawing::{Drawing, DrawnObject};
use crate::run::kept::Frame;

/// Share of the radius that its outline is thick.
const SKIN: f64 = 0.055;
/// Half of the length that a ball gives up as it is drawn, over what it lost.
const SHORTER: f64 = 0.32;
/// How wide a squeezed ball gets, over its radius, at most.
const WIDEST: f64 = 1.25;
/// Shortest length of a squeezed ball over its radius.
const FLATTEST: f64 = 0.2;
/// Farther than any picture reaches, in m.
const FAR: f64 = 0.3;

/// The object before anything cuts it.
pub(super) struct Hitting {
    pub object: DrawnObject,
    middle: Point2<f64>,
    /// Half axes along its way and across, of a cylinder none.
    half: Option<(f64, f64)>,
}

impl Hitting {
    pub fn of(drawing: &Drawing, frame: &Frame, globe: &Outline) -> Option<Self> {
        let (object, middle) = drawing.object(frame)?;
        let DrawnObject { radius, direction, .. } = object;
        if object.edge.is_some() {
            return Some(Self { object, middle, half: None });
        }
        let rear = middle - direction * radius;
        let met = crossing(&globe.points, rear, direction);
        let room = met.unwrap_or(2.0 * radius - frame.squeezed);
        let short = 2.0 * radius - room.clamp(FLATTEST * radius, 2.0 * radius);
        let along = radius - SHORTER * short;
        let across = (radius * (radius / along).sqrt()).min(WIDEST * radius);
        let middle = rear + direction * along;
        Some(Self { object, middle, half: Some((along, across)) })
    }

    /// The object with its outline, at least `grain` thick.
    pub fn shapes(&self, grain: f64) -> [Shape; 2] {
        let skin = (SKIN * self.object.radius).max(grain).min(0.5 * self.object.radius);
        [Shape::new(Part::Skin, self.ring(0.0)), Shape::new(Part::Object, self.ring(skin))]
    }

    /// Its outline, or a line so far within.
    pub fn ring(&self, within: f64) -> Vec<Point2<f64>> {
        let DrawnObject { radius, edge, direction } = self.object;
        let across = left(direction);
        if let Some((a, b)) = self.half {
            return ellipse(self.middle, direction * (a - within), across * (b - within));
        }
        // The length of a cylinder is not known: it is drawn as long as half of its width.
        let (edge, radius) = (edge.unwrap_or_default().max(within), radius - within);
        let corners = [
            (-within, radius - edge),
            (-0.3 * edge - 0.7 * within, radius - 0.3 * edge),
            (-edge - within, radius),
            (within - radius.max(edge), radius),
        ];
        let below = corners.iter().rev().map(|&(x, y)| (x, -y));
        let all = corners.iter().copied().chain(below);
        all.map(|(x, y)| self.middle + direction * x + across * y).collect()
    }

    /// Whether a place lies in it, or so near to it.
    pub fn reaches(&self, at: Point2<f64>, near: f64) -> bool {
        let DrawnObject { radius, direction, .. } = self.object;
        let from = at - self.middle;
        let (along, across) = (from.dot(&direction), from.dot(&left(direction)));
        match self.half {
            Some((a, b)) => (along / (a + near)).powi(2) + (across / (b + near)).powi(2) <= 1.0,
            None => along <= near && across.abs() <= radius + near,
        }
    }
}

/// How far from a place a closed curve is first met on the way.
fn crossing(curve: &[Point2<f64>], from: Point2<f64>, way: Vector2<f64>) -> Option<f64> {
    let met = sides(curve).filter_map(|side| {
        let aside = side.map(|p| way.perp(&(p - from)));
        let along = side.map(|p| way.dot(&(p - from)));
        let meets = (aside[0] > 0.0) != (aside[1] > 0.0);
        let share = aside[0] / (aside[0] - aside[1]);
        meets.then(|| along[0] + share * (along[1] - along[0]))
    });
    met.min_by(f64::total_cmp)
}

/// Where no object can be: behind the rim outside of the wall, or without one behind the globe.
pub(super) fn hidden(wall: &[Point2<f64>], globe: &Outline, way: Vector2<f64>) -> Option<Shape> {
    let ring = if let [first, .., last] = wall {
        let out = (first - last).normalize();
        let middle = wall[wall.len() / 2];
        let back = left(out) * left(out).dot(&(middle - first)).signum();
        let mut ring = vec![first + out * FAR];
        ring.extend(wall);
        ring.extend([last - out * FAR, last + (back - out) * FAR, first + (out + back) * FAR]);
        ring
    } else {
        let aside = |p: &&Point2<f64>| left(way).dot(&p.coords);
        let by = |a: &&Point2<f64>, b: &&Point2<f64>| aside(a).total_cmp(&aside(b));
        let (low, high) = (globe.points.iter().min_by(by)?, globe.points.iter().max_by(by)?);
        vec![*low, *high, high + way * FAR, low + way * FAR]
    };
    Some(Shape::new(Part::Sky, ring))
}
