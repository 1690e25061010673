//! Notes on settings that have no effect or cannot work, reported once per simulation.

use std::f64::consts::SQRT_2;

use super::{Integrator, Scene, Scheme, Solver, Step, catalogue};

impl Scene {
    /// One sentence for each setting that the scheme ignores without using another instead, and for
    /// each that makes it unstable. A shipped scene has settings for several schemes, so a setting
    /// is noted only if it differs from the shipped one and from the default.
    pub fn notes(&self) -> Vec<String> {
        let shipped = catalogue::SHIPPED.iter().find(|shipped| shipped.name == self.name);
        let shipped = shipped.and_then(|shipped| shipped.scene().ok());
        let usual = shipped.map_or_else(Step::default, |scene| scene.step);
        let (step, default) = (&self.step, Step::default());
        let is_new = |own: f64, usual: f64, default: f64| own != usual && own != default;
        let scheme = step.scheme;
        let is_force = scheme == Scheme::Acceleration;
        let feeds_back = matches!(scheme, Scheme::Velocity | Scheme::SequentialImpulses);
        let mut notes = Vec::new();
        let mut unread = |is_set: bool, setting: &str, reads: &str| {
            if is_set {
                let scheme = scheme.name();
                notes.push(format!("{setting} has no effect with the scheme {scheme}; {reads}"));
            }
        };
        unread(
            is_new(step.alpha, usual.alpha, default.alpha)
                && step.baumgarte == usual.baumgarte
                && !is_force,
            "step.alpha",
            "it is for the acceleration level; at velocity level use step.baumgarte for error feedback",
        );
        unread(
            is_new(step.baumgarte, usual.baumgarte, default.baumgarte)
                && step.alpha == usual.alpha
                && !feeds_back,
            "step.baumgarte",
            "it is for velocity and sequential-impulses; at acceleration level use step.alpha for error feedback",
        );
        unread(
            step.integrator != usual.integrator
                && step.integrator != default.integrator
                && !is_force,
            "step.integrator",
            "it is for the acceleration level",
        );
        let substeps = matches!(scheme, Scheme::Xpbd | Scheme::Soft | Scheme::Penalty);
        unread(
            step.substeps != usual.substeps && step.substeps != default.substeps && !substeps,
            "step.substeps",
            "it is for xpbd, soft and penalty",
        );
        let bounces = self.contact.restitution > 0.0
            || self.bodies.iter().any(|body| body.restitution.is_some_and(|e| e > 0.0))
            || self.pairs.values().any(|pair| pair.restitution.is_some_and(|e| e > 0.0));
        unread(
            bounces && scheme == Scheme::Penalty,
            "the restitution of contacts, bodies and pairs",
            "set step.penalty.damping instead",
        );
        let usual = Scene { solver: Solver { scale: None, ..self.solver.clone() }, ..self.clone() };
        if let Some(scale) = self.solver.scale.filter(|scale| *scale > usual.scale()) {
            notes.push(format!(
                "rows with forces below solver.scale = {scale} N count as at rest; the default is {} N",
                usual.scale()
            ));
        }
        let (rate, limit) = (step.alpha * step.dt, most_alpha_dt(step.integrator));
        if is_force && rate >= limit {
            let name = step.integrator.name();
            notes.push(format!(
                "step.alpha times dt is {rate}; with the integrator {name} errors grow if it is {limit:.4} or \
                 more"
            ));
        }
        notes
    }
}

/// The α dt above which the error c'' = −2 α c' − α² c grows.
///
/// Semi-implicit Euler has λ² − (2 − 2a − a²) λ + 1 − 2a = 0 with a = α dt, which reaches λ = −1 at
/// a = 2 (√2 − 1); explicit Euler has λ = 1 − a twice; Runge-Kutta reaches the end of its stability
/// interval on the real axis.
fn most_alpha_dt(integrator: Integrator) -> f64 {
    match integrator {
        Integrator::SemiImplicitEuler => 2.0 * (SQRT_2 - 1.0),
        Integrator::ExplicitEuler => 2.0,
        Integrator::Rk4 => 2.785_293_563_405_282,
        Integrator::ImplicitMidpoint => f64::INFINITY,
    }
}
