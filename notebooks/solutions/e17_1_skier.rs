//! Exercise 17.1: a skier, and where she takes off.
//!
//! A skier of mass m (kg) is on a hill of the height z = h(x), without friction. At her place h has
//! the slope h' and the bend h''; she moves along the snow with v_x (m/s). The gap is c = z - h(x).
//! Find J and J'u, and then the force of the snow at acceleration level: it may push but not pull,
//! and c̈ ≥ 0. If c̈ > 0 without a force, she takes off. g = 9.81 m/s².

/// The force of the snow on her, [F_x, F_z] (N).
pub fn answer(m: f64, slope: f64, bend: f64, v_x: f64) -> [f64; 2] {
    // ċ = ż - h' ẋ and c̈ = z̈ - h' ẍ - h'' ẋ²
    let j = [-slope, 1.0];
    let product = -bend * v_x * v_x;
    let a = (j[0] * j[0] + j[1] * j[1]) / m;
    let b = j[1] * -9.81 + product;
    let force = f64::max(0.0, -b / a);
    [j[0] * force, j[1] * force]
}
