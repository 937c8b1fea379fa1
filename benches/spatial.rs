//! Speed of the eye in three dimensions against its plain loop, half and whole.
//!
//! `cargo bench --bench spatial` prints whole runs and their time a cell and step.

use contrecoup::models::axisymmetric::eye::parameters::Parameters;
use contrecoup::models::axisymmetric::forces::object::{Object, ObjectOutline, ObjectSurface};
use contrecoup::models::axisymmetric::time::march::CellLoop;
use contrecoup::models::axisymmetric::time::until::Until;
use contrecoup::models::paper::forces::kernel::vector_sets;
use contrecoup::models::spatial::eye::SpatialEye;
use contrecoup::models::spatial::{Aim, Extent, OrbitRim, STEP_SHARE, SpatialBlow, run_as};
use contrecoup::run::kept::Keep;
use contrecoup::scenario::Rim;
use std::ops::ControlFlow;
use std::sync::OnceLock;
use std::time::Instant;

/// The longest simulated time, in s.
const WINDOW: f64 = 20e-3;
/// That of the plain loop, in s.
const SHORT: f64 = 0.3e-3;

/// Time that this thread has had a core, where the system tells, as others may share the machine.
fn cpu_seconds() -> f64 {
    static START: OnceLock<Instant> = OnceLock::new();
    let start = START.get_or_init(Instant::now);
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|s| s.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| start.elapsed().as_secs_f64(), |ns| ns * 1e-9)
}

fn main() {
    let object = Object {
        outline: ObjectOutline::Sphere(2.25e-3),
        mass: 0.345e-3,
        speed: 62.5,
        surface: ObjectSurface::RIGID,
        spring: None,
    };
    let aim = Aim {
        angle: 40f64.to_radians(),
        from: std::f64::consts::PI,
        ..Aim::default()
    };
    println!(
        "BB at 62.5 m/s from below at 40 degrees, until nothing grows: the run, and its time a cell and step"
    );
    for (extent, rim) in [
        (Extent::Half, None),
        (Extent::Full, Some(OrbitRim::from(&Rim::CAUCASIAN))),
    ] {
        let eye = SpatialEye::new(&Parameters::default(), rim, extent, 1);
        let up = match extent {
            Extent::Half => aim.plane(),
            Extent::Full => 0.0,
        };
        let blow = SpatialBlow { object, aim, up };
        let plain = [(CellLoop::Plain, Until::Time(SHORT))];
        let vectors = vector_sets().into_iter();
        let vectors = vectors.map(|level| (CellLoop::Vectors(level), Until::Settled(WINDOW)));
        for (form, until) in plain.into_iter().chain(vectors) {
            let start = cpu_seconds();
            let mut watch = |_| ControlFlow::Continue(());
            let keep = Keep::default();
            let run = run_as(form, &eye, &blow, until, STEP_SHARE, keep, &mut watch);
            let run = run.expect("a BB at 62.5 m/s");
            let time = cpu_seconds() - start;
            println!(
                "{extent:?} {:>5} cells {:>6} steps to {:.2} ms {:9.2} ms {:8.2} ns  {form:?}",
                eye.cells.len(),
                run.steps,
                1e3 * run.simulated,
                1e3 * time,
                1e9 * time / (run.steps as f64 * eye.cells.len() as f64),
            );
        }
    }
}
