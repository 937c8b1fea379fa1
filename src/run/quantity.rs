//! The table of results: one row for each, from which everything that lists results is made.
//!
//! Text, JSON, CSV, the comparison, the keys to the next peak, ensembles, sweeps and the reports
//! of errors iterate [`Quantity::ALL`] and ask the [`Row`]. A new reading is a variant and its row
//! here, and a line in the table of each model that has it: the compiler asks for the row. What is
//! made of readings, the index and the risks, has its formula in `answer`.
//!
//! "The axisymmetric eye" is the model `Physiological` of a scenario. A result that a scene does
//! not have reads as `None`: the pressure where there are no cells, the force of contact where
//! there is no projectile.

use crate::run::kept::Traces;
use crate::run::places::Monitor;
use crate::run::result_trace::{Group, ResultTrace, trace};
use strum::{EnumCount, VariantArray};

/// One scalar result, in the order of every table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, EnumCount, VariantArray)]
pub enum Quantity {
    /// The damage index of the paper, %.
    Damage,
    /// S, growth of the shell's length in the section, %; at the axisymmetric eye of the meridian.
    ShellGrowth,
    /// M, growth of the vertical diameter, %; at the axisymmetric eye of the largest diameter
    /// across the blow.
    MeridianGrowth,
    /// E, energy imparted, J.
    Energy,
    /// Displacement of the corneal apex, mm.
    Apex,
    /// Peak force at the node near the centre of the eye, N; at the axisymmetric eye that of a
    /// fixed mass of 75 mg with the acceleration there.
    ForceCentre,
    /// Peak force at the node of the cornea, N.
    ForceFront,
    /// Peak force at the node of the retina, N.
    ForceRight,
    /// Peak force at the node behind 12 o'clock, N.
    ForceTop,
    /// Largest energy stored in the springs at one time, J of the model's depth: how much of what
    /// was imparted the tissues held at once, before it went into drag.
    StoredEnergy,
    /// Peak intraocular pressure, in megapascals, at the axisymmetric eye: the mean of the globe
    /// through a low pass of 20 us.
    Pressure,
    /// Peak force of contact, N, where a projectile hits, as a mean over 100 us.
    Contact,
    /// Peak pressure at the back of the axisymmetric eye, where a sensor sits in experiments, in
    /// megapascals: a mean over 150 us.
    BackPressure,
    /// Peak tension of the sclera of the axisymmetric eye, in megapascals, through a low pass of 20
    /// us.
    ScleralStress,
    /// Largest loss of the eye's length along the blow, in % of it, at the axisymmetric eye.
    Shortening,
    /// How far an object's surface comes into the axisymmetric eye, mm.
    Intrusion,
    /// How far the lens moves along the blow, mm, in the axisymmetric eye.
    LensWay,
    /// Speed of an object back along its path at the end, m/s, at the axisymmetric eye.
    Rebound,
    /// Largest stretch of the wall along the meridian near the equator of the axisymmetric eye, %,
    /// between 60 and 120 degrees from the front; this and the next four through a low pass of 20
    /// us.
    EquatorStretch,
    /// Mean stretch of its wall along the meridian at the back, %, from 150 degrees on.
    BackStretch,
    /// Growth of its shell's radius where the retina has its front edge, %, at 62 degrees.
    EdgeGrowth,
    /// How much farther than at rest the lens's equator is from the shell at 62 degrees, mm.
    LensPull,
    /// How much farther than at rest the lens's equator is from the shell at the root of the iris,
    /// at 45 degrees, mm.
    IrisPull,
    /// Most energy that the axisymmetric eye is given over the area of the largest contact, kJ/m2.
    CornealEnergy,
    /// Risk of rupture of the globe, %.
    GlobeRupture,
    /// Risk of damage of the retina at the back, %.
    RetinaBack,
    /// Risk of damage of the retina at its front edge, %.
    RetinaFront,
    /// Risk of a lens torn off, %.
    LensDislocation,
    /// Risk of blood in the anterior chamber, %.
    Hyphema,
    /// Risk of the loss of the cornea's outermost layer, %.
    CornealAbrasion,
}

/// In which scenes the one error stated for the whole answer covers a result: those lead.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Leads {
    /// In every scene that has the result.
    Always,
    /// Only where no projectile hits. Where one does, node forces follow every wave and differ from
    /// mesh to mesh.
    WithoutProjectile,
    /// Nowhere, but its own error is watched: what tissues feel may wander far more than the motion.
    Watched,
    /// Nowhere.
    Never,
}

/// Which results share the fate of their step errors: two runs may agree on one of them by chance,
/// so none is claimed to be much better than the worst of its family.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// Motion of the whole eye; the axisymmetric model raises the errors of this family together.
    Motion,
    /// Forces of nodes on the shell, which come from the same waves; the Paper model raises their
    /// errors together.
    ShellForces,
    /// Its step error says nothing of any other result's.
    Alone,
    /// No error is stated of it: a published curve turned another result, or the input, into it, or
    /// it is looked at at step ends only, so that two runs may share what they miss.
    Unstated,
}

/// All that is known of one result.
#[derive(Clone, Copy)]
pub struct Row {
    /// Name with its unit, as in JSON and CSV: a contract.
    pub key: &'static str,
    /// Name for people, of at most 18 characters.
    pub label: &'static str,
    /// Name for narrow columns and beside curves.
    pub short: &'static str,
    /// Unit for people.
    pub unit: &'static str,
    /// Factor from the reading in SI to the unit.
    pub factor: f64,
    /// What rounding does to it, in the unit: a force is the small difference of large ones, which
    /// leaves some 1e-10 N in an eye at rest.
    pub rounding: f64,
    /// In which scenes the one stated error covers it.
    pub leads: Leads,
    /// What its step error hangs together with.
    pub family: Family,
    /// Upper end of its colour scale on a map, in the unit; without one the largest value there.
    pub whole: Option<f64>,
    /// Whether it is a risk, which injury curves make of readings.
    pub risk: bool,
    /// Its trace over time, if it is recorded.
    pub trace: Option<ResultTrace>,
}

impl Quantity {
    /// All quantities, in the order above.
    pub const ALL: &[Self] = Self::VARIANTS;
    /// The peak forces at the monitored nodes, in the paper's order.
    pub const FORCES: [Self; 4] = [
        Self::ForceCentre,
        Self::ForceFront,
        Self::ForceRight,
        Self::ForceTop,
    ];
    /// What an eye that is hit is asked for first.
    pub const FELT: [Self; 3] = [Self::Contact, Self::Pressure, Self::EquatorStretch];

    /// All that is known of it, from the one table.
    #[expect(clippy::too_many_lines, reason = "the table: one arm for each result")]
    pub fn row(self) -> Row {
        match self {
            Self::Damage => Row {
                leads: Leads::Always,
                whole: Some(1e2),
                ..number("damage_percent", "damage index", "index", "")
            },
            Self::ShellGrowth => Row {
                factor: 1e2,
                trace: Some(trace(
                    "wall growth S",
                    "scleral_growth_percent",
                    |t| &t.shell_growth,
                    (Group::Motion, 2),
                )),
                ..number("scleral_growth_percent", "wall growth S", "S", "%")
            },
            Self::MeridianGrowth => Row {
                factor: 1e2,
                trace: Some(trace(
                    "width growth M",
                    "meridian_growth_percent",
                    |t| &t.meridian_growth,
                    (Group::Motion, 3),
                )),
                ..number("meridian_growth_percent", "width growth M", "M", "%")
            },
            Self::Energy => Row {
                rounding: 1e-16,
                trace: Some(trace(
                    "work in",
                    "work_j",
                    |t| &t.work,
                    (Group::Energies, 3),
                )),
                ..number("energy_imparted_j", "energy imparted E", "E", "J")
            },
            Self::Apex => Row {
                factor: 1e3,
                leads: Leads::Always,
                trace: Some(trace(
                    "cornea pushed in",
                    "apex_mm",
                    |t| &t.apex,
                    (Group::Motion, 1),
                )),
                ..number("apex_displacement_mm", "cornea pushed in", "pushed", "mm")
            },
            Self::ForceCentre => Row {
                // Far smoother than those of the shell, and really better.
                family: Family::Alone,
                trace: Some(trace(
                    "centre",
                    "force_centre_n",
                    |t| &t.force[Monitor::Centre as usize],
                    (Group::NodeForces, 0),
                )),
                ..node_force("peak_force_centre_n", "peak force, centre", "centre")
            },
            Self::ForceFront => Row {
                trace: Some(trace(
                    "front",
                    "force_front_n",
                    |t| &t.force[Monitor::Front as usize],
                    (Group::NodeForces, 1),
                )),
                ..node_force("peak_force_front_n", "peak force, front", "front")
            },
            Self::ForceRight => Row {
                trace: Some(trace(
                    "right",
                    "force_right_n",
                    |t| &t.force[Monitor::Right as usize],
                    (Group::NodeForces, 2),
                )),
                ..node_force("peak_force_right_n", "peak force, right", "right")
            },
            Self::ForceTop => Row {
                trace: Some(trace(
                    "top",
                    "force_top_n",
                    |t| &t.force[Monitor::Top as usize],
                    (Group::NodeForces, 3),
                )),
                ..node_force("peak_force_top_n", "peak force, top", "top")
            },
            Self::StoredEnergy => Row {
                rounding: 1e-16,
                family: Family::Unstated,
                trace: Some(trace(
                    "elastic",
                    "elastic_j",
                    |t| &t.elastic,
                    (Group::Energies, 1),
                )),
                ..number("peak_stored_energy_j", "stored energy", "stored", "J")
            },
            Self::Pressure => Row {
                factor: 1e-6,
                leads: Leads::Always,
                trace: Some(trace(
                    "pressure",
                    "pressure_mpa",
                    |t| &t.pressure,
                    (Group::Inside, 0),
                )),
                ..number("peak_pressure_mpa", "peak pressure", "pressure", "MPa")
            },
            Self::Contact => Row {
                rounding: FORCE_ROUNDING,
                leads: Leads::Always,
                trace: Some(trace(
                    "contact",
                    "contact_force_n",
                    |t| &t.contact_force,
                    (Group::Projectile, 0),
                )),
                ..number("peak_contact_force_n", "contact force", "contact", "N")
            },
            Self::BackPressure => Row {
                factor: 1e-6,
                leads: Leads::Always,
                trace: Some(trace(
                    "pressure at back",
                    "back_pressure_mpa",
                    |t| &t.back_pressure,
                    (Group::Inside, 2),
                )),
                ..number(
                    "peak_back_pressure_mpa",
                    "pressure at back",
                    "at back",
                    "MPa",
                )
            },
            Self::ScleralStress => Row {
                factor: 1e-6,
                leads: Leads::Always,
                trace: Some(trace(
                    "scleral stress",
                    "scleral_stress_mpa",
                    |t| &t.scleral_stress,
                    (Group::Inside, 3),
                )),
                ..number("peak_scleral_stress_mpa", "scleral stress", "stress", "MPa")
            },
            Self::Shortening => Row {
                factor: 1e2,
                leads: Leads::Always,
                trace: Some(trace(
                    "shortening",
                    "shortening_percent",
                    |t| &t.shortening,
                    (Group::Motion, 4),
                )),
                ..number("shortening_percent", "eye shortened by", "squashed", "%")
            },
            Self::Intrusion => Row {
                factor: 1e3,
                trace: Some(trace(
                    "intrusion",
                    "intrusion_mm",
                    |t| &t.intrusion,
                    (Group::Projectile, 5),
                )),
                ..number("intrusion_mm", "object goes in", "goes in", "mm")
            },
            Self::LensWay => Row {
                factor: 1e3,
                trace: Some(trace("lens", "lens_mm", |t| &t.lens, (Group::Motion, 5))),
                ..number("lens_displacement_mm", "lens displacement", "lens", "mm")
            },
            Self::Rebound => Row {
                ..number("rebound_speed_m_s", "rebound speed", "rebound", "m/s")
            },
            Self::EquatorStretch => Row {
                leads: Leads::Watched,
                factor: 1e2,
                trace: Some(tissue(
                    "equator stretch",
                    "equator_stretch_percent",
                    0,
                    |t| &t.tissue[0],
                )),
                ..number("equator_stretch_percent", "equator stretch", "stretch", "%")
            },
            Self::BackStretch => Row {
                leads: Leads::Watched,
                factor: 1e2,
                trace: Some(tissue("stretch at back", "back_stretch_percent", 1, |t| {
                    &t.tissue[1]
                })),
                ..number("back_stretch_percent", "stretch at back", "back", "%")
            },
            Self::EdgeGrowth => Row {
                leads: Leads::Watched,
                factor: 1e2,
                trace: Some(tissue("retina's edge", "edge_growth_percent", 2, |t| {
                    &t.tissue[2]
                })),
                ..number("edge_growth_percent", "retina edge growth", "edge", "%")
            },
            Self::LensPull => Row {
                leads: Leads::Watched,
                factor: 1e3,
                trace: Some(tissue("pull on lens", "lens_pull_mm", 3, |t| &t.tissue[3])),
                ..number("lens_pull_mm", "pull on lens", "pull", "mm")
            },
            Self::IrisPull => Row {
                leads: Leads::Watched,
                factor: 1e3,
                trace: Some(tissue("pull on iris", "iris_pull_mm", 4, |t| &t.tissue[4])),
                ..number("iris_pull_mm", "pull on iris", "iris", "mm")
            },
            Self::CornealEnergy => Row {
                leads: Leads::Watched,
                factor: 1e-3,
                ..number(
                    "corneal_energy_kj_m2",
                    "energy at cornea",
                    "cornea",
                    "kJ/m2",
                )
            },
            Self::GlobeRupture => risk("globe_rupture_percent", "globe rupture", "rupture"),
            Self::RetinaBack => risk("retina_back_percent", "retina at the back", "ret.back"),
            Self::RetinaFront => risk("retina_front_percent", "retina front edge", "ret.edge"),
            Self::LensDislocation => {
                risk("lens_dislocation_percent", "lens dislocation", "lens off")
            }
            Self::Hyphema => risk("hyphema_percent", "hyphema", "hyphema"),
            Self::CornealAbrasion => {
                risk("corneal_abrasion_percent", "corneal abrasion", "abrasion")
            }
        }
    }

    /// Name with its unit, as in JSON and CSV.
    pub fn key(self) -> &'static str {
        self.row().key
    }

    /// Name for people.
    pub fn label(self) -> &'static str {
        self.row().label
    }

    /// Whether it is a risk of injury in %, not a reading of the motion.
    pub fn is_risk(self) -> bool {
        self.row().risk
    }

    /// Whether a value, in its unit, is no more than what rounding does.
    pub(crate) fn is_rounding(self, value: f64) -> bool {
        value.abs() < self.row().rounding
    }
}

const FORCE_ROUNDING: f64 = 3e-10;

/// A result of the whole motion that does not lead, to be filled in.
const fn number(
    key: &'static str,
    label: &'static str,
    short: &'static str,
    unit: &'static str,
) -> Row {
    Row {
        key,
        label,
        short,
        unit,
        factor: 1.0,
        rounding: 1e-12,
        leads: Leads::Never,
        family: Family::Motion,
        whole: None,
        risk: false,
        trace: None,
    }
}

/// The force of a node of the shell.
const fn node_force(key: &'static str, label: &'static str, short: &'static str) -> Row {
    Row {
        rounding: FORCE_ROUNDING,
        leads: Leads::WithoutProjectile,
        family: Family::ShellForces,
        ..number(key, label, short, "N")
    }
}

/// A trace of what a tissue feels.
const fn tissue(
    label: &'static str,
    column: &'static str,
    place: u8,
    values: fn(&Traces) -> &[f64],
) -> ResultTrace {
    trace(label, column, values, (Group::Tissues, place))
}

/// A risk, which what a tissue felt was turned into.
const fn risk(key: &'static str, label: &'static str, short: &'static str) -> Row {
    Row {
        factor: 1e2,
        whole: Some(1e2),
        family: Family::Unstated,
        risk: true,
        ..number(key, label, short, "%")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_differ_and_fit_their_columns() {
        for (i, quantity) in Quantity::ALL.iter().enumerate() {
            let row = quantity.row();
            assert_eq!(*quantity as usize, i);
            assert!(row.label.len() <= 18 && row.short.len() <= 8, "{}", row.key);
            for other in &Quantity::ALL[..i] {
                let other = other.row();
                assert!(row.key != other.key && row.label != other.label);
                assert!(row.short != other.short);
            }
            assert!(!row.risk || row.family == Family::Unstated, "{}", row.key);
        }
    }
}
