//! What can stand in front of a screen: the keys, a list, a name that is typed, a question.

use crate::scenario::Scenario;
use crate::tui::{changing::Changing, line::TextLine, picker::Picker, threshold::Asking};

/// Something in front of the screen.
pub enum Overlay {
    /// The keys, scrolled down so far.
    Help(u16),
    /// The list of presets and files: to open one, or to mark some for the screen that asked.
    Picker(Picker),
    /// At which value of a number does a result reach this?
    Threshold(Box<Asking>),
    /// A field of a marked preset is being changed.
    Change(Box<Changing>),
    /// A name is being typed, and what is wrong with it.
    Name(Naming, TextLine, Option<String>),
    /// Something is asked.
    Prompt(Prompt),
}

/// What a name is typed for.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Naming {
    /// To save what is worked on.
    Save,
    /// To give the preset of this name another one.
    Rename(String),
}

/// What is asked.
#[derive(Debug, Clone, PartialEq)]
pub enum Prompt {
    /// Remove the preset of this name?
    Remove(String),
    /// Replace the preset of this name?
    Replace(String),
    /// Save under the name of a built-in preset, which the saved one then hides?
    Hide(String),
    /// Take over this scenario's mesh level, integrator and step? The words say what it costs.
    Adopt(String, Box<Scenario>),
    /// Write this page, with the beginning of its file's name?
    Page(String, Vec<u8>),
    /// Quit without saving? Whether the next start brings the changes back.
    Quit(bool),
}

impl Prompt {
    /// The question in a few words, for the footer.
    pub fn brief(&self) -> String {
        match self {
            Self::Remove(name) => format!("Remove the preset {name}?"),
            Self::Replace(name) => format!("Replace the preset {name}?"),
            Self::Hide(name) => format!("Save over the built-in {name}?"),
            Self::Page(..) => "Write the page?".to_owned(),
            Self::Adopt(..) => "Compute it so?".to_owned(),
            Self::Quit(_) => "Quit without saving the changes?".to_owned(),
        }
    }

    /// The question in full, with what a yes would do.
    pub fn text(&self) -> String {
        match self {
            Self::Remove(name) => format!(
                "This removes your preset {name} from the disk. Remove it? u brings it back."
            ),
            Self::Replace(name) => {
                format!("There is a preset {name} already. Put this one in its place?")
            }
            Self::Hide(name) => format!(
                "{name} comes with the program. A preset of your own of that name hides it. Save it?"
            ),
            Self::Page(stem, text) => {
                let folder = std::env::current_dir().unwrap_or_default();
                let size = text.len() as f64 / 1e6;
                format!("{stem}.html of {size:.1} MB goes into {}. Write it?", folder.display())
            }
            Self::Adopt(words, _) => words.clone(),
            Self::Quit(false) => "The changes are not saved. Quit and lose them?".to_owned(),
            Self::Quit(true) => {
                "The changes are not saved as a preset. Quit? They are there again next time."
                    .to_owned()
            }
        }
    }
}
