//! Forces against differences of energy, and closed forms.

use crate::models::axisymmetric::eye::parameters::{Parameters, ShellParameters, Surround};
use crate::models::axisymmetric::eye::{AxisymmetricEye, quarters};
use crate::models::axisymmetric::forces::cell::{ASSEMBLED, Rest, least_triangle, volume};
use crate::models::axisymmetric::forces::contact::Target;
use crate::models::axisymmetric::forces::face::Face;
use crate::models::axisymmetric::forces::object::{
    BallSpring, HARD, MovingObject, Object, ObjectOutline, ObjectSurface,
};
use crate::models::axisymmetric::forces::state::{CellSums, Cells, NodeState};
use crate::models::axisymmetric::forces::{plain::PlainCells, rows::CellRows, shell::Shell};
use crate::models::paper::forces::kernel::vector_sets;
use proptest::prelude::*;
use std::f64::consts::PI;
use std::fmt::Debug;
use std::sync::LazyLock;

fn eye(surround: Option<Surround>, level: u32) -> AxisymmetricEye {
    let parameters = Parameters { surround, ..Parameters::default() };
    AxisymmetricEye::new(&parameters, level)
}

/// Of the nodes of the shell at rest all places along the axis, then those from it.
fn shell_at_rest(eye: &AxisymmetricEye) -> Vec<f64> {
    let (x, r): (Vec<f64>, Vec<f64>) = eye.mesh.shell.iter().map(|&n| eye.at(n)).unzip();
    [x, r].concat()
}

/// What a shell with its nodes at such places stores, their forces, and each segment's tension.
fn drawn(shell: &Shell, at: &[f64]) -> (f64, Vec<f64>, Vec<[f64; 2]>) {
    let n = at.len() / 2;
    let (mut forces, mut tension) = (vec![0.0; 2 * n], vec![[0.0; 2]; n - 1]);
    let (fx, fr) = forces.split_at_mut(n);
    let energy = shell.forces(at.split_at(n), (fx, fr), &mut tension).energy;
    (energy, forces, tension)
}

/// A hard surface, a foundation of this stiffness on a body of this radius, and one with a cap.
pub(crate) fn surfaces(stiffness: f64, radius: f64) -> [ObjectSurface; 3] {
    [
        ObjectSurface::RIGID,
        ObjectSurface::foundation(stiffness, radius),
        ObjectSurface::capped(stiffness, 2e5, radius),
    ]
}

pub(crate) fn sphere(surface: ObjectSurface) -> Object {
    Object { outline: ObjectOutline::Sphere(5e-3), mass: 1e-3, speed: 10.0, surface, spring: None }
}

/// Largest difference of `forces` from minus the slope of `energy`, over the largest force.
pub(crate) fn worst(at: &[f64], h: f64, forces: &[f64], energy: impl Fn(&[f64]) -> f64) -> f64 {
    let largest = forces.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
    let error = (0..at.len()).fold(0.0, |m: f64, i| {
        let mut moved = at.to_vec();
        moved[i] = at[i] + h;
        let above = energy(&moved);
        moved[i] = at[i] - h;
        let slope = (above - energy(&moved)) / (2.0 * h);
        m.max((forces[i] + slope).abs())
    });
    error / largest
}

fn corners(of: &[f64]) -> [(f64, f64); 4] {
    std::array::from_fn(|i| (of[2 * i], of[2 * i + 1]))
}

fn flat(of: [(f64, f64); 4]) -> [f64; 8] {
    std::array::from_fn(|i| if i % 2 == 0 { of[i / 2].0 } else { of[i / 2].1 })
}

proptest! {
    #[test]
    fn a_cells_force_is_minus_the_slope_of_its_energy_and_its_loss_the_power_of_its_viscosity(
        index in 0usize..110,
        shifts in prop::array::uniform8(-2e-4..2e-4),
        speeds in prop::array::uniform8(-20.0..20.0),
    ) {
        static EYE: LazyLock<AxisymmetricEye> =
            LazyLock::new(|| AxisymmetricEye::new(&Parameters::default(), 1));
        let eye = &*EYE;
        let cell = &eye.cells[index];
        let rest = Rest::new(eye, cell);
        let at = flat(cell.corners.map(|node| eye.at(node)));
        let at: [f64; 8] = std::array::from_fn(|i| at[i] + shifts[i]);
        let still = rest.respond(corners(&at), [(0.0, 0.0); 4]);
        let forces = flat(still.force);
        let error = worst(&at, 1e-8, &forces, |at| rest.energy(corners(at)));
        prop_assert!(error < 1e-5, "{error:e}");
        prop_assert_eq!(still.loss, 0.0);

        let moving = rest.respond(corners(&at), corners(&speeds));
        let resisted = flat(moving.force);
        let power: f64 = (0..8).map(|i| (forces[i] - resisted[i]) * speeds[i]).sum();
        prop_assert!((power / moving.loss - 1.0).abs() < 1e-8, "{power} {}", moving.loss);
        prop_assert!(moving.loss > 0.0);
    }

    #[test]
    fn the_shells_force_is_minus_the_slope_of_its_energy(
        shifts in prop::array::uniform32(-1e-4..1e-4),
    ) {
        let eye = eye(None, 1);
        let shell = Shell::new(&eye);
        let mut at = shell_at_rest(&eye);
        for (x, shift) in at.iter_mut().zip(shifts.iter().cycle()) {
            *x += shift;
        }
        let error = worst(&at, 1e-9, &drawn(&shell, &at).1, |at| drawn(&shell, at).0);
        prop_assert!(error < 1e-5, "{error:e}");
    }
}

#[test]
fn contact_forces_are_minus_the_slope_of_its_energy_for_every_outline_and_surface() {
    let eye = eye(None, 2);
    let target = Target::new(&eye);
    let n = eye.mesh.shell.len();
    let still = vec![0.0; n];
    let rest = shell_at_rest(&eye);
    for outline in [ObjectOutline::Sphere(5e-3), ObjectOutline::Cylinder(5e-3, 1e-3)] {
        for surface in surfaces(1e9, 5e-3) {
            for depth in [0.3e-3, 1e-3, 3.4e-3] {
                let object = Object { outline, ..sphere(surface) };
                let respond = |at: &[f64]| {
                    let mut projectile = MovingObject::new(&object, -12e-3 + depth);
                    projectile.v = [0.0; 2];
                    projectile.inner();
                    let mut f = vec![0.0; 2 * n];
                    let (fx, fr) = f.split_at_mut(n);
                    let (at, still) = (at.split_at(n), (&still[..], &still[..]));
                    let touch = target.forces(&object, &mut projectile, at, still, (fx, fr));
                    let sum: f64 = fx.iter().sum();
                    assert!((sum + projectile.force[0]).abs() <= 1e-9 * sum.abs());
                    assert!((sum - touch.force).abs() <= 1e-9 * sum.abs());
                    (touch.energy, f)
                };
                let error = worst(&rest, 1e-9, &respond(&rest).1, |at| respond(at).0);
                assert!(error < 1e-4, "{outline:?} {surface:?} {depth} {error:e}");
            }
        }
    }
}

#[test]
fn a_foundation_is_smooth_and_its_cap_holds_until_most_of_its_depth_is_used_up() {
    let soft = ObjectSurface::foundation(1e8, 20e-3);
    let hollow = ObjectSurface::capped(1e8, 1.5e5, 20e-3);
    let liquid = ObjectSurface::splashing(1.5e6, 20e-3);
    for surface in [soft, hollow, liquid, ObjectSurface::elastic(50e6, 36e-3)] {
        let depth = surface.depth.unwrap();
        for share in [1e-3, 0.1, 0.4, 0.61, 0.9, 0.97, 0.99, 1.1] {
            let (gap, h) = (share * depth, 1e-9);
            let (below, here, above) = (surface.at(gap - h), surface.at(gap), surface.at(gap + h));
            let traction = (above.energy - below.energy) / (2.0 * h);
            let slope = (above.traction - below.traction) / (2.0 * h);
            assert!((traction / here.traction - 1.0).abs() < 1e-4, "{share}");
            assert!((slope / here.slope - 1.0).abs() < 1e-4, "{share}");
        }
        // Where one law follows another, neither force nor slope has a jump.
        for share in [0.6, 0.98] {
            let gap = share * depth;
            let (below, above) = (surface.at(gap - 1e-12), surface.at(gap + 1e-12));
            assert!((below.traction / above.traction - 1.0).abs() < 1e-6);
            assert!((below.slope / above.slope - 1.0).abs() < 1e-4);
        }
        if let Some(cap) = surface.cap {
            for i in 0..=60 {
                assert!(surface.at(0.01 * f64::from(i) * depth).traction < cap);
            }
        }
    }
    assert!(soft.at(0.0126).traction > 9.0 * 1e8 * 0.0126);
    assert_eq!(ObjectSurface::RIGID.stiffness, HARD);
}

/// How an object comes off a rigid wall: its velocity away from it over that at which it came, the
/// greatest force of its spring, and the error of its balance of energy over what it brought.
fn bounce(object: &Object) -> (f64, f64, f64) {
    let mut projectile = MovingObject::new(object, 0.0);
    let face = Face::wall(0.0, object.outline.radius(), 200);
    let brought = projectile.kinetic(0.0);
    let (mut lost, mut strongest, mut missing): (f64, f64, f64) = (0.0, 0.0, 0.0);
    loop {
        projectile.inner();
        strongest = strongest.max(projectile.force[0]);
        let push = face.push(object, &mut projectile);
        let longest = 1e-3 * object.outline.radius() / object.speed;
        let step = (0.03 * projectile.limit.min(push.limit)).min(longest);
        let total = projectile.kinetic(step) + projectile.stored() + push.energy + lost;
        missing = missing.max((total - brought).abs());
        lost += projectile.advance(step, step);
        let gone = projectile.x[0] + object.reach() < -0.1 * object.reach();
        if gone && projectile.velocity() < 0.0 {
            return (-projectile.velocity() / object.speed, strongest, missing / brought);
        }
    }
}

/// A ball of 20 g and 40 mm at 15 m/s.
fn ball(surface: ObjectSurface) -> Object {
    Object { outline: ObjectOutline::Sphere(20e-3), mass: 20e-3, speed: 15.0, ..sphere(surface) }
}

#[test]
fn every_surface_gives_back_the_square_of_its_restitution_to_a_rigid_wall() {
    for restitution in [1.0, 0.8, 0.5, 0.3, 0.0] {
        for surface in [
            ObjectSurface::foundation(1e9, 20e-3),
            ObjectSurface::capped(1e9, 2e5, 20e-3),
            ObjectSurface::splashing(1e5, 20e-3),
        ] {
            let object = ball(surface.losing(restitution));
            let (back, _, missing) = bounce(&object);
            // The loss is felt in full from a tenth of the speed of arrival on, a hundredth of the
            // energy, and less on the flanks, where the surface gives way more slowly.
            let kept = restitution * restitution;
            let off = if restitution > 0.0 { 0.02 } else { 1.0 / 30.0 };
            assert!((back * back - kept).abs() < off, "{surface:?} {restitution} {back}");
            assert!(missing < 0.01, "{surface:?} {missing}");
        }
    }
}

#[test]
fn a_ball_on_a_spring_presses_a_wall_with_the_root_of_k_m_times_its_speed() {
    let (stiffness, mass, speed) = (2e4, 58e-3, 15.0);
    for restitution in [1.0, 0.6] {
        let spring = Some(BallSpring { stiffness, restitution });
        let outline = ObjectOutline::Sphere(33e-3);
        let object = Object { outline, mass, speed, spring, ..sphere(ObjectSurface::RIGID) };
        let (back, strongest, missing) = bounce(&object);
        // The surface itself, a twentieth of the mass, stays where it strikes.
        let expected = (stiffness * 0.95 * mass).sqrt() * speed;
        assert!((strongest / expected - 1.0).abs() < 0.01, "{strongest} {expected}");
        assert!((back - 0.95 * restitution).abs() < 0.03, "{back}");
        assert!(missing < 0.01, "{missing}");
    }
}

/// A free globe whose shell is all sclera of one thickness.
fn free_and_even() -> Parameters {
    let mut shell = ShellParameters::human();
    shell.limbus = 0.0;
    for point in &mut shell.sclera_thickness {
        point.1 = 0.5e-3;
    }
    Parameters { shell, surround: None, ..Parameters::default() }
}

#[test]
fn a_ball_under_pressure_is_in_balance_where_its_stress_is_p_r_over_2_t() {
    let parameters = free_and_even();
    let mut last = f64::INFINITY;
    for level in [1, 3, 5] {
        let eye = AxisymmetricEye::new(&parameters, level);
        let grown = 1.01;
        let at: Vec<f64> = shell_at_rest(&eye).iter().map(|x| x * grown).collect();
        let (_, forces, tension) = drawn(&Shell::new(&eye), &at);
        let (x, r) = at.split_at(at.len() / 2);
        let (fx, fr) = forces.split_at(x.len());
        let stress = 138e6 / (1.0 - 0.49) * 0.01;
        for tension in tension.iter().flatten() {
            assert!((tension / stress - 1.0).abs() < 1e-9);
        }
        // The law is per area at rest: grown, the same tension is spread over more length.
        let pressure = 2.0 * stress * 0.5e-3 / (12e-3 * grown * grown);
        let mut worst: f64 = 0.0;
        for i in 1..x.len() - 1 {
            // Work of the pressure on the two cones beside the node, moved outward.
            let out = (x[i] / (12e-3 * grown), r[i] / (12e-3 * grown));
            let cones = |by: f64| {
                let (before, after) = ((x[i - 1], r[i - 1]), (x[i + 1], r[i + 1]));
                let moved = (x[i] + by * out.0, r[i] + by * out.1);
                volume([before, (before.0, 0.0), (after.0, 0.0), after, moved]).0
            };
            let rate = (cones(1e-7) - cones(-1e-7)) / 2e-7;
            let inward = -(fx[i] * out.0 + fr[i] * out.1);
            worst = worst.max((inward / (pressure * rate) - 1.0).abs());
        }
        assert!(worst < 0.02 && worst < last, "{level} {worst}");
        last = worst;
    }
}

/// A state that is far from rest and moves, the same for every form of the cells.
fn shaken(cells: &dyn Cells, eye: &AxisymmetricEye) -> NodeState {
    let mut state = cells.rest();
    for (node, &fixed) in eye.fixed.iter().enumerate() {
        let wave = |k: f64| (k * (node as f64 + 1.0)).sin();
        let (x, r) = eye.at(node);
        let place = cells.place(node);
        if !fixed {
            state.x[place] = 0.93 * x + 3e-4 / f64::from(eye.level) * wave(1.3);
            state.vx[place] = 30.0 * wave(2.1);
        }
        if !fixed && r > 0.0 {
            state.r[place] = 1.05 * r + 3e-4 / f64::from(eye.level) * wave(0.7);
            state.vr[place] = 30.0 * wave(1.7);
        }
    }
    state
}

pub(crate) fn numbers(sums: &CellSums) -> [f64; 6] {
    [sums.limit, sums.loss, sums.pressure, sums.sensor, sums.volume, sums.least_corner]
}

fn near(what: impl Debug, a: f64, b: f64, scale: f64) {
    assert!((a - b).abs() <= 1e-11 * scale, "{what:?}: {a} {b}");
}

#[test]
fn cells_in_rows_do_what_cells_one_by_one_do_on_all_vectors() {
    for level in [1, 2, 5] {
        for surround in [None, Parameters::default().surround] {
            let eye = eye(surround, level);
            let mut plain = PlainCells::new(&eye);
            let mut expected = shaken(&plain, &eye);
            let sums = plain.forces(&mut expected);
            let largest = expected.fx.iter().fold(0.0, |m: f64, f| m.max(f.abs()));
            let mut narrow: Option<NodeState> = None;
            for vectors in vector_sets() {
                let mut rows = CellRows::new(&eye, vectors);
                let mut state = shaken(&rows, &eye);
                rows.share(&mut state);
                let others = rows.forces(&mut state);
                for (a, b) in numbers(&others).into_iter().zip(numbers(&sums)) {
                    near(level, a, b, b.abs());
                }
                for node in 0..eye.mass.len() {
                    let place = rows.place(node);
                    near((level, node), state.fx[place], expected.fx[node], largest);
                    near((level, node), state.fr[place], expected.fr[node], largest);
                }
                let pressures = rows.pressures();
                assert_eq!(pressures.len(), eye.cells.len());
                for (a, b) in pressures.into_iter().zip(plain.pressures()) {
                    near(level, a, b, 1e8);
                }
                let at = |node: usize| state.at(rows.place(node));
                let each = eye.cells.iter().map(|cell| least_triangle(&eye, &cell.corners, at));
                near(level, each.fold(f64::INFINITY, f64::min), others.least_corner, 1.0);
                rows.advance(&mut state, 1e-7, 1e-7);
                if let Some(narrow) = &narrow {
                    assert_eq!(narrow, &state, "{vectors:?}");
                }
                narrow = Some(state);
            }
        }
    }
}

#[test]
fn a_shell_of_one_thickness_breathes_at_its_closed_frequency() {
    let parameters = free_and_even();
    let eye = AxisymmetricEye::new(&parameters, 2);
    let chain = Shell::new(&eye);
    let rest = shell_at_rest(&eye);
    let n = rest.len() / 2;
    let (x0, r0) = rest.split_at(n);
    let mut mass = vec![0.0; n];
    for i in 0..n - 1 {
        let length = (x0[i + 1] - x0[i]).hypot(r0[i + 1] - r0[i]);
        let along = 1100.0 * 0.5e-3 * PI * length / 3.0;
        mass[i] += along * (2.0 * r0[i] + r0[i + 1]);
        mass[i + 1] += along * (r0[i] + 2.0 * r0[i + 1]);
    }
    // Of a thin shell without a content: w^2 = 2 E/((1 - nu) rho R^2).
    let frequency = f64::sqrt(2.0 * 138e6 / (0.51 * 1100.0)) / 12e-3;
    let period = 2.0 * PI / frequency;
    let step = period / 2000.0;
    let mut at: Vec<f64> = rest.iter().map(|x| 1.0001 * x).collect();
    let mut v = vec![0.0; 2 * n];
    // Released at its largest, it passes its rest after a quarter of a period.
    let equator = n + n / 2;
    let mut swing = (1..2000).map(|count| {
        let (_, forces, _) = drawn(&chain, &at);
        for i in 0..2 * n {
            let held = i >= n && rest[i] == 0.0;
            let kick = if count == 1 { 0.5 * step } else { step } / mass[i % n];
            v[i] += if held { 0.0 } else { kick * forces[i] };
            at[i] += step * v[i];
        }
        (f64::from(count) * step, at[equator])
    });
    let back = swing.find(|(_, r)| *r < rest[equator]);
    let quarter = back.expect("it swings back").0;
    assert!((4.0 * quarter / period - 1.0).abs() < 0.02, "{quarter:e} {period:e}");
}

/// The theorem of Irons and Treharne: no frequency of the whole is above the highest of its parts.
/// A leapfrog whose damping c lags half a step is stable as long as (h w/2)^2 + h c/2 <= 1.
#[test]
fn no_cell_at_rest_is_unstable_at_the_step_that_it_allows() {
    use nalgebra::SMatrix;
    for surround in [None, Parameters::default().surround] {
        let eye = eye(surround, 1);
        for cell in &eye.cells {
            let rest = Rest::new(&eye, cell);
            let p = cell.corners.map(|node| eye.at(node));
            let at = flat(p);
            // 1/sqrt(mass) of each coordinate; none on the axis, where r is held.
            let root: [f64; 8] = std::array::from_fn(|k| {
                let held = k % 2 == 1 && p[k / 2].1 == 0.0;
                if held { 0.0 } else { 1.0 / (rest.material.density * quarters(p)[k / 2]).sqrt() }
            });
            // The largest eigenvalue by what each place or velocity, changed by so much, resists.
            let largest = |dx: f64, dv: f64| {
                let column = |k: usize| -> Vec<f64> {
                    let changed = |sign: f64| {
                        let (mut at, mut v) = (at, [0.0; 8]);
                        (at[k], v[k]) = (at[k] + sign * dx, sign * dv);
                        flat(rest.respond(corners(&at), corners(&v)).force)
                    };
                    let resisted = changed(-1.0).into_iter().zip(changed(1.0));
                    resisted.map(|(a, b)| (a - b) / (2.0 * (dx + dv))).collect()
                };
                let columns: Vec<_> = (0..8).map(column).collect();
                let matrix = SMatrix::<f64, 8, 8>::from_fn(|i, k| {
                    0.5 * (columns[k][i] + columns[i][k]) * root[i] * root[k]
                });
                matrix.symmetric_eigenvalues().max()
            };
            let (square, damping) = (largest(1e-8, 0.0), largest(0.0, 1e-6));
            let h = rest.respond(p, [(0.0, 0.0); 4]).limit / ASSEMBLED;
            let used = 0.25 * h * h * square + 0.5 * h * damping;
            assert!(used <= 1.0, "{:?} {used}", cell.corners);
        }
    }
}
