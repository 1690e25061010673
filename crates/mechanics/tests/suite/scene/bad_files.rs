//! Every message about an invalid scene contains the file, the line and the field.

use lcplab_lcp::error::Error;
use lcplab_mechanics::scene::{Scene, Scheme};
use lcplab_mechanics::simulation::Simulation;

fn message(text: &str) -> String {
    Scene::from_toml("bad.toml", text).unwrap_err().to_string()
}

const BALL: &str = "[[bodies]]\nname = \"ball\"\nshape = { sphere = 1 }\nmass = 1\n";

#[test]
fn a_negative_mass_is_reported_with_file_line_and_field() {
    let text = BALL.replace("mass = 1", "mass = -1");
    assert_eq!(message(&text), "bad.toml: line 4: bodies[0].mass: must be positive, is -1");
}

#[test]
fn one_defect_does_not_cause_others() {
    let text = lcplab_mechanics::scene::catalogue::text("pendulum").unwrap();
    let text = text.replace("mass = 1", "mass = 0");
    let line = 1 + text.lines().position(|line| line == "mass = 0").unwrap();
    let expected = format!("bad.toml: line {line}: bodies[0].mass: must be positive, is 0");
    assert_eq!(message(&text), expected);
}

#[test]
fn all_defects_come_at_once() {
    let text = format!("gravity = [0, 0, nan]\n[step]\ndt = 0\nbaumgarte = 2\n{BALL}{BALL}");
    assert_eq!(
        message(&text),
        "bad.toml: 4 defects\n  \
         line 3: step.dt: must be positive, is 0\n  \
         line 4: step.baumgarte: must lie between 0 and 1, is 2\n  \
         line 1: gravity: must be finite, has NaN\n  \
         line 10: bodies[1].name: \"ball\" is the name of bodies[0] too"
    );
}

#[test]
fn unknown_keys_are_reported_with_the_known_ones() {
    let text = format!("{BALL}weight = 3\n\n[step]\ndtt = 1\n");
    assert_eq!(
        message(&text),
        "bad.toml: 2 defects\n  \
         line 5: bodies[0].weight: unknown field \"weight\", expected one of \"name\", \"shape\", \
         \"fixed\", \"mass\", \"density\", \"inertia\", \"position\", \"rotation\", \"velocity\", \
         \"angular_velocity\", \"friction\", \"static_friction\", \"friction_direction\", \
         \"friction_across\", \"restitution\", \"force\", \"force_at\", \"force_over_time\", \
         \"displacement_over_time\", \"torque\", \"without_contact\"\n  \
         line 8: step.dtt: unknown field \"dtt\", expected one of \"dt\", \"count\", \
         \"scheme\", \"gyroscopic\", \"baumgarte\", \"feedback\", \"alpha\", \"integrator\", \"events\", \"substeps\", \"sweeps\", \"xpbd\", \"soft\", \"penalty\""
    );
}

#[test]
fn rolling_friction_is_rejected_by_name() {
    let text = format!("{BALL}rolling_friction = 0.1\n[contact]\nspinning = 0.1\n");
    let reason = |kind: &str| format!("states {kind} friction, which is not supported");
    let message = message(&text);
    let (body, contact) = (reason("rolling"), reason("torsional"));
    assert!(message.contains(&format!("line 5: bodies[0].rolling_friction: {body}")), "{message}");
    assert!(message.contains(&format!("line 7: contact.spinning: {contact}")), "{message}");
}

#[test]
fn a_text_for_a_number_is_reported_where_it_stands() {
    let text = BALL.replace("mass = 1", "mass = \"heavy\"");
    assert_eq!(
        message(&text),
        "bad.toml: line 4: bodies[0].mass: invalid type: string \"heavy\", expected a number"
    );
}

#[test]
fn a_missing_field_is_reported_at_its_body() {
    let text = format!("{BALL}\n[[bodies]]\nname = \"other\"\n");
    assert_eq!(message(&text), "bad.toml: line 6: bodies[1]: missing field \"shape\"");
}

#[test]
fn what_is_not_toml_is_reported_with_its_line() {
    let message = message("gravity = [0, 0, 1]\n[step\ndt = 1\n");
    assert!(message.starts_with("bad.toml: line 2: "), "{message}");
}

#[test]
fn a_constraint_with_an_unknown_body_names_it() {
    let text = format!("{BALL}\n[[constraints]]\nkind = \"nail\"\nbodies = [\"bal\"]\n");
    assert_eq!(
        message(&text),
        "bad.toml: line 8: constraints[0].bodies: there is no body named \"bal\""
    );
}

#[test]
fn a_rod_of_no_length_is_refused() {
    let rod = "kind = \"distance\"\nbodies = [\"ball\"]\npoints = [[0, 0, 0], [0, 0, 0]]\n";
    assert_eq!(
        message(&format!("{BALL}\n[[constraints]]\n{rod}")),
        "bad.toml: line 6: constraints[0].length: must be positive, is 0"
    );
}

#[test]
fn impossible_joints_are_refused() {
    let cases = [
        (
            "kind = \"motor_rotation\"\nspeed = inf",
            "3 defects\n  \
             line 6: constraints[0].axis: is missing\n  \
             line 6: constraints[0].effort: is missing\n  \
             line 8: constraints[0].speed: must be finite, is inf",
        ),
        (
            "kind = \"rope\"\naxis = [0, 0, 1]\nlength = -1",
            "2 defects\n  \
             line 8: constraints[0].axis: a rope has none\n  \
             line 9: constraints[0].length: must be positive, is -1",
        ),
        (
            "kind = \"universal\"\naxes = [[1, 0, 0], [1, 1, 0]]",
            "line 8: constraints[0].axes: must be perpendicular, are 45.0° apart",
        ),
        (
            "kind = \"limit_translation\"\naxis = [0, 0, 1]\nlimits = [2, 1]",
            "line 9: constraints[0].limits: the lower one must be below the upper, are 2, 1",
        ),
        (
            "kind = \"limit_rotation\"\naxis = [0, 0, 1]\nlimits = [-inf, 1]",
            "line 9: constraints[0].limits: must be less than a turn apart, 2π",
        ),
        (
            "kind = \"limit_cone\"\naxis = [0, 0, 1]\nangle = 4",
            "line 9: constraints[0].angle: must be below π, is 4",
        ),
        (
            "kind = \"spring\"\npoints = [[0, 0, 0], [0, 0, 1]]\nstiffness = 0",
            "line 9: constraints[0].stiffness: is 0, and the damping is 0 too, so the spring would have no effect",
        ),
        (
            "kind = \"spring_rotation\"\naxis = [0, 0, 0]\nstiffness = -2\ndamping = nan",
            "3 defects\n  \
             line 9: constraints[0].stiffness: must be at least 0, is -2\n  \
             line 10: constraints[0].damping: must be at least 0, is NaN\n  \
             line 8: constraints[0].axis: needs a direction, has length 0",
        ),
        (
            "kind = \"gear\"\naxes = [[0, 0, 1], [0, 0, 1]]\nteeth = [3, 0]",
            "line 10: constraints[0].bodies: names 1 bodies, must name 2",
        ),
    ];
    for (joint, expected) in cases {
        let text = format!("{BALL}\n[[constraints]]\n{joint}\nbodies = [\"ball\"]\n");
        assert_eq!(message(&text), format!("bad.toml: {expected}"));
    }
    let gear = "kind = \"gear\"\nbodies = [\"ball\", \"other\"]\naxes = [[0, 0, 1], [0, 0, 1]]\n";
    let other = BALL.replace("ball", "other");
    assert_eq!(
        message(&format!("{BALL}{other}\n[[constraints]]\n{gear}teeth = [3, 0]\n")),
        "bad.toml: line 14: constraints[0].teeth: must be at least 1 each"
    );
}

#[test]
fn impossible_bodies_are_refused() {
    let plane = "[[bodies]]\nname = \"a\"\nshape = { plane = [0, 0, 1] }\n";
    let cases = [
        (plane.to_string(), "line 3: bodies[0].shape: a plane must be fixed"),
        (
            "[[bodies]]\nname = \"a\"\nshape = \"point\"\ndensity = 2\n".into(),
            "line 4: bodies[0].density: a point has no volume, give its mass",
        ),
        (
            format!("{BALL}inertia = [1, 1, 3]\n"),
            "line 5: bodies[0].inertia: the moment 3 exceeds the sum 2 of the other two",
        ),
        (
            "[[bodies]]\nname = \"a\"\nshape = { sphere = 1 }\n".into(),
            "line 1: bodies[0].mass: is missing: give mass or density, or fixed = true",
        ),
        (
            "generate = { kind = \"net\", rows = 100000, columns = 100000, spacing = 1, hang = 1, mass = 1 }".into(),
            "line 1: generate[0]: makes 10000000000 bodies, at most 50000 are allowed",
        ),
    ];
    for (text, expected) in cases {
        assert_eq!(message(&text), format!("bad.toml: {expected}"));
    }
}

#[test]
fn a_mass_that_is_too_small_to_divide_by_is_one_defect_that_names_the_body() {
    assert_eq!(
        message(&BALL.replace("mass = 1", "mass = 1e-308")),
        "bad.toml: line 4: bodies[0].mass: body \"ball\": mass 1e-308 kg is too small, at least 1e-150 kg"
    );
    let light = message(&BALL.replace("mass = 1", "density = 1e-308"));
    let start = "bad.toml: line 4: bodies[0].density: body \"ball\": mass 4.18879";
    assert!(
        light.starts_with(start) && light.ends_with("is too small, at least 1e-150 kg"),
        "{light}"
    );
    assert_eq!(
        message(&format!("{BALL}inertia = [1e300, 1e300, 1e300]\n")),
        "bad.toml: line 5: bodies[0].inertia: body \"ball\": moment of inertia 1e300 kg m² is too large, \
         at most 1e150 kg m²"
    );
}

/// Numbers over the whole range of doubles in every field of a scene: either one defect, in the
/// file or in the first step, or a motion with finite numbers.
#[test]
fn numbers_at_the_ends_of_the_doubles_are_one_defect_or_a_finite_motion() {
    let text = |[key, value]: [&str; 2]| {
        let given =
            |own: &str, usual: &str| if own == key { value.into() } else { usual.to_string() };
        let shape = match key {
            "box" => format!("{{ box = [{value}, {value}, {value}] }}"),
            "hull" => format!(
                "{{ hull = [[0, 0, 0], [{value}, 0, 0], [0, {value}, 0], [0, 0, {value}]] }}"
            ),
            "capsule" => format!("{{ capsule = {{ length = 1, radius = {value} }} }}"),
            "cylinder" => format!("{{ cylinder = {{ length = {value}, radius = 0.5 }} }}"),
            "part" => format!(
                "{{ compound = [{{ shape = {{ sphere = 0.1 }}, position = [{value}, 0, 0] }}, \
                               {{ shape = {{ sphere = 0.1 }} }}] }}"
            ),
            _ => format!("{{ sphere = {} }}", given("sphere", "0.5")),
        };
        let mass = match key {
            "density" => format!("density = {value}"),
            "inertia" => format!("mass = 1\ninertia = [{value}, {value}, {value}]"),
            _ => format!("mass = {}", given("mass", "1")),
        };
        format!(
            "gravity = [0, 0, -{}]\nstep.dt = {}\n[contact]\nfriction = {}\nrestitution = 0.5\n\
             [[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n\
             [[bodies]]\nname = \"other\"\nshape = {{ sphere = 0.5 }}\nmass = 1\nposition = [0, 0, 0.5]\n\
             [[bodies]]\nname = \"own\"\nshape = {shape}\n{mass}\nposition = [0, 0, {}]\n\
             velocity = [0, 0, -{}]\nangular_velocity = [{}, 0, 0]\nforce = [{}, 0, 0]\n",
            given("gravity", "9.81"),
            given("dt", "0.01"),
            given("friction", "0.5"),
            given("position", "1.5"),
            given("velocity", "1"),
            given("angular_velocity", "0"),
            given("force", "0"),
        )
    };
    let keys = [
        "mass",
        "density",
        "inertia",
        "sphere",
        "box",
        "hull",
        "capsule",
        "cylinder",
        "part",
        "gravity",
        "dt",
        "friction",
        "position",
        "velocity",
        "angular_velocity",
        "force",
    ];
    let mut exponents: Vec<i32> = (-320..=300).step_by(20).collect();
    exponents.extend([-308, -149, -151, -61, -59, 59, 61, 149, 151, 308]);
    for key in keys {
        for exponent in &exponents {
            let value = format!("1e{exponent}");
            let scene = match Scene::from_toml("end.toml", &text([key, &value])) {
                Ok(scene) => scene,
                Err(Error::Invalid { defects, .. }) => {
                    assert_eq!(defects.len(), 1, "{key} = {value}: {defects:?}");
                    continue;
                }
                Err(error) => panic!("{key} = {value}: {error}"),
            };
            for scheme in Scheme::LEVELS {
                let mut simulation = Simulation::of(&scene.at_level(scheme)).unwrap();
                for _ in 0..3 {
                    match simulation.step() {
                        Ok(step) => {
                            let all =
                                step.states.iter().all(lcplab_mechanics::body::State::is_finite);
                            assert!(all && step.motion.energy().is_finite(), "{key} = {value}");
                        }
                        Err(failure) => {
                            let text = failure.to_string();
                            assert_eq!(text.lines().count(), 1, "{key} = {value}: {text}");
                            break;
                        }
                    }
                }
            }
        }
    }
}

#[test]
fn no_broken_text_makes_the_reader_panic() {
    let good = lcplab_mechanics::scene::catalogue::text("incline").unwrap();
    for cut in (0..good.len()).filter(|&cut| good.is_char_boundary(cut)) {
        let _ = Scene::from_toml("cut.toml", &good[..cut]);
        let _ = Scene::from_toml(
            "hole.toml",
            &format!("{}{}", &good[..cut], good[cut..].get(7..).unwrap_or("")),
        );
    }
}

/// A ground and a ball, and these lines for their pair.
fn paired(lines: &str) -> String {
    let ground = "[[bodies]]\nname = 'ground'\nfixed = true\nshape = { plane = [0, 0, 1] }\n";
    format!("{ground}{BALL}[[pairs]]\n{lines}\n")
}

#[test]
fn a_pair_is_stated_once_and_of_two_bodies_that_are_there() {
    let pair = "bodies = ['ground', 'ball']";
    for (lines, place, reason) in [
        ("bodies = ['ground', 'bell']".into(), "bodies[1]", "there is no body named \"bell\""),
        ("bodies = ['ball', 'ball']".into(), "bodies", "names one body twice"),
        (format!("{pair}\nfriction = -1"), "friction", "must be at least 0, is -1"),
        (format!("{pair}\nrestitution = 2"), "restitution", "must lie between 0 and 1, is 2"),
        (
            format!("{pair}\nfriction = 0.5\nstatic_friction = 0.4"),
            "static_friction",
            "must be at least friction, 0.5, is 0.4",
        ),
    ] {
        let found = message(&paired(&lines));
        assert!(found.ends_with(&format!(": pairs[0].{place}: {reason}")), "{found}");
    }
    let twice = format!("{pair}\n[[pairs]]\nbodies = ['ball', 'ground']");
    assert!(message(&paired(&twice)).ends_with("pairs[1].bodies: has been stated before"));
}

#[test]
fn friction_with_a_direction_has_both_coefficients_above_0() {
    for (lines, place, reason) in [
        ("friction = 1\nfriction_across = 0.5", "across", "needs a friction_direction"),
        ("friction = 1\nfriction_direction = [1, 0, 0]", "direction", "needs a friction_across"),
        (
            "friction_direction = [1, 0, 0]\nfriction_across = 0.5",
            "direction",
            "needs a friction above 0 of the same body or pair",
        ),
        (
            "friction = 1\nfriction_direction = [0, 0, 0]\nfriction_across = 0.5",
            "direction",
            "needs a direction, has length 0",
        ),
        (
            "friction = 1\nfriction_direction = [1, 0, 0]\nfriction_across = 0",
            "across",
            "must be above 0, is 0: 0.001, say, for almost no friction",
        ),
    ] {
        let found = message(&format!("{BALL}{lines}\n"));
        assert!(found.ends_with(&format!("bodies[0].friction_{place}: {reason}")), "{found}");
    }
}

#[test]
fn two_directions_that_may_touch_are_refused_unless_their_pair_is_given() {
    let directed = |name: &str| {
        format!(
            "[[bodies]]\nname = '{name}'\nshape = {{ sphere = 1.0 }}\nmass = 1.0\nfriction = 1\n\
             friction_direction = [1, 0, 0]\nfriction_across = 0.5\n"
        )
    };
    let both = directed("a") + &directed("b");
    let reason =
        "friction_direction: is given for \"a\" and for \"b\": give the friction of this pair";
    assert!(message(&both).ends_with(reason), "{}", message(&both));
    let pair = "[[pairs]]\nbodies = ['b', 'a']\nfriction = 0.3\n";
    assert!(Scene::from_toml("good.toml", &(both + pair)).is_ok());
}

#[test]
fn static_friction_is_no_less_than_friction() {
    let of_contacts = "[contact]\nfriction = 0.5\nstatic_friction = 0.4\n";
    assert_eq!(
        message(of_contacts),
        "bad.toml: line 3: contact.static_friction: must be at least friction, 0.5, is 0.4"
    );
    let without = format!("{BALL}static_friction = 0.4\n");
    assert_eq!(
        message(&without),
        "bad.toml: line 5: bodies[0].static_friction: needs a friction above 0 for sliding contacts"
    );
}

#[test]
fn a_function_of_time_ascends_and_stands_where_it_can_act() {
    let ground = "[[bodies]]\nname = 'ground'\nfixed = true\nshape = { plane = [0, 0, 1] }\n";
    let sine = |frequency: f64| {
        format!("{{ sine = {{ amplitude = [1, 0, 0], angular_frequency = {frequency} }} }}")
    };
    for (text, reason) in [
        (
            format!("{BALL}force_over_time = {{ table = [[1, 0, 0, 0], [1, 2, 0, 0]] }}\n"),
            "force_over_time.table: times must ascend, 1 s comes after 1 s",
        ),
        (
            format!("{BALL}force_over_time = {}\n", sine(0.0)),
            "force_over_time.sine.angular_frequency: must be positive, is 0",
        ),
        (
            format!("{ground}force_over_time = {}\n", sine(1.0)),
            "force_over_time: a fixed body has none",
        ),
        (
            format!("{BALL}displacement_over_time = {}\n", sine(1.0)),
            "displacement_over_time: needs fixed = true, because forces move all other bodies",
        ),
        (
            format!("{ground}velocity = [1, 0, 0]\ndisplacement_over_time = {}\n", sine(1.0)),
            "displacement_over_time: there is a velocity too, give one of them",
        ),
    ] {
        let found = message(&text);
        assert!(found.ends_with(&format!("bodies[0].{reason}")), "{found}");
    }
}

#[test]
fn a_model_of_another_program_is_named_with_the_command_that_imports_it() {
    assert_eq!(
        message("<?xml version=\"1.0\"?>\n<mujoco model=\"stack\"/>"),
        "bad.toml: is a MuJoCo model (MJCF); the Python package writes it as a scene: \
         python -m lcplab import"
    );
    assert!(message("<robot name=\"arm\">").contains("is a URDF model"));
}
