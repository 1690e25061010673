//! Checks of exercises: is it solved?

use super::Verdict;
/// A problem with bounds and an x.
type Boxed =
    (&'static [&'static [f64]], &'static [f64], &'static [f64], &'static [f64], &'static [f64]);

/// The scaled residual: in each row, the absolute value of the middle one of a (x − lo), w and a
/// (x − hi) relative to the terms; independent of units.
///
/// # Errors
/// Names the x at which it is wrong, or the units that change it.
pub fn scaled(answer: fn(&[Vec<f64>], &[f64], &[f64], &[f64], &[f64]) -> f64) -> Verdict {
    const INFINITY: f64 = f64::INFINITY;
    let balls: &[&[f64]] = &[&[2.0, -1.0], &[-1.0, 2.0]];
    let chain: &[&[f64]] = &[&[2.0, -1.0, 0.0], &[-1.0, 5.0, 3.0], &[0.0, 3.0, 4.0]];
    let apart: &[&[f64]] = &[&[0.5, 0.0], &[0.0, 2.0]];
    let cases: [Boxed; 9] = [
        (balls, &[-1.0, 3.0], &[0.0, 0.0], &[INFINITY; 2], &[0.5, 0.0]),
        (balls, &[-1.0, 3.0], &[0.0, 0.0], &[INFINITY; 2], &[0.501, 0.0]),
        (balls, &[-1.0, 3.0], &[0.0, 0.0], &[INFINITY; 2], &[0.5, 0.25]),
        (balls, &[-9.0, 3.0], &[-2.0, -2.0], &[2.0, 2.0], &[2.0, -0.5]),
        (balls, &[-9.0, 3.0], &[-2.0, -2.0], &[2.0, 2.0], &[1.5, -0.75]),
        (
            chain,
            &[-4.0, 1.0, 2.0],
            &[0.0, -INFINITY, -0.5],
            &[INFINITY, INFINITY, 0.5],
            &[2.0, 0.125, -0.5],
        ),
        (
            chain,
            &[8.0, -1.0, -6.0],
            &[0.0, -INFINITY, -0.5],
            &[INFINITY, INFINITY, 0.5],
            &[0.25, 0.5, 0.75],
        ),
        (apart, &[0.0, -3.0], &[0.0, 0.0], &[INFINITY; 2], &[0.0, 1.0]),
        (balls, &[-0.001, 0.003], &[0.0, 0.0], &[INFINITY; 2], &[0.0006, 0.0]),
    ];
    for (a, b, lo, hi, x) in cases {
        let n = b.len();
        let dense: Vec<Vec<f64>> = a.iter().map(|row| row.to_vec()).collect();
        let got = answer(&dense, b, lo, hi, x);
        let (mut worst, mut which) = (0.0, 0);
        for i in 0..n {
            let terms = b[i].abs() + (0..n).map(|j| (a[i][j] * x[j]).abs()).sum::<f64>();
            let w = b[i] + (0..n).map(|j| a[i][j] * x[j]).sum::<f64>();
            let mut sizes = [a[i][i] * (x[i] - lo[i]), w, a[i][i] * (x[i] - hi[i])];
            sizes.sort_by(f64::total_cmp);
            let part = if terms == 0.0 { 0.0 } else { sizes[1].abs() / terms };
            if part > worst {
                (worst, which) = (part, i);
            }
        }
        let at = format!(
            "A = {a:?}, b = {b:?}, bounds {lo:?} to {hi:?}, x = {x:?}: the answer is {got:.3e}"
        );
        if worst == 0.0 && !(got.abs() < 1e-15) {
            return Err(format!("{at}, but this x is a solution"));
        }
        if worst > 0.0 && got == 0.0 {
            return Err(format!("{at}, but this x is no solution: row {which} is not satisfied"));
        }
        // Impulses alternately in 10 N s and 0.1 N s, velocities in mm/s.
        let unit = |i: usize| if i.is_multiple_of(2) { 10.0 } else { 0.1 };
        let scaled_by = |v: &[f64]| -> Vec<f64> { (0..n).map(|i| v[i] / unit(i)).collect() };
        let other_a: Vec<Vec<f64>> =
            (0..n).map(|i| (0..n).map(|j| 1e3 * unit(i) * a[i][j] * unit(j)).collect()).collect();
        let other_b: Vec<f64> = (0..n).map(|i| 1e3 * unit(i) * b[i]).collect();
        let (lo, hi, x) = (scaled_by(lo), scaled_by(hi), scaled_by(x));
        let again = answer(&other_a, &other_b, &lo, &hi, &x);
        if !((again - got).abs() <= 1e-9 * got.abs() + 1e-12) {
            return Err(format!(
                "{at}, and {again:.3e} when the same problem is given in other units"
            ));
        }
        if !((got - worst).abs() < 1e-12) {
            return Err(format!(
                "{at}; row {which} is the worst one, and it does not miss by that part of its velocities"
            ));
        }
    }
    Ok(())
}
/// The exact answer of an active set: checked by complementarity, and with sets whose signs are
/// known.
///
/// # Errors
/// Says what is wrong with an answer, or why there should be one or none.
pub fn repair(answer: fn([[f64; 2]; 2], [f64; 2], [f64; 2]) -> Option<([f64; 2], f64)>) -> Verdict {
    let balls = [[2.0, -1.0], [-1.0, 2.0]];
    let plank = [[2.0, 1.0], [1.0, 2.0]];
    let thirds = [[3.0, 1.0], [1.0, 3.0]];
    for (a, b, x, why_none) in [
        (thirds, [-1.0, 2.0], [0.334, 0.0001], None),
        (thirds, [-4.0, -4.0], [1.01, 0.98], None),
        (balls, [1.0, 3.0], [0.02, 0.001], None),
        (balls, [-1.0, 2.0], [0.0, 0.0], None),
        (balls, [-1.0, 2.0], [1.0, 1.0], None),
        (balls, [-4.0, 1.0], [2.4, 0.6], None),
        (plank, [-1.0, -6.0], [0.0, 2.9], None),
        (plank, [-4.0, -1.0], [0.0, 0.0], Some("contact 1 would pull")),
        (balls, [-4.0, 1.0], [0.2, 0.0], Some("contact 1 would close")),
    ] {
        let at = format!("A = {a:?}, b = {b:?}, x = {x:?}");
        let w_of = |x: [f64; 2]| [0, 1].map(|i| a[i][0] * x[0] + a[i][1] * x[1] + b[i]);
        let free = [0, 1].map(|i| a[i][i] * x[i] > w_of(x)[i]);
        let at = format!("{at}, free rows {free:?}");
        let (exact, distance) = match (answer(a, b, x), why_none) {
            (None, None) => return Err(format!("{at}: the signs of this set fit, no answer came")),
            (None, Some(_)) => continue,
            (Some((exact, _)), Some(why)) => {
                return Err(format!("{at}: the answer is {exact:?}, but in this set {why}"));
            }
            (Some(found), None) => found,
        };
        for i in 0..2 {
            let w = w_of(exact)[i];
            let at = format!("{at}: the answer {exact:?} has w[{i}] = {w}");
            if !free[i] && exact[i] != 0.0 {
                return Err(format!("{at}; row {i} is not free"));
            }
            if free[i] && !(w.abs() < 1e-12) {
                return Err(format!("{at}; row {i} is free"));
            }
            if !(exact[i] >= 0.0 && w >= -1e-12) {
                return Err(format!("{at}; that is no solution"));
            }
        }
        let moved = f64::max((exact[0] - x[0]).abs(), (exact[1] - x[1]).abs());
        if !((distance - moved).abs() < 1e-12) {
            return Err(format!(
                "{at}: from x to {exact:?} one entry moves by {moved:.6}, the answer says {distance:.6}"
            ));
        }
    }
    Ok(())
}

/// A proof of infeasibility: checked on problems whose solvability is known by construction, and on
/// vectors that violate one condition each.
///
/// # Errors
/// Names the vector that was misjudged.
pub fn farkas(answer: fn([[f64; 2]; 2], [f64; 2], [f64; 2]) -> bool) -> Verdict {
    let pressed = [[1.0, -1.0], [-1.0, 1.0]];
    let skewed = [[0.0, -1.0], [1.0, 0.0]];
    for (a, b, d, truth, why) in [
        (pressed, [-1.0, -1.0], [1.0, 1.0], true, "dᵀw = −2 for every x"),
        (pressed, [1.0, -2.0], [1.0, 1.0], true, "dᵀw = −1 for every x"),
        (pressed, [2.0, -1.0], [1.0, 1.0], false, "x = (0, 1) solves the problem"),
        (pressed, [1.0, -1.0], [1.0, 1.0], false, "x = (0, 1) solves the problem"),
        (pressed, [1.0, -1.0], [-1.0, -2.0], false, "x = (0, 1) solves the problem"),
        (
            [[1.0, 0.0], [0.0, 1.0]],
            [-1.0, -1.0],
            [1.0, 1.0],
            false,
            "x = (1, 1) solves the problem",
        ),
        (
            [[1.0, 0.0], [0.0, 1.0]],
            [1.0, 1.0],
            [-1.0, -1.0],
            false,
            "x = (0, 0) solves the problem",
        ),
        (skewed, [-1.0, 2.0], [1.0, 0.0], true, "w₀ = −x₁ − 1 for every x"),
        (skewed, [1.0, -1.0], [0.0, 1.0], false, "x = (1, 1) solves the problem"),
    ] {
        let got = answer(a, b, d);
        if got != truth {
            return Err(format!("A = {a:?}, b = {b:?}, d = {d:?}: the answer is {got}, but {why}"));
        }
    }
    Ok(())
}

/// Bug 8.b, sweeps with a stop test: compared with the natural residual after each sweep.
///
/// # Errors
/// Says whether it stopped too early or too late.
pub fn stop(answer: fn(&[Vec<f64>], &[f64], f64) -> (Vec<f64>, usize)) -> Verdict {
    let balls = vec![vec![2.0, -1.0], vec![-1.0, 2.0]];
    let plank = vec![vec![2.0, 1.0], vec![1.0, 2.0]];
    let column = vec![vec![1.0, -1.0, 0.0], vec![-1.0, 2.0, -1.0], vec![0.0, -1.0, 2.0]];
    for (name, a, b, tolerance) in [
        ("three contacts, all push", &column, vec![-1.0, 0.0, 0.0], 1e-6),
        ("two contacts, both push", &balls, vec![-1.0, -1.0], 1e-10),
        ("two contacts, one opens", &balls, vec![-1.0, 3.0], 1e-8),
        ("two contacts, both open", &balls, vec![1.0, 2.0], 1e-8),
        ("a plank, one end opens", &plank, vec![-4.0, -5.0], 1e-3),
        ("three balls, the last one hits", &balls, vec![1.0, -4.0], 1e-4),
        ("a column, its top is thrown up", &column, vec![-2.0, -1.0, 4.0], 1e-6),
    ] {
        let n = b.len();
        let w = |x: &[f64], i: usize| b[i] + (0..n).map(|j| a[i][j] * x[j]).sum::<f64>();
        let residual =
            |x: &[f64]| (0..n).map(|i| f64::min(x[i], w(x, i)).abs()).fold(0.0, f64::max);
        let (mut x, mut needed) = (vec![0.0; n], 0);
        while residual(&x) > tolerance {
            for i in 0..n {
                x[i] = f64::max(0.0, x[i] - w(&x, i) / a[i][i]);
            }
            needed += 1;
        }
        let (got, sweeps) = answer(a, &b, tolerance);
        if got.len() != n {
            return Err(format!("x has {n} entries, the answer {}", got.len()));
        }
        if let Some(i) = got.iter().position(|x| !x.is_finite()) {
            return Err(format!("{name}: A = {a:?}, b = {b:?}: x[{i}] = {}", got[i]));
        }
        let left = residual(&got);
        let at = format!(
            "{name}: A = {a:?}, b = {b:?}, tolerance {tolerance}: it stopped after {sweeps} sweeps at {got:.6?}"
        );
        if !(left <= tolerance) {
            return Err(format!("{at}, where the natural residual is still {left:.6}"));
        }
        if sweeps > needed.max(1) {
            return Err(format!("{at}, and that x was good enough before"));
        }
        if sweeps < needed {
            return Err(format!("{at}, and so few sweeps cannot have led there"));
        }
    }
    Ok(())
}
