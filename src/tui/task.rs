//! Work for another thread: what was asked, how far it is, and why it gave nothing.
//!
//! Whoever needs such work says what its [`TaskQuestion`] is and keeps a [`Task`]. The question
//! goes out as a [`Request`] with a ticket, and reports come back to whoever holds the ticket. One
//! on work that was given up finds nobody and is dropped.

use std::sync::Arc;

use crate::report::pace::Pace;
use crate::tui::outbox::{Effect, Outbox};
use crate::tui::request::{Anything, News, Report, Request, TaskQuestion, Ticket};

/// What is under way.
#[derive(Debug)]
pub struct Job<Q> {
    /// Its ticket.
    pub ticket: Ticket,
    /// What was asked.
    pub question: Arc<Q>,
    /// How much of it is done and how long the rest takes, once the worker has said so.
    pub pace: Option<Pace>,
    /// Whether it was asked to end with what it has.
    pub ending: bool,
}

/// One thing at a time that a pane waits for.
#[derive(Debug)]
pub struct Task<Q> {
    /// What is under way.
    pub job: Option<Job<Q>>,
    /// Why the last one gave no answer, or not a whole one, and what was asked.
    pub complaint: Option<(Arc<Q>, String)>,
}

impl<Q> Default for Task<Q> {
    fn default() -> Self {
        Self { job: None, complaint: None }
    }
}

impl<Q: TaskQuestion> Task<Q> {
    /// Asks; what was under way is given up.
    pub fn ask(&mut self, question: Q, out: &mut Outbox) {
        out.ticket += 1;
        let question = Arc::new(question);
        out.effects.push(Effect::Start(Request::new(out.ticket, question.clone())));
        self.complaint = None;
        self.job = Some(Job { ticket: out.ticket, question, pace: None, ending: false });
    }

    /// Gives up what is under way and says why; whether anything was.
    pub fn stop(&mut self, why: Option<&str>, out: &mut Outbox) -> bool {
        let Some(job) = self.job.take() else { return false };
        out.effects.push(Effect::Stop(job.ticket));
        self.complaint = why.map(|why| (job.question, why.to_owned()));
        true
    }

    /// Has what is under way end with what it has; whether anything is.
    pub fn end(&mut self, out: &mut Outbox) -> bool {
        let Some(job) = &mut self.job else { return false };
        job.ending = true;
        out.effects.push(Effect::Stop(job.ticket));
        true
    }

    /// Takes the report if it is of what is under way; gives what there is of the answer: so far,
    /// while a job is there still, else in the end. A refusal is kept as the complaint.
    pub fn take_report(
        &mut self,
        report: &mut Option<Report>,
    ) -> Option<(Arc<Q>, Option<Q::Answer>)> {
        let job = self.job.as_mut()?;
        let own = |any: Anything| any.downcast().ok().map(|answer| *answer);
        let outcome = match report.take_if(|report| report.ticket == job.ticket)?.news {
            News::Share(share, elapsed) => {
                job.pace.get_or_insert_default().advance(share, elapsed);
                return None;
            }
            // A ticket is given to one question, so the answer is of its type.
            News::SoFar(answer) => return Some((job.question.clone(), own(answer))),
            News::Done(outcome) => outcome,
        };
        let question = self.job.take()?.question;
        match outcome {
            Ok(answer) => Some((question, own(answer))),
            Err(refusal) => {
                self.complaint = Some((question.clone(), refusal.to_string()));
                Some((question, None))
            }
        }
    }

    /// How far what is under way is, in words: of so many, where it is counted.
    pub fn pace(&self, of: Option<usize>) -> Option<String> {
        Some(self.job.as_ref()?.pace.unwrap_or_default().words(of))
    }
}
