//! The answer first: a line an injury, in text and as JSON, and what it rests on.

use crate::answer::solve::Answer;
use crate::injury::{EnergyCurve, Injury, Risk, SIGNS, Share, whole};
use crate::report::figure::Figure;
use crate::report::format::{block, paragraph, significant};
use crate::report::{bone, look_for, sentence::sentence};
use crate::run::quantity::Quantity;
use crate::scenario::Scenario;
use serde_json::{Value, json};
use std::io::{self, Write};

/// What to say of each injury, a globe first and then by figure, and what holds of all of them;
/// nothing where no injury is told of.
pub fn lines(answer: &Answer) -> Vec<(&'static str, String)> {
    let line = |risk: &Risk| (risk.injury.name(), risk.words());
    let mut lines: Vec<(&'static str, String)> = answer.risks().iter().map(line).collect();
    if let Some(spoiled) = answer.no_risks().filter(|_| answer.silence().is_none()) {
        lines.push(("all of them", format!("{}: {}", spoiled.why, spoiled.next)));
    }
    lines
}

/// Why no injury is told of, if that is so: for whoever asks, after all else.
pub fn silence(answer: &Answer) -> Option<String> {
    answer.silence().map(|why| format!("Injuries: {why}."))
}

/// A risk as a table shows it, told and its range; none of what is no risk.
pub fn cell(answer: &Answer, of: Quantity) -> Option<String> {
    let risk = answer.risk(Injury::of(of)?)?;
    let [told, range] = [risk.middle(), risk.range()].map(|said| said.replace(" %", ""));
    let told = told.replace("under ", "<").replace("over ", ">");
    Some(if told == range { told } else { format!("{told} ({range})") })
}

/// Prints the answer in one sentence, a line for each injury, what to look for, and the signs that
/// count more than any of them.
pub fn text(scenario: &Scenario, answer: &Answer, out: &mut dyn Write) -> io::Result<()> {
    block(&sentence(scenario, answer), "", "", out)?;
    writeln!(out)?;
    let mut lines = lines(answer).into_iter();
    lines.try_for_each(|(name, words)| paragraph(&format!("{name}: {words}"), out))?;
    if let Some(bone) = bone::line(answer) {
        paragraph(&bone, out)?;
    }
    if answer.silence().is_none() {
        paragraph("(in brackets: 8 of 10 of what it may be lie in it)", out)?;
        let look = look_for::lines(answer, &answer.risks(), scenario.eye_side());
        if !look.is_empty() {
            writeln!(out, "\nWhat to look for")?;
            for (name, words) in look {
                block(&format!("{name}: {words}"), "  ", "    ", out)?;
            }
            block(look_for::NOT_COMPUTED, "  ", "    ", out)?;
        }
        writeln!(out)?;
    }
    paragraph(SIGNS, out)
}

/// Prints what each risk rests on, or why there are none.
pub fn evidence(answer: &Answer, out: &mut dyn Write) -> io::Result<()> {
    let risks = answer.risks();
    if !risks.is_empty() {
        writeln!(out, "\nWhat the risks rest on, beside the index and not part of it:")?;
    }
    let lines: Vec<String> = risks.iter().flat_map(|risk| basis(answer, risk)).collect();
    lines.iter().try_for_each(|line| block(line, "  ", "      ", out))?;
    let Some(why) = silence(answer) else { return Ok(()) };
    writeln!(out)?;
    block(&why, "", "", out)
}

/// What one risk rests on: what its tissue felt beside what hurts half, what was counted, and what
/// laboratories published.
pub fn basis(answer: &Answer, risk: &Risk) -> Vec<String> {
    let (injury, measure) = (risk.injury, risk.injury.measure());
    let Some(blow) = &answer.case.blow else { return Vec::new() };
    let row = measure.row();
    let felt = Figure::of(answer, measure).map_or_else(String::new, |felt| felt.to_string());
    let point = blow.point(injury);
    let half = significant(rounded(libm::exp10(point.log) * row.factor));
    let known = libm::exp10(point.known);
    let (name, label, unit) = (injury.name(), row.label, row.unit);
    let of = if risk.clinic.is_some() { "fitted to clinics" } else { "of laboratories" };
    let mut said =
        vec![format!("{name}: {label} {felt}; 50 % at {half} {unit}, x or / {known:.1}, {of}")];
    if let Some((outcome, objects)) = risk.counted {
        let (count, source) = (outcome.count(), &outcome.source);
        said.push(format!("seen in {count} ({objects}; {}): {source}", outcome.counted));
    }
    said.extend(blow.energy.into_iter().flat_map(|energy| {
        EnergyCurve::of(injury).map(move |curve| {
            let slope = if curve.slope_known { "" } else { "; slope assumed" };
            let (risk, source) = (whole(curve.risk(energy)), curve.source);
            let [energy, half] = [energy, curve.half].map(|joule| joule * 1e-3);
            format!(
                "in laboratories by energy alone {risk} ({energy:.1} of {half:.1} kJ/m2): {source}{slope}"
            )
        })
    }));
    said
}

/// To three digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

/// The risks as one object, a member for each injury.
pub fn json(answer: &Answer) -> Value {
    let percent = |share: Option<Share>, of: fn(&Share) -> f64| share.map(|share| 1e2 * of(&share));
    let one = |risk: &Risk| {
        let hit = risk.usable.then_some(risk.hit);
        let clinic = risk.clinic.filter(|_| risk.usable);
        let counted = risk.counted.map(|(outcome, objects)| {
            json!({
                "objects": objects,
                "eyes": outcome.eyes,
                "hurt": outcome.hurt,
                "how": outcome.counted,
                "source": outcome.source,
            })
        });
        let object = json!({
            "hit_percent": percent(hit, |s| s.told),
            "low_percent": percent(hit, |s| s.low),
            "high_percent": percent(hit, |s| s.high),
            "clinic_percent": percent(clinic, |s| s.told),
            "clinic_low_percent": percent(clinic, |s| s.low),
            "clinic_high_percent": percent(clinic, |s| s.high),
            "laboratory_percent": percent(risk.laboratory, |s| s.told),
            "laboratory_low_percent": percent(risk.laboratory, |s| s.low),
            "laboratory_high_percent": percent(risk.laboratory, |s| s.high),
            "counted": counted,
            "rests_on": basis(answer, risk),
            "word": risk.word(),
            "may_grow": risk.cut,
            "measure": risk.injury.measure().key(),
            "of_what_hurts_half": risk.of_half,
            "text": risk.words(),
        });
        (risk.injury.key(), object)
    };
    answer.risks().iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::solve::tests::answered;
    use crate::scenario::library::tests::preset;

    fn printed(scenario: &Scenario, answer: &Answer) -> String {
        let mut out = Vec::new();
        text(scenario, answer, &mut out).unwrap();
        evidence(answer, &mut out).unwrap();
        let page = String::from_utf8(out).unwrap();
        assert!(page.lines().all(|line| line.chars().count() <= 80), "{page}");
        page
    }

    #[test]
    fn every_injury_has_a_line_a_range_and_what_it_rests_on() {
        let scenario = preset("bb-56", &[]);
        let bb = answered(&scenario);
        let (page, object) = (printed(&scenario, &bb), json(&bb));
        for injury in Injury::ALL {
            assert!(page.contains(&format!("{}: ", injury.name())), "{page}");
            let risk = &object[injury.key()];
            for of in ["hit", "clinic"] {
                let low = if of == "hit" { "low_percent" } else { "clinic_low_percent" };
                let high = if of == "hit" { "high_percent" } else { "clinic_high_percent" };
                let told = risk[format!("{of}_percent")].as_f64();
                assert!(risk[low].as_f64() <= told && told <= risk[high].as_f64(), "{risk}");
            }
        }
        for words in ["What to look for", "eye doctor", "Duma 2005", "slope assumed"] {
            assert!(page.contains(words), "{words} in\n{page}");
        }
        assert!(page.find("globe rupture").unwrap() < page.find("hyphema").unwrap());
        assert_eq!(cell(&bb, Quantity::Pressure), None);
    }

    #[test]
    fn a_pulse_on_the_section_says_last_why_there_are_no_injuries() {
        let scenario = preset("paper-300n", &[]);
        let paper = answered(&scenario);
        assert!(lines(&paper).is_empty());
        let page = printed(&scenario, &paper);
        assert!(page.starts_with("300 N for 0.2 ms: chance of retinal damage "), "{page}");
        assert!(page.contains("\n\nInjuries: not told: "), "{page}");
        assert_eq!(json(&paper), json!({}));
    }
}
