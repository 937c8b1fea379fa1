//! The Paper model behind the trait that every model fills.

use crate::models::paper::time::march::{at_least_steps, longest_step, steps, steps_in};
use crate::models::paper::time::method::Method;
use crate::models::paper::{case::PaperCase, drawing, flags, readings, rules::RULES};
use crate::models::pulse::Piece;
use crate::run::kept::{Frame, Keep, Spacing};
use crate::run::model::{EyeModel, Run};
use crate::run::rules::{LONGEST_SHARE, Rules};
use crate::run::{drawing::Drawing, places::Region, plan::Plan, refusal::Refusal, watch::Watch};
use crate::scenario::Integrator;
use std::ops::ControlFlow;
use std::sync::Arc;

impl EyeModel for PaperCase {
    fn rules(&self) -> &'static Rules {
        &RULES
    }

    fn window(&self) -> f64 {
        self.window
    }

    fn level(&self) -> u32 {
        self.eye.level
    }

    fn at_level(&self, level: u32) -> Arc<dyn EyeModel> {
        Arc::new(self.on_level(level))
    }

    fn regions(&self) -> Vec<Region> {
        self.eye.nodes.iter().map(|node| node.region).collect()
    }

    fn elements(&self) -> usize {
        self.eye.springs.len()
    }

    fn elements_per_evaluation(&self) -> usize {
        self.system.springs_per_evaluation
    }

    fn step_limit(&self, integrator: Integrator) -> f64 {
        Method::of(integrator).step_limit(&self.system)
    }

    fn longest_step(&self, plan: &Plan) -> f64 {
        longest_step(plan, &self.system.pulse)
    }

    fn steps(&self, plan: &Plan) -> usize {
        steps(plan, &self.system.pulse)
    }

    fn second_plan(&self, plan: &Plan) -> (Plan, f64) {
        let order = self.order(plan.integrator);
        let (ratio, safety) = (RULES.estimate.ratio, RULES.estimate.safety);
        let segments = self.system.pulse.segments(plan.window);
        let coarser = Plan { step: plan.step * ratio, ..*plan };
        let finer = Plan {
            multiple: plan.multiple * ratio,
            local_tolerance: plan.local_tolerance * 0.1,
            ..*plan
        };
        let counted = |plan: &Plan, loaded: bool| -> usize {
            let held = segments.iter().filter(|s| !loaded || s.piece != Piece::Nothing);
            held.map(|s| steps_in(plan, s)).sum()
        };
        // A coarser run is cheaper; it tells nothing if load or short segments take the same steps.
        let telling = |loaded: bool| {
            counted(plan, loaded) as f64 > 0.5 * (1.0 + ratio) * counted(&coarser, loaded) as f64
        };
        let longest = LONGEST_SHARE * self.step_limit(plan.integrator);
        let coarser_tells = coarser.step <= longest * (1.0 + 1e-9)
            && !segments.iter().any(|s| at_least_steps(&coarser, s))
            && telling(true)
            && telling(false);
        if plan.integrator.chooses_its_steps() {
            // Its error follows the tolerance, or the longest step; a finer run shows both.
            (finer, safety)
        } else if coarser_tells {
            (coarser, safety / (ratio.powi(order) - 1.0))
        } else {
            let gains =
                segments.iter().map(|s| steps_in(&finer, s) as f64 / steps_in(plan, s) as f64);
            let least = gains.fold(f64::INFINITY, f64::min);
            (finer, safety / (1.0 - least.powi(-order)))
        }
    }

    fn run(&self, plan: &Plan, keep: Keep, watch: Watch) -> Result<Run, Refusal> {
        let recording = self.record(plan, keep, watch)?;
        let extremes = &recording.extremes;
        Ok(Run {
            readings: readings::of(extremes),
            details: readings::details(self, extremes),
            flags: flags::raise(self, extremes),
            fold: extremes.fold,
            energy_residual: extremes.energy_residual,
            simulated: recording.simulated,
            traces: recording.traces,
            frames: recording.frames,
            cost: recording.cost,
            ..Run::default()
        })
    }

    fn frames(
        &self,
        plan: &Plan,
        spacing: Spacing,
        take: &mut dyn FnMut(Frame) -> ControlFlow<()>,
    ) -> Result<(), Refusal> {
        let keep = Keep { traces: false, frames: Some(spacing) };
        // The steps of the plan that was found good: the same digits as those that it kept.
        self.follow(plan, keep, |recorder, _| recorder.taken().try_for_each(&mut *take))?;
        Ok(())
    }

    fn drawing(&self) -> Drawing {
        drawing::of(self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::solve::tests::answered_with;
    use crate::scenario::library::tests::preset;

    #[test]
    fn the_same_frames_come_one_by_one_as_are_kept() {
        let spacing = Spacing::even(1e-5);
        let keep = Keep { traces: false, frames: Some(spacing) };
        let kept = answered_with(&preset("paper-300n", &[("window_ms", "0.2")]), keep);
        let mut streamed = Vec::new();
        let take = &mut |frame| {
            streamed.push(frame);
            ControlFlow::Continue(())
        };
        kept.case.frames(&kept.plan, spacing, take).unwrap();
        assert_eq!(streamed.len(), 21);
        assert_eq!(streamed, kept.run.frames);
        let stop = &mut |_| ControlFlow::Break(());
        assert!(matches!(kept.case.frames(&kept.plan, spacing, stop), Err(Refusal::Cancelled)));
    }
}
