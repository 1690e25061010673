//! The pushed block: solvers against geometry, and the geometry against its definition.

use std::f64::consts::{FRAC_PI_4, PI, SQRT_2, TAU};
use std::sync::OnceLock;

use lcplab::report::study::friction::Model;
use lcplab::report::study::slider;
use lcplab::report::study::sliding::{Figure, Finding, run};
use lcplab::report::view;

use super::standard;

/// What is found out about one block and one push, once for all tests.
fn study() -> &'static Finding {
    static STUDY: OnceLock<Finding> = OnceLock::new();
    STUDY.get_or_init(|| run(0.4, 3.0).unwrap())
}

#[test]
fn figures_reach_as_far_as_their_corners_and_edges() {
    let near = |found: f64, expected: f64| assert!((found - expected).abs() < 1e-12, "{found}");
    let square = Figure::of(Model::CoupledBox);
    near(square.reach(0.0), 1.0);
    near(square.reach(FRAC_PI_4), SQRT_2);
    near(square.reach(-PI), 1.0);
    for directions in [4, 8, 16] {
        let polygon = Figure::of(Model::Polyhedral { directions });
        near(polygon.reach(0.0), 1.0);
        near(polygon.reach(PI / directions as f64), (PI / directions as f64).cos());
    }
}

#[test]
fn the_nearest_point_is_in_the_figure_and_no_other_is_nearer() {
    for model in Model::ALL {
        let figure = Figure::of(model);
        for k in 0..50 {
            let (sin, cos) = (0.13 * f64::from(k)).sin_cos();
            let push = [2.5 * cos, 2.5 * sin];
            let x = figure.nearest(push);
            assert!(x[0].hypot(x[1]) <= figure.reach(x[1].atan2(x[0])) + 1e-12, "{model}");
            for j in 0..200 {
                let angle = TAU * f64::from(j) / 200.0;
                let (y, reach) = (angle.sin_cos(), figure.reach(angle));
                let y = [reach * y.1, reach * y.0];
                // (push − x)·(y − x) ≤ 0 for all y of a convex figure
                let dot = (push[0] - x[0]) * (y[0] - x[0]) + (push[1] - x[1]) * (y[1] - x[1]);
                assert!(dot <= 1e-12, "{model}: {dot}");
            }
        }
    }
}

#[test]
fn solvers_find_the_friction_that_geometry_demands() {
    let study = study();
    assert_eq!(study.slides.len(), Model::ALL.len() * 19);
    for slide in &study.slides {
        let (contact, expected) = (&slide.answer.contacts[0], slide.expected);
        assert_eq!(slide.answer.status, "solved", "{slide:?}");
        for (found, expected) in [
            (contact.strength.unwrap(), expected.strength),
            (contact.misalignment.unwrap(), expected.misalignment),
            (contact.velocity[0], expected.rise),
        ] {
            assert!((found - expected).abs() < 1e-6, "{found}, not {expected}: {slide:?}");
        }
    }
}

#[test]
fn the_block_withstands_what_the_figure_reaches() {
    for grip in &study().grips {
        // Half of what 14 halvings of 2 leave, and the slip that counts as none.
        assert!((grip.measured - grip.expected).abs() < 1e-4, "{grip:?}");
    }
}

#[test]
fn on_the_rod_more_corners_come_nearer_to_coulomb_and_the_frozen_box_mistakes_the_load() {
    let rod = &study().rod;
    let of = |model| rod.iter().find(|answer| answer.model == model).unwrap();
    let residual = |directions| of(Model::Polyhedral { directions }).coulomb_residual;
    assert!(residual(16) < residual(8) && residual(8) < residual(4));
    assert!(of(Model::CoulombCone).coulomb_residual < 1e-8);
    let strongest = |model| {
        let strengths = of(model).contacts.iter().flat_map(|contact| contact.strength);
        strengths.fold(0.0, f64::max)
    };
    assert!(strongest(Model::CoupledBox) <= SQRT_2 + 1e-9);
    assert!(strongest(Model::FrozenBox) > strongest(Model::CoupledBox));
}

#[test]
fn a_coefficient_that_is_none_is_an_error() {
    for mu in [0.0, -0.5, f64::NAN] {
        assert!(run(mu, 3.0).is_err(), "{mu}");
    }
    assert!(run(0.5, f64::INFINITY).is_err());
}

#[test]
fn the_table_has_a_row_a_model_and_all_agree() {
    let table = standard::table(&view::document(standard::results()).unwrap(), "friction_block");
    let column = table.columns.iter().position(|column| column.title == "agreement").unwrap();
    assert_eq!(table.rows.len(), Model::ALL.len());
    assert!(table.rows.iter().all(|row| row[column].text == "agrees"));
}

#[test]
fn the_way_to_the_stop_is_the_one_that_small_steps_of_the_law_take() {
    // v' = −μ g × the corner of the figure that lies farthest along v, in steps of 10 µs.
    let mu_g = 4.0;
    for (corners, first, radius) in
        [(4, FRAC_PI_4, SQRT_2), (4, 0.0, 1.0), (8, 0.0, 1.0), (16, 0.0, 1.0)]
    {
        for degrees in [10.0f64, 30.0, 41.0, 100.0, 250.0] {
            let (sin, cos) = degrees.to_radians().sin_cos();
            let (mut p, mut v, dt) = ([0.0; 2], [2.0 * cos, 2.0 * sin], 1e-5);
            for _ in 0..200_000 {
                let corner = |k: usize| {
                    let (s, c) = (first + TAU * k as f64 / corners as f64).sin_cos();
                    [radius * c, radius * s]
                };
                let along = |d: &[f64; 2]| d[0] * v[0] + d[1] * v[1];
                let d = (0..corners).map(corner).max_by(|a, b| along(a).total_cmp(&along(b)));
                let d = d.unwrap();
                for i in 0..2 {
                    v[i] -= mu_g * dt * d[i];
                    p[i] += dt * v[i];
                }
                if v[0].hypot(v[1]) < 1e-3 {
                    break;
                }
            }
            let figure = Figure::Polygon { corners, radius, first };
            let [x, y] = slider::stop(figure, 2.0, degrees.to_radians(), mu_g);
            assert!((x - p[0]).hypot(y - p[1]) < 1e-3, "{corners} at {degrees}°: {x}, {y}, {p:?}");
        }
    }
}

#[test]
fn the_block_of_the_scene_stops_there_under_every_model_and_all_answers_are_accepted() {
    let table = standard::table(&view::document(standard::results()).unwrap(), "friction_paths");
    let column = table.columns.iter().position(|column| column.title == "agreement").unwrap();
    assert_eq!(table.rows.len(), Model::ALL.len());
    for row in &table.rows {
        assert_eq!(row[column].text, "agrees", "{row:?}");
    }
}
