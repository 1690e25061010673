//! A convex quadratic program in clarabel's form, built up row by row.
//!
//! ```text
//! minimize ½ zᵀP z + qᵀz   subject to   G z + s = h,   s = 0 or s ≥ 0 by rows, or s in a cone
//! ```

use clarabel::algebra::CscMatrix;
use clarabel::solver::{
    DefaultSettingsBuilder, DefaultSolver, IPSolver, SolverStatus, SupportedConeT,
};

use super::Reference;
use lcplab_lcp::Lcp;

/// Tolerance on gap and feasibility: tight, because the answer is a reference.
const TOLERANCE: f64 = 1e-10;
/// Clarabel's default limit on iterations.
pub(super) const MAX_ITERATIONS: usize = 200;

/// The program built so far.
#[derive(Debug, Default)]
pub(super) struct Program {
    /// q; its length is the number of variables.
    pub(super) linear: Vec<f64>,
    /// Entries (row ≤ column, value) of P.
    pub(super) quadratic: Vec<(usize, usize, f64)>,
    equations: Vec<(Vec<(usize, f64)>, f64)>,
    inequalities: Vec<(Vec<(usize, f64)>, f64)>,
    /// Rows in groups of three; each group is one cone.
    cones: Vec<(Vec<(usize, f64)>, f64)>,
}

impl Program {
    /// A program without constraints; each linear cost defines a variable.
    pub(super) fn with_costs(linear: Vec<f64>) -> Self {
        Program { linear, ..Program::default() }
    }

    /// ½ zᵀA z + bᵀz, with the symmetric A and the b of an LCP.
    pub(super) fn with_objective(lcp: &Lcp) -> Self {
        let upper = |i: usize| lcp.matrix().row(i).iter().filter(move |&(j, _)| j >= i);
        let entries = (0..lcp.len()).flat_map(|i| upper(i).map(move |(j, a)| (i, j, a)));
        Program { quadratic: entries.collect(), ..Program::with_costs(lcp.b().to_vec()) }
    }

    /// Adds a variable with this linear cost; returns its index.
    pub(super) fn add_variable(&mut self, cost: f64) -> usize {
        self.linear.push(cost);
        self.linear.len() - 1
    }

    /// Σ g z = h.
    pub(super) fn equate(&mut self, g: Vec<(usize, f64)>, h: f64) {
        self.equations.push((g, h));
    }

    /// Σ g z ≤ h.
    pub(super) fn at_most(&mut self, g: Vec<(usize, f64)>, h: f64) {
        self.inequalities.push((g, h));
    }

    /// lo ≤ z_i ≤ hi.
    pub(super) fn bound(&mut self, i: usize, lo: f64, hi: f64) {
        if lo == hi {
            self.equate(vec![(i, 1.0)], lo);
            return;
        }
        if lo.is_finite() {
            self.at_most(vec![(i, -1.0)], -lo);
        }
        if hi.is_finite() {
            self.at_most(vec![(i, 1.0)], hi);
        }
    }

    /// |(z_j, z_k)| ≤ μ z_i for the variables i, j, k, with μ > 0.
    pub(super) fn within_cone(&mut self, mu: f64, [i, j, k]: [usize; 3]) {
        // s = (μ z_i, z_j, z_k)
        let rows = [(i, mu), (j, 1.0), (k, 1.0)];
        self.cones.extend(rows.map(|(i, value)| (vec![(i, -value)], 0.0)));
    }

    /// Whether all numbers are finite.
    pub(super) fn is_finite(&self) -> bool {
        let rows = || self.equations.iter().chain(&self.inequalities).chain(&self.cones);
        let coefficients = rows().flat_map(|(g, h)| g.iter().map(|&(_, g)| g).chain([*h]));
        let costs = self.linear.iter().copied();
        coefficients.chain(costs).all(f64::is_finite)
    }

    pub(super) fn solve(self) -> Reference {
        self.solve_within(MAX_ITERATIONS)
    }

    pub(super) fn solve_within(self, max_iterations: usize) -> Reference {
        self.solve_to(TOLERANCE, max_iterations)
    }

    pub(super) fn solve_to(self, tolerance: f64, max_iterations: usize) -> Reference {
        let n = self.linear.len();
        let p = csc(n, n, self.quadratic.into_iter());
        let mut cones = vec![
            SupportedConeT::ZeroConeT(self.equations.len()),
            SupportedConeT::NonnegativeConeT(self.inequalities.len()),
        ];
        cones.extend(self.cones.chunks(3).map(|_| SupportedConeT::SecondOrderConeT(3)));
        let rows: Vec<_> =
            self.equations.into_iter().chain(self.inequalities).chain(self.cones).collect();
        let h: Vec<f64> = rows.iter().map(|(_, h)| *h).collect();
        let entries = rows.iter().enumerate();
        let entries = entries.flat_map(|(i, (g, _))| g.iter().map(move |&(j, v)| (i, j, v)));
        let g = csc(rows.len(), n, entries);
        let settings = DefaultSettingsBuilder::default()
            .verbose(false)
            .max_iter(u32::try_from(max_iterations).unwrap_or(u32::MAX))
            .tol_gap_abs(tolerance)
            .tol_gap_rel(tolerance)
            .tol_feas(tolerance)
            .build();
        let solver = settings.map_err(|e| e.to_string()).and_then(|settings| {
            DefaultSolver::new(&p, &self.linear, &g, &h, &cones, settings)
                .map_err(|e| e.to_string())
        });
        match solver {
            Ok(mut solver) => {
                solver.solve();
                let solution = solver.solution;
                let solved =
                    matches!(solution.status, SolverStatus::Solved | SolverStatus::AlmostSolved);
                Reference {
                    point: solution.x,
                    objective: solution.obj_val,
                    iterations: solution.iterations as usize,
                    status: format!("{:?}", solution.status),
                    solved,
                }
            }
            Err(status) => {
                let point = vec![f64::NAN; n];
                Reference { point, objective: f64::NAN, iterations: 0, status, solved: false }
            }
        }
    }
}

fn csc(rows: usize, cols: usize, entries: impl Iterator<Item = (usize, usize, f64)>) -> CscMatrix {
    let (mut i, mut j, mut v) = (Vec::new(), Vec::new(), Vec::new());
    for (row, col, value) in entries {
        i.push(row);
        j.push(col);
        v.push(value);
    }
    CscMatrix::new_from_triplets(rows, cols, i, j, v)
}
