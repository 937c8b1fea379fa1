//! RON to settings, each refusal with its place.
//!
//! The file is read as names and values of any kind; the table decides what a value means, so that all that is
//! wrong is told at once.

use std::fmt;

use ron::Value;
use serde::de::{self, Deserialize, Deserializer, MapAccess, Visitor};

use crate::plain_text::quoted;
use crate::scenario::locate::{is_blank, locate};
use crate::scenario::problem::{Problem, ScenarioError, suggestion};
use crate::scenario::ron_text;
use crate::scenario::ron_text::word_at;
use crate::tui::app::tables::{clash, open_to_choice};
use crate::tui::config::Config;
use crate::tui::config::table::{Kind, SETTINGS, Setting, USUAL, allowed_colours};
use crate::tui::keys::press::Press;
use crate::tui::view::palette::{ROLES, SIXTEEN};

const KEYS: &str = "keys";
const COLOURS: &str = "colours";

/// Reads a file's text.
pub fn read(text: &str) -> Result<Config, ScenarioError> {
    let mut config = Config::default();
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    if is_blank(text) {
        return Ok(config);
    }
    let Entries(entries) = ron_text::read(text, "")?;
    let mut problems = Vec::new();
    for (name, content) in &entries {
        let setting = SETTINGS.iter().find(|setting| setting.name == name);
        match (setting, content) {
            (Some(setting), _) => problems.extend(take(setting, &mut config, content, text)),
            (None, Content::Entries(keys)) if name == KEYS => {
                problems.extend(take_keys(&mut config, keys, text));
            }
            (None, Content::Entries(colours)) if name == COLOURS => {
                problems.extend(take_colours(&mut config, colours, text));
            }
            (None, _) if name == KEYS => {
                let allowed = "names and keys in brackets, as in (undo: \"Ctrl-X\")";
                problems.push(refused(text, KEYS, "is no such list", allowed.to_owned()));
            }
            (None, _) if name == COLOURS => {
                let allowed = "roles and colours in brackets, as in (heading: 80)";
                problems.push(refused(
                    text,
                    COLOURS,
                    "is no such list",
                    allowed.to_owned(),
                ));
            }
            (None, _) => {
                let names = SETTINGS
                    .iter()
                    .map(|setting| setting.name)
                    .chain([COLOURS, KEYS]);
                problems.push(unknown(text, name, "setting", names));
            }
        }
    }
    if let Some(clash) = clash(&config.keys).filter(|_| problems.is_empty()) {
        let path = format!("{KEYS}.{}", clash.name.to_lowercase());
        let (key, other) = (clash.press.name(), clash.other);
        let message =
            format!("{key:?} is taken by {other}: choose another key, or another one for that");
        let at = locate(text, &path);
        problems.push(Problem::new(path, message).at(at));
    }
    if problems.is_empty() {
        Ok(config)
    } else {
        Err(ScenarioError { problems })
    }
}

/// Takes a value in; or what is wrong with it.
fn take(setting: &Setting, config: &mut Config, content: &Content, text: &str) -> Option<Problem> {
    let complaint = match (&setting.kind, content) {
        (Kind::Word(words, place), Content::Value(Value::String(word))) => {
            match words().iter().position(|known| known == word) {
                Some(at) => {
                    (place.put)(config, at);
                    return None;
                }
                None => "is not known here",
            }
        }
        (Kind::Word(..), _) => "is not a word in quotes",
        (Kind::Whole(min, max, place), Content::Value(Value::Number(number))) => {
            let number = number.into_f64();
            if number.fract() != 0.0 {
                "is not a whole number"
            } else if (f64::from(*min)..=f64::from(*max)).contains(&number) {
                (place.put)(config, number as u8);
                return None;
            } else {
                "is out of range"
            }
        }
        (Kind::Whole(..), _) => "is not a whole number",
        (Kind::Toggle(place), Content::Value(Value::Bool(yes))) => {
            (place.put)(config, *yes);
            return None;
        }
        (Kind::Toggle(_), _) => "is neither true nor false",
    };
    Some(refused(text, setting.name, complaint, setting.allowed()))
}

/// Takes colours in; gives what is wrong with them.
fn take_colours(config: &mut Config, colours: &[(String, Content)], text: &str) -> Vec<Problem> {
    let mut problems = Vec::new();
    for (name, content) in colours {
        let path = format!("{COLOURS}.{name}");
        let Some(part) = ROLES.iter().find(|part| part.name == name) else {
            let names = ROLES.iter().map(|part| part.name);
            problems.push(unknown(text, &path, "role", names));
            continue;
        };
        let colour = match content {
            Content::Value(Value::String(word)) if word == USUAL => Some(None),
            Content::Value(Value::String(word)) => {
                let place = SIXTEEN.iter().position(|(name, _)| name == word);
                place.map(|place| Some(place as u8))
            }
            Content::Value(Value::Number(number)) => {
                let number = number.into_f64();
                let is_place = number.fract() == 0.0 && (0.0..=255.0).contains(&number);
                is_place.then_some(Some(number as u8))
            }
            _ => None,
        };
        match colour {
            Some(colour) => config.colours.choose(part.role, colour),
            None => problems.push(refused(text, &path, "is no such colour", allowed_colours())),
        }
    }
    problems
}

/// Takes keys in; gives what is wrong with them.
fn take_keys(config: &mut Config, keys: &[(String, Content)], text: &str) -> Vec<Problem> {
    let mut problems = Vec::new();
    for (name, content) in keys {
        let path = format!("{KEYS}.{name}");
        let Some(binding) = open_to_choice().find(|b| b.name.to_lowercase() == *name) else {
            let names: Vec<String> = open_to_choice().map(|b| b.name.to_lowercase()).collect();
            problems.push(unknown(
                text,
                &path,
                "name",
                names.iter().map(String::as_str),
            ));
            continue;
        };
        let written = match content {
            Content::Value(Value::String(key)) => Some(vec![key.as_str()]),
            Content::Value(Value::Seq(list)) => list
                .iter()
                .map(|key| match key {
                    Value::String(key) => Some(key.as_str()),
                    _ => None,
                })
                .collect(),
            _ => None,
        };
        let allowed = || "a key or a list of keys, as in \"Ctrl-X\"".to_owned();
        let presses = written.map(|keys| {
            let read = |key: &&str| Press::read(key).map_err(|why| (format!("{key:?}"), why));
            keys.iter().map(read).collect::<Result<Vec<_>, _>>()
        });
        match presses {
            Some(Ok(presses)) => config.keys.choose(binding, presses),
            Some(Err((key, why))) => {
                let at = locate(text, &path);
                problems.push(Problem::refused(&path, &key, why, allowed()).at(at));
            }
            None => problems.push(refused(text, &path, "is no key in quotes", allowed())),
        }
    }
    problems
}

fn refused(text: &str, path: &str, complaint: &str, allowed: String) -> Problem {
    let at = locate(text, path);
    Problem::refused(path, word_at(text, at), complaint, allowed).at(at)
}

fn unknown<'a>(
    text: &str,
    path: &str,
    what: &str,
    names: impl Iterator<Item = &'a str> + Clone,
) -> Problem {
    let near = suggestion(path.rsplit('.').next().unwrap_or(path), names.clone());
    let allowed = names.collect::<Vec<_>>().join(", ");
    Problem {
        value: Some(quoted(path)),
        message: format!("there is no such {what}{near} (allowed: {allowed})"),
        allowed: Some(allowed),
        ..Problem::new(path, "")
    }
    .at(locate(text, path))
}

/// What stands in brackets, in its order.
struct Entries(Vec<(String, Content)>);

/// A value, or what stands in brackets.
enum Content {
    Value(Value),
    Entries(Vec<(String, Content)>),
}

/// Takes either in.
struct Either;

impl<'de> Visitor<'de> for Either {
    type Value = Content;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str("a value, or names and values in brackets")
    }

    fn visit_bool<E>(self, value: bool) -> Result<Content, E> {
        Ok(Content::Value(Value::Bool(value)))
    }

    fn visit_i64<E>(self, value: i64) -> Result<Content, E> {
        Ok(Content::Value(Value::from(value)))
    }

    fn visit_u64<E>(self, value: u64) -> Result<Content, E> {
        Ok(Content::Value(Value::from(value)))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Content, E> {
        Ok(Content::Value(Value::from(value)))
    }

    fn visit_str<E>(self, value: &str) -> Result<Content, E> {
        Ok(Content::Value(Value::String(value.to_owned())))
    }

    fn visit_unit<E>(self) -> Result<Content, E> {
        Ok(Content::Entries(Vec::new()))
    }

    fn visit_none<E>(self) -> Result<Content, E> {
        Ok(Content::Value(Value::Option(None)))
    }

    fn visit_seq<A: de::SeqAccess<'de>>(self, mut seq: A) -> Result<Content, A::Error> {
        let mut list = Vec::new();
        while let Some(value) = seq.next_element()? {
            list.push(value);
        }
        Ok(Content::Value(Value::Seq(list)))
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Content, A::Error> {
        let mut entries: Vec<(String, Content)> = Vec::new();
        while let Some((name, content)) = map.next_entry::<String, Content>()? {
            if entries.iter().any(|(known, _)| *known == name) {
                return Err(de::Error::custom(format!("{name}: is given twice")));
            }
            entries.push((name, content));
        }
        Ok(Content::Entries(entries))
    }
}

impl<'de> Deserialize<'de> for Content {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(Either)
    }
}

impl<'de> Deserialize<'de> for Entries {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        match Content::deserialize(deserializer)? {
            Content::Entries(entries) => Ok(Self(entries)),
            Content::Value(_) => Err(de::Error::custom("expected `(`")),
        }
    }
}
