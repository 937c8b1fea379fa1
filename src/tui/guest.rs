//! A guest: somebody on a shared host who may look and try, and leave nothing behind.
//!
//! No file is read or written: presets are those of the program, and the person's own folder, a
//! config file, curves and saving are out of reach (see `files`); the kernel refuses files too.
//! The process has the lowest priority, one core where the system can hold it to one, and so much
//! memory; it computes nothing that nobody asked for. Levels, windows, samples and the time of one
//! answer are bounded, and a session without keys ends.
//!
//! Left out: a sandbox of system calls. The program runs no other one, and the account's forced
//! command lets nobody ask for another.

use std::io;
use std::time::Duration;

use crate::files;
use crate::scenario::Scenario;
use crate::tui::ensemble;

pub const FINEST_LEVEL: u32 = 3;
pub const LONGEST_WINDOW_MS: f64 = 20.0;
pub const MOST_SAMPLES: u32 = ensemble::FEW;
/// The longest that one answer is worked on.
pub const LONGEST_ANSWER: Duration = Duration::from_secs(30);

/// Whether a guest may have this simulated, or what is too much.
pub fn allowed(scenario: &Scenario) -> Result<(), String> {
    let (level, window) = (scenario.eye.level, scenario.window_ms.unwrap_or(0.0));
    if level > FINEST_LEVEL {
        Err(format!("level {level} is not for guests: allowed 1 to {FINEST_LEVEL}"))
    } else if window > LONGEST_WINDOW_MS {
        Err(format!("{window} ms are not for guests: allowed up to {LONGEST_WINDOW_MS} ms"))
    } else {
        Ok(())
    }
}

/// Takes from this process and all its later threads what a guest does not need, for good.
pub(super) fn confine() -> io::Result<()> {
    files::shut();
    by_the_system()
}

#[cfg(unix)]
fn by_the_system() -> io::Result<()> {
    use rustix::process::{Resource, Rlimit, nice, setrlimit};

    /// In bytes.
    const MEMORY: u64 = 256 << 20;
    nice(19)?;
    for (resource, most) in [(Resource::Fsize, 0), (Resource::Core, 0), (Resource::Data, MEMORY)] {
        let most = Some(most);
        setrlimit(resource, Rlimit { current: most, maximum: most })?;
    }
    #[cfg(target_os = "linux")]
    one_core();
    Ok(())
}

/// Guests spread over the cores by their numbers; else the priority has to do.
#[cfg(target_os = "linux")]
fn one_core() {
    use rustix::thread::{CpuSet, sched_getaffinity, sched_setaffinity};

    let Ok(all) = sched_getaffinity(None) else { return };
    let ours = std::process::id() as usize % (all.count().max(1) as usize);
    if let Some(core) = (0..CpuSet::MAX_CPU).filter(|core| all.is_set(*core)).nth(ours) {
        let mut one = CpuSet::new();
        one.set(core);
        let _ = sched_setaffinity(None, &one);
    }
}

/// Windows has none of these limits for a process of its own.
#[cfg(not(unix))]
fn by_the_system() -> io::Result<()> {
    Err(io::Error::other("guests are not held to their limits on this system"))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::library::built_in;

    #[test]
    fn every_preset_of_the_program_is_for_guests() {
        for preset in built_in() {
            assert_eq!(allowed(&preset.scenario().unwrap()), Ok(()), "{}", preset.name);
        }
    }
}
