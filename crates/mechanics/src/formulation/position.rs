//! The position level: corrections y (kg m), w = c + J M⁻¹Jᵀ y (m), the errors after the move
//! M⁻¹Jᵀy.
//!
//! ```text
//! bias = c                   equations, and gaps, which stay open
//!        min(c + slop, 0)    a contact that overlaps
//!        0                   friction: bodies that are pushed out do not slip
//! ```
//!
//! Nothing moves without corrections, so the target is 0. Motors and springs have no position
//! error.

use crate::assembly::{Assembly, Row};
use crate::constraint::Kind;
use crate::scene::Scene;

pub(super) fn bias(assembly: &Assembly, scene: &Scene) -> Vec<f64> {
    let bias = |row: &Row| match row.kind {
        Kind::Normal if row.c <= 0.0 => (row.c + scene.contact.slop).min(0.0),
        _ => row.c,
    };
    assembly.rows.iter().map(bias).collect()
}
