//! One result over two inputs: filled in from coarse to fine while it is on show.

pub mod state;
mod view;

use crate::tui::keys::press::{
    DOWN, ENTER, LEFT, RIGHT, SHIFT_DOWN, SHIFT_LEFT, SHIFT_RIGHT, SHIFT_UP, UP, c,
};
use crate::tui::screens::screen::{Pane, PaneKeys, Panes, Screen, bind, follow, go_on};
use crate::tui::{changes::edit::change, form::words, keys::TimeKeys};
use crate::tui::{model::AppModel, request::Report, step::Step, view::sheet::Sheet};
use state::{DrawMap, Map};

impl Panes for Map {
    const PANES: &'static [Pane<Self>] =
        &[Pane::new("map", TimeKeys::Absent, &[KEYS, STOPPED_KEYS])];
}

#[rustfmt::skip]
const KEYS: PaneKeys<Map> = PaneKeys::new("Map", &[
    bind(&[LEFT, c('h')], |s, _| s.move_cursor(Step::LESS, true), "cursor", "the cursor to the left"),
    bind(&[RIGHT, c('l')], |s, _| s.move_cursor(Step::MORE, true), "&", "the cursor to the right"),
    bind(&[UP, c('k')], |s, _| s.move_cursor(Step::MORE, false), "&", "the cursor up"),
    bind(&[DOWN, c('j')], |s, _| s.move_cursor(Step::LESS, false), "&", "the cursor down"),
    bind(&[SHIFT_LEFT, c('H')], |s, _| s.move_cursor(Step::MUCH_LESS, true), "", "the cursor far to the left"),
    bind(&[SHIFT_RIGHT, c('L')], |s, _| s.move_cursor(Step::MUCH_MORE, true), "", "the cursor far to the right"),
    bind(&[SHIFT_UP, c('K')], |s, _| s.move_cursor(Step::MUCH_MORE, false), "", "the cursor far up"),
    bind(&[SHIFT_DOWN, c('J')], |s, _| s.move_cursor(Step::MUCH_LESS, false), "", "the cursor far down"),
    bind(&[ENTER], adopt, "use them", "give the scenario the values under the cursor"),
    bind(&[c('x')], |s, m| s.turn(&m.work.scenario, true), "across", "the next input across"),
    bind(&[c('X')], |s, m| s.turn(&m.work.scenario, false), "up", "the next input up"),
    bind(&[c('+'), c('=')], |s, m| s.zoom(&m.work.scenario, true), "range", "wider ranges"),
    bind(&[c('-')], |s, m| s.zoom(&m.work.scenario, false), "&", "narrower ranges"),
    bind(&[c('v')], |s, m| s.next_result(&m.work.scenario), "result", "the next result that the scene has"),
]);

const STOPPED_KEYS: PaneKeys<Map> =
    PaneKeys::<Map>::new("Map: stopped", &[go_on(|s, _| s.task.complaint = None)])
        .when(|map, _| map.task.complaint.is_some());

impl Screen for Map {
    fn draw(&self, model: &AppModel, sheet: &mut Sheet) {
        view::draw(self, model, sheet);
    }

    /// While the screen is on show, computes what is missing; stops what is not wanted.
    fn refresh_requests(&mut self, model: &mut AppModel, on_show: bool) {
        let mut wanted = None;
        if on_show {
            self.settle(&model.work.scenario);
            // What Esc stopped goes on by a key alone.
            if self.task.complaint.is_none() {
                wanted = self.lacking(&model.work.scenario);
            }
        }
        let same = |a: &DrawMap, b: &DrawMap| (&a.scenario, a.spans) == (&b.scenario, b.spans);
        follow(&mut self.task, wanted, same, &mut model.out);
    }

    fn take_report(&mut self, _: &mut AppModel, report: &mut Option<Report>) {
        if let Some((question, Some(grid))) = self.task.take_report(report) {
            self.done = Some((question.scenario.clone(), question.spans, grid));
        }
    }

    fn is_busy(&self) -> bool {
        self.task.job.is_some()
    }

    fn cancel(&mut self, model: &mut AppModel) -> bool {
        self.task.stop(Some("stopped"), &mut model.out)
    }

    fn step(&mut self, _: &mut AppModel, step: Step) {
        self.move_cursor(step, true);
    }
}

/// Gives the scenario the values under the cursor, of the inputs over which it was moved.
fn adopt(map: &mut Map, model: &mut AppModel) {
    let Some((moved, scenario)) = map.adopted(&model.work.scenario) else {
        return;
    };
    if moved.is_empty() {
        let words = "the cursor stands on your values: the arrows move it";
        return model.notice = Some(words.to_owned());
    }
    if let Err(error) = scenario.check() {
        return model.notice = Some(words(&error));
    }
    change(model, model.work.with(scenario), "");
    if model.notice.is_none() {
        let parts = moved.iter().map(|(span, value)| view::named(*span, &value.to_string()));
        let parts: Vec<String> = parts.collect();
        model.notice = Some(format!("now {}; u takes it back", parts.join(", ")));
    }
}
