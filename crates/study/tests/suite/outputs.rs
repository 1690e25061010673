//! Pinned answers of every solver on one problem of each family: status, count, verdict, x and w.
//!
//! A number is pinned only after the judge, which knows no solver, accepted its answer; for an
//! unclaimed answer only status and count are pinned. If the textbook has the same method, its
//! first iterates are pinned too, and must equal the textbook's.

use lcplab_judge::{Demand, Verdict, judge};
use lcplab_page::number::significant;
use lcplab_problem::Lcp;
use lcplab_problem::library::{self, Family};
use lcplab_solver::textbook::{self, Matrix, Vector};
use lcplab_solver::{ALL, Damping, Options, Settings, Start, Status, by_name};

use lcplab_testing::iterates;

/// The number of entries shown of longer vectors.
const SHOWN: usize = 8;
/// A number below this fraction of the largest entry is rounding.
const ROUNDING: f64 = 1e-9;

/// The first entries to six digits.
fn vector(v: &[f64], unit: f64) -> String {
    let entry = |&v: &f64| match v {
        v if v.abs() <= ROUNDING * unit => "0".to_string(),
        v => significant(v, 6),
    };
    let shown: Vec<String> = v.iter().take(SHOWN).map(entry).collect();
    let more = if v.len() > SHOWN { " …" } else { "" };
    format!("{}{more}", shown.join(" "))
}

fn largest(v: &[f64]) -> f64 {
    v.iter().fold(0.0, |most: f64, v| most.max(v.abs()))
}

/// A solver's answer in one to three lines.
fn answer(lcp: &Lcp, name: &str) -> String {
    let settings = Settings { tolerance: 1e-10, max_iterations: 20_000, ..Settings::default() };
    let solver = by_name(name, &Options { settings, ..Options::default() }).unwrap();
    let solution = solver.solve(lcp, &Start::default(), &mut ());
    let head = format!("{name}: {}, {}", solution.status, solution.iterations);
    if solution.status != Status::Solved {
        return head + "\n";
    }
    let verdict =
        judge(lcp, &solution.x, &Demand { tolerance: 1e-10, ..Demand::default() }).verdict;
    let word = match &verdict {
        Verdict::Proved { .. } => "proved",
        Verdict::WithinTolerance => "within tolerance",
        Verdict::NotASolution { .. } => panic!("{name} claims what is refuted: {verdict}"),
    };
    let w = lcp.w(&solution.x);

    let unit = largest(lcp.b());
    let x = vector(&solution.x, largest(&solution.x));
    format!("{head}, {word}\n  x = {x}\n  w = {}\n", vector(&w, unit))
}

/// A sweep method of the textbook, run for this number of sweeps.
type Twin = fn(&Matrix, &Vector, &Vector, &Vector, usize) -> Vector;

/// Textbook methods that sweep: the heading, the solver and the textbook function.
const SWEEPS: [(&str, &str, Twin); 2] = [
    ("Jacobi from 0", "jacobi", |a, b, lo, hi, k| textbook::jacobi(a, b, lo, hi, 1.0, k)),
    ("Gauss-Seidel from 0", "pgs", textbook::gauss_seidel),
];

/// The first sweeps of a method, which equal those of the textbook.
fn sweeps(lcp: &Lcp, name: &str, twin: Twin) -> String {
    let settings = Settings { tolerance: 0.0, max_iterations: 3, ..Settings::default() };
    let options = Options { settings, damping: Damping::Factor(1.0), ..Options::default() };
    let own = iterates(&*by_name(name, &options).unwrap(), lcp);
    let of = |v: &[f64]| Vector::from_column_slice(v);
    let a = lcp.matrix().to_dense();
    let mut text = String::new();
    for (k, x) in own.iter().enumerate().skip(1) {
        let twin = twin(&a, &of(lcp.b()), &of(lcp.lo()), &of(lcp.hi()), k);
        assert!((twin - of(x)).amax() <= 1e-12 * largest(x).max(1e-300), "{name}, sweep {k}");
        text += &format!("  sweep {k}: {}\n", vector(x, largest(x)));
    }
    text
}

/// Whether the textbook supports this problem.
fn is_plain(lcp: &Lcp) -> bool {
    let starts_at_zero = |i: usize| lcp.lo()[i] <= 0.0 && lcp.hi()[i] >= 0.0;
    let has_diagonal = |i: usize| lcp.matrix().diagonal(i) > 0.0;
    lcp.coupling().is_none() && (0..lcp.len()).all(|i| starts_at_zero(i) && has_diagonal(i))
}

fn outputs(family: &dyn Family) -> String {
    let lcp = family.generate(&[]).unwrap().lcp;
    let mut text = format!("{}: {} rows\n", family.about(), lcp.len());
    for (heading, name, twin) in SWEEPS.into_iter().filter(|_| is_plain(&lcp)) {
        text += &format!("\n{heading}\n{}", sweeps(&lcp, name, twin));
    }
    for entry in ALL {
        text += &format!("\n{}", answer(&lcp, entry.name));
    }
    text
}

#[test]
fn every_solver_answers_as_it_did() {
    for family in library::all() {
        insta::assert_snapshot!(family.name(), outputs(family));
    }
}
