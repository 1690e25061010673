//! What is proved of a problem under a friction model, and what is not.

use lcplab_lcp::file::Problem;
use lcplab_lcp::friction::Model;
use lcplab_lcp::{Coupling, Gauss, Lcp, Matrix, Question};
use lcplab_proof::{
    Claim, Kind, Proof, Tree, canonical_bytes, check, hash, prove, prove_different, prove_kind,
};
use oorandom::Rand64;

use super::{INF, problem, question};

/// The models that are no boxes.
const OTHERS: [Model; 5] = [
    Model::Polyhedral { directions: 4 },
    Model::Polyhedral { directions: 8 },
    Model::Polyhedral { directions: 16 },
    Model::AssociatedCone,
    Model::CoulombCone,
];

/// Contacts of three rows each.
fn contacts(a: &[f64], b: &[f64], mu: f64) -> Problem {
    let n = b.len();
    let is_normal = |i: usize| i.is_multiple_of(3);
    let lo = (0..n).map(|i| if is_normal(i) { 0.0 } else { -INF }).collect();
    let lcp = Lcp::new(Matrix::dense(n, a), b.to_vec(), lo, vec![INF; n]).unwrap();
    let index = (0..n).map(|i| (!is_normal(i)).then_some(i - i % 3)).collect();
    problem(&lcp.with_coupling(Coupling::new(index, vec![mu; n]).unwrap()).unwrap())
}

fn under(model: Model, problem: &Problem) -> Question {
    Question::new(problem, Some(model), "contacts").unwrap()
}

/// A pushed ball, of which every model has a solution: one of the cone, (2, √½, √½), is none of the
/// box, (2, 1, 1).
fn pushed() -> Problem {
    contacts(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0], &[-2.0, -3.0, -3.0], 0.5)
}

/// A ball on the same contact twice; all that counts are the sums of the shares.
#[test]
fn shares_of_a_load_under_a_cone_are_not_unique() {
    let a: Vec<f64> = (0..36).map(|k| f64::from(k / 6 % 3 == k % 6 % 3)).collect();
    let twice = contacts(&a, &[-2.0, -0.5, 0.0, -2.0, -0.5, 0.0], 0.5);
    for model in [Model::AssociatedCone, Model::CoulombCone] {
        let asked = under(model, &twice);
        let x = [1.0, 0.25, 0.0, 1.0, 0.25, 0.0];
        let proof = prove(&asked, &x).proof.unwrap();
        let Claim::NotUnique { .. } = proof.claim else { panic!("{model}: {:?}", proof.claim) };
        assert_eq!(check(&asked, &proof), Ok(()));
        let other = [1.5, 0.5, 0.0, 0.5, 0.0, 0.0];
        let proof = prove_different(&asked, &x, &other).proof.unwrap();
        assert_eq!(check(&asked, &proof), Ok(()));
        let wrong = [1.75, 0.25, 0.0, 0.25, 0.25, 0.0]; // more friction than the second one allows
        assert!(prove_different(&asked, &x, &wrong).proof.is_none());
    }
}

#[test]
fn the_boxs_answer_is_never_proved_of_another_model() {
    let boxed = prove(&question(&pushed()), &[2.0, 1.0, 1.0]).proof.unwrap();
    assert_eq!((boxed.claim.kind(), boxed.model), (Kind::Solution, Some(Model::CoupledBox)));
    for model in OTHERS {
        let asked = under(model, &pushed());
        let is_cone = [Model::AssociatedCone, Model::CoulombCone].contains(&model);
        for kind in Kind::ALL {
            let found = prove_kind(&asked, &[2.0, 1.0, 1.0], kind);
            if is_cone && kind == Kind::ConeSolution {
                // There is a solution, but not at the box's answer.
                let claim = found.proof.unwrap().claim;
                let Claim::ConeSolution { near: Some(near), .. } = claim else {
                    panic!("{claim:?}")
                };
                assert!(near.distance > 0.29, "{near:?}");
                continue;
            }
            assert_eq!(found.proof, None, "{model}, {kind}");
            let reason = &found.missing[0].1;
            match kind {
                Kind::NoSolution => {}
                Kind::ConeSolution | Kind::BodySolution if !is_cone => {
                    assert!(reason.contains("about friction cones"), "{reason}")
                }
                Kind::BodySolution => assert!(reason.contains("no key motion"), "{reason}"),
                Kind::Motion if model == Model::AssociatedCone => {
                    assert!(reason.contains("no key motion"), "{reason}")
                }
                Kind::Motion if is_cone => assert!(reason.contains("unique"), "{reason}"),
                Kind::Solution if is_cone => assert!(reason.contains("no rational"), "{reason}"),
                Kind::NotUnique if is_cone => {
                    assert!(reason.contains("not rational"), "{reason}")
                }
                _ => assert!(
                    reason.contains(&model.to_string()) && reason.contains("boxes"),
                    "{reason}"
                ),
            }
        }
        // Not even with the other model's name and hash on it.
        for (model, problem) in [
            (boxed.model, boxed.problem.clone()),
            (Some(model), boxed.problem.clone()),
            (boxed.model, hash(&asked)),
            (Some(model), hash(&asked)),
        ] {
            assert!(check(&asked, &Proof { problem, model, ..boxed.clone() }).is_err());
        }
    }
}

#[test]
fn a_vector_of_normal_rows_shows_under_every_model_that_no_solution_exists() {
    // w_n = −1 − x_n, whatever friction does.
    let subject = contacts(&[-1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0], &[-1.0, 0.0, 0.0], 0.5);
    for model in OTHERS.into_iter().chain([Model::CoupledBox]) {
        let asked = under(model, &subject);
        let proof = prove(&asked, &[0.0; 3]).proof.unwrap();
        assert!(matches!(proof.claim, Claim::NoSolution { tree: Tree::Leaf(_) }), "{proof:?}");
        let text = proof.to_json().to_string();
        let read = Proof::parse(&text, "proof.json").unwrap();
        assert_eq!((&read, check(&asked, &read)), (&proof, Ok(())), "{text}");
        let sentence = proof.sentence();
        assert!(sentence.ends_with(&format!("under the friction model {model}")), "{sentence}");
    }
}

#[test]
fn of_a_problem_that_was_made_from_its_solution_it_is_never_proved_that_it_has_none() {
    // μ = 1, and x_n = 5 of each contact: of the cones x_t = (3, 4) slides along (−3, −4), of
    // polygons x_t = (3, 2) along (−1, −1); or x_t sticks within.
    let mut random = Rand64::new(47);
    let mut disproved = 0;
    for round in 0..400 {
        let n = 3 * (1 + round % 2);
        let mut number =
            |most: i64| (random.rand_range(0..(2 * most + 1) as u64) as i64 - most) as f64;
        let a: Vec<f64> = (0..n * n).map(|_| number(3)).collect();
        for model in [OTHERS[0], Model::AssociatedCone, Model::CoulombCone] {
            let (mut x, mut w) = (Vec::new(), Vec::new());
            for _ in 0..n / 3 {
                let slip = number(1).abs();
                let lift = if model == Model::AssociatedCone { 5.0 * slip } else { 0.0 };
                match (number(1), model) {
                    (1.0, _) => (x.extend([0.0; 3]), w.extend([8.0, 0.0, 0.0])),
                    (_, Model::Polyhedral { .. }) => {
                        (x.extend([5.0, 3.0, 2.0]), w.extend([0.0, -slip, -slip]))
                    }
                    _ => (x.extend([5.0, 3.0, 4.0]), w.extend([lift, -3.0 * slip, -4.0 * slip])),
                };
            }
            let product = |i: usize| (0..n).map(|j| a[i * n + j] * x[j]).sum::<f64>();
            let b: Vec<f64> = (0..n).map(|i| w[i] - product(i)).collect();
            let subject = contacts(&a, &b, 1.0);
            let found = prove(&under(model, &subject), &vec![0.0; n]);
            let kind = found.proof.map(|proof| proof.claim.kind());
            assert!(kind != Some(Kind::NoSolution), "{model} {subject:?}");
            let boxed = prove(&question(&subject), &vec![0.0; n]).proof.unwrap();
            disproved += usize::from(boxed.claim.kind() == Kind::NoSolution);
        }
    }
    assert!(disproved > 0); // where the box has no solution, and this one has
}

#[test]
fn a_polygon_with_a_solution_is_not_refuted_by_the_box_that_has_none() {
    // x = (5, 3, 2) slides: 3 + 2 = μ 5, w = (0, −½, −½). Of the box five cases show that there is
    // no solution.
    let a = [18.0, -18.0, -12.0, -18.0, 18.0, 12.0, -12.0, 12.0, 10.0];
    let subject = contacts(&a, &[-12.0, 11.5, 3.5], 1.0);
    let boxed = prove(&question(&subject), &[5.0, 3.0, 2.0]).proof.unwrap();
    assert_eq!(boxed.claim.kind(), Kind::NoSolution);
    let asked = under(Model::Polyhedral { directions: 4 }, &subject);
    assert_eq!(prove(&asked, &[5.0, 3.0, 2.0]).proof, None);
    let renamed =
        Proof { problem: hash(&asked), model: Some(Model::Polyhedral { directions: 4 }), ..boxed };
    assert!(check(&asked, &renamed).unwrap_err().contains("cases"));
}

#[test]
fn a_frozen_box_is_proved_as_the_box_that_it_is() {
    // |x_t| ≤ ½ · 1: both tangents at their bound, while x_n = 2.
    let subject = Problem { frozen_at: Some(vec![1.0, 0.0, 0.0]), ..pushed() };
    let asked = under(Model::FrozenBox, &subject);
    let proof = prove(&asked, &[2.0, 0.5, 0.5]).proof.unwrap();
    assert_eq!((proof.claim.kind(), proof.model), (Kind::Unique, Some(Model::FrozenBox)));
    let text = proof.to_json().to_string();
    assert_eq!(check(&asked, &Proof::parse(&text, "proof.json").unwrap()), Ok(()), "{text}");
    assert!(check(&question(&pushed()), &proof).is_err());
}

#[test]
fn the_hash_covers_the_model_and_what_it_is_frozen_at() {
    let frozen = |x_n: f64| Problem { frozen_at: Some(vec![x_n, 7.0, 7.0]), ..pushed() };
    let mut hashes: Vec<String> =
        OTHERS.into_iter().map(|model| hash(&under(model, &pushed()))).collect();
    hashes.extend([1.0, 2.0].map(|x_n| hash(&under(Model::FrozenBox, &frozen(x_n)))));
    hashes.push(hash(&question(&pushed())));
    hashes.sort();
    hashes.dedup();
    assert_eq!(hashes.len(), OTHERS.len() + 3);
    // The coupled box is what a problem without a model is.
    assert_eq!(hash(&under(Model::CoupledBox, &frozen(1.0))), hash(&question(&pushed())));
    let [plain, cone] = [Model::CoupledBox, Model::CoulombCone]
        .map(|model| canonical_bytes(&under(model, &pushed())));
    assert_eq!(cone, [&plain[..], &[0, 0, 0, 12], b"coulomb-cone"].concat());
}

/// Friction of 5e-324 beside a normal force of 5e-324 and μ = ¾: no smaller friction but 0.
#[test]
fn the_smallest_friction_outside_its_cone_becomes_zero() {
    let target = vec![-2.0, -3.0, -3.0];
    let unit: Vec<(usize, usize, f64)> = (0..3).map(|i| (i, i, 1.0)).collect();
    let motion = Gauss {
        jacobian: (0..3).map(|i| vec![(i, 1.0)]).collect(),
        mass: unit,
        bias: vec![0.0; 3],
        compliance: vec![0.0; 3],
        target: target.clone(),
        lo: vec![0.0, -INF, -INF],
        hi: vec![INF; 3],
        level: None,
    };
    let ball = contacts(&[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0], &target, 0.75);
    let asked = under(Model::AssociatedCone, &Problem { motion: Some(motion), ..ball });
    let proof = prove_kind(&asked, &[5e-324, 5e-324, 0.0], Kind::Motion).proof.unwrap();
    assert_eq!(check(&asked, &proof), Ok(()));
}
