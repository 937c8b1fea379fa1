//! The observer that turns a run into a recording.

use crate::models::paper::forces::{state::State, system::System};
use crate::models::paper::recording::lengths::{Growth, LengthKind, LinePoint};
use crate::models::paper::recording::settling::{Bend, RiseBounds, ShellBound};
use crate::models::paper::recording::{PaperExtremes, Recording};
use crate::models::paper::recording::{dense::NodeForce, frames::FrameTaker};
use crate::models::paper::time::march::Observer;
use crate::models::paper::{
    eye::Eye, eye::hats::Hat, forces::kernel::Survey, forces::load::ArcLoad,
};
use crate::models::pulse::Piece;
use crate::run::kept::{Keep, Peak, Traces};
use crate::run::{fold::FoldWatch, places::Region, plan::Cost};
use nalgebra::{Point2, Vector2};
use std::f64::consts::TAU;

/// Points tried for the peak of a node force in each of the mesh's shortest periods.
const POINTS_PER_PERIOD: f64 = 9.0;
/// The fewest points within a step.
const FEWEST_POINTS: usize = 4;
/// The best of these points is refined if it comes this close to the largest force so far: between
/// two of them no oscillation of the mesh rises by more.
const CLOSE: f64 = 0.9;
/// A step is searched if its guessed force comes this close to the largest so far.
const NEAR: f64 = 0.75;
/// A step whose ends are both below this share of the largest force is not looked into.
const FAR: f64 = 0.3;
/// No quad of springs strained by less than this can turn inside out.
const UNFOLDED_STRAIN: f64 = 0.1;
/// Steps that traces keep at most; longer runs keep every second, third, ... step.
const MAX_ROWS: usize = 100_000;

/// Energies below this are rounding: lengths of millimetres are exact to 1e-19 m, springs of the
/// stiffest tissue hold no more at that stretch.
const ROUNDING_J: f64 = 1e-13;

/// A quad of the mesh, to find out which of them have folded.
#[derive(Debug, Clone, Copy)]
struct Quad {
    corners: [usize; 4],
    /// Twice its area at rest, in m2.
    area: f64,
    /// Where it lies at rest.
    middle: Point2<f64>,
    part: Region,
}

impl Quad {
    fn new(eye: &Eye, corners: [usize; 4]) -> Self {
        let at = |node: usize| eye.nodes[node].position;
        let sum = corners.iter().fold(Vector2::zeros(), |sum, &n| sum + at(n).coords);
        let regions = corners.map(|node| eye.nodes[node].region);
        Self {
            corners,
            area: crossed(corners.map(at)),
            middle: Point2::from(sum / 4.0),
            part: if regions.contains(&Region::Lens) {
                Region::Lens
            } else if regions.into_iter().all(Region::in_globe) {
                Region::Interior
            } else {
                Region::Fat
            },
        }
    }

    /// Its signed area over that at rest, with its corners `at` some places.
    fn ratio(&self, at: impl Fn(usize) -> Point2<f64>) -> f64 {
        crossed(self.corners.map(at)) / self.area
    }
}

/// Twice the signed area of a quad: the cross product of its diagonals.
fn crossed([a, b, c, d]: [Point2<f64>; 4]) -> f64 {
    (c - a).perp(&(d - b))
}

/// What rounding does to a position some 10 mm away from the middle, in m.
const ROUNDING_M: f64 = 2e-18;
/// A blow that gives less than so many times the energy of springs strained by that is rounding
/// itself.
const LOST: f64 = 1e4;

/// Watches a run and records it.
#[derive(Debug)]
pub struct Recorder {
    before: State,
    monitors: [NodeForce; 4],
    forces: [Peak; 4],
    last_forces: [f64; 4],
    /// Whether the kernel's length of the shell is the one to follow: every node is a corner of it.
    surveyed_shell: bool,
    shell: Growth,
    meridian: Growth,
    apex: Growth,
    bounds: RiseBounds,
    bend: Bend,
    energy: f64,
    loaded: bool,
    window: f64,
    elastic: Peak,
    strain: Peak,
    least_quad: f64,
    quads: Vec<Quad>,
    fold: FoldWatch,
    residual: f64,
    most_energy: f64,
    /// What springs strained by rounding alone hold, in J.
    rounding: f64,
    rows: Option<Traces>,
    every_row: usize,
    steps: usize,
    frames: Option<FrameTaker>,
}

impl Recorder {
    /// A recorder for `eye` under `load`, compiled as `system`, about to take `steps` steps over
    /// `window` seconds.
    pub fn new(
        eye: &Eye,
        load: &ArcLoad,
        system: &System,
        (window, steps): (f64, usize),
        keep: Keep,
    ) -> Self {
        let rest = State::at_rest(system);
        let marks = &eye.landmarks;
        let share = |hat: &Hat| {
            let of = |node| load.shares.iter().find(|(n, _)| *n == node);
            let sum = hat.iter().filter_map(|&(n, w)| Some(w * of(n)?.1)).sum::<f64>();
            load.direction * sum
        };
        let monitor = |m: usize| {
            let hat = &marks.monitor_hats[m];
            NodeForce::new(eye, marks.monitors[m], hat, share(hat))
        };
        let growth = |kind, points| Growth::new(kind, points, system, &rest);
        let displaced = |middles: [usize; 2], hats: &[Hat; 2]| {
            let points = middles.into_iter().zip(hats);
            points.map(|(n, hat)| LinePoint::displaced(eye, n, hat.clone())).collect()
        };
        let ring = marks.shell_hats.iter().cloned().map(LinePoint::mean).collect();
        Self {
            monitors: std::array::from_fn(monitor),
            forces: [Peak::floor(0.0); 4],
            last_forces: [0.0; 4],
            bounds: RiseBounds::new(eye),
            bend: Bend::UNKNOWN,
            energy: 0.0,
            loaded: true,
            window,
            surveyed_shell: marks.shell_hats.len() == marks.shell.len(),
            shell: growth(LengthKind::Ring, ring),
            meridian: growth(LengthKind::Span, displaced(marks.meridian, &marks.meridian_hats)),
            apex: growth(LengthKind::MeanX, displaced(marks.apex, &marks.apex_hats)),
            elastic: Peak::floor(0.0),
            strain: Peak::floor(0.0),
            least_quad: 1.0,
            quads: eye.quads.iter().map(|corners| Quad::new(eye, *corners)).collect(),
            fold: FoldWatch::new(eye.quads.len()),
            residual: 0.0,
            most_energy: 0.0,
            rounding: eye.springs.iter().map(|s| s.stiffness * ROUNDING_M * ROUNDING_M).sum(),
            rows: keep.traces.then(Traces::default),
            every_row: steps.div_ceil(MAX_ROWS).max(1),
            steps: 0,
            frames: keep.frames.map(|spacing| FrameTaker::new(spacing, eye, system)),
            before: rest,
        }
    }

    fn record(&mut self, system: &System, state: &State, piece: Piece, survey: &Survey) {
        let forces: [f64; 4] = std::array::from_fn(|m| self.monitors[m].at(system, state));
        self.last_forces = forces;
        for (peak, force) in self.forces.iter_mut().zip(forces) {
            peak.offer(force, state.time);
        }
        self.elastic.offer(survey.elastic, state.time);
        self.strain.offer(survey.strain, state.time);
        self.least_quad = self.least_quad.min(survey.quad_ratio);
        let quads = &self.quads;
        self.fold.record(
            state.time,
            survey.quad_ratio,
            |quad| quads[quad].ratio(|node| state.position(system.place(node))),
            |quad| (quads[quad].middle, quads[quad].part),
        );
        let stored = survey.kinetic + survey.elastic;
        self.energy = stored;
        self.loaded = piece != Piece::Nothing;
        let residual = state.work - stored - state.dissipated;
        self.residual = self.residual.max(residual.abs());
        self.most_energy = self.most_energy.max(stored);
        if self.steps.is_multiple_of(self.every_row)
            && let Some(rows) = &mut self.rows
        {
            rows.time.push(state.time);
            rows.load.push(system.load().pulse.force(piece, state.time));
            for (trace, force) in rows.force.iter_mut().zip(forces) {
                trace.push(force);
            }
            rows.apex.push(self.apex.last());
            rows.shell_growth.push(self.shell.last() / self.shell.rest());
            rows.meridian_growth.push(self.meridian.last() / self.meridian.rest());
            rows.kinetic.push(survey.kinetic);
            rows.elastic.push(survey.elastic);
            rows.dissipated.push(state.dissipated);
            rows.work.push(state.work);
        }
    }

    /// Whether the energy that is left can raise no force, nor the growth of the shell in the
    /// `left` seconds to come.
    fn forces_are_final(&self, left: f64) -> bool {
        let most = match self.bounds.shell {
            ShellBound::Stretch(bound) => bound.reach(self.energy),
            ShellBound::Change(all, one) => {
                self.shell.last() + self.bend.growth(all, one, self.energy, left)
            }
        };
        self.forces
            .iter()
            .zip(self.bounds.force)
            .all(|(peak, bound)| bound.reach(self.energy) <= peak.value)
            && most <= self.shell.peak.value
    }

    /// Whether nothing that is recorded can change before the end of the window. Traces and frames
    /// change to the very end.
    pub fn settled(&self) -> bool {
        if self.loaded || self.rows.is_some() || self.frames.is_some() {
            return false;
        }
        let left = self.window - self.before.time;
        let strain = self.bounds.strain.reach(self.energy);
        strain <= self.strain.value.min(UNFOLDED_STRAIN)
            && self.forces_are_final(left)
            // No more can be stored than is left.
            && self.energy <= self.elastic.value
            && self.apex.last() + self.bounds.apex.travel(self.energy, left) <= self.apex.peak.value
            && self.meridian.last() + self.bounds.meridian.travel(self.energy, left)
                <= self.meridian.peak.value
    }

    /// The recording, once the run has ended at `state` and cost so much.
    pub fn finish(self, state: &State, cost: Cost) -> Recording {
        let relative = |growth: &Growth| Peak {
            value: growth.peak.value / growth.rest(),
            time: growth.peak.time,
        };
        let late = [&self.shell, &self.meridian, &self.apex].iter().any(|g| g.still_rising());
        let scale = state.work.abs().max(self.most_energy);
        let open = self.loaded || !self.forces_are_final(0.0);
        let mut extremes = PaperExtremes {
            force: self.forces,
            apex: self.apex.peak,
            shell_growth: relative(&self.shell),
            meridian_growth: relative(&self.meridian),
            work: state.work,
            elastic: self.elastic,
            strain: self.strain,
            least_quad_ratio: self.least_quad,
            fold: self.fold.fold(),
            energy_residual: if scale > ROUNDING_J { self.residual / scale } else { 0.0 },
            lost_in_rounding: state.work != 0.0 && self.most_energy <= LOST * self.rounding,
            could_rise: open && scale > ROUNDING_J,
            still_rising: late && scale > ROUNDING_J,
        };
        let untouched = state.work == 0.0 && self.most_energy <= ROUNDING_J;
        if untouched || extremes.lost_in_rounding {
            extremes.forget_rounding();
        }
        Recording {
            extremes,
            traces: self.rows,
            frames: self.frames.map_or_else(Vec::new, |f| f.frames),
            cost,
            simulated: state.time,
        }
    }
}

impl Observer for Recorder {
    fn begin(&mut self, system: &System, state: &State, piece: Piece, survey: &Survey) {
        self.record(system, state, piece, survey);
        self.before.copy_motion(system, state);
        if let Some(frames) = &mut self.frames {
            frames.begin(system, state);
        }
    }

    fn step(&mut self, system: &System, state: &State, piece: Piece, survey: &Survey) {
        self.steps += 1;
        let length = self.surveyed_shell.then_some(survey.shell_length);
        self.shell.step(system, &self.before, state, length);
        self.meridian.step(system, &self.before, state, None);
        self.apex.step(system, &self.before, state, None);
        let before = self.last_forces;
        self.record(system, state, piece, survey);
        let periods = system.omega_bound() * (state.time - self.before.time) / TAU;
        let points = ((POINTS_PER_PERIOD * periods).ceil() as usize).max(FEWEST_POINTS);
        for ((monitor, peak), (earlier, now)) in self
            .monitors
            .iter_mut()
            .zip(&mut self.forces)
            .zip(before.into_iter().zip(self.last_forces))
        {
            let ends = f64::max(earlier, now);
            if ends < FAR * peak.value {
                continue;
            }
            let guess = monitor.guess(system, &self.before, state).max(ends);
            if guess > NEAR * peak.value && guess > 0.0 {
                let step = (&self.before, state);
                let found = monitor.largest(system, step, piece, (points, CLOSE * peak.value));
                peak.offer(found.value, found.time);
            }
        }
        if !self.loaded && !self.surveyed_shell {
            self.bend = self.shell.bend(system, state);
        }
        if let Some(frames) = &mut self.frames {
            frames.step(system, (&self.before, state), piece);
        }
        self.before.copy_motion(system, state);
    }
}
