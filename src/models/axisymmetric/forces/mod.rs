//! What acts on the nodes: cells, shell, the object and bone.

pub mod cell;
pub mod contact;
pub mod face;
pub mod object;
pub(crate) mod object_spring;
pub mod plain;
pub mod quads;
pub mod rows;
pub mod shell;
pub mod state;
