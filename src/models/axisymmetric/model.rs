//! The axisymmetric model behind the trait that every model fills.

use crate::models::axisymmetric as engine;
use crate::models::axisymmetric::{case::AxisymmetricCase, eye::AxisymmetricEye, rules::RULES};
use crate::models::axisymmetric::{drawing, flags, readings};
use crate::run::kept::{Frame, Keep, Spacing};
use crate::run::model::{EyeModel, Run};
use crate::run::plan::{Cost, Plan};
use crate::run::{drawing::Drawing, places::Region, refusal::Refusal, rules::Rules, watch::Watch};
use crate::scenario::Integrator;
use std::ops::ControlFlow;
use std::sync::Arc;

impl EyeModel for AxisymmetricCase {
    fn rules(&self) -> &'static Rules {
        &RULES
    }

    fn window(&self) -> f64 {
        self.window.most()
    }

    fn ends_by_itself(&self) -> bool {
        matches!(self.window, engine::Until::Settled(_))
    }

    fn level(&self) -> u32 {
        self.eye.level
    }

    fn at_level(&self, level: u32) -> Arc<dyn EyeModel> {
        let eye = AxisymmetricEye::new(&self.eye.parameters, level);
        Arc::new(Self { limit: engine::step_limit(&eye, &self.load), eye, ..self.clone() })
    }

    fn regions(&self) -> Vec<Region> {
        self.eye.node_regions()
    }

    fn elements(&self) -> usize {
        self.eye.cells.len()
    }

    fn step_limit(&self, _: Integrator) -> f64 {
        self.limit
    }

    fn run(&self, plan: &Plan, keep: Keep, watch: Watch) -> Result<Run, Refusal> {
        let steps = engine::Steps::by(plan, self.limit, &RULES)?;
        let run =
            engine::run(&self.eye, &self.load, self.window.within(plan.window), steps, keep, watch);
        let run = run.map_err(|stop| self.refused(stop))?;
        let extremes = &run.extremes;
        let readings = readings::of(extremes);
        Ok(Run {
            details: readings::details(extremes),
            flags: flags::raise(self, extremes, &readings, run.simulated),
            readings,
            fold: extremes.fold,
            missed: extremes.missed(),
            energy_residual: extremes.energy_residual,
            sectors: None,
            simulated: run.simulated,
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
        let steps = engine::Steps::by(plan, self.limit, &RULES)?;
        engine::run_through(
            &self.eye,
            &self.load,
            self.window.within(plan.window),
            steps,
            spacing,
            take,
        )
        .map_err(|stop| self.refused(stop))
    }

    fn drawing(&self) -> Drawing {
        drawing::of(self)
    }
}
