//! A scenario ready to be run: the eye of its model, and the inputs of its risks.

use crate::answer::believed::RiskInputs;
use crate::answer::derived;
use crate::answer::results::Results;
use crate::models;
use crate::run::kept::{Frame, Keep, Spacing};
use crate::run::model::{EyeModel, Run};
use crate::run::plan::{LOCAL_TOLERANCE, Plan};
use crate::run::refusal::Refusal;
use crate::run::rules::Rules;
use crate::run::watch::Watch;
use crate::scenario::{CheckedScenario, Integrator, Scenario};
use std::ops::ControlFlow;
use std::sync::Arc;

/// A scenario ready to be run; a copy shares the eye.
#[derive(Debug, Clone)]
pub struct Compiled {
    /// The eye and what hits it.
    pub eye: Arc<dyn EyeModel>,
    /// What the scenario gives for risks; the rest are readings of a run.
    pub risk_inputs: RiskInputs,
}

impl Compiled {
    /// Compiles a scenario.
    pub fn new(scenario: &CheckedScenario) -> Self {
        Self::with(models::compiled(scenario), scenario)
    }

    /// A scenario with an eye that somebody else compiled of it.
    pub fn with(eye: Arc<dyn EyeModel>, scenario: &Scenario) -> Self {
        Self {
            eye,
            risk_inputs: RiskInputs::of(scenario),
        }
    }

    /// This scenario on the mesh of `level`, which may be finer than a scenario may ask for.
    pub(crate) fn at_level(&self, level: u32) -> Self {
        if level == self.level() {
            return self.clone();
        }
        Self {
            eye: self.eye.at_level(level),
            risk_inputs: self.risk_inputs,
        }
    }

    /// The rules of the model: its limits, integrators, errors and words.
    pub fn rules(&self) -> &'static Rules {
        self.eye.rules()
    }

    /// Simulated time, in s.
    pub fn window(&self) -> f64 {
        self.eye.window()
    }

    /// Refinement level of the mesh.
    pub fn level(&self) -> u32 {
        self.eye.level()
    }

    /// Largest stable step of `integrator`, in s, of the eye at rest.
    pub fn step_limit(&self, integrator: Integrator) -> f64 {
        self.eye.step_limit(integrator)
    }

    /// Order by which the step error of `integrator` is taken to fall.
    pub fn order(&self, integrator: Integrator) -> i32 {
        self.eye.order(integrator)
    }

    /// The integrator and step that a scenario asks for, or the automatic ones of an answer, which
    /// has a second run for its error.
    ///
    /// # Errors
    /// Refuses an integrator that does not solve it and a step that is unstable or would take
    /// hours.
    pub fn plan(&self, scenario: &Scenario) -> Result<Plan, Refusal> {
        self.eye.plan(scenario)
    }

    /// The integrator and step of a run without a second one, as mesh errors use it.
    ///
    /// # Errors
    /// As [`Self::plan`].
    pub fn plan_alone(&self, scenario: &Scenario) -> Result<Plan, Refusal> {
        self.eye.plan_alone(scenario)
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

    /// Runs the eye by `plan` and records it; `watch` is told the share done and may stop it.
    ///
    /// # Errors
    /// As [`EyeModel::run`].
    pub fn run(&self, plan: &Plan, keep: Keep, watch: Watch) -> Result<Run, Refusal> {
        self.eye.run(plan, keep, watch)
    }

    /// Moves the eye by `plan` and gives every frame to `take` once it is due.
    ///
    /// # Errors
    /// As [`EyeModel::frames`].
    pub fn frames(
        &self,
        plan: &Plan,
        spacing: Spacing,
        take: &mut dyn FnMut(Frame) -> ControlFlow<()>,
    ) -> Result<(), Refusal> {
        self.eye.frames(plan, spacing, take)
    }

    /// Every result of a run of this scenario, in the unit of each.
    pub fn results(&self, run: &Run) -> Results {
        Results::from_fn(|of| derived::result(of, run, &self.risk_inputs))
    }
}
