//! Results for people and for programs. It only prints what it is given.

pub mod accuracy;
pub mod command;
pub mod compare;
pub mod coverage;
pub mod ensemble;
pub mod errors;
pub mod figure;
pub mod injury;
pub mod json;
pub mod limit;
pub mod pace;
pub mod page;
pub mod stability;
pub mod summary;
pub mod sweep;
pub mod text;
pub mod threshold;
pub mod tolerance;
pub mod validate;
pub mod verdict;
