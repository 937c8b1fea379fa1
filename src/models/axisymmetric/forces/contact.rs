//! Contact between an object and the shell, without friction, and the load of a pulse.
//!
//! Each segment carries four points of its area at rest; a point below the object's surface is
//! pushed out along its normal by the foundation's traction, so force and energy are exact to each
//! other. What is larger than the opening of the orbit meets the bone around it ([`Face`]).

use crate::models::axisymmetric::eye::{AxisymmetricEye, distance, front_angle, part};
use crate::models::axisymmetric::forces::face::Face;
use crate::models::axisymmetric::forces::object::{MovingObject, Object};
use std::f64::consts::PI;

/// Points in a segment.
const POINTS: usize = 4;
/// Mass per area that a point of contact moves at least, in kg/m2: a shell of 0.4 mm.
const SHELL_AREAL: f64 = 0.44;
/// The shell takes along its share of what lies behind, per length of a segment, in kg/m3.
const ENTRAINED: f64 = 0.1 * 1000.0;
/// Courant number of contact over that of the cells. By nodes, with all that moves with them, four
/// times as much would be stable, but the force of the node that is hit would not be followed.
const COURANT: f64 = 0.75;
/// What is nearer to an object than this counts as touched by it, in m.
pub(crate) const TOUCHING: f64 = 5e-5;
/// The Courant number where the object loses energy: the loss follows velocities half a step old.
pub(crate) const DAMPED: f64 = 0.5;

/// The shell as contact sees it.
pub(crate) struct Target {
    /// Area of each point at rest, m2, segment by segment.
    area: Vec<[f64; POINTS]>,
    /// Areal mass of each segment, kg/m2.
    areal: Vec<f64>,
    face: Option<Face>,
}

/// What contact does at some instant.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Touch {
    /// Force on the eye along the way of the projectile, N.
    pub force: f64,
    /// Force on the object by the rim, N.
    pub rim: f64,
    /// Stored, J.
    pub energy: f64,
    /// Longest stable step, s.
    pub limit: f64,
    /// Largest share of what gives way of the object's surface that is used up.
    pub used_up: f64,
    /// Power lost in the object's surface, W, less what [`MovingObject::lossy`] does.
    pub loss: f64,
    /// Farthest from the axis that the shell lies within [`TOUCHING`] of the object, m.
    pub radius: f64,
}

/// The last place where something holds, between one where it does and one where it fails.
pub(crate) fn last(mut holds: f64, mut fails: f64, of: impl Fn(f64) -> bool) -> f64 {
    /// Halvings that leave nothing between the two.
    const HALVINGS: usize = 60;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (holds + fails);
        if of(middle) {
            holds = middle;
        } else {
            fails = middle;
        }
    }
    holds
}

/// How far from the axis the object is touched between two points with their depths in it.
fn touched_to(a: (f64, f64), b: (f64, f64)) -> f64 {
    if b.0 >= -TOUCHING {
        b.1
    } else if a.0 >= -TOUCHING {
        a.1 + (a.0 + TOUCHING) / (a.0 - b.0) * (b.1 - a.1)
    } else {
        0.0
    }
}

impl Target {
    pub fn new(eye: &AxisymmetricEye) -> Self {
        let segment = |ends: &[usize]| {
            let (a, b) = (eye.at(ends[0]), eye.at(ends[1]));
            let length = distance(b, a);
            let areas = std::array::from_fn(|i| {
                let radius = a.1 + part(i, POINTS) * (b.1 - a.1);
                2.0 * PI * radius * length / POINTS as f64
            });
            (areas, SHELL_AREAL + ENTRAINED * length)
        };
        let (area, areal) = eye.mesh.shell.windows(2).map(segment).unzip();
        let around = eye.parameters.surround;
        Self { area, areal, face: around.map(|around| Face::beyond(around.edge())) }
    }

    /// Where the front of an object is as it first touches the front pole at `pole` or the rim, m.
    pub fn first_touch(&self, object: &Object, pole: f64) -> f64 {
        let face = self.face.as_ref();
        let overlaps =
            |front: f64| face.is_some_and(|face| face.overlaps(object, front - object.reach()));
        if !overlaps(pole) {
            return pole;
        }
        last(pole - 2.0 * object.outline.radius(), pole, |front| !overlaps(front))
    }

    /// Adds the forces of contact to those of the shell and of the projectile.
    pub fn forces(
        &self,
        object: &Object,
        projectile: &mut MovingObject,
        (x, r): (&[f64], &[f64]),
        (vx, vr): (&[f64], &[f64]),
        (fx, fr): (&mut [f64], &mut [f64]),
    ) -> Touch {
        let mut touch = Touch { limit: f64::INFINITY, ..Touch::default() };
        let centre = projectile.x[0];
        let near = object.near();
        let front = centre + object.reach() + near.max(TOUCHING);
        let mut before = (f64::NEG_INFINITY, 0.0);
        let (mut whole_slope, mut whole_damping) = (0.0, 0.0);
        for (i, areas) in self.area.iter().enumerate() {
            if x[i].min(x[i + 1]) > front {
                continue;
            }
            let (mut steepest, mut damping): (f64, f64) = (0.0, 0.0);
            for (point, area) in areas.iter().enumerate() {
                let s = part(point, POINTS);
                let (px, pr) = (x[i] + s * (x[i + 1] - x[i]), r[i] + s * (r[i + 1] - r[i]));
                let (gap, nx, nr) = object.gap(px - centre, pr);
                touch.radius = touch.radius.max(touched_to(before, (gap, pr)));
                before = (gap, pr);
                if gap <= -near {
                    continue;
                }
                let pressed = object.surface.at(gap.max(0.0));
                let speed = |v: &[f64]| v[i] + s * (v[i + 1] - v[i]);
                let closing = (projectile.v[0] - speed(vx)) * nx - speed(vr) * nr;
                let slope = object.surface.steepest(gap, pressed.slope, closing);
                steepest = steepest.max(slope);
                whole_slope += area * slope;
                if gap <= 0.0 {
                    continue;
                }
                let (left, change) = object.surface.hysteresis(object.speed, closing);
                damping = damping.max(change * pressed.traction);
                whole_damping += area * change * pressed.traction;
                let force = area * pressed.traction * left;
                let lossy = area * pressed.traction * (left - 1.0);
                touch.loss -= lossy * (speed(vx) * nx + speed(vr) * nr);
                projectile.lossy[0] -= lossy * nx;
                touch.energy += area * pressed.energy;
                touch.used_up = touch.used_up.max(object.surface.used_up(gap));
                touch.force += force * nx;
                fx[i] += (1.0 - s) * force * nx;
                fr[i] += (1.0 - s) * force * nr;
                fx[i + 1] += s * force * nx;
                fr[i + 1] += s * force * nr;
            }
            if steepest > 0.0 {
                let stable = COURANT * (self.areal[i] / steepest).sqrt();
                touch.limit = touch.limit.min(stable);
            }
            if damping > 0.0 {
                touch.limit = touch.limit.min(DAMPED * self.areal[i] / damping);
            }
        }
        // The object's own mass may be less than that of what it presses.
        if whole_slope > 0.0 {
            let stable = (projectile.mass[0] / whole_slope).sqrt();
            touch.limit = touch.limit.min(COURANT * stable);
        }
        if whole_damping > 0.0 {
            touch.limit = touch.limit.min(DAMPED * projectile.mass[0] / whole_damping);
        }
        projectile.force[0] -= touch.force;
        if let Some(face) = &self.face {
            let push = face.push(object, projectile);
            touch.rim = -push.force;
            touch.energy += push.energy;
            touch.limit = touch.limit.min(push.limit);
        }
        touch
    }

    /// Share of a pulse that each node of the shell takes: the area at rest within the front angle
    /// `half_width` (rad), a uniform traction along the axis. They add up to 1.
    pub fn shares(eye: &AxisymmetricEye, half_width: f64) -> Vec<f64> {
        /// Pieces of a segment, each loaded or not.
        const PIECES: usize = 1000;
        let mut shares = vec![0.0; eye.mesh.shell.len()];
        for (i, ends) in eye.mesh.shell.windows(2).enumerate() {
            let (a, b) = (eye.at(ends[0]), eye.at(ends[1]));
            let length = distance(b, a);
            for s in (0..PIECES).map(|piece| part(piece, PIECES)) {
                let (x, r) = (a.0 + s * (b.0 - a.0), a.1 + s * (b.1 - a.1));
                if front_angle((x, r)) < half_width {
                    shares[i] += (1.0 - s) * r * length;
                    shares[i + 1] += s * r * length;
                }
            }
        }
        let total: f64 = shares.iter().sum();
        if total > 0.0 {
            for share in &mut shares {
                *share /= total;
            }
        }
        shares
    }
}
