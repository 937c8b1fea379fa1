//! The observer that turns a run into a recording.

use crate::models::paper::eye::{Eye, crossed, hats::Hat, mesh::Node};
use crate::models::paper::forces::{load::ArcLoad, state::State, system::System};
use crate::models::paper::recording::dense::{Interval, NodeForce};
use crate::models::paper::recording::lengths::{Growth, LengthKind, LinePoint};
use crate::models::paper::recording::settling::{Bend, Bound, RiseBounds, ShellBound};
use crate::models::paper::recording::{PaperExtremes, Recording, frames::FrameTaker};
use crate::models::paper::time::march::Moment;
use crate::models::pulse::Piece;
use crate::run::kept::{Frame, Keep, Traces};
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
        let nodes: [&Node; 4] = corners.map(|node| &eye.nodes[node]);
        let sum: Vector2<f64> = nodes.iter().map(|node| node.position.coords).sum();
        Self {
            corners,
            area: crossed(nodes.map(|node| node.position)),
            middle: Point2::from(sum / 4.0),
            part: if nodes.iter().any(|node| node.region == Region::Lens) {
                Region::Lens
            } else if nodes.iter().all(|node| node.region.in_globe()) {
                Region::Interior
            } else {
                Region::Fat
            },
        }
    }
}

/// What rounding does to a position some 10 mm away from the middle, in m.
const ROUNDING_M: f64 = 2e-18;
/// A blow is rounding itself below so many times the energy of springs strained by that.
const LOST: f64 = 1e4;

/// Watches a run and records it.
#[derive(Debug)]
pub(crate) struct Recorder {
    before: State,
    monitors: [NodeForce; 4],
    last_forces: [f64; 4],
    shell: Growth,
    meridian: Growth,
    apex: Growth,
    extremes: PaperExtremes,
    bounds: RiseBounds,
    bend: Bend,
    energy: f64,
    loaded: bool,
    window: f64,
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
    /// A recorder for an eye about to take `steps` steps over `window` seconds.
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
        let mean = |nodes| LinePoint { base: Vector2::zeros(), nodes };
        Self {
            monitors: std::array::from_fn(monitor),
            last_forces: [0.0; 4],
            shell: growth(LengthKind::Ring, marks.shell_hats.iter().cloned().map(mean).collect()),
            meridian: growth(LengthKind::Span, displaced(marks.meridian, &marks.meridian_hats)),
            apex: growth(LengthKind::MeanX, displaced(marks.apex, &marks.apex_hats)),
            extremes: PaperExtremes { least_quad_ratio: 1.0, ..PaperExtremes::default() },
            bounds: RiseBounds::new(eye),
            bend: Bend::UNKNOWN,
            energy: 0.0,
            loaded: true,
            window,
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

    /// Takes in what there is to see.
    pub fn see(&mut self, system: &System, now: &Moment) {
        if now.starts {
            self.record(system, now);
            if let Some(frames) = &mut self.frames {
                frames.begin(system, now.state);
            }
        } else {
            self.step(system, now);
        }
        self.before.copy_motion(system, now.state);
    }

    /// The frames that were taken since they were last asked for.
    pub fn taken(&mut self) -> impl Iterator<Item = Frame> {
        self.frames.iter_mut().flat_map(|taker| taker.frames.drain(..))
    }

    fn step(&mut self, system: &System, now: &Moment) {
        // Where every node is a corner of the shell, its length is the kernel's.
        let surveyed = matches!(self.bounds.shell, ShellBound::Stretch(_));
        let step = Interval { system, before: &self.before, after: now.state };
        self.steps += 1;
        self.shell.step(step, surveyed.then_some(now.survey.shell_length));
        self.meridian.step(step, None);
        self.apex.step(step, None);
        let earlier = self.last_forces;
        self.record(system, now);
        let step = Interval { system, before: &self.before, after: now.state };
        let periods = system.omega_bound * step.length() / TAU;
        let points = ((POINTS_PER_PERIOD * periods).ceil() as usize).max(FEWEST_POINTS);
        let ends = earlier.into_iter().zip(self.last_forces);
        let monitors = self.monitors.iter().zip(&mut self.extremes.force);
        for ((monitor, peak), (earlier, last)) in monitors.zip(ends) {
            let ends = f64::max(earlier, last);
            if ends < FAR * peak.value {
                continue;
            }
            let guess = monitor.guess(step).max(ends);
            if guess > NEAR * peak.value && guess > 0.0 {
                let found = monitor.largest(step, now.piece, points, CLOSE * peak.value);
                peak.offer(found.value, found.time);
            }
        }
        if !self.loaded && !surveyed {
            self.bend = self.shell.bend(system, now.state);
        }
        if let Some(frames) = &mut self.frames {
            frames.step(step, now.piece);
        }
    }

    fn record(&mut self, system: &System, now: &Moment) {
        let Moment { state, survey, piece, .. } = *now;
        let forces: [f64; 4] = std::array::from_fn(|m| self.monitors[m].at(system, state));
        self.last_forces = forces;
        let extremes = &mut self.extremes;
        for (peak, force) in extremes.force.iter_mut().zip(forces) {
            peak.offer(force, state.time);
        }
        extremes.elastic.offer(survey.elastic, state.time);
        extremes.strain.offer(survey.strain, state.time);
        extremes.least_quad_ratio = extremes.least_quad_ratio.min(survey.quad_ratio);
        let quads = &self.quads;
        let ratio = |quad: usize| {
            let corners = quads[quad].corners.map(|node| state.position(system.place(node)));
            crossed(corners) / quads[quad].area
        };
        let place = |quad: usize| (quads[quad].middle, quads[quad].part);
        self.fold.record(state.time, survey.quad_ratio, ratio, place);
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
            rows.load.push(system.pulse.force(piece, state.time));
            for (trace, force) in rows.force.iter_mut().zip(forces) {
                trace.push(force);
            }
            rows.apex.push(self.apex.last);
            rows.shell_growth.push(self.shell.last_share());
            rows.meridian_growth.push(self.meridian.last_share());
            rows.kinetic.push(survey.kinetic);
            rows.elastic.push(survey.elastic);
            rows.dissipated.push(state.dissipated);
            rows.work.push(state.work);
        }
    }

    /// Whether the energy left can raise no force, nor the shell's growth, in the `left` s to come.
    fn forces_are_final(&self, left: f64) -> bool {
        let most = match self.bounds.shell {
            ShellBound::Stretch(bound) => bound.reach(self.energy),
            ShellBound::Change(all, one) => {
                self.shell.last + self.bend.growth(all, one, self.energy, left)
            }
        };
        let mut forces = self.extremes.force.iter().zip(self.bounds.force);
        forces.all(|(peak, bound)| bound.reach(self.energy) <= peak.value)
            && most <= self.shell.peak.value
    }

    /// Whether nothing recorded can change any more; traces and frames change to the very end.
    pub fn settled(&self) -> bool {
        if self.loaded || self.rows.is_some() || self.frames.is_some() {
            return false;
        }
        let left = self.window - self.before.time;
        let strain = self.bounds.strain.reach(self.energy);
        let stays = |growth: &Growth, bound: Bound| {
            growth.last + bound.travel(self.energy, left) <= growth.peak.value
        };
        strain <= self.extremes.strain.value.min(UNFOLDED_STRAIN)
            && self.forces_are_final(left)
            // No more can be stored than is left.
            && self.energy <= self.extremes.elastic.value
            && stays(&self.apex, self.bounds.apex)
            && stays(&self.meridian, self.bounds.meridian)
    }

    /// The recording, once the run has ended at `state` and cost so much.
    pub fn finish(self, state: &State, cost: Cost) -> Recording {
        let late = self.shell.rising || self.meridian.rising || self.apex.rising;
        let scale = state.work.abs().max(self.most_energy);
        let open = self.loaded || !self.forces_are_final(0.0);
        let lost_in_rounding = state.work != 0.0 && self.most_energy <= LOST * self.rounding;
        let told = PaperExtremes {
            least_quad_ratio: self.extremes.least_quad_ratio,
            fold: self.fold.fold(),
            lost_in_rounding,
            could_rise: open && scale > ROUNDING_J,
            still_rising: late && scale > ROUNDING_J,
            ..PaperExtremes::default()
        };
        let untouched = state.work == 0.0 && self.most_energy <= ROUNDING_J;
        let extremes = if untouched || lost_in_rounding {
            // Nothing acted on the eye: what it seems to have done is rounding.
            told
        } else {
            PaperExtremes {
                force: self.extremes.force,
                apex: self.apex.peak,
                shell_growth: self.shell.largest_share(),
                meridian_growth: self.meridian.largest_share(),
                work: state.work,
                elastic: self.extremes.elastic,
                strain: self.extremes.strain,
                energy_residual: if scale > ROUNDING_J { self.residual / scale } else { 0.0 },
                ..told
            }
        };
        Recording {
            extremes,
            traces: self.rows,
            frames: self.frames.map_or_else(Vec::new, |f| f.frames),
            cost,
            simulated: state.time,
        }
    }
}
