//! Scenes in which nothing is wrong: no cause may be reported, for any forces and schemes.

use lcplab_analysis::diagnosis::unsupported::{Examination, HEALTHY, examine_scene};
use lcplab_mechanics::constraint::ALL;
use lcplab_mechanics::scene::Scene;

const GROUND: &str = "[[bodies]]\nname = \"ground\"\nfixed = true\nshape = { plane = [0, 0, 1] }\n";

/// A wall whose face is at x = 0.6.
const WALL: &str = "[[bodies]]\nname = \"wall\"\nfixed = true\nshape = { box = [0.2, 4, 4] }\nposition = [0.7, 0, 0]\n";

/// Without gravity.
const WEIGHTLESS: &str = "gravity = [0, 0, 0]\n";

/// The settings for a number of steps of this length (s).
fn steps(dt: f64, count: usize, more: &str) -> String {
    format!("[step]\ndt = {dt}\ncount = {count}\n{more}\n")
}

fn cube(name: &str, size: f64, mass: f64, position: [f64; 3], more: &str) -> String {
    format!(
        "[[bodies]]\nname = {name:?}\nshape = {{ box = [{size}, {size}, {size}] }}\nmass = {mass}\n\
         position = {position:?}\n{more}\n"
    )
}

fn joint(kind: &str, bodies: &[&str], more: &str) -> String {
    format!("[[constraints]]\nkind = {kind:?}\nbodies = {bodies:?}\n{more}\n")
}

/// A tower of cubes with these masses, the lowest first.
fn tower(masses: &[f64]) -> String {
    let cubes = masses
        .iter()
        .enumerate()
        .map(|(k, &mass)| cube(&format!("box{k}"), 1.0, mass, [0.0, 0.0, 0.5 + k as f64], ""));
    GROUND.to_string() + &cubes.collect::<String>()
}

/// A block on a rail along x that a motor presses against an obstacle.
fn pressed(effort: f64) -> String {
    cube("block", 1.0, 1.0, [0.0, 0.0, 0.0], "")
        + &joint("slider", &["block"], "axis = [1, 0, 0]")
        + &joint(
            "motor_translation",
            &["block"],
            &format!("axis = [1, 0, 0]\nspeed = 1\neffort = {effort}"),
        )
}

/// An arm on a hinge that a motor turns against a stop.
fn stopped(effort: f64) -> String {
    cube("arm", 0.4, 1.0, [0.5, 0.0, 0.0], "")
        + &joint("hinge", &["arm"], "axis = [0, 1, 0]\npoint = [0, 0, 0]")
        + &joint("limit_rotation", &["arm"], "axis = [0, 1, 0]\nlimits = [-0.05, 0.05]")
        + &joint(
            "motor_rotation",
            &["arm"],
            &format!("axis = [0, 1, 0]\nspeed = 1\neffort = {effort}"),
        )
}

/// Two arms on one body that motors press against each other.
fn opposed(effort: f64) -> String {
    let arm = |name: &str, x: f64| {
        cube(name, 0.3, 1.0, [x, 0.0, 0.8], "")
            + &joint("hinge", &["base", name], &format!("axis = [0, 1, 0]\npoint = [{x}, 0, 0.3]"))
            + &joint(
                "motor_rotation",
                &["base", name],
                &format!("axis = [0, 1, 0]\nspeed = {}\neffort = {effort}", -2.0 * x.signum()),
            )
    };
    cube("base", 0.5, 5.0, [0.0, 0.0, 0.0], "") + &arm("left", -0.2) + &arm("right", 0.2)
}

/// Four bars on four hinges: a closed loop, in which forces can be shared in many ways.
fn four_bars() -> String {
    let bar = |name: &str, x: f64, z: f64| cube(name, 0.2, 1.0, [x, 0.0, z], "");
    let hinge = |pair: &[&str], x: f64, z: f64| {
        joint("hinge", pair, &format!("axis = [0, 1, 0]\npoint = [{x}, 0, {z}]"))
    };
    bar("a", 0.0, 0.5)
        + &bar("b", 0.5, 1.0)
        + &bar("c", 1.0, 0.5)
        + &hinge(&["a"], 0.0, 0.0)
        + &hinge(&["a", "b"], 0.0, 1.0)
        + &hinge(&["b", "c"], 1.0, 1.0)
        + &hinge(&["c"], 1.0, 0.0)
}

/// A body that hangs from each kind of joint, next to or below the point (0, 0, 1), with
/// constraints for the remaining degrees of freedom.
fn hanging() -> Vec<(String, String)> {
    let (post, across, along) = ("point = [0, 0, 1]\n", "axis = [0, 1, 0]\n", "axis = [1, 0, 0]\n");
    let nail = || joint("nail", &["body"], post);
    let fields = |kind: &str| match kind {
        "orientation" => (nail(), String::new()),
        "lock_translation" => (String::new(), "axis = [0, 0, 1]".into()),
        "lock_rotation" => (nail(), across.into()),
        "hinge" | "slider" | "cylindrical" => (String::new(), format!("{post}{along}")),
        "universal" => (String::new(), format!("{post}axes = [[1, 0, 0], [0, 0, 1]]")),
        "distance" | "squared_distance" | "rope" => {
            (String::new(), "points = [[0, 0, 1], [0.4, 0, 1]]".into())
        }
        "spring" => (
            String::new(),
            "points = [[0, 0, 2], [0.4, 0, 1]]\nstiffness = 500\ndamping = 5".into(),
        ),
        "spring_rotation" => (nail(), format!("{across}stiffness = 200\ndamping = 2")),
        "limit_translation" => (
            joint("slider", &["body"], "axis = [0, 0, 1]"),
            "axis = [0, 0, 1]\nlimits = [-0.01, 0.01]".into(),
        ),
        "limit_rotation" => (
            joint("hinge", &["body"], &format!("{post}{across}")),
            format!("{across}limits = [-0.02, 0.02]"),
        ),
        "limit_cone" => (nail(), format!("{along}angle = 0.05")),
        "motor_translation" => (
            joint("slider", &["body"], "axis = [0, 0, 1]"),
            "axis = [0, 0, 1]\nspeed = 0\neffort = 100".into(),
        ),
        "motor_rotation" => (
            joint("hinge", &["body"], &format!("{post}{across}")),
            format!("{across}speed = 0\neffort = 100"),
        ),
        _ => (String::new(), post.into()),
    };
    let pairs = ["ball", "gear", "rack", "pulley"];
    let kinds = ALL.iter().map(|joint| joint.name).filter(|kind| !pairs.contains(kind));
    let hung = kinds.map(|kind| {
        let (help, fields) = fields(kind);
        let text = steps(0.01, 30, "")
            + &cube("body", 0.2, 2.0, [0.4, 0.0, 1.0], "")
            + &help
            + &joint(kind, &["body"], &fields);
        (format!("a body on a {kind}"), text)
    });
    hung.collect()
}

/// Two wheels and the joint between them.
fn wheels(kind: &str, fields: &str) -> String {
    let wheel = |name: &str, x: f64| {
        cube(name, 0.3, 1.0, [x, 0.0, 0.0], "")
            + &joint("hinge", &[name], &format!("axis = [0, 0, 1]\npoint = [{x}, 0, 0]"))
    };
    let motor = joint("motor_rotation", &["one"], "axis = [0, 0, 1]\nspeed = 3\neffort = 1");
    wheel("one", 0.0) + &wheel("other", 1.0) + &motor + &joint(kind, &["one", "other"], fields)
}

fn kinds() -> Vec<(String, String)> {
    let usual = || steps(0.01, 30, "");
    let beta = || steps(0.01, 30, "baumgarte = 0.2");
    let by = |scheme: &str| steps(0.01, 30, &format!("scheme = {scheme:?}"));
    let mut all: Vec<(String, String)> = hanging();
    let mut add = |name: &str, text: String| all.push((name.into(), text));
    for effort in [10.0, 1e3, 1e12] {
        add(
            &format!("a motor of {effort} N presses a block against a wall, no gravity"),
            WEIGHTLESS.to_string() + &usual() + WALL + &pressed(effort),
        );
        add(&format!("an arm against a stop, {effort} N m"), usual() + &stopped(effort));
        add(
            &format!("an arm against a stop, {effort} N m, no gravity"),
            WEIGHTLESS.to_string() + &beta() + &stopped(effort),
        );
        add(
            &format!("two motors of {effort} N m against each other"),
            WEIGHTLESS.to_string() + &steps(0.0166666, 60, "") + &opposed(effort),
        );
    }
    add("a motor presses a block against a wall", usual() + WALL + &pressed(10.0));
    add(
        "a motor presses a block against a wall, acceleration",
        WEIGHTLESS.to_string() + &by("acceleration") + WALL + &pressed(10.0),
    );
    add(
        "a block held between two motors",
        WEIGHTLESS.to_string()
            + &usual()
            + &pressed(10.0)
            + &joint("motor_translation", &["block"], "axis = [1, 0, 0]\nspeed = -1\neffort = 10"),
    );
    add(
        "a force presses a cube against a wall",
        WEIGHTLESS.to_string()
            + &usual()
            + WALL
            + &cube("cube", 1.0, 1.0, [0.1, 0.0, 0.0], "force = [5, 0, 0]"),
    );
    add(
        "a spring presses a cube against a wall",
        WEIGHTLESS.to_string()
            + &usual()
            + WALL
            + &cube("cube", 1.0, 1.0, [0.1, 0.0, 0.0], "")
            + &joint(
                "spring",
                &["cube"],
                "points = [[-2, 0, 0], [0.1, 0, 0]]\nlength = 3\nstiffness = 1000",
            ),
    );
    add(
        "a stiff spring presses a cube against a wall",
        WEIGHTLESS.to_string()
            + &usual()
            + WALL
            + &cube("cube", 1.0, 1.0, [0.1, 0.0, 0.0], "")
            + &joint(
                "spring",
                &["cube"],
                "points = [[-2, 0, 0], [0.1, 0, 0]]\nlength = 2.101\nstiffness = 1e9",
            ),
    );
    add(
        "two stretched springs pull a cube apart",
        WEIGHTLESS.to_string()
            + &usual()
            + &cube("cube", 1.0, 1.0, [0.0, 0.0, 0.0], "")
            + &joint(
                "spring",
                &["cube"],
                "points = [[-2, 0, 0], [0, 0, 0]]\nlength = 1\nstiffness = 1e4",
            )
            + &joint(
                "spring",
                &["cube"],
                "points = [[2, 0, 0], [0, 0, 0]]\nlength = 1\nstiffness = 1e4",
            ),
    );
    add("four bars, no gravity", WEIGHTLESS.to_string() + &beta() + &four_bars());
    add("four bars", usual() + &four_bars());
    add("four bars, acceleration", by("acceleration") + &four_bars());
    add(
        "a cube that drifts, no gravity",
        WEIGHTLESS.to_string()
            + &usual()
            + &cube("cube", 1.0, 1.0, [0.0, 0.0, 0.0], "velocity = [1, 2, 0]"),
    );
    add(
        "a cube that spins, no gravity",
        WEIGHTLESS.to_string()
            + &usual()
            + &cube("cube", 1.0, 1.0, [0.0, 0.0, 0.0], "angular_velocity = [1, 2, 3]"),
    );
    add(
        "a pendulum at rest far away, no gravity",
        WEIGHTLESS.to_string()
            + &beta()
            + &cube("cube", 1.0, 1.0, [1000.1, 0.3, 0.0], "")
            + &joint("nail", &["cube"], "point = [1000.7, 0.1, 0.2]"),
    );
    add(
        "two cubes at rest in touch, no gravity",
        WEIGHTLESS.to_string()
            + &beta()
            + &cube("one", 1.0, 1.0, [0.0, 0.0, 0.0], "")
            + &cube("other", 1.0, 1.0, [1.0, 0.0, 0.0], ""),
    );
    add(
        "two cubes that meet, no gravity",
        WEIGHTLESS.to_string()
            + &usual()
            + &cube("one", 1.0, 1.0, [0.0, 0.0, 0.0], "velocity = [1, 0, 0]")
            + &cube("other", 1.0, 1.0, [1.05, 0.0, 0.0], ""),
    );
    add("a cube on the ground", beta() + &tower(&[1.0]));
    add("a cube that falls", usual() + GROUND + &cube("cube", 1.0, 1.0, [0.0, 0.0, 0.9], ""));
    add(
        "a cube that bounces",
        usual()
            + "[contact]\nrestitution = 0.5\n"
            + GROUND
            + &cube("cube", 1.0, 1.0, [0.0, 0.0, 0.7], ""),
    );
    add(
        "a cube that slides along one tangent",
        usual()
            + "[contact]\nfriction = 0.3\n"
            + GROUND
            + &cube("cube", 1.0, 1.0, [0.0, 0.0, 0.5], "velocity = [2, 0, 0]"),
    );
    add(
        "a cube that sticks on a slope",
        "tilt = { y = 15 }\n".to_string()
            + &usual()
            + "[contact]\nfriction = 0.6\n"
            + GROUND
            + &cube("cube", 1.0, 1.0, [0.0, 0.0, 0.5], ""),
    );
    add(
        "a cube on a belt",
        usual()
            + "[[bodies]]\nname = \"belt\"\nfixed = true\nshape = { box = [9, 4, 1] }\nposition = [0, 0, -0.5]\nvelocity = [1, 0, 0]\n"
            + &cube("cube", 1.0, 1.0, [0.0, 0.0, 0.5], ""),
    );
    add(
        "a ball that rolls",
        usual()
            + GROUND
            + "[[bodies]]\nname = \"ball\"\nshape = { sphere = 0.5 }\nmass = 1\nposition = [0, 0, 0.5]\nvelocity = [1, 0, 0]\n",
    );
    add(
        "a capsule on the ground",
        usual()
            + GROUND
            + "[[bodies]]\nname = \"capsule\"\nshape = { capsule = { length = 1, radius = 0.2 } }\nmass = 1\nposition = [0, 0, 0.2]\nrotation = { y = 90 }\n",
    );
    add(
        "a slab on three cubes",
        usual()
            + GROUND
            + &cube("c1", 0.4, 20.0, [-0.5, -0.5, 0.2], "")
            + &cube("c2", 0.4, 20.0, [0.5, -0.5, 0.2], "")
            + &cube("c3", 0.4, 20.0, [0.0, 0.5, 0.2], "")
            + "[[bodies]]\nname = \"slab\"\nshape = { box = [1.4, 1.4, 0.6] }\nmass = 100\nposition = [0, 0, 0.7]\n",
    );
    add("a tower", beta() + &tower(&[1.0; 5]));
    add("a tower with a heavy top", usual() + &tower(&[1.0, 1.0, 1.0, 1000.0]));
    add("a tower of crumbs", usual() + &tower(&[1e-6; 3]));
    add("a tower of rocks", usual() + &tower(&[1e7; 3]));
    for scheme in [
        "velocity",
        "acceleration",
        "split-impulse",
        "gauss-seidel",
        "sequential-impulses",
        "soft",
        "xpbd",
        "penalty",
    ] {
        add(&format!("two cubes, {scheme}"), by(scheme) + &tower(&[1.0; 2]));
    }
    for solver in ["lemke", "block-pivoting", "newton", "interior-point"] {
        add(
            &format!("three cubes by {solver}"),
            usual() + &format!("[solver]\nname = {solver:?}\n") + &tower(&[1.0; 3]),
        );
    }
    for solver in ["pgs", "apgd", "anderson-pgs"] {
        add(
            &format!("a cube by {solver}"),
            usual()
                + &format!("[solver]\nname = {solver:?}\nmax_iterations = 2000\n")
                + &tower(&[1.0; 1]),
        );
    }
    add(
        "a few sweeps of a pendulum at rest, no gravity",
        WEIGHTLESS.to_string()
            + &beta()
            + "[solver]\nname = \"pgs\"\nmax_iterations = 3\n"
            + &four_bars(),
    );
    add(
        "a cone of friction",
        usual() + "[contact]\nmodel = \"coulomb-cone\"\n" + &tower(&[1.0; 2]),
    );
    add(
        "wheels with teeth",
        WEIGHTLESS.to_string()
            + &usual()
            + &wheels("gear", "axes = [[0, 0, 1], [0, 0, 1]]\nteeth = [20, 40]"),
    );
    add(
        "a rope over a pulley",
        usual()
            + &cube("heavy", 0.3, 2.0, [-0.5, 0.0, 0.0], "")
            + &cube("light", 0.3, 1.0, [0.5, 0.0, 0.0], "")
            + &joint("pulley", &["heavy", "light"], "points = [[-0.5, 0, 2], [0.5, 0, 2]]"),
    );
    add(
        "a wheel and a rack",
        usual()
            + &cube("wheel", 0.3, 1.0, [0.0, 0.0, 0.0], "")
            + &joint("hinge", &["wheel"], "axis = [0, 1, 0]\npoint = [0, 0, 0]")
            + &cube("rod", 0.2, 1.0, [0.5, 0.0, 0.0], "")
            + &joint("slider", &["rod"], "axis = [0, 0, 1]")
            + &joint("rack", &["wheel", "rod"], "axes = [[0, 1, 0], [0, 0, 1]]\nlength = 0.5"),
    );
    all
}

fn examined(text: &str) -> Examination {
    let scene =
        Scene::from_toml("healthy.toml", text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    examine_scene(&scene, None).unwrap()
}

/// Exact answers of motors, stops, springs, joints of each kind, loops and piles, with and without
/// gravity, in every scheme.
#[test]
fn of_scenes_in_which_nothing_is_wrong_no_cause_is_named() {
    let kinds = kinds();
    assert!(kinds.len() >= 40);
    let mut accused = Vec::new();
    for (name, text) in &kinds {
        let found = examined(text);
        let is_short = found.unsupported.as_ref().is_some_and(|own| own.is_short())
            || found.notes.iter().any(|note| note.missing.is_some_and(|part| part > HEALTHY));
        if is_short || !found.causes().is_empty() || found.no_reference.is_some() {
            let part = found.unsupported.as_ref().map(|own| (own.missing, own.residual));
            accused.push(format!("{name}: {:?} {part:?} {:?}", found.causes(), found.no_reference));
        }
    }
    assert!(accused.is_empty(), "{accused:#?}");
}
