//! A thread that works while the app stays awake: on the newest request, which stops older ones.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::sync::{Arc, LazyLock, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use std::{io, thread};

use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::run::{threads, watch::Watch};
use crate::tui::request::{Report, Request, Ticket};

/// Progress is reported this often at most, and not at all by runs that are shorter.
const REPORT_EVERY: Duration = Duration::from_millis(150);
/// How often work on several threads is looked after, and how often it shows what there is so far.
const LOOK_EVERY: Duration = Duration::from_millis(4);
const SHOW_EVERY: Duration = Duration::from_millis(250);

/// A thread that works on the newest of the requests that wait for it.
pub struct Worker {
    requests: Sender<Request>,
    /// Requests with a lower ticket must stop.
    wanted: Arc<AtomicU64>,
}

impl Worker {
    /// Starts the thread; `say` is called on it. A request that takes longer than `limit` is
    /// stopped. One that `is_idle` gives way to all other work of the machine.
    pub fn start(
        limit: Option<Duration>,
        is_idle: bool,
        say: impl Fn(Report) + Send + 'static,
    ) -> io::Result<Self> {
        let (requests, waiting) = channel::<Request>();
        let wanted = Arc::new(AtomicU64::new(0));
        let own = Arc::clone(&wanted);
        threads::start(move || {
            if is_idle {
                give_way();
            }
            while let Ok(request) = waiting.recv() {
                let request = waiting.try_iter().last().unwrap_or(request);
                let begun = Instant::now();
                let mut reported = begun;
                let mut watch = |share| {
                    let is_over = limit.is_some_and(|limit| begun.elapsed() >= limit);
                    if is_over || own.load(Ordering::Relaxed) > request.ticket {
                        return ControlFlow::Break(());
                    }
                    if reported.elapsed() >= REPORT_EVERY {
                        reported = Instant::now();
                        say(Report::progress(request.ticket, share, begun.elapsed()));
                    }
                    ControlFlow::Continue(())
                };
                say(request.answered(&mut watch, &say));
            }
        })?;
        Ok(Self { requests, wanted })
    }

    /// Hands in a request. Tickets must rise.
    pub fn submit(&self, request: Request) {
        self.wanted.store(request.ticket, Ordering::Relaxed);
        // The thread waits as long as there is somebody who hands in.
        let _ = self.requests.send(request);
    }

    /// Stops the request of this ticket, if it is the last: earlier ones have stopped already.
    pub fn cancel(&self, ticket: Ticket) {
        let relaxed = Ordering::Relaxed;
        let _ = self.wanted.compare_exchange(ticket, ticket + 1, relaxed, relaxed);
    }
}

impl Drop for Worker {
    fn drop(&mut self) {
        self.wanted.store(u64::MAX, Ordering::Relaxed);
    }
}

/// Leaves the calling thread, for good, a tenth of a core that somebody else wants: on Linux alone,
/// elsewhere the priority is that of the whole process.
fn give_way() {
    // Where it is refused, the work is only less polite.
    #[cfg(target_os = "linux")]
    let _ = rustix::process::nice(10);
}

/// As many threads that give way to all other work as there are cores, begun when first asked for.
pub fn idle_pool() -> &'static ThreadPool {
    static POOL: LazyLock<ThreadPool> = LazyLock::new(|| {
        ThreadPoolBuilder::new().start_handler(|_| give_way()).build().expect("threads")
    });
    &POOL
}

/// How far work on several threads is, and what there is of its answer so far.
pub struct SharedProgress<T> {
    share: AtomicU64,
    wanted: AtomicBool,
    so_far: Mutex<Option<T>>,
}

impl<T> SharedProgress<T> {
    /// So much is done; `so_far` gives what there is, if anybody wants to see it now.
    pub fn report(&self, share: f64, so_far: impl FnOnce() -> T) -> ControlFlow<()> {
        self.share.store(share.to_bits(), Ordering::Relaxed);
        if self.wanted.swap(false, Ordering::Relaxed) {
            *self.lock_so_far() = Some(so_far());
        }
        ControlFlow::Continue(())
    }

    fn lock_so_far(&self) -> MutexGuard<'_, Option<T>> {
        self.so_far.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Does work on another thread that may be told to stop, while the watch, which must stay on this
/// one, is told how far it is and shown what there is. What is stopped gives what it has.
pub fn run_watched<T: Send, S: Send>(
    watch: Watch,
    show: &mut dyn FnMut(S),
    work: impl FnOnce(&AtomicBool, &SharedProgress<S>) -> T + Send,
) -> T {
    let stop = AtomicBool::new(false);
    let progress = SharedProgress {
        share: AtomicU64::new(0),
        wanted: AtomicBool::new(true),
        so_far: Mutex::new(None),
    };
    thread::scope(|scope| {
        let own = scope.spawn(|| work(&stop, &progress));
        let mut shown = Instant::now();
        while !own.is_finished() {
            if watch(f64::from_bits(progress.share.load(Ordering::Relaxed))).is_break() {
                stop.store(true, Ordering::Relaxed);
            }
            if let Some(so_far) = progress.lock_so_far().take() {
                show(so_far);
                shown = Instant::now();
            } else if shown.elapsed() >= SHOW_EVERY {
                progress.wanted.store(true, Ordering::Relaxed);
            }
            thread::sleep(LOOK_EVERY);
        }
        own.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::answer::solve::Answer;
    use crate::run::refusal::Refusal;
    use crate::scenario::Scenario;
    use crate::tui::{request::News, simulation::Simulate};
    use std::sync::mpsc::Receiver;

    const PATIENCE: Duration = Duration::from_secs(30);

    fn worker(limit: Option<Duration>) -> (Worker, Receiver<Report>) {
        let (say, reports) = channel();
        let worker = Worker::start(limit, false, move |report| {
            let _ = say.send(report);
        });
        (worker.unwrap(), reports)
    }

    fn submit(worker: &Worker, ticket: Ticket, scenario: Scenario) {
        worker.submit(Request::new(ticket, Arc::new(Simulate(scenario))));
    }

    fn long() -> Scenario {
        let mut scenario = Scenario { window_ms: Some(1000.0), ..Scenario::default() };
        scenario.eye.level = 4;
        scenario
    }

    fn done(reports: &Receiver<Report>) -> (Ticket, Result<Answer, Refusal>) {
        loop {
            let report = reports.recv_timeout(PATIENCE).unwrap();
            if let News::Done(outcome) = report.news {
                return (report.ticket, outcome.map(|any| *any.downcast().unwrap()));
            }
        }
    }

    #[test]
    fn a_newer_request_stops_the_running_one_and_replaces_the_pending_one() {
        let (worker, reports) = worker(None);
        submit(&worker, 1, long());
        // Progress shows that the first is running.
        let first = reports.recv_timeout(PATIENCE).unwrap();
        assert!(first.ticket == 1 && matches!(first.news, News::Share(..)));
        for ticket in 2..=9 {
            submit(&worker, ticket, long());
        }
        submit(&worker, 10, Scenario::default());
        let (ticket, answer) = done(&reports);
        assert_eq!((ticket, answer.unwrap_err()), (1, Refusal::Cancelled));
        let mut last = done(&reports);
        // The second may have been taken up before the tenth came.
        while last.0 != 10 {
            assert_eq!(last.1.unwrap_err(), Refusal::Cancelled);
            last = done(&reports);
        }
        let answer = last.1.unwrap();
        assert!(answer.run.frames.len() > 300 && answer.run.traces.is_some());
    }

    #[test]
    fn what_is_cancelled_or_takes_longer_than_the_limit_ends_and_the_worker_goes_on() {
        for limit in [None, Some(Duration::from_millis(300))] {
            let (worker, reports) = worker(limit);
            submit(&worker, 5, long());
            // That is another worker's.
            worker.cancel(9);
            assert!(matches!(reports.recv_timeout(PATIENCE).unwrap().news, News::Share(..)));
            if limit.is_none() {
                worker.cancel(5);
            }
            assert_eq!(done(&reports).1.unwrap_err(), Refusal::Cancelled);
            submit(&worker, 6, Scenario::default());
            assert!(done(&reports).1.is_ok());
        }
    }

    #[test]
    fn dropping_the_worker_stops_its_request() {
        let (worker, reports) = worker(None);
        submit(&worker, 1, long());
        drop(worker);
        let begun = Instant::now();
        while reports.recv_timeout(PATIENCE).is_ok() {}
        assert!(begun.elapsed() < PATIENCE);
    }

    #[cfg(target_os = "linux")]
    #[test]
    fn idle_threads_give_way_and_the_others_keep_their_priority() {
        let before = rustix::process::getpriority_process(None).unwrap();
        let there = idle_pool().install(|| rustix::process::getpriority_process(None)).unwrap();
        assert!(there > before || before == 19, "{there} {before}");
        assert_eq!(rustix::process::getpriority_process(None).unwrap(), before);
    }
}
