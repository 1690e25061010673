//! Numbers over the whole range of doubles: direct solvers are as accurate as LAPACK's, and there
//! are no false claims.
//!
//! The ratio is that of LAPACK's own tests (*LAPACK Working Note 41*, threshold 30): the largest
//! |A x + b| of a free row, divided by n ε (|A|∞ |x|∞ + |b|∞) with ε = 2⁻⁵³ and the norms of the
//! free rows; a row at a bound counts with the part of its w that has the wrong sign. x lies
//! exactly within its bounds.

use lcplab_analysis::hunt::{Claim, claims, problem};
use lcplab_lcp::error::Result;
use lcplab_lcp::{Lcp, Matrix};
use lcplab_solver::{Options, Registry, Settings, Solution, Solver, Start, Status};
use oorandom::Rand64;

use lcplab_testing::{INF, tridiagonal};

/// The threshold of LAPACK's tests.
const MOST: f64 = 30.0;

/// Powers of two by which A and b are multiplied; x scales with b / A.
const UNITS: [(i32, i32); 7] =
    [(0, 0), (500, 500), (-500, -500), (0, 500), (0, -500), (500, 0), (-500, 0)];

fn ratio(lcp: &Lcp, x: &[f64]) -> f64 {
    let size = |v: &mut dyn Iterator<Item = f64>| v.fold(0.0, |size, v| f64::max(size, v.abs()));
    let w = lcp.w(x);
    let (mut error, mut norm, mut load) = (0.0, 0.0, 0.0);
    for i in 0..lcp.len() {
        let (lo, hi) = (lcp.lo()[i], lcp.hi()[i]);
        assert!(lo <= x[i] && x[i] <= hi, "row {i}: {} in [{lo}, {hi}]", x[i]);
        let is_free = lo < x[i] && x[i] < hi;
        let wrong = match is_free {
            true => w[i].abs(),
            false if lo == hi => 0.0,
            false if x[i] == lo => -w[i],
            false => w[i],
        };
        error = f64::max(error, wrong);
        if is_free || wrong > 0.0 {
            norm = f64::max(norm, lcp.matrix().row(i).iter().map(|(_, a)| a.abs()).sum());
            load = f64::max(load, lcp.b()[i].abs());
        }
    }
    let unit = lcp.len() as f64 * f64::EPSILON / 2.0;
    if error == 0.0 { 0.0 } else { error / (unit * (norm * size(&mut x.iter().copied()) + load)) }
}

/// One of the families that the solvers are measured on.
type Family = (&'static str, fn(usize, &mut Rand64) -> Lcp);

const FAMILIES: [Family; 4] = [
    ("dominant", |n, random| posed(gram(n, n, random), n as f64, random)),
    ("near rank n/2", |n, random| posed(gram(n, n.div_ceil(2), random), 1e-6, random)),
    ("full rank", |n, random| posed(gram(n, n, random), 0.0, random)),
    ("stack", |n, random| match n {
        0 => posed(vec![], 0.0, random),
        _ => {
            let a = tridiagonal(n, 1.0);
            posed((0..n * n).map(|k| a.entry(k / n, k % n)).collect(), 0.0, random)
        }
    }),
];

/// J Jᵀ with n rows and this number of columns in −1 … 1.
fn gram(n: usize, columns: usize, random: &mut Rand64) -> Vec<f64> {
    let j: Vec<f64> = (0..n * columns).map(|_| 2.0 * random.rand_float() - 1.0).collect();
    let row = |i: usize| &j[i * columns..(i + 1) * columns];
    let dot = |k: usize| row(k / n).iter().zip(row(k % n)).map(|(a, b)| a * b).sum();
    (0..n * n).map(dot).collect()
}

/// A + shift I with bounds and a b such that half of the rows are free: contacts, equations, boxes.
fn posed(mut a: Vec<f64>, shift: f64, random: &mut Rand64) -> Lcp {
    let n = a.len().isqrt();
    (0..n).for_each(|i| a[i * n + i] += shift);
    let matrix = Matrix::dense(n, &a);
    let (mut lo, mut hi, mut x, mut w) = (vec![0.0; n], vec![INF; n], vec![0.0; n], vec![0.0; n]);
    for i in 0..n {
        let (size, push) = (random.rand_float() + 0.1, random.rand_float() + 0.1);
        match i % 8 {
            1 => (lo[i], hi[i], x[i]) = (-INF, INF, size),
            2 => (lo[i], hi[i], x[i]) = (-1.0, 2.0, size),
            3 => (hi[i], x[i], w[i]) = (size, size, -push),
            k if k % 2 == 0 => x[i] = size,
            _ => w[i] = push,
        }
    }
    let b = (0..n).map(|i| w[i] - matrix.row_dot(i, &x)).collect();
    Lcp::new(matrix, b, lo, hi).unwrap()
}

/// A times 2^of_a, b times 2^of_b, bounds in the resulting unit of x.
fn in_units(lcp: &Lcp, (of_a, of_b): (i32, i32)) -> Result<Lcp> {
    let n = lcp.len();
    let times = |v: f64, k: i32| v * 2f64.powi(k / 2) * 2f64.powi(k - k / 2);
    let all = |v: &[f64], k: i32| v.iter().map(|&v| times(v, k)).collect::<Vec<_>>();
    let a: Vec<f64> = (0..n * n).map(|k| times(lcp.matrix().entry(k / n, k % n), of_a)).collect();
    let of_x = of_b - of_a;
    let (lo, hi) = (all(lcp.lo(), of_x), all(lcp.hi(), of_x));
    let scaled = Lcp::new(Matrix::dense(n, &a), all(lcp.b(), of_b), lo, hi)?;
    match lcp.coupling() {
        Some(coupling) => scaled.with_coupling(coupling.clone()),
        None => Ok(scaled),
    }
}

/// Solves each family of each size in each unit; the worst ratios are in a table.
fn is_backward_stable(solver: &str, tolerance: f64, sizes: &[usize]) {
    let settings = Settings::default().with_tolerance(tolerance);
    let solver = Registry::standard()
        .entry(solver)
        .unwrap()
        .build(&Options::default().with_settings(settings));
    let mut table = format!("| {} |", solver.name());
    let mut worst = 0.0;
    for &n in sizes {
        let mut of_size = 0.0;
        let (families, units) = match n {
            1000 => (&FAMILIES[3..], &UNITS[..3]), // more would take minutes
            _ => (&FAMILIES[..], &UNITS[..]),
        };
        for (k, (family, make)) in families.iter().enumerate() {
            let lcp = make(n, &mut Rand64::new((8 * n + k) as u128));
            for &unit in units {
                let scaled = in_units(&lcp, unit).unwrap();
                let Solution { x, status, .. } = solver.solve(&scaled, &Start::default(), &mut ());
                assert_eq!(status, Status::Solved, "{} {family} {n} {unit:?}", solver.name());
                of_size = f64::max(of_size, ratio(&scaled, &x));
            }
        }
        table += &format!(" {of_size:.2} |");
        worst = f64::max(worst, of_size);
    }
    println!("{table}");
    assert!(worst < MOST, "n = {sizes:?}\n{table}");
}

const LARGE: [usize; 9] = [0, 1, 2, 3, 5, 10, 50, 200, 1000];
/// For solvers that would take minutes for 1000 rows.
const SMALL: &[usize] = LARGE.split_at(8).0;

#[test]
fn dantzig_is_backward_stable() {
    is_backward_stable("dantzig", 1e-8, &LARGE);
}

#[test]
fn block_pivoting_is_backward_stable() {
    is_backward_stable("block-pivoting", 1e-8, &LARGE);
}

#[test]
fn newton_is_backward_stable() {
    is_backward_stable("newton", 1e-14, SMALL); // it ends at the given limit
}

#[test]
fn lemke_is_backward_stable() {
    is_backward_stable("lemke", 1e-8, SMALL);
}

#[test]
fn murty_is_backward_stable() {
    is_backward_stable("murty", 1e-8, &SMALL[..7]); // 200 rows of rank 100 take it too long
}

fn all() -> Vec<Box<dyn Solver>> {
    let settings = Settings::default().with_max_iterations(300);
    let options = Options::default().with_settings(settings);
    Registry::standard().entries().map(|entry| entry.build(&options)).collect()
}

#[test]
fn no_solver_makes_a_false_claim_at_the_ends_of_the_doubles() {
    // Multiples of the smallest double, 2⁻¹⁰⁷⁴, are as exact as those of 2¹⁰⁰⁰.
    let ends = [
        (1000, 1000),
        (-1070, -1070),
        (0, 1000),
        (0, -1070),
        (1000, 0),
        (500, -500),
        (-500, 500),
        (-1000, 0),
    ];
    let solvers = all();
    for end in ends {
        let mut solved = 0;
        for k in 0..60 {
            // An error: a number of the problem leaves the range of doubles in these units.
            let Ok(lcp) = in_units(&problem(19, k).0, end) else { continue };
            for (solver, claim) in claims(&lcp, None, &solvers, 1e-8) {
                assert!(!matches!(claim, Claim::FalseClaim(_)), "{solver} {end:?} {k}: {claim:?}");
                let is_solved = matches!(claim, Claim::Proved | Claim::Within);
                solved += usize::from(solver == "dantzig" && is_solved);
            }
        }
        assert!(solved > 30, "{end:?}: Dantzig solved {solved} only");
    }
}

#[test]
fn minus_zero_is_zero() {
    let minus = |v: f64| if v == 0.0 { -0.0 } else { v };
    let all_minus = |v: &[f64]| v.iter().map(|&v| minus(v)).collect::<Vec<_>>();
    for k in 0..300 {
        let (lcp, _) = problem(20, k);
        let n = lcp.len();
        let a: Vec<f64> = (0..n * n).map(|k| minus(lcp.matrix().entry(k / n, k % n))).collect();
        let [b, lo, hi] = [lcp.b(), lcp.lo(), lcp.hi()].map(all_minus);
        let negative = Lcp::new(Matrix::dense(n, &a), b, lo, hi).unwrap();
        let negative = match lcp.coupling() {
            Some(coupling) => negative.with_coupling(coupling.clone()).unwrap(),
            None => negative,
        };
        for solver in all() {
            let [one, other] =
                [&lcp, &negative].map(|lcp| solver.solve(lcp, &Start::default(), &mut ()));
            assert_eq!(one.x, other.x, "{} {k}", solver.name());
            assert_eq!(one.status, other.status, "{} {k}", solver.name());
        }
    }
}
