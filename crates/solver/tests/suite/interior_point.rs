use lcplab_lcp::{Lcp, Matrix, dot};
use lcplab_solver::{InteriorPoint, Settings, Solver, Start, Status};
use proptest::prelude::*;

use lcplab_testing::{INF, Iterates, assert_proved, boxed, cases, iterates, manufactured, stack};

#[test]
fn the_number_of_iterations_hardly_depends_on_the_size() {
    for n in [5, 20, 80] {
        let solution = InteriorPoint::default().solve(&stack(n), &Start::default(), &mut ());
        assert_eq!(solution.status, Status::Solved);
        assert!(solution.iterations <= 15, "n = {n}: {}", solution.iterations);
    }
}

#[test]
fn nor_on_the_mass_ratio() {
    for r in [1.0, 1e3, 1e6, 1e9] {
        let a: [&[f64]; 2] = [&[1.0, -1.0], &[-1.0, 1.0 + 1.0 / r]];
        let lcp = boxed(&a, &[-0.1635, 0.0], &[0.0; 2], &[f64::INFINITY; 2]);
        let settings = Settings::default().with_tolerance(1e-8 / r);
        let solution = InteriorPoint { settings }.solve(&lcp, &Start::default(), &mut ());
        assert!(solution.iterations <= 40 || r > 1e6, "mass ratio {r}: {}", solution.iterations);
        assert_proved(&lcp, &solution.x);
    }
}

/// Mehrotra's step on x − 1 ⟂ x, written out for one unknown from x = 1.6.
#[test]
fn a_step_is_mehrotras() {
    // energy b²/a = 1, so that the multiplier is 1/1.6; w = 0.6
    let (room, multiplier, w) = (1.6, 0.625, 0.6);
    let step = |mu: f64, second_order: f64| {
        let r = mu - room * multiplier - second_order;
        let dx = (multiplier - w + r / room) / (1.0 + multiplier / room);
        (dx, (r - multiplier * dx) / room)
    };
    let (dx, dz) = step(0.0, 0.0);
    let reach = f64::min(1.0, f64::min(-room / dx, -multiplier / dz));
    let ahead = (room + reach * dx) * (multiplier + reach * dz);
    let (x, z) = step((ahead / (room * multiplier)).powi(3) * room * multiplier, dx * dz);
    let length = f64::min(1.0, 0.995 * f64::min(-room / x, -multiplier / z));
    let lcp = boxed(&[&[1.0]], &[-1.0], &[0.0], &[f64::INFINITY]);
    let mut path = Iterates::default();
    InteriorPoint::default().solve(&lcp, &Start::at(&[room]), &mut path);
    assert!((path.0[1][0] - (room + length * x)).abs() < 1e-10, "{:?}", path.0);
}

/// A motor that pushed one way at its limit in the last step and hardly pushes in this one.
#[test]
fn a_start_at_the_wrong_bound_is_left() {
    for lcp in [
        boxed(&[&[6.0]], &[-0.18], &[-5.0], &[5.0]),
        boxed(
            &[&[1.0, 1.0, 1.0], &[1.0, 1.0, 1.0], &[1.0, 1.0, 6.0]],
            &[-0.2, -0.2, -0.35],
            &[f64::NEG_INFINITY, f64::NEG_INFINITY, -5.0],
            &[f64::INFINITY, f64::INFINITY, 5.0],
        ),
    ] {
        let motor = lcp.len() - 1;
        for bound in [-5.0, 5.0] {
            let mut start = vec![0.0; lcp.len()];
            start[motor] = bound;
            let solution = InteriorPoint::default().solve(&lcp, &Start::at(&start), &mut ());
            assert_eq!(solution.status, Status::Solved, "{bound}, {:?}", solution.x);
            assert!(solution.iterations <= 15, "{bound}: {}", solution.iterations);
            assert!((solution.x[motor] - 0.03).abs() < 1e-6, "{bound}: {:?}", solution.x);
        }
    }
}

/// Two equal equations whose biases differ by drift, 1e-9, solved in step after step with another
/// load. The part of x along the null direction (1, −1) must not grow from step to step.
#[test]
fn a_start_adds_nothing_along_a_null_direction() {
    let free = [f64::NEG_INFINITY, f64::INFINITY];
    let mut before = vec![0.0; 2];
    for step in 0..20 {
        let load = 1.0 + 0.01 * f64::from(step);
        let rows: [&[f64]; 2] = [&[1.0, 1.0], &[1.0, 1.0]];
        let lcp = boxed(&rows, &[-load, 1e-9 - load], &[free[0]; 2], &[free[1]; 2]);
        let lcp = lcp.with_scale(1.0).unwrap();
        let cold = InteriorPoint::default().solve(&lcp, &Start::default(), &mut ());
        let warm = InteriorPoint::default().solve(&lcp, &Start::at(&before), &mut ());
        assert_eq!(warm.x, cold.x);
        before = warm.x;
    }
}

/// Forces along (1, −1) satisfy neither of two equations that contradict each other. If they do so
/// by less than forces of the scale times the tolerance, that is drift, and x is a solution.
#[test]
fn equations_that_have_drifted_apart_are_no_ray() {
    let free = [f64::NEG_INFINITY, f64::INFINITY];
    let rows: [&[f64]; 2] = [&[1.0, 1.0], &[1.0, 1.0]];
    let lcp = boxed(&rows, &[-1e-5, 1e-9 - 1e-5], &[free[0]; 2], &[free[1]; 2]);
    let solve = |lcp: &Lcp| InteriorPoint::default().solve(lcp, &Start::default(), &mut ()).status;
    assert!(matches!(solve(&lcp), Status::Ray { .. }), "{}", solve(&lcp));
    assert_eq!(solve(&lcp.with_scale(1.0).unwrap()), Status::Solved);
}

fn stays_inside(lcp: &Lcp) -> bool {
    let inside = |x: &[f64], i: usize| {
        let (lo, hi) = (lcp.lo()[i], lcp.hi()[i]);
        lo == hi || (lo <= x[i] && x[i] <= hi)
    };
    let path = iterates(&InteriorPoint::default(), lcp);
    path.iter().all(|x| (0..x.len()).all(|i| inside(x, i)))
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn singular_and_degenerate_problems_take_few_iterations(m in manufactured(8, 4, 0.0)) {
        prop_assume!((0..8).all(|i| m.lcp.matrix().diagonal(i) > 0.0));
        let solution = InteriorPoint::default().solve(&m.lcp, &Start::default(), &mut ());
        prop_assert_eq!(&solution.status, &Status::Solved);
        prop_assert!(solution.iterations <= 60, "{}", solution.iterations);
    }

    #[test]
    fn the_iterates_stay_within_the_bounds(m in manufactured(6, 4, 0.5)) {
        prop_assert!(stays_inside(&m.lcp));
    }

    /// The objective is the same at every minimum.
    #[test]
    fn a_quadratic_program_with_constraints_is_solved(program in program(9, 5)) {
        let Program { lcp, minimum, .. } = &program;
        let solution = InteriorPoint::default().solve(lcp, &Start::default(), &mut ());
        prop_assert_eq!(&solution.status, &Status::Solved);
        let [found, least] = [&solution.x, minimum].map(|x| program.objective(x));
        prop_assert!((found - least).abs() <= 1e-7 * (1.0 + least.abs()), "{found} for {least}");
    }

    /// With P = 0 the conditions are those of a linear program: A + Aᵀ = 0.
    #[test]
    fn a_linear_program_is_solved(program in program(6, 0)) {
        let solution = InteriorPoint::default().solve(&program.lcp, &Start::default(), &mut ());
        prop_assert_eq!(&solution.status, &Status::Solved);
    }
}

/// A convex quadratic program min ½ yᵀP y + qᵀy with C y ≥ d, as the problem of y and its
/// multipliers λ, of which one minimum is known.
#[derive(Debug)]
struct Program {
    lcp: Lcp,
    /// (y, λ).
    minimum: Vec<f64>,
    /// The number of entries of y.
    variables: usize,
}

impl Program {
    /// ½ yᵀP y + qᵀy.
    fn objective(&self, x: &[f64]) -> f64 {
        let y = [&x[..self.variables], &vec![0.0; x.len() - self.variables]].concat();
        let half: Vec<f64> = (0..self.variables)
            .map(|i| 0.5 * self.lcp.matrix().row_dot(i, &y) + self.lcp.b()[i])
            .collect();
        dot(&half, &y[..self.variables])
    }
}

/// A program with n variables, of which every third is bounded by 0 from below, n constraints, of
/// which the last is an equation, and P = GᵀG of this rank. y and λ are drawn first: every second
/// constraint is active, and q and d follow from the conditions of a minimum.
fn program(n: usize, rank: usize) -> impl Strategy<Value = Program> {
    let entries = |count: usize| prop::collection::vec(-2.0..2.0, count);
    let sizes = prop::collection::vec(0.5..2.0, 2 * n);
    (entries(rank * n), entries(n * n), sizes, entries(n)).prop_map(move |(g, c, size, free)| {
        let g = |r: usize, i: usize| g[r * n + i];
        let p = |i: usize, j: usize| (0..rank).map(|r| g(r, i) * g(r, j)).sum::<f64>();
        let c = |r: usize, i: usize| c[r * n + i];
        let is_bounded = |i: usize| i.is_multiple_of(3);
        let is_equation = |r: usize| r + 1 == n;
        let is_active = |r: usize| r.is_multiple_of(2) || is_equation(r);
        // Every second bounded variable is at its bound.
        let y: Vec<f64> = (0..n)
            .map(|i| match i % 6 {
                0 => 0.0,
                3 => size[i],
                _ => free[i],
            })
            .collect();
        let lambda: Vec<f64> = (0..n)
            .map(|r| match (is_equation(r), is_active(r)) {
                (true, _) => free[r],
                (_, true) => size[n + r],
                _ => 0.0,
            })
            .collect();
        let mut a = vec![0.0; 4 * n * n];
        let mut b = vec![0.0; 2 * n];
        for i in 0..n {
            let force: f64 = (0..n).map(|r| c(r, i) * lambda[r]).sum();
            let slope: f64 = (0..n).map(|j| p(i, j) * y[j]).sum();
            // At its bound the variable has w > 0.
            b[i] = force - slope + if i % 6 == 0 { size[i] } else { 0.0 };
            let distance = if is_active(i) { 0.0 } else { size[n + i] };
            b[n + i] = distance - (0..n).map(|j| c(i, j) * y[j]).sum::<f64>();
            for j in 0..n {
                a[i * 2 * n + j] = p(i, j);
                a[i * 2 * n + n + j] = -c(j, i);
                a[(n + i) * 2 * n + j] = c(i, j);
            }
        }
        let at_least_zero = |k: usize| if k < n { is_bounded(k) } else { !is_equation(k - n) };
        let lo = (0..2 * n).map(|k| if at_least_zero(k) { 0.0 } else { -f64::INFINITY }).collect();
        let lcp = Lcp::new(Matrix::dense(2 * n, &a), b, lo, vec![f64::INFINITY; 2 * n]).unwrap();
        Program { lcp, minimum: [y, lambda].concat(), variables: n }
    })
}

fn to_eleven_digits() -> InteriorPoint {
    InteriorPoint { settings: Settings::default().with_tolerance(1e-11) }
}

/// 200 points in a row, numbered so that neighbors are far apart: an envelope would be half of n².
fn scattered(lo: f64, hi: f64) -> (Lcp, Vec<f64>) {
    let n = 200;
    let place = |i: usize| 67 * i % n;
    let mut entries: Vec<_> = (0..n).map(|i| (i, i, 2.5)).collect();
    for (i, j) in (1..n).map(|i| (place(i - 1), place(i))) {
        entries.extend([(i, j, -1.0), (j, i, -1.0)]);
    }
    let matrix = Matrix::sparse(n, &entries);
    let x: Vec<f64> = (0..n).map(|i| f64::from(i as u32 % 5) - 2.0).collect();
    let w = |x: f64| if x == lo { 0.5 } else { 0.0 }; // a lower bound that holds pushes back
    let b = (0..n).map(|i| w(x[i]) - matrix.row_dot(i, &x)).collect();
    (Lcp::new(matrix, b, vec![lo; n], vec![hi; n]).unwrap(), x)
}

#[test]
fn rows_that_reach_far_are_reordered_and_the_known_solution_is_found() {
    for (lo, hi) in [(-INF, INF), (-2.0, INF), (-2.0, 5.0)] {
        let (lcp, expected) = scattered(lo, hi);
        let solution = to_eleven_digits().solve(&lcp, &Start::default(), &mut ());
        assert_eq!(solution.status, Status::Solved);
        for (x, expected) in solution.x.iter().zip(&expected) {
            assert!((x - expected).abs() < 1e-9, "{x} for {expected}");
        }
    }
}

#[test]
fn a_pinned_row_stays_where_it_is_in_any_order() {
    let (lcp, expected) = scattered(-INF, INF);
    let pinned = |i: usize| i.is_multiple_of(3);
    let x = &expected;
    let bound = |open: f64| (0..lcp.len()).map(move |i| if pinned(i) { x[i] } else { open });
    let (lo, hi) = (bound(-INF).collect(), bound(INF).collect());
    let lcp = Lcp::new(lcp.matrix().clone(), lcp.b().to_vec(), lo, hi).unwrap();
    let solution = to_eleven_digits().solve(&lcp, &Start::default(), &mut ());
    assert_eq!(solution.status, Status::Solved);
    for (i, (x, expected)) in solution.x.iter().zip(&expected).enumerate() {
        assert!(if pinned(i) { x == expected } else { (x - expected).abs() < 1e-9 });
    }
}
