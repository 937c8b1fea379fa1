//! Vectors of the machine's width, and what is computed of some springs at once.
//!
//! The vectors are `fearless_simd`'s, so the code is safe, and AVX-512, AVX2, SSE2 or NEON is
//! picked at run time.

#![allow(
    clippy::inline_always,
    reason = "what is called within a vector dispatch must be compiled for its instructions"
)]

use fearless_simd::{Simd, SimdBase, SimdFloat, SimdNarrow, SimdWiden};

/// As many f64 as the machine handles at once.
pub(super) type V<S> = <S as Simd>::f64s;
/// x and y of as many nodes.
pub(super) type Pair<S> = (V<S>, V<S>);

#[inline(always)]
pub(super) fn load<S: Simd>(simd: S, run: &[f64], at: usize) -> V<S> {
    V::<S>::from_slice(simd, &run[at..at + V::<S>::LEN])
}

#[inline(always)]
pub(super) fn store<S: Simd>(run: &mut [f64], at: usize, value: V<S>) {
    value.store_slice(&mut run[at..at + V::<S>::LEN]);
}

#[inline(always)]
pub(super) fn load_pair<S: Simd>(simd: S, x: &[f64], y: &[f64], at: usize) -> Pair<S> {
    (load(simd, x, at), load(simd, y, at))
}

#[inline(always)]
pub(super) fn splat<S: Simd>(simd: S, value: f64) -> V<S> {
    V::<S>::splat(simd, value)
}

#[inline(always)]
pub(super) fn zeros<S: Simd>(simd: S) -> Pair<S> {
    (splat(simd, 0.0), splat(simd, 0.0))
}

/// a b + c, fused where the quick form may.
#[inline(always)]
pub(super) fn fused<S: Simd, const QUICK: bool>(a: V<S>, b: V<S>, c: V<S>) -> V<S> {
    if QUICK { a.mul_add(b, c) } else { a * b + c }
}

/// `current` moved up one lane, the last of `before` first.
#[inline(always)]
pub(super) fn shifted<S: Simd>(before: V<S>, current: V<S>) -> V<S> {
    match V::<S>::LEN {
        8 => before.slide::<7>(current),
        4 => before.slide::<3>(current),
        _ => before.slide::<1>(current),
    }
}

/// Some springs of one direction: from end a to end b, and their length squared.
pub(super) struct Springs<S: Simd> {
    pub dx: V<S>,
    pub dy: V<S>,
    pub square: V<S>,
}

impl<S: Simd> Springs<S> {
    #[inline(always)]
    pub fn new<const QUICK: bool>(a: Pair<S>, b: Pair<S>, shortest_squared: V<S>) -> Self {
        let (dx, dy) = (b.0 - a.0, b.1 - a.1);
        let square = fused::<S, QUICK>(dx, dx, dy * dy).max(shortest_squared);
        Self { dx, dy, square }
    }

    /// Force on end a.
    #[inline(always)]
    pub fn force<const QUICK: bool>(
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
pub(super) fn inverse_roots<S: Simd, const QUICK: bool>(simd: S, a: V<S>, b: V<S>) -> Pair<S> {
    let one = splat(simd, 1.0);
    if !(QUICK && seeds_pay(simd)) {
        return (one / a.sqrt(), one / b.sqrt());
    }
    let seed = S::f32s::splat(simd, 1.0) / a.narrow(b).sqrt();
    let (seed_a, seed_b) = seed.widen();
    (polished(simd, a, seed_a), polished(simd, b, seed_b))
}

/// Whether f32 seeds are faster than roots and divisions. On narrow vectors the registers do not
/// suffice for the Newton steps and what else is under way.
pub(super) fn seeds_pay<S: Simd>(_: S) -> bool {
    V::<S>::LEN >= 8
}

/// A third-order Newton step: from 24 right bits of 1/sqrt(square) to all 53.
#[inline(always)]
pub(super) fn polished<S: Simd>(simd: S, square: V<S>, seed: V<S>) -> V<S> {
    let excess = (square * seed).mul_sub(seed, splat(simd, 1.0));
    let bend = excess.mul_add(splat(simd, -0.375), splat(simd, 0.5));
    (-(seed * excess)).mul_add(bend, seed)
}

/// Sums over the springs of a sweep, lane by lane.
pub(super) struct Sums<S: Simd> {
    pub elastic: V<S>,
    pub strain_squared: V<S>,
}

impl<S: Simd> Sums<S> {
    #[inline(always)]
    pub fn new(simd: S) -> Self {
        Self {
            elastic: splat(simd, 0.0),
            strain_squared: splat(simd, 0.0),
        }
    }

    #[inline(always)]
    pub fn add<const QUICK: bool>(
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

pub(super) fn total<S: Simd>(lanes: V<S>) -> f64 {
    lanes.as_slice().iter().sum()
}

/// Number of lanes.
pub(super) fn width<S: Simd>(_: S) -> usize {
    V::<S>::LEN
}
