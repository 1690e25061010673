//! A verification and teaching toolkit for rigid-body contact solvers.
//!
//! A time step of bodies with contacts and joints leads to a boxed linear complementarity problem:
//!
//! ```text
//! w = A x + b,   lo ≤ x ≤ hi,   w_i > 0 ⇒ x_i = lo_i,   w_i < 0 ⇒ x_i = hi_i
//! ```
//!
//! with A = J M⁻¹ Jᵀ. lcplab builds such problems from scenes in several formulations, solves them
//! by several methods, and checks every answer with code that knows the problem and the answer but
//! not the solver. It follows Kenwright & Morgan, *Practical Introduction to Rigid Body Linear
//! Complementary Problem (LCP) Constraint Solvers*, cited as K&M; numbers such as E06 in the code
//! refer to errata of that chapter.
//!
//! ```
//! use lcplab::judge::{Demand, judge};
//! use lcplab::scene::Scene;
//! use lcplab::simulation::Simulation;
//! use lcplab::solver::Dantzig;
//!
//! // Three balls in a stack; the middle one is hit (the chapter's Figure 7).
//! let scene = Scene::load("fig7")?;
//! let mut simulation = Simulation::new(scene, Box::new(Dantzig::default()));
//! let step = simulation.step().expect("a step that does not diverge");
//! let solve = &step.solves[0];
//! assert_eq!(solve.solution.x, [4.0, 3.0, 1.0]); // impulses in N s, from the ground up
//! let certificate = judge(&solve.problem.lcp, &solve.solution.x, &Demand::default());
//! assert_eq!(certificate.verdict.to_string(), "proved: x is an exact solution");
//! # Ok::<(), lcplab::error::Error>(())
//! ```
//!
//! The modules follow the flow of data. Physics: [`body`], [`constraint`], [`scene`], [`assembly`].
//! Numbers: [`lcp`], [`storage`], [`solver`], [`mod@reference`], [`mod@judge`]. [`formulation`]
//! connects the two. [`plugin`] runs solvers written in other languages, [`hunt`] tests solvers for
//! false claims, [`precision`] finds what single precision loses, [`simulation`] takes many steps,
//! [`trace`], [`plot`] and [`report`] show the results, [`explain`] derives a step line by line,
//! [`diagnosis`] explains why a step cannot be taken, [`chapter`] shows what K&M print next to the
//! correct statements, [`lesson`] contains the lessons.

pub use lcplab_analysis::{card, diagnosis, explain, gradient, hunt, precision};
pub use lcplab_files as files;
pub use lcplab_judge as judge;
pub use lcplab_judge::reference;
pub use lcplab_lcp as lcp;
pub use lcplab_lcp::{error, json, memory};
pub use lcplab_mechanics::{assembly, body, constraint, formulation, scene, simulation};
pub use lcplab_page::{csv, document, number, page, plot};
pub use lcplab_plugin as plugin;
pub use lcplab_proof as proof;
pub use lcplab_solver as solver;
pub use lcplab_solver::{textbook, trace};

// The command line and the cells of lessons use this name.
extern crate self as lcplab;

// The hidden modules, here and within the others, are parts of the program. They are no promise.

pub mod animation;
pub mod chapter;
#[doc(hidden)]
pub mod cli;
#[doc(hidden)]
pub mod frames;
pub mod lesson;
#[doc(hidden)]
pub mod live;
#[doc(hidden)]
pub mod problem_set;
pub mod report;
pub mod storage;

/// The lessons' cells, compiled; they are written to be read one by one.
#[allow(non_snake_case, clippy::type_complexity, clippy::useless_vec)]
mod lessons {
    include!(concat!(env!("OUT_DIR"), "/lessons.rs"));
}

/// The pages around the lessons: the first page, the teacher's guide, an introduction to Rust.
#[allow(unused_macros, unused_variables, clippy::useless_vec)]
mod around {
    include!(concat!(env!("OUT_DIR"), "/around.rs"));
}

/// The handout's cells, compiled.
#[allow(non_snake_case, clippy::type_complexity, clippy::useless_vec)]
mod handout {
    include!(concat!(env!("OUT_DIR"), "/handout.rs"));
}

/// File access: files are read completely up to a maximum size, and written completely or not at
/// all.
pub mod file {
    pub use lcplab_files::disk::*;
    pub use lcplab_lcp::disk::*;
}

/// Runs the examples of the README as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;

/// The same for the page about the crates.
#[cfg(doctest)]
#[doc = include_str!("../docs/rust.md")]
struct Crates;
