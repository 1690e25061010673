//! Small, deliberately hard problems: ties, dependent rows, very different masses, numbers at the
//! ends of the range, matrices of no class.
//!
//! Most entries are small integers, so that sums cancel exactly: ties are exact, dependent rows are
//! exactly dependent, and a problem without solution is infeasible by more than rounding.

use std::ops::RangeInclusive;

use serde_json::{Value, json};

use super::cone;
use super::numbers::{Numbers, Random, dot, gram};
use super::posing::frozen_at;
use lcplab_lcp::Lcp;
use lcplab_lcp::file::{Problem, number};
use lcplab_lcp::friction::Model;
use lcplab_solver::MatrixClass;

/// A kind of problem.
#[derive(Debug, Clone, Copy)]
pub struct Kind {
    /// Its name.
    pub name: &'static str,
    /// What makes it hard.
    pub about: &'static str,
    make: fn(&mut Random) -> Numbers,
}

/// The kinds, used in turn.
pub const KINDS: &[Kind] = &[
    Kind {
        name: "contacts",
        about: "A = JJᵀ with small integers, often singular; contacts only; one third has no solution",
        make: |random| contacts(random),
    },
    Kind {
        name: "bounds",
        about: "the same with all kinds of bounds: boxes, equations, rows with lo = hi, only upper bounds",
        make: |random| contacts(random).bounded(random),
    },
    Kind {
        name: "solvable",
        about: "JJᵀ with b chosen so that a solution is known; one third of the rows is degenerate",
        make: |random| contacts(random).bounded(random).solvable(random),
    },
    Kind {
        name: "masses",
        about: "rows in units that differ by up to 2⁶⁰, about 10¹⁸",
        make: |random| contacts(random).bounded(random).in_units(random, 30),
    },
    Kind {
        name: "copies",
        about: "every row twice; the copies differ by up to 10⁻⁹",
        make: |random| contacts_of(random, 3).doubled(random),
    },
    Kind {
        name: "nearly-singular",
        about: "JJᵀ with 10⁻¹⁶ … 10⁻⁸ added to the diagonal",
        make: |random| contacts(random).bounded(random).stiffened(random),
    },
    Kind {
        name: "friction",
        about: "normal rows with two tangents each, bounded by μ times the normal x",
        make: |random| friction(random, 2, 2),
    },
    Kind {
        name: "plane-friction",
        about: "the same in the plane: one tangent each",
        make: |random| friction(random, 3, 1),
    },
    Kind {
        name: "polygon",
        about: "one contact with a polygon of four corners: not symmetric, copositive",
        make: polygon,
    },
    Kind {
        name: "dominant",
        about: "diagonally dominant, not symmetric: a P-matrix",
        make: |random| dominant(random).bounded(random),
    },
    Kind {
        name: "any",
        about: "any small integers: indefinite, not symmetric, zeros on the diagonal",
        make: |random| any(random).bounded(random),
    },
    Kind {
        name: "extremes",
        about: "0, −0, subnormal numbers, 10^±150 and 10^±300 among ordinary entries",
        make: |random| extremes(random).bounded(random),
    },
    Kind {
        name: "ties",
        about: "solvable, every row degenerate: x at a bound and w = 0, up to 10⁻¹⁶",
        make: |random| contacts(random).bounded(random).tied(random),
    },
    Kind {
        name: "bounds-at-the-ends",
        about: "bounds of 0, −0, subnormal numbers and ±10³⁰⁸, rows with lo = hi, only upper bounds",
        make: |random| contacts(random).bounded_at_the_ends(random),
    },
    Kind {
        name: "bimatrix",
        about: "the equilibria of a two-person game: zero diagonal blocks",
        make: bimatrix,
    },
    Kind {
        name: "rank-one",
        about: "A = vvᵀ: all rows except one are redundant",
        make: |random| rank_one(random).bounded(random),
    },
    Kind {
        name: "cancellation",
        about: "entries of 2²⁶ … 2³⁰ whose products nearly cancel",
        make: |random| cancelling(random).bounded(random),
    },
    Kind {
        name: "copositive",
        about: "no negative entry, a positive diagonal, indefinite",
        make: copositive,
    },
];

/// Problem k of a seed, and the start of the solvers: none, or a bad guess.
pub fn problem(seed: u64, k: usize) -> (Lcp, Option<Vec<f64>>) {
    let random = &mut Random::new(seed, k);
    let lcp = (KINDS[k % KINDS.len()].make)(random)
        .lcp()
        .expect("finite numbers, lo ≤ hi, tangents after normals");
    let start = (0..lcp.len()).map(|_| random.one_of(&[0.0, 1.0, -1.0, 1e-300, 1e9, -1e300]));
    let start: Vec<f64> = start.collect();
    let is_cold = random.whole(0, 2) > 0;
    (lcp, if is_cold { None } else { Some(start) })
}

/// Problem k of a seed with friction in pairs of tangents and definite A, for a friction model:
/// alternately a contact with a cone that has a closed form, with very different scales
/// ([`cone::contact`]), and a few contacts with small integers.
///
/// ```
/// use lcplab_analysis::hunt::contact_problem;
/// use lcplab_lcp::friction::FrictionProblem;
///
/// // A contact with friction under any model.
/// assert_eq!(FrictionProblem::of(&contact_problem(7, 0))?.contacts().len(), 1);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn contact_problem(seed: u64, k: usize) -> Lcp {
    if k.is_multiple_of(2) {
        return cone::contact(seed, k).problem.friction().coupled_box();
    }
    let random = &mut Random::new(seed, k);
    let numbers = whole(random, 3..=7, Some(1.0)).with_contacts(random, 2);
    numbers.lcp().expect("finite numbers, tangents after normals")
}

/// Problem k of a seed as a file: of all kinds ([`problem`]), with the start of the solvers in the
/// key `hunt` if there is one, or with friction under a model ([`contact_problem`]).
pub fn problem_file(seed: u64, k: usize, model: Option<Model>) -> Problem {
    let (lcp, start) = match model {
        Some(_) => (contact_problem(seed, k), None),
        None => problem(seed, k),
    };
    let frozen_at = (model == Some(Model::FrozenBox)).then(|| frozen_at(&lcp));
    let name = format!("problem {k} of lcplab hunt, seed {seed}");
    let mut file = Problem { model, frozen_at, ..Problem::new(name, lcp) };
    if let Some(start) = start {
        let start: Value = start.into_iter().map(number).collect();
        file.extra.insert("hunt".into(), json!({ "start": start }));
    }
    file
}

/// The addition to the diagonal of JJᵀ that a matrix class requires; `None` if there is none.
pub(super) fn own(class: MatrixClass) -> Option<f64> {
    matches!(class, MatrixClass::Definite | MatrixClass::P).then_some(1.0)
}

/// JJᵀ of integers, with `own` added to the diagonal; without it, 1 for half of the problems.
pub(super) fn whole(random: &mut Random, rows: RangeInclusive<usize>, own: Option<f64>) -> Numbers {
    let n = random.whole(*rows.start() as i64, *rows.end() as i64) as usize;
    let columns = random.whole(1, n as i64 + 1) as usize;
    let j: Vec<Vec<f64>> =
        (0..n).map(|_| (0..columns).map(|_| random.number(2)).collect()).collect();
    let (mut a, usual) = (gram(&j), random.whole(0, 1) as f64);
    (0..n).for_each(|i| a[i][i] += own.unwrap_or(usual));
    Numbers::new(a, (0..n).map(|_| random.number(3)).collect())
}

impl Numbers {
    /// The same rows as contacts with friction, each a normal and this number of tangents with one
    /// μ; remaining rows are contacts without friction.
    pub(super) fn with_contacts(mut self, random: &mut Random, tangents: usize) -> Numbers {
        let (n, rows) = (self.len(), 1 + tangents);
        let contacts = random.whole(1, (n / rows).max(1) as i64) as usize;
        let (mut index, mut mu) = (vec![None; n], vec![0.0; n]);
        for normal in (0..contacts).map(|c| c * rows).filter(|normal| normal + tangents < n) {
            let own = random.one_of(&[0.25, 0.5, 1.0, 4.0]);
            for row in normal + 1..=normal + tangents {
                (index[row], mu[row], self.lo[row]) = (Some(normal), own, f64::NEG_INFINITY);
            }
        }
        self.friction = Some((index, mu));
        self
    }

    /// Other bounds for half of the rows.
    fn bounded(mut self, random: &mut Random) -> Numbers {
        for i in 0..self.b.len() {
            let (one, other) = (random.number(3), random.number(3));
            (self.lo[i], self.hi[i]) = match random.whole(0, 9) {
                0 => (one.min(other), one.max(other)),
                1 => (f64::NEG_INFINITY, f64::INFINITY),
                2 => (f64::NEG_INFINITY, one),
                3 => (one, one),
                4 => (one, f64::INFINITY),
                _ => (self.lo[i], self.hi[i]),
            };
        }
        self
    }

    /// b = w − A x for an x within its bounds and a complementary w.
    fn solvable(mut self, random: &mut Random) -> Numbers {
        let n = self.b.len();
        let (mut x, mut w) = (vec![0.0; n], vec![0.0; n]);
        for i in 0..n {
            let inside = random.number(2).max(self.lo[i]).min(self.hi[i]);
            let push = random.whole(0, 3) as f64;
            (x[i], w[i]) = match random.whole(0, 2) {
                0 if self.lo[i].is_finite() => (self.lo[i], push),
                1 if self.hi[i].is_finite() => (self.hi[i], -push),
                _ => (inside, 0.0),
            };
        }
        for i in 0..n {
            self.b[i] = w[i] - self.a[i].iter().zip(&x).map(|(a, x)| a * x).sum::<f64>();
        }
        self
    }

    /// b = −A x for an x whose bounded entries are all at a bound, up to the last bit of b.
    fn tied(mut self, random: &mut Random) -> Numbers {
        let n = self.b.len();
        let at = |i: usize| match (self.lo[i], self.hi[i]) {
            (lo, _) if lo.is_finite() => lo,
            (_, hi) if hi.is_finite() => hi,
            _ => 1.0,
        };
        let x: Vec<f64> = (0..n).map(at).collect();
        for i in 0..n {
            let w: f64 = self.a[i].iter().zip(&x).map(|(a, x)| a * x).sum();
            self.b[i] = -w + random.one_of(&[0.0, 0.0, 1e-16, -1e-16, 1e-9, -1e-9]);
        }
        self
    }

    /// Extreme bounds: as small, as large and as unusual as numbers can be.
    fn bounded_at_the_ends(mut self, random: &mut Random) -> Numbers {
        const ENDS: [f64; 9] = [0.0, -0.0, 5e-324, -5e-324, 1e-310, 1e308, -1e308, 1.0, -1.0];
        for i in 0..self.b.len() {
            let (one, other) = (random.one_of(&ENDS), random.one_of(&ENDS));
            (self.lo[i], self.hi[i]) = match random.whole(0, 5) {
                0 | 1 => (one.min(other), one.max(other)),
                2 => (one, one),
                3 => (f64::NEG_INFINITY, one),
                4 => (one, f64::INFINITY),
                _ => (self.lo[i], self.hi[i]),
            };
        }
        self
    }

    /// Row i in units of 2^k_i: a_ij 2^(k_i + k_j), b_i 2^k_i, bounds 2^−k_i; without rounding.
    fn in_units(mut self, random: &mut Random, most: i64) -> Numbers {
        let n = self.b.len();
        let unit: Vec<f64> = (0..n).map(|_| 2f64.powi(random.whole(-most, most) as i32)).collect();
        for i in 0..n {
            for j in 0..n {
                self.a[i][j] *= unit[i] * unit[j];
            }
            self.b[i] *= unit[i];
            self.lo[i] /= unit[i];
            self.hi[i] /= unit[i];
        }
        self
    }

    /// Each row and column twice, with a slightly different b in the copy.
    fn doubled(self, random: &mut Random) -> Numbers {
        let n = self.b.len();
        let entry = |i: usize, j: usize| self.a[i % n][j % n];
        let a = (0..2 * n).map(|i| (0..2 * n).map(|j| entry(i, j)).collect()).collect();
        let off = random.one_of(&[0.0, 1e-15, 1e-12, 1e-9]);
        let b = self.b.iter().copied().chain(self.b.iter().map(|b| b + off * b.abs())).collect();
        Numbers::new(a, b)
    }

    /// γ added to the diagonal.
    fn stiffened(mut self, random: &mut Random) -> Numbers {
        let gamma = 10f64.powi(random.whole(-16, -8) as i32);
        for i in 0..self.b.len() {
            self.a[i][i] += gamma;
        }
        self
    }
}

/// JJᵀ of a J with one to n columns of integers; b is in the range of J for two thirds of the
/// problems, so that a solution exists whatever the rank.
fn contacts(random: &mut Random) -> Numbers {
    contacts_of(random, 5)
}

/// The same with at most this number of rows.
fn contacts_of(random: &mut Random, most: i64) -> Numbers {
    let n = random.whole(1, most) as usize;
    let columns = random.whole(1, n as i64) as usize;
    let j: Vec<Vec<f64>> =
        (0..n).map(|_| (0..columns).map(|_| random.number(2)).collect()).collect();
    let a = gram(&j);
    let velocity: Vec<f64> = (0..columns).map(|_| random.number(3)).collect();
    let is_consistent = random.whole(0, 2) > 0;
    let b = j.iter().map(|row| if is_consistent { dot(row, &velocity) } else { random.number(3) });
    let b = b.collect();
    Numbers::new(a, b)
}

/// Contacts, at most `most`, with this number of tangents each.
fn friction(random: &mut Random, most: i64, tangents: usize) -> Numbers {
    let points = random.whole(1, most) as usize;
    let rows = 1 + tangents;
    let n = rows * points;
    let j: Vec<Vec<f64>> = (0..n).map(|_| (0..4).map(|_| random.number(2)).collect()).collect();
    let a = gram(&j);
    let velocity: Vec<f64> = (0..4).map(|_| random.number(3)).collect();
    let b = j.iter().map(|row| dot(row, &velocity)).collect();
    let index = (0..n).map(|i| (i % rows > 0).then_some(i - i % rows)).collect();
    let mu = (0..n).map(|_| random.one_of(&[0.0, 0.25, 1.0, 4.0])).collect();
    let lo = (0..n).map(|i| if i % rows > 0 { f64::NEG_INFINITY } else { 0.0 }).collect();
    Numbers { lo, friction: Some((index, mu)), ..Numbers::new(a, b) }
}

/// The unknowns x_n, β₁ … β₄ and γ of one contact, as in
/// [`Polyhedral`](lcplab_lcp::friction::Polyhedral), along ±t1 and ±t2.
fn polygon(random: &mut Random) -> Numbers {
    let Numbers { a, b, .. } = friction(random, 1, 2);
    let mu = random.one_of(&[0.0, 0.25, 1.0, 4.0]);
    let along: [[f64; 3]; 5] =
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [0.0, 0.0, -1.0]];
    let entry = |p: [f64; 3], q: [f64; 3]| -> f64 {
        (0..3).flat_map(|i| (0..3).map(move |j| (i, j))).map(|(i, j)| p[i] * a[i][j] * q[j]).sum()
    };
    let mut rows: Vec<Vec<f64>> = along
        .iter()
        .enumerate()
        .map(|(k, &p)| {
            let row = along.iter().map(|&q| entry(p, q));
            row.chain([f64::from(k > 0)]).collect()
        })
        .collect();
    rows.push(vec![mu, -1.0, -1.0, -1.0, -1.0, 0.0]);
    let dot = |p: &[f64; 3]| p.iter().zip(&b).map(|(p, b)| p * b).sum();
    Numbers::new(rows, along.iter().map(dot).chain([0.0]).collect())
}

/// A bimatrix game with costs P and Q: A = [0 P; Qᵀ 0], b = −1.
fn bimatrix(random: &mut Random) -> Numbers {
    let (rows, columns) = (random.whole(1, 3) as usize, random.whole(1, 3) as usize);
    let n = rows + columns;
    let mut a = vec![vec![0.0; n]; n];
    for i in 0..rows {
        for j in rows..n {
            (a[i][j], a[j][i]) = (random.whole(1, 4) as f64, random.whole(1, 4) as f64);
        }
    }
    Numbers::new(a, vec![-1.0; n])
}

/// vvᵀ of small integers; b along v for half of the problems.
fn rank_one(random: &mut Random) -> Numbers {
    let n = random.whole(2, 5) as usize;
    let v: Vec<f64> = (0..n).map(|_| random.number(3)).collect();
    let a = v.iter().map(|x| v.iter().map(|y| x * y).collect()).collect();
    let (speed, is_consistent) = (random.number(3), random.whole(0, 1) == 0);
    let b = v.iter().map(|v| if is_consistent { speed * v } else { random.number(3) });
    let b = b.collect();
    Numbers::new(a, b)
}

/// JJᵀ of integers near 2²⁶ … 2³⁰ in two columns, so that determinants are differences of products
/// of 60 bits and more.
fn cancelling(random: &mut Random) -> Numbers {
    let n = random.whole(1, 3) as usize;
    let size = 2f64.powi(random.whole(26, 30) as i32);
    let j: Vec<[f64; 2]> =
        (0..n).map(|_| [size + random.number(4), size + random.number(4)]).collect();
    let dot = |p: &[f64; 2], q: &[f64; 2]| p[0] * q[0] + p[1] * q[1];
    let a = j.iter().map(|p| j.iter().map(|q| dot(p, q)).collect()).collect();
    let speed = [size * random.number(2), size * random.number(2) + random.number(3)];
    Numbers::new(a, j.iter().map(|row| dot(row, &speed)).collect())
}

/// Entries of 0 … 3, at least 1 on the diagonal, symmetric.
fn copositive(random: &mut Random) -> Numbers {
    let n = random.whole(2, 5) as usize;
    let mut a = vec![vec![0.0; n]; n];
    for i in 0..n {
        a[i][i] = random.whole(1, 3) as f64;
        for j in 0..i {
            let value = random.whole(0, 3) as f64;
            (a[i][j], a[j][i]) = (value, value);
        }
    }
    let b = (0..n).map(|_| random.number(3)).collect();
    Numbers::new(a, b)
}

/// |a_ii| > Σ |a_ij|, a_ii > 0.
fn dominant(random: &mut Random) -> Numbers {
    let mut numbers = any(random);
    for (i, row) in numbers.a.iter_mut().enumerate() {
        row[i] = 1.0 + row.iter().map(|a| a.abs()).sum::<f64>();
    }
    numbers
}

fn any(random: &mut Random) -> Numbers {
    let n = random.whole(1, 5) as usize;
    let a = (0..n).map(|_| (0..n).map(|_| random.number(3)).collect()).collect();
    let b = (0..n).map(|_| random.number(3)).collect();
    Numbers::new(a, b)
}

/// JJᵀ or arbitrary numbers, some of them replaced, in pairs so that a symmetric A stays symmetric.
fn extremes(random: &mut Random) -> Numbers {
    const NASTY: [f64; 9] = [0.0, -0.0, 5e-324, 1e-310, 1e-300, 1e-150, 1e150, 1e300, -1e300];
    let mut numbers = if random.whole(0, 1) == 0 { contacts(random) } else { any(random) };
    let n = numbers.b.len() as i64;
    for _ in 0..random.whole(1, n) {
        let (i, j) = (random.whole(0, n - 1) as usize, random.whole(0, n - 1) as usize);
        let value = random.one_of(&NASTY);
        (numbers.a[i][j], numbers.a[j][i]) = (value, value);
        if random.whole(0, 3) == 0 {
            numbers.b[i] = random.one_of(&NASTY);
        }
    }
    numbers
}
