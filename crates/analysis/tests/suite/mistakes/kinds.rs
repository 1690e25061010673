//! Mistakes of contact solvers under boxes, polygons and cones, where no rows are redundant.

use lcplab_analysis::diagnosis::{MistakeKind, MistakeSearch, find_mistakes};
use lcplab_lcp::friction::ProblemForm;
use oorandom::Rand64;

use super::contact_solver::{CONVERGED, Limit, Shape, Sweep, size};
use super::plain::{Plain, Rows, random};

/// The number of problems in which each mistake is made, under each law.
const TIMES: usize = 10;
/// The number of random problems that are tried for them.
const SEEDS: u64 = 600;

/// A mistake by its name here, and the kinds that are right for it.
type Planted = (&'static str, &'static [MistakeKind]);

const KINDS: [Planted; 22] = [
    ("another friction law", &[MistakeKind::OtherLaw]),
    ("increments clamped", &[MistakeKind::ClampedIncrements]),
    ("one clamp at the end", &[MistakeKind::ClampAtEnd]),
    ("wrong active set", &[MistakeKind::WrongActiveSet]),
    ("rows permuted", &[MistakeKind::OtherRows]),
    ("rows off by one", &[MistakeKind::OtherRows]),
    ("warm start scaled", &[MistakeKind::ScaledWarmStart]),
    ("stale warm start", &[MistakeKind::StoppedSweeps, MistakeKind::MissingWarmStart]),
    ("one contact zeroed", &[MistakeKind::ContactLeftOut]),
    ("clamp per axis", &[MistakeKind::OtherLaw]),
    ("factor of dt", &[MistakeKind::FactorOfB]),
    ("double mass", &[MistakeKind::FactorOfB, MistakeKind::FactorOfX]),
    ("impulse for force", &[MistakeKind::FactorOfB, MistakeKind::FactorOfX]),
    ("sign of b", &[MistakeKind::SignOfB]),
    ("friction left out", &[MistakeKind::FrictionLeftOut]),
    ("limit of the first sweep", &[MistakeKind::FirstFriction]),
    ("limit one sweep late", &[MistakeKind::LateFriction]),
    ("μ scaled or squared", &[MistakeKind::FactorOfMu]),
    ("limit of the next contact", &[MistakeKind::OtherNormals]),
    ("tangents swapped or reversed", &[MistakeKind::Tangents]),
    ("compliance left out", &[MistakeKind::ComplianceLeftOut]),
    ("one clamp missing", &[MistakeKind::MissingBound, MistakeKind::UnlimitedFriction]),
];

/// The answer with this mistake, and the answer to the previous step if the mistake needs one.
fn planted(
    what: &str,
    problem: &Plain,
    shape: Shape,
    last: &[f64],
    seed: u64,
) -> Option<(Vec<f64>, bool)> {
    let (n, right) = (problem.len(), Sweep::right(shape));
    let right = Sweep { has_long_steps: seed.is_multiple_of(2) && shape != Shape::Box, ..right };
    let few = 2 + (seed % 5) as usize;
    let zero = || vec![0.0; n];
    let mut changed = problem.clone();
    let scaled = |factor: f64| -> Option<Vec<f64>> {
        Some(right.solved(problem)?.iter().map(|x| factor * x).collect())
    };
    let x = match what {
        "another friction law" => {
            let other = match shape {
                Shape::Box => Shape::Disk,
                Shape::Polygon => [Shape::Box, Shape::Disk][(seed % 2) as usize],
                Shape::Disk => [Shape::Box, Shape::Polygon][(seed % 2) as usize],
            };
            Sweep::right(other).solved(problem)?
        }
        "increments clamped" => {
            Sweep { clamps_increments: true, ..right }.sweeps(problem, zero(), few)?
        }
        "one clamp at the end" => {
            let sweep = Sweep { clamps_at_end: true, ..right };
            sweep.sweeps(problem, zero(), if seed.is_multiple_of(3) { CONVERGED } else { few })?
        }
        "wrong active set" => {
            // Contacts outside the set carry nothing, the others hold as if they were glued.
            for contact in 0..n / 3 {
                if (seed >> contact) & 1 == 1 {
                    for i in 3 * contact..3 * contact + 3 {
                        (0..n).for_each(|j| changed.a[i][j] = f64::from(u8::from(i == j)));
                        changed.b[i] = 0.0;
                    }
                }
            }
            let free = Sweep { clamps_normals: false, clamps_friction: false, ..right };
            Sweep { shape: Shape::Box, ..free }.solved(&changed)?
        }
        "rows permuted" => {
            let mut x = right.solved(problem)?;
            let (i, j) = ((seed % n as u64) as usize, ((seed / 7 + 1) % n as u64) as usize);
            x.swap(i, j);
            x
        }
        "rows off by one" => {
            let mut x = right.solved(problem)?;
            x.rotate_left([1, 3][(seed % 2) as usize]);
            x
        }
        "warm start scaled" => {
            let start = last.iter().map(|x| 0.85 * x).collect();
            return Some((right.sweeps(problem, start, few)?, true));
        }
        "stale warm start" => return Some((right.sweeps(problem, last.to_vec(), few)?, true)),
        "one contact zeroed" => {
            let mut x = right.solved(problem)?;
            let first = 3 * (seed % (n as u64 / 3)) as usize;
            x[first..first + 3].fill(0.0);
            x
        }
        "clamp per axis" => match shape {
            Shape::Box => Sweep::right(Shape::Disk).solved(problem)?,
            _ => Sweep::right(Shape::Box).sweeps(
                problem,
                zero(),
                if seed.is_multiple_of(3) { CONVERGED } else { few },
            )?,
        },
        "factor of dt" => {
            let factor = [60.0, 0.01, 4.0][(seed % 3) as usize];
            changed.b.iter_mut().for_each(|b| *b *= factor);
            right.solved(&changed)?
        }
        "double mass" => {
            changed.a.iter_mut().flatten().for_each(|a| *a *= 0.5);
            right.solved(&changed)?
        }
        "impulse for force" => scaled(240.0)?,
        "sign of b" => {
            changed.b.iter_mut().for_each(|b| *b = -*b);
            right.solved(&changed)?
        }
        "friction left out" => {
            changed.friction.iter_mut().flatten().for_each(|own| own.1 = 0.0);
            right.solved(&changed)?
        }
        "limit of the first sweep" => {
            let sweep = Sweep { limit: Limit::FirstSweep, ..right };
            sweep.sweeps(problem, zero(), if seed.is_multiple_of(3) { CONVERGED } else { few })?
        }
        "limit one sweep late" => {
            Sweep { limit: Limit::SweepBefore, ..right }.sweeps(problem, zero(), few)?
        }
        "μ scaled or squared" => {
            let change = [|mu: f64| mu * mu, |mu| 2.0 * mu, |mu| 0.8 * mu][(seed % 3) as usize];
            changed.friction.iter_mut().flatten().for_each(|own| own.1 = change(own.1));
            right.solved(&changed)?
        }
        "limit of the next contact" => Sweep { limit: Limit::Next, ..right }.solved(problem)?,
        "tangents swapped or reversed" => {
            let mut x = right.solved(problem)?;
            for contact in x.chunks_mut(3) {
                match seed % 2 {
                    0 => contact.swap(1, 2),
                    _ => contact[1] = -contact[1],
                }
            }
            x
        }
        "compliance left out" => {
            (0..n).for_each(|i| changed.a[i][i] -= 0.01);
            right.solved(&changed)?
        }
        "one clamp missing" => {
            let normals = seed.is_multiple_of(2);
            Sweep { clamps_normals: normals, clamps_friction: !normals, ..right }.solved(problem)?
        }
        _ => unreachable!("{what}"),
    };
    Some((x, false))
}

/// How often a mistake is named right, of the problems in which it changes at least three entries.
fn named((what, kinds): Planted, shape: Shape, misses: &mut Vec<(u64, MistakeSearch)>) -> usize {
    let (mut named, mut made) = (0, 0);
    for seed in 0..SEEDS {
        let mut generator = Rand64::new(u128::from(seed) + 5000);
        let (problem, _) = random(&mut generator, Rows::Friction);
        if problem.len() < 6 {
            continue;
        }
        let Some(solution) = Sweep::right(shape).solved(&problem) else { continue };
        // The last answer kept to its limits too.
        let parts: Vec<f64> =
            (0..solution.len() / 3).map(|_| 0.5 + generator.rand_float()).collect();
        let last: Vec<f64> = solution.iter().enumerate().map(|(i, x)| x * parts[i / 3]).collect();
        let Some((x, needs_last)) = planted(what, &problem, shape, &last, seed) else { continue };
        let differs =
            x.iter().zip(&solution).filter(|(a, b)| (*a - *b).abs() > 1e-3 * size(&solution));
        // Right sweeps are told from wrong ones only where the clamp acts.
        let is_right_sweep = what != "stale warm start"
            && (1..7).any(|k| {
                [false, true].into_iter().any(|has_long_steps| {
                    let sweep = Sweep { has_long_steps, ..Sweep::right(shape) };
                    sweep.sweeps(&problem, vec![0.0; x.len()], k).is_some_and(|own| own == x)
                })
            });
        let is_nothing = size(&x) == 0.0;
        if differs.count() < if what == "rows permuted" { 2 } else { 3 }
            || is_right_sweep
            || is_nothing
        {
            continue;
        }
        let found = find_mistakes(&shape.posed(&problem), &x, needs_last.then_some(&last[..]));
        made += 1;
        match found.mistakes.iter().any(|own| kinds.contains(&own.kind)) {
            true => named += 1,
            false => misses.push((seed, found)),
        }
        if made == TIMES {
            break;
        }
    }
    assert_eq!(made, TIMES, "{what} was not made often enough under {shape:?}");
    named
}

/// Of the 22 kinds at least 19 are named in each of ten problems, under each law.
#[test]
fn mistakes_of_contact_solvers_are_named_under_every_law() {
    for shape in Shape::ALL {
        let mut lines = Vec::new();
        let mut right = 0;
        for planted in KINDS {
            let mut misses = Vec::new();
            let named = named(planted, shape, &mut misses);
            right += usize::from(named == TIMES);
            if named < TIMES {
                let first = misses.first().map(|(seed, found)| {
                    let names: Vec<&str> =
                        found.mistakes.iter().map(|own| own.what.as_str()).collect();
                    format!("seed {seed}, {:?}: {names:?}", found.conclusion)
                });
                lines.push(format!("{}: {named} of {TIMES}; {}", planted.0, first.unwrap()));
            }
        }
        assert!(right >= 19, "{shape:?}: {right} of {}\n{}", KINDS.len(), lines.join("\n"));
    }
}

/// Coulomb's law with μ1 along t1 and μ2 along t2: an ellipse, whose projection is found by
/// bisection of its multiplier.
fn under_ellipses(problem: &Plain, mu: [f64; 2]) -> Option<Vec<f64>> {
    let mut x = vec![0.0; problem.len()];
    for _ in 0..CONVERGED {
        let before = x.clone();
        for n in (0..x.len()).step_by(3) {
            x[n] = (x[n] - problem.w(&x, n) / problem.a[n][n]).max(0.0);
            let step = problem.a[n + 1][n + 1] + problem.a[n + 2][n + 2];
            let aim = [n + 1, n + 2].map(|i| x[i] - problem.w(&x, i) / step);
            let axes = mu.map(|mu| mu * x[n]);
            let at = |t: f64| [0, 1].map(|k| axes[k] * axes[k] * aim[k] / (axes[k] * axes[k] + t));
            let outside = |p: [f64; 2]| (p[0] / axes[0]).powi(2) + (p[1] / axes[1]).powi(2) > 1.0;
            let (mut least, mut most) = (0.0, 1.0);
            if x[n] == 0.0 {
                (x[n + 1], x[n + 2]) = (0.0, 0.0);
                continue;
            }
            if outside(aim) {
                while outside(at(most)) {
                    most *= 2.0;
                }
                for _ in 0..200 {
                    let middle = 0.5 * (least + most);
                    if outside(at(middle)) { least = middle } else { most = middle }
                }
                (x[n + 1], x[n + 2]) = (at(most)[0], at(most)[1]);
            } else {
                (x[n + 1], x[n + 2]) = (aim[0], aim[1]);
            }
        }
        let moved = x.iter().zip(&before).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
        if moved <= 1e-16 * size(&x) {
            return Some(x);
        }
    }
    None
}

/// The answer under an ellipse to a box with μ1 ≠ μ2.
#[test]
fn friction_per_direction_under_coulombs_law_is_named_on_a_box() {
    let (mut named, mut made) = (0, 0);
    for seed in 0..SEEDS {
        let (mut problem, _) = random(&mut Rand64::new(u128::from(seed) + 5000), Rows::Friction);
        for n in (0..problem.len()).step_by(3) {
            problem.friction[n + 1] = Some((n, 0.5));
            problem.friction[n + 2] = Some((n, 0.2));
        }
        let Some(solution) = problem.solved() else { continue };
        let Some(x) = under_ellipses(&problem, [0.5, 0.2]) else { continue };
        let differs =
            x.iter().zip(&solution).filter(|(a, b)| (*a - *b).abs() > 1e-3 * size(&solution));
        if differs.count() < 3 {
            continue;
        }
        let found = find_mistakes(&ProblemForm::Boxed(problem.lcp()), &x, None);
        let what =
            "the solution with friction under the model coulomb-cone, with both μ of each contact";
        named += usize::from(found.mistakes.iter().any(|own| own.what == what));
        made += 1;
        if made == TIMES {
            break;
        }
    }
    assert_eq!((named, made), (TIMES, TIMES));
}
