//! Writes Siconos' files with dense matrices.

use crate::Output;
use crate::contacts::Arrangement;
use crate::output::decimal;
use lcplab_lcp::Lcp;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::Problem;

/// Matrices with more rows are not written: a file of n² numbers would be too large to be useful.
const MOST_ROWS: usize = 5000;

pub(super) fn write(problem: &Problem) -> Result<Output> {
    let lcp = &problem.lcp;
    let n = lcp.len();
    if n > MOST_ROWS {
        let reason = format!("has {n} rows; as dense matrices at most {MOST_ROWS} are written");
        return Err(Error::invalid("siconos", "A", reason));
    }
    if lcp.coupling().is_none() {
        let order: Vec<usize> = (0..n).collect();
        let text = format!("{n}\n") + &numbers(lcp, &order) + &bounds(lcp)?;
        return Ok(Output::of(text));
    }
    let Arrangement { rows, mu } = contacts(problem)?;
    let text = format!("3\n{}\n", mu.len()) + &numbers(lcp, &rows) + &line(mu);
    Ok(Output { notes: Arrangement::notes(&rows), ..Output::of(text) })
}

/// The rows of a problem with friction, if all of them belong to contacts.
fn contacts(problem: &Problem) -> Result<Arrangement> {
    let arrangement = Arrangement::of(problem, "siconos")?;
    match arrangement.equations().first() {
        None => Ok(arrangement),
        Some(i) => {
            let reason = "belongs to no contact: a friction problem of Siconos has no other rows";
            Err(Error::invalid("siconos", format!("row {i}"), reason))
        }
    }
}

/// A and b, with rows and columns in this order.
fn numbers(lcp: &Lcp, order: &[usize]) -> String {
    let n = order.len();
    let mut text = format!("0\n{n}\n{n}\n{n}\t{n}\n");
    for &j in order {
        text += &line(order.iter().map(|&i| lcp.matrix().entry(i, j)));
    }
    text + &line(order.iter().map(|&i| lcp.b()[i]))
}

/// The bounds of a relay problem; empty for 0 and ∞, the bounds of an LCP.
fn bounds(lcp: &Lcp) -> Result<String> {
    let rows = || lcp.lo().iter().zip(lcp.hi());
    if rows().all(|bounds| bounds == (&0.0, &f64::INFINITY)) {
        return Ok(String::new());
    }
    match rows().position(|(lo, hi)| !lo.is_finite() || !hi.is_finite()) {
        None => Ok(line(lcp.lo().iter().copied()) + &line(lcp.hi().iter().copied())),
        Some(i) => {
            let reason = "has an infinite bound, and some row has other bounds than 0 and inf: in an \
                          LCP of Siconos all are 0 and inf, in a relay problem all are finite";
            Err(Error::invalid("siconos", format!("row {i}"), reason))
        }
    }
}

fn line(values: impl IntoIterator<Item = f64>) -> String {
    values.into_iter().map(decimal).collect::<Vec<_>>().join(" ") + "\n"
}
