//! What lies under a point of the screen.

use ratatui::layout::Rect;

use super::{body, eye, tabs};
use crate::tui::form::Row;
use crate::tui::model::Model;
use crate::tui::screens::Screen;
use crate::tui::screens::compare::view as compare;
use crate::tui::screens::main::{form, view as main};

/// What can be pointed at.
#[derive(Clone, Copy, PartialEq)]
pub enum Spot {
    /// The name of a screen.
    Screen(Screen),
    /// A row of the form.
    Row(Row),
    /// The form, but none of its rows.
    Form,
    /// The eye that the blow can be turned on.
    Dial,
    /// The name of a pane of the comparison.
    Pane(usize),
    /// A row in the list of presets to be compared.
    Marked(usize),
    /// Anything else.
    Other,
}

/// What lies at a cell of a screen of this size.
pub fn spot(model: &Model, (width, height): (u16, u16), (x, y): (u16, u16)) -> Spot {
    if width < super::SMALLEST.0 || height < super::SMALLEST.1 {
        return Spot::Other;
    }
    if y == 0 {
        let tabs = tabs(model, width);
        let tab = tabs.iter().rev().find(|(at, ..)| x >= *at);
        let inside = tab.filter(|(at, label, _)| x < at + super::text::width(label));
        return inside.map_or(Spot::Other, |(.., screen)| Spot::Screen(*screen));
    }
    let area = body(Rect::new(0, 0, width, height));
    match model.screen {
        Screen::Main => {
            let parts = main::layout(area);
            if parts.form.contains((x, y).into()) {
                let rows = form::visible(model, parts.form);
                let row = rows.get(usize::from(y - parts.form.y));
                row.map_or(Spot::Form, |row| Spot::Row(*row))
            } else if parts.eye.contains((x, y).into()) {
                Spot::Dial
            } else {
                Spot::Other
            }
        }
        Screen::Compare if y == area.y => {
            let headings = compare::headings(model);
            let under =
                |(at, name): &(u16, String)| (*at..at + super::text::width(name)).contains(&x);
            let pane = headings.iter().position(under);
            pane.map_or(Spot::Other, Spot::Pane)
        }
        Screen::Compare if model.pane() == 0 && x < 30.min(width / 2) => {
            let row = compare::first_listed(model, area.height - 1) + usize::from(y - area.y - 1);
            if row <= model.choices.len() {
                Spot::Marked(row)
            } else {
                Spot::Other
            }
        }
        _ => Spot::Other,
    }
}

/// The angle in degrees of a blow that comes from the direction of a cell.
pub fn angle(model: &Model, (width, height): (u16, u16), at: (u16, u16)) -> Option<f64> {
    if width < super::SMALLEST.0 || height < super::SMALLEST.1 {
        return None;
    }
    let area = body(Rect::new(0, 0, width, height));
    let picture = main::layout(area).eye;
    Some(eye::angle_at(picture, model.look.symbols, at).to_degrees())
}
