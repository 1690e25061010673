//! Proofs for deliberately misleading problems: the judge and the independent checkers agree with
//! them.

use std::path::Path;
use std::process::Command;

use lcplab_analysis::answer::first_answer;
use lcplab_analysis::hunt::problem;
use lcplab_judge::{Demand, Evidence, Verdict, judge};
use lcplab_lcp::Question;
use lcplab_lcp::file::Problem;
use lcplab_proof::{Kind, prove};

/// Two of each kind of the hunt's problems, and more.
const PROBLEMS: usize = 300;

/// A solver's answer, and answers that no solver should give.
fn answers(k: usize) -> [Option<f64>; 2] {
    let absurd = [0.0, 1e308, f64::INFINITY, f64::NAN, -1.0, 1e-320];
    [None, Some(absurd[k % absurd.len()])]
}

#[test]
fn what_the_judge_proves_or_refutes_has_a_proof_that_others_accept() {
    let folder = tempfile::tempdir().unwrap();
    let write =
        |name: String, text: String| std::fs::write(folder.path().join(name), text).unwrap();
    let (mut proved, mut rejected, mut written) = (0, 0, 0);
    for k in 0..PROBLEMS {
        let lcp = problem(22, k).0;
        let subject = Problem::new(format!("hunted {k}"), lcp.clone());
        let question = Question::new(&subject, None, "hunted").unwrap();
        for (way, answer) in answers(k).into_iter().enumerate() {
            let x = answer.map_or_else(|| first_answer(&question), |x| vec![x; lcp.len()]);
            let certificate = judge(&lcp, &x, &Demand::default());
            let found = prove(&question, &x);
            let kind = found.proof.as_ref().map(|proof| proof.claim.kind());
            let is_solvable =
                kind.is_some_and(|kind| kind <= Kind::Solution && kind > Kind::NoSolution);
            let text = format!("{k}: {:?}, but {kind:?}; {:?}", certificate.verdict, found.missing);
            if matches!(certificate.verdict, Verdict::Proved { .. }) {
                assert!(is_solvable, "{text}");
                proved += 1;
            }
            match certificate.evidence {
                Some(Evidence::NotUnique(_)) => assert_eq!(kind, Some(Kind::NotUnique), "{text}"),
                Some(Evidence::FarSolution { .. }) => assert!(is_solvable, "{text}"),
                Some(Evidence::NoExactSolution(_)) => {
                    assert_eq!(kind, Some(Kind::NoSolution), "{text}");
                }
                Some(Evidence::NoSolution(_)) => {
                    assert_eq!(kind, Some(Kind::NoSolution), "{text}");
                    rejected += 1;
                }
                None => {}
            }
            // If the residual is finite, there is always something to prove.
            assert!(kind.is_some() || !certificate.scaled_residual.is_finite(), "{text}");
            if let Some(proof) = found.proof {
                write(format!("{k:03}-{way}.json"), subject.to_json().to_string());
                write(format!("{k:03}-{way}.proof.json"), proof.to_json().to_string());
                written += 1;
            }
        }
    }
    assert!(proved > PROBLEMS / 4 && rejected > 0, "{proved} {rejected}");
    let checker = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../proofs/lcpcheck.py");
    let output = Command::new("python3").arg(checker).arg(folder.path()).output().unwrap();
    let printed = String::from_utf8(output.stdout).unwrap();
    assert!(
        printed.ends_with(&format!("{written} of {written} proofs prove their claims\n")),
        "{printed}"
    );
}
