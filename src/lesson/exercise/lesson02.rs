//! Checks of lesson 2, Jacobians.

use nalgebra::{DMatrix, Rotation3, Vector3};

use super::Verdict;

/// Three components.
type Triple = [f64; 3];

/// The row of a rod and its J'u: held against difference quotients of the distance.
///
/// # Errors
/// Says which number is off, and where.
pub fn rod(answer: fn(Triple, Triple) -> (Triple, f64)) -> Verdict {
    for (p, v) in [
        ([3.0, 4.0, 0.0], [2.0, -1.0, 0.0]),
        ([0.0, 0.0, -1.0], [1.5, 0.0, 0.0]),
        ([1.0, -2.0, 2.0], [0.3, 0.7, -1.1]),
    ] {
        let (j, product) = answer(p, v);
        let at = |t: f64| (Vector3::from(p) + Vector3::from(v) * t).norm();
        for (k, entry) in j.iter().enumerate() {
            let along = |h: f64| (Vector3::from(p) + Vector3::ith(k, h)).norm();
            let slope = (along(1e-5) - along(-1e-5)) / 2e-5;
            if !((entry - slope).abs() < 1e-6) {
                return Err(format!(
                    "bob at {p:?}: J[{k}] is {entry}, but moving the bob a little along axis {k} changes \
                     its distance by another amount per metre"
                ));
            }
        }
        let bend = (at(1e-4) - 2.0 * at(0.0) + at(-1e-4)) / 1e-8;
        if !((product - bend).abs() < 1e-5) {
            return Err(format!(
                "bob at {p:?}, velocity {v:?}: J'u is {product}, but the distance of a bob that flies \
                 straight on is bent otherwise; only the velocity across the rod bends it"
            ));
        }
    }
    Ok(())
}

/// The rows of a nail: held against a body that really is moved and turned a little.
///
/// # Errors
/// Says for which motion the point moves otherwise.
pub fn nail(answer: fn([f64; 3]) -> [[f64; 6]; 3]) -> Verdict {
    let names = ["v_x", "v_y", "v_z", "ω_x", "ω_y", "ω_z"];
    for r in [[1.0, 0.0, 0.0], [0.3, -0.7, 0.2], [-1.5, 0.4, 2.0]] {
        let rows = answer(r);
        for (k, name) in names.into_iter().enumerate() {
            let place = |h: f64| match k {
                0..3 => Vector3::from(r) + Vector3::ith(k, h),
                _ => Rotation3::new(Vector3::ith(k - 3, h)) * Vector3::from(r),
            };
            let velocity = (place(1e-5) - place(-1e-5)) / 2e-5;
            let column = Vector3::new(rows[0][k], rows[1][k], rows[2][k]);
            if !((column - velocity).norm() < 1e-6) {
                return Err(format!(
                    "arm r = {r:?}: for a body with {name} = 1 alone the nail's point does not move at {:?}",
                    column.as_slice()
                ));
            }
        }
    }
    Ok(())
}

/// The freedoms that rows leave: held against mechanisms that are known by thought.
///
/// # Errors
/// Names the mechanism that is miscounted.
pub fn freedoms(answer: fn(&DMatrix<f64>) -> usize) -> Verdict {
    let nail = |r: [f64; 3]| {
        let cross = Vector3::from(r).cross_matrix();
        DMatrix::from_fn(3, 6, |i, k| if k < 3 { f64::from(i == k) } else { -cross[(i, k - 3)] })
    };
    let stacked = |blocks: &[DMatrix<f64>]| {
        let rows: Vec<_> = blocks.iter().flat_map(|block| block.row_iter()).collect();
        DMatrix::from_rows(&rows.iter().map(|row| row.clone_owned()).collect::<Vec<_>>())
    };
    let (a, b, c) = ([0.5, 0.2, 0.0], [-0.4, 0.1, 0.3], [0.1, -0.3, 0.2]);
    let lock = DMatrix::from_row_slice(1, 6, &[0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    for (name, j, left) in [
        ("one body, its z locked", lock.clone(), 5),
        (
            "one body, its z locked three times over",
            stacked(&[lock.clone(), lock.clone(), lock]),
            5,
        ),
        ("a body on one nail", nail(a), 3),
        ("a body on two nails, which still turns about a line", stacked(&[nail(a), nail(b)]), 1),
        ("a body on three nails", stacked(&[nail(a), nail(b), nail(c)]), 0),
        ("two bodies, one of them on a nail", nail(a).insert_columns(6, 6, 0.0), 9),
    ] {
        let got = answer(&j);
        if got != left {
            return Err(format!("{name}: {got} freedoms are not what is left"));
        }
    }
    Ok(())
}
