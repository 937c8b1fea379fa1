//! What the published injury curves say, in text and as JSON.

use crate::injury::{Caution, Injury, MARKS, Risk};
use serde_json::{Value, json};
use std::io::{self, Write};

use crate::report::figure::within;
use crate::report::format::{WIDTH, block, share, wrapped};

/// Prints the risks by injury and the sources; nothing if there are none.
///
/// # Errors
/// Whatever `out` reports.
pub fn text(risks: &[Risk], out: &mut dyn Write) -> io::Result<()> {
    if risks.is_empty() {
        return Ok(());
    }
    writeln!(
        out,
        "\nPublished injury curves, beside the index and not part of it:"
    )?;
    let mut sources: Vec<&'static str> = Vec::new();
    for injury in Injury::ALL {
        let mut name = injury.name();
        for risk in risks.iter().filter(|r| r.curve.injury == injury) {
            let known = sources.iter().position(|s| *s == risk.curve.source);
            let number = known.unwrap_or_else(|| {
                sources.push(risk.curve.source);
                sources.len() - 1
            });
            let (unit, scale) = risk.curve.measure.unit();
            let (low, high) = (100.0 * risk.band.0, 100.0 * risk.band.1);
            let band = if format!("{low:.0}") == format!("{high:.0}") {
                String::new()
            } else {
                format!("{low:.0}-{high:.0} %")
            };
            let marks = risk.marks();
            let line = format!(
                "  {name:<17}{:>7}{band:>11}  {:<17}{:>9} {unit:<5} [{}] {marks}",
                share(risk.risk),
                risk.curve.measure.name(),
                within(risk.value / scale, Some(100.0 * risk.error)),
                number + 1,
            );
            writeln!(out, "{}", line.trim_end())?;
            name = "";
        }
    }
    writeln!(out, "  {MARKS}")?;
    for (i, source) in sources.iter().enumerate() {
        writeln!(out, "  [{}] {source}", i + 1)?;
        let mut notes: Vec<String> = Vec::new();
        let of = || risks.iter().filter(|r| r.curve.source == *source);
        for risk in of().filter(|r| !r.curve.remark.is_empty()) {
            notes.push(format!(
                "{}: {}",
                risk.curve.injury.name(),
                risk.curve.remark
            ));
        }
        if let Some(risk) = of().next() {
            notes.push(risk.curve.species.name().to_owned());
            notes.push(risk.curve.data.to_owned());
        }
        for line in notes.iter().flat_map(|note| wrapped(note, WIDTH - 6)) {
            writeln!(out, "      {line}")?;
        }
    }
    let mut cautions: Vec<Caution> = risks.iter().filter_map(|r| r.caution).collect();
    cautions.dedup();
    for caution in cautions {
        let warning = format!("WARNING {}", caution.text());
        block(&warning, "", "", out)?;
    }
    Ok(())
}

/// The risks as JSON: one object for each curve.
pub fn json(risks: &[Risk]) -> Value {
    let one = |risk: &Risk| {
        let (unit, scale) = risk.curve.measure.unit();
        json!({
            "injury": risk.curve.injury.key(),
            "measure": risk.curve.measure.key(),
            "value": risk.value / scale,
            "unit": unit,
            "risk_percent": 100.0 * risk.risk,
            "risk_band_percent": [100.0 * risk.band.0, 100.0 * risk.band.1],
            "half_at": risk.curve.half() / scale,
            "standing": risk.curve.standing.name(),
            "source": risk.curve.source,
            "species": risk.curve.species.name(),
            "data": risk.curve.data,
            "remark": risk.curve.remark,
            "extrapolated": risk.extrapolated,
            "caution": risk.caution.map(Caution::key),
        })
    };
    json!({ "curves": risks.iter().map(one).collect::<Vec<_>>() })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::injury::{Computed, FlyingObject, Measures, assess};

    fn printed(blow: Option<FlyingObject>, pressure: Option<f64>) -> String {
        let mut out = Vec::new();
        let pressure = pressure.map(|value| Computed { value, error: 0.1 });
        let measures = Measures {
            blow,
            pressure,
            stress: None,
        };
        text(&assess(&measures), &mut out).unwrap();
        String::from_utf8(out).unwrap()
    }

    #[test]
    fn each_curve_is_printed_with_its_value_its_standing_and_its_source() {
        let bb = FlyingObject {
            mass: 0.345e-3,
            diameter: 4.5e-3,
            speed: 56.0,
        };
        let page = printed(Some(bb), Some(0.3e6));
        for words in [
            "globe rupture",
            "slope assumed",
            "unverified",
            "normalized energy    34.01 kJ/m2",
            "peak pressure         0.30 MPa",
            "0-5 %",
            "Duma 2005",
            "extrapolated",
        ] {
            assert!(page.contains(words), "{words} in\n{page}");
        }
        assert!(
            page.lines().all(|line| line.chars().count() <= 80),
            "{page}"
        );
    }

    #[test]
    fn an_object_larger_than_the_orbit_brings_a_warning() {
        let ball = FlyingObject {
            mass: 0.43,
            diameter: 0.22,
            speed: 18.0,
        };
        let page = printed(Some(ball), None);
        assert!(page.contains('!') && page.contains("WARNING"));
        assert_eq!(page.matches("WARNING").count(), 1);
    }

    #[test]
    fn a_scene_without_object_or_pressure_says_nothing() {
        assert!(printed(None, None).is_empty());
    }
}
