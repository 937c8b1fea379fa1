//! A step of a value, of a cursor or of time.

/// A step up or down, small or large.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Step {
    /// Up, not down.
    pub up: bool,
    /// A large step.
    pub coarse: bool,
}

impl Step {
    /// A small step down.
    pub const LESS: Self = Self::new(false, false);
    /// A small step up.
    pub const MORE: Self = Self::new(true, false);
    /// A large step down.
    pub const MUCH_LESS: Self = Self::new(false, true);
    /// A large step up.
    pub const MUCH_MORE: Self = Self::new(true, true);

    const fn new(up: bool, coarse: bool) -> Self {
        Self { up, coarse }
    }

    /// A step of this size in the other direction.
    #[must_use]
    pub fn reversed(self) -> Self {
        Self::new(!self.up, self.coarse)
    }
}
