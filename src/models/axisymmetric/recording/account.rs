//! What is kept of a run of any eye of cells, flat or in three dimensions.

use crate::models::axisymmetric::forces::state::CellSums;
use crate::models::axisymmetric::recording::results::{Energy, Extremes};
use crate::models::axisymmetric::recording::sensor::{
    BACK_MEAN_S, FORCE_MEAN_S, LowPass, RunningMean,
};
use crate::models::axisymmetric::time::until::Until;
use crate::run::fold::FoldWatch;
use crate::run::kept::{Frame, Keep, Traces};

/// Mass by which accelerations become the node forces of the paper, kg.
pub(crate) const NODE_MASS: f64 = 75e-6;

/// How the eye has changed its shape: growths as shares, ways along the blow in m.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Shape {
    pub shortening: f64,
    pub width_growth: f64,
    pub shell_growth: f64,
    pub apex: f64,
    pub lens: f64,
}

/// An object on its way: in m and m/s along the blow.
pub(crate) struct Flight {
    pub intrusion: f64,
    pub middle: f64,
    pub velocity: f64,
}

/// Readings, energies and traces of a run so far.
pub(crate) struct Account {
    pub window: Until,
    /// How long the slowest swing of the eye takes, s.
    pub swing: f64,
    pub keep: Keep,
    /// Of the object at the start, J.
    pub energy_before: f64,
    /// Volume of the globe at rest, m3.
    globe_volume: f64,
    pub energy: Energy,
    /// What the eye was given by the last balance, J.
    work: f64,
    pub extremes: Extremes,
    pub fold: FoldWatch,
    pub traces: Traces,
    /// Frames that nobody took as they came.
    pub frames: Vec<Frame>,
    force_mean: RunningMean,
    back_mean: RunningMean,
    /// Low passes of the mean pressure and of that at the back.
    filters: [LowPass; 2],
    /// The largest tension of the sclera that passed its low pass, Pa.
    pub stress: f64,
    /// When what acts was last seen to be gone, s.
    pub(crate) over_since: Option<f64>,
    /// Most energy that has come in, and most that the balance was off, J.
    came: f64,
    missing: f64,
}

/// A moving eye, as it is read off.
pub(crate) trait Recorded {
    /// What all parts say at some instant.
    type Now;

    fn account(&mut self) -> &mut Account;
    /// Takes the extremes of an instant, by number and time, after a step of so many s and at which
    /// forces act for so many; returns the monitored nodes' forces.
    fn read(&mut self, now: &Self::Now, at: (usize, f64), steps: (f64, f64)) -> [f64; 4];
    /// Takes those that are not taken at every step, at the last.
    fn read_last(&mut self, _time: f64) {}
    /// Energies of this instant, at which forces act for `kick` s.
    fn balance(&mut self, now: &Self::Now, kick: f64);
    fn trace(&mut self, now: &Self::Now, time: f64, node_force: [f64; 4]);
    /// The frames that fall into the step of `step` s that ended at `time`.
    fn frames(&mut self, time: f64, step: f64) -> Vec<Frame>;
}

impl Account {
    /// Of a mesh of so many cells, before anything has happened.
    pub fn new(
        (window, keep): (Until, Keep),
        swing: f64,
        energy_before: f64,
        (globe_volume, cells): (f64, usize),
    ) -> Self {
        Self {
            window,
            swing,
            keep,
            energy_before,
            globe_volume,
            energy: Energy::default(),
            work: 0.0,
            extremes: Extremes::at_rest(),
            fold: FoldWatch::new(cells),
            traces: Traces::default(),
            frames: Vec::new(),
            force_mean: RunningMean::over(FORCE_MEAN_S),
            back_mean: RunningMean::over(BACK_MEAN_S),
            filters: [LowPass::default(); 2],
            stress: 0.0,
            over_since: None,
            came: 0.0,
            missing: 0.0,
        }
    }

    /// Extremes of the force on the eye and of what the cells say; returns the share of a low pass.
    pub fn read(&mut self, force: f64, cells: &CellSums, (time, step): (f64, f64)) -> f64 {
        let share = LowPass::share(step);
        let e = &mut self.extremes;
        e.force.offer(force, time);
        let mean = self.force_mean.pass(force, time, step);
        e.mean_force.offer(mean, time);
        let pressure = self.filters[0].pass(cells.pressure, share);
        e.pressure.offer(pressure, time);
        let back = self.filters[1].pass(cells.sensor, share);
        e.back_pressure.offer(back, time);
        let mean = self.back_mean.pass(cells.sensor, time, step);
        e.mean_back_pressure.offer(mean, time);
        let volume = cells.volume / self.globe_volume;
        e.least_volume = e.least_volume.min(volume);
        e.most_volume = e.most_volume.max(volume);
        e.least_triangle = e.least_triangle.min(cells.least_corner);
        share
    }

    /// Extremes by an object: its energy, that of its contact with eye and bone, J, its way in, m.
    pub fn read_object(&mut self, energy: f64, (on_eye, on_bone): (f64, f64), way: f64, time: f64) {
        let kept = energy + self.energy.lost_in_object;
        let given = self.energy_before - kept - on_eye - on_bone;
        self.extremes.energy_given.offer(given, time);
        self.extremes.intrusion.offer(way, time);
    }

    pub fn read_shape(&mut self, shape: &Shape, time: f64) {
        let e = &mut self.extremes;
        e.shortening.offer(shape.shortening, time);
        e.equator_growth.offer(shape.width_growth, time);
        e.shell_growth.offer(shape.shell_growth, time);
        e.apex.offer(shape.apex, time);
        e.lens.offer(shape.lens, time);
    }

    /// Forces of the monitored nodes by their accelerations, m/s2.
    pub fn read_nodes(&mut self, accelerations: [f64; 4], time: f64) -> [f64; 4] {
        let forces = accelerations.map(|a| NODE_MASS * a);
        for (peak, force) in self.extremes.node_force.iter_mut().zip(forces) {
            peak.offer(force, time);
        }
        forces
    }

    /// The mean pressure through its low pass, Pa.
    pub fn pressure(&self) -> f64 {
        self.filters[0].now
    }

    /// What the object has given to the eye by the last balance, J.
    pub fn given(&self) -> f64 {
        let e = &self.energy;
        self.energy_before - e.object - e.lost_in_object - e.contact
    }

    /// Takes what the eye was given, J; how it flies off as a whole no part of it feels.
    pub fn impart(&mut self, given: f64, flown: f64) {
        self.work = given;
        self.extremes.energy_imparted = given - flown;
    }

    /// Adds the values of an instant to the traces.
    pub fn trace(
        &mut self,
        time: f64,
        (force, node_force): (f64, [f64; 4]),
        shape: &Shape,
        tissue: [f64; 5],
        flight: Option<Flight>,
    ) {
        let t = &mut self.traces;
        t.time.push(time);
        t.load.push(force);
        for (trace, force) in t.force.iter_mut().zip(node_force) {
            trace.push(force);
        }
        t.apex.push(shape.apex);
        t.shell_growth.push(shape.shell_growth);
        t.meridian_growth.push(shape.width_growth);
        t.kinetic.push(self.energy.kinetic);
        t.elastic.push(self.energy.elastic);
        t.dissipated.push(self.energy.lost);
        t.work.push(self.work);
        t.pressure.push(self.filters[0].now);
        t.back_pressure.push(self.back_mean.now);
        t.scleral_stress.push(self.stress);
        for (trace, now) in t.tissue.iter_mut().zip(tissue) {
            trace.push(now);
        }
        t.shortening.push(shape.shortening);
        t.lens.push(shape.lens);
        if let Some(flight) = flight {
            t.contact_force.push(self.force_mean.now);
            t.intrusion.push(flight.intrusion);
            t.projectile.push(flight.middle);
            t.projectile_velocity.push(flight.velocity);
        }
    }

    /// Compares the energies of the last balance; never more or less often by what is kept.
    pub fn audit(&mut self) {
        self.came = self.came.max(self.energy_before + self.energy.work.abs());
        let missing = (self.energy.total() - self.energy_before).abs();
        self.missing = self.missing.max(missing);
    }

    /// Whether it may: traces and frames want the whole of a time that was asked for.
    pub fn ends_by_itself(&self) -> bool {
        !matches!(self.window, Until::Time(_)) || self.keep == Keep::default()
    }

    /// Whether what acts is gone and nothing has grown since `last_growth` for long.
    pub fn settled(&mut self, over: bool, last_growth: f64, time: f64) -> bool {
        if !self.ends_by_itself() {
            return false;
        }
        // An eye that was let go swings back: its growth may begin only now.
        if !over {
            self.over_since = None;
            return false;
        }
        last_growth.max(*self.over_since.get_or_insert(time)) < time - self.swing
    }

    /// Completes the extremes at the end, where an object leaves at `rebound` m/s.
    pub fn finish(&mut self, rebound: Option<f64>) {
        let e = &mut self.extremes;
        e.rebound = rebound;
        e.energy_residual = if self.came > 0.0 { self.missing / self.came } else { 0.0 };
        e.fold = self.fold.fold();
        e.touching = self.energy.contact > 0.0;
        if e.missed() {
            // What an eye that nothing touched shows is rounding.
            *e = Extremes {
                rim_force: e.rim_force,
                rebound,
                energy_residual: e.energy_residual,
                ..Extremes::at_rest()
            };
        }
    }
}
