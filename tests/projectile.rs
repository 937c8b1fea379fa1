//! Projectiles: contact against closed forms, balance, no tunnelling, honest errors.

use contrecoup::run::quantity::Quantity;
use contrecoup::answer::solve::{Answer, solve};
use contrecoup::models::paper::case::Case;
use contrecoup::run::watch::unwatched;
use contrecoup::models::paper::forces::contact::{Body, Contact};
use contrecoup::models::paper::forces::kernel::Survey;
use contrecoup::models::pulse::Piece;
use contrecoup::models::paper::forces::state::State;
use contrecoup::models::paper::forces::system::System;
use contrecoup::models::paper::recording::shot::ShotExtremes;
use contrecoup::models::paper::time::march::{Observer, march};
use contrecoup::run::flags::FlagKind;
use contrecoup::run::kept::{Frame, Keep, Spacing};
use contrecoup::scenario::library;
use contrecoup::scenario::{Impact, Model, Projectile, ProjectileStiffness, Scenario};
use nalgebra::{Point2, Vector2};

fn bb(speed_m_s: f64) -> Projectile {
    Projectile {
        mass_g: 0.345,
        diameter_mm: 4.5,
        speed_m_s,
        ..Projectile::default()
    }
}

/// At the eye of the paper, which is the default.
fn at(shot: Projectile) -> Scenario {
    Scenario {
        impact: Impact::Projectile(shot),
        ..Scenario::default()
    }
}

fn answer(scenario: &Scenario) -> Answer {
    solve(&scenario.check().unwrap(), Keep::default(), &mut unwatched).unwrap()
}

fn shot(answer: &Answer) -> &ShotExtremes {
    answer.left.section().unwrap().shot.as_ref().unwrap()
}

fn has(answer: &Answer, kind: FlagKind) -> bool {
    answer.flags.iter().any(|flag| flag.kind == kind)
}

/// A square of side 24 mm about the origin, anticlockwise; its second side is no wall that is hit.
fn square() -> Vec<Point2<f64>> {
    [(12.0, -12.0), (12.0, 12.0), (-12.0, 12.0), (-12.0, -12.0)]
        .map(|(x, y)| Point2::new(x * 1e-3, y * 1e-3))
        .to_vec()
}

/// A circle like the shell, dented so that joints turn both ways.
fn dented() -> Vec<Point2<f64>> {
    (0..36)
        .map(|i| {
            let angle = f64::from(i) * 10f64.to_radians();
            let radius = 12e-3 - 1.5e-3 * (-((f64::from(i) - 18.0) / 2.0).powi(2)).exp();
            Point2::new(radius * angle.cos(), radius * angle.sin())
        })
        .collect()
}

/// Moves disc and ring, whose nodes weigh `mass` kg, until the disc has left; returns the time in
/// touch.
fn collide(
    contact: &Contact,
    body: &mut Body,
    ring: &mut [Point2<f64>],
    mass: f64,
) -> (f64, Vec<Vector2<f64>>) {
    let h = 1e-9;
    let mut speeds = vec![Vector2::zeros(); ring.len()];
    let mut forces = speeds.clone();
    let mut touched = 0.0;
    let mut idle = 0;
    contact.apply(body, ring, &mut forces);
    while idle < 100 {
        body.velocity += body.acceleration * (0.5 * h);
        body.position += body.velocity * h;
        for ((speed, place), force) in speeds.iter_mut().zip(ring.iter_mut()).zip(&forces) {
            *speed += force * (0.5 * h / mass);
            *place += *speed * h;
        }
        forces.fill(Vector2::zeros());
        let touch = contact.apply(body, ring, &mut forces);
        body.velocity += body.acceleration * (0.5 * h);
        for (speed, force) in speeds.iter_mut().zip(&forces) {
            *speed += force * (0.5 * h / mass);
        }
        if touch.shell.norm() > 0.0 {
            touched += h;
        } else if touched > 0.0 {
            idle += 1;
        }
    }
    (touched, speeds)
}

#[test]
fn a_mass_on_a_spring_touches_a_wall_for_half_a_period() {
    for (stiffness, speed) in [(2.4e5, 20.0), (2e4, 5.0)] {
        let input = Projectile {
            mass_g: 1.0,
            diameter_mm: 10.0,
            speed_m_s: speed,
            stiffness: ProjectileStiffness::Linear { n_per_m: stiffness },
            ..Projectile::default()
        };
        let mut ring = square();
        let contact = Contact::new(&input, &ring, 7.5e-5, 0.7);
        let mut body = contact.body();
        assert!((body.position.x + 17e-3).abs() < 1e-12);
        let (time, _) = collide(&contact, &mut body, &mut ring, f64::INFINITY);
        let series = 1.0 / (1.0 / stiffness + 1.0 / contact.penalty);
        let half_period = std::f64::consts::PI * (1e-3 / series).sqrt();
        assert!(
            (time / half_period - 1.0).abs() < 1e-4,
            "{time} {half_period}"
        );
        // The penalty is so stiff that the projectile's own spring decides.
        let own = std::f64::consts::PI * (1e-3 / stiffness).sqrt();
        assert!((time / own - 1.0).abs() < 0.05, "{time} {own}");
        assert!((body.velocity.x / -speed - 1.0).abs() < 1e-6);
    }
}

#[test]
fn equal_masses_exchange_their_momentum_head_on() {
    let input = Projectile {
        mass_g: 2.0,
        ..bb(10.0)
    };
    let mut ring = square();
    let contact = Contact::new(&input, &ring, 1e-3, 0.7);
    let mut body = contact.body();
    let (_, speeds) = collide(&contact, &mut body, &mut ring, 1e-3);
    assert!(body.velocity.norm() < 1e-4, "{:?}", body.velocity);
    assert!((speeds[2].x - 10.0).abs() < 1e-4 && (speeds[3].x - 10.0).abs() < 1e-4);
    let momentum = 2e-3 * body.velocity + speeds.iter().sum::<Vector2<f64>>() * 1e-3;
    assert!((momentum - Vector2::new(2e-2, 0.0)).norm() < 1e-12);
}

#[test]
fn contact_forces_are_the_gradient_of_their_energy() {
    for stiffness in [
        ProjectileStiffness::Rigid,
        ProjectileStiffness::Linear { n_per_m: 3e4 },
    ] {
        let ring = dented();
        let input = Projectile {
            stiffness,
            ..bb(20.0)
        };
        let contact = Contact::new(&input, &ring, 7.5e-5, 0.7);
        let potential = |place: Point2<f64>, ring: &[Point2<f64>]| {
            let mut body = Body {
                position: place,
                ..Body::default()
            };
            let mut forces = vec![Vector2::zeros(); ring.len()];
            contact.apply(&mut body, ring, &mut forces).potential
        };
        for (x, y) in [(-12.6, 0.0), (-12.5, 0.4), (-12.6, 1.9), (-12.4, -2.3)] {
            let place = Point2::new(x * 1e-3, y * 1e-3);
            let mut body = Body {
                position: place,
                ..Body::default()
            };
            let mut forces = vec![Vector2::zeros(); ring.len()];
            let touch = contact.apply(&mut body, &ring, &mut forces);
            assert!(touch.shell.norm() > 1.0, "{x} {y}");
            let e = 1e-8;
            let slope = |axis: Vector2<f64>| {
                (potential(place + axis * e, &ring) - potential(place - axis * e, &ring))
                    / (2.0 * e)
            };
            let expected = -Vector2::new(slope(Vector2::x()), slope(Vector2::y()));
            let difference = (expected - body.acceleration * contact.mass).norm();
            assert!(difference < 1e-4 * touch.shell.norm(), "{difference}");
            for node in 0..ring.len() {
                let moved = |shift: f64| {
                    let mut ring = ring.clone();
                    ring[node].x += shift;
                    potential(place, &ring)
                };
                let expected = -(moved(e) - moved(-e)) / (2.0 * e);
                assert!((expected - forces[node].x).abs() < 1e-4 * touch.shell.norm());
            }
        }
    }
}

#[test]
fn the_force_is_continuous_as_the_contact_passes_over_joints() {
    let ring = dented();
    let contact = Contact::new(&bb(20.0), &ring, 7.5e-5, 0.7);
    let force = |angle: f64| {
        let reach = 12e-3 + 0.9 * contact.radius;
        let mut body = Body {
            position: Point2::new(-reach * angle.cos(), reach * angle.sin()),
            ..Body::default()
        };
        let mut forces = vec![Vector2::zeros(); ring.len()];
        contact.apply(&mut body, &ring, &mut forces);
        forces
    };
    let largest_jump = |steps: u32| {
        let mut before = force(-0.6);
        let mut jump: f64 = 0.0;
        for i in 1..=steps {
            let now = force(-0.6 + 1.2 * f64::from(i) / f64::from(steps));
            for (a, b) in before.iter().zip(&now) {
                jump = jump.max((b - a).norm());
            }
            before = now;
        }
        jump
    };
    let (coarse, fine) = (largest_jump(2_000), largest_jump(20_000));
    assert!(fine < 0.11 * coarse, "{coarse} {fine}");
}

/// Keeps the largest distance between the momentum lost and the impulse of contact.
struct Ledger {
    mass: f64,
    start: Vector2<f64>,
    worst: f64,
    last: f64,
}

impl Observer for Ledger {
    fn begin(&mut self, _: &System, _: &State, _: Piece, _: &Survey) {}
    fn step(&mut self, _: &System, state: &State, _: Piece, _: &Survey) {
        let gained = (state.readings.body.velocity - self.start) * self.mass;
        self.worst = self.worst.max((gained - state.readings.impulse).norm());
        self.last = gained.norm();
    }
}

#[test]
fn momentum_and_energy_balance_with_the_projectile_counted_in() {
    for scenario in [at(bb(62.5)), at(bb(30.0))] {
        let case = Case::new(&scenario.check().unwrap());
        let contact = case.system.coupled().unwrap().contact;
        let mut plan = case.plan(&scenario).unwrap();
        let mut ledger = Ledger {
            mass: contact.mass,
            start: contact.direction * contact.speed,
            worst: 0.0,
            last: 0.0,
        };
        let mut state = case.start.clone();
        march(&case.system, &plan, &mut state, &mut ledger).unwrap();
        assert!(ledger.last > 1e-3, "{}", ledger.last);
        assert!(ledger.worst < 1e-12, "{}", ledger.worst);

        plan.step *= 0.1;
        let solved = case.run(&plan, Keep::default(), &mut unwatched).unwrap();
        let extremes = solved.recording.extremes;
        assert!(
            extremes.energy_residual < 1e-3,
            "{}",
            extremes.energy_residual
        );
        let results = extremes.shot.unwrap();
        assert!((extremes.work - results.energy).abs() < 1e-12);
        assert!(results.energy > 0.0 && results.energy < results.energy_before);
    }
}

#[test]
fn nothing_tunnels_at_any_level() {
    let grain = Projectile {
        mass_g: 0.004,
        diameter_mm: 1.0,
        offset_mm: 0.7,
        ..bb(150.0)
    };
    for level in 1..=3 {
        for input in [bb(150.0), grain.clone()] {
            let mut scenario = at(input);
            scenario.eye.level = level;
            scenario.window_ms = 0.5;
            let answer = answer(&scenario);
            let share = shot(&answer).penetration_share;
            assert!(share > 0.0 && share < 0.02, "level {level}: {share}");
            assert!(!has(&answer, FlagKind::DeepPenetration));
            assert!(shot(&answer).rebound_speed > -75.0);
        }
    }
}

#[test]
fn a_shot_head_on_gives_a_symmetric_answer() {
    let scenario = at(bb(15.0));
    let keep = Keep {
        traces: true,
        frames: Some(Spacing::even(1e-4)),
    };
    let answer = solve(&scenario.check().unwrap(), keep, &mut unwatched).unwrap();
    let eye = &answer.case.section().unwrap().eye;
    for frame in &answer.frames {
        for (i, node) in eye.nodes.iter().enumerate() {
            let grid = (node.grid.0, eye.side - 1 - node.grid.1);
            let twin = eye.nodes.iter().position(|n| n.grid == grid).unwrap();
            let (a, b) = (frame.positions[i], frame.positions[twin]);
            assert!((a.x - b.x).abs() < 1e-9 && (a.y + b.y).abs() < 1e-9);
        }
        assert!(frame.projectile.unwrap().y.abs() < 1e-9);
    }
    let traces = answer.traces.as_ref().unwrap();
    assert_eq!(traces.contact_force.len(), traces.time.len());
}

#[test]
fn what_is_too_large_meets_the_rim_and_what_flies_past_misses() {
    let baseball = Projectile {
        mass_g: 145.0,
        diameter_mm: 74.0,
        ..bb(20.0)
    };
    let stopped = answer(&at(baseball));
    assert!(has(&stopped, FlagKind::RimStops) && has(&stopped, FlagKind::EyeMissed));
    assert!((shot(&stopped).rebound_speed - 20.0).abs() < 0.01);
    assert_eq!(stopped.left.section().unwrap().apex.value, 0.0);

    let past = answer(&at(Projectile {
        offset_mm: 30.0,
        ..bb(20.0)
    }));
    assert!(has(&past, FlagKind::EyeMissed) && !has(&past, FlagKind::RimStops));

    let mut cut = at(bb(20.0));
    cut.window_ms = 0.03;
    assert!(has(&answer(&cut), FlagKind::ContactCut));
}

#[test]
fn the_same_shot_gives_the_same_bits() {
    let scenario = at(Projectile {
        angle_deg: 13.0,
        offset_mm: -1.0,
        ..bb(40.0)
    });
    let (a, b) = (answer(&scenario), answer(&scenario));
    assert_eq!((a.left, a.traces, a.frames), (b.left, b.traces, b.frames));
    assert_eq!(a.cost, b.cost);
}

#[test]
fn a_force_on_the_papers_eye_does_none_of_this_work() {
    let answer = answer(&Scenario::default());
    let cost = answer.cost;
    assert!(cost.evaluations > 0);
    assert_eq!(cost.contact_tests, 0);
    assert!(
        answer.case.section().unwrap().system.coupled().is_none()
            && answer.case.section().unwrap().system.mirrored()
    );
    assert!(answer.left.section().unwrap().shot.is_none());

    let shot = solve(
        &at(bb(20.0)).check().unwrap(),
        Keep::default(),
        &mut unwatched,
    )
    .unwrap();
    assert!(shot.cost.contact_tests > 0);
}

#[test]
fn stated_step_errors_hold_against_a_run_ten_times_finer() {
    let squash = Projectile {
        mass_g: 24.0,
        diameter_mm: 40.0,
        stiffness: ProjectileStiffness::Linear { n_per_m: 2e4 },
        ..bb(20.0)
    };
    let aside = Projectile {
        mass_g: 1.05,
        diameter_mm: 6.35,
        angle_deg: 20.0,
        offset_mm: 2.0,
        ..bb(12.0)
    };
    for scenario in [at(bb(62.5)), at(aside), at(squash), at(bb(25.0))] {
        let answer = answer(&scenario);
        let mut plan = answer.plan;
        plan.step *= 0.1;
        let fine = answer
            .case
            .run(&plan, Keep::default(), &mut unwatched)
            .unwrap();
        let fine = answer.case.results(&fine.left);
        for (quantity, truth) in answer.results().difference_percent(&fine).present() {
            if quantity.key().starts_with("peak_force") {
                continue;
            }
            let claimed = answer.errors.time_step[quantity].unwrap();
            assert!(
                truth <= claimed,
                "{:?}: {} is off by {truth} %, claimed {claimed} %",
                scenario.impact,
                quantity.label()
            );
        }
    }
}

/// An object of the library at the eye in section, which is 35 mm open.
fn soft(name: &str) -> Scenario {
    let found = library::built_in().into_iter().find(|p| p.name == name);
    let mut scenario = Scenario {
        doubt: Scenario::default().doubt,
        ..found.unwrap().scenario().unwrap()
    };
    scenario.model = Model::Paper;
    scenario.eye.opening_deg = 61.0;
    scenario
}

#[test]
fn a_soft_ball_wedged_in_the_rim_keeps_its_energy_at_any_step() {
    let mut scenario = soft("squash-ball");
    let mut damage = Vec::new();
    for step_us in [0.45, 0.9, 1.8] {
        scenario.numerics.step_us = Some(step_us);
        let answer = answer(&scenario);
        let energies = answer.left.section().unwrap().energy_residual;
        assert!(energies < 1e-3, "{step_us} us: {energies}");
        assert!(shot(&answer).rebound_speed > 25.0, "{step_us} us");
        damage.push(answer.index.damage());
    }
    assert!((damage[2] / damage[0] - 1.0).abs() < 0.05, "{damage:?}");
}

#[test]
fn no_soft_object_is_pressed_through_itself_and_one_pressed_far_is_flagged() {
    for (name, flattened) in [("tennis-ball", true), ("golf-ball", false)] {
        let answer = answer(&soft(name));
        let share = shot(&answer).squeezed_share;
        assert!(share > 0.0 && share < 0.9, "{name}: {share}");
        assert_eq!(has(&answer, FlagKind::ObjectFlattened), flattened, "{name}");
    }
}

#[test]
fn an_object_lighter_than_a_node_or_behind_the_bone_is_flagged() {
    let foam = answer(&soft("airbag-foam"));
    assert!(has(&foam, FlagKind::ObjectLight));
    let sphere = Projectile {
        mass_g: 10_000.0,
        ..bb(56.0)
    };
    let through = answer(&at(sphere));
    assert!(has(&through, FlagKind::ThroughBone));
    let usual = answer(&at(bb(56.0)));
    assert!(!has(&usual, FlagKind::ThroughBone) && !has(&usual, FlagKind::ObjectLight));
}

#[test]
fn an_object_that_misses_has_exact_results_and_no_curve_of_its_energy() {
    for offset_mm in [12.0, 17.0] {
        let aside = Projectile {
            offset_mm,
            ..bb(56.0)
        };
        let answer = answer(&at(aside));
        assert!(has(&answer, FlagKind::EyeMissed), "{offset_mm}");
        assert!(!has(&answer, FlagKind::Unconverged), "{offset_mm}");
        assert_eq!(answer.errors.time_step_percent(), 0.0);
        assert!(answer.risks().is_empty());
    }
}

/// With hardly any fat and no drag nothing from outside acts, so the mean of all places, by mass,
/// moves on at the speed that the object brought.
#[test]
fn eye_and_object_together_keep_their_momentum() {
    let mut scenario = at(bb(30.0));
    scenario.eye.fat_kpa = 1e-3;
    scenario.eye.globe_drag_ns_m = 0.0;
    scenario.eye.fat_drag_ns_m = 0.0;
    scenario.window_ms = 0.4;
    let keep = Keep {
        traces: false,
        frames: Some(Spacing::even(1e-4)),
    };
    let answer = solve(&scenario.check().unwrap(), keep, &mut unwatched).unwrap();
    let frames = &answer.frames;
    let moment = |frame: &Frame| {
        let nodes = answer
            .case
            .section()
            .unwrap()
            .eye
            .nodes
            .iter()
            .zip(&frame.positions);
        let eye: Vector2<f64> = nodes
            .filter(|(node, _)| !node.fixed())
            .map(|(node, place)| place.coords * node.mass)
            .sum();
        eye + frame.projectile.unwrap().coords * 0.345e-3
    };
    let brought = Vector2::new(0.345e-3 * 30.0, 0.0);
    for frame in &frames[1..] {
        let moved = moment(frame) - moment(&frames[0]);
        let error = (moved - brought * frame.time).norm() / (brought * frame.time).norm();
        assert!(error < 2e-3, "{} s: {error}", frame.time);
    }
    assert!(shot(&answer).contact.is_some());
}

#[test]
fn an_eye_that_was_missed_shows_no_rounding_and_no_injury() {
    let beside = Projectile {
        offset_mm: 12.0,
        stiffness: ProjectileStiffness::Linear { n_per_m: 2.0e4 },
        ..bb(56.0)
    };
    let answer = answer(&at(beside));
    assert!(has(&answer, FlagKind::EyeMissed));
    for (quantity, value) in answer.results().present() {
        assert!(
            value == 0.0 || quantity == Quantity::Pressure,
            "{quantity:?}"
        );
    }
    assert_eq!(answer.index.damage(), 0.0);
    assert!(answer.risks().is_empty());
}

#[test]
fn an_object_narrower_than_the_mesh_is_flagged() {
    let needle = Projectile {
        diameter_mm: 1.0,
        ..bb(5.0)
    };
    let flagged = |shot| has(&answer(&at(shot)), FlagKind::ObjectUnresolved);
    assert!(flagged(needle) && !flagged(bb(5.0)));
}
