//! Checks of exercises: complementarity by hand.

use super::Verdict;

/// A box, a hand and the ground: moves the box by the impulses of the answer and checks the three
/// conditions of the lesson in each step.
///
/// # Errors
/// Names the step and the violated condition, or says that the ground pulls.
pub fn hand(answer: fn(f64, &[f64], f64) -> Vec<f64>) -> Verdict {
    let thrown = [0.0, 40.0, 40.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -5.0, 0.0];
    let caught = [12.0, 12.0, 0.0, 7.0, -3.0, 0.0, 0.0, 0.0, 0.0];
    let cases: [(f64, f64, &[f64]); 4] = [
        (2.0, 0.01, &[0.0, -30.0, 10.0, 0.0]),
        (2.0, 0.01, &thrown),
        (0.8, 0.05, &caught),
        (100.0, 0.1, &[500.0, 980.0, 1200.0, 0.0, 0.0, 0.0]),
    ];
    for (m, dt, pull) in cases {
        let got = answer(m, pull, dt);
        if got.len() != pull.len() {
            return Err(format!(
                "{} steps need one impulse each, the answer has {}",
                pull.len(),
                got.len()
            ));
        }
        let (mut z, mut v) = (0.0, 0.0);
        for (k, (&x, force)) in got.iter().zip(pull).enumerate() {
            let touches = z < 1e-9;
            let after = v + dt * (force / m - 9.81) + x / m;
            let at = format!(
                "m = {m} kg, dt = {dt} s, pull = {pull:?} N: before step {k} the box is at z = {z:.6} m \
                 with v = {v:.4} m/s; the ground gives {x:.6} N s, and then v = {after:.4} m/s"
            );
            if !(x >= 0.0) {
                return Err(format!("{at}; the ground cannot pull"));
            }
            if !touches && x > 0.0 {
                return Err(format!("{at}; the ground does not touch the box"));
            }
            if touches && !(after >= -1e-9) {
                return Err(format!("{at}; the box sinks into the ground"));
            }
            if x > 1e-9 && after > 1e-9 {
                return Err(format!("{at}; the box leaves, yet the ground pushes"));
            }
            v = after;
            z += dt * v;
        }
    }
    Ok(())
}

/// One row, w = a x + b with lo ≤ x ≤ hi: checked against the three cases of the definition.
///
/// # Errors
/// Names the case that an answer violates.
pub fn one_row(answer: fn(f64, f64, f64, f64) -> f64) -> Verdict {
    for (a, b, lo, hi) in [
        (2.0, -3.0, 0.0, f64::INFINITY),
        (0.5, 1.0, 0.0, f64::INFINITY),
        (4.0, -12.0, -1.0, 2.0),
        (3.0, 6.0, -1.0, 2.0),
        (3.0, 1.5, -1.0, 2.0),
        (4.0, 2.0, f64::NEG_INFINITY, f64::INFINITY),
        (4.0, -2.0, f64::NEG_INFINITY, 0.25),
        (1.0, -5.0, 6.0, 8.0),
    ] {
        let x = answer(a, b, lo, hi);
        let w = a * x + b;
        let at = format!("a = {a}, b = {b}, bounds [{lo}, {hi}]: x = {x} gives w = {w}");
        if !(lo..=hi).contains(&x) {
            return Err(format!("{at}; x lies outside its bounds"));
        }
        if w > 1e-12 && x > lo {
            return Err(format!("{at}; with w > 0 the impulse must not be above its lower bound"));
        }
        if w < -1e-12 && x < hi {
            return Err(format!("{at}; with w < 0 the impulse must not be below its upper bound"));
        }
    }
    Ok(())
}

/// Two rows, w = A x + b ≥ 0, x ≥ 0, x·w = 0: checked against the definition, entry by entry.
///
/// # Errors
/// Names the condition that an answer violates.
pub fn two_rows(answer: fn([[f64; 2]; 2], [f64; 2]) -> [f64; 2]) -> Verdict {
    let a = [[2.0, -1.0], [-1.0, 2.0]];
    for (a, b) in [
        (a, [-1.0, 2.0]),
        (a, [2.0, -1.0]),
        (a, [-1.0, -1.0]),
        (a, [1.0, 3.0]),
        (a, [0.5, 0.25]),
        ([[2.0, 1.0], [1.0, 2.0]], [-4.0, -1.0]),
    ] {
        solves(a, b, answer(a, b))?;
    }
    Ok(())
}

/// Bug 1.b, the cases of two rows: the same definition, also if one contact loads the other.
///
/// # Errors
/// Names the condition that an answer violates.
pub fn two_contacts(answer: fn([[f64; 2]; 2], [f64; 2]) -> [f64; 2]) -> Verdict {
    let apart = [[2.0, 0.0], [0.0, 1.0]];
    // Three balls in a line.
    let balls = [[2.0, -1.0], [-1.0, 2.0]];
    // Each end of the plank lifts the other.
    let plank = [[2.0, 1.0], [1.0, 2.0]];
    for (a, b) in [
        (apart, [-1.0, -1.0]),
        (apart, [-1.0, 1.0]),
        (balls, [-1.0, 2.0]),
        (balls, [1.0, 3.0]),
        (balls, [-1.0, -1.0]),
        (balls, [-4.0, 1.0]),
        (balls, [-1.0, 1.0]),
        (balls, [0.5, -3.0]),
        (plank, [0.5, 0.25]),
        (plank, [0.25, 2.0]),
        (plank, [-4.0, -1.0]),
        (plank, [-1.0, -6.0]),
        (plank, [-3.0, -3.0]),
        ([[1.0, -1.0], [-1.0, 3.0]], [-2.0, 1.0]),
    ] {
        solves(a, b, answer(a, b))?;
    }
    Ok(())
}

/// Whether x solves w = A x + b ≥ 0, x ≥ 0, x·w = 0.
fn solves(a: [[f64; 2]; 2], b: [f64; 2], x: [f64; 2]) -> Verdict {
    for i in 0..2 {
        let w = a[i][0] * x[0] + a[i][1] * x[1] + b[i];
        let at = format!("A = {a:?}, b = {b:?}: x = {x:?} gives w[{i}] = {w}");
        if !(x[i] >= 0.0) {
            return Err(format!("{at}; x[{i}] must not be negative"));
        }
        if !(w >= -1e-12) {
            return Err(format!("{at}; that contact still closes"));
        }
        if x[i] * w > 1e-12 {
            return Err(format!("{at}; a contact that opens must have no impulse"));
        }
    }
    Ok(())
}
