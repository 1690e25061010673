//! Finds the sides of an exact solution by pivoting with 320-bit numbers.
//!
//! If contacts are redundant, A is singular up to rounding. Of the many x that balance the bodies,
//! the exact problem has one or a few, and the last digits of A decide which rows have w = 0 there:
//! double precision cannot resolve this. Therefore Lemke's method pivots with enough digits that
//! rounding decides nothing; the caller then checks the resulting sides in the exact problem.
//!
//! With x_i = lo_i + y_i, hi_i − y_i, or −μ_i x_k + y_i, rows with one bound are complementary
//! pairs y_i, v_i = ±w_i. A row with two bounds has a second pair: v_i = w_i + u_i, and u_i is
//! complementary to s_i, the distance of x_i from its upper bound. Rows without bounds are solved
//! first.

use dashu_float::FBig;
use dashu_float::round::mode::HalfEven;

use lcplab_lcp::Lcp;
use lcplab_lcp::exact::Side;

type Real = FBig<HalfEven, 2>;

/// Precision of the calculation (bits).
const BITS: usize = 320;
/// Numbers below 2 to this power, relative to the numbers of the problem, count as 0.
const ZERO: isize = -200;
/// The problem is perturbed by 2 to this power, times distinct factors, so that no two rows reach
/// their bounds at the same time.
/// bounds at once.
const CHANGE: isize = -150;
/// With more pairs pivoting takes minutes.
const MOST_PAIRS: usize = 240;

/// The sides of a solution, if Lemke's method finds one.
pub fn sides(lcp: &Lcp) -> Option<Vec<Side>> {
    let mut table = Table::of(lcp)?;
    table.solve_equations()?;
    table.lemke()?;
    Some((0..lcp.len()).map(|i| table.side(i)).collect())
}

fn real(x: f64) -> Real {
    Real::try_from(x + 0.0).expect("a finite number").with_precision(BITS).value()
}

fn power(exponent: isize) -> Real {
    Real::from_parts(1.into(), exponent).with_precision(BITS).value()
}

fn is_zero(x: &Real, unit: &Real) -> bool {
    let size = if *x < Real::ZERO { -x.clone() } else { x.clone() };
    size <= unit * power(ZERO)
}

/// The form of x_i as a function of y_i.
#[derive(Clone, Copy, PartialEq)]
enum Form {
    /// lo + y.
    Up,
    /// hi − y.
    Down,
    /// y, with w = 0.
    Equation,
    /// Between two bounds, with the index of its second pair.
    Between(usize),
}

/// A dictionary: every basic variable as a constant plus a linear combination of the nonbasic ones.
///
/// Pair p has the variables p (its y or u) and p + pairs (its v or s); the last variable is Lemke's
/// artificial variable.
struct Table {
    forms: Vec<Form>,
    pairs: usize,
    /// The coefficients of the nonbasic variables, then the constant.
    rows: Vec<Vec<Real>>,
    basic: Vec<usize>,
    other: Vec<usize>,
    /// The largest absolute entry of A.
    unit: Real,
}

impl Table {
    fn of(lcp: &Lcp) -> Option<Table> {
        let n = lcp.len();
        let mut pairs = n;
        let form = |i: usize| match (lcp.coupled_to(i), lcp.lo()[i], lcp.hi()[i]) {
            (None, f64::NEG_INFINITY, f64::INFINITY) => Form::Equation,
            (None, _, f64::INFINITY) => Form::Up,
            (None, f64::NEG_INFINITY, _) => Form::Down,
            _ => {
                pairs += 1;
                Form::Between(pairs - 1)
            }
        };
        let forms: Vec<Form> = (0..n).map(form).collect();
        if pairs > MOST_PAIRS {
            return None;
        }
        // x_j = start_j + Σ factor y
        let start = |j: usize| match (lcp.coupled_to(j), forms[j]) {
            (Some((k, mu)), _) => -real(mu) * real(lcp.lo()[k]),
            (None, Form::Equation) => real(0.0),
            (None, Form::Down) => real(lcp.hi()[j]),
            (None, _) => real(lcp.lo()[j]),
        };
        let factors = |j: usize| match (lcp.coupled_to(j), forms[j]) {
            (Some((k, mu)), _) => vec![(j, real(1.0)), (k, -real(mu))],
            (None, Form::Down) => vec![(j, real(-1.0))],
            (None, _) => vec![(j, real(1.0))],
        };
        let mut rows = vec![vec![real(0.0); pairs + 1]; pairs];
        let mut unit = real(0.0);
        for i in 0..n {
            rows[i][pairs] = real(lcp.b()[i]);
            for (j, a) in lcp.matrix().row(i).iter().filter(|(_, a)| *a != 0.0) {
                rows[i][pairs] += real(a) * start(j);
                for (y, factor) in factors(j) {
                    rows[i][y] += real(a) * factor;
                }
                unit = unit.max(real(a.abs()));
            }
            if forms[i] == Form::Down {
                rows[i].iter_mut().for_each(|value| *value = -value.clone());
            }
            if let Form::Between(p) = forms[i] {
                rows[i][p] = real(1.0);
                rows[p][i] = real(-1.0);
                match lcp.coupled_to(i) {
                    Some((k, mu)) => {
                        rows[p][k] = real(2.0) * real(mu);
                        rows[p][pairs] = real(2.0) * real(mu) * real(lcp.lo()[k]);
                    }
                    None => rows[p][pairs] = real(lcp.hi()[i]) - real(lcp.lo()[i]),
                }
            }
        }
        let (basic, other) = ((pairs..2 * pairs).collect(), (0..pairs).collect());
        Some(Table { forms, pairs, rows, basic, other, unit })
    }

    /// Exchanges the basic variable of row r with the nonbasic one of column c.
    fn pivot(&mut self, r: usize, c: usize) {
        let mut own = std::mem::take(&mut self.rows[r]);
        let inverse = real(1.0) / &own[c];
        own[c] = real(-1.0);
        own.iter_mut().for_each(|value| *value = -(&*value * &inverse));
        for row in self.rows.iter_mut().filter(|row| !row.is_empty()) {
            let factor = std::mem::replace(&mut row[c], real(0.0));
            if factor == Real::ZERO {
                continue;
            }
            for (value, own) in row.iter_mut().zip(&own) {
                if *own != Real::ZERO {
                    *value += &factor * own;
                }
            }
        }
        self.rows[r] = own;
        std::mem::swap(&mut self.basic[r], &mut self.other[c]);
    }

    /// Moves the y of all equations into the basis, largest pivot first, and removes the columns of
    /// their v, which are 0.
    fn solve_equations(&mut self) -> Option<()> {
        let mut open: Vec<usize> =
            (0..self.forms.len()).filter(|&i| self.forms[i] == Form::Equation).collect();
        let (mut rows, count) = (open.clone(), open.len());
        for _ in 0..count {
            let size = |r: usize, c: usize| {
                let value = &self.rows[r][c];
                if *value < Real::ZERO { -value.clone() } else { value.clone() }
            };
            let places = rows.iter().flat_map(|&r| open.iter().map(move |&c| (r, c)));
            let (r, c) = places.reduce(|best, new| {
                if size(new.0, new.1) > size(best.0, best.1) { new } else { best }
            })?;
            if is_zero(&self.rows[r][c], &self.unit) {
                // Equations that depend on each other.
                return None;
            }
            self.pivot(r, c);
            rows.retain(|&row| row != r);
            open.retain(|&column| column != c);
        }
        let gone: Vec<usize> = (0..self.other.len())
            .filter(|&c| self.other[c] >= self.pairs && self.is_equation(self.other[c]))
            .collect();
        for &c in gone.iter().rev() {
            self.other.remove(c);
            self.rows.iter_mut().for_each(|row| drop(row.remove(c)));
        }
        Some(())
    }

    /// Whether a variable belongs to an equation: its y is unrestricted and its v is 0.
    fn is_equation(&self, variable: usize) -> bool {
        // Not Lemke's artificial variable.
        let is_of_a_pair = variable < 2 * self.pairs;
        is_of_a_pair && self.forms.get(variable % self.pairs) == Some(&Form::Equation)
    }

    /// Lemke's method with a covering vector of ones; `None` if it ends on a ray.
    fn lemke(&mut self) -> Option<()> {
        let rows: Vec<usize> =
            (0..self.rows.len()).filter(|&r| !self.is_equation(self.basic[r])).collect();
        let last = self.other.len();
        let most = rows
            .iter()
            .map(|&r| self.rows[r][last].clone())
            .map(|q| if q < Real::ZERO { -q } else { q })
            .max();
        let change = most.unwrap_or(real(1.0)) * power(CHANGE);
        for &r in &rows {
            // distinct factors between 1 and 2: the fractional parts of multiples of the golden
            // section
            let factor = 1.0 + (0.618_033_988_749_894_9 * (r + 1) as f64).fract();
            self.rows[r][last] += &change * real(factor);
        }
        let cover = 2 * self.pairs;
        self.other.push(cover);
        for (r, row) in self.rows.iter_mut().enumerate() {
            row.insert(last, real(if rows.contains(&r) { 1.0 } else { 0.0 }));
        }
        let constant = last + 1;
        let lowest = rows
            .iter()
            .copied()
            .min_by(|&r, &k| self.rows[r][constant].cmp(&self.rows[k][constant]))?;
        if self.rows[lowest][constant] >= Real::ZERO {
            return Some(());
        }
        let mut entering = self.partner(self.basic[lowest]);
        self.pivot(lowest, last);
        for _ in 0..50 * self.pairs {
            let c = self.other.iter().position(|&variable| variable == entering)?;
            // The rows that decrease as the entering variable increases, each with its ratio.
            let falls = |r: &usize| {
                let value = &self.rows[*r][c];
                *value < Real::ZERO && !is_zero(value, &self.unit)
            };
            let ratio = |r: usize| -(&self.rows[r][constant] / &self.rows[r][c]);
            let all = (0..self.rows.len()).filter(|&r| !self.is_equation(self.basic[r]));
            let leaving = all.filter(falls).map(|r| (ratio(r), r)).min_by(|p, q| p.0.cmp(&q.0))?.1;
            let variable = self.basic[leaving];
            self.pivot(leaving, c);
            if variable == cover {
                return Some(());
            }
            entering = self.partner(variable);
        }
        None
    }

    fn partner(&self, variable: usize) -> usize {
        if variable < self.pairs { variable + self.pairs } else { variable - self.pairs }
    }

    /// The side of row i.
    fn side(&self, i: usize) -> Side {
        let is_basic = |variable: usize| self.basic.contains(&variable);
        match self.forms[i] {
            Form::Equation => Side::Free,
            // u > 0
            Form::Between(p) if is_basic(p) => Side::Upper,
            Form::Down if !is_basic(i) => Side::Upper,
            _ if !is_basic(i) => Side::Lower,
            _ => Side::Free,
        }
    }
}
