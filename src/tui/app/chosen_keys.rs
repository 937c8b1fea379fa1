//! A person's own keys as the config file writes them: by the names of what they do.

use std::fmt;
use std::sync::LazyLock;

use ron::Value;
use serde::de::{Error, MapAccess, Unexpected, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use crate::tui::{app::tables::open_to_choice, keys::Key, keys::chosen::Keys, keys::press::Press};

/// What a config file calls them, in the same order.
static NAMES: LazyLock<Vec<&'static str>> =
    LazyLock::new(|| open_to_choice().map(|key| &*key.name.to_lowercase().leak()).collect());

/// What a config file calls so.
pub fn named(name: &str) -> Option<&'static Key> {
    open_to_choice().nth(NAMES.iter().position(|known| *known == name)?)
}

impl Serialize for Keys {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let presses = |key: &'static Key| self.of(key).iter().map(|press| press.name());
        let all = NAMES.iter().zip(open_to_choice());
        serializer.collect_map(all.map(|(name, key)| (name, presses(key).collect::<Vec<_>>())))
    }
}

impl<'de> Deserialize<'de> for Keys {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_struct("Keys", &NAMES, ByName)
    }
}

struct ByName;

impl<'de> Visitor<'de> for ByName {
    type Value = Keys;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("names and keys in brackets")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Keys, A::Error> {
        let mut keys = Keys::default();
        while let Some(name) = map.next_key::<String>()? {
            let key = named(&name).ok_or_else(|| A::Error::unknown_field(&name, &NAMES))?;
            if keys.has(key) {
                return Err(A::Error::custom(format!("{name} is given twice")));
            }
            let Presses(presses) = map.next_value()?;
            keys.choose(key, presses);
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
            _ => Err(D::Error::invalid_value(Unexpected::Other("value"), &"a key")),
        };
        list.into_iter().map(read).collect::<Result<_, _>>().map(Self)
    }
}
