//! The app on a made-up answer: opened, driven by keys, and drawn as text and styles.

use std::time::Duration;

use contrecoup::answer::solve::Answer;
use contrecoup::scenario::Scenario;
use contrecoup::scenario::fields;
use contrecoup::tui::app::App;
use contrecoup::tui::app::frame;
use contrecoup::tui::app::update::{Message, begin, update};
use contrecoup::tui::ensemble::RunSamples;
use contrecoup::tui::form::FormRow;
use contrecoup::tui::look::Look;
use contrecoup::tui::outbox::Effect;
use contrecoup::tui::prepare;
use contrecoup::tui::request::{Report, Ticket};
use contrecoup::tui::screens::accuracy::{MeasureAccuracy, Measurement};
use contrecoup::tui::screens::compare::comparison::SimulateMarked;
use contrecoup::tui::screens::map::{DrawMap, Map};
use contrecoup::tui::simulation::Simulate;
use contrecoup::tui::task::Task;
use contrecoup::tui::terminal::caps::{Depth, Symbols};
use contrecoup::tui::terminal::input::{Parser, TerminalInput};
use contrecoup::tui::view::heat::HeatMap;
use contrecoup::tui::view::palette::Palette;
use ratatui::buffer::{Buffer, Cell};
use ratatui::layout::Rect;
use ratatui::style::{Color, Modifier, Style};

use crate::{made_up, made_up_accuracy};

/// The smallest that the app draws on, the usual, and a large one.
pub const SIZES: [(u16, u16); 3] = [(60, 20), (80, 24), (120, 40)];

pub fn look(depth: Depth) -> Look {
    Look { depth, symbols: Symbols::Braille, heat: HeatMap::Hot, palette: Palette::default() }
}

/// Answers what the app's threads would, by `find`.
fn settle(app: &mut App, effects: Vec<Effect>, find: fn(&Scenario) -> Answer) {
    let mut open = effects;
    while let Some(effect) = open.pop() {
        let Effect::Start(request) = effect else {
            continue;
        };
        let ticket = request.ticket;
        let report = if let Some(Simulate(asked)) = request.question() {
            Report::done::<Simulate>(ticket, Ok(find(asked)))
        } else if let Some(SimulateMarked { scenario, .. }) = request.question() {
            Report::done::<SimulateMarked>(ticket, Ok(find(scenario)))
        } else {
            continue;
        };
        open.extend(update(app, Message::News(report)));
    }
}

/// The ticket of what is under way.
pub fn ticket<Q>(task: &Task<Q>) -> Ticket {
    task.job.as_ref().unwrap().ticket
}

/// Opened on these presets, with made-up answers.
pub fn app(sources: &[&str], depth: Depth) -> App {
    app_by(sources, depth, made_up::answer)
}

/// Opened on these presets, or the paper's blow, with the answers that `find` gives.
pub fn app_by(sources: &[&str], depth: Depth, find: fn(&Scenario) -> Answer) -> App {
    let sources = if sources.is_empty() { &["paper-300n"] } else { sources };
    let sources: Vec<String> = sources.iter().map(|s| (*s).to_owned()).collect();
    let mut app = prepare(&sources, look(depth)).unwrap();
    // A person's own presets would change the pictures.
    app.model.choices.retain(|choice| choice.origin != "own");
    let effects = begin(&mut app);
    settle(&mut app, effects, find);
    if let Some(force) = fields::find("impact.force_n")
        && force.text(&app.model.work.scenario).is_some()
    {
        app.model.form.selected = FormRow::Field(force);
    }
    app
}

/// Types these keys; whatever they ask for is answered at once.
pub fn press(app: &mut App, keys: &str) {
    let mut parser = Parser::default();
    let mut inputs = parser.feed(keys.as_bytes());
    inputs.extend(parser.flush());
    for input in inputs {
        if let TerminalInput::Key(event) = input {
            let effects = update(app, Message::Key(event));
            settle(app, effects, made_up::answer);
        }
    }
}

/// Opens the accuracy screen and lets a made-up measurement end.
pub fn open_measured(app: &mut App) {
    press(app, "\x1b5");
    let ticket = ticket(&app.state::<Measurement>().task);
    let report = Report::done::<MeasureAccuracy>(ticket, Ok(made_up_accuracy::made_up()));
    update(app, Message::News(report));
}

/// Opens the doubt screen and lets made-up samples come.
pub fn open_sampled(app: &mut App) {
    press(app, "\x1b6");
    let job = app.model.ensemble.task.job.as_ref().unwrap();
    let all = made_up::ensemble(&job.question.scenario, job.question.count);
    let report = Report::done::<RunSamples>(job.ticket, Ok(all));
    update(app, Message::News(report));
}

/// Opens the map and lets the first points of a made-up grid come; the rest is on its way.
pub fn open_mapped(app: &mut App) {
    press(app, "\x1b7");
    let ticket = ticket(&app.state::<Map>().task);
    let report = Report::so_far::<DrawMap>(ticket, made_up::grid(81));
    update(app, Message::News(report));
    let report = Report::progress(ticket, 81.0 / 1089.0, Duration::ZERO);
    update(app, Message::News(report));
}

/// The cells of a screen.
pub fn cells(app: &App, (width, height): (u16, u16)) -> Buffer {
    let mut buffer = Buffer::empty(Rect::new(0, 0, width, height));
    frame::draw(app, &mut buffer);
    buffer
}

fn lines(buffer: &Buffer, of: impl FnMut(&Cell) -> String) -> String {
    let width = usize::from(buffer.area.width);
    let cells: Vec<String> = buffer.content.iter().map(of).collect();
    let rows = cells.chunks(width).map(|row| row.concat().trim_end().to_owned() + "\n");
    rows.collect()
}

/// The text of a screen.
pub fn picture(app: &App, size: (u16, u16)) -> String {
    lines(&cells(app, size), |cell| cell.symbol().to_owned())
}

/// A style in few words.
fn words(style: Style) -> String {
    let coloured = |colour: Option<Color>| colour.filter(|colour| *colour != Color::Reset);
    let mut words = Vec::new();
    words.extend(coloured(style.fg).map(|colour| format!("{colour:?}")));
    words.extend(coloured(style.bg).map(|colour| format!("on {colour:?}")));
    let modifiers = style.add_modifier;
    words.extend(modifiers.iter_names().map(|(name, _): (&str, Modifier)| name.to_lowercase()));
    words.join(" ")
}

/// Letters enough for all styles of a screen.
fn letters_of_styles() -> impl Iterator<Item = char> {
    ('a'..='z').chain('A'..='Z').chain('0'..='9').chain('α'..='ω').chain('Ѐ'..='џ')
}

/// The text of a screen of 80 x 24; below it, where it is styled, a letter for each cell's style;
/// and what the letters mean. Cells without a letter are plain.
pub fn styled(app: &App) -> String {
    let buffer = cells(app, (80, 24));
    let mut styles: Vec<String> = Vec::new();
    let letters = lines(&buffer, |cell| {
        let style = words(cell.style());
        let on_blank = style.contains("on ") || style.contains("reversed");
        if style.is_empty() || (cell.symbol() == " " && !on_blank) {
            return " ".to_owned();
        }
        let known = styles.iter().position(|known| *known == style);
        let at = known.unwrap_or_else(|| {
            styles.push(style);
            styles.len() - 1
        });
        letters_of_styles().nth(at).unwrap().to_string()
    });
    let names =
        styles.iter().zip(letters_of_styles()).map(|(style, letter)| format!("{letter} {style}\n"));
    let names: String = names.collect();
    let text = picture(app, (80, 24));
    format!("{text}\n{letters}\n{names}")
}

/// The line that has a word, from that word on.
pub fn line_from<'a>(text: &'a str, word: &str) -> &'a str {
    let line = text.lines().find(|line| line.contains(word));
    let line = line.unwrap_or_else(|| panic!("no {word} in\n{text}"));
    &line[line.find(word).unwrap()..]
}
