//! E57: the memory of a linked list, section on linked lists.

use std::collections::LinkedList;

use super::{Finding, Measure};
use crate::error::Result;
use crate::plot::{Axis, Lines, Series};

/// Entries of the matrix, and the bytes of one.
const ENTRIES: usize = 100 * 100;
const DENSE: usize = 4;
/// 280000 bytes for all entries, the chapter's own figure.
const LISTED: usize = 280_000 / ENTRIES;

pub(super) fn example() -> Result<Finding> {
    let dense = ENTRIES * DENSE;
    let bytes = |entries: usize| (0..entries).map(|_| LISTED).sum::<usize>();
    let last_smaller = (0..=ENTRIES).take_while(|&entries| entries * LISTED <= dense).last();
    let break_even = last_smaller.unwrap_or(0) as f64 / ENTRIES as f64;
    let [short, middle, long] = [500, 1000, 1500].map(mean_steps);

    let ratio = Measure::new("full list : dense", "", 28.0, 280_000.0 / 40_000.0);
    let half = Measure::new("bytes, half full", "", 70_000.0, (ENTRIES / 2 * LISTED) as f64);
    let fill = Measure::new("fill at break-even", "", 1.0 / 28.0, 1.0 / 7.0);
    let steps =
        Measure::new("steps to 1 of 1500", "", middle * middle / short, 2.0 * middle - short);
    let full = bytes(ENTRIES) as f64 / dense as f64;
    Ok(Finding::new(
        "A matrix of 100 × 100 floats; a list entry takes 28 bytes, which is what the chapter's 280000 for a \
         full one amount to. The truth of the bytes is counted entry by entry, and the break-even by \
         adding entries until the dense matrix is smaller. Access is measured in a list: the mean number \
         of steps to each of 500 and of 1000 entries, continued to 1500 by a constant factor (exponential \
         growth) or by a constant difference, and counted there.",
    )
    .measure(ratio.truth(&[full], "counted", 0.0))
    .measure(half.truth(&[bytes(ENTRIES / 2) as f64], "counted", 0.0))
    .measure(fill.truth(&[break_even], "counted", 1.0 / ENTRIES as f64))
    .measure(steps.truth(&[long], "counted", 1e-9))
    .plot(&drawing()))
}

/// The mean number of steps to an entry of a list of this length.
fn mean_steps(entries: usize) -> f64 {
    let list: LinkedList<usize> = (0..entries).collect();
    let steps = (0..entries).map(|key| list.iter().take_while(|&&own| own != key).count() + 1);
    steps.sum::<usize>() as f64 / entries as f64
}

/// Memory (kB) against fill.
fn drawing() -> Lines {
    let fills = || (0..=20).map(|k| f64::from(k) / 20.0);
    let list = |fill: f64| (fill * (ENTRIES * LISTED) as f64).round() / 1e3;
    Lines::new(
        "e57",
        "Memory of a 100 × 100 matrix against its fill",
        "The list's memory is a straight line; it crosses the dense matrix at a \
                 fill of 1/7. The printed 70000 bytes belong to a quarter, not to a half.",
        Axis::linear("fill", ""),
        Axis::linear("memory", "kB"),
        vec![
            Series::measured("linked list", fills().map(|fill| (fill, list(fill))).collect()),
            Series::reference(
                "dense",
                fills().map(|fill| (fill, (ENTRIES * DENSE) as f64 / 1e3)).collect(),
            ),
            Series::points("printed", vec![(0.5, 70.0), (1.0, 280.0)]),
        ],
    )
}
