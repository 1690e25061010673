//! Assignments: a sheet of problems for each student of a class, and the grading of what they hand
//! in.
//!
//! A student hands in a text file with one line for each number (`Assignment::form`):
//!
//! ```text
//! student,Ada Lovelace
//! 3.p1,0.25
//! 3.p2,
//! ```

use std::collections::BTreeMap;

use super::page::on_page;
use super::problem::{Problem, Reply, typed};
use super::template::{Seed, Template, decimal, normal};
use crate::csv;
use crate::error::{Defects, Error, Result};
use crate::report::page::{Block, Page, Section};

/// The first word of the line with the student's name.
const STUDENT: &str = "student";

/// The problems that a class gets.
///
/// ```
/// use lcplab::lesson::assignment::{Answers, Assignment};
/// # let text = "id = \"3.p1\"\nkind = \"pencil\"\ntitle = \"\"\nminutes = 3\nlevel = 2\n\
/// #     parameters.m = [2, 1, 3, 4]\ntext = \"\"\nunit = \"N s\"\nanswer = \"m*0.5\"\nwithin = 0.01\n\
/// #     because = \"\"\n";
/// # let template = toml::from_str(text).unwrap();
/// let assignment = Assignment { problems: vec![template] };
/// let answer = assignment.problems_of("Ada", "a secret")?[0].answer;
/// let file = format!("student,Ada\n3.p1,{answer}\n");
/// let grade = assignment.grade("Ada", &Answers::read(&file), "a secret")?;
/// assert_eq!(grade.points, 2);
/// # Ok::<(), lcplab::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Assignment {
    /// The problems, in the order of the lessons.
    pub problems: Vec<Template>,
}

/// What a student handed in.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Answers {
    /// The student's name, if a line states it.
    pub student: Option<String>,
    /// The line of each problem and its number; `None` if the student has left it empty.
    pub numbers: BTreeMap<String, (usize, Option<f64>)>,
    /// The lines that cannot be used, from 1, each with the reason.
    pub defects: Vec<(usize, String)>,
}

/// The result of a student.
#[derive(Debug, Clone, PartialEq)]
pub struct Grade {
    /// The student's name.
    pub student: String,
    /// The problems with a right answer.
    pub right: Vec<String>,
    /// Those with a wrong answer.
    pub wrong: Vec<Mistake>,
    /// Those without an answer.
    pub missing: Vec<String>,
    /// The sum of the levels of the right ones.
    pub points: u32,
    /// The sum of all levels.
    pub out_of: u32,
}

/// A wrong answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Mistake {
    /// The problem.
    pub id: String,
    /// The student's number.
    pub number: f64,
    /// The right one.
    pub answer: f64,
    /// The hint that `exercise` would give.
    pub hint: String,
}

impl Assignment {
    /// The problems that these names select: a lesson's number for all its problems with
    /// parameters, or the problem's own, `4.p1`.
    ///
    /// # Errors
    /// Lists the names that select nothing.
    pub(crate) fn select(all: &[Template], names: &[String]) -> Result<Self> {
        let lesson = |id: &str| id.split('.').next().unwrap_or_default().to_string();
        let is_meant = |name: &str, problem: &Template| {
            name == problem.id || (name == lesson(&problem.id) && problem.has_parameters())
        };
        let mut defects = Defects::default();
        for name in names {
            if !all.iter().any(|problem| is_meant(name, problem)) {
                defects.add(
                    name,
                    "is neither a problem with parameters nor a lesson that contains such problems",
                );
            }
        }
        defects.into_result("set")?;
        let is_selected = |problem: &&Template| names.iter().any(|name| is_meant(name, problem));
        Ok(Self { problems: all.iter().filter(is_selected).cloned().collect() })
    }

    /// The problems with the numbers of a student.
    ///
    /// # Errors
    /// If a formula cannot be evaluated.
    pub fn problems_of(&self, student: &str, secret: &str) -> Result<Vec<Problem>> {
        let seed = Seed { secret, student };
        self.problems.iter().map(|template| template.drawn(&seed)).collect()
    }

    /// The file that a student fills in.
    pub(crate) fn form(&self, student: &str) -> String {
        let mut out = String::new();
        csv::record(&mut out, [STUDENT, student]);
        self.problems.iter().for_each(|problem| csv::record(&mut out, [&problem.id, ""]));
        out
    }

    /// The sheet of a student.
    ///
    /// # Errors
    /// If a formula cannot be evaluated.
    pub(crate) fn sheet(&self, student: &str, secret: &str) -> Result<Page> {
        let problems = self.problems_of(student, secret)?;
        let section = |(k, problem): (usize, &Problem)| Section {
            id: format!("problem-{}", k + 1),
            title: format!("{} {}", problem.id, problem.title),
            blocks: vec![
                Block::Text(on_page(problem.text.trim())),
                Block::Text(format!("*{}*", points(problem.level.into()))),
            ],
            ..Section::default()
        };
        let mut sections: Vec<Section> = problems.iter().enumerate().map(section).collect();
        sections.push(Section {
            id: "answers".into(),
            title: "Your answers".into(),
            blocks: vec![
                Block::Text(format!(
                    "Copy these lines to a text file whose name ends in `.csv`, or use the file that came with this \
                     sheet. Write each number after its comma, as in `{},0.25`: with a decimal point, in the unit that \
                     the problem states, without the unit. Four digits are enough. Leave empty what you have not \
                     solved, and hand in the file.",
                    problems.first().map_or("1.p1", |problem| &problem.id),
                )),
                Block::Code { language: "text".into(), text: self.form(student) },
            ],
            ..Section::default()
        });
        Ok(Page {
            title: student.to_string(),
            lead: "Other students have different numbers.".into(),
            sections,
            facts: vec![("lcplab".into(), env!("CARGO_PKG_VERSION").into())],
            ..Page::default()
        })
    }

    /// The right answers of all students, as CSV.
    ///
    /// # Errors
    /// If a formula cannot be evaluated.
    pub(crate) fn key(&self, students: &[String], secret: &str) -> Result<String> {
        let mut out = String::new();
        let columns = ["student", "problem", "answer", "unit", "relative tolerance", "numbers"];
        csv::record(&mut out, columns);
        for student in students {
            for problem in self.problems_of(student, secret)? {
                let number = |(name, value): (&String, &f64)| format!("{name}={value}");
                let numbers: Vec<String> = problem.parameters.iter().map(number).collect();
                let [answer, within] = [problem.answer, problem.within].map(|own| decimal(own, 6));
                let fields = [student, &problem.id, &answer, &problem.unit, &within];
                csv::record(&mut out, fields.into_iter().chain([&numbers.join(" ")]));
            }
        }
        Ok(out)
    }

    /// Grades what a student handed in.
    ///
    /// # Errors
    /// If a formula cannot be evaluated.
    pub fn grade(&self, student: &str, answers: &Answers, secret: &str) -> Result<Grade> {
        let mut grade = Grade {
            student: student.to_string(),
            right: Vec::new(),
            wrong: Vec::new(),
            missing: Vec::new(),
            points: 0,
            out_of: 0,
        };
        for problem in self.problems_of(student, secret)? {
            let level = u32::from(problem.level);
            grade.out_of += level;
            let Some((_, Some(number))) = answers.numbers.get(&problem.id) else {
                grade.missing.push(problem.id);
                continue;
            };
            match problem.reply(*number) {
                Reply::Right | Reply::AlsoRight(_) => {
                    grade.points += level;
                    grade.right.push(problem.id);
                }
                Reply::Wrong(hint) => grade.wrong.push(Mistake {
                    id: problem.id,
                    number: *number,
                    answer: problem.answer,
                    hint,
                }),
            }
        }
        Ok(grade)
    }
}

impl Answers {
    /// Reads a filled form. A line that cannot be used is a defect, and the others count.
    pub fn read(text: &str) -> Self {
        let mut answers = Self::default();
        for (k, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
            let line = line.trim();
            if line.is_empty() || line.starts_with('#') {
                continue;
            }
            if let Err(reason) = answers.take(k + 1, line) {
                answers.defects.push((k + 1, reason));
            }
        }
        if answers.student.is_none() {
            answers.defects.push((1, format!("no line \"{STUDENT},NAME\" states the name")));
        }
        answers
    }

    fn take(&mut self, at: usize, line: &str) -> std::result::Result<(), String> {
        // Some spreadsheets separate by semicolons.
        let (name, value) = line
            .split_once([',', ';'])
            .ok_or_else(|| format!("{line:?} has no comma: write PROBLEM,NUMBER"))?;
        let (name, value) = (unquoted(name), unquoted(value));
        if name == STUDENT {
            return match &self.student {
                _ if value.is_empty() => Ok(()),
                Some(first) => Err(format!("a second name; {first:?} counts")),
                None => {
                    self.student = Some(value);
                    Ok(())
                }
            };
        }
        let number = match value.as_str() {
            "" => None,
            value => Some(typed(value).map_err(|reason| format!("{name}: {reason}"))?),
        };
        match self.numbers.get(&name) {
            Some((first, Some(_))) => {
                Err(format!("{name} has an answer in line {first} already, which counts"))
            }
            _ => {
                self.numbers.insert(name, (at, number));
                Ok(())
            }
        }
    }
}

/// A field of a CSV file without its quotes.
fn unquoted(field: &str) -> String {
    let field = field.trim();
    let inside = field.strip_prefix('"').and_then(|rest| rest.strip_suffix('"'));
    inside.map_or(field.to_string(), |inside| inside.replace("\"\"", "\"").trim().to_string())
}

/// The names in a list, one on each line.
///
/// # Errors
/// If it is empty, or two students have the same name.
pub fn students(text: &str, input: &str) -> Result<Vec<String>> {
    let mut lines: BTreeMap<String, usize> = BTreeMap::new();
    let mut names = Vec::new();
    let mut defects = Defects::default();
    for (k, line) in text.trim_start_matches('\u{feff}').lines().enumerate() {
        let name = line.split_whitespace().collect::<Vec<_>>().join(" ");
        if name.is_empty() {
            continue;
        }
        match lines.insert(normal(&name), k + 1) {
            Some(first) => defects.add(
                format!("line {}", k + 1),
                format!(
                    "{name:?} is also the name in line {first}; add something that distinguishes the two"
                ),
            ),
            None => names.push(name),
        }
    }
    defects.into_result(input)?;
    if names.is_empty() {
        return Err(Error::invalid(input, "students", "write one name on each line"));
    }
    Ok(names)
}

/// The number of points in words.
fn points(count: u32) -> String {
    if count == 1 { "1 point".into() } else { format!("{count} points") }
}
