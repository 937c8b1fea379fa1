//! The eye as SVG: at its peak as it stands, and moved by the script through the frames beside it.
//!
//! Places are whole twentieths of a millimetre, x from the cornea to the back and y down, as SVG
//! has it. The layers are those of [`crate::report::picture`]; the field is drawn as the cells of
//! the globe, each in the colour of its step.

use std::collections::BTreeSet;

use maud::{Markup, PreEscaped, html};
use nalgebra::Point2;
use serde_json::{Value, json};

use crate::answer::solve::Answer;
use crate::many::comparison::Entry;
use crate::plain_text::printable;
use crate::report::page::content::{FRAMES, spacing};
use crate::report::picture::field::{STEPS, TissueField, step};
use crate::report::picture::{Anatomy, DrawnDetail, Part, Shape, globe_cells};
use crate::report::risks::lines;
use crate::run::drawing::{Drawing, DrawnCell};
use crate::run::kept::{Frame, nearest};
use crate::run::quantity::Quantity;

const PER_M: f64 = 2e4;
/// The smallest thing that shows, in m.
const GRAIN_M: f64 = 0.15e-3;
/// Points of the globe's outline, about: every one is sent for every frame.
const OUTLINE: usize = 60;
/// The field from low to high, as on the screens.
const FIELD: [&str; STEPS] = [
    "#5f005f", "#5f0087", "#5f5f87", "#005f87", "#0087af", "#008787", "#00af87", "#5faf87",
    "#5fd787", "#87d75f", "#d7ff5f",
];
/// How the parts look, in a page and in a picture of its own.
pub const STYLE: &str = ".eye path{stroke:none}.eye .sky{fill:#fff}\
    .eye .object{fill:#bdbdbd}.eye .skin{fill:#8a8a8a}.eye .fat{fill:#f6ecd2}\
    .eye .bone{fill:#b3a184}.eye .nerve{fill:#d7d787}.eye .globe{fill:#5f005f}\
    .eye .ciliary{fill:#875f5f}.eye .lens{fill:#afd7d7}.eye .iris{fill:#5fafff}\
    .eye .retina{fill:#c9706f}.eye .sclera{fill:#d8d8d8}.eye .cornea{fill:#55d7e6}\
    .eye .pressed{fill:#d84fb0}.eye .limbus{fill:#875f5f}\
    .eye .ghost{fill:none;stroke:#777;stroke-width:3;stroke-dasharray:6 8}\
    .eye .bar{stroke:#333;stroke-width:8}.eye .field path{stroke-width:2}\
    .eye text{font:30px sans-serif;fill:#555;\
    stroke:#fff;stroke-width:8px;paint-order:stroke}";

/// Coordinates in all frames at most: a finer mesh has fewer frames, but not fewer than this.
const MOST: f64 = 8e4;
const FEWEST: f64 = 20.0;

/// The sign that stands for 0.
const ZERO: i64 = 93;

/// The picture of an answer with its frames.
pub struct Picture<'a> {
    frames: Vec<&'a Frame>,
    drawing: Drawing,
    anatomy: Anatomy,
    /// What fills the globe, and the end of its scale.
    field: (TissueField, f64),
    /// Cells of the globe, and nodes at their corners.
    cells: Vec<DrawnCell>,
    nodes: Vec<usize>,
    peak: usize,
}

impl<'a> Picture<'a> {
    pub fn of(answer: &'a Answer) -> Option<Self> {
        let kept = &answer.run.frames[..];
        kept.first()?;
        let drawing = answer.case.eye.drawing();
        let cells: Vec<DrawnCell> = globe_cells(&drawing).copied().collect();
        let nodes: BTreeSet<usize> = cells.iter().flat_map(|cell| cell.corners).collect();
        let field = TissueField::all(&drawing, kept)[0];
        let time = answer.peak(Quantity::Apex).map_or(0.0, |peak| peak.time);
        let deepest = nearest(kept, time);
        let count = (MOST / (2.0 * nodes.len() as f64)).clamp(FEWEST, FRAMES);
        let due = spacing(answer.window(), count);
        let moments = (0..=count as usize).map(|number| nearest(kept, due.due(number)));
        let places: BTreeSet<usize> = moments.chain([deepest]).collect();
        let peak = places.range(..deepest).count();
        let frames = places.into_iter().map(|place| &kept[place]).collect();
        let (anatomy, field) = (Anatomy::of(&drawing), (field, field.largest(&drawing, kept)));
        let nodes = nodes.into_iter().collect();
        Some(Self { frames, drawing, anatomy, field, cells, nodes, peak })
    }

    /// The time of the peak that is shown, in s.
    pub fn time(&self) -> f64 {
        self.frames[self.peak].time
    }

    /// Places of the corners of all cells.
    fn places(&self, frame: &Frame) -> Vec<i64> {
        let place = |node: &usize| whole(self.drawing.place(frame, *node, 1.0));
        self.nodes.iter().flat_map(place).collect()
    }

    /// The step of each cell, as a digit or a letter.
    fn steps(&self, frame: &Frame) -> String {
        let values = self.field.0.of_nodes(&self.drawing, frame);
        let of = |cell: &DrawnCell| {
            let mean = cell.corners.iter().map(|node| values[*node]).sum::<f64>() / 4.0;
            char::from_digit(step(mean, self.field.1) as u32, 36)
        };
        self.cells.iter().filter_map(of).collect()
    }

    fn layers(&self, frame: &Frame) -> Vec<Shape> {
        let detail = DrawnDetail { grain: GRAIN_M, zoom: 1.0, points: OUTLINE };
        self.anatomy.layers(&self.drawing, frame, detail)
    }

    pub fn view_box(&self) -> String {
        self.view().map(|side| side.to_string()).join(" ")
    }

    /// Left, top, width and height: the eye at rest, and room for the object before it.
    fn view(&self) -> [i64; 4] {
        let (low, high) = self.drawing.extent();
        let [left, bottom] = whole(low);
        let [right, top] = whole(high);
        [left, top, right - left, bottom - top]
    }

    /// What stands within the picture; the script finds its paths by their order.
    pub fn content(&self) -> Markup {
        let frame = self.frames[self.peak];
        let [left, top, wide, high] = self.view();
        let (name, end) = (self.field.0.name(), self.field.0.figure(self.field.1));
        let bar = (1e-2 * PER_M) as i64;
        let (low, middle) = (top + high - 20, left + wide / 2);
        let steps = self.steps(frame);
        let key = left + wide - 420;
        html! {
            @for shape in self.layers(frame) {
                path class=(format!("{:?}", shape.part).to_lowercase())
                    d=(shape.rings.iter().map(|ring| closed(ring)).collect::<String>()) {}
                @if shape.part == Part::Globe { g.field { @for of in 0..STEPS {
                    path style=(format!("fill:{0};stroke:{0}", FIELD[of])) d=(self.filled(frame, &steps, of)) {}
                } } }
            }
            path.ghost d=(closed(self.anatomy.ghost())) {}
            text x=(left + 10) y=(low) { "front" }
            text x=(left + wide - 10) y=(low) text-anchor="end" { "back" }
            path.bar d=(format!("M{} {}h{bar}", middle - bar, low - 10)) {}
            text x=(middle + 15) y=(low) { "10 mm" }
            text x=(key - 10) y=(top + 32) text-anchor="end" { (name) " 0" }
            @for (x, colour) in (0..).map(|i: i64| key + 22 * i).zip(FIELD) {
                rect x=(x) y=(top + 8) width="22" height="28" fill=(colour) {}
            }
            text x=(key + 252) y=(top + 32) { (end) }
        }
    }

    /// The cells that are at one of the `steps` of the field in a frame.
    fn filled(&self, frame: &Frame, steps: &str, of: usize) -> String {
        let at_it = self.cells.iter().zip(steps.chars());
        let at_it = at_it.filter(|(_, step)| step.to_digit(36) == Some(of as u32));
        let place = |node| self.drawing.place(frame, node, 1.0);
        at_it.map(|(cell, _)| closed(&cell.corners.map(place))).collect()
    }

    /// What the script moves the paths by: the places of the first frame, of each other one how far
    /// they moved since. Lines that have another number of corners than before stand as they are.
    pub fn motion(&self) -> Value {
        let frames = || self.frames.iter().copied();
        let layers: Vec<Vec<Shape>> = frames().map(|frame| self.layers(frame)).collect();
        let shape = |i: usize| -> Value {
            let rings = || layers.iter().map(|layers| &layers[i].rings);
            let most = rings().map(Vec::len).max().unwrap_or_default();
            let ring = |ring: usize| {
                let places = rings().map(|rings| rings.get(ring).into_iter().flatten());
                let places = places.map(|ring| ring.copied().flat_map(whole).collect());
                moves(&places.collect::<Vec<Vec<i64>>>())
            };
            (0..most).map(ring).collect()
        };
        let place = |node: &usize| self.nodes.binary_search(node).unwrap_or_default();
        json!({
            "peak": self.peak,
            "ms": frames().map(|f| (f.time * 1e6).round() / 1e3).collect::<Vec<_>>(),
            "shapes": (0..layers[0].len()).map(shape).collect::<Vec<_>>(),
            "places": moves(&frames().map(|f| self.places(f)).collect::<Vec<_>>()),
            "cells": self.cells.iter().flat_map(|cell| &cell.corners).map(place).collect::<Value>(),
            "steps": frames().map(|f| self.steps(f)).collect::<Vec<_>>(),
        })
    }
}

/// The first list of numbers, and the moves to each other one: a space where there are none.
fn moves(lists: &[Vec<i64>]) -> Vec<String> {
    let by = |pair: &[Vec<i64>]| {
        if pair[0] == pair[1] {
            return " ".to_owned();
        }
        let as_long = pair[0].len() == pair[1].len();
        let moved = pair[1].iter().zip(&pair[0]).map(|(b, a)| b - a);
        packed(&if as_long { moved.collect() } else { pair[1].clone() })
    };
    let first = lists.first().map(|list| packed(list)).into_iter();
    first.chain(lists.windows(2).map(by)).collect()
}

/// Small numbers as a sign each, from `=` on; others as `!`, digits and `;`.
fn packed(numbers: &[i64]) -> String {
    let one = |number: &i64| match number {
        -32..=33 => char::from(u8::try_from(number + ZERO).unwrap_or(b'!')).to_string(),
        _ => format!("!{number};"),
    };
    numbers.iter().map(one).collect()
}

fn whole(at: Point2<f64>) -> [i64; 2] {
    [(at.x * PER_M).round() as i64, (-at.y * PER_M).round() as i64]
}

fn closed(ring: &[Point2<f64>]) -> String {
    let signs = std::iter::once('M').chain(std::iter::repeat('L'));
    let corner = |(at, sign): (&Point2<f64>, char)| {
        let [x, y] = whole(*at);
        format!("{sign}{x} {y}")
    };
    ring.iter().zip(signs).map(corner).collect::<String>() + "Z"
}

/// The width of a wide letter of a text beside a picture.
const LETTER: i64 = 18;

/// A file of the pictures alone, side by side, each with its name and first verdict.
pub fn pictures(entries: &[Entry]) -> String {
    let answered = entries.iter().filter_map(|entry| {
        let answer = entry.answer()?;
        Some((entry, answer, Picture::of(answer)?))
    });
    let all: Vec<_> = answered.collect();
    let sides = |at: usize| all.iter().map(move |(_, _, picture)| picture.view()[at]).max();
    let (side, high) = (sides(2).unwrap_or(1), sides(3).unwrap_or(1));
    let whole = all.iter().map(|_| side).sum::<i64>().max(side);
    let drawn = html! {
        svg.eye xmlns="http://www.w3.org/2000/svg" viewBox=(format!("0 0 {whole} {}", high + 124)) {
            style { (PreEscaped(STYLE)) }
            rect width="100%" height="100%" fill="white" {}
            @for (x, (entry, answer, picture)) in (0..).map(|i: i64| i * side).zip(&all) {
                svg x=(x) width=(side) height=(high) viewBox=(picture.view_box()) { (picture.content()) }
                @let name = printable(&entry.scenario.name);
                // A name that is wider than its picture is set closer.
                @let letters: i64 = name.chars().map(|_| LETTER).sum();
                @let room = (letters > side - 16).then_some(side - 16);
                text x=(x + 8) y=(high + 34) textLength=[room]
                    lengthAdjust=[room.map(|_| "spacingAndGlyphs")] { (name) }
                @if let Some((name, words)) = lines(answer).first() {
                    // The word and the range; what stands behind them is too long for a picture.
                    @let words = words.split([',', ';', ':']).next().unwrap_or_default();
                    text x=(x + 8) y=(high + 74) { (name) ": " (words) }
                }
                text x=(x + 8) y=(high + 114) { (format!("at {:.3} ms", picture.time() * 1e3)) }
            }
        }
    };
    drawn.into_string()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::solve::tests::answered_with;
    use crate::scenario::library::tests::preset;

    #[test]
    fn a_replay_has_few_frames_and_moves_as_the_eye_does() {
        let scenario = preset("squash-ball", &[]);
        let answer = answered_with(&scenario, crate::tui::simulation::keep(&scenario));
        let picture = Picture::of(&answer).unwrap();
        assert!(answer.run.frames.len() > 400 && picture.frames.len() <= 82);
        let deepest = answer.peak(Quantity::Apex).unwrap().time;
        let off = |time: f64| (time - deepest).abs();
        assert!(answer.run.frames.iter().all(|f| off(f.time) >= off(picture.time())));
        let motion = picture.motion();
        // As the script reads it.
        let numbers = |list: &Value| -> Vec<i64> {
            let mut signs = list.as_str().unwrap().trim_start().chars();
            let mut numbers = Vec::new();
            while let Some(sign) = signs.next() {
                let mut large =
                    || signs.by_ref().take_while(|sign| *sign != ';').collect::<String>();
                let small = i64::from(u32::from(sign)) - ZERO;
                numbers.push(if sign == '!' { large().parse().unwrap() } else { small });
            }
            numbers
        };
        let last = picture.frames[picture.frames.len() - 1];
        let mut now = vec![0; picture.nodes.len() * 2];
        for list in motion["places"].as_array().unwrap() {
            for (place, by) in now.iter_mut().zip(numbers(list)) {
                *place += by;
            }
        }
        assert_eq!(now, picture.places(last));
        assert_eq!(motion["steps"].as_array().unwrap().len(), picture.frames.len());
        assert_eq!(motion["shapes"].as_array().unwrap().len(), picture.layers(last).len());
        assert!(motion.to_string().len() < 230_000);
    }
}
