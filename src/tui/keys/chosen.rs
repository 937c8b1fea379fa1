//! Keys of a person's own choice, for what counts on every screen.
//!
//! A chosen key takes the place of the usual ones. One that means something else already is
//! refused with the name of what has it. Those of panes, popups and typing stay as they are.

use crossterm::event::{KeyCode, KeyModifiers};

use crate::tui::keys::press::{HELD, NAMED, Press};
use crate::tui::keys::{Key, KeyList};

/// What was chosen, by the names of the bindings.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Keys(Vec<(&'static str, Vec<Press>)>);

impl Keys {
    /// The presses of a key.
    pub fn of<'a>(&'a self, key: &'a Key) -> &'a [Press] {
        let own = self.0.iter().find(|(name, _)| *name == key.name);
        own.map_or(key.presses, |(_, presses)| presses)
    }

    /// Whether presses were chosen for a key.
    pub fn has(&self, key: &Key) -> bool {
        self.0.iter().any(|(name, _)| *name == key.name)
    }

    /// Chooses the presses of a key that has a name.
    pub fn choose(&mut self, key: &Key, presses: Vec<Press>) {
        self.0.retain(|(name, _)| *name != key.name);
        if presses != key.presses {
            self.0.push((key.name, presses));
        }
    }

    /// The first key that was chosen though something else has it, on every screen or in a pane:
    /// what for, the key and what has it. A usual one may be shared: the nearer thing has it.
    pub fn clash(
        &self,
        everywhere: &[KeyList],
        panes: &[KeyList],
    ) -> Option<(&'static str, Press, String)> {
        self.0.iter().find_map(|(name, presses)| {
            let mut keys = everywhere.iter().flat_map(|list| &list.keys);
            let usual = keys.find(|key| key.name == *name)?;
            presses.iter().filter(|p| !usual.presses.contains(p)).find_map(|press| {
                // A digit is typed where a number is wanted; there Alt and F keys do its work.
                let typed = |list: &&KeyList| list.keys.iter().any(|key| key.begins_value);
                let own = panes.iter().filter(|list| !typed(list));
                let other = self.holder(name, *press, everywhere.iter().chain(own))?;
                Some((*name, *press, other))
            })
        })
    }

    /// What else has a press, in the words of the help.
    fn holder<'a>(
        &self,
        name: &str,
        press: Press,
        lists: impl Iterator<Item = &'a KeyList>,
    ) -> Option<String> {
        let mut all = lists.flat_map(|list| list.keys.iter().map(move |key| (list, key)));
        let (list, key) = all.find(|(_, key)| key.name != name && self.of(key).contains(&press))?;
        Some(match key.name {
            "" => format!("\"{}\" ({})", key.help, list.title),
            other => format!("`{}` ({})", other.to_lowercase(), key.help),
        })
    }
}

impl Press {
    /// The key that is written like `Ctrl-Z`, `Shift-Up`, `F5` or `U`, or why no terminal sends it.
    pub(crate) fn read(written: &str) -> Result<Self, &'static str> {
        let mut modifiers = KeyModifiers::NONE;
        let mut rest = written.trim();
        while let Some((prefix, modifier)) = HELD.iter().find(|(prefix, _)| {
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
    if let Some((_, code)) = NAMED.iter().find(|(name, _)| name.eq_ignore_ascii_case(word)) {
        return Some(*code);
    }
    if let (Some(c), None) = (chars.next(), chars.next()) {
        return (!c.is_control() && c != ' ').then_some(KeyCode::Char(c));
    }
    let number: u8 = word.strip_prefix(['f', 'F'])?.parse().ok()?;
    (1..=12).contains(&number).then_some(KeyCode::F(number))
}
