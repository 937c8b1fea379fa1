//! A step of a value, of a cursor or of time: up or down, small or large.

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    /// Up, not down.
    pub up: bool,
    /// A large step.
    pub coarse: bool,
}

impl Step {
    pub const LESS: Self = Self { up: false, coarse: false };
    pub const MORE: Self = Self { up: true, coarse: false };
    pub const MUCH_LESS: Self = Self { up: false, coarse: true };
    pub const MUCH_MORE: Self = Self { up: true, coarse: true };

    /// A step of this size in the other direction.
    #[must_use]
    pub fn reversed(self) -> Self {
        Self { up: !self.up, ..self }
    }
}
