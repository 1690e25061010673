//! Where J and A have entries.

use super::attempt::stem;
use super::{Document, Outcome, View};
use crate::plot::Spy;
use crate::report::study::sparsity::{Patterns, Plan};

impl View for Plan {
    const TITLE: &'static str = "Why the matrices are mostly empty";

    fn show(&self, findings: &[Patterns], document: &mut Document) {
        document.text(
            "A row of $J$ has entries only for the one or two bodies it joins, and two rows of \
             $A = J M^{-1} J^T$ feel each other only if they share a moving body. The larger the scene, \
             the emptier its $A$ (the chapter's Figure 13); a solver that touches stored entries only \
             does work in proportion to the contacts, not to their square.",
        );
        for scene in findings {
            let figures = [
                ("jacobian", "J", (scene.rows, scene.columns), &scene.jacobian),
                ("matrix", "A = J M⁻¹ Jᵀ", (scene.rows, scene.rows), &scene.matrix),
            ];
            let of_problem = scene.columns == 0;
            for (kind, name, size, places) in figures.into_iter().skip(of_problem.into()) {
                let name = if of_problem { "A" } else { name };
                let id = format!("sparsity_{}_{kind}", stem(&scene.scene));
                let when =
                    if of_problem { String::new() } else { format!(" in step {}", scene.step) };
                let title = crate::report::page::markup::literal(&scene.title);
                let caption = format!("{name}{when}: {title}");
                let title = format!("{name}: {}", scene.scene);
                if let Ok(spy) = Spy::new(id, title, caption, size, places.iter().copied()) {
                    document.figure(spy);
                }
            }
        }
    }

    fn outcome(&self, _: &[Patterns]) -> Outcome {
        Outcome::undecided()
    }
}
