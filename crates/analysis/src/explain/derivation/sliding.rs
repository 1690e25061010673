//! Contacts that slide at acceleration level: their friction is substituted for the unknown.

use lcplab_mechanics::formulation::{Problem, Slide};
use lcplab_mechanics::scene::Scene;
use lcplab_page::document::notation::{indexed, plain, vector};
use lcplab_page::document::{Formula, Section};

/// x_t = −μ x_n v_t/|v_t| with numbers, and the matrix S that contains it.
pub(super) fn substitution(section: &mut Section, scene: &Scene, problem: &Problem) {
    section.say(format!(
        "Contacts that slip faster than {} m/s are sliding, and Coulomb's law gives their friction: \
         x_t = −μ x_n v_t/|v_t|. It is not an unknown. The forces on the bodies are S x, where x of such a \
         friction row is fixed at 0.",
        plain(scene.contact.sticking_speed)
    ));
    let lines = problem.slides.iter().map(|slide| line(problem, slide)).collect();
    let columns = ["contact", "friction rows", "slip v_t (m/s)", "|v_t| (m/s)", "friction (N)"];
    section.table("sliding contacts", &columns, lines);
    let n = problem.lcp.len();
    let entry = |i: usize, j: usize| {
        let slides = problem.slides.iter().filter(|slide| slide.normal == j);
        let mut drag = slides.flat_map(|slide| &slide.drag);
        let part = drag.find(|(t, _)| *t == i).map_or(0.0, |(_, part)| *part);
        if i == j { 1.0 } else { part }
    };
    section.formula(Formula::default().symbols("S =", "S =").matrix(n, n, entry));
}

fn line(problem: &Problem, slide: &Slide) -> Vec<String> {
    let rows: Vec<usize> = slide.drag.iter().map(|(t, _)| *t).collect();
    let slip: Vec<f64> = rows.iter().map(|&t| problem.assembly.rows[t].velocity).collect();
    let speed = slip.iter().map(|v| v * v).sum::<f64>().sqrt();
    let normal = indexed("x", slide.normal);
    let friction = slide.drag.iter().map(|(_, part)| format!("{} {normal}", plain(*part)));
    vec![
        format!("row {}", slide.normal),
        rows.iter().map(usize::to_string).collect::<Vec<_>>().join(", "),
        vector(&slip),
        plain(speed),
        friction.collect::<Vec<_>>().join(", "),
    ]
}
