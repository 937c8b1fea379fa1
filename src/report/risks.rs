//! The answer first: one line an injury, in text and as JSON, and what it rests on.

use crate::answer::solve::Answer;
use crate::injury::{A_BB, AT_LEAST, EnergyCurve, Equivalent, Injury, Risk, SIGNS, whole};
use crate::report::figure::Figure;
use crate::report::format::{block, paragraph, significant};
use crate::run::quantity::Quantity;
use serde_json::{Value, json};
use std::io::{self, Write};

/// What to say of each injury, last of all of them; in one line why nothing is said, if so.
pub fn lines(answer: &Answer) -> Vec<(&'static str, String)> {
    if let Some(silence) = answer.silence() {
        return vec![("injuries", silence.to_owned())];
    }
    let risks = answer.risks();
    let shared = |note: &&&str| risks.iter().all(|risk| risk.notes.contains(*note));
    let first = risks.first().into_iter().flat_map(|risk| &risk.notes);
    let shared: Vec<&str> = first.filter(shared).copied().collect();
    let line = |risk: &Risk| (risk.injury.name(), risk.words_but(&shared));
    let mut lines: Vec<(&'static str, String)> = risks.iter().map(line).collect();
    let spoiled = answer.spoiled().map(|spoiled| format!("{}: {}", spoiled.why, spoiled.next));
    let of_all: Vec<&str> = spoiled.as_deref().into_iter().chain(shared).collect();
    if !of_all.is_empty() {
        lines.push(("all of them", of_all.join("; ")));
    }
    lines
}

/// What a BB is, where any of these answers names one.
pub fn legend<'a>(mut answers: impl Iterator<Item = &'a Answer>) -> Option<&'static str> {
    answers.any(|answer| answer.silence().is_none()).then_some(A_BB)
}

/// The gravest of [`lines`] in one sentence.
pub fn first_line(answer: &Answer) -> String {
    let said = lines(answer);
    let (name, words) = &said[0];
    let of_all = said.last().filter(|_| answer.spoiled().is_some() && said.len() > 1);
    let of_all = of_all.map_or_else(String::new, |(_, words)| format!("; {words}"));
    format!("{name}: {words}{of_all}")
}

/// What the ranges do not hold yet, in words; none where they hold all.
pub fn uncounted(answer: &Answer) -> Option<String> {
    let missing = answer.uncounted();
    let any = !missing.is_empty() && answer.silence().is_none();
    any.then(|| missing.join(" and "))
}

/// The range of a risk in %, as a table shows it; none of what is no risk.
pub fn range(answer: &Answer, of: Quantity) -> Option<String> {
    let percent = answer.risk(Injury::of(of)?)?.percent();
    let number = percent.trim_end_matches(" %");
    Some(number.replace(&format!("{AT_LEAST} "), "≥"))
}

/// Prints a line for each injury and the signs that count more than any of them.
pub fn text(answer: &Answer, out: &mut dyn Write) -> io::Result<()> {
    let mut lines = lines(answer).into_iter();
    lines.try_for_each(|(name, words)| paragraph(&format!("{name}: {words}"), out))?;
    if answer.silence().is_none() {
        let missing = uncounted(answer).map(|missing| format!(", without {missing}"));
        paragraph(&format!("(ranges of 80 %{}; {A_BB})", missing.unwrap_or_default()), out)?;
    }
    paragraph(SIGNS, out)
}

/// Prints what each risk rests on; nothing where there are none.
pub fn evidence(answer: &Answer, out: &mut dyn Write) -> io::Result<()> {
    let risks = answer.risks();
    if !risks.is_empty() {
        writeln!(out, "\nWhat the risks rest on, beside the index and not part of it:")?;
    }
    let lines: Vec<String> = risks.iter().flat_map(|risk| basis(answer, risk)).collect();
    lines.iter().try_for_each(|line| block(line, "  ", "      ", out))
}

/// What one risk rests on: what its tissue felt, and what published curves say of the energy.
pub fn basis(answer: &Answer, risk: &Risk) -> Vec<String> {
    let (injury, measure) = (risk.injury, risk.injury.measure());
    let (curve, row) = (injury.curve(), measure.row());
    let felt = Figure::of(answer, measure).map_or_else(String::new, |felt| felt.to_string());
    let (name, half) = (injury.name(), significant(curve.half * row.factor));
    let (label, unit, matched) = (row.label, row.unit, curve.matched);
    let felt = format!("{name}: {label} {felt}, 50 % at {half} {unit}, matched to {matched}");
    let blow = &answer.case.blow;
    let published = blow.energy.into_iter().flat_map(|energy| {
        EnergyCurve::of(injury).map(move |curve| {
            let slope = if curve.slope_known { "" } else { "; slope assumed" };
            let (risk, source) = (whole(curve.risk(energy)), curve.source);
            let [energy, half] = [energy, curve.half].map(|joule| joule * 1e-3);
            format!("by energy alone {risk} ({energy:.1} of {half:.1} kJ/m2): {source}{slope}")
        })
    });
    let mut said: Vec<String> = std::iter::once(felt).chain(published).collect();
    if blow.tested == 0.0 && said.len() > 1 {
        let published = said.split_off(1).join("; ");
        said.push(format!("not counted, as {}: {published}", blow.untested));
    }
    said
}

/// The risks as one object, a member for each injury.
pub fn json(answer: &Answer) -> Value {
    let one = |risk: &Risk| {
        let (measure, blow) = (risk.injury.measure(), &answer.case.blow);
        let curve = |curve: &EnergyCurve| {
            json!({
                "source": curve.source,
                "data": curve.data,
                "half_at_kj_m2": curve.half * 1e-3,
                "slope_published": curve.slope_known,
                "percent": blow.energy.map(|energy| 100.0 * curve.risk(energy)),
            })
        };
        let object = json!({
            "percent": risk.has_middle().then_some(100.0 * risk.risk),
            "low_percent": 100.0 * risk.range.0,
            "high_percent": 100.0 * risk.range.1,
            "at_least": risk.at_least,
            "word": risk.word(),
            "equivalent_bb_m_s": risk.usable.then(|| risk.equivalent.speed()),
            "equivalent_bb_is": match risk.equivalent {
                Equivalent::Under(_) => "under",
                Equivalent::At(_) => "at",
                Equivalent::Over(_) => "over",
            },
            "measure": measure.key(),
            "half_at": risk.injury.curve().half * measure.row().factor,
            "notes": risk.notes,
            "text": risk.words(),
            "published": EnergyCurve::of(risk.injury).map(curve).collect::<Value>(),
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

    fn printed(answer: &Answer) -> String {
        let mut out = Vec::new();
        text(answer, &mut out).unwrap();
        evidence(answer, &mut out).unwrap();
        let page = String::from_utf8(out).unwrap();
        assert!(page.lines().all(|line| line.chars().count() <= 80), "{page}");
        page
    }

    #[test]
    fn every_injury_has_a_line_a_range_and_what_it_rests_on() {
        let bb = answered(&preset("bb-56", &[]));
        let (page, object) = (printed(&bb), json(&bb));
        for injury in Injury::ALL {
            assert!(page.contains(&format!("{}: ", injury.name())), "{page}");
            let risk = &object[injury.key()];
            assert!(risk["low_percent"].as_f64() <= risk["percent"].as_f64());
            assert!(risk["percent"].as_f64() <= risk["high_percent"].as_f64());
        }
        let more = ["without the mesh and the inputs", "eye doctor", "Duma 2005", "slope assumed"];
        for words in more {
            assert!(page.contains(words), "{words} in\n{page}");
        }
        let cell = range(&bb, Quantity::GlobeRupture).unwrap();
        let risk = bb.risk(Injury::GlobeRupture).unwrap();
        assert_eq!(format!("{cell} %"), risk.percent());
        assert_eq!(range(&bb, Quantity::Pressure), None);
    }

    #[test]
    fn a_pulse_on_the_section_says_in_one_line_why_there_are_no_injuries() {
        let paper = answered(&preset("paper-300n", &[]));
        assert_eq!(lines(&paper).len(), 1);
        assert!(printed(&paper).starts_with("injuries: not told: "));
        assert_eq!(json(&paper), json!({}));
    }
}
