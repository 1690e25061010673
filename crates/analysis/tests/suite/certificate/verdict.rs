use lcplab_analysis::answer::Answer;
use lcplab_judge::{Demand, Evidence, Refusal, Verdict, judge, printed_up, upper_bound};
use lcplab_lcp::merit;
use lcplab_solver::{Options, Solution, Start, Status};
use proptest::prelude::*;

use lcplab_testing::{INF, assert_proved, boxed, cases, contacts, manufactured};

#[test]
fn a_solution_is_proved_and_a_point_beside_it_is_refuted() {
    // 2x − 4 on [0, 10]: x = 2 (E01).
    let lcp = boxed(&[&[2.0]], &[-4.0], &[0.0], &[10.0]);
    assert_proved(&lcp, &[2.0]);
    let certificate = judge(&lcp, &[2.001], &Demand::default());
    // |w| = 0.002 of the terms 4.002 + 4
    let Verdict::NotASolution { row: 0, amount, .. } = certificate.verdict else { panic!() };
    assert!((amount - 0.002 / 8.002).abs() < 1e-12);
}

#[test]
fn what_a_solver_may_call_solved_the_judge_accepts_at_the_tolerance_itself() {
    // Where (1 + t) x_1 = (1 − t) x_0 (1 + 1e-8), row 0 has the relative residual t = 1e-8 up to
    // rounding.
    let lcp = contacts(&[&[1.0 + 1e-8, -1.0], &[-1.0, 1.0 + 1e-8]], &[0.0, 0.0]);
    let (mut both, mut differ) = ([0; 2], 0);
    for k in 0..1000 {
        let x = 1.0 + f64::from(k) / 1000.0;
        let x = [x, x * (1.0 + 1e-8) * (1.0 - 1e-8) / (1.0 + 1e-8)];
        let accepted = judge(&lcp, &x, &Demand::default()).verdict.is_solution();
        assert_eq!(merit::is_solution(&lcp, &x, 1e-8), accepted, "{x:?}");
        assert!(accepted || !merit::is_within(&lcp, &x, 1e-8, &mut 0), "{x:?}");
        both[usize::from(accepted)] += 1;
        differ += usize::from((merit::scaled_residual(&lcp, &x) <= 1e-8) != accepted);
    }
    // Sums in plain doubles decide some of these cases differently.
    assert!(both[0] > 0 && both[1] > 0 && differ > 0, "{both:?} {differ}");
}

#[test]
fn a_pinned_row_leaves_its_w_free() {
    let lcp = boxed(&[&[1.0, 0.5], &[0.5, 1.0]], &[7.0, -1.0], &[2.0, 0.0], &[2.0, INF]);
    assert_proved(&lcp, &[2.0, 0.0]);
}

#[test]
fn a_row_without_bounds_demands_w_zero() {
    let lcp = boxed(&[&[2.0]], &[3.0], &[-INF], &[INF]);
    assert_proved(&lcp, &[-1.5]);
    assert!(!judge(&lcp, &[0.0], &Demand::default()).verdict.is_solution());
}

#[test]
fn a_segment_of_solutions_is_proved_at_each_of_its_points() {
    // All ones, b = −1: every x ≥ 0 with x1 + x2 = 1 (Cottle, Pang & Stone; PSD, not unique).
    let lcp = contacts(&[&[1.0, 1.0], &[1.0, 1.0]], &[-1.0, -1.0]);
    for x in [[1.0, 0.0], [0.25, 0.75], [0.0, 1.0]] {
        assert_proved(&lcp, &x);
    }
    assert!(!judge(&lcp, &[0.5, 0.25], &Demand::default()).verdict.is_solution());
}

#[test]
fn the_natural_residual_is_the_distance_to_the_bound_that_w_pushes_to() {
    // |x − Π(x − w)| of 2x ∓ 4 on [0, 1], whose solutions are 1 and 0
    for (b, x, expected) in
        [(-4.0, 1.0, 0.0), (-4.0, 0.75, 0.25), (4.0, 0.0, 0.0), (4.0, 0.25, 0.25)]
    {
        let lcp = boxed(&[&[2.0]], &[b], &[0.0], &[1.0]);
        assert_eq!(judge(&lcp, &[x], &Demand::default()).natural_residual, expected, "{b} {x}");
    }
}

#[test]
fn the_gaps_are_those_of_the_quadratic_program() {
    // min x² − 4x on [0, 1]: x = 1 with value −3; at x = 1/2 w = −3, value −7/4, and the dual bound
    // at that w is −7/4 − 3/2.
    let lcp = boxed(&[&[2.0]], &[-4.0], &[0.0], &[1.0]);
    let at = judge(&lcp, &[0.5], &Demand::default());
    assert_eq!((at.objective, at.duality_gap, at.complementarity_gap), (-1.75, 1.5, 1.5));
    assert_eq!((at.bound_violation, at.dual_infeasibility), (0.0, 0.0));
    let at = judge(&lcp, &[1.0], &Demand::default());
    assert_eq!((at.objective, at.duality_gap), (-3.0, 0.0));
}

#[test]
fn a_duality_gap_is_stated_of_convex_problems_alone() {
    let gap = |a: &[&[f64]]| {
        let n = a.len();
        let lcp = boxed(a, &vec![0.0; n], &vec![-1.0; n], &vec![1.0; n]);
        judge(&lcp, &vec![0.0; n], &Demand::default()).duality_gap
    };
    // Eigenvalues 1 and 3; 0 and 2; 0 and 1.
    for convex in [[[2.0, 1.0], [1.0, 2.0]], [[1.0, 1.0], [1.0, 1.0]], [[0.0, 0.0], [0.0, 1.0]]] {
        assert_eq!(gap(&[&convex[0], &convex[1]]), 0.0, "{convex:?}");
    }
    // Eigenvalues −1 and 3, with ½ xᵀAx = −1 at (1, −1); −1 and 1; −1; and no objective at all.
    for other in [
        [[1.0, 2.0], [2.0, 1.0]],
        [[0.0, 1.0], [1.0, 0.0]],
        [[1.0, 0.0], [0.0, -1.0]],
        [[1.0, 1.0], [0.0, 1.0]],
    ] {
        assert!(gap(&[&other[0], &other[1]]).is_nan(), "{other:?}");
    }
    // Every 2 × 2 minor is positive, and the eigenvalue along (1, 1, 1) is −0.2.
    let flat = gap(&[&[1.0, -0.6, -0.6], &[-0.6, 1.0, -0.6], &[-0.6, -0.6, 1.0]]);
    assert!(flat.is_nan());
}

#[test]
fn a_cancelled_w_is_computed_to_the_last_digit() {
    // w = 1e16 + 1 − 1e16: plain summation loses the 1.
    let lcp = contacts(&[&[1e16, 1.0], &[1.0, 1.0]], &[-1e16, 0.0]);
    assert_eq!(judge(&lcp, &[1.0, 1.0], &Demand::default()).w[0], 1.0);
}

#[test]
fn an_x_that_is_not_finite_is_no_solution() {
    let lcp = contacts(&[&[1.0]], &[-1.0]);
    for x in [f64::NAN, INF, -INF] {
        assert!(!judge(&lcp, &[x], &Demand::default()).verdict.is_solution(), "{x}");
    }
}

#[test]
fn neither_overflow_nor_underflow_hides_a_wrong_answer() {
    // (a x + b) with b = −a: x = 1 solves it, x = 0.9 does not, for any a.
    for a in [1e-320, 1e-300, 1e-200, 1e200, 1e300, 1.7e308] {
        let lcp = contacts(&[&[a]], &[-a]);
        assert_proved(&lcp, &[1.0]);
        let verdict = judge(&lcp, &[0.9], &Demand::default()).verdict;
        assert!(!verdict.is_solution(), "a = {a:e}");
    }
    // a x is the only term and counts: w = 1e-400 > 0 at x > 0 is no solution, but x = 0 is one.
    let lcp = contacts(&[&[1e-200]], &[0.0]);
    assert!(!judge(&lcp, &[1e-200], &Demand::default()).verdict.is_solution());
    assert_proved(&lcp, &[0.0]);
    // Terms that overflow and cancel: 1e200 · 1e200 (1 − 1).
    let lcp = boxed(&[&[1e200, -1e200], &[0.0, 1.0]], &[0.0, -1e200], &[-INF; 2], &[INF; 2]);
    assert_proved(&lcp, &[1e200, 1e200]);
}

#[test]
fn the_empty_problem_is_solved_by_nothing() {
    let lcp = contacts(&[], &[]);
    assert_proved(&lcp, &[]);
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn a_manufactured_solution_is_proved_where_it_lies(m in manufactured(6, 4, 0.0)) {
        let verdict = judge(&m.lcp, &m.x, &Demand::default()).verdict;
        prop_assert_eq!(verdict, Verdict::Proved { distance: 0.0 });
    }

    #[test]
    fn scaling_rows_and_columns_by_powers_of_two_moves_no_residual(
        m in manufactured(5, 5, 1.0),
        powers in proptest::collection::vec(-8i32..=8, 5),
        moved in proptest::collection::vec(-1.0f64..1.0, 5),
    ) {
        // D A D x' + D b with x = D x' is the same problem in other units.
        let d: Vec<f64> = powers.iter().map(|&k| 2f64.powi(k)).collect();
        let n = d.len();
        let entries: Vec<f64> = (0..n * n)
            .map(|k| d[k / n] * m.lcp.matrix().entry(k / n, k % n) * d[k % n]).collect();
        let scale = |v: &[f64], by: &dyn Fn(f64, f64) -> f64| -> Vec<f64> {
            v.iter().zip(&d).map(|(v, d)| by(*v, *d)).collect()
        };
        let (mul, div) = (|v: f64, d: f64| v * d, |v: f64, d: f64| v / d);
        let other = lcplab_lcp::Lcp::new(
            lcplab_lcp::Matrix::dense(n, &entries),
            scale(m.lcp.b(), &mul), scale(m.lcp.lo(), &div), scale(m.lcp.hi(), &div),
        ).unwrap();
        let x: Vec<f64> = m.x.iter().zip(&moved).map(|(x, d)| x + d).collect();
        let demand = Demand::default();
        prop_assert_eq!(
            judge(&m.lcp, &x, &demand).scaled_residual,
            judge(&other, &scale(&x, &div), &demand).scaled_residual
        );
    }
}

#[test]
fn each_verdict_has_its_word_and_its_sentence() {
    for (verdict, word, text, distance) in [
        (
            Verdict::Proved { distance: 0.25 },
            "proved",
            "proved: an exact solution exists within 0.25 of x",
            Some(0.25),
        ),
        (Verdict::WithinTolerance, "within_tolerance", "within tolerance", None),
        (
            Verdict::NotASolution {
                row: 7,
                amount: 0.5,
                why: Refusal::Residual { tolerance: 1e-8 },
            },
            "not_a_solution",
            "not a solution: scaled residual 0.5 in row 7, above the tolerance 10⁻⁸",
            None,
        ),
    ] {
        assert_eq!((verdict.word(), verdict.to_string().as_str()), (word, text));
        assert_eq!(
            (verdict.distance(), verdict.is_solution()),
            (distance, word != "not_a_solution")
        );
    }
}

#[test]
fn an_x_far_out_is_no_answer_to_a_problem_without_one() {
    // `wedged`: both walls push, w = (x₀ − x₁ − 1, x₁ − x₀ − 1).
    let wedged = contacts(&[&[1.0, -1.0], &[-1.0, 1.0]], &[-1.0, -1.0]);
    let certificate = judge(&wedged, &[1e9, 1e9], &Demand::default());
    assert!(certificate.scaled_residual < 1e-8);
    assert!(matches!(
        certificate.verdict,
        Verdict::NotASolution { why: Refusal::NoBetterThanZero, .. }
    ));
    // Five rows of which spectral gradients once said "solved" at 5e6, with w₀ = ½.
    let a: [&[f64]; 5] = [
        &[5.0, -6.0, -4.0, -1.0, -3.0],
        &[-6.0, 8.0, 4.0, 0.0, 4.0],
        &[-4.0, 4.0, 4.0, 2.0, 2.0],
        &[-1.0, 0.0, 2.0, 2.0, 0.0],
        &[-3.0, 4.0, 2.0, 0.0, 2.0],
    ];
    let b = [-2.0, -2.0, 3.0, 3.0, 1.0];
    let (lo, hi) = ([-INF, -1.0, -1.0, -INF, -INF], [0.0, -1.0, -1.0, INF, 2.0]);
    let lcp = boxed(&a, &b, &lo, &hi);
    let null = [-5e6, -1.0, -1.0, -5e6 / 2.0, -5e6];
    assert!(!judge(&lcp, &null, &Demand::default()).verdict.is_solution());
    for entry in lcplab_solver::Registry::standard().entries() {
        let solver = entry.build(&Options::default());
        let solution = solver.solve(&lcp, &Start::default(), &mut ());
        let answer = Answer::judged(&lcp, &*entry.name, solution, &Demand::default());
        assert!(!answer.certificate.verdict.is_solution(), "{}", entry.name);
    }
}

#[test]
fn a_proof_at_a_distance_that_says_nothing_is_no_proof() {
    // x* = 0 solves it, and x = −1000 violates its bound by 1000: 1e-9 of terms of 1e12.
    let lcp = contacts(&[&[1.0]], &[1e12]);
    let certificate = judge(&lcp, &[-1000.0], &Demand::default());
    assert_eq!(certificate.verdict, Verdict::WithinTolerance);
    assert_eq!(certificate.evidence, Some(Evidence::FarSolution { distance: 1000.0 }));
    // Nearly dependent rows: the active set of x = (1, 1) has its solution millions away.
    let e = 2f64.powi(-40);
    let lcp = boxed(&[&[1.0, 1.0], &[1.0, 1.0 + e]], &[-2.0, -2.0 - 1e-9], &[-INF; 2], &[INF; 2]);
    let certificate = judge(&lcp, &[1.0, 1.0], &Demand::default());
    let Some(Evidence::FarSolution { distance }) = certificate.evidence else { panic!() };
    assert_eq!(certificate.verdict, Verdict::WithinTolerance);
    assert!((distance / (1e-9 / e) - 1.0).abs() < 1e-3);
}

#[test]
fn status_verdict_and_message_agree_where_there_is_no_solution() {
    // x₁ = 1 is pinned, so w₀ = 1 − 1.000000001 < 0 though hi₀ = ∞: no solution, by 1e-9.
    let a: [&[f64]; 2] = [&[0.0, 1.0], &[1.0, 1.0]];
    let lcp = boxed(&a, &[-1.000000001, 0.0], &[0.0, 1.0], &[INF, 1.0]);
    for entry in lcplab_solver::Registry::standard().entries() {
        let solver = entry.build(&Options::default());
        let solution = solver.solve(&lcp, &Start::default(), &mut ());
        let answer = Answer::judged(&lcp, &*entry.name, solution, &Demand::default());
        assert!(!answer.certificate.verdict.is_solution(), "{}", entry.name);
        let is_infeasible = answer.status_word() == "infeasible";
        assert!(!is_infeasible || answer.certificate.refutation().is_some(), "{}", entry.name);
        assert_eq!(is_infeasible, answer.message().starts_with("no solution exists"));
    }
}

#[test]
fn the_message_of_a_solver_that_gave_up_says_so_if_its_x_is_accepted() {
    let lcp = contacts(&[&[2.0, -1.0], &[-1.0, 2.0]], &[-1.0, 2.0]);
    let message = |x: [f64; 2], status: Status| {
        let solution = Solution::new(&lcp, x.to_vec(), status, 7);
        let answer = Answer::judged(&lcp, "pgs", solution, &Demand::default());
        (answer.status_word(), answer.message())
    };
    let accepted = "; the judge nevertheless accepts x";
    for (status, word) in [
        (Status::IterationLimit, "iteration_limit"),
        (Status::Inaccurate, "iteration_limit"),
        (Status::ZeroDiagonal { row: 1 }, "failed"),
    ] {
        let text = status.to_string();
        assert_eq!(message([0.5, 0.0], status.clone()), (word, text.clone() + accepted));
        assert_eq!(message([0.4, 0.0], status), (word, text));
    }
    assert_eq!(message([0.5, 0.0], Status::Solved), ("solved", "solved".into()));
}

/// Parses a printed number: `1.1×10⁻⁹`, `10,000`.
fn read(printed: &str) -> f64 {
    let lowered = |c: char| match c {
        '⁻' => Some('-'),
        ',' => None,
        c => Some(
            "⁰¹²³⁴⁵⁶⁷⁸⁹"
                .chars()
                .position(|raised| raised == c)
                .map_or(c, |k| (b'0' + k as u8) as char),
        ),
    };
    printed.replace("×10", "e").chars().filter_map(lowered).collect::<String>().parse().unwrap()
}

#[test]
fn a_bound_is_never_printed_below_itself() {
    for bits in 0..2000u64 {
        let bound = f64::from_bits(bits.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> 1);
        if bound.is_finite() {
            let printed = read(&upper_bound(bound));
            assert!(printed >= bound, "{bound:e}");
            assert!(printed <= bound * 1.11 || bound < 1e-322, "{bound:e}");
        }
    }
    // 4.633182726365703e-12 as a decimal is below the double that it represents.
    assert!(printed_up(4.633182726365703e-12) > 4.633182726365703e-12);
    assert_eq!(printed_up(0.25), 0.25);
    let verdict = Verdict::Proved { distance: 1.04e-9 };
    assert!(verdict.to_string().contains("within 1.1×10⁻⁹"));
}

#[test]
fn outside_the_bounds_there_is_no_duality_gap() {
    // w = x + 1 at x = −1e-9 < 0: accepted, but |w| (x − 0) is no bound on the error 1e-9.
    let at = judge(&contacts(&[&[1.0]], &[1.0]), &[-1e-9], &Demand::default());
    assert!(at.verdict.is_solution() && at.duality_gap.is_nan());
}
