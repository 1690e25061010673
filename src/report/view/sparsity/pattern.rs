//! J and A of one step.

use crate::plot::Spy;
use crate::report::page::markup::literal;
use crate::report::study::sparsity::pattern::Patterns;
use crate::report::view::Document;
use crate::report::view::attempt::stem;

pub(super) fn show(scenes: &[&Patterns], document: &mut Document) {
    document.text(
        "A row of $J$ has entries only for the one or two bodies it joins, and two rows of \
         $A = J M^{-1} J^T$ are coupled only if they share a moving body. The larger the scene, the sparser \
         its $A$ (the chapter's Figure 13). The work of a solver that reads only stored entries is \
         proportional to the number of contacts, not to its square.",
    );
    for scene in scenes {
        let figures = [
            ("jacobian", "J", (scene.rows, scene.columns), &scene.jacobian),
            ("matrix", "A = J M⁻¹ Jᵀ", (scene.rows, scene.rows), &scene.matrix),
        ];
        let of_problem = scene.columns == 0;
        for (kind, name, size, places) in figures.into_iter().skip(of_problem.into()) {
            let name = if of_problem { "A" } else { name };
            let id = format!("sparsity_{}_{kind}", stem(&scene.scene));
            let when = if of_problem { String::new() } else { format!(" in step {}", scene.step) };
            let title = literal(&scene.title);
            let caption = format!("{name}{when}: {title}");
            let title = format!("{name}: {}", scene.scene);
            if let Ok(spy) = Spy::new(id, title, caption, size, places.iter().copied()) {
                document.figure(spy);
            }
        }
    }
}
