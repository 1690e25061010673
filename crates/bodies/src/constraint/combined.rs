//! Combined joints: the rows of a pair or an array of constraints are those of its members, in
//! order.
//!
//! ```text
//! c = (c of the first, c of the second, …);   J and J'u likewise
//! ```
//!
//! For example, a hinge is `(Coincidence, [Perpendicular; 2])` and needs no code of its own. All
//! members join the same two bodies. K&M: constraints "snap" together (T27).

use nalgebra::{RealField, Vector3};

use super::{Bodies, Bounds, Constraint, Degenerate, Position, Row};
use crate::body::{Pose, State};

/// Appends the rows of another member; friction rows refer to a row of their own member.
fn append(rows: &mut Vec<Row>, member: Vec<Row>) {
    let before = rows.len();
    rows.extend(member.into_iter().map(|row| match row.bounds {
        Bounds::Friction { normal, mu } => {
            Row { bounds: Bounds::Friction { normal: before + normal, mu }, ..row }
        }
        _ => row,
    }));
}

impl<A: Constraint, B: Constraint> Constraint for (A, B) {
    fn bodies(&self) -> Bodies {
        debug_assert_eq!(self.0.bodies(), self.1.bodies());
        self.0.bodies()
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let mut rows = self.0.rows(states)?;
        append(&mut rows, self.1.rows(states)?);
        Ok(rows)
    }

    fn anchors(&self) -> Option<[Vector3<f64>; 2]> {
        self.0.anchors().or_else(|| self.1.anchors())
    }
}

impl<A: Position, B: Position> Position for (A, B) {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        let mut c = self.0.c(poses);
        c.extend(self.1.c(poses));
        c
    }
}

impl<A: Constraint, const N: usize> Constraint for [A; N] {
    /// The bodies of the first member; `[None, None]` for an empty array.
    fn bodies(&self) -> Bodies {
        self.first().map_or([None, None], Constraint::bodies)
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let mut rows = Vec::new();
        for member in self {
            append(&mut rows, member.rows(states)?);
        }
        Ok(rows)
    }

    fn anchors(&self) -> Option<[Vector3<f64>; 2]> {
        self.iter().find_map(Constraint::anchors)
    }
}

impl<A: Position, const N: usize> Position for [A; N] {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        self.iter().flat_map(|member| member.c(poses)).collect()
    }
}
