//! Writes QPS in free form, with columns x0, x1, ….

use crate::Output;
use crate::output::decimal;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::Problem;

pub(super) fn write(problem: &Problem) -> Result<Output> {
    let lcp = &problem.lcp;
    if lcp.coupling().is_some() {
        let reason = "is given: in a quadratic program, bounds cannot depend on another unknown";
        return Err(Error::invalid("qps", "friction_index", reason));
    }
    if !lcp.matrix().is_symmetric() {
        return Err(Error::invalid("qps", "A", "is not symmetric, so no objective has it"));
    }
    let n = lcp.len();
    let name: Vec<&str> = problem.name.split_whitespace().collect();
    let name = if name.is_empty() { "problem".to_string() } else { name.join("_") };
    let mut text = format!("NAME {name}\nROWS\n N obj\nCOLUMNS\n");
    for (i, c) in lcp.b().iter().enumerate() {
        text += &format!(" x{i} obj {}\n", decimal(*c));
    }
    text += "RHS\nBOUNDS\n";
    for i in 0..n {
        text += &bounds(i, lcp.lo()[i], lcp.hi()[i]);
    }
    text += "QUADOBJ\n";
    for i in 0..n {
        for (j, a) in lcp.matrix().row(i).iter().filter(|(j, a)| *j >= i && *a != 0.0) {
            text += &format!(" x{i} x{j} {}\n", decimal(a));
        }
    }
    Ok(Output::of(text + "ENDATA\n"))
}

/// The bound lines of a column; empty for 0 and ∞.
fn bounds(i: usize, lo: f64, hi: f64) -> String {
    let line = |kind: &str, value: f64| format!(" {kind} bnd x{i} {}\n", decimal(value));
    let bare = |kind: &str| format!(" {kind} bnd x{i}\n");
    let upper = if hi == f64::INFINITY { String::new() } else { line("UP", hi) };
    match (lo, hi) {
        (lo, hi) if lo == hi => line("FX", lo),
        (f64::NEG_INFINITY, f64::INFINITY) => bare("FR"),
        (f64::NEG_INFINITY, _) => bare("MI") + &upper,
        (0.0, _) => upper,
        _ => line("LO", lo) + &upper,
    }
}
