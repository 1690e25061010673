//! Scene files, valid and invalid, the masses of shapes, and contact points.

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
