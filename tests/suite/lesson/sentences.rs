//! Sentences of the lessons that no cell can hold: what plots show, and formulas with other
//! numbers.

use std::f64::consts::PI;
use std::fs;
use std::path::Path;

use lcplab::body::Mass;
use lcplab::judge::{Demand, judge};
use lcplab::lcp::{Coupling, Lcp, Matrix, library};
use lcplab::scene::{Scene, Scheme};
use lcplab::simulation::Simulation;
use lcplab::solver::theory::optimal_omega;
use lcplab::solver::{Options, Pgs, Registry, Settings, Solver, Start, all_solutions};
use lcplab::trace;
use serde_json::Value;

use super::written;

/// The plots of curves in the notebooks: the notebook's name and the SVG.
fn plots() -> Vec<(String, String)> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("notebooks");
    let mut plots = Vec::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_stem().unwrap().to_string_lossy().into_owned();
        if path.extension().is_none_or(|end| end != "md") || !name.starts_with(char::is_numeric) {
            continue;
        }
        let notebook: Value = serde_json::from_str(&written(&name)).unwrap();
        let outputs = notebook["cells"].as_array().unwrap().iter();
        for output in outputs.filter_map(|cell| cell["outputs"].as_array()).flatten() {
            let svg = match &output["data"]["image/svg+xml"] {
                Value::String(text) => text.clone(),
                Value::Array(lines) => lines.iter().filter_map(Value::as_str).collect(),
                _ => continue,
            };
            if svg.contains("class=\"panel\"") {
                plots.push((name.clone(), svg));
            }
        }
    }
    plots
}

/// The text between two others.
fn between<'a>(text: &'a str, from: &str, to: &str) -> &'a str {
    let rest = text.split_once(from).unwrap_or_else(|| panic!("no {from}")).1;
    rest.split_once(to).unwrap_or_else(|| panic!("no {to}")).0
}

#[test]
fn every_plot_has_theory_or_a_known_value() {
    let plots = plots();
    assert!(plots.len() > 25, "{}", plots.len());
    for (name, svg) in plots {
        let words = between(&svg, "<desc", "</desc>");
        let id = between(&svg, " id=\"", "\"");
        assert!(
            words.contains("(theory, ") || words.contains("(reference, "),
            "{name}, {id}: measured curves alone"
        );
    }
}

#[test]
fn the_axes_contain_the_least_factor_at_the_best_omega() {
    let plots = plots();
    let (_, svg) = plots
        .iter()
        .find(|(name, svg)| name.starts_with("05") && svg.contains(" id=\"omega-title\""))
        .expect("the plot of ω");
    let holds = |axis: &str, value: f64| {
        let words: Vec<&str> = between(svg, &format!(" data-{axis}=\""), "\"").split(' ').collect();
        assert_eq!(words[0], "linear");
        let ends: Vec<f64> = words[1..].iter().map(|end| end.parse().unwrap()).collect();
        assert!(ends[0] < value && value < ends[1], "{axis}: {value} is not in {ends:?}");
    };
    let best = optimal_omega((PI / 20.0).cos()); // ten bodies
    holds("x", best);
    holds("y", best - 1.0);
}

#[test]
fn the_entries_of_rods_at_right_angles_fill_in_as_a_net_sags() {
    let mut net = Simulation::new(
        Scene::load("net").unwrap(),
        Registry::standard().entry("dantzig").unwrap().build(&Options::default()),
    );
    let mut nonzero = || net.step().unwrap().solves[0].problem.lcp.matrix().pattern().len();
    // Flat: the diagonal, and the pairs in line: two at each mass inside, one at an edge.
    assert_eq!(nonzero(), 764 + 2 * (2 * 324 + 72));
    let later = (0..20).map(|_| nonzero()).last().unwrap();
    let may = 764 + 324 * 12 + 72 * 6 + 4 * 6;
    assert!(later > 2700 && later <= may, "{later} of {may}");
}

/// The x of the first step, divided by dt at velocity level (N).
fn first_force(mut scene: Scene, level: Scheme) -> f64 {
    (scene.step.scheme, scene.step.baumgarte, scene.step.alpha) = (level, 0.0, 0.0);
    let unit = if level == Scheme::Velocity { scene.step.dt } else { 1.0 };
    let mut simulation = Simulation::new(
        scene,
        Registry::standard().entry("dantzig").unwrap().build(&Options::default()),
    );
    let step = simulation.step().unwrap();
    step.solves[step.solves.len() - 1].solution.x[0] / unit
}

#[test]
fn a_rod_lacks_m_l_times_the_rate_squared_in_its_first_step() {
    let (m, l, g, angle, rate) = (3.0, 2.0, 9.81, 0.7_f64, 1.3);
    let text = format!(
        "[step]\ndt = 0.01\n\
         [[bodies]]\nname = \"bob\"\nshape = \"point\"\nmass = {m:?}\nposition = [{x}, 0, {z}]\n\
         velocity = [{vx}, 0, {vz}]\n\
         [[constraints]]\nkind = \"distance\"\nbodies = [\"bob\"]\npoints = [[0, 0, 0], [{x}, 0, {z}]]\n",
        x = l * angle.sin(),
        z = -l * angle.cos(),
        vx = l * rate * angle.cos(),
        vz = l * rate * angle.sin(),
    );
    let scene = Scene::from_toml("pendulum.toml", &text).unwrap();
    let holds = m * g * angle.cos();
    let bends = m * l * rate * rate;
    let velocity = first_force(scene.clone(), Scheme::Velocity);
    let acceleration = first_force(scene, Scheme::Acceleration);
    assert!((-velocity - holds).abs() < 1e-9, "{velocity} N");
    assert!((-acceleration - (holds + bends)).abs() < 1e-9, "{acceleration} N");
}

#[test]
fn rounds_of_fixed_bounds_solve_about_half_of_the_random_piles_of_lesson_11_and_sweeps_most() {
    let solved = |solver: &str| {
        let solver = Registry::standard().entry(solver).unwrap().build(&Options::default());
        let is_solved = |seed: &u32| {
            let given = [("bodies", 10.0), ("contacts", 20.0), ("seed", f64::from(*seed))];
            let pile = library::by_name("friction-pile").unwrap().generate(&given).unwrap().lcp;
            let x = solver.solve(&pile, &Start::default(), &mut ()).x;
            judge(&pile, &x, &Demand::default()).verdict.is_solution()
        };
        (1..=40).filter(is_solved).count()
    };
    let (rounds, sweeps) = (solved("dantzig"), solved("pgs"));
    assert!((14..=26).contains(&rounds) && sweeps >= 30, "{rounds}, {sweeps}");
}

#[test]
fn the_force_of_an_impact_is_m_times_the_speed_over_dt_and_the_weight() {
    let (m, v, g) = (2.0, 3.0, 9.81);
    for dt in [0.1, 0.001] {
        let mut scene = Scene::load("fig6").unwrap();
        (scene.gravity.z, scene.step.dt) = (-g, dt);
        scene.bodies[1].mass = Mass::Point { mass: m };
        scene.states[1].v.z = -v;
        let force = first_force(scene, Scheme::Velocity);
        assert!((force - m * (v / dt + g)).abs() < 1e-9, "dt = {dt}: {force} N");
    }
}

/// A contact that slides against t: A of lesson 13 at tan θ = 2, and a push that keeps it sliding.
#[test]
fn sweeps_of_the_pulled_rod_of_lesson_11_alternate_without_end_although_it_has_one_answer() {
    let matrix = Matrix::dense(2, &[1.6, -1.2, -1.2, 3.4]);
    let coupling = Coupling::new(vec![None, Some(0)], vec![0.0, 1.5]);
    let bounds = (vec![0.0, f64::NEG_INFINITY], vec![f64::INFINITY; 2]);
    let rod = Lcp::new(matrix, vec![-0.01, 5.0], bounds.0, bounds.1).unwrap();
    let rod = rod.with_coupling(coupling.unwrap()).unwrap();
    let answers = all_solutions(&rod).unwrap();
    assert_eq!(answers.len(), 1);
    assert!((answers[0][0].to_f64().value() - 0.01 / 3.4).abs() < 1e-15);
    let mut path = trace::Path::default();
    let settings = Settings::default().with_tolerance(0.0).with_max_iterations(1000);
    Pgs { settings, ..Pgs::default() }.solve(&rod, &Start::default(), &mut path);
    for (sweep, x) in path.points.iter().enumerate() {
        let expected = if sweep % 2 == 1 { 0.01 / 1.6 } else { 0.0 };
        assert!((x[0] - expected).abs() < 1e-15, "sweep {sweep}: {x:?}");
    }
}
