//! Checks of exercises: from Newton's law to the LCP.

use super::Verdict;

/// Three components.
type Triple = [f64; 3];
/// Three rows of three entries.
type Square = [Triple; 3];
/// A column of balls: applies the impulses of the answer and checks complementarity at each
/// contact.
///
/// # Errors
/// Names the contact that closes, pulls, or pushes although it opens.
pub fn column(answer: fn(&[f64], &[f64]) -> Vec<f64>) -> Verdict {
    let cases: [(&[f64], &[f64]); 10] = [
        (&[1.0, 1.0, 1.0], &[-1.0, -2.0, -1.0]),
        (&[3.0, 0.5, 2.0], &[-0.25, -0.25, -0.25]),
        (&[1.0, 1.0, 1.0], &[0.0, 1.0, 0.0]),
        (&[1.0, 1.0], &[-2.0, 3.0]),
        (&[1.0, 1.0], &[3.0, -1.0]),
        (&[1.0, 1.0, 1.0], &[1.0, 2.0, -4.0]),
        (&[2.0, 1.0, 4.0], &[2.0, 1.0, -1.0]),
        (&[1.0, 2.0, 1.0, 5.0, 0.5], &[3.0, 1.0, 2.0, 0.5, 5.0]),
        (&[1.0, 1.0, 3.0, 1.0, 1.0], &[-5.0, 2.0, 1.0, -0.5, 4.0]),
        (&[2.0], &[1.5]),
    ];
    for (m, u) in cases {
        let n = m.len();
        let x = answer(m, u);
        if x.len() != n {
            return Err(format!("{n} balls have {n} contacts, the answer has {}", x.len()));
        }
        let above = |k: usize| x.get(k + 1).copied().unwrap_or(0.0);
        let v: Vec<f64> = (0..n).map(|k| u[k] + (x[k] - above(k)) / m[k]).collect();
        for k in 0..n {
            let w = if k == 0 { v[0] } else { v[k] - v[k - 1] };
            let at = format!("masses {m:?}, u* = {u:?}, x = {x:.6?}: the velocities are {v:.6?}");
            if !(x[k] >= -1e-12) {
                return Err(format!("{at}; contact {k} pulls"));
            }
            if !(w >= -1e-9) {
                return Err(format!("{at}; contact {k} still closes"));
            }
            if x[k] > 1e-9 && w > 1e-9 {
                return Err(format!("{at}; contact {k} opens, yet it pushes"));
            }
        }
    }
    Ok(())
}

/// Bug 3.b, a step with one row between two bodies: checked against momentum and complementarity.
///
/// # Errors
/// Says what the bodies do instead.
pub fn step(answer: fn([f64; 2], [f64; 2], [f64; 2], f64) -> [f64; 2]) -> Verdict {
    for (name, inverse_mass, u, force, dt) in [
        ("a book on a table, dt = 1 s", [0.0, 1.0], [0.0, 0.0], [0.0, -9.81], 1.0),
        ("two balls meet", [1.0, 0.5], [1.0, -1.0], [0.0, 0.0], 0.01),
        ("two balls fall, the upper one flies off", [1.0, 1.0], [0.0, 1.0], [-9.81, -9.81], 0.01),
        ("a book on a table, dt = 0.01 s", [0.0, 1.0], [0.0, 0.0], [0.0, -9.81], 0.01),
        ("a book that is lifted", [0.0, 2.0], [0.0, 0.1], [0.0, 20.0], 0.01),
        ("a press", [0.25, 2.0], [0.0, 0.0], [30.0, -50.0], 0.02),
    ] {
        let after = answer(inverse_mass, u, force, dt);
        let free: [f64; 2] = std::array::from_fn(|k| u[k] + dt * inverse_mass[k] * force[k]);
        let change: [f64; 2] = std::array::from_fn(|k| after[k] - free[k]);
        let at = format!(
            "{name}: without contact the velocities would be {free:?} m/s, the program says {after:?}"
        );
        // The impulse on body 1, and that on body 0.
        let given = inverse_mass[1] * change[0] + inverse_mass[0] * change[1];
        if !(given.abs() < 1e-12) {
            return Err(format!("{at}; the impulses on the two bodies are not equal and opposite"));
        }
        let (w, push) = (after[1] - after[0], change[1] - change[0]);
        if !(push >= -1e-12) {
            return Err(format!("{at}; the contact pulls the bodies together"));
        }
        if !(w >= -1e-12) {
            return Err(format!("{at}; the contact still closes at {:.4} m/s", -w));
        }
        if push > 1e-12 && w > 1e-12 {
            return Err(format!(
                "{at}; the contact pushes, and then the bodies part at {w:.4} m/s"
            ));
        }
    }
    Ok(())
}

/// A: compared with the response of the bodies to unit impulses, row by row.
///
/// # Errors
/// Names the entry that is not the response to an impulse.
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

/// A pendulum at both levels: checked against the condition of each level on the bob's motion.
///
/// # Errors
/// Names the level whose condition is violated.
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
        // On a circle of radius l the acceleration along n is centripetal.
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
