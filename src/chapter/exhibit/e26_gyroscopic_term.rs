//! E26: the gyroscopic term is missing, K&M (20), (21), Code 7.

use nalgebra::Vector3;

use super::{Finding, Measure, Outcome};
use crate::body::{Gyroscopic, Mass, State, stack};
use crate::error::Result;
use crate::plot::{Axis, Lines, Series};

const MOMENTS: [f64; 3] = [2.0, 3.0, 4.0];
const RATES: [f64; 3] = [0.5, 5.0, 0.5];
const DT: f64 = 1e-3;

/// A free body that rotates about its middle axis with a small disturbance.
pub(super) fn example() -> Result<Finding> {
    let printed = Tumble::new(Gyroscopic::Omitted, 3000);
    let corrected = Tumble::new(Gyroscopic::Explicit, 3000);
    let euler = euler(3000);
    let momentum =
        Measure::new("error of I ω at 1 s", "%", printed.errors[1000], corrected.errors[1000]);
    let rate =
        Measure::new("axis 1 rate at 1 s", "rad/s", printed.rates[1000].x, corrected.rates[1000].x);
    let time =
        Measure::new("middle rate flips at", "s", flip(&printed.rates), flip(&corrected.rates));
    let turned_over = match flip(&euler) {
        Outcome::Numbers(times) => times,
        Outcome::Impossible(_) => Vec::new(),
    };
    Ok(Finding::new(
        "A free body with moments (2, 3, 4) kg m² starts at (0.5, 5, 0.5) rad/s, steps of 1 ms; both forms \
         use this library's step, without the term and with it, taken at the start of the step. The middle \
         axis is the unstable one: the body turns over. The rates are about the body's own axes; the \
         truth is Euler's equations for them, followed by the Runge-Kutta method.",
    )
    .measure(momentum.truth(&[0.0], "conservation", 0.05))
    .measure(rate.truth(&[euler[1000].x], "Euler's equations", 2e-3))
    .measure(time.truth(&turned_over, "Euler's equations", 5e-3))
    .plot(&momentum_over_time(&printed, &corrected)))
}

/// The time when the rate about the middle axis passes 0 (s), interpolated linearly between two
/// steps.
fn flip(rates: &[Vector3<f64>]) -> Outcome {
    match rates.windows(2).position(|pair| pair[1].y < 0.0) {
        Some(k) => Outcome::from(DT * (k as f64 + rates[k].y / (rates[k].y - rates[k + 1].y))),
        None => Outcome::Impossible("never".into()),
    }
}

/// A tumbling body, step after step.
struct Tumble {
    /// The rates about the body's axes (rad/s).
    rates: Vec<Vector3<f64>>,
    /// |I ω − (I ω)₀| in percent of the latter.
    errors: Vec<f64>,
}

impl Tumble {
    fn new(term: Gyroscopic, steps: usize) -> Self {
        let mass = Mass::Rigid { mass: 1.0, moments: MOMENTS.into() };
        let mut state = State { omega: RATES.into(), ..State::WORLD };
        let start = mass.angular_momentum(&state);
        let mut tumble = Tumble { rates: Vec::new(), errors: Vec::new() };
        for _ in 0..=steps {
            let miss = (mass.angular_momentum(&state) - start).norm() / start.norm();
            tumble.rates.push(state.pose.q.inverse() * state.omega);
            tumble.errors.push(100.0 * miss);
            let torque = term.torque(&mass, &state, DT);
            let rate = mass.accelerate(&state.pose, &stack(Vector3::zeros(), torque));
            state = state.with_velocity(&(state.velocity() + rate * DT)).advanced(DT);
        }
        tumble
    }
}

/// The rates by Euler's equations, I₁ ω₁' = (I₂ − I₃) ω₂ ω₃ and so on.
fn euler(steps: usize) -> Vec<Vector3<f64>> {
    let moments = Vector3::from(MOMENTS);
    let f = |w: Vector3<f64>| -w.cross(&moments.component_mul(&w)).component_div(&moments);
    let step = |w: &Vector3<f64>| {
        let k1 = f(*w);
        let k2 = f(w + k1 * (0.5 * DT));
        let k3 = f(w + k2 * (0.5 * DT));
        let k4 = f(w + k3 * DT);
        Some(w + (k1 + k2 * 2.0 + k3 * 2.0 + k4) * (DT / 6.0))
    };
    std::iter::successors(Some(Vector3::from(RATES)), step).take(steps + 1).collect()
}

fn momentum_over_time(printed: &Tumble, corrected: &Tumble) -> Lines {
    let points = |tumble: &Tumble| -> Vec<(f64, f64)> {
        let errors = tumble.errors.iter().enumerate().step_by(10);
        errors.map(|(k, &error)| (k as f64 * DT, error)).collect()
    };
    Lines::new(
        "momentum_of_a_tumbling_body",
        "The angular momentum of a free body",
        "No torque acts, so nothing may change. Without the gyroscopic term it wanders by several \
             percent and back, however short the step; with it, the error is that of the method.",
        Axis::linear("time", "s"),
        Axis::linear("error of the angular momentum", "%"),
        vec![
            Series::measured("without the term", points(printed)),
            Series::measured("with it", points(corrected)),
        ],
    )
}
