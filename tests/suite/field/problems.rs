//! Problems as files: answers, and problems without one or with several.

use super::*;

/// Problems with one solution: the report, the problem, its solution, and where that is from.
#[test]
fn problems_with_one_solution_are_solved_and_proved() {
    let contact = r#""friction_index": [-1, 0], "mu": [0, 0.5], "model": "coulomb-cone""#;
    let cases: [(&str, String, &[f64]); 9] = [
        // x = 9.8 where w = x − 9.8.
        ("dart#803", problem(&[&[1.0]], &[-9.8], ""), &[9.8]),
        // w = (0, 0.4, 0, 0) by hand; an old release answered (6, 0, 0, 0).
        ("PATHSolver.jl#80", path(), &[2.8, 0.0, 0.8, 1.2]),
        // 2 u − 1 = 0 for a free u; an old release answered 0.
        ("PATHSolver.jl#80, free", problem(&[&[2.0]], &[-1.0], r#""lo": ["-inf"]"#), &[0.5]),
        // w = (0, 11).
        ("LCPSolve", problem(&[&[1.0, -5.0], &[2.0, 1.0]], &[-4.0, 3.0], ""), &[4.0, 0.0]),
        // Two pure strategies each: the mix that makes the other player indifferent.
        ("game 2 × 2", game_2x2(), &[0.2, 0.4, 1.0 / 7.0, 2.0 / 7.0]),
        // In the plane the cone is the box; it slides: x_n = 1 − x_t / 5, x_t = x_n / 2.
        (
            "one tangent",
            problem(&[&[1.0, 0.2], &[0.2, 1.0]], &[-1.0, -2.0], contact),
            &[10.0 / 11.0, 5.0 / 11.0],
        ),
        // Each entry by Gaussian elimination of the three rows.
        (
            "two of three",
            problem(
                &[&[2.0, 1.0, 0.0], &[1.0, 2.0, 1.0], &[0.0, 1.0, 2.0]],
                &[-2.0, -3.0, -1.0],
                "",
            ),
            &[1.0 / 3.0, 4.0 / 3.0, 0.0],
        ),
        // In units of 1e15, 1e10, 1e5 and 1 the matrix is [8 2 4 1; 2 8 4 2; 4 4 8 2; 1 2 2 8] / 8.
        ("units", units(), &units_solved()),
        // Box constraints as a relay: x = (1, −1) with w = (−1.5, 0.5).
        (
            "relay",
            problem(&[&[2.0, 0.5], &[0.5, 1.0]], &[-3.0, 1.0], r#""lo": [-1, -1], "hi": [1, 1]"#),
            &[1.0, -1.0],
        ),
    ];
    for (name, problem, expected) in cases {
        let solved = json(&problem, &["solve", "-"]);
        let size = expected.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        for (x, expected) in numbers(&solved["x"]).iter().zip(expected) {
            assert!((x - expected).abs() <= 1e-8 * size, "{name}: {solved}");
        }
        assert_eq!(solved["verdict"], "proved", "{name}: {solved}");
        assert_eq!(verdict(&problem, expected)["verdict"], "proved", "{name}");
    }
}

/// The example in the manual of PATH.
fn path() -> String {
    let a: [&[f64]; 4] = [
        &[0.0, 0.0, -1.0, -1.0],
        &[0.0, 0.0, 1.0, -2.0],
        &[1.0, -1.0, 2.0, -2.0],
        &[1.0, 2.0, -2.0, 4.0],
    ];
    problem(&a, &[2.0, 2.0, -2.0, -6.0], "")
}

fn game_2x2() -> String {
    let a: [&[f64]; 4] = [
        &[0.0, 0.0, 1.0, 3.0],
        &[0.0, 0.0, 3.0, 2.0],
        &[3.0, 1.0, 0.0, 0.0],
        &[1.0, 2.0, 0.0, 0.0],
    ];
    problem(&a, &[-1.0; 4], "")
}

/// The same four rows in units that differ by 15 powers of ten.
fn units() -> String {
    let a: [&[f64]; 4] = [
        &[1e30, 2.5e24, 5e19, 1.25e14],
        &[2.5e24, 1e20, 5e14, 2.5e9],
        &[5e19, 5e14, 1e10, 25000.0],
        &[1.25e14, 2.5e9, 25000.0, 1.0],
    ];
    problem(&a, &[-1.0; 4], "")
}

/// Only the last row carries anything: with x = (0, 0, 0, 1) the others have
/// w = (1.25e14, 2.5e9, 25000) − 1.
fn units_solved() -> [f64; 4] {
    [0.0, 0.0, 0.0, 1.0]
}

#[test]
fn answers_of_wrong_releases_are_rejected() {
    for (problem, x) in [
        (path(), vec![6.0, 0.0, 0.0, 0.0]),
        (problem(&[&[2.0]], &[-1.0], r#""lo": ["-inf"]"#), vec![0.0]),
        (problem(&[&[1.0, -5.0], &[2.0, 1.0]], &[-4.0, 3.0], ""), vec![0.0, 0.0]),
    ] {
        assert_eq!(verdict(&problem, &x)["verdict"], "not_a_solution", "{problem}");
    }
}

/// dart#803: w = −9.8 for A = 0, and w = −x − 9.8 for A = −1, are negative for every x ≥ 0.
#[test]
fn a_contact_that_nothing_can_push_apart_has_no_solution() {
    for a in [0.0, -1.0] {
        let solved = json(&problem(&[&[a]], &[-9.8], ""), &["solve", "-"]);
        assert_eq!(solved["status"], "infeasible", "{solved}");
        assert!(solved["certificate"]["no_solution"].is_array(), "{solved}");
    }
}

/// Rows whose terms are all 0 at the solution have rounding errors of any relative size: 2e-17 for
/// an unloaded joint, 1e-17 between equations of zeros.
#[test]
fn rounding_dust_in_a_row_without_load_is_accepted() {
    let joint = problem(&[&[2.0, 0.0], &[0.0, 3.0]], &[-1.0, 0.0], r#""lo": [0, "-inf"]"#);
    assert_eq!(verdict(&joint, &[0.5, 2e-17])["verdict"], "proved");
    let equations = problem(&[&[0.0, 1.0], &[1.0, 1.0]], &[0.0, -1.0], r#""lo": ["-inf", "-inf"]"#);
    assert_eq!(verdict(&equations, &[1.0, 1e-17])["verdict"], "proved");
}

/// pounce#848: ½ x² + 5 x y + ½ y² on the box |x|, |y| ≤ 1 has a saddle at 0, and its minima in two
/// corners; also with the off-diagonal 3.
#[test]
fn a_saddle_of_a_quadratic_program_is_no_minimum() {
    for c in [3.0, 5.0] {
        let more = r#""lo": [-1, -1], "hi": [1, 1], "objective": true"#;
        let saddle = problem(&[&[1.0, c], &[c, 1.0]], &[0.0, 0.0], more);
        let is_no_minimum = |x: [f64; 2]| verdict(&saddle, &x)["minimum"]["is_minimum"] == false;
        assert!(is_no_minimum([0.0, 0.0]));
        assert!(
            !is_no_minimum([1.0, -1.0]) && verdict(&saddle, &[1.0, -1.0])["verdict"] == "proved"
        );
        let file = format!(
            "NAME SADDLE\nROWS\n N OBJ\nCOLUMNS\n X OBJ 0.0\n Y OBJ 0.0\nRHS\nBOUNDS\n LO BND X -1.0\n \
             UP BND X 1.0\n LO BND Y -1.0\n UP BND Y 1.0\nQUADOBJ\n X X 1.0\n X Y {c}\n Y Y 1.0\nENDATA\n"
        );
        let folder = Folder::new();
        let (file, x) = (folder.file("s.qps", &file), folder.file("x.json", r#"{"x": [0, 0]}"#));
        let judged = out(&run(&["judge", &file, &x]));
        assert!(judged.contains("no minimum"), "{judged}");
    }
}

/// Nashpy's degenerate games: three strategies against two. By hand (von Stengel 2007): the first
/// strategy against any mix with at least ⅔ of the other player's first one; and the mix (⅓, ⅔) of
/// the second and third one against (⅓, ⅔). Costs are 7 minus the payoffs.
#[test]
fn all_equilibria_of_a_degenerate_game_are_listed() {
    let payoffs: [[f64; 2]; 3] = [[3.0, 3.0], [2.0, 5.0], [0.0, 6.0]];
    let others: [[f64; 2]; 3] = [[3.0, 3.0], [2.0, 6.0], [3.0, 1.0]];
    let mut a = vec![vec![0.0; 5]; 5];
    for (i, (own, other)) in payoffs.iter().zip(others).enumerate() {
        for j in 0..2 {
            a[i][3 + j] = 7.0 - own[j];
            a[3 + j][i] = 7.0 - other[j];
        }
    }
    let rows: Vec<&[f64]> = a.iter().map(Vec::as_slice).collect();
    let game = problem(&rows, &[-1.0; 5], "");
    let all = json(&game, &["prove", "-", "--all"]);
    let mut corners: Vec<String> = all["exact_corners"]
        .as_array()
        .unwrap()
        .iter()
        .map(|corner| corner.as_array().unwrap().iter().map(|x| x.as_str().unwrap()))
        .map(|corner| corner.collect::<Vec<_>>().join(" "))
        .collect();
    corners.sort();
    assert_eq!(corners, ["0 1/13 2/13 1/9 2/9", "1/4 0 0 1/4 0", "1/4 0 0 1/6 1/12"]);
    let mut sizes: Vec<usize> = all["faces"]
        .as_array()
        .unwrap()
        .iter()
        .map(|face| face["corners"].as_array().unwrap().len())
        .collect();
    sizes.sort_unstable();
    assert_eq!(sizes, [1, 2], "{all}");
}

/// Complementarity.jl#5: plans of transport from plants with a capacity to markets with a demand,
/// as complementarity of flows, capacities and demands.
fn transport(costs: &[&[f64]], supply: &[f64], demand: &[f64]) -> String {
    let (plants, markets) = (supply.len(), demand.len());
    let n = plants * markets + plants + markets;
    let mut a = vec![vec![0.0; n]; n];
    let mut b = vec![0.0; n];
    for i in 0..plants {
        for j in 0..markets {
            let flow = i * markets + j;
            let (own, price) = (plants * markets + i, plants * markets + plants + j);
            (a[flow][own], a[flow][price]) = (1.0, -1.0);
            (a[own][flow], a[price][flow]) = (-1.0, 1.0);
            b[flow] = costs[i][j];
            (b[own], b[price]) = (supply[i], -demand[j]);
        }
    }
    let rows: Vec<&[f64]> = a.iter().map(Vec::as_slice).collect();
    problem(&rows, &b, "")
}

/// Both plans cost the same: the first market pays 2 to either plant. All prices are 0 at the
/// plants, 2 and 3 at the markets. In the second problem, of 11 rows, the costs of the first market
/// are equal too.
#[test]
fn transport_at_equal_cost_has_more_than_one_plan() {
    let small = transport(&[&[2.0, 3.0], &[2.0, 4.0]], &[50.0, 60.0], &[30.0, 25.0]);
    for plan in [[25.0, 25.0, 5.0, 0.0], [0.0, 25.0, 30.0, 0.0]] {
        let x = [&plan[..], &[0.0, 0.0, 2.0, 3.0]].concat();
        assert_eq!(verdict(&small, &x)["verdict"], "proved", "{x:?}");
    }
    let costs: [&[f64]; 2] = [&[0.225, 0.153, 0.162], &[0.225, 0.162, 0.126]];
    let large = transport(&costs, &[350.0, 600.0], &[325.0, 300.0, 275.0]);
    for plan in [[50.0, 300.0, 0.0, 275.0, 0.0, 275.0], [0.0, 300.0, 0.0, 325.0, 0.0, 275.0]] {
        let x = [&plan[..], &[0.0, 0.0, 0.225, 0.153, 0.126]].concat();
        assert_eq!(verdict(&large, &x)["verdict"], "proved", "{x:?}");
    }
    for problem in [small, large] {
        let output = run_with(&problem, &["prove", "-"]);
        let proof: Value = serde_json::from_str(&out(&output)).unwrap();
        assert_eq!(proof["kind"], "not-unique", "{proof}");
    }
}

/// Siconos: bounds follow a relay problem's numbers; bodies precede those of contacts.
/// M v = H r + q with M = 2, H = 1 and q = 0: A = ½ and b = (−4, −1, ½), so the contact sticks with
/// r = (8, 2, −1), inside the cone μ r_n = 4.
#[test]
fn files_of_siconos_are_read_as_the_problem_that_they_state() {
    let folder = Folder::new();
    let relay = "2\n0\n2\n2\n2 2\n2.0 0.5\n0.5 1.0\n-3.0 1.0\n-1.0 -1.0\n1.0 1.0\n";
    let solved = json("", &["solve", &folder.file("relay.dat", relay)]);
    assert_eq!(numbers(&solved["x"]), [1.0, -1.0], "{solved}");
    let square = |d: f64| format!("0\n3\n3\n3 3\n{d} 0 0\n0 {d} 0\n0 0 {d}\n");
    let global = format!("3\n1\n{}{}0 0 0 -4 -1 0.5\n0.5\n", square(2.0), square(1.0));
    let solved = json("", &["solve", &folder.file("global.dat", &global)]);
    assert_eq!(numbers(&solved["x"]), [8.0, 2.0, -1.0], "{solved}");
}

/// An unsymmetric A, as gyroscopic terms cause: w_n = 0, and x_t opposes the sliding velocity w_t
/// at the cone's limit, recomputed from A x + b.
#[test]
fn a_cone_with_an_unsymmetric_matrix_is_solved() {
    let (a, b) = ([[2.0, 0.30002, -0.2], [0.3, 1.5, 0.09999], [-0.2, 0.1, 1.2]], [-1.0, -0.8, 0.9]);
    let more = r#""friction_index": [-1, 0, 0], "mu": [0, 0.4, 0.4], "model": "coulomb-cone""#;
    let rows: Vec<&[f64]> = a.iter().map(<[f64; 3]>::as_slice).collect();
    let solved = json(&problem(&rows, &b, more), &["solve", "-"]);
    let x = numbers(&solved["x"]);
    let w: Vec<f64> = (0..3).map(|i| b[i] + (0..3).map(|j| a[i][j] * x[j]).sum::<f64>()).collect();
    let (strength, slip) = (x[1].hypot(x[2]), w[1].hypot(w[2]));
    assert!(x[0] > 0.1 && slip > 0.1, "{solved}");
    assert_near(w[0], 0.0, 1e-7);
    assert_near(strength, 0.4 * x[0], 1e-7);
    assert_near(x[1] * w[1] + x[2] * w[2], -strength * slip, 1e-7);
}

/// Answers under other friction laws than the box, by hand: w_n = 0 and x_t opposite to w_t at the
/// cone's limit (5 = 1 · 5), or inside the diamond |x_t1| + |x_t2| = 5.
#[test]
fn answers_to_cones_and_polygons_are_accepted_under_their_own_law() {
    let friction = |model: &str| {
        format!(r#""friction_index": [-1, 0, 0], "mu": [0, 1, 1], "model": "{model}""#)
    };
    let polygon = problem(
        &[&[18.0, -18.0, -12.0], &[-18.0, 18.0, 12.0], &[-12.0, 12.0, 10.0]],
        &[-12.0, 11.5, 3.5],
        &friction("polygon-4"),
    );
    let cone = problem(
        &[&[8.0, 12.0, -4.0], &[12.0, 27.0, 3.0], &[-4.0, 3.0, 11.0]],
        &[-60.0, -154.5, -35.0],
        &friction("coulomb-cone"),
    );
    for (problem, x) in [(polygon, [5.0, 3.0, 2.0]), (cone, [5.0, 3.0, 4.0])] {
        assert_eq!(verdict(&problem, &x)["verdict"], "proved", "{problem}");
        let proof = run_with(&problem, &["prove", "-"]);
        assert!(!out(&proof).contains("\"no-solution\""), "{}", out(&proof));
    }
}

/// A proof with a negative distance is no proof file: one line, exit code 2.
#[test]
fn a_proof_with_a_negative_distance_is_rejected_in_one_line() {
    let folder = Folder::new();
    let one = folder.file("one.json", &problem(&[&[2.0]], &[-1.0], ""));
    let proof = folder.file("one.proof.json", "");
    let x = folder.file("x.json", r#"{"x": [0.5]}"#);
    assert_eq!(
        run(&["prove", &one, &x, "--kind", "solution", "--out", &proof]).status.code(),
        Some(0)
    );
    let text = std::fs::read_to_string(&proof).unwrap();
    assert!(text.contains("\"distance\":0.0"), "{text}");
    std::fs::write(&proof, text.replace("\"distance\":0.0", "\"distance\":-1.0")).unwrap();
    let output = run(&["check", &one, &proof]);
    assert_eq!(output.status.code(), Some(2));
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(message.lines().count(), 1, "{message}");
}

/// The iteration matrix of Gauss-Seidel has the spectral radius 0.29 in any units (NumPy), so
/// nothing is called slow.
#[test]
fn units_do_not_make_sweeps_slow() {
    let found = out(&run_with(&units(), &["diagnose", "-"]));
    assert!(found.contains("The problem is well posed"), "{found}");
    assert!(!found.contains("slow") && !found.contains('∞'), "{found}");
}
