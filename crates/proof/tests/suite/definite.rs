//! Uniqueness by definiteness: proved of definite matrices, and never of singular ones.

use lcplab_lcp::Lcp;
use lcplab_proof::{Claim, Kind, Reason, prove_kind};
use oorandom::Rand64;

use super::{asked, contacts};

/// Whether it is proved that the solution is unique because A is definite; b > 0, so x = 0.
fn is_proved_definite(a: &[f64], n: usize) -> bool {
    let lcp: Lcp = contacts(a, &vec![1.0; n]);
    let proof = prove_kind(&asked(&lcp), &vec![0.0; n], Kind::Unique).proof;
    proof.is_some_and(|proof| matches!(proof.claim, Claim::Unique { by: Reason::Definite, .. }))
}

/// J Jᵀ for a J of small integers; its last row is the sum of the others, so d = (1, …, 1, −1) has
/// dᵀ A d = 0.
fn singular(random: &mut Rand64, n: usize) -> Vec<f64> {
    let mut integer = || random.rand_range(0..7) as f64 - 3.0;
    let mut j: Vec<Vec<f64>> = (1..n).map(|_| (0..2 * n).map(|_| integer()).collect()).collect();
    j.push((0..2 * n).map(|c| j.iter().map(|row| row[c]).sum()).collect());
    let dot = |r: usize, c: usize| j[r].iter().zip(&j[c]).map(|(a, b)| a * b).sum();
    (0..n * n).map(|k| dot(k / n, k % n)).collect()
}

#[test]
fn a_singular_matrix_is_definite_only_after_a_positive_change_of_a_diagonal_entry() {
    let mut random = Rand64::new(58);
    for n in 2..12 {
        let a = singular(&mut random, n);
        assert!(!is_proved_definite(&a, n), "{n} rows");
        // dᵀ A d changes by the same amount, and A is positive on the complement of d.
        for change in [2f64.powi(-30), 2f64.powi(-10), 1.0] {
            let changed = |by: f64| {
                let mut a = a.clone();
                a[n * n - 1] += by;
                a
            };
            assert!(is_proved_definite(&changed(change), n), "{n} rows + {change:e}");
            assert!(!is_proved_definite(&changed(-change), n), "{n} rows - {change:e}");
        }
    }
}

#[test]
fn one_unit_in_the_last_place_decides() {
    let above = 1f64.next_up();
    assert!(is_proved_definite(&[above, 1.0, 1.0, 1.0], 2));
    assert!(!is_proved_definite(&[1.0, 1.0, 1.0, 1.0], 2));
    assert!(!is_proved_definite(&[1.0, above, 1.0, 1.0], 2)); // A + Aᵀ counts: 2 · 2 < (1 + above)²
    assert!(is_proved_definite(&[1.0, above, -1.0, 1.0], 2)); // a_01 + a_10 is 2⁻⁵²
    assert!(!is_proved_definite(&[-1.0, 0.0, 0.0, 1.0], 2));
}

#[test]
fn units_do_not_matter() {
    // tridiag(−1, 2, −1), eigenvalues 4 sin²(k π/(2 n + 2)), with rows in other units.
    let n = 8;
    let units: Vec<f64> = (0..n).map(|i| 2f64.powi(60 * (i % 5) as i32 - 120)).collect();
    let entry = |i: usize, j: usize| match i.abs_diff(j) {
        0 => 2.0,
        1 => -1.0,
        _ => 0.0,
    };
    let mut a: Vec<f64> =
        (0..n * n).map(|k| units[k / n] * entry(k / n, k % n) * units[k % n]).collect();
    assert!(is_proved_definite(&a, n));
    // With t instead of the first 2, the determinant is n t − (n − 1).
    a[0] *= 0.5 * (1.0 - 1.0 / n as f64);
    assert!(!is_proved_definite(&a, n));
}
