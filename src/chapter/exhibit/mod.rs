//! The errata as exhibits: what is printed, what holds, and an example that tells them apart.
//!
//! An exhibit compares both with a truth found in a third way: a closed form, exact arithmetic, dual
//! numbers, another method. Nothing about the outcome is stored: the example runs when the exhibit is
//! looked at, and [`Finding::is_shown`] says whether the printed form failed and the corrected one
//! held.
//!
//! ```
//! use lcplab::chapter::exhibit;
//!
//! let finding = exhibit::named("E21")?.found()?;
//! assert!(finding.is_shown());
//! # Ok::<(), lcplab::error::Error>(())
//! ```

mod common;
mod e01_overlapping_conditions;
mod e02_meanings_of_b;
mod e03_missing_coefficient;
mod e04_stop_test;
mod e05_no_complementarity;
mod e06_clamping_after_the_sweep;
mod e07_finite_convergence;
mod e08_pivoting;
mod e09_equality_contacts;
mod e10_semidefinite;
mod e11_no_inverse;
mod e12_warm_start;
mod e13_step_without_dt;
mod e14_velocity_level;
mod e15_shape_of_the_jacobian;
mod e16_blocks_of_the_jacobian;
mod e17_inverted_ratio;
mod e18_locked_axis;
mod e19_rows_and_freedoms;
mod e20_counting;
mod e21_position_update;
mod e22_figure_4;
mod e23_effective_mass;
mod e24_quaternion_rate;
mod e25_torque;
mod e26_gyroscopic_term;
mod e27_velocity_matrix;
mod e28_impulse_or_force;
mod e29_comment_against_code;
mod e30_signs;
mod e31_no_bounds;
mod e32_early_return;
mod e33_doubled_penalty;
mod e34_beta_without_dt;
mod e35_sign_of_feedback;
mod e36_does_not_compile;
mod e37_no_bounce;
mod e38_strict_test;
mod e39_feedback_is_no_spring;
mod e40_orientation_coordinates;
mod e41_ball_joint_arms;
mod e42_distance_row;
mod e43_owner_of_the_normal;
mod e44_sign_of_the_contact_row;
mod e45_contact_as_three_rows;
mod e46_binary_rows;
mod e47_immovable_bodies;
mod e48_action_and_reaction;
mod e49_order_of_statements;
mod e50_size_limits;
mod e51_shared_memory;
mod e52_empty_does_not_clear;
mod e53_data_column_by_column;
mod e54_stored_zeros;
mod e55_product_of_three;
mod e56_names_of_storages;
mod e57_linked_list_memory;
mod e58_unbalanced_tree;
mod e59_matrices_of_size_zero;
mod e60_labels;
mod e61_no_best_fit;
mod e62_complementarity;
mod e63_force_not_strain;
mod e64_drift;
mod e65_distance_glues;
mod e66_one_iteration_two_names;
mod e67_closer_in_which_sense;
mod finding;
mod rate;
mod setting;
mod show;

pub use finding::{Finding, Measure, Outcome};

use crate::error::{Error, Result};

/// A statement of the chapter that needs correction.
#[derive(Debug, Clone, Copy)]
pub struct Exhibit {
    /// Its number: `E07`.
    pub id: &'static str,
    /// What it is about, in a line.
    pub title: &'static str,
    /// Where it is printed: `K&M (16)`, `K&M Code 6`.
    pub place: &'static str,
    /// How far it leads astray.
    pub severity: Severity,
    /// Whether the fault may lie with the scan from which the text was read.
    pub may_be_scan: bool,
    /// What is printed, in our own words; plain text.
    pub printed: &'static str,
    /// What holds instead; plain text.
    pub holds: &'static str,
    /// Why, in a few sentences a student can follow; plain text.
    pub why: &'static str,
    /// How the difference is shown.
    pub evidence: Evidence,
}

/// How far a statement leads astray.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Severity {
    /// Following it gives a wrong result or a crash.
    Wrong,
    /// A reader draws a wrong conclusion, or parts that are each usable do not fit together.
    Misleading,
    /// A reader repairs it at sight.
    Misprint,
}

/// How an exhibit shows what it claims.
#[derive(Debug, Clone, Copy)]
pub enum Evidence {
    /// A smallest example, run on the spot.
    Example(fn() -> Result<Finding>),
    /// In words alone, with the reason why no safe program can show it.
    Words(&'static str),
}

/// The errata in order.
pub const ALL: &[&Exhibit] = &[
    &e01_overlapping_conditions::EXHIBIT,
    &e02_meanings_of_b::EXHIBIT,
    &e03_missing_coefficient::EXHIBIT,
    &e04_stop_test::EXHIBIT,
    &e05_no_complementarity::EXHIBIT,
    &e06_clamping_after_the_sweep::EXHIBIT,
    &e07_finite_convergence::EXHIBIT,
    &e08_pivoting::EXHIBIT,
    &e09_equality_contacts::EXHIBIT,
    &e10_semidefinite::EXHIBIT,
    &e11_no_inverse::EXHIBIT,
    &e12_warm_start::EXHIBIT,
    &e13_step_without_dt::EXHIBIT,
    &e14_velocity_level::EXHIBIT,
    &e15_shape_of_the_jacobian::EXHIBIT,
    &e16_blocks_of_the_jacobian::EXHIBIT,
    &e17_inverted_ratio::EXHIBIT,
    &e18_locked_axis::EXHIBIT,
    &e19_rows_and_freedoms::EXHIBIT,
    &e20_counting::EXHIBIT,
    &e21_position_update::EXHIBIT,
    &e22_figure_4::EXHIBIT,
    &e23_effective_mass::EXHIBIT,
    &e24_quaternion_rate::EXHIBIT,
    &e25_torque::EXHIBIT,
    &e26_gyroscopic_term::EXHIBIT,
    &e27_velocity_matrix::EXHIBIT,
    &e28_impulse_or_force::EXHIBIT,
    &e29_comment_against_code::EXHIBIT,
    &e30_signs::EXHIBIT,
    &e31_no_bounds::EXHIBIT,
    &e32_early_return::EXHIBIT,
    &e33_doubled_penalty::EXHIBIT,
    &e34_beta_without_dt::EXHIBIT,
    &e35_sign_of_feedback::EXHIBIT,
    &e36_does_not_compile::EXHIBIT,
    &e37_no_bounce::EXHIBIT,
    &e38_strict_test::EXHIBIT,
    &e39_feedback_is_no_spring::EXHIBIT,
    &e40_orientation_coordinates::EXHIBIT,
    &e41_ball_joint_arms::EXHIBIT,
    &e42_distance_row::EXHIBIT,
    &e43_owner_of_the_normal::EXHIBIT,
    &e44_sign_of_the_contact_row::EXHIBIT,
    &e45_contact_as_three_rows::EXHIBIT,
    &e46_binary_rows::EXHIBIT,
    &e47_immovable_bodies::EXHIBIT,
    &e48_action_and_reaction::EXHIBIT,
    &e49_order_of_statements::EXHIBIT,
    &e50_size_limits::EXHIBIT,
    &e51_shared_memory::EXHIBIT,
    &e52_empty_does_not_clear::EXHIBIT,
    &e53_data_column_by_column::EXHIBIT,
    &e54_stored_zeros::EXHIBIT,
    &e55_product_of_three::EXHIBIT,
    &e56_names_of_storages::EXHIBIT,
    &e57_linked_list_memory::EXHIBIT,
    &e58_unbalanced_tree::EXHIBIT,
    &e59_matrices_of_size_zero::EXHIBIT,
    &e60_labels::EXHIBIT,
    &e61_no_best_fit::EXHIBIT,
    &e62_complementarity::EXHIBIT,
    &e63_force_not_strain::EXHIBIT,
    &e64_drift::EXHIBIT,
    &e65_distance_glues::EXHIBIT,
    &e66_one_iteration_two_names::EXHIBIT,
    &e67_closer_in_which_sense::EXHIBIT,
];

/// The exhibit of this number, in either case of letters.
///
/// # Errors
/// If there is none.
pub fn named(id: &str) -> Result<&'static Exhibit> {
    let found = ALL.iter().find(|exhibit| exhibit.id.eq_ignore_ascii_case(id));
    found.copied().ok_or_else(|| Error::Unknown {
        kind: "erratum",
        name: id.to_string(),
        known: ALL.iter().map(|exhibit| exhibit.id.to_string()).collect(),
    })
}

impl Exhibit {
    /// Runs the example; a finding without measures if there is none.
    ///
    /// # Errors
    /// If the example cannot be set up.
    pub fn found(&self) -> Result<Finding> {
        match self.evidence {
            Evidence::Example(example) => example(),
            Evidence::Words(_) => Ok(Finding::default()),
        }
    }
}

impl Severity {
    /// The word of the lists.
    pub fn word(self) -> &'static str {
        match self {
            Severity::Wrong => "wrong",
            Severity::Misleading => "misleading",
            Severity::Misprint => "misprint",
        }
    }
}
