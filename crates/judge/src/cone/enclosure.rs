//! A box around x that contains a solution, by Krawczyk's test in exact arithmetic.
//!
//! In the box |x − c| ≤ r the map N(x) = x − C F(x), with any matrix C, moves no point farther from
//! c than
//!
//! ```text
//! |C F(c)| + |I − C F'(c)| r + 2 |C| q(r)          |Q(d)| ≤ q(r) for |d| ≤ r
//! ```
//!
//! If that is below r in every entry, N maps the box into itself and is a contraction, so it has
//! exactly one fixed point there, and C is regular: F = 0 at this point and at no other one of the
//! box (Krawczyk 1969, Moore 1977; for polynomials of degree two without interval derivatives).
//! If the inequalities of all states hold in the whole box, that point solves the problem.

use dashu_int::ops::Abs;

use super::newton;
use super::redundant::{self, Dependence};
use super::state::RowState;
use super::system::{AtPoint, Numbers, System};
use lcplab_lcp::Gauss;
use lcplab_lcp::exact::dyadic::{Dyadic, dyadic, rational};
use lcplab_lcp::exact::{Point, rounded_up};
use lcplab_lcp::friction::ConeProblem;

/// A box that contains exactly one solution with these states and, if rows are redundant, with
/// their x.
#[derive(Debug, Clone)]
pub struct Enclosure {
    /// The state of each row.
    pub states: Vec<RowState>,
    /// The equations w_i = 0 that follow from others; their rows have the x of the center.
    pub redundant: Vec<Dependence>,
    /// The solution is one for a bias that differs from that of the bodies by at most this in each
    /// redundant row, in the unit of w: rounding can make the bias of redundant rows inconsistent.
    /// 0 if the problem is that of A and b.
    pub bias_change: f64,
    /// c.
    pub center: Point,
    /// r times the denominator of c: one entry per row, 0 in rows whose x is given.
    pub radius: Vec<Dyadic>,
    /// C: an approximate inverse of F'(c), one row and one column per unknown.
    pub inverse: Vec<Vec<f64>>,
}

impl Enclosure {
    /// The box of this half-width around x in these states, then its image under Krawczyk's
    /// operator, the image of that, and so on. An image contains every solution of its box; if the
    /// [check](Self::check) of the first box succeeds, its image lies inside it.
    ///
    /// # Errors
    /// If a row cannot have its state, or if F' is singular at the center of a box.
    ///
    /// # Panics
    /// If x or the half-width is not finite.
    ///
    /// ```
    /// use lcplab_judge::{Enclosure, RowState};
    /// use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law};
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// // A unit mass pressed with 2 N s and pushed with 3 N s, μ = ½: x = (2, 1, 0).
    /// let a = Matrix::dense(3, &[1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]);
    /// let (lo, hi) = (vec![0.0, -f64::INFINITY, -f64::INFINITY], vec![f64::INFINITY; 3]);
    /// let lcp = Lcp::new(a, vec![-2.0, -3.0, 0.0], lo, hi)?;
    /// let friction = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
    /// let problem = ConeProblem::new(friction, Law::Coulomb);
    /// let around = |x: [f64; 3], radius: f64| {
    ///     Enclosure::images(&problem, vec![RowState::Slides; 3], &x, radius, 7).unwrap()
    /// };
    /// let boxes = around([2.0, 1.01, 0.01], 0.1);
    /// assert_eq!(boxes[0].check(&problem), Ok(()));
    /// assert!(boxes[6].distance(&[2.0, 1.0, 0.0]) < 1e-30);
    /// assert!(around([2.0, 1.01, 0.01], 2.0)[0].check(&problem).is_err()); // too wide
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn images(
        problem: &ConeProblem,
        states: Vec<RowState>,
        x: &[f64],
        radius: f64,
        count: usize,
    ) -> Result<Vec<Self>, String> {
        let numbers = Numbers::of(problem);
        let system = System::new(problem, &numbers, states)?;
        let one = dyadic(1.0);
        let mut center: Vec<Dyadic> =
            (0..x.len()).map(|i| system.given(i).unwrap_or_else(|| dyadic(x[i]))).collect();
        let mut radius: Vec<Dyadic> =
            (0..x.len()).map(|i| dyadic(if system.is_unknown(i) { radius } else { 0.0 })).collect();
        let mut boxes = Vec::new();
        while boxes.len() < count {
            let at = system.at(&center, &one);
            let inverse = newton::inverse_at(&system, &at).ok_or("F' is singular at the center")?;
            let test = Krawczyk::new(&system, &at, &inverse);
            let image = test.shift.iter().zip(test.spread(&system, &radius));
            let (mut next, mut spread) = (center.clone(), radius.clone());
            for (&i, (shift, width)) in system.unknowns().iter().zip(image) {
                next[i] -= shift;
                spread[i] = width;
            }
            boxes.push(Enclosure {
                states: system.states().to_vec(),
                redundant: Vec::new(),
                bias_change: 0.0,
                center: Point::new(std::mem::replace(&mut center, next), one.clone()),
                radius: std::mem::replace(&mut radius, spread),
                inverse,
            });
        }
        Ok(boxes)
    }

    /// Checks that the box contains exactly one solution of its states.
    ///
    /// # Errors
    /// Why that is not shown.
    pub fn check(&self, problem: &ConeProblem) -> Result<(), String> {
        match self.bias_change {
            0.0 => self.check_numbers(problem, &Numbers::of(problem)),
            _ => Err("the bias may change only if the box is about bodies".into()),
        }
    }

    /// Checks that the box contains exactly one solution for the exact numbers of the bodies, up to
    /// the change of the bias: its first entries are those of x, the others those of the motion u.
    ///
    /// # Errors
    /// Why that is not shown.
    pub fn check_bodies(&self, problem: &ConeProblem, bodies: &Gauss) -> Result<(), String> {
        self.check_numbers(problem, &Numbers::of_bodies(problem, bodies))
    }

    fn check_numbers(&self, problem: &ConeProblem, numbers: &Numbers) -> Result<(), String> {
        let system = System::new(problem, numbers, self.states.clone())?;
        let redundant = redundant::check(&system, &self.redundant, self.bias_change)?;
        let system = system.without(&redundant);
        let n = self.states.len();
        if self.center.len() != n || self.radius.len() != n {
            return Err(format!("the box does not have {n} entries"));
        }
        let x: Vec<Dyadic> = (0..n).map(|i| self.center.scaled(i).clone()).collect();
        let d = self.center.denominator();
        for i in 0..n {
            let given = system.given(i);
            if system.is_unknown(i) == (self.radius[i] == Dyadic::ZERO) {
                return Err(format!("the radius of row {i} does not belong to its state"));
            }
            if given.is_some_and(|given| given * d != x[i]) || self.radius[i] < Dyadic::ZERO {
                return Err(format!("x of row {i} does not belong to its state"));
            }
        }
        let m = system.unknowns().len();
        if self.inverse.len() != m || self.inverse.iter().any(|row| row.len() != m) {
            return Err(format!("the matrix is not {m} × {m}"));
        }
        let at = system.at(&x, d);
        if !Krawczyk::new(&system, &at, &self.inverse).is_contained(&system, &at, &self.radius) {
            return Err("the box is not mapped into itself".into());
        }
        system.check_inequalities(&at, &self.radius)
    }

    /// The largest |x_i − y_i| of any y in the box, rounded up.
    pub fn distance(&self, x: &[f64]) -> f64 {
        let most = self.distances(x).max().unwrap_or(Dyadic::ZERO);
        rounded_up(&(rational(&most) / rational(self.center.denominator())))
    }

    /// Whether every |x_i − y_i| is at most the bound of its row.
    pub(super) fn is_within(&self, x: &[f64], bounds: &[f64]) -> bool {
        let d = self.center.denominator();
        self.distances(x).zip(bounds).all(|(most, &bound)| most <= dyadic(bound) * d)
    }

    /// The largest |x_i − y_i| of any y in the box, times the denominator.
    fn distances<'a>(&'a self, x: &'a [f64]) -> impl Iterator<Item = Dyadic> + 'a {
        x.iter().enumerate().map(|(i, &x)| {
            let miss = self.center.scaled(i) - dyadic(x) * self.center.denominator();
            miss.abs() + &self.radius[i]
        })
    }
}

/// The parts of the test that do not depend on the radius.
pub(super) struct Krawczyk {
    /// C F(c).
    shift: Vec<Dyadic>,
    /// |I − C F'(c)|.
    remainder: Vec<Vec<Dyadic>>,
    /// |C|.
    inverse: Vec<Vec<Dyadic>>,
}

impl Krawczyk {
    pub fn new(system: &System<'_>, at: &AtPoint<'_>, inverse: &[Vec<f64>]) -> Self {
        let exact = |row: &Vec<f64>| row.iter().map(|&c| dyadic(c)).collect::<Vec<_>>();
        let inverse: Vec<Vec<Dyadic>> = inverse.iter().map(exact).collect();
        let (values, derivatives) = (system.values(at), system.derivatives(at));
        let dot =
            |row: &[Dyadic]| row.iter().zip(&values).fold(Dyadic::ZERO, |sum, (c, f)| sum + c * f);
        let remainder = |(i, row): (usize, &Vec<Dyadic>)| {
            let mut left = vec![Dyadic::ZERO; row.len()];
            left[i] = at.d.clone();
            for (c, derivative) in row.iter().zip(&derivatives) {
                for (left, f) in left.iter_mut().zip(derivative) {
                    if *f != Dyadic::ZERO {
                        *left -= c * f;
                    }
                }
            }
            left.into_iter().map(Abs::abs).collect()
        };
        Krawczyk {
            shift: inverse.iter().map(|row| dot(row)).collect(),
            remainder: inverse.iter().enumerate().map(remainder).collect(),
            inverse: inverse
                .into_iter()
                .map(|row| row.into_iter().map(Abs::abs).collect())
                .collect(),
        }
    }

    /// The largest distance from c of an image of the box, times D².
    pub fn image(&self, system: &System<'_>, r: &[Dyadic]) -> Vec<Dyadic> {
        let spread = self.spread(system, r).into_iter();
        spread.zip(&self.shift).map(|(spread, shift)| shift.clone().abs() + spread).collect()
    }

    /// The radius of the image, whose center is c − C F(c), times D².
    fn spread(&self, system: &System<'_>, r: &[Dyadic]) -> Vec<Dyadic> {
        let curvature = system.curvature(r);
        let row = |i: usize| {
            let columns = self.remainder[i].iter().zip(system.unknowns());
            let linear = columns.fold(Dyadic::ZERO, |sum, (part, &j)| sum + part * &r[j]);
            let products = self.inverse[i].iter().zip(&curvature);
            let curved = products.fold(Dyadic::ZERO, |sum, (c, q)| sum + c * q);
            linear + (curved << 1)
        };
        (0..self.shift.len()).map(row).collect()
    }

    pub(crate) fn is_contained(&self, system: &System<'_>, at: &AtPoint<'_>, r: &[Dyadic]) -> bool {
        let image = self.image(system, r);
        image.iter().zip(system.unknowns()).all(|(image, &i)| *image < &r[i] * at.d)
    }
}
