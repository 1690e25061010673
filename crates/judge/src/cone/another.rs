//! A second exact solution beside one in which no contact slides.

use lcplab_lcp::exact::dyadic::{Dyadic, dyadic, exponent};
use lcplab_lcp::exact::{Exact, Point, Side};
use lcplab_lcp::friction::ConeProblem;

use super::definition::is_solved_by;

/// The first step along the direction is as long as x, and each further one half as long.
const MOST_STEPS: isize = 64;

/// Another exact solution, if contacts share a load that they can also share in another way: x
/// moves along a d with A d = 0. `None` does not show that x is the only solution.
///
/// ```
/// use lcplab_judge::{ConeProof, another_cone_solution, nearest_cone_proof};
/// use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Law};
/// use lcplab_lcp::{Lcp, Matrix};
///
/// // A unit mass rests on the same contact twice.
/// let entries: Vec<_> = (0..6).flat_map(|i| [(i, i, 1.0), (i, (i + 3) % 6, 1.0)]).collect();
/// let (b, free) = (vec![-2.0, 0.0, 0.0, -2.0, 0.0, 0.0], f64::INFINITY);
/// let lo = vec![0.0, -free, -free, 0.0, -free, -free];
/// let lcp = Lcp::new(Matrix::sparse(6, &entries), b, lo, vec![free; 6])?;
/// let contacts = [[0, 1, 2], [3, 4, 5]].map(|rows| Contact { rows, mu: 0.5 });
/// let friction = FrictionProblem::new(lcp, contacts.to_vec())?;
/// let problem = ConeProblem::new(friction, Law::Coulomb);
/// let proof = nearest_cone_proof(&problem, &[1.0, 0.0, 0.0, 1.0, 0.0, 0.0]);
/// let Some(ConeProof::Point(x)) = proof else { panic!("it rests") };
/// let y = another_cone_solution(&problem, &x).expect("another share");
/// assert_ne!(y.entries(), x.entries());
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn another_cone_solution(problem: &ConeProblem, x: &Point) -> Option<Point> {
    let exact = Exact::new(&problem.friction().coupled_box());
    let n = exact.len();
    let sides: Vec<Side> = (0..n).map(|i| side(&exact, x, i)).collect::<Option<_>>()?;
    let near: Vec<f64> = x.entries().iter().map(|x| x.to_f64().value()).collect();
    if near.iter().any(|x| x.is_infinite()) {
        return None;
    }
    let direction = exact.point(&sides, &near)?.1?;
    let longest = |point: &Point| (0..n).filter_map(|i| exponent(point.scaled(i))).max();
    let size = |point: &Point| Some(longest(point)? - exponent(point.denominator())?);
    let first = size(x)? - size(&direction)?;
    (0..MOST_STEPS).find_map(|k| {
        let y = moved(x, &direction, dyadic(1.0) << (first - k));
        is_solved_by(problem, &exact, &y).then_some(y)
    })
}

/// The side of a row at a point; `None` for friction that slides inside of its box.
fn side(exact: &Exact, x: &Point, i: usize) -> Option<Side> {
    let (lo, hi) = exact.scaled_bounds(i, x);
    match x.scaled(i) {
        own if lo.as_ref() == Some(own) => Some(Side::Lower),
        own if hi.as_ref() == Some(own) => Some(Side::Upper),
        _ => (exact.scaled_w(i, x) == Dyadic::ZERO).then_some(Side::Free),
    }
}

/// x + step · d.
fn moved(x: &Point, d: &Point, step: Dyadic) -> Point {
    let step = step * x.denominator();
    let entry = |i: usize| x.scaled(i) * d.denominator() + &step * d.scaled(i);
    Point::new((0..x.len()).map(entry).collect(), x.denominator() * d.denominator())
}
