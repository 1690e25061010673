//! No forged proof says that a problem with a solution has none.

use dashu_int::IBig;
use lcplab_lcp::exact::all_solutions;
use lcplab_lcp::{Lcp, library};
use lcplab_proof::{Claim, Kind, Proof, Tree, check, hash, prove};
use oorandom::Rand64;

use super::{asked, question, whole};

fn leaf(lcp: &Lcp, d: impl IntoIterator<Item = (usize, i64)>) -> Proof {
    let entries = d.into_iter().filter(|(_, d)| *d != 0).map(|(i, d)| (i, IBig::from(d)));
    let tree = Tree::Leaf(entries.collect());
    Proof { problem: hash(&asked(lcp)), model: None, claim: Claim::NoSolution { tree } }
}

#[test]
fn vectors_that_prove_nothing_are_refused_for_every_problem_of_the_library() {
    let mut random = Rand64::new(4);
    let mut refused = 0;
    for family in library::all() {
        let Ok(of_family) = family.generate(&[]) else { continue };
        let lcp = &of_family.lcp;
        let is_solvable = || {
            let proof = prove(&question(&of_family), &vec![0.0; lcp.len()]).proof.unwrap();
            [Kind::Unique, Kind::NotUnique, Kind::Solution].contains(&proof.claim.kind())
        };
        if lcp.len() > 60 || !is_solvable() {
            continue;
        }
        let n = lcp.len();
        for round in 0..20 {
            let d: Vec<(usize, i64)> = match round {
                0 => (0..n).map(|i| (i, 1)).collect(),
                1 => (0..n).map(|i| (i, -1)).collect(),
                2 => (0..n).map(|i| (i, if lcp.b()[i] < 0.0 { 1 } else { 0 })).collect(),
                3..10 => vec![(random.rand_range(0..n as u64) as usize, 1)],
                _ => (0..n).map(|i| (i, random.rand_range(0..9) as i64 - 4)).collect(),
            };
            assert!(
                check(&asked(lcp), &leaf(lcp, d.clone())).is_err(),
                "{}: {d:?}",
                of_family.name
            );
            refused += 1;
        }
    }
    assert!(refused > 400, "{refused}");
}

#[test]
fn a_tree_of_another_problem_proves_nothing_of_one_with_a_solution() {
    let mut random = Rand64::new(7);
    let problems: Vec<Lcp> = (0..300).map(|k| whole(&mut random, 2 + k % 3)).collect();
    let is_solvable = |lcp: &Lcp| all_solutions(lcp).is_some_and(|all| !all.is_empty());
    let (solvable, others): (Vec<&Lcp>, Vec<&Lcp>) =
        problems.iter().partition(|lcp| is_solvable(lcp));
    let mut tried = 0;
    for other in others {
        let claim = prove(&asked(other), &vec![0.0; other.len()]).proof.unwrap().claim;
        assert_eq!(claim.kind(), Kind::NoSolution);
        for lcp in solvable.iter().filter(|lcp| lcp.len() == other.len()).take(20) {
            let proof = Proof { problem: hash(&asked(lcp)), model: None, claim: claim.clone() };
            assert!(check(&asked(lcp), &proof).is_err());
            tried += 1;
        }
    }
    assert!(tried > 500, "{tried}");
}
