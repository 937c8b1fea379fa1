//! What every screen says whatever its size: words and numbers that must stand whole.

use std::sync::Arc;

use super::drawn::{
    SIZES, app, cells, line_from, open_mapped, open_measured, open_sampled, picture, press, ticket,
};
use contrecoup::injury::{ENERGY, Injury};
use contrecoup::run::quantity::Quantity;
use contrecoup::run::refusal::Refusal;
use contrecoup::scenario::fields;
use contrecoup::tui::app::App;
use contrecoup::tui::app::update::{Message, update};
use contrecoup::tui::form::FormRow;
use contrecoup::tui::request::Report;
use contrecoup::tui::simulation::Simulate;
use contrecoup::tui::terminal::caps::{Depth, Symbols};

#[test]
fn a_small_terminal_still_asks_what_it_waits_for() {
    let mut app = app(&[], Depth::Mono);
    press(&mut app, "lq");
    for size in [(60, 5), (20, 5), (59, 19)] {
        let text = picture(&app, size).replace('\n', " ");
        let words: Vec<&str> = text.split_whitespace().collect();
        assert!(words.join(" ").contains("Quit without saving the changes? y or n"), "{text}");
    }
}

#[test]
fn a_refused_edit_keeps_the_last_good_result_marked_as_such() {
    let mut app = app(&[], Depth::Mono);
    press(&mut app, "l");
    let good = Arc::clone(&app.model.shown.as_ref().unwrap().answer);
    let question = Simulate(app.model.work.scenario.clone());
    app.model.run.ask(question, &mut app.model.out);
    let refusal =
        Refusal::StepAboveLimit { step_us: 900.0, integrator: "velocity-verlet", limit_us: 7.0 };
    let report = Report::done::<Simulate>(ticket(&app.model.run), Err(refusal));
    update(&mut app, Message::News(report));
    assert!(Arc::ptr_eq(&good, &app.model.shown.as_ref().unwrap().answer));
    let text = picture(&app, (80, 24));
    assert!(text.contains("last good result") && text.contains("above the"));
}

#[test]
fn no_size_and_no_screen_makes_the_drawing_fail() {
    let mut app = app(&["paper-300n", "wide-area"], Depth::Sixteen);
    open_measured(&mut app);
    open_sampled(&mut app);
    open_mapped(&mut app);
    for symbols in [Symbols::Braille, Symbols::Block, Symbols::Ascii] {
        app.model.look.symbols = symbols;
        for keys in
            ["\x1b1", "\x1b2", "3", "v", "4", "\t", "\t", "5", "6", "7", "8", "1?", "?p", "\x1bs"]
        {
            press(&mut app, keys);
            for width in [1, 20, 59, 60, 61, 79, 100, 300] {
                for height in [1, 5, 19, 20, 21, 50, 100] {
                    let buffer = cells(&app, (width, height));
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
    let mut app = app(&[], Depth::Mono);
    app.model.work.source = "\u{1b}[2J\u{202e}evil".to_owned();
    for size in SIZES {
        let text = picture(&app, size);
        assert!(!text.contains(['\u{1b}', '\u{202e}']));
    }
}

#[test]
fn figures_of_no_checked_source_are_marked_until_they_are_typed() {
    let mut app = app(&["golf-ball"], Depth::Mono);
    let speed = fields::find("impact.speed_m_s").unwrap();
    for size in SIZES {
        app.model.form.selected = FormRow::Preset;
        let text = picture(&app, size);
        assert!(line_from(&text, " Speed").starts_with(" Speed "));
        assert!(line_from(&text, " Speed").contains(" ? "));
        assert!(!line_from(&text, " Mass").split('│').next().unwrap().contains('?'));
        app.model.form.selected = FormRow::Field(speed);
        assert!(picture(&app, size).contains("? unverified figure"));
    }
    press(&mut app, "50\r");
    assert!(!picture(&app, (80, 24)).contains("? unverified"));
}

#[test]
fn parts_of_a_large_blow_stand_beside_their_limits() {
    let mut app = app(&["paper-600n"], Depth::Mono);
    press(&mut app, "\r\x1520000\r");
    let shown = app.model.shown.as_mut().unwrap();
    let mut answer = (*shown.answer).clone();
    // A folded mesh has no parts on show.
    answer.flags.clear();
    shown.answer = Arc::new(answer);
    let index = shown.answer.index();
    let parts = [("S", index.shell_growth), ("M", index.meridian_growth), ("E", index.energy)];
    assert!(parts[2].1 > 200.0 * ENERGY.threshold);
    for size in SIZES {
        let text = picture(&app, size);
        for (name, part) in parts {
            let lines = text.lines().filter(|line| line.contains(&format!("{name} ")));
            let near = |word: &str| {
                let value: Option<f64> = word.trim_end_matches(',').parse().ok();
                value.is_some_and(|value| (value / part - 1.0).abs() < 0.06)
            };
            let said = lines.flat_map(str::split_whitespace).any(near);
            assert!(said, "{name} {part}\n{text}");
        }
    }
}

#[test]
fn an_index_that_means_nothing_has_no_bar_but_the_next_step_to_take() {
    let mut app = app(&["paper-600n"], Depth::Mono);
    press(&mut app, &"L".repeat(30));
    for keys in ["\x1b1", "\x1b8"] {
        press(&mut app, keys);
        for size in SIZES {
            let text = picture(&app, size);
            let words: Vec<&str> = text.split_whitespace().filter(|w| *w != "│").collect();
            let words = words.join(" ");
            for part in ["index not usable", "mesh folded at", "Physiological"] {
                assert!(words.contains(part), "{part} at {size:?}\n{text}");
            }
            assert!(!text.contains("Index "), "{text}");
        }
    }
}

#[test]
fn the_legend_of_the_energies_is_whole() {
    let mut app = app(&[], Depth::Mono);
    press(&mut app, "\x1b3vvvvvv");
    for size in SIZES {
        let text = picture(&app, size);
        for name in ["1 kinetic", "2 elastic", "3 dissipated", "4 work in"] {
            let rest = &line_from(&text, name)[name.len()..];
            let words: Vec<&str> = rest.split_whitespace().collect();
            assert!(words[0].parse::<f64>().is_ok() && words[1] == "J", "{text}");
        }
    }
}

#[test]
fn a_projectile_has_a_force_of_contact_where_a_pulse_has_its_load() {
    let mut app = app(&["bb-56"], Depth::Mono);
    press(&mut app, "\x1b2");
    let text = picture(&app, (80, 24));
    assert!(text.contains(" contact ") && !text.contains(" load "));
    assert!(text.contains('⣿'), "the bar of time has the force in it");
    press(&mut app, "\x1b3");
    assert!(picture(&app, (80, 24)).contains("contact, N"));
    for (sources, label) in [
        (["paper-300n", "wide-area"], "load, N"),
        (["paper-300n", "bb-56"], "load or contact, N"),
        (["golf-ball", "bb-56"], "contact, N"),
    ] {
        let mut app = super::drawn::app(&sources, Depth::Mono);
        press(&mut app, "\x1b4");
        let drawn = (0..30).any(|_| {
            press(&mut app, "v");
            picture(&app, (80, 24)).contains(&format!(" {label}"))
        });
        assert!(drawn, "{label}");
    }
}

#[test]
fn what_the_tissues_feel_is_seen_over_time() {
    let mut app = app(&["bb-56"], Depth::Mono);
    press(&mut app, "\x1b3");
    let mut seen = String::new();
    for _ in 0..20 {
        press(&mut app, "v");
        seen += &picture(&app, (120, 40));
    }
    for injury in Injury::ALL {
        if let Some(trace) = injury.measure().row().trace {
            assert!(seen.contains(&format!("{}, ", trace.label)), "{injury:?}");
        }
    }
}

#[test]
fn curves_that_no_answer_has_are_not_offered() {
    let mut app = app(&["paper-300n", "wide-area"], Depth::Mono);
    press(&mut app, "\x1b4");
    for _ in 0..20 {
        press(&mut app, "v");
        assert!(!picture(&app, (80, 24)).contains("pressure, MPa"));
    }
}

#[test]
fn six_marked_presets_leave_room_for_their_curves() {
    let six = ["paper-300n", "paper-100n", "paper-600n", "wide-area", "bb-56", "golf-ball"];
    let mut app = app(&six, Depth::Mono);
    press(&mut app, "\x1b4");
    for size in SIZES {
        let text = picture(&app, size);
        assert!(text.contains("pressure, MPa") && text.contains("v curves"));
        assert!(six.iter().all(|name| text.contains(&name[..8.min(name.len())])));
    }
}

#[test]
fn what_a_folded_mesh_makes_of_a_risk_is_said_beside_it() {
    let mut app = app(&["golf-ball"], Depth::Mono);
    press(&mut app, "\x1b8");
    for size in SIZES {
        assert!(picture(&app, size).contains("! the computed tissue folded"));
    }
}

#[test]
fn a_peak_has_its_error_and_its_time_beside_it_however_long_its_number() {
    let app = app(&["bb-56"], Depth::Mono);
    for size in [(80, 24), (60, 20)] {
        let text = picture(&app, size);
        for name in ["contact", "press", "stretch"] {
            let line = line_from(&text, name);
            assert!(line.contains('±'), "{line}");
        }
    }
    let text = picture(&app, (80, 24));
    let times = without_form(&text, 80).lines().filter(|line| line.ends_with("ms")).count();
    assert!(times >= 4, "{text}");
}

/// States whose pictures are taken at 80 x 24 only: what they must say, they say at every size.
#[test]
fn what_a_state_must_say_is_said_at_every_size() {
    let said = |app: &App, words: &[&str]| {
        for size in SIZES {
            let text = picture(app, size);
            for word in words {
                assert!(text.contains(word), "{word} at {size:?}\n{text}");
            }
        }
    };
    let after = |sources: &[&str], keys: &str| {
        let mut app = app(sources, Depth::Mono);
        press(&mut app, keys);
        app
    };
    said(&after(&[], "ajjjjjjjj\r-"), &["▸Name", "1 to 80", "Enter accept", "Esc restore"]);
    said(
        &after(&["paper-600n"], &("L".repeat(30) + "\tKK")),
        &["3600 N", "20 deg", "mesh folded", "←→ width"],
    );
    said(&after(&[], "\x1b5"), &["How exact", "0 %", "Esc stops"]);
    said(&after(&[], "\x1b6"), &["0 of 1000", "Esc stops", "into a field"]);
    said(
        &after(&["off-axis-triangle"], "\x1b7x-"),
        &["Angle across, Duration up", "not known yet", "o your blow"],
    );
    said(
        &after(&[], "\x1b8"),
        &["Paper's index", "(100 = worst in the paper)", "not told: the section"],
    );
    said(&after(&["fist"], ".3\r\x1b2"), &["Now", "contact", "Physiological model"]);
    said(&after(&["bb-56"], "\x1b3vvvvvvvvv"), &["pressure", "stress"]);
    let mut app = app(&[], Depth::Mono);
    open_measured(&mut app);
    press(&mut app, "Ll");
    said(&app, &["▸ ", " of 24", "mesh error  level 1: ", "Error of the damage"]);
    press(&mut app, ">");
    said(&app, &["Error of the damage index: ", "Enter or y: yes"]);
}

/// What stands right of the form on the main screen, and all of any other.
fn without_form(text: &str, width: usize) -> String {
    let left = match width {
        ..70 => 26,
        70..100 => 30,
        _ => 35,
    };
    let right = |line: &str| -> String { line.chars().skip(left).collect() };
    text.lines().map(right).collect::<Vec<_>>().join("\n")
}

#[test]
fn nothing_is_cut_where_a_terminal_is_small() {
    let presets = [
        "paper-300n",
        "off-axis-triangle",
        "bb-62",
        "squash-ball",
        "soccer-ball",
        "fist",
        "tests/scenarios/round-eye.ron",
    ];
    for preset in presets {
        for keys in ["", &"L".repeat(30)] {
            let mut app = app(&[preset], Depth::Mono);
            press(&mut app, keys);
            for screen in ["1", "2", "3", "4", "4\x1b[Z", "4\t", "5", "6", "7", "8"] {
                match screen {
                    "5" => open_measured(&mut app),
                    "6" => open_sampled(&mut app),
                    "7" => open_mapped(&mut app),
                    _ => press(&mut app, &format!("\x1b{screen}")),
                }
                for (width, height) in [(60, 20), (80, 24), (100, 30), (160, 50)] {
                    let text = picture(&app, (width, height));
                    assert!(!text.contains('…'), "{preset} {screen} {width}x{height}\n{text}");
                }
            }
        }
    }
}

/// The names of the injuries where there is room for them, and where there is not.
const LONG: [&str; 6] = [
    "globe rupture",
    "retina at the back",
    "retina's front edge",
    "lens dislocation",
    "hyphema",
    "corneal abrasion",
];
const SHORT: [&str; 6] =
    ["globe rupture", "retina, back", "retina, edge", "lens", "hyphema", "abrasion"];

#[test]
fn what_stands_behind_a_risk_ends_with_a_whole_sentence_however_small_the_terminal() {
    for preset in ["squash-ball", "bb-62", "soccer-ball", "golf-ball"] {
        let mut app = app(&[preset], Depth::Mono);
        press(&mut app, "\x1b8");
        let risks = app.model.shown.as_ref().unwrap().answer.risks();
        for injury in risks.iter().map(|risk| risk.injury) {
            for size in [(60, 20), (80, 24), (100, 30), (160, 50)] {
                let text = picture(&app, size);
                let said = text.split("────").last().unwrap().trim_start_matches('─');
                let (said, signs) = said.split_once("\nPain").unwrap();
                // Below it may stand what usual blows bring.
                let said = said.trim_end().split("\n\n").next().unwrap();
                assert!(said.ends_with('.'), "{preset} {size:?}\n{text}");
                assert!(signs.contains("eye doctor"), "{text}");
                let lines: Vec<&str> = text.lines().collect();
                let names = if size.0 < 80 { SHORT } else { LONG };
                for name in names {
                    assert!(lines.iter().any(|line| line.contains(name)), "{text}");
                }
                let name = names[injury as usize];
                assert!(text.contains(&format!("▸{name}")), "{text}");
            }
            press(&mut app, "j");
        }
    }
}

#[test]
fn the_words_and_the_range_of_a_risk_are_the_same_on_every_screen() {
    let mut app = app(&["bb-56"], Depth::Mono);
    let risks = app.model.shown.as_ref().unwrap().answer.risks();
    assert_eq!(risks.len(), Injury::ALL.len());
    for keys in ["\x1b1", "\x1b8", "\x1b4 "] {
        press(&mut app, keys);
        for size in [(80, 24), (120, 40), (160, 50)] {
            let text = picture(&app, size);
            if keys == "\x1b4 " {
                // One row says the gravest.
                continue;
            }
            for risk in &risks {
                let place = risk.injury as usize;
                let names = [LONG[place], SHORT[place]];
                let mut lines = text.lines();
                let line = lines.find(|line| names.iter().any(|name| line.contains(name)));
                let line = line.unwrap_or_else(|| panic!("{names:?}\n{text}"));
                // The unit stands above the figures, of which an open one has none.
                let figures = [risk.middle(), risk.range()].map(|said| {
                    said.trim_end_matches(" %").replace("under ", "<").replace("over ", ">")
                });
                for said in figures.iter().filter(|_| !risk.is_open()) {
                    assert!(line.contains(said), "{said} in {line}");
                }
                assert!(line.contains(risk.word()), "{line}");
            }
        }
    }
}

#[test]
fn several_are_marked_at_once_each_with_its_speed_and_it_is_said_which_is_worse() {
    let mut app = app(&["bb-56"], Depth::Mono);
    press(&mut app, "\x1b4/bb 62@40, bb-62@90, steel bb 56\r");
    let taken = picture(&app, (80, 24));
    assert!(taken.contains("marked: bb-62@40, bb-62@90, bb-56"), "{taken}");
    for size in [(80, 24), (120, 40)] {
        let text = picture(&app, size);
        for word in ["1 bb-62@40", "2 bb-62@90", "3 bb-56", "globe rupture", "abrasion"] {
            assert!(text.contains(word), "{word}\n{text}");
        }
        let words: Vec<&str> = text.split_whitespace().collect();
        let words = words.join(" ");
        assert!(words.contains("worst") || words.contains("as bad"), "{text}");
    }
    press(&mut app, "/zzzqqq@1, fist\r");
    assert!(picture(&app, (80, 24)).contains("nothing is called zzzqqq"));
}

#[test]
fn the_retina_straight_on_has_its_rings_and_says_how_sure_an_hour_is() {
    let mut app = app(&["bb-56"], Depth::Mono);
    press(&mut app, "\x1b8f");
    for size in SIZES {
        let text = picture(&app, size);
        for word in ["not sure", "81 %", "possible"] {
            assert!(text.contains(word), "{word}\n{text}");
        }
        assert!(text.contains("all round alike") || size.0 < 80, "{text}");
    }
}

#[test]
fn every_injury_has_its_answer_beside_the_form_on_the_usual_terminal() {
    for preset in ["squash-ball", "bb-62", "paintball", "soccer-ball"] {
        let text = picture(&app(&[preset], Depth::Mono), (80, 24));
        for word in ["globe rupture ", "retina", "edge", "lens", "hyphema", "abrasion"] {
            assert!(text.contains(word), "{word}\n{text}");
        }
        let words: Vec<&str> = text.split_whitespace().collect();
        assert!(words.join(" ").contains("eye doctor today"), "{text}");
    }
}

#[test]
fn every_node_has_one_name_and_its_peak_is_visited() {
    for screen in ["1f\t", "2", "3v"] {
        let mut app = app(&["bb-62"], Depth::Mono);
        press(&mut app, &format!("\x1b{screen}"));
        let mut visited = std::collections::BTreeSet::new();
        let shown = app.model.shown.as_ref().unwrap();
        let peaks =
            [Quantity::ForceCentre, Quantity::ForceFront, Quantity::ForceRight, Quantity::ForceTop];
        let peaks = peaks.map(|of| shown.answer.peak(of).unwrap().time);
        for _ in 0..30 {
            press(&mut app, "g");
            visited.insert(app.time().to_bits());
        }
        for (time, name) in peaks.into_iter().zip(["centre", "front", "right", "top"]) {
            assert!(visited.contains(&time.to_bits()), "{screen} {name}");
            let text = picture(&app, (120, 40));
            assert!(text.contains(&format!("{name} ")) || text.contains(&format!("{name}, N ")));
        }
    }
}

#[test]
fn a_wide_terminal_has_risks_and_pressure_beside_the_score() {
    let file = "tests/scenarios/round-eye.ron";
    let text = picture(&app(&[file], Depth::Mono), (180, 50));
    for words in [
        "range: 8 of 10 of what it may be",
        "of 100 who come",
        "eye doctor today",
        "are hurt at",
        "globe rupture",
        "abrasion",
        "scleral stress, MPa",
        "peak",
    ] {
        assert!(text.contains(words), "{words}\n{text}");
    }
    let text = picture(&app(&[], Depth::Mono), (180, 50));
    assert!(text.contains("wall growth S, %") && text.contains("not told"), "{text}");
}

#[test]
fn the_help_begins_with_the_screen_on_show_and_explains_every_word() {
    let mut app = app(&[], Depth::Mono);
    press(&mut app, "\x1b8?");
    for size in SIZES {
        let text = picture(&app, size);
        assert!(text.contains("8 Injury: What is hurt?"), "{text}");
        assert!(text.contains("the injury above") && !text.contains('…'), "{text}");
    }
    let mut seen = String::new();
    for _ in 0..60 {
        seen += &picture(&app, (80, 24));
        press(&mut app, "\x1b[6~");
    }
    for word in ["Rank correlation", "Opening", "not diagnosis"] {
        assert!(seen.contains(word), "{word}");
    }
}

#[test]
fn front_back_and_up_are_named_on_the_eye_and_its_monitored_nodes_marked() {
    let mut app = app(&[], Depth::Mono);
    press(&mut app, "\x1b2");
    for size in SIZES {
        let text = picture(&app, size);
        let eye: Vec<&str> = text.lines().skip(1).collect();
        for word in ["front", "back", "up"] {
            assert!(eye.iter().any(|line| line.contains(word)), "{word}\n{text}");
        }
        // The legend stands at the right.
        let letters: String =
            eye.iter().flat_map(|line| line.chars().take(size.0 as usize - 24)).collect();
        for letter in ['C', 'F', 'R', 'T'] {
            assert!(letters.contains(letter), "{letter}\n{text}");
        }
    }
}

#[test]
fn main_answers_first_then_says_what_limits_that_and_draws_what_the_eye_feels() {
    let mut app = app(&["bb-56"], Depth::Mono);
    for size in [(80, 24), (120, 40), (200, 60)] {
        let text = picture(&app, size);
        let row = |name: &str| {
            let place = text.lines().position(|line| line.contains(name));
            place.unwrap_or_else(|| panic!("{name}\n{text}"))
        };
        for (long, short) in LONG.into_iter().zip(SHORT) {
            let name = if text.contains(long) { long } else { short };
            let line = text.lines().nth(row(name)).unwrap();
            let (_, said) = line.rsplit_once('│').unwrap_or(("", line));
            let numbers = said.split_whitespace().filter(|word| word.contains(char::is_numeric));
            let open = line.contains("nobody counted") || line.contains("too wide to tell");
            assert!(numbers.count() >= 3 || open, "{line}");
            assert!(row("Steel BB at 56 m/s: ") < row(name), "{text}");
        }
        assert!(row("of 100 who come") < row("globe rupture"), "{text}");
        for name in ["contact ", "press", "stretch"] {
            let line = line_from(&text, name);
            assert!(line.contains('±'), "{line}");
        }
        assert!(!text.contains("right "), "node forces are behind a key");
    }
    press(&mut app, "f");
    assert!(picture(&app, (80, 24)).contains("right "));
}

#[test]
fn accuracy_says_first_what_less_error_costs_and_a_map_has_figures_on_its_lines() {
    let mut app = app(&[], Depth::Mono);
    open_measured(&mut app);
    for size in SIZES {
        let text = picture(&app, size);
        let second = text.lines().nth(2).unwrap();
        assert!(second.contains(" % off costs ") && second.contains(" ms"), "{text}");
    }
    open_mapped(&mut app);
    for size in SIZES {
        let text = picture(&app, size);
        let figures = [" 10 ", " 50 ", " 90 "];
        let inside: String = text.lines().skip(2).take(size.1 as usize - 8).collect();
        let seen = figures.iter().filter(|figure| inside.contains(**figure));
        assert!(seen.count() >= 2, "{text}");
    }
}
