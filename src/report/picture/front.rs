//! The eye from the front, as an examiner who faces the patient sees it: the bone's edge, the
//! globe, limbus, iris and pupil as they move and bend, and the outline of the object, which is let
//! through: half-toned while it presses, in dashes before and in dots after.
//!
//! An axisymmetric eye that is hit straight on is round from there; hit from the side it cannot be
//! seen so. What is drawn and not computed: iris and pupil, which go with the limbus.

use nalgebra::{Point2, Vector2};
use std::f64::consts::TAU;

use crate::report::picture::{Part, Shape, moment::Stage, stroke};
use crate::run::drawing::Drawing;
use crate::run::kept::{Frame, FrontFrame};
use crate::scenario::Side;

/// From the middle of the eye to the edge of the picture, in m.
pub const REACH_M: f64 = 25e-3;
/// How far the bone goes outward, in m.
const BONE_M: f64 = 3.5e-3;
/// The rims of iris and pupil, as shares of the limbus.
const IRIS: f64 = 0.88;
const PUPIL: f64 = 0.32;
const CORNERS: usize = 72;
/// Radius of an object below which its outline would be lost in the pupil: it is filled, in m.
const SMALL_M: f64 = 3.5e-3;
/// A blow straight on has no larger part to a side than this share.
const STRAIGHT: f64 = 1e-9;

fn circle(middle: Point2<f64>, radius: f64) -> Vec<Point2<f64>> {
    let point = |i: usize| {
        let angle = TAU * i as f64 / CORNERS as f64;
        middle + Vector2::new(libm::sin(angle), libm::cos(angle)) * radius
    };
    (0..CORNERS).map(point).collect()
}

/// What is seen of a frame from the front; none of a section that is hit from the side.
pub fn seen(drawing: &Drawing, frame: &Frame) -> Option<FrontFrame> {
    if let Some(front) = &frame.front {
        return Some(front.clone());
    }
    drawing.object.filter(|object| object.direction.y.abs() <= STRAIGHT)?;
    let (shell, limbus) = (&drawing.outlines.shell, drawing.outlines.limbus);
    let middle = Point2::origin();
    let aside = |node: &usize| drawing.place(frame, *node, 1.0).y.abs();
    let front = |node: &&usize| {
        let rest = drawing.at_rest(&drawing.nodes[**node]);
        libm::atan2(rest.y.abs(), -rest.x)
    };
    let limbus = circle(middle, aside(shell.iter().find(|node| front(node) >= limbus)?));
    let equator = circle(middle, shell.iter().map(aside).fold(0.0, f64::max));
    Some(FrontFrame { limbus, equator, object: middle })
}

fn mean(ring: &[Point2<f64>]) -> Point2<f64> {
    let sum: Vector2<f64> = ring.iter().map(|at| at.coords).sum();
    Point2::from(sum / ring.len().max(1) as f64)
}

/// A ring of the same form about its middle, so many times as large.
fn scaled(ring: &[Point2<f64>], times: f64) -> Vec<Point2<f64>> {
    let middle = mean(ring);
    ring.iter().map(|at| middle + (at - middle) * times).collect()
}

/// All layers of a frame as [`seen`], the later over the earlier; no less than `grain` m shows.
pub fn layers(
    (drawing, frame): (&Drawing, &Frame),
    (side, stage): (Side, Stage),
    grain: f64,
) -> Option<Vec<Shape>> {
    let front = seen(drawing, frame)?;
    let across = |at: Point2<f64>| match side {
        Side::Right => at,
        Side::Left => Point2::new(-at.x, at.y),
    };
    let faced = |ring: Vec<Point2<f64>>| -> Vec<_> { ring.into_iter().map(across).collect() };
    let mut layers = Vec::new();
    if let Some(wall) = drawing.outlines.wall.first() {
        let far = || drawing.at_rest(&drawing.nodes[*wall]).y.abs();
        let measured = Some(&drawing.rim).filter(|rim| !rim.is_empty()).cloned();
        let rim = measured.unwrap_or_else(|| circle(Point2::origin(), far()));
        if drawing.outlines.bone {
            let out = |at: &Point2<f64>| at + at.coords.normalize() * BONE_M;
            layers.push(Shape::new(Part::Bone, faced(rim.iter().map(out).collect())));
        }
        layers.push(Shape::new(Part::Fat, faced(rim)));
    }
    let limbus = faced(front.limbus);
    let tissues = [
        (Part::Sclera, faced(front.equator)),
        (Part::Cornea, limbus.clone()),
        (Part::Iris, scaled(&limbus, IRIS)),
        (Part::Pupil, scaled(&limbus, PUPIL)),
    ];
    layers.extend(tissues.map(|(part, ring)| Shape::new(part, ring)));
    if let Some(object) = drawing.object {
        let mut ring = faced(circle(front.object, object.radius));
        match stage {
            _ if object.radius < SMALL_M => layers.push(Shape::new(Part::Object, ring.clone())),
            Stage::Pressing => layers.push(Shape::new(Part::Veil, ring.clone())),
            Stage::Before | Stage::After => {}
        }
        ring.extend(ring.first().copied());
        let thick = grain.max(0.6e-3);
        match stage {
            // Whole while it presses, in dashes before and in dots after.
            Stage::Pressing => layers.push(stroke(Part::Skin, &ring, thick)),
            Stage::Before | Stage::After => {
                let dash = if stage == Stage::Before { 4 } else { 1 };
                let parts = (0..CORNERS).step_by(6).map(|at| &ring[at..=(at + dash)]);
                layers.extend(parts.map(|part| stroke(Part::Skin, part, thick)));
            }
        }
    }
    Some(layers)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::solve::tests::answered_with;
    use crate::run::kept::{Keep, Spacing};
    use crate::scenario::library::tests::preset;

    /// Layers of the last frame of a BB of 0.1 ms in gelatin.
    fn last(changes: &[(&str, &str)], side: Side) -> Option<Vec<Shape>> {
        let first = [("model.support", "Gelatin"), ("window_ms", "0.1")];
        let scenario = preset("bb-62", &[&first, changes].concat());
        let keep = Keep { frames: Some(Spacing::even(0.05e-3)), ..Keep::default() };
        let answer = answered_with(&scenario, keep);
        let (drawing, frames) = (answer.case.eye.drawing(), &answer.run.frames);
        layers((&drawing, frames.last().unwrap()), (side, Stage::Pressing), 1e-4)
    }

    fn ring(layers: &[Shape], part: Part) -> &[Point2<f64>] {
        &layers.iter().find(|shape| shape.part == part).unwrap().rings[0]
    }

    fn middle(layers: &[Shape], part: Part) -> Vector2<f64> {
        mean(ring(layers, part)).coords
    }

    #[test]
    fn an_object_aimed_at_the_nose_is_right_of_a_right_eye_and_left_of_a_left_one() {
        let aside = [("impact.offset_mm", "5"), ("impact.offset_clock", "3")];
        let right = last(&aside, Side::Right).unwrap();
        let left = last(&aside, Side::Left).unwrap();
        let object = middle(&right, Part::Object);
        assert!((object.x - 5e-3).abs() < 1e-3 && object.y.abs() < 0.3e-3, "{object}");
        assert!((middle(&left, Part::Object).x + object.x).abs() < 1e-12);
        // The globe stands where it was, and its limbus has a radius of some 6 mm.
        assert!(middle(&right, Part::Sclera).norm() < 0.5e-3);
        let widest = ring(&right, Part::Cornea).iter().map(|at| at.coords.norm());
        assert!((5e-3..8e-3).contains(&widest.fold(0.0, f64::max)));
    }

    #[test]
    fn an_object_looks_otherwise_before_while_and_after_it_presses() {
        let scenario =
            preset("squash-ball", &[("numerics.geometry", "Axisymmetric"), ("window_ms", "0.1")]);
        let keep = Keep { frames: Some(Spacing::even(0.05e-3)), ..Keep::default() };
        let answer = answered_with(&scenario, keep);
        let drawing = answer.case.eye.drawing();
        let count = |stage| {
            let frame = answer.run.frames.last().unwrap();
            let layers = layers((&drawing, frame), (Side::Right, stage), 1e-4).unwrap();
            [Part::Veil, Part::Skin, Part::Object]
                .map(|part| layers.iter().filter(|shape| shape.part == part).count())
        };
        let counts = [Stage::Before, Stage::Pressing, Stage::After].map(count);
        // The eye is seen through it, and no dot in its middle reads as a wound.
        assert_eq!(counts, [[0, 12, 0], [1, 1, 0], [0, 12, 0]]);
    }

    #[test]
    fn straight_on_an_eye_is_round_and_a_section_that_is_hit_aside_is_not_seen_from_the_front() {
        let straight = last(&[], Side::Right).unwrap();
        for part in [Part::Sclera, Part::Cornea, Part::Object] {
            assert!(middle(&straight, part).norm() < 0.1e-3, "{part:?}");
        }
        let turned = [("numerics.geometry", "Axisymmetric"), ("impact.angle_deg", "30")];
        assert!(last(&turned, Side::Right).is_none());
    }
}
