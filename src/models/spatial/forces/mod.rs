//! What acts on the nodes: cells, shell, the object and bone.

pub(crate) mod cell;
pub(crate) mod contact;
pub(crate) mod corner;
pub(crate) mod hinge;
pub(crate) mod math;
pub(crate) mod object;
pub(crate) mod plain;
pub(crate) mod rim;
pub(crate) mod rows;
pub(crate) mod shell;
pub(crate) mod state;
