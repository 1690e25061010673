//! Problems that state a scale: contradictions that only rounding causes do not count.

use lcplab_analysis::answer::Answer;
use lcplab_judge::{
    Certificate, Demand, Evidence, Refutation, Verdict, judge, refutation, refuting_vector,
};
use lcplab_lcp::{Coupling, Lcp, Matrix};
use lcplab_solver::{Options, Registry, Start};

use lcplab_testing::{INF, boxed};

const TOLERANCE: f64 = 1e-8;

/// Two equations for x_0 + x_1 whose b differ by `gap`, with s = 2.
fn twice(gap: f64, scale: f64) -> Lcp {
    let a: [&[f64]; 2] = [&[2.0, 2.0], &[2.0, 2.0]];
    let lcp = boxed(&a, &[-2.0, -2.0 - gap], &[-INF; 2], &[INF; 2]);
    lcp.with_scale(scale).unwrap()
}

fn judged(lcp: &Lcp, x: &[f64]) -> Certificate {
    judge(lcp, x, &Demand::default())
}

#[test]
fn rows_that_differ_by_rounding_have_no_exact_solution_but_an_accepted_one() {
    let certificate = judged(&twice(4e-16, 1e-3), &[0.5, 0.5]);
    assert_eq!(certificate.verdict, Verdict::WithinTolerance);
    assert!(matches!(certificate.evidence, Some(Evidence::NoExactSolution(Refutation::Vector(_)))));
    // Without a scale nothing says that this is rounding.
    let certificate = judged(&twice(4e-16, 0.0), &[0.5, 0.5]);
    assert!(!certificate.verdict.is_solution());
    assert!(matches!(certificate.refutation(), Some(Refutation::Vector(_))));
}

#[test]
fn a_contradiction_counts_from_the_tolerance_times_the_scale_on() {
    // Both b may change by tolerance · s · scale: together by 4e-8 · scale.
    for scale in [1e-6, 1.0, 1e6] {
        for (part, counts) in [(0.1, false), (0.99, false), (1.01, true), (1e3, true)] {
            let lcp = twice(part * 4e-8 * scale, scale);
            let found = refutation(&lcp, &[&[-1.0, 1.0]], TOLERANCE);
            assert_eq!(found.is_some(), counts, "{part} at {scale}");
            assert!(refutation(&lcp, &[&[-1.0, 1.0]], 0.0).is_some(), "{part} at {scale}");
        }
    }
}

#[test]
fn far_from_the_origin_a_contradiction_still_counts() {
    // w = (0, −1e-6) of terms of 4e4: the residual is small, yet the scale is 1.
    let lcp = twice(1e-6, 1.0);
    let x = [1e4, 1.0 - 1e4];
    let certificate = judged(&lcp, &x);
    assert!(certificate.scaled_residual < TOLERANCE);
    assert!(!certificate.verdict.is_solution());
    assert!(certificate.refutation().is_some());
}

#[test]
fn an_x_within_the_tolerance_of_the_scale_is_never_refuted() {
    // With |w_i| ≤ tolerance · s_i · scale, changing b by −w makes x exact; so dᵀw of no vector can
    // exceed tolerance · Σ |d_i| s_i · scale.
    let a: [&[f64]; 3] = [&[2.0, 1.0, 3.0], &[1.0, 2.0, 3.0], &[3.0, 3.0, 6.0]];
    for k in 0..200 {
        let off = |i: i32| f64::from((k * 37 + i * 101) % 200 - 100) / 100.0 * 1e-9;
        let x = [0.25, -0.5, 0.125];
        let product = |row: &[f64]| row.iter().zip(&x).map(|(a, x)| a * x).sum::<f64>();
        let b: Vec<f64> = (0..3).map(|i| off(i as i32) - product(a[i])).collect();
        let lcp = boxed(&a, &b, &[-INF; 3], &[INF; 3]).with_scale(0.1).unwrap();
        let certificate = judged(&lcp, &x);
        assert!(certificate.verdict.is_solution(), "{k}: {certificate}");
    }
}

/// w_n = x_n − x_t − v, w_t = x_t − x_n − v/2, |x_t| ≤ x_n: no solution for v > 0.
fn wedge(v: f64, scale: f64) -> Lcp {
    let (lo, hi) = (vec![0.0, -INF], vec![INF; 2]);
    let matrix = Matrix::dense(2, &[1.0, -1.0, -1.0, 1.0]);
    let lcp = Lcp::new(matrix, vec![-v, -v / 2.0], lo, hi).unwrap();
    let coupling = Coupling::new(vec![None, Some(0)], vec![0.0, 1.0]).unwrap();
    lcp.with_coupling(coupling).unwrap().with_scale(scale).unwrap()
}

#[test]
fn a_case_split_counts_from_the_same_size_on() {
    // If each w may be off by e, w_n + w_t = −1.5 v allows a solution for v ≤ 4/3 e.
    for (v, counts) in [(1.3e-8, false), (1.36e-8, true), (1.0, true)] {
        let found = refutation(&wedge(v, 1.0), &[], TOLERANCE);
        assert_eq!(matches!(found, Some(Refutation::CaseSplit { .. })), counts, "{v}");
        assert!(refutation(&wedge(v, 0.0), &[], TOLERANCE).is_some(), "{v}");
    }
    let certificate = judged(&wedge(0.9e-8, 1.0), &[0.0, 0.0]);
    assert_eq!(certificate.verdict, Verdict::WithinTolerance);
    let by_cases = Some(Evidence::NoExactSolution(Refutation::CaseSplit { pieces: 3 }));
    assert_eq!(certificate.evidence, by_cases);
}

#[test]
fn rounding_in_one_part_does_not_hide_a_contradiction_in_another() {
    // Rows 0 and 1 differ by rounding, row 2 asks −x_2 − 1 ≥ 0 of x_2 ≥ 0.
    let a: [&[f64]; 3] = [&[2.0, 2.0, 0.0], &[2.0, 2.0, 0.0], &[0.0, 0.0, -1.0]];
    let lcp = boxed(&a, &[-2.0, -2.0 - 4e-16, -1.0], &[-INF, -INF, 0.0], &[INF; 3]);
    let lcp = lcp.with_scale(1e-3).unwrap();
    assert!(refutation(&lcp, &[&[-1.0, 1.0, 0.0]], TOLERANCE).is_some());
    // The same beside Painlevé's wedge, which only cases exclude.
    let a =
        [[2.0, 2.0, 0.0, 0.0], [2.0, 2.0, 0.0, 0.0], [0.0, 0.0, 1.0, -1.0], [0.0, 0.0, -1.0, 1.0]];
    let b = vec![-2.0, -2.0 - 4e-16, -1.0, -0.5];
    let lcp = Lcp::new(Matrix::from(a), b, vec![-INF, -INF, 0.0, -INF], vec![INF; 4]).unwrap();
    let coupling =
        Coupling::new(vec![None, None, None, Some(2)], vec![0.0, 0.0, 0.0, 1.0]).unwrap();
    let lcp = lcp.with_coupling(coupling).unwrap().with_scale(1e-3).unwrap();
    let hint: &[f64] = &[-1.0, 1.0, 0.0, 0.0];
    assert_eq!(refuting_vector(&lcp, &[hint], TOLERANCE), None);
    assert!(matches!(refutation(&lcp, &[hint], TOLERANCE), Some(Refutation::CaseSplit { .. })));
}

#[test]
fn no_solver_is_infeasible_where_its_answer_is_accepted() {
    let lcp = twice(4e-16, 1e-3);
    for entry in Registry::standard().entries() {
        let solver = entry.build(&Options::default());
        let solution = solver.solve(&lcp, &Start::default(), &mut ());
        let answer = Answer::judged(&lcp, &*entry.name, solution, &Demand::default());
        assert_ne!(answer.status_word(), "infeasible", "{}", entry.name);
        assert_eq!(answer.certificate.refutation(), None, "{}", entry.name);
    }
}

#[test]
fn a_contradiction_below_the_tolerance_does_not_count_if_the_search_within_it_ends_early() {
    // |x_1| ≤ x_0 = 1 slides at its limit, and w_2 = x_0 − x_1 + gap = 0 contradicts it by 1e-13.
    // The other rows need a subset of eight numbers with a given sum: a long search.
    let numbers = [1001.0, 1303.0, 1709.0, 2203.0, 2801.0, 3559.0, 4507.0, 5701.0];
    let chosen = [1.0, 1.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0];
    let n = 4 + numbers.len();
    let mut a = vec![0.0; n * n];
    (a[0], a[n + 1], a[2 * n], a[2 * n + 1]) = (1.0, 1.0, 1.0, -1.0);
    let (mut b, mut lo, mut hi) = (vec![1.0; n], vec![0.0; n], vec![1.0; n]);
    (b[0], b[1], b[2]) = (-1.0, -5.0, 1e-13);
    b[3] = -numbers.iter().zip(chosen).map(|(number, x)| number * x).sum::<f64>();
    for (k, number) in numbers.into_iter().enumerate() {
        (a[3 * n + 4 + k], a[(4 + k) * n + 4 + k]) = (number, -2.0);
    }
    lo[1..4].fill(-INF);
    hi[..4].fill(INF);
    let (mut index, mut mu) = (vec![None; n], vec![0.0; n]);
    (index[1], mu[1]) = (Some(0), 1.0);
    let lcp = Lcp::new(Matrix::dense(n, &a), b, lo, hi).unwrap();
    let lcp = lcp.with_coupling(Coupling::new(index, mu).unwrap()).unwrap();
    let x = [&[1.0, 1.0, 0.0, 0.0][..], &chosen].concat();
    let certificate = judged(&lcp.with_scale(1.0).unwrap(), &x);
    assert_eq!(certificate.verdict, Verdict::WithinTolerance);
}
