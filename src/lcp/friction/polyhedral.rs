//! Model 3: a polygon in place of the disc, and an LCP without approximation otherwise.
//!
//! ```text
//! x_t = D β,   β ≥ 0,   Σ_j β_j ≤ μ x_n          D = k unit vectors d_1 … d_k around the tangent plane
//! ```
//!
//! k impulses β that can only push replace the two tangential ones: x_t lies in the polygon whose
//! corners are μ x_n d_j. A third unknown of each contact, γ, is the speed of sliding, and three rows
//! of complementarity say what Coulomb says (⟂: both at least 0, one of them 0):
//!
//! ```text
//! x_n ⟂ w_n                      [ w_n ]   [ A_nn  A_nD  0 ] [ x_n ]   [ b_n    ]
//! β_j ⟂ d_j·w_t + γ              [ w_β ] = [ A_Dn  A_DD  E ] [ β   ] + [ Dᵀ b_t ]
//! γ   ⟂ μ x_n − Σ_j β_j          [ w_γ ]   [ μ     −Eᵀ   0 ] [ γ   ]   [ 0      ]
//! ```
//!
//! The second line makes γ at least the speed along every −d_j, and lets only those β push for which
//! it is that speed: friction acts along the d_j most opposed to the slip. The third: a contact that
//! slides, γ > 0, uses all of μ x_n. E has a column of k ones a contact.
//!
//! The matrix M is not symmetric, so there is no energy to minimise and sweeps have nothing to
//! descend. It is copositive, zᵀM z = xᵀA x + Σ μ x_n γ ≥ 0 for z ≥ 0, which is what Lemke's method
//! needs: it ends at a solution whenever b = J u*, for then xᵀA x = 0 implies Jᵀx = 0 and bᵀx = 0. The
//! price is k + 2 unknowns a contact, and directions still: an edge of the polygon comes nearer to the
//! centre than a corner by the factor cos(π/k), 29 % too little friction for k = 4, 8 % for 8, 2 % for
//! 16. A contact that slides between two directions rubs along the nearer one, up to 180°/k off.
//!
//! Stewart & Trinkle 1996; Anitescu & Potra 1997. `math §5`, model 3.

use std::f64::consts::TAU;

use super::FrictionProblem;
use crate::error::{Error, Result};
use crate::lcp::{Lcp, Matrix};

/// The polyhedral LCP of a friction problem, and the way back.
#[derive(Debug, Clone)]
pub struct Polyhedral {
    lcp: Lcp,
    /// For each unknown that is an impulse the entries (row, value) of x that it adds to.
    impulses: Vec<Vec<(usize, f64)>>,
    /// The number of rows of x.
    rows: usize,
}

impl Polyhedral {
    /// The LCP with k directions: 4, 8, 12, …, the first one along t1. Its unknowns are the x of
    /// rows that belong to no contact, all x_n, the k impulses β of each contact, and all γ; a contact
    /// with μ = 0 has neither β nor γ.
    ///
    /// # Errors
    /// If k is not a positive multiple of 4.
    pub fn new(problem: &FrictionProblem, k: usize) -> Result<Self> {
        if k == 0 || !k.is_multiple_of(4) {
            let reason = format!("must be a positive multiple of 4, is {k}");
            return Err(Error::invalid("polyhedral friction", "directions", reason));
        }
        let impulses = impulses(problem, k);
        let (contacts, others) = (problem.contacts(), problem.others());
        let mut entries = delassus(problem.lcp().matrix(), &impulses);
        let (mut beta, mut gamma) = (others.len() + contacts.len(), impulses.len());
        for (c, contact) in contacts.iter().enumerate().filter(|(_, contact)| contact.mu > 0.0) {
            entries.push((gamma, others.len() + c, contact.mu)); // μ
            for beta in beta..beta + k {
                entries.push((beta, gamma, 1.0)); // E
                entries.push((gamma, beta, -1.0)); // −Eᵀ
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
        let lcp = Lcp::new(Matrix::sparse(size, &entries), b, lo, hi)?;
        Ok(Polyhedral { lcp, impulses, rows: problem.lcp().len() })
    }

    /// The LCP, w = M z + q.
    pub fn lcp(&self) -> &Lcp {
        &self.lcp
    }

    /// The impulses x of the unknowns z: x_t = D β.
    pub fn x(&self, z: &[f64]) -> Vec<f64> {
        let mut x = vec![0.0; self.rows];
        for (impulse, z) in self.impulses.iter().zip(z) {
            for &(i, value) in impulse {
                x[i] += value * z;
            }
        }
        x
    }
}

/// What each unknown adds to x: unit vectors of the other rows and the normals, then the d_j.
fn impulses(problem: &FrictionProblem, k: usize) -> Vec<Vec<(usize, f64)>> {
    let (contacts, others) = (problem.contacts(), problem.others());
    let normals = contacts.iter().map(|contact| contact.rows[0]);
    let mut impulses: Vec<_> =
        others.iter().copied().chain(normals).map(|i| vec![(i, 1.0)]).collect();
    for contact in contacts.iter().filter(|contact| contact.mu > 0.0) {
        let [_, t1, t2] = contact.rows;
        impulses.extend((0..k).map(|j| {
            let [d1, d2] = direction(j, k);
            vec![(t1, d1), (t2, d2)]
        }));
    }
    impulses
}

/// d_j = (cos 2πj/k, sin 2πj/k), each quarter being the one before turned by exactly 90°.
fn direction(j: usize, k: usize) -> [f64; 2] {
    let (quarter, rest) = (j / (k / 4), j % (k / 4));
    let (sin, cos) = (TAU * rest as f64 / k as f64).sin_cos();
    (0..quarter).fold([cos, sin], |[d1, d2], _| [-d2, d1])
}

/// The entries u_pᵀ A u_q other than 0 for the impulses u.
fn delassus(a: &Matrix, impulses: &[Vec<(usize, f64)>]) -> Vec<(usize, usize, f64)> {
    let mut entries = Vec::new();
    for (p, u_p) in impulses.iter().enumerate() {
        let mut row = vec![0.0; a.len()]; // u_pᵀ A
        for &(i, value) in u_p {
            for (j, a) in a.row(i).iter() {
                row[j] += value * a;
            }
        }
        let products = impulses.iter().enumerate().map(|(q, u_q)| (p, q, along(u_q, &row)));
        entries.extend(products.filter(|entry| entry.2 != 0.0));
    }
    entries
}

/// u · v.
fn along(u: &[(usize, f64)], v: &[f64]) -> f64 {
    u.iter().map(|&(i, value)| value * v[i]).sum()
}
