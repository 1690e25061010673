//! The set of all solutions, from problems whose solutions are known by hand.

use dashu_ratio::RBig;
use lcplab_lcp::exact::dyadic::dyadic;
use lcplab_lcp::exact::{Exact, Face, Point, SolutionSet, TooMany};
use lcplab_lcp::{Coupling, Lcp, Matrix};

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

/// x₀ = 1 with w₀ = 4 + 2 x₁ ≥ 0, and w₁ = 0 for every x₁ ≤ 0: a segment from x₁ = 0 to −2. It
/// begins like a ray, but x₀ = 1 would have to rise to its upper bound 5 where w₀ < 0.
#[test]
fn a_direction_that_ends_at_the_sign_of_a_w_is_no_ray() {
    let a = Matrix::dense(2, &[1.0, 2.0, -2.0, 0.0]);
    let lcp = Lcp::new(a, vec![3.0, 2.0], vec![1.0, -INF], vec![5.0, 0.0]).unwrap();
    let found = SolutionSet::of(&lcp).unwrap();
    assert_eq!(found.corners, [[1.into(), 0.into()], [1.into(), (-2).into()]]);
    assert!(found.rays.is_empty());
    assert_eq!(found.faces, [Face { corners: vec![0, 1], rays: vec![] }]);
}

/// Every mean of a face's corners plus any multiples of its rays is a solution, of problems with
/// singular matrices of small integers.
#[test]
fn every_point_of_a_face_is_a_solution() {
    let mut state = 1u64;
    let mut draw = |count: i32| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        f64::from(((state >> 33) % count as u64) as i32)
    };
    let (mut faces, mut with_rays) = (0, 0);
    for _ in 0..1000 {
        let n = 1 + draw(3) as usize;
        let a: Vec<f64> = (0..n * n).map(|_| draw(3) - 1.0).collect();
        let b: Vec<f64> = (0..n).map(|_| draw(5) - 2.0).collect();
        let lo: Vec<f64> = (0..n).map(|_| [-INF, 0.0, 1.0][draw(3) as usize]).collect();
        let hi = lo.iter().map(|lo| [INF, lo.max(0.0) + 2.0][draw(2) as usize]).collect();
        let lcp = Lcp::new(Matrix::dense(n, &a), b, lo, hi).unwrap();
        let (exact, found) = (Exact::new(&lcp), SolutionSet::of(&lcp).unwrap());
        for face in &found.faces {
            let count = RBig::from(face.corners.len());
            let entry = |i: usize, length: u32| {
                let mean = face.corners.iter().map(|&k| &found.corners[k][i] / &count);
                let along = face.rays.iter().map(|&k| &found.rays[k][i] * RBig::from(length));
                mean.chain(along).fold(RBig::ZERO, |sum, part| sum + part).to_f64().value()
            };
            for length in [0, 1, 7] {
                let x: Vec<f64> = (0..n).map(|i| entry(i, length)).collect();
                // Small integers: halves, quarters and eighths are exact, others are left out.
                if x.iter().all(|x| (8.0 * x).fract() == 0.0) {
                    let point = Point::new(x.iter().map(|&x| dyadic(x)).collect(), dyadic(1.0));
                    assert!(exact.is_solved_by(&point), "{lcp:?}: {x:?}");
                }
            }
            faces += 1;
            with_rays += usize::from(!face.rays.is_empty());
        }
    }
    assert!(faces > 500 && with_rays > 50, "{faces}, {with_rays}");
}

/// tridiag(−1, 2, −1) with 100 rows without bounds: x_i = i (101 − i) / 2 for b = −1. With exact
/// elimination for each of its rows in turn this would take minutes.
#[test]
fn a_hundred_regular_equations_have_one_solution() {
    let n = 100;
    let entry = |k: usize| match (k / n).abs_diff(k % n) {
        0 => 2.0,
        1 => -1.0,
        _ => 0.0,
    };
    let a: Vec<f64> = (0..n * n).map(entry).collect();
    let found = set(&a, &vec![-1.0; n], -INF, INF);
    assert!(found.is_unique());
    let expected: Vec<RBig> = (1..=n).map(|i| RBig::from((i * (n + 1 - i) / 2) as u64)).collect();
    assert_eq!(found.corners, [expected]);
}

/// x_i w_i with w_i = −x_i on |x_i| ≤ 1: x_i is −1, 0 or 1, in each of three rows by itself. Nine
/// further rows of the box have w_i = 2 x_i + Σ x_j − 1/2, with one solution each.
#[test]
fn twelve_rows_with_two_bounds_have_all_their_solutions() {
    let n = 12;
    let entry = |i: usize, j: usize| match (i < 3, j < 3, i == j) {
        (true, true, true) => -1.0,
        (false, false, true) => 3.0,
        (false, false, false) => 1.0,
        _ => 0.0,
    };
    let a: Vec<f64> = (0..n * n).map(|k| entry(k / n, k % n)).collect();
    let b: Vec<f64> = (0..n).map(|i| if i < 3 { 0.0 } else { -5.5 }).collect();
    let found = set(&a, &b, -1.0, 1.0);
    assert_eq!(found.corners.len(), 27);
    assert!(found.faces.iter().all(Face::is_isolated));
    let half = RBig::from(1) / RBig::from(2); // 3 x + 8 x = 5.5
    assert!(found.corners.iter().all(|x| x[3..].iter().all(|x| *x == half)));
}

/// w_i = −x_i between −1 and 1: no row decides any other, and every one has x_i = −1, 0 or 1. The
/// ranges of w rule out no piece.
fn rows_on_their_own(n: usize) -> Lcp {
    let a: Vec<f64> = (0..n * n).map(|k| if k / n == k % n { -1.0 } else { 0.0 }).collect();
    Lcp::new(Matrix::dense(n, &a), vec![0.0; n], vec![-1.0; n], vec![1.0; n]).unwrap()
}

#[test]
fn a_problem_of_too_many_pieces_or_solutions_has_no_set() {
    assert_eq!(SolutionSet::of(&rows_on_their_own(6)).unwrap().corners.len(), 729);
    // 3⁷ = 2,187 solutions; 3¹² of them; 3¹³ pieces.
    for (n, why) in [(7, TooMany::Corners), (12, TooMany::Corners), (13, TooMany::Pieces)] {
        assert_eq!(SolutionSet::of(&rows_on_their_own(n)).err(), Some(why), "{n}");
    }
}

/// w_i = 1 − x_i ≥ 0: every row has x_i = 0 or 1.
#[test]
fn as_many_solutions_as_are_allowed_are_all_listed() {
    let n = 10;
    let a: Vec<f64> = (0..n * n).map(|k| if k / n == k % n { -1.0 } else { 0.0 }).collect();
    let found = set(&a, &vec![1.0; n], 0.0, f64::INFINITY);
    assert_eq!(found.corners.len(), 1024);
    assert!(found.faces.iter().all(Face::is_isolated));
}

/// w_0 = 10³⁰⁰ (x_0 − x_1), w_1 = x_1 − 1.5 · 10¹⁰ with x between 10¹⁰ and 2 · 10¹⁰: products of A
/// and x are beyond the doubles, and x_0 = x_1 = 1.5 · 10¹⁰ is the only solution.
#[test]
fn a_solution_whose_terms_overflow_is_not_passed_over() {
    let a = Matrix::dense(2, &[1e300, -1e300, 0.0, 1.0]);
    let lcp = Lcp::new(a, vec![0.0, -1.5e10], vec![1e10; 2], vec![2e10; 2]).unwrap();
    let set = SolutionSet::of(&lcp).unwrap();
    let half = || RBig::from(15_000_000_000_i64);
    assert_eq!(set.corners, [[half(), half()]]);
    assert!(set.is_unique());
}

/// Friction of at most 10⁻²⁰⁰ · 10⁻²⁰⁰ is below the doubles, and 10³⁰⁰ times that is above b.
#[test]
fn a_solution_whose_friction_underflows_is_not_passed_over() {
    let a = Matrix::dense(3, &[1e-150, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1e300, 1.0]);
    let b = vec![-1.0, -1.0, -1e-101];
    let bounds = (vec![0.0, f64::NEG_INFINITY, 0.0], vec![1e-200, f64::INFINITY, f64::INFINITY]);
    let lcp = Lcp::new(a, b, bounds.0, bounds.1).unwrap();
    let coupling = Coupling::new(vec![None, Some(0), None], vec![0.0, 1e-200, 0.0]).unwrap();
    let set = SolutionSet::of(&lcp.with_coupling(coupling).unwrap()).unwrap();
    // x_0 and x_1 are at their largest, so w_2 = x_2 + 10⁻¹⁰⁰ − 10⁻¹⁰¹ > 0 and x_2 = 0.
    assert_eq!(set.corners.len(), 1);
    assert!(set.corners[0][1] > RBig::ZERO);
    assert_eq!(set.corners[0][2], RBig::ZERO);
}

/// One contact with a tangent: solutions (t, s t) for all t ≥ 0, where w_n = 0 on the ray.
#[test]
fn a_ray_of_a_contact_with_friction_is_found() {
    // A, b, lo_n, μ, and the direction of a ray.
    let cases = [
        ([0.0, 2.0, 0.0, 0.0], [0.0, 0.0], 0.0, 1.0, [1.0, 0.0]),
        ([1.0, -2.0, 0.0, 0.0], [0.0, 0.0], 0.0, 2.0, [1.0, 0.5]),
        ([1.0, -1.0, 0.0, 0.0], [1.0, 0.0], 1.0, 2.0, [1.0, 1.0]),
    ];
    for (a, b, lo, mu, direction) in cases {
        let lcp = Lcp::new(Matrix::dense(2, &a), b.to_vec(), vec![lo, -INF], vec![INF; 2]).unwrap();
        let coupling = Coupling::new(vec![None, Some(0)], vec![0.0, mu]).unwrap();
        let found = SolutionSet::of(&lcp.with_coupling(coupling).unwrap()).unwrap();
        let ray = |own: &Vec<RBig>| {
            own[0] > RBig::ZERO && &own[1] / &own[0] == RBig::try_from(direction[1]).unwrap()
        };
        assert!(found.rays.iter().any(ray), "{a:?}: {:?}", found.rays);
        assert!(!found.is_unique());
    }
}

/// w_n = n + t, w_t = n − 1 and |t| ≤ n ≤ 4: the solutions (n, −n) from n = 1 to 4, and (0, 0),
/// where no friction is possible and w_t = −1 is allowed. The point halfway from there to (4, −4)
/// is on the segment.
#[test]
fn a_slip_that_turns_around_does_not_join_solutions() {
    let a = Matrix::dense(2, &[1.0, 1.0, 1.0, 0.0]);
    let lcp = Lcp::new(a, vec![0.0, -1.0], vec![0.0, -INF], vec![4.0, INF]).unwrap();
    let coupling = Coupling::new(vec![None, Some(0)], vec![0.0, 1.0]).unwrap();
    let found = SolutionSet::of(&lcp.with_coupling(coupling).unwrap()).unwrap();
    let normal = |face: &Face| face.corners.iter().map(|&k| found.corners[k][0].clone()).collect();
    let mut faces: Vec<Vec<RBig>> = found.faces.iter().map(normal).collect();
    faces.iter_mut().for_each(|face| face.sort());
    faces.sort();
    assert_eq!(faces, [vec![RBig::ZERO], vec![1.into(), 4.into()]]);
}

/// The same without the bound 4, and w_t = 1 + n − z for a z ≥ 0 that nothing determines: the
/// solutions (n, −n, z) with z ≤ 1 + n, and (0, 0, z) for every z. From none of them does the set
/// go on without end in both directions, (1, −1, 0) and (0, 0, 1).
#[test]
fn two_rays_of_one_corner_need_not_belong_together() {
    let a = Matrix::dense(3, &[1.0, 1.0, 0.0, 1.0, 0.0, -1.0, 0.0, 0.0, 0.0]);
    let lcp = Lcp::new(a, vec![0.0, 1.0, 0.0], vec![0.0, -INF, 0.0], vec![INF; 3]).unwrap();
    let coupling = Coupling::new(vec![None, Some(0), None], vec![0.0, 1.0, 0.0]).unwrap();
    let found = SolutionSet::of(&lcp.with_coupling(coupling).unwrap()).unwrap();
    let slides = |face: &Face| face.rays.iter().any(|&k| found.rays[k][0] > RBig::ZERO);
    let rises = |face: &Face| face.rays.iter().any(|&k| found.rays[k][0] == RBig::ZERO);
    assert_eq!(found.faces.len(), 2);
    assert!(found.faces.iter().all(|face| slides(face) != rises(face)), "{found:?}");
}

/// w_t = 2 − n − z, w_c = 4 − t − 2 c + z with 0 ≤ c ≤ 2, w_n = c − 2 and a z ≥ 0 that nothing
/// determines. From (t, c, n, z) = (1, 2, 1, 1) the solutions go on without end in the direction
/// (1, 0, 1, 1), along which w_c stays 0 at c = 2.
#[test]
fn a_ray_on_which_a_row_between_two_bounds_keeps_w_at_zero_is_found() {
    let a = [0.0, 0.0, -1.0, -1.0, -1.0, -2.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0];
    let (lo, hi) = (vec![-INF, 0.0, 0.0, 0.0], vec![INF, 2.0, INF, INF]);
    let lcp = Lcp::new(Matrix::dense(4, &a), vec![2.0, 4.0, -2.0, 0.0], lo, hi).unwrap();
    let coupling =
        Coupling::new(vec![Some(2), None, None, None], vec![1.0, 0.0, 0.0, 0.0]).unwrap();
    let found = SolutionSet::of(&lcp.with_coupling(coupling).unwrap()).unwrap();
    let ray = vec![RBig::ONE, RBig::ZERO, RBig::ONE, RBig::ONE];
    assert!(found.rays.contains(&ray), "{:?}", found.rays);
}
