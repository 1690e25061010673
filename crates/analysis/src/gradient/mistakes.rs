//! The mistakes that [`compare`](super::Gradient::compare) knows: matrices dx/db with a mistake.

use dashu_ratio::RBig;

use super::active::{Change, RowState, Rows};
use super::linear::{number, solve};
use super::theirs::{Fault, Table, Theirs};
use super::{Gradient, listed};
use lcplab_lcp::Lcp;
use lcplab_page::number::readable;
use lcplab_solver::{Options, Start, solve_boxed_by_sequence};

/// An active set that a matrix shows.
pub(super) struct ActiveSet {
    /// Rows that are not free, but have columns that are not 0.
    pub extra: Vec<usize>,
    /// Free rows with columns of zeros.
    pub missing: Vec<usize>,
    /// The derivatives with this set, by what the other rows do.
    pub tables: Vec<Table>,
}

impl Gradient {
    /// The derivatives with the active set that the columns of a matrix show.
    pub(super) fn shown_set(&self, d: &Table) -> ActiveSet {
        let rows = &self.rows;
        let n = rows.len();
        let own: Vec<usize> = rows.free();
        let largest = places(d).map(|(i, j)| d[i][j].abs()).fold(0.0, f64::max);
        let is_used = |&j: &usize| (0..n).any(|i| d[i][j].abs() > 1e-9 * largest);
        let used: Vec<usize> = (0..n).filter(is_used).collect();
        let without = |of: &[usize], others: &[usize]| -> Vec<usize> {
            of.iter().copied().filter(|i| !others.contains(i)).collect()
        };
        let (extra, missing) = (without(&used, &own), without(&own, &used));
        // Rows that are not free any more stay where they are, or slide on the nearer bound;
        // friction rows of an open contact that is taken as free follow it, or stay at 0.
        let state = |i: usize, slides: bool, follows: bool| {
            let is_of_extra = rows.normal[i].is_some_and(|k| extra.contains(&k));
            match rows.states[i] {
                _ if used.contains(&i) => RowState::Free,
                RowState::Free if slides && rows.x[i] < RBig::ZERO => RowState::Lower,
                RowState::Free if slides && rows.normal[i].is_some() => RowState::Upper,
                RowState::Free => RowState::Held,
                _ if !follows && is_of_extra => RowState::Held,
                RowState::WeakLower => RowState::Lower,
                RowState::WeakUpper => RowState::Upper,
                RowState::WeakBoth => RowState::Held,
                own => own,
            }
        };
        let table = |(slides, follows): (bool, bool)| {
            let changed = rows.with_states((0..n).map(|i| state(i, slides, follows)).collect());
            table(&changed, &changed, &used)
        };
        let variants = [(false, true), (true, true), (false, false), (true, false)];
        let tables = variants.into_iter().filter_map(table).collect();
        ActiveSet { extra, missing, tables }
    }

    /// At a kink, also up to rounding: whether the matrix is a derivative on one of its sides.
    pub(super) fn side_of_kink(
        &self,
        d: &Table,
        sides: [&Table; 2],
        tolerance: f64,
    ) -> Option<Fault> {
        let loose = [self.rows.weak(), self.rows.near.clone()].concat();
        let set = self.shown_set(d);
        let is_side = || {
            let is_known = set.extra.iter().chain(&set.missing).all(|i| loose.contains(i));
            is_known && set.tables.iter().any(|table| is_near(d, table, tolerance))
        };
        let is_one = !loose.is_empty() && (is_between(d, sides, tolerance) || is_side());
        is_one.then(|| {
            let text = format!(
                "x has a kink at {}; theirs belongs to one of its sides, or lies between both",
                listed(&loose)
            );
            ("one-sided", text)
        })
    }

    /// Derivatives without the coupling of friction, in the equations alone or also in x.
    pub(super) fn uncoupled(&self) -> Vec<(Vec<Fault>, Table)> {
        let (rows, own) = (&self.rows, self.rows.free());
        let mut all = Vec::new();
        let uncoupled = |i: usize| match rows.normal[i] {
            Some(_) if rows.states[i] != RowState::Free => RowState::Held,
            _ => rows.states[i],
        };
        let uncoupled = rows.with_states((0..rows.len()).map(uncoupled).collect());
        let text = "the bounds ±μ x_k of friction rows are differentiated as constants";
        for output in [&uncoupled, rows] {
            let table = table(&uncoupled, output, &own);
            all.extend(table.map(|table| (vec![("no-coupling", text.into())], table)));
        }
        all
    }

    /// The error that finite differences of step h have: of a step across a kink, or of rounding.
    pub(super) fn of_step(&self, theirs: &Theirs, right: &Table, h: f64) -> Option<Fault> {
        let d = &theirs.dx_db;
        let n = self.rows.len();
        let solved = |j: usize, step: f64| {
            let b = (0..n).map(|i| self.lcp.b()[i] + if i == j { step } else { 0.0 }).collect();
            let moved = self.lcp.with_b(b).ok()?;
            let (start, options) = (Start::default(), Options::default());
            Some(solve_boxed_by_sequence(&moved, &start, &options, &mut ()).solution.x)
        };
        let x: Vec<f64> = self.rows.x.iter().map(number).collect();
        let mut quotients = [vec![vec![0.0; n]; n], vec![vec![0.0; n]; n], vec![vec![0.0; n]; n]];
        for j in 0..n {
            let (ahead, back) = (solved(j, h)?, solved(j, -h)?);
            for i in 0..n {
                quotients[0][i][j] = (ahead[i] - x[i]) / h;
                quotients[1][i][j] = (x[i] - back[i]) / h;
                quotients[2][i][j] = (ahead[i] - back[i]) / (2.0 * h);
            }
        }
        let step = readable(h, 2);
        // Quotients that are not the derivative although they are exact.
        if quotients.iter().any(|own| is_near(d, own, theirs.tolerance)) {
            let text =
                format!("finite differences across a kink: it is nearer than the step {step}");
            return Some(("finite-differences", text));
        }
        let size = x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let error = places(d).map(|(i, j)| (d[i][j] - right[i][j]).abs()).fold(0.0, f64::max);
        [(f64::EPSILON, "double"), (f64::from(f32::EPSILON), "single")].into_iter().find_map(
            |(unit, precision)| {
                (error <= 16.0 * unit * size / h).then(|| {
                    let text = format!(
                        "the error {} is that of rounding in {precision} precision, divided by the step {step}: \
                         take a larger step",
                        readable(error, 2)
                    );
                    ("finite-differences", text)
                })
            },
        )
    }
}

/// dx/db with the equations of some rows, where `output` decides which rows follow their normal
/// rows.
pub(super) fn table(equations: &Rows, output: &Rows, free: &[usize]) -> Option<Table> {
    let (n, m) = (equations.len(), free.len());
    let unit = |c: usize| (0..m).map(|r| if r == c { -RBig::ONE } else { RBig::ZERO }).collect();
    let columns: Vec<Vec<RBig>> = (0..m).map(unit).collect();
    let columns = solve(&equations.matrix(free, free), &columns)?;
    let mut table = vec![vec![0.0; n]; n];
    let change = Change::none(n);
    for (&j, column) in free.iter().zip(columns) {
        let mut y = vec![RBig::ZERO; n];
        free.iter().zip(column).for_each(|(&i, own)| y[i] = own);
        let y = output.completed(&change, y);
        y.iter().enumerate().for_each(|(i, y)| table[i][j] = number(y));
    }
    Some(table)
}

/// Matrices made from the right one by a mistake of layout.
pub(super) fn shapes(right: &Table) -> Vec<(Vec<Fault>, Table)> {
    let n = right.len();
    let map = |at: &dyn Fn(usize, usize) -> (usize, usize)| -> Table {
        let entry = |i, j| {
            let (k, l) = at(i, j);
            right[k][l]
        };
        (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect()
    };
    let mut all = vec![(Vec::new(), right.clone())];
    let text = "rows and columns are exchanged: entry (i, j) is dx_j/db_i";
    all.push((vec![("transposed", text.into())], map(&|i, j| (j, i))));
    for size in [2, 3, 6].into_iter().filter(|size| n.is_multiple_of(*size) && n > *size) {
        let inner = |i: usize, j: usize| (i - i % size + j % size, j - j % size + i % size);
        let outer = |i: usize, j: usize| (j - j % size + i % size, i - i % size + j % size);
        let text = format!("each block of {size} × {size} entries is transposed in its place");
        all.push((vec![("transposed-blocks", text)], map(&inner)));
        let text = format!(
            "the blocks of {size} × {size} entries are exchanged across the diagonal, but not transposed"
        );
        all.push((vec![("transposed-blocks", text)], map(&outer)));
    }
    all
}

/// The fault of an active set with other free rows.
pub(super) fn set_fault(lcp: &Lcp, extra: &[usize], missing: &[usize]) -> Fault {
    let is_equation = |&i: &usize| {
        !lcp.is_coupled(i) && lcp.lo()[i] == f64::NEG_INFINITY && lcp.hi()[i] == f64::INFINITY
    };
    match (extra, missing) {
        (extra, []) => {
            let text = format!("{}, at a bound, differentiated as if free", listed(extra));
            ("clamped-as-free", text)
        }
        ([], missing) if missing.iter().all(is_equation) => {
            let text = format!("{}, equations of a joint or weld, left out", listed(missing));
            ("missing-constraint", text)
        }
        ([], missing) => {
            let text = format!(
                "{}, strictly between the bounds, differentiated as if at a bound",
                listed(missing)
            );
            ("free-as-clamped", text)
        }
        (extra, missing) => {
            let text = format!(
                "another active set: {} as if free, {} as if at a bound",
                listed(extra),
                listed(missing)
            );
            ("active-set", text)
        }
    }
}

/// The faults, if the given matrix is a multiple of this one, or has rows of zeros instead.
pub(super) fn explained(
    d: &Table,
    own: &Table,
    faults: Vec<Fault>,
    tolerance: f64,
    dt: Option<f64>,
) -> Vec<Vec<Fault>> {
    let is_zero =
        |&i: &usize| d[i].iter().all(|&entry| entry == 0.0) && own[i].iter().any(|&e| e != 0.0);
    let zero: Vec<usize> = (0..d.len()).filter(is_zero).collect();
    let mut kept = own.clone();
    for &i in &zero {
        kept[i].iter_mut().for_each(|entry| *entry = 0.0);
    }
    let symmetric = {
        let mut both = kept.clone();
        both.iter_mut().for_each(|row| zero.iter().for_each(|&j| row[j] = 0.0));
        both
    };
    let mut all = Vec::new();
    for (table, is_cut) in [(own, false), (&kept, true), (&symmetric, true)] {
        if is_cut && zero.is_empty() {
            continue;
        }
        let (mut product, mut square) = (0.0, 0.0);
        for (i, j) in places(d) {
            product += d[i][j] * table[i][j];
            square += table[i][j] * table[i][j];
        }
        let factor = product / square;
        let scaled = table.iter().map(|row| row.iter().map(|own| factor * own).collect()).collect();
        if factor == 0.0 || !factor.is_finite() || !is_near(d, &scaled, tolerance) {
            continue;
        }
        let mut faults = faults.clone();
        if is_cut {
            let text = format!(
                "{} of the matrix are 0, as if their constraint had no force",
                listed(&zero)
            );
            faults.push(("missing-constraint", text));
        }
        faults.extend(factor_fault(factor, tolerance, dt));
        if !faults.is_empty() {
            all.push(faults);
        }
    }
    all
}

/// A sign or a factor, compared with the time step.
fn factor_fault(factor: f64, tolerance: f64, dt: Option<f64>) -> Vec<Fault> {
    let is = |other: f64| (factor.abs() - other).abs() <= tolerance * other;
    let mut faults: Vec<Fault> = Vec::new();
    if factor < 0.0 {
        faults.push(("sign", "the sign is reversed".into()));
    }
    if !is(1.0) {
        let names = dt.map(|dt| {
            [
                (dt, "the time step"),
                (1.0 / dt, "1 / time step"),
                (dt * dt, "the time step squared"),
                (1.0 / (dt * dt), "1 / time step squared"),
            ]
        });
        let name = names.into_iter().flatten().find(|(value, _)| is(*value));
        let name = name.map(|(_, name)| format!(", {name}")).unwrap_or_default();
        let text = format!("all entries are multiplied by {}{name}", readable(factor.abs(), 5));
        faults.push(("factor", text));
    }
    faults
}

pub(super) fn places(table: &Table) -> impl Iterator<Item = (usize, usize)> {
    let n = table.len();
    (0..n).flat_map(move |i| (0..n).map(move |j| (i, j)))
}

/// Whether two matrices agree, entry by entry, relative to the largest entry of the row and column.
pub(super) fn is_near(d: &Table, own: &Table, tolerance: f64) -> bool {
    let n = own.len();
    let row = |i: usize| (0..n).map(|j| own[i][j].abs()).fold(0.0, f64::max);
    let column = |j: usize| (0..n).map(|i| own[i][j].abs()).fold(0.0, f64::max);
    let (rows, columns): (Vec<f64>, Vec<f64>) = (0..n).map(|k| (row(k), column(k))).unzip();
    let largest = rows.iter().copied().fold(0.0, f64::max);
    places(own).all(|(i, j)| {
        let size = match f64::max(rows[i], columns[j]) {
            0.0 => largest,
            size => size,
        };
        (d[i][j] - own[i][j]).abs() <= tolerance * size
    })
}

/// Whether each column lies between those of two matrices.
fn is_between(d: &Table, [right, left]: [&Table; 2], tolerance: f64) -> bool {
    let n = d.len();
    let mut nearest = right.clone();
    for j in 0..n {
        let (mut product, mut square) = (0.0, 0.0);
        for i in 0..n {
            let way = left[i][j] - right[i][j];
            product += way * (d[i][j] - right[i][j]);
            square += way * way;
        }
        let part = if square > 0.0 { (product / square).clamp(0.0, 1.0) } else { 0.0 };
        for i in 0..n {
            nearest[i][j] += part * (left[i][j] - right[i][j]);
        }
    }
    is_near(d, &nearest, tolerance)
}
