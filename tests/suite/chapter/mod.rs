//! The museum of the chapter.

mod claims;
mod cli;
mod exhibit;
mod formulation;
mod inventory;
mod problem;

use lcplab::chapter::exhibit::{Outcome, named};

/// What the printed and the corrected form give for this quantity of an exhibit.
fn outcomes(id: &str, quantity: &str) -> [Outcome; 2] {
    let finding = named(id).unwrap().found().unwrap();
    let measure = finding.measures.iter().find(|measure| measure.quantity == quantity);
    let measure = measure.unwrap_or_else(|| panic!("{id} measures no {quantity:?}"));
    [measure.printed.clone(), measure.corrected.clone()]
}

/// The first number of both.
fn numbers(id: &str, quantity: &str) -> [f64; 2] {
    outcomes(id, quantity).map(|outcome| match outcome {
        Outcome::Numbers(values) => values[0],
        Outcome::Impossible(_) => f64::NAN,
    })
}

fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} is not {expected}");
}
