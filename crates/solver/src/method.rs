//! Box and cone solvers as one type: the methods that can solve a friction problem.
//!
//! Models 1 and 2 of friction are boxed LCPs, open to every [`Entry`]. Model 3 is an LCP whose
//! matrix is not symmetric and has zeros on the diagonal; it needs solvers made for such matrices.
//! Model 4 needs a [`ConeEntry`]. A new entry in a registry is available for the models it fits.

use super::{
    Choice, Class, ConeEntry, Entry, Group, MatrixClass, Observer, Options, Solution, Solver,
    Start, Status,
};
use lcplab_lcp::Complementarity;
use lcplab_lcp::friction::{Form, Model, Polyhedral, ProblemForm};

/// A box or cone solver.
///
/// ```
/// use lcplab_lcp::friction::Model;
/// use lcplab_solver::{Choice, Group, Registry, why_none_takes};
///
/// let pgs = Registry::standard().method("pgs", None)?;
/// assert_eq!((pgs.name(), pgs.group(), pgs.uses()), ("pgs", Group::Sweeps, &[Choice::Order][..]));
/// assert!(pgs.boxed().is_some()); // it solves boxed LCPs
/// assert!(pgs.takes(Some(Model::CoupledBox)) && !pgs.takes(Some(Model::CoulombCone)));
/// assert_eq!(
///     why_none_takes([pgs], Some(Model::CoulombCone)).unwrap(),
///     "it supports boxes, not coulomb-cone"
/// );
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub enum Method {
    /// A solver for boxed LCPs.
    Boxed(Entry),
    /// A solver for circular cones.
    Cone(ConeEntry),
}

/// Why none of these methods is made for a model; `None` if there are none, or one of them is.
pub fn why_none_takes<'a>(
    methods: impl IntoIterator<Item = &'a Method>,
    model: Option<Model>,
) -> Option<String> {
    let refusals: Option<Vec<String>> =
        methods.into_iter().map(|method| method.refusal(model)).collect();
    refusals?.into_iter().next()
}

impl Method {
    /// The name, unique among the methods for one model.
    pub fn name(&self) -> &str {
        match self {
            Method::Boxed(Entry { name, .. }) | Method::Cone(ConeEntry { name, .. }) => name,
        }
    }

    /// The solver of boxed LCPs that it is; `None` for one of cones.
    pub fn boxed(&self) -> Option<&Entry> {
        match self {
            Method::Boxed(entry) => Some(entry),
            Method::Cone(_) => None,
        }
    }

    /// The options that it uses in addition to the common settings.
    pub fn uses(&self) -> &'static [Choice] {
        match self {
            Method::Boxed(entry) => entry.uses,
            Method::Cone(_) => &[],
        }
    }

    /// What kind of method it is.
    pub fn group(&self) -> Group {
        match self {
            Method::Boxed(entry) => entry.group,
            Method::Cone(entry) => entry.group,
        }
    }

    /// Whether the method is made for this friction model, or for LCPs without friction.
    pub fn takes(&self, model: Option<Model>) -> bool {
        self.refusal(model).is_none()
    }

    /// The reason why the method is not made for this friction model, or for LCPs without friction;
    /// `None` if it is.
    ///
    /// ```
    /// use lcplab_lcp::friction::Model;
    /// use lcplab_solver::Registry;
    ///
    /// let pgs = Registry::standard().method("pgs", None)?;
    /// assert_eq!(pgs.refusal(Some(Model::CoupledBox)), None);
    /// assert_eq!(
    ///     pgs.refusal(Some(Model::CoulombCone)).unwrap(),
    ///     "it supports boxes, not coulomb-cone"
    /// );
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn refusal(&self, model: Option<Model>) -> Option<String> {
        let Some(model) = model else {
            return match self {
                Method::Boxed(_) => None,
                Method::Cone(_) => {
                    Some("it supports only friction cones, and the problem has none".into())
                }
            };
        };
        match (self, model.form()) {
            (Method::Boxed(entry), Form::Cone(_)) => Some(match entry.group {
                Group::Plugin => format!("it does not declare support for {model}"),
                _ => format!("it supports boxes, not {model}"),
            }),
            (Method::Boxed(entry), Form::Polygon { .. }) => {
                let Class { matrix, divides_by_diagonal, .. } = entry.class;
                if divides_by_diagonal {
                    Some(match entry.group {
                        Group::Plugin => format!("plug-ins and functions do not support {model}"),
                        _ => {
                            format!("it divides by the diagonal of A, which has zeros for {model}")
                        }
                    })
                } else if !matches!(matrix, MatrixClass::CopositivePlus | MatrixClass::General) {
                    Some(format!("it needs A {matrix}, but {model} makes A unsymmetric"))
                } else {
                    None
                }
            }
            (Method::Boxed(_), Form::Box) if model == Model::FrozenBox => None,
            (Method::Boxed(entry), Form::Box) => {
                let reason = "it does not support bounds that depend on the x of another row, as in coupled-box";
                (!entry.class.coupling).then(|| reason.into())
            }
            (Method::Cone(entry), Form::Cone(law)) => {
                (!entry.laws.contains(&law)).then(|| format!("it does not support {model}"))
            }
            (Method::Cone(_), Form::Box | Form::Polygon { .. }) => {
                Some(format!("it supports only friction cones, not {model}"))
            }
        }
    }

    /// Solves a problem from x = 0 and returns x. A problem of the other kind gives `OutsideClass`.
    ///
    /// ```
    /// use lcplab_lcp::friction::{Contact, FrictionProblem, Model};
    /// use lcplab_lcp::{Lcp, Matrix};
    /// use lcplab_solver::{Method, Options, Registry};
    ///
    /// // A point of 1 kg on the ground slides along t1: w = x + b.
    /// let (b, free) = (vec![-2.0, -3.0, 0.0], f64::INFINITY);
    /// let a = Matrix::from([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    /// let lcp = Lcp::new(a, b, vec![0.0, -free, -free], vec![free; 3])?;
    /// let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
    /// let lemke = Method::Boxed(Registry::standard().entry("lemke")?.clone());
    /// let posed = Model::Polyhedral { directions: 4 }.pose(&problem, None)?;
    /// let solution = lemke.solve(&posed, &Options::default(), &mut ());
    /// assert_eq!(solution.x, [2.0, 1.0, 0.0]);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn solve(
        &self,
        problem: &ProblemForm,
        options: &Options,
        observer: &mut dyn Observer,
    ) -> Solution {
        let start = Start::default();
        match (self, problem) {
            (Method::Boxed(entry), ProblemForm::Boxed(lcp)) => {
                entry.build(options).solve(lcp, &start, observer)
            }
            (Method::Boxed(entry), ProblemForm::Polyhedral(polyhedral)) => {
                let solver = entry.build(options);
                solve_polyhedral(&*solver, polyhedral, &start, options.settings.tolerance, observer)
            }
            (Method::Cone(entry), ProblemForm::Cone(problem)) => {
                entry.build(&options.settings).solve(problem, &start, observer)
            }
            (Method::Boxed(_), ProblemForm::Cone(problem)) => {
                let reason = "the problem has cones, not bounds";
                let x = start.point(problem);
                Solution::new(problem.lcp(), x, Status::OutsideClass { reason }, 0)
            }
            (Method::Cone(_), ProblemForm::Boxed(_) | ProblemForm::Polyhedral(_)) => {
                let lcp = match problem {
                    ProblemForm::Polyhedral(polyhedral) => polyhedral.friction().lcp(),
                    ProblemForm::Boxed(lcp) => lcp,
                    ProblemForm::Cone(problem) => problem.lcp(),
                };
                let reason = "the problem has bounds, not cones";
                let x = start.point(lcp);
                Solution::new(lcp, x, Status::OutsideClass { reason }, 0)
            }
        }
    }
}

/// Solves a polyhedral problem by an LCP solver, starting from x, and returns x.
///
/// ```
/// use lcplab_lcp::friction::{Contact, FrictionProblem, Polyhedral};
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::{Lemke, Start, solve_polyhedral};
///
/// // A point of 1 kg reaches the ground with 2 m/s and slides along t1 with 3 m/s; μ = 0.5.
/// let (b, free) = (vec![-2.0, -3.0, 0.0], f64::INFINITY);
/// let a = Matrix::from([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
/// let lcp = Lcp::new(a, b, vec![0.0, -free, -free], vec![free; 3])?;
/// let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
/// let polygons = Polyhedral::new(&problem, 4)?;
/// let (solver, start) = (Lemke::default(), Start::default());
/// let solution = solve_polyhedral(&solver, &polygons, &start, 1e-8, &mut ());
/// assert_eq!(solution.x, [2.0, 1.0, 0.0]); // the impulses, not the six unknowns of the polygons
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn solve_polyhedral(
    solver: &dyn Solver,
    polyhedral: &Polyhedral,
    start: &Start<'_>,
    tolerance: f64,
    observer: &mut dyn Observer,
) -> Solution {
    let z = start.x.map(|x| polyhedral.z(x));
    let start = Start { x: z.as_deref(), ..Start::default() };
    let solution = solver.solve(polyhedral.lcp(), &start, observer);
    impulses(polyhedral, solution, tolerance)
}

/// Converts a solution z to impulses x, and the rows in its status to rows of x. `Solved` refers to
/// the z reconstructed from x, because a judge of x can see only that.
fn impulses(polyhedral: &Polyhedral, solution: Solution, tolerance: f64) -> Solution {
    let Solution { x: z, status, iterations, is_claim_implied, .. } = solution;
    let x = polyhedral.x(&z);
    let status = match status {
        Status::Solved if !polyhedral.is_solution(&x, tolerance) => Status::Inaccurate,
        Status::ZeroDiagonal { row } => Status::ZeroDiagonal { row: polyhedral.row(row) },
        Status::Singular { row } => Status::Singular { row: polyhedral.row(row) },
        Status::Ray { row, direction } => {
            Status::Ray { row: polyhedral.row(row), direction: polyhedral.x(&direction) }
        }
        status => status,
    };
    Solution::new(polyhedral.friction().lcp(), x, status, iterations)
        .with_implied_claim(is_claim_implied)
}
