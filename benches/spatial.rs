//! Speed of the eye in three dimensions: against its plain loop, and against its error beside the
//! axisymmetric eye.
//!
//! `cargo bench --bench spatial` prints whole runs and their time a cell and step, the time until
//! lens and iris root have peaked, and error against time of a blow straight on.

use contrecoup::models::axisymmetric::case::AxisymmetricCase;
use contrecoup::models::axisymmetric::time::march::{CellLoop, STEP_SHARE};
use contrecoup::models::axisymmetric::time::until::Until;
use contrecoup::models::paper::forces::kernel::vector_sets;
use contrecoup::models::spatial::case::{Scene, SpatialCase};
use contrecoup::models::spatial::time::run::run_as;
use contrecoup::run::kept::Keep;
use contrecoup::run::model::{EyeModel, Run};
use contrecoup::run::quantity::Quantity;
use contrecoup::run::watch::unwatched;
use contrecoup::scenario::set::set;
use contrecoup::scenario::{CheckedScenario, library};
use std::sync::{Arc, OnceLock};
use std::time::Instant;

/// The longest simulated time, in s.
const WINDOW: f64 = 20e-3;
/// The level of the axisymmetric eye that errors are taken against.
const FINEST: u32 = 5;

/// Time that this thread has had a core, where the system tells, as others may share the machine.
fn cpu_seconds() -> f64 {
    static START: OnceLock<Instant> = OnceLock::new();
    let start = START.get_or_init(Instant::now);
    let told = std::fs::read_to_string("/proc/thread-self/schedstat").ok();
    let nanoseconds = told.and_then(|s| s.split_whitespace().next()?.parse::<f64>().ok());
    nanoseconds.map_or_else(|| start.elapsed().as_secs_f64(), |ns| ns * 1e-9)
}

fn timed<T>(work: impl FnOnce() -> T) -> (T, f64) {
    let start = cpu_seconds();
    let done = work();
    (done, cpu_seconds() - start)
}

fn scenario(preset: &str, fields: &[(&str, &str)]) -> CheckedScenario {
    let mut scenario = library::resolve(preset).expect("a preset");
    for (path, value) in fields {
        set(&mut scenario, path, value).expect("a value that is allowed");
    }
    scenario.check().expect("a sound scenario")
}

fn spatial(scenario: &CheckedScenario) -> SpatialCase {
    let (model, object) = (scenario.physiological(), scenario.projectile());
    let scene = Scene::new(scenario, model.expect("tissues"), object.expect("an object"));
    SpatialCase::new(&scene)
}

/// A blow by every kind of loop, and how long it takes until lens and iris root have peaked.
fn cost(name: &str, preset: &str, fields: &[(&str, &str)]) {
    let case = spatial(&scenario(preset, fields));
    let cells = case.eye.cells.len();
    println!("{name}, {cells} cells");
    let run = |form, until| {
        let (eye, blow, keep) = (&case.eye, &case.blow, Keep::default());
        let run = || run_as(form, eye, blow, until, STEP_SHARE, keep, &mut unwatched);
        let (run, time) = timed(run);
        (run.expect("a blow that the eye holds"), time)
    };
    let vectors = vector_sets().into_iter().map(CellLoop::Vectors);
    let mut peaked = 0.0_f64;
    for form in [CellLoop::Plain].into_iter().chain(vectors) {
        let (run, time) = run(form, Until::Settled(WINDOW));
        println!(
            "{:>7} steps to {:5.2} ms {:9.2} ms {:8.2} ns a cell and step  {form:?}",
            run.steps,
            1e3 * run.simulated,
            1e3 * time,
            1e9 * time / (run.steps as f64 * cells as f64),
        );
        let [.., lens, iris] = run.extremes.common.tissue;
        peaked = peaked.max(lens.time).max(iris.time);
    }
    let (run, time) = run(CellLoop::Rows, Until::Time(peaked));
    println!(
        "{:>7} steps to {:5.2} ms {:9.2} ms until lens and iris root have peaked\n",
        run.steps,
        1e3 * peaked,
        1e3 * time
    );
}

/// What errors are shown of.
const SHOWN: [Quantity; 4] =
    [Quantity::Pressure, Quantity::EquatorStretch, Quantity::BackStretch, Quantity::LensPull];

/// A blow straight on, by each eye at its levels.
fn error_against_time() {
    let fields = [("model.support", "Gelatin"), ("numerics.geometry", "Half")];
    let half = scenario("bb-62", &fields);
    let round = scenario("bb-62", &fields[..1]);
    let run = |model: &dyn EyeModel, scenario: &CheckedScenario, level: u32| -> (Run, f64) {
        let model: Arc<dyn EyeModel> = model.at_level(level);
        let plan = model.plan_alone(scenario).expect("a plan");
        let (run, time) = timed(|| model.run(&plan, Keep::default(), &mut unwatched));
        (run.expect("a blow that the eye holds"), time)
    };
    let axisymmetric = AxisymmetricCase::new(&round, round.physiological().expect("tissues"));
    let spatial = spatial(&half);
    let values = |run: &Run| SHOWN.map(|of| run.readings[of].map_or(f64::NAN, |r| r.value));
    let (finest, _) = run(&axisymmetric, &round, FINEST);
    let finest = values(&finest);
    println!("bb-62 straight on in gelatin; errors against the axisymmetric eye at level {FINEST}");
    println!("                       time  {}", SHOWN.map(Quantity::label).join(", "));
    let levels = (1..FINEST).map(|level| (false, level));
    for (is_spatial, level) in levels.chain([(true, 1), (true, 2)]) {
        let (name, (run, time)) = if is_spatial {
            ("half, 3-D", run(&spatial, &half, level))
        } else {
            ("axisymmetric", run(&axisymmetric, &round, level))
        };
        let errors = values(&run);
        let errors =
            (0..SHOWN.len()).map(|i| format!("{:8.1} %", 1e2 * (errors[i] / finest[i] - 1.0)));
        let errors = errors.collect::<String>();
        println!("{name:>12} level {level} {:9.2} ms {errors}", 1e3 * time);
    }
}

fn main() {
    let below = ("impact.from", "below");
    let steep = [below, ("impact.angle_deg", "40")];
    let half = [steep[0], steep[1], ("model.support", "Free")];
    cost("BB at 40 degrees from below, nothing holds the eye, half of it", "bb-62", &half);
    let orbit = [steep[0], steep[1], ("model.support", "Orbit")];
    cost("BB at 40 degrees from below, in its orbit", "bb-62", &orbit);
    cost("squash ball at 30 degrees from below, in its orbit", "squash-ball", &[below]);
    error_against_time();
}
