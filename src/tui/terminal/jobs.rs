//! The threads that compute for the app: one for each kind of question, begun when first asked.

use std::any::TypeId;
use std::collections::HashMap;
use std::sync::mpsc::Sender;

use super::event::Event;
use crate::tui::task::{Request, Ticket};
use crate::tui::update::Message;
use crate::tui::worker::Worker;

/// One thread a kind of question.
pub(super) struct Jobs {
    send: Sender<Event>,
    workers: HashMap<TypeId, Worker>,
}

impl Jobs {
    /// No threads yet; what they will say goes to `send`.
    pub(super) fn new(send: Sender<Event>) -> Self {
        let workers = HashMap::new();
        Self { send, workers }
    }

    /// Hands a request to the thread of its kind.
    pub(super) fn start(&mut self, request: Request) {
        let send = &self.send;
        let worker = self.workers.entry(request.kind()).or_insert_with(|| {
            let send = send.clone();
            Worker::start(move |report| {
                // Nobody listens once the app is leaving.
                let _ = send.send(Event::News(Message::News(report)));
            })
        });
        worker.submit(request);
    }

    /// Stops the request of a ticket, whichever thread has it.
    pub(super) fn stop(&self, ticket: Ticket) {
        for worker in self.workers.values() {
            worker.cancel(ticket);
        }
    }
}
