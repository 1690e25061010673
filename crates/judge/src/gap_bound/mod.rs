//! Bounds the error of an engine's velocity by the duality gap of Gauss's principle.
//!
//! An engine returns two results: forces x and the new velocity (or acceleration) v. With
//! compliance γ > 0 on every row the exact motion û is unique, and one evaluation of the duality
//! gap bounds both errors, for boxes and for the friction cones of a convex problem (associated
//! cones):
//!
//! ```text
//! s = J v + bias,   p = the nearest point to −s/γ in the bounds and cones, in the norm Σ γ_i p_i²
//! r = s + γ p                                                    the velocity that is left
//! |v − û|²_M + |u(x) − û|²_M ≤ |v − u(x)|²_M + Σ_i (s_i + γ_i x_i − r_i)²/γ_i + 2 Σ rᵀx
//! u(x) = u* + M⁻¹Jᵀx;   rᵀx of a box row is r⁺ (x − lo) + r⁻ (hi − x)
//! ```
//!
//! This holds for every x in its set (bounds and cones) and every r in the dual cones, however they
//! were found; the choice of p and r only makes the bound small. Therefore they are computed in
//! floating point and then moved by a rounding error until they verifiably lie in their sets; the
//! rest is interval arithmetic. All matrices except M are used by their stored entries: thousands
//! of rows take milliseconds.
//!
//! An x outside its set is projected into it; |M⁻¹Jᵀ(x − Πx)|_M is added to the bound on u(x). A
//! row without compliance has r = s, and there is no bound if s pushes it toward an infinite bound.

mod cone;

pub use cone::EllipticCone;

use crate::interval::{Interval, add_up, div_up, mul_up, sqrt_up};
use crate::motion_bound::mass::Mass;
use crate::motion_bound::{MotionBound, Unproved};
use lcplab_lcp::Gauss;

/// How far an engine's motion, and the motion that its forces produce, are from the exact one.
#[derive(Debug, Clone, PartialEq)]
pub struct GapBound {
    /// |v − û|_M is at most this.
    pub motion: f64,
    /// |u(x) − û|_M is at most this.
    pub answer: f64,
    /// |v − u(x)|_M is at most this: nonzero if an engine returns a v that its forces do not produce.
    pub closure: f64,
    /// The row that contributes most to the gap of x, if any does.
    pub row: Option<usize>,
}

/// Bounds the errors of a motion v and of forces x; rows of cones are bounded by their cones only.
///
/// # Errors
/// If M is not verifiably positive definite, numbers are not finite, a row without compliance is
/// violated, or a compliance is negative; the error says which.
///
/// # Panics
/// If x does not have n entries, or v does not have k.
///
/// ```
/// use lcplab_judge::gap_bound::gap_bound;
/// use lcplab_lcp::Gauss;
///
/// // 2 kg fall at 3 m/s on one contact of compliance ½ s/kg: x = 3 N s, û = −1.5 m/s.
/// let gauss = Gauss {
///     mass: vec![(0, 0, 2.0)],
///     jacobian: vec![vec![(0, 1.0)]],
///     bias: vec![0.0],
///     compliance: vec![0.5],
///     target: vec![-3.0],
///     lo: vec![0.0],
///     hi: vec![f64::INFINITY],
///     level: None,
/// };
/// let exact = gap_bound(&gauss, &[], &[3.0], &[-1.5])?;
/// assert!(exact.motion < 1e-15);
/// // A motion that is 0.1 m/s off: |v − û|_M = 0.1 √2.
/// let wrong = gap_bound(&gauss, &[], &[3.0], &[-1.4])?;
/// assert!(wrong.motion >= 0.1 * 2f64.sqrt() && wrong.motion < 0.3);
/// # Ok::<(), lcplab_judge::motion_bound::Unproved>(())
/// ```
pub fn gap_bound(
    gauss: &Gauss,
    cones: &[EllipticCone],
    x: &[f64],
    v: &[f64],
) -> Result<GapBound, Unproved> {
    assert_eq!(x.len(), gauss.bias.len(), "x needs one entry per row");
    assert_eq!(v.len(), gauss.target.len(), "v needs one entry per column of M");
    let numbers = [x, v, &gauss.bias, &gauss.target, &gauss.compliance];
    if !numbers.into_iter().flatten().all(|number| number.is_finite()) {
        return Err(Unproved::NotFinite);
    }
    let problem = Problem::new(gauss, cones)?;
    let inside = problem.projected(x);
    let beyond: Vec<Interval> =
        x.iter().zip(&inside).map(|(&x, &p)| Interval::from(x) - p.into()).collect();
    let beyond = problem.mass.length(&problem.push(&beyond));
    let forces = problem.forces(&inside);
    let given = problem.at(v)?;
    // The motion that the forces produce: v minus the part that they do not explain.
    let unexplained: Vec<f64> =
        difference(&given.needed, &forces).iter().map(|f| f.middle()).collect();
    let explained: Vec<f64> = problem
        .mass
        .solve(&unexplained)
        .iter()
        .zip(v)
        .zip(&problem.mass.scales)
        .map(|((change, v), scale)| v - scale * change)
        .collect();
    let at_answer = problem.at(&explained)?;
    let gaps = problem.gaps(&at_answer, &inside)?;
    let row = largest(&gaps);
    let from_answer = problem.distance(&at_answer, &inside, &forces)?;
    let from_given = problem.distance(&given, &inside, &forces)?;
    let nearest = problem.forces(&given.nearest);
    let motion = from_given.min(problem.distance(&given, &given.nearest, &nearest)?);
    let closure = problem.mass.length(&difference(&given.needed, &forces));
    let bound = GapBound {
        // v may also be close to the exact motion because u(x) is.
        motion: motion.min(add_up(closure, from_answer)),
        answer: add_up(beyond, from_given.min(from_answer)),
        closure: add_up(closure, beyond),
        row,
    };
    let is_finite = bound.motion.is_finite() && bound.answer.is_finite();
    if is_finite { Ok(bound) } else { Err(Unproved::NoRoom { row: row.unwrap_or(0) }) }
}

/// Bounds the error of the motion u(x) that the forces produce, and returns that motion.
///
/// ```
/// use lcplab_judge::gap_bound::answer_bound;
/// use lcplab_lcp::Gauss;
///
/// // 2 kg fall at 3 m/s on one contact of compliance ½ s/kg: x = 3 N s, û = −1.5 m/s.
/// let gauss = Gauss {
///     mass: vec![(0, 0, 2.0)],
///     jacobian: vec![vec![(0, 1.0)]],
///     bias: vec![0.0],
///     compliance: vec![0.5],
///     target: vec![-3.0],
///     lo: vec![0.0],
///     hi: vec![f64::INFINITY],
///     level: None,
/// };
/// let bound = answer_bound(&gauss, &[], &[3.2])?;
/// assert!((bound.motion[0] + 1.4).abs() < 1e-15); // −3 m/s + 3.2 N s / 2 kg
/// assert!(bound.energy_norm >= 0.1 * 2f64.sqrt()); // 0.1 m/s off, times √2 kg
/// # Ok::<(), lcplab_judge::motion_bound::Unproved>(())
/// ```
///
/// # Errors
/// As [`gap_bound`].
///
/// # Panics
/// If x does not have n entries.
pub fn answer_bound(
    gauss: &Gauss,
    cones: &[EllipticCone],
    x: &[f64],
) -> Result<MotionBound, Unproved> {
    assert_eq!(x.len(), gauss.bias.len(), "x needs one entry per row");
    let problem = Problem::new(gauss, cones)?;
    let forces: Vec<f64> = problem.forces(x).iter().map(|f| f.middle()).collect();
    let change = problem.mass.solve(&forces);
    let scaled = change.iter().zip(&problem.mass.scales);
    let motion: Vec<f64> =
        gauss.target.iter().zip(scaled).map(|(u, (change, scale))| u + scale * change).collect();
    let bound = gap_bound(gauss, cones, x, &motion)?;
    let energy_norm = bound.answer.max(bound.motion);
    let largest_entry = mul_up(energy_norm, problem.mass.largest_entry());
    Ok(MotionBound { energy_norm, largest_entry, motion })
}

/// The data, with the columns of M scaled by powers of two.
struct Problem<'a> {
    gauss: &'a Gauss,
    cones: &'a [EllipticCone],
    mass: Mass,
    /// The cone of each row, if it has one.
    cone: Vec<Option<usize>>,
}

/// A motion and quantities computed from it.
struct Motion {
    /// s = J v + bias.
    s: Vec<Interval>,
    /// The required forces M (v − u*), scaled.
    needed: Vec<Interval>,
    /// p.
    nearest: Vec<f64>,
    /// r, verifiably in its set; unused for a row without compliance.
    left: Vec<f64>,
}

impl<'a> Problem<'a> {
    fn new(gauss: &'a Gauss, cones: &'a [EllipticCone]) -> Result<Self, Unproved> {
        if let Some(row) = gauss.compliance.iter().position(|&soft| soft < 0.0) {
            return Err(Unproved::NegativeCompliance { row });
        }
        let mut cone = vec![None; gauss.bias.len()];
        for (c, own) in cones.iter().enumerate() {
            for row in own.rows() {
                if gauss.compliance[row] <= 0.0 {
                    return Err(Unproved::NoRoom { row });
                }
                cone[row] = Some(c);
            }
        }
        let mass = Mass::new(&gauss.mass, gauss.target.len())?;
        Ok(Problem { gauss, cones, mass, cone })
    }

    /// The nearest point in the bounds and cones.
    fn projected(&self, x: &[f64]) -> Vec<f64> {
        let gauss = self.gauss;
        let boxed = |i: usize| match self.cone[i] {
            Some(_) => x[i],
            None => x[i].max(gauss.lo[i]).min(gauss.hi[i]),
        };
        let mut inside: Vec<f64> = (0..x.len()).map(boxed).collect();
        self.cones.iter().for_each(|cone| cone.project(&mut inside, &gauss.compliance));
        inside
    }

    fn at(&self, v: &[f64]) -> Result<Motion, Unproved> {
        let gauss = self.gauss;
        let speed = |(row, &bias): (&Vec<(usize, f64)>, &f64)| {
            let terms = row.iter().map(|&(j, value)| (value.into(), v[j].into()));
            Interval::dot(terms) + bias.into()
        };
        let s: Vec<Interval> = gauss.jacobian.iter().zip(&gauss.bias).map(speed).collect();
        if !s.iter().all(|s| s.magnitude().is_finite()) {
            return Err(Unproved::NotFinite);
        }
        let change = |j: usize| {
            let change = Interval::from(v[j]) - gauss.target[j].into();
            change * Interval::from(1.0 / self.mass.scales[j])
        };
        let change: Vec<Interval> = (0..v.len()).map(change).collect();
        let wanted = |(s, &soft): (&Interval, &f64)| match soft > 0.0 {
            true => -s.middle() / soft,
            false => 0.0,
        };
        let nearest =
            self.projected(&s.iter().zip(&gauss.compliance).map(wanted).collect::<Vec<_>>());
        let left = self.left(&s, &nearest);
        Ok(Motion { needed: self.mass.times(&change), s, nearest, left })
    }

    /// r = s + γ p, projected onto its allowed set.
    fn left(&self, s: &[Interval], nearest: &[f64]) -> Vec<f64> {
        let gauss = self.gauss;
        let own = |i: usize| {
            let left = s[i].middle() + gauss.compliance[i] * nearest[i];
            match self.cone[i] {
                Some(_) => left,
                None if gauss.lo[i] == gauss.hi[i] => left,
                None if nearest[i] == gauss.lo[i] => left.max(0.0),
                None if nearest[i] == gauss.hi[i] => left.min(0.0),
                None => 0.0,
            }
        };
        let mut left: Vec<f64> = (0..s.len()).map(own).collect();
        self.cones.iter().for_each(|cone| cone.enclose_dual(&mut left));
        left
    }

    /// Jᵀx, scaled.
    fn push(&self, x: &[Interval]) -> Vec<Interval> {
        let mut push = vec![Interval::ZERO; self.gauss.target.len()];
        for (row, &x) in self.gauss.jacobian.iter().zip(x) {
            for &(j, value) in row {
                push[j] = push[j] + Interval::from(value * self.mass.scales[j]) * x;
            }
        }
        push
    }

    fn forces(&self, x: &[f64]) -> Vec<Interval> {
        self.push(&x.iter().map(|&x| x.into()).collect::<Vec<_>>())
    }

    /// √(|v − u(x)|²_M + gaps) for an x within its bounds; `forces` is Jᵀx.
    fn distance(&self, at: &Motion, x: &[f64], forces: &[Interval]) -> Result<f64, Unproved> {
        let closure = self.mass.length(&difference(&at.needed, forces));
        let gaps = self.gaps(at, x)?.into_iter().fold(0.0, add_up);
        Ok(sqrt_up(add_up(mul_up(closure, closure), gaps.max(0.0))))
    }

    /// The contribution of each row, and of each cone at its normal row, to the square.
    fn gaps(&self, at: &Motion, x: &[f64]) -> Result<Vec<f64>, Unproved> {
        let mut gaps: Vec<f64> = (0..x.len()).map(|i| self.gap(i, at, x[i])).collect();
        for cone in self.cones {
            let products = cone.rows().map(|row| (at.left[row].into(), x[row].into()));
            let product = mul_up(2.0, Interval::dot(products).hi.max(0.0));
            let squares = cone.rows().map(|row| gaps[row]).fold(0.0, add_up);
            gaps[cone.normal] = add_up(product, squares);
            cone.friction.iter().for_each(|&(row, _)| gaps[row] = 0.0);
        }
        if gaps.iter().any(|gap| gap.is_nan()) {
            return Err(Unproved::NotFinite);
        }
        Ok(gaps)
    }

    /// The contribution of one row: complete for a box row; for a cone row only the square.
    fn gap(&self, i: usize, at: &Motion, x: f64) -> f64 {
        let (gauss, s) = (self.gauss, at.s[i]);
        let soft = gauss.compliance[i];
        if soft == 0.0 {
            let room = |reach: f64, bound: f64| {
                let room = (Interval::from(x) - bound.into()).magnitude();
                if reach <= 0.0 { 0.0 } else { mul_up(2.0, mul_up(reach, room)) }
            };
            return room(s.hi, gauss.lo[i]).max(room(-s.lo, gauss.hi[i]));
        }
        let left = at.left[i];
        let miss = (s + Interval::from(soft) * x.into() - left.into()).magnitude();
        let square = div_up(mul_up(miss, miss), soft);
        if self.cone[i].is_some() || left == 0.0 {
            return square;
        }
        let bound = if left > 0.0 { gauss.lo[i] } else { gauss.hi[i] };
        let room = (Interval::from(x) - bound.into()).magnitude();
        add_up(square, mul_up(2.0, mul_up(left.abs(), room)))
    }
}

fn difference(a: &[Interval], b: &[Interval]) -> Vec<Interval> {
    a.iter().zip(b).map(|(&a, &b)| a - b).collect()
}

/// The index of the largest entry, if it is positive.
fn largest(values: &[f64]) -> Option<usize> {
    let most = (0..values.len()).max_by(|&i, &j| values[i].total_cmp(&values[j]))?;
    (values[most] > 0.0).then_some(most)
}
