//! A body hung from each joint: the forces of its rows equal its weight, m g, and the torques of
//! its angular rows balance m g times the lever. Exact up to rounding at both levels, since the
//! body is at rest.

use lcplab_mechanics::assembly::Source;
use lcplab_mechanics::constraint::Joint;
use lcplab_mechanics::scene::{Scene, Scheme};
use nalgebra::{UnitQuaternion, Vector3, Vector6};

use super::joints::{Case, G, LEVER, MASS, Place, cases};
use super::start;

const POST: Vector3<f64> = Vector3::new(0.0, 0.0, 1.0);

fn scene(case: &Case) -> Scene {
    let position = match case.place {
        Place::Under => [0.0, 0.0, 0.5],
        Place::Beside => [LEVER, 0.0, 1.0],
    };
    let two = Joint::by_name(case.name).unwrap().bodies.1 == 2;
    let bodies = if two { "[\"post\", \"body\"]" } else { "[\"body\"]" };
    let text = format!(
        "gravity = [0, 0, -{G}]\n\
         [[bodies]]\nname = \"post\"\nshape = {{ box = [0.1, 0.1, 0.1] }}\nfixed = true\nposition = [0, 0, 1]\n\
         [[bodies]]\nname = \"body\"\nshape = {{ box = [0.1, 0.2, 0.3] }}\nmass = {MASS}\nposition = {position:?}\n\
         [[constraints]]\nkind = \"{}\"\nbodies = {bodies}\n{}{}",
        case.name, case.fields, case.help
    );
    let mut scene = Scene::from_toml(case.name, &text).unwrap();
    let turn = UnitQuaternion::from_scaled_axis(Vector3::y() * case.turned);
    let pose = &mut scene.states[1].pose;
    (pose.p, pose.q) = (POST + turn * (pose.p - POST), turn * pose.q);
    scene
}

/// [f; τ] on the hanging body of the joint's rows, of its angular rows alone, and of all rows.
fn wrenches(scene: Scene) -> [Vector6<f64>; 3] {
    let unit = if scene.step.scheme == Scheme::Velocity { scene.step.dt } else { 1.0 };
    let step = start(scene).step().unwrap();
    let solve = step.solves.last().unwrap();
    let mut wrenches = [Vector6::zeros(); 3];
    for (row, x) in solve.problem.assembly.rows.iter().zip(&solve.solution.x) {
        let own = row.id.source == Source::Constraint(0);
        let wrench = row.parts().next().unwrap().jacobian * *x / unit;
        let counts = [own, own && row.kind.is_angular(), true];
        for (sum, _) in wrenches.iter_mut().zip(counts).filter(|(_, counts)| *counts) {
            *sum += wrench;
        }
    }
    wrenches
}

#[test]
fn every_joint_reports_the_weight_that_hangs_on_it() {
    for case in cases() {
        for level in Scheme::LEVELS {
            let mut scene = scene(&case);
            scene.step.scheme = level;
            let [joint, angular, all] = wrenches(scene);
            let weight = MASS * G;
            let force = Vector3::z() * (case.force * weight);
            // Gravity rotates the body about +y, so the joint's torque is about −y.
            let moment = -Vector3::y() * (case.moment * weight * LEVER * case.turned.cos());
            let near = |ours: Vector3<f64>, exact: Vector3<f64>, what: &str| {
                let error = (ours - exact).norm();
                assert!(error < 1e-11 * weight, "{} {level:?}: {what} {ours} {exact}", case.name);
            };
            near(joint.fixed_rows::<3>(0).into(), force, "force");
            near(angular.fixed_rows::<3>(3).into(), moment, "moment");
            near(all.fixed_rows::<3>(0).into(), Vector3::z() * weight, "all forces");
            near(all.fixed_rows::<3>(3).into(), Vector3::zeros(), "all torques");
        }
    }
}
