//! The table of results: one row for each, from which everything that lists results is made.
//!
//! A new reading is a variant and its row here, and a line in the table of each model that has it.
//! What is made of readings, the index and the risks, has its formula in `answer`. A result that a
//! scene does not have reads as `None`.

use crate::run::kept::Traces;
use crate::run::result_trace::{Group, ResultTrace};
use strum::{EnumCount, VariantArray};

/// One scalar result, in the order of every table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, EnumCount, VariantArray)]
pub enum Quantity {
    /// The damage index of the paper, %.
    Damage,
    /// S, growth of the shell's length in the section, %; at the axisymmetric eye of the meridian.
    ShellGrowth,
    /// M, growth of the vertical diameter, or of the largest across the blow, %.
    MeridianGrowth,
    /// E, energy imparted, J.
    Energy,
    /// Displacement of the corneal apex, mm.
    Apex,
    /// Peak force near the centre of the eye, N; at the axisymmetric eye 75 mg times acceleration.
    ForceCentre,
    /// Peak force at the node of the cornea, N.
    ForceFront,
    /// Peak force at the node of the retina, N.
    ForceRight,
    /// Peak force at the node behind 12 o'clock, N.
    ForceTop,
    /// Largest energy stored in the springs at one time, J of the model's depth.
    StoredEnergy,
    /// Peak intraocular pressure, in megapascals: the mean of the globe, low pass of 20 us.
    Pressure,
    /// Peak force of contact, N, where a projectile hits, as a mean over 100 us.
    Contact,
    /// Peak pressure at the back, at the sensor of experiments, in megapascals: mean over 150 us.
    BackPressure,
    /// Peak tension of the sclera, in megapascals, through a low pass of 20 us.
    ScleralStress,
    /// Largest loss of the eye's length along the blow, in % of it, at the axisymmetric eye.
    Shortening,
    /// How far an object's surface comes into the axisymmetric eye, mm.
    Intrusion,
    /// How far the lens moves along the blow, mm, in the axisymmetric eye.
    LensWay,
    /// Speed of an object back along its path at the end, m/s, at the axisymmetric eye.
    Rebound,
    /// Largest stretch of the wall along the meridian between 60 and 120 degrees from the front, %;
    /// this and the next four through a low pass of 20 us.
    EquatorStretch,
    /// Mean stretch of its wall along the meridian at the back, %, from 150 degrees on.
    BackStretch,
    /// Growth of its shell's radius where the retina has its front edge, %, at 62 degrees.
    EdgeGrowth,
    /// How much farther than at rest the lens's equator is from the shell at 62 degrees, mm.
    LensPull,
    /// The same of the shell at the root of the iris, at 45 degrees, mm.
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
    /// Only where no projectile hits: with one, node forces follow every wave, mesh by mesh.
    WithoutProjectile,
    /// Nowhere, but its own error is watched: what tissues feel may wander more than the motion.
    Watched,
    /// Nowhere.
    Never,
}

/// Which results share the fate of their step errors: two runs may agree on one of them by chance,
/// so none is claimed to be much better than the worst of its family.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// Motion of the whole eye.
    Motion,
    /// Forces of nodes on the shell, which come from the same waves.
    ShellForces,
    /// Its step error says nothing of any other result's.
    Alone,
    /// No error is stated of it: it is made of another result by a published curve, or looked at
    /// only where steps end, so that two runs may share what they miss.
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
    /// What rounding does to it, in the unit.
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
    pub const FORCES: [Self; 4] =
        [Self::ForceCentre, Self::ForceFront, Self::ForceRight, Self::ForceTop];
    /// What an eye that is hit is asked for first.
    pub const FELT: [Self; 3] = [Self::Contact, Self::Pressure, Self::EquatorStretch];

    /// All that is known of it, from the one table.
    pub fn row(self) -> Row {
        use Group::{Energies, Inside, Motion, Projectile, Tissues};
        match self {
            Self::Damage => Row {
                whole: Some(1e2),
                ..number("damage_percent", "damage index", "index", "").leading(Leads::Always)
            },
            Self::ShellGrowth => number("scleral_growth_percent", "wall growth S", "S", "%")
                .followed((Motion, 2), |t| &t.shell_growth),
            Self::MeridianGrowth => number("meridian_growth_percent", "width growth M", "M", "%")
                .followed((Motion, 3), |t| &t.meridian_growth),
            Self::Energy => number("energy_imparted_j", "energy imparted E", "E", "J")
                .rounding(1e-16)
                .traced("work in", "work_j", (Energies, 3), |t| &t.work),
            Self::Apex => number("apex_displacement_mm", "cornea pushed in", "pushed", "mm")
                .leading(Leads::Always)
                .traced("cornea pushed in", "apex_mm", (Motion, 1), |t| &t.apex),
            // Far smoother than those of the shell, and really better.
            Self::ForceCentre => Row {
                family: Family::Alone,
                ..node_force("peak_force_centre_n", "peak force, centre", "centre", 0, |t| {
                    &t.force[0]
                })
            },
            Self::ForceFront => {
                node_force("peak_force_front_n", "peak force, front", "front", 1, |t| &t.force[1])
            }
            Self::ForceRight => {
                node_force("peak_force_right_n", "peak force, right", "right", 2, |t| &t.force[2])
            }
            Self::ForceTop => {
                node_force("peak_force_top_n", "peak force, top", "top", 3, |t| &t.force[3])
            }
            Self::StoredEnergy => Row {
                family: Family::Unstated,
                ..number("peak_stored_energy_j", "stored energy", "stored", "J")
            }
            .rounding(1e-16)
            .traced("elastic", "elastic_j", (Energies, 1), |t| &t.elastic),
            Self::Pressure => number("peak_pressure_mpa", "peak pressure", "pressure", "MPa")
                .leading(Leads::Always)
                .traced("pressure", "pressure_mpa", (Inside, 0), |t| &t.pressure),
            Self::Contact => number("peak_contact_force_n", "contact force", "contact", "N")
                .rounding(FORCE_ROUNDING)
                .leading(Leads::Always)
                .traced("contact", "contact_force_n", (Projectile, 0), |t| &t.contact_force),
            Self::BackPressure => {
                number("peak_back_pressure_mpa", "pressure at back", "at back", "MPa")
                    .leading(Leads::Always)
                    .followed((Inside, 2), |t| &t.back_pressure)
            }
            Self::ScleralStress => {
                number("peak_scleral_stress_mpa", "scleral stress", "stress", "MPa")
                    .leading(Leads::Always)
                    .followed((Inside, 3), |t| &t.scleral_stress)
            }
            Self::Shortening => number("shortening_percent", "eye shortened by", "squashed", "%")
                .leading(Leads::Always)
                .traced("shortening", "shortening_percent", (Motion, 4), |t| &t.shortening),
            Self::Intrusion => number("intrusion_mm", "object goes in", "goes in", "mm").traced(
                "intrusion",
                "intrusion_mm",
                (Projectile, 5),
                |t| &t.intrusion,
            ),
            Self::LensWay => number("lens_displacement_mm", "lens displacement", "lens", "mm")
                .traced("lens", "lens_mm", (Motion, 5), |t| &t.lens),
            Self::Rebound => number("rebound_speed_m_s", "rebound speed", "rebound", "m/s"),
            Self::EquatorStretch => {
                number("equator_stretch_percent", "equator stretch", "stretch", "%")
                    .leading(Leads::Watched)
                    .followed((Tissues, 0), |t| &t.tissue[0])
            }
            Self::BackStretch => number("back_stretch_percent", "stretch at back", "back", "%")
                .leading(Leads::Watched)
                .followed((Tissues, 1), |t| &t.tissue[1]),
            Self::EdgeGrowth => number("edge_growth_percent", "retina edge growth", "edge", "%")
                .leading(Leads::Watched)
                .traced("retina's edge", "edge_growth_percent", (Tissues, 2), |t| &t.tissue[2]),
            Self::LensPull => number("lens_pull_mm", "pull on lens", "pull", "mm")
                .leading(Leads::Watched)
                .followed((Tissues, 3), |t| &t.tissue[3]),
            Self::IrisPull => number("iris_pull_mm", "pull on iris", "iris", "mm")
                .leading(Leads::Watched)
                .followed((Tissues, 4), |t| &t.tissue[4]),
            Self::CornealEnergy => {
                number("corneal_energy_kj_m2", "energy at cornea", "cornea", "kJ/m2")
                    .leading(Leads::Watched)
            }
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

    /// See [`Row::key`].
    pub fn key(self) -> &'static str {
        self.row().key
    }

    /// See [`Row::label`].
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

/// A force is the small difference of large ones: some 1e-10 N are left in an eye at rest.
const FORCE_ROUNDING: f64 = 3e-10;

/// Factor from SI to a unit for people.
pub(crate) const fn factor_to(unit: &str) -> f64 {
    match unit.as_bytes() {
        b"%" => 1e2,
        b"mm" => 1e3,
        b"MPa" => 1e-6,
        b"kJ/m2" => 1e-3,
        _ => 1.0,
    }
}

type Words = &'static str;
type Values = fn(&Traces) -> &[f64];

/// A result of the whole motion that does not lead, to be filled in.
const fn number(key: Words, label: Words, short: Words, unit: Words) -> Row {
    Row {
        key,
        label,
        short,
        unit,
        factor: factor_to(unit),
        rounding: 1e-12,
        leads: Leads::Never,
        family: Family::Motion,
        whole: None,
        risk: false,
        trace: None,
    }
}

impl Row {
    const fn rounding(self, rounding: f64) -> Self {
        Self { rounding, ..self }
    }

    const fn leading(self, leads: Leads) -> Self {
        Self { leads, ..self }
    }

    /// Over time it has the same name and key, but for the peak, and is looked at there.
    fn followed(self, place: (Group, u8), values: Values) -> Self {
        self.traced(self.label, self.key.trim_start_matches("peak_"), place, values)
    }

    /// Over time it is called so, written to such a column, and looked at there.
    const fn traced(self, label: Words, column: Words, place: (Group, u8), values: Values) -> Self {
        let trace = ResultTrace { label, column, values, place };
        Self { trace: Some(trace), ..self }
    }
}

/// The force of a node of the shell, by the place of its [`Monitor`](crate::run::places::Monitor).
const fn node_force(key: Words, label: Words, short: Words, place: u8, values: Values) -> Row {
    let (_, column) = key.split_at("peak_".len());
    Row {
        rounding: FORCE_ROUNDING,
        leads: Leads::WithoutProjectile,
        family: Family::ShellForces,
        ..number(key, label, short, "N")
    }
    .traced(short, column, (Group::NodeForces, place), values)
}

/// A risk, which what a tissue felt was turned into.
const fn risk(key: Words, label: Words, short: Words) -> Row {
    Row { whole: Some(1e2), family: Family::Unstated, risk: true, ..number(key, label, short, "%") }
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
