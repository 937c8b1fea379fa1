//! Every screen as text, at three sizes, without colours and with sixteen; some with 256.
//!
//! `INSTA_UPDATE=always cargo test --test tui_screens` takes what is drawn now for right.

#![cfg(feature = "app")]

use std::sync::Arc;

use contrecoup::injury::{ENERGY, MERIDIAN, SHELL};
use contrecoup::scenario::fields;
use contrecoup::study::unwatched;
use contrecoup::tui::ensemble::RunSamples;
use contrecoup::tui::form::Row;
use contrecoup::tui::model::{Look, Model};
use contrecoup::tui::prepare;
use contrecoup::tui::screens::accuracy::measurement::MeasureAccuracy;
use contrecoup::tui::screens::compare::SimulateMarked;
use contrecoup::tui::screens::map::state::DrawMap;
use contrecoup::tui::simulation::Simulate;
use contrecoup::tui::task::{Question, Report, Task, Ticket};
use contrecoup::tui::terminal::caps::{Depth, Symbols};
use contrecoup::tui::terminal::input::{Input, Parser};
use contrecoup::tui::update::{Effect, Message, begin, update};
use contrecoup::tui::view;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

#[path = "screens/accuracy.rs"]
mod accuracy;
#[path = "screens/doubt.rs"]
mod doubt;
#[path = "support/accuracy.rs"]
mod made_up;
#[path = "support/renew.rs"]
mod renew;
#[path = "support/svg.rs"]
mod svg;

const SIZES: [(u16, u16); 3] = [(60, 20), (80, 24), (120, 40)];

fn look(depth: Depth) -> Look {
    Look {
        depth,
        symbols: Symbols::Braille,
    }
}

/// Does what the app's threads would do.
fn settle(model: &mut Model, effects: Vec<Effect>) {
    let mut open = effects;
    while let Some(effect) = open.pop() {
        let Effect::Start(request) = effect else {
            continue;
        };
        let simulates = request.question::<Simulate>().is_some()
            || request.question::<SimulateMarked>().is_some();
        if !simulates {
            continue;
        }
        let message = Message::News(request.answered(&mut unwatched));
        open.extend(update(model, message));
    }
}

/// The ticket of what is under way.
fn ticket<Q>(task: &Task<Q>) -> Ticket {
    task.job.as_ref().unwrap().ticket
}

fn model(sources: &[&str], depth: Depth) -> Model {
    let sources: Vec<String> = sources.iter().map(|s| (*s).to_owned()).collect();
    let mut model = prepare(&sources, look(depth)).unwrap();
    // A person's own presets would change the pictures.
    model.choices.retain(|choice| choice.origin != "own");
    let effects = begin(&mut model);
    settle(&mut model, effects);
    if let Some(force) = fields::find("impact.force_n")
        && force.text(&model.work.scenario).is_some()
    {
        model.form.selected = Row::Field(force);
    }
    model
}

fn press(model: &mut Model, keys: &str) {
    let mut parser = Parser::default();
    let mut inputs = parser.feed(keys.as_bytes());
    inputs.extend(parser.flush());
    for input in inputs {
        if let Input::Key(event) = input {
            let effects = update(model, Message::Key(event));
            settle(model, effects);
        }
    }
}

/// The text of a screen, then a letter for the style of each cell, then what the letters mean.
fn picture(model: &Model, (width, height): (u16, u16)) -> String {
    let mut buffer = Buffer::empty(Rect::new(0, 0, width, height));
    view::draw(model, &mut buffer);
    let mut styles: Vec<Style> = vec![Style::reset()];
    let (mut text, mut map) = (String::new(), String::new());
    for y in 0..height {
        for x in 0..width {
            let cell = &buffer[(x, y)];
            text += cell.symbol();
            let style = Style {
                underline_color: None,
                ..cell.style()
            };
            let plain = cell.symbol() == " " && style.bg == Some(ratatui::style::Color::Reset);
            if plain && style.add_modifier.is_empty() {
                map.push(' ');
                continue;
            }
            let at = styles.iter().position(|known| *known == style);
            let at = at.unwrap_or_else(|| {
                styles.push(style);
                styles.len() - 1
            });
            map.push(char::from(b'`' + u8::try_from(at).unwrap()));
        }
        text.truncate(text.trim_end().len());
        map.truncate(map.trim_end().len());
        text.push('\n');
        map.push('\n');
    }
    for (i, style) in styles.iter().enumerate().skip(1) {
        let line = format!(
            "{} {:?} on {:?} {:?}\n",
            char::from(b'`' + i as u8),
            style.fg.unwrap_or_default(),
            style.bg.unwrap_or_default(),
            style.add_modifier
        );
        map.push_str(&line);
    }
    format!("{text}\n{map}")
}

/// Takes a picture at every size and in both numbers of colours.
fn pictures(name: &str, sources: &[&str], keys: &str) {
    pictures_after(name, sources, |model| press(model, keys));
}

/// The same after whatever `prepare` does.
fn pictures_after(name: &str, sources: &[&str], prepare: impl Fn(&mut Model)) {
    for depth in [Depth::Mono, Depth::Sixteen] {
        let mut model = model(sources, depth);
        prepare(&mut model);
        for (width, height) in SIZES {
            let name = format!("{name}_{width}x{height}_{depth:?}").to_lowercase();
            insta::assert_snapshot!(name, picture(&model, (width, height)));
        }
    }
}

#[test]
fn main_screen() {
    pictures("main", &[], "");
}

#[test]
fn main_screen_with_the_dial_in_hand_and_a_folded_mesh() {
    let keys = "L".repeat(30) + "\tKK";
    pictures("main_dial", &["paper-600n"], &keys);
}

#[test]
fn main_screen_with_advanced_fields_and_a_bad_value() {
    pictures("main_bad_value", &[], "ajjjjjjjj\r-");
}

#[test]
fn screens_of_256_colours() {
    for (name, keys) in [
        ("main", ""),
        ("replay", "\x1b2"),
        ("compare", "\x1b4\x1b[Z"),
    ] {
        let sources = &["paper-300n", "paper-100n", "paper-600n"];
        let mut model = model(sources, Depth::TwoFiveSix);
        press(&mut model, keys);
        insta::assert_snapshot!(format!("many_colours_{name}"), picture(&model, (80, 24)));
    }
}

#[test]
fn the_picture_of_the_readme_shows_the_main_screen() {
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/pictures/main.svg");
    let model = model(&[], Depth::TwoFiveSix);
    let mut buffer = Buffer::empty(Rect::new(0, 0, 100, 30));
    view::draw(&model, &mut buffer);
    let drawn = svg::svg(&buffer, "contrecoup, main screen");
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
fn replay_screen() {
    pictures("replay", &[], "\x1b2");
}

#[test]
fn replay_screen_under_load_with_nodes_and_exaggeration() {
    pictures("replay_nodes", &["off-axis-triangle"], "\x1b2gez");
}

#[test]
fn force_screen() {
    pictures("forces", &[], "\x1b3");
}

#[test]
fn comparison_screens() {
    let sources = &["paper-300n", "paper-100n", "paper-600n"];
    pictures("compare_list", sources, "\x1b4\x1b[Z");
    pictures("compare_table", sources, "\x1b4lo");
    pictures("compare_replays", sources, "\x1b4\t");
}

/// Opens the screen and lets a made-up measurement end.
fn open_measured(model: &mut Model) {
    press(model, "\x1b5");
    let ticket = ticket(&model.screens.accuracy.task);
    let report = Report::done::<MeasureAccuracy>(ticket, Ok(made_up::made_up()));
    update(model, Message::News(report));
}

#[test]
fn accuracy_screens() {
    pictures_after("accuracy", &[], open_measured);
    let wait = |model: &mut Model| {
        press(model, "\x1b5");
        let report = Report::progress(ticket(&model.screens.accuracy.task), 0.43);
        update(model, Message::News(report));
    };
    pictures_after("accuracy_measuring", &[], wait);
    let edit = |model: &mut Model| {
        open_measured(model);
        press(model, "Ll");
        model.work.scenario.window_ms = 2.0;
    };
    pictures_after("accuracy_stale", &[], edit);
}

/// Opens the screen and lets a few samples of those asked for be run.
fn open_sampled(model: &mut Model) {
    press(model, "\x1b6");
    let job = model.ensemble.task.job.as_ref().unwrap();
    let few = RunSamples {
        count: 24,
        ..(*job.question).clone()
    };
    let report = Report::done::<RunSamples>(job.ticket, few.answer(&mut unwatched));
    update(model, Message::News(report));
}

#[test]
fn doubt_screens() {
    let doubtful = |model: &mut Model| {
        press(model, "\r +- 30\r");
        open_sampled(model);
        press(model, "jj");
    };
    pictures_after("doubt", &[], doubtful);
    let running = |model: &mut Model| {
        press(model, "\x1b6");
        let report = Report::progress(ticket(&model.ensemble.task), 0.43);
        update(model, Message::News(report));
    };
    pictures_after("doubt_running", &[], running);
    let beside = |model: &mut Model| {
        press(model, "\r +- 30\r");
        open_sampled(model);
        press(model, "1");
    };
    pictures_after("main_with_band", &[], beside);
}

/// Opens the screen and lets the first grid be computed.
fn open_mapped(model: &mut Model) {
    press(model, "\x1b7");
    let job = model.screens.map.task.job.as_ref().unwrap();
    let report = Report::done::<DrawMap>(job.ticket, job.question.answer(&mut unwatched));
    update(model, Message::News(report));
    let report = Report::progress(ticket(&model.screens.map.task), 0.43);
    update(model, Message::News(report));
}

#[test]
fn map_screens() {
    let moved = |model: &mut Model| {
        open_mapped(model);
        press(model, "LLKl");
    };
    pictures_after("map", &[], moved);
    let other = |model: &mut Model| {
        press(model, "\x1b7x-");
    };
    pictures_after("map_waiting", &["off-axis-triangle"], other);
}

#[test]
fn a_projectile_brings_its_pressure_its_force_and_its_injury_curves() {
    pictures("main_projectile", &["bb-56"], "");
    // Slow enough not to fold: a folded mesh magnifies round-off, which differs between machines.
    pictures("replay_projectile", &["golf-ball"], "jjjjj3\r\x1b2");
    pictures("forces_pressure", &["bb-56"], "\x1b3vvvvvvv");
    pictures("injury", &["bb-56"], "\x1b8jjjjj");
    pictures("injury_large", &["soccer-ball"], "\x1b8");
    pictures("injury_none", &[], "\x1b8");
}

#[test]
fn figures_of_no_checked_source_are_marked_until_they_are_typed() {
    pictures("main_unverified", &["fist"], "jjjjj.3\rkk");
    pictures("replay_unverified", &["fist"], "jjjjj.3\r\x1b2");
    let mut model = model(&["golf-ball"], Depth::Mono);
    let speed = fields::find("impact.speed_m_s").unwrap();
    for size in SIZES {
        model.form.selected = Row::Preset;
        let text = picture(&model, size);
        assert!(line_from(&text, " Speed").starts_with(" Speed "));
        assert!(line_from(&text, " Speed").contains(" ? "));
        assert!(
            !line_from(&text, " Mass")
                .split('│')
                .next()
                .unwrap()
                .contains('?')
        );
        model.form.selected = Row::Field(speed);
        assert!(picture(&model, size).contains("? unverified figure"));
    }
    press(&mut model, "50\r");
    assert!(!picture(&model, (80, 24)).contains("? unverified"));
}

#[test]
fn a_small_terminal_still_asks_what_it_waits_for() {
    let mut model = model(&[], Depth::Mono);
    press(&mut model, "lq");
    for size in [(60, 5), (20, 5), (59, 19)] {
        let text = picture(&model, size).replace('\n', " ");
        let words: Vec<&str> = text.split_whitespace().collect();
        assert!(
            words.join(" ").contains("unsaved: y quits, n stays"),
            "{text}"
        );
    }
}

#[test]
fn overlays() {
    for (name, keys) in [
        ("help", "?"),
        ("picker", "p"),
        ("save", "s"),
        ("save_hidden", "ls\x15paper-300n\r"),
        ("letter_in_a_number", "7u"),
        ("quit", "lq"),
    ] {
        let mut model = model(&[], Depth::Mono);
        press(&mut model, keys);
        insta::assert_snapshot!(name, picture(&model, (80, 24)));
    }
}

#[test]
fn a_refused_edit_keeps_the_last_good_result_marked_as_such() {
    let mut model = model(&[], Depth::Mono);
    let good = Arc::clone(&model.shown.as_ref().unwrap().answer);
    // A step above the stability limit.
    press(&mut model, "a");
    press(&mut model, &"j".repeat(40));
    press(&mut model, "\r\x15900\r");
    assert!(Arc::ptr_eq(&good, &model.shown.as_ref().unwrap().answer));
    let text = picture(&model, (80, 24));
    assert!(text.contains("last good result") && text.contains("above the"));
}

#[test]
fn no_size_and_no_screen_makes_the_drawing_fail() {
    let mut model = model(&["paper-300n", "wide-area"], Depth::Sixteen);
    open_measured(&mut model);
    open_sampled(&mut model);
    open_mapped(&mut model);
    for symbols in [Symbols::Braille, Symbols::Block, Symbols::Ascii] {
        model.look.symbols = symbols;
        for keys in [
            "\x1b1", "\x1b2", "3", "v", "4", "\t", "\t", "5", "6", "7", "8", "1?", "?p", "\x1bs",
        ] {
            press(&mut model, keys);
            for width in [1, 20, 59, 60, 61, 79, 100, 300] {
                for height in [1, 5, 19, 20, 21, 50, 100] {
                    let area = Rect::new(0, 0, width, height);
                    let mut buffer = Buffer::empty(area);
                    view::draw(&model, &mut buffer);
                    if symbols == Symbols::Ascii {
                        assert!(buffer.content.iter().all(|c| c.symbol().is_ascii()));
                    }
                }
            }
        }
    }
}

#[test]
fn what_a_name_holds_never_reaches_the_terminal_as_a_command() {
    let mut model = model(&[], Depth::Mono);
    model.work.source = "\u{1b}[2J\u{202e}evil".to_owned();
    for size in SIZES {
        let text = picture(&model, size);
        assert!(!text.contains(['\u{1b}', '\u{202e}']));
    }
}

/// The line that has a word, from that word on.
fn line_from<'a>(text: &'a str, word: &str) -> &'a str {
    let line = text.lines().find(|line| line.contains(word));
    let line = line.unwrap_or_else(|| panic!("no {word} in\n{text}"));
    &line[line.find(word).unwrap()..]
}

#[test]
fn points_of_a_large_blow_stand_whole_beside_their_threshold() {
    let mut model = model(&["paper-600n"], Depth::Mono);
    press(&mut model, "\r\x1520000\r");
    let index = &model.shown.as_ref().unwrap().answer.index;
    let parts = [
        ("S shell", "1.5", SHELL.points(index.shell_growth)),
        ("M meridian", "4", MERIDIAN.points(index.meridian_growth)),
        ("E energy", "5.3", ENERGY.points(index.energy)),
    ];
    assert!(parts[2].2 > 1e4);
    for size in SIZES {
        let text = picture(&model, size);
        for (name, threshold, points) in parts {
            let line = line_from(&text, name);
            let words: Vec<&str> = line.split_whitespace().collect();
            assert_eq!(words[4..6], ["of", threshold], "{line}");
            let last = words.last().unwrap().split('/').next().unwrap();
            let shown: f64 = last.parse().unwrap_or_else(|_| panic!("{line}"));
            assert!((shown / points - 1.0).abs() < 0.05, "{line}");
        }
    }
}

#[test]
fn the_legend_of_the_energies_is_whole() {
    let mut model = model(&[], Depth::Mono);
    press(&mut model, "\x1b3vvvvvv");
    for size in SIZES {
        let text = picture(&model, size);
        for name in ["1 kinetic", "2 elastic", "3 dissipated", "4 work in"] {
            let rest = &line_from(&text, name)[name.len()..];
            let words: Vec<&str> = rest.split_whitespace().collect();
            assert!(words[0].parse::<f64>().is_ok() && words[1] == "J", "{text}");
        }
    }
}

#[test]
fn a_projectile_has_a_force_of_contact_where_a_pulse_has_its_load() {
    let mut model = model(&["bb-56"], Depth::Mono);
    press(&mut model, "\x1b2");
    let text = picture(&model, (80, 24));
    assert!(text.contains(" contact ") && !text.contains(" load "));
    assert!(text.contains('⣿'), "the bar of time has the force in it");
    press(&mut model, "\x1b3vvvvv");
    assert!(picture(&model, (80, 24)).contains("contact, N"));
    for (sources, label) in [
        (["paper-300n", "wide-area"], "load, N"),
        (["paper-300n", "bb-56"], "load or contact, N"),
        (["golf-ball", "bb-56"], "contact, N"),
    ] {
        let mut model = self::model(&sources, Depth::Mono);
        press(&mut model, "\x1b4vvvv");
        let text = picture(&model, (80, 24));
        assert!(text.contains(&format!(" {label}")), "{label}\n{text}");
    }
}

#[test]
fn curves_that_no_answer_has_are_not_offered() {
    let mut model = model(&["paper-300n", "wide-area"], Depth::Mono);
    press(&mut model, "\x1b4");
    for _ in 0..20 {
        press(&mut model, "v");
        assert!(!picture(&model, (80, 24)).contains("pressure, MPa"));
    }
}

#[test]
fn bands_of_many_results_scrolls_above_what_drives_them() {
    let mut model = model(&["bb-56"], Depth::Mono);
    open_sampled(&mut model);
    for keys in ["", "jjjjjjjjjjjjjjjjjjjjjj"] {
        press(&mut model, keys);
        for size in SIZES {
            let text = picture(&model, size);
            let lines: Vec<&str> = text.lines().collect();
            let at = lines.iter().position(|line| line.contains("What drives"));
            let drivers = &lines[at.unwrap() + 1..at.unwrap() + 4];
            let is_bar = |line: &&str| line.contains("0.") || line.contains("1.00");
            assert!(drivers.iter().all(is_bar), "{text}");
            assert_eq!(text.matches('▸').count(), 1);
        }
    }
}

#[test]
fn six_marked_presets_leave_room_for_their_curves() {
    let six = [
        "paper-300n",
        "paper-100n",
        "paper-600n",
        "wide-area",
        "bb-56",
        "golf-ball",
    ];
    let mut model = model(&six, Depth::Mono);
    press(&mut model, "\x1b4");
    for size in SIZES {
        let text = picture(&model, size);
        assert!(text.contains("centre, N") && text.contains("v curves"));
        assert!(
            six.iter()
                .all(|name| text.contains(&name[..8.min(name.len())]))
        );
    }
}

#[test]
fn what_a_folded_mesh_makes_of_a_risk_is_said_beside_it() {
    let mut model = model(&["bb-56"], Depth::Mono);
    press(&mut model, "\x1b8");
    for size in SIZES {
        assert!(picture(&model, size).contains("FLAGS mesh folded"));
    }
}

#[test]
fn a_peak_has_its_time_beside_it_however_long_its_number() {
    let model = model(&["bb-56"], Depth::Mono);
    let text = picture(&model, (80, 24));
    for name in ["centre", "front", "right", "top ", "press.", "contact"] {
        let line = line_from(&text, name);
        assert!(line.ends_with("ms"), "{line}");
    }
    let text = picture(&model, (60, 20));
    assert!(line_from(&text, "press.").ends_with("MPa"));
}
