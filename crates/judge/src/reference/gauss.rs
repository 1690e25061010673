//! Gauss's principle of least constraint, by clarabel's interior-point method.
//!
//! Each row's term σ(−(J u + bias + γ s)) becomes linear constraints: with z = J u + bias + γ s the
//! term is −lo z for z ≥ 0 and −hi z for z ≤ 0, and an infinite bound forbids that side.

use super::{Reference, program::Program};
use lcplab_lcp::Gauss;

/// The velocities u of least constraint. The optimal value includes the constant ½ u*ᵀ M u*.
///
/// ```
/// use lcplab_judge::reference::gauss;
/// use lcplab_lcp::Gauss;
///
/// // A ball of 2 kg that would go down at 3 m/s touches the ground.
/// let ball = Gauss {
///     mass: vec![(0, 0, 2.0)],
///     jacobian: vec![vec![(0, 1.0)]],
///     bias: vec![0.0],
///     compliance: vec![0.0],
///     target: vec![-3.0],
///     lo: vec![0.0],
///     hi: vec![f64::INFINITY],
///     level: None,
/// };
/// let reference = gauss(&ball);
/// assert!(reference.point[0].abs() < 1e-7); // it stops: ½ M u*² = 9 J
/// assert!((reference.objective - 9.0).abs() < 1e-6);
/// ```
pub fn gauss(problem: &Gauss) -> Reference {
    let k = problem.target.len();
    let mut program = Program::with_costs(vec![0.0; k]);
    let mut constant = 0.0;
    for &(i, j, m) in &problem.mass {
        let (ui, uj) = (problem.target[i], problem.target[j]);
        program.quadratic.push((i, j, m));
        program.linear[i] -= m * uj;
        constant += 0.5 * m * ui * uj;
        if i != j {
            program.linear[j] -= m * ui;
            constant += 0.5 * m * ui * uj;
        }
    }
    for i in 0..problem.jacobian.len() {
        let mut row = problem.jacobian[i].clone();
        if problem.compliance[i] > 0.0 {
            let s = program.add_variable(0.0);
            program.quadratic.push((s, s, problem.compliance[i]));
            row.push((s, problem.compliance[i]));
        }
        let (lo, hi) = (problem.lo[i], problem.hi[i]);
        constant += add_support(&mut program, row, problem.bias[i], lo, hi);
    }
    let mut reference = program.solve();
    reference.objective += constant;
    reference.point.truncate(k);
    reference
}

/// Adds the row's σ(−z), z = row · variables + bias; returns the constant part of the cost.
fn add_support(program: &mut Program, row: Vec<(usize, f64)>, bias: f64, lo: f64, hi: f64) -> f64 {
    let negated = |row: &[(usize, f64)]| row.iter().map(|&(j, v)| (j, -v)).collect::<Vec<_>>();
    let mut linear = |row: &[(usize, f64)], x: f64| {
        for &(j, v) in row {
            // σ(−z) = −x z
            program.linear[j] -= x * v;
        }
        -x * bias
    };
    match (lo.is_finite(), hi.is_finite()) {
        (false, false) => program.equate(row, -bias),
        (true, false) => {
            let cost = linear(&row, lo);
            // z ≥ 0
            program.at_most(negated(&row), bias);
            return cost;
        }
        (false, true) => {
            let cost = linear(&row, hi);
            // z ≤ 0
            program.at_most(row, -bias);
            return cost;
        }
        (true, true) if lo == hi => return linear(&row, lo),
        (true, true) => {
            // t ≥ −lo z, t ≥ −hi z
            let t = program.add_variable(1.0);
            for bound in [lo, hi] {
                let mut g: Vec<_> = row.iter().map(|&(j, v)| (j, -bound * v)).collect();
                g.push((t, -1.0));
                program.at_most(g, bound * bias);
            }
        }
    }
    0.0
}
