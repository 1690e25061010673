//! Mistakes of contact solvers on a cube, whose rows are redundant.

use lcplab_analysis::diagnosis::{MistakeKind, find_mistakes};
use oorandom::Rand64;

use super::contact_solver::{CONVERGED, Limit, Shape, Sweep, size};
use super::plain::Plain;

/// The number of problems in which each mistake is made, under each law.
const TIMES: usize = 10;
/// The number of random problems that are tried for them.
const SEEDS: u64 = 600;

/// A cube of unit mass and edge with a contact at each corner of its lower face, and a random
/// velocity: 12 rows, of which 6 are redundant.
fn cube(random: &mut Rand64) -> Plain {
    let mut number = |most: f64| most * (2.0 * random.rand_float() - 1.0);
    let velocity: [f64; 6] =
        [number(1.0), number(1.0), -0.5 + number(0.2), number(0.3), number(0.3), number(0.3)];
    let mut rows: Vec<[f64; 6]> = Vec::new();
    for corner in [[-0.5, -0.5], [-0.5, 0.5], [0.5, -0.5], [0.5, 0.5]] {
        let r = [corner[0], corner[1], -0.5];
        for d in [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]] {
            let turn =
                [r[1] * d[2] - r[2] * d[1], r[2] * d[0] - r[0] * d[2], r[0] * d[1] - r[1] * d[0]];
            rows.push([d[0], d[1], d[2], turn[0], turn[1], turn[2]]);
        }
    }
    let n = rows.len();
    let inverse = |k: usize| if k < 3 { 1.0 } else { 6.0 };
    let product = |i: usize, j: usize| (0..6).map(|k| rows[i][k] * inverse(k) * rows[j][k]).sum();
    let a = (0..n).map(|i| (0..n).map(|j| product(i, j)).collect()).collect();
    let b = rows.iter().map(|row| row.iter().zip(velocity).map(|(j, u)| j * u).sum()).collect();
    let friction = (0..n).map(|i| (i % 3 > 0).then_some((i - i % 3, 0.4))).collect();
    let free = |i: usize| if !i.is_multiple_of(3) { f64::NEG_INFINITY } else { 0.0 };
    let lo = (0..n).map(free).collect();
    Plain { a, b, lo, hi: vec![f64::INFINITY; n], friction }
}

/// Where rows are redundant, the answer of a mistake is one of many, and not that of our solver.
/// Another μ shows only in the contacts that slide; where the others leave too many entries free,
/// chance is not excluded and nothing is named.
#[test]
fn mistakes_on_redundant_rows_are_named_under_every_law() {
    let kinds = [
        ("factor of dt", MistakeKind::FactorOfB),
        ("rows permuted", MistakeKind::OtherRows),
        ("contacts off by one", MistakeKind::OtherRows),
        ("limit of the next contact", MistakeKind::OtherNormals),
        ("μ scaled or squared", MistakeKind::FactorOfMu),
    ];
    let mut missed = Vec::new();
    for shape in Shape::ALL {
        for (what, kind) in kinds {
            let (mut named, mut made) = (0, 0);
            for seed in 0..SEEDS {
                let mut generator = Rand64::new(u128::from(seed) + 9000);
                let problem = cube(&mut generator);
                let start: Vec<f64> = (0..12)
                    .map(|i| if i % 3 == 0 { generator.rand_float() } else { 0.0 })
                    .collect();
                let right = Sweep::right(shape);
                let mut changed = problem.clone();
                match what {
                    "factor of dt" => changed.b.iter_mut().for_each(|b| *b *= 60.0),
                    "μ scaled or squared" => {
                        changed.friction.iter_mut().flatten().for_each(|own| own.1 *= 0.5);
                    }
                    _ => {}
                }
                let limit = match what {
                    "limit of the next contact" => Limit::Next,
                    _ => Limit::Own,
                };
                let sweep = Sweep { limit, ..right };
                let Some(mut x) = sweep.sweeps(&changed, start, CONVERGED) else { continue };
                match what {
                    "rows permuted" => x.swap((seed % 12) as usize, ((seed / 5 + 3) % 12) as usize),
                    "contacts off by one" => x.rotate_left(3),
                    _ => {}
                }
                let found = find_mistakes(&shape.posed(&problem), &x, None);
                if found.verdict.is_solution() {
                    continue; // the mistake leads to another solution
                }
                made += 1;
                match found.mistakes.iter().any(|own| own.kind == kind) {
                    true => named += 1,
                    false => missed.push((shape, what, seed, found.conclusion, found.mistakes)),
                }
                if made == TIMES {
                    break;
                }
            }
            let least = match (what, shape) {
                ("μ scaled or squared", Shape::Box) => 7,
                ("μ scaled or squared", Shape::Polygon) => 4,
                ("μ scaled or squared", Shape::Disk) => 9,
                _ => TIMES,
            };
            assert_eq!(made, TIMES, "{what} was not made often enough under {shape:?}");
            assert!(named >= least, "{shape:?}, {what}: {named} of {made}: {missed:#?}");
        }
    }
    // What is not named is not called something else either.
    assert!(missed.iter().all(|(.., found)| found.is_empty()), "{missed:#?}");
}

/// A right answer moved by noise, or one of whose entries is off, is not accused where rows are
/// redundant either.
#[test]
fn no_mistake_is_named_on_redundant_rows_for_answers_that_chance_made() {
    let mut accused = Vec::new();
    for (seed, shape) in (0..60u64).flat_map(|seed| Shape::ALL.map(|shape| (seed, shape))) {
        let mut generator = Rand64::new(u128::from(seed) + 400);
        let problem = cube(&mut generator);
        let start = (0..12).map(|i| f64::from(u8::from(i % 3 == 0)) * generator.rand_float());
        let Some(mut x) = Sweep::right(shape).sweeps(&problem, start.collect(), CONVERGED) else {
            continue;
        };
        let part = 10f64.powf(-6.0 + 4.0 * generator.rand_float()) * size(&x);
        let chosen = generator.rand_range(0..12) as usize;
        for (i, x) in x.iter_mut().enumerate() {
            if seed.is_multiple_of(2) || i == chosen {
                *x += part * (2.0 * generator.rand_float() - 1.0);
            }
        }
        let found = find_mistakes(&shape.posed(&problem), &x, None);
        if !found.mistakes.is_empty() {
            accused.push((shape, seed, found.mistakes));
        }
    }
    assert!(accused.is_empty(), "{}: {accused:#?}", accused.len());
}
