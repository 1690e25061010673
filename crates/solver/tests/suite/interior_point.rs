use lcplab_problem::Lcp;
use lcplab_solver::{InteriorPoint, Settings, Solver, Start, Status};
use proptest::prelude::*;

use lcplab_testing::{Iterates, assert_proved, boxed, cases, iterates, manufactured, stack};

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

/// Mehrotra's step on x − 1 ⟂ x, written out for one unknown from x = 4.
#[test]
fn a_step_is_mehrotras() {
    // energy b²/a = 1, so that the multiplier is 1/4; w = 3
    let (room, multiplier, w) = (4.0, 0.25, 3.0);
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
}
