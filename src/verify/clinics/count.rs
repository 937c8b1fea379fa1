//! The chance of a count: beta-binomial, as series differ by more than chance.

use libm::{lgamma, log};

/// ln of a beta-binomial chance of `hurt` of `eyes`, and its slope over the share.
pub(super) fn beta_binomial(hurt: f64, eyes: f64, share: f64, concentration: f64) -> (f64, f64) {
    let p = share.clamp(1e-5, 1.0 - 1e-5);
    let (a, b) = (p * concentration, (1.0 - p) * concentration);
    let beta = |a: f64, b: f64| lgamma(a) + lgamma(b) - lgamma(a + b);
    let choose = lgamma(eyes + 1.0) - lgamma(hurt + 1.0) - lgamma(eyes - hurt + 1.0);
    let value = choose + beta(hurt + a, eyes - hurt + b) - beta(a, b);
    let slope = digamma(hurt + a) - digamma(eyes - hurt + b) - digamma(a) + digamma(b);
    let clamped = p != share;
    (value, if clamped { 0.0 } else { concentration * slope })
}

/// Slope of ln gamma, by its recurrence and its asymptotic series.
fn digamma(mut x: f64) -> f64 {
    let mut sum = 0.0;
    while x < 8.0 {
        sum -= 1.0 / x;
        x += 1.0;
    }
    let y = 1.0 / (x * x);
    sum + log(x) - 0.5 / x - y * (1.0 / 12.0 - y * (1.0 / 120.0 - y * (1.0 / 252.0 - y / 240.0)))
}
