//! Siconos.

use crate::contender::Contender;
use crate::raw::{Raw, solvers_in_c};

/// Lemke's method and a Newton method; an LCP of theirs has no free rows.
pub fn solvers(raw: &Raw) -> Vec<Contender<'_>> {
    if raw.is_unbounded() {
        return Vec::new();
    }
    vec![
        raw.contender("Siconos Lemke", peers_siconos_lemke, "it returned info"),
        raw.contender("Siconos Newton min-FB", peers_siconos_newton, "it returned info"),
    ]
}

solvers_in_c!(peers_siconos_lemke peers_siconos_newton);
