//! A user-defined constraint: a body slides in a bowl, z = ½ κ (x² + y² − 1).
//!
//! Run it with `cargo run --release --example own_constraint`.

use lcplab::body::{Pose, State, stack};
use lcplab::constraint::{Bodies, Constraint, Degenerate, Kind, Position, Row, verify};
use lcplab::{scene::Scene, simulation::Simulation, solver::Dantzig};
use nalgebra::{RealField, Vector3, convert};

/// c = z − ½ κ (x² + y² − 1), J = [−g, g] with g = (−κx, −κy, 1, 0, 0, 0), J'u = −κ (vx² + vy²).
#[derive(Debug)]
pub struct Bowl(pub f64); // κ (1/m)

impl Constraint for Bowl {
    fn bodies(&self) -> Bodies {
        [None, Some(0)] // the world and the scene's first body
    }
    fn rows(&self, [_, s]: [&State; 2]) -> Result<Vec<Row>, Degenerate> {
        let (c, p) = (self.c([&s.pose; 2])[0], s.pose.p);
        let g = stack(Vector3::new(-self.0 * p.x, -self.0 * p.y, 1.0), Vector3::zeros());
        Ok(vec![Row::equation(Kind::Distance, c, [-g, g], -self.0 * s.v.xy().norm_squared())])
    }
}

impl Position for Bowl {
    fn c<T: RealField + Copy>(&self, [_, pose]: [&Pose<T>; 2]) -> Vec<T> {
        vec![pose.p.z - (pose.p.xy().norm_squared() - T::one()) * convert(0.5 * self.0)]
    }
}

pub(crate) fn main() -> Result<(), Box<dyn std::error::Error>> {
    let mut scene = Scene::load("pendulum")?; // its bob starts at (1, 0, 0)
    scene.constraints = vec![std::sync::Arc::new(Bowl(2.0))];
    scene.states[0].v.y = (9.81 * 2.0_f64).sqrt(); // a circle, at any height in 2π/√(g κ) = 1.42 s
    verify(&Bowl(2.0), [&State::WORLD, &scene.states[0]])?; // J and J'u by dual numbers
    let mut bead = Simulation::new(scene, Box::new(Dantzig::default()));
    bead.run(142, |_| std::ops::ControlFlow::Continue(()));
    println!("after a turn at {:.2?}", bead.states()[0].pose.p.as_slice());
    Ok(())
}
