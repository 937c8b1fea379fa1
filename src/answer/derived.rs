//! The results that no run reads off an eye: the paper's index and the risks, made of its
//! readings.

use crate::answer::believed::RiskInputs;
use crate::injury::{DamageIndex, Injury, InjuryCurve, Measure, Measures, curve_of};
use crate::run::model::Run;
use crate::run::quantity::Quantity;
use crate::run::raised::ENERGY_ALARM;

/// How a result is made of readings.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Derived {
    /// The paper's damage index.
    Index,
    /// The risk by the first published curve of this injury against this measure.
    Risk(Injury, Measure),
    /// The risk of this injury by the curve that is believed first.
    Believed(Injury),
}

impl Quantity {
    /// How it is made of readings; none of what is one.
    pub fn derived(self) -> Option<Derived> {
        let rupture_by = |measure| Derived::Risk(Injury::GlobeRupture, measure);
        Some(match self {
            Self::Damage => Derived::Index,
            Self::RuptureByPressure => rupture_by(Measure::Pressure),
            Self::RuptureByStress => rupture_by(Measure::Stress),
            Self::RuptureByEnergy => rupture_by(Measure::NormalizedEnergy),
            Self::RetinaByEnergy => Derived::Risk(Injury::RetinalDamage, Measure::NormalizedEnergy),
            Self::GlobeRupture => Derived::Believed(Injury::GlobeRupture),
            Self::RetinalDamage => Derived::Believed(Injury::RetinalDamage),
            Self::LensDislocation => Derived::Believed(Injury::LensDislocation),
            Self::Hyphema => Derived::Believed(Injury::Hyphema),
            Self::CornealAbrasion => Derived::Believed(Injury::CornealAbrasion),
            _ => return None,
        })
    }

    /// The curve that a risk is read from; none of what is no risk.
    pub(crate) fn curve(
        self,
        risk_inputs: &RiskInputs,
        measures: &Measures,
        spoiled: bool,
    ) -> Option<&'static InjuryCurve> {
        match self.derived()? {
            Derived::Index => None,
            Derived::Risk(injury, measure) => curve_of(injury, measure),
            Derived::Believed(injury) => {
                Some(risk_inputs.believed(injury, measures, spoiled)?.curve)
            }
        }
    }
}

/// Whether a run left the model's validity, as its fold and its energies say.
fn is_spoiled(run: &Run) -> bool {
    run.fold.is_some() || run.energy_residual > ENERGY_ALARM
}

/// A result of a run in its unit; none where the scene has no such result.
pub(crate) fn result(of: Quantity, run: &Run, risk_inputs: &RiskInputs) -> Option<f64> {
    let measures = || {
        let value = |of| run.readings.value(of);
        risk_inputs.measures(value(Quantity::Pressure), value(Quantity::ScleralStress))
    };
    // An eye that was not hit is not hurt.
    let unless_missed = |risk: f64| if run.missed { 0.0 } else { risk };
    let value = match of.derived() {
        None => run.readings.value(of)?,
        Some(Derived::Index) => DamageIndex::of(&run.readings).damage(),
        Some(Derived::Risk(injury, measure)) => {
            let value = measures().get(measure)?.value;
            unless_missed(curve_of(injury, measure)?.risk(value))
        }
        Some(Derived::Believed(injury)) => {
            let risk = risk_inputs.believed(injury, &measures(), is_spoiled(run))?;
            unless_missed(risk.risk)
        }
    };
    Some(value * of.row().factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_risk_has_a_curve_and_what_is_made_of_readings_is_the_index_or_a_risk() {
        for of in Quantity::ALL {
            let derived = of.derived();
            assert_eq!(of.is_risk(), derived.is_some_and(|d| d != Derived::Index));
            if let Some(Derived::Risk(injury, measure)) = derived {
                assert!(curve_of(injury, measure).is_some(), "{}", of.key());
            }
        }
    }
}
