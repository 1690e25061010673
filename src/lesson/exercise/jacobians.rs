//! Checks of exercises: Jacobians.

use nalgebra::{Rotation3, Vector3};

use super::Verdict;

/// Three components.
type Triple = [f64; 3];

/// The row of a rod and its J'u: compared with difference quotients of the distance.
///
/// # Errors
/// Names the wrong number and its place.
pub fn rod(answer: fn(Triple, Triple) -> (Triple, f64)) -> Verdict {
    for (p, v) in [
        ([3.0, 4.0, 0.0], [2.0, -1.0, 0.0]),
        ([0.0, 0.0, -1.0], [1.5, 0.0, 0.0]),
        ([1.0, -2.0, 2.0], [0.3, 0.7, -1.1]),
    ] {
        let (j, product) = answer(p, v);
        let at = |t: f64| (Vector3::from(p) + Vector3::from(v) * t).norm();
        for (k, entry) in j.iter().enumerate() {
            let along = |h: f64| (Vector3::from(p) + Vector3::ith(k, h)).norm();
            let slope = (along(1e-5) - along(-1e-5)) / 2e-5;
            if !((entry - slope).abs() < 1e-6) {
                return Err(format!(
                    "bob at {p:?}: J[{k}] is {entry}, but moving the bob a little along axis {k} changes \
                     its distance by another amount per meter"
                ));
            }
        }
        let bend = (at(1e-4) - 2.0 * at(0.0) + at(-1e-4)) / 1e-8;
        if !((product - bend).abs() < 1e-5) {
            return Err(format!(
                "bob at {p:?}, velocity {v:?}: J'u is {product}, but the distance of a bob that flies \
                 straight on is bent otherwise; only the velocity across the rod bends it"
            ));
        }
    }
    Ok(())
}

/// The rows of a nail: compared with a body that is actually moved and rotated slightly.
///
/// # Errors
/// Names the motion for which the point moves differently.
pub fn nail(answer: fn([f64; 3]) -> [[f64; 6]; 3]) -> Verdict {
    let names = ["v_x", "v_y", "v_z", "ω_x", "ω_y", "ω_z"];
    for r in [[1.0, 0.0, 0.0], [0.3, -0.7, 0.2], [-1.5, 0.4, 2.0]] {
        let rows = answer(r);
        for (k, name) in names.into_iter().enumerate() {
            let place = |h: f64| match k {
                0..3 => Vector3::from(r) + Vector3::ith(k, h),
                _ => Rotation3::new(Vector3::ith(k - 3, h)) * Vector3::from(r),
            };
            let velocity = (place(1e-5) - place(-1e-5)) / 2e-5;
            let column = Vector3::new(rows[0][k], rows[1][k], rows[2][k]);
            if !((column - velocity).norm() < 1e-6) {
                return Err(format!(
                    "arm r = {r:?}: for a body with {name} = 1 alone the nail's point does not move at {:?}",
                    column.as_slice()
                ));
            }
        }
    }
    Ok(())
}
/// The row of a rod between two bodies: compared with bodies that are actually moved and rotated
/// slightly.
///
/// # Errors
/// Names the motion for which the ends separate differently.
pub fn two_ends(answer: fn([Triple; 2], [Triple; 2]) -> [f64; 12]) -> Verdict {
    for (p, r) in [
        ([[0.0; 3], [3.0, 0.0, 4.0]], [[0.0; 3]; 2]),
        ([[0.0; 3], [2.0, 0.0, 0.0]], [[0.5, 0.3, 0.0], [-0.5, 1.1, 0.0]]),
        ([[0.2, -0.1, 0.4], [1.1, 1.9, -0.3]], [[0.5, 0.1, -0.2], [-0.3, 0.4, 0.6]]),
    ] {
        let row = answer(p, r);
        for (k, entry) in row.iter().enumerate() {
            let (body, axis) = (k / 6, Vector3::ith(k % 3, 1.0));
            let turns = k % 6 >= 3;
            let end = |b: usize, h: f64| {
                let h = if b == body { h } else { 0.0 };
                let (p, r) = (Vector3::from(p[b]), Vector3::from(r[b]));
                match turns {
                    true => p + Rotation3::new(axis * h) * r,
                    false => p + axis * h + r,
                }
            };
            let distance = |h: f64| (end(1, h) - end(0, h)).norm();
            let slope = (distance(1e-5) - distance(-1e-5)) / 2e-5;
            if !((entry - slope).abs() < 1e-6) {
                let name = if turns { "ω" } else { "v" };
                let axis = ["x", "y", "z"][k % 3];
                return Err(format!(
                    "centers {p:?}, arms {r:?}: if body {body} has {name}_{axis} = 1 and nothing else moves, \
                     the ends part at {slope:.6} m/s, but J[{k}] = {entry}"
                ));
            }
        }
    }
    Ok(())
}

/// Bug 2.b, the row of a contact: compared with the separation speed of the two contact points.
///
/// # Errors
/// Names the motion for which the gap opens differently.
pub fn contact(answer: fn([Triple; 2], Triple, Triple) -> [f64; 12]) -> Verdict {
    for (centers, point, normal) in [
        ([[0.0, 0.0, 0.0], [0.0, 0.0, 2.0]], [0.0, 0.0, 1.0], [0.0, 0.0, 1.0]),
        ([[0.0, 0.0, -1.0], [0.5, 0.0, 1.0]], [0.0, 0.0, 0.0], [0.0, 0.0, 3.0]),
        ([[0.4, -0.2, 0.1], [1.3, 0.9, 1.5]], [1.0, 0.2, 0.7], [1.0, 2.0, 2.0]),
    ] {
        let row = answer(centers, point, normal);
        let n = Vector3::from(normal).normalize();
        for (k, entry) in row.iter().enumerate() {
            let (body, turns) = (k / 6, k % 6 >= 3);
            let axis = Vector3::ith(k % 3, 1.0);
            let arm = Vector3::from(point) - Vector3::from(centers[body]);
            let moves = if turns { axis.cross(&arm) } else { axis };
            let opens = if body == 0 { -n.dot(&moves) } else { n.dot(&moves) };
            if !((entry - opens).abs() < 1e-12) {
                let (name, axis) = (if turns { "ω" } else { "v" }, ["x", "y", "z"][k % 3]);
                return Err(format!(
                    "centers {centers:?}, touching at {point:?}, normal {normal:?}: if body {body} has \
                     {name}_{axis} = 1 and nothing else moves, the gap opens at {opens:.4} m/s, but J u = \
                     {entry:.4} m/s"
                ));
            }
        }
    }
    Ok(())
}
