//! One LCP, five costs.

use super::{Document, Outcome, View};
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::worst_cases::{Case, Finding, Plan};

impl View for Plan {
    const TITLE: &'static str = "One LCP, five costs: from 1 to 2ⁿ";

    fn show(&self, findings: &[Finding], document: &mut Document) {
        for study in findings {
            document.text(
                "Which solver is the best one? Here is one problem that costs one method a single step and \
                 another one $2^n$. Murty's matrix $U$ has ones on the diagonal and twos above it; Fathi's \
                 $F = U U^T$ is symmetric positive definite, by its looks a matrix of contacts like any \
                 other. With $b = -1$ in every row the solution is a single push:",
            );
            document.equation(
                "w = F x - \\mathbf{1}, \\quad F = U U^T, \\quad u_{ii} = 1, \\; u_{ij} = 2 \\; (i < j), \
                 \\quad x = e_n",
                "Fathi 1979",
            );
            document.text(
                "Numbered backwards, the same problem has the solution $e_1$. A row has no idea of its \
                 number, but methods do: they look at row 1 first. What each is charged for is\n\n\
                 - Gauss-Seidel: a *sweep*. It solves row after row; backwards, the first row is the answer, \
                 and forwards the second sweep takes back what the first one pushed in vain. Bounds make it \
                 this lucky; rows that stay free cost it far more.\n\
                 - Dantzig: an *exchange* of one row between bound and interior. It drives the rows to their \
                 answers one at a time, and each row on its way upsets those done before it.\n\
                 - Murty: a *pivot* on the first row that is wrong, whichever it is. From the set {} to the \
                 set {n} it passes through all others, one row in or out each time, as Gray's code does.\n\
                 - Lemke: a *piece* of a path on which all rows are relaxed at once. Here its bad numbering \
                 is the others' good one. With $b_i = 2^i - 2^{n+1}$ the path is as long without any tie, so \
                 no rule for ties is to blame.\n\
                 - Enumeration: an *active set* tried, row 1 fastest, until one carries a solution. To know \
                 that there is no other takes all $2^n$ in either numbering.",
            );
            document.figure(figure(study));
            document.table("worst_cases", table(study));
            document.text(
                "So a pivoting method is finite, and that is no promise: its worst case is no better than \
                 trying everything. Contacts are not the worst case, which is why these methods are good in \
                 practice; and an order of rows that is bad for one method is good for another.",
            );
        }
    }

    fn outcome(&self, findings: &[Finding]) -> Outcome {
        let of = |study: &Finding| {
            let agree = study.cases.iter().filter(|case| case.agrees(&study.sizes)).count();
            (agree, study.cases.len())
        };
        let sums = findings.iter().map(of).fold((0, 0), |a, b| (a.0 + b.0, a.1 + b.1));
        let says = format!("{} of {} methods cost what theory says", sums.0, sums.1);
        Outcome { good: sums.0 == sums.1, says }
    }
}

/// The unfavourable numbering on Fathi's matrix.
fn figure(study: &Finding) -> Lines {
    let shown = || study.cases.iter().filter(|case| case.matrix == "fathi" && !case.favourable);
    let measured = |case: &Case| {
        let points = study.sizes.iter().zip(&case.costs);
        let points = points.filter_map(|(&n, &cost)| Some((f64::from(n), cost? as f64)));
        Series::points(case.solver.clone(), points.collect())
    };
    let theory = |case: &Case| {
        let points = study.sizes.iter().map(|&n| (f64::from(n), case.law.cost(n) as f64));
        Series::theory(format!("theory, {}: {}", case.solver, case.law), points.collect())
    };
    Lines {
        id: "worst_cases".into(),
        title: "Fathi's matrix, each method in the numbering it likes least".into(),
        caption:
            "Markers are counted, lines are formulas; Murty's and Lemke's differ by 1. In the numbering it likes best every one \
                  of the five methods needs 1 or 2, whatever n is."
                .into(),
        x: Axis::linear("rows n", ""),
        panels: vec![Panel {
            y: Axis::log("sweeps, exchanges, pivots, pieces or sets", ""),
            series: shown().map(measured).chain(shown().map(theory)).collect(),
        }],
    }
}

fn table(study: &Finding) -> Table {
    let mut columns = vec![
        Column::words("method"),
        Column::words("matrix"),
        Column::words("numbering"),
        Column::words("theory"),
    ];
    columns.extend(study.sizes.iter().map(|n| Column::numbers(n.to_string(), "")));
    columns.push(Column::words("agreement"));
    Table {
        title: "One LCP, five costs".into(),
        how_to_read: "What was counted for each number of rows n, beside the formula. Every answer was accepted by \
                      the judge, otherwise its place says *failed*; a row *agrees* if all its counts \
                      are the formula's."
            .into(),
        columns,
        rows: study.cases.iter().map(|case| cells(study, case)).collect(),
        ..Table::default()
    }
}

fn cells(study: &Finding, case: &Case) -> Vec<Cell> {
    let matrix = match case.matrix.as_str() {
        "fathi" => "F",
        "murty" => "U",
        "murty-exponential" => "U, no ties",
        other => other,
    };
    let solution = match (case.matrix.as_str(), case.reversed) {
        ("murty-exponential", _) => "2ⁿ eₙ",
        (_, false) => "eₙ",
        (_, true) => "e₁",
    };
    let kind = if case.favourable { "good" } else { "bad" };
    let mut cells = vec![
        Cell::text(&case.solver),
        Cell::text(matrix),
        Cell::text(format!("{kind}, x = {solution}")),
        Cell::text(case.law.to_string()),
    ];
    cells.extend(study.sizes.iter().zip(&case.costs).map(|(&n, &cost)| match cost {
        None => Cell::text("failed").marked(Mark::Bad),
        Some(cost) if cost == case.law.cost(n) => Cell::count(cost),
        Some(cost) => Cell::count(cost).marked(Mark::Bad),
    }));
    cells.push(if case.agrees(&study.sizes) {
        Cell::text("agrees").marked(Mark::Good)
    } else {
        Cell::text("differs").marked(Mark::Bad)
    });
    cells
}
