//! Published problems with their exact answers, and each solver's verdict.

use super::{Document, Outcome, View};
use crate::error::Result;
use crate::lcp::library;
use crate::number::count;
use crate::report::answer::first_answer;
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::proofs::{Answered, Judged};
use crate::report::study::families::Row;
use crate::report::study::published::{Finding, Plan};

impl View for Plan {
    const TITLE: &'static str = "Published problems with exact answers";

    fn show(&self, findings: &[Finding], document: &mut Document) {
        document.text(
            "Small problems that others have published, most of them to break solvers: solutions that are \
             not unique, matrices that are not symmetric, ties, paths that end on a ray. All solutions are \
             known as fractions, from exact enumeration. Where none exists, a solver that claims one is \
             wrong.",
        );
        document.table("published", problems(findings));
        document.table("published_verdicts", verdicts(findings));
    }

    fn judged(&self, _section: &str, task: usize) -> Result<Vec<Judged>> {
        let problem = library::by_name(&self.problems[task])?.generate(&[])?;
        let row = Answered {
            table: "published".into(),
            begins: vec![self.problems[task].clone()],
            column: "exact solutions",
            answer: first_answer(&problem.lcp),
        };
        Ok(vec![Judged { problem, answers: vec![row] }])
    }

    fn outcome(&self, findings: &[Finding]) -> Outcome {
        let rows = || findings.iter().flat_map(|finding| &finding.solvers);
        let wrong = rows().map(|row| row.refuted_claims + row.false_claims).sum::<usize>();
        let paths = findings.iter().filter(|finding| finding.lemke.is_some());
        let same = paths.clone().filter(|finding| finding.path() == finding.lemke).count();
        let paths = paths.count();
        let says = format!(
            "{} problems × {} solvers, {wrong} wrong claims; Lemke's path as published on {same} of {paths}",
            findings.len(),
            findings.first().map_or(0, |finding| finding.solvers.len())
        );
        Outcome { good: wrong == 0 && !rows().any(Row::is_wrong) && same == paths, says }
    }
}

fn problems(findings: &[Finding]) -> Table {
    let ray = |(pieces, ray): (usize, bool)| match ray {
        true => format!("ray after {}", count(pieces)),
        false => count(pieces),
    };
    let cells = |finding: &Finding| {
        let solution = |x: &Vec<String>| format!("({})", x.join(", "));
        let solutions = match finding.solutions.len() {
            0 => "none exists".into(),
            _ => finding.solutions.iter().map(solution).collect::<Vec<_>>().join(" "),
        };
        let path = finding.path().map_or("–".into(), ray);
        let path = match finding.lemke {
            Some(_) if finding.lemke == finding.path() => Cell::text(path).marked(Mark::Good),
            Some(_) => Cell::text(path).marked(Mark::Bad),
            None => Cell::text(path),
        };
        let proved = finding.solvers.iter().filter(|row| row.proved > 0).count();
        vec![
            Cell::text(&finding.problem),
            Cell::count(finding.rows),
            Cell::text(solutions),
            Cell::text(finding.lemke.map_or("–".into(), ray)),
            path,
            Cell::count(proved),
            Cell::text(&finding.about),
            Cell::text(&finding.source),
        ]
    };
    Table {
        title: "The problems".into(),
        how_to_read: "Several solutions are all there are, or the corners of a segment of them. *Lemke's \
                      path*: its pieces with the covering vector of ones, published and counted here."
            .into(),
        columns: vec![
            Column::words("problem"),
            Column::numbers("rows", ""),
            Column::words("exact solutions"),
            Column::words("Lemke's path"),
            Column::words("here"),
            Column::numbers("proved by", "solvers"),
            Column::words("what it is"),
            Column::words("source"),
        ],
        rows: findings.iter().map(cells).collect(),
        ..Table::default()
    }
}

fn verdicts(findings: &[Finding]) -> Table {
    let mut columns = vec![Column::words("solver")];
    columns.extend(findings.iter().map(|finding| Column::words(finding.problem.clone())));
    let solvers = findings.first().map_or(Vec::new(), |finding| {
        finding.solvers.iter().map(|row| row.solver.clone()).collect()
    });
    let verdict = |finding: &Finding, solver: &str| {
        let row = finding.solvers.iter().find(|row| row.solver == solver);
        row.map_or(Cell::text("–"), |row| word(finding, row))
    };
    let cells = |solver: &String| {
        let verdicts = findings.iter().map(|finding| verdict(finding, solver));
        [Cell::text(solver)].into_iter().chain(verdicts).collect()
    };
    Table {
        title: "Each solver's verdict on each problem".into(),
        how_to_read: "*proved*: the judge shows in exact arithmetic that the answer carries a solution; \
                      *right*: it is one within the tolerance. *outside*: the solver says that the problem \
                      is not in its class. *no*: it gives up, and says so. *none*: it gives up where there \
                      is no solution. A number is the count of its iterations or pivots."
            .into(),
        columns,
        rows: solvers.iter().map(cells).collect(),
        ..Table::default()
    }
}

fn word(finding: &Finding, row: &Row) -> Cell {
    let counted = |word: &str| Cell::text(format!("{word} {}", count(row.iterations)));
    if row.refuted_claims + row.false_claims > 0 {
        Cell::text("WRONG").marked(Mark::Bad)
    } else if row.outside > 0 {
        Cell::text("outside")
    } else if row.claimed > 0 && row.proved > 0 {
        counted("proved").marked(Mark::Good)
    } else if row.claimed > 0 {
        counted("right").marked(Mark::Good)
    } else if finding.solutions.is_empty() {
        counted("none").marked(Mark::Good)
    } else {
        counted("no").marked(Mark::Note)
    }
}
