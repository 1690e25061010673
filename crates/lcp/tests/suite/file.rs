use dashu_ratio::RBig;
use lcplab_lcp::file::{Expected, Problem, SCHEMA, as_number, number, read_answers};
use lcplab_lcp::friction::{Contact, Model};
use lcplab_lcp::memory::Memory;
use lcplab_lcp::{Coupling, Lcp, Matrix};
use proptest::prelude::*;

use lcplab_testing::{INF, cases, manufactured};

fn message(text: &str) -> String {
    Problem::parse(text, "p.json").unwrap_err().to_string()
}

#[test]
fn absent_bounds_are_zero_and_infinity() {
    let problem = Problem::parse(r#"{"A": {"dense": [[2]]}, "b": [1]}"#, "p.json").unwrap();
    assert_eq!((problem.lcp.lo(), problem.lcp.hi()), (&[0.0][..], &[INF][..]));
}

#[test]
fn absent_bounds_of_a_friction_row_are_infinite() {
    let text = r#"{"A": {"dense": [[1, 0], [0, 1]]}, "b": [0, 0], "friction_index": [-1, 0], "mu": [0, 0.5]}"#;
    let problem = Problem::parse(text, "p.json").unwrap();
    assert_eq!(problem.lcp.lo(), [0.0, -INF]);
    assert_eq!(problem.lcp.bounds(1, &[2.0, 0.0]), (-1.0, 1.0));
}

#[test]
fn triplets_at_the_same_place_add_up() {
    let text = r#"{"A": {"rows": 1, "cols": 1, "triplets": [[0, 0, 2], [0, 0, 3]]}, "b": [0]}"#;
    assert_eq!(Problem::parse(text, "p.json").unwrap().lcp.matrix().diagonal(0), 5.0);
}

#[test]
fn unknown_keys_are_warned_of_and_known_ones_kept() {
    let text = r#"{"A": {"dense": [[1]]}, "b": [0], "dt": 0.01, "colour": "red"}"#;
    let problem = Problem::parse(text, "p.json").unwrap();
    assert_eq!(problem.warnings, ["p.json: unknown key \"colour\" ignored"]);
    assert_eq!(problem.to_json()["dt"], 0.01);
}

/// Without rolling friction the problem is another one: its key must not be ignored.
#[test]
fn rolling_friction_is_rejected_by_name() {
    for (key, kind) in [
        ("rolling_friction", "rolling"),
        ("rollingFriction", "rolling"),
        ("rolling", "rolling"),
        ("mu_r", "rolling"),
        ("mu-rolling", "rolling"),
        ("spinning_friction", "torsional"),
        ("torsional_mu", "torsional"),
    ] {
        let text = format!(r#"{{"A": {{"dense": [[1]]}}, "b": [0], "{key}": [0.1]}}"#);
        let expected = format!("p.json: {key}: states {kind} friction, which is not supported");
        assert!(message(&text).starts_with(&expected), "{}", message(&text));
    }
}

#[test]
fn the_warning_of_a_misspelt_key_names_the_key_that_was_meant() {
    let warning = |key: &str| {
        let text = format!(r#"{{"A": {{"dense": [[1]]}}, "b": [0], "{key}": [0]}}"#);
        Problem::parse(&text, "p.json").unwrap().warnings.concat()
    };
    for (key, meant) in [
        ("low", "lo"),
        ("lb", "lo"),
        ("Upper", "hi"),
        ("friction_indx", "friction_index"),
        ("friction-index", "friction_index"),
        ("findex", "friction_index"),
        ("frozen_ta", "frozen_at"),
        ("scal", "scale"),
        ("Model", "model"),
        ("motions", "motion"),
        ("q", "b"),
    ] {
        let expected = format!("p.json: unknown key {key:?} ignored; did you mean {meant:?}?");
        assert_eq!(warning(key), expected);
    }
    for key in ["x", "c", "note", "seed", "w", "comment", "units", "expectation"] {
        assert_eq!(warning(key), format!("p.json: unknown key {key:?} ignored"));
    }
}

#[test]
fn unknown_keys_of_the_matrix_are_refused() {
    let with = |a: &str| message(&format!(r#"{{"A": {a}, "b": [0]}}"#));
    assert_eq!(with(r#"{"dense": [[1]], "offset": 1}"#), "p.json: A.offset: is unknown");
    assert_eq!(with(r#"{"dense": [[1]], "rows": 2}"#), "p.json: A.rows: is 2, b has 1 rows");
    let sparse = r#"{"rows": 1, "cols": 1, "triplets": [[0, 0, 1]], "symmetric": true}"#;
    assert_eq!(with(sparse), "p.json: A.symmetric: is unknown");
}

#[test]
fn the_schema_names_all_keys_that_are_read_and_no_other() {
    let all = serde_json::json!({
        "name": "all keys", "A": { "dense": [[1, 0, 0], [0, 1, 0], [0, 0, 1]] }, "b": [0, 0, 0],
        "lo": [0, "-inf", "-inf"], "hi": ["inf", "inf", "inf"], "friction_index": [-1, 0, 0],
        "mu": [0, 0.5, 0.5], "model": "frozen-box", "frozen_at": [1, 0, 0], "scale": 1e-9,
        "motion": { "mass": [[0, 0, 2]], "jacobian": [[0, 0, 1]], "bias": [0, 0, 0], "compliance": [0, 0, 0], "target": [-3] },
        "source": "here", "dt": 0.01, "rows": [], "bodies": [], "gravity": [0, 0, -9.81],
        "objective": false, "expected": { "solutions": [], "complete": false }, "hunt": { "solver": "mine" },
        "answer": { "x": [0, 0, 0], "motion": [-3] },
    });
    let problem = Problem::parse(&all.to_string(), "p.json").unwrap();
    assert_eq!(problem.warnings, [""; 0]);
    assert_eq!(problem.to_json()["motion"]["target"], serde_json::json!([-3.0]));
    let schema: serde_json::Value = serde_json::from_str(SCHEMA).unwrap();
    let keys = |value: &serde_json::Value| -> std::collections::BTreeSet<String> {
        value.as_object().unwrap().keys().cloned().collect()
    };
    assert_eq!(keys(&schema["properties"]), keys(&all));
}

#[test]
fn descriptions_of_rows_that_do_not_exist_and_time_steps_that_are_none_are_defects() {
    let with = |key: &str| {
        let text = format!(r#"{{"A": {{"dense": [[2]]}}, "b": [-1], {key}}}"#);
        Problem::parse(&text, "p.json").map_err(|error| error.to_string())
    };
    for (key, message) in [
        (r#""rows": [{}, {}]"#, "p.json: rows: has length 2, the problem has 1 row"),
        (r#""rows": ["normal"]"#, "p.json: rows: must be a list of objects"),
        (r#""rows": {"label": "a"}"#, "p.json: rows: must be a list of objects"),
        (r#""dt": -0.01"#, "p.json: dt: must be a positive number of seconds, is -0.01"),
        (r#""dt": "1 ms""#, "p.json: dt: must be a positive number of seconds, is \"1 ms\""),
    ] {
        assert_eq!(with(key).err().as_deref(), Some(message));
    }
    assert!(with(r#""rows": [{"label": "left"}], "dt": 0.01"#).is_ok());
}

#[test]
fn an_exact_solution_is_integers_over_the_least_denominator() {
    let x = ["14/5", "0", "-1/10", "3"].map(|x| x.parse::<RBig>().unwrap());
    let json = Expected::unique(x.to_vec()).json();
    let solution =
        serde_json::json!({ "numerators": ["28", "0", "-1", "30"], "denominator": "10" });
    assert_eq!(json, serde_json::json!({ "solutions": [solution], "complete": true }));
}

#[test]
fn each_defect_has_its_message() {
    let cases = [
        ("[1]", "p.json: must be a JSON object"),
        (r#"{"A": {"dense": [[1]]}}"#, "p.json: b: is missing"),
        (r#"{}"#, "p.json: 2 defects\n  A: is missing\n  b: is missing"),
        (r#"{"A": 3, "b": [1]}"#, "p.json: A: must be an object with \"dense\" or \"triplets\""),
        (r#"{"A": {"dense": [[1, 2]]}, "b": [1]}"#, "p.json: A.dense[0]: has 2 entries, b has 1"),
        (
            r#"{"A": {"dense": [["x"]]}, "b": [1]}"#,
            "p.json: A.dense[0][0]: must be a number, is \"x\"",
        ),
        (r#"{"A": {"dense": [[1]]}, "b": ["nan"]}"#, "p.json: b[0]: must be finite, is NaN"),
        (
            r#"{"A": {"dense": [[1]]}, "b": [0], "lo": [2], "hi": [1]}"#,
            "p.json: lo[0]: is 2, above hi[0] = 1",
        ),
        (
            r#"{"A": {"dense": [[1]]}, "b": [0], "lo": ["inf"]}"#,
            "p.json: lo[0]: is inf, no number can meet it",
        ),
        (
            r#"{"A": {"dense": [[1]]}, "b": [0], "hi": [1, 1]}"#,
            "p.json: hi: has 2 rows, A is 1 × 1",
        ),
        (
            r#"{"A": {"rows": 1, "cols": 1, "triplets": [[0, 1, 2]]}, "b": [0]}"#,
            "p.json: A.triplets[0]: row 0 and column 1 must be indices below 1",
        ),
        (
            r#"{"A": {"rows": 1000000000000, "cols": 1, "triplets": []}, "b": [0]}"#,
            "p.json: A.rows: is 1000000000000, b has 1 rows",
        ),
        (r#"{"A": {"dense": [[1]]}, "b": [0], "mu": [1]}"#, "p.json: friction_index: is missing"),
        (
            r#"{"A": {"dense": [[1]]}, "b": [0], "friction_index": [0], "mu": [1]}"#,
            "p.json: friction_index[0]: is 0: a row cannot bound itself",
        ),
        (
            r#"{"A": {"dense": [[1, 0], [0, 1]]}, "b": [0, 0], "lo": [0, -1], "friction_index": [-1, 0], "mu": [0, 1]}"#,
            "p.json: lo[1]: is -1, but row 1 is a friction row with the bounds ±mu[1] x[0]; leave the entry infinite",
        ),
        (
            r#"{"A": {"dense": [[1]]}, "b": [0], "motion": {"mass": [[1, 0, 1], [0, 1, 1], [0, 1, 1]], "jacobian": [[0, 2, 1]],
                "bias": [0, 0], "compliance": [-1], "target": [0, "inf"]}}"#,
            "p.json: 6 defects\n  motion.target[1]: must be finite, is inf\n  \
             motion.bias: has 2 entries, b has 1\n  \
             motion.jacobian[0]: row 0 must be an index below 1, column 2 below 2\n  \
             motion.compliance[0]: must not be negative, is -1\n  \
             motion.mass: has an entry at (1, 0), below the diagonal\n  \
             motion.mass: has two entries at (0, 1)",
        ),
        (
            r#"{"A": {"dense": [[1]]}, "b": [0], "motion": {"mass": [], "masses": []}}"#,
            "p.json: 5 defects\n  motion.jacobian: is missing\n  motion.bias: is missing\n  \
             motion.compliance: is missing\n  motion.target: is missing\n  motion.masses: is unknown",
        ),
        (r#"{"A": {"dense": 1}, "b": [1]}"#, "p.json: A.dense: must be a list of rows"),
        (r#"{"A": {"dense": [1]}, "b": [1]}"#, "p.json: A.dense[0]: must be a list of numbers"),
        (r#"{"A": {"dense": []}, "b": 1}"#, "p.json: b: must be a list of numbers"),
        (
            r#"{"A": {"cols": 1, "triplets": 1}, "b": [0]}"#,
            "p.json: 2 defects\n  A.rows: is missing\n  A.triplets: must be a list of [row, column, value]",
        ),
        (
            r#"{"A": {"rows": 1, "cols": 1, "triplets": [[0, 0], [0, 0, "x"]]}, "b": [0]}"#,
            "p.json: 2 defects\n  A.triplets[0]: must be [row, column, value]\n  \
             A.triplets[1]: value must be a number, is \"x\"",
        ),
        (
            r#"{"A": {"dense": [[1]]}, "b": [0], "friction_index": 0, "mu": [0]}"#,
            "p.json: friction_index: must be a list of row indices, -1 for none",
        ),
        (
            r#"{"A": {"dense": [[1]]}, "b": [0], "friction_index": [-2], "mu": [0]}"#,
            "p.json: friction_index[0]: must be a row index or -1, is -2",
        ),
        (r#"{"A": {"dense": [[1]]}, "b": [0], "friction_index": [-1]}"#, "p.json: mu: is missing"),
        (
            r#"{"A": {"dense": [[[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15]]]}, "b": [0]}"#,
            "p.json: A.dense[0][0]: must be a number, is [1,2,3,4,5,6,7,8,9,10,11,12,13,14,15]",
        ),
        (
            r#"{"A": {"dense": [[1]]}, "b": ["0123456789012345678901234567890123456789"]}"#,
            "p.json: b[0]: must be a number, is \"012345678901234567890123456789012345...",
        ),
    ];
    for (text, expected) in cases {
        assert_eq!(message(text), expected);
    }
}

#[test]
fn a_key_given_twice_is_refused_wherever_it_stands() {
    for (text, key) in [
        (r#"{"A": {"dense": [[1]]}, "b": [1], "b": [2]}"#, "b"),
        (r#"{"A": {"dense": [[1]], "dense": [[2]]}, "b": [1]}"#, "dense"),
        (r#"{"A": {"dense": [[1]]}, "b": [1], "expected": {"x": [0], "x": [1]}}"#, "x"),
        (r#"{"A": {"dense": [[1]]}, "b": [1], "lo": [0], "\u006co": [-1]}"#, "lo"),
    ] {
        let output = message(text);
        assert!(output.contains(&format!(": the key {key:?} is given twice")), "{output}");
    }
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x.json");
    std::fs::write(&path, r#"{"x": [0, 0], "x": [1, 1]}"#).unwrap();
    let output = read_answers(&path, 2, Memory::default()).unwrap_err().to_string();
    assert!(output.ends_with("the key \"x\" is given twice"), "{output}");
}

#[test]
fn a_matrix_is_written_down_in_one_way() {
    let both =
        r#"{"A": {"dense": [[1]], "rows": 1, "cols": 1, "triplets": [[0, 0, 2]]}, "b": [1]}"#;
    assert!(message(both).ends_with("A: has both \"dense\" and \"triplets\""), "{}", message(both));
}

#[test]
fn an_answer_is_the_vector_x_of_any_object() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("x.json");
    let answer = |text: &str| {
        std::fs::write(&path, text).unwrap();
        let answer = read_answers(&path, 2, Memory::default());
        let answer = answer.map(|answers| answers.x);
        answer.map_err(|error| error.to_string().replace(path.to_str().unwrap(), "x.json"))
    };
    assert_eq!(answer(r#"{"status": "solved", "x": [1, "-inf"]}"#), Ok(vec![1.0, -INF]));
    assert_eq!(answer("{}").unwrap_err(), "x.json: x: is missing");
    assert_eq!(
        answer(r#"{"x": [1]}"#).unwrap_err(),
        "x.json: x: has length 1, the problem has 2 rows"
    );
    assert_eq!(answer(r#"{"x": 1}"#).unwrap_err(), "x.json: x: must be a list of numbers");
    let small = read_answers(&path, 2, Memory::bytes(1)).unwrap_err().to_string();
    assert!(small.ends_with("x.json: is larger than 1 B, the limit for reading"), "{small}");
}

#[test]
fn a_file_is_read_as_its_text_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.json");
    std::fs::write(&path, PUSHED).unwrap();
    let problem = Problem::read(&path).unwrap();
    assert!(same(&problem.lcp, &Problem::parse(PUSHED, "p.json").unwrap().lcp));
}

#[test]
fn numbers_that_json_has_not_are_words() {
    let words = [INF, -INF, f64::NAN, 0.5].map(number);
    assert_eq!(
        words.each_ref().map(|word| word.to_string()),
        ["\"inf\"", "\"-inf\"", "\"nan\"", "0.5"]
    );
    let back = words.map(|word| as_number(&word).unwrap());
    assert_eq!((back[0], back[1], back[3]), (INF, -INF, 0.5));
    assert!(back[2].is_nan());
}

const PUSHED: &str = r#"{"A": {"dense": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "b": [-2, -3, 0],
    "friction_index": [-1, 0, 0], "mu": [0, 0.5, 0.5], "model": "polygon-8", "frozen_at": [2, 0, 0]}"#;

#[test]
fn a_friction_problem_keeps_its_contacts_its_model_and_its_frozen_impulses() {
    let problem = Problem::parse(PUSHED, "p.json").unwrap();
    assert_eq!(problem.model, Some(Model::Polyhedral { directions: 8 }));
    assert_eq!(problem.frozen_at.as_deref(), Some(&[2.0, 0.0, 0.0][..]));
    let contacts = problem.friction().unwrap().unwrap().contacts().to_vec();
    assert_eq!(contacts, [Contact { rows: [0, 1, 2], mu: 0.5 }]);
    let again = Problem::parse(&problem.to_json().to_string(), "p.json").unwrap();
    assert_eq!((again.model, &again.frozen_at), (problem.model, &problem.frozen_at));
    assert_eq!(again.warnings, [""; 0]);
    assert!(same(&again.lcp, &problem.lcp));
}

#[test]
fn each_defect_of_a_friction_problem_has_its_message() {
    let with = |from: &str, to: &str| message(&PUSHED.replace(from, to));
    assert!(with("polygon-8", "sphere").starts_with(
        "p.json: model: there is no friction model named \"sphere\"; there are frozen-box"
    ));
    assert_eq!(with("\"polygon-8\"", "8"), "p.json: model: must be a name, is 8");
    assert_eq!(with("[2, 0, 0]", "[2]"), "p.json: frozen_at: has 1 entries, b has 3");
    assert_eq!(
        with("[2, 0, 0]", "[\"inf\", 0, 0]"),
        "p.json: frozen_at[0]: must be finite, is inf"
    );
    assert_eq!(
        message(r#"{"A": {"dense": [[1]]}, "b": [0], "model": "coulomb-cone"}"#),
        "p.json: model: is given, but there is no friction_index"
    );
}

#[test]
fn a_number_beyond_the_range_of_doubles_is_refused() {
    assert!(message(r#"{"A": {"dense": [[1e999]]}, "b": [0]}"#).contains("number out of range"));
}

#[test]
fn at_most_twenty_defects_are_listed() {
    let error = message(&format!(r#"{{"A": {{"dense": []}}, "b": [{}]}}"#, ["null"; 30].join(",")));
    assert_eq!(error.lines().count(), 22);
    assert!(error.ends_with("and 11 more"));
}

fn same(a: &Lcp, b: &Lcp) -> bool {
    let bits = |v: &[f64]| v.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    let entries =
        |lcp: &Lcp| (0..lcp.len()).flat_map(|i| lcp.matrix().row(i).iter()).collect::<Vec<_>>();
    entries(a) == entries(b)
        && [(a.b(), b.b()), (a.lo(), b.lo()), (a.hi(), b.hi())]
            .iter()
            .all(|(a, b)| bits(a) == bits(b))
        && a.coupling() == b.coupling()
}

#[test]
fn a_coupled_sparse_problem_survives_the_round_trip() {
    let matrix = Matrix::sparse(2, &[(0, 0, 0.1), (1, 1, 1.0 / 3.0)]);
    let lcp = Lcp::new(matrix, vec![1e-300, -0.0], vec![0.0, -INF], vec![INF; 2]).unwrap();
    let coupling = Coupling::new(vec![None, Some(0)], vec![0.0, 0.7]).unwrap();
    let problem = Problem::new("pair", lcp.with_coupling(coupling).unwrap());
    let back = Problem::parse(&problem.to_json().to_string(), "p.json").unwrap();
    assert_eq!(back.name, "pair");
    assert!(same(&problem.lcp, &back.lcp));
}

proptest! {

    #![proptest_config(cases(100))]

    #[test]
    fn exact_solutions_are_read_as_they_were_written(
        entries in proptest::collection::vec((-1000i64..1000, 1u64..50), 1..6), complete: bool,
    ) {
        let entry = |(p, q): &(i64, u64)| RBig::from_parts((*p).into(), (*q).into());
        let solutions = vec![entries.iter().map(entry).collect(), vec![RBig::ZERO; entries.len()]];
        let expected = Expected { solutions, complete };
        let lcp = Lcp::new(Matrix::dense(0, &[]), vec![], vec![], vec![]).unwrap();
        let mut problem = Problem::new("", lcp);
        problem.extra.insert("expected".into(), expected.json());
        prop_assert_eq!(Expected::of(&problem), Some(expected));
    }

    #[test]
    fn every_bit_survives_the_round_trip(m in manufactured(4, 4, 0.1), noise in any::<[f64; 4]>()) {
        let b = noise.iter().map(|v| if v.is_finite() { *v } else { 0.0 }).collect();
        let entries: Vec<f64> = (0..16).map(|k| m.lcp.matrix().entry(k / 4, k % 4) / 3.0).collect();
        let (lo, hi) = (m.lcp.lo().to_vec(), m.lcp.hi().to_vec());
        let lcp = Lcp::new(Matrix::dense(4, &entries), b, lo, hi).unwrap();
        let text = Problem::new("", lcp.clone()).to_json().to_string();
        prop_assert!(same(&lcp, &Problem::parse(&text, "p.json").unwrap().lcp));
    }

    #[test]
    fn no_text_makes_the_reader_panic(text in "[\\[\\]{}:,\"a-zA0-9.eE+-]{0,60}") {
        let _ = Problem::parse(&text, "p.json");
    }
}
