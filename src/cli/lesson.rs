//! `lesson` and `exercise`: writes the notebooks as pages, and checks answers to their problems.

use std::path::{Path, PathBuf};

use clap::Args;
use lcplab::document::unicode;
use lcplab::error::{Error, Result};
use lcplab::file;
use lcplab::lesson::problem::{self, Problem, Reply};
use lcplab::lesson::template::{Seed, Template};
use lcplab::lesson::{ENGINE, Program, write_python};
use lcplab::live::write_linked;
use lcplab::page::Page;

use super::{Outcome, bar, browser, print};
use crate::around::ALL as AROUND;
use crate::lessons::ALL;

/// Write a lesson as a page, with its code and the output of the code
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab lesson                # lists the lessons
  lcplab lesson 3 --open
  lcplab lesson --all          # writes reports/lessons/index.html, 01_….html, …
  lcplab lesson guide --open   # for teachers
  lcplab lesson --all --pyodide node_modules/pyodide    # after npm install pyodide

lcplab runs the Rust cells of a lesson; the output of its Python cells is the recorded one.

A page needs no network connection. With --pyodide, readers can change and run the Python cells in the browser; they \
install nothing, but a web server must serve the folder: copy it to one, or run python3 -m http.server --directory \
reports/lessons and open http://localhost:8000. If the Pyodide distribution lacks NumPy, the cells use arrays.py, \
which has the functions that they need. --ipynb writes Jupyter notebooks with outputs to notebooks/ instead, in Python \
or, with --rust, for the Rust kernel. Python cells import engine.py, which is written next to them. To change a \
lesson, edit notebooks/NN_title.md and run the command again.

Exit codes:
  0  written
  2  a Rust cell fails, or invalid input or usage")]
pub struct Lesson {
    /// Number or name of a lesson
    lesson: Option<String>,
    /// Write all lessons
    #[arg(long, conflicts_with = "lesson")]
    all: bool,
    /// Open the page in the browser
    #[arg(long)]
    open: bool,
    /// Write Jupyter notebooks instead of pages
    #[arg(long, conflicts_with = "open")]
    ipynb: bool,
    /// Write the notebooks for the Rust kernel, NN_title_rust.ipynb
    #[arg(long, requires = "ipynb")]
    rust: bool,
    /// Folder of an unpacked Pyodide distribution, to run the Python cells in the browser
    #[arg(long, value_name = "FOLDER", conflicts_with = "ipynb")]
    pyodide: Option<PathBuf>,
    /// Folder [default: reports/lessons, or notebooks with --ipynb]
    #[arg(long)]
    out: Option<PathBuf>,
}

/// Check your answers to the problems of the lessons
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab exercise              # lists the problems
  lcplab exercise 4.p1         # states problem 4.p1
  lcplab exercise 4.p1 0.9     # is 0.9 the answer?
  lcplab exercise --for \"Ada Lovelace\" 4.p1 0.9

The letter in a problem's number is its kind: p on paper, r predict and run, x on a live page. With --for, a problem has \
different numbers for each student, the same on every machine. The code exercises are in Python: pytest \
notebooks/exercises -k e04 checks those of lesson 4.

Exit codes:
  0  the answer is right, or problems were printed
  1  the answer is wrong
  2  invalid input or usage")]
pub struct Answer {
    /// Lesson and number, such as 4.p1
    exercise: Option<String>,
    /// State a problem with the numbers of this student, and check the answer with them
    #[arg(long = "for", value_name = "NAME")]
    student: Option<String>,
    /// Your answer to a problem
    #[arg(allow_hyphen_values = true, requires = "exercise", value_parser = problem::typed)]
    number: Option<f64>,
}

impl Lesson {
    pub fn run(&self) -> Result<Outcome> {
        let lessons: Vec<&Program> = match &self.lesson {
            Some(name) => vec![named(name)?],
            None if self.all && self.ipynb => ALL.iter().collect(),
            None if self.all => ALL.iter().chain(AROUND).collect(),
            None => return list(),
        };
        if let Some(pyodide) = &self.pyodide {
            write_python(pyodide, &self.folder()?)?;
        }
        let progress = bar(lessons.len() as u64, "");
        let mut written = String::new();
        for lesson in lessons {
            progress.set_message(lesson.name);
            let path = self.write(lesson)?;
            written += &format!("{}\n", path.display());
            if self.open {
                browser::open(&path)?;
            }
            progress.inc(1);
        }
        progress.finish_and_clear();
        print(&written)?;
        Ok(Outcome::Good)
    }

    fn folder(&self) -> Result<PathBuf> {
        let own = if self.ipynb { "notebooks" } else { "reports/lessons" };
        self.out.clone().map_or_else(|| file::inside(Path::new(""), own), Ok)
    }

    fn write(&self, lesson: &Program) -> Result<PathBuf> {
        let folder = self.folder()?;
        let record = lesson.run()?;
        let text = match (self.ipynb, self.rust) {
            (true, true) => lesson.rust_notebook(&record)?,
            (true, false) => lesson.notebook(&record)?,
            (false, _) => {
                let runs_python = self.pyodide.is_some() && lesson.number() > 0;
                Page { runs_python, ..lesson.page(&record)? }.render()?
            }
        };
        let name = if lesson.name == "README" { "index" } else { lesson.name };
        let language = if self.rust { "_rust" } else { "" };
        let name = format!("{name}{language}.{}", if self.ipynb { "ipynb" } else { "html" });
        file::write_in(&folder, &name, &text)?;
        // Next to the sources of the lessons it already exists, perhaps with changes.
        if self.out.is_some() || !self.ipynb {
            file::write_in(&folder, "engine.py", ENGINE)?;
        }
        write_linked(&text, &folder)?;
        Ok(folder.join(name))
    }
}

impl Answer {
    pub(crate) fn run(&self) -> Result<Outcome> {
        let Some(id) = &self.exercise else { return list_problems() };
        let problems = problems()?;
        let Some(template) = problems.iter().find(|problem| problem.id == *id) else {
            let known = problems.into_iter().map(|problem| problem.id).collect();
            return Err(Error::Unknown { kind: "problem", name: id.clone(), known });
        };
        let problem = match &self.student {
            Some(student) => template.drawn(&Seed { secret: "", student })?,
            None => template.printed()?,
        };
        answered(&problem, self.number)
    }
}

/// The problems of all lessons.
pub(super) fn problems() -> Result<Vec<Template>> {
    let sets: Result<Vec<_>> =
        ALL.iter().filter(|lesson| !lesson.problems.is_empty()).map(problem::set).collect();
    Ok(sets?.concat())
}

/// Prints a problem, or the reply to a number.
fn answered(problem: &Problem, number: Option<f64>) -> Result<Outcome> {
    let Problem { id, title, .. } = problem;
    let Some(number) = number else {
        print(&unicode(&format!("{id} {title}\n\n{}\n", problem.text.trim())))?;
        return Ok(Outcome::Good);
    };
    match problem.reply(number) {
        Reply::Right => {
            print(&unicode(&format!("{id} solved: {title}\n\n{}\n", problem.because.trim())))?;
            Ok(Outcome::Good)
        }
        Reply::AlsoRight(remark) => {
            print(&unicode(&format!(
                "{id} solved: {title}\n\n{remark} {}\n",
                problem.because.trim()
            )))?;
            Ok(Outcome::Good)
        }
        Reply::Wrong(hint) => {
            print(&unicode(&format!("{id} not yet: {hint}\n")))?;
            Ok(Outcome::Rejected)
        }
    }
}

fn named(name: &str) -> Result<&'static Program> {
    let is_meant = |lesson: &&Program| {
        lesson.name == name || name.parse().is_ok_and(|number: usize| lesson.number() == number)
    };
    ALL.iter().chain(AROUND).find(is_meant).ok_or_else(|| Error::Unknown {
        kind: "lesson",
        name: name.to_string(),
        known: ALL.iter().map(|lesson| lesson.number().to_string()).collect(),
    })
}

fn list() -> Result<Outcome> {
    let line = |lesson: &Program| format!("{}\n", lesson.title());
    print(&ALL.iter().map(line).collect::<String>())?;
    Ok(Outcome::Good)
}

/// Lists the problems, and whether students have different numbers.
fn list_problems() -> Result<Outcome> {
    let line = |problem: &Template| {
        let kind = if problem.has_parameters() { "own numbers" } else { "same for everyone" };
        format!("{:>5}  {kind:<17}  {}\n", problem.id, problem.title)
    };
    print(&problems()?.iter().map(line).collect::<String>())?;
    Ok(Outcome::Good)
}
