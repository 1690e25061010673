//! Exercise 11.1: the nearest point of a square, a disc and a diamond.
//!
//! `wanted` is the tangential impulse (N s) that would hold a block. Friction can give at most
//! `limit` = μ x_n ≥ 0. Each model of the lesson answers with the point of its figure that is
//! nearest to `wanted`; the figures lie around the origin. The square: both components at most
//! `limit` in size. The disc: the length at most `limit`. The diamond: the sum of the two sizes at
//! most `limit`; its nearest point may lie on an edge, or be a corner.

/// The nearest points of the square, the disc and the diamond, in this order.
pub fn answer(wanted: [f64; 2], limit: f64) -> [[f64; 2]; 3] {
    let square = wanted.map(|x| x.clamp(-limit, limit));
    let size = f64::hypot(wanted[0], wanted[1]);
    let disc = if size > limit { wanted.map(|x| x * limit / size) } else { wanted };
    let [x, y] = wanted.map(f64::abs);
    // An edge leads down at 45 degrees: both sizes lose the same, until one is used up.
    let lost = if x + y <= limit {
        0.0
    } else if (x - y).abs() <= limit {
        (x + y - limit) / 2.0
    } else {
        x.max(y) - limit
    };
    let diamond = wanted.map(|x| x.signum() * f64::max(0.0, x.abs() - lost));
    [square, disc, diamond]
}
