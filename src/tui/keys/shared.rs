//! The keys that belong to no pane: those of every screen, those of time, and those of what stands
//! in front of a screen.

use crossterm::event::KeyCode;

use crate::tui::keys::{Act, Binding, KeyTable, Press, alt, bind, c, ctrl, named, plain, shift};
use crate::tui::model::{Model, Overlay};
use crate::tui::screens::{SCREENS, accuracy};
use crate::tui::take_away;
use crate::tui::threshold;
use crate::tui::update;
use crate::tui::update::{PAGE, presets, scroll, time};

pub(crate) const UP: Press = plain(KeyCode::Up);
pub(crate) const DOWN: Press = plain(KeyCode::Down);
pub(crate) const LEFT: Press = plain(KeyCode::Left);
pub(crate) const RIGHT: Press = plain(KeyCode::Right);
pub(crate) const ENTER: Press = plain(KeyCode::Enter);
pub(crate) const HOME: Press = plain(KeyCode::Home);
pub(crate) const END: Press = plain(KeyCode::End);
pub(crate) const PAGE_UP: Press = plain(KeyCode::PageUp);
pub(crate) const PAGE_DOWN: Press = plain(KeyCode::PageDown);
pub(crate) const SHIFT_UP: Press = shift(KeyCode::Up);
pub(crate) const SHIFT_DOWN: Press = shift(KeyCode::Down);
pub(crate) const SHIFT_LEFT: Press = shift(KeyCode::Left);
pub(crate) const SHIFT_RIGHT: Press = shift(KeyCode::Right);
/// Stops the process until the shell goes on with it.
pub(crate) const SUSPEND: Press = ctrl('z');
const ESC: Press = plain(KeyCode::Esc);
const TAB: Press = plain(KeyCode::Tab);
const BACK_TAB: Press = plain(KeyCode::BackTab);

#[cfg(unix)]
const STOP: Binding = bind(
    &[SUSPEND],
    update::suspend,
    "",
    "stop; fg in the shell goes on",
);
const LEAVE: Binding = bind(&[ctrl('c')], update::leave, "", "leave at once");

/// On every screen, unless something is typed or asked.
#[rustfmt::skip]
pub(crate) static EVERYWHERE: KeyTable = KeyTable::new("Everywhere", &[
    named("next_pane", bind(&[TAB], |m| m.change_pane(true), "pane", "the next pane")),
    named("pane_before", bind(&[BACK_TAB], |m| m.change_pane(false), "", "the pane before")),
    named("help", bind(&[c('?')], update::help, "keys", "show or hide the keys")),
    named("quit", bind(&[c('q')], update::quit, "quit", "quit; asks if work would be lost")),
    named("save", bind(&[c('s')], presets::ask_for_name, "save", "save as a preset of your own")),
    named("undo", bind(&[c('u')], |m| update::travel(m, true), "undo", "undo")),
    named("redo", bind(&[c('r'), ctrl('r')], |m| update::travel(m, false), "", "redo")),
    named("presets", bind(&[c('p')], presets::open_picker, "presets", "open a preset")),
    named("page", bind(&[c('w')], take_away::page, "page", "write a page of this for a browser, as a new file")),
    named("more_exact", bind(&[c('>')], |m| accuracy::propose(m, true), "exact", "more exact: says what it costs, and asks")),
    named("quicker", bind(&[c('<')], |m| accuracy::propose(m, false), "&", "faster: says what it costs, and asks")),
    named("copy", bind(&[c('y')], take_away::copy, "", "copy a summary and its command")),
    named("cancel", bind(&[ESC], update::cancel, "", "cancel a long run")),
    named("idle", bind(&[c('I')], update::toggle_idle, "", "compute ahead while you do nothing, or no longer")),
    named("mouse", bind(&[c('M')], update::toggle_mouse, "", "listen to the mouse, or no longer")),
    named("redraw", bind(&[ctrl('l')], update::repaint, "", "draw everything afresh")),
    #[cfg(unix)]
    STOP,
    LEAVE,
]);

/// The keys of each screen: its number alone, with Alt, and as a function key.
const SHOW_PRESSES: [[Press; 3]; SCREENS.len()] = {
    let mut presses = [[ESC; 3]; SCREENS.len()];
    let mut i = 0;
    while i < presses.len() {
        let digit = (b'1' + i as u8) as char;
        presses[i] = [c(digit), alt(digit), plain(KeyCode::F(1 + i as u8))];
        i += 1;
    }
    presses
};

static SHOW_PRESSES_KEPT: [[Press; 3]; SCREENS.len()] = SHOW_PRESSES;

static SHOW_BINDINGS: [Binding; SCREENS.len()] = {
    let mut bindings = [LEAVE; SCREENS.len()];
    let mut i = 0;
    while i < bindings.len() {
        bindings[i] = Binding {
            presses: &SHOW_PRESSES_KEPT[i],
            act: Act::Show(i),
            short: "",
            help: SCREENS[i].purpose,
            name: SCREENS[i].title,
        };
        i += 1;
    }
    bindings
};

/// One key a screen, in the order of their list.
pub(crate) static SHOW: KeyTable = KeyTable::new("Screens", &SHOW_BINDINGS);

/// Wherever time can be moved, unless the pane has the key for itself.
#[rustfmt::skip]
pub(crate) static TIME: KeyTable = KeyTable::new("Time", &[
    named("play", bind(&[c(' ')], time::play, "play", "play or pause")),
    named("next_peak", bind(&[c('g')], |m| time::jump(m, true), "peak", "to the time of the next peak")),
    named("peak_before", bind(&[c('G')], |m| time::jump(m, false), "", "to the time of the peak before")),
    named("first_frame", bind(&[HOME], |m| time::stay_at(m, 0.0), "", "to the first frame")),
    named("last_frame", bind(&[END], |m| time::stay_at(m, m.window().unwrap_or(0.0)), "", "to the last frame")),
    named("faster", bind(&[c('+'), c('=')], |m| m.clock.change_speed(true), "speed", "twice as fast")),
    named("slower", bind(&[c('-'), c('_')], |m| m.clock.change_speed(false), "&", "half as fast")),
    named("exaggerate", bind(&[c('z')], |m| m.clock.change_zoom(), "larger", "show motion larger: x 1, 2, 5, 10")),
    named("heat", bind(&[c('C')], |m| m.look.heat = m.look.heat.other(), "", "colours of force: the paper's, or even ones")),
    named("detail", bind(&[c('e')], |m| m.clock.change_detail(), "detail", "edges, nodes or outline")),
]);

/// While a value or a name is typed.
#[rustfmt::skip]
static TYPING: KeyTable = KeyTable::new("Typing", &[
    bind(&[ENTER], update::accept, "accept", "accept"),
    bind(&[ESC], update::cancel, "cancel", "leave it as it was"),
    LEAVE,
    #[cfg(unix)]
    STOP,
]);

/// In the list of presets to open.
#[rustfmt::skip]
static PICKER: KeyTable = KeyTable::new("List of presets", &[
    bind(&[UP], |m| scroll(m, -1), "preset", "the preset above"),
    bind(&[DOWN], |m| scroll(m, 1), "&", "the preset below"),
    bind(&[PAGE_UP], |m| scroll(m, -PAGE), "", "ten presets up"),
    bind(&[PAGE_DOWN], |m| scroll(m, PAGE), "", "ten presets down"),
    bind(&[HOME], |m| scroll(m, -i16::MAX), "", "the first preset"),
    bind(&[END], |m| scroll(m, i16::MAX), "", "the last preset"),
    bind(&[ENTER], update::accept, "open", "open it"),
    bind(&[plain(KeyCode::F(2))], presets::ask_to_rename, "rename", "rename a preset of your own"),
    bind(&[plain(KeyCode::Delete)], presets::ask_to_remove, "remove", "remove a preset of your own"),
    bind(&[ESC], update::cancel, "close", "close the list; letters are searched for"),
    LEAVE,
    #[cfg(unix)]
    STOP,
]);

/// In the list of presets to mark for a comparison.
#[rustfmt::skip]
static MARKER: KeyTable = KeyTable::new("Compare: find", &[
    bind(&[UP], |m| scroll(m, -1), "preset", "the preset above"),
    bind(&[DOWN], |m| scroll(m, 1), "&", "the preset below"),
    bind(&[PAGE_UP], |m| scroll(m, -PAGE), "", "ten presets up"),
    bind(&[PAGE_DOWN], |m| scroll(m, PAGE), "", "ten presets down"),
    bind(&[ENTER], update::accept, "mark", "mark or unmark it, and find the next"),
    bind(&[ESC], update::cancel, "close", "close the list; letters are searched for"),
    LEAVE,
    #[cfg(unix)]
    STOP,
]);

/// While it is asked at which value a result reaches another one.
#[rustfmt::skip]
static THRESHOLD: KeyTable = KeyTable::new("At which value", &[
    bind(&[UP], |m| threshold::next_result(m, false), "result", "the result before"),
    bind(&[DOWN], |m| threshold::next_result(m, true), "&", "the next result"),
    bind(&[ENTER], update::accept, "find, take", "look for the value; then take it into the form"),
    bind(&[TAB], threshold::next_crossing, "next", "the next value, where there are several"),
    bind(&[ESC], update::cancel, "stop", "stop looking; then close"),
    LEAVE,
    #[cfg(unix)]
    STOP,
]);

/// While yes or no is asked.
#[rustfmt::skip]
static QUESTION: KeyTable = KeyTable::new("Question", &[
    bind(&[c('y'), ENTER], |m| update::reply(m, true), "yes", "yes"),
    bind(&[c('n'), ESC], |m| update::reply(m, false), "no", "no"),
    LEAVE,
    #[cfg(unix)]
    STOP,
]);

/// While the keys are shown.
#[rustfmt::skip]
static HELP: KeyTable = KeyTable::new("Help", &[
    bind(&[UP, c('k')], |m| scroll(m, -1), "scroll", "up"),
    bind(&[DOWN, c('j'), c(' ')], |m| scroll(m, 1), "&", "down"),
    bind(&[PAGE_UP], |m| scroll(m, -PAGE), "", "ten lines up"),
    bind(&[PAGE_DOWN], |m| scroll(m, PAGE), "", "ten lines down"),
    bind(&[c('?'), ESC, c('q')], update::help, "close", "close the help"),
    LEAVE,
    #[cfg(unix)]
    STOP,
]);

/// The tables of what can stand in front of a screen.
pub(crate) static IN_FRONT: [&KeyTable; 6] =
    [&TYPING, &PICKER, &MARKER, &THRESHOLD, &QUESTION, &HELP];

/// The keys of what stands in front of the screen now. Nothing behind it hears any.
pub(crate) fn in_front(model: &Model) -> Option<&'static KeyTable> {
    match &model.overlay {
        Some(Overlay::Help(_)) => Some(&HELP),
        Some(Overlay::Picker(picker)) if picker.marks => Some(&MARKER),
        Some(Overlay::Picker(_)) => Some(&PICKER),
        Some(Overlay::Threshold(_)) => Some(&THRESHOLD),
        Some(Overlay::Name(..)) => Some(&TYPING),
        Some(Overlay::Question(_)) => Some(&QUESTION),
        None => model.form.typing.is_some().then_some(&TYPING),
    }
}
