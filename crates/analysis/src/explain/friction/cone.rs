//! Friction with circular cones: the problem, its answer contact by contact, and for comparison the
//! box, whose solver can be followed.

use super::ExplainedAnswer;
use crate::explain::answer;
use crate::explain::solve::Solved;
use crate::explain::units::{headed, with_unit};
use lcplab_judge::judge_cone;
use lcplab_lcp::error::Result;
use lcplab_lcp::friction::{ConeProblem, Contact, Law};
use lcplab_lcp::number::counted;
use lcplab_page::document::notation::{interval, plain};
use lcplab_page::document::{Document, Formula, Section};
use lcplab_solver::{Solution, Status};

/// The cones with their answer, then the box for comparison; returns whether the judge accepts the
/// cones' x.
pub(in crate::explain) fn cones(
    answered: &ExplainedAnswer,
    document: &mut Document,
    cones: &ConeProblem,
) -> Result<bool> {
    answered.add(document, law(cones));
    let (section, is_accepted) = contacts(answered, cones);
    answered.add(document, section);
    let Solved { mut section, solution } = answered.solved(&answered.rows, None)?;
    section.title = format!("the coupled box for comparison, by {}", section.title);
    answered.add(document, section);
    if answered.answer.status == Status::Solved && solution.status == Status::Solved {
        answered.add(document, beside(answered, &solution));
    }
    Ok(is_accepted)
}

/// The formulation.
fn law(cones: &ConeProblem) -> Section {
    let mut section = Section::new("friction within cones");
    section.say(
        "The friction model is the circular cone: |x_t| ≤ μ x_n at each contact, in every direction. This \
         is not an LCP, because the cone is not a box. With the cone K and its dual K*, the set of all w with x·w ≥ 0 for every \
         x in K, each contact satisfies",
    );
    section.formula(Formula::default().symbols(
        "K = { x : |x_t| ≤ μ x_n },   K* = { w : w_n ≥ μ |w_t| }",
        "K = \\{ x : |x_t| \\le \\mu x_n \\}, \\qquad K^* = \\{ w : w_n \\ge \\mu |w_t| \\}",
    ));
    let (text, latex, words) = match cones.law() {
        Law::Associated => (
            "x in K,   w in K*,   x·w = 0,   w = A x + b",
            "x \\in K, \\qquad w \\in K^*, \\qquad x \\cdot w = 0, \\qquad w = A x + b",
            "This is the optimality condition of minimizing ½ xᵀAx + bᵀx over the cones, a convex problem. \
             Its disadvantage: a sliding contact lifts off with w_n = μ |w_t|.",
        ),
        Law::Coulomb => (
            "x in K,   ŵ in K*,   x·ŵ = 0,   ŵ = A x + b + μ |w_t| n",
            "x \\in K, \\qquad \\hat w \\in K^*, \\qquad x \\cdot \\hat w = 0, \\qquad \
             \\hat w = A x + b + \\mu |w_t| n",
            "μ |w_t| is added to the normal row of each contact; without it a sliding contact would \
             lift off. The result is Coulomb's law: if x_n > 0 and the contact slides, then w_n = 0 and \
             x_t = −μ x_n w_t/|w_t|.",
        ),
    };
    section.formula(Formula::default().symbols(text, latex));
    section.say(words);
    section
}

/// x and w of each contact, their meaning for the law, and the judge's verdict.
fn contacts(answered: &ExplainedAnswer, cones: &ConeProblem) -> (Section, bool) {
    let (own, reading) = (answered.answer, &answered.rows);
    let certificate = judge_cone(cones, &own.x, &answered.demand());
    let mut section = Section::new("the cones' answer");
    let how = match own.status {
        Status::Solved => "updates all rows at once, and its steps are not shown",
        _ => "found no answer",
    };
    section.say(format!(
        "{} {how}: {}, after {}.",
        answered.solver,
        own.status,
        counted(own.iterations, "iteration")
    ));
    let contacts = cones.friction().contacts();
    let [x_unit, w_unit] = contacts.first().map_or(["", ""], |contact| {
        [&reading.units.x, &reading.units.w].map(|units| units[contact.rows[0]].as_str())
    });
    let line = |contact: &Contact| {
        let ([x, x1, x2], w) = (contact.of(&own.x), contact.of(&certificate.w));
        let (friction, slip, shift) = (x1.hypot(x2), w[1].hypot(w[2]), cones.shift(contact, w));
        let [n, t1, t2] = contact.rows;
        vec![
            format!("rows {n}, {t1}, {t2}"),
            plain(x),
            format!("({}, {})", plain(x1), plain(x2)),
            format!(
                "{}, limit {}·{} = {}",
                plain(friction),
                plain(contact.mu),
                plain(x),
                plain(contact.mu * x)
            ),
            format!("{} + {} = {}", plain(w[0]), plain(shift), plain(w[0] + shift)),
            format!("({}, {})", plain(w[1]), plain(w[2])),
            plain(slip),
        ]
    };
    let columns = [
        "contact",
        &headed("x_n", x_unit),
        &headed("x_t", x_unit),
        &headed("|x_t|, limit μ x_n", x_unit),
        &headed("w_n + shift", w_unit),
        &headed("w_t", w_unit),
        &headed("|w_t|", w_unit),
    ];
    section.table("the contacts", &columns, contacts.iter().map(line).collect());
    let others = cones.friction().others().iter().map(|&i| {
        let lcp = cones.friction().lcp();
        vec![
            with_unit(&i.to_string(), &reading.labels[i]),
            with_unit(&plain(own.x[i]), &reading.units.x[i]),
            interval(lcp.lo()[i], lcp.hi()[i]),
            with_unit(&plain(certificate.w[i]), &reading.units.w[i]),
        ]
    });
    let others: Vec<_> = others.collect();
    if !others.is_empty() {
        section.table("the other rows", &["row", "x", "bounds", "w"], others);
    }
    section.say(answer::word(&certificate.verdict, certificate.scaled_residual));
    (section, certificate.verdict.is_solution())
}

/// Why the box is shown, and how far its x is from that of the cones.
fn beside(answered: &ExplainedAnswer, boxed: &Solution) -> Section {
    let mut section = Section::new("the cones and the box");
    section.say(
        "The box |x_t1| ≤ μ x_n, |x_t2| ≤ μ x_n is a different law with a different x: along its diagonal, \
         friction is √2 μ x_n, while the cone has μ x_n in every direction. The box is shown because every \
         step of its solver can be followed. Both laws agree if a contact sticks or slides along a \
         tangent, up to the distribution of load between redundant contacts. The motion of the bodies is \
         that of the cones.",
    );
    let (own, reading) = (answered.answer, &answered.rows);
    let line = |i: usize| {
        let number = |x: f64| with_unit(&plain(x), &reading.units.x[i]);
        vec![
            with_unit(&i.to_string(), &reading.labels[i]),
            number(own.x[i]),
            number(boxed.x[i]),
            number(boxed.x[i] - own.x[i]),
        ]
    };
    let columns = ["row", "x of the cones", "x of the box", "difference"];
    section.table("both answers", &columns, (0..own.x.len()).map(line).collect());
    section
}
