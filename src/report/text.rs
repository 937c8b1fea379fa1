//! Results as text for a terminal of 80 columns.

use crate::answer::{results::Results, solve::Answer};
use crate::report::figure::{Figure, PARTS, SCALE, cut_signs, error_signs};
use crate::report::figure::{here_and_in_the_limit, times_its_limit, unusable, with_unit};
use crate::report::format::{WIDTH, block, paragraph, wrapped};
use crate::report::format::{capital, digits, percent, significant};
use crate::report::{json::AZIMUTH, risks};
use crate::run::model::{Detail, Shown};
use crate::run::{flags::FlagKind, quantity::Quantity, result_trace::Group};
use crate::scenario::{Scenario, direction::o_clock, problem::plain};
use std::io::{self, Write};

/// Results under headings, by what their traces are shown with.
const GROUPS: [(&str, &[Group]); 5] = [
    ("Motion and energy", &[Group::Motion, Group::Energies]),
    ("Pressure and stress", &[Group::Inside]),
    ("Tissues", &[Group::Tissues]),
    ("The object", &[Group::Projectile]),
    ("Forces of single nodes", &[Group::NodeForces]),
];

pub fn results(scenario: &Scenario, answer: &Answer, out: &mut dyn Write) -> io::Result<()> {
    let eye = &answer.case.eye;
    let (level, nodes, elements) = (eye.level(), eye.nodes(), eye.elements());
    let (what, kind) = (scenario.description(), eye.rules().element.plural());
    let mesh = format!("mesh level {level}: {nodes} nodes, {elements} {kind}");
    risks::text(scenario, answer, out)?;
    writeln!(out)?;
    paragraph(&format!("{what}; {mesh}"), out)?;
    writeln!(out)?;
    writeln!(out, "{}\n", damage(answer).join("\n"))?;
    // The parts of the index stand above; an object that missed has no force of contact.
    let above = [Quantity::ShellGrowth, Quantity::MeridianGrowth];
    let missed = |of: &Quantity| *of == Quantity::Contact && answer.run.missed;
    let listed = |of: &&Quantity| !above.contains(of) && !missed(of) && !of.is_risk();
    for (title, groups) in GROUPS {
        let mut lines: Vec<String> = Vec::new();
        for &of in Quantity::ALL.iter().filter(listed) {
            if let Some(trace) = of.row().trace
                && groups.contains(&trace.place.0)
                && let (Some(peak), Some(figure)) = (answer.peak(of), Figure::of(answer, of))
            {
                let when = format!("at {:.3} ms{}", peak.time * 1e3, remark(scenario, answer, of));
                lines.push(row(&capital(of.row().label), &figure, &when));
            }
        }
        if groups.contains(&Group::Projectile) {
            lines.extend(rebound(scenario, answer));
        }
        if !lines.is_empty() {
            writeln!(out, "{title}\n{}\n", lines.join("\n"))?;
        }
    }
    writeln!(out, "{}", error_signs(answer))?;
    if Quantity::ALL.iter().any(|of| answer.cut(*of).is_some()) {
        writeln!(out, "{}", cut_signs(std::iter::once(answer)))?;
    }
    for detail in &answer.run.details {
        let (label, figure, words) = match &detail.shown {
            Shown::OnLine(label, words) => (label, significant(detail.value), words),
            Shown::About(label, words) => (label, digits(detail.value, 2), words),
            Shown::InData | Shown::Behind(..) => continue,
        };
        writeln!(out, "{label:<18} {figure:>9} {words}")?;
    }
    risks::evidence(answer, out)
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

/// How fast the object goes on or back, and which of its figures come from no checked source.
fn rebound(scenario: &Scenario, answer: &Answer) -> Vec<String> {
    let Some(projectile) = scenario.projectile() else { return Vec::new() };
    let Some(mut figure) = Figure::of(answer, Quantity::Rebound) else { return Vec::new() };
    let label = match figure.number.strip_prefix('-') {
        Some(on) => {
            figure.number = on.to_owned();
            // What still goes on slows down.
            figure.cut = None;
            "Goes on at"
        }
        None => "Rebound speed",
    };
    let mut lines = vec![row(label, &figure, &format!("of {} m/s", projectile.speed_m_s))];
    if !projectile.unverified.is_empty() {
        let unverified = projectile.unverified.join(", ");
        lines.extend(wrapped(&format!("Unverified figures: {unverified}"), WIDTH));
    }
    lines
}

/// A row of a result: its name, the figure, and what else is to be said.
pub(super) fn row(name: &str, figure: &Figure, more: &str) -> String {
    let (cell, (unit, off)) = (figure.cell(), figure.unit_and_error());
    let line = format!("{name:<19} {cell:>8} {unit:<3} {off:<8} {more}");
    let line = line.trim_end();
    let is_long = line.chars().count() > WIDTH;
    match line.split_once(", ") {
        // Where it happened may need a line of its own.
        Some((when, place)) if is_long => format!("{when},\n{:12}{place}", ""),
        _ => line.to_owned(),
    }
}

/// The index and its three parts, each beside its limit, a row each.
pub(super) fn damage(answer: &Answer) -> Vec<String> {
    let why = unusable(answer).map(|why| wrapped(&format!("{why}; raw figures:"), WIDTH));
    let mut lines = why.unwrap_or_default();
    let index = Figure::of(answer, Quantity::Damage);
    lines.extend(index.map(|index| row("Damage index", &index, &format!("({SCALE})"))));
    for (of, term) in PARTS {
        if let (Some(figure), Some(value)) = (Figure::of(answer, of), answer.result(of)) {
            let times = times_its_limit(&figure, value, term);
            let limit = with_unit(&term.threshold.to_string(), figure.unit);
            let (name, more) = (format!("  {}", of.row().label), format!("{times} of {limit}"));
            lines.push(row(&name, &figure, &more));
        }
    }
    lines
}

/// Prints how far the results may be trusted, and how they were computed.
pub fn trust(answer: &Answer, reasons: &[String], out: &mut dyn Write) -> io::Result<()> {
    let (errors, rules) = (&answer.errors, answer.case.rules());
    writeln!(out, "\nStep error: {}", said(&errors.time_step))?;
    if let Some(other) = largest_other(&errors.time_step) {
        writeln!(out, "  beside the leading results up to {other}")?;
    }
    let mesh = errors.mesh.as_ref().map_or_else(|| "not estimated".to_owned(), said);
    writeln!(out, "Mesh error: {mesh}")?;
    if let Some(limit) = here_and_in_the_limit(answer, Quantity::Damage) {
        writeln!(out, "Damage index: {limit}")?;
    }
    block(&unknown_limits(answer), "", "", out)?;
    writeln!(out, "Energy balance: within {}", percent(errors.energy_balance))?;
    let (ms, integrator) = (answer.solve_time.as_secs_f64() * 1e3, answer.plan.integrator.name());
    let [step, limit] = [answer.step, answer.step_limit].map(|step| step * 1e6);
    let rest = if rules.step_follows_motion { " at rest" } else { "" };
    write!(out, "Solved in {ms:.2} ms by {integrator}: {} steps ", answer.run.cost.steps)?;
    writeln!(out, "of {step:.4} us{rest},\nstable up to {limit:.4} us")?;
    let at = answer.run.simulated;
    let flat = "the eye was pressed flat, and there the model ends";
    let why = if answer.pressed_flat() { flat } else { rules.ends_early };
    if answer.case.ends_by_itself() && !answer.has(FlagKind::WindowCapped) {
        writeln!(out, "Stopped at {:.3} ms: {why}", at * 1e3)?;
    } else if at < 0.999_999 * answer.window() {
        let window = plain((answer.window() * 1e9).round() / 1e6);
        writeln!(out, "Stopped at {:.3} of {window} ms: {why}", at * 1e3)?;
    }
    reasons.iter().try_for_each(|reason| writeln!(out, "  {reason}"))?;
    for flag in &answer.flags {
        paragraph(&format!("FLAG {}: {}", flag.kind.name(), flag.whole()), out)?;
    }
    Ok(())
}

/// The error of the damage index, and the largest of a leading result with its name, in words.
fn said(errors: &Results) -> String {
    let unknown = || "unknown".to_owned();
    let damage = errors[Quantity::Damage].map_or_else(unknown, percent);
    let worst = errors.worst().map_or_else(unknown, named);
    format!("damage index {damage}, worst {worst}")
}

/// The largest error of a result that does not lead; none if a leading one is larger.
fn largest_other(errors: &Results) -> Option<String> {
    let largest = errors.present().max_by(|a, b| a.1.total_cmp(&b.1))?;
    (largest.1 > errors.worst()?.1).then(|| named(largest))
}

/// Which results finer meshes do not agree on; empty where on all, or where none was asked.
fn unknown_limits(answer: &Answer) -> String {
    let Some(mesh) = &answer.errors.mesh else { return String::new() };
    let names: Vec<&str> = answer.errors.without_limit().map(Quantity::label).collect();
    if answer.pressed_flat() {
        "No eye was tested so hard, so no error is stated".to_owned()
    } else if mesh.present().next().is_none() {
        "Finer meshes agree on no result".to_owned()
    } else if names.is_empty() {
        String::new()
    } else {
        format!("Finer meshes do not agree on {}", names.join("; "))
    }
}

fn named((of, error): (Quantity, f64)) -> String {
    format!("{} ({})", percent(error), of.label())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::solve::tests::answered;
    use crate::scenario::library::tests::preset;

    #[test]
    fn the_worst_of_the_leading_results_is_named() {
        let mut errors = Results::from_fn(|_| None);
        assert_eq!(said(&errors), "damage index unknown, worst unknown");
        errors[Quantity::Damage] = Some(0.5);
        errors[Quantity::ForceTop] = Some(2.0);
        assert_eq!(said(&errors), "damage index 0.50 %, worst 2.0 % (peak force, top)");
        errors[Quantity::Contact] = Some(1.0);
        assert_eq!(said(&errors), "damage index 0.50 %, worst 1.0 % (contact force)");
        assert_eq!(largest_other(&errors).unwrap(), "2.0 % (peak force, top)");
        errors[Quantity::Contact] = Some(3.0);
        assert_eq!(largest_other(&errors), None);
    }

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
