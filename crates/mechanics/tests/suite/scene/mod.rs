//! Scene files, good and broken, what shapes weigh, and where bodies touch.

mod bad_files;
mod catalogue;
mod compounds;
mod contacts;
mod documentation;
mod generate;
mod hulls;
mod settings;
mod start;
mod written_out;
