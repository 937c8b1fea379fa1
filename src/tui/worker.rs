//! The threads that simulate while the app stays awake.
//!
//! Each runs one job and holds at most one more; a newer job takes the place of the held one and
//! stops the running one. Each job has a ticket, by which a late answer is known.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::thread;
use std::time::{Duration, Instant};

use crate::recording::{Keep, Spacing};
use crate::scenario::{Impact, Scenario};
use crate::study::{Answer, MeshError, MeshQuery, Refusal, Watch, solve};

/// Progress is reported this often at most, and not at all by runs that are shorter.
const REPORT_EVERY: Duration = Duration::from_millis(150);
/// Frames that a replay keeps.
const FRAMES: f64 = 400.0;
/// The time in which most happens after a short blow, in s.
const LIVELY: f64 = 5e-3;
/// Numbers of nodes times frames that a replay may keep: some 100 MB.
const MOST_KEPT: f64 = 4e6;

/// How often work on several threads is looked after.
const LOOK_EVERY: Duration = Duration::from_millis(4);

/// Known by this number.
pub type Ticket = u64;

/// What a worker says.
#[derive(Debug)]
pub enum Report<T = Answer> {
    /// This share of the job is done.
    Progress(Ticket, f64),
    /// The job is done, or was refused.
    Done(Ticket, Box<Result<T, Refusal>>),
}

/// What a thread does with a question.
pub type Job<Q, T> = fn(&Q, Watch) -> Result<T, Refusal>;

struct Slot<Q> {
    job: Option<(Ticket, Q)>,
    closed: bool,
}

struct Shared<Q> {
    slot: Mutex<Slot<Q>>,
    filled: Condvar,
    /// Jobs with a lower ticket must stop.
    wanted: AtomicU64,
}

/// A thread with room for one running and one pending job.
pub struct Worker<Q = Scenario>(Arc<Shared<Q>>);

impl Worker {
    /// Starts a thread that simulates; `say` is called on it.
    pub fn start(say: impl Fn(Report) + Send + 'static) -> Self {
        Self::of(answer, say)
    }
}

impl<Q: Send + 'static> Worker<Q> {
    /// Starts a thread that does something else.
    pub fn of<T: 'static>(job: Job<Q, T>, say: impl Fn(Report<T>) + Send + 'static) -> Self {
        let shared = Arc::new(Shared {
            slot: Mutex::new(Slot {
                job: None,
                closed: false,
            }),
            filled: Condvar::new(),
            wanted: AtomicU64::new(0),
        });
        let own = Arc::clone(&shared);
        thread::spawn(move || work(&own, job, &say));
        Self(shared)
    }

    /// Hands in a job. Tickets must rise.
    pub fn submit(&self, ticket: Ticket, question: Q) {
        self.0.wanted.store(ticket, Ordering::Relaxed);
        self.lock().job = Some((ticket, question));
        self.0.filled.notify_one();
    }

    /// Stops every job up to this ticket.
    pub fn cancel(&self, ticket: Ticket) {
        self.0.wanted.fetch_max(ticket + 1, Ordering::Relaxed);
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Slot<Q>> {
        self.0.slot.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<Q> Drop for Worker<Q> {
    fn drop(&mut self) {
        self.0.wanted.store(u64::MAX, Ordering::Relaxed);
        let slot = self.0.slot.lock();
        slot.unwrap_or_else(PoisonError::into_inner).closed = true;
        self.0.filled.notify_one();
    }
}

fn work<Q, T>(shared: &Shared<Q>, job: Job<Q, T>, say: &impl Fn(Report<T>)) {
    loop {
        let mut slot = shared.slot.lock().unwrap_or_else(PoisonError::into_inner);
        let (ticket, question) = loop {
            if slot.closed {
                return;
            }
            if let Some(job) = slot.job.take() {
                break job;
            }
            slot = shared
                .filled
                .wait(slot)
                .unwrap_or_else(PoisonError::into_inner);
        };
        drop(slot);
        say(run(shared, ticket, &question, job, say));
    }
}

fn run<Q, T>(
    shared: &Shared<Q>,
    ticket: Ticket,
    question: &Q,
    job: Job<Q, T>,
    say: &impl Fn(Report<T>),
) -> Report<T> {
    let mut reported = Instant::now();
    let outcome = job(question, &mut |share| {
        if shared.wanted.load(Ordering::Relaxed) > ticket {
            return ControlFlow::Break(());
        }
        if reported.elapsed() >= REPORT_EVERY {
            reported = Instant::now();
            say(Report::Progress(ticket, share));
        }
        ControlFlow::Continue(())
    });
    Report::Done(ticket, Box::new(outcome))
}

/// A whole answer, with all that the screens show.
///
/// # Errors
/// As for any run.
pub fn answer(scenario: &Scenario, watch: Watch) -> Result<Answer, Refusal> {
    solve(scenario, keep(scenario), watch)
}

/// The mesh error of a scenario's answer. It is solved again, which is little beside the finer mesh.
///
/// # Errors
/// As for any run.
pub fn mesh_error(scenario: &Scenario, watch: Watch) -> Result<MeshError, Refusal> {
    let answer = solve(scenario, Keep::default(), watch)?;
    MeshQuery::of(&answer).estimate(scenario, watch)
}

/// Does work that may be told to stop and says how far it is, on another thread, under the eyes of a
/// watch that must stay on this one. What is stopped gives what it has.
pub fn overseen<T: Send>(
    watch: Watch,
    work: impl FnOnce(&AtomicBool, &(dyn Fn(f64) -> ControlFlow<()> + Sync)) -> T + Send,
) -> T {
    let (stop, share) = (AtomicBool::new(false), AtomicU64::new(0));
    thread::scope(|scope| {
        let own = scope.spawn(|| {
            work(&stop, &|done: f64| {
                share.store(done.to_bits(), Ordering::Relaxed);
                ControlFlow::Continue(())
            })
        });
        while !own.is_finished() {
            if watch(f64::from_bits(share.load(Ordering::Relaxed))).is_break() {
                stop.store(true, Ordering::Relaxed);
            }
            thread::sleep(LOOK_EVERY);
        }
        own.join()
            .unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    })
}

/// In a long window half of the frames fall into the time in which most happens.
fn spacing(scenario: &Scenario, frames: f64) -> Spacing {
    let window = scenario.window_ms * 1e-3;
    let pulse = match &scenario.impact {
        Impact::ForcePulse(pulse) => pulse.duration_ms * 1e-3,
        Impact::Projectile(_) => 0.0,
    };
    let lively = LIVELY.max(2.0 * pulse);
    if window < 2.0 * lively {
        return Spacing::even(window / frames);
    }
    let early = (0.5 * frames).round();
    Spacing {
        early: early as u32,
        early_every: lively / early,
        every: (window - lively) / (frames - early),
    }
}

/// Everything that the screens show; fewer frames of a mesh too fine to keep them all.
pub fn keep(scenario: &Scenario) -> Keep {
    let side = 15.0 * f64::from(scenario.eye.level) + 1.0;
    let frames = FRAMES.min(MOST_KEPT / (side * side)).max(20.0);
    Keep {
        traces: true,
        frames: Some(spacing(scenario, frames)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::mpsc::{Receiver, channel};

    const PATIENCE: Duration = Duration::from_secs(30);

    fn worker() -> (Worker, Receiver<Report>) {
        let (say, heard) = channel();
        let worker = Worker::start(move |report| {
            let _ = say.send(report);
        });
        (worker, heard)
    }

    fn long() -> Scenario {
        let mut scenario = Scenario {
            window_ms: 1000.0,
            ..Scenario::default()
        };
        scenario.eye.level = 4;
        scenario
    }

    fn done(heard: &Receiver<Report>) -> (Ticket, Result<Answer, Refusal>) {
        loop {
            if let Report::Done(ticket, answer) = heard.recv_timeout(PATIENCE).unwrap() {
                return (ticket, *answer);
            }
        }
    }

    #[test]
    fn a_newer_job_stops_the_running_one_and_replaces_the_pending_one() {
        let (worker, heard) = worker();
        worker.submit(1, long());
        // Progress shows that the first is running.
        let first = heard.recv_timeout(PATIENCE).unwrap();
        assert!(matches!(first, Report::Progress(1, _)));
        for ticket in 2..=9 {
            worker.submit(ticket, long());
        }
        worker.submit(10, Scenario::default());
        let (ticket, answer) = done(&heard);
        assert_eq!((ticket, answer.unwrap_err()), (1, Refusal::Cancelled));
        let mut last = done(&heard);
        // The second may have been taken up before the tenth came.
        while last.0 != 10 {
            assert_eq!(last.1.unwrap_err(), Refusal::Cancelled);
            last = done(&heard);
        }
        let answer = last.1.unwrap();
        assert!(answer.recording.frames.len() > 300 && answer.recording.traces.is_some());
    }

    #[test]
    fn a_cancelled_job_ends_and_the_worker_goes_on() {
        let (worker, heard) = worker();
        worker.submit(1, long());
        worker.cancel(1);
        assert_eq!(done(&heard).1.unwrap_err(), Refusal::Cancelled);
        worker.submit(2, Scenario::default());
        assert!(done(&heard).1.is_ok());
    }

    #[test]
    fn dropping_the_worker_stops_its_job() {
        let (worker, heard) = worker();
        worker.submit(1, long());
        drop(worker);
        let begun = Instant::now();
        while heard.recv_timeout(PATIENCE).is_ok() {}
        assert!(begun.elapsed() < PATIENCE);
    }

    #[test]
    fn the_mesh_error_is_a_job_of_its_own() {
        let (say, heard) = channel();
        let worker = Worker::of(mesh_error, move |report| {
            let _ = say.send(report);
        });
        worker.submit(1, Scenario::default());
        loop {
            if let Report::Done(1, mesh) = heard.recv_timeout(PATIENCE).unwrap() {
                let damage = mesh.unwrap().errors[crate::study::Quantity::Damage].unwrap();
                assert!((20.0..40.0).contains(&damage), "{damage}");
                break;
            }
        }
    }
}
