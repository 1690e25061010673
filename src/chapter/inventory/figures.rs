//! The figures and the table.

use super::Entry;
use super::Verdict::{Confirmed, Misleading, Rebuilt, Wrong};

pub(super) const ENTRIES: &[Entry] = &[
    Entry::new("Fig 1", Rebuilt, "Pictures: a stable stack, an articulated figure, chains.")
        .code(&["scene stack", "scene ragdoll", "scene chain", "film"])
        .lesson(&[11]),
    Entry::new(
        "Fig 2",
        Misleading,
        "The steps of both levels side by side, velocity and acceleration.",
    )
    .errata(&["E14"])
    .code(&["formulation", "explain::derivation", "lcplab explain"])
    .lesson(&[3])
    .remark("Two of its steps are lost in the text. Neither level is a part of the other."),
    Entry::new("Fig 3", Rebuilt, "The constraints as a linear system, each part named.")
        .errata(&["E02", "E22"])
        .code(&["explain::derivation", "lcplab explain"])
        .lesson(&[3])
        .remark("The picture is lost; ours is printed with shapes and units."),
    Entry::new("Fig 4", Wrong, "From the velocity step to the system in four lines.")
        .errata(&["E22"])
        .code(&["explain::derivation", "lcplab explain"])
        .lesson(&[3])
        .remark(
            "F = Jᵀλ, and a minus is lost. Ours fills in every line with the scene's \
         numbers.",
        ),
    Entry::new("Fig 5", Misleading, "How mass, force, velocity, S and positions are laid out.")
        .errata(&["E27"])
        .code(&["explain::setup", "assembly::Block"])
        .lesson(&[3, 10])
        .remark("Velocities stand on a diagonal there, in a column elsewhere."),
    Entry::new("Fig 6", Misleading, "One object at rest on an immovable surface, with numbers.")
        .errata(&["E48"])
        .code(&[
            "scene fig6",
            "test simulation::resting::figure_6_stops_within_a_step",
            "test worked_examples",
        ])
        .lesson(&[1, 3])
        .remark(
            "The picture is lost. The force [1, 1] of the text needs both forces upward, \
         against Newton's third law.",
        ),
    Entry::new(
        "Fig 7",
        Confirmed,
        "Three equal objects in a stack, the middle one moving down, come to rest in \
         one step.",
    )
    .code(&[
        "scene fig7",
        "test simulation::resting::figure_7_has_the_impulses_of_the_errata",
        "test worked_examples",
    ])
    .lesson(&[1, 4])
    .remark("The impulses are 4, 3, 1 for m = g = dt = 1, proved exactly."),
    Entry::new(
        "Fig 8",
        Misleading,
        "Impossible constraints: two far nails and a joint between them.",
    )
    .errata(&["E61"])
    .code(&["scene fig8", "diagnosis", "simulation::conflict", "lcplab diagnose"])
    .lesson(&[6])
    .remark(
        "No best fit is found: the impulses grow for ever. Ours names the three rows \
         and proves that they contradict each other.",
    ),
    Entry::new("Fig 9", Rebuilt, "Structures of point masses, nails and rods.")
        .code(&["scene net", "scene rope", "scene figure", "scene chain"])
        .lesson(&[4]),
    Entry::new("Fig 10", Rebuilt, "An orientation read from point masses.")
        .code(&[
            "body::alignment",
            "scene three_points",
            "test body::the_rotation_of_three_points_is_found_again",
        ])
        .lesson(&[2])
        .remark("The orthogonal factor of the polar decomposition."),
    Entry::new("Fig 11", Misleading, "A large sphere falls on a net.")
        .errata(&["E65"])
        .code(&[
            "scene sphere_net",
            "test simulation::demonstrations::a_net_holds_a_ball_that_no_point_enters",
        ])
        .lesson(&[11])
        .remark(
            "The text keeps a distance, which would glue the sphere to the net; it must be \
         at least that.",
        ),
    Entry::new("Fig 12", Rebuilt, "A round tower of 700 cubes.")
        .errata(&["E50"])
        .code(&[
            "scene tower",
            "scene::generate::circular_tower",
            "test simulation::stacking::a_tower_stands_on_few_sweeps",
        ])
        .lesson(&[10, 11])
        .remark("Its matrices are larger than the chapter's own limits allow."),
    Entry::new(
        "Fig 13",
        Confirmed,
        "The pattern of A for net and tower; that of a net is less than 1 % full.",
    )
    .code(&[
        "plot::spy",
        "report::study::sparsity",
        "test formulation::the_net_is_sparse_and_small_problems_are_dense",
    ])
    .lesson(&[10])
    .remark("True from 19 by 19 points on, where it is 0.98 %."),
    Entry::new("Table 1", Wrong, "Memory of the dense matrix against the map of maps.")
        .errata(&["E57"])
        .code(&["storage::Storage", "storage::ALL"])
        .lesson(&[10])
        .remark("Its numbers are lost in the text; those around it are corrected by ours."),
];
