//! One curve of every preset in one chart.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::tui::model::Model;
use crate::tui::screens::forces::{CURVES, DRIVE, drive_label, mark};
use crate::tui::view::chart::{Chart, Curve};
use crate::tui::view::raster::Ink;
use crate::tui::view::theme::Theme;

/// One curve of every entry in one chart.
pub(super) fn overlaid(model: &Model, curve: usize, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let profile = &CURVES[curve % CURVES.len()];
    let entries = model.screens.compare.entries.iter().enumerate();
    let curves: Vec<Curve> = entries
        .filter_map(|(i, entry)| {
            let traces = entry.answer()?.recording.traces.as_ref()?;
            let values = (profile.values)(traces);
            if values.is_empty() {
                return None;
            }
            let ink = Ink::solid(theme.curve(i), 2 + i as u8, mark(i));
            // Without colours, dots of different spacing tell the curves apart.
            let ink = if theme.is_mono() {
                ink.dotted(1 + (i % 4) as u8)
            } else {
                ink
            };
            Some(Curve {
                time: &traces.time,
                values,
                factor: profile.factor,
                ink,
            })
        })
        .collect();
    let Some(window) = model.screens.compare.window() else {
        return;
    };
    let reading = format!("{:.3} ms", model.time() * 1e3);
    let label = if curve % CURVES.len() == DRIVE {
        let entries = model.screens.compare.entries.iter();
        let mut labels: Vec<&str> = entries
            .filter_map(|entry| Some(drive_label(entry.answer()?.recording.traces.as_ref()?)))
            .collect();
        labels.sort_unstable_by(|a, b| b.cmp(a));
        labels.dedup();
        labels.join(" or ")
    } else {
        profile.label.to_owned()
    };
    Chart {
        title: &format!("{label}, {}", profile.unit),
        reading: &reading,
        curves,
        window,
        cursor: model.time(),
        look: model.look,
    }
    .draw(area, buffer);
}
