//! The threads that compute for the app, and which effect is for which of them.

use std::sync::mpsc::Sender;

use super::event::Event;
use crate::study::accuracy::Accuracy;
use crate::study::ensemble::Ensemble;
use crate::study::map::Grid;
use crate::study::{Answer, MeshError};
use crate::tui::ensemble::{Sampling, ensemble};
use crate::tui::screens::accuracy::measurement::measure;
use crate::tui::screens::map::state::{Drawing, map};
use crate::tui::update::{Effect, Message};
use crate::tui::worker::{Job, Report, Worker, answer, mesh_error};

/// One thread a kind of work.
pub(super) struct Jobs {
    form: Worker,
    comparison: Worker,
    mesh: Worker,
    accuracy: Worker,
    ensemble: Worker<Sampling>,
    map: Worker<Drawing>,
}

/// A thread whose news reach the loop as messages.
fn worker<Q: Send + 'static, T: Send + 'static>(
    send: &Sender<Event>,
    job: Job<Q, T>,
    wrap: fn(Report<T>) -> Message,
) -> Worker<Q> {
    let send = send.clone();
    Worker::of(job, move |report| {
        // Nobody listens once the app is leaving.
        let _ = send.send(Event::News(wrap(report)));
    })
}

impl Jobs {
    /// Starts all threads; they wait for work.
    pub(super) fn start(send: &Sender<Event>) -> Self {
        Self {
            form: worker::<_, Answer>(send, answer, Message::Form),
            comparison: worker::<_, Answer>(send, answer, Message::Comparison),
            mesh: worker::<_, MeshError>(send, mesh_error, Message::Mesh),
            accuracy: worker::<_, Accuracy>(send, measure, Message::Accuracy),
            ensemble: worker::<_, Ensemble>(send, ensemble, Message::Ensemble),
            map: worker::<_, Grid>(send, map, Message::Map),
        }
    }

    /// Hands an effect to its thread. What is for no thread is left to the loop.
    pub(super) fn perform(&self, effect: Effect) {
        match effect {
            Effect::Solve(ticket, scenario) => {
                self.mesh.cancel(ticket);
                self.form.submit(ticket, scenario);
            }
            Effect::Stop(ticket) => self.form.cancel(ticket),
            Effect::EstimateMesh(ticket, scenario) => self.mesh.submit(ticket, scenario),
            Effect::Compare(ticket, scenario) => self.comparison.submit(ticket, scenario),
            Effect::StopComparing(ticket) => self.comparison.cancel(ticket),
            Effect::Measure(ticket, scenario) => self.accuracy.submit(ticket, scenario),
            Effect::StopMeasuring(ticket) => self.accuracy.cancel(ticket),
            Effect::Sample(ticket, question) => self.ensemble.submit(ticket, question),
            Effect::StopSampling(ticket) => self.ensemble.cancel(ticket),
            Effect::Draw(ticket, question) => self.map.submit(ticket, question),
            Effect::StopDrawing(ticket) => self.map.cancel(ticket),
            Effect::Save(..)
            | Effect::Suspend
            | Effect::Mouse(_)
            | Effect::Repaint
            | Effect::Quit(_) => {}
        }
    }
}
