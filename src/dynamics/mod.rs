//! Motion: m a = springs + drag + load, solved by one of several integrators.
//!
//! `system` compiles an eye and a load into rows, `kernel` computes forces, `integrator` composes
//! kicks and drifts, `stability` bounds the step, `march` goes through the window. `plain` is the
//! same physics as a simple loop over an edge list: the tested reference of the kernel and the
//! baseline of the benchmarks.
//!
//! The orbit is rigid and never integrated. Left out, as in the paper: pressure, contact, rupture.

mod aligned;
mod integrator;
mod kernel;
mod lanes;
mod load;
mod march;
pub mod plain;
mod ring;
mod runge_kutta;
pub mod stability;
mod state;
mod sweep;
mod system;

pub use integrator::Integrator;
pub use kernel::{Survey, name as kernel_name, vector_sets, vectors_name};
pub use load::{ArcLoad, Piece, Pulse, Segment};
pub use march::{Cost, Diverged, LOCAL_TOLERANCE, Observer, Plan, march};
pub use state::State;
pub use system::{Place, System};
