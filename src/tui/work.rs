//! What is being worked on, and where it came from.

use crate::report::compare::brief;
use crate::scenario::Scenario;

#[derive(Debug, Clone, PartialEq, Default)]
pub struct Work {
    /// What the form shows, edits and all.
    pub scenario: Scenario,
    /// The preset or file that it began as.
    pub source: String,
    /// What that holds; nothing where it is there no longer.
    pub original: Option<Scenario>,
}

impl Work {
    /// Work on a scenario as it was found.
    pub fn fresh(source: &str, scenario: &Scenario) -> Self {
        let original = Some(scenario.clone());
        Self { scenario: scenario.clone(), source: source.to_owned(), original }
    }

    /// What it is called in short: of a file's path the last part.
    pub fn name(&self) -> &str {
        brief(&self.source)
    }

    /// Whether its title says what it began as, no longer what was made of that.
    pub fn is_outgrown(&self) -> bool {
        let title = &self.scenario.name;
        match &self.original {
            Some(original) => original.name == *title && *original != self.scenario,
            None => self.source == *title,
        }
    }

    /// Another scenario in the place of this one; source and original stay.
    #[must_use]
    pub fn with(&self, scenario: Scenario) -> Self {
        Self { scenario, ..self.clone() }
    }
}
