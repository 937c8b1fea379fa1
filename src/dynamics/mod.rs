//! Motion: m a = springs + drag + load, solved by one of several integrators.
//!
//! `system` compiles an eye and a load into rows, `kernel` computes forces, `integrator` composes
//! kicks and drifts, `stability` bounds the step, `march` goes through the window. `plain` is the
//! same physics as a simple loop over an edge list: the tested reference of the kernel and the
//! baseline of the benchmarks.
//!
//! A scene with a projectile, a fluid or dashpots has them in `coupled` (`contact`, `fluid`,
//! `dashpots`) and is moved by `verlet`; any other does none of their work.
//!
//! The orbit is rigid and never integrated. Left out, as in the paper: rupture.

mod aligned;
mod composition;
mod contact;
mod coupled;
mod dashpots;
mod fluid;
mod kernel;
mod lanes;
mod load;
mod march;
mod method;
mod object_spring;
pub mod plain;
pub mod revolution;
mod ring;
mod runge_kutta;
mod scene;
pub mod stability;
mod state;
mod stepper;
mod sweep;
mod system;
mod verlet;

pub use crate::scenario::Integrator;
pub use contact::{Body, Contact};
pub use coupled::{Coupled, Readings};
pub use fluid::{Fluid, PA_PER_MMHG, area};
pub use kernel::{Survey, name as kernel_name, vector_sets, vectors_name};
pub use load::{ArcLoad, Piece, Pulse, Segment};
pub use march::{Cost, Diverged, LOCAL_TOLERANCE, Observer, Plan, march};
pub use method::{Drag, Method};
pub use scene::SceneKind;
pub use state::State;
pub use system::{Place, System};
