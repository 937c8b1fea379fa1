//! What is kept of a motion, whatever moves: peaks, traces over time, the eye at chosen instants.

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
    /// Whether, instead, half as many follow that are twice as long, and so on.
    pub doubles: bool,
}

impl Spacing {
    /// All intervals of this length, in s.
    pub fn even(every: f64) -> Self {
        Self { early: 0, early_every: every, every, doubles: false }
    }

    /// For a run whose end is not known.
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
    /// Traces: of every step in a section (thinned beyond 100,000), else of about 1000 a window.
    pub traces: bool,
    /// Frames, so far apart.
    pub frames: Option<Spacing>,
}

/// All nodes at one instant.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Frame {
    /// Time, in s.
    pub time: f64,
    /// Position of each node, in m; at the axisymmetric eye of one half of the section, with x
    /// along the blow and y the distance from its line.
    pub positions: Vec<Point2<f64>>,
    /// How far each node lies out of the plane of those, in m, towards the side where x turns to y
    /// anticlockwise; empty where none can leave it.
    pub aside: Vec<f64>,
    /// |m a| of each node, in N; at the axisymmetric eye m is 75 mg and a the mean over 20 us.
    pub forces: Vec<f64>,
    /// Pressure of each cell, in Pa, where the eye is made of cells.
    pub cells: Vec<f64>,
    /// Centre of the projectile, in m, where there is one: of what is left of it if it is squeezed.
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

/// The traces of a run, and a way through all of them, so that one that is added is thinned too.
macro_rules! traces {
    ($($(#[$doc:meta])* $name:ident,)*) => {
        /// Values at step ends, each of the same length, or empty where a scene has no such thing.
        #[derive(Debug, Clone, PartialEq, Default)]
        pub struct Traces {
            $($(#[$doc])* pub $name: Vec<f64>,)*
            /// |sum w m a| over the hats of the monitored nodes, N; at the axisymmetric eye 75 mg
            /// times the mean of their acceleration over 20 us.
            pub force: [Vec<f64>; 4],
            /// What its tissues feel: stretch at the equator and at the back, growth at the
            /// retina's front edge, as shares; pull on lens and iris, in m.
            pub tissue: [Vec<f64>; 5],
        }

        impl Traces {
            fn all_mut(&mut self) -> impl Iterator<Item = &mut Vec<f64>> {
                [$(&mut self.$name),*].into_iter().chain(&mut self.force).chain(&mut self.tissue)
            }
        }
    };
}

traces! {
    /// Time, s.
    time,
    /// Total load, N; at the axisymmetric eye also the force of contact of an object as it is.
    load,
    /// Corneal apex displacement, m.
    apex,
    /// Growth of the shell's length as a share of it.
    shell_growth,
    /// Growth of the vertical diameter as a share of it.
    meridian_growth,
    /// Kinetic energy, J.
    kinetic,
    /// Energy stored in the tissues, J.
    elastic,
    /// Energy lost to drag and viscosity so far, J.
    dissipated,
    /// Work done by the load so far, J; by a projectile: the kinetic energy it has given up.
    work,
    /// Intraocular pressure, Pa: the mean of the globe through a low pass of 20 us.
    pressure,
    /// Pressure at the back of the axisymmetric eye, a mean over 150 us, Pa.
    back_pressure,
    /// Largest tension of its sclera, through a low pass of 20 us, Pa.
    scleral_stress,
    /// Loss of its length along the blow, as a share of it.
    shortening,
    /// Way of its lens along the blow, m.
    lens,
    /// Way of an object's surface into it, m.
    intrusion,
    /// Force of contact, mean over 100 us, N.
    contact_force,
    /// Centre of the projectile along its way, m.
    projectile,
    /// Velocity of the projectile, m/s.
    projectile_velocity,
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
        for trace in self.all_mut() {
            let mut stays = stays.iter();
            trace.retain(|_| *stays.next().unwrap_or(&false));
        }
    }
}
