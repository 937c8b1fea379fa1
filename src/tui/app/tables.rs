//! The keys of every screen, of time, and of what stands in front; and all tables together.

use std::sync::LazyLock;

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use crate::tui::app::{App, actions};
use crate::tui::changes::{edit, presets, threshold::ask_otherwise, typing};
#[cfg(unix)]
use crate::tui::keys::press::SUSPEND;
use crate::tui::keys::press::{BACK_TAB, DOWN, END, ENTER, ESC, HOME, LEFT, PAGE_DOWN, PAGE_UP};
use crate::tui::keys::press::{Press, RIGHT, TAB, UP, alt, c, ctrl, plain};
use crate::tui::keys::{self, Binding, Key, KeyList, KeyTable, TimeKeys, chosen::Keys};
use crate::tui::screens::{SCREENS, screen::About, screen::Screen};
use crate::tui::{
    model::AppModel, outbox::Effect, overlay::Overlay, picker::PAGE, threshold::Asking,
};

/// What a key does to the app.
pub type AppAct = fn(&mut App);

const fn bind(
    presses: &'static [Press],
    act: AppAct,
    short: &'static str,
    help: &'static str,
) -> Binding<AppAct> {
    let key = Key::new(presses, short, help);
    Binding { key, act }
}

#[cfg(unix)]
const STOP: Binding<AppAct> =
    bind(&[SUSPEND], |a| actions::push(a, Effect::Suspend), "", "stop; fg in the shell goes on");
const LEAVE: Binding<AppAct> =
    bind(&[ctrl('c')], |app| actions::push(app, Effect::Quit(130)), "", "leave at once");

/// On every screen, unless something is typed or asked.
#[rustfmt::skip]
pub(crate) static EVERYWHERE: KeyTable<AppAct> = KeyTable::new("Everywhere", &[
    bind(&[TAB], |a| a.change_pane(true), "pane", "the next pane").named("next_pane"),
    bind(&[BACK_TAB], |a| a.change_pane(false), "", "the pane before").named("pane_before"),
    bind(&[c('?')], actions::help, "keys", "show or hide the keys").named("help"),
    bind(&[c('q')], actions::quit, "quit", "quit; asks if work would be lost").named("quit"),
    bind(&[ctrl('s')], |a| presets::ask_for_name(&mut a.model), "save", "save as a preset of your own").named("save"),
    bind(&[c('u')], |a| edit::travel(&mut a.model, true), "undo", "undo").named("undo"),
    bind(&[c('r'), ctrl('r')], |a| edit::travel(&mut a.model, false), "", "redo").named("redo"),
    bind(&[c('p')], |a| presets::open_picker(&mut a.model), "presets", "open a preset").named("presets"),
    bind(&[c('w')], actions::write_page, "page", "write a page of this for a browser; asks where it goes").named("page"),
    bind(&[c('>')], |a| actions::propose(a, true), "exact", "more exact: says what it costs, and asks").named("more_exact"),
    bind(&[c('<')], |a| actions::propose(a, false), "&", "faster: says what it costs, and asks").named("quicker"),
    bind(&[c('y')], actions::copy_summary, "", "copy a summary and its command").named("copy"),
    bind(&[ESC], actions::cancel, "", "cancel a long run").named("cancel"),
    bind(&[c('I')], actions::toggle_idle, "", "compute ahead while you do nothing, or no longer").named("idle"),
    bind(&[c('M')], actions::toggle_mouse, "", "listen to the mouse, or no longer").named("mouse"),
    bind(&[ctrl('l')], |a| actions::push(a, Effect::Repaint), "", "draw everything afresh").named("redraw"),
    #[cfg(unix)]
    STOP,
    LEAVE,
]);

/// One key a screen, in the order of their list, each with the place of its screen: a function
/// key, its number with Alt, and alone, which types a value in the form.
pub(crate) static SHOW: LazyLock<KeyTable<usize>> = LazyLock::new(|| {
    let binding = |(act, about): (usize, &About)| {
        let digit = (b'1' + act as u8) as char;
        let presses = vec![plain(KeyCode::F(1 + act as u8)), alt(digit), c(digit)];
        Binding { key: Key::new(presses.leak(), "", about.purpose), act }.named(about.title)
    };
    let bindings: Vec<_> = SCREENS.iter().enumerate().map(binding).collect();
    KeyTable::new("Screens", bindings.leak())
});

/// Wherever time can be moved, unless the pane has the key for itself.
#[rustfmt::skip]
pub(crate) static TIME: KeyTable<AppAct> = KeyTable::new("Time", &[
    bind(&[c(' ')], actions::play, "play", "play or pause").named("play"),
    bind(&[c('g')], |a| actions::jump_to_peak(a, true), "peak", "to the time of the next peak").named("next_peak"),
    bind(&[c('G')], |a| actions::jump_to_peak(a, false), "", "to the time of the peak before").named("peak_before"),
    bind(&[HOME], |a| actions::stay_at(a, 0.0), "", "to the first frame").named("first_frame"),
    bind(&[END], |a| actions::stay_at(a, a.timed().map_or(0.0, |timed| timed.1)), "", "to the last frame").named("last_frame"),
    bind(&[c('+'), c('=')], |a| a.model.clock.change_speed(true), "speed", "twice as fast").named("faster"),
    bind(&[c('-'), c('_')], |a| a.model.clock.change_speed(false), "&", "half as fast").named("slower"),
    bind(&[c('z')], |a| a.model.clock.change_zoom(), "larger", "show motion larger: x 1, 2, 5, 10").named("exaggerate"),
    bind(&[c('C')], |a| a.model.look.heat = a.model.look.heat.other(), "", "colours of force: the paper's, or even ones").named("heat"),
    bind(&[c('e')], |a| a.model.clock.change_detail(), "detail", "edges, nodes or outline").named("detail"),
]);

/// While a value or a name is typed.
#[rustfmt::skip]
static TYPING: KeyTable<AppAct> = KeyTable::new("Typing", &[
    bind(&[ENTER], actions::accept, "accept", "accept"),
    bind(&[ESC], actions::cancel, "cancel", "leave it as it was"),
]);

/// While a value of the form is typed.
#[rustfmt::skip]
static VALUE: KeyTable<AppAct> = KeyTable::new("Typing a value", &[
    bind(&[ENTER], actions::accept, "accept", "accept; until then nothing changes"),
    bind(&[UP, BACK_TAB], |a| typing::accept_and_move(&mut a.model, -1), "", "accept, and the field above"),
    bind(&[DOWN, TAB], |a| typing::accept_and_move(&mut a.model, 1), "accept, next", "accept, and the field below"),
    bind(&[LEFT], |a| typing::sideways(&mut a.model, KeyCode::Left), "", "through the text; after a digit: accept"),
    bind(&[RIGHT], |a| typing::sideways(&mut a.model, KeyCode::Right), "", "the same"),
    bind(&[ESC], actions::cancel, "restore", "leave it as it was; F1 to F8 accept and show a screen"),
]);

/// In the list of presets to open.
#[rustfmt::skip]
static PICKER: KeyTable<AppAct> = KeyTable::new("List of presets", &[
    bind(&[UP], |a| actions::scroll(a, -1), "preset", "the preset above"),
    bind(&[DOWN], |a| actions::scroll(a, 1), "&", "the preset below"),
    bind(&[PAGE_UP], |a| actions::scroll(a, -PAGE), "", "ten presets up"),
    bind(&[PAGE_DOWN], |a| actions::scroll(a, PAGE), "", "ten presets down"),
    bind(&[HOME], |a| actions::scroll(a, -i16::MAX), "", "the first preset"),
    bind(&[END], |a| actions::scroll(a, i16::MAX), "", "the last preset"),
    bind(&[ENTER], actions::accept, "open", "open it"),
    bind(&[plain(KeyCode::F(2))], |a| presets::ask_to_rename(&mut a.model), "rename", "rename a preset of your own"),
    bind(&[plain(KeyCode::Delete)], |a| presets::ask_to_remove(&mut a.model), "remove", "remove a preset of your own"),
    bind(&[ESC], actions::cancel, "close", "close the list; letters are searched for"),
]);

/// In the list of presets to mark for a comparison.
#[rustfmt::skip]
static MARKER: KeyTable<AppAct> = KeyTable::new("Compare: find", &[
    bind(&[UP], |a| actions::scroll(a, -1), "preset", "the preset above"),
    bind(&[DOWN], |a| actions::scroll(a, 1), "&", "the preset below"),
    bind(&[PAGE_UP], |a| actions::scroll(a, -PAGE), "", "ten presets up"),
    bind(&[PAGE_DOWN], |a| actions::scroll(a, PAGE), "", "ten presets down"),
    bind(&[ENTER], actions::accept, "mark", "mark or unmark it, and find the next"),
    bind(&[ESC], actions::cancel, "close", "close the list; letters are searched for"),
]);

/// While a field of a marked preset is changed.
#[rustfmt::skip]
static CHANGING: KeyTable<AppAct> = KeyTable::new("Compare: a value", &[
    bind(&[UP, BACK_TAB], |a| actions::scroll(a, -1), "field", "the field above"),
    bind(&[DOWN, TAB], |a| actions::scroll(a, 1), "&", "the field below"),
    bind(&[ENTER], actions::accept, "take", "compare it with this value"),
    bind(&[ESC], actions::cancel, "leave", "leave it as it was"),
]);

/// While it is asked at which value a result reaches another one.
#[rustfmt::skip]
static THRESHOLD: KeyTable<AppAct> = KeyTable::new("At which value", &[
    bind(&[UP], |a| ask_otherwise(&mut a.model, |asking| asking.next_result(false)), "result", "the result before"),
    bind(&[DOWN], |a| ask_otherwise(&mut a.model, |asking| asking.next_result(true)), "&", "the next result"),
    bind(&[ENTER], actions::accept, "find, take", "look for the value; then take it into the form"),
    bind(&[TAB], |a| ask_otherwise(&mut a.model, Asking::next_crossing), "next", "the next value, where there are several"),
    bind(&[ESC], actions::cancel, "stop", "stop looking; then close"),
]);

/// While yes or no is asked.
#[rustfmt::skip]
static QUESTION: KeyTable<AppAct> = KeyTable::new("Question", &[
    bind(&[c('y'), ENTER], |a| actions::reply(a, true), "yes", "yes"),
    bind(&[c('n'), ESC], |a| actions::reply(a, false), "no", "no"),
]);

/// While the keys are shown.
#[rustfmt::skip]
static HELP: KeyTable<AppAct> = KeyTable::new("Help", &[
    bind(&[UP, c('k')], |a| actions::scroll(a, -1), "scroll", "up"),
    bind(&[DOWN, c('j'), c(' ')], |a| actions::scroll(a, 1), "&", "down"),
    bind(&[PAGE_UP], |a| actions::scroll(a, -PAGE), "", "ten lines up"),
    bind(&[PAGE_DOWN], |a| actions::scroll(a, PAGE), "", "ten lines down"),
    bind(&[c('?'), ESC, c('q')], actions::help, "close", "close the help"),
]);

/// Whatever stands in front of a screen.
static ALWAYS: KeyTable<AppAct> = KeyTable::new(
    "",
    &[
        LEAVE,
        #[cfg(unix)]
        STOP,
    ],
);

/// The tables of what can stand in front of a screen.
static IN_FRONT: [&KeyTable<AppAct>; 8] =
    [&VALUE, &TYPING, &PICKER, &MARKER, &CHANGING, &THRESHOLD, &QUESTION, &HELP];

/// The keys of what stands in front of the screen now. Nothing behind it gets any.
pub(crate) fn in_front(model: &AppModel) -> Option<[&'static KeyTable<AppAct>; 2]> {
    let own = match &model.overlay {
        Some(Overlay::Help(_)) => &HELP,
        Some(Overlay::Picker(picker)) if picker.marked.is_some() => &MARKER,
        Some(Overlay::Picker(_)) => &PICKER,
        Some(Overlay::Change(_)) => &CHANGING,
        Some(Overlay::Threshold(_)) => &THRESHOLD,
        Some(Overlay::Name(..)) => &TYPING,
        Some(Overlay::Prompt(_)) => &QUESTION,
        None if model.form.typing.is_some() => &VALUE,
        None => return None,
    };
    Some([own, &ALWAYS])
}

fn list_in_front(own: &KeyTable<AppAct>) -> KeyList {
    let mut list = own.list();
    list.keys.extend(ALWAYS.list().keys);
    list
}

/// The place of the screen that a key, but no letter, shows while a value or a search is typed.
pub(crate) fn shown_while_typing(model: &AppModel, event: KeyEvent) -> Option<usize> {
    let letter = event.code.as_char().is_some() && !event.modifiers.contains(KeyModifiers::ALT);
    let behind = letter || !matches!(model.overlay, None | Some(Overlay::Picker(_)));
    Some(SHOW.find(&model.keys, event).filter(|_| !behind)?.act)
}

/// The tables that count behind the pane with the focus: of time, if it has it, and of all.
pub(crate) fn shared(app: &App) -> Vec<&'static KeyTable<AppAct>> {
    let time = (app.focus().time != TimeKeys::Absent).then_some(&TIME);
    time.into_iter().chain([&EVERYWHERE]).collect()
}

/// The lists in which a key is looked up now, the first that knows it wins.
pub(crate) fn stack(app: &App) -> Vec<KeyList> {
    if let Some([own, _]) = in_front(&app.model) {
        return vec![list_in_front(own)];
    }
    let mut stack = app.on_show().keys_now(&app.model);
    stack.extend(shared(app).into_iter().map(KeyTable::list));
    stack.push(SHOW.list());
    stack
}

/// What the footer may show now: keys and their word, the most needed first.
pub(crate) fn footer_keys(app: &App) -> Vec<(String, &'static str)> {
    let late = (app.focus().time == TimeKeys::Late).then_some(TIME.title);
    let mut live = keys::footer_keys(&stack(app), &app.model.keys, late, SCREENS.len());
    // Where there is one pane there is no next one.
    let several = app.on_show().panes().len() > 1;
    live.retain(|(_, word)| *word != "pane" || several);
    live
}

/// What counts on every screen, whose keys with a name a person may choose.
fn everywhere() -> [KeyList; 3] {
    [EVERYWHERE.list(), SHOW.list(), TIME.list()]
}

/// The keys of all panes.
pub(crate) fn of_panes(screen: &dyn Screen) -> Vec<KeyList> {
    screen.panes().into_iter().flat_map(|pane| pane.keys).collect()
}

fn of_screens() -> Vec<KeyList> {
    SCREENS.iter().flat_map(|about| of_panes((about.new)().as_ref())).collect()
}

/// Every list, in the order of the help.
pub fn all() -> Vec<KeyList> {
    let mut lists = everywhere().to_vec();
    lists.extend(of_screens());
    lists.extend(IN_FRONT.map(list_in_front));
    lists
}

/// Everything that may have other keys.
pub fn open_to_choice() -> impl Iterator<Item = &'static Key> {
    everywhere().into_iter().flat_map(|list| list.keys).filter(|key| !key.name.is_empty())
}

/// The first of the chosen keys that two things would share, as [`Keys::clash`] gives it.
pub fn clash(keys: &Keys) -> Option<(&'static str, Press, String)> {
    keys.clash(&everywhere(), &of_screens())
}
