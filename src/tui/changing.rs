//! A field of a marked preset that is changed where it stands: which one, and what is typed.

use crate::report::command::arguments;
use crate::scenario::{Scenario, fields::Field};
use crate::tui::form::{FormRow, rows, strength, typed_text, with_text};
use crate::tui::line::TextLine;

/// The preset, its fields, and the value that is typed into one.
pub struct Changing {
    /// What it is called in the comparison.
    pub name: String,
    /// What it is compared as.
    pub scenario: Scenario,
    fields: Vec<&'static Field>,
    at: usize,
    /// The value as typed.
    pub input: TextLine,
    /// What is wrong with it.
    pub error: Option<String>,
}

impl Changing {
    /// Begins with how hard the blow is; none where nothing can be changed.
    pub fn of(name: &str, scenario: &Scenario) -> Option<Self> {
        let fields: Vec<_> = rows(scenario, true).into_iter().filter_map(FormRow::field).collect();
        let first = strength(scenario);
        let at = fields.iter().position(|field| FormRow::Field(field) == first);
        let mut changing = Self {
            name: name.to_owned(),
            scenario: scenario.clone(),
            at: at.or((!fields.is_empty()).then_some(0))?,
            fields,
            input: TextLine::default(),
            error: None,
        };
        changing.go(0);
        Some(changing)
    }

    pub fn field(&self) -> &'static Field {
        self.fields[self.at]
    }

    /// Goes on by so many fields; what was typed into this one is dropped.
    pub fn go(&mut self, by: isize) {
        self.at = self.at.saturating_add_signed(by).min(self.fields.len() - 1);
        self.input = TextLine::of(typed_text(self.field(), &self.scenario).unwrap_or_default());
        self.error = None;
    }

    /// The scenario with what is typed.
    pub fn changed(&self) -> Result<Scenario, String> {
        with_text(&self.scenario, self.field(), self.input.value())
    }
}

/// Whether what is compared under a name, such as `bb-62@60`, began as that preset.
pub fn began_as(name: &str, preset: &str) -> bool {
    name.strip_prefix(preset).is_some_and(|rest| rest.is_empty() || rest.starts_with(['@', ',']))
}

/// What a preset is called once some of its fields are others: its speed stands behind an `@`.
pub fn called(source: &str, original: &Scenario, changed: &Scenario) -> String {
    let Some(words) = arguments(source, original, changed) else {
        return format!("{source},changed");
    };
    let sets = words[1..].iter().filter_map(|word| word.split_once('='));
    let parts = sets.map(|(path, value)| match path {
        "impact.speed_m_s" => format!("@{value}"),
        _ => format!(",{}={value}", path.rsplit('.').next().unwrap_or(path)),
    });
    let mut parts: Vec<String> = parts.collect();
    parts.sort_by_key(|part| part.starts_with(','));
    source.to_owned() + &parts.concat()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::{library::find, set::set};

    #[test]
    fn a_changed_preset_is_called_by_its_speed_and_by_what_else_was_set() {
        let bb = find("bb-62").unwrap().scenario().unwrap();
        let mut changed = bb.clone();
        assert_eq!(called("bb-62", &bb, &changed), "bb-62");
        set(&mut changed, "impact.mass_g", "0.5").unwrap();
        set(&mut changed, "impact.speed_m_s", "60").unwrap();
        let name = called("bb-62", &bb, &changed);
        assert_eq!(name, "bb-62@60,mass_g=0.5");
        assert!(began_as(&name, "bb-62") && !began_as(&name, "bb-6"));
    }
}
