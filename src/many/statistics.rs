//! Quantiles and rank correlations of a few hundred or thousand numbers.
//!
//! A quantile interpolates between the two order statistics next to (n - 1) p. Spearman's rank
//! correlation is Pearson's of the ranks, where equal numbers share the mean of their ranks.
//!
//! Left out: confidence intervals, which do not hold for draws of low discrepancy.

/// The quantile `p`, 0 to 1, of sorted numbers; none of an empty list.
pub fn quantile(sorted: &[f64], p: f64) -> Option<f64> {
    let last = sorted.len().checked_sub(1)?;
    let at = last as f64 * p;
    let low = at.floor() as usize;
    let (a, b) = (sorted[low], sorted[(low + 1).min(last)]);
    // The difference of infinite ones is no number.
    let between = at.fract() > 0.0 && a != b;
    Some(if between { a + (b - a) * at.fract() } else { a })
}

/// The median; none of an empty list.
pub fn median(mut of: Vec<f64>) -> Option<f64> {
    of.sort_by(f64::total_cmp);
    quantile(&of, 0.5)
}

/// The rank of each number, from 0; equal ones share the mean of their ranks.
fn ranks(of: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..of.len()).collect();
    order.sort_by(|&a, &b| of[a].total_cmp(&of[b]));
    let mut ranks = vec![0.0; of.len()];
    let mut from = 0;
    for same in order.chunk_by(|&a, &b| of[a] == of[b]) {
        for &i in same {
            ranks[i] = 0.5 * (2 * from + same.len() - 1) as f64;
        }
        from += same.len();
    }
    ranks
}

/// Spearman's rank correlation, from -1 to 1; 0 where one of the two never changes.
pub fn rank_correlation(x: &[f64], y: &[f64]) -> f64 {
    let (x, y) = (ranks(x), ranks(y));
    let middle = 0.5 * (x.len() as f64 - 1.0);
    let product = |(a, b): (&f64, &f64)| (a - middle) * (b - middle);
    let of = |x: &[f64], y: &[f64]| x.iter().zip(y).map(product).sum::<f64>();
    let (xy, xx, yy) = (of(&x, &y), of(&x, &x), of(&y, &y));
    if xx > 0.0 && yy > 0.0 { xy / (xx * yy).sqrt() } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn quantiles_interpolate() {
        let of = [1.0, 2.0, 4.0, 8.0, 16.0];
        let at = [0.0, 0.5, 0.875, 1.0].map(|p| quantile(&of, p));
        assert_eq!(at, [1.0, 4.0, 12.0, 16.0].map(Some));
        assert_eq!(quantile(&[], 0.5), None);
        assert_eq!(median(vec![9.0, 1.0, 4.0, 2.0]), Some(3.0));
        assert_eq!(median(vec![f64::INFINITY; 2]), Some(f64::INFINITY));
    }

    #[test]
    fn ranks_see_order_alone() {
        let x = [3.0, 1.0, 2.0, 10.0];
        let cubes = x.map(|v: f64| v.powi(3));
        assert_eq!(rank_correlation(&x, &cubes), 1.0);
        assert_eq!(rank_correlation(&x, &x.map(|v| -v)), -1.0);
        assert_eq!(rank_correlation(&x, &[5.0; 4]), 0.0);
        // By hand: ranks 0 1 2 3 and 0.5 0.5 2 3 give 4.5 / sqrt(5 * 4.5).
        let r = rank_correlation(&[1.0, 2.0, 3.0, 4.0], &[7.0, 7.0, 8.0, 9.0]);
        assert!((r - 4.5 / 22.5_f64.sqrt()).abs() < 1e-15);
    }
}
