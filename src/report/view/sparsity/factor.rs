//! Fill of the factor by ordering.

use crate::report::page::{Cell, Mark, Table};
use crate::report::study::sparsity::factor::{Factor, Ordered};
use crate::report::view::ReportPage;

pub(super) fn show(factors: &[&Factor], document: &mut ReportPage) {
    let rows =
        factors.iter().flat_map(|factor| factor.ordered.iter().map(|own| cells(factor, own)));
    let table = Table::new(
        "Entries of the factor by ordering",
        "*A*: entries that are not 0, on and below the diagonal; the steps before are solved by Dantzig's method, because \
         the errors of an iterative solver would turn zeros into small entries. *L*: entries of the factor, including the \
         diagonal. If A is singular, as with redundant contacts, the pattern is that of a factor of \
         $A + \\varepsilon I$. *fill*: entries of L divided by those of A; the smallest value of each scene is marked. \
         *work*: multiplications of the factorization.",
        "scene | #rows | ordering | #bandwidth | #A | #L | #fill (×) | #work",
        rows.collect(),
    );
    document.table("sparsity_factors", table);
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
