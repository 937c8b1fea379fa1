//! The library as its users meet it: the example of the first page, and the programs in `examples`.

use std::process::Command;

/// What the example prints, run as a reader would run it.
fn example(name: &str) -> String {
    let mut cargo = Command::new(env!("CARGO"));
    cargo.args(["run", "--quiet", "--example", name]);
    // The same profile as this test has, so that nothing is built twice.
    if !cfg!(debug_assertions) {
        cargo.arg("--release");
    }
    if !cfg!(feature = "app") {
        cargo.arg("--no-default-features");
    }
    let output = cargo.current_dir(env!("CARGO_MANIFEST_DIR")).output().unwrap();
    assert!(output.status.success(), "{output:?}");
    String::from_utf8(output.stdout).unwrap()
}

fn number(text: &str) -> f64 {
    text.parse().unwrap_or_else(|_| panic!("{text} is no number"))
}

#[test]
fn the_readme_shows_the_example_that_the_first_page_of_the_library_runs() {
    let page = include_str!("../../src/lib.rs");
    let code = page.split("//! ```\n").nth(1).unwrap();
    let plain = |line: &'static str| {
        let line = line.trim_start_matches("//!");
        line.strip_prefix(' ').unwrap_or(line)
    };
    let code = code.lines().map(plain).collect::<Vec<_>>().join("\n");
    let readme = include_str!("../../README.md");
    assert!(readme.contains(&format!("```rust\n{code}\n```\n")), "{code}");
}

#[test]
fn one_blow_prints_each_result_with_both_errors() {
    let printed = example("blow");
    let mut lines = printed.lines();
    assert_eq!(lines.next(), Some("300 N for 0.2 ms"));
    assert!(lines.next().unwrap().starts_with("result"));
    let damage = lines.next().unwrap();
    let cells: Vec<&str> = damage.split_whitespace().collect();
    let ["damage", "index", value, step, "%", mesh, "%"] = cells[..] else { panic!("{damage}") };
    assert!((20.0..30.0).contains(&number(value)));
    assert!((0.0..0.1).contains(&number(step)));
    assert!((1.0..40.0).contains(&number(mesh)));
    assert!(lines.next().is_some_and(|line| line.starts_with("wall growth S")));
}

#[test]
fn the_sweep_prints_a_row_for_each_point_and_damage_rises_with_force() {
    let printed = example("parallel_sweep");
    let mut lines = printed.lines();
    let header = "force_n,duration_ms,damage_percent,step_error_percent,mesh_folded";
    assert_eq!(lines.next(), Some(header));
    let rows: Vec<Vec<&str>> = lines.map(|line| line.split(',').collect()).collect();
    assert_eq!(rows.len(), 12);
    for (lower, higher) in rows.iter().zip(&rows[3..]) {
        assert_eq!(lower[1], higher[1]);
        assert!(number(lower[0]) < number(higher[0]));
        assert!(number(lower[2]) < number(higher[2]), "{lower:?} {higher:?}");
    }
}

#[test]
fn a_curve_of_ones_own_is_compared_with_a_smooth_pulse_of_the_same_peak() {
    let printed = example("measured_pulse");
    let lines: Vec<&str> = printed.lines().collect();
    assert_eq!(lines.len(), 6, "{printed}");
    assert_eq!(lines[0], "as measured: 284 N at most, 0.36 ms");
    assert_eq!(lines[3], "as a smooth pulse: 284 N at most, 0.36 ms");
    let damage = |line: &str| number(line.split_whitespace().nth(2).unwrap());
    // The record has the smaller impulse.
    assert!(damage(lines[1]) < damage(lines[4]));
}
