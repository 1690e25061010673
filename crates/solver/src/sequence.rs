//! The fallback sequence: the methods that solve a problem if no solver is named.
//!
//! | problem | methods, in this order |
//! | --- | --- |
//! | boxes, A symmetric up to rounding | `dantzig`, `block-pivoting`, `newton`, `interior-point`; if A is small and not positive semidefinite, `lemke`, `enumeration` |
//! | boxes, any other A | `lemke`, `interior-point` (first if there are more than 150 rows), `fischer-newton`, `enumeration` |
//! | polygons | `lemke`, contact by contact (`polygon-pgs`) |
//! | cones | `apgd` if A is symmetric up to rounding, `cone-pgs`; under Coulomb's law, up to 300 rows, `cone-newton` |
//!
//! Pivoting comes first because it gives a solution to full precision. It can fail because of
//! rounding, on a ray of a matrix that is not copositive, or when friction limits change along the
//! path. The next method fails in other cases. Each method has the iteration limit of the settings,
//! but Newton's method and the interior-point method have at most 100 iterations and the
//! enumeration at most 65,536 active sets. A solver that the user names is never replaced.
//!
//! ```
//! use lcplab_lcp::friction::ProblemForm;
//! use lcplab_lcp::{Lcp, Matrix};
//! use lcplab_solver::{Options, Status, solve_by_sequence};
//!
//! // A bimatrix game: Lemke's path ends on a ray, the enumeration finds the equilibrium.
//! let a = [0.0, 0.0, 2.0, 4.0, 0.0, 0.0, 3.0, 1.0, 1.0, 3.0, 0.0, 0.0, 4.0, 2.0, 0.0, 0.0];
//! let lcp = Lcp::new(Matrix::dense(4, &a), vec![-1.0; 4], vec![0.0; 4], vec![f64::INFINITY; 4])?;
//! let answer = solve_by_sequence(&ProblemForm::Boxed(lcp), &Options::default(), &mut ());
//! assert_eq!(answer.solution.status, Status::Solved);
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

use nalgebra::DMatrix;

use crate::tolerances::NEGATIVE_EIGENVALUE;
use crate::{
    Apgd, BlockPivoting, ConeNewton, ConePgs, ConeSolver, Dantzig, Enumeration, InteriorPoint,
    Lemke, Newton, Observer, Options, PolygonPgs, Registry, Settings, Solution, Start, Status,
    solve_polyhedral,
};
use lcplab_lcp::Lcp;
use lcplab_lcp::friction::{ConeProblem, Law, Polyhedral, ProblemForm};

/// Iteration limit of Newton's method and the interior-point method, which normally need about ten.
const MOST_STEPS: usize = 100;
/// Maximum number of active sets that the enumeration tries.
const MOST_SETS: usize = 1 << 16;
/// Number of rows up to which pivoting comes first if A is not symmetric: with more, its dense
/// tableau takes longer than the few sparse factorizations of the interior-point method.
const PIVOTED_ROWS: usize = 150;
/// Number of rows up to which a symmetric A is examined for negative eigenvalues, and Newton's
/// method is used for cones.
const MOST_ROWS: usize = 300;

/// A method that was tried and did not solve the problem.
#[derive(Debug, Clone, PartialEq)]
pub struct Attempt {
    /// The method.
    pub solver: &'static str,
    /// Its final status.
    pub status: Status,
    /// The number of its iterations.
    pub iterations: usize,
}

/// The answer of the fallback sequence.
#[derive(Debug, Clone, PartialEq)]
pub struct SequenceAnswer {
    /// The name of the method that gave the answer: the one that solved the problem, otherwise the
    /// first.
    pub solver: String,
    /// Its answer.
    pub solution: Solution,
    /// The methods that failed before, in order.
    pub attempts: Vec<Attempt>,
}

/// Solves a problem by the fallback sequence, from 0, with the default options. Check the
/// [status](Solution::status): it is the claim of the method that gave the answer.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::{Status, solve};
///
/// let a = Matrix::from([[2.0, -1.0], [-1.0, 2.0]]);
/// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let solution = solve(&lcp);
/// assert_eq!((solution.status, solution.x), (Status::Solved, vec![0.5, 0.0]));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn solve_lcp(lcp: &Lcp) -> Solution {
    solve_boxed(lcp, &Start::default(), &Options::default(), &mut ()).solution
}

/// Solves a problem from 0 with the suitable methods, one after the other, until one succeeds.
///
/// ```
/// use lcplab_lcp::friction::ProblemForm;
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::{Options, solve_by_sequence};
///
/// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
/// let answer = solve_by_sequence(&ProblemForm::Boxed(lcp), &Options::default(), &mut ());
/// assert_eq!((answer.solver.as_str(), answer.solution.x), ("dantzig", vec![0.5]));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn solve(
    problem: &ProblemForm,
    options: &Options,
    observer: &mut dyn Observer,
) -> SequenceAnswer {
    match problem {
        ProblemForm::Boxed(lcp) => solve_boxed(lcp, &Start::default(), options, observer),
        ProblemForm::Polyhedral(polygons) => solve_polygons(polygons, options, observer),
        ProblemForm::Cone(cones) => solve_cones(cones, options, observer),
    }
}

/// The same for boxes, from a start.
pub fn solve_boxed(
    lcp: &Lcp,
    start: &Start<'_>,
    options: &Options,
    observer: &mut dyn Observer,
) -> SequenceAnswer {
    solve_boxed_without("", lcp, start, options, observer)
}

/// The same without a method that has already been tried.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::{Options, Start, solve_boxed_by_sequence, solve_boxed_without};
///
/// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
/// let (start, options) = (Start::default(), Options::default());
/// let answer = solve_boxed_by_sequence(&lcp, &start, &options, &mut ());
/// assert_eq!((answer.solver.as_str(), answer.solution.x), ("dantzig", vec![0.5]));
/// let answer = solve_boxed_without("dantzig", &lcp, &start, &options, &mut ());
/// assert_eq!((answer.solver.as_str(), answer.solution.x), ("block-pivoting", vec![0.5]));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn solve_boxed_without(
    tried: &str,
    lcp: &Lcp,
    start: &Start<'_>,
    options: &Options,
    observer: &mut dyn Observer,
) -> SequenceAnswer {
    let is_symmetric = lcp.matrix().is_nearly_symmetric();
    let names: &[&'static str] = match is_symmetric {
        true => &[
            Dantzig::NAME,
            BlockPivoting::NAME,
            Newton::NAME,
            InteriorPoint::NAME,
            Lemke::NAME,
            Enumeration::NAME,
        ],
        false if lcp.len() <= PIVOTED_ROWS => {
            &[Lemke::NAME, InteriorPoint::NAME, Newton::FISCHER_BURMEISTER, Enumeration::NAME]
        }
        false => &[InteriorPoint::NAME, Lemke::NAME, Newton::FISCHER_BURMEISTER, Enumeration::NAME],
    };
    let names: Vec<&str> = names.iter().copied().filter(|name| *name != tried).collect();
    let attempt = |name: &'static str, observer: &mut dyn Observer| {
        let is_general = matches!(name, Lemke::NAME | Enumeration::NAME);
        if is_general && is_symmetric && (lcp.len() > MOST_ROWS || is_semidefinite(lcp)) {
            return None;
        }
        let entry = Registry::standard().entry(name).ok()?;
        Some(entry.build(&within_budget(name, options)).solve(lcp, start, observer))
    };
    first_success(&names, observer, attempt)
}

/// Whether a symmetric A has no negative eigenvalue, up to rounding, with a unit diagonal.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::is_semidefinite;
///
/// let free = |a: [[f64; 2]; 2]| {
///     Lcp::new(Matrix::from(a), vec![0.0; 2], vec![f64::NEG_INFINITY; 2], vec![f64::INFINITY; 2])
/// };
/// assert!(is_semidefinite(&free([[1.0, 1.0], [1.0, 1.0]])?)); // eigenvalues 0 and 2
/// assert!(!is_semidefinite(&free([[0.0, 1.0], [1.0, 0.0]])?)); // eigenvalues −1 and 1
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn is_semidefinite(lcp: &Lcp) -> bool {
    let (a, n) = (lcp.matrix(), lcp.len());
    let root: Vec<f64> = (0..n).map(|i| a.diagonal(i).sqrt()).collect();
    let is_zero = |i: usize| a.row(i).iter().all(|(_, entry)| entry == 0.0);
    if !(0..n).all(|i| root[i] > 0.0 || is_zero(i)) {
        return false;
    }
    let unit = |i: usize, j: usize| match (i == j, root[i] * root[j]) {
        (true, _) => 1.0 + n as f64 * NEGATIVE_EIGENVALUE,
        (_, 0.0) => 0.0,
        (_, size) => a.entry(i, j) / size,
    };
    DMatrix::from_fn(n, n, unit).cholesky().is_some()
}

fn solve_polygons(
    polygons: &Polyhedral,
    options: &Options,
    observer: &mut dyn Observer,
) -> SequenceAnswer {
    let (start, settings) = (Start::default(), options.settings.clone());
    let attempt = |name: &'static str, observer: &mut dyn Observer| {
        let settings = settings.clone();
        Some(match name {
            Lemke::NAME => {
                let tolerance = settings.tolerance;
                solve_polyhedral(&Lemke { settings }, polygons, &start, tolerance, observer)
            }
            _ => PolygonPgs { settings }.solve(polygons, &start, observer),
        })
    };
    first_success(&[Lemke::NAME, PolygonPgs::NAME], observer, attempt)
}

fn solve_cones(
    cones: &ConeProblem,
    options: &Options,
    observer: &mut dyn Observer,
) -> SequenceAnswer {
    use lcplab_lcp::Complementarity;
    let names: &[&'static str] = match cones.lcp().matrix().is_nearly_symmetric() {
        true => &[Apgd::NAME, ConePgs::NAME, ConeNewton::NAME],
        false => &[ConePgs::NAME, ConeNewton::NAME],
    };
    let suits_newton = cones.law() == Law::Coulomb && cones.lcp().len() <= MOST_ROWS;
    let attempt = |name: &'static str, observer: &mut dyn Observer| {
        let settings = options.settings.clone();
        let solver: Box<dyn ConeSolver> = match name {
            ConeNewton::NAME if !suits_newton => return None,
            ConeNewton::NAME => Box::new(ConeNewton { settings }),
            Apgd::NAME => Box::new(Apgd { settings }),
            _ => Box::new(ConePgs { settings }),
        };
        Some(solver.solve(cones, &Start::default(), observer))
    };
    first_success(names, observer, attempt)
}

/// The options for one method of the sequence.
fn within_budget(name: &str, options: &Options) -> Options {
    let given = options.settings.max_iterations;
    let max_iterations = match name {
        Newton::NAME | Newton::FISCHER_BURMEISTER | InteriorPoint::NAME => given.min(MOST_STEPS),
        Enumeration::NAME => MOST_SETS,
        _ => given,
    };
    let settings = Settings { max_iterations, ..options.settings.clone() };
    Options { settings, ..options.clone() }
}

/// The first answer that is a solution, a proof that none exists, or was stopped by an observer;
/// otherwise the first answer.
fn first_success(
    names: &[&'static str],
    observer: &mut dyn Observer,
    attempt: impl Fn(&'static str, &mut dyn Observer) -> Option<Solution>,
) -> SequenceAnswer {
    let mut failed: Vec<(&'static str, Solution)> = Vec::new();
    let mut success = None;
    for &name in names {
        let Some(solution) = attempt(name, observer) else { continue };
        if matches!(solution.status, Status::Solved | Status::NoSolution | Status::Stopped) {
            success = Some((name, solution));
            break;
        }
        failed.push((name, solution));
    }
    let attempt = |(solver, solution): &(&'static str, Solution)| Attempt {
        solver,
        status: solution.status.clone(),
        iterations: solution.iterations,
    };
    let attempts = failed.iter().map(attempt).collect();
    let (solver, solution) = success.unwrap_or_else(|| failed.swap_remove(0));
    SequenceAnswer { solver: solver.into(), solution, attempts }
}
