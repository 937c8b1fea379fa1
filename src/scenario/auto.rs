//! Numbers that the program may choose: a file says `Auto`, or the number.

use serde::de::{Error, Unexpected};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// How a scenario spells that the program chooses.
pub(super) const AUTO: &str = "Auto";

/// As text has it. The reader of RON tells a word from a number only to an untagged enum.
#[derive(Serialize, Deserialize)]
#[serde(untagged)]
enum Written {
    /// Files may also say `None`, or `Some(4)`.
    Number(Option<f64>),
    Word(Word),
}

#[derive(Serialize, Deserialize)]
enum Word {
    Auto,
}

/// Writes no number as `Auto`.
#[expect(clippy::ref_option, reason = "serde lends the field")]
pub(super) fn serialize<S: Serializer>(
    number: &Option<f64>,
    serializer: S,
) -> Result<S::Ok, S::Error> {
    let written = match number {
        Some(_) => Written::Number(*number),
        None => Written::Word(Word::Auto),
    };
    written.serialize(serializer)
}

/// Reads what [`serialize`] writes.
pub(super) fn deserialize<'de, D: Deserializer<'de>>(source: D) -> Result<Option<f64>, D::Error> {
    match Written::deserialize(source) {
        Ok(Written::Number(number)) => Ok(number),
        Ok(Written::Word(Word::Auto)) => Ok(None),
        Err(_) => {
            Err(D::Error::invalid_value(Unexpected::Other("something else"), &"Auto or a number"))
        }
    }
}
