//! Replays side by side.

use crate::answer::solve::Answer;
use crate::many::comparison::Found;
use crate::tui::{model::AppModel, screens::compare::comparison::Comparison};
use crate::tui::{screens::compare::view::heading, shown::ShownAnswer, view::chart::mark};
use crate::tui::{view::eye::EyePicture, view::sheet::Sheet, view::text::fitted, work::brief};

/// Side by side, all at the same time and on the same scale of force.
pub(super) fn replays(compare: &Comparison, model: &AppModel, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    heading(compare, "", sheet);
    let entries = &compare.entries;
    if entries.is_empty() {
        return;
    }
    // All are filled with the same on one scale, as far as they have it.
    let answers = || {
        entries.iter().filter_map(|entry| match &entry.found {
            Found::Answer(shown) => Some(shown),
            _ => None,
        })
    };
    let largest = answers().map(|shown| shown.hottest).fold(0.0, f64::max);
    let wanted = answers().find_map(|shown| model.clock.field(&shown.fields));
    let wanted = wanted.map(|(field, _)| field);
    let own = |shown: &ShownAnswer| {
        let mut fields = shown.fields.iter().copied();
        fields.find(|(field, _)| Some(*field) == wanted)
    };
    let ends = answers().filter_map(|shown| own(shown));
    let end = ends.map(|(_, end)| end).fold(0.0, f64::max);
    let field = |shown: &ShownAnswer| match own(shown) {
        Some((field, _)) => Some((field, end)),
        None => model.clock.field(&shown.fields),
    };
    let zoom = match model.clock.zoom() {
        1 => String::new(),
        times => format!("  shown {times}x larger"),
    };
    let aligned = compare.alignment.words();
    let text = format!("{:.3} ms{zoom}  {aligned}", compare.time(model) * 1e3);
    sheet.put_right((area.width - 1, 0), &text, theme.strong());
    let time = |answer: &Answer| {
        let time = compare.time(model) + compare.shift(answer);
        time.clamp(0.0, answer.window())
    };
    let count = entries.len() as u16;
    let rows = if count > 3 { 2 } else { 1 };
    let columns = count.div_ceil(rows);
    let (width, height) = (area.width / columns, (area.height - 1) / rows);
    for (i, entry) in entries.iter().enumerate() {
        let (column, row) = (i as u16 % columns, i as u16 / columns);
        let place = &mut sheet.part((column * width, 1 + row * height), (width, height));
        let name = fitted(brief(&entry.name), usize::from(width) - 4);
        place.put((1, 0), mark(i).to_string(), theme.curve(i));
        place.put((3, 0), name, theme.strong());
        let picture = &mut place.part((0, 1), (width - 1, height - 1));
        match &entry.found {
            Found::Answer(shown) => EyePicture {
                largest,
                field: field(shown),
                blow: Some(&entry.scenario),
                ..EyePicture::of(model, shown, time(&shown.answer))
            }
            .draw(picture.area, picture.buffer),
            Found::Awaited => {
                picture.put((1, 1), "simulating", theme.quiet());
            }
            Found::Refused(why) => {
                let why = fitted(why, usize::from(picture.area.width) - 1);
                picture.put((1, 1), &why, theme.error());
            }
        }
    }
}
