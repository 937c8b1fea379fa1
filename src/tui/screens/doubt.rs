//! What the doubt in the inputs does to each result: runs many samples while it is on show. A band
//! for every result but the risks, whose ranges stand with the answer and hold what a person doubts
//! of the object, and what drives one of them.
//!
//! Each band has a scale of its own, from the least to the greatest of band and nominal value; a
//! diamond stands where the scenario as it is lies. So shapes compare, and numbers stand beside.

use ratatui::style::Style;

use crate::injury::Injury;
use crate::many::{bands::Band, ensemble::Ensemble};
use crate::report::ensemble::{distribution, hundredths};
use crate::report::figure::allowing;
use crate::report::format::{digits, percent};
use crate::run::quantity::Quantity;
use crate::tui::ensemble::{FIRST, MANY, RunSamples, is_whole};
use crate::tui::keys::press::{DOWN, UP, c};
use crate::tui::screens::screen::{Pane, PaneKeys, Panes, Screen, bind, go_on, state_of_work};
use crate::tui::view::text::{fitted, longest_fitting, numeral, seen, whole_sentences};
use crate::tui::view::{sheet::Sheet, theme::Theme};
use crate::tui::{keys::TimeKeys, model::AppModel, task::Job};

/// The place of the result whose band is explained.
#[derive(Default)]
pub struct Doubt {
    pub(crate) row: usize,
}

impl Panes for Doubt {
    const PANES: &'static [Pane<Self>] =
        &[Pane::new("outputs", TimeKeys::Absent, &[KEYS, STOPPED_KEYS])];
}

#[rustfmt::skip]
const KEYS: PaneKeys<Doubt> = PaneKeys::new("Doubt", &[
    bind(&[UP, c('k')], |s, m| s.move_cursor(m, -1), "result", "the result above"),
    bind(&[DOWN, c('j')], |s, m| s.move_cursor(m, 1), "&", "the result below"),
]);

const STOPPED_KEYS: PaneKeys<Doubt> =
    PaneKeys::<Doubt>::new("Doubt: stopped", &[go_on(|_, m| m.ensemble.task.complaint = None)])
        .when(|_, model| model.ensemble.complaint(&model.work.scenario).is_some());

impl Screen for Doubt {
    fn draw(&self, model: &AppModel, sheet: &mut Sheet) {
        let (area, theme) = (sheet.area, sheet.theme);
        let (said, style) = status(model, theme);
        let titles =
            ["How sure? Where 5 to 95 % of samples lie", "How sure? 5 to 95 %", "How sure?"];
        sheet.put_both((&titles, theme.heading()), (&said, style));
        // Bands of another scenario would be taken for those of this one.
        let Some(ensemble) = model.ensemble.of(&model.work.scenario) else {
            let complaint = model.ensemble.complaint(&model.work.scenario);
            let texts = match &model.ensemble.task.job {
                Some(job) => waiting(model, job),
                None => vec![complaint.unwrap_or("not known yet: m runs the samples").to_owned()],
            };
            let mut y = 2;
            for text in &texts {
                y = 1 + sheet.put_wrapped((1, y), text, theme.text());
            }
            return;
        };
        let results = ensemble.results();
        let chosen = self.row.min(results.len().saturating_sub(1));
        heading(sheet);
        let room = usize::from(area.width - 2);
        let notes = notes(ensemble);
        // The step error alone is said only where there is room.
        let needed = &notes[..notes.len().max(2) - 1];
        let least = whole_sentences(needed, room, NOTES.max(area.height / 6).into()).len();
        // The results scroll where the notes and what drives the chosen one would find no room.
        let free = usize::from(area.height.saturating_sub(2 + DRIVERS)).saturating_sub(least);
        let shown = results.len().min(free);
        let first = (chosen + 1).saturating_sub(shown);
        for (row, of) in results.iter().skip(first).take(shown).enumerate() {
            let of = (*of, first + row == chosen);
            result(ensemble, of, &mut sheet.row(2 + row as u16));
        }
        sheet.put((1, 1), seen(first, shown, results.len()), theme.quiet());
        let gap = u16::from(shown < free);
        let top = 2 + shown as u16 + gap;
        let below = area.height.saturating_sub(top);
        let rows = usize::from(below.saturating_sub(DRIVERS)).max(least);
        let notes = whole_sentences(&notes, room, rows);
        let kept = notes.len() as u16;
        if let Some(of) = results.get(chosen) {
            let size = (area.width, below.saturating_sub(kept));
            drivers(ensemble, *of, &mut sheet.part((0, top), size));
        }
        sheet.put_lines((1, area.height.saturating_sub(kept)), &notes, theme.quiet());
    }

    fn samples(&self) -> u32 {
        MANY
    }

    fn cancel(&mut self, model: &mut AppModel) -> bool {
        model.ensemble.task.end(&mut model.out)
    }
}

impl Doubt {
    fn move_cursor(&mut self, model: &AppModel, by: isize) {
        let Some(ensemble) = model.ensemble.of(&model.work.scenario) else { return };
        let last = ensemble.results().len().saturating_sub(1);
        self.row = self.row.min(last).saturating_add_signed(by).min(last);
    }
}

/// Columns of a result's name, and of each of its three numbers.
const LABEL: u16 = 21;
const NUMBER: u16 = 9;
/// The fewest columns of a band.
const SHORTEST: u16 = 8;
/// Rows of what drives a result, at least: its name and the strongest three.
const DRIVERS: u16 = 4;
/// Rows that the notes may always take: what the bands hold fits into them at any width.
const NOTES: u16 = 4;
/// The share of the range that is left free at both ends of a scale.
const MARGIN: f64 = 0.06;

/// What is computed before the first bands, and when those come.
fn waiting(model: &AppModel, job: &Job<RunSamples>) -> Vec<String> {
    let what = "The blow is simulated over what is published of the eye's materials and over your own \
                doubt in the inputs: type 300 +- 20 into a field to add some.";
    let each = model.shown.as_ref().map_or_else(String::new, |shown| {
        let seconds = digits(shown.answer.solve_time.as_secs_f64(), 1);
        format!(" One sample takes about as long as the blow itself: {seconds} s.")
    });
    let share = FIRST as f64 / f64::from(job.question.count);
    let until = job.pace.and_then(|pace| pace.until(share));
    let until = until.map_or_else(String::new, |until| format!(", in {until}"));
    let first = format!("The first bands come with sample {FIRST}{until}");
    vec![what.to_owned(), format!("{first}, and fill in from there.{each}")]
}

fn status(model: &AppModel, theme: Theme) -> (String, Style) {
    let (scenario, samples) = (&model.work.scenario, &model.ensemble);
    if samples.task.job.as_ref().is_some_and(|job| job.ending) {
        return ("stopping".to_owned(), theme.warning());
    }
    let count = samples.of(scenario).map(|ensemble| ensemble.samples.len());
    let known = count.map_or("no samples yet".to_owned(), |count| format!("{count} samples"));
    state_of_work(samples.pace(), samples.complaint(scenario), known, theme)
}

/// Where each of the three numbers of a result ends.
fn ends() -> impl Iterator<Item = u16> {
    (1..=3).map(|place| LABEL + 2 + NUMBER * place)
}

fn heading(sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    for (right, word) in ends().zip(["low", "median", "high"]) {
        sheet.put_right((right, 1), word, theme.quiet());
    }
    let room = area.width - LABEL - 4 - 3 * NUMBER;
    sheet.put_right(
        (area.width - 1, 1),
        longest_fitting(&["◆ as entered", ""], room),
        theme.quiet(),
    );
}

fn result(ensemble: &Ensemble, (of, chosen): (Quantity, bool), sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let Some(band) = ensemble.band(of) else { return };
    let style = if chosen { theme.strong() } else { theme.text() };
    let sign = if chosen { "▸" } else { " " };
    sheet.put((0, 0), sign, theme.strong());
    let name = format!("{} {}", of.label(), of.row().unit);
    sheet.put((1, 0), fitted(&name, usize::from(LABEL + 1)), style);
    for (right, value) in ends().zip([band.low, band.median, band.high]) {
        let off = Some(0.1 * (band.high - band.low));
        // One column is kept free, so that numbers do not touch.
        let texts = [allowing(value, off), numeral(value, NUMBER - 1)];
        sheet.put_right((right, 0), longest_fitting(&texts, NUMBER - 1), style);
    }
    let left = LABEL + 4 + 3 * NUMBER;
    if left + SHORTEST < area.width {
        let nominal = ensemble.nominal.as_ref().and_then(|n| n[of]);
        let field = (area.width - left - 1, 1);
        strip((band, nominal), ends_of(ensemble, of.row().unit), &mut sheet.part((left, 0), field));
    }
}

/// The ends of the one scale of all results of a unit, 0 among them: so bands of one unit can be
/// compared, and a narrow one looks narrow.
fn ends_of(ensemble: &Ensemble, unit: &str) -> (f64, f64) {
    let alike = ensemble.results().into_iter().filter(|of| of.row().unit == unit);
    let ends = alike.filter_map(|of| {
        let band = ensemble.band(of)?;
        let own = ensemble.nominal.as_ref().and_then(|n| n[of]).unwrap_or(band.median);
        Some((band.low.min(own), band.high.max(own)))
    });
    ends.fold((0.0, 0.0), |all, (low, high)| (all.0.min(low), all.1.max(high)))
}

/// A band as a line with its median, and the nominal value, on a scale with these ends.
fn strip((band, nominal): (Band, Option<f64>), (low, high): (f64, f64), sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let wide = high - low;
    let last = f64::from(area.width - 1);
    let place = |value: f64| {
        let share = if wide > 0.0 { (value - low) / wide } else { 0.5 };
        ((MARGIN + (1.0 - 2.0 * MARGIN) * share) * last).round() as u16
    };
    let (from, to) = (place(band.low), place(band.high));
    sheet.put((from, 0), "─".repeat(usize::from(to - from)), theme.curve(0));
    sheet.put((from, 0), "├", theme.curve(0));
    sheet.put((to, 0), "┤", theme.curve(0));
    sheet.put((place(band.median), 0), "┃", theme.cursor());
    if let Some(value) = nominal {
        sheet.put((place(value), 0), "◆", theme.warning());
    }
}

fn drivers(ensemble: &Ensemble, result: Quantity, sheet: &mut Sheet) {
    let (area, theme) = (sheet.area, sheet.theme);
    let text = format!("What drives {}: 0 nothing, 1 alone", result.label());
    let end = sheet.put((1, 0), &text, theme.heading());
    let rows = usize::from(area.height.saturating_sub(1));
    let all = ensemble.inputs.len();
    if rows < all {
        let texts = [format!("the strongest {rows} of {all}"), format!("{rows} of {all}")];
        let text = longest_fitting(&texts, area.width - end - 3);
        sheet.put_right((area.width - 1, 0), text, theme.quiet());
    }
    if ensemble.inputs.is_empty() {
        let text = "nothing was drawn: every input is held to be known";
        sheet.put((1, 1), text, theme.text());
    }
    let wide = area.width.saturating_sub(LABEL + 10);
    // Beside the bars there may be room for what the input was drawn from.
    let said = if wide >= 70 { 40 } else { 0 };
    let half = (wide - said) / 2;
    let middle = LABEL + 9 + half;
    for (row, (input, correlation)) in (1..).zip(ensemble.drivers(result).into_iter().take(rows)) {
        let of = &ensemble.inputs[input];
        let own = of.source.is_none();
        let style = if own { theme.strong() } else { theme.text() };
        sheet.put((1, row), fitted(of.field.label, usize::from(LABEL)), style);
        sheet.put_right((LABEL + 7, row), hundredths(correlation), theme.text());
        sheet.put((middle, row), "│", theme.quiet());
        let length = ((correlation.abs() * f64::from(half)).round() as u16).min(half);
        let right = correlation > 0.0;
        let left = if right { middle + 1 } else { middle - length };
        sheet.put((left, row), "█".repeat(length.into()), theme.curve(right.into()));
        if said > 0 {
            let text = fitted(&distribution(of), usize::from(said - 2));
            sheet.put((area.width - said, row), &text, theme.quiet());
        }
    }
}

/// Said where an answer has risks.
const RISKS: &str = "Risks and their ranges stand on F1: what you doubt of the object widens them.";

/// What the bands hold, in sentences, and how exact they are; the most needed first.
fn notes(ensemble: &Ensemble) -> Vec<String> {
    let (done, valid) = (ensemble.samples.len(), ensemble.valid().count());
    // The star is that of the band on the main screen.
    let star = if is_whole(ensemble) { "" } else { "* " };
    let asked = ensemble.stopped().then(|| format!(" done ({} asked for)", ensemble.asked));
    let asked = asked.unwrap_or_default();
    let which = ensemble.which();
    let mut said = vec![format!("{star}Bands of {valid} of {done} samples{asked}, {which}")];
    let counts = ensemble.counts().into_iter();
    let counts: Vec<String> =
        counts.map(|(name, count)| format!("{count} {}", name.replace('_', " "))).collect();
    if !counts.is_empty() {
        said.push(format!("Flags: {}.", counts.join(", ")));
    }
    let rupture = Injury::GlobeRupture.result();
    if ensemble.nominal.as_ref().is_some_and(|nominal| nominal[rupture].is_some()) {
        said.push(RISKS.to_owned());
    }
    let checks = ensemble.checks();
    if checks.count > 0 {
        let (error, count) = (percent(checks.last), checks.count);
        said.push(format!("Step error up to {error} in {count} compared."));
    }
    said
}
