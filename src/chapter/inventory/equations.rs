//! The numbered equations.

use super::Entry;
use super::Verdict::{Convention, Misleading, Misprint, Right, Wrong};

pub(super) const ENTRIES: &[Entry] = &[
    Entry::new(
        "(1)",
        Wrong,
        "The boxed LCP: y = A x + b, where the sign of y says at which bound x stands.",
    )
    .errata(&["E01", "E02"])
    .code(&["lcp::Lcp", "certificate::judge", "solver::pivot::dantzig"])
    .lesson(&[1])
    .remark(
        "Taken by the letter, its three implications overlap at y = 0. Ours reads: w > \
         0 only at the lower bound, w < 0 only at the upper one.",
    ),
    Entry::new(
        "(2)",
        Misprint,
        "Gauss-Seidel: each unknown from its own row, with the newest values of the \
         others.",
    )
    .errata(&["E03"])
    .code(&[
        "solver::sweep::pgs",
        "solver::theory::sor_iteration_matrix",
        "test solver::code6::without_bounds_it_is_gauss_seidel",
    ])
    .lesson(&[4])
    .remark("The coefficients are missing from the sums; the listing has them."),
    Entry::new("(3)", Right, "An unknown outside its bounds is put on the nearer one.")
        .code(&["lcp::Lcp::project", "test solver::every::one_row_is_clamped_to_its_box"])
        .lesson(&[1, 4])
        .remark("It is the median of the bounds and the value."),
    Entry::new("(4)", Wrong, "Stop when |b − A x| / |b| is small.")
        .errata(&["E04"])
        .code(&[
            "lcp::merit::km4",
            "lcp::merit::natural_residual",
            "lcp::merit::scaled_residual",
            "report::study::merits",
        ])
        .lesson(&[6])
        .remark(
            "At an active bound b − A x is not to vanish, so the test never fires. It is \
         kept as a specimen beside the residuals that do.",
        ),
    Entry::new("(5)", Right, "The rate of a constraint is J times the velocities: ċ = J u.")
        .code(&[
            "constraint::Constraint",
            "assembly::Assembly::push_forward",
            "constraint::verify",
            "test constraint::dual",
        ])
        .lesson(&[2])
        .remark("Checked for every joint against dual numbers at random states."),
    Entry::new("(6)", Right, "A body's velocity is its linear and its angular velocity, stacked.")
        .errata(&["E40"])
        .code(&["body::State", "body::linear", "body::angular", "body::stack"])
        .lesson(&[2])
        .remark(
            "A point mass has the first three only. The stack is no derivative of three \
         angles: E40.",
        ),
    Entry::new("(7)", Wrong, "J consists of a linear and an angular block.")
        .errata(&["E16"])
        .code(&["constraint::Row", "assembly::rows::Part"])
        .lesson(&[2])
        .remark(
            "The split holds as ċ = J_v v + J_ω ω; the line after it needs other matrices \
         under these names.",
        ),
    Entry::new("(8)", Wrong, "The two velocities are the blocks times the coordinates' rate.")
        .errata(&["E16"])
        .code(&["body::linear", "body::angular"])
        .lesson(&[2])
        .remark("The shapes do not fit; v and ω are picked out of u, no block of J is involved."),
    Entry::new("(9)", Wrong, "J is the change of the input over the change of the output.")
        .errata(&["E17"])
        .code(&["constraint::verify", "constraint::Position"])
        .lesson(&[2])
        .remark("It is output over input, ∂c/∂s; finite differences and dual numbers say so."),
    Entry::new(
        "(10)",
        Right,
        "The rate of the constraints is J u, as the central relation once more.",
    )
    .code(&["assembly::Assembly::push_forward"])
    .lesson(&[2, 3])
    .remark(
        "The same as (5). With which sign of J it is used varies through the chapter: \
         E30.",
    ),
    Entry::new("(11)", Right, "A constraint that is met has c(s) = 0.")
        .code(&["constraint::Position", "test constraint::dual::a_joint_holds_where_it_was_made"])
        .lesson(&[2]),
    Entry::new("(12)", Right, "Then its rate is 0 as well.")
        .code(&["formulation::Problem::velocity", "constraint::Row"])
        .lesson(&[2])
        .remark(
            "True along a motion that keeps c = 0, not at one instant at which c happens to \
         be 0.",
        ),
    Entry::new(
        "(13)",
        Right,
        "The standard LCP: b = A x + q, both sides at least 0 and orthogonal.",
    )
    .errata(&["E02"])
    .code(&["lcp::Lcp", "solver::pivot::standard_form", "solver::pivot::lemke::Lemke"])
    .lesson(&[1])
    .remark(
        "Bounds 0 and ∞ make (1) of it. Its b is the w of (1), and joints need x \
         without bounds, which (1) has.",
    ),
    Entry::new("(14)", Right, "A linear system A x = b.")
        .errata(&["E02", "E10"])
        .code(&[
            "solver::linalg::ldlt",
            "reference::box_qp",
            "test solver::a_linear_system_takes_one_step_of_the_minimum_map",
        ])
        .lesson(&[1, 6])
        .remark("Its b has the opposite sign to that of (1), and A is semidefinite in general."),
    Entry::new("(15)", Misleading, "The inequalities A x ≥ b, x ≥ 0 for one-sided constraints.")
        .errata(&["E05"])
        .code(&["lcp::Lcp", "certificate::judge"])
        .lesson(&[1])
        .remark("Without complementarity a half line of points satisfies them."),
    Entry::new("(16)", Wrong, "A step: first the velocity, then the position.")
        .errata(&["E21"])
        .code(&["body::State::advanced", "simulation::scheme", "scene free_fall"])
        .lesson(&[3])
        .remark("The second line as printed forgets the position."),
    Entry::new("(17)", Right, "The velocity changes by dt M⁻¹ F.")
        .code(&[
            "formulation::velocity",
            "assembly::Assembly::accelerate",
            "test simulation::free::the_velocity_of_free_fall_is_exact",
        ])
        .lesson(&[3])
        .remark("Exact for a constant force."),
    Entry::new("(18)", Wrong, "The rate of the orientation from the angular velocity.")
        .errata(&["E24"])
        .code(&["body::State::rate", "scene dzhanibekov"])
        .lesson(&[3])
        .remark("q̇ = ½ (0, ω) q; in print the rate stands on both sides, perhaps by the scan."),
    Entry::new("(19)", Right, "The linear part of the step.")
        .code(&[
            "body::State::advanced",
            "test simulation::integrators::each_integrator_has_its_order_on_the_pendulum",
        ])
        .lesson(&[3, 7])
        .remark("Semi-implicit Euler: first order, and no drift of energy over long times."),
    Entry::new("(20)", Wrong, "The angular part of the step.")
        .errata(&["E25", "E26"])
        .code(&["body::gyroscopic", "body::Body", "test simulation::free"])
        .lesson(&[3])
        .remark(
            "The torque belongs where an angular velocity is printed, and the gyroscopic \
         torque is missing. The second line is right.",
        ),
    Entry::new("(21)", Right, "The velocity step of all bodies in block matrices.")
        .errata(&["E26"])
        .code(&["assembly::Assembly::accelerate", "formulation::velocity"])
        .lesson(&[3])
        .remark("Right for what F contains; the gyroscopic torque must be in it."),
    Entry::new("(22)", Right, "The position step of all bodies with the block matrix S.")
        .code(&["body::State::advanced", "body::State::rate"])
        .lesson(&[3])
        .remark("S is applied as a block operator and never stored."),
    Entry::new(
        "(23)",
        Misleading,
        "The velocity step with the constraints' term, subtracted and multiplied by dt.",
    )
    .errata(&["E28", "E30"])
    .code(&["formulation::Problem::next_velocity"])
    .lesson(&[3])
    .remark(
        "Right if x is a force of its sign system; the listings have impulses. Ours: u⁺ \
         = u* + M⁻¹ Jᵀ x.",
    ),
    Entry::new("(24)", Right, "The same position step after it.")
        .code(&["formulation::Problem::next_states"])
        .lesson(&[3]),
    Entry::new("(25)", Misleading, "Feed a part β of the error back into the rate (Baumgarte).")
        .errata(&["E34", "E35"])
        .code(&["formulation::velocity", "test simulation::schemes", "scene stretched_chain"])
        .lesson(&[7])
        .remark("Without 1/dt, β is a rate in 1/s, and its sign must be that of J."),
    Entry::new("(26)", Misleading, "A weld keeps six coordinates of a body constant.")
        .errata(&["E40"])
        .code(&["constraint::weld", "constraint::orientation"])
        .lesson(&[2])
        .remark(
            "Three angles are no coordinates whose rates are ω; ours uses the error of the \
         quaternion.",
        ),
    Entry::new("(27)", Misleading, "The rate of the weld.")
        .errata(&["E40"])
        .code(&[
            "constraint::orientation",
            "test constraint::dual::every_joint_to_the_world_matches_dual_numbers",
        ])
        .lesson(&[2]),
    Entry::new("(28)", Right, "The Jacobian of the weld is the identity.")
        .errata(&["E40"])
        .code(&["constraint::weld"])
        .lesson(&[2])
        .remark("Exact where c = 0, and as a constraint on velocities everywhere."),
    Entry::new("(29)", Right, "A row that forbids motion along x.")
        .code(&["constraint::axis_lock", "constraint::axis_lock::Motion"])
        .lesson(&[2]),
    Entry::new("(30)", Right, "A row that forbids turning about y.")
        .code(&["constraint::axis_lock", "constraint::axis_lock::Motion"])
        .lesson(&[2]),
    Entry::new("(31)", Right, "A ball joint: two anchors are the same point.")
        .code(&["constraint::coincidence", "scene ball_chain"])
        .lesson(&[2]),
    Entry::new("(32)", Right, "The rate of the ball joint, with the velocities of the anchors.")
        .code(&["constraint::coincidence", "constraint::arms"])
        .lesson(&[2]),
    Entry::new("(33)", Wrong, "The blocks of the ball joint, with skew matrices of the arms.")
        .errata(&["E41"])
        .code(&["constraint::coincidence"])
        .lesson(&[2])
        .remark(
            "Each block must hold the arm of its own body. (34) has it right up to an \
         overall sign.",
        ),
    Entry::new(
        "(34)",
        Convention,
        "The two blocks of the ball joint written out as 3 × 6 matrices.",
    )
    .errata(&["E35", "E41"])
    .code(&["constraint::coincidence", "test constraint::dual::every_joint_matches_dual_numbers"])
    .lesson(&[2])
    .remark(
        "They are −∂c/∂s of (31). That is a convention, and decides the sign of the \
         feedback: E35.",
    ),
    Entry::new("(35)", Right, "A nail: the same for one body and a fixed point.")
        .code(&["constraint::coincidence", "constraint::joint", "scene three_points"])
        .lesson(&[2]),
    Entry::new("(36)", Right, "Two points stay at the distance l.")
        .code(&["constraint::distance"])
        .lesson(&[2]),
    Entry::new("(37)", Right, "The same as a constraint function.")
        .code(&["constraint::distance", "scene pendulum"])
        .lesson(&[2]),
    Entry::new("(38)", Right, "Its rate as J times the stacked velocities.")
        .code(&["constraint::distance"])
        .lesson(&[2]),
    Entry::new("(39)", Right, "Its Jacobian (−n, n) with the unit vector n from point to point.")
        .code(&["constraint::distance", "constraint::arms"])
        .lesson(&[2])
        .remark("Here J = +∂c/∂s, unlike (34)."),
    Entry::new("(40)", Misprint, "A row of three entries as an example.")
        .errata(&["E42"])
        .code(&["constraint::Row"])
        .lesson(&[2])
        .remark("Two points have six velocity components."),
    Entry::new("(41)", Right, "The unit vector between the points.")
        .code(&["constraint::distance", "constraint::Degenerate", "test degenerate"])
        .lesson(&[2])
        .remark("Undefined where they coincide: an error that names the constraint, no NaN."),
    Entry::new("(42)", Right, "A contact: the gap along the normal is at least 0.")
        .code(&["constraint::contact", "constraint::Contact::gap"])
        .lesson(&[2]),
    Entry::new("(43)", Misleading, "The rate of the gap, with a normal that turns.")
        .errata(&["E43"])
        .code(&[
            "constraint::contact",
            "constraint::contact::Normal",
            "test constraint::dual::contacts_of_every_kind_match_dual_numbers",
        ])
        .lesson(&[2])
        .remark(
            "The angular velocity is that of the body which carries the normal; its term is \
         dropped without a word in (44).",
        ),
    Entry::new(
        "(44)",
        Misleading,
        "The contact's blocks: the normal, and its moment about each body.",
    )
    .errata(&["E30", "E44"])
    .code(&["constraint::contact", "constraint::arms"])
    .lesson(&[2, 3])
    .remark("Of the opposite sign to (43). For an equation no matter, for λ ≥ 0 everything."),
    Entry::new("(45)", Wrong, "The same as two 3 × 6 matrices that are to give 0.")
        .errata(&["E45"])
        .code(&["constraint::contact", "constraint::Row::inequality"])
        .lesson(&[2])
        .remark("A contact has one row of six entries a body, and an inequality."),
];
