//! Checks of lesson 11, a stack of boxes.

use super::Verdict;

/// The layers of a stack: held against Newton's second law of each body.
///
/// # Errors
/// Says which body would move.
pub fn layers(answer: fn(&[f64], f64, f64) -> Vec<f64>) -> Verdict {
    let stacks: [&[f64]; 4] = [&[2.0], &[1.0, 1.0, 1.0], &[1.0, 100.0], &[5.0, 0.5, 3.0, 0.25]];
    for masses in stacks {
        let (g, dt) = (9.81, 0.02);
        let got = answer(masses, g, dt);
        if got.len() != masses.len() {
            let (n, m) = (masses.len(), got.len());
            return Err(format!("{n} bodies have {n} contacts, the answer has {m}"));
        }
        for (k, mass) in masses.iter().enumerate() {
            let above = got.get(k + 1).copied().unwrap_or(0.0);
            let change = got[k] - above - mass * g * dt;
            if !(change.abs() <= 1e-12 * masses.iter().sum::<f64>()) {
                let way = if change > 0.0 { "upwards" } else { "downwards" };
                return Err(format!(
                    "masses {masses:?}, answer {got:?}: body {k} would move {way}"
                ));
            }
        }
    }
    Ok(())
}

/// The warm start: held against the names, contact by contact.
///
/// # Errors
/// Says which contact got what it should not.
pub fn warm_start(answer: fn(&[(u32, f64)], &[u32]) -> Vec<f64>) -> Verdict {
    let old = [(7, 0.5), (3, 0.25), (9, 1.5)];
    for now in [&[7, 3, 9][..], &[9, 7, 3], &[3, 4, 9, 12], &[1, 2], &[]] {
        let got = answer(&old, now);
        if got.len() != now.len() {
            return Err(format!("contacts {now:?} need as many impulses, not {}", got.len()));
        }
        for (name, x) in now.iter().zip(&got) {
            match old.iter().find(|(known, _)| known == name) {
                Some((_, before)) if x != before => {
                    return Err(format!(
                        "contact {name} was there before, but does not start from its own impulse: \
                         old {old:?}, now {now:?}, answer {got:?}"
                    ));
                }
                None if *x != 0.0 => {
                    return Err(format!("contact {name} is new and starts from {x}"));
                }
                _ => (),
            }
        }
    }
    Ok(())
}

/// Sweeps of PGS: held against sweeps that are done and counted.
///
/// # Errors
/// Says whether there are too many or too few.
pub fn sweeps(answer: fn(f64, f64, f64) -> usize) -> Verdict {
    for (below, above, reduction) in
        [(1.0, 1.0, 1e-3), (1.0, 100.0, 0.5), (1.0, 30.0, 1e-2), (100.0, 1.0, 1e-3)]
    {
        let got = answer(below, above, reduction);
        let counted = counted(below, above, reduction);
        if got != counted {
            let word = if got > counted { "more" } else { "fewer" };
            return Err(format!(
                "{above} kg on {below} kg, down to {reduction}: {got} sweeps are {word} than it takes"
            ));
        }
    }
    Ok(())
}

/// Sweeps on the errors of the two rows until that of the upper one is small enough.
fn counted(below: f64, above: f64, reduction: f64) -> usize {
    let a = [[1.0 / below, -1.0 / below], [-1.0 / below, 1.0 / below + 1.0 / above]];
    let mut error = [1.0, 1.0];
    let mut sweeps = 0;
    while error[1] > reduction {
        error[0] = -a[0][1] * error[1] / a[0][0];
        error[1] = -a[1][0] * error[0] / a[1][1];
        sweeps += 1;
    }
    sweeps
}
