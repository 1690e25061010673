//! One case for each joint of the registry: the degrees of freedom that it removes and the load
//! that it supports.

use lcplab_mechanics::constraint::ALL;

/// The mass (kg), the acceleration of gravity (m/s²) and the lever (m) of the hanging body.
pub const MASS: f64 = 2.0;
pub const G: f64 = 9.81;
pub const LEVER: f64 = 0.4;

/// A joint between a post and a body, with known loads.
pub struct Case {
    /// The joint's name in the registry.
    pub name: &'static str,
    /// The degrees of freedom that it removes while all its rows act.
    pub removes: usize,
    /// Where the body hangs.
    pub place: Place,
    /// The joint's fields in a scene file.
    pub fields: String,
    /// Other constraints for the directions that the joint leaves free.
    pub help: &'static str,
    /// The angle (rad) of the body about y, around the post, when it is released.
    pub turned: f64,
    /// The fraction of the weight that the joint supports.
    pub force: f64,
    /// The fraction of the weight's torque about the post that its angular rows support.
    pub moment: f64,
}

/// Where the body hangs; the post is at (0, 0, 1).
#[derive(Clone, Copy, PartialEq)]
pub enum Place {
    /// Half a meter below the post.
    Under,
    /// Next to it, at the end of the lever.
    Beside,
}

const NAIL: &str = "[[constraints]]\nkind = \"nail\"\nbodies = [\"body\"]\npoint = [0, 0, 1]\n";

/// A case that supports the weight at the post.
fn carries(name: &'static str, removes: usize, place: Place, fields: &str) -> Case {
    let moment = if place == Place::Beside { 1.0 } else { 0.0 };
    let fields = fields.into();
    Case { name, removes, place, fields, help: "", turned: 0.0, force: 1.0, moment }
}

/// A case that supports only the torque, with a nail for the weight.
fn turns(name: &'static str, removes: usize, turned: f64, fields: &str) -> Case {
    let carried = carries(name, removes, Place::Beside, fields);
    Case { help: NAIL, turned, force: 0.0, moment: 1.0, ..carried }
}

pub fn cases() -> Vec<Case> {
    use Place::{Beside, Under};
    let post = "point = [0, 0, 1]\n";
    let along = "point = [0, 0, 1]\naxis = [1, 0, 0]\n"; // the axis runs from the post to the body
    // The weight turns the body about this axis, towards positive angles.
    let across = "axis = [0, 1, 0]\n";
    let up = "axis = [0, 0, 1]\n";
    let rod = "points = [[0, 0, 1], [0, 0, 0.6]]\n";
    let with = |fields: &str, more: &str| format!("{fields}{more}\n");
    let torque = MASS * G * LEVER;
    vec![
        carries("ball", 3, Under, post),
        carries("nail", 3, Under, post),
        carries("fixed", 6, Beside, post),
        turns("orientation", 3, 0.0, ""),
        Case { moment: 0.0, ..carries("lock_translation", 1, Beside, up) },
        turns("lock_rotation", 1, 0.0, across),
        carries("hinge", 5, Beside, along),
        carries("slider", 5, Beside, along),
        carries("cylindrical", 4, Beside, along),
        carries("universal", 4, Beside, &with(post, "axes = [[1, 0, 0], [0, 0, 1]]")),
        carries("distance", 1, Under, rod),
        carries("squared_distance", 1, Under, rod),
        carries("rope", 1, Under, rod),
        carries("pulley", 1, Under, "points = [[0.3, 0, 2], [0, 0, 1.5]]\n"),
        // It is 0.4 long and was 0.38: 0.02 = m g/k.
        carries(
            "spring",
            1,
            Under,
            &with(rod, &format!("length = 0.38\nstiffness = {}", 50.0 * MASS * G)),
        ),
        turns(
            "spring_rotation",
            1,
            0.3,
            &with(across, &format!("stiffness = {}", torque * 0.3_f64.cos() / 0.3)),
        ),
        Case {
            moment: 0.0,
            ..carries("motor_translation", 1, Beside, &with(up, "speed = 0\neffort = 50"))
        },
        turns("motor_rotation", 1, 0.0, &with(across, "speed = 0\neffort = 50")),
        Case {
            moment: 0.0,
            ..carries("limit_translation", 1, Beside, &with(up, "limits = [0, inf]"))
        },
        turns("limit_rotation", 1, 0.3, &with(across, "limits = [-1, 0.3]")),
        turns("limit_cone", 1, 0.3, "axis = [1, 0, 0]\nangle = 0.3\n"),
        Case {
            moment: 0.0,
            ..carries("rack", 1, Beside, "axes = [[0, 1, 0], [0, 0, 1]]\nlength = 0.25\n")
        },
        turns("gear", 1, 0.0, "axes = [[0, 1, 0], [0, 1, 0]]\nteeth = [3, 2]\n"),
    ]
}

#[test]
fn every_joint_of_the_registry_has_a_case() {
    let mut cases: Vec<_> = cases().iter().map(|case| case.name).collect();
    let mut all: Vec<_> = ALL.iter().map(|joint| joint.name).collect();
    cases.sort_unstable();
    all.sort_unstable();
    assert_eq!(cases, all);
}
