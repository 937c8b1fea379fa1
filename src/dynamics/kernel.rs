//! The force kernel: springs, filaments and load, fused with the update of each node.
//!
//! The force of a spring with ends a and b is k (1 - l0/l) (b - a) on a. One sweep goes through the
//! rows from below. For eight nodes at a time it computes the four springs that each owns, adds what
//! the row below left, hands the next row its part, and at once kicks and drifts the eight nodes:
//! nothing above needs their old positions any more.
//!
//! Two forms of 1/l are compiled. The portable one is sqrt and division, which IEEE 754 rounds
//! alike on every machine. Where there is FMA, the quick one takes 1/sqrt in f32 (24 bits, two fast
//! instructions) and one third-order Newton step to full f64; it is as accurate, but its last bits
//! differ from the portable form's.
//!
//! Everything is safe code in fixed-size arrays, which the compiler turns into AVX-512, AVX2 or
//! baseline vectors; `multiversion` picks at run time.

use super::state::State;
use super::system::{DIRECTIONS, Filaments, Group, LANES, Lane, System};
use multiversion::{multiversion, target::target_cfg_f};

/// One kick and one drift of a composition: v += kick a; x += r(v); v *= decay.
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
fn load_lane(run: &[f64], at: usize) -> Lane {
    let mut lane = [0.0; LANES];
    lane.copy_from_slice(&run[at..at + LANES]);
    lane
}

#[inline(always)]
fn store_lane(run: &mut [f64], at: usize, lane: Lane) {
    run[at..at + LANES].copy_from_slice(&lane);
}

/// `current` moved up one lane, the last of `before` first.
#[inline(always)]
fn shifted(before: Lane, current: Lane) -> Lane {
    let mut out = current;
    let mut i = 1;
    while i < LANES {
        out[i] = current[i - 1];
        i += 1;
    }
    out[0] = before[LANES - 1];
    out
}

/// Force on end a of eight springs, and their lengths.
#[inline(always)]
fn springs<const QUICK: bool>(
    (ax, ay): (Lane, Lane),
    (bx, by): (Lane, Lane),
    stiffness: &Lane,
    tension: &Lane,
    shortest_squared: f64,
) -> (Lane, Lane, Lane) {
    let (mut dx, mut dy) = ([0.0; LANES], [0.0; LANES]);
    let (mut fx, mut fy) = ([0.0; LANES], [0.0; LANES]);
    let (mut square, mut length) = ([0.0; LANES], [0.0; LANES]);
    for i in 0..LANES {
        dx[i] = bx[i] - ax[i];
        dy[i] = by[i] - ay[i];
    }
    if QUICK {
        let mut inverse = [0.0; LANES];
        let mut seed = [0.0f32; LANES];
        for i in 0..LANES {
            let q = dx[i].mul_add(dx[i], dy[i] * dy[i]);
            square[i] = if q < shortest_squared { shortest_squared } else { q };
        }
        for i in 0..LANES {
            seed[i] = square[i] as f32;
        }
        for i in 0..LANES {
            seed[i] = 1.0 / seed[i].sqrt();
        }
        for i in 0..LANES {
            inverse[i] = f64::from(seed[i]);
        }
        for i in 0..LANES {
            let r = (-(square[i] * inverse[i])).mul_add(inverse[i], 1.0);
            inverse[i] = (inverse[i] * r).mul_add(r.mul_add(0.375, 0.5), inverse[i]);
        }
        for i in 0..LANES {
            length[i] = square[i] * inverse[i];
            let g = (-tension[i]).mul_add(inverse[i], stiffness[i]);
            fx[i] = g * dx[i];
            fy[i] = g * dy[i];
        }
    } else {
        for i in 0..LANES {
            let q = dx[i] * dx[i] + dy[i] * dy[i];
            square[i] = if q < shortest_squared { shortest_squared } else { q };
        }
        for i in 0..LANES {
            length[i] = square[i].sqrt();
            let g = stiffness[i] - tension[i] / length[i];
            fx[i] = g * dx[i];
            fy[i] = g * dy[i];
        }
    }
    (fx, fy, length)
}

/// The springs of one direction.
#[inline(always)]
fn grid_springs<const QUICK: bool>(
    group: &Group,
    direction: usize,
    a: (Lane, Lane),
    b: (Lane, Lane),
    shortest_squared: f64,
) -> (Lane, Lane, Lane) {
    springs::<QUICK>(
        a,
        b,
        &group.stiffness[direction],
        &group.tension[direction],
        shortest_squared,
    )
}

#[inline(always)]
fn fused<const QUICK: bool>(a: f64, b: f64, c: f64) -> f64 {
    if QUICK { a.mul_add(b, c) } else { a * b + c }
}

/// Sums over the springs of a sweep, lane by lane.
struct Sums {
    elastic: Lane,
    strain_squared: Lane,
}

impl Sums {
    #[inline(always)]
    fn add<const QUICK: bool>(
        &mut self,
        length: Lane,
        half_stiffness: &Lane,
        rest: &Lane,
        inverse_rest: &Lane,
    ) {
        for i in 0..LANES {
            let stretch = length[i] - rest[i];
            let strain = stretch * inverse_rest[i];
            self.elastic[i] = fused::<QUICK>(stretch * stretch, half_stiffness[i], self.elastic[i]);
            let squared = strain * strain;
            self.strain_squared[i] = if squared > self.strain_squared[i] {
                squared
            } else {
                self.strain_squared[i]
            };
        }
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
fn ring_forces<const QUICK: bool, const SURVEY: bool>(
    system: &System,
    state: &mut State,
    force: f64,
    sums: &mut Sums,
) {
    let ring = &system.ring;
    let s = &mut state.scratch;
    for (g, &(slot, sign)) in ring.gather.iter().enumerate() {
        s.ring_x[g] = state.x[slot as usize];
        s.ring_y[g] = sign * state.y[slot as usize];
    }
    s.ring_fx.fill(0.0);
    s.ring_fy.fill(0.0);
    for f in &ring.filaments {
        filament_forces::<QUICK, SURVEY>(system, f, s, sums);
    }
    for n in 0..ring.owned {
        let g = ring.ghosts + n;
        let slot = ring.gather[g].0 as usize;
        s.extra_x[slot] = s.ring_fx[g];
        s.extra_y[slot] = s.ring_fy[g];
    }
    for &(slot, px, py) in &system.load().shares {
        s.extra_x[slot] += px * force;
        s.extra_y[slot] += py * force;
    }
}

#[inline(always)]
fn filament_forces<const QUICK: bool, const SURVEY: bool>(
    system: &System,
    f: &Filaments,
    s: &mut super::state::Scratch,
    sums: &mut Sums,
) {
    for g in 0..f.stiffness.len() {
        let a = f.first + g * LANES;
        let b = a + f.hop;
        let (fx, fy, length) = springs::<QUICK>(
            (load_lane(&s.ring_x, a), load_lane(&s.ring_y, a)),
            (load_lane(&s.ring_x, b), load_lane(&s.ring_y, b)),
            &f.stiffness[g],
            &f.tension[g],
            system.shortest_squared,
        );
        if SURVEY {
            sums.add::<QUICK>(length, &f.half_stiffness[g], &f.rest[g], &f.inverse_rest[g]);
        }
        for i in 0..LANES {
            s.ring_fx[a + i] += fx[i];
            s.ring_fy[a + i] += fy[i];
        }
        for i in 0..LANES {
            s.ring_fx[b + i] -= fx[i];
            s.ring_fy[b + i] -= fy[i];
        }
    }
}

/// Goes through all springs and gives `update` the force on each group of nodes. When `MOVE`, what
/// `update` returns becomes the group's position.
#[inline(always)]
fn sweep<const QUICK: bool, const SURVEY: bool, const MOVE: bool>(
    system: &System,
    state: &mut State,
    sums: &mut Sums,
    update: &mut impl Update,
) {
    let stride = system.stride;
    let groups = stride / LANES;
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
    for row in system.first_row..system.side - 1 {
        let base = row * stride;
        let row_groups = &system.groups[base / LANES..base / LANES + groups];
        let x = &mut x[base..base + 2 * stride + 1];
        let y = &mut y[base..base + 2 * stride + 1];
        let (mut across_x, mut across_y) = ([0.0; LANES], [0.0; LANES]);
        let (mut rising_x, mut rising_y) = ([0.0; LANES], [0.0; LANES]);
        for (g, group) in row_groups.iter().enumerate() {
            let o = g * LANES;
            let here = (load_lane(x, o), load_lane(y, o));
            let above = (load_lane(x, o + stride), load_lane(y, o + stride));
            let right = (load_lane(x, o + 1), load_lane(y, o + 1));
            let above_right = (
                load_lane(x, o + stride + 1),
                load_lane(y, o + stride + 1),
            );
            let least = system.shortest_squared;
            let (ex, ey, el) = grid_springs::<QUICK>(group, 0, here, right, least);
            let (nx, ny, nl) = grid_springs::<QUICK>(group, 1, here, above, least);
            let (dx, dy, dl) = grid_springs::<QUICK>(group, 2, here, above_right, least);
            let (fx, fy, fl) = grid_springs::<QUICK>(group, 3, above, right, least);
            if SURVEY {
                let survey = &system.survey[base / LANES + g];
                for (d, length) in [el, nl, dl, fl].into_iter().enumerate().take(DIRECTIONS) {
                    sums.add::<QUICK>(
                        length,
                        &survey.half_stiffness[d],
                        &survey.rest[d],
                        &survey.inverse_rest[d],
                    );
                }
            }
            // Springs whose far end is one node to the right of here, and of above.
            let (mut to_right_x, mut to_right_y) = ([0.0; LANES], [0.0; LANES]);
            for i in 0..LANES {
                to_right_x[i] = ex[i] + fx[i];
                to_right_y[i] = ey[i] + fy[i];
            }
            let (from_left_x, from_left_y) =
                (shifted(across_x, to_right_x), shifted(across_y, to_right_y));
            let (from_below_x, from_below_y) = (shifted(rising_x, dx), shifted(rising_y, dy));
            (across_x, across_y, rising_x, rising_y) = (to_right_x, to_right_y, dx, dy);

            let (ux, uy) = (load_lane(up_x, o), load_lane(up_y, o));
            let (qx, qy) = (
                load_lane(&scratch.extra_x, base + o),
                load_lane(&scratch.extra_y, base + o),
            );
            let (mut force_x, mut force_y) = ([0.0; LANES], [0.0; LANES]);
            let (mut next_x, mut next_y) = ([0.0; LANES], [0.0; LANES]);
            for i in 0..LANES {
                force_x[i] = ((ex[i] + nx[i]) + (dx[i] - from_left_x[i])) + (ux[i] + qx[i]);
                force_y[i] = ((ey[i] + ny[i]) + (dy[i] - from_left_y[i])) + (uy[i] + qy[i]);
                next_x[i] = (fx[i] - nx[i]) - from_below_x[i];
                next_y[i] = (fy[i] - ny[i]) - from_below_y[i];
            }
            store_lane(up_x, o, next_x);
            store_lane(up_y, o, next_y);

            let motion = Motion {
                x: here.0,
                y: here.1,
                vx,
                vy,
                ax,
                ay,
            };
            let moved = update.nodes(&system.groups[base / LANES + g], base + o, motion, (force_x, force_y));
            if MOVE {
                store_lane(x, o, moved.0);
                store_lane(y, o, moved.1);
            }
        }
    }
}

/// What an update may read and write.
struct Motion<'a> {
    x: Lane,
    y: Lane,
    vx: &'a mut [f64],
    vy: &'a mut [f64],
    ax: &'a mut [f64],
    ay: &'a mut [f64],
}

/// What a sweep does with the force on eight nodes; returns their new positions. A trait and not a
/// closure, because only a function can be told to be inlined, and so compiled for the vector unit
/// in use.
trait Update {
    fn nodes(&mut self, group: &Group, slot: usize, m: Motion, force: (Lane, Lane)) -> (Lane, Lane);
}

impl Sums {
    fn new() -> Self {
        Self {
            elastic: [0.0; LANES],
            strain_squared: [0.0; LANES],
        }
    }
}

/// Force, kick and drift in one sweep; returns the energy that drag took, in J.
#[inline(always)]
fn kick_drift_as<const QUICK: bool>(
    system: &System,
    state: &mut State,
    force: f64,
    stage: Stage,
) -> f64 {
    let mut sums = Sums::new();
    fill_ghosts(system, state);
    ring_forces::<QUICK, false>(system, state, force, &mut sums);
    let mut update = KickDrift::<QUICK> {
        stage,
        loss: [0.0; LANES],
    };
    sweep::<QUICK, false, true>(system, state, &mut sums, &mut update);
    update.loss.iter().sum()
}

struct KickDrift<const QUICK: bool> {
    stage: Stage,
    loss: Lane,
}

impl<const QUICK: bool> Update for KickDrift<QUICK> {
    #[inline(always)]
    fn nodes(
        &mut self,
        group: &Group,
        slot: usize,
        m: Motion,
        (fx, fy): (Lane, Lane),
    ) -> (Lane, Lane) {
        let (mut vx, mut vy) = (load_lane(m.vx, slot), load_lane(m.vy, slot));
        for i in 0..LANES {
            let w = self.stage.kick * group.inverse_mass[i];
            vx[i] = fused::<QUICK>(fx[i], w, vx[i]);
            vy[i] = fused::<QUICK>(fy[i], w, vy[i]);
        }
        let velocity = (m.vx, m.vy);
        drift::<QUICK>(self.stage, group, (m.x, m.y), velocity, slot, (vx, vy), &mut self.loss)
    }
}

/// The drift of eight nodes: new positions are returned, new velocities stored.
#[inline(always)]
fn drift<const QUICK: bool>(
    stage: Stage,
    group: &Group,
    (mut x, mut y): (Lane, Lane),
    (store_vx, store_vy): (&mut [f64], &mut [f64]),
    slot: usize,
    (mut vx, mut vy): (Lane, Lane),
    loss: &mut Lane,
) -> (Lane, Lane) {
    let drift_step = stage.drift[1] - stage.drift[0];
    let keep_step = stage.keep[1] - stage.keep[0];
    for i in 0..LANES {
        let reach = fused::<QUICK>(drift_step, group.fat[i], stage.drift[0]);
        let keep = fused::<QUICK>(keep_step, group.fat[i], stage.keep[0]);
        x[i] = fused::<QUICK>(reach, vx[i], x[i]);
        y[i] = fused::<QUICK>(reach, vy[i], y[i]);
        let speed_squared = fused::<QUICK>(vx[i], vx[i], vy[i] * vy[i]);
        let lost = fused::<QUICK>(-keep, keep, 1.0) * group.half_mass[i];
        loss[i] = fused::<QUICK>(speed_squared, lost, loss[i]);
        vx[i] *= keep;
        vy[i] *= keep;
    }
    store_lane(store_vx, slot, vx);
    store_lane(store_vy, slot, vy);
    (x, y)
}

/// Kick by the stored acceleration and drift, no force evaluation; returns the energy lost.
#[inline(always)]
fn start_as<const QUICK: bool>(
    system: &System,
    state: &mut State,
    keep_before: [f64; 2],
    stage: Stage,
) -> f64 {
    let mut loss = [0.0; LANES];
    let first = (system.first_row * system.stride) / LANES;
    let last = (system.side - 1) * system.stride / LANES;
    for g in first..last {
        let slot = g * LANES;
        let group = &system.groups[g];
        let (mut vx, mut vy) = (load_lane(&state.vx, slot), load_lane(&state.vy, slot));
        let (ax, ay) = (load_lane(&state.ax, slot), load_lane(&state.ay, slot));
        let step = keep_before[1] - keep_before[0];
        for i in 0..LANES {
            let keep = fused::<QUICK>(step, group.fat[i], keep_before[0]);
            vx[i] = fused::<QUICK>(ax[i], stage.kick, vx[i] * keep);
            vy[i] = fused::<QUICK>(ay[i], stage.kick, vy[i] * keep);
        }
        let here = (load_lane(&state.x, slot), load_lane(&state.y, slot));
        let (x, y) = drift::<QUICK>(
            stage,
            group,
            here,
            (&mut state.vx, &mut state.vy),
            slot,
            (vx, vy),
            &mut loss,
        );
        store_lane(&mut state.x, slot, x);
        store_lane(&mut state.y, slot, y);
    }
    loss.iter().sum()
}

/// Force evaluation at the state's positions into its acceleration, then v += kick a, with a
/// survey of the whole mesh.
#[inline(always)]
fn evaluate_as<const QUICK: bool>(
    system: &System,
    state: &mut State,
    force: f64,
    kick: f64,
) -> Survey {
    let mut sums = Sums::new();
    fill_ghosts(system, state);
    ring_forces::<QUICK, true>(system, state, force, &mut sums);
    let mut update = Store::<QUICK> {
        kick,
        kinetic: [0.0; LANES],
    };
    sweep::<QUICK, true, false>(system, state, &mut sums, &mut update);
    let strain_squared = sums.strain_squared.into_iter().fold(0.0, f64::max);
    Survey {
        elastic: sums.elastic.iter().sum(),
        kinetic: update.kinetic.iter().sum(),
        strain: strain_squared.sqrt(),
        quad_ratio: smallest_quad(system, state),
    }
}

struct Store<const QUICK: bool> {
    kick: f64,
    kinetic: Lane,
}

impl<const QUICK: bool> Update for Store<QUICK> {
    #[inline(always)]
    fn nodes(
        &mut self,
        group: &Group,
        slot: usize,
        m: Motion,
        (fx, fy): (Lane, Lane),
    ) -> (Lane, Lane) {
        let (mut vx, mut vy) = (load_lane(m.vx, slot), load_lane(m.vy, slot));
        let (mut ax, mut ay) = ([0.0; LANES], [0.0; LANES]);
        for i in 0..LANES {
            ax[i] = fx[i] * group.inverse_mass[i];
            ay[i] = fy[i] * group.inverse_mass[i];
            vx[i] = fused::<QUICK>(ax[i], self.kick, vx[i]);
            vy[i] = fused::<QUICK>(ay[i], self.kick, vy[i]);
            let speed_squared = fused::<QUICK>(vx[i], vx[i], vy[i] * vy[i]);
            self.kinetic[i] = fused::<QUICK>(speed_squared, group.half_mass[i], self.kinetic[i]);
        }
        store_lane(m.ax, slot, ax);
        store_lane(m.ay, slot, ay);
        store_lane(m.vx, slot, vx);
        store_lane(m.vy, slot, vy);
        (m.x, m.y)
    }
}

#[inline(always)]
fn corner(state: &State, at: usize) -> (Lane, Lane) {
    (load_lane(&state.x, at), load_lane(&state.y, at))
}

/// Smallest ratio of a quad's signed area, half the cross product of its diagonals, to its area
/// at rest.
#[inline(always)]
fn smallest_quad(system: &System, state: &State) -> f64 {
    let stride = system.stride;
    let mut least = [f64::INFINITY; LANES];
    let first = system.first_row * stride / LANES;
    let last = (system.side - 1) * stride / LANES;
    for g in first..last {
        let o = g * LANES;
        let survey = &system.survey[g];
        let (p, r) = (corner(state, o), corner(state, o + 1));
        let (u, q) = (corner(state, o + stride), corner(state, o + stride + 1));
        for i in 0..LANES {
            let cross = (q.0[i] - p.0[i]) * (u.1[i] - r.1[i]) - (q.1[i] - p.1[i]) * (u.0[i] - r.0[i]);
            let ratio = cross * survey.inverse_area[i] + survey.no_quad[i];
            least[i] = if ratio < least[i] { ratio } else { least[i] };
        }
    }
    least.into_iter().fold(f64::INFINITY, f64::min)
}

const _: () = assert!(LANES == 8, "the vector targets below are chosen for eight lanes");

#[multiversion(targets(
    "x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma+bmi2",
    "x86_64+avx2+fma"
))]
pub(super) fn kick_drift(system: &System, state: &mut State, force: f64, stage: Stage) -> f64 {
    if target_cfg_f!(target_feature = "fma") && !system.portable {
        kick_drift_as::<true>(system, state, force, stage)
    } else {
        kick_drift_as::<false>(system, state, force, stage)
    }
}

#[multiversion(targets(
    "x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma+bmi2",
    "x86_64+avx2+fma"
))]
pub(super) fn start(system: &System, state: &mut State, keep_before: [f64; 2], stage: Stage) -> f64 {
    if target_cfg_f!(target_feature = "fma") && !system.portable {
        start_as::<true>(system, state, keep_before, stage)
    } else {
        start_as::<false>(system, state, keep_before, stage)
    }
}

#[multiversion(targets(
    "x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma+bmi2",
    "x86_64+avx2+fma"
))]
pub(super) fn evaluate(system: &System, state: &mut State, force: f64, kick: f64) -> Survey {
    if target_cfg_f!(target_feature = "fma") && !system.portable {
        evaluate_as::<true>(system, state, force, kick)
    } else {
        evaluate_as::<false>(system, state, force, kick)
    }
}

#[multiversion(targets(
    "x86_64+avx512f+avx512vl+avx512dq+avx512bw+avx2+fma+bmi2",
    "x86_64+avx2+fma"
))]
fn detected() -> &'static str {
    if target_cfg_f!(target_feature = "avx512f") {
        "avx512"
    } else if target_cfg_f!(target_feature = "avx2") {
        "avx2"
    } else {
        "baseline"
    }
}

/// Name of the kernel that this machine runs.
pub fn name(portable: bool) -> String {
    let form = if portable || detected() == "baseline" { "sqrt/div" } else { "f32 seed + Newton" };
    format!("{} ({form})", detected())
}
