//! The body of revolution against published experiments and an independent prototype.

use contrecoup::dynamics::revolution::{
    Blow, Keep, Object, Outline, Run, STEP_SHARE, Surface, run,
};
use contrecoup::eye::revolution::{Parameters, RevolutionEye, ShellParameters, Surround};
use std::ops::ControlFlow;
use std::time::Instant;

fn ball(mass_g: f64, diameter_mm: f64, speed: f64) -> Object {
    Object {
        outline: Outline::Sphere(0.5e-3 * diameter_mm),
        mass: mass_g * 1e-3,
        speed,
        surface: Surface::RIGID,
        spring: None,
    }
}

fn flat(speed: f64) -> Object {
    Object {
        outline: Outline::Cylinder(10e-3, 2e-3),
        mass: 1.0,
        speed,
        surface: Surface::RIGID,
        spring: None,
    }
}

fn eye(level: u32, pig: bool, surround: Option<Surround>) -> RevolutionEye {
    let shell = if pig {
        ShellParameters::pig()
    } else {
        ShellParameters::human()
    };
    let parameters = Parameters {
        shell,
        surround,
        ..Parameters::default()
    };
    RevolutionEye::new(&parameters, level)
}

fn hit(eye: &RevolutionEye, object: Object, window_ms: f64) -> Run {
    let keep = Keep {
        traces: Some(1e-6),
        frames: None,
    };
    let window = window_ms * 1e-3;
    let blow = Blow::Object(object);
    let mut watch = |_| ControlFlow::Continue(());
    run(eye, &blow, window, STEP_SHARE, keep, &mut watch).expect("a run")
}

/// Mean force over 0.4 mm of intrusion around `mm`.
fn force_at(run: &Run, mm: f64) -> f64 {
    let t = run.traces.as_ref().expect("traces");
    let (mut sum, mut count) = (0.0, 0);
    for (force, way) in t.force.iter().zip(&t.intrusion) {
        if (way * 1e3 - mm).abs() < 0.2 {
            (sum, count) = (sum + force, count + 1);
        }
    }
    sum / f64::from(count)
}

#[test]
#[ignore = "prints the table"]
fn validation_table() {
    let soft = Surround::orbit().with_bulk(0.40e6);
    for level in [1, 2, 3, 5] {
        let start = Instant::now();
        let show = |what: &str, run: &Run| {
            let e = &run.extremes;
            println!(
                "{level} {what:<14} F20 {:7.1} N at {:.3} p {:.3} back {:.3} MPa stress {:.2} at {:.0} short {:.1} eq {:.2} at {:.3} vol {:.3} tri {:.3} res {:.4} steps {} {:.2} s",
                e.filtered_force.value,
                e.filtered_force.time * 1e3,
                e.pressure.value * 1e-6,
                e.back_pressure.value * 1e-6,
                e.scleral_stress.value * 1e-6,
                e.stress_angle.to_degrees(),
                e.shortening.value * 100.0,
                e.equator_growth.value * 100.0,
                e.equator_growth.time * 1e3,
                e.least_volume * 100.0,
                e.least_triangle,
                e.energy_residual,
                run.steps,
                start.elapsed().as_secs_f64()
            );
        };
        let r = hit(&eye(level, false, Some(Surround::orbit())), flat(8.2), 1.2);
        show("flat 8.2", &r);
        println!("   {:.1} N at 7.5 mm", force_at(&r, 7.5));
        let r = hit(&eye(level, false, Some(soft)), flat(8.2), 1.2);
        show("flat 8.2 0.40", &r);
        println!("   {:.1} N at 7.5 mm", force_at(&r, 7.5));
        let r = hit(&eye(level, false, Some(soft)), flat(10.0), 1.4);
        show("flat 10", &r);
        println!("   {:.1} N at 12 mm", force_at(&r, 12.0));
        let pig = eye(level, true, Some(Surround::gelatin()));
        show("steel 66.5", &hit(&pig, ball(1.0457, 6.35, 66.5), 1.0));
        show("steel 6.2", &hit(&pig, ball(1.0457, 6.35, 6.2), 2.0));
        show("airsoft", &hit(&pig, ball(0.25, 6.0, 99.0), 1.0));
        let human = eye(level, false, Some(Surround::gelatin()));
        show("BB 56", &hit(&human, ball(0.345, 4.5, 56.0), 1.0));
        show("BB 92", &hit(&human, ball(0.345, 4.5, 92.0), 1.0));
        let free = eye(level, true, None);
        show("BB 62.5 free", &hit(&free, ball(0.345, 4.5, 62.5), 1.0));
    }
}
