//! Siconos' `.dat` files: an LCP or a friction problem as a list of numbers.
//!
//! Defined by what Siconos writes: `linearComplementarity_printInFile` and
//! `frictionContact_printInFile` (numerics/src/LCP, numerics/src/FrictionContact), with
//! `NM_write_in_file` and `SBM_write_in_file` (numerics/src/tools) for the matrix.
//!
//! ```text
//! LCP                                      friction, FC3D
//! n                                        3                  (dimension of a contact)
//! matrix n × n                             number of contacts
//! q: n numbers                             matrix n × n, n = 3 times as many
//!                                          q: n numbers
//!                                          mu: a number a contact
//!
//! matrix, dense: storage 0                 matrix, in blocks: storage 1
//! 0 rows columns                           1 rows columns
//! rows columns                             number of blocks, of block rows, of block columns
//! numbers, column by column                where each block row ends, where each block column ends
//!                                          length of the next two lists
//!                                          the first block of each block row, and one more
//!                                          the block column of each block
//!                                          for each block its index and its numbers, by columns
//! ```
//!
//! The LCP is 0 ≤ z ⟂ w = M z + q ≥ 0: A = M, b = q, with bounds 0 and ∞. A friction problem has
//! u = M r + q and r in Coulomb's cone, a contact as n, t1, t2: A = M, b = q, model `coulomb-cone`.
//!
//! Traps: dense matrices and blocks are listed *column by column*; read by rows, the portfolio
//! problems of Cottle, Pang & Stone among Siconos' own tests have no solution. Both kinds of problem
//! end in `.dat`, and nothing says which it is; an LCP repeats its n as rows and columns. Not read are
//! contacts in the plane, storage 2 (a listing of CSparse with six digits) and mixed LCPs (MLCP, whose
//! beginning cannot be told from an LCP's). Written are dense matrices, in the fewest digits that read
//! back as the same bits; a row that is neither 0 ≤ x nor a contact's cannot be written.

use super::contacts::Arrangement;
use super::output::decimal;
use super::table::{Table, by_rows};
use super::words::Words;
use super::{Format, Input, Output};
use lcplab_problem::error::{Error, Result};
use lcplab_problem::file::{Entries, Problem};
use lcplab_problem::friction::Model;
use lcplab_problem::{Coupling, Lcp};

/// Siconos' LCPs and friction problems.
pub const FORMAT: Format = Format {
    name: "siconos",
    about: "Siconos: LCPs and friction problems (FC3D) as lists of numbers",
    endings: &[".dat"],
    in_folder: None,
    beside: &[],
    carries: "bounds 0 and inf, or contacts under Coulomb's law; written densely",
    law: Some(Model::CoulombCone),
    trap: "dense matrices and blocks are listed column by column",
    read,
    write: Some(write),
};

/// Matrices of more rows are not written: n² numbers would not be read by anyone.
const MOST_ROWS: usize = 5000;

fn read(input: &Input) -> Result<Problem> {
    parse(&input.text()?, &input.name(), &input.stem())
}

fn parse(text: &str, input: &str, name: &str) -> Result<Problem> {
    let mut words = Words::new(text, input);
    let first = words.whole("the number of rows")?;
    let second = words.whole("the storage")?;
    let third = words.whole("the number of rows")?;
    let mut problem = if first == third {
        let matrix = matrix(&mut words, second, third)?;
        let b = words.numbers(matrix.rows, "q")?;
        let (lo, hi) = (vec![0.0; b.len()], vec![f64::INFINITY; b.len()]);
        Problem::new(name, lcp(matrix, b, lo, hi, input)?)
    } else {
        friction(&mut words, [first, second, third], input, name)?
    };
    if words.next().is_some() {
        problem.warnings.push(format!("{input}: what follows the problem is ignored"));
    }
    Ok(problem)
}

/// A friction problem after its dimension, its number of contacts and its storage.
fn friction(words: &mut Words, head: [usize; 3], input: &str, name: &str) -> Result<Problem> {
    let [dimension, contacts, storage] = head;
    if dimension != 3 {
        let reason = format!("neither an LCP nor contacts in space: dimension {dimension}");
        return Err(words.fault(reason));
    }
    let rows = words.whole("the number of rows")?;
    let matrix = matrix(words, storage, rows)?;
    if contacts.checked_mul(3) != Some(matrix.rows) {
        return Err(words.fault(format!("{contacts} contacts have not {} rows", matrix.rows)));
    }
    let b = words.numbers(matrix.rows, "q")?;
    let mu = words.numbers(contacts, "mu")?;
    let n = b.len();
    let lo = (0..n).map(|i| if i % 3 == 0 { 0.0 } else { -f64::INFINITY }).collect();
    let lcp = lcp(matrix, b, lo, vec![f64::INFINITY; n], input)?;
    let index = (0..n).map(|i| (i % 3 != 0).then_some(i - i % 3)).collect();
    let mu = (0..n).map(|i| if i % 3 == 0 { 0.0 } else { mu[i / 3] }).collect();
    let coupled = Coupling::new(index, mu).and_then(|coupling| lcp.with_coupling(coupling));
    let lcp = coupled.map_err(|error| error.within(input))?;
    let model = lcp.coupling().map(|_| Model::CoulombCone); // there may be no contacts
    Ok(Problem { model, ..Problem::new(name, lcp) })
}

fn lcp(matrix: Table, b: Vec<f64>, lo: Vec<f64>, hi: Vec<f64>, input: &str) -> Result<Lcp> {
    let matrix = matrix.square(b.len(), input)?.matrix(b.len());
    Lcp::new(matrix, b, lo, hi).map_err(|error| error.within(input))
}

/// A matrix after its storage and its number of rows.
fn matrix(words: &mut Words, storage: usize, rows: usize) -> Result<Table> {
    let cols = words.whole("the number of columns")?;
    match storage {
        0 => dense(words, rows, cols),
        1 => blocks(words, rows, cols),
        _ => {
            Err(words.fault(format!("storage {storage} is not read: only 0, dense, and 1, blocks")))
        }
    }
}

fn dense(words: &mut Words, rows: usize, cols: usize) -> Result<Table> {
    let again = [words.whole("the number of rows")?, words.whole("the number of columns")?];
    if again != [rows, cols] {
        let reason = format!("{} × {} here, {rows} × {cols} before", again[0], again[1]);
        return Err(words.fault(reason));
    }
    let by_columns = words.numbers(rows.saturating_mul(cols), "M")?;
    Ok(Table { rows, cols, entries: Entries::Dense(by_rows(rows, cols, &by_columns)) })
}

fn blocks(words: &mut Words, rows: usize, cols: usize) -> Result<Table> {
    let count = words.whole("the number of blocks")?;
    let across = [words.whole("the number of block rows")?, words.whole("that of block columns")?];
    let row_ends = words.wholes(across[0], "the end of block row ")?;
    let col_ends = words.wholes(across[1], "the end of block column ")?;
    let lengths = [words.whole("the length of a list")?, words.whole("the length of a list")?];
    let first = words.wholes(lengths[0], "the first block of block row ")?;
    let columns = words.wholes(lengths[1], "the block column of block ")?;
    let is_ascending = first.windows(2).all(|pair| pair[0] <= pair[1]);
    if columns.len() != count || !is_ascending || first.last().is_some_and(|end| *end != count) {
        return Err(words.fault(format!("the lists do not tell where {count} blocks are")));
    }
    let mut triplets = Vec::new();
    for (row, pair) in first.windows(2).enumerate() {
        for block in pair[0]..pair[1] {
            if words.whole("the index of a block")? != block {
                return Err(words.fault(format!("must be the index of block {block}")));
            }
            let of = [span(&row_ends, row, rows), span(&col_ends, columns[block], cols)];
            let [Some((top, height)), Some((left, width))] = of else {
                return Err(words.fault(format!("block {block} lies outside {rows} × {cols}")));
            };
            for k in 0..height.saturating_mul(width) {
                let value = words.number(format_args!("block {block}, number {k}"))?;
                if value != 0.0 {
                    triplets.push((top + k % height, left + k / height, value));
                }
            }
        }
    }
    Ok(Table { rows, cols, entries: Entries::Sparse(triplets) })
}

/// Where a block begins and how long it is, from where all of them end.
fn span(ends: &[usize], k: usize, most: usize) -> Option<(usize, usize)> {
    let start = if k == 0 { 0 } else { *ends.get(k - 1)? };
    let end = *ends.get(k)?;
    (start < end && end <= most).then(|| (start, end - start))
}

fn write(problem: &Problem) -> Result<Output> {
    let lcp = &problem.lcp;
    let n = lcp.len();
    if n > MOST_ROWS {
        let reason = format!("has {n} rows; as dense matrices at most {MOST_ROWS} are written");
        return Err(Error::invalid("siconos", "A", reason));
    }
    let is_contact = |i| (lcp.lo()[i], lcp.hi()[i]) == (0.0, f64::INFINITY);
    let (order, mu) = match lcp.coupling() {
        None => match (0..n).find(|i| !is_contact(*i)) {
            None => ((0..n).collect(), None),
            Some(i) => {
                let reason = "has other bounds than 0 and inf: an LCP of Siconos has no others";
                return Err(Error::invalid("siconos", format!("row {i}"), reason));
            }
        },
        Some(_) => {
            let arrangement = Arrangement::of(problem, "siconos")?;
            if let Some(i) = arrangement.equations().first() {
                let reason =
                    "belongs to no contact: a friction problem of Siconos has no other rows";
                return Err(Error::invalid("siconos", format!("row {i}"), reason));
            }
            (arrangement.rows, Some(arrangement.mu))
        }
    };
    let head = match &mu {
        None => format!("{n}\n"),
        Some(mu) => format!("3\n{}\n", mu.len()),
    };
    let mut text = head + &format!("0\n{n}\n{n}\n{n}\t{n}\n");
    for &j in &order {
        text += &line(order.iter().map(|&i| lcp.matrix().entry(i, j)));
    }
    text += &line(order.iter().map(|&i| lcp.b()[i]));
    text += &mu.map(|mu| line(mu.into_iter())).unwrap_or_default();
    let notes = Arrangement::notes(&order);
    Ok(Output { notes, ..Output::of(text) })
}

fn line(values: impl Iterator<Item = f64>) -> String {
    values.map(decimal).collect::<Vec<_>>().join(" ") + "\n"
}
