//! The points of a cell in the two colours that lose least of them.

use crate::report::picture::Part;

/// What a point shows; of the globe, with the step of its field.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Tint {
    pub part: Part,
    pub step: usize,
}

/// What it costs to show a point as another: to lose a thin part, or to turn inside to outside.
fn cost(of: Tint, shown: Tint) -> f64 {
    let line = |tint: Tint| tint.part.is_line();
    if of == shown {
        return 0.0;
    }
    match (of.part, shown.part) {
        (Part::Globe, Part::Globe) => 0.15 + 0.05 * of.step.abs_diff(shown.step) as f64,
        (Part::Retina, _) if line(shown) => 1.1,
        (_, Part::Retina) if line(of) => 0.9,
        (Part::Retina, _) => 2.0,
        _ if line(of) && line(shown) => 0.55,
        _ if line(of) => 2.5,
        _ if line(shown) => 1.0,
        (a, b) if a.is_inside() != b.is_inside() => 3.0,
        _ => 0.45,
    }
}

/// The two tints of a cell, the first where a bit of the mask is set; alike where one will do.
pub(super) fn two(points: &[Tint]) -> (Tint, Tint, u8) {
    let loss = |pair: (Tint, Tint)| -> f64 {
        let least = |of: &Tint| cost(*of, pair.0).min(cost(*of, pair.1));
        points.iter().map(least).sum()
    };
    let mut best = (points[0], points[0]);
    let mut least = loss(best);
    for (i, &a) in points.iter().enumerate() {
        for &b in &points[i..] {
            let lost = loss((a, b));
            if lost < least - 1e-9 {
                (best, least) = ((a, b), lost);
            }
        }
    }
    let first = |of: &Tint| best.0 != best.1 && cost(*of, best.0) < cost(*of, best.1);
    let bits = points.iter().enumerate().filter(|(_, of)| first(of));
    (best.0, best.1, bits.fold(0, |mask, (bit, _)| mask | 1 << bit))
}

/// The one tint of a cell that has room for no more.
pub(super) fn one(points: &[Tint]) -> Tint {
    let loss = |shown: Tint| -> f64 { points.iter().map(|of| cost(*of, shown)).sum() };
    let by = |a: &&Tint, b: &&Tint| loss(**a).total_cmp(&loss(**b));
    points.iter().min_by(by).copied().unwrap_or(points[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_thin_part_is_kept_and_the_inside_never_shows_as_the_outside() {
        let parts = [Part::Globe, Part::Sky, Part::Sclera, Part::Fat];
        let [globe, sky, sclera, fat] = parts.map(|part| Tint { part, step: 0 });
        let (a, b, mask) = two(&[sclera, globe, sky, globe]);
        assert!([a, b].contains(&sclera) && [a, b].contains(&globe), "{a:?} {b:?}");
        // What does not fit beside them becomes a part of the shell, not of the inside.
        let shell = if a == sclera { 0b0101 } else { 0b1010 };
        assert_eq!(mask, shell);
        let (a, b, _) = two(&[fat, globe, sky, globe]);
        assert!([a, b].contains(&globe) && a != b);
        assert_eq!(two(&[fat; 4]).2, 0);
        assert_eq!(one(&[globe, sclera, globe, sclera]), sclera);
        assert_eq!(one(&[globe, globe, globe, fat]), globe);
    }
}
