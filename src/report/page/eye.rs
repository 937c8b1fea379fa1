//! The eye as SVG: at its peak as it stands, and moved by the script through the frames beside it.
//!
//! Places are whole hundredths of a millimetre, x from the cornea to the back and y down, as SVG
//! has it.

use std::collections::BTreeSet;
use std::fmt::Write;

use maud::{Markup, PreEscaped, html};
use serde_json::{Value, json};

use crate::answer::solve::Answer;
use crate::many::comparison::Entry;
use crate::plain_text::printable;
use crate::report::page::content::{FRAMES, spacing};
use crate::report::risks::lines;
use crate::run::drawing::Drawing;
use crate::run::kept::{Frame, nearest};
use crate::run::places::Region;
use crate::run::quantity::Quantity;

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

/// Coordinates in all frames at most, some 1 MB: a finer mesh has fewer frames, but not fewer than
/// this.
const MOST: f64 = 4e5;
const FEWEST: f64 = 20.0;

/// The picture of an answer with its frames.
pub struct Picture<'a> {
    frames: Vec<&'a Frame>,
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
        let kept = &answer.run.frames[..];
        kept.first()?;
        let drawing = answer.case.eye.drawing();
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
        let time = answer.peak(Quantity::Apex).map_or(0.0, |peak| peak.time);
        let deepest = nearest(kept, time);
        let count = (MOST / (2.0 * nodes.len() as f64)).clamp(FEWEST, FRAMES);
        let due = spacing(answer.window(), count);
        let moments = (0..=count as usize).map(|number| nearest(kept, due.due(number)));
        let places: BTreeSet<usize> = moments.chain([deepest]).collect();
        let peak = places.range(..deepest).count();
        let frames = places.into_iter().map(|place| &kept[place]).collect();
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
        let places = self.places(self.frames[0]);
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
        let frame = self.frames[self.peak];
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

    /// Everything that the script moves the paths by: of the first frame the places, of each other
    /// one how far they have moved since, which takes fewer digits.
    pub fn motion(&self) -> Value {
        let flat = |lines: &Vec<(usize, usize)>| -> Vec<usize> {
            lines.iter().flat_map(|(a, b)| [*a, *b]).collect()
        };
        let frames = self.frames.iter().copied();
        let objects: Option<Vec<_>> = frames.clone().map(|f| self.object(f)).collect();
        json!({
            "peak": self.peak,
            "ms": frames.clone().map(|f| (f.time * 1e6).round() / 1e3).collect::<Vec<_>>(),
            "places": moves(&frames.map(|f| self.places(f)).collect::<Vec<_>>()),
            "objects": objects.as_deref().map(moves),
            "parts": self.parts.iter().map(flat).collect::<Vec<_>>(),
        })
    }
}

/// The first of several lists of numbers, and of each other one by how much it differs from the
/// one before.
fn moves(lists: &[Vec<i64>]) -> Vec<Vec<i64>> {
    let by = |pair: &[Vec<i64>]| pair[1].iter().zip(&pair[0]).map(|(b, a)| b - a).collect();
    let first = lists.first().cloned().into_iter();
    first.chain(lists.windows(2).map(by)).collect()
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
        let answer = entry.answer()?;
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
                @let verdict = lines(answer).into_iter().next();
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::solve::solve;
    use crate::run::watch::unwatched;
    use crate::scenario::library::find;

    #[test]
    fn a_replay_has_few_frames_and_moves_as_the_eye_does() {
        let scenario = find("squash-ball").unwrap().scenario().unwrap();
        let keep = crate::tui::simulation::keep(&scenario);
        let answer = solve(&scenario.check().unwrap(), keep, &mut unwatched).unwrap();
        let picture = Picture::of(&answer).unwrap();
        assert!(answer.run.frames.len() > 400 && picture.frames.len() <= 82);
        let apart = |frame: &Frame| (frame.time - picture.time()).abs();
        let deepest = answer.peak(Quantity::Apex).unwrap().time;
        assert!(
            answer
                .run
                .frames
                .iter()
                .all(|f| (f.time - deepest).abs() >= (picture.time() - deepest).abs())
        );
        assert_eq!(apart(picture.frames[picture.peak]), 0.0);
        let motion = picture.motion();
        let numbers = |list: &Value| -> Vec<i64> {
            let list = list.as_array().unwrap().iter();
            list.map(|number| number.as_i64().unwrap()).collect()
        };
        for (key, last) in [
            (
                "places",
                picture.places(picture.frames[picture.frames.len() - 1]),
            ),
            (
                "objects",
                picture
                    .object(picture.frames[picture.frames.len() - 1])
                    .unwrap(),
            ),
        ] {
            let mut now = vec![0; last.len()];
            for list in motion[key].as_array().unwrap() {
                for (place, by) in now.iter_mut().zip(numbers(list)) {
                    *place += by;
                }
            }
            assert_eq!(now, last, "{key}");
        }
        assert!(motion.to_string().len() < 400_000);
    }
}
