use lcplab::lcp::friction::Model;
use lcplab::lcp::library::{self, Family};
use lcplab::report::methods::with_reference;
use lcplab::report::study::families::{KNOWN_FAILURES, Row, run};
use lcplab::solver::{Method, Options, Registry, Stop};

fn methods() -> Vec<Method> {
    with_reference().methods().cloned().collect()
}

fn rows() -> Vec<Row> {
    let families: Vec<&dyn Family> = library::all().collect();
    run(&families, &Model::ALL, &methods(), &Options::default(), 2, &Stop::default())
}

fn rows_of(names: &[&str]) -> Vec<Row> {
    let families: Vec<&dyn Family> =
        names.iter().map(|name| library::by_name(name).unwrap()).collect();
    run(&families, &Model::ALL, &methods(), &Options::default(), 3, &Stop::default())
}

const FRICTION: [&str; 4] = ["pushed-mass", "pushed-rod", "friction-table", "friction-pile"];

#[test]
fn no_claim_on_the_whole_library_is_refuted_or_false() {
    for row in rows() {
        assert!(!row.is_wrong(), "{row:?}");
        assert_eq!(row.worst_residual.is_some(), row.claimed > 0, "{row:?}");
        let worst = row.worst_residual.unwrap_or(0.0);
        assert!(worst <= Options::default().settings.tolerance, "{row:?}");
    }
}

#[test]
fn known_failures_name_solvers_and_families_that_exist_and_happen() {
    let rows = rows();
    for (solver, family, why) in KNOWN_FAILURES {
        assert!(Registry::standard().entry(solver).is_ok());
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
    let dantzig = [Method::Boxed(Registry::standard().entry("dantzig").unwrap().clone())];
    for row in run(&families, &[], &dantzig, &Options::default(), 3, &Stop::default()) {
        assert_eq!((row.claimed, row.accepted), (row.problems, row.problems), "{row:?}");
    }
}

#[test]
fn friction_families_run_under_every_model_by_every_method_that_takes_it() {
    let rows = rows_of(&FRICTION);
    let (taking, per_family) = (methods(), rows.len() / FRICTION.len());
    let takes = |model: Model| taking.iter().filter(|method| method.takes(Some(model))).count();
    assert_eq!(per_family, Model::ALL.into_iter().map(takes).sum::<usize>());
    for model in Model::ALL.map(|model| model.to_string()) {
        for family in FRICTION {
            // Some method solves every problem of the family, in the eyes of the model's judge.
            let mut of_this =
                rows.iter().filter(|r| r.model.as_ref() == Some(&model) && r.family == family);
            let solved = |row: &Row| row.accepted == row.problems && row.claimed == row.problems;
            assert!(of_this.any(solved), "{family}, {model}");
        }
    }
}

#[test]
fn boxes_cones_and_polygons_with_exact_corners_are_proved_other_polygons_accepted() {
    for row in rows_of(&["pushed-mass", "pushed-rod"]) {
        let model = row.model.as_deref().unwrap();
        // The corners of other polygons are irrational.
        let is_exact = !model.starts_with("polygon") || model == "polygon-4";
        let proved = if is_exact { row.claimed } else { 0 };
        assert_eq!(row.proved, proved, "{row:?}");
    }
}

#[test]
fn clarabel_solves_convex_problems_and_is_outside_its_class_elsewhere() {
    let clarabel = |family: &str| {
        let mut rows = rows_of(&[family]);
        rows.retain(|row| row.solver == "clarabel");
        rows
    };
    for family in ["stack", "table", "hilbert", "pd", "contact-graph"] {
        let rows = clarabel(family);
        assert_eq!((rows.len(), rows[0].outside), (1, 0), "{family}");
        assert_eq!(rows[0].claimed, rows[0].accepted, "{family}");
    }
    for family in ["stack", "table", "pd"] {
        assert_eq!(clarabel(family)[0].accepted, clarabel(family)[0].problems, "{family}");
    }
    for family in ["murty", "csizmadia", "friction-blocks"] {
        let rows = clarabel(family); // not symmetric
        assert_eq!((rows[0].outside, rows[0].claimed), (rows[0].problems, 0), "{family}");
    }
    let models: Vec<_> = clarabel("pushed-mass").into_iter().map(|row| row.model).collect();
    let expected = ["frozen-box", "associated-cone"].map(|model| Some(model.to_string()));
    assert_eq!(models, expected);
}
