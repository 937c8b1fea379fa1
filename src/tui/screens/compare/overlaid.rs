//! One curve of every preset in one chart.

use crate::answer::solve::Answer;
use crate::run::trace::Trace;
use crate::tui::screens::compare::comparison::{Alignment, Comparison};
use crate::tui::view::chart::{TimeChart, TimeCurve, mark};
use crate::tui::{model::AppModel, view::raster::Ink, view::sheet::Sheet};

/// One curve of every entry in one chart.
pub(super) fn overlaid(compare: &Comparison, model: &AppModel, course: Trace, sheet: &mut Sheet) {
    let theme = sheet.theme;
    let row = course.row();
    // Each on the time of the first.
    let shifted = |answer: &Answer| -> Option<Vec<f64>> {
        let shift = compare.shift(answer);
        let times = answer.run.traces.as_ref()?.time.iter();
        Some(times.map(|time| time - shift).collect())
    };
    let times = compare.entries.iter().map(|entry| entry.answer().and_then(shifted));
    let times: Vec<_> = times.map(Option::unwrap_or_default).collect();
    let entries = compare.entries.iter().enumerate();
    let curves: Vec<TimeCurve> = entries
        .filter_map(|(i, entry)| {
            let traces = entry.answer()?.run.traces.as_ref()?;
            let values = course.values(traces);
            if values.is_empty() {
                return None;
            }
            let ink = Ink::solid(theme.curve(i), 2 + i as u8, mark(i));
            // Without colours, dots of different spacing tell the curves apart.
            let ink = if theme.is_mono() { ink.dotted(1 + (i % 4) as u8) } else { ink };
            Some(TimeCurve { time: &times[i], values, factor: row.factor, ink })
        })
        .collect();
    let Some(window) = compare.window() else {
        return;
    };
    let reading = match compare.alignment {
        Alignment::Clock => format!("{:.3} ms", compare.time(model) * 1e3),
        other => format!("{}, {:.3} ms", other.words(), compare.time(model) * 1e3),
    };
    // What drives the eye is a load for some and a contact for others.
    let entries = compare.entries.iter();
    let mut labels: Vec<&str> = entries
        .filter_map(|entry| Some(course.label(entry.answer()?.run.traces.as_ref()?)))
        .collect();
    labels.sort_unstable_by(|a, b| b.cmp(a));
    labels.dedup();
    TimeChart {
        title: &format!("{}, {}", labels.join(" or "), row.unit),
        reading: &reading,
        curves,
        span: (0.0, window),
        cursor: compare.time(model),
    }
    .draw(sheet);
}
