//! What changes the model, whichever screen is on show.

pub(crate) mod edit;
pub(crate) mod presets;
pub(crate) mod samples;
pub(crate) mod simulation;
pub(crate) mod take_away;
pub(crate) mod threshold;
pub(crate) mod typing;
