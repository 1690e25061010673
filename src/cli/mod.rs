//! The command line: the commands, one per file, and their exit codes.

mod browser;
mod chapter;
mod compare;
mod convert;
mod diagnose;
mod engines;
mod explain;
mod form;
mod friction;
mod gradient;
mod grid;
mod hunt;
mod judge;
mod lesson;
mod library;
mod limits;
mod live;
mod loads;
mod mistake;
mod options;
mod pdf;
mod plugin;
mod precision;
mod problem;
mod proof;
mod proof_page;
mod receipts;
mod renamed;
mod report;
mod scene;
mod search;
mod shell;
mod solutions;
mod teacher;
mod test;
mod trace;

use std::ffi::OsString;
use std::path::{Path, PathBuf};

use clap::{ArgMatches, CommandFactory, FromArgMatches, Parser, Subcommand};
use indicatif::{ProgressBar, ProgressFinish, ProgressStyle};
use lcplab::error::{Error, Result};
use lcplab::file;
use lcplab::files;
use lcplab::lcp::file::Problem;
use lcplab::memory::Memory;
use lcplab::number::plain;
use lcplab::report::text::printable;
use lcplab::solver::Reason;

pub use judge::text as judged_text;

use limits::{Limits, RAISE_MEMORY, TimeLimit, outlive_file_size_limit};

/// Solve contact problems of rigid bodies, check the answers, and explain what goes wrong.
#[derive(Debug, Parser)]
#[command(name = "lcplab", version, max_term_width = 100, arg_required_else_help = true)]
#[command(after_help = "\
Examples:
  lcplab report                        # the standard report
  lcplab simulate stack
  lcplab export stack --step 50 --out stack.json; lcplab solve stack.json
  lcplab solve problem.mtx             # a problem from another program
  lcplab convert stack.json stack.npz  # a problem for another program

Exit codes:
  0    solved, accepted, or written
  1    rejected, failed, diverged, or stopped by the time limit
  2    invalid input or usage, or a file that cannot be read or written
  130  stopped by Ctrl-C

The Python package adds the command lcplab import, which writes an MJCF or URDF file as a scene.
A long command that is stopped by Ctrl-C or SIGTERM writes what it has computed. lcplab COMMAND --help shows examples.")]
struct Cli {
    #[command(subcommand)]
    command: Command,
    #[command(flatten)]
    time: TimeLimit,
}

#[derive(Debug, Subcommand)]
enum Command {
    Report(report::Report),
    Grid(grid::Grid),
    Solve(problem::Solve),
    Judge(judge::Judge),
    Gradient(gradient::Derivatives),
    Precision(precision::SinglePrecision),
    Prove(proof::Prove),
    Check(proof::Check),
    Problems(library::Problems),
    Convert(convert::Convert),
    Scenes(scene::Scenes),
    Simulate(scene::Simulate),
    Compare(compare::Compare),
    Export(scene::Export),
    Explain(explain::Explain),
    Diagnose(diagnose::Diagnose),
    Chapter(chapter::Chapter),
    Lesson(lesson::Lesson),
    Exercise(lesson::Answer),
    Live(live::Live),
    Teacher(teacher::Teacher),
    Hunt(hunt::Challenge),
    Test(test::Test),
    Receipts(receipts::Receipts),
    #[command(hide = true)]
    Completions(shell::Completions),
    #[command(name = "man", hide = true)]
    Manual(shell::Manual),
}

/// The commands as the help lists them: first those that most people need.
const GROUPS: [(&str, &[&str]); 5] = [
    (
        "Most used",
        &["solve", "judge", "diagnose", "hunt", "test", "receipts", "simulate", "report", "lesson"],
    ),
    (
        "Problems",
        &["compare", "explain", "gradient", "precision", "prove", "check", "problems", "convert"],
    ),
    ("Scenes", &["scenes", "export"]),
    ("Learn", &["exercise", "live", "chapter", "teacher"]),
    ("Series of runs", &["grid"]),
];

/// The command line with its commands in groups.
fn grouped(cli: clap::Command) -> clap::Command {
    let line = |name: &&str| {
        let about = cli.find_subcommand(name).and_then(|command| command.get_about());
        format!("  {name:<15}  {}\n", about.map(ToString::to_string).unwrap_or_default())
    };
    let group = |(title, names): &(&str, &[&str])| {
        format!("{title}:\n{}", names.iter().map(line).collect::<String>())
    };
    let groups: Vec<String> = GROUPS.iter().map(group).collect();
    let groups = groups.join("\n");
    cli.help_template(format!("{{about-with-newline}}\n{{usage-heading}} {{usage}}\n\n{groups}\nOptions:\n{{options}}{{after-help}}"))
}

/// How a command ended, other than by invalid input.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Outcome {
    Good,
    Rejected,
    /// It was stopped; the results so far were written.
    Stopped(Reason),
}

impl Outcome {
    /// 0 success; 1 rejected, failed, or out of time; 130 interrupted. Invalid input is 2.
    fn code(self) -> u8 {
        match self {
            Outcome::Good => 0,
            Outcome::Rejected => 1,
            Outcome::Stopped(reason) => code(reason),
        }
    }
}

/// The exit code of a program that was stopped.
fn code(reason: Reason) -> u8 {
    match reason {
        Reason::TimeLimit(_) => 1,
        Reason::Interrupted => 130,
    }
}

/// Runs the command line with these arguments, of which the first is the program's name, and
/// returns the exit code.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    let words: Vec<String> =
        arguments.iter().map(|word| word.to_string_lossy().into_owned()).collect();
    let matches = match grouped(Cli::command()).try_get_matches_from(arguments) {
        Ok(matches) => matches,
        Err(error) => match renamed::instead(&error, &words) {
            Some(new) => {
                say(&format!("error: {new}"));
                return 2;
            }
            None => return explained(&error),
        },
    };
    let cli = match Cli::from_arg_matches(&matches) {
        Ok(cli) => cli,
        Err(error) => return explained(&error),
    };
    outlive_file_size_limit();
    let limits = Limits::begin(&cli.time);
    let result = match cli.command {
        Command::Report(command) => command.run(&limits),
        Command::Grid(command) => command.run(&limits),
        Command::Solve(command) => command.run(&limits),
        Command::Judge(command) => command.run(),
        Command::Gradient(command) => command.run(),
        Command::Precision(command) => command.run(),
        Command::Prove(command) => command.run(),
        Command::Check(command) => command.run(),
        Command::Problems(command) => command.run(),
        Command::Convert(command) => command.run(),
        Command::Scenes(command) => command.run(),
        Command::Simulate(command) => command.run(&limits),
        Command::Compare(command) => command.run(&limits),
        Command::Export(command) => command.run(&limits),
        Command::Explain(command) => command.run(),
        Command::Diagnose(command) => command.run(),
        Command::Chapter(command) => command.run(),
        Command::Lesson(command) => command.run(),
        Command::Live(command) => command.run(),
        Command::Exercise(command) => command.run(),
        Command::Teacher(command) => command.run(),
        Command::Hunt(command) => command.run(&limits),
        Command::Test(command) => command.run(&limits),
        Command::Receipts(command) => command.run(),
        Command::Completions(command) => command.run(),
        Command::Manual(command) => command.run(),
    };
    match result {
        Ok(outcome) => {
            if let Outcome::Stopped(reason) = outcome {
                say(&format!("error: {reason}"));
            }
            outcome.code()
        }
        Err(error) => {
            say(&format!("error: {error}{}", hint(&error, &matches)));
            2
        }
    }
}

/// Prints the help, the version or an error of usage, and returns the exit code. The program is not
/// ended, because it may be a Python interpreter.
fn explained(error: &clap::Error) -> u8 {
    let _ = error.print();
    u8::try_from(error.exit_code()).unwrap_or(2)
}

/// The option that helps against an error, if the command has one.
fn hint(error: &Error, matches: &ArgMatches) -> &'static str {
    let has_limit = matches
        .subcommand()
        .is_some_and(|(_, command)| command.ids().any(|id| id.as_str() == "max_memory"));
    match error {
        Error::TooLarge { .. } if has_limit => RAISE_MEMORY,
        _ => "",
    }
}

/// Prints a line to standard error, without escapes; a failure to print is ignored.
fn say(line: &str) {
    use std::io::Write;
    let _ = writeln!(std::io::stderr().lock(), "{}", plain(&printable(line)));
}

/// The text of a recorded run with which this one is compared.
fn baseline_text(path: &Path) -> Result<String> {
    if !file::is_there(path) {
        let reason = "there is no such file; record it with --update, in a run that you trust";
        return Err(Error::File { path: path.display().to_string(), reason: reason.into() });
    }
    file::read(path, file::WRITTEN_BY_HAND)
}

/// The name under which runs compare a file: its path from the current folder, so that `fr/a.json`,
/// `./fr//a.json` and its absolute path are one name.
fn from_here(name: &str) -> String {
    let here = std::env::current_dir().unwrap_or_default();
    let path = Path::new(name);
    let path: PathBuf = path.strip_prefix(&here).unwrap_or(path).components().collect();
    let path = path.strip_prefix(".").unwrap_or(&path);
    path.display().to_string()
}

/// The problem of a file, in the format of its extension; JSON by default.
fn read_problem(path: &Path, most: Memory) -> Result<Problem> {
    let problem = files::read_within(path, None, most)?;
    warn(&problem);
    Ok(problem)
}

/// Maximum number of warnings that are printed.
const WARNINGS: usize = 20;

/// Prints what was ignored while a problem was read.
fn warn(problem: &Problem) {
    for warning in problem.warnings.iter().take(WARNINGS) {
        say(&format!("warning: {warning}"));
    }
    if problem.warnings.len() > WARNINGS {
        say(&format!("warning: {} more not shown", problem.warnings.len() - WARNINGS));
    }
}

/// A progress bar on a terminal, nothing in a pipe.
fn bar(length: u64, message: &str) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:30} {pos}/{len} {msg}")
        .unwrap_or_else(|_| ProgressStyle::default_bar());
    let bar =
        ProgressBar::new(length).with_style(style).with_message(printable(message).into_owned());
    // The bar is removed even if an error ends the work.
    bar.with_finish(ProgressFinish::AndClear)
}

/// The folder for results: the one that the user names, or one named after the input file.
fn folder_of(out: Option<&Path>, usual: &str, name: &str) -> Result<PathBuf> {
    if let Some(out) = out {
        return Ok(out.into());
    }
    let reason = |reason| format!("{reason}; choose another folder with --out FOLDER");
    file::check_name(name).map_err(|why| Error::invalid(usual, "folder", reason(why)))?;
    file::inside(Path::new(""), Path::new(usual).join(name))
}

/// A number of threads.
fn threads() -> clap::builder::RangedI64ValueParser<u16> {
    clap::value_parser!(u16).range(1..=1024)
}

/// Prints to standard output, without escapes; it is no error if the reader has closed the pipe.
fn print(text: &str) -> Result<()> {
    print_colored(&printable(text))
}

/// First characters of pages, pictures and JSON, which are printed unchanged.
const MARKUP: [char; 4] = ['<', '#', '{', '['];

/// Prints a text whose only escapes are our own. Powers of ten are written as `1.3e-8`, so that
/// they can be copied into programs.
fn print_colored(text: &str) -> Result<()> {
    use std::io::Write;
    let text = if text.starts_with(MARKUP) { text.to_string() } else { plain(text) };
    let mut out = std::io::stdout().lock();
    match out.write_all(text.as_bytes()).and_then(|()| out.flush()) {
        Err(cause) if cause.kind() != std::io::ErrorKind::BrokenPipe => {
            Err(Error::file(Path::new("standard output"), &cause))
        }
        _ => Ok(()),
    }
}
