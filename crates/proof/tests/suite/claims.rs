//! What is claimed is so.

use lcplab_lcp::exact::all_solutions;
use lcplab_lcp::{Coupling, Lcp, Matrix};
use lcplab_proof::{Claim, Kind, Proof, canonical_bytes, check, hash, prove};
use oorandom::Rand64;

use super::{INF, asked, contacts, painleve, whole};

fn kind(lcp: &Lcp, answer: &[f64]) -> (Kind, Proof) {
    let proof = prove(&asked(lcp), answer).proof.expect("a proof");
    let text = proof.to_json().to_string();
    let read = Proof::parse(&text, "proof.json").unwrap();
    assert_eq!(read, proof, "{text}");
    assert_eq!(check(&asked(lcp), &read), Ok(()), "{text}");
    (proof.claim.kind(), proof)
}

#[test]
fn closed_forms_have_the_strongest_claim_that_is_true_of_them() {
    let definite = contacts(&[2.0, -1.0, -1.0, 2.0], &[-1.0, 2.0]);
    assert_eq!(kind(&definite, &[0.5, 0.0]).0, Kind::Unique);
    // A P-matrix that is not definite: x = (1, 0).
    let p = contacts(&[1.0, -3.0, 0.0, 1.0], &[-1.0, 1.0]);
    assert_eq!(kind(&p, &[1.0, 0.0]).0, Kind::Unique);
    // All of the segment x_0 + x_1 = 1.
    let segment = contacts(&[1.0; 4], &[-1.0; 2]);
    assert_eq!(kind(&segment, &[0.25, 0.75]).0, Kind::NotUnique);
    // w = 0 for every x ≥ 0: a ray with the single corner 0.
    assert_eq!(kind(&contacts(&[0.0], &[0.0]), &[0.0]).0, Kind::NotUnique);
    assert_eq!(kind(&contacts(&[1.0, -1.0, -1.0, 1.0], &[-1.0; 2]), &[0.0; 2]).0, Kind::NoSolution);
    assert_eq!(kind(&painleve(), &[1.0, 0.0]).0, Kind::NoSolution);
    // Pressed with 2, pushed with 3, μ = ½: friction is 1; nothing says that there is no other.
    let a = Matrix::dense(2, &[1.0, 0.0, 0.0, 1.0]);
    let rough = Lcp::new(a, vec![-2.0, -3.0], vec![0.0, -INF], vec![INF; 2]).unwrap();
    let coupling = Coupling::new(vec![None, Some(0)], vec![0.0, 0.5]).unwrap();
    assert_eq!(kind(&rough.with_coupling(coupling).unwrap(), &[2.0, 1.0]).0, Kind::Solution);
}

#[test]
fn a_solution_is_claimed_exactly_where_some_piece_has_one() {
    let mut random = Rand64::new(22);
    let mut seen = [0; 4];
    for round in 0..600 {
        let lcp = whole(&mut random, 1 + round % 4);
        let all = all_solutions(&lcp).unwrap();
        let (kind, _) = kind(&lcp, &vec![0.0; lcp.len()]);
        match kind {
            Kind::NoSolution => assert!(all.is_empty(), "{lcp:?}"),
            Kind::Unique => assert_eq!(all.len(), 1, "{lcp:?}"),
            Kind::NotUnique => assert!(!all.is_empty(), "{lcp:?}"),
            Kind::Solution => assert!(!all.is_empty(), "{lcp:?}"),
            other => panic!("{other}: {lcp:?}"),
        }
        let place = [Kind::NoSolution, Kind::Unique, Kind::NotUnique, Kind::Solution];
        seen[place.iter().position(|own| *own == kind).unwrap()] += 1;
    }
    assert!(seen.iter().all(|&count| count > 20), "{seen:?}");
}

#[test]
fn redundant_contacts_that_rounding_makes_regular_have_an_exact_solution() {
    // Nine legs of a table under friction, with entries that are no short binary fractions: of rank
    // 6 but for rounding.
    let places = [0.3, -0.1, -0.3];
    let legs: Vec<[f64; 2]> = places.iter().flat_map(|&x| places.map(|y| [x, 2.3 * y])).collect();
    let rows_of_legs = 3 * legs.len();
    let rows: Vec<[f64; 6]> = legs
        .iter()
        .flat_map(|[x, y]| {
            let h = -0.35;
            [
                [0.0, 0.0, 1.0, *y, -x, 0.0],
                [1.0, 0.0, 0.0, 0.0, h, -y],
                [0.0, 1.0, 0.0, -h, 0.0, *x],
            ]
        })
        .collect();
    let inverse = [0.1, 0.1, 0.1, 1.3, 1.7, 0.9];
    let entry = |p: &[f64; 6], q: &[f64; 6]| (0..6).map(|k| p[k] * inverse[k] * q[k]).sum::<f64>();
    let a: Vec<f64> = rows.iter().flat_map(|p| rows.iter().map(move |q| entry(p, q))).collect();
    let b: Vec<f64> = rows.iter().map(|row| -0.0981 * row[2] + 0.02 * row[0]).collect();
    // The same with an equation before them, 2 x = 1, which touches nothing.
    for equations in [0, 1] {
        let n = rows_of_legs + equations;
        let leg = |i: usize| i.checked_sub(equations);
        let is_normal = |i: usize| leg(i).is_some_and(|leg| leg % 3 == 0);
        let entry = |i: usize, j: usize| match (leg(i), leg(j)) {
            (Some(p), Some(q)) => a[p * rows_of_legs + q],
            (None, None) => 2.0,
            _ => 0.0,
        };
        let whole: Vec<f64> = (0..n * n).map(|k| entry(k / n, k % n)).collect();
        let offset = (0..n).map(|i| leg(i).map_or(-1.0, |leg| b[leg])).collect();
        let lo = (0..n).map(|i| if is_normal(i) { 0.0 } else { -INF }).collect();
        let normal = |i| leg(i).filter(|leg| leg % 3 > 0).map(|leg| i - leg % 3);
        let index = (0..n).map(normal).collect();
        let lcp = Lcp::new(Matrix::dense(n, &whole), offset, lo, vec![INF; n]).unwrap();
        let lcp = lcp.with_coupling(Coupling::new(index, vec![0.5; n]).unwrap()).unwrap();
        let (kind, proof) = kind(&lcp, &vec![0.0; n]);
        assert!([Kind::Solution, Kind::NotUnique].contains(&kind), "{proof:?}");
    }
}

#[test]
fn the_residual_is_that_of_the_definition() {
    // w = 2 x − 1 at x = ¼: T = 1.5, s = 2, e = ¾; x − e w/T = ½, so r = ¼ / ¾.
    let lcp = contacts(&[2.0], &[-1.0]);
    let Claim::Within { residual, .. } = within(&lcp, &[0.25]) else { panic!() };
    assert_eq!(residual.numerator, 1.into());
    assert_eq!(residual.denominator, 3.into());
}

/// The claim about an answer's residual, by a proof that says nothing else.
fn within(lcp: &Lcp, answer: &[f64]) -> Claim {
    let text = |numerator: u32, denominator: u32| {
        format!(
            r#"{{"format": "lcplab-proof-1", "problem": "{}", "kind": "within", "answer": {answer:?},
                "residual": {{"numerator": "{numerator:x}", "denominator": "{denominator:x}"}}}}"#,
            hash(&asked(lcp))
        )
    };
    let proof = Proof::parse(&text(1, 3), "proof.json").unwrap();
    assert_eq!(check(&asked(lcp), &proof), Ok(()));
    let wrong = Proof::parse(&text(1, 4), "proof.json").unwrap();
    assert!(check(&asked(lcp), &wrong).is_err());
    proof.claim
}

#[test]
fn the_canonical_bytes_are_those_of_the_specification() {
    let bytes = canonical_bytes(&asked(&contacts(&[2.0, 0.0, 0.0, -0.0], &[-0.0, 1.0])));
    let one = [0x3f, 0xf0, 0, 0, 0, 0, 0, 0];
    let inf = [0x7f, 0xf0, 0, 0, 0, 0, 0, 0];
    let zero = [0; 8];
    let mut expected = b"lcplab problem 1\n".to_vec();
    expected.extend([0, 0, 0, 2]);
    expected.extend(zero); // scale
    expected.extend([0, 0, 0, 1, 0, 0, 0, 0, 0x40, 0, 0, 0, 0, 0, 0, 0]); // 2 at (0, 0)
    expected.extend([0, 0, 0, 0]); // nothing in row 1
    expected.extend([zero, one, zero, zero, inf, inf].concat());
    expected.extend([0; 2 * 12 + 4]); // no friction, and no bodies
    assert_eq!(bytes, expected);
    // the worked example
    let one = contacts(&[2.0], &[-1.0]);
    assert_eq!(canonical_bytes(&asked(&one)).len(), 85);
    assert!(include_str!("../../../../docs/proofs.md").contains(&hash(&asked(&one))));
}
