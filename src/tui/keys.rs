//! What a key is, where it counts, and what it does there.
//!
//! A pane lists its keys in [`KeyTable`]s, each key with what it does; what counts on every screen
//! and in front of them is in [`shared`]. Dispatch, footer, help, the guide's table and the test of
//! uniqueness all read these tables. Letters that are typed into a field are not in them; see
//! `update`.

pub mod chosen;
pub mod shared;

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use crate::tui::model::Model;
use crate::tui::screens::SCREENS;
use chosen::Keys;

/// One press of a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Press(KeyCode, KeyModifiers);

/// The press of a key alone.
pub const fn plain(code: KeyCode) -> Press {
    Press(code, KeyModifiers::NONE)
}

/// The press of a character.
pub const fn c(c: char) -> Press {
    plain(KeyCode::Char(c))
}

/// A character with Control.
pub const fn ctrl(c: char) -> Press {
    Press(KeyCode::Char(c), KeyModifiers::CONTROL)
}

/// A character with Alt.
pub const fn alt(c: char) -> Press {
    Press(KeyCode::Char(c), KeyModifiers::ALT)
}

/// A key with Shift.
pub const fn shift(code: KeyCode) -> Press {
    Press(code, KeyModifiers::SHIFT)
}

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

/// What a key does.
#[derive(Clone, Copy)]
pub enum Act {
    /// Changes the model so.
    Run(fn(&mut Model)),
    /// Shows the screen of this place in the list.
    Show(usize),
    /// Begins to type with the key itself.
    Type,
}

/// A key or several that do one thing.
#[derive(Clone, Copy)]
pub struct Binding {
    /// The keys; the first that nothing nearer has for itself is shown in the footer.
    pub presses: &'static [Press],
    /// What they do.
    pub act: Act,
    /// A word for the footer; empty where it has no place there, `&` where the word before goes for
    /// this key too.
    pub short: &'static str,
    /// A few words for the help.
    pub help: &'static str,
    /// What a person calls it who wants other keys for it; empty where the keys stay.
    pub name: &'static str,
}

/// A key that changes the model.
pub const fn bind(
    presses: &'static [Press],
    run: fn(&mut Model),
    short: &'static str,
    help: &'static str,
) -> Binding {
    Binding {
        presses,
        act: Act::Run(run),
        short,
        help,
        name: "",
    }
}

/// The same, for which a person may choose other keys by this name.
pub const fn named(name: &'static str, binding: Binding) -> Binding {
    Binding { name, ..binding }
}

impl Binding {
    /// Its keys as they are written for a person; digits that all mean the same are one.
    pub fn names(&self, keys: &Keys) -> Vec<String> {
        let presses = keys.of(self);
        let is_digit = |press: &&Press| matches!(press.0, KeyCode::Char('0'..='9'));
        let plain = |press: &&Press| is_digit(press) && press.1.is_empty();
        let digits = presses.iter().filter(plain).count() == 10;
        let mut names: Vec<String> = Vec::new();
        if digits {
            names.push("0-9".to_owned());
        }
        let rest = presses.iter().filter(|p| !(digits && plain(p)));
        names.extend(rest.map(|press| press.name()));
        names
    }
}

/// Keys that count at the same time and in the same place.
#[derive(Clone, Copy)]
pub struct KeyTable {
    /// A heading for the help.
    pub title: &'static str,
    /// The keys, the most needed first.
    pub bindings: &'static [Binding],
    /// Whether they count now, where their pane has the focus.
    pub counts: fn(&Model) -> bool,
}

impl KeyTable {
    /// Keys that always count where they stand.
    pub const fn new(title: &'static str, bindings: &'static [Binding]) -> Self {
        Self {
            title,
            bindings,
            counts: |_| true,
        }
    }

    fn find(&self, keys: &Keys, event: KeyEvent) -> Option<&'static Binding> {
        let means = |binding: &&Binding| keys.of(binding).iter().any(|press| press.is(event));
        self.bindings.iter().find(means)
    }

    /// Whether a key of it begins a value.
    fn types(&self) -> bool {
        self.bindings.iter().any(|b| matches!(b.act, Act::Type))
    }
}

/// Where the keys of time stand in a pane.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum TimeKeys {
    /// Nowhere.
    Absent,
    /// Before the keys that count everywhere.
    Early,
    /// After them in the footer.
    Late,
}

/// The tables in which a key is looked up now, the first that knows it wins.
pub fn stack(model: &Model) -> Vec<&'static KeyTable> {
    if let Some(table) = shared::in_front(model) {
        return vec![table];
    }
    let pane = model.focus();
    let mut stack: Vec<_> = pane.keys.iter().filter(|t| (t.counts)(model)).collect();
    if pane.time != TimeKeys::Absent {
        stack.push(&shared::TIME);
    }
    stack.extend([&shared::EVERYWHERE, &shared::SHOW]);
    stack
}

/// What a key does now.
pub fn find(model: &Model, event: KeyEvent) -> Option<Act> {
    let mut tables = stack(model).into_iter();
    tables.find_map(|table| Some(table.find(&model.keys, event)?.act))
}

/// Whether what is pasted now begins a value.
pub fn begins_value(model: &Model) -> bool {
    stack(model).iter().any(|table| table.types())
}

/// Every table, in the order of the help.
pub fn tables() -> Vec<&'static KeyTable> {
    let panes = SCREENS.iter().flat_map(|screen| screen.panes);
    let mut tables = vec![&shared::EVERYWHERE, &shared::SHOW, &shared::TIME];
    tables.extend(panes.flat_map(|pane| pane.keys));
    tables.extend(shared::IN_FRONT);
    tables
}

/// What the footer may show now: keys and their word, the most needed first.
pub fn live(model: &Model) -> Vec<(String, &'static str)> {
    let mut live: Vec<(u8, String, &'static str)> = Vec::new();
    let (stack, keys) = (stack(model), &model.keys);
    let late_time = model.focus().time == TimeKeys::Late;
    for (depth, table) in stack.iter().enumerate() {
        // What a nearer table has for itself is not on offer.
        let taken = |press: &Press| {
            let nearer = stack[..depth].iter().flat_map(|table| table.bindings);
            nearer.flat_map(|b| keys.of(b)).any(|p| p == press)
        };
        let is_time = table.title == shared::TIME.title;
        for binding in table.bindings {
            let free = keys.of(binding).iter().position(|press| !taken(press));
            let Some(name) = free.and_then(|at| binding.names(keys).into_iter().nth(at)) else {
                continue;
            };
            // Where there is one pane there is no next one.
            let alone = binding.short == "pane" && model.on_show().panes.len() < 2;
            match (binding.short, live.last_mut()) {
                ("", _) => {}
                _ if alone => {}
                ("&", Some((_, names, _))) => names.push_str(&name),
                (word, _) => {
                    let late = late_time && is_time;
                    live.push((u8::from(late), name, word));
                }
            }
        }
    }
    if begins_value(model) {
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
    let keys = Keys::default();
    let section = |table: &KeyTable| {
        let own = table.bindings.iter();
        let rows = own.map(|b| format!("{:<15} {}\n", b.names(&keys).join(" "), b.help));
        let rows: String = rows.collect();
        format!("\n## {}\n\n```text\n{rows}```\n", table.title)
    };
    tables().into_iter().map(section).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tui::form::Row;
    use crate::tui::model::{Naming, Overlay, Question};
    use crate::tui::picker::Picker;
    use crate::tui::update::driven::opened;
    use crate::tui::update::{Effect, Message, update};

    /// A model for every pane, one on a row that takes numbers, and one for every overlay.
    fn every_place() -> Vec<Model> {
        let mut models = Vec::new();
        for (index, screen) in SCREENS.iter().enumerate() {
            for pane in 0..screen.panes.len() {
                let mut model = opened();
                model.screen = index;
                model.show_pane(pane);
                models.push(model);
            }
        }
        let mut model = opened();
        let force = crate::scenario::fields::find("impact.force_n").unwrap();
        model.form.selected = Row::Field(force);
        models.push(model);
        for overlay in [
            Overlay::Help(0),
            Overlay::Picker(Picker::default()),
            Overlay::Name(Naming::Save, crate::tui::line::Line::default(), None),
            Overlay::Question(Question::Quit { kept: false }),
        ] {
            let mut model = opened();
            model.overlay = Some(overlay);
            models.push(model);
        }
        models
    }

    #[test]
    fn no_key_means_two_things_in_one_table() {
        for table in tables() {
            let mut seen = Vec::new();
            for binding in table.bindings {
                assert!(!binding.help.is_empty());
                for press in binding.presses {
                    assert!(!seen.contains(press), "{} {}", table.title, press.name());
                    seen.push(*press);
                }
            }
            assert!(!seen.is_empty(), "{} has no keys", table.title);
        }
    }

    #[test]
    fn no_pane_hides_a_key_that_works_everywhere() {
        let shared = || {
            shared::EVERYWHERE
                .bindings
                .iter()
                .chain(shared::SHOW.bindings)
        };
        let panes = SCREENS.iter().flat_map(|screen| screen.panes);
        for table in panes.flat_map(|pane| pane.keys).chain([&shared::TIME]) {
            for own in table.bindings {
                for press in own.presses {
                    // A digit is typed where a number is wanted; Alt and F keys do its work.
                    let typed = matches!(own.act, Act::Type);
                    let hidden = !typed && shared().any(|b| b.presses.contains(press));
                    assert!(!hidden, "{} {}", table.title, press.name());
                }
            }
        }
    }

    #[test]
    fn every_screen_can_be_reached_from_every_pane_by_one_press() {
        for place in 0..every_place().len() {
            for (i, number) in (1..=SCREENS.len()).enumerate() {
                let f = KeyEvent::from(KeyCode::F(u8::try_from(number).unwrap()));
                let digit = KeyCode::Char(char::from_digit(number as u32, 10).unwrap());
                let alt = KeyEvent::new(digit, KeyModifiers::ALT);
                for event in [f, alt, KeyEvent::from(digit)] {
                    let mut model = every_place().swap_remove(place);
                    if model.overlay.is_some() {
                        continue;
                    }
                    // In the form a digit is a value, or nothing.
                    let kept = begins_value(&model) && event == KeyEvent::from(digit);
                    let typed = kept && model.form.takes_numbers();
                    update(&mut model, Message::Key(event));
                    assert_eq!(model.screen, if kept { 0 } else { i }, "{i} from {place}");
                    assert_eq!(model.form.typing.is_some(), typed);
                }
            }
        }
    }

    #[test]
    fn every_place_can_be_left_and_stopped() {
        let press = |letter| KeyEvent::new(KeyCode::Char(letter), KeyModifiers::CONTROL);
        for mut model in every_place() {
            let effects = update(&mut model, Message::Key(press('c')));
            assert!(effects.contains(&Effect::Quit(130)));
            let effects = update(&mut model, Message::Key(press('z')));
            assert!(effects.contains(&Effect::Suspend));
        }
    }

    #[test]
    fn capitals_count_with_and_without_shift() {
        for modifiers in [KeyModifiers::NONE, KeyModifiers::SHIFT] {
            let event = KeyEvent::new(KeyCode::Char('H'), modifiers);
            assert!(c('H').is(event) && !c('h').is(event));
        }
    }
}
