//! Several presets: which are marked, their answers one after another, and the clock they share.

mod cell;
pub mod comparison;
mod overlaid;
mod replays;
mod view;

use ratatui::layout::Rect;

use crate::answer::mesh_error::{MeshError, MeshQuery};
use crate::answer::solve::Answer;
use crate::many::comparison::Found;
use crate::plain_text::quoted;
use crate::run::course::Course;
use crate::run::kept::Traces;
use crate::run::refusal::Refusal;
use crate::run::watch::Watch;
use crate::scenario::Scenario;
use crate::tui::keys::shared::{DOWN, END, ENTER, HOME, LEFT, PAGE_DOWN, PAGE_UP, RIGHT, UP};
use crate::tui::keys::{Binding, KeyTable, TimeKeys, bind, c};
use crate::tui::model::{Choice, Model, Overlay, Shown};
use crate::tui::picker::Picker;
use crate::tui::screens::forces::drawn;
use crate::tui::screens::replay::FRAME_KEYS;
use crate::tui::screens::{Mouse, Pane, Screen, screen};
use crate::tui::simulation::{EstimateMesh, Simulate};
use crate::tui::task::{Question, Report};
use crate::tui::update::{PAGE, time};
use crate::tui::work::Work;
use comparison::{Comparison, FORM, MAX_MARKED};

/// The places of the panes.
const LIST: usize = 0;
const TABLE: usize = 1;
const REPLAYS: usize = 2;

pub(crate) const SCREEN: Screen = Screen {
    given,
    attend,
    hear,
    cancel,
    mouse,
    timed,
    courses: |model| match model.pane() {
        REPLAYS => Vec::new(),
        _ => vec![model.screens.compare.curve()],
    },
    answers,
    ..Screen::new(
        ("Compare", "Which is worse?"),
        "compare presets",
        &[
            Pane {
                name: "presets",
                keys: &[LIST_KEYS],
                time: TimeKeys::Absent,
            },
            Pane {
                name: "table",
                keys: &[TABLE_KEYS],
                time: TimeKeys::Early,
            },
            Pane {
                name: "replays",
                keys: &[KeyTable::new("Compare: replays", FRAME_KEYS), ALIGN_KEYS],
                time: TimeKeys::Early,
            },
        ],
        view::draw,
    )
};

#[rustfmt::skip]
const LIST_KEYS: KeyTable = KeyTable::new("Compare: presets", &[
    bind(&[UP, c('k')], |m| go(m, -1), "preset", "the preset above"),
    bind(&[DOWN, c('j')], |m| go(m, 1), "&", "the preset below"),
    bind(&[PAGE_UP], |m| go(m, -PAGE), "", "ten presets up"),
    bind(&[PAGE_DOWN], |m| go(m, PAGE), "", "ten presets down"),
    bind(&[HOME], |m| go(m, -i16::MAX), "", "the first preset"),
    bind(&[END], |m| go(m, i16::MAX), "", "the last preset"),
    bind(&[c(' '), ENTER], mark, "mark", "mark or unmark, two to six in all"),
    bind(&[c('/')], find, "find", "find presets by letters, and mark them"),
]);

#[rustfmt::skip]
const TABLE_KEYS: KeyTable = KeyTable::new("Compare: table", &[
    bind(&[LEFT, c('h')], |m| change_column(m, -1), "column", "the column to the left"),
    bind(&[RIGHT, c('l')], |m| change_column(m, 1), "&", "the column to the right"),
    bind(&[ENTER, c('o')], |m| m.screens.compare.sort_here(), "sort", "sort by the column; again: the other way"),
    bind(&[c('v')], next_curve, "curves", "the next curve below the table"),
    ALIGN,
]);

const ALIGN_KEYS: KeyTable = KeyTable::new("Compare: time", &[ALIGN]);

const ALIGN: Binding = bind(
    &[c('a')],
    |m| m.screens.compare.alignment = m.screens.compare.alignment.next(),
    "align",
    "at the same time: the beginning, first contact, or where deepest",
);

/// Asks for the answer to a marked scenario.
#[derive(Debug)]
pub struct SimulateMarked {
    /// Its name in the list.
    pub name: String,
    /// What is simulated for its column.
    pub scenario: Scenario,
}

impl Question for SimulateMarked {
    type Answer = Answer;

    fn answer(&self, watch: Watch) -> Result<Answer, Refusal> {
        Simulate(self.scenario.clone()).answer(watch)
    }
}

/// Asks for the mesh error of a marked scenario's answer.
#[derive(Debug)]
pub struct EstimateMarked {
    /// Its name in the list.
    pub name: String,
    /// What is estimated.
    pub mesh: EstimateMesh,
}

impl Question for EstimateMarked {
    type Answer = MeshError;

    fn answer(&self, watch: Watch) -> Result<MeshError, Refusal> {
        self.mesh.answer(watch)
    }
}

/// Marks what the app was opened on if that is several, and puts the table in front.
fn given(model: &mut Model, place: usize, works: &[Work]) {
    if works.len() < 2 {
        return;
    }
    model.panes[place] = TABLE;
    let compare = &mut model.screens.compare;
    let mut left_out = 0;
    for work in works {
        if !compare.is_marked(&work.source) && compare.mark(&work.source, &work.scenario).is_err() {
            left_out += 1;
        }
    }
    if left_out > 0 {
        model.notice = Some(format!(
            "only the first {MAX_MARKED} are marked for comparison, {left_out} are not"
        ));
    }
}

/// Simulates the marked scenarios one after another while they are on show, and then estimates their mesh
/// errors; stops what nobody waits for.
fn attend(model: &mut Model, on_show: bool) {
    let compare = &mut model.screens.compare;
    if on_show {
        compare.replace(FORM, &model.work.scenario);
    }
    let awaited = |name: &str, scenario: &Scenario| {
        let mut entries = compare.entries.iter();
        on_show && entries.any(|e| e.name == name && e.scenario == *scenario)
    };
    let is_idle = |job: &SimulateMarked| !awaited(&job.name, &job.scenario);
    let stops = compare
        .task
        .job
        .as_ref()
        .is_some_and(|job| is_idle(&job.question));
    let is_idle = |job: &EstimateMarked| !awaited(&job.name, &job.mesh.scenario);
    let stops_mesh = compare
        .mesh
        .job
        .as_ref()
        .is_some_and(|job| is_idle(&job.question));
    if stops {
        compare.task.stop(None, &mut model.out);
    }
    if stops_mesh {
        compare.mesh.stop(None, &mut model.out);
    }
    if !on_show || compare.task.job.is_some() || compare.mesh.job.is_some() {
        return;
    }
    if let Some(entry) = compare.next() {
        let question = SimulateMarked {
            name: entry.name.clone(),
            scenario: entry.scenario.clone(),
        };
        compare.task.ask(question, &mut model.out);
    } else if let Some((entry, answer)) = compare.next_mesh() {
        let question = EstimateMarked {
            name: entry.name.clone(),
            mesh: EstimateMesh {
                scenario: entry.scenario.clone(),
                query: MeshQuery::of(answer),
            },
        };
        compare.mesh.ask(question, &mut model.out);
    }
}

fn hear(model: &mut Model, report: &mut Option<Report>) {
    let compare = &mut model.screens.compare;
    if let Some((asked, mesh)) = compare.mesh.hear(report) {
        compare.take_mesh(&asked, mesh);
    }
    let Some((asked, outcome)) = compare.task.hear(report) else {
        return;
    };
    let why = compare.task.complaint.take().map(|(_, why)| why);
    let found = match outcome {
        Some(answer) => Found::Answer(Shown::new(asked.scenario.clone(), answer).into()),
        None => Found::Refused(why.unwrap_or_default()),
    };
    compare.take(&asked.name, found);
}

/// Gives up what is under way; the rest is not begun either.
fn cancel(model: &mut Model) -> bool {
    let compare = &mut model.screens.compare;
    if let Some(job) = &compare.mesh.job {
        let asked = job.question.clone();
        compare.mesh.stop(None, &mut model.out);
        compare.take_mesh(&asked, None);
        return true;
    }
    let Some(job) = &compare.task.job else {
        return false;
    };
    let name = job.question.name.clone();
    compare.task.stop(None, &mut model.out);
    let words = "stopped: unmark and mark it again".to_owned();
    compare.take(&name, Found::Refused(words));
    true
}

/// Those of the marked entries in the order of the table, or of the form where none is; none while some are
/// being simulated.
fn answers(model: &Model) -> Vec<(String, &Shown)> {
    let compare = &model.screens.compare;
    if compare.next().is_some() {
        return Vec::new();
    }
    let entries = compare.sorted().into_iter();
    let marked = entries.filter_map(|entry| match &entry.found {
        Found::Answer(shown) => Some((entry.name.clone(), shown.as_ref())),
        _ => None,
    });
    let marked: Vec<_> = marked.collect();
    if marked.is_empty() {
        screen::own_answer(model)
    } else {
        marked
    }
}

/// Through the time of the first entry, as far as the longest of them goes.
fn timed(model: &Model) -> Option<(&Answer, f64)> {
    let compare = &model.screens.compare;
    let first = compare.entries.iter().find_map(|e| e.answer());
    let own = screen::own_time(model);
    match (first, compare.window()) {
        (Some(first), Some(longest)) => Some((first, longest)),
        _ => own,
    }
}

/// Points at the names of the panes and at rows of the list.
fn mouse(model: &mut Model, mouse: Mouse, area: Rect) -> bool {
    match mouse {
        Mouse::Press(at) => {
            if let Some(pane) = view::heading_at(area, at) {
                model.show_pane(pane);
            } else if let Some(row) = view::listed_at(model, area, at) {
                let again = model.screens.compare.row == row;
                model.screens.compare.row = row;
                if again {
                    mark(model);
                }
            }
        }
        Mouse::Drag(_) => {}
        Mouse::Wheel(_, step) => match model.pane() {
            LIST => go(model, if step.up { -1 } else { 1 }),
            TABLE => change_column(model, if step.up { -1 } else { 1 }),
            _ => time::step(model, step.reversed()),
        },
    }
    false
}

fn go(model: &mut Model, by: i16) {
    let compare = &mut model.screens.compare;
    // The form stands above the presets.
    let row = compare.row.saturating_add_signed(isize::from(by));
    compare.row = row.min(model.choices.len());
}

fn change_column(model: &mut Model, by: isize) {
    let compare = &mut model.screens.compare;
    let last = compare.columns().len() - 1;
    compare.column = compare.column.saturating_add_signed(by).min(last);
}

/// Takes the next curve that any of the answers has.
fn next_curve(model: &mut Model) {
    let entries = &model.screens.compare.entries;
    let there = |course: &Course| {
        let has = |traces: &Traces| !course.values(traces).is_empty();
        let mut answers = entries.iter().filter_map(|entry| entry.answer());
        answers.any(|answer| answer.run.traces.as_ref().is_some_and(has))
    };
    let here = model.screens.compare.curve();
    let after = drawn().skip_while(|course| *course != here).skip(1);
    let next = after.chain(drawn()).find(there);
    model.screens.compare.curve = next.or(Some(here));
}

/// Marks what the cursor is on, or unmarks it.
fn mark(model: &mut Model) {
    let compare = &mut model.screens.compare;
    // The form stands above the presets.
    let outcome = match compare.row.checked_sub(1) {
        None => compare.mark(FORM, &model.work.scenario),
        Some(at) => match model.choices.get(at) {
            Some(choice) => mark_choice(compare, choice),
            None => Ok(()),
        },
    };
    model.notice = outcome.err();
}

fn mark_choice(compare: &mut Comparison, choice: &Choice) -> Result<(), String> {
    match &choice.scenario {
        Ok(scenario) => compare.mark(&choice.name, scenario),
        Err(why) => Err(format!("{}: {why}", quoted(&choice.name))),
    }
}

/// Opens the list that is searched by letters.
fn find(model: &mut Model) {
    let mut picker = Picker::at(&model.choices, "");
    picker.marks = true;
    model.overlay = Some(Overlay::Picker(picker));
}

/// Marks the choice of this place, or unmarks it, and makes room for the next name.
pub(crate) fn mark_found(model: &mut Model, at: usize) {
    let Some(choice) = model.choices.get(at) else {
        return;
    };
    let compare = &mut model.screens.compare;
    let outcome = mark_choice(compare, choice);
    compare.row = 1 + at;
    model.notice = outcome.err();
    let mut picker = Picker::at(&model.choices, &choice.name);
    picker.marks = true;
    model.overlay = Some(Overlay::Picker(picker));
}
