pub mod dynamics;
pub mod eye;
pub mod recording;
pub mod scenario;
