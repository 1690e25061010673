//! Other people's solvers as plug-ins, where their packages are installed for the Python of
//! `LCPLAB_PYTHON` (python3 without it).

use std::process::Command;

use serde_json::Value;

use super::{err, out, run};

/// The adapters, the packages that they need, and a family that they are not made for: a matrix
/// that is not symmetric, or rows that may pull.
const ADAPTERS: [(&str, &str, &str); 8] = [
    ("use_osqp", "numpy, osqp, scipy", "murty"),
    ("use_quadprog", "numpy, quadprog", "murty"),
    ("use_proxsuite", "numpy, proxsuite", "murty"),
    ("use_lsq_linear", "numpy, scipy", "murty"),
    ("use_pinocchio", "numpy, pinocchio", "murty"),
    ("use_moby", "numpy, pydrake", "mcp09"),
    ("use_siconos", "numpy, siconos", "mcp09"),
    ("use_quantecon", "numpy, quantecon", "mcp09"),
];

#[test]
fn each_adapter_solves_a_definite_problem_and_leaves_the_others_alone() {
    let python = std::env::var("LCPLAB_PYTHON").unwrap_or_else(|_| "python3".into());
    for (name, packages, other) in ADAPTERS {
        let imports = Command::new(&python).args(["-c", &format!("import {packages}")]).output();
        if !imports.is_ok_and(|output| output.status.success()) {
            eprintln!("skipped: {name} needs {packages}");
            continue;
        }
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/examples/plugins/");
        let plugin = format!("'{python}' '{file}{name}.py'");
        let compare = ["compare", "pd", other, "pushed-rod"];
        let output = run(&[
            &compare[..],
            &["--seeds", "1", "--json", "--solver", "dantzig", "--plugin", &plugin],
        ]
        .concat());
        let table: Value =
            serde_json::from_str(&out(&output)).unwrap_or_else(|_| panic!("{}", err(&output)));
        let row = |family: &str| {
            let rows = table["rows"].as_array().unwrap().iter();
            rows.clone()
                .find(|row| {
                    row["family"] == family && row["solver"] == name && row["model"] != "frozen-box"
                })
                .unwrap()
                .clone()
        };
        assert_eq!(row("pd")["accepted"], 1, "{}", row("pd"));
        for other in [other, "pushed-rod"] {
            assert_eq!(
                (&row(other)["claimed"], &row(other)["outside"]),
                (&0.into(), &1.into()),
                "{name}"
            );
        }
    }
}
