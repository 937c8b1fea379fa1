//! The laboratory's points of 50 % that are shipped are those that the fit finds.

use contrecoup::injury::Injury;
use contrecoup::verify::tissue_fit::{TissueFit, fit_tissues};
use std::sync::LazyLock;

static FITS: LazyLock<Vec<TissueFit>> = LazyLock::new(|| fit_tissues(|_| {}));

#[test]
fn what_is_shipped_is_what_the_fit_finds() {
    assert_eq!(FITS.len(), Injury::ALL.len());
    for fit in &*FITS {
        let shipped = fit.injury.curve();
        // To what three printed digits leave open.
        assert!((fit.half / shipped.half - 1.0).abs() < 0.01, "{fit:?}");
        assert!((fit.eyes - shipped.eyes).abs() < 2e-3, "{fit:?}");
        assert!((fit.known - shipped.known).abs() < 2e-3, "{fit:?}");
    }
}

#[test]
fn a_curve_without_one_kind_is_not_surprised_by_it() {
    for fit in &*FITS {
        for kind in &fit.kinds {
            assert!((0.02..0.98).contains(&kind.told_by_others), "{:?} {kind:?}", fit.injury);
        }
    }
}
