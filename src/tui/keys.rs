//! Every key of the app, once.
//!
//! Dispatch, footer, help, the README's table and the test of uniqueness all read [`BINDINGS`].
//! Letters that are typed into a field are not bindings; see `update`.

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::action::{Action, Step};
use super::screens::Screen;

/// Where a key counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, strum::EnumIter)]
pub enum Context {
    /// On every screen, unless something is typed or asked.
    Everywhere,
    /// In the form.
    Form,
    /// On the dial.
    Dial,
    /// Wherever time can be moved, unless the pane has the key for itself.
    Clock,
    /// On the replay.
    Replay,
    /// On the force profiles.
    Forces,
    /// In the list of presets of the comparison.
    Marks,
    /// In its table.
    Table,
    /// On its replays.
    Replays,
    /// Among the points of speed against error.
    Accuracy,
    /// Among the bands of the results.
    Uncertainty,
    /// On the map of two inputs.
    Sweep,
    /// While a value or a name is typed.
    Typing,
    /// In the list of presets to open.
    Picker,
    /// While yes or no is asked.
    Question,
    /// While the keys are shown.
    Help,
}

impl Context {
    /// A heading for the help.
    pub fn title(self) -> &'static str {
        match self {
            Self::Everywhere => "Everywhere",
            Self::Form => "Form",
            Self::Dial => "Dial",
            Self::Clock => "Time (form, dial, replay, forces, compare)",
            Self::Replay => "Replay",
            Self::Forces => "Forces",
            Self::Marks => "Compare: presets",
            Self::Table => "Compare: table",
            Self::Replays => "Compare: replays",
            Self::Accuracy => "Accuracy",
            Self::Uncertainty => "Doubt",
            Self::Sweep => "Map",
            Self::Typing => "Typing",
            Self::Picker => "List of presets",
            Self::Question => "Question",
            Self::Help => "Help",
        }
    }

    /// The contexts in which a key is looked up, the first that knows it wins.
    pub fn stack(self) -> &'static [Context] {
        use Context::{
            Accuracy, Clock, Dial, Everywhere, Forces, Form, Help, Marks, Picker, Question, Replay,
            Replays, Sweep, Table, Typing, Uncertainty,
        };
        match self {
            Everywhere => &[Everywhere],
            Clock => &[Clock, Everywhere],
            Form => &[Form, Clock, Everywhere],
            Dial => &[Dial, Clock, Everywhere],
            Replay => &[Replay, Clock, Everywhere],
            Forces => &[Forces, Clock, Everywhere],
            Marks => &[Marks, Everywhere],
            Table => &[Table, Clock, Everywhere],
            Replays => &[Replays, Clock, Everywhere],
            Accuracy => &[Accuracy, Everywhere],
            Uncertainty => &[Uncertainty, Everywhere],
            Sweep => &[Sweep, Everywhere],
            Typing => &[Typing],
            Picker => &[Picker],
            Question => &[Question],
            Help => &[Help],
        }
    }
}

/// One press of a key.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Press(KeyCode, KeyModifiers);

impl Press {
    /// Whether an event is this press. A capital comes with or without Shift.
    pub fn is(self, event: KeyEvent) -> bool {
        let modifiers = match event.code {
            KeyCode::Char(_) | KeyCode::BackTab => event.modifiers - KeyModifiers::SHIFT,
            _ => event.modifiers,
        };
        self.0 == event.code && self.1 == modifiers
    }

    /// How it is written for a person.
    pub fn name(self) -> String {
        let key = match self.0 {
            KeyCode::Char(' ') => "Space".to_owned(),
            KeyCode::Char(c) if self.1.contains(KeyModifiers::CONTROL) => {
                c.to_uppercase().to_string()
            }
            KeyCode::Char(c) => c.to_string(),
            KeyCode::Up => "↑".to_owned(),
            KeyCode::Down => "↓".to_owned(),
            KeyCode::Left => "←".to_owned(),
            KeyCode::Right => "→".to_owned(),
            KeyCode::BackTab => "Shift-Tab".to_owned(),
            KeyCode::PageUp => "PgUp".to_owned(),
            KeyCode::PageDown => "PgDn".to_owned(),
            other => format!("{other:?}"),
        };
        let mut name = String::new();
        if self.1.contains(KeyModifiers::CONTROL) {
            name += "Ctrl-";
        }
        if self.1.contains(KeyModifiers::SHIFT) {
            name += "Shift-";
        }
        name + &key
    }
}

/// A key or several with one meaning in one context.
pub struct Binding {
    /// Where.
    pub context: Context,
    /// Which keys; the first is shown.
    pub presses: &'static [Press],
    /// What for.
    pub action: Action,
    /// A word for the footer; empty where it has no place there, `&` where the word before goes for
    /// this key too.
    pub short: &'static str,
    /// A few words for the help.
    pub help: &'static str,
}

const fn plain(code: KeyCode) -> Press {
    Press(code, KeyModifiers::NONE)
}
const fn c(c: char) -> Press {
    plain(KeyCode::Char(c))
}
const fn ctrl(c: char) -> Press {
    Press(KeyCode::Char(c), KeyModifiers::CONTROL)
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
const SHIFT_UP: Press = shift(KeyCode::Up);
const SHIFT_DOWN: Press = shift(KeyCode::Down);
const SHIFT_LEFT: Press = shift(KeyCode::Left);
const SHIFT_RIGHT: Press = shift(KeyCode::Right);

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
    Accuracy, Clock, Dial, Everywhere, Forces, Form, Help, Marks, Picker, Question, Replay,
    Replays, Sweep, Table, Typing, Uncertainty,
};

/// Every key. The footer takes its words in this order, as many as fit.
#[rustfmt::skip]
pub static BINDINGS: &[Binding] = &[
    bind(Form, &[UP, c('k')], Action::Up, "field", "the field above"),
    bind(Form, &[DOWN, c('j')], Action::Down, "&", "the field below"),
    bind(Form, &[LEFT, c('h')], Action::Step(Step::LESS), "value", "a small step down"),
    bind(Form, &[RIGHT, c('l')], Action::Step(Step::MORE), "&", "a small step up"),
    bind(Form, &[SHIFT_LEFT, c('H')], Action::Step(Step::MUCH_LESS), "", "a large step down"),
    bind(Form, &[SHIFT_RIGHT, c('L')], Action::Step(Step::MUCH_MORE), "", "a large step up"),
    bind(Form, &[ENTER], Action::Enter, "type", "type a value, open the list, unfold"),
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

    bind(Uncertainty, &[UP, c('k')], Action::Up, "result", "the result above"),
    bind(Uncertainty, &[DOWN, c('j')], Action::Down, "&", "the result below"),
    bind(Uncertainty, &[c('m')], Action::Measure, "again", "run the samples again, or the rest of them"),

    bind(Sweep, &[LEFT, c('h')], Action::Step(Step::LESS), "cursor", "the cursor to the left"),
    bind(Sweep, &[RIGHT, c('l')], Action::Step(Step::MORE), "&", "the cursor to the right"),
    bind(Sweep, &[UP, c('k')], Action::Turn(Step::MORE), "&", "the cursor up"),
    bind(Sweep, &[DOWN, c('j')], Action::Turn(Step::LESS), "&", "the cursor down"),
    bind(Sweep, &[SHIFT_LEFT, c('H')], Action::Step(Step::MUCH_LESS), "", "the cursor far to the left"),
    bind(Sweep, &[SHIFT_RIGHT, c('L')], Action::Step(Step::MUCH_MORE), "", "the cursor far to the right"),
    bind(Sweep, &[SHIFT_UP, c('K')], Action::Turn(Step::MUCH_MORE), "", "the cursor far up"),
    bind(Sweep, &[SHIFT_DOWN, c('J')], Action::Turn(Step::MUCH_LESS), "", "the cursor far down"),
    bind(Sweep, &[ENTER], Action::Enter, "adopt", "give the scenario the values under the cursor"),
    bind(Sweep, &[c('x')], Action::Axis(true), "across", "the next input across"),
    bind(Sweep, &[c('y')], Action::Axis(false), "up", "the next input up"),
    bind(Sweep, &[c('+'), c('=')], Action::Reach(true), "range", "wider ranges"),
    bind(Sweep, &[c('-')], Action::Reach(false), "&", "narrower ranges"),
    bind(Sweep, &[c('m')], Action::Measure, "", "go on after Esc"),

    bind(Clock, &[c(' ')], Action::Play, "play", "play or pause"),
    bind(Clock, &[c('g')], Action::NextPeak, "peak", "to the time of the next peak"),
    bind(Clock, &[c('G')], Action::PreviousPeak, "", "to the time of the peak before"),
    bind(Clock, &[HOME], Action::First, "", "to the first frame"),
    bind(Clock, &[END], Action::Last, "", "to the last frame"),
    bind(Clock, &[c('+'), c('=')], Action::Faster, "speed", "twice as fast"),
    bind(Clock, &[c('-')], Action::Slower, "&", "half as fast"),
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
    bind(Everywhere, &[c('1')], Action::Show(Screen::Main), "", "form, eye, traces, score"),
    bind(Everywhere, &[c('2')], Action::Show(Screen::Replay), "", "the replay in full size"),
    bind(Everywhere, &[c('3')], Action::Show(Screen::Forces), "", "the force profiles"),
    bind(Everywhere, &[c('4')], Action::Show(Screen::Compare), "", "compare presets"),
    bind(Everywhere, &[c('5')], Action::Show(Screen::Accuracy), "", "speed against error"),
    bind(Everywhere, &[c('6')], Action::Show(Screen::Uncertainty), "", "what the doubt in the inputs does"),
    bind(Everywhere, &[c('7')], Action::Show(Screen::Sweep), "", "damage over two inputs"),
    bind(Everywhere, &[ESC], Action::Cancel, "", "cancel a long run"),
    bind(Everywhere, &[ctrl('l')], Action::Repaint, "", "draw everything afresh"),
    bind(Everywhere, &[ctrl('z')], Action::Suspend, "", "stop; fg in the shell goes on"),
    bind(Everywhere, &[ctrl('c')], Action::Interrupt, "", "leave at once"),

    bind(Typing, &[ENTER], Action::Enter, "accept", "accept"),
    bind(Typing, &[ESC], Action::Cancel, "restore", "restore what was there"),
    bind(Typing, &[ctrl('c')], Action::Interrupt, "", "leave at once"),
    bind(Typing, &[ctrl('z')], Action::Suspend, "", "stop; fg in the shell goes on"),

    bind(Picker, &[UP, c('k')], Action::Up, "preset", "the preset above"),
    bind(Picker, &[DOWN, c('j')], Action::Down, "&", "the preset below"),
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
    bind(Help, &[c('?'), ESC, c('q')], Action::Help, "close", "close the help"),
    bind(Help, &[ctrl('c')], Action::Interrupt, "", "leave at once"),
    bind(Help, &[ctrl('z')], Action::Suspend, "", "stop; fg in the shell goes on"),
];

/// What a key means in a context.
pub fn action(context: Context, event: KeyEvent) -> Option<Action> {
    context.stack().iter().find_map(|context| {
        let mut own = BINDINGS.iter().filter(|b| b.context == *context);
        own.find(|b| b.presses.iter().any(|press| press.is(event)))
            .map(|binding| binding.action)
    })
}

/// What the footer may show in a context: keys and their word, the most needed first.
pub fn live(context: Context) -> Vec<(String, &'static str)> {
    let mut live: Vec<(u8, String, &'static str)> = Vec::new();
    for place in context.stack() {
        for binding in BINDINGS.iter().filter(|b| b.context == *place) {
            let name = binding
                .presses
                .first()
                .map(|p| p.name())
                .unwrap_or_default();
            match (binding.short, live.last_mut()) {
                ("", _) => {}
                ("&", Some((_, names, _))) => names.push_str(&name),
                (word, _) => {
                    // In form and dial, time comes after everything else.
                    let aside = matches!(context, Form | Dial) && *place == Clock;
                    let late = aside && binding.action != Action::Play;
                    live.push((u8::from(late), name, word));
                }
            }
        }
    }
    live.sort_by_key(|(late, ..)| *late);
    live.into_iter()
        .map(|(_, names, word)| (names, word))
        .collect()
}

/// The table of keys for the README, in Markdown.
pub fn markdown() -> String {
    use strum::IntoEnumIterator;
    let mut table = "| Where | Keys | What |\n|---|---|---|\n".to_owned();
    for context in Context::iter() {
        for binding in BINDINGS.iter().filter(|b| b.context == context) {
            let names: Vec<String> = binding
                .presses
                .iter()
                .map(|press| format!("`{}`", press.name()))
                .collect();
            let cells = [context.title(), &names.join(" "), binding.help];
            table.push_str(&["| ", &cells.join(" | "), " |\n"].concat());
        }
    }
    table
}

#[cfg(test)]
mod tests {
    use super::*;
    use strum::IntoEnumIterator;

    #[test]
    fn no_key_means_two_things_in_one_context() {
        for context in Context::iter() {
            let mut seen = Vec::new();
            for binding in BINDINGS.iter().filter(|b| b.context == context) {
                assert!(!binding.help.is_empty());
                for press in binding.presses {
                    assert!(!seen.contains(press), "{context:?} {}", press.name());
                    seen.push(*press);
                }
            }
            assert!(!seen.is_empty(), "{context:?} has no keys");
        }
    }

    #[test]
    fn no_pane_hides_a_key_that_works_everywhere() {
        for context in Context::iter() {
            let shared: Vec<_> = BINDINGS
                .iter()
                .filter(|b| b.context == Everywhere)
                .collect();
            if context == Everywhere || !context.stack().contains(&Everywhere) {
                continue;
            }
            for own in BINDINGS.iter().filter(|b| b.context == context) {
                for press in own.presses {
                    let hidden = shared.iter().any(|b| b.presses.contains(press));
                    assert!(!hidden, "{context:?} {}", press.name());
                }
            }
        }
    }

    #[test]
    fn the_table_of_keys_for_readers_is_this_one() {
        let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
        let read = |name| std::fs::read_to_string(folder.join(name)).ok();
        // The table moves from the one file to the other.
        let text = read("README-tui.md").or_else(|| read("README.md"));
        let begin = "<!-- keys -->\n\n";
        let text = text.unwrap_or_default();
        let table = text.split(begin).nth(1).unwrap_or_default();
        let table = table.split("\n<!-- end of keys -->").next();
        assert_eq!(
            table,
            Some(markdown().as_str()),
            "put this in:\n{}",
            markdown()
        );
    }

    #[test]
    fn every_context_can_be_left_and_stopped() {
        let press = |letter| KeyEvent::new(KeyCode::Char(letter), KeyModifiers::CONTROL);
        for context in Context::iter() {
            assert_eq!(action(context, press('c')), Some(Action::Interrupt));
            assert_eq!(action(context, press('z')), Some(Action::Suspend));
        }
    }

    #[test]
    fn capitals_count_with_and_without_shift() {
        for modifiers in [KeyModifiers::NONE, KeyModifiers::SHIFT] {
            let event = KeyEvent::new(KeyCode::Char('H'), modifiers);
            assert_eq!(action(Form, event), Some(Action::Step(Step::MUCH_LESS)));
        }
    }
}
