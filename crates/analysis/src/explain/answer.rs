//! The answer: x, w, their meaning, and the judge's verdict.

use super::units::{Units, with_unit};
use lcplab_judge::{Demand, Verdict, judge, upper_bound};
use lcplab_lcp::Lcp;
use lcplab_page::document::notation::{indexed, plain, settled};
use lcplab_page::document::{Block, Section};
use lcplab_page::number::readable;
use lcplab_solver::Solution;

/// A problem with the meaning of its rows.
pub(super) struct Reading<'a> {
    pub lcp: &'a Lcp,
    pub labels: Vec<String>,
    pub units: Units,
    /// Whether the document explains the method before.
    pub is_again: bool,
}

/// The section, and whether the judge accepts x.
pub(super) fn section(reading: &Reading, solution: &Solution, demand: &Demand) -> (Section, bool) {
    let (lcp, x) = (reading.lcp, &solution.x);
    let certificate = judge(lcp, x, demand);
    let mut section = Section::new("the answer");
    let w = settled(&certificate.w, &sizes(lcp, x));
    let line = |i: usize| {
        let (lo, hi) = lcp.bounds(i, x);
        let value = with_unit(&plain(x[i]), &reading.units.x[i]);
        let rate = with_unit(&plain(w[i]), &reading.units.w[i]);
        vec![
            with_unit(&i.to_string(), &reading.labels[i]),
            format!("{} = {value}", indexed("x", i)),
            format!("{} = {rate}", indexed("w", i)),
            condition(i, x[i], lo, hi),
        ]
    };
    let columns = ["row", "x", "w = A x + b", "condition"];
    section.table("x and w, row by row", &columns, (0..lcp.len()).map(line).collect());
    if let Some(Block::Table(table)) = section.blocks.last_mut() {
        table.keeps_columns = true;
    }
    section.say(word(&certificate.verdict, certificate.scaled_residual));
    (section, certificate.verdict.is_solution())
}

/// The sizes of the terms of each w.
fn sizes(lcp: &Lcp, x: &[f64]) -> Vec<f64> {
    let size = |i: usize| {
        let terms = lcp.matrix().row(i).iter().map(|(j, a)| (a * x[j]).abs()).sum::<f64>();
        terms + lcp.b()[i].abs()
    };
    (0..lcp.len()).map(size).collect()
}

/// The judge's verdict.
pub(super) fn word(verdict: &Verdict, scaled_residual: f64) -> String {
    let verdict = match verdict {
        Verdict::Proved { distance: 0.0 } => "proved: x is an exact solution".into(),
        Verdict::Proved { distance } => {
            let most = upper_bound(*distance);
            format!(
                "proved: an exact solution exists, and no entry of x differs from it by more than {most}"
            )
        }
        other => other.to_string(),
    };
    format!(
        "The judge sees A, b, the bounds and x, but not the solver. Its verdict is {verdict}. The error of the worst \
         row relative to the size of its terms, the scaled residual, is {}.",
        readable(scaled_residual, 2)
    )
}

/// The position of x within its bounds, and the requirement on w that follows from it.
fn condition(i: usize, x: f64, lo: f64, hi: f64) -> String {
    let (w, lower, upper) = (indexed("w", i), plain(lo), plain(hi));
    let own = indexed("x", i);
    match x {
        _ if lo == hi => format!("{own} = {lower}, {w} arbitrary"),
        x if x == lo => format!("{own} = {lower}, so {w} ≥ 0"),
        x if x == hi => format!("{own} = {upper}, so {w} ≤ 0"),
        _ if hi == f64::INFINITY => format!("{own} > {lower}, so {w} = 0"),
        _ => format!("{lower} < {own} < {upper}, so {w} = 0"),
    }
}
