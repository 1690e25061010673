//! Mixed LCPs: equations and complementary rows, stored as one matrix, in parts, or both.

use super::matrix;
use crate::table::Table;
use crate::words::Words;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::{Entries, Parts};

/// Reads a mixed LCP, and how many numbers of a known answer follow; other words after it remain
/// unread.
///
/// Siconos' own files end with z and w of an answer, without the first number of z: its program
/// that converted them (`MixedLinearComplementarity_ReadWrite_test.c`) left that number out.
pub(super) fn read(words: &mut Words, input: &str) -> Result<(Parts, usize)> {
    let has_whole = words.whole("the flag of M and q")? == 1;
    let has_parts = words.whole("the flag of A, B, C, D, a and b")? == 1;
    let equations = words.whole("the number of equations")?;
    let others = words.whole("the number of complementary rows")?;
    let Some(n) = equations.checked_add(others) else {
        return Err(words.fault("more rows than can be counted"));
    };
    let whole = if has_whole { Some(whole(words, equations, n)?) } else { None };
    let parts = if has_parts { Some(by_parts(words, equations, n)?) } else { None };
    let parts = match (whole, parts) {
        (Some(whole), Some(parts)) => same(whole, parts, input)?,
        (Some(only), None) | (None, Some(only)) => only,
        (None, None) => {
            return Err(words.fault("neither M and q nor A, B, C, D, a and b are present"));
        }
    };
    let answer = (n + others).saturating_sub(1);
    if words.count() != answer {
        return Ok((parts, 0));
    }
    words.numbers(answer, "the known answer")?;
    Ok((parts, answer))
}

/// The blocks of rows, each of equations or of complementary rows, then M and q.
fn whole(words: &mut Words, equations: usize, n: usize) -> Result<Parts> {
    let mut ends = vec![words.whole("the beginning of the first block")?];
    while ends[ends.len() - 1] < n {
        let end = words.whole("the end of a block")?;
        if end <= ends[ends.len() - 1] {
            return Err(words.fault(format!("block ends must increase to {n}, found {end}")));
        }
        ends.push(end);
    }
    // The bounds of each block.
    let mut bounds = Vec::new();
    for _ in 1..ends.len() {
        bounds.push(match words.whole("the flag of a block")? {
            0 => -f64::INFINITY,
            1 => 0.0,
            flag => return Err(words.fault(format!("the flag of a block is 0 or 1, not {flag}"))),
        });
    }
    let blocks = || ends.windows(2).map(|pair| pair[1] - pair[0]).zip(&bounds);
    let free: usize = blocks().filter(|(_, lo)| **lo < 0.0).map(|(rows, _)| rows).sum();
    if ends[0] != 0 || ends[ends.len() - 1] != n || free != equations {
        let reason = format!("blocks with {free} equations, not {equations} of {n} rows");
        return Err(words.fault(reason));
    }
    let Table { rows, cols, entries } = matrix::read(words, "M")?;
    if (rows, cols) != (n, n) {
        let reason = format!(
            "M of this mixed LCP (MLCP) is {rows} × {cols}: only mixed LCPs with as many rows as \
             unknowns, here {n}, are read"
        );
        return Err(words.fault(reason));
    }
    // q has n numbers, so there is memory for n bounds.
    let b = words.numbers(n, "q")?;
    let lo = blocks().flat_map(|(rows, lo)| std::iter::repeat_n(*lo, rows)).collect();
    Ok(Parts { entries, b, lo: Some(lo), hi: None, index: None, mu: None })
}

/// A, B, C, D, a and b, each row by row: M is [A C; D B], q is (a, b).
fn by_parts(words: &mut Words, equations: usize, n: usize) -> Result<Parts> {
    let count = n.checked_mul(n).and_then(|count| count.checked_add(n));
    if count.is_none_or(|count| words.count() < count) {
        let reason = format!("fewer numbers than A, B, C, D, a and b have with {n} rows");
        return Err(words.fault_ahead(reason));
    }
    let (first, second) = (0..equations, equations..n);
    let mut dense = vec![0.0; n * n];
    for (name, rows, cols) in [
        ("A", &first, &first),
        ("B", &second, &second),
        ("C", &first, &second),
        ("D", &second, &first),
    ] {
        for i in rows.clone() {
            for j in cols.clone() {
                dense[i * n + j] = words.number(format_args!("a number of {name}"))?;
            }
        }
    }
    let b = words.numbers(n, "(a, b)")?;
    let lo = (0..n).map(|i| if i < equations { -f64::INFINITY } else { 0.0 }).collect();
    let entries = Entries::Dense(dense);
    Ok(Parts { entries, b, lo: Some(lo), hi: None, index: None, mu: None })
}

/// Checks that both forms in a file are the same problem, and returns it.
fn same(whole: Parts, parts: Parts, input: &str) -> Result<Parts> {
    let n = whole.b.len();
    let differs = |place: String, reason: String| Err(Error::invalid(input, place, reason));
    if whole.lo != parts.lo {
        let reason = "its equations are not its first rows, as in A, B, C and D, which follow";
        return differs("M".into(), reason.into());
    }
    let both = [whole.entries.matrix(n), parts.entries.matrix(n)];
    for (i, j) in (0..n * n).map(|k| (k / n, k % n)) {
        let [a, b] = both.each_ref().map(|matrix| matrix.entry(i, j));
        if a != b {
            return differs(
                format!("M[{i}][{j}]"),
                format!("is {a}, but {b} in A to D of this mixed LCP (MLCP)"),
            );
        }
    }
    match (0..n).find(|i| whole.b[*i] != parts.b[*i]) {
        Some(i) => {
            differs(format!("q[{i}]"), format!("is {}, in a and b {}", whole.b[i], parts.b[i]))
        }
        None => Ok(whole),
    }
}
