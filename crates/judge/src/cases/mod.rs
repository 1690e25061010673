//! Proves by case distinction that no solution exists: a tree of sides, with a vector at each leaf.
//!
//! Each row of a solution is at its lower side (x_i = lo_i, w_i ≥ 0), free (w_i = 0) or at its
//! upper side. A linear program in exact arithmetic decides whether some x satisfies the conditions
//! of all sides chosen so far. If not, its multipliers prove it; if so, the tree branches at the
//! first row where that x does not satisfy the complementarity conditions. The method is complete,
//! also for coupled rows and nonsymmetric A, and shares no code with the solver `enumeration`.
//!
//! ```
//! use lcplab_judge::cases::{Search, search, single_vector};
//! use lcplab_lcp::{Coupling, Lcp, Matrix};
//!
//! // w_n = x_n − x_t − 1 and w_t = x_t − x_n − ½ with |x_t| ≤ x_n. If w_n ≥ 0, then w_t ≤ −1.5, so
//! // that x_t is at its upper bound x_n, where w_n is −1.
//! let a = Matrix::from([[1.0, -1.0], [-1.0, 1.0]]);
//! let (lo, hi) = (vec![0.0, -f64::INFINITY], vec![f64::INFINITY; 2]);
//! let lcp = Lcp::new(a, vec![-1.0, -0.5], lo, hi)?;
//! let coupled = lcp.clone().with_coupling(Coupling::new(vec![None, Some(0)], vec![0.0, 1.0])?)?;
//! assert!(single_vector(&coupled).is_none()); // it takes several cases
//! let Some(Search::None(tree)) = search(&coupled, 100) else { panic!("there is no solution") };
//! assert!(tree.leaves() > 1);
//!
//! // With x_t free, the sum of both rows is always −1.5, but w_n ≥ 0 and w_t = 0: d = (1, 1).
//! assert_eq!(single_vector(&lcp), Some(vec![(0, 1.into()), (1, 1.into())]));
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

mod another;
mod program;

pub use another::{Another, another};

use dashu_int::IBig;

use crate::residual::row_scale;
use lcplab_lcp::Lcp;
use lcplab_lcp::exact::dyadic::{Dyadic, dyadic, integers, whole};
use lcplab_lcp::exact::{Exact, Point, Side};

/// Problems with more rows are not split into cases.
pub const MOST_ROWS: usize = 24;
/// Limit on the linear programs of a proof that the user requests: about ten seconds.
pub const MOST_PROGRAMS: usize = 4096;

/// The sides chosen so far, for the rows that have one.
pub type Sides = [Option<Side>];

/// A case distinction.
#[derive(Debug, Clone, PartialEq)]
pub enum Tree {
    /// d as integers with their rows; the other entries are 0. It proves that no solution has the
    /// sides chosen on the path to this leaf.
    Leaf(Vec<(usize, IBig)>),
    /// A row and one tree for each of its sides; `None` if the row does not have that side.
    Branch {
        /// The row.
        row: usize,
        /// x_row is at its lower side.
        lo: Option<Box<Tree>>,
        /// w_row = 0.
        free: Box<Tree>,
        /// x_row is at its upper side.
        hi: Option<Box<Tree>>,
    },
}

impl Tree {
    /// The number of cases, each with a vector that excludes it.
    pub fn leaves(&self) -> usize {
        match self {
            Tree::Leaf(_) => 1,
            Tree::Branch { lo, free, hi, .. } => {
                let sides = [lo.as_deref(), Some(&**free), hi.as_deref()];
                sides.into_iter().flatten().map(Tree::leaves).sum()
            }
        }
    }
}

/// Whether a row has a lower and whether it has an upper side.
pub(crate) fn finite(lcp: &Lcp, row: usize) -> [bool; 2] {
    match lcp.is_coupled(row) {
        true => [true; 2],
        false => [lcp.lo()[row].is_finite(), lcp.hi()[row].is_finite()],
    }
}

/// The row that this row is coupled to, and μ.
pub(crate) fn coupled(lcp: &Lcp, row: usize) -> Option<(usize, Dyadic)> {
    lcp.coupled_to(row).map(|(k, mu)| (k, dyadic(mu)))
}

/// The result of a search through the cases.
pub enum Search {
    /// A solution.
    Solution(Point),
    /// A proof that no solution exists.
    None(Tree),
}

/// Searches for a solution, or for a tree that proves that none exists; `None` if the limits are
/// reached.
///
/// At each node a linear program decides whether some x satisfies the sides chosen so far. If not,
/// its multipliers are the d of a leaf; if so, the tree branches at the first row where that x does
/// not satisfy the complementarity conditions.
pub fn search(lcp: &Lcp, most_programs: usize) -> Option<Search> {
    search_within(lcp, 0.0, most_programs)
}

/// The same if each w_i may have an error of tolerance · s_i · [scale](Lcp::scale). A tree without
/// solutions then proves more than that of [`search`]; a solution proves less.
pub(crate) fn search_within(lcp: &Lcp, tolerance: f64, most_programs: usize) -> Option<Search> {
    if lcp.len() > MOST_ROWS {
        return None;
    }
    let mut programs = most_programs;
    Cases::new(lcp, tolerance).search(&mut vec![None; lcp.len()], &mut programs)
}

/// Searches for a single vector that proves, without cases, that no solution exists; `None` if none
/// exists or the problem has too many rows. The vector holds integers with their rows; the other
/// entries are 0.
pub fn single_vector(lcp: &Lcp) -> Option<Vec<(usize, IBig)>> {
    if lcp.len() > MOST_ROWS {
        return None;
    }
    Cases::new(lcp, 0.0).relaxed(&vec![None; lcp.len()]).err()
}

/// Whether no x has all its signs of w right within all bounds, if each w_i may have an error of
/// tolerance · s_i · [scale](Lcp::scale); `false` if the problem has too many rows.
pub(crate) fn is_excluded(lcp: &Lcp, tolerance: f64) -> bool {
    lcp.len() <= MOST_ROWS && Cases::new(lcp, tolerance).relaxed(&vec![None; lcp.len()]).is_err()
}

struct Cases<'a> {
    lcp: &'a Lcp,
    exact: Exact,
    /// The error that each w_i may have.
    errors: Vec<Dyadic>,
}

impl<'a> Cases<'a> {
    fn new(lcp: &'a Lcp, tolerance: f64) -> Self {
        let tolerance = if tolerance > 0.0 { tolerance.min(f64::MAX) } else { 0.0 };
        let allowed = dyadic(tolerance) * dyadic(lcp.scale());
        let errors = (0..lcp.len()).map(|i| &allowed * dyadic(row_scale(lcp, i))).collect();
        Cases { lcp, exact: Exact::new(lcp), errors }
    }

    fn search(&self, sides: &mut Vec<Option<Side>>, programs: &mut usize) -> Option<Search> {
        *programs = programs.checked_sub(1)?;
        let point = match self.relaxed(sides) {
            Ok(point) => point,
            Err(d) => return Some(Search::None(Tree::Leaf(d))),
        };
        let Some(row) = (0..self.lcp.len()).find(|&i| !self.is_solved(i, &point)) else {
            return Some(Search::Solution(point));
        };
        let [has_lo, has_hi] = finite(self.lcp, row);
        let mut way = |side: Side, is_there: bool| -> Option<Result<Option<Box<Tree>>, Point>> {
            if !is_there {
                return Some(Ok(None));
            }
            sides[row] = Some(side);
            let found = self.search(sides, programs)?;
            sides[row] = None;
            Some(match found {
                Search::None(tree) => Ok(Some(Box::new(tree))),
                Search::Solution(point) => Err(point),
            })
        };
        let mut trees = [None, None, None];
        let ways = [(Side::Lower, has_lo), (Side::Free, true), (Side::Upper, has_hi)];
        for (place, (side, is_there)) in trees.iter_mut().zip(ways) {
            match way(side, is_there)? {
                Ok(tree) => *place = tree,
                Err(point) => return Some(Search::Solution(point)),
            }
        }
        let [lo, free, hi] = trees;
        Some(Search::None(Tree::Branch { row, lo, free: free?, hi }))
    }

    /// Whether a row's x and w are complementary; x must be within its bounds.
    fn is_solved(&self, i: usize, point: &Point) -> bool {
        let (w, (lo, hi)) = (self.exact.scaled_w(i, point), self.exact.scaled_bounds(i, point));
        let error = &self.errors[i] * point.denominator();
        (w <= error || lo.as_ref() == Some(point.scaled(i)))
            && (w >= -error || hi.as_ref() == Some(point.scaled(i)))
    }

    /// An x within its bounds whose w satisfies the sides, or the d that proves that there is none.
    fn relaxed(&self, sides: &Sides) -> Result<Point, Vec<(usize, IBig)>> {
        let system = self.system(sides);
        system.point().map_err(|p| {
            let mut d: Vec<(usize, IBig)> = Vec::new();
            for (&(i, _), p) in system.asked.iter().zip(p) {
                match d.last_mut() {
                    Some((last, sum)) if *last == i => *sum += p,
                    _ => d.push((i, p)),
                }
            }
            shortened(d.into_iter().filter(|(_, p)| *p != IBig::ZERO).collect())
        })
    }

    /// The conditions of [`Cases::relaxed`] as linear equations of unknowns that are at least 0.
    fn system(&self, sides: &Sides) -> System {
        let lcp = self.lcp;
        let n = lcp.len();
        let form = Form::of(lcp, sides);
        // The required sign of w_i, or 0.
        let asked: Vec<(usize, i8)> = (0..n).flat_map(|i| self.asked(sides, i)).collect();
        let slacks = asked.iter().filter(|(_, sign)| *sign != 0).count() + form.limits.len();
        let columns = form.unknowns + slacks;
        let mut rows: Vec<Vec<Dyadic>> = Vec::new();
        let mut slack = form.unknowns;
        let mut put = |mut row: Vec<Dyadic>, constant: Dyadic, sign: i8| {
            row.resize(columns + 1, Dyadic::ZERO);
            if sign != 0 {
                row[slack] = if sign > 0 { -Dyadic::ONE } else { Dyadic::ONE };
                slack += 1;
            }
            row[columns] = -constant;
            rows.push(row);
        };
        for &(i, sign) in &asked {
            let (row, mut constant) = form.w(lcp, i);
            // w_i ≥ −error, w_i ≤ error
            match sign {
                1 => constant += &self.errors[i],
                -1 => constant -= &self.errors[i],
                _ => {}
            }
            put(row, constant, sign);
        }
        for (terms, constant) in &form.limits {
            let mut row = vec![Dyadic::ZERO; form.unknowns];
            terms.iter().for_each(|(u, factor)| row[*u] += factor);
            // y − limit ≤ 0
            put(row, constant.clone(), -1);
        }
        System { rows, form, asked }
    }

    /// The required signs of w_i. If w_i must be 0 but may have an error, it has both signs.
    fn asked(&self, sides: &Sides, i: usize) -> Vec<(usize, i8)> {
        match asked(self.lcp, sides, i) {
            Some(0) if self.errors[i] != Dyadic::ZERO => vec![(i, 1), (i, -1)],
            sign => sign.map(|sign| (i, sign)).into_iter().collect(),
        }
    }
}

/// The required sign of w_i, 0 for w_i = 0; `None` if w_i may have any sign.
fn asked(lcp: &Lcp, sides: &Sides, i: usize) -> Option<i8> {
    match (sides[i], finite(lcp, i)) {
        (Some(Side::Lower), _) | (None, [true, false]) => Some(1),
        (Some(Side::Upper), _) | (None, [false, true]) => Some(-1),
        (Some(Side::Free), _) | (None, [false, false]) => Some(0),
        (None, [true, true]) => None,
    }
}

/// Linear equations of unknowns y ≥ 0.
struct System {
    /// The coefficients of the unknowns of x and of the slacks, then the right side.
    rows: Vec<Vec<Dyadic>>,
    form: Form,
    /// The rows of the problem whose w has a required sign, one for each of the first equations.
    asked: Vec<(usize, i8)>,
}

impl System {
    /// The number of unknowns and slacks.
    fn columns(&self) -> usize {
        self.rows.first().map_or(self.form.unknowns, |row| row.len() - 1)
    }

    /// An x that satisfies the equations, or the multipliers that prove that there is none.
    fn point(&self) -> Result<Point, Vec<IBig>> {
        let columns = self.columns();
        let all = integers(&self.rows.concat());
        let rows = all.chunks(columns + 1).map(<[IBig]>::to_vec).collect();
        match program::solve(rows, columns) {
            program::ProgramResult::Multipliers(p) => Err(p),
            program::ProgramResult::Point(y, denominator) => {
                let y: Vec<Dyadic> = y.into_iter().map(whole).collect();
                let denominator = whole(denominator);
                let x = self.form.x.iter().map(|x| x.scaled_at(&y, &denominator)).collect();
                Ok(Point::new(x, denominator))
            }
        }
    }
}

/// An affine function of unknowns y ≥ 0.
#[derive(Clone)]
struct Affine {
    terms: Vec<(usize, Dyadic)>,
    constant: Dyadic,
}

impl Affine {
    /// Its value at y / denominator, times the denominator.
    fn scaled_at(&self, y: &[Dyadic], denominator: &Dyadic) -> Dyadic {
        let sum = self.terms.iter().map(|(u, factor)| factor * &y[*u]);
        sum.fold(&self.constant * denominator, |sum, term| sum + term)
    }
}

/// x as affine functions of unknowns y ≥ 0, which satisfy the sides of x and the lower bounds.
struct Form {
    x: Vec<Affine>,
    unknowns: usize,
    /// The upper bounds: terms plus a constant, which must be at most 0.
    limits: Vec<(Vec<(usize, Dyadic)>, Dyadic)>,
}

impl Form {
    fn of(lcp: &Lcp, sides: &Sides) -> Form {
        let nothing = Affine { terms: Vec::new(), constant: Dyadic::ZERO };
        let mut form = Form { x: vec![nothing; lcp.len()], unknowns: 0, limits: Vec::new() };
        let (tangents, others): (Vec<usize>, Vec<usize>) =
            (0..lcp.len()).partition(|&i| lcp.is_coupled(i));
        for i in others {
            form.x[i] = form.bounded(lcp, sides, i);
        }
        for i in tangents {
            let (k, mu) = coupled(lcp, i).expect("a coupled row");
            form.x[i] = form.rubbing(sides[i], k, &mu);
        }
        form
    }

    /// w_i as the coefficients of the unknowns, and a constant.
    fn w(&self, lcp: &Lcp, i: usize) -> (Vec<Dyadic>, Dyadic) {
        let mut row = vec![Dyadic::ZERO; self.unknowns];
        let mut constant = dyadic(lcp.b()[i]);
        for (j, a) in lcp.matrix().row(i).iter() {
            let a = dyadic(a);
            constant += &a * &self.x[j].constant;
            for (u, factor) in &self.x[j].terms {
                row[*u] += &a * factor;
            }
        }
        (row, constant)
    }

    fn unknown(&mut self) -> usize {
        self.unknowns += 1;
        self.unknowns - 1
    }

    fn bounded(&mut self, lcp: &Lcp, sides: &Sides, i: usize) -> Affine {
        let bound = |value: f64| value.is_finite().then(|| dyadic(value));
        let (lo, hi) = (bound(lcp.lo()[i]), bound(lcp.hi()[i]));
        let fixed = |constant| Affine { terms: Vec::new(), constant };
        match (sides[i], lo, hi) {
            (Some(Side::Lower), Some(lo), _) => fixed(lo),
            (Some(Side::Upper), _, Some(hi)) => fixed(hi),
            (_, Some(lo), hi) => {
                let y = self.unknown();
                if let Some(hi) = hi {
                    self.limits.push((vec![(y, Dyadic::ONE)], &lo - hi));
                }
                Affine { terms: vec![(y, Dyadic::ONE)], constant: lo }
            }
            (_, None, Some(hi)) => {
                Affine { terms: vec![(self.unknown(), -Dyadic::ONE)], constant: hi }
            }
            (_, None, None) => {
                let terms = vec![(self.unknown(), Dyadic::ONE), (self.unknown(), -Dyadic::ONE)];
                Affine { terms, constant: Dyadic::ZERO }
            }
        }
    }

    /// −μ x_k at the lower side, μ x_k at the upper; in between −μ x_k + y with y ≤ 2 μ x_k.
    fn rubbing(&mut self, side: Option<Side>, k: usize, mu: &Dyadic) -> Affine {
        let times = |factor: Dyadic, x: &Affine| Affine {
            terms: x.terms.iter().map(|(u, own)| (*u, own * &factor)).collect(),
            constant: &x.constant * &factor,
        };
        match side {
            Some(Side::Lower) => times(-mu.clone(), &self.x[k]),
            Some(Side::Upper) => times(mu.clone(), &self.x[k]),
            _ => {
                let y = self.unknown();
                let mut limit = times(mu * dyadic(-2.0), &self.x[k]);
                limit.terms.push((y, Dyadic::ONE));
                self.limits.push((limit.terms, limit.constant));
                let mut x = times(-mu.clone(), &self.x[k]);
                x.terms.push((y, Dyadic::ONE));
                x
            }
        }
    }
}

/// The same direction, divided by the common factor of its integers.
fn shortened(mut d: Vec<(usize, IBig)>) -> Vec<(usize, IBig)> {
    use dashu_int::ops::Gcd;
    let common = d.iter().fold(IBig::ZERO, |common, (_, d)| {
        if common == IBig::ZERO { d.clone() } else { IBig::from(common.gcd(d)) }
    });
    if common > IBig::ONE {
        d.iter_mut().for_each(|(_, d)| *d /= &common);
    }
    d
}
