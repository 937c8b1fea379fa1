//! Signals during long work: the first asks for what is done so far, the second ends the program.

use std::io;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use signal_hook::consts::{SIGINT, SIGTERM};
use signal_hook::flag;

/// Is set by Ctrl-C, by a polite request to end and, on Unix, by the end of the connection.
pub(super) fn flag() -> io::Result<Arc<AtomicBool>> {
    let stop = Arc::new(AtomicBool::new(false));
    let signals = [SIGINT, SIGTERM].into_iter();
    #[cfg(unix)]
    let signals = signals.chain(hangup());
    for signal in signals {
        // Registered first, so that only a second signal finds the flag set.
        flag::register_conditional_shutdown(signal, 128 + signal, Arc::clone(&stop))?;
        flag::register(signal, Arc::clone(&stop))?;
    }
    Ok(stop)
}

/// SIGHUP, unless `nohup` had it ignored, which listening would undo: only Linux says whether.
#[cfg(unix)]
fn hangup() -> Option<i32> {
    let hangup = signal_hook::consts::SIGHUP;
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"))?;
    let mask = u64::from_str_radix(mask.trim(), 16).ok()?;
    (mask & (1 << (hangup - 1)) == 0).then_some(hangup)
}

/// Turns a file that grows beyond the limit of the shell (`ulimit -f`) into an error of the write,
/// which is reported, where the system would end the program without a word.
pub(super) fn outlive_file_limit() -> io::Result<()> {
    // No other system has such a signal.
    #[cfg(unix)]
    flag::register(signal_hook::consts::signal::SIGXFSZ, Arc::default())?;
    Ok(())
}
