//! Invalid input: one message, which names the file, the key and the number, and code 2.

use super::{GOOD, err, out, run, run_with};

#[test]
fn bad_input_exits_with_2_and_one_message() {
    let no_file = run(&["solve", "no such file.json"]);
    assert_eq!(no_file.status.code(), Some(2));
    assert!(err(&no_file).starts_with("error: no such file.json: "));
    let no_json = run_with("{", &["solve", "-"]);
    assert_eq!((no_json.status.code(), out(&no_json)), (Some(2), String::new()));
    assert!(err(&no_json).starts_with("error: standard input: line 1, column 1: not valid JSON"));
    let pythons =
        run_with(r#"{"A": {"dense": [[1]]}, "b": [-1], "hi": [Infinity]}"#, &["solve", "-"]);
    assert!(err(&pythons).contains(r#"write "inf", "-inf" or "nan" with quotation marks"#));
    assert_eq!(err(&run_with("\n", &["solve", "-"])), "error: standard input: is empty\n");
    let marked = run_with(&format!("\u{feff}{GOOD}"), &["solve", "-"]);
    assert!(err(&marked).starts_with("error: standard input: begins with a byte order mark"));
    let no_solver = run_with(GOOD, &["solve", "-", "--solver", "magic"]);
    assert_eq!(no_solver.status.code(), Some(2));
    assert!(
        err(&no_solver).starts_with("error: there is no solver named \"magic\"; there are pgs")
    );
    for (option, value) in [("--tolerance", "-1"), ("--tolerance", "nan"), ("--omega", "2")] {
        let output = run_with(GOOD, &["solve", "-", &format!("{option}={value}")]);
        assert_eq!(output.status.code(), Some(2), "{option} {value}");
    }
}
