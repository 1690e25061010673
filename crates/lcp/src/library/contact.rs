//! Matrices of contact problems without bodies: stacks, tables, friction, random piles.

use dashu_ratio::RBig;

use super::random::Random;
use super::{Expected, Generated, Parameter, Values, contacts, offset, rational};
use crate::file::Problem;
use crate::{Lcp, Matrix};

pub(super) const FAMILIES: &[Generated] = &[
    Generated {
        name: "stack",
        about: "a frictionless column at rest, the top mass heavier by a ratio: slow for sweeps",
        source: "PGS contracts by cos²(π/2n), and by r/(1 + r) for two bodies of ratio r",
        parameters: &[
            Parameter::whole("n", "number of bodies", 10, [1, 10_000]),
            Parameter::real("ratio", "mass of the top body", 1.0, [1e-12, 1e12]),
        ],
        make: |values| stack(values.whole("n"), values.real("ratio")),
    },
    Generated {
        name: "table",
        about: "one body on side × side points: A has rank 3, the loads are not unique",
        source: "redundant contacts; side 2 and 10 for 4 and 100 points",
        parameters: &[Parameter::whole("side", "points along an edge", 2, [2, 30])],
        make: |values| table(values.whole("side")),
    },
    Generated {
        name: "near-duplicate",
        about: "a stack in which every contact is listed twice; the copies differ by 2^−bits",
        source: "contacts that a narrow phase reports twice",
        parameters: &[
            Parameter::whole("n", "number of bodies", 4, [1, 500]),
            Parameter::whole("bits", "distance of the copies, 2^−bits", 16, [1, 20]),
        ],
        make: |values| near_duplicate(values.whole("n"), values.whole("bits")),
    },
    Generated {
        name: "friction-blocks",
        about: "contacts with a four-sided friction cone, six rows each; A is not symmetric",
        source: "Stewart & Trinkle 1996; num4lcp's pattern, made valid",
        parameters: &[
            Parameter::whole("contacts", "number of contacts", 4, [1, 150]),
            Parameter::seed(),
        ],
        make: friction_blocks,
    },
    Generated {
        name: "contact-graph",
        about: "a random pile: bodies of several masses, contacts between random pairs, sparse",
        source: "b = J u*, so a solution exists; as often as not it is not unique",
        parameters: &[
            Parameter::whole("bodies", "number of bodies", 10, [1, 2000]),
            Parameter::whole("contacts", "number of contacts", 20, [1, 6000]),
            Parameter::whole("decades", "masses go from 1 to 8^decades", 1, [0, 12]),
            Parameter::seed(),
        ],
        make: contact_graph,
    },
];

/// A = J M⁻¹ Jᵀ from the rows of J as (velocity component, entry) and the inverse masses.
pub(super) fn delassus(rows: &[Vec<(usize, f64)>], inverse_mass: impl Fn(usize) -> f64) -> Matrix {
    let mut touching: Vec<Vec<(usize, f64)>> = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        for &(k, entry) in row {
            touching.resize(touching.len().max(k + 1), Vec::new());
            touching[k].push((i, entry));
        }
    }
    let mut entries = Vec::new();
    for (k, touching) in touching.iter().enumerate() {
        for &(i, a) in touching {
            entries.extend(touching.iter().map(|&(j, b)| (i, j, a * inverse_mass(k) * b)));
        }
    }
    Matrix::sparse(rows.len(), &entries)
}

/// Contact i supports all bodies above it: x_i = n − 1 − i + the top mass.
fn stack(n: usize, ratio: f64) -> Problem {
    let inverse = 1.0 / ratio;
    let rows: Vec<Vec<(usize, f64)>> = (0..n)
        .map(|i| if i == 0 { vec![(0, 1.0)] } else { vec![(i, 1.0), (i - 1, -1.0)] })
        .collect();
    let a = delassus(&rows, |body| if body + 1 == n { inverse } else { 1.0 });
    // the top mass that corresponds to the rounded sum 1 + 1/ratio
    let below = if n > 1 { RBig::ONE } else { RBig::ZERO };
    let top = RBig::ONE / (rational(a.diagonal(n - 1)) - below);
    let x = (0..n).map(|i| &top + RBig::from(n - 1 - i)).collect();
    let mut b = vec![0.0; n];
    // All bodies fall at unit speed; only the lowest contact closes.
    b[0] = -1.0;
    contacts(a, b, &Expected::unique(x))
}

/// Unit mass and inertia, points at ±1/2, ±3/2, …: a_ij = 1 + y_i y_j + x_i x_j, and each point
/// supports 1/n of the weight.
fn table(side: usize) -> Problem {
    let place = |k: usize| k as f64 - (side - 1) as f64 / 2.0;
    let rows: Vec<Vec<(usize, f64)>> = (0..side * side)
        .map(|k| vec![(0, 1.0), (1, place(k / side)), (2, -place(k % side))])
        .collect();
    let n = rows.len();
    let load = RBig::ONE / RBig::from(n);
    contacts(delassus(&rows, |_| 1.0), vec![-1.0; n], &Expected::one_of_several(vec![load; n]))
}

/// The copy of a contact also turns a small wheel, by 2^−bits; every row supports its share.
fn near_duplicate(n: usize, bits: usize) -> Problem {
    let gap = 2f64.powi(-(bits as i32));
    let rows: Vec<Vec<(usize, f64)>> = (0..2 * n)
        .map(|k| {
            let body = k / 2;
            let stack = [(body, 1.0)].into_iter().chain((body > 0).then(|| (body - 1, -1.0)));
            stack.chain((k % 2 == 1).then_some((n + body, gap))).collect()
        })
        .collect();
    let a = delassus(&rows, |_| 1.0);
    let x: Vec<f64> = (0..2 * n).map(|k| (n - k / 2) as f64 / 2.0).collect();
    let b = offset(&a, &x, &vec![0.0; 2 * n]);
    contacts(a, b, &Expected::unique(x.into_iter().map(rational).collect()))
}

/// Rows n, four directions (t, s, −t, −s) and the largest speed of slip γ against one of them:
///
/// ```text
/// w_n = v_n ⟂ x_n,   w_d = v_d + γ ⟂ β_d,   w_γ = μ x_n − Σ β_d ⟂ γ
/// ```
///
/// In turn, contacts separate, slide along −t, or stick.
fn friction_blocks(values: &Values) -> Problem {
    let (count, mu) = (values.whole("contacts"), 0.5);
    let n = 6 * count;
    let mut random = Random::new(values.whole("seed"));
    let mut jacobian: Vec<Vec<(usize, f64)>> = Vec::new();
    for _ in 0..count {
        let mut dense = || -> Vec<f64> { (0..3 * count).map(|_| random.eighth(-1, 1)).collect() };
        let [normal, t, s] = [dense(), dense(), dense()];
        let signed = |row: &[f64], sign: f64| row.iter().map(|r| sign * r).enumerate().collect();
        for (row, sign) in [(&normal, 1.0), (&t, 1.0), (&s, 1.0), (&t, -1.0), (&s, -1.0)] {
            jacobian.push(signed(row, sign));
        }
        jacobian.push(Vec::new());
    }
    let mut entries: Vec<(usize, usize, f64)> = Vec::new();
    let (mut x, mut w) = (vec![0.0; n], vec![0.0; n]);
    for (k, first) in (0..n).step_by(6).enumerate() {
        let slack = first + 5;
        entries.push((slack, first, mu));
        for d in first + 1..slack {
            entries.extend([(d, slack, 1.0), (slack, d, -1.0)]);
        }
        let (load, speed) = (random.eighth(1, 4), random.eighth(1, 4));
        match k % 3 {
            0 => w[first] = random.eighth(1, 4),
            1 => (x[first], x[first + 1]) = (load, mu * load),
            _ => (x[first], x[first + 1], w[slack]) = (load, mu * load / 2.0, mu * load / 2.0),
        }
        if k % 3 < 2 {
            // sliding: v_t = −γ, v_s = 0
            x[slack] = speed;
            (w[first + 2], w[first + 3], w[first + 4]) = (speed, 2.0 * speed, speed);
        }
    }
    let dense = delassus(&jacobian, |_| 1.0);
    entries.extend((0..n).flat_map(|i| dense.row(i).iter().map(move |(j, a)| (i, j, a))));
    let a = Matrix::sparse(n, &entries);
    let b = offset(&a, &x, &w);
    contacts(a, b, &Expected::one_of_several(x.into_iter().map(rational).collect()))
}

/// Three velocity components for each body; a contact joins two bodies, or one body to the ground,
/// along a random direction; the velocities are random.
fn contact_graph(values: &Values) -> Problem {
    let (bodies, count) = (values.whole("bodies") as i64, values.whole("contacts"));
    let mut random = Random::new(values.whole("seed"));
    let exponent: Vec<i64> =
        (0..bodies).map(|_| random.whole(0, 3 * values.whole("decades") as i64)).collect();
    let velocity: Vec<f64> = (0..3 * bodies).map(|_| random.eighth(-4, 4)).collect();
    let rows: Vec<Vec<(usize, f64)>> = (0..count)
        .map(|_| {
            let (upper, lower) = (random.whole(0, bodies - 1), random.whole(-1, bodies - 1));
            let direction = [random.eighth(-1, 1), random.eighth(-1, 1), random.eighth(1, 2)];
            let of = |body: i64, sign: f64| {
                (0..3).map(move |k| ((3 * body) as usize + k, sign * direction[k]))
            };
            let lower = (lower >= 0 && lower != upper).then(|| of(lower, -1.0));
            of(upper, 1.0).chain(lower.into_iter().flatten()).collect()
        })
        .collect();
    let a = delassus(&rows, |k| 2f64.powi(-exponent[k / 3] as i32));
    let speed = |row: &Vec<(usize, f64)>| row.iter().map(|&(k, entry)| entry * velocity[k]).sum();
    let b = rows.iter().map(speed).collect();
    let lcp = Lcp::new(a, b, vec![0.0; count], vec![f64::INFINITY; count]);
    Problem::new("", lcp.expect("a family makes valid problems"))
}
