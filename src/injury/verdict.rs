//! One answer for each injury: what to believe of the curves that speak of it, in a word and a
//! range.
//!
//! The rule, which the guide states for readers (`contrecoup guide injury`):
//!
//! 1. A measure is not used if it means nothing here: energy where the object is larger than the
//!    orbit's opening, pressure and stress of a run that left the model's validity, pressure by
//!    eyes of another species where the eye's own has a curve, and a curve whose figure comes from
//!    memory.
//! 2. The others are ordered: first those without a reservation (eyes of another species, an
//!    object larger than the eye), then what the eye felt before what the object carried, then the
//!    nearer to what tears: stress of the wall before pressure, which is a mean over the globe.
//! 3. The first is believed, and with it those of the same rank whose risk is within a factor of
//!    [`FACTOR`] of its own. The range spans all that are believed: slope, point and error of the
//!    measure.
//! 4. What is farther off, and what counts less and lies outside the range, is named with the
//!    reason why it counts less. Nothing is averaged. Two risks that are both below [`UNLIKELY`]
//!    agree.
//! 5. Energy knows neither angle nor place. Where it is believed because what the eye felt cannot
//!    be used, or beyond the trusted angle, it counts as known within a factor of [`FACTOR`] only:
//!    with less known an answer must not look surer.
//!
//! Left out: weights, and any guess where no measure is left; the verdict then says so.

use crate::injury::curve::{Eyes, Injury, InjuryCurve, Measure, Standing};
use crate::injury::published::CURVES;
use crate::injury::risk::{Caution, Risk};

/// Said of what the end of the run cut off while it may still grow.
pub const AT_LEAST: &str = "at least";

/// Two risks that differ by more than this factor disagree. So do the measures of a BB at 62.5
/// m/s: its pressure says what a third of its energy would.
pub const FACTOR: f64 = 3.0;
/// Below this risk an injury is unlikely.
const UNLIKELY: f64 = 0.05;
/// Upper ends of risk, in %, with the word for risks below each.
const SCALE: [(f64, &str); 4] = [
    (5.0, "unlikely"),
    (50.0, "possible"),
    (95.5, "likely"),
    (f64::INFINITY, "almost certain"),
];

/// What the run says of its own results.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Validity {
    /// Why nothing that was computed may be used, if so.
    pub spoiled: Option<String>,
    /// What to do where no measure is usable; empty where nothing helps.
    pub next: &'static str,
    /// Whether the run ended before they had to reach their peaks: they are then at least so large.
    pub cut: bool,
    /// Whether the blow comes at an angle that no curve was measured at.
    pub aslant: bool,
    /// Whether the eye is a pig's.
    pub pig: bool,
    /// Said in place of a verdict where no curve speaks at all: why, and what to do.
    pub silence: &'static str,
}

/// The part that one curve has in a verdict.
#[derive(Debug, Clone, PartialEq)]
pub enum Part {
    /// It is believed.
    Believed,
    /// It counts less, and agrees.
    Agrees,
    /// It disagrees or lies outside the range, and counts less for this reason.
    Disagrees(&'static str),
    /// It is not used, for this reason.
    NotValid(String),
}

/// The verdict on one injury: a range of risk, and what each of its curves adds to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Verdict {
    /// The injury.
    pub injury: Injury,
    /// Every curve of it with its part, the believed first.
    pub parts: Vec<(Risk, Part)>,
    /// Least and greatest risk, 0 to 1; none where no measure is usable.
    pub range: Option<(f64, f64)>,
    /// Whether a measure ends with the run while it may still grow.
    pub at_least: bool,
    /// Whether the run ended while pressure or stress may still grow.
    cut: bool,
    /// Whether the range was widened because energy alone knows too little of this blow.
    pub alone: bool,
    /// Why there is no range, and what to do; empty where there is one.
    silence: String,
}

/// Verdicts on every injury from what the curves say of one blow, the gravest first.
pub fn verdicts(risks: &[Risk], validity: &Validity) -> Vec<Verdict> {
    let all = Injury::ALL.into_iter();
    all.map(|injury| verdict(injury, risks, validity)).collect()
}

/// The verdict on one injury.
pub fn verdict(injury: Injury, risks: &[Risk], validity: &Validity) -> Verdict {
    let of = risks.iter().filter(|r| r.curve.injury == injury);
    let mut verdict = Verdict::of(injury, of.copied().collect(), validity);
    if risks.is_empty() {
        validity.silence.clone_into(&mut verdict.silence);
    }
    verdict
}

fn is_computed(measure: Measure) -> bool {
    matches!(measure, Measure::Pressure | Measure::Stress)
}

/// Why a curve means nothing here.
fn objection(risk: &Risk, validity: &Validity) -> Option<String> {
    let felt = is_computed(risk.curve.measure);
    if let Some(why) = validity.spoiled.as_ref().filter(|_| felt) {
        return Some(why.clone());
    }
    // Nobody asks another species where the eye's own has a curve.
    if let Some(why) = of_others(risk.curve.species, validity) {
        let (injury, measure) = (risk.curve.injury, risk.curve.measure);
        let own = |c: &&InjuryCurve| of_others(c.species, validity).is_none();
        let own = CURVES.iter().filter(own);
        if felt
            && own
                .into_iter()
                .any(|c| (c.injury, c.measure) == (injury, measure))
        {
            return Some(why.to_owned());
        }
    }
    if risk.caution == Some(Caution::LargerThanOrbit) {
        return Some("object larger than the orbit's opening".to_owned());
    }
    (risk.curve.standing == Standing::Unverified).then(|| "a figure from memory".to_owned())
}

/// The place of a curve in the order: reservation, kind and nearness.
fn rank(risk: &Risk, validity: &Validity) -> (bool, bool, u8) {
    let nearness = match risk.curve.measure {
        Measure::Stress => 0,
        Measure::Pressure => 1,
        Measure::NormalizedEnergy => 2,
        Measure::KineticEnergy => 3,
    };
    let computed = is_computed(risk.curve.measure);
    (reservation(risk, validity).is_some(), !computed, nearness)
}

fn reservation(risk: &Risk, validity: &Validity) -> Option<&'static str> {
    let larger = risk.caution == Some(Caution::LargerThanEye);
    of_others(risk.curve.species, validity).or(larger.then_some("object larger than the eye"))
}

/// The words for a curve of another species than the eye; none where they agree.
fn of_others(eyes: Eyes, validity: &Validity) -> Option<&'static str> {
    match (eyes, validity.pig) {
        (Eyes::Pig, false) => Some("measured on pigs' eyes"),
        (Eyes::Human, true) => Some("measured on human eyes"),
        _ => None,
    }
}

/// Why `risk` counts less than what is believed.
fn why_less(risk: &Risk, validity: &Validity) -> &'static str {
    reservation(risk, validity).unwrap_or(if is_computed(risk.curve.measure) {
        "a mean over the globe"
    } else {
        "it knows the object only"
    })
}

/// Whether a risk by energy is asked for where what the eye felt would come first, or at an angle
/// that no energy knows.
fn knows_too_little(risk: &Risk, validity: &Validity) -> bool {
    let felt = |curve: &InjuryCurve| {
        let own = curve.injury == risk.curve.injury && is_computed(curve.measure);
        own && of_others(curve.species, validity).is_none()
    };
    !is_computed(risk.curve.measure) && (validity.aslant || CURVES.iter().any(felt))
}

fn disagree(a: &Risk, b: &Risk) -> bool {
    let (low, high) = (a.risk.min(b.risk), a.risk.max(b.risk));
    high > UNLIKELY && high > FACTOR * low
}

/// A range of risks from 0 to 1, in whole %, as in `27-94 %`.
pub fn span((low, high): (f64, f64)) -> String {
    let (least, most) = ((100.0 * low).round(), (100.0 * high).round());
    if least == most {
        whole(low)
    } else {
        format!("{least}-{most} %")
    }
}

/// A risk in whole percent.
fn whole(risk: f64) -> String {
    let percent = (100.0 * risk).round();
    match percent {
        none if none < 1.0 => "under 1 %".to_owned(),
        all if all > 99.0 => "over 99 %".to_owned(),
        some => format!("{some} %"),
    }
}

/// The place in [`SCALE`] of a risk from 0 to 1, as it is printed.
pub fn gravity(risk: f64) -> usize {
    let percent = (100.0 * risk).round();
    let place = SCALE.iter().position(|(below, _)| percent < *below);
    place.unwrap_or(SCALE.len() - 1)
}

/// A curve outside the verdict that is named all the same.
struct Other {
    measure: &'static str,
    risk: f64,
    why: &'static str,
    /// Whether the run ended while its measure may still grow.
    at_least: bool,
}

impl Other {
    fn said(&self) -> String {
        let risk = if self.at_least {
            format!("{AT_LEAST} {} %", (100.0 * self.risk).floor())
        } else {
            whole(self.risk)
        };
        format!("by {} {risk}", self.measure)
    }
}

impl Verdict {
    fn of(injury: Injury, mut risks: Vec<Risk>, validity: &Validity) -> Self {
        risks.sort_by_key(|risk| rank(risk, validity));
        let usable = |risk: &&Risk| objection(risk, validity).is_none();
        let first = risks.iter().find(usable).copied();
        let part = |risk: &Risk| {
            if let Some(reason) = objection(risk, validity) {
                return Part::NotValid(reason);
            }
            let Some(first) = &first else {
                return Part::Agrees;
            };
            let class = |risk| (rank(risk, validity).0, rank(risk, validity).1);
            if disagree(first, risk) {
                Part::Disagrees(why_less(risk, validity))
            } else if class(risk) == class(first) {
                Part::Believed
            } else {
                Part::Agrees
            }
        };
        let parts: Vec<(Risk, Part)> = risks.iter().map(|risk| (*risk, part(risk))).collect();
        let mut verdict = Self {
            injury,
            parts,
            range: None,
            at_least: false,
            cut: validity.cut,
            alone: first.is_some_and(|first| knows_too_little(&first, validity)),
            silence: String::new(),
        };
        let ends = verdict.range_with(|risk| risk.value);
        verdict.at_least = validity.cut && verdict.rests_on_the_run();
        verdict.range = first.map(|_| (ends.0, if verdict.at_least { 1.0 } else { ends.1 }));
        verdict.name_what_lies_outside(validity);
        verdict.parts.sort_by_key(|(_, part)| match part {
            Part::Believed => 0,
            Part::Agrees => 1,
            Part::Disagrees(_) => 2,
            Part::NotValid(_) => 3,
        });
        if first.is_none() {
            verdict.silence = verdict.why_silent(validity);
        }
        verdict
    }

    /// The range of what is believed if its measures had other values.
    pub fn range_with(&self, value: impl Fn(&Risk) -> f64) -> (f64, f64) {
        let factor = if self.alone { FACTOR } else { 1.0 };
        self.believed().fold((1.0, 0.0), |(low, high), risk| {
            let value = value(risk);
            let band = Risk { value, ..*risk }.band_within(factor);
            (band.0.min(low), band.1.max(high))
        })
    }

    /// What agrees and yet lies outside the range, as it is printed, is to be named.
    fn name_what_lies_outside(&mut self, validity: &Validity) {
        let Some((low, high)) = self.range else {
            return;
        };
        let percent = |risk: f64| (100.0 * risk).round();
        for (risk, part) in &mut self.parts {
            let outside = percent(risk.risk) < percent(low) || percent(risk.risk) > percent(high);
            if *part == Part::Agrees && outside && risk.risk.max(high) > UNLIKELY {
                *part = Part::Disagrees(why_less(risk, validity));
            }
        }
    }

    fn why_silent(&self, validity: &Validity) -> String {
        if self.parts.is_empty() {
            return "no measure is usable: no published curve runs against what this scene has"
                .to_owned();
        }
        let mut reasons = self.not_valid();
        // What mends a run helps where a curve runs against something computed.
        let computed = |c: &InjuryCurve| c.injury == self.injury && is_computed(c.measure);
        let helps = !validity.next.is_empty() && CURVES.iter().any(computed);
        reasons.extend(helps.then(|| validity.next.to_owned()));
        format!("no measure is usable: {}", reasons.join("; "))
    }

    /// The risks that the verdict believes, in the order of their rank.
    pub fn believed(&self) -> impl Iterator<Item = &Risk> {
        let believed = self
            .parts
            .iter()
            .filter(|(_, part)| *part == Part::Believed);
        believed.map(|(risk, _)| risk)
    }

    /// Whether a believed risk comes from a computed measure, which has errors of step and mesh.
    pub fn rests_on_the_run(&self) -> bool {
        self.believed().any(|r| is_computed(r.curve.measure))
    }

    /// The range in a word or two.
    pub fn word(&self) -> Option<String> {
        let (low, high) = self.range?;
        let unclear = self.is_unclear();
        let (low, high) = (gravity(low), gravity(high));
        Some(if low == high {
            SCALE[low].1.to_owned()
        } else if unclear {
            "unclear".to_owned()
        } else {
            format!("{} to {}", SCALE[low].1, SCALE[high].1)
        })
    }

    /// Whether the range goes from the least word of the scale to the greatest.
    pub fn is_unclear(&self) -> bool {
        let whole = |(low, high)| gravity(high) - gravity(low) == SCALE.len() - 1;
        self.range.is_some_and(whole)
    }

    /// The range in percent.
    pub fn percent(&self) -> Option<String> {
        let range = self.range?;
        Some(if self.at_least {
            format!("{AT_LEAST} {} %", (100.0 * range.0).round())
        } else {
            span(range)
        })
    }

    /// What to say after the injury's name, the longest words first, for places where room may be
    /// short.
    pub fn forms(&self) -> Vec<String> {
        let mut forms = vec![self.words()];
        if let (Some(word), Some(percent)) = (self.word(), self.percent()) {
            let believed = format!("{word} ({percent}), by {}", self.rests_on());
            // Without its reason, another figure by energy would only confuse beside one that is
            // believed.
            let believes = |name| self.believed().any(|r| r.curve.measure.short() == name);
            let others: Vec<String> = self
                .others()
                .filter(|other| !believes(other.measure))
                .map(|other| other.said())
                .collect();
            if !others.is_empty() {
                forms.push(format!("{believed}; {}", others.join(", ")));
            }
            forms.push(believed);
            forms.push(format!("{word} ({percent})"));
            forms.push(percent);
        } else {
            let said = forms[0].split([':', ';']).next();
            forms.extend(said.map(str::to_owned));
        }
        forms
    }

    /// The curves outside the verdict that are named all the same.
    fn others(&self) -> impl Iterator<Item = Other> {
        self.parts.iter().filter_map(|(risk, part)| match part {
            Part::Disagrees(why) => Some(Other {
                measure: risk.curve.measure.short(),
                risk: risk.risk,
                why,
                at_least: self.cut && is_computed(risk.curve.measure),
            }),
            _ => None,
        })
    }

    /// The believed measures in words.
    fn rests_on(&self) -> String {
        if self.alone {
            return "energy alone".to_owned();
        }
        let mut names: Vec<&str> = Vec::new();
        for risk in self.believed() {
            let name = risk.curve.measure.short();
            if !names.contains(&name) {
                names.push(name);
            }
        }
        names.join(" and ")
    }

    /// Which measures are not valid here, and why, each reason once.
    fn not_valid(&self) -> Vec<String> {
        let mut reasons: Vec<(String, Vec<&str>)> = Vec::new();
        for (risk, part) in &self.parts {
            let Part::NotValid(reason) = part else {
                continue;
            };
            let name = risk.curve.measure.short();
            // Another curve of the same measure speaks for it.
            let spoken = |(of, part): &(Risk, Part)| {
                !matches!(part, Part::NotValid(_)) && of.curve.measure.short() == name
            };
            if self.parts.iter().any(spoken) {
                continue;
            }
            match reasons.iter_mut().find(|(known, _)| known == reason) {
                Some((_, names)) if names.contains(&name) => {}
                Some((_, names)) => names.push(name),
                None => reasons.push((reason.clone(), vec![name])),
            }
        }
        let said = |(reason, names): &(String, Vec<&str>)| {
            format!("{} not valid here: {reason}", names.join(" and "))
        };
        reasons.iter().map(said).collect()
    }

    /// What the verdict says after the injury's name.
    pub fn words(&self) -> String {
        let (Some(word), Some(percent)) = (self.word(), self.percent()) else {
            return self.silence.clone();
        };
        let mut text = format!("{word} ({percent}), by {}", self.rests_on());
        if let Some(why) = self.doubt() {
            text.extend([" ", why]);
        }
        if self.alone {
            text.push_str(", which knows neither angle nor place");
        }
        for other in self.others() {
            text.extend(["; ", &other.said(), ": ", other.why]);
        }
        for reason in self.not_valid() {
            text.extend(["; ", &reason]);
        }
        text
    }

    /// The reservation about the risk that is believed first.
    fn doubt(&self) -> Option<&'static str> {
        let first = self.believed().next()?;
        match (first.curve.species, first.caution) {
            (Eyes::Pig, _) => Some("of pigs' eyes"),
            (_, Some(Caution::LargerThanEye)) => Some("of smaller objects"),
            _ => None,
        }
    }
}

/// What to say of each injury, under its name. Where nothing can be said of any for one and the
/// same reason, it is said once.
pub fn lines(verdicts: &[Verdict]) -> Vec<(&'static str, String)> {
    if let [first, rest @ ..] = verdicts
        && first.range.is_none()
        && rest
            .iter()
            .all(|v| v.range.is_none() && v.words() == first.words())
    {
        return vec![("injuries", first.words())];
    }
    let line = |verdict: &Verdict| (verdict.injury.name(), verdict.words());
    verdicts.iter().map(line).collect()
}

#[cfg(test)]
mod tests;
