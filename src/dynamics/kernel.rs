//! The force kernel: springs, filaments and load, fused with the update of each node.
//!
//! The force of a spring with ends a and b is k (1 - l0/l) (b - a) on a. One sweep goes through the
//! rows from below. For a vector of neighbouring nodes it computes the four springs that each owns,
//! adds what the row below left, hands the next row its part, and at once kicks and drifts the
//! nodes: nothing above needs their old positions any more.
//!
//! Two forms of 1/l are compiled. The portable one is square root and division without fused
//! multiply-add, which IEEE 754 rounds alike on every machine and at every vector width. The quick
//! one takes 1/sqrt in f32, two directions at a time, and one third-order Newton step to full f64;
//! it is as accurate, but its last bits depend on whether the machine fuses multiply and add.
//!
//! The vectors are `fearless_simd`'s, so the code is safe, and AVX-512, AVX2, SSE2 or NEON is
//! picked at run time.

use super::state::{Scratch, State};
use super::system::{Filaments, Group, LANES, System};
use fearless_simd::{Level, Simd, SimdBase, SimdFloat, SimdNarrow, SimdWiden, dispatch};

/// As many f64 as the machine handles at once.
type V<S> = <S as Simd>::f64s;
/// x and y of as many nodes.
type Pair<S> = (V<S>, V<S>);

/// One kick and one drift of a composition: v += kick a; x += r(v); v *= keep.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Stage {
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
}

#[inline(always)]
fn load<S: Simd>(simd: S, run: &[f64], at: usize) -> V<S> {
    V::<S>::from_slice(simd, &run[at..at + V::<S>::LEN])
}

#[inline(always)]
fn store<S: Simd>(run: &mut [f64], at: usize, value: V<S>) {
    value.store_slice(&mut run[at..at + V::<S>::LEN]);
}

#[inline(always)]
fn load_pair<S: Simd>(simd: S, x: &[f64], y: &[f64], at: usize) -> Pair<S> {
    (load(simd, x, at), load(simd, y, at))
}

#[inline(always)]
fn splat<S: Simd>(simd: S, value: f64) -> V<S> {
    V::<S>::splat(simd, value)
}

#[inline(always)]
fn zeros<S: Simd>(simd: S) -> Pair<S> {
    (splat(simd, 0.0), splat(simd, 0.0))
}

/// a b + c, fused where the quick form may.
#[inline(always)]
fn fused<S: Simd, const QUICK: bool>(a: V<S>, b: V<S>, c: V<S>) -> V<S> {
    if QUICK { a.mul_add(b, c) } else { a * b + c }
}

/// `current` moved up one lane, the last of `before` first.
#[inline(always)]
fn shifted<S: Simd>(before: V<S>, current: V<S>) -> V<S> {
    match V::<S>::LEN {
        8 => before.slide::<7>(current),
        4 => before.slide::<3>(current),
        _ => before.slide::<1>(current),
    }
}

/// Some springs of one direction: from end a to end b, and their length squared.
struct Springs<S: Simd> {
    dx: V<S>,
    dy: V<S>,
    square: V<S>,
}

impl<S: Simd> Springs<S> {
    #[inline(always)]
    fn new<const QUICK: bool>(a: Pair<S>, b: Pair<S>, shortest_squared: V<S>) -> Self {
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        let square = fused::<S, QUICK>(dx, dx, dy * dy).max(shortest_squared);
        Self { dx, dy, square }
    }

    /// Force on end a.
    #[inline(always)]
    fn force<const QUICK: bool>(
        &self,
        inverse_length: V<S>,
        stiffness: V<S>,
        tension: V<S>,
    ) -> Pair<S> {
        let g = fused::<S, QUICK>(-tension, inverse_length, stiffness);
        (g * self.dx, g * self.dy)
    }
}

/// 1/sqrt of two vectors.
#[inline(always)]
fn inverse_roots<S: Simd, const QUICK: bool>(simd: S, a: V<S>, b: V<S>) -> Pair<S> {
    let one = splat(simd, 1.0);
    if !QUICK {
        return (one / a.sqrt(), one / b.sqrt());
    }
    let seed = S::f32s::splat(simd, 1.0) / a.narrow(b).sqrt();
    let (seed_a, seed_b) = seed.widen();
    (polished(simd, a, seed_a), polished(simd, b, seed_b))
}

/// A third-order Newton step: from 24 right bits of 1/sqrt(square) to all 53.
#[inline(always)]
fn polished<S: Simd>(simd: S, square: V<S>, seed: V<S>) -> V<S> {
    let excess = (square * seed).mul_sub(seed, splat(simd, 1.0));
    let bend = excess.mul_add(splat(simd, -0.375), splat(simd, 0.5));
    (-(seed * excess)).mul_add(bend, seed)
}

/// Sums over the springs of a sweep, lane by lane.
struct Sums<S: Simd> {
    elastic: V<S>,
    strain_squared: V<S>,
}

impl<S: Simd> Sums<S> {
    #[inline(always)]
    fn new(simd: S) -> Self {
        Self {
            elastic: splat(simd, 0.0),
            strain_squared: splat(simd, 0.0),
        }
    }

    #[inline(always)]
    fn add<const QUICK: bool>(
        &mut self,
        length: V<S>,
        half_stiffness: V<S>,
        rest: V<S>,
        inverse_rest: V<S>,
    ) {
        let stretch = length - rest;
        let strain = stretch * inverse_rest;
        self.elastic = fused::<S, QUICK>(stretch * stretch, half_stiffness, self.elastic);
        self.strain_squared = self.strain_squared.max(strain * strain);
    }
}

/// Fills the ghost row below a mirrored half.
#[inline(always)]
fn fill_ghosts(system: &System, state: &mut State) {
    if let Some(source) = system.mirror_row {
        let stride = system.stride;
        let (ghost, source) = (system.first_row * stride, source * stride);
        for i in 0..stride {
            state.x[ghost + i] = state.x[source + i];
            state.y[ghost + i] = -state.y[source + i];
        }
    }
}

/// Forces of filaments and load on the shell, into the extra forces.
#[inline(always)]
fn ring_forces<S: Simd, const QUICK: bool, const SURVEY: bool>(
    simd: S,
    system: &System,
    state: &mut State,
    force: f64,
    sums: &mut Sums<S>,
) {
    let ring = &system.ring;
    let s = &mut state.scratch;
    let (x, y): (&[f64], &[f64]) = (&state.x, &state.y);
    let len = ring.gather.len();
    let (ring_x, ring_y) = (&mut s.ring_x[..len], &mut s.ring_y[..len]);
    for ((to_x, to_y), &(slot, sign)) in ring_x.iter_mut().zip(ring_y).zip(&ring.gather) {
        *to_x = x[slot as usize];
        *to_y = sign * y[slot as usize];
    }
    let run = ring.padded_len();
    for (n, filaments) in ring.filaments.iter().enumerate() {
        filament_forces::<S, QUICK, SURVEY>(simd, system, filaments, n * run, s, sums);
    }
    // Each run of forces is complete before any is read: reading what has just been written at
    // another alignment would wait for it.
    for o in (0..ring.owned).step_by(V::<S>::LEN) {
        let mut sum = zeros(simd);
        for (n, filaments) in ring.filaments.iter().enumerate() {
            let on_a = n * run + ring.ghosts + o;
            let pulled = load_pair(simd, &s.hop_fx, &s.hop_fy, on_a);
            let pulling = load_pair(simd, &s.hop_fx, &s.hop_fy, on_a - filaments.hop);
            sum = (
                sum.0 + (pulled.0 - pulling.0),
                sum.1 + (pulled.1 - pulling.1),
            );
        }
        store::<S>(&mut s.ring_fx, o, sum.0);
        store::<S>(&mut s.ring_fy, o, sum.1);
    }
    let owned = &ring.gather[ring.ghosts..ring.ghosts + ring.owned];
    let (extra_x, extra_y): (&mut [f64], &mut [f64]) = (&mut s.extra_x, &mut s.extra_y);
    let (ring_fx, ring_fy) = (&s.ring_fx[..ring.owned], &s.ring_fy[..ring.owned]);
    for ((&(slot, _), fx), fy) in owned.iter().zip(ring_fx).zip(ring_fy) {
        extra_x[slot as usize] = *fx;
        extra_y[slot as usize] = *fy;
    }
    for &(slot, px, py) in &system.load().shares {
        extra_x[slot] += px * force;
        extra_y[slot] += py * force;
    }
}

/// Forces of the filaments of one hop count on their first ends, into the run that starts at `into`.
#[inline(always)]
fn filament_forces<S: Simd, const QUICK: bool, const SURVEY: bool>(
    simd: S,
    system: &System,
    f: &Filaments,
    into: usize,
    s: &mut Scratch,
    sums: &mut Sums<S>,
) {
    let shortest = splat(simd, system.shortest_squared);
    let width = V::<S>::LEN;
    let (ring_x, ring_y): (&[f64], &[f64]) = (&s.ring_x, &s.ring_y);
    let (hop_fx, hop_fy): (&mut [f64], &mut [f64]) = (&mut s.hop_fx, &mut s.hop_fy);
    // Two vectors at a time, as the inverse roots come in pairs; the runs are padded to suit.
    for o in (0..f.stiffness.len()).step_by(2 * width) {
        let springs = [o, o + width].map(|o| {
            let a = f.first + o;
            Springs::<S>::new::<QUICK>(
                load_pair(simd, ring_x, ring_y, a),
                load_pair(simd, ring_x, ring_y, a + f.hop),
                shortest,
            )
        });
        let inverse = inverse_roots::<S, QUICK>(simd, springs[0].square, springs[1].square);
        for (n, inverse) in [inverse.0, inverse.1].into_iter().enumerate() {
            let o = o + n * width;
            let (stiffness, tension) = (load(simd, &f.stiffness, o), load(simd, &f.tension, o));
            let (fx, fy) = springs[n].force::<QUICK>(inverse, stiffness, tension);
            if SURVEY {
                sums.add::<QUICK>(
                    springs[n].square * inverse,
                    load(simd, &f.half_stiffness, o),
                    load(simd, &f.rest, o),
                    load(simd, &f.inverse_rest, o),
                );
            }
            store::<S>(hop_fx, into + f.first + o, fx);
            store::<S>(hop_fy, into + f.first + o, fy);
        }
    }
}

/// What an update may read and write of the nodes that start at `slot`.
struct Nodes<'a, S: Simd> {
    simd: S,
    slot: usize,
    /// Place of the first node in its group.
    lane: usize,
    group: &'a Group,
    position: Pair<S>,
    vx: &'a mut [f64],
    vy: &'a mut [f64],
    ax: &'a mut [f64],
    ay: &'a mut [f64],
}

/// What a sweep does with the force on some nodes; returns their new positions.
trait Update<S: Simd> {
    fn nodes(&mut self, nodes: Nodes<'_, S>, force: Pair<S>) -> Pair<S>;
}

/// Goes through all springs and gives `update` the force on each vector of nodes. When `MOVE`, what
/// `update` returns becomes their position.
#[inline(always)]
fn sweep<S: Simd, const QUICK: bool, const SURVEY: bool, const MOVE: bool>(
    simd: S,
    system: &System,
    state: &mut State,
    sums: &mut Sums<S>,
    update: &mut impl Update<S>,
) {
    let stride = system.stride;
    let width = V::<S>::LEN;
    let shortest = splat(simd, system.shortest_squared);
    let State {
        x,
        y,
        vx,
        vy,
        ax,
        ay,
        scratch,
        ..
    } = state;
    let (up_x, up_y) = (&mut scratch.up_x[..stride], &mut scratch.up_y[..stride]);
    up_x.fill(0.0);
    up_y.fill(0.0);
    // Borrowed once: reached through the state, each would be looked up anew for every vector.
    let (x, y): (&mut [f64], &mut [f64]) = (x, y);
    let (vx, vy): (&mut [f64], &mut [f64]) = (vx, vy);
    let (ax, ay): (&mut [f64], &mut [f64]) = (ax, ay);
    let (extra_x, extra_y): (&[f64], &[f64]) = (&scratch.extra_x, &scratch.extra_y);
    for row in system.first_row..system.side - 1 {
        let base = row * stride;
        let groups = &system.groups[base / LANES..(base + stride) / LANES];
        let surveys = &system.survey[base / LANES..(base + stride) / LANES];
        let x = &mut x[base..base + 2 * stride + 1];
        let y = &mut y[base..base + 2 * stride + 1];
        let own = base..base + stride;
        let (vx, vy) = (&mut vx[own.clone()], &mut vy[own.clone()]);
        let (ax, ay) = (&mut ax[own.clone()], &mut ay[own.clone()]);
        let (extra_x, extra_y) = (&extra_x[own.clone()], &extra_y[own]);
        let mut across = zeros(simd);
        let mut rising = zeros(simd);
        for o in (0..stride).step_by(width) {
            let (group, survey, lane) = (&groups[o / LANES], &surveys[o / LANES], o % LANES);
            let here = load_pair(simd, x, y, o);
            let right = load_pair(simd, x, y, o + 1);
            let above = load_pair(simd, x, y, o + stride);
            let above_right = load_pair(simd, x, y, o + stride + 1);
            let springs = [
                Springs::<S>::new::<QUICK>(here, right, shortest),
                Springs::<S>::new::<QUICK>(here, above, shortest),
                Springs::<S>::new::<QUICK>(here, above_right, shortest),
                Springs::<S>::new::<QUICK>(above, right, shortest),
            ];
            let first = inverse_roots::<S, QUICK>(simd, springs[0].square, springs[1].square);
            let second = inverse_roots::<S, QUICK>(simd, springs[2].square, springs[3].square);
            let inverse = [first.0, first.1, second.0, second.1];
            let mut forces = [zeros(simd); 4];
            for d in 0..4 {
                let stiffness = load(simd, &group.stiffness[d], lane);
                let tension = load(simd, &group.tension[d], lane);
                forces[d] = springs[d].force::<QUICK>(inverse[d], stiffness, tension);
                if SURVEY {
                    sums.add::<QUICK>(
                        springs[d].square * inverse[d],
                        load(simd, &survey.half_stiffness[d], lane),
                        load(simd, &survey.rest[d], lane),
                        load(simd, &survey.inverse_rest[d], lane),
                    );
                }
            }
            let [to_right, to_above, to_corner, from_above] = forces;
            // Springs whose far end is one node to the right of here, and of above.
            let onto_right = (to_right.0 + from_above.0, to_right.1 + from_above.1);
            let from_left = (
                shifted::<S>(across.0, onto_right.0),
                shifted::<S>(across.1, onto_right.1),
            );
            let from_corner = (
                shifted::<S>(rising.0, to_corner.0),
                shifted::<S>(rising.1, to_corner.1),
            );
            (across, rising) = (onto_right, to_corner);

            let below = load_pair(simd, up_x, up_y, o);
            let extra = load_pair(simd, extra_x, extra_y, o);
            let force = (
                ((to_right.0 + to_above.0) + (to_corner.0 - from_left.0)) + (below.0 + extra.0),
                ((to_right.1 + to_above.1) + (to_corner.1 - from_left.1)) + (below.1 + extra.1),
            );
            store::<S>(up_x, o, (from_above.0 - to_above.0) - from_corner.0);
            store::<S>(up_y, o, (from_above.1 - to_above.1) - from_corner.1);

            let nodes = Nodes {
                simd,
                slot: o,
                lane,
                group,
                position: here,
                vx,
                vy,
                ax,
                ay,
            };
            let moved = update.nodes(nodes, force);
            if MOVE {
                store::<S>(x, o, moved.0);
                store::<S>(y, o, moved.1);
            }
        }
    }
}

/// Two numbers, for globe and fat, spread over nodes.
#[inline(always)]
fn by_tissue<S: Simd, const QUICK: bool>(simd: S, fat: V<S>, of: [f64; 2]) -> V<S> {
    fused::<S, QUICK>(splat(simd, of[1] - of[0]), fat, splat(simd, of[0]))
}

/// The drift of some nodes: new positions are returned, new velocities stored, and the energy that
/// drag takes is added to `loss`.
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
    let (vx, vy) = velocity;
    let speed_squared = fused::<S, QUICK>(vx, vx, vy * vy);
    let lost = fused::<S, QUICK>(-keep, keep, splat(simd, 1.0)) * half_mass;
    *loss = fused::<S, QUICK>(speed_squared, lost, *loss);
    store::<S>(nodes.vx, nodes.slot, vx * keep);
    store::<S>(nodes.vy, nodes.slot, vy * keep);
    (
        fused::<S, QUICK>(reach, vx, nodes.position.0),
        fused::<S, QUICK>(reach, vy, nodes.position.1),
    )
}

struct KickDrift<S: Simd, const QUICK: bool> {
    stage: Stage,
    loss: V<S>,
}

impl<S: Simd, const QUICK: bool> Update<S> for KickDrift<S, QUICK> {
    #[inline(always)]
    fn nodes(&mut self, nodes: Nodes<'_, S>, force: Pair<S>) -> Pair<S> {
        let simd = nodes.simd;
        let inverse_mass = load(simd, &nodes.group.inverse_mass, nodes.lane);
        let w = inverse_mass * self.stage.kick;
        let before = load_pair(simd, nodes.vx, nodes.vy, nodes.slot);
        let velocity = (
            fused::<S, QUICK>(force.0, w, before.0),
            fused::<S, QUICK>(force.1, w, before.1),
        );
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
        let kick = splat(simd, self.kick);
        let (ax, ay) = (force.0 * inverse_mass, force.1 * inverse_mass);
        let before = load_pair(simd, nodes.vx, nodes.vy, nodes.slot);
        let vx = fused::<S, QUICK>(ax, kick, before.0);
        let vy = fused::<S, QUICK>(ay, kick, before.1);
        let speed_squared = fused::<S, QUICK>(vx, vx, vy * vy);
        self.kinetic = fused::<S, QUICK>(speed_squared, half_mass, self.kinetic);
        store::<S>(nodes.ax, nodes.slot, ax);
        store::<S>(nodes.ay, nodes.slot, ay);
        store::<S>(nodes.vx, nodes.slot, vx);
        store::<S>(nodes.vy, nodes.slot, vy);
        nodes.position
    }
}

fn total<S: Simd>(lanes: V<S>) -> f64 {
    lanes.as_slice().iter().sum()
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
    let mut update = KickDrift::<S, QUICK> {
        stage,
        loss: splat(simd, 0.0),
    };
    sweep::<S, QUICK, false, true>(simd, system, state, &mut sums, &mut update);
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
    let (first, last) = (
        system.first_row * system.stride,
        (system.side - 1) * system.stride,
    );
    let (x, y): (&mut [f64], &mut [f64]) = (&mut state.x, &mut state.y);
    let (vx, vy): (&mut [f64], &mut [f64]) = (&mut state.vx, &mut state.vy);
    let (ax, ay): (&mut [f64], &mut [f64]) = (&mut state.ax, &mut state.ay);
    for slot in (first..last).step_by(V::<S>::LEN) {
        let (group, lane) = (&system.groups[slot / LANES], slot % LANES);
        let before = load_pair(simd, vx, vy, slot);
        let a = load_pair(simd, ax, ay, slot);
        let fat = load(simd, &group.fat, lane);
        let half_mass = load(simd, &group.half_mass, lane);
        let kick = splat(simd, stage.kick);
        let keep = by_tissue::<S, QUICK>(simd, fat, keep_before);
        let after = (
            fused::<S, QUICK>(a.0, kick, before.0 * keep),
            fused::<S, QUICK>(a.1, kick, before.1 * keep),
        );
        // An explicit drag acts with the kick: its power goes with the mean of the two speeds.
        let along = before.0 * (before.0 + after.0) + before.1 * (before.1 + after.1);
        loss += (splat(simd, 1.0) - keep) * half_mass * along;
        let nodes = Nodes {
            simd,
            slot,
            lane,
            group,
            position: load_pair(simd, x, y, slot),
            vx,
            vy,
            ax,
            ay,
        };
        let moved = drift::<S, QUICK>(stage, nodes, after, &mut loss);
        store::<S>(x, slot, moved.0);
        store::<S>(y, slot, moved.1);
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
    let mut update = Keep::<S, QUICK> {
        kick,
        kinetic: splat(simd, 0.0),
    };
    sweep::<S, QUICK, true, false>(simd, system, state, &mut sums, &mut update);
    let strain_squared = sums.strain_squared.as_slice().iter().copied();
    Survey {
        elastic: total::<S>(sums.elastic),
        kinetic: total::<S>(update.kinetic),
        strain: strain_squared.fold(0.0, f64::max).sqrt(),
        quad_ratio: smallest_quad(simd, system, state),
    }
}

/// Smallest ratio of a quad's signed area, half the cross product of its diagonals, to its area
/// at rest.
#[inline(always)]
fn smallest_quad<S: Simd>(simd: S, system: &System, state: &State) -> f64 {
    let stride = system.stride;
    let mut least = splat(simd, f64::INFINITY);
    let (x, y): (&[f64], &[f64]) = (&state.x, &state.y);
    let (first, last) = (system.first_row * stride, (system.side - 1) * stride);
    for o in (first..last).step_by(V::<S>::LEN) {
        let (survey, lane) = (&system.survey[o / LANES], o % LANES);
        let p = load_pair(simd, x, y, o);
        let r = load_pair(simd, x, y, o + 1);
        let u = load_pair(simd, x, y, o + stride);
        let q = load_pair(simd, x, y, o + stride + 1);
        let cross = (q.0 - p.0) * (u.1 - r.1) - (q.1 - p.1) * (u.0 - r.0);
        let inverse = load(simd, &survey.inverse_area, lane);
        least = least.min(cross * inverse + load(simd, &survey.no_quad, lane));
    }
    least
        .as_slice()
        .iter()
        .copied()
        .fold(f64::INFINITY, f64::min)
}

/// Force, kick and drift in one sweep; returns the energy that drag took, in J.
pub(super) fn kick_drift(system: &System, state: &mut State, force: f64, stage: Stage) -> f64 {
    let level = Level::new();
    if system.portable {
        dispatch!(level, simd => kick_drift_as::<_, false>(simd, system, state, force, stage))
    } else {
        dispatch!(level, simd => kick_drift_as::<_, true>(simd, system, state, force, stage))
    }
}

/// Explicit drag, kick by the stored acceleration, and drift; returns the energy lost, in J.
pub(super) fn start(
    system: &System,
    state: &mut State,
    keep_before: [f64; 2],
    stage: Stage,
) -> f64 {
    let level = Level::new();
    if system.portable {
        dispatch!(level, simd => start_as::<_, false>(simd, system, state, keep_before, stage))
    } else {
        dispatch!(level, simd => start_as::<_, true>(simd, system, state, keep_before, stage))
    }
}

/// Force evaluation at the state's positions into its acceleration, then v += kick a, with a
/// survey of the whole mesh.
pub(super) fn evaluate(system: &System, state: &mut State, force: f64, kick: f64) -> Survey {
    let level = Level::new();
    if system.portable {
        dispatch!(level, simd => evaluate_as::<_, false>(simd, system, state, force, kick))
    } else {
        dispatch!(level, simd => evaluate_as::<_, true>(simd, system, state, force, kick))
    }
}

/// Name of the kernel that this machine runs.
pub fn name(portable: bool) -> String {
    let level = format!("{:?}", Level::new());
    let level = level.split('(').next().unwrap_or(&level).to_lowercase();
    let form = if portable {
        "sqrt and division"
    } else {
        "f32 seed and Newton"
    };
    format!("{level}, {form}")
}
