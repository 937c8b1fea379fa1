pub mod eye;
pub mod scenario;
