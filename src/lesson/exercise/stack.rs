//! Checks of exercises: a stack of boxes.

use super::Verdict;

/// The layers of a stack: checked against Newton's second law for each body.
///
/// # Errors
/// Names the body that would move.
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
/// A leaning tower: checked against the balance of forces and moments of each box, and with towers
/// that are known to stand or to fall.
///
/// # Errors
/// Names the box that is not in balance, or the tower that was misjudged.
pub fn tower(answer: fn(&[f64], &[f64], f64) -> Option<Vec<[f64; 2]>>) -> Verdict {
    // Equal boxes can overhang each other by at most 1/2, 1/4, 1/6, … m, counted from the top.
    let harmonic = |part: f64| -> Vec<f64> {
        let out: Vec<f64> = (1..6).rev().map(|k| part * 0.5 / f64::from(k)).collect();
        (0..6).map(|k| out[..k].iter().sum()).collect()
    };
    let cases: [(&str, Vec<f64>, Vec<f64>, bool); 9] = [
        ("one box", vec![0.25], vec![3.0], true),
        ("a straight tower", vec![0.5, 0.5, 0.5], vec![1.0, 2.0, 0.5], true),
        ("two boxes", vec![0.0, 0.375], vec![1.0, 1.0], true),
        ("two boxes, the upper one too far out", vec![0.0, 0.55], vec![1.0, 1.0], false),
        ("the farthest tower of six, nearly", harmonic(0.98), vec![1.0; 6], true),
        ("the farthest tower of six, too far", harmonic(1.02), vec![1.0; 6], false),
        ("a box held by a heavy one on its end", vec![0.0, 0.6, 0.2], vec![1.0, 1.0, 5.0], true),
        ("a stair to the left", vec![0.0, -0.3, -0.6, -0.9], vec![1.0; 4], false),
        ("two stairs to the left", vec![0.0, -0.3, -0.6], vec![4.0, 2.0, 1.0], true),
    ];
    for (name, x, m, stands) in cases {
        let dt = 0.02;
        let n = x.len();
        let at = format!("{name}: middles {x:.4?} m, masses {m:?} kg");
        let got = match (answer(&x, &m, dt), stands) {
            (None, false) => continue,
            (None, true) => return Err(format!("{at}: this tower stands, no answer came")),
            (Some(got), false) => {
                return Err(format!("{at}: this tower falls, the answer is {got:.4?}"));
            }
            (Some(got), true) => got,
        };
        if got.len() != n {
            return Err(format!("{at}: {n} boxes have {n} layers, the answer has {}", got.len()));
        }
        let ends = |k: usize| match k {
            0 => [x[0] - 0.5, x[0] + 0.5],
            _ => [x[k].max(x[k - 1]) - 0.5, x[k].min(x[k - 1]) + 0.5],
        };
        for k in 0..n {
            let at = format!("{at}, impulses {got:.4?} N s");
            if let Some(x) = got[k].iter().find(|x| !(**x >= 0.0)) {
                return Err(format!("{at}: layer {k} pulls with {x:.4}"));
            }
            let (mut force, mut moment) = (-m[k] * 9.81 * dt, -m[k] * 9.81 * dt * x[k]);
            for (layer, sign) in [(k, 1.0), (k + 1, -1.0)].into_iter().filter(|pair| pair.0 < n) {
                for (impulse, end) in got[layer].into_iter().zip(ends(layer)) {
                    force += sign * impulse;
                    moment += sign * impulse * end;
                }
            }
            // The moment about its middle.
            let turn = moment - force * x[k];
            if !(force.abs() < 1e-9) {
                let way = if force > 0.0 { "up" } else { "down" };
                return Err(format!("{at}: box {k} moves {way} at {:.4} m/s", force.abs() / m[k]));
            }
            if !(turn.abs() < 1e-9) {
                let way = if turn > 0.0 { "right end up" } else { "left end up" };
                return Err(format!("{at}: box {k} tips, its {way}, with {:.4} N m s", turn.abs()));
            }
        }
    }
    Ok(())
}

/// Sweeps of PGS: compared with sweeps that are actually done and counted.
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

/// Counts the sweeps on the errors of the two rows until that of the upper one is small enough.
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

/// Bug 15.b, a column that keeps its impulses: after many steps each contact must support the
/// weight above it, and no body may have sunk much.
///
/// # Errors
/// Gives the load of a contact, or how deep the column is in the ground.
pub fn kept(answer: fn(&[f64], f64, usize, usize) -> (Vec<f64>, Vec<f64>)) -> Verdict {
    let stacks: [(&[f64], usize, usize); 6] = [
        (&[2.0], 1, 1000),
        (&[1.0, 1.0], 3, 1000),
        (&[1.0, 1.0, 1.0, 1.0, 1.0], 10, 1000),
        (&[4.0, 2.0, 1.0], 4, 1000),
        (&[1.0, 3.0, 2.0], 8, 1000),
        (&[4.0, 2.0, 1.0], 1000, 1),
    ];
    for (masses, sweeps, steps) in stacks {
        let (n, dt) = (masses.len(), 0.01);
        let (x, z) = answer(masses, dt, sweeps, steps);
        if x.len() != n || z.len() != n {
            return Err(format!("{n} balls need {n} impulses and {n} heights"));
        }
        let at = format!("masses {masses:?} kg, {sweeps} sweeps per step, after {steps} steps");
        for k in 0..n {
            if !(z[k].abs() < 0.02) {
                return Err(format!("{at}: ball {k} is {:.4} m below its place", -z[k]));
            }
            let load = masses[k..].iter().sum::<f64>() * 9.81 * dt;
            if !((x[k] - load).abs() < 1e-6 * load) {
                return Err(format!(
                    "{at}: contact {k} gives {:.6} N s a step, the balls on it weigh {load:.6} N s",
                    x[k]
                ));
            }
        }
    }
    Ok(())
}
