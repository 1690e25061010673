//! Whether the springs of the penalty method are stable at the scene's substep.
//!
//! The penalty method integrates its springs and dampers explicitly. The errors of a row with
//! stiffness k, damping d and effective mass 1/a are multiplied in a substep h by the roots of
//!
//! ```text
//! λ² − (2 − a h d − a h² k) λ + 1 − a h d = 0        stable for a (h² k + 2 h d) < 4
//! ```
//!
//! Of several rows the stiffest combination counts: the largest eigenvalue of W J M⁻¹ Jᵀ W with
//! W² = h² k + 2 h d. Power iteration approaches it from below, so that no stable scene is accused.

use crate::assembly::{Assembly, ConstraintFilter, Row};
use crate::constraint::Bounds;
use crate::scene::{Scene, Scheme, contacts};
use lcplab_lcp::number::readable;

/// The number of power iterations.
const ITERATIONS: usize = 100;
/// At this value of a (h² k + 2 h d) errors begin to grow; up to rounding.
const LIMIT: f64 = 4.0 * (1.0 + 1e-9);

/// The factor by which the springs of the penalty method multiply an error in each substep at the
/// start of a scene; `None` if no error grows, or with another scheme.
///
/// ```
/// use lcplab_mechanics::scene::Scene;
/// use lcplab_mechanics::simulation::spring_growth;
///
/// // 1 kg on a joint with k = 10⁴ N/m, d = 10 N s/m: h² k + 2 h d < 4 for h < 0.019 s.
/// let text = "bodies = [{ name = 'bob', shape = 'point', mass = 1 }]\n\
///     constraints = [{ kind = 'nail', bodies = ['bob'] }]\n\
///     [step]\nscheme = 'penalty'\nsubsteps = 1\ndt = 0.018";
/// let mut scene = Scene::from_toml("bob", text)?;
/// assert_eq!(spring_growth(&scene), None);
/// scene.step.dt = 0.02;
/// assert!(spring_growth(&scene).unwrap() > 1.0);
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn spring_growth(scene: &Scene) -> Option<f64> {
    if scene.step.scheme != Scheme::Penalty {
        return None;
    }
    let h = scene.step.dt / scene.step.substeps as f64;
    let touching = contacts(scene, &scene.states, 0.0);
    let assembly = Assembly::new(scene, &scene.states, &touching, ConstraintFilter::Near).ok()?;
    let [springs, dampers]: [Vec<f64>; 2] =
        [0, 1].map(|k| assembly.rows.iter().map(|row| parts(scene, row, h)[k]).collect());
    let weights: Vec<f64> =
        springs.iter().zip(&dampers).map(|(k, d)| (k + 2.0 * d).sqrt()).collect();
    let mut v: Vec<f64> = (0..weights.len()).map(|i| 1.0 + libm::sin(i as f64)).collect();
    let mut largest = 0.0;
    for _ in 0..ITERATIONS {
        let size = v.iter().map(|v| v * v).sum::<f64>().sqrt();
        if !(size > 0.0 && size.is_finite()) {
            return None;
        }
        v.iter_mut().for_each(|v| *v /= size);
        let weighted = |v: &[f64]| v.iter().zip(&weights).map(|(v, w)| v * w).collect::<Vec<_>>();
        let rates = assembly.accelerate(&assembly.pull_back(&weighted(&v)));
        let next = weighted(&assembly.push_forward(&rates));
        largest = v.iter().zip(&next).map(|(v, next)| v * next).sum();
        v = next;
    }
    if !(largest > LIMIT) {
        return None;
    }
    // The parts of springs and of dampers in the stiffest combination.
    let all: f64 = v.iter().map(|v| v * v).sum();
    let spring: f64 = (0..v.len())
        .filter(|&i| weights[i] > 0.0)
        .map(|i| v[i] * v[i] * springs[i] / (weights[i] * weights[i]))
        .sum();
    let by_springs = largest * spring / all;
    let by_dampers = 0.5 * (largest - by_springs);
    // λ² + p λ + 1 − a h d = 0
    let p = by_springs + by_dampers - 2.0;
    Some(0.5 * (p + (p * p - 4.0 * (1.0 - by_dampers)).max(0.0).sqrt()))
}

/// The same as a sentence, with what helps.
///
/// ```
/// use lcplab_mechanics::scene::Scene;
/// use lcplab_mechanics::simulation::unstable_springs;
///
/// assert_eq!(unstable_springs(&Scene::load("fig7")?), None); // it has no springs
/// # Ok::<(), lcplab_lcp::error::Error>(())
/// ```
pub fn unstable_springs(scene: &Scene) -> Option<String> {
    let factor = readable(spring_growth(scene)?, 3);
    let h = readable(scene.step.dt / scene.step.substeps as f64, 3);
    Some(format!(
        "the springs of the scheme penalty are unstable with substeps of {h} s: each substep multiplies \
         errors by up to {factor}. Increase step.substeps, or reduce step.penalty.stiffness and \
         step.penalty.damping."
    ))
}

/// h² k and h d of a row that acts as a spring at the start.
fn parts(scene: &Scene, row: &Row, h: f64) -> [f64; 2] {
    let acts = match row.bounds {
        Bounds::Bilateral => true,
        Bounds::Unilateral => row.c <= 0.0,
        Bounds::Effort(_) | Bounds::Friction { .. } => false,
    };
    let penalty = &scene.step.penalty;
    let (k, d) = match row.spring {
        Some(spring) => (spring.stiffness, spring.damping),
        None => (penalty.stiffness, penalty.damping),
    };
    if acts { [h * h * k, h * d] } else { [0.0; 2] }
}
