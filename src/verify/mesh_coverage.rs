//! Whether the stated mesh errors hold: many random scenes, each against the finest mesh.
//!
//! The scenes are those of [`crate::verify::coverage`]. One whose mesh folds at any of the levels promises nothing
//! and is counted apart, and so is a result of which no limit was seen. The finest mesh is not the limit
//! itself: it may be off by what fine levels scatter by.

use crate::answer::mesh_error::OnMesh;
use crate::answer::mesh_error::{MeshError, at_level, witnesses};
use crate::run::refusal::Refusal;
use crate::run::watch::unwatched;
use crate::scenario::FINEST_LEVEL;
use crate::verify::coverage::{Checked, Drawn, MAX_SCENES};
use rayon::prelude::*;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicU32, Ordering};

/// The finest level whose claims can be checked: its witnesses are coarser than the finest mesh.
pub const FINEST_CHECKED: u32 = 5;
/// The level that claims are compared with: one that no witness has.
pub fn reference(drawn: Drawn) -> u32 {
    match drawn {
        Drawn::Pulses => FINEST_LEVEL,
        Drawn::Objects => 8,
    }
}

/// Scenes that are begun together.
const BLOCK: u32 = 16;

/// Checks the mesh errors of answers at `level` in random scenes of `seed`, from the first, until `count`
/// of them have folded nowhere. The order and every bit of the result are the same for any number of
/// threads. `watch` is told the share that is done, and may stop the rest.
///
/// # Errors
/// Whatever a scene refuses; none should. [`Refusal::Cancelled`] if the watch stopped it.
pub fn check(
    drawn: Drawn,
    count: u32,
    seed: u32,
    level: u32,
    watch: &(dyn Fn(f64) -> ControlFlow<()> + Sync),
) -> Result<Vec<Checked>, Refusal> {
    let one = |index| check_one(drawn, index, seed, level);
    unfolded(count, &one, |checked| checked.folded, watch)
}

/// What `one` finds of scenes 0, 1, 2, ..., until `count` of them have not `folded`.
pub(crate) fn unfolded<T: Send>(
    count: u32,
    one: &(dyn Fn(u32) -> Result<T, Refusal> + Sync),
    folded: fn(&T) -> bool,
    watch: &(dyn Fn(f64) -> ControlFlow<()> + Sync),
) -> Result<Vec<T>, Refusal> {
    let unfolded = AtomicU32::new(0);
    let mut checked: Vec<T> = Vec::new();
    let mut left = count;
    let mut first = 0;
    while left > 0 && first < MAX_SCENES {
        let watched = |index: u32| {
            let checked = one(index)?;
            let found = u32::from(!folded(&checked));
            let done = unfolded.fetch_add(found, Ordering::Relaxed) + found;
            match watch(f64::from(done.min(count)) / f64::from(count)) {
                ControlFlow::Continue(()) => Ok(checked),
                ControlFlow::Break(()) => Err(Refusal::Cancelled),
            }
        };
        let block: Result<Vec<T>, Refusal> = (first..first + BLOCK)
            .into_par_iter()
            .map(watched)
            .collect();
        for scene in block? {
            if left == 0 {
                break;
            }
            left -= u32::from(!folded(&scene));
            checked.push(scene);
        }
        first += BLOCK;
    }
    Ok(checked)
}

fn check_one(drawn: Drawn, index: u32, seed: u32, level: u32) -> Result<Checked, Refusal> {
    let scene = drawn.scene(index, seed);
    let folded = Checked::nothing(index);
    let [coarser, finer] = witnesses(&scene.model, level);
    let mut found: Vec<OnMesh> = Vec::with_capacity(4);
    // The cheap ones first: where one folds the finest mesh need not be moved.
    for level in [level, coarser, finer, reference(drawn)] {
        let on = match at_level(&scene, level, &mut unwatched) {
            Err(Refusal::WentThrough(_)) => return Ok(folded),
            on => on?,
        };
        if on.folded.is_some() {
            return Ok(folded);
        }
        found.push(on);
    }
    let mesh = MeshError::of(&scene.model, level, &found[0], [&found[1], &found[2]]);
    Ok(Checked {
        index,
        claimed: mesh.errors,
        // In % of the answer, as claims are.
        truth: found[3].results.difference_percent(&found[0].results),
        folded: false,
    })
}
