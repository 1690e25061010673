//! Contacts with friction: files with friction rows that can be solved under any of the four
//! models.
//!
//! Each contact has the rows n, t1, t2. In the pile and the table x and w were chosen first:
//! contacts separate, slide against t1, or stick, so that the same x solves the problem under
//! Coulomb's law, under the box and under every polygon with a corner on t1. Under the associated
//! law a sliding contact also separates, and the solution is another x.

use dashu_ratio::RBig;

use super::contact::delassus;
use super::random::Random;
use super::{Expected, Generated, Parameter, Values, offset, rational};
use crate::file::Problem;
use crate::friction::{Contact, FrictionProblem};
use crate::{Lcp, Matrix};

pub(super) const FAMILIES: &[Generated] = &[
    Generated {
        name: "pushed-mass",
        about: "a unit mass on the floor, pressed and pushed at an angle: one contact, closed forms",
        source: "Coulomb's law and its models in closed form",
        parameters: &[
            Parameter::real("press", "pressing impulse (N s)", 2.0, [0.0, 1e6]),
            Parameter::real("push", "pushing impulse (N s)", 3.0, [0.0, 1e6]),
            Parameter::real("degrees", "of the push from t1", 30.0, [-360.0, 360.0]),
            Parameter::real("mu", "coefficient of friction", 0.5, [0.0, 10.0]),
        ],
        make: pushed_mass,
    },
    Generated {
        name: "pushed-rod",
        about: "a rod on its two ends, pressed unevenly, sliding and turning: contacts coupled",
        source: "two contacts whose slips have no common direction",
        parameters: &[Parameter::real("mu", "coefficient of friction", 0.3, [0.0, 2.0])],
        make: |values| pushed_rod(values.real("mu")),
    },
    Generated {
        name: "friction-table",
        about: "a table that slides on side × side points: A has rank 6, the loads are not unique",
        source: "redundant contacts with friction",
        parameters: &[
            Parameter::whole("side", "points along an edge", 2, [2, 12]),
            Parameter::real("mu", "coefficient of friction", 0.5, [0.0, 2.0]),
        ],
        make: |values| friction_table(values.whole("side"), values.real("mu")),
    },
    Generated {
        name: "friction-pile",
        about: "random bodies; contacts separate, slide or stick in turn; x is chosen first",
        source: "made backwards from its solution",
        parameters: &[
            Parameter::whole("bodies", "number of bodies", 6, [1, 500]),
            Parameter::whole("contacts", "number of contacts", 6, [1, 1000]),
            Parameter::seed(),
        ],
        make: friction_pile,
    },
];

/// The problem with three rows for each contact and one μ; model 1 freezes its boxes at x.
fn rubbing(a: Matrix, b: Vec<f64>, mu: f64, frozen_at: Vec<f64>) -> Problem {
    let n = b.len();
    let lo = (0..n).map(|i| if i % 3 == 0 { 0.0 } else { f64::NEG_INFINITY }).collect();
    let lcp = Lcp::new(a, b, lo, vec![f64::INFINITY; n]).expect("a family makes valid problems");
    let contact = |n: usize| Contact { rows: [n, n + 1, n + 2], mu };
    let contacts = (0..n).step_by(3).map(contact).collect();
    let friction = FrictionProblem::new(lcp, contacts).expect("a family makes valid contacts");
    let frozen_at = Some(frozen_at);
    Problem { frozen_at, ..Problem::new("", friction.coupled_box()) }
}

fn pushed_mass(values: &Values) -> Problem {
    let (sin, cos) = values.real("degrees").to_radians().sin_cos();
    let (press, push) = (values.real("press"), values.real("push"));
    let identity = Matrix::sparse(3, &[(0, 0, 1.0), (1, 1, 1.0), (2, 2, 1.0)]);
    let b = vec![-press, -push * cos, -push * sin];
    rubbing(identity, b, values.real("mu"), vec![press, 0.0, 0.0])
}

/// Unit mass, length 2 along t1, radius of gyration ½; the ends are ¼ below the center. The
/// velocity components are v_n, v_t1, v_t2, ω about t2, ω about n.
fn pushed_rod(mu: f64) -> Problem {
    let end = |x: f64| [vec![(0, 1.0), (3, -x)], vec![(1, 1.0), (3, 0.25)], vec![(2, 1.0), (4, x)]];
    let rows = [end(-1.0), end(1.0)].concat();
    let velocity = [-1.0, 0.75, 0.5, 0.25, 0.125];
    let b = rows.iter().map(|row| row.iter().map(|&(k, entry)| entry * velocity[k]).sum());
    let a = delassus(&rows, |k| if k < 3 { 1.0 } else { 4.0 });
    // Without friction the ends stop at the normal impulses that cancel −1 ± ¼.
    rubbing(a, b.collect(), mu, vec![0.46875, 0.0, 0.0, 0.53125, 0.0, 0.0])
}

/// Unit mass and inertia, points at ±1/2, ±3/2, … in the plane of the center. The table descends at
/// speed 1 and slides against t1; each of n points can take 1/n of the load, with friction μ/n.
fn friction_table(side: usize, mu: f64) -> Problem {
    let place = |k: usize| k as f64 - (side - 1) as f64 / 2.0;
    let rows: Vec<Vec<(usize, f64)>> = (0..side * side)
        .flat_map(|k| {
            let (x, y) = (place(k % side), place(k / side));
            let normal = vec![(2, 1.0), (3, y), (4, -x)];
            [normal, vec![(0, 1.0), (5, -y)], vec![(1, 1.0), (5, x)]]
        })
        .collect();
    let n = side * side;
    // Σ x_n = 1 stops the fall; with Σ x_t = μ it slips.
    let b = [-1.0, -1.0 - mu, 0.0].repeat(n);
    let load = RBig::ONE / RBig::from(n);
    let each = [load.clone(), load * rational(mu), RBig::ZERO];
    let x = (0..3 * n).map(|i| each[i % 3].clone()).collect();
    let frozen_at = [1.0 / n as f64, 0.0, 0.0].repeat(n);
    let mut problem = rubbing(delassus(&rows, |_| 1.0), b, mu, frozen_at);
    problem.extra.insert("expected".into(), Expected::one_of_several(x).json());
    problem
}

/// Three velocity components for each body; a contact joins two bodies, or one body to the ground,
/// along three random directions.
fn friction_pile(values: &Values) -> Problem {
    let (bodies, count, mu) = (values.whole("bodies") as i64, values.whole("contacts"), 0.5);
    let mut random = Random::new(values.whole("seed"));
    let exponent: Vec<i64> = (0..bodies).map(|_| random.whole(0, 3)).collect();
    let (mut rows, mut x, mut w) = (Vec::new(), Vec::new(), Vec::new());
    for k in 0..count {
        let (upper, lower) = (random.whole(0, bodies - 1), random.whole(-1, bodies - 1));
        for _ in 0..3 {
            let direction = [0, 1, 2].map(|_| random.eighth(-1, 1));
            let of = |body: i64, sign: f64| {
                (0..3).map(move |k| ((3 * body) as usize + k, sign * direction[k]))
            };
            let lower = (lower >= 0 && lower != upper).then(|| of(lower, -1.0));
            rows.push(of(upper, 1.0).chain(lower.into_iter().flatten()).collect());
        }
        let (load, speed) = (random.eighth(1, 4), random.eighth(1, 4));
        let (x_c, w_c) = match k % 3 {
            0 => ([0.0; 3], [speed, random.eighth(-1, 1), random.eighth(-1, 1)]),
            1 => ([load, mu * load, 0.0], [0.0, -speed, 0.0]),
            _ => ([load, mu * load / 2.0, mu * load / 4.0], [0.0; 3]),
        };
        x.extend(x_c);
        w.extend(w_c);
    }
    let a = delassus(&rows, |k| 2f64.powi(-exponent[k / 3] as i32));
    let b = offset(&a, &x, &w);
    let expected = Expected::one_of_several(x.iter().map(|&x| rational(x)).collect());
    let mut problem = rubbing(a, b, mu, x);
    problem.extra.insert("expected".into(), expected.json());
    problem
}
