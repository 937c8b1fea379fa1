//! Published experiments run again, and the fit to two of them, as a person asks for them.

use crate::program::json;
use contrecoup::scenario::Physiological;
use contrecoup::verify::experiments::EXPERIMENTS;
use contrecoup::verify::fit::{STEP, Tried};
use contrecoup::verify::rerun::MESHES;
use serde_json::Value;
use std::sync::LazyLock;

/// The fitted number.
const TAKEN: f64 = 0.4;

/// All rows as the command prints them.
static ROWS: LazyLock<Vec<Value>> = LazyLock::new(|| {
    let printed = json(&["verify", "experiments"]);
    printed["rows"].as_array().unwrap().clone()
});

/// The fitted rows of the number that is taken, run on one thread.
static HERE: LazyLock<Tried> = LazyLock::new(|| {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    pool.unwrap().install(|| Tried::run(TAKEN))
});

#[test]
fn published_moduli_meet_most_experiments_and_no_other_row_is_off_by_a_factor_of_two() {
    // A baseball's surface is known within a factor of ten; no wall that meets the pressures widens
    // so.
    let named = ["baseball-whole", "bb-widening"];
    let met = ROWS.iter().filter(|row| row["met"] == true).count();
    assert!(met >= 12, "{met} of {}", ROWS.len());
    for row in ROWS.iter() {
        let bound = |i: usize, open: f64| row["measured_band"][i].as_f64().unwrap_or(open);
        let (low, high) = (bound(0, f64::NEG_INFINITY), bound(1, f64::INFINITY));
        for mesh in 0..MESHES {
            let value = row["predicted"][mesh].as_f64().expect("a figure");
            let off = (low / value).max(value / high);
            let known = named.iter().any(|key| row["key"] == *key);
            assert!(off < 2.0 || known, "{}: {off}", row["key"]);
            assert_eq!(row["inside"][mesh], (low..=high).contains(&value), "{row}");
        }
        let because = row["because"].as_str();
        assert!(row["met"] == true || because.is_some_and(|why| !why.is_empty()), "{row}");
        assert!(row["step_error_percent"].as_f64().unwrap() < 10.0, "{row}");
    }
}

#[test]
fn json_has_every_row_and_the_same_figures_on_any_threads() {
    assert_eq!(ROWS.len(), EXPERIMENTS.len());
    for (printed, experiment) in ROWS.iter().zip(EXPERIMENTS) {
        assert_eq!(printed["key"], experiment.key);
        assert_eq!(printed["fitted"], experiment.fitted);
        assert_eq!(printed["published_moduli"].is_array(), experiment.fitted);
    }
    for (printed, row) in ROWS.iter().zip(&HERE.rows) {
        assert_eq!(printed["met"], row.is_met());
        for mesh in 0..MESHES {
            let value = printed["predicted"][mesh].as_f64().unwrap();
            let here = *row.predicted[mesh].as_ref().unwrap();
            // Reading decimals back may lose the last bit.
            assert!((value / here - 1.0).abs() < 1e-14, "{value} {here}");
        }
    }
}

/// The whole grid takes longer; its neighbours must not fit better.
#[test]
fn the_default_of_the_fitted_number_is_what_the_fit_takes() {
    assert_eq!(Physiological::default().fat_bulk_mpa, TAKEN);
    assert_eq!(HERE.inside, 2 * MESHES);
    for other in [TAKEN - STEP, TAKEN + STEP] {
        let there = Tried::run(other);
        assert!(!there.beats(&HERE), "{there:?} {:?}", *HERE);
    }
}
