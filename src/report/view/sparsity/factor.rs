//! Fill of the factor by ordering.

use crate::number::{count, readable};
use crate::plot::{Small, Spies};
use crate::report::page::{Cell, Mark, Table};
use crate::report::study::sparsity::factor::{Factor, Ordered};
use crate::report::view::Document;

pub(super) fn show(factors: &[&Factor], document: &mut Document) {
    document.text(
        "**The factor of A under three orderings.** Sweeps only read A. A direct method factors $A = L L^T$, \
         and $L$ has additional entries, the fill-in. Their number depends on the order of elimination: \
         *natural*, the order of the scene; *reverse Cuthill-McKee*, which moves entries toward the diagonal; \
         *minimum degree*, which always eliminates the row with the fewest neighbors next. If A is singular, \
         as with redundant contacts, the pattern is that of a factor of $A + \\varepsilon I$.",
    );
    let rows =
        factors.iter().flat_map(|factor| factor.ordered.iter().map(|own| cells(factor, own)));
    let table = Table::new(
        "Entries of the factor by ordering",
        "*A*: entries on and below the diagonal. *L*: entries of the factor, including the \
         diagonal. *fill*: entries of L divided by those of A; the smallest value of each scene is marked. \
         *work*: multiplications of the factorization.",
        "scene | #rows | ordering | #bandwidth | #A | #L | #fill (×) | #work",
        rows.collect(),
    );
    document.table("sparsity_factors", table);
    let panel = |(factor, own): (&&Factor, &Ordered)| Small {
        name: format!("{}, {}", factor.scene, own.ordering),
        note: format!(
            "{}\u{a0}entries, {}\u{a0}%",
            count(own.entries),
            readable(2.0 * own.picture.fill(), 3)
        ),
        raster: own.picture.clone(),
    };
    let all = factors.iter().flat_map(|factor| factor.ordered.iter().map(move |own| (factor, own)));
    document.figure(Spies {
        id: "sparsity_factor_pictures".into(),
        title: "The factor L under three orderings".into(),
        caption: "Percentages refer to the lower triangle. Darker cells are denser. Reverse Cuthill-McKee \
                  gathers the entries near the diagonal; minimum degree leaves most of the triangle empty, \
                  with the remaining fill-in in the last rows."
            .into(),
        across: 3,
        panels: all.map(panel).collect(),
    });
}

fn cells(factor: &Factor, own: &Ordered) -> Vec<Cell> {
    let least = factor.ordered.iter().map(|own| own.entries).min();
    let mark = if Some(own.entries) == least { Mark::Good } else { Mark::Plain };
    vec![
        Cell::text(&factor.scene),
        Cell::count(factor.rows),
        Cell::text(&own.ordering),
        Cell::count(own.bandwidth),
        Cell::count(factor.lower),
        Cell::count(own.entries),
        Cell::number(own.entries as f64 / factor.lower.max(1) as f64, 3).marked(mark),
        Cell::number(own.work, 3),
    ]
}
