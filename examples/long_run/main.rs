//! A stack, a chain and a pile for 100 000 steps: energy and drift stay within bounds.
//!
//! `cargo run --release --example long_run [STEPS]`; the exit code is 1 if a bound is exceeded.

mod record;

use std::process::ExitCode;
use std::time::Instant;

use record::{RUNS, Record};

/// The headings of the cells of a record.
const COLUMNS: [&str; 6] = [
    "energy at the start, J",
    "highest − start, J",
    "end − start, J",
    "penetration, m",
    "joint drift, m",
    "farthest way, m",
];

fn main() -> ExitCode {
    let steps =
        std::env::args().nth(1).map_or(100_000, |word| word.parse().expect("a number of steps"));
    println!("{steps} steps of each scene\n");
    println!("| scene | {} | seconds | exceeded |", COLUMNS.join(" | "));
    println!("|{}", " --- |".repeat(COLUMNS.len() + 3));
    let mut is_sound = true;
    for run in RUNS {
        let begin = Instant::now();
        let (cells, broken) = match run.record(steps) {
            Ok(record) => (cells(&record).to_vec(), run.broken(&record).join(", ")),
            Err(failure) => (vec![String::new(); COLUMNS.len()], failure.to_string()),
        };
        is_sound &= broken.is_empty();
        let seconds = begin.elapsed().as_secs_f64();
        println!("| {} | {} | {seconds:.1} | {broken} |", run.scene, cells.join(" | "));
    }
    if is_sound { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn cells(record: &Record) -> [String; COLUMNS.len()] {
    let [start, highest, last] = record.energy;
    let small = |value: f64| format!("{value:.1e}");
    [
        format!("{start:.3}"),
        small(highest - start),
        small(last - start),
        small(record.penetration),
        small(record.drift),
        small(record.creep),
    ]
}
