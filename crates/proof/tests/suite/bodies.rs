//! Solutions for the exact numbers of bodies with redundant contacts, of which closed forms are
//! known.

use lcplab_lcp::file::Problem;
use lcplab_lcp::friction::Model;
use lcplab_lcp::{Coupling, Gauss, Lcp, Matrix};
use lcplab_proof::{Claim, Kind, Near, Proof, check, hash, prove_kind};
use oorandom::Rand64;

use super::checkers::{Pair, others, own};
use super::mutants::mutated;
use super::{INF, problem, question};

const MU: f64 = 0.5;

/// A plate on its four corners (±a, ±b, 0), with its center of mass between them, pressed down and
/// pushed along the plane, without compliance. Its motion stays a translation, so that the forces
/// have a closed form: any shares 1 + s, 1 − s, 1 − s, 1 + s of the quarter of the load, and
/// friction opposite to the push, the whole push if it sticks. The tangents of each corner are
/// turned by another angle.
fn plate(model: Model, slides: bool, random: &mut Rand64) -> (Problem, Vec<f64>) {
    let mut between = |least: f64, most: f64| least + (most - least) * random.rand_float();
    let (mass, inertia) = (between(0.1, 10.0), [0; 3].map(|_| between(0.1, 2.0)));
    let (a, b, share) = (between(0.2, 1.0), between(0.2, 1.0), between(-0.9, 0.9));
    let (speed, direction) = (between(1.0, 5.0), between(0.0, 6.0));
    let push = MU * speed * if slides { between(1.1, 2.0) } else { between(0.0, 0.9) };
    let push = [push * direction.cos(), push * direction.sin()];
    let corners = [(a, b, 1.0), (-a, b, -1.0), (a, -b, -1.0), (-a, -b, 1.0)];
    let brake = f64::min(1.0, MU * speed / f64::hypot(push[0], push[1]));
    let (mut jacobian, mut x) = (Vec::new(), Vec::new());
    for (p, q, sign) in corners {
        let quarter = mass / 4.0 * (1.0 + sign * share);
        jacobian.push(vec![(2, 1.0), (3, q), (4, -p)]);
        x.push(quarter * speed);
        let angle = between(0.0, 6.0);
        for [c, s] in [[angle.cos(), angle.sin()], [-angle.sin(), angle.cos()]] {
            jacobian.push(vec![(0, c), (1, s), (5, p * s - q * c)]);
            x.push(-quarter * brake * (push[0] * c + push[1] * s));
        }
    }
    let weights: Vec<f64> = [mass; 3].into_iter().chain(inertia).collect();
    let target = vec![push[0], push[1], -speed, 0.0, 0.0, 0.0];
    (posed(model, weights, jacobian, target), x)
}

/// The problem of bodies with these diagonal masses, and contacts of three rows each.
fn posed(
    model: Model,
    weights: Vec<f64>,
    jacobian: Vec<Vec<(usize, f64)>>,
    target: Vec<f64>,
) -> Problem {
    let n = jacobian.len();
    let full = |row: &Vec<(usize, f64)>| {
        let mut full = vec![0.0; target.len()];
        row.iter().for_each(|&(j, value)| full[j] = value);
        full
    };
    let rows: Vec<Vec<f64>> = jacobian.iter().map(full).collect();
    let inverse: Vec<f64> = weights.iter().map(|weight| 1.0 / weight).collect();
    let product = |p: &[f64], q: &[f64], by: &[f64]| -> f64 {
        p.iter().zip(q).zip(by).map(|((p, q), by)| p * q * by).sum()
    };
    let a: Vec<f64> =
        rows.iter().flat_map(|p| rows.iter().map(|q| product(p, q, &inverse))).collect();
    let b = rows.iter().map(|p| product(p, &target, &vec![1.0; target.len()])).collect();
    let lo: Vec<f64> = (0..n).map(|i| if i % 3 == 0 { 0.0 } else { -INF }).collect();
    let lcp = Lcp::new(Matrix::dense(n, &a), b, lo.clone(), vec![INF; n]).unwrap();
    let index = (0..n).map(|i| (i % 3 != 0).then_some(i - i % 3)).collect();
    let coupling = Coupling::new(index, vec![MU; n]).unwrap();
    let motion = Gauss {
        mass: weights.iter().enumerate().map(|(i, &weight)| (i, i, weight)).collect(),
        jacobian,
        bias: vec![0.0; n],
        compliance: vec![0.0; n],
        target,
        lo,
        hi: vec![INF; n],
        level: None,
    };
    let subject = problem(&lcp.with_coupling(coupling).unwrap());
    Problem { model: Some(model), motion: Some(motion), ..subject }
}

/// A plate that sticks under one of the laws, or slides under Coulomb's.
fn any_plate(k: usize, random: &mut Rand64) -> (Problem, Vec<f64>) {
    let (model, slides) =
        [(Model::CoulombCone, true), (Model::CoulombCone, false), (Model::AssociatedCone, false)]
            [k % 3];
    plate(model, slides, random)
}

#[test]
fn the_closed_form_of_a_plate_on_redundant_corners_is_proved_and_every_checker_accepts_it() {
    let mut random = Rand64::new(591);
    let mut pairs: Vec<Pair> = Vec::new();
    for k in 0..60 {
        let (subject, x) = any_plate(k, &mut random);
        let asked = question(&subject);
        let proof = prove_kind(&asked, &x, Kind::BodySolution).proof.unwrap();
        let Claim::BodySolution { near: Some(Near { distance, .. }), .. } = &proof.claim else {
            panic!("{k}: {}", proof.sentence());
        };
        let size = x.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
        assert!(*distance < 1e-13 * size, "{k}: {distance}");
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
fn a_share_that_turns_the_plate_or_leaves_a_cone_is_not_near_a_solution() {
    let mut random = Rand64::new(592);
    for k in 0..60 {
        let (subject, mut x) = any_plate(k, &mut random);
        // A millionth more load on one corner: its moment would turn the plate.
        let size = x.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
        x[0] += 1e-6 * size;
        let proof = prove_kind(&question(&subject), &x, Kind::BodySolution).proof;
        let claim = proof.map(|proof| proof.claim);
        if let Some(Claim::BodySolution { near: Some(Near { distance, .. }), .. }) = claim {
            // The sum of the loads is off by that much, so at least a quarter in some entry.
            assert!(distance >= 0.25e-6 * size * (1.0 - 1e-9), "{k}: {distance}");
        }
    }
}

#[test]
fn a_box_is_no_proof_of_bodies_with_another_number() {
    let mut random = Rand64::new(593);
    for k in 0..30 {
        let (subject, x) = any_plate(k, &mut random);
        let proof = prove_kind(&question(&subject), &x, Kind::BodySolution).proof.unwrap();
        let motion = subject.motion.clone().unwrap();
        let rejects = |changed: Gauss| {
            let other = question(&Problem { motion: Some(changed), ..subject.clone() });
            check(&other, &Proof { problem: hash(&other), ..proof.clone() }).is_err()
        };
        // A corner in another place: the rows of J no longer depend on each other.
        let mut moved = motion.clone();
        moved.jacobian[0][1].1 = moved.jacobian[0][1].1.next_up();
        assert!(rejects(moved), "{k}");
        let mut faster = motion.clone();
        faster.target[2] *= 1.0 + 1e-6;
        assert!(rejects(faster), "{k}");
        let mut heavier = motion.clone();
        heavier.mass[2].2 *= 1.0 + 1e-6;
        assert!(rejects(heavier), "{k}");
        let mut soft = motion;
        soft.compliance[0] = 1e-6;
        assert!(rejects(soft), "{k}");
    }
}

#[test]
fn all_checkers_say_the_same_of_every_changed_box_of_bodies() {
    let mut random = Rand64::new(594);
    let mut pairs: Vec<Pair> = Vec::new();
    for k in 0..20 {
        let (subject, x) = any_plate(k, &mut random);
        let proof = prove_kind(&question(&subject), &x, Kind::BodySolution).proof.unwrap();
        let proof = proof.to_json().to_string();
        let begin = proof.find("\"kind\"").unwrap();
        for _ in 0..10 {
            let changed = mutated(&proof, begin, &mut random);
            pairs.push((subject.to_json().to_string(), changed));
        }
    }
    let expected: Vec<&str> = pairs.iter().map(|(problem, proof)| own(problem, proof)).collect();
    let accepted = expected.iter().filter(|verdict| **verdict == "proved").count();
    assert!(accepted > 10 && accepted < 190, "{accepted}");
    for (checker, verdicts) in others(&pairs) {
        for ((pair, expected), verdict) in pairs.iter().zip(&expected).zip(verdicts) {
            assert_eq!(verdict, *expected, "{checker}: {pair:?}");
        }
    }
}

/// A block on two contacts with the same normal, under the associated law: it slides and rises,
/// and the impulse has a closed form, N = (μ |u*_t| − u*_n) m / (1 + μ²) with friction μ N. One
/// answer for it, in any shares, and its motion.
fn rising_block(random: &mut Rand64) -> (Problem, Vec<f64>, f64) {
    let mut between = |least: f64, most: f64| least + (most - least) * random.rand_float();
    let (mass, fall, push) = (between(0.1, 10.0), between(0.5, 2.0), between(4.0, 8.0));
    let (direction, share) = (between(0.0, 6.0), between(0.1, 0.9));
    let [p, q] = [direction.cos(), direction.sin()];
    let normal = mass * (MU * push + fall) / (1.0 + MU * MU);
    let (mut jacobian, mut x) = (Vec::new(), Vec::new());
    for share in [share, 1.0 - share] {
        jacobian.push(vec![(2, 1.0)]);
        x.push(share * normal);
        let angle = between(0.0, 6.0);
        for [c, s] in [[angle.cos(), angle.sin()], [-angle.sin(), angle.cos()]] {
            jacobian.push(vec![(0, c), (1, s)]);
            x.push(-share * MU * normal * (p * c + q * s));
        }
    }
    let target = vec![push * p, push * q, -fall];
    (posed(Model::AssociatedCone, vec![mass; 3], jacobian, target), x, mass)
}

fn motion_bound(problem: &Problem, answer: &[f64]) -> (Proof, f64) {
    let proof = prove_kind(&question(problem), answer, Kind::Motion).proof.unwrap();
    let Claim::Motion(bounded) = &proof.claim else { panic!("{}", proof.sentence()) };
    let bound = bounded.bound;
    (proof, bound)
}

#[test]
fn the_motion_of_redundant_contacts_that_slide_under_the_associated_law_is_bounded() {
    let mut random = Rand64::new(595);
    let mut pairs: Vec<Pair> = Vec::new();
    for k in 0..40 {
        let (subject, mut x, mass) = rising_block(&mut random);
        let (_, bound) = motion_bound(&subject, &x);
        assert!(bound < 1e-5, "{k}: {bound}");
        // An impulse δ too much along the normal changes the motion by δ/m, by √m times that in
        // the norm.
        let error = [1e-6, 1e-3, 0.5][k % 3] * if k % 2 == 0 { 1.0 } else { -1.0 } * x[0];
        x[0] += error;
        let (proof, bound) = motion_bound(&subject, &x);
        let exact = error.abs() / mass.sqrt();
        assert!(bound >= exact * (1.0 - 1e-9), "{k}: {bound}, {exact}");
        let begin = proof.to_json().to_string().find("\"kind\"").unwrap();
        let text = proof.to_json().to_string();
        pairs.push((subject.to_json().to_string(), text.clone()));
        for _ in 0..5 {
            let changed = mutated(&text, begin, &mut random);
            pairs.push((subject.to_json().to_string(), changed));
        }
        let mut motion = subject.motion.clone().unwrap();
        motion.target[2] -= 4.0 * (bound + 1.0);
        let other = question(&Problem { motion: Some(motion), ..subject.clone() });
        let moved = Proof { problem: hash(&other), ..proof };
        assert!(check(&other, &moved).is_err(), "{k}");
    }
    let expected: Vec<&str> = pairs.iter().map(|(problem, proof)| own(problem, proof)).collect();
    assert!(expected.iter().step_by(6).all(|verdict| *verdict == "proved"));
    for (checker, verdicts) in others(&pairs) {
        for ((pair, expected), verdict) in pairs.iter().zip(&expected).zip(verdicts) {
            assert_eq!(verdict, *expected, "{checker}: {pair:?}");
        }
    }
}
