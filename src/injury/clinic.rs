//! Who comes to a clinic after a blow, and what is found in those who come.
//!
//! With `r_j` the chance that a blow brings injury j about, and `w_j` the chance that somebody with
//! it alone comes for it, `none = (1 - c) prod_j (1 - w_j r_j)` stay at home, c being those who
//! come with nothing. Of those who come the share with j is
//! `seen_j r_j (1 - (1 - w_j) none/(1 - w_j r_j)) / (1 - none)`, where `seen_j` says how much of it
//! is found and written down. Over several blows both sides are means.
//!
//! The chances are judged. Left out: that injuries hang together beyond what one blow makes of
//! them.

use crate::injury::kind::{Injury, PerInjury};
use serde::Deserialize;

/// Where eyes were counted.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Setting {
    /// An eye emergency or a whole region: everybody who came.
    WalkIn,
    /// Those who were referred or admitted.
    Referred,
    /// Eyes of donors and animals, hit on purpose.
    Laboratory,
}

/// The chances of one setting.
struct Selection {
    comes: PerInjury<f64>,
    seen: PerInjury<f64>,
    with_nothing: f64,
}

const WALK_IN: Selection = Selection {
    comes: [1.0, 0.7, 0.5, 1.0, 0.95, 0.6],
    seen: [1.0, 0.8, 0.5, 0.9, 0.95, 0.9],
    with_nothing: 0.03,
};
const REFERRED: Selection = Selection {
    comes: [1.0, 0.7, 0.7, 1.0, 0.9, 0.1],
    seen: [1.0, 0.8, 0.8, 0.95, 0.95, 0.8],
    with_nothing: 0.002,
};
/// Every eye is looked at.
const LABORATORY: Selection = Selection {
    comes: [1.0; Injury::ALL.len()],
    seen: [1.0; Injury::ALL.len()],
    with_nothing: 1.0,
};

/// Of eyes that were hit: how many come, and how many come and have each injury, 0 to 1.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Coming {
    /// With or without an injury.
    pub all: f64,
    /// With each of them.
    pub with: PerInjury<f64>,
}

/// By how much [`Coming`] changes with the chance of each injury.
pub struct ComingSlopes {
    /// Of all.
    pub all: PerInjury<f64>,
    /// Of those with an injury (first) by the chance of another.
    pub with: [PerInjury<f64>; Injury::ALL.len()],
}

impl Setting {
    const fn selection(self) -> &'static Selection {
        match self {
            Self::WalkIn => &WALK_IN,
            Self::Referred => &REFERRED,
            Self::Laboratory => &LABORATORY,
        }
    }

    /// How much of each injury is found and written down, 0 to 1.
    pub fn seen(self) -> &'static PerInjury<f64> {
        &self.selection().seen
    }

    /// Those who come of eyes with such chances.
    pub fn coming(self, risks: &PerInjury<f64>) -> Coming {
        let comes = &self.selection().comes;
        let with =
            std::array::from_fn(|j| risks[j] * (1.0 - (1.0 - comes[j]) * self.stays(risks, &[j])));
        Coming { all: 1.0 - self.stays(risks, &[]), with }
    }

    /// By how much they change.
    pub fn slopes(self, risks: &PerInjury<f64>) -> ComingSlopes {
        let comes = &self.selection().comes;
        ComingSlopes {
            all: std::array::from_fn(|i| comes[i] * self.stays(risks, &[i])),
            with: std::array::from_fn(|j| {
                std::array::from_fn(|i| {
                    if i == j {
                        1.0 - (1.0 - comes[j]) * self.stays(risks, &[j])
                    } else {
                        risks[j] * (1.0 - comes[j]) * comes[i] * self.stays(risks, &[i, j])
                    }
                })
            }),
        }
    }

    /// The share that stays at home, but for what some injuries do to it.
    fn stays(self, risks: &PerInjury<f64>, but: &[usize]) -> f64 {
        let Selection { comes, with_nothing, .. } = self.selection();
        let each = (0..risks.len()).filter(|j| !but.contains(j));
        (1.0 - with_nothing) * each.map(|j| 1.0 - comes[j] * risks[j]).product::<f64>()
    }
}
