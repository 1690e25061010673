//! `solve --trace` and `--plot`: record the convergence of the iterates.

use std::path::PathBuf;

use clap::Args;
use lcplab::csv;
use lcplab::error::{Error, Result};
use lcplab::file;
use lcplab::lcp::Lcp;
use lcplab::plot::{Axis, Figure, Lines, Panel, Series};
use lcplab::solver::{Group, Options, Registry, Solution, theory};
use lcplab::trace::Record;

/// Maximum number of rows for which eigenvalues are computed.
const EIGENVALUE_ROWS: usize = 500;

/// Where the iterates go.
#[derive(Debug, Args)]
pub struct Tracing {
    /// Write the residuals and the objective of each iterate to this CSV file
    #[arg(long, value_name = "FILE")]
    trace: Option<PathBuf>,
    /// Plot the residuals of the iterates to this SVG file; for pgs, sor and ssor also with the
    /// theoretical rate
    #[arg(long, value_name = "FILE")]
    plot: Option<PathBuf>,
}

impl Tracing {
    pub fn is_wanted(&self) -> bool {
        self.trace.is_some() || self.plot.is_some()
    }

    /// Checks that there are iterates to write.
    pub fn check(&self, has_iterates: bool) -> Result<()> {
        let options = if self.trace.is_some() { "--trace" } else { "--plot" };
        let reason = "needs a problem that is solved as a box, without another friction model";
        match self.is_wanted() && !has_iterates {
            true => Err(Error::invalid("options", options, reason)),
            false => Ok(()),
        }
    }

    /// Writes the files.
    pub fn write(
        &self,
        lcp: &Lcp,
        solver: &str,
        options: &Options,
        solution: &Solution,
        records: &[Record],
    ) -> Result<()> {
        if let Some(path) = &self.trace {
            file::write(path, table(records))?;
        }
        if let Some(path) = &self.plot {
            let rate = rate(lcp, solver, options, &solution.x);
            file::write(path, figure(solver, records, rate).svg())?;
        }
        Ok(())
    }
}

fn table(records: &[Record]) -> String {
    let mut text = String::new();
    let names = ["iteration", "scaled_residual", "natural_residual", "objective", "free_rows"];
    csv::record(&mut text, names);
    for record in records {
        csv::record(
            &mut text,
            [
                record.iteration.to_string(),
                csv::number(record.scaled_residual),
                csv::number(record.natural_residual),
                csv::number(record.objective),
                record.free_rows.to_string(),
            ],
        );
    }
    text
}

/// The contraction per sweep on the rows that are free in the end, if theory predicts it.
fn rate(lcp: &Lcp, solver: &str, options: &Options, x: &[f64]) -> Option<f64> {
    let slides = |i: usize| {
        let (lo, hi) = lcp.bounds(i, x);
        lcp.is_coupled(i) && hi > 0.0 && (x[i] <= lo || x[i] >= hi)
    };
    // A sliding row moves with its normal, and is neither free nor at rest.
    if lcp.len() > EIGENVALUE_ROWS || (0..lcp.len()).any(slides) {
        return None;
    }
    theory::rate(solver, options, lcp, &theory::rows_inside(lcp, x))
}

fn figure(solver: &str, records: &[Record], rate: Option<f64>) -> Lines {
    let points = |merit: fn(&Record) -> f64| -> Vec<(f64, f64)> {
        records.iter().map(|record| (record.iteration as f64, merit(record))).collect()
    };
    let natural = points(|record| record.natural_residual);
    let mut series = vec![Series::measured(solver, natural)];
    let ends = records.get(records.len() / 2).zip(records.first()).zip(records.last());
    if let (Some(rate), Some(((middle, first), last))) = (rate, ends) {
        let at = |k: usize| {
            let sweeps = k as f64 - middle.iteration as f64;
            (k as f64, middle.natural_residual * rate.powf(sweeps))
        };
        let name = format!("theory, {solver}: ρ = {rate:.6}");
        series.push(Series::theory(name, vec![at(first.iteration), at(last.iteration)]));
    }
    let scaled = vec![Series::measured(solver, points(|record| record.scaled_residual))];
    Lines {
        id: "iterates".into(),
        title: format!("Residuals of the iterates of {solver}"),
        caption: String::new(),
        x: Axis::linear(unit(solver), ""),
        panels: vec![
            Panel { y: Axis::log("natural residual", "unit of x or w"), series },
            Panel { y: Axis::log("scaled residual", ""), series: scaled },
        ],
    }
}

/// The name of an iteration.
fn unit(solver: &str) -> &'static str {
    match Registry::standard().entry(solver).ok().map(|entry| entry.group) {
        Some(Group::Sweeps) => "sweep",
        Some(Group::Pivoting) => "pivot",
        _ => "iteration",
    }
}
