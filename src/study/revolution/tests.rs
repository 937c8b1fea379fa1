use super::RevolutionCase;
use crate::recording::Keep;
use crate::scenario::{Axisymmetric, Impact, Model, Projectile, Scenario, Surface};
use crate::study::{
    Answer, FlagKind, Left, Quantity, Refusal, Results, add_mesh_error, solve, unwatched,
};

fn scene(shot: Projectile) -> Scenario {
    Scenario {
        model: Model::Axisymmetric(Axisymmetric::default()),
        impact: Impact::Projectile(shot),
        window_ms: 1.0,
        ..Scenario::default()
    }
}

fn bb(speed_m_s: f64) -> Projectile {
    Projectile {
        mass_g: 0.345,
        diameter_mm: 4.5,
        speed_m_s,
        ..Projectile::default()
    }
}

fn solved(scenario: &Scenario) -> Answer {
    let checked = scenario.check().unwrap();
    solve(&checked, Keep::default(), &mut unwatched).unwrap()
}

fn case(answer: &Answer) -> &RevolutionCase {
    answer.case.revolution().unwrap()
}

#[test]
fn its_own_step_may_be_asked_for_but_no_other_integrator() {
    use crate::scenario::Integrator;
    let mut scenario = scene(bb(56.0));
    scenario.window_ms = 0.2;
    let plain = solved(&scenario);
    scenario.numerics.integrator = Some(Integrator::VelocityVerlet);
    scenario.numerics.step_us = Some(0.5 * plain.step * 1e6);
    let finer = solved(&scenario);
    assert!((finer.step / plain.step - 0.5).abs() < 1e-9);
    let steps = finer.cost.steps as f64 / plain.cost.steps as f64;
    assert!((1.8..2.2).contains(&steps), "{steps}");
    assert!(finer.errors.time_step_percent() < plain.errors.time_step_percent());
    scenario.numerics.step_us = Some(1.01 * plain.step_limit * 1e6);
    let refused = |scenario: &Scenario| {
        let checked = scenario.check().unwrap();
        solve(&checked, Keep::default(), &mut unwatched).unwrap_err()
    };
    assert!(matches!(refused(&scenario), Refusal::StepAboveLimit { .. }));
    scenario.numerics.integrator = Some(Integrator::Rk4);
    let unfit = refused(&scenario).to_string();
    assert!(unfit.contains("allowed Auto, VelocityVerlet"), "{unfit}");
}

#[test]
fn a_bb_gives_every_result_that_the_eye_of_revolution_has_and_closes_its_energy() {
    let mut answer = solved(&scene(bb(56.0)));
    let results = answer.results();
    let missing: Vec<_> = Quantity::ALL
        .iter()
        .filter(|of| results[**of].is_none())
        .collect();
    assert_eq!(missing, [&Quantity::StoredEnergy]);
    let (pressure, stress) = (
        results[Quantity::Pressure].unwrap(),
        results[Quantity::ScleralStress].unwrap(),
    );
    assert!((0.3..2.0).contains(&pressure), "{pressure} MPa");
    assert!((5.0..30.0).contains(&stress), "{stress} MPa");
    assert!(answer.errors.energy_balance < 1.0);
    assert!(answer.errors.time_step_percent() < 5.0);
    assert!(answer.flags.iter().all(|f| f.kind != FlagKind::MeshFolded));
    add_mesh_error(&scene(bb(56.0)), &mut answer, &mut unwatched).unwrap();
    let mesh = answer.errors.mesh.unwrap();
    assert!(mesh[Quantity::Pressure].unwrap() < 30.0);
    assert_eq!(mesh[Quantity::RuptureByPressure], None);
}

#[test]
fn a_stated_step_error_covers_the_difference_from_a_far_finer_run() {
    use crate::dynamics::revolution::run;
    for (shot, angle_deg) in [(bb(56.0), 0.0), (bb(92.0), 30.0)] {
        let mut scenario = scene(Projectile { angle_deg, ..shot });
        scenario.window_ms = 0.5;
        let answer = solved(&scenario);
        let case = case(&answer);
        let exact = run(
            &case.eye,
            &case.load,
            case.window,
            0.06,
            Keep::default(),
            &mut unwatched,
        )
        .unwrap();
        let exact = Results::of(&Left::Revolution(exact.extremes), case.blow);
        let off = exact.difference_percent(&answer.results());
        for (of, off) in off.leading() {
            let stated = answer.errors.time_step[of].unwrap();
            assert!(off <= stated, "{}: {off} of {stated}", of.key());
        }
    }
}

#[test]
fn a_pulse_acts_on_it_too_and_has_no_result_of_an_object() {
    let mut scenario = scene(bb(1.0));
    scenario.impact = Scenario::default().impact;
    let answer = solved(&scenario);
    let results = answer.results();
    for none in [Quantity::Contact, Quantity::Intrusion, Quantity::Rebound] {
        assert_eq!(results[none], None);
    }
    assert!(results[Quantity::Pressure].unwrap() > 0.01);
}

#[test]
fn an_angle_beyond_trust_and_a_window_that_cuts_the_contact_are_flagged() {
    let mut scenario = scene(Projectile {
        angle_deg: 50.0,
        ..bb(20.0)
    });
    scenario.window_ms = 0.05;
    let answer = solved(&scenario);
    let kinds: Vec<_> = answer.flags.iter().map(|flag| flag.kind).collect();
    assert!(kinds.contains(&FlagKind::AngleBeyondTrust), "{kinds:?}");
    assert!(kinds.contains(&FlagKind::ContactCut), "{kinds:?}");
    assert!(kinds.contains(&FlagKind::WindowShort), "{kinds:?}");
}

#[test]
fn a_surface_that_gives_way_lowers_the_pressure() {
    let ball = Projectile {
        mass_g: 24.0,
        diameter_mm: 40.0,
        speed_m_s: 20.0,
        ..Projectile::default()
    };
    let hard = solved(&scene(ball.clone())).results();
    let soft = solved(&scene(Projectile {
        surface: Surface::Inflated {
            kpa: 150.0,
            modulus_mpa: 3.0,
        },
        ..ball
    }));
    let soft = soft.results();
    let of = Quantity::Pressure;
    assert!(soft[of].unwrap() < 0.7 * hard[of].unwrap());
}
