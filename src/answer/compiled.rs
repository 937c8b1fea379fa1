//! A scenario compiled: the eye of its model, and what risks rest on beside what a run reads off it.

use crate::answer::believed::Scene;
use crate::answer::derived;
use crate::answer::results::Results;
use crate::models;
use crate::run::kept::{Frame, Keep, Spacing};
use crate::run::model::{EyeModel, Run};
use crate::run::plan::{LOCAL_TOLERANCE, Plan};
use crate::run::refusal::Refusal;
use crate::run::rules::{Automatic, Rules};
use crate::run::watch::Watch;
use crate::scenario::{CheckedScenario, Integrator, Scenario};
use std::ops::ControlFlow;
use std::sync::Arc;

/// More than this takes longer than half an hour.
const MAX_SPRING_EVALUATIONS: f64 = 1e12;

/// A scenario ready to be run; a copy shares the eye.
#[derive(Debug, Clone)]
pub struct Compiled {
    /// The eye and what hits it.
    pub eye: Arc<dyn EyeModel>,
    /// What risks rest on beside what a run reads.
    pub scene: Scene,
}

impl Compiled {
    /// Compiles a scenario.
    pub fn new(scenario: &CheckedScenario) -> Self {
        Self {
            eye: models::compiled(scenario),
            scene: Scene::of(scenario),
        }
    }

    /// The same on the mesh of another level, which may be finer than a scenario may ask for.
    pub(crate) fn at_level(&self, level: u32) -> Self {
        if level == self.level() {
            return self.clone();
        }
        Self {
            eye: self.eye.at_level(level),
            scene: self.scene,
        }
    }

    /// What holds for every scene of the model.
    pub(crate) fn rules(&self) -> &'static Rules {
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
        (self.rules().estimate.order)(integrator)
    }

    /// The integrator and step that a scenario asks for, or the automatic ones of an answer, which
    /// has a second run for its error.
    ///
    /// # Errors
    /// Refuses an integrator that does not solve it and a step that is unstable or would take hours.
    pub fn plan(&self, scenario: &Scenario) -> Result<Plan, Refusal> {
        self.plan_by(scenario, &self.rules().answer)
    }

    /// The same for one run alone, as a mesh error makes it.
    ///
    /// # Errors
    /// As [`Self::plan`].
    pub fn plan_alone(&self, scenario: &Scenario) -> Result<Plan, Refusal> {
        self.plan_by(scenario, &self.rules().alone)
    }

    fn plan_by(&self, scenario: &Scenario, automatic: &Automatic) -> Result<Plan, Refusal> {
        let rules = self.rules();
        let integrator = scenario.numerics.integrator.unwrap_or(automatic.integrator);
        if !rules.integrators.contains(&integrator) {
            let allowed = rules.integrators.iter().map(|i| i.spelling());
            return Err(Refusal::IntegratorUnfit {
                integrator: integrator.name(),
                allowed: allowed.collect::<Vec<_>>().join(", "),
            });
        }
        let (window, limit) = (self.window(), self.step_limit(integrator));
        let step = match scenario.numerics.step_us {
            Some(step_us) if step_us * 1e-6 > limit => {
                return Err(Refusal::StepAboveLimit {
                    step_us,
                    integrator: integrator.name(),
                    limit_us: limit * 1e6,
                });
            }
            Some(step_us) => step_us * 1e-6,
            None => automatic.share * limit,
        };
        let springs = self.eye.elements_per_evaluation() as f64 * rules.springs_an_element;
        let evaluations = integrator.method().evaluations() as f64;
        let work = springs * evaluations * (window / step + 1.0);
        if work > MAX_SPRING_EVALUATIONS {
            let (steps, share) = (window / step, work / MAX_SPRING_EVALUATIONS);
            return Err(match scenario.numerics.step_us {
                Some(step_us) => Refusal::StepTooShort {
                    step_us,
                    steps,
                    least_us: step_us * share,
                },
                None => Refusal::WindowTooLong {
                    window_ms: scenario.window_ms,
                    steps,
                    integrator: integrator.name(),
                    step_us: step * 1e6,
                    longest_ms: scenario.window_ms / share,
                },
            });
        }
        Ok(Plan {
            integrator,
            step,
            window,
            multiple: 1.0,
            local_tolerance: LOCAL_TOLERANCE,
        })
    }

    /// Moves the eye by `plan` and records it under the eyes of `watch`.
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

    /// Every result of a run of it.
    pub fn results(&self, run: &Run) -> Results {
        Results::from_fn(|of| derived::result(of, run, &self.scene))
    }
}
