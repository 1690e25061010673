//! Manufactured problems: the solution is chosen first.
//!
//! x* and w* are chosen complementary (one of them at its bound in every row), then b = w* − A x*.
//! (With x* > 0 alone there would be no complementarity to test.) All numbers are short binary
//! fractions: x* and w* are multiples of 1/8, and A = J Jᵀ with the entries of J multiples of 2⁻¹⁷.
//! No sum is rounded, and x* solves the problem exactly.

use nalgebra::DMatrix;

use super::random::Random;
use super::{Expected, Generated, Parameter, Values, boxed, contacts, offset, rational};
use crate::Matrix;
use crate::file::Problem;

pub(super) const FAMILIES: &[Generated] = &[
    Generated {
        name: "manufactured",
        about: "x and w chosen complementary; size, active set, degeneracy, boxes, rank, condition",
        source: "made backwards from its solution",
        parameters: &[
            Parameter::whole("n", "number of rows", 20, [1, 1000]),
            Parameter::real("active", "share of rows at a bound with w ≠ 0", 0.5, [0.0, 1.0]),
            Parameter::real("degenerate", "share of rows at a bound with w = 0", 0.0, [0.0, 1.0]),
            Parameter::real("boxed", "share of rows with two finite bounds", 0.0, [0.0, 1.0]),
            Parameter::real("rank", "rank of A as a share of n", 1.0, [0.0, 1.0]),
            Parameter::real(
                "condition",
                "about the largest eigenvalue over the least",
                100.0,
                [1.0, 1e6],
            ),
            Parameter::seed(),
        ],
        make: manufactured,
    },
    Generated {
        name: "pd",
        about: "symmetric positive definite with eigenvalues 1/n, 2/n, …, 1",
        source: "num4lcp, made valid",
        parameters: &[
            Parameter::whole("n", "number of rows", 50, [1, 1000]),
            Parameter::real("active", "share of rows at a bound with w ≠ 0", 0.5, [0.0, 1.0]),
            Parameter::seed(),
        ],
        make: |values| {
            let n = values.whole("n");
            let mut random = Random::new(values.whole("seed"));
            let eigenvalue = |k: usize| (k + 1) as f64 / n as f64;
            let a = gram(&mut random, n, n, eigenvalue);
            let pairs = pairs(&mut random, n, values.real("active"), 0.0);
            solved_by(a, &pairs, true)
        },
    },
    Generated {
        name: "fluid",
        about: "pressures on a grid of n × n × n cells, sparse; a quarter of them are zero",
        source: "num4lcp, made valid: the seven-point Laplacian",
        parameters: &[
            Parameter::whole("n", "cells along an edge", 4, [1, 30]),
            Parameter::real("active", "share of cells without pressure", 0.25, [0.0, 1.0]),
            Parameter::seed(),
        ],
        make: |values| {
            let mut random = Random::new(values.whole("seed"));
            let a = laplacian(values.whole("n"));
            let pairs = pairs(&mut random, a.len(), values.real("active"), 0.0);
            solved_by(a, &pairs, true)
        },
    },
];

fn manufactured(values: &Values) -> Problem {
    let n = values.whole("n");
    let mut random = Random::new(values.whole("seed"));
    let rank = ((values.real("rank") * n as f64).round() as usize).max(1);
    let ratio = 1.0 / values.real("condition");
    let eigenvalue = |k: usize| ratio.powf(k as f64 / (rank.max(2) - 1) as f64);
    let a = gram(&mut random, n, rank, eigenvalue);
    let pairs = pairs(&mut random, n, values.real("active"), values.real("degenerate"));
    let problem = solved_by(a, &pairs, rank == n);
    let boxes = (values.real("boxed") * n as f64).round() as usize;
    if boxes == 0 { problem } else { put_into_boxes(problem, &pairs, &mut random, boxes) }
}

/// (x_i, w_i): one is zero and the other positive, or both are zero.
fn pairs(random: &mut Random, n: usize, active: f64, degenerate: f64) -> Vec<(f64, f64)> {
    let share = |part: f64| (part * n as f64).round() as usize;
    let kinds = (0..n).map(|i| match i {
        i if i < share(degenerate) => (0.0, 0.0),
        i if i < share(degenerate) + share(active) => (0.0, random.eighth(1, 4)),
        _ => (random.eighth(1, 4), 0.0),
    });
    let kinds = kinds.collect();
    random.shuffled(kinds)
}

fn solved_by(a: Matrix, pairs: &[(f64, f64)], is_unique: bool) -> Problem {
    let (x, w): (Vec<f64>, Vec<f64>) = pairs.iter().copied().unzip();
    let b = offset(&a, &x, &w);
    let x = x.into_iter().map(rational).collect();
    let expected = if is_unique { Expected::unique(x) } else { Expected::one_of_several(x) };
    contacts(a, b, &expected)
}

/// Gives some rows an upper bound. Every second one of them, if x was 0, is moved to it: x at its
/// upper bound, w ≤ 0.
fn put_into_boxes(
    problem: Problem,
    pairs: &[(f64, f64)],
    random: &mut Random,
    boxes: usize,
) -> Problem {
    let n = pairs.len();
    let rows = random.shuffled((0..n).collect());
    let mut hi = vec![f64::INFINITY; n];
    let (mut x, mut w): (Vec<f64>, Vec<f64>) = pairs.iter().copied().unzip();
    for (k, &i) in rows[..boxes].iter().enumerate() {
        hi[i] = x[i] + random.eighth(1, 4);
        if x[i] == 0.0 && k % 2 == 0 {
            (x[i], w[i]) = (hi[i], -w[i]);
        }
    }
    let a = problem.lcp.matrix().clone();
    let b = offset(&a, &x, &w);
    let x = x.into_iter().map(rational).collect();
    let is_unique = Expected::of(&problem).is_some_and(|expected| expected.complete);
    let expected = if is_unique { Expected::unique(x) } else { Expected::one_of_several(x) };
    boxed(a, b, vec![0.0; n], hi, &expected)
}

/// J Jᵀ of this rank with approximately these eigenvalues (all at most 1), exact in floating point.
fn gram(random: &mut Random, n: usize, rank: usize, eigenvalue: impl Fn(usize) -> f64) -> Matrix {
    let q = random.orthonormal(n, rank);
    let quantum = 2f64.powi(17);
    let entry = |i: usize, k: usize| (q[(i, k)] * eigenvalue(k).sqrt() * quantum).round() / quantum;
    let j = DMatrix::from_fn(n, rank, entry);
    Matrix::from((&j * j.transpose()).as_view())
}

/// 6 on the diagonal, −1 for each of the six neighbors of a cell.
fn laplacian(n: usize) -> Matrix {
    let mut entries = Vec::new();
    for cell in 0..n * n * n {
        entries.push((cell, cell, 6.0));
        for (stride, place) in [(1, cell % n), (n, cell / n % n), (n * n, cell / n / n)] {
            if place + 1 < n {
                entries.push((cell, cell + stride, -1.0));
                entries.push((cell + stride, cell, -1.0));
            }
        }
    }
    Matrix::sparse(n * n * n, &entries)
}
