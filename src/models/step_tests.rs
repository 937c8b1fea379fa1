//! Whether the steps of eyes of cells are stable: by the largest eigenvalue of whole meshes.
//!
//! A leapfrog whose viscous forces lag half a step is stable while no eigenvalue of
//! h^2 K + 2 h C - 4 M is above 0: K and C are asked by differences of forces.

use crate::models::axisymmetric::eye::{AxisymmetricEye, parameters::Parameters};
use crate::models::axisymmetric::forces::object::{Object, ObjectOutline, ObjectSurface};
use crate::models::axisymmetric::time::march::{CellLoop, GROWTH, Marching, STEP_SHARE};
use crate::models::axisymmetric::time::run::{AxisymmetricLoad, Motion};
use crate::models::axisymmetric::time::until::Until;
use crate::models::spatial::eye::{SpatialEye, mesh::Extent, orbit::OrbitRim};
use crate::models::spatial::forces::object::Aim;
use crate::models::spatial::time::run::{Motion as SpatialMotion, SpatialBlow};
use crate::run::kept::Keep;
use crate::scenario::Rim;

fn ball(radius: f64, mass: f64, speed: f64) -> Object {
    let (outline, surface) = (ObjectOutline::Sphere(radius), ObjectSurface::RIGID);
    Object { outline, mass, speed, surface, spring: None }
}

/// Goes on from `time` to `end` s by its own steps.
fn follow<M: Marching>(motion: &mut M, time: &mut f64, end: f64) {
    let mut most = f64::INFINITY;
    while *time < end {
        let now = motion.forces(*time);
        let step = most.min(STEP_SHARE * M::bounds(&now).all);
        most = GROWTH * step;
        motion.advance(&now, step, step);
        *time += step;
    }
}

fn bound<M: Marching>(motion: &mut M, time: f64) -> f64 {
    let now = motion.forces(time);
    M::bounds(&now).all
}

/// The longest stable step, s, about `guess`, of coordinates of inverse masses `free` on which
/// `forces` act after they were moved by so much and sped up by so many times that a second.
fn longest(free: &[f64], guess: f64, mut forces: impl FnMut(&[f64], f64) -> Vec<f64>) -> f64 {
    let still = forces(&vec![0.0; free.len()], 0.0);
    let mut mode: Vec<f64> = (0..free.len()).map(|i| ((i * 7919) % 1009) as f64 - 504.0).collect();
    let mut step = guess;
    for _ in 0..5 {
        let mut most = 0.0;
        for _ in 0..300 {
            let moved: Vec<f64> = mode.iter().zip(free).map(|(u, free)| u * free.sqrt()).collect();
            let small = 1e-9 / moved.iter().fold(0.0_f64, |most, by| most.max(by.abs()));
            let moved: Vec<f64> = moved.iter().map(|by| small * by).collect();
            let after = forces(&moved, 2.0 / step);
            let pulled = after.iter().zip(&still).zip(free);
            let by = step * step / small;
            let next: Vec<f64> =
                pulled.map(|((after, still), free)| by * (still - after) * free.sqrt()).collect();
            let size = mode.iter().map(|u| u * u).sum::<f64>();
            most = mode.iter().zip(&next).map(|(u, next)| u * next).sum::<f64>() / size;
            let length = next.iter().map(|u| u * u).sum::<f64>().sqrt();
            mode = next.iter().map(|u| u / length).collect();
        }
        step *= (4.0_f64 / most).sqrt();
    }
    step
}

#[test]
fn an_axisymmetric_eye_takes_steps_that_its_largest_eigenvalue_allows() {
    let eye = AxisymmetricEye::new(&Parameters::default(), 1);
    for object in [ball(2.25e-3, 0.345e-3, 62.5), ball(20e-3, 24e-3, 60.0)] {
        let (blow, keep) = (AxisymmetricLoad::Object(object), Keep::default());
        let mut motion = Motion::new(&eye, CellLoop::Plain, &blow, keep, Until::Time(1.0));
        let mut time = 0.0;
        for end in [0.0, 0.25e-3, 0.6e-3, 1.5e-3] {
            follow(&mut motion, &mut time, end);
            let step = STEP_SHARE * bound(&mut motion, time);
            let n = motion.state.x.len();
            let free = [&motion.state.free_x[..], &motion.state.free_r].concat();
            let forces = |moved: &[f64], faster: f64| {
                let mut state = motion.state.clone();
                for i in 0..n {
                    state.x[i] += moved[i];
                    state.r[i] += moved[n + i];
                    state.vx[i] += faster * moved[i];
                    state.vr[i] += faster * moved[n + i];
                }
                motion.cells.forces(&mut state);
                let at = state.shell.clone();
                let places = (&state.x[at.clone()], &state.r[at.clone()]);
                let on = (&mut state.fx[at.clone()], &mut state.fr[at]);
                motion.shell.forces(places, on, &mut motion.tension);
                [state.fx, state.fr].concat()
            };
            let longest = longest(&free, step, forces);
            assert!(step < 0.95 * longest, "{end} s: {step:e} of {longest:e}");
        }
    }
}

#[test]
fn an_eye_in_three_dimensions_takes_steps_that_its_largest_eigenvalue_allows() {
    let rim = OrbitRim::from(&Rim::CAUCASIAN);
    let eye = SpatialEye::new(&Parameters::default(), Some(rim), Extent::Full, 1);
    let aim = Aim { angle: 0.5, from: -1.5, offset: 0.0, towards: 0.0 };
    let golf = ball(21e-3, 46e-3, 40.0);
    let splash = ObjectSurface::splashing(1.8e6, 8.6e-3).losing(0.0);
    let splash = Object { surface: splash, ..ball(8.6e-3, 3e-3, 60.0) };
    for object in [ball(2.25e-3, 0.345e-3, 62.5), golf, splash] {
        let blow = SpatialBlow { object, aim, up: 0.0 };
        let keep = Keep::default();
        let mut motion = SpatialMotion::new(&eye, CellLoop::Rows, &blow, keep, Until::Time(1.0));
        let mut time = 0.0;
        for end in [0.0, 0.25e-3, 0.5e-3, 0.8e-3, 1.5e-3, 4e-3] {
            follow(&mut motion, &mut time, end);
            let step = STEP_SHARE * bound(&mut motion, time);
            let n = motion.state.at[0].len();
            let free = motion.state.free.concat();
            let forces = |moved: &[f64], faster: f64| {
                let mut state = motion.state.clone();
                state.release();
                for (i, moved) in moved.iter().enumerate() {
                    state.at[i / n][i % n] += moved;
                    state.speed[i / n][i % n] += faster * moved;
                }
                motion.cells.forces(&mut state);
                motion.shell.forces(&mut state);
                let mut flying = motion.flying.moving;
                motion.target.forces(&object, &mut flying, &mut state);
                state.force.concat()
            };
            let longest = longest(&free, step, forces);
            assert!(step < 0.95 * longest, "{end} s: {step:e} of {longest:e}");
        }
    }
}
