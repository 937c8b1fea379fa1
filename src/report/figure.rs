//! A result as people read it: no digit finer than its error, and that error behind it.
//!
//! An error is that of step and mesh together, in % of the result. While the mesh error is not
//! estimated it is that of the step alone, and [`causes`] says so once a page. What is unknown of
//! the inputs is never part of it: that is the work of an ensemble. JSON and CSV have all digits,
//! and both errors apart.

use std::fmt;

use crate::answer::results::Limit;
use crate::answer::solve::{Answer, Cut, Errors};
use crate::injury::{ENERGY, MERIDIAN, SHELL, Term};
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
    /// By the step, and the mesh once its error is estimated.
    Known(f64),
    /// Unknown: finer meshes do not agree on it.
    Limitless,
}

impl Off {
    pub fn of(errors: &Errors, of: Quantity) -> Self {
        let Some(step) = errors.time_step[of] else {
            let unstated = of.row().family == Family::Unstated;
            return if unstated { Self::Unstated } else { Self::Limitless };
        };
        let mesh = errors.mesh.as_ref().map_or(Some(0.0), |mesh| mesh[of]);
        mesh.map_or(Self::Limitless, |mesh| Self::Known(step + mesh))
    }

    pub fn percent(self) -> Option<f64> {
        if let Self::Known(error) = self { Some(error) } else { None }
    }
}

impl fmt::Display for Off {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        match *self {
            Self::Unstated => Ok(()),
            Self::Limitless => f.write_str("±?"),
            Self::Known(error) if error > 0.0 && error < NEGLIGIBLE => {
                write!(f, "±<{NEGLIGIBLE} %")
            }
            Self::Known(error) if error < 1.0 => write!(f, "±{} %", rounded(error, 1)),
            Self::Known(error) => write!(f, "±{}", percent(error)),
        }
    }
}

/// What the errors behind the figures of a page come from, in words.
fn causes(errors: &Errors) -> &'static str {
    if errors.mesh.is_some() { "step and mesh" } else { "step alone, mesh not estimated" }
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
    /// With no digit finer than its error.
    pub number: String,
    pub unit: &'static str,
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

/// What stands before a result that the run cut off: as a sign and in words.
pub fn cut_before(cut: Option<Cut>) -> (&'static str, &'static str) {
    match cut {
        Some(Cut::AtLeast) => ("≥", "at least"),
        Some(Cut::NotFinal) => ("~", "so far"),
        None => ("", ""),
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
    pub fn of(answer: &Answer, of: Quantity) -> Option<Self> {
        let value = answer.result(of)?;
        let off = Off::of(&answer.errors, of);
        let number = number_of(of, value, |value| match off {
            Off::Limitless => rounded(value, DIGITS.0),
            off => within(value, off.percent()),
        });
        let cut = answer.cut(of);
        // Of a risk that is less than so much, and may grow, nothing is known.
        let number = if cut.is_some() && number.starts_with('<') { "0".to_owned() } else { number };
        // The index is the paper's percentage.
        let unit = if of == Quantity::Damage { "%" } else { of.row().unit };
        Some(Self { number, unit, off, cut })
    }

    /// The number as a table shows it, with a sign where the run cut it off, see [`cut_signs`].
    pub fn cell(&self) -> String {
        cut_before(self.cut).0.to_owned() + &self.number
    }

    /// The figure with at most `count` digits, for narrow places.
    #[must_use]
    pub fn coarser(&self, count: i32) -> Self {
        let known = self.number.parse().map(|value| rounded(value, count));
        let number = known.unwrap_or_else(|_| self.number.clone());
        Self { number, ..self.clone() }
    }

    /// The unit where it stands before the error, and the error with its unit, of a figure in
    /// percent in percent of the same: `26 ±9 %`, as `26 % ±35 %` reads as up to 61.
    pub fn unit_and_error(&self) -> (&'static str, String) {
        let number: Option<f64> = self.number.parse().ok();
        match (self.unit, self.off, number) {
            ("%", Off::Known(error), Some(number)) => {
                let off = number.abs() * error / 100.0;
                let after = self.number.split_once('.').map_or(0, |(_, after)| after.len());
                let whole = format!("{off:.after$}");
                let is_less = off > 0.0 && whole.trim_matches(['0', '.']).is_empty();
                let least = format!("<{:.after$}", libm::exp10(-(after as f64)));
                ("", format!("±{} %", if is_less { least } else { whole }))
            }
            (unit, off, _) => (unit, off.to_string()),
        }
    }

    /// The number as [`Self::cell`] shows it with its unit.
    pub fn signed(&self) -> String {
        with_unit(&self.cell(), self.unit)
    }
}

impl fmt::Display for Figure {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        let (unit, error) = self.unit_and_error();
        let number = with_unit(&self.number, unit);
        let words = format!("{} {number} {error}", cut_before(self.cut).1);
        f.write_str(words.trim())
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

/// A trace at one moment, as in `12.3 ±0.4 N`, by the share that its peak may be off by; of no
/// result without.
pub fn at_a_moment(answer: &Answer, course: Trace, value: f64) -> String {
    let row = course.row();
    let hit = answer.result(Quantity::Contact).is_some();
    let of = match course {
        Trace::Of(of) => of,
        // What drives an eye that is hit is a result of its own.
        Trace::Other(OtherTrace::Drive) if hit => Quantity::Contact,
        Trace::Other(_) => {
            let value = settled(value, NEGLIGIBLE_NOW);
            // No error is estimated of the energies, so they have the digits that any result has.
            let energy = row.place.0 == Group::Energies;
            let number = if energy { rounded(value, DIGITS.0) } else { significant(value) };
            return with_unit(&number, row.unit);
        }
    };
    let off = Off::of(&answer.errors, of);
    let peak = answer.result(of).unwrap_or_default().abs();
    // What is far below the peak is nothing.
    let value = settled(value, 1e-4 * peak);
    let figure = match off {
        Off::Limitless => format!("{} ±?", rounded(value, DIGITS.0)),
        Off::Unstated => significant(value),
        Off::Known(percent) => {
            // Of a moment the error is that of the moment: what is nearly nothing is off by less.
            let error = percent / 100.0 * value.abs();
            if percent < NEGLIGIBLE || value == 0.0 {
                let known = percent > 0.0 && value != 0.0;
                let negligible = if known { off.to_string() } else { String::new() };
                return with_unit(&with_unit(&significant(value), row.unit), &negligible);
            }
            format!("{} ±{}", to_the_place(value, error), rounded(error, 1))
        }
    };
    with_unit(&figure, row.unit)
}

/// Below this a load in N or a way in mm is rounding.
const NEGLIGIBLE_NOW: f64 = 5e-4;

/// `value`, or 0 where it is less than `least` either way.
fn settled(value: f64, least: f64) -> f64 {
    if value.abs() < least { 0.0 } else { value }
}

/// A value with no digit finer than the first one of its error, nor more than four.
fn to_the_place(value: f64, error: f64) -> String {
    let after = (-error.log10().floor()).clamp(0.0, 9.0) as usize;
    let most = significant(value);
    let plain = format!("{value:.after$}");
    let plain = if plain.len() < most.len() { plain } else { most };
    match plain.trim_start_matches('-').trim_start_matches(['0', '.']) {
        "" => "0".to_owned(),
        _ => plain,
    }
}

pub fn with_unit(number: &str, unit: &str) -> String {
    format!("{number} {unit}").trim_end().to_owned()
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

/// A result on the answer's mesh and in the limit of finer ones, as in
/// `12.40 N on this mesh, 12.3 ±1.0 N in the limit`; none where no limit is known.
pub fn here_and_in_the_limit(answer: &Answer, of: Quantity) -> Option<String> {
    let limit = in_the_limit(answer, of)?;
    let value = within(answer.result(of)?, answer.errors.time_step[of]);
    let here = with_unit(&value, of.row().unit);
    Some(format!("{here} on this mesh, {limit} in the limit"))
}

/// What a result tends to on finer meshes, as in `12.3 ±1.0 N`.
pub fn in_the_limit(answer: &Answer, of: Quantity) -> Option<String> {
    let limit = answer.errors.limits.as_ref()?[of]?;
    Some(with_unit(&with_error(&limit), of.row().unit))
}

/// A limit and how far it may be off, both to the second digit of that.
fn with_error(limit: &Limit) -> String {
    let Limit { value, error } = *limit;
    let error_text = digits(error, 2);
    if error_text.contains('e') || error <= 0.0 {
        return format!("{} ±{error_text}", significant(value));
    }
    let after = error_text.split_once('.').map_or(0, |(_, after)| after.len());
    format!("{value:.after$} ±{error_text}")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::results::Results;

    #[test]
    fn a_limit_has_no_finer_digits_than_its_error() {
        let limits = [(18.4123, 1.04), (18.4123, 0.1234), (184.123, 12.3), (1.234e-7, 1.2e-8)];
        let said = limits.map(|(value, error)| with_error(&Limit { value, error }));
        assert_eq!(said, ["18.4 ±1.0", "18.41 ±0.12", "184 ±12", "1.234e-7 ±1.2e-8"]);
        assert_eq!(with_error(&Limit { value: 0.0, error: 0.0 }), "0 ±0");
    }

    #[test]
    fn digits_end_where_the_error_begins() {
        assert_eq!(within(26.4184, None), "26.42");
        let of = |(value, percent)| within(value, Some(percent));
        let small = [(26.4184, 1e-6), (3.2184, 15.0), (0.0, 5.0), (26.4184, 40.0), (72.93, 119.0)];
        assert_eq!(small.map(of), ["26.42", "3.2", "0", "26", "73"]);
        let more = [(5234.0, 40.0), (9.996, 5.0), (-0.0123, 10.0)];
        assert_eq!(more.map(of), ["5200", "10", "-0.012"]);
        assert_eq!(allowing(61.27, Some(0.4)), "61.3");
        let off = [0.0804, 4.21].map(|error| Off::Known(error).to_string());
        assert_eq!(off, ["±0.08 %", "±4.2 %"]);
    }

    #[test]
    fn an_error_says_what_is_known_of_it() {
        let unknown = || Results::from_fn(|_| None);
        let mut errors =
            Errors { time_step: unknown(), mesh: None, limits: None, energy_balance: 0.0 };
        let front = Quantity::ForceFront;
        assert_eq!(Off::of(&errors, front).to_string(), "±?");
        assert_eq!(Off::of(&errors, Quantity::Hyphema).to_string(), "");
        errors.time_step[front] = Some(0.004);
        assert_eq!(Off::of(&errors, front).to_string(), "±<0.01 %");
        assert_eq!(causes(&errors), "step alone, mesh not estimated");
        errors.mesh = Some(unknown());
        assert_eq!(Off::of(&errors, front).to_string(), "±?");
        errors.mesh.as_mut().unwrap()[front] = Some(118.7);
        let off = Off::of(&errors, front);
        let figure = |cut| Figure { number: within(72.93, off.percent()), unit: "N", off, cut };
        assert_eq!(figure(None).to_string(), "73 N ±119 %");
        assert_eq!(figure(Some(Cut::AtLeast)).to_string(), "at least 73 N ±119 %");
        assert_eq!(figure(Some(Cut::AtLeast)).cell(), "≥73");
        assert_eq!(figure(Some(Cut::NotFinal)).cell(), "~73");
        assert_eq!(causes(&errors), "step and mesh");
    }

    #[test]
    fn a_figure_in_percent_has_its_range_in_the_same_unit() {
        let of = |number: &str, error| {
            let (number, off) = (number.to_owned(), Off::Known(error));
            Figure { number, unit: "%", off, cut: None }.to_string()
        };
        assert_eq!(of("26", 35.0), "26 ±9 %");
        assert_eq!(of("93.5", 0.4), "93.5 ±0.4 %");
        assert_eq!(of("26.42", 0.001), "26.42 ±<0.01 %");
        let limitless = Figure { number: "26".into(), unit: "%", off: Off::Limitless, cut: None };
        assert_eq!(limitless.to_string(), "26 % ±?");
    }
}
