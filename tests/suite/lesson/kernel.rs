//! What a Jupyter kernel for Rust gets: it keeps variables from cell to cell, but no closures and
//! nothing borrowed.

use lcplab::lesson::Program;
use serde_json::Value;

/// The code cells of a notebook made of these cells, the first one, which loads the library, left
/// out.
fn cells(codes: &[&str]) -> Vec<String> {
    let text: String = codes.iter().map(|code| format!("```rust\n{code}\n```\n\n")).collect();
    let text: &'static str = format!("# A lesson\n\n{text}").leak();
    let program = Program { name: "01_test", text, cells: || Ok(()), drawings: &[], problems: "" };
    let notebook: Value =
        serde_json::from_str(&program.rust_notebook(&program.run().unwrap()).unwrap()).unwrap();
    let lines = |cell: &Value| -> String {
        cell["source"].as_array().unwrap().iter().map(|line| line.as_str().unwrap()).collect()
    };
    let all = notebook["cells"].as_array().unwrap().iter();
    all.filter(|cell| cell["cell_type"] == "code").skip(1).map(lines).collect()
}

#[test]
fn what_no_later_cell_uses_stays_inside() {
    let made = cells(&["let a = 1;\nlet b = 2;\nlet c = a + b;", "println!(\"{c}\");"]);
    assert_eq!(made[0], "let c = {\nlet a = 1;\nlet b = 2;\nlet c = a + b;\nc\n};");
    assert_eq!(made[1], "println!(\"{c}\");");
}

#[test]
fn a_closure_is_said_again_where_it_is_called_and_what_it_uses_is_kept() {
    let made = cells(&[
        "let (m, g) = (2.0, 9.81);\nlet weight = |n: f64| n * m * g;",
        "let x = 1;",
        "show(weight(3.0));",
    ]);
    assert_eq!(
        made[0],
        "let (m, g) = {\nlet (m, g) = (2.0, 9.81);\nlet weight = |n: f64| n * m * g;\n(m, g)\n};"
    );
    assert!(
        made[2].contains("let weight = |n: f64| n * m * g;\nshow(weight(3.0));"),
        "{}",
        made[2]
    );
}

#[test]
fn items_stand_outside_so_that_later_cells_see_them() {
    let made = cells(&[
        "use std::f64::consts::PI;\nfn area(r: f64) -> f64 {\n    PI * r * r\n}\nlet r = 2.0;\nlet unused = 1;",
        "show(area(r));",
    ]);
    assert!(made[0].starts_with(
        "use std::f64::consts::PI;\nfn area(r: f64) -> f64 {\n    PI * r * r\n}\nlet r = {\n"
    ));
}

#[test]
fn a_name_that_is_defined_again_is_not_kept_for_it() {
    // The second cell makes its own a; the third one uses that.
    let made = cells(&["let a = vec![1];\nuse_up(a);", "let a = vec![2];", "show(&a);"]);
    assert_eq!(made[0], "{\nlet a = vec![1];\nuse_up(a);\n}");
    assert_eq!(made[1], "let a = vec![2];");
}

#[test]
fn a_parameter_of_a_closure_is_no_use_and_what_stands_behind_its_bars_is() {
    let made = cells(&["let speed = 1;\nlet t = 2;", "show(times.map(|t| (t, speed * t)));"]);
    assert_eq!(made[0], "let speed = {\nlet speed = 1;\nlet t = 2;\nspeed\n};");
}

#[test]
fn words_in_comments_strings_methods_and_macros_are_no_uses() {
    let later = "// the total of plot\nprintln!(\"total\"); x.total(); total!(1); point.total = 3;";
    let made = cells(&["let total = 1;\nlet other = 2;", later]);
    assert_eq!(made[0], "{\nlet total = 1;\nlet other = 2;\n}");
    let made = cells(&["let total = 1;\nlet other = 2;", "println!(\"{total:.3}\");"]);
    assert!(made[0].starts_with("let total = {"), "{}", made[0]);
}
