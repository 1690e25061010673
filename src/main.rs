//! The command line: parse, call the library, print, exit.

mod cli;

/// The lessons' cells, compiled; they are written to be read one by one.
#[allow(non_snake_case, clippy::type_complexity, clippy::useless_vec)]
mod lessons {
    include!(concat!(env!("OUT_DIR"), "/lessons.rs"));
}

/// The handout's cells, compiled.
#[allow(non_snake_case, clippy::type_complexity, clippy::useless_vec)]
mod handout {
    include!(concat!(env!("OUT_DIR"), "/handout.rs"));
}

/// The students' answers; a hole leaves its arguments unused.
#[path = "../notebooks/exercises/mod.rs"]
#[allow(non_snake_case, unused_variables, unused_mut)]
mod exercises;

fn main() -> std::process::ExitCode {
    cli::run()
}
