use lcplab_problem::{Coupling, Lcp, Matrix};
use lcplab_solver::kernel::Width;
use lcplab_solver::kernel::dense::{Columns, RENEWED, Rows};
use lcplab_solver::kernel::reading::{Reading, read};
use lcplab_solver::{Dantzig, Solver, Start, Status};
use proptest::prelude::*;

use lcplab_testing::{INF, cases, contacts, manufactured};
use lcplab_testing::{assert_close, plain};

/// x after this number of sweeps by rows and by columns.
fn fast(lcp: &Lcp, omega: f64, sweeps: usize, width: Width) -> [Vec<f64>; 2] {
    let mut by_rows = Start::default().point(lcp);
    let mut by_columns = by_rows.clone();
    let rows = Rows::of(lcp, omega, width).unwrap();
    let mut columns = Columns::of(lcp, omega, width).unwrap();
    for _ in 0..sweeps {
        rows.sweep(&mut by_rows);
        columns.sweep(&mut by_columns);
    }
    [by_rows, by_columns]
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn both_forms_sweep_as_the_plain_method_does(m in manufactured(29, 29, 1.0), omega in 0.2..1.8f64) {
        for x in fast(&m.lcp, omega, 5, Width::widest()) {
            assert_close(&x, &plain(&m.lcp, omega, 5), 1e-12);
        }
    }

    #[test]
    fn the_bits_are_the_same_with_all_instructions(m in manufactured(21, 21, 1.0)) {
        let portable = fast(&m.lcp, 1.3, 7, Width::Portable);
        for width in Width::available() {
            prop_assert_eq!(&fast(&m.lcp, 1.3, 7, width), &portable, "{:?}", width);
        }
    }
}

#[test]
fn by_columns_only_rows_that_change_cost_anything() {
    // Rows 0 and 2 are at their bound from the start; the others move until they are solved.
    let a: [&[f64]; 3] = [&[2.0, 1.0, 0.0], &[1.0, 2.0, 1.0], &[0.0, 1.0, 2.0]];
    let lcp = contacts(&a, &[1.0, -2.0, 1.0]);
    let (mut x, mut columns) = ([0.0; 3], Columns::of(&lcp, 1.0, Width::widest()).unwrap());
    assert_eq!((columns.sweep(&mut x), x), (1, [0.0, 1.0, 0.0]));
    assert_eq!(columns.sweep(&mut x), 0);
}

#[test]
fn by_columns_w_does_not_drift() {
    let n = 40;
    let entry = |k: usize| ((k / n * 7 + k % n * 7) % 11) as f64 / 10.0 - 0.5;
    let j: Vec<f64> = (0..n * n).map(entry).collect();
    let a = |i: usize, k: usize| (0..n).map(|c| j[i * n + c] * j[k * n + c]).sum::<f64>();
    let mut entries: Vec<f64> =
        (0..n * n).map(|k| a((k / n).min(k % n), (k / n).max(k % n))).collect();
    (0..n).for_each(|i| entries[i * n + i] += 1.0);
    let b: Vec<f64> = (0..n).map(|i| (i as f64).sin() - 0.5).collect();
    let lcp = Lcp::new(Matrix::dense(n, &entries), b, vec![0.0; n], vec![INF; n]).unwrap();
    let [_, x] = fast(&lcp, 1.0, 40 * RENEWED, Width::widest());
    let exact = Dantzig::default().solve(&lcp, &Start::default(), &mut ());
    assert_eq!(exact.status, Status::Solved);
    assert_close(&x, &exact.x, 1e-12);
}

#[test]
fn what_a_form_is_not_made_for_is_refused() {
    let outside = |reason| Status::OutsideClass { reason };
    let width = Width::widest();
    let unsymmetric = contacts(&[&[2.0, 1.0], &[0.0, 2.0]], &[1.0, 1.0]);
    assert!(Rows::of(&unsymmetric, 1.0, width).is_ok());
    assert_eq!(Columns::of(&unsymmetric, 1.0, width).unwrap_err(), outside("A is not symmetric"));
    let flat = contacts(&[&[2.0, 1.0], &[1.0, 0.0]], &[1.0, 1.0]);
    assert_eq!(Rows::of(&flat, 1.0, width).unwrap_err(), Status::ZeroDiagonal { row: 1 });
    let sparse = Matrix::sparse(1, &[(0, 0, 1.0)]);
    let sparse = Lcp::new(sparse, vec![0.0], vec![0.0], vec![INF]).unwrap();
    assert_eq!(Rows::of(&sparse, 1.0, width).unwrap_err(), outside("A is not dense"));
    let pair = contacts(&[&[1.0, 0.0], &[0.0, 1.0]], &[-1.0, -1.0]);
    let coupling = Coupling::new(vec![None, Some(0)], vec![0.0, 0.5]).unwrap();
    let boxed =
        Lcp::new(pair.matrix().clone(), vec![-1.0; 2], vec![0.0, -INF], vec![INF; 2]).unwrap();
    let coupled = boxed.with_coupling(coupling).unwrap();
    assert_eq!(Rows::of(&coupled, 1.0, width).unwrap_err(), outside("rows are coupled"));
}

#[test]
fn every_number_is_read_once_wherever_the_memory_begins() {
    // 1, 2, …, n: all sums are integers, so the order of addition does not matter.
    let numbers: Vec<f64> = (1..=3000).map(f64::from).collect();
    for start in 0..9 {
        for count in (0..80).chain([511, 512, 1500, 2991]) {
            let expected = (start + 1..=start + count).sum::<usize>() as f64;
            for width in Width::available() {
                for reading in Reading::ALL {
                    let sum = read(&numbers[start..start + count], reading, width);
                    assert_eq!(sum, expected, "{count} from {start}, {reading:?}, {width:?}");
                }
            }
        }
    }
}
