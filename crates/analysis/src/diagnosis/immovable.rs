//! Finds rows that hardly any impulse can move.
//!
//! A diagonal entry a_ii is the change of w_i from an impulse of 1: an inverse effective mass. A
//! row whose a_ii is far below those of all other rows, or far below that of any realistic mass,
//! needs an impulse b_i/a_ii that no solver can be expected to return. Units alone are not a
//! problem: they multiply a_ii by s² and b_i by s, and do not change b_i²/a_ii, twice the energy
//! that the row alone takes. Therefore both are tested.

use super::cause::Cause;
use lcplab_lcp::Lcp;

/// A diagonal entry below this fraction of the next larger one is separated from it; so is an entry
/// below this value in a problem with no others.
const APART: f64 = 1e-12;

/// The causes for all such rows; `name` gives a row's name.
pub(super) fn immovable_rows<'a>(
    lcp: &'a Lcp,
    name: impl Fn(usize) -> String + 'a,
) -> impl Iterator<Item = Cause> + 'a {
    let is_small = small_rows(lcp);
    let others = (0..lcp.len()).filter(|&i| !is_small[i]);
    let largest = others.map(|i| log_energy(lcp, i)).fold(f64::NEG_INFINITY, f64::max);
    let has_others = largest > f64::NEG_INFINITY || lcp.len() == 1;
    let takes_more =
        move |i: usize| has_others && log_energy(lcp, i) - largest > -libm::log2(APART);
    let is_immovable =
        move |&i: &usize| own_impulse(lcp, i).is_infinite() || is_small[i] && takes_more(i);
    (0..lcp.len()).filter(is_immovable).map(move |i| Cause::ImmovableRow {
        row: name(i),
        diagonal: lcp.matrix().diagonal(i),
        impulse: own_impulse(lcp, i).abs(),
    })
}

/// Which rows lie below a gap in the sorted diagonal entries of A.
fn small_rows(lcp: &Lcp) -> Vec<bool> {
    let diagonal = |i: usize| lcp.matrix().diagonal(i);
    let mut rows: Vec<usize> = (0..lcp.len()).filter(|&i| diagonal(i) > 0.0).collect();
    rows.sort_by(|&i, &j| diagonal(j).total_cmp(&diagonal(i)));
    let mut is_small = vec![false; lcp.len()];
    let gap = rows.windows(2).position(|pair| diagonal(pair[1]) < APART * diagonal(pair[0]));
    for &i in rows.iter().skip(gap.map_or(rows.len(), |gap| gap + 1)) {
        is_small[i] = true;
    }
    if let [only] = rows[..] {
        is_small[only] = lcp.len() == 1 && diagonal(only) < APART;
    }
    is_small
}

/// The impulse that row i alone would take, within its bounds; 0 for friction, whose bounds depend
/// on other rows.
fn own_impulse(lcp: &Lcp, i: usize) -> f64 {
    let diagonal = lcp.matrix().diagonal(i);
    if lcp.is_coupled(i) || diagonal <= 0.0 || lcp.b()[i] == 0.0 {
        return 0.0;
    }
    (-lcp.b()[i] / diagonal).max(lcp.lo()[i]).min(lcp.hi()[i])
}

/// log₂ of x² a_ii at that impulse x, as the energy itself may overflow; −∞ if x = 0.
fn log_energy(lcp: &Lcp, i: usize) -> f64 {
    let impulse = own_impulse(lcp, i).abs().min(f64::MAX);
    2.0 * libm::log2(impulse) + libm::log2(lcp.matrix().diagonal(i))
}
