//! Bounds on the motion are true, and no wider than they need be.

use dashu_ratio::RBig;
use lcplab_lcp::file::Problem;
use lcplab_lcp::{Coupling, Gauss, Lcp, Matrix};
use lcplab_proof::{Claim, Kind, Proof, ProofSearch, check, prove, prove_kind};
use oorandom::Rand64;

use super::{INF, problem, question, whole, with_bodies};

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
        level: None,
    };
    Problem { motion: Some(motion), ..problem(&lcp) }
}

fn bound(problem: &Problem, answer: &[f64], kind: Kind) -> Result<f64, String> {
    let ProofSearch { proof, missing } = prove_kind(&question(problem), answer, kind);
    let proof = proof.ok_or_else(|| missing[0].1.clone())?;
    let text = proof.to_json().to_string();
    let read = Proof::parse(&text, "proof.json").unwrap();
    assert_eq!(check(&question(problem), &read), Ok(()), "{text}");
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

/// A unit mass at 5 m/s, on which a row can act with −1 to 1 N s: x = −1 leaves 4 m/s.
fn braked() -> Problem {
    let lcp = Lcp::new(Matrix::dense(1, &[1.0]), vec![5.0], vec![-1.0], vec![1.0]).unwrap();
    let motion = Gauss {
        mass: vec![(0, 0, 1.0)],
        jacobian: vec![vec![(0, 1.0)]],
        bias: vec![0.0],
        compliance: vec![0.0],
        target: vec![5.0],
        lo: vec![-1.0],
        hi: vec![1.0],
        level: None,
    };
    Problem { motion: Some(motion), ..problem(&lcp) }
}

#[test]
fn an_answer_beyond_its_bounds_is_bounded_itself_and_not_what_is_left_within_them() {
    // −20 N s would leave −15 m/s, 19 from the exact 4.
    assert_eq!(bound(&braked(), &[-20.0], Kind::Motion), Ok(19.0));
    assert_eq!(bound(&braked(), &[-1.0], Kind::Motion), Ok(0.0));
    // 3 N s leave 8 m/s, 4 from it. The nearest within bounds, 1, is wrong too: the best v shows
    // √20 for it, its own 6 m/s √24.
    let above = bound(&braked(), &[3.0], Kind::Motion).unwrap();
    assert!((2.0 + 20_f64.sqrt()..2.001 + 24_f64.sqrt()).contains(&above), "{above}");
    let proof = prove_kind(&question(&braked()), &[-20.0], Kind::Motion).proof.unwrap();
    let text = proof.to_json().to_string();
    for changed in ["0.0", "18.999999999999996"] {
        let changed = text.replace("\"bound\":19.0", &format!("\"bound\":{changed}"));
        assert_ne!(changed, text);
        let read = Proof::parse(&changed, "proof.json").unwrap();
        assert!(check(&question(&braked()), &read).unwrap_err().contains("larger bound"));
    }
}

/// A problem with the motion û and the x̂ that it is made for, in whole and binary numbers, so that
/// both are exact.
fn known(random: &mut Rand64, n: usize) -> (Problem, [RBig; 2]) {
    let mut number = |most: i64| (random.rand_range(0..(2 * most + 1) as u64) as i64 - most) as f64;
    let mass = [2_f64.powi(number(2) as i32), 2_f64.powi(number(2) as i32)];
    let motion = [number(8), number(8)];
    let mut data = Gauss {
        mass: vec![(0, 0, mass[0]), (1, 1, mass[1])],
        target: motion.to_vec(),
        ..Gauss::default()
    };
    for _ in 0..n {
        let (row, compliance) = ([number(3), number(3)], number(1).max(0.0) / 4.0);
        let (lo, hi) = [(0.0, INF), (-2.0, 3.0), (-INF, INF)][(number(1) + 1.0) as usize];
        // x̂ at a bound with the w that is allowed there, or between them with w = 0.
        let (x, w) = match (number(1), lo, hi) {
            (-1.0, lo, _) if lo.is_finite() => (lo, number(2).abs()),
            (1.0, _, hi) if hi.is_finite() => (hi, -number(2).abs()),
            _ => (1.0 + number(1) / 2.0, 0.0),
        };
        (0..2).for_each(|j| data.target[j] -= row[j] * x / mass[j]);
        data.bias.push(w - row[0] * motion[0] - row[1] * motion[1] - compliance * x);
        data.jacobian.push(row.into_iter().enumerate().collect());
        data.compliance.push(compliance);
        data.lo.push(lo);
        data.hi.push(hi);
    }
    let a: Vec<f64> = vec![0.0; n * n]; // nothing is claimed of A and b
    let lcp = Lcp::new(Matrix::dense(n, &a), vec![0.0; n], data.lo.clone(), data.hi.clone());
    let subject = Problem { motion: Some(data), ..problem(&lcp.unwrap()) };
    (subject, motion.map(|v| RBig::try_from(v).unwrap()))
}

#[test]
fn no_answer_moves_the_bodies_farther_from_the_exact_motion_than_its_bound() {
    let mut random = Rand64::new(47);
    let exact = |value: f64| RBig::try_from(value).unwrap();
    let (mut bounded, mut beyond) = (0, 0);
    for k in 0..1000 {
        let (subject, motion) = known(&mut random, 1 + k % 4);
        let data = subject.motion.as_ref().unwrap();
        let x: Vec<f64> =
            (data.bias.iter()).map(|_| random.rand_range(0..81) as f64 / 4.0 - 10.0).collect();
        let Ok(bound) = bound(&subject, &x, Kind::Motion) else { continue };
        // |u* + M⁻¹Jᵀx − û|²_M
        let mut square = exact(0.0);
        for j in 0..2 {
            let mass = exact(data.mass[j].2);
            let impulses = data.jacobian.iter().zip(&x).map(|(row, &x)| exact(row[j].1) * exact(x));
            let impulse = impulses.fold(exact(0.0), |sum, own| sum + own);
            let off = exact(data.target[j]) + impulse / &mass - &motion[j];
            square += &off * &off * mass;
        }
        assert!(square <= exact(bound) * exact(bound), "{bound} for {x:?} of {subject:?}");
        bounded += 1;
        beyond += usize::from((0..x.len()).any(|i| x[i] < data.lo[i] || x[i] > data.hi[i]));
    }
    assert!(bounded > 500 && beyond > 300, "{bounded} {beyond}");
}

#[test]
fn a_smaller_bound_another_motion_and_a_motion_through_the_floor_are_refused() {
    let subject = falling(2);
    let proof = prove_kind(&question(&subject), &[4.0, 1.5], Kind::Motion).proof.unwrap();
    let text = proof.to_json().to_string();
    let Claim::Motion(own) = proof.claim else { panic!() };
    let smaller = text.replace(&own.bound.to_string(), &own.bound.next_down().to_string());
    let through = text.replace(r#""numerators":["0"]"#, r#""numerators":["-1"]"#);
    let longer = text.replace(r#""numerators":["0"]"#, r#""numerators":["0","0"]"#);
    for (changed, reason) in [(smaller, "larger"), (through, "breaks row 0"), (longer, "entries")] {
        assert_ne!(changed, text);
        let read = Proof::parse(&changed, "proof.json").unwrap();
        let refusal = check(&question(&subject), &read).unwrap_err();
        assert!(refusal.contains(reason), "{refusal}");
    }
}

#[test]
fn the_hash_covers_the_bodies() {
    let subject = falling(1);
    let proof = prove_kind(&question(&subject), &[6.0], Kind::Motion).proof.unwrap();
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
        assert_eq!(
            check(&question(&other), &proof),
            Err("the proof is about another problem".into())
        );
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
            level: None,
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
            match prove_kind(&question(&subject), &answer, Kind::Motion).proof?.claim {
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
        level: None,
    };
    let subject = Problem { motion: Some(motion), ..problem(&lcp) };
    assert_eq!(bound(&subject, &[2.0, 1.0], Kind::FrozenMotion), Ok(0.0));
    // Four times the friction that is left to it: 3 N s more, by which 1 kg is 3 m/s off.
    assert_eq!(bound(&subject, &[2.0, 4.0], Kind::FrozenMotion), Ok(3.0));
    assert!(bound(&subject, &[2.0, 1.0], Kind::Motion).is_err());
    assert_eq!(prove(&question(&subject), &[2.0, 1.0]).proof.unwrap().claim.kind(), Kind::Solution);
}
