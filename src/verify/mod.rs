//! Whether what is claimed holds: the program against references, models against experiments.

pub mod claims;
pub mod clinics;
pub mod experiments;
pub mod fit;
pub mod hard_cases;
pub mod measured_orbit;
pub mod rerun;
pub mod scenes;
pub mod tissue_fit;
