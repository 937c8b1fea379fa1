//! What a key is, where it counts, and what the table of [`bindings`](self::bindings) makes of it.
//!
//! Dispatch, footer, help, the guide's table and the test of uniqueness all read [`BINDINGS`].
//! Letters that are typed into a field are not bindings; see `update`.

mod bindings;

pub use bindings::BINDINGS;

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::action::Action;
use super::screens::SCREENS;

/// Where a key counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::EnumIter)]
pub enum Context {
    /// On every screen, unless something is typed or asked.
    Everywhere,
    /// In the form, on a row that takes a number.
    Number,
    /// In the form.
    Form,
    /// On the dial.
    Dial,
    /// Wherever time can be moved, unless the pane has the key for itself.
    Clock,
    /// On the replay.
    Replay,
    /// On the force profiles.
    Forces,
    /// In the list of presets of the comparison.
    Marks,
    /// In its table.
    Table,
    /// On its replays.
    Replays,
    /// Among the points of speed against error.
    Accuracy,
    /// Among the bands of the results.
    Doubt,
    /// On the map of two inputs.
    Map,
    /// Among the published injury curves.
    Injury,
    /// While a value or a name is typed.
    Typing,
    /// In the list of presets to open.
    Picker,
    /// While yes or no is asked.
    Question,
    /// While the keys are shown.
    Help,
}

impl Context {
    /// A heading for the help.
    pub fn title(self) -> &'static str {
        match self {
            Self::Everywhere => "Everywhere",
            Self::Number => "Form: a number",
            Self::Form => "Form",
            Self::Dial => "Dial",
            Self::Clock => "Time (form, dial, replay, forces, compare)",
            Self::Replay => "Replay",
            Self::Forces => "Forces",
            Self::Marks => "Compare: presets",
            Self::Table => "Compare: table",
            Self::Replays => "Compare: replays",
            Self::Accuracy => "Accuracy",
            Self::Doubt => "Doubt",
            Self::Map => "Map",
            Self::Injury => "Injury",
            Self::Typing => "Typing",
            Self::Picker => "List of presets",
            Self::Question => "Question",
            Self::Help => "Help",
        }
    }

    /// Whether it is a list of presets.
    pub fn is_list(self) -> bool {
        matches!(self, Self::Picker | Self::Marks)
    }

    /// The contexts in which a key is looked up, the first that knows it wins.
    pub fn stack(self) -> &'static [Context] {
        use Context::{
            Accuracy, Clock, Dial, Doubt, Everywhere, Forces, Form, Help, Injury, Map, Marks,
            Number, Picker, Question, Replay, Replays, Table, Typing,
        };
        match self {
            Everywhere => &[Everywhere],
            Clock => &[Clock, Everywhere],
            Number => &[Number, Form, Clock, Everywhere],
            Form => &[Form, Clock, Everywhere],
            Dial => &[Dial, Clock, Everywhere],
            Replay => &[Replay, Clock, Everywhere],
            Forces => &[Forces, Clock, Everywhere],
            Marks => &[Marks, Everywhere],
            Table => &[Table, Clock, Everywhere],
            Replays => &[Replays, Clock, Everywhere],
            Accuracy => &[Accuracy, Everywhere],
            Doubt => &[Doubt, Everywhere],
            Map => &[Map, Everywhere],
            Injury => &[Injury, Everywhere],
            Typing => &[Typing],
            Picker => &[Picker],
            Question => &[Question],
            Help => &[Help],
        }
    }
}

/// One press of a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Press(KeyCode, KeyModifiers);

impl Press {
    /// Whether an event is this press. A capital comes with or without Shift.
    pub fn is(self, event: KeyEvent) -> bool {
        let modifiers = match event.code {
            KeyCode::Char(_) | KeyCode::BackTab => event.modifiers - KeyModifiers::SHIFT,
            _ => event.modifiers,
        };
        self.0 == event.code && self.1 == modifiers
    }

    /// How it is written for a person.
    pub fn name(self) -> String {
        let key = match self.0 {
            KeyCode::Char(' ') => "Space".to_owned(),
            KeyCode::Char(c) if self.1.contains(KeyModifiers::CONTROL) => {
                c.to_uppercase().to_string()
            }
            KeyCode::Char(c) => c.to_string(),
            KeyCode::F(n) => format!("F{n}"),
            KeyCode::Up => "↑".to_owned(),
            KeyCode::Down => "↓".to_owned(),
            KeyCode::Left => "←".to_owned(),
            KeyCode::Right => "→".to_owned(),
            KeyCode::BackTab => "Shift-Tab".to_owned(),
            KeyCode::PageUp => "PgUp".to_owned(),
            KeyCode::PageDown => "PgDn".to_owned(),
            other => format!("{other:?}"),
        };
        let mut name = String::new();
        if self.1.contains(KeyModifiers::CONTROL) {
            name += "Ctrl-";
        }
        if self.1.contains(KeyModifiers::ALT) {
            name += "Alt-";
        }
        if self.1.contains(KeyModifiers::SHIFT) {
            name += "Shift-";
        }
        name + &key
    }
}

/// A key or several with one meaning in one context.
pub struct Binding {
    /// Where.
    pub context: Context,
    /// Which keys; the first is shown.
    pub presses: &'static [Press],
    /// What for.
    pub action: Action,
    /// A word for the footer; empty where it has no place there, `&` where the word before goes for
    /// this key too.
    pub short: &'static str,
    /// A few words for the help.
    pub help: &'static str,
}

impl Binding {
    /// Its keys as they are written for a person; digits that all mean the same are one.
    pub fn names(&self) -> Vec<String> {
        let is_digit = |press: &&Press| matches!(press.0, KeyCode::Char('0'..='9'));
        let plain = |press: &&Press| is_digit(press) && press.1.is_empty();
        let digits = self.presses.iter().filter(plain).count() == 10;
        let mut names: Vec<String> = Vec::new();
        if digits {
            names.push("0-9".to_owned());
        }
        let rest = self.presses.iter().filter(|p| !(digits && plain(p)));
        names.extend(rest.map(|press| press.name()));
        names
    }
}

/// What a key means in a context.
pub fn action(context: Context, event: KeyEvent) -> Option<Action> {
    context.stack().iter().find_map(|context| {
        let mut own = BINDINGS.iter().filter(|b| b.context == *context);
        own.find(|b| b.presses.iter().any(|press| press.is(event)))
            .map(|binding| binding.action)
    })
}

/// What the footer may show in a context: keys and their word, the most needed first.
pub fn live(context: Context) -> Vec<(String, &'static str)> {
    let mut live: Vec<(u8, String, &'static str)> = Vec::new();
    let stack = context.stack();
    for (depth, place) in stack.iter().enumerate() {
        // What a nearer context has for itself is not on offer.
        let taken = |press: &Press| {
            let nearer = BINDINGS
                .iter()
                .filter(|b| stack[..depth].contains(&b.context));
            nearer.flat_map(|b| b.presses).any(|p| p == press)
        };
        for binding in BINDINGS.iter().filter(|b| b.context == *place) {
            let free = binding.presses.iter().position(|press| !taken(press));
            let Some(name) = free.and_then(|at| binding.names().into_iter().nth(at)) else {
                continue;
            };
            match (binding.short, live.last_mut()) {
                ("", _) => {}
                ("&", Some((_, names, _))) => names.push_str(&name),
                (word, _) => {
                    // In form and dial, time comes after everything else.
                    let aside = matches!(context, Context::Number | Context::Form | Context::Dial)
                        && *place == Context::Clock;
                    let late = aside && binding.action != Action::Play;
                    live.push((u8::from(late), name, word));
                }
            }
        }
    }
    if context == Context::Number {
        // Digits are taken, so it must be said how to leave the screen.
        live.insert(1, (0, format!("F1-{}", SCREENS.len()), "screen"));
        // What the arrows do comes first; Enter opens what a digit opens too.
        live.sort_by_key(|(late, _, word)| match *word {
            "field" | "value" => 0,
            "edit" => 3,
            _ => 1 + late,
        });
    } else {
        live.sort_by_key(|(late, ..)| *late);
    }
    live.into_iter()
        .map(|(_, names, word)| (names, word))
        .collect()
}

/// The table of keys for the guide: a heading and a block of text for each context.
pub fn markdown() -> String {
    use strum::IntoEnumIterator;
    let context = |context: Context| {
        let own = BINDINGS.iter().filter(|b| b.context == context);
        let rows = own.map(|b| format!("{:<15} {}\n", b.names().join(" "), b.help));
        let rows: String = rows.collect();
        format!("\n## {}\n\n```text\n{rows}```\n", context.title())
    };
    Context::iter().map(context).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tui::action::Step;
    use Context::{Everywhere, Form};
    use strum::IntoEnumIterator;

    #[test]
    fn no_key_means_two_things_in_one_context() {
        for context in Context::iter() {
            let mut seen = Vec::new();
            for binding in BINDINGS.iter().filter(|b| b.context == context) {
                assert!(!binding.help.is_empty());
                for press in binding.presses {
                    assert!(!seen.contains(press), "{context:?} {}", press.name());
                    seen.push(*press);
                }
            }
            assert!(!seen.is_empty(), "{context:?} has no keys");
        }
    }

    #[test]
    fn no_pane_hides_a_key_that_works_everywhere() {
        for context in Context::iter() {
            let shared: Vec<_> = BINDINGS
                .iter()
                .filter(|b| b.context == Everywhere)
                .collect();
            if context == Everywhere || !context.stack().contains(&Everywhere) {
                continue;
            }
            for own in BINDINGS.iter().filter(|b| b.context == context) {
                for press in own.presses {
                    // A digit is typed where a number is wanted; Alt and F keys do its work.
                    let typed = own.action == Action::Type;
                    let hidden = !typed && shared.iter().any(|b| b.presses.contains(press));
                    assert!(!hidden, "{context:?} {}", press.name());
                }
            }
        }
    }

    #[test]
    fn every_screen_can_be_reached_from_everywhere_by_one_press() {
        let panes = || SCREENS.iter().flat_map(|listed| listed.panes);
        let contexts = panes()
            .map(|(_, context)| *context)
            .chain([Context::Number]);
        for context in contexts {
            for (i, listed) in SCREENS.iter().enumerate() {
                let number = u8::try_from(i + 1).unwrap();
                let show = Some(Action::Show(listed.screen));
                let f = KeyEvent::new(KeyCode::F(number), KeyModifiers::NONE);
                let alt = KeyEvent::new(KeyCode::Char(listed.key), KeyModifiers::ALT);
                assert_eq!((action(context, f), action(context, alt)), (show, show));
                let digit = KeyEvent::from(KeyCode::Char(listed.key));
                let typed = context == Context::Number;
                let meant = if typed { Some(Action::Type) } else { show };
                assert_eq!(action(context, digit), meant, "{context:?}");
            }
        }
    }

    #[test]
    fn every_context_can_be_left_and_stopped() {
        let press = |letter| KeyEvent::new(KeyCode::Char(letter), KeyModifiers::CONTROL);
        for context in Context::iter() {
            assert_eq!(action(context, press('c')), Some(Action::Interrupt));
            assert_eq!(action(context, press('z')), Some(Action::Suspend));
        }
    }

    #[test]
    fn capitals_count_with_and_without_shift() {
        for modifiers in [KeyModifiers::NONE, KeyModifiers::SHIFT] {
            let event = KeyEvent::new(KeyCode::Char('H'), modifiers);
            assert_eq!(action(Form, event), Some(Action::Step(Step::MUCH_LESS)));
        }
    }
}
