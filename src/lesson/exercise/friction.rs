//! Checks of exercises: friction.

use super::Verdict;
use crate::lcp::{Lcp, Matrix};
use crate::solver::{Options, Start, by_name};
/// The nearest point of a square, a disk and a diamond: no point of the shape may lie farther than
/// the answer in the direction from the answer to the given point, which is checked by a formula
/// for each shape.
///
/// # Errors
/// Names the shape that the answer leaves, or in which another point is nearer.
pub fn nearest(answer: fn([f64; 2], f64) -> [[f64; 2]; 3]) -> Verdict {
    for (wanted, limit) in [
        ([0.3, -0.2], 1.0),
        ([3.0 * f64::to_radians(30.0).cos(), 1.5], 1.0),
        ([0.9, -0.6], 1.0),
        ([-0.2, 4.0], 0.5),
        ([-1.5, -1.25], 2.0),
        ([0.75, 0.75], 1.0),
        ([0.0, -7.0], 3.0),
        ([0.0, 0.0], 0.0),
        ([-2.0, 1.0], 0.0),
    ] {
        let answers = answer(wanted, limit);
        for (name, [x, y]) in ["square", "disc", "diamond"].into_iter().zip(answers) {
            let reach = |x: f64, y: f64| match name {
                "square" => x.abs().max(y.abs()),
                "disc" => x.hypot(y),
                _ => x.abs() + y.abs(),
            };
            let farthest = |x: f64, y: f64| match name {
                "square" => limit * (x.abs() + y.abs()),
                "disc" => limit * x.hypot(y),
                _ => limit * x.abs().max(y.abs()),
            };
            let at = format!(
                "wanted {wanted:.4?}, limit {limit}: for the {name} the answer is [{x}, {y}]"
            );
            if !(reach(x, y) <= limit + 1e-12) {
                return Err(format!("{at}, which lies outside of it"));
            }
            let (to_x, to_y) = (wanted[0] - x, wanted[1] - y);
            if !(farthest(to_x, to_y) <= to_x * x + to_y * y + 1e-12) {
                return Err(format!(
                    "{at}, {:.4} away, and another point is nearer",
                    to_x.hypot(to_y)
                ));
            }
        }
    }
    Ok(())
}

/// The nearest point of a cone: the answer must lie in the cone, and no point of a fine grid on the
/// cone may be nearer.
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

/// A kicked block: compared with small steps, each an LCP with the coupled box.
///
/// # Errors
/// Says when the answer deviates from the path.
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

/// Bug 11.b, a block that is pushed and pressed: each step is checked against Coulomb's law.
///
/// # Errors
/// Names the step that violates the law, and how.
pub fn pressed(answer: fn(f64, f64, f64, &[[f64; 2]]) -> Vec<f64>) -> Verdict {
    let steady = [[0.0, 0.0], [0.0, 0.0], [4.0, 0.0], [4.0, 0.0]];
    let slides = [[0.0, 0.0], [30.0, 0.0], [30.0, 0.0], [0.0, 0.0], [0.0, 0.0], [0.0, 0.0]];
    let held = [
        [0.0, 0.0],
        [25.0, 60.0],
        [25.0, 60.0],
        [25.0, 0.0],
        [25.0, 0.0],
        [0.0, 80.0],
        [0.0, 80.0],
    ];
    let first = [[3.0, 0.0], [-3.0, 0.0]];
    let cases: [(f64, f64, &[[f64; 2]]); 4] =
        [(1.0, 0.5, &steady), (2.0, 0.5, &slides), (2.0, 0.4, &held), (1.0, 0.5, &first)];
    for (m, mu, forces) in cases {
        let dt = 0.01;
        let got = answer(m, mu, dt, forces);
        if got.len() != forces.len() {
            return Err(format!(
                "{} steps need one speed each, the answer has {}",
                forces.len(),
                got.len()
            ));
        }
        let mut before = 0.0;
        for (k, (&v, [push, press])) in got.iter().zip(forces).enumerate() {
            let friction = m * (v - before) - dt * push;
            let limit = mu * dt * (m * 9.81 + press);
            let at = format!(
                "m = {m} kg, μ = {mu}, [push, press] = {forces:?} N: in step {k} the speed goes from {before:.4} to \
                 {v:.4} m/s, so friction has given {friction:.4} N s"
            );
            if !(friction.abs() <= limit + 1e-12) {
                return Err(format!("{at}, with this load it can give {limit:.4} at most"));
            }
            if v.abs() > 1e-12 && !(friction * v.signum() <= -limit + 1e-12) {
                return Err(format!(
                    "{at}; the block slides, and {limit:.4} N s would act against it"
                ));
            }
            before = v;
        }
    }
    Ok(())
}
