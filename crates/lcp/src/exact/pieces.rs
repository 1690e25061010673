//! Enumerates all pieces of a problem.
//!
//! Each row is on one of its sides: 2ⁿ pieces for contacts, 3ⁿ for boxes, 18 for a contact with two
//! tangents. If the equations of a piece are singular, its solutions form a polyhedron. To find the
//! corners, w_D = 0 is added for a set D of further rows, as many as there are open unknowns, for
//! every such set: a corner where a free x meets its bound also belongs to the piece with that row
//! at the bound. A polyhedron without corners (free rows that depend on each other) is represented
//! by the solution whose dependent x are 0. Therefore the problem has no solution if no piece has
//! one.

use dashu_ratio::RBig;

use super::dyadic::{Dyadic, integers};
use super::echelon::{self, System};
use super::ranges::Ranges;
use super::{Bounds, Exact, Place, Point, Side};
use crate::Lcp;

/// Limit on the number of pieces.
pub(crate) const MAX_PIECES: usize = 1 << 16;

/// The pieces of a problem.
///
/// ```
/// use lcplab_lcp::exact::{Pieces, Side};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // Two contacts, each open or closed. Only contact 0 carries a force: x = (½, 0).
/// let a = Matrix::from([[2.0, -1.0], [-1.0, 2.0]]);
/// let lcp = Lcp::new(a, vec![-1.0, 2.0], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let pieces = Pieces::of(&lcp).unwrap();
/// assert_eq!(pieces.count(), 4);
/// assert_eq!(pieces.piece(1), [Side::Free, Side::Lower]);
/// let solutions: Vec<_> = (0..4).flat_map(|k| pieces.solutions(&pieces.piece(k))).collect();
/// assert_eq!(solutions.len(), 1);
/// assert_eq!(solutions[0].distance(&[0.5, 0.0]), 0.0);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub struct Pieces {
    exact: Exact,
    /// The sides of each row.
    choices: Vec<Vec<Side>>,
    /// Free rows whose column of A depends on those of other free rows; their x is set to 0.
    dependent: Vec<usize>,
    /// A row whose w must be zero although its x is fixed.
    level: Option<usize>,
    /// Rows whose x is fixed and whose w is zero in some corners.
    kinks: Vec<usize>,
    count: usize,
}

impl Pieces {
    /// All pieces; `None` if there are more than 65,536.
    pub fn of(lcp: &Lcp) -> Option<Self> {
        Pieces::at_most(lcp, MAX_PIECES, None, Vec::new())
    }

    /// All pieces; `None` if there are more than this. Of the rows whose x is fixed, w must be zero
    /// in the row `level`, and is zero in further corners in the rows `kinks`.
    pub(super) fn at_most(
        lcp: &Lcp,
        most: usize,
        level: Option<usize>,
        kinks: Vec<usize>,
    ) -> Option<Self> {
        let exact = Exact::new(lcp);
        let choices: Vec<Vec<Side>> = (0..lcp.len()).map(|i| exact.sides(i).to_vec()).collect();
        let count = choices.iter().try_fold(1usize, |n, sides| n.checked_mul(sides.len()))?;
        let mut pieces = Pieces { exact, choices, dependent: Vec::new(), level, kinks, count };
        if count > most {
            return None;
        }
        pieces.dependent = pieces.dependent_rows();
        Some(pieces)
    }

    /// The number of pieces.
    pub fn count(&self) -> usize {
        self.count
    }

    /// Piece number k, row 0 changing fastest.
    pub fn piece(&self, mut k: usize) -> Vec<Side> {
        let mut digit = |sides: &Vec<Side>| {
            let side = sides[k % sides.len()];
            k /= sides.len();
            side
        };
        self.choices.iter().map(&mut digit).collect()
    }

    /// Calls `look` with each piece in which the range of every w_i, for x within its bounds,
    /// allows the sign that its side asks for; no other piece has a solution. Rows get their sides
    /// one by one, and a row that is impossible ends all pieces with the sides so far.
    pub(super) fn each_possible(&self, lcp: &Lcp, look: &mut dyn FnMut(&[Side])) {
        let ranges = Ranges::new(lcp);
        let mut sides = Vec::with_capacity(self.choices.len());
        self.extend(&ranges, &mut sides, look);
    }

    fn extend(&self, ranges: &Ranges<'_>, sides: &mut Vec<Side>, look: &mut dyn FnMut(&[Side])) {
        if !ranges.are_possible(sides, &self.choices) {
            return;
        }
        let Some(choices) = self.choices.get(sides.len()) else { return look(sides) };
        for side in choices {
            sides.push(*side);
            self.extend(ranges, sides, look);
            sides.pop();
        }
    }

    /// The solutions in a piece: none, one, or the corners of a polyhedron.
    pub fn solutions(&self, sides: &[Side]) -> Vec<Point> {
        let (free, bound): (Vec<usize>, Vec<usize>) =
            (0..sides.len()).partition(|&i| sides[i] == Side::Free);
        let unknowns: Vec<usize> =
            free.iter().copied().filter(|i| !self.dependent.contains(i)).collect();
        let places = self.exact.places(sides, &unknowns, &|_| Dyadic::ZERO);
        let is_level =
            |x: &Point| self.level.is_none_or(|i| self.exact.scaled_w(i, x) == Dyadic::ZERO);
        let is_solution = |x: &Point| self.exact.is_solved_by(x) && is_level(x);
        let level: Vec<usize> = free.iter().copied().chain(self.level).collect();
        let open = match self.system(&level, &places, unknowns.len()) {
            System::None => return Vec::new(),
            System::One(x, d) => {
                return Some(Point::of(&places, x, d)).filter(is_solution).into_iter().collect();
            }
            System::Many { open } => open,
        };
        let ends_corner = |i: &usize| self.exact.sides(*i).len() > 1 || self.kinks.contains(i);
        let bound: Vec<usize> = bound.into_iter().filter(ends_corner).collect();
        let corner = |more: Vec<usize>| match self.system(
            &[&level[..], &more].concat(),
            &places,
            unknowns.len(),
        ) {
            System::One(x, d) => Some(Point::of(&places, x, d)).filter(is_solution),
            _ => None,
        };
        subsets(&bound, open).into_iter().filter_map(corner).collect()
    }

    /// Whether no piece has singular equations, as far as modular arithmetic shows: a regular
    /// matrix may count as singular, but a singular one never as regular.
    pub(super) fn are_regular(&self) -> bool {
        let is_regular = |k: usize| {
            let sides = self.piece(k);
            let free: Vec<usize> = (0..sides.len()).filter(|&i| sides[i] == Side::Free).collect();
            self.exact.independent(&sides, &free, &free).0.len() == free.len()
        };
        (0..self.count).all(is_regular)
    }

    /// The equations w = 0 of these rows.
    fn system(&self, rows: &[usize], places: &[Place], m: usize) -> System {
        let equation = |&i: &usize| integers(&self.exact.equation(i, places, m));
        echelon::solve(rows.iter().map(equation).collect(), m)
    }

    /// Free rows that can move together with other free rows while every w stays the same.
    fn dependent_rows(&self) -> Vec<usize> {
        let exact = self.exact.homogeneous();
        let is_free = |&i: &usize| matches!(exact.bounds[i], Bounds::Box(None, None));
        let free: Vec<usize> = (0..exact.len()).filter(is_free).collect();
        let sides = vec![Side::Free; exact.len()];
        let has_equation = |i: &usize| {
            self.exact.sides(*i) != [Side::Lower]
                || self.level == Some(*i)
                || self.kinks.contains(i)
        };
        let moving: Vec<usize> = (0..exact.len()).filter(has_equation).collect();
        // A rank in modular arithmetic is fast, and never above the true one.
        if exact.independent(&sides, &moving, &free).1.len() == free.len() {
            return Vec::new();
        }
        let (mut kept, mut dependent) = (Vec::new(), Vec::new());
        for i in free {
            kept.push(i);
            let places = exact.places(&sides, &kept, &|_| Dyadic::ZERO);
            let equation = |&i: &usize| integers(&exact.equation(i, &places, kept.len()));
            let equations = moving.iter().map(equation).collect();
            if let System::Many { .. } = echelon::solve(equations, kept.len()) {
                dependent.extend(kept.pop());
            }
        }
        dependent
    }
}

/// All solutions of a problem, exactly: every isolated solution, and the corners of every connected
/// family. `None` if there are more than 65,536 pieces.
///
/// ```
/// use lcplab_lcp::{Lcp, Matrix};
/// use lcplab_lcp::exact::all_solutions;
///
/// // The segment x1 + x2 = 1.
/// let a = Matrix::dense(2, &[1.0; 4]);
/// let lcp = Lcp::new(a, vec![-1.0; 2], vec![0.0; 2], vec![f64::INFINITY; 2])?;
/// let corners = all_solutions(&lcp).unwrap();
/// assert_eq!(corners, [[1.into(), 0.into()], [0.into(), 1.into()]]);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn all_solutions(lcp: &Lcp) -> Option<Vec<Vec<RBig>>> {
    let pieces = Pieces::of(lcp)?;
    let mut all: Vec<Vec<RBig>> = Vec::new();
    for k in 0..pieces.count() {
        for x in pieces.solutions(&pieces.piece(k)) {
            let x = x.entries();
            if !all.contains(&x) {
                all.push(x);
            }
        }
    }
    Some(all)
}

/// All subsets of k elements.
fn subsets(of: &[usize], k: usize) -> Vec<Vec<usize>> {
    match (k, of) {
        (0, _) => vec![Vec::new()],
        (_, []) => Vec::new(),
        (_, [first, rest @ ..]) => {
            let mut with = subsets(rest, k - 1);
            with.iter_mut().for_each(|set| set.push(*first));
            with.extend(subsets(rest, k));
            with
        }
    }
}
