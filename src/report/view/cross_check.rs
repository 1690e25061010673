//! Our answers compared with two independent ones.

use super::{Headline, Outcome, ReportPage, View};
use crate::judge::cross_check::max_difference;
use crate::number::significant;
use crate::report::page::{Cell, Mark, Table};
use crate::report::study::cross_check::{CrossCheck, Plan, Wrench};

const DERIVATION: &str = r"
With friction, the friction limits of the box QP are fixed at those of lcplab's $x$:

$$\min_{lo \le x \le hi}\; \tfrac12 x^T A x + b^T x$$

Gauss's principle:

$$\min_u\; \tfrac12 (u - u^*)^T M (u - u^*)$$

subject to $J u + \text{bias} \ge 0$ ($= 0$ for joints). A friction row with the fixed limits $\pm h_i$ has no such
constraint; it adds the term $h_i |(J u + \text{bias})_i|$ to the objective.

The two optimal values must have the same size and opposite signs. If contacts are redundant, $x$ is not unique: the rank of
$A$ on the free rows (those with $w = 0$) is less than their number, and $x$ may differ while $w$ and the motion $u$ agree.
In this case lcplab bounds the distance of its motion from the exact motion $\hat u$, instead of the distance between
two $x$. For any feasible $u$ and $x$, with the objective $P(u)$ above and $D(x) = \tfrac12 x^T A x + b^T x$,

$$|u - \hat u|_M \le \sqrt{2\,(P(u) + D(x))}.$$
";

impl View for Plan {
    const TITLE: &'static str = "Cross-check with clarabel";

    fn show(&self, findings: &[Vec<CrossCheck>], document: &mut ReportPage) {
        let checks = &findings.concat();
        document.text(format!(
            "**{}.** Dantzig's answer is compared with two independent answers of the interior-point solver clarabel: to \
             the *box QP*, the LCP as a minimization over impulses, and to *Gauss's principle*, which determines the \
             same motion as a minimization over velocities. The second never forms $A$, so it also checks the assembly of $A$.",
            self.outcome(findings).says
        ));
        document
            .aside("The two minimizations, and the bound on the error of the motion", DERIVATION);
        document.table("cross_checks", table(checks));
        let failures = checks.iter().filter_map(|check| {
            let why = check.reference_failure.as_ref()?;
            Some(format!("- {}, {}: {why}", check.scene, check.stage))
        });
        let failures: Vec<String> = failures.collect();
        if !failures.is_empty() {
            let lead = "Answers of clarabel that the judge rejects, so that they confirm nothing:";
            document.text(format!("{lead}\n\n{}", failures.join("\n")));
        }
        document.table("objectives", objectives(checks));
        if checks.iter().any(|check| !check.wrenches.is_empty()) {
            document.text(
                "If the load distribution is not unique, individual forces have no meaning. The net force and \
                 torque on each body are unique, and both answers must agree on them.",
            );
            document.table("wrenches", wrenches(checks));
        }
    }

    fn headline(&self, findings: &[Vec<CrossCheck>]) -> Headline {
        let ([_, _, both, all], apart) = counts(findings);
        let label = format!(
            "answers accepted, those of clarabel too; their velocities differ by at most {apart} m/s"
        );
        Headline { result: Some(([both, all], label)), ..Headline::default() }
    }

    fn outcome(&self, findings: &[Vec<CrossCheck>]) -> Outcome {
        let ([accepted, confirmed, _, all], apart) = counts(findings);
        let says = format!(
            "The judge accepts {accepted} of {all} answers of lcplab and {confirmed} of {all} of clarabel; their velocities \
             differ by at most {apart} m/s"
        );
        Outcome { good: accepted == all && confirmed == all, says }
    }
}

/// The accepted answers of lcplab, those of clarabel, the cases where both are, and all; the
/// largest difference of velocities.
fn counts(findings: &[Vec<CrossCheck>]) -> ([usize; 4], String) {
    let checks = || findings.iter().flatten();
    let ours = |check: &&CrossCheck| ["proved", "within_tolerance"].contains(&&*check.verdict);
    let theirs = |check: &&CrossCheck| check.reference_failure.is_none();
    let both = checks().filter(ours).filter(theirs).count();
    let apart = checks().map(|check| check.u_difference).fold(0.0, f64::max);
    let counts =
        [checks().filter(ours).count(), checks().filter(theirs).count(), both, checks().count()];
    (counts, significant(apart, 2))
}

fn table(checks: &[CrossCheck]) -> Table {
    Table::new(
        "Differences from the reference solutions",
        "Largest difference of any entry. *not unique*: several x are solutions, so x − x_QP is not an error. *verdict*: \
         an answer is *within tolerance*, but not *proved*, if lcplab finds no exact solution near it, as can happen if rows are \
         redundant only up to rounding, or if there are more than 50 rows, for which no proof is attempted. *verdict on QP*: \
         the verdict on clarabel's answer to the box QP, without an attempt of a proof. *u − û at most*: a proved bound on the error of lcplab's motion, from duality and interval arithmetic. With friction, the bound holds for the problem \
         whose friction limits are fixed at those of lcplab's x, not for the coupled problem. The unit of each difference is that \
         of the quantity: N s, m/s and m/s (at acceleration level N, m/s² and m/s²; for rotations N m s, rad/s and so on).",
        "scene | problem | #step | #rows | #free | #rank | solution x | #x − x_QP | #w − w_QP | \
         #u − u_Gauss | #u − û at most | verdict | verdict on QP",
        checks.iter().map(cells).collect(),
    )
}

fn cells(check: &CrossCheck) -> Vec<Cell> {
    let rows = if check.rank == check.free { "unique" } else { "not unique" };
    vec![
        Cell::text(&check.scene),
        Cell::text(&check.stage),
        Cell::count(check.step),
        Cell::count(check.rows),
        Cell::count(check.free),
        Cell::count(check.rank),
        Cell::text(rows),
        Cell::number(check.x_difference, 2),
        Cell::number(check.w_difference, 2),
        Cell::number(check.u_difference, 2),
        bound(check),
        verdict(&check.verdict),
        verdict(&check.reference_verdict),
    ]
}

/// The verified bound, or why there is none.
fn bound(check: &CrossCheck) -> Cell {
    match (check.u_bound, &check.u_unproved) {
        (Some(bound), _) => Cell::number(bound, 2),
        (None, why) => Cell::text(why.as_deref().unwrap_or("not computed")),
    }
}

fn verdict(word: &str) -> Cell {
    let mark = if word == "not_a_solution" { Mark::Bad } else { Mark::Good };
    Cell::text(word.replace('_', " ")).marked(mark)
}

fn objectives(checks: &[CrossCheck]) -> Table {
    let cells = |check: &CrossCheck| {
        vec![
            Cell::text(&check.scene),
            Cell::text(&check.stage),
            Cell::number(check.objective, 10),
            Cell::number(check.dual_objective, 10),
            Cell::number(check.primal_objective, 10),
        ]
    };
    Table::new(
        "The optimal value, computed in three ways",
        "½ xᵀAx + bᵀx at lcplab's x, the box QP's optimum, and minus the optimum of \
                      Gauss's principle. All three should agree. The unit is J at velocity level, J/s² at acceleration \
                      level.",
        "scene | problem | #at lcplab's x | #box QP | #− Gauss",
        checks.iter().map(cells).collect(),
    )
}

fn wrenches(checks: &[CrossCheck]) -> Table {
    let cells = |check: &CrossCheck, wrench: &Wrench| {
        let vector = |v: &[f64]| {
            let entries: Vec<String> = v.iter().map(|&v| significant(rounded(v), 4)).collect();
            Cell::text(format!("({})", entries.join(", ")))
        };
        let half = 3.min(wrench.ours.len());
        vec![
            Cell::text(&check.scene),
            Cell::text(&check.stage),
            Cell::text(&wrench.body),
            vector(&wrench.ours[..half]),
            vector(&wrench.ours[half..]),
            Cell::number(max_difference(&wrench.ours, &wrench.reference), 2),
        ]
    };
    let rows = checks
        .iter()
        .flat_map(|check| check.wrenches.iter().map(move |wrench| cells(check, wrench)));
    Table::new(
        "Net force and torque on each body",
        "Sum over all rows, about the center of mass; the last column is the largest difference \
         from the answer of the box QP.",
        "scene | problem | body | force | torque | #difference",
        rows.collect(),
    )
}

/// The value, or 0 if it is only rounding relative to the forces of a body.
fn rounded(value: f64) -> f64 {
    if value.abs() < 1e-12 { 0.0 } else { value }
}
