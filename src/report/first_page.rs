//! An answer on one screen of a terminal: the sentence, six injuries or the paper's index with its
//! parts, figures with their errors, what limits them and what to do about it, and how to see more;
//! and in three lines, to paste into a mail or a chart: the sentence, figures, flags.

use crate::answer::solve::Answer;
use crate::injury::{BURST, Injury, Outcome, Risk, SIGNS, Share};
use crate::report::figure::{Figure, SCALE, cut_signs, error_signs, unusable};
use crate::report::format::{WIDTH, capital, wrapped};
use crate::report::risks::silence;
use crate::report::sentence::sentence;
use crate::report::text::{damage, row};
use crate::report::{bone, look_for};
use crate::run::{flags::Flag, quantity::Quantity};
use crate::scenario::{Scenario, problem::plain};

/// Lines of the page at most: the prompt that follows leaves 23 of 24 on the screen.
pub const LINES: usize = 23;
/// Figures of the page where injuries are told of: the first so many that the scene has.
const FIGURES: usize = 3;
const LEADING: [Quantity; 5] =
    [Quantity::Damage, Quantity::Apex, Quantity::Pressure, Quantity::Contact, Quantity::Shortening];
const MORE: &str = "More: --all (every result), --json (for programs), contrecoup report (a page)";

/// The page. Numerics that were chosen for a tolerance are said if `chosen`.
pub fn text(scenario: &Scenario, answer: &Answer, chosen: bool) -> String {
    let what = what(scenario, answer);
    let (injuries, mut notes) = injuries(scenario, answer);
    let figures = figures(answer, chosen);
    let signs = wrapped(SIGNS, WIDTH);
    let silence = silence(answer).map_or_else(Vec::new, |why| wrapped(&why, WIDTH));
    let taken = [&what, &injuries, &figures, &signs, &silence].map(Vec::len);
    let taken = taken.iter().sum::<usize>() + 1;
    let mut left = LINES.saturating_sub(taken);
    // What limits the results and what to do about it goes before the last of the notes.
    let first = flags(answer.flags.get(..1).unwrap_or_default(), usize::MAX).len();
    let room = left.saturating_sub(first);
    while notes.len() > 1 && wrapped(&notes.join("; "), WIDTH).len() > room {
        notes.pop();
    }
    let mut notes = wrapped(&notes.join("; "), WIDTH);
    notes.truncate(left.saturating_sub(usize::from(first > 0)));
    left -= notes.len().min(left);
    let flags = flags(&answer.flags, left);
    left -= flags.len().min(left);
    let parts = [what, [injuries, notes].concat(), figures, flags, signs, silence];
    let mut page = String::new();
    for part in parts.iter().filter(|part| !part.is_empty()) {
        if !page.is_empty() && left > 0 {
            left -= 1;
            page.push('\n');
        }
        page.extend([&part.join("\n"), "\n"]);
    }
    page + MORE + "\n"
}

/// The sentence, and what was asked in figures.
fn what(scenario: &Scenario, answer: &Answer) -> Vec<String> {
    let object = scenario.projectile().map_or_else(String::new, |object| {
        let [mass, wide, speed] = [object.mass_g, object.diameter_mm, object.speed_m_s].map(plain);
        format!("{mass} g, {wide} mm, {speed} m/s; ")
    });
    let text = format!("{object}{}", scenario.description());
    let said = wrapped(&sentence(scenario, answer), WIDTH);
    said.into_iter().chain(wrapped(&text, WIDTH)).collect()
}

/// The injuries as a table, and what is to be said of them, what may be left out last.
fn injuries(scenario: &Scenario, answer: &Answer) -> (Vec<String>, Vec<String>) {
    if answer.silence().is_some() {
        return (Vec::new(), Vec::new());
    }
    let line = |name: &str, [word, come, hit, seen]: [&str; 4]| {
        let line = format!("{name:<19} {word:<18} {come:>12} {hit:>12} {seen:>14}");
        line.trim_end().to_owned()
    };
    let risks = answer.risks();
    let living = risks.iter().any(|risk| risk.clinic.is_some());
    let heads = ["how likely", "of 100 who", "of 100 eyes", "seen in"];
    let mut lines = vec![
        line("injury", if living { heads } else { ["how likely", "", "of 100 eyes", ""] }),
        line(
            "",
            if living { ["", "come to see", "hit so", "clinics"] } else { ["", "", "hit so", ""] },
        ),
    ];
    for risk in &risks {
        let said = risk.usable && !risk.is_open();
        let cell =
            |share: Option<Share>| share.filter(|_| said).map_or(String::new(), |s| in_hundred(&s));
        let seen = risk.counted.map_or_else(String::new, |(outcome, _)| seen(outcome));
        let (come, hit) = (cell(risk.clinic), cell(Some(risk.hit)));
        lines.push(line(risk.injury.name(), [risk.word(), &come, &hit, &seen]));
    }
    (lines, notes(scenario, answer, &risks))
}

/// What was counted: `12 of 71`, `≥1 of 34 ref.` of those who were referred.
fn seen(outcome: &Outcome) -> String {
    let referred = if outcome.whose().is_empty() { "" } else { " ref." };
    outcome.count().replace("at least ", "≥") + referred
}

/// A share with its range, of a hundred: `12 (3-30)`.
fn in_hundred(share: &Share) -> String {
    let whole = |of: f64| (1e2 * of).round();
    let (low, high) = (whole(share.low), whole(share.high));
    if high < 1.0 {
        return "under 1".to_owned();
    }
    let told =
        if whole(share.told) < 1.0 { "<1".to_owned() } else { whole(share.told).to_string() };
    if low == high { told } else { format!("{told} ({low}-{high})") }
}

/// What is to be said of the injuries, what may be left out last.
fn notes(scenario: &Scenario, answer: &Answer, risks: &[Risk]) -> Vec<String> {
    let spoiled = answer.no_risks().map(|spoiled| format!("{}: {}", spoiled.why, spoiled.next));
    let opens = risks.iter().any(Risk::opens).then(|| BURST.to_owned());
    let from = (!answer.others.is_empty()).then(|| {
        format!("risks are means over {} directions, the rest is of one", 1 + answer.others.len())
    });
    let laboratory = risks
        .iter()
        .filter_map(|risk| Some(format!("{}: {}", risk.injury.word(), risk.in_laboratory()?)));
    // A globe that may be open comes first, then by figure.
    let look = look_for::lines(answer, risks, scenario.eye_side());
    let look =
        look.into_iter().map(|(name, words)| format!("{name}: {}", words.trim_end_matches('.')));
    let look: Vec<String> = look.take(1).collect();
    let (globe, look): (Vec<String>, Vec<String>) =
        look.into_iter().partition(|line| line.starts_with(Injury::GlobeRupture.name()));
    let open = risks.iter().filter(|risk| risk.is_open());
    let open = open.map(|risk| format!("{}: {}", risk.injury.word(), risk.felt()));
    let of_kind = answer.case.blow.as_ref().and_then(|blow| blow.near);
    let seen = of_kind.filter(|_| risks.iter().any(|risk| risk.counted.is_some()));
    let seen = seen.map(|objects| format!("seen: {objects}, ref. where referred; --all names who"));
    let brackets = "in brackets 8 of 10 of what it may be".to_owned();
    spoiled
        .into_iter()
        .chain(globe)
        .chain(opens)
        .chain(bone::line(answer))
        .chain(look)
        .chain(from)
        .chain(laboratory)
        .chain(open)
        .chain([brackets])
        .chain(seen)
        .collect()
}

/// The figures that lead, with their errors.
fn figures(answer: &Answer, chosen: bool) -> Vec<String> {
    let (mut lines, mut cut) = (Vec::new(), false);
    let shown = LEADING.iter().chain(&Quantity::FORCES);
    let shown = shown.filter_map(|of| Some((*of, Figure::of(answer, *of)?)));
    // The paper's own answer is the index with its parts, the apex, and all four nodes.
    let (first, count) = if answer.silence().is_some() && !answer.run.missed {
        lines.extend(damage(answer));
        (1, usize::MAX)
    } else {
        (0, FIGURES)
    };
    for (of, figure) in shown.skip(first).take(count) {
        cut |= figure.cut.is_some();
        let more = match answer.peak(of) {
            Some(peak) => format!("at {:.3} ms", peak.time * 1e3),
            None if unusable(answer).is_some() => "not usable".to_owned(),
            None => SCALE.to_owned(),
        };
        let row = row(&capital(of.row().label), &figure, &more);
        lines.extend(row.lines().map(str::to_owned));
    }
    let mut trust = vec![format!("{}; mesh level {}", error_signs(answer), answer.case.level())];
    if chosen {
        let (integrator, step) = (answer.plan.integrator.name(), answer.step * 1e6);
        trust.push(format!("{integrator}, steps of {step:.4} us"));
    }
    lines.extend(wrapped(&trust.join(", "), WIDTH));
    lines.extend(cut.then(|| cut_signs(std::iter::once(answer)).to_owned()));
    lines
}

/// What limits the results with the next step, in so many lines; how many are left out.
fn flags(flags: &[Flag], room: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for (flag, left_out) in flags.iter().zip((0..flags.len()).rev()) {
        let (name, next) = (flag.kind.name(), flag.kind.next_step());
        let own = wrapped(&format!("FLAG {name}: {}; {next}", flag.message), WIDTH);
        if lines.len() + own.len() + usize::from(left_out > 0) > room {
            let more = if left_out > 0 { format!(" and {left_out} more") } else { String::new() };
            lines.push(format!("FLAG {name}{more}: see --all"));
            break;
        }
        lines.extend(own);
    }
    lines
}

/// The three lines, and the command that repeats the blow as a fourth, if one does.
pub fn in_three_lines(scenario: &Scenario, answer: &Answer, command: Option<&str>) -> String {
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
    let command = command.map_or_else(String::new, |command| format!("{command}\n"));
    format!(
        "{}\n\
         {index}{figures} ({signs})\n\
         {flags}; research and education, not diagnosis\n{command}",
        sentence(scenario, answer)
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::solve::tests::answered;
    use crate::run::flags::FlagKind;
    use crate::scenario::library::tests::preset;

    fn page(name: &str, changes: &[(&str, &str)], more: &[FlagKind]) -> String {
        let scenario = preset(name, changes);
        let mut answer = answered(&scenario);
        answer.flags.extend(more.iter().map(|&kind| {
            let message = "what happened is said in words that take a line of their own".to_owned();
            Flag { kind, message, detail: None, time: None }
        }));
        let page = text(&scenario, &answer, true);
        assert!(page.lines().count() <= LINES, "{page}");
        assert!(page.lines().all(|line| line.chars().count() <= WIDTH), "{page}");
        assert!(page.contains("not diagnosis"), "{page}");
        assert!(page.ends_with(&format!("{MORE}\n")), "{page}");
        page
    }

    #[test]
    fn a_blow_with_everything_to_be_said_of_it_is_told_on_one_screen() {
        let aside = [
            ("impact.angle_deg", "20"),
            ("numerics.geometry", "Axisymmetric"),
            ("impact.speed_m_s", "150"),
            ("impact.diameter_mm", "9"),
            ("window_ms", "0.2"),
        ];
        let page = page("bb-92", &aside, &[FlagKind::BoneMayBreak; 6]);
        assert!(page.contains("more: see --all"), "{page}");
    }

    #[test]
    fn what_hit_six_injuries_five_figures_and_flags_with_a_next_step_are_there() {
        let page = page("squash-ball", &[], &[]);
        assert!(page.starts_with("Squash ball at 40 m/s: "), "{page}");
        assert!(page.contains("\n24 g, 40 mm, 40 m/s; Physiological"), "{page}");
        assert!(page.contains("12 of 71") && page.contains("hit so"), "{page}");
        assert_eq!(page.matches("±").count(), FIGURES + 1, "{page}");
        assert!(page.contains("bone: a fracture is possible"), "{page}");
        assert!(page.contains("FLAG rim_stops: "), "{page}");
    }

    #[test]
    fn the_papers_blow_begins_with_the_papers_answer_and_ends_with_what_is_not_told() {
        let scenario = preset("paper-300n", &[]);
        let page = text(&scenario, &answered(&scenario), false);
        assert!(page.lines().count() <= LINES, "{page}");
        assert!(page.starts_with("300 N for 0.2 ms: chance of retinal damage 26 % by"), "{page}");
        let places = ["wall growth S", "Cornea pushed in", "force, top", "\nInjuries: not told"];
        let places =
            places.map(|word| page.find(word).unwrap_or_else(|| panic!("{word}:\n{page}")));
        assert!(places.is_sorted(), "{page}");
    }

    #[test]
    fn three_lines_say_what_to_believe_and_a_fourth_repeats_it() {
        let bb = preset("bb-56", &[("window_ms", "0.2")]);
        let text = in_three_lines(&bb, &answered(&bb), Some("contrecoup run bb-56"));
        let lines: Vec<&str> = text.lines().collect();
        assert_eq!(lines.len(), 4, "{text}");
        assert!(lines[0].starts_with("Steel BB at 56 m/s: "), "{text}");
        assert!(lines[0].contains("a burst globe "), "{text}");
        assert!(lines[1].starts_with("damage index so far "), "{text}");
        // The window ends while the ball presses on: each other figure may still grow.
        assert_eq!(lines[1].matches("; ").count(), lines[1].matches(" at least ").count());
        assert!(lines[1].contains("; peak pressure at least "));
        assert!(lines[1].contains("±") && lines[1].contains("mesh not estimated"));
        assert!(lines[2].starts_with("flags: ") && lines[2].contains("window_short"), "{text}");
        assert_eq!(lines[3], "contrecoup run bb-56");
    }
}
