//! What a reader must know before trusting a result of the axisymmetric eye.

use crate::models::axisymmetric::case::{AxisymmetricCase, duration};
use crate::models::axisymmetric::recording::results::Extremes;
use crate::models::axisymmetric::time::until::Until;
use crate::run::flags::{Flag, FlagKind, LATE_PEAK_SHARE, PRESSED_FLAT};
use crate::run::{quantity::Quantity, raised::Raised, readings::Readings};
use crate::scenario::{TRUSTED_ANGLE_DEG, problem::plain};

/// The share by which the hardest shot of experiments, a steel ball at 66.5 m/s, shortens this eye.
const MOST_TESTED: f64 = 0.5;

/// What is slower than this, m/s, lies where it is.
const LIES: f64 = 0.5;

/// Flags of a run of `simulated` s.
pub(crate) fn raise(
    case: &AxisymmetricCase,
    extremes: &Extremes,
    readings: &Readings,
    simulated: f64,
) -> Vec<Flag> {
    let mut raised = Raised::default();
    if case.angle_deg.abs() > TRUSTED_ANGLE_DEG {
        let angle = case.angle_deg;
        let said = format!(
            "the orbit turns with a blow at {angle} degrees: trust it to {TRUSTED_ANGLE_DEG}"
        );
        raised.raise(FlagKind::AngleBeyondTrust, said);
    }
    let asked = (case.window, duration(&case.load), case.rim);
    of_blow(asked, extremes, (readings, simulated), &mut raised);
    raised.flags()
}

/// Flags that every eye of cells can raise, of a run that may last so long, by a pulse of some
/// duration, in s, or an object, which is caught by some `rim` if it is too wide.
pub(crate) fn of_blow(
    (until, pulse, rim): (Until, Option<f64>, &str),
    extremes: &Extremes,
    (readings, simulated): (&Readings, f64),
    raised: &mut Raised,
) {
    if extremes.rim_force.value > 0.0 {
        let force = extremes.rim_force;
        let said = format!("{rim} met the projectile at {:.3} ms", force.time * 1e3);
        raised.raise_at(force.time, FlagKind::RimStops, said);
        if extremes.missed() {
            raised.raise(FlagKind::EyeMissed, format!("{rim} kept the projectile off the eye"));
        }
    }
    if let Some(time) = extremes.crushed_at {
        let said = format!(
            "the object's surface was crushed through at {:.3} ms: from there on it is as hard as its core",
            time * 1e3
        );
        raised.raise_at(time, FlagKind::SurfaceCrushed, said);
    }
    let shorter = extremes.shortening;
    if shorter.value > MOST_TESTED {
        let (by, most) = (100.0 * shorter.value, 100.0 * MOST_TESTED);
        let said = format!(
            "the eye was shortened by {by:.0} %, in no test that it is compared with by more than {most:.0} %"
        );
        raised.raise_at(shorter.time, FlagKind::BeyondTests, said);
    }
    if let Some(time) = extremes.flat_at {
        let at = time * 1e3;
        let what = if extremes.shortening.value > PRESSED_FLAT {
            "the eye was pressed flat"
        } else {
            "a part of the eye was pressed to nothing"
        };
        let said = format!(
            "{what} at {at:.3} ms: the model ends there, every result is at least so large"
        );
        raised.raise_at(time, FlagKind::EyeFlat, said);
    } else {
        window((until, pulse), extremes, (readings, simulated), raised);
    }
}

/// Flags of a window that ends too early.
fn window(
    (until, pulse): (Until, Option<f64>),
    extremes: &Extremes,
    (readings, simulated): (&Readings, f64),
    raised: &mut Raised,
) {
    let end = until.most();
    if let Some(pulse) = pulse.filter(|pulse| end < *pulse) {
        return raised.pulse_cut(end, pulse);
    }
    if matches!(until, Until::Settled(_)) && simulated >= end {
        let cap = plain((end * 1e9).round() / 1e6);
        let said = format!(
            "after {cap} ms, the most that window_ms: Auto simulates, a result could still grow"
        );
        raised.raise_at(end, FlagKind::WindowCapped, said);
    }
    let goes_on = extremes.rebound.filter(|speed| *speed <= 0.0);
    let by_itself = matches!(until, Until::Settled(_)) && simulated < end;
    let lies = extremes.touching || goes_on.is_some_and(|speed| speed > -LIES);
    if by_itself && lies {
        let said = "nothing could grow any more, though the object still lay at the eye";
        return raised.raise(FlagKind::Stays, said);
    }
    if let Some(speed) = goes_on
        && simulated < end
        && !extremes.touching
    {
        // The run is over all the same: it is gone.
        let speed = -speed;
        let said = format!(
            "the object went past the globe at {speed:.0} m/s: what it meets behind is not in the model"
        );
        return raised.raise(FlagKind::WentPast, said);
    }
    if goes_on.is_some() || extremes.touching {
        let said = "the window ended before the projectile had left the eye";
        raised.raise_at(end, FlagKind::ContactCut, said);
    }
    if by_itself {
        return;
    }
    let late = Quantity::ALL.iter().find(|of| {
        let peak = readings.peak(**of);
        peak.is_some_and(|peak| peak.time > LATE_PEAK_SHARE * simulated)
    });
    if let Some(of) = late {
        let how = format!("a result still grew when the window ended: {}", of.label());
        raised.window_short(end, how);
    }
}
