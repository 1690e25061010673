//! Claims and techniques from T35 to T65: the program, its failures, its matrices.

use super::Entry;
use super::Verdict::{Confirmed, Misleading, Opinion, Right, Wrong};

pub(super) const ENTRIES: &[Entry] = &[
    Entry::new("T35", Right, "The algorithm in seven steps.")
        .code(&["simulation::Simulation::step", "assembly", "formulation", "explain::step"])
        .lesson(&[3])
        .remark("Our stages have the same order, and lcplab explain shows them one by one."),
    Entry::new("T36", Opinion, "Keep linear and angular parts apart while debugging.")
        .code(&["body::linear", "body::angular", "body::Mass"])
        .lesson(&[3])
        .remark("See N5."),
    Entry::new("T37", Right, "Solve for forces only; apply them elsewhere.")
        .errata(&["E32"])
        .code(&["solver::Solver", "formulation::Problem::next_states"])
        .lesson(&[3])
        .remark(
            "No solver knows a body here, and no integrator a solver. Code 7 does both in \
         one function.",
        ),
    Entry::new("T38", Right, "Check small examples in one dimension by hand first.")
        .errata(&["E48"])
        .code(&["scene fig6", "scene fig7", "lcplab explain", "test worked_examples"])
        .lesson(&[1, 3]),
    Entry::new("T39", Right, "Common mistakes are a wrong sign and a division by zero.")
        .errata(&["E30"])
        .code(&[
            "constraint::verify",
            "diagnosis::Cause",
            "test diagnosis::signs_and_blocks_gone_wrong_are_seen_in_a",
        ])
        .lesson(&[2, 3])
        .remark("The chapter itself mixes three sign systems; the exhibit has all 16 mixtures."),
    Entry::new("T40", Right, "Constraints as classes that can be plugged in.")
        .code(&["constraint::Constraint", "constraint::ALL", "example own_constraint"])
        .lesson(&[2]),
    Entry::new("T41", Right, "Normalize the quaternion in each step.")
        .code(&[
            "body::State::advanced",
            "test chapter::claims::a_quaternion_that_is_not_normalized_grows",
        ])
        .lesson(&[3])
        .remark("Without it the norm grows by √(1 + (ω dt/2)²) a step."),
    Entry::new(
        "T42",
        Right,
        "Why solvers fail: too many constraints, drift, division by zero, impossible \
         ones, equal positions, faults in the code.",
    )
    .code(&["diagnosis::Cause", "lcplab diagnose", "test diagnosis", "constraint::verify::Mistake"])
    .lesson(&[6])
    .remark("Each has a message of its own, and a test an input for each."),
    Entry::new("T43", Misleading, "An iterative solver finds a best fit for bad constraints.")
        .errata(&["E61"])
        .code(&["scene fig8", "test simulation::demonstrations"])
        .lesson(&[6])
        .remark("The forces grow without limit, and the order of the rows decides the motion."),
    Entry::new("T44", Confirmed, "With a fixed number of sweeps rods stretch.")
        .code(&[
            "scene chain",
            "test chapter::claims::rods_stretch_when_sweeps_are_few",
            "report::study::drift",
        ])
        .lesson(&[4, 7]),
    Entry::new("T45", Confirmed, "Contacts must persist, and be kept while the motion is small.")
        .code(&[
            "scene::contacts::ContactId",
            "scene::settings::Persistence",
            "scene persistence",
            "test scene::contacts::persistence",
        ])
        .lesson(&[11]),
    Entry::new("T46", Right, "A manifold is built over several frames from single points.")
        .code(&[
            "scene::contacts::reduce",
            "scene::settings::Manifold",
            "test scene::contacts::manifold",
        ])
        .lesson(&[11])
        .remark(
            "Ours finds all points at once and keeps four that span most of the area; their \
         names persist.",
        ),
    Entry::new("T47", Confirmed, "Dense matrices do not suit large scenes.")
        .code(&[
            "storage::Dense",
            "storage::CompressedRows",
            "report::study::storage",
            "lcp::matrix::Matrix",
        ])
        .lesson(&[10])
        .remark(
            "The A of our tower of 700 cubes takes 4.7 GB dense and 36 MB in compressed rows: half a \
         percent of it is filled.",
        ),
    Entry::new("T48", Opinion, "Overloaded operators with assertions make programs readable.")
        .errata(&["E49"])
        .code(&["lcp::matrix::Matrix", "storage::product"])
        .lesson(&[10])
        .remark("nalgebra and faer have them; what cannot be multiplied does not pass."),
    Entry::new("T49", Right, "Change the matrix behind the same face.")
        .code(&[
            "storage::Storage",
            "storage::ALL",
            "test solver::every::dense_and_sparse_storage_give_the_same_answer",
        ])
        .lesson(&[10]),
    Entry::new("T50", Opinion, "Get it to work with dense matrices first.")
        .code(&[
            "lcp::matrix::Matrix::dense",
            "test lcp::matrix::dense_and_sparse_storage_agree_on_every_operation",
        ])
        .lesson(&[10])
        .remark("The dense way stays as a reference for the others."),
    Entry::new("T51", Confirmed, "Iterations can leave out zeros.")
        .code(&[
            "lcp::matrix::Row",
            "storage::Factored",
            "storage::sweep",
            "report::study::storage",
            "simulation::sweep",
        ])
        .lesson(&[10])
        .remark(
            "A sweep then costs what is stored, not n²: for a stack of 80 boxes, with 3 % of A filled, about a \
         tenth of the time of a dense one.",
        ),
    Entry::new("T52", Right, "A manager keeps matrices of common sizes.")
        .code(&["storage::Pool"])
        .lesson(&[10])
        .remark("Once warm, a step allocates nothing, if the storage lies in a few arrays; a map of maps asks for its \
         nodes anew in every step."),
    Entry::new("T53", Right, "Allocate more than needed, to avoid resizing.")
        .code(&["storage::product::Workspace", "storage::Pool"])
        .lesson(&[10]),
    Entry::new("T54", Right, "Assignment copies whole blocks; of sparse matrices less.")
        .code(&["storage::Storage"])
        .lesson(&[10])
        .remark("Bytes of each storage are counted."),
    Entry::new("T55", Right, "The dense class as a test bed.")
        .code(&["storage::Dense"])
        .lesson(&[10])
        .remark("See T49."),
    Entry::new("T56", Misleading, "A map of the standard library as a sparse matrix.")
        .errata(&["E52", "E53", "E54", "E55", "E56"])
        .code(&["storage::MapOfMaps"])
        .lesson(&[10])
        .remark("It is a dictionary of keys, no compressed rows; and MATLAB stores columns."),
    Entry::new("T57", Wrong, "A linked list saves memory: 28 to 1, and slower with every element.")
        .errata(&["E57"])
        .code(&["storage::LinkedList"])
        .lesson(&[10])
        .remark(
            "7 to 1 against full; the cost grows linearly, and the break-even is at a \
         seventh.",
        ),
    Entry::new("T58", Misleading, "A binary tree makes the search far shorter.")
        .errata(&["E58"])
        .code(&["storage::Tree", "storage::BalancedTree"])
        .lesson(&[10])
        .remark("If it is balanced: filled in the order of the indices it is a list."),
    Entry::new("T59", Confirmed, "Hashing finds an element in one step.")
        .code(&["storage::HashTable", "report::study::storage"])
        .lesson(&[10])
        .remark(
            "The time of a search does not grow from a hundred entries to ten thousand, while that in a \
         balanced tree doubles. But rows have no place of their own: a sweep has to search.",
        ),
    Entry::new("T60", Confirmed, "Access near what was last used is faster.")
        .code(&["storage::CompressedRows", "storage::sweep", "report::study::storage"])
        .lesson(&[10])
        .remark(
            "In compressed rows, and in the map of maps, an entry costs several times less when its row is run \
         through than when it is looked up.",
        ),
    Entry::new("T61", Opinion, "A memory pool against fragmentation.")
        .code(&["storage::Pool"])
        .lesson(&[10])
        .remark("See T52."),
    Entry::new("T62", Opinion, "Graphics processors and several platforms.")
        .code(&[
            "solver::sweep::order",
            "solver::sweep::Jacobi",
            "test solver::order::rows_of_a_colour_do_not_touch",
        ])
        .lesson(&[4])
        .remark(
            "The coloured order and Jacobi are the parallel forms; no such processor is \
         used here.",
        ),
    Entry::new("T63", Right, "Assert, test for NaN, and stop where it went wrong.")
        .code(&[
            "error::Error",
            "error::Defects",
            "solver::Status",
            "simulation::record::Failure",
            "test lcp::problem",
        ])
        .lesson(&[6])
        .remark("Errors are values that name field or row and reason."),
    Entry::new("T64", Opinion, "Iterative solvers should always be used in real time.")
        .errata(&["E08"])
        .code(&["report::study::comparison", "bench pivoting", "lcplab compare"])
        .lesson(&[5])
        .remark("Our figures speak against always."),
    Entry::new("T65", Misleading, "An assertion on the size of matrices warns early.")
        .errata(&["E50"])
        .code(&["scene::settings", "error::Error", "scene tower"])
        .lesson(&[10])
        .remark("Of a fault or of a large scene; a limit must be an option."),
];
