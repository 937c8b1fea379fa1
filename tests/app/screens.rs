//! Every screen as it is drawn from made-up answers: no picture changes when the physics does.
//!
//! A file of `snapshots` is one screen at one size. At 80 x 24 it has sixteen colours, and below
//! its text stands where each style is; at the other sizes it has no colours, and text alone.
//!
//! `INSTA_UPDATE=always cargo test --release --test app screens` takes what is drawn now for
//! right.

use crate::renew;
use std::time::Duration;

use contrecoup::injury::Injury;
use contrecoup::many::threshold::{Crossing, RiskThere, Threshold};
use contrecoup::tui::app::App;
use contrecoup::tui::app::update::{Message, update};
use contrecoup::tui::overlay::Overlay;
use contrecoup::tui::picker::Picker;
use contrecoup::tui::request::Report;
use contrecoup::tui::screens::accuracy::Measurement;
use contrecoup::tui::terminal::caps::Depth;
use contrecoup::tui::threshold::FindThreshold;
use drawn::{
    SIZES, app, app_by, cells, open_mapped, open_measured, open_sampled, picture, press, styled,
    ticket,
};

mod accuracy;
mod anatomy;
mod doubt;
mod drawn;
mod svg;
mod words;

const USUAL: (u16, u16) = (80, 24);

/// Compares a picture with the file of this name.
fn compare(name: &str, picture: &str) {
    let mut settings = insta::Settings::clone_current();
    settings.set_omit_expression(true);
    settings.set_prepend_module_to_snapshot(false);
    settings.bind(|| insta::assert_snapshot!(name.to_owned(), picture));
}

/// Takes pictures of a screen at these sizes, after whatever `prepare` does.
fn pictures(name: &str, sources: &[&str], sizes: &[(u16, u16)], prepare: impl Fn(&mut App)) {
    for &(width, height) in sizes {
        let usual = (width, height) == USUAL;
        let depth = if usual { Depth::Sixteen } else { Depth::Mono };
        let mut app = app(sources, depth);
        prepare(&mut app);
        let drawn = if usual { styled(&app) } else { picture(&app, (width, height)) };
        compare(&format!("{name}_{width}x{height}"), &drawn);
    }
}

/// A screen at every size, after these keys.
fn screen(name: &str, sources: &[&str], keys: &str) {
    pictures(name, sources, &SIZES, |app| press(app, keys));
}

/// What differs from another screen by its words and styles and not by its layout: at one size.
fn state(name: &str, sources: &[&str], keys: &str) {
    pictures(name, sources, &[USUAL], |app| press(app, keys));
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
    for (name, keys) in [("main", ""), ("replay", "\x1b2"), ("compare", "\x1b4\x1b[Z")] {
        for (colours, depth) in [("many", Depth::TwoFiveSix), ("no", Depth::Mono)] {
            let mut app = app(sources, depth);
            press(&mut app, keys);
            compare(&format!("{colours}_colours_{name}"), &styled(&app));
        }
    }
}

/// The one picture of a real answer.
#[test]
fn the_picture_of_the_readme_shows_the_main_screen() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/pictures/main.svg");
    let app = app_by(&["squash-ball"], Depth::TwoFiveSix, anatomy::solved);
    let drawn = svg::svg(&cells(&app, (100, 30)), "contrecoup, main screen");
    if renew::is_asked("picture") {
        std::fs::write(file, &drawn).unwrap();
    }
    let kept = std::fs::read_to_string(file).unwrap_or_default();
    let renew = "FIGURES=picture cargo test --release --test app the_picture";
    assert!(kept == drawn, "the screen has changed; `{renew}` draws it again");
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
    pictures("doubt_round", &[file], &[USUAL], |app| {
        // The rows above the numbers are chosen from lists.
        press(app, "\x1b[B\x1b[B\x1b[B\r +- 0.1\r");
        assert!(!app.model.work.scenario.doubt.is_empty());
        open_sampled(app);
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
    pictures("accuracy_measuring", &[], &[USUAL], |app| {
        press(app, "\x1b5");
        let report =
            Report::progress(ticket(&app.state::<Measurement>().task), 0.43, Duration::ZERO);
        update(app, Message::News(report));
    });
    pictures("accuracy_more_exact", &[], &[USUAL], |app| {
        open_measured(app);
        press(app, ">");
    });
}

#[test]
fn doubt_screens() {
    let doubtful = |app: &mut App| {
        press(app, "\r +- 30\r");
        open_sampled(app);
    };
    pictures("doubt", &[], &SIZES, |app| {
        doubtful(app);
        press(app, "jj");
    });
    pictures("doubt_running", &[], &[USUAL], |app| {
        press(app, "\x1b6");
        let report = Report::progress(ticket(&app.model.ensemble.task), 0.43, Duration::ZERO);
        update(app, Message::News(report));
    });
    pictures("main_with_band", &[], &SIZES, |app| {
        doubtful(app);
        press(app, "1");
    });
}

#[test]
fn map_screens() {
    pictures("map", &[], &SIZES, |app| {
        open_mapped(app);
        press(app, "LLKl");
    });
    state("map_waiting", &["off-axis-triangle"], "\x1b7x-");
}

#[test]
fn a_projectile_brings_its_pressure_its_force_and_its_injuries() {
    screen("main_projectile", &["bb-56"], "");
    screen("replay_projectile", &["golf-ball"], "\x1b2");
    state("replay_front", &["golf-ball"], "\x1b2f");
    state("forces_pressure", &["bb-56"], "\x1b3vvvvvvvvv");
    screen("injury", &["bb-56"], "\x1b8jjjjj");
    pictures("injury_large", &["soccer-ball"], &SIZES[..2], |app| {
        press(app, "\x1b8");
    });
    state("injury_none", &[], "\x1b8");
}

#[test]
fn figures_of_no_checked_source_are_marked() {
    state("main_unverified", &["fist"], ".3\rkk");
    state("replay_unverified", &["fist"], ".3\r\x1b2");
}

#[test]
fn the_list_of_what_can_be_opened() {
    screen("picker", &["bb-56"], "p");
    pictures("first_start", &[], &SIZES, |app| {
        let mut picker = Picker::at(&app.model.choices, "");
        picker.first = true;
        app.model.overlay = Some(Overlay::Picker(picker));
    });
}

#[test]
fn the_question_at_which_value_a_result_is_reached() {
    pictures("threshold", &["bb-56"], &SIZES[..2], |app| {
        press(app, "t");
    });
    pictures("threshold_found", &["bb-56"], &[USUAL], |app| {
        press(app, "t\r");
        let Some(Overlay::Threshold(asking)) = &app.model.overlay else {
            panic!("nothing is asked")
        };
        let job = asking.task.job.as_ref().unwrap();
        let answer = &app.model.shown.as_ref().unwrap().answer;
        let crossing = Crossing {
            at: 61.234,
            rising: true,
            step: None,
            mesh: None,
            jump: None,
            flags: Vec::new(),
            risk: answer
                .risk(Injury::GlobeRupture)
                .map(|risk| RiskThere { risk, range: (Some(38.2), Some(95.1)) }),
        };
        let found = Threshold { seen: Vec::new(), crossings: vec![crossing] };
        let report = Report::done::<FindThreshold>(job.ticket, Ok(found));
        update(app, Message::News(report));
    });
}

#[test]
fn overlays() {
    for (name, keys) in [
        ("help", "?"),
        ("picker_searched", "psqua ball"),
        ("save", "\x13"),
        ("save_hidden", "l\x13\x15paper-300n\r"),
        ("letter_in_a_number", "7u"),
        ("quit", "lq"),
    ] {
        state(name, &[], keys);
    }
}
