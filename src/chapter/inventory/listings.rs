//! The listings, and what stands between them.

use super::Entry;
use super::Verdict::{Misleading, Misprint, Right, Wrong};
use crate::chapter::code;

pub(super) const ENTRIES: &[Entry] = &[
    Entry::new("Code 1", Right, "A step without constraints in block matrices.")
        .errata(code::code01_unconstrained_step::LISTING.errata)
        .code(&[
            "chapter::code::code01_unconstrained_step",
            "formulation::velocity",
            "body::State::advanced",
        ])
        .lesson(&[3]),
    Entry::new("Code 2", Misleading, "The step with the solved impulses.")
        .errata(code::code02_constrained_step::LISTING.errata)
        .code(&["chapter::code::code02_constrained_step", "formulation::Problem::next_velocity"])
        .lesson(&[3])
        .remark(
            "Right with the impulses of Code 4, not with (23); its comment says that there \
         are no constraints.",
        ),
    Entry::new(
        "Code 3",
        Wrong,
        "The update of a frame: forces, then constraints, which also move the bodies.",
    )
    .errata(code::code03_update::LISTING.errata)
    .code(&["chapter::code::code03_update", "simulation::Simulation::step"])
    .lesson(&[3])
    .remark("Without a constraint nothing moves and forces pile up."),
    Entry::new("Code 4", Misleading, "A and b with feedback of errors, and the solve.")
        .errata(code::code04_drift_correction::LISTING.errata)
        .code(&["chapter::code::code04_drift_correction", "formulation::Problem::velocity"])
        .lesson(&[3, 7]),
    Entry::new(
        "Code 5",
        Wrong,
        "The rigid body: state, force, torque, and the inverse inertia in world axes.",
    )
    .errata(code::code05_rigid_body::LISTING.errata)
    .code(&["chapter::code::code05_rigid_body", "body::Body", "body::inertia"])
    .lesson(&[3])
    .remark(
        "The torque r × F is right, and so is the inertia for row vectors; the \
         gyroscopic torque is missing and the caption names an integrator.",
    ),
    Entry::new("Code 6", Wrong, "Gauss-Seidel with bounds.")
        .errata(code::code06_solver::LISTING.errata)
        .code(&["chapter::code::code06_solver", "solver::sweep::Code6", "solver::sweep::Pgs"])
        .lesson(&[4])
        .remark(
            "It clamps after the sweep: wrong limits, and divergence on definite matrices. \
         Without active bounds it is right.",
        ),
    Entry::new(
        "class",
        Misleading,
        "The base class of constraints: penalty, block of J for a body, number of rows.",
    )
    .errata(code::constraint_class::LISTING.errata)
    .code(&["chapter::code::constraint_class", "constraint::Constraint", "example own_constraint"])
    .lesson(&[2])
    .remark(
        "Ours asks for c, J, J̇u and bounds, and names its rows so that x can be kept \
         from step to step.",
    ),
    Entry::new(
        "method",
        Misleading,
        "IsEquality tells equations from inequalities, and says no unless overridden.",
    )
    .errata(&["E31"])
    .code(&["chapter::code::constraint_class", "constraint::Bounds"])
    .lesson(&[1, 3])
    .remark(
        "Code 7 never asks it, and the default would release every joint. Ours has \
         bounds in each row and no default.",
    ),
    Entry::new("Code 7", Wrong, "The whole step: gather, J, A, b, solve, scatter.")
        .errata(code::code07_whole_step::LISTING.errata)
        .code(&[
            "chapter::code::code07_whole_step",
            "simulation::Simulation::step",
            "assembly::Assembly",
        ])
        .lesson(&[3])
        .remark("Its step of equations is right; each fault of the rest has its exhibit."),
    Entry::new("Code 8", Wrong, "The same with matrices that are written like numbers.")
        .errata(code::code08_matrix_program::LISTING.errata)
        .code(&["chapter::code::code08_matrix_program", "explain::derivation"])
        .lesson(&[3, 10])
        .remark(
            "It transposes J before filling it, lacks a dt, and its velocities have another \
         shape.",
        ),
    Entry::new("Code 9", Right, "The three members of a dense matrix.")
        .code(&["chapter::code::code09_10_dense_matrix", "storage::Dense"])
        .lesson(&[10]),
    Entry::new("Code 10", Wrong, "Construction and access of the dense matrix, with checks.")
        .errata(code::code09_10_dense_matrix::ACCESS.errata)
        .code(&["chapter::code::code09_10_dense_matrix", "storage::Dense", "storage::error"])
        .lesson(&[10])
        .remark(
            "The index formula is right. Copies free memory twice, which safe Rust cannot \
         do; the limit of 500 forbids the chapter's own tower.",
        ),
    Entry::new("Code 11", Wrong, "A sparse matrix as a map of maps.")
        .errata(code::code11_map_matrix::LISTING.errata)
        .code(&["chapter::code::code11_map_matrix", "storage::MapOfMaps"])
        .lesson(&[10])
        .remark("Clearing does nothing, data are read by columns, zeros are stored."),
    Entry::new(
        "operators",
        Misprint,
        "Declarations of product, transpose, sum, difference and scaling.",
    )
    .errata(code::code11_map_matrix::OPERATORS.errata)
    .code(&["storage::product", "lcp::matrix::Matrix"])
    .lesson(&[10])
    .remark("A product of three needs constant references in standard C++."),
];
