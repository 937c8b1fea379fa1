//! The screen that answers the question at the bedside: form, eye, traces, score.

pub mod form;
mod pulse;
mod score;
mod traces;
mod view;

use ratatui::layout::Rect;
use std::iter::successors;
use std::mem::discriminant;

use crate::scenario::{Scenario, direction::HOURS, fields, fields::Field};
use crate::tui::changes::{presets, threshold, typing};
use crate::tui::form::{FormRow, allowed, chosen, nudged, with_text};
use crate::tui::keys::press::{DOWN, ENTER, LEFT, Press, RIGHT, UP, c};
use crate::tui::keys::press::{SHIFT_DOWN, SHIFT_LEFT, SHIFT_RIGHT, SHIFT_UP};
use crate::tui::keys::{Binding, TimeKeys};
use crate::tui::screens::screen::{Act, Mouse, Pane, PaneKeys, Panes, Screen, bind};
use crate::tui::{changes::edit::change, ensemble::FEW};
use crate::tui::{model::AppModel, step::Step, view::eye, view::sheet::Sheet};
use form::{DIAL, FORM};

/// What the screen answers.
pub(super) const QUESTION: &str = "How bad?";
/// Small steps in place of a large one, at most.
const MAX_SMALL_STEPS: usize = 20;
const ANGLE: &str = "impact.angle_deg";
const HOUR: &str = "impact.angle_clock";
const HALF_WIDTH: &str = "impact.half_width_deg";

/// The place of the pane with the focus, and what is drawn over time.
#[derive(Default)]
pub struct Main {
    pane: usize,
    /// Whether the curves are those of node forces.
    nodes: bool,
    /// Whether the dial shows the eye from the front, where it can be seen from there.
    front: bool,
}

impl Panes for Main {
    const PANES: &'static [Pane<Self>] = &[
        Pane::new("form", TimeKeys::Late, &[NUMBER_KEYS, OTHER_KEYS, FORM_KEYS]),
        Pane::new("dial", TimeKeys::Late, &[DIAL_KEYS, HOUR_KEYS, ARC_KEYS]),
    ];
}

#[rustfmt::skip]
const NUMERALS: &[Press] = &[
    c('0'), c('1'), c('2'), c('3'), c('4'), c('5'), c('6'), c('7'), c('8'), c('9'), c('-'), c('.'),
];

/// Digits where each begins a value, or would.
const fn typed(
    presses: &'static [Press],
    short: &'static str,
    help: &'static str,
) -> Binding<Act<Main>> {
    let mut binding = bind(presses, |_, _| {}, short, help);
    binding.key.begins_value = true;
    binding
}

const NUMBER_KEYS: PaneKeys<Main> =
    PaneKeys::new("Form: a number", &[typed(NUMERALS, "type", "begin to type a value")])
        .when(|_, model| model.form.takes_numbers());

/// A digit never leaves the form: whoever types one means a value.
const OTHER_KEYS: PaneKeys<Main> =
    PaneKeys::new("Form: another row", &[NO_VALUE]).when(|_, model| !model.form.takes_numbers());

const NO_VALUE: Binding<Act<Main>> =
    typed(NUMERALS.split_at(10).0, "", "nothing: F2 or Alt-2 shows a screen");

#[rustfmt::skip]
const FORM_KEYS: PaneKeys<Main> = PaneKeys::new("Form", &[
    bind(&[UP, c('k')], |_, m| m.form.move_cursor(&m.work.scenario, -1), "field", "the field above"),
    bind(&[DOWN, c('j')], |_, m| m.form.move_cursor(&m.work.scenario, 1), "&", "the field below"),
    bind(&[LEFT, c('h')], |_, m| step(m, Step::LESS), "value", "a small step down"),
    bind(&[RIGHT, c('l')], |_, m| step(m, Step::MORE), "&", "a small step up"),
    bind(&[SHIFT_LEFT, c('H')], |_, m| step(m, Step::MUCH_LESS), "", "a large step down"),
    bind(&[SHIFT_RIGHT, c('L')], |_, m| step(m, Step::MUCH_MORE), "", "a large step up"),
    bind(&[ENTER], |_, m| enter(m), "edit", "edit the value, take the next choice, open the list, unfold"),
    bind(&[c('t')], |_, m| threshold::ask(m), "threshold", "at which value of it a result reaches what you ask"),
    NODES,
    bind(&[c('a')], |_, m| m.form.fold(&m.work.scenario), "", "show or hide the advanced fields"),
]);

#[rustfmt::skip]
const DIAL_KEYS: PaneKeys<Main> = PaneKeys::new("Dial", &[
    bind(&[UP, c('k')], |_, m| turn(m, Step::MORE), "turn", "turn the blow up"),
    bind(&[DOWN, c('j')], |_, m| turn(m, Step::LESS), "&", "turn the blow down"),
    bind(&[SHIFT_UP, c('K')], |_, m| turn(m, Step::MUCH_MORE), "", "turn it up by a large step"),
    bind(&[SHIFT_DOWN, c('J')], |_, m| turn(m, Step::MUCH_LESS), "", "turn it down by a large step"),
    bind(&[c('f')], Main::look_from_front, "front", "the eye from the front, or cut"),
]);

/// An object acts on no arc of its own; where it comes from is an hour as well.
#[rustfmt::skip]
const HOUR_KEYS: PaneKeys<Main> = PaneKeys::new("Dial: an object", &[
    bind(&[LEFT, c('h')], |_, m| turn_clock(m, Step::LESS), "hour", "to an earlier hour"),
    bind(&[RIGHT, c('l')], |_, m| turn_clock(m, Step::MORE), "&", "to a later hour"),
    bind(&[SHIFT_RIGHT, c('L')], |_, m| turn_clock(m, Step::MUCH_MORE), "", "later by a large step"),
    bind(&[SHIFT_LEFT, c('H')], |_, m| turn_clock(m, Step::MUCH_LESS), "", "earlier by a large step"),
]).when(|_, model| model.work.scenario.projectile().is_some());

#[rustfmt::skip]
const ARC_KEYS: PaneKeys<Main> = PaneKeys::new("Dial: a force", &[
    bind(&[LEFT, c('h')], |_, m| nudge(m, HALF_WIDTH, Step::LESS), "width", "narrow the loaded arc"),
    bind(&[RIGHT, c('l')], |_, m| nudge(m, HALF_WIDTH, Step::MORE), "&", "widen the loaded arc"),
    bind(&[SHIFT_RIGHT, c('L')], |_, m| nudge(m, HALF_WIDTH, Step::MUCH_MORE), "", "widen it by a large step"),
    bind(&[SHIFT_LEFT, c('H')], |_, m| nudge(m, HALF_WIDTH, Step::MUCH_LESS), "", "narrow it by a large step"),
]).when(|_, model| model.work.scenario.projectile().is_none());

const NODES: Binding<Act<Main>> = bind(
    &[c('f')],
    |s, _| s.nodes = !s.nodes,
    "",
    "forces of the paper's nodes over time, or what the eye feels",
);

/// Changes what the row with the cursor holds.
fn step(model: &mut AppModel, step: Step) {
    match model.form.selected {
        FormRow::Preset => presets::next_preset(model, step.up),
        FormRow::Fold => model.form.fold(&model.work.scenario),
        FormRow::Field(field) => nudge(model, field.path, step),
    }
}

/// Opens the row with the cursor.
fn enter(model: &mut AppModel) {
    match model.form.selected {
        FormRow::Preset => presets::open_picker(model),
        FormRow::Fold => model.form.fold(&model.work.scenario),
        // There is nothing to type where there are a few names to choose from.
        FormRow::Field(field) if chosen(field, &model.work.scenario).is_some() => {
            nudge(model, field.path, Step::MORE);
        }
        FormRow::Field(_) => typing::begin(model, false),
    }
}

/// Turns the blow about the eye as it is drawn: an object from below comes up by a smaller angle.
fn turn(model: &mut AppModel, step: Step) {
    let up = model.work.scenario.comes_from_top();
    nudge(model, ANGLE, if up { step } else { step.reversed() });
}

/// Takes a later hour, or an earlier one: 12 is 0.
fn turn_clock(model: &mut AppModel, step: Step) {
    let Some(field) = fields::find(HOUR) else { return };
    let mut scenario = model.work.scenario.clone();
    let Some(object) = scenario.projectile_mut() else { return };
    let end = if step.up { HOURS } else { 0.0 };
    if object.angle_clock == end {
        object.angle_clock = HOURS - end;
    }
    take(model, HOUR, nudged(&scenario, field, step, None));
}

fn nudge(model: &mut AppModel, path: &'static str, step: Step) {
    let Some(field) = fields::find(path) else { return };
    let present = model.shown.as_ref().map(|shown| match path {
        "window_ms" => shown.answer.window() * 1e3,
        _ => shown.answer.plan.step * 1e6,
    });
    match furthest(&model.work.scenario, field, step, present) {
        Ok(scenario) if scenario == model.work.scenario => {
            model.notice =
                Some(format!("{}: {}", field.label, allowed(&model.work.scenario, field)));
        }
        outcome => take(model, path, outcome),
    }
}

/// Takes another value of a field, or says why it may not be there.
fn take(model: &mut AppModel, path: &'static str, outcome: Result<Scenario, String>) {
    let scenario = match outcome {
        Ok(scenario) => scenario,
        Err(why) => return model.form.complaint = Some(why),
    };
    let another_model = discriminant(&scenario.model) != discriminant(&model.work.scenario.model);
    change(model, model.work.with(scenario), path);
    if path == "impact" && another_model {
        model.notice = Some("objects need the Physiological model: it is taken now".to_owned());
    }
}

/// The scenario one step further; where a rule forbids a large one, as many small ones as it lets.
fn furthest(
    scenario: &Scenario,
    field: &Field,
    step: Step,
    present: Option<f64>,
) -> Result<Scenario, String> {
    let whole = nudged(scenario, field, step, present);
    if whole.is_ok() || !step.coarse {
        return whole;
    }
    let small = Step { coarse: false, ..step };
    let further = |reached: &Scenario| nudged(reached, field, small, present).ok();
    let steps = successors(further(scenario), further).take(MAX_SMALL_STEPS);
    steps.last().map_or(whole, Ok)
}

impl Screen for Main {
    fn draw(&self, model: &AppModel, sheet: &mut Sheet) {
        view::draw((self.pane, self.nodes, self.front), model, sheet);
    }

    fn pane(&self) -> usize {
        self.pane
    }

    fn show_pane(&mut self, pane: usize) {
        self.pane = pane;
    }

    fn samples(&self) -> u32 {
        FEW
    }

    /// Points at rows, turns the blow on the eye, and goes through rows or time by the wheel.
    fn mouse(&mut self, model: &mut AppModel, mouse: Mouse, area: Rect) -> bool {
        let parts = view::layout(area, model);
        let (Mouse::Press(at) | Mouse::Drag(at) | Mouse::Wheel(at, _)) = mouse;
        let in_form = parts.form.contains(at.into());
        match mouse {
            Mouse::Press(_) if in_form => {
                let rows = form::visible(model, self.pane, parts.form);
                self.press_row(model, rows.get(usize::from(at.1 - parts.form.y)).copied());
            }
            Mouse::Press(_) if parts.eye.contains(at.into()) => {
                self.pane = DIAL;
                if !self.front {
                    aim(model, at, parts.eye);
                }
                return !self.front;
            }
            Mouse::Press(_) => {}
            Mouse::Drag(_) => aim(model, at, parts.eye),
            // Up is more of a value, and backwards in a list and in time.
            Mouse::Wheel(_, by) => {
                model.form.complaint = None;
                if in_form {
                    // A wheel that scrolls must not change what it passes over.
                    model.form.move_cursor(&model.work.scenario, if by.up { -1 } else { 1 });
                } else {
                    self.step(model, by.reversed());
                }
            }
        }
        false
    }
}

impl Main {
    /// Shows the eye from the front or cut.
    fn look_from_front(&mut self, model: &mut AppModel) {
        self.front = !self.front && model.can_face_front();
    }

    /// Chooses a row of the form, or opens the one that is chosen already.
    fn press_row(&mut self, model: &mut AppModel, row: Option<FormRow>) {
        let again = self.pane == FORM && Some(model.form.selected) == row;
        self.pane = FORM;
        let Some(row) = row else { return };
        model.form.complaint = None;
        model.form.selected = row;
        // The line that folds is a button; any other row is chosen first.
        if again || row == FormRow::Fold {
            enter(model);
        }
    }
}

/// Turns the blow to where the mouse is, by whole degrees.
fn aim(model: &mut AppModel, at: (u16, u16), picture: Rect) {
    let (Some(field), Some(shown)) = (fields::find(ANGLE), &model.shown) else {
        return;
    };
    let detail = model.clock.detail(shown.drawing.object.is_some());
    let drawn = view::drawn_in(picture, detail);
    let drawn_at = eye::angle_at(drawn, model, shown, at).to_degrees();
    let angle = if model.work.scenario.comes_from_top() { drawn_at } else { -drawn_at };
    // Minus zero would be written with its sign.
    let text = (angle.round() + 0.0).to_string();
    model.form.complaint = None;
    take(model, ANGLE, with_text(&model.work.scenario, field, &text));
}
