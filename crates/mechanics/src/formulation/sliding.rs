//! A contact that slides at acceleration level: its friction is not an unknown but proportional to
//! the normal force.
//!
//! ```text
//! x_t = −μ x_n v_t/|v_t|,   so   Jᵀx = (J_n − μ Σ_t v_t/|v_t| J_t)ᵀ x_n
//! A_in = J_i M⁻¹ (J_n − μ Σ_t v_t/|v_t| J_t)ᵀ     A is no longer symmetric
//! ```
//!
//! This is exactly Coulomb's law as long as the contact slides. But A_nn may be negative: a rod
//! pushed like a piece of chalk is turned into the ground by its own friction, the more so the
//! larger the normal force, and no force satisfies the law (Painlevé 1895; Baraff 1993). Row n
//! alone then proves that the problem has no solution.

use std::collections::BTreeMap;

use crate::assembly::Assembly;
use crate::constraint::Bounds;
use crate::scene::{Scene, Sliding};

/// A sliding contact.
#[derive(Debug, Clone, PartialEq)]
pub struct Slide {
    /// Its normal row.
    pub normal: usize,
    /// Its tangential rows t, each with x_t/x_n = −μ v_t/|v_t|.
    pub drag: Vec<(usize, f64)>,
}

impl Slide {
    /// The sliding contacts whose friction the scene substitutes.
    pub fn of_scene(scene: &Scene, assembly: &Assembly) -> Vec<Slide> {
        match scene.contact.sliding {
            Sliding::Box => Vec::new(),
            Sliding::Substituted => Slide::all(assembly, scene.contact.sticking_speed),
        }
    }

    /// The contacts of an assembly that slip faster than this (m/s).
    pub fn all(assembly: &Assembly, sticking_speed: f64) -> Vec<Slide> {
        let mut contacts: BTreeMap<usize, Vec<(usize, f64)>> = BTreeMap::new();
        for (t, row) in assembly.rows.iter().enumerate() {
            if let Bounds::Friction { normal, mu } = row.bounds {
                contacts.entry(normal).or_default().push((t, mu));
            }
        }
        let slide = |(normal, tangents): (usize, Vec<(usize, f64)>)| {
            let slip = |&(t, _): &(usize, f64)| assembly.rows[t].velocity;
            let speed = tangents.iter().map(|t| slip(t).powi(2)).sum::<f64>().sqrt();
            let part = |&(t, mu): &(usize, f64)| (t, -mu * slip(&(t, mu)) / speed);
            let drag = tangents.iter().map(part).collect();
            (speed > sticking_speed).then_some(Slide { normal, drag })
        };
        contacts.into_iter().filter_map(slide).collect()
    }

    /// Whether the slip would reverse from J u to J u⁺: the contact stops in between.
    pub(crate) fn reverses(&self, before: &[f64], after: &[f64]) -> bool {
        self.drag.iter().map(|&(t, _)| before[t] * after[t]).sum::<f64>() < 0.0
    }
}
