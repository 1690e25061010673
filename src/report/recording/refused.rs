//! The first answer that the judge rejected, and the proof of a step without solution.

use std::fmt;

use serde_json::{Value, json};

use crate::judge::FrictionCertificate;
use crate::lcp::file::number;
use crate::number::readable;
use crate::scene::Scene;
use crate::simulation::{Cause, Solve};

/// An answer that the judge rejected.
#[derive(Debug, Clone)]
pub(super) struct Refused {
    step: usize,
    stage: &'static str,
    row: String,
    residual: f64,
    solver: String,
    status: String,
}

impl Refused {
    pub(super) fn of(
        scene: &Scene,
        step: usize,
        solve: &Solve,
        certificate: &FrictionCertificate,
    ) -> Self {
        Refused {
            step,
            stage: solve.problem.stage.name(),
            row: solve.problem.assembly.rows[certificate.worst_row].label(scene),
            residual: certificate.scaled_residual,
            solver: solve.solver.clone(),
            status: solve.solution.status.to_string(),
        }
    }

    pub(super) fn to_json(&self) -> Value {
        json!({
            "step": self.step, "stage": self.stage, "row": self.row, "solver": self.solver,
            "residual": number(self.residual), "status": self.status,
        })
    }
}

impl fmt::Display for Refused {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Refused { step, stage, row, residual, solver, status } = self;
        write!(
            f,
            "first in step {step}, {stage} stage, row {row:?}: residual {}, ",
            readable(*residual, 2)
        )?;
        match solver.as_str() {
            "none" => write!(f, "{status}"),
            solver => write!(f, "{solver}: {status}"),
        }
    }
}

/// The certificate of a step without solution: the row, and the exact vector d whose dᵀw cannot
/// satisfy the bounds; `None` if all active sets were tried instead.
pub(super) fn proof(cause: &Cause) -> Option<Value> {
    let Cause::NoSolution { row, proof } = cause else { return None };
    let vector = proof
        .as_ref()
        .map(|farkas| farkas.vector.iter().map(ToString::to_string).collect::<Vec<_>>());
    Some(json!({ "kind": "no_solution", "row": row, "farkas": vector }))
}
