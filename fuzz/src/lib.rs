//! What the fuzz targets do, one function each. A broken promise is a panic.

mod contact;
mod diagnose;
mod files;
mod judge;
mod pages;
mod problem;
mod scene;
mod simulator;
mod solvers;

pub use diagnose::diagnose;
pub use files::read;
pub use judge::judge;
pub use pages::{read_grid, read_markup, read_report, read_results};
pub use scene::read_scene;
pub use simulator::simulator;
pub use solvers::solvers;
