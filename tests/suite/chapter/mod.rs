//! The museum of the chapter.

mod exhibit;
