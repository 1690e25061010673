//! Find the bug 17.b: a bead with friction on a wire.
//!
//! A bead of mass m (kg) starts at rest on a straight wire z = slope x and rubs on it with the
//! friction μ. The constraint is c = z - slope x, one equation, so its impulse may have either
//! sign. The program should return the speed along the wire after so many steps of dt (s), to the
//! right positive. Its users say: "On a level wire, and without friction, it is right. On a slope
//! the bead gets too fast, and it slides where it should stay: at 30° with μ = 0.6." There is
//! exactly one mistake.

/// The speed along the wire (m/s).
pub fn answer(slope: f64, mu: f64, m: f64, dt: f64, steps: usize) -> f64 {
    let size = f64::hypot(1.0, slope);
    let along = [1.0 / size, slope / size];
    let j = [-slope, 1.0]; // ċ = J u
    let a = (j[0] * j[0] + j[1] * j[1]) / m;
    let mut u = [0.0, 0.0];
    for _step in 0..steps {
        u[1] -= 9.81 * dt;
        // The wire: ċ = 0.
        let x = -(j[0] * u[0] + j[1] * u[1]) / a;
        u = [u[0] + j[0] * x / m, u[1] + j[1] * x / m];
        // Friction, at most μ times the pressure, against the slip.
        let limit = mu * x.abs();
        let slip = along[0] * u[0] + along[1] * u[1];
        let rub = f64::clamp(-m * slip, -limit, limit);
        u = [u[0] + along[0] * rub / m, u[1] + along[1] * rub / m];
    }
    along[0] * u[0] + along[1] * u[1]
}
