//! `teacher`: sheets of problems for a class, and their grading.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use clap::Args;
use lcplab::csv;
use lcplab::error::{Defects, Error, Result};
use lcplab::file;
use lcplab::lesson::assignment::{Answers, Assignment, Grade, Mistake, students};
use lcplab::lesson::template::normal;
use lcplab::live::write_linked;
use serde_json::{Value, json};

use super::lesson::problems;
use super::{Outcome, print};

/// Hand out problems with different numbers for each student, and grade the answers
#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  lcplab teacher --seed SECRET --set 3 --students class.txt --out set3
  lcplab teacher --seed SECRET --set 3 --students class.txt --grade handed_in

The first command writes a sheet for each name in class.txt (set3/sheets), the file that the student fills in \
(set3/answers), and the right answers (set3/key.csv). The number of a lesson in --set selects all of its problems that \
have parameters. The numbers depend only on the secret and the name, so every machine computes the same; without the \
secret they cannot be computed. Keep the secret: the second command needs it. A right answer to an easy problem gives \
1 point, to a medium one 2, to a hard one 3.

--grade accepts .csv files and folders of them. Without --set, every problem that a file names is graded. With \
--students, the table also lists students without a file, and lcplab reports files of students that are not in the \
list. It reports each line that it cannot read, with the file, and grades the others.

Exit codes:
  0  written, or graded
  2  invalid input or usage, or graded except for lines or files that cannot be read")]
pub struct Teacher {
    /// A long secret word; together with a student's name it determines the numbers
    #[arg(long, value_name = "SECRET", value_parser = secret)]
    seed: String,
    /// Lessons and problems, such as 3,4.p1
    #[arg(long, value_name = "LESSONS", value_delimiter = ',', required_unless_present = "grade")]
    set: Vec<String>,
    /// Names of the students, one on each line
    #[arg(long, value_name = "FILE", required_unless_present = "grade")]
    students: Option<PathBuf>,
    /// Grade these files, or the .csv files of these folders
    #[arg(long, value_name = "FILES", num_args = 1..)]
    grade: Vec<PathBuf>,
    /// Folder for the sheets; with --grade a CSV file for the table
    #[arg(long, value_name = "PATH", required_unless_present = "grade")]
    out: Option<PathBuf>,
    /// Print the grades as JSON, with each wrong answer and its hint
    #[arg(long, requires = "grade")]
    json: bool,
}

fn secret(text: &str) -> std::result::Result<String, String> {
    match text.trim() {
        "" => Err("must not be empty".into()),
        secret => Ok(secret.to_string()),
    }
}

impl Teacher {
    pub fn run(&self) -> Result<Outcome> {
        let class = match &self.students {
            None => None,
            Some(path) => {
                let text = file::read(path, file::WRITTEN_BY_HAND)?;
                Some(students(&text, &path.display().to_string())?)
            }
        };
        match (&class, &self.out) {
            (Some(class), Some(out)) if self.grade.is_empty() => self.hand_out(class, out),
            _ => self.grade(class.as_deref()),
        }
    }

    fn hand_out(&self, class: &[String], out: &Path) -> Result<Outcome> {
        let assignment = Assignment::select(&problems()?, &self.set)?;
        for (k, student) in class.iter().enumerate() {
            let name = format!("{:02}_{}", k + 1, slug(student));
            let page = assignment.sheet(student, &self.seed)?.render()?;
            file::write_in(out, format!("sheets/{name}.html"), &page)?;
            if k == 0 {
                write_linked(&page, &out.join("sheets"))?; // all sheets link to the same pages
            }
            file::write_in(out, format!("answers/{name}.csv"), assignment.form(student))?;
        }
        file::write_in(out, "key.csv", assignment.key(class, &self.seed)?)?;
        let ids: Vec<&str> = assignment.problems.iter().map(|problem| &*problem.id).collect();
        print(&format!(
            "{} sheets with {} in {}\n",
            class.len(),
            ids.join(" "),
            out.join("sheets").display()
        ))?;
        Ok(Outcome::Good)
    }

    fn grade(&self, class: Option<&[String]>) -> Result<Outcome> {
        let all = problems()?;
        let mut defects = Defects::default();
        let files = self.read_files(&mut defects)?;
        let assignment = if self.set.is_empty() {
            let is_named =
                |id: &String| files.iter().any(|(_, answers)| answers.numbers.contains_key(id));
            let known = all.iter().map(|problem| problem.id.clone()).filter(is_named);
            Assignment::select(&all, &known.collect::<Vec<_>>())?
        } else {
            Assignment::select(&all, &self.set)?
        };
        for (path, answers) in &files {
            let strangers = answers
                .numbers
                .iter()
                .filter(|(id, _)| !assignment.problems.iter().any(|problem| problem.id == **id));
            let strange = |(id, (line, _)): (&String, &(usize, _))| {
                (*line, format!("{id:?} is not a problem of this set"))
            };
            for (line, reason) in answers.defects.iter().cloned().chain(strangers.map(strange)) {
                defects.add(format!("{}:{line}", path.display()), reason);
            }
        }
        let by_student = by_student(&files, class, &mut defects);
        let names: Vec<String> = match class {
            Some(class) => class.to_vec(),
            None => by_student.values().map(|(name, _)| name.clone()).collect(),
        };
        let nothing = Answers::default();
        let grade = |name: &String| {
            let answers = by_student.get(&normal(name)).map_or(&nothing, |(_, answers)| answers);
            assignment.grade(name, answers, &self.seed)
        };
        let grades: Vec<Grade> = names.iter().map(grade).collect::<Result<_>>()?;
        if let Some(out) = &self.out {
            file::write(out, table(&grades))?;
        }
        print(&if self.json {
            format!("{:#}\n", as_json(&grades))
        } else {
            aligned(&grades) + &summary(&assignment, &grades)
        })?;
        defects.into_result("not everything was graded")?;
        Ok(Outcome::Good)
    }

    /// The files and their contents; those that cannot be read are defects.
    fn read_files(&self, defects: &mut Defects) -> Result<Vec<(PathBuf, Answers)>> {
        let mut paths = Vec::new();
        for path in &self.grade {
            if path.is_dir() {
                let is_csv = |path: &PathBuf| {
                    path.extension().is_some_and(|own| own.eq_ignore_ascii_case("csv"))
                };
                paths.extend(file::list(path)?.into_iter().filter(is_csv));
            } else {
                paths.push(path.clone());
            }
        }
        let mut files = Vec::new();
        for path in paths {
            match file::read(&path, file::WRITTEN_BY_HAND) {
                Ok(text) => files.push((path, Answers::read(&text))),
                Err(Error::File { path, reason }) => defects.add(path, reason),
                Err(error) => return Err(error),
            }
        }
        Ok(files)
    }
}

/// The files by student. Two of the same student are defects, and neither counts.
fn by_student<'a>(
    files: &'a [(PathBuf, Answers)],
    class: Option<&[String]>,
    defects: &mut Defects,
) -> BTreeMap<String, (String, &'a Answers)> {
    let mut found: BTreeMap<String, Vec<(&PathBuf, &str, &Answers)>> = BTreeMap::new();
    for (path, answers) in files {
        let Some(name) = &answers.student else { continue };
        let is_known =
            class.is_none_or(|class| class.iter().any(|own| normal(own) == normal(name)));
        if is_known {
            found.entry(normal(name)).or_default().push((path, name, answers));
        } else {
            let reason = format!("{name:?} is not in the list of students; the file is not graded");
            defects.add(path.display().to_string(), reason);
        }
    }
    let mut single = BTreeMap::new();
    for (key, own) in found {
        match &own[..] {
            [(_, name, answers)] => {
                single.insert(key, (name.to_string(), *answers));
            }
            several => {
                let paths: Vec<String> =
                    several.iter().map(|(path, ..)| path.display().to_string()).collect();
                let reason = format!("several files of {:?}; none of them is graded", several[0].1);
                defects.add(paths.join(", "), reason);
            }
        }
    }
    single
}

/// Letters and digits of a name, for a file name.
fn slug(name: &str) -> String {
    let simple = |c: char| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { ' ' };
    let words: String = name.chars().map(simple).collect();
    words.split_whitespace().collect::<Vec<_>>().join("-")
}

/// The cells of a student's row.
fn cells(grade: &Grade) -> [String; 5] {
    let wrong: Vec<&str> = grade.wrong.iter().map(|mistake| &*mistake.id).collect();
    [
        grade.student.clone(),
        grade.right.join(" "),
        wrong.join(" "),
        grade.missing.join(" "),
        grade.points.to_string(),
    ]
}

/// The table as CSV.
fn table(grades: &[Grade]) -> String {
    let mut out = String::new();
    csv::record(&mut out, ["student", "right", "wrong", "missing", "points", "out of"]);
    for grade in grades {
        csv::record(&mut out, cells(grade).into_iter().chain([grade.out_of.to_string()]));
    }
    out
}

/// The table for a terminal.
fn aligned(grades: &[Grade]) -> String {
    let mut rows = vec![["student", "right", "wrong", "missing", "points"].map(String::from)];
    rows.extend(grades.iter().map(|grade| {
        let mut row = cells(grade);
        row[4] = format!("{} of {}", grade.points, grade.out_of);
        row
    }));
    let width = |column: usize| rows.iter().map(|row| row[column].chars().count()).max();
    let widths: Vec<usize> = (0..5).map(|column| width(column).unwrap_or(0)).collect();
    let line = |row: &[String; 5]| {
        let padded = row.iter().zip(&widths).map(|(cell, width)| format!("{cell:<width$}"));
        format!("{}\n", padded.collect::<Vec<_>>().join("  ").trim_end())
    };
    rows.iter().map(line).collect()
}

/// How the class did on each problem.
fn summary(assignment: &Assignment, grades: &[Grade]) -> String {
    let line = |id: &String| {
        let right = grades.iter().filter(|grade| grade.right.contains(id)).count();
        let missing = grades.iter().filter(|grade| grade.missing.contains(id)).count();
        let wrong = grades.len() - right - missing;
        format!("{id:<5}  {right} right, {wrong} wrong, {missing} missing\n")
    };
    let lines: String = assignment.problems.iter().map(|problem| line(&problem.id)).collect();
    format!("\n{lines}")
}

fn as_json(grades: &[Grade]) -> Value {
    let mistake = |own: &Mistake| {
        json!({
            "problem": own.id, "number": own.number, "answer": own.answer, "hint": own.hint
        })
    };
    let one = |grade: &Grade| {
        json!({
            "student": grade.student,
            "right": grade.right,
            "wrong": grade.wrong.iter().map(mistake).collect::<Vec<_>>(),
            "missing": grade.missing,
            "points": grade.points,
            "out_of": grade.out_of,
        })
    };
    grades.iter().map(one).collect()
}
