use lcplab::lcp::library::{self, Family};
use lcplab::report::study::families::{KNOWN_FAILURES, Row, run};
use lcplab::solver::{ALL, Options, by_name, entry};

fn rows() -> Vec<Row> {
    let families: Vec<&dyn Family> = library::all().collect();
    run(&families, ALL, &Options::default(), 2)
}

#[test]
fn no_claim_on_the_whole_library_is_refuted_or_false() {
    for row in rows() {
        assert!(!row.is_wrong(), "{row:?}");
        assert!(row.worst_residual <= Options::default().settings.tolerance, "{row:?}");
    }
}

#[test]
fn known_failures_name_solvers_and_families_that_exist_and_happen() {
    let rows = rows();
    for (solver, family, why) in KNOWN_FAILURES {
        assert!(by_name(solver, &Options::default()).is_ok());
        let row = rows.iter().find(|row| row.solver == *solver && row.family == *family);
        let row = row.unwrap_or_else(|| panic!("no row for {solver} on {family}"));
        assert_eq!((row.claimed, row.known_failure.as_deref()), (0, Some(*why)));
    }
}

#[test]
fn dantzig_solves_every_symmetric_semidefinite_family_that_has_a_solution() {
    let names = [
        "manufactured",
        "pd",
        "fathi",
        "hilbert",
        "stack",
        "table",
        "near-duplicate",
        "contact-graph",
        "cps-1",
        "cps-5",
        "trivial",
        "mcp09",
    ];
    let families: Vec<&dyn Family> =
        names.iter().map(|name| library::by_name(name).unwrap()).collect();
    for row in run(&families, &[*entry("dantzig").unwrap()], &Options::default(), 3) {
        assert_eq!((row.claimed, row.accepted), (row.problems, row.problems), "{row:?}");
    }
}
