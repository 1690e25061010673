//! The chapter's demonstrations, and those of Solver2D with joints: the statements of each scene
//! must hold.

use lcplab_mechanics::assembly::{Row, Source};
use lcplab_mechanics::body::{State, alignment};
use lcplab_mechanics::constraint::{Bounds, Kind};
use lcplab_mechanics::scene::Scheme;
use lcplab_mechanics::scene::generate::{Bridge, Rope};
use lcplab_mechanics::simulation;
use lcplab_mechanics::simulation::{Simulation, Step};
use lcplab_solver as solver;
use lcplab_solver::{Options, Settings, Status};
use nalgebra::{Vector2, Vector3};

use super::{assert_near, scene, simulation, x};

const G: f64 = 9.81;

/// The rows of the last solve with their forces (N), at either level.
fn forces(step: &Step, dt: f64) -> Vec<(Row, f64)> {
    let problem = &step.solves.last().unwrap().problem;
    let scale = if problem.stage.unit(false) == "N" { 1.0 } else { 1.0 / dt };
    problem.assembly.rows.iter().cloned().zip(x(step).iter().map(|x| x * scale)).collect()
}

#[test]
fn constraints_that_fight_are_named() {
    // Figure 8: both nails along x and the rod; the nails along y and z are not involved.
    let fighting =
        ["coincidence world left 0", "coincidence world right 0", "distance left right 0"];
    for level in Scheme::LEVELS {
        for name in ["dantzig", "lemke", "pgs"] {
            let scene = scene("fig8", level);
            let solver =
                solver::Registry::standard().entry(name).unwrap().build(&Options::default());
            let mut fight = Simulation::new(scene.clone(), solver);
            let step = fight.step().unwrap();
            assert_eq!(step.solves[0].conflict(&scene), fighting, "{name} {level:?}");
        }
    }
}

#[test]
fn constraints_that_fight_stop_as_soon_as_one_is_gone() {
    for gone in 0..3 {
        let mut scene = scene("fig8", Scheme::Velocity);
        scene.constraints.remove(gone);
        let step = simulation(scene.clone()).step().unwrap();
        assert_eq!(step.solves[0].solution.status, Status::Solved);
        assert!(step.solves[0].conflict(&scene).is_empty());
    }
}

#[test]
fn sweeps_find_no_best_fit_where_constraints_fight() {
    // E61: x grows by half of the rod's demand, β c/dt = 0.2 · 2/0.01 = 40 m/s, in every sweep.
    let largest = [10, 100, 1000].map(|sweeps| {
        let settings =
            Settings::default().with_max_iterations(sweeps).with_tolerance(0.0).with_check_every(1);
        let options = Options::default().with_settings(settings);
        let pgs = solver::Registry::standard().entry("pgs").unwrap().build(&options);
        let mut fight = Simulation::new(scene("fig8", Scheme::Velocity), pgs);
        x(&fight.step().unwrap()).iter().fold(0.0, |m: f64, x| m.max(x.abs()))
    });
    assert_near(largest[1] - largest[0], 20.0 * 90.0, 1e-9);
    assert_near(largest[2] - largest[1], 20.0 * 900.0, 1e-9);
}

#[test]
fn a_rope_pulls_with_the_forces_of_the_discrete_catenary() {
    let rope = Rope { links: 20, length: 3.0, span: 2.0, mass: 0.1 };
    let (slopes, kappa) = rope.catenary();
    let pull = rope.mass * G / kappa; // H
    for level in Scheme::LEVELS {
        let mut hanging = simulation(scene("rope", level));
        let before = hanging.states().to_vec();
        for _ in 0..20 {
            let step = hanging.step().unwrap();
            for ((_, force), slope) in forces(&step, 0.005).iter().zip(&slopes) {
                assert_near(*force, -pull * slope.hypot(1.0), 1e-9);
            }
        }
        for (was, is) in before.iter().zip(hanging.states()) {
            assert!((was.pose.p - is.pose.p).norm() < 1e-9);
            assert_eq!(is.pose.p.y, 0.0);
        }
    }
}

#[test]
fn a_figure_of_points_stays_in_its_plane_to_the_last_bit() {
    for level in Scheme::LEVELS {
        let mut figure = simulation(scene("figure", level));
        let start = figure.motion().energy();
        for _ in 0..750 {
            let step = figure.step().unwrap();
            assert!(step.states.iter().all(|state| state.pose.p.y == 0.0 && state.v.y == 0.0));
            assert!(step.motion.drift < 0.01);
        }
        assert!(figure.motion().kinetic > 10.0); // it swings
        assert_near(figure.motion().energy(), start, 0.02);
    }
}

#[test]
fn three_points_tell_how_far_they_have_turned() {
    // 2 rad/s for a second about z; the error is of the order of dt.
    let error = |dt: f64| {
        let mut scene = scene("three_points", Scheme::Velocity);
        scene.step.dt = dt;
        let mut triangle = simulation(scene);
        let points = |triangle: &Simulation| -> Vec<Vector3<f64>> {
            triangle.states().iter().map(|state| state.pose.p).collect()
        };
        let before = points(&triangle);
        for _ in 0..(1.0 / dt).round() as usize {
            triangle.step().unwrap();
        }
        let turned = alignment(&before, &points(&triangle)).unwrap().scaled_axis();
        assert!(turned.xy().norm() < 1e-12);
        (turned.z - 2.0).abs()
    };
    let (coarse, fine) = (error(0.01), error(0.005));
    assert!(coarse < 0.02 && fine < 0.6 * coarse, "{coarse} {fine}");
}

#[test]
fn each_bank_carries_half_of_the_bridge() {
    let (planks, mass) = (12, 20.0);
    let bridge = Bridge { planks, size: [0.5, 1.0, 0.1], span: 5.6, mass };
    let pull = mass * G / bridge.rope().catenary().1;
    for level in Scheme::LEVELS {
        let mut bridge = simulation(scene("bridge", level));
        for _ in 0..20 {
            let mut banks = [Vector2::zeros(); 2];
            for (row, force) in forces(&bridge.step().unwrap(), 0.005) {
                let Source::Constraint(k) = row.id.source else { panic!("a contact") };
                if row.bodies[0].is_none() {
                    let part = row.parts().next().unwrap().jacobian;
                    banks[usize::from(k > 0)] += force * Vector2::new(part[0], part[2]);
                }
            }
            for (bank, side) in banks.iter().zip([-1.0, 1.0]) {
                assert_near(bank.y, 0.5 * planks as f64 * mass * G, 1e-9);
                assert_near(bank.x, side * pull, 1e-9);
            }
        }
        assert!(bridge.motion().kinetic < 1e-12);
    }
}

#[test]
fn a_net_holds_a_ball_that_no_point_enters() {
    let mut net = simulation(scene("sphere_net", Scheme::Velocity));
    let ball = net.scene().body("ball").unwrap();
    let nodes = |states: &[State]| {
        let all: Vec<_> = states.iter().map(|state| state.pose.p).collect();
        (0..all.len()).filter(move |&k| k != ball).map(move |k| all[k])
    };
    let mut touched = 0;
    for _ in 0..100 {
        let step = net.step().unwrap();
        let centre = step.states[ball].pose.p;
        let nearest =
            nodes(&step.states).map(|p| (p - centre).norm()).fold(f64::INFINITY, f64::min);
        assert!(nearest > 0.25 - 1e-9, "{nearest}");
        assert!(step.motion.drift < 0.01);
        touched += usize::from(nearest < 0.25 + 1e-4);
    }
    assert!(touched > 20, "{touched}");
    let lowest = nodes(net.states()).map(|p| p.z).fold(f64::INFINITY, f64::min);
    assert!(net.states()[ball].pose.p.z > lowest); // caught
}

#[test]
fn a_ragdoll_keeps_together_and_no_limb_bends_the_wrong_way() {
    let mut doll = simulation(scene("ragdoll", Scheme::Velocity));
    let start = doll.motion().energy();
    for _ in 0..650 {
        let step = doll.step().unwrap();
        assert!(step.motion.drift < 1e-3, "{}", step.motion.drift);
        assert!(step.motion.penetration < 1e-3);
        for constraint in &doll.scene().constraints {
            let states = constraint.bodies().map(|body| &step.states[body.unwrap()]);
            for row in constraint.rows(states).unwrap() {
                assert!(row.bounds != Bounds::Unilateral || row.c > -0.02, "{constraint:?}");
            }
        }
    }
    assert!(doll.motion().energy() < 0.2 * start); // it lies
}

#[test]
fn the_catapult_throws_with_the_energy_of_its_weight() {
    let mut catapult = simulation(scene("catapult", Scheme::Velocity));
    let ball = catapult.scene().body("ball").unwrap();
    let mut fastest = 0.0f64;
    let mut highest = 0.0f64;
    for _ in 0..500 {
        let step = catapult.step().unwrap();
        let state = step.states[ball];
        if step.states[catapult.scene().body("arm").unwrap()].omega.norm() < 1e-9 {
            fastest = fastest.max(state.v.norm());
        }
        highest = highest.max(state.pose.p.z);
        assert!(step.motion.drift < 1e-3);
    }
    // Mass, its position along the arm and perpendicular to it from the hinge, and its own moment
    // of inertia.
    let parts = [
        (5.0, 0.6, 0.0, 5.0 * (2.4f64.powi(2) + 0.05f64.powi(2)) / 12.0),
        (30.0, -0.6, 0.0, 30.0 * 2.0 * 0.4f64.powi(2) / 12.0),
        (0.1, 1.72, 0.075, 0.1 * (0.04f64.powi(2) + 0.1f64.powi(2)) / 12.0),
        (1.0, 1.6, 0.125, 0.0), // without friction the ball does not turn
    ];
    let height = |r: f64, u: f64, angle: f64| r * angle.sin() + u * angle.cos();
    let (from, to) = (-25f64.to_radians(), 50f64.to_radians());
    let fall: f64 =
        parts.iter().map(|(m, r, u, _)| m * G * (height(*r, *u, from) - height(*r, *u, to))).sum();
    let inertia: f64 = parts.iter().map(|(m, r, u, own)| m * (r * r + u * u) + own).sum();
    let omega = (2.0 * fall / inertia).sqrt();
    assert_near(fastest, omega * 1.6f64.hypot(0.125), 0.01);
    assert!(highest > 3.0);
}

#[test]
fn joints_of_a_chain_carry_all_that_hangs_on_them() {
    for level in Scheme::LEVELS {
        let mut chain = simulation(scene("ball_and_chain", level));
        for _ in 0..3 {
            let mut tension = [0.0f64; 41];
            for (row, force) in forces(&chain.step().unwrap(), 0.005) {
                let Source::Constraint(k) = row.id.source else { panic!("a contact") };
                tension[k] = tension[k].hypot(force);
            }
            // The first constraint is the ball's, followed by the chain's from the top.
            for (k, tension) in tension.into_iter().enumerate() {
                let links = if k == 0 { 0 } else { 41 - k };
                assert_near(tension, (4021.0 + 5.98 * links as f64) * G, 1e-9);
            }
        }
    }
}

#[test]
fn a_stretched_chain_sheds_a_fifth_of_its_error_a_step() {
    let mut chain = simulation(scene("stretched_chain", Scheme::Velocity));
    for k in 1..=20 {
        let drift = chain.step().unwrap().motion.drift;
        assert!((drift - 0.05 * 0.8f64.powi(k)).abs() < 1e-12, "{k}: {drift}");
    }
}

#[test]
fn a_grid_of_soft_joints_swings_and_holds() {
    let mut grid = simulation(scene("joint_grid", Scheme::Soft));
    let start = grid.motion().energy();
    let mut swung = 0.0f64;
    for _ in 0..100 {
        let motion = grid.step().unwrap().motion;
        assert!(motion.drift < 0.02, "{}", motion.drift);
        assert!(motion.energy() < start + 1e-6);
        swung = swung.max(motion.kinetic);
    }
    assert!(swung > 1.0);
}

#[test]
fn a_hasty_warm_start_does_not_drive_a_chain() {
    let scene = scene("warm_start", Scheme::Velocity);
    let mut chain = Simulation::new(scene.clone(), simulation::solver(&scene).unwrap());
    let mut unsolved = 0;
    for _ in 0..400 {
        let step = chain.step().unwrap();
        unsolved += usize::from(step.solves[0].solution.status != Status::Solved);
        assert!(step.motion.energy() < 1e-9, "{}", step.motion.energy());
    }
    assert!(unsolved > 100);
}

#[test]
fn balls_that_rush_together_end_in_a_heap() {
    let mut rush = simulation(scene("rush", Scheme::Velocity));
    for _ in 0..600 {
        assert!(rush.step().unwrap().motion.penetration < 1e-9);
    }
    assert!(rush.motion().kinetic < 1e-2);
    for state in rush.states() {
        assert!(state.pose.p.norm() < 8.0 * 0.2);
        assert_eq!(state.pose.p.y, 0.0);
    }
    assert!(forces(&rush.step().unwrap(), 0.01).iter().any(|(row, _)| row.kind == Kind::Normal));
}
