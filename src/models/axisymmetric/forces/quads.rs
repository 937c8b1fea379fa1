//! The mechanics of [`crate::models::axisymmetric::forces::cell`] for many cells at once, and the
//! nodes of rows, which gather their forces from the cells and move.
//!
//! All volumes come from the edges: with w = (xb - xa)(ra^2 + ra rb + rb^2), the quad's volume is
//! minus the sum over its four edges and a corner triangle's that over two edges and a diagonal,
//! in units of pi/3. So forces follow from one coefficient an edge, the sum of the pressures of
//! all that it bounds. Eight divisions become one by way of the product. No operation is fused and
//! sums are kept by place, so every vector width gives the same bits.

use crate::models::axisymmetric::forces::cell::{ASSEMBLED, EASED, FLAT, PRESSED, SQUEEZED};
use crate::models::axisymmetric::forces::rows::{CellGroup, CellRows, RowRun, field};
use crate::models::axisymmetric::forces::state::{CellSums, NodeState, Totals};
use crate::models::paper::forces::lanes::{V, load, splat, store};
use crate::models::paper::forces::layout::{LANES, Lane};
use fearless_simd::{Bytes, Simd, SimdBase, SimdFloat};
use std::f64::consts::FRAC_PI_3;

/// Radius of a cell at least, in m: where there is no cell, it may be 0.
const LEAST_RADIUS: f64 = 1e-9;

/// An array, written out: a closure would not be compiled for the vectors' instructions.
macro_rules! written_out {
    ($i:ident => $of:expr; $($place:literal)*) => {
        [$({
            let $i: usize = $place;
            $of
        }),*]
    };
}
pub(crate) use written_out;

macro_rules! four {
    ($i:ident => $of:expr) => { written_out!($i => $of; 0 1 2 3) };
}

/// x and r, or along x and along r, of a corner.
type At<S> = (V<S>, V<S>);

/// From one corner to another.
struct Edge<S: Simd> {
    /// xb - xa.
    along: V<S>,
    /// ra^2 + ra rb + rb^2.
    square: V<S>,
    /// 2 ra + rb and ra + 2 rb.
    slopes: (V<S>, V<S>),
}

impl<S: Simd> Edge<S> {
    #[inline(always)]
    fn new(a: At<S>, b: At<S>) -> Self {
        let sum = a.1 + b.1;
        Self { along: b.0 - a.0, square: sum * sum - a.1 * b.1, slopes: (sum + a.1, sum + b.1) }
    }

    #[inline(always)]
    fn volume(&self) -> V<S> {
        self.along * self.square
    }

    #[inline(always)]
    fn rate(&self, a: At<S>, b: At<S>) -> V<S> {
        self.square * (b.0 - a.0) + self.along * (self.slopes.0 * a.1 + self.slopes.1 * b.1)
    }

    /// Adds `by` times the gradient of the volume to what acts on both ends.
    #[inline(always)]
    fn push(&self, by: V<S>, a: &mut At<S>, b: &mut At<S>) {
        let along = by * self.square;
        let across = by * self.along;
        a.0 -= along;
        b.0 += along;
        a.1 += across * self.slopes.0;
        b.1 += across * self.slopes.1;
    }
}

/// of^(-2/3) where that is positive: a third of the exponent by shifts, a third-order iteration.
#[inline(always)]
pub(crate) fn inverse_cube_root_squared<S: Simd>(simd: S, of: V<S>) -> V<S> {
    /// Bits of 1 times 4/3, less what makes the largest error of the first guess least.
    const MAGIC: u64 = 0x553E_F0FF_289D_D796;
    let bits: S::u64s = of.bitcast();
    let quarter = bits >> 2;
    let fifth = quarter + (quarter >> 2);
    let third = fifth + (fifth >> 4);
    let third = third + (third >> 8) + (third >> 16);
    let guess: S::u64s = S::u64s::splat(simd, MAGIC) - third;
    let mut y: V<S> = guess.bitcast();
    for _ in 0..3 {
        let e = splat(simd, 1.0) - of * y * y * y;
        y += y * e * (splat(simd, 1.0 / 3.0) + e * splat(simd, 2.0 / 9.0));
    }
    y * y
}

#[inline(always)]
fn add<S: Simd>(simd: S, to: &mut Lane, lane: usize, value: V<S>) {
    let sum = load(simd, to, lane) + value;
    store::<S>(to, lane, sum);
}

/// Forces of all cells on the nodes, and what else they say.
#[inline(always)]
pub(crate) fn forces<S: Simd>(simd: S, rows: &mut CellRows, state: &mut NodeState) -> CellSums {
    let mut totals = Totals::new();
    for index in 0..rows.runs.len() {
        let run = rows.runs[index];
        for group in 0..run.cell_places / LANES {
            let constants = &rows.groups[run.cells / LANES + group];
            for lane in (0..LANES).step_by(V::<S>::LEN) {
                let at = group * LANES + lane;
                let on =
                    cells(simd, constants, lane, state, run, at, &mut rows.pressures, &mut totals);
                for (corner, force) in rows.corners.iter_mut().zip(on) {
                    store::<S>(&mut corner.0, run.corners + at, force.0);
                    store::<S>(&mut corner.1, run.corners + at, force.1);
                }
            }
        }
        gather(simd, rows, run, state);
    }
    totals.sums()
}

/// What the four cells around each node have left for it.
#[inline(always)]
fn gather<S: Simd>(simd: S, rows: &CellRows, run: RowRun, state: &mut NodeState) {
    let [c0, c1, c2, c3] = &rows.corners;
    for i in (0..run.node_places).step_by(V::<S>::LEN) {
        let at = run.corners + i;
        let fx = around(simd, [&c0.0, &c1.0, &c2.0, &c3.0], at, run.columns);
        let fr = around(simd, [&c0.1, &c1.1, &c2.1, &c3.1], at, run.columns);
        store::<S>(&mut state.fx, run.nodes + i, fx);
        store::<S>(&mut state.fr, run.nodes + i, fr);
    }
}

#[inline(always)]
fn around<S: Simd>(simd: S, of: [&[f64]; 4], at: usize, columns: usize) -> V<S> {
    let low = load(simd, of[0], at) + load(simd, of[1], at - 1);
    low + (load(simd, of[3], at - columns) + load(simd, of[2], at - columns - 1))
}

/// Kicks velocities over `kick` s, then moves nodes over `drift` s.
#[inline(always)]
pub(crate) fn advance<S: Simd>(simd: S, state: &mut NodeState, kick: f64, drift: f64) {
    let by = (kick, drift);
    move_along(simd, &mut state.x, &mut state.vx, &state.fx, &state.free_x, by);
    move_along(simd, &mut state.r, &mut state.vr, &state.fr, &state.free_r, by);
}

#[inline(always)]
fn move_along<S: Simd>(
    simd: S,
    x: &mut [f64],
    v: &mut [f64],
    f: &[f64],
    free: &[f64],
    (kick, drift): (f64, f64),
) {
    for i in (0..x.len()).step_by(V::<S>::LEN) {
        let force = load(simd, f, i) * load(simd, free, i);
        let speed = load(simd, v, i) + splat(simd, kick) * force;
        store::<S>(v, i, speed);
        let to = load(simd, x, i) + splat(simd, drift) * speed;
        store::<S>(x, i, to);
    }
}

/// Forces of some cells on their corners.
#[allow(
    clippy::too_many_arguments,
    clippy::too_many_lines,
    reason = "one formula, whose parts share most of their values"
)]
#[inline(always)]
fn cells<S: Simd>(
    simd: S,
    constants: &CellGroup,
    lane: usize,
    state: &NodeState,
    run: RowRun,
    at: usize,
    pressures: &mut [f64],
    totals: &mut Totals,
) -> [At<S>; 4] {
    macro_rules! c {
        ($field:expr) => {
            load(simd, &constants.0[$field], lane)
        };
    }
    macro_rules! number {
        ($value:expr) => {
            splat(simd, $value)
        };
    }
    let low = run.nodes + at;
    let high = low + run.columns;
    let places = [low, low + 1, high + 1, high];
    let p = four!(i => (load(simd, &state.x, places[i]), load(simd, &state.r, places[i])));
    let v = four!(i => (load(simd, &state.vx, places[i]), load(simd, &state.vr, places[i])));

    let edges: [Edge<S>; 4] = four!(i => Edge::new(p[i], p[(i + 1) % 4]));
    let cross = [Edge::<S>::new(p[0], p[2]), Edge::new(p[1], p[3])];
    let w: [V<S>; 4] = four!(i => edges[i].volume());
    let rate: [V<S>; 4] = four!(i => edges[i].rate(v[i], v[(i + 1) % 4]));
    let (w02, w13) = (cross[0].volume(), cross[1].volume());
    let (rate02, rate13) = (cross[0].rate(v[0], v[2]), cross[1].rate(v[1], v[3]));

    // Corner i with its two neighbours.
    let triangle =
        [-(w[3] + w[0] + w13), w02 - (w[0] + w[1]), w13 - (w[1] + w[2]), -(w[2] + w[3] + w02)];
    let triangle_rate = [
        -(rate[3] + rate[0] + rate13),
        rate02 - (rate[0] + rate[1]),
        rate13 - (rate[1] + rate[2]),
        -(rate[2] + rate[3] + rate02),
    ];
    let volume = triangle[1] + triangle[3];
    let volume_rate = triangle_rate[1] + triangle_rate[3];
    let volume_at_rest = c!(field::VOLUME);
    let now = volume.max(volume_at_rest * number!(FLAT));

    let a = (cross[0].along, p[2].1 - p[0].1);
    let b = (cross[1].along, p[3].1 - p[1].1);
    let det = (a.0 * b.1 - b.0 * a.1).max(c!(field::LEAST_DET));
    // A square is as large as the parallelogram of its diagonals; where there is no cell all may
    // be 0.
    let squares = (a.0 * a.0 + a.1 * a.1).max(b.0 * b.0 + b.1 * b.1);
    let longest = squares.max(c!(field::LEAST_DET)).sqrt();
    let radius = ((p[0].1 + p[1].1 + (p[2].1 + p[3].1)) * number!(0.25)).max(number!(LEAST_RADIUS));

    let at_rest: [V<S>; 4] = four!(i => c!(field::TRIANGLE + i));
    let squeezed: [V<S>; 4] = four!(i => triangle[i].max(at_rest[i] * number!(SQUEEZED)));
    // 1/z of eight numbers by one division.
    let (t01, t23) = (squeezed[0] * squeezed[1], squeezed[2] * squeezed[3]);
    let (vd, lr) = (now * det, longest * radius);
    let (left, right) = (t01 * t23, vd * lr);
    let inverse = number!(1.0) / (left * right);
    let (of_left, of_right) = (inverse * right, inverse * left);
    let (of_01, of_23) = (of_left * t23, of_left * t01);
    let (of_vd, of_lr) = (of_right * lr, of_right * vd);
    let inverse_squeezed =
        [of_01 * squeezed[1], of_01 * squeezed[0], of_23 * squeezed[3], of_23 * squeezed[2]];
    let (inverse_now, inverse_det) = (of_vd * det, of_vd * now);
    let (inverse_longest, inverse_radius) = (of_lr * radius, of_lr * longest);

    let length = number!(0.5) * det * inverse_longest;
    let inverse_length = number!(2.0) * longest * inverse_det;
    let expansion = volume_rate * inverse_now;
    let inverse_j = volume_at_rest * inverse_now;
    let pressure = c!(field::BULK) * (inverse_j - number!(1.0));
    store::<S>(pressures, run.cells + at, pressure);
    let closing = expansion.min(number!(0.0));
    let artificial =
        (c!(field::QUADRATIC) * length * closing - c!(field::LINEAR)) * length * expansion;
    let mut loss = -(artificial * expansion * now);

    // Bound of the step.
    let viscous_speed = c!(field::CONSTANT_SPEED)
        + number!(2.0) * c!(field::KINEMATIC) * inverse_length
        + c!(field::QUADRATIC_SPEED) * length * expansion.max(-expansion);
    let stiff = c!(field::BULK_SPEED) * inverse_j * inverse_j + c!(field::OTHER_SPEED);
    let waves = ((stiff + viscous_speed * viscous_speed).sqrt() + viscous_speed) * inverse_length;
    let diffusion = number!(4.0) * c!(field::KINEMATIC) * inverse_length * inverse_length;

    // What counts of it is settled here: carried on past the corners it finds no register, and a
    // sweep takes a fifth longer with AVX.
    let of_rest: [V<S>; 4] = four!(i => triangle[i] * c!(field::INVERSE_TRIANGLE + i));
    let least = of_rest[0].min(of_rest[1]).min(of_rest[2].min(of_rest[3]));
    let seen = load(simd, &totals.corner, lane).min(least + c!(field::ABSENT));
    store::<S>(&mut totals.corner, lane, seen);
    let counts = number!(1.0) - number!(EASED) * (least - number!(PRESSED));
    let counts = counts.max(number!(1.0 / ASSEMBLED)).min(number!(1.0));
    let rate = load(simd, &totals.rate, lane).max(waves.max(diffusion) * counts);
    store::<S>(&mut totals.rate, lane, rate);

    // Pressures of the corners, which are subtracted from an edge's coefficient.
    let mut whole = pressure + artificial;
    let eta = c!(field::CORNER) * length;
    let mut shrinking = number!(0.0);
    let own: [V<S>; 4] = four!(i => {
        let j = of_rest[i];
        let over = at_rest[i] * inverse_squeezed[i];
        let cube = over * over * over;
        let below = number!(SQUEEZED) - j.min(number!(SQUEEZED));
        let elastic = c!(field::SUBZONAL) * (cube - number!(1.0) + number!(3.0) * below * cube * over);
        let own_rate = triangle_rate[i] * inverse_squeezed[i];
        shrinking = shrinking.min(own_rate);
        let shape_rate = own_rate - expansion;
        let viscous = eta * shape_rate;
        let share = viscous * squeezed[i];
        whole += share * inverse_now;
        loss += share * shape_rate;
        elastic - viscous
    });
    let most = load(simd, &totals.rate, lane).max(-(shrinking * c!(field::SHRINKING)));
    store::<S>(&mut totals.rate, lane, most);

    let zero = number!(0.0);
    let mut on = [(zero, zero); 4];
    let unit = number!(-FRAC_PI_3);
    for i in 0..4 {
        let k = (i + 1) % 4;
        let by = unit * (whole + own[i] + own[k]);
        let (mut start, mut end) = (on[i], on[k]);
        edges[i].push(by, &mut start, &mut end);
        (on[i], on[k]) = (start, end);
    }
    for (i, by) in [unit * (own[3] - own[1]), unit * (own[0] - own[2])].into_iter().enumerate() {
        let (mut start, mut end) = (on[i], on[i + 2]);
        cross[i].push(by, &mut start, &mut end);
        (on[i], on[i + 2]) = (start, end);
    }

    // Shear.
    let d: [V<S>; 4] = four!(i => c!(field::DIAGONAL + i));
    let f = [
        a.0 * d[0] + b.0 * d[2],
        a.0 * d[1] + b.0 * d[3],
        a.1 * d[0] + b.1 * d[2],
        a.1 * d[1] + b.1 * d[3],
    ];
    let hoop = radius * c!(field::INVERSE_RADIUS);
    let xx = f[0] * f[0] + f[1] * f[1];
    let xr = f[0] * f[2] + f[1] * f[3];
    let rr = f[2] * f[2] + f[3] * f[3];
    let hh = hoop * hoop;
    let third = (xx + rr + hh) * number!(1.0 / 3.0);
    let isochoric = inverse_cube_root_squared(simd, det * c!(field::INVERSE_DET) * hoop);
    let g = c!(field::SHEAR) * isochoric;

    let va = (v[2].0 - v[0].0, v[2].1 - v[0].1);
    let vb = (v[3].0 - v[1].0, v[3].1 - v[1].1);
    let l_xx = (va.0 * b.1 - vb.0 * a.1) * inverse_det;
    let l_rr = (vb.1 * a.0 - va.1 * b.0) * inverse_det;
    let shearing =
        number!(0.5) * inverse_det * (vb.0 * a.0 - va.0 * b.0 + (va.1 * b.1 - vb.1 * a.1));
    let l_hh = number!(0.25) * (v[0].1 + v[1].1 + (v[2].1 + v[3].1)) * inverse_radius;
    let mean = (l_xx + l_rr + l_hh) * number!(1.0 / 3.0);
    let (d_xx, d_rr, d_hh) = (l_xx - mean, l_rr - mean, l_hh - mean);
    let n = c!(field::VISCOSITY) * now * number!(FRAC_PI_3);
    let s_xx = g * (xx - third) + n * d_xx;
    let s_xr = g * xr + n * shearing;
    let s_rr = g * (rr - third) + n * d_rr;
    let s_hh = g * (hh - third) + n * d_hh;
    let squares = d_xx * d_xx + d_rr * d_rr + d_hh * d_hh + number!(2.0) * shearing * shearing;
    let loss = loss * number!(FRAC_PI_3) + n * squares;
    let on_a = ((s_xx * b.1 - s_xr * b.0) * inverse_det, (s_xr * b.1 - s_rr * b.0) * inverse_det);
    let on_b = ((s_xr * a.0 - s_xx * a.1) * inverse_det, (s_rr * a.0 - s_xr * a.1) * inverse_det);
    let out = number!(0.25) * s_hh * inverse_radius;

    add(simd, &mut totals.loss, lane, loss);
    add(simd, &mut totals.mean, lane, c!(field::MEAN) * pressure);
    add(simd, &mut totals.sensor, lane, c!(field::SENSOR) * pressure);
    add(simd, &mut totals.volume, lane, c!(field::GLOBE) * volume);
    [
        (on[0].0 + on_a.0, on[0].1 + on_a.1 - out),
        (on[1].0 + on_b.0, on[1].1 + on_b.1 - out),
        (on[2].0 - on_a.0, on[2].1 - on_a.1 - out),
        (on[3].0 - on_b.0, on[3].1 - on_b.1 - out),
    ]
}
