//! The object on its way, which contact and bone may bend: surface and core.
//!
//! Its outline, its surface and the law of its spring are those of
//! [`crate::models::axisymmetric::forces::object`]. The spring between surface and core has no
//! length at rest and pulls them together from any side. Left out: that an object turns, so the
//! axis of a cylinder stays where it came from.

use crate::models::axisymmetric::forces::object::{Object, ObjectOutline};
use crate::models::axisymmetric::forces::object_spring::{Core, hysteresis};
use nalgebra::Vector3;

type Vector = Vector3<f64>;
/// The way of a flight, and the point nearest to the middle of the globe that it goes through.
pub(crate) type Line = (Vector, Vector);

/// How a blow comes, in the eye's own axes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Aim {
    /// Between its way and the eye's axis, in rad.
    pub angle: f64,
    /// Azimuth that it comes from, in rad: 0 from above, towards the nose positive.
    pub from: f64,
    /// How far beside the middle of the globe it is aimed, in m.
    pub offset: f64,
    /// Azimuth towards which, in rad.
    pub towards: f64,
}

/// The direction of an azimuth.
pub(crate) fn towards(azimuth: f64) -> Vector {
    Vector::new(0.0, libm::cos(azimuth), libm::sin(azimuth))
}

/// The direction at a front angle in rad, towards a side.
pub(crate) fn direction(front: f64, out: Vector) -> Vector {
    out * libm::sin(front) - Vector::x() * libm::cos(front)
}

impl Aim {
    /// The way of the blow.
    pub fn way(&self) -> Vector3<f64> {
        Vector::x() * libm::cos(self.angle) - towards(self.from) * libm::sin(self.angle)
    }

    /// The point nearest to the middle of the globe that its line goes through, in m.
    pub fn passes(&self) -> Vector3<f64> {
        let way = self.way();
        let aside = towards(self.towards);
        let across = aside - way * way.dot(&aside);
        if across.norm() > 0.0 { across.normalize() * self.offset } else { Vector::zeros() }
    }

    /// How far from the middle its line lies out of the plane of its way and the eye's axis, m.
    pub(crate) fn out_of_plane(&self) -> f64 {
        // Straight on, the plane is that of the offset itself.
        if self.angle == 0.0 {
            return 0.0;
        }
        let normal = Vector::x().cross(&towards(self.from));
        self.passes().dot(&normal)
    }

    /// The azimuth of the plane that the blow is symmetric to, if there is one.
    pub fn plane(&self) -> f64 {
        if self.angle == 0.0 && self.offset != 0.0 { self.towards } else { self.from }
    }

    /// This as seen in axes turned so that azimuth `by` is up.
    pub(crate) fn turned(&self, by: f64) -> Self {
        Self { from: self.from - by, towards: self.towards - by, ..*self }
    }
}

/// The object as it moves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MovingObject {
    /// Place of the surface's and the core's middle, of a cylinder the middle of its face, m.
    pub at: [Vector; 2],
    /// m/s, half a step before.
    pub speed: [Vector; 2],
    /// On each, N.
    pub force: [Vector; 2],
    /// The part of those forces that gives nothing back, N.
    pub lossy: [Vector; 2],
    /// kg.
    pub mass: [f64; 2],
    /// The way it came.
    pub way: Vector,
    core: Core,
    arrival: f64,
    /// Longest stable step of the spring, s.
    pub limit: f64,
}

impl MovingObject {
    /// An object that flies along `way` and is at `at` now.
    pub fn new(object: &Object, way: Vector, at: Vector) -> Self {
        let core = Core::new(object);
        Self {
            at: [at; 2],
            speed: [way * object.speed; 2],
            force: [Vector::zeros(); 2],
            lossy: [Vector::zeros(); 2],
            mass: core.mass,
            way,
            core,
            arrival: object.speed,
            limit: f64::INFINITY,
        }
    }

    /// Sets the forces to those of the spring.
    pub fn inner(&mut self) {
        (self.force, self.lossy) = ([Vector::zeros(); 2], [Vector::zeros(); 2]);
        let Some((law, kept)) = self.core.spring else { return };
        let apart = self.at[1] - self.at[0];
        let squeeze = apart.norm();
        let along = if squeeze > 0.0 { apart / squeeze } else { self.way };
        let squeezed = law.at(squeeze);
        let closing = (self.speed[1] - self.speed[0]).dot(&along);
        let (left, slope) = hysteresis(kept, self.arrival, closing);
        self.force = [along * (squeezed.force * left), along * (-squeezed.force * left)];
        let lossy = along * (squeezed.force * (left - 1.0));
        self.lossy = [lossy, -lossy];
        self.limit = self.core.limit(&squeezed, slope);
    }

    /// How much the spring is squeezed along its way, m.
    pub fn squeezed(&self) -> f64 {
        (self.at[1] - self.at[0]).dot(&self.way)
    }

    /// Middle of what is left of a squeezed ball, or of a cylinder's face, m.
    pub fn middle(&self) -> Vector {
        (self.at[0] + self.at[1]) * 0.5
    }

    /// Energy of the spring, J.
    pub fn stored(&self) -> f64 {
        self.core.stored((self.at[1] - self.at[0]).norm())
    }

    /// Kinetic energy of the velocities, J; with `kick` s of the forces the one at full steps.
    pub fn kinetic(&self, kick: f64) -> f64 {
        (0..2)
            .filter(|&i| self.mass[i] > 0.0)
            .map(|i| {
                let after = self.speed[i] + self.force[i] * (kick / self.mass[i]);
                0.5 * self.mass[i] * self.speed[i].dot(&after)
            })
            .sum()
    }

    /// Energy at a full step, J, whose forces act for `kick` s, with what the first half of that
    /// loses: in itself and, by a power of `on_eye` W, in the surface that moves with the eye.
    pub fn energy(&self, kick: f64, on_eye: f64) -> f64 {
        let lossy = |i: usize| self.lossy[i].dot(&self.speed[i]);
        self.kinetic(kick) + self.stored() + 0.5 * kick * (on_eye - lossy(0) - lossy(1))
    }

    /// How far in front of where it is its surface may yet swing, m.
    pub fn swing(&self) -> f64 {
        self.core.swing((self.speed[1] - self.speed[0]).norm(), self.squeezed())
    }

    /// kg m/s.
    pub fn momentum(&self) -> Vector {
        self.speed[0] * self.mass[0] + self.speed[1] * self.mass[1]
    }

    /// Velocity of the whole, m/s.
    pub fn velocity(&self) -> Vector {
        self.momentum() / (self.mass[0] + self.mass[1])
    }

    /// Kicks and drifts; returns what was lost, J.
    pub fn advance(&mut self, kick: f64, drift: f64) -> f64 {
        let mut lost = 0.0;
        for i in 0..2 {
            if self.mass[i] > 0.0 {
                let before = self.speed[i];
                self.speed[i] += self.force[i] * (kick / self.mass[i]);
                lost -= kick * self.lossy[i].dot(&(before + self.speed[i])) * 0.5;
                self.at[i] += self.speed[i] * drift;
            }
        }
        if self.mass[1] == 0.0 {
            (self.at[1], self.speed[1]) = (self.at[0], self.speed[0]);
        }
        lost
    }
}

/// How far along its line the middle or face of an object comes before it touches a ball `at` some
/// place of radius `inflated`, in m; none if it goes by.
pub(crate) fn touches(
    outline: ObjectOutline,
    (way, passes): Line,
    at: Vector,
    inflated: f64,
) -> Option<f64> {
    let from = at - passes;
    let along = from.dot(&way);
    let across = (from - way * along).norm();
    let (flat, edge, face) = match outline {
        ObjectOutline::Sphere(radius) => (0.0, radius + inflated, 0.0),
        ObjectOutline::Cylinder(radius, edge) => (radius - edge, edge + inflated, edge),
    };
    let beside = (across - flat).max(0.0);
    let left = edge * edge - beside * beside;
    (left > 0.0).then(|| along + face - left.sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::models::axisymmetric::{forces::object::ObjectSurface, forces_tests::sphere};

    #[test]
    fn an_object_touches_where_its_depth_begins() {
        for outline in [ObjectOutline::Sphere(5e-3), ObjectOutline::Cylinder(5e-3, 1e-3)] {
            let object = Object { outline, ..sphere(ObjectSurface::RIGID) };
            for aside in [0.0, 2e-3, 4.5e-3] {
                let at = Vector::new(-12e-3, aside, 0.0);
                let line = (Vector::x(), Vector::zeros());
                let touch = touches(outline, line, at, 0.0).unwrap();
                let (gap, ..) = object.gap(at.x - touch, aside);
                assert!(gap.abs() < 1e-12, "{outline:?} {aside} {gap}");
            }
            assert!(touches(outline, (Vector::x(), Vector::zeros()), Vector::y(), 0.0).is_none());
        }
    }

    #[test]
    fn what_comes_in_at_the_back_of_a_ball_is_not_deep_at_once() {
        let object = sphere(ObjectSurface::elastic(2e6, 5e-3));
        let ObjectOutline::Sphere(radius) = object.outline else { unreachable!() };
        for behind in [1e-6, 1e-4, 5e-4] {
            for r in [0.0, 1e-5, 1e-4, 1e-3] {
                let (gap, nx, nr) = object.gap(behind - radius, r);
                assert!(gap <= 4.0 * behind, "{behind} {r}: {gap}");
                // The way in which it decreases is its slope.
                let h = 1e-10;
                let along = (object.gap(behind + h - radius, r).0 - gap) / h;
                let aside = (object.gap(behind - radius, r + h).0 - gap) / h;
                let steep = 1.0 + nx.abs() + nr.abs();
                assert!((along + nx).abs() < 1e-3 * steep, "{behind} {r}");
                assert!((aside + nr).abs() < 1e-3 * steep, "{behind} {r}");
            }
        }
    }

    #[test]
    fn an_aim_says_where_it_comes_from_and_by_what_it_passes() {
        let aim = Aim { angle: 0.5, from: 1.0, offset: 2e-3, towards: 2.0 };
        let way = aim.way();
        assert!((way.norm() - 1.0).abs() < 1e-12 && way.dot(&towards(1.0)) < 0.0);
        assert!(aim.passes().dot(&way).abs() < 1e-12);
        assert!((aim.passes().norm() - 2e-3).abs() < 1e-12);
        assert!(aim.passes().dot(&towards(2.0)) > 0.0);
    }
}
