//! Messages about inputs that are nearly right: they say what the input should be.

use std::fs;
use std::path::Path;

use super::{GOOD, err, out, run, run_with};

/// A folder with a problem whose solution is (1, 1).
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let problem = r#"{"A": {"dense": [[1, 0], [0, 1]]}, "b": [-1, -1]}"#;
    fs::write(folder.path().join("p.json"), problem).unwrap();
    folder
}

fn path(folder: &Path, name: &str) -> String {
    folder.join(name).to_str().unwrap().to_string()
}

/// A `.npy` file with these numbers, as NumPy writes it; 8-byte floats, or 2-byte ones.
fn npy(numbers: &[f64], halves: &[u16]) -> Vec<u8> {
    let (descr, length) = match halves {
        [] => ("<f8", numbers.len()),
        _ => ("<f2", halves.len()),
    };
    let mut header =
        format!("{{'descr': '{descr}', 'fortran_order': False, 'shape': ({length},), }}");
    while !(header.len() + 11).is_multiple_of(64) {
        header.push(' ');
    }
    header.push('\n');
    let mut bytes = b"\x93NUMPY\x01\x00".to_vec();
    bytes.extend((header.len() as u16).to_le_bytes());
    bytes.extend(header.as_bytes());
    bytes.extend(numbers.iter().flat_map(|number| number.to_le_bytes()));
    bytes.extend(halves.iter().flat_map(|number| number.to_le_bytes()));
    bytes
}

#[test]
fn an_answer_is_json_a_bare_list_or_an_array_of_numpy() {
    let folder = folder();
    let problem = path(folder.path(), "p.json");
    // 1 in 16 bits: the exponent 15 is that of 1.
    let halves = npy(&[], &[15 << 10, 15 << 10]);
    for (name, bytes) in [
        ("a.json", br#"{"x": [1, 1]}"#.to_vec()),
        ("list.json", b"[1, 1]".to_vec()),
        ("x.npy", npy(&[1.0, 1.0], &[])),
        ("half.npy", halves),
    ] {
        let answer = path(folder.path(), name);
        fs::write(&answer, bytes).unwrap();
        let output = run(&["judge", &problem, &answer]);
        assert_eq!(output.status.code(), Some(0), "{name}: {}", err(&output));
    }
    for (name, bytes, reason) in [
        ("a.csv", &b"1,1"[..], "is no answer file, which is JSON: {\"x\": [0.5, 0]}\n"),
        ("cut.npy", &npy(&[1.0, 1.0], &[])[..130], "has 2 bytes, the shape [2] needs 16\n"),
        ("cut.npz", b"PK", "is no .npz archive, or is cut off\n"),
        ("three.npy", &npy(&[1.0; 3], &[]), "x: has length 3, the problem has 2 rows\n"),
    ] {
        let answer = path(folder.path(), name);
        fs::write(&answer, bytes).unwrap();
        let output = run(&["judge", &problem, &answer]);
        assert_eq!(output.status.code(), Some(2), "{name}");
        assert!(err(&output).contains(reason), "{name}: {}", err(&output));
    }
}

#[test]
fn an_unreadable_answer_does_not_hide_the_verdicts_on_the_others() {
    let folder = folder();
    for (name, text) in [("a.json", "[1, 1]"), ("bad.json", "[1,"), ("b.json", "[1, 2]")] {
        fs::write(folder.path().join(name), text).unwrap();
    }
    let [problem, a, bad, b] =
        ["p.json", "a.json", "bad.json", "b.json"].map(|name| path(folder.path(), name));
    let output = run(&["judge", &problem, &a, &bad, &b]);
    assert_eq!(output.status.code(), Some(2));
    assert!(out(&output).contains("proved") && out(&output).contains("not a solution"));
    assert!(err(&output).contains("bad.json: line 1, column 3: not valid JSON"));
}

#[test]
fn what_is_not_there_or_not_readable_is_said_in_plain_words() {
    let folder = folder();
    let own = |name: &str| path(folder.path(), name);
    fs::write(own("empty.mtx"), "").unwrap();
    fs::write(own("empty.npz"), "").unwrap();
    fs::write(own("b.json"), "{\"b\": [1").unwrap();
    fs::write(own("cut.json"), "{\"A\": {\"dense\": [[1").unwrap();
    for (arguments, reason) in [
        (
            &["test", &own("none/"), "--solver", "pgs"][..],
            "none/: there is no such file or folder\n",
        ),
        (&["compare", &own("none/")], "none/: there is no such file or folder\n"),
        (&["convert", &own(""), &own("a.json")], "is a folder that is no problem"),
        (&["solve", &own("empty.mtx")], "empty.mtx: is empty\n"),
        (&["solve", &own("empty.npz")], "empty.npz: is no .npz archive, or is cut off\n"),
        (&["solve", &own("cut.json")], "cut.json: line 1, column 19: not valid JSON: EOF"),
        (&["receipts", &own("cut.json")], "cut.json: line 1, column 19: not valid JSON: EOF"),
        (&["check", &own("p.json"), &own("cut.json")], "line 1, column 19: not valid JSON: EOF"),
        (&["gradient", &own("p.json"), "--theirs", &own("cut.json")], "column 19: not valid JSON"),
        (&["gradient", &own("p.json"), "--direction", &own("b.json")], "not valid JSON: EOF"),
        (&["solve", &own("p.json"), "--sweeps", "-5"], "must be a whole number, such as 1000\n"),
        (&["solve", &own("p.json"), "--sweeps", "1e3"], "must be a whole number, such as 1000\n"),
        (
            &["simulate", "stack", "--set", "bodies.box1.mass=3"],
            "it is made by [generate]; set generate.mass, or list the bodies\n",
        ),
        (
            &["explain", "stack", "--out", &own("x.pdf")],
            "x.pdf: cannot be written as .pdf: use .txt, .md or .html, or --format\n",
        ),
    ] {
        let output = run(arguments);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {}", out(&output));
        assert!(err(&output).contains(reason), "{arguments:?}: {}", err(&output));
        assert!(!err(&output).contains("file: "), "{arguments:?}: {}", err(&output));
    }
    assert!(!folder.path().join("x.pdf").exists());
    let output = run_with("{", &["solve", "-"]);
    assert!(err(&output).starts_with("error: standard input: line 1, "), "{}", err(&output));
}

#[test]
fn a_number_that_is_not_finite_is_named_by_its_row() {
    let folder = folder();
    let answer = path(folder.path(), "nan.json");
    fs::write(&answer, r#"{"x": [1, "nan"]}"#).unwrap();
    let problem = path(folder.path(), "p.json");
    let output = run(&["judge", &problem, &answer]);
    assert_eq!(output.status.code(), Some(1));
    let verdict = "verdict    not a solution: x[1] is not a finite number\n";
    assert!(out(&output).contains(verdict), "{}", out(&output));
    let output = run(&["gradient", &problem, &answer]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("answer: x[1]: is NaN, must be a finite number"));
}

/// Tracebacks say at their end what was wrong, and so do long lines.
#[test]
fn the_end_of_a_long_complaint_of_a_plug_in_is_kept() {
    let folder = folder();
    let script = path(folder.path(), "mine.py");
    let text = "import sys\nsys.exit('x' * 1000 + ' the mass matrix is singular')\n";
    fs::write(&script, text).unwrap();
    let output = run_with(GOOD, &["solve", "-", "--plugin", &format!("python3 '{script}'")]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).ends_with("x the mass matrix is singular\n"), "{}", err(&output));
    assert!(err(&output).len() < 600, "{}", err(&output));
}
