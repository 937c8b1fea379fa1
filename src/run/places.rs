//! The places of an eye by the names that every model and every result uses.

/// Radius of the globe, in m.
pub const GLOBE_RADIUS_M: f64 = 12e-3;
/// Radius of the bony orbit, in m.
pub const ORBIT_RADIUS_M: f64 = 20e-3;

/// One of the four nodes whose force is followed (paper, "Static plots").
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, strum::IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
pub enum Monitor {
    /// 1.33 mm from the centre of the eye, 45 degrees up and back.
    Centre,
    /// On the cornea, 5 degrees above the anterior pole.
    Front,
    /// On the retina, 5 degrees above the posterior pole.
    Right,
    /// On the shell, 5 degrees behind 12 o'clock.
    Top,
}

impl Monitor {
    /// All four, in the paper's order.
    pub const ALL: [Self; 4] = [Self::Centre, Self::Front, Self::Right, Self::Top];

    /// Lower-case name, as used in reports.
    pub fn name(self) -> &'static str {
        self.into()
    }
}

/// Which part of the section a node belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, strum::IntoStaticStr)]
#[strum(serialize_all = "snake_case")]
pub enum Region {
    /// Inside the shell, lens apart: vitreous and aqueous.
    Interior,
    /// Inside the lens, whose springs may have a modulus of their own.
    Lens,
    /// Corneoscleral shell outside the retina's span.
    Shell,
    /// Shell with retina behind it.
    Retina,
    /// Orbital fat.
    Fat,
    /// Bone, rigid.
    Orbit,
}

impl Region {
    /// Whether the node is part of the globe, shell included.
    pub fn in_globe(self) -> bool {
        !matches!(self, Self::Fat | Self::Orbit)
    }

    /// Whether the node lies on the shell.
    pub fn on_shell(self) -> bool {
        matches!(self, Self::Shell | Self::Retina)
    }

    /// Lower-case name, as used in exports.
    pub fn name(self) -> &'static str {
        self.into()
    }
}
