//! Model 3: a polygon instead of the disk; the rest of the problem is an LCP without approximation.
//!
//! ```text
//! x_t = D β,   β ≥ 0,   Σ_j β_j ≤ μ x_n          D = k unit vectors d_1 … d_k around the tangent plane
//! ```
//!
//! k nonnegative impulses β replace the two tangential ones: x_t lies in the polygon with corners μ
//! x_n d_j. A third unknown of each contact, γ, is the largest slip speed along a −d_j, and three
//! complementarity conditions state Coulomb's law (⟂: both are at least 0 and one of them is 0):
//!
//! ```text
//! x_n ⟂ w_n                      [ w_n ]   [ A_nn  A_nD  0 ] [ x_n ]   [ b_n    ]
//! β_j ⟂ d_j·w_t + γ              [ w_β ] = [ A_Dn  A_DD  E ] [ β   ] + [ Dᵀ b_t ]
//! γ   ⟂ μ x_n − Σ_j β_j          [ w_γ ]   [ μ     −Eᵀ   0 ] [ γ   ]   [ 0      ]
//! ```
//!
//! The second line makes γ at least the speed along every −d_j, and allows β_j > 0 only if γ is
//! equal to that speed: friction acts along the d_j most opposed to the slip. γ is the slip speed
//! |w_t| if the slip is along a −d_j, otherwise less, down to cos(π/k) |w_t|. The third line says
//! that a sliding contact, γ > 0, uses all of μ x_n. E has one column of k ones for each contact.
//!
//! The matrix M is not symmetric, so no energy is minimized and sweep methods have no descent
//! property. M is copositive, zᵀM z = xᵀA x + Σ μ x_n γ ≥ 0 for z ≥ 0, as Lemke's method requires:
//! it ends at a solution whenever b = J u*, because then xᵀA x = 0 implies Jᵀx = 0 and bᵀx = 0. The
//! costs are k + 2 unknowns for each contact and a remaining anisotropy: an edge of the polygon is
//! closer to the center than a corner by the factor cos(π/k), which gives 29 % too little friction
//! for k = 4, 8 % for k = 8 and 2 % for k = 16. At a contact that slides between two directions,
//! friction acts along the closer one, up to 180°/k off.
//!
//! x alone determines whether it is a solution: [`Polyhedral::z`] computes the matching β and γ, if
//! they exist.
//!
//! Stewart & Trinkle 1996; Anitescu & Potra 1997.

mod row_residual;
mod unknowns;

pub use self::row_residual::Unknowns;
use self::unknowns::{along, beta, delassus, direction, impulses};
use super::FrictionProblem;
use crate::error::{Error, Result};
use crate::exact::Point;
use crate::exact::dyadic::{Dyadic, dyadic};
use crate::memory::Memory;
use crate::{Lcp, Matrix};

/// Memory for each entry while the matrix is made (in numbers): its position and value, twice, and
/// the matrix.
const ENTRY: usize = 8;

/// The polyhedral LCP of a friction problem, and the conversions between x and z.
///
/// ```
/// use lcplab_lcp::exact::Point;
/// use lcplab_lcp::exact::dyadic::dyadic;
/// use lcplab_lcp::friction::{Contact, FrictionProblem, Polyhedral};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // A point of 1 kg reaches the ground with 2 m/s and slides along t1 with 3 m/s: w = x + b.
/// let a = Matrix::from([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
/// let (b, free) = (vec![-2.0, -3.0, 0.0], f64::INFINITY);
/// let lcp = Lcp::new(a, b, vec![0.0, -free, -free], vec![free; 3])?;
/// let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
/// let polygon = Polyhedral::new(&problem, 4)?;
/// assert_eq!(polygon.directions(), 4);
/// let unknowns = polygon.unknowns().next().unwrap(); // of the only contact
/// assert_eq!((unknowns.normal, unknowns.beta, unknowns.gamma), (0, 1..5, 5));
/// assert_eq!((polygon.row(0), polygon.row(2), polygon.row(5)), (0, 1, 0)); // n, t1, n
///
/// // 2 N s stop the fall, μ · 2 N s act against the slip, of which γ = 2 m/s remain.
/// let x = [2.0, 1.0, 0.0];
/// assert!(polygon.is_solution(&x, 1e-8));
/// let z = polygon.z(&x);
/// assert_eq!(z, [2.0, 1.0, 0.0, 0.0, 0.0, 2.0]);
/// assert_eq!(polygon.z_at_rest(&x)[5], 0.0); // the same without γ
/// let exact = Point::new(z.iter().map(|&z| dyadic(z)).collect(), dyadic(1.0));
/// assert_eq!(polygon.exact_x(&exact).distance(&x), 0.0);
/// assert_eq!(polygon.softened(0.5)?.friction().lcp().matrix().diagonal(0), 1.5);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
#[derive(Debug, Clone)]
pub struct Polyhedral {
    lcp: Lcp,
    /// For each unknown that is an impulse the entries (row, value) of x that it contributes to.
    impulses: Vec<Vec<(usize, f64)>>,
    /// The original problem.
    friction: FrictionProblem,
    /// The number of directions, k.
    directions: usize,
}

impl Polyhedral {
    /// The LCP with k directions: 4, 8, 12, …, the first one along t1. Its unknowns are the x of
    /// rows that belong to no contact, all x_n, the k impulses β of each contact, and all γ; a
    /// contact with μ = 0 has no β and no γ.
    ///
    /// ```
    /// use lcplab_lcp::friction::{Contact, FrictionProblem, Polyhedral};
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// // A point of 1 kg on the ground slides along t1: w = x + b.
    /// let (b, free) = (vec![-2.0, -3.0, 0.0], f64::INFINITY);
    /// let a = Matrix::from([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    /// let lcp = Lcp::new(a, b, vec![0.0, -free, -free], vec![free; 3])?;
    /// let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
    /// let polygon = Polyhedral::new(&problem, 4)?;
    /// assert_eq!(polygon.lcp().len(), 6); // x_n, four β, γ
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// If k is not a positive multiple of 4, or the matrix would take more than 4 GB.
    pub fn new(problem: &FrictionProblem, k: usize) -> Result<Self> {
        if k == 0 || !k.is_multiple_of(4) {
            let reason = format!("must be a positive multiple of 4, is {k}");
            return Err(Error::invalid("polyhedral friction", "directions", reason));
        }
        let impulses = impulses(problem, k);
        let (stored, unknowns) = (problem.lcp().matrix().stored(), impulses.len());
        let entries = unknowns.saturating_mul(unknowns).min(stored.saturating_mul(k * k / 4));
        let what = format!("the polygons' matrix of {unknowns} impulses with {entries} entries");
        Memory::default().check(what, Memory::numbers(ENTRY).times(entries))?;
        let (contacts, others) = (problem.contacts(), problem.others());
        let mut entries = delassus(problem.lcp().matrix(), &impulses);
        let (mut beta, mut gamma) = (others.len() + contacts.len(), impulses.len());
        for (c, contact) in contacts.iter().enumerate().filter(|(_, contact)| contact.mu > 0.0) {
            // μ
            entries.push((gamma, others.len() + c, contact.mu));
            for beta in beta..beta + k {
                // E
                entries.push((beta, gamma, 1.0));
                // −Eᵀ
                entries.push((gamma, beta, -1.0));
            }
            (beta, gamma) = (beta + k, gamma + 1);
        }
        let size = gamma;
        let mut b: Vec<f64> = impulses.iter().map(|u| along(u, problem.lcp().b())).collect();
        b.resize(size, 0.0);
        let mut lo: Vec<f64> = others.iter().map(|&i| problem.lcp().lo()[i]).collect();
        lo.resize(size, 0.0);
        let mut hi: Vec<f64> = others.iter().map(|&i| problem.lcp().hi()[i]).collect();
        hi.resize(size, f64::INFINITY);
        let lcp = Lcp::new(Matrix::sparse(size, &entries), b, lo, hi)?
            .with_scale(problem.lcp().scale())?;
        Ok(Polyhedral { lcp, impulses, friction: problem.clone(), directions: k })
    }

    /// The original friction problem.
    pub fn friction(&self) -> &FrictionProblem {
        &self.friction
    }

    /// The number of directions, k.
    pub fn directions(&self) -> usize {
        self.directions
    }

    /// The LCP, w = M z + q.
    pub fn lcp(&self) -> &Lcp {
        &self.lcp
    }

    /// The model with a slightly more compliant A, see [`FrictionProblem::softened`].
    ///
    /// # Errors
    /// If an increased entry is not finite.
    pub fn softened(&self, part: f64) -> Result<Self> {
        Polyhedral::new(&self.friction.softened(part)?, self.directions)
    }

    /// The impulses x of the unknowns z: x_t = D β.
    ///
    /// ```
    /// use lcplab_lcp::friction::{Contact, FrictionProblem, Polyhedral};
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// // A point of 1 kg on the ground slides along t1: w = x + b.
    /// let (b, free) = (vec![-2.0, -3.0, 0.0], f64::INFINITY);
    /// let a = Matrix::from([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    /// let lcp = Lcp::new(a, b, vec![0.0, -free, -free], vec![free; 3])?;
    /// let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
    /// let polygon = Polyhedral::new(&problem, 4)?;
    /// let x = [2.0, 1.0, 0.0];
    /// assert_eq!(polygon.x(&polygon.z(&x)), x);
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn x(&self, z: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; self.friction.lcp().len()];
        for (impulse, z) in self.impulses.iter().zip(z) {
            for &(i, value) in impulse {
                x[i] += value * z;
            }
        }
        x
    }

    /// [`Polyhedral::x`] in exact arithmetic.
    pub fn exact_x(&self, z: &Point) -> Point {
        let mut x = vec![Dyadic::ZERO; self.friction.lcp().len()];
        for (unknown, impulse) in self.impulses.iter().enumerate() {
            for &(i, value) in impulse {
                x[i] = &x[i] + dyadic(value) * z.scaled(unknown);
            }
        }
        Point::new(x, z.denominator().clone())
    }

    /// The unknowns z for impulses x: they solve the LCP if and only if x is the friction of one of
    /// its solutions.
    ///
    /// x_t lies between two adjacent d_j, and β are its components along them, which have the
    /// smallest sum. (z does not contain the x_t of a contact with μ = 0.) γ is the candidate with
    /// the smallest residual.
    pub fn z(&self, x: &[f64]) -> Vec<f64> {
        let mut z = self.z_at_rest(x);
        for contact in self.unknowns() {
            z[contact.gamma] = self.best_gamma(&contact, &z);
        }
        z
    }

    /// [`Polyhedral::z`] with γ = 0 for all contacts.
    pub fn z_at_rest(&self, x: &[f64]) -> Vec<f64> {
        let (contacts, others) = (self.friction.contacts(), self.friction.others());
        let normals = contacts.iter().map(|contact| contact.rows[0]);
        let mut z: Vec<f64> = others.iter().copied().chain(normals).map(|i| x[i]).collect();
        let rubbing = contacts.iter().filter(|contact| contact.mu > 0.0);
        z.extend(rubbing.flat_map(|contact| beta(contact.of(x), self.directions)));
        z.resize(self.lcp.len(), 0.0);
        z
    }

    /// The index of the first β: the x of the other rows and all x_n come before it.
    fn first_beta(&self) -> usize {
        self.friction.others().len() + self.friction.contacts().len()
    }

    /// The point of the polygon with corners radius d_j that is nearest to p.
    ///
    /// ```
    /// use lcplab_lcp::friction::{FrictionProblem, Polyhedral};
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// let empty = Lcp::new(Matrix::dense(0, &[]), vec![], vec![], vec![])?;
    /// let square = Polyhedral::new(&FrictionProblem::new(empty, vec![])?, 4)?;
    /// assert_eq!(square.nearest(1.0, [0.25, 0.5]), [0.25, 0.5]); // inside
    /// assert_eq!(square.nearest(1.0, [1.0, 1.0]), [0.5, 0.5]); // beyond an edge
    /// assert_eq!(square.nearest(1.0, [3.0, 0.5]), [1.0, 0.0]); // beyond a corner
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn nearest(&self, radius: f64, p: [f64; 2]) -> [f64; 2] {
        let k = self.directions;
        let corner = |j: usize| direction(j % k, k).map(|d| radius * d);
        let to_edge = |j: usize| -> Option<[f64; 2]> {
            let (a, b) = (corner(j), corner(j + 1));
            let edge = [b[0] - a[0], b[1] - a[1]];
            let way = [p[0] - a[0], p[1] - a[1]];
            if edge[0] * way[1] - edge[1] * way[0] >= 0.0 {
                // The point is on the inner side.
                return None;
            }
            let length = edge[0] * edge[0] + edge[1] * edge[1];
            let part = ((edge[0] * way[0] + edge[1] * way[1]) / length).clamp(0.0, 1.0);
            Some(if part == 1.0 { b } else { [a[0] + part * edge[0], a[1] + part * edge[1]] })
        };
        if radius <= 0.0 {
            return [0.0; 2];
        }
        let distance = |q: &[f64; 2]| crate::hypot(q[0] - p[0], q[1] - p[1]);
        let beyond = (0..k).filter_map(to_edge);
        beyond.min_by(|a, b| distance(a).total_cmp(&distance(b))).unwrap_or(p)
    }

    /// The row of x for an unknown: its own row, t1 for β, n for γ.
    pub fn row(&self, unknown: usize) -> usize {
        let rubbing = self.friction.contacts().iter().filter(|contact| contact.mu > 0.0);
        let mut normals = rubbing.map(|contact| contact.rows[0]);
        match self.impulses.get(unknown) {
            Some(impulse) => impulse[0].0,
            None => normals.nth(unknown - self.impulses.len()).unwrap_or_default(),
        }
    }
}
