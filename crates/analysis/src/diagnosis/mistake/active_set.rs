//! The equations of the contacts' active set at an answer, under a polygon or Coulomb's cone.

use lcplab_lcp::merit::RowTerms;
use nalgebra::DVector;

use super::contact_sweeps::ContactSweeps;

/// An entry within this fraction of the largest of a bound is at the bound.
const AT_BOUND: f64 = 1e-12;
/// A contact whose slip is this part of its terms sticks.
const AT_REST: f64 = 1e-9;

/// The solution of the equations that x seems to solve, whether or not their signs are right, and
/// the number of values that were taken from x:
///
/// ```text
/// a row at a bound       x_i = the bound
/// an open contact        x_n = x_t = 0
/// a sliding contact      w_n = 0,   x_t = d x_n with the direction d of x
/// other rows             w_i = 0
/// ```
pub(super) fn on_active_set(sweeps: &ContactSweeps<'_>, x: &[f64]) -> Option<(Vec<f64>, usize)> {
    let friction = sweeps.friction();
    let lcp = friction.lcp();
    let size = x.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let is_at = |i: usize, bound: f64| (x[i] - bound).abs() <= AT_BOUND * size;
    let mut a = lcp.matrix().to_dense();
    let mut right: DVector<f64> = -DVector::from_column_slice(lcp.b());
    let mut taken = 0;
    let mut equation = |i: usize, entries: &[(usize, f64)], value: f64| {
        a.row_mut(i).fill(0.0);
        entries.iter().for_each(|&(j, entry)| a[(i, j)] = entry);
        right[i] = value;
    };
    for &i in friction.others() {
        let bounds = [lcp.lo()[i], lcp.hi()[i]];
        if let Some(bound) = bounds.into_iter().find(|bound| is_at(i, *bound)) {
            equation(i, &[(i, 1.0)], bound);
            taken += 1;
        }
    }
    for contact in friction.contacts() {
        let [n, t1, t2] = contact.rows;
        if is_at(n, 0.0) {
            contact.rows.into_iter().for_each(|i| equation(i, &[(i, 1.0)], 0.0));
            taken += 3;
            continue;
        }
        let is_slow = |i: usize| {
            let terms = RowTerms::at(lcp, i, x);
            terms.w.abs() <= AT_REST * terms.magnitude
        };
        let sticks = sweeps.sticks(contact, x) || is_slow(t1) && is_slow(t2);
        if !sticks && sweeps.is_along_slip(contact, x) {
            for t in [t1, t2] {
                equation(t, &[(t, 1.0), (n, -x[t] / x[n])], 0.0);
            }
            taken += 1;
        }
    }
    let y = a.lu().solve(&right)?;
    Some((y.as_slice().to_vec(), taken))
}
