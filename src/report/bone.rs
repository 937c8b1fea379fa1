//! What the object did to bone, beside what broke orbits: in words, as no count allows a share.
//!
//! Orbits of cadavers broke from 2.9 J on the eye (face of 25 mm, Rhee 2002) to 3.9 J at the rim and
//! at the globe (3.4 to 4.3 J, Patel 2017), goats' at 2.6 J; goats' fracture threshold and a baseball
//! on the cheekbone (14 J) bound it from above. The energy that is compared is the object's, of which
//! soft ones keep a good part in themselves.

use crate::answer::solve::Answer;
use crate::scenario::Scenario;

/// Energies at which orbits broke, J.
const BROKE: (f64, f64) = (2.9, 4.3);

/// The line of bone; none where the object meets none.
pub fn line(scenario: &Scenario, answer: &Answer) -> Option<String> {
    let object = scenario.projectile()?;
    let detail = |key: &str| answer.run.detail(key).unwrap_or_default();
    let (rim, through) = (detail("peak_rim_force_n"), detail("globe_on_bone_n"));
    if rim <= 0.0 && through <= 0.0 {
        return None;
    }
    let brought = object.energy_j();
    let word = match brought {
        less if less < 0.5 * BROKE.0 => "a fracture is not expected",
        less if less < BROKE.0 => "a fracture cannot be excluded",
        some if some < 4.0 * BROKE.1 => "a fracture is possible",
        _ => "look for a fracture",
    };
    let (low, high) = BROKE;
    let force = |what: &str, newtons: f64| {
        (newtons >= 1.0).then(|| format!("{what} {}", crate::report::format::significant(rounded(newtons))))
    };
    let forces: Vec<String> =
        [force("rim", rim), force("globe on bone", through)].into_iter().flatten().collect();
    Some(format!(
        "bone: {word}: it brought {:.1} J ({} N); orbits of cadavers broke from {low} to {high} J",
        brought,
        forces.join(", ")
    ))
}

/// To two digits.
fn rounded(value: f64) -> f64 {
    format!("{value:.1e}").parse().unwrap_or(value)
}
