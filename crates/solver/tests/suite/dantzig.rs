use lcplab_judge::{Demand, judge};
use lcplab_lcp::{Lcp, Matrix, library};
use lcplab_solver::{Dantzig, Solver, Start, Status};
use nalgebra::DMatrix;
use proptest::prelude::*;

use lcplab_testing::{INF, assert_certified, assert_proved, boxed, cases, contacts, manufactured};

fn dantzig() -> Dantzig {
    Dantzig::default()
}

#[test]
fn redundant_contacts_are_solved() {
    // A box on its four corners, A singular (E10); corner forces that support the weight.
    let a: [&[f64]; 4] = [
        &[4.0, 1.0, 1.0, -2.0],
        &[1.0, 4.0, -2.0, 1.0],
        &[1.0, -2.0, 4.0, 1.0],
        &[-2.0, 1.0, 1.0, 4.0],
    ];
    let lcp = contacts(&a, &[-1.0; 4]);
    let solution = dantzig().solve(&lcp, &Start::default(), &mut ());
    assert_eq!(solution.status, Status::Solved);
    assert!((solution.x.iter().sum::<f64>() - 1.0).abs() < 1e-14); // rows add up to 4 Σx = 4
}

#[test]
fn a_ray_proves_that_no_solution_exists() {
    // x1 + x2 = 1 and x1 + x2 = 2.
    let lcp = boxed(&[&[1.0, 1.0], &[1.0, 1.0]], &[-1.0, -2.0], &[-INF; 2], &[INF; 2]);
    let solution = dantzig().solve(&lcp, &Start::default(), &mut ());
    let Status::Ray { direction, .. } = solution.status else { panic!("{:?}", solution.status) };
    let descent: f64 = direction.iter().zip(lcp.b()).map(|(d, b)| d * b).sum();
    assert_eq!(direction[0] + direction[1], 0.0); // A d = 0
    assert!(descent < 0.0); // bᵀd < 0: the quadratic program is unbounded
}

#[test]
fn an_unsymmetric_matrix_is_outside_the_class() {
    let lcp = contacts(&[&[1.0, 2.0], &[0.0, 1.0]], &[-1.0, -1.0]);
    let status = dantzig().solve(&lcp, &Start::default(), &mut ()).status;
    assert_eq!(status, Status::OutsideClass { reason: "A is not symmetric" });
}

#[test]
fn an_indefinite_matrix_is_outside_the_class_or_solved_rightly() {
    let lcp = contacts(&[&[1.0, 3.0], &[3.0, 1.0]], &[-1.0, -4.0]);
    let solution = dantzig().solve(&lcp, &Start::default(), &mut ());
    if solution.status == Status::Solved {
        assert_certified(&lcp, &solution.x);
    }
}

#[test]
fn fathis_matrix_costs_one_pivot_in_the_favourable_numbering() {
    // F = U Uᵀ with Murty's U (1 on, 2 above the diagonal), b = −1: x = e_n, so driving row n first
    // satisfies all others at once.
    for n in [4, 8, 12] {
        let u = DMatrix::from_fn(n, n, |i, j| f64::from(u8::from(i <= j) + u8::from(i < j)));
        let f = &u * u.transpose();
        let reversed = DMatrix::from_fn(n, n, |i, j| f[(n - 1 - i, n - 1 - j)]);
        let a = Matrix::from(reversed.as_view());
        let lcp = Lcp::new(a, vec![-1.0; n], vec![0.0; n], vec![INF; n]).unwrap();
        let solution = dantzig().solve(&lcp, &Start::default(), &mut ());
        assert_proved(&lcp, &solution.x);
        assert_eq!((solution.x[0], solution.iterations), (1.0, 1));
    }
}

#[test]
fn stacks_of_redundant_contacts_are_solved() {
    for (boxes, mu) in [(1.0, 0.0), (3.0, 0.0), (20.0, 0.0), (5.0, 0.5)] {
        let family = library::by_name("box-stack").unwrap();
        let lcp = family.generate(&[("boxes", boxes), ("mu", mu)]).unwrap().lcp;
        let solution = dantzig().solve(&lcp, &Start::default(), &mut ());
        assert_eq!(solution.status, Status::Solved);
        assert_certified(&lcp, &solution.x);
    }
}

proptest! {
    #![proptest_config(cases(400))]

    #[test]
    fn every_singular_problem_with_a_solution_is_solved(m in manufactured(8, 4, 0.0)) {
        let solution = dantzig().solve(&m.lcp, &Start::default(), &mut ());
        prop_assert_eq!(&solution.status, &Status::Solved, "x* = {:?}", m.x);
        let w = judge(&m.lcp, &solution.x, &Demand::default()).w;
        for (found, w) in w.iter().zip(&m.w) {
            prop_assert!((found - w).abs() < 1e-9, "w is unique for semidefinite A: {:?} {:?}", w, m.w);
        }
    }
}
