//! Whether a solution is the only one, up to 12 rows: games whose equilibria are known, and
//! problems of small integers whose active sets are all tried by code that shares nothing with the
//! search.

use lcplab_judge::cases::{MOST_PROGRAMS, Search, search};
use lcplab_lcp::exact::SolutionSet;
use lcplab_lcp::{Lcp, Matrix};
use lcplab_proof::{Kind, check, prove_different, prove_kind};
use oorandom::Rand64;

use super::checkers::{others, own};
use super::{INF, asked, contacts, problem, whole};

/// The equilibria of a zero-sum game with this payoff, one row for each strategy of either player:
/// w = (C y − 1, Dᵀ x − 1) with C = k − payoff and D = k + payoff, both positive.
fn game(payoff: &[&[f64]]) -> Lcp {
    let (rows, columns) = (payoff.len(), payoff[0].len());
    let n = rows + columns;
    let mut a = vec![0.0; n * n];
    for (i, line) in payoff.iter().enumerate() {
        for (j, value) in line.iter().enumerate() {
            a[i * n + rows + j] = 8.0 - value;
            a[(rows + j) * n + i] = 8.0 + value;
        }
    }
    contacts(&a, &vec![-1.0; n])
}

/// n strategies in a circle: each one beats the (n − 1)/2 strategies that follow it.
fn circle(n: usize) -> Vec<Vec<f64>> {
    let beats = |i: usize, j: usize| match (j + n - i) % n {
        0 => 0.0,
        ahead if 2 * ahead < n => 1.0,
        _ => -1.0,
    };
    (0..n).map(|i| (0..n).map(|j| beats(i, j)).collect()).collect()
}

fn lines(payoff: &[Vec<f64>]) -> Vec<&[f64]> {
    payoff.iter().map(Vec::as_slice).collect()
}

/// A solution by the pieces, which do not share code with the search: the first one found.
fn solution(lcp: &Lcp) -> Option<Vec<f64>> {
    let set = SolutionSet::of(lcp).expect("few pieces");
    Some(set.corners.first()?.iter().map(|x| x.to_f64().value()).collect())
}

/// A solution that the case distinction finds.
fn first_solution(lcp: &Lcp) -> Vec<f64> {
    let Some(Search::Solution(point)) = search(lcp, MOST_PROGRAMS) else { panic!("no solution") };
    point.entries().iter().map(|x| x.to_f64().value()).collect()
}

/// Whether there is another solution, with its proof accepted by all checkers, or the reason.
fn has_another(lcp: &Lcp, answer: &[f64]) -> bool {
    let found = prove_kind(&asked(lcp), answer, Kind::NotUnique);
    let Some(proof) = found.proof else {
        let reason = &found.missing[0].1;
        assert_eq!(reason, "all cases were tried, and there is no other solution", "{lcp:?}");
        return false;
    };
    assert_eq!(check(&asked(lcp), &proof), Ok(()));
    true
}

/// In a circle of 5 strategies only the uniform mix is an equilibrium (Fisher and Ryan 1992).
#[test]
fn a_circle_of_five_strategies_has_one_equilibrium_in_ten_rows() {
    assert!(!has_another(&game(&lines(&circle(5))), &[1.0 / 40.0; 10]));
}

/// A sixth strategy that loses to all others is never played, and the equilibrium stays the only
/// one: 12 rows, of which two carry nothing.
#[test]
fn a_losing_strategy_leaves_one_equilibrium_in_twelve_rows() {
    let mut payoff = circle(5);
    payoff.iter_mut().for_each(|line| line.push(1.0));
    payoff.push([[-1.0; 5].as_slice(), &[0.0]].concat());
    let one = [[1.0 / 40.0; 5].as_slice(), &[0.0]].concat();
    assert!(!has_another(&game(&lines(&payoff)), &one.repeat(2)));
}

/// Matching pennies with a third row that pays 0, the value of the game, in any case: it may be
/// mixed in, so the degenerate equilibrium is not the only one.
#[test]
fn a_strategy_that_pays_the_value_of_the_game_may_be_mixed_in() {
    let answer = [1.0 / 16.0, 1.0 / 16.0, 0.0, 1.0 / 16.0, 1.0 / 16.0];
    assert!(has_another(&game(&[&[1.0, -1.0], &[-1.0, 1.0], &[0.0, 0.0]]), &answer));
}

/// b = 0 and a matrix of positive entries: xᵀA x > 0 for every x ≥ 0 but 0, so 0 is the only
/// solution, where all twelve rows are degenerate. A + Aᵀ is indefinite, and A no P-matrix.
#[test]
fn a_solution_whose_rows_are_all_degenerate_can_be_the_only_one() {
    let a: Vec<f64> = (0..144).map(|k| [2.0, 1.0][usize::from(k % 13 == 0)]).collect();
    assert!(!has_another(&contacts(&a, &[0.0; 12]), &[0.0; 12]));
}

/// Each strategy of rock, paper, scissors twice: either copy may be played. 12 rows.
#[test]
fn doubled_strategies_have_other_equilibria_in_twelve_rows() {
    let one = circle(3);
    let twice: Vec<Vec<f64>> =
        (0..6).map(|i| (0..6).map(|j| one[i % 3][j % 3]).collect()).collect();
    let lcp = game(&lines(&twice));
    let answer = [1.0 / 48.0; 12];
    assert!(has_another(&lcp, &answer));
    let proof = prove_kind(&asked(&lcp), &answer, Kind::NotUnique).proof.unwrap();
    let pair = (problem(&lcp).to_json().to_string(), proof.to_json().to_string());
    assert_eq!(own(&pair.0, &pair.1), "proved");
    for (checker, verdicts) in others(&[pair]) {
        assert_eq!(verdicts, ["proved"], "{checker}");
    }
}

/// Small integers, where many rows are degenerate: the search and all pieces agree.
#[test]
fn the_search_finds_another_solution_exactly_where_the_pieces_have_one() {
    let mut random = Rand64::new(53);
    let mut seen = [0; 2];
    for round in 0..300 {
        let lcp = whole(&mut random, 1 + round % 6);
        let set = SolutionSet::of(&lcp).unwrap();
        if set.corners.is_empty() {
            continue;
        }
        let has = has_another(&lcp, &solution(&lcp).unwrap());
        // A set without corners of its own, such as a line, is represented by a single point.
        if has || set.rays.is_empty() && !has_line(&lcp) {
            assert_eq!(has, !set.is_unique() || has_line(&lcp), "{lcp:?}");
        }
        seen[usize::from(has)] += 1;
    }
    assert!(seen.iter().all(|&count| count > 40), "{seen:?}");
}

/// Whether a row has no bounds, so that the set of solutions may contain a line.
fn has_line(lcp: &Lcp) -> bool {
    (0..lcp.len()).any(|i| lcp.lo()[i] == -INF && lcp.hi()[i] == INF && !lcp.is_coupled(i))
}

/// Twelve rows of small integers.
#[test]
fn twelve_rows_agree_with_all_pieces() {
    let mut random = Rand64::new(12);
    let mut seen = [0; 2];
    for round in 0..8 {
        // Entries that push the rows apart: several of them can carry the load.
        let least = if round % 2 == 0 { -1.0 } else { 0.0 };
        let mut entry = |k: usize| match k % 13 {
            0 => 1.0,
            _ => random.rand_range(0..3) as f64 + least,
        };
        let a: Vec<f64> = (0..144).map(&mut entry).collect();
        let b: Vec<f64> = (0..12).map(|_| random.rand_range(0..5) as f64 - 3.0).collect();
        let lcp = contacts(&a, &b);
        let set = SolutionSet::of(&lcp).unwrap();
        if set.corners.is_empty() {
            continue;
        }
        let has = has_another(&lcp, &solution(&lcp).unwrap());
        assert_eq!(has, !set.is_unique(), "{lcp:?}");
        seen[usize::from(has)] += 1;
    }
    assert!(seen.iter().all(|&count| count > 0), "{seen:?}");
}

/// Twelve rows with two bounds have 531,441 active sets, too many to try one by one. Every row by
/// itself has three solutions, −1, 0 and 1, or one.
#[test]
fn twelve_rows_with_two_bounds_are_decided() {
    for (diagonal, is_unique) in [(1.0, true), (-1.0, false)] {
        let entry = |k: usize| match (k / 12, k % 12) {
            (i, j) if i == j => diagonal,
            // Above the diagonal alone, so that A is not definite; row 11 stays by itself.
            (i, j) if j > i => 4.0,
            _ => 0.0,
        };
        let a: Vec<f64> = (0..144).map(entry).collect();
        let (lo, hi) = (vec![-1.0; 12], vec![1.0; 12]);
        let lcp = Lcp::new(Matrix::dense(12, &a), vec![0.0; 12], lo, hi).unwrap();
        let found = prove_kind(&asked(&lcp), &[0.0; 12], Kind::NotUnique);
        assert_eq!(found.proof.is_none(), is_unique, "{found:?}");
        if is_unique {
            let reason = "all cases were tried, and there is no other solution";
            assert_eq!(found.missing[0].1, reason);
        }
    }
}

/// Random boxes with full matrices: the proof of a second solution, or all cases, in every one.
#[test]
fn full_matrices_of_twelve_boxes_are_decided() {
    let mut random = Rand64::new(7);
    for _ in 0..4 {
        let mut entry = |k: usize| match k % 13 {
            0 => 4.0,
            _ => random.rand_range(0..5) as f64 - 2.0,
        };
        let a: Vec<f64> = (0..144).map(&mut entry).collect();
        let b: Vec<f64> = (0..12).map(|_| random.rand_range(0..9) as f64 - 4.0).collect();
        let lcp = Lcp::new(Matrix::dense(12, &a), b, vec![-1.0; 12], vec![1.0; 12]).unwrap();
        has_another(&lcp, &first_solution(&lcp));
    }
}

/// Two plants ship 50 and 60 to two markets that take 30 and 25, at costs (2, 3; 2, 4). Shipping
/// from either plant to market 1 costs 2, so several plans cost as little.
fn transport() -> Lcp {
    let mut a = vec![0.0; 64];
    for (shipment, (plant, market)) in [(4, 6), (4, 7), (5, 6), (5, 7)].into_iter().enumerate() {
        for (row, sign) in [(plant, 1.0), (market, -1.0)] {
            a[shipment * 8 + row] = sign;
            a[row * 8 + shipment] = -sign;
        }
    }
    contacts(&a, &[2.0, 3.0, 2.0, 4.0, 50.0, 60.0, -30.0, -25.0])
}

/// All of it from either plant: both plans, given as answers, prove that neither is the only one.
#[test]
fn two_given_answers_prove_that_neither_is_the_only_one() {
    let lcp = transport();
    let plans =
        [[25.0, 25.0, 5.0, 0.0, 0.0, 0.0, 2.0, 3.0], [0.0, 25.0, 30.0, 0.0, 0.0, 0.0, 2.0, 3.0]];
    let found = prove_different(&asked(&lcp), &plans[0], &plans[1]);
    let proof = found.proof.unwrap_or_else(|| panic!("{:?}", found.missing));
    assert_eq!(proof.claim.kind(), Kind::NotUnique);
    assert_eq!(check(&asked(&lcp), &proof), Ok(()));
    let pair = (problem(&lcp).to_json().to_string(), proof.to_json().to_string());
    for (checker, verdicts) in others(&[pair]) {
        assert_eq!(verdicts, ["proved"], "{checker}");
    }
}

/// An answer twice, or one that is off by a thousandth, proves nothing.
#[test]
fn one_answer_twice_or_a_wrong_one_proves_nothing() {
    let lcp = transport();
    let plan = [25.0, 25.0, 5.0, 0.0, 0.0, 0.0, 2.0, 3.0];
    let mut wrong = plan;
    wrong[6] = 2.1;
    let reason = |second: &[f64]| {
        let found = prove_different(&asked(&lcp), &plan, second);
        assert!(found.proof.is_none());
        found.missing[0].1.clone()
    };
    assert_eq!(reason(&plan), "both answers lie next to the same exact solution");
    assert!(reason(&wrong).starts_with("the second answer"), "{}", reason(&wrong));
    assert_eq!(reason(&[f64::NAN; 8]), "the second answer is not finite");
}
