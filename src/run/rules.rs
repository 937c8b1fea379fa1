//! How a model is solved and how its errors are told: one row for each model.
//!
//! The step error comes from a second run whose step differs by a ratio r (Richardson's
//! extrapolation). For a method of order p the difference of the two is about (r^p - 1) times the
//! error of the finer run, and (1 - r^-p) times that of the coarser. Peaks seldom follow the order
//! exactly, hence a safety factor and a floor. `contrecoup verify steps` measures how often the
//! claims hold. The numbers stand with their reasons in the `rules` of each model.

use crate::run::quantity::{Family, Quantity};
use crate::run::{flags::FlagKind, refusal::Refusal};
use crate::scenario::Integrator;

/// The largest share of its stability limit, one of a linear eye, that a run takes on its own.
pub(crate) const LONGEST_SHARE: f64 = 0.95;

/// Integrators, error estimates and mesh rules that all scenes of one model share.
#[derive(Debug)]
pub struct Rules {
    /// What the model is called.
    pub name: &'static str,
    /// What its mesh is made of.
    pub element: Element,
    /// How many springs take as long to compute as one of these.
    pub springs_an_element: f64,
    /// The integrators that solve it.
    pub integrators: &'static [Integrator],
    /// What an answer takes, which has a second run for its error.
    pub answer: Automatic,
    /// What one run alone takes, as a mesh error makes it.
    pub alone: Automatic,
    /// The integrator of a reference solution on the same mesh.
    pub reference: Integrator,
    /// Whether a run among many may take longer steps than an answer's, up to [`LONGEST_SHARE`].
    pub may_lengthen: bool,
    /// The step error that runs among many keep to, in %.
    pub promise_percent: f64,
    /// Whether each step follows the motion; the step of a plan is that of the eye at rest.
    pub step_follows_motion: bool,
    /// How the step error is told.
    pub estimate: Estimate,
    /// When an automatic step is shortened.
    pub refinement: Refinement,
    /// How finer meshes tell the mesh error.
    pub mesh: MeshRules,
    /// Why a run may end before its window, in a few words.
    pub ends_early: &'static str,
    /// What to do where a flag says that the motion cannot be believed; none of other flags.
    pub advice: fn(FlagKind) -> Option<&'static str>,
    /// Said in place of the risks of injury where the readings can tell none.
    pub silence: &'static str,
}

impl Rules {
    /// Why an integrator is refused that does not solve the model.
    pub(crate) fn unfit(&self, integrator: Integrator) -> Refusal {
        let allowed = self.integrators.iter().map(|i| i.spelling());
        Refusal::IntegratorUnfit {
            integrator: integrator.name(),
            model: self.name,
            allowed: allowed.collect::<Vec<_>>().join(", "),
        }
    }
}

/// An integrator and its step, where nobody asks for others.
#[derive(Debug, Clone, Copy)]
pub struct Automatic {
    /// The method.
    pub integrator: Integrator,
    /// Its step as a share of its stability limit.
    pub share: f64,
}

/// From the difference of two runs to a stated error.
#[derive(Debug)]
pub struct Estimate {
    /// Ratio r of the two steps.
    pub ratio: f64,
    /// Order p by which the error of an integrator is taken to fall.
    pub order: fn(Integrator) -> i32,
    /// Multiplies the estimate.
    pub safety: f64,
    /// Multiplies the estimate from a run of twice as many steps.
    pub doubled_safety: f64,
    /// No result is claimed to be better than this, in %.
    pub floor_percent: f64,
    /// Two runs may give the same peak by chance, so no result of this family, which come from the
    /// same motion, is claimed to be better than this share of the worst of them.
    pub family: (Family, f64),
}

/// When an automatic step is shortened, and how often.
#[derive(Debug)]
pub struct Refinement {
    /// Largest step error of a leading result that is left as it is, in %.
    pub error_percent: f64,
    /// Largest energy residual that is, folded or not, in %.
    pub balance_percent: f64,
    /// How often, at most to a half each time.
    pub attempts: usize,
}

impl Refinement {
    /// What is left is flagged.
    pub(crate) const WHILE_A_PERSON_WAITS: Self =
        Self { error_percent: 1.0, balance_percent: 0.5, attempts: 2 };
}

/// How meshes of a model tell the mesh error; see `answer::mesh_error`.
#[derive(Debug)]
pub struct MeshRules {
    /// The finest level that a scenario may ask for.
    pub finest: u32,
    /// The finest level that a study of accuracy measures.
    pub finest_in_study: u32,
    /// The two levels that tell the error of a level, the finer last.
    pub witnesses: fn(u32) -> [u32; 2],
    /// How fine the mesh of a level is: the inverse of the width of its cells, in any unit.
    pub fineness: fn(u32) -> f64,
    /// How a result scatters from level to level.
    pub scatter: fn(Quantity) -> MeshScatter,
}

/// How a result behaves as the mesh gets finer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshScatter {
    /// By this share of it level 3 may lie off the limit though its neighbours agree.
    pub share: f64,
    /// The order by which that falls at finer levels.
    pub order: i32,
    /// Or by so much, in its unit, where it is small.
    pub least: f64,
    /// Two levels that differ by a larger share than this tell no limit.
    pub apart: f64,
}

impl MeshScatter {
    /// A scatter of this share that falls with the first order.
    pub const fn within(share: f64, apart: f64) -> Self {
        Self { order: 1, share, least: 0.0, apart }
    }
}

/// What a mesh is made of, and what its work is counted in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
pub enum Element {
    /// Between two point masses.
    Spring,
    /// With a volume and a pressure.
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

    /// What one is called.
    pub fn singular(self) -> &'static str {
        self.into()
    }
}

/// The share of a step that should bring an `error` that falls with `order` to `target`.
pub(crate) fn share_for(target: f64, error: f64, order: i32) -> f64 {
    libm::pow(target / error, 1.0 / f64::from(order))
}

/// The share of its step that a run with too large an `error` takes next: less than should do.
pub(crate) fn next_share(target: f64, error: f64, order: i32) -> f64 {
    (0.8 * share_for(target, error, order)).clamp(0.5, 0.8)
}
