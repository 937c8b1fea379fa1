//! The socket that every model fills: all else asks this trait and the [`Rules`] of the model only.

use crate::run::kept::{Frame, Keep, Spacing, Traces};
use crate::run::plan::{Cost, Plan, plan_by};
use crate::run::{drawing::Drawing, flags::Flag, fold::Fold, places::Region};
use crate::run::{quantity::Quantity, readings::Readings, refusal::Refusal, rules::Rules};
use crate::run::{sectors::Sectors, watch::Watch};
use crate::scenario::{Integrator, Scenario};
use std::fmt::Debug;
use std::ops::ControlFlow;
use std::sync::Arc;

/// An eye of some model and what hits it.
pub trait EyeModel: Debug + Send + Sync {
    /// Integrators, error estimates and mesh rules of the model.
    fn rules(&self) -> &'static Rules;

    /// Simulated time at most, in s.
    fn window(&self) -> f64;

    /// Whether that is only a cap: a run ends when nothing can grow, whatever is kept of it.
    fn ends_by_itself(&self) -> bool {
        false
    }

    /// Refinement level of the mesh.
    fn level(&self) -> u32;

    /// The same on the mesh of another level, which may be finer than a scenario may ask for.
    fn at_level(&self, level: u32) -> Arc<dyn EyeModel>;

    /// The part that each node of a frame belongs to.
    fn regions(&self) -> Vec<Region>;

    /// Nodes of the mesh, of which frames may show a section alone.
    fn nodes(&self) -> usize {
        self.regions().len()
    }

    /// Springs or cells of the mesh.
    fn elements(&self) -> usize;

    /// How many of them each evaluation of the forces computes.
    fn elements_per_evaluation(&self) -> usize {
        self.elements()
    }

    /// Largest stable step of `integrator`, in s, of the eye at rest.
    fn step_limit(&self, integrator: Integrator) -> f64;

    /// The longest step of a plan, in s; where steps follow the motion, the step at rest.
    fn longest_step(&self, plan: &Plan) -> f64 {
        plan.step / plan.multiple
    }

    /// Steps of a plan; where steps follow the motion, those that it would take at rest.
    fn steps(&self, plan: &Plan) -> usize {
        (plan.window * plan.multiple / plan.step).ceil() as usize
    }

    /// The run that tells the step error of `plan`, and the factor from their difference to it.
    fn second_plan(&self, plan: &Plan) -> (Plan, f64) {
        let estimate = &self.rules().estimate;
        let finer = Plan { multiple: plan.multiple * estimate.ratio, ..*plan };
        let share = 1.0 - estimate.ratio.powi(-self.order(plan.integrator));
        (finer, estimate.safety / share)
    }

    /// Moves the eye by `plan` and records it; `watch` may stop it.
    ///
    /// # Errors
    /// Motion that is not finite, an object that goes through the eye, [`Refusal::Cancelled`].
    fn run(&self, plan: &Plan, keep: Keep, watch: Watch) -> Result<Run, Refusal>;

    /// Moves the eye by `plan` and gives every frame to `take`, which may stop it.
    ///
    /// # Errors
    /// As [`Self::run`].
    fn frames(
        &self,
        plan: &Plan,
        spacing: Spacing,
        take: &mut dyn FnMut(Frame) -> ControlFlow<()>,
    ) -> Result<(), Refusal>;

    /// What a picture of the eye is made of.
    fn drawing(&self) -> Drawing;

    /// The integrator and step that a scenario asks for, or the automatic ones of an answer.
    ///
    /// # Errors
    /// Refuses an integrator that does not solve it and a step that is unstable or takes hours.
    fn plan(&self, scenario: &Scenario) -> Result<Plan, Refusal> {
        plan_by(self, scenario, &self.rules().answer)
    }

    /// The plan of one run alone, without a second run for its step error.
    ///
    /// # Errors
    /// As [`Self::plan`].
    fn plan_alone(&self, scenario: &Scenario) -> Result<Plan, Refusal> {
        plan_by(self, scenario, &self.rules().alone)
    }

    /// Order by which the step error of `integrator` is taken to fall.
    fn order(&self, integrator: Integrator) -> i32 {
        (self.rules().estimate.order)(integrator)
    }
}

/// What one run gave and cost.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Run {
    /// What was read off the eye.
    pub readings: Readings,
    /// Figures beside the readings, without an error.
    pub details: Vec<Detail>,
    /// What limits them, as far as this run alone tells.
    pub flags: Vec<Flag>,
    /// How the mesh folded, if it did.
    pub fold: Option<Fold>,
    /// Whether an object never touched the eye.
    pub missed: bool,
    /// Largest error of the balance of energy, as a share of the energy that came in.
    pub energy_residual: f64,
    /// Time simulated, in s: less than the window if all was final before.
    pub simulated: f64,
    /// What tissues felt by clock hour, where the model tells it.
    pub sectors: Option<Sectors>,
    /// Traces, if they were asked for.
    pub traces: Option<Traces>,
    /// Frames, if they were asked for.
    pub frames: Vec<Frame>,
    /// Steps and force evaluations.
    pub cost: Cost,
}

impl Run {
    /// When the mesh folded, in s.
    pub fn folded_at(&self) -> Option<f64> {
        Some(self.fold?.since)
    }

    /// A detail by its key.
    pub fn detail(&self, key: &str) -> Option<f64> {
        let found = self.details.iter().find(|detail| detail.key == key);
        found.map(|detail| detail.value)
    }
}

/// A figure of a run that is no result: it has no error, and few need it.
#[derive(Debug, Clone, PartialEq)]
pub struct Detail {
    /// Name with its unit, as in JSON: a contract.
    pub key: &'static str,
    /// The value in that unit.
    pub value: f64,
    /// Where people read it.
    pub shown: Shown,
}

/// Where people read a detail.
#[derive(Debug, Clone, PartialEq)]
pub enum Shown {
    /// Written to JSON only.
    InData,
    /// On a line of its own: what it is called, and the figure in words.
    OnLine(&'static str, String),
    /// The same of a figure whose error is not known, so to two digits.
    About(&'static str, String),
    /// Behind a result, in these words.
    Behind(Quantity, String),
}

impl Detail {
    /// A figure and where people read it.
    pub fn new(key: &'static str, value: f64, shown: Shown) -> Self {
        Self { key, value, shown }
    }

    /// A figure for programs alone.
    pub fn data(key: &'static str, value: f64) -> Self {
        Self::new(key, value, Shown::InData)
    }
}
