//! The museum of the chapter.

mod code;
mod exhibit;
mod step;
