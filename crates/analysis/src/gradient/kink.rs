//! One-sided derivatives at a kink.
//!
//! A weak row is at a bound with w = 0. A change of the data moves it along one of its sides,
//! which solve a small complementarity problem in the changes y_i and v_i = dw_i:
//!
//! ```text
//! at its lower bound    y_i ≥ dlo_i,   v_i ≥ 0,   (y_i − dlo_i) v_i = 0
//! at its upper bound    y_i ≤ dhi_i,   v_i ≤ 0,   (dhi_i − y_i) v_i = 0
//! ```
//!
//! For a friction row the bounds are ∓(dμ_i x_k + μ_i y_k). The free rows are eliminated. If the
//! determinants of all choices of sides have the same sign, and one change that presses every weak
//! row against its bound has one solution only, then every change has exactly one (a piecewise
//! linear map whose pieces have the same orientation covers each point equally often), and x
//! follows every small change of the data continuously (Robinson 1991).

use dashu_ratio::RBig;

use super::Status;
use super::active::{Change, RowState, Rows};
use super::linear::{dot, eliminated, solve};

/// Problems with more weak rows are not examined.
const MOST_WEAK: usize = 12;
/// More choices of sides are not enumerated.
const MOST_PIECES: usize = 1 << MOST_WEAK;

/// The side on which a weak row moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Side {
    Lower,
    Free,
    Upper,
}

/// The choices of sides at a kink, with the inverses of their equations.
#[derive(Debug, Clone)]
pub(super) struct Kink {
    weak: Vec<usize>,
    free: Vec<usize>,
    /// y_F = P y_W + p.
    p: Vec<Vec<RBig>>,
    /// v_W = S y_W + s.
    schur: Vec<Vec<RBig>>,
    /// All choices.
    pieces: Vec<Piece>,
}

/// A side for each weak row, and the inverse of their equations, column by column.
type Piece = (Vec<Side>, Vec<Vec<RBig>>);

/// The part of the small problem that depends on the change.
struct Constants {
    /// p, for all rows; for rows at bounds their own change.
    y: Vec<RBig>,
    /// s, for the weak rows.
    s: Vec<RBig>,
    /// dlo, dhi, or dμ_i x_k, for the weak rows.
    limits: Vec<[RBig; 2]>,
}

impl Kink {
    /// The choices, or else that x is not unique, because some change has no derivative or several.
    /// More than 12 weak rows or 4,096 choices are not examined.
    pub fn new(rows: &Rows) -> Result<Self, Status> {
        let count = rows.weak().len();
        let options = rows.weak().into_iter().map(|i| options(rows.states[i]).len());
        let pieces = options.fold(1usize, usize::saturating_mul);
        if count > MOST_WEAK || pieces > MOST_PIECES {
            let reason = format!("{count} rows are at a kink, with {pieces} choices of sides");
            return Err(Status::NotExamined(reason));
        }
        let reason = "the equations of the rows that are not at a kink are singular";
        let kink = Kink::eliminated(rows).ok_or_else(|| Status::NotExamined(reason.into()))?;
        kink.with_pieces(rows).ok_or(Status::NotUnique)
    }

    /// The small problem, without its choices; `None` if the free rows alone are singular.
    fn eliminated(rows: &Rows) -> Option<Self> {
        let (weak, free) = (rows.weak(), rows.free());
        let k = rows.matrix(&free, &free);
        let columns: Vec<Vec<RBig>> = transposed(&rows.matrix(&free, &weak), weak.len());
        let p = solve(&k, &columns)?;
        let p: Vec<Vec<RBig>> = p.into_iter().map(|own| own.iter().map(|p| -p).collect()).collect();
        let (below, own) = (rows.matrix(&weak, &free), rows.matrix(&weak, &weak));
        let schur = below.iter().zip(own).map(|(below, own)| {
            own.into_iter().zip(&p).map(|(own, p)| own + dot(below, p)).collect()
        });
        let schur = schur.collect();
        Some(Kink { weak, free, p, schur, pieces: Vec::new() })
    }

    fn with_pieces(mut self, rows: &Rows) -> Option<Self> {
        self.pieces = self.oriented_pieces(rows)?;
        self.is_covered_once(rows).then_some(self)
    }

    /// The inverses of all choices; `None` if their determinants do not have the same sign.
    fn oriented_pieces(&self, rows: &Rows) -> Option<Vec<Piece>> {
        let m = self.weak.len();
        let options: Vec<&[Side]> = self.weak.iter().map(|&i| options(rows.states[i])).collect();
        let count: usize = options.iter().map(|sides| sides.len()).product();
        let unit = |c: usize| (0..m).map(|r| if r == c { RBig::ONE } else { RBig::ZERO }).collect();
        let unit: Vec<Vec<RBig>> = (0..m).map(unit).collect();
        let choice = |mut number: usize| -> Vec<Side> {
            let mut side = |sides: &&[Side]| {
                let side = sides[number % sides.len()];
                number /= sides.len();
                side
            };
            options.iter().map(&mut side).collect()
        };
        let mut orientation = None;
        let piece = |sides: Vec<Side>| {
            let equations: Vec<Vec<RBig>> =
                (0..m).map(|r| self.equation(rows, r, sides[r])).collect();
            let (inverse, is_positive) = eliminated(&equations, &unit)?;
            (*orientation.get_or_insert(is_positive) == is_positive).then_some((sides, inverse))
        };
        (0..count).map(choice).filter(|sides| self.is_choice(rows, sides)).map(piece).collect()
    }

    /// Whether the sides can occur: friction of a contact without force is not between its bounds.
    fn is_choice(&self, rows: &Rows, sides: &[Side]) -> bool {
        let side_of = |k: usize| self.weak.iter().position(|&i| i == k).map(|r| sides[r]);
        (0..sides.len()).all(|r| {
            let i = self.weak[r];
            let normal = rows.normal[i].filter(|_| rows.states[i] == RowState::WeakBoth);
            sides[r] != Side::Free || normal.and_then(side_of) != Some(Side::Lower)
        })
    }

    /// The coefficients of y_W in the equation of weak row number r on a side.
    fn equation(&self, rows: &Rows, r: usize, side: Side) -> Vec<RBig> {
        let i = self.weak[r];
        let sign = match side {
            Side::Free => return self.schur[r].clone(),
            Side::Lower => -RBig::ONE,
            Side::Upper => RBig::ONE,
        };
        let mut equation = vec![RBig::ZERO; self.weak.len()];
        if let Some(k) = rows.normal[i] {
            let factor = sign * &rows.mu[i];
            for (entry, y) in equation.iter_mut().zip(self.of_weak(k)) {
                *entry = -(&factor * y);
            }
        }
        equation[r] += RBig::ONE;
        equation
    }

    /// The coefficients of y_W in y_k.
    fn of_weak(&self, k: usize) -> Vec<RBig> {
        let at = |list: &[usize]| list.iter().position(|&i| i == k);
        let own = |c: usize| match (at(&self.weak), at(&self.free)) {
            (Some(r), _) if r == c => RBig::ONE,
            (_, Some(f)) => self.p[c][f].clone(),
            _ => RBig::ZERO,
        };
        (0..self.weak.len()).map(own).collect()
    }

    /// Whether a change that presses every weak row against its bound has one solution only.
    fn is_covered_once(&self, rows: &Rows) -> bool {
        let constants = Constants {
            y: vec![RBig::ZERO; rows.len()],
            s: self.weak.iter().map(|&i| pressure(rows.states[i])).collect(),
            limits: vec![[RBig::ZERO, RBig::ZERO]; self.weak.len()],
        };
        let zero = vec![RBig::ZERO; self.weak.len()];
        self.solutions(rows, &constants).all(|y| y == zero)
    }

    /// dx for a change in its own direction.
    pub fn derivative(&self, rows: &Rows, change: &Change) -> Option<Vec<RBig>> {
        let t = rows.bound_changes(change);
        let r = |&i: &usize| rows.product(i, &t) + &change.q[i];
        let right: Vec<RBig> = self.free.iter().map(|i| -r(i)).collect();
        let p = solve(&rows.matrix(&self.free, &self.free), &[right])?.remove(0);
        let mut y = t.clone();
        self.free.iter().zip(&p).for_each(|(&i, p)| y[i] = p.clone());
        let below = rows.matrix(&self.weak, &self.free);
        let s = self.weak.iter().zip(&below).map(|(i, below)| r(i) + dot(below, &p)).collect();
        let limits = self.weak.iter().map(|&i| match rows.normal[i] {
            Some(k) => [-(&change.mu[i] * &rows.x[k]), &change.mu[i] * &rows.x[k]],
            None => [change.lo[i].clone(), change.hi[i].clone()],
        });
        let constants = Constants { y, s, limits: limits.collect() };
        let of_weak = self.solutions(rows, &constants).next()?;
        let mut y = constants.y;
        self.weak.iter().zip(&of_weak).for_each(|(&i, own)| y[i] = own.clone());
        for (f, &i) in self.free.iter().enumerate() {
            y[i] += dot(self.p.iter().map(|column| &column[f]), &of_weak);
        }
        Some(rows.completed(change, y))
    }

    /// The solutions y_W of the small problem, choice by choice.
    fn solutions<'a>(
        &'a self,
        rows: &'a Rows,
        constants: &'a Constants,
    ) -> impl Iterator<Item = Vec<RBig>> + 'a {
        self.pieces.iter().filter_map(move |(sides, inverse)| {
            let right = |(r, side): (usize, &Side)| match side {
                Side::Free => -&constants.s[r],
                Side::Lower => self.limit(rows, constants, r, 0),
                Side::Upper => self.limit(rows, constants, r, 1),
            };
            let right: Vec<RBig> = sides.iter().enumerate().map(right).collect();
            let y: Vec<RBig> = (0..right.len())
                .map(|r| dot(inverse.iter().map(|column| &column[r]), &right))
                .collect();
            self.is_solved_by(rows, constants, sides, &y).then_some(y)
        })
    }

    /// The constant part of a bound of weak row number r.
    fn limit(&self, rows: &Rows, constants: &Constants, r: usize, side: usize) -> RBig {
        let own = &constants.limits[r][side];
        match rows.normal[self.weak[r]] {
            Some(k) => {
                let friction = &rows.mu[self.weak[r]] * &self.part_of(constants, k);
                own + if side == 0 { -friction } else { friction }
            }
            None => own.clone(),
        }
    }

    /// The part of y_k that does not depend on y_W.
    fn part_of(&self, constants: &Constants, k: usize) -> RBig {
        if self.weak.contains(&k) { RBig::ZERO } else { constants.y[k].clone() }
    }

    fn is_solved_by(&self, rows: &Rows, constants: &Constants, sides: &[Side], y: &[RBig]) -> bool {
        (0..y.len()).all(|r| {
            let i = self.weak[r];
            let follow = rows.normal[i].map(|k| &rows.mu[i] * dot(&self.of_weak(k), y));
            let follow = follow.unwrap_or(RBig::ZERO);
            let lo = self.limit(rows, constants, r, 0) - &follow;
            let hi = self.limit(rows, constants, r, 1) + follow;
            let v = dot(&self.schur[r], y) + &constants.s[r];
            let state = rows.states[i];
            (state == RowState::WeakUpper || y[r] >= lo)
                && (state == RowState::WeakLower || y[r] <= hi)
                && match sides[r] {
                    Side::Free => true,
                    Side::Lower => v >= RBig::ZERO,
                    Side::Upper => v <= RBig::ZERO,
                }
        })
    }
}

/// The sides on which a weak row can move.
fn options(state: RowState) -> &'static [Side] {
    match state {
        RowState::WeakLower => &[Side::Lower, Side::Free],
        RowState::WeakUpper => &[Side::Upper, Side::Free],
        _ => &[Side::Lower, Side::Free, Side::Upper],
    }
}

/// The sign of v that keeps a weak row at its bound.
fn pressure(state: RowState) -> RBig {
    match state {
        RowState::WeakLower => RBig::ONE,
        RowState::WeakUpper => -RBig::ONE,
        _ => RBig::ZERO,
    }
}

fn transposed(matrix: &[Vec<RBig>], columns: usize) -> Vec<Vec<RBig>> {
    (0..columns).map(|c| matrix.iter().map(|row| row[c].clone()).collect()).collect()
}
