//! Sliding friction at acceleration level, and Painlevé's rod.

use lcplab_judge::ray::refute;
use lcplab_mechanics::assembly::{Assembly, ConstraintFilter};
use lcplab_mechanics::formulation::{Problem, Slide};
use lcplab_mechanics::scene::{Scene, Scheme, Sliding, contacts};
use lcplab_mechanics::simulation::Cause;
use lcplab_solver::{Enumeration, Settings, Solver, Start, Status};

use super::{assert_near, scene, simulation};

const G: f64 = 9.81;

/// The force LCP of a scene at its start.
fn problem(scene: &Scene) -> Problem {
    let found = contacts(scene, &scene.states, scene.resting().gap);
    let assembly = Assembly::new(scene, &scene.states, &found, ConstraintFilter::Resting).unwrap();
    let slides = Slide::all(&assembly, scene.contact.sticking_speed);
    Problem::sliding(scene, assembly, slides).unwrap()
}

#[test]
fn the_rod_s_own_friction_makes_its_diagonal_negative() {
    // A thin rod: m A_nn = 1 + 3 cos² − 3 μ sin cos = 1.6 − 1.2 μ at tan = 2, negative for μ > 4/3.
    // With the thickness 2w the lower corners are at (l cos − w sin, ±w, −l sin − w cos), and
    // I = m (l² + w²)/3.
    let rod = scene("painleve", Scheme::Acceleration);
    let problem = problem(&rod);
    let (l, w, mu) = (0.5, 0.01, 1.5);
    let (sin, cos) = (2f64 / 5f64.sqrt(), 1.0 / 5f64.sqrt());
    let (rx, rz) = (l * cos - w * sin, -l * sin - w * cos);
    let inertia = (l * l + w * w) / 3.0;
    let expected = 1.0 + (rx * rx + mu * rx * rz) / inertia;
    assert!(expected < 0.0);
    assert_eq!(problem.slides.len(), 2);
    let normals: Vec<usize> = problem.slides.iter().map(|slide| slide.normal).collect();
    let a = |i: usize, j: usize| problem.lcp.matrix().entry(normals[i], normals[j]);
    // The part perpendicular to the rod has the opposite sign for the other corner: it cancels in
    // the sum.
    assert_near(0.5 * (a(0, 0) + a(0, 1)), expected, 1e-12);
    assert_near(problem.lcp.b()[normals[0]], -G, 1e-12);
}

#[test]
fn at_acceleration_level_the_rod_has_no_solution_and_the_failure_proves_it() {
    let rod = scene("painleve", Scheme::Acceleration);
    let problem = problem(&rod);
    let failure = simulation(rod).step().unwrap_err();
    let Cause::NoSolution { row, proof } = &failure.cause else { panic!("{failure}") };
    // Both vertices of the lower end have equal forces.
    let touching =
        ["vertex 0", "vertex 1"].map(|end| format!("normal ground rod 0 at face 0 on {end}"));
    assert!(failure.step == 1 && touching.contains(row), "{failure}");
    assert!(failure.to_string().contains("no forces satisfy"), "{failure}");
    // The proof again: dᵀA ≤ 0 in every row that can push, bᵀd < 0.
    let proof = proof.as_ref().expect("a vector");
    let d: Vec<f64> = proof.vector.iter().map(|d| d.to_f64().value()).collect();
    let n = problem.lcp.len();
    for j in 0..n {
        let product: f64 = (0..n).map(|i| d[i] * problem.lcp.matrix().entry(i, j)).sum();
        assert!(product <= 0.0 || problem.lcp.hi()[j] == 0.0, "column {j}: {product}");
        assert!(d[j] == 0.0 || problem.lcp.hi()[j] == f64::INFINITY);
    }
    assert!(problem.lcp.b().iter().zip(&d).map(|(b, d)| b * d).sum::<f64>() < 0.0);
    // And without a proof: all active sets, exactly.
    let all = Enumeration { settings: Settings::default() };
    let answer = all.solve(&problem.lcp, &Start::default(), &mut ());
    assert_eq!(answer.status, Status::NoSolution);
}

#[test]
fn below_the_critical_friction_the_rod_slides_on() {
    let mut rod = scene("painleve", Scheme::Acceleration);
    for body in &mut rod.bodies {
        body.friction = 1.2;
    }
    assert!(refute(&problem(&rod).lcp, 0, &[1.0, 0.0, 0.0, 0.0, 0.0, 0.0]).is_none());
    let mut rod = simulation(rod);
    for _ in 0..20 {
        for solve in rod.step().unwrap().solves {
            assert_eq!(solve.solution.status, Status::Solved);
        }
    }
    assert!(rod.states()[1].v.x > 0.0);
}

#[test]
fn the_velocity_level_steps_through_it() {
    let mut rod = simulation(scene("painleve", Scheme::Velocity));
    let before = rod.motion().energy();
    for _ in 0..300 {
        let step = rod.step().unwrap();
        for solve in step.solves {
            assert_eq!(solve.solution.status, Status::Solved, "step {}", step.number);
        }
        assert!(step.motion.penetration < 1e-3, "{}", step.motion.penetration);
    }
    assert!(rod.motion().energy() < before);
}

/// A block that slides at 45° between the tangents; its speed after a time.
fn diagonal(sliding: Sliding, time: f64) -> f64 {
    let text = "
        [step]
        scheme = \"acceleration\"
        [contact]
        friction = 0.2
        [[bodies]]
        name = \"ground\"
        fixed = true
        shape = { plane = [0, 0, 1] }
        [[bodies]]
        name = \"ball\"
        shape = { sphere = 0.5 }
        mass = 2
        inertia = [1e6, 1e6, 1e6]
        position = [0, 0, 0.5]
        velocity = [3, 3, 0]
    ";
    let mut scene = Scene::from_toml("diagonal.toml", text).unwrap();
    scene.contact.sliding = sliding;
    let mut ball = simulation(scene);
    for _ in 0..(time / 0.01).round() as usize {
        ball.step().unwrap();
    }
    ball.states()[1].v.norm()
}

#[test]
fn substituted_friction_is_the_same_in_every_direction_and_the_box_is_not() {
    let start = 18f64.sqrt();
    assert_near(diagonal(Sliding::Substituted, 1.0), start - 0.2 * G, 1e-4);
    assert_near(diagonal(Sliding::Box, 1.0), start - 2f64.sqrt() * 0.2 * G, 1e-4);
    // It stops without jitter: 4.24 m/s at 1.96 m/s² lasts 2.16 s. The heavy rotating ball then
    // rolls, with v m r²/(I + m r²).
    let rolling = start * 0.5 / (1e6 + 0.5);
    assert!((diagonal(Sliding::Substituted, 2.5) - rolling).abs() < 1e-9);
}

#[test]
fn on_a_slope_both_models_slide_alike() {
    let speed = |sliding| {
        let mut incline = scene("incline", Scheme::Acceleration);
        incline.contact.sliding = sliding;
        incline.states[1].v =
            nalgebra::Vector3::new(20f64.to_radians().cos(), 0.0, -20f64.to_radians().sin());
        let mut incline = simulation(incline);
        for _ in 0..50 {
            incline.step().unwrap();
        }
        incline.states()[1].v.norm()
    };
    let theta = 20f64.to_radians();
    let exact = 1.0 + 0.5 * G * (theta.sin() - 0.3 * theta.cos());
    assert_near(speed(Sliding::Box), exact, 1e-6);
    assert_near(speed(Sliding::Substituted), exact, 1e-6);
}
