//! Reads a matrix in Siconos' format: its storage, its size, its numbers.

use super::listing;
use crate::table::{Table, by_rows};
use crate::words::Words;
use lcplab_lcp::error::Result;
use lcplab_lcp::file::Entries;

const DENSE: usize = 0;
const BLOCKS: usize = 1;
const SPARSE: usize = 2;

/// The size of the matrix that starts after this number of words, if one does.
pub(super) fn size_ahead(words: &Words, after: usize) -> Option<[usize; 2]> {
    let mut ahead = words.clone();
    for _ in 0..after {
        ahead.next()?;
    }
    let mut whole = || ahead.next()?.parse::<usize>().ok();
    let [storage, rows, cols] = [whole()?, whole()?, whole()?];
    let is_matrix = match storage {
        DENSE => [whole()?, whole()?] == [rows, cols],
        BLOCKS => {
            let [count, down, across] = [whole()?, whole()?, whole()?];
            let mut last = |lines: usize| (0..lines).try_fold(0, |_, _| whole());
            count > 0 && last(down)? == rows && last(across)? == cols
        }
        SPARSE => whole().is_some() && ahead.next().is_some_and(listing::is_head),
        _ => false,
    };
    is_matrix.then_some([rows, cols])
}

/// Where each block of rows of the matrix ahead ends, if it is stored in blocks.
pub(super) fn row_ends_ahead(words: &Words) -> Option<Vec<usize>> {
    let mut ahead = words.clone();
    let mut whole = || ahead.next()?.parse::<usize>().ok();
    let [storage, _rows, _cols, _count, down, _across] =
        [whole()?, whole()?, whole()?, whole()?, whole()?, whole()?];
    (storage == BLOCKS).then(|| (0..down).map_while(|_| whole()).collect())
}

/// The matrix called `name`.
pub(super) fn read(words: &mut Words, name: &str) -> Result<Table> {
    let storage = words.whole(format_args!("the storage of {name}"))?;
    let [rows, cols] = size(words)?;
    match storage {
        DENSE => dense(words, name, rows, cols),
        BLOCKS => blocks(words, rows, cols),
        SPARSE => listing::read(words, name, rows, cols),
        _ => {
            let reason =
                format!("storage {storage} is not read: only 0, dense, 1, blocks, and 2, sparse");
            Err(words.fault(reason))
        }
    }
}

fn size(words: &mut Words) -> Result<[usize; 2]> {
    Ok([words.whole("the number of rows")?, words.whole("the number of columns")?])
}

fn dense(words: &mut Words, name: &str, rows: usize, cols: usize) -> Result<Table> {
    let again = size(words)?;
    if again != [rows, cols] {
        let reason = format!("{} × {} here, {rows} × {cols} before", again[0], again[1]);
        return Err(words.fault(reason));
    }
    let by_columns = words.numbers(rows.saturating_mul(cols), name)?;
    Ok(Table { rows, cols, entries: Entries::Dense(by_rows(rows, cols, &by_columns)) })
}

fn blocks(words: &mut Words, rows: usize, cols: usize) -> Result<Table> {
    let count = words.whole("the number of blocks")?;
    let across = [words.whole("the number of block rows")?, words.whole("that of block columns")?];
    let row_ends = words.wholes(across[0], "the end of block row ")?;
    let col_ends = words.wholes(across[1], "the end of block column ")?;
    let ends = [&row_ends, &col_ends].map(|ends| ends.last().copied().unwrap_or(0));
    if count == 0 || ends != [rows, cols] {
        let reason = format!("{count} blocks up to {} × {}, not {rows} × {cols}", ends[0], ends[1]);
        return Err(words.fault(reason));
    }
    let lengths = [words.whole("the length of a list")?, words.whole("the length of a list")?];
    let first = words.wholes(lengths[0], "the first block of block row ")?;
    let columns = words.wholes(lengths[1], "the block column of block ")?;
    let is_ascending = first.windows(2).all(|pair| pair[0] <= pair[1]);
    let spans = (first.first(), first.last()) == (Some(&0), Some(&count));
    if columns.len() != count || !is_ascending || !spans {
        return Err(
            words.fault(format!("the lists do not determine the positions of {count} blocks"))
        );
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

/// The start and the length of block k, given where each block ends.
fn span(ends: &[usize], k: usize, most: usize) -> Option<(usize, usize)> {
    let start = if k == 0 { 0 } else { *ends.get(k - 1)? };
    let end = *ends.get(k)?;
    (start < end && end <= most).then(|| (start, end - start))
}
