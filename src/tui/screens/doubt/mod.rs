//! What the doubt in the inputs does to each result: runs many samples while it is on show.

mod view;

use crate::tui::{ensemble::MANY, keys::TimeKeys, model::AppModel, view::sheet::Sheet};

use crate::tui::keys::press::{DOWN, UP, c};
use crate::tui::screens::screen::{About, Pane, PaneKeys, Panes, Screen, bind};

pub(super) const ABOUT: About = About {
    title: "Doubt",
    question: "How sure?",
    purpose: "what the doubt in the inputs does",
    new: || Box::new(Doubt::default()),
};

/// The place of the result whose band is explained.
#[derive(Default)]
pub struct Doubt {
    pub(crate) row: usize,
}

impl Panes for Doubt {
    const PANES: &'static [Pane<Self>] =
        &[Pane::new("outputs", TimeKeys::Absent, &[KEYS, STOPPED_KEYS])];
}

#[rustfmt::skip]
const KEYS: PaneKeys<Doubt> = PaneKeys::new("Doubt", &[
    bind(&[UP, c('k')], |s, m| s.move_cursor(m, -1), "result", "the result above"),
    bind(&[DOWN, c('j')], |s, m| s.move_cursor(m, 1), "&", "the result below"),
]);

/// Once Esc has stopped it.
const STOPPED_KEYS: PaneKeys<Doubt> = PaneKeys::when(
    |_, model| model.ensemble.complaint(&model.work.scenario).is_some(),
    "Doubt: stopped",
    &[bind(
        &[c('m')],
        |_, m| m.ensemble.task.complaint = None,
        "go on",
        "go on where Esc stopped it",
    )],
);

impl Screen for Doubt {
    fn draw(&self, model: &AppModel, sheet: &mut Sheet) {
        view::draw(self.row, model, sheet);
    }

    fn samples(&self) -> u32 {
        MANY
    }

    fn cancel(&mut self, model: &mut AppModel) -> bool {
        model.ensemble.task.end(&mut model.out)
    }
}

impl Doubt {
    /// Moves to another result.
    fn move_cursor(&mut self, model: &AppModel, by: isize) {
        let Some(ensemble) = model.ensemble.of(&model.work.scenario) else {
            return;
        };
        let last = ensemble.results().len().saturating_sub(1);
        self.row = self.row.min(last).saturating_add_signed(by).min(last);
    }
}
