//! Work that nobody asked for: threads that give way to all other work of the machine.

use std::sync::LazyLock;

use rayon::{ThreadPool, ThreadPoolBuilder};

/// How much nicer such a thread is: it gets a tenth of a core that somebody else wants.
#[cfg(target_os = "linux")]
const NICE: i32 = 10;

/// Lowers the priority of the calling thread, for good.
#[cfg(target_os = "linux")]
pub fn give_way() {
    // Linux keeps a priority for each thread; where it refuses, the work is only less polite.
    let _ = rustix::process::nice(NICE);
}

/// Elsewhere the priority is that of the whole process.
#[cfg(not(target_os = "linux"))]
pub fn give_way() {}

/// As many such threads as there are cores, begun when first asked for.
pub fn pool() -> &'static ThreadPool {
    static POOL: LazyLock<ThreadPool> = LazyLock::new(|| {
        let pool = ThreadPoolBuilder::new().start_handler(|_| give_way());
        pool.build().expect("threads")
    });
    &POOL
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;
    use rustix::process::getpriority_process;

    #[test]
    fn idle_threads_give_way_and_the_others_keep_their_priority() {
        let before = getpriority_process(None).unwrap();
        let there = pool().install(|| getpriority_process(None)).unwrap();
        assert!(there > before || before == 19, "{there} {before}");
        assert_eq!(getpriority_process(None).unwrap(), before);
    }
}
