//! The answer to the form, asked for at every edit, and the mesh error of its figures, which is
//! estimated while nothing else is wanted.

use crate::answer::mesh_error::{MeshError, MeshQuery};
use crate::answer::solve::{Answer, solve};
use crate::run::kept::{Keep, Spacing};
use crate::run::{refusal::Refusal, watch::Watch};
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

/// Asks for the mesh error of an answer.
#[derive(Debug)]
pub struct Complete {
    /// What was answered.
    pub scenario: Scenario,
    mesh: MeshQuery,
}

impl Complete {
    /// The question for the answer to a scenario; none where it is known, or takes too long as in
    /// three dimensions.
    pub fn of(scenario: &Scenario, answer: &Answer) -> Option<Self> {
        let open = answer.errors.mesh.is_none() && !scenario.is_spatial();
        open.then(|| Self { scenario: scenario.clone(), mesh: MeshQuery::of(answer) })
    }
}

impl TaskQuestion for Complete {
    type Answer = MeshError;

    fn answer(&self, watch: Watch) -> Result<MeshError, Refusal> {
        self.mesh.estimate(&self.scenario, watch)
    }

    fn is_idle(&self) -> bool {
        true
    }
}

/// Whether two scenarios have one answer, which no title changes, and a doubt only of an object.
pub(super) fn is_alike(a: &Scenario, b: &Scenario) -> bool {
    let doubt = if a.projectile().is_some() { &a.doubt } else { &b.doubt };
    let same = Scenario { name: b.name.clone(), doubt: doubt.clone(), ..a.clone() };
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
    let (early_every, every) = (lively / early, (window - lively) / (frames - early));
    Spacing { early: early as u32, early_every, every, doubles: false }
}

/// Everything that the screens show; fewer frames of a mesh too fine to keep them all.
pub fn keep(scenario: &Scenario) -> Keep {
    let side = 15.0 * f64::from(scenario.eye.level) + 1.0;
    let frames = FRAMES.min(MAX_KEPT / (side * side)).max(20.0);
    Keep { traces: true, frames: Some(spacing(scenario, frames)) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::run::watch::unwatched;
    use crate::scenario::library::tests::preset;

    #[test]
    fn risks_are_final_when_they_appear_and_only_flat_and_axisymmetric_eyes_have_a_mesh_error() {
        for (name, open) in [("bb-56", true), ("paper-300n", true), ("squash-ball", false)] {
            let scenario = preset(name, &[("window_ms", "0.1")]);
            let mut answer = Simulate(scenario.clone()).answer(&mut unwatched).unwrap();
            let before = answer.risks();
            let question = Complete::of(&scenario, &answer);
            assert_eq!(question.is_some(), open);
            let Some(question) = question else { continue };
            answer.add(question.answer(&mut unwatched).unwrap());
            assert!(answer.risks() == before && Complete::of(&scenario, &answer).is_none());
        }
    }

    #[test]
    fn a_doubt_about_an_object_is_another_answer_and_a_title_is_not() {
        let bb = preset("bb-56", &[]);
        let doubted = preset("bb-56", &[("impact.speed_m_s", "56 ± 5")]);
        let titled = Scenario { name: "other".to_owned(), ..bb.clone() };
        assert!(is_alike(&bb, &titled) && !is_alike(&bb, &doubted));
        let paper = preset("paper-300n", &[]);
        assert!(is_alike(&paper, &preset("paper-300n", &[("impact.force_n", "300 ± 20")])));
    }
}
