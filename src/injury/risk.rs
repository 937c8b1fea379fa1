//! The risk of each injury after one blow, and the range that it may have.
//!
//! With z = log10(m/m50) of the measure m: the risk is Phi(z/hypot(eyes, known)), and its 80 %
//! range goes from Phi((log10(m (1 - err)/m50) - 1.28 s)/eyes) to the same with plus signs, where
//! err is the error of m by step and mesh and s adds to `known`, in quadrature, what the inputs are
//! not known to. To `known` comes 0.10 for an object wider than any that was tested, and 0.10 for
//! what is not anatomical under a blow from the side.
//!
//! Where the blow is like those that were tested (weight w, see [`Blow`]) the published energy
//! curve was measured on the thing itself and counts: logit R = w logit R(energy) + (1 - w) logit
//! R(tissue), likewise the ends of the range; not for the retina, whose curves are too thin.
//! Beyond the data only the lower end is known.
//!
//! Left out: that injuries hang together, but for what the words say of a burst globe.

use crate::injury::blow::Blow;
use crate::injury::energy::EnergyCurve;
use crate::injury::equivalent::{Equivalent, equivalent};
use crate::injury::kind::Injury;
use crate::normal;
use libm::{exp, hypot, log, log10, pow};

/// One in ten lies farther out than so many standard deviations, to each side.
pub const ONE_IN_TEN: f64 = 1.281_551_565_544_600_8;
/// Added to how far a curve is known for objects wider than those tested, and for places that are
/// not anatomical.
const UNTESTED: f64 = 0.10;
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
    /// Whether only its lower end is known: beyond the data, or cut off by the end of the run.
    pub at_least: bool,
    /// The BB that the tissue would feel the same of.
    pub equivalent: Equivalent,
    /// What a reader must know before believing it.
    pub notes: Vec<&'static str>,
}

fn logit(risk: f64) -> f64 {
    let risk = risk.clamp(SURE, 1.0 - SURE);
    log(risk / (1.0 - risk))
}

/// The mean of two risks in their logits, with the weight of the first.
fn blend(weight: f64, first: f64, second: f64) -> f64 {
    if weight <= 0.0 {
        second
    } else if weight >= 1.0 {
        first
    } else {
        let mean = weight * logit(first) + (1.0 - weight) * logit(second);
        1.0 / (1.0 + exp(-mean))
    }
}

impl Injury {
    /// How far its curve is known for this blow: a standard deviation of log10 of the measure.
    fn known_for(self, blow: &Blow) -> f64 {
        let anatomical = self == Self::GlobeRupture || self == Self::CornealAbrasion;
        let aslant = if anatomical { 0.0 } else { blow.aslant };
        self.curve().known + UNTESTED * (blow.wider + aslant)
    }

    /// The published curve that counts beside the tissue's, the energy of the blow, and its weight.
    fn by_energy(self, blow: &Blow) -> Option<(&'static EnergyCurve, f64, f64)> {
        let retina = self == Self::RetinaBack || self == Self::RetinaFront;
        let counts = !retina && blow.tested > 0.0;
        let curve = EnergyCurve::of(self).next().filter(|_| counts)?;
        Some((curve, blow.energy?, blow.tested))
    }

    /// The risk of a blow that the tissue felt as `measure` (SI), 0 to 1.
    pub fn risk(self, blow: &Blow, measure: f64) -> f64 {
        let curve = self.curve();
        let spread = hypot(curve.eyes, self.known_for(blow));
        let tissue = normal::below(log10(measure / curve.half) / spread);
        match self.by_energy(blow) {
            Some((published, energy, weight)) => blend(weight, published.risk(energy), tissue),
            None => tissue,
        }
    }

    /// The risk if curves lie `off` standard deviations from where they are believed to lie, with
    /// what else is not known: of the measure and of the energy, as [`Known`] has it.
    fn risk_if(self, blow: &Blow, measure: f64, off: f64, inputs: (f64, f64)) -> f64 {
        let curve = self.curve();
        let way = off * hypot(self.known_for(blow), inputs.0);
        let tissue = normal::below((log10(measure / curve.half) + way) / curve.eyes);
        match self.by_energy(blow) {
            Some((published, energy, weight)) => {
                let way = off * hypot(curve.energy_known, inputs.1);
                blend(weight, published.risk(energy * pow(10.0, way)), tissue)
            }
            None => tissue,
        }
    }

    /// The risk of one eye among many if its curve lies `off` standard deviations from where it is
    /// believed to lie, 0 to 1.
    pub(crate) fn risk_of_draw(self, blow: &Blow, measure: f64, off: f64) -> f64 {
        self.risk_if(blow, measure, off, (0.0, 0.0))
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
            at_least,
            equivalent: equivalent(self, known.value),
            notes: self.notes(blow),
        }
    }

    fn notes(self, blow: &Blow) -> Vec<&'static str> {
        let rupture = self == Self::GlobeRupture;
        let all = [
            (rupture && blow.goes_in, "so small, hard and fast an object may go in"),
            (
                self == Self::Hyphema && blow.sucks,
                "of the impact alone: suction as the ball leaves is not in it, and clinics see hyphema",
            ),
            (
                blow.wider > 0.0 && blow.energy.is_some(),
                "the object is larger than any that was tested",
            ),
            (
                blow.wider > 0.0 && blow.energy.is_none(),
                "no eye was tested with a given force",
            ),
            (
                blow.aslant > 0.0 && !rupture && self != Self::CornealAbrasion,
                "from the side this place is a ring around the blow, not the anatomical one",
            ),
        ];
        all.into_iter().filter_map(|(holds, note)| holds.then_some(note)).collect()
    }
}
