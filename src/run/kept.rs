//! What is kept of a motion, whatever moves: peaks, traces over time, and the eye at chosen
//! instants.

use nalgebra::Point2;

/// The largest value of something and when it was reached.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Peak {
    /// The value.
    pub value: f64,
    /// When, in s.
    pub time: f64,
}

impl Peak {
    /// A peak that anything at or above `floor` replaces.
    pub fn floor(floor: f64) -> Self {
        Self { value: floor, time: 0.0 }
    }

    /// Takes `value` if it is larger.
    pub fn offer(&mut self, value: f64, time: f64) {
        if value > self.value {
            *self = Self { value, time };
        }
    }
}

/// When frames are taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Spacing {
    /// So many intervals at first.
    pub early: u32,
    /// Each of this length, in s.
    pub early_every: f64,
    /// The length of all others, in s.
    pub every: f64,
    /// Whether instead of that half as many as at first are twice as long as those before, and so
    /// on: for a run whose end is not known.
    pub doubles: bool,
}

impl Spacing {
    /// All intervals alike, in s.
    pub fn even(every: f64) -> Self {
        Self { early: 0, early_every: every, every, doubles: false }
    }

    /// So many intervals of this length, in s, at first, half as many twice as long, and so on.
    pub fn doubling(early: u32, every: f64) -> Self {
        Self { early, doubles: true, ..Self::even(every) }
    }

    /// When the frame with this number is due, in s.
    pub(crate) fn due(self, number: usize) -> f64 {
        if self.doubles && number > self.early as usize {
            let half = (self.early as usize / 2).max(1);
            let after = number - self.early as usize;
            let (times, rest) = (after / half, after % half);
            let scale = self.early_every * libm::exp2(times as f64);
            return scale * (self.early as usize + 2 * rest) as f64;
        }
        let early = number.min(self.early as usize);
        self.early_every * early as f64 + self.every * (number - early) as f64
    }
}

/// What to keep beside the extremes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Keep {
    /// Traces: in a section of every step (thinned beyond 100,000 steps), at the axisymmetric eye
    /// of the first step after each thousandth of a window that was asked for.
    pub traces: bool,
    /// Frames, so far apart.
    pub frames: Option<Spacing>,
}

/// All nodes at one instant.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// Time, in s.
    pub time: f64,
    /// Position of each node of the eye, in m. At the axisymmetric eye those of one half of the
    /// section, with x along the blow and y the distance from its line.
    pub positions: Vec<Point2<f64>>,
    /// |m a| of each node of the eye, in N; 0 for the orbit. At the axisymmetric eye m is 75 mg and
    /// a the mean over 20 us.
    pub forces: Vec<f64>,
    /// Pressure of each cell, in Pa, where the eye is made of cells.
    pub cells: Vec<f64>,
    /// Centre of the projectile, in m, where the scene has one: of what is left of it, if it is
    /// soft and squeezed.
    pub projectile: Option<Point2<f64>>,
    /// How much it is squeezed along its way, in m.
    pub squeezed: f64,
    /// Intraocular pressure, in Pa, where the eye has cells.
    pub pressure: Option<f64>,
    /// What is seen from the front, where a model computes more than a section.
    pub front: Option<FrontFrame>,
}

/// An eye and what hits it from the front, in m: x towards the nose, y up.
#[derive(Debug, Clone, PartialEq)]
pub struct FrontFrame {
    /// The ring where cornea and sclera meet.
    pub limbus: Vec<Point2<f64>>,
    /// The ring of the globe that was the widest at rest.
    pub equator: Vec<Point2<f64>>,
    /// The middle of the object.
    pub object: Point2<f64>,
}

/// The place of the frame nearest to a time, in s.
#[cfg(feature = "app")]
pub(crate) fn nearest(frames: &[Frame], time: f64) -> usize {
    let after = frames.partition_point(|frame| frame.time < time);
    let before = after.saturating_sub(1);
    let apart = |place: usize| {
        let frame: Option<&Frame> = frames.get(place);
        frame.map_or(f64::INFINITY, |frame| (frame.time - time).abs())
    };
    if apart(after) < apart(before) { after } else { before }
}

/// Values at step ends, each of the same length, or empty where a scene has no such thing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Traces {
    /// Time, s.
    pub time: Vec<f64>,
    /// Total load, N; at the axisymmetric eye also the force of contact of an object as it is.
    pub load: Vec<f64>,
    /// |sum w m a| over the hats of the monitored nodes, N; at the axisymmetric eye 75 mg times the
    /// mean of their acceleration over 20 us.
    pub force: [Vec<f64>; 4],
    /// Corneal apex displacement, m.
    pub apex: Vec<f64>,
    /// Growth of the shell's length as a share of it.
    pub shell_growth: Vec<f64>,
    /// Growth of the vertical diameter as a share of it.
    pub meridian_growth: Vec<f64>,
    /// Kinetic energy, J.
    pub kinetic: Vec<f64>,
    /// Energy stored in the tissues, J.
    pub elastic: Vec<f64>,
    /// Energy lost to drag and viscosity so far, J.
    pub dissipated: Vec<f64>,
    /// Work done by the load so far, J; by a projectile: the kinetic energy it has given up.
    pub work: Vec<f64>,
    /// Intraocular pressure, Pa; at the axisymmetric eye the mean of the globe through a low pass
    /// of 20 us.
    pub pressure: Vec<f64>,
    /// Pressure at the back of the axisymmetric eye, a mean over 150 us, Pa.
    pub back_pressure: Vec<f64>,
    /// Largest tension of its sclera, through a low pass of 20 us, Pa.
    pub scleral_stress: Vec<f64>,
    /// What its tissues feel: stretch at the equator and at the back, growth at the retina's front
    /// edge, as shares; pull on lens and iris, in m.
    pub tissue: [Vec<f64>; 5],
    /// Loss of its length along the blow, as a share of it.
    pub shortening: Vec<f64>,
    /// Way of its lens along the blow, m.
    pub lens: Vec<f64>,
    /// Way of an object's surface into it, m.
    pub intrusion: Vec<f64>,
    /// Force of contact, mean over 100 us, N.
    pub contact_force: Vec<f64>,
    /// Centre of the projectile along its way, m.
    pub projectile: Vec<f64>,
    /// Velocity of the projectile, m/s.
    pub projectile_velocity: Vec<f64>,
}

impl Traces {
    /// Leaves the first value after each multiple of `every`, in s.
    pub(crate) fn thin(&mut self, every: f64) {
        let bin = |time: &f64| (time / every).floor();
        let mut last = f64::NEG_INFINITY;
        let stays = |time: &f64| {
            let first = bin(time) > last;
            last = last.max(bin(time));
            first
        };
        let stays: Vec<bool> = self.time.iter().map(stays).collect();
        // A trace that is added must be thinned too: hence no `..`.
        let Self {
            time,
            load,
            force: [centre, front, right, top],
            tissue: [equator, back, edge, lens_pull, iris],
            apex,
            shell_growth,
            meridian_growth,
            kinetic,
            elastic,
            dissipated,
            work,
            pressure,
            back_pressure,
            scleral_stress,
            shortening,
            lens,
            intrusion,
            contact_force,
            projectile,
            projectile_velocity,
        } = self;
        let motion = [
            centre,
            front,
            right,
            top,
            equator,
            back,
            edge,
            lens_pull,
            iris,
            apex,
            shell_growth,
            meridian_growth,
        ];
        let energies = [load, kinetic, elastic, dissipated, work];
        let tissues = [pressure, back_pressure, scleral_stress, shortening, lens];
        let object = [intrusion, contact_force, projectile, projectile_velocity];
        let all = motion.into_iter().chain(energies).chain(tissues);
        for trace in all.chain(object).chain([time]) {
            let mut stays = stays.iter();
            trace.retain(|_| *stays.next().unwrap_or(&false));
        }
    }
}
