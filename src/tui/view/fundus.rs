//! The retina as a clock face, as an examiner in front of the patient sees it: the outer ring is
//! its front edge by the hour, the inner ring the back by quadrants, each with its strain in
//! percent.

use crate::run::sectors::{HOURS, Sectors};
use crate::scenario::Side;
use crate::tui::view::{sheet::Sheet, text::width, theme::Theme};
use ratatui::style::{Color, Style};
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
const FOOT: u16 = 1;

/// What each mark of shade says without colours, from least to most.
const SHADES: [&str; 4] = ["·", "░", "▒", "▓"];

/// What is drawn.
pub struct Fundus<'a> {
    /// The strains.
    pub sectors: &'a Sectors,
    /// Which eye.
    pub side: Side,
}

impl Fundus<'_> {
    /// The place of a sector of so many, counted towards the nose, that lies at this turn of the
    /// clock, and how far from its middle that is, in sectors.
    fn sector(&self, turn: f64, count: usize, shift: f64) -> (usize, f64) {
        let turn = self.side.turn(turn);
        let at = turn / TAU * count as f64 - shift;
        ((at.round().rem_euclid(count as f64)) as usize % count, at - at.round())
    }

    /// The strains, whose scale is that of the greatest.
    fn most(&self) -> f64 {
        let all = self.sectors.edge.iter().chain(&self.sectors.back);
        all.copied().fold(0.0, f64::max)
    }

    fn style(theme: Theme, share: f64) -> (Style, &'static str) {
        let steps = theme.heat_steps();
        let step = 1 + ((share * steps as f64) as usize).min(steps - 1);
        let shade = SHADES[((share * SHADES.len() as f64) as usize).min(SHADES.len() - 1)];
        if theme.is_mono() {
            return (Style::new(), shade);
        }
        let colour = theme.heat(step).fg.unwrap_or(Color::Reset);
        (Style::new().bg(colour).fg(Color::Black), " ")
    }

    /// Draws it into the middle of `area`, if there is room.
    pub fn draw(&self, sheet: &mut Sheet) {
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
        let most = self.most().max(f64::MIN_POSITIVE);
        for y in 0..rows {
            for x in 0..area.width {
                let across = (f64::from(x) + 0.5 - centre.0) / ASPECT;
                let up = centre.1 - (f64::from(y + HEAD) + 0.5);
                let (from, turn) = (across.hypot(up) / radius, across.atan2(up));
                let Some((value, off, count)) = self.at(from, turn) else {
                    continue;
                };
                // A dark gap between two sectors, about half a row wide.
                let gap = (0.5 - off.abs()) * TAU / count as f64 * from * radius;
                if gap > 0.3 {
                    let (style, shade) = Self::style(theme, value / most);
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
        let middle = |(from, to): (f64, f64)| 0.5 * (from + to);
        let figure = |value: f64| format!("{:.0}", 100.0 * value);
        for hour in 0..HOURS {
            let turn = TAU * hour as f64 / HOURS as f64;
            let value = self.sectors.edge[self.sector(turn, HOURS, 0.0).0];
            let (style, _) = Self::style(theme, value / most);
            write(place(middle(OUTER), turn), &figure(value), style);
            let name = if hour == 0 { HOURS } else { hour }.to_string();
            let outside = 1.0 + 0.9 / radius;
            write(place(outside, turn), &name, theme.strong());
        }
        for quarter in 0..4 {
            let turn = TAU * (f64::from(quarter) + 0.5) / 4.0;
            let value = self.sectors.back[self.sector(turn, 4, 0.5).0];
            let (style, _) = Self::style(theme, value / most);
            write(place(middle(INNER), turn), &figure(value), style);
        }
        let nose = self.side.turn(0.25 * TAU);
        write(place(0.0, 0.0), "+", theme.text());
        write(place(0.2, nose), "o", theme.text());
        self.words(sheet);
    }

    /// The strain at a share of the radius and a turn of the clock, the distance from the middle
    /// of its sector, in sectors, and how many there are.
    fn at(&self, from: f64, turn: f64) -> Option<(f64, f64, usize)> {
        let within = |(low, high): (f64, f64)| (low..=high).contains(&from);
        if within(OUTER) {
            let (sector, off) = self.sector(turn, HOURS, 0.0);
            Some((self.sectors.edge[sector], off, HOURS))
        } else if within(INNER) {
            let (sector, off) = self.sector(turn, 4, 0.5);
            Some((self.sectors.back[sector], off, 4))
        } else {
            None
        }
    }

    /// Heading, sides and legend.
    fn words(&self, sheet: &mut Sheet) {
        let (area, theme) = (sheet.area, sheet.theme);
        let (eye, left, right) = self.side.seen();
        let hour = Sectors::strongest(&self.sectors.edge);
        let hour = self.side.hour(TAU * hour as f64 / HOURS as f64);
        let title = format!("Retina, {eye} eye, seen from in front; strain in %");
        sheet.put((1, 0), &title, theme.heading());
        let most = format!("most at {hour} o'clock");
        if width(&title) + width(&most) + 3 < area.width {
            sheet.put_right((area.width - 1, 0), &most, theme.strong());
        }
        let bottom = area.height - 1;
        sheet.put((1, bottom), left, theme.quiet());
        sheet.put_right((area.width - 1, bottom), right, theme.quiet());
        let legend = "outer ring: front edge; inner: back; o disc";
        if area.width > width(legend) + 18 {
            let x = (area.width - width(legend)) / 2;
            sheet.put((x, bottom), legend, theme.quiet());
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tui::look::Look;
    use crate::tui::terminal::caps::{Depth, Symbols};
    use ratatui::buffer::Buffer;
    use ratatui::layout::Rect;

    fn drawn(side: Side) -> Vec<String> {
        let mut sectors = Sectors::default();
        for (i, value) in sectors.edge.iter_mut().enumerate() {
            *value = 0.01 * (i + 10) as f64;
        }
        sectors.back = [0.01, 0.02, 0.03, 0.04];
        let area = Rect::new(0, 0, 60, 20);
        let mut buffer = Buffer::empty(area);
        let look = Look::new(Depth::TwoFiveSix, Symbols::Braille);
        let sectors = &sectors;
        Fundus { sectors, side }.draw(&mut Sheet::new(&mut buffer, area, look));
        let row = |y| (0..area.width).map(move |x| (x, y));
        let text = |y| row(y).map(|at| buffer[at].symbol().to_owned()).collect();
        (0..area.height).map(text).collect()
    }

    #[test]
    fn the_nasal_hour_lies_at_3_of_a_right_eye_and_at_9_of_a_left_one() {
        let middle = |side| drawn(side)[10].clone();
        // Sector 3 is the nose, 13 %; sector 9 the temple, 19 %.
        let places = |side| {
            let row = middle(side);
            (row.find("13").unwrap(), row.find("19").unwrap())
        };
        let (right, left) = (places(Side::Right), places(Side::Left));
        assert!(right.0 > right.1 && left.0 < left.1);
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
