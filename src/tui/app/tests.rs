//! What keys and answers do to the app, without a terminal and without threads.

use crate::answer::solve::Answer;
use crate::run::{quantity::Quantity, refusal::Refusal, watch::unwatched};
use crate::scenario::library::find;
use crate::scenario::{ForcePulse, Impact, fields};
use crate::tui::app::frame::{draw, tabs};
use crate::tui::app::update::{Message, begin, update};
use crate::tui::app::{App, tables};
use crate::tui::form::{FormRow, Typing};
use crate::tui::overlay::{Naming, Overlay, Prompt};
use crate::tui::picker::{Choice, Picker};
use crate::tui::prepare;
use crate::tui::request::{Report, TaskQuestion, Ticket};
use crate::tui::screens::compare::comparison::{Comparison, CompleteMarked, SimulateMarked};
use crate::tui::terminal::input::{Parser, TerminalInput as Typed};
use crate::tui::{app::tables::footer_keys, changes::edit::change, look::Look, outbox::Effect};
use crate::tui::{save::SaveError, screens::SCREENS, screens::accuracy::Measurement};
use crate::tui::{screens::map::Map, simulation::Simulate};
use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use std::time::Duration;

mod dial;
mod doubt;
mod keys;
mod map;
mod mouse;
mod take_away;
mod threshold;
mod typing;

/// Opened, without its first simulation.
fn opened() -> App {
    prepare(&["paper-300n".to_owned()], Look::default()).unwrap()
}

/// Opened, and its first simulation asked for.
fn begun() -> App {
    let mut app = opened();
    begin(&mut app);
    app
}

/// The first question of a type that the effects ask.
fn asked<Q: TaskQuestion>(effects: &[Effect]) -> Option<(Ticket, &Q)> {
    effects.iter().find_map(|effect| match effect {
        Effect::Start(request) => Some((request.ticket, request.question()?)),
        _ => None,
    })
}

fn app() -> App {
    let mut app = begun();
    app.model.form.selected = row("impact.force_n");
    app
}

fn row(path: &str) -> FormRow {
    FormRow::Field(fields::find(path).unwrap())
}

/// Tells what came of a question.
fn done<Q: TaskQuestion>(
    app: &mut App,
    ticket: Ticket,
    outcome: Result<Q::Answer, Refusal>,
) -> Vec<Effect> {
    update(app, Message::News(Report::done::<Q>(ticket, outcome)))
}

/// Tells the answer to a question: the whole or what there is so far.
fn tell<Q: TaskQuestion>(
    app: &mut App,
    ticket: Ticket,
    answer: Q::Answer,
    whole: bool,
) -> Vec<Effect> {
    if whole {
        return done::<Q>(app, ticket, Ok(answer));
    }
    update(app, Message::News(Report::so_far::<Q>(ticket, answer)))
}

fn press(app: &mut App, keys: &str) -> Vec<Effect> {
    let mut parser = Parser::default();
    let mut inputs = parser.feed(keys.as_bytes());
    inputs.extend(parser.flush());
    let mut effects = Vec::new();
    for input in inputs {
        match input {
            Typed::Key(event) => effects.extend(update(app, Message::Key(event))),
            Typed::Paste(text) => effects.extend(update(app, Message::Paste(text))),
            Typed::Mouse(_) | Typed::CursorReport(_) => {}
        }
    }
    effects
}

fn pulse(app: &App) -> &ForcePulse {
    let Impact::ForcePulse(pulse) = &app.model.work.scenario.impact else { panic!("no pulse") };
    pulse
}

fn force(app: &App) -> f64 {
    pulse(app).force_n
}

fn typing(app: &App) -> &Typing {
    app.model.form.typing.as_ref().unwrap()
}

fn wrong(app: &App) -> &str {
    typing(app).error.as_ref().unwrap()
}

/// What the footer says of the last key.
fn notice(app: &App) -> &str {
    app.model.notice.as_deref().unwrap_or_default()
}

/// The name that is offered to save under.
fn offered(app: &App) -> String {
    match &app.model.overlay {
        Some(Overlay::Name(Naming::Save, input, _)) => input.value().to_owned(),
        _ => String::new(),
    }
}

/// The ticket of the simulation under way.
fn running(app: &App) -> Ticket {
    app.model.run.job.as_ref().unwrap().ticket
}

/// What comes of the scenario that is worked on.
fn simulated(app: &App) -> Result<Answer, Refusal> {
    Simulate(app.model.work.scenario.clone()).answer(&mut unwatched)
}

fn answer(app: &mut App, ticket: Ticket) {
    done::<Simulate>(app, ticket, simulated(app));
}

/// At the force of the first preset, whose answer is there.
fn answered() -> App {
    let mut app = app();
    answer(&mut app, 1);
    app
}

fn answer_running(app: &mut App) {
    answer(app, running(app));
}

fn list(app: &App) -> Option<&Picker> {
    match &app.model.overlay {
        Some(Overlay::Picker(picker)) => Some(picker),
        _ => None,
    }
}

fn marked(app: &App) -> Vec<&str> {
    app.state::<Comparison>().entries.iter().map(|entry| &entry.name[..]).collect()
}

#[test]
fn every_edit_asks_for_its_own_simulation_and_escape_cancels_it() {
    let mut app = app();
    assert_eq!(press(&mut app, "\x1b"), [Effect::Stop(1)]);
    let effects = press(&mut app, "lll");
    let asked_once = |one: &[Effect]| asked::<Simulate>(one).map(|(ticket, _)| ticket);
    let tickets: Vec<Ticket> = effects.chunks(1).filter_map(asked_once).collect();
    assert_eq!((force(&app), tickets), (330.0, vec![2, 3, 4]));
    assert_eq!(running(&app), 4);
}

#[test]
fn a_late_answer_changes_nothing() {
    let mut app = app();
    press(&mut app, "l");
    answer(&mut app, 1);
    assert!(app.model.shown.is_none(), "that was the answer before the edit");
    answer(&mut app, 2);
    assert!(app.model.shown.is_some() && app.model.run.job.is_none());
}

#[test]
fn a_refusal_keeps_the_last_good_result_and_says_why() {
    let mut app = answered();
    press(&mut app, "l");
    let ticket = running(&app);
    done::<Simulate>(&mut app, ticket, Err(Refusal::Cancelled));
    let (_, why) = app.model.run.complaint.as_ref().unwrap();
    assert!(why.contains("the next edit"));
    assert_eq!(app.model.stale(), Some("last good result"));
    // The next edit that works clears it.
    press(&mut app, "u");
    answer_running(&mut app);
    assert_eq!(app.model.stale(), None);
}

#[test]
fn escape_while_a_preset_is_computed_leaves_form_and_answer_of_one_scene() {
    let mut app = answered();
    press(&mut app, "ptennis\r");
    assert_eq!(app.model.work.name(), "tennis-ball");
    assert!(app.model.form.selected == row("impact.speed_m_s"), "its speed is next");
    let ticket = running(&app);
    let effects = press(&mut app, "\x1b");
    assert!(effects[0] == Effect::Stop(ticket) && asked::<Simulate>(&effects).is_none());
    assert_eq!((app.model.work.name(), app.model.stale()), ("paper-300n", None));
    assert_eq!(app.model.shown.as_ref().unwrap().scenario, app.model.work.scenario);
    assert!(asked::<Simulate>(&press(&mut app, "u")).is_some());
    assert_eq!(app.model.work.name(), "tennis-ball");
}

#[test]
fn undo_and_redo_travel_through_edits_and_presets() {
    let mut app = app();
    press(&mut app, "\r\x15450\rkkkk");
    let first = app.model.work.source.clone();
    press(&mut app, "l");
    assert_ne!(app.model.work.source, first);
    assert!(!app.model.is_edited());
    press(&mut app, "u");
    assert_eq!((app.model.work.source.clone(), force(&app)), (first, 450.0));
    assert!(app.model.is_edited());
    press(&mut app, "u");
    assert_eq!(force(&app), 300.0);
    assert!(!app.model.is_edited());
    press(&mut app, "u");
    assert!(notice(&app).contains("nothing to undo"));
    press(&mut app, "rr");
    assert!(!app.model.is_edited() && app.model.notice.is_none());
    assert_ne!(force(&app), 450.0);
}

#[test]
fn a_step_that_bone_forbids_goes_as_far_as_it_may_and_leaves_the_result_current() {
    let mut app = app();
    press(&mut app, "\tKKKKKKKKKK");
    let limit = pulse(&app).angle_deg;
    answer_running(&mut app);
    press(&mut app, "k");
    assert_eq!((pulse(&app).angle_deg, limit), (40.0, 40.0));
    assert_eq!(notice(&app), "Angle: -40 to 40 deg");
    assert_eq!(app.model.stale(), None);
    press(&mut app, "jJl");
    assert_eq!((pulse(&app).angle_deg, pulse(&app).half_width_deg), (30.0, 21.0));
}

#[test]
fn lists_of_presets_have_a_first_and_a_last() {
    let mut app = app();
    let last = app.model.choices.len() - 1;
    let row = |app: &App| list(app).unwrap().row;
    press(&mut app, "p\x1b[F");
    assert_eq!(row(&app), last);
    press(&mut app, "\x1b[5~");
    assert_eq!(row(&app), last - 10);
    press(&mut app, "\x1b[H\x1b[6~");
    assert_eq!(row(&app), 10);
    press(&mut app, "\x1b\x1b4\x1b[F");
    assert_eq!(app.state::<Comparison>().row, last + 1);
    press(&mut app, "\x1b[H");
    assert_eq!(app.state::<Comparison>().row, 0);
}

#[test]
fn a_speed_behind_a_name_in_the_list_goes_with_it_and_an_f_key_leaves_the_list() {
    let mut app = begun();
    press(&mut app, "psquash@30\r");
    assert_eq!(app.model.work.scenario.name, "Squash ball at 30 m/s");
    press(&mut app, "p\x1b4/paintb@80\rcork@fast\r");
    let said = notice(&app);
    assert!(said.contains("fast is not a number"), "{said}");
    assert_eq!(marked(&app), ["paintball@80"]);
    assert_eq!(app.state::<Comparison>().entries[0].scenario.name, "Paintball at 80 m/s");
}

#[test]
fn more_scenarios_than_can_be_marked_are_counted() {
    let names = "paper-300n paper-100n paper-600n wide-area small-area bb-56 bb-62 bb-92";
    let names: Vec<String> = names.split(' ').map(str::to_owned).collect();
    let look = Look::default();
    let app = prepare(&names, look).unwrap();
    assert_eq!(marked(&app), names[..6]);
    assert!(notice(&app).contains("first 6 are marked for comparison, 2 are not"));
    assert!(prepare(&names[..6], look).unwrap().model.notice.is_none());
}

#[test]
fn saving_asks_for_a_name_and_before_it_hides_a_preset_and_counts_once_it_is_done() {
    let mut app = app();
    press(&mut app, "l\x13");
    assert_eq!(offered(&app), "paper-300n-2");
    assert_eq!(press(&mut app, "\x15paper-300n\r"), []);
    let hide = Prompt::Hide("paper-300n".to_owned());
    assert!(matches!(&app.model.overlay, Some(Overlay::Prompt(q)) if *q == hide));
    let effects = press(&mut app, "n\x15mine\r");
    let [Effect::Save(name, text, false)] = &effects[..] else { panic!("{effects:?}") };
    assert!(name == "mine" && text.contains("name: \"mine\""));
    for outcome in [Err(SaveError::Failed("no space".to_owned())), Ok(())] {
        assert!(app.model.is_edited());
        update(&mut app, Message::Saved("mine".to_owned(), outcome));
    }
    assert!(!app.model.is_edited() && app.model.overlay.is_none());
    assert_eq!(app.model.work.source, "mine");
}

#[test]
fn marks_are_simulated_one_after_another() {
    let mut app = app();
    let effects = press(&mut app, "\x1b4j j ");
    let (first, _) = asked::<SimulateMarked>(&effects).unwrap();
    let answer = simulated(&app);
    let effects = done::<SimulateMarked>(&mut app, first, answer.clone());
    let (second, _) = asked::<SimulateMarked>(&effects).unwrap();
    // Mesh errors and inputs follow once all are there.
    let effects = done::<SimulateMarked>(&mut app, second, answer);
    assert!(asked::<CompleteMarked>(&effects).is_some());
    assert!(app.state::<Comparison>().entries.iter().all(|entry| entry.answer().is_some()));
}

#[test]
fn unmarking_stops_a_simulation_nobody_waits_for_and_the_form_follows_into_the_comparison() {
    let mut app = app();
    press(&mut app, "\x1b4j ");
    assert!(matches!(press(&mut app, " ")[..], [Effect::Stop(_)]));
    assert!(app.state::<Comparison>().task.job.is_none());
    press(&mut app, "k 1l");
    let effects = press(&mut app, "\x1b4");
    let (_, marked) = asked::<SimulateMarked>(&effects).unwrap();
    assert_eq!(marked.scenario, app.model.work.scenario);
}

#[test]
fn time_passes_only_while_the_replay_plays() {
    let mut app = answered();
    let second = |n| Message::Tick(Duration::from_secs(n));
    update(&mut app, second(1));
    let still = app.time();
    update(&mut app, second(2));
    assert_eq!(app.time(), still);
    press(&mut app, " ");
    assert_eq!(app.time(), 0.0);
    update(&mut app, second(3));
    assert!((app.time() - 0.5e-3).abs() < 1e-12);
}

#[test]
fn what_is_undone_after_saving_counts_as_edited() {
    let mut app = app();
    press(&mut app, "l");
    let name = app.model.work.source.clone();
    update(&mut app, Message::Saved(name.clone(), Ok(())));
    assert!(!app.model.is_edited());
    press(&mut app, "u");
    assert_eq!(force(&app), 300.0);
    assert!(app.model.is_edited(), "the preset now holds 310 N");
    press(&mut app, "r");
    assert!(!app.model.is_edited() && force(&app) == 310.0);
    // A step after saving is a change of its own, however soon it comes.
    press(&mut app, "l");
    update(&mut app, Message::Saved(name, Ok(())));
    press(&mut app, "lu");
    assert_eq!(force(&app), 320.0);
}

#[test]
fn a_file_is_called_by_its_name_and_leaves_room_for_the_screens() {
    let mut app = app();
    app.model.work.source = format!("/some/where/{}.ron", "x".repeat(90));
    assert!(app.model.title().starts_with("xxx"));
    assert!(tabs(&app, 100).iter().all(|(_, label)| label.len() > 3));
    app.model.work.source = "a/b/".to_owned();
    assert_eq!(app.model.title(), "b");
}

#[test]
fn a_guest_may_not_go_beyond_its_bounds_by_any_way() {
    let mut app = app();
    app.model.guest = true;
    app.model.form.selected = row("window_ms");
    // By steps, by typing, and by whatever else brings a scenario.
    press(&mut app, &"L".repeat(30));
    assert_eq!(app.model.work.scenario.window_ms, Some(20.0));
    assert!(notice(&app).contains("not for guests"));
    for keys in ["\r\x1521", "\r"] {
        press(&mut app, keys);
        assert_eq!(app.model.work.scenario.window_ms, Some(20.0));
        assert!(wrong(&app).contains("not for guests"), "{}", wrong(&app));
    }
    press(&mut app, "\x1b");
    let mut fine = app.model.work.clone();
    fine.scenario.eye.level = 4;
    change(&mut app.model, fine, "");
    assert_eq!(app.model.work.scenario.eye.level, 1);
    press(&mut app, "\x13");
    assert!(app.model.overlay.is_none());
    press(&mut app, "\x1b6");
    let asked = app.model.ensemble.task.job.as_ref().unwrap().question.count;
    assert_eq!(asked, crate::tui::guest::MOST_SAMPLES);
}

#[test]
fn letters_search_the_list_of_presets_and_do_nothing_behind_it() {
    let mut app = app();
    press(&mut app, "p");
    let before = app.model.work.clone();
    // Where nothing is found, Enter opens nothing.
    for typed in "qjk squash, wyr?1\r".chars() {
        assert!(press(&mut app, &typed.to_string()).is_empty(), "{typed}");
        assert!(list(&app).is_some() && app.model.form.typing.is_none(), "{typed}");
    }
    assert!(app.model.work == before && app.screen == 0);
    press(&mut app, "\x1b");
    assert!(app.model.overlay.is_none());
    // What is found is opened, and what was changed is kept.
    press(&mut app, "lpsqua ball\r");
    assert_eq!(app.model.work.source, "squash-ball");
    assert!(notice(&app).contains("u brings back"));
    press(&mut app, "u");
    assert_eq!(force(&app), 310.0);
}

#[test]
fn only_a_preset_of_ones_own_is_renamed_and_removed_and_an_undo_brings_it_back() {
    let mut app = app();
    let (rename, delete) = ("\x1bOQ", "\x1b[3~");
    for key in [rename, delete] {
        press(&mut app, "pbb 56");
        assert!(press(&mut app, key).is_empty());
        assert!(notice(&app).contains("stays as it is"));
        press(&mut app, "\x1b");
    }
    press(&mut app, "l");
    let [name, hers] = ["my blow", "hers"].map(str::to_owned);
    update(&mut app, Message::Saved(name.clone(), Ok(())));
    let scenario = Ok(app.model.work.scenario.clone());
    app.model.choices.push(Choice { name: name.clone(), scenario, origin: "own" });
    press(&mut app, &format!("p{rename}"));
    assert_eq!(press(&mut app, "\x15bb-56\r"), [], "that name is taken");
    let effects = press(&mut app, "\x15hers\r");
    assert_eq!(effects, [Effect::Rename(name.clone(), hers.clone())]);
    update(&mut app, Message::Renamed(name, hers.clone(), Ok(())));
    assert!(!app.model.is_edited());
    // No leaves it, and leads back to the list.
    assert_eq!(press(&mut app, &format!("{delete}n")), []);
    assert_eq!(press(&mut app, &format!("{delete}y")), [Effect::Remove(hers.clone())]);
    update(&mut app, Message::Removed(hers.clone(), Ok("its text".to_owned())));
    assert!(app.model.choices.iter().all(|choice| choice.name != hers));
    // What it held is still worked on under its name, and is not lost without a question.
    assert!(app.model.is_edited() && app.model.work.name() == hers);
    press(&mut app, "\x1b");
    assert_eq!(press(&mut app, "u"), [Effect::Restore(hers.clone(), "its text".to_owned())]);
    assert_eq!(force(&app), 310.0, "the removal came last");
    press(&mut app, "\x13");
    assert_eq!(offered(&app), "hers");
    press(&mut app, "\x1b");
    press(&mut app, "q");
    assert!(matches!(app.model.overlay, Some(Overlay::Prompt(Prompt::Quit(_)))));
}

#[test]
fn a_speed_is_changed_where_it_is_compared_and_the_form_stays() {
    let mut app = begun();
    press(&mut app, "\x1b4/bb-62\r\x1b");
    assert_eq!(marked(&app), ["bb-62"]);
    press(&mut app, "e-60\r");
    assert!(app.model.overlay.is_some(), "no speed is below 0");
    press(&mut app, "\x1560\r");
    assert_eq!(marked(&app), ["bb-62@60"]);
    assert_eq!(force(&app), 300.0);
    let effects = press(&mut app, "e50\r");
    let (_, asked) = asked::<SimulateMarked>(&effects).unwrap();
    let Impact::Projectile(bb) = &asked.scenario.impact else { panic!() };
    assert_eq!(bb.speed_m_s, 50.0);
    // In the table another field of the same row; there and back is the preset again.
    press(&mut app, "\te\x1b[A\x1b[A0.5\r");
    assert_eq!(marked(&app), ["bb-62@50,mass_g=0.5"]);
    press(&mut app, "\x1b[Z ");
    assert!(marked(&app).is_empty(), "marking again unmarks");
}

#[test]
fn nothing_runs_that_the_screen_on_show_has_no_room_for() {
    let busy = |app: &App| -> Vec<&str> {
        let tasks = [
            ("Compare", app.state::<Comparison>().task.job.is_some()),
            ("Accuracy", app.state::<Measurement>().task.job.is_some()),
            ("Map", app.state::<Map>().task.job.is_some()),
            ("Doubt", app.model.ensemble.task.job.is_some()),
        ];
        tasks.into_iter().filter_map(|(title, busy)| busy.then_some(title)).collect()
    };
    let mut app = begun();
    press(&mut app, "\x1b4 ");
    assert_eq!(busy(&app), ["Compare"]);
    for _ in 0..2 {
        for place in (0..SCREENS.len()).rev() {
            app.show(place);
            app.refresh_requests();
            let title = SCREENS[place].title;
            let works = ["Compare", "Accuracy", "Map", "Doubt"].contains(&title);
            assert_eq!(busy(&app), if works { vec![title] } else { vec![] });
        }
    }
}
