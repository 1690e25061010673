//! Checks of lesson 8, friction.

use super::Verdict;
use crate::lcp::{Lcp, Matrix};
use crate::solver::{Options, Start, by_name};

/// One row of the coupled box: held against the definition of a solution of that row.
///
/// # Errors
/// Says which sentence of the law the new x_t breaks.
pub fn friction_row(answer: fn(f64, f64, f64, f64, f64) -> f64) -> Verdict {
    for (x_t, w_t, a_tt, mu, x_n) in [
        (0.1, 0.2, 2.0, 0.5, 1.0),
        (0.4, -3.0, 2.0, 0.5, 1.0),
        (-0.9, 4.0, 4.0, 0.25, 4.0),
        (0.0, 1.0, 0.5, 0.8, 2.0),
        (0.3, 1.0, 1.0, 0.5, 0.0),
    ] {
        let got = answer(x_t, w_t, a_tt, mu, x_n);
        let at = format!(
            "x_t = {x_t}, w_t = {w_t}, a_tt = {a_tt}, μ = {mu}, x_n = {x_n}: the new x_t is {got}"
        );
        if !(got.abs() <= mu * x_n + 1e-12) {
            return Err(format!("{at}; that is more than friction can be with this pressure"));
        }
        let slip = w_t + a_tt * (got - x_t);
        if slip > 1e-12 && got > -mu * x_n + 1e-12 || slip < -1e-12 && got < mu * x_n - 1e-12 {
            return Err(format!(
                "{at}; the contact still slips with {slip}, and friction could do more against it"
            ));
        }
    }
    Ok(())
}

/// The nearest point of a cone: held against what distinguishes it, that it lies in the cone and that no
/// point of a fine net of the cone is nearer.
///
/// # Errors
/// Says which of the two fails.
pub fn cone(answer: fn([f64; 3], f64) -> [f64; 3]) -> Verdict {
    for (p, mu) in [
        ([2.0, 0.3, -0.4], 0.5),
        ([1.0, 3.0, 4.0], 0.5),
        ([-1.0, 0.6, 0.8], 0.7),
        ([-1.0, 3.0, 0.0], 0.7),
        ([0.0, -1.0, 2.0], 1.0),
        ([-2.0, 0.0, 0.0], 0.3),
    ] {
        let [n, t1, t2] = answer(p, mu);
        let at = format!("p = {p:?}, μ = {mu}: [{n}, {t1}, {t2}]");
        if !(t1.hypot(t2) <= mu * n + 1e-12) {
            return Err(format!("{at} lies outside the cone"));
        }
        let distance = |q: [f64; 3]| (0..3).map(|i| (q[i] - p[i]).powi(2)).sum::<f64>().sqrt();
        let own = distance([n, t1, t2]);
        let size = p[1].hypot(p[2]).max(1e-300);
        let net = (0..=2000).flat_map(|k| {
            let n = 0.003 * f64::from(k);
            (0..=8).map(move |j| (n, mu * n * f64::from(j) / 8.0))
        });
        let nearest = net
            .map(|(n, t)| distance([n, t * p[1] / size, t * p[2] / size]))
            .fold(f64::INFINITY, f64::min);
        if own > nearest + 1e-12 {
            return Err(format!("{at} is {own} away, and another point of the cone is nearer"));
        }
    }
    Ok(())
}

/// A kicked block: held against small steps, each an LCP with the coupled box.
///
/// # Errors
/// Says when the answer leaves the path.
pub fn uphill(answer: fn(f64, f64, f64, f64) -> f64) -> Verdict {
    for (degrees, mu, v0) in [(20.0f64, 0.2, 2.0), (20.0, 0.6, 2.0), (35.0, 0.1, 0.0)] {
        let theta = degrees.to_radians();
        let (dt, mut v) = (1e-3, v0);
        for k in 1..=800u32 {
            v = slope_step(theta, mu, v, dt)
                .ok_or("the check itself failed: no solver for the step")?;
            let t = f64::from(k) * dt;
            let got = answer(theta, mu, v0, t);
            if !((got - v).abs() < 0.03) {
                let now = if v > 0.0 {
                    "it still moves uphill then"
                } else if v < 0.0 {
                    "it slides back then"
                } else {
                    "it has stopped and stays"
                };
                return Err(format!(
                    "{degrees}°, μ = {mu}, v0 = {v0} m/s, t = {t:.3} s: the answer is {got} m/s, \
                     small steps go another way; {now}"
                ));
            }
        }
    }
    Ok(())
}

/// One step of a unit mass on a slope: the normal row, and the tangent uphill.
fn slope_step(theta: f64, mu: f64, v: f64, dt: f64) -> Option<f64> {
    let (sin, cos) = theta.sin_cos();
    let load = 9.81 * cos * dt;
    let a = Matrix::dense(2, &[1.0, 0.0, 0.0, 1.0]);
    let b = vec![-load, v - 9.81 * sin * dt];
    let lcp = Lcp::new(a, b, vec![0.0, -mu * load], vec![f64::INFINITY, mu * load]).ok()?;
    let solver = by_name("dantzig", &Options::default()).ok()?;
    Some(solver.solve(&lcp, &Start::default(), &mut ()).w[1])
}
