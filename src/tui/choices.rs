//! Everything that can be opened: presets of the program and of the person's own, and files.

use crate::scenario::library::Origin;
use crate::scenario::{Scenario, library};

/// A preset, or a scenario that was given on the command line.
#[derive(Debug, Clone)]
pub struct Choice {
    /// What the list shows, and what opens it.
    pub name: String,
    /// What it holds, or why it cannot be used.
    pub scenario: Result<Scenario, String>,
    /// Where it comes from, in a word.
    pub origin: &'static str,
}

/// The most presets of a person's own that the app holds and saves.
pub const MAX_OWN: usize = 1000;

/// Every preset that can be opened; a broken one says why it cannot.
pub fn choices() -> Vec<Choice> {
    let mut presets = library::list().unwrap_or_else(|_| library::built_in());
    let mut own = 0;
    presets.retain(|preset| {
        own += usize::from(matches!(preset.origin, Origin::User(_)));
        matches!(preset.origin, Origin::BuiltIn(_)) || own <= MAX_OWN
    });
    let unlisted = (own > MAX_OWN).then(|| Choice {
        name: format!("({} more)", own - MAX_OWN),
        scenario: Err(format!(
            "the app lists {MAX_OWN} presets of your own; `contrecoup presets` lists all"
        )),
        origin: "own",
    });
    presets
        .into_iter()
        .map(|preset| Choice {
            scenario: preset.scenario().map_err(|error| error.to_string()),
            origin: match preset.origin {
                Origin::BuiltIn(_) => "",
                Origin::User(_) => "own",
            },
            name: preset.name,
        })
        .chain(unlisted)
        .collect()
}
