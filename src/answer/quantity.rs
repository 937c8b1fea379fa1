//! The table of results: one row for each, from which everything that lists results is made.
//!
//! Text, JSON, CSV, the comparison, the keys to the next peak, ensembles, sweeps and the reports of
//! errors iterate [`Quantity::ALL`] and ask the [`Row`]. A new result is a variant and its row here,
//! beside the place in `recording` that measures it: the compiler asks for the row.
//!
//! A result that a scene does not have reads as `None`: the pressure where there are no cells, the
//! force of contact where there is no projectile.

use crate::answer::believed::{Scene, is_spoiled};
use crate::answer::course::{Group, Trace, trace};
use crate::injury::{Curve, DamageIndex, Injury, Measure, Measures, curve_of};
use crate::models::axisymmetric as revolution;
use crate::models::left::Left;
use crate::models::paper::eye::landmarks::Monitor;
use crate::models::paper::recording::Extremes;
use crate::run::kept::Peak;
use strum::{EnumCount, VariantArray};

/// One scalar result, in the order of every table.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, EnumCount, VariantArray)]
pub enum Quantity {
    /// The damage index of the paper, %.
    Damage,
    /// S, growth of the shell's length, %.
    ShellGrowth,
    /// M, growth of the vertical diameter, %.
    MeridianGrowth,
    /// E, energy imparted, J.
    Energy,
    /// Displacement of the corneal apex, mm.
    Apex,
    /// Peak force at the node near the centre of the eye, N.
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
    /// Peak intraocular pressure, in megapascals, at the eye of revolution: the mean of the globe through a low pass of 20 us.
    Pressure,
    /// Peak force of contact, N, where a projectile hits, as a mean over 100 us.
    Contact,
    /// Peak pressure at the back of the eye of revolution, where a sensor sits in experiments, in megapascals: a
    /// mean over 150 us.
    BackPressure,
    /// Peak tension of the sclera of the eye of revolution, in megapascals, through a low pass of 20 us.
    ScleralStress,
    /// Largest loss of the eye's length along the blow, in % of it, at the eye of revolution.
    Shortening,
    /// Way of an object's surface into the eye of revolution, mm.
    Intrusion,
    /// Way of the lens along the blow, mm, in the eye of revolution.
    LensWay,
    /// Speed of an object back along its path at the end, m/s, at the eye of revolution.
    Rebound,
    /// Risk of rupture of the globe by peak pressure, %.
    RuptureByPressure,
    /// Risk of rupture of the globe by the stress of the sclera of the eye of revolution, %.
    RuptureByStress,
    /// Risk of rupture of the globe by normalized energy, %.
    RuptureByEnergy,
    /// Risk of damage of the retina by normalized energy, %.
    RetinaByEnergy,
    /// Risk of rupture of the globe by the curve that is believed first, %.
    GlobeRupture,
    /// That of damage of the retina.
    RetinalDamage,
    /// That of the lens torn off.
    LensDislocation,
    /// That of blood in the anterior chamber.
    Hyphema,
    /// That of the loss of the cornea's outermost layer.
    CornealAbrasion,
}

/// In which scenes a result belongs to those that the one stated error covers.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Leads {
    /// Wherever the scene has it.
    Always,
    /// Not where a projectile hits: it makes the node forces those of lumps that are hit.
    WithoutProjectile,
    /// Nowhere.
    Never,
}

/// Which results share the fate of their step errors: two runs may agree on one of them by chance,
/// so none is claimed to be much better than the worst of its family.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Family {
    /// Of the motion of the whole eye; its members hang together where a projectile acts.
    Motion,
    /// Forces of nodes on the shell, which come from the same waves.
    ShellForces,
    /// Stands for itself.
    Alone,
    /// No error is stated of it: a published curve turned another result, or the input, into it, or
    /// it is looked at at step ends only, so that two runs may share what they miss.
    Unstated,
}

/// How a result behaves as the mesh gets finer; see [`crate::answer::mesh_error`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeshScatter {
    /// By this share of it level 3 may lie off the limit though its neighbours agree; finer ones by less.
    pub share: f64,
    /// The order by which that falls.
    pub order: i32,
    /// Or by so much, in its unit, where it is small.
    pub least: f64,
    /// Two levels that differ by a larger share than this tell no limit.
    pub apart: f64,
}

/// How a result is read from what a march left.
#[derive(Clone, Copy)]
pub enum Read {
    /// The largest value of something over time, SI.
    Peak(fn(&Extremes) -> Option<Peak>),
    /// A number without a time, SI; the damage index in its own %.
    Number(fn(&Extremes) -> Option<f64>),
    /// The risk, from 0 to 1, by the first published curve of this injury against this measure.
    Risk(Injury, Measure),
    /// The risk, from 0 to 1, of this injury by the curve that is believed first.
    Believed(Injury),
}

/// How a result is read from a run of the eye of revolution, SI; the risks are read as anywhere.
#[derive(Clone, Copy)]
pub enum ReadRevolution {
    /// That eye has no such result.
    Nowhere,
    /// The largest value of something over time.
    Peak(fn(&revolution::Extremes) -> Option<Peak>),
    /// A number without a time.
    Number(fn(&revolution::Extremes) -> Option<f64>),
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
    /// From what is read to the unit.
    pub factor: f64,
    /// What rounding does to it, in the unit: a force is the small difference of large ones, which
    /// leaves some 1e-10 N in an eye at rest.
    pub rounding: f64,
    /// Where it leads.
    pub leads: Leads,
    /// What its step error hangs together with.
    pub family: Family,
    /// How far a finer mesh of a section may be trusted with it.
    pub scatter: MeshScatter,
    /// And one of the eye of revolution.
    pub scatter_of_revolution: MeshScatter,
    /// The whole of its scale on a map, in the unit; without one the largest value there.
    pub whole: Option<f64>,
    /// How it is read.
    pub read: Read,
    /// How it is read at the eye of revolution.
    pub revolution: ReadRevolution,
    /// Its course over time, if it is recorded.
    pub trace: Option<Trace>,
}

impl Quantity {
    /// All of them.
    pub const ALL: &[Self] = Self::VARIANTS;

    /// All that is known of it, from the one table.
    #[expect(clippy::too_many_lines, reason = "the table: one arm for each result")]
    pub fn row(self) -> Row {
        match self {
            Self::Damage => Row {
                leads: Leads::Always,
                whole: Some(1e2),
                scatter: smooth(0.055, 0.3),
                read: Read::Number(|e| Some(DamageIndex::of(e).damage())),
                revolution: ReadRevolution::Number(|e| {
                    Some(DamageIndex::of_revolution(e).damage())
                }),
                ..number("damage_percent", "damage index", "index", "")
            },
            Self::ShellGrowth => Row {
                factor: 1e2,
                scatter: SHELL_SCATTER,
                scatter_of_revolution: within(0.09, 0.3),
                read: Read::Peak(|e| Some(e.shell_growth)),
                revolution: ReadRevolution::Peak(|e| Some(e.meridian_growth)),
                trace: Some(trace(
                    "shell growth S",
                    "scleral_growth_percent",
                    |t| &t.shell_growth,
                    (Group::Motion, 2),
                )),
                ..number("scleral_growth_percent", "S shell growth", "S", "%")
            },
            Self::MeridianGrowth => Row {
                factor: 1e2,
                scatter: smooth(0.055, 0.3),
                read: Read::Peak(|e| Some(e.meridian_growth)),
                revolution: ReadRevolution::Peak(|e| Some(e.equator_growth)),
                trace: Some(trace(
                    "meridian growth M",
                    "meridian_growth_percent",
                    |t| &t.meridian_growth,
                    (Group::Motion, 3),
                )),
                ..number("meridian_growth_percent", "M meridian growth", "M", "%")
            },
            Self::Energy => Row {
                rounding: 1e-16,
                scatter: within(0.08, 0.3),
                read: Read::Number(|e| Some(e.work)),
                revolution: ReadRevolution::Number(|e| Some(e.energy_imparted)),
                trace: Some(trace(
                    "work in",
                    "work_j",
                    |t| &t.work,
                    (Group::Energies, 3),
                )),
                ..number("energy_imparted_j", "E energy imparted", "E", "J")
            },
            Self::Apex => Row {
                factor: 1e3,
                leads: Leads::Always,
                read: Read::Peak(|e| Some(e.apex)),
                revolution: ReadRevolution::Peak(|e| Some(e.apex)),
                trace: Some(trace("apex", "apex_mm", |t| &t.apex, (Group::Motion, 1))),
                ..number("apex_displacement_mm", "corneal apex", "apex", "mm")
            },
            Self::ForceCentre => Row {
                // Far smoother than those of the shell, and really better.
                family: Family::Alone,
                scatter: within(0.1, 0.3),
                read: Read::Peak(|e| Some(e.force[Monitor::Centre as usize])),
                revolution: ReadRevolution::Peak(|e| Some(e.node_force[Monitor::Centre as usize])),
                trace: Some(Trace {
                    spark: true,
                    ..trace(
                        "centre",
                        "force_centre_n",
                        |t| &t.force[Monitor::Centre as usize],
                        (Group::NodeForces, 0),
                    )
                }),
                ..node_force("peak_force_centre_n", "peak force, centre", "centre")
            },
            Self::ForceFront => Row {
                scatter: within(0.25, 0.3),
                read: Read::Peak(|e| Some(e.force[Monitor::Front as usize])),
                revolution: ReadRevolution::Peak(|e| Some(e.node_force[Monitor::Front as usize])),
                trace: Some(Trace {
                    spark: true,
                    ..trace(
                        "front",
                        "force_front_n",
                        |t| &t.force[Monitor::Front as usize],
                        (Group::NodeForces, 1),
                    )
                }),
                ..node_force("peak_force_front_n", "peak force, front", "front")
            },
            Self::ForceRight => Row {
                scatter: within(0.7, 0.12),
                read: Read::Peak(|e| Some(e.force[Monitor::Right as usize])),
                revolution: ReadRevolution::Peak(|e| Some(e.node_force[Monitor::Right as usize])),
                trace: Some(Trace {
                    spark: true,
                    ..trace(
                        "right",
                        "force_right_n",
                        |t| &t.force[Monitor::Right as usize],
                        (Group::NodeForces, 2),
                    )
                }),
                ..node_force("peak_force_right_n", "peak force, right", "right")
            },
            Self::ForceTop => Row {
                scatter: within(0.3, 0.12),
                read: Read::Peak(|e| Some(e.force[Monitor::Top as usize])),
                revolution: ReadRevolution::Peak(|e| Some(e.node_force[Monitor::Top as usize])),
                trace: Some(Trace {
                    spark: true,
                    ..trace(
                        "top",
                        "force_top_n",
                        |t| &t.force[Monitor::Top as usize],
                        (Group::NodeForces, 3),
                    )
                }),
                ..node_force("peak_force_top_n", "peak force, top", "top")
            },
            Self::StoredEnergy => Row {
                rounding: 1e-16,
                family: Family::Unstated,
                read: Read::Peak(|e| Some(e.elastic)),
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
                scatter: within(0.1, 0.3),
                revolution: ReadRevolution::Peak(|e| Some(e.pressure)),
                trace: Some(Trace {
                    spark: true,
                    ..trace(
                        "pressure",
                        "pressure_mpa",
                        |t| &t.pressure,
                        (Group::Inside, 0),
                    )
                }),
                ..number("peak_pressure_mpa", "peak pressure", "pressure", "MPa")
            },
            Self::Contact => Row {
                rounding: FORCE_ROUNDING,
                leads: Leads::Always,
                scatter: within(0.1, 0.3),
                revolution: ReadRevolution::Peak(|e| e.rebound.map(|_| e.mean_force)),
                trace: Some(Trace {
                    spark: true,
                    ..trace(
                        "contact",
                        "contact_force_n",
                        |t| &t.contact_force,
                        (Group::Projectile, 0),
                    )
                }),
                ..number("peak_contact_force_n", "contact force", "contact", "N")
            },
            Self::BackPressure => Row {
                factor: 1e-6,
                leads: Leads::Always,
                revolution: ReadRevolution::Peak(|e| Some(e.mean_back_pressure)),
                trace: Some(trace(
                    "pressure at back",
                    "back_pressure_mpa",
                    |t| &t.back_pressure,
                    (Group::Inside, 2),
                )),
                ..number(
                    "peak_back_pressure_mpa",
                    "pressure at back",
                    "p back",
                    "MPa",
                )
            },
            Self::ScleralStress => Row {
                factor: 1e-6,
                leads: Leads::Always,
                revolution: ReadRevolution::Peak(|e| Some(e.scleral_stress)),
                trace: Some(trace(
                    "scleral stress",
                    "scleral_stress_mpa",
                    |t| &t.scleral_stress,
                    (Group::Inside, 3),
                )),
                scatter_of_revolution: within(0.08, 0.3),
                ..number("peak_scleral_stress_mpa", "scleral stress", "stress", "MPa")
            },
            Self::Shortening => Row {
                factor: 1e2,
                leads: Leads::Always,
                revolution: ReadRevolution::Peak(|e| Some(e.shortening)),
                trace: Some(trace(
                    "shortening",
                    "shortening_percent",
                    |t| &t.shortening,
                    (Group::Motion, 4),
                )),
                ..number("shortening_percent", "shortening", "shorter", "%")
            },
            Self::Intrusion => Row {
                factor: 1e3,
                revolution: ReadRevolution::Peak(|e| e.rebound.map(|_| e.intrusion)),
                trace: Some(trace(
                    "intrusion",
                    "intrusion_mm",
                    |t| &t.intrusion,
                    (Group::Projectile, 5),
                )),
                ..number("intrusion_mm", "object intrusion", "intrude", "mm")
            },
            Self::LensWay => Row {
                factor: 1e3,
                revolution: ReadRevolution::Peak(|e| Some(e.lens)),
                trace: Some(trace("lens", "lens_mm", |t| &t.lens, (Group::Motion, 5))),
                ..number("lens_displacement_mm", "lens displacement", "lens", "mm")
            },
            Self::Rebound => Row {
                revolution: ReadRevolution::Number(|e| e.rebound),
                ..number("rebound_speed_m_s", "rebound speed", "rebound", "m/s")
            },
            Self::RuptureByPressure => Row {
                read: Read::Risk(Injury::GlobeRupture, Measure::Pressure),
                ..risk("rupture_by_pressure_percent", "rupture, pressure", "p rupt")
            },
            Self::RuptureByStress => Row {
                read: Read::Risk(Injury::GlobeRupture, Measure::Stress),
                ..risk("rupture_by_stress_percent", "rupture, stress", "s rupt")
            },
            Self::RuptureByEnergy => Row {
                read: Read::Risk(Injury::GlobeRupture, Measure::NormalizedEnergy),
                ..risk("rupture_by_energy_percent", "rupture, energy", "E rupt")
            },
            Self::RetinaByEnergy => Row {
                read: Read::Risk(Injury::RetinalDamage, Measure::NormalizedEnergy),
                ..risk(
                    "retinal_damage_by_energy_percent",
                    "retina, energy",
                    "E retina",
                )
            },
            Self::GlobeRupture => {
                believed(Injury::GlobeRupture, "globe_rupture_percent", "rupture")
            }
            Self::RetinalDamage => {
                believed(Injury::RetinalDamage, "retinal_damage_percent", "retina")
            }
            Self::LensDislocation => believed(
                Injury::LensDislocation,
                "lens_dislocation_percent",
                "lens off",
            ),
            Self::Hyphema => believed(Injury::Hyphema, "hyphema_percent", "hyphema"),
            Self::CornealAbrasion => believed(
                Injury::CornealAbrasion,
                "corneal_abrasion_percent",
                "abrasion",
            ),
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

    /// The value that a run of a scene left, in its unit.
    pub fn of(self, left: &Left, scene: &Scene) -> Option<f64> {
        let row = self.row();
        let measures = || scene.measures(left.pressure(), left.stress());
        let unless_missed = |risk: f64| if left.missed() { 0.0 } else { risk };
        let value = match (row.read, left) {
            (Read::Risk(injury, measure), _) => {
                unless_missed(risk_of(injury, measure, &measures())?)
            }
            (Read::Believed(injury), _) => {
                unless_missed(scene.believed(injury, &measures(), is_spoiled(left))?.risk)
            }
            (_, Left::Section(extremes)) => match row.read {
                Read::Number(number) => number(extremes)?,
                Read::Peak(_) | Read::Risk(..) | Read::Believed(_) => self.peak(left)?.value,
            },
            (_, Left::Revolution(extremes)) => match row.revolution {
                ReadRevolution::Number(number) => number(extremes)?,
                ReadRevolution::Peak(_) | ReadRevolution::Nowhere => self.peak(left)?.value,
            },
        };
        Some(value * row.factor)
    }

    /// Whether it is a risk.
    pub fn is_risk(self) -> bool {
        matches!(self.row().read, Read::Risk(..) | Read::Believed(_))
    }

    /// Whether a value, in its unit, is no more than what rounding does.
    pub(crate) fn is_rounding(self, value: f64) -> bool {
        value.abs() < self.row().rounding
    }

    /// The peak that it is, SI, with its time; none where it is a number without one.
    pub fn peak(self, left: &Left) -> Option<Peak> {
        let row = self.row();
        match left {
            Left::Section(extremes) => match row.read {
                Read::Peak(peak) => peak(extremes),
                Read::Number(_) | Read::Risk(..) | Read::Believed(_) => None,
            },
            Left::Revolution(extremes) => match row.revolution {
                ReadRevolution::Peak(peak) => peak(extremes),
                ReadRevolution::Number(_) | ReadRevolution::Nowhere => None,
            },
        }
    }

    /// The curve that a risk is read from; none of what is no risk.
    pub(crate) fn curve(
        self,
        scene: &Scene,
        measures: &Measures,
        spoiled: bool,
    ) -> Option<&'static Curve> {
        match self.row().read {
            Read::Risk(injury, measure) => curve_of(injury, measure),
            Read::Believed(injury) => Some(scene.believed(injury, measures, spoiled)?.curve),
            Read::Peak(_) | Read::Number(_) => None,
        }
    }
}

/// The risk of `injury`, from 0 to 1, by the first curve against `measure`.
fn risk_of(injury: Injury, measure: Measure, measures: &Measures) -> Option<f64> {
    let value = measures.get(measure)?.value;
    Some(curve_of(injury, measure)?.risk(value))
}

const FORCE_ROUNDING: f64 = 3e-10;

/// Finer shells crumple where level 1 stretches: hardly any growth is left, which only its size bounds.
const SHELL_SCATTER: MeshScatter = MeshScatter {
    least: 1e-3,
    ..within(0.5, 0.5)
};

const fn within(share: f64, apart: f64) -> MeshScatter {
    MeshScatter {
        order: 1,
        share,
        least: 0.0,
        apart,
    }
}

/// Of a result whose scatter falls with the second order.
const fn smooth(share: f64, apart: f64) -> MeshScatter {
    MeshScatter {
        order: 2,
        ..within(share, apart)
    }
}

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
        scatter: within(0.04, 0.3),
        scatter_of_revolution: within(0.04, 0.3),
        whole: None,
        read: Read::Number(|_| None),
        revolution: ReadRevolution::Nowhere,
        trace: None,
    }
}

/// The force of a node of the shell.
const fn node_force(key: &'static str, label: &'static str, short: &'static str) -> Row {
    Row {
        rounding: FORCE_ROUNDING,
        leads: Leads::WithoutProjectile,
        family: Family::ShellForces,
        // Accelerations over 20 us follow each wave, and each mesh has its own.
        scatter_of_revolution: within(0.25, 0.3),
        ..number(key, label, short, "N")
    }
}

/// A risk by a published curve.
const fn risk(key: &'static str, label: &'static str, short: &'static str) -> Row {
    Row {
        factor: 1e2,
        whole: Some(1e2),
        family: Family::Unstated,
        ..number(key, label, short, "%")
    }
}

/// The risk of an injury by the curve that is believed first.
const fn believed(injury: Injury, key: &'static str, short: &'static str) -> Row {
    Row {
        read: Read::Believed(injury),
        ..risk(key, injury.name(), short)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_differ_and_fit_their_columns_and_every_row_can_be_read() {
        for (i, quantity) in Quantity::ALL.iter().enumerate() {
            let row = quantity.row();
            assert_eq!(*quantity as usize, i);
            assert!(row.label.len() <= 18 && row.short.len() <= 8, "{}", row.key);
            for other in &Quantity::ALL[..i] {
                let other = other.row();
                assert!(row.key != other.key && row.label != other.label);
                assert!(row.short != other.short);
            }
            if let Read::Risk(injury, measure) = row.read {
                assert!(curve_of(injury, measure).is_some(), "{}", row.key);
                assert_eq!(row.family, Family::Unstated);
            }
        }
    }
}
