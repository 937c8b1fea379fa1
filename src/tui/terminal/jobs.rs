//! The threads that compute for the app: one for each kind of question, begun when first asked.

use std::any::TypeId;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::io;
use std::sync::mpsc::SyncSender;
use std::time::Duration;

use crate::tui::request::{Request, Ticket};
use crate::tui::{app::update::Message, terminal::event::Event, worker::Worker};

/// One thread a kind of question.
pub(super) struct Jobs {
    send: SyncSender<Event>,
    /// How long one answer may take.
    limit: Option<Duration>,
    workers: HashMap<(TypeId, bool), Worker>,
}

impl Jobs {
    /// No threads yet; what they will say goes to `send`. What takes longer than `limit` is
    /// stopped.
    pub(super) fn new(send: SyncSender<Event>, limit: Option<Duration>) -> Self {
        Self { send, limit, workers: HashMap::new() }
    }

    /// Hands a request to the thread of its kind.
    pub(super) fn start(&mut self, request: Request) -> io::Result<()> {
        let kind = request.kind();
        let worker = match self.workers.entry(kind) {
            Entry::Occupied(there) => there.into_mut(),
            Entry::Vacant(none) => {
                let send = self.send.clone();
                // Nobody listens once the app is leaving.
                let tell = move |report| drop(send.send(Event::News(Message::News(report))));
                none.insert(Worker::start(self.limit, kind.1, tell)?)
            }
        };
        worker.submit(request);
        Ok(())
    }

    /// Stops the request of a ticket, whichever thread has it.
    pub(super) fn stop(&self, ticket: Ticket) {
        for worker in self.workers.values() {
            worker.cancel(ticket);
        }
    }
}
