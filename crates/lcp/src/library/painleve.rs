//! Painlevé's rod: dry friction for which rigid-body dynamics has no solution, or several.
//!
//! A uniform rod of mass m and length 2a slides with one end on the ground, at the angle θ to it.
//! Units are m = a = 1 and g = 1, and the rod leans to the right. With the moment of inertia 1/3, c
//! = cos θ and s = sin θ, the end has
//!
//! ```text
//! J_n = (0, 1, −c),   J_t = (1, 0, s)      A_nn = 1 + 3c²,   A_nt = −3sc,   A_tt = 1 + 3s²
//! ```
//!
//! (A = J M⁻¹ Jᵀ with M⁻¹ = diag(1, 1, 3); A_nn A_tt − A_nt² = 4.) It slides to the left, so
//! friction is x_t = μ x_n, and the normal row is an LCP with one unknown:
//!
//! ```text
//! w = a x + b,   a = A_nn + μ A_nt = 1 + 3c² − 3μ sc,   b = spin − 1       spin = ω² s
//! ```
//!
//! Friction turns the rod into the ground. For μ above (1 + 3c²) / 3sc = (4 + tan²θ) / (3 tan θ),
//! whose minimum is 4/3 at tan θ = 2, it does so faster than the normal force lifts the end: a < 0,
//! and
//!
//! - b < 0: no solution; with a x ≤ 0, d = 1 is a Farkas vector (the judge proves it);
//! - b > 0: two, x = 0 and x = b / |a|.
//!
//! Finite forces are not enough; an impulse is needed. The same rod with a time step, b_n = −fall,
//! slip −1 and the four-sided cone of [`Polyhedral`] always has a solution, because its matrix is
//! copositive (Stewart & Trinkle):
//!
//! ```text
//! apart    x = 0                                       if fall ≤ 0
//! slide    x_n = fall / a,   x_t = μ x_n               if x_n ≥ 0 and w_t = −1 + A_nt x_n + A_tt x_t ≤ 0
//! stick    x = ¼ [A_tt −A_nt; −A_nt A_nn] (fall, 1)    if |x_t| ≤ μ x_n
//! ```
//!
//! In the inconsistent case the end sticks at once, with an impulse that does not vanish with the
//! step size: x_n → ¾ sc. This is an impact without approach (Lecornu). In the indeterminate case
//! all three can hold. If a solution leaves only the mutually canceling parts of friction free, the
//! list has one solution.
//!
//! Painlevé 1895; Lecornu 1905; Génot & Brogliato 1999.

use dashu_ratio::RBig;

use super::{Expected, Generated, Parameter, Values, contacts, rational};
use crate::file::Problem;
use crate::friction::{Contact, FrictionProblem, Polyhedral};
use crate::{Lcp, Matrix};

const MU: Parameter = Parameter::real("mu", "coefficient of friction", 2.0, [0.0, 100.0]);
const TAN: Parameter =
    Parameter::real("tan", "tangent of the angle to the ground", 2.0, [0.01, 100.0]);

pub(super) const FAMILIES: &[Generated] = &[
    Generated {
        name: "painleve",
        about: "a rod slides: above μ = 4/3 no contact force exists, or two do (spin > 1)",
        source: "Painlevé 1895; critical μ = (4 + tan²θ) / (3 tan θ)",
        parameters: &[
            MU,
            TAN,
            Parameter::real("spin", "ω² sin θ in units of g: 0 falls, 2 lifts", 0.0, [0.0, 100.0]),
        ],
        make: forces,
    },
    Generated {
        name: "painleve-impulse",
        about: "the rod of painleve in a time step: always solvable; several solutions if fall < 0",
        source: "Stewart & Trinkle 1996; Anitescu & Potra 1997; Lecornu 1905",
        parameters: &[
            MU,
            TAN,
            Parameter::real(
                "fall",
                "−b_n, what gravity adds to the end's speed",
                0.125,
                [-10.0, 10.0],
            ),
        ],
        make: impulses,
    },
];

/// A_nn, A_nt and A_tt, from sc = t / (1 + t²) and c² = 1 / (1 + t²) with t = tan θ.
fn delassus(tan: f64) -> [f64; 3] {
    let square = 1.0 + tan * tan;
    [(square + 3.0) / square, -3.0 * tan / square, (1.0 + 4.0 * tan * tan) / square]
}

/// The acceleration level: one row.
fn forces(values: &Values) -> Problem {
    let [a_nn, a_nt, _] = delassus(values.real("tan"));
    let a = a_nn + values.real("mu") * a_nt;
    let b = values.real("spin") - 1.0;
    let balance = || vec![-rational(b) / rational(a)];
    let mut solutions = Vec::new();
    if b >= 0.0 {
        solutions.push(vec![RBig::ZERO]);
    }
    if (a < 0.0 && b > 0.0) || (a > 0.0 && b < 0.0) {
        solutions.push(balance());
    }
    contacts(Matrix::dense(1, &[a]), vec![b], &Expected { solutions, complete: true })
}

/// The velocity level: x_n, four directions, the slip speed γ along one of them.
fn impulses(values: &Values) -> Problem {
    let (mu, fall) = (values.real("mu"), values.real("fall"));
    let [a_nn, a_nt, a_tt] = delassus(values.real("tan"));
    // Perpendicular to its plane the rod moves with the inverse mass 1 + 3.
    let a = Matrix::dense(3, &[a_nn, a_nt, 0.0, a_nt, a_tt, 0.0, 0.0, 0.0, 4.0]);
    let (lo, hi) = (vec![0.0, f64::NEG_INFINITY, f64::NEG_INFINITY], vec![f64::INFINITY; 3]);
    let rod = Lcp::new(a, vec![-fall, -1.0, 0.0], lo, hi)
        .and_then(|lcp| FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu }]))
        .and_then(|problem| Polyhedral::new(&problem, 4))
        .expect("a family makes valid problems");
    let solutions = motions([a_nn, a_nt, a_tt, mu, fall].map(rational));
    let mut problem = Problem::new("", rod.lcp().clone());
    let expected = Expected { solutions, complete: false };
    problem.extra.insert("expected".into(), expected.json());
    problem
}

/// The unknowns (x_n, β_1 … β_4, γ) of the possible motions: apart, slide, stick.
fn motions([a_nn, a_nt, a_tt, mu, fall]: [RBig; 5]) -> Vec<Vec<RBig>> {
    let unknowns = |x_n: RBig, x_t: RBig, speed: RBig| {
        let [left, right] = if x_t < RBig::ZERO { [RBig::ZERO, -x_t] } else { [x_t, RBig::ZERO] };
        if mu == RBig::ZERO {
            return vec![x_n];
        }
        vec![x_n, left, RBig::ZERO, right, RBig::ZERO, speed]
    };
    let mut motions = Vec::new();
    if fall <= RBig::ZERO {
        motions.push(unknowns(RBig::ZERO, RBig::ZERO, RBig::ONE));
    }
    let a = &a_nn + &mu * &a_nt;
    if a != RBig::ZERO && &fall / &a > RBig::ZERO {
        let x_n = &fall / &a;
        let w_t = (&a_nt + &a_tt * &mu) * &x_n - RBig::ONE;
        if w_t <= RBig::ZERO {
            motions.push(unknowns(x_n.clone(), &mu * x_n, -w_t));
        }
    }
    // 4, up to rounding.
    let determinant = &a_nn * &a_tt - &a_nt * &a_nt;
    let x_n = (&a_tt * &fall - &a_nt) / &determinant;
    let x_t = (&a_nn - &a_nt * &fall) / &determinant;
    let limit = &mu * &x_n;
    if x_t <= limit && -&x_t <= limit {
        motions.push(unknowns(x_n, x_t, RBig::ZERO));
    }
    motions
}
