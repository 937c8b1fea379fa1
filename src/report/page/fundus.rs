//! The retina as a clock face on a page, as an examiner in front of the patient sees it: its front
//! edge by the hour around its back by quadrants, with the strain of each in percent.

use crate::injury::{Injury, PerInjury, points::Point};
use crate::run::sectors::{HOURS, QUADRANTS, Sectors};
use crate::scenario::Side;
use maud::{Markup, html};
use std::f64::consts::TAU;

/// Radii of the rings, in units of the picture, and its half width.
const OUTER: (f64, f64) = (92.0, 140.0);
const INNER: (f64, f64) = (38.0, 84.0);
const HALF: f64 = 170.0;
/// Where the hours stand.
const NAMES: f64 = 156.0;
/// Gap between two sectors, in rad.
const GAP: f64 = 0.02;

/// A sector of a ring from one turn of the clock to another.
fn sector((inner, outer): (f64, f64), (from, to): (f64, f64)) -> String {
    let at = |radius: f64, turn: f64| {
        let (x, y) = (radius * libm::sin(turn), -radius * libm::cos(turn));
        format!("{x:.1} {y:.1}")
    };
    let [a, b, c, d] = [at(outer, from), at(outer, to), at(inner, to), at(inner, from)];
    format!("M{a} A{outer} {outer} 0 0 1 {b} L{c} A{inner} {inner} 0 0 0 {d}Z")
}

/// The app's ladder of risk on paper: its colour, that of a figure on it, from which share of eyes
/// on, and its words. No hour is below the first, as none has a range of its own.
const LADDER: [(&str, &str, f64, &str); 3] = [
    ("#f0d264", "#222", 0.0, "not excluded"),
    ("#e8862e", "#222", 0.1, "possible"),
    ("#c2352c", "#fff", 0.5, "likely"),
];

/// The colour of a share of eyes that are hurt, and that of a figure on it.
fn colours(share: f64) -> (&'static str, &'static str) {
    let step = LADDER.iter().rev().find(|(_, _, least, _)| share >= *least).unwrap_or(&LADDER[0]);
    (step.0, step.1)
}

/// Words at a turn of the clock.
fn text(radius: f64, turn: f64, ink: &str, words: &str) -> Markup {
    let (x, y) = (radius * libm::sin(turn), 5.0 - radius * libm::cos(turn));
    html! { text x=(format!("{x:.1}")) y=(format!("{y:.1}")) fill=(ink) { (words) } }
}

/// What the colours mean, and how sure an hour is, in the corners.
fn legend() -> Markup {
    let rows = (0..).zip(LADDER).map(|(i, (ground, _, _, words))| (14 * i - 166, ground, words));
    html! {
        g font-size="10" text-anchor="start" fill="#555" {
            @for (top, ground, words) in rows {
                rect x="-168" y=(top) width="10" height="10" fill=(ground) {}
                text x="-154" y=(top + 9) { (words) }
            }
        }
        text y="169" font-size="8.5" fill="#555" {
            "hour not sure: after squash balls 81 % of 26 detachments lay at the temple"
        }
    }
}

pub fn figure(sectors: &Sectors, points: &PerInjury<Point>, side: Side) -> Markup {
    let ring = |(injury, values): (Injury, &[f64]), ring: (f64, f64), shift: f64| {
        let point = &points[injury as usize];
        let width = TAU / values.len() as f64;
        let one = |(i, value): (usize, &f64)| {
            let turn = side.turn((i as f64 + shift) * width);
            let path = sector(ring, (turn - 0.5 * width + GAP, turn + 0.5 * width - GAP));
            let (ground, ink) = colours(point.share(value / libm::exp10(point.log)));
            html! {
                path d=(path) fill=(ground) {}
                (text(0.5 * (ring.0 + ring.1), turn, ink, &format!("{:.0}", 100.0 * value)))
            }
        };
        values.iter().enumerate().map(one).collect::<Vec<_>>()
    };
    let hours = (1..=HOURS).map(|hour| {
        let turn = TAU * hour as f64 / HOURS as f64;
        text(NAMES, turn, "#777", &hour.to_string())
    });
    let (eye, left, right) = side.seen();
    debug_assert_eq!(sectors.back.len(), QUADRANTS);
    html! {
        figure {
            figcaption {
                "Retina of the " (eye) " eye, seen from in front: largest strain in %, outside its \
                 front edge, inside its back; " (left) " at the left, " (right) " at the right"
            }
            svg viewBox=(format!("-{HALF} -{HALF} {0} {0}", 2.0 * HALF)) width="340"
                font-size="13" text-anchor="middle" font-family="sans-serif" {
                @for part in ring((Injury::RetinaFront, &sectors.edge), OUTER, 0.0) { (part) }
                @for part in ring((Injury::RetinaBack, &sectors.back), INNER, 0.5) { (part) }
                @for hour in hours { (hour) }
                (legend())
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::injury::Blow;
    use crate::scenario::library::tests::preset;

    #[test]
    fn every_sector_has_its_figure_and_the_colour_of_its_risk() {
        let mut sectors = Sectors::default();
        for (i, value) in sectors.edge.iter_mut().enumerate() {
            *value = 0.01 * (20 + i) as f64;
        }
        let blow = Blow::of(&preset("squash-ball", &[]));
        let page = figure(&sectors, &blow.points, Side::Left).into_string();
        for i in 20..32 {
            assert!(page.contains(&format!(">{i}<")), "{i}");
        }
        assert!(page.contains("not excluded") && page.contains(LADDER[2].0), "{page}");
        assert!(page.contains("left eye"));
    }
}
