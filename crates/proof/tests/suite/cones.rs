//! Boxes around the solutions of problems with friction cones, of which closed forms are known.

use lcplab_lcp::file::Problem;
use lcplab_lcp::friction::Model;
use lcplab_lcp::{Coupling, Lcp, Matrix};
use lcplab_proof::{Claim, Kind, Proof, check, prove, prove_kind};
use oorandom::Rand64;

use super::checkers::{Pair, others, own};
use super::mutants::mutated;
use super::{INF, problem, question};

const LAWS: [Model; 2] = [Model::CoulombCone, Model::AssociatedCone];

/// Contacts in a chain, with a unit block of A each; a contact changes the b of the next one. The
/// solution follows contact by contact: x_n = −b_n under Coulomb's law, (μ |b_t| − b_n) / (1 + μ²)
/// under the associated one, and friction opposite to the push.
fn chain(model: Model, contacts: usize, random: &mut Rand64) -> (Problem, Vec<f64>) {
    let n = 3 * contacts;
    let mut number = |most: i64| {
        let size = random.rand_range(1..(most + 1) as u64) as f64;
        if random.rand_range(0..2) == 0 { -size } else { size }
    };
    let (mut a, mut b, mut x) = (vec![0.0; n * n], Vec::new(), Vec::new());
    for c in 0..contacts {
        let mut own = [-8.0 - number(4), 6.0 * number(3), 7.0 * number(3)];
        b.extend(own);
        for i in 0..3 {
            a[(3 * c + i) * (n + 1)] = 1.0;
            for j in 0..3 * usize::from(c > 0) {
                let value = number(4) / 64.0;
                a[(3 * c + i) * n + 3 * c - 3 + j] = value;
                own[i] += value * x[3 * c - 3 + j];
            }
        }
        let push = f64::hypot(own[1], own[2]);
        let normal = match model {
            Model::CoulombCone => -own[0],
            _ => (0.5 * push - own[0]) / 1.25,
        };
        x.extend([normal, -0.5 * normal * own[1] / push, -0.5 * normal * own[2] / push]);
        if push <= 0.5 * -own[0] {
            x.truncate(3 * c);
            x.extend([-own[0], -own[1], -own[2]]);
        }
    }
    let lo = (0..n).map(|i| if i % 3 == 0 { 0.0 } else { -INF }).collect();
    let lcp = Lcp::new(Matrix::dense(n, &a), b, lo, vec![INF; n]).unwrap();
    let index = (0..n).map(|i| (i % 3 != 0).then_some(i - i % 3)).collect();
    let coupling = Coupling::new(index, vec![0.5; n]).unwrap();
    let subject = problem(&lcp.with_coupling(coupling).unwrap());
    (Problem { model: Some(model), ..subject }, x)
}

#[test]
fn a_box_around_the_closed_form_is_proved_and_every_checker_accepts_it() {
    let mut random = Rand64::new(59);
    let mut pairs: Vec<Pair> = Vec::new();
    for k in 0..60 {
        let (subject, x) = chain(LAWS[k % 2], 1 + k % 4, &mut random);
        let asked = question(&subject);
        let proof = prove(&asked, &x).proof.unwrap();
        let near = match &proof.claim {
            Claim::ConeSolution { near, .. } | Claim::Solution { near, .. } => {
                near.clone().unwrap()
            }
            claim => panic!("{claim:?}"),
        };
        assert!(near.distance < 1e-13, "{}", near.distance);
        let text = proof.to_json().to_string();
        let read = Proof::parse(&text, "proof.json").unwrap();
        assert_eq!((&read, check(&asked, &read)), (&proof, Ok(())), "{text}");
        pairs.push((subject.to_json().to_string(), text));
    }
    for (checker, verdicts) in others(&pairs) {
        for (pair, verdict) in pairs.iter().zip(verdicts) {
            assert_eq!(verdict, "proved", "{checker}: {pair:?}");
        }
    }
}

#[test]
fn a_box_is_no_proof_of_another_problem_law_or_state() {
    let mut random = Rand64::new(60);
    for k in 0..40 {
        let (subject, x) = chain(LAWS[k % 2], 1 + k % 3, &mut random);
        let Some(proof) = prove_kind(&question(&subject), &x, Kind::ConeSolution).proof else {
            continue;
        };
        // The other law, with its name and hash on the proof.
        let model = Some(LAWS[(k + 1) % 2]);
        let other = question(&Problem { model, ..subject.clone() });
        let problem = lcplab_proof::hash(&other);
        let renamed = Proof { problem, model, ..proof.clone() };
        assert!(check(&other, &renamed).is_err(), "{k}");
        // A push that is larger by a millionth.
        let mut b = subject.lcp.b().to_vec();
        b[1] *= 1.0 + 1e-6;
        let (lo, hi) = (subject.lcp.lo().to_vec(), subject.lcp.hi().to_vec());
        let lcp = Lcp::new(subject.lcp.matrix().clone(), b, lo, hi).unwrap();
        let lcp = lcp.with_coupling(subject.lcp.coupling().unwrap().clone()).unwrap();
        let changed = question(&Problem { lcp, ..subject.clone() });
        let rehashed = Proof { problem: lcplab_proof::hash(&changed), ..proof.clone() };
        assert!(check(&changed, &rehashed).is_err(), "{k}");
    }
}

#[test]
fn all_checkers_say_the_same_of_every_changed_box() {
    let mut random = Rand64::new(61);
    let mut pairs: Vec<Pair> = Vec::new();
    for k in 0..200 {
        let (subject, x) = chain(LAWS[k % 2], 1 + k % 2, &mut random);
        let proof = prove(&question(&subject), &x).proof.unwrap().to_json().to_string();
        let begin = proof.find("\"kind\"").unwrap();
        pairs.push((subject.to_json().to_string(), mutated(&proof, begin, &mut random)));
    }
    let expected: Vec<&str> = pairs.iter().map(|(problem, proof)| own(problem, proof)).collect();
    let accepted = expected.iter().filter(|verdict| **verdict == "proved").count();
    assert!(accepted > 20 && accepted < 180, "{accepted}");
    for (checker, verdicts) in others(&pairs) {
        for ((pair, expected), verdict) in pairs.iter().zip(&expected).zip(verdicts) {
            assert_eq!(verdict, *expected, "{checker}: {pair:?}");
        }
    }
}
