//! What clinics and laboratories counted: the table that the points of 50 % are fitted to.
//!
//! A row is one injury of one series. Where a row says `derived` its count follows from what was
//! written, as none where a list of all findings does not name it. Rows named for the fit are told
//! apart: `first` are those that models are compared on.

use crate::injury::clinic::Setting;
use crate::injury::kind::{Injury, PerInjury};
use crate::injury::object_kind::KINDS;
use serde::Deserialize;
use std::sync::LazyLock;

/// Fewer eyes than this say nothing beside a risk.
const FEWEST: u32 = 10;
/// The table.
const TABLE: &str = include_str!("outcomes.csv");

/// What was counted of one injury in one series.
#[derive(Debug, Clone, PartialEq, Deserialize)]
pub struct Outcome {
    /// Authors.
    pub study: String,
    /// Year of publication.
    pub year: u16,
    /// What hit, in the words of the series.
    pub object: String,
    /// Kinds of object that it was, by their keys and with `+` between them; empty where none is
    /// near.
    pub kinds: String,
    /// Where it was counted.
    pub setting: Setting,
    /// How many eyes.
    pub eyes: u32,
    /// Name of the injury, as in JSON, or `retina_any`.
    pub injury: String,
    /// How many of them had it.
    pub hurt: u32,
    /// How the count was found.
    pub counted: String,
    /// How the eyes were gathered.
    pub gathered: String,
    /// What it is in the fit; empty where it is left out.
    pub fit: String,
    /// Where a reader can find it.
    pub source: String,
}

impl Outcome {
    /// The injury; none where several are counted as one.
    pub fn injury(&self) -> Option<Injury> {
        Injury::ALL.iter().copied().find(|injury| injury.key() == self.injury)
    }

    /// Whether its count was not written but follows.
    pub fn is_derived(&self) -> bool {
        self.counted.starts_with("derived")
    }

    /// Places of its kinds among [`KINDS`].
    pub fn kinds(&self) -> Vec<usize> {
        let place = |key: &str| KINDS.iter().position(|kind| kind.key == key);
        self.kinds.split('+').filter_map(place).collect()
    }

    /// The first of the authors, as lists name a study.
    pub fn first_author(&self) -> &str {
        let end = self.study.find([',', '&', '(', ';']).unwrap_or(self.study.len());
        self.study[..end].trim().trim_end_matches(" et al.")
    }

    /// What was seen, as in `12 of 71`.
    pub fn count(&self) -> String {
        let bound = if self.counted == "count, at least" { "at least " } else { "" };
        format!("{bound}{} of {}", self.hurt, self.eyes)
    }

    /// Whose eyes they were, where they are not all that came: of them injuries are more frequent.
    pub fn whose(&self) -> &'static str {
        match self.setting {
            Setting::WalkIn => "",
            Setting::Referred => " referred",
            Setting::Laboratory => " in laboratories",
        }
    }
}

/// All that was counted.
///
/// # Panics
/// Never: a test reads the table.
pub fn outcomes() -> &'static [Outcome] {
    static ROWS: LazyLock<Vec<Outcome>> = LazyLock::new(|| {
        let mut reader = csv::Reader::from_reader(TABLE.as_bytes());
        reader.deserialize().map(|row| row.expect("the table can be read")).collect()
    });
    &ROWS
}

/// For each injury what was counted of a kind where most eyes were: of everybody who came, or else
/// of those referred.
pub fn counted(kind: usize) -> PerInjury<Option<&'static Outcome>> {
    std::array::from_fn(|j| {
        let own = outcomes().iter().filter(|row| {
            row.injury() == Some(Injury::ALL[j])
                && row.kinds() == [kind]
                && row.setting != Setting::Laboratory
                && row.eyes >= FEWEST
                && !row.is_derived()
                && row.counted != "count, at most"
        });
        own.max_by_key(|row| (row.setting == Setting::WalkIn, row.eyes))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_row_names_kinds_and_an_injury_and_counts_no_more_eyes_than_there_were() {
        for row in outcomes() {
            assert!(row.hurt <= row.eyes, "{row:?}");
            assert!(row.injury().is_some() || row.injury == "retina_any", "{row:?}");
            let named = row.kinds.split('+').filter(|key| !key.is_empty()).count();
            assert_eq!(row.kinds().len(), named, "{row:?}");
            assert!(row.fit.is_empty() || named > 0, "{row:?}");
        }
        let of = |fit: &str| outcomes().iter().filter(|row| row.fit == fit).count();
        assert_eq!((of("first"), of("mixed")), (51, 4));
    }
}
