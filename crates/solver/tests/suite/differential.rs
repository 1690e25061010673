//! Thousands of small integer problems, often degenerate, compared with exact enumeration.

use lcplab_judge::{Demand, judge, ray};
use lcplab_lcp::{Lcp, Matrix};
use lcplab_solver::{Options, Registry, Settings, Solution, Solver, Start, Status, all_solutions};

use lcplab_testing::INF;

/// Integers from a linear congruential generator (Knuth's MMIX), high bits first.
struct Dice(u64);

impl Dice {
    fn roll(&mut self, least: i64, most: i64) -> f64 {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (least + ((self.0 >> 33) % (most - least + 1) as u64) as i64) as f64
    }
}

#[derive(Clone, Copy, PartialEq, Debug)]
enum Kind {
    /// J Jᵀ, of full rank or not.
    Semidefinite,
    /// A dominant positive diagonal: a P-matrix, not symmetric.
    Dominant,
    /// Anything.
    General,
}

fn problem(dice: &mut Dice, kind: Kind) -> Lcp {
    let n = dice.roll(1, 4) as usize;
    let columns = dice.roll(1, n as i64) as usize;
    let j: Vec<f64> = (0..n * columns).map(|_| dice.roll(-2, 2)).collect();
    let gram =
        |r: usize, c: usize| (0..columns).map(|k| j[r * columns + k] * j[c * columns + k]).sum();
    let mut a: Vec<f64> = (0..n * n).map(|_| dice.roll(-2, 2)).collect();
    for i in 0..n {
        for k in 0..n {
            match kind {
                Kind::Semidefinite => a[i * n + k] = gram(i, k),
                Kind::Dominant if i == k => a[i * n + k] = 2.0 * n as f64,
                _ => {}
            }
        }
    }
    let b = (0..n).map(|_| dice.roll(-3, 3)).collect();
    let (lo, hi) = (0..n)
        .map(|_| match dice.roll(0, 9) as u8 {
            0 => (-INF, INF),
            1 => (-INF, dice.roll(-1, 1)),
            2 => (1.0, 1.0),
            3 | 4 => (-1.0, dice.roll(0, 2)),
            _ => (0.0, INF),
        })
        .unzip();
    Lcp::new(Matrix::dense(n, &a), b, lo, hi).unwrap()
}

/// Solves with every solver and compares each claim with the list of all solutions.
fn check(kind: Kind, seed: u64, count: usize, must_solve: &[&str]) {
    println!("seed {seed}");
    let mut dice = Dice(seed);
    let settings = Settings::default().with_max_iterations(1000);
    let options = Options::default().with_settings(settings);
    let solvers: Vec<Box<dyn Solver>> =
        Registry::standard().entries().map(|entry| entry.build(&options)).collect();
    for number in 0..count {
        let lcp = problem(&mut dice, kind);
        let exact = all_solutions(&lcp).expect("few enough sets");
        let place = |solver: &str| format!("{solver}, problem {number} of seed {seed}: {lcp:?}");
        for solver in &solvers {
            let Solution { x, status, .. } = solver.solve(&lcp, &Start::default(), &mut ());
            let name = solver.name();
            match &status {
                Status::Solved => {
                    assert!(!exact.is_empty(), "{} has no solution", place(name));
                    let verdict = judge(&lcp, &x, &Demand::default()).verdict;
                    assert!(verdict.is_solution(), "{verdict}: {}", place(name));
                }
                Status::NoSolution => assert!(exact.is_empty(), "{}", place(name)),
                Status::Ray { row, direction } => {
                    if let Some(proof) = ray::refute(&lcp, *row, direction) {
                        assert!(exact.is_empty(), "{proof:?} {}", place(name));
                    } else if kind == Kind::Semidefinite {
                        panic!("a ray that proves nothing: {direction:?} {}", place(name));
                    }
                }
                _ => {}
            }
            if must_solve.contains(&name) && !exact.is_empty() {
                assert_eq!(status, Status::Solved, "{}", place(name));
            }
        }
    }
}

#[test]
fn semidefinite_problems() {
    check(Kind::Semidefinite, 1, 4000, &["dantzig", "lemke", "enumeration"]);
}

#[test]
fn p_matrices() {
    check(Kind::Dominant, 2, 3000, &["lemke", "murty", "block-pivoting", "enumeration"]);
}

#[test]
fn general_matrices() {
    check(Kind::General, 3, 3000, &["enumeration"]);
}
