//! The answer in one sentence, the same on every screen, page and line: what hits the eye, how fast
//! and from where; what is likely, the gravest that is not excluded, and always the globe. A blow
//! on the Paper model's section says the paper's own answer instead.
//!
//! Left out: the cornea's scratch where anything inside the eye is to be feared, and figures, which
//! stand in the lines below.

use crate::answer::solve::Answer;
use crate::injury::{BURST, Injury, Risk};
use crate::plain_text::printable;
use crate::report::figure::{Off, cut_before, unusable};
use crate::run::quantity::Quantity;
use crate::scenario::direction::{Directions, place};
use crate::scenario::{Scenario, problem::plain};

/// What came of a blow.
pub fn sentence(scenario: &Scenario, answer: &Answer) -> String {
    format!("{}: {}.", subject(scenario), verdict(answer))
}

/// What hits the eye, how fast and from where: `Squash ball at 30 m/s from below`.
pub fn subject(scenario: &Scenario) -> String {
    let name = printable(&scenario.name).into_owned();
    let Some(object) = scenario.projectile() else { return name };
    let speed = format!("{} m/s", plain(object.speed_m_s));
    let speed = if name.contains("m/s") { String::new() } else { format!(" at {speed}") };
    let side = scenario.eye_side();
    let from = |hour: f64| place(side.azimuth(hour));
    let told = name.to_lowercase().contains("side not known");
    let from = match object.directions {
        Directions::NotKnown if told => String::new(),
        Directions::NotKnown => " from a side not known".to_owned(),
        Directions::AsGiven if object.angle_deg != 0.0 => {
            format!(" from {}", from(object.angle_clock))
        }
        Directions::AsGiven if object.offset_mm != 0.0 => {
            let (far, towards) = (plain(object.offset_mm), from(object.offset_clock));
            format!(", {far} mm towards {towards}")
        }
        Directions::AsGiven => String::new(),
    };
    name + &speed + &from
}

/// What came of it, without what it was.
pub fn verdict(answer: &Answer) -> String {
    if answer.run.missed && answer.silence().is_some() {
        return "it never touches the eye".to_owned();
    }
    if answer.silence().is_some() {
        return chance(answer);
    }
    match answer.no_risks() {
        Some(spoiled) => format!("not usable: {}; {}", spoiled.why, spoiled.next),
        None => injuries(&answer.risks()),
    }
}

/// The paper's chance of retinal damage, with its range in percent too.
fn chance(answer: &Answer) -> String {
    if let Some(why) = unusable(answer) {
        return why;
    }
    let Some(value) = answer.result(Quantity::Damage) else { return "no answer".to_owned() };
    let whole = |value: f64| format!("{:.0}", value.max(0.0));
    let counted = answer.errors.mesh.is_some();
    let causes = if counted { "by step and mesh" } else { "mesh error not counted" };
    let range = match Off::of(&answer.errors, Quantity::Damage) {
        Off::Known(error) => {
            let off = (value * error / 100.0).round();
            let [low, high] = [-1.0, 1.0].map(|sign| whole(value.round() + sign * off));
            let same = low == high || !counted;
            if same { causes.to_owned() } else { format!("{low} to {high} {causes}") }
        }
        Off::Limitless => "finer meshes do not agree".to_owned(),
        Off::Unstated => causes.to_owned(),
    };
    let so_far = cut_before(answer.cut(Quantity::Damage)).1;
    let so_far = if so_far.is_empty() { String::new() } else { format!("{so_far} ") };
    let extent = if value > 100.0 { ", beyond 100 the extent of it" } else { "" };
    let value = whole(value);
    format!("chance of retinal damage {so_far}{value} % by the paper's formula ({range}){extent}")
}

/// Names that share what is said of them.
struct Clause {
    names: Vec<&'static str>,
    word: &'static str,
    gravity: usize,
}

impl Clause {
    fn text(&self) -> String {
        let names = match self.names.as_slice() {
            [all @ .., last] if !all.is_empty() => format!("{} and {last}", all.join(", ")),
            names => names.concat(),
        };
        let verb = match (self.word.starts_with("cannot"), self.names.len()) {
            (true, _) => "",
            (false, 1) => "is ",
            (false, _) => "are ",
        };
        format!("{names} {verb}{}", self.word)
    }
}

/// An injury as a sentence names it.
const fn named(injury: Injury) -> &'static str {
    match injury {
        Injury::GlobeRupture => "a burst globe",
        Injury::RetinaBack => "damage of the retina at the back",
        Injury::RetinaFront => "damage of the retina's front edge",
        Injury::LensDislocation => "a dislocated lens",
        Injury::Hyphema => "bleeding inside the eye",
        Injury::CornealAbrasion => "a scratched cornea",
    }
}

/// The names of some injuries; both parts of the retina are one.
fn names(of: &[&Risk]) -> Vec<&'static str> {
    let has = |injury| of.iter().any(|risk| risk.injury == injury);
    let both = has(Injury::RetinaBack) && has(Injury::RetinaFront);
    let mut names: Vec<&'static str> = Vec::new();
    for risk in of {
        let name = match risk.injury {
            Injury::RetinaBack | Injury::RetinaFront if both => "damage of the retina",
            other => named(other),
        };
        if !names.contains(&name) {
            names.push(name);
        }
    }
    names
}

/// What is likely inside the eye, the gravest that is not excluded, and the globe.
fn injuries(risks: &[Risk]) -> String {
    const NOT_KNOWN: &str = "not known";
    let clause = |of: &[&Risk], word| Clause {
        names: names(of),
        word,
        gravity: of.first().map_or(0, |risk| risk.gravity()),
    };
    let of = |injury: Injury| risks.iter().find(|risk| risk.injury == injury);
    let inside = Injury::ALL
        .iter()
        .copied()
        .filter(|injury| !matches!(injury, Injury::GlobeRupture | Injury::CornealAbrasion));
    let (known, unknown): (Vec<&Risk>, Vec<&Risk>) =
        inside.filter_map(of).partition(|risk| risk.usable && !risk.is_open());
    let most = known.iter().map(|risk| risk.gravity()).max().unwrap_or(0);
    let mut clauses = Vec::new();
    let mut top: Vec<&Risk> = known.iter().copied().filter(|risk| risk.gravity() == most).collect();
    top.sort_by(|a, b| b.share().told.total_cmp(&a.share().told));
    if most > 0 {
        clauses.push(clause(&top, top[0].word()));
        // The gravest that is not excluded, where others are likelier.
        let gravest = known.iter().find(|risk| risk.gravity() > 0);
        let said = |risk: &&&Risk| top.iter().any(|said| said.injury == risk.injury);
        if let Some(gravest) = gravest.filter(|risk| !said(risk)) {
            let alike = |risk: &&Risk| risk.gravity() == gravest.gravity();
            let alike: Vec<&Risk> = known.iter().copied().filter(alike).collect();
            clauses.push(clause(&alike, gravest.word()));
        }
    } else if unknown.is_empty() {
        if let Some(cornea) = of(Injury::CornealAbrasion).filter(|risk| risk.gravity() > 0) {
            clauses.push(clause(&[cornea], cornea.word()));
        }
        let names = vec!["injuries inside the eye"];
        clauses.push(Clause { names, word: "not expected", gravity: 0 });
    } else {
        clauses.push(Clause { gravity: 0, ..clause(&unknown, NOT_KNOWN) });
    }
    if let Some(globe) = of(Injury::GlobeRupture) {
        let told = globe.usable && !globe.is_open();
        let word = if told { globe.word() } else { NOT_KNOWN };
        let gravity = if told { globe.gravity() } else { 0 };
        let same = clauses.iter_mut().find(|other| other.word == word && other.gravity > 0);
        match same {
            Some(other) => other.names.insert(0, named(Injury::GlobeRupture)),
            None if !told => {
                let names = vec!["whether the globe bursts"];
                clauses.push(Clause { names, word, gravity });
            }
            None => clauses.push(Clause { gravity, ..clause(&[globe], word) }),
        }
    }
    clauses.sort_by_key(|clause| std::cmp::Reverse(clause.gravity));
    let opens = of(Injury::GlobeRupture).is_some_and(Risk::opens);
    let said: Vec<String> = clauses.iter().map(Clause::text).collect();
    said.join(", ") + &if opens { format!("; {BURST}") } else { String::new() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::injury::{Blow, Felt, PerInjury, assess};
    use crate::scenario::library::tests::preset;

    /// What is said where each tissue felt so many times what hurts half of all eyes.
    fn said(name: &str, times: [f64; 6]) -> String {
        let blow = Blow::of(&preset(name, &[]));
        let mut measures = blow.points.map(|point| libm::exp10(point.log));
        measures.iter_mut().zip(times).for_each(|(measure, times)| *measure *= times);
        let felt = Felt { measures, errors: [0.0; 6], way_in: None, weight: 1.0 };
        injuries(&assess(&blow, &[felt], &PerInjury::default()))
    }

    #[test]
    fn the_likeliest_comes_first_and_the_globe_is_never_left_out() {
        let soft = said("squash-ball", [0.01; 6]);
        assert!(soft.ends_with("a burst globe is not expected"), "{soft}");
        let hard = said("squash-ball", [9.0; 6]);
        assert!(hard.starts_with("a burst globe ") && hard.ends_with(BURST), "{hard}");
        let blood = said("squash-ball", [0.01, 0.01, 0.01, 0.01, 9.0, 0.01]);
        assert!(blood.starts_with("bleeding inside the eye is "), "{blood}");
        for times in [0.01, 0.1, 0.3, 1.0, 3.0, 10.0] {
            for name in ["squash-ball", "bb-62", "fist", "shuttlecock"] {
                let said = said(name, [times; 6]);
                assert!(said.contains("burst"), "{said}");
                assert!(said.chars().count() < 200, "{said}");
            }
        }
    }

    #[test]
    fn what_hits_the_eye_is_named_with_its_speed_and_its_side() {
        let from = [("impact.angle_deg", "30"), ("impact.angle_clock", "7.5")];
        let subject = |name: &str, changes: &[(&str, &str)]| subject(&preset(name, changes));
        assert_eq!(
            subject("squash-ball", &from),
            "Squash ball at 40 m/s from below and the temple"
        );
        assert_eq!(subject("bb-56", &[("name", "Case 7")]), "Case 7 at 56 m/s");
        let aside = [("impact.offset_mm", "4"), ("impact.offset_clock", "3")];
        assert_eq!(subject("bb-56", &aside), "Steel BB at 56 m/s, 4 mm towards the nose");
        assert_eq!(subject("unknown-side", &[]).matches("not known").count(), 1);
    }
}
