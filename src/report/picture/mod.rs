//! The eye as layers of filled shapes, for a terminal and for a page alike: the object, what holds
//! the globe, the globe with its field, and its tissues, each over the ones before.
//!
//! Places are those of the section, in m. Lens, iris and ciliary body are held by the tissue in
//! which they rest, so that they are smooth on every mesh and move as it does. What the models do
//! not compute and is drawn all the same: iris, ciliary body and optic nerve, the thickness of the
//! bone, how a ball bulges, and cornea and sclera 2.2 times as thick as they are.

pub mod field;
pub mod front;
pub mod moment;
mod object;
mod shell;

use nalgebra::{Point2, Vector2};
use std::f64::consts::{PI, TAU};

use crate::run::drawing::{Drawing, DrawnCell, Held};
use crate::run::kept::Frame;
use crate::run::places::{GLOBE_RADIUS_M, Region};
use object::{Hitting, hidden};
use shell::Outline;

/// What a place in a picture belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Part {
    /// Nothing.
    Sky,
    /// What hits the eye.
    Object,
    /// The same where the eye behind it is seen too: every other point is the object.
    Veil,
    /// Its outline.
    Skin,
    /// What holds the globe.
    Fat,
    /// The wall around that.
    Bone,
    Nerve,
    /// The inside of the globe, which a field fills.
    Globe,
    Ciliary,
    Lens,
    /// The hole in the iris, from the front.
    Pupil,
    Iris,
    Retina,
    Sclera,
    Cornea,
    /// The part of cornea and sclera that the object presses.
    Pressed,
    /// The border of cornea and sclera.
    Limbus,
}

impl Part {
    /// Whether it is so thin that it must not be lost.
    pub fn is_line(self) -> bool {
        self >= Self::Iris || self == Self::Skin
    }

    /// Whether it is seen without cutting the eye.
    pub fn is_outside(self) -> bool {
        use Part::{Bone, Cornea, Fat, Iris, Object, Sclera};
        matches!(self, Bone | Cornea | Fat | Iris | Object | Sclera)
    }

    /// Whether it lies inside the globe; of its shell nobody asks.
    pub fn is_inside(self) -> Option<bool> {
        use Part::{Bone, Ciliary, Fat, Globe, Iris, Lens, Nerve, Object, Pupil, Skin, Sky, Veil};
        match self {
            Globe | Ciliary | Lens | Iris | Pupil => Some(true),
            Sky | Object | Veil | Skin | Fat | Bone | Nerve => Some(false),
            _ => None,
        }
    }
}

/// A part of the picture: closed lines, filled whichever way they turn.
#[derive(Debug, Clone)]
pub struct Shape {
    pub part: Part,
    pub rings: Vec<Vec<Point2<f64>>>,
}

impl Shape {
    fn new(part: Part, ring: Vec<Point2<f64>>) -> Self {
        Self { part, rings: vec![ring] }
    }

    fn holds(&self, at: Point2<f64>) -> bool {
        self.rings.iter().any(|ring| {
            let crossed = sides(ring).filter(|[a, b]| {
                let aside = a.x + (at.y - a.y) / (b.y - a.y) * (b.x - a.x);
                (a.y > at.y) != (b.y > at.y) && at.x < aside
            });
            crossed.count() % 2 == 1
        })
    }
}

#[derive(Debug, Clone, Copy)]
pub struct DrawnDetail {
    /// The smallest thing that it can show, in m.
    pub grain: f64,
    /// How many times displacement is shown.
    pub zoom: f64,
    /// Points of the globe's outline, about.
    pub points: usize,
}

/// A grain above which several thin layers would only blur each other, in m.
const SMALL_M: f64 = 0.85e-3;
/// Front angle in rad behind which there is retina, and its thickness as drawn, in m.
const RETINA: (f64, f64) = (62.0 * PI / 180.0, 0.62e-3);
/// Front angle beyond which nothing of the globe counts as pressed, in rad.
const PRESSED: f64 = 72.0 * PI / 180.0;
/// How near the object must be to press, in m.
const NEAR_M: f64 = 0.35e-3;
/// Thickness of the bone and radius of its rim as drawn, in m.
const BONE_M: (f64, f64) = (2.6e-3, 1.8e-3);
/// Half of the width of the nerve, in m.
const NERVE_M: f64 = 1.9e-3;
/// Thickness of the iris, in m.
const IRIS_M: f64 = 0.55e-3;
/// Corners of a curve that is drawn as many short lines.
const SIDES: usize = 48;
/// Points of a globe's outline where they cost nothing.
pub const POINTS: usize = 200;

/// What an eye has in every picture of it: points that move with its tissue.
#[derive(Debug, Clone)]
pub struct Anatomy {
    lens: Vec<Held>,
    iris: [Vec<Held>; 2],
    ciliary: [Vec<Held>; 2],
    rest: Outline,
}

impl Anatomy {
    pub fn of(drawing: &Drawing) -> Self {
        let mm = |x: f64, y: f64| Point2::new(x * 1e-3, y * 1e-3);
        let held = |places: Vec<Point2<f64>>| -> Vec<Held> {
            places.into_iter().filter_map(|at| drawing.held(at)).collect()
        };
        let lens = (0..SIDES).map(|i| {
            let angle = TAU * i as f64 / SIDES as f64;
            mm(-6.6 - 1.8 * libm::cos(angle), 4.5 * libm::sin(angle))
        });
        let iris = |side: f64| {
            let part = |i: i32| f64::from(i) / 10.0;
            let points = (0..=10).map(|i| mm(-9.0 + 0.35 * part(i), side * (7.35 - 5.3 * part(i))));
            held(points.collect())
        };
        let ciliary = |side: f64| {
            let corners = [(-8.7, 7.3), (-7.6, 8.4), (-6.3, 9.3), (-6.4, 8.0), (-6.9, 6.3)];
            held(corners.map(|(x, y)| mm(x, side * y)).to_vec())
        };
        let (iris, ciliary) = ([1.0, -1.0].map(iris), [1.0, -1.0].map(ciliary));
        let rest = Outline::new(drawing, POINTS, |node| drawing.at_rest(&drawing.nodes[node]));
        Self { lens: held(lens.collect()), iris, ciliary, rest }
    }

    /// The outline of the globe at rest.
    pub fn ghost(&self) -> &[Point2<f64>] {
        &self.rest.points
    }

    /// All layers of a frame, the later over the earlier.
    pub fn layers(&self, drawing: &Drawing, frame: &Frame, detail: DrawnDetail) -> Vec<Shape> {
        let DrawnDetail { grain, zoom, .. } = detail;
        let place = |node: usize| drawing.place(frame, node, zoom);
        let moved = |held: &[Held]| -> Vec<Point2<f64>> {
            held.iter().map(|held| drawing.moved(frame, held, zoom)).collect()
        };
        let outline = Outline::new(drawing, detail.points, place);
        let wall: Vec<_> = drawing.outlines.wall.iter().map(|node| place(*node)).collect();
        let mut layers = Vec::new();
        let ball = Hitting::of(drawing, frame, &outline);
        if let Some(ball) = &ball {
            layers.extend(ball.shapes(grain));
            layers.extend(hidden(&wall, &outline, ball.object.direction));
        }
        if let (Some(fat), Some(bone)) = (fat(drawing, &place, &outline, &wall), bone(&wall)) {
            layers.push(fat);
            if drawing.outlines.bone {
                let back = (outline.points[outline.back()], self.rest.points[self.rest.back()]);
                layers.push(nerve(back, wall[wall.len() / 2]));
            }
            layers.push(bone);
        }
        layers.push(Shape::new(Part::Globe, outline.points.clone()));
        if grain <= SMALL_M {
            layers.extend(self.ciliary.iter().map(|part| Shape::new(Part::Ciliary, moved(part))));
        }
        layers.push(Shape::new(Part::Lens, moved(&self.lens)));
        let iris = |part: &Vec<_>| stroke(Part::Iris, &moved(part), IRIS_M.max(grain));
        layers.extend(self.iris.iter().map(iris));
        layers.extend(shell_layers(drawing, &outline, ball.as_ref(), detail));
        layers
    }
}

/// The sides of a closed curve.
fn sides(ring: &[Point2<f64>]) -> impl Iterator<Item = [Point2<f64>; 2]> {
    let next = ring.iter().cycle().skip(1);
    ring.iter().zip(next).map(|(a, b)| [*a, *b])
}

/// The sides of the object's outline in a frame that nothing covers.
pub fn object_sides(drawing: &Drawing, frame: &Frame) -> Vec<[Point2<f64>; 2]> {
    let place = |node: usize| drawing.place(frame, node, 1.0);
    let outline = Outline::new(drawing, POINTS, place);
    let wall: Vec<_> = drawing.outlines.wall.iter().map(|node| place(*node)).collect();
    let Some(ball) = Hitting::of(drawing, frame, &outline) else { return Vec::new() };
    let hidden = hidden(&wall, &outline, ball.object.direction);
    let fat = fat(drawing, &place, &outline, &wall);
    let globe = Shape::new(Part::Globe, outline.points.clone());
    let covers = [hidden, fat, Some(globe)];
    let free = |[a, b]: &[Point2<f64>; 2]| {
        let middle = nalgebra::center(a, b);
        !covers.iter().flatten().any(|shape| shape.holds(middle))
    };
    sides(&ball.ring(0.0)).filter(free).collect()
}

/// What lies between the wall, its free surface and the globe.
fn fat(
    drawing: &Drawing,
    place: &impl Fn(usize) -> Point2<f64>,
    outline: &Outline,
    wall: &[Point2<f64>],
) -> Option<Shape> {
    let [first, second] = &drawing.outlines.free;
    let of = |node: &usize| outline.index(drawing, *node);
    let (from, to) = (of(first.last()?)?, of(second.last()?)?);
    let mut ring = wall.to_vec();
    ring.extend(second.iter().map(|node| place(*node)));
    ring.extend(outline.points.get(from..=to)?.iter().rev());
    ring.extend(first.iter().rev().map(|node| place(*node)));
    Some(Shape::new(Part::Fat, ring))
}

/// Retina, sclera, cornea and what is pressed of them.
fn shell_layers(
    drawing: &Drawing,
    outline: &Outline,
    ball: Option<&Hitting>,
    detail: DrawnDetail,
) -> Vec<Shape> {
    let (small, least) = (detail.grain > SMALL_M, 1.35 * detail.grain);
    let limbus = drawing.outlines.limbus;
    let band = |part, inside: &dyn Fn(usize) -> bool, from: f64, to: f64, more: f64| {
        outline.band(part, least, |i| inside(i).then_some([from, to, more]))
    };
    let front = |i: usize| outline.front[i];
    let behind = |i: usize| front(i) >= RETINA.0;
    let mut shapes = Vec::new();
    if !small {
        let thick = RETINA.1.max(1.1 * detail.grain);
        shapes.push(band(Part::Retina, &behind, 1.0, 1.0, thick));
    }
    let sclera = |i: usize| front(i) >= limbus && !(small && behind(i));
    shapes.push(band(Part::Sclera, &sclera, 0.0, 1.0, 0.0));
    if small {
        shapes.push(band(Part::Retina, &behind, 0.0, 1.0, 0.0));
    }
    shapes.push(band(Part::Cornea, &|i| front(i) < limbus, 0.0, 1.0, 0.0));
    let pressed = |i: usize| {
        front(i) < PRESSED && ball.is_some_and(|ball| ball.reaches(outline.points[i], NEAR_M))
    };
    if !small {
        let is_limbus = |i: usize| (front(i - 1) < limbus) != (front(i) < limbus) && !pressed(i);
        let ticks = (1..outline.points.len()).filter(|i| is_limbus(*i));
        let rings = ticks.map(|i| outline.tick(i, 0.9e-3, least)).collect();
        shapes.push(Shape { part: Part::Limbus, rings });
    }
    let deep = if small { 1.0 } else { 0.5 };
    shapes.push(band(Part::Pressed, &pressed, 0.0, deep, 0.0));
    shapes
}

pub fn globe_cells(drawing: &Drawing) -> impl Iterator<Item = &DrawnCell> {
    let outside = |node: &usize| matches!(drawing.nodes[*node].region, Region::Fat | Region::Orbit);
    drawing.cells.iter().filter(move |cell| !cell.corners.iter().any(outside))
}

/// The unit vector a quarter turn to the left.
fn left(of: Vector2<f64>) -> Vector2<f64> {
    Vector2::new(-of.y, of.x).try_normalize(0.0).unwrap_or_default()
}

fn stroke(part: Part, line: &[Point2<f64>], width: f64) -> Shape {
    let last = line.len().saturating_sub(1);
    let side = |by: f64| {
        let normal = move |i: usize| left(line[(i + 1).min(last)] - line[i.saturating_sub(1)]);
        (0..line.len()).map(move |i| line[i] + normal(i) * by)
    };
    let there: Vec<_> = side(0.5 * width).collect();
    let back = side(-0.5 * width).rev();
    Shape::new(part, there.into_iter().chain(back).collect())
}

/// The bone along a wall, with its rounded rim.
fn bone(wall: &[Point2<f64>]) -> Option<Shape> {
    let (first, last) = (*wall.first()?, *wall.last()?);
    let count = wall.len();
    let outward = |i: usize| left(wall[(i + 1).min(count - 1)] - wall[i.saturating_sub(1)]);
    // The wall turns one way round or the other.
    let sense = outward(0).dot(&(first - last)).signum();
    let out: Vec<_> = (0..count).map(|i| wall[i] + outward(i) * (sense * BONE_M.0)).collect();
    let mut rings = vec![wall.iter().copied().chain(out.into_iter().rev()).collect::<Vec<_>>()];
    for (edge, next, i) in [(first, wall.get(1)?, 0), (last, &wall[count - 2], count - 1)] {
        let along = (next - edge).normalize();
        let middle = edge + (outward(i) * sense + along) * BONE_M.1 * 0.8;
        rings.push(ellipse(middle, Vector2::x() * BONE_M.1, Vector2::y() * BONE_M.1));
    }
    Some(Shape { part: Part::Bone, rings })
}

fn ellipse(middle: Point2<f64>, a: Vector2<f64>, b: Vector2<f64>) -> Vec<Point2<f64>> {
    let corner = |i: usize| {
        let angle = TAU * i as f64 / SIDES as f64;
        middle + a * libm::cos(angle) + b * libm::sin(angle)
    };
    (0..SIDES).map(corner).collect()
}

/// The nerve from the back of the globe to the apex of the orbit: it keeps its length and bends.
fn nerve((back, rest): (Point2<f64>, Point2<f64>), apex: Point2<f64>) -> Shape {
    let along = apex - back;
    let (length, now) = ((apex - rest).norm(), along.norm());
    // A full swing of this height has about that length; nearer to the apex it is pressed together.
    let bend = (now * (length - now)).max(0.0).sqrt().min(0.3 * now) / PI;
    let points = (0..=24).map(|i| {
        let share = f64::from(i) / 24.0;
        back + along * share + left(along) * (bend * libm::sin(TAU * share))
    });
    // Its end lies under the shell.
    let start = back - along.try_normalize(0.0).unwrap_or_default() * (0.05 * GLOBE_RADIUS_M);
    let line: Vec<_> = std::iter::once(start).chain(points).collect();
    stroke(Part::Nerve, &line, 2.0 * NERVE_M)
}
