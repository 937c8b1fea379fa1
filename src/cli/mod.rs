//! The command line: what can be typed, and which function answers it.
//!
//! Exit codes: 0 done, 1 failed, 2 bad input, 130 interrupted. A reader that closes the pipe early
//! is no failure.
//!
//! Left out: the answers themselves, and the meaning of a field's value, which the registry of
//! fields decides for files, flags and forms alike.

mod arguments;
mod error;
mod export;
mod generate;
mod guide;
mod interrupt;
mod many;
mod output;
mod presets;
mod progress;
mod run;
mod sweep;
mod verify;

use std::io::{self, BufWriter, Write};
use std::path::PathBuf;
use std::process::ExitCode;
use std::sync::LazyLock;

use clap::{Args, Parser, Subcommand};
use serde::Serialize;

use crate::cli::arguments::{ScenarioArgs, ScenariosArgs, whole};
use crate::cli::{error::CliError, output::Output, sweep::Shard};
use crate::many::{ensemble::FEWEST_SAMPLES, ensemble::MAX_SAMPLES, sweep::SweepAxis};
use crate::models::kernel_name;
use crate::plain_text::{printable_path, write_json};
use crate::tui::{self, config, config::Config};

/// Simulate a blow to a human eye.
#[derive(Debug, Parser)]
#[command(
    version,
    long_version = long_version(),
    after_help = "Research and education, not diagnosis.",
    args_conflicts_with_subcommands = true
)]
pub struct Cli {
    // The app opens without a command.
    #[command(flatten)]
    flags: tui::AppFlags,
    #[command(subcommand)]
    command: Option<Command>,
}

/// The end of a command's help: how it may be typed.
fn example(command: &str) -> String {
    format!("Example:\n  contrecoup {command}")
}

/// What a report of a fault needs: version, commit and the vectors that compute on this machine.
fn long_version() -> &'static str {
    static TEXT: LazyLock<String> = LazyLock::new(|| {
        // Whoever builds says which commit it is; a package of the registry has none.
        let commit = crate::report::commit().unwrap_or("not recorded");
        let version = env!("CARGO_PKG_VERSION");
        format!("{version} (commit {commit}, kernel {})", kernel_name(false))
    });
    &TEXT
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Open the terminal app: what no command at all does too
    #[command(after_help = example("tui paper-300n bb-56 --mouse"))]
    Tui(tui::Options),
    /// Simulate one blow and print the results
    #[command(after_help = example("run squash-ball --set speed=30\n  contrecoup run squash-ball --all"))]
    Run(RunArgs),
    /// Print the settings of the app, with what each does and may be
    #[command(after_help = example("config > contrecoup.ron"))]
    Config,
    /// List the presets, or show one
    #[command(after_help = example("presets show bb-56"))]
    Presets(PresetsArgs),
    /// Simulate one blow and write its frames and traces to files
    #[command(after_help = example("export paper-300n --frames frames.csv --traces traces.csv"))]
    Export(ExportArgs),
    /// Measure total error against time: mesh levels, integrators and steps, and the cheapest for
    /// a tolerance
    #[command(after_help = example("accuracy paper-300n --finest-level 3"))]
    Accuracy(AccuracyArgs),
    /// Check what is claimed: errors in random scenes, hard cases, published experiments
    #[command(after_help = example("verify steps --scenes 20"))]
    Verify(verify::VerifyArgs),
    /// Simulate several blows and print them side by side
    #[command(after_help = example("compare paintball@80 bb-62@60 shuttlecock@30 --sort hyphema"))]
    Compare(CompareArgs),
    /// Write a page of one blow or several, to read, print and send
    #[command(after_help = example("report bb-56 paintball --output balls.html"))]
    Report(ReportArgs),
    /// Run many samples over what is not known of the inputs: median, band and what drives it
    #[command(after_help = example(r#"ensemble squash-ball --set impact.speed_m_s="40 +- 5""#))]
    Ensemble(EnsembleArgs),
    /// Run a grid over some fields, in shards for a cluster, and go on after a kill
    Sweep(SweepArgs),
    /// Find the speed, force or other input at which a result reaches a value
    #[command(after_help = example(r#"threshold champagne-cork --until "globe rupture = 50""#))]
    Threshold(ThresholdArgs),
    /// Read the guide: keys, glossary, accuracy, evidence and more; lists its topics by itself
    #[command(after_help = example("guide accuracy"))]
    Guide {
        /// The topic
        #[arg(value_parser = guide::topics())]
        topic: Option<String>,
    },
    /// Print the manual page, or a script that completes commands in a shell
    #[command(after_help = example("generate completions bash"))]
    Generate {
        #[command(subcommand)]
        what: generate::GenerateCommand,
    },
}

#[derive(Debug, Args)]
#[expect(clippy::struct_excessive_bools, reason = "each is a flag of its own")]
struct RunArgs {
    #[command(flatten)]
    scenario: ScenarioArgs,
    /// Choose the cheapest mesh, integrator and step that give the damage index within P percent,
    /// step and mesh together
    #[arg(long, value_name = "P", value_parser = arguments::percent, allow_negative_numbers = true,
          conflicts_with_all = ["level", "integrator", "step_us"])]
    tolerance: Option<f64>,
    /// Leave out the mesh error of the Paper model, which takes two finer meshes
    #[arg(long)]
    quick: bool,
    /// Tell the mesh error of an eye of cells too: by two finer meshes, 10 to 50 times as long
    #[arg(long, conflicts_with = "quick")]
    meshes: bool,
    /// Print every result with its errors, what it rests on and how it was computed
    #[arg(long, conflicts_with = "json")]
    all: bool,
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Args)]
struct AccuracyArgs {
    #[command(flatten)]
    scenario: ScenarioArgs,
    /// Finest mesh level that is tried, whose error needs two more [default: 4, or 3 of the model
    /// Physiological]
    #[arg(long, value_name = "K", value_parser = whole(1, 8))]
    finest_level: Option<u32>,
    /// The result whose error is told [default: the peak pressure where there is one, else the
    /// damage index]
    #[arg(long, value_name = "RESULT")]
    result: Option<String>,
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Args)]
#[command(group = clap::ArgGroup::new("files").required(true).multiple(true))]
struct ExportArgs {
    #[command(flatten)]
    scenario: ScenarioArgs,
    /// Write position and force of every node in every frame to this CSV file, replacing it; of an
    /// eye in three dimensions those of its section along the blow
    #[arg(long, value_name = "FILE", group = "files")]
    frames: Option<PathBuf>,
    /// Write node forces, displacement, growth and energies at every step to this CSV file,
    /// replacing it
    #[arg(long, value_name = "FILE", group = "files")]
    traces: Option<PathBuf>,
    /// Time between two frames, in microseconds [default: 10]
    #[arg(long, value_name = "X", value_parser = arguments::positive, allow_negative_numbers = true)]
    every_us: Option<f64>,
}

#[derive(Debug, Args)]
struct EnsembleArgs {
    /// What to simulate. Doubt in an input is written `--set impact.force_n="300 +- 20"`.
    #[command(flatten)]
    scenario: ScenarioArgs,
    /// How many samples: more of them make steadier bands
    #[arg(long, value_name = "N", default_value_t = 64, value_parser = whole(FEWEST_SAMPLES, MAX_SAMPLES))]
    samples: u32,
    /// Which samples: a seed gives the same ones for good
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u32,
    /// The result of which to print what drives it; JSON has all
    #[arg(long, value_name = "RESULT", default_value = "damage_percent")]
    drives: String,
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Args)]
#[command(after_help = SWEEP_HELP)]
struct SweepArgs {
    #[command(flatten)]
    scenario: ScenarioArgs,
    /// Vary a field: from, to and how many values, or a list; may be repeated for a grid, of which
    /// the last one runs fastest
    #[arg(long, value_name = "FIELD=FROM:TO:N|FIELD=A,B,C", required = true, value_parser = SweepAxis::read)]
    vary: Vec<SweepAxis>,
    /// Only the rows r with r mod N = I - 1; all N shards together are the whole
    #[arg(long, value_name = "I/N", default_value = "1/1", value_parser = Shard::read)]
    shard: Shard,
    /// Append to this file, and go on where an earlier run of the same command ended
    #[arg(long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// Print CSV: the default
    #[arg(long, conflicts_with = "json")]
    csv: bool,
    /// Print one JSON object a line instead of CSV
    #[arg(long)]
    json: bool,
}

const SWEEP_HELP: &str = "\
Example:
  contrecoup sweep paper-300n --vary impact.force_n=50:500:40

Job arrays: each task takes its own shard and file; the shell fills in the number.
  Slurm:         sbatch --array=1-8 --wrap 'contrecoup sweep paper-300n \\
                   --vary impact.force_n=50:500:40 \\
                   --shard $SLURM_ARRAY_TASK_ID/8 --out part-$SLURM_ARRAY_TASK_ID.csv'
  GNU parallel:  parallel contrecoup sweep paper-300n --vary impact.force_n=50:500:40 \\
                   --shard {}/8 --out part-{}.csv ::: $(seq 8)
Together:        grep -hv '^[#r]' part-*.csv | sort -t, -k1,1n";

#[derive(Debug, Args)]
struct CompareArgs {
    #[command(flatten)]
    scenarios: ScenariosArgs,
    /// Sort by this result, the largest first
    #[arg(long, value_name = "RESULT")]
    sort: Option<String>,
    /// Print Markdown
    #[arg(long, conflicts_with_all = ["csv", "json"])]
    md: bool,
    /// Print CSV: every result with its errors
    #[arg(long, conflicts_with = "json")]
    csv: bool,
    /// Print JSON
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Args)]
struct ReportArgs {
    #[command(flatten)]
    scenarios: ScenariosArgs,
    /// The file to write or replace: a page if it ends in .html, words and tables in .md, a
    /// picture in .svg
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
}

#[derive(Debug, Args)]
struct ThresholdArgs {
    #[command(flatten)]
    scenario: ScenarioArgs,
    /// The field to vary, over all that it may be or from one value to another [default: the speed
    /// of an object, the force of a pulse]
    #[arg(long, value_name = "FIELD|FIELD=FROM:TO")]
    vary: Option<String>,
    /// The result and the value that it is to reach, as in `hyphema_percent = 50` [default:
    /// `globe_rupture_percent = 50`, or `damage_percent = 50` of the Paper model]
    #[arg(long, value_name = "RESULT = VALUE")]
    until: Option<String>,
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
}

#[derive(Debug, Args)]
#[command(args_conflicts_with_subcommands = true)]
struct PresetsArgs {
    /// Print JSON instead of text
    #[arg(long)]
    json: bool,
    #[command(subcommand)]
    command: Option<PresetsCommand>,
}

#[derive(Debug, Subcommand)]
enum PresetsCommand {
    /// Print the file of one preset as it stands
    #[command(after_help = example("presets show bb-56"))]
    Show {
        /// Its name
        name: String,
    },
}

/// Reads the arguments, answers, and says how it went.
pub fn main() -> ExitCode {
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) => {
            let code = u8::try_from(error.exit_code()).unwrap_or(2);
            let is_help = !error.use_stderr();
            return match arguments::explain(error) {
                // What was asked for is lost.
                Ok(()) if is_help && output::is_closed() => ExitCode::FAILURE,
                // Nobody is left to hear about a closed pipe.
                Err(failed) if failed.kind() != io::ErrorKind::BrokenPipe => ExitCode::FAILURE,
                _ => ExitCode::from(code),
            };
        }
    };
    let outcome = match &cli.command {
        None => tui::run(&[], &cli.flags, None).map_err(CliError::from),
        Some(Command::Tui(options)) => {
            let guest = options.guest.then_some(options.idle_minutes);
            tui::run(&options.sources, &options.flags, guest).map_err(CliError::from)
        }
        Some(command) => answer(command).map(|()| ExitCode::SUCCESS),
    };
    outcome.unwrap_or_else(|error| {
        if !error.is_broken_pipe() {
            let _ = writeln!(io::stderr(), "{error}");
        }
        ExitCode::from(error.exit_code())
    })
}

fn answer(command: &Command) -> Result<(), CliError> {
    interrupt::outlive_file_limit()?;
    let out = &mut BufWriter::new(Output::open());
    match command {
        // The app has been run already.
        Command::Tui(_) => Ok(()),
        Command::Run(args) => run::run(args, out),
        Command::Export(args) => export::run(args, out),
        Command::Verify(args) => verify::run(args, out),
        Command::Config => print_config(out),
        Command::Presets(args) => presets::run(args, out),
        Command::Accuracy(args) => many::measure(args, out),
        Command::Ensemble(args) => many::draw(args, out),
        Command::Compare(args) => many::compare(args, out),
        Command::Report(args) => many::write_page(args, out),
        Command::Sweep(args) => sweep::run(args, out),
        Command::Threshold(args) => many::search(args, out),
        Command::Guide { topic } => guide::run(topic.as_deref(), out),
        Command::Generate { what } => generate::run(what, out),
    }?;
    Ok(out.flush()?)
}

/// Prints the settings of the app as a file that may be changed and kept.
fn print_config(out: &mut dyn Write) -> Result<(), CliError> {
    let config = Config::load()?;
    // Kept in a file, this line must stay true: it says where the file belongs, not whether it is.
    let place = config::path().map(|path| {
        let path = printable_path(&path);
        format!("// Read at every start, where it is there, from {path}.\n")
    });
    Ok(write!(out, "{}{}", place.unwrap_or_default(), config.to_ron())?)
}

/// Prints an answer as JSON where that is given, else as text.
fn print(
    out: &mut dyn Write,
    json: Option<impl Serialize>,
    text: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    match json {
        Some(json) => write_json(out, &json),
        None => text(out),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clap::CommandFactory;

    #[test]
    fn there_are_few_commands_and_the_help_of_each_ends_with_one_that_can_be_typed() {
        let mut program = Cli::command();
        program.clone().debug_assert();
        program.build();
        assert!(program.get_subcommands().count() <= 15);
        let of = |command: &clap::Command| {
            let all = command.get_subcommands().cloned();
            all.filter(|command| command.get_name() != "help").collect::<Vec<_>>()
        };
        let commands = of(&program);
        for command in commands.iter().cloned().chain(commands.iter().flat_map(of)) {
            let name = command.get_display_name().unwrap().replace('-', " ");
            let help = command.get_after_help().map(ToString::to_string).unwrap_or_default();
            let example = help.lines().find_map(|line| line.trim().strip_prefix("contrecoup "));
            let example = example.unwrap_or_else(|| panic!("{name} has no example"));
            let typed = example.split(" > ").next().unwrap();
            let words = shell_words::split(&format!("contrecoup {typed}")).unwrap();
            assert!(words.join(" ").replace('-', " ").starts_with(&name), "{name}: {example}");
            Cli::try_parse_from(&words).unwrap_or_else(|error| panic!("{example}: {error}"));
        }
    }
}
