//! The injury curves that are shipped are those that the fit finds.

use contrecoup::answer::uncertain::WITH_CURVES;
use contrecoup::injury::{BBS, Injury};
use contrecoup::verify::tissue_fit::{TissueFits, fit_tissues};
use std::sync::LazyLock;

static FITS: LazyLock<TissueFits> = LazyLock::new(|| fit_tissues(|_| {}));

/// Whether two numbers agree to what three printed digits leave open.
fn agree(found: f64, shipped: f64) -> bool {
    (found / shipped - 1.0).abs() < 0.01
}

#[test]
fn what_is_shipped_is_what_the_fit_finds() {
    assert_eq!(FITS.injuries.len(), Injury::ALL.len());
    for fit in &FITS.injuries {
        let shipped = fit.injury.curve();
        assert!(agree(fit.half, shipped.half), "{fit:?}");
        assert!((fit.eyes - shipped.eyes).abs() < 2e-3, "{fit:?}");
        assert!((fit.known - shipped.known).abs() < 2e-3, "{fit:?}");
        assert!(agree(fit.end, shipped.end), "{fit:?}");
    }
    for input in &FITS.with_inputs {
        let (_, powers) = WITH_CURVES.iter().find(|(path, _)| *path == input.path).unwrap();
        for (found, shipped) in input.powers.as_flattened().iter().zip(powers.as_flattened()) {
            assert!((found - shipped).abs() < 0.01, "{input:?}");
        }
    }
}

#[test]
fn the_table_of_bbs_is_what_runs_give() {
    for (found, (speed, shipped)) in FITS.bb.iter().zip(BBS) {
        for (found, shipped) in found.iter().zip(shipped) {
            assert!(agree(*found, shipped), "at {speed}: {found} {shipped}");
        }
    }
}

#[test]
fn a_curve_without_one_kind_is_not_surprised_by_it() {
    for fit in &FITS.injuries {
        for kind in &fit.kinds {
            assert!((0.02..0.98).contains(&kind.told_by_others), "{:?} {kind:?}", fit.injury);
        }
    }
}
