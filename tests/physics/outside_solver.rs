//! The motion against a solver that shares nothing with the program: DOP853 of the crate
//! `differential-equations`, on equations written out here from the nodes and springs alone.
//!
//! Displacements are in mm, times in ms and speeds in m/s, so that one tolerance fits all. The
//! work of the load and the loss to drag are two more unknowns. Stretches of the springs come from
//! displacements, without cancellation, and the loaded arc's shares from overlaps of intervals.

use contrecoup::models::paper::case::PaperCase;
use contrecoup::models::paper::eye::Eye;
use contrecoup::models::paper::forces::state::State;
use contrecoup::models::paper::time::march::march;
use contrecoup::run::kept::Keep;
use contrecoup::run::places::Region;
use contrecoup::run::plan::{LOCAL_TOLERANCE, Plan};
use contrecoup::run::watch::unwatched;
use contrecoup::scenario::Integrator;
use contrecoup::scenario::{Curve, ForcePulse, Impact, PulseShape, Scenario};
use differential_equations::prelude::*;
use std::f64::consts::PI;
use std::ops::ControlFlow;

/// What the two must agree to.
const AGREEMENT: f64 = 1e-9;
/// What the outside solver is asked for.
const TOLERANCE: f64 = 1e-12;

/// The equations of motion over a stretch of time in which the load is smooth.
struct Motion<'a> {
    eye: &'a Eye,
    blow: &'a ForcePulse,
    /// Node, force along x and y per N of the whole.
    shares: Vec<(usize, f64, f64)>,
    /// An instant inside the stretch, ms.
    inside: f64,
}

/// Forces on a node per N of the whole force, from the documented rule.
fn shares(eye: &Eye, blow: &ForcePulse) -> Vec<(usize, f64, f64)> {
    let shell: Vec<usize> = (0..eye.nodes.len())
        .filter(|&i| matches!(eye.nodes[i].region, Region::Shell | Region::Retina))
        .collect();
    let own = 360.0 / shell.len() as f64;
    let opening = eye.opening_rad.to_degrees();
    let from = (blow.angle_deg - blow.half_width_deg).max(-opening);
    let to = (blow.angle_deg + blow.half_width_deg).min(opening);
    let overlaps: Vec<(usize, f64)> = shell
        .into_iter()
        .map(|i| {
            let p = eye.nodes[i].position;
            let middle = p.y.atan2(-p.x).to_degrees();
            let overlap = to.min(middle + own / 2.0) - from.max(middle - own / 2.0);
            (i, overlap.max(0.0))
        })
        .collect();
    let sum: f64 = overlaps.iter().map(|o| o.1).sum();
    let (sin, cos) = blow.angle_deg.to_radians().sin_cos();
    overlaps
        .into_iter()
        .filter(|o| o.1 > 1e-9)
        .map(|(i, overlap)| (i, cos * overlap / sum, -sin * overlap / sum))
        .collect()
}

/// Whole force at `t` ms by the law that holds around `inside`, N.
fn force(blow: &ForcePulse, inside: f64, t: f64) -> f64 {
    let (s, t) = (inside / blow.duration_ms, t / blow.duration_ms);
    if s > 1.0 {
        return 0.0;
    }
    blow.force_n
        * match &blow.shape {
            PulseShape::SmoothRectangle { edge_fraction: e } if s < *e => {
                (PI * t / (2.0 * e)).sin().powi(2)
            }
            PulseShape::SmoothRectangle { edge_fraction: e } if s > 1.0 - *e => {
                (PI * (1.0 - t) / (2.0 * e)).sin().powi(2)
            }
            PulseShape::SmoothRectangle { .. } => 1.0,
            PulseShape::Triangle => 1.0 - (2.0 * t - 1.0) * (s - 0.5).signum(),
            PulseShape::HalfSine => (PI * t).sin(),
            PulseShape::Table(curve) => {
                let end = curve.last_ms();
                let mut pairs = curve.knots().windows(2);
                let around = pairs.find(|pair| pair[0].0 <= s * end && s * end < pair[1].0);
                around.map_or(0.0, |pair| {
                    let slope = (pair[1].1 - pair[0].1) / (pair[1].0 - pair[0].0);
                    pair[0].1 + slope * (t * end - pair[0].0)
                })
            }
        }
}

/// Instants at which the force or its slope jumps, ms.
fn breaks(blow: &ForcePulse) -> Vec<f64> {
    let inner = match &blow.shape {
        PulseShape::SmoothRectangle { edge_fraction: e } => vec![*e, 1.0 - e],
        PulseShape::Triangle => vec![0.5],
        PulseShape::HalfSine => Vec::new(),
        PulseShape::Table(curve) => {
            let knots = curve.knots().iter();
            knots.map(|(time, _)| time / curve.last_ms()).collect()
        }
    };
    inner.into_iter().chain([1.0]).map(|share| share * blow.duration_ms).collect()
}

impl Motion<'_> {
    /// Force of springs and load on every node at displacements `u`, N.
    fn forces(&self, t: f64, u: &[f64]) -> Vec<[f64; 2]> {
        let nodes = &self.eye.nodes;
        let mut forces = vec![[0.0; 2]; nodes.len()];
        for spring in &self.eye.springs {
            let (a, b) = (spring.a, spring.b);
            let rest = [
                1e3 * (nodes[b].position.x - nodes[a].position.x),
                1e3 * (nodes[b].position.y - nodes[a].position.y),
            ];
            let change = [u[2 * b] - u[2 * a], u[2 * b + 1] - u[2 * a + 1]];
            let now = [rest[0] + change[0], rest[1] + change[1]];
            let length = now[0].hypot(now[1]);
            let squares: f64 = (0..2).map(|i| change[i] * (rest[i] + now[i])).sum();
            // (l^2 - l0^2) / (l + l0), in mm; k is in N/m.
            let stretch = squares / (length + 1e3 * spring.rest_length);
            let pull = 1e-3 * spring.stiffness * stretch / length;
            for i in 0..2 {
                forces[a][i] += pull * now[i];
                forces[b][i] -= pull * now[i];
            }
        }
        let whole = force(self.blow, self.inside, t);
        for &(node, x, y) in &self.shares {
            forces[node][0] += x * whole;
            forces[node][1] += y * whole;
        }
        forces
    }
}

impl ODE<f64, Vec<f64>> for Motion<'_> {
    fn diff(&self, t: f64, y: &Vec<f64>, dydt: &mut Vec<f64>) {
        let count = 2 * self.eye.nodes.len();
        let (u, v) = y[..2 * count].split_at(count);
        dydt.fill(0.0);
        let mut loss = 0.0;
        for (n, f) in self.forces(t, u).into_iter().enumerate() {
            let node = &self.eye.nodes[n];
            if node.region == Region::Orbit {
                continue;
            }
            for (i, f) in f.into_iter().enumerate() {
                let speed = v[2 * n + i];
                dydt[2 * n + i] = speed;
                dydt[count + 2 * n + i] = 1e-3 * (f - node.drag * speed) / node.mass;
                loss += node.drag * speed * speed;
            }
        }
        let power: f64 = self.shares.iter().map(|&(n, x, y)| x * v[2 * n] + y * v[2 * n + 1]).sum();
        dydt[2 * count] = 1e-3 * power * force(self.blow, self.inside, t);
        dydt[2 * count + 1] = 1e-3 * loss;
    }
}

/// Nodes with the weights of the hat around the node at column and row `grid` of the paper's mesh,
/// by the documented rule: of all nodes that move, for forces.
fn hat(eye: &Eye, grid: (usize, usize)) -> Vec<(usize, f64)> {
    let k = f64::from(eye.level);
    let away = |a: usize, b: usize| (a as f64 - k * b as f64).abs() / k;
    (0..eye.nodes.len())
        .filter(|&i| eye.nodes[i].region != Region::Orbit)
        .map(|i| {
            let (column, row) = eye.nodes[i].grid;
            let (u, v) = (away(column, grid.0), away(row, grid.1));
            (i, (1.0 - u).max(0.0) * (1.0 - v).max(0.0))
        })
        .filter(|(_, weight)| *weight > 0.0)
        .collect()
}

/// Mean displacement along x or y over the hat around `grid`, within the globe, by mass, mm.
fn mean(eye: &Eye, grid: (usize, usize), axis: usize, y: &[f64]) -> f64 {
    let (mut sum, mut whole) = (0.0, 0.0);
    for (i, weight) in hat(eye, grid) {
        let node = &eye.nodes[i];
        if !matches!(node.region, Region::Fat) {
            sum += weight * node.mass * y[2 * i + axis];
            whole += weight * node.mass;
        }
    }
    sum / whole
}

/// Length of the closed line through the paper's 36 shell nodes, each the mean of its hat along
/// the shell, mm.
fn shell_length(eye: &Eye, y: &[f64]) -> f64 {
    let angle = |i: usize| {
        let p = eye.nodes[i].position;
        p.y.atan2(p.x).to_degrees()
    };
    let on_shell = |i: &usize| matches!(eye.nodes[*i].region, Region::Shell | Region::Retina);
    let shell: Vec<usize> = (0..eye.nodes.len()).filter(on_shell).collect();
    let corner = |n: usize| {
        let mut mean = [0.0; 2];
        for &i in &shell {
            let away = (angle(i) - (5.0 + 10.0 * n as f64)).rem_euclid(360.0);
            let hops = away.min(360.0 - away) / 10.0;
            let weight = (1.0 - hops).max(0.0) / f64::from(eye.level);
            let p = eye.nodes[i].position;
            mean[0] += weight * (1e3 * p.x + y[2 * i]);
            mean[1] += weight * (1e3 * p.y + y[2 * i + 1]);
        }
        mean
    };
    let corners: Vec<[f64; 2]> = (0..36).map(corner).collect();
    (0..36)
        .map(|n| {
            let (a, b) = (corners[n], corners[(n + 1) % 36]);
            (b[0] - a[0]).hypot(b[1] - a[1])
        })
        .sum()
}

/// What the outside solver found.
struct Outside {
    /// Displacements, speeds, work and loss at each time asked for.
    states: Vec<Vec<f64>>,
    /// Largest component of displacement, mm, and of speed, m/s, of any node at any step end.
    largest: [f64; 2],
    /// Largest |sum w m a| at its own step ends over the hat of each monitored node, N.
    forces: [f64; 4],
    /// Largest mean displacement of the corneal apex at its own step ends, mm.
    apex: f64,
    /// Largest growth of the vertical diameter and of the shell at its own step ends, %.
    growth: [f64; 2],
}

/// Integrates from rest to each of `times` in turn, ms.
fn outside(eye: &Eye, blow: &ForcePulse, times: &[f64]) -> Outside {
    let count = 2 * eye.nodes.len();
    let mut y = vec![0.0; 2 * count + 2];
    let mut found = Outside {
        states: Vec::new(),
        largest: [0.0; 2],
        forces: [0.0; 4],
        apex: 0.0,
        growth: [0.0; 2],
    };
    let monitors = [(8, 8), (3, 8), (12, 8), (8, 12)].map(|grid| hat(eye, grid));
    let rest = shell_length(eye, &y);
    let mut stops: Vec<f64> = times.iter().copied().chain(breaks(blow)).collect();
    stops.sort_by(f64::total_cmp);
    stops.dedup();
    let mut start = 0.0;
    for stop in stops {
        // An edge of no length has its break at the start.
        if stop > start {
            let motion =
                Motion { eye, blow, shares: shares(eye, blow), inside: 0.5 * (start + stop) };
            let method =
                ExplicitRungeKutta::dop853().rtol(TOLERANCE).atol(TOLERANCE).max_steps(1_000_000);
            let solution = IVP::ode(&motion, start, stop, y.clone())
                .method(method)
                .solve()
                .expect("the outside solver finishes");
            assert_eq!(solution.t.last(), Some(&stop));
            let mut slope = vec![0.0; 2 * count + 2];
            for (&t, y) in solution.t.iter().zip(&solution.y) {
                motion.diff(t, y, &mut slope);
                for (largest, of) in found.largest.iter_mut().zip(y.chunks_exact(count)) {
                    *largest = of.iter().fold(*largest, |most, x| most.max(x.abs()));
                }
                for (largest, hat) in found.forces.iter_mut().zip(&monitors) {
                    let mut sum = [0.0; 2];
                    for &(n, weight) in hat {
                        let a = &slope[count + 2 * n..];
                        sum[0] += 1e3 * weight * eye.nodes[n].mass * a[0];
                        sum[1] += 1e3 * weight * eye.nodes[n].mass * a[1];
                    }
                    *largest = largest.max(sum[0].hypot(sum[1]));
                }
                let of = |grid, axis| mean(eye, grid, axis, y);
                found.apex = found.apex.max(0.5 * (of((3, 8), 0) + of((3, 7), 0)));
                let (angle, across) = (5f64.to_radians(), of((8, 12), 0) - of((8, 3), 0));
                let up = of((8, 12), 1) - of((8, 3), 1);
                let diameter = 24.0 * angle.cos();
                let grown = across.hypot(diameter + up) / diameter - 1.0;
                found.growth[0] = found.growth[0].max(100.0 * grown);
                let grown = shell_length(eye, y) / rest - 1.0;
                found.growth[1] = found.growth[1].max(100.0 * grown);
            }
            y.clone_from(solution.y.last().unwrap());
        }
        if times.contains(&stop) {
            found.states.push(y.clone());
        }
        start = stop;
    }
    found
}

/// Differences of positions and speeds from the outside solver's `y`, as shares of the `largest`
/// of the whole motion; differences of work and loss as shares of them.
fn disagreement(case: &PaperCase, plan: &Plan, y: &[f64], largest: [f64; 2]) -> [f64; 4] {
    let mut state = State::at_rest(&case.system);
    march(&case.system, plan, &mut state, |_| ControlFlow::Continue(())).unwrap();
    let count = 2 * case.eye.nodes.len();
    let mut off = [0.0f64; 2];
    for (n, node) in case.eye.nodes.iter().enumerate() {
        let place = case.system.place(n);
        let moved = (state.position(place) - node.position) * 1e3;
        let speed = state.velocity(place);
        for i in 0..2 {
            off[0] = off[0].max((moved[i] - y[2 * n + i]).abs());
            off[1] = off[1].max((speed[i] - y[count + 2 * n + i]).abs());
        }
    }
    [
        off[0] / largest[0],
        off[1] / largest[1],
        (state.work / y[2 * count] - 1.0).abs(),
        (state.dissipated / y[2 * count + 1] - 1.0).abs(),
    ]
}

/// Runs the blow both ways and compares at several times.
fn agrees(name: &str, blow: &ForcePulse, filaments: bool) {
    agrees_at(name, blow, filaments, 1, 3.0);
}

/// The same on the mesh of `level` over `window_ms`.
fn agrees_at(name: &str, blow: &ForcePulse, filaments: bool, level: u32, window_ms: f64) {
    let mut scenario = Scenario {
        impact: Impact::ForcePulse(blow.clone()),
        window_ms: Some(window_ms),
        ..Scenario::default()
    };
    scenario.eye.level = level;
    if !filaments {
        scenario.eye.filament_hops.clear();
    }
    let case = PaperCase::new(&scenario.check().unwrap());
    // Within the pulse, soon after it, and when the motion has died down.
    let last = window_ms;
    let times = [0.37 * blow.duration_ms, 0.31, 0.3 * last, last];
    let found = outside(&case.eye, blow, &times);
    assert_eq!(found.states.len(), times.len());

    let plan = |integrator, step, window_ms: f64| Plan {
        integrator,
        step,
        window: window_ms * 1e-3,
        multiple: 1.0,
        local_tolerance: LOCAL_TOLERANCE,
    };
    let k = f64::from(level);
    for (integrator, step) in [(Integrator::Srkn6b, 2e-7 / k), (Integrator::Srkn11b, 6e-7 / k)] {
        for (time, y) in times.iter().zip(&found.states) {
            let off = disagreement(&case, &plan(integrator, step, *time), y, found.largest);
            println!(
                "{name}, {}, {time:.4} ms: positions {:.1e}, speeds {:.1e}, work {:.1e}, loss {:.1e}",
                integrator.name(),
                off[0],
                off[1],
                off[2],
                off[3]
            );
            for (off, what) in off.into_iter().zip(["positions", "speeds", "work", "loss"]) {
                assert!(
                    off < AGREEMENT,
                    "{name}, {integrator:?}, {time} ms: {what} differ by {off:e}"
                );
            }
        }
    }

    // A whole run: its energy to the same agreement, its peaks no lower than any force seen
    // outside.
    let run = case
        .record(&plan(Integrator::Srkn6b, 2e-7 / k, last), Keep::default(), &mut unwatched)
        .unwrap();
    let extremes = run.extremes;
    let work = found.states[times.len() - 1][4 * case.eye.nodes.len()];
    assert!((extremes.work / work - 1.0).abs() < AGREEMENT);
    let peaks = extremes.force.iter().map(|p| p.value).zip(found.forces);
    let growths = [extremes.meridian_growth, extremes.shell_growth].map(|g| 100.0 * g.value);
    let of_shape = [extremes.apex.value * 1e3, growths[0], growths[1]];
    let seen = [found.apex, found.growth[0], found.growth[1]];
    for (peak, seen) in peaks.chain(of_shape.into_iter().zip(seen)) {
        println!("{name}: peak {peak:.6}, seen outside {seen:.6}");
        let missed = peak - seen;
        assert!(
            missed >= -AGREEMENT * peak && missed <= 1e-2 * peak,
            "{name}: peak {peak} for {seen} seen outside"
        );
    }
}

#[test]
fn the_standard_case() {
    agrees("standard", &ForcePulse::default(), true);
}

#[test]
fn a_triangle_off_the_axis() {
    let blow = ForcePulse {
        force_n: 250.0,
        duration_ms: 0.15,
        angle_deg: 22.0,
        half_width_deg: 12.5,
        shape: PulseShape::Triangle,
    };
    agrees("triangle off axis", &blow, true);
}

#[test]
fn a_recorded_curve_that_waits_jumps_and_rings() {
    let knots = [(0.03, 0.2), (0.05, 1.0), (0.06, 0.7), (0.17, 0.75), (0.2, -0.3), (0.26, 0.1)];
    let mut blow = ForcePulse { force_n: 200.0, ..ForcePulse::default() };
    blow.follow(Curve::new(knots).unwrap());
    blow.duration_ms = 0.24;
    agrees("table", &blow, true);
}

#[test]
fn a_half_sine_without_filaments() {
    let blow = ForcePulse {
        force_n: 120.0,
        duration_ms: 0.25,
        angle_deg: -9.0,
        half_width_deg: 18.0,
        shape: PulseShape::HalfSine,
    };
    agrees("half-sine, no filaments", &blow, false);
}

#[test]
fn a_rectangle_without_rise() {
    let blow = ForcePulse {
        shape: PulseShape::SmoothRectangle { edge_fraction: 0.0 },
        ..ForcePulse::default()
    };
    agrees("rectangle without rise", &blow, true);
}

#[test]
fn a_triangle_off_the_axis_on_the_mesh_of_level_2() {
    let blow = ForcePulse {
        force_n: 220.0,
        duration_ms: 0.12,
        angle_deg: -17.0,
        half_width_deg: 14.0,
        shape: PulseShape::Triangle,
    };
    agrees_at("triangle, level 2", &blow, true, 2, 1.2);
}

#[test]
fn a_half_sine_on_the_mesh_of_level_3() {
    let blow = ForcePulse {
        force_n: 150.0,
        duration_ms: 0.18,
        half_width_deg: 16.0,
        shape: PulseShape::HalfSine,
        ..ForcePulse::default()
    };
    agrees_at("half-sine, level 3", &blow, true, 3, 1.1);
}
