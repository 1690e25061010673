//! A stack of cubes with a contact at each corner: four rows for each pair of cubes where three
//! would suffice, or twelve with friction where six would. A is singular, and pivots that should be
//! zero are rounding errors.

use super::contact::delassus;
use super::random::Random;
use super::{Generated, Parameter, Values};
use crate::file::Problem;
use crate::{Lcp, Matrix};

pub(super) const FAMILIES: &[Generated] = &[Generated {
    name: "box-stack",
    about: "cubes that fall onto each other, a contact at each corner: the rank of A is 3/4 or 1/2 of full",
    source: "redundant contacts, where Open Dynamics Engine and Bullet give up; friction bounds frozen",
    parameters: &[
        Parameter::whole("boxes", "number of cubes", 5, [1, 500]),
        Parameter::real("mu", "coefficient of friction; 0 for normal rows alone", 0.0, [0.0, 10.0]),
        Parameter::seed(),
    ],
    make: box_stack,
}];

/// The speed that a cube gains in one step of 1/60 s under gravity (m/s).
const FALL: f64 = 9.81 / 60.0;
/// Standard deviation of the random part of the velocities.
const JITTER: f64 = 0.1;
/// The number of sweeps for the normal impulses that set the friction bounds.
const SWEEPS: usize = 1000;
/// The corners of a face, and the directions of a contact's rows.
const CORNERS: [[f64; 2]; 4] = [[-0.5, -0.5], [-0.5, 0.5], [0.5, -0.5], [0.5, 0.5]];
const DIRECTIONS: [[f64; 3]; 3] = [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];

/// Unit masses and edges; cube l stands on cube l − 1, cube 0 on the ground.
fn box_stack(values: &Values) -> Problem {
    let (boxes, mu) = (values.whole("boxes"), values.real("mu"));
    let mut random = Random::new(values.whole("seed"));
    let mut velocity: Vec<f64> = (0..6 * boxes).map(|_| JITTER * random.normal()).collect();
    velocity.iter_mut().skip(2).step_by(6).for_each(|v| *v -= FALL);
    let (a, b) = problem(boxes, &velocity, &DIRECTIONS[..1]);
    let normal = Lcp::new(a, b, vec![0.0; 4 * boxes], vec![f64::INFINITY; 4 * boxes]);
    let normal = normal.expect("a family makes valid problems");
    if mu == 0.0 {
        return Problem::new("", normal);
    }
    let (a, b) = problem(boxes, &velocity, &DIRECTIONS);
    let bound =
        |load: f64| [(0.0, f64::INFINITY), (-mu * load, mu * load), (-mu * load, mu * load)];
    let (lo, hi) = loads(&normal).into_iter().flat_map(bound).unzip();
    Problem::new("", Lcp::new(a, b, lo, hi).expect("a family makes valid problems"))
}

/// A and b = J u of the contact rows in these directions.
fn problem(boxes: usize, velocity: &[f64], directions: &[[f64; 3]]) -> (Matrix, Vec<f64>) {
    let mut rows: Vec<Vec<(usize, f64)>> = Vec::new();
    for body in 0..boxes {
        for [x, y] in CORNERS {
            for direction in directions {
                let mut row = part(body, 1.0, [x, y, -0.5], direction);
                row.extend(
                    (body > 0)
                        .then(|| part(body - 1, -1.0, [x, y, 0.5], direction))
                        .into_iter()
                        .flatten(),
                );
                rows.push(row);
            }
        }
    }
    let b = rows.iter().map(|row| row.iter().map(|&(k, j)| j * velocity[k]).sum()).collect();
    // a cube's moment of inertia is mass × edge² / 6
    (delassus(&rows, |k| if k % 6 < 3 { 1.0 } else { 6.0 }), b)
}

/// ± (d, r × d): the velocity along d of a point at r from the center of a body.
fn part(body: usize, sign: f64, [x, y, z]: [f64; 3], [d, e, f]: &[f64; 3]) -> Vec<(usize, f64)> {
    let entries = [*d, *e, *f, y * f - z * e, z * d - x * f, x * e - y * d];
    let nonzero = entries.into_iter().enumerate().filter(|(_, entry)| *entry != 0.0);
    nonzero.map(|(k, entry)| (6 * body + k, sign * entry)).collect()
}

/// Normal impulses, nearly converged.
fn loads(normal: &Lcp) -> Vec<f64> {
    let mut x = vec![0.0; normal.len()];
    for _ in 0..SWEEPS {
        for i in 0..x.len() {
            x[i] = f64::max(0.0, x[i] - normal.row_w(i, &x) / normal.matrix().diagonal(i));
        }
    }
    x
}
