use lcplab::lesson::exercise::{Verdict, sparsity};

pub fn mistakes() -> Vec<(&'static str, Verdict)> {
    vec![
        // Velocities start at 0, though x does not.
        (
            "14.1",
            sparsity::bodies(|rows, inverse, b, x| swept(rows, inverse, b, x, false, [1.0, 1.0])),
        ),
        // The first body does not feel the reaction.
        (
            "14.1",
            sparsity::bodies(|rows, inverse, b, x| swept(rows, inverse, b, x, true, [0.0, 1.0])),
        ),
        // Both bodies are pushed the same way.
        (
            "14.1",
            sparsity::bodies(|rows, inverse, b, x| swept(rows, inverse, b, x, true, [-1.0, 1.0])),
        ),
        // The ground counts as a body that rows share.
        (
            "14.2",
            sparsity::colors(|rows| colored(rows, |a, b| a.iter().any(|body| b.contains(body)))),
        ),
        // A color of its own for each row.
        ("14.2", sparsity::colors(|rows| (0..rows.len()).collect())),
        // Only the row before is compared.
        ("14.2", sparsity::colors(|rows| (0..rows.len()).map(|i| i % 2).collect())),
        // Only the same position in the pair is compared: first with first, second with second.
        (
            "14.2",
            sparsity::colors(|rows| {
                colored(rows, |a, b| (0..2).any(|k| a[k].is_some() && a[k] == b[k]))
            }),
        ),
        // The ground joins all that stand on it.
        (
            "14.3",
            sparsity::pattern(|rows| {
                let share = |a: &[Option<usize>; 2], b: &[Option<usize>; 2]| {
                    a.iter().any(|body| b.contains(body))
                };
                rows.iter().map(|a| rows.iter().filter(|b| share(a, b)).count()).sum()
            }),
        ),
        // Every row meets its neighbors in the list, as in a chain.
        ("14.3", sparsity::pattern(|rows| 3 * rows.len() - 2)),
        // The first body's part is kept, the second one's is dropped.
        (
            "14.b",
            sparsity::assembled(|rows, inverse| {
                summed(rows, inverse, |sum, part| if sum == 0.0 { part } else { sum })
            }),
        ),
        // The larger one is kept.
        (
            "14.b",
            sparsity::assembled(|rows, inverse| {
                summed(rows, inverse, |sum, part| if part.abs() > sum.abs() { part } else { sum })
            }),
        ),
        // Subtracted instead of added.
        (
            "14.b",
            sparsity::assembled(|rows, inverse| summed(rows, inverse, |sum, part| sum - part)),
        ),
    ]
}

/// A sweep without A; `push` says how much of an impulse the first and the second body feel.
fn swept(
    rows: &[[Option<usize>; 2]],
    inverse_mass: &[f64],
    b: &[f64],
    mut x: Vec<f64>,
    warm: bool,
    push: [f64; 2],
) -> Vec<f64> {
    let mut u = vec![0.0; inverse_mass.len()];
    let give = |u: &mut Vec<f64>, i: usize, step: f64| {
        for (body, sign) in [(rows[i][0], -push[0]), (rows[i][1], push[1])] {
            if let Some(k) = body {
                u[k] += sign * inverse_mass[k] * step;
            }
        }
    };
    for i in (0..rows.len()).filter(|_| warm) {
        give(&mut u, i, x[i]);
    }
    for i in 0..rows.len() {
        let velocity = |body: Option<usize>| body.map_or(0.0, |k| u[k]);
        let inverse = |body: Option<usize>| body.map_or(0.0, |k| inverse_mass[k]);
        let w = velocity(rows[i][1]) - velocity(rows[i][0]) + b[i];
        let step = f64::max(-x[i], -w / (inverse(rows[i][0]) + inverse(rows[i][1])));
        x[i] += step;
        give(&mut u, i, step);
    }
    x
}

/// The two bodies of a row.
type Pair = [Option<usize>; 2];

/// First colors, with any idea of which rows are in each other's way.
fn colored(rows: &[Pair], shares: fn(&Pair, &Pair) -> bool) -> Vec<usize> {
    let mut colors: Vec<usize> = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        let taken = |color| (0..i).any(|j| shares(row, &rows[j]) && colors[j] == color);
        let free = (0..).find(|&color| !taken(color));
        colors.extend(free);
    }
    colors
}

/// The matrix of 10.b, with any way to put two parts together.
fn summed(
    rows: &[[usize; 2]],
    inverse_mass: &[f64],
    put: fn(f64, f64) -> f64,
) -> Vec<(usize, usize, f64)> {
    let mut entries = Vec::new();
    for (i, first) in rows.iter().enumerate() {
        for (l, second) in rows.iter().enumerate() {
            let mut sum = 0.0;
            for k in 0..inverse_mass.len() {
                let j = |row: &[usize; 2]| f64::from(row[1] == k) - f64::from(row[0] == k);
                if j(first) * j(second) != 0.0 {
                    sum = put(sum, j(first) * inverse_mass[k] * j(second));
                }
            }
            entries.push((i, l, sum));
        }
    }
    entries
}
