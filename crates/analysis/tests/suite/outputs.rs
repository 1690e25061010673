//! Pinned answers of every solver on one problem of each family: a table with status, iterations
//! and verdict. A new solver adds one line to each file.
//!
//! x and w are stated once. A solver with another solution states its own at the end of its line;
//! the three methods of the chapter always do on the chapter's problem, the frictionless column.
//!
//! A number is pinned only after the judge, which knows no solver, accepted its answer; for an
//! unclaimed answer only status and iterations are pinned. If the textbook has the same method, its
//! first iterates are pinned too, and must equal the textbook's.

use lcplab_judge::{Demand, Verdict, judge};
use lcplab_lcp::Lcp;
use lcplab_lcp::library::{self, Family};
use lcplab_page::number::significant;
use lcplab_solver::textbook::{self, Matrix, Vector};
use lcplab_solver::{Damping, Entry, Options, Registry, Settings, Start, Status};

use lcplab_testing::iterates;

/// The number of entries shown of longer vectors.
const SHOWN: usize = 8;
/// A number below this fraction of the largest entry is rounding.
const ROUNDING: f64 = 1e-9;
/// Two solutions are the same if they differ by at most this fraction of the largest entry.
const SAME: f64 = 1e-6;
/// The solvers whose solution is stated once, in order: those that are exact up to rounding.
const REFERENCES: [&str; 3] = ["dantzig", "lemke", "enumeration"];
/// The methods of the chapter, and the problem on which each states its own x and w.
const OWN: [&str; 3] = ["pgs", "sor", "dantzig"];
const CHAPTER: &str = "stack";

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

/// An answer that its solver claims and the judge accepts.
#[derive(Debug, Clone)]
struct Claim {
    x: Vec<f64>,
    w: Vec<f64>,
}

impl Claim {
    /// x and w as text.
    fn entries(&self, lcp: &Lcp) -> [String; 2] {
        [vector(&self.x, largest(&self.x)), vector(&self.w, largest(lcp.b()))]
    }

    /// Whether x, and whether w, is the same up to the solvers' tolerance.
    fn agreement(&self, other: &Claim, lcp: &Lcp) -> [bool; 2] {
        let is_close = |u: &[f64], v: &[f64], unit: f64| {
            u.iter().zip(v).all(|(u, v)| (u - v).abs() <= SAME * unit)
        };
        [
            is_close(&self.x, &other.x, largest(&other.x)),
            is_close(&self.w, &other.w, largest(lcp.b())),
        ]
    }
}

/// Status, iterations and verdict of a solver as a line, and its claim.
fn answer(lcp: &Lcp, entry: &Entry) -> (String, Option<Claim>) {
    let settings = Settings::default().with_tolerance(1e-10).with_max_iterations(20_000);
    let solver = entry.build(&Options::default().with_settings(settings));
    let solution = solver.solve(lcp, &Start::default(), &mut ());
    let unit = entry.group.unit();
    let unit = if solution.iterations == 1 { unit.trim_end_matches('s') } else { unit };
    let iterations = format!("{} {unit}", solution.iterations);
    let status = solution.status.to_string();
    let line =
        |verdict: &str| format!("{:<15} | {status:<16} | {iterations:<13} | {verdict}", entry.name);
    if solution.status != Status::Solved {
        return (line("–"), None);
    }
    let verdict =
        judge(lcp, &solution.x, &Demand { tolerance: 1e-10, ..Demand::default() }).verdict;
    let word = match &verdict {
        Verdict::Proved { .. } => "proved",
        Verdict::WithinTolerance => "within tolerance",
        _ => panic!("{} claims what is rejected: {verdict}", entry.name),
    };
    let w = lcp.w(&solution.x);
    (line(word), Some(Claim { x: solution.x, w }))
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
    let settings = Settings::default().with_tolerance(0.0).with_max_iterations(3);
    let options = Options::default().with_settings(settings).with_damping(Damping::Factor(1.0));
    let own = iterates(&*Registry::standard().entry(name).unwrap().build(&options), lcp);
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

/// A line for each solver, and the solution that its claim is compared with: that of the first in
/// [`REFERENCES`] that has one, otherwise of the first solver that has one.
fn table(family: &dyn Family, lcp: &Lcp) -> String {
    let answers: Vec<_> =
        Registry::standard().entries().map(|entry| (&*entry.name, answer(lcp, entry))).collect();
    let claims = || answers.iter().filter_map(|(name, (_, claim))| Some((*name, claim.as_ref()?)));
    let exact = REFERENCES.iter().find_map(|exact| claims().find(|(name, _)| name == exact));
    let reference = exact.or_else(|| claims().next());
    let mut text =
        format!("{:<15} | {:<16} | {:<13} | verdict\n", "solver", "status", "iterations");
    for (name, (line, claim)) in &answers {
        text += line;
        if let (Some(claim), Some((_, reference))) = (claim, reference) {
            let is_own = family.name() == CHAPTER && OWN.contains(name);
            let agrees = claim.agreement(reference, lcp);
            for (k, entries) in claim.entries(lcp).iter().enumerate() {
                if is_own || !agrees[k] {
                    text += &format!(" | {} = {entries}", ["x", "w"][k]);
                }
            }
        }
        text += "\n";
    }
    if let Some((name, reference)) = reference {
        let [x, w] = reference.entries(lcp);
        text += &format!(
            "\nx and w of {name}, and of every solver that states no other\n  x = {x}\n  w = {w}\n"
        );
    }
    text
}

fn outputs(family: &dyn Family) -> String {
    let lcp = family.generate(&[]).unwrap().lcp;
    let mut text = format!("{}: {} rows\n\n{}", family.about(), lcp.len(), table(family, &lcp));
    for (heading, name, twin) in SWEEPS.into_iter().filter(|_| is_plain(&lcp)) {
        text += &format!("\n{heading}\n{}", sweeps(&lcp, name, twin));
    }
    text
}

#[test]
fn every_solver_answers_as_it_did() {
    for family in library::all() {
        insta::assert_snapshot!(family.name(), outputs(family));
    }
}
