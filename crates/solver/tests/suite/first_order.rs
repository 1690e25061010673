//! MPRGP, APGD, spectral gradient, NNCG and ADMM.

use lcplab_lcp::{Lcp, merit};
use lcplab_solver::{
    Admm, AndersonPgs, Apgd, Dantzig, Mprgp, Nncg, Pgs, Settings, Solver, Spectral, Start, Status,
};
use proptest::prelude::*;

use lcplab_testing::{INF, boxed, cases, chain, iterates, manufactured, objectives, stack};

fn settings() -> Settings {
    Settings::default().with_max_iterations(20_000)
}

fn iterations(solver: &dyn Solver, lcp: &Lcp) -> usize {
    let solution = solver.solve(lcp, &Start::default(), &mut ());
    assert_eq!(solution.status, Status::Solved, "{}", solver.name());
    solution.iterations
}

#[test]
fn conjugate_gradients_end_after_n_steps_on_equations() {
    for n in [5, 10, 20] {
        assert!(iterations(&Mprgp::default(), &chain(n)) <= n);
    }
}

#[test]
fn a_stack_costs_n_squared_sweeps_but_about_n_conjugate_gradient_steps() {
    // Doubling n: 4 times the sweeps, about twice the steps.
    let growth = |solver: &dyn Solver| {
        iterations(solver, &stack(40)) as f64 / iterations(solver, &stack(20)) as f64
    };
    let pgs = growth(&Pgs { settings: settings(), ..Pgs::default() });
    assert!((3.5..4.5).contains(&pgs), "{pgs}");
    assert!(growth(&Mprgp::default()) < 2.6);
    assert!(growth(&Apgd::default()) < 2.6);
}

#[test]
fn memory_pays() {
    let lcp = stack(30);
    let sweeps = iterations(&Pgs { settings: settings(), ..Pgs::default() }, &lcp);
    let accelerated: [&dyn Solver; 4] =
        [&Mprgp::default(), &Apgd::default(), &Nncg::default(), &AndersonPgs::default()];
    for solver in accelerated {
        assert!(5 * iterations(solver, &lcp) < sweeps, "{}", solver.name());
    }
}

#[test]
fn mixed_sweeps_end_on_equations_of_a_few_rows() {
    // While no row changes sides a sweep is x → G x + c, and mixing k differences minimizes the
    // residual over a Krylov space of k dimensions: with n ≤ 5 rows the sweep after the n-th
    // finishes, and one more is needed to detect that.
    for n in [2, 3, 4, 5] {
        assert!(iterations(&AndersonPgs::default(), &chain(n)) <= n + 2, "{n}");
    }
}

#[test]
fn mixed_sweeps_never_go_uphill() {
    for lcp in [stack(20), chain(20)] {
        let objective = objectives(&AndersonPgs::default(), &lcp);
        let noise = 1e-12 * objective.iter().fold(0.0_f64, |most, v| most.max(v.abs()));
        assert!(objective.windows(2).all(|pair| pair[1] <= pair[0] + noise));
    }
}

#[test]
fn accelerated_gradients_keep_nesterovs_bound() {
    let lcp = stack(30);
    let x = Dantzig::default().solve(&lcp, &Start::default(), &mut ()).x;
    let least = merit::objective(&lcp, &x);
    let distance: f64 = (0..30).map(|i| lcp.matrix().diagonal(i) * x[i] * x[i]).sum();
    for (k, objective) in objectives(&Apgd::default(), &lcp).iter().enumerate() {
        let bound = 2.0 * 2.3 * distance / ((k + 1) * (k + 1)) as f64; // L ≤ 1 + ½ + 1/√2
        assert!(objective - least <= bound, "step {k}");
    }
}

#[test]
fn the_spectral_gradient_goes_uphill_at_times_but_not_above_ten_steps_ago() {
    let objective = objectives(&Spectral::default(), &chain(20));
    assert!(objective.windows(2).any(|pair| pair[1] > pair[0]));
    for k in 1..objective.len() {
        let memory = &objective[k.saturating_sub(10)..k];
        let highest = memory.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        assert!(objective[k] <= highest + 1e-12 * highest.abs(), "step {k}");
    }
}

#[test]
fn a_problem_without_solution_ends_as_a_ray() {
    let lcp = boxed(&[&[1.0, 1.0], &[1.0, 1.0]], &[-1.0, -2.0], &[-INF; 2], &[INF; 2]);
    let solvers: [&dyn Solver; 5] = [
        &Mprgp::default(),
        &Apgd::default(),
        &Spectral::default(),
        &Nncg::default(),
        &Admm::default(),
    ];
    for solver in solvers {
        let solution = solver.solve(&lcp, &Start::default(), &mut ());
        let Status::Ray { direction, .. } = solution.status else {
            panic!("{}: {:?}", solver.name(), solution.status)
        };
        let size = direction[0].abs();
        assert!(size > 0.0 && (direction[0] + direction[1]).abs() < 1e-6 * size);
        assert!(direction[1] > 0.0); // downhill
    }
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn no_step_of_mprgp_raises_the_objective(m in manufactured(8, 5, 0.25)) {
        for pair in objectives(&Mprgp::default(), &m.lcp).windows(2) {
            prop_assert!(pair[1] <= pair[0] + 1e-12 * (1.0 + pair[0].abs()), "{pair:?}");
        }
    }

    #[test]
    fn the_iterates_never_leave_the_bounds(m in manufactured(6, 4, 0.5)) {
        let solvers: [&dyn Solver; 5] = [
            &Mprgp::default(), &Apgd::default(), &Spectral::default(), &Nncg::default(), &Admm::default(),
        ];
        for solver in solvers {
            for x in iterates(solver, &m.lcp) {
                for i in 0..x.len() {
                    prop_assert!(m.lcp.lo()[i] <= x[i] && x[i] <= m.lcp.hi()[i], "{}", solver.name());
                }
            }
        }
    }

    #[test]
    fn the_unit_of_impulses_changes_no_step_of_mprgp(m in manufactured(8, 5, 0.25)) {
        for unit in [2f64.powi(-40), 2f64.powi(40)] {
            let of = |v: &[f64]| v.iter().map(|v| v * unit).collect::<Vec<_>>();
            let (a, b) = (m.lcp.matrix().clone(), of(m.lcp.b()));
            let scaled = Lcp::new(a, b, of(m.lcp.lo()), of(m.lcp.hi())).unwrap();
            let expected: Vec<_> = iterates(&Mprgp::default(), &m.lcp).iter().map(|x| of(x)).collect();
            prop_assert_eq!(iterates(&Mprgp::default(), &scaled), expected);
        }
    }

    #[test]
    fn mprgp_solves_singular_problems(m in manufactured(8, 4, 0.0)) {
        prop_assume!((0..8).all(|i| m.lcp.matrix().diagonal(i) > 0.0));
        let solution = Mprgp::default().solve(&m.lcp, &Start::default(), &mut ());
        prop_assert_eq!(&solution.status, &Status::Solved);
    }
}
