//! Results for people and for programs. It only prints what it is given.

pub mod accuracy;
pub mod claims;
pub mod command;
pub mod compare;
pub mod ensemble;
pub mod errors;
pub mod experiments;
pub mod figure;
pub mod first_page;
pub mod format;
pub mod hard_cases;
pub mod json;
pub mod limit;
pub mod pace;
pub mod page;
pub mod picture;
pub mod risks;
pub mod summary;
pub mod sweep;
pub mod text;
pub mod threshold;
pub mod tissue_fit;
