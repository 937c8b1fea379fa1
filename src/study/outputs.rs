//! The results that ensembles and sweeps tabulate: one line each.
//!
//! A result that a scenario does not have gives `None` and gets no column. A new result is a line in
//! [`OUTPUTS`].

use super::case::Case;
use super::quantity::Quantity;
use crate::eye::Monitor;
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
];

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
