//! The museum of the chapter.

mod code08_to_11;
mod constraints;
mod exhibit;
mod formulation;
mod iterations;
mod problem;
mod storage;

use lcplab::chapter::exhibit::{Measure, Outcome, named};

/// The measure of this name in an exhibit.
fn measure(id: &str, quantity: &str) -> Measure {
    let finding = named(id).unwrap().found().unwrap();
    let found = finding.measures.into_iter().find(|measure| measure.quantity == quantity);
    found.unwrap_or_else(|| panic!("{id} measures no {quantity:?}"))
}

/// What the printed and the corrected form give for this quantity of an exhibit.
fn outcomes(id: &str, quantity: &str) -> [Outcome; 2] {
    let measure = measure(id, quantity);
    [measure.printed, measure.corrected]
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
