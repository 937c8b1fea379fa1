//! A disc in frictionless contact with the segments of the shell and with the rim of the orbit.
//!
//! A segment whose distance d from the centre of the disc is less than the radius R stores
//!
//! U = k/2 (R - d)^2,
//!
//! and so do the two points of the rim, with a stiffness of their own. The force on the disc is
//! k (R - d) along the line from the closest point to the centre; the segment takes the opposite,
//! shared by its two ends in the ratio in which the closest point divides it. d is a smooth function
//! of all positions wherever the centre lies outside the segment, so each force is continuous, also
//! as the closest point passes over a joint, and derives from a potential. Where two segments share
//! the closest point both push, so a joint is up to twice as stiff as the middle of a segment.
//!
//! The penalty k is a number of the method, not of nature. It is chosen such that two nodes of the
//! shell, met at full speed, stop within [`AIM`] of the diameter, and that the whole object, stopped
//! by a stiff eye, stays within it too.
//!
//! A projectile with a spring of its own has a surface without mass, shifted by u against the mass
//! along the line of its flight. The shift is where the energy of the spring (see
//! [`crate::models::paper::forces::object_spring`]) and `U(c + u e)` together are least, found by
//! Newton's method without the curvature of d; the spring is then in series with the penalty. Across
//! the line the surface stays with the mass: free to shift there too, a soft ball wedged in the rim
//! would lose its balance, as the curvature of the contact, F/R, can outweigh its spring.
//!
//! Left out: friction and spin; a surface that changes its shape, so a soft ball never bulges into
//! the orbit; and the third dimension, in which a ball is no rod. Rim and bone are rigid and fixed.

use crate::models::paper::eye::cross;
use crate::run::places::ORBIT_RADIUS_M;
use crate::models::paper::forces::object_spring::ObjectSpring;
use crate::scenario::{Projectile, ProjectileStiffness};
use nalgebra::{Point2, Vector2};

/// Penetration that the penalty aims at, as a share of the diameter.
pub const AIM: f64 = 0.007;
/// Stiffness of an eye between bone and a large object, in N/m, for the estimate of the largest
/// force: three times the secant stiffness that Kennedy and Duma (2008) measured.
const STIFF_EYE_N_M: f64 = 1e5;
/// Rounds that the search for the shift of the surface takes at most.
const MAX_ROUNDS: usize = 60;
/// Change of the shift, as a share of the radius, at which it is found.
const SETTLED: f64 = 1e-13;
/// Halvings of an interval that leave nothing of it.
const HALVINGS: usize = 80;

/// The object at one instant.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Body {
    /// Centre of mass, in m.
    pub position: Point2<f64>,
    /// m/s.
    pub velocity: Vector2<f64>,
    /// m/s^2.
    pub acceleration: Vector2<f64>,
    /// Shift of the surface against the mass, in m; zero for a rigid object.
    pub shift: Vector2<f64>,
}

impl Default for Body {
    fn default() -> Self {
        Self {
            position: Point2::origin(),
            velocity: Vector2::zeros(),
            acceleration: Vector2::zeros(),
            shift: Vector2::zeros(),
        }
    }
}

/// What one evaluation of the contact gives.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Touch {
    /// Force of the shell on the disc, in N.
    pub shell: Vector2<f64>,
    /// Force of the rim on the disc, in N.
    pub rim: Vector2<f64>,
    /// Energy stored in the penalty and in the projectile's spring, in J.
    pub potential: f64,
    /// Largest penetration of shell or rim, in m.
    pub penetration: f64,
    /// Distance between the surfaces of disc and shell, in m; negative where they penetrate.
    pub gap: f64,
    /// The same for the rim.
    pub rim_gap: f64,
    /// Segments tested.
    pub tests: usize,
}

/// A projectile compiled for one eye.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    /// Radius of the disc, in m.
    pub radius: f64,
    /// Mass, in kg.
    pub mass: f64,
    /// Unit vector along which it arrives.
    pub direction: Vector2<f64>,
    /// Speed at the start, in m/s.
    pub speed: f64,
    /// Where its centre starts: just touching, or, if it would touch nothing, abreast of the eye.
    pub start: Point2<f64>,
    /// Penalty of a segment of the shell, in N/m.
    pub penalty: f64,
    /// Penalty of a point of the rim, in N/m.
    pub rim_penalty: f64,
    /// The projectile's own spring, where it is soft.
    pub spring: Option<ObjectSpring>,
    /// The edge of the opening, in m.
    pub rim: [Point2<f64>; 2],
    /// Mass of a node of the shell, in kg.
    pub node_mass: f64,
}

/// The point of the segment from `a` to `b` that is closest to `c`, as a share of the way from `a`.
fn closest(a: Point2<f64>, b: Point2<f64>, c: Point2<f64>) -> f64 {
    let (d, r) = (b - a, c - a);
    let square = d.norm_squared();
    if square > 0.0 {
        (r.dot(&d) / square).clamp(0.0, 1.0)
    } else {
        0.0
    }
}

/// Vector from the closest point of the segment to `c`, and where that point lies.
fn from_segment(a: Point2<f64>, b: Point2<f64>, c: Point2<f64>) -> (Vector2<f64>, f64) {
    let t = closest(a, b, c);
    (c - (a + (b - a) * t), t)
}

/// Neighbours on a closed ring.
fn segments(ring: &[Point2<f64>]) -> impl Iterator<Item = (usize, usize)> {
    let count = ring.len();
    (0..count).map(move |i| (i, if i + 1 == count { 0 } else { i + 1 }))
}

/// Distance of `c` from a convex ring with all it encloses.
fn distance_from_filled(ring: &[Point2<f64>], c: Point2<f64>) -> f64 {
    if segments(ring).all(|(a, b)| cross(ring[a], ring[b], c) >= 0.0) {
        return 0.0;
    }
    segments(ring)
        .map(|(a, b)| from_segment(ring[a], ring[b], c).0.norm())
        .fold(f64::INFINITY, f64::min)
}

impl Contact {
    /// Compiles `input` for the shell `ring` at rest, whose nodes weigh `node_mass` kg each, in an
    /// orbit that is open up to the front angle `opening`.
    pub fn new(input: &Projectile, ring: &[Point2<f64>], node_mass: f64, opening: f64) -> Self {
        let (mass, radius) = (input.mass_g * 1e-3, input.diameter_mm * 0.5e-3);
        let speed = input.speed_m_s;
        let angle = input.angle_deg.to_radians();
        let direction = Vector2::new(libm::cos(angle), -libm::sin(angle));
        let side = Vector2::new(-direction.y, direction.x) * (input.offset_mm * 1e-3);
        let spring = match input.stiffness {
            ProjectileStiffness::Rigid => None,
            ProjectileStiffness::Linear { n_per_m } => {
                Some(ObjectSpring::new(n_per_m, 2.0 * radius))
            }
        };
        let rim = [1.0, -1.0].map(|sign| {
            Point2::new(
                -ORBIT_RADIUS_M * libm::cos(opening),
                sign * ORBIT_RADIUS_M * libm::sin(opening),
            )
        });

        let aim = AIM * 2.0 * radius;
        let sustained = |stiffness: f64| speed * (mass * stiffness).sqrt() / aim;
        let reduced = 1.0 / (1.0 / mass + 0.5 / node_mass);
        let by_nodes = reduced * (speed / aim).powi(2);
        let by_bone = mass * (speed / aim).powi(2);
        let (penalty, rim_penalty) = match spring {
            None => (by_nodes.max(sustained(STIFF_EYE_N_M)), by_bone),
            // The spring between nodes and mass limits every force.
            Some(spring) => {
                let greatest = spring.greatest_force(0.5 * mass * speed * speed);
                let limit = (greatest / aim).max(spring.stiffness);
                (by_nodes.max(sustained(STIFF_EYE_N_M)).min(limit), limit)
            }
        };
        let mut contact = Self {
            radius,
            mass,
            direction,
            speed,
            start: Point2::origin() + side,
            penalty,
            rim_penalty,
            spring,
            rim,
            node_mass,
        };
        contact.place(ring, side);
        contact
    }

    /// Puts the disc where its path first touches shell or rim.
    fn place(&mut self, ring: &[Point2<f64>], side: Vector2<f64>) {
        let origin = Point2::origin() + side;
        let on_path = |s: f64| origin - self.direction * s;
        // The shell at rest is convex, so this falls to one valley and rises again.
        let gap = |s: f64| distance_from_filled(ring, on_path(s)) - self.radius;
        let far = 4.0 * ORBIT_RADIUS_M + self.radius + side.norm();
        let nearest = lowest(gap, -far, far);
        let shell = (gap(nearest) < 0.0).then(|| {
            let (mut outer, mut inner) = (far, nearest);
            for _ in 0..HALVINGS {
                let middle = 0.5 * (outer + inner);
                if gap(middle) < 0.0 {
                    inner = middle;
                } else {
                    outer = middle;
                }
            }
            outer
        });
        let reach = |point: &Point2<f64>| {
            let r = *point - origin;
            let along = -r.dot(&self.direction);
            let square = self.radius.powi(2) - (r.norm_squared() - along * along);
            (square > 0.0).then(|| along + square.sqrt())
        };
        let rim = self.rim.iter().filter_map(reach).reduce(f64::max);
        let first = match (shell, rim) {
            (Some(shell), Some(rim)) => shell.max(rim),
            (one, other) => one.or(other).unwrap_or(nearest),
        };
        self.start = on_path(first);
    }

    /// The object at the start.
    pub fn body(&self) -> Body {
        Body {
            position: self.start,
            velocity: self.direction * self.speed,
            ..Body::default()
        }
    }

    /// Kinetic energy of the object at the start, in J.
    pub fn energy(&self) -> f64 {
        0.5 * self.mass * self.speed * self.speed
    }

    /// Whether the object reaches through the wall of the orbit, of which only the rim stops it, by
    /// more than a penalty would let it.
    pub fn through_bone(&self, body: &Body) -> bool {
        let centre = body.position + body.shift;
        let far = centre.coords.norm();
        let behind_rim = centre.x * ORBIT_RADIUS_M > self.rim[0].x * far;
        far > 0.0 && behind_rim && far + self.radius > ORBIT_RADIUS_M + 4.0 * AIM * self.radius
    }

    /// Adds the forces on the ring to `forces`, finds the shift of the surface, and sets the
    /// acceleration of `body`.
    pub fn apply(
        &self,
        body: &mut Body,
        ring: &[Point2<f64>],
        forces: &mut [Vector2<f64>],
    ) -> Touch {
        let mut tests = 0;
        let mut stored = 0.0;
        if let Some(spring) = &self.spring {
            tests += self.find_shift(spring, body, ring);
            stored = spring.at(-body.shift.dot(&self.direction)).energy;
        }
        let centre = body.position + body.shift;
        let mut touch = Touch {
            shell: Vector2::zeros(),
            rim: Vector2::zeros(),
            potential: stored,
            penetration: 0.0,
            gap: f64::INFINITY,
            rim_gap: f64::INFINITY,
            tests: tests + ring.len(),
        };
        for (a, b) in segments(ring) {
            let (away, t) = from_segment(ring[a], ring[b], centre);
            let distance = away.norm();
            let depth = self.radius - distance;
            touch.gap = touch.gap.min(-depth);
            // A centre on the segment itself has no direction to be pushed in.
            if depth > 0.0 && distance > 0.0 {
                let push = away * (self.penalty * depth / distance);
                touch.shell += push;
                forces[a] -= push * (1.0 - t);
                forces[b] -= push * t;
                touch.potential += 0.5 * self.penalty * depth * depth;
            }
        }
        for point in self.rim {
            let away = centre - point;
            let distance = away.norm();
            let depth = self.radius - distance;
            touch.rim_gap = touch.rim_gap.min(-depth);
            if depth > 0.0 && distance > 0.0 {
                touch.rim += away * (self.rim_penalty * depth / distance);
                touch.potential += 0.5 * self.rim_penalty * depth * depth;
            }
        }
        touch.penetration = (-touch.gap.min(touch.rim_gap)).max(0.0);
        body.acceleration = (touch.shell + touch.rim) / self.mass;
        touch
    }

    /// Newton's method for the shift of a surface without mass; returns the segments tested.
    ///
    /// A step that does not lower the potential is halved: where a touch is lost, the spring alone
    /// would send the surface to the far side of the shell, which has places of balance of its own.
    fn find_shift(&self, spring: &ObjectSpring, body: &mut Body, ring: &[Point2<f64>]) -> usize {
        let mut tests = 0;
        let mut shift = body.shift.dot(&self.direction);
        let mut lowest = f64::INFINITY;
        let mut step = 0.0;
        for _ in 0..MAX_ROUNDS {
            let centre = body.position + self.direction * shift;
            let squeezed = spring.at(-shift);
            let mut potential = squeezed.energy;
            let mut slope = -squeezed.force;
            let mut bend = squeezed.slope;
            let mut add = |away: Vector2<f64>, penalty: f64| {
                let square = away.norm_squared();
                if square < self.radius * self.radius && square > 0.0 {
                    let distance = square.sqrt();
                    let along = away.dot(&self.direction) / distance;
                    let depth = self.radius - distance;
                    potential += 0.5 * penalty * depth * depth;
                    slope -= along * (penalty * depth);
                    bend += along * along * penalty;
                }
            };
            for (a, b) in segments(ring) {
                add(from_segment(ring[a], ring[b], centre).0, self.penalty);
            }
            for point in self.rim {
                add(centre - point, self.rim_penalty);
            }
            tests += ring.len();
            if potential <= lowest * (1.0 + f64::EPSILON) {
                lowest = potential;
                step = slope / bend;
            } else {
                shift += step;
                step *= 0.5;
            }
            if step.abs() <= SETTLED * self.radius {
                break;
            }
            shift -= step;
        }
        body.shift = self.direction * shift;
        tests
    }

    /// Bound of the square of the angular frequency that contact adds, in 1/s^2, with shell nodes of
    /// `node_mass` kg on segments of `spacing` m.
    ///
    /// Every term `k (n . (c - w_a x_a - w_b x_b))^2` with `w_a + w_b = 1` is a row of a matrix whose part
    /// on the nodes has norm^2 at most 2 k / m (a node ends two segments) and whose part on the disc
    /// at most `k n / m_disc` for n segments in touch. A disc can touch those along half of its
    /// circumference, and all at most. The curvature of the distance, a share of about
    /// penetration/R of this, is left to the share of the limit that steps take.
    pub fn omega_squared(&self, node_mass: f64, spacing: f64, count: usize) -> f64 {
        let touched = (std::f64::consts::PI * self.radius / spacing + 2.0).min(count as f64);
        self.penalty * (touched / self.mass + 2.0 / node_mass) + 2.0 * self.rim_penalty / self.mass
    }
}

/// Where between `low` and `high` a function with one valley is lowest.
fn lowest(f: impl Fn(f64) -> f64, mut low: f64, mut high: f64) -> f64 {
    for _ in 0..2 * HALVINGS {
        let third = (high - low) / 3.0;
        let (a, b) = (low + third, high - third);
        if f(a) <= f(b) {
            high = b;
        } else {
            low = a;
        }
    }
    0.5 * (low + high)
}
