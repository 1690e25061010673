//! One LCP, five costs from 1 to 2ⁿ: Murty's triangular matrix U and Fathi's F = U Uᵀ, b = −1.
//!
//! x = e_n in the numbering that is unfavorable to methods that process row 1 first, e_1 in the
//! favorable one. All counts follow from the rules of the methods in exact arithmetic.

use lcplab_lcp::{Lcp, library};
use lcplab_solver::{Options, Registry, Start, Status, all_solutions};

use lcplab_testing::assert_proved;

const SIZES: [u32; 6] = [2, 4, 6, 8, 10, 12];

fn problem(family: &str, n: u32, reversed: bool) -> Lcp {
    let given = [("n", f64::from(n)), ("reversed", f64::from(u8::from(reversed)))];
    library::by_name(family).unwrap().generate(&given).unwrap().lcp
}

/// The number of iterations from x = 0 to a solution that the judge proves.
#[track_caller]
fn cost(solver: &str, lcp: &Lcp) -> usize {
    let solver = Registry::standard().entry(solver).unwrap().build(&Options::default());
    let solution = solver.solve(lcp, &Start::at(&vec![0.0; lcp.len()]), &mut ());
    assert_eq!(solution.status, Status::Solved);
    assert_proved(lcp, &solution.x);
    solution.iterations
}

#[test]
fn gauss_seidel_needs_two_sweeps_or_one() {
    for n in SIZES {
        assert_eq!(cost("pgs", &problem("fathi", n, false)), 2);
        assert_eq!(cost("pgs", &problem("fathi", n, true)), 1);
    }
}

#[test]
fn dantzig_needs_a_square_number_of_pivots_or_one() {
    for n in SIZES {
        let unfavourable = cost("dantzig", &problem("fathi", n, false)) as u32;
        assert_eq!(unfavourable, n * n - n + 1, "n = {n}");
        assert_eq!(cost("dantzig", &problem("fathi", n, true)), 1);
    }
}

#[test]
fn the_least_index_rule_visits_every_active_set_or_two() {
    for n in SIZES {
        for family in ["murty", "fathi"] {
            assert_eq!(cost("murty", &problem(family, n, false)), (1 << n) - 1);
            assert_eq!(cost("murty", &problem(family, n, true)), 1);
        }
    }
}

#[test]
fn lemkes_path_has_two_pieces_or_every_cone() {
    for n in SIZES {
        for family in ["murty", "fathi"] {
            assert_eq!(cost("lemke", &problem(family, n, false)), 2);
            assert_eq!(cost("lemke", &problem(family, n, true)), 1 << n);
        }
        let given = [("n", f64::from(n))];
        let exponential = library::by_name("murty-exponential").unwrap().generate(&given).unwrap();
        assert_eq!(cost("lemke", &exponential.lcp), 1 << n); // without a tie
    }
}

#[test]
fn block_exchanges_need_one_round_a_row_either_way() {
    for n in SIZES {
        for family in ["murty", "fathi"] {
            for reversed in [false, true] {
                assert_eq!(cost("block-pivoting", &problem(family, n, reversed)) as u32, n);
            }
        }
    }
}

#[test]
fn enumeration_meets_the_solution_halfway_and_finds_no_other() {
    for n in [2, 4, 6, 8] {
        let lcp = problem("fathi", n, false);
        assert_eq!(cost("enumeration", &lcp), (1 << (n - 1)) + 1); // {n} is set number 2ⁿ⁻¹ + 1
        assert_eq!(all_solutions(&lcp).unwrap().len(), 1);
    }
}
