//! What a physician looks for after a blow, for injuries that are not excluded: a line or two each,
//! by published guidance, which `contrecoup guide look-for` lists with its sources.
//!
//! Lines of an eye known to be closed stand below those of one that may be open.

use crate::answer::solve::Answer;
use crate::injury::{Injury, Risk};
use crate::run::sectors::{HOURS, Sectors};
use crate::scenario::Side;
use std::f64::consts::TAU;

/// What this program does not compute.
pub const NOT_COMPUTED: &str = "Not computed: orbital fracture with a trapped muscle, vitreous \
    blood, angle recession, cataract, choroidal rupture, optic nerve.";

/// What to look for and do.
pub const fn look_for(injury: Injury) -> [&'static str; 2] {
    match injury {
        Injury::GlobeRupture => [
            "Rigid shield, nothing pressed on the eye; no drops, no tonometry.",
            "Ultrasound and indentation wait until the globe is known to be closed.",
        ],
        Injury::RetinaBack => [
            "Globe closed: dilate. Pale retina, blood, hole or tear? OCT if sight down.",
            "Blood can hide a tear at the back: look again when it has cleared.",
        ],
        Injury::RetinaFront => [
            "Globe closed, no hyphema: dilate and indent, see the ora all round.",
            "Detachment can come months later: see again; flashes, curtain: same day.",
        ],
        Injury::LensDislocation => [
            "Iris or lens trembling, chamber uneven, double sight in one eye?",
            "Measure pressure if globe closed. Lens forward or pressure up: same day.",
        ],
        Injury::Hyphema => [
            "Head up, shield, no aspirin. Globe closed: pressure daily; rebleed day 3-5.",
            "Sickle test: in carriers a pressure below 30 can cost the optic nerve.",
        ],
        Injury::CornealAbrasion => [
            "Globe not in doubt: fluorescein, blue light; turn the upper lid.",
            "No patch, no numbing drops to take home; see again in 24 hours.",
        ],
    }
}

/// The hours at which a tissue felt at least this share of the most.
const NEARLY: f64 = 0.9;

/// The clock hours at which an injury's tissue felt most, as in `3 to 5 o'clock`; none where all
/// round it is much the same.
pub fn hours(answer: &Answer, injury: Injury, side: Side) -> Option<String> {
    let sectors = answer.run.sectors.as_ref().filter(|_| answer.others.is_empty())?;
    let felt: &[f64] = match injury {
        Injury::GlobeRupture => &sectors.equator,
        Injury::RetinaFront => &sectors.edge,
        Injury::LensDislocation => &sectors.lens,
        Injury::Hyphema => &sectors.iris,
        Injury::RetinaBack | Injury::CornealAbrasion => return None,
    };
    let most = Sectors::strongest(felt);
    let strong = |hour: usize| felt[hour % HOURS] >= NEARLY * felt[most];
    let up = (1..HOURS).take_while(|by| strong(most + by)).count();
    let down = (1..HOURS).take_while(|by| strong(most + HOURS - by)).count();
    if up + down + 1 > HOURS / 2 {
        return None;
    }
    let hour = |index: usize| side.hour((index % HOURS) as f64 * TAU / HOURS as f64);
    let ends = [hour(most + HOURS - down), hour(most + up)];
    // At a left eye the hours run the other way.
    let [from, to] = if side == Side::Right { ends } else { [ends[1], ends[0]] };
    Some(if from == to { format!("{from} o'clock") } else { format!("{from} to {to} o'clock") })
}

/// The lines for injuries that are not excluded, those of an open globe first, each once; none of
/// an eye in a laboratory.
pub fn lines(answer: &Answer, risks: &[Risk], side: Side) -> Vec<(&'static str, String)> {
    let not_excluded = |risk: &&Risk| !risk.usable || risk.is_open() || risk.gravity() > 0;
    let of = |risk: &Risk| {
        let [first, second] = look_for(risk.injury);
        let place = hours(answer, risk.injury, side);
        let place = place.map_or_else(String::new, |hours| format!(" Strained most at {hours}."));
        (risk.injury.name(), format!("{first} {second}{place}"))
    };
    let patients = risks.iter().filter(|risk| risk.clinic.is_some());
    patients.filter(not_excluded).map(of).collect()
}
