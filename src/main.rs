//! The command line; its code is in the library, where the Python package also uses it.

#[cfg(feature = "mimalloc")]
#[global_allocator]
static ALLOCATOR: mimalloc::MiMalloc = mimalloc::MiMalloc;

fn main() -> std::process::ExitCode {
    lcplab::cli::run(std::env::args_os()).into()
}
