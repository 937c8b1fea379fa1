//! The flags of one run as they are raised, and the words of those that every model can raise.

use crate::run::flags::{Flag, FlagKind};
use crate::run::{fold::Fold, model::Run, places::Region, quantity::Quantity, rules::Element};

/// An energy residual above this share of what came in is an alarm.
pub(crate) const ENERGY_ALARM: f64 = 0.005;
/// A step error above this many percent is called unconverged.
const UNCONVERGED_PERCENT: f64 = 10.0;
/// Two runs of a folded mesh that differ by more than this many percent predict nothing.
const UNPREDICTABLE_PERCENT: f64 = 5.0;
/// Nearer to the middle of the globe than this, in m, there is no front or back.
const MIDDLE_M: f64 = 3e-3;

/// Flags, collected.
#[derive(Debug, Default)]
pub(crate) struct Raised(Vec<Flag>);

/// What two runs with different steps say.
#[derive(Debug, Clone, Copy)]
pub(crate) struct TwoRuns {
    /// The largest step error of a result that is listed, in %.
    pub worst: Option<(Quantity, f64)>,
    /// The largest difference of a leading result, in %.
    pub disagreement: f64,
}

impl Raised {
    /// All flags raised so far.
    pub fn flags(self) -> Vec<Flag> {
        self.0
    }

    /// At no certain time.
    pub fn raise(&mut self, kind: FlagKind, message: impl Into<String>) {
        self.0.push(Flag::new(kind, message, None));
    }

    /// At `time`, in s.
    pub fn raise_at(&mut self, time: f64, kind: FlagKind, message: impl Into<String>) {
        self.0.push(Flag::new(kind, message, Some(time)));
    }

    fn folded(&mut self, fold: &Fold, element: Element) {
        let (at, lasted) = (fold.since * 1e3, fold.lasted * 1e3);
        // Of springs it is the quads between them, cells fold themselves.
        let what = if element == Element::Spring { "quads" } else { element.plural() };
        let (count, all) = (fold.quads, fold.of);
        let (length, end) = if fold.stays {
            ("to the end".to_owned(), "still at the end")
        } else {
            (format!("for {lasted:.3} ms"), "open again at the end")
        };
        let message = format!(
            "mesh folded at {at:.3} ms, {length}: {count} of {all} {what}; beyond the model's validity"
        );
        let place = place(fold);
        let detail = format!("the first {place}; folded for {lasted:.3} ms in all, and {end}");
        let flag = Flag::new(FlagKind::MeshFolded, message, Some(fold.since));
        self.0.push(Flag { detail: Some(detail), ..flag });
    }

    /// A window that ends before the pulse; both in s.
    pub fn pulse_cut(&mut self, window: f64, pulse: f64) {
        let said = format!("the window ends before the pulse, which lasts {} ms", pulse * 1e3);
        self.raise_at(window, FlagKind::PulseCut, said);
    }

    /// A window, in s, that ends too early for a result, of which it is said how.
    pub fn window_short(&mut self, window: f64, how: impl Into<String>) {
        self.raise_at(window, FlagKind::WindowShort, how);
    }
}

/// Whether the mesh folded, energies add up and, with a second run, the step is short enough.
pub(crate) fn of_motion(run: &Run, element: Element, two_runs: Option<TwoRuns>) -> Vec<Flag> {
    let mut raised = Raised::default();
    let split =
        |runs: &TwoRuns| runs.disagreement > UNPREDICTABLE_PERCENT || runs.disagreement.is_nan();
    let unpredictable = two_runs.filter(split).zip(run.fold);
    if let Some(fold) = &run.fold {
        raised.folded(fold, element);
    }
    if let Some((TwoRuns { disagreement, .. }, fold)) = unpredictable {
        let said = format!("two solutions disagree by {disagreement:.0} %: not predictable");
        raised.raise_at(fold.since, FlagKind::NotPredictable, said);
    }
    if run.energy_residual > ENERGY_ALARM {
        let percent = 100.0 * run.energy_residual;
        let said = format!("the energies miss what came in by {percent:.2} %");
        raised.raise(FlagKind::EnergyImbalance, said);
    }
    // Where two solutions part for good, no step is small enough.
    let runs = two_runs.filter(|_| unpredictable.is_none());
    if let Some((of, error)) = runs.and_then(|runs| runs.worst)
        && (error > UNCONVERGED_PERCENT || error.is_nan())
    {
        let said = format!("the step error of {} is {error:.0} %, the largest", of.label());
        raised.raise(FlagKind::Unconverged, said);
    }
    raised.0
}

/// Where a mesh began to fold, in words and figures.
fn place(fold: &Fold) -> String {
    let angle = fold.front_angle().to_degrees();
    let radius = fold.radius() * 1e3;
    let part = match fold.part {
        Region::Lens => "in the lens",
        Region::Fat | Region::Orbit => "outside the globe",
        Region::Interior | Region::Shell | Region::Retina => "inside the globe",
    };
    if fold.radius() < MIDDLE_M {
        return format!("{part}, {radius:.1} mm from its middle");
    }
    let direction = match angle.abs() {
        a if a < 30.0 => "by the front",
        a if a < 60.0 => "between front and equator",
        a if a <= 120.0 => "by the equator",
        a if a <= 150.0 => "between equator and back",
        _ => "by the back",
    };
    // On the axis there is rounding.
    let side = match (fold.both_sides, angle) {
        (true, _) => " on both sides",
        (false, a) if a > 0.5 => " up",
        (false, a) if a < -0.5 => " down",
        _ => "",
    };
    format!(
        "{direction}, {part}: {:.0} degrees{side} from the front, {radius:.1} mm from the globe's middle",
        angle.abs()
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Point2;

    fn fold(x: f64, y: f64, stays: bool) -> Fold {
        Fold {
            since: 1e-4,
            lasted: 2e-5,
            stays,
            quads: 3,
            of: 193,
            at: Point2::new(x, y),
            part: Region::Interior,
            both_sides: false,
        }
    }

    fn said(fold: Fold) -> Vec<Flag> {
        let mut raised = Raised::default();
        raised.folded(&fold, Element::Spring);
        raised.flags()
    }

    #[test]
    fn a_fold_says_how_many_where_since_when_and_for_how_long() {
        let stays = &said(fold(-10e-3, 1e-3, true))[0];
        assert_eq!(
            stays.message,
            "mesh folded at 0.100 ms, to the end: 3 of 193 quads; beyond the model's validity"
        );
        assert_eq!(
            stays.detail.as_deref(),
            Some(
                "the first by the front, inside the globe: 6 degrees up from the front, 10.0 mm from \
                 the globe's middle; folded for 0.020 ms in all, and still at the end"
            )
        );
        assert!(stays.whole().starts_with(&stays.message));
        let instant = &said(fold(-10e-3, 1e-3, false))[0];
        assert!(instant.message.contains("at 0.100 ms, for 0.020 ms: 3 of"));
        assert!(instant.whole().ends_with("open again at the end; try a smaller blow"));
    }

    #[test]
    fn a_place_is_named_as_a_person_would() {
        let near = |x, y| place(&fold(x, y, true));
        assert!(near(0.0, -11e-3).starts_with("by the equator, inside the globe: 90 degrees down"));
        assert!(near(11e-3, 0.0).starts_with("by the back"));
        assert_eq!(near(-1e-3, 0.0), "inside the globe, 1.0 mm from its middle");
        let lens = Fold { part: Region::Lens, both_sides: true, ..fold(-8e-3, 6e-3, true) };
        assert!(
            place(&lens).starts_with("between front and equator, in the lens: 37 degrees on both")
        );
    }

    #[test]
    fn nobody_is_told_to_take_a_smaller_step_where_none_would_help() {
        use FlagKind::{MeshFolded, NotPredictable, Unconverged};
        let kinds = |fold, error, disagreement| -> Vec<FlagKind> {
            let run = Run { fold, simulated: 3e-3, ..Run::default() };
            let two_runs = TwoRuns { worst: Some((Quantity::Damage, error)), disagreement };
            let flags = of_motion(&run, Element::Spring, Some(two_runs));
            flags.into_iter().map(|flag| flag.kind).collect()
        };
        let folded = Some(fold(-0.01, 0.0, false));
        assert_eq!(kinds(folded, 50.0, 50.0), [MeshFolded, NotPredictable]);
        assert_eq!(kinds(folded, f64::NAN, f64::NAN), [MeshFolded, NotPredictable]);
        assert_eq!(kinds(folded, 50.0, 1.0), [MeshFolded, Unconverged]);
        assert_eq!(kinds(None, 50.0, 50.0), [Unconverged]);
        assert_eq!(kinds(None, f64::NAN, 0.0), [Unconverged]);
        assert_eq!(kinds(None, 1.0, 50.0), []);
    }
}
