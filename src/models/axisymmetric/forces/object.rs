//! What hits the eye: its outline, how its surface gives way, and its mass on a spring.
//!
//! The surface is an elastic foundation (Winkler; Johnson 1985, section 4.3): the traction depends
//! on the gap at that point alone. A plain foundation would let light soft things fly through the
//! eye, so it stiffens as its depth h is used up: k g/(1 - g/h), with h = 0.7 R. A hollow ball
//! holds its gas pressure up against the eye, foam and cork their stress of collapse, a liquid
//! nothing; to each of them comes half the density times the square of the speed, since what is
//! flattened has to be stopped. The traction then saturates at that cap p,
//!
//!   k g/(1 + k g/p) + p w^2/(1 - w),   w = (g/h - 0.6)/0.4 where that is positive,
//!
//! and only the last part, once most of h = 0.9 R is used up, takes it above the cap. Beyond 0.98
//! h = e both end in a hard core: their tangent and K (g - e)^2/(h - e), with the K of hard
//! things, so that nothing is pressed through itself. Force and slope have no jump. Left out: that
//! the gas of a ball is pressed together as a whole, and that inertia falls as it slows down.
//!
//! The whole ball is a core on a spring behind a surface of a twentieth of its mass; the spring
//! stiffens where the ball comes to be flat.
//!
//! Both give back the square of the coefficient of restitution e of the energy they took, as
//! against a rigid wall: while they open, the force is e^2 of what it was at the same place while
//! they closed, and near the turning point it goes smoothly from one to the other. A ball that
//! bursts or flows (e = 0) gives back nothing.

use crate::models::axisymmetric::forces::object_spring::{Core, hysteresis};
use crate::run::drawing::DrawnObject;
use nalgebra::Vector2;

/// Stiffness of contact between hard things, in Pa/m.
pub const HARD: f64 = 2e12;
/// Depth of the foundation of a solid ball and of one with a cap, over its radius. Less than 1, so
/// that the middle of a ball stays in front of the eye.
const SOLID_DEPTH: f64 = 0.7;
const CAPPED_DEPTH: f64 = 0.9;
/// Share of its depth up to which a surface with a cap presses no harder than that.
const PLATEAU: f64 = 0.6;
/// Share of a foundation's depth beyond which lies a hard core.
const CORE_BEYOND: f64 = 0.98;
/// Contact shortens the step when the surface is this near, in m, or will be within this time, in
/// s: a fast light object would else be deep in at the first step of contact.
const NEAR: f64 = 2e-5;
const SOON: f64 = 1e-6;
/// How far ahead the step looks where a depth is nearly used up, in s, and which share that is.
const AHEAD: f64 = 3e-6;
const NEARLY: f64 = 0.9;
/// A liquid has come to its pressure where this share of its radius is used up.
const SPLASH: f64 = 0.05;

/// Outline, with the axis of symmetry along its way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ObjectOutline {
    /// A ball of this radius, in m.
    Sphere(f64),
    /// A flat cylinder of this radius with an edge rounded by this radius, in m.
    Cylinder(f64, f64),
}

impl ObjectOutline {
    /// Largest distance from the axis, m.
    pub fn radius(&self) -> f64 {
        let (Self::Sphere(radius) | Self::Cylinder(radius, _)) = *self;
        radius
    }

    /// What a picture shows of it on its way.
    pub(crate) fn drawn(&self, direction: Vector2<f64>) -> DrawnObject {
        DrawnObject {
            radius: self.radius(),
            edge: match *self {
                Self::Sphere(_) => None,
                Self::Cylinder(_, edge) => Some(edge),
            },
            direction,
        }
    }
}

/// How a surface gives way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ObjectSurface {
    /// At small gaps, in Pa/m.
    pub stiffness: f64,
    /// Depth of the foundation, in m; `None` is as deep as it needs to be, without a cap.
    pub depth: Option<f64>,
    /// Traction at which a hollow, crushable or bursting object gives way, in Pa.
    pub cap: Option<f64>,
    /// Coefficient of restitution of the surface itself, 0 to 1.
    pub restitution: f64,
}

/// Traction of a foundation at some gap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PressedSurface {
    /// J/m2.
    pub energy: f64,
    /// Pa.
    pub traction: f64,
    /// Pa/m.
    pub slope: f64,
}

impl ObjectSurface {
    /// A surface that hardly gives way.
    pub const RIGID: Self = Self { stiffness: HARD, depth: None, cap: None, restitution: 1.0 };

    /// A solid body of this modulus (Pa) and radius (m): compliances in series, 1/k = 1/hard + R/E.
    pub fn elastic(modulus: f64, radius: f64) -> Self {
        Self::foundation(modulus / radius, radius)
    }

    /// A foundation of this stiffness (Pa/m) on a body of this radius (m).
    pub fn foundation(stiffness: f64, radius: f64) -> Self {
        Self {
            stiffness: 1.0 / (1.0 / HARD + 1.0 / stiffness),
            depth: Some(SOLID_DEPTH * radius),
            cap: None,
            restitution: 1.0,
        }
    }

    /// A wall around gas or a foam that crushes: a foundation of this stiffness (Pa/m) on a body of
    /// this radius (m) that gives way at `cap` Pa.
    pub fn capped(stiffness: f64, cap: f64, radius: f64) -> Self {
        Self {
            cap: Some(cap),
            depth: Some(CAPPED_DEPTH * radius),
            ..Self::foundation(stiffness, radius)
        }
    }

    /// Liquid that presses on a body of this radius (m) as a jet does, with `pressure` Pa, for as
    /// long as there is some of it left.
    pub fn splashing(pressure: f64, radius: f64) -> Self {
        Self::capped(pressure / (SPLASH * radius), pressure, radius)
    }

    /// This surface, giving back the square of `restitution` of its energy.
    #[must_use]
    pub fn losing(self, restitution: f64) -> Self {
        Self { restitution, ..self }
    }

    /// How much of the traction is left at a speed of closing, and its change with that, s/m.
    pub(crate) fn hysteresis(&self, speed: f64, closing: f64) -> (f64, f64) {
        hysteresis(self.restitution * self.restitution, speed, closing)
    }

    /// The slope of the traction at a gap, or shortly after if it closes at `closing` m/s on a
    /// depth that is nearly used up: for the step.
    #[inline]
    pub(crate) fn steepest(&self, gap: f64, slope: f64, closing: f64) -> f64 {
        let soon = gap + AHEAD * closing.max(0.0);
        match self.depth {
            Some(depth) if soon > NEARLY * depth => slope.max(self.at(soon).slope),
            _ => slope,
        }
    }

    /// The share of what gives way that is used up at a gap: from 1 on it is as hard as its core.
    pub(crate) fn used_up(&self, gap: f64) -> f64 {
        self.depth.map_or(0.0, |depth| gap / (CORE_BEYOND * depth))
    }

    pub(crate) fn at(&self, gap: f64) -> PressedSurface {
        let Some(depth) = self.depth else { return self.within(gap) };
        let end = CORE_BEYOND * depth;
        if gap <= end {
            return self.within(gap);
        }
        let (at, beyond) = (self.within(end), gap - end);
        let core = HARD / (depth - end) * beyond;
        PressedSurface {
            energy: at.energy + beyond * (at.traction + beyond * (0.5 * at.slope + core / 3.0)),
            traction: at.traction + beyond * (at.slope + core),
            slope: at.slope + 2.0 * core,
        }
    }

    fn within(&self, gap: f64) -> PressedSurface {
        let k = self.stiffness;
        let Some(depth) = self.depth else {
            return PressedSurface { energy: 0.5 * k * gap * gap, traction: k * gap, slope: k };
        };
        let Some(cap) = self.cap else {
            let left = 1.0 - gap / depth;
            return PressedSurface {
                energy: k * depth * depth * (left - 1.0 - libm::log(left)),
                traction: k * gap / left,
                slope: k / (left * left),
            };
        };
        let over = 1.0 + k * gap / cap;
        let mut pressed = PressedSurface {
            energy: cap * (gap - cap / k * libm::log(over)),
            traction: k * gap / over,
            slope: k / (over * over),
        };
        let rest = (1.0 - PLATEAU) * depth;
        let w = (gap - PLATEAU * depth) / rest;
        if w > 0.0 {
            let left = 1.0 - w;
            pressed.energy -= cap * rest * (0.5 * w * w + w + libm::log(left));
            pressed.traction += cap * w * w / left;
            pressed.slope += cap * w * (2.0 - w) / (rest * left * left);
        }
        pressed
    }
}

/// The spring of a whole ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BallSpring {
    /// N/m.
    pub stiffness: f64,
    /// Coefficient of restitution against a rigid wall, 0 to 1.
    pub restitution: f64,
}

/// How fast depth grows from the back of a ball that gives way: so fast that straight on, where
/// nothing closes behind it, hardly a place knows.
const BACK: f64 = 3.0;

/// What hits the eye.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Object {
    /// Outline.
    pub outline: ObjectOutline,
    /// kg.
    pub mass: f64,
    /// Towards the eye, in m/s.
    pub speed: f64,
    /// How its surface gives way.
    pub surface: ObjectSurface,
    /// How the whole gives way, if it does.
    pub spring: Option<BallSpring>,
}

impl Object {
    /// Distance from the centre, or from a cylinder's face, to the frontmost point, in m.
    pub fn reach(&self) -> f64 {
        match self.outline {
            ObjectOutline::Sphere(radius) => radius,
            ObjectOutline::Cylinder(..) => 0.0,
        }
    }

    /// How fast the way in which a depth of `gap` decreases turns from place to place, over the
    /// square of its length, 1/m; that of a rigid ball is next to nothing beside its stiffness.
    pub(crate) fn bend(&self, gap: f64) -> f64 {
        match self.outline {
            ObjectOutline::Sphere(radius) if self.surface.depth.is_some() => {
                2.0 / (2.0 * radius - gap)
            }
            _ => 0.0,
        }
    }

    /// Whether what lies so far along its way from its middle, m, is behind all of it: only a ball
    /// that gives way, whose depth is taken from its back, can go past something.
    pub(crate) fn has_passed(&self, along: f64) -> bool {
        match self.outline {
            ObjectOutline::Sphere(radius) => self.surface.depth.is_some() && along <= -radius,
            ObjectOutline::Cylinder(..) => false,
        }
    }

    /// How near a surface must be to shorten the step, in m.
    pub(crate) fn near(&self) -> f64 {
        NEAR + SOON * self.speed
    }

    /// Depth of the point (`x`, `r`) below the surface of an object whose centre or face is at 0,
    /// and the way that the depth decreases there.
    ///
    /// Below the surface of a ball that gives way lie balls that touch it at its back, and planes
    /// across its way where those are deeper: what is left of it gets smaller but stays blunt. (Depth along the radius would leave a small hard core,
    /// which goes through the eye.) On the axis both are the same, and on the surface the normals
    /// are.
    #[inline]
    pub(crate) fn gap(&self, x: f64, r: f64) -> (f64, f64, f64) {
        match self.outline {
            ObjectOutline::Sphere(radius) if self.surface.depth.is_some() => {
                let behind = x + radius;
                if behind <= 0.0 {
                    return (-radius, 1.0, 0.0);
                }
                let slope = r / behind;
                let gap = 2.0 * radius - behind - r * slope;
                // What closes around it comes in at its back from nothing on.
                if gap > BACK * behind {
                    return (BACK * behind, -BACK, 0.0);
                }
                (gap, 1.0 - slope * slope, 2.0 * slope)
            }
            ObjectOutline::Sphere(radius) => {
                let distance = (x * x + r * r).sqrt();
                (radius - distance, x / distance, r / distance)
            }
            ObjectOutline::Cylinder(radius, edge) => {
                let (x, r) = (x + edge, r - (radius - edge));
                if r <= 0.0 {
                    (edge - x, 1.0, 0.0)
                } else if x <= 0.0 {
                    (edge - r, 0.0, 1.0)
                } else {
                    let distance = (x * x + r * r).sqrt();
                    (edge - distance, x / distance, r / distance)
                }
            }
        }
    }
}

/// The moving object: surface and core.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MovingObject {
    /// Place of the surface's and the core's centre, m.
    pub x: [f64; 2],
    /// m/s, half a step before.
    pub v: [f64; 2],
    /// On each, N.
    pub force: [f64; 2],
    /// The part of those forces that gives nothing back, N.
    pub lossy: [f64; 2],
    /// kg.
    pub mass: [f64; 2],
    core: Core,
    /// Speed of arrival, m/s.
    speed: f64,
    /// Longest stable step of the spring, s.
    pub limit: f64,
}

impl MovingObject {
    /// An object whose frontmost point is at `front`.
    pub fn new(object: &Object, front: f64) -> Self {
        let core = Core::new(object);
        Self {
            x: [front - object.reach(); 2],
            v: [object.speed; 2],
            force: [0.0; 2],
            lossy: [0.0; 2],
            mass: core.mass,
            core,
            speed: object.speed,
            limit: f64::INFINITY,
        }
    }

    /// Sets the forces to those of the spring.
    pub fn inner(&mut self) {
        (self.force, self.lossy) = ([0.0; 2], [0.0; 2]);
        let Some((law, kept)) = self.core.spring else { return };
        let squeezed = law.at(self.squeezed());
        let closing = self.v[1] - self.v[0];
        // Drawn out it loses as when squeezed, on its way back.
        let (left, slope) = hysteresis(kept, self.speed, closing * squeezed.force.signum());
        let force = squeezed.force * left;
        self.force = [force, -force];
        let lossy = force - squeezed.force;
        self.lossy = [lossy, -lossy];
        self.limit = self.core.limit(&squeezed, slope);
    }

    /// How much the spring is squeezed, m.
    pub fn squeezed(&self) -> f64 {
        self.x[1] - self.x[0]
    }

    /// Centre of what is left of a squeezed ball, or the middle of a cylinder's face, m.
    pub fn middle(&self) -> f64 {
        self.x[0] + 0.5 * self.squeezed()
    }

    /// Energy of the spring, J.
    pub fn stored(&self) -> f64 {
        self.core.stored(self.squeezed())
    }

    /// Kinetic energy of the velocities, J; with `kick` s of the forces the one at full steps.
    pub fn kinetic(&self, kick: f64) -> f64 {
        (0..2)
            .filter(|&i| self.mass[i] > 0.0)
            .map(|i| {
                let after = self.v[i] + kick * self.force[i] / self.mass[i];
                0.5 * self.mass[i] * self.v[i] * after
            })
            .sum()
    }

    /// Energy at a full step, J, whose forces act for `kick` s, with what the first half of that
    /// loses: in itself and, by a power of `on_eye` W, in the surface that moves with the eye.
    pub fn energy(&self, kick: f64, on_eye: f64) -> f64 {
        let lossy = |i: usize| self.lossy[i] * self.v[i];
        self.kinetic(kick) + self.stored() + 0.5 * kick * (on_eye - lossy(0) - lossy(1))
    }

    /// How far in front of where it is its surface may yet swing, m.
    pub fn swing(&self) -> f64 {
        self.core.swing(self.v[1] - self.v[0], self.squeezed())
    }

    pub fn momentum(&self) -> f64 {
        self.mass[0] * self.v[0] + self.mass[1] * self.v[1]
    }

    /// Velocity of the whole, m/s.
    pub fn velocity(&self) -> f64 {
        self.momentum() / (self.mass[0] + self.mass[1])
    }

    /// Kicks and drifts; returns what was lost, J.
    pub fn advance(&mut self, kick: f64, drift: f64) -> f64 {
        let mut lost = 0.0;
        for i in 0..2 {
            if self.mass[i] > 0.0 {
                let before = self.v[i];
                self.v[i] += kick * self.force[i] / self.mass[i];
                lost -= kick * self.lossy[i] * 0.5 * (before + self.v[i]);
                self.x[i] += drift * self.v[i];
            }
        }
        if self.mass[1] == 0.0 {
            (self.x[1], self.v[1]) = (self.x[0], self.v[0]);
        }
        lost
    }
}
