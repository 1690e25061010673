//! Formulates the LCP of a step from the physics, and converts its answer back to motion; the only
//! link between the two sides.
//!
//! Every stage of a step has the same form. Without constraints the bodies would move with the
//! *target*: u* = u + dt M⁻¹F, or u itself for an impact, or the accelerations M⁻¹F. Then
//!
//! ```text
//! A = J M⁻¹ Jᵀ + diag(γ),   b = J target + bias,   and the answer x moves them with   target + M⁻¹ Jᵀ x
//! ```
//!
//! and the stages differ only in the target and the bias: velocity.rs, acceleration.rs and
//! position.rs have one formula each. γ > 0 if a row is a spring. Forces with fixed bounds act for
//! a duration, dt for an impulse, and not at all in an impact. x ≥ 0 pushes apart.
//!
//! ```
//! use lcplab_lcp::friction::Model;
//! use lcplab_mechanics::assembly::{Assembly, ConstraintFilter};
//! use lcplab_mechanics::formulation::{Problem, Slide, Stage};
//! use lcplab_mechanics::scene::{Scene, contacts};
//!
//! // A point of 2 kg slides along x at 3 m/s on the ground; μ = 0.5, g = 10 m/s².
//! let text = r#"
//!     gravity = [0, 0, -10]
//!     contact = { friction = 0.5, sliding = "substituted" }
//!     step = { scheme = "acceleration", dt = 0.1 }
//!     [[bodies]]
//!     name = "ground"
//!     fixed = true
//!     shape = { plane = [0, 0, 1] }
//!     [[bodies]]
//!     name = "point"
//!     shape = "point"
//!     mass = 2
//!     velocity = [3, 0, 0]
//! "#;
//! let scene = Scene::from_toml("point.toml", text)?;
//! let found = contacts(&scene, &scene.states, 0.01);
//! let filter = ConstraintFilter::Near;
//! let assembly = Assembly::new(&scene, &scene.states, &found, filter).expect("a direction");
//!
//! // Forces: the ground carries m g = 20 N, so that friction is μ m g = 10 N against the slip.
//! let slides = Slide::of_scene(&scene, &assembly);
//! assert_eq!(slides, Slide::all(&assembly, scene.contact.sticking_speed));
//! let forces = Problem::sliding(&scene, assembly.clone(), slides)?;
//! let x = [20.0, 0.0, 0.0];
//! assert_eq!(forces.lcp.row_w(0, &x), 0.0);
//! assert_eq!(forces.efforts(&x), [20.0, -10.0, 0.0]); // N
//! assert_eq!(forces.motion(&x), [-5.0, 0.0, 0.0]); // m/s²
//! assert_eq!(forces.next_velocity(&x, 0.1), [2.5, 0.0, 0.0]); // m/s
//! // Without the substitution, friction has rows of its own.
//! let with_rows = Problem::acceleration(&scene, assembly.clone())?;
//! assert_eq!(with_rows.lcp.bounds(1, &x), (-10.0, 10.0));
//!
//! // Impulses of a step of 0.1 s: m g dt = 2 N s, and friction of at most μ times it.
//! let impulses = Problem::velocity(&scene, assembly)?;
//! assert_eq!((impulses.stage.name(), impulses.stage.unit(false)), ("velocity", "N s"));
//! assert_eq!(Stage::Acceleration.unit(true), "N m");
//! assert_eq!(impulses.motion(&[2.0, -1.0, 0.0]), [2.5, 0.0, 0.0]);
//! assert_eq!(impulses.gauss(&[2.0, -1.0, 0.0]).hi[1], 1.0);
//! assert!(impulses.pose(Model::CoupledBox, &[])?.is_none()); // that is the LCP itself
//! assert_eq!(impulses.pose(Model::CoulombCone, &[])?.unwrap().model, Model::CoulombCone);
//! # Ok::<(), lcplab_lcp::error::Error>(())
//! ```

mod acceleration;
mod delassus;
mod friction;
mod position;
mod redundant;
mod sliding;
mod sticking;
mod velocity;

pub use crate::scene::Scheme;
pub use friction::Posing;
pub use sliding::Slide;
pub(crate) use velocity::{Bias, has_closed};

use crate::assembly::{Assembly, Row};
use crate::body::State;
use crate::constraint::Bounds;
use crate::scene::Scene;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::{Coupling, Gauss, Lcp, Level, file};

/// The quantity that an LCP determines within a step.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Stage {
    /// The impulses (N s) of a step at velocity level.
    Velocity,
    /// The impulses (N s) of an impact, before a step at acceleration level.
    Impact,
    /// The impulses (N s) of the second phase, with restitution.
    Restitution,
    /// The forces (N) of a step at acceleration level.
    Acceleration,
    /// The corrections (kg m) of positions after a step.
    Position,
}

impl Stage {
    /// The name in tables and file names.
    pub fn name(self) -> &'static str {
        match self {
            Stage::Velocity => "velocity",
            Stage::Impact => "impact",
            Stage::Restitution => "restitution",
            Stage::Acceleration => "acceleration",
            Stage::Position => "position",
        }
    }

    /// The kind of motion that x determines; `None` for displacements.
    fn level(self) -> Option<Level> {
        match self {
            Stage::Velocity | Stage::Impact | Stage::Restitution => Some(Level::Velocity),
            Stage::Acceleration => Some(Level::Acceleration),
            Stage::Position => None,
        }
    }

    /// The x below which a row counts as at rest: the [scale](Scene::scale) of the scene's forces,
    /// or its effect in a step.
    fn scale(self, scene: &Scene) -> f64 {
        let (force, dt) = (scene.scale(), scene.step.dt);
        match self {
            Stage::Acceleration => force,
            Stage::Velocity | Stage::Impact | Stage::Restitution => force * dt,
            Stage::Position => force * dt * dt,
        }
    }

    /// The unit of x for an angular or linear row.
    pub fn unit(self, angular: bool) -> &'static str {
        match (self, angular) {
            (Stage::Acceleration, false) => "N",
            (Stage::Acceleration, true) => "N m",
            (Stage::Position, false) => "kg m",
            (Stage::Position, true) => "kg m²",
            (_, false) => "N s",
            (_, true) => "N m s",
        }
    }
}

/// An LCP with the matrices it was built from.
#[derive(Debug, Clone)]
pub struct Problem {
    /// The quantity it determines.
    pub stage: Stage,
    /// The duration of its step (s): 0 for an impact.
    pub dt: f64,
    /// The LCP.
    pub lcp: Lcp,
    /// The scene at this instant; its rows are those of the LCP.
    pub assembly: Assembly,
    /// The motion without constraints, one entry per column: velocities (m/s, rad/s); accelerations
    /// at the acceleration stage; 0 at the position stage.
    pub target: Vec<f64>,
    /// The term added to J target, one entry per row; for an equality that depends on others, the
    /// value that follows from theirs.
    pub bias: Vec<f64>,
    /// γ, the compliance added to the diagonal of A, one entry per row.
    pub compliance: Vec<f64>,
    /// The contacts whose friction is proportional to their normal force; their tangential rows are
    /// 0 in x.
    pub slides: Vec<Slide>,
}

impl Problem {
    /// The impulse LCP of a step at velocity level.
    ///
    /// # Errors
    /// If a number is not finite, or A needs more memory than the scene allows.
    pub fn velocity(scene: &Scene, assembly: Assembly) -> Result<Self> {
        let bias = velocity::bias(&assembly, scene, scene.step.baumgarte);
        Problem::stepping(scene, assembly, bias)
    }

    /// The same without feedback of position errors, which are corrected elsewhere.
    ///
    /// # Errors
    /// If a number is not finite, or A needs too much memory.
    pub(crate) fn unbiased(scene: &Scene, assembly: Assembly) -> Result<Self> {
        let bias = velocity::bias(&assembly, scene, 0.0);
        Problem::stepping(scene, assembly, bias)
    }

    fn stepping(scene: &Scene, assembly: Assembly, bias: Vec<f64>) -> Result<Self> {
        let target = velocity::target(&assembly, scene.step.dt);
        Problem::new(scene, Stage::Velocity, assembly, target, bias, scene.step.dt, Vec::new())
    }

    /// The impulse LCP of an impact: no force, no bias, only J u⁺ ≥ 0.
    ///
    /// # Errors
    /// If a number is not finite, or A needs too much memory.
    pub(crate) fn impact(scene: &Scene, assembly: Assembly) -> Result<Self> {
        let bias = assembly.rows.iter().map(|row| row.drift).collect();
        let target = assembly.u.clone();
        Problem::new(scene, Stage::Impact, assembly, target, bias, 0.0, Vec::new())
    }

    /// The impulse LCP with restitution: w = J u⁺ + e J u⁻ ≥ 0 in the rows that closed under the
    /// first answer x and had approached at `bounce_speed` or faster; `None` if there is no such
    /// row.
    ///
    /// # Errors
    /// If a number is not finite.
    pub(crate) fn restitution(&self, scene: &Scene, x: &[f64]) -> Result<Option<Self>> {
        velocity::bouncing(self, scene, x)
            .map(|bias| {
                let b = offsets(&self.assembly, &self.target, &bias);
                let lcp = self.lcp.with_b(b)?;
                Ok(Problem { stage: Stage::Restitution, lcp, bias, ..self.clone() })
            })
            .transpose()
    }

    /// The force LCP of a step at acceleration level.
    ///
    /// # Errors
    /// If a number is not finite, or A needs too much memory.
    pub fn acceleration(scene: &Scene, assembly: Assembly) -> Result<Self> {
        Problem::sliding(scene, assembly, Vec::new())
    }

    /// The same with the friction of sliding contacts substituted.
    ///
    /// # Errors
    /// If a number is not finite, or A needs too much memory.
    pub fn sliding(scene: &Scene, assembly: Assembly, slides: Vec<Slide>) -> Result<Self> {
        let target = assembly.accelerate(&assembly.force);
        let bias = acceleration::bias(&assembly, scene);
        Problem::new(scene, Stage::Acceleration, assembly, target, bias, scene.step.dt, slides)
    }

    /// The LCP that corrects positions.
    ///
    /// # Errors
    /// If a number is not finite, or A needs too much memory.
    pub(crate) fn position(scene: &Scene, assembly: Assembly) -> Result<Self> {
        let target = vec![0.0; assembly.columns()];
        let bias = position::bias(&assembly, scene);
        Problem::new(scene, Stage::Position, assembly, target, bias, 0.0, Vec::new())
    }

    fn new(
        scene: &Scene,
        stage: Stage,
        assembly: Assembly,
        target: Vec<f64>,
        mut bias: Vec<f64>,
        dt: f64,
        slides: Vec<Slide>,
    ) -> Result<Self> {
        delassus::check(&assembly, scene.memory)?;
        let rows = &assembly.rows;
        let known: Vec<Option<f64>> =
            rows.iter().map(|row| acceleration::spring_force(row, stage, scene)).collect();
        let yields = |(row, known): (&Row, &Option<f64>)| match known {
            Some(_) => 0.0,
            None => compliance(row, stage, dt),
        };
        let compliance: Vec<f64> = rows.iter().zip(&known).map(yields).collect();
        let bounded = |(row, known): (&Row, &Option<f64>)| {
            known.map_or_else(|| limits(row, stage, dt), |force| (force, force))
        };
        let (mut lo, mut hi): (Vec<f64>, Vec<f64>) = rows.iter().zip(&known).map(bounded).unzip();
        let friction = rows.iter().map(|row| match row.bounds {
            Bounds::Friction { normal, mu } => (Some(normal), mu),
            _ => (None, 0.0),
        });
        let (mut index, mu): (Vec<Option<usize>>, Vec<f64>) = friction.unzip();
        for &(t, _) in slides.iter().flat_map(|slide| &slide.drag) {
            (lo[t], hi[t], index[t]) = (0.0, 0.0, None);
        }
        let a = delassus::matrix(&assembly, &compliance, &slides);
        redundant::agree(&assembly, &a, &mut bias, stage.scale(scene));
        let b = offsets(&assembly, &target, &bias);
        let finite = |i: &usize| b[*i].is_finite() && a.diagonal(*i).is_finite();
        if let Some(i) = (0..rows.len()).find(|i| !finite(i)) {
            return Err(overflow(scene, &rows[i]));
        }
        let lcp = Lcp::new(a, b, lo, hi)?;
        let lcp = lcp.with_coupling(Coupling::new(index, mu)?)?;
        let lcp = lcp.with_scale(stage.scale(scene))?;
        Ok(Problem { stage, dt, lcp, assembly, target, bias, compliance, slides })
    }

    /// The forces or impulses of an answer: x, and the friction that depends on it.
    pub fn efforts(&self, x: &[f64]) -> Vec<f64> {
        let mut efforts = x.to_vec();
        for slide in &self.slides {
            for &(t, part) in &slide.drag {
                efforts[t] = part * x[slide.normal];
            }
        }
        efforts
    }

    /// The motion with the constraint forces x: target + M⁻¹ Jᵀ x.
    pub fn motion(&self, x: &[f64]) -> Vec<f64> {
        let change = self.assembly.accelerate(&self.assembly.pull_back(&self.efforts(x)));
        self.target.iter().zip(change).map(|(target, change)| target + change).collect()
    }

    /// The velocities u⁺ that result from x: the motion itself; u + dt times it at acceleration
    /// level; u at position level.
    pub fn next_velocity(&self, x: &[f64], dt: f64) -> Vec<f64> {
        let motion = self.motion(x);
        match self.stage {
            Stage::Velocity | Stage::Impact | Stage::Restitution => motion,
            Stage::Acceleration => {
                self.assembly.u.iter().zip(motion).map(|(u, rate)| u + dt * rate).collect()
            }
            Stage::Position => self.assembly.u.clone(),
        }
    }

    /// The states after the step: s + dt S u⁺ for the current states; at position level s + S
    /// M⁻¹Jᵀx with unchanged velocities.
    pub(crate) fn next_states(&self, states: &[State], x: &[f64], dt: f64) -> Vec<State> {
        if self.stage == Stage::Position {
            let still = vec![State::WORLD; states.len()];
            let moves = self.assembly.with_velocities(&still, &self.motion(x));
            let shifted = |(state, shift): (&State, &State)| state.displaced(&shift.velocity());
            return states.iter().zip(&moves).map(shifted).collect();
        }
        let moved = self.assembly.with_velocities(states, &self.next_velocity(x, dt));
        self.assembly.advanced(&moved, dt)
    }

    /// The problem as a file: its numbers, and the bodies and rows that they were built from. With
    /// sliding contacts A does not define a minimization, and the file contains no bodies.
    pub(crate) fn in_numbers(&self, name: impl Into<String>) -> file::Problem {
        let motion = self.slides.is_empty().then(|| self.unbounded_by_friction());
        file::Problem { motion, ..file::Problem::new(name, self.lcp.clone()) }
    }

    /// The same motion as a primal program, by Gauss's principle; coupled rows get the bounds that
    /// follow from x.
    pub fn gauss(&self, x: &[f64]) -> Gauss {
        let (lo, hi) = (0..self.lcp.len()).map(|i| self.lcp.bounds(i, x)).unzip();
        Gauss { lo, hi, ..self.unbounded_by_friction() }
    }

    /// The same with unbounded coupled rows.
    pub(crate) fn unbounded_by_friction(&self) -> Gauss {
        let n = self.lcp.len();
        Gauss {
            mass: self.assembly.blocks.iter().flat_map(|block| block.mass_entries()).collect(),
            jacobian: (0..n).map(|i| self.assembly.jacobian_row(i)).collect(),
            bias: self.bias.clone(),
            compliance: self.compliance.clone(),
            target: self.target.clone(),
            lo: self.lcp.lo().to_vec(),
            hi: self.lcp.hi().to_vec(),
            level: self.stage.level(),
        }
    }
}

/// The error for a row whose numbers are not finite.
fn overflow(scene: &Scene, row: &Row) -> Error {
    let reason = "its entries of A and b are too large for 64-bit numbers; check masses, sizes, speeds, forces \
     and dt";
    Error::invalid(&*scene.name, row.label(scene), reason)
}

/// b = J target + bias.
fn offsets(assembly: &Assembly, target: &[f64], bias: &[f64]) -> Vec<f64> {
    assembly.push_forward(target).iter().zip(bias).map(|(a, b)| a + b).collect()
}

/// lo and hi of a row: forces, or impulses of forces that act for dt. Limited forces contribute
/// nothing to an impact, which has no duration, or to position corrections, which involve no force.
fn limits(row: &Row, stage: Stage, dt: f64) -> (f64, f64) {
    match (stage, row.bounds) {
        (Stage::Impact | Stage::Position, _) if row.is_force_limited() => (0.0, 0.0),
        (Stage::Velocity, Bounds::Effort(effort)) => (-effort * dt, effort * dt),
        (_, bounds) => bounds.interval(),
    }
}

/// γ of a row.
fn compliance(row: &Row, stage: Stage, dt: f64) -> f64 {
    match row.spring {
        Some(spring) if !matches!(stage, Stage::Impact | Stage::Position) => spring.compliance(dt),
        _ => 0.0,
    }
}
