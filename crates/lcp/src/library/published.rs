//! Small problems from the literature and from other projects' tests, with all their solutions.
//!
//! Exact enumeration gave the solutions, as fractions. Siconos stores A by columns; here it is
//! stored by rows.

use super::{Expected, Family, Parameter, Values, boxed};
use crate::Matrix;
use crate::file::Problem;

/// A problem without parameters.
#[derive(Debug, Clone, Copy)]
pub(super) struct Published {
    name: &'static str,
    about: &'static str,
    source: &'static str,
    a: &'static [&'static [f64]],
    b: &'static [f64],
    /// 0 and ∞ if empty.
    bounds: &'static [(f64, f64)],
    /// The entries of each solution, or of each corner of a segment of solutions.
    solutions: &'static [&'static str],
}

impl Family for Published {
    fn name(&self) -> &'static str {
        self.name
    }

    fn about(&self) -> &'static str {
        self.about
    }

    fn source(&self) -> &'static str {
        self.source
    }

    fn parameters(&self) -> &'static [Parameter] {
        &[]
    }

    fn make(&self, _: &Values) -> Problem {
        let fraction = |text: &str| text.parse().expect("a fraction");
        let solution = |text: &&str| text.split_whitespace().map(fraction).collect();
        let solutions = self.solutions.iter().map(solution).collect();
        let (lo, hi) = if self.bounds.is_empty() {
            (vec![0.0; self.b.len()], vec![f64::INFINITY; self.b.len()])
        } else {
            self.bounds.iter().copied().unzip()
        };
        let a = Matrix::dense(self.b.len(), &self.a.concat());
        boxed(a, self.b.to_vec(), lo, hi, &Expected { solutions, complete: true })
    }
}

const CONTACT: Published =
    Published { name: "", about: "", source: "", a: &[], b: &[], bounds: &[], solutions: &[] };

const PORTFOLIO: &[&[f64]] = &[
    &[11.0, 0.0, 10.0, -1.0],
    &[0.0, 11.0, 10.0, -1.0],
    &[10.0, 10.0, 21.0, -1.0],
    &[1.0, 1.0, 1.0, 0.0],
];

pub(super) const ALL: &[Published] = &[
    Published {
        name: "cps-1",
        about: "all ones: every point of the segment x1 + x2 = 1 solves it",
        source: "Handbook of Test Problems 10.2.2; lcp_CPS_1 of Siconos",
        a: &[&[1.0, 1.0], &[1.0, 1.0]],
        b: &[-1.0, -1.0],
        solutions: &["1 0", "0 1"],
        ..CONTACT
    },
    Published {
        name: "cps-2",
        about: "a matrix that is not symmetric",
        source: "Handbook of Test Problems 10.2.3; lcp_CPS_2 of Siconos",
        a: &[&[0.0, -1.0, 2.0], &[2.0, 0.0, -2.0], &[-1.0, 1.0, 0.0]],
        b: &[-3.0, 6.0, -1.0],
        solutions: &["0 1 3"],
        ..CONTACT
    },
    Published {
        name: "cps-3",
        about: "a bimatrix game: Lemke ends on a ray at once, although three solutions exist",
        source: "Handbook of Test Problems 10.2.4; lcp_CPS_3 of Siconos",
        a: &[
            &[0.0, 0.0, 10.0, 20.0],
            &[0.0, 0.0, 30.0, 15.0],
            &[10.0, 20.0, 0.0, 0.0],
            &[30.0, 15.0, 0.0, 0.0],
        ],
        b: &[-1.0; 4],
        solutions: &["1/10 0 1/10 0", "0 1/15 0 1/15", "1/90 2/45 1/90 2/45"],
        ..CONTACT
    },
    Published {
        name: "cps-4",
        about: "the optimality conditions of a portfolio",
        source: "Handbook of Test Problems 10.2.9; lcp_CPS_4 of Siconos",
        a: PORTFOLIO,
        b: &[50.0, 50.0, 10.0, -6.0],
        solutions: &["2 2 2 92"],
        ..CONTACT
    },
    Published {
        name: "cps-4bis",
        about: "the portfolio of cps-4 at the price where one share just drops out: degenerate",
        source: "Handbook of Test Problems 10.2.9; lcp_CPS_4bis of Siconos",
        a: PORTFOLIO,
        b: &[50.0, 50.0, 23.0, -6.0],
        solutions: &["3 3 0 83"],
        ..CONTACT
    },
    Published {
        name: "cps-5",
        about: "a tie in Lemke's second pivot: the covering variable must leave",
        source: "Cottle, Pang & Stone 4.4.16; lcp_CPS_5 of Siconos",
        a: &[&[1.0, -1.0], &[-1.0, 1.0]],
        b: &[1.0, -1.0],
        solutions: &["0 1"],
        ..CONTACT
    },
    Published {
        name: "kostreva-1",
        about: "a circulant: pivoting can cycle if ties are broken without an anti-cycling rule",
        source: "Kostreva 1979, example 1",
        a: &[&[1.0, 2.0, 0.0], &[0.0, 1.0, 2.0], &[2.0, 0.0, 1.0]],
        b: &[-1.0; 3],
        solutions: &["1/3 1/3 1/3"],
        ..CONTACT
    },
    Published {
        name: "kostreva-2",
        about: "pivoting meets ties; no solution exists",
        source: "Kostreva 1979, example 2",
        a: &[&[1.0, -1.0, 3.0], &[2.0, -1.0, 3.0], &[-1.0, -2.0, 0.0]],
        b: &[-1.0; 3],
        ..CONTACT
    },
    Published {
        name: "pang-isolated",
        about: "a solution that is isolated but not strongly regular",
        source: "lcp_Pang_isolated_sol of Siconos",
        a: &[&[0.0, -1.0, -1.0], &[1.0, 0.0, 0.0], &[-1.0, 0.0, 0.0]],
        b: &[0.0, -1.0, 1.0],
        solutions: &["1 0 0"],
        ..CONTACT
    },
    Published {
        name: "pang-perturbed",
        about: "pang-isolated perturbed by 1e-4: row 1 is −x2 − x3 − 1e-4, no solution exists",
        source: "lcp_Pang_isolated_sol_perturbed of Siconos",
        a: &[&[0.0, -1.0, -1.0], &[1.0, 0.0, 0.0], &[-1.0, 0.0, 0.0]],
        b: &[-1e-4, -1.0, 1.0],
        ..CONTACT
    },
    Published {
        name: "pang-other",
        about: "pang-perturbed with one sign changed: solved by (1, t, t + 1e-4) for t ≥ 0",
        source: "lcp_inf_sol_perturbed of Siconos",
        a: &[&[0.0, -1.0, 1.0], &[1.0, 0.0, 0.0], &[-1.0, 0.0, 0.0]],
        b: &[-1e-4, -1.0, 1.0],
        solutions: &["1 0 7378697629483821/73786976294838206464"],
        ..CONTACT
    },
    Published {
        name: "deudeu",
        about: "two rows, positive definite",
        source: "lcp_deudeu of Siconos",
        a: &[&[2.0, 1.0], &[1.0, 2.0]],
        b: &[-5.0, -6.0],
        solutions: &["4/3 7/3"],
        ..CONTACT
    },
    Published {
        name: "ortiz",
        about: "four rows, not symmetric",
        source: "lcp_ortiz of Siconos",
        a: &[
            &[3.0, 1.0, 0.0, -1.0],
            &[-1.0, 2.0, 1.0, 1.0],
            &[0.0, 1.0, 3.0, -1.0],
            &[0.0, 0.0, 1.0, 2.0],
        ],
        b: &[-2.0, 1.0, -1.0, 1.0],
        solutions: &["2/3 0 1/3 0"],
        ..CONTACT
    },
    Published {
        name: "trivial",
        about: "diagonal 1, …, 9: one pivot per row",
        source: "lcp_trivial of Siconos",
        a: &[
            &[1.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            &[0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            &[0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            &[0.0, 0.0, 0.0, 4.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            &[0.0, 0.0, 0.0, 0.0, 5.0, 0.0, 0.0, 0.0, 0.0],
            &[0.0, 0.0, 0.0, 0.0, 0.0, 6.0, 0.0, 0.0, 0.0],
            &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 7.0, 0.0, 0.0],
            &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 8.0, 0.0],
            &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 9.0],
        ],
        b: &[-1.0; 9],
        solutions: &["1 1/2 1/3 1/4 1/5 1/6 1/7 1/8 1/9"],
        ..CONTACT
    },
    Published {
        name: "path",
        about: "the introductory example of the PATH solver: optimality conditions of a quadratic program",
        source: "PATHSolver.jl",
        a: &[
            &[0.0, 0.0, -1.0, -1.0],
            &[0.0, 0.0, 1.0, -2.0],
            &[1.0, -1.0, 2.0, -2.0],
            &[1.0, 2.0, -2.0, 4.0],
        ],
        b: &[2.0, 2.0, -2.0, -6.0],
        solutions: &["14/5 0 4/5 6/5"],
        ..CONTACT
    },
    Published {
        name: "mcp09",
        about: "2 (x − 3) on seven intervals, finite and infinite: x is 3 clamped to each",
        source: "mcp09 of the GAMS test library",
        a: &[
            &[2.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            &[0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0],
            &[0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0],
            &[0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0],
            &[0.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0],
            &[0.0, 0.0, 0.0, 0.0, 0.0, 2.0, 0.0],
            &[0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 2.0],
        ],
        b: &[-6.0; 7],
        bounds: &[
            (4.0, f64::INFINITY),
            (f64::NEG_INFINITY, 2.0),
            (0.0, f64::INFINITY),
            (4.0, 8.0),
            (0.0, 2.0),
            (4.0, 4.0),
            (2.0, 2.0),
        ],
        solutions: &["4 2 3 4 2 4 2"],
    },
];
