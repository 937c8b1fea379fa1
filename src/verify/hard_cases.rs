//! Cases that break simulations, each against two references.
//!
//! The references take much shorter steps than the answer, on the same mesh, by two integrators
//! that share neither coefficients nor the treatment of drag: `SRKN11b` and RK4. Where they agree,
//! their difference from the answer is its true error; where they do not, nobody can tell, and an
//! answer without a flag that says so is wrong.

use crate::answer::{compiled::Compiled, results::Results, solve::Answer, solve::solve_case};
use crate::models::{paper::case::PaperCase, pulse::Piece};
use crate::run::flags::{Flag, FlagKind};
use crate::run::{kept::Keep, model::EyeModel, plan::Plan, refusal::Refusal, watch::unwatched};
use crate::scenario::Scenario;
use crate::scenario::{CheckedScenario, EyeInput, ForcePulse, Impact, Integrator, PulseShape};
use nalgebra::Vector2;
use rayon::prelude::*;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use strum::IntoStaticStr;

/// A true error below this, in %, is accurate enough; references that differ by more are none.
const ACCURATE_PERCENT: f64 = 1.0;
/// Speed at which two nodes are driven together, in m/s: fast enough to meet within a step or two.
const DRIVEN_M_S: f64 = 1000.0;

/// One hard case.
#[derive(Debug, Clone)]
pub struct HardCase {
    /// A few words.
    pub name: &'static str,
    stresses: &'static str,
    /// The scenario that is asked for.
    pub scenario: Scenario,
    start: Start,
    references: References,
}

/// What an eye starts from.
#[derive(Debug, Clone, Copy)]
enum Start {
    Rest,
    /// A node of the shell lies on its neighbour.
    OnOneSpot,
    /// The two nodes of the apex fly at each other.
    DrivenTogether,
}

/// The integrators of the references, and how many times more steps each takes in every segment.
type References = [(Integrator, f64); 2];

/// Errors fall with the sixth and fourth power, so the first is off by less than a hundredth of
/// any error that counts, and the second confirms it within 1 %.
const FINE: References = [(Integrator::Srkn11b, 3.0), (Integrator::Rk4, 8.0)];
/// For the one case that takes a quarter of a million steps.
const LONG: References = [(Integrator::Srkn11b, 1.5), (Integrator::Rk4, 4.0)];

/// The verdict on a case.
#[derive(Debug, Clone, Copy, PartialEq, Eq, IntoStaticStr)]
#[strum(serialize_all = "lowercase")]
pub enum CaseVerdict {
    /// No flag, and every listed result within its claimed step error or within 1 %.
    Accurate,
    /// The answer carries flags; numbers outside the claim are covered by one.
    Flagged,
    /// The answer says itself that it predicts nothing.
    #[strum(serialize = "not predictable")]
    NotPredictable,
    /// There is no answer, but a reason.
    Refused,
    /// An error that nothing warned of, or a number that is none.
    #[strum(serialize = "WRONG")]
    Wrong,
}

impl CaseVerdict {
    /// Name as printed and as used in JSON.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// A case with its verdict and errors.
#[derive(Debug, Clone)]
pub struct CaseOutcome {
    /// The case's name.
    pub name: &'static str,
    /// What it stresses.
    pub stresses: &'static str,
    /// The verdict.
    pub verdict: CaseVerdict,
    /// Largest true error of a leading result in %, where the references agree.
    pub true_error: Option<f64>,
    /// The step error that the answer claims, in %.
    pub claimed_error: Option<f64>,
    /// Largest energy residual in % of the work.
    pub energy_balance: Option<f64>,
    /// Flags of the answer.
    pub flags: Vec<FlagKind>,
    /// Why it was refused or is wrong, or how far the references differ.
    pub note: String,
}

fn scene(change: impl FnOnce(&mut ForcePulse, &mut EyeInput)) -> Scenario {
    let (mut pulse, mut eye) = (ForcePulse::default(), EyeInput::default());
    change(&mut pulse, &mut eye);
    Scenario { impact: Impact::ForcePulse(pulse), eye, ..Scenario::default() }
}

fn lasting(window_ms: f64, scenario: Scenario) -> Scenario {
    Scenario { window_ms: Some(window_ms), ..scenario }
}

/// The standard case by `integrator` at `share` of its stability limit.
fn at_limit(share: f64, integrator: Integrator) -> Scenario {
    let mut scenario = Scenario::default();
    let limit = PaperCase::new(&CheckedScenario::default()).step_limit(integrator);
    scenario.numerics.integrator = Some(integrator);
    scenario.numerics.step_us = Some((share * limit * 1e10).round() * 1e-4);
    scenario
}

/// All hard cases.
#[rustfmt::skip]
pub fn cases() -> Vec<HardCase> {
    let case = |name, stresses, scenario| HardCase { name, stresses, scenario, start: Start::Rest, references: FINE };
    vec![
        case("zero rise time", "the force jumps, and so does the acceleration",
            scene(|p, _| p.shape = PulseShape::SmoothRectangle { edge_fraction: 0.0 })),
        case("pulse of 1 us", "the load is shorter than a step",
            scene(|p, _| p.duration_ms = 1e-3)),
        case("10 kN", "thirty times the model's range", scene(|p, _| p.force_n = 1e4)),
        case("5 kN for 0.3 ms", "folding that lasts",
            scene(|p, _| { p.force_n = 5e3; p.duration_ms = 0.3; })),
        case("100 kN", "the largest force that may be asked", scene(|p, _| p.force_n = 1e5)),
        case("3 kN without damping", "chaotic folding: nothing calms it",
            lasting(10.0, scene(|p, e| {
                p.force_n = 3e3;
                p.angle_deg = 10.0;
                (e.globe_drag_ns_m, e.fat_drag_ns_m) = (0.0, 0.0);
            }))),
        case("1 kN", "a mesh that folds and opens again", scene(|p, _| p.force_n = 1e3)),
        case("1.2 kN", "one that stays folded", scene(|p, _| p.force_n = 1.2e3)),
        case("1.5 kN", "folding that has just begun", scene(|p, _| p.force_n = 1.5e3)),
        case("force on a single node", "the whole load on one mass, away from the axis",
            scene(|p, _| { p.angle_deg = 5.0; p.half_width_deg = 1e-3; })),
        case("at the edge, +40 deg", "half of the arc behind bone", scene(|p, _| p.angle_deg = 40.0)),
        case("at the edge, -40 deg", "the same from below", scene(|p, _| p.angle_deg = -40.0)),
        case("no damping for 50 ms", "energy drift; gaps of the integrators' stability",
            lasting(50.0, scene(|_, e| { e.globe_drag_ns_m = 0.0; e.fat_drag_ns_m = 0.0; }))),
        case("no damping for 50 ms, 30 N", "the same in small motion",
            lasting(50.0, scene(|p, e| { p.force_n = 30.0; e.globe_drag_ns_m = 0.0; e.fat_drag_ns_m = 0.0; }))),
        case("lens x1000", "stiffness: two scales of time", scene(|_, e| e.lens_kpa *= 1e3)),
        case("everything at 1 Pa", "no stiffness to bound the step",
            scene(|_, e| { e.sclera_kpa = 1e-3; e.fat_kpa = 1e-3; e.lens_kpa = 1e-3; e.rest_kpa = 1e-3; })),
        case("level 4", "a fine mesh", scene(|_, e| e.level = 4)),
        case("level 5, 1 ms", "the finest mesh in common use, a short window",
            lasting(1.0, scene(|_, e| e.level = 5))),
        case("level 6, 0.5 ms", "a mesh of 22,500 springs", lasting(0.5, scene(|_, e| e.level = 6))),
        case("level 7, 0.3 ms", "one of 30,000", lasting(0.3, scene(|_, e| e.level = 7))),
        case("level 8, 0.25 ms", "the finest mesh that may be asked", lasting(0.25, scene(|_, e| e.level = 8))),
        case("window of 1 us", "less time than a step takes", lasting(1e-3, Scenario::default())),
        case("window of 2 us", "the same with two", lasting(2e-3, Scenario::default())),
        case("1e-300 N", "a blow that rounding swallows", scene(|p, _| p.force_n = 1e-300)),
        case("1e-6 N", "a blow not far above rounding", scene(|p, _| p.force_n = 1e-6)),
        case("filaments off", "springs that are not there", scene(|_, e| e.filament_factor = 0.0)),
        case("filaments x100", "the stiffest springs are not in the grid", scene(|_, e| e.filament_factor = 100.0)),
        HardCase { start: Start::OnOneSpot,
            ..case("two nodes on one spot", "a length of zero at the start", Scenario::default()) },
        HardCase { start: Start::DrivenTogether,
            ..case("two nodes driven together", "a length that passes through zero", Scenario::default()) },
        case("srkn6b at 0.99 of its limit", "the largest step that is allowed",
            at_limit(0.99, Integrator::Srkn6b)),
        case("srkn6b at 1.01 of its limit", "a step that may blow up",
            at_limit(1.01, Integrator::Srkn6b)),
        case("verlet at 0.99 of its limit", "the largest step of the common method",
            at_limit(0.99, Integrator::VelocityVerlet)),
        case("euler at 1.01 of its limit", "a step that may blow up, with explicit drag",
            at_limit(1.01, Integrator::SemiImplicitEuler)),
        HardCase { references: LONG,
            ..case("1 s of simulated time", "rounding over a quarter of a million steps",
                lasting(1e3, Scenario::default())) },
    ]
}

impl HardCase {
    fn compiled(&self) -> Result<PaperCase, Refusal> {
        let mut case = PaperCase::new(&self.scenario.check()?);
        let marks = &case.eye.landmarks;
        let place = |n: usize| (case.system.place(n), case.eye.nodes[n].position);
        match self.start {
            Start::Rest => return Ok(case),
            Start::OnOneSpot => {
                let quarter = marks.shell.len() / 4;
                let (moved, _) = place(marks.shell[quarter]);
                let (_, onto) = place(marks.shell[quarter + 1]);
                case.start.set(moved, onto, Vector2::zeros());
            }
            Start::DrivenTogether => {
                let [(a, at_a), (b, at_b)] = marks.apex.map(place);
                let velocity = (at_b - at_a).normalize() * DRIVEN_M_S;
                case.start.set(a, at_a, velocity);
                case.start.set(b, at_b, -velocity);
            }
        }
        // What brought the nodes there counts as work, so that the energies add up.
        let survey = case.start.clone().evaluate(&case.system, Piece::Nothing);
        case.start.work = survey.elastic + survey.kinetic;
        Ok(case)
    }

    /// Solves the case and its references and compares.
    pub fn run(&self) -> CaseOutcome {
        let solved = self.compiled().and_then(|case| {
            let case = Compiled::with(Arc::new(case), &self.scenario);
            solve_case(case, &self.scenario, Keep::default(), &mut unwatched)
        });
        let answer = match solved {
            Ok(answer) => answer,
            Err(refusal) => return self.outcome(CaseVerdict::Refused, None, refusal.to_string()),
        };
        let reference = |(integrator, fineness): (Integrator, f64)| -> Result<_, Refusal> {
            let multiple = fineness * answer.plan.multiple;
            let plan = Plan { integrator, multiple, ..answer.plan };
            Ok(answer.case.results(&answer.case.run(&plan, Keep::default(), &mut unwatched)?))
        };
        let [first, second] = self.references;
        let (first, second) = rayon::join(|| reference(first), || reference(second));
        let failed = |refusal: Refusal| {
            let note = format!("a reference failed: {refusal}");
            self.outcome(CaseVerdict::Wrong, Some(&answer), note)
        };
        first.and_then(|first| Ok(self.judge(&answer, &first, &second?))).unwrap_or_else(failed)
    }

    fn outcome(&self, verdict: CaseVerdict, answer: Option<&Answer>, note: String) -> CaseOutcome {
        CaseOutcome {
            name: self.name,
            stresses: self.stresses,
            verdict,
            true_error: None,
            claimed_error: answer.map(|a| worst_error(&a.errors.time_step, &a.results())),
            energy_balance: answer.map(|a| a.errors.energy_balance),
            flags: answer.map_or_else(Vec::new, |a| a.flags.iter().map(|f| f.kind).collect()),
            note,
        }
    }

    fn judge(&self, answer: &Answer, first: &Results, second: &Results) -> CaseOutcome {
        let results = answer.results();
        let claimed = &answer.errors.time_step;
        let finite = |numbers: &Results| numbers.present().all(|(_, n)| n.is_finite());
        if ![&results, claimed, first, second].into_iter().all(finite) {
            let note = "a result or its error is not a finite number".to_owned();
            return self.outcome(CaseVerdict::Wrong, Some(answer), note);
        }
        // In % of the answer, as claims are.
        let between = worst_error(&second.apart_percent(first, &results), &results);
        let truth = first.difference_percent(&results);
        let known = between <= ACCURATE_PERCENT;
        let worst = truth
            .watched()
            .filter_map(|(quantity, truth)| Some((quantity, truth, claimed[quantity]?)))
            .filter(|(_, truth, claimed)| truth > claimed)
            .filter(|(of, ..)| !results[*of].is_some_and(|value| of.is_rounding(value)))
            .max_by(|a, b| a.1.total_cmp(&b.1));
        let within = worst.is_none_or(|(_, truth, _)| truth <= ACCURATE_PERCENT);
        let unproven = !known || !within;
        let verdict = if answer.flags.iter().any(|flag| flag.kind == FlagKind::NotPredictable) {
            CaseVerdict::NotPredictable
        } else if unproven && !answer.flags.iter().any(doubts_numbers) {
            CaseVerdict::Wrong
        } else if answer.flags.is_empty() {
            CaseVerdict::Accurate
        } else {
            CaseVerdict::Flagged
        };
        let note = if !known {
            format!("two references disagree by {between:.1} %")
        } else if let Some((quantity, truth, claimed)) = worst {
            format!("{} is off by {truth:.1e} %, its claim is {claimed:.1e} %", quantity.key())
        } else {
            String::new()
        };
        CaseOutcome {
            true_error: known.then(|| worst_error(&truth, &results)),
            ..self.outcome(verdict, Some(answer), note)
        }
    }
}

/// The largest error of a listed result, in %.
fn worst_error(errors: &Results, results: &Results) -> f64 {
    errors.worst_listed(results).map_or(0.0, |(_, error)| error)
}

/// Whether a flag says that the numbers, and not only their meaning, are in doubt.
fn doubts_numbers(flag: &Flag) -> bool {
    use FlagKind as F;
    [F::MeshFolded, F::Unconverged, F::EnergyImbalance, F::LostInRounding].contains(&flag.kind)
}

/// Runs all cases on all cores, in their order; `progress` is told the share that is done.
pub fn run(progress: &(dyn Fn(f64) + Sync)) -> Vec<CaseOutcome> {
    let cases = cases();
    let done = AtomicUsize::new(0);
    let outcome = |case: &HardCase| {
        let outcome = case.run();
        progress((done.fetch_add(1, Ordering::Relaxed) + 1) as f64 / cases.len() as f64);
        outcome
    };
    cases.par_iter().with_max_len(1).map(outcome).collect()
}
