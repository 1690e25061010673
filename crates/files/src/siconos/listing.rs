//! Sparse matrices: listings by CSparse, which print six digits of each number.
//!
//! ```text
//! 2 rows columns origin                                  storage 2
//! CSparse Version 3.1.9, …
//! triplet: 2-by-2, nzmax: 1 nnz: 1                       2-by-2, nzmax: 1 nnz: 1, 1-norm: 3
//!     0 1 : 3                                                col 0 : locations 0 to -1
//!                                                            col 1 : locations 0 to 0
//!                                                              0 : 3
//! ```
//!
//! The left listing has the row and the column of each number, the right one is by columns, or by
//! rows if its lines say `row`. The number `origin` says which storage the program prefers.

use crate::table::Table;
use crate::words::{Words, brief};
use lcplab_lcp::error::Result;
use lcplab_lcp::file::Entries;

/// Whether a word begins a listing.
pub(super) fn is_head(word: &str) -> bool {
    word.starts_with("CSparse") || word.starts_with("CXSparse")
}

/// Reads a listing, from `origin` on.
pub(super) fn read(words: &mut Words, name: &str, rows: usize, cols: usize) -> Result<Table> {
    words.whole(format_args!("the origin of {name}"))?;
    let mut line = || words.line().unwrap_or_default();
    let (head, size) = (line().trim_start(), line());
    if !is_head(head) {
        return Err(words.fault(format!("the listing of {name} must begin with CSparse")));
    }
    let mut fields: Vec<&str> = size.split_whitespace().map(|w| w.trim_end_matches(',')).collect();
    let is_triplets = fields.first() == Some(&"triplet:");
    fields.drain(..usize::from(is_triplets));
    let count = match fields[..] {
        [size, "nzmax:", _, "nnz:", count, ..] if size == format!("{rows}-by-{cols}") => {
            count.parse::<usize>().ok()
        }
        _ => None,
    };
    let Some(count) = count else {
        let reason = format!("must state {rows}-by-{cols} and nnz of {name}: {:?}", brief(size));
        return Err(words.fault(reason));
    };
    let mut listing = Listing { words, name, size: [rows, cols], entries: Vec::new() };
    match is_triplets {
        true => listing.triplets(count)?,
        false => listing.lines()?,
    }
    if listing.entries.len() != count {
        let reason = format!("{name} has {} numbers, nnz is {count}", listing.entries.len());
        return Err(listing.words.fault(reason));
    }
    Ok(Table { rows, cols, entries: Entries::Sparse(listing.entries) })
}

/// A listing as it is read.
struct Listing<'a, 'b> {
    words: &'a mut Words<'b>,
    name: &'a str,
    size: [usize; 2],
    entries: Vec<(usize, usize, f64)>,
}

impl Listing<'_, '_> {
    fn triplets(&mut self, count: usize) -> Result<()> {
        for _ in 0..count {
            let i = self.words.whole("a row")?;
            let j = self.words.whole("a column")?;
            self.entry(i, j)?;
        }
        Ok(())
    }

    /// The numbers of each column or row, after a line with their places in the list.
    fn lines(&mut self) -> Result<()> {
        let mut k = 0;
        loop {
            let kind = self.words.clone().next();
            let by_columns = match kind {
                Some("col") => true,
                Some("row") => false,
                _ => return Ok(()),
            };
            if k == self.size[usize::from(by_columns)] {
                return Err(self.words.fault_ahead(format!("{} has no line {k}", self.name)));
            }
            let line = self.words.line().unwrap_or_default();
            let fields: Vec<&str> = line.split_whitespace().collect();
            let ends = match fields[..] {
                [_, own, ":", "locations", first, "to", last] if own.parse() == Ok(k) => {
                    first.parse::<i64>().ok().zip(last.parse::<i64>().ok())
                }
                _ => None,
            };
            let Some((first, last)) = ends else {
                return Err(self.words.fault(format!("is not line {k}: {:?}", brief(line.trim()))));
            };
            for _ in first..=last {
                let other = self.words.whole(format_args!("a place in line {k}"))?;
                let (i, j) = if by_columns { (other, k) } else { (k, other) };
                self.entry(i, j)?;
            }
            k += 1;
        }
    }

    /// The number of an entry, after its place.
    fn entry(&mut self, i: usize, j: usize) -> Result<()> {
        if self.words.next() != Some(":") || i >= self.size[0] || j >= self.size[1] {
            let [rows, cols] = self.size;
            return Err(self
                .words
                .fault(format!("is no entry of the {rows} × {cols} matrix {}", self.name)));
        }
        let value = self.words.number(format_args!("{}[{i}][{j}]", self.name))?;
        self.entries.push((i, j, value));
        Ok(())
    }
}
