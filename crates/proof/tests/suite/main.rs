//! Proofs, compared with closed forms, with all pieces of small problems, and with checkers that
//! share nothing with them.

mod another;
mod bodies;
mod cases;
mod checkers;
mod claims;
mod cones;
mod definite;
mod forged;
mod models;
mod motion;
mod mutants;

use lcplab_lcp::file::Problem;
use lcplab_lcp::{Coupling, Gauss, Lcp, Matrix, Question};
use oorandom::Rand64;

const INF: f64 = f64::INFINITY;

/// A problem with a dense A and the bounds of contacts.
fn contacts(a: &[f64], b: &[f64]) -> Lcp {
    let n = b.len();
    Lcp::new(Matrix::dense(n, a), b.to_vec(), vec![0.0; n], vec![INF; n]).unwrap()
}

/// The numbers as a problem that says nothing else.
fn problem(lcp: &Lcp) -> Problem {
    Problem::new("numbers", lcp.clone())
}

/// The problem under the model that it states.
fn question(problem: &Problem) -> Question {
    Question::new(problem, None, "numbers").unwrap()
}

/// The numbers as a problem without a friction model.
fn asked(lcp: &Lcp) -> Question {
    question(&problem(lcp))
}

/// Painlevé's trouble in two rows: w_n = x_n − x_t − 1, w_t = x_t − x_n − ½, |x_t| ≤ x_n.
fn painleve() -> Lcp {
    let a = Matrix::dense(2, &[1.0, -1.0, -1.0, 1.0]);
    let lcp = Lcp::new(a, vec![-1.0, -0.5], vec![0.0, -INF], vec![INF; 2]).unwrap();
    lcp.with_coupling(Coupling::new(vec![None, Some(0)], vec![0.0, 1.0]).unwrap()).unwrap()
}

/// Small whole numbers: contacts, boxes, equations, or friction in every other problem.
fn whole(random: &mut Rand64, n: usize) -> Lcp {
    let mut number = |most: i64| (random.rand_range(0..(2 * most + 1) as u64) as i64 - most) as f64;
    let is_symmetric = number(1) >= 0.0;
    let mut a = vec![0.0; n * n];
    for i in 0..n {
        for j in 0..n {
            a[i * n + j] = if is_symmetric && j < i { a[j * n + i] } else { number(2) };
        }
    }
    let b: Vec<f64> = (0..n).map(|_| number(3)).collect();
    let bounds: Vec<(f64, f64)> = (0..n)
        .map(|_| match number(2) {
            1.0 => (-1.0, 1.5),
            2.0 => (-INF, INF),
            -2.0 => (-INF, 0.5),
            _ => (0.0, INF),
        })
        .collect();
    let (mut lo, mut hi): (Vec<f64>, Vec<f64>) = bounds.into_iter().unzip();
    let is_rough = n > 1 && number(1) >= 0.0;
    let mut index = vec![None; n];
    if is_rough {
        (lo[0], hi[0]) = (0.0, INF);
        (lo[n - 1], hi[n - 1]) = (-INF, INF);
        index[n - 1] = Some(0);
    }
    let lcp = Lcp::new(Matrix::dense(n, &a), b, lo, hi).unwrap();
    match is_rough {
        true => lcp.with_coupling(Coupling::new(index, vec![0.75; n]).unwrap()).unwrap(),
        false => lcp,
    }
}

/// The same problem with bodies of whole masses, whether A was made from them or not.
fn with_bodies(lcp: &Lcp, random: &mut Rand64) -> Problem {
    let mut number = |most: i64| (random.rand_range(0..(2 * most + 1) as u64) as i64 - most) as f64;
    let (n, k) = (lcp.len(), 2);
    let mass = vec![(0, 0, 3.0 + number(2)), (0, 1, number(1)), (1, 1, 4.0 + number(2))];
    let mut motion =
        Gauss { mass, lo: lcp.lo().to_vec(), hi: lcp.hi().to_vec(), ..Gauss::default() };
    motion.jacobian = (0..n).map(|_| (0..k).map(|j| (j, number(2))).collect()).collect();
    motion.bias = (0..n).map(|_| number(2) / 4.0).collect();
    motion.compliance = (0..n).map(|_| number(1).max(0.0) / 8.0).collect();
    motion.target = (0..k).map(|_| number(3)).collect();
    Problem { motion: Some(motion), ..problem(lcp) }
}
