//! Every known mistake, made by hand-written code, is recognized.

use lcplab_problem::Lcp;
use lcplab_study::diagnosis::{MistakeKind, find_mistakes};
use oorandom::Rand64;

use super::plain::{Clamp, Plain, Rows, random};

/// How often each mistake is made.
const TIMES: u64 = 12;

/// A problem, the answer of the previous frame if needed, and the answer that a mistake gives.
type Planted = (Plain, Option<Vec<f64>>, Vec<f64>);

/// Makes a mistake in a random problem; `None` if it changes nothing there, or cannot be made.
fn planted(kind: MistakeKind, seed: u64) -> Option<Planted> {
    let mut generator = Rand64::new(u128::from(seed) + 1000);
    let has_friction = matches!(
        kind,
        MistakeKind::FrictionLeftOut
            | MistakeKind::UnlimitedFriction
            | MistakeKind::FrictionlessNormals
            | MistakeKind::LastNormals
    );
    let rows = match kind {
        _ if has_friction => Rows::Friction,
        MistakeKind::FactorOfB | MistakeKind::SignOfBounds => Rows::Contacts,
        _ => [Rows::Contacts, Rows::Boxes][(seed % 2) as usize],
    };
    let (mut problem, _) = random(&mut generator, rows);
    if kind == MistakeKind::Transposed {
        // Skew and diagonally dominant: sweeps converge, and the transpose has other solutions.
        for i in 0..problem.len() {
            for j in 0..i {
                (problem.a[i][j], problem.a[j][i]) = (problem.a[i][j] + 0.2, problem.a[j][i] - 0.2);
            }
            problem.a[i][i] += 1.0 + problem.a[i].iter().map(|a| a.abs()).sum::<f64>();
        }
    }
    let sweeps = 1 + (seed % 9) as usize;
    let last: Vec<f64> = (0..problem.len()).map(|_| generator.rand_float()).collect();
    let x = answer(kind, &problem, &last, sweeps, seed)?;
    let solution = problem.solved()?;
    let apart =
        |x: &[f64]| x.iter().zip(&solution).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
    let size = solution.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let needs_last = matches!(kind, MistakeKind::MissingWarmStart | MistakeKind::LastNormals);
    // With 32-bit numbers more entries are needed to rule out chance.
    let (part, entries) = if kind == MistakeKind::SinglePrecision { (0.02, 4) } else { (1e-4, 2) };
    let differs = x.iter().zip(&solution).filter(|(a, b)| (*a - *b).abs() > part * size).count();
    let is_wrong = apart(&x) > 1e-3 * size && differs >= entries;
    is_wrong.then_some((problem, needs_last.then_some(last), x))
}

/// The answer of one mistake.
fn answer(
    kind: MistakeKind,
    problem: &Plain,
    last: &[f64],
    sweeps: usize,
    seed: u64,
) -> Option<Vec<f64>> {
    let n = problem.len();
    let (forth, back): (Vec<usize>, Vec<usize>) = ((0..n).collect(), (0..n).rev().collect());
    let start: Vec<f64> = (0..n).map(|i| problem.clamped(i, 0.0, &vec![0.0; n])).collect();
    let mut changed = problem.clone();
    let negative = |v: &[f64]| -> Vec<f64> { v.iter().map(|v| -v).collect() };
    let frozen = |normals: &[f64]| {
        let mut frozen = problem.clone();
        for i in 0..n {
            if let Some((row, mu)) = frozen.friction[i].take() {
                (frozen.lo[i], frozen.hi[i]) = (-mu * normals[row], mu * normals[row]);
            }
        }
        frozen
    };
    match kind {
        MistakeKind::NothingDone => return Some(start),
        MistakeKind::StoppedSweeps => {
            let there_and_back = [forth.clone(), back.clone()].concat();
            let rows = [forth, back, there_and_back][(seed % 3) as usize].clone();
            return Some(problem.swept(start, &rows, sweeps, Clamp::InSweep));
        }
        MistakeKind::MissingWarmStart => {
            return Some(problem.swept(start, &forth, sweeps, Clamp::InSweep));
        }
        MistakeKind::Jacobi => return Some(problem.all_at_once(start, sweeps)),
        MistakeKind::LateClamp => {
            return Some(problem.swept(start, &forth, sweeps, Clamp::AfterSweep));
        }
        MistakeKind::SinglePrecision => return Some(single(problem, &start, sweeps)),
        MistakeKind::SignOfB => changed.b = negative(&problem.b),
        MistakeKind::FactorOfB => {
            let factor = [60.0, 1.0 / 60.0, 0.5, 1.02][(seed % 4) as usize];
            changed.b.iter_mut().for_each(|b| *b *= factor);
        }
        MistakeKind::Transposed => {
            for i in 0..n {
                for j in 0..n {
                    changed.a[i][j] = problem.a[j][i];
                }
            }
        }
        MistakeKind::SignOfBounds => {
            (changed.lo, changed.hi) = (negative(&problem.hi), negative(&problem.lo));
        }
        MistakeKind::UnboundedRow => {
            let row = (seed % n as u64) as usize;
            (changed.lo[row], changed.hi[row]) = (f64::NEG_INFINITY, f64::INFINITY);
        }
        MistakeKind::Compliance => {
            let softness = [1e-2, 0.1, 1.0][(seed % 3) as usize];
            (0..n).for_each(|i| changed.a[i][i] += softness);
        }
        MistakeKind::FrictionLeftOut => changed = frozen(&vec![0.0; n]),
        MistakeKind::UnlimitedFriction => changed = frozen(&vec![f64::INFINITY; n]),
        MistakeKind::FrictionlessNormals => {
            changed = frozen(&frozen(&vec![0.0; n]).solved()?);
        }
        MistakeKind::LastNormals => changed = frozen(last),
    }
    changed.solved()
}

/// Gauss-Seidel in 32-bit numbers.
fn single(problem: &Plain, start: &[f64], sweeps: usize) -> Vec<f64> {
    let mut x: Vec<f32> = start.iter().map(|&x| x as f32).collect();
    let n = x.len();
    for i in (0..sweeps).flat_map(|_| 0..n) {
        let terms = problem.a[i].iter().zip(&x);
        let w = terms.fold(problem.b[i] as f32, |sum, (&a, x)| sum + a as f32 * x);
        let value = x[i] - w / problem.a[i][i] as f32;
        x[i] = value.max(problem.lo[i] as f32).min(problem.hi[i] as f32);
    }
    x.into_iter().map(f64::from).collect()
}

#[test]
fn every_known_mistake_is_named_where_it_was_made() {
    let mut missed = Vec::new();
    for kind in MistakeKind::ALL {
        let made: Vec<(u64, Planted)> = (0..40 * TIMES)
            .filter_map(|seed| Some((seed, planted(kind, seed)?)))
            .take(TIMES as usize)
            .collect();
        assert_eq!(made.len(), TIMES as usize, "{kind:?} was not made often enough");
        for (seed, (problem, last, x)) in made {
            let lcp: Lcp = problem.lcp();
            let found = find_mistakes(&lcp, &x, last.as_deref());
            if !found.mistakes.iter().any(|own| own.kind == kind) {
                missed.push((kind, seed, lcp.len(), x, found));
            }
        }
    }
    assert!(missed.is_empty(), "{} missed: {:#?}", missed.len(), &missed[..missed.len().min(3)]);
}
