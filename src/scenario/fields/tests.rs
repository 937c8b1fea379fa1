//! Tests of the parent module.

use crate::scenario::{fields::*, load::parse};

/// Scenarios that together hold every variant with fields.
pub(crate) fn every_variant() -> [Scenario; 3] {
    let round = |support: &str, surface: &str| {
        let text = format!(
            "(name: \"x\", model: Physiological(support: {support}, rim: EastAsian), impact: \
             Projectile(mass_g: 1, diameter_mm: 6, speed_m_s: 20, angle_deg: 10, angle_clock: 3, \
             offset_mm: 2, offset_clock: 7.5, stiffness: Linear(n_per_m: 2e4), restitution: 0.5, \
             outline: Cylinder(edge_mm: 1), surface: {surface}))"
        );
        parse(&text, "x").unwrap()
    };
    [
        Scenario::default(),
        round("Orbit", "Elastic(modulus_mpa: 5)"),
        round("Gelatin", "Inflated(kpa: 110, modulus_mpa: 5)"),
    ]
}

#[test]
fn every_path_is_there_once_and_readable_in_some_scenario() {
    for (index, field) in FIELDS.iter().enumerate() {
        let readable = every_variant().iter().any(|s| field.text(s).is_some());
        assert!(readable, "{}", field.path);
        assert!(!FIELDS[..index].iter().any(|other| other.path == field.path));
        // Three lines of the narrowest form.
        let letters = field.help.chars().count();
        assert!((10..=66).contains(&letters) && !field.help.ends_with('.'), "{}", field.path);
    }
}

#[test]
fn a_choice_keeps_what_it_already_is_and_starts_a_new_variant_from_its_default() {
    let mut scenario = Scenario::default();
    let Kind::Choice(shape) = &find("impact.shape").unwrap().kind else { panic!() };
    let of = |scenario: &Scenario| scenario.pulse().unwrap().shape.clone();
    let own = PulseShape::SmoothRectangle { edge_fraction: 0.3 };
    scenario.pulse_mut().unwrap().shape = own.clone();
    assert!(shape.set(&mut scenario, "SmoothRectangle") && of(&scenario) == own);
    assert!(shape.set(&mut scenario, "Triangle"));
    assert_eq!(shape.get(&scenario), Some("Triangle"));
    assert!(shape.set(&mut scenario, "SmoothRectangle"));
    assert_eq!(of(&scenario), PulseShape::default());
    assert!(!shape.set(&mut scenario, "Square"));
}

#[test]
fn the_registry_names_every_field_of_the_types() {
    let mut held = Vec::new();
    for scenario in every_variant() {
        let whole = serde_json::to_value(scenario).unwrap();
        collect(&whole, "", &mut held);
    }
    let groups = ["eye", "numerics", "model.rim.depth_mm", "model.rim.gap_mm"];
    held.retain(|path| !groups.contains(&path.as_str()));
    // A word for an angle and its hour, which files hold.
    held.push("impact.from".to_owned());
    held.sort();
    held.dedup();
    let mut listed: Vec<_> = FIELDS.iter().map(|field| field.path.to_owned()).collect();
    listed.sort();
    assert_eq!(listed, held);
}

/// Dotted paths of all fields, passing through the names of variants.
fn collect(value: &serde_json::Value, under: &str, paths: &mut Vec<String>) {
    for (key, inner) in value.as_object().into_iter().flatten() {
        if key.starts_with(char::is_uppercase) {
            collect(inner, under, paths);
        } else {
            let path = if under.is_empty() { key.clone() } else { format!("{under}.{key}") };
            collect(inner, &path, paths);
            paths.push(path);
        }
    }
}
