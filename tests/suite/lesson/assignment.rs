//! Sheets for a class and their grading: nothing that a student hands in is lost without a message.

use std::fs;
use std::path::Path;
use std::process::Command;

use lcplab::lesson::assignment::{Answers, students};
use tempfile::TempDir;

const CLASS: &str = "Ada Lovelace\nLovelace, Byron\n\nÉmilie du Châtelet\nGrace Hopper\n";

/// Runs a command in a folder: its exit code, output and errors.
fn run(folder: &Path, arguments: &[&str]) -> (i32, String, String) {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lcplab"));
    let output = command.args(arguments).current_dir(folder).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code().unwrap(), text(output.stdout), text(output.stderr))
}

/// A folder with the sheets of set 3 for the class.
fn handed_out() -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("class.txt"), CLASS).unwrap();
    let options = ["--seed", "autumn", "--set", "3", "--students", "class.txt", "--out", "set3"];
    let (code, out, err) = run(folder.path(), &[&["teacher"], &options[..]].concat());
    assert_eq!((code, &*err), (0, ""), "{out}");
    folder
}

/// The key as lists of fields, without its first line.
fn key(folder: &Path) -> Vec<Vec<String>> {
    let text = fs::read_to_string(folder.join("set3/key.csv")).unwrap();
    let fields = |line: &str| {
        let line = line.replace("\"Lovelace, Byron\"", "Lovelace; Byron");
        line.split(',').map(|field| field.replace(';', ",")).collect()
    };
    text.lines().skip(1).map(fields).collect()
}

/// Fills the form of a student, the k-th in the list, with the key's answers.
fn fill(folder: &Path, k: usize, change: impl Fn(&str, &str) -> String) {
    let forms = folder.join("set3/answers");
    let mut forms: Vec<_> = fs::read_dir(forms).unwrap().map(|own| own.unwrap().path()).collect();
    forms.sort();
    let form = fs::read_to_string(&forms[k]).unwrap();
    let student = CLASS.lines().filter(|line| !line.is_empty()).nth(k).unwrap();
    let key = key(folder);
    let answer = |id: &str| key.iter().find(|row| row[0] == student && row[1] == id);
    let line = |line: &str| match answer(line.trim_end_matches(',')) {
        Some(row) => format!("{},{}\n", row[1], change(&row[1], &row[2])),
        None => format!("{line}\n"),
    };
    let filled: String = form.lines().map(line).collect();
    fs::create_dir_all(folder.join("in")).unwrap();
    fs::write(folder.join("in").join(forms[k].file_name().unwrap()), filled).unwrap();
}

#[test]
fn a_set_is_handed_out_filled_in_and_graded() {
    let folder = handed_out();
    let folder = folder.path();
    let sheet = fs::read_to_string(folder.join("set3/sheets/01_ada-lovelace.html")).unwrap();
    for words in ["3.p1", "3.r1", "student,Ada Lovelace", "two_rows.html#", "decimal point"] {
        assert!(sheet.contains(words), "{words}");
    }
    assert!(folder.join("set3/sheets/live/two_rows.html").exists());
    assert_eq!(key(folder).len(), 4 * 4);

    fill(folder, 0, |_, answer| answer.into());
    fill(folder, 1, |id, answer| if id == "3.p2" { "1".into() } else { answer.into() });
    fill(folder, 2, |id, answer| if id == "3.r1" { String::new() } else { answer.into() });
    let options = ["--students", "class.txt", "--grade", "in", "--out", "grades.csv"];
    let (code, out, err) = run(folder, &[&["teacher", "--seed", "autumn"], &options[..]].concat());
    assert_eq!((code, &*err), (0, ""));
    let table = "\
student             right                wrong  missing              points
Ada Lovelace        3.p1 3.p2 3.r1 3.x1                              7 of 7
Lovelace, Byron     3.p1 3.r1 3.x1       3.p2                        5 of 7
Émilie du Châtelet  3.p1 3.p2 3.x1              3.r1                 6 of 7
Grace Hopper                                    3.p1 3.p2 3.r1 3.x1  0 of 7

3.p1   3 right, 0 wrong, 1 missing
3.p2   2 right, 1 wrong, 1 missing
3.r1   2 right, 0 wrong, 2 missing
3.x1   3 right, 0 wrong, 1 missing
";
    assert_eq!(out, table);
    let csv = fs::read_to_string(folder.join("grades.csv")).unwrap();
    assert!(csv.contains("\n\"Lovelace, Byron\",3.p1 3.r1 3.x1,3.p2,,5,7\n"), "{csv}");

    // With another secret the numbers are others, and so with none.
    let (_, out, _) = run(folder, &["teacher", "--seed", "spring", "--grade", "in"]);
    assert!(!out.contains("7 of 7"), "{out}");
    let own = |student: &str| run(folder, &["exercise", "--for", student, "3.p2"]).1;
    assert_ne!(own("Ada Lovelace"), own("Grace Hopper"));
    let (_, json, _) = run(folder, &["teacher", "--seed", "autumn", "--grade", "in", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(json.as_array().unwrap().len(), 3);
    assert!(json.to_string().contains("\"number\":1.0"), "{json}");
}

#[test]
fn a_bad_line_or_file_is_named_and_everything_else_counts() {
    let folder = handed_out();
    let folder = folder.path();
    for k in 0..4 {
        fill(folder, k, |_, answer| answer.into());
    }
    let name = |k: usize| {
        let names =
            ["01_ada-lovelace", "02_lovelace-byron", "03_milie-du-ch-telet", "04_grace-hopper"];
        folder.join(format!("in/{}.csv", names[k]))
    };
    let text = fs::read_to_string(name(0)).unwrap();
    let text =
        text.replace("3.p1,", "3.p1,0;").replace("3.x1", "3.x7") + "3.p2,5\nwords\n\n# a note\n";
    fs::write(name(0), text).unwrap();
    let text = fs::read_to_string(name(1)).unwrap();
    fs::write(name(1), format!("\u{feff}{}", text.replace("3.p1,", "3.p1;").replace('\n', "\r\n")))
        .unwrap();
    fs::write(name(2), b"student,\xc9milie\n").unwrap(); // not UTF-8
    fs::write(folder.join("in/twin.csv"), "student,grace hopper\n3.p1,1\n").unwrap();
    fs::write(folder.join("in/unknown.csv"), "student,Carl\n3.p1,1\n").unwrap();
    fs::write(folder.join("in/nameless.csv"), "3.p1,1\n").unwrap();
    let arguments =
        ["teacher", "--seed", "autumn", "--set", "3", "--students", "class.txt", "--grade"];
    let (code, out, err) = run(folder, &[&arguments[..], &["in"]].concat());
    assert_eq!(code, 2);
    let row = |student: &str| out.lines().find(|line| line.starts_with(student)).unwrap();
    let words = |row: &str| row.split_whitespace().collect::<Vec<_>>().join(" ");
    assert_eq!(words(row("Ada")), "Ada Lovelace 3.p2 3.r1 3.p1 3.x1 3 of 7", "{out}");
    assert!(
        row("Lovelace, Byron").ends_with("7 of 7") && row("Grace").ends_with("0 of 7"),
        "{out}"
    );
    assert!(row("Émilie").ends_with("0 of 7"), "{out}");
    for complaint in [
        "error: not everything was graded: 8 defects\n",
        "  in/01_ada-lovelace.csv:2: 3.p1: \"0;",
        "  in/01_ada-lovelace.csv:5: \"3.x7\" is not a problem of this set\n",
        "  in/01_ada-lovelace.csv:6: 3.p2 has an answer in line 3 already, which counts\n",
        "  in/01_ada-lovelace.csv:7: \"words\" has no comma: write PROBLEM,NUMBER\n",
        "  in/03_milie-du-ch-telet.csv: is not UTF-8 text\n",
        "  in/nameless.csv:1: no line \"student,NAME\" states the name\n",
        "  in/unknown.csv: \"Carl\" is not in the list of students; the file is not graded\n",
        "  in/04_grace-hopper.csv, in/twin.csv: several files of \"Grace Hopper\"; none of them is graded",
    ] {
        assert!(err.contains(complaint), "{complaint}\n{err}");
    }
    let (code, _, err) =
        run(folder, &[&arguments[..], &["in/01_ada-lovelace.csv", "none.csv"]].concat());
    assert!(code == 2 && err.contains("none.csv: No such file"), "{err}");
}

#[test]
fn two_students_of_one_name_are_an_error_with_both_lines() {
    let error = students("Ada\nGrace\n ada \n", "class.txt").unwrap_err().to_string();
    assert!(
        error.starts_with("class.txt: line 3: \"ada\" is also the name in line 1; "),
        "{error}"
    );
    assert!(students("\n\n", "class.txt").is_err());
    let names = students("\u{feff}Ada\r\n  Grace   Hopper\r\n", "class.txt").unwrap();
    assert_eq!(names, ["Ada", "Grace Hopper"]);
}

#[test]
fn a_number_is_read_as_typed_and_nothing_else_is_taken_for_one() {
    let answers =
        Answers::read("student,Ada\n3.p1, -1.5e-3 \n3.p2,0,57\n3.r1,nan\n3.x1,\n3.x1,2\n");
    let values: Vec<_> = answers.numbers.values().collect();
    assert_eq!(values, [&(2, Some(-1.5e-3)), &(6, Some(2.0))]);
    let lines: Vec<usize> = answers.defects.iter().map(|(line, _)| *line).collect();
    assert_eq!(lines, [3, 4]);
    assert!(answers.defects[0].1.contains("decimal point"));
}

#[test]
fn what_the_commands_cannot_use_exits_with_2() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    fs::write(folder.join("class.txt"), CLASS).unwrap();
    for (arguments, message) in [
        (&["teacher", "--seed", "a"][..], "--set"),
        (&["teacher", "--seed", " ", "--grade", "class.txt"], "must not be empty"),
        (
            &["teacher", "--seed", "a", "--set", "3,99", "--students", "class.txt", "--out", "o"],
            "set: 99: is neither a problem with parameters nor a lesson that contains such problems",
        ),
        (
            &["teacher", "--seed", "a", "--set", "3", "--students", "none", "--out", "o"],
            "none: No such file",
        ),
        (&["exercise", "--for", "Ada", "1.1"], "no problem named"),
    ] {
        let (code, _, err) = run(folder, arguments);
        assert!(code == 2 && err.contains(message), "{code} {err}");
    }
    assert!(!folder.join("o").exists());
    let (code, out, _) = run(folder, &["exercise", "--for", "Ada"]);
    assert!(
        code == 0 && out.contains("3.p1  own numbers") && out.contains("2.r1  same for"),
        "{out}"
    );
}
