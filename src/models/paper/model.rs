//! The Paper model behind the trait that every model fills.

use crate::models::paper::time::{second, stability};
use crate::models::paper::{case::PaperCase, rules::RULES};
use crate::models::paper::{drawing, flags, frames, readings};
use crate::run::kept::{Frame, Keep, Spacing};
use crate::run::model::{EyeModel, Run};
use crate::run::watch::Watch;
use crate::run::{drawing::Drawing, places::Region, plan::Plan, refusal::Refusal, rules::Rules};
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
        self.system.springs_per_evaluation()
    }

    fn step_limit(&self, integrator: Integrator) -> f64 {
        stability::step_limit(integrator, &self.system)
    }

    fn longest_step(&self, plan: &Plan) -> f64 {
        plan.longest_step(&self.system.load().pulse)
    }

    fn steps(&self, plan: &Plan) -> usize {
        plan.steps(&self.system.load().pulse)
    }

    fn second_plan(&self, plan: &Plan) -> (Plan, f64) {
        second::plan(self, plan)
    }

    fn run(&self, plan: &Plan, keep: Keep, watch: Watch) -> Result<Run, Refusal> {
        let recording = self.record(plan, keep, watch)?;
        let extremes = &recording.extremes;
        Ok(Run {
            readings: readings::of(extremes),
            details: readings::details(self, extremes),
            flags: flags::raise(self, extremes),
            fold: extremes.fold,
            missed: false,
            energy_residual: extremes.energy_residual,
            sectors: None,
            simulated: recording.simulated,
            traces: recording.traces,
            frames: recording.frames,
            cost: recording.cost,
        })
    }

    fn frames(
        &self,
        plan: &Plan,
        spacing: Spacing,
        take: &mut dyn FnMut(Frame) -> ControlFlow<()>,
    ) -> Result<(), Refusal> {
        frames::frames(self, plan, spacing, take)
    }

    fn drawing(&self) -> Drawing {
        drawing::of(self)
    }
}
