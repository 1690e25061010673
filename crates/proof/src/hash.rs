//! What a proof is about: the bits of a problem.

use sha2::{Digest, Sha256};

use lcplab_problem::Lcp;

/// The numbers of a problem in the one order and form that `docs/proofs.md` states.
pub fn canonical_bytes(lcp: &Lcp) -> Vec<u8> {
    let n = lcp.len();
    let mut bytes = b"lcplab problem 1\n".to_vec();
    integer(&mut bytes, n);
    number(&mut bytes, lcp.scale());
    for i in 0..n {
        let entries: Vec<(usize, f64)> =
            lcp.matrix().row(i).iter().filter(|&(_, a)| a != 0.0).collect();
        integer(&mut bytes, entries.len());
        for (j, a) in entries {
            integer(&mut bytes, j);
            number(&mut bytes, a);
        }
    }
    for vector in [lcp.b(), lcp.lo(), lcp.hi()] {
        vector.iter().for_each(|&value| number(&mut bytes, value));
    }
    for i in 0..n {
        let coupled = lcp.coupling().and_then(|c| Some((c.index(i)? + 1, c.mu(i))));
        let (k, mu) = coupled.unwrap_or_default();
        integer(&mut bytes, k);
        number(&mut bytes, mu);
    }
    integer(&mut bytes, 0); // no motion
    bytes
}

fn integer(bytes: &mut Vec<u8>, value: usize) {
    bytes.extend(u32::try_from(value).expect("fewer than 2³² rows").to_be_bytes());
}

fn number(bytes: &mut Vec<u8>, value: f64) {
    bytes.extend((value + 0.0).to_be_bytes()); // + 0 turns −0 into 0
}

/// SHA-256 of the canonical bytes, in hexadecimal digits.
pub fn hash(lcp: &Lcp) -> String {
    Sha256::digest(canonical_bytes(lcp)).iter().map(|byte| format!("{byte:02x}")).collect()
}
