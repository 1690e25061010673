//! Degrees of freedom: the dimension of the velocities that the equations allow.
//!
//! ```text
//! degrees_of_freedom = k − rank J_E
//! ```
//!
//! with k velocity components of moving bodies (6 per rigid body, 3 per point mass) and J_E the
//! rows of rigid equations. Counting rows instead of their rank is right only if the rows are
//! independent: Bricard's mechanism has 30 of each and moves. K&M "Maximal coordinates", E19, E20.

/// The degrees of freedom that the equations leave.
///
/// ```
/// use lcplab_analysis::diagnosis::DegreesOfFreedom;
/// use lcplab_mechanics::assembly::{Assembly, ConstraintFilter};
/// use lcplab_mechanics::scene::Scene;
///
/// // A bob in space on a rod: 3 − 1.
/// let scene = Scene::load("pendulum")?;
/// let filter = ConstraintFilter::Near;
/// let assembly = Assembly::new(&scene, &scene.states, &[], filter).expect("a direction");
/// assert_eq!(DegreesOfFreedom::of(&assembly).left(), 2);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DegreesOfFreedom {
    /// k, the velocity components of moving bodies.
    pub components: usize,
    /// The rows of rigid equations.
    pub rows: usize,
    /// The number of independent ones among them.
    pub rank: usize,
}

impl DegreesOfFreedom {
    /// The remaining degrees of freedom.
    pub fn left(&self) -> usize {
        self.components - self.rank
    }
}
