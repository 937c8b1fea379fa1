//! What is read off the moving eye as instruments would: a pressure sensor at the back, and
//! accelerometers at the four monitored places.

use crate::models::axisymmetric::eye::{AxisymmetricEye, Tissue};
use crate::models::axisymmetric::eye::{distance, front_angle, part, upon};
use crate::models::axisymmetric::forces::cell::volume;
use crate::models::axisymmetric::forces::state::NodeState;
use nalgebra::{SVector, Vector2};
use std::collections::VecDeque;

/// Where the sensor sits, on the axis behind the centre, and how far around it takes a mean, in m.
pub(crate) const SENSOR_X: f64 = 8e-3;
pub(crate) const SENSOR_REACH: f64 = 3e-3;
/// Time constant of the sensor, and time over which accelerations are averaged, in s.
pub const SMOOTHING_S: f64 = 20e-6;
/// Time over which the force of contact is averaged, as in a section, in s: its sharper peaks are
/// those of the piece of shell that is hit first, so of the mesh.
pub(crate) const FORCE_MEAN_S: f64 = 100e-6;
/// Length of the mean of the pressure at the back, in s: sound in the globe, slowed by a bulk
/// modulus of 100 `MPa`, goes to the back and returns in this time. What is shorter is an echo of
/// it, and of the focus of a perfectly round eye.
pub(crate) const BACK_MEAN_S: f64 = 150e-6;

/// Points along each side of a cell that tell how much of it the sensor takes.
const POINTS: usize = 8;

/// Share of the section of a cell that lies within reach of the sensor.
fn near(corners: &[(f64, f64); 4]) -> f64 {
    let within = (0..POINTS * POINTS).filter(|i| {
        let at = upon(corners, part(i % POINTS, POINTS), part(i / POINTS, POINTS));
        distance(at, (SENSOR_X, 0.0)) <= SENSOR_REACH
    });
    within.count() as f64 / (POINTS * POINTS) as f64
}

/// Weight of each cell in the mean pressure of the globe, and in the sensor's.
pub(crate) fn weights(eye: &AxisymmetricEye) -> Vec<(f64, f64)> {
    weighed(eye.cells.iter().map(|cell| {
        let p = cell.corners.map(|n| eye.at(n));
        (cell.region, volume(p).0, near(&p))
    }))
}

/// Those of cells of such volumes at rest, the sensor's as far as they lie within its reach.
pub(crate) fn weighed(cells: impl Iterator<Item = (Tissue, f64, f64)>) -> Vec<(f64, f64)> {
    let weight = |(region, volume, near)| {
        let globe = if region == Tissue::Globe { volume } else { 0.0 };
        (globe, near * globe)
    };
    let mut weights: Vec<(f64, f64)> = cells.map(weight).collect();
    let total = weights.iter().fold((0.0, 0.0), |t, w| (t.0 + w.0, t.1 + w.1));
    for w in &mut weights {
        *w = (w.0 / total.0, w.1 / total.1);
    }
    weights
}

/// A first-order low pass of 20 us.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct LowPass {
    pub now: f64,
    before: f64,
}

impl LowPass {
    /// `share` is that of the way to the mean of `value` and the one before that is gone.
    pub fn pass(&mut self, value: f64, share: f64) -> f64 {
        self.now += (0.5 * (self.before + value) - self.now) * share;
        self.before = value;
        self.now
    }

    /// The share of a step, in s.
    pub fn share(step: f64) -> f64 {
        -libm::expm1(-step / SMOOTHING_S)
    }
}

/// The mean of something over the last while.
pub(crate) struct RunningMean {
    pub now: f64,
    /// Length of the mean, in s.
    over: f64,
    integral: f64,
    before: f64,
    /// Times and integrals up to them.
    past: VecDeque<(f64, f64)>,
}

impl RunningMean {
    pub fn over(over: f64) -> Self {
        Self { now: 0.0, over, integral: 0.0, before: 0.0, past: VecDeque::from([(0.0, 0.0)]) }
    }

    /// The mean with `value` now, at `time`, `step` s after the one before.
    pub fn pass(&mut self, value: f64, time: f64, step: f64) -> f64 {
        self.integral += 0.5 * (self.before + value) * step;
        self.before = value;
        self.past.push_back((time, self.integral));
        let start = time - self.over;
        while self.past.len() > 2 && self.past[1].0 <= start {
            self.past.pop_front();
        }
        let ((t0, first), (t1, second)) = (self.past[0], self.past[1]);
        // Nothing was before the first step; a later entry may lie at the start to the last bit.
        let gone =
            if start <= t0 { first } else { first + (second - first) * (start - t0) / (t1 - t0) };
        self.now = (self.integral - gone) / self.over;
        self.now
    }
}

/// Velocities of the four monitored places over the last while, of `D` components.
#[derive(Debug, Clone, Default)]
pub(crate) struct Velocities<const D: usize> {
    past: VecDeque<(f64, [SVector<f64, D>; 4])>,
}

impl<const D: usize> Velocities<D> {
    /// By how much they have changed over the last 20 us up to `time` s, in m/s.
    pub fn change(&mut self, now: [SVector<f64, D>; 4], time: f64) -> [SVector<f64, D>; 4] {
        self.past.push_back((time, now));
        let start = time - SMOOTHING_S;
        while self.past.len() > 2 && self.past[1].0 <= start {
            self.past.pop_front();
        }
        let (t0, first) = self.past[0];
        let (t1, second) = self.past[1.min(self.past.len() - 1)];
        // Before the first step all was at rest.
        let s = if t1 > t0 { ((start - t0) / (t1 - t0)).clamp(0.0, 1.0) } else { 0.0 };
        std::array::from_fn(|i| {
            if start < t0 { now[i] } else { now[i] - (first[i] + (second[i] - first[i]) * s) }
        })
    }
}

/// The four monitored places and what they have been through.
pub(crate) struct Accelerometers {
    places: [Vec<(usize, f64)>; 4],
    velocities: Velocities<2>,
}

/// The nodes nearest to the four monitored places.
pub fn monitored(eye: &AxisymmetricEye) -> [usize; 4] {
    let nearest = |place: Vec<(usize, f64)>| {
        let most = place.into_iter().max_by(|a, b| a.1.total_cmp(&b.1));
        most.map_or(0, |(node, _)| node)
    };
    places(eye, |node| node).map(nearest)
}

/// The places of the planar eye: in the vitreous 1.333 mm up and back of the centre, on the shell 5
/// degrees above both poles and 5 behind the top. Between nodes, velocity is linear.
fn places(eye: &AxisymmetricEye, place: impl Fn(usize) -> usize) -> [Vec<(usize, f64)>; 4] {
    let on_shell = |angle: f64| on_shell(eye, angle.to_radians(), &place);
    let aim = eye.parameters.radius / 9.0 * std::f64::consts::FRAC_1_SQRT_2;
    [between(eye, (aim, aim), &place), on_shell(5.0), on_shell(175.0), on_shell(95.0)]
}

/// The shell's nodes on both sides of a front angle (rad) at rest, with linear shares.
pub(crate) fn on_shell(
    eye: &AxisymmetricEye,
    angle: f64,
    place: impl Fn(usize) -> usize,
) -> Vec<(usize, f64)> {
    let fronts: Vec<f64> = eye.mesh.shell.iter().map(|&n| front_angle(eye.at(n))).collect();
    let after = fronts.iter().position(|&f| f > angle);
    let i = after.unwrap_or(fronts.len() - 1).max(1);
    let s = (angle - fronts[i - 1]) / (fronts[i] - fronts[i - 1]);
    vec![(place(eye.mesh.shell[i - 1]), 1.0 - s), (place(eye.mesh.shell[i]), s)]
}

impl Accelerometers {
    /// At rest.
    pub fn new(eye: &AxisymmetricEye, place: impl Fn(usize) -> usize) -> Self {
        Self { places: places(eye, place), velocities: Velocities::default() }
    }

    /// Mean accelerations over the last 20 us up to `time` s of the velocities, m/s2.
    pub fn read(&mut self, state: &NodeState, time: f64) -> [f64; 4] {
        let now = std::array::from_fn(|i| {
            let velocity = |&(place, share): &(usize, f64)| {
                Vector2::new(state.vx[place], state.vr[place]) * share
            };
            self.places[i].iter().map(velocity).sum()
        });
        let change = self.velocities.change(now, time);
        change.map(|change| libm::hypot(change.x, change.y) / SMOOTHING_S)
    }
}

/// Corners of the cell around the place `aim` at rest with bilinear shares.
pub(crate) fn between(
    eye: &AxisymmetricEye,
    aim: (f64, f64),
    place: impl Fn(usize) -> usize,
) -> Vec<(usize, f64)> {
    for cell in &eye.cells {
        let p = cell.corners.map(|n| eye.at(n));
        // Newton's method on the bilinear map; cells are convex, so it converges.
        let (mut s, mut t) = (0.5, 0.5);
        let shares = |s: f64, t: f64| [(1.0 - s) * (1.0 - t), s * (1.0 - t), s * t, (1.0 - s) * t];
        for _ in 0..20 {
            let w = shares(s, t);
            let (mut x, mut r) = (-aim.0, -aim.1);
            for i in 0..4 {
                x += w[i] * p[i].0;
                r += w[i] * p[i].1;
            }
            let ds = |f: fn(&(f64, f64)) -> f64| {
                (1.0 - t) * (f(&p[1]) - f(&p[0])) + t * (f(&p[2]) - f(&p[3]))
            };
            let dt = |f: fn(&(f64, f64)) -> f64| {
                (1.0 - s) * (f(&p[3]) - f(&p[0])) + s * (f(&p[2]) - f(&p[1]))
            };
            let (xs, rs, xt, rt) = (ds(|p| p.0), ds(|p| p.1), dt(|p| p.0), dt(|p| p.1));
            let det = xs * rt - xt * rs;
            s -= (x * rt - r * xt) / det;
            t -= (r * xs - x * rs) / det;
        }
        let inside = -1e-9..=1.0 + 1e-9;
        if inside.contains(&s) && inside.contains(&t) {
            let w = shares(s, t);
            return (0..4).map(|i| (place(cell.corners[i]), w[i])).collect();
        }
    }
    Vec::new()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mean_forgets_what_lies_before_it_even_where_an_entry_lies_at_its_start() {
        let step = 0.25;
        let mut mean = RunningMean::over(8.0 * step);
        for count in 0..100 {
            let now = mean.pass(3.0, f64::from(count) * step, step);
            // It rises from nothing while it still reaches back to before the first step.
            let expected = 3.0 * (f64::from(count) + 0.5).min(8.0) / 8.0;
            assert!((now - expected).abs() < 0.2, "{count}: {now}");
        }
        assert_eq!(mean.now, 3.0);
    }
}
