//! The code, the formulas and the claims of the chapter.

mod claims;
mod cli;
mod code;
mod code08_to_11;
mod constraints;
mod exhibit;
mod formulation;
mod inventory;
mod iterations;
mod problem;
mod step;
mod storage;

use lcplab::chapter::exhibit::{Measure, Outcome, named};

/// The measure of this name in an exhibit.
fn measure(id: &str, quantity: &str) -> Measure {
    let finding = named(id).unwrap().found().unwrap().unwrap();
    let found = finding.measures.into_iter().find(|measure| measure.quantity == quantity);
    found.unwrap_or_else(|| panic!("{id} measures no {quantity:?}"))
}

/// The numbers of a form.
fn numbers(outcome: &Outcome) -> &[f64] {
    match outcome {
        Outcome::Numbers(values) => values,
        Outcome::Impossible(reason) => panic!("no numbers: {reason}"),
    }
}

/// The printed and the corrected number of a measure with one number.
fn both(id: &str, quantity: &str) -> [f64; 2] {
    let measure = measure(id, quantity);
    [numbers(&measure.printed)[0], numbers(&measure.corrected)[0]]
}

/// What both forms give.
fn outcomes(id: &str, quantity: &str) -> [Outcome; 2] {
    let measure = measure(id, quantity);
    [measure.printed, measure.corrected]
}

fn assert_near(found: f64, expected: f64, tolerance: f64) {
    assert!((found - expected).abs() <= tolerance, "{found} is not {expected}");
}
