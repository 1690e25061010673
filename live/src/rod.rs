//! Painlevé's rod: the number of forces that hold its end, the impulses that do, and its further
//! motion. Mass, half length and g are 1; `lcplab_lcp::library::painleve` derives the rows.

use lcplab_lcp::exact::all_solutions;
use lcplab_lcp::friction::{FrictionProblem, Model};
use lcplab_lcp::{Coupling, Lcp, Matrix};
use serde::Deserialize;
use serde_json::{Value, json};

use super::Answer;
use super::friction::solved;
use super::trace::numbers;

/// 1 / (moment of inertia).
const INVERSE_INERTIA: f64 = 3.0;
/// A polygon with four corners has the exact limits ±μ x_n along the direction in which the rod
/// slides.
const MODEL: Model = Model::Polyhedral { directions: 4 };

/// A rod whose end slides to the left on the ground, and leans to the right.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Rod {
    mu: f64,
    /// Above the ground (degrees).
    theta: f64,
    /// Counter-clockwise.
    omega: f64,
}

/// The same rod in free motion.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Run {
    #[serde(flatten)]
    rod: Rod,
    /// The speed at which the end slides to the left.
    slip: f64,
    dt: f64,
    steps: usize,
}

impl Rod {
    /// The one row w = a x + b of the forces with all its answers, the critical friction, and what
    /// the first step of several lengths does.
    pub fn answer(&self) -> Answer {
        self.checked()?;
        let (s, c) = self.directions();
        let a = 1.0 + 3.0 * c * c - 3.0 * self.mu * s * c;
        let b = self.omega * self.omega * s - 1.0;
        let row = Lcp::new(Matrix::dense(1, &[a]), vec![b], vec![0.0], vec![f64::INFINITY])
            .map_err(|error| error.to_string())?;
        let forces = all_solutions(&row).unwrap_or_default();
        let forces: Vec<f64> = forces.iter().map(|x| x[0].to_f64().value()).collect();
        let step = |dt: f64| {
            let (x, w) = State::of(self, 1.0).touch(self.mu, dt)?;
            Ok(json!({ "dt": dt, "x": numbers(&x[..2]), "w": numbers(&w[..2]) }))
        };
        let steps: Result<Vec<Value>, String> = [0.1, 0.01, 0.001].into_iter().map(step).collect();
        let critical = (1.0 + 3.0 * c * c) / (3.0 * s * c);
        Ok(json!({ "a": a, "b": b, "forces": forces, "critical": critical, "steps": steps? }))
    }

    fn checked(&self) -> Result<(), String> {
        if !(self.theta > 0.0 && self.theta < 90.0) {
            return Err(format!("theta: must be between 0 and 90 degrees, is {}", self.theta));
        }
        if !(self.mu >= 0.0 && self.mu.is_finite() && self.omega.is_finite()) {
            return Err("mu, omega: must be finite, and mu not negative".into());
        }
        Ok(())
    }

    /// Sine and cosine of the angle.
    fn directions(&self) -> (f64, f64) {
        let radians = self.theta.to_radians();
        (libm::sin(radians), libm::cos(radians))
    }
}

impl Run {
    /// The rod after each step: position of its center, angle, impulses (n, t) on both ends.
    pub fn answer(&self) -> Answer {
        self.rod.checked()?;
        if !(self.dt > 0.0 && self.dt <= 0.1 && self.slip.is_finite()) {
            return Err(format!("dt: must be above 0 and at most 0.1, is {}", self.dt));
        }
        let mut state = State::of(&self.rod, self.slip);
        let mut frames =
            vec![json!({ "at": state.place, "x": [0.0, 0.0, 0.0, 0.0], "slip": -self.slip })];
        for _ in 0..self.steps.min(2_000) {
            let (x, _) = state.touch(self.rod.mu, self.dt)?;
            // Nothing happens along the second tangent.
            let x = [x[0], x[1], x[3], x[4]];
            state.advance(&x, self.dt);
            let slip = state.speed_of(state.rows()[1]);
            frames.push(json!({ "at": state.place, "x": numbers(&x), "slip": slip }));
        }
        Ok(json!({ "frames": frames }))
    }
}

/// Place (x, z, angle) of the middle, and its velocity.
struct State {
    place: [f64; 3],
    velocity: [f64; 3],
}

impl State {
    /// The lower end rests on the ground at 0 and slides to the left.
    fn of(rod: &Rod, slip: f64) -> State {
        let (s, c) = rod.directions();
        State {
            place: [c, s, rod.theta.to_radians()],
            velocity: [-slip - s * rod.omega, c * rod.omega, rod.omega],
        }
    }

    /// The rows (normal, tangent) of the lower end, then of the upper one.
    fn rows(&self) -> [[f64; 3]; 4] {
        let (s, c) = (libm::sin(self.place[2]), libm::cos(self.place[2]));
        [[0.0, 1.0, -c], [1.0, 0.0, s], [0.0, 1.0, c], [1.0, 0.0, -s]]
    }

    fn speed_of(&self, row: [f64; 3]) -> f64 {
        dot(row, self.velocity)
    }

    /// The impulses of a step of this length, and w = J (u + dt f) + A x with the gap of each end.
    fn touch(&self, mu: f64, dt: f64) -> Result<(Vec<f64>, Vec<f64>), String> {
        let rows = self.rows();
        let half = libm::sin(self.place[2]);
        let gaps = [self.place[1] - half, self.place[1] + half];
        let free = [self.velocity[0], self.velocity[1] - dt, self.velocity[2]];
        // Three rows (n, t1, t2) per end; nothing happens along t2, which is a separate row.
        let row = |i: usize| (i % 3 < 2).then(|| rows[2 * (i / 3) + i % 3]);
        let entry = |i: usize, j: usize| match (row(i), row(j)) {
            (Some(p), Some(q)) => p[0] * q[0] + p[1] * q[1] + INVERSE_INERTIA * p[2] * q[2],
            _ => f64::from(u8::from(i == j)),
        };
        let entries: Vec<f64> = (0..36).map(|k| entry(k / 6, k % 6)).collect();
        let b = (0..6).map(|i| {
            row(i).map_or(0.0, |p| {
                let gap = if i % 3 == 0 { gaps[i / 3] / dt } else { 0.0 };
                dot(p, free) + gap
            })
        });
        let no = f64::NEG_INFINITY;
        let coupling = Coupling::new(
            vec![None, Some(0), Some(0), None, Some(3), Some(3)],
            vec![0.0, mu, mu, 0.0, mu, mu],
        );
        let problem = Lcp::new(
            Matrix::dense(6, &entries),
            b.collect(),
            vec![0.0, no, no, 0.0, no, no],
            vec![f64::INFINITY; 6],
        )
        .and_then(|lcp| lcp.with_coupling(coupling?))
        .and_then(|lcp| FrictionProblem::of(&lcp))
        .map_err(|error| error.to_string())?;
        let x = solved(MODEL, &problem)?;
        let w = problem.lcp().w(&x);
        Ok((x, w))
    }

    /// The step, with the impulses (n, t) of both ends.
    fn advance(&mut self, x: &[f64; 4], dt: f64) {
        let rows = self.rows();
        self.velocity[1] -= dt;
        for (row, x) in rows.iter().zip(x) {
            self.velocity[0] += row[0] * x;
            self.velocity[1] += row[1] * x;
            self.velocity[2] += INVERSE_INERTIA * row[2] * x;
        }
        for (place, velocity) in self.place.iter_mut().zip(self.velocity) {
            *place += dt * velocity;
        }
    }
}

fn dot(p: [f64; 3], q: [f64; 3]) -> f64 {
    p[0] * q[0] + p[1] * q[1] + p[2] * q[2]
}
