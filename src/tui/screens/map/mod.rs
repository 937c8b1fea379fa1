//! One result over two inputs: filled in from coarse to fine while it is on show.

mod view;

use crate::many::map::{Grid, SIDE, Span, fill};
use crate::many::sweep::spaced;
use crate::run::{quantity::Quantity, refusal::Refusal, watch::Watch};
use crate::scenario::fields::{FIELDS, Field, find};
use crate::scenario::{Scenario, direction::HOURS, doubt::number, set};
use crate::tui::keys::press::{DOWN, ENTER, LEFT, RIGHT, UP, c};
use crate::tui::keys::press::{SHIFT_DOWN, SHIFT_LEFT, SHIFT_RIGHT, SHIFT_UP};
use crate::tui::request::{Report, TaskQuestion};
use crate::tui::screens::screen::{Pane, PaneKeys, Panes, Screen, bind, follow, go_on, next_of};
use crate::tui::{changes::edit::change, form::words, keys::TimeKeys, worker::run_watched};
use crate::tui::{ensemble, model::AppModel, step::Step, task::Task, view::sheet::Sheet};

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
    bind(&[c('e')], |s, _| s.upper = !s.upper, "upper end", "what is told of a risk, or the upper end of its range"),
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
    let Some((moved, scenario)) = map.adopted(&model.work.scenario) else { return };
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

const ANGLE: &str = "impact.angle_deg";
/// Pairs of inputs to begin with; the first whose fields are there. An angle is none of them: each
/// of its points takes seconds.
const PAIRS: [(&str, &str); 2] =
    [("impact.speed_m_s", "impact.mass_g"), ("impact.force_n", "impact.duration_ms")];
/// How far a range reaches at first: to three times the value and to a third of it.
const REACH: f64 = 2.0;
/// The factor of one key press on the reach, and its bounds.
const ZOOM: f64 = 1.5;
const REACHES: (f64, f64) = (0.1, 20.0);
/// An angle has room if what the model is trusted for is so many times as large.
const LEAST_SHARE: f64 = 1.25;
/// Where a value is 0 the range reaches so many large steps to both sides, at the first reach.
const STEPS: f64 = 3.0;

/// Asks for what a map lacks.
#[derive(Debug, Clone)]
pub struct DrawMap {
    /// The scenario; what it holds of the two inputs does not matter.
    pub scenario: Scenario,
    /// The inputs: across and up.
    pub spans: [Span; 2],
    pub known: Grid,
}

impl TaskQuestion for DrawMap {
    type Answer = Grid;

    fn answer(&self, watch: Watch) -> Result<Grid, Refusal> {
        self.fill_in(watch, &mut |_| {})
    }

    fn fill_in(&self, watch: Watch, show: &mut dyn FnMut(Grid)) -> Result<Grid, Refusal> {
        Ok(run_watched(watch, show, |stop, progress| {
            let (spans, known) = (self.spans.into(), self.known.clone());
            fill(&self.scenario, spans, known, stop, &|grid| {
                let (known, all) = grid.known();
                progress.report(known as f64 / all as f64, || grid.clone())
            })
        }))
    }
}

pub struct Map {
    pub spans: Option<[Span; 2]>,
    /// What came last, and of which scenario and inputs.
    pub done: Option<(Scenario, [Span; 2], Grid)>,
    /// What is under way, or that it was stopped.
    pub task: Task<DrawMap>,
    /// The result that was chosen, if one was; the scene may lack it.
    pub chosen: Option<Quantity>,
    /// Where the cursor stands on the finest grid.
    pub cursor: [usize; 2],
    /// Whether the upper end of a risk is on show and not what is told.
    pub upper: bool,
    reach: f64,
}

impl Default for Map {
    fn default() -> Self {
        let (cursor, reach) = ([SIDE / 2; 2], REACH);
        Self {
            spans: None,
            done: None,
            task: Task::default(),
            chosen: None,
            cursor,
            upper: false,
            reach,
        }
    }
}

/// Three significant digits.
pub fn rounded(value: f64) -> f64 {
    format!("{value:.2e}").parse().unwrap_or(value)
}

/// A range round the present value, within the field's bounds.
fn span(field: &'static Field, scenario: &Scenario, reach: f64) -> Option<Span> {
    let (value, bounds) = number(field, scenario)?;
    if field.path.ends_with("_clock") {
        return Some(Span { field, from: 0.0, to: HOURS });
    }
    // No farther than the model is trusted, unless the scenario itself goes nearly there.
    let trusted = scenario.trusted_angle_deg().filter(|_| field.path == ANGLE);
    let share = trusted.map(|trusted| trusted / value.abs());
    let far_enough = share.filter(|share| *share >= LEAST_SHARE);
    let reach = far_enough.map_or(reach, |share| reach.min(share - 1.0));
    let (a, b) = if value == 0.0 {
        let wide = STEPS * bounds.coarse * reach / REACH;
        (-wide, wide)
    } else {
        (value / (1.0 + reach), value * (1.0 + reach))
    };
    let within = |v: f64| rounded(v).clamp(bounds.min, bounds.max);
    let (from, to) = (within(a.min(b)), within(a.max(b)));
    (from < to).then_some(Span { field, from, to })
}

/// The place on the finest grid that is nearest to a value.
fn nearest(span: Span, value: f64) -> usize {
    let share = ((value - span.from) / (span.to - span.from)).clamp(0.0, 1.0);
    (share * (SIDE - 1) as f64).round() as usize
}

/// The scenario without what the two inputs say of it.
fn key(scenario: &Scenario, spans: [Span; 2]) -> Scenario {
    let mut bare = ensemble::key(scenario);
    bare.doubt.clear();
    set::put_numbers(&mut bare, spans.map(|span| (span.field, span.from)));
    bare
}

impl Map {
    /// Chooses inputs that the scenario has, where these are none, and ranges that hold its values.
    fn settle(&mut self, scenario: &Scenario) {
        let holds = |span: &Span| {
            let own = number(span.field, scenario);
            own.is_some_and(|(value, _)| (span.from..=span.to).contains(&value))
        };
        if self.spans.is_some_and(|spans| spans.iter().all(holds)) {
            return;
        }
        let chosen = self.spans.map(|spans| spans.map(|span| span.field));
        let first = PAIRS.iter().filter_map(|(x, y)| Some([find(x)?, find(y)?]));
        let of = |field| span(field, scenario, self.reach);
        let mut pairs = chosen.into_iter().chain(first);
        self.spans = pairs.find_map(|[x, y]| Some([of(x)?, of(y)?]));
        self.put_cursor_on_scenario(scenario, &[0, 1]);
    }

    /// Puts the cursor to what the scenario holds of these inputs.
    fn put_cursor_on_scenario(&mut self, scenario: &Scenario, places: &[usize]) {
        let Some(spans) = self.spans else { return };
        for &i in places {
            if let Some((value, _)) = number(spans[i].field, scenario) {
                self.cursor[i] = nearest(spans[i], value);
            }
        }
    }

    /// Takes the next field for the input across, or for the one up.
    fn turn(&mut self, scenario: &Scenario, across: bool) {
        let Some(mut spans) = self.spans else { return };
        let own = usize::from(!across);
        let here = FIELDS.iter().position(|f| f.path == spans[own].field.path);
        let count = FIELDS.len();
        let next = (1..=count)
            .map(|i| &FIELDS[(here.unwrap_or(0) + i) % count])
            .filter(|field| field.path != spans[1 - own].field.path)
            .find_map(|field| span(field, scenario, self.reach));
        spans[own] = next.unwrap_or(spans[own]);
        self.spans = Some(spans);
        self.put_cursor_on_scenario(scenario, &[own]);
        self.task.complaint = None;
    }

    /// Widens or narrows both ranges about what the scenario holds now.
    fn zoom(&mut self, scenario: &Scenario, wider: bool) {
        let factor = if wider { ZOOM } else { 1.0 / ZOOM };
        self.reach = (self.reach * factor).clamp(REACHES.0, REACHES.1);
        let Some(inputs) = self.inputs() else { return };
        let spans = inputs.map(|(old, _)| span(old.field, scenario, self.reach).unwrap_or(old));
        self.spans = Some(spans);
        self.cursor = [0, 1].map(|i| nearest(spans[i], inputs[i].1));
        self.task.complaint = None;
    }

    fn move_cursor(&mut self, step: Step, across: bool) {
        let by = if step.coarse { 4 } else { 1 };
        let by = if step.up { by } else { -by };
        let at = &mut self.cursor[usize::from(!across)];
        *at = at.saturating_add_signed(by).min(SIDE - 1);
    }

    /// What is known of this scenario over the present inputs.
    pub(crate) fn grid(&self, scenario: &Scenario) -> Option<&Grid> {
        let spans = self.spans?;
        let (asked, of, grid) = self.done.as_ref()?;
        (*of == spans && *asked == key(scenario, spans)).then_some(grid)
    }

    /// What is to be computed, if anything is left.
    fn lacking(&self, scenario: &Scenario) -> Option<DrawMap> {
        let spans = self.spans?;
        let known = self.grid(scenario).cloned();
        let known = known.unwrap_or_else(|| Grid::new(SIDE));
        let (count, all) = known.known();
        (count < all).then(|| DrawMap { scenario: key(scenario, spans), spans, known })
    }

    /// The inputs with their values under the cursor.
    fn inputs(&self) -> Option<[(Span, f64); 2]> {
        let spans = self.spans?;
        let value = |i: usize| spaced(spans[i].from, spans[i].to, SIDE)[self.cursor[i]];
        Some([0, 1].map(|i| (spans[i], value(i))))
    }

    /// Where the cursor stands, from 0 to 1.
    fn place(&self) -> (f64, f64) {
        self.cursor.map(|at| at as f64 / (SIDE - 1) as f64).into()
    }

    /// The result on show: the chosen one where the map has it, else rupture, else damage.
    pub(crate) fn quantity(&self, grid: &Grid) -> Quantity {
        let mut own = [self.chosen, Some(Quantity::GlobeRupture)].into_iter().flatten();
        let there = own.find(|of| grid.largest(*of).is_some());
        there.unwrap_or(Quantity::Damage)
    }

    fn next_result(&mut self, scenario: &Scenario) {
        if let Some(grid) = self.grid(scenario) {
            let there = |of: &Quantity| grid.largest(*of).is_some();
            self.chosen = Some(next_of(Quantity::ALL, self.quantity(grid), there));
        }
    }

    /// The inputs that the cursor was moved over, with their values, and the scenario with those.
    pub(crate) fn adopted(&self, scenario: &Scenario) -> Option<(Vec<(Span, f64)>, Scenario)> {
        let moved = |((span, _), at): &((Span, f64), usize)| {
            let own = number(span.field, scenario).map(|(value, _)| value);
            let here = |own| (span.from..=span.to).contains(&own) && nearest(*span, own) == *at;
            !own.is_some_and(here)
        };
        let inputs = self.inputs()?.into_iter().zip(self.cursor);
        let moved: Vec<_> = inputs.filter(moved).map(|(input, _)| input).collect();
        let mut changed = scenario.clone();
        let put = moved.iter().map(|(span, value)| (span.field, *value));
        set::put_numbers(&mut changed, put);
        Some((moved, changed))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::many::map::{PointResults, Spot};
    use crate::run::readings::PerQuantity;

    fn settled() -> (Scenario, Map) {
        let (scenario, mut map) = (Scenario::default(), Map::default());
        map.settle(&scenario);
        (scenario, map)
    }

    #[test]
    fn inputs_follow_the_scenario_and_go_round_without_meeting() {
        let (scenario, mut map) = settled();
        let [x, y] = map.spans.unwrap();
        assert_eq!((x.field.path, y.field.path), ("impact.force_n", "impact.duration_ms"));
        assert_eq!((x.from, x.to), (100.0, 900.0));
        for _ in 0..60 {
            map.turn(&scenario, true);
            let [x, y] = map.spans.unwrap();
            assert_ne!(x.field.path, y.field.path);
            assert!(x.from < x.to && y.field.path == "impact.duration_ms");
        }
    }

    #[test]
    fn the_cursor_begins_on_what_the_scenario_holds_and_keeps_its_values_when_ranges_change() {
        let (scenario, mut map) = settled();
        let near = |map: &Map, force: f64| {
            let [x, _] = map.spans.unwrap();
            let step = (x.to - x.from) / (SIDE - 1) as f64;
            assert!((map.inputs().unwrap()[0].1 - force).abs() <= 0.51 * step);
        };
        near(&map, 300.0);
        map.move_cursor(Step::MUCH_MORE, true);
        let force = map.inputs().unwrap()[0].1;
        map.zoom(&scenario, true);
        near(&map, force);
        map.turn(&scenario, false);
        near(&map, force);
    }

    #[test]
    fn ranges_stay_within_bounds_however_wide() {
        let (scenario, mut map) = settled();
        map.turn(&scenario, false);
        for wider in [true; 30].into_iter().chain([false; 30]) {
            map.zoom(&scenario, wider);
            for span in map.spans.unwrap() {
                let (_, bounds) = number(span.field, &scenario).unwrap();
                assert!(bounds.min <= span.from && span.from < span.to && span.to <= bounds.max);
            }
        }
    }

    #[test]
    fn only_inputs_that_the_cursor_was_moved_over_are_adopted() {
        let (scenario, mut map) = settled();
        assert_eq!(map.adopted(&scenario), Some((Vec::new(), scenario.clone())));
        map.move_cursor(Step::MORE, true);
        let (moved, adopted) = map.adopted(&scenario).unwrap();
        assert_eq!(moved.len(), 1);
        let value = |path| number(find(path).unwrap(), &adopted).unwrap().0;
        assert_eq!(value("impact.force_n"), moved[0].1);
        assert_eq!(value("impact.duration_ms"), 0.2);
    }

    #[test]
    fn an_edit_of_an_input_keeps_the_map_and_any_other_does_not() {
        let (mut scenario, mut map) = settled();
        let question = map.lacking(&scenario).unwrap();
        let damage = |q| (q == Quantity::Damage).then_some(1.0);
        let mut grid = question.known.clone();
        for at in grid.order().into_iter().take(81) {
            grid.put(
                at,
                Spot::Known(PointResults { values: PerQuantity::from_fn(damage), ranges: None }),
            );
        }
        map.done = Some((question.scenario, question.spans, grid));
        map.cursor = [4, 12];
        let (moved, adopted) = map.adopted(&scenario).unwrap();
        assert!(moved.len() == 2 && adopted != scenario);
        let grid = map.grid(&adopted).unwrap();
        let reading = grid.read(map.quantity(grid), map.place()).unwrap();
        assert_eq!((reading.value, reading.exact), (Some(1.0), true));
        let left = map.lacking(&adopted).unwrap();
        assert_eq!(left.known.known().0, 81, "it goes on from there");
        scenario.window_ms = Some(2.0);
        assert!(map.grid(&scenario).is_none());
    }
}
