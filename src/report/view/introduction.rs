//! The first and the last words of a report.

use super::Document;
use crate::plot::number::significant;
use crate::report::results::Results;

pub(super) fn problem(document: &mut Document, results: &Results) {
    document.open("problem", "The problem, and who says that it is solved");
    document.text(
        "Whether bodies rest, slide, bounce or hang on each other, a time step ends in the same \
         problem: find the impulses or forces $x$ so that no row of constraints is violated and \
         none is pushed where it need not be.",
    );
    document.equation(
        "w = A x + b, \\quad lo \\le x \\le hi, \\quad w_i > 0 \\Rightarrow x_i = lo_i, \
         \\quad w_i < 0 \\Rightarrow x_i = hi_i",
        "K&M 1",
    );
    document.text(
        "A contact has the bounds 0 and $\\infty$: it pushes ($x > 0$) or its bodies part ($w > 0$), \
         never both. A joint has no bounds, so $w = 0$. A friction row has the bounds \
         $\\pm\\mu x_n$. The matrix is $A = J M^{-1} J^T$; it is singular where contacts are \
         redundant.",
    );
    document.text(
        "The *judge* recomputes $w$ from $x$ in twice the working precision and measures each row \
         by the sizes of its own terms, so that neither units nor masses matter:",
    );
    document.equation(
        "r_i = \\frac{|x_i - \\Pi(x_i - w_i / s_i)|\\; s_i}{\\sum_j |a_{ij} x_j| + |b_i|}, \
         \\qquad s_i = |a_{ii}|",
        "scaled residual",
    );
    let tolerance = results.comparisons.first().map_or(1e-8, |c| c.tolerance);
    document.text(format!(
        "An answer is *within tolerance* if the largest $r_i$ is at most {}. It is *proved* if, on \
         top of that, the rows it holds at their bounds were shown in exact rational arithmetic to \
         carry a solution. Anything else is *not a solution*. The columns headed “claims” are the \
         solvers' own words, those headed “accepted” are the judge's.",
        significant(tolerance, 1)
    ));
}

pub(super) fn limits(document: &mut Document) {
    document.open("limits", "What this report does not show");
    document.text(
        "- Times of single runs on a shared machine say little: they are for orders of magnitude, \
         not for ranking.\n\
         - The scenes are small. How solvers scale to thousands of contacts is another report.\n\
         - Friction in the scenes is the box model: each tangent is bounded on its own, so a diagonal slip \
         is resisted by up to $\\sqrt{2}$ times too much.\n\
         - Energy plots mix the errors of the integrator, of the formulation and of the constraint \
         stabilisation. Each curve says which step and level it belongs to, not which part of the \
         error is whose.\n\
         - The reference solutions come from one other code, an interior-point method. It agrees to \
         about the root of its duality gap, which is why its own verdicts use a looser tolerance.",
    );
}

pub(super) fn facts(results: &Results) -> Vec<(String, String)> {
    vec![
        ("lcplab".into(), results.version.clone()),
        ("libraries".into(), results.libraries.join(", ")),
        ("report".into(), results.experiment.name.clone()),
        ("platform".into(), results.machine.platform.clone()),
        ("threads".into(), results.machine.threads.to_string()),
        ("wall time".into(), format!("{:.1} s", results.machine.seconds)),
        ("reproduce".into(), format!("lcplab report {}", results.experiment.name)),
    ]
}
