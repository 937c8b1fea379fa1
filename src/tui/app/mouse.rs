//! What the mouse does, where it is listened to: it points at screens and at what they show.

use crossterm::event::{KeyModifiers, MouseButton, MouseEvent, MouseEventKind};
use ratatui::layout::Rect;

use crate::tui::app::frame::{body, tab_at};
use crate::tui::{app::App, app::actions::scroll, overlay::Overlay, screens::screen::Mouse};
use crate::tui::{step::Step, view::SMALLEST};

/// Takes in what the mouse did on a screen of `size`.
pub(super) fn handle(app: &mut App, event: MouseEvent, size: (u16, u16)) {
    let at = (event.column, event.row);
    // What is typed or asked wants an answer by key first.
    let busy = app.model.overlay.is_some() || app.model.form.typing.is_some();
    match event.kind {
        MouseEventKind::Up(_) => app.dragging = false,
        MouseEventKind::ScrollUp | MouseEventKind::ScrollDown => {
            let up = event.kind == MouseEventKind::ScrollUp;
            let coarse = event.modifiers.contains(KeyModifiers::SHIFT);
            if let Some(Overlay::Help(_) | Overlay::Picker(_)) = app.model.overlay {
                scroll(app, if up { -1 } else { 1 });
            } else if !busy {
                app.model.notice = None;
                send_to_screen(app, Mouse::Wheel(at, Step { up, coarse }), size);
            }
        }
        MouseEventKind::Drag(MouseButton::Left) if app.dragging => {
            send_to_screen(app, Mouse::Drag(at), size);
        }
        MouseEventKind::Down(MouseButton::Left) if !busy => {
            app.model.notice = None;
            match tab_at(app, size, at) {
                Some(place) => app.show(place),
                None => app.dragging = send_to_screen(app, Mouse::Press(at), size),
            }
        }
        _ => {}
    }
}

/// Tells the screen, where there is room to draw it; whether it wants to be told of drags.
fn send_to_screen(app: &mut App, mouse: Mouse, (width, height): (u16, u16)) -> bool {
    let drawn = width >= SMALLEST.0 && height >= SMALLEST.1;
    let body = body(Rect::new(0, 0, width, height));
    drawn && app.screens[app.screen].mouse(&mut app.model, mouse, body)
}
