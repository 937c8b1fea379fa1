//! The results that ensembles and sweeps tabulate: one line each.
//!
//! A result that a scenario does not have gives `None` and gets no column. A new result is a line in
//! [`OUTPUTS`].

use super::case::Case;
use super::quantity::Quantity;
use crate::eye::Monitor;
use crate::injury::{Blow, Caution, Injury, Measure, assess};
use crate::recording::Extremes;
use crate::scenario::Scenario;

/// What a run left, for an output to be read from.
pub struct Ran<'a> {
    /// What was asked.
    pub scenario: &'a Scenario,
    /// What was moved.
    pub case: &'a Case,
    /// The largest values.
    pub extremes: &'a Extremes,
}

/// One result.
pub struct Output {
    /// Name with its unit, as in JSON and CSV.
    pub key: &'static str,
    /// Name for people.
    pub label: &'static str,
    /// Unit for people.
    pub unit: &'static str,
    /// Its value.
    pub of: fn(&Ran) -> Option<f64>,
}

/// A line for one of the results that errors are stated for.
macro_rules! of {
    ($quantity:expr, $key:literal, $label:literal, $unit:literal) => {
        Output {
            key: $key,
            label: $label,
            unit: $unit,
            of: |ran| Some($quantity.of(ran.extremes)),
        }
    };
}

/// Every result, the leading one first.
pub static OUTPUTS: &[Output] = &[
    of!(Quantity::Damage, "damage_percent", "damage index", "%"),
    of!(
        Quantity::ShellGrowth,
        "scleral_growth_percent",
        "S shell growth",
        "%"
    ),
    of!(
        Quantity::MeridianGrowth,
        "meridian_growth_percent",
        "M meridian growth",
        "%"
    ),
    of!(
        Quantity::Energy,
        "energy_imparted_j",
        "E energy imparted",
        "J"
    ),
    of!(Quantity::Apex, "apex_displacement_mm", "corneal apex", "mm"),
    of!(
        Quantity::Force(Monitor::Centre),
        "peak_force_centre_n",
        "peak, centre",
        "N"
    ),
    of!(
        Quantity::Force(Monitor::Front),
        "peak_force_front_n",
        "peak, front",
        "N"
    ),
    of!(
        Quantity::Force(Monitor::Right),
        "peak_force_right_n",
        "peak, right",
        "N"
    ),
    of!(
        Quantity::Force(Monitor::Top),
        "peak_force_top_n",
        "peak, top",
        "N"
    ),
    Output {
        key: "peak_pressure_mpa",
        label: "peak pressure",
        unit: "MPa",
        of: |ran| Some(ran.extremes.fluid?.pressure.value * 1e-6),
    },
    Output {
        key: "peak_contact_force_n",
        label: "contact force",
        unit: "N",
        of: |ran| Some(ran.extremes.shot?.force.value),
    },
    Output {
        key: "rupture_by_pressure_percent",
        label: "rupture, pressure",
        unit: "%",
        of: |ran| {
            let pressure = ran.extremes.fluid?.pressure.value;
            unless_missed(ran, None, Some(pressure), RUPTURE_BY_PRESSURE)
        },
    },
    Output {
        key: RUPTURE_KEY,
        label: "rupture, energy",
        unit: "%",
        of: |ran| unless_missed(ran, Blow::of(ran.scenario), None, RUPTURE_BY_ENERGY),
    },
    Output {
        key: RETINA_KEY,
        label: "retina, energy",
        unit: "%",
        of: |ran| unless_missed(ran, Blow::of(ran.scenario), None, RETINA_BY_ENERGY),
    },
];

const RUPTURE_KEY: &str = "rupture_by_energy_percent";
const RETINA_KEY: &str = "retinal_damage_by_energy_percent";
const RUPTURE_BY_PRESSURE: (Injury, Measure) = (Injury::GlobeRupture, Measure::Pressure);
const RUPTURE_BY_ENERGY: (Injury, Measure) = (Injury::GlobeRupture, Measure::NormalizedEnergy);
const RETINA_BY_ENERGY: (Injury, Measure) = (Injury::RetinalDamage, Measure::NormalizedEnergy);

/// Risk in % by the first curve of an injury and a measure, with its own slope or another.
fn risk(
    blow: Option<Blow>,
    pressure: Option<f64>,
    of: (Injury, Measure),
    slope: Option<f64>,
) -> Option<f64> {
    let risks = assess(blow, pressure);
    let found = risks
        .iter()
        .find(|r| (r.curve.injury, r.curve.measure) == of)?;
    let risk = slope.map_or(found.risk, |s| found.curve.risk_with(found.value, s));
    Some(100.0 * risk)
}

/// The same with the curve's own slope, and nothing for an eye that was missed.
fn unless_missed(
    ran: &Ran,
    blow: Option<Blow>,
    pressure: Option<f64>,
    of: (Injury, Measure),
) -> Option<f64> {
    let risk = risk(blow, pressure, of, None)?;
    Some(if ran.extremes.missed() { 0.0 } else { risk })
}

/// What speaks against the risks by energy of this scenario's object.
pub fn caution(scenario: &Scenario) -> Option<Caution> {
    Blow::of(scenario)?.caution()
}

/// Puts the risks that rest on an assumed slope again, for the slope `slope`, into the values of a
/// run of `scenario`.
pub fn with_slope(values: &mut [f64], scenario: &Scenario, slope: f64) {
    let blow = Blow::of(scenario);
    for (key, of) in [
        (RUPTURE_KEY, RUPTURE_BY_ENERGY),
        (RETINA_KEY, RETINA_BY_ENERGY),
    ] {
        let place = OUTPUTS.iter().position(|o| o.key == key);
        if let (Some(place), Some(risk)) = (place, risk(blow, None, of, Some(slope))) {
            // Of an eye that was missed it is 0 and stays so.
            if values[place] > 0.0 {
                values[place] = risk;
            }
        }
    }
}

/// Every result of a run, in the order of [`OUTPUTS`]; not a number where the scene has none.
pub fn read(ran: &Ran) -> Vec<f64> {
    let value = |output: &Output| (output.of)(ran).unwrap_or(f64::NAN);
    OUTPUTS.iter().map(value).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn keys_are_those_of_single_runs_and_stand_there_once() {
        for quantity in Quantity::ALL {
            let found = OUTPUTS.iter().filter(|o| o.key == quantity.key()).count();
            assert_eq!(found, 1, "{}", quantity.key());
        }
        for (i, output) in OUTPUTS.iter().enumerate() {
            assert!(OUTPUTS[..i].iter().all(|o| o.key != output.key));
        }
    }
}
