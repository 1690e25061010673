//! What a search found, as a file, a paragraph and a test case.

use dashu_ratio::RBig;
use serde_json::json;

use lcplab_problem::Lcp;
use lcplab_problem::exact::all_solutions;
use lcplab_problem::file::{Expected, Problem};
use lcplab_problem::number::readable;
use lcplab_solver::{Group, MatrixClass};

use super::measure::{Measure, Trial};
use super::search::Catch;
use crate::card::{Card, class_of};

/// Solutions that are written out at most.
const SHOWN: usize = 3;
/// A fraction with more characters is written as a decimal number; the file has it as it is.
const LONGEST: usize = 24;
/// Problems with more rows are not written as equations.
const WRITTEN_ROWS: usize = 8;

/// A problem that breaks a solver, explained.
#[derive(Debug, Clone)]
pub struct Finding {
    /// The problem, with its exact solutions where all pieces could be tried.
    pub problem: Problem,
    /// What happens on it, what it is like, and what is true.
    pub words: String,
    /// A test in Rust that fails while it happens; of a plug-in, a command whose exit code is 1 while it does.
    pub test: String,
}

impl Finding {
    /// What a search with this seed found.
    pub fn of(catch: &Catch, trial: &Trial, seed: u64) -> Finding {
        let lcp = &catch.lcp;
        let measure = trial.measure;
        let solutions = all_solutions(lcp);
        let title = format!(
            "{measure} of {}, seed {seed}, evaluation {}",
            trial.solver.name, catch.evaluation
        );
        let mut problem = Problem::new(title, lcp.clone());
        problem.extra.insert("source".into(), json!("found by lcplab hunt"));
        if let Some(solutions) = &solutions {
            let expected = Expected { solutions: solutions.clone(), complete: true };
            problem.extra.insert("expected".into(), expected.json());
        }
        let is_unique =
            matches!(class_of(lcp.matrix()), Some(MatrixClass::Definite | MatrixClass::P))
                && lcp.coupling().is_none();
        let truth = solutions.as_deref().map(|all| truth(all, is_unique)).unwrap_or_default();
        let (happens, card) = (trial.words(lcp), Card::of(lcp).words());
        let words = format!("{happens}. The problem has {card}.{truth}");
        let test = test(&problem, trial, catch, solutions.as_deref().unwrap_or_default());
        Finding { problem, words, test }
    }

    /// The problem as equations, row by row; nothing of a large one.
    pub fn equations(&self) -> String {
        let lcp = &self.problem.lcp;
        if lcp.len() > WRITTEN_ROWS {
            return String::new();
        }
        (0..lcp.len()).map(|i| format!("  {}\n", row(lcp, i))).collect()
    }
}

/// w_1 = 2 x_0 − x_1 + 3 and the bounds of x_1.
fn row(lcp: &Lcp, i: usize) -> String {
    let mut sum = String::new();
    let mut add = |value: f64, of: &str| {
        let sign = match (value < 0.0, sum.is_empty()) {
            (true, true) => "−",
            (true, false) => " − ",
            (false, true) => "",
            (false, false) => " + ",
        };
        let size = value.abs();
        let factor = if size == 1.0 && !of.is_empty() { String::new() } else { short(size) + " " };
        sum += sign;
        sum += (factor + of).trim_end();
    };
    for (j, a) in lcp.matrix().row(i).iter().filter(|(_, a)| *a != 0.0) {
        add(a, &format!("x_{j}"));
    }
    if lcp.b()[i] != 0.0 || lcp.matrix().row(i).iter().all(|(_, a)| a == 0.0) {
        add(lcp.b()[i], "");
    }
    let bounds = match lcp.coupled_to(i) {
        Some((k, mu)) => format!("|x_{i}| ≤ {} x_{k}", short(mu)),
        None => match (lcp.lo()[i], lcp.hi()[i]) {
            (lo, hi) if lo == hi => format!("x_{i} = {}", short(lo)),
            (f64::NEG_INFINITY, f64::INFINITY) => format!("x_{i} free"),
            (f64::NEG_INFINITY, hi) => format!("x_{i} ≤ {}", short(hi)),
            (lo, f64::INFINITY) => format!("x_{i} ≥ {}", short(lo)),
            (lo, hi) => format!("{} ≤ x_{i} ≤ {}", short(lo), short(hi)),
        },
    };
    format!("w_{i} = {sum},   {bounds}")
}

/// The shortest text that is read as this number.
fn short(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_string).replace('-', "−")
}

/// What is true, in a sentence.
fn truth(solutions: &[Vec<RBig>], is_unique: bool) -> String {
    let entry = |x: &RBig| match x.to_string() {
        exact if exact.len() <= LONGEST => exact,
        _ => format!("≈ {}", readable(x.to_f64().value(), 7)),
    };
    let vector = |solution: &Vec<RBig>| {
        let entries: Vec<String> = solution.iter().map(entry).collect();
        format!("({})", entries.join(", ").replace('-', "−"))
    };
    let shown: Vec<String> = solutions.iter().take(SHOWN).map(vector).collect();
    match solutions.len() {
        0 => " It has no solution, as all choices of active rows show.".into(),
        1 if is_unique => format!(" Its solution is x = {}.", shown[0]),
        1 => format!(" A solution is x = {}; no other one is apart from it.", shown[0]),
        n if n > SHOWN => format!(" It has {n} solutions apart, such as x = {}.", shown[0]),
        n => format!(" It has {n} solutions apart: x = {}.", shown.join(", ")),
    }
}

/// A test that fails as long as the solver does what was found; of a plug-in, a command.
fn test(problem: &Problem, trial: &Trial, catch: &Catch, solutions: &[Vec<RBig>]) -> String {
    if trial.solver.group == Group::Plugin {
        let most = trial.options.settings.max_iterations;
        return format!(
            "test       lcplab solve PROBLEM --plugin \"COMMAND\" --max-iterations {most}   # exit code 1 until it is mended\n"
        );
    }
    let demand = match trial.measure {
        Measure::Lie => "let verdict = judge(&lcp, &solution.x, &Demand::default()).verdict;\n    \
             assert!(solution.status != Status::Solved || verdict.is_solution(), \"{verdict}\");"
            .to_string(),
        Measure::Failure => "assert_eq!(solution.status, Status::Solved);".to_string(),
        Measure::Error => {
            let exact: Vec<f64> = solutions
                .iter()
                .flatten()
                .take(catch.lcp.len())
                .map(|x| x.to_f64().value())
                .collect();
            format!(
                "let exact = {exact:?}; // the exact solution, rounded\n    \
                 let size = exact.iter().fold(0.0, |most: f64, x| most.max(x.abs()));\n    \
                 let misses = solution.x.iter().zip(exact).map(|(x, exact)| (x - exact).abs());\n    \
                 assert!(misses.fold(0.0, f64::max) < {:e} * size);",
                0.5 * catch.value
            )
        }
        Measure::Iterations => format!("assert!(solution.iterations < {});", catch.iterations),
        Measure::Ratio => {
            let (name, ratio) = (trial.rival.map_or("", |rival| rival.name), catch.value);
            let fewer = format!("assert!(solution.iterations < {});", catch.iterations);
            format!("{fewer} // {ratio:.0} times those of {name}")
        }
    };
    let (name, most) = (trial.solver.name, trial.options.settings.max_iterations);
    let word = name.replace('-', "_");
    format!(
        "#[test]\nfn {}_of_{word}() {{\n    let text = r#\"{}\"#;\n    \
         let lcp = Problem::parse(text, \"hunt\").unwrap().lcp;\n    \
         let settings = Settings {{ max_iterations: {most}, ..Settings::default() }};\n    \
         let options = Options {{ settings, ..Options::default() }};\n    \
         let solver = by_name(\"{name}\", &options).unwrap();\n    \
         let solution = solver.solve(&lcp, &Start::default(), &mut ());\n    {demand}\n}}\n",
        trial.measure,
        problem.to_json(),
    )
}
