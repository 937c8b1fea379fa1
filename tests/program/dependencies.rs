//! What the program is made of: licences that let anybody use it, one source, no crate twice, and a
//! package that holds what it is built from.
//!
//! This asks cargo itself, for the licences in `deny.toml`; `cargo deny` asks the same of the same
//! data, but has to be built first.

use std::fs;
use std::process::Command;

use serde_json::Value;

/// Licences that the program may be made of, as `deny.toml` lists them.
fn licences() -> Vec<String> {
    let rules = fs::read_to_string(concat!(env!("CARGO_MANIFEST_DIR"), "/deny.toml")).unwrap();
    let (_, list) = rules.split_once("allow = [").unwrap();
    let (list, _) = list.split_once(']').unwrap();
    let quoted = list.split('"').skip(1).step_by(2);
    quoted.map(str::to_owned).collect()
}

fn metadata() -> Value {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version=1", "--locked"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{said}");
    serde_json::from_slice(&output.stdout).unwrap()
}

fn text<'a>(value: &'a Value, key: &str) -> &'a str {
    value[key].as_str().unwrap_or_default()
}

/// Whether one way to read a licence expression asks for allowed licences only.
fn allowed(expression: &str, licences: &[String]) -> bool {
    let open = |part: &str| {
        let part = part.trim().trim_matches(['(', ')']);
        licences.iter().any(|licence| licence == part)
    };
    // Brackets stand around alternatives only, as in `(MIT OR Apache-2.0) AND Unicode-3.0`.
    expression.split(" AND ").all(|part| {
        let part = part.replace('/', " OR ");
        part.split(" OR ").any(open)
    })
}

#[test]
fn licences_are_read_with_their_alternatives() {
    let licences = licences();
    assert!(allowed("MIT OR GPL-3.0", &licences));
    assert!(allowed("Unlicense/MIT", &licences));
    assert!(allowed("(MIT OR Apache-2.0) AND Unicode-3.0", &licences));
    for closed in ["GPL-3.0", "MIT AND GPL-3.0", "(MIT OR Apache-2.0) AND OpenSSL", ""] {
        assert!(!allowed(closed, &licences), "{closed}");
    }
}

#[test]
fn every_crate_has_an_open_licence_and_comes_from_the_registry() {
    let (metadata, licences) = (metadata(), licences());
    let packages = metadata["packages"].as_array().unwrap();
    assert!(packages.len() > 50);
    for package in packages {
        let name = text(package, "name");
        let licence = text(package, "license");
        assert!(allowed(licence, &licences), "{name} is under {licence:?}");
        let source = text(package, "source");
        let registry = "registry+https://github.com/rust-lang/crates.io-index";
        assert!(source == registry || name == "contrecoup", "{name} comes from {source:?}");
    }
}

#[test]
fn the_program_holds_no_crate_twice() {
    let tree = |more: &str| {
        let edges = ["tree", "--locked", "--target=all", "--edges=normal,no-proc-macro"];
        let output = Command::new(env!("CARGO"))
            .args(edges)
            .args(["--prefix=none", more])
            .current_dir(env!("CARGO_MANIFEST_DIR"))
            .output()
            .unwrap();
        assert!(output.status.success(), "{output:?}");
        String::from_utf8(output.stdout).unwrap()
    };
    assert!(tree("--no-dedupe").contains("ratatui"));
    assert_eq!(tree("--duplicates"), "");
}

#[test]
fn the_package_holds_what_the_program_is_built_from_and_no_more() {
    let output = Command::new(env!("CARGO"))
        .args(["package", "--list", "--allow-dirty", "--offline"])
        .current_dir(env!("CARGO_MANIFEST_DIR"))
        .output()
        .unwrap();
    assert!(output.status.success(), "{output:?}");
    let files = String::from_utf8(output.stdout).unwrap();
    let files: Vec<&str> = files.lines().collect();
    for file in [
        "README.md",
        "CHANGELOG.md",
        "LICENSE-MIT",
        "LICENSE-APACHE",
        "presets/paper-300n.ron",
        "src/main.rs",
        "src/guide/install.md",
        "tests/pictures/main.svg",
        "tests/pictures/moments.svg",
    ] {
        assert!(files.contains(&file), "{file} is missing");
    }
    let folders = ["src/", "presets/", "examples/", "tests/pictures/"];
    for file in &files {
        let is_of = |folder: &&str| file.starts_with(folder);
        assert!(
            !file.contains('/') || folders.iter().any(is_of),
            "{file} is no part of the program"
        );
    }
}
