//! The units of a step's rows and columns.

use super::units::Units;
use lcplab_mechanics::formulation::{Problem, Stage};

impl Units {
    /// The units of a step's problem.
    pub fn of(problem: &Problem) -> Self {
        let rows = &problem.assembly.rows;
        let x = rows.iter().map(|row| problem.stage.unit(row.kind.is_angular()).to_string());
        Units::from_x(x.collect())
    }
}

/// The unit of motion of a stage's columns, some of which may be angular.
pub(super) fn of_motion(stage: Stage, has_angular: bool) -> &'static str {
    match (stage, has_angular) {
        (Stage::Acceleration, false) => "m/s²",
        (Stage::Acceleration, true) => "m/s² or rad/s²",
        (Stage::Position, false) => "m",
        (Stage::Position, true) => "m or rad",
        (_, false) => "m/s",
        (_, true) => "m/s or rad/s",
    }
}
