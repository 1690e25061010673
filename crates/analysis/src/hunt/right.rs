//! A correct answer for comparison with a wrong one.

use dashu_ratio::RBig;

use lcplab_judge::Demand;
use lcplab_lcp::exact::all_solutions;
use lcplab_lcp::friction::{Model, ProblemForm};
use lcplab_solver::{
    Apgd, BlockPivoting, ConePgs, Dantzig, Lemke, Method, Newton, Options, Settings,
};

use crate::methods::{REFERENCE, with_reference};
use crate::trial::Trial;

/// The solvers used if exact arithmetic has no answer, the most accurate ones first.
const ASKED: [&str; 7] = [
    Dantzig::NAME,
    Lemke::NAME,
    BlockPivoting::NAME,
    Newton::NAME,
    ConePgs::NAME,
    Apgd::NAME,
    REFERENCE,
];
/// Their tolerances, tried one after the other.
const TOLERANCES: [f64; 2] = [1e-12, 1e-9];

/// A correct answer, and its source.
///
/// ```
/// use dashu_ratio::RBig;
/// use lcplab_analysis::hunt::RightAnswer;
/// use lcplab_lcp::friction::ProblemForm;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // Two supports share a load of 1. The corners of all answers are known; (1, 0) is nearer.
/// let a = Matrix::from([[1.0, 1.0], [1.0, 1.0]]);
/// let lcp = Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let (zero, one) = (RBig::ZERO, RBig::ONE);
/// let corners = [vec![one.clone(), zero.clone()], vec![zero, one]];
/// let own = [0.9, 0.2];
/// let right = RightAnswer::of(&ProblemForm::Boxed(lcp), None, Some(&corners), Some(&own));
/// assert_eq!(right.unwrap().x, [1.0, 0.0]);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct RightAnswer {
    /// x, one number per row.
    pub x: Vec<f64>,
    /// How it was found, in a few words.
    pub source: String,
}

impl RightAnswer {
    /// The correct answer nearest to `own`: an exact solution, rounded, if all of them are known
    /// (`exact`) or can be found; otherwise one from a solver of the library that the judge
    /// accepts. `None` if there is no solution, or none is found.
    pub fn of(
        posed: &ProblemForm,
        model: Option<Model>,
        exact: Option<&[Vec<RBig>]>,
        own: Option<&[f64]>,
    ) -> Option<RightAnswer> {
        let solutions: Option<Vec<Vec<f64>>> = match (posed, exact) {
            (_, Some(exact)) => Some(exact.iter().map(|x| rounded(x)).collect()),
            // The directions of more corners are rounded numbers.
            (ProblemForm::Polyhedral(polygon), None) if polygon.directions() == 4 => {
                let all = all_solutions(polygon.lcp());
                all.map(|all| all.iter().map(|z| polygon.x(&rounded(z))).collect())
            }
            _ => None,
        };
        let Some(solutions) = solutions else { return by_a_solver(posed, model) };
        let distance = |x: &Vec<f64>| own.map_or(0.0, |own| distance(x, own));
        let nearest = solutions.into_iter().min_by(|x, y| distance(x).total_cmp(&distance(y)))?;
        Some(RightAnswer { x: nearest, source: "an exact solution, rounded".into() })
    }
}

/// The first answer of a solver of the library that the judge accepts.
fn by_a_solver(posed: &ProblemForm, model: Option<Model>) -> Option<RightAnswer> {
    let own = |name| with_reference().all().filter(move |method| method.name() == name);
    let methods: Vec<&Method> =
        ASKED.into_iter().flat_map(own).filter(|method| method.takes(model)).collect();
    TOLERANCES.iter().find_map(|&tolerance| {
        let settings = Settings::default().with_tolerance(tolerance).with_max_iterations(100_000);
        let options = Options::default().with_settings(settings);
        let demand = Demand { tolerance, ..Demand::default() };
        methods.iter().find_map(|method| {
            let trial = Trial::run(method, posed, &options, &mut ());
            let is_right = trial.judged(posed, &demand).verdict.is_solution();
            is_right.then(|| RightAnswer {
                x: trial.solution.x,
                source: format!("by {}, accepted by the judge", method.name()),
            })
        })
    })
}

fn rounded(x: &[RBig]) -> Vec<f64> {
    x.iter().map(|x| x.to_f64().value()).collect()
}

/// max_i |x_i − y_i|.
fn distance(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| (x - y).abs()).fold(0.0, f64::max)
}
