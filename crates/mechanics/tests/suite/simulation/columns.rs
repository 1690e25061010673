//! Columns close to the angle at which they tip, and what is reported of bodies that leave a rest.

use lcplab_lcp::friction::Model;
use lcplab_mechanics::scene::{Scene, Scheme};
use lcplab_mechanics::simulation::{Departure, Simulation};
use nalgebra::Vector3;
use rayon::prelude::*;

use super::simulation;

/// The width, depth and height of the columns (m), their direction (degrees from the x axis), and
/// whether the ground is a box that the file lists last instead of a plane that it lists first.
const COLUMNS: [([f64; 3], f64, bool); 4] = [
    ([0.2, 0.3, 1.0], 0.0, false),
    ([1.0, 1.0, 2.0], 37.0, true),
    ([0.02, 0.05, 0.1], 90.0, true),
    ([5.0, 4.0, 12.0], -128.0, false),
];

/// The schemes whose contacts neither give way nor are left half solved.
const RIGID: [Scheme; 5] = [
    Scheme::Velocity,
    Scheme::Acceleration,
    Scheme::SplitImpulse,
    Scheme::GaussSeidel,
    Scheme::Xpbd,
];

/// A column of 3 kg with this center, inclined by an angle (rad) towards a direction (degrees).
fn column(
    [w, d, h]: [f64; 3],
    direction: f64,
    is_last: bool,
    scheme: Scheme,
    [center, incline]: [Vector3<f64>; 2],
) -> Scene {
    let turned = |v: Vector3<f64>| {
        nalgebra::Rotation3::from_axis_angle(&Vector3::z_axis(), direction.to_radians()) * v
    };
    let q = nalgebra::UnitQuaternion::from_scaled_axis(turned(incline))
        * nalgebra::UnitQuaternion::from_axis_angle(&Vector3::z_axis(), direction.to_radians());
    let p = turned(center);
    let ground = match is_last {
        true => "shape = { box = [90, 90, 1] }\nposition = [0, 0, -0.5]",
        false => "shape = { plane = [0, 0, 1] }",
    };
    let ground = format!("[[bodies]]\nname = \"ground\"\nfixed = true\n{ground}\n");
    let own = format!(
        "[[bodies]]\nname = \"column\"\nmass = 3\nshape = {{ box = [{w}, {d}, {h}] }}\n\
         position = [{}, {}, {}]\nrotation = {{ quaternion = [{}, {}, {}, {}] }}\n",
        p.x, p.y, p.z, q.w, q.i, q.j, q.k
    );
    let settings = format!(
        "contact.friction = 1.5\n[step]\ndt = {}\nscheme = \"{}\"\n",
        0.01 * h.sqrt(),
        scheme.name()
    );
    let bodies = if is_last { own + &ground } else { ground + &own };
    Scene::from_toml("column.toml", &(settings + &bodies)).unwrap()
}

/// A column upright on a slope, tan α = `part` w/h, which descends in its direction.
fn on_slope((size, direction, is_last): ([f64; 3], f64, bool), part: f64, scheme: Scheme) -> Scene {
    let [w, _, h] = size;
    let upright = [Vector3::z() * (h / 2.0), Vector3::zeros()];
    let mut scene = column(size, direction, is_last, scheme, upright);
    let (sin, cos) = (part * w / h).atan().sin_cos();
    let (y, x) = direction.to_radians().sin_cos();
    scene.gravity = 9.81 * Vector3::new(sin * x, sin * y, -cos);
    scene
}

/// A column that leans on one edge, inclined by `part` of the angle arctan(w/h) at which its center
/// of mass is above the edge.
fn on_edge((size, direction, is_last): ([f64; 3], f64, bool), part: f64, scheme: Scheme) -> Scene {
    let [w, _, h] = size;
    let angle = part * (w / h).atan();
    let (sin, cos) = angle.sin_cos();
    let center = 0.5 * Vector3::new(h * sin - w * cos, 0.0, w * sin + h * cos);
    column(size, direction, is_last, scheme, [center, Vector3::y() * angle])
}

/// The simulation after a time of `count` √(h/1 m)/100 s.
fn after(scene: &Scene, count: usize) -> Simulation {
    let mut running = simulation(scene.clone());
    for _ in 0..count {
        running.step().unwrap();
    }
    running
}

/// How far the column is inclined (rad).
fn inclined(running: &Simulation) -> f64 {
    let column = running.scene().body("column").unwrap();
    let up = running.states()[column].pose.q * Vector3::z();
    up.z.clamp(-1.0, 1.0).acos()
}

/// All columns with all these schemes, within 2 % of the limit and above it.
fn every(schemes: &[Scheme], check: impl Fn(([f64; 3], f64, bool), Scheme, f64) + Sync) {
    let cases: Vec<_> = COLUMNS
        .into_iter()
        .flat_map(|column| schemes.iter().map(move |scheme| (column, *scheme)))
        .flat_map(|(column, scheme)| [0.98, 1.02].map(|part| (column, scheme, part)))
        .collect();
    cases.par_iter().for_each(|&(column, scheme, part)| check(column, scheme, part));
}

#[test]
fn a_column_on_a_slope_stands_below_its_limit_and_falls_above_it() {
    every(&RIGID, |column, scheme, part| {
        let running = after(&on_slope(column, part, scheme), 400);
        let angle = inclined(&running);
        let what = format!("{scheme:?}, {column:?}, {part}: {angle}");
        assert_eq!(angle > 0.3, part > 1.0, "{what}");
        assert!(part > 1.0 || angle < 1e-3, "{what}");
    });
}

#[test]
fn a_column_on_its_edge_falls_back_below_its_limit_and_over_above_it() {
    every(&Scheme::ALL, |column, scheme, part| {
        let running = after(&on_edge(column, part, scheme), 300);
        let (angle, limit) = (inclined(&running), (column.0[0] / column.0[2]).atan());
        assert_eq!(angle > 2.0 * limit, part > 1.0, "{scheme:?}, {column:?}, {part}: {angle}");
    });
}

#[test]
fn a_column_that_falls_although_it_can_stand_is_named() {
    // Springs incline it until it falls, and 20 sweeps do not balance the forces.
    let schemes = [Scheme::Soft, Scheme::Penalty, Scheme::SequentialImpulses];
    let fell = std::sync::atomic::AtomicUsize::new(0);
    every(&schemes, |column, scheme, part| {
        let scene = on_slope(column, part, scheme);
        let running = after(&scene, 400);
        let departure = Departure::of(&scene, running.states());
        let angle = inclined(&running);
        let what = format!("{scheme:?}, {column:?}, {part}: {angle}, {departure:?}");
        match part > 1.0 {
            true => assert!(angle > 0.3 && departure.is_none(), "{what}"),
            false if angle > 0.3 => {
                fell.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                let own = departure.expect(&what);
                assert_eq!(own.body, scene.body("column").unwrap(), "{what}");
                assert!(own.angle > 0.3, "{what}");
            }
            // The friction of the penalty method is a damper: upright columns slide down.
            false if scheme == Scheme::Penalty => {
                assert!(departure.is_some_and(|own| own.distance > 0.05), "{what}");
            }
            false => assert!(angle > 0.01 || departure.is_none(), "{what}"),
        }
    });
    assert!(fell.into_inner() > 0, "no column falls: nothing was tested");
}

#[test]
fn a_column_at_its_very_limit_may_fall() {
    // It is on the limit but for rounding and for the tolerance of a friction model.
    every(&[Scheme::Velocity, Scheme::Soft], |column, scheme, _| {
        for placed in [on_slope, on_edge] {
            for reserve in [1e-5, 3e-6, 0.0, -1e-6] {
                let scene = placed(column, 1.0 - reserve, scheme);
                let mut states = scene.states.clone();
                states.last_mut().unwrap().pose.p.x += 0.2;
                assert_eq!(Departure::of(&scene, &states), None, "{column:?}, {reserve}");
            }
        }
    });
}

#[test]
fn what_no_force_holds_may_leave_its_rest() {
    // A ball on a level floor rolls, and a bob above its pivot falls: no force stops a small push.
    let floor = "[[bodies]]\nname = \"floor\"\nfixed = true\nshape = { plane = [0, 0, 1] }\n";
    let ball = "[[bodies]]\nname = \"ball\"\nmass = 1\nshape = { sphere = 0.1 }\n\
                position = [0, 0, 0.1]\n";
    let bob = "[[bodies]]\nname = \"bob\"\nmass = 1\nshape = \"point\"\nposition = [0, 0, 1]\n\
               [[constraints]]\nkind = \"distance\"\nbodies = [\"bob\"]\n\
               points = [[0, 0, 0], [0, 0, 1]]\n";
    let block = "[[bodies]]\nname = \"block\"\nmass = 1\nshape = { box = [1, 1, 1] }\n\
                 position = [0, 0, 0.5]\n";
    for (text, is_held) in [
        (format!("contact.friction = 0.5\n{floor}{ball}"), false),
        (bob.to_string(), false),
        (format!("contact.friction = 0.5\n{floor}{block}"), true),
        (format!("{floor}{block}"), false), // without friction
        // The correction of an overlap moves a body.
        (format!("contact.friction = 0.5\n{floor}{}", block.replace("0.5]", "0.4]")), false),
    ] {
        let scene = Scene::from_toml("rest.toml", &text).unwrap();
        let mut states = scene.states.clone();
        states.last_mut().unwrap().pose.p.x += 0.2;
        assert_eq!(Departure::of(&scene, &states).is_some(), is_held, "{text}");
    }
}

#[test]
fn a_block_that_creeps_below_the_threshold_of_the_cone_is_named_and_one_that_rests_is_not() {
    // Between its corners a polygon of eight holds up to cos 22.5° = 0.924 of μ.
    for (model, part, moves) in [
        (Model::Polyhedral { directions: 8 }, 0.97, true),
        (Model::Polyhedral { directions: 8 }, 0.9, false),
        (Model::Polyhedral { directions: 16 }, 0.97, false),
        (Model::CoulombCone, 0.97, false),
    ] {
        let text = "contact.friction = 0.5\n[[bodies]]\nname = \"ground\"\nfixed = true\n\
                    shape = { plane = [0, 0, 1] }\n[[bodies]]\nname = \"block\"\nmass = 2\n\
                    shape = { box = [0.4, 0.4, 0.1] }\nposition = [0, 0, 0.05]\n\
                    rotation = { z = 22.5 }\n";
        let mut scene = Scene::from_toml("slope.toml", text).unwrap();
        scene.contact.model = model;
        let (sin, cos) = (part * 0.5_f64).atan().sin_cos();
        let (y, x) = 22.5_f64.to_radians().sin_cos();
        scene.gravity = 9.81 * Vector3::new(sin * x, sin * y, -cos);
        let running = after(&scene, 50);
        let departure = Departure::of(&scene, running.states());
        assert_eq!(departure.is_some(), moves, "{model}, {part}: {departure:?}");
    }
}
