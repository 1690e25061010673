//! ContactBench's contact problems: `numpy.savez(…, G=G, g=g, mus=mus)`.
//!
//! | array | type | meaning |
//! | --- | --- | --- |
//! | `G` | numbers, 3m × 3m | the matrix of m contacts; A = G |
//! | `g` | numbers, 3m or 3m × 1 | the speeds without impulses; b = g |
//! | `mus` | numbers, m | the coefficients of friction |
//!
//! The rows of a contact are t1, t2, n, with the normal last, and keep this order. The law is
//! Coulomb's with the cone. An additional array `lam0` is a solver's starting point.

use std::collections::HashMap;

use super::array::Array;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::{Parts, Problem};
use lcplab_lcp::friction::Model;

/// The names of the arrays.
pub(super) const ARRAYS: [&str; 3] = ["G", "g", "mus"];

/// The name of the array with an initial guess of the impulses.
pub(super) const GUESS: &str = "lam0";

/// The problem stored in these arrays.
pub(super) fn problem(arrays: &HashMap<&str, Array>, name: String, input: &str) -> Result<Problem> {
    let get = |part: &str| {
        arrays.get(part).ok_or_else(|| Error::invalid(input, part, "is missing beside G"))
    };
    let fault = |part: &'static str| move |reason| Error::invalid(input, part, reason);
    let matrix = get("G")?.table().map_err(fault("G"))?;
    let b = get("g")?.vector().map_err(fault("g"))?;
    let mus = get("mus")?.vector().map_err(fault("mus"))?;
    let n = b.len();
    if mus.len().checked_mul(3) != Some(n) {
        let reason = format!("has {} contacts, g has {n} rows", mus.len());
        return Err(Error::invalid(input, "mus", reason));
    }
    let is_normal = |i: usize| i % 3 == 2;
    let index = (0..n).map(|i| (!is_normal(i)).then_some(i - i % 3 + 2)).collect();
    let mu = (0..n).map(|i| if is_normal(i) { 0.0 } else { mus[i / 3] }).collect();
    let entries = matrix.square(n, input)?;
    let parts = Parts { entries, b, lo: None, hi: None, index: Some(index), mu: Some(mu) };
    let lcp = parts.into_lcp().map_err(|error| error.within(input))?;
    // Without coupling there are no contacts.
    let model = lcp.coupling().map(|_| Model::CoulombCone);
    Ok(Problem { model, ..Problem::new(name, lcp) })
}
