//! What is not known of the inputs: a band for every result, and what drives one of them.
//!
//! Each band has a scale of its own, from the least to the greatest of band and nominal value; a
//! diamond stands where the scenario as it is lies. So shapes compare, and numbers stand beside.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::text::{fitted, put, put_both, put_right, width, wrapped};
use super::theme::Theme;
use crate::report::ensemble::{distribution, hundredths};
use crate::report::text::{percent, significant};
use crate::study::bands::Band;
use crate::study::ensemble::Ensemble;
use crate::study::outputs::OUTPUTS;
use crate::tui::model::Model;

/// Columns of a result's name, and of each of its three numbers.
const LABEL: u16 = 19;
const NUMBER: u16 = 9;
/// Rows of what drives a result, at least: its name and the strongest three.
const DRIVERS: u16 = 4;
/// The share of the range that is left free at both ends of a scale.
const MARGIN: f64 = 0.06;

/// Draws the screen.
pub fn draw(model: &Model, area: Rect, buffer: &mut Buffer) {
    let theme = Theme::of(model.look);
    let (said, style) = status(model, theme);
    let title = ("5 to 95 % of samples", theme.heading());
    put_both(buffer, area, title, (&said, style));
    let Some((_, ensemble)) = &model.ensemble.done else {
        let text = match (&model.ensemble.job, &model.ensemble.complaint) {
            (Some(_), _) => {
                "The blow is simulated over the published spreads of the eye's materials and over \
                 your own doubt in the inputs: type 300 +- 20 into a field to add some."
            }
            (None, Some(why)) => why,
            (None, None) => "not known yet: m runs the samples",
        };
        for (row, line) in (2..).zip(wrapped(text, usize::from(area.width - 2))) {
            put(buffer, area, (1, row), &line, theme.text());
        }
        return;
    };
    let outputs = ensemble.outputs();
    let chosen = model.ensemble.output.min(outputs.len().saturating_sub(1));
    heading(area, theme, buffer);
    // The results scroll where what drives the chosen one would find no room.
    let free = area.height.saturating_sub(3 + DRIVERS);
    let shown = outputs.len().min(usize::from(free));
    let first = (chosen + 1).saturating_sub(shown);
    for (row, index) in outputs.iter().skip(first).take(shown).enumerate() {
        let line = Rect::new(area.x, area.y + 2 + row as u16, area.width, 1);
        result(ensemble, *index, first + row == chosen, theme, line, buffer);
    }
    if shown < outputs.len() {
        let text = format!("{} to {} of {}", first + 1, first + shown, outputs.len());
        put(buffer, area, (1, 1), &text, theme.quiet());
    }
    let top = 3 + shown as u16;
    let below = area.height.saturating_sub(top);
    // What drives is worth more than all the notes.
    let spare = below.saturating_sub(DRIVERS);
    let notes = notes(ensemble, usize::from(area.width - 2), spare);
    let kept = notes.len() as u16;
    if let Some(output) = outputs.get(chosen) {
        let field = Rect::new(area.x, area.y + top, area.width, below - kept);
        drivers(ensemble, *output, theme, field, buffer);
    }
    let first = area.height - kept;
    for (i, line) in notes.iter().enumerate() {
        put(buffer, area, (1, first + i as u16), line, theme.quiet());
    }
}

fn status(model: &Model, theme: Theme) -> (String, Style) {
    let current = model.ensemble.of(&model.work.scenario);
    match (&model.ensemble.job, &model.ensemble.complaint) {
        (Some(job), _) if job.stopping => ("stopping".to_owned(), theme.warning()),
        (Some(job), _) => {
            let text = format!("running {:.0} %  Esc stops", job.share * 100.0);
            (text, theme.warning())
        }
        (None, _) if model.ensemble.done.is_some() && current.is_none() => {
            let text = "of another scenario: m runs this one".to_owned();
            (text, theme.warning())
        }
        (None, Some(why)) => (format!("{why}: m runs all"), theme.warning()),
        (None, None) => {
            let count = current.map_or(0, |ensemble| ensemble.samples.len());
            (format!("{count} samples"), theme.quiet())
        }
    }
}

fn heading(area: Rect, theme: Theme, buffer: &mut Buffer) {
    for (i, word) in ["5 %", "median", "95 %"].iter().enumerate() {
        let right = LABEL + 2 + NUMBER * (i as u16 + 1);
        put_right(buffer, area, (right, 1), word, theme.quiet());
    }
    let text = "◆ as it stands";
    if LABEL + 3 + 3 * NUMBER + width(text) < area.width {
        put_right(buffer, area, (area.width - 1, 1), text, theme.quiet());
    }
}

fn result(
    ensemble: &Ensemble,
    index: usize,
    chosen: bool,
    theme: Theme,
    area: Rect,
    buffer: &mut Buffer,
) {
    let output = &OUTPUTS[index];
    let Some(band) = ensemble.band(index) else {
        return;
    };
    let style = if chosen { theme.strong() } else { theme.text() };
    put(
        buffer,
        area,
        (0, 0),
        if chosen { "▸" } else { " " },
        theme.strong(),
    );
    let name = format!("{} {}", output.label, output.unit);
    put(
        buffer,
        area,
        (1, 0),
        &fitted(&name, usize::from(LABEL + 1)),
        style,
    );
    for (i, value) in [band.low, band.median, band.high].iter().enumerate() {
        let right = LABEL + 2 + NUMBER * (i as u16 + 1);
        put_right(buffer, area, (right, 0), &significant(*value), style);
    }
    let left = LABEL + 4 + 3 * NUMBER;
    if left + 8 < area.width {
        let field = Rect::new(area.x + left, area.y, area.width - left - 1, 1);
        let nominal = ensemble.nominal.as_ref().map(|n| n[index]);
        strip(band, nominal, theme, field, buffer);
    }
}

/// A band as a line with its median, and the nominal value.
fn strip(band: Band, nominal: Option<f64>, theme: Theme, area: Rect, buffer: &mut Buffer) {
    let own = nominal.unwrap_or(band.median);
    let (low, high) = (band.low.min(own), band.high.max(own));
    let wide = high - low;
    let last = f64::from(area.width - 1);
    let place = |value: f64| {
        let share = if wide > 0.0 {
            (value - low) / wide
        } else {
            0.5
        };
        ((MARGIN + (1.0 - 2.0 * MARGIN) * share) * last).round() as u16
    };
    let (from, to) = (place(band.low), place(band.high));
    for x in from..=to {
        put(buffer, area, (x, 0), "─", theme.curve(0));
    }
    put(buffer, area, (from, 0), "├", theme.curve(0));
    put(buffer, area, (to, 0), "┤", theme.curve(0));
    put(buffer, area, (place(band.median), 0), "┃", theme.cursor());
    if let Some(value) = nominal {
        put(buffer, area, (place(value), 0), "◆", theme.warning());
    }
}

fn drivers(ensemble: &Ensemble, output: usize, theme: Theme, area: Rect, buffer: &mut Buffer) {
    let text = format!("What drives {}: rank correlation", OUTPUTS[output].label);
    put(buffer, area, (1, 0), &text, theme.heading());
    if ensemble.inputs.is_empty() {
        let text = "nothing was drawn: every input is held to be known";
        put(buffer, area, (1, 1), text, theme.text());
    }
    let wide = area.width.saturating_sub(LABEL + 10);
    // Beside the bars there may be room for what the input was drawn from.
    let said = if wide >= 70 { 40 } else { 0 };
    let half = (wide - said) / 2;
    let middle = LABEL + 9 + half;
    let rows = usize::from(area.height.saturating_sub(1));
    for (row, (input, correlation)) in (1..).zip(ensemble.drivers(output).into_iter().take(rows)) {
        let of = &ensemble.inputs[input];
        let style = if of.source.is_none() {
            theme.strong()
        } else {
            theme.text()
        };
        put(
            buffer,
            area,
            (1, row),
            &fitted(of.field.label, usize::from(LABEL)),
            style,
        );
        let number = hundredths(correlation);
        put_right(buffer, area, (LABEL + 7, row), &number, theme.text());
        let length = (correlation.abs() * f64::from(half)).round() as u16;
        put(buffer, area, (middle, row), "│", theme.line());
        for i in 1..=length.min(half) {
            let x = if correlation < 0.0 {
                middle - i
            } else {
                middle + i
            };
            let curve = theme.curve(usize::from(correlation > 0.0));
            put(buffer, area, (x, row), "█", curve);
        }
        if said > 0 {
            let text = fitted(&distribution(of), usize::from(said - 2));
            put(buffer, area, (area.width - said, row), &text, theme.quiet());
        }
    }
}

/// How samples were counted and how exact they are: as many sentences as fit whole.
fn notes(ensemble: &Ensemble, room: usize, rows: u16) -> Vec<String> {
    let (done, valid) = (ensemble.samples.len(), ensemble.valid().count());
    let mut said = vec![format!(
        "Bands of {valid} of {done} samples, {}",
        ensemble.which()
    )];
    let counts: Vec<String> = ensemble
        .counts()
        .into_iter()
        .map(|(name, count)| format!("{count} {}", name.replace('_', " ")))
        .collect();
    if !counts.is_empty() {
        said.push(format!("Flags: {}.", counts.join(", ")));
    }
    let checks = ensemble.checks();
    let (error, count) = (percent(checks.last), checks.count);
    said.push(format!("Step error up to {error} in {count} compared."));
    let written = |count: usize| wrapped(&said[..count].join(" "), room);
    let fits = |lines: &Vec<String>| lines.len() <= usize::from(rows);
    let counts = (0..=said.len()).rev();
    counts.map(written).find(fits).unwrap_or_default()
}
