//! The outline of the globe: a smooth closed curve through the nodes of its shell, and the layers
//! inwards from it.

use nalgebra::{Point2, Vector2};

use crate::report::picture::{Part, Shape, left, sides};
use crate::run::drawing::Drawing;

/// How many times as thick as it is the shell is drawn.
const THICKER: f64 = 2.2;

/// A closed curve, with what is known along it.
#[derive(Debug, Clone)]
pub(super) struct Outline {
    pub points: Vec<Point2<f64>>,
    /// Angle from the front at rest, in rad.
    pub front: Vec<f64>,
    /// Of the shell as it is drawn, in m.
    thickness: Vec<f64>,
    /// 1 where the left of the way round lies inside, else -1.
    sense: f64,
}

impl Outline {
    /// Through the places that nodes have now, of about so many points.
    pub fn new(drawing: &Drawing, points: usize, place: impl Fn(usize) -> Point2<f64>) -> Self {
        let shell = &drawing.outlines.shell;
        let count = shell.len();
        let split = (points / count.max(1)).max(1);
        let knots: Vec<_> = shell.iter().map(|node| place(*node)).collect();
        let angle = |node: &usize| {
            let at = drawing.at_rest(&drawing.nodes[*node]);
            libm::atan2(at.y, -at.x).abs()
        };
        let angles: Vec<f64> = shell.iter().map(angle).collect();
        let thick: Vec<f64> = drawing.outlines.thickness.iter().map(|t| THICKER * t).collect();
        let (mut points, mut front, mut thickness) = (Vec::new(), Vec::new(), Vec::new());
        for i in 0..count {
            let p = [i + count - 1, i, i + 1, i + 2].map(|i| knots[i % count].coords);
            for s in (0..split).map(|k| k as f64 / split as f64) {
                // Catmull and Rom's cubic.
                let curve = p[1] * 2.0
                    + (p[2] - p[0]) * s
                    + (p[0] * 2.0 - p[1] * 5.0 + p[2] * 4.0 - p[3]) * (s * s)
                    + (p[1] * 3.0 - p[0] - p[2] * 3.0 + p[3]) * (s * s * s);
                points.push(Point2::from(curve * 0.5));
                let between = |of: &[f64]| of[i] * (1.0 - s) + of[(i + 1) % count] * s;
                front.push(between(&angles));
                thickness.push(between(&thick));
            }
        }
        let area: f64 = sides(&points).map(|[a, b]| a.coords.perp(&b.coords)).sum();
        Self { points, front, thickness, sense: area.signum() }
    }

    /// Where on the curve a node rests, or the node of the shell next to it.
    pub fn index(&self, drawing: &Drawing, node: usize) -> Option<usize> {
        let rest = |node: usize| drawing.at_rest(&drawing.nodes[node]);
        let apart = |other: &usize| (rest(*other) - rest(node)).norm();
        let shell = drawing.outlines.shell.iter().map(apart).enumerate();
        let (place, _) = shell.min_by(|a, b| a.1.total_cmp(&b.1))?;
        Some(place * self.points.len() / drawing.outlines.shell.len())
    }

    pub fn back(&self) -> usize {
        self.front.iter().enumerate().max_by(|a, b| a.1.total_cmp(b.1)).map_or(0, |(i, _)| i)
    }

    fn inward(&self, i: usize) -> Vector2<f64> {
        let count = self.points.len();
        let along = self.points[(i + 1) % count] - self.points[(i + count - 1) % count];
        left(along) * self.sense
    }

    /// A layer of the shell: `of` a point it says from which to which share of the thickness, and
    /// how far beyond, in m; the thickness is `least` at least.
    pub fn band(&self, part: Part, least: f64, of: impl Fn(usize) -> Option<[f64; 3]>) -> Shape {
        let count = self.points.len();
        let across = |i: usize, [from, to, more]: [f64; 3]| {
            let (at, inward) = (self.points[i], self.inward(i));
            let thick = self.thickness[i].max(least);
            (at + inward * (from * thick), at + inward * (to * thick + more))
        };
        let mut rings = Vec::new();
        let start = (0..count).find(|i| of(*i).is_none()).unwrap_or(0);
        let (mut outer, mut inner) = (Vec::new(), Vec::new());
        let mut last = None;
        for (i, ends) in (start..=start + count).map(|i| (i % count, i == start + count)) {
            let here = of(i);
            // It goes on to where the next one begins.
            if let Some(layer) = here.or(last) {
                let (out, into) = across(i, layer);
                outer.push(out);
                inner.push(into);
            }
            if (here.is_none() || ends) && !outer.is_empty() {
                outer.extend(inner.drain(..).rev());
                rings.push(std::mem::take(&mut outer));
            }
            last = here;
        }
        Shape { part, rings }
    }

    /// A mark across the shell, of some width.
    pub fn tick(&self, i: usize, width: f64, least: f64) -> Vec<Point2<f64>> {
        let (at, inward) = (self.points[i], self.inward(i));
        let aside = left(inward) * (0.5 * width);
        let deep = inward * self.thickness[i].max(least);
        vec![at - aside, at + aside, at + aside + deep, at - aside + deep]
    }
}
