//! A user-defined solver in lcplab's comparison: projected Jacobi in eleven lines.
//!
//! Run it with `cargo run --release --example own_solver`.

use lcplab::lcp::{Lcp, merit};
use lcplab::report::{study::comparison::compare, terminal, view};
use lcplab::scene::{Scene, Scheme};
use lcplab::solver::{Entry, Observer, Registry, Solution, Solver, Start, Status};

struct Jacobi;

impl Solver for Jacobi {
    fn name(&self) -> &str {
        "jacobi"
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, _: &mut dyn Observer) -> Solution {
        let mut x = start.point(lcp);
        for sweep in 1..=10_000 {
            let w = lcp.w(&x);
            let step = |i: usize| x[i] - 0.5 * w[i] / lcp.matrix().diagonal(i);
            x = (0..lcp.len()).map(|i| lcp.project(i, step(i), &x)).collect();
            if merit::scaled_residual(lcp, &x) <= 1e-8 {
                return Solution::new(lcp, x, Status::Solved, sweep);
            }
        }
        Solution::new(lcp, x, Status::IterationLimit, 10_000)
    }
}

fn main() -> lcplab::error::Result<()> {
    let known = Registry::standard();
    let mine = Entry::new("jacobi", |_| Box::new(Jacobi));
    let solvers = [mine, known.entry("pgs")?.clone(), known.entry("dantzig")?.clone()];
    let (comparison, _) = compare(&Scene::load("fig7")?, &Scheme::LEVELS, &solvers, 3, &|| ());
    print!("{}", terminal::table(&view::comparison_table(&comparison)));
    Ok(())
}
