//! Keys, mouse, pastes and sizes at random, the same ones every time: nothing panics, nothing
//! hangs, and the terminal comes back.

use crate::{made_up, made_up_accuracy};
use std::time::Duration;

use crate::dice::Dice;
use crate::pty::{Replies, Term, app};
use contrecoup::answer::solve::Answer;
use contrecoup::run::refusal::Refusal;
use contrecoup::scenario::Scenario;
use contrecoup::tui::app::App;
use contrecoup::tui::app::frame;
use contrecoup::tui::app::update::{Message, begin, update};
use contrecoup::tui::look::Look;
use contrecoup::tui::outbox::Effect;
use contrecoup::tui::overlay::Overlay;
use contrecoup::tui::prepare;
use contrecoup::tui::request::{Report, Request};
use contrecoup::tui::save::SaveError;
use contrecoup::tui::screens::accuracy::MeasureAccuracy;
use contrecoup::tui::screens::compare::comparison::{Comparison, SimulateMarked};
use contrecoup::tui::simulation::Simulate;
use contrecoup::tui::terminal::caps::{Depth, Symbols};
use contrecoup::tui::view::heat::HeatMap;
use contrecoup::tui::view::palette::Palette;
use crossterm::event::{KeyCode, KeyEvent, KeyModifiers, MouseButton, MouseEvent, MouseEventKind};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

/// Keys that people press, some of them more often than others.
const KEYS: &[KeyCode] = &[
    KeyCode::Up,
    KeyCode::Down,
    KeyCode::Down,
    KeyCode::Left,
    KeyCode::Right,
    KeyCode::Enter,
    KeyCode::Enter,
    KeyCode::Esc,
    KeyCode::Tab,
    KeyCode::BackTab,
    KeyCode::Home,
    KeyCode::End,
    KeyCode::Backspace,
    KeyCode::Delete,
    KeyCode::PageUp,
];
const LETTERS: &str = "0123456789-.,+=_ ?uurRsSpaAgGzevmojkhlHJKLMynXé中\"[]/~";
const HELD: [KeyModifiers; 6] = [
    KeyModifiers::NONE,
    KeyModifiers::NONE,
    KeyModifiers::NONE,
    KeyModifiers::SHIFT,
    KeyModifiers::ALT,
    KeyModifiers::CONTROL,
];

fn message(dice: &mut Dice, now: &mut Duration, size: (u16, u16)) -> Message {
    match dice.below(20) {
        0 => {
            *now += Duration::from_millis(dice.below(3000) as u64);
            Message::Tick(*now)
        }
        1 | 2 => {
            let kinds = [
                MouseEventKind::Down(MouseButton::Left),
                MouseEventKind::Drag(MouseButton::Left),
                MouseEventKind::Up(MouseButton::Left),
                MouseEventKind::ScrollUp,
                MouseEventKind::ScrollDown,
            ];
            let event = MouseEvent {
                kind: dice.one(&kinds),
                column: dice.below(330) as u16,
                row: dice.below(110) as u16,
                modifiers: dice.one(&HELD),
            };
            Message::Mouse(event, size)
        }
        3 => Message::Paste(dice.one(&["450", "-1e9", "", "[1, 2]", "NaN", "a b\n"]).to_owned()),
        4..10 => {
            let code = dice.one(KEYS);
            Message::Key(KeyEvent::new(code, dice.one(&HELD)))
        }
        10 => Message::Key(KeyEvent::from(KeyCode::F(1 + dice.below(12) as u8))),
        _ => {
            let letters: Vec<char> = LETTERS.chars().collect();
            Message::Key(KeyEvent::new(KeyCode::Char(dice.one(&letters)), dice.one(&HELD)))
        }
    }
}

/// Made up at once; of a mesh that takes long to build, none.
fn quick(scenario: &Scenario) -> Result<Answer, Refusal> {
    if scenario.eye.level <= 2 { Ok(made_up::answer(scenario)) } else { Err(Refusal::Cancelled) }
}

/// What a worker says of a request, if it says anything in time.
fn report(request: &Request, dice: &mut Dice) -> Option<Report> {
    let ticket = request.ticket;
    if let Some(Simulate(scenario)) = request.question() {
        // Most answers are late: the next edit has come before them.
        (dice.below(6) == 0).then(|| Report::done::<Simulate>(ticket, quick(scenario)))
    } else if let Some(marked) = request.question::<SimulateMarked>() {
        let outcome = quick(&marked.scenario);
        Some(Report::done::<SimulateMarked>(ticket, outcome))
    } else if request.question::<MeasureAccuracy>().is_some() {
        Some(if dice.below(2) == 0 {
            Report::done::<MeasureAccuracy>(ticket, Ok(made_up_accuracy::made_up()))
        } else {
            Report::progress(ticket, 0.5, Duration::ZERO)
        })
    } else {
        None
    }
}

/// Does what threads and disk would, as fast as a test must be: what would take long is cancelled.
fn settle(app: &mut App, dice: &mut Dice, effects: Vec<Effect>) {
    let mut open = effects;
    while let Some(effect) = open.pop() {
        let message = match effect {
            Effect::Start(request) => match report(&request, dice) {
                Some(report) => Message::News(report),
                None => continue,
            },
            Effect::Save(name, ..) => {
                let outcomes = [
                    Ok(()),
                    Err(SaveError::Exists(name.clone())),
                    Err(SaveError::Failed("no space".to_owned())),
                ];
                Message::Saved(name, outcomes[dice.below(3)].clone())
            }
            _ => continue,
        };
        open.extend(update(app, message));
    }
}

#[test]
fn thousands_of_random_inputs_leave_the_app_in_order() {
    for seed in 0..4 {
        let mut dice = Dice(seed);
        let look = Look {
            depth: dice.one(&[Depth::Mono, Depth::Sixteen, Depth::TwoFiveSix]),
            symbols: dice.one(&[Symbols::Braille, Symbols::Block, Symbols::Ascii]),
            heat: dice.one(&[HeatMap::Hot, HeatMap::Cividis]),
            palette: Palette { light: dice.one(&[false, true]), ..Palette::default() },
        };
        let mut app = prepare(&["paper-300n".to_owned()], look).unwrap();
        let effects = begin(&mut app);
        settle(&mut app, &mut dice, effects);
        let mut now = Duration::ZERO;
        let mut size = (80, 24);
        for _ in 0..2500 {
            if dice.below(10) == 0 {
                size = (1 + dice.below(200) as u16, 1 + dice.below(70) as u16);
            }
            let message = message(&mut dice, &mut now, size);
            let effects = update(&mut app, message);
            settle(&mut app, &mut dice, effects);
            let mut buffer = Buffer::empty(Rect::new(0, 0, size.0, size.1));
            frame::draw(&app, &mut buffer);
            // What is worked on is always something that can be worked on.
            app.model.work.scenario.check().unwrap();
            assert!(app.state::<Comparison>().entries.len() <= 6);
        }
        // From wherever it is, a few presses of Escape and an edit lead back to a result.
        let esc = || Message::Key(KeyEvent::from(KeyCode::Esc));
        for _ in 0..4 {
            update(&mut app, esc());
            if let Some(Overlay::Help(_)) = app.model.overlay {
                app.model.overlay = None;
            }
        }
        assert!(app.model.overlay.is_none() && app.model.form.typing.is_none());
        app.model.work.scenario = contrecoup::scenario::Scenario::default();
        app.model.work.scenario.window_ms = Some(2.0);
        let edit = contrecoup::scenario::fields::find("impact.duration_ms").unwrap();
        app.screen = 0;
        app.screens[app.screen].show_pane(0);
        app.model.form.selected = contrecoup::tui::form::FormRow::Field(edit);
        let effects = update(&mut app, Message::Key(KeyEvent::from(KeyCode::Right)));
        for effect in effects {
            if let Effect::Start(request) = effect
                && let Some(Simulate(scenario)) = request.question()
            {
                let report = Report::done::<Simulate>(request.ticket, quick(scenario));
                update(&mut app, Message::News(report));
            }
        }
        assert!(app.model.run.job.is_none() && app.model.run.complaint.is_none());
        assert_eq!(app.model.stale(), None);
    }
}

#[test]
fn random_keys_and_sizes_in_a_terminal_end_in_a_clean_one() {
    let home = tempfile::tempdir().unwrap();
    let mut dice = Dice(7);
    let mut command = app(&["tui", "paper-300n", "--mouse"]);
    command.env("XDG_CONFIG_HOME", home.path());
    let mut term = Term::open(command, (80, 24), Replies::Prompt);
    term.wait_for("damage 26 %");
    let pieces = [
        "\x1b[A",
        "\x1b[B",
        "\x1b[B",
        "\x1b[C",
        "\x1b[D",
        "\x1b[1;2C",
        "\r",
        "\r",
        "\x1b",
        "\t",
        "\x1b[Z",
        "\x1b1",
        "\x1b2",
        "\x1b3",
        "\x1b4",
        "\x1b5",
        " ",
        "g",
        "z",
        "e",
        "v",
        "a",
        "u",
        "r",
        "\x13",
        "p",
        "?",
        "M",
        "m",
        "o",
        "4",
        "6",
        "7",
        "8",
        "-",
        ".",
        "\x7f",
        "\x15",
        "\x1b[<0;40;9M",
        "\x1b[<32;38;7M",
        "\x1b[<0;38;7m",
        "\x1b[<65;5;5M",
        "\x1b[200~12\x1b[201~",
        "\x1b[",
        "\x1b]11;rgb:0/0/0\x07",
        "\u{e9}",
        "\x0c",
    ];
    for i in 0..600 {
        term.keys(dice.one(&pieces));
        if i % 20 == 0 {
            let size = (10 + dice.below(150) as u16, 3 + dice.below(50) as u16);
            term.resize(size.0, size.1);
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    // What is half typed, half read or half computed does not stop anybody from leaving.
    term.keys("\x03");
    assert_eq!(term.exit_code(), 130);
    term.assert_restored();
}
