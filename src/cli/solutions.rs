//! All solutions of a problem, as text and as JSON.

use dashu_ratio::RBig;
use lcplab::lcp::exact::{Face, SolutionSet};
use lcplab::number::readable;
use serde_json::{Value, json};

/// Fractions of more characters are printed as decimals.
const LONGEST: usize = 12;

/// The solutions face by face.
pub fn words(set: &SolutionSet) -> String {
    let count = match &set.faces[..] {
        [] => return "There is no solution.\n".into(),
        [face] if face.is_isolated() => "There is exactly one solution:\n".to_string(),
        [_] => "There are infinitely many solutions:\n".to_string(),
        faces if faces.iter().all(Face::is_isolated) => {
            format!("There are exactly {} solutions:\n", faces.len())
        }
        faces => format!("There are infinitely many solutions, in {} parts:\n", faces.len()),
    };
    let corner = |k: &usize| format!("  x = {}\n", vector(&set.corners[*k]));
    let ray = |k: &usize| format!("  without end in the direction {}\n", vector(&set.rays[*k]));
    let face = |face: &Face| {
        let head = if face.corners.len() > 1 { "every point between\n" } else { "" };
        let corners: String = face.corners.iter().map(corner).collect();
        let rays: String = face.rays.iter().map(ray).collect();
        format!("{head}{corners}{rays}")
    };
    count + &set.faces.iter().map(face).collect::<String>()
}

/// The same as JSON: fractions as strings, and x as numbers.
pub fn to_json(set: &SolutionSet) -> String {
    let exact = |v: &Vec<RBig>| -> Value { v.iter().map(RBig::to_string).collect() };
    let numbers = |v: &Vec<RBig>| -> Value { v.iter().map(|x| x.to_f64().value()).collect() };
    let face = |face: &Face| json!({ "corners": face.corners, "rays": face.rays });
    let object = json!({
        "unique": set.is_unique(),
        "corners": set.corners.iter().map(numbers).collect::<Vec<_>>(),
        "rays": set.rays.iter().map(numbers).collect::<Vec<_>>(),
        "exact_corners": set.corners.iter().map(exact).collect::<Vec<_>>(),
        "exact_rays": set.rays.iter().map(exact).collect::<Vec<_>>(),
        "faces": set.faces.iter().map(face).collect::<Vec<_>>(),
    });
    format!("{object:#}\n")
}

fn vector(x: &[RBig]) -> String {
    let entry = |x: &RBig| match x.to_string() {
        short if short.len() <= LONGEST => short,
        _ => readable(x.to_f64().value(), 6),
    };
    format!("({})", x.iter().map(entry).collect::<Vec<_>>().join(", "))
}
