//! Find the bug 2.b: the row of a contact.
//!
//! Two bodies touch at a point. Given are their centers, the point (all in m), and a normal that
//! points from body 0 to body 1, of any length. The program should return the row J with ċ = J u,
//! u = (v0, ω0, v1, ω1): how fast the gap opens. Its users say: "Balls that meet are right. But a
//! box that comes down on an edge starts to turn the wrong way round, and the edge goes on into the
//! ground." There is exactly one mistake.

/// J, twelve numbers.
pub fn answer(centers: [[f64; 3]; 2], point: [f64; 3], normal: [f64; 3]) -> [f64; 12] {
    let size = normal.iter().map(|entry| entry * entry).sum::<f64>().sqrt();
    let n = normal.map(|entry| entry / size);
    let arm = |body: usize| -> [f64; 3] { std::array::from_fn(|k| point[k] - centers[body][k]) };
    let (r0, r1) = (arm(0), arm(1));
    // Body 0 closes the gap where body 1 opens it.
    let (turn0, turn1) = (cross(n, r0), cross(r1, n));
    std::array::from_fn(|k| match k {
        0..3 => -n[k],
        3..6 => turn0[k - 3],
        6..9 => n[k - 6],
        _ => turn1[k - 9],
    })
}

/// The vector product a × b.
fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
