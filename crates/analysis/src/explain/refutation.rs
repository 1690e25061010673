//! Explains why an LCP has no solution: a Farkas vector, with its numbers.

use dashu_ratio::RBig;

use super::answer::Reading;
use super::units::{headed, with_unit};
use lcplab_judge::ray::{Farkas, refute};
use lcplab_lcp::Lcp;
use lcplab_page::document::notation::{bracketed, interval, plain};
use lcplab_page::document::{Formula, Section};
use lcplab_solver::{Solution, Status};

/// Maximum number of rows for exact proofs.
const PROVED: usize = 150;

/// The proof that follows from a solver's ray.
pub(super) fn of(lcp: &Lcp, solution: &Solution) -> Option<Farkas> {
    match &solution.status {
        Status::Ray { row, direction } if lcp.len() <= PROVED => refute(lcp, *row, direction),
        _ => None,
    }
}

/// The proof; without a vector, the statement that all active sets were tried.
pub(super) fn section(reading: &Reading, proof: Option<&Farkas>) -> Section {
    let mut section = Section::new("why there is no solution");
    let Some(proof) = proof else {
        section.say(
            "Every choice of rows at their lower bound, at their upper bound and free was tried in exact \
             arithmetic, and none has a solution.",
        );
        return section;
    };
    section.say(
        "A solution has wᵢ ≥ 0 if xᵢ has no upper bound, and wᵢ ≤ 0 if xᵢ has no lower bound. Let d be positive \
         only in rows of the first kind and negative only in rows of the second kind. Then dᵀw ≥ 0 at every \
         solution. But dᵀw = (Aᵀd)ᵀx + bᵀd, which is negative for every x within the bounds:",
    );
    section.formula(Formula::default().symbols(
        "0 ≤ dᵀw = (Aᵀd)ᵀx + bᵀd ≤ max (Aᵀd)ᵀx + bᵀd < 0",
        "0 \\le d^T w = (A^T d)^T x + b^T d \\le \\max\\, (A^T d)^T x + b^T d < 0",
    ));
    numbers(&mut section, reading, &proof.vector);
    section
}

/// The vector, row by row, and the sum.
fn numbers(section: &mut Section, reading: &Reading, d: &[RBig]) {
    let lcp = reading.lcp;
    let product = transposed_product(lcp, d);
    let (mut most, mut last) = (0.0, 0.0);
    let mut lines = Vec::new();
    for i in (0..lcp.len()).filter(|&i| d[i] != RBig::ZERO || product[i] != 0.0) {
        let (lo, hi) = (lcp.lo()[i], lcp.hi()[i]);
        let at = if product[i] > 0.0 { hi } else { lo };
        let largest = if product[i] == 0.0 { 0.0 } else { product[i] * at };
        let d = number(&d[i]);
        let share = lcp.b()[i] * d;
        (most, last) = (most + largest, last + share);
        lines.push(vec![
            with_unit(&i.to_string(), &reading.labels[i]),
            plain(d),
            plain(product[i]),
            interval(lo, hi),
            plain(largest),
            format!("{}·{} = {}", plain(lcp.b()[i]), bracketed(d), plain(share)),
        ]);
    }
    let unit = reading.units.of_w();
    let columns =
        ["row", "d", "(Aᵀd)ᵢ", "bounds of x", "largest (Aᵀd)ᵢ xᵢ", &headed("bᵢ dᵢ", &unit)];
    section.table("the vector d in its relevant rows", &columns, lines);
    let total = most + last;
    let sum = format!("dᵀw ≤ {} + {} = {}", plain(most), bracketed(last), plain(total));
    section.say(format!(
        "The sum is {} for every x within its bounds, but a solution has dᵀw ≥ 0. Therefore no solution exists, \
         for any solver. The comparison was made in exact arithmetic.",
        with_unit(&sum, &unit)
    ));
}

/// Aᵀd, summed exactly.
fn transposed_product(lcp: &Lcp, d: &[RBig]) -> Vec<f64> {
    let mut product = vec![RBig::ZERO; lcp.len()];
    for (i, d) in d.iter().enumerate().filter(|(_, d)| **d != RBig::ZERO) {
        for (j, a) in lcp.matrix().row(i).iter() {
            product[j] += RBig::try_from(a).unwrap_or(RBig::ZERO) * d;
        }
    }
    product.iter().map(number).collect()
}

fn number(value: &RBig) -> f64 {
    value.to_f64().value()
}
