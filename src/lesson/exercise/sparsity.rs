//! Checks of exercises: sparsity and storage.

use super::Verdict;
/// A sweep without A: checked against the definition of the sweep, row by row, with an A that the
/// program does not need.
///
/// # Errors
/// Names the row that is not satisfied at its turn.
pub fn bodies(answer: fn(&[[Option<usize>; 2]], &[f64], &[f64], Vec<f64>) -> Vec<f64>) -> Verdict {
    type Case = (&'static [[Option<usize>; 2]], &'static [f64], &'static [f64], &'static [f64]);
    let column: &[[Option<usize>; 2]] = &[[None, Some(0)], [Some(0), Some(1)], [Some(1), Some(2)]];
    let mixed: &[[Option<usize>; 2]] = &[
        [Some(2), Some(0)],
        [Some(1), None],
        [Some(0), Some(1)],
        [Some(2), Some(0)],
        [None, Some(2)],
    ];
    let cases: [Case; 6] = [
        (&[[None, Some(0)]], &[0.5], &[-2.0], &[0.0]),
        (&[[Some(0), Some(1)]], &[1.0, 0.25], &[-2.0], &[0.0]),
        (column, &[1.0, 1.0, 1.0], &[-1.0, -1.0, 1.0], &[0.0, 0.0, 0.0]),
        (column, &[1.0, 0.5, 0.01], &[-1.0, -1.0, 1.0], &[4.0, 3.0, 1.0]),
        (mixed, &[1.0, 2.0, 4.0], &[-1.0, 0.5, -3.0, 2.0, -1.0], &[0.0; 5]),
        (mixed, &[1.0, 2.0, 0.5], &[-1.0, 0.5, 3.0, -2.0, -1.0], &[1.0, 0.5, 2.0, 0.25, 3.0]),
    ];
    for (rows, inverse_mass, b, old) in cases {
        let n = rows.len();
        let new = answer(rows, inverse_mass, b, old.to_vec());
        if new.len() != n {
            return Err(format!("x has {n} entries, the answer {}", new.len()));
        }
        let entry = |i: usize, k: usize| match rows[i] {
            [first, _] if first == Some(k) => -1.0,
            [_, second] if second == Some(k) => 1.0,
            _ => 0.0,
        };
        let a = |i: usize, j: usize| -> f64 {
            (0..inverse_mass.len()).map(|k| entry(i, k) * inverse_mass[k] * entry(j, k)).sum()
        };
        for i in 0..n {
            let x: Vec<f64> = (0..n).map(|j| if j <= i { new[j] } else { old[j] }).collect();
            let w = b[i] + (0..n).map(|j| a(i, j) * x[j]).sum::<f64>();
            let at = format!(
                "bodies {rows:?}, inverse masses {inverse_mass:?}, b = {b:?}, from x = {old:?}: when row {i} is done \
                 x = {x:?}, and its w is {w:.6} m/s"
            );
            if !(x[i] >= 0.0) {
                return Err(format!("{at}; the contact pulls"));
            }
            if !(w >= -1e-9) {
                return Err(format!("{at}; the contact still closes"));
            }
            if x[i] > 1e-9 && w > 1e-9 {
                return Err(format!("{at}; the contact opens, yet it pushes"));
            }
        }
    }
    Ok(())
}
/// Colors: rows of one color must share no body, and each row must have the first color that was
/// still available.
///
/// # Errors
/// Names the conflicting rows, or the row that could have had an earlier color.
pub fn colors(answer: fn(&[[Option<usize>; 2]]) -> Vec<usize>) -> Verdict {
    let cases: [&[[Option<usize>; 2]]; 6] = [
        &[[None, Some(0)], [None, Some(1)], [None, Some(2)]],
        &[
            [None, Some(0)],
            [Some(0), Some(1)],
            [Some(1), Some(2)],
            [Some(2), Some(3)],
            [Some(3), Some(4)],
        ],
        &[[Some(0), Some(1)], [Some(1), Some(2)], [Some(2), Some(0)], [Some(3), None]],
        &[[Some(0), Some(1)], [Some(0), Some(1)], [Some(0), Some(1)], [Some(2), Some(1)]],
        &[
            [Some(0), Some(1)],
            [Some(2), Some(3)],
            [Some(1), Some(2)],
            [Some(4), Some(0)],
            [Some(3), Some(4)],
        ],
        &[],
    ];
    for rows in cases {
        let got = answer(rows);
        if got.len() != rows.len() {
            return Err(format!(
                "{} rows need one color each, the answer has {}",
                rows.len(),
                got.len()
            ));
        }
        let shares = |i: usize, j: usize| {
            rows[i].iter().flatten().any(|body| rows[j].contains(&Some(*body)))
        };
        for i in 0..rows.len() {
            let at = format!("bodies {rows:?}, colors {got:?}");
            if let Some(j) = (0..i).find(|&j| shares(i, j) && got[i] == got[j]) {
                return Err(format!("{at}: rows {j} and {i} share a body and a color"));
            }
            let taken = |color: usize| (0..i).any(|j| shares(i, j) && got[j] == color);
            if let Some(color) = (0..got[i]).find(|&color| !taken(color)) {
                return Err(format!(
                    "{at}: at its turn no row of color {color} was in the way of row {i}"
                ));
            }
        }
    }
    Ok(())
}

/// The pattern of A: compared with products of J with distinct entries, in which nothing cancels.
///
/// # Errors
/// Names the bodies for which the count is wrong.
pub fn pattern(answer: fn(&[[Option<usize>; 2]]) -> usize) -> Verdict {
    let cases: [&[[Option<usize>; 2]]; 5] = [
        &[[None, Some(0)]],
        &[[None, Some(0)], [None, Some(1)]],
        &[[None, Some(0)], [Some(0), Some(1)], [Some(1), Some(2)]],
        &[[Some(0), Some(1)], [Some(0), Some(1)], [Some(2), Some(3)]],
        &[[Some(0), None], [Some(1), Some(0)], [None, Some(1)]],
    ];
    for rows in cases {
        let bodies = 1 + rows.iter().flatten().flatten().max().copied().unwrap_or(0);
        // Powers of two: no sum of products of them is zero.
        let entry = |i: usize, k: usize| match rows[i].contains(&Some(k)) {
            true => f64::powi(2.0, (i * bodies + k) as i32),
            false => 0.0,
        };
        let product = |i, j| (0..bodies).map(|k| entry(i, k) * entry(j, k)).sum::<f64>();
        let n = rows.len();
        let count = (0..n * n).filter(|place| product(place / n, place % n) != 0.0).count();
        let got = answer(rows);
        if got != count {
            let way = if got > count { "more than there are" } else { "too few" };
            return Err(format!("bodies {rows:?}: {got} entries are {way}"));
        }
    }
    Ok(())
}

/// Bug 14.b, A assembled body by body: compared with the response of the bodies to unit impulses,
/// row by row.
///
/// # Errors
/// Names the entry that is not the response to an impulse.
pub fn assembled(answer: fn(&[[usize; 2]], &[f64]) -> Vec<(usize, usize, f64)>) -> Verdict {
    let cases: [(&str, &[[usize; 2]], &[f64]); 5] = [
        ("a ball on the ground, body 0", &[[0, 1]], &[0.0, 0.5]),
        ("two balls on the ground, body 0", &[[0, 1], [0, 2]], &[0.0, 0.5, 2.0]),
        ("a ball on a ball on the ground", &[[0, 1], [1, 2]], &[0.0, 1.0, 0.25]),
        ("a chain", &[[0, 1], [1, 2], [2, 3]], &[1.0, 0.5, 2.0, 0.25]),
        ("two bodies with two contacts", &[[1, 0], [1, 0]], &[1.0, 0.5]),
    ];
    for (name, rows, inverse_mass) in cases {
        let got = answer(rows, inverse_mass);
        let n = rows.len();
        if let Some(entry) = got.iter().find(|entry| entry.0 >= n || entry.1 >= n) {
            return Err(format!("{name}: there are {n} rows, but an entry {entry:?}"));
        }
        for j in 0..n {
            let mut velocity = vec![0.0; inverse_mass.len()];
            velocity[rows[j][0]] -= inverse_mass[rows[j][0]];
            velocity[rows[j][1]] += inverse_mass[rows[j][1]];
            for i in 0..n {
                let opens = velocity[rows[i][1]] - velocity[rows[i][0]];
                let at = |entry: &&(usize, usize, f64)| (entry.0, entry.1) == (i, j);
                let entry: f64 = got.iter().filter(at).map(|entry| entry.2).sum();
                if !((entry - opens).abs() < 1e-12) {
                    return Err(format!(
                        "{name}, rows {rows:?}, inverse masses {inverse_mass:?}: an impulse of 1 N s in row {j} opens \
                         gap {i} at {opens} m/s, and the entry ({i}, {j}) is {entry}"
                    ));
                }
            }
        }
    }
    Ok(())
}
