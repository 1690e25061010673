//! Scene files, good and broken, and where bodies touch.

mod bad_files;
mod catalogue;
mod contacts;
mod generate;
