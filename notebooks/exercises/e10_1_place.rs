//! Exercise 10.1: where an entry lies.
//!
//! A dense matrix keeps its numbers in one list, row by row: first all of row 0, then all of row 1.

/// The place in the list of the entry (row, column) of a matrix with so many rows and columns.
pub fn answer(row: usize, column: usize, rows: usize, columns: usize) -> usize {
    todo!()
}
