//! Checks of exercises: drift.

use super::Verdict;

/// The growth of the distance: compared with the position reached along the tangent.
///
/// # Errors
/// Names the step for which the bob is elsewhere.
pub fn tangent(answer: fn(f64, f64, f64) -> f64) -> Verdict {
    for (l, v, dt) in [(1.0, 3.0, 1.0), (2.0, 4.4, 1.0 / 60.0), (0.5, -1.0, 0.1), (1.0, 0.0, 1.0)] {
        let grown = answer(l, v, dt);
        // Pythagoras: (l + grown)² = l² + (v dt)².
        let excess = (l + grown).powi(2) - l * l - (v * dt).powi(2);
        if !(excess.abs() < 1e-12 && grown >= -1e-15) {
            return Err(format!(
                "l = {l} m, v = {v} m/s, dt = {dt} s: the point at the end of the tangent is not \
                 {grown} m farther out"
            ));
        }
    }
    Ok(())
}

/// The bias of a contact: checked by the positions of the bodies after a step that it just allows.
///
/// # Errors
/// Says what the bodies do instead of what they should.
pub fn bias(answer: fn(f64, f64, f64, f64) -> f64) -> Verdict {
    for (c, dt, beta, slop) in [
        (0.02, 0.01, 0.2, 0.005),
        (0.3, 1.0 / 60.0, 0.5, 0.0),
        (0.0, 0.01, 0.2, 0.005),
        (-0.004, 0.01, 0.2, 0.005),
        (-0.1, 0.02, 0.2, 0.0),
        (-0.1, 0.02, 0.4, 0.01),
    ] {
        let bias = answer(c, dt, beta, slop);
        // w = 0: ċ = −bias
        let after = c - dt * bias;
        let beyond = |c: f64| -(c + slop).min(0.0);
        let at = format!("gap {c} m, dt = {dt} s, β = {beta}, slop = {slop} m");
        if c > 0.0 && !(after.abs() < 1e-12) {
            return Err(format!(
                "{at}: bodies that close in as fast as they may are {after} m apart after the step, not in touch"
            ));
        }
        if c <= 0.0 && beyond(c) == 0.0 && after != c {
            return Err(format!("{at}: an overlap within the slop is moved to {after} m"));
        }
        if beyond(c) > 0.0 {
            let left = beyond(after) / beyond(c);
            if !((left - (1.0 - beta)).abs() < 1e-9) {
                return Err(format!(
                    "{at}: of the overlap beyond the slop the part {left} is left after the step"
                ));
            }
        }
    }
    Ok(())
}

/// γ and β of a spring: compared with a weight on an implicit spring, velocity by velocity.
///
/// # Errors
/// Names the spring and mass for which the row differs.
pub fn spring(answer: fn(f64, f64, f64) -> [f64; 2]) -> Verdict {
    for (k, d, dt) in
        [(400.0, 20.0, 0.01), (50.0, 0.0, 0.1), (0.0, 3.0, 0.5), (1e4, 1.0, 1.0 / 60.0)]
    {
        let [compliance, beta] = answer(k, d, dt);
        for (m, c, v) in [(1.0, 0.1, 0.0), (100.0, -0.2, 1.5)] {
            // The row: v⁺ + β/dt c + γ x = 0 with v⁺ = v + x/m.
            let x = -(v + beta / dt * c) / (1.0 / m + compliance);
            let after = v + x / m;
            let spring = -dt * (k * (c + dt * after) + d * after);
            if !((x - spring).abs() < 1e-9 * (1.0 + spring.abs())) {
                return Err(format!(
                    "k = {k} N/m, d = {d} N s/m, dt = {dt} s, a mass of {m} kg: the row's impulse is {x} N s, \
                     at the end of that step the spring and damper would give {spring} N s"
                ));
            }
        }
    }
    Ok(())
}

/// Bug 10.b, a bob on a rod with feedback: compared with the decay of an error by 1 − β per step,
/// and with the remaining error while it swings, v² dt² / (2 l β).
///
/// # Errors
/// Gives the actual length of the rod.
pub fn feedback(answer: fn([f64; 2], f64, f64, f64, f64, usize) -> [f64; 2]) -> Verdict {
    for (l, beta, dt, steps) in
        [(1.0, 0.5, 1.0, 3), (1.0, 0.2, 0.1, 10), (2.0, 0.2, 1.0 / 60.0, 10), (0.5, 1.0, 0.01, 1)]
    {
        let c = 0.1;
        let start = [0.6 * (l + c), -0.8 * (l + c)];
        let [x, z] = answer(start, l, 0.0, beta, dt, steps);
        let (now, law) = (x.hypot(z) - l, c * f64::powi(1.0 - beta, steps as i32));
        if !((now - law).abs() < 1e-9) {
            return Err(format!(
                "without gravity, l = {l} m, β = {beta}, dt = {dt:.4} s: the rod starts {c} m too long, and after \
                 {steps} steps it is {now:.5} m too long; β of what is left should go in each step, which \
                 leaves {law:.5} m"
            ));
        }
    }
    for (l, beta, dt) in [(1.0, 0.2, 1.0 / 60.0), (1.0, 0.2, 0.005), (3.0, 0.5, 0.01)] {
        // It starts from a horizontal rod, so at the bottom v² = 2 g l.
        let law = 9.81 * dt * dt / beta;
        let mut worst: f64 = 0.0;
        for steps in (0..=(10.0 / dt) as usize).step_by(7) {
            let [x, z] = answer([l, 0.0], l, 9.81, beta, dt, steps);
            worst = worst.max((x.hypot(z) - l).abs());
        }
        if !(worst < 1.5 * law) {
            return Err(format!(
                "a pendulum that starts level, l = {l} m, β = {beta}, dt = {dt:.4} s: within ten seconds the rod \
                 is {worst:.4} m too long; feedback leaves v² dt²/(2 l β), at most {law:.4} m"
            ));
        }
    }
    Ok(())
}
