//! A force pulse as a line of the form: its shape in blocks, how long it lasts, how high it goes.

use crate::models::pulse::Pulse;
use crate::report::format::significant;
use crate::scenario::{Impact, PulseShape, Scenario, problem::plain};

/// Columns of the drawing.
const COLUMNS: usize = 20;
/// Looks at the pulse within a column, so that a narrow peak is not missed.
const LOOKS: usize = 25;
const BLOCKS: [char; 8] = ['▁', '▂', '▃', '▄', '▅', '▆', '▇', '█'];

/// What to say of a field of the pulse beside what it allows; nothing where that is enough.
pub fn described(scenario: &Scenario, path: &str) -> Option<String> {
    let Impact::ForcePulse(pulse) = &scenario.impact else { return None };
    let peak = format!("peak {} N", significant(pulse.peak_n()));
    let drawn = || drawn(&Pulse::new(pulse));
    Some(match (path, &pulse.shape) {
        ("impact.shape", PulseShape::Table(curve)) => {
            format!("{} {} knots, {peak}", drawn(), curve.knots().len())
        }
        ("impact.shape", _) => drawn(),
        ("impact.force_n", PulseShape::Table(_)) => format!("of a share of 1; {peak}"),
        ("impact.duration_ms", PulseShape::Table(curve)) => {
            let last = plain(curve.last_ms());
            format!("stretches the table, which was recorded over {last} ms")
        }
        _ => return None,
    })
}

/// The force from the start of the blow to its end; the lowest block is 0 or the strongest pull.
fn drawn(pulse: &Pulse) -> String {
    let mut columns = [0.0_f64; COLUMNS];
    let width = pulse.duration() / COLUMNS as f64;
    let segments = pulse.segments(pulse.duration());
    let mut here = 0;
    for (c, column) in columns.iter_mut().enumerate() {
        for look in 0..LOOKS {
            let t = width * (c as f64 + (look as f64 + 0.5) / LOOKS as f64);
            while here + 1 < segments.len() && segments[here].end < t {
                here += 1;
            }
            let force = pulse.force(segments[here].piece, t);
            if force.abs() > column.abs() {
                *column = force;
            }
        }
    }
    let low = columns.iter().copied().fold(0.0, f64::min);
    let high = columns.iter().copied().fold(0.0, f64::max);
    let range = if high > low { high - low } else { 1.0 };
    let top = (BLOCKS.len() - 1) as f64;
    let block = |f: &f64| BLOCKS[((f - low) / range * top).round() as usize];
    columns.iter().map(block).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scenario::{Curve, ForcePulse};

    #[test]
    fn a_pulse_is_drawn_as_it_rises_and_falls_and_the_peak_of_a_table_is_said() {
        let table = |knots: &[(f64, f64)]| {
            let mut pulse = ForcePulse::default();
            pulse.follow(Curve::new(knots.iter().copied()).unwrap());
            Scenario { impact: Impact::ForcePulse(pulse), ..Scenario::default() }
        };
        let rising = table(&[(0.0, 0.0), (0.1, 0.0), (0.15, 1.5), (0.2, 0.0)]);
        let said = |path| described(&rising, path).unwrap();
        let shape = said("impact.shape");
        assert!(shape.starts_with("▁▁▁▁▁▁▁▁▁▁▂▄▅▇██▇▅▄▂"), "{shape}");
        assert!(shape.contains("4 knots, peak 450"), "{shape}");
        assert!(said("impact.force_n").contains("peak 450"));
        assert!(said("impact.duration_ms").contains("recorded over 0.2 ms"));
        // A pull is drawn below zero.
        let shape = described(&table(&[(0.0, 1.0), (0.1, -1.0)]), "impact.shape").unwrap();
        assert!(shape.starts_with('█'), "{shape}");
        assert_eq!(shape.chars().nth(COLUMNS - 1), Some('▁'), "{shape}");
        // Any other shape is drawn where it is chosen.
        let said = |path| described(&Scenario::default(), path);
        assert!(said("impact.shape").unwrap().contains('█'));
        assert_eq!(said("impact.force_n"), None);
    }
}
