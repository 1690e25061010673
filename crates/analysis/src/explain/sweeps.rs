//! Explains sweeps of PGS and SOR: the sum, the division, the relaxation and the clamp of every
//! row.

use std::ops::ControlFlow;

use super::answer::Reading;
use super::solve::Scribe;
use super::units::{headed, with_unit};
use lcplab_lcp::merit;
use lcplab_page::document::notation::{bracketed, interval, plain, sum, vector};
use lcplab_page::document::{Formula, SHOWN, Section};
use lcplab_solver::{Event, Iterate, Observer, Pgs, RowUpdate, Solution, StepDetail};

/// Number of sweeps that are written row by row; for the others only x is written.
const IN_FULL: usize = 3;
/// Number of sweeps whose x is written, in addition to the last one.
const LISTED: usize = SHOWN - 2;

pub(super) struct Sweeps<'a> {
    reading: &'a Reading<'a>,
    section: Section,
    /// x in the middle of a sweep.
    x: Vec<f64>,
    /// The lines of the current sweep.
    lines: Vec<Vec<String>>,
    sweeps: usize,
    /// Number, x and natural residual of the listed iterates, then of the last one.
    listed: Vec<(usize, Vec<f64>, f64)>,
    last: Option<(usize, Vec<f64>, f64)>,
}

impl<'a> Sweeps<'a> {
    pub fn of(reading: &'a Reading<'a>, name: &str) -> Self {
        let title = if name == Pgs::NAME { "projected Gauss-Seidel" } else { "projected SOR" };
        let mut section = Section::new(format!("{title}, row by row"));
        if !reading.is_again {
            section.say(
                "A sweep updates one row after another, always with the newest x. It sums the w of the row, \
                 divides it by the diagonal entry, and subtracts the result from x. Then it clamps x to its bounds, \
                 before the next row.",
            );
            section.formula(Formula::default().symbols(
                "xᵢ ← Πᵢ( xᵢ − ω wᵢ / aᵢᵢ ),   wᵢ = Σⱼ aᵢⱼ xⱼ + bᵢ",
                "x_i \\leftarrow \\Pi_i\\left( x_i - \\omega \\frac{w_i}{a_{ii}} \\right), \\qquad \
                 w_i = \\sum_j a_{ij} x_j + b_i",
            ));
        }
        let (x, lines, listed) = (Vec::new(), Vec::new(), Vec::new());
        Sweeps { reading, section, x, lines, sweeps: 0, listed, last: None }
    }

    /// A row of a sweep as a line of the table.
    fn line(&self, own: &RowUpdate) -> Vec<String> {
        let RowUpdate { row, w, diagonal, omega, before, unclamped, after } = *own;
        let products: Vec<(f64, f64)> =
            self.reading.lcp.matrix().row(row).iter().map(|(j, a)| (a, self.x[j])).collect();
        let quotient = w / diagonal;
        let factor = if omega == 1.0 { String::new() } else { format!("{}·", plain(omega)) };
        let (lo, hi) = self.reading.lcp.bounds(row, &self.x);
        vec![
            row.to_string(),
            sum(&products, self.reading.lcp.b()[row], w),
            format!("{}/{} = {}", plain(w), bracketed(diagonal), plain(quotient)),
            format!("{} − {factor}{} = {}", plain(before), bracketed(quotient), plain(unclamped)),
            format!("to {}: {}", interval(lo, hi), plain(after)),
        ]
    }

    fn finish_sweep(&mut self) {
        let title = format!("sweep {}", self.sweeps);
        let (x, w) = (self.reading.units.of_x(), self.reading.units.of_w());
        let [sum, quotient, moved, clamped] =
            [("the sum w", &w), ("divided by a", &x), ("x moved", &x), ("clamped", &x)]
                .map(|(words, unit)| headed(words, unit));
        let columns = ["row", &sum, &quotient, &moved, &clamped];
        let lines = std::mem::take(&mut self.lines);
        self.section.table(&title, &columns, lines);
        let x = with_unit(&vector(&self.x), &x);
        self.section.say(format!("After sweep {}: x = {x}.", self.sweeps));
    }

    /// Adds x and its residual to the list of sweeps.
    fn list(&mut self) {
        let mut before: Option<(usize, f64)> = None;
        let mut lines = Vec::new();
        for (sweep, x, residual) in self.listed.iter().chain(&self.last) {
            let factor = match before {
                Some((previous, old)) if previous + 1 == *sweep && old > 0.0 => {
                    plain(residual / old)
                }
                _ => String::new(),
            };
            before = Some((*sweep, *residual));
            lines.push(vec![sweep.to_string(), vector(x), plain(*residual), factor]);
        }
        let x = headed("x", &self.reading.units.of_x());
        let columns = ["sweep", &x, "max |x − Π(x − w)|", "factor"];
        self.section.table("how x and its residual change over the sweeps", &columns, lines);
    }
}

impl Observer for Sweeps<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        self.x = iterate.x.to_vec();
        self.sweeps = iterate.iteration;
        if iterate.event == Event::Start {
            self.section.say(format!(
                "The start is x = {}.",
                with_unit(&vector(iterate.x), &self.reading.units.of_x())
            ));
        } else if iterate.iteration <= IN_FULL {
            self.finish_sweep();
        }
        let residual = merit::natural_residual(self.reading.lcp, iterate.x);
        let record = (iterate.iteration, self.x.clone(), residual);
        if iterate.iteration <= LISTED {
            self.listed.push(record);
        } else {
            self.last = Some(record);
        }
        ControlFlow::Continue(())
    }

    fn wants_details(&self) -> bool {
        self.sweeps < IN_FULL
    }

    fn part(&mut self, part: &StepDetail<'_>) {
        if let StepDetail::Row(own) = part {
            let line = self.line(own);
            self.lines.push(line);
            self.x[own.row] = own.after;
        }
    }
}

impl Scribe for Sweeps<'_> {
    fn section(mut self: Box<Self>, _: &Solution) -> Section {
        if !self.listed.is_empty() {
            self.list();
        }
        self.section
    }
}
