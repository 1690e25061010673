//! The museum of the chapter.

mod claims;
mod cli;
mod exhibit;
mod inventory;
