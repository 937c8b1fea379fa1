//! One cell: a trilinear hexahedron with one pressure, in Hadamard modes.
//!
//! Corner n has bits along its row, across it and outward; sm(n) is the product over the bits of m
//! of +1 where n has them and -1 where not, and Xm = sum of sm(n) xn, Um the same of velocities.
//! With a = X1, b = X2, c = X4, d = X3, e = X5, f = X6
//!
//!   V = (1/64) (a.(b x c) + (a.(d x e) + d.(b x f) + e.(f x c))/3),
//!
//! exactly, and with Gm its slope for Xm the mean gradients of velocity and of place are
//! L = sum Um (x) Gm / V and F = sum Xm (x) G0m / V0. Forces are gathered by mode and go back
//! to the corners by one transform.
//!
//! * Pressure, artificial viscosity and the stiffness of corners against folding are those of the
//!   axisymmetric eye ([`crate::models::axisymmetric::forces::cell`]), with V for the volume of the
//!   ring and l = V/(4 sqrt(sum |Gm|^2)), of which 2 c/l is exactly the highest frequency of a
//!   cell with even corners. The corners are [`super::corner`]'s.
//! * Shear: the same neo-Hookean law on F, with the determinant of F for the change of volume.
//! * Twelve motions of a cell change neither V nor F: those of the modes h = 3, 5, 6, 7. With
//!   Q' = Uh - L Xh, which a rigid turn leaves at nothing, they have a viscosity
//!   c = (8/3)(0.05 rho l c') V/(64 V0^(2/3)): fh = -c Q', and what keeps the turn free of it goes
//!   into the stress as -(c/V) Q' (x) Xh.

use crate::models::axisymmetric::forces::cell::{
    FLAT, LINEAR, QUADRATIC, SUBZONAL_BULK, SUBZONAL_VISCOSITY,
};
use crate::models::spatial::eye::{Cell, SpatialEye};
use crate::models::spatial::forces::corner::{self, Corners};
use crate::models::spatial::forces::math::{
    Math, Plain, Three, by_component, cross, dot, eight, minus, plus, times,
};

/// How many times the stiffness of a crushed cell counts for the step: once is stable, but what
/// rings at the bound has its energy missed.
const STIFF: f64 = 1.5;

/// What is constant of a cell.
pub(crate) mod field {
    pub const VOLUME: usize = 0; // m3.
    pub const INVERSE_VOLUME: usize = 1; // 1/m3.
    pub const SLOPE: usize = 2; // Slopes of the volume at rest over the volume, mode by mode, 1/m.
    pub const CORNER: usize = 20; // Six times the volumes of the corner tetrahedra, m3.
    pub const BULK: usize = 28;
    pub const SHEAR: usize = 29; // Shear modulus times volume, J.
    pub const VISCOSITY: usize = 30; // Twice the viscosity.
    pub const SUBZONAL: usize = 31; // A third of the stiffness of corners, with their weight, Pa.
    pub const LINEAR: usize = 32; // Artificial viscosity per length and rate.
    pub const QUADRATIC: usize = 33; // Artificial viscosity per square of length and of rate.
    pub const CORNER_VISCOSITY: usize = 34; // Of the corners per length, with their weight.
    pub const HOURGLASS: usize = 35; // Of modes that change nothing, per length and volume.
    pub const BULK_SPEED: usize = 36; // Squared speed of sound.
    pub const OTHER_SPEED: usize = 37; // What other stiffness adds to it.
    pub const CONSTANT_SPEED: usize = 38; // Viscous speed that does not depend on the state.
    pub const KINEMATIC: usize = 39; // Kinematic viscosity.
    pub const CORNER_SPEED: usize = 40; // Part of the squared frequency of a corner.
    pub const MEAN: usize = 41; // Weight in the mean pressure of the globe.
    pub const SENSOR: usize = 42; // Weight in the pressure at the back.
    pub const GLOBE: usize = 43; // 1 for a cell of the globe.
    pub const PRESENT: usize = 44; // 1, or 0 of a place without a cell.
    pub const STIFF: usize = 45; // How much of its squared rate a corner's node takes, kg.
    pub const COUNT: usize = 46;
}

/// The constants of one cell, by [`field`].
pub(crate) type Constants = [f64; field::COUNT];

/// The constants of a cell, or of as many as are computed at once.
#[derive(Clone, Copy)]
pub(crate) struct Fields<'a> {
    pub of: &'a [f64],
    /// From one constant to the next, and the first cell's place in each.
    pub stride: usize,
    pub lane: usize,
}

impl<'a> Fields<'a> {
    pub fn of(one: &'a Constants) -> Self {
        Self { of: one, stride: 1, lane: 0 }
    }

    #[inline(always)]
    pub fn get<M: Math>(&self, m: M, field: usize) -> M::N {
        m.load(self.of, field * self.stride + self.lane)
    }
}

/// Places or velocities of the corners.
pub(crate) type Eight<N> = [Three<N>; 8];

/// What a cell does at some instant.
pub(crate) struct Response<N> {
    /// On each corner, N.
    pub force: Eight<N>,
    /// Pa.
    pub pressure: N,
    /// m3.
    pub volume: N,
    /// Power lost to viscosity, W.
    pub loss: N,
    /// 1 over the longest stable step, 1/s.
    pub rate: N,
    /// 1 over the longest step by how fast its corners shrink, 1/s.
    pub shrinking: N,
    /// Smallest volume of a corner over its volume at rest.
    pub least_corner: N,
}

/// Sums and differences of the corners by mode.
#[inline(always)]
pub(crate) fn modes<M: Math>(_: M, of: &Eight<M::N>) -> Eight<M::N> {
    macro_rules! over {
        ($bit:literal of $x:expr) => {{
            let x = $x;
            eight!(n => if n & $bit == 0 {
                plus(x[n], x[n | $bit])
            } else {
                minus(x[n], x[n & !$bit])
            })
        }};
    }
    over!(4 of over!(2 of over!(1 of of)))
}

/// From what acts on modes to what acts on corners.
#[inline(always)]
fn to_corners<M: Math>(_: M, of: &Eight<M::N>) -> Eight<M::N> {
    macro_rules! over {
        ($bit:literal of $x:expr) => {{
            let x = $x;
            eight!(n => if n & $bit == 0 {
                minus(x[n], x[n | $bit])
            } else {
                plus(x[n & !$bit], x[n])
            })
        }};
    }
    over!(4 of over!(2 of over!(1 of of)))
}

/// (p x q + r x s/3)/64.
#[inline(always)]
fn own<M: Math>(m: M, [p, q, r, s]: [Three<M::N>; 4]) -> Three<M::N> {
    let (whole, third) = (m.number(1.0 / 64.0), m.number(1.0 / 192.0));
    plus(times(cross(p, q), whole), times(cross(r, s), third))
}

/// (p x q + r x s)/192.
#[inline(always)]
fn shared<M: Math>(m: M, [p, q, r, s]: [Three<M::N>; 4]) -> Three<M::N> {
    times(plus(cross(p, q), cross(r, s)), m.number(1.0 / 192.0))
}

/// Slopes of the volume for modes 1 to 6, in places 1 to 6.
#[inline(always)]
fn slopes<M: Math>(m: M, x: &Eight<M::N>) -> [Three<M::N>; 7] {
    let [_, a, b, d, c, e, f, _] = *x;
    [
        [m.number(0.0); 3],
        own(m, [b, c, d, e]),
        own(m, [c, a, f, d]),
        shared(m, [e, a, b, f]),
        own(m, [a, b, e, f]),
        shared(m, [a, d, f, c]),
        shared(m, [d, b, c, e]),
    ]
}

/// The volume, which is of the third degree in the modes.
#[inline(always)]
fn volume<M: Math>(m: M, x: &Eight<M::N>, slopes: &[Three<M::N>; 7]) -> M::N {
    let mut sum = dot(x[1], slopes[1]);
    for i in 2..7 {
        sum += dot(x[i], slopes[i]);
    }
    sum * m.number(1.0 / 3.0)
}

/// The sum of the outer products of seven vectors.
#[inline(always)]
fn outer<M: Math>(x: &Eight<M::N>, g: &[Three<M::N>; 7]) -> [Three<M::N>; 3] {
    let mut sum = by_component!(i => times(g[1], x[1][i]));
    for m in 2..7 {
        for i in 0..3 {
            sum[i] = plus(sum[i], times(g[m], x[m][i]));
        }
    }
    sum
}

/// The constants of a cell of `eye`.
pub(crate) fn constants(eye: &SpatialEye, cell: &Cell<8>) -> Constants {
    let p: Eight<f64> = cell.corners.map(|node| eye.mesh.at[node].into());
    let x = modes(Plain, &p);
    let slope = slopes(Plain, &x);
    let at_rest = volume(Plain, &x, &slope);
    let mut c = [0.0; field::COUNT];
    c[field::VOLUME] = at_rest;
    c[field::INVERSE_VOLUME] = 1.0 / at_rest;
    for m in 0..6 {
        for k in 0..3 {
            c[field::SLOPE + 3 * m + k] = slope[m + 1][k] / at_rest;
        }
    }
    for n in 0..8 {
        c[field::CORNER + n] = corner::at_rest(&p, n);
    }
    let material = cell.material;
    let (density, bulk) = (material.density, material.bulk);
    let sound = (bulk / density).sqrt();
    let corner_sound = (SUBZONAL_BULK / density).sqrt();
    c[field::BULK] = bulk;
    c[field::SHEAR] = material.shear * at_rest;
    c[field::VISCOSITY] = 2.0 * material.viscosity;
    c[field::SUBZONAL] = corner::WEIGHT * cell.subzonal / 3.0;
    c[field::LINEAR] = LINEAR * density * sound;
    c[field::QUADRATIC] = QUADRATIC * density;
    let corner_viscosity = SUBZONAL_VISCOSITY * density * corner_sound;
    c[field::CORNER_VISCOSITY] = corner::WEIGHT * corner_viscosity;
    let side_squared = libm::cbrt(at_rest * at_rest);
    c[field::HOURGLASS] = 8.0 / 3.0 * corner_viscosity / (64.0 * side_squared);
    c[field::BULK_SPEED] = bulk / density;
    c[field::OTHER_SPEED] = (4.0 / 3.0 * material.shear + cell.subzonal) / density;
    c[field::CONSTANT_SPEED] = LINEAR * sound + 4.0 * SUBZONAL_VISCOSITY * corner_sound;
    c[field::KINEMATIC] = material.viscosity / density;
    c[field::CORNER_SPEED] = corner::WEIGHT * cell.subzonal / (density * at_rest / 8.0);
    c[field::PRESENT] = 1.0;
    c[field::STIFF] = STIFF * density * at_rest / 8.0;
    c
}

/// A gradient of place, the slopes at rest that made it, its determinant, and J^(-2/3) of that.
type Gradient<N> = ([Three<N>; 3], [Three<N>; 7], N, N);

/// The gradient of place.
#[inline(always)]
fn gradient<M: Math>(m: M, c: Fields, x: &Eight<M::N>) -> Gradient<M::N> {
    let zero = [m.number(0.0); 3];
    let mut at_rest = [zero; 7];
    for mode in 0..6 {
        let of = field::SLOPE + 3 * mode;
        at_rest[mode + 1] = [c.get(m, of), c.get(m, of + 1), c.get(m, of + 2)];
    }
    let f = outer::<M>(x, &at_rest);
    let change = m.most(dot(f[0], cross(f[1], f[2])), m.number(FLAT));
    (f, at_rest, change, m.inverse_cube_root_squared(change))
}

/// What a cell with constants `c`, its corners at `p` (m) and of velocities `v` (m/s) does.
#[inline(always)]
pub(crate) fn respond<M: Math>(
    m: M,
    c: Fields,
    p: &Eight<M::N>,
    v: &Eight<M::N>,
) -> Response<M::N> {
    let (zero, one) = (m.number(0.0), m.number(1.0));
    let (x, u) = (modes(m, p), modes(m, v));
    let g = slopes(m, &x);
    let true_volume = volume(m, &x, &g);
    let now = m.most(true_volume, c.get(m, field::VOLUME) * m.number(FLAT));
    let inverse_now = m.over(one, now);
    let mut squares = dot(g[1], g[1]);
    for slope in &g[2..] {
        squares += dot(*slope, *slope);
    }
    let root = m.root(squares);
    let inverse_length = m.number(4.0) * root * inverse_now;
    let length = m.over(one, inverse_length);
    let l = outer::<M>(&u, &g);
    let l = by_component!(i => times(l[i], inverse_now));
    let expansion = l[0][0] + l[1][1] + l[2][2];
    let inverse_j = c.get(m, field::VOLUME) * inverse_now;
    let pressure = c.get(m, field::BULK) * (inverse_j - one);
    let closing = m.least(expansion, zero);
    let artificial = (c.get(m, field::QUADRATIC) * length * closing - c.get(m, field::LINEAR))
        * length
        * expansion;
    let mut loss = -(artificial * expansion * now);

    // Bound of the step.
    let fast = m.most(expansion, -expansion);
    let viscous_speed = c.get(m, field::CONSTANT_SPEED)
        + m.number(2.0) * c.get(m, field::KINEMATIC) * inverse_length
        + m.number(QUADRATIC) * length * fast;
    let stiff = c.get(m, field::BULK_SPEED) * inverse_j * inverse_j + c.get(m, field::OTHER_SPEED);
    let waves = (m.root(stiff + viscous_speed * viscous_speed) + viscous_speed) * inverse_length;
    let diffusion = m.number(4.0) * c.get(m, field::KINEMATIC) * inverse_length * inverse_length;
    let mut rate = m.most(waves, diffusion);

    // Corners.
    let eta = c.get(m, field::CORNER_VISCOSITY) * length;
    let of_corners: Corners<M::N> = corner::respond(m, c, p, v, (expansion, eta));
    rate = m.most(rate, of_corners.rate);
    loss += of_corners.loss;
    let whole = pressure + artificial + of_corners.back * inverse_now;

    // Shear, and the modes that change nothing.
    let (f, at_rest, change, isochoric) = gradient(m, c, &x);
    let trace = dot(f[0], f[0]) + dot(f[1], f[1]) + dot(f[2], f[2]);
    let modulus = c.get(m, field::SHEAR) * isochoric;
    let third = m.over(trace * m.number(1.0 / 3.0), change);
    let cofactor = [cross(f[1], f[2]), cross(f[2], f[0]), cross(f[0], f[1])];
    let elastic = by_component!(i => times(minus(f[i], times(cofactor[i], third)), modulus));

    let viscosity = c.get(m, field::VISCOSITY);
    let mean = expansion * m.number(1.0 / 3.0);
    let half = m.number(0.5);
    let (xx, yy, zz) = (l[0][0] - mean, l[1][1] - mean, l[2][2] - mean);
    let (xy, xz, yz) =
        (half * (l[0][1] + l[1][0]), half * (l[0][2] + l[2][0]), half * (l[1][2] + l[2][1]));
    let shearing = xx * xx + yy * yy + zz * zz + m.number(2.0) * (xy * xy + xz * xz + yz * yz);
    loss += viscosity * now * shearing;
    let mut stress = [
        times([xx, xy, xz], viscosity),
        times([xy, yy, yz], viscosity),
        times([xz, yz, zz], viscosity),
    ];
    let still = c.get(m, field::HOURGLASS) * length * now;
    macro_rules! still {
        ($mode:literal) => {{
            let moved: Three<M::N> = by_component!(i => u[$mode][i] - dot(l[i], x[$mode]));
            loss += still * dot(moved, moved);
            let force = times(moved, still);
            let by = times(force, inverse_now);
            stress = by_component!(i => minus(stress[i], times(x[$mode], by[i])));
            force
        }};
    }
    let held = [still!(3), still!(5), still!(6), still!(7)];
    macro_rules! moved {
        ($mode:literal) => {
            by_component!(i => {
                whole * g[$mode][i] - (dot(stress[i], g[$mode]) + dot(elastic[i], at_rest[$mode]))
            })
        };
    }
    let on = [
        [zero; 3],
        moved!(1),
        moved!(2),
        minus(moved!(3), held[0]),
        moved!(4),
        minus(moved!(5), held[1]),
        minus(moved!(6), held[2]),
        minus([zero; 3], held[3]),
    ];
    let on = to_corners(m, &on);
    let force = eight!(n => plus(of_corners.force[n], on[n]));
    Response {
        force,
        pressure,
        volume: true_volume,
        loss,
        rate,
        shrinking: of_corners.shrinking,
        least_corner: of_corners.least,
    }
}

/// Stored in a cell with constants `c` and its corners at `p`, J.
pub(crate) fn energy(c: &Constants, p: &Eight<f64>) -> f64 {
    let x = modes(Plain, p);
    let g = slopes(Plain, &x);
    let j = (volume(Plain, &x, &g) * c[field::INVERSE_VOLUME]).max(FLAT);
    let bulk = c[field::BULK] * c[field::VOLUME] * (j - 1.0 - libm::log(j));
    let (f, _, _, isochoric) = gradient(Plain, Fields::of(c), &x);
    let trace = dot(f[0], f[0]) + dot(f[1], f[1]) + dot(f[2], f[2]);
    let shear = 0.5 * c[field::SHEAR] * (isochoric * trace - 3.0);
    bulk + shear + corner::energy(c, p)
}

/// Share of its volume at rest that the most squeezed corner has.
pub(crate) fn least_corner(c: &Constants, p: &Eight<f64>) -> f64 {
    let ratio = |n: usize| corner::at_rest(p, n) / c[field::CORNER + n];
    (0..8).map(ratio).fold(f64::INFINITY, f64::min)
}
