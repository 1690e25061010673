//! Exercise 2.3: a rod between two bodies.
//!
//! Two bodies move and turn. Their centers are at p[0] and p[1] (m). One end of a rod is fixed in
//! body 0, at the arm r[0] (m) from its center, the other in body 1 at the arm r[1]; the arms are
//! given in world axes. c is the distance of the two ends minus the length of the rod. Find the row
//! J with ċ = J u, u = (v0, ω0, v1, ω1), three numbers each.

/// J, twelve numbers.
pub fn answer(p: [[f64; 3]; 2], r: [[f64; 3]; 2]) -> [f64; 12] {
    let d: [f64; 3] = std::array::from_fn(|k| p[1][k] + r[1][k] - p[0][k] - r[0][k]);
    let n = d.map(|d_k| d_k / (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt());
    let cross = |r: [f64; 3]| {
        [r[1] * n[2] - r[2] * n[1], r[2] * n[0] - r[0] * n[2], r[0] * n[1] - r[1] * n[0]]
    };
    let turns = [cross(r[0]), cross(r[1])]; // n · (ω × r) = (r × n) · ω
    std::array::from_fn(|k| match k {
        0..3 => -n[k],
        3..6 => -turns[0][k - 3],
        6..9 => n[k - 6],
        _ => turns[1][k - 9],
    })
}
