//! A scenario compiled for the machine that its model needs.
//!
//! Everything that is built from many runs goes through here: what is the same for both eyes is asked of
//! [`Compiled`], and only who draws or measures one of them looks inside.

use crate::answer::believed::Scene;
use crate::answer::results::Results;
use crate::injury::Blow;
use crate::models::axisymmetric;
use crate::models::axisymmetric::case::RevolutionCase;
use crate::models::left::Left;
use crate::models::paper::case::{Case, Moved, Refusal, Solution, Watch, plan_by};
use crate::models::paper::eye::mesh::Region;
use crate::models::paper::flags::Evidence;
use crate::models::paper::recording::Recording;
use crate::models::paper::time::march::{Cost, LOCAL_TOLERANCE, Plan};
use crate::run::flags::Flag;
use crate::run::kept::{Frame, Keep, Spacing, Traces};
use crate::run::raised::TwoRuns;
use crate::run::rules::Rules;
use crate::scenario::Integrator;
use crate::scenario::{CheckedScenario, Scenario};
use std::ops::ControlFlow;

/// A scenario ready to be moved.
#[derive(Debug, Clone)]
pub enum Compiled {
    /// Springs in a section.
    Section(Box<Case>),
    /// A body of revolution.
    Revolution(Box<RevolutionCase>),
}

/// What an eye is made of, and what its work is counted in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Element {
    /// Of a section.
    Spring,
    /// Of a body of revolution.
    Cell,
}

impl Element {
    /// What many are called.
    pub fn plural(self) -> &'static str {
        match self {
            Self::Spring => "springs",
            Self::Cell => "cells",
        }
    }

    /// What the mesh between them, or they themselves, are called where they fold.
    pub(crate) fn quads(self) -> &'static str {
        match self {
            Self::Spring => "quads",
            Self::Cell => "cells",
        }
    }

    /// What one is called.
    pub fn singular(self) -> &'static str {
        match self {
            Self::Spring => "spring",
            Self::Cell => "cell",
        }
    }
}

/// What one run gave and cost.
#[derive(Debug, Clone)]
pub struct Ran {
    /// Its largest values.
    pub left: Left,
    /// Courses, if they were asked for.
    pub traces: Option<Traces>,
    /// Frames, if they were asked for.
    pub frames: Vec<Frame>,
    /// Steps and force evaluations.
    pub cost: Cost,
    /// Time simulated, in s: less than the window if all results were final before.
    pub simulated: f64,
}

impl From<Solution> for Ran {
    fn from(solution: Solution) -> Self {
        let Recording {
            extremes,
            traces,
            frames,
        } = solution.recording;
        Self {
            left: Left::Section(extremes),
            traces,
            frames,
            cost: solution.cost,
            simulated: solution.simulated,
        }
    }
}

impl Compiled {
    /// Compiles a scenario.
    pub fn new(scenario: &CheckedScenario) -> Self {
        match RevolutionCase::new(scenario) {
            Some(case) => Self::Revolution(Box::new(case)),
            None => Self::Section(Box::new(Case::new(scenario))),
        }
    }

    /// The same on the mesh of a level, which for the eye of revolution may be any.
    pub(crate) fn at_level(self, level: u32) -> Self {
        match self {
            Self::Revolution(case) if case.eye.level != level => {
                Self::Revolution(Box::new(case.at_level(level)))
            }
            same => same,
        }
    }

    /// That of a section.
    pub fn section(&self) -> Option<&Case> {
        match self {
            Self::Section(case) => Some(case),
            Self::Revolution(_) => None,
        }
    }

    /// That of a body of revolution.
    pub fn revolution(&self) -> Option<&RevolutionCase> {
        match self {
            Self::Section(_) => None,
            Self::Revolution(case) => Some(case),
        }
    }

    fn moved(&self) -> &dyn Moved {
        match self {
            Self::Section(case) => case.as_ref(),
            Self::Revolution(case) => case.as_ref(),
        }
    }

    /// Simulated time, in s.
    pub fn window(&self) -> f64 {
        self.moved().window()
    }

    /// The object that hits it, if there is one.
    pub fn blow(&self) -> Option<Blow> {
        self.scene().blow
    }

    /// What risks rest on beside what a run leaves.
    pub fn scene(&self) -> &Scene {
        match self {
            Self::Section(case) => &case.scene,
            Self::Revolution(case) => &case.scene,
        }
    }

    /// Refinement level of the mesh.
    pub fn level(&self) -> u32 {
        match self {
            Self::Section(case) => case.eye.level,
            Self::Revolution(case) => case.eye.level,
        }
    }

    /// The part that each node belongs to.
    pub fn regions(&self) -> Vec<Region> {
        match self {
            Self::Section(case) => case.eye.nodes.iter().map(|node| node.region).collect(),
            Self::Revolution(case) => case.eye.node_regions(),
        }
    }

    /// What it is made of, and how many of them.
    pub fn elements(&self) -> (Element, usize) {
        match self {
            Self::Section(case) => (Element::Spring, case.eye.springs.len()),
            Self::Revolution(case) => (Element::Cell, case.eye.cells.len()),
        }
    }

    /// How many of them each evaluation of the forces computes.
    pub fn elements_per_evaluation(&self) -> usize {
        self.moved().elements_per_evaluation()
    }

    /// Largest stable step of `integrator`, in s, of the eye at rest.
    pub fn step_limit(&self, integrator: Integrator) -> f64 {
        self.moved().step_limit(integrator)
    }

    /// What holds for such a scene.
    pub(crate) fn rules(&self) -> &'static Rules {
        self.moved().rules()
    }

    /// Order by which the step error of `integrator` is taken to fall.
    pub fn order(&self, integrator: Integrator) -> i32 {
        self.moved().order(integrator)
    }

    /// The integrator and step that a scenario asks for, or the automatic ones of an answer, which
    /// has a second run for its error.
    ///
    /// # Errors
    /// Refuses an integrator that does not solve it and a step that is unstable or would take hours.
    pub fn plan(&self, scenario: &Scenario) -> Result<Plan, Refusal> {
        plan_by(self.moved(), scenario, &self.rules().answer)
    }

    /// The same for one run alone, as a mesh error makes it.
    ///
    /// # Errors
    /// As [`Self::plan`].
    pub fn plan_alone(&self, scenario: &Scenario) -> Result<Plan, Refusal> {
        plan_by(self.moved(), scenario, &self.rules().alone)
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

    /// The longest step of a plan, in s; at the eye of revolution the step at rest.
    pub fn longest_step(&self, plan: &Plan) -> f64 {
        match self {
            Self::Section(case) => plan.longest_step(&case.system.load().pulse),
            Self::Revolution(_) => plan.step / plan.multiple,
        }
    }

    /// Steps of a plan; at the eye of revolution those that it would take at rest.
    pub(crate) fn steps(&self, plan: &Plan) -> usize {
        match self {
            Self::Section(case) => plan.steps(&case.system.load().pulse),
            Self::Revolution(_) => (plan.window * plan.multiple / plan.step).ceil() as usize,
        }
    }

    /// Moves the eye by `plan` and records it under the eyes of `watch`.
    ///
    /// # Errors
    /// Motion that leaves the finite numbers, an object that goes through the eye, and
    /// [`Refusal::Cancelled`] if the watch stopped it.
    pub fn run(&self, plan: &Plan, keep: Keep, watch: Watch) -> Result<Ran, Refusal> {
        match self {
            Self::Section(case) => Ok(case.run(plan, keep, watch)?.into()),
            Self::Revolution(case) => case.run(plan, keep, watch),
        }
    }

    /// Moves the eye by `plan` and gives every frame to `take` once it is due.
    ///
    /// # Errors
    /// As [`Self::run`]; [`Refusal::Cancelled`] if `take` stopped it.
    pub fn frames(
        &self,
        plan: &Plan,
        spacing: Spacing,
        take: &mut dyn FnMut(Frame) -> ControlFlow<()>,
    ) -> Result<(), Refusal> {
        match self {
            Self::Section(case) => crate::models::paper::frames::frames(case, plan, spacing, take),
            Self::Revolution(case) => case.frames(plan, spacing, take),
        }
    }

    /// Every result of what a run left.
    pub fn results(&self, left: &Left) -> Results {
        Results::of(left, self.scene())
    }

    /// What a reader must know of a run before trusting it.
    pub(crate) fn flags(&self, ran: &Ran, two_runs: Option<TwoRuns>) -> Vec<Flag> {
        match (self, &ran.left) {
            (Self::Section(case), Left::Section(extremes)) => {
                crate::models::paper::flags::raise(&Evidence {
                    case,
                    extremes,
                    two_runs,
                })
            }
            (Self::Revolution(case), Left::Revolution(extremes)) => {
                axisymmetric::flags::raise(case, extremes, ran.simulated, two_runs)
            }
            _ => Vec::new(),
        }
    }
}
