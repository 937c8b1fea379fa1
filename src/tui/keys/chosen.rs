//! Keys of a person's own choice, for what counts on every screen.
//!
//! A chosen key takes the place of the usual ones. One that means something else already, on every screen
//! or in one pane, is refused with the name of what has it, so that no key ever means two things.
//!
//! Left out: the keys of single panes, of popups and of typing, which stay as they are.

use std::fmt;
use std::sync::LazyLock;

use crossterm::event::{KeyCode, KeyModifiers};
use ron::Value;
use serde::de::{Error, MapAccess, Unexpected, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::tui::keys::{Act, Binding, KeyTable, Press, shared};
use crate::tui::screens::SCREENS;

/// What was chosen, by the names of the bindings.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Keys(Vec<(&'static str, Vec<Press>)>);

/// The tables whose named bindings may have other keys.
const TABLES: [&KeyTable; 3] = [&shared::EVERYWHERE, &shared::SHOW, &shared::TIME];

/// Everything that may have other keys.
pub fn open_to_choice() -> impl Iterator<Item = &'static Binding> {
    let all = TABLES.iter().flat_map(|table| table.bindings);
    all.filter(|binding| !binding.name.is_empty())
}

/// What a config file calls them, in the same order.
static NAMES: LazyLock<Vec<&'static str>> = LazyLock::new(|| {
    let names = open_to_choice().map(|binding| binding.name.to_lowercase());
    names.map(|name| &*name.leak()).collect()
});

/// What a config file calls so.
pub fn named(name: &str) -> Option<&'static Binding> {
    open_to_choice().nth(NAMES.iter().position(|known| *known == name)?)
}

impl Serialize for Keys {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let keys = |binding| self.of(binding).iter().map(|press| press.name());
        let all = NAMES.iter().zip(open_to_choice());
        serializer.collect_map(all.map(|(name, binding)| (name, keys(binding).collect::<Vec<_>>())))
    }
}

impl<'de> Deserialize<'de> for Keys {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_struct("Keys", &NAMES, ByName)
    }
}

/// Reads keys by the names of what they do.
struct ByName;

impl<'de> Visitor<'de> for ByName {
    type Value = Keys;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("names and keys in brackets")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Keys, A::Error> {
        let mut keys = Keys::default();
        while let Some(name) = map.next_key::<String>()? {
            let binding = named(&name).ok_or_else(|| A::Error::unknown_field(&name, &NAMES))?;
            if keys.0.iter().any(|(known, _)| *known == binding.name) {
                return Err(A::Error::custom(format!("{name} is given twice")));
            }
            let Presses(presses) = map.next_value()?;
            keys.choose(binding, presses);
        }
        Ok(keys)
    }
}

/// A key, or a list of keys.
struct Presses(Vec<Press>);

impl<'de> Deserialize<'de> for Presses {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let list = match Value::deserialize(deserializer)? {
            Value::Seq(list) => list,
            one => vec![one],
        };
        let read = |key: Value| match key {
            Value::String(key) => Press::read(&key).map_err(|why| {
                D::Error::custom(format!(
                    "{key:?} {why}: allowed a key or a list of keys, as in \"Ctrl-X\""
                ))
            }),
            _ => Err(D::Error::invalid_value(
                Unexpected::Other("value"),
                &"a key",
            )),
        };
        list.into_iter()
            .map(read)
            .collect::<Result<_, _>>()
            .map(Self)
    }
}

/// A key that two things would share.
#[derive(Debug, PartialEq, Eq)]
pub struct Clash {
    /// What it was chosen for.
    pub name: &'static str,
    /// The key.
    pub press: Press,
    /// What has it already.
    pub other: String,
}

impl Keys {
    /// The keys of a binding.
    pub fn of<'a>(&'a self, binding: &'a Binding) -> &'a [Press] {
        let own = self.0.iter().find(|(name, _)| *name == binding.name);
        own.map_or(binding.presses, |(_, presses)| presses)
    }

    /// Chooses the keys of a binding that has a name.
    pub fn choose(&mut self, binding: &Binding, presses: Vec<Press>) {
        self.0.retain(|(name, _)| *name != binding.name);
        if presses != binding.presses {
            self.0.push((binding.name, presses));
        }
    }

    /// The first key that two things would share. A usual key may: the nearer thing has it.
    pub fn clash(&self) -> Option<Clash> {
        self.0.iter().find_map(|(name, presses)| {
            let usual = open_to_choice().find(|binding| binding.name == *name)?;
            let mut new = presses.iter().filter(|p| !usual.presses.contains(p));
            new.find_map(|press| {
                let other = self.holder(name, *press)?;
                Some(Clash {
                    name,
                    press: *press,
                    other,
                })
            })
        })
    }

    /// What else has a key, in the words of the help.
    fn holder(&self, name: &str, press: Press) -> Option<String> {
        let panes = SCREENS.iter().flat_map(|screen| screen.panes);
        let tables = TABLES
            .into_iter()
            .chain(panes.flat_map(|pane| pane.keys).filter(|table| {
                // A digit is typed where a number is wanted; there Alt and F keys do its work.
                !table.bindings.iter().any(|b| matches!(b.act, Act::Type))
            }));
        let mut all = tables.flat_map(|table| table.bindings.iter().map(move |b| (table, b)));
        let (table, binding) =
            all.find(|(_, binding)| binding.name != name && self.of(binding).contains(&press))?;
        Some(match binding.name {
            "" => format!("\"{}\" ({})", binding.help, table.title),
            other => format!("`{}` ({})", other.to_lowercase(), binding.help),
        })
    }
}

impl Press {
    /// The key that is written like this: `Ctrl-Z`, `Alt-x`, `Shift-Up`, `F5`, `Space`, `U`.
    ///
    /// # Errors
    /// Says why no terminal sends it.
    pub fn read(written: &str) -> Result<Self, &'static str> {
        let mut modifiers = KeyModifiers::NONE;
        let mut rest = written.trim();
        let prefixes = [
            ("ctrl-", KeyModifiers::CONTROL),
            ("alt-", KeyModifiers::ALT),
            ("shift-", KeyModifiers::SHIFT),
        ];
        while let Some((prefix, modifier)) = prefixes.iter().find(|(prefix, _)| {
            let head = rest.get(..prefix.len());
            rest.len() > prefix.len() && head.is_some_and(|head| head.eq_ignore_ascii_case(prefix))
        }) {
            modifiers |= *modifier;
            rest = &rest[prefix.len()..];
        }
        let code = code(rest).ok_or("is no key")?;
        let control = modifiers.contains(KeyModifiers::CONTROL);
        let shift = modifiers.contains(KeyModifiers::SHIFT);
        match code {
            // A terminal sends one byte for both.
            KeyCode::Char('i' | 'I' | 'm' | 'M' | 'j' | 'J' | 'h' | 'H' | '[') if control => {
                Err("is the same to a terminal as Tab, Enter, Backspace or Esc")
            }
            KeyCode::Char(_) if shift => Err("is written as the capital letter"),
            KeyCode::Tab if shift => Ok(Self(KeyCode::BackTab, modifiers - KeyModifiers::SHIFT)),
            KeyCode::Char(c) if control => {
                Ok(Self(KeyCode::Char(c.to_ascii_lowercase()), modifiers))
            }
            code => Ok(Self(code, modifiers)),
        }
    }
}

fn code(word: &str) -> Option<KeyCode> {
    let mut chars = word.chars();
    if let (Some(c), None) = (chars.next(), chars.next()) {
        return match c {
            '↑' => Some(KeyCode::Up),
            '↓' => Some(KeyCode::Down),
            '←' => Some(KeyCode::Left),
            '→' => Some(KeyCode::Right),
            c => (!c.is_control() && c != ' ').then_some(KeyCode::Char(c)),
        };
    }
    let words = [
        ("space", KeyCode::Char(' ')),
        ("up", KeyCode::Up),
        ("down", KeyCode::Down),
        ("left", KeyCode::Left),
        ("right", KeyCode::Right),
        ("home", KeyCode::Home),
        ("end", KeyCode::End),
        ("pgup", KeyCode::PageUp),
        ("pgdn", KeyCode::PageDown),
        ("tab", KeyCode::Tab),
        ("enter", KeyCode::Enter),
        ("esc", KeyCode::Esc),
        ("backspace", KeyCode::Backspace),
        ("delete", KeyCode::Delete),
        ("insert", KeyCode::Insert),
    ];
    let lower = word.to_ascii_lowercase();
    let named = words.iter().find(|(name, _)| *name == lower);
    let function = || {
        let number: u8 = lower.strip_prefix('f')?.parse().ok()?;
        (1..=12).contains(&number).then_some(KeyCode::F(number))
    };
    named.map(|(_, code)| *code).or_else(function)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tui::keys::{live, tables};
    use crate::tui::update::driven::{letter, opened};
    use crate::tui::update::{Message, update};
    use crossterm::event::KeyEvent;

    fn binding(name: &str) -> &'static Binding {
        open_to_choice().find(|b| b.name == name).unwrap()
    }

    fn chosen(name: &str, key: &str) -> Option<String> {
        let mut keys = Keys::default();
        keys.choose(binding(name), vec![Press::read(key).unwrap()]);
        keys.clash().map(|clash| clash.other)
    }

    #[test]
    fn every_key_reads_back_from_how_it_is_written() {
        let named = |press: &Press| {
            let name = press.name();
            assert_eq!(Press::read(&name), Ok(*press), "{name}");
        };
        for table in tables() {
            table
                .bindings
                .iter()
                .flat_map(|b| b.presses)
                .for_each(named);
        }
        for wrong in [
            "", "Ctrl-", "Hyper-x", "F13", "F0", "xy", "Ctrl-i", "Shift-a",
        ] {
            assert!(Press::read(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn names_differ() {
        let names: Vec<_> = open_to_choice().map(|b| b.name.to_lowercase()).collect();
        for (i, name) in names.iter().enumerate() {
            assert!(!names[..i].contains(name), "{name}");
        }
        assert!(names.len() > 20);
    }

    #[test]
    fn a_key_that_is_taken_is_refused_by_the_name_of_what_has_it() {
        assert_eq!(chosen("undo", "Ctrl-X"), None);
        assert_eq!(chosen("undo", "u"), None);
        assert_eq!(
            chosen("undo", "s").unwrap(),
            "`save` (save as a preset of your own)"
        );
        assert!(chosen("undo", "Ctrl-C").unwrap().contains("leave at once"));
        assert!(
            chosen("undo", "a")
                .unwrap()
                .contains("advanced fields\" (Form)")
        );
        assert!(chosen("undo", "3").unwrap().starts_with("`forces`"));
    }

    #[test]
    fn a_chosen_key_does_it_and_is_shown_and_the_usual_one_no_longer() {
        let mut model = opened();
        model
            .keys
            .choose(binding("help"), vec![Press::read("Ctrl-X").unwrap()]);
        letter(&mut model, '?');
        assert!(model.overlay.is_none());
        assert!(live(&model).contains(&("Ctrl-X".to_owned(), "keys")));
        let press = KeyEvent::new(KeyCode::Char('x'), KeyModifiers::CONTROL);
        update(&mut model, Message::Key(press));
        assert!(model.overlay.is_some());
    }

    #[test]
    fn what_gave_its_key_away_may_be_followed() {
        let mut keys = Keys::default();
        keys.choose(binding("save"), vec![Press::read("W").unwrap()]);
        keys.choose(binding("undo"), vec![Press::read("s").unwrap()]);
        assert_eq!(keys.clash(), None);
    }
}
