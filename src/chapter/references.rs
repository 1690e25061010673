//! Literature after and before the chapter, with a word on each and where the library follows it.

use crate::document::{Document, Section};

/// A paper or book.
#[derive(Debug, Clone, Copy)]
pub struct Reference {
    /// Authors and year, as the library's documentation cites it.
    pub cited: &'static str,
    /// Its title.
    pub title: &'static str,
    /// What to read it for.
    pub about: &'static str,
    /// Where the library follows it.
    pub code: &'static [&'static str],
}

/// References by subject, each subject in the order of years.
pub const REFERENCES: &[(&str, &[Reference])] = &[
    (
        "The problem",
        &[
            Reference {
                cited: "Kenwright & Morgan 2012",
                title: "Practical Introduction to Rigid Body Linear Complementary Problem (LCP) \
         Constraint Solvers",
                about: "The chapter: from Newton's law to a constraint solver in eleven listings.",
                code: &["chapter::inventory"],
            },
            Reference {
                cited: "Cottle, Pang & Stone 1992",
                title: "The Linear Complementarity Problem",
                about: "The book of the field: classes of matrices, existence, pivoting and \
         iteration.",
                code: &["lcp", "solver::class"],
            },
            Reference {
                cited: "Bender, Erleben & Trinkle 2014",
                title: "Interactive Simulation of Rigid Body Dynamics in Computer Graphics",
                about: "A survey of formulations, friction and solvers after the chapter.",
                code: &["formulation"],
            },
        ],
    ),
    (
        "Pivoting",
        &[
            Reference {
                cited: "Lemke 1965",
                title: "Bimatrix Equilibrium Points and Mathematical Programming",
                about: "The complementary path with an artificial variable.",
                code: &["solver::pivot::lemke"],
            },
            Reference {
                cited: "Cottle & Dantzig 1968",
                title: "Complementary Pivot Theory of Mathematical Programming",
                about: "Principal pivoting: one variable is driven until its row is met.",
                code: &["solver::pivot::dantzig"],
            },
            Reference {
                cited: "Murty 1974",
                title: "Note on a Bard-type Scheme for Solving the Complementarity Problem",
                about: "The least index decides, and nothing cycles.",
                code: &["solver::pivot::murty"],
            },
            Reference {
                cited: "Baraff 1994",
                title: "Fast Contact Force Computation for Nonpenetrating Rigid Bodies",
                about: "Dantzig's method for contacts, with friction.",
                code: &["solver::pivot::dantzig"],
            },
        ],
    ),
    (
        "Iteration",
        &[
            Reference {
                cited: "Young 1950",
                title: "Iterative Methods for Solving Partial Difference Equations of Elliptic Type",
                about: "The best ω of over-relaxation from the radius of Jacobi's method.",
                code: &["solver::theory::optimal_omega"],
            },
            Reference {
                cited: "Cryer 1971",
                title: "The Solution of a Quadratic Programming Problem Using Systematic \
         Overrelaxation",
                about: "The clamp inside the sweep, and why it converges.",
                code: &["solver::sweep::pgs"],
            },
            Reference {
                cited: "Mangasarian 1977",
                title: "Solution of Symmetric Linear Complementarity Problems by Iterative Methods",
                about: "Convergence of projected splittings for symmetric matrices.",
                code: &["solver::sweep::jacobi", "solver::sweep::pgs"],
            },
            Reference {
                cited: "Luo & Tseng 1991",
                title: "On the Convergence of a Matrix Splitting Algorithm for the Symmetric \
         Monotone Linear Complementarity Problem",
                about: "Convergence for semidefinite A too, where contacts are redundant.",
                code: &["solver::sweep::pgs"],
            },
            Reference {
                cited: "Fischer 1992",
                title: "A Special Newton-type Optimization Method",
                about: "One equation that holds exactly at complementary pairs.",
                code: &["lcp::merit::fischer_burmeister", "solver::newton::semismooth"],
            },
            Reference {
                cited: "Mehrotra 1992",
                title: "On the Implementation of a Primal-Dual Interior Point Method",
                about: "Predictor and corrector.",
                code: &["solver::newton::interior_point"],
            },
            Reference {
                cited: "Dostál & Schöberl 2005",
                title: "Minimizing Quadratic Functions Subject to Bound Constraints with the Rate of \
         Convergence and Finite Termination",
                about: "Projected conjugate gradients with a proved rate.",
                code: &["solver::gradient::mprgp"],
            },
            Reference {
                cited: "Silcowitz, Niebe & Erleben 2010",
                title: "A Nonsmooth Nonlinear Conjugate Gradient Method for Interactive Contact \
         Force Problems",
                about: "Conjugate gradients around sweeps.",
                code: &["solver::gradient::nncg"],
            },
            Reference {
                cited: "Goulart & Chen 2024",
                title: "Clarabel: An Interior-Point Solver for Conic Programs with Quadratic \
         Objectives",
                about: "The independent reference of our comparisons.",
                code: &["reference"],
            },
        ],
    ),
    (
        "Time stepping and friction",
        &[
            Reference {
                cited: "Painlevé 1895",
                title: "Sur les lois du frottement de glissement",
                about: "Dry friction at the level of accelerations may have no solution.",
                code: &["lcp::library::painleve"],
            },
            Reference {
                cited: "De Saxcé & Feng 1991",
                title: "New Inequality and Functional for Contact with Friction: The Implicit \
         Standard Material Approach",
                about: "Coulomb's law as complementarity on a cone, with a shifted velocity.",
                code: &["lcp::friction", "solver::cone"],
            },
            Reference {
                cited: "Stewart & Trinkle 1996",
                title: "An Implicit Time-Stepping Scheme for Rigid Body Dynamics with Inelastic \
         Collisions and Coulomb Friction",
                about: "Impulses over a step in place of forces at an instant, friction in a \
         polyhedral cone.",
                code: &["lcp::friction::polyhedral"],
            },
            Reference {
                cited: "Anitescu & Potra 1997",
                title: "Formulating Dynamic Multi-Rigid-Body Contact Problems with Friction as \
         Solvable Linear Complementarity Problems",
                about: "Why Lemke's method always finds these impulses.",
                code: &["lcp::friction::polyhedral"],
            },
            Reference {
                cited: "Génot & Brogliato 1999",
                title: "New Results on Painlevé Paradoxes",
                about: "When the rod of Painlevé has no, one or two solutions.",
                code: &["lcp::library::painleve"],
            },
            Reference {
                cited: "Tasora & Anitescu 2011",
                title: "A Matrix-Free Cone Complementarity Approach for Solving Large-Scale, \
         Nonsmooth, Rigid Body Dynamics",
                about: "The convex cone model, by sweeps without a matrix.",
                code: &["solver::cone"],
            },
            Reference {
                cited: "Acary, Cadoux, Lemaréchal & Malick 2011",
                title: "A Scheme of the Linear Discrete Coulomb Friction Problem via Convex \
         Optimization",
                about: "Coulomb's law as a fixed point of convex problems.",
                code: &["solver::gradient::apgd"],
            },
            Reference {
                cited: "Mazhar, Heyn, Negrut & Tasora 2015",
                title: "Using Nesterov's Method to Accelerate Multibody Dynamics with Friction and \
         Contact",
                about: "Accelerated projected gradients with restart.",
                code: &["solver::gradient::apgd"],
            },
        ],
    ),
    (
        "Drift and stabilization",
        &[
            Reference {
                cited: "Baumgarte 1972",
                title: "Stabilization of Constraints and Integrals of Motion in Dynamical Systems",
                about: "Feedback of position errors into the equations.",
                code: &["formulation::velocity", "formulation::acceleration"],
            },
            Reference {
                cited: "Cline & Pai 2003",
                title: "Post-stabilization for Rigid Body Simulation with Contact and Constraints",
                about: "Positions corrected after the step, apart from velocities.",
                code: &["formulation::position"],
            },
            Reference {
                cited: "Catto 2005",
                title: "Iterative Dynamics with Temporal Coherence",
                about: "Sweeps on velocities with accumulated impulses and warm start: sequential \
         impulses.",
                code: &["simulation::scheme::sequential"],
            },
            Reference {
                cited: "Catto 2011",
                title: "Soft Constraints",
                about: "A spring as a row with bias and compliance, stable at every stiffness.",
                code: &["constraint::Spring", "simulation::scheme::soft"],
            },
            Reference {
                cited: "Macklin, Müller & Chentanez 2016",
                title: "XPBD: Position-Based Simulation of Compliant Constrained Dynamics",
                about: "Positions first, with a compliance that is physical.",
                code: &["simulation::scheme::xpbd"],
            },
        ],
    ),
    (
        "Numbers",
        &[
            Reference {
                cited: "Kabsch 1976",
                title: "A Solution for the Best Rotation to Relate Two Sets of Vectors",
                about: "The orientation of a cloud of points.",
                code: &["body::alignment"],
            },
            Reference {
                cited: "Ogita, Rump & Oishi 2005",
                title: "Accurate Sum and Dot Product",
                about: "Sums in twice the working precision, by which the judge judges.",
                code: &["lcp::accurate"],
            },
        ],
    ),
];

/// The list.
pub fn document() -> Document {
    let mut document = Document {
        title: "Literature".into(),
        lead: "What this library follows; each method's own page cites more.".into(),
        is_accepted: true,
        ..Document::default()
    };
    for (subject, references) in REFERENCES {
        let mut section = Section::new(*subject);
        for Reference { cited, title, about, code } in *references {
            section.say(format!("{cited}: {title}. {about} [{}]", code.join(", ")));
        }
        document.add("", section);
    }
    document
}
