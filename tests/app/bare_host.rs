//! The static program where there is nothing else: a root with one file in it, no locale, no
//! library, no `/proc` and no `/dev`, also over ssh.
//!
//! The program is built by the command of the guide on installing, as `.ci/run` does before the
//! tests. To build it takes minutes, so elsewhere the tests are skipped where it is not there or is
//! older than the program.

#![cfg(all(target_os = "linux", target_arch = "x86_64"))]

use crate::{program, pty, skip};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::ssh::Server;
use serde_json::Value;

const TARGET: &str = "x86_64-unknown-linux-musl";

/// The static program, of the same sources as the one under test.
fn built() -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    if std::env::var("CI").is_ok() {
        // Nothing to do if .ci/run has done it.
        let build = ["build", "--release", "--quiet", "--bin", "contrecoup", "--target", TARGET];
        let done = Command::new(env!("CARGO")).args(build).current_dir(folder).status();
        assert!(done.unwrap().success(), "the static program cannot be built");
    }
    let program = folder.join("target").join(TARGET).join("release/contrecoup");
    let time = |path: &Path| fs::metadata(path).and_then(|about| about.modified()).ok();
    let here = Path::new(env!("CARGO_BIN_EXE_contrecoup"));
    let fresh = std::env::var("CI").is_ok() || time(&program) >= time(here);
    (program.exists() && fresh).then_some(program)
}

/// A root that holds the program and nothing else.
fn root() -> Option<tempfile::TempDir> {
    let is_root = Command::new("id").arg("-u").output().unwrap().stdout == b"0\n";
    if !is_root {
        skip::skip("only root may change the root");
        return None;
    }
    if std::env::var("NO_MUSL").is_ok() {
        // Said by .ci/run, where the standard library cannot be had.
        skip::not_here("the standard library of the static program cannot be had");
        return None;
    }
    let Some(program) = built() else {
        skip::skip("the static program is not built, or of older sources");
        return None;
    };
    let root = tempfile::tempdir().unwrap();
    fs::copy(program, root.path().join("contrecoup")).unwrap();
    Some(root)
}

fn bare(root: &Path, arguments: &[&str]) -> Output {
    let mut command = Command::new("chroot");
    command.arg(root).arg("/contrecoup").args(arguments);
    command.env_clear().env("PATH", std::env::var("PATH").unwrap());
    command.output().unwrap()
}

/// What is printed, but for the time that it took.
fn printed(output: &Output) -> Vec<String> {
    assert!(output.status.success(), "{output:?}");
    let text = String::from_utf8_lossy(&output.stdout);
    let lines = text.lines().filter(|line| !line.starts_with("Solved in"));
    lines.map(str::to_owned).collect()
}

#[test]
fn on_a_bare_root_the_static_program_prints_the_same_digits() {
    let Some(root) = root() else { return };
    let version = bare(root.path(), &["--version"]);
    let version = String::from_utf8(version.stdout).unwrap();
    assert!(version.starts_with("contrecoup "), "{version}");
    for preset in ["paper-300n", "off-axis-triangle", "paintball"] {
        let run = ["run", preset];
        let here = program::program(&run).output().unwrap();
        let there = bare(root.path(), &run);
        assert_eq!(printed(&there), printed(&here), "{preset}");
        let there = bare(root.path(), &["run", preset, "--json"]);
        let there: Value = serde_json::from_slice(&there.stdout).unwrap();
        assert!(there["results"].as_object().unwrap().len() > 10);
        assert_eq!(there["results"], program::json(&run)["results"], "{preset}");
    }
    // It says what it wants where there is no terminal, and where no such file is.
    assert_eq!(bare(root.path(), &[]).status.code(), Some(2));
    assert_eq!(bare(root.path(), &["run", "/none.ron"]).status.code(), Some(2));
}

#[test]
fn over_ssh_the_app_opens_on_a_bare_root_without_a_locale() {
    let Some(root) = root() else { return };
    let clean = format!("env -i PATH=$PATH TERM=$TERM chroot {}", root.path().display());
    let Some(server) = Server::start(&format!("exec {clean} /contrecoup tui paper-300n")) else {
        return;
    };
    let mut term = server.open();
    term.keys(&format!("{}{}", pty::TO_FORCE, pty::RIGHT));
    term.wait_for("310 N");
    term.keys("u");
    term.wait_for("damage 26 %");
    term.keys("q");
    assert_eq!(term.exit_code(), 0);
    term.assert_restored();
    let left: Vec<_> = fs::read_dir(root.path()).unwrap().collect();
    assert_eq!(left.len(), 1, "{left:?}");
}
