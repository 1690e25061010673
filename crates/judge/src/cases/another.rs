//! Searches for a solution other than a known one, by the same case distinction.
//!
//! The x that satisfy the conditions of the sides chosen so far form a polyhedron. If it contains
//! no other point than the known solution, the case is closed. Another point is found by linear
//! programs that require x_i to be above or below the known x_i, for each row i. It is a solution,
//! or the tree branches at a row where it is none. The search is complete: it also finds
//! solutions on a segment that starts at the known one.
//!
//! A row with two bounds and no side restricts nothing but its x. Therefore the convex hull of its
//! three sides is added. With l ≤ w_i ≤ u for all x within the bounds, and h = hi_i − lo_i,
//!
//! ```text
//! h w_i ≤ max(u, 0) (hi_i − x_i),    h w_i ≥ min(l, 0) (x_i − lo_i).
//! ```

use super::{Cases, Dyadic, MOST_ROWS, Point, Side, Sides, System, dyadic, finite, integers};
use super::{program, whole};
use lcplab_lcp::Lcp;

/// The result of a search for another solution.
#[derive(Debug)]
pub enum Another {
    /// Another solution.
    Solution(Point),
    /// There is none.
    None,
}

/// Searches for a solution other than x; `None` if the problem has more than 24 rows, or if the
/// search needs more linear programs. x must be a solution.
///
/// ```
/// use lcplab_judge::cases::{Another, another};
/// use lcplab_lcp::exact::Point;
/// use lcplab_lcp::exact::dyadic::dyadic;
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // w = 1 − x: 0 and 1 are the solutions. w = 1 + x: 0 alone.
/// let lcp = |a| Lcp::new(Matrix::from([[a]]), vec![1.0], vec![0.0], vec![f64::INFINITY]);
/// let zero = Point::new(vec![dyadic(0.0)], dyadic(1.0));
/// let Some(Another::Solution(one)) = another(&lcp(-1.0)?, &zero, 100) else { panic!() };
/// assert_eq!(one.distance(&[1.0]), 0.0);
/// assert!(matches!(another(&lcp(1.0)?, &zero, 100), Some(Another::None)));
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn another(lcp: &Lcp, x: &Point, most_programs: usize) -> Option<Another> {
    if lcp.len() > MOST_ROWS {
        return None;
    }
    let mut programs = most_programs;
    Cases::new(lcp, 0.0).another(x, &mut vec![None; lcp.len()], &mut programs)
}

impl Cases<'_> {
    fn another(
        &self,
        known: &Point,
        sides: &mut Vec<Option<Side>>,
        programs: &mut usize,
    ) -> Option<Another> {
        *programs = programs.checked_sub(1)?;
        let system = self.hull(sides);
        let Ok(mut point) = system.point() else { return Some(Another::None) };
        if is_same(&point, known) {
            match self.other_point(known, &system, programs)? {
                Another::Solution(other) => point = other,
                Another::None => return Some(Another::None),
            }
        }
        let unsolved = (0..self.lcp.len()).filter(|&i| !self.is_solved(i, &point));
        // A row of few entries depends on few others.
        let Some(row) = unsolved.min_by_key(|&i| self.entries(i)) else {
            return Some(Another::Solution(point));
        };
        let [has_lo, has_hi] = finite(self.lcp, row);
        let ways = [(Side::Lower, has_lo), (Side::Free, true), (Side::Upper, has_hi)];
        for (side, _) in ways.into_iter().filter(|(_, is_there)| *is_there) {
            sides[row] = Some(side);
            let found = self.another(known, sides, programs)?;
            sides[row] = None;
            if let Another::Solution(_) = found {
                return Some(found);
            }
        }
        Some(Another::None)
    }

    /// The number of nonzero entries in a row of A.
    fn entries(&self, i: usize) -> usize {
        self.lcp.matrix().row(i).iter().filter(|&(_, a)| a != 0.0).count()
    }

    /// A point other than the known one that satisfies the system, as the known one does.
    fn other_point(&self, known: &Point, system: &System, programs: &mut usize) -> Option<Another> {
        for i in (0..self.lcp.len()).filter(|&i| !system.form.x[i].terms.is_empty()) {
            for sign in [Dyadic::ONE, -Dyadic::ONE] {
                *programs = programs.checked_sub(1)?;
                if let Some(point) = system.moved(known, i, &sign) {
                    return Some(Another::Solution(point));
                }
            }
        }
        Some(Another::None)
    }

    /// The conditions of the sides, and the convex hull of the sides of each row with two bounds
    /// that has none.
    fn hull(&self, sides: &Sides) -> System {
        let mut system = self.system(sides);
        let rows = (0..self.lcp.len()).filter(|&i| sides[i].is_none() && !self.lcp.is_coupled(i));
        for i in rows.filter(|&i| finite(self.lcp, i) == [true; 2]) {
            let Some((least, most)) = self.range_of_w(i, sides) else { continue };
            let [lo, hi] = [self.lcp.lo()[i], self.lcp.hi()[i]].map(dyadic);
            let (w, constant) = system.form.w(self.lcp, i);
            let x = system.form.x[i].clone();
            let h = &hi - &lo;
            // h w_i + slope x_i + offset, of this sign
            let mut put = |slope: Dyadic, offset: Dyadic, sign: i8| {
                let mut row: Vec<Dyadic> = w.iter().map(|factor| factor * &h).collect();
                x.terms.iter().for_each(|(u, factor)| row[*u] += factor * &slope);
                system.add(row, &h * &constant + &slope * &x.constant + offset, sign);
            };
            let most = most.max(Dyadic::ZERO);
            put(most.clone(), -(&most * &hi), -1);
            let least = least.min(Dyadic::ZERO);
            put(-least.clone(), &least * &lo, 1);
        }
        system
    }

    /// The range of w_i within the bounds; `None` if it has no end.
    fn range_of_w(&self, i: usize, sides: &Sides) -> Option<(Dyadic, Dyadic)> {
        let b = dyadic(self.lcp.b()[i]);
        let (mut least, mut most) = (b.clone(), b);
        for (j, a) in self.lcp.matrix().row(i).iter().filter(|&(_, a)| a != 0.0) {
            if self.lcp.is_coupled(j) {
                return None;
            }
            let (lo, hi) = match sides[j] {
                Some(Side::Lower) => (self.lcp.lo()[j], self.lcp.lo()[j]),
                Some(Side::Upper) => (self.lcp.hi()[j], self.lcp.hi()[j]),
                _ => (self.lcp.lo()[j], self.lcp.hi()[j]),
            };
            if !lo.is_finite() || !hi.is_finite() {
                return None;
            }
            let ends = [dyadic(a) * dyadic(lo), dyadic(a) * dyadic(hi)];
            least += ends[0].clone().min(ends[1].clone());
            most += ends[0].clone().max(ends[1].clone());
        }
        Some((least, most))
    }
}

impl System {
    /// Adds the condition that a function of the unknowns plus a constant is at least 0, if the
    /// sign is 1, or at most 0, if it is −1.
    fn add(&mut self, mut row: Vec<Dyadic>, constant: Dyadic, sign: i8) {
        let columns = self.columns();
        for own in &mut self.rows {
            own.insert(columns, Dyadic::ZERO);
        }
        row.resize(columns, Dyadic::ZERO);
        row.push(if sign > 0 { -Dyadic::ONE } else { Dyadic::ONE });
        row.push(-constant);
        self.rows.push(row);
    }

    /// A point with x_i above the known x_i if the sign is 1, and below if it is −1.
    ///
    /// The equations M y = r become M y = r t with a further unknown t ≥ 0, and
    /// ± (x_i(y, t) − t x*_i) = 1. For t > 0 the point is y / t; for t = 0, y is a direction in
    /// which the polyhedron has no end.
    fn moved(&self, known: &Point, i: usize, sign: &Dyadic) -> Option<Point> {
        let columns = self.columns();
        let homogeneous = |row: &Vec<Dyadic>| {
            let mut row = row.clone();
            row[columns] = -row[columns].clone();
            row.push(Dyadic::ZERO);
            row
        };
        let mut rows: Vec<Vec<Dyadic>> = self.rows.iter().map(homogeneous).collect();
        let mut own = vec![Dyadic::ZERO; columns + 2];
        let scale = sign * known.denominator();
        for (u, factor) in &self.form.x[i].terms {
            own[*u] += &scale * factor;
        }
        own[columns] = &scale * &self.form.x[i].constant - sign * known.scaled(i);
        own[columns + 1] = Dyadic::ONE;
        rows.push(own);
        let rows = rows.iter().map(|row| integers(row)).collect();
        let program::ProgramResult::Point(y, denominator) = program::solve(rows, columns + 1)
        else {
            return None;
        };
        let y: Vec<Dyadic> = y.into_iter().map(whole).collect();
        let t = &y[columns];
        if *t != Dyadic::ZERO {
            let x = self.form.x.iter().map(|x| x.scaled_at(&y, t)).collect();
            return Some(Point::new(x, t.clone()));
        }
        let denominator = whole(denominator);
        let entry = |(j, x): (usize, &super::Affine)| {
            known.scaled(j) * &denominator + x.scaled_at(&y, t) * known.denominator()
        };
        let x = self.form.x.iter().enumerate().map(entry).collect();
        Some(Point::new(x, known.denominator() * denominator))
    }
}

fn is_same(x: &Point, y: &Point) -> bool {
    (0..x.len()).all(|i| x.scaled(i) * y.denominator() == y.scaled(i) * x.denominator())
}
