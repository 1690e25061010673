//! All solutions of a problem, as text and as JSON.

use dashu_ratio::RBig;
use lcplab::lcp::exact::{Face, SolutionSet};
use lcplab::number::readable;
use serde_json::{Value, json};

/// Fractions of more characters are printed as decimals.
const LONGEST: usize = 12;

/// The solutions: the faces with more than a point, then the isolated ones.
pub fn words(set: &SolutionSet) -> String {
    let (isolated, faces): (Vec<&Face>, Vec<&Face>) =
        set.faces.iter().partition(|face| face.is_isolated());
    let count = match (faces.len(), isolated.len()) {
        (0, 0) => return "There is no solution.\n".into(),
        (0, 1) => "There is exactly one solution:".to_string(),
        (0, all) => format!("There are exactly {all} solutions:"),
        (1, 0) => "There are infinitely many solutions:".to_string(),
        (parts, 0) => format!("There are infinitely many solutions, in {parts} parts:"),
        (parts, points) => {
            let parts = if parts == 1 { "in one part".into() } else { format!("in {parts} parts") };
            let points = if points == 1 { "one".into() } else { points.to_string() };
            format!("There are infinitely many solutions, {parts}, and {points} isolated:")
        }
    };
    let mut text = format!("{count}\n");
    for face in &faces {
        let corners = listed(face.corners.iter().map(|k| &set.corners[*k]));
        let ray = |k: &usize| format!("  without end in the direction {}\n", vector(&set.rays[*k]));
        let rays: String = face.rays.iter().map(ray).collect();
        let head = if face.corners.len() > 1 { "every point between" } else { "every point from" };
        text += &format!("{head}\n{corners}{rays}");
    }
    if !faces.is_empty() && !isolated.is_empty() {
        text += "isolated\n";
    }
    text + &listed(isolated.iter().flat_map(|face| &face.corners).map(|k| &set.corners[*k]))
}

/// A line for each point; points that look alike with the digits shown have one line.
fn listed<'a>(points: impl Iterator<Item = &'a Vec<RBig>>) -> String {
    let mut lines: Vec<String> = Vec::new();
    let mut alike = 0;
    for point in points {
        let line = format!("  x = {}\n", vector(point));
        match lines.contains(&line) {
            true => alike += 1,
            false => lines.push(line),
        }
    }
    let points = if alike == 1 { "point, which differs" } else { "points, which differ" };
    let left_out = match alike {
        0 => String::new(),
        _ => format!("  and {alike} more {points} by less than the digits shown: see --json\n"),
    };
    lines.concat() + &left_out
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
