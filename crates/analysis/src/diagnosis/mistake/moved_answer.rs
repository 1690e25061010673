//! Changes of a right answer: rows in another order, tangents swapped, a contact that reads 0, the
//! opposite sign.

use lcplab_lcp::friction::Contact;
use lcplab_lcp::number::readable;

use super::{Attempt, LARGEST_LIST, MistakeKind};

/// Values that agree to this fraction of the largest may be the same value in another row.
const SAME: f64 = 1e-6;
/// Maximum number of rows for which all pairs of rows are exchanged.
const MOST_EXCHANGED: usize = 60;
/// A factor that differs from 1 by less is none.
const NO_FACTOR: f64 = 1e-9;

/// All changes of the solution; `contacts` are those of the problem.
pub(super) fn moved_answers(contacts: &[Contact], solution: &[f64], x: &[f64]) -> Vec<Attempt> {
    let mut all = reordered(contacts, solution);
    all.extend(permuted(solution, x));
    if !contacts.is_empty() {
        all.extend(turned(contacts, solution));
    }
    all.extend(zeroed(contacts, solution));
    let reversed = solution.iter().map(|s| -s).collect();
    all.push(Attempt::new(
        MistakeKind::SignOfX,
        "the solution with the opposite sign".into(),
        reversed,
    ));
    all
}

/// The solution times the factor that brings it nearest to x.
pub(super) fn scaled(solution: &[f64], x: &[f64]) -> Option<Attempt> {
    let along: f64 = x.iter().zip(solution).map(|(x, s)| x * s).sum();
    let factor = along / solution.iter().map(|s| s * s).sum::<f64>();
    let is_factor = factor > 0.0 && factor.is_finite() && (factor - 1.0).abs() > NO_FACTOR;
    is_factor.then(|| Attempt {
        fitted: 1,
        ..Attempt::new(
            MistakeKind::FactorOfX,
            format!(
                "the solution times {} (check the time step and the unit)",
                readable(factor, 6)
            ),
            solution.iter().map(|s| factor * s).collect(),
        )
    })
}

/// Rows shifted by one, contacts shifted by one, and rows in reverse order.
fn reordered(contacts: &[Contact], solution: &[f64]) -> Vec<Attempt> {
    let n = solution.len();
    let attempt = |what: &str, y: Vec<f64>| Attempt::new(MistakeKind::OtherRows, what.into(), y);
    let shifted =
        |what: &str, by: usize| attempt(what, (0..n).map(|i| solution[(i + by) % n]).collect());
    let mut all = vec![
        shifted("the solution, each row with the value of the next", 1),
        shifted("the solution, each row with the value of the one before", n - 1),
        attempt("the solution in reverse order", solution.iter().rev().copied().collect()),
    ];
    if contacts.len() > 1 {
        for (what, by) in [("next", 1), ("previous", contacts.len() - 1)] {
            let mut y = solution.to_vec();
            for (k, contact) in contacts.iter().enumerate() {
                contact.put(contacts[(k + by) % contacts.len()].of(solution), &mut y);
            }
            all.push(attempt(&format!("the solution, each contact with the {what} one"), y));
        }
    }
    all
}

/// Orders of rows that undo a mistake: row i of the answer is row `order[i]` of x. Rows or contacts
/// shifted by one, reversed, or two of them exchanged.
pub(super) fn orders(n: usize, contacts: &[Contact]) -> Vec<(String, Vec<usize>)> {
    let mut all = vec![
        ("a solution, each row with the value of the next".into(), shifted(n, n - 1)),
        ("a solution, each row with the value of the one before".into(), shifted(n, 1)),
        ("a solution in reverse order".into(), (0..n).rev().collect()),
    ];
    let count = contacts.len();
    let moved = |pairs: &mut dyn Iterator<Item = (usize, usize)>| {
        let mut order: Vec<usize> = (0..n).collect();
        for (to, from) in pairs {
            for (i, j) in contacts[to].rows.into_iter().zip(contacts[from].rows) {
                order[i] = j;
            }
        }
        order
    };
    if count > 1 {
        for (what, by) in [("next", count - 1), ("previous", 1)] {
            let order = moved(&mut (0..count).map(|k| (k, (k + by) % count)));
            all.push((format!("a solution, each contact with the {what} one"), order));
        }
    }
    if n <= MOST_EXCHANGED {
        for (k, l) in pairs(count) {
            let rows = [contacts[k].rows[0], contacts[l].rows[0]];
            let what = format!(
                "a solution with the contacts of rows {} and {} exchanged",
                rows[0], rows[1]
            );
            all.push((what, moved(&mut [(k, l), (l, k)].into_iter())));
        }
        for (i, j) in pairs(n) {
            let mut order: Vec<usize> = (0..n).collect();
            order.swap(i, j);
            all.push((format!("a solution with the values of rows {i}, {j} exchanged"), order));
        }
    }
    all
}

/// Each row with the place of the one so many places farther.
fn shifted(n: usize, by: usize) -> Vec<usize> {
    (0..n).map(|i| (i + by) % n).collect()
}

/// All pairs of different numbers below this one.
fn pairs(count: usize) -> impl Iterator<Item = (usize, usize)> {
    (0..count).flat_map(move |i| (i + 1..count).map(move |j| (i, j)))
}

/// The values of the solution in the order of the values of x, if they are the same values.
fn permuted(solution: &[f64], x: &[f64]) -> Option<Attempt> {
    let ranked = |v: &[f64]| {
        let mut rows: Vec<usize> = (0..v.len()).collect();
        rows.sort_by(|&i, &j| v[i].total_cmp(&v[j]));
        rows
    };
    let size = solution.iter().fold(0.0_f64, |most, s| most.max(s.abs()));
    let pairs: Vec<(usize, usize)> = ranked(x).into_iter().zip(ranked(solution)).collect();
    let mut y = solution.to_vec();
    for &(i, j) in &pairs {
        y[i] = solution[j];
    }
    let is_other = |i: usize| (y[i] - solution[i]).abs() > SAME * size;
    let moved: Vec<usize> = (0..y.len()).filter(|&i| is_other(i)).collect();
    let is_same = pairs.iter().all(|&(i, j)| (x[i] - solution[j]).abs() <= SAME * size);
    if !is_same || moved.len() < 2 {
        return None;
    }
    let named: Vec<String> = moved.iter().take(LARGEST_LIST).map(usize::to_string).collect();
    let more = if moved.len() > LARGEST_LIST { " and others" } else { "" };
    let what = format!("the solution with the values of rows {}{more} exchanged", named.join(", "));
    // The number of orders of the same values.
    let orders = (1..=moved.len()).fold(1usize, |all, k| all.saturating_mul(k));
    Some(Attempt { sweeps: orders, ..Attempt::new(MistakeKind::OtherRows, what, y) })
}

/// Other values for n, t1 and t2 of a contact.
type Change = fn([f64; 3]) -> [f64; 3];

/// t1 and t2 swapped, or with the opposite sign, in all contacts.
fn turned(contacts: &[Contact], solution: &[f64]) -> Vec<Attempt> {
    let changes: [(&str, Change); 4] = [
        ("t1 and t2 swapped", |[n, s, t]| [n, t, s]),
        ("the opposite sign of t1", |[n, s, t]| [n, -s, t]),
        ("the opposite sign of t2", |[n, s, t]| [n, s, -t]),
        ("the opposite sign of t1 and t2", |[n, s, t]| [n, -s, -t]),
    ];
    let turned = |(what, change): (&str, Change)| {
        let mut y = solution.to_vec();
        for contact in contacts {
            contact.put(change(contact.of(solution)), &mut y);
        }
        Attempt::new(MistakeKind::Tangents, format!("the solution with {what}"), y)
    };
    changes.into_iter().map(turned).collect()
}

/// The solution with one contact, or one row without friction, set to 0.
fn zeroed(contacts: &[Contact], solution: &[f64]) -> Vec<Attempt> {
    let is_contact = |i: &usize| contacts.iter().any(|contact| contact.rows.contains(i));
    let single = (0..solution.len()).filter(|i| !is_contact(i)).map(|i| vec![i]);
    let all = contacts.iter().map(|contact| contact.rows.to_vec()).chain(single);
    let zeroed = |rows: Vec<usize>| {
        let mut y = solution.to_vec();
        rows.iter().for_each(|&i| y[i] = 0.0);
        let what = match rows[..] {
            [row] => format!("the solution with row {row} set to 0"),
            _ => format!("the solution with the contact of row {} set to 0", rows[0]),
        };
        Attempt::new(MistakeKind::ContactLeftOut, what, y)
    };
    all.map(zeroed).collect()
}
