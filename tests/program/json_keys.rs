//! The JSON of a run is what `contrecoup guide json` says: no key more, none less, of its type.

use std::collections::BTreeMap;

use serde_json::{Map, Value};

use contrecoup::guide::TOPICS;
use contrecoup::injury::Injury;
use contrecoup::run::quantity::Quantity;
use contrecoup::scenario::{Scenario, library, set::set};

use crate::program::json;

/// One key of the guide.
struct Key {
    kind: String,
    when: String,
}

/// The keys of the guide by the part of the object that holds them; no name is the object itself.
fn documented() -> BTreeMap<String, BTreeMap<String, Key>> {
    let page = TOPICS.iter().find(|topic| topic.name == "json").unwrap().page;
    let mut parts: BTreeMap<String, BTreeMap<String, Key>> = BTreeMap::new();
    let mut part = None;
    for line in page.lines() {
        if line == "The object" {
            part = Some(String::new());
        } else if let Some(of) = line.strip_prefix("In ") {
            part = Some(of.split(':').next().unwrap().to_owned());
        } else if let (Some(part), Some(entry)) = (&part, line.strip_prefix("  ")) {
            let [key, kind, when] = entry.split_whitespace().collect::<Vec<_>>()[..3] else {
                panic!("{line}")
            };
            let key_of = Key { kind: kind.to_owned(), when: when.to_owned() };
            let twice = parts.entry(part.clone()).or_default().insert(key.to_owned(), key_of);
            assert!(twice.is_none(), "{key} stands twice");
        }
    }
    parts
}

fn kind(value: &Value) -> &'static str {
    match value {
        Value::Null => "null",
        Value::Bool(_) => "yes/no",
        Value::Number(_) => "number",
        Value::String(_) => "text",
        Value::Array(_) => "list",
        Value::Object(_) => "object",
    }
}

/// What holds of a scene, in the words of the guide.
fn holds(scenario: &Scenario, when: &str) -> Option<bool> {
    Some(match when {
        "all" => true,
        "cells" => scenario.physiological().is_some(),
        "paper" => scenario.physiological().is_none(),
        "object" => scenario.projectile().is_some(),
        "3d" => scenario.is_spatial(),
        "maybe" => return None,
        other => panic!("{other}"),
    })
}

/// Checks one part of the object; `inner` are keys whose own content is another part.
fn check(keys: &BTreeMap<String, Key>, of: &Map<String, Value>, scene: (&Scenario, &str)) {
    let (scenario, name) = scene;
    let mut found: BTreeMap<String, &Value> = BTreeMap::new();
    for (key, value) in of {
        let inner = |inner: &String| format!("{key}.{inner}");
        let within = value.as_object().filter(|object| {
            object.keys().any(|within| keys.contains_key(&format!("{key}.{within}")))
        });
        found.extend(within.into_iter().flatten().map(|(key, value)| (inner(key), value)));
        // A key whose members alone are listed.
        if within.is_none() || keys.contains_key(key) {
            found.insert(key.clone(), value);
        }
    }
    for (key, value) in &found {
        let known = keys.get(key).unwrap_or_else(|| panic!("{name}: {key} is not in the guide"));
        let (wanted, nullable) = match known.kind.strip_suffix('?') {
            Some(wanted) => (wanted, true),
            None => (known.kind.as_str(), false),
        };
        let is = kind(value);
        assert!(is == wanted || nullable && is == "null", "{name}: {key} is {is}");
    }
    for (key, known) in keys {
        if let Some(there) = holds(scenario, &known.when) {
            assert_eq!(found.contains_key(key), there, "{name}: {key}");
        }
    }
}

/// Checks a whole object of one blow.
fn check_all(scenario: &Scenario, object: &Value, name: &str) {
    let parts = documented();
    let check = |part: &str, of: &Value| {
        check(&parts[part], of.as_object().unwrap(), (scenario, &format!("{name}, {part}")));
    };
    check("", object);
    for part in ["numerics", "results", "error"] {
        check(part, &object[part]);
    }
    object["flags"].as_array().unwrap().iter().for_each(|flag| check("flags", flag));
    for part in ["sectors", "mesh_fold"] {
        if !object[part].is_null() {
            check(part, &object[part]);
        }
    }
    assert_eq!(object["sectors"].is_null(), !scenario.is_spatial(), "{name}");
    for (injury, risk) in object["risks"].as_object().unwrap() {
        assert!(Injury::ALL.iter().any(|known| known.key() == injury), "{name}: {injury}");
        check("risks", risk);
    }
    let is_result = |key: &str| Quantity::ALL.iter().any(|of| of.key() == key);
    for by in ["time_step_percent_by_result", "mesh_percent_by_result", "mesh_limit_by_result"] {
        let keys = object["error"][by].as_object().into_iter().flatten();
        keys.for_each(|(key, _)| assert!(is_result(key), "{name}: {by} {key}"));
    }
    for list in ["at_least", "not_final"] {
        for key in object[list].as_array().unwrap() {
            assert!(is_result(key.as_str().unwrap()), "{name}: {list} {key}");
        }
    }
}

/// The scenario and the arguments of a preset with these set.
fn blow(name: &str, changes: &[&str]) -> (Scenario, Vec<String>) {
    let mut scenario = library::find(name).unwrap().scenario().unwrap();
    let mut arguments = vec!["run".to_owned(), name.to_owned()];
    for change in changes {
        let (path, text) = change.split_once('=').unwrap();
        set(&mut scenario, path, text).unwrap();
        arguments.extend(["--set".to_owned(), (*change).to_owned()]);
    }
    (scenario, arguments)
}

fn check_blow(name: &str, changes: &[&str], flags: &[&str]) {
    let (scenario, arguments) = blow(name, changes);
    let arguments: Vec<&str> =
        arguments.iter().map(String::as_str).chain(flags.iter().copied()).collect();
    check_all(&scenario, &json(&arguments), &arguments.join(" "));
}

#[test]
fn every_preset_cut_short_has_the_keys_of_the_guide() {
    for preset in library::built_in() {
        // What is hit is asked, not how it ends: a tenth of a millisecond has every key.
        check_blow(&preset.name, &["window_ms=0.1"], &["--quick"]);
    }
}

#[test]
fn odd_scenes_have_the_keys_of_the_guide() {
    let free = ["support=Free", "window_ms=0.1"];
    let with = |more: &[&'static str]| [&free[..], more].concat();
    for (name, changes) in [
        ("paper-300n", vec!["model=Physiological", "window_ms=0.3"]),
        ("paper-300n", vec!["impact.angle_deg=-20"]),
        ("paper-300n", vec!["impact.force_n=0"]),
        ("paper-300n", vec!["impact.force_n=1500", "window_ms=1"]),
        ("paper-300n", vec!["window_ms=0.1", "impact.shape=HalfSine"]),
        ("bb-62", vec![]),
        ("bb-62", vec!["speed=0.1"]),
        ("bb-62", vec!["speed=50 +- 5"]),
        ("bb-62", vec!["species=Pig", "support=Gelatin", "window_ms=0.3"]),
        ("bb-62", vec!["support=Gelatin", "angle_deg=10", "window_ms=0.1"]),
        ("bb-62", vec!["angle_deg=20", "window_ms=0.1"]),
        ("bb-62", with(&["angle_deg=20", "angle_clock=7:30"])),
        ("bb-62", with(&["angle_deg=20 +- 10"])),
        ("bb-62", with(&["from=NotKnown"])),
        ("bb-62", with(&["eye_side=Left", "from=Temple"])),
        ("bb-62", with(&["offset_mm=10", "angle_deg=60", "angle_clock=6"])),
        ("bb-62", with(&["numerics.geometry=Full"])),
        ("bb-62", with(&["numerics.geometry=Half"])),
        ("bb-62", with(&["numerics.geometry=Axisymmetric", "angle_deg=20"])),
        ("bb-62", with(&["impact.outline=Cylinder", "impact.stiffness=Linear"])),
        ("paintball", vec!["speed=20"]),
        // Pressed flat.
        ("bb-62", vec!["mass_g=100", "diameter_mm=20", "speed=40"]),
    ] {
        check_blow(name, &changes, &["--quick"]);
    }
    check_blow("paper-300n", &["window_ms=0.5"], &[]);
    check_blow("bb-62", &["support=Free", "speed=2", "window_ms=0.1"], &["--meshes"]);
}

#[test]
fn every_object_names_the_program() {
    let version = Value::from(env!("CARGO_PKG_VERSION"));
    let short = ["--set", "window_ms=0.05"];
    let with = |command: &[&'static str]| json(&[command, &short[..]].concat());
    assert_eq!(with(&["run", "paper-300n"])["program"]["version"], version);
    let both = with(&["compare", "paper-300n", "paper-100n"]);
    assert!(both.as_array().unwrap().iter().all(|one| one["program"]["version"] == version));
    assert_eq!(both[1]["preset"], "paper-100n");
    for command in [&["ensemble", "paper-300n", "--samples=8"][..], &["accuracy", "paper-300n"]] {
        let said = json(&[command, &short].concat());
        assert_eq!(said["program"]["version"], version, "{command:?}");
    }
    let said = with(&["threshold", "paper-300n", "--vary", "force=100:400"]);
    assert_eq!(said["program"]["version"], version);
    assert_eq!(said["scenario"]["impact"]["ForcePulse"]["force_n"], 300.0);
}
