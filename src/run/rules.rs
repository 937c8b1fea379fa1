//! How each kind of scene is solved and how its step error is told: one row for each kind.
//!
//! The step error comes from a second run whose step differs by a ratio r (Richardson's
//! extrapolation). For a method of order p the difference of the two is about (r^p - 1) times the error
//! of the finer run, and (1 - r^-p) times that of the coarser. Results seldom follow the order exactly,
//! peaks least of all, so the estimate is multiplied by a safety factor, and no result is claimed to
//! be better than what two runs may share by chance. `verify` measures how often the claims hold.
//!
//! Every number that decides about steps and their errors stands here with its reason.

use crate::answer::quantity::Family;
use crate::models::axisymmetric::time::run::STEP_SHARE;
use crate::models::paper::forces::scene::SceneKind;
use crate::scenario::Integrator;

/// The largest share of its stability limit that any run takes on its own account: the limit is of a
/// linear eye, and a step just below it would forgive nothing.
pub(crate) const LONGEST_SHARE: f64 = 0.95;

/// What holds for one kind of scene.
#[derive(Debug)]
pub(crate) struct Rules {
    /// The integrators that solve it.
    pub integrators: &'static [Integrator],
    /// What an answer takes, which has a second run for its error.
    pub answer: Automatic,
    /// What one run alone takes, as a batch and a mesh error make it.
    pub alone: Automatic,
    /// The integrator of a reference solution on the same mesh.
    pub reference: Integrator,
    /// Whether a run among many may take longer steps than an answer's, up to [`LONGEST_SHARE`].
    pub may_lengthen: bool,
    /// The step error that runs among many keep to, in %.
    pub promise_percent: f64,
    /// How the step error is told.
    pub estimate: Estimate,
    /// When an automatic step is shortened.
    pub refinement: Refinement,
}

/// An integrator and its step, where nobody asks for others.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Automatic {
    /// The method.
    pub integrator: Integrator,
    /// Its step as a share of its stability limit.
    pub share: f64,
}

/// From the difference of two runs to a stated error.
#[derive(Debug)]
pub(crate) struct Estimate {
    /// Ratio r of the two steps.
    pub ratio: f64,
    /// Order p by which the error is taken to fall, where it is not the integrator's own.
    pub order: Option<i32>,
    /// Multiplies the estimate.
    pub safety: f64,
    /// No result is claimed to be better than this.
    pub floor: Floor,
    /// Two runs may give the same peak by chance though neither is right. Results of this family come
    /// from the same motion, so none is claimed to be better than this share of the worst of them.
    pub family: (Family, f64),
}

/// The least error that is stated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Floor {
    /// In %.
    Percent(f64),
    /// In % at the stability limit, and in proportion to a shorter step.
    PercentAtLimit(f64),
}

/// When an automatic step is shortened, and how often.
#[derive(Debug)]
pub(crate) struct Refinement {
    /// Largest step error of a leading result that is left as it is, in %.
    pub error_percent: f64,
    /// Largest energy residual that is, folded or not, in %.
    pub balance_percent: f64,
    /// Largest step error that is where the mesh folded, in %; none where no step helps then.
    pub folded_percent: Option<f64>,
    /// How often, at most to a half each time.
    pub attempts: usize,
}

impl Rules {
    /// The rules of a kind of scene.
    pub fn of(kind: SceneKind) -> &'static Self {
        match kind {
            SceneKind::Springs => &SPRINGS,
            SceneKind::Contact => &CONTACT,
        }
    }
}

/// The share of a step that should bring an `error` that falls with `order` to `target`.
pub(crate) fn share_for(target: f64, error: f64, order: i32) -> f64 {
    libm::pow(target / error, 1.0 / f64::from(order))
}

static SPRINGS: Rules = Rules {
    integrators: Integrator::ALL,
    // The share leaves room for a second, coarser run below the limit.
    answer: Automatic {
        integrator: Integrator::Srkn6b,
        share: SHARE_OF_ANSWER,
    },
    // As accurate at the same cost, with fewer and longer steps to record.
    alone: Automatic {
        integrator: Integrator::Srkn11b,
        share: LONGEST_SHARE,
    },
    reference: Integrator::Srkn11b,
    // The automatic step is wasteful both ways among many runs: too short for the accuracy of a stiff
    // eye, too long for the pulse on a soft one.
    may_lengthen: true,
    promise_percent: PROMISE_PERCENT,
    estimate: Estimate {
        // The longest step that a run takes against an answer's.
        ratio: LONGEST_SHARE / SHARE_OF_ANSWER,
        order: None,
        // With 5 and the family's share the stated errors hold in more than 95 % of random scenes for
        // each result and are 5 to 9 times the true ones in the median.
        safety: 5.5,
        // Rounding and the search for peaks end here.
        floor: Floor::Percent(1e-6),
        // The same waves pass the three nodes of the shell. The force at the centre is far smoother,
        // and really is better.
        family: (Family::ShellForces, 0.03),
    },
    refinement: REFINEMENT,
};

const SHARE_OF_ANSWER: f64 = 0.8;

/// Far below what is not known of an eye, and cheap where a method is of high order.
const PROMISE_PERCENT: f64 = 0.1;

const REFINEMENT: Refinement = Refinement {
    error_percent: 1.0,
    balance_percent: 0.5,
    folded_percent: None,
    // A person waits, and what is left is flagged.
    attempts: 4,
};

static CONTACT: Rules = Rules {
    // The others ask for forces that depend on positions alone, or for smooth ones.
    integrators: &[Integrator::VelocityVerlet],
    // Of second order, so its steps stay far below the limit.
    answer: CONTACT_ANSWER,
    alone: CONTACT_ANSWER,
    reference: Integrator::VelocityVerlet,
    may_lengthen: false,
    promise_percent: PROMISE_PERCENT,
    estimate: Estimate {
        ratio: 2.0,
        // A contact's force has a kink at touch and sends out sharp waves.
        order: Some(1),
        // Order two is mostly seen, so the worst stated error is mostly several times the true one.
        safety: 3.0,
        // Where within a step the contact begins and ends is chance, which two runs may share. At a
        // share of 0.3 it was seen to be worth 0.01 to 0.2 %.
        floor: Floor::PercentAtLimit(1.0),
        // All results but the node forces come from the same motion.
        family: (Family::Motion, 0.2),
    },
    refinement: Refinement {
        // Results of a mesh that folds under an object scatter anyway.
        folded_percent: Some(3.0),
        ..REFINEMENT
    },
};

const CONTACT_ANSWER: Automatic = Automatic {
    integrator: Integrator::VelocityVerlet,
    share: 0.3,
};

/// The eye of revolution. Its leapfrog is velocity Verlet with forces of viscosity that lag half a step, and its
/// step follows the stability bound, so a step is that of the eye at rest. Semi-implicit Euler is there to be compared
/// with.
pub(crate) static REVOLUTION: Rules = Rules {
    integrators: &[Integrator::VelocityVerlet, Integrator::SemiImplicitEuler],
    answer: REVOLUTION_ANSWER,
    alone: REVOLUTION_ANSWER,
    reference: Integrator::VelocityVerlet,
    may_lengthen: false,
    promise_percent: 1.0,
    estimate: Estimate {
        ratio: 1.5,
        // The lag makes the error fall with the first order.
        order: Some(1),
        // Peaks of contact are less regular than that.
        safety: 2.0,
        // Each step is chosen by the state, so results are not smooth to the last digit.
        floor: Floor::Percent(0.05),
        family: (Family::Motion, 0.1),
    },
    refinement: REFINEMENT,
};

const REVOLUTION_ANSWER: Automatic = Automatic {
    integrator: Integrator::VelocityVerlet,
    share: STEP_SHARE,
};
