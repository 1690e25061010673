//! The steps from masses and rows to a motion, each in single or double precision.
//!
//! A stage in single precision rounds its input to 24 bits, computes in it, and hands its result
//! on. The stages of the solvers run the code of the [textbook](lcplab_solver::textbook).

use std::cell::Cell;

use lcplab_lcp::number::count;
use lcplab_lcp::{Gauss, Lcp};
use lcplab_solver::textbook::{
    Matrix, Real, Vector, dantzig_with, gauss_seidel, interior_point_with, ldlt, newton_with,
    point, solve,
};

use super::{Stage, TextbookSolver};

/// Dantzig's and Newton's methods are stopped after this number of linear solves per row: rounding
/// can make them return to the same rows.
const SOLVES_PER_ROW: usize = 20;

/// Steps of the interior-point method: each divides the gap by about ten, down to rounding.
const INTERIOR_STEPS: usize = 30;

/// M, J, bias, γ and u*, dense.
#[derive(Debug, Clone)]
pub(super) struct Motion {
    pub mass: Matrix,
    jacobian: Matrix,
    bias: Vector,
    compliance: Vector,
    pub target: Vector,
}

impl Motion {
    pub fn new(gauss: &Gauss) -> Self {
        let (n, k) = (gauss.jacobian.len(), gauss.target.len());
        let mut mass = Matrix::zeros(k, k);
        for &(i, j, value) in &gauss.mass {
            (mass[(i, j)], mass[(j, i)]) = (value, value);
        }
        let mut jacobian = Matrix::zeros(n, k);
        for (i, row) in gauss.jacobian.iter().enumerate() {
            row.iter().for_each(|&(j, value)| jacobian[(i, j)] = value);
        }
        let vector = |own: &[f64]| Vector::from_column_slice(own);
        let (bias, compliance) = (vector(&gauss.bias), vector(&gauss.compliance));
        Motion { mass, jacobian, bias, compliance, target: vector(&gauss.target) }
    }

    fn rounded(&self) -> Self {
        Motion {
            mass: self.mass.map(nearest_single),
            jacobian: self.jacobian.map(nearest_single),
            bias: self.bias.map(nearest_single),
            compliance: self.compliance.map(nearest_single),
            target: self.target.map(nearest_single),
        }
    }

    /// A = J M⁻¹Jᵀ + diag(γ) and b = J u* + bias, computed in T; sums run over increasing columns.
    pub fn assembled<T: Real>(&self) -> (Matrix, Vector) {
        let (n, k) = self.jacobian.shape();
        let rows = self.jacobian.map(T::nearest);
        let target = self.target.map(T::nearest);
        let (l, d) = ldlt(&self.mass.map(T::nearest));
        let responses: Vec<Vector<T>> =
            (0..n).map(|i| solve(&l, &d, &rows.row(i).transpose())).collect(); // M⁻¹J_iᵀ
        let along = |i: usize, v: &Vector<T>| -> T { (0..k).map(|c| rows[(i, c)] * v[c]).sum() };
        let mut a = Matrix::zeros(n, n);
        for i in 0..n {
            for j in 0..=i {
                let own = along(i, &responses[j]);
                let own = if i == j { own + T::nearest(self.compliance[i]) } else { own };
                (a[(i, j)], a[(j, i)]) = (own.double(), own.double());
            }
        }
        let b = |i: usize, _| (along(i, &target) + T::nearest(self.bias[i])).double();
        (a, Vector::from_fn(n, b))
    }

    /// u* + M⁻¹Jᵀx, computed in T.
    pub fn velocity<T: Real>(&self, x: &Vector) -> Vector {
        let (rows, x) = (self.jacobian.map(T::nearest), x.map(T::nearest));
        let (l, d) = ldlt(&self.mass.map(T::nearest));
        let force = |c: usize, _| -> T { (0..x.len()).map(|i| rows[(i, c)] * x[i]).sum() };
        let change = solve(&l, &d, &Vector::from_fn(self.target.len(), force));
        (self.target.map(T::nearest) + change).map(T::double)
    }
}

/// Everything from the data to the motion.
#[derive(Debug, Clone)]
pub(super) struct Pipeline {
    /// `None`: A and b are the data, and there is no velocity.
    pub motion: Option<Motion>,
    pub a: Matrix,
    pub b: Vector,
    pub lo: Vector,
    pub hi: Vector,
    pub solver: TextbookSolver,
    pub sweeps: usize,
}

impl Pipeline {
    /// The problem with the bounds of `lcp`.
    pub fn new(motion: Option<Motion>, lcp: &Lcp, solver: TextbookSolver, sweeps: usize) -> Self {
        let n = lcp.len();
        let a = Matrix::from_fn(n, n, |i, j| lcp.matrix().entry(i, j));
        let [b, lo, hi] = [lcp.b(), lcp.lo(), lcp.hi()].map(Vector::from_column_slice);
        Pipeline { motion, a, b, lo, hi, solver, sweeps }
    }

    /// x, and u if masses and rows are known, with these stages in single precision; `None` if the
    /// solver breaks down or numbers overflow.
    pub fn run(&self, single: &[Stage]) -> Option<(Vector, Option<Vector>)> {
        let is_single = |stage: Stage| single.contains(&stage);
        let data = if is_single(Stage::Data) { self.rounded() } else { self.clone() };
        let (a, b) = match &data.motion {
            None => (data.a.clone(), data.b.clone()),
            Some(motion) if is_single(Stage::Assembly) => motion.assembled::<f32>(),
            Some(motion) => motion.assembled::<f64>(),
        };
        let x = match (is_single(Stage::Sums), is_single(Stage::Factor)) {
            (false, false) => data.solve::<f64, f64>(&a, &b),
            (false, true) => data.solve::<f64, f32>(&a, &b),
            (true, false) => data.solve::<f32, f64>(&a, &b),
            (true, true) => data.solve::<f32, f32>(&a, &b),
        }?;
        let u = data.motion.as_ref().map(|motion| match is_single(Stage::Velocity) {
            false => motion.velocity::<f64>(&x),
            true => motion.velocity::<f32>(&x),
        });
        let is_finite = |v: &Vector| v.iter().all(|value| value.is_finite());
        (is_finite(&x) && u.as_ref().is_none_or(is_finite)).then_some((x, u))
    }

    /// The stages of this problem, in their order.
    pub fn stages(&self) -> Vec<Stage> {
        let has_factor = self.solver != TextbookSolver::Pgs;
        let has_motion = self.motion.is_some();
        let all = [
            (Stage::Data, true),
            (Stage::Assembly, has_motion),
            (Stage::Factor, has_factor),
            (Stage::Sums, true),
            (Stage::Velocity, has_motion),
        ];
        all.into_iter().filter(|(_, exists)| *exists).map(|(stage, _)| stage).collect()
    }

    /// What a stage costs more in double precision: numbers of 8 instead of 4 bytes, and
    /// multiplications.
    pub fn cost(&self, stage: Stage) -> String {
        let n = self.b.len();
        let k = self.motion.as_ref().map_or(0, |motion| motion.target.len());
        let stored = |numbers: usize| format!("{} more bytes of storage", count(4 * numbers));
        match (stage, self.solver) {
            (Stage::Data, _) => match &self.motion {
                None => stored(self.a.iter().filter(|a| **a != 0.0).count() + 3 * n),
                Some(motion) => {
                    let entries = motion.mass.iter().chain(motion.jacobian.iter());
                    stored(entries.filter(|value| **value != 0.0).count() + 4 * n + k)
                }
            },
            (Stage::Assembly, _) => {
                format!("n²k/2 = {} multiplications", count((n * n * k).div_ceil(2)))
            }
            (Stage::Factor, _) => {
                format!("n³/3 = {} multiplications per solve", count((n * n * n).div_ceil(3)))
            }
            (Stage::Sums, TextbookSolver::Pgs) => {
                format!("n² = {} multiplications per sweep, x and w in double", count(n * n))
            }
            (Stage::Sums, _) => {
                format!("2n² = {} multiplications per step, x and w in double", count(2 * n * n))
            }
            (Stage::Velocity, _) => {
                format!("nk = {} multiplications, x in double", count(n * k))
            }
        }
    }

    fn rounded(&self) -> Self {
        let mut data = self.clone();
        data.motion = self.motion.as_ref().map(Motion::rounded);
        data.a.apply(|a| *a = nearest_single(*a));
        for own in [&mut data.b, &mut data.lo, &mut data.hi] {
            own.apply(|value| *value = nearest_single(*value));
        }
        data
    }

    /// x with sums in T and linear equations in F.
    fn solve<T: Real, F: Real>(&self, a: &Matrix, b: &Vector) -> Option<Vector> {
        let (a, b) = (a.map(T::nearest), b.map(T::nearest));
        let (lo, hi) = (self.lo.map(T::nearest), self.hi.map(T::nearest));
        let most_solves = SOLVES_PER_ROW * b.len();
        let solves = Cell::new(0);
        let free_point = |a: &Matrix<T>, b: &Vector<T>, free: &[bool]| {
            solves.set(solves.get() + 1);
            let x = point(&a.map(convert::<T, F>), &b.map(convert::<T, F>), free)?;
            let is_finite = x.iter().all(|x| x.double().is_finite());
            (is_finite && solves.get() <= most_solves).then(|| x.map(convert::<F, T>))
        };
        let x = match self.solver {
            TextbookSolver::Pgs => gauss_seidel(&a, &b, &lo, &hi, self.sweeps),
            TextbookSolver::InteriorPoint => interior_point_with(&a, &b, INTERIOR_STEPS, |a, r| {
                let (l, d) = ldlt(&a.map(convert::<T, F>));
                solve(&l, &d, &r.map(convert::<T, F>)).map(convert::<F, T>)
            }),
            TextbookSolver::Dantzig => dantzig_with(&a, &b, &lo, &hi, free_point)?,
            TextbookSolver::Newton => newton_with(&a, &b, &lo, &hi, most_solves, free_point)?,
        };
        Some(x.map(T::double))
    }
}

fn convert<S: Real, T: Real>(value: S) -> T {
    T::nearest(value.double())
}

fn nearest_single(value: f64) -> f64 {
    f32::nearest(value).double()
}
