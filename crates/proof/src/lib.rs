//! Proof files: an exact solution, whether it is the only one, that no solution exists, the exact
//! residual of a floating-point answer, and how far its motion is from the exact one.
//!
//! [`prove`] finds the strongest [`Claim`] that it can prove about a problem under its friction
//! model, [`Proof::to_json`] writes it, and [`check`] checks a proof against the problem in exact
//! arithmetic. `docs/proofs.md` describes the format and why each check proves its claim;
//! `proofs/lcpcheck.py` checks the same files and shares no code with this crate.
//!
//! ```
//! use lcplab_lcp::file::Problem;
//! use lcplab_lcp::{Lcp, Matrix, Question};
//! use lcplab_proof::{Kind, Proof, check, prove};
//!
//! // w = (2 x_0 − x_1 − 1, 2 x_1 − x_0 + 2): x = (½, 0) and no other.
//! let a = Matrix::dense(2, &[2.0, -1.0, -1.0, 2.0]);
//! let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
//! let problem = Problem::new("two contacts", lcp);
//! let question = Question::new(&problem, None, "two.json")?;
//! let found = prove(&question, &[0.5, 0.0]);
//! let proof = found.proof.expect("a proof");
//! assert_eq!(proof.claim.kind(), Kind::Unique);
//!
//! let read = Proof::parse(&proof.to_json().to_string(), "proof.json")?;
//! assert_eq!(check(&question, &read), Ok(()));
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

mod cases;
mod check;
mod claim;
mod cone;
mod cone_motion;
mod congruence;
mod format;
mod hash;
mod minors;
mod motion;
mod pivot;
mod prove;
mod residual;

pub use check::check;
pub use claim::{
    Bounded, Claim, Entry, Fraction, Kind, Motion, Near, Proof, Reason, Region, Vector,
};
pub use hash::{canonical_bytes, hash};
pub use lcplab_judge::cases::Tree;
pub use prove::{ProofSearch, prove, prove_different, prove_kind};
pub use residual::scaled as exact_residual;

#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
