//! Work on more than one thread, or on the calling one where a container or a limit (`ulimit -u`)
//! lets none start: that takes longer and gives the same.

use std::error::Error;
#[cfg(feature = "app")]
use std::io;
use std::sync::{Mutex, OnceLock, PoisonError};
use std::thread;

use rayon::ThreadPoolBuilder;

/// Does `other` beside `own`, or after it where no thread can start.
pub fn beside<A: Send, B>(other: impl FnOnce() -> A + Send, own: impl FnOnce() -> B) -> (A, B) {
    // Whoever comes first takes it.
    let other = Mutex::new(Some(other));
    let take = || {
        let job = other.lock().unwrap_or_else(PoisonError::into_inner).take();
        job.map(|job| job())
    };
    thread::scope(|scope| {
        let helper = thread::Builder::new().spawn_scoped(scope, take);
        let own = own();
        let other = match helper {
            Ok(helper) => helper.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
            Err(_) => take(),
        };
        (other.expect("is taken once"), own)
    })
}

/// Starts a thread of its own, or says that none can start.
#[cfg(feature = "app")]
pub fn start(work: impl FnOnce() + Send + 'static) -> io::Result<()> {
    let started = thread::Builder::new().spawn(work).map(drop);
    started.map_err(|error| io::Error::other(format!("no thread can start: {error}")))
}

/// Whether rayon has threads for the caller: its own pool, or the common one, which is begun here.
pub fn pool_is_there() -> bool {
    static COMMON: OnceLock<bool> = OnceLock::new();
    // An error without a cause says that somebody has begun it already.
    let begun = || match ThreadPoolBuilder::new().build_global() {
        Ok(()) => true,
        Err(error) => error.source().is_none(),
    };
    rayon::current_thread_index().is_some() || *COMMON.get_or_init(begun)
}

/// Threads that work on many runs.
pub fn count() -> usize {
    if pool_is_there() { rayon::current_num_threads() } else { 1 }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_jobs_give_both_of_their_results() {
        let (mut own, other) = (1, String::from("other"));
        let both = beside(|| other.len(), || own += 1);
        assert_eq!((both.0, own), (5, 2));
        assert!(count() > 0);
    }
}
