//! The numerical problems, and their contenders.

use lcplab::error::Result;
use lcplab::lcp::Lcp;
use lcplab::scene::Scene;
use lcplab::simulation::Simulation;
use lcplab::solver::{self, Options};
use lcplab_benches::problems::{Bounds, Pile, Stack};
use lcplab_benches::recording::Problem;

use crate::contender::Contender;
use crate::raw::Raw;
use crate::trial::trial;
use crate::{clarabel, dart, ours};

/// Rows of the random problems with a definite A.
const ONE_SIDED: [usize; 4] = [50, 200, 500, 1000];
const TWO_SIDED: [usize; 2] = [200, 500];
/// The condition of A.
const CONDITION: f64 = 400.0;
/// Cubes of the stacks, whose A is singular unless it is regularized by a fraction of its mean
/// diagonal.
const BOXES: [usize; 4] = [5, 10, 20, 50];
const FRICTION: [f64; 2] = [0.0, 0.5];
const COMPLIANCE: [f64; 2] = [0.0, 1e-8];
/// Contacts of the random piles, all regularized.
const CONTACTS: [usize; 4] = [20, 40, 80, 200];
/// The step of the net that is solved: its masses move by then.
const STEP: usize = 10;

/// All trials, one after the other.
pub fn run() -> Result<Vec<Problem>> {
    let mut problems = Vec::new();
    for (name, lcp) in posed()? {
        eprintln!("{name}");
        problems.push(trial(&name, &lcp, contenders(&lcp, &Raw::of(&lcp))?));
    }
    Ok(problems)
}

fn contenders<'a>(lcp: &'a Lcp, raw: &'a Raw) -> Result<Vec<Contender<'a>>> {
    let mut all = ours::solvers(lcp)?;
    all.extend(clarabel::solvers(lcp));
    #[cfg(has_ode)]
    all.extend(crate::ode::solvers(raw));
    all.extend(dart::solvers(raw));
    #[cfg(has_bullet)]
    all.extend(crate::bullet::solvers(raw));
    #[cfg(has_siconos)]
    all.extend(crate::siconos::solvers(raw));
    Ok(all)
}

fn posed() -> Result<Vec<(String, Lcp)>> {
    let mut all = Vec::new();
    let one_sided = ONE_SIDED.map(|n| (Bounds::OneSided, n));
    let two_sided = TWO_SIDED.map(|n| (Bounds::TwoSided, n));
    for (bounds, n) in one_sided.into_iter().chain(two_sided) {
        all.push((bounds.problem(n), bounds.lcp(n, CONDITION)?));
    }
    for compliance in COMPLIANCE {
        for friction in FRICTION {
            for boxes in BOXES {
                let stack = Stack { boxes, friction, compliance };
                all.push((stack.name(), stack.lcp()?));
            }
        }
    }
    for contacts in CONTACTS {
        let pile = Pile { contacts, compliance: COMPLIANCE[1] };
        all.push((pile.name(), pile.lcp()?));
    }
    all.push(("net".into(), net()?));
    Ok(all)
}

/// The rods of 20 by 20 masses: equations alone.
fn net() -> Result<Lcp> {
    let solver = solver::Registry::standard().entry("dantzig")?.build(&Options::default());
    let mut simulation = Simulation::new(Scene::load("net")?, solver);
    let mut lcp = None;
    for _ in 0..STEP {
        lcp = simulation.step().ok().and_then(|mut step| Some(step.solves.pop()?.problem.lcp));
    }
    Ok(lcp.expect("a net that can be stepped"))
}
