//! Opening the app: what is worked on first, and what can be opened later.

use std::io::{self, IsTerminal};
use std::path::Path;
use std::process::ExitCode;
use std::time::Duration;

use clap::Args;

use crate::plain_text::quoted;
use crate::scenario::library::resolve;
use crate::scenario::problem::{Problem, ScenarioError};
use crate::scenario::set::set;
use crate::tui::changing::called;
use crate::tui::form::{ScenarioForm, strength};
use crate::tui::picker::{Choice, LAST, Picker, choices};
use crate::tui::terminal::caps::{ColorFlag, Symbols, depth, symbols};
use crate::tui::{app::App, config::Config, look::Look, model::AppModel, overlay::Overlay};
use crate::tui::{guest, saved_session, screens::SCREENS, terminal};
use crate::tui::{saved_session::SavedSession, view::palette::Palette, work::Work};

/// What is opened if nothing is asked for: an object, as one is what most come with.
pub(super) const FIRST: &str = "squash-ball";

/// What the app is opened on, and how.
#[derive(Debug, Args)]
pub struct Options {
    /// Presets or files, as in squash-ball@30; several are marked for comparison
    #[arg(value_name = "PRESET|FILE.ron")]
    pub sources: Vec<String>,
    /// For guests on a shared host: no file is read or written, and memory, priority, meshes and
    /// times are bounded
    #[arg(long)]
    pub guest: bool,
    /// Minutes without a key after which a guest's session ends
    #[arg(long, value_name = "N", requires = "guest", default_value = "10", value_parser = minutes)]
    pub idle_minutes: Duration,
    /// How it looks and listens.
    #[command(flatten)]
    pub flags: AppFlags,
}

fn minutes(text: &str) -> Result<Duration, &'static str> {
    let minutes = text.parse().ok().filter(|minutes| (0.01..=1440.0).contains(minutes));
    let seconds = minutes.map(|minutes: f64| 60.0 * minutes);
    seconds.map(Duration::from_secs_f64).ok_or("expected 0.01 to 1440 minutes")
}

/// How the app looks and listens.
#[derive(Debug, Args)]
#[command(next_help_heading = "Options of the app")]
pub struct AppFlags {
    /// How many colours
    #[arg(long, value_name = "WHICH")]
    pub color: Option<ColorFlag>,
    /// How the mesh and the curves are drawn
    #[arg(long, value_name = "WHICH")]
    pub symbols: Option<Symbols>,
    /// Most frames a second of a replay
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u8).range(1..=60))]
    pub fps: Option<u8>,
    /// Listen to the mouse too; the terminal's own selection of text then needs Shift
    #[arg(long)]
    pub mouse: bool,
    /// Fail on purpose at this key, so that a test sees the terminal restored
    #[arg(long, hide = true)]
    pub fail_on: Option<char>,
}

/// Why the app did not open, or what ended it.
#[derive(Debug, thiserror::Error)]
pub enum OpenError {
    /// There is no terminal to draw on.
    #[error("{0}")]
    NoTerminal(&'static str),
    /// A scenario makes no sense.
    #[error(transparent)]
    Scenario(#[from] ScenarioError),
    /// The terminal failed.
    #[error("the terminal failed: {0}")]
    Failed(#[from] io::Error),
    /// Changes that were to be there again next time are not.
    #[error("the changes cannot be kept: {0}")]
    NotKept(io::Error),
}

impl OpenError {
    /// 1 for failures, 2 for what was asked in vain.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Failed(_) | Self::NotKept(_) => 1,
            Self::NoTerminal(_) | Self::Scenario(_) => 2,
        }
    }
}

/// Opens the app and stays until the person leaves, or a guest has touched no key for so long.
pub(crate) fn run(
    sources: &[String],
    flags: &AppFlags,
    guest: Option<Duration>,
) -> Result<ExitCode, OpenError> {
    if !(io::stdin().is_terminal() && io::stdout().is_terminal()) {
        return Err(OpenError::NoTerminal(
            "The app needs a terminal for input and output. Try `ssh -t`, or\n\
             `contrecoup run paper-300n` for results without one.",
        ));
    }
    let env = |name: &str| std::env::var(name).ok();
    let config = if guest.is_some() {
        guest::confine()?;
        Config { idle: false, ..Config::default() }
    } else {
        Config::load()?
    };
    let Some(depth) = depth(flags.color.unwrap_or(config.color), env) else {
        return Err(OpenError::NoTerminal(
            "The app needs a terminal that can move its cursor, and TERM says `dumb`.\n\
             `contrecoup run paper-300n` works without one.",
        ));
    };
    let symbols = symbols(flags.symbols.or(config.symbols), env);
    let palette = Palette { light: config.ground.is_light(env), own: config.colours };
    let look = Look { depth, symbols, heat: config.heat, palette };
    // Who asks for something, or wants one screen always, goes on from nowhere.
    let first = config.first_screen();
    let goes_on = guest.is_none() && first.is_none();
    let mut app =
        if goes_on && sources.is_empty() { resume(look)? } else { prepare(sources, look)? };
    app.model.goes_on = goes_on && saved_session::can_be_kept();
    if guest.is_some() {
        welcome(&mut app.model, sources)?;
    }
    if sources.is_empty() {
        let picker = Picker { first: true, ..Picker::at(&app.model.choices, "") };
        app.model.overlay = Some(Overlay::Picker(picker));
    }
    app.model.mouse = flags.mouse || config.mouse;
    app.model.idle = config.idle;
    app.model.keys = config.keys;
    // Several that were given are compared.
    if let Some(screen) = first.filter(|_| sources.len() < 2) {
        app.show(screen);
    }
    let fps = flags.fps.unwrap_or(config.fps);
    let settings = terminal::Settings { fps, fail_on: flags.fail_on, guest_limit: guest };
    let (code, app) = terminal::run(app, &settings)?;
    // Where nothing was changed, the next start asks again: no reason to fail now.
    if app.model.goes_on
        && let Err(error) = saved_session::write(&SavedSession::of(&app))
        && app.model.is_edited()
    {
        return Err(OpenError::NotKept(error));
    }
    Ok(ExitCode::from(code))
}

/// The app, going on where the app was left, which stands on top of what can be opened.
fn resume(look: Look) -> Result<App, ScenarioError> {
    let (saved, changed) = match saved_session::read() {
        Ok(Some(saved)) => saved,
        nothing => {
            let mut app = prepare(&[], look)?;
            if let Err(error) = nothing {
                app.model.notice = Some(format!("where you left off cannot be read: {error}"));
            }
            return Ok(app);
        }
    };
    let screen = saved.screen();
    let opened = prepare(std::slice::from_ref(&saved.source), look);
    let gone = opened.is_err();
    let mut app = opened.or_else(|_| prepare(&[], look))?;
    let source = quoted(&saved.source);
    if gone {
        app.model.notice = Some(format!("cannot be opened any more: {source}"));
    }
    if let Some(changed) = changed {
        app.model.work.scenario = changed;
        if gone {
            app.model.notice = Some(format!("what you made of {source} is here: Ctrl-S saves it"));
            app.model.work.source = saved.source;
            app.model.work.original = None;
        }
    }
    app.show(screen);
    let work = &app.model.work;
    let name = work.original.as_ref().map(|of| called(work.name(), of, &work.scenario));
    let name = name.unwrap_or_else(|| work.name().to_owned());
    let last = Choice { name, scenario: Ok(work.scenario.clone()), origin: LAST };
    app.model.choices.insert(0, last);
    Ok(app)
}

/// Leaves of what can be opened what is for guests.
fn welcome(model: &mut AppModel, sources: &[String]) -> Result<(), ScenarioError> {
    model.guest = true;
    for choice in &mut model.choices {
        if let Ok(Err(why)) = choice.scenario.as_ref().map(guest::allowed) {
            if sources.contains(&choice.name) {
                return Err(Problem::new("", why).of(&choice.name).into());
            }
            choice.scenario = Err(why);
        }
    }
    Ok(())
}

/// A preset or file, and the speed or force behind an `@`.
fn with_speed(typed: &str) -> (&str, Option<&str>) {
    let is_number = |text: &str| text.starts_with(|c: char| c.is_ascii_digit());
    match typed.rsplit_once('@').filter(|(_, speed)| is_number(speed)) {
        Some((source, speed)) if !Path::new(typed).is_file() => (source, Some(speed)),
        _ => (typed, None),
    }
}

/// The app, working on the first of the sources and comparing them if there are several.
///
/// # Errors
/// Where a source makes no sense.
pub fn prepare(sources: &[String], look: Look) -> Result<App, ScenarioError> {
    let first = [FIRST.to_owned()];
    let sources = if sources.is_empty() { &first[..] } else { sources };
    let mut choices = choices();
    let mut works = Vec::new();
    for typed in sources {
        let (source, speed) = with_speed(typed);
        let scenario = resolve(source)?;
        if !choices.iter().any(|choice| choice.name == *source) {
            let scenario = Ok(scenario.clone());
            let choice = Choice { name: source.to_owned(), scenario, origin: "file" };
            choices.insert(works.len().min(choices.len()), choice);
        }
        let mut work = Work::fresh(source, &scenario);
        if let (Some(speed), Some(field)) = (speed, strength(&scenario).field()) {
            set(&mut work.scenario, field.path, speed)?;
        }
        works.push(work);
    }
    let work = works[0].clone();
    let form = ScenarioForm { selected: strength(&work.scenario), ..ScenarioForm::default() };
    let mut model = AppModel { work, form, choices, look, idle: true, ..AppModel::default() };
    let mut screens: Vec<_> = SCREENS.iter().map(|about| (about.new)()).collect();
    for screen in &mut screens {
        screen.opened_on(&mut model, &works);
    }
    Ok(App { model, screens, screen: 0, dragging: false })
}
