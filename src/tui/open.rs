//! Opening the app: what is worked on first, and what can be opened later.

use std::io::{self, IsTerminal};
use std::process::ExitCode;

use clap::Args;

use super::config::Config;
use super::model::{Choice, Look, Model, Work};
use super::screens::SCREENS;
use super::terminal;
use super::terminal::caps::{ColorFlag, Symbols, depth, symbols};
use super::update;
use crate::scenario::library::{self, Origin, resolve};
use crate::scenario::problem::ScenarioError;

/// What is opened if nothing is asked for.
const FIRST: &str = "paper-300n";

/// What the app is opened on, and how.
#[derive(Debug, Args)]
pub struct Options {
    /// Presets or files; several are marked for comparison
    #[arg(value_name = "PRESET|FILE.ron")]
    pub sources: Vec<String>,
    /// How it looks and listens.
    #[command(flatten)]
    pub flags: AppFlags,
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
}

impl OpenError {
    /// 1 for failures, 2 for what was asked in vain.
    pub fn exit_code(&self) -> u8 {
        match self {
            Self::Failed(_) => 1,
            Self::NoTerminal(_) | Self::Scenario(_) => 2,
        }
    }
}

/// Opens the app and stays until the person leaves.
///
/// # Errors
/// Where there is no terminal, a scenario makes no sense, or the terminal fails.
pub fn run(sources: &[String], flags: &AppFlags) -> Result<ExitCode, OpenError> {
    if !(io::stdin().is_terminal() && io::stdout().is_terminal()) {
        return Err(OpenError::NoTerminal(
            "The app needs a terminal for input and output. Try `ssh -t`, or\n\
             `contrecoup run paper-300n` for results without one.",
        ));
    }
    let env = |name: &str| std::env::var(name).ok();
    let config = Config::load()?;
    let Some(depth) = depth(flags.color.unwrap_or(config.color), env) else {
        return Err(OpenError::NoTerminal(
            "The app needs a terminal that can move its cursor, and TERM says `dumb`.\n\
             `contrecoup run paper-300n` works without one.",
        ));
    };
    let look = Look {
        depth,
        symbols: symbols(flags.symbols.or(config.symbols), env),
    };
    let mut model = prepare(sources, look)?;
    model.mouse = flags.mouse || config.mouse;
    model.idle = config.idle;
    model.keys = config.keys;
    // Several that were given are compared.
    if sources.len() < 2 {
        update::show(&mut model, config.start);
    }
    let settings = terminal::Settings {
        fps: flags.fps.unwrap_or(config.fps),
        fail_on: flags.fail_on,
    };
    let code = terminal::run(model, &settings)?;
    Ok(ExitCode::from(code))
}

/// A model that works on the first of the sources and compares them if there are several.
///
/// # Errors
/// Where a source makes no sense.
pub fn prepare(sources: &[String], look: Look) -> Result<Model, ScenarioError> {
    let first = [FIRST.to_owned()];
    let sources = if sources.is_empty() {
        &first[..]
    } else {
        sources
    };
    let mut choices = choices();
    let mut works = Vec::new();
    for source in sources {
        let scenario = resolve(source)?;
        if !choices.iter().any(|choice| choice.name == *source) {
            choices.insert(
                works.len().min(choices.len()),
                Choice {
                    name: source.clone(),
                    scenario: Ok(scenario.clone()),
                    origin: "file",
                },
            );
        }
        works.push(Work::fresh(source, &scenario));
    }
    let mut model = Model::new(works[0].clone(), choices, look);
    for (place, screen) in SCREENS.iter().enumerate() {
        (screen.given)(&mut model, place, &works);
    }
    Ok(model)
}

/// Every preset that can be opened; a broken one says why it cannot.
pub fn choices() -> Vec<Choice> {
    let presets = library::list().unwrap_or_default();
    presets
        .into_iter()
        .map(|preset| Choice {
            scenario: preset.scenario().map_err(|error| error.to_string()),
            origin: match preset.origin {
                Origin::BuiltIn(_) => "",
                Origin::User(_) => "own",
            },
            name: preset.name,
        })
        .collect()
}
