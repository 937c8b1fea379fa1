//! Replays side by side.

use crate::tui::screens::compare::comparison::{Comparison, shown};
use crate::tui::{
    model::AppModel,
    screens::compare::view::{answered, heading},
    shown::ShownAnswer,
};
use crate::tui::{view::below, view::text::fitted, work::brief};
use crate::tui::{view::chart::mark, view::eye::EyePicture, view::sheet::Sheet};

/// Side by side, all at the same time and on the same scale of force.
pub(super) fn replays(compare: &Comparison, model: &AppModel, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    heading(compare, sheet);
    let entries = &compare.entries;
    if entries.is_empty() {
        return;
    }
    // All are filled with the same on one scale, as far as they have it.
    let answers = || entries.iter().filter_map(shown);
    let largest = answers().map(|shown| shown.hottest).fold(0.0, f64::max);
    let wanted = answers().find_map(|shown| model.clock.field(&shown.fields));
    let own = |shown: &ShownAnswer| {
        let mut fields = shown.fields.iter().copied();
        fields.find(|(field, _)| wanted.is_some_and(|(wanted, _)| *field == wanted))
    };
    let end = answers().filter_map(own).map(|(_, end)| end).fold(0.0, f64::max);
    let field = |shown: &ShownAnswer| match own(shown) {
        Some((field, _)) => Some((field, end)),
        None => model.clock.field(&shown.fields),
    };
    let zoom = match model.clock.zoom() {
        1 => String::new(),
        times => format!("  shown {times}x larger"),
    };
    let (time, aligned) = (compare.time(model), compare.alignment.words());
    let text = format!("{:.3} ms{zoom}  {aligned}", time * 1e3);
    sheet.put_right((area.width - 1, 0), &text, theme.strong());
    let count = entries.len() as u16;
    let rows = if count > 3 { 2 } else { 1 };
    let mut pictures = sheet.at(below(area, 1));
    for (i, entry) in entries.iter().enumerate() {
        let place = &mut pictures.tile(i, (count.div_ceil(rows), rows));
        let (width, height) = (place.area.width, place.area.height);
        let name = fitted(brief(&entry.name), usize::from(width) - 4);
        place.put((1, 0), mark(i).to_string(), theme.curve(i));
        place.put((3, 0), name, theme.strong());
        let Some(shown) = answered(entry, (1, 2), place) else {
            continue;
        };
        let time = time + compare.shift(&shown.answer);
        let time = time.clamp(0.0, shown.answer.window());
        let picture = place.part((0, 1), (width - 1, height - 1));
        EyePicture {
            largest,
            field: field(shown),
            blow: Some(&entry.scenario),
            ..EyePicture::of(model, shown, time)
        }
        .draw(picture.area, picture.buffer);
    }
}
