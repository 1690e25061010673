//! Explains Lemke's method: the tableaux, the entering and leaving variables, and the ratios that
//! decide.

use std::ops::ControlFlow;

use super::answer::Reading;
use super::solve::{self, Scribe};
use lcplab_lcp::Lcp;
use lcplab_lcp::number::counted;
use lcplab_page::document::notation::{exact, indexed};
use lcplab_page::document::{Block, Formula, SHOWN, Section, Table};
use lcplab_solver::{Iterate, Leaving, Observer, Solution, StepDetail, Tableau, Variable};

pub(super) struct Tableaux<'a> {
    reading: &'a Reading<'a>,
    section: Section,
    tableaux: usize,
    /// Rounds of frozen bounds.
    rounds: usize,
    /// The problem with its frozen bounds.
    lcp: Lcp,
}

impl<'a> Tableaux<'a> {
    pub fn of(reading: &'a Reading<'a>) -> Self {
        let lcp = reading.lcp.clone();
        let mut section = Section::new("Lemke's method, tableau by tableau");
        if !reading.is_again {
            introduce(&mut section, &lcp);
        }
        Tableaux { reading, section, tableaux: 0, rounds: 0, lcp }
    }

    fn name(&self, variable: Variable) -> String {
        let is_distance = |i: usize| self.lcp.lo()[i].is_finite() && self.lcp.lo()[i] != 0.0;
        match variable {
            Variable::Y(i) if is_distance(i) || self.lcp.hi()[i].is_finite() => indexed("y", i),
            Variable::Y(i) => indexed("x", i),
            Variable::W(i) => indexed("w", i),
            Variable::V(i) => indexed("v", i),
            Variable::T(i) => indexed("t", i),
            Variable::Cover => "z".into(),
        }
    }

    fn write(&mut self, own: &Tableau<'_>) {
        let rows = chosen(own.pairs, leaving_row(own));
        let columns = chosen(own.nonbasic.len(), own.entering);
        let heading = |&c: &usize| self.name(own.nonbasic[c]);
        let headings = ["basic", "value"].map(String::from).into_iter();
        let ratios = own.entering.is_some().then(|| "ratio".to_string());
        let line = |&r: &usize| {
            let own_cells = [self.name(own.basic[r]), exact(own.constant[r])];
            let is_pivot = |c: usize| own.entering == Some(c) && leaving_row(own) == Some(r);
            let entries = columns.iter().map(|&c| match is_pivot(c) {
                true => format!("[{}]", exact(own.rows[r][c])),
                false => exact(own.rows[r][c]),
            });
            own_cells
                .into_iter()
                .chain(entries)
                .chain(ratios.is_some().then(|| ratio(own, r)))
                .collect()
        };
        let table = Table {
            title: format!("tableau {}: {}", self.tableaux, self.step(own)),
            rows: rows.iter().map(line).collect(),
            columns: headings.chain(columns.iter().map(heading)).chain(ratios.clone()).collect(),
            left_out: own.pairs - rows.len(),
            chosen: leaving_row(own).and_then(|leaving| rows.iter().position(|r| *r == leaving)),
            keeps_columns: true,
        };
        self.section.blocks.push(Block::Table(table));
        let more = own.nonbasic.len() - columns.len();
        if more > 0 {
            self.section.say(format!("Not shown: {}.", counted(more, "column")));
        }
    }

    /// The pivot of a tableau.
    fn step(&self, own: &Tableau<'_>) -> String {
        match (own.entering.map(|c| own.nonbasic[c]), own.leaving) {
            (Some(entering), Some(Leaving::Basic(r))) => {
                format!("{} enters, {} leaves", self.name(entering), self.name(own.basic[r]))
            }
            (Some(entering), Some(Leaving::Mirrored)) => {
                format!("{} enters and reaches its other bound", self.name(entering))
            }
            (Some(entering), None) => {
                format!("{} enters, and no variable reaches 0: a ray", self.name(entering))
            }
            (None, _) => "z is 0: solved".into(),
        }
    }
}

/// What the method does, and how a tableau is read.
fn introduce(section: &mut Section, lcp: &Lcp) {
    section.say(
        "A covering variable z makes every w nonnegative. Each tableau expresses the basic variables by the \
         others, which are 0. z enters first and increases until no w is negative: the largest ratio, \
         −value / entry in the column of z. Then the complement of the variable that has just left \
         enters, and increases until a basic variable reaches 0: the smallest ratio, −value / entry in \
         its column. When z leaves, x is the solution. ← marks the leaving variable, brackets the pivot. \
         In a tie z leaves first; other ties are broken lexicographically.",
    );
    section.formula(Formula::default().symbols(
        "w = A x + b + z e,   x, w, z ≥ 0,   xᵢ wᵢ = 0",
        "w = A x + b + z e, \\qquad x, w, z \\ge 0, \\qquad x_i w_i = 0",
    ));
    let is_standard = |i: usize| lcp.lo()[i] == 0.0 && lcp.hi()[i] == f64::INFINITY;
    if !(0..lcp.len()).all(is_standard) {
        section.say(
            "Rows with bounds other than 0 and ∞ are transformed to this form: y is the distance of x \
             from one bound, t its distance from the other bound, and v the multiplier of the other bound. Rows \
             without bounds are eliminated first. If both bounds are finite, t is y measured from the \
             other bound, and v is −w. The tableau then has one variable of each pair, and y or t must not exceed \
             the distance between the bounds.",
        );
    }
}

/// The row of the leaving variable, if it has one.
fn leaving_row(own: &Tableau<'_>) -> Option<usize> {
    match own.leaving {
        Some(Leaving::Basic(r)) => Some(r),
        Some(Leaving::Mirrored) | None => None,
    }
}

/// The first of this number of rows or columns, including one that is required.
fn chosen(count: usize, wanted: Option<usize>) -> Vec<usize> {
    let mut chosen: Vec<usize> = (0..count.min(SHOWN)).collect();
    if let (Some(last), Some(wanted)) = (chosen.last_mut(), wanted) {
        *last = (*last).max(wanted);
    }
    chosen
}

/// How far the entering variable can go before the variable of row r reaches 0, or the end of its
/// range if it rises; for the covering variable, how far it must go until that variable is
/// nonnegative.
fn ratio(own: &Tableau<'_>, r: usize) -> String {
    let Some(c) = own.entering else { return String::new() };
    let (value, rate, range) = (own.constant[r], own.rows[r][c], own.ranges[r]);
    let (value, divisor) = match own.nonbasic[c] {
        Variable::Cover => (-value, rate),
        _ if rate > 0.0 && range.is_finite() => (range - value, rate),
        _ => (value, -rate),
    };
    if divisor <= 0.0 {
        return String::new();
    }
    let mark = if leaving_row(own) == Some(r) { " ←" } else { "" };
    exact(value / divisor) + mark
}

impl Observer for Tableaux<'_> {
    fn observe(&mut self, _: &Iterate<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn wants_details(&self) -> bool {
        true
    }

    fn part(&mut self, part: &StepDetail<'_>) {
        match part {
            StepDetail::Frozen(lcp) => {
                self.rounds += 1;
                self.lcp = (*lcp).clone();
                if self.tableaux < SHOWN {
                    solve::frozen(&mut self.section, self.reading, self.rounds, lcp);
                }
            }
            StepDetail::Tableau(own) => {
                self.tableaux += 1;
                if self.tableaux <= SHOWN {
                    self.write(own);
                }
            }
            _ => {}
        }
    }
}

impl Scribe for Tableaux<'_> {
    fn section(mut self: Box<Self>, _: &Solution) -> Section {
        if self.tableaux == 0 {
            self.section.say("No w is negative at x = 0, so x = 0 is the solution.");
        }
        if self.tableaux > SHOWN {
            self.section.say(format!("{} more tableaux follow.", self.tableaux - SHOWN));
        }
        self.section
    }
}
