//! The problem that the variables of a MATLAB file state.

use std::collections::HashMap;

use super::fault;
use super::variables::Variables;
use crate::delassus::is_symmetric;
use crate::multipliers::{Multipliers, Row, label, limit};
use crate::table::{Table, parts};
use lcplab_lcp::error::Result;
use lcplab_lcp::file::{Entries, Parts, Problem};
use lcplab_lcp::number::counted;

/// The variables of a quadratic program with constraints between two limits.
const BETWEEN: [&str; 8] = ["P", "q", "A", "l", "u", "r", "n", "m"];
/// Those of one with inequalities, equations and bounds.
const SEPARATE: [&str; 8] = ["P", "q", "G", "h", "A", "b", "lb", "ub"];
/// Those of an LCP.
const LCP: [&str; 6] = ["A", "b", "lo", "hi", "friction_index", "mu"];

/// The problem of these variables.
pub(super) fn problem(mut variables: Variables, name: String, input: &str) -> Result<Problem> {
    let is_program = variables.has("P") || variables.has("q");
    let is_between = variables.has("l") || variables.has("u");
    let known: &[&str] = match (is_program, is_between) {
        (true, true) => &BETWEEN,
        (true, false) => &SEPARATE,
        (false, _) => &LCP,
    };
    if let Some((other, _)) = variables.all.iter().find(|(own, _)| !known.contains(&own.as_str())) {
        let reason =
            format!("is not understood: the variables of this file may be {}", known.join(", "));
        return Err(fault(input, other, reason));
    }
    let mut reader = Reader { variables: &mut variables, input };
    match (is_program, is_between) {
        (true, true) => reader.between()?.problem(name, input),
        (true, false) => reader.separate()?.problem(name, input),
        (false, _) => {
            let lcp = reader.lcp()?.into_lcp().map_err(|error| error.within(input))?;
            Ok(Problem::new(name, lcp))
        }
    }
}

/// Limits below this fraction of the largest one are probably rounding errors of a zero: programs
/// are solved to 1e-8 or so.
const ROUNDING: f64 = 1e-12;

/// A quadratic program: min ½ xᵀP x + qᵀx with rows and bounds.
struct Program {
    p: Vec<(usize, usize, f64)>,
    q: Vec<f64>,
    lo: Vec<f64>,
    hi: Vec<f64>,
    rows: Vec<Row>,
}

impl Program {
    /// The conditions of its minimum.
    fn problem(self, name: String, input: &str) -> Result<Problem> {
        let n = self.q.len();
        let added = Multipliers::of(&self.rows, n);
        let parts = Parts {
            entries: Entries::Sparse([self.p, added.entries].concat()),
            b: [self.q, added.b].concat(),
            lo: Some([self.lo, added.lo].concat()),
            hi: Some([self.hi, added.hi].concat()),
            index: None,
            mu: None,
        };
        let mut problem = Problem::new(name, parts.into_lcp().map_err(|e| e.within(input))?);
        problem.extra.insert("objective".into(), true.into());
        problem.warnings.extend(rounding(&self.rows).map(|reason| format!("{input}: {reason}")));
        if !added.labels.is_empty() {
            let columns = (0..n).map(|j| label(&format!("x[{j}]"), "column"));
            problem.extra.insert("rows".into(), columns.chain(added.labels).collect());
        }
        Ok(problem)
    }
}

/// A warning about rows whose limits are rounding errors: no x satisfies such a row relative to the
/// row's own size if all its other terms are 0.
fn rounding(rows: &[Row]) -> Option<String> {
    let size = |row: &Row| -> f64 {
        let finite = row.limits.iter().filter(|limit| limit.is_finite());
        finite.fold(0.0, |most, limit| most.max(limit.abs()))
    };
    let largest = rows.iter().map(size).fold(0.0, f64::max);
    let is_rounding = |row: &&Row| size(row) > 0.0 && size(row) < ROUNDING * largest;
    let first = rows.iter().find(is_rounding)?;
    let count = counted(rows.iter().filter(is_rounding).count(), "row");
    Some(format!(
        "{count} with limits that are probably rounding errors of 0, such as {:.1e} of {}; \
         a problem with the key \"scale\" states the smallest significant size of x",
        size(first),
        first.name
    ))
}

/// Takes variables from a file.
struct Reader<'a> {
    variables: &'a mut Variables,
    input: &'a str,
}

impl Reader<'_> {
    /// A program with l ≤ A x ≤ u.
    fn between(&mut self) -> Result<Program> {
        let mut program = self.objective()?;
        let n = program.q.len();
        let matrix = self.required("A")?;
        let (l, u) = (self.limits("l", matrix.rows)?, self.limits("u", matrix.rows)?);
        for (name, size) in [("n", n), ("m", matrix.rows)] {
            if let Some(stated) = self.number(name)?.filter(|stated| *stated != size as f64) {
                let reason = format!("is {stated}, but the sizes of the others make it {size}");
                return Err(fault(self.input, name, reason));
            }
        }
        self.number("r")?;
        for row in self.rows(matrix, "A", n, |i| [l[i], u[i]])? {
            let [least, most] = row.limits;
            match row.entries[..] {
                [(j, 1.0)] => {
                    program.lo[j] = program.lo[j].max(least);
                    program.hi[j] = program.hi[j].min(most);
                }
                _ => program.rows.push(row),
            }
        }
        Ok(program)
    }

    /// A program with G x ≤ h, A x = b and bounds.
    fn separate(&mut self) -> Result<Program> {
        let mut program = self.objective()?;
        let n = program.q.len();
        for (name, right) in [("G", "h"), ("A", "b")] {
            if !self.variables.has(name) && !self.variables.has(right) {
                continue;
            }
            let matrix = self.required(name)?;
            let right = self.limits(right, matrix.rows)?;
            let least = |i: usize| if name == "A" { right[i] } else { f64::NEG_INFINITY };
            program.rows.extend(self.rows(matrix, name, n, |i| [least(i), right[i]])?);
        }
        if self.variables.has("lb") {
            program.lo = self.limits("lb", n)?;
        }
        if self.variables.has("ub") {
            program.hi = self.limits("ub", n)?;
        }
        Ok(program)
    }

    /// P and q, without constraints.
    fn objective(&mut self) -> Result<Program> {
        let q = self.required("q")?;
        let q = self.vector("q", q)?;
        let matrix = self.required("P")?;
        let n = q.len();
        if (matrix.rows, matrix.cols) != (n, n) {
            let reason = format!("is {} × {}, q has {n} entries", matrix.rows, matrix.cols);
            return Err(fault(self.input, "P", reason));
        }
        let p = matrix.triplets();
        if !is_symmetric(&p) {
            let reason = "is not symmetric: all of P is required, not one triangle";
            return Err(fault(self.input, "P", reason));
        }
        let (lo, hi) = (vec![f64::NEG_INFINITY; n], vec![f64::INFINITY; n]);
        Ok(Program { p, q, lo, hi, rows: Vec::new() })
    }

    fn lcp(&mut self) -> Result<Parts> {
        let matrix = self.required("A")?;
        let mut vectors = HashMap::new();
        for name in &LCP[1..] {
            if let Some(table) = self.variables.take(name) {
                vectors.insert(*name, self.vector(name, table)?);
            }
        }
        parts(matrix, |name| Ok(vectors.get(name).cloned()), self.input)
    }

    /// The rows of a matrix of constraints.
    fn rows(
        &self,
        matrix: Table,
        name: &str,
        n: usize,
        limits: impl Fn(usize) -> [f64; 2],
    ) -> Result<Vec<Row>> {
        let (count, columns) = (matrix.rows, matrix.cols);
        if count > 0 && columns != n {
            let reason = format!("is {count} × {columns}, q has {n} entries");
            return Err(fault(self.input, name, reason));
        }
        let row = |i| Row { name: format!("{name}[{i}]"), entries: Vec::new(), limits: limits(i) };
        let mut rows: Vec<Row> = (0..count).map(row).collect();
        let mut triplets = matrix.triplets();
        triplets.sort_by_key(|(i, j, _)| (*i, *j));
        triplets.into_iter().for_each(|(i, j, value)| rows[i].entries.push((j, value)));
        Ok(rows)
    }

    fn required(&mut self, name: &str) -> Result<Table> {
        self.variables.take(name).ok_or_else(|| fault(self.input, name, "is missing"))
    }

    /// `count` limits that some number can meet: a lower one is not ∞, an upper one not −∞, and the
    /// value of an equation is finite.
    fn limits(&mut self, name: &str, count: usize) -> Result<Vec<f64>> {
        let table = self.required(name)?;
        let limits = self.vector(name, table)?;
        if limits.len() != count {
            let reason = format!("has {} entries, must have {count}", limits.len());
            return Err(fault(self.input, name, reason));
        }
        let is_lower = matches!(name, "l" | "lb" | "b");
        let is_upper = !matches!(name, "l" | "lb");
        let is_impossible = |value: &f64| match limit(*value) {
            f64::INFINITY => is_lower,
            f64::NEG_INFINITY => is_upper,
            value => value.is_nan(),
        };
        if let Some(i) = limits.iter().position(is_impossible) {
            let reason = format!("is {}, which no number can meet", limits[i]);
            return Err(fault(self.input, &format!("{name}[{i}]"), reason));
        }
        Ok(limits.into_iter().map(limit).collect())
    }

    /// A number, if the file has it.
    fn number(&mut self, name: &str) -> Result<Option<f64>> {
        let Some(table) = self.variables.take(name) else { return Ok(None) };
        match self.vector(name, table)?[..] {
            [value] => Ok(Some(value)),
            ref other => {
                let reason = format!("must be one number, has {}", other.len());
                Err(fault(self.input, name, reason))
            }
        }
    }

    /// The numbers of a row or a column.
    fn vector(&self, name: &str, table: Table) -> Result<Vec<f64>> {
        let Table { rows, cols, entries } = table;
        if rows.min(cols) > 1 {
            let reason = format!("must be one row or one column, is {rows} × {cols}");
            return Err(fault(self.input, name, reason));
        }
        // A row is read as a column.
        let entries = match entries {
            Entries::Sparse(all) if rows == 1 => {
                Entries::Sparse(all.into_iter().map(|(i, j, value)| (j, i, value)).collect())
            }
            other => other,
        };
        let rows = rows * cols;
        Table { rows, cols: 1, entries }.vector(self.input)
    }
}
