//! Counts the claims and verdicts of many answers: of trials, and of the steps of a simulation.

use serde::{Deserialize, Serialize};

#[cfg(feature = "mechanics")]
use lcplab_judge::Demand;
use lcplab_judge::FrictionCertificate;
#[cfg(feature = "mechanics")]
use lcplab_mechanics::simulation::{Solve, Step};
use lcplab_solver::{Solution, Status};

/// The claims and verdicts of many answers.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub struct Tally {
    /// LCPs solved.
    pub solves: usize,
    /// LCPs that the solver claims to have solved.
    pub claimed: usize,
    /// LCPs whose answer the judge accepts.
    pub accepted: usize,
    /// Claims that the judge refutes: this must be 0.
    pub rejected_claims: usize,
    /// LCPs that the solver is not made for, and says so.
    #[serde(default, skip_serializing_if = "crate::number::is_zero")]
    pub outside: usize,
    /// LCPs without any answer: the solver crashed or wrote something unreadable.
    #[serde(default, skip_serializing_if = "crate::number::is_zero")]
    pub unanswered: usize,
    /// Sweeps or pivots in all.
    pub iterations: usize,
    /// The worst scaled residual of all answers, claimed or not; infinite where one is no number.
    #[serde(with = "crate::number::always")]
    pub worst_residual: f64,
    /// The largest number of rows of an LCP.
    pub rows: usize,
    /// Why the run ended early, or the last status that was not solved.
    pub trouble: Option<String>,
    /// The last status that was not solved.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub unsolved: Option<String>,
}

impl Tally {
    /// The answers that the judge rejects.
    pub fn rejected(&self) -> usize {
        self.solves - self.accepted
    }

    /// Adds the solves of a step, each judged by this tolerance without a proof; `note` receives
    /// each with its certificate.
    #[cfg(feature = "mechanics")]
    pub fn add_step(
        &mut self,
        step: &Step,
        tolerance: f64,
        mut note: impl FnMut(&Solve, &FrictionCertificate),
    ) {
        let place = format!("step {}: ", step.number);
        for solve in &step.solves {
            let certificate = solve.judged(&Demand { tolerance, prove_up_to: 0 });
            self.add(solve.problem.lcp.len(), &solve.solution, &certificate, &place);
            note(solve, &certificate);
        }
    }

    /// Adds an answer to a problem of this number of rows and the judge's verdict on it; `place`
    /// precedes the status of one that is not solved.
    pub fn add(
        &mut self,
        rows: usize,
        solution: &Solution,
        certificate: &FrictionCertificate,
        place: &str,
    ) {
        let claims = solution.status == Status::Solved;
        let is_answered = !matches!(solution.status, Status::NoAnswer { .. });
        // Without an answer, x is the start.
        let holds = is_answered && certificate.verdict.is_solution();
        self.solves += 1;
        self.claimed += usize::from(claims);
        self.accepted += usize::from(holds);
        self.rejected_claims += usize::from(claims && !holds);
        self.outside += usize::from(matches!(solution.status, Status::OutsideClass { .. }));
        self.unanswered += usize::from(!is_answered);
        self.iterations = self.iterations.saturating_add(solution.iterations);
        let residual = certificate.scaled_residual;
        let residual = if residual.is_nan() { f64::INFINITY } else { residual };
        self.worst_residual = self.worst_residual.max(residual);
        self.rows = self.rows.max(rows);
        if !claims {
            let status = solution.status.to_string();
            self.trouble = Some(format!("{place}{status}"));
            self.unsolved = Some(status);
        }
    }
}
