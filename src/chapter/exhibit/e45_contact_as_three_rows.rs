//! E45: a contact written as three rows, K&M (45).

use nalgebra::{DMatrix, RowDVector, Vector3};

use super::rate::{body, rates};
use super::{Finding, Measure, Outcome};
use crate::body::State;
use crate::error::Result;
use crate::lcp::{Lcp, Matrix};
use crate::solver::{Pgs, Solver, Start, Status};

/// A ball's center above its contact point, and a corner of a box.
pub(super) fn example() -> Result<Finding> {
    let (n, ball, corner) =
        (Vector3::y(), Vector3::new(0.0, -0.5, 0.0), Vector3::new(0.5, -0.5, 0.5));
    let row = true_row(&corner);
    let span = printed_rows(&n, &corner);
    let own = DMatrix::from_iterator(1, 6, n.iter().chain(&corner.cross(&n)).copied());
    let a = printed_rows(&n, &ball);
    let a = &a * a.transpose();
    let zeros = (0..3).filter(|&i| a[(i, i)] == 0.0).count();

    let single = DMatrix::from_element(1, 1, 1.0);
    let away =
        Measure::new("distance from c's gradient", "", distance(&span, &row), distance(&own, &row));
    let rank = Measure::new("motions forbidden", "", span.rank(1e-9) as f64, own.rank(1e-9) as f64);
    let diagonal = Measure::new("zeros on A's diagonal", "", zeros as f64, 0.0);
    let impulse = Measure::new("landing impulse", "N s", landing(&a)?, landing(&single)?);
    Ok(Finding::new(
        "The touching points r of a ball, (0, −0.5, 0) m, and of a box's corner, (0.5, −0.5, 0.5) m, from \
         their centers, on a floor with n = (0, 1, 0). For the corner: how far is the gradient of c, by dual \
         numbers (0, 1, 0, −0.5, 0, 0.5), from the space that the rows span, and how many motions do they \
         forbid? For the ball, of 1 kg and landing at 1 m/s: the diagonal of A, and the impulse that stops it.",
    )
    .measure(impulse.truth(&[1.0], "m v", 1e-8))
    .measure(away.truth(&[0.0], "dual numbers", 1e-12))
    .measure(rank.truth(&[1.0], "c is one number", 0.0))
    .measure(diagonal.truth(&[0.0], "each row acts", 0.0)))
}

/// (45) for the body on the floor: n on the diagonal, the skew matrix of r × n next to it.
fn printed_rows(n: &Vector3<f64>, r: &Vector3<f64>) -> DMatrix<f64> {
    let mut rows = DMatrix::zeros(3, 6);
    rows.view_mut((0, 0), (3, 3)).set_diagonal(n);
    rows.view_mut((0, 3), (3, 3)).copy_from(&-r.cross(n).cross_matrix());
    rows
}

/// The gradient of the corner's height, from its rate for each component of [v; ω].
fn true_row(r: &Vector3<f64>) -> RowDVector<f64> {
    RowDVector::from_fn(6, |_, k| {
        let only = |first: usize| Vector3::from_fn(|i, _| f64::from(u8::from(first + i == k)));
        let moving = body(Vector3::zeros(), only(0), only(3));
        rates([&State::WORLD, &moving], |[_, own]| vec![own.point(r).y])[0]
    })
}

/// The distance of a row from the space that some rows span.
fn distance(rows: &DMatrix<f64>, row: &RowDVector<f64>) -> f64 {
    let along = |b: &RowDVector<f64>, y: &RowDVector<f64>| b * (b.dot(y) / b.norm_squared());
    let mut rest = row.clone();
    let mut basis: Vec<RowDVector<f64>> = Vec::new();
    for own in rows.row_iter() {
        let across = basis.iter().fold(own.into_owned(), |y, b| &y - along(b, &y));
        if across.norm() > 1e-9 {
            rest = &rest - along(&across, &rest);
            basis.push(across);
        }
    }
    rest.norm()
}

/// The upward impulse on the ball from the rows with this A; each of them must stop 1 m/s.
fn landing(a: &DMatrix<f64>) -> Result<Outcome> {
    let n = a.nrows();
    let lcp =
        Lcp::new(Matrix::from(a.as_view()), vec![-1.0; n], vec![0.0; n], vec![f64::INFINITY; n])?;
    let solution = Pgs::default().solve(&lcp, &Start::default(), &mut ());
    Ok(match solution.status {
        Status::ZeroDiagonal { row } => Outcome::Impossible(format!("zero in row {row}")),
        _ => solution.x[0].into(),
    })
}
