//! A verification and teaching toolkit for rigid-body contact solvers.
//!
//! A time step of touching, jointed bodies ends in a boxed linear complementarity problem:
//!
//! ```text
//! w = A x + b,   lo ≤ x ≤ hi,   w_i > 0 ⇒ x_i = lo_i,   w_i < 0 ⇒ x_i = hi_i
//! ```
//!
//! with A = J M⁻¹ Jᵀ. lcplab makes such problems from scenes in several formulations, solves them by
//! several methods, and has every answer judged by code that knows the problem and the answer but
//! not the solver. It follows Kenwright & Morgan, *Practical Introduction to Rigid Body Linear
//! Complementary Problem (LCP) Constraint Solvers*, cited as K&M; where that chapter errs, its
//! erratum's number stands beside the code (E06).
//!
//! ```
//! use lcplab::certificate::{Demand, judge};
//! use lcplab::scene::Scene;
//! use lcplab::simulation::Simulation;
//! use lcplab::solver::{Options, by_name};
//!
//! // Three balls in a stack; the middle one is hit (the chapter's Figure 7).
//! let scene = Scene::load("fig7")?;
//! let mut simulation = Simulation::new(scene, by_name("dantzig", &Options::default())?);
//! let step = simulation.step().expect("a step that does not diverge");
//! let solve = &step.solves[0];
//! assert_eq!(solve.solution.x, [4.0, 3.0, 1.0]); // impulses in N s, from the ground up
//! let certificate = judge(&solve.problem.lcp, &solve.solution.x, &Demand::default());
//! assert_eq!(certificate.verdict.to_string(), "proved: an exact solution lies within 0.0e0 of x");
//! # Ok::<(), lcplab::error::Error>(())
//! ```
//!
//! The modules follow the flow of data. Physics: [`body`], [`constraint`], [`scene`], [`assembly`].
//! Numbers: [`lcp`], [`storage`], [`solver`], [`mod@reference`], [`certificate`]. Physics and numbers meet in
//! [`formulation`]; [`trial`] asks whether the solvers are honest, [`simulation`] takes many steps, [`trace`], [`plot`] and [`report`] show them,
//! [`explain`] derives a step line by line, [`diagnosis`] says why one cannot be taken, [`chapter`] shows
//! what K&M print beside what holds, and [`lesson`] teaches it.

pub mod error;

pub mod memory;

pub mod file;

pub mod json;

pub mod body;

pub mod constraint;

pub mod scene;

pub mod assembly;

pub mod lcp;

pub mod storage;

pub mod solver;

pub mod reference;

pub mod certificate;

pub mod formulation;

pub mod simulation;

pub mod trace;

pub mod trial;

pub mod plot;

pub mod report;

pub mod document;

pub mod explain;

pub mod diagnosis;

pub mod chapter;

pub mod lesson;

/// The examples of the README run as tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
