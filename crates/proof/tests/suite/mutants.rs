//! A proof that was tampered with, or one of a problem that was, is refused, or says something that
//! is true all the same: then the checkers that share nothing with this crate accept it too.

use lcplab_lcp::Question;
use lcplab_lcp::file::Problem;
use lcplab_proof::{Claim, Kind, Proof, exact_residual, hash, prove, prove_kind};
use oorandom::Rand64;

use super::checkers::{Pair, others, own};
use super::{problem, question, whole, with_bodies};

/// The number of mutants under `cargo test`; the variable LCPLAB_MUTANTS sets another one.
const MUTANTS: usize = 500;

/// Something else in a text from a place on: a digit, a sign, a letter, a swapped word, an end that
/// is missing.
pub fn mutated(text: &str, begin: usize, random: &mut Rand64) -> String {
    let mut bytes = text.as_bytes().to_vec();
    let mut below = |n: usize| random.rand_range(0..n as u64) as usize;
    let at = begin + below(bytes.len() - begin);
    match below(8) {
        0 => bytes.truncate(at),
        1 => bytes[at] = b"0123456789abcdef-\"{}[],:.+E"[below(27)],
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

/// A proof about the residual of some answer: often on a bound, or so near to one that only
/// rounding is between.
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
    let claim = Claim::Within { answer, residual };
    Some(Proof { problem: hash(&question(problem)), model: None, claim })
}

/// A proof about the motion of an answer of halves.
fn motion(problem: &Problem, random: &mut Rand64) -> Option<Proof> {
    let answer: Vec<f64> =
        (0..problem.lcp.len()).map(|_| random.rand_range(0..9) as f64 / 2.0 - 1.0).collect();
    let kind = if problem.lcp.has_coupled_rows() { Kind::FrozenMotion } else { Kind::Motion };
    prove_kind(&question(problem), &answer, kind).proof
}

#[test]
fn all_checkers_say_the_same_of_every_mutant() {
    let mut random = Rand64::new(2022);
    let count =
        std::env::var("LCPLAB_MUTANTS").ok().and_then(|n| n.parse().ok()).unwrap_or(MUTANTS);
    let mut pairs: Vec<Pair> = Vec::new();
    for k in 0..count {
        let lcp = whole(&mut random, 1 + k % 4);
        let n = lcp.len();
        let subject = if k % 2 == 0 { with_bodies(&lcp, &mut random) } else { problem(&lcp) };
        let proof = match k % 6 {
            0 | 3 => within(&subject, &mut random),
            2 => motion(&subject, &mut random),
            _ => None,
        };
        let proof = proof.or_else(|| prove(&question(&subject), &vec![0.0; n]).proof).unwrap();
        let (own, text) = (subject.to_json().to_string(), proof.to_json().to_string());
        pairs.push(match k % 10 {
            0 => (own, text), // as it is
            // about another problem of this size, with its hash
            1 => {
                let other = Problem { lcp: whole(&mut random, n), ..subject.clone() };
                let text = text.replace(&hash(&question(&subject)), &hash(&question(&other)));
                (other.to_json().to_string(), text)
            }
            2 | 3 => {
                let other = mutated(&own, 0, &mut random);
                let hash_of = |text: &str| {
                    let problem = Problem::parse(text, "problem.json").ok()?;
                    Some(hash(&Question::new(&problem, None, "problem.json").ok()?))
                };
                // With the hash of what it became, so that the rest of the proof is checked too.
                let text = match hash_of(&other) {
                    Some(hash_of_other) => text.replace(&hash(&question(&subject)), &hash_of_other),
                    None => text,
                };
                (other, text)
            }
            _ => {
                let begin = text.find("\"kind\"").unwrap_or(0);
                (own, mutated(&text, begin, &mut random))
            }
        });
    }
    let expected: Vec<&str> = pairs.iter().map(|(problem, proof)| own(problem, proof)).collect();
    let accepted = expected.iter().filter(|verdict| **verdict == "proved").count();
    assert!(accepted >= count / 10 && accepted < count / 2, "{accepted} of {count}");
    for (checker, verdicts) in others(&pairs) {
        for ((pair, expected), verdict) in pairs.iter().zip(&expected).zip(verdicts) {
            assert_eq!(verdict, *expected, "{checker}: {pair:?}");
        }
    }
}
