//! Numbers one at a time or as many as the machine's vectors hold: each law is written once.
//!
//! No operation is fused, and what is summed is summed by place, so every width gives the same
//! bits but for the root of a volume, which the plain form takes from `libm`.

use crate::models::axisymmetric::forces::quads::inverse_cube_root_squared;
use crate::models::paper::forces::lanes::{V, load, splat, store};
use fearless_simd::{Simd, SimdBase, SimdFloat};
use std::ops::{Add, AddAssign, Div, Mul, MulAssign, Neg, Sub, SubAssign};

/// How numbers are computed.
pub(crate) trait Math: Copy {
    /// One number or some.
    type N: Copy
        + Add<Output = Self::N>
        + AddAssign
        + Sub<Output = Self::N>
        + SubAssign
        + Mul<Output = Self::N>
        + MulAssign
        + Div<Output = Self::N>
        + Neg<Output = Self::N>;
    /// How many are computed at once.
    const WIDTH: usize;

    fn number(self, value: f64) -> Self::N;
    fn load(self, from: &[f64], at: usize) -> Self::N;
    fn store(self, value: Self::N, to: &mut [f64], at: usize);
    #[inline(always)]
    fn over(self, a: Self::N, b: Self::N) -> Self::N {
        a / b
    }
    fn root(self, of: Self::N) -> Self::N;
    fn least(self, a: Self::N, b: Self::N) -> Self::N;
    fn most(self, a: Self::N, b: Self::N) -> Self::N;
    /// of^(-2/3).
    fn inverse_cube_root_squared(self, of: Self::N) -> Self::N;
}

/// One number at a time.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Plain;

impl Math for Plain {
    type N = f64;
    const WIDTH: usize = 1;

    #[inline(always)]
    fn number(self, value: f64) -> f64 {
        value
    }
    #[inline(always)]
    fn load(self, from: &[f64], at: usize) -> f64 {
        from[at]
    }
    #[inline(always)]
    fn store(self, value: f64, to: &mut [f64], at: usize) {
        to[at] = value;
    }
    #[inline(always)]
    fn root(self, of: f64) -> f64 {
        of.sqrt()
    }
    #[inline(always)]
    fn least(self, a: f64, b: f64) -> f64 {
        a.min(b)
    }
    #[inline(always)]
    fn most(self, a: f64, b: f64) -> f64 {
        a.max(b)
    }
    #[inline(always)]
    fn inverse_cube_root_squared(self, of: f64) -> f64 {
        let root = libm::cbrt(of);
        1.0 / (root * root)
    }
}

/// As many as the vectors of `S` hold.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Wide<S>(pub S);

impl<S: Simd> Math for Wide<S> {
    type N = V<S>;
    const WIDTH: usize = V::<S>::LEN;

    #[inline(always)]
    fn number(self, value: f64) -> V<S> {
        splat(self.0, value)
    }
    #[inline(always)]
    fn load(self, from: &[f64], at: usize) -> V<S> {
        load(self.0, from, at)
    }
    #[inline(always)]
    fn store(self, value: V<S>, to: &mut [f64], at: usize) {
        store::<S>(to, at, value);
    }
    #[inline(always)]
    fn root(self, of: V<S>) -> V<S> {
        of.sqrt()
    }
    #[inline(always)]
    fn least(self, a: V<S>, b: V<S>) -> V<S> {
        a.min(b)
    }
    #[inline(always)]
    fn most(self, a: V<S>, b: V<S>) -> V<S> {
        a.max(b)
    }
    #[inline(always)]
    fn inverse_cube_root_squared(self, of: V<S>) -> V<S> {
        inverse_cube_root_squared(self.0, of)
    }
}

/// Three components.
pub(crate) type Three<N> = [N; 3];

macro_rules! by_component {
    ($i:ident => $of:expr) => {
        $crate::models::axisymmetric::forces::quads::written_out!($i => $of; 0 1 2)
    };
}
pub(crate) use by_component;

macro_rules! eight {
    ($i:ident => $of:expr) => {
        $crate::models::axisymmetric::forces::quads::written_out!($i => $of; 0 1 2 3 4 5 6 7)
    };
}
pub(crate) use eight;

#[inline(always)]
pub(crate) fn plus<N: Copy + Add<Output = N>>(a: Three<N>, b: Three<N>) -> Three<N> {
    by_component!(i => a[i] + b[i])
}

#[inline(always)]
pub(crate) fn minus<N: Copy + Sub<Output = N>>(a: Three<N>, b: Three<N>) -> Three<N> {
    by_component!(i => a[i] - b[i])
}

#[inline(always)]
pub(crate) fn times<N: Copy + Mul<Output = N>>(a: Three<N>, by: N) -> Three<N> {
    by_component!(i => a[i] * by)
}

#[inline(always)]
pub(crate) fn dot<N: Copy + Add<Output = N> + Mul<Output = N>>(a: Three<N>, b: Three<N>) -> N {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(crate) fn cross<N: Copy + Sub<Output = N> + Mul<Output = N>>(
    a: Three<N>,
    b: Three<N>,
) -> Three<N> {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
