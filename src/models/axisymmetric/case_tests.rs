//! The axisymmetric model through the trait of all models: answers, flags, errors, frames.

use crate::answer::mesh_error::add_mesh_error;
use crate::answer::solve::tests::{answered, answered_with};
use crate::answer::solve::{Answer, solve};
use crate::answer::{brief::compared, compiled::Compiled};
use crate::run::watch::unwatched;
use crate::run::{flags::FlagKind, kept::Keep, plan::Plan, quantity::Quantity, refusal::Refusal};
use crate::scenario::set::set;
use crate::scenario::{
    ForcePulse, Geometry, Impact, NumericsInput, Outline, Projectile, Scenario, Surface,
};
use std::ops::ControlFlow;
use std::sync::atomic::AtomicBool;

fn scene(projectile: Projectile) -> Scenario {
    Scenario {
        window_ms: Some(1.0),
        numerics: NumericsInput { geometry: Geometry::Axisymmetric, ..NumericsInput::default() },
        ..Scenario::of(Impact::Projectile(projectile))
    }
}

fn bb(speed_m_s: f64) -> Projectile {
    Projectile { mass_g: 0.345, diameter_mm: 4.5, speed_m_s, ..Projectile::default() }
}

fn refused(scenario: &Scenario) -> Refusal {
    let checked = scenario.check().unwrap();
    solve(&checked, Keep::default(), &mut unwatched).unwrap_err()
}

#[test]
fn a_surface_that_is_used_up_is_flagged_and_one_that_is_not_is_not() {
    let of = |modulus_mpa| {
        let surface = Surface::Elastic { modulus_mpa };
        answered(&scene(Projectile { surface, ..bb(30.0) }))
    };
    let (softer, soft, hard) = (of(0.001), of(0.002), of(1e3));
    let crushed = [&softer, &soft, &hard].map(|answer| answer.has(FlagKind::SurfaceCrushed));
    assert_eq!(crushed, [true, true, false]);
    // What is behind it is hard, whatever the surface was.
    let force = |answer: &Answer| answer.result(Quantity::Contact).unwrap();
    assert!((force(&soft) / force(&softer) - 1.0).abs() < 0.02);
}

#[test]
fn what_goes_through_the_eye_is_refused_with_its_field_and_the_next_step() {
    let refused = |projectile: Projectile| {
        let refusal = refused(&scene(projectile));
        assert!(refusal.is_of_input());
        refusal.to_string()
    };
    let grain = refused(Projectile { mass_g: 1e-3, diameter_mm: 0.1, ..bb(62.5) });
    assert!(grain.starts_with("impact.diameter_mm: 0.10 mm is narrower"), "{grain}");
    assert!(grain.contains("allowed 1.36 mm or more, or a finer mesh"), "{grain}");
    let heavy = refused(Projectile { mass_g: 10.0, diameter_mm: 3.0, ..bb(62.5) });
    assert!(heavy.starts_with("impact.speed_m_s: 62.5 m/s is too fast"), "{heavy}");
}

#[test]
fn its_own_step_may_be_asked_for_but_no_other_integrator() {
    use crate::scenario::Integrator;
    let mut scenario = scene(bb(56.0));
    scenario.window_ms = Some(0.2);
    let plain = answered(&scenario);
    scenario.numerics.integrator = Some(Integrator::VelocityVerlet);
    scenario.numerics.step_us = Some(0.5 * plain.step * 1e6);
    let finer = answered(&scenario);
    assert!((finer.step / plain.step - 0.5).abs() < 1e-9);
    let steps = finer.run.cost.steps as f64 / plain.run.cost.steps as f64;
    assert!((1.8..2.2).contains(&steps), "{steps}");
    assert!(finer.errors.time_step_percent().unwrap() < plain.errors.time_step_percent().unwrap());
    scenario.numerics.step_us = Some(1.01 * plain.step_limit * 1e6);
    assert!(matches!(refused(&scenario), Refusal::StepAboveLimit { .. }));
    scenario.numerics.integrator = Some(Integrator::Rk4);
    let unfit = refused(&scenario).to_string();
    assert!(unfit.contains("allowed Auto, VelocityVerlet"), "{unfit}");
}

#[test]
fn a_bb_gives_every_result_that_the_axisymmetric_eye_has_and_closes_its_energy() {
    let mut answer = answered(&scene(bb(56.0)));
    let results = answer.results();
    let missing: Vec<_> = Quantity::ALL.iter().filter(|of| results[**of].is_none()).collect();
    assert_eq!(missing, [&Quantity::StoredEnergy]);
    for (of, expected) in [(Quantity::Pressure, 0.3..2.0), (Quantity::ScleralStress, 5.0..30.0)] {
        let mpa = results[of].unwrap();
        assert!(expected.contains(&mpa), "{mpa} MPa");
    }
    assert!(answer.errors.energy_balance < 1.0);
    assert!(answer.errors.time_step_percent().unwrap() < 5.0);
    assert!(!answer.has(FlagKind::MeshFolded));
    add_mesh_error(&scene(bb(56.0)), &mut answer, &mut unwatched).unwrap();
    let mesh = answer.errors.mesh.unwrap();
    assert!(mesh[Quantity::Pressure].unwrap() < 30.0);
    assert_eq!(mesh[Quantity::GlobeRupture], None);
}

#[test]
fn a_stated_step_error_covers_the_difference_from_a_far_finer_run() {
    for (projectile, angle_deg) in [(bb(56.0), 0.0), (bb(92.0), 30.0)] {
        let scenario = scene(Projectile { angle_deg, ..projectile });
        let answer = answered(&Scenario { window_ms: Some(0.5), ..scenario });
        let case = &answer.case;
        let finer = Plan { multiple: 12.5, ..answer.plan };
        let exact = case.run(&finer, Keep::default(), &mut unwatched).unwrap();
        let exact = case.results(&exact);
        let off = exact.difference_percent(&answer.results());
        for (of, off) in off.leading() {
            let stated = answer.errors.time_step[of].unwrap();
            assert!(off <= stated, "{}: {off} of {stated}", of.key());
        }
    }
}

#[test]
fn a_pulse_acts_on_it_too_and_has_no_result_of_an_object() {
    let answer = answered(&Scenario { impact: Scenario::default().impact, ..scene(bb(1.0)) });
    let results = answer.results();
    for none in [Quantity::Contact, Quantity::Intrusion, Quantity::Rebound] {
        assert_eq!(results[none], None);
    }
    assert!(results[Quantity::Pressure].unwrap() > 0.01);
}

#[test]
fn an_angle_beyond_trust_and_a_window_that_cuts_the_contact_are_flagged() {
    let scenario = scene(Projectile { angle_deg: 50.0, ..bb(20.0) });
    let answer = answered(&Scenario { window_ms: Some(0.05), ..scenario });
    for kind in [FlagKind::AngleBeyondTrust, FlagKind::ContactCut, FlagKind::WindowShort] {
        assert!(answer.has(kind), "{kind:?}");
    }
    assert!(!answer.has(FlagKind::WindowCapped));
    assert_eq!((answer.run.simulated, answer.window()), (0.05e-3, 0.05e-3));
}

fn short() -> Scenario {
    Scenario { window_ms: Some(0.1), ..scene(bb(30.0)) }
}

#[test]
fn an_ensemble_draws_what_is_doubted_of_the_model_and_of_the_object() {
    use crate::many::ensemble::{PILOT, run};
    let mut scenario = short();
    set(&mut scenario, "model.sclera_mpa", "138 ± 20").unwrap();
    set(&mut scenario, "impact.speed_m_s", "30 ± 2").unwrap();
    let checked = scenario.check().unwrap();
    let on = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().unwrap();
        let stop = AtomicBool::new(false);
        pool.install(|| run(&checked, (16, 1), None, &stop, &|_| ControlFlow::Continue(())))
            .unwrap()
    };
    let ensemble = on(2);
    assert_eq!(ensemble.samples, on(1).samples);
    assert_eq!(ensemble.samples.len(), 16);
    for of in [Quantity::Contact, Quantity::ScleralStress, Quantity::Rebound] {
        let band = ensemble.band(of).unwrap();
        assert!(band.low < band.median && band.median < band.high, "{of:?}");
    }
    let checks = ensemble.checks();
    assert_eq!(checks.count, PILOT as usize);
    assert!(checks.leading <= ensemble.promise && checks.last >= checks.leading, "{checks:?}");
}

#[test]
fn a_sweep_and_a_map_hold_its_results_and_leave_out_what_it_has_not() {
    use crate::many::map::{Grid, Span, Spot, fill};
    use crate::many::sweep::{Sweep, SweepAxis};
    use crate::scenario::fields::find;
    let axis = |text: &str| SweepAxis::read(text).unwrap();
    let axes = vec![axis("model.support=Orbit,Free"), axis("impact.speed_m_s=20,40")];
    let sweep = Sweep::new(short(), axes).unwrap();
    let row = |i| sweep.run(i, &mut unwatched).unwrap().outcome.unwrap();
    let (slow, fast) = (row(0), row(1));
    let of = Quantity::BackPressure;
    assert!(slow.values[of].unwrap() < fast.values[of].unwrap());
    assert!(slow.check.unwrap().leading <= 1.0);
    assert!(row(3).values[Quantity::StoredEnergy].is_none());

    let span = |path, from, to| Span { field: find(path).unwrap(), from, to };
    let spans = (span("impact.speed_m_s", 10.0, 40.0), span("impact.angle_deg", 0.0, 100.0));
    let go = |_: &Grid| ControlFlow::Continue(());
    let grid = fill(&short(), spans, Grid::new(3), &AtomicBool::new(false), &go);
    let value = |at| grid.at(at).and_then(|spot| spot.value(Quantity::ScleralStress));
    assert!(value((0, 0)).unwrap() < value((2, 0)).unwrap());
    assert_eq!(grid.at((0, 2)), Some(&Spot::Refused), "beyond 90 degrees");
}

#[test]
fn its_accuracy_is_measured_over_shares_of_its_own_bound_and_over_its_levels() {
    use crate::answer::compiled::Compiled;
    use crate::many::accuracy::{Trial, measure};
    use crate::run::rules::Element;
    let checked = short().check().unwrap();
    let accuracy = measure(&checked, 1, None, &mut unwatched, &mut |_| {}).unwrap();
    assert_eq!(accuracy.element, Element::Cell);
    let case = Compiled::new(&checked);
    let bound = |trial: &Trial| case.step_limit(trial.plan.integrator);
    for pair in accuracy.trials.windows(2) {
        let [longer, shorter] = pair else { panic!() };
        assert!(longer.step < bound(longer) && shorter.step < bound(shorter));
        if longer.plan.integrator == shorter.plan.integrator && shorter.step < longer.step {
            assert!(shorter.elements > longer.elements);
        }
    }
    let integrators = accuracy.trials.chunk_by(|a, b| a.plan.integrator == b.plan.integrator);
    assert_eq!(integrators.count(), 2);
    let (coarse, fine) = (&accuracy.levels[0], &accuracy.levels[1]);
    assert!(fine.elements > coarse.elements && accuracy.levels.len() == 3);
    let totals = accuracy.of(Quantity::Pressure);
    let most = |a: f64, b: f64| a.max(b);
    let by_step = totals.iter().map(|total| total.by_step);
    let (largest, least) = (by_step.clone().fold(0.0, most), by_step.fold(1e9, f64::min));
    assert!(least < 0.5 * largest && totals[0].mesh > 0.0);
}

#[test]
fn a_crushed_front_says_how_many_cells_folded_and_where() {
    let (force_n, duration_ms, half_width_deg) = (3000.0, 0.02, 3.0);
    let pulse = ForcePulse { force_n, duration_ms, half_width_deg, ..ForcePulse::default() };
    let narrow = Scenario { impact: Impact::ForcePulse(pulse), ..short() };
    let answer = answered(&Scenario { window_ms: Some(0.03), ..narrow });
    let fold = answer.run.fold.expect("3 kN on 1 mm folds cells");
    assert!(fold.quads > 0 && fold.quads < fold.of / 4, "{fold:?}");
    assert!(fold.front_angle().to_degrees() < 15.0 && fold.radius() < 12e-3);
    assert!(fold.lasted >= 0.0 && fold.since + fold.lasted <= 0.03e-3 + 1e-12);
    let flag = answer.flags.iter().find(|f| f.kind == FlagKind::MeshFolded);
    let said = flag.unwrap().whole();
    assert!(said.contains(&format!("{} of {} cells", fold.quads, fold.of)));
    assert!(said.contains("by the front, inside the globe"), "{said}");
}

#[test]
fn neighbouring_angles_have_neighbouring_stresses_where_the_sclera_comes_under_the_object() {
    let stress = |angle_deg: f64| {
        let turned = scene(Projectile { angle_deg, ..bb(62.5) });
        let answer = answered(&Scenario { window_ms: Some(0.4), ..turned });
        answer.result(Quantity::ScleralStress).unwrap()
    };
    let stresses: Vec<f64> = (0..=20).map(|i| stress(24.0 + 0.25 * f64::from(i))).collect();
    for pair in stresses.windows(2) {
        assert!((pair[1] / pair[0] - 1.0).abs() < 0.02, "{stresses:?}");
    }
}

#[test]
fn what_bone_or_the_cup_keeps_off_the_eye_does_nothing_and_is_said_to() {
    let mut wide = scene(Projectile {
        mass_g: 8.0,
        diameter_mm: 50.0,
        speed_m_s: 34.0,
        outline: Outline::Cylinder { edge_mm: 4.0 },
        ..Projectile::default()
    });
    set(&mut wide, "model.support", "Gelatin").unwrap();
    let answer = answered(&wide);
    for quantity in [Quantity::Damage, Quantity::Energy, Quantity::Pressure, Quantity::Contact] {
        assert_eq!(answer.result(quantity), Some(0.0), "{quantity:?}");
    }
    assert!(answer.errors.time_step_percent().unwrap() < 0.1);
    assert!(answer.has(FlagKind::RimStops) && answer.has(FlagKind::EyeMissed));
}

#[test]
fn a_tolerance_chooses_level_and_step_or_says_why_it_cannot() {
    use crate::answer::choose::{Ladder, within};
    let checked = short().check().unwrap();
    let chosen = within(&mut Ladder::default(), &checked, 60.0, &mut unwatched).unwrap();
    let of = Quantity::Damage;
    let step = chosen.answer.errors.time_step[of].unwrap();
    let mesh = chosen.answer.errors.mesh.unwrap()[of].unwrap();
    assert!(step + mesh <= 60.0 && !chosen.reasons.is_empty());
    let refused = within(&mut Ladder::default(), &checked, 0.01, &mut unwatched).unwrap_err();
    assert!(refused.to_string().contains("levels 1 to 5"), "{refused}");
}

#[test]
fn frames_come_at_the_asked_instants_and_traces_hold_the_peaks() {
    use crate::run::kept::Spacing;
    let keep = Keep { traces: true, frames: Some(Spacing::even(7e-6)) };
    let answer = answered_with(&short(), keep);
    assert_eq!(answer.run.frames.len(), 15);
    for (i, frame) in answer.run.frames.iter().enumerate() {
        assert!((frame.time - 7e-6 * i as f64).abs() < 1e-12);
        assert_eq!(frame.cells.len(), answer.case.eye.elements());
    }
    let traces = answer.run.traces.as_ref().unwrap();
    for &of in Quantity::ALL {
        let peak = answer.peak(of).filter(|peak| peak.value > 0.0);
        if let (Some(peak), Some(trace)) = (peak, of.row().trace) {
            let largest = (trace.values)(traces).iter().copied().fold(0.0, f64::max);
            let share = largest / peak.value;
            assert!((0.97..1.0 + 1e-9).contains(&share), "{} {share}", of.key());
        }
    }
}

#[test]
fn a_run_beside_one_of_twice_as_many_steps_states_its_whole_error() {
    let steel = "Projectile(mass_g: 184, diameter_mm: 54, speed_m_s: 7.9)";
    let sets: [&[(&str, &str)]; 4] = [
        &[("window_ms", "0.5")],
        &[("window_ms", "0.5"), ("impact.speed_m_s", "60")],
        &[("window_ms", "0.5"), ("model.support", "Free"), ("impact.speed_m_s", "90")],
        &[("impact", steel), ("model.support", "Gelatin"), ("window_ms", "3")],
    ];
    for sets in sets {
        let mut scenario = scene(bb(30.0));
        for (path, text) in sets {
            set(&mut scenario, path, text).unwrap();
        }
        let scenario = scenario.check().unwrap();
        let answer = compared(&scenario, None, &mut unwatched).unwrap();
        let case = Compiled::new(&scenario);
        let exact = Plan { multiple: 24.0, ..case.plan(&scenario).unwrap() };
        let exact = case.run(&exact, Keep::default(), &mut unwatched).unwrap();
        let exact = case.results(&exact);
        let (of, off) = answer.values.difference_percent(&exact).worst_listed(&exact).unwrap();
        let check = answer.check.unwrap();
        assert!(off <= check.last, "{sets:?}: {of:?} is off by {off} %, {check:?}");
    }
}
