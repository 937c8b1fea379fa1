//! Tests of the parent module.

use crate::scenario::set::*;
use crate::scenario::{
    EyeInput, ForcePulse, Impact, Integrator, Lens, Physiological, Projectile, ProjectileStiffness,
    PulseShape, Species,
};
use crate::scenario::{fields::tests::every_variant, library::tests::preset, load};

fn after(path: &str, text: &str) -> Scenario {
    let mut scenario = Scenario::default();
    set(&mut scenario, path, text).unwrap_or_else(|error| panic!("{path}={text}: {error}"));
    scenario
}

fn refusal(path: &str, text: &str) -> String {
    let mut scenario = Scenario::default();
    let error = set(&mut scenario, path, text).unwrap_err();
    assert_eq!(scenario, Scenario::default());
    error.to_string()
}

fn pulse(scenario: &Scenario) -> &ForcePulse {
    scenario.pulse().unwrap()
}

#[test]
fn every_field_takes_back_its_own_text() {
    for scenario in every_variant() {
        for field in FIELDS {
            let Some(text) = field.text(&scenario) else {
                continue;
            };
            let mut same = scenario.clone();
            set(&mut same, field.path, &text).unwrap();
            assert_eq!(same, scenario, "{}", field.path);
        }
    }
}

#[test]
fn projectiles_and_models_are_set_whole_or_by_field() {
    let mut scenario = after(
        "impact",
        "Projectile(mass_g: 0.345, diameter_mm: 4.5, speed_m_s: 62.5, stiffness: Linear(n_per_m: 2.4e5), \
         unverified: [\"speed_m_s\"])",
    );
    set(&mut scenario, "impact.mass_g", "0.35").unwrap();
    let object = scenario.projectile().unwrap();
    assert_eq!((object.mass_g, object.unverified.len()), (0.35, 1));
    set(&mut scenario, "impact.speed_m_s", "60").unwrap();
    set(&mut scenario, "impact.stiffness", "rigid").unwrap();
    let object = scenario.projectile().unwrap();
    assert_eq!(object.stiffness, ProjectileStiffness::Rigid);
    assert!(object.unverified.is_empty());
    assert!(set(&mut scenario, "impact.force_n", "1").is_err());

    let parts = |scenario: &Scenario| *scenario.physiological().unwrap();
    assert_eq!(parts(&after("model", "physiological")), Physiological::default());
    let pig = parts(&after("model", "Physiological(species: Pig)"));
    assert_eq!(pig.species, Species::Pig);
    assert!(refusal("model.species", "Pig").contains("model is Paper, which has no species"));
    let object =
        Scenario { impact: Impact::Projectile(Projectile::default()), ..Scenario::default() };
    assert!(
        refusal("impact.surface", "Hard").contains("impact is ForcePulse, which has no surface")
    );
    let mut turned = object;
    set(&mut turned, "model", "Physiological").unwrap();
    set(&mut turned, "impact.surface", "Inflated(kpa: 150, modulus_mpa: 3)").unwrap();
    set(&mut turned, "impact.surface.kpa", "120").unwrap();
    set(&mut turned, "model.support", "gelatin").unwrap();
    let refused = set(&mut turned, "model.fat_bulk_mpa", "1").unwrap_err();
    assert!(refused.to_string().contains("which has no fat_bulk_mpa"));
    let refused = set(&mut turned, "eye.fat_kpa", "1").unwrap_err();
    assert!(refused.to_string().contains("model is Physiological, which has no eye.fat_kpa"));
}

#[test]
fn scalars_are_set_by_their_path() {
    assert_eq!(pulse(&after("impact.force_n", " 4.5e2 ")).force_n, 450.0);
    assert_eq!(pulse(&after("impact.force_n", "1_000")).force_n, 1000.0);
    assert_eq!(after("eye.lens", "soft").eye.lens, Lens::Soft);
    assert_eq!(after("numerics.step_us", "1.5").numerics.step_us, Some(1.5));
    assert_eq!(after("numerics.step_us", "Some(2)").numerics.step_us, Some(2.0));
    assert_eq!(after("window_ms", "4").window_ms, Some(4.0));
    for text in ["None", "auto", "AUTO"] {
        assert_eq!(after("window_ms", text).window_ms, None);
        let mut scenario = after("numerics.step_us", "2");
        set(&mut scenario, "numerics.step_us", text).unwrap();
        assert_eq!(scenario.numerics.step_us, None);
    }
    assert_eq!(after("name", "any text, even (this)").name, "any text, even (this)");
    assert_eq!(after("name", "\"in \\\"quotes\\\"\"").name, "in \"quotes\"");
    for text in ["[2,3]", "2, 3"] {
        assert_eq!(after("eye.filament_hops", text).eye.filament_hops, [2, 3]);
    }
    assert!(after("eye.filament_hops", "[]").eye.filament_hops.is_empty());
}

#[test]
fn names_are_taken_in_any_spelling() {
    for text in ["VelocityVerlet", "velocity-verlet", "VELOCITY_VERLET"] {
        let scenario = after("numerics.integrator", text);
        assert_eq!(scenario.numerics.integrator, Some(Integrator::VelocityVerlet));
    }
    assert_eq!(pulse(&after("impact.shape", "half-sine")).shape, PulseShape::HalfSine);
}

#[test]
fn groups_are_replaced_as_in_a_file() {
    let eye = after("eye", "(level: 2)").eye;
    assert_eq!(eye, EyeInput { level: 2, ..EyeInput::default() });
    let scenario = after("impact", "ForcePulse(force_n: 10, shape: Triangle)");
    assert_eq!(pulse(&scenario).force_n, 10.0);
    assert_eq!(pulse(&scenario).shape, PulseShape::Triangle);
    let shape = pulse(&after("impact.shape", "SmoothRectangle(edge_fraction: 0.2)")).shape.clone();
    assert_eq!(shape, PulseShape::SmoothRectangle { edge_fraction: 0.2 });
    assert_eq!(after("numerics", "(step_us: 1)").numerics.step_us, Some(1.0));
}

#[test]
fn refusals_name_the_value_and_what_is_allowed() {
    assert_eq!(
        refusal("impact.force_n", "abc"),
        "impact.force_n: abc is not a number: allowed 0 to 100000 N"
    );
    for path in ["impact.force_n", "eye.lens", "eye.level", "numerics.step_us"] {
        assert!(refusal(path, " ").contains("nothing is there: allowed "));
    }
    assert!(refusal("impact.force_n", "1,5").contains("a point, not a comma"));
    assert!(refusal("impact.force_n", "1e6").contains("1000000 is out of range"));
    assert!(refusal("impact.force_n", "nan").contains("is not a finite number"));
    assert!(refusal("eye", "(level: 9)").starts_with("eye.level: 9 is out of range"));
    assert!(refusal("eye", "(levle: 1)").contains("did you mean level?"));
    assert!(refusal("impact.shape", "Square").contains("Triangle, HalfSine"));
    assert!(refusal("eye.filament_hops", "2,2").contains("repeats"));
    assert!(refusal("name", "  ").contains("is empty"));
}

#[test]
fn refusals_of_a_path_lead_to_the_right_one() {
    assert!(refusal("farce_n", "1").contains("did you mean impact.force_n?"));
    assert!(refusal("", "1").contains("there is no such field"));
    let mut scenario = after("impact.shape", "Triangle");
    let error = set(&mut scenario, "impact.shape.edge_fraction", "0.1").unwrap_err();
    assert_eq!(
        error.to_string(),
        "impact.shape.edge_fraction: impact.shape is Triangle, which has no edge_fraction"
    );
}

#[test]
fn a_number_that_is_put_is_no_longer_unverified() {
    let mut scenario = Scenario {
        impact: Impact::Projectile(Projectile {
            unverified: vec!["speed_m_s".to_owned(), "mass_g".to_owned()],
            ..Projectile::default()
        }),
        ..Scenario::default()
    };
    put_number(&mut scenario, fields::find("impact.speed_m_s").unwrap(), 40.0);
    let object = scenario.projectile_mut().unwrap();
    assert_eq!((object.speed_m_s, &object.unverified[..]), (40.0, &["mass_g".to_owned()][..]));
}

#[test]
fn the_end_of_a_path_is_enough_where_only_one_field_fits() {
    let pulse = Scenario::default();
    let mut object = Scenario::default();
    set(&mut object, "impact", "Projectile").unwrap();
    for (typed, path) in [
        ("force_n", "impact.force_n"),
        ("force", "impact.force_n"),
        (" window ", "window_ms"),
        ("level", "eye.level"),
        ("lens", "eye.lens"),
        ("edge", "impact.shape.edge_fraction"),
        ("shape.edge", "impact.shape.edge_fraction"),
        ("impact.angle", "impact.angle_deg"),
        // Known, and refused by the kind of the impact.
        ("speed", "impact.speed_m_s"),
        // Several fit, or none.
        ("fat", "fat"),
        ("", ""),
        ("_", "_"),
        ("orce_n", "orce_n"),
        ("impact.", "impact."),
    ] {
        assert_eq!(full_path(&pulse, typed), path, "{typed:?}");
    }
    assert_eq!(full_path(&object, "speed"), "impact.speed_m_s");
    let mut short = object.clone();
    set(&mut short, "speed", "45 +- 3").unwrap();
    set(&mut object, "impact.speed_m_s", "45 +- 3").unwrap();
    assert_eq!(short, object);
}

#[test]
fn what_is_next_to_nothing_is_nothing() {
    let mut scenario = Scenario::default();
    for tiny in ["-0", "-0.0", "1e-310", "1e-400"] {
        set(&mut scenario, "impact.force_n", tiny).unwrap();
        let angle = format!("{tiny} +- {tiny}");
        set(&mut scenario, "impact.angle_deg", &angle).unwrap();
        let pulse = pulse(&scenario);
        let doubt = scenario.doubt["impact.angle_deg"];
        for number in [pulse.force_n, pulse.angle_deg, doubt] {
            assert_eq!(number.to_bits(), 0, "{tiny}: {number:?}");
        }
        // Put there without being typed, as by a library or a file.
        let mut untyped = Scenario::default();
        untyped.eye.globe_drag_ns_m = tiny.parse().unwrap();
        let checked = untyped.check().unwrap();
        assert_eq!(checked.eye.globe_drag_ns_m.to_bits(), 0, "{tiny}");
        let text = format!("(name: \"x\", impact: ForcePulse(force_n: {tiny}))");
        let read = load::parse(&text, "x").unwrap();
        assert!(load::to_ron(&read).contains("force_n: 0.0,"), "{tiny}");
    }
    // What is below an end of a range is outside it, however little; what must not be 0 must not be
    // that either.
    for (path, tiny) in
        [("impact.force_n", "-4e-320"), ("window_ms", "4e-320"), ("numerics.step_us", "4e-320")]
    {
        assert!(set(&mut scenario, path, tiny).is_err(), "{path}={tiny}");
    }
}

#[test]
fn a_doubt_goes_with_its_field() {
    let mut scenario = preset("squash-ball", &[]);
    assert!(scenario.doubt.contains_key("impact.restitution"));
    scenario.doubt.insert("impact.speed_m_s".to_owned(), 5.0);
    set(&mut scenario, "impact.stiffness", "Rigid").unwrap();
    set(&mut scenario, "impact.surface", "Hard").unwrap();
    assert_eq!(scenario.doubt.keys().collect::<Vec<_>>(), ["impact.speed_m_s"]);
    scenario.check().unwrap();
}

#[test]
fn an_hour_is_typed_as_a_clock_shows_it() {
    let ball = preset("bb-62", &[]);
    let hour = |text: &str| {
        let mut scenario = ball.clone();
        set(&mut scenario, "impact.angle_clock", text)?;
        Ok(scenario.projectile().unwrap().angle_clock)
    };
    for (text, wanted) in [("7:30", 7.5), (" 12:00 ", 12.0), ("7.5", 7.5), ("3", 3.0)] {
        assert_eq!(hour(text).map_err(|e: ScenarioError| e.to_string()), Ok(wanted), "{text}");
    }
    for text in ["7:60", "13:00", ":30", "7:3x"] {
        assert!(hour(text).is_err(), "{text}");
    }
    let mut other = ball.clone();
    assert!(set(&mut other, "impact.speed_m_s", "7:30").is_err());
}
