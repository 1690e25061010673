//! Code 8: the matrices of a step as a program reads, with operators instead of loops.
//!
//! ```text
//! A = J M⁻¹ Jᵀ,   b = J (u + dt M⁻¹ F),   to be solved for A x = b, then u⁺ = u* − M⁻¹ Jᵀ x
//! ```
//!
//! The listing's point is that a formula can be written down directly, which holds here too: the
//! operators are nalgebra's. But its statements are in the wrong order, a dt is missing, and its
//! velocities are side by side where Code 6 needs them in one column (E27, E49).

use nalgebra::DMatrix;

use super::Listing;

pub(in crate::chapter) const LISTING: Listing = Listing {
    id: "Code 8",
    title: "the matrices of a step, written with operators",
    printed: "Transpose J, then fill it; A = J M⁻¹ Jᵀ and b = J (V + M⁻¹ F), one row per body in V and F.",
    corrected: "Fill J, then transpose it; b = J (u + dt M⁻¹ F), with all velocities in one column.",
    errata: &["E27", "E49"],
};

/// The matrices passed to the solver of A x = b.
#[derive(Debug, Clone, PartialEq)]
pub struct System {
    /// n × n.
    pub a: DMatrix<f64>,
    /// n × 1; 6 columns in the printed form.
    pub b: DMatrix<f64>,
}

/// The listing as printed.
pub mod printed {
    use nalgebra::DMatrix;

    use super::System;

    /// A and b of m bodies under n constraints. `inverse_mass` is m × m; `velocity` and `force`
    /// have one row of 6 per body; `jacobian` (n × m) is the content of J.
    ///
    /// The listing transposes the empty J before it is filled: Jᵀ, and therefore A, is 0.
    ///
    /// # Panics
    /// If the sizes do not match.
    pub fn system(
        inverse_mass: &DMatrix<f64>,
        velocity: &DMatrix<f64>,
        force: &DMatrix<f64>,
        jacobian: &DMatrix<f64>,
    ) -> System {
        let mut j = DMatrix::zeros(jacobian.nrows(), jacobian.ncols());
        let j_transpose = j.transpose();
        j.copy_from(jacobian);
        System {
            a: &j * inverse_mass * j_transpose,
            b: &j * (velocity + inverse_mass * force), // no dt: velocities and accelerations added
        }
    }
}

/// The listing with its statements in order, its dt, and u in one column.
pub mod corrected {
    use nalgebra::DMatrix;

    use super::System;

    /// A and b of m bodies under n constraints over a step of dt (s): `inverse_mass` is 6m × 6m,
    /// `velocity` and `force` are 6m × 1, `jacobian` is n × 6m. K&M (15), in the sign of Code 4.
    ///
    /// # Panics
    /// If the sizes do not match.
    pub fn system(
        inverse_mass: &DMatrix<f64>,
        velocity: &DMatrix<f64>,
        force: &DMatrix<f64>,
        jacobian: &DMatrix<f64>,
        dt: f64,
    ) -> System {
        System {
            a: jacobian * inverse_mass * jacobian.transpose(),
            b: jacobian * (velocity + inverse_mass * force * dt),
        }
    }
}
