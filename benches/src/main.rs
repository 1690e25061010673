//! Measures how fast lcplab is on this machine, and writes the page.
//!
//! ```sh
//! cargo run --release -p lcplab-benches              # reports/performance/index.html
//! cargo run --release -p lcplab-benches -- FOLDER
//! ```

use std::path::PathBuf;
use std::process::ExitCode;

use indicatif::ProgressBar;

fn main() -> ExitCode {
    let folder = std::env::args_os().nth(1).map_or("reports/performance".into(), PathBuf::from);
    let progress = ProgressBar::new(0);
    match lcplab_benches::page(&folder, &progress) {
        Ok((summary, page)) => {
            progress.finish_and_clear();
            println!("{summary}\n{}", page.display());
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}
