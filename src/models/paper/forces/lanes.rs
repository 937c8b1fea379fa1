//! Vectors of the machine's width, and what is computed of some springs at once.
//!
//! The vectors are `fearless_simd`'s, so the code is safe, and AVX-512, AVX2, SSE2 or NEON is
//! picked at run time. Of AVX-512 and AVX2 an instruction that has no name there is used too.

use crate::models::paper::forces::layout::{DIRECTIONS, LANES};
#[cfg(target_arch = "x86_64")]
use fearless_simd::{Level, SimdInto, f64x4, f64x8};
use fearless_simd::{Simd, SimdBase, SimdFloat};
#[cfg(target_arch = "x86_64")]
use std::arch::x86_64::{
    __m256d, __m512d, _mm_rsqrt_ps, _mm256_cvtpd_ps, _mm256_cvtps_pd, _mm512_rsqrt14_pd,
};

/// As many f64 as the machine handles at once.
pub(crate) type V<S> = <S as Simd>::f64s;
/// x and y of as many nodes.
pub(crate) type Pair<S> = (V<S>, V<S>);

#[inline(always)]
pub(crate) fn load<S: Simd>(simd: S, run: &[f64], at: usize) -> V<S> {
    V::<S>::from_slice(simd, &run[at..at + V::<S>::LEN])
}

#[inline(always)]
pub(crate) fn store<S: Simd>(run: &mut [f64], at: usize, value: V<S>) {
    value.store_slice(&mut run[at..at + V::<S>::LEN]);
}

#[inline(always)]
pub(crate) fn load_pair<S: Simd>(simd: S, (x, y): (&[f64], &[f64]), at: usize) -> Pair<S> {
    (load(simd, x, at), load(simd, y, at))
}

#[inline(always)]
pub(crate) fn store_pair<S: Simd>((x, y): (&mut [f64], &mut [f64]), at: usize, value: Pair<S>) {
    store::<S>(x, at, value.0);
    store::<S>(y, at, value.1);
}

#[inline(always)]
pub(crate) fn splat<S: Simd>(simd: S, value: f64) -> V<S> {
    V::<S>::splat(simd, value)
}

#[inline(always)]
pub(crate) fn zeros<S: Simd>(simd: S) -> Pair<S> {
    (splat(simd, 0.0), splat(simd, 0.0))
}

/// a b + c, fused where the quick form may.
#[inline(always)]
pub(crate) fn fused<S: Simd, const QUICK: bool>(a: V<S>, b: V<S>, c: V<S>) -> V<S> {
    if QUICK { a.mul_add(b, c) } else { a * b + c }
}

/// a b + c, fused where the quick form may.
#[inline(always)]
pub(crate) fn fused_pair<S: Simd, const QUICK: bool>(a: Pair<S>, b: V<S>, c: Pair<S>) -> Pair<S> {
    (fused::<S, QUICK>(a.0, b, c.0), fused::<S, QUICK>(a.1, b, c.1))
}

#[inline(always)]
pub(crate) fn times<S: Simd>(a: Pair<S>, b: V<S>) -> Pair<S> {
    (a.0 * b, a.1 * b)
}

/// x^2 + y^2.
#[inline(always)]
pub(crate) fn squared<S: Simd, const QUICK: bool>((x, y): Pair<S>) -> V<S> {
    fused::<S, QUICK>(x, x, y * y)
}

/// `current` moved up one lane, the last of `before` first.
#[inline(always)]
pub(crate) fn shifted<S: Simd>(before: V<S>, current: V<S>) -> V<S> {
    match V::<S>::LEN {
        8 => before.slide::<7>(current),
        4 => before.slide::<3>(current),
        _ => before.slide::<1>(current),
    }
}

/// Some springs of one direction: from end a to end b, and their length squared.
pub(crate) struct Springs<S: Simd> {
    pub span: Pair<S>,
    pub square: V<S>,
}

impl<S: Simd> Springs<S> {
    #[inline(always)]
    pub fn new<const QUICK: bool>(a: Pair<S>, b: Pair<S>, shortest_squared: V<S>) -> Self {
        let span = (b.0 - a.0, b.1 - a.1);
        Self { span, square: squared::<S, QUICK>(span).max(shortest_squared) }
    }

    /// Tension over length, and the force on end a.
    #[inline(always)]
    pub fn force<const QUICK: bool>(
        &self,
        inverse_length: V<S>,
        stiffness: V<S>,
        tension: V<S>,
    ) -> (V<S>, Pair<S>) {
        let pull = fused::<S, QUICK>(-tension, inverse_length, stiffness);
        (pull, times::<S>(self.span, pull))
    }
}

#[cfg(target_arch = "x86_64")]
fearless_simd::kernel!(
    #[inline]
    fn seeds_of_eight(avx512: Avx512, of: __m512d) -> __m512d {
        _mm512_rsqrt14_pd(of)
    }
);

#[cfg(target_arch = "x86_64")]
fearless_simd::kernel!(
    #[inline]
    fn seeds_of_four(avx2: Avx2, of: __m256d) -> __m256d {
        _mm256_cvtps_pd(_mm_rsqrt_ps(_mm256_cvtpd_ps(of)))
    }
);

/// The first bits of 1/sqrt, where the machine has an instruction for them: 14 of AVX-512; else
/// 11.4 in single precision, whose range holds every length squared.
#[cfg(target_arch = "x86_64")]
#[inline(always)]
fn seed<S: Simd>(simd: S, square: V<S>) -> Option<V<S>> {
    match simd.level() {
        Level::Avx512(avx512) => {
            let wide = f64x8::from_slice(avx512, square.as_slice());
            let rough: f64x8<_> = seeds_of_eight(avx512, wide.into()).simd_into(avx512);
            Some(V::<S>::from_slice(simd, rough.as_slice()))
        }
        Level::Avx2(avx2) => {
            let wide = f64x4::from_slice(avx2, square.as_slice());
            let rough: f64x4<_> = seeds_of_four(avx2, wide.into()).simd_into(avx2);
            Some(V::<S>::from_slice(simd, rough.as_slice()))
        }
        _ => None,
    }
}

/// The first bits of 1/sqrt, where the machine has an instruction for them.
#[cfg(not(target_arch = "x86_64"))]
#[inline(always)]
fn seed<S: Simd>(_: S, _: V<S>) -> Option<V<S>> {
    None
}

/// 1/sqrt.
#[inline(always)]
pub(crate) fn inverse_root<S: Simd, const QUICK: bool>(simd: S, square: V<S>) -> V<S> {
    match seed(simd, square) {
        Some(seed) if QUICK => polished(simd, square, seed),
        _ => splat(simd, 1.0) / square.sqrt(),
    }
}

/// How many of the four springs of a node take their roots from seeds in the quick form: with AVX2
/// half, which keeps both multipliers and divider busy.
#[inline(always)]
pub(crate) fn by_seeds<S: Simd>(simd: S) -> usize {
    match seed(simd, splat(simd, 1.0)) {
        Some(_) if V::<S>::LEN == LANES => DIRECTIONS,
        Some(_) => DIRECTIONS / 2,
        None => 0,
    }
}

/// 1/sqrt of the squares of one of the [`DIRECTIONS`].
#[inline(always)]
pub(crate) fn inverse_root_of<S: Simd, const QUICK: bool>(
    simd: S,
    direction: usize,
    square: V<S>,
) -> V<S> {
    if direction < by_seeds(simd) {
        inverse_root::<S, QUICK>(simd, square)
    } else {
        inverse_root::<S, false>(simd, square)
    }
}

/// From the first bits of y = 1/sqrt(square) to all 53: with e = square y^2 - 1, the series of
/// y/sqrt(1 + e). Of AVX-512, where e is below 2^-13, the cube is its last term, which leaves
/// 0.27 e^4; of AVX2, where e is below 2^-10, the fourth power, which leaves 0.25 e^5.
#[inline(always)]
fn polished<S: Simd>(simd: S, square: V<S>, seed: V<S>) -> V<S> {
    let excess = (square * seed).mul_sub(seed, splat(simd, 1.0));
    let cubic = splat(simd, -0.3125);
    let turn = match V::<S>::LEN {
        LANES => cubic,
        _ => excess.mul_add(splat(simd, 35.0 / 128.0), cubic),
    };
    let bend = excess.mul_add(turn, splat(simd, 0.375));
    let slope = excess.mul_add(bend, splat(simd, -0.5));
    (seed * excess).mul_add(slope, seed)
}

/// Sums over the springs of a sweep, lane by lane.
pub(crate) struct Sums<S: Simd> {
    pub elastic: V<S>,
    pub strain_squared: V<S>,
    /// Smallest ratio of a quad's signed area to its area at rest.
    pub quad_ratio: V<S>,
}

impl<S: Simd> Sums<S> {
    #[inline(always)]
    pub fn new(simd: S) -> Self {
        Self {
            elastic: splat(simd, 0.0),
            strain_squared: splat(simd, 0.0),
            quad_ratio: splat(simd, f64::INFINITY),
        }
    }

    #[inline(always)]
    pub fn add<const QUICK: bool>(
        &mut self,
        tension: V<S>,
        half_compliance: V<S>,
        inverse_tension: V<S>,
    ) {
        let strain = tension * inverse_tension;
        self.elastic = fused::<S, QUICK>(tension * tension, half_compliance, self.elastic);
        self.strain_squared = self.strain_squared.max(strain * strain);
    }
}

pub(crate) fn total<S: Simd>(lanes: V<S>) -> f64 {
    lanes.as_slice().iter().sum()
}

/// Number of lanes.
pub(crate) fn width<S: Simd>(_: S) -> usize {
    V::<S>::LEN
}

/// Computes the quick or the portable form of something on the vectors of a system.
macro_rules! on_vectors {
    ($system:expr, $form:ident($($argument:expr),*)) => {{
        let level = $system.level;
        if $system.portable {
            dispatch!(level, simd => $form::<_, false>(simd, $($argument),*))
        } else {
            dispatch!(level, simd => $form::<_, true>(simd, $($argument),*))
        }
    }};
}
pub(crate) use on_vectors;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::models::paper::forces::kernel::vector_sets;
    use fearless_simd::dispatch;

    fn worst<S: Simd, const QUICK: bool>(simd: S) -> f64 {
        let error = |value: f64| {
            let root = inverse_root::<S, QUICK>(simd, splat(simd, value));
            let exact = 1.0 / value.sqrt();
            root.as_slice().iter().fold(0.0, |most, r| f64::max(most, (r / exact - 1.0).abs()))
        };
        // Two binades cover every mantissa; squared lengths lie between 1e-19 and 1 m^2.
        let mantissas = (0..20_000).map(|i| 1.0 + 3.0 * f64::from(i) / 20_000.0);
        let lengths = (0..200).map(|i| 1e-19 * 1.25f64.powi(i));
        mantissas.chain(lengths).map(error).fold(0.0, f64::max)
    }

    #[test]
    fn inverse_roots_are_right_to_rounding_on_all_vectors() {
        for level in vector_sets() {
            let quick = dispatch!(level, simd => worst::<_, true>(simd));
            let portable = dispatch!(level, simd => worst::<_, false>(simd));
            assert!(quick < 5e-16, "{level:?}: {quick:e}");
            assert!(portable < 3e-16, "{level:?}: {portable:e}");
        }
    }
}
