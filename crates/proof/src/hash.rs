//! The hash of a problem, which ties a proof to it.

use sha2::{Digest, Sha256};

use lcplab_lcp::friction::Model;
use lcplab_lcp::{Lcp, Question};

/// The friction model of a question: without one, friction rows are coupled boxes.
pub(crate) fn model(question: &Question) -> Model {
    question.model().unwrap_or_default()
}

/// The rows that a proof is about: the LCP of a box; for a cone or a polygon the rows of the file.
pub(crate) fn rows(question: &Question) -> &Lcp {
    question.boxed().unwrap_or(&question.problem().lcp)
}

/// The numbers of a problem, and its model if that is not the coupled box, in the canonical order
/// and format of `docs/proofs.md`.
pub fn canonical_bytes(question: &Question) -> Vec<u8> {
    let mut bytes = numbers(question);
    let model = model(question);
    if model != Model::CoupledBox {
        let name = model.to_string();
        integer(&mut bytes, name.len());
        bytes.extend(name.into_bytes());
    }
    bytes
}

fn numbers(question: &Question) -> Vec<u8> {
    let lcp = rows(question);
    let n = lcp.len();
    let mut bytes = b"lcplab problem 1\n".to_vec();
    integer(&mut bytes, n);
    number(&mut bytes, lcp.scale());
    for i in 0..n {
        row(&mut bytes, lcp.matrix().row(i).iter());
    }
    for vector in [lcp.b(), lcp.lo(), lcp.hi()] {
        vector.iter().for_each(|&value| number(&mut bytes, value));
    }
    for i in 0..n {
        let (k, mu) = lcp.coupled_to(i).map_or((0, 0.0), |(k, mu)| (k + 1, mu));
        integer(&mut bytes, k);
        number(&mut bytes, mu);
    }
    let Some(motion) = &question.problem().motion else {
        integer(&mut bytes, 0);
        return bytes;
    };
    integer(&mut bytes, 1);
    let k = motion.target.len();
    integer(&mut bytes, k);
    for i in 0..k {
        let own = motion.mass.iter().filter(|entry| entry.0 == i);
        row(&mut bytes, own.map(|&(_, j, value)| (j, value)));
    }
    motion.jacobian.iter().for_each(|own| row(&mut bytes, own.iter().copied()));
    for vector in [&motion.bias, &motion.compliance, &motion.target] {
        vector.iter().for_each(|&value| number(&mut bytes, value));
    }
    bytes
}

/// A row of a matrix in order of increasing columns.
fn row(bytes: &mut Vec<u8>, entries: impl Iterator<Item = (usize, f64)>) {
    let mut entries: Vec<(usize, f64)> = entries.filter(|&(_, value)| value != 0.0).collect();
    entries.sort_by_key(|&(j, _)| j);
    integer(bytes, entries.len());
    for (j, value) in entries {
        integer(bytes, j);
        number(bytes, value);
    }
}

fn integer(bytes: &mut Vec<u8>, value: usize) {
    bytes.extend(u32::try_from(value).expect("fewer than 2³² rows").to_be_bytes());
}

fn number(bytes: &mut Vec<u8>, value: f64) {
    // Adding 0 turns −0 into 0.
    bytes.extend((value + 0.0).to_be_bytes());
}

/// SHA-256 of the canonical bytes, in hexadecimal digits.
///
/// ```
/// use lcplab_lcp::file::Problem;
/// use lcplab_lcp::{Lcp, Matrix, Question};
/// use lcplab_proof::{canonical_bytes, hash};
///
/// let question = |b: f64| {
///     let lcp = Lcp::new(Matrix::from([[3.0]]), vec![b], vec![0.0], vec![f64::INFINITY])?;
///     Question::new(&Problem::new("", lcp), None, "one.json")
/// };
/// assert_eq!(hash(&question(-1.0)?).len(), 64); // hexadecimal digits
/// assert_ne!(hash(&question(-1.0)?), hash(&question(-2.0)?)); // another problem
/// assert_eq!(canonical_bytes(&question(0.0)?), canonical_bytes(&question(-0.0)?)); // 0 is −0
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn hash(question: &Question) -> String {
    Sha256::digest(canonical_bytes(question)).iter().map(|byte| format!("{byte:02x}")).collect()
}
