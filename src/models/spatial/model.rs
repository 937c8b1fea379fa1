//! The eye in three dimensions behind the trait that every model fills.

use crate::models::axisymmetric;
use crate::models::axisymmetric::time::{march::Steps, until::Until};
use crate::models::spatial as engine;
use crate::models::spatial::{case::SpatialCase, recording::section::Section, rules::RULES};
use crate::models::spatial::{drawing, flags, readings};
use crate::run::kept::{Frame, Keep, Spacing};
use crate::run::model::{EyeModel, Run};
use crate::run::plan::{Cost, Plan};
use crate::run::{drawing::Drawing, places::Region, refusal::Refusal, rules::Rules, watch::Watch};
use crate::scenario::Integrator;
use std::ops::ControlFlow;
use std::sync::Arc;

impl EyeModel for SpatialCase {
    fn rules(&self) -> &'static Rules {
        &RULES
    }

    fn window(&self) -> f64 {
        self.window.most()
    }

    fn ends_by_itself(&self) -> bool {
        matches!(self.window, Until::Settled(_))
    }

    fn level(&self) -> u32 {
        self.eye.level
    }

    fn at_level(&self, level: u32) -> Arc<dyn EyeModel> {
        Arc::new(self.on_level(level))
    }

    /// Those of the points of the section, which frames tell of.
    fn regions(&self) -> Vec<Region> {
        let section = Section::new(&self.eye, &self.blow);
        section.points.iter().map(|shown| shown.region).collect()
    }

    fn elements(&self) -> usize {
        self.eye.cells.len()
    }

    fn step_limit(&self, _: Integrator) -> f64 {
        self.limit
    }

    fn run(&self, plan: &Plan, keep: Keep, watch: Watch) -> Result<Run, Refusal> {
        let steps = Steps::by(plan, self.limit, &RULES)?;
        let window = self.window.within(plan.window);
        let run = engine::run(&self.eye, &self.blow, window, steps, keep, watch);
        let run = run.map_err(|stop| self.refused(stop))?;
        let extremes = &run.extremes;
        let readings = axisymmetric::readings::of(&extremes.common);
        Ok(Run {
            details: readings::details(self, extremes, run.simulated),
            flags: flags::raise(self, extremes, &readings, run.simulated),
            readings,
            fold: extremes.common.fold,
            missed: extremes.common.missed(),
            energy_residual: extremes.common.energy_residual,
            simulated: run.simulated,
            sectors: Some(extremes.sectors),
            traces: run.traces,
            frames: run.frames,
            cost: Cost { steps: run.steps, evaluations: run.steps + 1 },
        })
    }

    fn frames(
        &self,
        plan: &Plan,
        spacing: Spacing,
        take: &mut dyn FnMut(Frame) -> ControlFlow<()>,
    ) -> Result<(), Refusal> {
        let steps = Steps::by(plan, self.limit, &RULES)?;
        let window = self.window.within(plan.window);
        engine::run_through(&self.eye, &self.blow, window, steps, spacing, take)
            .map_err(|stop| self.refused(stop))
    }

    fn drawing(&self) -> Drawing {
        drawing::of(self)
    }
}
