//! Motion of the body of revolution: explicit, Lagrangian, as hydrocodes are.
//!
//! `cell` is the mechanics of one cell, `shell` that of cornea and sclera, `object` and `contact` what
//! hits them, `run` the leapfrog through the window.

mod cell;
mod contact;
mod object;
mod plain;
mod quads;
mod results;
mod rows;
mod run;
mod sensor;
mod shell;
mod state;
#[cfg(test)]
mod tests;

pub use object::{BallSpring, HARD, Object, Outline, Surface};
pub use results::{Energy, Extremes, Frame, Keep, Peak, Run, Traces};
pub use run::{Blow, Form, Refusal, STEP_SHARE, run, run_as};
