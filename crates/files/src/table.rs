//! A table of numbers from a file, before its role in the problem is known.

use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::{Entries, Parts};

/// Limit on the rows of a sparse table that is converted to a dense vector.
const MOST_ROWS: usize = 10_000_000;

/// A table of numbers.
pub(super) struct Table {
    pub rows: usize,
    pub cols: usize,
    pub entries: Entries,
}

impl Table {
    /// The entries, if it is n × n.
    pub fn square(self, n: usize, input: &str) -> Result<Entries> {
        let Table { rows, cols, entries } = self;
        if (rows, cols) == (n, n) {
            return Ok(entries);
        }
        Err(Error::invalid(input, "A", format!("is {rows} × {cols}, b has {n} rows")))
    }

    /// The nonzero entries: row, column and value.
    pub fn triplets(self) -> Vec<(usize, usize, f64)> {
        let cols = self.cols;
        let mut triplets: Vec<_> = match self.entries {
            Entries::Sparse(triplets) => triplets,
            Entries::Dense(values) => {
                values.into_iter().enumerate().map(|(k, v)| (k / cols, k % cols, v)).collect()
            }
        };
        triplets.retain(|(_, _, value)| *value != 0.0);
        triplets
    }

    /// The numbers, if the table has one column.
    pub fn vector(self, input: &str) -> Result<Vec<f64>> {
        let Table { rows, cols, entries } = self;
        if cols != 1 {
            let reason = format!("must have one column, is {rows} × {cols}");
            return Err(Error::invalid(input, "size", reason));
        }
        match entries {
            Entries::Dense(values) => Ok(values),
            Entries::Sparse(_) if rows > MOST_ROWS => {
                let reason = format!("has {rows} rows, more than {MOST_ROWS}");
                Err(Error::invalid(input, "size", reason))
            }
            Entries::Sparse(triplets) => {
                let mut values = vec![0.0; rows];
                for (i, _, value) in triplets {
                    values[i] += value;
                }
                Ok(values)
            }
        }
    }
}

/// The entries by rows, from the entries by columns.
pub(super) fn by_rows(rows: usize, cols: usize, by_columns: &[f64]) -> Vec<f64> {
    (0..rows * cols).map(|k| by_columns[k / cols + k % cols * rows]).collect()
}

/// The parts of a problem stored under their names: A, b and, if present, lo, hi, mu and
/// friction_index, −1 for none.
pub(super) fn parts(
    matrix: Table,
    vector: impl Fn(&str) -> Result<Option<Vec<f64>>>,
    input: &str,
) -> Result<Parts> {
    let b = vector("b")?.ok_or_else(|| Error::invalid(input, "b", "is missing"))?;
    let index = vector("friction_index")?.map(|index| {
        let index = index.into_iter().enumerate().map(|(i, k)| row_index(i, k, input));
        index.collect::<Result<Vec<_>>>()
    });
    Ok(Parts {
        entries: matrix.square(b.len(), input)?,
        lo: vector("lo")?,
        hi: vector("hi")?,
        index: index.transpose()?,
        mu: vector("mu")?,
        b,
    })
}

fn row_index(i: usize, k: f64, input: &str) -> Result<Option<usize>> {
    match k {
        -1.0 => Ok(None),
        k if k >= 0.0 && k.fract() == 0.0 && k < 2f64.powi(53) => Ok(Some(k as usize)),
        _ => {
            let reason = format!("must be a row index or -1, is {k}");
            Err(Error::invalid(input, format!("friction_index[{i}]"), reason))
        }
    }
}
