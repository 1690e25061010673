//! The commands, one a file. Exit codes: 0 good, 1 refuted or failed, 2 bad input or usage.

mod chapter;
mod convert;
mod diagnose;
mod explain;
mod families;
mod form;
mod friction;
mod lesson;
mod library;
mod options;
mod pdf;
mod problem;
mod report;
mod scene;
mod sweep;
mod verify;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use indicatif::{ProgressBar, ProgressStyle};
use lcplab::error::{Error, Result};
use lcplab::lcp::exchange;
use lcplab::lcp::file::Problem;

/// Solve, judge and compare contact problems of rigid bodies.
#[derive(Debug, Parser)]
#[command(name = "lcplab", version, max_term_width = 100, arg_required_else_help = true)]
#[command(after_help = "\
Example:
  lcplab report                              # the standard report
  lcplab simulate stack
  lcplab export stack --step 50 --out stack.json; lcplab solve stack.json
  lcplab solve problem.mtx                   # a problem from elsewhere
  lcplab convert stack.json stack.npz        # and one for elsewhere

Each command has --help with an example.")]
struct Cli {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    Report(report::Report),
    Sweep(sweep::Sweep),
    Solve(problem::Solve),
    Judge(problem::Judge),
    Problems(library::Problems),
    Generate(library::Generate),
    Convert(convert::Convert),
    Scenes(scene::Scenes),
    Simulate(scene::Simulate),
    Compare(scene::Compare),
    CompareSolvers(families::CompareSolvers),
    Export(scene::Export),
    Explain(explain::Explain),
    Diagnose(diagnose::Diagnose),
    Chapter(chapter::Chapter),
    Lesson(lesson::Lesson),
    Exercise(lesson::Answer),
    Verify(verify::Verify),
}

/// How a command ended, other than by bad input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Outcome {
    Good,
    Refuted,
}

/// Runs the command line and returns the exit code.
pub fn run() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Report(command) => command.run(),
        Command::Sweep(command) => command.run(),
        Command::Solve(command) => command.run(),
        Command::Judge(command) => command.run(),
        Command::Problems(command) => command.run(),
        Command::Generate(command) => command.run(),
        Command::Convert(command) => command.run(),
        Command::Scenes(command) => command.run(),
        Command::Simulate(command) => command.run(),
        Command::Compare(command) => command.run(),
        Command::CompareSolvers(command) => command.run(),
        Command::Export(command) => command.run(),
        Command::Explain(command) => command.run(),
        Command::Diagnose(command) => command.run(),
        Command::Chapter(command) => command.run(),
        Command::Lesson(command) => command.run(),
        Command::Exercise(command) => command.run(),
        Command::Verify(command) => command.run(),
    };
    match result {
        Ok(Outcome::Good) => ExitCode::SUCCESS,
        Ok(Outcome::Refuted) => ExitCode::from(1),
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::from(2)
        }
    }
}

/// The problem of a file, in the format that its ending says; JSON by default.
fn read_problem(path: &std::path::Path) -> Result<Problem> {
    let problem = exchange::read(path, None)?;
    warn(&problem);
    Ok(problem)
}

/// Says what was ignored while a problem was read.
fn warn(problem: &Problem) {
    for warning in &problem.warnings {
        eprintln!("warning: {warning}");
    }
}

/// A progress bar on a terminal, nothing in a pipe.
fn bar(length: u64, message: &str) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg}")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    ProgressBar::new(length).with_style(style).with_message(message.to_string())
}

/// Prints to standard output; a reader who has gone away is no error.
fn print(text: &str) -> Result<()> {
    use std::io::Write;
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(cause) if cause.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Error::file(std::path::Path::new("standard output"), &cause))
        }
        _ => Ok(()),
    }
}
