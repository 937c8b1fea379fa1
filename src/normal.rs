//! The normal distribution: Φ and its inverse, draws, and draws from one that is cut off.
//!
//! Φ(x) = 1/2 + φ(x) (x + x³/3 + x⁵/(3·5) + ...), whose terms are all of one sign, so nothing
//! cancels. The inverse is Wichura's rational approximation (AS 241, Appl. Stat. 37 (1988) 477),
//! good to sixteen digits.
//!
//! Left out: relative accuracy of Φ far out in the lower tail, where a draw never falls.

/// From here on Φ is 1 to all digits.
const FAR: f64 = 8.3;

/// The share of a standard normal distribution below `x`.
pub fn below(x: f64) -> f64 {
    if x.abs() > FAR {
        return if x > 0.0 { 1.0 } else { 0.0 };
    }
    let (mut term, mut sum) = (x, x);
    let mut odd = 3.0;
    while term.abs() > 1e-17 * sum.abs() {
        term *= x * x / odd;
        sum += term;
        odd += 2.0;
    }
    let density = libm::exp(-0.5 * x * x) / std::f64::consts::TAU.sqrt();
    (0.5 + density * sum).clamp(0.0, 1.0)
}

fn ratio(over: &[f64; 8], under: &[f64; 8], x: f64) -> f64 {
    let at = |of: &[f64; 8]| of.iter().rev().fold(0.0, |sum, c| sum * x + c);
    at(over) / at(under)
}

/// The value below which the share `p` of a standard normal distribution lies; `p` from 0 to 1.
pub fn quantile(p: f64) -> f64 {
    #[rustfmt::skip]
    const MIDDLE: ([f64; 8], [f64; 8]) = (
        [3.387_132_872_796_366_6, 1.331_416_678_917_843_8e2, 1.971_590_950_306_551_4e3,
         1.373_169_376_550_946e4, 4.592_195_393_154_987e4, 6.726_577_092_700_87e4,
         3.343_057_558_358_813e4, 2.509_080_928_730_122_7e3],
        [1.0, 4.231_333_070_160_091e1, 6.871_870_074_920_579e2, 5.394_196_021_424_751e3,
         2.121_379_430_158_66e4, 3.930_789_580_009_271e4, 2.872_908_573_572_194_3e4,
         5.226_495_278_852_854e3],
    );
    #[rustfmt::skip]
    const SIDE: ([f64; 8], [f64; 8]) = (
        [1.423_437_110_749_683_5, 4.630_337_846_156_546, 5.769_497_221_460_691,
         3.647_848_324_763_204_5, 1.270_458_252_452_368_4, 2.417_807_251_774_506e-1,
         2.272_384_498_926_918_4e-2, 7.745_450_142_783_414e-4],
        [1.0, 2.053_191_626_637_759, 1.676_384_830_183_803_8, 6.897_673_349_851e-1,
         1.481_039_764_274_800_8e-1, 1.519_866_656_361_645_7e-2, 5.475_938_084_995_345e-4,
         1.050_750_071_644_416_9e-9],
    );
    #[rustfmt::skip]
    const TAIL: ([f64; 8], [f64; 8]) = (
        [6.657_904_643_501_103, 5.463_784_911_164_114, 1.784_826_539_917_291_3,
         2.965_605_718_285_048_7e-1, 2.653_218_952_657_612_4e-2, 1.242_660_947_388_078_4e-3,
         2.711_555_568_743_487_6e-5, 2.010_334_399_292_288_1e-7],
        [1.0, 5.998_322_065_558_88e-1, 1.369_298_809_227_358e-1, 1.487_536_129_085_061_5e-2,
         7.868_691_311_456_133e-4, 1.846_318_317_510_054_8e-5, 1.421_511_758_316_446e-7,
         2.044_263_103_389_939_8e-15],
    );
    let q = p - 0.5;
    if q.abs() <= 0.425 {
        return q * ratio(&MIDDLE.0, &MIDDLE.1, 0.180_625 - q * q);
    }
    let r = (-libm::log(p.min(1.0 - p))).sqrt();
    let size =
        if r <= 5.0 { ratio(&SIDE.0, &SIDE.1, r - 1.6) } else { ratio(&TAIL.0, &TAIL.1, r - 5.0) };
    size.copysign(q)
}

/// A number of a standard normal distribution, of a well spread sequence: the same for good.
pub fn draw(number: u32, dimension: u32) -> f64 {
    let share = f64::from(sobol_burley::sample(number, dimension, 1));
    quantile(share.clamp(1e-6, 1.0 - 1e-6))
}

/// The value below which the share `u` of a normal distribution cut off at `min` and `max` lies.
pub fn cut_off(mean: f64, sd: f64, (min, max): (f64, f64), u: f64) -> f64 {
    if sd == 0.0 {
        return mean.clamp(min, max);
    }
    let (low, high) = (below((min - mean) / sd), below((max - mean) / sd));
    // A share of 0 or 1 would lie infinitely far out where a bound is too far to be seen.
    let share = (low + u * (high - low)).clamp(1e-300, 1.0 - 1e-16);
    (mean + sd * quantile(share)).clamp(min, max)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_inverse_agrees_with_pythons() {
        for (p, x) in [
            (1e-12, -7.034_483_825_301_132),
            (1e-4, -3.719_016_485_455_68),
            (0.05, -1.644_853_626_951_472_6),
            (0.3, -0.524_400_512_708_040_7),
            (0.5, 0.0),
            (0.9, 1.281_551_565_544_600_8),
            (0.9999, 3.719_016_485_455_708_4),
        ] {
            assert!((quantile(p) - x).abs() <= 4e-15 * x.abs(), "{p}: {}", quantile(p));
        }
    }

    #[test]
    fn the_two_undo_each_other() {
        for i in -60..=60 {
            let x = f64::from(i) * 0.1;
            let error = quantile(below(x)) - x;
            assert!(error.abs() < 1e-7, "{x}: {error}");
            assert!((below(x) + below(-x) - 1.0).abs() < 1e-15);
        }
        assert!((below(1.959_963_984_540_054) - 0.975).abs() < 1e-15);
        assert_eq!((below(-40.0), below(40.0)), (0.0, 1.0));
    }

    #[test]
    fn draws_stay_within_the_bounds_and_keep_their_middle() {
        for u in [0.0, 1e-9, 0.5, 1.0 - 1e-9, 1.0] {
            let x = cut_off(5.0, 100.0, (0.0, 10.0), u);
            assert!((0.0..=10.0).contains(&x));
        }
        assert!((cut_off(300.0, 20.0, (0.0, 1e5), 0.5) - 300.0).abs() < 1e-10);
        assert!(cut_off(0.0, 1.0, (-1e9, 1e9), 1.0).is_finite());
        assert_eq!(cut_off(3.0, 0.0, (0.0, 5.0), 0.9), 3.0);
    }
}
