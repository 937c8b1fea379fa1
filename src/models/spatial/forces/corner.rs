//! The corners of a cell: tetrahedra whose pressures keep it from folding.
//!
//! A corner with its three neighbours is a tetrahedron of volume VT = e1.(e2 x e4)/6, e the edges
//! that meet there. As j = VT/VT0 comes to 0 its pressure (Ks/3)(j^-3 - 1) grows without end, from
//! j = 0.05 down as its tangent. The eight cover the cell 4/3 times, so each counts three quarters.
//! They see j and not j/J: what they hold stiff is a little stiffer in bulk by it.
//!
//! Their viscosity is against changes of shape, VT'/VT - V'/V. Two bounds of the step are theirs:
//! 2/w with w^2 = (3/4) Ks j^-4 / VT0 sum |dVT/dx|^2 / (rho V0/8), and half of the time in which
//! one would be gone at its present rate. Without them fast small objects fold cells.

use crate::models::axisymmetric::forces::cell::{LOSS_IN_STEP, SQUEEZED};
use crate::models::spatial::forces::cell::{Constants, Eight, Fields, field};
use crate::models::spatial::forces::math::{
    Math, Three, by_component, cross, dot, eight, minus, plus, times,
};

/// How much of its volume each counts.
pub(crate) const WEIGHT: f64 = 0.75;

/// What the corners of a cell do.
pub(crate) struct Corners<N> {
    /// On each corner, N.
    pub force: Eight<N>,
    /// What their viscosity adds to the pressure of the whole, times its volume.
    pub back: N,
    /// W.
    pub loss: N,
    /// 1 over the longest stable step, 1/s.
    pub rate: N,
    /// 1 over the time in which half of the fastest shrinking one would be gone, 1/s.
    pub shrinking: N,
    /// Smallest over that at rest.
    pub least: N,
}

/// Six times the volume of corner `n`.
pub(crate) fn at_rest(p: &Eight<f64>, n: usize) -> f64 {
    let edge = |bit: usize| minus(p[n | bit], p[n & !bit]);
    dot(edge(1), cross(edge(2), edge(4)))
}

/// Stored in all eight, J.
pub(crate) fn energy(c: &Constants, p: &Eight<f64>) -> f64 {
    let stored = |n: usize| {
        let rest = c[field::CORNER + n];
        let j = at_rest(p, n) / rest;
        let at = j.max(SQUEEZED);
        let below = at - j;
        let pressure = at.powi(-3) - 1.0;
        let slope = 3.0 * at.powi(-4);
        let energy = 0.5 * at.powi(-2) + at - 1.5;
        rest / 6.0 * (energy + below * (pressure + 0.5 * slope * below))
    };
    c[field::SUBZONAL] * (0..8).map(stored).sum::<f64>()
}

/// The slope for the corner itself, but for its sign.
#[inline(always)]
fn slope_of_its_own<M: Math>(
    n: usize,
    c1: Three<M::N>,
    c2: Three<M::N>,
    c4: Three<M::N>,
) -> Three<M::N> {
    let first = if (n & 1 == 0) == (n >> 1 & 1 == 0) { plus(c1, c2) } else { minus(c1, c2) };
    if (n & 1 == 0) == (n >> 2 & 1 == 0) { plus(first, c4) } else { minus(first, c4) }
}

/// What they do with the corners at `p` and of velocities `v`, in a cell that expands at some rate
/// and of a viscosity `eta`.
#[inline(always)]
pub(crate) fn respond<M: Math>(
    m: M,
    c: Fields,
    p: &Eight<M::N>,
    v: &Eight<M::N>,
    (expansion, eta): (M::N, M::N),
) -> Corners<M::N> {
    let (zero, one) = (m.number(0.0), m.number(1.0));
    let sixth = m.number(1.0 / 6.0);
    let squeezed = m.number(SQUEEZED);
    let (mut back, mut loss, mut least) = (zero, zero, m.number(f64::INFINITY));
    let (mut stiffest, mut shrinking) = (zero, zero);
    macro_rules! at {
        ($n:expr) => {{
            const N: usize = $n;
            let e1 = minus(p[N | 1], p[N & !1]);
            let e2 = minus(p[N | 2], p[N & !2]);
            let e4 = minus(p[N | 4], p[N & !4]);
            let (c1, c2, c4) = (cross(e2, e4), cross(e4, e1), cross(e1, e2));
            let det = dot(e1, c1);
            let rate = dot(minus(v[N | 1], v[N & !1]), c1)
                + dot(minus(v[N | 2], v[N & !2]), c2)
                + dot(minus(v[N | 4], v[N & !4]), c4);
            let rest = c.get(m, field::CORNER + N);
            let held = m.most(det, rest * squeezed);
            let inverse_both = m.over(one, held * rest);
            let inverse_rest = inverse_both * held;
            let inverse_squeezed = inverse_both * rest;
            let j = det * inverse_rest;
            least = m.least(least, j);
            let over = rest * inverse_squeezed;
            let cube = over * over * over;
            let below = squeezed - m.least(j, squeezed);
            let slope = cube * over;
            let elastic = c.get(m, field::SUBZONAL) * (cube - one + m.number(3.0) * below * slope);
            let own_rate = rate * inverse_squeezed;
            shrinking = m.least(shrinking, own_rate);
            let shape_rate = own_rate - expansion;
            let viscous = eta * shape_rate;
            let share = viscous * held * sixth;
            back += share;
            loss += share * shape_rate;
            let by = (elastic - viscous) * sixth;
            let own = slope_of_its_own::<M>(N, c1, c2, c4);
            let squares = dot(c1, c1) + dot(c2, c2) + dot(c4, c4) + dot(own, own);
            // |dVT/dx|^2 is a 36th of that, and VT0 a sixth of what is known at rest.
            stiffest = m.most(stiffest, slope * squares * inverse_rest);
            [times(c1, by), times(c2, by), times(c4, by)]
        }};
    }
    let on = [at!(0), at!(1), at!(2), at!(3), at!(4), at!(5), at!(6), at!(7)];
    // Each edge pushes its ends apart by what the corners at both say.
    let force = eight!(n => {
        let along = |bit: usize| n & (1 << bit) > 0;
        let edges = by_component!(bit => plus(on[n][bit], on[n ^ (1 << bit)][bit]));
        let first = if along(0) { edges[0] } else { minus([zero; 3], edges[0]) };
        let second = if along(1) { plus(first, edges[1]) } else { minus(first, edges[1]) };
        if along(2) { plus(second, edges[2]) } else { minus(second, edges[2]) }
    });
    let frequency = m.root(c.get(m, field::CORNER_SPEED) * sixth * stiffest);
    let shrinking = -(shrinking * m.number(1.0 / LOSS_IN_STEP));
    Corners { force, back, loss, rate: m.number(0.5) * frequency, shrinking, least }
}
