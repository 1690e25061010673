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
mod counting;
mod e01_overlapping_conditions;
mod e03_missing_coefficient;
mod e04_stop_test;
mod e05_no_complementarity;
mod e06_clamping_after_the_sweep;
mod e07_finite_convergence;
mod e10_semidefinite;
mod e12_warm_start;
mod e14_velocity_level;
mod e21_position_update;
mod e23_effective_mass;
mod e26_gyroscopic_term;
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
mod e43_owner_of_the_normal;
mod e45_contact_as_three_rows;
mod e47_immovable_bodies;
mod e48_action_and_reaction;
mod e49_order_of_statements;
mod e56_names_of_storages;
mod e57_linked_list_memory;
mod e58_unbalanced_tree;
mod e61_no_best_fit;
mod e64_drift;
mod e65_distance_glues;
mod e66_one_iteration_two_names;
mod e67_closer_in_which_sense;
mod finding;
mod jacobian_rows;
mod jacobian_shape;
mod map_matrix;
mod matrix_sizes;
mod rate;
mod rotation;
mod setting;
mod show;
mod signs;
mod solving;
mod units;

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
    /// What is printed, in our own words; its formulas are LaTeX.
    #[serde(deserialize_with = "one_line")]
    pub printed: String,
    /// The correct statement; its formulas are LaTeX.
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
    ("E02", signs::meanings_of_b),
    ("E03", e03_missing_coefficient::example),
    ("E04", e04_stop_test::example),
    ("E05", e05_no_complementarity::example),
    ("E06", e06_clamping_after_the_sweep::example),
    ("E07", e07_finite_convergence::example),
    ("E08", solving::pivoting),
    ("E09", solving::equality_contacts),
    ("E10", e10_semidefinite::example),
    ("E11", solving::no_inverse),
    ("E12", e12_warm_start::example),
    ("E13", units::step_without_dt),
    ("E14", e14_velocity_level::example),
    ("E15", jacobian_shape::shape_of_the_jacobian),
    ("E16", jacobian_shape::blocks_of_the_jacobian),
    ("E17", jacobian_rows::inverted_ratio),
    ("E18", signs::locked_axis),
    ("E19", counting::rows_and_degrees_of_freedom),
    ("E20", counting::equations_and_state),
    ("E21", e21_position_update::example),
    ("E22", signs::figure_4),
    ("E23", e23_effective_mass::example),
    ("E24", rotation::quaternion_rate),
    ("E25", rotation::torque),
    ("E26", e26_gyroscopic_term::example),
    ("E27", jacobian_shape::velocity_matrix),
    ("E28", units::impulse_or_force),
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
    ("E41", jacobian_rows::ball_joint_arms),
    ("E42", jacobian_shape::distance_row),
    ("E43", e43_owner_of_the_normal::example),
    ("E44", jacobian_rows::sign_of_the_contact_row),
    ("E45", e45_contact_as_three_rows::example),
    ("E46", jacobian_rows::binary_rows),
    ("E47", e47_immovable_bodies::example),
    ("E48", e48_action_and_reaction::example),
    ("E49", e49_order_of_statements::example),
    ("E50", matrix_sizes::size_limits),
    ("E52", map_matrix::empty_does_not_clear),
    ("E53", map_matrix::data_column_by_column),
    ("E54", map_matrix::stored_zeros),
    ("E56", e56_names_of_storages::example),
    ("E57", e57_linked_list_memory::example),
    ("E58", e58_unbalanced_tree::example),
    ("E59", matrix_sizes::matrices_of_size_zero),
    ("E61", e61_no_best_fit::example),
    ("E63", units::force_not_strain),
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
    pub(crate) fn word(self) -> &'static str {
        match self {
            Severity::Wrong => "wrong",
            Severity::Misleading => "misleading",
            Severity::Misprint => "misprint",
        }
    }
}
