//! The app: the screens, which one is on show, and the model below them that they share.

pub mod actions;
pub(crate) mod chosen_keys;
pub mod frame;
mod help;
mod mouse;
pub mod tables;
#[cfg(test)]
mod tests;
pub mod update;

use std::any::Any;

use crate::tui::changes::{samples, simulation};
use crate::tui::model::{AppModel, Timed};
use crate::tui::screens::SCREENS;
use crate::tui::screens::screen::{About, PaneFacts, Screen};

/// Everything between two messages.
pub struct App {
    /// What the screens share.
    pub model: AppModel,
    /// The screens, each with what it keeps to itself, in the order of [`SCREENS`].
    pub screens: Vec<Box<dyn Screen>>,
    /// The place of the screen on show.
    pub screen: usize,
    /// Whether that wants to be told where the mouse is dragged.
    pub dragging: bool,
}

impl App {
    /// The screen on show.
    pub fn on_show(&self) -> &dyn Screen {
        self.screens[self.screen].as_ref()
    }

    /// Title, question and purpose of the screen on show.
    pub fn about(&self) -> &'static About {
        &SCREENS[self.screen]
    }

    /// The screen of a type with all that it keeps to itself; none but tests ask for it.
    ///
    /// # Panics
    /// Where there is no such screen.
    pub fn state<S: Screen>(&self) -> &S {
        let mut all = self.screens.iter();
        let found = all.find_map(|screen| (screen.as_ref() as &dyn Any).downcast_ref());
        found.expect("a screen of the list")
    }

    /// The pane with the focus.
    pub fn focus(&self) -> PaneFacts {
        let screen = self.on_show();
        screen.panes().swap_remove(screen.pane())
    }

    /// Gives the next pane the focus, or the one before.
    pub fn change_pane(&mut self, forward: bool) {
        let screen = &mut self.screens[self.screen];
        let count = screen.panes().len();
        let by = if forward { 1 } else { count - 1 };
        screen.show_pane((screen.pane() + by) % count);
    }

    /// Shows the screen of a place in the list.
    pub fn show(&mut self, place: usize) {
        self.model.form.complaint = None;
        self.screen = place;
    }

    /// The answer through whose time the clock goes, and the end of that time in s.
    pub fn timed(&self) -> Option<Timed<'_>> {
        self.on_show().timed(&self.model)
    }

    /// The time shown, in s.
    pub fn time(&self) -> f64 {
        self.model.clock.time_in(self.timed())
    }

    /// Has everybody ask for what is wanted now and stop what no longer is.
    pub fn refresh_requests(&mut self) {
        let model = &mut self.model;
        for (place, screen) in self.screens.iter_mut().enumerate() {
            screen.refresh_requests(model, place == self.screen);
        }
        let busy = self.screens.iter().any(|screen| screen.is_busy());
        samples::refresh_requests(model, self.screens[self.screen].samples(), busy);
        simulation::refresh_requests(model, busy);
    }
}
