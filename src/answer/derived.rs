//! The results that no run reads off an eye: the paper's index and the risks, made of its
//! readings.

use crate::injury::{Blow, DamageIndex, Injury};
use crate::run::{model::Run, quantity::Quantity};

/// A result of a run in its unit; none where the scene has no such result.
pub(crate) fn result(of: Quantity, run: &Run, blow: &Blow) -> Option<f64> {
    let value = match Injury::of(of) {
        // An eye that was not hit is not hurt.
        Some(_) if run.missed => 0.0,
        Some(injury) => injury.risk(blow, run.readings.value(injury.measure())?),
        None if of == Quantity::Damage => DamageIndex::of(&run.readings).damage(),
        None => run.readings.value(of)?,
    };
    Some(value * of.row().factor)
}

/// The result that `of` is made of: what its tissue felt, of a risk.
pub(crate) fn rests_on(of: Quantity) -> Quantity {
    Injury::of(of).map_or(of, Injury::measure)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_risk_is_of_one_injury_and_every_injury_has_a_risk() {
        for of in Quantity::ALL {
            assert_eq!(of.is_risk(), Injury::of(*of).is_some());
        }
        for injury in Injury::ALL {
            assert!(injury.result().is_risk() && !injury.measure().is_risk());
            assert!(injury.result().key().starts_with(injury.key()));
        }
    }
}
