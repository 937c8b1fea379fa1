//! One scenario compiled: the eye, its load, the rows that the kernel moves, and the step.

use crate::answer::believed::Scene;
use crate::answer::results::Results;
use crate::models::axisymmetric as revolution;
use crate::models::left::Left;
use crate::models::paper::eye::Eye;
use crate::models::paper::forces::coupled::Coupled;
use crate::models::paper::forces::kernel::Survey;
use crate::models::paper::forces::load::{ArcLoad, Piece, Pulse};
use crate::models::paper::forces::scene::SceneKind;
use crate::models::paper::forces::state::State;
use crate::models::paper::forces::system::System;
use crate::models::paper::recording::recorder::Recorder;
use crate::models::paper::recording::{Extremes, Recording};
use crate::models::paper::time::march::{Cost, Diverged, LOCAL_TOLERANCE, Observer, Plan, march};
use crate::models::paper::time::stability;
use crate::run::kept::Keep;
use crate::run::rules::{Automatic, Rules};
use crate::scenario::Integrator;
use crate::scenario::problem::{ScenarioError, plain};
use crate::scenario::{CheckedScenario, Impact, Scenario};
use std::ops::ControlFlow;

/// More than this takes longer than half an hour.
const MAX_SPRING_EVALUATIONS: f64 = 1e12;

/// Why a scenario cannot be run.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Refusal {
    /// What was made of the scenario, as on a finer mesh, is not allowed.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The asked step could blow up.
    #[error(
        "numerics.step_us: {} is above the stability limit of {integrator} on this mesh: \
         allowed up to {}", plain(*step_us), limit(*limit_us, f64::floor)
    )]
    StepAboveLimit {
        /// What was asked, in us.
        step_us: f64,
        /// Name of the integrator.
        integrator: &'static str,
        /// The largest step allowed, in us.
        limit_us: f64,
    },
    /// The asked integrator cannot solve such a scene.
    #[error(
        "numerics.integrator: {integrator} does not solve such a scene (a projectile, or the \
         Physiological model): allowed Auto, {allowed}"
    )]
    IntegratorUnfit {
        /// What was asked.
        integrator: &'static str,
        /// Those that can, with a comma between two.
        allowed: String,
    },
    /// The motion left the finite numbers.
    #[error(transparent)]
    Diverged(#[from] Diverged),
    /// With the step that was asked the run would take hours.
    #[error(
        "numerics.step_us: {} would take {steps:.3e} steps, too many for half an hour: allowed from \
         {} for this window and mesh", plain(*step_us), limit(*least_us, f64::ceil)
    )]
    StepTooShort {
        /// What was asked, in us.
        step_us: f64,
        /// How many steps.
        steps: f64,
        /// The smallest step allowed, in us.
        least_us: f64,
    },
    /// Even by the longest safe step the run would take hours.
    #[error(
        "window_ms: {} would take {steps:.3e} steps, too many for half an hour: stiff springs and small \
         masses keep {integrator} on this mesh to steps of {} us: allowed up to {}, \
         more on a coarser mesh or with softer tissue", plain(*window_ms), limit(*step_us, f64::floor), limit(*longest_ms, f64::floor)
    )]
    WindowTooLong {
        /// What was asked, in ms.
        window_ms: f64,
        /// How many steps.
        steps: f64,
        /// Name of the integrator.
        integrator: &'static str,
        /// Its longest safe step, in us.
        step_us: f64,
        /// The longest window allowed, in ms.
        longest_ms: f64,
    },
    /// The object went through the front of the eye of revolution, for what it is.
    #[error(transparent)]
    Through(ScenarioError),
    /// The eye of revolution gave no result.
    #[error(transparent)]
    Revolution(#[from] revolution::Refusal),
    /// Nothing that was tried is accurate enough.
    #[error("no result within {percent} %: {reason}")]
    ToleranceNotMet {
        /// What was asked, in %.
        percent: f64,
        /// Why not.
        reason: String,
    },
    /// Whoever watched wanted no more of it.
    #[error("cancelled")]
    Cancelled,
}

impl Refusal {
    /// Whether another input would help.
    pub fn is_of_input(&self) -> bool {
        match self {
            Self::Scenario(_)
            | Self::StepAboveLimit { .. }
            | Self::StepTooShort { .. }
            | Self::WindowTooLong { .. }
            | Self::Through(_)
            | Self::IntegratorUnfit { .. } => true,
            Self::Revolution(_)
            | Self::Diverged(_)
            | Self::ToleranceNotMet { .. }
            | Self::Cancelled => false,
        }
    }
}

/// A limit with seven digits, rounded to the side where it may be typed.
fn limit(exact: f64, round: fn(f64) -> f64) -> String {
    let places = (6.0 - libm::log10(exact).floor()).max(0.0);
    let digit = 10_f64.powi(places as i32);
    format!("{:.*}", places as usize, round(exact * digit) / digit)
}

/// Is told the share of the window that has been simulated, now and then, and may stop the run.
pub type Watch<'a> = &'a mut dyn FnMut(f64) -> ControlFlow<()>;

/// A watch that lets everything run.
pub fn unwatched(_: f64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Steps between two calls of a watch.
const STEPS_BETWEEN_CALLS: usize = 64;

/// Passes everything on to a recorder and calls the watch now and then.
struct Watched<'a> {
    recorder: Recorder,
    watch: Watch<'a>,
    window: f64,
    steps: usize,
    cancelled: bool,
}

impl Observer for Watched<'_> {
    fn begin(&mut self, system: &System, state: &State, piece: Piece, survey: &Survey) {
        self.recorder.begin(system, state, piece, survey);
    }

    fn step(&mut self, system: &System, state: &State, piece: Piece, survey: &Survey) {
        self.recorder.step(system, state, piece, survey);
        self.steps += 1;
        if self.steps.is_multiple_of(STEPS_BETWEEN_CALLS) {
            self.cancelled = (self.watch)(state.time / self.window).is_break();
        }
    }

    fn satisfied(&self) -> bool {
        self.cancelled || self.recorder.settled()
    }
}

/// A scenario ready to be moved.
#[derive(Debug, Clone)]
pub struct Case {
    /// The eye.
    pub eye: Eye,
    /// What risks rest on beside what a run leaves.
    pub scene: Scene,
    /// The loaded arc.
    #[doc(hidden)]
    pub load: ArcLoad,
    /// What the kernel moves.
    #[doc(hidden)]
    pub system: System,
    /// Simulated time, in s.
    pub window: f64,
    #[doc(hidden)]
    /// What it starts from: rest, unless a test moves it.
    pub start: State,
}

/// What a plan asks of the eye that it is for.
pub(crate) trait Moved {
    /// What holds for such a scene.
    fn rules(&self) -> &'static Rules;
    /// Largest stable step of `integrator`, in s.
    fn step_limit(&self, integrator: Integrator) -> f64;
    /// What each evaluation of the forces computes.
    fn elements_per_evaluation(&self) -> usize;
    /// How many springs take as long as one of these.
    fn springs_an_element(&self) -> f64;
    /// Simulated time, in s.
    fn window(&self) -> f64;

    /// Order by which the step error of `integrator` is taken to fall.
    fn order(&self, integrator: Integrator) -> i32 {
        let estimate = &self.rules().estimate;
        estimate.order.unwrap_or(integrator.method().order)
    }
}

impl Moved for Case {
    fn rules(&self) -> &'static Rules {
        Rules::of(self.system.kind())
    }

    fn step_limit(&self, integrator: Integrator) -> f64 {
        self.step_limit(integrator)
    }

    fn elements_per_evaluation(&self) -> usize {
        self.system.springs_per_evaluation()
    }

    fn springs_an_element(&self) -> f64 {
        1.0
    }

    fn window(&self) -> f64 {
        self.window
    }
}

/// What one march gave and cost.
#[derive(Debug, Clone)]
pub struct Solution {
    /// Extremes, traces, frames.
    pub recording: Recording,
    /// Steps and force evaluations.
    pub cost: Cost,
    /// Time simulated, in s: less than the window if all results were final before.
    pub simulated: f64,
}

impl Case {
    /// Compiles a scenario.
    pub fn new(scenario: &CheckedScenario) -> Self {
        Self::with(scenario, false, false)
    }

    /// Compiles a scenario; `whole` leaves symmetry unused, `portable` asks for the
    /// kernel that rounds alike everywhere.
    pub fn with(scenario: &CheckedScenario, whole: bool, portable: bool) -> Self {
        let eye = Eye::build(&scenario.eye);
        let (pulse, load) = match &scenario.impact {
            Impact::ForcePulse(pulse) => (Pulse::new(pulse), ArcLoad::new(pulse, &eye)),
            Impact::Projectile(_) => (Pulse::none(), ArcLoad::none()),
        };
        let whole = whole || SceneKind::of(scenario).needs_whole_eye();
        let system = System::new(&eye, pulse, &load, whole, portable);
        let coupled = Coupled::new(scenario, &eye, &system);
        let system = system.with(coupled);
        Self {
            start: State::at_rest(&system),
            scene: Scene::of(scenario),
            eye,
            load,
            system,
            window: scenario.window_ms * 1e-3,
        }
    }

    /// Every result of a march of it.
    pub fn results(&self, extremes: &Extremes) -> Results {
        Results::of(&Left::Section(*extremes), &self.scene)
    }

    /// Largest stable step of `integrator`, in s.
    pub fn step_limit(&self, integrator: Integrator) -> f64 {
        stability::step_limit(integrator, &self.system)
    }

    /// The integrator and step that a scenario asks for, or the automatic ones of an answer, which
    /// has a second run for its error.
    ///
    /// # Errors
    /// Refuses a step above the stability limit.
    pub fn plan(&self, scenario: &Scenario) -> Result<Plan, Refusal> {
        plan_by(self, scenario, &self.rules().answer)
    }

    /// The same for one run alone, as a mesh error makes it.
    ///
    /// # Errors
    /// As [`Self::plan`].
    pub fn plan_alone(&self, scenario: &Scenario) -> Result<Plan, Refusal> {
        plan_by(self, scenario, &self.rules().alone)
    }

    /// Moves the eye by `plan` and records it under the eyes of `watch`.
    ///
    /// # Errors
    /// [`Refusal::Diverged`] if the motion leaves the finite numbers, [`Refusal::Cancelled`] if
    /// the watch stopped it.
    pub fn run(&self, plan: &Plan, keep: Keep, watch: Watch) -> Result<Solution, Refusal> {
        let steps = plan.steps(&self.system.load().pulse);
        let mut observer = Watched {
            recorder: Recorder::new(
                &self.eye,
                &self.load,
                &self.system,
                (self.window, steps),
                keep,
            ),
            watch,
            window: self.window,
            steps: 0,
            cancelled: false,
        };
        let mut state = self.start.clone();
        let cost = march(&self.system, plan, &mut state, &mut observer)?;
        if observer.cancelled {
            return Err(Refusal::Cancelled);
        }
        Ok(Solution {
            recording: observer.recorder.finish(&state),
            cost,
            simulated: state.time,
        })
    }
}

/// The integrator and step that `scenario` asks for on `eye`, or the automatic ones.
pub(crate) fn plan_by(
    eye: &dyn Moved,
    scenario: &Scenario,
    automatic: &Automatic,
) -> Result<Plan, Refusal> {
    let integrator = scenario.numerics.integrator.unwrap_or(automatic.integrator);
    let allowed = eye.rules().integrators;
    if !allowed.contains(&integrator) {
        return Err(Refusal::IntegratorUnfit {
            integrator: integrator.name(),
            allowed: allowed
                .iter()
                .map(|i| i.spelling())
                .collect::<Vec<_>>()
                .join(", "),
        });
    }
    let limit = eye.step_limit(integrator);
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
    let plan = Plan {
        integrator,
        step,
        window: eye.window(),
        multiple: 1.0,
        local_tolerance: LOCAL_TOLERANCE,
    };
    let springs = eye.elements_per_evaluation() as f64 * eye.springs_an_element();
    let work = springs * integrator.method().evaluations() as f64 * (eye.window() / step + 1.0);
    if work > MAX_SPRING_EVALUATIONS {
        let (steps, share) = (eye.window() / step, work / MAX_SPRING_EVALUATIONS);
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
    Ok(plan)
}
