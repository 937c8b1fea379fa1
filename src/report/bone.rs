//! What the object did to bone, beside what broke orbits: in words, as no count allows a share.
//!
//! Orbits of cadavers broke from 2.9 J on the eye (a face of 25 mm, Rhee 2002) to 3.9 J at the rim
//! and at the globe (3.4 to 4.3 J, Patel 2017), goats' at 2.6 J. What is compared is the energy
//! that the object spent at the rim, of which soft ones keep a part in themselves: it is an upper
//! end.
//!
//! Left out: where bone is thin, that it breaks, and forces: rigid bone makes them too large.

use crate::answer::solve::Answer;
use crate::report::format::digits;

/// Energies at which orbits broke, J.
const BROKE: (f64, f64) = (2.9, 4.3);
/// So many times the greater of them a fracture is likely.
const LIKELY: f64 = 4.0;

/// The line of bone; none where the object meets none.
pub fn line(answer: &Answer) -> Option<String> {
    let detail = |key: &str| answer.run.detail(key).unwrap_or_default();
    let (rim, through) = (detail("peak_rim_force_n"), detail("globe_on_bone_n"));
    let spent = answer.run.detail("energy_at_bone_j").filter(|_| rim + through > 0.0)?;
    let (low, high) = BROKE;
    let word = match spent {
        less if less < 0.5 * low => "a fracture is not expected",
        less if less < low => "a fracture cannot be excluded",
        some if some < LIKELY * high => "a fracture is possible",
        _ => "a fracture is likely",
    };
    let spent = digits(spent, 2);
    Some(format!(
        "bone: {word}: up to {spent} J at the rim; orbits of cadavers broke from {low} to {high} J"
    ))
}
