//! The program as a shell runs it.

use assert_cmd::Command;
use serde_json::Value;

/// The program with `arguments`, not yet run.
pub fn program(arguments: &[&str]) -> Command {
    let mut command = Command::cargo_bin("contrecoup").unwrap();
    // A folder that does not exist: no test sees a person's presets.
    command.env("XDG_CONFIG_HOME", "/nonexistent").args(arguments);
    command
}

/// What it prints with `--json`.
pub fn json(arguments: &[&str]) -> Value {
    let output = program(arguments).arg("--json").output().unwrap();
    assert!(output.status.success(), "{output:?}");
    serde_json::from_slice(&output.stdout).unwrap()
}
