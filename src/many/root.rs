//! Where a function of one number is zero, from two numbers between which it changes its sign.
//!
//! The method is ITP (Oliveira and Takahashi 2020): the secant's guess, moved towards the middle
//! and held near it, so that it never takes more than one step more than halving would and on
//! smooth functions far fewer. With n = ceil(log2((b - a) / 2e)) halvings needed, the guess of
//! step k stays within r = e 2^(n + 1 - k) - (b - a) / 2 of the middle.
//!
//! Left out: functions that touch zero without crossing it, which no change of sign tells.

/// Weight of the move towards the middle, over the first bracket; its power is 2.
const MOVE: f64 = 0.2;

/// The ends of a bracket, each with the value there, whose signs differ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bracket {
    pub low: (f64, f64),
    pub high: (f64, f64),
}

impl Bracket {
    pub fn middle(&self) -> f64 {
        0.5 * (self.low.0 + self.high.0)
    }

    /// Where the line between the ends is zero, or the middle where that is no number.
    pub fn secant(&self) -> f64 {
        let ((a, fa), (b, fb)) = (self.low, self.high);
        let at = (fb * a - fa * b) / (fb - fa);
        if (a..=b).contains(&at) { at } else { self.middle() }
    }
}

/// Narrows a bracket of a root of `value` to `width`; exactly zero counts as above zero.
pub fn narrowed<E>(
    bracket: Bracket,
    width: f64,
    mut value: impl FnMut(f64) -> Result<f64, E>,
) -> Result<Bracket, E> {
    let mut now = bracket;
    let whole = now.high.0 - now.low.0;
    let tolerance = 0.5 * width;
    let halvings = libm::log2(whole / width).ceil().max(0.0) as i32;
    for step in 0..=halvings + 1 {
        let span = now.high.0 - now.low.0;
        if span <= width {
            break;
        }
        let middle = now.middle();
        let guess = now.secant();
        let side = if middle >= guess { 1.0 } else { -1.0 };
        let moved = MOVE / whole * span * span;
        let moved = if moved <= (middle - guess).abs() { guess + side * moved } else { middle };
        let most = (tolerance * libm::exp2(f64::from(halvings + 1 - step)) - 0.5 * span).max(0.0);
        let at = if (moved - middle).abs() <= most { moved } else { middle - side * most };
        // Between two neighbours there is nothing more to find.
        if at <= now.low.0 || at >= now.high.0 {
            break;
        }
        let found = (at, value(at)?);
        let same_sign = (found.1 < 0.0) == (now.low.1 < 0.0);
        *(if same_sign { &mut now.low } else { &mut now.high }) = found;
    }
    Ok(now)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The root between two numbers, and how often the function was asked.
    fn root(f: impl Fn(f64) -> f64, (a, b): (f64, f64), width: f64) -> (f64, u32) {
        let mut asked = 0;
        let bracket = Bracket { low: (a, f(a)), high: (b, f(b)) };
        let found = narrowed(bracket, width, |x| {
            asked += 1;
            Ok::<_, ()>(f(x))
        });
        let found = found.unwrap();
        assert!(found.high.0 - found.low.0 <= width);
        assert!((found.low.1 < 0.0) != (found.high.1 < 0.0));
        (found.middle(), asked)
    }

    #[test]
    fn roots_of_smooth_and_rough_functions_are_bracketed_within_the_halvings() {
        type Case = (fn(f64) -> f64, (f64, f64), f64);
        let cases: [Case; 6] = [
            (|x| x * x - 2.0, (0.0, 2.0), 2.0_f64.sqrt()),
            (|x| (x - 3.0).powi(9), (-1.0, 20.0), 3.0),
            (|x| 0.5 - x.exp() / 100.0, (0.0, 10.0), 50.0_f64.ln()),
            (|x| if x < 0.7 { -1.0 } else { 1e9 }, (0.0, 1.0), 0.7),
            (|x| (x - 1e-3).cbrt(), (0.0, 500.0), 1e-3),
            (|x| x.atan() - 1.0, (-50.0, 60.0), 1.0_f64.tan()),
        ];
        for (f, ends, expected) in cases {
            let width = 1e-6;
            let (found, asked) = root(f, ends, width);
            assert!((found - expected).abs() <= width, "{found} {expected}");
            let halvings = ((ends.1 - ends.0) / width).log2().ceil();
            assert!(f64::from(asked) <= halvings + 2.0, "{asked} of {halvings}");
        }
        let (_, asked) = root(|x| x.exp() - 50.0, (0.0, 10.0), 1e-9);
        assert!(asked <= 16, "{asked} where halving takes 34, of a smooth function");
    }

    #[test]
    fn what_cannot_be_computed_ends_the_search() {
        let bracket = Bracket { low: (0.0, -1.0), high: (1.0, 1.0) };
        assert_eq!(narrowed(bracket, 1e-3, |_| Err("no")), Err("no"));
    }
}
