//! An answer that no mistake produced is not attributed to one.

use lcplab_analysis::diagnosis::find_mistakes;
use lcplab_lcp::friction::{ConeProblem, FrictionProblem, Law, ProblemForm};
use oorandom::Rand64;

use super::plain::{Rows, random};

/// The number of answers that are tried.
const ANSWERS: u64 = 600;

/// How an answer differs from the solution.
#[derive(Debug, Clone, Copy)]
enum Departure {
    /// Every entry by a random part of this.
    Noise(f64),
    /// One entry by this amount.
    OneEntry(f64),
    /// Every entry by its own rounding.
    Dust,
}

/// How the numbers of an answer are written.
#[derive(Debug, Clone, Copy)]
enum Written {
    Double,
    Single,
    Decimals(i32),
}

fn answer(
    random: &mut Rand64,
    solution: &[f64],
    departure: Departure,
    written: Written,
) -> Vec<f64> {
    let size = solution.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let chosen = random.rand_range(0..solution.len() as u64) as usize;
    let mut part = || 2.0 * random.rand_float() - 1.0;
    let moved = |i: usize, x: f64, part: f64| match departure {
        Departure::Noise(most) => x + most * size * part,
        Departure::OneEntry(by) => x + if i == chosen { by * size * part.signum() } else { 0.0 },
        Departure::Dust => x + 1e-15 * size * part,
    };
    let rounded = |x: f64| match written {
        Written::Double => x,
        Written::Single => f64::from(x as f32),
        Written::Decimals(count) => (x * 10f64.powi(count)).round() / 10f64.powi(count),
    };
    solution.iter().enumerate().map(|(i, &x)| rounded(moved(i, x, part()))).collect()
}

#[test]
fn no_mistake_is_named_for_answers_that_chance_made() {
    let mut accused = Vec::new();
    for seed in 0..ANSWERS {
        let mut generator = Rand64::new(u128::from(seed));
        let rows = [Rows::Contacts, Rows::Boxes, Rows::Friction][(seed % 3) as usize];
        let (problem, solution) = random(&mut generator, rows);
        let size = 10f64.powf(-7.0 + 4.0 * generator.rand_float());
        let departure = match (seed / 3) % 5 {
            0 | 1 => Departure::Noise(size),
            2 | 3 => Departure::OneEntry(size),
            _ => Departure::Dust,
        };
        let written = match (seed / 15) % 6 {
            0..=2 => Written::Double,
            3 => Written::Single,
            _ => Written::Decimals(2 + (seed % 7) as i32),
        };
        let x = answer(&mut generator, &solution, departure, written);
        let found = find_mistakes(&ProblemForm::Boxed(problem.lcp()), &x, None);
        if !found.mistakes.is_empty() {
            accused.push((seed, departure, written, x, found));
        }
    }
    assert!(accused.is_empty(), "{} of {ANSWERS}: {:#?}", accused.len(), accused.first());
}

/// The same for answers near a solution under a polygon and under Coulomb's cone.
#[test]
fn no_mistake_is_named_for_answers_under_other_laws_that_chance_made() {
    let mut accused = Vec::new();
    let mut tried = 0;
    for seed in 0..ANSWERS / 2 {
        let mut generator = Rand64::new(u128::from(seed) + 77);
        let (problem, _) = random(&mut generator, Rows::Friction);
        let Some(solution) = problem.under_coulomb() else { continue };
        let size = 10f64.powf(-7.0 + 4.0 * generator.rand_float());
        let departure = match seed % 3 {
            0 => Departure::Noise(size),
            1 => Departure::OneEntry(size),
            _ => Departure::Dust,
        };
        let written = match (seed / 3) % 4 {
            0 | 1 => Written::Double,
            2 => Written::Single,
            _ => Written::Decimals(2 + (seed % 7) as i32),
        };
        let x = answer(&mut generator, &solution, departure, written);
        let friction = FrictionProblem::of(&problem.lcp()).unwrap();
        let posed = ProblemForm::Cone(ConeProblem::new(friction, Law::Coulomb));
        let last: Vec<f64> = solution.iter().map(|x| x * (0.5 + generator.rand_float())).collect();
        for last in [None, Some(&last[..])] {
            let found = find_mistakes(&posed, &x, last);
            if !found.mistakes.is_empty() {
                accused.push((seed, departure, written, x.clone(), found));
            }
        }
        tried += 1;
    }
    assert!(tried > 200, "{tried}");
    assert!(accused.is_empty(), "{} of {tried}: {:#?}", accused.len(), accused.first());
}
