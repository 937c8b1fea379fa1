//! Campaigns of random input: nothing panics, nothing hangs, every refusal can be read on a
//! terminal, and what is accepted is sound.
//!
//! Each campaign first tries every file of `tests/finds/NAME`, where a find is kept for good, then
//! random input for a second: the same every time. `FUZZ_SECONDS=3600 cargo test --release --test
//! program fuzz` goes on for an hour each, `FUZZ_SEED=N` from another place. A find is written to
//! `tests/finds` and named.

use crate::made_up;
use std::fmt::Write;
use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use contrecoup::run::kept::Keep;
use contrecoup::scenario::fields::{FIELDS, Kind};
use contrecoup::scenario::load::{parse, to_ron};

use contrecoup::answer::solve::solve;
use contrecoup::many::sweep::{MAX_ROWS, Sweep, SweepAxis};
use contrecoup::run::refusal::Refusal;
use contrecoup::scenario::set::{full_path, set};
use contrecoup::scenario::{Scenario, ScenarioError, library};
use contrecoup::tui::app::App;
use contrecoup::tui::app::frame;
use contrecoup::tui::app::update::{Message, begin, update};
use contrecoup::tui::config::Config;
use contrecoup::tui::look::Look;
use contrecoup::tui::outbox::Effect;
use contrecoup::tui::prepare;
use contrecoup::tui::request::Report;
use contrecoup::tui::simulation::Simulate;
use contrecoup::tui::terminal::caps::{Depth, Symbols};
use contrecoup::tui::terminal::input::{Parser, TerminalInput};
use contrecoup::tui::terminal::pacer::{Cause, Pacer};
use contrecoup::tui::view::heat::HeatMap;
use contrecoup::tui::view::palette::Palette;
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::dice::Dice;

fn from_env(name: &str, usual: u64) -> u64 {
    std::env::var(name).map_or(usual, |text| text.parse().unwrap())
}

/// Tries what was found before, then whatever `make` makes until the time is over.
fn campaign(name: &str, make: impl Fn(&mut Dice) -> Vec<u8>, check: impl Fn(&[u8])) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/finds").join(name);
    let mut finds: Vec<PathBuf> = fs::read_dir(&folder)
        .map(|entries| entries.map(|entry| entry.unwrap().path()).collect())
        .unwrap_or_default();
    finds.sort();
    for find in finds {
        println!("{}", find.display());
        check(&fs::read(find).unwrap());
    }
    let (begun, most) = (Instant::now(), from_env("FUZZ_SECONDS", 1));
    let first = from_env("FUZZ_SEED", 1);
    let mut seed = first;
    while begun.elapsed() < Duration::from_secs(most) {
        let input = make(&mut Dice(seed));
        let one = Instant::now();
        let sound = catch_unwind(AssertUnwindSafe(|| check(&input)));
        if sound.is_err() || one.elapsed() > Duration::from_secs(5) {
            fs::create_dir_all(&folder).unwrap();
            let find = folder.join(seed.to_string());
            fs::write(&find, &input).unwrap();
            panic!("{name}: {} after {:?}", find.display(), one.elapsed());
        }
        seed += 1;
    }
    println!("{name}: {} inputs", seed - first);
}

/// What gets through more often than letters do.
const PIECES: &[&str] = &[
    "(",
    ")",
    "[",
    "]",
    "{",
    "}",
    ",",
    ":",
    "=",
    "\"",
    "'",
    "//",
    "/*",
    "*/",
    "\\",
    "\n",
    "\t",
    " ",
    "r#\"",
    "Some(",
    "None",
    "Auto",
    "true",
    "inf",
    "-inf",
    "NaN",
    "-0.0",
    "1e-310",
    "1e999",
    "-1",
    "0x7",
    "1_000",
    "9999999999999999999999",
    "0.1",
    "±",
    "+-",
    "+- 3",
    "Csv(\"/etc/passwd\")",
    "Table([(0, 0), (1, 1)])",
    "ForcePulse",
    "Projectile",
    "Physiological",
    "Paper",
    "doubt",
    "eye",
    "level: 9",
    "\u{1b}[2J",
    "\u{9b}",
    "\u{7}",
    "\u{202e}",
    "\u{200b}",
    "\u{feff}",
    "e\u{301}\u{301}",
    "\u{e0041}",
    "\0",
    "\r",
];

/// Damage of the kinds that hands, editors and networks do.
fn damaged(text: &str, dice: &mut Dice) -> String {
    let mut letters: Vec<char> = text.chars().collect();
    for _ in 0..dice.below(5) {
        let at = dice.below(letters.len() + 1);
        let end = (at + dice.below(12)).min(letters.len());
        match dice.below(6) {
            0 => drop(letters.drain(at..end)),
            1 => letters.truncate(at),
            2 => {
                let again: Vec<char> = letters[at..end].to_vec();
                let times = 1 + dice.below(3) * dice.below(40);
                letters.splice(at..at, again.repeat(times));
            }
            3 => {
                let other = dice.below(letters.len() + 1);
                let piece: Vec<char> = letters.drain(at..end).collect();
                let other = other.min(letters.len());
                letters.splice(other..other, piece);
            }
            _ => {
                let piece: Vec<char> = dice.one(PIECES).chars().collect();
                let end = if dice.below(2) == 0 { at } else { end };
                letters.splice(at..end, piece);
            }
        }
    }
    letters.into_iter().collect()
}

/// A refusal that a person can read, whatever was refused.
fn assert_readable(error: &ScenarioError) {
    let said = error.to_string();
    let unseen = |c: char| {
        c != '\n'
            && (c.is_control()
                || ('\u{200b}'..='\u{200f}').contains(&c)
                || ('\u{202a}'..='\u{202e}').contains(&c))
    };
    assert!(!said.is_empty() && !said.contains(unseen), "{said:?}");
    assert!(said.len() < 20_000, "{} bytes are said", said.len());
    assert!(!error.problems.is_empty());
}

/// Sound files, broken ones and presets.
fn texts() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/scenarios");
    let files = ["good", "bad"].map(|kind| fs::read_dir(folder.join(kind)).unwrap());
    let mut files: Vec<PathBuf> = files.into_iter().flatten().map(|e| e.unwrap().path()).collect();
    files.sort();
    let texts = files.iter().filter_map(|path| fs::read_to_string(path).ok());
    let presets = library::built_in();
    texts.chain(presets.iter().map(|p| p.text().unwrap().into_owned())).collect()
}

#[test]
fn scenarios() {
    let texts = texts();
    let make = |dice: &mut Dice| {
        let text = &texts[dice.below(texts.len())];
        damaged(text, dice).into_bytes()
    };
    campaign("scenarios", make, |input| {
        let text = String::from_utf8_lossy(input);
        match parse(&text, "x.ron") {
            Err(error) => {
                assert_readable(&error);
                let lines = text.lines().count() + 1;
                // Of more than are shown only the first have been looked for.
                for problem in error.problems.iter().take(20) {
                    let line = problem.line.expect("a place");
                    assert!((1..=lines).contains(&line) && problem.column.is_some(), "{problem}");
                }
            }
            Ok(scenario) => {
                let again = parse(&to_ron(&scenario), "again").unwrap();
                assert_eq!(again, scenario);
                assert_runs(scenario, input.len());
            }
        }
    });
}

/// A sound scenario gives an answer or says why not. One in some is tried, for a short time on a
/// coarse mesh.
fn assert_runs(mut scenario: Scenario, number: usize) {
    if !number.is_multiple_of(16) {
        return;
    }
    scenario.eye.level = 1;
    scenario.window_ms = Some(scenario.window_ms.map_or(0.02, |ms| ms.min(0.02)));
    let Ok(checked) = scenario.check() else {
        return;
    };
    let mut calls = 0;
    let outcome = solve(&checked, Keep::default(), &mut |_| {
        calls += 1;
        if calls > 50 {
            std::ops::ControlFlow::Break(())
        } else {
            std::ops::ControlFlow::Continue(())
        }
    });
    if let Err(refusal) = outcome {
        assert!(!refusal.to_string().is_empty());
    }
}

/// Values as they would be typed, of every kind of field.
fn typed(dice: &mut Dice) -> String {
    let field = &FIELDS[dice.below(FIELDS.len())];
    let value = match &field.kind {
        Kind::OptionalNumber(..) if dice.below(4) == 0 => "auto".to_owned(),
        Kind::Number(b, _) | Kind::OptionalNumber(b, _) => {
            dice.one(&[b.min, b.max, b.fine, b.min - b.fine, b.max * 2.0]).to_string()
        }
        Kind::Integer(min, max, _) => dice.one(&[*min, *max, max + 1]).to_string(),
        Kind::Choice(choices) => dice.one(&choices.names()).to_owned(),
        Kind::Integers(..) => "2, 3".to_owned(),
        Kind::Text(..) => "name".to_owned(),
    };
    let groups = ["eye", "model", "impact", "doubt", "numerics", "impact.shape", "impact.surface"];
    let path = match dice.below(8) {
        0 => dice.one(&groups),
        1 => field.path.rsplit('.').next().unwrap(),
        _ => field.path,
    };
    format!("{path}={value}")
}

#[test]
fn settings() {
    let make = |dice: &mut Dice| {
        let mut lines = String::new();
        for _ in 0..6 {
            let line = typed(dice);
            let line = if dice.below(3) == 0 { damaged(&line, dice) } else { line };
            let _ = writeln!(lines, "{}", line.replace('\n', " "));
        }
        lines.into_bytes()
    };
    campaign("settings", make, |input| {
        let mut scenario = Scenario::default();
        for line in String::from_utf8_lossy(input).lines() {
            let Some((path, value)) = line.split_once('=') else {
                continue;
            };
            let whole = full_path(&scenario, path).to_owned();
            assert_eq!(full_path(&scenario, &whole), whole);
            let before = scenario.clone();
            if let Err(error) = set(&mut scenario, path, value) {
                assert_readable(&error);
                assert_eq!(scenario, before, "{line}");
            }
            // What any field now says, it takes again.
            for field in FIELDS {
                if let Some(text) = field.text(&scenario) {
                    let mut same = scenario.clone();
                    set(&mut same, field.path, &text).unwrap();
                    assert_eq!(same, scenario, "{}={text}", field.path);
                }
            }
        }
    });
}

#[test]
fn grids() {
    let make = |dice: &mut Dice| {
        let mut lines = String::new();
        for _ in 0..=dice.below(3) {
            let line = typed(dice);
            let more =
                dice.one(&["", ":10:3", ":0:2", ",1", ",soft", ":1e9:100000", ":2:1", ", ,"]);
            let line = damaged(&format!("{line}{more}"), dice);
            let _ = writeln!(lines, "{}", line.replace('\n', " "));
        }
        lines.into_bytes()
    };
    campaign("grids", make, |input| {
        let text = String::from_utf8_lossy(input);
        let axes: Result<Vec<SweepAxis>, String> = text.lines().map(SweepAxis::read).collect();
        let Ok(axes) = axes else { return };
        match Sweep::new(Scenario::default(), axes) {
            Err(error) => assert_readable(&error),
            Ok(sweep) => {
                assert!(sweep.rows() <= MAX_ROWS);
                for row in [0, sweep.rows() / 2, sweep.rows() - 1] {
                    assert_eq!(sweep.values(row).len(), sweep.axes().len());
                    if let Err(error) = sweep.scenario(row) {
                        assert_readable(&error);
                    }
                }
            }
        }
    });
}

#[test]
fn config_files() {
    let usual = Config::default().to_ron();
    let own = "(symbols: \"ascii\", fps: 5, mouse: true, keys: (undo: \"Ctrl-X\", quit: \"F9\"))";
    let make = |dice: &mut Dice| damaged(dice.one(&[usual.as_str(), own]), dice).into_bytes();
    campaign("config", make, |input| {
        match Config::read(&String::from_utf8_lossy(input), "config.ron") {
            Err(error) => assert_readable(&error),
            Ok(config) => {
                let printed = config.to_ron();
                assert_eq!(Config::read(&printed, "again").unwrap().to_ron(), printed);
            }
        }
    });
}

/// Keys, and what else a terminal sends.
const SENT: &[&str] = &[
    "\x1b[A",
    "\x1b[B",
    "\x1b[C",
    "\x1b[D",
    "\x1b[1;2C",
    "\x1bOP",
    "\x1b[[B",
    "\x1b[17~",
    "\x1b[3~",
    "\x1b[Z",
    "\r",
    "\t",
    "\x1b",
    "\x7f",
    "\x15",
    "\x03",
    "\x1a",
    "\x0c",
    " ",
    "\x1b1",
    "\x1b2",
    "\x1b3",
    "\x1b4",
    "\x1b5",
    "\x1b6",
    "\x1b7",
    "\x1b8",
    "\x1b[1;3R",
    "\x1b[200~",
    "\x1b[201~",
    "\x1b[<0;40;9M",
    "\x1b[<65;5;5M",
    "\x1b[<32;999;999m",
    "\x1b]11;rgb:0/0/0\x07",
    "\x1b]52;c;cXFxcXFxcXFxcXFxcXFxcXFxcXFxcXFxcXFxcXFxcXFxcXFxcXFxcXFxcXFxcXFx\x1b\\",
    "\x1bP>|x\x1b\\",
    "\x1b[?62;4c",
    "\x1b[I",
    "\x1b[",
    "Csv(\"x\")",
    "300 +- 20",
    "1e9",
    "\u{e9}",
    "\u{ff}",
    "y",
    "n",
    "/",
    "?",
];

fn sent(dice: &mut Dice) -> Vec<u8> {
    let mut bytes = Vec::new();
    for _ in 0..60 {
        match dice.below(8) {
            0 => bytes.push(dice.below(256) as u8),
            1..4 => bytes.push(0x20 + dice.below(95) as u8),
            _ => bytes.extend_from_slice(dice.one(SENT).as_bytes()),
        }
    }
    bytes
}

fn opened() -> App {
    let look = Look {
        depth: Depth::Sixteen,
        symbols: Symbols::Braille,
        heat: HeatMap::Hot,
        palette: Palette::default(),
    };
    prepare(&["paper-300n".to_owned()], look).unwrap()
}

/// Answers the form's own question, as far as that is quick, and nothing else.
fn answered(app: &mut App, effects: Vec<Effect>) {
    for effect in effects {
        if let Effect::Start(request) = effect
            && let Some(Simulate(asked)) = request.question()
        {
            let outcome = if asked.eye.level == 1 {
                Ok(made_up::answer(asked))
            } else {
                Err(Refusal::Cancelled)
            };
            update(app, Message::News(Report::done::<Simulate>(request.ticket, outcome)));
        }
    }
}

#[test]
fn key_bytes() {
    campaign("keys", sent, |input| {
        let mut parser = Parser::default();
        let whole = parser.feed(input);
        // However the link cuts it up.
        let mut bytewise = Parser::default();
        let pieces: Vec<TerminalInput> =
            input.iter().flat_map(|byte| bytewise.feed(&[*byte])).collect();
        assert_eq!(whole, pieces);
        let mut app = opened();
        let effects = begin(&mut app);
        answered(&mut app, effects);
        let sizes = [(80, 24), (60, 20), (1, 1), (200, 60)];
        let inputs = whole.into_iter().chain(parser.flush()).enumerate();
        for (number, input) in inputs {
            let size = sizes[number / 8 % sizes.len()];
            let message = match input {
                TerminalInput::Key(event) => Message::Key(event),
                TerminalInput::Paste(text) => Message::Paste(text),
                TerminalInput::Mouse(event) => Message::Mouse(event, size),
                TerminalInput::CursorReport(_) => continue,
            };
            let effects = update(&mut app, message);
            answered(&mut app, effects);
            app.model.work.scenario.check().unwrap();
            if number % 4 == 0 {
                let mut buffer = Buffer::empty(Rect::new(0, 0, size.0, size.1));
                frame::draw(&app, &mut buffer);
            }
        }
        // From wherever it is, Ctrl-C leaves.
        let leave = parser.feed(b"\x03");
        let [TerminalInput::Key(event)] = leave[..] else { panic!("{leave:?}") };
        let effects = update(&mut app, Message::Key(event));
        assert!(effects.iter().any(|effect| matches!(effect, Effect::Quit(_))));
    });
}

#[test]
fn replies_of_terminals() {
    let make = |dice: &mut Dice| (0..200).map(|_| dice.below(256) as u8).collect();
    campaign("replies", make, |input| {
        let mut pacer = Pacer::default();
        let mut now = Instant::now();
        // Frames since the last reply; a terminal that never answers has a budget instead.
        let (mut frames, mut answers) = (0, false);
        for byte in input {
            let cause = if byte & 1 == 0 { Cause::Replay } else { Cause::Event };
            match byte % 5 {
                0 => now += Duration::from_millis(u64::from(*byte) * 20),
                1 => {
                    pacer.replied(now, byte / 5 % 11);
                    (frames, answers) = (0, true);
                }
                _ if pacer.is_free(now, cause) => {
                    pacer.sent(now, 100 * usize::from(*byte));
                    frames += 1;
                    assert!(frames <= 2 || !answers, "{frames} frames without a reply");
                }
                _ => {
                    pacer.probe(now);
                }
            }
        }
        // Nothing stays held up: time or the reply to a bare question frees it.
        for _ in 0..20 {
            if pacer.is_free(now, Cause::Replay) {
                return;
            }
            now = pacer.wake_at().expect("something to wait for").max(now);
            if let Some(column) = pacer.probe(now) {
                pacer.replied(now, column);
            }
        }
        panic!("held up for good");
    });
}
