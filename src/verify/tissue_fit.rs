//! Where the laboratory's points of 50 % come from, so that anybody can repeat it.
//!
//! The kinds of object behind the published energy curves are run at the published energies of 50
//! %, at human and pigs' eyes in gelatin. Of log10 of each measure there, the mean over kinds and
//! published energies is the tissue's own point of 50 %; the standard deviation over kinds, with
//! half of what published figures lie apart, says how far it is known; the spread of the published
//! curve times the slope of log10 of the measure over that of energy says how much eyes differ.
//!
//! Masses that are assumed count to how far the curve is known.
//!
//! The retina's front edge has no curve of its own. Blunt metal of 2.6, 3.5 and 45.5 g began to
//! hurt the retina of 16 pig eyes at 1.20 J (Scott 2000, AAAM 44:205), which is taken as a risk of
//! 10 %; the diameters were not published and are judged. How far that is known is judged too.
//!
//! Left out: the mesh, whose error every answer states for itself: all is of level 1.

use crate::answer::brief::single;
use crate::injury::{Injury, PerInjury};
use crate::normal;
use crate::run::{ordered, watch::unwatched};
use crate::scenario::{Impact, Physiological, Scenario, Species, Support, Surface};
use crate::verify::experiments::{flat, projectile_at};
use std::cell::RefCell;
use std::f64::consts::FRAC_PI_4;
use std::sync::atomic::AtomicBool;

/// An object that eyes were tested with: a ball, or a rod with a flat face.
#[derive(Clone, Copy)]
struct TestObject {
    name: &'static str,
    mass_g: f64,
    diameter_mm: f64,
    rod: bool,
    /// A standard deviation of the mass, in g, where it is assumed.
    doubt_g: f64,
    /// Whether it is the foam of an airbag's cover, which only abrasions were seen from.
    foam: bool,
}

const fn kind(name: &'static str, mass_g: f64, diameter_mm: f64, rod: bool) -> TestObject {
    TestObject { name, mass_g, diameter_mm, rod, doubt_g: 0.0, foam: false }
}

/// The kinds behind the energy curves.
static KINDS: [TestObject; 6] = [
    kind("BB 4.5 mm", 0.345, 4.5, false),
    kind("pellet 6 mm", 0.2, 6.0, false),
    kind("ball 6.35 mm", 1.05, 6.35, false),
    TestObject { doubt_g: 0.9, ..kind("rod 9.25 mm", 3.5, 9.25, true) },
    kind("rod 11.16 mm", 45.5, 11.16, true),
    TestObject { foam: true, ..kind("foam 12.4 mm", 0.2, 12.4, true) },
];

/// Edge of the rods, in mm.
const EDGE_MM: f64 = 0.5;
/// Foam: stress of collapse and modulus.
const FOAM: Surface = Surface::Inflated { kpa: 500.0, modulus_mpa: 3.0 };
/// Blunt metal that began to hurt the retina, and the energy at which it did, J.
static BLUNT: [TestObject; 3] = [
    kind("metal 2.6 g", 2.6, 6.35, true),
    kind("metal 3.5 g", 3.5, 9.25, true),
    kind("metal 45.5 g", 45.5, 11.16, true),
];
const ONSET_J: f64 = 1.20;
/// The risk at that onset.
const ONSET_RISK: f64 = 0.1;
/// How far the front edge's curve is known: judged, as its data are few and its diameters unknown.
const EDGE_KNOWN: f64 = 0.15;
/// Shares of a published energy between which the slope of a measure is taken.
const AROUND: [f64; 2] = [0.5, 2.0];

impl TestObject {
    fn fast(&self, speed_m_s: f64, species: Species, support: Support) -> Scenario {
        let model = Physiological { species, support, ..Physiological::default() };
        let object = (self.mass_g, self.diameter_mm, speed_m_s);
        let ball = projectile_at(self.name, model, object, None);
        let mut scenario = if self.rod { flat(ball, EDGE_MM) } else { ball };
        if let (true, Impact::Projectile(object)) = (self.foam, &mut scenario.impact) {
            object.surface = FOAM;
        }
        scenario
    }

    /// This object with an energy, in J, at an eye in gelatin.
    fn with(&self, energy: f64, species: Species) -> Scenario {
        let speed = (2.0 * energy / (self.mass_g * 1e-3)).sqrt();
        self.fast(speed, species, Support::Gelatin)
    }

    /// The same with an energy over the area of its face, J/m2.
    fn at(&self, energy: f64, species: Species) -> Scenario {
        self.with(energy * (FRAC_PI_4 * (self.diameter_mm * 1e-3).powi(2)), species)
    }
}

struct Match {
    injury: Injury,
    /// Published energies of 50 %, the least first, J/m2.
    half: &'static [f64],
    /// Spread of the published curve: a standard deviation of log10 of the energy.
    spread: f64,
    /// Whose eyes count.
    eyes: Eyes,
}

/// The spread of a published curve whose slope is assumed: its risk of nothing is 1 %.
const ASSUMED: f64 = 0.15;
type Eyes = &'static [Species];
const HUMAN: Eyes = &[Species::Human];
const BOTH: Eyes = &[Species::Human, Species::Pig];

const fn matched(injury: Injury, half: &'static [f64], spread: f64, eyes: Eyes) -> Match {
    Match { injury, half, spread, eyes }
}

/// What each curve is matched to. Spreads are those of a normal curve of log10 of the energy
/// through the two published risks, of several published curves their mean.
const MATCHES: [Match; 6] = [
    matched(Injury::GlobeRupture, &[34.2e3, 35.8e3], 0.267, HUMAN),
    matched(Injury::RetinaBack, &[30.351e3], ASSUMED, BOTH),
    matched(Injury::RetinaFront, &[30.351e3], ASSUMED, BOTH),
    matched(Injury::LensDislocation, &[19.194e3, 21.7e3], 0.5 * (0.0615 + ASSUMED), BOTH),
    matched(Injury::Hyphema, &[12.7e3, 20.188e3], 0.5 * (0.1745 + ASSUMED), BOTH),
    matched(Injury::CornealAbrasion, &[1.503e3], ASSUMED, HUMAN),
];

/// One kind of object at the published energy.
#[derive(Debug, Clone, PartialEq)]
pub struct KindFelt {
    /// The kind.
    pub kind: &'static str,
    /// The mean of what the tissue felt there, SI.
    pub felt: f64,
    /// The risk that the curve of all other kinds tells of it, where 50 % was published.
    pub told_by_others: f64,
}

/// The curve of one injury, found again.
#[derive(Debug, Clone, PartialEq)]
pub struct TissueFit {
    /// The injury.
    pub injury: Injury,
    /// Its point of 50 %, SI.
    pub half: f64,
    /// How much eyes differ.
    pub eyes: f64,
    /// How far the curve is known.
    pub known: f64,
    /// Slope of log10 of the measure over log10 of the energy.
    pub slope: f64,
    /// Standard deviation of log10 over kinds.
    pub disagreement: f64,
    /// Each kind.
    pub kinds: Vec<KindFelt>,
}

/// What all tissues feel; none where a run was refused.
fn felt(scenario: &Scenario) -> Option<PerInjury<f64>> {
    let answer = single(&scenario.check().ok()?, None, &mut unwatched).ok()?;
    Some(std::array::from_fn(|i| {
        let of = Injury::ALL[i].measure();
        answer.values[of].map_or(f64::NAN, |value| value / of.row().factor)
    }))
}

/// What the tissues felt in the scenarios that were asked for. Before they are run no number stands
/// for any of them, so that a first look for the curves notes which are needed.
#[derive(Default)]
struct Runs {
    asked: RefCell<Vec<Scenario>>,
    felt: Vec<Option<PerInjury<f64>>>,
}

impl Runs {
    /// log10 of what the tissue of `injury` felt.
    fn of(&self, injury: Injury, scenario: Scenario) -> Option<f64> {
        let mut asked = self.asked.borrow_mut();
        let place = asked.iter().position(|known| *known == scenario).unwrap_or_else(|| {
            asked.push(scenario);
            asked.len() - 1
        });
        let Some(felt) = self.felt.get(place) else { return Some(f64::NAN) };
        let felt = libm::log10((*felt)?[injury as usize]);
        felt.is_finite().then_some(felt)
    }
}

fn mean(of: &[f64]) -> f64 {
    of.iter().sum::<f64>() / of.len() as f64
}

/// Standard deviation of a sample.
fn deviation(of: &[f64]) -> f64 {
    let mean = mean(of);
    let squares: f64 = of.iter().map(|value| (value - mean).powi(2)).sum();
    (squares / (of.len() as f64 - 1.0)).sqrt()
}

impl Match {
    fn kinds(&self) -> impl Iterator<Item = &'static TestObject> {
        let foam = self.injury == Injury::CornealAbrasion;
        KINDS.iter().filter(move |kind| foam || !kind.foam)
    }

    /// The mean of log10 of what one kind brings about at `factor` times the published energies.
    fn felt(&self, kind: &TestObject, factor: f64, runs: &Runs) -> Option<f64> {
        let each = self.eyes.iter().flat_map(|species| {
            self.half.iter().map(|half| runs.of(self.injury, kind.at(half * factor, *species)))
        });
        Some(mean(&each.collect::<Option<Vec<f64>>>()?))
    }

    fn fit(&self, runs: &Runs) -> TissueFit {
        let injury = self.injury;
        let felt: Vec<(&'static TestObject, f64)> =
            self.kinds().filter_map(|kind| Some((kind, self.felt(kind, 1.0, runs)?))).collect();
        let slopes = self.kinds().filter_map(|kind| {
            let [low, high] = AROUND.map(|share| self.felt(kind, share, runs));
            Some((high? - low?) / libm::log10(AROUND[1] / AROUND[0]))
        });
        let logs: Vec<f64> = felt.iter().map(|(_, felt)| *felt).collect();
        let (slope, disagreement) = (mean(&slopes.collect::<Vec<_>>()), deviation(&logs));
        let published = self.half[self.half.len() - 1] / self.half[0];
        let apart = 0.5 * slope * libm::log10(published);
        let eyes = self.spread * slope;
        // Masses that are assumed move the mean by their share of it.
        let assumed = felt.iter().filter(|(kind, _)| kind.doubt_g > 0.0);
        let masses = assumed.filter_map(|(kind, felt)| {
            let heavier = TestObject { mass_g: kind.mass_g + kind.doubt_g, ..**kind };
            let moved = self.felt(&heavier, 1.0, runs)? - felt;
            Some((moved / logs.len() as f64).powi(2))
        });
        let masses: f64 = masses.sum::<f64>().sqrt();
        let (mut known, mut half) =
            (libm::hypot(libm::hypot(disagreement, apart), masses), mean(&logs));
        if injury == Injury::RetinaFront {
            known = EDGE_KNOWN;
            let onsets =
                BLUNT.iter().filter_map(|kind| runs.of(injury, kind.with(ONSET_J, Species::Pig)));
            half = mean(&onsets.collect::<Vec<_>>())
                - normal::quantile(ONSET_RISK) * libm::hypot(eyes, known);
        }
        let kinds = felt.iter().enumerate().map(|(i, (kind, felt))| {
            let others = [&logs[..i], &logs[i + 1..]].concat();
            let z = (felt - mean(&others)) / libm::hypot(eyes, known);
            let told_by_others = normal::below(z);
            KindFelt { kind: kind.name, felt: libm::pow(10.0, *felt), told_by_others }
        });
        TissueFit {
            injury,
            half: libm::pow(10.0, half),
            eyes,
            known,
            slope,
            disagreement,
            kinds: kinds.collect(),
        }
    }
}

fn found(runs: &Runs) -> Vec<TissueFit> {
    MATCHES.iter().map(|of| of.fit(runs)).collect()
}

/// Runs the kinds and finds the curves again; `progress` is told the share done.
pub fn fit_tissues(progress: impl FnMut(f64) + Send) -> Vec<TissueFit> {
    let needed = Runs::default();
    found(&needed);
    let asked = needed.asked.into_inner();
    let run = |index: usize| Some(felt(&asked[index]));
    // Nobody stops it.
    let felt =
        ordered::all(asked.len(), &AtomicBool::new(false), run, progress).unwrap_or_default();
    found(&Runs { asked: RefCell::new(asked), felt })
}
