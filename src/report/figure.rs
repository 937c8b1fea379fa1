//! A result as people read it: no digit finer than its error, and that error behind it.
//!
//! An error is that of step and mesh together, in % of the result. While the mesh error is not
//! estimated it is that of the step alone, and [`causes`] says so once a page. What is unknown of
//! the inputs is never part of it: that is the work of an ensemble. JSON and CSV have all digits,
//! and both errors apart.

use std::fmt;

use crate::answer::solve::{Answer, Cut, Errors};
use crate::injury::{AT_LEAST, ENERGY, MERIDIAN, SHELL, Term};
use crate::report::format::{digits, percent, share, significant};
use crate::run::quantity::{Family, Quantity};
use crate::run::{flags::FlagKind, result_trace::Group, trace::OtherTrace, trace::Trace};

/// Digits of a value: the least that are worth printing, and the most that anyone reads.
const DIGITS: (i32, i32) = (2, 4);
/// An error below so many % is not worth a number.
const NEGLIGIBLE: f64 = 0.01;

/// How far a result may be off, in % of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Off {
    /// No error is stated of it.
    Unstated,
    /// By the step; the mesh error is not estimated.
    Step(f64),
    /// By step and mesh together.
    Both(f64),
    /// Unknown: finer meshes do not agree on it.
    Limitless,
}

impl Off {
    /// How far a result with these errors may be off.
    pub fn of(errors: &Errors, of: Quantity) -> Self {
        match (errors.time_step[of], &errors.mesh) {
            (None, _) if of.row().family == Family::Unstated => Self::Unstated,
            (None, _) => Self::Limitless,
            (Some(step), None) => Self::Step(step),
            (Some(step), Some(mesh)) => {
                mesh[of].map_or(Self::Limitless, |mesh| Self::Both(step + mesh))
            }
        }
    }

    /// In % of the result, if it is known.
    pub fn percent(self) -> Option<f64> {
        match self {
            Self::Step(error) | Self::Both(error) => Some(error),
            Self::Unstated | Self::Limitless => None,
        }
    }
}

impl fmt::Display for Off {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match self {
            Self::Unstated => Ok(()),
            Self::Limitless => f.write_str("±?"),
            Self::Step(error) | Self::Both(error) if *error > 0.0 && *error < NEGLIGIBLE => {
                write!(f, "±<{NEGLIGIBLE} %")
            }
            Self::Step(error) | Self::Both(error) if *error < 1.0 => {
                write!(f, "±{} %", rounded(*error, 1))
            }
            Self::Step(error) | Self::Both(error) => write!(f, "±{}", percent(*error)),
        }
    }
}

/// What the errors behind the figures of a page come from, in words.
fn causes(errors: &Errors) -> &'static str {
    match errors.mesh {
        Some(_) => "step and mesh",
        None => "step alone, mesh not estimated",
    }
}

/// What the errors behind the figures of an answer are, in words, with their signs.
pub fn error_signs(answer: &Answer) -> String {
    let causes = causes(&answer.errors);
    if answer.pressed_flat() {
        "±?: no eye was tested so hard".to_owned()
    } else if answer.has(FlagKind::BeyondTests) {
        format!("±: {causes}, but no eye was tested so hard")
    } else if answer.errors.without_limit().next().is_some() {
        format!("±: {causes}; ±?: finer meshes do not agree")
    } else {
        format!("±: {causes}")
    }
}

/// A result with its error.
#[derive(Debug, Clone, PartialEq)]
pub struct Figure {
    /// The number, with no digit finer than its error.
    pub number: String,
    /// Its unit; empty where it has none.
    pub unit: &'static str,
    /// How far it may be off.
    pub off: Off,
    /// How it is limited by a run that ended too early.
    pub cut: Option<Cut>,
}

/// What the signs of [`Figure::cell`] mean, in some answers that were cut off.
pub fn cut_signs<'a>(mut answers: impl Iterator<Item = &'a Answer>) -> &'static str {
    if answers.all(Answer::pressed_flat) {
        "≥: at least, ~: so far; the run ended where the eye was pressed flat"
    } else {
        "≥: at least, ~: so far; the run ended too early (a longer window_ms tells)"
    }
}

/// What stands before a result that the run cut off, in words.
pub fn cut_word(cut: Option<Cut>) -> &'static str {
    match cut {
        Some(Cut::AtLeast) => AT_LEAST,
        Some(Cut::NotFinal) => "so far",
        None => "",
    }
}

/// The number of a result: a risk as a share, rounding as 0, anything else as `otherwise` has it.
pub fn number_of(of: Quantity, value: f64, otherwise: impl FnOnce(f64) -> String) -> String {
    if of.is_risk() {
        share(value / 100.0).trim_end_matches(" %").to_owned()
    } else if of.is_rounding(value) {
        "0".to_owned()
    } else {
        otherwise(value)
    }
}

impl Figure {
    /// A result of an answer, if the scene has it.
    pub fn of(answer: &Answer, of: Quantity) -> Option<Self> {
        let value = answer.result(of)?;
        let off = Off::of(&answer.errors, of);
        let number = number_of(of, value, |value| number(value, off));
        let cut = answer.cut(of);
        Some(Self {
            // Of a risk that is less than so much, and may grow, nothing is known.
            number: if cut.is_some() && number.starts_with('<') { "0".to_owned() } else { number },
            unit: of.row().unit,
            off,
            cut,
        })
    }

    /// The number as a table shows it: a sign says what the end of the run means for it, see
    /// [`cut_signs`].
    pub fn cell(&self) -> String {
        let sign = match self.cut {
            Some(Cut::AtLeast) => "≥",
            Some(Cut::NotFinal) => "~",
            None => "",
        };
        format!("{sign}{}", self.number)
    }

    /// The figure with at most `count` digits, for narrow places.
    #[must_use]
    pub fn coarser(&self, count: i32) -> Self {
        let number = self.number.parse();
        let number = number.map_or_else(|_| self.number.clone(), |value| rounded(value, count));
        Self { number, ..self.clone() }
    }

    /// The number as [`Self::cell`] shows it with its unit.
    pub fn signed(&self) -> String {
        with_unit(&self.cell(), self.unit)
    }

    /// The number with its unit alone.
    pub fn bare(&self) -> String {
        with_unit(&self.number, self.unit)
    }
}

impl fmt::Display for Figure {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let error = self.off.to_string();
        let between = if error.is_empty() { "" } else { " " };
        let cut = cut_word(self.cut);
        let space = if cut.is_empty() { "" } else { " " };
        write!(f, "{cut}{space}{}{between}{error}", self.bare())
    }
}

/// What the damage index means.
pub const SCALE: &str = "100 = worst in the paper";

/// Why the damage index means nothing, and what to do; none where it is usable.
pub fn unusable(answer: &Answer) -> Option<String> {
    let spoiled = answer.spoiled()?;
    Some(format!("index not usable: {}; {}", spoiled.why, spoiled.next))
}

/// A part of the index: how many times its limit the result behind it is.
pub fn times_its_limit(figure: &Figure, value: f64, term: Term) -> String {
    let times = value / term.threshold;
    let times = match figure.off {
        Off::Limitless => rounded(times, DIGITS.0),
        off => within(times, Some(off.percent().unwrap_or_default().max(PART_PERCENT))),
    };
    format!("{times} times its limit")
}

/// A part of the index is shown no finer than to this error, in %.
const PART_PERCENT: f64 = 1.0;

/// The parts of the index with the results that they are of.
pub const PARTS: [(Quantity, Term); 3] = [
    (Quantity::ShellGrowth, SHELL),
    (Quantity::MeridianGrowth, MERIDIAN),
    (Quantity::Energy, ENERGY),
];

/// A trace at one moment with its error, both in its unit, as in `12.3 ±0.4 N`. The error is that
/// of the peak at any moment; a trace of no result has none.
pub fn at_a_moment(answer: &Answer, course: Trace, value: f64) -> String {
    let row = course.row();
    let of = match course {
        Trace::Of(of) => of,
        // What drives an eye that is hit is a result of its own.
        Trace::Other(OtherTrace::Drive) if answer.result(Quantity::Contact).is_some() => {
            Quantity::Contact
        }
        // No error is estimated of the energies, so they have the digits that any result has.
        Trace::Other(_) if row.place.0 == Group::Energies => {
            return with_unit(&rounded(settled(value, NEGLIGIBLE_NOW), DIGITS.0), row.unit);
        }
        Trace::Other(_) => {
            return with_unit(&significant(settled(value, NEGLIGIBLE_NOW)), row.unit);
        }
    };
    let off = Off::of(&answer.errors, of);
    let share = off.percent().map(|percent| percent / 100.0);
    let peak = answer.result(of).unwrap_or_default().abs();
    let error = share.map(|share| share * peak);
    // What is far below the peak is nothing.
    let value = settled(value, 1e-4 * peak);
    let (value, error) = match (off, error) {
        (Off::Limitless, _) => (rounded(value, DIGITS.0), " ±?".to_owned()),
        (_, Some(error)) if 100.0 * error < NEGLIGIBLE * peak => {
            let negligible = if error > 0.0 { off.to_string() } else { String::new() };
            let text = format!("{} {negligible}", with_unit(&significant(value), row.unit));
            return text.trim_end().to_owned();
        }
        (_, Some(error)) => (to_the_place(value, error), format!(" ±{}", rounded(error, 2))),
        _ => (significant(value), String::new()),
    };
    with_unit(&format!("{value}{error}"), row.unit)
}

/// Below this a load in N or a way in mm is rounding.
const NEGLIGIBLE_NOW: f64 = 5e-4;

/// `value`, or 0 where it is less than `least` either way.
fn settled(value: f64, least: f64) -> f64 {
    if value.abs() < least { 0.0 } else { value }
}

/// A value with no digit finer than the second one of its error, nor more than four.
fn to_the_place(value: f64, error: f64) -> String {
    let after = (1.0 - error.log10().floor()).clamp(0.0, 9.0) as usize;
    let most = significant(value);
    let plain = format!("{value:.after$}");
    let plain = if plain.len() < most.len() { plain } else { most };
    match plain.trim_start_matches('-').trim_start_matches(['0', '.']) {
        "" => "0".to_owned(),
        _ => plain,
    }
}

/// A number before its unit, if it has one.
pub fn with_unit(number: &str, unit: &str) -> String {
    format!("{number} {unit}").trim_end().to_owned()
}

/// A value as its error allows; few digits where the error is not known.
fn number(value: f64, off: Off) -> String {
    match off {
        Off::Limitless => rounded(value, DIGITS.0),
        off => within(value, off.percent()),
    }
}

/// A value with no digit finer than the first one of its error, given in %, but two at least and
/// four at most.
pub fn within(value: f64, error: Option<f64>) -> String {
    let error = error.filter(|error| *error > 0.0);
    allowing(value, error.map(|percent| value.abs() * percent / 100.0))
}

/// As [`within`], with the error in the unit of the value.
pub fn allowing(value: f64, error: Option<f64>) -> String {
    let Some(error) = error.filter(|error| *error > 0.0 && value != 0.0) else {
        return digits(value, DIGITS.1);
    };
    let place = |size: f64| size.abs().log10().floor();
    let count = (place(value) - place(error) + 1.0) as i32;
    rounded(value, count.clamp(DIGITS.0, DIGITS.1))
}

/// `value` with `count` significant digits; later digits before the point are 0.
fn rounded(value: f64, count: i32) -> String {
    let after = (count - 1).max(0) as usize;
    let kept: f64 = format!("{value:.after$e}").parse().unwrap_or(value);
    digits(kept, count)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::results::Results;

    #[test]
    fn digits_end_where_the_error_begins() {
        assert_eq!(within(26.4184, None), "26.42");
        assert_eq!(within(26.4184, Some(1e-6)), "26.42");
        assert_eq!(within(3.2184, Some(15.0)), "3.2");
        assert_eq!(within(0.0, Some(5.0)), "0");
        assert_eq!(within(26.4184, Some(40.0)), "26");
        assert_eq!(within(72.93, Some(119.0)), "73");
        assert_eq!(within(5234.0, Some(40.0)), "5200");
        assert_eq!(within(9.996, Some(5.0)), "10");
        assert_eq!(within(-0.0123, Some(10.0)), "-0.012");
        assert_eq!(allowing(61.27, Some(0.4)), "61.3");
        assert_eq!(Off::Both(0.0804).to_string(), "±0.08 %");
        assert_eq!(Off::Step(4.21).to_string(), "±4.2 %");
    }

    #[test]
    fn an_error_says_what_is_known_of_it() {
        let mut time_step = Results::from_fn(|_| None);
        let mut errors = Errors { time_step, mesh: None, limits: None, energy_balance: 0.0 };
        let front = Quantity::ForceFront;
        assert_eq!(Off::of(&errors, front).to_string(), "±?");
        assert_eq!(Off::of(&errors, Quantity::Hyphema).to_string(), "");
        time_step[front] = Some(0.004);
        errors.time_step = time_step;
        assert_eq!(Off::of(&errors, front).to_string(), "±<0.01 %");
        assert_eq!(causes(&errors), "step alone, mesh not estimated");
        errors.mesh = Some(Results::from_fn(|_| None));
        assert_eq!(Off::of(&errors, front).to_string(), "±?");
        let mut mesh = Results::from_fn(|_| None);
        mesh[front] = Some(118.7);
        errors.mesh = Some(mesh);
        let off = Off::of(&errors, front);
        let number = within(72.93, off.percent());
        let unit = "N";
        let figure = |cut| Figure { number: number.clone(), unit, off, cut };
        assert_eq!(figure(None).to_string(), "73 N ±119 %");
        assert_eq!(figure(Some(Cut::AtLeast)).to_string(), "at least 73 N ±119 %");
        assert_eq!(figure(Some(Cut::AtLeast)).cell(), "≥73");
        assert_eq!(figure(Some(Cut::NotFinal)).cell(), "~73");
        assert_eq!(causes(&errors), "step and mesh");
    }
}
