//! E61: a row solver is not a least-squares solver, text on impossible constraints.

use nalgebra::{DMatrix, DVector};

use super::common::{answer, delassus, equations, largest, sweeps};
use super::{Finding, Measure};
use crate::error::Result;
use crate::lcp::Lcp;
use crate::plot::{Axis, Lines, Series};
use crate::solver::{Dantzig, Pgs};

/// β/dt (1/s), and by how much the rod is too short (m).
const FEEDBACK: f64 = 0.2 * 60.0;
const SHORT: f64 = 2.0;

/// Left nail, right nail, rod: two masses of 1 kg nailed 3 m apart, and a rod of 1 m between them.
const ROWS: [([f64; 2], f64); 3] =
    [([1.0, 0.0], 0.0), ([0.0, 1.0], 0.0), ([-1.0, 1.0], FEEDBACK * SHORT)];
const ROD_LAST: [usize; 3] = [0, 1, 2];
const ROD_FIRST: [usize; 3] = [2, 0, 1];

fn jacobian(order: [usize; 3]) -> DMatrix<f64> {
    DMatrix::from_fn(3, 2, |row, body| ROWS[order[row]].0[body])
}

/// J u + b + γ x = 0 in this order of rows.
fn problem(order: [usize; 3], compliance: f64) -> Result<Lcp> {
    let mut a = delassus(&jacobian(order), &[1.0; 2]);
    (0..3).for_each(|i| a[4 * i] += compliance);
    equations(&a, &order.map(|row| ROWS[row].1))
}

/// Jᵀ x, the velocities of the two masses.
fn velocities(order: [usize; 3], x: &[f64]) -> Vec<f64> {
    (jacobian(order).transpose() * DVector::from_column_slice(x)).as_slice().to_vec()
}

/// The u that minimizes |J u + b|².
fn least_squares() -> Vec<f64> {
    let j = jacobian(ROD_LAST);
    let b = DVector::from_fn(3, |row, _| -ROWS[row].1);
    let normal = (j.transpose() * &j).cholesky().map(|factor| factor.solve(&(j.transpose() * b)));
    normal.map_or_else(Vec::new, |u| u.as_slice().to_vec())
}

pub(super) fn example() -> Result<Finding> {
    let best = least_squares();
    let last = sweeps(Pgs::NAME, &problem(ROD_LAST, 0.0)?, &[0.0; 3], 1000)?;
    let first = sweeps(Pgs::NAME, &problem(ROD_FIRST, 0.0)?, &[0.0; 3], 1000)?;
    let end = |x: &[Vec<f64>]| x.last().cloned().unwrap_or_default();
    let size = |k: usize| largest(last[k].iter().copied());
    // The share of the rod's correction that each mass gets.
    let share = FEEDBACK * SHORT / 2.0;
    let soft = problem(ROD_LAST, 1e-6)?;
    let [one, other] = [ROD_LAST, ROD_FIRST].map(|order| -> Result<_> {
        Ok(velocities(order, &answer(Dantzig::NAME, &problem(order, 1e-6)?)?))
    });
    let (one, other): (Vec<f64>, Vec<f64>) = (one?, other?);

    let growth = Measure::new("|x| after 1000 sweeps", "N s", size(10), 1000.0 * share);
    let rod_last = Measure::new("u, rod last", "m/s", best.clone(), [share, -share]);
    let rod_first = Measure::new("u, rod first", "m/s", best.clone(), [0.0, 0.0]);
    let yielding = |name, printed: &[Vec<f64>], order, u| {
        let measure = Measure::new(name, "m/s", velocities(order, &end(printed)), u);
        measure.truth(&best, "least squares", 1e-4)
    };
    Ok(Finding::new(
        "Two masses of 1 kg at rest are nailed 3 m apart and joined by a rod of 1 m; β = 0.2, dt = 1/60 s, so \
         the rod requires an approach at 24 m/s. Printed: |x| stays what it is after 10 sweeps, and u is the \
         best fit. Corrected: 12 N s more in each sweep; u is (12, −12) if the rod is updated last, and (0, 0) \
         if the nails are. The last two lines: no compliance compared with γ = 10⁻⁶, in both orders.\n\n\
         For a problem without a solution there is nothing to judge; the judge sees the x of 1000 sweeps and \
         that of Dantzig's method on the problem with γ = 10⁻⁶.",
    )
    .measure(growth.truth(&[size(1000)], "PGS, measured", 1e-6))
    .measure(rod_last.truth(&velocities(ROD_LAST, &end(&last)), "PGS, measured", 1e-6))
    .measure(rod_first.truth(&velocities(ROD_FIRST, &end(&first)), "PGS, measured", 1e-6))
    .measure(yielding("CFM, rod last", &last, ROD_LAST, one))
    .measure(yielding("CFM, rod first", &first, ROD_FIRST, other))
    .judged("the rows with γ = 10⁻⁶", &soft, &end(&last), &answer(Dantzig::NAME, &soft)?)
    .plot(&drawing()?))
}

/// |x| against sweeps, rigid and compliant.
fn drawing() -> Result<Lines> {
    let curve = |compliance: f64| -> Result<Vec<(f64, f64)>> {
        let x = sweeps(Pgs::NAME, &problem(ROD_LAST, compliance)?, &[0.0; 3], 100)?;
        let size = x.iter().map(|x| largest(x.iter().copied()));
        Ok(size.enumerate().map(|(sweep, size)| (sweep as f64, size)).collect())
    };
    let share = FEEDBACK * SHORT / 2.0;
    let growth = (0..=100).map(|sweep| (f64::from(sweep), f64::from(sweep) * share)).collect();
    Ok(Lines::new(
        "e61",
        "Impulses of constraints that contradict each other",
        "Without compliance the impulses grow by 12 N s in every sweep, without limit. \
                 With γ = 0.1 or 0.3 on the diagonal they settle.",
        Axis::linear("sweep", ""),
        Axis::linear("largest impulse", "N s"),
        vec![
            Series::theory("12 N s per sweep", growth),
            Series::measured("rigid", curve(0.0)?),
            Series::measured("γ = 0.1", curve(0.1)?),
            Series::measured("γ = 0.3", curve(0.3)?),
        ],
    ))
}
