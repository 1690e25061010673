//! The textbook's functions and the solvers give the same x on problems without ties.

use lcplab_lcp::{Lcp, Matrix as Entries};
use lcplab_solver::textbook::{self, Matrix, Vector};
use lcplab_solver::{Damping, Jacobi, Pgs, Registry, Settings, Solver, Start, Status};
use oorandom::Rand64;

use lcplab_testing::{INF, iterates};

const PROBLEMS: u64 = 1000;

struct Problem {
    a: Matrix,
    b: Vector,
    lo: Vector,
    hi: Vector,
}

impl Problem {
    /// One to eight rows, A = JJᵀ + 1 and, if it is unsymmetric, a skew part: a P-matrix either
    /// way.
    fn random(seed: u64, is_symmetric: bool, is_boxed: bool) -> Self {
        let mut random = Rand64::new(seed.into());
        let n = 1 + seed as usize % 8;
        let mut number = || 2.0 * random.rand_float() - 1.0;
        let j = Matrix::from_fn(n, n, |_, _| number());
        let skew = Matrix::from_fn(n, n, |_, _| if is_symmetric { 0.0 } else { number() });
        let a = &j * j.transpose() + Matrix::identity(n, n) + &skew - skew.transpose();
        let b = Vector::from_fn(n, |_, _| 3.0 * number());
        let lo = Vector::from_fn(n, |_, _| if is_boxed { number() - 1.0 } else { 0.0 });
        let hi = Vector::from_fn(n, |_, _| if is_boxed { number() + 1.0 } else { INF });
        Problem { a, b, lo, hi }
    }

    fn lcp(&self) -> Lcp {
        let of = |v: &Vector| v.as_slice().to_vec();
        let a = Entries::from(self.a.as_view());
        Lcp::new(a, of(&self.b), of(&self.lo), of(&self.hi)).unwrap()
    }

    #[track_caller]
    fn assert_same(&self, solver: &str, x: &Vector, accuracy: f64) {
        let strong = Registry::standard().entry(solver).unwrap().build(&Default::default());
        let solution = strong.solve(&self.lcp(), &Start::default(), &mut ());
        assert_eq!(solution.status, Status::Solved);
        let apart = (x - Vector::from_vec(solution.x)).amax();
        assert!(apart <= accuracy * x.amax().max(1.0), "{apart}");
    }
}

fn problems(is_symmetric: bool, is_boxed: bool) -> impl Iterator<Item = Problem> {
    (0..PROBLEMS).map(move |seed| Problem::random(seed, is_symmetric, is_boxed))
}

#[test]
fn a_sweep_of_the_textbook_is_a_sweep_of_the_solver() {
    for Problem { a, b, lo, hi } in problems(true, true) {
        let lcp = Problem { a: a.clone(), b: b.clone(), lo: lo.clone(), hi: hi.clone() }.lcp();
        let settings = Settings::default().with_tolerance(0.0).with_max_iterations(5);
        let pgs = Pgs { settings: settings.clone(), ..Pgs::default() };
        let jacobi = Jacobi { damping: Damping::Factor(0.7), settings };
        let strong: [&dyn Solver; 2] = [&pgs, &jacobi];
        for (k, solver) in strong.into_iter().enumerate() {
            for (sweeps, x) in iterates(solver, &lcp).iter().enumerate() {
                let own = match k {
                    0 => textbook::gauss_seidel(&a, &b, &lo, &hi, sweeps),
                    _ => textbook::jacobi(&a, &b, &lo, &hi, 0.7, sweeps),
                };
                // The solvers start from Π(0), the textbook from 0: the same if 0 is allowed.
                assert!((own - Vector::from_column_slice(x)).amax() < 1e-13, "{sweeps} of {k}");
            }
        }
    }
}

#[test]
fn factors_multiply_to_the_matrix_and_solve() {
    for Problem { a, b, .. } in problems(true, false) {
        let (l, d) = textbook::ldlt(&a);
        assert!((&l * Matrix::from_diagonal(&d) * l.transpose() - &a).amax() < 1e-13);
        assert!((&a * textbook::solve(&l, &d, &b) - b).amax() < 1e-12);
    }
}

#[test]
fn murty_and_lemke_of_the_textbook_find_the_solvers_x() {
    for problem in problems(false, false) {
        problem.assert_same("murty", &textbook::murty(&problem.a, &problem.b), 1e-10);
        problem.assert_same("lemke", &textbook::lemke(&problem.a, &problem.b).unwrap(), 1e-10);
    }
}

#[test]
fn dantzig_of_the_textbook_finds_the_solvers_x_in_a_box() {
    for problem in problems(true, true) {
        let Problem { a, b, lo, hi } = &problem;
        problem.assert_same("dantzig", &textbook::dantzig(a, b, lo, hi), 1e-10);
    }
}

#[test]
fn newton_of_the_textbook_finds_dantzigs_x_in_a_box() {
    for Problem { a, b, lo, hi } in problems(true, true) {
        let x = textbook::newton(&a, &b, &lo, &hi, 20);
        assert!((x - textbook::dantzig(&a, &b, &lo, &hi)).amax() < 1e-10);
    }
}

/// A string of 2 m + 4 points under an even load is pressed against a bar at m²/2: where it is
/// free, x is the parabola i (2 m − i)/2, and it leaves the bar with half of the largest slope.
fn string<T: textbook::Real>(m: usize) {
    let (n, of) = (2 * m + 4, |v: f64| T::nearest(v));
    let a = textbook::Matrix::from_fn(n, n, |i, j| match i.abs_diff(j) {
        0 => of(2.0),
        1 => of(-1.0),
        _ => of(0.0),
    });
    let all = |v: f64| textbook::Vector::repeat(n, of(v));
    let bar = (m * m) as f64 / 2.0;
    let x = textbook::newton(&a, &all(-1.0), &all(-INF), &all(bar), 100);
    for k in 0..n {
        let i = (k + 1).min(n - k);
        let known = if i < m { (i * (2 * m - i)) as f64 / 2.0 } else { bar };
        assert_eq!(x[k] == of(bar), i >= m, "{k}: {}", x[k]);
        let rounding = T::default_epsilon().double() * (m * m * m) as f64;
        assert!((x[k].double() - known).abs() <= rounding, "{k}: {} of {known}", x[k]);
    }
}

#[test]
fn newton_of_the_textbook_finds_the_sides_of_a_string_in_both_precisions() {
    for m in 1..=20 {
        string::<f64>(m);
        string::<f32>(m);
    }
}

/// Small integers: rows with w = 0 from the start, between their bounds and at them, pinned rows,
/// ties.
#[test]
fn dantzig_of_the_textbook_finds_the_solvers_x_where_many_numbers_are_equal() {
    for seed in 0..PROBLEMS {
        let mut random = Rand64::new(seed.into());
        let n = 1 + seed as usize % 6;
        let mut whole =
            |least: i64, most: i64| random.rand_range(0..(most - least + 1) as u64) as i64 + least;
        let j = Matrix::from_fn(n, n, |_, _| whole(-1, 1) as f64);
        let a = &j * j.transpose() + Matrix::identity(n, n);
        let b = Vector::from_fn(n, |_, _| whole(-1, 1) as f64);
        let lo = Vector::from_fn(n, |_, _| whole(-1, 0) as f64);
        let hi = Vector::from_fn(n, |_, _| whole(0, 1) as f64);
        let problem = Problem { a, b, lo, hi };
        let Problem { a, b, lo, hi } = &problem;
        problem.assert_same("dantzig", &textbook::dantzig(a, b, lo, hi), 1e-10);
    }
}

#[test]
fn the_interior_point_of_the_textbook_comes_to_the_solvers_x() {
    for problem in problems(true, false) {
        problem.assert_same(
            "interior-point",
            &textbook::interior_point(&problem.a, &problem.b, 40),
            1e-6,
        );
    }
}

#[test]
fn lemke_of_the_textbook_ends_on_a_ray_where_there_is_no_solution() {
    // w₀ = −x₀ − 1 < 0 for all x ≥ 0.
    let (a, b) = (Matrix::from_element(1, 1, -1.0), Vector::from_element(1, -1.0));
    assert_eq!(textbook::lemke(&a, &b), None);
}
