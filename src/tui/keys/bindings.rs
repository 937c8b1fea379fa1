//! Every key of the app, once.

use crossterm::event::{KeyCode, KeyModifiers};

use super::{Binding, Context, Press};
use crate::tui::action::{Action, Step};
use crate::tui::screens::Screen;

const fn plain(code: KeyCode) -> Press {
    Press(code, KeyModifiers::NONE)
}
const fn c(c: char) -> Press {
    plain(KeyCode::Char(c))
}
const fn ctrl(c: char) -> Press {
    Press(KeyCode::Char(c), KeyModifiers::CONTROL)
}
const fn alt(c: char) -> Press {
    Press(KeyCode::Char(c), KeyModifiers::ALT)
}
const fn f(n: u8) -> Press {
    plain(KeyCode::F(n))
}
const fn shift(code: KeyCode) -> Press {
    Press(code, KeyModifiers::SHIFT)
}

const UP: Press = plain(KeyCode::Up);
const DOWN: Press = plain(KeyCode::Down);
const LEFT: Press = plain(KeyCode::Left);
const RIGHT: Press = plain(KeyCode::Right);
const ENTER: Press = plain(KeyCode::Enter);
const ESC: Press = plain(KeyCode::Esc);
const TAB: Press = plain(KeyCode::Tab);
const BACK_TAB: Press = plain(KeyCode::BackTab);
const HOME: Press = plain(KeyCode::Home);
const END: Press = plain(KeyCode::End);
const PAGE_UP: Press = plain(KeyCode::PageUp);
const PAGE_DOWN: Press = plain(KeyCode::PageDown);
const SHIFT_UP: Press = shift(KeyCode::Up);
const SHIFT_DOWN: Press = shift(KeyCode::Down);
const SHIFT_LEFT: Press = shift(KeyCode::Left);
const SHIFT_RIGHT: Press = shift(KeyCode::Right);

/// What a number may begin with.
#[rustfmt::skip]
const NUMERALS: &[Press] = &[
    c('0'), c('1'), c('2'), c('3'), c('4'), c('5'), c('6'), c('7'), c('8'), c('9'), c('-'), c('.'),
];

const fn bind(
    context: Context,
    presses: &'static [Press],
    action: Action,
    short: &'static str,
    help: &'static str,
) -> Binding {
    Binding {
        context,
        presses,
        action,
        short,
        help,
    }
}

use Context::{
    Accuracy, Clock, Dial, Doubt, Everywhere, Forces, Form, Help, Injury, Map, Marks, Number,
    Picker, Question, Replay, Replays, Table, Typing,
};

/// Every key. The footer takes its words in this order, as many as fit.
#[rustfmt::skip]
pub static BINDINGS: &[Binding] = &[
    bind(Number, NUMERALS, Action::Type, "type", "begin to type a value"),

    bind(Form, &[UP, c('k')], Action::Up, "field", "the field above"),
    bind(Form, &[DOWN, c('j')], Action::Down, "&", "the field below"),
    bind(Form, &[LEFT, c('h')], Action::Step(Step::LESS), "value", "a small step down"),
    bind(Form, &[RIGHT, c('l')], Action::Step(Step::MORE), "&", "a small step up"),
    bind(Form, &[SHIFT_LEFT, c('H')], Action::Step(Step::MUCH_LESS), "", "a large step down"),
    bind(Form, &[SHIFT_RIGHT, c('L')], Action::Step(Step::MUCH_MORE), "", "a large step up"),
    bind(Form, &[ENTER], Action::Enter, "edit", "edit the value, open the list, unfold"),
    bind(Form, &[c('a')], Action::Advanced, "", "show or hide the advanced fields"),

    bind(Dial, &[UP, c('k')], Action::Turn(Step::MORE), "turn", "turn the blow up"),
    bind(Dial, &[DOWN, c('j')], Action::Turn(Step::LESS), "&", "turn the blow down"),
    bind(Dial, &[SHIFT_UP, c('K')], Action::Turn(Step::MUCH_MORE), "", "turn it up by a large step"),
    bind(Dial, &[SHIFT_DOWN, c('J')], Action::Turn(Step::MUCH_LESS), "", "turn it down by a large step"),
    bind(Dial, &[LEFT, c('h')], Action::Widen(Step::LESS), "width", "narrow the loaded arc"),
    bind(Dial, &[RIGHT, c('l')], Action::Widen(Step::MORE), "&", "widen the loaded arc"),
    bind(Dial, &[SHIFT_RIGHT, c('L')], Action::Widen(Step::MUCH_MORE), "", "widen it by a large step"),
    bind(Dial, &[SHIFT_LEFT, c('H')], Action::Widen(Step::MUCH_LESS), "", "narrow it by a large step"),

    bind(Replay, &[LEFT, c('h')], Action::Step(Step::LESS), "frame", "the frame before"),
    bind(Replay, &[RIGHT, c('l')], Action::Step(Step::MORE), "&", "the next frame"),
    bind(Replay, &[SHIFT_LEFT, c('H')], Action::Step(Step::MUCH_LESS), "", "ten frames back"),
    bind(Replay, &[SHIFT_RIGHT, c('L')], Action::Step(Step::MUCH_MORE), "", "ten frames on"),

    bind(Forces, &[LEFT, c('h')], Action::Step(Step::LESS), "cursor", "the cursor to the left"),
    bind(Forces, &[RIGHT, c('l')], Action::Step(Step::MORE), "&", "the cursor to the right"),
    bind(Forces, &[SHIFT_LEFT, c('H')], Action::Step(Step::MUCH_LESS), "", "the cursor far to the left"),
    bind(Forces, &[SHIFT_RIGHT, c('L')], Action::Step(Step::MUCH_MORE), "", "the cursor far to the right"),
    bind(Forces, &[c('v')], Action::Curves, "view", "all four forces, one of them, growth, energies"),

    bind(Marks, &[UP, c('k')], Action::Up, "preset", "the preset above"),
    bind(Marks, &[DOWN, c('j')], Action::Down, "&", "the preset below"),
    bind(Marks, &[PAGE_UP], Action::Page(false), "", "ten presets up"),
    bind(Marks, &[PAGE_DOWN], Action::Page(true), "", "ten presets down"),
    bind(Marks, &[HOME], Action::First, "", "the first preset"),
    bind(Marks, &[END], Action::Last, "", "the last preset"),
    bind(Marks, &[c(' '), ENTER], Action::Mark, "mark", "mark or unmark, two to six in all"),

    bind(Table, &[LEFT, c('h')], Action::Step(Step::LESS), "column", "the column to the left"),
    bind(Table, &[RIGHT, c('l')], Action::Step(Step::MORE), "&", "the column to the right"),
    bind(Table, &[ENTER, c('o')], Action::Sort, "sort", "sort by the column; again: the other way"),
    bind(Table, &[c('v')], Action::Curves, "curves", "the next curve below the table"),

    bind(Replays, &[LEFT, c('h')], Action::Step(Step::LESS), "frame", "the frame before"),
    bind(Replays, &[RIGHT, c('l')], Action::Step(Step::MORE), "&", "the next frame"),
    bind(Replays, &[SHIFT_LEFT, c('H')], Action::Step(Step::MUCH_LESS), "", "ten frames back"),
    bind(Replays, &[SHIFT_RIGHT, c('L')], Action::Step(Step::MUCH_MORE), "", "ten frames on"),

    bind(Accuracy, &[LEFT, c('h')], Action::Step(Step::LESS), "point", "the next faster point"),
    bind(Accuracy, &[RIGHT, c('l')], Action::Step(Step::MORE), "&", "the next slower point"),
    bind(Accuracy, &[SHIFT_LEFT, c('H')], Action::Step(Step::MUCH_LESS), "front", "the next faster point of the front"),
    bind(Accuracy, &[SHIFT_RIGHT, c('L')], Action::Step(Step::MUCH_MORE), "&", "the next slower point of the front"),
    bind(Accuracy, &[ENTER], Action::Enter, "adopt", "give the scenario its integrator and step"),
    bind(Accuracy, &[c('m')], Action::Measure, "measure", "measure every integrator again"),

    bind(Doubt, &[UP, c('k')], Action::Up, "result", "the result above"),
    bind(Doubt, &[DOWN, c('j')], Action::Down, "&", "the result below"),
    bind(Doubt, &[c('m')], Action::Measure, "again", "run the samples again, or the rest of them"),

    bind(Map, &[LEFT, c('h')], Action::Step(Step::LESS), "cursor", "the cursor to the left"),
    bind(Map, &[RIGHT, c('l')], Action::Step(Step::MORE), "&", "the cursor to the right"),
    bind(Map, &[UP, c('k')], Action::Turn(Step::MORE), "&", "the cursor up"),
    bind(Map, &[DOWN, c('j')], Action::Turn(Step::LESS), "&", "the cursor down"),
    bind(Map, &[SHIFT_LEFT, c('H')], Action::Step(Step::MUCH_LESS), "", "the cursor far to the left"),
    bind(Map, &[SHIFT_RIGHT, c('L')], Action::Step(Step::MUCH_MORE), "", "the cursor far to the right"),
    bind(Map, &[SHIFT_UP, c('K')], Action::Turn(Step::MUCH_MORE), "", "the cursor far up"),
    bind(Map, &[SHIFT_DOWN, c('J')], Action::Turn(Step::MUCH_LESS), "", "the cursor far down"),
    bind(Map, &[ENTER], Action::Enter, "adopt", "give the scenario the values under the cursor"),
    bind(Map, &[c('x')], Action::Axis(true), "across", "the next input across"),
    bind(Map, &[c('y')], Action::Axis(false), "up", "the next input up"),
    bind(Map, &[c('+'), c('=')], Action::Reach(true), "range", "wider ranges"),
    bind(Map, &[c('-')], Action::Reach(false), "&", "narrower ranges"),
    bind(Map, &[c('m')], Action::Measure, "", "go on after Esc"),

    bind(Injury, &[UP, c('k')], Action::Up, "curve", "the curve above"),
    bind(Injury, &[DOWN, c('j')], Action::Down, "&", "the curve below"),

    bind(Clock, &[c(' ')], Action::Play, "play", "play or pause"),
    bind(Clock, &[c('g')], Action::NextPeak, "peak", "to the time of the next peak"),
    bind(Clock, &[c('G')], Action::PreviousPeak, "", "to the time of the peak before"),
    bind(Clock, &[HOME], Action::First, "", "to the first frame"),
    bind(Clock, &[END], Action::Last, "", "to the last frame"),
    bind(Clock, &[c('+'), c('=')], Action::Faster, "speed", "twice as fast"),
    bind(Clock, &[c('-'), c('_')], Action::Slower, "&", "half as fast"),
    bind(Clock, &[c('z')], Action::Exaggerate, "zoom", "exaggerate displacement: x 1, 2, 5, 10"),
    bind(Clock, &[c('e')], Action::Detail, "detail", "edges, nodes or outline"),

    bind(Everywhere, &[TAB], Action::NextPane, "pane", "the next pane"),
    bind(Everywhere, &[BACK_TAB], Action::PreviousPane, "", "the pane before"),
    bind(Everywhere, &[c('?')], Action::Help, "keys", "show or hide the keys"),
    bind(Everywhere, &[c('q')], Action::Quit, "quit", "quit; asks if work would be lost"),
    bind(Everywhere, &[c('u')], Action::Undo, "undo", "undo"),
    bind(Everywhere, &[c('r'), ctrl('r')], Action::Redo, "", "redo"),
    bind(Everywhere, &[c('s')], Action::Save, "save", "save as a preset of your own"),
    bind(Everywhere, &[c('p')], Action::Presets, "presets", "open a preset"),
    bind(Everywhere, &[c('1'), alt('1'), f(1)], Action::Show(Screen::Main), "", "form, eye, traces, score"),
    bind(Everywhere, &[c('2'), alt('2'), f(2)], Action::Show(Screen::Replay), "", "the replay in full size"),
    bind(Everywhere, &[c('3'), alt('3'), f(3)], Action::Show(Screen::Forces), "", "the force profiles"),
    bind(Everywhere, &[c('4'), alt('4'), f(4)], Action::Show(Screen::Compare), "", "compare presets"),
    bind(Everywhere, &[c('5'), alt('5'), f(5)], Action::Show(Screen::Accuracy), "", "speed against error"),
    bind(Everywhere, &[c('6'), alt('6'), f(6)], Action::Show(Screen::Doubt), "", "what the doubt in the inputs does"),
    bind(Everywhere, &[c('7'), alt('7'), f(7)], Action::Show(Screen::Map), "", "damage over two inputs"),
    bind(Everywhere, &[c('8'), alt('8'), f(8)], Action::Show(Screen::Injury), "", "what published injury curves say"),
    bind(Everywhere, &[ESC], Action::Cancel, "", "cancel a long run"),
    bind(Everywhere, &[c('M')], Action::Mouse, "", "listen to the mouse, or no longer"),
    bind(Everywhere, &[ctrl('l')], Action::Repaint, "", "draw everything afresh"),
    bind(Everywhere, &[ctrl('z')], Action::Suspend, "", "stop; fg in the shell goes on"),
    bind(Everywhere, &[ctrl('c')], Action::Interrupt, "", "leave at once"),

    bind(Typing, &[ENTER], Action::Enter, "accept", "accept"),
    bind(Typing, &[ESC], Action::Cancel, "restore", "restore what was there"),
    bind(Typing, &[ctrl('c')], Action::Interrupt, "", "leave at once"),
    bind(Typing, &[ctrl('z')], Action::Suspend, "", "stop; fg in the shell goes on"),

    bind(Picker, &[UP, c('k')], Action::Up, "preset", "the preset above"),
    bind(Picker, &[DOWN, c('j')], Action::Down, "&", "the preset below"),
    bind(Picker, &[PAGE_UP], Action::Page(false), "", "ten presets up"),
    bind(Picker, &[PAGE_DOWN], Action::Page(true), "", "ten presets down"),
    bind(Picker, &[HOME], Action::First, "", "the first preset"),
    bind(Picker, &[END], Action::Last, "", "the last preset"),
    bind(Picker, &[ENTER], Action::Enter, "open", "open it"),
    bind(Picker, &[ESC, c('p'), c('q')], Action::Cancel, "close", "close the list"),
    bind(Picker, &[ctrl('c')], Action::Interrupt, "", "leave at once"),
    bind(Picker, &[ctrl('z')], Action::Suspend, "", "stop; fg in the shell goes on"),

    bind(Question, &[c('y'), ENTER], Action::Yes, "yes", "yes"),
    bind(Question, &[c('n'), ESC], Action::No, "no", "no"),
    bind(Question, &[ctrl('c')], Action::Interrupt, "", "leave at once"),
    bind(Question, &[ctrl('z')], Action::Suspend, "", "stop; fg in the shell goes on"),

    bind(Help, &[UP, c('k')], Action::Up, "scroll", "up"),
    bind(Help, &[DOWN, c('j'), c(' ')], Action::Down, "&", "down"),
    bind(Help, &[PAGE_UP], Action::Page(false), "", "ten lines up"),
    bind(Help, &[PAGE_DOWN], Action::Page(true), "", "ten lines down"),
    bind(Help, &[c('?'), ESC, c('q')], Action::Help, "close", "close the help"),
    bind(Help, &[ctrl('c')], Action::Interrupt, "", "leave at once"),
    bind(Help, &[ctrl('z')], Action::Suspend, "", "stop; fg in the shell goes on"),
];
