//! Speed of the body of revolution against its plain loop, in one run, interleaved.
//!
//! `cargo bench --bench revolution` prints the fastest of many interleaved rounds and their ratios.

use contrecoup::dynamics::Keep;
use contrecoup::dynamics::revolution::{
    Blow, Form, Object, Outline, Run, STEP_SHARE, Surface, run_as,
};
use contrecoup::dynamics::vector_sets;
use contrecoup::eye::revolution::{Parameters, RevolutionEye};
use std::ops::ControlFlow;
use std::sync::OnceLock;
use std::time::Instant;

/// Rounds of whole runs.
const ROUNDS: usize = 3;
/// Simulated time of a whole run, and of those that are only compared, in s.
const WINDOW: f64 = 3e-3;
const SHORT: f64 = 1e-3;

fn bb() -> Blow {
    Blow::Object(Object {
        outline: Outline::Sphere(2.25e-3),
        mass: 0.345e-3,
        speed: 60.0,
        surface: Surface::RIGID,
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

fn hit(form: Form, eye: &RevolutionEye, window: f64) -> (f64, Run) {
    let start = cpu_seconds();
    let mut watch = |_| ControlFlow::Continue(());
    let run = run_as(
        form,
        eye,
        &bb(),
        window,
        STEP_SHARE,
        Keep::default(),
        &mut watch,
    );
    (cpu_seconds() - start, run.expect("a BB at 60 m/s"))
}

/// Fastest time of each form, in s, and its run.
fn fastest(forms: &[Form], eye: &RevolutionEye, window: f64, rounds: usize) -> Vec<(f64, Run)> {
    let mut best: Vec<_> = forms.iter().map(|&form| hit(form, eye, window)).collect();
    for _ in 1..rounds {
        for (best, &form) in best.iter_mut().zip(forms) {
            best.0 = best.0.min(hit(form, eye, window).0);
        }
    }
    best
}

fn main() {
    let mut forms = vec![Form::Plain];
    forms.extend(vector_sets().into_iter().map(Form::Vectors));
    println!("BB at 60 m/s, orbit, 1 ms: time a cell and step, and the plain loop over it");
    for level in 1..=RevolutionEye::FINEST {
        let eye = RevolutionEye::new(&Parameters::default(), level);
        for (form, (time, run)) in forms.iter().zip(fastest(&forms, &eye, SHORT, ROUNDS)) {
            let ns = 1e9 * time / run.cell_evaluations as f64;
            println!(
                "level {level} {:>5} cells {:>6} steps {ns:8.2} ns  {form:?}",
                eye.cells.len(),
                run.steps
            );
        }
    }
    println!("BB at 60 m/s, orbit, 3 ms");
    for level in 1..=3 {
        let eye = RevolutionEye::new(&Parameters::default(), level);
        for (form, (time, run)) in forms[1..].iter().zip(fastest(&forms[1..], &eye, WINDOW, 3)) {
            println!(
                "level {level} {:8.2} ms {:>6} steps to {:.2} ms  {form:?}",
                1e3 * time,
                run.steps,
                1e3 * run.simulated
            );
        }
    }
}
