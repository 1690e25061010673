//! The errata as exhibits: the printed statement, the correct one, and an example that
//! distinguishes them.
//!
//! An exhibit compares both with a truth found in a third way: a closed form, exact arithmetic,
//! dual numbers, another method. No outcome is stored: the example runs when the exhibit is opened,
//! and [`Finding::is_shown`] reports whether the printed form failed and the corrected one was
//! right.
//!
//! ```
//! use lcplab::chapter::exhibit;
//!
//! let finding = exhibit::named("E21")?.found()?;
//! assert!(finding.is_some_and(|finding| finding.is_shown()));
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
mod e52_empty_does_not_clear;
mod e53_data_column_by_column;
mod e54_stored_zeros;
mod e56_names_of_storages;
mod e57_linked_list_memory;
mod e58_unbalanced_tree;
mod e59_matrices_of_size_zero;
mod e61_no_best_fit;
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

use std::sync::LazyLock;

use serde::Deserialize;

use super::data::{self, one_line};
use crate::error::{Error, Result};

/// A statement of the chapter that needs correction, as stored in `errata.toml`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Exhibit {
    /// Its number: `E07`.
    pub id: String,
    /// A one-line description.
    pub title: String,
    /// Where it is printed: `K&M (16)`, `K&M Code 6`.
    pub place: String,
    /// How serious it is.
    pub severity: Severity,
    /// Whether the fault may come from the scan of the text.
    #[serde(default)]
    pub may_be_scan: bool,
    /// What is printed, in our own words; plain text.
    #[serde(deserialize_with = "one_line")]
    pub printed: String,
    /// The correct statement; plain text.
    #[serde(deserialize_with = "one_line")]
    pub holds: String,
    /// The reason, in a few sentences for a student; plain text.
    #[serde(deserialize_with = "one_line")]
    pub why: String,
    /// Without an example: the reason why no safe program can show it.
    #[serde(default, deserialize_with = "one_line")]
    pub in_words: String,
}

/// The severity of a wrong statement.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Severity {
    /// Following it leads to a wrong result or a crash.
    Wrong,
    /// A reader draws a wrong conclusion, or parts that are each usable do not fit together.
    Misleading,
    /// A reader corrects it at a glance.
    Misprint,
}

/// A minimal example, run on demand.
type Example = fn() -> Result<Finding>;

/// The examples, by erratum.
const EXAMPLES: &[(&str, Example)] = &[
    ("E01", e01_overlapping_conditions::example),
    ("E02", e02_meanings_of_b::example),
    ("E03", e03_missing_coefficient::example),
    ("E04", e04_stop_test::example),
    ("E05", e05_no_complementarity::example),
    ("E06", e06_clamping_after_the_sweep::example),
    ("E07", e07_finite_convergence::example),
    ("E08", e08_pivoting::example),
    ("E09", e09_equality_contacts::example),
    ("E10", e10_semidefinite::example),
    ("E11", e11_no_inverse::example),
    ("E12", e12_warm_start::example),
    ("E13", e13_step_without_dt::example),
    ("E14", e14_velocity_level::example),
    ("E15", e15_shape_of_the_jacobian::example),
    ("E16", e16_blocks_of_the_jacobian::example),
    ("E17", e17_inverted_ratio::example),
    ("E18", e18_locked_axis::example),
    ("E19", e19_rows_and_freedoms::example),
    ("E20", e20_counting::example),
    ("E21", e21_position_update::example),
    ("E22", e22_figure_4::example),
    ("E23", e23_effective_mass::example),
    ("E24", e24_quaternion_rate::example),
    ("E25", e25_torque::example),
    ("E26", e26_gyroscopic_term::example),
    ("E27", e27_velocity_matrix::example),
    ("E28", e28_impulse_or_force::example),
    ("E29", e29_comment_against_code::example),
    ("E30", e30_signs::example),
    ("E31", e31_no_bounds::example),
    ("E32", e32_early_return::example),
    ("E33", e33_doubled_penalty::example),
    ("E34", e34_beta_without_dt::example),
    ("E35", e35_sign_of_feedback::example),
    ("E37", e37_no_bounce::example),
    ("E38", e38_strict_test::example),
    ("E39", e39_feedback_is_no_spring::example),
    ("E40", e40_orientation_coordinates::example),
    ("E41", e41_ball_joint_arms::example),
    ("E42", e42_distance_row::example),
    ("E43", e43_owner_of_the_normal::example),
    ("E44", e44_sign_of_the_contact_row::example),
    ("E45", e45_contact_as_three_rows::example),
    ("E46", e46_binary_rows::example),
    ("E47", e47_immovable_bodies::example),
    ("E48", e48_action_and_reaction::example),
    ("E49", e49_order_of_statements::example),
    ("E50", e50_size_limits::example),
    ("E52", e52_empty_does_not_clear::example),
    ("E53", e53_data_column_by_column::example),
    ("E54", e54_stored_zeros::example),
    ("E56", e56_names_of_storages::example),
    ("E57", e57_linked_list_memory::example),
    ("E58", e58_unbalanced_tree::example),
    ("E59", e59_matrices_of_size_zero::example),
    ("E61", e61_no_best_fit::example),
    ("E63", e63_force_not_strain::example),
    ("E64", e64_drift::example),
    ("E65", e65_distance_glues::example),
    ("E66", e66_one_iteration_two_names::example),
    ("E67", e67_closer_in_which_sense::example),
];

/// The errata in order.
pub fn all() -> &'static [Exhibit] {
    static ALL: LazyLock<Vec<Exhibit>> =
        LazyLock::new(|| data::list("errata.toml", include_str!("../errata.toml")));
    &ALL
}

/// The exhibit with this number, in upper or lower case.
///
/// # Errors
/// If there is no such exhibit.
pub fn named(id: &str) -> Result<&'static Exhibit> {
    let found = all().iter().find(|exhibit| exhibit.id.eq_ignore_ascii_case(id));
    found.ok_or_else(|| Error::Unknown {
        kind: "erratum",
        name: id.to_string(),
        known: all().iter().map(|exhibit| exhibit.id.clone()).collect(),
    })
}

impl Exhibit {
    /// Runs the example, if there is one.
    ///
    /// # Errors
    /// If the example cannot be set up.
    pub fn found(&self) -> Result<Option<Finding>> {
        let example = EXAMPLES.iter().find(|(id, _)| *id == self.id);
        example.map(|(_, example)| example()).transpose()
    }
}

impl Severity {
    /// The word used in lists.
    pub fn word(self) -> &'static str {
        match self {
            Severity::Wrong => "wrong",
            Severity::Misleading => "misleading",
            Severity::Misprint => "misprint",
        }
    }
}
