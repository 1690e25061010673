//! From physics to the LCP and back.

use lcplab_lcp::file::Problem as File;
use lcplab_mechanics::assembly::{Assembly, ConstraintFilter};
use lcplab_mechanics::formulation::{Problem, Stage};
use lcplab_mechanics::scene::catalogue::SHIPPED;
use lcplab_mechanics::scene::{Scene, step_contacts};
use lcplab_mechanics::simulation::Simulation;
use nalgebra::{DMatrix, DVector};

fn problem(scene: &Scene) -> Problem {
    let found = step_contacts(scene, &scene.states);
    let assembly = Assembly::new(scene, &scene.states, &found, ConstraintFilter::Near).unwrap();
    Problem::velocity(scene, assembly).unwrap()
}

#[test]
fn the_lcp_of_figure_7_is_the_chapters() {
    let problem = problem(&Scene::load("fig7").unwrap());
    let expected =
        DMatrix::from_row_slice(3, 3, &[1.0, -1.0, 0.0, -1.0, 2.0, -1.0, 0.0, -1.0, 2.0]);
    assert_eq!(problem.lcp.matrix().to_dense(), expected);
    assert_eq!(problem.lcp.b(), [-1.0, -1.0, 1.0]); // errata, Figure 7, g = dt = 1
    let rest = problem.next_velocity(&[4.0, 3.0, 1.0], 1.0);
    assert!(rest.iter().all(|&u| u == 0.0), "{rest:?}");
}

#[test]
fn a_equals_the_product_of_dense_matrices_and_is_symmetric_to_the_last_bit() {
    for name in ["stack", "net", "ball_chain", "incline"] {
        let problem = problem(&Scene::load(name).unwrap());
        let (n, k) = (problem.lcp.len(), problem.assembly.columns());
        let mut j = DMatrix::zeros(n, k);
        for i in 0..n {
            for (column, value) in problem.assembly.jacobian_row(i) {
                j[(i, column)] = value;
            }
        }
        let mut m = DMatrix::zeros(k, k);
        for (row, column, value) in problem.gauss(&vec![0.0; n]).mass {
            (m[(row, column)], m[(column, row)]) = (value, value);
        }
        let product = &j * m.cholesky().expect("M is positive definite").inverse() * j.transpose();
        let a = problem.lcp.matrix().to_dense();
        assert!((&product - &a).norm() < 1e-10 * a.norm(), "{name}");
        assert!(problem.lcp.matrix().is_symmetric(), "{name}");
    }
}

#[test]
fn the_net_is_sparse_and_small_problems_are_dense() {
    let net = problem(&Scene::load("net").unwrap());
    let fill = net.lcp.matrix().stored() as f64 / 764f64.powi(2);
    assert!(fill < 0.012, "{fill}");
    assert_eq!(problem(&Scene::load("fig7").unwrap()).lcp.matrix().stored(), 9);
}

#[test]
fn n_rods_between_free_points_give_tridiagonal_minus_one_two_minus_one() {
    let mut text = String::new();
    for k in 0..=6 {
        text += &format!(
            "[[bodies]]\nname = \"p{k}\"\nshape = \"point\"\nmass = 1\nposition = [{k}, 0, 0]\n"
        );
    }
    for k in 0..6 {
        text +=
            &format!("[[constraints]]\nkind = \"distance\"\nbodies = [\"p{k}\", \"p{}\"]\n", k + 1);
    }
    let a = problem(&Scene::from_toml("rods.toml", &text).unwrap()).lcp.matrix().to_dense();
    let expected = DMatrix::from_fn(6, 6, |i: usize, j: usize| match i.abs_diff(j) {
        0 => 2.0,
        1 => -1.0,
        _ => 0.0,
    });
    assert_eq!(a, expected);
}

#[test]
fn b_is_the_row_velocity_of_the_unconstrained_motion_plus_the_bias() {
    let mut scene = Scene::load("sphere_plane").unwrap();
    scene.states[1].pose.p.z += 0.02; // a gap of 0.02 m enters as c/dt, in full
    let gap = problem(&scene);
    let expected = -9.81 * 0.01 + 0.02 / 0.01;
    assert!((gap.lcp.b()[0] - expected).abs() < 1e-12);

    scene.states[1].pose.p.z -= 0.03; // 0.01 m of overlap, of which slop forgives 0.004 m
    (scene.step.baumgarte, scene.contact.slop) = (0.2, 0.004);
    let overlap = problem(&scene);
    let expected = -9.81 * 0.01 + 0.2 / 0.01 * (-0.01 + 0.004);
    assert!((overlap.lcp.b()[0] - expected).abs() < 1e-12);
}

#[test]
fn the_primal_data_describe_the_same_motion() {
    // Stationarity of Gauss's principle: M (u⁺ − u*) = Jᵀ x.
    let problem = problem(&Scene::load("incline").unwrap());
    let x: Vec<f64> = (0..problem.lcp.len()).map(|i| 0.1 * i as f64).collect();
    let gauss = problem.gauss(&x);
    let k = gauss.target.len();
    let mut m = DMatrix::zeros(k, k);
    for &(i, j, value) in &gauss.mass {
        (m[(i, j)], m[(j, i)]) = (value, value);
    }
    let u = DVector::from_vec(problem.motion(&x));
    let left = m * (u - DVector::from_column_slice(&gauss.target));
    let right = DVector::from_vec(problem.assembly.pull_back(&x));
    assert!((left - right).norm() < 1e-12);
    let by_rows: f64 = gauss.jacobian[1].iter().map(|&(j, value)| value * gauss.target[j]).sum();
    assert!((by_rows + gauss.bias[1] - problem.lcp.b()[1]).abs() < 1e-13);
}

#[test]
fn multipliers_have_the_unit_of_their_stage() {
    let units = |stage: Stage| [false, true].map(|is_angular| stage.unit(is_angular));
    assert_eq!(units(Stage::Velocity), ["N s", "N m s"]);
    assert_eq!(units(Stage::Acceleration), ["N", "N m"]);
    assert_eq!(units(Stage::Position), ["kg m", "kg m²"]);
}

#[test]
fn the_bodies_in_an_exported_file_give_its_a_and_b() {
    let mut compared = 0;
    for shipped in SHIPPED {
        let mut simulation = Simulation::of(&shipped.scene().unwrap()).unwrap();
        let Ok(step) = simulation.step() else { continue };
        for solve in step.solves.iter().filter(|solve| solve.problem.lcp.len() <= 120) {
            let text = solve.exported(simulation.scene(), 1).to_json().to_string();
            let File { lcp, motion, .. } = File::parse(&text, shipped.name).unwrap();
            let Some(motion) = motion else {
                assert!(!solve.problem.slides.is_empty(), "{}", shipped.name);
                continue;
            };
            let (n, k) = (lcp.len(), motion.target.len());
            let mut m = DMatrix::zeros(k, k);
            for (i, j, value) in motion.mass {
                (m[(i, j)], m[(j, i)]) = (value, value);
            }
            let mut j = DMatrix::zeros(n, k);
            for (i, row) in motion.jacobian.iter().enumerate() {
                row.iter().for_each(|&(column, value)| j[(i, column)] = value);
            }
            let inverse = m.cholesky().expect("M is positive definite").inverse();
            let soft = DMatrix::from_diagonal(&DVector::from_vec(motion.compliance));
            let a = &j * inverse * j.transpose() + soft;
            let b = &j * DVector::from_vec(motion.target) + DVector::from_vec(motion.bias);
            let (file_a, file_b) = (lcp.matrix().to_dense(), DVector::from_column_slice(lcp.b()));
            assert!((&a - &file_a).amax() <= 1e-12 * file_a.amax(), "{}", shipped.name);
            let size = 1e-12 * (j.amax() + file_b.amax());
            assert!((&b - &file_b).amax() <= size, "{}", shipped.name);
            compared += 1;
        }
    }
    assert!(compared > 40, "{compared}");
}
