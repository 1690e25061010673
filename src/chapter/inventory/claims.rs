//! Claims and techniques from T1 to T34: formulations, solvers, constraints.

use super::Entry;
use super::Verdict::{Confirmed, Convention, Misleading, Misprint, Right, Wrong};

pub(super) const ENTRIES: &[Entry] = &[
    Entry::new("T1", Right, "The dynamics are written in block matrices.")
        .code(&["assembly", "explain::setup", "lcplab explain"])
        .lesson(&[3])
        .remark("lcplab explain prints each with its shape, unit and numbers."),
    Entry::new("T2", Misleading, "Most of the time goes into inverting A.")
        .errata(&["E11"])
        .code(&["bench pivoting", "report::study::comparison", "storage::sweep"])
        .lesson(&[5, 10])
        .remark("Nothing is inverted: a sweep or a factorization solves."),
    Entry::new("T3", Misleading, "A singular A shows in its determinant; find out why.")
        .errata(&["E10"])
        .code(&["certificate::regularity", "diagnosis", "certificate::uniqueness"])
        .lesson(&[6])
        .remark(
            "The determinant depends on units; singular values of the scaled matrix do not. \
         A is semidefinite in general, and a singular one may be solved.",
        ),
    Entry::new("T4", Right, "Lagrange multipliers bring constraints into Newton's law.")
        .code(&["lcp::Gauss", "reference::gauss", "test reference", "formulation::Problem::gauss"])
        .lesson(&[3])
        .remark("Gauss's principle, solved without multipliers, gives the same motion."),
    Entry::new("T5", Misleading, "A body has six degrees of freedom, each constraint takes some.")
        .errata(&["E18", "E19", "E20"])
        .code(&[
            "diagnosis::Freedoms",
            "test diagnosis::mechanisms_have_their_degrees_of_freedom",
            "test constraint::rank",
        ])
        .lesson(&[2])
        .remark(
            "What is taken is the rank of J, not the number of its rows: 6 m − rank J are \
         left.",
        ),
    Entry::new("T6", Right, "Maximal coordinates: modular, but with drift and many variables.")
        .errata(&["E20", "E64"])
        .code(&["scene pendulum", "scene bricard", "report::study::drift"])
        .lesson(&[7]),
    Entry::new("T7", Convention, "Reduced coordinates do not drift but must be derived by hand.")
        .code(&[
            "scene::catalogue::pendulum::Pendulum",
            "scene::catalogue::pendulum::DoublePendulum",
            "test simulation::integrators::the_double_pendulum_follows_the_one_in_angles",
        ])
        .lesson(&[7])
        .remark(
            "By hand only in Lagrange's way; recursive algorithms need no derivation. \
         Pendulum and double pendulum in angles are our ground truth.",
        ),
    Entry::new("T8", Convention, "Methods of both kinds run in O(n).")
        .code(&["solver::theory::sweeps_to", "report::study::rates", "test solver::first_order"])
        .lesson(&[4, 10])
        .remark(
            "For trees and the right algorithms. A sweep over a chain costs O(n), but about \
         n² sweeps are needed.",
        ),
    Entry::new("T9", Confirmed, "Penalty methods are simple and stiff and need small steps.")
        .code(&[
            "simulation::scheme::penalty",
            "test simulation::schemes::an_explicit_spring_is_stable_below_two_over_omega",
            "test simulation::schemes::a_penalty_spring_carries_its_load_by_an_error",
        ])
        .lesson(&[7])
        .remark("Stable below dt = 2/ω, as measured."),
    Entry::new(
        "T10",
        Misleading,
        "Impulse methods solve one constraint after the other until all hold.",
    )
    .errata(&["E66"])
    .code(&[
        "simulation::scheme::sequential",
        "test simulation::schemes::the_sweeps_of_sequential_impulses_are_those_of_pgs",
    ])
    .lesson(&[4])
    .remark(
        "With accumulated clamping they are the same iteration as PGS on the assembled \
         system.",
    ),
    Entry::new("T11", Right, "Global methods find all multipliers of a step together.")
        .code(&["formulation::Problem::velocity", "certificate::judge", "solver::pivot::dantzig"])
        .lesson(&[5, 6]),
    Entry::new("T12", Confirmed, "Global methods stay stable with large steps.")
        .code(&[
            "scene stack",
            "simulation::scheme",
            "report::study::drift",
            "test chapter::claims::a_stack_stands_at_large_steps",
        ])
        .lesson(&[7, 11])
        .remark(
            "A stack stands at every step from 1/240 s to 1/30 s; drift grows with the step \
         all the same.",
        ),
    Entry::new(
        "T13",
        Misleading,
        "Pivoting ends after finitely many steps and is fast, but fragile for many \
         rows.",
    )
    .errata(&["E08"])
    .code(&[
        "solver::pivot::dantzig",
        "solver::pivot::lemke",
        "test piles",
        "report::study::worst_cases",
    ])
    .lesson(&[5])
    .remark(
        "Finite, at worst exponential. In double precision large stacks are solved and \
         proved; the experience of the text was not met again.",
    ),
    Entry::new("T14", Misleading, "Iterations never end but come closer with every update.")
        .errata(&["E07", "E67"])
        .code(&[
            "trace::Convergence",
            "report::study::convergence",
            "test solver::pgs::no_sweep_raises_the_objective",
        ])
        .lesson(&[4, 6])
        .remark("The objective never rises; distance and residual may."),
    Entry::new("T15", Confirmed, "An iteration that is stopped early can be used.")
        .code(&[
            "scene persistence",
            "test certificate::motion_bound::every_sweep_tightens_the_bound_of_a_stack",
            "certificate::motion_bound",
        ])
        .lesson(&[4, 11])
        .remark("How far it is off is bounded by the judge."),
    Entry::new("T16", Misleading, "Start with the solution of the last frame.")
        .errata(&["E12"])
        .code(&["solver::Start", "simulation::solving", "scene warm_start"])
        .lesson(&[4, 11])
        .remark("See N6."),
    Entry::new("T17", Misleading, "Iterations cope with singular and over-constrained systems.")
        .errata(&["E10", "E61"])
        .code(&[
            "simulation::conflict",
            "test solver::every::a_singular_system_with_a_solution_is_no_ray",
            "scene fig8",
        ])
        .lesson(&[6])
        .remark("If the system is consistent. If not, x grows for ever."),
    Entry::new(
        "T18",
        Misleading,
        "Four reasons for iterations: robust, simple, stoppable, warm start.",
    )
    .errata(&["E08"])
    .code(&["report::study::convergence", "report::study::comparison", "lcplab compare-solvers"])
    .lesson(&[4, 5])
    .remark("Each is true of some problems; the comparison measures them on many."),
    Entry::new(
        "T19",
        Misprint,
        "Jacobi and Gauss-Seidel as bases, made fit for constraints; projected \
         Gauss-Seidel is chosen.",
    )
    .errata(&["E09"])
    .code(&[
        "solver::sweep::jacobi",
        "solver::sweep::pgs",
        "test solver::theory::jacobi_does_not_converge_on_every_definite_matrix",
    ])
    .lesson(&[4])
    .remark(
        "Contacts are called equalities there, and Jacobi needs more than a definite \
         matrix.",
    ),
    Entry::new("T20", Misleading, "Two or three sweeps suffice, or hundreds are needed.")
        .errata(&["E07"])
        .code(&[
            "solver::theory::sweeps_to",
            "report::study::rates",
            "test solver::theory::a_chain_of_50_rods_has_the_radii_of_its_closed_form",
        ])
        .lesson(&[4])
        .remark("A chain of 50 needs 3639 for six digits: cos² of π/51 a sweep."),
    Entry::new("T21", Confirmed, "Coupled piles and chains converge slowly.")
        .code(&["report::study::rates", "test report::rates", "scene stack50"])
        .lesson(&[4, 11])
        .remark("A column of n on the floor contracts by cos²(π/2n) a sweep."),
    Entry::new("T22", Wrong, "Stop after a fixed number of sweeps, or early by (4).")
        .errata(&["E04"])
        .code(&["solver::Settings", "lcp::merit::natural_residual", "report::study::merits"])
        .lesson(&[6])
        .remark("A fixed number works; the early way out never comes while a bound is active."),
    Entry::new(
        "T23",
        Misleading,
        "Two levels, acceleration and velocity, the latter a part of the former; \
         friction troubles the former.",
    )
    .errata(&["E14"])
    .code(&["scene painleve", "test simulation::painleve", "lcp::library::painleve"])
    .lesson(&[9])
    .remark(
        "Neither contains the other. Painlevé's rod: no forces exist at one level, \
         impulses do at the other, both proved.",
    ),
    Entry::new("T24", Right, "The velocity level needs no J̇.")
        .errata(&["E14"])
        .code(&[
            "formulation::velocity",
            "test simulation::pendulum::both_levels_give_one_motion_as_dt_shrinks",
        ])
        .lesson(&[3, 9])
        .remark("What J̇ u would give comes a step late, as an error of position."),
    Entry::new(
        "T25",
        Misleading,
        "Equations and inequalities; the force of the latter is clamped.",
    )
    .errata(&["E05", "E09", "E31"])
    .code(&["constraint::Bounds", "lcp::Lcp"])
    .lesson(&[1])
    .remark("Clamped by bounds of each row, which the listings leave out."),
    Entry::new("T26", Misleading, "Constraints that are not violated are left out.")
        .errata(&["E38"])
        .code(&["assembly::rows::Entering", "scene::settings::Contacts"])
        .lesson(&[7])
        .remark("See U3."),
    Entry::new("T27", Right, "Simple constraints combine to others.")
        .errata(&["E19"])
        .code(&[
            "constraint::hinge",
            "constraint::slider",
            "constraint::universal",
            "constraint::weld",
            "constraint::combined",
            "test constraint::rank",
        ])
        .lesson(&[2]),
    Entry::new(
        "T28",
        Misprint,
        "Three steps to a Jacobian: write c, differentiate, isolate the velocities.",
    )
    .errata(&["E15"])
    .code(&["constraint::verify", "constraint::Position", "example own_constraint"])
    .lesson(&[2])
    .remark(
        "Dual numbers take the second step for us, and check ours. J is rows by 6 m, \
         not as printed.",
    ),
    Entry::new("T29", Misprint, "Some Jacobians can be read off.")
        .errata(&["E18"])
        .code(&["constraint::axis_lock"])
        .lesson(&[2])
        .remark("In the example z is locked, which leaves the x-y plane."),
    Entry::new("T30", Right, "J is computed anew in each frame.")
        .code(&[
            "assembly::Assembly::new",
            "test explain::a_later_step_starts_where_the_one_before_ended",
        ])
        .lesson(&[2, 3]),
    Entry::new("T31", Right, "Friction acts against sliding.")
        .errata(&["E37"])
        .code(&[
            "lcp::friction",
            "formulation::friction",
            "report::study::friction",
            "report::study::sliding",
        ])
        .lesson(&[8])
        .remark("Named there without its bound μ λ; ours has four models side by side."),
    Entry::new("T32", Misleading, "A contact needs λ ≥ 0, and the ball bounces.")
        .errata(&["E37"])
        .code(&[
            "formulation::Problem::restitution",
            "scene bouncing_ball",
            "test simulation::impact::a_ball_bounces_to_e_squared_of_its_height",
        ])
        .lesson(&[9])
        .remark("Nothing in it makes a bounce; a term e J u does, to the height e²."),
    Entry::new("T33", Misleading, "Baumgarte's stabilization with β between 0 and 1.")
        .errata(&["E34", "E39"])
        .code(&[
            "formulation::velocity",
            "simulation::scheme",
            "report::study::drift",
            "constraint::Spring",
        ])
        .lesson(&[7])
        .remark(
            "Between 0 and 1 if β/dt is meant. Beside it: split impulse, position \
         corrections, springs as soft rows.",
        ),
    Entry::new("T34", Misleading, "Constraints stay valid at all times, under large forces too.")
        .errata(&["E64"])
        .code(&["report::study::drift", "test simulation::schemes"])
        .lesson(&[7])
        .remark("Velocities do; positions drift."),
];
