//! Scenes: motions, forces by body, and what must be said about them.

use super::*;

/// A box on a plane, on a slope by turning gravity by this angle, with the fields of the box.
fn block(angle: f64, mu: f64, mass: f64, steps: usize, more: &str) -> String {
    let (along, down) = (9.81 * angle.to_radians().sin(), 9.81 * angle.to_radians().cos());
    format!(
        "gravity = [{along}, 0, {}]\n[step]\ndt = 0.01\ncount = {steps}\n[contact]\nfriction = {mu}\n\
         [[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n\
         [[bodies]]\nname = \"block\"\nshape = {{ box = [1, 1, 0.4] }}\nmass = {mass}\nposition = [0, 0, 0.2]\n{more}",
        -down
    )
}

/// raisim#55: 1 kg with μ = ½ holds up to μ m g = 4.905 N; 4.906 N leave 0.001 m/s².
#[test]
fn a_block_holds_up_to_its_friction_limit() {
    let speed = |force: f64| {
        let scene = block(0.0, 0.5, 1.0, 100, &format!("force = [{force}, 0, 0]\n"));
        at_end(&simulated(&scene, &[]), "block", "velocity")[0]
    };
    assert_near(speed(4.9), 0.0, 1e-12);
    assert_near(speed(4.906), 0.001, 1e-9);
}

/// chrono#462: g (sin 30° − 0.3 cos 30°) for a second. matter-js#752: μ = 1 > tan 30° stands.
#[test]
fn a_block_on_a_slope_slides_by_the_difference_or_stands() {
    let speed =
        |mu: f64| at_end(&simulated(&block(30.0, mu, 2.0, 100, ""), &[]), "block", "velocity")[0];
    assert_near(speed(0.3), 9.81 * (0.5 - 0.3 * 0.75f64.sqrt()), 1e-9);
    assert_near(speed(1.0), 0.0, 1e-12);
}

/// A body of a scene.
fn boxed(name: &str, edges: [f64; 3], mass: f64, position: [f64; 3]) -> String {
    format!(
        "[[bodies]]\nname = \"{name}\"\nshape = {{ box = {edges:?} }}\nmass = {mass}\nposition = {position:?}\n"
    )
}

const GROUND: &str = "[[bodies]]\nname = \"ground\"\nfixed = true\nshape = { plane = [0, 0, 1] }\n";

/// brax#22: two cubes of 1 m fall and rest at ½ and 1½ m. Speculative contacts leave no overlap.
#[test]
fn two_cubes_come_to_rest_on_each_other() {
    let scene = format!(
        "[step]\ndt = 0.01\ncount = 200\n[contact]\nfriction = 0.5\n{GROUND}{}{}",
        boxed("lower", [1.0; 3], 1.0, [0.0, 0.0, 1.0]),
        boxed("upper", [1.0; 3], 1.0, [0.0, 0.0, 3.0]),
    );
    let end = simulated(&scene, &[]);
    assert_near(at_end(&end, "lower", "position")[2], 0.5, 1e-6);
    assert_near(at_end(&end, "upper", "position")[2], 1.5, 1e-6);
}

/// mujoco#1743: a cube falls 3 m: two steps take the speed √(2 · 3 g), to the weight of two steps.
#[test]
fn the_impulse_of_an_impact_is_the_momentum() {
    let scene = format!(
        "[step]\ndt = 0.001\ncount = 1000\n{GROUND}{}",
        boxed("cube", [1.0; 3], 2.0, [0.0, 0.0, 3.5]),
    );
    let folder = Folder::new();
    let (path, end) = (folder.file("fall.toml", &scene), folder.file("out", ""));
    std::fs::remove_file(&end).unwrap();
    assert_eq!(run(&["simulate", &path, "--out", &end]).status.code(), Some(0));
    let forces = std::fs::read_to_string(format!("{end}/forces.csv")).unwrap();
    let mut steps: Vec<(u32, f64)> = Vec::new();
    for line in forces.lines().skip(1).filter(|line| line.contains("normal")) {
        let cells: Vec<&str> = line.split(',').collect();
        let (step, impulse) = (cells[0].parse().unwrap(), cells[6].parse::<f64>().unwrap());
        match steps.last_mut() {
            Some((last, sum)) if *last == step => *sum += impulse,
            _ => steps.push((step, impulse)),
        }
    }
    // The first step leaves the speed that closes the gap, the second one takes the rest.
    let pairs = steps.windows(2).map(|pair| pair[0].1 + pair[1].1);
    let largest = pairs.fold(0.0, f64::max);
    assert_near(largest / 2.0, (2.0 * 9.81 * 3.0f64).sqrt(), 0.02);
}

/// avian#801: a cube of 1 kg is carried by a cube of 1 kg that is pushed: 9.81 N in all, and 19.62
/// N from the ground; of the four corners each carries a quarter in the least-norm answer at rest.
#[test]
fn a_carried_box_presses_on_its_carrier_by_its_weight() {
    let scene = format!(
        "[step]\ndt = 0.01\ncount = 20\n[contact]\nfriction = 0.5\n{GROUND}{}{}",
        boxed("carrier", [1.0; 3], 1.0, [0.0, 0.0, 0.5]),
        boxed("carried", [1.0; 3], 1.0, [0.0, 0.0, 1.5]),
    );
    let end = simulated(&scene, &["--loads"]);
    let pairs = end["loads"]["pairs"].as_array().unwrap();
    let pair = |on: &str| pairs.iter().find(|pair| pair["on"] == on).unwrap();
    assert_near(pair("carried")["carried"].as_f64().unwrap(), 9.81, 1e-9);
    assert_near(pair("carrier")["carried"].as_f64().unwrap(), 19.62, 1e-9);
    for contact in pair("carried")["contacts"].as_array().unwrap() {
        let least_norm = contact["range"]["least_norm"].as_f64().unwrap();
        assert_near(least_norm, 9.81 / 4.0, 0.05);
    }
}

/// nimblephysics#143: e = 1 and equal masses: a moving ball, a ball at rest and a wall, all within
/// a step of 0.01 s. The right end is (−2, 0) m/s with 2 J; shorter steps give it, the long one
/// loses 1 J and says so.
#[test]
fn a_ball_a_ball_and_a_wall_return_the_speed_or_a_warning_says_why_not() {
    let scene = "gravity = [0, 0, 0]\n[step]\ndt = 0.01\ncount = 100\n[contact]\nfriction = 0\nrestitution = 1\n\
        [[bodies]]\nname = \"wall\"\nfixed = true\nshape = { box = [1, 6, 6] }\nposition = [1.6, 0, 0]\n\
        [[bodies]]\nname = \"left\"\nshape = { sphere = 0.1 }\nmass = 1\nposition = [0.78, 0, 0]\nvelocity = [2, 0, 0]\n\
        [[bodies]]\nname = \"right\"\nshape = { sphere = 0.1 }\nmass = 1\nposition = [0.99, 0, 0]\n";
    let folder = Folder::new();
    let path = folder.file("balls.toml", scene);
    let long = out(&run(&["simulate", &path]));
    assert!(long.contains("impacts lost 1 J in step 1"), "{long}");
    for more in [["--dt", "0.0025"], ["--scheme", "acceleration"]] {
        let steps = if more[0] == "--dt" { "400" } else { "100" };
        let end = simulated(scene, &[&more[..], &["--steps", steps]].concat());
        assert_near(at_end(&end, "left", "velocity")[0], -2.0, 1e-9);
        assert_near(at_end(&end, "right", "velocity")[0], 0.0, 1e-9);
    }
}

/// A ball of radius 0.05 m at 20 m/s moves 0.33 m a step, toward a plate of 0.05 m: it rests on the
/// plate at 0.025 + 0.05 m.
#[test]
fn a_fast_ball_does_not_pass_a_thin_plate() {
    let scene = "[step]\ndt = 0.0166666\ncount = 60\n[contact]\nfriction = 0.5\n\
        [[bodies]]\nname = \"plate\"\nfixed = true\nshape = { box = [2, 2, 0.05] }\n\
        [[bodies]]\nname = \"ball\"\nshape = { sphere = 0.05 }\nmass = 1\nposition = [0, 0, 1]\nvelocity = [0, 0, -20]\n";
    assert_near(at_end(&simulated(scene, &[]), "ball", "position")[2], 0.075, 1e-6);
}

/// raisim#628: 100 kg on three cubes of 20 kg: 981 N from the three cubes, 1,569.6 N from the
/// ground, whichever body a row names first.
#[test]
fn three_supports_carry_the_weight_above_them() {
    let cube = |name: &str, x: f64, y: f64| boxed(name, [0.4; 3], 20.0, [x, y, 0.2]);
    let scene = format!(
        "[step]\ndt = 0.002\ncount = 20\n[contact]\nfriction = 0.8\n{GROUND}{}{}{}{}",
        cube("c1", -0.5, -0.5),
        cube("c2", 0.5, -0.5),
        cube("c3", 0.0, 0.5),
        boxed("test", [1.4, 1.4, 0.6], 100.0, [0.0, 0.0, 0.7]),
    );
    let end = simulated(&scene, &["--loads"]);
    let pairs = end["loads"]["pairs"].as_array().unwrap();
    let sum = |is_meant: &dyn Fn(&Value) -> bool| -> f64 {
        pairs
            .iter()
            .filter(|pair| is_meant(pair))
            .map(|pair| pair["carried"].as_f64().unwrap())
            .sum()
    };
    assert_near(sum(&|pair| pair["on"] == "test"), 981.0, 1e-6);
    assert_near(sum(&|pair| pair["by"] == "ground"), 1569.6, 1e-6);
}

/// cannon.js#274: the feet of a table of four legs. The force of one foot is largest if the others
/// carry the rest at the point where the line from it through the center leaves the hull: the law
/// of the lever.
#[test]
fn each_foot_of_a_table_has_the_range_of_the_law_of_the_lever() {
    let turned = [
        [0.859803, 0.265968],
        [-0.265968, 0.859803],
        [-0.859803, -0.265968],
        [0.265968, -0.859803],
    ];
    let legs: Vec<String> = turned
        .iter()
        .map(|[x, y]| {
            format!("{{ shape = {{ box = [0.05, 0.05, 1] }}, position = [{x}, {y}, 0.5] }}")
        })
        .collect();
    let scene = format!(
        "[step]\ndt = 0.01\ncount = 20\n[contact]\nfriction = 0.5\n{GROUND}[[bodies]]\nname = \"table\"\nmass = 40\n\
         shape = {{ compound = [{{ shape = {{ box = [2, 2, 0.1] }}, position = [0, 0, 1.05] }}, {}] }}\n",
        legs.join(", ")
    );
    let loads = simulated(&scene, &["--loads"])["loads"].clone();
    let pair = &loads["pairs"][0];
    let weight = 40.0 * 9.81;
    assert_near(pair["carried"].as_f64().unwrap(), weight, 1e-6);
    assert_eq!(pair["range"]["is_unique"], true, "{pair}");
    let moments = numbers(&pair["wrench"]["moment"]);
    assert!(moments.iter().all(|m| m.abs() < 1e-6), "{moments:?}");
    let contacts = pair["contacts"].as_array().unwrap();
    let feet: Vec<[f64; 2]> =
        contacts.iter().map(|own| numbers(&own["arm"])).map(|arm| [arm[0], arm[1]]).collect();
    assert_eq!(feet.len(), 16);
    for (contact, foot) in contacts.iter().zip(&feet) {
        // The least distance, in units of the foot's, from the center to a line that supports the
        // hull against −foot: the hull of the feet, by all lines through two of them.
        let reach = reach_opposite(foot, &feet);
        let most = weight * reach / (1.0 + reach);
        assert_near(contact["range"]["least"].as_f64().unwrap(), 0.0, 1e-3);
        assert_near(contact["range"]["most"].as_f64().unwrap(), most, 1e-3);
        assert_near(contact["range"]["least_norm"].as_f64().unwrap(), weight / 16.0, 1e-3);
    }
}

/// The largest s for which −s · foot is in the hull of the feet.
fn reach_opposite(foot: &[f64; 2], feet: &[[f64; 2]]) -> f64 {
    let cross = |a: [f64; 2], b: [f64; 2]| a[0] * b[1] - a[1] * b[0];
    let mut reach = f64::INFINITY;
    for p in feet {
        for q in feet {
            let edge = [q[0] - p[0], q[1] - p[1]];
            let side = |r: &[f64; 2]| cross(edge, [r[0] - p[0], r[1] - p[1]]);
            let is_edge = p != q && feet.iter().all(|r| side(r) >= -1e-9);
            // How fast −foot leaves the half plane.
            let speed = cross(edge, *foot);
            if is_edge && speed > 1e-12 {
                reach = reach.min(side(&[0.0, 0.0]) / speed);
            }
        }
    }
    reach
}

/// A motor of 0.1 N s presses a block against a wall without gravity: motor and wall cancel, and
/// nothing is wrong.
#[test]
fn a_motor_that_presses_against_a_wall_is_no_fault_of_the_solver() {
    let scene = "gravity = [0, 0, 0]\n[step]\ndt = 0.01\ncount = 30\n\
        [[bodies]]\nname = \"wall\"\nfixed = true\nshape = { box = [0.2, 1, 1] }\nposition = [0.7, 0, 0]\n\
        [[bodies]]\nname = \"block\"\nshape = { box = [1, 1, 1] }\nmass = 1\n\
        [[constraints]]\nkind = \"slider\"\nbodies = [\"block\"]\naxis = [1, 0, 0]\n\
        [[constraints]]\nkind = \"motor_translation\"\nbodies = [\"block\"]\naxis = [1, 0, 0]\nspeed = 1\neffort = 10\n";
    let folder = Folder::new();
    let path = folder.file("press.toml", scene);
    let found = out(&run(&["diagnose", &path, "--step", "25"]));
    assert!(found.contains("No cause of errors was found"), "{found}");
    let end = simulated(scene, &["--loads"]);
    let pair = |by: &str| {
        let pairs = end["loads"]["pairs"].as_array().unwrap();
        numbers(&pairs.iter().find(|pair| pair["by"] == by).unwrap()["wrench"]["force"])[0]
    };
    assert_near(pair("wall"), -10.0, 1e-9);
    assert_near(pair("world"), 10.0, 1e-9);
}

/// A wall contact with friction: a block of 2 kg is pressed against a wall with 100 N and held by
/// friction (μ = 0.5: up to 50 N, its weight is 19.62 N). The force is unique, how the corners
/// share it is not. `diagnose`, `explain` and their pages state the same.
#[test]
fn a_block_pressed_against_a_wall_is_carried_by_friction() {
    let scene = "[step]\ndt = 0.01\ncount = 5\n[contact]\nfriction = 0.5\n\
        [[bodies]]\nname = \"wall\"\nfixed = true\nshape = { plane = [1, 0, 0] }\n\
        [[bodies]]\nname = \"block\"\nshape = { box = [0.2, 0.2, 0.2] }\nmass = 2\nposition = [0.1, 0, 0]\n\
        force = [-100, 0, 0]\n";
    let loads = simulated(scene, &["--loads"])["loads"].clone();
    let pair = &loads["pairs"][0];
    let force = numbers(&pair["wrench"]["force"]);
    assert_near(force[0], 100.0, 1e-6);
    assert_near(force[2], 19.62, 1e-6);
    assert_eq!(pair["range"]["is_unique"], true, "{pair}");
    // Friction at the wall, 0.1 m from the center, turns the block; the wall's pressure holds it.
    assert_near(numbers(&pair["wrench"]["moment"])[1], 0.0, 1e-6);
    // The sum over contacts of force and r × force.
    let contacts = pair["contacts"].as_array().unwrap();
    let (mut sum, mut moment) = (0.0, 0.0);
    for contact in contacts {
        let (own, arm) = (numbers(&contact["wrench"]["force"]), numbers(&contact["arm"]));
        assert_near(arm[0], -0.1, 1e-9);
        assert_near(arm[2].abs(), 0.1, 1e-9);
        sum += own[2];
        moment += arm[2] * own[0] - arm[0] * own[2];
    }
    assert_near(sum, 19.62, 1e-6);
    assert_near(moment, 0.0, 1e-6);
    assert!(contacts.iter().all(|contact| contact["range"]["is_unique"] == false), "{pair}");
    let folder = Folder::new();
    let path = folder.file("wall.toml", scene);
    for command in ["diagnose", "explain"] {
        let text = out(&run(&[command, &path, "--loads"]));
        assert!(text.contains("Forces between bodies"), "{command}: {text}");
        assert!(text.contains("(100, 0, 19.62)") && text.contains("unique"), "{command}: {text}");
        let page = folder.file(&format!("{command}.html"), "");
        assert_eq!(run(&[command, &path, "--loads", "--out", &page]).status.code(), Some(0));
        assert!(
            std::fs::read_to_string(&page).unwrap().contains("Forces of contacts"),
            "{command}"
        );
    }
    let folder_of_run = folder.0.path().join("run");
    let run_to = folder_of_run.to_str().unwrap();
    assert_eq!(run(&["simulate", &path, "--loads", "--out", run_to]).status.code(), Some(0));
    let page = std::fs::read_to_string(folder_of_run.join("index.html")).unwrap();
    assert!(page.contains("Forces by body, in the last step"));
}

/// A model in MuJoCo's format is named as such, with what reads it.
#[test]
fn a_model_of_mujoco_is_named_with_what_reads_it() {
    let folder = Folder::new();
    let path =
        folder.file("stack.xml", "<mujoco><worldbody><geom type=\"plane\"/></worldbody></mujoco>");
    for command in ["simulate", "solve"] {
        let output = run(&[command, &path]);
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2));
        assert!(
            message.contains("MuJoCo model (MJCF)") && message.contains("lcplab import"),
            "{message}"
        );
    }
}
