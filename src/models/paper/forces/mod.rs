//! What acts on the nodes: the eye compiled into rows, the pulse, and the kernel.

pub mod aligned;
pub mod filaments;
pub mod kernel;
pub mod lanes;
pub mod layout;
pub mod load;
pub mod plain;
pub mod ring;
pub mod state;
pub mod sweep;
pub mod system;
