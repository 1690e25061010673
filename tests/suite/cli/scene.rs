//! Commands on a scene: what they step, record and draw.

use serde_json::Value;

use super::{err, out, run};

#[test]
fn scenes_lists_every_joint_with_its_fields() {
    let list = out(&run(&["scenes", "--joints"]));
    for joint in lcplab::constraint::ALL {
        assert!(list.contains(&format!("\n{joint}\n")) || list.starts_with(&format!("{joint}\n")));
    }
    assert!(list.contains("1 or 2 bodies, axis, [point]\n"), "{list}");
}

#[test]
fn a_scene_is_stepped_in_the_given_order() {
    let sweeps = |arguments: &[&str]| {
        let all = ["simulate", "stack", "--steps", "2", "--solver", "pgs", "--json"];
        let output = run(&[&all[..], arguments].concat());
        assert_eq!(output.status.code(), Some(0), "{}", err(&output));
        out(&output)
    };
    assert_eq!(sweeps(&["--order", "natural"]), sweeps(&[]));
    assert_ne!(sweeps(&["--order", "reverse"]), sweeps(&[]));
}

#[test]
fn fixed_sweeps_stay_with_the_method_of_the_scene_and_end_with_another_or_a_tolerance() {
    let stepped = |arguments: &[&str]| {
        run(&[&["simulate", "warm_start", "--steps", "2", "--json"], arguments].concat())
    };
    let problems = |arguments: &[&str]| {
        let summary: Value = serde_json::from_str(&out(&stepped(arguments))).unwrap();
        summary["problems"].clone()
    };
    assert_eq!(out(&stepped(&["--solver", "pgs"])), out(&stepped(&[])));
    assert_eq!(problems(&[]), 0); // none is posed
    assert_eq!(problems(&["--solver", "dantzig"]), 2);
    assert_eq!(problems(&["--tolerance", "1e-6"]), 2);
    let stated = ["--set", "solver.fixed_sweeps=true"];
    for other in [["--solver", "dantzig"], ["--tolerance", "1e-6"]] {
        let refused = stepped(&[stated, other].concat());
        assert_eq!(refused.status.code(), Some(2), "{other:?}");
        assert!(err(&refused).contains("fixed_sweeps"), "{}", err(&refused));
    }
}

#[test]
fn simulate_records_every_step_and_body() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let output = run(&["simulate", "pendulum", "--steps", "7", "--out", path, "--json"]);
    assert_eq!(output.status.code(), Some(0));
    let summary: Value = serde_json::from_str(&out(&output)).unwrap();
    assert_eq!((&summary["steps"], &summary["rejected_claims"]), (&7.into(), &0.into()));
    let lines =
        |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap().lines().count();
    assert_eq!((lines("ledger.csv"), lines("trajectory.csv")), (9, 9)); // heading, start, 7 steps
    let page = std::fs::read_to_string(folder.path().join("index.html")).unwrap();
    assert!(page.contains("\"steps\":[0,1,2,3,4,5,6,7]"), "all instants can be played");
    let opening = page.split("<main").next().unwrap();
    assert!(opening.contains("7 of 7") && opening.contains("no warnings"), "one LCP per step");
}

#[test]
fn compare_shows_the_given_solvers_side_by_side() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let all = ["compare", "pendulum", "--steps", "3", "--solver", "dantzig", "--out", path];
    assert_eq!(
        run(&[&all[..], &["--show", "pgs:1", "--show", "dantzig"]].concat()).status.code(),
        Some(0)
    );
    let page = std::fs::read_to_string(folder.path().join("index.html")).unwrap();
    let names: Vec<_> = page
        .split("<p class=\"take\">")
        .skip(1)
        .map(|rest| rest.split('<').next().unwrap())
        .collect();
    assert_eq!(names, ["pgs, velocity, 1 sweep", "dantzig, velocity"]);
    for (name, reason) in [("pgs:0", "is not a number of sweeps"), ("magic", "magic")] {
        let output = run(&[&all[..], &["--show", name]].concat());
        assert_eq!(output.status.code(), Some(2));
        assert!(err(&output).contains(reason), "{}", err(&output));
    }
}

#[test]
fn compare_takes_a_scene_that_is_not_shipped() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("mine.toml");
    let mine = out(&run(&["scenes", "fig7"])).replace("mass = 1", "mass = 2");
    std::fs::write(&path, mine).unwrap();
    let output = run(&["compare", path.to_str().unwrap(), "--steps", "1", "--json"]);
    let result: Value = serde_json::from_str(&out(&output)).unwrap();
    let runs = result["comparison"]["runs"].as_array().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert!(runs.iter().all(|run| run["claimed"] == run["accepted"]));
    let bad = out(&run(&["scenes", "fig7"])).replace("mass = 1", "mass = -1");
    std::fs::write(&path, bad).unwrap();
    let output = run(&["compare", path.to_str().unwrap()]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).contains("bodies[1].mass: must be positive, is -1"), "{}", err(&output));
}

#[test]
fn a_family_is_chosen_on_the_command_line() {
    let families = |args: &[&str]| -> Vec<(String, String)> {
        let result: Value = serde_json::from_str(&out(&run(args))).unwrap();
        let runs = result["comparison"]["runs"].as_array().unwrap();
        let word = |run: &Value, key: &str| run[key].as_str().unwrap().to_string();
        runs.iter().map(|run| (word(run, "scheme"), word(run, "solver"))).collect()
    };
    let levels = families(&["compare", "fig7", "--steps", "1", "--json", "--solver", "pgs"]);
    assert_eq!(
        levels.iter().map(|run| run.0.as_str()).collect::<Vec<_>>(),
        ["velocity", "acceleration"]
    );
    let soft = ["compare", "fig7", "--steps", "1", "--json", "--scheme", "soft"];
    assert_eq!(families(&soft), [("soft".into(), "none".into())]);
    let output = run(&["simulate", "painleve", "--scheme", "acceleration"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(out(&output).contains("no forces satisfy the sliding contact"), "{}", out(&output));
}

#[test]
fn a_scene_whose_solver_does_not_exist_is_refused() {
    let output = run(&["simulate", "fig6", "--solver", "magic"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(err(&output).starts_with("error: there is no solver named \"magic\""));
    let output = run(&["simulate", "fig6", "--solver", "cone-pgs"]);
    assert_eq!(output.status.code(), Some(2));
    let reason = "cone-pgs supports only friction cones, not coupled-box";
    assert!(err(&output).contains(reason), "{}", err(&output));
}

#[test]
fn simulate_says_where_the_energy_is_not_accounted_for() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().to_str().unwrap();
    let named = ["simulate", "pendulum", "--steps", "3", "--scheme", "xpbd"];
    let output = run(&[&named[..], &["--out", path, "--json"]].concat());
    let summary: Value = serde_json::from_str(&out(&output)).unwrap();
    let says = [&summary["work"], &summary["remainder"], &summary["laws"]["friction_gain"]];
    assert_eq!(says, ["not accounted"; 3]);
    assert!(summary["worst_residual"].is_null(), "no problem was solved");
    let ledger = std::fs::read_to_string(folder.path().join("ledger.csv")).unwrap();
    let lines: Vec<Vec<&str>> = ledger.lines().map(|line| line.split(',').collect()).collect();
    let at = |name: &str| lines[0].iter().position(|column| *column == name).unwrap();
    for name in ["constraint (J)", "correction (J)", "remainder (J)", "friction gain (J)"] {
        assert!(lines[2..].iter().all(|line| line[at(name)] == "not accounted"), "{name}");
    }
    assert!(lines[2..].iter().all(|line| line[at("energy (J)")].parse::<f64>().is_ok()));
    assert!(out(&run(&named)).contains("ledger       not accounted"));
    let penalty = out(&run(&["simulate", "pendulum", "--steps", "3", "--scheme", "penalty"]));
    assert!(penalty.contains("ledger       balances to"), "{penalty}");
}

#[test]
fn simulate_prints_where_the_bodies_end_and_which_answer_was_refused_first() {
    let good = run(&["simulate", "sliding", "--steps", "3", "--set", "mu=0.3", "--json"]);
    let summary: Value = serde_json::from_str(&out(&good)).unwrap();
    let states = summary["states"].as_array().unwrap();
    assert_eq!(states.len(), 2);
    assert!(states[1]["velocity"][0].as_f64().unwrap() > 0.0);
    assert!(summary["first_refused"].is_null());
    let few =
        run(&["simulate", "stack", "--steps", "2", "--solver", "pgs", "--max-iterations", "2"]);
    assert_eq!(few.status.code(), Some(1));
    let text = out(&few);
    assert!(text.contains("at the end") && text.contains("rejected     first in step 1"), "{text}");
    assert!(text.contains("pgs: iteration limit"), "{text}");
}

#[test]
fn a_body_that_is_far_beyond_the_picture_is_no_panic() {
    let folder = tempfile::tempdir().unwrap();
    let scene = folder.path().join("far.toml");
    let text = "[[bodies]]\nname = \"ground\"\nfixed = true\nshape = { plane = [0, 0, 1] }\n\
                [[bodies]]\nname = \"near\"\nshape = { box = [1, 1, 1] }\nmass = 1\n\
                [[bodies]]\nname = \"far\"\nshape = { box = [1, 1, 1] }\nmass = 1\n\
                position = [1e149, 0, 3.5]\n";
    std::fs::write(&scene, text).unwrap();
    let page = folder.path().join("out");
    let arguments =
        ["simulate", scene.to_str().unwrap(), "--steps", "1", "--out", page.to_str().unwrap()];
    let output = run(&arguments);
    assert!(matches!(output.status.code(), Some(0 | 1)), "{}", err(&output));
    assert!(page.join("index.html").exists());
}

const TWO_BALLS_AND_A_WALL: &str = "
    gravity = [0, 0, 0]
    step = { dt = 0.01, count = 20 }
    contact = { restitution = 1 }
    bodies = [
        { name = \"wall\", fixed = true, shape = { box = [1, 6, 6] }, position = [1.6, 0, 0] },
        { name = \"ball1\", shape = { sphere = 0.1 }, mass = 1, position = [0.78, 0, 0], velocity = [2, 0, 0] },
        { name = \"ball2\", shape = { sphere = 0.1 }, mass = 1, position = [0.99, 0, 0] },
    ]
";

const BALL_AND_THIN_PLATE: &str = "
    step = { dt = 0.0166666, count = 60 }
    contact = { margin = 0.05 }
    bodies = [
        { name = \"plate\", fixed = true, shape = { box = [2, 2, 0.05] } },
        { name = \"ball\", shape = { sphere = 0.05 }, mass = 1, position = [0, 0, 1], velocity = [0, 0, -20] },
    ]
";

#[test]
fn energy_and_overlaps_that_no_residual_shows_are_warnings_of_simulate_and_diagnose() {
    let folder = tempfile::tempdir().unwrap();
    let cases = [
        (TWO_BALLS_AND_A_WALL, "gap_closed_within_step", ["ball2", "wall"], "lost 1 J in step 1"),
        (BALL_AND_THIN_PLATE, "passed_through", ["ball", "plate"], "passed through"),
    ];
    for (scene, kind, bodies, words) in cases {
        let path = folder.path().join("mine.toml");
        std::fs::write(&path, scene).unwrap();
        let path = path.to_str().unwrap();
        let out_folder = folder.path().join(kind);
        let output = run(&["simulate", path, "--out", out_folder.to_str().unwrap()]);
        assert_eq!(output.status.code(), Some(0));
        let text = out(&output);
        let warning = text.lines().find(|line| line.starts_with("warning")).unwrap();
        assert!(warning.contains(words), "{warning}");
        let results = std::fs::read_to_string(out_folder.join("results.json")).unwrap();
        let results: Value = serde_json::from_str(&results).unwrap();
        let warning = &results["warnings"][0];
        assert_eq!((&warning["kind"], &warning["bodies"]), (&kind.into(), &bodies.into()));
        assert!(warning["step"].as_u64().unwrap() >= 1, "{warning}");
        assert!(warning["message"].as_str().unwrap().contains(words), "{warning}");
        let diagnosis = out(&run(&["diagnose", path]));
        let diagnosis = diagnosis.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(diagnosis.contains("Warning ") && diagnosis.contains(words), "{diagnosis}");
        assert!(!diagnosis.contains("causes of the error"), "no cause was found: {diagnosis}");
        let json: Value = serde_json::from_str(&out(&run(&["diagnose", path, "--json"]))).unwrap();
        assert!(json["examination"]["warnings"][0].as_str().unwrap().contains(words));
    }
}

#[test]
fn a_healthy_scene_has_no_warning() {
    let summary: Value =
        serde_json::from_str(&out(&run(&["simulate", "stack", "--json"]))).unwrap();
    assert_eq!(summary["warnings"], serde_json::json!([]));
    assert!(summary["first_passage"].is_null());
}

#[test]
fn a_mass_that_is_too_small_is_one_message() {
    let output = run(&["simulate", "stack", "--set", "generate.mass=1e-308"]);
    assert_eq!(output.status.code(), Some(2));
    let message = err(&output);
    assert!(message.contains("mass 1e-308 kg is too small"), "{message}");
}

#[test]
fn a_hinge_that_a_scheme_breaks_is_named_with_law_and_amount() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wheel.toml");
    let text = "gravity = [0, 0, 0]\nstep.dt = 1\n\
        [[bodies]]\nname = \"wheel\"\nshape = { cylinder = { length = 0.1, radius = 0.5 } }\nmass = 2\n\
        [[constraints]]\nkind = \"hinge\"\nbodies = [\"wheel\"]\naxis = [1, 2, 3]\nstart_speed = 30\n";
    std::fs::write(&path, text).unwrap();
    let path = path.to_str().unwrap();
    let text = |scheme: &str| {
        let output = run(&["simulate", path, "--steps", "1", "--scheme", scheme]);
        out(&output)
    };
    let penalty = text("penalty");
    // 2 kg on springs of 10⁴ N/m with substeps of 1/8 s
    assert!(penalty.contains("springs of the scheme penalty are unstable"), "{penalty}");
    for scheme in ["penalty", "xpbd"] {
        let text = text(scheme);
        assert!(text.contains("\"wheel\" turned by 3.8 rad in a substep of step 1"), "{text}");
        assert!(text.contains("Forces of rigid joints do no work"), "{text}");
    }
    // The springs do not hold the axis; XPBD moves it back.
    let drift = penalty.lines().find(|line| line.starts_with("drift")).unwrap();
    assert!(drift.ends_with('°'), "{drift}");
    let diagnosis = out(&run(&["diagnose", path, "--set", "step.scheme=\"xpbd\""]));
    let diagnosis = diagnosis.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(diagnosis.contains("Forces of rigid joints do no work"), "{diagnosis}");
    let velocity = text("velocity");
    assert!(!velocity.contains("note"), "{velocity}");
}

#[test]
fn the_torque_of_a_gear_is_no_error_of_the_scheme() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("gears.toml");
    let wheel = |name: &str, x: f64| {
        format!(
            "[[bodies]]\nname = \"{name}\"\nshape = {{ sphere = 0.2 }}\nmass = 1\nposition = [{x}, 0, 0]\n\
             [[constraints]]\nkind = \"hinge\"\nbodies = [\"{name}\"]\naxis = [0, 0, 1]\npoint = [{x}, 0, 0]\n"
        )
    };
    let drive = "[[constraints]]\nkind = \"gear\"\nbodies = [\"a\", \"b\"]\naxes = [[0, 0, 1], [0, 0, 1]]\n\
        teeth = [40, 20]\n\
        [[constraints]]\nkind = \"motor_rotation\"\nbodies = [\"a\"]\naxis = [0, 0, 1]\nspeed = 9\neffort = 1\n";
    let text = String::from("gravity = [0, 0, 0]\n") + &wheel("a", 0.0) + &wheel("b", 0.6) + drive;
    std::fs::write(&path, text).unwrap();
    let path = path.to_str().unwrap();
    for scheme in ["velocity", "sequential-impulses", "soft", "xpbd"] {
        let text = out(&run(&["simulate", path, "--steps", "20", "--scheme", scheme]));
        assert!(!text.contains("angular momentum"), "{scheme}: {text}");
    }
}

/// A ball hits a brick at rest off-center. XPBD turns the brick from rest within a substep h; the
/// change of the angular momentum is h/2 ω × I ω, with ω before restitution, up to order h².
#[test]
fn the_angular_momentum_that_xpbd_makes_in_an_off_center_impact_is_named_with_its_size() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("off-center.toml");
    let text = "gravity = [0, 0, 0]\ncontact.restitution = 0.5\nstep.dt = 0.008\nstep.count = 10\n\
        [[bodies]]\nname = \"brick\"\nmass = 2\nshape = { box = [0.2, 0.8, 0.4] }\n[[bodies]]\n\
        name = \"ball\"\nmass = 1\nshape = { sphere = 0.1 }\nposition = [-0.2, 0.3, 0.15]\n\
        velocity = [3, 0, 0]\n";
    std::fs::write(&path, text).unwrap();
    // The impulse J along x turns the brick by I ω = J (0, z, −y), with the moments m (a² + b²)/12.
    let [y, z] = [0.3, 0.15];
    let [about_y, about_z] = [2.0 * (0.04 + 0.16) / 12.0, 2.0 * (0.04 + 0.64) / 12.0];
    let impulse = 3.0 / (1.0 + 0.5 + z * z / about_y + y * y / about_z);
    let substep = 0.008 / 8.0;
    let made = 0.5 * substep * impulse * impulse * y * z * f64::abs(1.0 / about_z - 1.0 / about_y);
    let note = format!("the total angular momentum changed by {made:.1e} N m s");
    let path = path.to_str().unwrap();
    for scheme in lcplab::scene::Scheme::ALL {
        let reported = out(&run(&["simulate", path, "--scheme", scheme.name()]));
        let is_named =
            reported.contains(&note) && reported.contains("the scheme xpbd does not conserve it");
        assert_eq!(is_named, scheme.name() == "xpbd", "{made}: {reported}");
        assert_eq!(reported.contains("angular momentum"), is_named, "{reported}");
    }
}

/// A strong motor drives Bricard's mechanism, which locks as soon as it has drifted, until it is
/// torn apart. The remedy is one that helps: with `step.alpha` it is torn apart too.
#[test]
fn a_mechanism_that_a_motor_tears_apart_names_its_row_and_a_remedy_that_helps() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("ring.toml");
    let motor = "\n[[constraints]]\nkind = \"motor_rotation\"\nbodies = [\"rod 1\"]\naxis = [0, 1, 0]\n\
        speed = 2\neffort = 1e6\n";
    std::fs::write(&path, out(&run(&["scenes", "bricard"])) + motor).unwrap();
    let simulated = |more: &[&str]| {
        let reported = run(&[&["simulate", path.to_str().unwrap()], more].concat());
        (reported.status.code(), out(&reported))
    };
    let level = ["--scheme", "acceleration", "--steps", "20"];
    let (code, reported) = simulated(&level);
    assert_eq!(code, Some(1), "{reported}");
    assert!(
        reported.contains("\"rod 1\" diverged; the row with the largest impulse on it is"),
        "{reported}"
    );
    assert!(
        reported.contains("the motion diverged: try a shorter step or the scheme velocity"),
        "{reported}"
    );
    assert!(!reported.contains("set step.alpha"), "{reported}");
    let with_alpha = simulated(&[&level[..], &["--set", "step.alpha=20"]].concat());
    assert_eq!(with_alpha.0, Some(1), "{}", with_alpha.1);
    for remedy in [
        &["--scheme", "acceleration", "--dt", "0.001", "--set", "step.alpha=20"][..],
        &["--scheme", "velocity"],
    ] {
        let (code, reported) = simulated(&[remedy, &["--steps", "200"]].concat());
        assert_eq!(code, Some(0), "{reported}");
    }
}

#[test]
fn simulate_compare_and_diagnose_name_an_impact_that_lost_its_bounce() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("slow.toml");
    let text = "gravity = [0, 0, 0]\nstep.count = 10\n[contact]\nrestitution = 0.8\nbounce_speed = 1\n\
                [[bodies]]\nname = \"wall\"\nfixed = true\nshape = { plane = [1, 0, 0] }\n\
                [[bodies]]\nname = \"ball\"\nmass = 1\nshape = { sphere = 0.1 }\nposition = [0.11, 0, 0]\n\
                velocity = [-0.9, 0, 0]\n";
    std::fs::write(&path, text).unwrap();
    for command in ["simulate", "compare", "diagnose"] {
        let reported = out(&run(&[command, path.to_str().unwrap()]));
        let reported = reported.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(
            reported.contains("estitution 0.8 was not applied to an impact"),
            "{command}: {reported}"
        );
    }
}
