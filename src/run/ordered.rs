//! Numbered jobs on all cores whose results come in their order.
//!
//! Each thread takes the next number that nobody has. A result waits until all before it are there,
//! so the sequence is the same for any number of threads, and a stopped run gives its beginning.

use crate::run::{refusal::Refusal, threads, watch::stop_if};
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};

/// A watch that goes on until `stop` is set.
pub fn until(stop: &AtomicBool) -> impl FnMut(f64) -> ControlFlow<()> + '_ {
    |_| stop_if(stop.load(Ordering::Relaxed))
}

struct Desk<T, D> {
    next: usize,
    waiting: BTreeMap<usize, T>,
    deliver: D,
}

/// Does jobs `from..to`; `deliver` takes each in order. It, `stop` or no result stop the rest.
pub fn run<T: Send>(
    (from, to): (usize, usize),
    stop: &AtomicBool,
    job: impl Fn(usize) -> Option<T> + Sync,
    deliver: impl FnMut(usize, T) -> ControlFlow<()> + Send,
) {
    let next = AtomicUsize::new(from);
    let desk = Mutex::new(Desk { next: from, waiting: BTreeMap::new(), deliver });
    let work = || {
        while !stop.load(Ordering::Relaxed) {
            let index = next.fetch_add(1, Ordering::Relaxed);
            if index >= to {
                return;
            }
            let Some(result) = job(index) else { return };
            let mut desk = desk.lock().unwrap_or_else(PoisonError::into_inner);
            let desk = &mut *desk;
            desk.waiting.insert(index, result);
            while let Some(result) = desk.waiting.remove(&desk.next) {
                let index = desk.next;
                desk.next += 1;
                if (desk.deliver)(index, result).is_break() {
                    stop.store(true, Ordering::Relaxed);
                    desk.next = usize::MAX;
                }
            }
        }
    };
    if !threads::pool_is_there() {
        return work();
    }
    rayon::scope(|scope| {
        for _ in 0..rayon::current_num_threads() {
            scope.spawn(|_| work());
        }
    });
}

/// Does all jobs and gives their results in order; `progress` is told the share done.
///
/// # Errors
/// Where it was stopped before the last.
pub fn all<T: Send>(
    count: usize,
    stop: &AtomicBool,
    job: impl Fn(usize) -> Option<T> + Sync,
    mut progress: impl FnMut(f64) + Send,
) -> Result<Vec<T>, Refusal> {
    let mut all = Vec::with_capacity(count);
    run((0, count), stop, job, |_, one| {
        all.push(one);
        progress(all.len() as f64 / count as f64);
        ControlFlow::Continue(())
    });
    if all.len() < count { Err(Refusal::Cancelled) } else { Ok(all) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_come_in_order_and_end_where_they_are_stopped() {
        for threads in [1, 2, 5] {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
            let (mut seen, stop) = (Vec::new(), AtomicBool::new(false));
            pool.build().unwrap().install(|| {
                let slow_first = |i: usize| {
                    let pause = if i.is_multiple_of(3) { 500 } else { 1 };
                    std::thread::sleep(std::time::Duration::from_micros(pause));
                    Some(i * i)
                };
                run((3, 100), &stop, slow_first, |i, square| {
                    assert_eq!(square, i * i);
                    seen.push(i);
                    stop_if(i == 40)
                });
            });
            assert_eq!(seen, (3..=40).collect::<Vec<_>>());
        }
    }
}
