//! Suggestions of further work, and the key terms.

use super::Entry;
use super::Verdict::{Convention, Opinion, Rebuilt};

pub(super) const ENTRIES: &[Entry] = &[
    Entry::new("W1", Rebuilt, "Successive over-relaxation.")
        .code(&[
            "solver::sweep::pgs",
            "solver::theory::optimal_omega",
            "test solver::theory::omega_star_is_the_best_omega_of_a_chain",
            "report::study::convergence",
        ])
        .lesson(&[4])
        .remark("The solver sor, with the best ω of chains and columns in closed form."),
    Entry::new("W2", Rebuilt, "Parallel processors.")
        .code(&["solver::sweep::order", "test simulation::symmetry"])
        .lesson(&[4])
        .remark(
            "Rows of a colour are independent. Studies run in parallel; a solve does not, \
         and no graphics processor is used.",
        ),
    Entry::new("W3", Rebuilt, "More kinds of constraints, equations and inequalities.")
        .code(&[
            "constraint::limit",
            "constraint::motor",
            "constraint::gear",
            "constraint::pulley",
            "constraint::cone_limit",
            "constraint::rope",
        ])
        .lesson(&[2]),
    Entry::new("W4", Rebuilt, "Compare other forms of c, such as the squared length.")
        .code(&["constraint::squared_distance", "test constraint::rope"])
        .lesson(&[2])
        .remark("The same force, its multiplier scaled by 2 l."),
    Entry::new("W5", Opinion, "Read the newer literature.")
        .code(&["chapter::references", "lcplab chapter"])
        .lesson(&[5, 8])
        .remark(
            "lcplab chapter references lists what this library follows, with a word on \
         each.",
        ),
    Entry::new("W6", Rebuilt, "Profile and make it fast.")
        .code(&["bench judge", "bench pivoting", "report::study::comparison"])
        .lesson(&[10]),
    Entry::new("W7", Rebuilt, "Show kinetic and potential energy.")
        .code(&[
            "simulation::Motion",
            "simulation::Ledger",
            "report::study::drift",
            "lcplab simulate",
        ])
        .lesson(&[7])
        .remark("The ledger says where each joule went."),
    Entry::new("W8", Rebuilt, "Build bridge, ragdoll, catapult, rope.")
        .code(&["scene bridge", "scene ragdoll", "scene catapult", "scene rope"])
        .lesson(&[7]),
    Entry::new("W9", Rebuilt, "Further kinds of constraints.")
        .code(&["constraint::ALL", "example own_constraint"])
        .lesson(&[2])
        .remark("See W3; lcplab scenes --joints lists them."),
    Entry::new("W10", Rebuilt, "Show external forces and those of constraints.")
        .code(&["film::arrow", "lcplab simulate"])
        .lesson(&[7])
        .remark("lcplab simulate --forces draws them, forces.csv has every row."),
    Entry::new("W11", Rebuilt, "Different masses in structures of points.")
        .errata(&["E47"])
        .code(&[
            "scene::generate::Chain",
            "report::study::rates",
            "scene mass_ratio3",
            "test scene::generate::the_links_of_a_rope_balance_at_every_mass",
        ])
        .lesson(&[4]),
    Entry::new("W12", Rebuilt, "Make sparse operations fast, and look at bandwidth.")
        .code(&["storage::CompressedRows", "storage::BlockRows", "report::study::sparsity"])
        .lesson(&[10]),
    Entry::new(
        "K1",
        Convention,
        "Key terms: degrees of freedom, equations of motion, constraint, inertia, mass, \
         centre of mass, weight, moment of inertia, acceleration, velocity, Newton's \
         laws, linear system.",
    )
    .errata(&["E62"])
    .code(&["chapter::glossary", "lcplab chapter"])
    .lesson(&[1, 2, 3])
    .remark(
        "Centre of mass and centroid agree at uniform density only. lcplab chapter \
         glossary has each term with the function that computes it.",
    ),
];
