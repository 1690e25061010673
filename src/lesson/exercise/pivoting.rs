//! Checks of exercises: pivoting.

use super::Verdict;

/// The point of each of the four active sets: checked against the conditions of the set.
///
/// # Errors
/// Names the row that violates the condition of its side.
pub fn active_set(answer: fn([[f64; 2]; 2], [f64; 2], [bool; 2]) -> [f64; 2]) -> Verdict {
    for (a, b) in [
        ([[2.0, -1.0], [-1.0, 2.0]], [-1.0, 2.0]),
        ([[2.0, 1.0], [1.0, 2.0]], [-5.0, -6.0]),
        ([[4.0, 1.0], [1.0, 1.0]], [3.0, -1.0]),
    ] {
        for free in [[false, false], [true, false], [false, true], [true, true]] {
            let x = answer(a, b, free);
            for i in 0..2 {
                let w = a[i][0] * x[0] + a[i][1] * x[1] + b[i];
                let at = format!("A = {a:?}, b = {b:?}, free {free:?}: x = {x:?}, w[{i}] = {w}");
                if free[i] && !(w.abs() < 1e-12) {
                    return Err(format!("{at}; row {i} is free"));
                }
                if !free[i] && x[i] != 0.0 {
                    return Err(format!("{at}; row {i} is at its bound"));
                }
            }
        }
    }
    Ok(())
}

/// Murty's rule: the row must be wrong, and no earlier row may be.
///
/// # Errors
/// Says why the row is wrong.
pub fn murty(answer: fn(&[f64], &[f64]) -> Option<usize>) -> Verdict {
    let cases: [(&[f64], &[f64]); 6] = [
        (&[-1.0, 0.0], &[0.0, 3.0]),
        (&[0.0, 1.0, 0.0], &[2.0, 0.0, -1.0]),
        (&[0.0, -0.5, 0.0], &[2.0, 0.0, -1.0]),
        (&[3.0, 0.0, -9.0, 0.0], &[0.0, -1.0, 0.0, -20.0]),
        (&[1.0, 0.0], &[0.0, 0.0]),
        (&[0.0, 2.0, -1.0], &[0.0, 0.0, 0.0]),
    ];
    for (x, w) in cases {
        let is_wrong = |i: usize| x[i] < 0.0 || w[i] < 0.0;
        let at = format!("x = {x:?}, w = {w:?}");
        match answer(x, w) {
            None if (0..x.len()).any(is_wrong) => {
                return Err(format!("{at}: not all rows are satisfied yet"));
            }
            Some(row) if row >= x.len() => return Err(format!("{at}: there is no row {row}")),
            Some(row) if !is_wrong(row) => return Err(format!("{at}: row {row} is satisfied")),
            Some(row) if (0..row).any(is_wrong) => {
                return Err(format!(
                    "{at}: row {row} is wrong, but the rule would take another one"
                ));
            }
            _ => (),
        }
    }
    Ok(())
}

/// The ratio test: no variable may be negative after the step that it allows; if several become 0
/// together, the first is required.
///
/// # Errors
/// Names the negative variable, or says that the row is not the first of several.
pub fn ratio(answer: fn(&[f64], &[f64]) -> Option<usize>) -> Verdict {
    let cases: [(&[f64], &[f64]); 7] = [
        (&[4.0, 3.0], &[-1.0, -3.0]),
        (&[1.0, 9.0, 2.0], &[-0.5, -4.0, -0.25]),
        (&[1.0, 6.0], &[2.0, -1.0]),
        (&[5.0, 1.0, 8.0], &[-1.0, 0.0, -4.0]),
        (&[1.0, 2.0], &[0.0, 3.0]),
        (&[9.0, 2.0, 4.0, 1.0], &[-1.0, -1.0, -2.0, -0.5]),
        (&[3.0, 0.5, 6.0], &[-1.0, 1.0, -2.0]),
    ];
    for (constant, rate) in cases {
        let at = format!("constants {constant:?}, rates {rate:?}");
        let Some(row) = answer(constant, rate) else {
            match rate.iter().position(|&rate| rate < 0.0) {
                Some(row) => {
                    return Err(format!(
                        "{at}: the path does not end on a ray: variable {row} becomes 0"
                    ));
                }
                None => continue,
            }
        };
        if row >= rate.len() {
            return Err(format!("{at}: there is no row {row}"));
        }
        if rate[row] >= 0.0 {
            return Err(format!("{at}: variable {row} never falls to 0"));
        }
        let t = -constant[row] / rate[row];
        let below = (0..rate.len()).find(|&r| constant[r] + rate[r] * t < -1e-12);
        if let Some(r) = below {
            return Err(format!("{at}: when variable {row} gets to 0, variable {r} is negative"));
        }
        let first = (0..row).find(|&r| rate[r] < 0.0 && -constant[r] / rate[r] == t);
        if let Some(first) = first {
            return Err(format!(
                "{at}: variables {first} and {row} become 0 at the same time, and row {row} is not the first of them"
            ));
        }
    }
    Ok(())
}

/// Bug 6.b, the step of Dantzig's method: all rows but the last are satisfied before the step, and
/// must be after it.
///
/// # Errors
/// Names the row that violates a condition, and the length of the step.
pub fn dantzig_step(answer: fn(&[f64], &[f64], &[f64], &[f64]) -> (f64, usize)) -> Verdict {
    type Case = (&'static [f64], &'static [f64], &'static [f64], &'static [f64]);
    let cases: [Case; 8] = [
        // One row alone, twice; one that leaves its neighbor as it is; Figure 7, row 1 and row 2.
        (&[0.0], &[-1.0], &[1.0], &[1.0]),
        (&[0.0], &[-1.0], &[1.0], &[2.0]),
        (&[1.0, 0.0], &[0.0, -2.0], &[0.0, 1.0], &[0.0, 1.0]),
        (&[0.25, 0.0], &[0.0, -2.75], &[-0.5, 1.0], &[0.0, 1.5]),
        (&[1.0, 0.0], &[0.0, -2.0], &[1.0, 1.0], &[0.0, 1.0]),
        (&[3.0, 2.0, 0.0], &[0.0, 0.0, -1.0], &[1.0, 1.0, 1.0], &[0.0, 0.0, 1.0]),
        (&[0.5, 0.0, 0.0], &[0.0, 3.0, -4.0], &[0.5, 0.0, 1.0], &[0.0, -2.0, 1.5]),
        (
            &[2.0, 0.0, 0.5, 0.0],
            &[0.0, 1.0, 0.0, -6.0],
            &[-1.0, 0.0, 0.25, 1.0],
            &[0.0, 0.5, 0.0, 2.0],
        ),
    ];
    for (x, w, dx, dw) in cases {
        let (step, stops) = answer(x, w, dx, dw);
        let last = x.len() - 1;
        let at = format!(
            "x = {x:?}, w = {w:?}, and for each N s of row {last} x changes by {dx:?}, w by {dw:?}: the answer is \
             a step of {step} N s, stopped by row {stops}"
        );
        if stops > last {
            return Err(format!("{at}; there is no such row"));
        }
        if !(step > 0.0) {
            return Err(format!("{at}; row {last} closes and has to push more, not less"));
        }
        for r in 0..=last {
            let (x, w) = (x[r] + step * dx[r], w[r] + step * dw[r]);
            if !(x >= -1e-12) {
                return Err(format!("{at}; then row {r} pulls with {:.4} N s", -x));
            }
            if r < last && !(w >= -1e-12) {
                return Err(format!("{at}; then row {r} closes at {:.4} m/s", -w));
            }
            if r == last && w > 1e-12 {
                return Err(format!("{at}; row {r} opens already at {w:.4} m/s, yet it pushes"));
            }
        }
        let left = match stops {
            r if r < last && x[r] > 0.0 => x[r] + step * dx[r],
            r => w[r] + step * dw[r],
        };
        if !(left.abs() < 1e-12) {
            return Err(format!("{at}; but row {stops} does not stop it there, {left:.4} is left"));
        }
    }
    Ok(())
}
