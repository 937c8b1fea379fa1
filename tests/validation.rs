//! Published experiments run again, and the fit to some of them, as a person asks for them.

#![cfg(feature = "app")]

mod common;

use common::{json, program};
use contrecoup::scenario::{Model, Physiological, Scenario};
use contrecoup::study::calibrate::{calibrate, misfit_of};
use contrecoup::study::experiments::EXPERIMENTS;
use contrecoup::study::unwatched;
use contrecoup::study::validate::validate;
use serde_json::Value;

#[test]
fn every_experiment_is_printed_with_its_prediction_source_and_verdict() {
    let all = json(&["validate"]);
    let rows = all["rows"].as_array().unwrap();
    assert_eq!(rows.len(), EXPERIMENTS.len());
    for (row, experiment) in rows.iter().zip(EXPERIMENTS) {
        assert_eq!(row["key"], experiment.key);
        assert_eq!(row["fitted"], experiment.fitted);
        let predicted = row["predicted"].as_f64().unwrap();
        let ratio = row["ratio"].as_f64().unwrap();
        let measured = row["measured"].as_f64().unwrap();
        assert!((predicted / measured - ratio).abs() < 1e-9 * ratio);
        let beyond = |bound: &Value, sign: f64| {
            bound
                .as_f64()
                .is_some_and(|bound| sign * predicted > sign * bound)
        };
        let band = &row["measured_band"];
        let outside = beyond(&band[0], -1.0) || beyond(&band[1], 1.0);
        assert_eq!(row["inside"].as_bool().unwrap(), !outside, "{row}");
        assert!(!row["source"].as_str().unwrap().is_empty());
        assert!(row["step_error_percent"].as_f64().unwrap() >= 0.0);
    }
}

#[test]
fn the_table_keeps_what_misses_and_tells_fitted_from_not_fitted() {
    let output = program(&["validate"]).output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    let (fitted, others) = text.split_once("Not fitted").unwrap();
    for experiment in EXPERIMENTS {
        let part = if experiment.fitted { fitted } else { others };
        assert!(part.contains(experiment.what), "{}", experiment.what);
        assert!(part.contains(experiment.source), "{}", experiment.source);
    }
    let misses = validate(|scenario| scenario)
        .iter()
        .filter(|row| !row.inside())
        .count();
    let marked = text.split_whitespace().filter(|word| *word == "NO");
    assert_eq!(marked.count(), misses);
    assert!(
        misses > 0,
        "a model this plain cannot agree with everything"
    );
}

#[test]
fn the_softest_content_allowed_no_longer_agrees_with_what_the_fit_agrees_with() {
    let soft = |scenario: Scenario| match scenario.model {
        Model::Paper | Model::Axisymmetric(_) => scenario,
        Model::Physiological(model) => Scenario {
            model: Model::Physiological(Physiological {
                bulk_modulus_mpa: 5.0,
                ..model
            }),
            ..scenario
        },
    };
    let count = |rows: Vec<contrecoup::study::validate::Row>| {
        let fitted = rows.iter().filter(|r| r.experiment.fitted);
        fitted.filter(|r| r.inside()).count()
    };
    assert!(count(validate(soft)) < count(validate(|scenario| scenario)));
}

/// The whole scan takes a minute; a short one must not find anything clearly better.
#[test]
#[cfg_attr(debug_assertions, ignore = "takes minutes without optimization")]
fn a_fit_repeated_from_a_short_scan_finds_nothing_clearly_better() {
    let fit = calibrate(1, &mut unwatched).unwrap();
    let here = misfit_of(&Physiological::default());
    assert!(here < fit.misfit + 3.84, "{here} {}", fit.misfit);
    // What the free numbers were fitted to is what the model then gives.
    assert_eq!(misfit_of(&fit.model).to_bits(), fit.misfit.to_bits());
}

#[test]
fn validation_is_the_same_on_one_thread() {
    let here = validate(|scenario| scenario);
    let threads = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    let alone = threads.unwrap().install(|| validate(|scenario| scenario));
    for (here, alone) in here.iter().zip(&alone) {
        assert_eq!(here.predicted, alone.predicted, "{}", here.experiment.key);
        assert_eq!(here.flags, alone.flags);
    }
}
