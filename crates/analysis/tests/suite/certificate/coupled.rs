//! Rows with friction, judged by the original problem: with bounds that depend on x, not frozen
//! ones.

use dashu_int::ops::Abs;
use dashu_ratio::RBig;
use lcplab_judge::{
    Certificate, Demand, Evidence, Refusal, Refutation, Verdict, judge, refutation,
};
use lcplab_lcp::exact::all_solutions;
use lcplab_lcp::{Coupling, Lcp, Matrix};
use lcplab_solver::{Options, Registry, Start, Status};
use proptest::prelude::*;

use lcplab_testing::{INF, cases};

/// A normal row and its tangents, |x_t| ≤ μ x_n.
fn contact(rows: &[&[f64]], b: &[f64], mu: f64) -> Lcp {
    let n = b.len();
    let (mut lo, hi) = (vec![-INF; n], vec![INF; n]);
    lo[0] = 0.0;
    let index = (0..n).map(|i| (i > 0).then_some(0)).collect();
    let coupling = Coupling::new(index, vec![mu; n]).unwrap();
    let lcp = Lcp::new(Matrix::dense(n, &rows.concat()), b.to_vec(), lo, hi).unwrap();
    lcp.with_coupling(coupling).unwrap()
}

fn judged(lcp: &Lcp, x: &[f64]) -> Certificate {
    judge(lcp, x, &Demand::default())
}

fn exact(x: f64) -> RBig {
    RBig::try_from(x).unwrap()
}

#[test]
fn a_solution_on_the_cone_is_proved_where_frozen_bounds_have_none() {
    // x = (2, 1): w_n = 2 − 1 − 1 = 0 and w_t = −2 + 1 − 5 = −6 < 0 with x_t = ½ x_n.
    let lcp = contact(&[&[1.0, -1.0], &[-1.0, 1.0]], &[-1.0, -5.0], 0.5);
    assert_eq!(judged(&lcp, &[2.0, 1.0]).verdict, Verdict::Proved { distance: 0.0 });
    assert_eq!(refutation(&lcp, &[], 0.0), None);
}

#[test]
fn a_problem_without_solution_proves_nothing_of_any_x() {
    // w_n + w_t = −1.5 for any x. w_n ≥ 0 requires w_t < 0, so x_t = x_n, and then w_n = −1.
    let lcp = contact(&[&[1.0, -1.0], &[-1.0, 1.0]], &[-1.0, -0.5], 1.0);
    assert_eq!(all_solutions(&lcp), Some(vec![]));
    for x in [[1e9, 1e9], [0.0, 0.0], [1e4, 1e4], [3.0, 2.0]] {
        assert!(!judged(&lcp, &x).verdict.is_solution(), "{x:?}");
    }
    assert!(matches!(refutation(&lcp, &[], 0.0), Some(Refutation::CaseSplit { .. })));
}

#[test]
fn the_distance_is_to_a_solution_of_the_coupled_problem() {
    // x_n = 1 + e, and x_t = x_n follows it: both have the error e, where frozen bounds would give
    // 0 for x_t.
    let lcp = contact(&[&[1.0, 0.0], &[0.0, 1.0]], &[-1.0, -5.0], 1.0);
    let e = 2f64.powi(-40);
    let Verdict::Proved { distance } = judged(&lcp, &[1.0 + e, 1.0 + e]).verdict else { panic!() };
    assert!((e..e * (1.0 + 1e-9)).contains(&distance), "{distance}"); // rounded up
}

#[test]
fn a_contact_with_dependent_tangents_is_solved_by_its_sides() {
    // Both tangents are equal: x = (1, 2, 2)/111 lies on both sides of the pyramid.
    let a: [&[f64]; 3] = [&[27.0, 21.0, 21.0], &[21.0, 17.0, 17.0], &[21.0, 17.0, 17.0]];
    let lcp = contact(&a, &[-1.0, -1.0, -2.0], 2.0);
    let solution = Registry::standard().entry("enumeration").unwrap().build(&Options::default());
    let solution = solution.solve(&lcp, &Start::default(), &mut ());
    assert_eq!(solution.status, Status::Solved);
    assert!(matches!(judged(&lcp, &solution.x).verdict, Verdict::Proved { .. }));
    let third = RBig::from_parts(1.into(), 111u8.into());
    let wanted = vec![third.clone(), &third + &third, &third + &third];
    assert!(all_solutions(&lcp).unwrap().contains(&wanted));
}

#[test]
fn three_solutions_of_one_contact_are_found() {
    let lcp = contact(&[&[10.0, 8.0], &[8.0, 8.0]], &[1.0, 3.0], 2.0);
    let all = all_solutions(&lcp).unwrap();
    // At rest; on the lower side, x_n (10 − 16) + 1 = 0; sticking, x_n = (b_t − b_n)/2 = 1.
    let solutions: Vec<Vec<RBig>> = [[0.0, 0.0], [1.0, -1.375]]
        .iter()
        .map(|x| x.iter().map(|&x| exact(x)).collect())
        .chain([vec![
            RBig::from_parts(1.into(), 6u8.into()),
            RBig::from_parts((-1).into(), 3u8.into()),
        ]])
        .collect();
    assert_eq!(all.len(), 3);
    assert!(solutions.iter().all(|x| all.contains(x)), "{all:?}");
}

#[test]
fn enumeration_says_by_how_many_pieces_there_is_no_solution() {
    let lcp = contact(&[&[1.0, -1.0], &[-1.0, 1.0]], &[-1.0, -0.5], 1.0);
    let enumeration = Registry::standard().entry("enumeration").unwrap().build(&Options::default());
    // A worthless start is not accepted as a solution.
    let start = [1e9, 1e9];
    for start in [Start::default(), Start::at(&start)] {
        let solution = enumeration.solve(&lcp, &start, &mut ());
        assert_eq!((solution.status, solution.iterations), (Status::NoSolution, 6));
    }
}

#[test]
fn rows_with_friction_have_no_part_in_a_proof_by_a_vector() {
    // A wall that closes in (rows 0 and 1), with friction on row 0: d = (1, 1, 0) proves it.
    let a = [1.0, -1.0, 0.0, -1.0, 1.0, 0.0, 0.0, 0.0, 1.0];
    let (lo, hi) = (vec![0.0, 0.0, -INF], vec![INF; 3]);
    let lcp = Lcp::new(Matrix::dense(3, &a), vec![-1.0, -1.0, 0.5], lo, hi).unwrap();
    let coupling = Coupling::new(vec![None, None, Some(0)], vec![0.0, 0.0, 0.5]).unwrap();
    let lcp = lcp.with_coupling(coupling).unwrap();
    let Some(Refutation::Vector(farkas)) = refutation(&lcp, &[], 0.0) else { panic!() };
    assert_eq!(farkas.vector[0], farkas.vector[1]);
    assert_eq!(farkas.vector[2], RBig::ZERO);
}

/// Small problems of one or two contacts in the plane or in space, with integers: A = JJᵀ + shift.
fn small(shift: f64) -> impl Strategy<Value = Lcp> {
    let numbers = |count| proptest::collection::vec(-3i32..=3, count);
    let mu = prop::sample::select(vec![0.0, 0.25, 0.5, 1.0, 2.0, 4.0]);
    (1usize..=2, 1usize..=2, 1usize..=4).prop_flat_map(move |(contacts, tangents, columns)| {
        let n = contacts * (1 + tangents);
        (numbers(n * columns), numbers(n), proptest::collection::vec(mu.clone(), n)).prop_map(
            move |(j, b, mu)| {
                let j = |i: usize, k: usize| f64::from(j[i * columns + k]);
                let product =
                    |i: usize, l: usize| (0..columns).map(|k| j(i, k) * j(l, k)).sum::<f64>();
                let entry = |i: usize, l: usize| product(i, l) + if i == l { shift } else { 0.0 };
                let a: Vec<f64> = (0..n)
                    .flat_map(|i| (0..n).map(move |l| (i, l)))
                    .map(|(i, l)| entry(i, l))
                    .collect();
                let normal = |i: usize| i - i % (1 + tangents);
                let is_normal = |i: usize| normal(i) == i;
                let lo = (0..n).map(|i| if is_normal(i) { 0.0 } else { -INF }).collect();
                let b = b.iter().map(|&b| f64::from(b)).collect();
                let lcp = Lcp::new(Matrix::dense(n, &a), b, lo, vec![INF; n]).unwrap();
                let index = (0..n).map(|i| (!is_normal(i)).then_some(normal(i))).collect();
                lcp.with_coupling(Coupling::new(index, mu).unwrap()).unwrap()
            },
        )
    })
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn what_is_proved_lies_as_near_as_it_says(lcp in small(1.0), noise in 0usize..3) {
        // A is definite: the solutions form polytopes, and a single vertex is an isolated solution.
        let Some(all) = all_solutions(&lcp) else { return Ok(()) };
        for x in &all {
            let shift = [0.0, 1e-12, 1e-10][noise];
            let given: Vec<f64> = x.iter().map(|x| x.to_f64().value() * (1.0 + shift)).collect();
            let certificate = judged(&lcp, &given);
            prop_assert!(certificate.verdict.is_solution(), "{:?}", certificate.verdict);
            let isolated = all.len() == 1;
            if let (true, Some(stated)) = (isolated, certificate.verdict.distance()) {
                let distances = x.iter().zip(&given).map(|(x, given)| (x - exact(*given)).abs());
                let largest = distances.max().unwrap();
                prop_assert!(largest <= exact(stated));
                prop_assert!(exact(stated) <= largest * exact(1.0 + 2e-6) + exact(1e-300));
            }
        }
    }

    #[test]
    fn an_impossible_problem_has_no_accepted_answer_and_a_possible_one_no_refutation(
        lcp in small(0.0), x in proptest::collection::vec(-1e9f64..1e9, 6)
    ) {
        let Some(all) = all_solutions(&lcp) else { return Ok(()) };
        prop_assert_eq!(refutation(&lcp, &[], 0.0).is_some(), all.is_empty());
        for scale in [1.0, 1e-9, 1e9] {
            let mut x: Vec<f64> = x[..lcp.len()].iter().map(|x| x * scale).collect();
            lcp.project_all(&mut x);
            let certificate = judged(&lcp, &x);
            prop_assert!(!all.is_empty() || !certificate.verdict.is_solution());
            let is_impossible = matches!(
                certificate.verdict,
                Verdict::NotASolution { why: Refusal::Impossible, .. }
            );
            prop_assert_eq!(is_impossible, matches!(certificate.evidence, Some(Evidence::NoSolution(_))));
            prop_assert!(all.is_empty() || !is_impossible);
        }
    }

    #[test]
    fn what_every_solver_claims_is_what_all_pieces_say(lcp in small(0.0)) {
        let Some(all) = all_solutions(&lcp) else { return Ok(()) };
        for name in ["pgs", "dantzig", "lemke", "block-pivoting", "newton", "enumeration"] {
            let solver = Registry::standard().entry(name).unwrap().build(&Options::default());
            let solution = solver.solve(&lcp, &Start::default(), &mut ());
            if solution.status == Status::Solved {
                let verdict = judged(&lcp, &solution.x).verdict;
                prop_assert_eq!(verdict.is_solution(), !all.is_empty(), "{}", name);
            }
            prop_assert!(solution.status != Status::NoSolution || all.is_empty(), "{}", name);
        }
    }
}
