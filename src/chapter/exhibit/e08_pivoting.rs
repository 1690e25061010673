//! E08: pivoting called recursive, and wrong for many constraints.

use super::common::{answer, last, sweeps};
use super::{Finding, Measure};
use crate::error::Result;
use crate::lcp::{Lcp, library};
use crate::solver::{Options, Start, by_name};

const ROWS: usize = 10;
const BODIES: usize = 60;

/// The worst case of the least-index rule, and a column of sixty bodies.
pub(super) fn example() -> Result<Finding> {
    let exchanges = by_name("murty", &Options::default())?
        .solve(&problem("murty", ROWS)?, &Start::default(), &mut ())
        .iterations;
    let column = problem("stack", BODIES)?;
    let swept = last(sweeps("pgs", &column, &[0.0; BODIES], 1000)?);
    let pivoted = answer("lemke", &column)?;
    let count = Measure::new("exchanges, n = 10", "", ROWS as f64, exchanges as f64);
    let floor = Measure::new("floor's impulse", "N s", swept[0], pivoted[0]);
    Ok(Finding::new(
        "Murty's matrix, 1 on the diagonal and 2 above it, w = A x + b with b = −1: the least-index rule \
         visits every active set. Printed is a recursion that settles a row with each smaller instance. \
         Then a column of 60 bodies of 1 kg that all fall at 1 m/s, b = (−1, 0, …, 0): the floor's impulse \
         must stop them all. Printed is the method that the chapter takes for the more reliable one, with \
         1000 sweeps; beside it Lemke's pivoting.",
    )
    .measure(count.truth(&[2_f64.powi(ROWS as i32) - 1.0], "2ⁿ − 1", 0.0))
    .measure(floor.truth(&[BODIES as f64], "momentum", 1e-9))
    .judged("column of 60: sweeps and pivots", &column, &swept, &pivoted))
}

fn problem(family: &str, n: usize) -> Result<Lcp> {
    Ok(library::by_name(family)?.generate(&[("n", n as f64)])?.lcp)
}
