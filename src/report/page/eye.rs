//! The eye as SVG: at its peak as it stands, and moved by the script through the frames beside it.
//!
//! Places are whole hundredths of a millimetre, x from the cornea to the back and y down, as SVG has it.

use std::fmt::Write;

use maud::{Markup, PreEscaped, html};
use serde_json::{Value, json};

use crate::eye::Region;
use crate::injury::lines;
use crate::plain_text::printable;
use crate::recording::Frame;
use crate::study::comparison::Entry;
use crate::study::drawing::Drawing;
use crate::study::{Answer, Quantity};

/// Hundredths of a millimetre.
const PER_M: f64 = 1e5;
/// The parts from the back to the front of the picture, with their class.
const PARTS: [(Region, &str); 6] = [
    (Region::Fat, "fat"),
    (Region::Interior, "interior"),
    (Region::Lens, "lens"),
    (Region::Orbit, "orbit"),
    (Region::Shell, "shell"),
    (Region::Retina, "retina"),
];
/// How the parts look, in a page and in a picture of its own.
pub const STYLE: &str = ".eye path{fill:none;stroke-linecap:round}\
    .fat{stroke:#cdb98a;stroke-width:10}.interior{stroke:#a9bccd;stroke-width:10}\
    .lens{stroke:#2a9d8f;stroke-width:26}.orbit{stroke:#8a7445;stroke-width:34}\
    .shell{stroke:#333;stroke-width:34}.retina{stroke:#c1443c;stroke-width:44}\
    .eye .object{fill:#77777755;stroke:#555;stroke-width:16}\
    .eye text{font:150px sans-serif;fill:#555}";

/// The picture of an answer with its frames.
pub struct Picture<'a> {
    frames: &'a [Frame],
    drawing: Drawing,
    /// Nodes that lines end at.
    nodes: Vec<usize>,
    /// For each of [`PARTS`] the ends of its lines, by their places in `nodes`.
    parts: Vec<Vec<(usize, usize)>>,
    /// The frame of the peak.
    peak: usize,
}

impl<'a> Picture<'a> {
    /// Of an answer that has frames.
    pub fn of(answer: &'a Answer) -> Option<Self> {
        let frames = &answer.frames[..];
        let time = answer.peak(Quantity::Apex).map_or(0.0, |peak| peak.time);
        let apart = |frame: &Frame| (frame.time - time).abs();
        let by = |a: &usize, b: &usize| apart(&frames[*a]).total_cmp(&apart(&frames[*b]));
        let peak = (0..frames.len()).min_by(by)?;
        let drawing = Drawing::of(&answer.case);
        let mut places = vec![None; drawing.nodes.len()];
        let mut nodes = Vec::new();
        let mut place = |node: usize| {
            *places[node].get_or_insert_with(|| {
                nodes.push(node);
                nodes.len() - 1
            })
        };
        let mut parts = vec![Vec::new(); PARTS.len()];
        for line in &drawing.lines {
            if let Some(part) = PARTS.iter().position(|(region, _)| *region == line.region) {
                parts[part].push((place(line.ends.0), place(line.ends.1)));
            }
        }
        Some(Self {
            frames,
            drawing,
            nodes,
            parts,
            peak,
        })
    }

    /// The time of the peak that is shown, in s.
    pub fn time(&self) -> f64 {
        self.frames[self.peak].time
    }

    fn places(&self, frame: &Frame) -> Vec<i64> {
        let place = |node: &usize| whole(self.drawing.place(frame, *node, 1.0));
        self.nodes.iter().flat_map(place).collect()
    }

    fn object(&self, frame: &Frame) -> Option<Vec<i64>> {
        let outline = self.drawing.object(frame)?;
        Some(outline.into_iter().flat_map(whole).collect())
    }

    /// Left, top, width and height: the eye at rest, and room for the object before it.
    fn view(&self) -> [i64; 4] {
        let places = self.places(&self.frames[0]);
        let ends = |from: usize| {
            let along = || places.iter().skip(from).step_by(2).copied();
            (along().min().unwrap_or(-1), along().max().unwrap_or(1))
        };
        let ((left, right), (top, bottom)) = (ends(0), ends(1));
        let (wide, high) = (right - left, bottom - top);
        let (before, around) = (wide / 4, high / 12);
        [
            left - before,
            top - around,
            wide + before + wide / 20,
            high + 2 * around,
        ]
    }

    /// What stands within the picture.
    fn content(&self) -> Markup {
        let frame = &self.frames[self.peak];
        let places = self.places(frame);
        let at = |i: usize| (places[2 * i], places[2 * i + 1]);
        let [left, top, wide, _] = self.view();
        html! {
            path.object d=(self.object(frame).map_or_else(String::new, |outline| closed(&outline))) {}
            @for ((_, class), lines) in PARTS.iter().zip(&self.parts) {
                path class=(class) d=(path(lines, at)) {}
            }
            text x=(left + 30) y="50" { "front" }
            text x=(left + wide - 130) y="-130" text-anchor="end" { "back" }
            text x="0" y=(top + 150) text-anchor="middle" { "up" }
        }
    }

    /// The picture within a page; the script finds its paths by their order.
    pub fn markup(&self, label: &str) -> Markup {
        let view = self.view().map(|side| side.to_string()).join(" ");
        html! {
            svg.eye viewBox=(view) role="img" aria-label=(label) {
                (self.content())
            }
        }
    }

    /// Everything that the script moves the paths by.
    pub fn motion(&self) -> Value {
        let flat = |lines: &Vec<(usize, usize)>| -> Vec<usize> {
            lines.iter().flat_map(|(a, b)| [*a, *b]).collect()
        };
        let frames = self.frames.iter();
        json!({
            "peak": self.peak,
            "ms": frames.clone().map(|f| (f.time * 1e6).round() / 1e3).collect::<Vec<_>>(),
            "places": frames.clone().map(|f| self.places(f)).collect::<Vec<_>>(),
            "objects": frames.map(|f| self.object(f)).collect::<Vec<_>>(),
            "parts": self.parts.iter().map(flat).collect::<Vec<_>>(),
        })
    }
}

fn whole(at: nalgebra::Point2<f64>) -> [i64; 2] {
    [
        (at.x * PER_M).round() as i64,
        (-at.y * PER_M).round() as i64,
    ]
}

fn path(lines: &[(usize, usize)], at: impl Fn(usize) -> (i64, i64)) -> String {
    lines.iter().fold(String::new(), |mut path, &(a, b)| {
        let ((x, y), (to_x, to_y)) = (at(a), at(b));
        // A string takes whatever it is given.
        let _ = write!(path, "M{x} {y}L{to_x} {to_y}");
        path
    })
}

fn closed(outline: &[i64]) -> String {
    let points: Vec<String> = outline
        .chunks(2)
        .map(|p| format!("{} {}", p[0], p[1]))
        .collect();
    format!("M{}Z", points.join("L"))
}

/// A file of the pictures alone, side by side, each with its name and first verdict.
pub fn pictures(entries: &[Entry]) -> String {
    let answered = entries.iter().filter_map(|entry| {
        let answer = entry.outcome.as_ref().ok()?;
        Some((entry, answer, Picture::of(answer)?))
    });
    let all: Vec<_> = answered.collect();
    let sides = |at: usize| {
        all.iter()
            .map(move |(_, _, picture)| picture.view()[at])
            .max()
    };
    let (side, high) = (sides(2).unwrap_or(1), sides(3).unwrap_or(1));
    let lefts = (0..).map(|i: i64| i * side);
    let placed: Vec<_> = lefts.zip(&all).collect();
    let whole = placed.last().map_or(side, |(left, _)| left + side);
    let drawn = html! {
        svg.eye xmlns="http://www.w3.org/2000/svg" viewBox=(format!("0 0 {whole} {}", high + 620)) {
            style { (PreEscaped(STYLE)) }
            rect width="100%" height="100%" fill="white" {}
            @for (x, (entry, answer, picture)) in placed {
                @let verdict = lines(&answer.verdicts()).into_iter().next();
                @let view = picture.view().map(|side| side.to_string()).join(" ");
                svg x=(x) width=(side) height=(high) viewBox=(view) { (picture.content()) }
                text x=(x + 40) y=(high + 170) { (printable(&entry.scenario.name)) }
                @if let Some((name, words)) = verdict {
                    // The word and the range; what stands behind them is too long for a picture.
                    @let words = words.split([',', ';', ':']).next().unwrap_or_default();
                    text x=(x + 40) y=(high + 370) { (name) ": " (words) }
                }
                text x=(x + 40) y=(high + 570) { (format!("at {:.3} ms", picture.time() * 1e3)) }
            }
        }
    };
    drawn.into_string()
}
