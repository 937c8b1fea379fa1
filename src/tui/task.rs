//! Work for another thread: what was asked, how far it is, and why it gave nothing.
//!
//! A pane that needs such work says what its [`Question`] is and keeps a [`Task`]. The question
//! goes out as a [`Request`] with a ticket, a worker answers it, and the [`Report`] comes back to
//! whoever holds the ticket; late news of what was given up finds nobody and is dropped.

use std::any::{Any, TypeId};
use std::fmt;
use std::sync::Arc;

use super::update::Effect;
use crate::study::{Refusal, Watch};

/// Tells one request from every other; later ones are larger.
pub type Ticket = u64;

/// Something that takes too long to be done between two keys.
pub trait Question: fmt::Debug + Send + Sync + 'static {
    /// What comes of it.
    type Answer: Send + 'static;

    /// Finds the answer, on a thread that all questions of this type share.
    ///
    /// # Errors
    /// Whatever a run refuses, and [`Refusal::Cancelled`] if the watch stops it.
    fn answer(&self, watch: Watch) -> Result<Self::Answer, Refusal>;
}

/// An answer of a type that only its question knows.
type Anything = Box<dyn Any + Send>;

/// A question whatever its type.
trait AnyQuestion: fmt::Debug + Send + Sync {
    fn find(&self, watch: Watch) -> Result<Anything, Refusal>;
    fn as_any(&self) -> &dyn Any;
}

impl<Q: Question> AnyQuestion for Q {
    fn find(&self, watch: Watch) -> Result<Anything, Refusal> {
        Ok(Box::new(self.answer(watch)?))
    }

    fn as_any(&self) -> &dyn Any {
        self
    }
}

/// A question on its way to a worker.
#[derive(Debug, Clone)]
pub struct Request {
    /// Its ticket.
    pub ticket: Ticket,
    question: Arc<dyn AnyQuestion>,
}

impl PartialEq for Request {
    fn eq(&self, other: &Self) -> bool {
        self.ticket == other.ticket
    }
}

impl Request {
    /// The request of a question.
    pub fn new<Q: Question>(ticket: Ticket, question: Arc<Q>) -> Self {
        Self { ticket, question }
    }

    /// The question, if it is of this type.
    pub fn question<Q: Question>(&self) -> Option<&Q> {
        self.question.as_any().downcast_ref()
    }

    /// Tells the worker that it is for: a newer request of a kind takes the place of an older one.
    pub fn kind(&self) -> TypeId {
        self.question.as_any().type_id()
    }

    /// Does the work.
    pub fn answered(&self, watch: Watch) -> Report {
        Report {
            ticket: self.ticket,
            news: News::Done(self.question.find(watch)),
        }
    }
}

/// What a worker says of a request.
#[derive(Debug)]
pub struct Report {
    pub(super) ticket: Ticket,
    pub(super) news: News,
}

#[derive(Debug)]
pub(super) enum News {
    /// This share is done.
    Share(f64),
    /// The work ended so.
    Done(Result<Anything, Refusal>),
}

impl Report {
    /// This share of the work is done, from 0 to 1.
    pub fn progress(ticket: Ticket, share: f64) -> Self {
        let news = News::Share(share);
        Self { ticket, news }
    }

    /// The work ended so.
    pub fn done<Q: Question>(ticket: Ticket, outcome: Result<Q::Answer, Refusal>) -> Self {
        let news = News::Done(outcome.map(|answer| Box::new(answer) as Anything));
        Self { ticket, news }
    }
}

/// What goes out of the model: requests, and the tickets of those to be given up.
#[derive(Debug, Default)]
pub struct Outbox {
    /// What is to be done, in this order.
    pub effects: Vec<Effect>,
    /// The last ticket given out.
    pub ticket: Ticket,
}

/// What is under way.
#[derive(Debug)]
pub struct Job<Q> {
    /// Its ticket.
    pub ticket: Ticket,
    /// What was asked.
    pub question: Arc<Q>,
    /// How much of it is done, once the worker has said so.
    pub share: Option<f64>,
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
        Self {
            job: None,
            complaint: None,
        }
    }
}

impl<Q: Question> Task<Q> {
    /// Asks; what was under way is given up.
    pub fn ask(&mut self, question: Q, out: &mut Outbox) {
        out.ticket += 1;
        let question = Arc::new(question);
        let request = Request::new(out.ticket, question.clone());
        out.effects.push(Effect::Start(request));
        self.complaint = None;
        self.job = Some(Job {
            ticket: out.ticket,
            question,
            share: None,
            ending: false,
        });
    }

    /// Gives up what is under way and says why; whether anything was.
    pub fn stop(&mut self, why: Option<&str>, out: &mut Outbox) -> bool {
        let Some(job) = self.job.take() else {
            return false;
        };
        out.effects.push(Effect::Stop(job.ticket));
        self.complaint = why.map(|why| (job.question, why.to_owned()));
        true
    }

    /// Has what is under way end with what it has; whether anything is.
    pub fn end(&mut self, out: &mut Outbox) -> bool {
        let Some(job) = &mut self.job else {
            return false;
        };
        job.ending = true;
        out.effects.push(Effect::Stop(job.ticket));
        true
    }

    /// Takes the report if it is of what is under way; gives what came of it once it has ended. Why
    /// something was refused is kept as the complaint.
    pub fn hear(&mut self, report: &mut Option<Report>) -> Option<(Arc<Q>, Option<Q::Answer>)> {
        let job = self.job.as_mut()?;
        let outcome = match report.take_if(|report| report.ticket == job.ticket)?.news {
            News::Share(share) => {
                job.share = Some(share);
                return None;
            }
            News::Done(outcome) => outcome,
        };
        let question = self.job.take()?.question;
        match outcome {
            // A ticket is given to one question, so the answer is of its type.
            Ok(answer) => Some((question, answer.downcast().ok().map(|answer| *answer))),
            Err(refusal) => {
                self.complaint = Some((question.clone(), refusal.to_string()));
                Some((question, None))
            }
        }
    }

    /// The share of what is under way that is done, in %.
    pub fn percent(&self) -> Option<f64> {
        let job = self.job.as_ref()?;
        Some(100.0 * job.share.unwrap_or(0.0))
    }
}
