//! The risk of each injury after one blow, and the range that it may have.
//!
//! With z = log10(m/m50) of the measure m: the risk is Phi(z/hypot(eyes, known)), and its 80 %
//! range goes from Phi((log10(m (1 - err)/m50) - 1.28 s)/eyes) to the same with plus signs, where
//! err is the error of m by step and mesh and s adds to `known`, in quadrature, what the inputs are
//! not known to. To `known` comes 0.10 for an object wider than any that was tested, and 0.10 for
//! what is not anatomical under a blow from the side. To s comes as well what the round rim of the
//! axisymmetric eye brings to an object that meets it.
//!
//! Where the blow is like those that were tested (weight w, see [`Blow`]) the published energy
//! curve was measured on the thing itself and counts: logit R = w logit R(energy) + (1 - w) logit
//! R(tissue), likewise the ends of the range; not for the retina, whose curves are too thin.
//! Beyond the data only the lower end is known.
//!
//! Left out: that injuries hang together, but for what the words say of a burst globe.

use crate::injury::{blow::Blow, energy::EnergyCurve, equivalent::Equivalent};
use crate::injury::{equivalent::equivalent, kind::Injury, kind::PerInjury};
use crate::normal;
use libm::{exp, hypot, log, log10, pow};

/// One in ten lies farther out than so many standard deviations, to each side.
const ONE_IN_TEN: f64 = 1.281_551_565_544_600_8;
/// Added to `known` for objects wider than those tested, and for places that are not anatomical.
const UNTESTED: f64 = 0.10;
/// What the measured shape of the orbit changes in log10 of each measure over a round rim: the root
/// mean square of eight presets straight on that meet bone (`contrecoup guide sides`).
const ROUND_RIM: PerInjury<f64> = [0.24, 0.18, 0.13, 0.44, 0.29, 0.17];
/// Risks are kept so far from 0 and 1 that their logits are finite.
const SURE: f64 = 1e-9;

/// What is known of the measure of an injury after a run.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Known {
    /// Its value, SI.
    pub value: f64,
    /// The share of it by which step and mesh may make it wrong.
    pub error: f64,
    /// What the inputs are not known to: a standard deviation of log10 of the measure.
    pub inputs: f64,
    /// The same of the energy over area.
    pub energy_inputs: f64,
    /// Whether the run ended while it may still grow.
    pub cut: bool,
}

/// The risk of one injury.
#[derive(Debug, Clone, PartialEq)]
pub struct Risk {
    /// The injury.
    pub injury: Injury,
    /// What its tissue felt.
    pub known: Known,
    /// The middle of what is believed, 0 to 1.
    pub risk: f64,
    /// Eight in ten of what it may be lie in it, 0 to 1; it holds `risk`.
    pub range: (f64, f64),
    /// Whether the run can be believed at all: else the range is from 0 to 1.
    pub usable: bool,
    /// Whether only its lower end is known: beyond the data, or cut off by the end of the run.
    pub at_least: bool,
    /// The BB that the tissue would feel the same of.
    pub equivalent: Equivalent,
    /// What a reader must know before believing it.
    pub notes: Vec<&'static str>,
}

/// What a reader must know before believing a risk, and the same in short.
const NOTES: [(&str, &str); 6] = [
    ("so small, hard and fast an object may go in", "the object may go in"),
    (
        "of the impact alone: suction as the ball leaves is not in it, and clinics see hyphema",
        "hyphema: suction not counted",
    ),
    ("the object is larger than any that was tested", "larger than any tested object"),
    ("no eye was tested with a given force", "no eye was tested with a given force"),
    ("bone is taken as round: see guide sides", "bone taken as round"),
    (
        "from the side this place is a ring around the blow, not the anatomical one",
        "from the side: places are rings round the blow",
    ),
];

/// A note of a risk in short.
pub fn in_short(note: &str) -> &str {
    NOTES.iter().find(|(long, _)| *long == note).map_or(note, |(_, short)| short)
}

fn logit(risk: f64) -> f64 {
    let risk = risk.clamp(SURE, 1.0 - SURE);
    log(risk / (1.0 - risk))
}

impl Injury {
    /// How far its curve is known for this blow: a standard deviation of log10 of the measure.
    fn known_for(self, blow: &Blow) -> f64 {
        let anatomical = self == Self::GlobeRupture || self == Self::CornealAbrasion;
        let aslant = if anatomical { 0.0 } else { blow.aslant };
        self.curve().known + UNTESTED * (blow.wider + aslant)
    }

    /// `tissue` blended with the published curves at `factor` times the energy, where they count.
    fn blended(self, blow: &Blow, factor: f64, tissue: f64) -> f64 {
        let energy = blow.energy.filter(|_| blow.tested > 0.0);
        let published = energy.and_then(|energy| EnergyCurve::counted(self, energy * factor));
        let Some(published) = published else { return tissue };
        // As it is, where its logit would cut it off.
        if blow.tested >= 1.0 {
            return published;
        }
        let mean = blow.tested * logit(published) + (1.0 - blow.tested) * logit(tissue);
        1.0 / (1.0 + exp(-mean))
    }

    /// The risk of a blow that the tissue felt as `measure` (SI), 0 to 1.
    pub fn risk(self, blow: &Blow, measure: f64) -> f64 {
        let curve = self.curve();
        let spread = hypot(curve.eyes, self.known_for(blow));
        let tissue = normal::below(log10(measure / curve.half) / spread);
        self.blended(blow, 1.0, tissue)
    }

    /// The risk if curves lie `off` standard deviations from where they are believed to lie, with
    /// what else is not known: of the measure and of the energy, as [`Known`] has it.
    pub(crate) fn risk_if(self, blow: &Blow, measure: f64, off: f64, inputs: (f64, f64)) -> f64 {
        let curve = self.curve();
        let bone = blow.round_rim * ROUND_RIM[self as usize];
        let way = off * hypot(hypot(self.known_for(blow), inputs.0), bone);
        let tissue = normal::below((log10(measure / curve.half) + way) / curve.eyes);
        let energy = off * hypot(curve.energy_known, inputs.1);
        self.blended(blow, pow(10.0, energy), tissue)
    }

    /// All that is believed of it after a blow.
    pub fn assess(self, blow: &Blow, known: Known) -> Risk {
        let risk = self.risk(blow, known.value);
        let end = |sign: f64| {
            let value = known.value * (1.0 + sign * known.error).max(0.0);
            let inputs = (known.inputs, known.energy_inputs);
            self.risk_if(blow, value, sign * ONE_IN_TEN, inputs)
        };
        let at_least = known.cut || known.value > self.curve().end;
        let high = if at_least { 1.0 } else { end(1.0).max(risk) };
        Risk {
            injury: self,
            known,
            risk,
            range: (end(-1.0).min(risk), high),
            usable: true,
            at_least,
            equivalent: equivalent(self, known.value),
            notes: self.notes(blow),
        }
    }

    fn notes(self, blow: &Blow) -> Vec<&'static str> {
        let rupture = self == Self::GlobeRupture;
        let hold = [
            rupture && blow.goes_in,
            self == Self::Hyphema && blow.sucks,
            blow.wider > 0.0 && blow.energy.is_some(),
            blow.wider > 0.0 && blow.energy.is_none(),
            blow.round_rim > 0.0,
            blow.aslant > 0.0 && !rupture && self != Self::CornealAbrasion,
        ];
        let notes = NOTES.iter().zip(hold).filter(|(_, holds)| *holds);
        notes.map(|((note, _), _)| *note).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::library::tests::preset;

    fn known(value: f64) -> Known {
        Known { value, error: 0.1, ..Known::default() }
    }

    #[test]
    fn half_of_the_eyes_are_hurt_at_the_point_of_50_percent_and_ranges_hold_the_risk() {
        let unlike = Blow::default();
        for injury in Injury::ALL {
            let half = injury.curve().half;
            assert!((injury.risk(&unlike, half) - 0.5).abs() < 1e-12);
            assert_eq!(injury.risk(&unlike, 0.0), 0.0);
            for share in [0.01, 0.3, 1.0, 3.0, 100.0] {
                let risk = injury.assess(&unlike, known(share * half));
                let (low, high) = risk.range;
                assert!(low <= risk.risk && risk.risk <= high, "{risk:?}");
                assert_eq!(risk.at_least, share * half > injury.curve().end);
            }
        }
    }

    #[test]
    fn what_is_less_known_widens_a_range_and_never_narrows_it() {
        for name in ["bb-56", "squash-ball"] {
            let blow = Blow::of(&preset(name, &[]));
            for injury in Injury::ALL {
                let ranges = [0.0, 0.1, 0.2, 0.3, 0.4].map(|more| {
                    let (error, inputs, energy_inputs) = (0.1 + more, more, 0.5 * more);
                    let known = known(0.7 * injury.curve().half);
                    injury.assess(&blow, Known { error, inputs, energy_inputs, ..known }).range
                });
                assert!(ranges.is_sorted_by(|a, b| b.0 <= a.0 && a.1 <= b.1), "{ranges:?}");
            }
        }
    }

    #[test]
    fn no_risk_jumps_as_a_blow_ceases_to_be_like_those_tested() {
        let elastic = ("impact.surface", "Elastic(modulus_mpa: 50)");
        for (path, from, to) in [
            ("impact.diameter_mm", 10.0, 18.0),
            ("impact.diameter_mm", 30.0, 42.0),
            ("impact.angle_deg", 0.0, 30.0),
            ("impact.surface.modulus_mpa", 5.0, 200.0),
        ] {
            let risks = |step: i32| -> Vec<f64> {
                let value = from + (to - from) * f64::from(step) / 2000.0;
                let changes = [elastic, (path, &format!("{value:.4}"))];
                let first = usize::from(!path.ends_with("modulus_mpa"));
                let blow = Blow::of(&preset("bb-56", &changes[first..]));
                let ends = |injury: &Injury| {
                    let risk = injury.assess(&blow, known(0.6 * injury.curve().half));
                    [risk.risk, risk.range.0, risk.range.1]
                };
                Injury::ALL.iter().flat_map(ends).collect()
            };
            let all: Vec<Vec<f64>> = (0..=2000).map(risks).collect();
            for pair in all.windows(2) {
                let most = pair[0].iter().zip(&pair[1]).map(|(a, b)| (a - b).abs());
                assert!(most.fold(0.0, f64::max) < 0.05, "{path}: {pair:?}");
            }
        }
    }

    #[test]
    fn a_small_hard_blow_straight_on_has_the_published_risk() {
        let bb = Blow::of(&preset("bb-92", &[]));
        let rupture = Injury::GlobeRupture;
        assert!(rupture.risk(&bb, 0.064) > 0.99);
        assert!(rupture.risk(&Blow { tested: 0.0, ..bb }, 0.064) < 0.9);
        // The retina's published curve is too thin to count.
        let back = Injury::RetinaBack;
        assert_eq!(back.risk(&bb, 0.02), back.risk(&Blow { tested: 0.0, ..bb }, 0.02));
    }
}
