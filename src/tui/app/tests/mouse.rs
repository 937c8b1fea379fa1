//! What the mouse does.

use super::*;
use MouseButton::Left;
use MouseEventKind::{Down, Drag, ScrollDown, ScrollUp, Up};
use crossterm::event::{MouseButton, MouseEvent, MouseEventKind};

const SIZE: (u16, u16) = (80, 24);

fn does(app: &mut App, kind: MouseEventKind, at: (u16, u16)) -> Vec<Effect> {
    let event = MouseEvent { kind, column: at.0, row: at.1, modifiers: KeyModifiers::NONE };
    update(app, Message::Mouse(event, SIZE))
}

fn blow(app: &App) -> (f64, f64) {
    (pulse(app).force_n, pulse(app).angle_deg)
}

/// The middle of the eye at 80 by 24 is near here; the front is to its left.
const MIDDLE: (u16, u16) = (45, 16);

#[test]
fn dragging_on_the_eye_turns_the_blow_until_the_button_is_released() {
    let mut app = answered();
    let effects = does(&mut app, Drag(Left), MIDDLE);
    assert_eq!(effects, [], "no button went down there");
    does(&mut app, Down(Left), (MIDDLE.0 - 8, MIDDLE.1));
    assert_eq!(app.focus().name, "dial");
    assert!(blow(&app).1.abs() < 12.0, "{}", blow(&app).1);
    assert!(asked::<Simulate>(&does(&mut app, Drag(Left), (MIDDLE.0 - 8, MIDDLE.1 - 2))).is_some());
    let angle = blow(&app).1;
    assert!((15.0..45.0).contains(&angle), "{angle}");
    assert_eq!(angle, angle.round());
    // Bone is in the way: that is explained, and the last angle stays.
    does(&mut app, Drag(Left), (MIDDLE.0 + 8, MIDDLE.1));
    assert_eq!(blow(&app).1, angle);
    assert!(app.model.form.complaint.is_some());
    does(&mut app, Up(Left), MIDDLE);
    assert_eq!(does(&mut app, Drag(Left), (MIDDLE.0 - 8, MIDDLE.1)), []);
    assert_eq!(app.model.history.depth().0, 1, "one drag is one change");
}

#[test]
fn a_click_chooses_a_row_and_another_one_opens_it() {
    let mut app = app();
    does(&mut app, Down(Left), (5, 5));
    assert!(app.model.form.selected == row("impact.duration_ms"));
    does(&mut app, Down(Left), (5, 5));
    assert!(app.model.form.typing.is_some());
    // A click elsewhere waits for the answer.
    does(&mut app, Down(Left), (5, 1));
    assert!(app.model.form.typing.is_some());
}

#[test]
fn the_wheel_goes_through_the_rows_of_the_form_and_changes_none() {
    let mut app = app();
    let before = app.model.work.clone();
    for _ in 0..30 {
        does(&mut app, ScrollDown, (5, 4));
    }
    assert!(app.model.form.selected == FormRow::Fold);
    for _ in 0..30 {
        does(&mut app, ScrollUp, (5, 4));
    }
    assert!(app.model.form.selected == FormRow::Preset && app.model.work == before);
}

#[test]
fn a_click_on_its_name_shows_a_screen_or_a_pane() {
    let mut app = app();
    for (place, (at, label)) in tabs(&app, SIZE.0).into_iter().enumerate() {
        does(&mut app, Down(Left), (at + 1, 0));
        assert_eq!(app.screen, place);
        if label.contains("Compare") {
            break;
        }
        app.screen = 0;
    }
    does(&mut app, Down(Left), (12, 1));
    assert_eq!(app.on_show().pane(), 1);
    does(&mut app, Down(Left), (2, 1));
    does(&mut app, Down(Left), (8, 4));
    assert_eq!((app.on_show().pane(), app.state::<Comparison>().row), (0, 2));
    assert!(app.state::<Comparison>().entries.is_empty());
    does(&mut app, Down(Left), (8, 4));
    assert_eq!(app.state::<Comparison>().entries.len(), 1);
}
