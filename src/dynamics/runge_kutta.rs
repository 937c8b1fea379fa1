//! Explicit Runge-Kutta methods on the motion in first-order form, x' = v, v' = F/m - c v/m.
//!
//! Classical RK4 takes equal steps. The Dormand-Prince pair 5(4) compares its two solutions and
//! chooses the step: the error is measured in the energy norm, `sqrt(sum m (|e_v|^2 +
//! w^2 |e_x|^2) / 2E)` with w the frequency bound and E the largest energy so far, and kept below the local
//! tolerance. Both are here to be compared with the compositions, which win on this problem: the
//! spectrum is nearly imaginary, so stability per evaluation decides.
//!
//! J. R. Dormand and P. J. Prince, J. Comput. Appl. Math. 6 (1980) 19-26.

use super::integrator::Stepper;
use super::kernel::{self, Survey};
use super::load::{Piece, Segment};
use super::state::State;
use super::system::{LANES, System};

/// Coefficients of an explicit method; its last stage is the solution at the end of the step.
pub(super) struct Tableau {
    nodes: &'static [f64],
    stages: &'static [&'static [f64]],
    weights: &'static [f64],
    /// Weights of the solution minus those of the embedded one, the last for the end of the step.
    error: &'static [f64],
    /// Order that the error estimate shrinks with, plus one.
    error_power: f64,
}

pub(super) const RK4: Tableau = Tableau {
    nodes: &[0.0, 0.5, 0.5, 1.0],
    stages: &[&[], &[0.5], &[0.0, 0.5], &[0.0, 0.0, 1.0]],
    weights: &[1.0 / 6.0, 1.0 / 3.0, 1.0 / 3.0, 1.0 / 6.0],
    error: &[],
    error_power: 5.0,
};

pub(super) const DOPRI5: Tableau = Tableau {
    nodes: &[0.0, 0.2, 0.3, 0.8, 8.0 / 9.0, 1.0],
    stages: &[
        &[],
        &[0.2],
        &[3.0 / 40.0, 9.0 / 40.0],
        &[44.0 / 45.0, -56.0 / 15.0, 32.0 / 9.0],
        &[
            19372.0 / 6561.0,
            -25360.0 / 2187.0,
            64448.0 / 6561.0,
            -212.0 / 729.0,
        ],
        &[
            9017.0 / 3168.0,
            -355.0 / 33.0,
            46732.0 / 5247.0,
            49.0 / 176.0,
            -5103.0 / 18656.0,
        ],
    ],
    weights: &[
        35.0 / 384.0,
        0.0,
        500.0 / 1113.0,
        125.0 / 192.0,
        -2187.0 / 6784.0,
        11.0 / 84.0,
    ],
    error: &[
        71.0 / 57600.0,
        0.0,
        -71.0 / 16695.0,
        71.0 / 1920.0,
        -17253.0 / 339_200.0,
        22.0 / 525.0,
        -1.0 / 40.0,
    ],
    error_power: 5.0,
};

/// A step is never made longer, or shorter, than this at once.
const GROWTH: (f64, f64) = (0.2, 5.0);
/// Share of the step that the error would allow.
const CAUTION: f64 = 0.9;
/// A step this small a share of the segment is taken whatever its error, so that time advances.
const SMALLEST_SHARE: f64 = 1e-9;
/// Errors are shares of no less than this: of an eye at rest only rounding is left, which no step
/// makes small.
const LEAST_ENERGY_J: f64 = 1e-14;

/// Rates of change at one stage.
#[derive(Clone)]
struct Rates {
    x: Vec<f64>,
    y: Vec<f64>,
    vx: Vec<f64>,
    vy: Vec<f64>,
    work: f64,
    dissipated: f64,
}

pub(super) struct RungeKutta {
    tableau: &'static Tableau,
    segment: Segment,
    /// Longest step, s.
    longest: f64,
    /// Next step, s.
    next: f64,
    /// None for equal steps.
    tolerance: Option<f64>,
    largest_energy: f64,
    rates: Vec<Rates>,
    evaluations: usize,
}

impl RungeKutta {
    pub fn new(
        tableau: &'static Tableau,
        system: &System,
        segment: Segment,
        steps: usize,
        tolerance: Option<f64>,
    ) -> Self {
        let len = system.rest_x.len();
        let zeros = || vec![0.0; len];
        let rates = Rates {
            x: zeros(),
            y: zeros(),
            vx: zeros(),
            vy: zeros(),
            work: 0.0,
            dissipated: 0.0,
        };
        let longest = (segment.end - segment.start) / steps as f64;
        Self {
            tableau,
            segment,
            longest,
            next: longest,
            tolerance: tolerance.filter(|_| !tableau.error.is_empty()),
            largest_energy: 0.0,
            rates: vec![rates; tableau.nodes.len() + 1],
            evaluations: 0,
        }
    }

    /// Rates at the state, whose acceleration is up to date.
    fn take_rates(&mut self, stage: usize, system: &System, state: &State, force: f64) {
        let rates = &mut self.rates[stage];
        rates.dissipated = 0.0;
        for slot in 0..system.groups.len() * LANES {
            let (group, lane) = (&system.groups[slot / LANES], slot % LANES);
            let fat = group.fat[lane] > 0.0;
            let decay = system.decay[usize::from(fat)];
            let (vx, vy) = (state.vx[slot], state.vy[slot]);
            rates.x[slot] = vx;
            rates.y[slot] = vy;
            rates.vx[slot] = state.ax[slot] - decay * vx;
            rates.vy[slot] = state.ay[slot] - decay * vy;
            rates.dissipated += 2.0 * decay * group.half_mass[lane] * (vx * vx + vy * vy);
        }
        rates.work = force * state.load_speed(system);
    }

    /// Sets `state` to `start` plus `h` times the weighted rates.
    fn combine(&self, system: &System, state: &mut State, start: &State, weights: &[f64], h: f64) {
        state.copy_motion(system, start);
        state.work = start.work;
        state.dissipated = start.dissipated;
        for (weight, rates) in weights.iter().zip(&self.rates) {
            let w = weight * h;
            if w == 0.0 {
                continue;
            }
            for (to, rate) in [
                (&mut state.x, &rates.x),
                (&mut state.y, &rates.y),
                (&mut state.vx, &rates.vx),
                (&mut state.vy, &rates.vy),
            ] {
                for (value, rate) in to.iter_mut().zip(rate) {
                    *value += w * rate;
                }
            }
            state.work += w * rates.work;
            state.dissipated += w * rates.dissipated;
        }
    }

    /// Tries one step of `h` from `start`; leaves the result in `state`.
    fn attempt(
        &mut self,
        system: &System,
        state: &mut State,
        start: &State,
        piece: Piece,
        h: f64,
    ) -> Survey {
        let pulse = system.load().pulse;
        for stage in 1..self.tableau.nodes.len() {
            self.combine(system, state, start, self.tableau.stages[stage], h);
            let force = pulse.force(piece, start.time + self.tableau.nodes[stage] * h);
            kernel::evaluate(system, state, force, 0.0);
            self.take_rates(stage, system, state, force);
        }
        self.combine(system, state, start, self.tableau.weights, h);
        let force = pulse.force(piece, start.time + h);
        let survey = kernel::evaluate(system, state, force, 0.0);
        self.take_rates(self.tableau.nodes.len(), system, state, force);
        self.evaluations += self.tableau.nodes.len();
        survey
    }

    /// Local error in the energy norm.
    fn error(&self, system: &System, h: f64) -> f64 {
        let omega = system.omega_bound();
        let mut energy = 0.0;
        for slot in 0..system.groups.len() * LANES {
            let half_mass = system.groups[slot / LANES].half_mass[slot % LANES];
            if half_mass == 0.0 {
                continue;
            }
            let sum = |of: fn(&Rates) -> &[f64]| -> f64 {
                self.tableau
                    .error
                    .iter()
                    .zip(&self.rates)
                    .map(|(w, rates)| w * of(rates)[slot])
                    .sum::<f64>()
                    * h
            };
            let (ex, ey) = (sum(|r| &r.x), sum(|r| &r.y));
            let (evx, evy) = (sum(|r| &r.vx), sum(|r| &r.vy));
            energy += half_mass * (evx * evx + evy * evy + omega * omega * (ex * ex + ey * ey));
        }
        (energy / self.largest_energy).sqrt()
    }
}

impl Stepper for RungeKutta {
    fn step(&mut self, system: &System, state: &mut State, piece: Piece) -> Survey {
        let mut start = state.clone();
        start.work = state.work;
        let force = system.load().pulse.force(piece, state.time);
        self.take_rates(0, system, state, force);
        let Some(tolerance) = self.tolerance else {
            let survey = self.attempt(system, state, &start, piece, self.longest);
            state.time = start.time + self.longest;
            return survey;
        };
        loop {
            let left = self.segment.end - start.time;
            // The last two steps of a segment share what is left, so that none is tiny.
            let h = if self.next >= left {
                left
            } else if 2.0 * self.next > left {
                0.5 * left
            } else {
                self.next
            };
            let survey = self.attempt(system, state, &start, piece, h);
            self.largest_energy = self
                .largest_energy
                .max(survey.kinetic + survey.elastic)
                .max(LEAST_ENERGY_J);
            let error = self.error(system, h);
            let factor = CAUTION * (tolerance / error).powf(1.0 / self.tableau.error_power);
            let accepted = error <= tolerance || h <= SMALLEST_SHARE * self.longest;
            self.next = (h * factor.clamp(GROWTH.0, GROWTH.1)).min(self.longest);
            if accepted || !error.is_finite() {
                state.time = if h == left {
                    self.segment.end
                } else {
                    start.time + h
                };
                return survey;
            }
        }
    }

    fn evaluations(&self) -> usize {
        self.evaluations
    }
}
