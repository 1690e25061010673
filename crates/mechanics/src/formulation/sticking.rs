//! Static friction larger than kinetic friction: the answer decides which contacts stick.
//!
//! Every contact starts with μ_s. If it slips in the answer, static friction cannot hold it until
//! the end of the step: it gets μ, and the problem is solved again, until no other contact slips.
//! So
//!
//! ```text
//! |x_t| ≤ μ_s x_n   where J_t u⁺ = 0,       |x_t| ≤ μ x_n   where it is not
//! ```
//!
//! for any friction model. A contact that has been given μ keeps it in this step, so the iteration
//! ends. A contact with substituted friction slides, with μ.

use super::Problem;
use crate::assembly::{Row, Source};
use crate::constraint::Bounds;
use crate::scene::Scene;
use lcplab_lcp::error::Result;

/// The slip, relative to that which static friction could stop, above which a contact slips.
/// Smaller slip counts as zero, also in an answer of sweeps that stopped early.
const SLIPS: f64 = 1e-4;

impl Problem {
    /// The problem with static friction in all contacts with unknown friction.
    ///
    /// # Errors
    /// If a coefficient is not finite.
    pub(crate) fn held(self, scene: &Scene) -> Result<Self> {
        match scene.has_static_friction() {
            true => {
                self.with_friction(|_, row, mu| resting(scene, row).map_or(mu, |own| own.max(mu)))
            }
            false => Ok(self),
        }
    }

    /// The problem with kinetic friction in the contacts that had static friction and slip under
    /// the answer x (one entry per row); `None` if there are none.
    ///
    /// # Errors
    /// If a coefficient is not finite.
    pub(crate) fn loosened(&self, scene: &Scene, x: &[f64]) -> Result<Option<Self>> {
        if !scene.has_static_friction() {
            return Ok(None);
        }
        let mut slips = vec![false; x.len()];
        for (t, row) in self.assembly.rows.iter().enumerate() {
            let Some((normal, mu)) = self.lcp.coupled_to(t) else { continue };
            let stops = mu * x[normal].max(0.0) * self.lcp.matrix().diagonal(t);
            let held = sliding(scene, row).is_some_and(|own| mu > own);
            slips[normal] |= held && self.lcp.row_w(t, x).abs() > SLIPS * stops;
        }
        if !slips.contains(&true) {
            return Ok(None);
        }
        let own = |normal: usize, row: &Row, mu: f64| match slips[normal] {
            true => sliding(scene, row).unwrap_or(mu),
            false => mu,
        };
        self.clone().with_friction(own).map(Some)
    }

    /// The problem with other coefficients of friction, computed from the normal row, the row and
    /// the old coefficient.
    fn with_friction(mut self, own: impl Fn(usize, &Row, f64) -> f64) -> Result<Self> {
        let Some(coupling) = self.lcp.coupling() else { return Ok(self) };
        let rows = &mut self.assembly.rows;
        let coupling = coupling.with_mu(|t, normal, mu| own(normal, &rows[t], mu))?;
        for (t, normal) in coupling.rows() {
            rows[t].bounds = Bounds::Friction { normal, mu: coupling.mu(t) };
        }
        self.lcp = self.lcp.with_coupling(coupling)?;
        Ok(self)
    }
}

/// The coefficient of static friction of a contact's row.
fn resting(scene: &Scene, row: &Row) -> Option<f64> {
    pair(row).map(|pair| scene.static_friction(pair))
}

/// The coefficient of friction of a contact's row.
fn sliding(scene: &Scene, row: &Row) -> Option<f64> {
    pair(row).map(|pair| scene.friction(pair))
}

/// The two bodies of a contact's row.
fn pair(row: &Row) -> Option<[usize; 2]> {
    match row.id.source {
        Source::Contact(id) => Some(id.bodies),
        Source::Constraint(_) => None,
    }
}
