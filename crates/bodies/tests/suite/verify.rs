//! `constraint::verify` finds what is wrong, and where.

use lcplab_bodies::body::{Pose, State};
use lcplab_bodies::constraint::{
    Bodies, Coincidence, Constraint, Contact, Degenerate, Distance, Mistake, Normal, Position,
    Quantity, Row, verify,
};
use nalgebra::{RealField, Vector3};

/// A ball and socket with something changed in its rows.
#[derive(Debug)]
struct Changed(Coincidence, fn(&mut Vec<Row>));

impl Constraint for Changed {
    fn bodies(&self) -> Bodies {
        self.0.bodies()
    }

    fn rows(&self, states: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let mut rows = self.0.rows(states)?;
        self.1(&mut rows);
        Ok(rows)
    }
}

impl Position for Changed {
    fn c<T: RealField + Copy>(&self, poses: [&Pose<T>; 2]) -> Vec<T> {
        self.0.c(poses)
    }
}

fn states() -> [State; 2] {
    let mut moving = State::WORLD;
    (moving.v, moving.omega) = (Vector3::new(1.0, 2.0, 3.0), Vector3::new(3.0, -1.0, 2.0));
    [moving, State { omega: -2.0 * moving.omega, ..moving }]
}

fn found(change: fn(&mut Vec<Row>)) -> Option<(usize, Quantity)> {
    let anchors = [Vector3::new(0.5, 1.0, 0.0), Vector3::new(0.0, 0.3, 1.0)];
    let ball = Coincidence { bodies: [Some(0), Some(1)], anchors };
    let [a, b] = states();
    match verify(&Changed(ball, change), [&a, &b]) {
        Ok(()) => None,
        Err(Mistake::Wrong { row, quantity, .. }) => Some((row, quantity)),
        Err(other) => panic!("{other}"),
    }
}

#[test]
fn a_wrong_number_is_named() {
    assert_eq!(found(|_| ()), None);
    assert_eq!(found(|rows| rows[1].c += 1e-6), Some((1, Quantity::Position)));
    assert_eq!(found(|rows| rows[2].velocity_product = 0.0), Some((2, Quantity::VelocityProduct)));
    let turned = |rows: &mut Vec<Row>| rows[0].jacobian[1][4] *= -1.0;
    assert_eq!(found(turned), Some((0, Quantity::Jacobian(1, 4))));
}

#[test]
fn missing_rows_and_states_without_direction_are_named() {
    let [a, b] = states();
    let ball = Coincidence { bodies: [Some(0), Some(1)], anchors: [Vector3::zeros(); 2] };
    let mistake = verify(&Changed(ball, |rows| rows.truncate(2)), [&a, &b]).unwrap_err();
    assert_eq!(mistake.to_string(), "2 rows for 3 positions");
    let rod = Distance { bodies: [Some(0), Some(1)], anchors: [Vector3::zeros(); 2], length: 1.0 };
    assert!(matches!(verify(&rod, [&a, &b]), Err(Mistake::Undefined(_))));
}

#[test]
fn friction_in_a_pair_refers_to_its_own_normal() {
    let contact = Contact {
        bodies: [None, Some(0)],
        anchors: [Vector3::zeros(); 2],
        radii: [0.0; 2],
        normal: Normal::Face(Vector3::z()),
        friction: 0.5,
        anisotropy: None,
    };
    let ball = Coincidence { bodies: [None, Some(0)], anchors: [Vector3::zeros(); 2] };
    let rows = (ball, contact).rows([&State::WORLD; 2]).unwrap();
    let normals: Vec<_> = rows.iter().map(|row| row.bounds).collect();
    let friction = lcplab_bodies::constraint::Bounds::Friction { normal: 3, mu: 0.5 };
    assert_eq!(normals[4..], [friction; 2]);
}
