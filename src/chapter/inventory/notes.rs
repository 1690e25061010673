//! The note boxes, in the order of the text.

use super::Entry;
use super::Verdict::{Misleading, Misprint, Opinion, Right};

pub(super) const ENTRIES: &[Entry] = &[
    Entry::new(
        "N1",
        Misleading,
        "A constraint has one or two bodies, and with two the blocks are mirrored.",
    )
    .errata(&["E46"])
    .code(&["constraint::Constraint", "constraint::arms"])
    .lesson(&[2])
    .remark("The linear blocks are; the angular ones have the arms of their own bodies."),
    Entry::new(
        "N2",
        Misprint,
        "λ tells the loads within a structure; no diagonal entry of A may be 0.",
    )
    .errata(&["E63"])
    .code(&[
        "simulation::record::Solve",
        "formulation::Problem::efforts",
        "lcplab simulate",
        "diagnosis::Cause",
    ])
    .lesson(&[6])
    .remark(
        "λ is a force, no strain. lcplab simulate --out writes x and w of every row \
         with units to forces.csv, and a zero row is named.",
    ),
    Entry::new("N3", Misleading, "Masses that are 0 or huge can break the solver.")
        .errata(&["E47"])
        .code(&[
            "body::Mass",
            "test solver::theory::two_bodies_converge_at_r_over_one_plus_r",
            "scene mass_ratio2",
        ])
        .lesson(&[4, 11])
        .remark(
            "An inverse mass of 0 is exact. A huge mass hurts only where something light \
         must carry it.",
        ),
    Entry::new("N4", Misleading, "Feedback repairs a bad start, and pushes contacts apart.")
        .errata(&["E39"])
        .code(&[
            "scene stretched_chain",
            "scene overlap_recovery",
            "simulation::scheme::split_impulse",
            "report::study::drift",
        ])
        .lesson(&[7])
        .remark("It is no spring, and the push stays as kinetic energy."),
    Entry::new("N5", Opinion, "While debugging, switch rotation off.")
        .code(&["body::Mass", "constraint::axis_lock", "scene figure"])
        .lesson(&[3])
        .remark("A body of shape point has no rotation, and rows can lock single axes."),
    Entry::new("N6", Misleading, "Start from the last solution instead of clearing the unknowns.")
        .errata(&["E12"])
        .code(&[
            "solver::Start",
            "assembly::rows::RowId",
            "scene warm_start",
            "test scene::contacts::persistence",
        ])
        .lesson(&[4, 11])
        .remark(
            "Leaving out the line that clears x does not do it in Code 7; x must be kept \
         and matched by the names of rows.",
        ),
    Entry::new("N7", Right, "A zero on the diagonal sends the solution to infinity.")
        .code(&["solver::Status", "test solver::pgs::a_zero_diagonal_is_named", "diagnosis::Cause"])
        .lesson(&[4, 6])
        .remark("Ours is a status with the row, and x stays finite."),
    Entry::new(
        "N8",
        Opinion,
        "A wrapper for matrices gives room for checks, other platforms, templates.",
    )
    .code(&["lcp::matrix::Matrix", "storage::Storage"])
    .lesson(&[10])
    .remark(
        "Dense and sparse A are one type here; nalgebra and faer do the algebra and \
         check shapes.",
    ),
    Entry::new("N9", Right, "Learn to tell singular matrices, by a row of zeros for instance.")
        .code(&["certificate::regularity", "diagnosis", "lcplab diagnose"])
        .lesson(&[6])
        .remark(
            "Zero rows, dependent rows, rank, condition number and null vectors are \
         reported, with the cause in words.",
        ),
];
