//! Motion of the body of revolution: explicit, Lagrangian, as hydrocodes are.
//!
//! `cell` is the mechanics of one cell, `quads` the same of many (`rows` lays them out, `nodes` moves what is between
//! them), `plain` the loop that tests them; `shell` is cornea and sclera, `object` and `contact` what hits them, `face` the
//! bone beside them; `run` is the leapfrog through the window, `record`, `frames` and `sensor` read off what `results` keeps.

mod cell;
mod contact;
mod face;
mod frames;
mod nodes;
mod object;
mod plain;
mod quads;
mod record;
mod results;
mod rows;
mod run;
mod sensor;
mod shell;
mod state;
#[cfg(test)]
mod tests;

pub use object::{BallSpring, HARD, Object, Outline, Surface};
pub use results::{Energy, Extremes, Run};
pub use run::{Blow, Form, Refusal, STEP_SHARE, Steps, run, run_as, run_through, step_limit};
pub use sensor::monitored;
