//! Verdicts and certificates with the keys that `lcplab judge --json` prints.
//!
//! They are only written. A verdict counts because the judge has just computed it; whoever reads an
//! answer from a file judges its x again.

use dashu_ratio::RBig;
use serde::ser::{Serialize, SerializeMap, Serializer};

use crate::{Certificate, Evidence, Refutation, Verdict, printed_up};
use lcplab_lcp::number::Filed;

/// The key `verdict`, and the numbers of the verdict.
impl Serialize for Verdict {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        verdict(*self, &mut map)?;
        map.end()
    }
}

fn verdict<M: SerializeMap>(verdict: Verdict, map: &mut M) -> Result<(), M::Error> {
    map.serialize_entry("verdict", verdict.word())?;
    match verdict {
        Verdict::Proved { distance } => {
            map.serialize_entry("distance", &Filed(printed_up(distance)))
        }
        Verdict::NotASolution { row, amount, .. } => {
            map.serialize_entry("row", &row)?;
            map.serialize_entry("amount", &Filed(amount))
        }
        Verdict::WithinTolerance => Ok(()),
    }
}

/// The residuals, gaps and bounds, the verdict, and what exact arithmetic showed in addition.
///
/// ```
/// use lcplab_judge::{Demand, judge};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
/// let certificate = judge(&lcp, &[0.5], &Demand::default());
/// let text = serde_json::to_string(&certificate).unwrap();
/// assert!(text.starts_with(r#"{"natural_residual":0.0,"scaled_residual":0.0,"#), "{text}");
/// assert!(text.ends_with(r#""verdict":"proved","distance":0.0}"#), "{text}");
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
impl Serialize for Certificate {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for (key, value) in [
            ("natural_residual", self.natural_residual),
            ("scaled_residual", self.scaled_residual),
            ("complementarity_gap", self.complementarity_gap),
            ("bound_violation", self.bound_violation),
            ("dual_infeasibility", self.dual_infeasibility),
            ("objective", self.objective),
            ("duality_gap", self.duality_gap),
        ] {
            map.serialize_entry(key, &Filed(value))?;
        }
        if self.scale > 0.0 {
            map.serialize_entry("scale", &Filed(self.scale))?;
        }
        if let Some(by) = self.rounded_by {
            map.serialize_entry("rounded_by", &Filed(printed_up(by)))?;
        }
        verdict(self.verdict, &mut map)?;
        if let Some(evidence) = &self.evidence {
            map.serialize_entry("certificate", evidence)?;
        }
        map.end()
    }
}

/// An object with one key: `not_unique`, `far_solution`, `no_solution`, `case_split` or
/// `no_exact_solution`, which holds what one of the two keys before it would. Exact numbers are
/// text, such as "-1/3".
impl Serialize for Evidence {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let fractions = |vector: &[RBig]| vector.iter().map(RBig::to_string).collect::<Vec<_>>();
        let mut map = serializer.serialize_map(Some(1))?;
        match self {
            Evidence::NotUnique(direction) => {
                map.serialize_entry("not_unique", &fractions(direction))?;
            }
            Evidence::FarSolution { distance } => {
                map.serialize_entry("far_solution", &Filed(printed_up(*distance)))?;
            }
            Evidence::NoExactSolution(Refutation::Vector(farkas)) => {
                map.serialize_entry("no_exact_solution", &fractions(&farkas.vector))?;
            }
            Evidence::NoExactSolution(Refutation::CaseSplit { pieces }) => {
                map.serialize_entry("no_exact_solution", pieces)?;
            }
            Evidence::NoSolution(Refutation::Vector(farkas)) => {
                map.serialize_entry("no_solution", &fractions(&farkas.vector))?;
            }
            Evidence::NoSolution(Refutation::CaseSplit { pieces }) => {
                map.serialize_entry("case_split", pieces)?;
            }
        }
        map.end()
    }
}
