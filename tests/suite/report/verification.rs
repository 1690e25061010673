//! Every closed form at the fast size, and that the page can fail.

use lcplab::report::study::verification::{Criterion, Plan, Row, Sample, Size, names, run};
use lcplab::report::view;

use super::reference::STANDARD;

#[test]
fn every_closed_form_comes_out_at_its_order() {
    let rows = STANDARD.findings::<Plan>().unwrap().concat();
    let failed: Vec<String> = rows
        .iter()
        .filter(|row| !row.passes())
        .map(|row| {
            let Row { case, method, quantity, .. } = row;
            let (errors, order) = (row.errors(), row.observed_order());
            format!("{case}, {method}, {quantity}: errors {errors:?}, order {order}")
        })
        .collect();
    assert!(failed.is_empty(), "{failed:#?}");
    for name in names() {
        assert!(rows.iter().any(|row| row.case == name), "{name} has no rows");
    }
}

fn row(expected: f64, measured: [f64; 3], criterion: Criterion) -> Row {
    let samples = [0.4, 0.2, 0.1].into_iter().zip(measured);
    Row {
        case: "case".into(),
        scene: "scene".into(),
        method: "velocity".into(),
        quantity: "quantity".into(),
        formula: "f".into(),
        latex: "f".into(),
        unit: "m".into(),
        expected,
        samples: samples.map(|(dt, measured)| Sample { dt, measured }).collect(),
        criterion,
    }
}

#[test]
fn a_row_passes_at_its_order_and_at_no_other() {
    let second = [1.0 + 0.16, 1.0 + 0.04, 1.0 + 0.01];
    for (order, passes) in [(1.0, false), (2.0, true), (4.0, false)] {
        let row = row(1.0, second, Criterion::Order(order));
        assert!((row.observed_order() - 2.0).abs() < 1e-9);
        assert_eq!(row.passes(), passes, "order {order}");
    }
    // A wrong constant, a failed run, and errors that are all rounding have no order.
    for measured in [second.map(|x| x + 1.0), [1.16, 1.04, f64::NAN], [1.0; 3]] {
        assert!(!row(1.0, measured, Criterion::Order(2.0)).passes(), "{measured:?}");
    }
}

#[test]
fn an_exact_row_fails_if_one_step_length_misses() {
    let exact = |tolerance| Criterion::Exact { tolerance, because: "rounding".into() };
    assert!(row(2.0, [2.0, 2.0 + 1e-9, 2.0], exact(1e-9)).passes());
    assert!(!row(2.0, [2.0 + 1e-6, 2.0, 2.0], exact(1e-9)).passes());
    assert!(!row(2.0, [2.0, 2.0, f64::NAN], exact(1e-9)).passes());
    assert!(row(0.0, [1e-10, 0.0, 0.0], exact(1e-9)).passes());
}

#[test]
fn a_case_that_does_not_exist_is_refused_with_those_that_do() {
    let message = run(Size::Fast, Some("pendulm")).unwrap_err().to_string();
    assert!(message.starts_with("there is no closed form named \"pendulm\""), "{message}");
    assert!(message.contains("such as pendulum, "), "{message}");
}

#[test]
fn the_page_sets_every_formula_and_shows_every_row() {
    let document = view::document(&STANDARD).unwrap();
    let (_, table) = document.tables.iter().find(|(id, _)| id == "closed_forms").unwrap();
    let rows = STANDARD.findings::<Plan>().unwrap().concat();
    assert_eq!(table.rows.len(), rows.len());
    let html = document.page.render().unwrap(); // LaTeX that cannot be set is an error
    for row in &rows {
        let mut between_quotes = row.quantity.split(['"', '\'']);
        assert!(between_quotes.all(|words| html.contains(words)), "{}", row.quantity);
    }
}
