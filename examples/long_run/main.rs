//! A stack, a chain and a pile for 100 000 steps: no energy out of nothing, no drift, no more memory.
//!
//! `cargo run --release --example long_run [STEPS]`; a broken bound ends it with exit code 1.

mod record;

use std::process::ExitCode;
use std::time::Instant;

use record::{COLUMNS, RUNS};

fn main() -> ExitCode {
    let steps = std::env::args().nth(1).map(|word| word.parse().expect("a number of steps"));
    println!("| scene | {} | seconds | exceeded |", COLUMNS.join(" | "));
    println!("|{}", " --- |".repeat(COLUMNS.len() + 3));
    let mut is_sound = true;
    for run in RUNS {
        let begin = Instant::now();
        let (cells, broken) = match run.record(steps.unwrap_or(100_000)) {
            Ok(record) => (record.cells().to_vec(), run.broken(&record).join(", ")),
            Err(failure) => (vec![String::new(); COLUMNS.len()], failure.to_string()),
        };
        is_sound &= broken.is_empty();
        let seconds = begin.elapsed().as_secs_f64();
        println!("| {} | {} | {seconds:.1} | {broken} |", run.scene, cells.join(" | "));
    }
    if is_sound { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}
