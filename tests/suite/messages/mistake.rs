//! Mistakes in constraints.

use lcplab::body::{Pose, State};
use lcplab::constraint::{
    Bodies, Coincidence, Constraint, Degenerate, Distance, Mistake, Position, Row, verify,
};
use nalgebra::{RealField, Vector3};

/// A ball joint whose rows are changed after they were computed.
#[derive(Debug)]
struct Changed(fn(&mut Vec<Row>));

const BALL: Coincidence =
    Coincidence { bodies: [Some(0), None], anchors: [Vector3::new(0.0, 0.0, 0.0); 2] };

impl Constraint for Changed {
    fn bodies(&self) -> Bodies {
        BALL.bodies()
    }
    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let mut rows = BALL.rows(states)?;
        self.0(&mut rows);
        Ok(rows)
    }
}

impl Position for Changed {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        BALL.c(poses)
    }
}

#[test]
fn every_mistake_in_a_constraint_is_found_and_named() {
    let here = [&State::WORLD; 2];
    let changed = |change| verify(&Changed(change), here).unwrap_err();
    let rod = Distance { bodies: [Some(0), None], anchors: [Vector3::zeros(); 2], length: 1.0 };
    each_variant! { Mistake:
        Mistake::Undefined(_) => verify(&rod, here).unwrap_err(),
            "the two points coincide, so their distance has no direction";
        Mistake::Missing { .. } => changed(|rows| rows.truncate(2)),
            "2 rows for 3 positions";
        Mistake::Wrong { .. } => changed(|rows| rows[1].c = 0.5),
            "row 1: c is 0.5, by dual numbers 0";
    }
}
