//! Pictures of scenes: lengths, order and visibility as geometry has them.

use lcplab::simulation;
use std::ops::ControlFlow;

use lcplab::animation::{Camera, Frame, Origin, Strip, View, instants};
use lcplab::plot::Figure;
use lcplab::scene::Scene;
use lcplab::simulation::Simulation;
use nalgebra::{UnitQuaternion, Vector3};

use super::well_formed::assert_well_formed;

const GRAVITY: f64 = 9.81;

fn scene(bodies: &str) -> Scene {
    Scene::from_toml("test.toml", &format!("title = \"Test\"\n{bodies}")).unwrap()
}

fn body(name: &str, shape: &str, position: [f64; 3]) -> String {
    format!(
        "[[bodies]]\nname = {name:?}\nshape = {{ {shape} }}\nmass = 1\nposition = {position:?}\n"
    )
}

fn strip(scene: &Scene, view: View) -> Strip {
    Strip { view, ..Strip::new(scene, vec![Frame::start(scene)]) }
}

/// The frames after some steps of a scene's own simulation.
fn run(scene: &Scene, steps: usize) -> Vec<Frame> {
    let mut frames = vec![Frame::start(scene)];
    let mut simulation = Simulation::new(scene.clone(), simulation::solver(scene).unwrap());
    simulation.run(steps, |step| {
        frames.push(Frame::after(scene, step));
        ControlFlow::Continue(())
    });
    frames
}

/// Tenths of a px for a metre, as the scale bar says.
fn scale(svg: &str) -> f64 {
    let bar = svg.split("class=\"scale\"").nth(1).unwrap();
    let px = bar.split("-4h").nth(1).unwrap().split('m').next().unwrap();
    let label = bar.split("<text").nth(1).unwrap().split('>').nth(1).unwrap();
    let metres: f64 = label.split(" m<").next().unwrap().parse().unwrap();
    10.0 * px.parse::<f64>().unwrap() / metres
}

/// The drawing of the first instant, without its border.
fn drawing(svg: &str) -> Vec<&str> {
    let frame = svg.split("class=\"instant\"").nth(1).unwrap().split("</g>").next().unwrap();
    frame.lines().skip(2).collect()
}

/// The sides of the faces: closed paths with an outline.
fn faces<'a>(lines: &[&'a str]) -> Vec<Vec<(f64, f64)>> {
    let face = |line: &'a str| -> Option<Vec<(f64, f64)>> {
        let course =
            line.strip_prefix("<path fill=\"#")?.split("d=\"").nth(1)?.split('z').next()?;
        let sides: Vec<_> = course
            .split('l')
            .skip(1)
            .map(|side| side.split_once(' ').unwrap())
            .map(|(x, y)| (x.parse().unwrap(), y.parse().unwrap()))
            .collect();
        let (x, y) = sides.iter().fold((0.0, 0.0), |(x, y), (dx, dy)| (x - dx, y - dy));
        Some(sides.into_iter().chain([(x, y)]).collect())
    };
    lines.iter().filter_map(|line| face(line)).collect()
}

fn radius(line: &str) -> Option<f64> {
    line.strip_prefix("<circle")?.split(" r=\"").nth(1)?.split('"').next()?.parse().ok()
}

#[test]
fn a_unit_cube_from_the_front_is_a_square_of_the_scale_s_length() {
    let scene = scene(&body("cube", "box = [1, 1, 1]", [3.0, -2.0, 5.0]));
    let svg = strip(&scene, View::Front).svg();
    let (metre, faces) = (scale(&svg), faces(&drawing(&svg)));
    assert_eq!(faces.len(), 1);
    assert_eq!(faces[0].len(), 4);
    for (x, y) in &faces[0] {
        assert!(x * y == 0.0 && ((x + y).abs() - metre).abs() <= 1.0, "({x}, {y}), {metre}");
    }
}

#[test]
fn a_cube_from_three_quarters_shows_three_faces_whose_opposite_sides_are_parallel() {
    let scene = scene(&body("cube", "box = [1, 1, 1]", [0.0, 0.0, 0.0]));
    let faces = faces(&drawing(&strip(&scene, View::ThreeQuarter).svg()));
    assert_eq!(faces.len(), 3);
    for sides in faces {
        for (a, b) in [(sides[0], sides[2]), (sides[1], sides[3])] {
            assert!((a.0 + b.0).abs() <= 2.0 && (a.1 + b.1).abs() <= 2.0, "{sides:?}");
        }
    }
}

#[test]
fn the_camera_turns_and_does_not_stretch() {
    for view in [View::Front, View::ThreeQuarter] {
        let camera = Camera::new(view);
        let axes = [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| camera.project(&axis));
        for (i, a) in axes.iter().enumerate() {
            for (j, b) in axes.iter().enumerate() {
                assert!((a.dot(b) - f64::from(u8::from(i == j))).abs() < 1e-15);
            }
        }
        let volume = axes[0].cross(&axes[1]).dot(&axes[2]);
        assert!((volume - 1.0).abs() < 1e-15, "not a mirror image");
        assert!(axes[2].x == 0.0 && axes[2].y > 0.0, "z is up");
    }
}

#[test]
fn a_ball_s_outline_has_its_radius() {
    let ball =
        |radius: f64, x| body(&format!("b{x}"), &format!("sphere = {radius}"), [x, 0.0, 0.0]);
    let scene = scene(&(ball(0.5, 0.0) + &ball(0.25, 2.0)));
    for view in [View::Front, View::ThreeQuarter] {
        let svg = strip(&scene, view).svg();
        let radii: Vec<f64> = drawing(&svg).into_iter().filter_map(radius).collect();
        for expected in [0.5, 0.25].map(|r| r * scale(&svg)) {
            assert!(radii.iter().any(|r| (r - expected).abs() <= 0.6), "{expected}: {radii:?}");
        }
    }
}

#[test]
fn the_nearer_ball_is_painted_later_in_any_order_of_the_bodies() {
    let near = body("near", "sphere = 0.5", [0.0, -2.0, 0.0]);
    let far = body("far", "sphere = 1", [0.0, 2.0, 0.0]);
    for bodies in [near.clone() + &far, far + &near] {
        let svg = strip(&scene(&bodies), View::Front).svg();
        let metre = scale(&svg);
        let radii: Vec<f64> = drawing(&svg).into_iter().filter_map(radius).collect();
        let is = |r: f64, radius: f64| (r - radius * metre).abs() <= 0.6;
        let near = radii.iter().position(|r| is(*r, 0.5)).unwrap();
        let far = radii.iter().rposition(|r| is(*r, 1.0)).unwrap();
        assert!(far < near, "{radii:?}");
    }
}

#[test]
fn a_floor_whose_middle_is_nearer_than_the_ball_on_it_is_painted_before() {
    let floor = body("floor", "box = [4, 8, 0.5]", [0.0, -3.0, -0.25]);
    let ball = body("ball", "sphere = 0.5", [0.0, 0.5, 0.5]);
    for bodies in [floor.clone() + &ball, ball + &floor] {
        let svg = strip(&scene(&bodies), View::ThreeQuarter).svg();
        let lines = drawing(&svg);
        let ball = lines.iter().position(|line| radius(line).is_some()).unwrap();
        assert_eq!(faces(&lines[..ball]).len(), 3);
        assert!(faces(&lines[ball..]).is_empty());
    }
}

#[test]
fn of_a_block_of_27_cubes_the_27_outer_faces_are_written() {
    let at = |k: usize| [k % 3, k / 3 % 3, k / 9].map(|i| i as f64);
    let cubes: String = (0..27).map(|k| body(&format!("c{k}"), "box = [1, 1, 1]", at(k))).collect();
    let svg = strip(&scene(&cubes), View::ThreeQuarter).svg();
    assert_eq!(faces(&drawing(&svg)).len(), 3 * 9);
}

#[test]
fn a_ball_tipped_towards_the_viewer_shows_its_equator_sag() {
    let scene = scene(&body("ball", "sphere = 1", [0.0; 3]));
    let mut strip = strip(&scene, View::Front);
    let tip = UnitQuaternion::from_axis_angle(&Vector3::x_axis(), 30f64.to_radians());
    strip.frames[0].states[0].pose.q = tip;
    let svg = strip.svg();
    let r = scale(&svg);
    let arcs = svg.split('A').skip(1).filter_map(|arc| {
        let numbers: Vec<f64> =
            arc.split(['M', '"']).next()?.split(' ').map_while(|x| x.parse().ok()).collect();
        (numbers.len() == 7).then_some(numbers)
    });
    // The equator is seen as half an ellipse, r by r sin 30°; counter-clockwise from left to right
    // is below.
    let close = |a: f64, b: f64| (a - b).abs() <= 1.0;
    let equator = |arc: &Vec<f64>| close(arc[0], r) && close(arc[1], r / 2.0) && arc[4] == 0.0;
    assert!(arcs.into_iter().any(|arc| equator(&arc)), "{svg}");
}

#[test]
fn a_planar_motion_is_seen_from_the_front_and_any_other_from_three_quarters() {
    for name in ["pendulum", "double_pendulum", "stack", "incline"] {
        let scene = Scene::load(name).unwrap();
        assert_eq!(View::of(&scene, &run(&scene, 10)), View::Front, "{name}");
    }
    let net = Scene::load("net").unwrap();
    assert_eq!(View::of(&net, &[]), View::ThreeQuarter);
    let spin = body("box", "box = [1, 1, 1]", [0.0; 3]) + "angular_velocity = [0, 0, 1]\n";
    let spin = scene(&spin);
    assert_eq!(View::of(&spin, &run(&spin, 5)), View::ThreeQuarter);
}

#[test]
fn the_ground_carries_a_ball_with_its_weight() {
    let scene = Scene::load("sphere_plane").unwrap();
    let frames = run(&scene, 3);
    let force = frames[3].forces.iter().find(|force| force.origin == Origin::Normal).unwrap();
    assert!((force.force - Vector3::z() * GRAVITY).norm() < 1e-6, "{force:?}"); // 1 kg
    assert!(force.point.norm() < 1e-9, "{force:?}");
    let svg = Strip::new(&scene, frames).with_forces().svg();
    assert!(svg.contains(">normal ") && !svg.contains(">constraint "));
}

#[test]
fn a_rod_holds_a_hanging_bob_with_its_weight_whichever_end_is_named_first() {
    let bob = body("bob", "sphere = 0.1", [0.0, 0.0, -1.0]);
    let held = "[[bodies]]\nname = \"hook\"\nfixed = true\nshape = \"point\"\n";
    for bodies in ["[\"hook\", \"bob\"]", "[\"bob\", \"hook\"]"] {
        let rod = format!("[[constraints]]\nkind = \"distance\"\nbodies = {bodies}\n");
        let scene = scene(&(bob.clone() + held + &rod));
        let frames = run(&scene, 2);
        let force = frames[2].forces[0];
        assert_eq!(force.origin, Origin::Constraint);
        assert!((force.force - Vector3::z() * GRAVITY).norm() < 1e-6, "{force:?}");
        assert!((force.point + Vector3::z()).norm() < 1e-6, "{force:?}");
    }
}

#[test]
fn every_shipped_scene_has_a_picture() {
    for shipped in lcplab::scene::catalogue::SHIPPED {
        let scene = shipped.scene().unwrap();
        let frames = vec![Frame::start(&scene); 2];
        let strip = Strip::new(&scene, frames).with_forces();
        assert_well_formed(&strip);
        assert_eq!(strip.svg().matches("class=\"instant\"").count(), 2);
        assert_eq!(strip.csv().lines().count(), 1 + 2 * scene.bodies.len());
    }
}

#[test]
fn a_tower_of_700_cubes_stays_below_two_megabytes() {
    let cube = |k: usize| {
        let (layer, turn) = (k / 20, (k % 20) as f64 + 0.5 * (k / 20 % 2) as f64);
        let angle = turn * std::f64::consts::TAU / 20.0;
        let at = [3.3 * angle.cos(), 3.3 * angle.sin(), 0.45 + 0.9 * layer as f64];
        let turned = format!("rotation = {{ z = {} }}\n", angle.to_degrees());
        body(&format!("c{k}"), "box = [0.9, 0.9, 0.9]", at) + &turned
    };
    let scene = scene(&(0..700).map(cube).collect::<String>());
    let svg = Strip::new(&scene, vec![Frame::start(&scene); 6]).svg();
    assert!(svg.len() < 2_000_000, "{} bytes", svg.len());
}

#[test]
fn motions_that_blow_up_are_drawn_as_far_as_they_can_be() {
    let scene = Scene::load("pendulum").unwrap();
    for far in [1e3, 1e9, 1e300, f64::INFINITY, f64::NAN] {
        let mut frames = vec![Frame::start(&scene); 2];
        frames[1].states[0].pose.p.x = far;
        let strip = Strip::new(&scene, frames).with_forces();
        assert_well_formed(&strip);
        let shown = if far.is_finite() { 2 } else { 1 };
        assert_eq!(strip.svg().matches("class=\"instant\"").count(), shown);
    }
    assert_well_formed(&Strip::new(&scene, Vec::new()));
    assert_well_formed(&strip(&self::scene(""), View::Front));
}

#[test]
fn instants_are_spread_evenly_from_the_start_to_the_end() {
    for (steps, frames) in [(100, 6), (7, 3), (1, 2), (0, 6), (5, 60), (500, 8)] {
        let instants = instants(steps, frames);
        assert_eq!((instants[0], *instants.last().unwrap()), (0, steps));
        assert_eq!(instants.len(), frames.min(steps + 1));
        let gaps: Vec<usize> = instants.windows(2).map(|pair| pair[1] - pair[0]).collect();
        let (least, most) = (gaps.iter().min(), gaps.iter().max());
        assert!(least.zip(most).is_none_or(|(least, most)| most - least <= 1), "{gaps:?}");
    }
}

#[test]
fn where_color_says_how_much_a_body_is_red_from_gray_and_the_ground_stays() {
    let ground = "[[bodies]]\nname = \"ground\"\nfixed = true\nshape = { sphere = 1 }\nposition = [0, 0, 3]\n";
    let text = ground.to_string()
        + &body("cool", "sphere = 1", [0.0, 0.0, 0.0])
        + &body("hot", "sphere = 1", [0.0, 0.0, 6.0]);
    let scene = scene(&text);
    let colors = |heat: Vec<f64>| -> Vec<[f64; 3]> {
        let strip = Strip::new(&scene, vec![Frame::start(&scene).heated(heat)]);
        let svg = strip.svg();
        let discs = drawing(&svg).into_iter().filter(|line| line.starts_with("<circle"));
        let filled = discs.filter_map(|line| line.split("fill=\"#").nth(1));
        let channel =
            |hex: &str, k: usize| f64::from(u8::from_str_radix(&hex[k..k + 2], 16).unwrap());
        filled.map(|hex| [0, 2, 4].map(|k| channel(hex, k))).collect()
    };
    let is_red = |[r, g, b]: &[f64; 3]| *r > 1.7 * g.max(*b);
    let gray = |[r, g, b]: &[f64; 3]| r.max(*g).max(*b) - r.min(*g).min(*b) < 16.0;
    let (cool, hot) = (colors(vec![0.0, 0.0, 0.0]), colors(vec![1.0, 0.0, 1.0]));
    assert!(cool.len() == hot.len() && cool.iter().all(gray), "{cool:?}");
    // Of three balls one is red: the fixed one stays as it is.
    assert_eq!(3 * hot.iter().filter(|color| is_red(color)).count(), hot.len(), "{hot:?}");
}

#[test]
fn contacts_push_the_upper_body_up_whichever_of_the_two_is_named_first() {
    let lower = body("lower", "box = [1, 1, 1]", [0.0, 0.0, 0.5]);
    let upper = body("upper", "box = [1, 1, 1]", [0.0, 0.0, 1.5]);
    let floor = "[[bodies]]\nname = \"floor\"\nfixed = true\nshape = { plane = [0, 0, 1] }\n";
    for order in [lower.clone() + &upper, upper + &lower] {
        let scene = scene(&(floor.to_string() + &order));
        let frames = run(&scene, 3);
        let normals = || frames[3].forces.iter().filter(|force| force.origin == Origin::Normal);
        assert!(normals().all(|force| force.force.z > 0.0), "{:?}", frames[3].forces);
        // The ground carries both, the lower box the upper one: 1 kg each.
        let sum: f64 = normals().map(|force| force.force.z).sum();
        assert!((sum - 3.0 * GRAVITY).abs() < 1e-6, "{sum}");
    }
}
