//! The eye in three dimensions and what hits it, through the window.
//!
//! The bound of the step is the least of that of all nodes, of the shell, of how fast corners of
//! cells shrink, of bone and of the object's spring. That of all nodes: a step h is stable while
//! h^2 K + 2 h C < 4 M for all motions. A cell whose own bound is h_e takes of that no more than
//! (h/h_e)^2 of the mass it gives its corners, and points of contact what they press with, so
//!
//!   1/h^2 = 1/(1.7 h_0)^2 + most over nodes of [sum over cells of m_e (1/h_e^2 - 1/h_0^2) + K/4]/m
//!
//! with h_0 the least bound of any cell at rest, and of the first sum only what is above 0. The
//! first term is the mesh without what is crushed: its largest eigenvalue allows 2.5 h_0 at rest
//! and more than 1.7 h_0 in every blow that was looked at. So a few crushed cells, whose nodes have
//! other cells' mass as well, shorten the step by far less than their own bounds would.

use crate::models::axisymmetric::forces::object::{Object, ObjectOutline};
use crate::models::axisymmetric::time::march::{
    Bounds, CellLoop, GONE, Marching, NARROW, Steps, Stop, Take,
};
use crate::models::axisymmetric::time::run::slowest_swing;
use crate::models::axisymmetric::time::until::Until;
use crate::models::axisymmetric::{forces::state::CellSums, recording::account::Account};
use crate::models::axisymmetric::{recording::sensor::LowPass, time::due::FramesDue};
use crate::models::spatial::eye::{ShellQuad, SpatialEye, area};
use crate::models::spatial::forces::contact::{Target, Touch, depth};
use crate::models::spatial::forces::object::{Aim, MovingObject, touches};
use crate::models::spatial::forces::rim::{Bone, Held, Push, Rim};
use crate::models::spatial::forces::state::{Cells, NodeState, vector};
use crate::models::spatial::forces::{plain::PlainCells, rows::CellRows, shell::Shell};
use crate::models::spatial::recording::results::{EngineRun, Extremes};
use crate::models::spatial::recording::tissue::Tissues;
use crate::models::spatial::recording::{section::Section, sensor::Accelerometers, shape::Shapes};
use crate::models::spatial::time::ending::Ending;
use crate::run::kept::{Keep, Spacing};
use crate::run::watch::{Watch, unwatched};
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

/// How much longer a step the mesh as a whole bears than its stiffest cell at rest.
const LONGER: f64 = 1.7;
/// Steps between two looks at whether the object is inside of the eye.
const LOOK_EVERY: usize = 16;

/// A blow: what flies, how it comes, and by which azimuth the eye's mesh is turned from its own up.
#[derive(Debug, Clone, PartialEq)]
pub struct SpatialBlow {
    /// What flies. It touches the globe or bone at the start.
    pub object: Object,
    /// How it comes, in the eye's own axes.
    pub aim: Aim,
    /// Azimuth of the eye that is up in its mesh, rad: of half an eye that of the plane of the
    /// blow.
    pub up: f64,
}

impl SpatialBlow {
    /// How it comes in the axes of the mesh.
    pub(crate) fn in_mesh(&self) -> Aim {
        self.aim.turned(self.up)
    }
}

/// The longest stable step of an eye that nothing has moved yet, in s.
pub fn step_limit(eye: &SpatialEye, blow: &SpatialBlow) -> f64 {
    let (keep, window) = (Keep::default(), Until::Time(1.0));
    let mut motion = Motion::new(eye, CellLoop::Rows, blow, keep, window);
    motion.forces(0.0).limit
}

/// Hits `eye` and follows it for `window` with such `steps`.
///
/// # Errors
/// Motion that leaves the finite numbers, an object that goes through the eye, and what the watch
/// stops.
pub fn run(
    eye: &SpatialEye,
    blow: &SpatialBlow,
    window: impl Into<Until>,
    steps: impl Into<Steps>,
    keep: Keep,
    watch: Watch,
) -> Result<EngineRun, Stop> {
    run_as(CellLoop::Rows, eye, blow, window, steps, keep, watch)
}

/// [`run`] with the cells computed by `form`.
///
/// # Errors
/// See [`run`].
pub fn run_as(
    form: CellLoop,
    eye: &SpatialEye,
    blow: &SpatialBlow,
    window: impl Into<Until>,
    steps: impl Into<Steps>,
    keep: Keep,
    watch: Watch,
) -> Result<EngineRun, Stop> {
    let motion = Motion::new(eye, form, blow, keep, window.into());
    motion.march(steps.into(), watch, None)
}

/// [`run`] that hands on each frame when it is due and keeps nothing.
///
/// # Errors
/// See [`run`]; stopped by `take` too.
pub fn run_through(
    eye: &SpatialEye,
    blow: &SpatialBlow,
    window: impl Into<Until>,
    steps: impl Into<Steps>,
    spacing: Spacing,
    take: Take,
) -> Result<(), Stop> {
    let keep = Keep { traces: false, frames: Some(spacing) };
    let motion = Motion::new(eye, CellLoop::Rows, blow, keep, window.into());
    let run = motion.march(steps.into(), &mut unwatched, Some(take));
    run.map(|_| ())
}

/// What flies at the eye.
pub(crate) struct Flying {
    pub object: Object,
    pub moving: MovingObject,
    /// Where its middle or face is as it touches the globe, along its way from where its line comes
    /// nearest to the middle of the globe, m.
    pub at_touch: f64,
}

impl Flying {
    /// How far it has come along its `way` since it touched the globe, m.
    pub fn intrusion(&self, way: &Vector3<f64>) -> f64 {
        self.moving.at[0].dot(way) - self.at_touch
    }
}

pub(crate) struct Motion<'a> {
    pub eye: &'a SpatialEye,
    pub cells: Box<dyn Cells>,
    /// For the elastic energy and folds.
    pub balance: PlainCells,
    pub state: NodeState,
    pub shell: Shell,
    pub target: Target,
    pub rim: Option<Rim>,
    pub bone: Option<Bone>,
    pub flying: Flying,
    /// The way of the blow, in the axes of the mesh.
    pub way: Vector3<f64>,
    pub up: f64,
    pub shapes: Shapes,
    pub accelerometers: Accelerometers,
    pub tissues: Tissues,
    /// Quads of the shell near to where the blow enters.
    pub near_entry: Vec<bool>,
    pub dented: Vec<bool>,
    pub tension_passed: Vec<LowPass>,
    pub account: Account,
    pub ending: Ending,
    /// Energy of its flight that the object has spent on bone so far, J.
    pub at_bone: f64,
    /// Lost to the eye's viscosities up to the last half step, J, and the last kick, s.
    pub lost: f64,
    pub kicked: f64,
    /// What an eye of cells has no account of.
    pub extremes: Extremes,
    pub frames_due: Option<(Section, FramesDue<Vector3<f64>>)>,
}

/// What all parts say at some instant.
pub(crate) struct Instant {
    pub sums: CellSums,
    /// Stored in the shell, J.
    pub shell: f64,
    pub touch: Touch,
    pub push: Option<Push>,
    pub held: Option<Held>,
    /// Along the blow on the eye, N.
    pub force: f64,
    pub limit: f64,
}

impl<'a> Motion<'a> {
    pub(crate) fn new(
        eye: &'a SpatialEye,
        form: CellLoop,
        blow: &SpatialBlow,
        keep: Keep,
        window: Until,
    ) -> Self {
        let cells: Box<dyn Cells> = match form {
            CellLoop::Plain => Box::new(PlainCells::new(eye)),
            _ => Box::new(CellRows::new(eye, form.level())),
        };
        let aim = blow.in_mesh();
        let (way, passes) = (aim.way(), aim.passes());
        let object = &blow.object;
        let target = Target::new(eye, object.outline.radius());
        let rim = Rim::new(eye);
        let radius = eye.parameters.radius;
        let line = (way, passes);
        let globe = touches(object.outline, line, Vector3::zeros(), radius);
        let bone = rim.as_ref().and_then(|rim| rim.first_touch(object.outline, line));
        let ahead = target.first_touch(object.outline, line);
        let start = [globe, bone, ahead].into_iter().flatten().reduce(f64::min);
        let start = start.unwrap_or(-radius - object.reach());
        let flying = Flying {
            object: *object,
            moving: MovingObject::new(object, way, passes + way * start),
            at_touch: globe.unwrap_or(start),
        };
        let mut state = NodeState::new(eye);
        let mut balance = PlainCells::new(eye);
        let at_rest = balance.forces(&mut state.clone());
        let regular = at_rest.limit.powi(-2);
        state.regular = [regular, regular / (LONGER * LONGER)];
        let globe_volume = at_rest.volume;
        let stiffness: f64 = eye.quads.iter().map(|q| q.modulus * q.thickness).sum();
        let swing = slowest_swing(&eye.parameters, stiffness / eye.quads.len() as f64);
        let (brought, size) = (flying.moving.kinetic(0.0), (globe_volume, eye.cells.len()));
        let entry = touches(ObjectOutline::Sphere(0.0), line, Vector3::zeros(), radius);
        let entry = entry.map_or(-way, |along| (passes + way * along).normalize());
        let near = |quad: &ShellQuad| {
            let at: Vector3<f64> = quad.corners.iter().map(|n| eye.mesh.at[*n]).sum();
            at.normalize().dot(&entry) > libm::cos(DENT_DEG.to_radians())
        };
        Self {
            shapes: Shapes::new(eye, &state.at, way, blow.aim.plane() - blow.up),
            accelerometers: Accelerometers::new(eye, blow.up),
            tissues: Tissues::new(eye, &state.at, blow.up),
            near_entry: eye.quads.iter().map(near).collect(),
            dented: vec![false; eye.quads.len()],
            balance,
            shell: Shell::new(eye, form.level()),
            target,
            bone: Bone::new(eye),
            rim,
            eye,
            cells,
            way,
            up: blow.up,
            account: Account::new((window, keep), swing, brought, size),
            ending: Ending::new(swing),
            flying,
            tension_passed: vec![LowPass::default(); eye.quads.len()],
            at_bone: 0.0,
            lost: 0.0,
            kicked: 0.0,
            extremes: Extremes::default(),
            frames_due: keep
                .frames
                .map(|spacing| (Section::new(eye, blow), FramesDue::new(spacing))),
            state,
        }
    }

    /// Adds what is lost, done and pushed over a step that kicks for `kick` s.
    fn add_up(&mut self, now: &Instant, kick: f64) {
        // Viscous forces follow the velocity at the beginning of a kick, and work along the mean of
        // that and the one at its end, which the next loss tells.
        self.lost += self.eye.copies() * now.sums.loss * 0.75 * kick;
        self.kicked = kick;
        self.extremes.impulse_on_eye += now.touch.force * kick;
        if let Some(push) = &now.push {
            self.extremes.impulse_on_bone -= push.force * kick;
            let moving = &self.flying.moving;
            // As a whole: what squeezes a ball on bone counts in the tests of what breaks it.
            let whole = moving.mass[0] + moving.mass[1];
            let force = moving.force[0] + moving.force[1];
            let after = moving.velocity() + force * (0.5 * kick / whole);
            self.at_bone -= push.force.dot(&after) * kick;
            self.extremes.energy_at_bone = self.extremes.energy_at_bone.max(self.at_bone);
        }
    }

    /// How much of what the largest contact takes counts at the cornea: all where half of that
    /// contact, or of the cornea, was touched at once, less in proportion, nothing on sclera alone.
    fn on_cornea(&self) -> f64 {
        let eye = self.eye;
        let of_cornea = |quad: &ShellQuad| {
            (1.0 - quad.sclera) * area(&quad.corners.map(|node| eye.mesh.at[node]))
        };
        let cornea = eye.copies() * eye.quads.iter().map(of_cornea).sum::<f64>();
        let contact = PI * self.account.extremes.contact_radius.powi(2);
        (2.0 * self.extremes.cornea_touched / cornea.min(contact).max(f64::MIN_POSITIVE)).min(1.0)
    }

    /// Largest depth of a node of the shell in the object, below 0 where it is clear, and the speed
    /// at which that closes, m/s. What the object has passed it never meets again.
    fn nearest(&self) -> (f64, f64) {
        let (object, moving) = (&self.flying.object, &self.flying.moving);
        let velocity = moving.velocity();
        let mut nearest = (f64::NEG_INFINITY, f64::NEG_INFINITY);
        for &(node, _) in self.shapes.shell() {
            let place = vector(&self.state.at, node);
            let (gap, normal) = depth(object, moving, place);
            if gap > nearest.0 && !object.has_passed((place - moving.at[0]).dot(&moving.way)) {
                let speed = vector(&self.state.speed, node);
                nearest = (gap, velocity.dot(&normal) - speed.dot(&normal).min(0.0));
            }
        }
        nearest
    }
}

impl Marching for Motion<'_> {
    type Run = EngineRun;
    const ENDS_EVERY: usize = 16;

    fn forces(&mut self, _time: f64) -> Instant {
        self.state.release();
        let sums = self.cells.forces(&mut self.state);
        self.lost += self.eye.copies() * sums.loss * 0.25 * self.kicked;
        let shell = self.shell.forces(&mut self.state);
        let (object, moving) = (&self.flying.object, &mut self.flying.moving);
        moving.inner();
        let touch = self.target.forces(object, moving, &mut self.state);
        let rate = (self.state.rate_squared() + touch.stiff).sqrt();
        let mut limit = (1.0 / rate).min(LONGER * self.shell.limit).min(sums.shrinking);
        limit = limit.min(moving.limit).min(touch.limit);
        let mut push = None;
        if let Some(rim) = &self.rim {
            let mut pushed = rim.push(object, moving);
            if self.eye.copies() > 1.0 {
                moving.force[0].z = 0.0;
                pushed.force.z = 0.0;
            }
            limit = limit.min(pushed.limit);
            push = Some(pushed);
        }
        let held = self.bone.as_ref().map(|bone| bone.forces(&mut self.state));
        limit = held.map_or(limit, |held| limit.min(held.limit));
        Instant { sums, shell, force: touch.force.dot(&self.way), touch, push, held, limit }
    }

    fn bounds(now: &Instant) -> Bounds {
        Bounds { all: now.limit, cells: now.sums.limit }
    }

    fn settled(&mut self, time: f64) -> bool {
        if !self.account.ends_by_itself() {
            return false;
        }
        self.ending.grow(&self.account.extremes, &self.extremes, time);
        let (depth, closing) = self.nearest();
        let moving = &self.flying.moving;
        let clear = depth < -GONE - moving.swing() && closing < 0.0;
        let speed = moving.velocity().dot(&self.way).max(0.0);
        let flight = 0.5 * (moving.mass[0] + moving.mass[1]) * speed * speed;
        self.ending.is_reached(clear, flight / self.account.energy_before, time)
    }

    /// Whether the middle of the object lies within the shell.
    fn gone_through(&self, steps: usize, last: bool) -> bool {
        if !(last || steps.is_multiple_of(LOOK_EVERY)) {
            return false;
        }
        let flying = &self.flying;
        let centre = match flying.object.outline {
            ObjectOutline::Sphere(_) => flying.moving.at[0],
            ObjectOutline::Cylinder(radius, _) => flying.moving.at[0] - self.way * radius,
        };
        // What flattens the eye with no more than a point is on its way through.
        let radius = self.eye.parameters.radius;
        let narrow = flying.object.outline.radius() < NARROW * radius;
        if narrow && self.account.extremes.flat_at.is_some() {
            return true;
        }
        let middle = self.shapes.middle(&self.state.at);
        if (centre - middle).norm() > 1.5 * radius {
            return false;
        }
        // The shell closes around what lies within it, and around nothing else.
        let seen = |quad: &ShellQuad| {
            let p = quad.corners.map(|node| vector(&self.state.at, node) - centre);
            solid_angle(p[0], p[1], p[2]) + solid_angle(p[0], p[2], p[3])
        };
        let around: f64 = self.eye.quads.iter().map(seen).sum();
        self.eye.copies() * around > TAU
    }

    fn advance(&mut self, now: &Instant, kick: f64, step: f64) {
        self.add_up(now, kick);
        let before = self.target.loss(&self.state);
        self.state.advance(kick, step);
        let lost = 0.5 * kick * (before + self.target.loss(&self.state));
        self.account.energy.lost_in_object += lost + self.flying.moving.advance(kick, step);
    }

    fn finish(mut self, time: f64, steps: usize, settled: bool) -> EngineRun {
        let (mut momentum, mut angular) = (Vector3::zeros(), Vector3::zeros());
        for (node, mass) in self.eye.mass.iter().enumerate() {
            let own = vector(&self.state.speed, node) * *mass;
            momentum += own;
            angular += vector(&self.state.at, node).cross(&own);
        }
        if self.eye.copies() > 1.0 {
            momentum = Vector3::new(2.0 * momentum.x, 2.0 * momentum.y, 0.0);
            angular = Vector3::new(0.0, 0.0, 2.0 * angular.z);
        }
        let moving = &self.flying.moving;
        momentum += moving.momentum();
        for i in 0..2 {
            angular += moving.at[i].cross(&(moving.speed[i] * moving.mass[i]));
        }
        let rebound = -moving.velocity().dot(&self.way);
        self.account.extremes.on_cornea = self.on_cornea();
        self.account.finish(Some(rebound));
        let mut extremes = self.extremes;
        if self.account.extremes.missed() {
            extremes = Extremes {
                impulse_on_bone: extremes.impulse_on_bone,
                energy_at_bone: extremes.energy_at_bone,
                ..Extremes::default()
            };
        }
        EngineRun {
            extremes: Extremes { common: self.account.extremes, ..extremes },
            traces: self.account.keep.traces.then_some(self.account.traces),
            frames: self.account.frames,
            energy: self.account.energy,
            momentum: [momentum, angular],
            steps,
            simulated: time,
            settled,
        }
    }
}

/// The solid angle under which a triangle is seen, positive from within.
fn solid_angle(a: Vector3<f64>, b: Vector3<f64>, c: Vector3<f64>) -> f64 {
    let (la, lb, lc) = (a.norm(), b.norm(), c.norm());
    let over = la * lb * lc + a.dot(&b) * lc + b.dot(&c) * la + c.dot(&a) * lb;
    2.0 * libm::atan2(a.dot(&b.cross(&c)), over)
}

/// How far from where a blow enters what its object touches is its dent, in degrees.
const DENT_DEG: f64 = 50.0;
