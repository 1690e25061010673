//! Checks of exercises: a user-defined constraint.

use super::Verdict;

/// A hill: its name, its height, and its slope and curvature as formulas.
type Hill = (&'static str, fn(f64) -> f64, fn(f64) -> [f64; 2]);

/// The ground's force on a skier: compared with the curvature of the gap to the hill, from
/// differences of the height.
///
/// # Errors
/// Says what the force does to the skier instead.
pub fn skier(answer: fn(f64, f64, f64, f64) -> [f64; 2]) -> Verdict {
    let hills: [Hill; 4] = [
        ("h = cos x", f64::cos, |x| [-x.sin(), -x.cos()]),
        ("h = x²/20", |x| x * x / 20.0, |x| [x / 10.0, 0.1]),
        ("h = −x/2", |x| -0.5 * x, |_| [-0.5, 0.0]),
        (
            "h = 3 sin(x/3)",
            |x| 3.0 * (x / 3.0).sin(),
            |x| [(x / 3.0).cos(), -(x / 3.0).sin() / 3.0],
        ),
    ];
    for (name, height, slope_and_bend) in hills {
        for (x, speed, m) in [
            (0.3, 0.0, 80.0),
            (0.3, 2.0, 60.0),
            (1.2, 8.0, 1.0),
            (3.0, -5.0, 70.0),
            (-2.0, 20.0, 70.0),
        ] {
            let [slope, bend] = slope_and_bend(x);
            let [f_x, f_z] = answer(m, slope, bend, speed);
            let at = format!(
                "hill {name}, m = {m} kg at x = {x} m with v_x = {speed} m/s (slope {slope:.4}, bend {bend:.4}): the \
                 force is [{f_x:.4}, {f_z:.4}] N"
            );
            if !((f_x + f_z * slope).abs() < 1e-9 * m * 9.81 * (1.0 + slope.abs())) {
                return Err(format!("{at}, and it is not perpendicular to the snow"));
            }
            if !(f_z >= 0.0) {
                return Err(format!("{at}, and it pulls the skier down"));
            }
            // The gap z − h(x) shortly before and after, on the path given by this force and
            // gravity.
            let acceleration = [f_x / m, f_z / m - 9.81];
            let gap = |t: f64| {
                let x_t = x + speed * t + 0.5 * acceleration[0] * t * t;
                let z_t = height(x) + slope * speed * t + 0.5 * acceleration[1] * t * t;
                z_t - height(x_t)
            };
            let opens = (gap(1e-4) - 2.0 * gap(0.0) + gap(-1e-4)) / 1e-8;
            let size = 1e-5 * (9.81 + speed * speed);
            if !(opens > -size) {
                return Err(format!("{at}, and the skier goes into the snow, c̈ = {opens:.4} m/s²"));
            }
            if f_z > 1e-9 && opens > size {
                return Err(format!("{at}, but the skier takes off, c̈ = {opens:.4} m/s²"));
            }
        }
    }
    Ok(())
}

/// The test of a row: tried on correct rows, and on rows with one wrong entry.
///
/// # Errors
/// Names the row that was misjudged.
pub fn tested(answer: fn(fn([f64; 3]) -> f64, [f64; 3], [f64; 3]) -> Option<usize>) -> Verdict {
    type C = fn([f64; 3]) -> f64;
    let rod: C = |p| (p[0] * p[0] + p[1] * p[1] + p[2] * p[2]).sqrt() - 5.0;
    let sphere: C = |p| p[0] * p[0] + p[1] * p[1] + p[2] * p[2] - 25.0;
    let wire: C = |p| p[2] - p[0].cos();
    let washboard: C = |p| p[2] - 0.1 * (30.0 * p[0]).sin();
    let far: C = |p| ((p[0] - 800.0).powi(2) + p[1] * p[1] + (p[2] + 600.0).powi(2)).sqrt() - 1e3;
    let product: C = |p| p[0] * p[1] - p[2];
    let bead = [0.3, 0.0, 0.955];
    let comb = [0.11, 0.5, 0.0];
    let slope = -3.0 * f64::cos(30.0 * 0.11);
    for (name, c, p, j, wrong) in [
        ("a rod", rod, [3.0, 4.0, 0.0], [0.6, 0.8, 0.0], None),
        ("a rod, turned round", rod, [3.0, 4.0, 0.0], [-0.6, 0.8, 0.0], Some(0)),
        ("a rod, not a unit vector", rod, [3.0, 4.0, 0.0], [3.0, 4.0, 0.0], Some(0)),
        ("a sphere", sphere, [3.0, 0.0, -4.0], [6.0, 0.0, -8.0], None),
        ("a sphere, half of it", sphere, [3.0, 0.0, -4.0], [6.0, 0.0, -4.0], Some(2)),
        ("a large sphere", sphere, [30.0, 0.0, -40.0], [60.0005, 0.0, -80.0], None),
        ("a wire", wire, bead, [f64::sin(0.3), 0.0, 1.0], None),
        ("a wire, wrong sign", wire, bead, [-f64::sin(0.3), 0.0, 1.0], Some(0)),
        ("a wire, a made-up y", wire, bead, [f64::sin(0.3), 0.01, 1.0], Some(1)),
        ("a washboard", washboard, comb, [slope, 0.0, 1.0], None),
        ("a washboard, a little off", washboard, comb, [slope, 0.0, 1.001], Some(2)),
        ("a rod of a kilometer", far, [0.0, 0.0, 0.0], [-0.8, 0.0, 0.6], None),
        ("a rod of a kilometer, z missing", far, [0.0, 0.0, 0.0], [-0.8, 0.0, 0.0], Some(2)),
        ("c = x y − z", product, [2.0, 7.0, 14.0], [7.0, 2.0, -1.0], None),
        ("c = x y − z, exchanged", product, [2.0, 7.0, 14.0], [2.0, 7.0, -1.0], Some(0)),
    ] {
        let got = answer(c, p, j);
        if got != wrong {
            let truth = match wrong {
                None => "this row is right".to_string(),
                Some(k) => format!("entry {k} is the first wrong one"),
            };
            return Err(format!(
                "{name}, p = {p:?}, J = {j:?}: the answer is {got:?}, but {truth}"
            ));
        }
    }
    Ok(())
}

/// Bug 17.b, a bead with friction on a straight wire: compared with the friction law on a slope.
///
/// # Errors
/// Gives the actual speed of the bead.
pub fn bead(answer: fn(f64, f64, f64, f64, usize) -> f64) -> Verdict {
    let dt = 0.01;
    for (slope, mu, m, steps) in [
        (0.0, 0.5, 1.0, 10),
        (0.75, 0.0, 1.0, 100),
        (0.577, 0.6, 1.0, 100),
        (0.75, 0.5, 1.0, 100),
        (-0.75, 0.5, 3.0, 50),
        (2.0, 1.9, 0.1, 100),
        (2.0, 2.1, 0.1, 100),
    ] {
        let angle = f64::atan(slope);
        let time = dt * f64::from(steps);
        let gains = f64::max(0.0, angle.sin().abs() - mu * angle.cos());
        let law = -9.81 * gains * time * slope.signum();
        let got = answer(slope, mu, m, dt, steps as usize);
        if !((got - law).abs() < 1e-9) {
            let words = if law == 0.0 {
                format!("tan θ = {:.3} is not above μ, so it should stay", slope.abs())
            } else {
                format!("by g (sin θ − μ cos θ) t it should be {law:.4} m/s")
            };
            return Err(format!(
                "slope {slope} ({:.2}°), μ = {mu}, m = {m} kg: after {time:.2} s the bead moves to the right at \
                 {got:.4} m/s; {words}",
                angle.to_degrees()
            ));
        }
    }
    Ok(())
}
