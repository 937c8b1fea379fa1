//! `contrecoup verify`: whether what the program claims holds.

use std::io::{self, Write};
use std::ops::ControlFlow;

use clap::{Args, Subcommand, ValueEnum};
use serde_json::Value;

use crate::cli::{CliError, arguments::whole, example, progress::shown};
use crate::report::{claims, experiments, hard_cases as cases, outcome_fit, tissue_fit};
use crate::run::threads;
use crate::verify::clinics::felt::{self, FeltRow};
use crate::verify::clinics::fit::{
    self as clinics, CHOICES, as_ron, first_rows, fitted_rows, study,
};
use crate::verify::{claims::FINEST_CHECKED, claims::Study, claims::check, fit::fit, hard_cases};
use crate::verify::{hard_cases::CaseVerdict, measured_orbit::InOrbit, rerun::rerun_all};
use crate::verify::{scenes::MAX_SCENES, scenes::Scenes, tissue_fit::fit_tissues};

#[derive(Debug, Args)]
pub struct VerifyArgs {
    #[command(subcommand)]
    what: VerifyCommand,
    /// Print JSON instead of text
    #[arg(long, global = true)]
    json: bool,
}

#[derive(Debug, Subcommand)]
enum VerifyCommand {
    /// Stated step errors, in random pulses, against a hundred times as many steps
    #[command(after_help = example("verify steps --scenes 20"))]
    Steps(SceneArgs),
    /// Stated mesh errors, in random pulses that fold on no mesh, against the finest mesh
    #[command(after_help = example("verify meshes --level 2 --scenes 20"))]
    Meshes {
        #[command(flatten)]
        scenes: SceneArgs,
        /// Level of the answers
        #[arg(long, value_name = "K", default_value_t = 1, value_parser = whole(1, FINEST_CHECKED))]
        level: u32,
    },
    /// Whether answers of `run --tolerance P` are within P, for several P, in as many such pulses
    #[command(after_help = example("verify tolerance --scenes 10 --json"))]
    Tolerance(SceneArgs),
    /// Stated step errors, or mesh errors, of random objects at the Physiological model
    #[command(after_help = example("verify objects --scenes 5"))]
    Objects {
        #[command(flatten)]
        scenes: SceneArgs,
        /// Check mesh errors of answers at this level, in place of step errors
        #[arg(long, value_name = "K", value_parser = whole(1, FINEST_CHECKED))]
        level: Option<u32>,
    },
    /// The same of random objects from the side, at the eye in three dimensions, and whether a flag
    /// says of each mesh that folds that it does: ten seconds of one core a scene
    #[command(after_help = example("verify sides --scenes 5"))]
    Sides {
        #[command(flatten)]
        scenes: SceneArgs,
        /// Check mesh errors of level 1 against level 3, in place of step errors: half a minute a
        /// scene
        #[arg(long)]
        meshes: bool,
    },
    /// Cases made to break simulations, each against references: what the program says of them
    #[command(after_help = example("verify hard-cases"))]
    HardCases,
    /// Published experiments run again: what was measured beside what the model gives
    #[command(after_help = example("verify experiments --json"))]
    Experiments,
    /// The fits repeated: points of 50 % to what clinics counted, with the score of every row,
    /// fitted and with its kind left out; the laboratory's points; or the bulk modulus of orbital
    /// fat
    #[command(after_help = example("verify fit"))]
    Fit {
        /// Which fit
        #[arg(default_value = "clinics")]
        what: WhichFit,
        /// Compute again what tissues felt of every kind of object, and print it as the table that
        /// the fit reads: a quarter of an hour of two cores
        #[arg(long)]
        rerun: bool,
        /// Print the points of 50 % as the table that ships
        #[arg(long, conflicts_with = "rerun")]
        points: bool,
    },
}

#[derive(Debug, Clone, Copy, ValueEnum)]
enum WhichFit {
    /// Points of 50 % by kind of object to what clinics counted
    Clinics,
    /// The laboratory's points, by the objects behind published curves
    Laboratory,
    /// The bulk modulus of orbital fat
    Fat,
}

#[derive(Debug, Args)]
struct SceneArgs {
    /// How many scenes
    #[arg(long, value_name = "N", default_value_t = 200,
          value_parser = whole(1, MAX_SCENES))]
    scenes: u32,
    /// Which scenes: a seed gives the same ones for good
    #[arg(long, value_name = "S", default_value_t = 1)]
    seed: u32,
}

pub fn run(args: &VerifyArgs, out: &mut dyn Write) -> Result<(), CliError> {
    if !threads::pool_is_there() {
        let why = "no thread can start here, and this check takes many";
        return Err(CliError::Failed(why.to_owned()));
    }
    let (study, scenes) = match &args.what {
        VerifyCommand::Steps(scenes) => (Study::Steps(Scenes::Pulses), scenes),
        VerifyCommand::Meshes { scenes, level } => (Study::Meshes(Scenes::Pulses, *level), scenes),
        VerifyCommand::Tolerance(scenes) => (Study::Tolerances, scenes),
        VerifyCommand::Objects { scenes, level: None } => (Study::Steps(Scenes::Objects), scenes),
        VerifyCommand::Objects { scenes, level: Some(level) } => {
            (Study::Meshes(Scenes::Objects, *level), scenes)
        }
        VerifyCommand::Sides { scenes, meshes: false } => (Study::Steps(Scenes::Sides), scenes),
        VerifyCommand::Sides { scenes, meshes: true } => (Study::Meshes(Scenes::Sides, 1), scenes),
        VerifyCommand::HardCases => {
            let outcomes =
                shown(|progress| hard_cases::run(&|share| progress.show("hard cases", share)));
            print(args, &outcomes[..], cases::json, cases::text, out)?;
            out.flush()?;
            let wrong = outcomes.iter().filter(|outcome| outcome.verdict == CaseVerdict::Wrong);
            let names: Vec<&str> = wrong.map(|outcome| outcome.name).collect();
            if names.is_empty() {
                return Ok(());
            }
            return Err(CliError::Failed(format!("silently wrong: {}", names.join(", "))));
        }
        VerifyCommand::Experiments => {
            let rerun = rayon::join(rerun_all, InOrbit::run);
            return print(args, &rerun, experiments::json, experiments::text, out);
        }
        VerifyCommand::Fit { rerun: true, .. } => {
            let rows = shown(|progress| felt::rerun(|share| progress.show("computing", share)));
            return felt_table(&rows, out);
        }
        VerifyCommand::Fit { points: true, .. } => {
            let fitted = clinics::fit(&felt::stored(), fitted_rows(), CHOICES);
            return Ok(write!(out, "{}", as_ron(&fitted.table()))?);
        }
        VerifyCommand::Fit { what: WhichFit::Clinics, .. } => {
            let felt = felt::stored();
            let studies =
                [study(&felt, &first_rows(), CHOICES), study(&felt, &fitted_rows(), CHOICES)];
            return print(args, &studies, outcome_fit::json, outcome_fit::text, out);
        }
        VerifyCommand::Fit { what: WhichFit::Laboratory, .. } => {
            let fits = shown(|progress| fit_tissues(|share| progress.show("fitting", share)));
            return print(args, &fits[..], tissue_fit::json, tissue_fit::text, out);
        }
        VerifyCommand::Fit { what: WhichFit::Fat, .. } => {
            let fit = shown(|progress| fit(|share| progress.show("fitting", share)));
            return print(args, &fit, experiments::fit_json, experiments::fit_text, out);
        }
    };
    let (count, seed) = (scenes.scenes, scenes.seed);
    let found = shown(|progress| {
        if study.scenes() == Scenes::Sides {
            // Of one core, for each scene.
            let each = if matches!(study, Study::Meshes(..)) { 0.5 } else { 0.15 };
            let minutes = format!("some {:.0} minutes of one core", f64::from(count) * each);
            progress.announce(&format!("checking {count} scenes, {minutes} ..."));
        }
        check(study, count, seed, &|share| {
            progress.show("checking scenes", share);
            ControlFlow::Continue(())
        })
    })?;
    print(args, &found, claims::json, claims::text, out)
}

/// Prints what tissues felt as CSV.
fn felt_table(rows: &[FeltRow], out: &mut dyn Write) -> Result<(), CliError> {
    let mut table = csv::Writer::from_writer(out);
    let written = rows.iter().try_for_each(|row| table.serialize(row));
    written.map_err(io::Error::from)?;
    Ok(table.flush()?)
}

fn print<T: ?Sized>(
    args: &VerifyArgs,
    found: &T,
    json: fn(&T) -> Value,
    text: fn(&T, &mut dyn Write) -> io::Result<()>,
    out: &mut dyn Write,
) -> Result<(), CliError> {
    Ok(super::print(out, args.json.then(|| json(found)), |out| text(found, out))?)
}
