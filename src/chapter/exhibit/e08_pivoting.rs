//! E08: pivoting called recursive, and wrong for many constraints.

use super::common::{answer, last, sweeps};
use super::{Evidence, Exhibit, Finding, Measure, Severity};
use crate::error::Result;
use crate::lcp::{Lcp, library};
use crate::solver::{Options, Start, by_name};

pub(super) const EXHIBIT: Exhibit = Exhibit {
    id: "E08",
    title: "what pivoting is, and how exact",
    place: "K&M, section on the solver",
    severity: Severity::Misleading,
    may_be_scan: false,
    printed: "Pivoting methods recurse over smaller instances of the problem; in the authors' experience \
              they give erroneous results for many constraints, by rounding.",
    holds: "They are a loop: guess which rows are at a bound, find a row that contradicts, exchange it. For \
            the matrices of contacts the loop ends, after up to 2ⁿ − 1 exchanges in the worst case and about \
            n in practice, with an answer that is exact but for rounding.",
    why: "The exchanges do not shrink the problem, they walk through its active sets. The verdict on accuracy \
          is an experience, which we cannot repeat in double precision: rounding grows with the exchanges, \
          but from 10⁻¹⁶, while a tall column leaves sweeps far from done.",
    evidence: Evidence::Example(example),
};

const ROWS: usize = 10;
const BODIES: usize = 60;

/// The worst case of the least-index rule, and a column of sixty bodies.
fn example() -> Result<Finding> {
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
