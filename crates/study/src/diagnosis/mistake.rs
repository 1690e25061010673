//! Which known mistake gives exactly this x?
//!
//! Solvers that answer wrongly mostly do so in one of a few ways. Each of these is done here to the same problem, and what
//! comes of it is compared with the x in question. To agree in sixteen digits, or in seven where numbers are single, is no
//! accident.
//!
//! ```
//! use lcplab_problem::{Lcp, Matrix};
//! use lcplab_study::diagnosis::mistakes;
//!
//! // Three balls on each other; after two sweeps x = (2, 1.5, 0.25).
//! let a = Matrix::dense(3, &[1.0, -1.0, 0.0, -1.0, 2.0, -1.0, 0.0, -1.0, 2.0]);
//! let lcp = Lcp::new(a, vec![-1.0, -1.0, 1.0], vec![0.0; 3], vec![f64::INFINITY; 3])?;
//! let found = mistakes(&lcp, &[2.0, 1.5, 0.25]);
//! assert_eq!(found[0].what, "projected Gauss-Seidel, stopped after 2 sweeps");
//! assert_eq!(found[0].distance, 0.0);
//! # Ok::<(), lcplab_problem::error::Error>(())
//! ```

use std::ops::ControlFlow;

use lcplab_problem::number::readable;
use lcplab_problem::{Lcp, Matrix, merit};
use lcplab_solver::{
    Code6, Damping, Iterate, Jacobi, Observer, Options, Order, Pgs, Settings, Solver, Start,
    Status, by_name, default_for,
};

/// So many sweeps are compared, if that takes no more multiplications than this.
const SWEEPS: usize = 2000;
const MULTIPLICATIONS: usize = 200_000_000;
/// Of a changed problem so many.
const SWEEPS_OF_CHANGED: usize = 100;
/// With more rows nothing is tried.
const LARGEST: usize = 500;
/// With more rows no bound is taken away row by row.
const LARGEST_BY_ROWS: usize = 60;
/// Farther from x, relative to its largest entry, is another answer, even in single precision.
const NEAR: f64 = 1e-6;
/// Numbers that should be one agree to this part.
const SAME: f64 = 1e-9;

/// A mistake whose answer is this x.
#[derive(Debug, Clone, PartialEq)]
pub struct Mistake {
    /// What was done.
    pub what: String,
    /// max |x − y| / max |x| for the y that it gives.
    pub distance: f64,
}

/// The mistakes that give this x, the nearest first; at equal distance the simplest. Nothing is looked for if x is within
/// the usual tolerance of a solution, or in problems of more than 500 rows.
///
/// # Panics
/// If x has not an entry a row.
pub fn mistakes(lcp: &Lcp, x: &[f64]) -> Vec<Mistake> {
    mistakes_after(lcp, x, None)
}

/// The same where the answer of the frame before is known: from it sweeps start, or should have started, and friction may
/// still be limited by its normal forces.
///
/// # Panics
/// If x or the last answer has not an entry a row.
pub fn mistakes_after(lcp: &Lcp, x: &[f64], last: Option<&[f64]>) -> Vec<Mistake> {
    assert_eq!(x.len(), lcp.len(), "an entry a row");
    assert!(last.is_none_or(|last| last.len() == lcp.len()), "an entry a row");
    let largest = x.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let is_right = merit::scaled_residual(lcp, x) <= Settings::default().tolerance;
    if is_right || lcp.len() > LARGEST || !largest.is_finite() || x.iter().any(|x| x.is_nan()) {
        return Vec::new();
    }
    if largest == 0.0 {
        return vec![Mistake { what: "the start, x = 0: nothing was done".into(), distance: 0.0 }];
    }
    let case = Case { lcp, x, largest };
    let most = SWEEPS.min(MULTIPLICATIONS / (1 + lcp.matrix().stored()));
    let mut found: Vec<Mistake> = Vec::new();
    if let Some(last) = last {
        found.extend(case.since(last, most));
    }
    let cold = if last.is_some() { " from 0 (a missing warm start)" } else { "" };
    for (name, solver) in kinds(most) {
        found.extend(case.stopped(&format!("{name}{cold}"), &*solver, lcp, &Start::default()));
    }
    found.extend(case.single_precision(most));
    // A change that changes nothing is none.
    let nearest = found.iter().map(|mistake| mistake.distance).fold(f64::INFINITY, f64::min);
    for (what, changed) in changed(lcp) {
        found.extend(case.answer(&what, &changed));
        let name = format!("{what}, projected Gauss-Seidel");
        let pgs = &kinds(most.min(SWEEPS_OF_CHANGED))[0].1;
        let stopped = case.stopped(&name, &**pgs, &changed, &Start::default());
        found.extend(stopped.filter(|mistake| mistake.distance < nearest));
    }
    found.extend(case.compliance());
    found.extend(case.factor());
    found.retain(|mistake| mistake.distance <= NEAR);
    found.sort_by(|a, b| a.distance.total_cmp(&b.distance)); // stable: the simplest first
    found
}

/// How near single precision can come: the scaled residuals of x and of the solution rounded to it, if a solver finds one.
pub fn single_precision(lcp: &Lcp, x: &[f64]) -> Option<[f64; 2]> {
    let rounded: Vec<f64> = solution(lcp)?.iter().map(|&x| f64::from(x as f32)).collect();
    Some([merit::scaled_residual(lcp, x), merit::scaled_residual(lcp, &rounded)])
}

struct Case<'a> {
    lcp: &'a Lcp,
    x: &'a [f64],
    largest: f64,
}

/// The iterate that came nearest.
struct Nearest<'a> {
    case: &'a Case<'a>,
    best: (usize, f64),
}

impl Observer for Nearest<'_> {
    fn observe(&mut self, iterate: &Iterate<'_>) -> ControlFlow<()> {
        let distance = self.case.distance(iterate.x);
        if distance < self.best.1 {
            self.best = (iterate.iteration, distance);
        }
        ControlFlow::Continue(())
    }
}

impl Case<'_> {
    fn distance(&self, y: &[f64]) -> f64 {
        let apart = |(x, y): (&f64, &f64)| (x - y).abs();
        // f64::max would pass over what is not a number.
        let most = |most: f64, apart: f64| if apart <= most { most } else { apart };
        let most = self.x.iter().zip(y).map(apart).fold(0.0, most);
        if most.is_finite() { most / self.largest } else { f64::INFINITY }
    }

    /// What comes of the last answer: itself, sweeps that start from it, and friction that its normal forces limit.
    fn since(&self, last: &[f64], most: usize) -> Vec<Mistake> {
        let (what, distance) = ("the last answer: nothing was done", self.distance(last));
        let mut found = vec![Mistake { what: what.into(), distance }];
        let start = Start::at(last);
        if self.lcp.has_coupled_rows() {
            let what = "friction limited by the last normal forces";
            let frozen = self.lcp.frozen_at(last);
            found.extend(self.answer(what, &frozen));
            let pgs = &kinds(most.min(SWEEPS_OF_CHANGED))[0].1;
            for (start, from) in [(&start, "from the last answer"), (&Start::default(), "from 0")] {
                let name = format!("{what}, projected Gauss-Seidel {from}");
                found.extend(self.stopped(&name, &**pgs, &frozen, start));
            }
        }
        for (name, solver) in kinds(most) {
            let name = format!("{name} from the last answer");
            found.extend(self.stopped(&name, &*solver, self.lcp, &start));
        }
        found
    }

    /// The sweeps of a solver from a start, stopped where they come nearest.
    fn stopped(
        &self,
        name: &str,
        solver: &dyn Solver,
        lcp: &Lcp,
        start: &Start,
    ) -> Option<Mistake> {
        let mut nearest = Nearest { case: self, best: (0, f64::INFINITY) };
        solver.solve(lcp, start, &mut nearest);
        let (sweeps, distance) = nearest.best;
        let plural = if sweeps == 1 { "" } else { "s" };
        let what = format!("{name}, stopped after {sweeps} sweep{plural}");
        (sweeps > 0).then_some(Mistake { what, distance })
    }

    /// Gauss-Seidel in 32 bits.
    fn single_precision(&self, most: usize) -> Option<Mistake> {
        let n = self.lcp.len();
        let single = |v: &[f64]| -> Vec<f32> { v.iter().map(|&v| v as f32).collect() };
        let (b, mut x) = (single(self.lcp.b()), vec![0.0_f32; n]);
        let mut wide = vec![0.0; n]; // the same x
        let mut best = (0, f64::INFINITY);
        for sweep in 1..=most {
            for i in 0..n {
                let row = self.lcp.matrix().row(i);
                let w = row.iter().fold(b[i], |sum, (j, a)| sum + a as f32 * x[j]);
                let value = f64::from(x[i] - w / self.lcp.matrix().diagonal(i) as f32);
                x[i] = self.lcp.project(i, value, &wide) as f32;
                wide[i] = f64::from(x[i]);
            }
            let distance = self.distance(&wide);
            if distance < best.1 {
                best = (sweep, distance);
            }
        }
        let what = format!("projected Gauss-Seidel in single precision, {} sweeps", best.0);
        Some(Mistake { what, distance: best.1 })
    }

    /// The solution of a changed problem.
    fn answer(&self, what: &str, changed: &Lcp) -> Option<Mistake> {
        let distance = self.distance(&solution(changed)?);
        Some(Mistake { what: format!("{what}, solved"), distance })
    }

    /// A + ε I in place of A: then w = −ε x in every free row, and x is the solution with that ε.
    fn compliance(&self) -> Option<Mistake> {
        let w = self.lcp.w(self.x);
        let free = self.free();
        let parts: Vec<f64> = free.iter().map(|&i| -w[i] / self.x[i]).collect();
        let softness = *parts.first()?;
        let is_one = parts.iter().all(|part| (part - softness).abs() <= SAME * softness.abs());
        let is_seen = softness > 1e-12 * self.lcp.matrix().diagonal(free[0]) && parts.len() > 1;
        let soft = if is_one && is_seen { softened(self.lcp, softness)? } else { return None };
        self.answer(
            &format!("compliance (CFM) {} on the diagonal of A", readable(softness, 4)),
            &soft,
        )
    }

    /// The solution times a factor: b was that much larger. Only where bounds are 0 and ∞ is that the same.
    fn factor(&self) -> Option<Mistake> {
        let cone = |i: usize| {
            self.lcp.is_coupled(i) || (self.lcp.lo()[i] == 0.0 && self.lcp.hi()[i].is_infinite())
        };
        if !(0..self.lcp.len()).all(cone) {
            return None;
        }
        let exact = solution(self.lcp)?;
        let (mut along, mut square) = (0.0, 0.0);
        for (x, y) in self.x.iter().zip(&exact) {
            along += x * y;
            square += y * y;
        }
        let factor = along / square;
        let scaled: Vec<f64> = exact.iter().map(|y| factor * y).collect();
        let distance = self.distance(&scaled);
        let what = format!("b times {} (a time step, a unit?), solved", readable(factor, 6));
        ((factor - 1.0).abs() > NEAR && factor.is_finite()).then_some(Mistake { what, distance })
    }

    /// The rows that lie between their bounds.
    fn free(&self) -> Vec<usize> {
        let is_inside = |&i: &usize| {
            let (lo, hi) = self.lcp.bounds(i, self.x);
            lo < self.x[i] && self.x[i] < hi && self.x[i] != 0.0
        };
        (0..self.lcp.len()).filter(is_inside).collect()
    }
}

/// The usual kinds of sweeps, so many.
fn kinds(most: usize) -> [(&'static str, Box<dyn Solver>); 6] {
    let settings = Settings { tolerance: 0.0, max_iterations: most, ..Settings::default() };
    let pgs = |order| Box::new(Pgs { omega: 1.0, order, settings: settings.clone() });
    let damping = Damping::Factor(1.0);
    [
        ("projected Gauss-Seidel", pgs(Order::Natural)),
        ("projected Gauss-Seidel from the last row to the first", pgs(Order::Reverse)),
        ("projected Gauss-Seidel there and back", pgs(Order::Symmetric)),
        ("projected Gauss-Seidel colour by colour", pgs(Order::Coloured)),
        (
            "Jacobi in place of Gauss-Seidel",
            Box::new(Jacobi { damping, settings: settings.clone() }),
        ),
        ("Gauss-Seidel with the clamp after the sweep", Box::new(Code6 { settings })),
    ]
}

/// The x that the usual solver of a problem claims.
fn solution(lcp: &Lcp) -> Option<Vec<f64>> {
    let solver = by_name(default_for(lcp), &Options::default()).ok()?;
    let solution = solver.solve(lcp, &Start::default(), &mut ());
    (solution.status == Status::Solved).then_some(solution.x)
}

/// The problem as it becomes by one mistake in it.
fn changed(lcp: &Lcp) -> Vec<(String, Lcp)> {
    let n = lcp.len();
    let with = |matrix, b, lo, hi| with(lcp, matrix, b, lo, hi);
    let (a, b, lo, hi) =
        (|| lcp.matrix().clone(), || lcp.b().to_vec(), || lcp.lo().to_vec(), || lcp.hi().to_vec());
    let mut all = Vec::new();
    let mut add =
        |what: String, changed: Option<Lcp>| all.extend(changed.map(|changed| (what, changed)));
    let negative = |v: &[f64]| v.iter().map(|v| -v).collect::<Vec<f64>>();
    add("b with the other sign".into(), with(a(), negative(lcp.b()), lo(), hi()));
    if !lcp.matrix().is_symmetric() {
        add("A transposed".into(), with(transposed(lcp.matrix()), b(), lo(), hi()));
    }
    if !lcp.has_coupled_rows() {
        add(
            "bounds with the other sign, so that contacts pull".into(),
            with(a(), b(), negative(lcp.hi()), negative(lcp.lo())),
        );
    }
    if lcp.has_coupled_rows() {
        let is_friction: Vec<bool> = (0..n).map(|i| lcp.is_coupled(i)).collect();
        let bounded = |size: f64| {
            let pick = |own: &[f64], bound: f64| -> Vec<f64> {
                own.iter()
                    .zip(&is_friction)
                    .map(|(&own, &is)| if is { bound } else { own })
                    .collect()
            };
            Lcp::new(a(), b(), pick(lcp.lo(), -size), pick(lcp.hi(), size)).ok()
        };
        let without = bounded(0.0);
        add("friction left out".into(), without.clone());
        add("friction without a limit".into(), bounded(f64::INFINITY));
        if let Some(x) = without.as_ref().and_then(solution) {
            add(
                "friction limited by the normal forces of a solve without friction".into(),
                Some(lcp.frozen_at(&x)),
            );
        }
    }
    if n <= LARGEST_BY_ROWS {
        for i in (0..n).filter(|&i| !lcp.is_coupled(i)) {
            let (mut lo, mut hi) = (lo(), hi());
            if lo[i].is_infinite() && hi[i].is_infinite() {
                continue;
            }
            (lo[i], hi[i]) = (f64::NEG_INFINITY, f64::INFINITY);
            add(format!("row {i} without its bounds"), with(a(), b(), lo, hi));
        }
    }
    all
}

fn transposed(matrix: &Matrix) -> Matrix {
    let entries: Vec<(usize, usize, f64)> =
        (0..matrix.len()).flat_map(|i| matrix.row(i).iter().map(move |(j, a)| (j, i, a))).collect();
    Matrix::sparse(matrix.len(), &entries)
}

/// A + ε I.
fn softened(lcp: &Lcp, softness: f64) -> Option<Lcp> {
    let n = lcp.len();
    let all = (0..n).flat_map(|i| lcp.matrix().row(i).iter().map(move |(j, a)| (i, j, a)));
    let entries: Vec<_> = all.chain((0..n).map(|i| (i, i, softness))).collect();
    with(lcp, Matrix::sparse(n, &entries), lcp.b().to_vec(), lcp.lo().to_vec(), lcp.hi().to_vec())
}

/// A problem of other numbers with the coupled rows of this one.
fn with(lcp: &Lcp, matrix: Matrix, b: Vec<f64>, lo: Vec<f64>, hi: Vec<f64>) -> Option<Lcp> {
    let plain = Lcp::new(matrix, b, lo, hi).ok()?;
    match lcp.coupling() {
        Some(coupling) => plain.with_coupling(coupling.clone()).ok(),
        None => Some(plain),
    }
}
