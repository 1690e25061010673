use std::collections::HashSet;

use lcplab::report::results::Results;
use lcplab::report::study::storage::claims::Verdict;
use lcplab::report::study::storage::{Finding, Plan, memory};
use lcplab::report::view;

use super::standard::{experiment, run_all};

/// The study on matrices that take milliseconds.
const SMALL: &str = r#"
title = "storage"
lead = "Small."
[[section]]
study = "storage"
size = 20
fills = [1.0, 10.0, 100.0]
stacks = [2]
structures = [{ scene = "stack", step = 1 }, { scene = "net", step = 1 }]
steps = { scene = "fig7", steps = 3 }
factors = [{ scene = "chain", step = 1 }, { scene = "stack", step = 1 }]
pictures = { only = ["fig7", "free_fall", "bricard"] }
[[section]]
title = "Limits"
text = "Many."
"#;

fn results() -> Results {
    run_all(&experiment(SMALL).unwrap())
}

fn study() -> Finding {
    results().findings::<Plan>().unwrap().remove(0)
}

#[test]
fn all_but_the_times_are_the_same_in_every_run() {
    assert_eq!(study(), study());
}

#[test]
fn a_report_on_storages_is_a_page_of_its_own() {
    let results = results();
    assert!(results.is_good().unwrap());
    let structures = &results.findings::<Plan>().unwrap()[0].structures;
    assert!(structures.iter().all(|structure| structure.agree == Some(true)));
    assert!(!results.summary().unwrap().contains("closed forms"));
    let text = serde_json::to_string(&results).unwrap();
    let back: Results = serde_json::from_str(&text).unwrap();
    let document = view::document(&results).unwrap();
    assert_eq!(
        view::document(&back).unwrap().page.render().unwrap(),
        document.page.render().unwrap()
    );
    let sections: Vec<&str> = document.page.sections.iter().map(|s| s.id.as_str()).collect();
    assert_eq!(sections.first(), Some(&"claims"));
    assert!(sections.contains(&"limits"));
    assert_eq!(sections.last(), Some(&"times"));
    // Each has a CSV of its own.
    let figures = document.figures.iter().map(|figure| figure.id().to_string());
    let names: Vec<String> =
        figures.chain(document.tables.iter().map(|(id, _)| id.clone())).collect();
    assert_eq!(names.iter().collect::<HashSet<_>>().len(), names.len(), "{names:?}");
}

#[test]
fn break_even_is_the_ratio_of_a_number_to_an_entry() {
    let memory = memory::run(20, &[50.0]).unwrap();
    let of = |name: &str| memory.iter().find(|m| m.storage == name).unwrap();
    // 400 numbers of 8 bytes. List: 24 k > 3200 from 134 on; compressed rows 12 k + 84 from 260.
    assert_eq!(of("linked list").break_even, Some(100.0 * 134.0 / 400.0));
    assert_eq!(of("compressed rows").break_even, Some(100.0 * 260.0 / 400.0));
    assert_eq!(of("dense").break_even, None);
    assert_eq!(of("linked list").points[0].bytes, 200 * 24);
}

#[test]
fn numbers_that_make_no_matrix_are_refused() {
    let message = |size, fills: &[f64]| memory::run(size, fills).unwrap_err().to_string();
    assert_eq!(message(0, &[]), "storage: size: must be 1 to 10000, is 0");
    assert_eq!(message(5, &[1.0, 120.0]), "storage: fills: must be 0 to 100 %, is 120");
}

#[test]
fn each_claim_that_errs_has_its_erratum_and_the_net_is_as_empty_as_printed() {
    let claims = study().claims;
    for claim in &claims {
        assert!(claim.holds() == claim.erratum.is_empty() || claim.verdict == Verdict::Conditional);
    }
    for erratum in ["E50", "E54", "E56", "E57"] {
        assert!(claims.iter().any(|claim| claim.erratum == erratum && !claim.holds()), "{erratum}");
    }
    let net = claims.iter().find(|claim| claim.says.contains("net")).unwrap();
    // 684 rods of 19 × 19 points: 4568 of 467 856 pairs share a point.
    assert!(
        net.holds() && net.found.contains("below 1 % from 19 × 19 on (0.98 %)"),
        "{}",
        net.found
    );
}

#[test]
fn matrices_that_are_kept_ask_for_nothing_once_warm() {
    let steps = study().steps.unwrap();
    assert_eq!(steps.rows, [3, 3, 3]);
    for count in &steps.counts {
        let frees_nodes = count.storage == "map of maps";
        assert_eq!(count.warm == 0.0, !frees_nodes, "{}", count.storage);
        assert!(count.warm <= count.first && count.first < count.anew, "{}", count.storage);
    }
}

#[test]
fn factors_and_pictures_are_those_of_the_scenes() {
    let study = study();
    let chain = &study.factors[0];
    for ordered in &chain.ordered {
        assert_eq!(ordered.entries, chain.lower, "a chain has no fill: {}", ordered.ordering);
    }
    let rows: Vec<usize> = study.pictures.iter().map(|picture| picture.raster.rows).collect();
    let mut named: Vec<(&str, usize)> =
        study.pictures.iter().map(|picture| picture.scene.as_str()).zip(rows).collect();
    named.sort_unstable();
    assert_eq!(named, [("bricard", 30), ("fig7", 3), ("free_fall", 0)]);
    let fig7 = study.pictures.iter().find(|picture| picture.scene == "fig7").unwrap();
    assert_eq!(fig7.raster.cells, ["44", "444", "044"]); // three balls: tridiagonal
}
