//! The answer first: one line an injury, in text and as JSON.

use crate::answer::derived::Derived;
use crate::answer::solve::Answer;
use crate::injury::{AT_LEAST, Injury, InjuryCurve, Part, Risk, Verdict, curve_of, lines, span};
use crate::run::quantity::Quantity;
use serde_json::{Value, json};
use std::io::{self, Write};

use crate::report::format::paragraph;

/// The words for a risk that is not usable here.
pub const VOID: &str = "not valid here";

/// The part that a curve has in the verdicts.
pub fn part_of<'a>(verdicts: &'a [Verdict], curve: &InjuryCurve) -> Option<&'a Part> {
    let mut parts = verdicts.iter().flat_map(|verdict| &verdict.parts);
    let part = parts.find(|(of, _)| of.curve == curve)?;
    Some(&part.1)
}

/// Whether a result is a risk that is not usable here.
pub fn is_void(verdicts: &[Verdict], of: Quantity) -> bool {
    let Some(Derived::Risk(injury, measure)) = of.derived() else {
        return false;
    };
    let part = curve_of(injury, measure).and_then(|curve| part_of(verdicts, curve));
    matches!(part, Some(Part::NotValid(_)))
}

/// What to believe of an injury after a blow.
pub fn verdict(answer: &Answer, injury: Injury) -> Option<Verdict> {
    let mut verdicts = answer.verdicts().into_iter();
    verdicts.find(|verdict| verdict.injury == injury)
}

/// The range of a risk in %, as a table shows it: of one that is believed first that of the
/// verdict, of another that of its curve; none of what is no risk.
pub fn range(answer: &Answer, of: Quantity) -> Option<String> {
    let percent = match of.derived()? {
        Derived::Believed(injury) => verdict(answer, injury)?.percent()?,
        Derived::Risk(injury, measure) => {
            let curve = curve_of(injury, measure)?;
            let risks = answer.risks().into_iter();
            let band = risks.into_iter().find(|risk| risk.curve == curve)?.band;
            if answer.at_least(of) {
                format!("{AT_LEAST} {:.0}", 100.0 * band.0)
            } else {
                span(band)
            }
        }
        Derived::Index => return None,
    };
    let number = percent.trim_end_matches(" %");
    Some(number.replace(&format!("{AT_LEAST} "), "≥"))
}

/// Who of these has a risk by which measure, where that is not one and the same: its column ranks
/// nobody then.
pub fn mixed(answers: &[(&str, &Answer)], of: Quantity) -> Option<String> {
    let Some(Derived::Believed(injury)) = of.derived() else {
        return None;
    };
    let mut groups: Vec<(&str, Vec<&str>)> = Vec::new();
    for (name, answer) in answers {
        let verdict = verdict(answer, injury);
        let first = verdict.as_ref().and_then(|v| v.believed().next());
        let Some(measure) = first.map(|risk| risk.curve.measure.short()) else {
            continue;
        };
        match groups.iter_mut().find(|(known, _)| *known == measure) {
            Some((_, names)) => names.push(name),
            None => groups.push((measure, vec![name])),
        }
    }
    let said =
        |(measure, names): &(&str, Vec<&str>)| format!("{} by {measure}", names.join(" and "));
    let said: Vec<String> = groups.iter().map(said).collect();
    (said.len() > 1).then(|| {
        let said = said.join(", ");
        format!("{}: {said}: not one measure, so no ranking", injury.word())
    })
}

/// Prints a line for each injury. Before the mesh error is known, `mesh` is false and a line says
/// that it is not in the ranges, if what was computed is believed at all.
///
/// # Errors
/// Whatever `out` reports.
pub fn text(verdicts: &[Verdict], mesh: bool, out: &mut dyn Write) -> io::Result<()> {
    for (name, words) in lines(verdicts) {
        paragraph(&format!("{name}: {words}"), out)?;
    }
    if !mesh && verdicts.iter().any(Verdict::rests_on_the_run) {
        writeln!(out, "    (without the mesh error, which --mesh-error adds)")?;
    }
    Ok(())
}

/// One object an injury, with the part of every curve in the verdict.
pub fn json(verdicts: &[Verdict]) -> Value {
    let part = |(risk, part): &(Risk, Part)| {
        let (part, reason) = match part {
            Part::Believed => ("believed", None),
            Part::Agrees => ("agrees", None),
            Part::Disagrees(why) => ("disagrees", Some(*why)),
            Part::NotValid(why) => ("not_valid", Some(why.as_str())),
        };
        json!({
            "measure": risk.curve.measure.key(),
            "source": risk.curve.source,
            "risk_percent": 100.0 * risk.risk,
            "part": part,
            "reason": reason,
        })
    };
    let one = |verdict: &Verdict| {
        let range = verdict.range.map(|(low, high)| [100.0 * low, 100.0 * high]);
        json!({
            "injury": verdict.injury.key(),
            "word": verdict.word(),
            "risk_percent": range,
            "at_least": verdict.at_least,
            "energy_alone": verdict.alone,
            "text": verdict.words(),
            "measures": verdict.parts.iter().map(part).collect::<Vec<_>>(),
        })
    };
    verdicts.iter().map(one).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::solve::solve;
    use crate::run::kept::Keep;
    use crate::run::watch::unwatched;
    use crate::scenario::library;
    use crate::scenario::set::set;

    fn answer(preset: &str) -> Answer {
        let mut scenario = library::find(preset).unwrap().scenario().unwrap();
        set(&mut scenario, "model", "Physiological").unwrap();
        scenario.window_ms = Some(0.1);
        solve(&scenario.check().unwrap(), Keep::default(), &mut unwatched).unwrap()
    }

    #[test]
    fn a_column_of_one_risk_by_two_measures_says_so_and_its_cells_are_ranges() {
        let (bb, fast, ball) = (answer("bb-56"), answer("bb-62"), answer("soccer-ball"));
        let retina = Quantity::RetinalDamage;
        let all = [("bb-56", &bb), ("soccer-ball", &ball), ("bb-62", &fast)];
        assert_eq!(
            mixed(&all, retina).unwrap(),
            "retina: bb-56 and bb-62 by energy, soccer-ball by pressure: not one measure, so no ranking"
        );
        assert_eq!(mixed(&[all[0], all[2]], retina), None);
        assert_eq!(mixed(&all, Quantity::Pressure), None);
        let verdict = verdict(&bb, Injury::RetinalDamage).unwrap();
        let cell = range(&bb, retina).unwrap();
        assert_eq!(format!("{cell} %"), verdict.percent().unwrap());
        assert!(cell.contains('-'), "{cell}");
        assert!(
            range(&bb, Quantity::RuptureByPressure)
                .unwrap()
                .starts_with('≥')
        );
        assert_eq!(range(&bb, Quantity::Pressure), None);
    }
}
