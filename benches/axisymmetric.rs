//! Speed of the axisymmetric eye against its plain loop, in one run, interleaved.
//!
//! `cargo bench --bench axisymmetric` prints the fastest of many interleaved rounds and their
//! ratios.

use contrecoup::models::axisymmetric::eye::AxisymmetricEye;
use contrecoup::models::axisymmetric::eye::parameters::Parameters;
use contrecoup::models::axisymmetric::forces::object::{Object, ObjectOutline, ObjectSurface};
use contrecoup::models::axisymmetric::recording::results::EngineRun;
use contrecoup::models::axisymmetric::time::march::{CellLoop, STEP_SHARE};
use contrecoup::models::axisymmetric::time::run::{AxisymmetricLoad, run_as};
use contrecoup::models::paper::forces::kernel::vector_sets;
use contrecoup::run::kept::Keep;
use std::ops::ControlFlow;
use std::sync::OnceLock;
use std::time::Instant;

/// Rounds of whole runs.
const ROUNDS: usize = 3;
/// Simulated time, in s.
const WINDOW: f64 = 3e-3;

fn bb() -> AxisymmetricLoad {
    AxisymmetricLoad::Object(Object {
        outline: ObjectOutline::Sphere(2.25e-3),
        mass: 0.345e-3,
        speed: 60.0,
        surface: ObjectSurface::RIGID,
        spring: None,
    })
}

/// Time that this thread has had a core, where the system tells, as others may share the machine.
fn cpu_seconds() -> f64 {
    static START: OnceLock<Instant> = OnceLock::new();
    let start = START.get_or_init(Instant::now);
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|s| s.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| start.elapsed().as_secs_f64(), |ns| ns * 1e-9)
}

fn hit(form: CellLoop, eye: &AxisymmetricEye) -> (f64, EngineRun) {
    let start = cpu_seconds();
    let mut watch = |_| ControlFlow::Continue(());
    let run = run_as(form, eye, &bb(), WINDOW, STEP_SHARE, Keep::default(), &mut watch);
    (cpu_seconds() - start, run.expect("a BB at 60 m/s"))
}

/// Fastest time of each form, in s, and its run.
fn fastest(forms: &[CellLoop], eye: &AxisymmetricEye) -> Vec<(f64, EngineRun)> {
    let mut best: Vec<_> = forms.iter().map(|&form| hit(form, eye)).collect();
    for _ in 1..ROUNDS {
        for (best, &form) in best.iter_mut().zip(forms) {
            best.0 = best.0.min(hit(form, eye).0);
        }
    }
    best
}

fn main() {
    let mut forms = vec![CellLoop::Plain];
    forms.extend(vector_sets().into_iter().map(CellLoop::Vectors));
    println!("BB at 60 m/s, orbit, 3 ms: the run, and its time a cell and step");
    for level in 1..=AxisymmetricEye::FINEST {
        let eye = AxisymmetricEye::new(&Parameters::default(), level);
        for (form, (time, run)) in forms.iter().zip(fastest(&forms, &eye)) {
            println!(
                "level {level} {:>5} cells {:>6} steps to {:.2} ms {:9.2} ms {:8.2} ns  {form:?}",
                eye.cells.len(),
                run.steps,
                1e3 * run.simulated,
                1e3 * time,
                1e9 * time / ((run.steps + 1) * eye.cells.len()) as f64,
            );
        }
    }
}
