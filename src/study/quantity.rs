//! The results that errors are stated for, as one list.

use crate::eye::Monitor;
use crate::injury::DamageIndex;
use crate::recording::Extremes;

/// One scalar result.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Quantity {
    /// The damage index, %.
    Damage,
    /// Corneal apex displacement, mm.
    Apex,
    /// Peak force at a monitored node, N.
    Force(Monitor),
    /// S, %.
    ShellGrowth,
    /// M, %.
    MeridianGrowth,
    /// E, J.
    Energy,
    /// Peak intraocular pressure, in megapascals; 0 without a fluid.
    Pressure,
    /// Peak force of contact, mean over 100 us, N; 0 without a projectile.
    Contact,
}

impl Quantity {
    /// All of them; the first [`Self::HEADLINE`] are those that the stated error covers.
    pub const ALL: [Self; 11] = [
        Self::Damage,
        Self::Apex,
        Self::Force(Monitor::Centre),
        Self::Force(Monitor::Front),
        Self::Force(Monitor::Right),
        Self::Force(Monitor::Top),
        Self::ShellGrowth,
        Self::MeridianGrowth,
        Self::Energy,
        Self::Pressure,
        Self::Contact,
    ];

    /// How many of [`Self::ALL`] every scene has.
    pub const COMMON: usize = 9;

    /// How many lead: damage, apex displacement and the four peak forces.
    /// Pressure and force of contact lead too, where they exist.
    pub const HEADLINE: usize = 6;

    /// Name with its unit, as used in JSON.
    pub fn key(self) -> &'static str {
        match self {
            Self::Damage => "damage_percent",
            Self::Apex => "apex_displacement_mm",
            Self::Force(Monitor::Centre) => "peak_force_centre_n",
            Self::Force(Monitor::Front) => "peak_force_front_n",
            Self::Force(Monitor::Right) => "peak_force_right_n",
            Self::Force(Monitor::Top) => "peak_force_top_n",
            Self::ShellGrowth => "scleral_growth_percent",
            Self::MeridianGrowth => "meridian_growth_percent",
            Self::Energy => "energy_imparted_j",
            Self::Pressure => "peak_pressure_mpa",
            Self::Contact => "peak_contact_force_n",
        }
    }

    /// Name for people.
    pub fn label(self) -> &'static str {
        match self {
            Self::Damage => "damage index",
            Self::Apex => "apex displacement",
            Self::Force(Monitor::Centre) => "peak force, centre",
            Self::Force(Monitor::Front) => "peak force, front",
            Self::Force(Monitor::Right) => "peak force, right",
            Self::Force(Monitor::Top) => "peak force, top",
            Self::ShellGrowth => "shell growth",
            Self::MeridianGrowth => "meridian growth",
            Self::Energy => "energy imparted",
            Self::Pressure => "peak pressure",
            Self::Contact => "peak contact force",
        }
    }

    /// What rounding does to it, in the unit of [`Self::key`]: a force is the small difference of large
    /// ones, which leaves some 1e-10 N in an eye at rest.
    pub fn rounding(self) -> f64 {
        match self {
            Self::Force(_) | Self::Contact => 3e-10,
            Self::Energy => 1e-16,
            _ => 1e-12,
        }
    }

    /// The value that a march left, in the unit of [`Self::key`].
    pub fn of(self, extremes: &Extremes) -> f64 {
        let index = DamageIndex::of(extremes);
        match self {
            Self::Damage => index.damage(),
            Self::Apex => extremes.apex.value * 1e3,
            Self::Force(monitor) => extremes.force[monitor as usize].value,
            Self::ShellGrowth => index.shell_growth,
            Self::MeridianGrowth => index.meridian_growth,
            Self::Energy => index.energy,
            Self::Pressure => extremes.fluid.map_or(0.0, |f| f.pressure.value * 1e-6),
            Self::Contact => extremes.shot.map_or(0.0, |s| s.force.value),
        }
    }
}

/// One number for each of [`Quantity::ALL`].
pub type PerQuantity = [f64; Quantity::ALL.len()];

/// All results of a march.
pub fn values(extremes: &Extremes) -> PerQuantity {
    Quantity::ALL.map(|q| q.of(extremes))
}

/// |a - b| in % of b for each result; 0 where both are nothing but rounding.
pub fn difference_percent(a: &PerQuantity, b: &PerQuantity) -> PerQuantity {
    std::array::from_fn(|i| {
        let (difference, rounding) = ((a[i] - b[i]).abs(), Quantity::ALL[i].rounding());
        if difference == 0.0 || b[i] == 0.0 && difference < rounding {
            0.0
        } else {
            100.0 * difference / b[i].abs()
        }
    })
}

/// The largest of the leading results' numbers: damage, apex displacement and the four node forces,
/// and peak pressure and force of contact where they exist.
///
/// A projectile, known by its force of contact, makes the node forces those of lumps that are hit:
/// they do not lead then.
pub fn headline(errors: &PerQuantity) -> f64 {
    let shot = errors[CONTACT] != 0.0;
    let leads = |q: Quantity| !(shot && matches!(q, Quantity::Force(_)));
    let common = Quantity::ALL[..Quantity::HEADLINE].iter().zip(errors);
    common
        .filter(|(q, _)| leads(**q))
        .map(|(_, error)| *error)
        .chain(errors[Quantity::COMMON..].iter().copied())
        .fold(0.0, f64::max)
}

/// Where the force of contact stands.
const CONTACT: usize = 10;
const _: () = assert!(matches!(Quantity::ALL[CONTACT], Quantity::Contact));
