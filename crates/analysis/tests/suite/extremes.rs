//! Numbers near the limits of doubles: no solver makes a false claim.

use lcplab_analysis::answer::Answer;
use lcplab_judge::Demand;
use lcplab_lcp::{Lcp, Matrix};
use lcplab_solver::{Options, Registry, Settings, Start, Status};
use proptest::prelude::*;

use lcplab_testing::{INF, cases};

/// A problem with a solution: integers, masses and units are such that b = w − A x is exact.
#[derive(Debug, Clone)]
struct Feasible {
    /// Rows of J, entries −1, 0, 1.
    j: Vec<[i8; COLUMNS]>,
    /// x and w of each row, at most one of them above 0, and whether the row is an equation.
    rows: Vec<(bool, u8, u8)>,
    /// Masses 2^k of the columns.
    masses: Vec<i32>,
    /// Units 2^k of the rows: x → x / d, w → d w.
    units: Vec<i32>,
    /// x and w are 2^k times as large.
    load: i32,
    /// Zeros with a minus sign.
    negative: u64,
}

const ROWS: usize = 5;
const COLUMNS: usize = 4;

impl Feasible {
    fn lcp(&self) -> Lcp {
        let entry = |r: usize, c: usize| -> f64 {
            let products = self.j[r].iter().zip(&self.j[c]).zip(&self.masses);
            products.map(|((&a, &b), &m)| f64::from(a * b) * 2f64.powi(-m)).sum()
        };
        let unit = |r: usize| 2f64.powi(self.units[r]);
        let zero = |k: usize, value: f64| {
            if value == 0.0 && self.negative >> (k % 64) & 1 == 1 { -0.0 } else { value }
        };
        let load = |value: f64| times_power_of_two(value, self.load);
        let a: Vec<f64> = (0..ROWS * ROWS)
            .map(|k| (k / ROWS, k % ROWS))
            .map(|(r, c)| zero(7 * r + c, entry(r, c) * unit(r) * unit(c)))
            .collect();
        let (x, w): (Vec<f64>, Vec<f64>) = self
            .rows
            .iter()
            .map(|&(is_equation, x, w)| match is_equation || x > w {
                true => (f64::from(x), 0.0),
                false => (0.0, f64::from(w)),
            })
            .unzip();
        let b = (0..ROWS)
            .map(|r| {
                let pushed: f64 = (0..ROWS).map(|c| entry(r, c) * x[c]).sum();
                zero(40 + r, load((w[r] - pushed) * unit(r)))
            })
            .collect();
        let lo =
            self.rows.iter().enumerate().map(|(r, row)| if row.0 { -INF } else { zero(r, 0.0) });
        Lcp::new(Matrix::dense(ROWS, &a), b, lo.collect(), vec![INF; ROWS]).unwrap()
    }
}

/// value · 2^k, even if 2^k itself is not a double.
fn times_power_of_two(value: f64, k: i32) -> f64 {
    value * 2f64.powi(k / 2) * 2f64.powi(k - k / 2)
}

fn feasible(
    unit: i32,
    mass: i32,
    load: std::ops::RangeInclusive<i32>,
) -> impl Strategy<Value = Feasible> {
    let j = proptest::collection::vec(proptest::array::uniform4(-1i8..=1), ROWS);
    let rows = proptest::collection::vec((proptest::bool::weighted(0.2), 0u8..8, 0u8..8), ROWS);
    let powers = |k: i32, n: usize| proptest::collection::vec(-k..=k, n);
    (j, rows, powers(mass / 2, COLUMNS), powers(unit, ROWS), load, any::<u64>()).prop_map(
        |(j, rows, masses, units, load, negative)| Feasible {
            j,
            rows,
            masses,
            units,
            load,
            negative,
        },
    )
}

/// Requirements on every solver for a problem with a solution.
fn makes_no_false_claim(lcp: &Lcp) -> Result<(), TestCaseError> {
    let settings = Settings::default().with_max_iterations(300);
    for entry in Registry::standard().entries() {
        let solver = entry.build(&Options::default().with_settings(settings.clone()));
        let solution = solver.solve(lcp, &Start::default(), &mut ());
        prop_assert!(solution.x.iter().all(|x| x.is_finite()), "{}: {:?}", entry.name, solution.x);
        let claims = solution.status == Status::Solved;
        let answer = Answer::judged(lcp, &*entry.name, solution, &Demand::default());
        prop_assert!(answer.status_word() != "infeasible", "{}: {}", entry.name, answer.message());
        let verdict = &answer.certificate.verdict;
        prop_assert!(!claims || verdict.is_solution(), "{}: {verdict}", entry.name);
    }
    Ok(())
}

proptest! {
    #![proptest_config(cases(150))]

    #[test]
    fn entries_from_1e_minus_24_to_1e24(problem in feasible(40, 0, 0..=0)) {
        makes_no_false_claim(&problem.lcp())?;
    }

    #[test]
    fn mass_ratios_to_1e12(problem in feasible(0, 40, 0..=0)) {
        makes_no_false_claim(&problem.lcp())?;
    }

    #[test]
    fn masses_and_units_far_apart(problem in feasible(20, 40, -100..=100)) {
        makes_no_false_claim(&problem.lcp())?;
    }

    #[test]
    fn subnormal_loads(problem in feasible(0, 0, -1070..=-1010)) {
        makes_no_false_claim(&problem.lcp())?;
    }
}

/// x = 10⁶⁰⁰ solves the first row, but is not a 64-bit number.
#[test]
fn a_solution_beyond_the_largest_number_is_not_denied() {
    for rest in [vec![], vec![1.0]] {
        let entries: Vec<_> = [1e-300].iter().chain(&rest).copied().enumerate().collect();
        let n = entries.len();
        let matrix =
            Matrix::sparse(n, &entries.iter().map(|&(i, a)| (i, i, a)).collect::<Vec<_>>());
        let b = [-1e300, -1.0][..n].to_vec();
        let lcp = Lcp::new(matrix, b, vec![0.0; n], vec![INF; n]).unwrap();
        for entry in Registry::standard().entries() {
            let solver = entry.build(&Options::default());
            let status = solver.solve(&lcp, &Start::default(), &mut ()).status;
            let denied = matches!(
                status,
                Status::Ray { .. } | Status::NoSolution | Status::OutsideClass { .. }
            );
            assert!(!denied && status != Status::Solved, "{}: {status}", entry.name);
        }
    }
}
