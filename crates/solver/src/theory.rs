//! Convergence theory of the splitting methods while no bound is active.
//!
//! On equality rows, or once the set of free rows no longer changes, each sweep multiplies the
//! error by a fixed matrix G:
//!
//! ```text
//! e ← G e,   G = I − M⁻¹ A
//! Jacobi with damping θ   M = D / θ
//! SOR with ω              M = D / ω + L        (ω = 1: Gauss-Seidel)
//! SSOR with ω             forward SOR, then backward SOR
//! ```
//!
//! with A = L + D + U. The error converges to zero from every start if and only if all eigenvalues
//! of G are below 1 in modulus. Asymptotically each sweep multiplies it by the largest modulus, the
//! *spectral radius* ρ. The expected number of sweeps is ln(reduction) / ln ρ; slow convergence is
//! a property of A, not of the implementation.
//!
//! For a *consistently ordered* A (tridiagonal or red-black: chains and stacks, numbered from end
//! to end) Young's theory (1950) relates the methods:
//!
//! ```text
//! ρ_GS = ρ_J²,   ω* = 2 / (1 + √(1 − ρ_J²)),   ρ(ω*) = ω* − 1
//! ```
//!
//! If A is singular, the null vectors of A are eigenvectors of G with eigenvalue 1, so ρ = 1, but
//! they do not affect w. The *contraction* excludes them: for symmetric A with A V = V Λ over the
//! range (Λ without zeros) it is the spectral radius of Vᵀ G V.
//!
//! *Ostrowski and Reich* (1954, 1949): for symmetric A with a positive diagonal, Gauss-Seidel
//! contracts every error that affects w if and only if A is semidefinite. Scaling rows and columns
//! by S turns G into S⁻¹ G S, which has the same eigenvalues. G is therefore computed from the
//! [balanced](Matrix::balanced) A, so that units have no influence.

use nalgebra::DMatrix;

use crate::metric::Metric;
use crate::tolerances::{NULL_EIGENVALUE, UNIT_EIGENVALUE};
use crate::{Jacobi, Options, Order, Pgs};
use lcplab_lcp::{Lcp, Matrix};

/// The submatrix of A with these rows and columns, in that order: the matrix while these rows are
/// free.
///
/// ```
/// use lcplab_lcp::Matrix;
/// use lcplab_solver::theory::principal_submatrix;
///
/// let a = Matrix::from([[4.0, 1.0, 2.0], [1.0, 5.0, 3.0], [2.0, 3.0, 6.0]]);
/// let free = principal_submatrix(&a, &[0, 2]);
/// assert_eq!((free.len(), free.entry(0, 1), free.entry(1, 1)), (2, 2.0, 6.0));
/// ```
pub fn principal_submatrix(a: &Matrix, rows: &[usize]) -> Matrix {
    let block = DMatrix::from_fn(rows.len(), rows.len(), |i, j| a.entry(rows[i], rows[j]));
    Matrix::from(block.as_view())
}

/// I − θ D⁻¹ A, the iteration matrix of Jacobi's method with damping θ.
///
/// A diagonal entry of 0 gives infinite entries, here and in the functions below.
///
/// ```
/// use lcplab_lcp::Matrix;
/// use lcplab_solver::theory::jacobi_iteration_matrix;
/// use nalgebra::dmatrix;
///
/// let a = Matrix::from([[2.0, -1.0], [-1.0, 2.0]]);
/// assert_eq!(jacobi_iteration_matrix(&a, 1.0), dmatrix![0.0, 0.5; 0.5, 0.0]);
/// ```
pub fn jacobi_iteration_matrix(a: &Matrix, damping: f64) -> DMatrix<f64> {
    let n = a.len();
    DMatrix::from_fn(n, n, |i, j| f64::from(i == j) - damping * a.entry(i, j) / a.diagonal(i))
}

/// The iteration matrix of SOR (successive over-relaxation) with ω, rows in natural order.
///
/// ```
/// use lcplab_lcp::Matrix;
/// use lcplab_solver::theory::{sor_iteration_matrix, spectral_radius};
///
/// let a = Matrix::from([[2.0, -1.0], [-1.0, 2.0]]);
/// assert_eq!(spectral_radius(&sor_iteration_matrix(&a, 1.0)), 0.25); // Gauss-Seidel: ρ_J²
/// ```
pub fn sor_iteration_matrix(a: &Matrix, omega: f64) -> DMatrix<f64> {
    ordered_iteration_matrix(a, omega, 0..a.len())
}

/// The iteration matrix of relaxation with ω for rows in the given order, which may contain a row
/// more than once.
///
/// Its columns are the unit errors after one sweep:
///
/// ```text
/// e ← unit error,   then for each row i:   e_i ← e_i − ω/a_ii (A e)_i
/// ```
///
/// ```
/// use lcplab_lcp::Matrix;
/// use lcplab_solver::theory::ordered_iteration_matrix;
/// use nalgebra::dmatrix;
///
/// // Only row 0 is updated: its error becomes half of that of row 1, which stays.
/// let a = Matrix::from([[2.0, -1.0], [-1.0, 2.0]]);
/// assert_eq!(ordered_iteration_matrix(&a, 1.0, [0]), dmatrix![0.0, 0.5; 0.0, 1.0]);
/// ```
pub fn ordered_iteration_matrix(
    a: &Matrix,
    omega: f64,
    order: impl IntoIterator<Item = usize>,
) -> DMatrix<f64> {
    let order: Vec<usize> = order.into_iter().collect();
    let nonzeros = |i: usize| a.row(i).iter().filter(|&(_, entry)| entry != 0.0).collect();
    let rows: Vec<Vec<(usize, f64)>> = (0..a.len()).map(nonzeros).collect();
    let mut errors = DMatrix::identity(a.len(), a.len());
    // One unit error after the other: a column is contiguous in memory.
    for mut error in errors.column_iter_mut() {
        for &i in &order {
            let residual: f64 = rows[i].iter().map(|&(j, entry)| entry * error[j]).sum();
            error[i] -= residual * (omega / a.diagonal(i));
        }
    }
    errors
}

/// The largest modulus of an eigenvalue: the asymptotic factor by which errors shrink or grow. NaN
/// if an entry is not finite.
///
/// ```
/// use lcplab_solver::theory::spectral_radius;
/// use nalgebra::dmatrix;
///
/// assert_eq!(spectral_radius(&dmatrix![0.5, 3.0; 0.0, -0.75]), 0.75);
/// ```
pub fn spectral_radius(g: &DMatrix<f64>) -> f64 {
    if g.iter().any(|g| !g.is_finite()) {
        return f64::NAN;
    }
    let g = faer::Mat::from_fn(g.nrows(), g.ncols(), |i, j| g[(i, j)]);
    let largest =
        |values: Vec<faer::c64>| values.iter().map(|z| z.re.hypot(z.im)).fold(0.0, f64::max);
    g.eigenvalues().map_or(f64::NAN, largest)
}

/// The asymptotic factor by which w shrinks: the largest modulus of an eigenvalue other than 1.
///
/// The eigenvalue 1 belongs to the null vectors of a singular A: redundant contacts keep their
/// initial share of the load, which does not affect w. NaN if an entry is not finite.
///
/// ```
/// use lcplab_lcp::Matrix;
/// use lcplab_solver::theory::{contraction, jacobi_iteration_matrix};
///
/// // Two contacts that share a load: the eigenvalues are 1, for their difference, and 0.5.
/// let a = Matrix::from([[1.0, 1.0], [1.0, 1.0]]);
/// assert!((contraction(&jacobi_iteration_matrix(&a, 0.25)) - 0.5).abs() < 1e-15);
/// ```
pub fn contraction(g: &DMatrix<f64>) -> f64 {
    if g.iter().any(|g| !g.is_finite()) {
        return f64::NAN;
    }
    let g = faer::Mat::from_fn(g.nrows(), g.ncols(), |i, j| g[(i, j)]);
    let moving = |z: &faer::c64| (z.re - 1.0).hypot(z.im) > UNIT_EIGENVALUE;
    let largest = |values: Vec<faer::c64>| {
        values.iter().filter(|z| moving(z)).map(|z| z.re.hypot(z.im)).fold(0.0, f64::max)
    };
    g.eigenvalues().map_or(f64::NAN, largest)
}

/// The contraction of a registered method with these options while exactly the rows `free` are
/// inside their bounds; `None` if the method is not a linear iteration or does not contract.
///
/// ```
/// use lcplab_lcp::library;
/// use lcplab_solver::{Options, theory};
///
/// // Two bodies, the upper one 3 times as heavy: r / (1 + r).
/// let lcp = library::by_name("stack")?.generate(&[("n", 2.0), ("ratio", 3.0)])?.lcp;
/// let rate = theory::rate("pgs", &Options::default(), &lcp, &[0, 1]).unwrap();
/// assert!((rate - 0.75).abs() < 1e-12);
/// assert_eq!(theory::rate("dantzig", &Options::default(), &lcp, &[0, 1]), None);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn rate(method: &str, options: &Options, lcp: &Lcp, free: &[usize]) -> Option<f64> {
    let (block, _) = principal_submatrix(lcp.matrix(), free).balanced();
    let relaxed = |omega: f64, order: Order| {
        let place = |row: usize| free.iter().position(|&other| other == row);
        ordered_iteration_matrix(&block, omega, order.rows(lcp).into_iter().filter_map(place))
    };
    let matrix = match method {
        Pgs::NAME => relaxed(1.0, options.order),
        Pgs::RELAXED => relaxed(options.omega, options.order),
        Pgs::SYMMETRIC => relaxed(options.omega, Order::Symmetric),
        Pgs::COLORED => relaxed(1.0, Order::Colored),
        Jacobi::NAME => {
            jacobi_iteration_matrix(&block, options.damping.factor(&Metric::of(lcp).ok()?))
        }
        _ => return None,
    };
    Some(contraction_of(&block, &matrix)).filter(|rate| *rate < 1.0)
}

/// The asymptotic factor by which a Gauss-Seidel sweep over all rows reduces the error, excluding
/// null vectors of A; independent of the units of the rows. `None` if it is not below 1 or cannot
/// be computed: A is then not symmetric and semidefinite with a positive diagonal.
///
/// ```
/// use lcplab_lcp::Matrix;
/// use lcplab_solver::theory::gauss_seidel_rate;
///
/// let rate = |a: &[f64]| gauss_seidel_rate(&Matrix::dense(2, a));
/// assert!((rate(&[2.0, 1.0, 1.0, 2.0]).unwrap() - 0.25).abs() < 1e-15); // a₁₂² / (a₁₁ a₂₂)
/// assert!((rate(&[2e-200, 1.0, 1.0, 2e200]).unwrap() - 0.25).abs() < 1e-15);
/// assert_eq!(rate(&[1.0, 2.0, 2.0, 1.0]), None); // indefinite
/// ```
pub fn gauss_seidel_rate(a: &Matrix) -> Option<f64> {
    let (a, _) = a.balanced();
    Some(contraction_of(&a, &sor_iteration_matrix(&a, 1.0))).filter(|rate| *rate < 1.0)
}

/// The contraction of the iteration matrix G of a balanced A.
fn contraction_of(a: &Matrix, g: &DMatrix<f64>) -> f64 {
    match range(a) {
        Some(range) if !g.iter().any(|g| !g.is_finite()) => {
            spectral_radius(&(range.transpose() * g * range))
        }
        _ => contraction(g),
    }
}

/// Orthonormal columns that span the range of a symmetric A, the complement of its null space.
fn range(a: &Matrix) -> Option<DMatrix<f64>> {
    if a.is_empty() || !a.is_nearly_symmetric() {
        return None;
    }
    let full = faer::Mat::from_fn(a.len(), a.len(), |i, j| a.entry(i, j));
    let found = full.self_adjoint_eigen(faer::Side::Lower).ok()?;
    let (values, vectors) = (found.S().column_vector(), found.U());
    let size = |k: usize| f64::abs(values[k]);
    let largest = (0..a.len()).map(size).fold(0.0, f64::max);
    let kept: Vec<usize> = (0..a.len()).filter(|&k| size(k) > NULL_EIGENVALUE * largest).collect();
    Some(DMatrix::from_fn(a.len(), kept.len(), |i, k| vectors[(i, kept[k])]))
}

/// The rows strictly between their bounds at x.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_solver::theory::rows_inside;
///
/// let a = Matrix::from([[2.0, 0.0], [0.0, 2.0]]);
/// let lcp = Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![1.0; 2])?;
/// assert_eq!(rows_inside(&lcp, &[0.5, 1.0]), [0]);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn rows_inside(lcp: &Lcp, x: &[f64]) -> Vec<usize> {
    let is_free = |&i: &usize| {
        let (lo, hi) = lcp.bounds(i, x);
        lo < x[i] && x[i] < hi
    };
    (0..lcp.len()).filter(is_free).collect()
}

/// Young's ω* from the spectral radius of the undamped Jacobi matrix, for a consistently ordered A.
/// NaN if Jacobi's method does not converge.
///
/// ```
/// use lcplab_solver::theory::optimal_omega;
///
/// assert!((optimal_omega(0.8) - 1.25).abs() < 1e-15);
/// ```
pub fn optimal_omega(jacobi_radius: f64) -> f64 {
    2.0 / (1.0 + (1.0 - jacobi_radius * jacobi_radius).sqrt())
}

/// Young's ρ(ω) of SOR from the spectral radius of the undamped Jacobi matrix, for a consistently
/// ordered A: the asymptotic factor by which a sweep multiplies the error.
///
/// ```
/// use lcplab_solver::theory::sor_radius;
///
/// assert_eq!(sor_radius(0.8, 1.0), 0.8_f64.powi(2)); // Gauss-Seidel
/// assert!((sor_radius(0.8, 1.25) - 0.25).abs() < 1e-7); // ω* = 1.25: ω* − 1
/// assert_eq!(sor_radius(0.8, 1.5), 0.5);
/// ```
pub fn sor_radius(jacobi_radius: f64, omega: f64) -> f64 {
    let along = omega * jacobi_radius;
    let root = along * along - 4.0 * (omega - 1.0);
    if root < 0.0 { omega - 1.0 } else { (0.5 * (along + root.sqrt())).powi(2) }
}

/// ρ_J = cos(π/2n), the spectral radius of the Jacobi matrix of a column of n bodies on the ground.
///
/// ```
/// use lcplab_solver::theory::column_radius;
///
/// assert!((column_radius(2) - 0.5_f64.sqrt()).abs() < 1e-15);
/// ```
pub fn column_radius(n: usize) -> f64 {
    libm::cos(std::f64::consts::FRAC_PI_2 / n as f64)
}

/// The number of sweeps that reduce the error by the factor `reduction` (below 1) at spectral
/// radius ρ; infinite for ρ ≥ 1.
///
/// ```
/// use lcplab_solver::theory::sweeps_to;
///
/// assert_eq!(sweeps_to(1e-6, 0.1).round(), 6.0);
/// assert_eq!(sweeps_to(1e-6, 1.0), f64::INFINITY);
/// ```
pub fn sweeps_to(reduction: f64, radius: f64) -> f64 {
    if radius < 1.0 { reduction.ln() / radius.ln() } else { f64::INFINITY }
}
