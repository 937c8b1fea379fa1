//! The retina as a clock face, as an examiner sees it: outside its front edge by the hour, inside
//! the back by quadrants, each with its strain in percent.

use crate::injury::{Injury, PerInjury, points::Point};
use crate::run::sectors::{HOURS, Sectors};
use crate::scenario::Side;
use crate::tui::view::{sheet::Sheet, text::width, theme::Theme};
use ratatui::style::Style;
use std::f64::consts::TAU;

/// Columns and rows that it needs at least.
pub const LEAST: (u16, u16) = (36, 15);
/// Where the rings begin and end, as shares of the radius.
const OUTER: (f64, f64) = (0.66, 1.0);
const INNER: (f64, f64) = (0.28, 0.58);
/// Columns that are as wide as a row is high.
const ASPECT: f64 = 2.0;
/// Rows of heading and legend.
const HEAD: u16 = 1;
const FOOT: u16 = 2;

/// What each mark of shade says without colours, from least to most.
const SHADES: [&str; 3] = ["·", "▒", "▓"];
/// Shares of eyes in each step of the ladder of risk, in the words of the answer; no hour is below
/// the first, as none has a range of its own.
pub const LADDER: [(f64, &str); 3] = [(0.0, "not excluded"), (0.1, "possible"), (0.5, "likely")];

/// Where a ring begins and ends, the point at which half of eyes are hurt there, its strains, and
/// by how many sectors they are turned.
struct Ring<'a> {
    ends: (f64, f64),
    point: Point,
    strains: &'a [f64],
    shift: f64,
}

impl Ring<'_> {
    /// The strain at a turn towards the nose, and how many sectors off its sector's middle that is.
    fn strain(&self, turn: f64) -> (f64, f64) {
        let count = self.strains.len() as f64;
        let at = turn / TAU * count - self.shift;
        let sector = at.round().rem_euclid(count) as usize % self.strains.len();
        (self.strains[sector], at - at.round())
    }

    /// How a strain looks; what is printed alike looks alike.
    fn style(&self, theme: Theme, strain: f64) -> (Style, &'static str) {
        let printed = 0.01 * (100.0 * strain).round();
        style_of(theme, self.point.share(printed / libm::exp10(self.point.log)))
    }
}

/// How a share of eyes that are hurt looks.
fn style_of(theme: Theme, share: f64) -> (Style, &'static str) {
    if theme.is_mono() {
        let step = LADDER.iter().rposition(|(least, _)| share >= *least).unwrap_or(0);
        return (Style::new(), SHADES[step]);
    }
    (theme.told(share).reversed(), " ")
}

/// Hours that differ by less than this share are alike.
const ALIKE: f64 = 0.02;
/// How sure the place is: what clinics found, whatever side their blows came from.
const SURE: [&str; 3] = [
    "The hour is not sure: of 26 detachments after squash balls 81 % lay at the temple \
        (Am J Ophthalmol 1996; 122:260), whatever is computed here.",
    "Hour not sure: of 26 detachments after squash balls 81 % lay at the temple.",
    "Hour not sure: 81 % of 26 seen lay at the temple",
];

/// Draws the strains of an eye, if there is room.
pub fn draw(sectors: &Sectors, points: &PerInjury<Point>, side: Side, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    if area.width < LEAST.0 || area.height < LEAST.1 {
        let room = format!("a fundus needs {} columns by {} rows", LEAST.0, LEAST.1);
        sheet.put((1, 0), &room, theme.quiet());
        return;
    }
    let rows = area.height - HEAD - FOOT;
    // A row above and below holds the hours.
    let radius = (f64::from(rows - 2) / 2.0).min(f64::from(area.width - 8) / 2.0 / ASPECT);
    let centre = (f64::from(area.width) / 2.0, f64::from(HEAD) + f64::from(rows) / 2.0);
    let Sectors { edge, back, .. } = sectors;
    let point = |injury: Injury| points[injury as usize];
    let rings = [
        Ring { ends: OUTER, point: point(Injury::RetinaFront), strains: edge, shift: 0.0 },
        Ring { ends: INNER, point: point(Injury::RetinaBack), strains: back, shift: 0.5 },
    ];
    for y in 0..rows {
        for x in 0..area.width {
            let across = (f64::from(x) + 0.5 - centre.0) / ASPECT;
            let up = centre.1 - (f64::from(y + HEAD) + 0.5);
            let (from, turn) = (across.hypot(up) / radius, across.atan2(up));
            let within = |ring: &&Ring| (ring.ends.0..=ring.ends.1).contains(&from);
            let Some(ring) = rings.iter().find(within) else { continue };
            let (value, off) = ring.strain(side.turn(turn));
            // A dark gap between two sectors, about half a row wide.
            let gap = (0.5 - off.abs()) * TAU / ring.strains.len() as f64 * from * radius;
            if gap > 0.3 {
                let (style, shade) = ring.style(theme, value);
                sheet.put((x, y + HEAD), shade, style);
            }
        }
    }
    let place = |share: f64, turn: f64| {
        let x = centre.0 + ASPECT * radius * share * turn.sin();
        let y = centre.1 - radius * share * turn.cos();
        (x.max(0.0), y.max(0.0) as u16)
    };
    let mut write = |(x, y): (f64, u16), text: &str, style: Style| {
        let left = (x - f64::from(width(text)) / 2.0).round().max(0.0) as u16;
        sheet.put((left, y), text, style);
    };
    for ring in &rings {
        let count = ring.strains.len();
        for turn in (0..count).map(|i| TAU * (i as f64 + ring.shift) / count as f64) {
            let (value, _) = ring.strain(side.turn(turn));
            let (style, _) = ring.style(theme, value);
            let middle = 0.5 * (ring.ends.0 + ring.ends.1);
            write(place(middle, turn), &format!("{:.0}", 100.0 * value), style);
        }
    }
    for hour in 1..=HOURS {
        let outside = place(1.0 + 0.9 / radius, TAU * (hour % HOURS) as f64 / HOURS as f64);
        write(outside, &hour.to_string(), theme.strong());
    }
    let nose = side.turn(0.25 * TAU);
    write(place(0.0, 0.0), "+", theme.text());
    write(place(0.2, nose), "o", theme.text());
    // Heading, sides and legend.
    let (eye, left, right) = side.seen();
    let strongest = Sectors::strongest(edge);
    let hour = side.hour(TAU * strongest as f64 / HOURS as f64);
    let least = edge.iter().copied().fold(f64::INFINITY, f64::min);
    let alike = edge[strongest] - least < ALIKE * edge[strongest];
    let title = format!("Retina, {eye} eye, seen from in front; strain in %");
    sheet.put((1, 0), &title, theme.heading());
    let most = if alike { "all round alike".to_owned() } else { format!("most at {hour} o'clock") };
    if width(&title) + width(&most) + 3 < area.width {
        sheet.put_right((area.width - 1, 0), &most, theme.strong());
    }
    // No screen is too narrow for what the colours mean.
    sheet.put((1, 1), "hurt there:", theme.quiet());
    for (y, (share, text)) in (2..).zip(LADDER) {
        let (style, shade) = style_of(theme, share);
        let after = sheet.put((1, y), format!("{shade}{shade}"), style);
        sheet.put((after + 1, y), text, theme.quiet());
    }
    sheet.put_longest((1, area.height - 1), &SURE, theme.warning());
    let bottom = area.height - FOOT;
    sheet.put((1, bottom), left, theme.quiet());
    sheet.put_right((area.width - 1, bottom), right, theme.quiet());
    let legend = "outer ring: front edge; inner: back; o disc";
    if area.width > width(legend) + 18 {
        sheet.put(((area.width - width(legend)) / 2, bottom), legend, theme.quiet());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::injury::Blow;
    use crate::scenario::library::tests::preset;
    use crate::tui::look::Look;
    use crate::tui::terminal::caps::{Depth, Symbols};
    use ratatui::buffer::{Buffer, Cell};
    use ratatui::layout::Rect;

    fn drawn(side: Side) -> Vec<String> {
        let edge = std::array::from_fn(|i| 0.01 * (i + 10) as f64);
        let sectors = &Sectors { edge, back: [0.01, 0.02, 0.03, 0.04], ..Sectors::default() };
        let area = Rect::new(0, 0, 60, 20);
        let mut buffer = Buffer::empty(area);
        let look = Look::new(Depth::TwoFiveSix, Symbols::Braille);
        let blow = Blow::of(&preset("squash-ball", &[]));
        draw(sectors, &blow.points, side, &mut Sheet::new(&mut buffer, area, look));
        let rows = buffer.content.chunks(area.width.into());
        rows.map(|row| row.iter().map(Cell::symbol).collect()).collect()
    }

    #[test]
    fn the_nasal_hour_lies_at_3_of_a_right_eye_and_at_9_of_a_left_one() {
        // Sector 3 is the nose, 13 %; sector 9 the temple, 19 %.
        let places = |side| {
            let rows = drawn(side);
            let row = rows.iter().find(|row| row.contains("13") && row.contains("19")).unwrap();
            ["13", "19"].map(|figure| row.find(figure).unwrap())
        };
        let (right, left) = (places(Side::Right), places(Side::Left));
        assert!(right[0] > right[1] && left[0] < left[1]);
        assert!(drawn(Side::Left)[0].contains("left eye"));
    }

    #[test]
    fn every_figure_of_both_rings_is_there() {
        let all = drawn(Side::Right).join("\n");
        for figure in 10..22 {
            assert!(all.contains(&figure.to_string()), "{figure}\n{all}");
        }
    }
}
