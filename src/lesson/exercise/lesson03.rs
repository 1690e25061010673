//! Checks of lesson 3, from Newton's law to the LCP.

use super::Verdict;

/// Three components.
type Triple = [f64; 3];
/// Three rows of three entries.
type Square = [Triple; 3];

/// b of a row: held against a body that is really stepped, without any impulse.
///
/// # Errors
/// Says for which motion b is not the velocity along the row after the step.
pub fn offset(answer: fn(Triple, Triple, Triple, f64, f64) -> f64) -> Verdict {
    for (case, j, u, force, mass, dt) in [
        ("a body that only moves", [0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.0; 3], 1.0, 0.1),
        ("a body that only falls", [0.0, 0.0, 1.0], [0.0; 3], [0.0, 0.0, -9.81], 1.0, 0.1),
        ("a heavy body", [0.0, 0.0, 1.0], [0.0; 3], [0.0, 0.0, -9.81], 4.0, 0.1),
        ("a step of 1 s", [0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [0.0, 0.0, -1.0], 1.0, 1.0),
        ("a slanted row", [0.6, 0.0, 0.8], [1.0, -2.0, 0.5], [3.0, 1.0, -19.62], 2.0, 0.02),
    ] {
        let b = answer(j, u, force, 1.0 / mass, dt);
        let along: f64 = (0..3).map(|k| (mass * u[k] + dt * force[k]) * j[k]).sum();
        if !((b - along / mass).abs() < 1e-12 * (1.0 + b.abs())) {
            return Err(format!(
                "{case} (dt = {dt} s): left to itself it does not move along the row at b = {b} m/s \
                 after the step"
            ));
        }
    }
    Ok(())
}

/// A: held against bodies that are given unit impulses, row by row.
///
/// # Errors
/// Says which entry is not the response to an impulse.
pub fn delassus(answer: fn(Square, Triple) -> Square) -> Verdict {
    let stack = [[1.0, 0.0, 0.0], [-1.0, 1.0, 0.0], [0.0, -1.0, 1.0]];
    let other = [[1.0, -1.0, 0.0], [0.0, 1.0, -1.0], [1.0, 0.0, 2.0]];
    for (j, inverse_mass) in
        [(stack, [1.0, 1.0, 1.0]), (stack, [1.0, 0.5, 0.1]), (other, [2.0, 0.0, 0.25])]
    {
        let a = answer(j, inverse_mass);
        for k in 0..3 {
            let velocity: [f64; 3] = std::array::from_fn(|body| inverse_mass[body] * j[k][body]);
            for i in 0..3 {
                let opens: f64 = (0..3).map(|body| j[i][body] * velocity[body]).sum();
                if !((a[i][k] - opens).abs() < 1e-12) {
                    return Err(format!(
                        "J = {j:?}, inverse masses {inverse_mass:?}: a unit impulse in row {k} does not \
                         open gap {i} at A[{i}][{k}] = {} m/s",
                        a[i][k]
                    ));
                }
            }
        }
    }
    Ok(())
}

/// A pendulum at both levels: held against what each level asks of the bob's motion.
///
/// # Errors
/// Says which level's demand is not met.
pub fn two_levels(answer: fn(f64, f64, f64, f64, f64, f64) -> [f64; 2]) -> Verdict {
    let g = 9.81;
    for (m, l, phi, omega, dt) in
        [(1.0, 1.0, 0.7, 1.3, 0.01), (2.0, 0.5, -1.0, 3.0, 0.02), (1.0, 1.0, 0.0, 0.0, 0.1)]
    {
        let [x, force] = answer(m, l, g, phi, omega, dt);
        let place = format!("m = {m}, l = {l}, φ = {phi}, ω = {omega}, dt = {dt}");
        let (n, v) = ([phi.sin(), -phi.cos()], [l * omega * phi.cos(), l * omega * phi.sin()]);
        let after = [v[0] + n[0] * x / m, v[1] - dt * g + n[1] * x / m];
        let along = n[0] * after[0] + n[1] * after[1];
        if !(along.abs() < 1e-9) {
            return Err(format!(
                "{place}: with the impulse x = {x} N s the bob moves along n at {along} m/s after the \
                 step, which the velocity level does not allow"
            ));
        }
        // On a circle of radius l the acceleration along n is that of a turning arm.
        let acceleration = n[0] * (n[0] * force / m) + n[1] * (n[1] * force / m - g);
        let wanted = v[0].hypot(v[1]).powi(2) / l;
        if !((acceleration + wanted).abs() < 1e-9) {
            return Err(format!(
                "{place}: with the force λ = {force} N the bob's path is not bent into the circle"
            ));
        }
    }
    Ok(())
}
