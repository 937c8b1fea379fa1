//! Where no thread can start, as in a container that is held to one: everything is computed by the
//! thread that there is, or refused in a sentence.

#![cfg(target_os = "linux")]

use crate::{program, skip};
use std::process::{Command, Output};

/// What comes of a command of a person who may start no thread; none where nobody can be made one.
fn alone(arguments: &[&str]) -> Option<Output> {
    let app = env!("CARGO_BIN_EXE_contrecoup");
    let mut words = vec!["bash", "-c", "ulimit -u 1 && exec \"$@\"", "bash", app];
    words.extend(arguments);
    // No limit holds the superuser.
    let root = ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"];
    if fs_owner_is_root() {
        words.splice(0..0, root);
    }
    let command = Command::new(words[0]).args(&words[1..]).current_dir("/").output();
    let output = command.ok()?;
    // 126 and 127: the shell or setpriv found no program, or may not run it.
    (!matches!(output.status.code(), Some(126 | 127))).then_some(output)
}

fn fs_owner_is_root() -> bool {
    use std::os::unix::fs::MetadataExt;
    std::fs::metadata("/proc/self").is_ok_and(|own| own.uid() == 0)
}

#[test]
fn every_command_does_without_threads_what_it_does_with_them() {
    let short = ["--set", "window_ms=0.3"];
    let few = ["--samples", "8"];
    let vary = ["--vary", "impact.force_n=100,300"];
    let until = ["--vary", "force=100:300", "--until", "apex displacement = 1"];
    for (command, more) in [
        ("run", &[][..]),
        ("ensemble", &few),
        ("sweep", &vary),
        ("threshold", &until),
        ("compare", &["paper-100n"]),
        ("accuracy", &["--finest-level", "1"]),
    ] {
        let arguments = [&[command, "paper-300n", "--json"], &short[..], more].concat();
        let Some(output) = alone(&arguments) else {
            skip::not_here("nobody can be held to one process");
            return;
        };
        let said = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.success(), "{command}: {said}");
        assert!(!said.contains("panicked"), "{command}: {said}");
        if command == "run" {
            let figures = |bytes: &[u8]| -> serde_json::Value {
                serde_json::from_slice::<serde_json::Value>(bytes).unwrap()["results"].clone()
            };
            let usual = program::program(&arguments).output().unwrap();
            assert_eq!(figures(&output.stdout), figures(&usual.stdout));
        }
    }
    for arguments in [&["verify", "steps", "--scenes", "2"][..], &["verify", "hard-cases"]] {
        let output = alone(arguments).unwrap();
        let said = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(1), "{said}");
        assert!(said.contains("no thread can start here") && said.lines().count() == 1, "{said}");
    }
}
