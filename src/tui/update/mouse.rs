//! What the mouse does, where it is listened to: points, turns the blow, and steps by its wheel.

use crossterm::event::{KeyModifiers, MouseButton, MouseEvent, MouseEventKind};

use super::{Effect, act, change, enter, go, nudge, step_time};
use crate::scenario::fields;
use crate::tui::action::{Action, Step};
use crate::tui::form::{Row, with_text};
use crate::tui::keys::Context;
use crate::tui::model::{Model, Overlay};
use crate::tui::screens::Screen;
use crate::tui::view::hit::{Spot, angle, spot};

const FORM: usize = 0;
const DIAL: usize = 1;

/// Takes in what the mouse did on a screen of `size`.
pub(super) fn hear(
    model: &mut Model,
    event: MouseEvent,
    size: (u16, u16),
    effects: &mut Vec<Effect>,
) {
    let at = (event.column, event.row);
    match event.kind {
        // What is typed or asked wants an answer by key first.
        MouseEventKind::Down(_) if model.overlay.is_some() || model.form.typing.is_some() => {}
        MouseEventKind::Down(MouseButton::Left) => {
            model.notice = None;
            press(model, at, size, effects);
        }
        MouseEventKind::Drag(MouseButton::Left) if model.aiming => aim(model, at, size, effects),
        MouseEventKind::Up(_) => model.aiming = false,
        MouseEventKind::ScrollUp | MouseEventKind::ScrollDown => {
            let down = event.kind == MouseEventKind::ScrollDown;
            let coarse = event.modifiers.contains(KeyModifiers::SHIFT);
            wheel(model, (down, coarse), spot(model, size, at), effects);
        }
        _ => {}
    }
}

fn press(model: &mut Model, at: (u16, u16), size: (u16, u16), effects: &mut Vec<Effect>) {
    match spot(model, size, at) {
        Spot::Screen(screen) => act(model, Action::Show(screen), effects),
        Spot::Row(row) => {
            let again = model.pane() == FORM && model.form.selected == row;
            model.show_pane(FORM);
            model.form.complaint = None;
            model.form.selected = row;
            // The line that folds is a button; any other row is chosen first.
            if again || row == Row::Fold {
                enter(model, effects);
            }
        }
        Spot::Form => model.show_pane(FORM),
        Spot::Dial => {
            model.show_pane(DIAL);
            model.aiming = true;
            aim(model, at, size, effects);
        }
        Spot::Pane(pane) => model.show_pane(pane),
        Spot::Marked(row) => {
            let again = model.compare.row == row;
            model.compare.row = row;
            if again {
                act(model, Action::Mark, effects);
            }
        }
        Spot::Other => {}
    }
}

/// Turns the blow to where the mouse is, by whole degrees.
fn aim(model: &mut Model, at: (u16, u16), size: (u16, u16), effects: &mut Vec<Effect>) {
    let path = "impact.angle_deg";
    let (Some(field), Some(angle)) = (fields::find(path), angle(model, size, at)) else {
        return;
    };
    // Minus zero would be written with its sign.
    let text = (angle.round() + 0.0).to_string();
    model.form.complaint = None;
    match with_text(&model.work.scenario, field, &text) {
        Ok(scenario) => {
            let work = model.work.with(scenario);
            change(model, work, path, effects);
        }
        Err(why) => model.form.complaint = Some(why),
    }
}

/// Up is more of a value and backwards in a list and in time.
fn wheel(model: &mut Model, (down, coarse): (bool, bool), spot: Spot, effects: &mut Vec<Effect>) {
    let step = |up| Step { up, coarse };
    let by = if down { 1 } else { -1 };
    match &model.overlay {
        Some(Overlay::Help(_) | Overlay::Picker(_)) => return go(model, by),
        Some(_) => return,
        None if model.form.typing.is_some() => return,
        None => {}
    }
    model.notice = None;
    match (spot, model.context()) {
        (Spot::Row(row), _) if row == model.form.selected => {
            if let Row::Field(field) = row {
                model.form.complaint = None;
                nudge(model, field.path, step(!down), effects);
            }
        }
        (Spot::Row(_) | Spot::Form, _) => {
            model.form.go(&model.work.scenario, isize::from(by));
        }
        (_, Context::Marks) => go(model, by),
        _ if model.screen == Screen::Main => step_time(model, step(down)),
        _ => act(model, Action::Step(step(down)), effects),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::Impact;
    use crate::tui::update::driven::begun;
    use crate::tui::update::{Message, update};
    use MouseButton::Left;
    use MouseEventKind::{Down, Drag, ScrollDown, ScrollUp, Up};

    const SIZE: (u16, u16) = (80, 24);

    fn model() -> Model {
        let mut model = begun();
        model.form.selected = Row::Field(fields::find("impact.force_n").unwrap());
        model
    }

    fn does(model: &mut Model, kind: MouseEventKind, at: (u16, u16)) -> Vec<Effect> {
        let event = MouseEvent {
            kind,
            column: at.0,
            row: at.1,
            modifiers: KeyModifiers::NONE,
        };
        update(model, Message::Mouse(event, SIZE))
    }

    fn blow(model: &Model) -> (f64, f64) {
        let Impact::ForcePulse(pulse) = &model.work.scenario.impact else {
            panic!("no pulse")
        };
        (pulse.force_n, pulse.angle_deg)
    }

    /// The middle of the eye at 80 by 24 is near here; the front is to its left.
    const MIDDLE: (u16, u16) = (43, 8);

    #[test]
    fn dragging_on_the_eye_turns_the_blow_until_the_button_is_released() {
        let mut model = model();
        assert_eq!(
            does(&mut model, Drag(Left), MIDDLE),
            [],
            "no button went down there"
        );
        does(&mut model, Down(Left), (MIDDLE.0 - 8, MIDDLE.1));
        assert_eq!(model.context(), Context::Dial);
        assert!(blow(&model).1.abs() < 8.0, "{}", blow(&model).1);
        let effects = does(&mut model, Drag(Left), (MIDDLE.0 - 8, MIDDLE.1 - 2));
        assert!(matches!(effects[..], [Effect::Solve(..)]));
        let angle = blow(&model).1;
        assert!(
            (15.0..45.0).contains(&angle) && angle == angle.round(),
            "{angle}"
        );
        // Bone is in the way: that is explained, and the last angle stays.
        does(&mut model, Drag(Left), (MIDDLE.0 + 8, MIDDLE.1));
        assert_eq!(blow(&model).1, angle);
        assert!(model.form.complaint.is_some());
        does(&mut model, Up(Left), MIDDLE);
        assert_eq!(does(&mut model, Drag(Left), (MIDDLE.0 - 8, MIDDLE.1)), []);
        assert_eq!(model.history.depth().0, 1, "one drag is one change");
    }

    #[test]
    fn a_click_chooses_a_row_and_another_one_opens_it() {
        let mut model = model();
        does(&mut model, Down(Left), (5, 5));
        let Row::Field(field) = model.form.selected else {
            panic!()
        };
        assert_eq!(field.path, "impact.duration_ms");
        does(&mut model, Down(Left), (5, 5));
        assert!(model.form.typing.is_some());
        // A click elsewhere waits for the answer.
        does(&mut model, Down(Left), (5, 1));
        assert!(model.form.typing.is_some());
    }

    #[test]
    fn the_wheel_nudges_the_chosen_value_and_chooses_beside_it() {
        let mut model = model();
        does(&mut model, ScrollUp, (5, 4));
        assert_eq!(blow(&model).0, 310.0);
        does(&mut model, ScrollDown, (5, 4));
        assert_eq!(blow(&model).0, 300.0);
        does(&mut model, ScrollDown, (5, 8));
        assert_eq!(blow(&model).0, 300.0);
        assert!(matches!(model.form.selected, Row::Field(f) if f.path == "impact.duration_ms"));
    }

    #[test]
    fn a_click_on_its_name_shows_a_screen_or_a_pane() {
        let mut model = model();
        let title = crate::tui::view::tabs(&model, SIZE.0);
        for (at, _, screen) in title {
            does(&mut model, Down(Left), (at + 1, 0));
            assert_eq!(model.screen, screen);
            model.screen = Screen::Main;
        }
        model.screen = Screen::Compare;
        does(&mut model, Down(Left), (12, 1));
        assert_eq!(model.pane(), 1);
        does(&mut model, Down(Left), (2, 1));
        does(&mut model, Down(Left), (8, 4));
        assert_eq!((model.pane(), model.compare.row), (0, 2));
        assert!(model.compare.entries.is_empty());
        does(&mut model, Down(Left), (8, 4));
        assert_eq!(model.compare.entries.len(), 1);
    }
}
