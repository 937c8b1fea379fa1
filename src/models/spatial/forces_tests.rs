//! Forces against differences of energy, rigid motion, and what is the same for all vectors.

use crate::models::axisymmetric::eye::parameters::{Parameters, Surround};
use crate::models::axisymmetric::forces::object::{Object, ObjectOutline};
use crate::models::axisymmetric::forces_tests::{numbers, sphere, surfaces, worst as worst_of};
use crate::models::paper::forces::kernel::vector_sets;
use crate::models::spatial::eye::{SpatialEye, mesh::Extent, orbit::OrbitRim, point::Nodes};
use crate::models::spatial::forces::cell::{self, Eight, Fields};
use crate::models::spatial::forces::state::{Cells, NodeState, vector};
use crate::models::spatial::forces::{contact::Target, math::Plain, object::MovingObject};
use crate::models::spatial::forces::{plain::PlainCells, rim::Rim, rows::CellRows, shell::Shell};
use crate::scenario;
use fearless_simd::Level;
use nalgebra::{Matrix3, Rotation3, Vector3};
use proptest::prelude::*;
use std::collections::BTreeSet;
use std::sync::LazyLock;

fn eye(surround: Option<Surround>, extent: Extent) -> SpatialEye {
    let parameters = Parameters { surround, ..Parameters::default() };
    SpatialEye::new(&parameters, None, extent, 1)
}

/// A state whose nodes have gone somewhere, as a function of where they rest.
fn moved(eye: &SpatialEye, to: impl Fn(Vector3<f64>) -> Vector3<f64>) -> NodeState {
    let at = by_component(eye.mesh.at.iter().map(|at| to(*at)));
    NodeState { at, ..NodeState::new(eye) }
}

/// Vectors of all nodes, by component.
fn by_component(of: impl Iterator<Item = Vector3<f64>>) -> Nodes {
    let of: Vec<_> = of.collect();
    std::array::from_fn(|k| of.iter().map(|of| of[k]).collect())
}

/// A displacement without any order, as large as `size`.
fn scattered(at: Vector3<f64>, size: f64) -> Vector3<f64> {
    let wave = |a: f64, b: f64, c: f64| (at.x * a + at.y * b + at.z * c).sin();
    let x = wave(7e3, 13e3, 3e3);
    at + Vector3::new(x, wave(5e3, -11e3, 9e3), wave(-3e3, 8e3, 17e3)) * size
}

/// The largest part of any force.
fn largest(force: &[Vec<f64>; 3]) -> f64 {
    force.iter().flatten().fold(0.0, |m: f64, f| m.max(f.abs()))
}

/// [`worst_of`] of some nodes.
fn worst(
    state: &NodeState,
    nodes: impl Iterator<Item = usize>,
    energy: impl Fn(&NodeState) -> f64,
) -> f64 {
    let largest = largest(&state.force);
    let h = 1e-9;
    let mut error = 0.0_f64;
    for node in nodes {
        for k in 0..3 {
            let at = |by: f64| {
                let mut state = state.clone();
                state.at[k][node] += by;
                energy(&state)
            };
            let slope = (at(h) - at(-h)) / (2.0 * h);
            error = error.max((state.force[k][node] + slope).abs());
        }
    }
    error / largest
}

proptest! {
    #[test]
    fn a_cells_force_is_minus_the_slope_of_its_energy_and_its_loss_the_power_of_its_viscosity(
        index in 0usize..1800,
        shifts in prop::array::uniform24(-1.5e-4..1.5e-4),
        speeds in prop::array::uniform24(-20.0..20.0),
    ) {
        static EYE: LazyLock<SpatialEye> =
            LazyLock::new(|| eye(Some(Surround::orbit()), Extent::Full));
        let cell = &EYE.cells[index];
        let c = cell::constants(&EYE, cell);
        let p: Eight<f64> = std::array::from_fn(|i| {
            let at = EYE.mesh.at[cell.corners[i]];
            std::array::from_fn(|k| at[k] + shifts[3 * i + k])
        });
        let v: Eight<f64> = std::array::from_fn(|i| std::array::from_fn(|k| speeds[3 * i + k]));
        let still = cell::respond(Plain, Fields::of(&c), &p, &[[0.0; 3]; 8]);
        let energy = |at: &[f64]| cell::energy(&c, at.as_chunks().0.try_into().unwrap());
        let error = worst_of(p.as_flattened(), 1e-8, still.force.as_flattened(), energy);
        prop_assert!(error < 1e-5, "{error:e}");
        prop_assert_eq!(still.loss, 0.0);
        let moving = cell::respond(Plain, Fields::of(&c), &p, &v);
        let forces = still.force.iter().flatten().zip(moving.force.iter().flatten());
        let power: f64 = forces.zip(v.as_flattened()).map(|((a, b), v)| (a - b) * v).sum();
        prop_assert!((power / moving.loss - 1.0).abs() < 1e-8, "{power} {}", moving.loss);
        prop_assert!(moving.loss > 0.0);
    }
}

#[test]
fn the_shells_force_is_minus_the_slope_of_its_energy_half_or_whole() {
    for extent in [Extent::Half, Extent::Full] {
        let eye = eye(None, extent);
        let mut state = moved(&eye, |at| {
            let mut to = scattered(at, 1e-4);
            if extent == Extent::Half && at.z == 0.0 {
                to.z = 0.0;
            }
            to
        });
        let energy = |state: &NodeState| {
            let mut state = state.clone();
            Shell::new(&eye, Level::new()).forces(&mut state)
        };
        Shell::new(&eye, Level::new()).forces(&mut state);
        let nodes = eye.quads.iter().step_by(7).map(|quad| quad.corners[0]);
        let nodes = nodes.filter(|node| !eye.on_mirror(*node));
        let error = worst(&state, nodes, energy);
        assert!(error < 1e-5, "{extent:?} {error:e}");
    }
}

#[test]
fn moving_turning_and_spinning_as_a_whole_is_felt_by_nothing() {
    let eye = eye(Some(Surround::gelatin()), Extent::Full);
    let turn = Rotation3::from_euler_angles(0.3, -0.7, 1.1);
    let mut state = moved(&eye, |at| turn * at + Vector3::new(1e-3, 2e-3, -3e-3));
    let spin = Vector3::new(500.0, -300.0, 800.0);
    let speed = |node| spin.cross(&vector(&state.at, node)) + Vector3::new(3.0, 4.0, 5.0);
    state.speed = by_component((0..eye.mesh.at.len()).map(speed));
    let mut cells = PlainCells::new(&eye);
    let sums = cells.forces(&mut state);
    let shell = Shell::new(&eye, Level::new()).forces(&mut state);
    let largest = largest(&state.force);
    assert!(largest < 1e-8, "{largest:e}");
    assert!(sums.loss < 1e-9 && shell < 1e-12 && cells.energy(&state) < 1e-12);
    assert!(sums.pressure.abs() < 1e-4 && (sums.least_corner - 1.0).abs() < 1e-9);
}

#[test]
fn an_affine_change_of_shape_is_in_balance_everywhere_inside() {
    let mut free = Parameters { surround: None, ..Parameters::default() };
    free.lens.half_axes = (1e-9, 1e-9);
    let eye = SpatialEye::new(&free, None, Extent::Full, 1);
    let by = Matrix3::new(1.1, 0.05, -0.02, 0.03, 0.95, 0.04, -0.06, 0.01, 1.02);
    // Without a change of volume: corners that see one push on their nodes by their shapes.
    let by = by / libm::cbrt(by.determinant());
    let mut state = moved(&eye, |at| by * at);
    let mut cells = PlainCells::new(&eye);
    cells.forces(&mut state);
    let shell: BTreeSet<usize> = eye.quads.iter().flat_map(|quad| quad.corners).collect();
    let largest = |on_shell: bool| {
        let nodes = (0..eye.mesh.at.len()).filter(|node| shell.contains(node) == on_shell);
        nodes.map(|node| vector(&state.force, node).norm()).fold(0.0, f64::max)
    };
    let (inside, outside) = (largest(false), largest(true));
    // What rounding leaves of the corners' stiffness.
    assert!(inside < 1e-10 && outside > 1e5 * inside, "{inside:e} {outside:e}");
}

#[test]
fn all_vectors_and_the_plain_loop_give_the_same() {
    for extent in [Extent::Half, Extent::Full] {
        let eye = eye(Some(Surround::orbit()), extent);
        let mut state = moved(&eye, |at| scattered(at, 1.5e-4));
        let speed = |node| (vector(&state.at, node) - eye.mesh.at[node]) * 2e5;
        state.speed = by_component((0..eye.mesh.at.len()).map(speed));
        let mut plain = state.clone();
        let sums = PlainCells::new(&eye).forces(&mut plain);
        let mut pressures = Vec::new();
        for level in vector_sets() {
            let mut rows = CellRows::new(&eye, level);
            let mut own = state.clone();
            let told = rows.forces(&mut own);
            for (a, b) in numbers(&told).into_iter().zip(numbers(&sums)) {
                assert!((a / b - 1.0).abs() < 1e-9, "{level:?} {a} {b}");
            }
            let largest = largest(&plain.force);
            for (a, b) in own.force.iter().flatten().zip(plain.force.iter().flatten()) {
                assert!((a - b).abs() < 1e-11 * largest, "{level:?}");
            }
            pressures.push(rows.pressures());
        }
        assert!(pressures.windows(2).all(|pair| pair[0] == pair[1]));
    }
}

#[test]
fn contact_forces_are_minus_the_slope_of_its_energy_for_every_outline_and_surface() {
    let eye = eye(None, Extent::Full);
    let way = Vector3::new(1.0, -0.5, 0.3).normalize();
    let mut target = Target::new(&eye, 0.0);
    for outline in [ObjectOutline::Sphere(5e-3), ObjectOutline::Cylinder(5e-3, 1e-3)] {
        for surface in surfaces(1e9, 5e-3) {
            for depth in [0.3e-3, 1.5e-3, 3.4e-3] {
                let object = Object { outline, ..sphere(surface) };
                let at = way * (depth - 12e-3 - object.reach());
                let mut respond = |state: &NodeState| {
                    let mut state = state.clone();
                    state.release();
                    let mut projectile = MovingObject::new(&object, way, at);
                    projectile.speed = [Vector3::zeros(); 2];
                    let touch = target.forces(&object, &mut projectile, &mut state);
                    let sum: Vector3<f64> =
                        (0..eye.mesh.at.len()).map(|n| vector(&state.force, n)).sum();
                    assert!((sum + projectile.force[0]).norm() <= 1e-9 * sum.norm());
                    assert!((sum - touch.force).norm() <= 1e-9 * sum.norm());
                    (touch, state)
                };
                let (touch, state) = respond(&NodeState::new(&eye));
                assert!(touch.force.dot(&way) > 0.0);
                let near = eye.quads.iter().map(|quad| quad.corners[0]);
                let pushed = |node: &usize| vector(&state.force, *node).norm() > 0.0;
                let nodes: Vec<usize> = near.filter(pushed).take(12).collect();
                let respond = std::cell::RefCell::new(respond);
                let energy = |state: &NodeState| respond.borrow_mut()(state).0.energy;
                let error = worst(&state, nodes.into_iter(), energy);
                assert!(error < 1e-4, "{outline:?} {surface:?} {depth} {error:e}");
            }
        }
    }
}

#[test]
fn bone_pushes_an_object_by_minus_the_slope_of_what_it_stores() {
    let parameters = Parameters::default();
    let rim = Some(OrbitRim::from(&scenario::Rim::CAUCASIAN));
    let eye = SpatialEye::new(&parameters, rim, Extent::Full, 1);
    let rim = Rim::new(&eye).unwrap();
    for outline in [ObjectOutline::Sphere(20e-3), ObjectOutline::Cylinder(20e-3, 2e-3)] {
        for surface in surfaces(1e8, 20e-3) {
            let object = Object { outline, ..sphere(surface) };
            let way = Vector3::new(1.0, -0.3, -0.2).normalize();
            let touch = rim.first_touch(outline, (way, Vector3::zeros())).unwrap();
            for depth in [0.5e-3, 3e-3] {
                let push = |at: Vector3<f64>| {
                    let mut projectile = MovingObject::new(&object, way, at);
                    projectile.speed = [Vector3::zeros(); 2];
                    rim.push(&object, &mut projectile)
                };
                let at = way * (touch + depth);
                let own = push(at);
                assert!(own.force.dot(&way) < 0.0 && own.limit > 0.0);
                let energy = |at: &[f64]| push(Vector3::from_column_slice(at)).energy;
                let error = worst_of(at.as_slice(), 1e-7, own.force.as_slice(), energy);
                assert!(error < 2e-2, "{outline:?} {surface:?} {depth} {error}");
            }
            assert_eq!(rim.first_touch(outline, (way, Vector3::y() * 0.2)), None);
        }
    }
}
