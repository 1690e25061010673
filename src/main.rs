//! The command line; all of it is in the library, where the Python package finds it too.

fn main() -> std::process::ExitCode {
    lcplab::cli::run(std::env::args_os()).into()
}
