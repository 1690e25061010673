use lcplab_judge::reference::{box_qp, gauss};
use lcplab_lcp::{Gauss, Lcp, Matrix};
use nalgebra::{DMatrix, DVector};
use proptest::prelude::*;

use lcplab_testing::{INF, cases};

/// Unit masses, so A = J Jᵀ + γ and b = J u* + bias.
fn dual(problem: &Gauss) -> Lcp {
    let (n, k) = (problem.jacobian.len(), problem.target.len());
    let mut j = DMatrix::<f64>::zeros(n, k);
    for (i, row) in problem.jacobian.iter().enumerate() {
        for &(c, v) in row {
            j[(i, c)] += v;
        }
    }
    let a = &j * j.transpose()
        + DMatrix::from_diagonal(&DVector::from_column_slice(&problem.compliance));
    let b = &j * DVector::from_column_slice(&problem.target);
    let b = b.iter().zip(&problem.bias).map(|(a, b)| a + b).collect();
    Lcp::new(Matrix::from(a.as_view()), b, problem.lo.clone(), problem.hi.clone()).unwrap()
}

#[test]
fn a_ball_meets_the_floor_and_stops() {
    // u* = −1, one contact: u = 0, cost ½.
    let problem = Gauss {
        mass: vec![(0, 0, 1.0)],
        jacobian: vec![vec![(0, 1.0)]],
        bias: vec![0.0],
        compliance: vec![0.0],
        target: vec![-1.0],
        lo: vec![0.0],
        hi: vec![INF],
        level: None,
    };
    let answer = gauss(&problem);
    assert!(answer.solved);
    assert!(answer.point[0].abs() < 1e-9 && (answer.objective - 0.5).abs() < 1e-9);
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn the_primal_value_is_minus_the_dual_value_for_every_kind_of_bound(
        entries in proptest::collection::vec(-1.0f64..1.0, 12),
        rows in proptest::collection::vec((0..5u8, -1.0f64..1.0, 0.1f64..1.0), 3),
        target in proptest::collection::vec(-1.0f64..1.0, 4),
    ) {
        let bounds = rows.iter().map(|&(kind, at, width)| match kind {
            0 => (-INF, INF),
            1 => (at, INF),
            2 => (-INF, at),
            3 => (at, at + width),
            _ => (at, at),
        });
        let (lo, hi): (Vec<f64>, Vec<f64>) = bounds.unzip();
        let problem = Gauss {
            mass: (0..4).map(|i| (i, i, 1.0)).collect(),
            jacobian: entries.chunks(4).map(|row| row.iter().copied().enumerate().collect()).collect(),
            bias: rows.iter().map(|row| row.1).collect(),
            compliance: rows.iter().map(|row| if row.0 % 2 == 0 { 0.5 } else { 0.25 }).collect(),
            target, lo, hi,
            level: None,
        };
        let (primal, dual) = (gauss(&problem), box_qp(&dual(&problem)).unwrap());
        prop_assert!(primal.solved && dual.solved);
        prop_assert!((primal.objective + dual.objective).abs() < 1e-7 * (1.0 + primal.objective.abs()),
            "{} {}", primal.objective, dual.objective);
    }
}
