//! What solvers say of their answers.

use lcplab::lcp::{Coupling, Lcp, Matrix};
use lcplab::memory::Memory;
use lcplab::plugin::Plugin;
use lcplab::solver::{Options, Registry, Settings, Start, Status, Stop};

use lcplab_testing::{INF, boxed, contacts};

/// The status of a solver of the library on a problem from 0.
fn said(solver: &str, lcp: &Lcp, settings: Settings) -> Status {
    said_by(Registry::standard(), solver, lcp, settings)
}

fn said_by(solvers: &Registry, solver: &str, lcp: &Lcp, settings: Settings) -> Status {
    let options = Options::default().with_settings(settings);
    let solver = solvers.entry(solver).unwrap().build(&options);
    let solution = solver.solve(lcp, &Start::default(), &mut ());
    assert!(solution.x.iter().all(|x| x.is_finite()), "{:?}", solution.x);
    solution.status
}

#[test]
fn every_status_is_claimed_by_a_solver_and_put_into_words() {
    let usual = Settings::default;
    let one = boxed(&[&[2.0]], &[-6.0], &[0.0], &[INF]); // x = 3
    let pair = contacts(&[&[2.0, -1.0], &[-1.0, 2.0]], &[-3.0, -3.0]); // x = (3, 3)
    // x = (0.0005, 0.3335): x₂ has to be rounded, by more than x₁ can make good.
    let no_float = contacts(&[&[1.0, 1.0], &[1.0, 3.0]], &[-0.334, -1.001]);
    let exactly = usual().with_tolerance(0.0);
    let one_sweep = usual().with_max_iterations(1);
    // A row coupled with μ = 2 and pushed beyond its bound: x_t = 2 x_n, x_n ← max(0, 1 − x_t).
    // Frozen bounds make x_n go 0, 1, 0, 1, …
    let matrix = Matrix::dense(2, &[1.0, 1.0, 1.0, 2.0]);
    let rubbing = Lcp::new(matrix, vec![-1.0, -100.0], vec![0.0, -INF], vec![INF; 2]).unwrap();
    let coupling = Coupling::new(vec![None, Some(0)], vec![0.0, 2.0]).unwrap();
    let rubbing = rubbing.with_coupling(coupling).unwrap();
    // Gauss-Seidel multiplies by 10⁸ a sweep.
    let indefinite = boxed(&[&[1.0, 1e4], &[1e4, 1.0]], &[1.0; 2], &[-INF; 2], &[INF; 2]);
    let beyond = boxed(&[&[1e-300]], &[-1e300], &[0.0], &[INF]); // x = 10⁶⁰⁰
    let flat = contacts(&[&[1.0, 0.0], &[0.0, 0.0]], &[-1.0; 2]);
    let dependent = contacts(&[&[1.0, 1.0], &[2.0, 2.0]], &[-1.0, -2.1]);
    let torn = boxed(&[&[0.0]], &[-1.0], &[0.0], &[INF]); // w = −1 whatever x is
    let negative = boxed(&[&[-1.0]], &[-1.0], &[0.0], &[INF]); // w = −x − 1 < 0 for x ≥ 0
    let skew = contacts(&[&[1.0, 1.0], &[-1.0, 1.0]], &[-1.0; 2]);
    let stopped = || {
        let stop = Stop::default();
        stop.raise();
        let pgs = Registry::standard().entry("pgs").unwrap().build(&Options::default());
        pgs.solve(&pair, &Start::default(), &mut stop.watch(&mut ())).status
    };
    let small = usual().with_memory(Memory::bytes(1));
    let always_one = r#"short=python3 -c "import sys; [print('{\"x\": [1]}', flush=True) for line in sys.stdin]""#;
    let mut solvers = Registry::default();
    let short = Plugin::start(always_one, 60.0).unwrap();
    short.add_to(&mut solvers).unwrap();
    each_variant! { Status in "crates/solver/src/solution.rs":
        Status::Solved => said("dantzig", &one, usual()), "solved";
        Status::Inaccurate => said("murty", &no_float, exactly.clone()), "ended above the tolerance";
        Status::IterationLimit => said("pgs", &pair, one_sweep.clone()), "iteration limit";
        Status::Stalled => said("lemke", &rubbing, usual()), "no more progress";
        Status::Stopped => stopped(), "stopped by the observer";
        Status::Diverged => said("pgs", &indefinite, usual()), "diverged";
        Status::NotFinite => said("murty", &beyond, usual()), "an iterate was not finite; x is not an answer";
        Status::ZeroDiagonal { .. } => said("pgs", &flat, usual()),
            "the diagonal of row 1 is not positive";
        Status::Singular { .. } => said("block-pivoting", &dependent, usual()), "singular at row 1";
        Status::Ray { .. } => said("lemke", &torn, usual()), "ended on a ray: row 0 is not satisfied (this is not a proof that no solution exists)";
        Status::NoSolution => said("enumeration", &negative, usual()),
            "all active sets were tried, and none gives a solution";
        Status::SetsLeft { .. } => said("enumeration", &pair, one_sweep.clone()),
            "iteration limit: 1 of 4 active sets were tried";
        Status::TooLarge { needs, limit } => said("dantzig", &pair, small.clone()),
            format!("needs {needs}; the limit is {limit}");
        Status::OutsideClass { .. } => said("dantzig", &skew, usual()),
            "outside the solver's class: A is not symmetric";
        Status::NoAnswer { .. } => said_by(&solvers, short.name(), &pair, usual()),
            "no answer: x has length 1, the problem has 2 rows";
    }
}
