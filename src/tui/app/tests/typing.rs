//! What typing a value does.

use super::*;
use crate::tui::{form::rows, work::Work};

#[test]
fn arrows_tab_and_function_keys_accept_what_a_digit_began() {
    let (here, down) = ("impact.force_n", "impact.duration_ms");
    for (keys, path, screen) in [
        ("\x1b[A", "impact", 0),
        ("\x1b[B", down, 0),
        ("\t", down, 0),
        ("\x1b[D", here, 0),
        ("\x1b[C", here, 0),
        ("\x1bOR", here, 2),
        ("\x1b4", here, 3),
    ] {
        let mut app = app();
        press(&mut app, "80");
        assert_eq!(force(&app), 300.0);
        press(&mut app, keys);
        let form = &app.model.form;
        assert!(form.typing.is_none() && force(&app) == 80.0, "{keys:?}");
        assert!(form.selected == row(path) && app.screen == screen);
        press(&mut app, "u");
        assert_eq!(force(&app), 300.0, "one change");
    }
    // What makes no sense is kept with its reason, and no screen hides it.
    let mut app = app();
    press(&mut app, "-7\x1bOR");
    assert!(typing(&app).error.is_some());
    assert_eq!((app.screen, force(&app)), (0, 300.0));
    // Of a text that was there before, an arrow goes through it.
    press(&mut app, "\x1b\r\x1b[D");
    assert!(app.model.form.typing.is_some());
}

#[test]
fn what_is_typed_after_enter_replaces_the_value_and_a_doubt_goes_behind_it() {
    let mut app = app();
    for (keys, value) in [("\r45\r", 45.0), ("\r\x1b[D6\r", 465.0), ("\r +- 5\r", 465.0)] {
        press(&mut app, keys);
        assert_eq!(force(&app), value);
    }
    assert_eq!(app.model.work.scenario.doubt["impact.force_n"], 5.0);
    press(&mut app, "\r\x1b[200~75\x1b[201~\r");
    assert_eq!(force(&app), 75.0);
    // A name that is offered is typed over as well.
    press(&mut app, "\x13m");
    assert_eq!(offered(&app), "m");
}

#[test]
fn no_letter_typed_on_main_saves_or_removes_anything() {
    for letter in ('a'..='z').chain('A'..='Z') {
        let mut app = answered();
        let effects = press(&mut app, &letter.to_string());
        let is_kept = |effect: &Effect| {
            use Effect::{Page, Remove, Rename, Save};
            !matches!(effect, Save(..) | Remove(..) | Rename(..) | Page(..))
        };
        assert!(effects.iter().all(is_kept), "{letter}");
        assert!(!matches!(app.model.overlay, Some(Overlay::Name(..))), "{letter}");
    }
    // A word is no name to save under.
    let mut app = answered();
    press(&mut app, "squash\r");
    assert!(app.model.choices.iter().all(|choice| choice.name != "quash"));
}

#[test]
fn an_empty_paste_opens_nothing_and_one_without_a_field_is_refused() {
    for nothing in ["", "\n", " \t "] {
        let mut app = app();
        press(&mut app, &format!("\x1b[200~{nothing}\x1b[201~"));
        assert!(app.model.form.typing.is_none() && app.model.overlay.is_none(), "{nothing:?}");
    }
    let mut app = app();
    app.model.form.selected = FormRow::Preset;
    press(&mut app, "\x1b[200~squash\x1b[201~");
    assert!(app.model.form.typing.is_none() && app.model.overlay.is_none());
    assert!(app.model.notice.as_ref().is_some_and(|said| said.contains("nothing is pasted")));
}

#[test]
fn a_doubt_that_is_typed_changes_no_answer_and_asks_for_none() {
    let mut app = answered();
    let effects = press(&mut app, "\r\x1545\r");
    assert!(asked::<Simulate>(&effects).is_some());
    answer_running(&mut app);
    press(&mut app, "\r");
    for typed in [" ", "+", "-", " ", "5"] {
        assert!(asked::<Simulate>(&press(&mut app, typed)).is_none(), "{typed}");
        assert!(typing(&app).error.is_none());
    }
    assert!(asked::<Simulate>(&press(&mut app, "\r")).is_none());
    assert_eq!((force(&app), app.model.stale()), (45.0, None));
    assert_eq!(app.model.work.scenario.doubt["impact.force_n"], 5.0);
    assert!(asked::<Simulate>(&press(&mut app, "uu")).is_some());
    assert!(app.model.work.scenario.doubt.is_empty());
    // Enter takes no half of a doubt.
    press(&mut app, "45 +-\r");
    assert!(wrong(&app).contains("allowed"));
}

#[test]
fn no_two_rows_of_a_form_read_alike() {
    let mut app = opened();
    app.model.form.advanced = true;
    for choice in app.model.choices.clone() {
        let scenario = choice.scenario.unwrap();
        app.model.work = Work::fresh(&choice.name, &scenario);
        // The folded rows are many: the form is scrolled to none of them.
        for columns in [60, 80, 120] {
            let mut buffer = Buffer::empty(Rect::new(0, 0, columns, 90));
            draw(&app, &mut buffer);
            let rows = rows(&scenario, true).len() as u16;
            let mut labels: Vec<String> = Vec::new();
            for y in 1..=rows {
                let line: String = (1..25).map(|x| buffer[(x, y)].symbol()).collect();
                let label = line.trim_start().split("  ").next().unwrap().to_owned();
                let own = label.split(" ?").next().unwrap().to_owned();
                assert!(!own.is_empty(), "{}: {line}", choice.name);
                let name = &choice.name;
                assert!(!labels.contains(&own), "{name}: {own} in {columns}");
                labels.push(own);
            }
        }
    }
}

#[test]
fn enter_takes_the_next_of_a_few_choices() {
    let mut app = app();
    let shape = fields::find("impact.shape").unwrap();
    app.model.form.selected = FormRow::Field(shape);
    press(&mut app, "\r");
    assert_eq!(shape.text(&app.model.work.scenario).unwrap(), "Triangle");
    assert!(app.model.form.typing.is_none());
    // What is pasted is typed.
    let table = "Table([(0, 0), (0.1, 1), (0.3, 0)])";
    press(&mut app, &format!("\x1b[200~{table}\x1b[201~\r"));
    assert_eq!(shape.text(&app.model.work.scenario).unwrap(), "Table");
    press(&mut app, "\r");
    assert!(app.model.form.typing.is_some(), "a recorded curve is kept");
}

#[test]
fn a_letter_is_no_part_of_a_number_and_is_refused_in_words() {
    let mut app = app();
    press(&mut app, "7");
    assert_eq!(press(&mut app, "us?q"), []);
    let value = |app: &App| typing(app).input.value().to_owned();
    assert_eq!((value(&app), app.screen), ("7".to_owned(), 0));
    assert!(notice(&app).contains("Enter accepts"));
    press(&mut app, ",5 ± 2e-1");
    assert_eq!(value(&app), "7.5 ± 2e-1");
    assert!(app.model.notice.is_none());
    // A pasted comma may stand for thousands: it is explained.
    press(&mut app, "\x15\x1b[200~1,000\x1b[201~");
    assert!(wrong(&app).contains("not a comma"));
    press(&mut app, "\x15");
    assert_eq!(wrong(&app), "nothing is there: allowed 0 to 100000 N");
}

#[test]
fn what_the_form_shows_can_be_typed() {
    let mut app = app();
    press(&mut app, "a");
    for (path, keys, text) in [
        ("window_ms", "4\r", "4"),
        ("window_ms", "\r\x15auto\r", "Auto"),
        ("numerics.step_us", "2\r", "2"),
        ("numerics.step_us", "\r\x15Auto\r", "Auto"),
        ("eye.lens", "\x1b[200~soft\x1b[201~\r", "Soft"),
        ("model", "\x1b[200~physiological\x1b[201~\r", "Physiological"),
        ("model.species", "\x1b[200~pig\x1b[201~\r", "Pig"),
    ] {
        app.model.form.selected = row(path);
        press(&mut app, keys);
        let field = fields::find(path).unwrap();
        assert_eq!(field.text(&app.model.work.scenario).unwrap(), text, "{path}");
    }
    app.model.form.selected = row("numerics.step_us");
    press(&mut app, "\r");
    assert_eq!(typing(&app).input.value(), "auto");
    press(&mut app, "\x150");
    assert!(wrong(&app).contains("allowed auto, or"));
}

#[test]
fn what_is_typed_changes_nothing_until_it_is_accepted_and_escape_restores() {
    let mut app = answered();
    // A digit begins a value where a number is wanted, Enter everywhere.
    for (keys, is_wrong) in [("450", false), ("-7\r", true), ("\r\x1545-", true)] {
        assert!(asked::<Simulate>(&press(&mut app, keys)).is_none());
        assert_eq!((force(&app), app.model.stale(), app.screen), (300.0, None, 0));
        assert_eq!(typing(&app).error.is_some(), is_wrong, "{keys}");
        press(&mut app, "\x1b");
        assert!(app.model.form.typing.is_none());
    }
    assert_eq!((force(&app), app.model.history.depth()), (300.0, (0, 0)));
    press(&mut app, "25\r");
    assert_eq!((force(&app), app.model.history.depth()), (25.0, (1, 0)));
    press(&mut app, "u.5\r");
    assert_eq!(force(&app), 0.5);
    // A force below nothing is explained; Enter takes none of it.
    press(&mut app, "-7\r");
    assert!(wrong(&app).contains("allowed"));
    press(&mut app, "\x1b\x1b[200~75\x1b[201~\r");
    assert_eq!(force(&app), 75.0);
}

#[test]
fn a_digit_never_leaves_the_form_and_switches_screens_elsewhere() {
    let mut app = app();
    let shape = row("impact.shape");
    for row in [FormRow::Preset, FormRow::Fold, shape] {
        app.model.form.selected = row;
        let before = app.model.work.clone();
        for digit in "0123456789".chars() {
            assert!(press(&mut app, &digit.to_string()).is_empty());
            assert!(app.screen == 0 && app.model.form.typing.is_none() && app.model.work == before);
        }
        press(&mut app, "4");
        assert!(notice(&app).ends_with("F4 or Alt-4 shows Compare"));
        press(&mut app, "\x1b[200~12\x1b[201~");
        assert_eq!(app.model.form.typing.is_some(), row == shape);
        press(&mut app, "\x1b");
    }
    press(&mut app, "\x1b3");
    assert_eq!(app.screen, 2);
    press(&mut app, "2");
    assert_eq!(app.screen, 1);
    press(&mut app, "1\t3");
    assert_eq!(app.screen, 2, "the dial takes no digits");
    press(&mut app, "\x1b[11~");
    assert_eq!(app.screen, 0);
}
