//! An answer in three lines, to paste into a mail or a chart: what to believe, figures with their
//! errors, flags.

use crate::answer::solve::Answer;
use crate::plain_text::printable;
use crate::report::figure::{Figure, SCALE, error_signs, unusable};
use crate::report::risks::{first_line, legend};
use crate::run::quantity::Quantity;
use crate::scenario::Scenario;

/// The three lines, and the command that repeats the blow as a fourth, if one does.
pub fn text(scenario: &Scenario, answer: &Answer, command: Option<&str>) -> String {
    let name = printable(&scenario.name);
    let verdict = first_line(answer);
    let shown = [Quantity::Apex, Quantity::Pressure, Quantity::Contact];
    let figures = shown.iter().filter_map(|of| {
        let figure = Figure::of(answer, *of)?;
        Some(format!("; {} {figure}", of.row().label))
    });
    let figures: String = figures.collect();
    let index = Figure::of(answer, Quantity::Damage).map_or_else(String::new, |f| f.to_string());
    let index = match unusable(answer) {
        Some(why) => format!("{why}; raw {index}"),
        None => format!("damage index {index} ({SCALE})"),
    };
    let signs = error_signs(answer);
    let flags: Vec<&str> = answer.flags.iter().map(|flag| flag.kind.name()).collect();
    let flags =
        if flags.is_empty() { "no flags".into() } else { format!("flags: {}", flags.join(", ")) };
    let bb = legend(std::iter::once(answer)).map_or_else(String::new, |bb| format!("; {bb}"));
    let command = command.map_or_else(String::new, |command| format!("{command}\n"));
    format!(
        "{name}: {verdict}\n\
         {index}{figures} ({signs})\n\
         {flags}{bb}; research and education, not diagnosis\n{command}"
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::solve::tests::answered;
    use crate::scenario::library::tests::preset;

    #[test]
    fn three_lines_say_what_to_believe_and_a_fourth_repeats_it() {
        let bb = preset("bb-56", &[("window_ms", "0.2")]);
        let text = text(&bb, &answered(&bb), Some("contrecoup run bb-56"));
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 4, "{text}");
        assert!(lines[0].starts_with("Steel BB at 56 m/s: globe rupture: "), "{text}");
        assert!(lines[1].starts_with("damage index so far "), "{text}");
        // The window ends while the ball presses on: each other figure may still grow.
        assert_eq!(lines[1].matches("; ").count(), lines[1].matches(" at least ").count());
        assert!(lines[1].contains("; peak pressure at least "));
        assert!(lines[1].contains("±") && lines[1].contains("mesh not estimated"));
        assert!(lines[2].starts_with("flags: ") && lines[2].contains("window_short"), "{text}");
        assert_eq!(lines[3], "contrecoup run bb-56");
    }
}
