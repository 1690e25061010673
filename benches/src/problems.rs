//! The problems of the benchmarks.

use lcplab::error::{Error, Result};
use lcplab::formulation::Problem;
use lcplab::lcp::{Lcp, Matrix, library};
use lcplab::scene::Scene;
use lcplab::simulation::Simulation;
use lcplab::solver::{Options, Registry, Settings};

/// The bounds of a random problem with a definite A.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Bounds {
    /// 0 ≤ x.
    OneSided,
    /// 0 ≤ x ≤ hi, hi finite.
    TwoSided,
}

impl Bounds {
    /// The name of the problem with n rows.
    pub fn problem(self, n: usize) -> String {
        match self {
            Bounds::OneSided => format!("one-sided, n = {n}"),
            Bounds::TwoSided => format!("two-sided, n = {n}"),
        }
    }

    /// The problem with n rows and about this condition of A; n is the seed too. The solution is
    /// chosen first: half of the rows are active with one-sided bounds, two thirds with two-sided.
    ///
    /// # Errors
    /// If a number is not in its range.
    pub fn lcp(self, n: usize, condition: f64) -> Result<Lcp> {
        let shares = match self {
            Bounds::OneSided => [("active", 0.5), ("boxed", 0.0)],
            Bounds::TwoSided => [("active", 2.0 / 3.0), ("boxed", 1.0)],
        };
        let size = [("n", n as f64), ("condition", condition), ("seed", n as f64)];
        let given: Vec<_> = size.into_iter().chain(shares).collect();
        Ok(library::by_name("manufactured")?.generate(&given)?.lcp)
    }
}

/// A stack of cubes with a contact at each corner, whose A is singular; friction bounds are frozen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stack {
    /// The number of cubes.
    pub boxes: usize,
    /// The coefficient of friction; 0 for normal rows alone.
    pub friction: f64,
    /// The part of the mean diagonal that is added to the diagonal of A; 0 leaves A singular.
    pub compliance: f64,
}

impl Stack {
    /// Its name, with the number of cubes.
    pub fn name(&self) -> String {
        let kind = if self.friction > 0.0 { "friction" } else { "stack" };
        let name = format!("{kind} {}", self.boxes);
        if self.compliance > 0.0 { format!("{name}, regularized") } else { name }
    }

    /// Its problem.
    ///
    /// # Errors
    /// If a number is not in its range.
    pub fn lcp(&self) -> Result<Lcp> {
        let given = [("boxes", self.boxes as f64), ("mu", self.friction)];
        let lcp = library::by_name("box-stack")?.generate(&given)?.lcp;
        if self.compliance > 0.0 { softened(&lcp, self.compliance) } else { Ok(lcp) }
    }
}

/// A pile of bodies of several masses with contacts between random pairs: a kind of problem for
/// which no solver was tuned. A is sparse, without order, and regularized like a [`Stack`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pile {
    /// The number of contacts; there are half as many bodies.
    pub contacts: usize,
    /// The part of the mean diagonal that is added to the diagonal of A.
    pub compliance: f64,
}

impl Pile {
    /// Its name, with the number of contacts.
    pub fn name(&self) -> String {
        format!("random pile {}", self.contacts)
    }

    /// Its problem.
    ///
    /// # Errors
    /// If a number is not in its range.
    pub fn lcp(&self) -> Result<Lcp> {
        let bodies = (self.contacts / 2) as f64;
        let given = [("bodies", bodies), ("contacts", self.contacts as f64)];
        softened(&library::by_name("contact-graph")?.generate(&given)?.lcp, self.compliance)
    }
}

/// A with this part of its mean diagonal added to the diagonal.
fn softened(lcp: &Lcp, part: f64) -> Result<Lcp> {
    let n = lcp.len();
    let gamma = part * (0..n).map(|i| lcp.matrix().diagonal(i)).sum::<f64>() / n as f64;
    let entries = (0..n).flat_map(|i| lcp.matrix().row(i).iter().map(move |(j, a)| (i, j, a)));
    let added = (0..n).map(|i| (i, i, gamma));
    let matrix = Matrix::sparse(n, &entries.chain(added).collect::<Vec<_>>());
    Lcp::new(matrix, lcp.b().to_vec(), lcp.lo().to_vec(), lcp.hi().to_vec())
}

/// Sweeps for each step before the one that is solved: direct methods take too long on a tower.
const SWEEPS: usize = 20;

/// The first problem of a scene's step, counted from 1, after steps by a few sweeps each.
///
/// # Errors
/// If the scene cannot be loaded or stepped, or the step solves no problem.
pub fn posed(scene: &str, step: usize) -> Result<Problem> {
    let settings = Settings::default().with_max_iterations(SWEEPS);
    let pgs = Registry::standard().entry("pgs")?.build(&Options::default().with_settings(settings));
    let mut simulation = Simulation::new(Scene::load(scene)?, pgs);
    let refused = |reason: String| Error::invalid(scene, format!("step {step}"), reason);
    let mut last = None;
    for _ in 0..step {
        last = Some(simulation.step().map_err(|failure| refused(failure.to_string()))?);
    }
    let solve = last.and_then(|step| step.solves.into_iter().next());
    Ok(solve.ok_or_else(|| refused("it solves no problem".into()))?.problem)
}
