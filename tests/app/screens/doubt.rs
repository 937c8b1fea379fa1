//! What the screens say of samples: which scenario they are of, how many, and their numbers apart.

use super::drawn::{SIZES, app, line_from, open_sampled, picture, press, ticket};
use crate::made_up;
use std::time::Duration;

use contrecoup::many::ensemble::Ensemble;
use contrecoup::run::quantity::Quantity;
use contrecoup::tui::app::App;
use contrecoup::tui::app::update::Message;
use contrecoup::tui::app::update::update;
use contrecoup::tui::ensemble::RunSamples;
use contrecoup::tui::request::Report;
use contrecoup::tui::terminal::caps::{Depth, Symbols};

/// Opens the screen and lets made-up samples come, changed by `then`.
fn open_changed(app: &mut App, then: impl Fn(&mut Ensemble)) {
    press(app, "\x1b6");
    let job = app.model.ensemble.task.job.as_ref().unwrap();
    let ticket = job.ticket;
    let mut done = made_up::ensemble(&job.question.scenario, job.question.count);
    then(&mut done);
    let report = Report::done::<RunSamples>(ticket, Ok(done));
    update(app, Message::News(report));
}

#[test]
fn bands_of_the_scenario_before_are_not_shown() {
    let mut app = app(&[], Depth::Mono);
    open_sampled(&mut app);
    assert!(picture(&app, (80, 24)).contains("as entered"));
    press(&mut app, "\x1b1\r\x15200\r\x1b6");
    let report = Report::progress(ticket(&app.model.ensemble.task), 0.01, Duration::ZERO);
    update(&mut app, Message::News(report));
    for size in SIZES {
        let text = picture(&app, size);
        assert!(text.contains("10 of 1000"), "{text}");
        for word in ["as it stands", "◆", "median", "What drives", "Bands of"] {
            assert!(!text.contains(word), "{text}");
        }
    }
    open_sampled(&mut app);
    assert!(picture(&app, (80, 24)).contains("Bands of 1000"));
    // Undone on the screen itself: nothing is shown before it has run.
    press(&mut app, "u");
    let text = picture(&app, (80, 24));
    assert!(text.contains("0 of 1000") && !text.contains("Bands of"), "{text}");
}

#[test]
fn what_the_bands_hold_is_said_beside_many_results() {
    let mut app = app(&["golf-ball"], Depth::Mono);
    open_changed(&mut app, |_| {});
    let results = app.model.ensemble.of(&app.model.work.scenario).unwrap().results();
    assert!(results.len() > 13);
    for keys in ["", "jjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjjj"] {
        press(&mut app, keys);
        for size in SIZES {
            let text = picture(&app, size);
            assert!(text.contains("* Bands of 1000 of 1000 samples, those that ran."));
            let words: Vec<&str> = text.split_whitespace().collect();
            assert!(words.join(" ").contains("Flags: 834 mesh folded"), "{text}");
            // Each has a strip, if only a mark on the scale of its unit.
            let named =
                |line: &&str| line.contains(['├', '┤', '◆']) && !line.contains("as entered");
            let shown = text.lines().filter(named).count();
            let marked = text.contains(&format!(" of {} ", results.len()));
            assert_eq!(marked, shown < results.len(), "{text}");
            assert_eq!(shown < results.len() && keys.is_empty(), text.contains(" ▾"));
            assert_eq!(shown < results.len() && !keys.is_empty(), text.contains("▴ "));
            let drivers = line_from(&text, "What drives");
            assert!(drivers.contains(" of "), "{text}");
        }
    }
}

#[test]
fn risks_have_no_band_and_it_is_said_where_they_stand() {
    let mut app = app(&["bb-56"], Depth::Mono);
    open_sampled(&mut app);
    for size in SIZES {
        let text = picture(&app, size);
        assert!(!text.contains("globe rupture %"), "{text}");
        let words: Vec<&str> = text.split_whitespace().collect();
        assert!(words.join(" ").contains("Risks and their ranges stand on F1"), "{text}");
    }
}

#[test]
fn numbers_of_any_length_stand_apart() {
    let mut app = app(&[], Depth::Mono);
    open_changed(&mut app, |ensemble| {
        for sample in &mut ensemble.samples {
            let point = sample.outcome.as_mut().unwrap();
            for (of, long) in [
                (Quantity::Damage, 3.482e-16),
                (Quantity::ShellGrowth, -0.0063),
                (Quantity::MeridianGrowth, -1.016e-13),
                (Quantity::Energy, 123_456.7),
            ] {
                point.values[of] = Some(long);
            }
        }
    });
    for size in SIZES {
        let text = picture(&app, size);
        for (name, value) in [
            ("damage index", "3.48e-16"),
            ("wall growth S %", "-0.00630"),
            ("width growth M %", "-1.0e-13"),
            ("energy imparted E J", "123457"),
        ] {
            let words: Vec<&str> =
                line_from(&text, name)[name.len()..].split_whitespace().collect();
            assert_eq!(words[..3], [value; 3], "{text}");
        }
    }
}

#[test]
fn a_band_of_fewer_samples_than_were_asked_for_is_marked() {
    let mut app = app(&[], Depth::Mono);
    open_sampled(&mut app);
    // Stopped after a few: the rest was asked for and is not there.
    let done = app.model.ensemble.done.take().unwrap();
    let mut stopped = (*done.1).clone();
    stopped.samples.truncate(24);
    app.model.ensemble.done = Some((done.0.clone(), stopped.clone().into()));
    let text = picture(&app, (80, 24));
    let said = line_from(&text, "* Bands of 24 of 24 samples done (1000 asked for)");
    assert!(!said.is_empty());
    press(&mut app, "\x1b1");
    for size in SIZES {
        let text = picture(&app, size);
        let line = line_from(&text, "inputs in doubt: ");
        let whole = line.contains("(90 % of 24 of 1000)");
        assert!(whole || size.0 == 60 && line.contains('*'), "{line}");
    }
    stopped.asked = 24;
    app.model.ensemble.done = Some((done.0, stopped.into()));
    for size in SIZES {
        let text = picture(&app, size);
        let line = line_from(&text, "inputs in doubt: ");
        assert!(!line.contains('*'), "{line}");
    }
}

#[test]
fn a_doubt_is_no_sum_in_ascii() {
    let mut app = app(&[], Depth::Mono);
    app.model.look.symbols = Symbols::Ascii;
    press(&mut app, "\r ± 30");
    assert!(picture(&app, (80, 24)).contains("300 +-30"));
    press(&mut app, "\r");
    for size in SIZES {
        assert!(picture(&app, size).contains("300 +-30 N"));
    }
    open_sampled(&mut app);
    assert!(picture(&app, (120, 40)).contains("normal 300.0 +-30.00 N"));
}

#[test]
fn bands_of_many_results_scrolls_above_what_drives_them() {
    let mut app = app(&["bb-56"], Depth::Mono);
    open_sampled(&mut app);
    for keys in ["", "jjjjjjjjjjjjjjjjjjjjjj"] {
        press(&mut app, keys);
        for size in SIZES {
            let text = picture(&app, size);
            let lines: Vec<&str> = text.lines().collect();
            let at = lines.iter().position(|line| line.contains("What drives"));
            let drivers = &lines[at.unwrap() + 1..at.unwrap() + 4];
            let is_bar = |line: &&str| line.contains("0.") || line.contains("1.00");
            assert!(drivers.iter().all(is_bar), "{text}");
            assert_eq!(text.matches('▸').count(), 1);
        }
    }
}
