//! The variables of a MATLAB file, each a matrix of real numbers.

use super::fault;
use crate::table::{Table, by_rows};
use lcplab_lcp::error::Result;
use lcplab_lcp::file::Entries;

/// The variables of a file, in its order.
pub(super) struct Variables {
    pub all: Vec<(String, Table)>,
}

impl Variables {
    /// Removes a variable and returns it, if the file has it.
    pub fn take(&mut self, name: &str) -> Option<Table> {
        let place = self.all.iter().position(|(own, _)| own == name)?;
        Some(self.all.remove(place).1)
    }

    pub fn has(&self, name: &str) -> bool {
        self.all.iter().any(|(own, _)| own == name)
    }
}

/// A dense matrix from its numbers by columns.
pub(super) fn dense(
    [rows, cols]: [usize; 2],
    by_columns: &[f64],
    input: &str,
    name: &str,
) -> Result<Table> {
    if rows.checked_mul(cols) != Some(by_columns.len()) {
        let reason = format!("has {} numbers, is {rows} × {cols}", by_columns.len());
        return Err(fault(input, name, reason));
    }
    Ok(Table { rows, cols, entries: Entries::Dense(by_rows(rows, cols, by_columns)) })
}

/// A sparse matrix in compressed columns: the row of each number, and where each column begins.
pub(super) fn sparse(
    [rows, cols]: [usize; 2],
    row_of: &[usize],
    starts: &[usize],
    values: &[f64],
    input: &str,
    name: &str,
) -> Result<Table> {
    let count = starts.last().copied().unwrap_or(0);
    let is_ascending = starts.windows(2).all(|pair| pair[0] <= pair[1]);
    let spans = starts.first() == Some(&0) && starts.len().checked_sub(1) == Some(cols);
    // MATLAB may reserve places behind the last number.
    let fits = count <= values.len() && count <= row_of.len();
    if !is_ascending || !spans || !fits || row_of[..count].iter().any(|&i| i >= rows) {
        let reason =
            format!("{rows} × {cols}: ir and jc do not determine the places of the numbers");
        return Err(fault(input, name, reason));
    }
    let column = |(j, pair): (usize, &[usize])| (pair[0]..pair[1]).map(move |k| (k, j));
    let places = starts.windows(2).enumerate().flat_map(column);
    let entries = places.map(|(k, j)| (row_of[k], j, values[k])).collect();
    Ok(Table { rows, cols, entries: Entries::Sparse(entries) })
}
