//! Checks of exercises: impacts and Painlevé's rod.

use super::Verdict;
use crate::lcp::{Lcp, Matrix};
use crate::solver::all_solutions;

/// Two balls: checked against the laws of momentum and restitution.
///
/// # Errors
/// Names the violated law.
pub fn two_balls(answer: fn([f64; 2], [f64; 2], f64) -> [f64; 2]) -> Verdict {
    for (m, v, e) in [
        ([1.0, 1.0], [1.0, 0.0], 1.0),
        ([2.0, 3.0], [4.0, -1.0], 0.5),
        ([5.0, 0.5], [1.0, 0.0], 0.0),
        ([1.0, 2.0], [-1.0, 1.0], 0.8),
        ([1.0, 1e6], [3.0, 0.0], 1.0),
    ] {
        let after = answer(m, v, e);
        let at = format!("masses {m:?}, velocities {v:?}, e = {e}: {after:?}");
        let momentum = |v: [f64; 2]| m[0] * v[0] + m[1] * v[1];
        let size = m[0] * v[0].abs() + m[1] * v[1].abs();
        if !((momentum(after) - momentum(v)).abs() <= 1e-9 * size) {
            return Err(format!("{at}; the momentum has changed"));
        }
        let (closing, parting) = (v[0] - v[1], after[1] - after[0]);
        if closing <= 0.0 {
            if after != v {
                return Err(format!("{at}; these balls do not approach, what acted on them?"));
            }
        } else if !((parting - e * closing).abs() <= 1e-9 * closing) {
            return Err(format!("{at}; they approached with {closing} and part with {parting}"));
        }
    }
    Ok(())
}

/// One row with any a: compared with all active sets, tried in exact arithmetic.
///
/// # Errors
/// Says what a listed x violates, or that answers are missing.
pub fn all_answers(answer: fn(f64, f64) -> Vec<f64>) -> Verdict {
    for (a, b) in [(2.0, -3.0), (2.0, 3.0), (-0.8, 0.5), (-0.8, -0.5), (-4.0, 1.0)] {
        let got = answer(a, b);
        for (k, &x) in got.iter().enumerate() {
            let w = a * x + b;
            let at = format!("a = {a}, b = {b}: x = {x} gives w = {w}");
            if !(x >= 0.0 && w >= -1e-12) {
                return Err(format!("{at}; neither may be negative"));
            }
            if x * w > 1e-12 {
                return Err(format!("{at}; one of them must be 0"));
            }
            if got[..k].contains(&x) {
                return Err(format!("a = {a}, b = {b}: x = {x} is listed twice"));
            }
        }
        let lcp = Lcp::new(Matrix::dense(1, &[a]), vec![b], vec![0.0], vec![f64::INFINITY])
            .map_err(|error| error.to_string())?;
        let count = all_solutions(&lcp).map_or(0, |all| all.len());
        if got.len() != count {
            return Err(format!("a = {a}, b = {b}: {got:?} are not all of them"));
        }
    }
    Ok(())
}

/// The critical friction: checked by the sign of a just below and just above it, a = J_n M⁻¹
/// (J_n + μ J_t)ᵀ.
///
/// # Errors
/// Names the angle at which the sign does not change.
pub fn critical_friction(answer: fn(f64, f64) -> f64) -> Verdict {
    for k in [1.0 / 3.0, 1.0] {
        for degrees in [20.0f64, 45.0, 63.435, 80.0] {
            let theta = degrees.to_radians();
            let mu = answer(theta, k);
            let (normal, tangent) = ([0.0, 1.0, -theta.cos()], [1.0, 0.0, theta.sin()]);
            let inverse_mass = [1.0, 1.0, 1.0 / k];
            let a = |mu: f64| -> f64 {
                (0..3).map(|i| normal[i] * inverse_mass[i] * (normal[i] + mu * tangent[i])).sum()
            };
            let at = format!("θ = {degrees}°, k = {k:.3}: μ = {mu}");
            if !(a(0.999 * mu) > 0.0) {
                return Err(format!("{at} is too large: a is negative at less already"));
            }
            if !(a(1.001 * mu) < 0.0) {
                return Err(format!("{at} is too small: a is still positive there"));
            }
        }
    }
    Ok(())
}

/// Bug 12.b, a ball that falls to the ground: each step is compared with free flight and
/// restitution.
///
/// # Errors
/// Names the step in which the ball has a wrong speed.
pub fn bounce(answer: fn(f64, f64, f64, usize) -> Vec<[f64; 2]>) -> Verdict {
    for (height, e, dt, steps) in [
        (0.0, 0.5, 0.01, 3),
        (1.0, 1.0, 0.01, 150),
        (1.0, 0.5, 0.01, 300),
        (0.3, 0.8, 0.02, 100),
        (2.0, 0.0, 0.03, 40),
    ] {
        let got = answer(height, e, dt, steps);
        if got.len() != steps {
            return Err(format!("{steps} steps need one state each, the answer has {}", got.len()));
        }
        let (mut z, mut v) = (height, 0.0);
        for (k, [now, after]) in got.into_iter().enumerate() {
            let free = v - 9.81 * dt;
            let at = format!(
                "from {height} m, e = {e}, dt = {dt} s: in step {k} the ball comes from z = {z:.4} m with {v:.4} m/s \
                 and has {after:.4} m/s after it, at z = {now:.4} m"
            );
            if !((now - z - dt * after).abs() < 1e-9) {
                return Err(format!("{at}; that is not where this speed leads"));
            }
            if !(now >= -1e-9) {
                return Err(format!("{at}; it is in the ground"));
            }
            if after < free - 1e-9 {
                return Err(format!("{at}; the ground has pulled at it"));
            }
            if after > free + 1e-9 {
                if z + dt * free > 1e-9 {
                    return Err(format!("{at}; the ground is out of reach, yet it has pushed"));
                }
                let wanted = e * f64::max(0.0, -v);
                if !((after - wanted).abs() < 1e-9) {
                    return Err(format!(
                        "{at}; it has hit the ground, and should leave it with {wanted:.4} m/s"
                    ));
                }
            }
            (z, v) = (now, after);
        }
    }
    Ok(())
}
