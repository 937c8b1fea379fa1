//! Every screen as it is drawn from made-up answers: no picture changes when the physics does.
//!
//! A file of `snapshots` is one screen at one size. At 80 x 24 it has sixteen colours, and below its
//! text stands where each style is; at the other sizes it has no colours, and text alone.
//!
//! `INSTA_UPDATE=always cargo test --release --test tui_screens` takes what is drawn now for right.

#![cfg(feature = "app")]

use std::time::Duration;

use contrecoup::answer::solve::Answer;
use contrecoup::many::threshold::{Crossing, Threshold};
use contrecoup::run::watch::unwatched;
use contrecoup::scenario::Scenario;
use contrecoup::tui::model::{Model, Overlay};
use contrecoup::tui::picker::Picker;
use contrecoup::tui::simulation::Simulate;
use contrecoup::tui::task::{Question, Report};
use contrecoup::tui::terminal::caps::Depth;
use contrecoup::tui::threshold::FindThreshold;
use contrecoup::tui::update::{Message, update};
use drawn::{
    SIZES, cells, model, model_by, open_mapped, open_measured, open_sampled, picture, press,
    styled, ticket,
};

#[path = "screens/accuracy.rs"]
mod accuracy;
#[path = "screens/doubt.rs"]
mod doubt;
#[path = "screens/drawn.rs"]
mod drawn;
#[path = "support/made_up.rs"]
mod made_up;
#[path = "support/made_up_accuracy.rs"]
mod made_up_accuracy;
#[path = "support/renew.rs"]
mod renew;
#[path = "support/svg.rs"]
mod svg;
#[path = "screens/words.rs"]
mod words;

const USUAL: (u16, u16) = (80, 24);

/// Compares a picture with the file of this name.
fn compare(name: &str, picture: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(name.to_owned(), picture));
}

/// Takes pictures of a screen at these sizes, after whatever `prepare` does.
fn pictures(name: &str, sources: &[&str], sizes: &[(u16, u16)], prepare: impl Fn(&mut Model)) {
    for &(width, height) in sizes {
        let usual = (width, height) == USUAL;
        let depth = if usual { Depth::Sixteen } else { Depth::Mono };
        let mut model = model(sources, depth);
        prepare(&mut model);
        let drawn = if usual {
            styled(&model)
        } else {
            picture(&model, (width, height))
        };
        compare(&format!("{name}_{width}x{height}"), &drawn);
    }
}

/// A screen at every size, after these keys.
fn screen(name: &str, sources: &[&str], keys: &str) {
    pictures(name, sources, &SIZES, |model| press(model, keys));
}

/// What differs from another screen by its words and styles and not by its layout: at one size.
fn state(name: &str, sources: &[&str], keys: &str) {
    pictures(name, sources, &[USUAL], |model| press(model, keys));
}

#[test]
fn main_screen() {
    screen("main", &[], "");
}

#[test]
fn main_screen_with_the_dial_in_hand_and_a_folded_mesh() {
    let keys = "L".repeat(30) + "\tKK";
    state("main_dial", &["paper-600n"], &keys);
}

#[test]
fn main_screen_with_advanced_fields_and_a_bad_value() {
    state("main_bad_value", &[], "ajjjjjjjj\r-");
}

#[test]
fn screens_of_256_colours_and_of_none() {
    let sources = &["paper-300n", "paper-100n", "paper-600n"];
    for (name, keys) in [
        ("main", ""),
        ("replay", "\x1b2"),
        ("compare", "\x1b4\x1b[Z"),
    ] {
        for (colours, depth) in [("many", Depth::TwoFiveSix), ("no", Depth::Mono)] {
            let mut model = model(sources, depth);
            press(&mut model, keys);
            compare(&format!("{colours}_colours_{name}"), &styled(&model));
        }
    }
}

/// The one picture of a real answer.
#[test]
fn the_picture_of_the_readme_shows_the_main_screen() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/pictures/main.svg");
    let solved = |scenario: &Scenario| -> Answer {
        Simulate(scenario.clone()).answer(&mut unwatched).unwrap()
    };
    let model = model_by(&[], Depth::TwoFiveSix, solved);
    let drawn = svg::svg(&cells(&model, (100, 30)), "contrecoup, main screen");
    if renew::is_asked("picture") {
        std::fs::write(file, &drawn).unwrap();
    }
    let kept = std::fs::read_to_string(file).unwrap_or_default();
    let renew = "FIGURES=picture cargo test --release --test tui_screens the_picture";
    assert!(
        kept == drawn,
        "the screen has changed; `{renew}` draws it again"
    );
}

#[test]
fn replay_screens() {
    screen("replay", &[], "\x1b2");
    // Under load, with nodes and exaggeration.
    state("replay_nodes", &["off-axis-triangle"], "\x1b2gez");
}

#[test]
fn the_round_eye_is_drawn_whole_and_coloured_by_force_or_pressure() {
    let file = "tests/scenarios/round-eye.ron";
    screen("main_round", &[file], "");
    screen("replay_round", &[file], "\x1b2");
    screen("replay_round_pressure", &[file], "\x1b2cg");
    state("forces_round", &[file], "\x1b3v");
    state("injury_round", &[file], "\x1b8");
}

#[test]
fn the_round_eye_stands_beside_a_section_in_a_comparison_and_has_a_map_and_samples() {
    let file = "tests/scenarios/round-eye.ron";
    state("compare_round", &[file, "paper-300n"], "\x1b4\t");
    pictures("doubt_round", &[file], &[USUAL], |model| {
        // The rows above the numbers are chosen from lists.
        press(model, "\x1b[B\x1b[B\x1b[B\r +- 0.1\r");
        assert!(!model.work.scenario.doubt.is_empty());
        open_sampled(model);
    });
    pictures("map_round", &[file], &[USUAL], open_mapped);
}

#[test]
fn force_screen() {
    screen("forces", &[], "\x1b3");
}

#[test]
fn comparison_screens() {
    let sources = &["paper-300n", "paper-100n", "paper-600n"];
    screen("compare_list", sources, "\x1b4\x1b[Z");
    screen("compare_table", sources, "\x1b4lo");
    screen("compare_replays", sources, "\x1b4\t");
}

#[test]
fn accuracy_screens() {
    pictures("accuracy", &[], &SIZES, open_measured);
    pictures("accuracy_measuring", &[], &[USUAL], |model| {
        press(model, "\x1b5");
        let report = Report::progress(ticket(&model.screens.accuracy.task), 0.43, Duration::ZERO);
        update(model, Message::News(report));
    });
    pictures("accuracy_more_exact", &[], &[USUAL], |model| {
        open_measured(model);
        press(model, ">");
    });
}

#[test]
fn doubt_screens() {
    let doubtful = |model: &mut Model| {
        press(model, "\r +- 30\r");
        open_sampled(model);
    };
    pictures("doubt", &[], &SIZES, |model| {
        doubtful(model);
        press(model, "jj");
    });
    pictures("doubt_running", &[], &[USUAL], |model| {
        press(model, "\x1b6");
        let report = Report::progress(ticket(&model.ensemble.task), 0.43, Duration::ZERO);
        update(model, Message::News(report));
    });
    pictures("main_with_band", &[], &SIZES, |model| {
        doubtful(model);
        press(model, "1");
    });
}

#[test]
fn map_screens() {
    pictures("map", &[], &SIZES, |model| {
        open_mapped(model);
        press(model, "LLKl");
    });
    state("map_waiting", &["off-axis-triangle"], "\x1b7x-");
}

#[test]
fn a_projectile_brings_its_pressure_its_force_and_its_injury_curves() {
    screen("main_projectile", &["bb-56"], "");
    screen("replay_projectile", &["golf-ball"], "\x1b2");
    state("forces_pressure", &["bb-56"], "\x1b3vvvvvvvv");
    screen("injury", &["bb-56"], "\x1b8jjjjj");
    pictures("injury_large", &["soccer-ball"], &SIZES[..2], |model| {
        press(model, "\x1b8");
    });
    state("injury_none", &[], "\x1b8");
}

#[test]
fn figures_of_no_checked_source_are_marked() {
    state("main_unverified", &["fist"], "jjjjj.3\rkk");
    state("replay_unverified", &["fist"], "jjjjj.3\r\x1b2");
}

#[test]
fn the_list_of_what_can_be_opened() {
    screen("picker", &["bb-56"], "p");
    pictures("first_start", &[], &SIZES, |model| {
        let mut picker = Picker::at(&model.choices, "");
        picker.first = true;
        model.overlay = Some(Overlay::Picker(picker));
    });
}

#[test]
fn the_question_at_which_value_a_result_is_reached() {
    pictures("threshold", &["bb-56"], &SIZES[..2], |model| {
        press(model, "jjjjjt");
    });
    pictures("threshold_found", &["bb-56"], &[USUAL], |model| {
        press(model, "jjjjjt\x1b[A\x1b[A\r");
        let Some(Overlay::Threshold(asking)) = &model.overlay else {
            panic!("nothing is asked")
        };
        let job = asking.task.job.as_ref().unwrap();
        let crossing = Crossing {
            at: 61.234,
            rising: true,
            step: Some(0.1),
            mesh: Some(18.0),
            jump: None,
            flags: Vec::new(),
            believed: None,
            caution: None,
        };
        let found = Threshold {
            seen: Vec::new(),
            crossings: vec![crossing],
        };
        let report = Report::done::<FindThreshold>(job.ticket, Ok(found));
        update(model, Message::News(report));
    });
}

#[test]
fn overlays() {
    for (name, keys) in [
        ("help", "?"),
        ("picker_searched", "psqua ball"),
        ("save", "s"),
        ("save_hidden", "ls\x15paper-300n\r"),
        ("letter_in_a_number", "7u"),
        ("quit", "lq"),
    ] {
        state(name, &[], keys);
    }
}
