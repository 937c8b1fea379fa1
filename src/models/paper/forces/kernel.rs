//! The force kernel: springs, filaments and load, fused with the update of each node.
//!
//! The force of a spring with ends a and b is k (1 - l0/l) (b - a) on a. The ring goes first, as
//! it needs all shell nodes where they are; then one sweep computes the grid springs and at once
//! kicks and drifts the nodes.
//!
//! Two forms of 1/l are compiled. The portable one is square root and division without fused
//! multiply-add, which IEEE 754 rounds alike on every machine and at every vector width. The quick
//! one fuses and, on AVX-512, takes 14 bits of 1/sqrt from an instruction and the rest from a
//! series, on AVX2 so for half of the springs; it is as accurate, but its last bits depend on the
//! machine.

use crate::models::paper::forces::filaments::{ring_forces, shell_length};
use crate::models::paper::forces::lanes::{
    self, Pair, Sums, V, fused, fused_pair, load, load_pair, on_vectors, splat, squared,
    store_pair, times, total,
};
use crate::models::paper::forces::layout::{DIRECTIONS, LANES, SHIFT};
use crate::models::paper::forces::sweep::{Nodes, Update, sweep};
use crate::models::paper::forces::{state::State, system::System};
use crate::models::pulse::Piece;
use fearless_simd::{Level, Simd, SimdBase, dispatch};

/// One kick and one drift of a composition: v += kick a; x += r(v); v *= keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stage {
    /// Multiplies acceleration, s.
    pub kick: f64,
    /// Distance per speed in globe and fat, s.
    pub drift: [f64; 2],
    /// Share of the speed that is left after the drift, in globe and fat.
    pub keep: [f64; 2],
}

/// What the state of the whole mesh is at the end of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Survey {
    /// Elastic energy, J.
    pub elastic: f64,
    /// Kinetic energy, J.
    pub kinetic: f64,
    /// Largest |l/l0 - 1|.
    pub strain: f64,
    /// Smallest ratio of a quad's signed area to its area at rest.
    pub quad_ratio: f64,
    /// Length of the closed shell, m.
    pub shell_length: f64,
}

/// Fills the ghost row below a mirrored half.
#[inline(always)]
fn fill_ghosts(system: &System, state: &mut State) {
    if let Some(source) = system.rows.mirror {
        let stride = system.rows.stride;
        let (ghost, source) = (system.rows.first * stride + SHIFT, source * stride + SHIFT);
        state.position.x.copy_within(source..source + stride, ghost);
        let (below, above) = state.position.y.split_at_mut(source);
        for (image, y) in below[ghost..].iter_mut().zip(&above[..stride]) {
            *image = -y;
        }
    }
}

/// Two numbers, for globe and fat, spread over nodes.
#[inline(always)]
pub(crate) fn by_tissue<S: Simd, const QUICK: bool>(simd: S, fat: V<S>, of: [f64; 2]) -> V<S> {
    fused::<S, QUICK>(splat(simd, of[1] - of[0]), fat, splat(simd, of[0]))
}

/// The drift of some nodes: new positions are returned, new velocities stored, and the energy that
/// drag takes is added to `loss`.
#[allow(clippy::needless_pass_by_value, reason = "it holds the only borrows of the nodes")]
#[inline(always)]
fn drift<S: Simd, const QUICK: bool>(
    stage: Stage,
    nodes: Nodes<'_, S>,
    velocity: Pair<S>,
    loss: &mut V<S>,
) -> Pair<S> {
    let simd = nodes.simd;
    let fat = load(simd, &nodes.group.fat, nodes.lane);
    let half_mass = load(simd, &nodes.group.half_mass, nodes.lane);
    let reach = by_tissue::<S, QUICK>(simd, fat, stage.drift);
    let keep = by_tissue::<S, QUICK>(simd, fat, stage.keep);
    let lost = fused::<S, QUICK>(-keep, keep, splat(simd, 1.0)) * half_mass;
    *loss = fused::<S, QUICK>(squared::<S, QUICK>(velocity), lost, *loss);
    store_pair::<S>(nodes.velocity, 0, times::<S>(velocity, keep));
    fused_pair::<S, QUICK>(velocity, reach, nodes.position)
}

struct KickDrift<S: Simd, const QUICK: bool> {
    stage: Stage,
    loss: V<S>,
}

impl<S: Simd, const QUICK: bool> Update<S> for KickDrift<S, QUICK> {
    #[inline(always)]
    fn nodes(&mut self, nodes: Nodes<'_, S>, force: Pair<S>) -> Pair<S> {
        let inverse_mass = load(nodes.simd, &nodes.group.inverse_mass, nodes.lane);
        let before = nodes.speeds();
        let velocity = fused_pair::<S, QUICK>(force, inverse_mass * self.stage.kick, before);
        drift::<S, QUICK>(self.stage, nodes, velocity, &mut self.loss)
    }
}

struct Keep<S: Simd, const QUICK: bool> {
    kick: f64,
    kinetic: V<S>,
}

impl<S: Simd, const QUICK: bool> Update<S> for Keep<S, QUICK> {
    #[inline(always)]
    fn nodes(&mut self, nodes: Nodes<'_, S>, force: Pair<S>) -> Pair<S> {
        let simd = nodes.simd;
        let inverse_mass = load(simd, &nodes.group.inverse_mass, nodes.lane);
        let half_mass = load(simd, &nodes.group.half_mass, nodes.lane);
        let acceleration = times::<S>(force, inverse_mass);
        let velocity = fused_pair::<S, QUICK>(acceleration, splat(simd, self.kick), nodes.speeds());
        let speed_squared = squared::<S, QUICK>(velocity);
        self.kinetic = fused::<S, QUICK>(speed_squared, half_mass, self.kinetic);
        store_pair::<S>(nodes.acceleration, 0, acceleration);
        store_pair::<S>(nodes.velocity, 0, velocity);
        nodes.position
    }
}

#[inline(always)]
fn kick_drift_as<S: Simd, const QUICK: bool>(
    simd: S,
    system: &System,
    state: &mut State,
    force: f64,
    stage: Stage,
) -> f64 {
    let mut sums = Sums::new(simd);
    fill_ghosts(system, state);
    ring_forces::<S, QUICK, false>(simd, system, state, force, &mut sums);
    let mut update = KickDrift::<S, QUICK> { stage, loss: splat(simd, 0.0) };
    sweep::<S, QUICK, false>(simd, system, state, &mut sums, &mut update);
    total::<S>(update.loss)
}

#[inline(always)]
fn start_as<S: Simd, const QUICK: bool>(
    simd: S,
    system: &System,
    state: &mut State,
    keep_before: [f64; 2],
    stage: Stage,
) -> f64 {
    let mut loss = splat(simd, 0.0);
    let (x, y) = state.position.slices_mut();
    let (vx, vy) = state.velocity.slices_mut();
    let (ax, ay) = state.acceleration.slices_mut();
    for slot in system.moving().step_by(V::<S>::LEN) {
        let (group, lane) = (&system.groups[slot / LANES], slot % LANES);
        let before = load_pair(simd, (vx, vy), slot);
        let acceleration = load_pair(simd, (ax, ay), slot);
        let fat = load(simd, &group.fat, lane);
        let half_mass = load(simd, &group.half_mass, lane);
        let kick = splat(simd, stage.kick);
        let keep = by_tissue::<S, QUICK>(simd, fat, keep_before);
        let after = fused_pair::<S, QUICK>(acceleration, kick, times::<S>(before, keep));
        // An explicit drag acts with the kick: its power goes with the mean of the two speeds.
        let along = before.0 * (before.0 + after.0) + before.1 * (before.1 + after.1);
        loss += (splat(simd, 1.0) - keep) * half_mass * along;
        let here = slot..slot + V::<S>::LEN;
        let nodes = Nodes {
            simd,
            lane,
            group,
            position: load_pair(simd, (x, y), slot),
            velocity: (&mut vx[here.clone()], &mut vy[here.clone()]),
            acceleration: (&mut ax[here.clone()], &mut ay[here]),
        };
        let moved = drift::<S, QUICK>(stage, nodes, after, &mut loss);
        store_pair::<S>((x, y), slot, moved);
    }
    total::<S>(loss)
}

#[inline(always)]
fn evaluate_as<S: Simd, const QUICK: bool>(
    simd: S,
    system: &System,
    state: &mut State,
    force: f64,
    kick: f64,
) -> Survey {
    let mut sums = Sums::new(simd);
    fill_ghosts(system, state);
    ring_forces::<S, QUICK, true>(simd, system, state, force, &mut sums);
    let mut update = Keep::<S, QUICK> { kick, kinetic: splat(simd, 0.0) };
    sweep::<S, QUICK, true>(simd, system, state, &mut sums, &mut update);
    let strain_squared = sums.strain_squared.as_slice().iter().copied();
    let quad_ratio = sums.quad_ratio.as_slice().iter().copied();
    Survey {
        elastic: total::<S>(sums.elastic),
        kinetic: total::<S>(update.kinetic),
        strain: strain_squared.fold(0.0, f64::max).sqrt(),
        quad_ratio: quad_ratio.fold(f64::INFINITY, f64::min),
        shell_length: shell_length::<S, QUICK>(simd, system, state),
    }
}

/// Force, kick and drift in one sweep; returns the energy that drag took, in J.
pub(crate) fn kick_drift(system: &System, state: &mut State, force: f64, stage: Stage) -> f64 {
    on_vectors!(system, kick_drift_as(system, state, force, stage))
}

/// Explicit drag, kick by the stored acceleration, and drift; returns the energy lost, in J.
pub(crate) fn start(system: &System, state: &mut State, keep: [f64; 2], stage: Stage) -> f64 {
    on_vectors!(system, start_as(system, state, keep, stage))
}

/// Evaluates the acceleration at the positions, then v += kick a; surveys the whole mesh.
pub(crate) fn evaluate(system: &System, state: &mut State, force: f64, kick: f64) -> Survey {
    on_vectors!(system, evaluate_as(system, state, force, kick))
}

impl State {
    /// Brings the acceleration up to date by the load law `piece`.
    pub fn evaluate(&mut self, system: &System, piece: Piece) -> Survey {
        let force = system.pulse.force(piece, self.time);
        evaluate(system, self, force, 0.0)
    }
}

/// Name of the kernel that this machine runs.
pub fn name(portable: bool) -> String {
    let level = Level::new();
    let by_seeds = dispatch!(level, simd => lanes::by_seeds(simd));
    let form = match (portable, by_seeds) {
        (true, _) => "sqrt and division",
        (false, 0) => "fused, sqrt and division",
        (false, DIRECTIONS) => "fused, 14-bit seed and series",
        (false, _) => "fused, half by 11-bit seed and series",
    };
    format!("{}, {form}", vectors_name(level))
}

/// Name of a set of vectors.
pub fn vectors_name(level: Level) -> String {
    let level = format!("{level:?}");
    level.split('(').next().unwrap_or(&level).to_lowercase()
}

/// Every set of vectors that this machine has, from the narrowest; a [`System`] takes the last.
pub fn vector_sets() -> Vec<Level> {
    let best = Level::new();
    #[cfg(target_arch = "x86_64")]
    let lesser = [best.as_sse2().map(Level::Sse2), best.as_avx2().map(Level::Avx2)];
    #[cfg(not(target_arch = "x86_64"))]
    let lesser = [None, None];
    let width = |level: Level| dispatch!(level, simd => lanes::width(simd));
    let mut sets: Vec<Level> = lesser.into_iter().flatten().collect();
    sets.retain(|&level| width(level) < width(best));
    sets.push(best);
    sets
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::models::paper::case::PaperCase;
    use crate::scenario::Scenario;

    fn system(scenario: &Scenario, whole: bool, portable: bool) -> System {
        PaperCase::with(&scenario.check().unwrap(), whole, portable).system
    }

    fn moved(level: Level, eye_level: u32, whole: bool, portable: bool) -> (State, Survey) {
        let mut scenario = Scenario::default();
        scenario.eye.level = eye_level;
        let mut system = system(&scenario, whole, portable);
        system.set_level(level);
        let mut state = State::at_rest(&system);
        let h = 0.5 / system.omega_bound;
        let stage = Stage { kick: h, drift: [h, 0.9 * h], keep: [0.99, 0.98] };
        for _ in 0..100 {
            kick_drift(&system, &mut state, 300.0, stage);
        }
        let survey = evaluate(&system, &mut state, 300.0, h);
        (state, survey)
    }

    #[test]
    fn vectors_of_every_width_move_the_eye_alike() {
        for (eye_level, whole) in [(1, true), (1, false), (2, false), (3, true)] {
            let (narrow, survey) = moved(vector_sets()[0], eye_level, whole, true);
            for level in vector_sets() {
                let (state, _) = moved(level, eye_level, whole, true);
                let runs = |of: &State| {
                    [&of.position.x, &of.velocity.y, &of.acceleration.y].map(|run| run.to_vec())
                };
                assert_eq!(runs(&narrow), runs(&state), "portable, {level:?}");
                let (quick, quick_survey) = moved(level, eye_level, whole, false);
                for (a, b) in narrow.position.x.iter().zip(&quick.position.x[..]) {
                    assert!((a - b).abs() < 1e-14, "quick, {level:?}: {a} {b}");
                }
                let ratio = quick_survey.elastic / survey.elastic;
                assert!((ratio - 1.0).abs() < 1e-10, "quick, {level:?}: {ratio}");
            }
        }
    }

    #[test]
    fn without_filaments_the_load_does_not_pile_up() {
        let mut scenario = Scenario::default();
        scenario.eye.filament_factor = 0.0;
        let system = system(&scenario, true, false);
        let mut state = State::at_rest(&system);
        evaluate(&system, &mut state, 100.0, 0.0);
        let once = state.acceleration.x.clone();
        evaluate(&system, &mut state, 100.0, 0.0);
        assert_eq!(once[..], state.acceleration.x[..]);
    }
}
