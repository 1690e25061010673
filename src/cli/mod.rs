//! The commands, one a file. Exit codes: 0 good, 1 refuted or failed, 2 bad input or usage.

mod chapter;
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
mod trial;
mod verify;

use std::process::ExitCode;

use clap::{Parser, Subcommand};
use indicatif::{ProgressBar, ProgressStyle};
use lcplab::error::{Error, Result};

/// Solve, judge and compare contact problems of rigid bodies.
#[derive(Debug, Parser)]
#[command(name = "lcplab", version, max_term_width = 100, arg_required_else_help = true)]
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
    Trial(trial::Challenge),
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
        Command::Trial(command) => command.run(),
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
