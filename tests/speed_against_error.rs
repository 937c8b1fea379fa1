//! `--tolerance`, `--mesh-error` and `accuracy` as a shell sees them.

#![cfg(feature = "app")]

mod common;

use common::{json, program};
use predicates::prelude::*;
use predicates::str::contains;
use serde_json::Value;

#[test]
fn the_mesh_error_is_null_until_it_is_asked_for() {
    let without = json(&["run", "paper-300n"]);
    assert!(without["error"]["mesh_percent"].is_null());
    let with = json(&["run", "paper-300n", "--mesh-error"]);
    let damage = with["error"]["mesh_percent_by_result"]["damage_percent"]
        .as_f64()
        .unwrap();
    // Levels 4 to 8 say that level 1 is 28 to 29 % off.
    assert!((29.0..40.0).contains(&damage), "{damage}");
    assert!(with["error"]["mesh_percent"].as_f64().unwrap() >= damage);
}

#[test]
fn a_tolerance_chooses_the_coarsest_level_that_meets_it_and_says_why() {
    let coarse = json(&["run", "paper-300n", "--tolerance", "40"]);
    let fine = json(&["run", "paper-300n", "--tolerance", "10"]);
    assert_eq!(coarse["numerics"]["level"], 1);
    assert_eq!(fine["numerics"]["level"], 3);
    for (object, tolerance) in [(&coarse, 40.0), (&fine, 10.0)] {
        let error = |which: &str| object["error"][which]["damage_percent"].as_f64().unwrap();
        let total = error("time_step_percent_by_result") + error("mesh_percent_by_result");
        assert!(total <= tolerance, "{total}");
        let reasons = object["numerics"]["choice"].as_array().unwrap();
        assert!(
            reasons
                .iter()
                .any(|r| r.as_str().unwrap().contains("mesh error"))
        );
    }
    // What is promised holds against a finer mesh.
    let damage = fine["results"]["damage_percent"].as_f64().unwrap();
    assert!((damage / 18.9 - 1.0).abs() < 0.1, "{damage}");
}

#[test]
fn a_tolerance_that_no_level_meets_is_refused() {
    program(&["run", "paper-600n", "--tolerance", "10"])
        .assert()
        .code(1)
        .stderr(contains("no result within 10 %").and(contains("folds")));
    program(&["run", "paper-300n", "--tolerance", "0"])
        .assert()
        .code(2);
    program(&["run", "paper-300n", "--tolerance", "5", "--level", "2"])
        .assert()
        .code(2);
}

#[test]
fn accuracy_reports_every_integrator_the_front_and_the_choices() {
    let arguments = [
        "accuracy",
        "paper-300n",
        "--finest-level",
        "2",
        "--set",
        "window_ms=0.5",
    ];
    let object = json(&arguments);
    let points = object["points"].as_array().unwrap();
    for integrator in [
        "semi-implicit-euler",
        "velocity-verlet",
        "srkn6b",
        "srkn11b",
        "rk4",
        "dopri5",
    ] {
        let of: Vec<&Value> = points
            .iter()
            .filter(|p| p["integrator"] == integrator)
            .collect();
        assert!(of.len() >= 4, "{integrator}");
        assert!(of.iter().all(|p| p["median_ms"].as_f64().unwrap() > 0.0));
    }
    assert!(points.iter().any(|p| p["on_front"] == true));
    // The paper's scheme is first order, the default fourth: at their largest steps it shows.
    let largest = |integrator: &str| {
        let first = points
            .iter()
            .find(|p| p["integrator"] == integrator)
            .unwrap();
        first["error_percent"].as_f64().unwrap()
    };
    assert!(largest("semi-implicit-euler") > 50.0 * largest("srkn6b"));
    let targets: Vec<f64> = object["best"]
        .as_array()
        .unwrap()
        .iter()
        .map(|b| b["percent"].as_f64().unwrap())
        .collect();
    assert_eq!(targets, [10.0, 1.0, 0.1, 0.01]);
    assert_eq!(object["levels"].as_array().unwrap().len(), 2);
    program(&arguments).assert().success().stdout(
        contains("kernel")
            .and(contains("omega at most"))
            .and(contains("for 0.1 %")),
    );
}
