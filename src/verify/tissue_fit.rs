//! Where the curves of injury against what tissues felt come from, so that anybody can repeat it.
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
use crate::answer::uncertain::{WITH_CURVES, inputs};
use crate::injury::{Injury, PerInjury, SPEEDS};
use crate::normal;
use crate::run::ordered::{self, until};
use crate::run::refusal::Refusal;
use crate::scenario::{
    Impact, Model, Outline, Physiological, Projectile, Scenario, Species, Support, Surface,
};
use crate::scenario::{fields::find, set::put_number};
use std::f64::consts::FRAC_PI_4;
use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

/// An object that eyes were tested with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TestObject {
    /// Its name for people.
    pub name: &'static str,
    /// In g.
    pub mass_g: f64,
    /// In mm.
    pub diameter_mm: f64,
    /// Whether it is a rod with a flat face; else a ball.
    pub rod: bool,
    /// A standard deviation of the mass, in g, where it is assumed.
    pub doubt_g: f64,
    /// Whether it is the foam of an airbag's cover, which only abrasions were seen from.
    pub foam: bool,
}

const fn kind(name: &'static str, mass_g: f64, diameter_mm: f64, rod: bool) -> TestObject {
    TestObject { name, mass_g, diameter_mm, rod, doubt_g: 0.0, foam: false }
}

/// The kinds behind the energy curves.
pub static KINDS: [TestObject; 6] = [
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
/// Energy over area at which the data end, J/m2.
const END: f64 = 100e3;
/// Shares of a published energy between which the slope of a measure is taken.
const AROUND: [f64; 2] = [0.5, 2.0];

impl TestObject {
    /// This object at a speed.
    fn at(&self, speed_m_s: f64, species: Species, support: Support) -> Scenario {
        let mut projectile = Projectile {
            mass_g: self.mass_g,
            diameter_mm: self.diameter_mm,
            speed_m_s,
            ..Projectile::default()
        };
        if self.rod {
            projectile.outline = Outline::Cylinder { edge_mm: EDGE_MM };
        }
        if self.foam {
            projectile.surface = FOAM;
        }
        let model = Physiological { species, support, ..Physiological::default() };
        Scenario {
            name: self.name.to_owned(),
            model: Model::Physiological(model),
            impact: Impact::Projectile(projectile),
            ..Scenario::default()
        }
    }

    /// The speed of an energy, in J.
    fn speed(&self, energy: f64) -> f64 {
        (2.0 * energy / (self.mass_g * 1e-3)).sqrt()
    }

    /// This object with a mass one standard deviation larger, where that is assumed.
    fn heavier(&self) -> Option<Self> {
        (self.doubt_g > 0.0).then_some(Self {
            mass_g: self.mass_g + self.doubt_g,
            doubt_g: 0.0,
            ..*self
        })
    }

    /// The area of its face, in m2.
    fn area(&self) -> f64 {
        FRAC_PI_4 * (self.diameter_mm * 1e-3).powi(2)
    }
}

/// What the curve of an injury is matched to.
struct Match {
    injury: Injury,
    /// Published energies of 50 %, J/m2.
    half: &'static [f64],
    /// Spread of the published curve: a standard deviation of log10 of the energy.
    spread: f64,
    /// Whether pigs' eyes count beside human ones.
    pigs: bool,
}

/// The spread of a published curve whose slope is assumed: its risk of nothing is 1 %.
const ASSUMED: f64 = 0.15;

/// What each curve is matched to. Spreads are those of a normal curve of log10 of the energy
/// through the two published risks, of several published curves their mean.
const MATCHES: [Match; 6] = [
    Match { injury: Injury::GlobeRupture, half: &[34.2e3, 35.8e3], spread: 0.267, pigs: false },
    Match { injury: Injury::RetinaBack, half: &[30.351e3], spread: ASSUMED, pigs: true },
    Match { injury: Injury::RetinaFront, half: &[30.351e3], spread: ASSUMED, pigs: true },
    Match {
        injury: Injury::LensDislocation,
        half: &[19.194e3, 21.7e3],
        spread: 0.5 * (0.0615 + ASSUMED),
        pigs: true,
    },
    Match {
        injury: Injury::Hyphema,
        half: &[12.7e3, 20.188e3],
        spread: 0.5 * (0.1745 + ASSUMED),
        pigs: true,
    },
    Match { injury: Injury::CornealAbrasion, half: &[1.503e3], spread: ASSUMED, pigs: false },
];

/// One kind of object at the published energy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct KindFelt {
    /// The kind.
    pub kind: &'static TestObject,
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
    /// The largest of the kinds at the end of the data, SI.
    pub end: f64,
    /// Each kind.
    pub kinds: Vec<KindFelt>,
}

/// All that is found again.
#[derive(Debug, Clone, PartialEq)]
pub struct TissueFits {
    /// One for each injury.
    pub injuries: Vec<TissueFit>,
    /// How they go with inputs of the model.
    pub with_inputs: Vec<WithInput>,
    /// What the tissues feel of the BBs of [`SPEEDS`], SI.
    pub bb: PerInjury<[f64; SPEEDS.len()]>,
}

/// What all tissues feel; none where a run was refused.
type Felt = Option<PerInjury<f64>>;

/// One run that is needed.
#[derive(Clone, Copy, PartialEq)]
struct Job {
    kind: TestObject,
    speed: f64,
    species: Species,
    support: Support,
    /// Another value of an input of the model.
    change: Option<(&'static str, f64)>,
}

/// Runs that were asked for, each once.
struct Runs {
    jobs: Vec<Job>,
    felt: Vec<Felt>,
}

impl Runs {
    fn done(
        jobs: Vec<Job>,
        stop: &AtomicBool,
        mut progress: impl FnMut(f64) + Send,
    ) -> Result<Self, Refusal> {
        let mut felt = Vec::new();
        let job = |index: usize| {
            let Job { kind, speed, species, support, change } = jobs[index];
            let mut scenario = kind.at(speed, species, support);
            if let Some((field, value)) = change.and_then(|(path, v)| Some((find(path)?, v))) {
                put_number(&mut scenario, field, value);
            }
            match scenario
                .check()
                .map_err(Refusal::Scenario)
                .and_then(|checked| single(&checked, None, &mut until(stop)))
            {
                Err(Refusal::Cancelled) => None,
                Err(_) => Some(None),
                Ok(answer) => {
                    let one = |injury: &Injury| {
                        let of = injury.measure();
                        answer.values[of].map_or(f64::NAN, |value| value / of.row().factor)
                    };
                    Some(Some(std::array::from_fn(|i| one(&Injury::ALL[i]))))
                }
            }
        };
        ordered::run((0, jobs.len()), stop, job, |_, one: Felt| {
            felt.push(one);
            progress(felt.len() as f64 / jobs.len() as f64);
            ControlFlow::Continue(())
        });
        if felt.len() < jobs.len() {
            return Err(Refusal::Cancelled);
        }
        Ok(Self { jobs, felt })
    }

    /// log10 of what the tissue of `injury` felt.
    fn of(&self, injury: Injury, job: Job) -> Option<f64> {
        let place = self.jobs.iter().position(|known| *known == job)?;
        let felt = libm::log10(self.felt[place]?[injury as usize]);
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

/// A kind at an energy over area, J/m2.
fn at(kind: &TestObject, energy: f64, species: Species) -> Job {
    Job {
        kind: *kind,
        speed: kind.speed(energy * kind.area()),
        species,
        support: Support::Gelatin,
        change: None,
    }
}

fn onset(kind: &TestObject) -> Job {
    Job {
        kind: *kind,
        speed: kind.speed(ONSET_J),
        species: Species::Pig,
        support: Support::Gelatin,
        change: None,
    }
}

fn bb(speed: f64) -> Job {
    Job { kind: KINDS[0], speed, species: Species::Human, support: Support::Orbit, change: None }
}

impl Match {
    fn species(&self) -> &'static [Species] {
        if self.pigs { &[Species::Human, Species::Pig] } else { &[Species::Human] }
    }

    /// The kinds that it rests on.
    fn kinds(&self) -> impl Iterator<Item = &'static TestObject> {
        let foam = self.injury == Injury::CornealAbrasion;
        KINDS.iter().filter(move |kind| foam || !kind.foam)
    }

    /// Every run that it needs.
    fn jobs(&self) -> Vec<Job> {
        let mut jobs = Vec::new();
        for kind in self.kinds() {
            for species in self.species() {
                for half in self.half {
                    for share in [AROUND[0], 1.0, AROUND[1]] {
                        jobs.push(at(kind, half * share, *species));
                    }
                }
            }
            jobs.push(at(kind, END, Species::Human));
            if let Some(heavier) = kind.heavier() {
                let each = self.species().iter();
                jobs.extend(each.flat_map(|species| {
                    self.half.iter().map(move |half| at(&heavier, *half, *species))
                }));
            }
        }
        jobs
    }

    /// The mean of log10 of what one kind brings about at `factor` times the published energies.
    fn felt(&self, kind: &TestObject, factor: f64, runs: &Runs) -> Option<f64> {
        let mut all = Vec::new();
        for species in self.species() {
            for half in self.half {
                all.push(runs.of(self.injury, at(kind, half * factor, *species))?);
            }
        }
        Some(mean(&all))
    }

    fn fit(&self, runs: &Runs) -> TissueFit {
        let injury = self.injury;
        let felt: Vec<(&'static TestObject, f64)> =
            self.kinds().filter_map(|kind| Some((kind, self.felt(kind, 1.0, runs)?))).collect();
        let slopes: Vec<f64> = self
            .kinds()
            .filter_map(|kind| {
                let [low, high] = AROUND.map(|share| self.felt(kind, share, runs));
                Some((high? - low?) / libm::log10(AROUND[1] / AROUND[0]))
            })
            .collect();
        let ends: Vec<f64> = self
            .kinds()
            .filter(|kind| !kind.foam)
            .filter_map(|kind| runs.of(injury, at(kind, END, Species::Human)))
            .collect();
        let logs: Vec<f64> = felt.iter().map(|(_, felt)| *felt).collect();
        let (slope, disagreement) = (mean(&slopes), deviation(&logs));
        let published = self
            .half
            .iter()
            .fold((f64::INFINITY, 0.0_f64), |(low, high), half| (half.min(low), half.max(high)));
        let apart = 0.5 * slope * libm::log10(published.1 / published.0);
        let eyes = self.spread * slope;
        // Masses that are assumed move the mean by their share of it.
        let masses = felt.iter().filter_map(|(kind, felt)| {
            let moved = self.felt(&kind.heavier()?, 1.0, runs)? - felt;
            Some((moved / logs.len() as f64).powi(2))
        });
        let masses: f64 = masses.sum::<f64>().sqrt();
        let (mut known, mut half) =
            (libm::hypot(libm::hypot(disagreement, apart), masses), mean(&logs));
        if injury == Injury::RetinaFront {
            known = EDGE_KNOWN;
            let onsets: Vec<f64> =
                BLUNT.iter().filter_map(|kind| runs.of(injury, onset(kind))).collect();
            half = mean(&onsets) - normal::quantile(ONSET_RISK) * libm::hypot(eyes, known);
        }
        let kinds = felt.iter().enumerate().map(|(i, (kind, felt))| {
            let others: Vec<f64> =
                logs.iter().enumerate().filter(|(j, _)| *j != i).map(|(_, l)| *l).collect();
            let z = (felt - mean(&others)) / libm::hypot(eyes, known);
            KindFelt { kind, felt: libm::pow(10.0, *felt), told_by_others: normal::below(z) }
        });
        TissueFit {
            injury,
            half: libm::pow(10.0, half),
            eyes,
            known,
            slope,
            disagreement,
            end: libm::pow(10.0, ends.into_iter().fold(f64::NEG_INFINITY, f64::max)),
            kinds: kinds.collect(),
        }
    }
}

/// How the points of 50 % go with an input: log10 of each over log10 of the input, below the
/// model's own value and above it.
#[derive(Debug, Clone, PartialEq)]
pub struct WithInput {
    /// Path of the input.
    pub path: &'static str,
    /// Below and above.
    pub powers: [PerInjury<f64>; 2],
}

/// A kind at an energy in an eye with another value of an input.
fn moved(of: &Match, kind: &TestObject, change: (&'static str, f64)) -> Job {
    Job { change: Some(change), ..at(kind, of.half[0], Species::Human) }
}

/// The values one standard deviation below and above the model's own, and that one.
fn sides(path: &str) -> Option<([f64; 2], f64)> {
    let scenario = KINDS[0].at(1.0, Species::Human, Support::Gelatin);
    let input = inputs(&scenario).into_iter().find(|input| input.field.path == path)?;
    Some(([-1.0, 1.0].map(|side| input.value(normal::below(side))), input.nominal))
}

fn with_input(path: &'static str, runs: &Runs) -> Option<WithInput> {
    let (values, nominal) = sides(path)?;
    let power = |of: &Match, value: f64| {
        let each: Vec<f64> = of
            .kinds()
            .filter_map(|kind| {
                let from = runs.of(of.injury, at(kind, of.half[0], Species::Human))?;
                Some(runs.of(of.injury, moved(of, kind, (path, value)))? - from)
            })
            .collect();
        mean(&each) / libm::log10(value / nominal)
    };
    let powers = values.map(|value| std::array::from_fn(|i| power(&MATCHES[i], value)));
    Some(WithInput { path, powers })
}

/// Runs the kinds and finds the curves again; `progress` is told the share done.
///
/// # Errors
/// [`Refusal::Cancelled`] if it was stopped.
pub fn fit_tissues(
    stop: &AtomicBool,
    progress: impl FnMut(f64) + Send,
) -> Result<TissueFits, Refusal> {
    let mut jobs: Vec<Job> = Vec::new();
    let needed = MATCHES.iter().flat_map(Match::jobs);
    let paths = WITH_CURVES.iter().map(|(path, _)| *path);
    let with_inputs = paths.clone().flat_map(|path| {
        let values = sides(path).map_or([f64::NAN; 2], |(values, _)| values);
        let of = MATCHES.iter().flat_map(|of| of.kinds().map(move |kind| (of, kind)));
        let jobs = of.flat_map(move |(of, kind)| values.map(|v| moved(of, kind, (path, v))));
        jobs.collect::<Vec<_>>()
    });
    let needed = needed.chain(with_inputs);
    for job in needed.chain(BLUNT.iter().map(onset)).chain(SPEEDS.map(bb)) {
        if !jobs.contains(&job) {
            jobs.push(job);
        }
    }
    let runs = Runs::done(jobs, stop, progress)?;
    let felt = |injury: Injury, speed: f64| {
        runs.of(injury, bb(speed)).map_or(f64::NAN, |log| libm::pow(10.0, log))
    };
    Ok(TissueFits {
        injuries: MATCHES.iter().map(|of| of.fit(&runs)).collect(),
        with_inputs: paths.filter_map(|path| with_input(path, &runs)).collect(),
        bb: std::array::from_fn(|i| SPEEDS.map(|speed| felt(Injury::ALL[i], speed))),
    })
}
