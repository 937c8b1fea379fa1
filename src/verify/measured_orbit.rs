//! The experiments of an eye in its orbit run again in one of its real shape, in three dimensions.
//!
//! The fit of the fat was made with a round rim, the mean of an orbit. Here its two experiments are
//! run with several moduli at the measured rim; the baseball, which was shot at eyes in gelatin, is
//! run in both orbits, since a holder in gelatin as wide as it is not in that eye.
//!
//! Left out: finer meshes, which take minutes, and second runs for the step error.

use crate::answer::compiled::Compiled;
use crate::run::{kept::Keep, refusal::Refusal, watch::unwatched};
use crate::scenario::{Geometry, Model, Physiological, Support};
use crate::verify::{experiments::EXPERIMENTS, experiments::Experiment, fit::misfit_of};
use crate::verify::{rerun::fitted, rerun::read_run, rerun::with_fat};
use rayon::prelude::*;

/// The bulk moduli of fat that are tried, in `MPa`.
pub const FATS_MPA: [f64; 5] = [0.2, 0.3, 0.4, 0.5, 0.6];
/// The orbits that a ball is run in: round and measured.
pub const ORBITS: [Geometry; 2] = [Geometry::Axisymmetric, Geometry::Full];
/// The rows that are no impactor's.
const BALLS: [&str; 2] = ["baseball-whole", "baseball-burst"];

/// One experiment in several orbits, in the unit of its reading; or why there is no figure.
pub type Row<const N: usize> = (&'static Experiment, [Result<f64, String>; N]);

/// What they give, on mesh level 1.
#[derive(Debug, Clone)]
pub struct InOrbit {
    /// The fitted experiments, with each of [`FATS_MPA`].
    pub fitted: Vec<Row<{ FATS_MPA.len() }>>,
    /// The others, in each of [`ORBITS`].
    pub others: Vec<Row<{ ORBITS.len() }>>,
}

impl InOrbit {
    /// Runs them all.
    pub fn run() -> Self {
        let (fitted, others) = rayon::join(
            || each(fitted(), FATS_MPA.map(|mpa| (mpa, Geometry::Full))),
            || {
                let balls = EXPERIMENTS.iter().filter(|e| BALLS.contains(&e.key));
                let taken = Physiological::default().fat_bulk_mpa;
                each(balls, ORBITS.map(|orbit| (taken, orbit)))
            },
        );
        Self { fitted, others }
    }

    /// The sum of squared misfits of each of [`FATS_MPA`], as the fit has it.
    pub fn misfits(&self) -> [f64; FATS_MPA.len()] {
        std::array::from_fn(|i| {
            let of = |(experiment, values): &Row<_>| misfit_of(experiment, &values[i]);
            self.fitted.iter().map(of).sum()
        })
    }
}

/// Each experiment with each modulus and orbit.
fn each<const N: usize>(
    experiments: impl Iterator<Item = &'static Experiment>,
    cases: [(f64, Geometry); N],
) -> Vec<Row<N>> {
    let row = |experiment: &'static Experiment| {
        (experiment, cases.map(|(mpa, orbit)| figure(experiment, mpa, orbit)))
    };
    experiments.collect::<Vec<_>>().into_par_iter().map(row).collect()
}

fn figure(experiment: &Experiment, mpa: f64, orbit: Geometry) -> Result<f64, String> {
    let mut scenario = with_fat((experiment.scenario)(), mpa);
    if let Model::Physiological(model) = &mut scenario.model {
        model.support = Support::Orbit;
    }
    scenario.numerics.geometry = orbit;
    let run = || -> Result<_, Refusal> {
        let scenario = scenario.check()?;
        let case = Compiled::new(&scenario);
        let keep = Keep { traces: true, frames: None };
        let run = case.run(&case.plan_alone(&scenario)?, keep, &mut unwatched)?;
        Ok((case, run))
    };
    let (case, run) = run().map_err(|refusal| refusal.to_string())?;
    read_run(experiment, &case, &run)
}
