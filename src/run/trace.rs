//! What is followed over time: every result that has a trace, and what explains them.
//!
//! The force profiles, the sparklines, the overlaid curves of a comparison and the traces as CSV
//! iterate [`TRACES`]. A result joins them by its [`ResultTrace`] in the table of results; what is
//! no result, such as the load, is a row here.

use crate::run::{kept::Traces, quantity::Quantity, result_trace::Group};
use std::io::Write;
use std::sync::LazyLock;
use strum::VariantArray;

/// A value that is followed over time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Trace {
    /// A result that has a trace.
    Of(Quantity),
    /// A value that is no result.
    Other(OtherTrace),
}

impl Default for Trace {
    /// The node near the centre of the eye.
    fn default() -> Self {
        Self::Of(Quantity::ForceCentre)
    }
}

/// What is followed over time without being a result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, VariantArray)]
pub enum OtherTrace {
    /// The load of the scenario.
    Load,
    /// What acts on the eye: the force of contact of a projectile, else the load.
    Drive,
    /// Energy of motion.
    Kinetic,
    /// Energy lost so far.
    Dissipated,
    /// Centre of the projectile along its way.
    ProjectileX,
    /// Velocity of the projectile along its way.
    ProjectileVx,
}

/// How a trace is named, read, drawn and written.
#[derive(Clone, Copy)]
pub struct TraceRow {
    /// Name for people.
    pub label: &'static str,
    /// Unit for people.
    pub unit: &'static str,
    /// Factor from SI to the unit.
    pub factor: f64,
    /// The values, SI; empty where the scene has none.
    pub values: fn(&Traces) -> &[f64],
    /// What it is looked at with, and its place there.
    pub place: (Group, u8),
    /// Column in CSV, if the trace has one of its own.
    pub column: Option<Column>,
}

/// How a trace is written as CSV.
#[derive(Clone, Copy)]
pub struct Column {
    /// Name with its unit: a contract.
    pub name: &'static str,
    /// Factor from SI to that unit.
    pub factor: f64,
    /// The value in text.
    pub digits: fn(f64) -> String,
}

/// Every trace, by its place.
pub static TRACES: LazyLock<Vec<Trace>> = LazyLock::new(|| {
    let traced = |q: &&Quantity| q.row().trace.is_some();
    let results = Quantity::ALL.iter().filter(traced).map(|q| Trace::Of(*q));
    let others = OtherTrace::VARIANTS.iter().map(|b| Trace::Other(*b));
    let mut all: Vec<Trace> = results.chain(others).collect();
    all.sort_by_key(|trace| trace.row().place);
    all
});

impl Trace {
    /// Where it is drawn and how it is read, from the one table.
    ///
    /// # Panics
    /// For a result without a trace.
    pub fn row(self) -> TraceRow {
        match self {
            Self::Of(quantity) => of_result(quantity),
            Self::Other(other) => other.row(),
        }
    }

    /// Its values in these traces, SI; empty where the scene has none.
    pub fn values(self, traces: &Traces) -> &[f64] {
        (self.row().values)(traces)
    }

    /// What it is called with these traces: what drives the eye is the load or the contact.
    pub fn label(self, traces: &Traces) -> &'static str {
        if self == Self::Other(OtherTrace::Drive) && by_contact(traces) {
            Quantity::Contact.row().short
        } else {
            self.row().label
        }
    }
}

fn of_result(quantity: Quantity) -> TraceRow {
    let row = quantity.row();
    let Some(trace) = row.trace else {
        panic!("{} has no trace", row.key);
    };
    TraceRow {
        label: trace.label,
        ..named_as_column(row.unit, row.factor, trace.column, trace.values, trace.place)
    }
}

/// Whether a projectile drives the eye.
fn by_contact(traces: &Traces) -> bool {
    !traces.contact_force.is_empty()
}

/// What is named as its column and written in its unit.
fn named_as_column(
    unit: &'static str,
    factor: f64,
    column: &'static str,
    values: fn(&Traces) -> &[f64],
    place: (Group, u8),
) -> TraceRow {
    TraceRow {
        label: column,
        unit,
        factor,
        values,
        place,
        column: Some(Column { name: column, factor, digits: |value| format!("{value:.9e}") }),
    }
}

impl OtherTrace {
    fn row(self) -> TraceRow {
        use Group::{Energies, Input, Motion, Projectile};
        match self {
            Self::Load => TraceRow {
                label: "load",
                column: Some(Column {
                    name: "load_n",
                    factor: 1.0,
                    digits: |newtons| format!("{newtons:.6e}"),
                }),
                ..named_as_column("N", 1.0, "", |t| &t.load, (Input, 0))
            },
            Self::Drive => TraceRow {
                values: |t| {
                    if by_contact(t) { &t.contact_force } else { &t.load }
                },
                place: (Motion, 0),
                column: None,
                ..Self::Load.row()
            },
            Self::Kinetic => TraceRow {
                label: "kinetic",
                ..named_as_column("J", 1.0, "kinetic_j", |t| &t.kinetic, (Energies, 0))
            },
            Self::Dissipated => TraceRow {
                label: "dissipated",
                ..named_as_column("J", 1.0, "dissipated_j", |t| &t.dissipated, (Energies, 2))
            },
            Self::ProjectileX => TraceRow {
                label: "projectile x",
                ..named_as_column("mm", 1e3, "projectile_x_mm", |t| &t.projectile, (Projectile, 1))
            },
            Self::ProjectileVx => {
                let values: fn(&Traces) -> &[f64] = |t| &t.projectile_velocity;
                named_as_column("m/s", 1.0, "projectile_vx_m_s", values, (Projectile, 3))
            }
        }
    }
}

/// Writes traces as CSV, one row a step: the time, then every trace that they have.
///
/// # Errors
/// Whatever `out` reports.
pub fn write_traces(traces: &Traces, out: impl Write) -> csv::Result<()> {
    let mut csv = csv::Writer::from_writer(out);
    let column = |trace: &Trace| Some((trace.row().column?, trace.values(traces)));
    let columns: Vec<(Column, &[f64])> =
        TRACES.iter().filter_map(column).filter(|(_, values)| !values.is_empty()).collect();
    let names = columns.iter().map(|(column, _)| column.name);
    csv.write_record(std::iter::once("time_ms").chain(names))?;
    for (i, time) in traces.time.iter().enumerate() {
        csv.write_field(format!("{:.9}", time * 1e3))?;
        for (column, values) in &columns {
            csv.write_field((column.digits)(values[i] * column.factor))?;
        }
        csv.write_record(None::<&[u8]>)?;
    }
    csv.flush()?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn courses_have_places_and_columns_of_their_own() {
        for (i, trace) in TRACES.iter().enumerate() {
            let row = trace.row();
            for other in TRACES[..i].iter().map(|other| other.row()) {
                assert_ne!(row.place, other.place, "{}", row.label);
                let name = |row: &TraceRow| row.column.map(|column| column.name);
                assert!(row.column.is_none() || name(&row) != name(&other));
            }
        }
    }
}
