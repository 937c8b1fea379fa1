//! A risk in words and in whole percent.
//!
//! The words go by what is told and by the upper end: an upper end is what a physician acts on, and
//! a low figure is no all-clear. Where laboratories tell more than clinics they go a step higher.

use crate::injury::{kind::Injury, risk::Risk, risk::Share};

/// Stands where a figure is not known: not a dash, which reads as none.
pub const UNSAID: &str = "?";
/// Said where a globe is open as likely as not.
pub const BURST: &str = "an open globe has the others too";
/// Stands where nobody counted and a range would say nothing.
pub const NOBODY: &str = "nobody counted";
/// Stands where others of a kind's injuries were counted, but not this one.
pub const TOO_WIDE: &str = "too wide to tell";
/// Stands under every answer, whatever it says.
pub const SIGNS: &str = "Pain, poor vision, blood, an odd pupil or double vision need an eye doctor \
    today; a low figure is no reassurance. Research and education, not diagnosis.";

/// Words for risks, the least first.
const WORDS: [&str; 5] =
    ["not expected", "cannot be excluded", "possible", "likely", "almost certain"];
/// An upper end below this is not expected, from 0 to 1.
const NOT_EXPECTED: f64 = 0.045;
/// Told from which on it is possible, likely, almost certain.
const TOLD: [f64; 3] = [0.1, 0.5, 0.9];
/// Nothing is almost certain whose lower end lies below this.
const SURE: f64 = 0.5;

/// The place of a share in the ladder of words, from 0 to 4.
pub fn gravity(share: &Share) -> usize {
    if share.high < NOT_EXPECTED {
        return 0;
    }
    let above = TOLD.iter().filter(|least| share.told >= **least).count();
    if above == TOLD.len() && share.low < SURE { above } else { 1 + above }
}

/// A risk from 0 to 1 in whole percent.
pub fn whole(risk: f64) -> String {
    match (100.0 * risk).round() {
        none if none < 1.0 => "under 1 %".to_owned(),
        all if all > 99.0 => "over 99 %".to_owned(),
        some => format!("{some} %"),
    }
}

/// A range of risks from 0 to 1, in whole %, as in `27-94 %`.
pub fn span((low, high): (f64, f64)) -> String {
    let (least, most) = ((100.0 * low).round(), (100.0 * high).round());
    if least == most { whole(low) } else { format!("{least}-{most} %") }
}

impl Share {
    /// Its middle in whole percent.
    pub fn percent(&self) -> String {
        whole(self.told)
    }

    /// Its range in whole percent.
    pub fn range(&self) -> String {
        span((self.low, self.high))
    }
}

impl Risk {
    /// The risk in a word or two.
    pub fn word(&self) -> &'static str {
        match () {
            () if !self.usable => "not known",
            () if self.is_open() && self.of_counted_kind => TOO_WIDE,
            () if self.is_open() => NOBODY,
            () => WORDS[self.gravity()],
        }
    }

    /// Its place in the ladder of words: by what is told, a step more where laboratories tell more,
    /// and never the least where clinics counted any.
    pub fn gravity(&self) -> usize {
        let seen = self.counted.is_some_and(|(outcome, _)| outcome.hurt > 0);
        let own = gravity(&self.share()).max(usize::from(seen));
        let other = self.laboratory.map_or(0, |other| gravity(&other));
        own.max(other.min(own + 1))
    }

    /// Told in whole percent, or a sign that it is not said.
    pub fn middle(&self) -> String {
        self.figure(super::risk::Share::percent)
    }

    /// The range in whole percent, or a sign that it is not said.
    pub fn range(&self) -> String {
        self.figure(super::risk::Share::range)
    }

    fn figure(&self, of: impl Fn(&Share) -> String) -> String {
        let said = self.usable && !self.is_open();
        if said { of(&self.share()) } else { UNSAID.to_owned() }
    }

    /// What the tissue felt beside what hurts half, in words.
    pub fn felt(&self) -> String {
        match self.of_half {
            less if less < 0.1 => {
                "felt less than a tenth of what hurts half of all eyes".to_owned()
            }
            times if times < 0.95 => {
                format!("felt {times:.1} of what hurts half of all eyes")
            }
            times if times < 10.0 => format!("felt {times:.1} times what hurts half of all eyes"),
            _ => "felt more than ten times what hurts half of all eyes".to_owned(),
        }
    }

    /// What was counted near enough, as in `12 of 71, squash balls`.
    pub fn seen(&self) -> Option<String> {
        let (outcome, objects) = self.counted?;
        let (count, whose) = (outcome.count(), outcome.whose());
        let (author, year) = (outcome.first_author(), outcome.year);
        Some(format!("{count}{whose} ({objects}, {author} {year})"))
    }

    /// What laboratories tell, where that is another answer.
    pub fn in_laboratory(&self) -> Option<String> {
        let other = self.laboratory?;
        Some(format!("donor eyes in laboratories {} ({})", other.percent(), other.range()))
    }

    /// All that is said after the injury's name, in parts, what counts first.
    pub fn parts(&self) -> Vec<String> {
        if !self.usable {
            return vec![self.word().to_owned()];
        }
        let mut parts = vec![if self.is_open() {
            format!("{}; {}", self.word(), self.felt())
        } else {
            let share = self.share();
            let of = if self.clinic.is_some() { "found in" } else { "in" };
            let whose = if self.clinic.is_some() { "those who come" } else { "eyes hit so" };
            let (word, told, range) = (self.word(), share.percent(), share.range());
            let more = if self.cut { ", or more" } else { "" };
            format!("{word}: {of} {told} of {whose} ({range}{more})")
        }];
        if self.clinic.is_some() && !self.is_open() {
            parts.push(format!("{} of eyes hit so ({})", self.hit.percent(), self.hit.range()));
        }
        parts.extend(self.seen().map(|seen| format!("seen {seen}")));
        parts.extend(self.in_laboratory());
        if self.opens() {
            parts.push(BURST.to_owned());
        }
        parts
    }

    /// All of it in one line.
    pub fn words(&self) -> String {
        self.parts().join("; ")
    }

    /// Whether the globe is open as likely as not, which comes before all else.
    pub fn opens(&self) -> bool {
        self.usable && self.injury == Injury::GlobeRupture && self.hit.told >= 0.5
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_follows_what_is_told_and_its_upper_end() {
        let of = |told, low, high| WORDS[gravity(&Share { told, low, high })];
        assert_eq!(of(0.01, 0.0, 0.03), "not expected");
        assert_eq!(of(0.01, 0.0, 0.2), "cannot be excluded");
        assert_eq!(of(0.2, 0.0, 0.9), "possible");
        assert_eq!(of(0.6, 0.1, 0.9), "likely");
        assert_eq!(of(0.95, 0.4, 1.0), "likely");
        assert_eq!(of(0.95, 0.7, 1.0), "almost certain");
    }

    #[test]
    fn no_figure_is_finer_than_a_percent() {
        assert_eq!((whole(0.004).as_str(), whole(0.996).as_str()), ("under 1 %", "over 99 %"));
        assert_eq!((span((0.1, 0.5)), span((0.101, 0.099))), ("10-50 %".into(), "10 %".into()));
    }
}
