//! The result of a search as a file, a paragraph and a test case.

use dashu_ratio::RBig;
use serde_json::json;

use lcplab_lcp::Question;
use lcplab_lcp::exact::all_solutions;
use lcplab_lcp::file::{Expected, Problem, number};
use lcplab_lcp::friction::{Contact, Form, Model};
use lcplab_lcp::number::readable;
use lcplab_solver::{Group, MatrixClass, Settings, Solution, Status};

use super::measure::{Measure, Target};
use super::posing::frozen_at;
use super::right::RightAnswer;
use super::search::Counterexample;
use crate::card::{Card, class_of};
use crate::diagnosis::{Mistake, find_mistakes};

/// Maximum number of solutions that are written out.
const SHOWN: usize = 3;
/// A fraction with more characters is written as a decimal number; the file has the exact fraction.
const LONGEST: usize = 24;
/// Maximum number of rows for which the problem is written as equations.
const WRITTEN_ROWS: usize = 8;
/// Digits of the answers that are printed.
const DIGITS: usize = 7;

/// A problem on which a solver fails, explained.
#[derive(Debug, Clone)]
pub struct Finding {
    /// The problem under its friction model, with its exact solutions if all pieces could be tried,
    /// and with both answers under the key `hunt`.
    pub problem: Problem,
    /// What the solver does on it, its properties, and the true solutions.
    pub words: String,
    /// The x of the solver; `None` if it gave none.
    pub answer: Option<Vec<f64>>,
    /// A correct x for comparison; `None` if none exists or none was found.
    pub right: Option<RightAnswer>,
    /// The known mistakes that give the x of the solver, the nearest first.
    pub mistakes: Vec<Mistake>,
    /// A Rust test that fails as long as the problem occurs; for a plug-in, a command whose exit
    /// code is 1 as long as it does. It ends without a newline.
    pub test: String,
    /// The name of the solver.
    solver: String,
}

impl Finding {
    /// The result of a search with this seed.
    pub fn of(counterexample: &Counterexample, target: &Target, seed: u64) -> Finding {
        let lcp = &counterexample.lcp;
        let measure = target.measure;
        let solver = target.solver.name();
        let title =
            format!("{measure} of {solver}, seed {seed}, evaluation {}", counterexample.evaluation);
        let mut problem = Problem { model: target.model, ..Problem::new(title, lcp.clone()) };
        problem.frozen_at = (target.model == Some(Model::FrozenBox)).then(|| frozen_at(lcp));
        problem.extra.insert("source".into(), json!("found by lcplab hunt"));
        let posed = Question::new(&problem, None, "hunt").expect("a problem that was posed");
        let exact = posed.boxed().and_then(all_solutions);
        if let Some(solutions) = &exact {
            let expected = Expected { solutions: solutions.clone(), complete: true };
            problem.extra.insert("expected".into(), expected.json());
        }
        let solution = target.answer(lcp).expect("a problem that was posed");
        let answer = given(&solution).then(|| solution.x.clone());
        let right =
            RightAnswer::of(posed.posed(), target.model, exact.as_deref(), answer.as_deref());
        let mistakes = answer
            .as_deref()
            .map_or_else(Vec::new, |x| find_mistakes(posed.posed(), x, None).mistakes);
        let vector = |x: &[f64]| -> serde_json::Value { x.iter().map(|&x| number(x)).collect() };
        problem.extra.insert(
            "hunt".into(),
            json!({
                "solver": solver,
                "x": answer.as_deref().map(vector),
                "right_x": right.as_ref().map(|right| vector(&right.x)),
            }),
        );
        let is_unique =
            matches!(class_of(lcp.matrix()), Some(MatrixClass::Definite | MatrixClass::P))
                && posed.boxed().is_some_and(|lcp| lcp.coupling().is_none());
        let truth = exact.as_deref().map(|all| truth(all, is_unique)).unwrap_or_default();
        let (happens, card) = (target.words(lcp, &solution), Card::of(lcp).words());
        let model = target.model.map_or(String::new(), |model| format!(" under {model}"));
        let words = format!("{happens}. The problem{model} has {card}.{truth}");
        let test = test(&problem, target, counterexample, right.as_ref());
        Finding { problem, words, answer, right, mistakes, test, solver: solver.into() }
    }

    /// The solver's x and the correct one, row by row; empty if there is neither.
    pub fn answers(&self) -> String {
        let rows = self.problem.lcp.len();
        if self.answer.is_none() && self.right.is_none() {
            return String::new();
        }
        let column =
            |x: Option<&[f64]>, i: usize| x.map_or("–".to_string(), |x| readable(x[i], DIGITS));
        let (own, right) = (self.answer.as_deref(), self.right.as_ref());
        let title = format!("x of {}", self.solver);
        let width = title.chars().count().max(15);
        let mut text = format!("  row  {title:>width$}  {:>15}\n", "correct x");
        for i in 0..rows.min(Self::PRINTED_ROWS) {
            let right = column(right.map(|right| &*right.x), i);
            text += &format!("{i:>5}  {:>width$}  {right:>15}\n", column(own, i));
        }
        if rows > Self::PRINTED_ROWS {
            text += &format!("       and {} more rows\n", rows - Self::PRINTED_ROWS);
        }
        if let Some(right) = right {
            text += &format!("  correct x: {}\n", right.source);
        }
        for mistake in &self.mistakes {
            let gives = if mistake.may_be_chance { "may give" } else { "gives" };
            text +=
                &format!("  a known mistake {gives} the x of {}: {}\n", self.solver, mistake.what);
        }
        text
    }

    /// Maximum number of rows of the answers that are printed.
    const PRINTED_ROWS: usize = 40;

    /// The problem as equations, row by row; empty for a large one.
    pub fn equations(&self) -> String {
        let lcp = &self.problem.lcp;
        if lcp.len() > WRITTEN_ROWS {
            return String::new();
        }
        (0..lcp.len()).map(|i| format!("  {}\n", row(&self.problem, i))).collect()
    }
}

/// Whether the x of the solution comes from the solver; otherwise it is the start.
fn given(solution: &Solution) -> bool {
    !matches!(
        solution.status,
        Status::NoAnswer { .. } | Status::OutsideClass { .. } | Status::TooLarge { .. }
    )
}

/// w_1 = 2 x_0 − x_1 + 3 and the bounds of x_1.
fn row(problem: &Problem, i: usize) -> String {
    let lcp = &problem.lcp;
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
        Some((k, mu)) => friction_bound(problem, i, k, mu),
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

/// The bound of friction row i from the normal x_k under the problem's model.
fn friction_bound(problem: &Problem, i: usize, k: usize, mu: f64) -> String {
    let own = |contact: &&Contact| contact.rows.contains(&i);
    let plane = problem.lcp.contacts().iter().find(own).map_or(format!("x_{i}"), |contact| {
        let [_, t1, t2] = contact.rows;
        format!("(x_{t1}, x_{t2})")
    });
    let mu_text = short(mu);
    match problem.model.map_or(Form::Box, Model::form) {
        Form::Box if problem.model == Some(Model::FrozenBox) => {
            let x = problem.frozen_at.as_ref().map_or(0.0, |x| x[k]);
            format!("|x_{i}| ≤ {}", short(mu * x))
        }
        Form::Box => format!("|x_{i}| ≤ {mu_text} x_{k}"),
        Form::Cone(_) => format!("|{plane}| ≤ {mu_text} x_{k}"),
        Form::Polygon { corners } => {
            format!("{plane} in a polygon with {corners} corners at {mu_text} x_{k}")
        }
    }
}

/// The shortest text that parses to this number.
fn short(value: f64) -> String {
    let text = format!("{value:?}");
    text.strip_suffix(".0").map_or(text.clone(), str::to_string).replace('-', "−")
}

/// The true solutions, in a sentence.
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
        0 => " It has no solution; all choices of active rows were tried.".into(),
        1 if is_unique => format!(" Its solution is x = {}.", shown[0]),
        1 => format!(" A solution is x = {}; all other solutions are connected to it.", shown[0]),
        n if n > SHOWN => {
            format!(" It has {n} isolated sets of solutions, such as x = {}.", shown[0])
        }
        n => format!(" It has {n} isolated sets of solutions: x = {}.", shown.join(", ")),
    }
}

/// A test that fails as long as the solver's behavior is unchanged; for a plug-in, a command.
fn test(
    problem: &Problem,
    target: &Target,
    counterexample: &Counterexample,
    right: Option<&RightAnswer>,
) -> String {
    let Settings { max_iterations: most, tolerance, .. } = target.options.settings;
    let is_usual = tolerance == Settings::default().tolerance;
    if target.solver.group() == Group::Plugin {
        let tolerance =
            if is_usual { String::new() } else { format!(" --tolerance {tolerance:e}") };
        return format!(
            "lcplab solve PROBLEM --plugin \"COMMAND\" --max-iterations {most}{tolerance}"
        );
    }
    let demand = match target.measure {
        Measure::FalseClaim => {
            "let demand = Demand { tolerance: settings.tolerance, ..Demand::default() };\n    \
             let verdict = judge_friction(question.posed(), &solution.x, &demand).verdict;\n    \
             assert!(solution.status != Status::Solved || verdict.is_solution(), \"{verdict}\");"
                .to_string()
        }
        Measure::Failure => "assert_eq!(solution.status, Status::Solved);".to_string(),
        Measure::Error => {
            let exact = right.map(|right| &*right.x).unwrap_or_default();
            format!(
                "let exact = {exact:?}; // the exact solution, rounded\n    \
                 let size = exact.iter().fold(0.0, |most: f64, x| most.max(x.abs()));\n    \
                 let misses = solution.x.iter().zip(exact).map(|(x, exact)| (x - exact).abs());\n    \
                 assert!(misses.fold(0.0, f64::max) < {:e} * size);",
                0.5 * counterexample.value
            )
        }
        Measure::Iterations => {
            format!("assert!(solution.iterations < {});", counterexample.iterations)
        }
        Measure::Ratio => {
            let (name, ratio) = (
                target.baseline.as_ref().map_or("", |baseline| baseline.name()),
                counterexample.value,
            );
            let fewer = format!("assert!(solution.iterations < {});", counterexample.iterations);
            format!("{fewer} // {ratio:.0} times those of {name}")
        }
    };
    let name = target.solver.name();
    let test = format!("{}_of_{name}", target.measure).replace('-', "_");
    let tolerance =
        if is_usual { String::new() } else { format!(".with_tolerance({tolerance:e})") };
    let method = match target.model {
        Some(_) => format!(
            "methods::with_reference().method(\"{name}\", question.model()).unwrap().clone()"
        ),
        None => format!("methods::with_reference().method(\"{name}\", None).unwrap().clone()"),
    };
    format!(
        "#[test]\nfn {test}() {{\n    let text = r#\"{}\"#;\n    \
         let problem = Problem::parse(text, \"hunt\").unwrap();\n    \
         let question = Question::new(&problem, None, \"hunt\").unwrap();\n    \
         let settings = Settings::default(){tolerance}.with_max_iterations({most});\n    \
         let options = Options::default().with_settings(settings.clone());\n    \
         let method = {method};\n    \
         let solution = method.solve(question.posed(), &options, &mut ());\n    {demand}\n}}",
        problem.to_json(),
    )
}
