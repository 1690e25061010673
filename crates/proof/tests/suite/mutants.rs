//! A proof that was tampered with is refused, or says something that is true all the same: then the checker that
//! shares nothing with this crate accepts it too.

use std::path::Path;
use std::process::Command;

use lcplab_problem::file::Problem;
use lcplab_proof::{Claim, Kind, Proof, check, exact_residual, hash, prove, prove_kind};
use oorandom::Rand64;

use super::{problem, whole, with_bodies};

/// So many by `cargo test`; the variable LCPLAB_MUTANTS asks for another number, and LCPLAB_NODE names a Node.js, for
/// the checker in JavaScript.
const MUTANTS: usize = 500;

/// Something else in the text of a proof: a digit, a sign, a letter, a swapped word, an end that is missing.
fn mutated(text: &str, random: &mut Rand64) -> String {
    let mut bytes = text.as_bytes().to_vec();
    let mut below = |n: usize| random.rand_range(0..n as u64) as usize;
    let begin = text.find("\"kind\"").unwrap_or(0);
    let at = begin + below(bytes.len() - begin);
    match below(8) {
        0 => bytes.truncate(at),
        1 => bytes[at] = b"0123456789abcdef-\"{}[],:"[below(24)],
        2 => drop(bytes.remove(at)),
        3 => bytes.insert(at, b"0123456789abcdef-"[below(17)]),
        4 => return text.replacen("lo", "hi", 1),
        5 => return text.replacen("\"free\"", "\"lo\"", 1),
        _ => {
            let digits: Vec<usize> =
                (begin..bytes.len()).filter(|&k| bytes[k].is_ascii_digit()).collect();
            bytes[digits[below(digits.len())]] = b"0123456789abcdef"[below(16)];
        }
    }
    String::from_utf8(bytes).unwrap()
}

/// A proof about the residual of some answer: often on a bound, or so near to one that only rounding is between.
fn within(problem: &Problem, random: &mut Rand64) -> Option<Proof> {
    let lcp = &problem.lcp;
    let mut answer: Vec<f64> =
        (0..lcp.len()).map(|_| random.rand_range(0..9) as f64 / 3.0 - 1.0).collect();
    for i in 0..lcp.len() {
        let (lo, hi) = lcp.bounds(i, &answer);
        answer[i] = match random.rand_range(0..5) {
            0 if lo.is_finite() => lo,
            1 if hi.is_finite() => hi,
            2 if hi.is_finite() => hi.next_up(),
            3 if hi.is_finite() => hi * (1.0 + 5.0 * f64::EPSILON),
            _ => answer[i],
        };
    }
    let residual = exact_residual(lcp, &answer)?;
    Some(Proof { problem: hash(problem), claim: Claim::Within { answer, residual } })
}

/// A proof about the motion of an answer of halves.
fn motion(problem: &Problem, random: &mut Rand64) -> Option<Proof> {
    let answer: Vec<f64> =
        (0..problem.lcp.len()).map(|_| random.rand_range(0..9) as f64 / 2.0 - 1.0).collect();
    let kind = if problem.lcp.has_coupled_rows() { Kind::FrozenMotion } else { Kind::Motion };
    prove_kind(problem, &answer, kind).proof
}

#[test]
fn all_checkers_say_the_same_of_every_mutant() {
    let mut random = Rand64::new(2022);
    let folder = tempfile::tempdir().unwrap();
    let count =
        std::env::var("LCPLAB_MUTANTS").ok().and_then(|n| n.parse().ok()).unwrap_or(MUTANTS);
    let mut expected = Vec::new();
    for k in 0..count {
        let lcp = whole(&mut random, 1 + k % 4);
        let n = lcp.len();
        let subject = if k % 2 == 0 { with_bodies(&lcp, &mut random) } else { problem(&lcp) };
        let proof = match k % 6 {
            0 | 3 => within(&subject, &mut random),
            2 => motion(&subject, &mut random),
            _ => None,
        };
        let proof = proof.or_else(|| prove(&subject, &vec![0.0; n]).proof).unwrap();
        let text = proof.to_json().to_string();
        let text = match k % 10 {
            0 => text, // as it is
            // about another problem of this size, with its hash
            1 => {
                let other = whole(&mut random, n);
                let other = Problem { lcp: other, ..subject.clone() };
                let text = text.replace(&hash(&subject), &hash(&other));
                expected.push((k, holds(&other, &text)));
                write(folder.path(), k, &other, &text);
                continue;
            }
            _ => mutated(&text, &mut random),
        };
        expected.push((k, holds(&subject, &text)));
        write(folder.path(), k, &subject, &text);
    }
    let accepted = expected.iter().filter(|(_, holds)| *holds).count();
    assert!(accepted >= count / 10 && accepted < count / 2, "{accepted} of {count}");
    let with_node = std::env::var_os("LCPLAB_NODE").map(|node| (node, "lcpcheck.js"));
    for (program, checker) in [("python3".into(), "lcpcheck.py")].into_iter().chain(with_node) {
        let checker = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../proofs").join(checker);
        let output = Command::new(program).arg(checker).arg(folder.path()).output().unwrap();
        let printed = String::from_utf8(output.stdout).unwrap();
        let said: Vec<bool> = (printed.lines().filter(|line| line.contains(".proof.json: ")))
            .map(|line| line.contains(": proved: "))
            .collect();
        assert_eq!(said.len(), count, "{printed}");
        for (said, (k, holds)) in said.into_iter().zip(&expected) {
            let path = folder.path().join(format!("{k:06}.proof.json"));
            assert_eq!(said, *holds, "{}", std::fs::read_to_string(path).unwrap());
        }
    }
}

fn holds(problem: &Problem, text: &str) -> bool {
    Proof::parse(text, "proof.json").is_ok_and(|proof| check(problem, &proof).is_ok())
}

fn write(folder: &Path, k: usize, problem: &Problem, text: &str) {
    let path = folder.join(format!("{k:06}.json"));
    std::fs::write(path, problem.to_json().to_string()).unwrap();
    std::fs::write(folder.join(format!("{k:06}.proof.json")), text).unwrap();
}
