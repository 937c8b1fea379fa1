//! The eye at one moment: its anatomy, or its mesh in lines or nodes coloured by force, with orbit,
//! arc and arrow of the blow.
//!
//! Parts are told apart by pattern as well as by colour: orbit, shell, lens and what is hot are
//! solid, the retina is double, the inside dotted and fat dotted thinly.

use nalgebra::Point2;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::report::picture::field::TissueField;
use crate::report::picture::{Part, object_sides};
use crate::run::drawing::{Drawing, Line};
use crate::run::kept::{Frame, nearest};
use crate::run::{places::Region, quantity::Quantity};
use crate::scenario::{Impact, Scenario, direction::HOURS};
use crate::tui::view::heat::{heat_glyph, step_of, thresholds};
use crate::tui::view::raster::{Ink, Raster};
use crate::tui::view::{picture::Anatomical, picture::window::Window};
use crate::tui::view::{sheet::Sheet, text::width, theme::Theme};
use crate::tui::{clock::MeshDetail, look::Look, model::AppModel, shown::ShownAnswer};

/// Where the arrow of the blow begins and ends, and where its arc is drawn, in m.
const ARROW_M: (f64, f64) = (19.0e-3, 13.6e-3);
const ARC_M: f64 = 13.0e-3;

/// What lies at the top of a section that nothing turns.
const UP: &str = "up";

/// Ranks of what lies over what.
const COLD: u8 = 1;
const STRUCTURE: u8 = 2;
const HOT: u8 = 10;
const BLOW: u8 = 30;

/// The dots of a node: of a cold one the first, of a warm one four, of a hot one all.
const WARM: [(i32, i32); 4] = [(0, 0), (1, 0), (0, 1), (1, 1)];
const HOTTER: [(i32, i32); 8] =
    [(-1, 0), (-1, 1), (2, 0), (2, 1), (0, -1), (1, -1), (0, 2), (1, 2)];

/// What is drawn.
#[expect(clippy::struct_excessive_bools, reason = "each is a fact of its own")]
pub struct EyePicture<'a> {
    /// The result that is shown.
    pub shown: &'a ShownAnswer,
    /// The moment, in s.
    pub time: f64,
    /// The largest force of the colour scale, in N.
    pub largest: f64,
    /// What fills the globe of the anatomy, and the end of its scale.
    pub field: Option<(TissueField, f64)>,
    /// How many times displacement is shown.
    pub zoom: u32,
    /// How much of the mesh.
    pub detail: MeshDetail,
    /// The blow that the arrow stands for, which may be newer than the result.
    pub blow: Option<&'a Scenario>,
    /// Whether the arrow has the focus.
    pub aiming: bool,
    /// Whether it moves.
    pub playing: bool,
    /// Whether few bytes matter more than every spring.
    pub lean: bool,
    /// Whether the anatomy is seen from the front and not cut.
    pub front: bool,
    /// How things are drawn.
    pub look: Look,
}

impl<'a> EyePicture<'a> {
    /// An answer as the app shows it at a time, in s.
    pub fn of(model: &AppModel, shown: &'a ShownAnswer, time: f64) -> Self {
        Self {
            shown,
            time,
            largest: shown.hottest,
            field: model.clock.field(&shown.fields),
            zoom: model.clock.zoom(),
            detail: model.clock.detail(shown.drawing.object.is_some()),
            blow: None,
            aiming: false,
            playing: model.clock.playing,
            // Few bytes while it moves over a slow link.
            lean: model.slow_link && model.clock.playing,
            front: false,
            look: model.look,
        }
    }

    /// Draws the eye as large as fits into the middle of `area`.
    pub fn draw(&self, area: Rect, buffer: &mut Buffer) {
        let sheet = &mut Sheet::new(buffer, area, self.look);
        let theme = sheet.theme;
        let frames = &self.shown.answer.run.frames;
        let Some(frame) = frames.get(nearest(frames, self.time)) else { return };
        if let (MeshDetail::Anatomy, Some(field)) = (self.detail, self.field) {
            Anatomical { scene: self, frame, field }.draw(sheet);
            // An object shows by itself where it comes from.
            if self.aiming || self.shown.drawing.object.is_none() {
                let mut raster = Raster::new(area, self.look.symbols);
                let (across, down) = raster.grain();
                let (window, field) = if self.front {
                    Window::facing(area, self.look.symbols)
                } else {
                    Window::within(area, &self.shown.drawing, self.look.symbols)
                };
                let dot = |at| {
                    let (x, y) = window.cell(at);
                    let below = f64::from(field.y - area.y);
                    (x * f64::from(across), (y + below) * f64::from(down))
                };
                self.arrow(theme, &mut raster, dot);
                raster.paint(sheet.buffer);
            }
            let up = self.up();
            if !self.front && up != UP && area.height > 2 {
                // A large object may lie behind it.
                sheet.put((0, 1), up, Style::reset().patch(theme.text()));
            }
            return;
        }
        let mut raster = Raster::new(area, self.look.symbols);
        let picture = Picture::new(self, frame, theme, &raster);
        picture.springs(&mut raster);
        if self.detail == MeshDetail::Nodes {
            picture.nodes(&mut raster);
        }
        picture.blow(&mut raster);
        self.arrow(theme, &mut raster, |at| picture.dot(at));
        raster.paint(sheet.buffer);
        if theme.is_mono() {
            picture.digits(&raster, sheet.buffer);
        }
        if !self.lean {
            picture.monitors(&raster, sheet.buffer);
        }
        directions(self.up(), sheet);
    }

    /// What lies at the top of the picture, which is cut along the blow.
    fn up(&self) -> &'static str {
        // The eye on show may be that of the blow before.
        self.blow.and_then(|_| self.shown.scenario.top()).unwrap_or(UP)
    }

    /// The arrow points along the blow; short bars mark the ends of the arc that was asked for.
    fn arrow(&self, theme: Theme, raster: &mut Raster, dot: impl Fn(Point2<f64>) -> (f64, f64)) {
        let polar =
            |angle: f64, radius: f64| dot(Point2::new(-radius * angle.cos(), radius * angle.sin()));
        let Some(blow) = self.blow else { return };
        let (angle, half) = match &blow.impact {
            Impact::Projectile(object) if self.front => {
                // From the hour, which a blow straight on has none of; from 9 o'clock it is 0.
                if object.angle_deg == 0.0 {
                    return;
                }
                (90.0 + object.angle_clock * 360.0 / HOURS, None)
            }
            Impact::ForcePulse(pulse) => (pulse.angle_deg, Some(pulse.half_width_deg)),
            Impact::Projectile(object) if blow.comes_from_top() => (object.angle_deg, None),
            Impact::Projectile(object) => (-object.angle_deg, None),
        };
        let angle = angle.to_radians();
        let style = if self.aiming { theme.load().bold() } else { theme.load() };
        let ink = Ink::solid(style, BLOW, '*');
        let (tail, tip) = ARROW_M;
        raster.line(polar(angle, tail), polar(angle, tip), ink);
        for side in [-0.14, 0.14] {
            raster.line(polar(angle + side, tip + 2.2e-3), polar(angle, tip), ink);
        }
        let half = half.map(f64::to_radians).into_iter();
        for end in half.flat_map(|half| [angle - half, angle + half]) {
            raster.line(polar(end, ARC_M - 0.6e-3), polar(end, ARC_M + 1.6e-3), ink);
        }
    }
}

/// Which way is which, in the corners that the eye leaves free.
fn directions(up: &str, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    if area.width < 14 || area.height == 0 {
        return;
    }
    // The last column may be that of a margin.
    let (right, bottom) = (area.width - 5, area.height - 1);
    for (word, x, y) in [("front", 0, bottom), ("back", right, bottom), (up, 0, 0)] {
        if (x..x + width(word)).all(|x| sheet.cell((x, y)).symbol().trim().is_empty()) {
            sheet.put((x, y), word, theme.quiet());
        }
    }
}

/// The angle in radians of a blow from the direction of a cell, where the eye is drawn in `area`.
pub fn angle_at(area: Rect, model: &AppModel, shown: &ShownAnswer, at: (u16, u16)) -> f64 {
    let along = |cell: u16, first: u16| f64::from(cell) - f64::from(first) + 0.5;
    let (x, y) = (along(at.0, area.x), along(at.1, area.y));
    if model.clock.detail(shown.drawing.object.is_some()) == MeshDetail::Anatomy {
        let (window, field) = Window::within(area, &shown.drawing, model.look.symbols);
        let at = window.place((x, y - f64::from(field.y - area.y)));
        return at.y.atan2(-at.x);
    }
    // A cell is twice as high as wide.
    let (right, down) = (x - f64::from(area.width) / 2.0, y - f64::from(area.height) / 2.0);
    (-2.0 * down).atan2(-right)
}

struct Picture<'a> {
    scene: &'a EyePicture<'a>,
    drawing: &'a Drawing,
    frame: &'a Frame,
    thresholds: Vec<f64>,
    theme: Theme,
    /// From metres to dots.
    centre: (f64, f64),
    scale: (f64, f64),
    /// Whether cold fat would only blur the picture.
    is_small: bool,
}

impl<'a> Picture<'a> {
    fn new(scene: &'a EyePicture, frame: &'a Frame, theme: Theme, raster: &Raster) -> Self {
        let drawing = &scene.shown.drawing;
        let thresholds = thresholds(scene.largest, theme.heat_steps());
        let (width, height) = raster.size();
        let (width, height) = (f64::from(width), f64::from(height));
        // Height of a dot over its width, taking a cell to be twice as high as wide.
        let (across, down) = raster.grain();
        let aspect = 2.0 * f64::from(across) / f64::from(down);
        let (wide, high) = drawing.reach;
        let scale = ((width - 1.0) / 2.0 / wide).min((height - 1.0) * aspect / 2.0 / high);
        let is_small = scale * wide < 32.0;
        let (centre, scale) = ((width / 2.0, height / 2.0), (scale, scale / aspect));
        Self { scene, drawing, frame, thresholds, theme, centre, scale, is_small }
    }

    /// In whole parts of a dot: what lies on the axis, between two rows of dots, stays in one of
    /// them whatever the round-off of its place, from frame to frame and from machine to machine.
    fn dot(&self, at: Point2<f64>) -> (f64, f64) {
        const PARTS: f64 = 256.0;
        let whole = |dots: f64| (dots * PARTS).round() / PARTS;
        (whole(self.centre.0 + at.x * self.scale.0), whole(self.centre.1 - at.y * self.scale.1))
    }

    fn place(&self, node: usize) -> (f64, f64) {
        self.dot(self.drawing.place(self.frame, node, f64::from(self.scene.zoom)))
    }

    fn force(&self, node: usize) -> f64 {
        self.drawing.force(self.frame, node)
    }

    fn springs(&self, raster: &mut Raster) {
        let all = self.scene.detail == MeshDetail::Edges;
        for Line { ends: (a, b), region } in self.drawing.lines.iter().copied() {
            let outline = matches!(region, Region::Orbit | Region::Shell | Region::Retina);
            if !(all || outline || region == Region::Lens) {
                continue;
            }
            let force = 0.5 * (self.force(a) + self.force(b));
            let step = match region {
                Region::Orbit => 0,
                // On a slow link the outline keeps its colours: recolouring it is most of a frame.
                _ if outline && self.scene.lean => 0,
                _ => step_of(force, &self.thresholds),
            };
            if step == 0 && region == Region::Fat && self.is_small {
                continue;
            }
            // Hot springs change from frame to frame, so on a slow link only the hottest are sent.
            if self.scene.lean && !outline && 2 * step <= self.thresholds.len() {
                continue;
            }
            let (from, to) = (self.place(a), self.place(b));
            raster.line(from, to, self.ink(region, step));
            // The retina lies inside the shell; a second line there tells it from the rest.
            if region == Region::Retina {
                let inwards = |(x, y): (f64, f64)| {
                    let (dx, dy) = (self.centre.0 - x, self.centre.1 - y);
                    let length = dx.hypot(dy).max(1.0);
                    (x + dx / length, y + dy / length)
                };
                raster.line(inwards(from), inwards(to), self.ink(region, step));
            }
        }
    }

    fn ink(&self, region: Region, step: usize) -> Ink {
        if step > 0 {
            return Ink::solid(self.theme.heat(step), HOT + step as u8, heat_glyph(step));
        }
        let style = self.theme.region(region);
        match region {
            Region::Interior => Ink::solid(style, COLD, '.').dotted(2),
            Region::Fat => Ink::solid(style, COLD, ',').dotted(3),
            Region::Lens => Ink::solid(style, STRUCTURE, 'l'),
            Region::Shell => Ink::solid(style, STRUCTURE, 'o'),
            Region::Retina => Ink::solid(style, STRUCTURE + 1, 'R'),
            Region::Orbit => Ink::solid(style, STRUCTURE, '#'),
        }
    }

    fn nodes(&self, raster: &mut Raster) {
        for (i, node) in self.drawing.nodes.iter().enumerate() {
            if node.region == Region::Orbit || !node.coarse {
                continue;
            }
            let step = step_of(self.force(i), &self.thresholds);
            let (x, y) = self.place(i);
            let ink = self.ink(node.region, step);
            // The hotter, the larger. Without colours a digit takes the place of the dot.
            let dots = match step {
                0 => 1,
                _ if self.theme.is_mono() => 1,
                step if step > self.thresholds.len() / 2 => WARM.len() + HOTTER.len(),
                _ => WARM.len(),
            };
            for (dx, dy) in WARM.into_iter().chain(HOTTER).take(dots) {
                raster.dot(x.floor() as i32 + dx, y.floor() as i32 + dy, ink);
            }
        }
    }

    /// The steps of the hotter nodes as digits, the hottest last; of all if only nodes are drawn.
    fn digits(&self, raster: &Raster, buffer: &mut Buffer) {
        let least = match self.scene.detail {
            MeshDetail::Nodes => 1,
            MeshDetail::Edges | MeshDetail::Anatomy => self.thresholds.len() / 2 + 1,
        };
        let nodes = &self.drawing.nodes;
        let inside = (0..nodes.len()).filter(|i| nodes[*i].region != Region::Orbit);
        let steps = inside.map(|i| (step_of(self.force(i), &self.thresholds), i));
        let mut hot: Vec<(usize, usize)> = steps.filter(|(step, _)| *step >= least).collect();
        hot.sort_unstable();
        for (step, i) in hot {
            if let Some(at) = raster.cell(self.place(i)) {
                buffer[at].set_char(heat_glyph(step)).set_style(self.theme.heat(step));
            }
        }
    }

    /// The first letters of the nodes whose forces are shown; in reverse where the peak is now.
    fn monitors(&self, raster: &Raster, buffer: &mut Buffer) {
        use Quantity::{ForceCentre, ForceFront, ForceRight, ForceTop};
        let forces = [ForceCentre, ForceFront, ForceRight, ForceTop];
        for (node, of) in self.drawing.monitors.iter().zip(forces) {
            let letter = of.row().short.chars().next();
            let places = (raster.cell(self.place(*node)), self.scene.shown.answer.peak(of));
            let (Some(letter), (Some(at), Some(peak))) = (letter, places) else { continue };
            let is_now = (peak.time - self.scene.time).abs() < 1e-9;
            let style = if is_now { self.theme.focus() } else { self.theme.strong() };
            buffer[at].set_char(letter.to_ascii_uppercase()).set_style(style);
        }
    }

    /// The shell under the load while it acts, and the object as the anatomy has it.
    fn blow(&self, raster: &mut Raster) {
        let ink = Ink::solid(self.theme.load(), BLOW, '@');
        let acts = self.scene.time <= self.drawing.loaded_until;
        for &(a, b) in self.drawing.loaded.iter().filter(|_| acts) {
            raster.line(self.place(a), self.place(b), ink);
        }
        let ink = Ink::solid(self.theme.part(Part::Object, 0).into(), BLOW, 'o');
        for [from, to] in object_sides(self.drawing, self.frame) {
            raster.line(self.dot(from), self.dot(to), ink);
        }
    }
}
