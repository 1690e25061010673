//! The set of all solutions, from problems whose solutions are known by hand.

use lcplab_problem::exact::{Face, SolutionSet};
use lcplab_problem::{Lcp, Matrix};

const INF: f64 = f64::INFINITY;

fn set(a: &[f64], b: &[f64], lo: f64, hi: f64) -> SolutionSet {
    let n = b.len();
    let lcp = Lcp::new(Matrix::dense(n, a), b.to_vec(), vec![lo; n], vec![hi; n]).unwrap();
    SolutionSet::of(&lcp).unwrap()
}

/// ½xᵀAx with A = [1 5; 5 1] on the box |x_i| ≤ 1: a saddle at 0 and minima at (1, −1), (−1, 1).
/// 0 lies halfway between the minima, but no other point between them is a solution.
#[test]
fn a_solution_halfway_between_two_others_does_not_join_them() {
    let found = set(&[1.0, 5.0, 5.0, 1.0], &[0.0, 0.0], -1.0, 1.0);
    assert_eq!(found.corners.len(), 3);
    assert_eq!(found.faces.len(), 3);
    assert!(found.faces.iter().all(Face::is_isolated));
    assert!(!found.is_unique());
}

/// Three supports share a load of 1: the triangle x₁ + x₂ + x₃ = 1.
#[test]
fn a_triangle_of_solutions_is_one_face() {
    let found = set(&[1.0; 9], &[-1.0; 3], 0.0, INF);
    assert_eq!(found.faces, [Face { corners: vec![0, 1, 2], rays: vec![] }]);
}

/// w = 0 for every x ≥ 0: a corner with a ray, and no corner is the only solution.
#[test]
fn a_set_without_end_has_a_ray() {
    let found = set(&[0.0, 0.0, 0.0, 1.0], &[0.0, -1.0], 0.0, INF);
    assert_eq!(found.corners, [[0.into(), 1.into()]]);
    assert_eq!(found.rays, [[1.into(), 0.into()]]);
    assert_eq!(found.faces, [Face { corners: vec![0], rays: vec![0] }]);
    assert!(!found.is_unique());
}

/// x = 0 and x = 1 solve w = 1 − x, x ≥ 0; w = −1 with x ≥ 0 has no solution.
#[test]
fn isolated_solutions_and_none_are_distinguished() {
    let two = set(&[-1.0], &[1.0], 0.0, INF);
    assert_eq!(two.corners, [[0.into()], [1.into()]]);
    assert_eq!(two.faces.len(), 2);
    assert!(set(&[0.0], &[-1.0], 0.0, INF).faces.is_empty());
    assert!(set(&[2.0], &[-1.0], 0.0, INF).is_unique());
}
