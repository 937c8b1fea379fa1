//! Scenario files, sound and broken: each broken one holds a single defect and says in its first
//! line what must be said of it.

use std::fs;
use std::path::{Path, PathBuf};

use contrecoup::scenario::fields::{Bounds, FIELDS, Kind};
use contrecoup::scenario::load::{load, parse, to_ron};
use contrecoup::scenario::set::set;
use contrecoup::scenario::{
    Impact, MOST_ENERGY_J, Model, NumericsInput, Outline, Scenario, Support,
};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

fn files(folder: &str) -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/scenarios").join(folder);
    let mut files: Vec<_> = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "ron"))
        .collect();
    files.sort();
    assert!(!files.is_empty());
    files
}

#[test]
fn each_broken_file_is_refused_with_the_place_and_the_reason() {
    let mut wrong = Vec::new();
    for path in files("bad") {
        let text = fs::read_to_string(&path).unwrap();
        let expected = text.lines().next().unwrap().strip_prefix("// expect: ").unwrap();
        let said = load(&path).map_or_else(|error| error.to_string(), |_| "accepted".to_owned());
        let file = format!("{}:", path.display());
        let rest = said.strip_prefix(&file).unwrap_or(&said);
        if !rest.starts_with(expected) || said.lines().count() != 1 {
            wrong.push(format!("{}\n    {rest}", path.file_name().unwrap().display()));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn sound_files_are_accepted_and_survive_being_written() {
    for path in files("good") {
        let scenario = load(&path).unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(parse(&to_ron(&scenario), "again").unwrap(), scenario);
    }
}

#[test]
fn what_is_no_scenario_file_is_refused_without_reading_it_all() {
    let folder = tempfile::tempdir().unwrap();
    let refused = |path: &Path, reason: &str| {
        let error = load(path).unwrap_err().to_string();
        assert!(error.contains(reason), "{error}");
    };
    refused(folder.path(), "is a directory");
    refused(&folder.path().join("none.ron"), "there is no such file");
    let large = folder.path().join("large.ron");
    fs::write(&large, " ".repeat(256 * 1024 + 1)).unwrap();
    refused(&large, "is larger than 256 KiB");
    let latin = folder.path().join("latin.ron");
    fs::write(&latin, b"(\n name: \"\xe9\")").unwrap();
    refused(&latin, "is not UTF-8 text (line 2)");
}

#[cfg(unix)]
#[test]
fn devices_and_pipes_neither_hang_nor_fill_the_memory() {
    let folder = tempfile::tempdir().unwrap();
    let pipe = folder.path().join("pipe.ron");
    let made = std::process::Command::new("mkfifo").arg(&pipe).status().unwrap();
    assert!(made.success());
    for path in [Path::new("/dev/zero"), &pipe] {
        let error = load(path).unwrap_err().to_string();
        assert!(error.contains("is not a regular file"), "{error}");
    }
}

#[test]
fn the_ends_of_every_range_are_allowed_and_what_lies_outside_is_not() {
    // A full opening, so that no angle is behind bone.
    let mut roomy = Scenario::default();
    roomy.eye.opening_deg = 120.0;
    // Of the Physiological model, each support and each surface; the cylinder is wide, with a sharp
    // edge, and so slow that any mass brings little energy.
    let mut orbit = roomy.clone();
    set(&mut orbit, "model", "Physiological").unwrap();
    set(&mut orbit, "impact", "Projectile").unwrap();
    set(&mut orbit, "impact.speed_m_s", "1").unwrap();
    set(&mut orbit, "impact.stiffness", "Linear").unwrap();
    set(&mut orbit, "impact.diameter_mm", "200").unwrap();
    set(&mut orbit, "impact.outline", "Cylinder(edge_mm: 0.02)").unwrap();
    set(&mut orbit, "impact.surface", "Inflated").unwrap();
    let mut gelatin = orbit.clone();
    set(&mut gelatin, "model.support", "Gelatin").unwrap();
    let scenarios = [roomy, orbit, gelatin];
    let mut tried = 0;
    for field in FIELDS {
        let holds = |scenario: &&Scenario| field.text(scenario).is_some();
        let roomy = scenarios.iter().find(holds).unwrap();
        let ends = match &field.kind {
            Kind::Number(Bounds { min, max, .. }, _)
            | Kind::OptionalNumber(Bounds { min, max, .. }, _) => {
                [(*min, min.next_down()), (*max, max.next_up())]
                    .map(|(a, b)| (a.to_string(), b.to_string()))
            }
            Kind::Integer(min, max, _) | Kind::Integers(min, max, ..) => {
                [(*min, min - 1), (*max, max + 1)].map(|(a, b)| (a.to_string(), b.to_string()))
            }
            Kind::Choice(_) | Kind::Text(..) => continue,
        };
        for (inside, outside) in ends {
            let mut scenario = roomy.clone();
            set(&mut scenario, field.path, &inside).unwrap();
            scenario.check().unwrap_or_else(|error| panic!("{error}"));
            assert_eq!(parse(&to_ron(&scenario), "").unwrap(), scenario);
            let before = scenario.clone();
            let error = set(&mut scenario, field.path, &outside).unwrap_err();
            assert!(error.problems[0].allowed.is_some(), "{error}");
            assert_eq!(scenario, before, "{} changed on an error", field.path);
        }
        for text in ["NaN", "inf", "-inf", "1e999", "one"] {
            assert!(set(&mut roomy.clone(), field.path, text).is_err(), "{}={text}", field.path);
        }
        tried += 1;
    }
    assert!(tried > 25);
}

/// Text for every field, drawn from its own range.
fn any_settings() -> impl Strategy<Value = Vec<(&'static str, String)>> {
    let one = |field: &'static contrecoup::scenario::fields::Field| {
        let text: BoxedStrategy<String> = match &field.kind {
            Kind::Number(b, _) => (b.min..=b.max).prop_map(|n| n.to_string()).boxed(),
            Kind::OptionalNumber(b, _) => {
                prop_oneof![Just("Auto".to_owned()), (b.min..=b.max).prop_map(|n| n.to_string())]
                    .boxed()
            }
            Kind::Integer(min, max, _) => (*min..=*max).prop_map(|n| n.to_string()).boxed(),
            Kind::Choice(choices) => {
                prop::sample::select(choices.names()).prop_map(str::to_owned).boxed()
            }
            Kind::Integers(min, max, most, _) => {
                prop::collection::btree_set(*min..=*max, 0..=*most)
                    .prop_map(|set| format!("{set:?}").replace(['{', '}'], ""))
                    .boxed()
            }
            Kind::Text(..) => {
                r#"[a-zA-Z"\\#'(),:é€ -]{0,39}x"#.prop_map(|t| format!("{t:?}")).boxed()
            }
        };
        text.prop_map(move |text| (field.path, text))
    };
    FIELDS.iter().map(one).collect::<Vec<_>>()
}

/// Mends what each field allows and rules that join two of them do not.
fn keep_rules(scenario: &mut Scenario) {
    scenario.eye.opening_deg = 120.0;
    if let (Impact::Projectile(_), Model::Paper) = (&scenario.impact, &scenario.model) {
        scenario.model = Model::usual_for(&scenario.impact);
    }
    if let Model::Physiological(model) = &mut scenario.model {
        model.gelatin_opening_deg = 120.0;
        scenario.eye.level = scenario.eye.level.min(5);
        scenario.numerics = NumericsInput::default();
        match &mut scenario.impact {
            Impact::ForcePulse(pulse) => pulse.angle_deg *= 0.5,
            Impact::Projectile(shot) => {
                // One beyond the bounds was kept as it was given.
                shot.angle_deg = 0.3 * shot.angle_deg.abs();
                if model.support == Support::Gelatin {
                    shot.diameter_mm = shot.diameter_mm.min(39.0);
                }
                scenario.eye.level = scenario.eye.level.min(3);
                shot.mass_g *= (0.999 * MOST_ENERGY_J / shot.energy_j()).min(1.0);
                if let Outline::Cylinder { edge_mm } = &mut shot.outline {
                    *edge_mm = 0.5 * shot.diameter_mm.min(*edge_mm);
                }
            }
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig {
        rng_seed: RngSeed::Fixed(1),
        failure_persistence: None,
        ..ProptestConfig::default()
    })]
    #[test]
    fn any_scenario_is_read_back_as_it_was_written(settings in any_settings()) {
        let mut scenario = Scenario::default();
        for (path, text) in settings {
            let absent = FIELDS.iter().any(|f| f.path == path && f.text(&scenario).is_none());
            prop_assert_eq!(set(&mut scenario, path, &text).is_err(), absent, "{}={}", path, text);
        }
        keep_rules(&mut scenario);
        prop_assert_eq!(parse(&to_ron(&scenario), ""), Ok(scenario));
    }

    #[test]
    fn no_text_makes_the_reader_panic_or_speak_to_the_terminal(text in "[ -~\\n\\x1b\\u{9b}é]{0,200}") {
        if let Err(error) = parse(&text, "x") {
            prop_assert!(!error.to_string().contains(|c: char| c.is_control() && c != '\n'));
        }
    }

    #[test]
    fn no_damage_to_a_sound_file_makes_the_reader_panic(at in 0usize..600, put in "[()\\[\\]{}\"'/*,:#r\\\\0-9a-z.-]{0,4}") {
        let mut text = to_ron(&Scenario::default());
        text.insert_str(at.min(text.len()), &put);
        let _ = parse(&text, "x");
    }
}
