//! The results against an independent solution, stored: fourth-order Runge-Kutta in first-order
//! form with a step of 50 ns, level 1, window 3 ms.

use contrecoup::scenario::{ForcePulse, Impact, PulseShape, Scenario};
use contrecoup::study::{Quantity, solve};

struct Row {
    force_n: f64,
    duration_ms: f64,
    angle_deg: f64,
    half_width_deg: f64,
    shape: PulseShape,
    apex: (f64, f64),
    shell: f64,
    meridian: f64,
    energy: f64,
    damage: f64,
    peaks: [f64; 4],
}

const SMOOTH: PulseShape = PulseShape::SmoothRectangle { edge_fraction: 0.1 };

fn rows() -> [Row; 4] {
    let head_on = |force_n, duration_ms, apex, shell, meridian, energy, damage, peaks| Row {
        force_n,
        duration_ms,
        angle_deg: 0.0,
        half_width_deg: 20.0,
        shape: SMOOTH,
        apex,
        shell,
        meridian,
        energy,
        damage,
        peaks,
    };
    [
        head_on(100.0, 0.2, (0.4983, 0.195), 0.005, 0.937, 0.0448, 6.36, [3.199, 19.35, 3.568, 4.061]),
        head_on(300.0, 0.2, (2.157, 0.199), 0.209, 2.883, 0.5212, 26.42, [12.40, 72.93, 9.926, 11.71]),
        head_on(600.0, 0.3, (5.308, 0.290), 0.588, 8.921, 2.856, 92.50, [20.20, 102.97, 17.58, 34.67]),
        Row {
            force_n: 200.0,
            duration_ms: 0.1,
            angle_deg: 20.0,
            half_width_deg: 10.0,
            shape: PulseShape::Triangle,
            apex: (0.2640, 0.115),
            shell: 0.018,
            meridian: 0.549,
            energy: 0.0858,
            damage: 4.54,
            peaks: [6.682, 21.11, 3.737, 8.839],
        },
    ]
}

fn scenario(row: &Row) -> Scenario {
    Scenario {
        impact: Impact::ForcePulse(ForcePulse {
            force_n: row.force_n,
            duration_ms: row.duration_ms,
            angle_deg: row.angle_deg,
            half_width_deg: row.half_width_deg,
            shape: row.shape,
        }),
        ..Scenario::default()
    }
}

#[test]
fn show() {
    for row in rows() {
        for step in [None, Some(0.5)] {
            let mut s = scenario(&row);
            s.numerics.step_us = step;
            let a = solve(&s, Default::default()).unwrap();
            println!("step {:.3} evals {} damage {} S {} M {} E {}", a.plan.step*1e6, a.cost.evaluations, a.index.damage(), a.index.shell_growth, a.index.meridian_growth, a.index.energy);
            println!("  want {} {} {} {}", row.damage, row.shell, row.meridian, row.energy);
            println!("  apex {:?} want {:?}", a.recording.extremes.apex, row.apex);
            println!("  peaks {:?} want {:?}", a.recording.extremes.force.map(|p| p.value), row.peaks);
            println!("  err {:?} bal {:.5} quad {} fold {:?} strain {:?}", a.errors.time_step, a.errors.energy_balance, a.recording.extremes.least_quad_ratio, a.recording.extremes.folded_at, a.recording.extremes.strain);
            println!("  {:?} total {:?} flags {:?}", a.solve_time, a.total_time, a.flags);
            let _ = Quantity::ALL;
        }
    }
}
