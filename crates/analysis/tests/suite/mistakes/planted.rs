//! Every known mistake, made by hand-written code, is recognized.

use lcplab_analysis::diagnosis::{Mistake, MistakeKind, find_mistakes};
use lcplab_lcp::Lcp;
use lcplab_lcp::friction::ProblemForm;
use oorandom::Rand64;

use super::plain::{Clamp, Plain, Rows, random};

/// How often each mistake is made.
const TIMES: u64 = 12;

/// A problem, the answer to the previous step if needed, and the answer that a mistake gives.
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
            | MistakeKind::FirstFriction
            | MistakeKind::LateFriction
            | MistakeKind::OtherNormals
            | MistakeKind::FactorOfMu
            | MistakeKind::OtherLaw
            | MistakeKind::Tangents
    );
    let rows = match kind {
        _ if has_friction => Rows::Friction,
        MistakeKind::FactorOfB | MistakeKind::SignOfBounds => Rows::Contacts,
        MistakeKind::FactorOfX | MistakeKind::MissingBound => Rows::Boxes,
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
    let start = problem.projected(vec![0.0; problem.len()]);
    let rows: Vec<usize> = (0..problem.len()).collect();
    let is_sweep = matches!(kind, MistakeKind::StoppedSweeps | MistakeKind::MissingWarmStart);
    if !is_sweep && (1..=10).any(|k| x == problem.swept(start.clone(), &rows, k, Clamp::InSweep)) {
        return None; // a clamp that never acts, for example
    }
    let solution = problem.solved()?;
    let apart =
        |x: &[f64]| x.iter().zip(&solution).fold(0.0_f64, |most, (a, b)| most.max((a - b).abs()));
    let size = solution.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let needs_last = matches!(
        kind,
        MistakeKind::MissingWarmStart
            | MistakeKind::LastNormals
            | MistakeKind::ScaledWarmStart
            | MistakeKind::MisplacedWarmStart
    );
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
        MistakeKind::ScaledWarmStart => {
            let start = problem.projected(last.iter().map(|x| 0.85 * x).collect());
            return Some(problem.swept(start, &forth, sweeps, Clamp::InSweep));
        }
        MistakeKind::MisplacedWarmStart => {
            let start = problem.projected((0..n).map(|i| last[(i + 1) % n]).collect());
            return Some(problem.swept(start, &forth, sweeps, Clamp::InSweep));
        }
        MistakeKind::ClampedIncrements => return Some(clamped_increments(problem, start, sweeps)),
        MistakeKind::ClampAtEnd => {
            let mut free = problem.clone();
            (free.lo, free.hi) = (vec![f64::NEG_INFINITY; n], vec![f64::INFINITY; n]);
            free.friction = vec![None; n];
            let x = free.swept(start, &forth, sweeps, Clamp::InSweep);
            return Some(problem.projected(x));
        }
        MistakeKind::FirstFriction => {
            let first = problem.swept(start, &forth, 1, Clamp::InSweep);
            return Some(frozen(&first).swept(first, &forth, sweeps, Clamp::InSweep));
        }
        MistakeKind::LateFriction => {
            let late = |x: Vec<f64>| frozen(&x).swept(x, &forth, 1, Clamp::InSweep);
            return Some((0..sweeps).fold(start, |x, _| late(x)));
        }
        MistakeKind::MissingBound => match seed % 4 {
            0 | 1 => changed.lo = vec![f64::NEG_INFINITY; n],
            _ => changed.hi = vec![f64::INFINITY; n],
        },
        MistakeKind::ContactLeftOut => {
            let row = (seed % n as u64) as usize;
            if seed.is_multiple_of(3) {
                let mut x = problem.solved()?;
                x[row] = 0.0;
                return Some(x);
            }
            (changed.lo[row], changed.hi[row]) = (0.0, 0.0);
        }
        MistakeKind::ComplianceLeftOut => {
            // The smallest eigenvalue of a random problem is at least 0.02.
            (0..n).for_each(|i| changed.a[i][i] -= 0.01);
        }
        MistakeKind::FactorOfMu => {
            let change = [|mu: f64| mu * mu, |mu| 2.0 * mu, |mu| 0.8 * mu][(seed % 3) as usize];
            changed.friction.iter_mut().flatten().for_each(|(_, mu)| *mu = change(*mu));
        }
        MistakeKind::OtherNormals => {
            let next = |row: usize| (row + 3) % n;
            changed.friction.iter_mut().flatten().for_each(|(row, _)| *row = next(*row));
        }
        MistakeKind::OtherLaw => return problem.under_coulomb(),
        MistakeKind::OtherRows => {
            let x = problem.solved()?;
            return Some(match seed % 3 {
                0 => (0..n).map(|i| x[(i + 1) % n]).collect(),
                1 => (0..n).map(|i| x[(i + n - 1) % n]).collect(),
                _ => (0..n).map(|i| x[if i < 2 { 1 - i } else { i }]).collect(),
            });
        }
        MistakeKind::Tangents => {
            let mut x = problem.solved()?;
            for contact in x.chunks_mut(3) {
                match seed % 2 {
                    0 => contact.swap(1, 2),
                    _ => contact[2] = -contact[2],
                }
            }
            return Some(x);
        }
        MistakeKind::FactorOfX => {
            return Some(problem.solved()?.iter().map(|x| 0.01 * x).collect());
        }
        MistakeKind::SignOfX => return Some(problem.solved()?.iter().map(|x| -x).collect()),
        MistakeKind::WrongActiveSet => return wrong_active_set(problem, seed),
    }
    changed.solved()
}

/// Sweeps that move each change into the bounds.
fn clamped_increments(problem: &Plain, mut x: Vec<f64>, sweeps: usize) -> Vec<f64> {
    for i in (0..sweeps).flat_map(|_| 0..problem.len()) {
        let change = -problem.w(&x, i) / problem.a[i][i];
        x[i] += problem.clamped(i, change, &x);
    }
    x
}

/// The equations w_i = 0 of some rows, the others at their lower bounds, by sweeps without bounds.
fn wrong_active_set(problem: &Plain, seed: u64) -> Option<Vec<f64>> {
    let mut changed = problem.clone();
    for i in 0..problem.len() {
        let is_free = ((seed + 1) >> i) & 1 == 0 || problem.lo[i].is_infinite();
        (changed.lo[i], changed.hi[i]) = match is_free {
            true => (f64::NEG_INFINITY, f64::INFINITY),
            false => (problem.lo[i], problem.lo[i]),
        };
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

/// Where two mistakes give the same x, either name is right; each must be named often by its own.
#[test]
fn every_known_mistake_is_named_where_it_was_made() {
    let mut missed = Vec::new();
    for kind in MistakeKind::ALL {
        let mut named = 0;
        let made = (0..40 * TIMES).filter_map(|seed| Some((seed, planted(kind, seed)?)));
        for (seed, (problem, last, x)) in made {
            let lcp: Lcp = problem.lcp();
            let found = find_mistakes(&ProblemForm::Boxed(lcp.clone()), &x, last.as_deref());
            let is_same = |own: &Mistake| own.distance <= 1e-14;
            if found.mistakes.iter().any(|own| own.kind == kind) {
                named += 1;
            } else if !found.mistakes.iter().any(is_same) {
                missed.push((kind, seed, lcp.len(), x, found));
            }
            if named == TIMES {
                break;
            }
        }
        assert_eq!(named, TIMES, "{kind:?} was not named often enough");
    }
    assert!(missed.is_empty(), "{} missed: {:#?}", missed.len(), &missed[..missed.len().min(2)]);
}

/// Under Coulomb's cone, mistakes made by hand-written code are named.
#[test]
fn mistakes_with_cones_are_named() {
    use lcplab_lcp::friction::{ConeProblem, FrictionProblem, Law};
    type Change = fn(&Plain) -> Option<Vec<f64>>;
    type Maker<'a> = dyn Fn(&Plain) -> Option<Vec<f64>> + 'a;
    let changed = |problem: &Plain, change: &dyn Fn(&mut Plain)| {
        let mut changed = problem.clone();
        change(&mut changed);
        changed.under_coulomb()
    };
    let made: [(MistakeKind, &Maker<'_>); 8] = [
        (MistakeKind::OtherLaw, &(Plain::solved as Change)),
        (MistakeKind::SignOfB, &|own| changed(own, &|own| own.b.iter_mut().for_each(|b| *b = -*b))),
        (MistakeKind::FactorOfB, &|own| {
            changed(own, &|own| own.b.iter_mut().for_each(|b| *b *= 60.0))
        }),
        (MistakeKind::FactorOfMu, &|own| {
            changed(own, &|own| own.friction.iter_mut().flatten().for_each(|f| f.1 *= 1.5))
        }),
        (MistakeKind::FrictionLeftOut, &|own| {
            changed(own, &|own| own.friction.iter_mut().flatten().for_each(|f| f.1 = 0.0))
        }),
        (MistakeKind::ContactLeftOut, &|own| {
            let mut x = own.under_coulomb()?;
            x[..3].fill(0.0);
            Some(x)
        }),
        (MistakeKind::Tangents, &|own| {
            let mut x = own.under_coulomb()?;
            x.chunks_mut(3).for_each(|contact| contact.swap(1, 2));
            Some(x)
        }),
        (MistakeKind::OtherRows, &|own| {
            let mut x = own.under_coulomb()?;
            x.rotate_left(3);
            Some(x)
        }),
    ];
    let mut missed = Vec::new();
    for (kind, make) in made {
        let mut times = 0;
        for seed in 0..40 * TIMES {
            let (problem, _) = random(&mut Rand64::new(u128::from(seed) + 1000), Rows::Friction);
            let (Some(solution), Some(x)) = (problem.under_coulomb(), make(&problem)) else {
                continue;
            };
            let size = solution.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
            let differs = x.iter().zip(&solution).filter(|(a, b)| (*a - *b).abs() > 1e-3 * size);
            if differs.count() < 3 {
                continue;
            }
            let friction = FrictionProblem::of(&problem.lcp()).unwrap();
            let posed = ProblemForm::Cone(ConeProblem::new(friction, Law::Coulomb));
            let found = find_mistakes(&posed, &x, None);
            if !found.mistakes.iter().any(|own| own.kind == kind) {
                missed.push((kind, seed, x, solution, found));
            }
            times += 1;
            if times == TIMES {
                break;
            }
        }
        assert_eq!(times, TIMES, "{kind:?} was not made often enough");
    }
    assert!(missed.is_empty(), "{} missed: {:#?}", missed.len(), &missed[..missed.len().min(3)]);
}
