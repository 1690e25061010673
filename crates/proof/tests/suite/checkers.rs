//! The three checkers side by side: this crate, and the programs in `proofs`, which share nothing
//! with it.

use std::ffi::OsString;
use std::path::{Path, PathBuf};
use std::process::Command;

use lcplab_lcp::Question;
use lcplab_lcp::file::Problem;
use lcplab_proof::{Proof, check};

/// The text of a problem, and that of a proof.
pub type Pair = (String, String);

/// What this crate says: `unreadable` of a problem that is none, else `proved` or `rejected`.
pub fn own(problem: &str, proof: &str) -> &'static str {
    let question = Problem::parse(problem, "problem.json")
        .and_then(|problem| Question::new(&problem, None, "problem.json"));
    let Ok(question) = question else { return "unreadable" };
    let holds =
        Proof::parse(proof, "proof.json").is_ok_and(|proof| check(&question, &proof).is_ok());
    if holds { "proved" } else { "rejected" }
}

/// What the others say of each pair, by the name of the checker. The one in JavaScript takes part
/// where there is a Node.js, or one is named by the variable LCPLAB_NODE.
pub fn others(pairs: &[Pair]) -> Vec<(&'static str, Vec<String>)> {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("pairs");
    let lines = pairs.iter().map(|pair| serde_json::to_string(pair).unwrap() + "\n");
    std::fs::write(&file, lines.collect::<String>()).unwrap();
    let node = node().map(|node| (node, "all.js", "lcpcheck.js"));
    let checkers = [("python3".into(), "all.py", "lcpcheck.py")].into_iter().chain(node);
    let verdicts = |(program, driver, checker): (OsString, &str, &'static str)| {
        let paths =
            [in_crate("tests/checkers").join(driver), in_crate("../../proofs").join(checker)];
        let output = Command::new(program).args(paths).arg(&file).output().unwrap();
        let printed = String::from_utf8(output.stdout).unwrap();
        let verdicts: Vec<String> = printed.lines().map(String::from).collect();
        assert_eq!(verdicts.len(), pairs.len(), "{}", String::from_utf8_lossy(&output.stderr));
        (checker, verdicts)
    };
    checkers.map(verdicts).collect()
}

fn node() -> Option<OsString> {
    std::env::var_os("LCPLAB_NODE").or_else(|| {
        let is_there = Command::new("node").arg("--version").output().is_ok();
        is_there.then(|| "node".into())
    })
}

pub fn in_crate(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}
