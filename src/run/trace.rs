//! What is followed over time: every result that has a trace, and what explains them.
//!
//! A result joins [`TRACES`] by its [`ResultTrace`]; what is none, as the load, is a row here.

use crate::run::kept::Traces;
use crate::run::quantity::{Quantity, factor_to};
use crate::run::result_trace::{Group, ResultTrace};
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
    /// Column in CSV, a name with its unit, if the trace has one of its own: a contract.
    pub column: Option<&'static str>,
    /// Decimals there.
    pub decimals: usize,
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
            Self::Of(quantity) => {
                let row = quantity.row();
                let Some(ResultTrace { label, column, values, place }) = row.trace else {
                    panic!("{} has no trace", row.key);
                };
                traced(label, column, row.unit, values, place)
            }
            Self::Other(other) => other.row(),
        }
    }

    /// Its values in these traces, SI; empty where the scene has none.
    pub fn values(self, traces: &Traces) -> &[f64] {
        (self.row().values)(traces)
    }

    /// What it is called with these traces: what drives the eye is the load or the contact.
    pub fn label(self, traces: &Traces) -> &'static str {
        let contact = self == Self::Other(OtherTrace::Drive) && by_contact(traces);
        if contact { Quantity::Contact.row().short } else { self.row().label }
    }
}

/// Whether a projectile drives the eye.
fn by_contact(traces: &Traces) -> bool {
    !traces.contact_force.is_empty()
}

const fn traced(
    label: &'static str,
    column: &'static str,
    unit: &'static str,
    values: fn(&Traces) -> &[f64],
    place: (Group, u8),
) -> TraceRow {
    let factor = factor_to(unit);
    TraceRow { label, unit, factor, values, place, column: Some(column), decimals: 9 }
}

impl OtherTrace {
    fn row(self) -> TraceRow {
        use Group::{Energies, Input, Motion, Projectile};
        match self {
            Self::Load => {
                TraceRow { decimals: 6, ..traced("load", "load_n", "N", |t| &t.load, (Input, 0)) }
            }
            Self::Drive => TraceRow {
                values: |t| if by_contact(t) { &t.contact_force } else { &t.load },
                place: (Motion, 0),
                column: None,
                ..Self::Load.row()
            },
            Self::Kinetic => traced("kinetic", "kinetic_j", "J", |t| &t.kinetic, (Energies, 0)),
            Self::Dissipated => {
                traced("dissipated", "dissipated_j", "J", |t| &t.dissipated, (Energies, 2))
            }
            Self::ProjectileX => {
                traced("projectile x", "projectile_x_mm", "mm", |t| &t.projectile, (Projectile, 1))
            }
            Self::ProjectileVx => {
                let values: fn(&Traces) -> &[f64] = |t| &t.projectile_velocity;
                let name = "projectile_vx_m_s";
                traced(name, name, "m/s", values, (Projectile, 3))
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
    let rows = TRACES.iter().map(|trace| trace.row());
    let rows = rows.filter(|row| !(row.values)(traces).is_empty());
    let columns: Vec<(&str, TraceRow)> = rows.filter_map(|row| Some((row.column?, row))).collect();
    let names = columns.iter().map(|(name, _)| *name);
    csv.write_record(std::iter::once("time_ms").chain(names))?;
    for (i, time) in traces.time.iter().enumerate() {
        csv.write_field(format!("{:.9}", time * 1e3))?;
        for (_, row) in &columns {
            let value = (row.values)(traces)[i] * row.factor;
            csv.write_field(format!("{value:.*e}", row.decimals))?;
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
                assert!(row.column.is_none() || row.column != other.column);
            }
        }
    }
}
