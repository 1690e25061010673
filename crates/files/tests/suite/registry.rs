use std::collections::HashSet;
use std::path::Path;

use lcplab_files as files;
use lcplab_files::{ALL, Format};
use lcplab_lcp::file::Problem;

use super::{again, assert_same, sample};
use lcplab_testing::contacts;

#[test]
fn names_and_endings_are_unique() {
    let names: HashSet<_> = ALL.iter().map(|format| format.name).collect();
    let endings: Vec<_> = ALL.iter().flat_map(|format| format.endings).collect();
    assert_eq!(names.len(), ALL.len());
    assert_eq!(endings.iter().collect::<HashSet<_>>().len(), endings.len());
    assert!(Format::by_name("xml").unwrap_err().to_string().contains("json, matrix-market"));
}

#[test]
fn the_longest_ending_decides_whatever_its_letters() {
    let name = |path: &str| Format::of(Path::new(path)).map(|format| format.name);
    assert_eq!(name("a/dump_Cq.dat"), Some("chrono"));
    assert_eq!(name("a/lcp.dat"), Some("siconos"));
    assert_eq!(name("AUG2D.QPS"), Some("qps"));
    assert_eq!(name("scene.toml"), None);
}

#[test]
fn a_name_without_a_known_ending_is_read_as_json_but_not_written() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("problem");
    std::fs::write(&path, r#"{"A": {"dense": [[2]]}, "b": [-1]}"#).unwrap();
    let problem = files::read(&path, None).unwrap();
    assert_eq!(problem.lcp.b(), [-1.0]);
    let error = files::write(&problem, &path, None).unwrap_err().to_string();
    assert!(error.contains("extension: is unknown; known are json .json"), "{error}");
}

#[test]
fn an_unknown_ending_is_named_unless_the_file_is_an_object() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("problem.foo");
    let error = |text: &str| {
        std::fs::write(&path, text).unwrap();
        files::read(&path, None).unwrap_err().to_string()
    };
    for text in ["", "1 2 3"] {
        assert!(error(text).contains("problem.foo: extension: is unknown; known are json .json"));
    }
    assert!(error("{").contains("not valid JSON"));
}

#[test]
fn problems_are_told_from_scenes() {
    assert!(files::is_problem(Path::new("-")));
    assert!(files::is_problem(Path::new("missing.mtx")));
    assert!(files::is_problem(&sample("chrono")));
    assert!(files::is_problem(&sample("scipy")));
    assert!(!files::is_problem(Path::new("stack")));
    assert!(!files::is_problem(&sample("")));
}

#[test]
fn what_is_not_text_has_its_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("p.mtx");
    std::fs::write(&path, b"%%MatrixMarket\n\xff").unwrap();
    let error = files::read(&path, None).unwrap_err().to_string();
    assert!(error.ends_with("p.mtx: line 2: is not text"), "{error}");
}

#[test]
fn files_of_another_kind_are_named() {
    let folder = tempfile::tempdir().unwrap();
    let message = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        let error = files::read(&path, None).unwrap_err().to_string();
        error.split_once(": ").map(|(_, reason)| reason.to_string()).unwrap_or(error)
    };
    let matlab = b"MATLAB 5.0 MAT-file, Platform: GLNXA64\0\x01IM\xff\xff";
    assert!(message("CVXQP1_S.npz", matlab).starts_with("is a MATLAB file, but its name"));
    let pointer = b"version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 5\n";
    for name in ["p.hdf5", "p.dat", "p.npz", "p.json"] {
        let reason = "is a pointer of Git LFS: the file itself was not fetched";
        assert_eq!(message(name, pointer), reason, "{name}");
    }
    let hdf5 = std::fs::read(sample("fclib_local.hdf5")).unwrap();
    assert!(message("p.dat", &hdf5).starts_with("is an HDF5 file"));
    let archive = std::fs::read(sample("numpy.npz")).unwrap();
    assert!(message("p.dat", &archive).starts_with("is an archive of arrays"));
    let model = b"<!-- a stack -->\n<mujoco model=\"stack\"/>";
    for name in ["stack.xml", "stack.json"] {
        assert!(message(name, model).starts_with("is a MuJoCo model (MJCF)"), "{name}");
    }
}

#[test]
fn json_keeps_everything() {
    let problem = Problem::new("pair", contacts(&[&[2.0, -1.0], &[0.0, 2.0]], &[-1.0, 1.0 / 3.0]));
    let back = again(&problem, "json");
    assert_same(&problem.lcp, &back.lcp);
    assert_eq!(back.name, "pair");
}

#[test]
fn each_key_that_a_format_cannot_store_is_named() {
    let text = r#"{"A": {"dense": [[2]]}, "b": [-1], "scale": 0.5, "source": "s", "dt": 0.1, "rows": [{"label": "r"}],
        "bodies": [], "gravity": [0, 0, -9.81], "objective": true, "expected": {}, "hunt": {}, "answer": [0.5],
        "motion": {"mass": [[0, 0, 1]], "jacobian": [[0, 0, 1]], "bias": [0], "compliance": [1], "target": [-1]}}"#;
    let problem = Problem::parse(text, "p.json").unwrap();
    assert!(problem.warnings.is_empty());
    let mut written = 0;
    for format in ALL.iter().filter(|format| format.name != "json") {
        // Some formats have no place for such a problem, or are import only.
        let Ok(output) = files::encode(&problem, format) else { continue };
        written += 1;
        let notes = output.notes.join("\n");
        for key in [
            "scale", "motion", "source", "dt", "rows", "bodies", "gravity", "expected", "hunt",
            "answer",
        ] {
            let is_named = notes.split([' ', ',', '\n']).any(|word| word == key);
            assert!(is_named, "{}: {key}: {notes}", format.name);
        }
        let names_objective = notes.contains("objective");
        assert_eq!(names_objective, format.name != "qps", "{}: {notes}", format.name);
    }
    assert!(written >= 4, "{written}");
}
