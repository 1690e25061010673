use std::path::Path;

use lcplab_files as files;
use lcplab_files::Format;
use lcplab_lcp::friction::{Contact, Model};

use super::{rows, sample};
use lcplab_testing::INF;

/// M = diag(1, 4, 4, 4), a contact n = e0, t1 = e1 + e3, t2 = e2 and an equation e3 − e0, first,
/// with compliance ¼: all of A and b are short binary fractions, and so are the roots of M.
const A: [[f64; 4]; 4] =
    [[1.5, -1.0, 0.25, 0.0], [-1.0, 1.0, 0.0, 0.0], [0.25, 0.0, 0.5, 0.0], [0.0, 0.0, 0.0, 0.25]];

#[test]
fn a_dump_becomes_the_problem_in_impulses() {
    for path in ["chrono", "chrono/dump", "chrono/dump_Cq.dat"] {
        let problem = files::read(&sample(path), None).unwrap();
        assert_eq!(rows(problem.lcp.matrix()), A);
        assert_eq!(problem.lcp.b(), [4.0, -1.5, 3.0, 0.0]);
        assert_eq!(problem.lcp.lo(), [-INF, 0.0, -INF, -INF]);
        let contacts = problem.friction().unwrap().unwrap().contacts().to_vec();
        assert_eq!(contacts, [Contact { rows: [1, 2, 3], mu: 0.5 }]);
        assert_eq!(problem.model, Some(Model::AssociatedCone));
    }
}

fn copy(folder: &Path) {
    for file in sample("chrono").read_dir().unwrap().flatten() {
        std::fs::copy(file.path(), folder.join(file.file_name())).unwrap();
    }
}

fn message(change: impl Fn(&Path)) -> String {
    let folder = tempfile::tempdir().unwrap();
    copy(folder.path());
    change(folder.path());
    let error = files::read(folder.path(), None).unwrap_err().to_string();
    error.replace(&format!("{}/", folder.path().display()), "")
}

#[test]
fn old_dumps_count_from_one_and_call_the_masses_m() {
    let folder = tempfile::tempdir().unwrap();
    copy(folder.path());
    for (old, new) in [("H", "M"), ("Cq", "Cq"), ("E", "E")] {
        let text = std::fs::read_to_string(folder.path().join(format!("dump_{old}.dat"))).unwrap();
        let line = |line: &str| {
            let words: Vec<&str> = line.split(' ').collect();
            let up = |word: &str| word.parse::<usize>().unwrap() + 1;
            format!("{} {} {}\n", up(words[0]), up(words[1]), words[2])
        };
        std::fs::remove_file(folder.path().join(format!("dump_{old}.dat"))).unwrap();
        let text: String = text.lines().map(line).collect();
        std::fs::write(folder.path().join(format!("dump_{new}.dat")), text).unwrap();
    }
    assert_eq!(rows(files::read(folder.path(), None).unwrap().lcp.matrix()), A);
}

#[test]
fn each_defect_has_its_file() {
    let write = |name: &'static str, text: &'static str| {
        move |folder: &Path| std::fs::write(folder.join(name), text).unwrap()
    };
    let without = message(|folder| std::fs::remove_file(folder.join("dump_fric.dat")).unwrap());
    assert!(without.starts_with("dump_fric.dat: is missing; write one"), "{without}");
    let cases = [
        (
            "dump_fric.dat",
            "-2 0.5 -1 -2",
            "dump_fric.dat: number 1: must be -2, or mu followed by -1 and -1",
        ),
        ("dump_fric.dat", "-2", "dump_fric.dat: has 1 numbers, b has 4"),
        ("dump_f.dat", "1 2 3", "dump_H.dat: has an entry at 3, 3 (from 0), outside 3 × 3"),
        ("dump_f.dat", "1 2 3 x", "dump_f.dat: line 1: number 3 must be a number, is \"x\""),
        ("dump_H.dat", "0 1 2", "dump_H.dat: is not symmetric"),
        ("dump_H.dat", "0 0 -2", "dump_Cq.dat: H: is not positive definite"),
        ("dump_E.dat", "0 1 2", "dump_E.dat: is not a diagonal"),
        ("dump_Cq.dat", "0 0", "dump_Cq.dat: line 1: the file ends before its value"),
    ];
    for (name, text, expected) in cases {
        assert_eq!(message(write(name, text)), expected);
    }
}

#[test]
fn dumps_are_only_read() {
    let problem = files::read(&sample("chrono"), None).unwrap();
    let error = files::encode(&problem, Format::by_name("chrono").unwrap()).unwrap_err();
    assert_eq!(error.to_string(), "chrono: format: can be read but not written");
}
