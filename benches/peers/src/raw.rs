//! A problem as C arrays: dense, by rows.

use std::os::raw::c_int;

use lcplab::lcp::Lcp;

use crate::contender::{Contender, Run};

/// A problem in plain arrays.
pub struct Raw {
    pub n: c_int,
    pub a: Vec<f64>,
    pub b: Vec<f64>,
    pub lo: Vec<f64>,
    pub hi: Vec<f64>,
}

/// A solver with C's calling convention: n, A, b, lo, hi, then x and the number of errors, which it
/// writes. It returns the seconds.
pub type Solver = unsafe extern "C" fn(
    c_int,
    *const f64,
    *const f64,
    *const f64,
    *const f64,
    *mut f64,
    *mut c_int,
) -> f64;

/// Declares solvers that are compiled from `shims/`.
macro_rules! solvers_in_c {
    ($($name:ident)*) => {
        unsafe extern "C" {
            $(pub fn $name(
                n: std::os::raw::c_int,
                a: *const f64,
                b: *const f64,
                lo: *const f64,
                hi: *const f64,
                x: *mut f64,
                complaints: *mut std::os::raw::c_int,
            ) -> f64;)*
        }
    };
}
pub(crate) use solvers_in_c;

impl Raw {
    pub fn of(lcp: &Lcp) -> Self {
        let n = c_int::try_from(lcp.len()).expect("a problem of this benchmark");
        let a = lcp.matrix().to_dense().transpose().as_slice().to_vec();
        Raw { n, a, b: lcp.b().to_vec(), lo: lcp.lo().to_vec(), hi: lcp.hi().to_vec() }
    }

    /// A copy for a solver of A x = b + w; the distance between rows of A is a multiple of this
    /// number of entries.
    pub fn padded(&self, every: usize) -> Raw {
        let (rows, stride) = (self.rows(), self.rows().next_multiple_of(every));
        let mut a = vec![0.0; rows * stride];
        for (to, row) in a.chunks_exact_mut(stride).zip(self.a.chunks_exact(rows)) {
            to[..rows].copy_from_slice(row);
        }
        let b = self.b.iter().map(|b| -b).collect();
        Raw { n: self.n, a, b, lo: self.lo.clone(), hi: self.hi.clone() }
    }

    /// Whether all rows are equations.
    pub fn is_unbounded(&self) -> bool {
        self.lo.iter().chain(&self.hi).all(|bound| bound.is_infinite())
    }

    /// The number of rows.
    pub fn rows(&self) -> usize {
        self.b.len()
    }

    /// A contender that calls this solver, with the meaning of its errors.
    pub fn contender<'a>(&'a self, name: &str, solver: Solver, meaning: &'a str) -> Contender<'a> {
        Contender::peer(name, move || {
            let (mut x, mut complaints) = (vec![0.0; self.rows()], 0);
            let [a, b, lo, hi] = [&self.a, &self.b, &self.lo, &self.hi].map(|v| v.as_ptr());
            // SAFETY: the shims read n² numbers of A and n of b, lo and hi, write n of x and one
            // number of errors, and keep no pointer.
            let seconds =
                unsafe { solver(self.n, a, b, lo, hi, x.as_mut_ptr(), &raw mut complaints) };
            let complaint = (complaints != 0).then(|| format!("{meaning} ({complaints})"));
            Run { seconds, x, complaint }
        })
    }
}
