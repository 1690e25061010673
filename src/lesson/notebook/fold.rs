//! Folds of several cells: Jupyter renders each cell on its own, so a fold must end where it began.

use serde_json::{Value, json};

const OPEN: &str = "<details>";
const CLOSE: &str = "</details>";

/// The cells with each fold in one of them: the prose and figures of a fold become one cell. Where
/// a fold contains code, it ends before the first code, and the output of its code is collapsed.
pub(super) fn folded(cells: Vec<Value>) -> Vec<Value> {
    let mut out: Vec<Value> = Vec::new();
    let mut depth = 0;
    let mut has_code = false; // whether the open fold has had code
    for mut cell in cells {
        let text = source(&cell);
        let is_code = cell["cell_type"] == "code";
        let before = depth;
        if !is_code {
            depth =
                (depth + text.matches(OPEN).count()).saturating_sub(text.matches(CLOSE).count());
        }
        match (before > 0, is_code, has_code) {
            (false, ..) => out.push(cell),
            (true, true, _) => {
                if !has_code && let Some(last) = out.last_mut() {
                    append(last, &json!({ "source": CLOSE }));
                }
                has_code = true;
                cell["metadata"]["jupyter"]["outputs_hidden"] = json!(true);
                out.push(cell);
            }
            (true, false, true) => {
                let rest = text.replacen(CLOSE, "", 1);
                if !rest.trim().is_empty() {
                    cell["source"] = json!(super::lined(rest.trim()));
                    out.push(cell);
                }
            }
            (true, false, false) => {
                let last = out.last_mut().expect("the cell that opened the fold");
                append(last, &cell);
            }
        }
        has_code &= depth > 0;
    }
    out
}

/// Appends prose with its attachments, whose names are made different from those that are there.
fn append(cell: &mut Value, next: &Value) {
    let mut text = source(next);
    for (name, file) in next["attachments"].as_object().into_iter().flatten() {
        let mut own = name.clone();
        while !cell["attachments"][&own].is_null() {
            own = format!("further-{own}");
        }
        text = text.replace(&format!("](attachment:{name})"), &format!("](attachment:{own})"));
        cell["attachments"][&own] = file.clone();
    }
    cell["source"] = json!(super::lined(&format!("{}\n\n{text}", source(cell).trim_end())));
}

fn source(cell: &Value) -> String {
    match &cell["source"] {
        Value::Array(lines) => lines.iter().filter_map(Value::as_str).collect(),
        text => text.as_str().unwrap_or_default().to_string(),
    }
}
