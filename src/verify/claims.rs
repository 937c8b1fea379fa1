//! Whether what is stated of an answer holds: many random scenes, each against a reference.
//!
//! What is stated is a step error, a mesh error, or that the damage index is within a tolerance
//! that was asked for. A scene whose mesh folds promises nothing and is counted apart, and so is
//! an object that goes through the eye. The finest mesh, with which mesh errors and tolerances are
//! compared, is not the limit itself: it may be off by what fine levels scatter by.

use crate::answer::choose::{Ladder, within};
use crate::answer::mesh_error::{MeshError, OnMesh, at_level, witnesses};
use crate::answer::{results::Results, solve::solve};
use crate::many::statistics::median;
use crate::run::watch::unwatched;
use crate::run::{flags::FlagKind, kept::Keep, plan::Plan, quantity::Quantity, refusal::Refusal};
use crate::scenario::{FINEST_LEVEL, FINEST_SPATIAL_LEVEL, Scenario};
use crate::verify::scenes::{MAX_SCENES, Scenes};
use rayon::prelude::*;
use serde::{Serialize, Serializer};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU32, Ordering};

/// The finest level that can be checked: its witnesses are coarser than the reference.
pub const FINEST_CHECKED: u32 = 5;
/// A balance of energy that is off by more than this many percent must be flagged.
const BALANCE_PERCENT: f64 = 0.5;
/// The tolerances that are asked for, in %.
pub const TOLERANCES: [f64; 5] = [50.0, 20.0, 10.0, 5.0, 2.0];

/// Which claims are checked, and in which scenes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Study {
    /// Step errors, against a run of many times as many steps.
    Steps(Scenes),
    /// Mesh errors of answers at a level, against the finest mesh.
    Meshes(Scenes, u32),
    /// That a tolerance is kept, against the finest mesh.
    Tolerances,
}

/// What a claim is about.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Subject {
    /// The error of a result.
    Result(Quantity),
    /// A tolerance of the damage index, in %.
    Tolerance(f64),
}

impl Serialize for Subject {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Result(quantity) => quantity.key().serialize(to),
            Self::Tolerance(percent) => format!("tolerance_{percent}_percent").serialize(to),
        }
    }
}

/// One claim about an answer, with the true error.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Claim {
    /// What it is about.
    pub subject: Subject,
    /// The error that is claimed at most, in %; none where the program claims nothing.
    #[serde(rename = "claimed_percent")]
    pub claimed: Option<f64>,
    /// The true error, in %; none where there is no answer.
    #[serde(rename = "true_percent")]
    pub truth: Option<f64>,
    /// Of a tolerance: elements computed for the answer, over those of a run at level 1.
    #[serde(rename = "cost_over_level_1")]
    pub cost: Option<f64>,
}

impl Claim {
    /// Whether a claim is not true. A true error that is no number keeps no promise.
    fn fails(&self) -> bool {
        let both = self.claimed.zip(self.truth);
        both.is_some_and(|(claimed, truth)| truth.is_nan() || truth > claimed)
    }
}

/// What is wrong with a scene.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Fault {
    /// A mesh folded, and the answer says so.
    Folded,
    /// The reference of a step error folded, and the answer does not say that it may.
    FoldedUnflagged,
    /// The object went through.
    WentThrough,
    /// The motion left the finite numbers, which is refused.
    NotFinite,
    /// A result is no number, and nothing says so.
    NoNumber,
    /// The energies are off by more than half a percent, and nothing says so.
    EnergyUnflagged,
}

/// One scene.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Checked {
    /// Number of the scene.
    #[serde(rename = "scene")]
    pub index: u32,
    /// The claims about it; none where a mesh folds, the object goes through or no number is left.
    pub claims: Option<Vec<Claim>>,
    /// What is wrong with it.
    pub faults: Vec<Fault>,
}

/// What many scenes showed for one subject.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Coverage {
    /// What the claims are about.
    pub subject: Subject,
    /// Claims.
    pub claims: usize,
    /// Those of them that do not hold.
    pub misses: usize,
    /// Scenes that promise something, but nothing about this.
    pub without_claim: usize,
    /// Claims that hold, in %.
    #[serde(rename = "within_percent")]
    pub within: Option<f64>,
    /// Median of claimed over true error; where no true error is seen the ratio counts as infinite.
    #[serde(rename = "median_claimed_over_true")]
    pub median_ratio: Option<f64>,
    /// Median true error, in %.
    #[serde(rename = "median_true_percent")]
    pub median_truth: Option<f64>,
    /// Largest true error, in %.
    #[serde(rename = "largest_true_percent")]
    pub largest_truth: Option<f64>,
    /// Median cost.
    #[serde(rename = "median_cost_over_level_1")]
    pub median_cost: Option<f64>,
}

/// What a study found.
#[derive(Debug, Clone, PartialEq)]
pub struct Findings {
    /// The study.
    pub study: Study,
    /// Which random scenes.
    pub seed: u32,
    /// Scenes 0, 1, 2, ...
    pub scenes: Vec<Checked>,
}

/// Checks the claims of `study` in `count` scenes of `seed`, each with its reference, on all
/// threads of the present pool; where mesh errors or tolerances are checked, until `count` promise
/// something. The order and every bit of the result are the same for any number of threads.
/// `watch` is told the share that is done, and may stop the rest.
///
/// # Errors
/// Whatever a scene refuses; none should. [`Refusal::Cancelled`] if the watch stopped it.
pub fn check(
    study: Study,
    count: u32,
    seed: u32,
    watch: &(dyn Fn(f64) -> ControlFlow<()> + Sync),
) -> Result<Findings, Refusal> {
    let done = AtomicU32::new(0);
    let reference = study.reference_level();
    let check_one = |index| {
        let scene = study.scenes().scene(index, seed);
        let mut faults = Vec::new();
        let claims = match study {
            Study::Steps(scenes) => step_errors(&scene, scenes.fineness(), &mut faults),
            Study::Meshes(_, level) => mesh_errors(&scene, level, reference, &mut faults),
            Study::Tolerances => tolerances(&scene, reference),
        };
        let fault = match claims {
            Err(Refusal::WentThrough(_)) => Some(Fault::WentThrough),
            Err(Refusal::NotFinite { .. }) => Some(Fault::NotFinite),
            _ => None,
        };
        let claims = if fault.is_some() { None } else { claims? };
        faults.extend(fault);
        let counts = claims.is_some() || matches!(study, Study::Steps(_));
        let done = done.fetch_add(counts.into(), Ordering::Relaxed) + u32::from(counts);
        match watch(f64::from(done) / f64::from(count)) {
            ControlFlow::Continue(()) => Ok(Checked { index, claims, faults }),
            ControlFlow::Break(()) => Err(Refusal::Cancelled),
        }
    };
    let mut scenes: Vec<Checked> = Vec::new();
    loop {
        let next = scenes.len() as u32;
        // Never more than are missing, so that none is computed in vain.
        let end = MAX_SCENES.min(next + count - done.load(Ordering::Relaxed));
        if end == next {
            return Ok(Findings { study, seed, scenes });
        }
        let block: Result<Vec<_>, _> = (next..end).into_par_iter().map(check_one).collect();
        scenes.extend(block?);
    }
}

impl Study {
    /// The scenes in which it is made.
    pub fn scenes(self) -> Scenes {
        match self {
            Self::Steps(scenes) | Self::Meshes(scenes, _) => scenes,
            Self::Tolerances => Scenes::Pulses,
        }
    }

    /// The level that mesh errors and tolerances are compared with: one that no witness has.
    pub fn reference_level(self) -> u32 {
        match self.scenes() {
            Scenes::Sides => FINEST_SPATIAL_LEVEL,
            Scenes::Pulses | Scenes::Objects => FINEST_LEVEL,
        }
    }
}

/// The claims about one scene; none where nothing is promised.
type Claims = Result<Option<Vec<Claim>>, Refusal>;

/// The claim about each result that has a true error.
fn about_results(claimed: &Results, truth: &Results) -> Vec<Claim> {
    let claim = |(of, truth)| {
        let subject = Subject::Result(of);
        Claim { subject, claimed: claimed[of], truth: Some(truth), cost: None }
    };
    truth.present().map(claim).collect()
}

fn step_errors(scene: &Scenario, fineness: f64, faults: &mut Vec<Fault>) -> Claims {
    let answer = solve(&scene.check()?, Keep::default(), &mut unwatched)?;
    let has = |kind| answer.flags.iter().any(|flag| flag.kind == kind);
    if answer.errors.energy_balance > BALANCE_PERCENT && !has(FlagKind::EnergyImbalance) {
        faults.push(Fault::EnergyUnflagged);
    }
    if has(FlagKind::MeshFolded) {
        faults.push(Fault::Folded);
        return Ok(None);
    }
    if answer.results().present().any(|(_, value)| !value.is_finite()) {
        faults.push(Fault::NoNumber);
    }
    let fine = Plan { multiple: answer.plan.multiple * fineness, ..answer.plan };
    let reference = answer.case.run(&fine, Keep::default(), &mut unwatched)?;
    // An answer that ends with a flat eye says nothing of what comes then.
    if reference.fold.is_some() && !has(FlagKind::EyeFlat) {
        faults.push(Fault::FoldedUnflagged);
    }
    let reference = answer.case.results(&reference);
    let truth = answer.results().difference_percent(&reference);
    Ok(Some(about_results(&answer.errors.time_step, &truth)))
}

fn mesh_errors(scene: &Scenario, level: u32, reference: u32, faults: &mut Vec<Fault>) -> Claims {
    let [coarser, finer] = witnesses(scene, level);
    let mut found: Vec<OnMesh> = Vec::with_capacity(4);
    // The cheap ones first: where one folds the finest mesh need not be moved.
    for level in [level, coarser, finer, reference] {
        let on = at_level(scene, level, &mut unwatched)?;
        if on.folded.is_some() {
            faults.push(Fault::Folded);
            return Ok(None);
        }
        found.push(on);
    }
    let mesh = MeshError::of(scene, level, &found[0], [&found[1], &found[2]]);
    // In % of the answer, as claims are.
    let truth = found[3].results.difference_percent(&found[0].results);
    Ok(Some(about_results(&mesh.errors, &truth)))
}

/// A claim for each tolerance. No answer rests on the reference level.
fn tolerances(scene: &Scenario, reference: u32) -> Claims {
    let scene = &scene.check()?;
    let mut ladder = Ladder::default();
    let [_, finer] = witnesses(scene, 1);
    for level in 1..=finer {
        if ladder.at(scene, level, &mut unwatched)?.folded.is_some() {
            return Ok(None);
        }
    }
    let reference = at_level(scene, reference, &mut unwatched)?;
    let damage = reference.results[Quantity::Damage];
    let Some(exact) = damage.filter(|_| reference.folded.is_none()) else { return Ok(None) };
    let mut claim = |percent| {
        let answered = within(&mut ladder, scene, percent, &mut unwatched);
        let refused = matches!(answered, Err(Refusal::ToleranceNotMet { .. }));
        let chosen = if refused { None } else { Some(answered?) };
        let truth = chosen.as_ref().map(|chosen| {
            let damage = chosen.answer.index().damage();
            100.0 * (damage - exact).abs() / damage.abs()
        });
        let cost = chosen.map(|chosen| chosen.elements / ladder.elements(1));
        let subject = Subject::Tolerance(percent);
        Ok(Claim { subject, claimed: truth.map(|_| percent), truth, cost })
    };
    TOLERANCES.into_iter().map(&mut claim).collect::<Result<_, _>>().map(Some)
}

impl Findings {
    /// The scenes that promise nothing.
    pub fn folded(&self) -> Vec<u32> {
        let folded = |scene: &Checked| scene.claims.is_none().then_some(scene.index);
        self.scenes.iter().filter_map(folded).collect()
    }

    /// How many scenes have a fault.
    pub fn count(&self, fault: Fault) -> usize {
        self.scenes.iter().filter(|scene| scene.faults.contains(&fault)).count()
    }

    /// Every claim with its scene, result by result or tolerance by tolerance.
    fn claims(&self) -> Vec<(Subject, Vec<(u32, Claim)>)> {
        let of = |subject| {
            let claims = self.scenes.iter().flat_map(move |scene| {
                let claims = scene.claims.iter().flatten();
                claims.map(move |claim| (scene.index, *claim))
            });
            let about = claims.filter(|(_, claim)| claim.subject == subject);
            (subject, about.collect())
        };
        match self.study {
            Study::Tolerances => TOLERANCES.map(Subject::Tolerance).map(of).to_vec(),
            _ => Quantity::ALL.iter().copied().map(Subject::Result).map(of).collect(),
        }
    }

    /// What the scenes showed for each subject that occurs.
    pub fn coverage(&self) -> Vec<Coverage> {
        let of = |(subject, about): (Subject, Vec<(u32, Claim)>)| {
            let made = about.iter().filter_map(|(_, c)| c.claimed.zip(c.truth));
            // A claim over no error at all is infinite, as no claim is zero.
            let ratios: Vec<f64> = made.clone().map(|(claimed, truth)| claimed / truth).collect();
            let truths: Vec<f64> = made.map(|(_, truth)| truth).collect();
            let claims = truths.len();
            let misses = about.iter().filter(|(_, claim)| claim.fails()).count();
            Coverage {
                subject,
                claims,
                misses,
                without_claim: about.len() - claims,
                within: (claims > 0).then(|| 100.0 * (claims - misses) as f64 / claims as f64),
                median_ratio: median(ratios),
                largest_truth: truths.iter().copied().reduce(f64::max),
                median_truth: median(truths),
                median_cost: median(about.iter().filter_map(|(_, claim)| claim.cost).collect()),
            }
        };
        let occurs = |(_, about): &(Subject, Vec<_>)| !about.is_empty();
        self.claims().into_iter().filter(occurs).map(of).collect()
    }

    /// Every claim that does not hold, with the number of its scene.
    pub fn misses(&self) -> Vec<(u32, Claim)> {
        let all = self.claims().into_iter().flat_map(|(_, about)| about);
        all.filter(|(_, claim)| claim.fails()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Scenes with a claim each about the same, of which the second folds.
    fn found(study: Study, subject: Subject, claims: [Option<(f64, f64)>; 5]) -> Findings {
        let scene = |(index, about): (u32, Option<(f64, f64)>)| {
            let (claimed, truth) = about.unzip();
            let claim = Claim { subject, claimed, truth, cost: about.map(|_| 3.0) };
            Checked { index, claims: (index != 1).then(|| vec![claim]), faults: Vec::new() }
        };
        Findings { study, seed: 1, scenes: (0..).zip(claims).map(scene).collect() }
    }

    #[test]
    fn misses_folds_and_what_is_not_claimed_are_counted_apart() {
        let subject = Subject::Result(Quantity::Apex);
        let claims = [(4.0, 1.0), (1.0, 9.0), (1.0, 2.0), (1.0, 0.0), (1.0, f64::NAN)].map(Some);
        let all = found(Study::Steps(Scenes::Pulses), subject, claims);
        let [row] = all.coverage()[..] else { panic!("one row") };
        assert_eq!((row.subject, row.within), (subject, Some(50.0)));
        assert_eq!((row.claims, row.misses, row.without_claim), (4, 2, 0));
        assert_eq!(row.largest_truth, Some(2.0));
        let (missed, _): (Vec<u32>, Vec<Claim>) = all.misses().into_iter().unzip();
        assert_eq!((missed, all.folded()), (vec![2, 4], vec![1]));
    }

    #[test]
    fn a_tolerance_that_is_refused_is_no_claim() {
        let subject = Subject::Tolerance(20.0);
        let claims = [None, None, Some((20.0, 4.0)), Some((20.0, 40.0)), None];
        let rows = found(Study::Tolerances, subject, claims).coverage();
        assert_eq!((rows[0].claims, rows[0].misses, rows[0].without_claim), (2, 1, 2));
        assert_eq!(rows[0].median_ratio, Some(2.75));
        assert_eq!((rows[0].within, rows[0].median_cost), (Some(50.0), Some(3.0)));
        let refused = found(Study::Tolerances, subject, [None; 5]).coverage();
        assert_eq!((refused[0].within, refused[0].median_truth), (None, None));
    }
}
