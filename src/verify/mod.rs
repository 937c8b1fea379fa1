//! Whether what is claimed holds: the program against references, and the models against experiments.

pub mod calibrate;
pub mod coverage;
pub mod experiments;
pub mod hard_cases;
pub mod mesh_coverage;
pub mod random_object;
pub mod tolerance_coverage;
pub mod validate;
