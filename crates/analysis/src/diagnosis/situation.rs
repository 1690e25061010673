//! Diagnoses a scene at an instant.

use super::{Cause, DegreesOfFreedom, Diagnosis};
use nalgebra::DMatrix;

use lcplab_lcp::error::Result;
use lcplab_lcp::friction::Model;
use lcplab_mechanics::assembly::{Assembly, ConstraintFilter, Row};
use lcplab_mechanics::constraint::Bounds;
use lcplab_mechanics::formulation::{Problem, Slide};
use lcplab_mechanics::scene::{Scene, Scheme, step_contacts};
use lcplab_mechanics::simulation::Simulation;
use lcplab_page::document::notation::plain;

/// A singular value below this fraction of the largest counts as zero.
const RELATIVE_ZERO: f64 = 1e-9;

/// An error c (m or rad) above this is reported.
const APART: f64 = 1e-3;

/// Diagnoses the LCP of a scene at the beginning of a step, counted from 1: that of forces at
/// acceleration level, that of impulses under all other schemes. The steps before it are taken with
/// the scene's settings.
///
/// # Errors
/// If the scene's solver does not exist, or the LCP has numbers that are not finite or more than
/// 2000 rows. If a step cannot be computed, that is reported as a cause, not as an error.
pub fn scene(scene: &Scene, step: usize) -> Result<Diagnosis> {
    observed_scene(scene, step, &|| ())
}

/// The same; `tick` is called after each of the steps before it.
///
/// # Errors
/// As [`scene`].
pub fn observed_scene(scene: &Scene, step: usize, tick: &dyn Fn()) -> Result<Diagnosis> {
    let mut found = Diagnosis::named(format!("{}, step {step}", scene.name), Vec::new());
    let mut simulation = Simulation::of(scene)?;
    for _ in 1..step {
        if let Err(failure) = simulation.step() {
            found.causes.push(Cause::Failed { reason: failure.to_string() });
            break;
        }
        tick();
    }
    let states = simulation.states();
    let is_force = scene.step.scheme == Scheme::Acceleration;
    let filter = if is_force { ConstraintFilter::Resting } else { ConstraintFilter::Near };
    let touching = step_contacts(scene, states);
    let assembly = match Assembly::new(scene, states, &touching, filter) {
        Ok(assembly) => assembly,
        Err(undefined) => {
            let place =
                undefined.bodies.map(|body| body.map_or("world", |k| &scene.bodies[k].name));
            let constraint = format!("{undefined} ({} and {})", place[0], place[1]);
            found.causes.push(Cause::NoDirection { constraint });
            return Ok(found);
        }
    };
    let rows = assembly.rows.iter().enumerate();
    found.labels = rows.map(|(i, row)| format!("{i} ({})", row.label(scene))).collect();
    found.degrees_of_freedom = Some(DegreesOfFreedom::of(&assembly));
    found.causes.extend(apart(&assembly, &found.labels));
    let problem = match is_force {
        true => {
            let slides = Slide::of_scene(scene, &assembly);
            Problem::sliding(scene, assembly, slides)
        }
        false => Problem::velocity(scene, assembly),
    };
    let problem = problem.map_err(|error| error.within(&scene.name))?;
    found.examine(&problem.lcp, scene.contact.model == Model::CoupledBox)?;
    Ok(found)
}

/// The equation with the largest error, and the deepest overlap.
fn apart(assembly: &Assembly, labels: &[String]) -> Vec<Cause> {
    let rows = || assembly.rows.iter().enumerate();
    let is_rigid = |row: &Row| row.bounds == Bounds::Bilateral && row.spring.is_none();
    let equations = rows().filter(|(_, row)| is_rigid(row)).map(|(i, row)| (i, row.c.abs()));
    let one_sided = rows().filter(|(_, row)| row.bounds == Bounds::Unilateral);
    let overlaps = one_sided.map(|(i, row)| (i, -row.c));
    let cause = |(i, error): (usize, f64)| {
        let unit = if assembly.rows[i].kind.is_angular() { "rad" } else { "m" };
        Cause::Apart { row: labels[i].clone(), error: format!("{} {unit}", plain(error)) }
    };
    let worst = [
        equations.reduce(|most, next| if next.1 > most.1 { next } else { most }),
        overlaps.reduce(|most, next| if next.1 > most.1 { next } else { most }),
    ];
    worst.into_iter().flatten().filter(|(_, error)| *error > APART).map(cause).collect()
}

impl DegreesOfFreedom {
    /// The degrees of freedom of a scene at an instant.
    pub fn of(assembly: &Assembly) -> Self {
        let rigid = |i: &usize| {
            let row = &assembly.rows[*i];
            row.bounds == Bounds::Bilateral && row.spring.is_none()
        };
        let rows: Vec<usize> = (0..assembly.rows.len()).filter(rigid).collect();
        let mut jacobian = DMatrix::zeros(rows.len(), assembly.columns());
        for (r, &i) in rows.iter().enumerate() {
            let entries = assembly.jacobian_row(i);
            let length = entries.iter().map(|(_, j)| j * j).sum::<f64>().sqrt();
            for (column, j) in entries {
                jacobian[(r, column)] = j / length;
            }
        }
        let rank = match jacobian.is_empty() {
            true => 0,
            false => {
                let singular = jacobian.singular_values();
                singular.iter().filter(|&&value| value > RELATIVE_ZERO * singular[0]).count()
            }
        };
        DegreesOfFreedom { components: assembly.columns(), rows: rows.len(), rank }
    }
}
