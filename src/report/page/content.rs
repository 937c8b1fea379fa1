//! The words and rows of a page, whatever it is written as.

use crate::answer::solve::{Answer, Errors};
use crate::injury::{CURVES, SIGNS};
use crate::many::comparison::Entry;
use crate::plain_text::printable;
use crate::report::figure::{Figure, cut_before, with_unit};
use crate::report::format::{capital, or_dash, percent};
use crate::report::text::remark;
use crate::run::kept::{Keep, Spacing};
use crate::run::quantity::Quantity;
use crate::scenario::Scenario;
use crate::scenario::fields::{FIELDS, Field, Kind, find};

const SOURCE: &str = "V. Sathyanarayanan, K. Mahadas and G. K. Hung, Homeomorphic Model of the Effect of Impact \
    Trauma on the Human Eye, J Comput Sci Syst Biol 6 (2013) 317-326, doi:10.4172/jcsb.1000128";
/// Frames of the replay at most, half of them in the time in which most happens, in s.
pub(super) const FRAMES: f64 = 64.0;
const LIVELY: f64 = 0.6e-3;

/// What a run must keep for a page: traces, and the frames of its replay.
pub fn keep(scenario: &Scenario) -> Keep {
    let frames = match scenario.known_window_ms() {
        Some(window) => spacing(window * 1e-3, FRAMES),
        // Of these the page takes as many as of others.
        None => Spacing::doubling(2 * FRAMES as u32, 0.5 * LIVELY / FRAMES),
    };
    Keep { traces: true, frames: Some(frames) }
}

/// The times of the frames of a replay; `window` is in s.
pub(super) fn spacing(window: f64, frames: f64) -> Spacing {
    let early = LIVELY.min(0.5 * window);
    let half = (0.5 * frames).round();
    let (early_every, every) = (early / half, (window - early) / half);
    Spacing { early: half as u32, early_every, every, doubles: false }
}

/// The version that answered, and what counts more than any result.
pub(super) fn closing() -> String {
    let commit = crate::report::commit().map(|commit| format!(", commit {commit}"));
    let (version, commit) = (env!("CARGO_PKG_VERSION"), commit.unwrap_or_default());
    format!("contrecoup {version}{commit}. {SIGNS}")
}

/// What is asked of a blow: the fields of impact and model, and whatever else is not as usual.
pub(super) fn inputs(scenario: &Scenario) -> Vec<(&'static str, String)> {
    let mut usual = Scenario::default();
    // The usual parts are those of the same model.
    if let Some(Kind::Choice(models)) = find("model").map(|field| &field.kind)
        && let Some(name) = models.get(scenario)
    {
        models.set(&mut usual, name);
    }
    let worth = |path: &str, text: &String| {
        let own = path == "model" || path.starts_with("impact");
        own || find(path).and_then(|field| field.text(&usual)).as_ref() != Some(text)
    };
    let asked = |field: &Field| {
        let text = field.text(scenario).filter(|text| worth(field.path, text))?;
        Some((field.label, with_unit(&printable(&text), field.unit)))
    };
    FIELDS.iter().filter(|field| field.path != "name").filter_map(asked).collect()
}

/// The results as rows: name, value, unit, when, step error and mesh error.
pub(super) fn rows(scenario: &Scenario, answer: &Answer) -> Vec<[String; 6]> {
    let Errors { time_step, mesh, .. } = &answer.errors;
    let row = |(of, _): (Quantity, f64)| {
        let value = Figure::of(answer, of).map(|figure| {
            format!("{} {}", cut_before(figure.cut).1, figure.number).trim_start().to_owned()
        });
        let ms = answer.peak(of).map(|peak| peak.time * 1e3);
        let at = ms.map(|ms| format!("{ms:.3} ms{}", remark(scenario, answer, of)));
        let mesh = mesh.as_ref().and_then(|errors| errors[of]);
        let figure = Figure::of(answer, of);
        // A figure in percent has its error in percent of the same.
        let unit = figure.map_or("", |figure| figure.unit);
        let per =
            if unit == "%" { 1e-2 * answer.result(of).unwrap_or_default().abs() } else { 1.0 };
        let [step, mesh] = [time_step[of], mesh].map(|e| or_dash(e.map(|e| e * per), percent));
        let (name, unit) = (capital(of.row().label), unit.to_owned());
        [name, value.unwrap_or_default(), unit, at.unwrap_or_default(), step, mesh]
    };
    // Risks stand above, with their ranges.
    let own = |(of, _): &(Quantity, f64)| !of.is_risk();
    answer.results().present().filter(own).map(row).collect()
}

/// Everything that the page rests on, each once.
pub(super) fn sources(entries: &[Entry]) -> Vec<&'static str> {
    let mut sources = vec![SOURCE];
    let answers = entries.iter().filter_map(Entry::answer);
    if answers.flat_map(Answer::risks).next().is_some() {
        for curve in CURVES {
            if !sources.contains(&curve.source) {
                sources.push(curve.source);
            }
        }
    }
    sources
}

/// The line that somebody fills in by hand.
pub(super) fn case(scenario: &Scenario) -> String {
    let (side, ..) = scenario.eye_side().seen();
    let blank = "_".repeat(16);
    format!("Case {blank} Date {blank} Eye: {side}")
}

pub(super) fn mesh(answer: &Answer, scenario: &Scenario) -> String {
    format!("{}; mesh level {}", scenario.description(), answer.case.level())
}
