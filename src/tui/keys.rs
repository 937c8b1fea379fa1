//! What a key is, what is said of it, and what it does.
//!
//! Whatever has keys lists them in [`KeyTable`]s, which dispatch, footer, help, guide and tests
//! read. Letters that are typed into a field are not in them.

pub mod chosen;
pub mod press;

use crossterm::event::KeyEvent;

use chosen::Keys;
use press::Press;

/// A key or several that do one thing, and what is said of them.
#[derive(Clone, Copy)]
pub struct Key {
    /// The keys; the first that nothing nearer has for itself is shown in the footer.
    pub presses: &'static [Press],
    /// A word for the footer; empty for none, `&` where the word before goes for this key too.
    pub short: &'static str,
    /// A few words for the help.
    pub help: &'static str,
    /// What a person calls it who wants other keys for it; empty where the keys stay.
    pub name: &'static str,
    /// Whether a value is typed that begins with the key itself.
    pub begins_value: bool,
}

/// Keys with what they do.
#[derive(Clone, Copy)]
pub struct Binding<A> {
    /// The keys.
    pub key: Key,
    /// What they do.
    pub act: A,
}

impl<A: Copy> Binding<A> {
    /// This binding with a name, by which the config file may give it other keys.
    #[must_use]
    pub const fn named(mut self, name: &'static str) -> Self {
        self.key.name = name;
        self
    }
}

impl Key {
    /// Keys that nobody may choose otherwise.
    pub const fn new(presses: &'static [Press], short: &'static str, help: &'static str) -> Self {
        Self { presses, short, help, name: "", begins_value: false }
    }

    /// Its presses as they are written for a person; digits that all mean the same are one.
    pub fn names(&self, keys: &Keys) -> Vec<String> {
        let presses = keys.of(self);
        let digits = presses.iter().filter(|press| press.is_digit()).count() == 10;
        let rest = presses.iter().filter(|press| !(digits && press.is_digit()));
        let digits = digits.then(|| "0-9".to_owned());
        digits.into_iter().chain(rest.map(|press| press.name())).collect()
    }
}

/// Keys that count at the same time and in the same place.
#[derive(Clone, Copy)]
pub struct KeyTable<A: 'static> {
    /// A heading for the help.
    pub title: &'static str,
    /// The keys, the most needed first.
    pub bindings: &'static [Binding<A>],
}

impl<A: Copy> KeyTable<A> {
    /// A table under this heading.
    pub const fn new(title: &'static str, bindings: &'static [Binding<A>]) -> Self {
        Self { title, bindings }
    }

    /// What an event does by this table, if it has the key.
    pub fn find(&self, keys: &Keys, event: KeyEvent) -> Option<&'static Binding<A>> {
        let has = |binding: &&Binding<A>| keys.of(&binding.key).iter().any(|p| p.is(event));
        self.bindings.iter().find(has)
    }

    /// Its keys, whatever they do.
    pub fn list(&self) -> KeyList {
        let keys = self.bindings.iter().map(|binding| &binding.key).collect();
        KeyList { title: self.title, keys }
    }
}

/// The keys of a table, whatever they do.
#[derive(Clone)]
pub struct KeyList {
    /// A heading for the help.
    pub title: &'static str,
    /// The keys, the most needed first.
    pub keys: Vec<&'static Key>,
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

/// Whether what is pasted now begins a value.
pub fn begins_value(stack: &[KeyList]) -> bool {
    stack.iter().flat_map(|list| &list.keys).any(|key| key.begins_value)
}

/// What the footer may show of the lists in which a key is looked up now: keys and their word, the
/// most needed first. The list with the title `late` comes last; so many screens can be shown.
pub fn footer_keys(
    stack: &[KeyList],
    keys: &Keys,
    late: Option<&str>,
    screens: usize,
) -> Vec<(String, &'static str)> {
    let mut live: Vec<(u8, String, &'static str)> = Vec::new();
    for (depth, list) in stack.iter().enumerate() {
        // What a nearer list has for itself is not on offer.
        let taken = |press: &Press| {
            let nearer = stack[..depth].iter().flat_map(|list| &list.keys);
            nearer.flat_map(|key| keys.of(key)).any(|p| p == press)
        };
        for key in &list.keys {
            let free = keys.of(key).iter().position(|press| !taken(press));
            let Some(name) = free.and_then(|at| key.names(keys).into_iter().nth(at)) else {
                continue;
            };
            match (key.short, live.last_mut()) {
                ("", _) => {}
                ("&", Some((_, names, _))) => names.push_str(&name),
                (word, _) => live.push((u8::from(late == Some(list.title)), name, word)),
            }
        }
    }
    if begins_value(stack) {
        // Digits are taken, so it must be said how to leave the screen.
        live.insert(1, (0, format!("F1-{screens}"), "screen"));
        // What the arrows do comes first; Enter opens what a digit opens too.
        live.sort_by_key(|(late, _, word)| match *word {
            "field" | "value" => 0,
            "edit" => 3,
            _ => 1 + late,
        });
    } else {
        live.sort_by_key(|(late, ..)| *late);
    }
    live.into_iter().map(|(_, names, word)| (names, word)).collect()
}

/// The lists as the guide shows them: a heading and a block of text for each.
pub fn markdown(lists: &[KeyList]) -> String {
    let keys = Keys::default();
    let row = |key: &&Key| format!("{:<15} {}\n", key.names(&keys).join(" "), key.help);
    let section = |list: &KeyList| {
        let rows: String = list.keys.iter().map(row).collect();
        format!("\n## {}\n\n```text\n{rows}```\n", list.title)
    };
    lists.iter().map(section).collect()
}
