//! Contact between an object and the eye, without friction, and the load of a pulse.
//!
//! Each quad of the shell that lies open, and each free side of what holds the globe, carries four
//! points of its area at rest; a point below the object's surface is pushed out along its normal by
//! the foundation's traction, so force and energy are exact to each other. The laws are those of
//! the axisymmetric contact: depth and normal depend on the place along the way of the object and
//! the distance from the line through its middle. The points are Gauss's: so the pressure that a BB
//! makes in an eye that is alike on all sides depends on where it lands by 3 % to each side of the
//! middle; with points at the quarters by 4 %, and nine or sixteen points are no better.
//!
//! The bound of the step is that of rows: with Kn the stiffness that a node has a share in, no
//! frequency is above sqrt(2 Kn/mn) of some node or of the object; two thirds of 2 sqrt(m/K) are
//! below it.

use crate::models::axisymmetric::forces::contact::{DAMPED, TOUCHING};
use crate::models::axisymmetric::forces::object::{Object, ObjectOutline};
use crate::models::spatial::eye::{GAUSS, SpatialEye, areas, shares};
use crate::models::spatial::forces::object::{Line, MovingObject, touches};
use crate::models::spatial::forces::state::{NodeState, vector};
use nalgebra::Vector3;

/// How many times its stiffness counts for the step where the object is rigid, so that the force on
/// the node that is hit is followed: with once, a BB's energy is missed by up to 1.3 %, with four
/// times by 0.1 to 0.4. What gives way needs less.
const FOLLOWED: f64 = 4.0;
const FOLLOWED_SOFT: f64 = 1.5;
/// How many times its damping counts where this share of what gives way is used up: a light splash
/// at 25 degrees has its energy missed by 30 % with once, by 2 with four times.
const CRUSHED: f64 = 4.0;
const NEARLY: f64 = 0.8;
/// A quad may grow by this before it is looked at too late.
const GROWN: f64 = 2.0;

/// A quad that an object can touch.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Open {
    corners: [usize; 4],
    /// Area of each point at rest, m2.
    areas: [f64; 4],
    /// Longest diagonal at rest, m.
    size: f64,
    /// Its number among those of the shell, if it is one, and how much of it is cornea.
    shell: Option<(usize, f64)>,
}

/// The eye as contact sees it.
pub(crate) struct Target {
    quads: Vec<Open>,
    /// Places of nodes that are open but not of the shell, at rest.
    ahead: Vec<Vector3<f64>>,
    mass: Vec<f64>,
    copies: f64,
    /// Stiffness and damping that each node has a share in; all 0 between two calls.
    stiff: Vec<[f64; 2]>,
    pressed: Vec<usize>,
    /// The part of the forces on nodes that gives nothing back, N.
    lossy: Vec<(usize, Vector3<f64>)>,
    /// Whether the object touches each quad of the shell.
    pub touched: Vec<bool>,
}

/// What contact does at some instant.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Touch {
    /// Force on the eye, N.
    pub force: Vector3<f64>,
    /// Stored, J.
    pub energy: f64,
    /// Longest stable step by what the surface loses, s.
    pub limit: f64,
    /// What the object's own mass adds to the squared rate of the nodes it presses, 1/s2.
    pub stiff: f64,
    /// Largest share of what gives way of the object's surface that is used up.
    pub used_up: f64,
    /// Power lost in the object's surface, W, less what its own motion does.
    pub loss: f64,
    /// Area of the shell, across the way of the object, that is touched, m2.
    pub area: f64,
    /// As far as that is cornea, m2.
    pub cornea: f64,
}

/// The share of a triangle in which a linear depth is above 0.
fn above(depths: [f64; 3]) -> f64 {
    let positive = depths.iter().filter(|d| **d > 0.0).count();
    let share = |alone: f64, others: [f64; 2]| {
        (alone / (alone - others[0])) * (alone / (alone - others[1]))
    };
    let alone = |wanted: bool| (0..3).find(|i| (depths[*i] > 0.0) == wanted).unwrap_or(0);
    match positive {
        0 => 0.0,
        3 => 1.0,
        _ => {
            let i = alone(positive == 1);
            let part = share(depths[i], [depths[(i + 1) % 3], depths[(i + 2) % 3]]);
            if positive == 1 { part } else { 1.0 - part }
        }
    }
}

/// Depth of a place in an object at `at`, and the way that it decreases.
pub(crate) fn depth(
    object: &Object,
    projectile: &MovingObject,
    place: Vector3<f64>,
) -> (f64, Vector3<f64>) {
    let from = place - projectile.at[0];
    let along = from.dot(&projectile.way);
    let across = from - projectile.way * along;
    let r = across.norm();
    let (gap, nx, nr) = object.gap(along, r);
    let aside = if r > 0.0 { across / r } else { across };
    (gap, projectile.way * nx + aside * nr)
}

impl Target {
    /// What an object of this radius, in m, can touch.
    pub fn new(eye: &SpatialEye, radius: f64) -> Self {
        let at = |node: usize| eye.mesh.at[node];
        let numbered = eye.quads.iter().enumerate();
        let shell: std::collections::BTreeMap<_, _> =
            numbered.map(|(i, quad)| (sorted(quad.corners), (i, 1.0 - quad.sclera))).collect();
        let quads = eye.open_quads().into_iter().map(|corners| {
            let p = corners.map(at);
            Open {
                corners,
                areas: areas(&p, GAUSS),
                size: (p[2] - p[0]).norm().max((p[3] - p[1]).norm()),
                shell: shell.get(&sorted(corners)).copied(),
            }
        });
        // A thing that fits a round holder's opening lands on what fills it; what is wider meets
        // nothing there, as in the axisymmetric eye: where a cup ends is an assumption.
        let fits = eye.parameters.surround.is_none_or(|surround| radius < surround.edge().1);
        let soft = fits || eye.rim.is_some_and(|rim| !rim.is_round());
        let quads: Vec<Open> = quads.filter(|quad| soft || quad.shell.is_some()).collect();
        let free = quads.iter().filter(|quad| quad.shell.is_none());
        Self {
            ahead: free.flat_map(|quad| quad.corners.map(at)).collect(),
            quads,
            mass: eye.mass.clone(),
            copies: eye.copies(),
            stiff: vec![[0.0; 2]; eye.mass.len()],
            pressed: Vec::new(),
            lossy: Vec::new(),
            touched: vec![false; eye.quads.len()],
        }
    }

    /// How far along its way an object comes before it touches what lies in front of bone.
    pub fn first_touch(&self, outline: ObjectOutline, line: Line) -> Option<f64> {
        self.ahead.iter().filter_map(|at| touches(outline, line, *at, 0.0)).reduce(f64::min)
    }

    /// Whether an object is far from a quad.
    fn far(object: &Object, projectile: &MovingObject, place: Vector3<f64>, size: f64) -> bool {
        let reach = GROWN * size + object.near().max(TOUCHING);
        let from = place - projectile.at[0];
        match object.outline {
            ObjectOutline::Sphere(radius) => from.norm_squared() > (radius + reach).powi(2),
            ObjectOutline::Cylinder(radius, _) => {
                let along = from.dot(&projectile.way);
                let square = from.norm_squared() - along * along;
                along > reach || square > (radius + reach).powi(2)
            }
        }
    }

    /// Makes nodes stiffer by what they have a share in, which it takes from them.
    fn stiffen(&mut self, state: &mut NodeState) {
        for &node in &self.pressed {
            let [stiffness, damping] = std::mem::take(&mut self.stiff[node]);
            state.stiffen(node, self.mass[node], (stiffness, damping));
        }
        self.pressed.clear();
    }

    /// The power that the nodes lose by what gives nothing back, as fast as they move now, W.
    pub fn loss(&self, state: &NodeState) -> f64 {
        let lost = |(node, force): &(usize, Vector3<f64>)| force.dot(&vector(&state.speed, *node));
        -self.copies * self.lossy.iter().map(lost).sum::<f64>()
    }

    /// Adds the forces of contact to those of nodes and to the projectile's.
    pub fn forces(
        &mut self,
        object: &Object,
        projectile: &mut MovingObject,
        state: &mut NodeState,
    ) -> Touch {
        let mut touch = Touch::default();
        self.lossy.clear();
        let near = object.near();
        let soft = object.surface.depth.is_some();
        let followed = if soft { FOLLOWED_SOFT } else { FOLLOWED };
        let (mut whole_slope, mut whole_damping) = (0.0, 0.0);
        for quad in &self.quads {
            if let Some((number, _)) = quad.shell {
                self.touched[number] = false;
            }
            if Self::far(object, projectile, vector(&state.at, quad.corners[0]), quad.size) {
                continue;
            }
            let p = quad.corners.map(|node| vector(&state.at, node));
            let v = quad.corners.map(|node| vector(&state.speed, node));
            let (mut forces, mut lossy) = ([Vector3::zeros(); 4], [Vector3::zeros(); 4]);
            let (mut pressed_any, mut close) = (false, false);
            let mut depths = [0.0; 4];
            for (point, area) in quad.areas.iter().enumerate() {
                let shares = shares(GAUSS[point & 1], GAUSS[point >> 1]);
                let mix = |of: &[Vector3<f64>; 4]| -> Vector3<f64> {
                    (0..4).map(|i| of[i] * shares[i]).sum()
                };
                let (gap, normal) = depth(object, projectile, mix(&p));
                depths[point] = gap;
                close |= gap > -TOUCHING;
                if gap <= -near {
                    continue;
                }
                let pressed = object.surface.at(gap.max(0.0));
                let speed = mix(&v).dot(&normal);
                let closing = projectile.speed[0].dot(&normal) - speed;
                let slope = object.surface.steepest(gap, pressed.slope, closing);
                let (left, change) = object.surface.hysteresis(object.speed, closing);
                let damping = if gap > 0.0 { change * pressed.traction } else { 0.0 };
                // Beside its line the depth in a ball that gives way changes faster than a place
                // moves, and its normal turns.
                let steep = normal.norm_squared();
                let slope = followed * steep * (slope + pressed.traction * object.bend(gap));
                let crushed = object.surface.used_up(gap) > NEARLY;
                let damping = if crushed { CRUSHED * steep } else { steep } * damping;
                whole_slope += area * slope;
                whole_damping += area * damping;
                for (node, share) in quad.corners.into_iter().zip(shares) {
                    let stiff = &mut self.stiff[node];
                    if stiff[0] == 0.0 {
                        self.pressed.push(node);
                    }
                    stiff[0] += share * area * slope;
                    stiff[1] += share * area * damping;
                }
                if gap <= 0.0 {
                    continue;
                }
                pressed_any = true;
                let force = area * pressed.traction * left;
                let lost = area * pressed.traction * (left - 1.0);
                touch.loss -= lost * speed;
                projectile.lossy[0] -= normal * (lost * self.copies);
                touch.energy += area * pressed.energy;
                touch.used_up = touch.used_up.max(object.surface.used_up(gap));
                touch.force += normal * force;
                for i in 0..4 {
                    forces[i] += normal * (force * shares[i]);
                    lossy[i] += normal * (lost * shares[i]);
                }
            }
            if pressed_any {
                for (node, force) in quad.corners.into_iter().zip(forces) {
                    state.push(node, force);
                }
                self.lossy.extend(quad.corners.into_iter().zip(lossy));
            }
            if let Some((number, cornea)) = quad.shell.filter(|_| close) {
                let area = touched(depths, projectile.way, &p);
                self.touched[number] = area > 0.0;
                touch.area += area;
                touch.cornea += cornea * area;
            }
        }
        self.stiffen(state);
        touch.limit = f64::INFINITY;
        touch.force *= self.copies;
        if self.copies > 1.0 {
            touch.force.z = 0.0;
            projectile.lossy[0].z = 0.0;
        }
        touch.energy *= self.copies;
        touch.loss *= self.copies;
        touch.area *= self.copies;
        touch.cornea *= self.copies;
        touch.stiff = 0.25 * self.copies * whole_slope / projectile.mass[0];
        if whole_damping > 0.0 {
            let damped = projectile.mass[0] / (self.copies * whole_damping);
            touch.limit = touch.limit.min(DAMPED * damped);
        }
        projectile.force[0] -= touch.force;
        touch
    }
}

fn sorted(mut of: [usize; 4]) -> [usize; 4] {
    of.sort_unstable();
    of
}

/// Area of a quad, across the way of the object, that lies within [`TOUCHING`] of it, from the
/// depths of its points: between them and beyond they are taken to change evenly.
fn touched(depths: [f64; 4], way: Vector3<f64>, p: &[Vector3<f64>; 4]) -> f64 {
    let depths = depths.map(|depth| depth + TOUCHING);
    // At both ends of what is known at the points.
    let beyond = GAUSS[0] / (GAUSS[1] - GAUSS[0]);
    let ends = |a: f64, b: f64| (a + (a - b) * beyond, b + (b - a) * beyond);
    let (low, high) = (ends(depths[0], depths[1]), ends(depths[2], depths[3]));
    let (first, last) = (ends(low.0, high.0), ends(low.1, high.1));
    let corners = [first.0, last.0, last.1, first.1];
    let middle = (p[0] + p[1] + p[2] + p[3]) * 0.25;
    let inner = 0.25 * depths.iter().sum::<f64>();
    (0..4)
        .map(|i| {
            let k = (i + 1) % 4;
            let normal = (p[i] - middle).cross(&(p[k] - middle));
            0.5 * normal.dot(&way).abs() * above([corners[i], corners[k], inner])
        })
        .sum()
}
