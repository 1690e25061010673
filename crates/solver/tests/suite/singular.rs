//! Stacks of cubes with a contact at each corner, 5 to 50 cubes with and without friction: eight
//! singular problems on which the pivoting methods of physics engines fail, and the same
//! regularized.

use lcplab_judge::{Demand, judge};
use lcplab_lcp::{Lcp, Matrix, library};
use lcplab_solver::{Options, Registry, Settings, Start, Status};

const TOLERANCE: f64 = 1e-9;

/// The eight problems for a seed.
fn stacks(seed: u32) -> impl Iterator<Item = (String, Lcp)> {
    let family = library::by_name("box-stack").unwrap();
    let sizes = [0.0, 0.5].into_iter().flat_map(|mu| [5, 10, 20, 50].map(|boxes| (boxes, mu)));
    sizes.map(move |(boxes, mu)| {
        let given = [("boxes", f64::from(boxes)), ("mu", mu), ("seed", f64::from(seed))];
        let problem = family.generate(&given).unwrap();
        (problem.name, problem.lcp)
    })
}

/// A plus 1e-8 times its mean diagonal.
fn regularized(lcp: &Lcp) -> Lcp {
    let n = lcp.len();
    let gamma = 1e-8 * (0..n).map(|i| lcp.matrix().diagonal(i)).sum::<f64>() / n as f64;
    let entries = (0..n).flat_map(|i| lcp.matrix().row(i).iter().map(move |(j, a)| (i, j, a)));
    let added = (0..n).map(|i| (i, i, gamma));
    let matrix = Matrix::sparse(n, &entries.chain(added).collect::<Vec<_>>());
    Lcp::new(matrix, lcp.b().to_vec(), lcp.lo().to_vec(), lcp.hi().to_vec()).unwrap()
}

/// The number of problems that a solver claims to have solved; the judge accepts each claim.
fn solved(solver: &str, problems: impl Iterator<Item = (String, Lcp)>) -> usize {
    let settings = Settings::default().with_tolerance(TOLERANCE);
    let solver = Registry::standard()
        .entry(solver)
        .unwrap()
        .build(&Options::default().with_settings(settings));
    let claims = problems.filter(|(name, lcp)| {
        let solution = solver.solve(lcp, &Start::default(), &mut ());
        let demand = Demand { tolerance: TOLERANCE, prove_up_to: 0 };
        let verdict = judge(lcp, &solution.x, &demand).verdict;
        let claims = solution.status == Status::Solved;
        assert!(!claims || verdict.is_solution(), "{} on {name}: {verdict}", solver.name());
        claims
    });
    claims.count()
}

#[test]
fn four_contacts_a_face_leave_a_rank_of_three_quarters_without_friction_and_a_half_with() {
    for (boxes, mu, rank) in [(4.0, 0.0, 3 * 4), (4.0, 0.5, 6 * 4)] {
        let family = library::by_name("box-stack").unwrap();
        let lcp = family.generate(&[("boxes", boxes), ("mu", mu)]).unwrap().lcp;
        let values = lcp.matrix().to_dense().symmetric_eigenvalues();
        assert_eq!(values.iter().filter(|value| **value > 1e-9).count(), rank);
        assert!(lcp.matrix().is_symmetric() && values.min() > -1e-12);
    }
}

#[test]
fn three_solvers_solve_eight_of_eight_and_the_regularized_ones() {
    for solver in ["dantzig", "interior-point", "block-pivoting"] {
        assert_eq!(solved(solver, stacks(1)), 8, "{solver}");
        let regularized = stacks(1).map(|(name, lcp)| (name, regularized(&lcp)));
        assert_eq!(solved(solver, regularized), 8, "{solver}, regularized");
    }
}

#[test]
fn interior_point_and_block_pivoting_solve_them_whatever_the_velocities() {
    for seed in 2..12 {
        for solver in ["interior-point", "block-pivoting"] {
            assert_eq!(solved(solver, stacks(seed)), 8, "{solver}, seed {seed}");
        }
    }
}
