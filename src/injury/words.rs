//! A range of risk in words and in whole percent.

use crate::injury::{kind::Injury, risk::Risk};

/// Said of what may be more.
pub const AT_LEAST: &str = "at least";
/// Stands where a figure is not known or not worth saying: not a dash, which reads as none.
pub const UNSAID: &str = "?";
/// Said where rupture is as likely as not.
pub const BURST: &str = "a burst globe has the others too";
/// Stands under every answer, whatever it says.
pub const SIGNS: &str = "Pain, poor vision, blood, an odd pupil or double vision need an eye doctor \
    today; a low figure is no reassurance. Research and education, not diagnosis.";

/// Upper ends of risk, in %, with the word for risks below each.
const SCALE: [(f64, &str); 4] =
    [(5.0, "unlikely"), (50.0, "possible"), (95.5, "likely"), (f64::INFINITY, "almost certain")];

/// The place in the scale of words of a risk from 0 to 1, as it is printed.
pub fn gravity(risk: f64) -> usize {
    let percent = (100.0 * risk).round();
    SCALE.iter().position(|(below, _)| percent < *below).unwrap_or(SCALE.len() - 1)
}

/// A risk from 0 to 1 in whole percent.
pub fn whole(risk: f64) -> String {
    match (100.0 * risk).round() {
        none if none < 1.0 => "under 1 %".to_owned(),
        all if all > 99.0 => "over 99 %".to_owned(),
        some => format!("{some} %"),
    }
}

/// Whether a risk as [`whole`] says it is neither none nor all.
fn is_inner(risk: &str) -> bool {
    risk.starts_with(|c: char| c.is_ascii_digit())
}

/// A range of risks from 0 to 1, in whole %, as in `27-94 %`.
pub fn span((low, high): (f64, f64)) -> String {
    let (least, most) = ((100.0 * low).round(), (100.0 * high).round());
    if least == most { whole(low) } else { format!("{least}-{most} %") }
}

impl Risk {
    /// The whole range in a word or two.
    pub fn word(&self) -> String {
        let [low, high] = [self.range.0, self.range.1].map(|end| SCALE[gravity(end)].1);
        match () {
            () if !self.usable => "not known".to_owned(),
            () if self.is_unclear() => "unclear".to_owned(),
            () if low == high => low.to_owned(),
            () => format!("{low} to {high}"),
        }
    }

    /// Whether the range goes from the least word of the scale to the greatest.
    pub fn is_unclear(&self) -> bool {
        gravity(self.range.1) - gravity(self.range.0) == SCALE.len() - 1
    }

    /// The range in percent.
    pub fn percent(&self) -> String {
        // Whole ranges and what is over 99 % need no other word for more.
        let (said, least) = (span(self.range), self.range.0);
        let more = self.at_least && said != whole(1.0) && (100.0 * least).round() > 0.0;
        if more { format!("{AT_LEAST} {}", whole(least)) } else { said }
    }

    /// What to say after the injury's name, the longest words first, as room may be short.
    pub fn forms(&self) -> Vec<String> {
        let short = format!("{} ({})", self.word(), self.percent());
        if !self.usable {
            return vec![short.clone(), short.clone(), short, self.percent()];
        }
        let risk = self.middle();
        let about = if is_inner(&risk) { "about " } else { "" };
        let middle = format!("{} ({about}{risk}, {})", self.word(), self.percent());
        let sure = risk == self.percent() || !self.has_middle();
        let middle = if sure { short.clone() } else { middle };
        let equivalent = format!("{middle}, like {}", self.equivalent);
        vec![equivalent, middle, short, self.percent()]
    }

    /// Whether its middle is worth saying: one that is sure reads oddly beside a range that is not.
    pub fn has_middle(&self) -> bool {
        self.usable && (!self.is_unclear() || is_inner(&whole(self.risk)))
    }

    /// Its middle in whole percent, or a sign that it is not said.
    pub fn middle(&self) -> String {
        if self.has_middle() { whole(self.risk) } else { UNSAID.to_owned() }
    }

    /// All that is said after the injury's name.
    pub fn words(&self) -> String {
        self.words_but(&[])
    }

    /// All that is said after its name but for some notes, which are said of all injuries at once.
    pub fn words_but(&self, said: &[&str]) -> String {
        let mut words = self.forms().swap_remove(0);
        if self.bursts() {
            words.extend(["; ", BURST]);
        }
        let notes = self.notes.iter().filter(|note| !said.contains(note));
        words.extend(notes.flat_map(|note| ["; ", note]));
        words
    }

    /// Whether the globe bursts as likely as not, which comes before all else.
    pub fn bursts(&self) -> bool {
        self.usable && self.injury == Injury::GlobeRupture && self.risk >= 0.5
    }
}
