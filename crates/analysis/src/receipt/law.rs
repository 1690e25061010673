//! Whether forces and motion satisfy the law of every row: for steps whose motion error has no
//! bound, such as those with friction cones without compliance.
//!
//! With w = J v + bias + compliance · x, a solution has x = Π(x − w / s) in every row or cone, for
//! every s > 0; Π is the nearest point within the bounds or in the cone. With s = the largest
//! diagonal entry of J M⁻¹Jᵀ + compliance of its rows, √s |x − Π(x − w / s)| is about the change of
//! the motion, in the norm of M, by the impulse that corrects this row or cone alone. It is 0 in
//! all rows exactly if the law is satisfied. It is no bound on the motion error: the errors of many
//! rows can add up.

use lcplab_judge::gap_bound::EllipticCone;

use super::step::{EngineStep, MassFactor};

/// The largest violation, with its row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Violation {
    pub(crate) row: usize,
    /// In the norm of M.
    pub(crate) size: f64,
}

/// The cones of the rows of friction.
pub(super) fn cones(step: &EngineStep) -> Vec<EllipticCone> {
    let mut friction: Vec<Vec<(usize, f64)>> = vec![Vec::new(); step.len()];
    for (row, normal) in step.friction.index.iter().enumerate() {
        if let Some(normal) = normal {
            friction[*normal].push((row, step.friction.mu[row]));
        }
    }
    let with_friction = friction.into_iter().enumerate().filter(|(_, own)| !own.is_empty());
    with_friction.map(|(normal, friction)| EllipticCone { normal, friction }).collect()
}

/// The largest violation of the law of a row or cone; the law is that of boxes or associated cones.
pub(crate) fn of_law(step: &EngineStep) -> Option<Violation> {
    let laws = RowLaws::new(step);
    let w = step.remaining();
    let forces = &step.answer.forces;
    let point = (0..step.len()).map(|i| forces[i] - w[i] / laws.scales[i]).collect();
    laws.largest(&laws.nearest(point))
}

/// The largest distance of forces from their bounds and cones.
pub(crate) fn of_bounds(step: &EngineStep) -> Option<Violation> {
    let laws = RowLaws::new(step);
    laws.largest(&laws.nearest(step.answer.forces.clone()))
}

struct RowLaws<'a> {
    step: &'a EngineStep,
    cones: Vec<EllipticCone>,
    /// The cone of each row, if it has one.
    cone: Vec<Option<usize>>,
    /// s of each row.
    scales: Vec<f64>,
}

impl<'a> RowLaws<'a> {
    fn new(step: &'a EngineStep) -> Self {
        let cones = cones(step);
        let mut cone = vec![None; step.len()];
        let mut scales = diagonal(step);
        for (c, own) in cones.iter().enumerate() {
            let rows = || [own.normal].into_iter().chain(own.friction.iter().map(|&(row, _)| row));
            let most = rows().map(|row| scales[row]).fold(0.0, f64::max);
            rows().for_each(|row| (cone[row], scales[row]) = (Some(c), most));
        }
        // A row that moves nothing has no scale of its own.
        let most = scales.iter().copied().fold(0.0, f64::max);
        let most = if most > 0.0 { most } else { 1.0 };
        scales.iter_mut().filter(|scale| **scale <= 0.0).for_each(|scale| *scale = most);
        RowLaws { step, cones, cone, scales }
    }

    fn nearest(&self, mut point: Vec<f64>) -> Vec<f64> {
        let gauss = &self.step.gauss;
        for (i, value) in point.iter_mut().enumerate().filter(|(i, _)| self.cone[*i].is_none()) {
            *value = value.max(gauss.lo[i]).min(gauss.hi[i]);
        }
        let weights = vec![1.0; point.len()];
        self.cones.iter().for_each(|cone| cone.project(&mut point, &weights));
        point
    }

    /// The largest distance of the forces from a point, over rows and cones.
    fn largest(&self, point: &[f64]) -> Option<Violation> {
        let forces = &self.step.answer.forces;
        let apart = |i: usize| (self.scales[i].sqrt() * (forces[i] - point[i])).abs();
        let mut of_cone = vec![0.0; self.cones.len()];
        for (i, cone) in self.cone.iter().enumerate() {
            cone.iter().for_each(|&c| of_cone[c] = f64::hypot(of_cone[c], apart(i)));
        }
        let violation = |row: usize| Violation {
            row,
            size: self.cone[row].map_or_else(|| apart(row), |c| of_cone[c]),
        };
        let worst = |a: Violation, b: Violation| if b.size > a.size { b } else { a };
        (0..forces.len()).map(violation).reduce(worst)
    }
}

/// The diagonal of J M⁻¹Jᵀ + compliance, n entries.
fn diagonal(step: &EngineStep) -> Vec<f64> {
    let factor = MassFactor::of(&step.gauss.mass, step.gauss.target.len());
    let rows = step.gauss.jacobian.iter().zip(&step.gauss.compliance);
    rows.map(|(row, compliance)| {
        let mut push = vec![0.0; step.gauss.target.len()];
        row.iter().for_each(|&(j, value)| push[j] += value);
        let change = factor.solve(&push);
        row.iter().map(|&(j, value)| value * change[j]).sum::<f64>() + compliance
    })
    .collect()
}
