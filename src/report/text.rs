//! Results as text for a terminal of 80 columns.

use crate::report::figure::{
    Figure, PARTS, SCALE, cut_signs, error_signs, times_its_limit, unusable, with_unit,
};
use crate::report::format::{WIDTH, block, capital, digits, paragraph, percent, significant};
use crate::report::json::AZIMUTH;
use crate::report::{errors, limit};

use crate::answer::results::Results;
use crate::answer::solve::{Answer, Errors};
use crate::plain_text::printable;
use crate::run::model::{Detail, Shown};
use crate::run::{flags::FlagKind, quantity::Quantity, result_trace::Group};
use crate::scenario::{Projectile, Scenario};
use crate::scenario::{direction::o_clock, problem::plain};
use std::io::{self, Write};

/// Results under headings, by what their traces are shown with.
const GROUPS: [(&str, &[Group]); 5] = [
    ("Motion and energy", &[Group::Motion, Group::Energies]),
    ("Pressure and stress", &[Group::Inside]),
    ("Tissues", &[Group::Tissues]),
    ("The object", &[Group::Projectile]),
    ("Forces of single nodes", &[Group::NodeForces]),
];

/// Prints the results of an answer.
pub fn results(scenario: &Scenario, answer: &Answer, out: &mut dyn Write) -> io::Result<()> {
    let eye = &answer.case.eye;
    writeln!(out, "{}", printable(&scenario.name))?;
    let model = format!(
        "{}; mesh level {}: {} nodes, {} {}",
        scenario.description(),
        eye.level(),
        eye.regions().len(),
        eye.elements(),
        eye.rules().element.plural()
    );
    paragraph(&model, out)?;
    writeln!(out)?;
    crate::report::risks::text(answer, out)?;
    writeln!(out)?;
    damage(answer, out)?;
    // The parts of the index stand above; an object that missed has no force of contact.
    let above = [Quantity::ShellGrowth, Quantity::MeridianGrowth];
    let missed = |of: &Quantity| *of == Quantity::Contact && answer.run.missed;
    let listed = |of: &&Quantity| !above.contains(of) && !missed(of) && !of.is_risk();
    for (title, groups) in GROUPS {
        let mut lines = Vec::new();
        for &quantity in Quantity::ALL.iter().filter(listed) {
            let group = quantity.row().trace.map(|trace| trace.place.0);
            if group.is_some_and(|group| groups.contains(&group))
                && let (Some(peak), Some(figure)) =
                    (answer.peak(quantity), Figure::of(answer, quantity))
            {
                let when = remark(scenario, answer, quantity);
                let when = format!("at {:.3} ms{when}", peak.time * 1e3);
                row(&capital(quantity.row().label), &figure, &when, &mut lines)?;
            }
        }
        if groups.contains(&Group::Projectile) {
            rebound(scenario, answer, &mut lines)?;
        }
        if !lines.is_empty() {
            writeln!(out, "{title}")?;
            out.write_all(&lines)?;
            writeln!(out)?;
        }
    }
    signs(answer, out)?;
    for detail in &answer.run.details {
        let (label, figure, words) = match &detail.shown {
            Shown::OnLine(label, words) => (label, significant(detail.value), words),
            Shown::About(label, words) => (label, digits(detail.value, 2), words),
            Shown::InData | Shown::Behind(..) => continue,
        };
        writeln!(out, "{label:<18} {figure:>9} {words}")?;
    }
    crate::report::risks::evidence(answer, out)?;
    Ok(())
}

/// The words behind a peak and its time, with the clock hour where the place has one.
pub(super) fn remark(scenario: &Scenario, answer: &Answer, of: Quantity) -> String {
    if of == Quantity::Pressure {
        return ", mean of the globe".to_owned();
    }
    let behind = |detail: &Detail| match &detail.shown {
        Shown::Behind(result, words) if *result == of => {
            let place = detail.key.trim_end_matches(AZIMUTH).trim_end_matches("_angle_deg");
            let around = answer.run.detail(&format!("{place}{AZIMUTH}"));
            let hour = around.map(|around| scenario.eye_side().hour(around.to_radians()));
            let hour = hour.map_or_else(String::new, |hour| format!(" ({})", o_clock(hour)));
            Some(format!(", {words}{hour}"))
        }
        _ => None,
    };
    answer.run.details.iter().find_map(behind).unwrap_or_default()
}

/// Prints how fast the object goes on or back.
fn rebound(scenario: &Scenario, answer: &Answer, out: &mut dyn Write) -> io::Result<()> {
    let figure = Figure::of(answer, Quantity::Rebound);
    let (Some(projectile), Some(mut figure)) = (scenario.projectile(), figure) else {
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
    row(label, &figure, &format!("of {} m/s", projectile.speed_m_s), out)?;
    unverified(projectile, out)
}

/// A row of a result: its name, the figure, and what else is to be said.
pub(super) fn row(name: &str, figure: &Figure, more: &str, out: &mut dyn Write) -> io::Result<()> {
    let line = format!(
        "{name:<19} {:>8} {:<3} {:<8} {more}",
        figure.cell(),
        figure.unit,
        figure.off.to_string()
    );
    let line = line.trim_end();
    match line.split_once(", ") {
        // Where it happened may need a line of its own.
        Some((when, place)) if line.chars().count() > WIDTH => {
            writeln!(out, "{when},\n{:12}{place}", "")
        }
        _ => writeln!(out, "{line}"),
    }
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
        row(&format!("  {}", of.row().label), &figure, &format!("{times} of {limit}"), out)?;
    }
    writeln!(out)
}

/// What the signs behind the figures mean.
fn signs(answer: &Answer, out: &mut dyn Write) -> io::Result<()> {
    writeln!(out, "{}", error_signs(answer))?;
    if Quantity::ALL.iter().any(|of| answer.cut(*of).is_some()) {
        writeln!(out, "{}", cut_signs(std::iter::once(answer)))?;
    }
    Ok(())
}

/// Names the figures of an object that come from no source that was checked.
fn unverified(input: &Projectile, out: &mut dyn Write) -> io::Result<()> {
    if input.unverified.is_empty() {
        return Ok(());
    }
    let text = format!("Unverified figures: {}", input.unverified.join(", "));
    block(&text, "", "", out)
}

/// Prints what finer meshes tend to, and which results they do not agree on.
fn limits(answer: &Answer, out: &mut dyn Write) -> io::Result<()> {
    if let Some(limit) = limit::here_and_in_the_limit(answer, Quantity::Damage) {
        writeln!(out, "Damage index: {limit}")?;
    }
    let unknown = limit::unknown(answer).unwrap_or_default();
    block(&unknown, "", "", out)
}

/// Prints how far the results may be trusted, and how they were computed.
pub fn trust(answer: &Answer, reasons: &[String], out: &mut dyn Write) -> io::Result<()> {
    numerical(&answer.errors, out)?;
    limits(answer, out)?;
    let balance = percent(answer.errors.energy_balance);
    writeln!(out, "Energy balance: within {balance}")?;
    writeln!(
        out,
        "Solved in {:.2} ms by {}: {} steps of {:.4} us{},\nstable up to {:.4} us",
        answer.solve_time.as_secs_f64() * 1e3,
        answer.plan.integrator.name(),
        answer.run.cost.steps,
        answer.step * 1e6,
        if answer.case.rules().step_follows_motion { " at rest" } else { "" },
        answer.step_limit * 1e6,
    )?;
    let at = answer.run.simulated;
    let why = if answer.pressed_flat() {
        "the eye was pressed flat, and there the model ends"
    } else {
        answer.case.rules().ends_early
    };
    if answer.case.ends_by_itself() && !answer.has(FlagKind::WindowCapped) {
        writeln!(out, "Stopped at {:.3} ms: {why}", at * 1e3)?;
    } else if at < 0.999_999 * answer.window() {
        let window = plain((answer.window() * 1e9).round() / 1e6);
        writeln!(out, "Stopped at {:.3} of {window} ms: {why}", at * 1e3)?;
    }
    for reason in reasons {
        writeln!(out, "  {reason}")?;
    }
    for flag in &answer.flags {
        paragraph(&format!("FLAG {}: {}", flag.kind.name(), flag.whole()), out)?;
    }
    Ok(())
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::solve::tests::answered;
    use crate::scenario::library::tests::preset;

    #[test]
    fn places_around_the_eye_have_clock_hours_in_text_and_data() {
        let changes = [("impact.from", "Nose"), ("window_ms", "0.05")];
        let scenario = preset("bb-62", &changes);
        let answer = answered(&scenario);
        let data = crate::report::json::answer(&scenario, &answer, &[]);
        let hour = data["results"]["scleral_stress_clock_h"].as_f64().unwrap();
        assert_eq!(data["direction"], "from the nose at 30 deg");
        let words = remark(&scenario, &answer, Quantity::ScleralStress);
        assert!(words.ends_with(&format!(" ({})", o_clock(hour))), "{words}");
    }
}
