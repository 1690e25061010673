//! Every closed form at the fast size, and that the page can fail.

use lcplab::report::study::verification::{Criterion, Plan, Row, Sample, Size, names, run};
use lcplab::report::view::{ReportPage, View};

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
    let plan: Plan = serde_json::from_str("{\"size\": \"fast\"}").unwrap();
    let found = STANDARD.findings::<Plan>().unwrap();
    let document = ReportPage::of(&plan, &found);
    let (_, table) = document.tables.iter().find(|(id, _)| id == "closed_forms").unwrap();
    let rows = found.concat();
    assert_eq!(table.rows.len(), rows.len());
    // LaTeX that cannot be set is an error.
    let html = document.page.render().unwrap().replace('\u{a0}', " ");
    for row in &rows {
        let mut between_quotes = row.quantity.split(['"', '\'']);
        assert!(between_quotes.all(|words| html.contains(words)), "{}", row.quantity);
    }
}

#[test]
fn the_answer_says_that_all_numbers_agree_or_names_those_that_do_not() {
    let plan: Plan = serde_json::from_str("{\"size\": \"fast\"}").unwrap();
    let exact = || Criterion::Exact { tolerance: 1e-9, because: "rounding".into() };
    let good = row(2.0, [2.0; 3], exact());
    let wrong = Row { quantity: "height".into(), ..row(2.0, [2.0, 2.5, 2.0], exact()) };
    let answer = |rows: &[&Row]| {
        let rows: Vec<Row> = rows.iter().map(|row| (*row).clone()).collect();
        plan.headline(&[rows]).answer.unwrap()
    };
    let passed = answer(&[&good, &good]);
    assert!(
        passed.starts_with("**All 2 numbers agree with their closed forms:** 2 up to rounding")
    );
    assert_eq!(
        answer(&[&good, &wrong]),
        "**Failed: 1 of 2 numbers.** The first: *case* (velocity), height, error 0.25 instead of at most 10⁻⁹."
    );
    let page = ReportPage::of(&plan, &[vec![good, wrong]]);
    let (_, failed) = page.tables.iter().find(|(id, _)| id == "failed").unwrap();
    let texts: Vec<&str> = failed.rows[0].iter().map(|cell| cell.text.as_str()).collect();
    assert_eq!(texts, ["case", "velocity", "height", "error 0.25", "10⁻⁹"]); // |2.5 - 2| / 2
    assert_eq!(failed.rows.len(), 1);
}

#[test]
fn formulas_are_in_the_list_and_the_csv_but_not_in_a_column_of_the_page() {
    let plan: Plan = serde_json::from_str("{\"size\": \"fast\"}").unwrap();
    let second = [1.0 + 0.16, 1.0 + 0.04, 1.0 + 0.01];
    let page = ReportPage::of(&plan, &[vec![row(1.0, second, Criterion::Order(2.0))]]);
    let (_, table) = page.tables.iter().find(|(id, _)| id == "closed_forms").unwrap();
    assert!(table.csv().lines().next().unwrap().ends_with(",formula"));
    let html = page.page.render().unwrap();
    assert!(html.contains("The closed forms") && !html.contains(">formula</th>"));
}
