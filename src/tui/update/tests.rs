//! What keys and answers do to the model, without a terminal and without threads.

use crate::answer::solve::solve as simulate;
use crate::run::kept::Keep;
use crate::run::refusal::Refusal;
use crate::run::watch::unwatched;
use crate::scenario::Impact;
use crate::scenario::fields;
use crate::tui::form::Row;
use crate::tui::prepare;
use crate::tui::screens::compare::{EstimateMarked, SimulateMarked};
use crate::tui::simulation::Simulate;
use crate::tui::terminal::input::{Input as Typed, Parser};
use crate::tui::update::driven::{asked, begun};
use crate::tui::update::*;

mod typing;

fn model() -> Model {
    let mut model = begun();
    model.form.selected = Row::Field(fields::find("impact.force_n").unwrap());
    model
}

fn press(model: &mut Model, keys: &str) -> Vec<Effect> {
    let mut parser = Parser::default();
    let mut inputs = parser.feed(keys.as_bytes());
    inputs.extend(parser.flush());
    let mut effects = Vec::new();
    for input in inputs {
        match input {
            Typed::Key(event) => effects.extend(update(model, Message::Key(event))),
            Typed::Paste(text) => effects.extend(update(model, Message::Paste(text))),
            Typed::Mouse(_) | Typed::CursorReport(_) => {}
        }
    }
    effects
}

fn force(model: &Model) -> f64 {
    let Impact::ForcePulse(pulse) = &model.work.scenario.impact else {
        panic!()
    };
    pulse.force_n
}

/// The name that is offered to save under.
fn offered(model: &Model) -> String {
    match &model.overlay {
        Some(Overlay::Name(Naming::Save, input, _)) => input.value().to_owned(),
        _ => String::new(),
    }
}

/// The ticket of the simulation under way.
fn running(model: &Model) -> Ticket {
    model.run.job.as_ref().unwrap().ticket
}

fn answer(model: &mut Model, ticket: Ticket) {
    let answer = simulate(
        &model.work.scenario.check().unwrap(),
        Keep::default(),
        &mut unwatched,
    );
    let report = Report::done::<Simulate>(ticket, answer);
    update(model, Message::News(report));
}

fn refuse(model: &mut Model, ticket: Ticket, refusal: Refusal) {
    let report = Report::done::<Simulate>(ticket, Err(refusal));
    update(model, Message::News(report));
}

#[test]
fn every_edit_asks_for_its_own_simulation() {
    let mut model = model();
    let effects = press(&mut model, "lll");
    let tickets: Vec<Ticket> = effects
        .iter()
        .filter_map(|effect| Some(asked::<Simulate>(std::slice::from_ref(effect))?.0))
        .collect();
    assert_eq!(force(&model), 330.0);
    assert!(tickets.is_sorted() && tickets.len() == 3);
    assert_eq!(running(&model), tickets[2]);
}

#[test]
fn a_late_answer_changes_nothing() {
    let mut model = model();
    press(&mut model, "l");
    answer(&mut model, 1);
    assert!(model.shown.is_none(), "that was the answer before the edit");
    answer(&mut model, 2);
    assert!(model.shown.is_some() && model.run.job.is_none());
}

#[test]
fn a_refusal_keeps_the_last_good_result_and_says_why() {
    let mut model = model();
    answer(&mut model, 1);
    press(&mut model, "l");
    let ticket = running(&model);
    refuse(&mut model, ticket, Refusal::Cancelled);
    let (_, why) = model.run.complaint.as_ref().unwrap();
    assert!(why.contains("the next edit"));
    assert_eq!(model.stale(), Some("last good result"));
    // The next edit that works clears it.
    press(&mut model, "u");
    let ticket = running(&model);
    answer(&mut model, ticket);
    assert_eq!(model.stale(), None);
}

#[test]
fn escape_cancels_a_run_and_an_edit_supersedes_it() {
    let mut model = model();
    assert_eq!(press(&mut model, "\x1b"), [Effect::Stop(1)]);
    assert_eq!(asked::<Simulate>(&press(&mut model, "l")).unwrap().0, 2);
}

#[test]
fn undo_and_redo_travel_through_edits_and_presets() {
    let mut model = model();
    press(&mut model, "\r\x15450\r");
    press(&mut model, "kkkk");
    let first = model.work.source.clone();
    press(&mut model, "l");
    assert_ne!(model.work.source, first);
    assert!(!model.is_edited());
    press(&mut model, "u");
    assert_eq!((model.work.source.clone(), force(&model)), (first, 450.0));
    assert!(model.is_edited());
    press(&mut model, "u");
    assert_eq!(force(&model), 300.0);
    assert!(!model.is_edited());
    press(&mut model, "u");
    assert!(model.notice.as_ref().unwrap().contains("nothing to undo"));
    press(&mut model, "rr");
    assert!(!model.is_edited() && model.notice.is_none());
    assert_ne!(force(&model), 450.0);
}

#[test]
fn a_step_that_bone_forbids_goes_as_far_as_it_may_and_leaves_the_result_current() {
    let mut model = model();
    press(&mut model, "\tKKKKKKKKKK");
    let angle = |model: &Model| match &model.work.scenario.impact {
        Impact::ForcePulse(pulse) => pulse.angle_deg,
        Impact::Projectile(_) => panic!(),
    };
    let limit = angle(&model);
    let ticket = running(&model);
    answer(&mut model, ticket);
    press(&mut model, "k");
    assert_eq!(angle(&model), limit);
    assert!(
        model
            .form
            .complaint
            .as_ref()
            .unwrap()
            .contains("bone shields")
    );
    assert_eq!(model.stale(), None);
}

#[test]
fn lists_of_presets_have_a_first_and_a_last() {
    let mut model = model();
    let last = model.choices.len() - 1;
    let row = |model: &Model| match &model.overlay {
        Some(Overlay::Picker(picker)) => picker.row,
        _ => usize::MAX,
    };
    press(&mut model, "p\x1b[F");
    assert_eq!(row(&model), last);
    press(&mut model, "\x1b[5~");
    assert_eq!(row(&model), last - 10);
    press(&mut model, "\x1b[H\x1b[6~");
    assert_eq!(row(&model), 10);
    press(&mut model, "\x1b");
    press(&mut model, "\x1b4\x1b[F");
    assert_eq!(model.screens.compare.row, last + 1);
    press(&mut model, "\x1b[H");
    assert_eq!(model.screens.compare.row, 0);
}

#[test]
fn more_scenarios_than_can_be_marked_are_counted() {
    let names = [
        "paper-300n",
        "paper-100n",
        "paper-600n",
        "wide-area",
        "small-area",
        "bb-56",
        "bb-62",
        "bb-92",
    ]
    .map(str::to_owned);
    let look = model().look;
    let model = prepare(&names, look).unwrap();
    assert_eq!(model.screens.compare.entries.len(), 6);
    assert!(
        model
            .notice
            .unwrap()
            .contains("first 6 are marked for comparison, 2 are not")
    );
    assert!(prepare(&names[..6], look).unwrap().notice.is_none());
}

#[test]
fn quitting_asks_only_when_work_would_be_lost() {
    let mut model = model();
    assert_eq!(press(&mut model, "q"), [Effect::Quit(0)]);
    press(&mut model, "l");
    assert_eq!(press(&mut model, "q"), []);
    assert_eq!(press(&mut model, "n"), []);
    assert_eq!(press(&mut model, "qy"), [Effect::Quit(0)]);
    press(&mut model, "u");
    assert_eq!(press(&mut model, "q"), [Effect::Quit(0)]);
    press(&mut model, "l");
    assert_eq!(press(&mut model, "\x03"), [Effect::Quit(130)]);
}

#[test]
fn saving_asks_for_a_name_and_before_it_replaces() {
    let mut model = model();
    press(&mut model, "ls");
    assert_eq!(offered(&model), "paper-300n-2");
    // That of the built-in one would hide it.
    press(&mut model, "\x15paper-300n");
    assert_eq!(press(&mut model, "\r"), []);
    let replace = Question::Hide("paper-300n".to_owned());
    assert!(matches!(&model.overlay, Some(Overlay::Question(q)) if *q == replace));
    press(&mut model, "n");
    press(&mut model, "\x15a/b\r");
    assert!(matches!(&model.overlay, Some(Overlay::Name(_, _, Some(_)))));
    let effects = press(&mut model, "\x15mine\r");
    let [Effect::Save(name, text, false)] = &effects[..] else {
        panic!("{effects:?}")
    };
    assert!(name == "mine" && text.contains("name: \"mine\""));
    // Nothing counts as saved before it is.
    assert!(model.is_edited());
    let full = SaveError::Failed("no space".to_owned());
    update(&mut model, Message::Saved("mine".to_owned(), Err(full)));
    assert!(model.is_edited());
    update(&mut model, Message::Saved("mine".to_owned(), Ok(())));
    assert!(!model.is_edited() && model.overlay.is_none());
    assert_eq!(model.work.source, "mine");
}

#[test]
fn the_dial_and_the_form_turn_the_same_angle() {
    let mut model = model();
    press(&mut model, "\tkkK");
    let Impact::ForcePulse(pulse) = &model.work.scenario.impact else {
        panic!()
    };
    assert_eq!(pulse.angle_deg, 10.0);
    press(&mut model, "l");
    let Impact::ForcePulse(pulse) = &model.work.scenario.impact else {
        panic!()
    };
    assert_eq!(pulse.half_width_deg, 21.0);
}

#[test]
fn marks_are_simulated_one_after_another() {
    let mut model = model();
    let effects = press(&mut model, "\x1b4j j ");
    let (first, _) = asked::<SimulateMarked>(&effects).unwrap();
    let done = |model: &mut Model, ticket| {
        let answer = simulate(
            &model.work.scenario.check().unwrap(),
            Keep::default(),
            &mut unwatched,
        );
        let report = Report::done::<SimulateMarked>(ticket, answer);
        update(model, Message::News(report))
    };
    let effects = done(&mut model, first);
    let (second, _) = asked::<SimulateMarked>(&effects).unwrap();
    // Their mesh errors follow once all are there.
    let effects = done(&mut model, second);
    assert!(asked::<EstimateMarked>(&effects).is_some());
    assert!(
        model
            .screens
            .compare
            .entries
            .iter()
            .all(|e| e.answer().is_some())
    );
}

#[test]
fn unmarking_stops_a_simulation_nobody_waits_for() {
    let mut model = model();
    press(&mut model, "\x1b4j ");
    let effects = press(&mut model, " ");
    assert!(matches!(effects[..], [Effect::Stop(_)]));
    assert!(model.screens.compare.task.job.is_none());
}

#[test]
fn the_form_follows_into_the_comparison() {
    let mut model = model();
    press(&mut model, "\x1b4 ");
    press(&mut model, "1l");
    let effects = press(&mut model, "\x1b4");
    let (_, marked) = asked::<SimulateMarked>(&effects).unwrap();
    assert_eq!(marked.scenario, model.work.scenario);
}

#[test]
fn time_passes_only_while_the_replay_plays() {
    let mut model = model();
    answer(&mut model, 1);
    let second = |n| Message::Tick(Duration::from_secs(n));
    update(&mut model, second(1));
    let still = model.time();
    update(&mut model, second(2));
    assert_eq!(model.time(), still);
    press(&mut model, " ");
    assert_eq!(model.time(), 0.0);
    update(&mut model, second(3));
    assert!((model.time() - 0.5e-3).abs() < 1e-12);
}

#[test]
fn what_is_undone_after_saving_counts_as_edited() {
    let mut model = model();
    press(&mut model, "l");
    let name = model.work.source.clone();
    update(&mut model, Message::Saved(name, Ok(())));
    assert!(!model.is_edited());
    press(&mut model, "u");
    assert_eq!(force(&model), 300.0);
    assert!(model.is_edited(), "the preset now holds 310 N");
    press(&mut model, "r");
    assert!(!model.is_edited() && force(&model) == 310.0);
    // A step after saving is a change of its own, however soon it comes.
    press(&mut model, "l");
    let name = model.work.source.clone();
    update(&mut model, Message::Saved(name, Ok(())));
    press(&mut model, "lu");
    assert_eq!(force(&model), 320.0);
}

#[test]
fn a_file_is_called_by_its_name_and_leaves_room_for_the_screens() {
    let mut model = model();
    model.work.source = format!("/some/where/{}.ron", "x".repeat(90));
    assert!(model.title().starts_with("xxx"));
    let tabs = crate::tui::view::tabs(&model, 100);
    assert!(
        tabs.iter().all(|(_, label)| label.len() > 3),
        "{}",
        tabs.len()
    );
    model.work.source = "a/b/".to_owned();
    assert_eq!(model.title(), "b");
}

#[test]
fn a_guest_may_not_go_beyond_its_bounds_by_any_way() {
    let mut model = model();
    model.guest = true;
    model.form.selected = Row::Field(fields::find("window_ms").unwrap());
    // By steps, by typing, and by whatever else brings a scenario.
    press(&mut model, &"L".repeat(30));
    assert_eq!(model.work.scenario.window_ms, 20.0);
    assert!(model.notice.as_ref().unwrap().contains("not for guests"));
    for keys in ["\r\x1521", "\r"] {
        press(&mut model, keys);
        assert_eq!(model.work.scenario.window_ms, 20.0);
        let error = model.form.typing.as_ref().unwrap().error.as_ref().unwrap();
        assert!(error.contains("not for guests"), "{error}");
    }
    press(&mut model, "\x1b");
    let mut fine = model.work.clone();
    fine.scenario.eye.level = 4;
    change(&mut model, fine, "");
    assert_eq!(model.work.scenario.eye.level, 1);
    press(&mut model, "s");
    assert!(model.overlay.is_none());
    press(&mut model, "\x1b6");
    let asked = model.ensemble.task.job.as_ref().unwrap().question.count;
    assert_eq!(asked, crate::tui::guest::MOST_SAMPLES);
}

#[test]
fn letters_search_the_list_of_presets_and_do_nothing_behind_it() {
    let mut model = model();
    press(&mut model, "p");
    let before = model.work.clone();
    for typed in "qjk squash, wyr?1".chars() {
        assert!(press(&mut model, &typed.to_string()).is_empty(), "{typed}");
        let in_front = matches!(model.overlay, Some(Overlay::Picker(_)));
        assert!(in_front && model.form.typing.is_none(), "{typed}");
    }
    // Where nothing is found, Enter opens nothing.
    press(&mut model, "\r");
    assert!(matches!(model.overlay, Some(Overlay::Picker(_))));
    assert!(model.work == before && model.screen == 0);
    press(&mut model, "\x1b");
    assert!(model.overlay.is_none());
}

#[test]
fn what_is_searched_for_is_opened_and_what_was_changed_is_kept() {
    let mut model = model();
    press(&mut model, "l");
    press(&mut model, "psqua ball\r");
    assert_eq!(model.work.source, "squash-ball");
    assert!(model.notice.as_ref().unwrap().contains("u brings back"));
    press(&mut model, "u");
    assert_eq!(force(&model), 310.0);
}

#[test]
fn a_preset_of_ones_own_is_renamed_and_removed_after_a_question_and_no_other() {
    let mut model = model();
    let (rename, delete) = ("\x1bOQ", "\x1b[3~");
    for key in [rename, delete] {
        press(&mut model, "pbb 56");
        assert!(press(&mut model, key).is_empty());
        assert!(model.notice.as_ref().unwrap().contains("stays as it is"));
        press(&mut model, "\x1b");
    }
    press(&mut model, "ls\x15my blow\r");
    let name = "my blow".to_owned();
    update(&mut model, Message::Saved(name.clone(), Ok(())));
    let mut own = model.choices[0].clone();
    own.name.clone_from(&name);
    own.scenario = Ok(model.work.scenario.clone());
    own.origin = "own";
    model.choices.push(own);
    press(&mut model, "p");
    press(&mut model, rename);
    assert_eq!(press(&mut model, "\x15bb-56\r"), [], "that name is taken");
    let effects = press(&mut model, "\x15hers\r");
    let hers = "hers".to_owned();
    assert_eq!(effects, [Effect::Rename(name.clone(), hers.clone())]);
    update(&mut model, Message::Renamed(name, hers.clone(), Ok(())));
    assert_eq!(
        (&model.work.source, &model.work.scenario.name),
        (&hers, &hers)
    );
    assert!(!model.is_edited());
    // No leaves it, and leads back to the list.
    assert_eq!(press(&mut model, &format!("{delete}n")), []);
    let effects = press(&mut model, &format!("{delete}y"));
    assert_eq!(effects, [Effect::Remove(hers.clone())]);
    update(&mut model, Message::Removed(hers.clone(), Ok(())));
    assert!(model.choices.iter().all(|choice| choice.name != hers));
    // What it held is still worked on under its name, and is not lost without a question.
    assert!(model.is_edited() && force(&model) == 310.0);
    assert_eq!(model.work.name(), "hers");
    press(&mut model, "\x1b");
    press(&mut model, "s");
    assert_eq!(offered(&model), "hers");
    press(&mut model, "\x1b");
    press(&mut model, "q");
    assert!(matches!(
        model.overlay,
        Some(Overlay::Question(Question::Quit { .. }))
    ));
}

#[test]
fn nothing_runs_that_the_screen_on_show_has_no_room_for() {
    let busy = |model: &Model| {
        let screens = &model.screens;
        [
            ("Compare", screens.compare.task.job.is_some()),
            ("Accuracy", screens.accuracy.task.job.is_some()),
            ("Map", screens.map.task.job.is_some()),
            ("Doubt", model.ensemble.task.job.is_some()),
        ]
        .into_iter()
        .filter_map(|(title, busy)| busy.then_some(title))
        .collect::<Vec<_>>()
    };
    let mut model = begun();
    press(&mut model, "\x1b4 ");
    assert_eq!(busy(&model), ["Compare"]);
    for _ in 0..2 {
        for place in (0..SCREENS.len()).rev() {
            crate::tui::update::show(&mut model, place);
            attend(&mut model);
            let title = SCREENS[place].title;
            let works = ["Compare", "Accuracy", "Map", "Doubt"].contains(&title);
            assert_eq!(busy(&model), if works { vec![title] } else { vec![] });
        }
    }
}
