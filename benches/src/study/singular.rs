//! Redundant contacts: what an exact answer costs where A is singular. Stacks of cubes with a contact at
//! each corner, with and without friction (its bounds frozen), as they are and with a little of
//! the mean diagonal added to A, beside clarabel's interior point.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::yardstick::{Finding, Terms, Times, measure};
use lcplab::error::Result;
use lcplab::lcp::{Lcp, Matrix, library};
use lcplab::report::study::Study;

/// Which stacks and which solvers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Plan {
    /// Stacks of so many cubes.
    pub boxes: Vec<usize>,
    /// Coefficients of friction.
    pub friction: Vec<f64>,
    /// Parts of the mean diagonal that are added to the diagonal: 0 leaves A singular.
    pub compliance: Vec<f64>,
    /// The solvers.
    pub solvers: Vec<String>,
    /// The scaled residual asked for.
    pub tolerance: f64,
    /// Seconds to spend on a problem.
    pub seconds: f64,
    /// What is asked of the times: at most so many times clarabel's.
    pub goal: f64,
}

impl Default for Plan {
    fn default() -> Self {
        Plan {
            boxes: vec![5, 10, 20, 50],
            friction: vec![0.0, 0.5],
            compliance: vec![0.0, 1e-8],
            solvers: ["interior-point", "dantzig", "lemke"].map(String::from).to_vec(),
            tolerance: 1e-9,
            seconds: 0.5,
            goal: 2.0,
        }
    }
}

/// A stack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stack {
    /// How many cubes.
    pub boxes: usize,
    /// The coefficient of friction; 0 for normal rows alone.
    pub friction: f64,
    /// The part of the mean diagonal that is added to A.
    pub compliance: f64,
}

impl Plan {
    fn stacks(&self) -> Vec<Stack> {
        let mut stacks = Vec::new();
        for &compliance in &self.compliance {
            for &friction in &self.friction {
                let stack = |&boxes: &usize| Stack { boxes, friction, compliance };
                stacks.extend(self.boxes.iter().map(stack));
            }
        }
        stacks
    }
}

impl Study for Plan {
    const NAME: &'static str = "singular";
    type Finding = Finding;
    type Times = Times;

    fn alone(&self) -> bool {
        true
    }

    fn tasks(&self) -> Vec<String> {
        self.stacks().iter().map(Stack::name).collect()
    }

    fn run(&self, task: usize) -> Result<(Finding, Times)> {
        let stack = self.stacks().swap_remove(task);
        let Plan { solvers, tolerance, seconds, .. } = self;
        let terms = Terms { solvers, tolerance: *tolerance, seconds: *seconds };
        measure(stack.name(), &stack.lcp()?, &terms)
    }
}

impl Stack {
    /// In a word and its number of cubes.
    pub fn name(&self) -> String {
        let kind = if self.friction > 0.0 { "friction" } else { "stack" };
        let name = format!("{kind} {}", self.boxes);
        if self.compliance > 0.0 { format!("{name}, regularised") } else { name }
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

/// A with this part of its mean diagonal added to the diagonal.
fn softened(lcp: &Lcp, part: f64) -> Result<Lcp> {
    let n = lcp.len();
    let gamma = part * (0..n).map(|i| lcp.matrix().diagonal(i)).sum::<f64>() / n as f64;
    let entries = (0..n).flat_map(|i| lcp.matrix().row(i).iter().map(move |(j, a)| (i, j, a)));
    let added = (0..n).map(|i| (i, i, gamma));
    let matrix = Matrix::sparse(n, &entries.chain(added).collect::<Vec<_>>());
    Lcp::new(matrix, lcp.b().to_vec(), lcp.lo().to_vec(), lcp.hi().to_vec())
}
