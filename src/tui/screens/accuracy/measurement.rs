//! Speed against error as the app holds it: a measurement, how it is chosen from, and its job.
//!
//! It belongs to a scenario apart from the scenario's own integrator and step, which are what it is
//! there to choose.

use std::sync::Arc;

use crate::scenario::{NumericsInput, Scenario};
use crate::study::accuracy::{Accuracy, Point, measure};
use crate::study::{Refusal, Watch};
use crate::tui::step::Step;
use crate::tui::task::{Question, Report, Task};

/// The finest mesh that the app compares levels with; finer ones take long.
const FINEST: u32 = 2;
/// Where the cursor begins: the cheapest point for this one of the targets, 1 %.
const FIRST: usize = 1;

/// Asks for a measurement.
#[derive(Debug, Clone, PartialEq)]
pub struct MeasureAccuracy(Scenario);

impl MeasureAccuracy {
    /// The measurement for a scenario.
    pub fn of(scenario: &Scenario) -> Self {
        Self(Scenario {
            // No name would be refused.
            name: "any".to_owned(),
            numerics: NumericsInput::default(),
            ..scenario.clone()
        })
    }
}

impl Question for MeasureAccuracy {
    type Answer = Accuracy;

    fn answer(&self, watch: Watch) -> Result<Accuracy, Refusal> {
        measure(&self.0.check()?, FINEST, watch)
    }
}

/// A measurement that is done.
#[derive(Debug)]
pub struct Measured {
    /// What was asked.
    pub question: Arc<MeasureAccuracy>,
    /// What came of it.
    pub report: Accuracy,
    /// Indices of the points that can be drawn, from the fastest to the slowest.
    pub order: Vec<usize>,
}

/// All that the screen knows.
#[derive(Debug, Default)]
pub struct Measurement {
    /// The last one that was finished.
    pub measured: Option<Measured>,
    /// The one under way.
    pub task: Task<MeasureAccuracy>,
    /// Which point is named, counted in time.
    pub cursor: usize,
}

impl Measurement {
    /// Takes in what a worker says of it.
    pub fn hear(&mut self, report: &mut Option<Report>) {
        if let Some((question, Some(accuracy))) = self.task.hear(report) {
            self.take(question, accuracy);
        }
    }

    /// Puts the cursor on a good choice of a new measurement.
    fn take(&mut self, question: Arc<MeasureAccuracy>, report: Accuracy) {
        let mut order: Vec<usize> = (0..report.points.len())
            .filter(|&i| report.points[i].error().is_finite())
            .collect();
        order.sort_by(|&a, &b| {
            let seconds = |i: usize| report.points[i].seconds;
            seconds(a).total_cmp(&seconds(b))
        });
        let good = report.best[FIRST];
        let found = order.iter().position(|i| Some(*i) == good);
        self.cursor = found.unwrap_or(0);
        self.measured = Some(Measured {
            question,
            report,
            order,
        });
    }

    /// Whether what is on show was measured for another scenario.
    pub fn is_stale(&self, scenario: &Scenario) -> bool {
        let asked = MeasureAccuracy::of(scenario);
        let other = |measured: &Measured| *measured.question != asked;
        self.measured.as_ref().is_some_and(other)
    }

    /// The point under the cursor.
    pub fn chosen(&self) -> Option<&Point> {
        let measured = self.measured.as_ref()?;
        let index = measured.order.get(self.cursor)?;
        measured.report.points.get(*index)
    }

    /// Moves the cursor to the next point, or by a large step to the next one of the front.
    pub fn step(&mut self, step: Step) {
        let Some(measured) = &self.measured else {
            return;
        };
        let fits = |at: &usize| {
            let index = measured.order[*at];
            !step.coarse || measured.report.points[index].on_front
        };
        let next = if step.up {
            (self.cursor + 1..measured.order.len()).find(fits)
        } else {
            (0..self.cursor).rev().find(fits)
        };
        self.cursor = next.unwrap_or(self.cursor);
    }
}

/// The scenario solved as a point was. The step is rounded down to six digits.
pub fn adopted(scenario: &Scenario, point: &Point) -> Scenario {
    let step = point.plan.step * 1e6;
    let power = 10f64.powi(5 - step.log10().floor() as i32);
    Scenario {
        numerics: NumericsInput {
            integrator: Some(point.plan.integrator),
            step_us: Some((step * power).floor() / power),
        },
        ..scenario.clone()
    }
}
