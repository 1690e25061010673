//! The equations of a cone problem once every contact has a state.
//!
//! The unknowns are the x of free rows and of contacts that stick or slide; all others are 0 or a
//! bound. Each unknown x_i has one equation:
//!
//! ```text
//! free, sticks                       w_i = 0
//! slides, n                          w_n = 0 (Coulomb), x_n w_n + x_t·w_t = 0 (associated)
//! slides, t1                         x_t1² + x_t2² − μ² x_n² = 0
//! slides, t2                         x_t1 w_t2 − x_t2 w_t1 = 0
//! slides without friction, n         w_n = 0
//! ```
//!
//! All are polynomials of degree two at most, so F(c + d) = F(c) + F'(c) d + Q(d) exactly. All
//! values at a point are homogeneous: x, w and the radii are multiplied by the point's denominator
//! D, F and Q by D², F' by D.
//!
//! With redundant contacts some of the equations w_i = 0 follow from others. These are left out,
//! and their x_i are given.
//!
//! A = J M⁻¹Jᵀ + diag(γ) is rounded, which hides redundancy. Therefore a system can also be about
//! the exact numbers of the bodies, with the motion u as further unknowns after x:
//!
//! ```text
//! w = J u + bias + γ x,   M (u − u*) − Jᵀx = 0
//! ```

use std::collections::BTreeMap;

use dashu_int::ops::Abs;

use super::state::RowState;
use lcplab_lcp::Gauss;
use lcplab_lcp::exact::dyadic::{Dyadic, dyadic};
use lcplab_lcp::friction::{ConeProblem, Contact, Law};

/// The equations of a cone problem in given states.
#[derive(Clone)]
pub(super) struct System<'a> {
    problem: &'a ConeProblem,
    numbers: &'a Numbers,
    states: Vec<RowState>,
    /// The unknown rows, ascending.
    unknowns: Vec<usize>,
    /// The position of each row among the unknowns.
    position: Vec<Option<usize>>,
    /// The equation of each unknown.
    equations: Vec<Equation>,
    /// The rows whose equation w_i = 0 is left out, ascending; their x is given.
    redundant: Vec<usize>,
}

/// A problem's numbers as exact fractions.
pub(super) struct Numbers {
    pub a: Vec<Vec<(usize, Dyadic)>>,
    pub b: Vec<Dyadic>,
    /// The number of rows with a bias: the rows of a motion, which come last, have none.
    pub biased: usize,
    lo: Vec<Option<Dyadic>>,
    hi: Vec<Option<Dyadic>>,
    /// The rows that belong to no contact.
    others: Vec<usize>,
}

/// An equation; the number is that of the contact.
#[derive(Clone, Copy)]
enum Equation {
    /// w_i = 0.
    Still(usize),
    /// x_n w_n + x_t·w_t = 0.
    Power(usize),
    /// |x_t|² = μ² x_n².
    Limit(usize),
    /// x_t and w_t are parallel.
    Parallel(usize),
}

/// A point: x and w times its denominator d.
pub(super) struct AtPoint<'a> {
    pub x: &'a [Dyadic],
    pub d: &'a Dyadic,
    pub w: Vec<Dyadic>,
}

impl Numbers {
    pub fn of(problem: &ConeProblem) -> Self {
        let lcp = problem.friction().lcp();
        let row = |i: usize| lcp.matrix().row(i).iter().filter(|&(_, a)| a != 0.0);
        let finite = |bound: &f64| bound.is_finite().then(|| dyadic(*bound));
        Numbers {
            a: (0..lcp.len()).map(|i| row(i).map(|(j, a)| (j, dyadic(a))).collect()).collect(),
            b: lcp.b().iter().map(|&b| dyadic(b)).collect(),
            biased: lcp.len(),
            lo: lcp.lo().iter().map(finite).collect(),
            hi: lcp.hi().iter().map(finite).collect(),
            others: problem.friction().others().to_vec(),
        }
    }

    /// The problem of the bodies: after the n rows of x come the k rows of u, which have no bounds.
    pub fn of_bodies(problem: &ConeProblem, bodies: &Gauss) -> Self {
        let Numbers { lo, hi, mut others, .. } = Numbers::of(problem);
        let (n, k) = (bodies.jacobian.len(), bodies.target.len());
        let mut a = vec![BTreeMap::new(); n + k];
        let mut b: Vec<Dyadic> = bodies.bias.iter().map(|&bias| dyadic(bias)).collect();
        b.resize(n + k, Dyadic::ZERO);
        for (i, row) in bodies.jacobian.iter().enumerate() {
            a[i].insert(i, dyadic(bodies.compliance[i]));
            for &(j, value) in row {
                a[i].insert(n + j, dyadic(value));
                a[n + j].insert(i, dyadic(-value));
            }
        }
        let target = |j: usize| dyadic(bodies.target[j]);
        for &(i, j, mass) in &bodies.mass {
            a[n + i].insert(n + j, dyadic(mass));
            a[n + j].insert(n + i, dyadic(mass));
            b[n + i] -= dyadic(mass) * target(j);
            if i != j {
                b[n + j] -= dyadic(mass) * target(i);
            }
        }
        others.extend(n..n + k);
        let nonzero = |row: BTreeMap<usize, Dyadic>| {
            row.into_iter().filter(|(_, a)| *a != Dyadic::ZERO).collect()
        };
        let without_bounds = |mut bounds: Vec<Option<Dyadic>>| {
            bounds.resize(n + k, None);
            bounds
        };
        Numbers {
            a: a.into_iter().map(nonzero).collect(),
            b,
            biased: n,
            lo: without_bounds(lo),
            hi: without_bounds(hi),
            others,
        }
    }
}

impl<'a> System<'a> {
    /// The system of these states.
    ///
    /// # Errors
    /// If a row cannot have its state.
    pub fn new(
        problem: &'a ConeProblem,
        numbers: &'a Numbers,
        states: Vec<RowState>,
    ) -> Result<Self, String> {
        let n = numbers.b.len();
        if states.len() != n {
            return Err(format!("{} states, the problem has {n} rows", states.len()));
        }
        let mut equations: Vec<Option<Equation>> = vec![None; n];
        for &i in &numbers.others {
            let has_bound = match states[i] {
                RowState::Lower => numbers.lo[i].is_some(),
                RowState::Upper => numbers.hi[i].is_some(),
                RowState::Free => true,
                _ => return Err(format!("row {i} belongs to no contact")),
            };
            if !has_bound {
                return Err(format!("row {i} has no such bound"));
            }
            equations[i] = (states[i] == RowState::Free).then_some(Equation::Still(i));
        }
        for (c, contact) in problem.friction().contacts().iter().enumerate() {
            let [n, t1, t2] = contact.rows;
            let state = states[n];
            if states[t1] != state || states[t2] != state {
                return Err(format!("the rows of the contact of row {n} have different states"));
            }
            let of_normal = match problem.law() {
                Law::Coulomb => Equation::Still(n),
                Law::Associated => Equation::Power(c),
            };
            let own = match state {
                RowState::Open => [None; 3],
                RowState::Sticks if contact.mu > 0.0 => contact.rows.map(Equation::Still).map(Some),
                RowState::Slides if contact.mu > 0.0 => {
                    [of_normal, Equation::Limit(c), Equation::Parallel(c)].map(Some)
                }
                RowState::Slides => [Some(Equation::Still(n)), None, None],
                _ => return Err(format!("the contact of row {n} cannot have this state")),
            };
            contact.rows.iter().zip(own).for_each(|(&i, equation)| equations[i] = equation);
        }
        let unknowns: Vec<usize> = (0..n).filter(|&i| equations[i].is_some()).collect();
        let mut position = vec![None; n];
        unknowns.iter().enumerate().for_each(|(k, &i)| position[i] = Some(k));
        let (equations, redundant) = (equations.into_iter().flatten().collect(), Vec::new());
        Ok(System { problem, numbers, states, unknowns, position, equations, redundant })
    }

    /// The rows with the equation w_i = 0, ascending.
    pub fn still(&self) -> Vec<usize> {
        let still = self.equations.iter().filter_map(|equation| match *equation {
            Equation::Still(i) => Some(i),
            _ => None,
        });
        still.collect()
    }

    /// The system without the equations w_i = 0 of these rows, whose x is then given.
    #[must_use]
    pub fn without(mut self, rows: &[usize]) -> Self {
        let kept = |i: &usize| !rows.contains(i);
        let pairs = self.unknowns.into_iter().zip(self.equations).filter(|(i, _)| kept(i));
        (self.unknowns, self.equations) = pairs.unzip();
        self.position.fill(None);
        for (k, &i) in self.unknowns.iter().enumerate() {
            self.position[i] = Some(k);
        }
        self.redundant = rows.to_vec();
        self
    }

    pub fn numbers(&self) -> &'a Numbers {
        self.numbers
    }

    pub fn states(&self) -> &[RowState] {
        &self.states
    }

    pub fn contacts(&self) -> &[Contact] {
        self.problem.friction().contacts()
    }

    /// The unknown rows, ascending.
    pub fn unknowns(&self) -> &[usize] {
        &self.unknowns
    }

    pub fn lo(&self, i: usize) -> Option<&Dyadic> {
        self.numbers.lo[i].as_ref()
    }

    pub fn hi(&self, i: usize) -> Option<&Dyadic> {
        self.numbers.hi[i].as_ref()
    }

    /// Whether a row's bounds are equal.
    pub fn is_fixed(&self, i: usize) -> bool {
        self.lo(i).is_some() && self.lo(i) == self.hi(i)
    }

    pub fn is_unknown(&self, i: usize) -> bool {
        self.position[i].is_some()
    }

    /// The value that the states give to a row; `None` for unknown and for redundant rows.
    pub fn given(&self, i: usize) -> Option<Dyadic> {
        match (self.position[i], self.states[i]) {
            (Some(_), _) => None,
            _ if self.redundant.contains(&i) => None,
            (None, RowState::Lower) => self.numbers.lo[i].clone(),
            (None, RowState::Upper) => self.numbers.hi[i].clone(),
            (None, _) => Some(Dyadic::ZERO),
        }
    }

    pub fn at<'p>(&self, x: &'p [Dyadic], d: &'p Dyadic) -> AtPoint<'p> {
        let w = |(row, b): (&Vec<(usize, Dyadic)>, &Dyadic)| {
            row.iter().fold(b * d, |sum, (j, a)| sum + a * &x[*j])
        };
        AtPoint { x, d, w: self.numbers.a.iter().zip(&self.numbers.b).map(w).collect() }
    }

    /// F.
    pub fn values(&self, at: &AtPoint<'_>) -> Vec<Dyadic> {
        let AtPoint { x, d, w } = at;
        let value = |equation: &Equation| match *equation {
            Equation::Still(i) => &w[i] * *d,
            Equation::Power(c) => {
                self.contacts()[c].rows.iter().fold(Dyadic::ZERO, |sum, &i| sum + &x[i] * &w[i])
            }
            Equation::Limit(c) => {
                let ([n, t1, t2], mu) = self.contact(c);
                let limit = mu * &x[n];
                &x[t1] * &x[t1] + &x[t2] * &x[t2] - &limit * &limit
            }
            Equation::Parallel(c) => {
                let ([_, t1, t2], _) = self.contact(c);
                &x[t1] * &w[t2] - &x[t2] * &w[t1]
            }
        };
        self.equations.iter().map(value).collect()
    }

    /// F', one row per equation, one column per unknown.
    pub fn derivatives(&self, at: &AtPoint<'_>) -> Vec<Vec<Dyadic>> {
        let AtPoint { x, d, w } = at;
        let derivative = |equation: &Equation| {
            let mut row = vec![Dyadic::ZERO; self.unknowns.len()];
            match *equation {
                Equation::Still(i) => self.add_row(&mut row, i, d),
                Equation::Power(c) => {
                    for i in self.contacts()[c].rows {
                        self.add_row(&mut row, i, &x[i]);
                        self.add(&mut row, i, w[i].clone());
                    }
                }
                Equation::Limit(c) => {
                    let ([n, t1, t2], mu) = self.contact(c);
                    self.add(&mut row, n, -(&mu * &mu * &x[n]) << 1);
                    self.add(&mut row, t1, x[t1].clone() << 1);
                    self.add(&mut row, t2, x[t2].clone() << 1);
                }
                Equation::Parallel(c) => {
                    let ([_, t1, t2], _) = self.contact(c);
                    self.add_row(&mut row, t2, &x[t1]);
                    self.add_row(&mut row, t1, &-x[t2].clone());
                    self.add(&mut row, t1, w[t2].clone());
                    self.add(&mut row, t2, -w[t1].clone());
                }
            }
            row
        };
        self.equations.iter().map(derivative).collect()
    }

    /// Bounds on |Q(d)| for |d| ≤ r, with one radius per row.
    pub fn curvature(&self, r: &[Dyadic]) -> Vec<Dyadic> {
        let bound = |equation: &Equation| match *equation {
            Equation::Still(_) => Dyadic::ZERO,
            Equation::Power(c) => {
                let rows = self.contacts()[c].rows.into_iter();
                rows.fold(Dyadic::ZERO, |sum, i| sum + &r[i] * self.spread(i, r))
            }
            Equation::Limit(c) => {
                let ([n, t1, t2], mu) = self.contact(c);
                let limit = mu * &r[n];
                &r[t1] * &r[t1] + &r[t2] * &r[t2] + &limit * &limit
            }
            Equation::Parallel(c) => {
                let ([_, t1, t2], _) = self.contact(c);
                &r[t1] * self.spread(t2, r) + &r[t2] * self.spread(t1, r)
            }
        };
        self.equations.iter().map(bound).collect()
    }

    /// (|A| r)_i: how much w_i can change.
    pub fn spread(&self, i: usize, r: &[Dyadic]) -> Dyadic {
        self.numbers.a[i].iter().fold(Dyadic::ZERO, |sum, (j, a)| sum + a.clone().abs() * &r[*j])
    }

    /// Whether an open contact must close: w_n < 0, or under the associated law w_n < μ |w_t|.
    pub(crate) fn is_pressed(&self, contact: &Contact, at: &AtPoint<'_>) -> bool {
        let [n, t1, t2] = contact.rows.map(|i| &at.w[i]);
        let mu = dyadic(contact.mu);
        let is_outside = || n * n < &mu * &mu * (t1 * t1 + t2 * t2);
        *n < Dyadic::ZERO || self.problem.law() == Law::Associated && is_outside()
    }

    /// Whether |x_t| > μ x_n.
    pub fn is_outside(&self, contact: &Contact, at: &AtPoint<'_>) -> bool {
        let [n, t1, t2] = contact.rows.map(|i| &at.x[i]);
        let limit = dyadic(contact.mu) * n;
        t1 * t1 + t2 * t2 > &limit * &limit
    }

    /// Checks the inequalities of all rows at every point with |x − c| ≤ r.
    ///
    /// # Errors
    /// The row whose inequality fails.
    pub(crate) fn check_inequalities(&self, at: &AtPoint<'_>, r: &[Dyadic]) -> Result<(), String> {
        let AtPoint { x, d, w } = at;
        for &i in &self.numbers.others {
            let holds = match self.states[i] {
                RowState::Lower => w[i] >= self.spread(i, r),
                RowState::Upper => -&w[i] >= self.spread(i, r),
                _ => {
                    self.lo(i).is_none_or(|lo| &x[i] - &r[i] >= lo * *d)
                        && self.hi(i).is_none_or(|hi| &x[i] + &r[i] <= hi * *d)
                }
            };
            if !holds {
                return Err(format!("row {i} violates an inequality of its state"));
            }
        }
        for contact in self.contacts() {
            if !self.contact_holds(contact, at, r) {
                let n = contact.rows[0];
                return Err(format!("the contact of row {n} violates an inequality of its state"));
            }
        }
        Ok(())
    }

    fn contact_holds(&self, contact: &Contact, at: &AtPoint<'_>, r: &[Dyadic]) -> bool {
        let (mu, zero) = (dyadic(contact.mu), Dyadic::ZERO);
        let rows @ [n, t1, t2] = contact.rows;
        let length = |most: [Dyadic; 2]| &most[0] * &most[0] + &most[1] * &most[1];
        let least = &at.x[n] - &r[n];
        match self.states[n] {
            RowState::Open => {
                let least = &at.w[n] - self.spread(n, r);
                let slip = || length([t1, t2].map(|i| at.w[i].clone().abs() + self.spread(i, r)));
                least >= zero
                    && (self.problem.law() == Law::Coulomb || &least * &least >= &mu * &mu * slip())
            }
            RowState::Sticks => {
                let friction = length([t1, t2].map(|i| at.x[i].clone().abs() + &r[i]));
                let limit = &mu * &least;
                least >= zero && friction <= &limit * &limit
            }
            RowState::Slides if contact.mu == 0.0 => least >= zero,
            _ => {
                let power = rows[1..].iter().fold(zero.clone(), |sum, &i| {
                    let spread = self.spread(i, r);
                    let most = at.x[i].clone().abs() * &spread
                        + at.w[i].clone().abs() * &r[i]
                        + &spread * &r[i];
                    sum + &at.x[i] * &at.w[i] + most
                });
                least > zero && power <= zero
            }
        }
    }

    fn contact(&self, c: usize) -> ([usize; 3], Dyadic) {
        let contact = &self.contacts()[c];
        (contact.rows, dyadic(contact.mu))
    }

    /// Adds factor · (row i of A) to a row of F'.
    fn add_row(&self, row: &mut [Dyadic], i: usize, factor: &Dyadic) {
        for (j, a) in &self.numbers.a[i] {
            self.add(row, *j, a * factor);
        }
    }

    fn add(&self, row: &mut [Dyadic], j: usize, value: Dyadic) {
        if let Some(k) = self.position[j] {
            row[k] += value;
        }
    }
}
