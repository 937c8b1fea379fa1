//! The fit to what clinics counted as text of 80 columns and as JSON.

use crate::injury::{Injury, KINDS};
use crate::report::format::{digits, paragraph};
use crate::verify::clinics::fit::{MeanScore, Scored, Study};
use serde_json::{Value, json};
use std::io::{self, Write};

/// The mean scores that are told: of the rows that models are compared on by a fit to those alone,
/// then of those and of all others by the fit that ships.
fn scores([first, all]: &[Study; 2]) -> [(&'static str, MeanScore); 3] {
    [
        ("first rows, fitted by themselves", first.mean(|row| row.fit == "first")),
        ("first rows, fitted with all others", all.mean(|row| row.fit == "first")),
        ("more rows, fitted with the first", all.mean(|row| row.fit == "more")),
    ]
}

/// Prints points of 50 %, then every row fitted and seen, then the scores.
pub fn text(studies: &[Study; 2], out: &mut dyn Write) -> io::Result<()> {
    let table = studies[1].fitted.table();
    let what = "Points of 50 % by kind of object, fitted to what clinics counted, x or / one \
                standard deviation, in the unit of each measure:";
    paragraph(what, out)?;
    let names = Injury::ALL.iter().map(|injury| injury.word());
    let units = Injury::ALL.iter().map(|injury| injury.measure().row().unit);
    for head in [names.collect::<Vec<_>>(), units.collect()] {
        write!(out, "{:12}", "")?;
        head.iter().try_for_each(|head| write!(out, " {head:>10}"))?;
        writeln!(out)?;
    }
    for (i, kind) in std::iter::once("all").chain(KINDS.iter().map(|kind| kind.key)).enumerate() {
        write!(out, "{kind:12}")?;
        for of in &table {
            let point = &of.points[i];
            let half = digits(point.half, 2);
            write!(out, " {:>10}", format!("{half} x{:.1}", libm::exp10(point.known)))?;
        }
        writeln!(out)?;
    }
    for (label, value) in [("eyes differ", 0), ("kinds differ", 1)] {
        write!(out, "{label:12}")?;
        for of in &table {
            let value = [of.eyes, of.kinds_differ][value];
            write!(out, " {value:>10.2}")?;
        }
        writeln!(out)?;
    }
    writeln!(out, "(the last two: standard deviations of log10 of the measure)\n")?;
    writeln!(
        out,
        "{:30} {:12} {:9} {:>7} {:>5} {:>5} {:>5}",
        "series", "kind", "injury", "seen", "told", "fit", "out"
    )?;
    studies[1].scored.iter().try_for_each(|scored| row(scored, out))?;
    let what = "fit, out: ln of the chance of the count, fitted and with its kind left out; told: \
                in %, by the most likely points.";
    paragraph(what, out)?;
    writeln!(
        out,
        "\nMean ln of a count's chance   {:>14} {:>8} {:>9} {:>11}",
        "rows", "fitted", "left out", "laboratory"
    )?;
    for (name, mean) in scores(studies) {
        let MeanScore { rows, fitted, left_out, laboratory } = mean;
        writeln!(out, "{name:36} {rows:>7} {fitted:>8.3} {left_out:>9.3} {laboratory:>11.3}")?;
    }
    paragraph("laboratory: by points of donors' and animals' eyes alone.", out)
}

fn row(scored: &Scored, out: &mut dyn Write) -> io::Result<()> {
    let row = scored.row;
    let study: String = row.study.chars().take(30).collect();
    let injury = row.injury().map_or("", Injury::word);
    let seen = format!("{}/{}", row.hurt, row.eyes);
    writeln!(
        out,
        "{study:30} {:12} {injury:9} {seen:>7} {:>5.0} {:>5.1} {:>5.1}",
        row.kinds,
        1e2 * scored.told,
        scored.fitted,
        scored.left_out
    )
}

pub fn json(studies: &[Study; 2]) -> Value {
    let row = |scored: &Scored| {
        let of = scored.row;
        json!({
            "study": of.study, "year": of.year, "kind": of.kinds, "injury": of.injury,
            "eyes": of.eyes, "hurt": of.hurt, "fit": of.fit,
            "told_percent": 1e2 * scored.told,
            "fitted": scored.fitted,
            "left_out": scored.left_out,
            "laboratory": scored.laboratory,
        })
    };
    let mean = |(name, mean): &(&str, MeanScore)| {
        json!({
            "of": name, "rows": mean.rows, "fitted": mean.fitted,
            "left_out": mean.left_out, "laboratory": mean.laboratory,
        })
    };
    json!({
        "points": studies[1].fitted.table(),
        "rows": studies[1].scored.iter().map(row).collect::<Value>(),
        "scores": scores(studies).iter().map(mean).collect::<Value>(),
    })
}
