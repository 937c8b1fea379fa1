//! A scenario ready to be run: the eye of its model, and what its risks need.

use crate::answer::results::Results;
use crate::injury::{Blow, DamageIndex, Felt, Injury, PerInjury, Population, told};
use crate::models;
use crate::run::model::{EyeModel, Run};
use crate::run::plan::{LOCAL_TOLERANCE, Plan};
use crate::run::quantity::Quantity;
use crate::scenario::{CheckedScenario, Integrator, Scenario};
use std::ops::Deref;
use std::sync::Arc;

/// A scenario ready to be run; a copy shares the eye.
#[derive(Debug, Clone)]
pub struct Compiled {
    /// The eye and what hits it.
    pub eye: Arc<dyn EyeModel>,
    /// What the scenario says for its risks; the rest are readings of a run. None of an eye without
    /// tissues.
    pub blow: Option<Blow>,
}

impl Compiled {
    /// Compiles a scenario.
    pub fn new(scenario: &CheckedScenario) -> Self {
        Self::with(models::compiled(scenario), scenario)
    }

    /// A scenario with an eye that somebody else compiled of it.
    pub fn with(eye: Arc<dyn EyeModel>, scenario: &Scenario) -> Self {
        Self { eye, blow: Blow::of_tissues(scenario) }
    }

    /// This scenario on the mesh of `level`, which may be finer than a scenario may ask for.
    pub(crate) fn at_level(&self, level: u32) -> Self {
        if level == self.level() {
            return self.clone();
        }
        Self { eye: self.eye.at_level(level), blow: self.blow }
    }

    /// An integrator at a share of its stability limit, on the scenario's own window.
    pub(crate) fn plan_at(&self, integrator: Integrator, share: f64) -> Plan {
        Plan {
            integrator,
            step: share * self.step_limit(integrator),
            window: self.window(),
            multiple: 1.0,
            local_tolerance: LOCAL_TOLERANCE,
        }
    }

    /// A result of a run of this scenario in its unit; none where the scene has no such result.
    pub fn result(&self, of: Quantity, run: &Run) -> Option<f64> {
        let value = match Injury::of(of) {
            // An eye that was not hit is not hurt.
            Some(_) if run.missed => 0.0,
            Some(injury) => told(self.blow.as_ref()?, injury, &self.felt(run)?),
            None if of == Quantity::Damage => DamageIndex::of(&run.readings).damage(),
            None => run.readings.value(of)?,
        };
        Some(value * of.row().factor)
    }

    /// The share by which what a tissue felt may be wrong on a mesh other than the one that the
    /// points of 50 % were fitted on.
    pub fn mesh_error(&self, injury: Injury) -> f64 {
        if self.level() > 1 { injury.curve().mesh_unknown } else { 0.0 }
    }

    /// What the tissues felt in a run of this scenario, as if its steps made no error.
    pub fn felt(&self, run: &Run) -> Option<Felt> {
        let way_in = self.blow.as_ref()?.way_in;
        if run.missed {
            // An eye that was not hit is not hurt.
            let measures = PerInjury::default();
            return Some(Felt { measures, errors: measures, way_in: None, weight: 1.0 });
        }
        let mut measures = PerInjury::default();
        for (measure, injury) in measures.iter_mut().zip(Injury::ALL) {
            *measure = run.readings.value(injury.measure())?;
        }
        let living = self.blow.is_some_and(|blow| blow.population == Population::Living);
        let section = living && run.sectors.is_none();
        let errors = std::array::from_fn(|j| {
            let injury = Injury::ALL[j];
            let of_section = if section { injury.curve().section_unknown } else { 0.0 };
            libm::hypot(self.mesh_error(injury), of_section)
        });
        Some(Felt { measures, errors, way_in, weight: 1.0 })
    }

    /// Every result of a run of this scenario.
    pub fn results(&self, run: &Run) -> Results {
        Results::from_fn(|of| self.result(of, run))
    }
}

/// It is asked like its eye.
impl Deref for Compiled {
    type Target = dyn EyeModel;

    fn deref(&self) -> &Self::Target {
        &*self.eye
    }
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
