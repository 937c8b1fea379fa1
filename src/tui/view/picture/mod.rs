//! The eye in filled anatomy: the layers of [`crate::report::picture`] as cells of two colours.
//!
//! The outline at rest and the fat are dots in cells that have one colour else. Without colours
//! thin parts are solid and areas are patterns of dots; in ASCII each cell is the sign of one part.

mod cells;
mod samples;
pub(crate) mod window;

use ratatui::layout::Rect;
use ratatui::style::{Color, Style};
use ratatui::symbols::braille::BRAILLE;
use ratatui::symbols::pixel::{OCTANTS, QUADRANTS};

use crate::report::picture::field::{STEPS, TissueField, step};
use crate::report::picture::{DrawnDetail, POINTS, Part, front, globe_cells, moment};
use crate::run::{drawing::shares, kept::Frame};
use crate::tui::terminal::caps::{Depth, Symbols};
use crate::tui::view::text::{longest_fitting, width};
use crate::tui::view::theme::Theme;
use crate::tui::{look::Look, view::eye::EyePicture, view::sheet::Sheet};
use cells::{Tint, one, two};
use samples::Samples;
use window::Window;

/// From so many columns on a field changes by whole cells, as it does while it moves.
const LARGE: u16 = 100;
/// Columns from which on a moment is said in several words.
const WORDY: u16 = 44;
const BAR_M: f64 = 10e-3;
/// The parts that are named, and their names.
pub const NAMED: [(Part, &str); 8] = [
    (Part::Cornea, "cornea"),
    (Part::Sclera, "sclera"),
    (Part::Retina, "retina"),
    (Part::Iris, "iris"),
    (Part::Lens, "lens"),
    (Part::Ciliary, "ciliary body"),
    (Part::Nerve, "optic nerve"),
    (Part::Bone, "bone"),
];

/// The eye and how it is shown, a frame of it, and what fills the globe with its scale's end.
pub(super) struct Anatomical<'a> {
    pub(super) scene: &'a EyePicture<'a>,
    pub(super) frame: &'a Frame,
    pub(super) field: (TissueField, f64),
}

impl Anatomical<'_> {
    /// Draws the eye with its words above and below, where there is room for them.
    pub(super) fn draw(&self, sheet: &mut Sheet) {
        let (area, symbols) = (sheet.area, sheet.theme.look.symbols);
        let (window, field) = if self.scene.front {
            Window::facing(area, symbols)
        } else {
            Window::within(area, &self.scene.shown.drawing, symbols)
        };
        if field.width == 0 || field.height == 0 {
            return;
        }
        self.paint(&window, &mut sheet.at(field));
        if field.height < area.height {
            if self.scene.front {
                Self::hours(&mut sheet.at(field));
            }
            self.caption(sheet);
            self.scale(&window, sheet);
        }
    }

    /// Points across and down a cell, and what each shows, row by row.
    fn points(&self, area: Rect, window: &Window) -> (usize, usize, Vec<Tint>) {
        let (columns, rows) = (usize::from(area.width), usize::from(area.height));
        // Of a part that fills less than a sign of ASCII, points tell what is lost.
        let (across, down) = match window.points() {
            (1, 1) => (2, 2),
            points => points,
        };
        let (wide, high) = (columns * across, rows * down);
        let (grain, zoom) = (window.grain(), f64::from(self.scene.zoom));
        let shown = self.scene.shown;
        let layers = if self.scene.front {
            let side = shown.scenario.eye_side();
            let stage = moment::stage(&shown.answer, self.scene.time);
            let drawn = (&shown.drawing, self.frame);
            front::layers(drawn, (side, stage), grain).unwrap_or_default()
        } else {
            let detail = DrawnDetail { grain, zoom, points: POINTS };
            shown.anatomy.layers(&shown.drawing, self.frame, detail)
        };
        let samples = Samples::new(&layers, window, [(wide, high), (across, down)]);
        let coarse = self.scene.lean || self.scene.playing || area.width >= LARGE;
        let parts = if coarse { 1 } else { 2 };
        // From the front nothing shows the inside.
        let steps = (!self.scene.front).then(|| self.steps(area, window, parts));
        let blank = blank_cornea(self.scene.front, self.scene.look);
        let tint = |i: usize| {
            let (x, y) = (i % wide, i / wide);
            let part = match samples.point(x, y) {
                Part::Cornea if blank => Part::Pupil,
                part => part,
            };
            let steps = steps.as_ref().filter(|_| part == Part::Globe);
            let step = steps.map_or(0, |steps| steps[y * parts / down * columns + x / across]);
            Tint { part, step }
        };
        (across, down, (0..wide * high).map(tint).collect())
    }

    /// The step of the field in each part of each cell, so many parts a cell from its top down.
    fn steps(&self, area: Rect, window: &Window, parts: usize) -> Vec<usize> {
        let (columns, rows) = (usize::from(area.width), usize::from(area.height) * parts);
        let (drawing, (field, largest)) = (&self.scene.shown.drawing, self.field);
        let values = field.of_nodes(drawing, self.frame);
        let mut found: Vec<Option<usize>> = vec![None; columns * rows];
        let spots = parts as f64;
        for cell in globe_cells(drawing) {
            for nodes in cell.triangles() {
                let zoom = f64::from(self.scene.zoom);
                let corners = nodes.map(|node| drawing.place(self.frame, node, zoom));
                let at = corners.map(|corner| window.cell(corner));
                let span = |of: [f64; 3], most: usize| {
                    let low = of.into_iter().fold(f64::INFINITY, f64::min);
                    let high = of.into_iter().fold(f64::NEG_INFINITY, f64::max);
                    let within = |v: f64| v.clamp(0.0, most as f64) as usize;
                    within(low)..within(high + 1.0)
                };
                for row in span(at.map(|p| p.1 * spots), rows) {
                    for column in span(at.map(|p| p.0), columns) {
                        let middle = (column as f64 + 0.5, (row as f64 + 0.5) / spots);
                        let Some(of) = shares(corners, window.place(middle)) else { continue };
                        if of.iter().all(|share| *share >= -1e-9) {
                            let parts = nodes.iter().zip(of);
                            let value: f64 = parts.map(|(node, of)| values[*node] * of).sum();
                            found[row * columns + column] = Some(step(value, largest));
                        }
                    }
                }
            }
        }
        // What the mesh leaves of the globe along its outline is as its neighbour.
        for _ in 0..2 {
            let before = found.clone();
            for (i, place) in found.iter_mut().enumerate() {
                let near = [i.wrapping_sub(1), i + 1, i.wrapping_sub(columns), i + columns];
                *place = place.or(near.iter().find_map(|n| before.get(*n).copied().flatten()));
            }
        }
        found.into_iter().map(Option::unwrap_or_default).collect()
    }

    fn paint(&self, window: &Window, sheet: &mut Sheet) {
        let (area, theme) = (sheet.area, sheet.theme);
        let (across, down, points) = self.points(area, window);
        let wide = across * usize::from(area.width);
        let dots = self.dots(window, area);
        for row in 0..area.height {
            for column in 0..area.width {
                let (x, y) = (usize::from(column), usize::from(row));
                let place = |i: usize| (y * down + i / across) * wide + x * across + i % across;
                let own: Vec<Tint> = (0..across * down).map(|i| points[place(i)]).collect();
                let edge = |i: usize| {
                    let at = place(i);
                    let near = [at.wrapping_sub(1), at + 1, at.wrapping_sub(wide), at + wide];
                    let other = |n: &usize| points.get(*n).is_some_and(|p| p.part != Part::Lens);
                    own[i].part == Part::Lens && near.iter().any(other)
                };
                let ghost = dots[y * usize::from(area.width) + x];
                let lattice = (column + 2 * row) % 4 == 0 && !self.scene.playing;
                let (symbol, style) = match (theme.look.symbols, theme.look.depth) {
                    (Symbols::Ascii, _) => ascii(one(&own), ghost, lattice, theme),
                    (_, Depth::Mono) => mono(theme.look, &own, edge, ghost, lattice),
                    _ => coloured(&own, ghost, lattice, theme),
                };
                sheet.cell((column, row)).set_char(symbol).set_style(style);
            }
        }
    }

    /// The dots of the outline at rest in each cell, bit by bit along their rows.
    fn dots(&self, window: &Window, area: Rect) -> Vec<u8> {
        let mut dots = vec![0; area.area() as usize];
        for at in self.scene.shown.anatomy.ghost().iter().filter(|_| !self.scene.front) {
            let (x, y) = window.cell(*at);
            let (width, height) = (f64::from(area.width), f64::from(area.height));
            if (0.0..width).contains(&x) && (0.0..height).contains(&y) {
                let bit = 2 * (y.fract() * 4.0) as usize + (x.fract() * 2.0) as usize;
                dots[y as usize * usize::from(area.width) + x as usize] |= 1 << bit;
            }
        }
        dots
    }

    /// The time and what happens then; what fills the globe, and its scale.
    fn caption(&self, sheet: &mut Sheet) {
        let (area, theme) = (sheet.area, sheet.theme);
        let time = format!("{:.2} ms", self.scene.time * 1e3);
        let times = self.scene.zoom;
        let zoom = if times == 1 { String::new() } else { format!(" {times}x larger") };
        let mut x = sheet.put((0, 0), &time, theme.strong());
        let (said, brief) = moment::said(&self.scene.shown.answer, self.scene.time);
        let said = if area.width < WORDY { brief } else { &said };
        let play = if self.scene.playing { " ▶" } else { "" };
        let words = [format!(" {said}{zoom}{play}"), format!(" {said}{zoom}"), zoom, String::new()];
        if self.scene.front {
            let (eye, ..) = self.scene.shown.scenario.eye_side().seen();
            let texts = [format!("{eye} eye, from the front"), "from the front".to_owned()];
            let text = longest_fitting(&texts, area.width.saturating_sub(x + 2));
            sheet.put_right((area.width, 0), text, theme.quiet());
            let words = longest_fitting(&words, area.width.saturating_sub(x + 2 + width(text)));
            sheet.put((x, 0), words, theme.text());
            return;
        }
        let (field, largest) = self.field;
        let end = format!(" {}", field.figure(largest));
        // Without colours the scale is one of signs.
        let signs = match (theme.look.symbols, theme.look.depth) {
            (Symbols::Ascii, _) => String::from_iter(STEPPED),
            (_, Depth::Mono) => DOTTED.map(|bits| dotted(bits, theme.look)).iter().collect(),
            _ => String::new(),
        };
        let colours = match theme.look.depth {
            _ if !signs.is_empty() => 0,
            Depth::TwoFiveSix if area.width >= LARGE => STEPS,
            Depth::TwoFiveSix => STEPS.div_ceil(2),
            _ => 5,
        };
        let name = field.name();
        let starts = [format!("{name} 0 "), format!("{name} "), "0 ".to_owned()];
        let legend = |start: &str| width(start) + width(&signs) + colours as u16 + width(&end);
        let room = area.width.saturating_sub(x + 2);
        let words = longest_fitting(&words, room.saturating_sub(legend(&starts[1])));
        x = sheet.put((x, 0), words, theme.text());
        let room = area.width.saturating_sub(x + 1);
        let Some(start) = starts.iter().find(|start| legend(start) <= room) else { return };
        x = sheet.put((area.width - legend(start), 0), start, theme.quiet());
        x = sheet.put((x, 0), &signs, theme.text());
        for i in 0..colours {
            let last = 2 * (colours - 1);
            let colour = |half: usize| theme.part(Part::Globe, half.min(last) * (STEPS - 1) / last);
            x = sheet.put((x, 0), "▌", Style::new().fg(colour(2 * i)).bg(colour(2 * i + 1)));
        }
        sheet.put_right((area.width, 0), end.trim_start(), theme.quiet());
    }

    /// The hours of the clock that tell the sides.
    fn hours(sheet: &mut Sheet) {
        let (area, theme) = (sheet.area, sheet.theme);
        let (middle, centre) = (area.width / 2, area.height / 2);
        let (right, bottom) = (area.width - 1, area.height - 1);
        let places = [(middle, 0), (right, centre), (middle, bottom), (0, centre)];
        for (at, hour) in places.into_iter().zip(["12", "3", "6", "9"]) {
            sheet.put(at, hour, theme.strong().bg(Color::Reset));
        }
    }

    /// Which way is which, and how long 10 mm are.
    fn scale(&self, window: &Window, sheet: &mut Sheet) {
        let (area, theme) = (sheet.area, sheet.theme);
        let sheet = &mut sheet.row(area.height - 1);
        let side = self.scene.shown.scenario.eye_side();
        let (_, left, right) = if self.scene.front { side.seen() } else { ("", "front", "back") };
        sheet.put((0, 0), left, theme.quiet());
        sheet.put_right((area.width, 0), right, theme.quiet());
        let halves = (2.0 * BAR_M / window.column).round() as usize;
        let bar = "━".repeat(halves / 2) + &"╸".repeat(halves % 2);
        let text = " 10 mm";
        let long = width(&bar) + width(text);
        if long + 12 <= area.width {
            let end = sheet.put(((area.width - long) / 2, 0), &bar, theme.strong());
            sheet.put((end, 0), text, theme.quiet());
        }
    }
}

/// What a cell shows.
type Sign = (char, Style);

/// A cell in two colours, or in one with dots.
fn coloured(own: &[Tint], ghost: u8, lattice: bool, theme: Theme) -> Sign {
    let (mut first, mut second, mut mask) = two(own);
    // What has no colour of its own is the ground.
    let colour = |tint: Tint| theme.part(tint.part, tint.step);
    if mask != 0 && colour(first) == Color::Reset {
        (first, second) = (second, first);
        mask = if own.len() == 8 { !mask } else { !mask & 15 };
    }
    let ground = Style::new().bg(colour(second));
    if mask != 0 && colour(first) != Color::Reset {
        return (block(mask, own.len()), ground.fg(colour(first)));
    }
    let dots = |bits: usize| match theme.look.symbols {
        Symbols::Block => '·',
        _ => BRAILLE[bits],
    };
    match second.part {
        part if ghost != 0 && !part.is_line() => (dots(ghost.into()), ground.fg(theme.ghost(part))),
        Part::Fat if lattice => (dots(LATTICE.into()), ground.patch(theme.fat_dots())),
        _ => (' ', ground),
    }
}

/// The sign of a cell of so many points with some of them set.
fn block(mask: u8, points: usize) -> char {
    if points == 8 { OCTANTS[usize::from(mask)] } else { QUADRANTS[usize::from(mask)] }
}

/// A cell without colours: what is thin is solid, an area a pattern.
fn mono(look: Look, own: &[Tint], edge: impl Fn(usize) -> bool, ghost: u8, lattice: bool) -> Sign {
    let solid = |i: &usize| own[*i].part.is_line() || edge(*i);
    let mask = (0..own.len()).filter(solid).fold(0_u8, |mask, bit| mask | 1 << bit);
    if mask != 0 {
        return (block(mask, own.len()), Style::new());
    }
    let Tint { part, step } = one(own);
    let bits = ghost
        | match part {
            Part::Object | Part::Veil => 0x21,
            Part::Bone => 0x99,
            Part::Nerve => 0xcc,
            Part::Fat if lattice => LATTICE,
            Part::Globe => DOTTED[step * DOTTED.len() / STEPS],
            _ => 0,
        };
    (dotted(bits, look), Style::new())
}

/// Whether the cornea is left blank: from the front, without colours, iris and sclera are told
/// apart by that gap alone.
pub fn blank_cornea(front: bool, look: Look) -> bool {
    front && look.depth == Depth::Mono && look.symbols != Symbols::Ascii
}

/// A part as a key to the picture has it.
pub fn swatch(part: Part, look: Look) -> (String, Style) {
    let theme = Theme::of(look);
    let own = [Tint { part, step: 0 }; 4];
    let (sign, style) = match (look.symbols, look.depth) {
        (Symbols::Ascii, _) => ascii(own[0], 0, true, theme),
        (_, Depth::Mono) => mono(look, &own, |_| part == Part::Lens, 0, true),
        (_, _) if part == Part::Fat => coloured(&own, 0, true, theme),
        _ => ('█', Style::new().fg(theme.part(part, 0))),
    };
    (sign.to_string(), style)
}

/// The field in ASCII, from low to high.
const STEPPED: [char; 5] = [' ', '-', '+', '*', '$'];
/// The field in dots, from low to high.
const DOTTED: [u8; 5] = [0x00, 0x10, 0x21, 0x26, 0x59];
/// The dot of the fat.
const LATTICE: u8 = 0x04;

/// The dots of a cell as a sign.
fn dotted(bits: u8, look: Look) -> char {
    match look.symbols {
        Symbols::Block => [' ', '·', '░', '▒', '▓'][(bits.count_ones() as usize).min(4)],
        _ if bits == 0 => ' ',
        _ => BRAILLE[usize::from(bits)],
    }
}

fn ascii(tint: Tint, ghost: u8, lattice: bool, theme: Theme) -> Sign {
    let Tint { part, step } = tint;
    let sign = match part {
        _ if ghost != 0 && !part.is_line() => ':',
        Part::Sky | Part::Pupil => ' ',
        Part::Object | Part::Veil | Part::Skin => 'o',
        Part::Fat => [' ', '.'][usize::from(lattice)],
        Part::Bone => 'H',
        Part::Nerve => '=',
        Part::Globe => STEPPED[step * 5 / STEPS],
        Part::Ciliary | Part::Limbus => '&',
        Part::Lens => 'O',
        Part::Iris => '|',
        Part::Retina => '%',
        Part::Sclera => '#',
        Part::Cornea => '(',
        Part::Pressed => 'X',
    };
    let style = match part {
        Part::Fat => theme.fat_dots(),
        _ if theme.is_mono() => Style::new(),
        part => Style::new().fg(theme.part(part, step)),
    };
    (sign, if part == Part::Pressed { style.bold() } else { style })
}

#[cfg(test)]
mod tests;
