//! A question for another thread, the request that carries it, and the report that comes back.

use std::any::{Any, TypeId};
use std::fmt;
use std::sync::Arc;
use std::time::Duration;

use crate::run::{refusal::Refusal, watch::Watch};

/// Tells one request from every other; later ones are larger.
pub type Ticket = u64;

/// Something that takes too long to be done between two keys.
pub trait TaskQuestion: Send + Sync + 'static {
    /// What comes of it.
    type Answer: Send + 'static;

    /// Finds the answer, on a thread that all questions of this type share.
    ///
    /// # Errors
    /// Whatever a run refuses, and [`Refusal::Cancelled`] if the watch stops it.
    fn answer(&self, watch: Watch) -> Result<Self::Answer, Refusal>;

    /// Finds the answer as [`Self::answer`] does and hands partial answers to `show` on the way.
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
pub(super) type Anything = Box<dyn Any + Send>;

/// How an answer of any type is found; the second argument is shown parts of it.
type Find = dyn Fn(Watch, &mut dyn FnMut(Anything)) -> Result<Anything, Refusal> + Send + Sync;

/// A question of any type on its way to a worker.
#[derive(Clone)]
pub struct Request {
    /// Its ticket.
    pub ticket: Ticket,
    /// Which worker it is for, and whether nobody asked for it.
    pub kind: (TypeId, bool),
    question: Arc<dyn Any + Send + Sync>,
    find: Arc<Find>,
}

impl fmt::Debug for Request {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "request {}", self.ticket)
    }
}

impl PartialEq for Request {
    fn eq(&self, other: &Self) -> bool {
        self.ticket == other.ticket
    }
}

impl Request {
    /// The request of a question.
    pub fn new<Q: TaskQuestion>(ticket: Ticket, question: Arc<Q>) -> Self {
        let (kind, asked) = ((TypeId::of::<Q>(), question.is_idle()), question.clone());
        let find = move |watch: Watch, show: &mut dyn FnMut(Anything)| {
            let answer = asked.fill_in(watch, &mut |so_far| show(Box::new(so_far)))?;
            Ok(Box::new(answer) as Anything)
        };
        Self { ticket, kind, question, find: Arc::new(find) }
    }

    /// The question, if it is of this type.
    pub fn question<Q: TaskQuestion>(&self) -> Option<&Q> {
        self.question.downcast_ref()
    }

    /// Does the work; `say` is told what there is so far.
    pub fn answered(&self, watch: Watch, say: &dyn Fn(Report)) -> Report {
        let report = |news| Report { ticket: self.ticket, news };
        let mut show = |so_far| say(report(News::SoFar(so_far)));
        report(News::Done((self.find)(watch, &mut show)))
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
        Self { ticket, news: News::Share(share, elapsed) }
    }

    /// This is there already.
    pub fn so_far<Q: TaskQuestion>(ticket: Ticket, answer: Q::Answer) -> Self {
        Self { ticket, news: News::SoFar(Box::new(answer)) }
    }

    /// The work ended so.
    pub fn done<Q: TaskQuestion>(ticket: Ticket, outcome: Result<Q::Answer, Refusal>) -> Self {
        Self { ticket, news: News::Done(outcome.map(|answer| Box::new(answer) as Anything)) }
    }
}
