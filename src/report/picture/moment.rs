//! What happens at a moment, in a few words.

use crate::answer::solve::Answer;
use crate::run::{kept::nearest, quantity::Quantity, trace::Trace};

/// Depth of the cornea up to which it is only touched, in m, and how long what just left still
/// leaves, in s.
const TOUCHED_M: f64 = 0.2e-3;
const LEAVES_S: f64 = 0.3e-3;
/// Force from which something presses, in N.
const PRESSES_N: f64 = 0.3;

/// Where an object is in its blow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stage {
    Before,
    Pressing,
    After,
}

/// The stage of a blow at a time in s; before it where nothing is recorded.
pub fn stage(answer: &Answer, time: f64) -> Stage {
    let Some(traces) = &answer.run.traces else { return Stage::Before };
    let pressing = |force: &f64| *force > PRESSES_N;
    let ends = [
        traces.contact_force.iter().position(pressing),
        traces.contact_force.iter().rposition(pressing),
    ];
    match ends.map(|at| at.map(|at| traces.time[at])) {
        [Some(first), _] if time < first => Stage::Before,
        [_, Some(last)] if time > last => Stage::After,
        [Some(_), _] => Stage::Pressing,
        _ => Stage::Before,
    }
}

/// What happens at a time in s, in full and in one word.
pub fn said(answer: &Answer, time: f64) -> (String, &'static str) {
    let Some(traces) = &answer.run.traces else { return (String::new(), "") };
    let place = traces.time.partition_point(|t| *t < time);
    let at = |values: &[f64]| values.get(place.min(values.len().wrapping_sub(1))).copied();
    let deep = at(Trace::Of(Quantity::Apex).values(traces)).unwrap_or_default();
    let hit = !traces.contact_force.is_empty();
    let pressing = if hit { &traces.contact_force } else { &traces.load };
    let last = pressing.iter().rposition(|force| *force > PRESSES_N);
    let end = last.map_or(0.0, |last| traces.time[last]);
    let deepest = answer.peak(Quantity::Apex).map_or(0.0, |peak| peak.time);
    let frames = &answer.run.frames;
    let figure = format!("{:.1} mm", deep * 1e3);
    if nearest(frames, time) == nearest(frames, deepest) {
        (format!("deepest, {figure}"), "deepest")
    } else if time < deepest && hit && deep < TOUCHED_M {
        ("object touches".to_owned(), "touches")
    } else if time < deepest {
        (format!("pressed in {figure}"), "pressed")
    } else if time < end {
        ("springs back".to_owned(), "springs")
    } else if hit && time < end + LEAVES_S {
        ("object leaves".to_owned(), "leaves")
    } else {
        ("eye still swings".to_owned(), "swings")
    }
}
