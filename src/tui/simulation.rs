//! The answer to the form: asked for at every edit, and its mesh error once nothing newer is
//! wanted.

use crate::answer::mesh_error::{MeshError, MeshQuery};
use crate::answer::solve::{Answer, solve};
use crate::run::kept::{Keep, Spacing};
use crate::run::refusal::Refusal;
use crate::run::watch::Watch;
use crate::scenario::{Impact, Scenario};
use crate::tui::request::TaskQuestion;

/// Frames that a replay keeps.
const FRAMES: f64 = 400.0;
/// The time in which most happens after a short blow, in s.
const LIVELY: f64 = 5e-3;
/// The time of the first half of them in a run whose end is not known, in s.
const EARLY: f64 = 0.8e-3;
/// Numbers of nodes times frames that a replay may keep: some 100 MB.
const MAX_KEPT: f64 = 4e6;

/// Asks for the answer to a scenario, with all that the screens show.
#[derive(Debug)]
pub struct Simulate(pub Scenario);

impl TaskQuestion for Simulate {
    type Answer = Answer;

    fn answer(&self, watch: Watch) -> Result<Answer, Refusal> {
        solve(&self.0.check()?, keep(&self.0), watch)
    }
}

/// Asks for the mesh error of the answer on show.
#[derive(Debug)]
pub struct EstimateMesh {
    /// What was answered.
    pub scenario: Scenario,
    /// What of the answer matters.
    pub query: MeshQuery,
}

impl TaskQuestion for EstimateMesh {
    type Answer = MeshError;

    fn answer(&self, watch: Watch) -> Result<MeshError, Refusal> {
        self.query.estimate(&self.scenario, watch)
    }

    fn is_idle(&self) -> bool {
        true
    }
}

/// Whether two scenarios have one answer: neither a title nor the doubt in an input changes a
/// single run.
pub(super) fn is_alike(a: &Scenario, b: &Scenario) -> bool {
    let same = Scenario {
        name: b.name.clone(),
        doubt: b.doubt.clone(),
        ..a.clone()
    };
    same == *b
}

/// In a long window half of the frames fall into the time in which most happens.
fn spacing(scenario: &Scenario, frames: f64) -> Spacing {
    let Some(window) = scenario.known_window_ms().map(|ms| ms * 1e-3) else {
        // All of them by 3.2 ms, and a quarter more each time that it lasts twice as long.
        let early = (0.5 * frames).round();
        return Spacing::doubling(early as u32, EARLY / early);
    };
    let pulse = match &scenario.impact {
        Impact::ForcePulse(pulse) => pulse.duration_ms * 1e-3,
        Impact::Projectile(_) => 0.0,
    };
    let lively = LIVELY.max(2.0 * pulse);
    if window < 2.0 * lively {
        return Spacing::even(window / frames);
    }
    let early = (0.5 * frames).round();
    Spacing {
        early: early as u32,
        early_every: lively / early,
        every: (window - lively) / (frames - early),
        doubles: false,
    }
}

/// Everything that the screens show; fewer frames of a mesh too fine to keep them all.
pub fn keep(scenario: &Scenario) -> Keep {
    let side = 15.0 * f64::from(scenario.eye.level) + 1.0;
    let frames = FRAMES.min(MAX_KEPT / (side * side)).max(20.0);
    Keep {
        traces: true,
        frames: Some(spacing(scenario, frames)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::quantity::Quantity;
    use crate::run::watch::unwatched;

    #[test]
    fn the_mesh_error_needs_no_second_answer() {
        let scenario = Scenario::default();
        let answer = Simulate(scenario.clone()).answer(&mut unwatched).unwrap();
        let query = MeshQuery::of(&answer);
        let question = EstimateMesh { scenario, query };
        let damage = question.answer(&mut unwatched).unwrap().errors[Quantity::Damage].unwrap();
        assert!((20.0..40.0).contains(&damage), "{damage}");
    }
}
