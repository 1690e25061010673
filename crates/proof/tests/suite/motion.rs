//! Bounds on the motion are true, and no wider than they need be.

use lcplab_problem::file::Problem;
use lcplab_problem::{Coupling, Gauss, Lcp, Matrix};
use lcplab_proof::{Claim, Found, Kind, Proof, check, prove, prove_kind};
use oorandom::Rand64;

use super::{INF, problem, whole, with_bodies};

/// A body of 2 kg that falls at 3 m/s on contacts that share its load: A = ½ in all entries.
fn falling(contacts: usize) -> Problem {
    let n = contacts;
    let a = Matrix::dense(n, &vec![0.5; n * n]);
    let lcp = Lcp::new(a, vec![-3.0; n], vec![0.0; n], vec![INF; n]).unwrap();
    let motion = Gauss {
        mass: vec![(0, 0, 2.0)],
        jacobian: vec![vec![(0, 1.0)]; n],
        bias: vec![0.0; n],
        compliance: vec![0.0; n],
        target: vec![-3.0],
        lo: vec![0.0; n],
        hi: vec![INF; n],
    };
    Problem { motion: Some(motion), ..problem(&lcp) }
}

fn bound(problem: &Problem, answer: &[f64], kind: Kind) -> Result<f64, String> {
    let Found { proof, missing } = prove_kind(problem, answer, kind);
    let proof = proof.ok_or_else(|| missing[0].1.clone())?;
    let text = proof.to_json().to_string();
    let read = Proof::parse(&text, "proof.json").unwrap();
    assert_eq!(check(problem, &read), Ok(()), "{text}");
    match read.claim {
        Claim::Motion(bounded) | Claim::FrozenMotion(bounded) => Ok(bounded.bound),
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_bound_is_what_the_missing_impulse_would_have_done() {
    // 6 N s stop it; half of one is missing: u(x) = −¼ m/s, |u(x) − 0|_M = √2 / 4.
    let missing = bound(&falling(2), &[4.0, 1.5], Kind::Motion).unwrap();
    assert!((missing - 2.0_f64.sqrt() / 4.0).abs() < 1e-12, "{missing}");
    // Whoever carries it: all splits stop it.
    for x in [[6.0, 0.0], [1.0, 5.0]] {
        assert!(bound(&falling(2), &x, Kind::Motion).unwrap() < 1e-20);
    }
}

#[test]
fn a_smaller_bound_another_motion_and_a_motion_through_the_floor_are_refused() {
    let subject = falling(2);
    let proof = prove_kind(&subject, &[4.0, 1.5], Kind::Motion).proof.unwrap();
    let text = proof.to_json().to_string();
    let Claim::Motion(own) = proof.claim else { panic!() };
    let smaller = text.replace(&own.bound.to_string(), &own.bound.next_down().to_string());
    let through = text.replace(r#""numerators":["0"]"#, r#""numerators":["-1"]"#);
    let longer = text.replace(r#""numerators":["0"]"#, r#""numerators":["0","0"]"#);
    for (changed, reason) in [(smaller, "larger"), (through, "breaks row 0"), (longer, "entries")] {
        assert_ne!(changed, text);
        let read = Proof::parse(&changed, "proof.json").unwrap();
        let refusal = check(&subject, &read).unwrap_err();
        assert!(refusal.contains(reason), "{refusal}");
    }
}

#[test]
fn the_hash_covers_the_bodies() {
    let subject = falling(1);
    let proof = prove_kind(&subject, &[6.0], Kind::Motion).proof.unwrap();
    let change = |change: fn(&mut Gauss)| {
        let mut other = subject.clone();
        change(other.motion.as_mut().unwrap());
        other
    };
    let others = [
        change(|data| data.mass[0].2 = 2.5),
        change(|data| data.jacobian[0][0].1 = -1.0),
        change(|data| data.bias[0] = 1.0),
        change(|data| data.compliance[0] = 1.0),
        change(|data| data.target[0] = -2.0),
        Problem { motion: None, ..subject.clone() },
    ];
    for other in others {
        assert_eq!(check(&other, &proof), Err("the proof is about another problem".into()));
    }
}

#[test]
fn equations_are_obeyed_exactly_or_it_is_said_that_none_can_be() {
    // A rod's end on two guides: 0.1 v = 0.3 and, three times, the same but for rounding.
    let guided = |rows: &[(f64, f64)]| {
        let n = rows.len();
        let a: Vec<f64> = rows.iter().flat_map(|p| rows.iter().map(|q| p.0 * q.0)).collect();
        let b = rows.iter().map(|row| row.1).collect();
        let lcp = Lcp::new(Matrix::dense(n, &a), b, vec![-INF; n], vec![INF; n]).unwrap();
        let motion = Gauss {
            mass: vec![(0, 0, 1.0)],
            jacobian: rows.iter().map(|row| vec![(0, row.0)]).collect(),
            bias: rows.iter().map(|row| row.1).collect(),
            compliance: vec![0.0; n],
            target: vec![0.0],
            lo: vec![-INF; n],
            hi: vec![INF; n],
        };
        Problem { motion: Some(motion), ..problem(&lcp) }
    };
    // v = 3 in exact numbers of both rows: x = 30 in the first.
    let doubled = guided(&[(0.1, -3.0 * 0.1), (0.2, -3.0 * 0.2)]);
    assert!(bound(&doubled, &[30.0, 0.0], Kind::Motion).unwrap() < 1e-13);
    let tripled = guided(&[(0.1, -0.3), (0.3, -0.9)]);
    let refusal = bound(&tripled, &[30.0, 0.0], Kind::Motion).unwrap_err();
    assert!(refusal.contains("contradict"), "{refusal}");
}

#[test]
fn no_two_motions_that_are_proved_contradict_each_other() {
    // If û exists, |u(x) − u(y)|_M is at most the sum of both bounds, whatever x and y are.
    let mut random = Rand64::new(5);
    let mut compared = 0;
    for k in 0..2000 {
        let subject = with_bodies(&whole(&mut random, 1 + k % 4), &mut random);
        let data = subject.motion.as_ref().unwrap();
        let mut bounded = || {
            let n = subject.lcp.len();
            let answer: Vec<f64> = (0..n).map(|_| random.rand_float() * 4.0 - 1.0).collect();
            match prove_kind(&subject, &answer, Kind::Motion).proof?.claim {
                Claim::Motion(bounded) => Some(bounded),
                other => panic!("{other:?}"),
            }
        };
        let (Some(p), Some(q)) = (bounded(), bounded()) else { continue };
        // |M⁻¹Jᵀ(x − y)|_M with a mass matrix of two rows
        let mut f = [0.0; 2];
        for (i, row) in data.jacobian.iter().enumerate() {
            row.iter().for_each(|&(j, v)| f[j] += v * (p.answer[i] - q.answer[i]));
        }
        let [a, b, c] = [data.mass[0].2, data.mass[1].2, data.mass[2].2];
        let square = (c * f[0] * f[0] - 2.0 * b * f[0] * f[1] + a * f[1] * f[1]) / (a * c - b * b);
        assert!(square.max(0.0).sqrt() <= p.bound + q.bound + 1e-9, "{subject:?}");
        compared += 1;
    }
    assert!(compared > 200, "{compared}");
}

#[test]
fn friction_is_frozen_at_the_answer_and_is_proved_only_where_it_is_asked_for() {
    // 1 kg pressed with 2 and pushed with 3 N s, μ = ½: x = (2, 1) leaves 2 m/s, and that is exact.
    let a = Matrix::dense(2, &[1.0, 0.0, 0.0, 1.0]);
    let lcp = Lcp::new(a, vec![-2.0, -3.0], vec![0.0, -INF], vec![INF; 2]).unwrap();
    let coupling = Coupling::new(vec![None, Some(0)], vec![0.0, 0.5]).unwrap();
    let lcp = lcp.with_coupling(coupling).unwrap();
    let motion = Gauss {
        mass: vec![(0, 0, 1.0), (1, 1, 1.0)],
        jacobian: vec![vec![(0, 1.0)], vec![(1, 1.0)]],
        bias: vec![0.0; 2],
        compliance: vec![0.0; 2],
        target: vec![-2.0, -3.0],
        lo: lcp.lo().to_vec(),
        hi: lcp.hi().to_vec(),
    };
    let subject = Problem { motion: Some(motion), ..problem(&lcp) };
    assert_eq!(bound(&subject, &[2.0, 1.0], Kind::FrozenMotion), Ok(0.0));
    assert!(bound(&subject, &[2.0, 1.0], Kind::Motion).is_err());
    assert_eq!(prove(&subject, &[2.0, 1.0]).proof.unwrap().claim.kind(), Kind::Solution);
}
