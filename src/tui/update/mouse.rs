//! What the mouse does, where it is listened to: it points at screens and at what they show.

use crossterm::event::{KeyModifiers, MouseButton, MouseEvent, MouseEventKind};
use ratatui::layout::Rect;

use crate::tui::model::{Model, Overlay};
use crate::tui::screens::Mouse;
use crate::tui::step::Step;
use crate::tui::update::{scroll, show};
use crate::tui::view::{SMALLEST, body, tab_at};

/// Takes in what the mouse did on a screen of `size`.
pub(super) fn hear(model: &mut Model, event: MouseEvent, size: (u16, u16)) {
    let at = (event.column, event.row);
    // What is typed or asked wants an answer by key first.
    let busy = model.overlay.is_some() || model.form.typing.is_some();
    match event.kind {
        MouseEventKind::Up(_) => model.dragging = false,
        MouseEventKind::ScrollUp | MouseEventKind::ScrollDown => {
            let up = event.kind == MouseEventKind::ScrollUp;
            let coarse = event.modifiers.contains(KeyModifiers::SHIFT);
            match &model.overlay {
                Some(Overlay::Help(_) | Overlay::Picker(_)) => {
                    scroll(model, if up { -1 } else { 1 });
                }
                _ if busy => {}
                _ => {
                    model.notice = None;
                    tell(model, Mouse::Wheel(at, Step { up, coarse }), size);
                }
            }
        }
        MouseEventKind::Drag(MouseButton::Left) if model.dragging => {
            tell(model, Mouse::Drag(at), size);
        }
        MouseEventKind::Down(MouseButton::Left) if !busy => {
            model.notice = None;
            match tab_at(model, size, at) {
                Some(place) => show(model, place),
                None => model.dragging = tell(model, Mouse::Press(at), size),
            }
        }
        _ => {}
    }
}

/// Tells the screen, where there is room to draw it; whether it wants to be told of drags.
fn tell(model: &mut Model, mouse: Mouse, (width, height): (u16, u16)) -> bool {
    let drawn = width >= SMALLEST.0 && height >= SMALLEST.1;
    let screen = model.on_show();
    drawn && (screen.mouse)(model, mouse, body(Rect::new(0, 0, width, height)))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::{Impact, fields};
    use crate::tui::form::Row;
    use crate::tui::simulation::Simulate;
    use crate::tui::update::driven::{asked, begun};
    use crate::tui::update::{Effect, Message, update};
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
    const MIDDLE: (u16, u16) = (41, 7);

    #[test]
    fn dragging_on_the_eye_turns_the_blow_until_the_button_is_released() {
        let mut model = model();
        assert_eq!(
            does(&mut model, Drag(Left), MIDDLE),
            [],
            "no button went down there"
        );
        does(&mut model, Down(Left), (MIDDLE.0 - 8, MIDDLE.1));
        assert_eq!(model.focus().name, "dial");
        assert!(blow(&model).1.abs() < 8.0, "{}", blow(&model).1);
        let effects = does(&mut model, Drag(Left), (MIDDLE.0 - 8, MIDDLE.1 - 2));
        assert!(asked::<Simulate>(&effects).is_some());
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
    fn the_wheel_goes_through_the_rows_of_the_form_and_changes_none() {
        let mut model = model();
        let before = model.work.clone();
        for _ in 0..30 {
            does(&mut model, ScrollDown, (5, 4));
        }
        assert!(model.form.selected == Row::Fold);
        for _ in 0..30 {
            does(&mut model, ScrollUp, (5, 4));
        }
        assert!(model.form.selected == Row::Preset && model.work == before);
    }

    #[test]
    fn a_click_on_its_name_shows_a_screen_or_a_pane() {
        let mut model = model();
        let title = crate::tui::view::tabs(&model, SIZE.0);
        for (place, (at, label)) in title.into_iter().enumerate() {
            does(&mut model, Down(Left), (at + 1, 0));
            assert_eq!(model.screen, place);
            if label.contains("Compare") {
                break;
            }
            model.screen = 0;
        }
        does(&mut model, Down(Left), (12, 1));
        assert_eq!(model.pane(), 1);
        does(&mut model, Down(Left), (2, 1));
        does(&mut model, Down(Left), (8, 4));
        assert_eq!((model.pane(), model.screens.compare.row), (0, 2));
        assert!(model.screens.compare.entries.is_empty());
        does(&mut model, Down(Left), (8, 4));
        assert_eq!(model.screens.compare.entries.len(), 1);
    }
}
