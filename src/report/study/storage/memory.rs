//! Bytes by fill, and the fill at which a storage breaks even with the dense matrix: Table 1 again.

use serde::{Deserialize, Serialize};

use super::{SEED, scattered, shuffled};
use crate::error::{Error, Result};
use crate::storage::{ALL, Kind};

/// The memory of a storage.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Memory {
    /// The storage's name.
    pub storage: String,
    /// At each fill.
    pub points: Vec<Point>,
    /// The fill (%) from which on it takes more than the dense matrix; `None` if it never does.
    pub break_even: Option<f64>,
    /// Bytes an entry at 10 % fill.
    pub bytes_an_entry: f64,
}

/// A matrix in a storage.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Point {
    /// The share of entries that are not zero (%).
    pub fill: f64,
    /// Entries.
    pub entries: usize,
    /// Bytes held.
    pub bytes: usize,
    /// How often memory was asked for.
    pub allocations: usize,
}

/// Fills a square matrix at random places.
///
/// # Errors
/// If there are no rows or more than ten thousand, or a fill is not between 0 and 100 %.
pub fn run(size: usize, fills: &[f64]) -> Result<Vec<Memory>> {
    if size == 0 || size > 10_000 {
        return Err(Error::invalid("storage", "size", format!("must be 1 to 10000, is {size}")));
    }
    if let Some(fill) = fills.iter().find(|fill| !(0.0..=100.0).contains(*fill)) {
        return Err(Error::invalid("storage", "fills", format!("must be 0 to 100 %, is {fill}")));
    }
    let order = shuffled(size * size, SEED);
    ALL.iter().map(|kind| measured(kind, size, fills, &order)).collect()
}

fn measured(kind: &Kind, size: usize, fills: &[f64], order: &[usize]) -> Result<Memory> {
    let all = size * size;
    let point = |entries: usize| {
        let mut storage = (kind.new)(size, size);
        storage.load(&scattered(size, order, entries))?;
        let (bytes, allocations) = (storage.bytes(), storage.allocations());
        let fill = 100.0 * entries as f64 / all as f64;
        Ok::<_, Error>(Point { fill, entries, bytes, allocations })
    };
    let entries = |fill: f64| (fill / 100.0 * all as f64).round() as usize;
    let points = fills.iter().map(|&fill| point(entries(fill))).collect::<Result<Vec<_>>>()?;
    let dense = all * size_of::<f64>();
    let more = |entries: usize| Ok::<_, Error>(point(entries)?.bytes > dense);
    let break_even =
        if kind.name == "dense" || !more(all)? { None } else { Some(first(all, more)?) };
    let tenth = point(all / 10)?;
    Ok(Memory {
        storage: kind.name.into(),
        points,
        break_even: break_even.map(|entries| 100.0 * entries as f64 / all as f64),
        bytes_an_entry: tenth.bytes as f64 / tenth.entries.max(1) as f64,
    })
}

/// The least number up to `all` for which this holds, if it holds from there on.
fn first(all: usize, holds: impl Fn(usize) -> Result<bool>) -> Result<usize> {
    let (mut without, mut with) = (0, all);
    while with - without > 1 {
        let middle = without.midpoint(with);
        if holds(middle)? {
            with = middle;
        } else {
            without = middle;
        }
    }
    Ok(with)
}
