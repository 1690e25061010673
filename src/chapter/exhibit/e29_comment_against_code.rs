//! E29: Code 7's comment and its code differ by −1/dt.

use nalgebra::{DMatrix, DVector};

use super::setting::{DT, G, one, single};
use super::{Finding, Measure};
use crate::chapter::code::code01_unconstrained_step::Blocks;
use crate::chapter::code::{
    code02_constrained_step as code02, code04_drift_correction as code04, code06_solver as code06,
};
use crate::document::notation::plain;
use crate::error::Result;

/// Code 7's comment: the force λ of A λ = −J (u/dt + M⁻¹ F).
fn by_comment(blocks: &Blocks, jacobian: &DMatrix<f64>) -> Result<DVector<f64>> {
    let b = -(jacobian * (&blocks.u / DT + &blocks.M_inv * &blocks.F));
    code06::printed(&code04::matrix(blocks, jacobian), &b, None, None, 300)
}

/// A ball on the ground, and the three balls of Figure 7.
pub(super) fn example() -> Result<Finding> {
    let (ball, jacobian) = (Blocks::on_a_line(&[-1.0], &[1.0], &[-G]), one(1.0));
    let lambda = by_comment(&ball, &jacobian)?;
    let mixed = code02::printed(&ball, &jacobian, &lambda, DT).0[0];
    let x = code04::corrected(&ball, &jacobian, &single(0.0), DT, 1)?;
    let right = code02::corrected(&ball, &jacobian, &x, DT).0[0];

    let stack = Blocks::on_a_line(&[0.0, -1.0, 0.0], &[1.0; 3], &[-G; 3]);
    let gaps = DMatrix::from_row_slice(3, 3, &[1.0, 0.0, 0.0, -1.0, 1.0, 0.0, 0.0, -1.0, 1.0]);
    let taken = code04::printed(&stack, &gaps, &DVector::zeros(3), DT, 300)?;
    let forces = by_comment(&stack, &gaps)?;
    let finding = Finding::new(format!(
        "A ball of 1 kg on the ground moves down at 1 m/s; g = 9.81 m/s², dt = 1/60 s. The comment gives \
         λ = {} N. First its λ is put into the code's step; corrected is b = J u* = {} m/s in w = A x + b. \
         Then −x/dt of the code (as printed) and λ of the comment (as corrected) are compared in the stack \
         of Figure 7, three such balls at rest but for the middle one, which moves down at 1 m/s: they are \
         the same forces. Each contact supports the weight above it, and the two lower ones stop the moving body.",
        plain(lambda[0]),
        plain(-x[0]),
    ));
    let speed = Measure::new("u⁺, the comment's λ in the code", "m/s", mixed, right);
    let same = |words: &str, i: usize, truth: f64| {
        let measure = Measure::new(words, "N", -taken[i] / DT, forces[i]);
        measure.truth(&[truth], "statics", 1e-9).agreeing()
    };
    Ok(finding
        .measure(speed.truth(&[0.0], "the ground holds", 1e-12))
        .measure(same("Figure 7, lowest contact", 0, 3.0 * G + 1.0 / DT))
        .measure(same("Figure 7, next contact", 1, 2.0 * G + 1.0 / DT))
        .measure(same("Figure 7, highest contact", 2, G)))
}
