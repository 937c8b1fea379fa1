//! Whether `--tolerance` is kept: many random scenes, each answered within several tolerances and compared
//! with the finest mesh.
//!
//! The scenes are those of [`crate::verify::mesh_coverage`]: pulses whose mesh folds at none of levels 1, 2, 3 and 8. No
//! answer rests on level 8, which it is compared with and which may be off itself by what fine levels
//! scatter by.

use crate::answer::choose::{Ladder, within_by};
use crate::answer::mesh_error::{at_level, witnesses};
use crate::many::statistics::median;
use crate::run::kept::Keep;
use crate::run::quantity::Quantity;
use crate::run::refusal::Refusal;
use crate::run::watch::unwatched;
use crate::verify::coverage::Drawn;
use crate::verify::mesh_coverage::{reference, unfolded};
use std::ops::ControlFlow;

/// What is asked for, in %.
pub const TOLERANCES: [f64; 5] = [50.0, 20.0, 10.0, 5.0, 2.0];

/// What became of one tolerance in one scene.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Met {
    /// Level of the answer.
    pub level: u32,
    /// Stated error of its damage index, by step and mesh together, in %.
    pub stated: f64,
    /// True error of it, in %.
    pub truth: f64,
    /// Springs that were computed for it, over those of one run at level 1.
    pub cost: f64,
}

/// A scene with its answers, none where it was refused.
#[derive(Debug, Clone, PartialEq)]
pub struct Kept {
    /// Number of the scene.
    pub index: u32,
    /// In the order of [`TOLERANCES`]; none at all of a scene whose mesh folds.
    pub answers: Option<[Option<Met>; TOLERANCES.len()]>,
}

/// What many scenes showed for one tolerance.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Row {
    /// What was asked for, in %.
    pub percent: f64,
    /// Answers.
    pub answered: usize,
    /// Those of them that are within it.
    pub true_ones: usize,
    /// Scenes without an answer.
    pub refused: usize,
    /// Median true error of the answers, in %.
    pub median_truth: Option<f64>,
    /// Median cost of the answers, over that of one run at level 1.
    pub median_cost: Option<f64>,
}

/// Asks for every tolerance in random scenes of `seed`, from the first, until `count` have folded nowhere. The
/// order and every bit of the result are the same for any number of threads. `watch` is told the share that
/// is done, and may stop the rest.
///
/// # Errors
/// Whatever a scene refuses but for a tolerance; none should. [`Refusal::Cancelled`] if the watch stopped it.
pub fn check(
    count: u32,
    seed: u32,
    watch: &(dyn Fn(f64) -> ControlFlow<()> + Sync),
) -> Result<Vec<Kept>, Refusal> {
    let one = |index| check_one(index, seed);
    unfolded(count, &one, |kept| kept.answers.is_none(), watch)
}

fn check_one(index: u32, seed: u32) -> Result<Kept, Refusal> {
    let scene = Drawn::Pulses.scene(index, seed).check()?;
    let folded = Kept {
        index,
        answers: None,
    };
    let mut ladder = Ladder::default();
    let [_, finer] = witnesses(&scene.model, 1);
    for level in 1..=finer {
        if ladder.at(&scene, level, &mut unwatched)?.folded.is_some() {
            return Ok(folded);
        }
    }
    let truth = at_level(&scene, reference(Drawn::Pulses), &mut unwatched)?;
    let Some(exact) = truth.results[Quantity::Damage].filter(|_| truth.folded.is_none()) else {
        return Ok(folded);
    };
    let mut answers = [None; TOLERANCES.len()];
    for (met, percent) in answers.iter_mut().zip(TOLERANCES) {
        let chosen = match within_by(
            &mut ladder,
            &scene,
            percent,
            Keep::default(),
            &mut unwatched,
        ) {
            Err(Refusal::ToleranceNotMet { .. }) => continue,
            chosen => chosen?,
        };
        let answer = &chosen.answer;
        let (damage, errors) = (answer.index().damage(), &answer.errors);
        *met = Some(Met {
            level: answer.case.level(),
            stated: 100.0 * errors.share(Quantity::Damage),
            truth: 100.0 * (damage - exact).abs() / damage.abs(),
            cost: chosen.elements / ladder.elements(1),
        });
    }
    Ok(Kept {
        index,
        answers: Some(answers),
    })
}

/// One row for each tolerance.
pub fn rows(kept: &[Kept]) -> Vec<Row> {
    let row = |(place, &percent): (usize, &f64)| {
        let asked = kept.iter().filter_map(|kept| kept.answers.as_ref());
        let met: Vec<Option<Met>> = asked.map(|answers| answers[place]).collect();
        let answers: Vec<Met> = met.iter().copied().flatten().collect();
        Row {
            percent,
            answered: answers.len(),
            true_ones: answers.iter().filter(|met| met.truth <= percent).count(),
            refused: met.len() - answers.len(),
            median_truth: median(answers.iter().map(|met| met.truth).collect()),
            median_cost: median(answers.iter().map(|met| met.cost).collect()),
        }
    };
    TOLERANCES.iter().enumerate().map(row).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn answers_are_counted_apart_from_refusals_and_folds() {
        let met = |truth| {
            Some(Met {
                level: 1,
                stated: 10.0,
                truth,
                cost: 3.0,
            })
        };
        let scene = |index, answers| Kept { index, answers };
        let rows = rows(&[
            scene(0, Some([met(30.0), met(30.0), None, None, None])),
            scene(1, None),
            scene(2, Some([met(4.0), met(4.0), met(4.0), met(4.0), None])),
        ]);
        let counts = rows.iter().map(|r| (r.answered, r.true_ones, r.refused));
        let counts: Vec<_> = counts.collect();
        assert_eq!(
            counts,
            [(2, 2, 0), (2, 1, 0), (1, 1, 1), (1, 1, 1), (0, 0, 2)]
        );
        assert_eq!(
            (rows[4].median_truth, rows[0].median_cost),
            (None, Some(3.0))
        );
    }
}
