//! Work for another thread: what was asked, how far it is, and why it gave nothing.
//!
//! A pane that needs such work says what its [`Question`] is and keeps a [`Task`]. The question
//! goes out as a [`Request`] with a ticket, a worker answers it, and the [`Report`] comes back to
//! whoever holds the ticket: what there is so far, and what came of it in the end. Late news of what was given
//! up finds nobody and is dropped.

use std::any::{Any, TypeId};
use std::fmt;
use std::sync::Arc;
use std::time::Duration;

use crate::report::pace::Pace;
use crate::run::refusal::Refusal;
use crate::run::watch::Watch;
use crate::tui::update::Effect;

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

    /// The same for work that fills in: `show` is told what there is so far.
    ///
    /// # Errors
    /// As [`Self::answer`].
    fn fill_in(
        &self,
        watch: Watch,
        show: &mut dyn FnMut(Self::Answer),
    ) -> Result<Self::Answer, Refusal> {
        let _ = show;
        self.answer(watch)
    }

    /// Whether nobody asked for it: then it gives way to everything else.
    fn is_idle(&self) -> bool {
        false
    }
}

/// An answer of a type that only its question knows.
type Anything = Box<dyn Any + Send>;

/// A question whatever its type.
trait AnyQuestion: fmt::Debug + Send + Sync {
    fn find(&self, watch: Watch, show: &mut dyn FnMut(Anything)) -> Result<Anything, Refusal>;
    fn is_idle(&self) -> bool;
    fn as_any(&self) -> &dyn Any;
}

impl<Q: Question> AnyQuestion for Q {
    fn find(&self, watch: Watch, show: &mut dyn FnMut(Anything)) -> Result<Anything, Refusal> {
        let answer = self.fill_in(watch, &mut |so_far| show(Box::new(so_far)))?;
        Ok(Box::new(answer))
    }

    fn is_idle(&self) -> bool {
        Question::is_idle(self)
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

    /// Tells the worker that it is for: a newer request of a kind takes the place of an older one. Whether
    /// nobody asked for it is the second part.
    pub fn kind(&self) -> (TypeId, bool) {
        (self.question.as_any().type_id(), self.question.is_idle())
    }

    /// Does the work; `say` is told what there is so far.
    pub fn answered(&self, watch: Watch, say: &dyn Fn(Report)) -> Report {
        let ticket = self.ticket;
        let mut show = |so_far| {
            let news = News::SoFar(so_far);
            say(Report { ticket, news });
        };
        Report {
            ticket,
            news: News::Done(self.question.find(watch, &mut show)),
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
    /// This share is done, so long after the beginning.
    Share(f64, Duration),
    /// This is there already.
    SoFar(Anything),
    /// The work ended so.
    Done(Result<Anything, Refusal>),
}

impl Report {
    /// This share of the work is done, from 0 to 1, so long after the beginning.
    pub fn progress(ticket: Ticket, share: f64, elapsed: Duration) -> Self {
        let news = News::Share(share, elapsed);
        Self { ticket, news }
    }

    /// This is there already.
    pub fn so_far<Q: Question>(ticket: Ticket, answer: Q::Answer) -> Self {
        let news = News::SoFar(Box::new(answer));
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
            pace: None,
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

    /// Takes the report if it is of what is under way; gives what there is of the answer: so far, while a job
    /// is there still, else in the end. Why something was refused is kept as the complaint.
    pub fn hear(&mut self, report: &mut Option<Report>) -> Option<(Arc<Q>, Option<Q::Answer>)> {
        let job = self.job.as_mut()?;
        let own = |any: Anything| any.downcast().ok().map(|answer| *answer);
        let outcome = match report.take_if(|report| report.ticket == job.ticket)?.news {
            News::Share(share, elapsed) => {
                job.pace.get_or_insert_default().hear(share, elapsed);
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
        let job = self.job.as_ref()?;
        Some(job.pace.unwrap_or_default().words(of))
    }
}
