//! Bimatrix games: two players with a cost for each pair of strategies.
//!
//! Player 1 chooses among the rows of C, player 2 among the columns of D, and each pays the own
//! cost. For positive costs the equilibria are the solutions of the LCP (Lemke & Howson 1964)
//!
//! ```text
//! 0 ≤ x ⟂ C y − 1 ≥ 0,   0 ≤ y ⟂ Dᵀ x − 1 ≥ 0
//! ```
//!
//! with the probabilities x / Σ x and y / Σ y. A has zeros on its diagonal: sweeps cannot solve it,
//! and Lemke's method with the covering vector 1 may end on a ray.

use dashu_ratio::RBig;

use super::random::Random;
use super::{Expected, Generated, Parameter, Values};
use crate::file::Problem;
use crate::{Lcp, Matrix};

const SOURCE: &str = "Lemke & Howson 1964";

pub(super) const FAMILIES: &[Generated] = &[
    Generated {
        name: "bimatrix-game",
        about: "equilibria of a game of two players with random whole costs: often several solutions",
        source: SOURCE,
        parameters: &[
            Parameter::whole("rows", "number of strategies of player 1", 3, [1, 200]),
            Parameter::whole("columns", "number of strategies of player 2", 3, [1, 200]),
            Parameter::whole(
                "most",
                "largest cost; with few costs some games are degenerate",
                99,
                [1, 1_000_000],
            ),
            Parameter::seed(),
        ],
        make: random_game,
    },
    Generated {
        name: "coordination-game",
        about: "two players gain i + 1 if both choose strategy i: all 2^n − 1 equilibria are known",
        source: SOURCE,
        parameters: &[Parameter::whole("n", "number of strategies of each player", 3, [1, 8])],
        make: coordination_game,
    },
];

fn random_game(values: &Values) -> Problem {
    let (rows, columns) = (values.whole("rows"), values.whole("columns"));
    let most = values.whole("most") as i64;
    let mut random = Random::new(values.whole("seed"));
    let mut costs =
        || -> Vec<f64> { (0..rows * columns).map(|_| random.whole(1, most) as f64).collect() };
    let (first, second) = (costs(), costs());
    let cost = |own: &[f64], i: usize, j: usize| own[i * columns + j];
    let lcp = game(rows, columns, |i, j| cost(&first, i, j), |i, j| cost(&second, i, j));
    Problem::new("", lcp)
}

/// Costs n + 1, less i + 1 where both choose i. Both players mix the same strategies S, each in
/// inverse proportion to its gain, and pay n + 1 − 1 / Σ_S 1/(i + 1).
fn coordination_game(values: &Values) -> Problem {
    let n = values.whole("n");
    let base = n as f64 + 1.0;
    let cost = |i: usize, j: usize| if i == j { base - (i as f64 + 1.0) } else { base };
    let mixed = |set: usize| -> Vec<RBig> {
        let is_in = |i: usize| (set >> i) & 1 == 1;
        let share = |i: usize| RBig::from(1) / RBig::from(i + 1);
        let total = (0..n).filter(|&i| is_in(i)).map(share).fold(RBig::ZERO, |sum, own| sum + own);
        let paid = RBig::from(n + 1) - RBig::from(1) / &total;
        let entry = |i: usize| match is_in(i) {
            true => share(i) / &total / &paid,
            false => RBig::ZERO,
        };
        let own: Vec<RBig> = (0..n).map(entry).collect();
        [own.clone(), own].concat()
    };
    let solutions = (1..1usize << n).map(mixed).collect();
    let mut problem = Problem::new("", game(n, n, cost, cost));
    problem.extra.insert("expected".into(), Expected { solutions, complete: true }.json());
    problem
}

/// The LCP of a game.
fn game(
    rows: usize,
    columns: usize,
    first: impl Fn(usize, usize) -> f64,
    second: impl Fn(usize, usize) -> f64,
) -> Lcp {
    let size = rows + columns;
    let pairs = || (0..rows).flat_map(|i| (0..columns).map(move |j| (i, j)));
    let entries: Vec<(usize, usize, f64)> = pairs()
        .map(|(i, j)| (i, rows + j, first(i, j)))
        .chain(pairs().map(|(i, j)| (rows + j, i, second(i, j))))
        .collect();
    let (b, lo, hi) = (vec![-1.0; size], vec![0.0; size], vec![f64::INFINITY; size]);
    Lcp::new(Matrix::sparse(size, &entries), b, lo, hi).expect("a family makes valid problems")
}
