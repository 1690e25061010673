//! Friction with polygons: the LCP of Stewart & Trinkle, written down and solved by Lemke's method.

use super::ExplainedAnswer;
use crate::explain::answer::{self, Reading};
use crate::explain::refutation;
use crate::explain::solve::Solved;
use crate::explain::statement;
use crate::explain::units::with_unit;
use lcplab_judge::judge_friction;
use lcplab_lcp::error::Result;
use lcplab_lcp::friction::{Polyhedral, ProblemForm};
use lcplab_page::document::notation::{indexed, plain};
use lcplab_page::document::{Document, Formula, Section};
use lcplab_solver::Solution;

/// The LCP of the polygons, its solution, and the corresponding x; returns whether the judge
/// accepts x.
pub(in crate::explain) fn polygons(
    answered: &ExplainedAnswer,
    document: &mut Document,
    polygons: &Polyhedral,
) -> Result<bool> {
    let own = answered.answer;
    let reading = reading(polygons, &answered.rows);
    answered.add(document, law(polygons, &reading));
    answered.add(document, statement::statement(reading.lcp, &reading.units));
    let start = answered.start.map(|x| polygons.z(x));
    let Solved { section, solution } = answered.solved(&reading, start.as_deref())?;
    answered.add(document, section);
    let found = polygons.x(&solution.x) == own.x;
    let z = if found { solution.x.clone() } else { polygons.z(&own.x) };
    let shown = Solution { x: z, ..solution.clone() };
    let (section, _) = answer::section(&reading, &shown, &answered.demand());
    answered.add(document, section);
    if let Some(proof) = refutation::of(reading.lcp, &solution) {
        answered.add(document, refutation::section(&reading, Some(&proof)));
    }
    let (mut section, is_accepted) = impulses(answered, polygons);
    if !found {
        section.say(format!(
            "{} obtained this x by another method: {}{}.",
            answered.solver,
            own.status,
            own.fallback.map_or(String::new(), |fallback| format!(", by {fallback}"))
        ));
    }
    answered.add(document, section);
    Ok(is_accepted)
}

/// The formulation in symbols, and the meaning of each unknown.
fn law(polygons: &Polyhedral, reading: &Reading) -> Section {
    let k = polygons.directions();
    let mut section = Section::new("friction within polygons");
    section.say(format!(
        "The friction model is the polyhedral cone of Stewart and Trinkle. The friction of each contact is \
         a sum over {k} directions d, {}° apart, the first one along its row t1, with β ≥ 0 along each; \
         the sum of all β is at most μ x_n. γ is the sliding speed of the contact. D has the directions as \
         columns, and E has a column of ones for each contact.",
        plain(360.0 / k as f64)
    ));
    for [text, latex] in [
        ["w_n = A_nn x_n + A_nD β + b_n", "w_n = A_{nn} x_n + A_{nD} \\beta + b_n"],
        [
            "w_β = A_Dn x_n + A_DD β + E γ + Dᵀb_t",
            "w_\\beta = A_{Dn} x_n + A_{DD} \\beta + E \\gamma + D^T b_t",
        ],
        ["w_γ = μ x_n − Eᵀβ", "w_\\gamma = \\mu x_n - E^T \\beta"],
    ] {
        section.formula(Formula::default().symbols(text, latex));
    }
    section.say(
        "x_n, β, γ and their w are ≥ 0, and one of each pair is 0. Because w_β ≥ 0, the contact does not \
         slip against any direction d faster than γ, and friction acts only along directions in which it \
         slips at the speed γ. Because γ w_γ = 0, it slides only if friction has its full strength μ x_n. \
         The zeros on the diagonal and the sign of Eᵀ make A unsymmetric. From here on x, w, A and b are \
         those of this LCP.",
    );
    let line = |i: usize| {
        vec![
            indexed("x", i),
            reading.labels[i].clone(),
            reading.units.x[i].clone(),
            reading.units.w[i].clone(),
        ]
    };
    let columns = ["unknown", "what it is", "unit of x", "unit of w"];
    section.table("the unknowns", &columns, (0..reading.lcp.len()).map(line).collect());
    section
}

/// The LCP with the meaning of its unknowns: those of other rows, x_n, β and γ of each contact.
/// `units` are those of the rows.
fn reading<'a>(polygons: &'a Polyhedral, rows: &Reading) -> Reading<'a> {
    let is_again = rows.is_again;
    let friction = polygons.friction();
    let k = polygons.directions();
    let rubbing = || friction.contacts().iter().filter(|contact| contact.mu > 0.0);
    let others = friction.others().iter().map(|i| format!("x of row {i}"));
    let normals =
        friction.contacts().iter().map(|contact| format!("x_n of row {}", contact.rows[0]));
    let angle = |j: usize| plain(360.0 * j as f64 / k as f64);
    let beta = |n: usize, j: usize| format!("β at {}° of row {n}", angle(j));
    let betas = rubbing().flat_map(|contact| (0..k).map(move |j| beta(contact.rows[0], j)));
    let gammas = rubbing().map(|contact| format!("γ of row {}", contact.rows[0]));
    let labels: Vec<String> = others.chain(normals).chain(betas).chain(gammas).collect();
    let speeds = labels.len() - rubbing().count()..labels.len();
    let units = {
        let of: Vec<usize> = (0..labels.len()).map(|unknown| polygons.row(unknown)).collect();
        rows.units.of_polygons(&of, speeds)
    };
    Reading { lcp: polygons.lcp(), labels, units, is_again }
}

/// x = D β, and the judge's verdict on it.
fn impulses(answered: &ExplainedAnswer, polygons: &Polyhedral) -> (Section, bool) {
    let own = answered.answer;
    let posed = ProblemForm::Polyhedral(polygons.clone());
    let certificate = judge_friction(&posed, &own.x, &answered.demand());
    let rows = &answered.rows;
    let mut section = Section::new("back to the rows");
    section.say("In the rows n, t1, t2 of a contact, x_t = D β.");
    let line = |i: usize| {
        vec![
            with_unit(&i.to_string(), &rows.labels[i]),
            with_unit(&plain(own.x[i]), &rows.units.x[i]),
            with_unit(&plain(certificate.w[i]), &rows.units.w[i]),
        ]
    };
    section.table("x and w of the rows", &["row", "x", "w"], (0..own.x.len()).map(line).collect());
    section.say(answer::word(&certificate.verdict, certificate.scaled_residual));
    (section, certificate.verdict.is_solution())
}
