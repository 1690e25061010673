//! Benchmarks 4.2: one LCP, five costs.

use lcplab::report::page::Mark;
use lcplab::report::study::Study;
use lcplab::report::study::worst_cases::{Finding, Law, Plan, run};
use lcplab::report::view::Document;

use super::standard;

#[test]
fn fathis_matrix_costs_what_is_published() {
    let study = run(&[4, 6, 8, 10]).unwrap();
    let costs = |solver: &str, favourable: bool| {
        let case = study.cases.iter().find(|case| {
            case.solver == solver && case.matrix == "fathi" && case.favourable == favourable
        });
        case.unwrap().costs.iter().map(|cost| cost.unwrap()).collect::<Vec<_>>()
    };
    for (solver, best, worst) in [
        ("pgs", 1, [2, 2, 2, 2]),
        ("dantzig", 1, [13, 31, 57, 91]),
        ("murty", 1, [15, 63, 255, 1023]),
        ("lemke", 2, [16, 64, 256, 1024]),
        ("enumeration", 2, [9, 33, 129, 513]),
    ] {
        assert_eq!(costs(solver, true), [best; 4], "{solver}");
        assert_eq!(costs(solver, false), worst, "{solver}");
    }
}

#[test]
fn every_case_follows_its_law() {
    let study = run(&[2, 3, 5, 7]).unwrap();
    for case in &study.cases {
        assert!(case.agrees(&study.sizes), "{case:?}");
    }
    assert!(study.cases.iter().any(|case| case.matrix == "murty-exponential"), "and without ties");
}

#[test]
fn a_law_is_a_number_for_each_n() {
    let laws = [Law::One, Law::Two, Law::Quadratic, Law::PlaceOfLast, Law::AllButOne, Law::All];
    assert_eq!(laws.map(|law| law.cost(12)), [1, 2, 133, 2049, 4095, 4096]);
}

#[test]
fn a_method_that_refuses_has_no_cost() {
    // Enumeration takes 16 contacts at most.
    let study = run(&[1, 17]).unwrap();
    let case = study.cases.iter().find(|case| case.solver == "enumeration").unwrap();
    assert_eq!(case.costs[1], None);
    assert!(!case.agrees(&study.sizes));
}

#[test]
fn a_size_that_the_library_does_not_have_is_an_error() {
    let error = run(&[0]).unwrap_err().to_string();
    assert!(error.contains("n: must lie in 1 … 50, is 0"), "{error}");
}

#[test]
fn the_table_says_where_a_count_is_not_the_formula() {
    let plan = Plan { sizes: vec![2, 4] };
    let mut study = plan.run(0).unwrap().0;
    let marks = |study: &Finding| {
        let document = Document::of(&plan, std::slice::from_ref(study));
        let rows = standard::table(&document, "worst_cases").rows;
        let bad = |cell: &&lcplab::report::page::Cell| cell.mark == Mark::Bad;
        rows[0].iter().filter(bad).map(|cell| cell.text.clone()).collect::<Vec<_>>()
    };
    assert!(marks(&study).is_empty());
    study.cases[0].costs = vec![None, Some(7)];
    assert_eq!(marks(&study), ["failed", "7", "differs"]);
}
