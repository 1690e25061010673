//! The judge's proof of one contact with Coulomb friction: a box around x and its images.

use lcplab_judge::{Enclosure, RowState};
use lcplab_lcp::exact::dyadic::rational;
use lcplab_lcp::exact::rounded_up;
use lcplab_lcp::friction::{ConeProblem, Law, Model};
use lcplab_lcp::hypot;
use serde::Deserialize;
use serde_json::{Value, json};

use super::Answer;
use super::friction::{contact, solved};
use super::trace::numbers;

/// The number of boxes of a proof.
const COUNT: usize = 8;

/// w = A x + b of a contact, and a box around a point near its solution.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Enclose {
    a: [f64; 9],
    b: [f64; 3],
    mu: f64,
    /// x − solution.
    error: [f64; 3],
    /// Half the width of the box.
    radius: f64,
}

impl Enclose {
    /// The solution to double precision and its state; the boxes X, K(X), K(K(X)), …, and why X
    /// proves nothing, if so.
    pub fn answer(&self) -> Answer {
        if !(self.radius > 0.0
            && self.radius.is_finite()
            && self.error.iter().all(|e| e.is_finite()))
        {
            return Err("radius must be positive, and error finite".into());
        }
        let problem = contact(&self.a, self.mu, self.b)?;
        let solution = solved(Model::CoulombCone, &problem)?;
        let (limit, friction) = (self.mu * solution[0], hypot(solution[1], solution[2]));
        let state = match solution[0] > 0.0 {
            false => RowState::Open,
            true if friction < limit * (1.0 - 1e-12) => RowState::Sticks,
            true => RowState::Slides,
        };
        let lcp = problem.lcp().clone();
        let problem = ConeProblem::new(problem, Law::Coulomb);
        let images =
            |x: &[f64], count| Enclosure::images(&problem, vec![state; 3], x, self.radius, count);
        // The centers follow Newton's method.
        let solution = center(images(&solution, 4)?.last().expect("four boxes"));
        let x: Vec<f64> = solution.iter().zip(self.error).map(|(x, error)| x + error).collect();
        let w = lcp.w(&solution);
        let (boxes, reason) = match images(&x, 2) {
            Ok(boxes) => match boxes[0].check(&problem) {
                Ok(()) => (images(&x, COUNT)?, None),
                Err(reason) => (boxes, Some(reason)),
            },
            Err(reason) => (Vec::new(), Some(reason)),
        };
        let name = RowState::NAMES.iter().find(|own| own.0 == state).map(|own| own.1);
        Ok(json!({
            "state": name, "solution": numbers(&solution), "w": numbers(&w), "x": numbers(&x),
            "boxes": boxes.iter().map(edges).collect::<Vec<_>>(), "reason": reason,
        }))
    }
}

/// The center of a box, rounded.
fn center(own: &Enclosure) -> Vec<f64> {
    own.center.entries().iter().map(|x| x.to_f64().value()).collect()
}

/// The center and the radius, which is rounded up.
fn edges(own: &Enclosure) -> Value {
    let radius: Vec<f64> = own.radius.iter().map(|r| rounded_up(&rational(r))).collect();
    json!({ "center": numbers(&center(own)), "radius": numbers(&radius) })
}
