//! Results as text for a terminal of 80 columns.

use crate::report::figure::{
    CUT, Figure, PARTS, SCALE, causes, times_its_limit, unusable, with_unit,
};
use crate::report::{errors, limit};
use unicode_width::UnicodeWidthStr;

use crate::answer::results::Results;
use crate::answer::solve::{Answer, Errors};
use crate::plain_text::printable;
use crate::run::flags::Flag;
use crate::run::model::Shown;
use crate::run::quantity::Quantity;
use crate::scenario::{Impact, Projectile, Scenario};
use std::io::{self, Write};

/// A number with four significant digits, in plain notation where that is readable.
pub fn significant(value: f64) -> String {
    digits(value, 4)
}

/// A number with `count` significant digits, in plain notation where that is readable.
pub fn digits(value: f64, count: i32) -> String {
    let size = value.abs();
    if value == 0.0 {
        "0".to_owned()
    } else if !(1e-4..1e6).contains(&size) {
        let after = (count - 1) as usize;
        format!("{value:.after$e}")
    } else {
        let after = (count - 1 - size.log10().floor() as i32).max(0) as usize;
        format!("{value:.after$}")
    }
}

/// An error in percent: two digits are all it can bear.
pub fn percent(value: f64) -> String {
    match value {
        0.0 => "0 %".to_owned(),
        v if v < 1e-4 => "< 0.0001 %".to_owned(),
        v if v < 10.0 => {
            let digits = (1 - v.log10().floor() as i32).max(0) as usize;
            format!("{v:.digits$} %")
        }
        v => format!("{v:.0} %"),
    }
}

/// Columns of a line.
pub(super) const WIDTH: usize = 80;

/// `text` in lines of at most `width` cells, broken between words but not before a percent sign.
pub fn wrapped(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    let held = text.replace(" %", "\u{a0}%");
    for word in held.split_ascii_whitespace() {
        let word = word.replace('\u{a0}', " ");
        match lines.last_mut() {
            Some(line) if line.width() + 1 + word.width() <= width => {
                line.push(' ');
                line.push_str(&word);
            }
            _ => lines.push(word),
        }
    }
    lines
}

/// Prints a text in lines of 80 columns, those that go on indented.
pub(super) fn paragraph(text: &str, out: &mut dyn Write) -> io::Result<()> {
    block(text, "", "    ", out)
}

/// Prints a text in lines of 80 columns, with what stands before the first and before those that
/// go on.
pub(super) fn block(text: &str, first: &str, rest: &str, out: &mut dyn Write) -> io::Result<()> {
    for (i, part) in wrapped(text, WIDTH - rest.len()).iter().enumerate() {
        writeln!(out, "{}{part}", if i == 0 { first } else { rest })?;
    }
    Ok(())
}

/// Prints the results of an answer.
///
/// # Errors
/// Whatever `out` reports.
pub fn results(scenario: &Scenario, answer: &Answer, out: &mut dyn Write) -> io::Result<()> {
    let (model, eye) = (scenario.model.description(), &answer.case.eye);
    writeln!(out, "{}", printable(&scenario.name))?;
    writeln!(
        out,
        "{model}; mesh level {}: {} nodes, {} {}\n",
        eye.level(),
        eye.regions().len(),
        eye.elements(),
        eye.rules().element.plural()
    )?;
    let mesh = answer.errors.mesh.is_some();
    crate::report::verdict::text(&answer.verdicts(), mesh, out)?;
    writeln!(out)?;
    damage(answer, out)?;
    // The parts of the index stand above; an object that missed has no force of contact.
    let above = [Quantity::ShellGrowth, Quantity::MeridianGrowth];
    let missed = |of: &Quantity| *of == Quantity::Contact && answer.run.missed;
    let listed = |of: &&Quantity| !above.contains(of) && !missed(of);
    for &quantity in Quantity::ALL.iter().filter(listed) {
        if let (Some(peak), Some(figure)) = (answer.peak(quantity), Figure::of(answer, quantity)) {
            let when = format!("at {:.3} ms{}", peak.time * 1e3, remark(answer, quantity));
            row(&capital(quantity.row().label), &figure, &when, out)?;
        }
    }
    signs(answer, out)?;
    for detail in &answer.run.details {
        if let Shown::OnLine(label, words) = &detail.shown {
            writeln!(out, "{label:<18} {:>9} {words}", significant(detail.value))?;
        }
    }
    rebound(scenario, answer, out)?;
    crate::report::injury::text(&answer.risks(), out)?;
    Ok(())
}

/// The words behind a peak and its time.
fn remark(answer: &Answer, of: Quantity) -> String {
    if of == Quantity::Pressure {
        return ", mean of the globe".to_owned();
    }
    let mut behind = answer
        .run
        .details
        .iter()
        .filter_map(|detail| match &detail.shown {
            Shown::Behind(result, words) if *result == of => Some(format!(", {words}")),
            _ => None,
        });
    behind.next().unwrap_or_default()
}

/// Prints how fast the object goes on or back.
fn rebound(scenario: &Scenario, answer: &Answer, out: &mut dyn Write) -> io::Result<()> {
    let figure = Figure::of(answer, Quantity::Rebound);
    let (Impact::Projectile(projectile), Some(mut figure)) = (&scenario.impact, figure) else {
        return Ok(());
    };
    let label = match figure.number.strip_prefix('-') {
        Some(on) => {
            figure.number = on.to_owned();
            // What still goes on slows down.
            figure.cut = None;
            "Goes on at"
        }
        None => "Rebound speed",
    };
    row(
        label,
        &figure,
        &format!("of {} m/s", projectile.speed_m_s),
        out,
    )?;
    unverified(projectile, out)
}

/// A row of a result: its name, the figure, and what else is to be said.
fn row(name: &str, figure: &Figure, more: &str, out: &mut dyn Write) -> io::Result<()> {
    let line = format!(
        "{name:<19} {:>8} {:<3} {:<8} {more}",
        figure.cell(),
        figure.unit,
        figure.off.to_string()
    );
    writeln!(out, "{}", line.trim_end())
}

/// The damage index and its parts.
fn damage(answer: &Answer, out: &mut dyn Write) -> io::Result<()> {
    if let Some(why) = unusable(answer) {
        paragraph(&format!("{why}; raw figures:"), out)?;
    }
    if let Some(index) = Figure::of(answer, Quantity::Damage) {
        row("Damage index", &index, &format!("({SCALE})"), out)?;
    }
    for (of, term) in PARTS {
        let (Some(figure), Some(value)) = (Figure::of(answer, of), answer.result(of)) else {
            continue;
        };
        let times = times_its_limit(&figure, value, term);
        let limit = with_unit(&term.threshold.to_string(), figure.unit);
        row(
            &format!("  {}", of.row().label),
            &figure,
            &format!("{times} of {limit}"),
            out,
        )?;
    }
    writeln!(out)
}

/// What the signs behind the figures mean.
fn signs(answer: &Answer, out: &mut dyn Write) -> io::Result<()> {
    let unknown = match answer.errors.without_limit().next() {
        Some(_) => "; ±?: finer meshes show no limit",
        None => "",
    };
    writeln!(out, "±: {}{unknown}", causes(&answer.errors))?;
    if Quantity::ALL.iter().any(|of| answer.cut(*of).is_some()) {
        writeln!(out, "{CUT}")?;
    }
    Ok(())
}

/// `label` with a capital letter.
pub fn capital(label: &str) -> String {
    let mut letters = label.chars();
    letters.next().map_or_else(String::new, |first| {
        first.to_uppercase().chain(letters).collect()
    })
}

/// Names the figures of an object that come from no source that was checked.
fn unverified(input: &Projectile, out: &mut dyn Write) -> io::Result<()> {
    if input.unverified.is_empty() {
        return Ok(());
    }
    let text = format!("Unverified figures: {}", input.unverified.join(", "));
    block(&text, "", "", out)
}

/// Prints what finer meshes tend to, and which results they show no limit of.
fn limits(answer: &Answer, out: &mut dyn Write) -> io::Result<()> {
    if let Some(limit) = limit::here_and_in_the_limit(answer, Quantity::Damage) {
        writeln!(out, "Damage index: {limit}")?;
    }
    let unknown = limit::unknown(answer).unwrap_or_default();
    block(&unknown, "", "", out)
}

/// Prints how far the results may be trusted, and how they were computed.
///
/// # Errors
/// Whatever `out` reports.
pub fn trust(answer: &Answer, reasons: &[String], out: &mut dyn Write) -> io::Result<()> {
    numerical(&answer.errors, out)?;
    limits(answer, out)?;
    balance(&answer.errors, out)?;
    writeln!(
        out,
        "Solved in {:.2} ms by {}: {} steps of {:.4} us,\nstable up to {:.4} us",
        answer.solve_time.as_secs_f64() * 1e3,
        answer.plan.integrator.name(),
        answer.run.cost.steps,
        answer.step * 1e6,
        answer.step_limit * 1e6,
    )?;
    if answer.run.simulated < 0.999_999 * answer.window() {
        writeln!(
            out,
            "Stopped at {:.3} of {} ms: {}",
            answer.run.simulated * 1e3,
            answer.window() * 1e3,
            answer.case.rules().ends_early
        )?;
    }
    for reason in reasons {
        writeln!(out, "  {reason}")?;
    }
    flagged(&answer.flags, out)
}

/// Prints the errors of step and mesh.
fn numerical(of: &Errors, out: &mut dyn Write) -> io::Result<()> {
    let said = |of: &Results| {
        let (damage, worst) = (errors::of_damage(of), errors::worst(of));
        format!("damage index {damage}, worst {worst}")
    };
    writeln!(out, "\nStep error: {}", said(&of.time_step))?;
    if let Some(other) = errors::largest_other(&of.time_step) {
        writeln!(out, "  beside the leading results up to {other}")?;
    }
    let mesh = of.mesh.as_ref();
    let mesh = mesh.map_or_else(|| "not estimated".to_owned(), said);
    writeln!(out, "Mesh error: {mesh}")
}

/// Prints the balance of energy.
fn balance(of: &Errors, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "Energy balance: within {}", percent(of.energy_balance))
}

/// Prints the flags, and what no result may be taken for.
fn flagged(flags: &[Flag], out: &mut dyn Write) -> io::Result<()> {
    for flag in flags {
        paragraph(&format!("FLAG {}: {}", flag.kind.name(), flag.whole()), out)?;
    }
    writeln!(out, "\nResearch and education, not diagnosis.")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_carry_four_digits() {
        assert_eq!(significant(26.418_437), "26.42");
        assert_eq!(significant(0.004_971_1), "0.004971");
        assert_eq!(significant(1234.5), "1234");
        assert_eq!(significant(0.0), "0");
        assert_eq!(significant(-2.5e-9), "-2.500e-9");
    }

    #[test]
    fn errors_carry_two_digits() {
        assert_eq!(percent(0.012_34), "0.012 %");
        assert_eq!(percent(3.21), "3.2 %");
        assert_eq!(percent(123.4), "123 %");
        assert_eq!(percent(1e-7), "< 0.0001 %");
    }
}
