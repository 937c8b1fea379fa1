//! Tests of the parent module.

use crate::scenario::set::*;
use crate::scenario::{EyeInput, ForcePulse, Impact, Integrator, Lens, Physiological, Projectile};
use crate::scenario::{ProjectileStiffness, PulseShape, Species, fields::tests::every_variant};
use crate::scenario::{library::tests::preset, load};

fn with(mut scenario: Scenario, path: &str, text: &str) -> Scenario {
    set(&mut scenario, path, text).unwrap_or_else(|error| panic!("{path}={text}: {error}"));
    scenario
}

fn after(path: &str, text: &str) -> Scenario {
    with(Scenario::default(), path, text)
}

/// What is said of a change that is refused, which leaves the scenario as it was.
fn refused(scenario: &Scenario, path: &str, text: &str) -> String {
    let mut same = scenario.clone();
    let error = set(&mut same, path, text).unwrap_err();
    assert_eq!(same, *scenario);
    error.to_string()
}

fn refusal(path: &str, text: &str) -> String {
    refused(&Scenario::default(), path, text)
}

fn pulse(scenario: &Scenario) -> &ForcePulse {
    scenario.pulse().unwrap()
}

#[test]
fn every_field_takes_back_its_own_text() {
    for scenario in every_variant() {
        for field in FIELDS {
            let Some(text) = field.text(&scenario) else { continue };
            let mut same = scenario.clone();
            set(&mut same, field.path, &text).unwrap();
            assert_eq!(same, scenario, "{}", field.path);
        }
    }
}

#[test]
fn projectiles_and_models_are_set_whole_or_by_field() {
    let whole = "Projectile(mass_g: 0.345, diameter_mm: 4.5, speed_m_s: 62.5, \
                 stiffness: Linear(n_per_m: 2.4e5), unverified: [\"speed_m_s\"])";
    let shot = with(after("impact", whole), "impact.mass_g", "0.35");
    let object = shot.projectile().unwrap();
    assert_eq!((object.mass_g, object.unverified.len()), (0.35, 1));
    let shot = with(with(shot, "impact.speed_m_s", "60"), "impact.stiffness", "rigid");
    let object = shot.projectile().unwrap();
    assert_eq!(object.stiffness, ProjectileStiffness::Rigid);
    assert!(object.unverified.is_empty());
    refused(&shot, "impact.force_n", "1");

    let parts = |scenario: Scenario| *scenario.physiological().unwrap();
    assert_eq!(parts(after("model", "physiological")), Physiological::default());
    assert_eq!(parts(after("model", "Physiological(species: Pig)")).species, Species::Pig);
    let shot = with(shot, "model", "Physiological");
    let shot = with(shot, "impact.surface", "Inflated(kpa: 150, modulus_mpa: 3)");
    let shot = with(with(shot, "impact.surface.kpa", "120"), "model.support", "gelatin");
    let paper = Scenario::default();
    for (scenario, path, said) in [
        (&paper, "model.species", "model is Paper, which has no species"),
        (&paper, "impact.surface", "impact is ForcePulse, which has no surface"),
        (&shot, "model.fat_bulk_mpa", "which has no fat_bulk_mpa"),
        (&shot, "eye.fat_kpa", "model is Physiological, which has no eye.fat_kpa"),
    ] {
        let refusal = refused(scenario, path, "1");
        assert!(refusal.contains(said), "{refusal}");
    }
}

#[test]
fn scalars_are_set_by_their_path_and_names_in_any_spelling() {
    assert_eq!(pulse(&after("impact.force_n", " 4.5e2 ")).force_n, 450.0);
    assert_eq!(pulse(&after("impact.force_n", "1_000")).force_n, 1000.0);
    assert_eq!(after("eye.lens", "soft").eye.lens, Lens::Soft);
    assert_eq!(after("numerics.step_us", "1.5").numerics.step_us, Some(1.5));
    assert_eq!(after("numerics.step_us", "Some(2)").numerics.step_us, Some(2.0));
    assert_eq!(after("window_ms", "4").window_ms, Some(4.0));
    for text in ["None", "auto", "AUTO"] {
        assert_eq!(after("window_ms", text).window_ms, None);
        let automatic = with(after("numerics.step_us", "2"), "numerics.step_us", text);
        assert_eq!(automatic.numerics.step_us, None);
    }
    assert_eq!(after("name", "any text, even (this)").name, "any text, even (this)");
    assert_eq!(after("name", "\"in \\\"quotes\\\"\"").name, "in \"quotes\"");
    for text in ["[2,3]", "2, 3"] {
        assert_eq!(after("eye.filament_hops", text).eye.filament_hops, [2, 3]);
    }
    assert!(after("eye.filament_hops", "[]").eye.filament_hops.is_empty());
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
fn refusals_name_the_value_and_what_is_allowed_or_lead_to_the_right_path() {
    assert_eq!(
        refusal("impact.force_n", "abc"),
        "impact.force_n: abc is not a number: allowed 0 to 100000 N"
    );
    for path in ["impact.force_n", "eye.lens", "eye.level", "numerics.step_us"] {
        assert!(refusal(path, " ").contains("nothing is there: allowed "));
    }
    assert!(refusal("impact.force_n", "1,5").contains("a point, not a comma"));
    assert!(refusal("eye", "(level: 9)").starts_with("eye.level: 9 is out of range"));
    assert!(refusal("eye", "(levle: 1)").contains("did you mean level?"));
    assert!(refusal("impact.shape", "Square").contains("Triangle, HalfSine"));
    assert!(refusal("farce_n", "1").contains("did you mean impact.force_n?"));
    assert!(refusal("", "1").contains("there is no such field"));
    assert_eq!(
        refused(&after("impact.shape", "Triangle"), "impact.shape.edge_fraction", "0.1"),
        "impact.shape.edge_fraction: impact.shape is Triangle, which has no edge_fraction"
    );
}

#[test]
fn a_number_that_is_put_is_no_longer_unverified() {
    let unverified = ["speed_m_s", "mass_g"].map(str::to_owned).to_vec();
    let object = Projectile { unverified, ..Projectile::default() };
    let mut scenario = Scenario::of(Impact::Projectile(object));
    put_number(&mut scenario, fields::find("impact.speed_m_s").unwrap(), 40.0);
    let object = scenario.projectile_mut().unwrap();
    assert_eq!((object.speed_m_s, &object.unverified[..]), (40.0, &["mass_g".to_owned()][..]));
}

#[test]
fn the_end_of_a_path_is_enough_where_only_one_field_fits() {
    let (pulse, object) = (Scenario::default(), after("impact", "Projectile"));
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
    let short = with(object.clone(), "speed", "45 +- 3");
    assert_eq!(short, with(object, "impact.speed_m_s", "45 +- 3"));
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
    // What is below an end of a range, or must not be 0, is refused however small.
    for (path, tiny) in
        [("impact.force_n", "-4e-320"), ("window_ms", "4e-320"), ("numerics.step_us", "4e-320")]
    {
        assert!(set(&mut scenario, path, tiny).is_err(), "{path}={tiny}");
    }
}

#[test]
fn a_doubt_goes_with_its_field() {
    let mut ball = preset("squash-ball", &[]);
    assert!(ball.doubt.contains_key("impact.restitution"));
    ball.doubt.insert("impact.speed_m_s".to_owned(), 5.0);
    let ball = with(with(ball, "impact.stiffness", "Rigid"), "impact.surface", "Hard");
    assert_eq!(ball.doubt.keys().collect::<Vec<_>>(), ["impact.speed_m_s"]);
    ball.check().unwrap();
    let pulse = after("impact.shape.edge_fraction", "0.1 ± 0.02");
    let pulse = with(pulse, "impact.force_n", "300 ± 10");
    for (path, text, left) in [("impact.shape", "Triangle", 1), ("impact", "Projectile()", 0)] {
        let whole = text.replace("()", "(mass_g: 1, diameter_mm: 6, speed_m_s: 5)");
        assert_eq!(with(pulse.clone(), path, &whole).doubt.len(), left);
    }
}

#[test]
fn an_hour_is_typed_as_a_clock_shows_it() {
    let ball = preset("bb-62", &[]);
    for (text, wanted) in [("7:30", 7.5), (" 12:00 ", 12.0), ("7.5", 7.5), ("12:30", 0.5)] {
        let turned = with(ball.clone(), "impact.angle_clock", text);
        assert_eq!(turned.projectile().unwrap().angle_clock, wanted, "{text}");
    }
    for text in ["7:60", "13:00", ":30", "7:3x"] {
        refused(&ball, "impact.angle_clock", text);
    }
    refused(&ball, "impact.speed_m_s", "7:30");
}

/// The scenario with all of these, in this order, as flags and sweeps set them.
fn with_all(mut scenario: Scenario, changes: &[(&str, &str)]) -> Scenario {
    let mut changes = changes.to_vec();
    in_order(&scenario, &mut changes, |(path, _)| path);
    for (path, text) in changes {
        set_one_of_several(&mut scenario, path, text).unwrap();
    }
    settle(&mut scenario);
    scenario
}

/// Where its object comes from: angle and hour.
fn from(scenario: &Scenario) -> (f64, f64) {
    let object = scenario.projectile().unwrap();
    (object.angle_deg, object.angle_clock)
}

#[test]
fn an_angle_below_0_and_its_hour_mean_the_same_in_any_order() {
    let bb = preset("bb-62", &[]);
    for [first, second] in
        [["impact.angle_deg", "impact.angle_clock"], ["angle_deg", "angle_clock"]]
    {
        for (angle, hour, wanted) in
            [("-30", "3", (30.0, 9.0)), ("30", "3", (30.0, 3.0)), ("-30", "9", (30.0, 3.0))]
        {
            let one = with_all(bb.clone(), &[(first, angle), (second, hour)]);
            let other = with_all(bb.clone(), &[(second, hour), (first, angle)]);
            assert_eq!(from(&one), wanted);
            assert_eq!(one, other);
        }
    }
    let text = "(name: \"x\", impact: Projectile(mass_g: 1.0, diameter_mm: 6.0, speed_m_s: 9.0, \
                angle_deg: -30.0, angle_clock: 3.0))";
    assert_eq!(from(&load::parse(text, "x").unwrap()), (30.0, 9.0));
    let word = ("impact.from", "Temple");
    for changes in [[("angle_deg", "12"), word], [word, ("angle_deg", "12")]] {
        assert_eq!(from(&with_all(bb.clone(), &changes)), (12.0, 9.0));
    }
    let whole = ("impact", "Projectile(mass_g: 1, diameter_mm: 6, speed_m_s: 9)");
    let both = with_all(bb, &[("angle_deg", "12"), whole, word]);
    assert_eq!(from(&both), (30.0, 9.0));
}

#[test]
fn numbers_that_are_put_together_are_folded_once() {
    let mut bb = preset("bb-62", &[]);
    let [angle, hour] =
        ["impact.angle_deg", "impact.angle_clock"].map(|p| fields::find(p).unwrap());
    put_numbers(&mut bb, [(angle, -30.0), (hour, 3.0)]);
    assert_eq!(from(&bb), (30.0, 9.0));
}

#[test]
fn the_other_eye_is_hit_from_the_same_side() {
    let bb = preset("bb-62", &[("impact.from", "Temple"), ("impact.offset_mm", "2")]);
    let bb = with(bb, "impact.offset_clock", "4");
    let side = fields::find("impact.from").unwrap();
    let left = with(bb.clone(), "model.eye_side", "Left");
    assert_eq!((from(&bb), from(&left)), ((30.0, 9.0), (30.0, 3.0)));
    assert_eq!(side.text(&left).as_deref(), Some("Temple"));
    assert_eq!(left.projectile().unwrap().offset_clock, 8.0);
    assert_eq!(with(left.clone(), "model", "Physiological(eye_side: Right)"), bb);
    assert_eq!(with(left, "model.eye_side", "Right"), bb);
    let above = with(preset("bb-62", &[("impact.from", "Above")]), "model.eye_side", "Left");
    assert_eq!(from(&above), (30.0, 12.0));
    // An hour that is given with the eye is that of the eye.
    let given = [("angle_clock", "9"), ("angle_deg", "30"), ("eye_side", "Left")];
    let nose = with_all(preset("bb-62", &[]), &given);
    assert_eq!(side.text(&nose).as_deref(), Some("Nose"));
}
