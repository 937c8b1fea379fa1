//! Published experiments run again, and the fit to two of them, as a person asks for them.

#![cfg(feature = "app")]

mod common;

use common::json;
use contrecoup::scenario::Physiological;
use contrecoup::verify::calibrate::{STEP, tried};
use contrecoup::verify::experiments::EXPERIMENTS;
use contrecoup::verify::validate::{MESHES, Row, validate};
use serde_json::Value;
use std::sync::OnceLock;

/// All rows, run on one thread.
fn rows() -> &'static [Row] {
    static ROWS: OnceLock<Vec<Row>> = OnceLock::new();
    ROWS.get_or_init(|| {
        let threads = rayon::ThreadPoolBuilder::new().num_threads(1).build();
        threads.unwrap().install(|| validate(|scenario| scenario))
    })
}

#[test]
fn published_moduli_meet_most_experiments_and_no_other_row_is_off_by_a_factor_of_two() {
    // A baseball's surface is known within a factor of ten; no wall that meets the pressures widens so.
    let named = ["baseball-whole", "bb-widening"];
    let met = rows().iter().filter(|row| row.is_met()).count();
    assert!(met >= 12, "{met} of {}", rows().len());
    for row in rows() {
        let key = row.experiment.key;
        let miss = row.miss().expect(key);
        assert!(miss < 2.0 || named.contains(&key), "{key}: {miss}");
        assert!(row.is_met() || !row.experiment.because.is_empty(), "{key}");
        assert!(row.step_error.unwrap() < 10.0, "{key}");
    }
}

#[test]
fn json_has_every_mesh_of_every_row_and_the_same_figures_on_any_threads() {
    let all = json(&["validate"]);
    let printed = all["rows"].as_array().unwrap();
    assert_eq!(printed.len(), EXPERIMENTS.len());
    for (printed, row) in printed.iter().zip(rows()) {
        assert_eq!(printed["key"], row.experiment.key);
        assert_eq!(printed["fitted"], row.experiment.fitted);
        assert_eq!(
            printed["published_moduli"].is_array(),
            row.experiment.fitted
        );
        assert_eq!(printed["met"], row.is_met());
        let beyond = |value: f64, bound: &Value, sign: f64| {
            let bound = bound.as_f64();
            bound.is_some_and(|bound| sign * value > sign * bound)
        };
        for mesh in 0..MESHES {
            let value = printed["predicted"][mesh].as_f64().unwrap();
            let here = *row.predicted[mesh].as_ref().unwrap();
            // Reading decimals back may lose the last bit.
            assert!((value / here - 1.0).abs() < 1e-14, "{value} {here}");
            let band = &printed["measured_band"];
            let outside = beyond(value, &band[0], -1.0) || beyond(value, &band[1], 1.0);
            assert_eq!(printed["inside"][mesh], !outside, "{printed}");
        }
    }
}

/// The whole grid takes longer; its neighbours must not fit better.
#[test]
fn the_default_of_the_fitted_number_is_what_the_fit_takes() {
    let taken = Physiological::default().fat_bulk_mpa;
    let here = tried(taken);
    assert_eq!(here.inside, 2 * MESHES);
    for other in [taken - STEP, taken + STEP] {
        let there = tried(other);
        let better =
            there.inside > here.inside || there.inside == here.inside && there.misfit < here.misfit;
        assert!(!better, "{there:?} {here:?}");
    }
}
