//! Friction with closed forms: a ramp, a creeping box, Painlevé's rod, and what solvers pay.

use lcplab::report::study::Study;
use lcplab::report::study::creep;
use lcplab::report::study::friction_solvers;
use lcplab::report::study::painleve::{self, Forces};
use lcplab::report::study::ramp;
use lcplab::report::view::{Document, View};

use super::standard;

#[test]
fn boxes_on_the_ramp_stick_or_slide_by_the_formula() {
    let plan: ramp::Plan = toml::from_str(
        "duration = 0.1\nways = [{ name = 'velocity' },\n\
         { name = 'acceleration', change = { step = { scheme = 'acceleration' } } }]",
    )
    .unwrap();
    // g = 10 m/s², published: three stick, two slide.
    let published = [0.0, 0.0, 0.0, 1.1038, 2.4740];
    let found = plan.run(0).unwrap().0;
    for finding in &found {
        for (slid, published) in finding.boxes.iter().zip(published) {
            assert!((slid.expected - published).abs() < 1e-4);
            assert!((slid.acceleration - published).abs() < 1e-4, "{}: {slid:?}", finding.name);
        }
    }
    let table = standard::table(&Document::of(&plan, std::slice::from_ref(&found)), "ramp");
    assert_eq!(table.rows.len(), 3); // theory first
    assert!(plan.outcome(std::slice::from_ref(&found)).good);
}

#[test]
fn a_box_that_moves_otherwise_is_bad_unless_its_way_is_named_as_one_that_may() {
    let text = "duration = 0.1\nways = [{ name = 'velocity' }]\n";
    let plan: ramp::Plan = toml::from_str(text).unwrap();
    let mut found = plan.run(0).unwrap().0;
    found[0].boxes[1].acceleration += 0.01;
    let outcome = plan.outcome(std::slice::from_ref(&found));
    assert!(!outcome.good && outcome.says.starts_with("4 of 5 boxes"), "{}", outcome.says);
    let excused: ramp::Plan = toml::from_str(&format!("{text}may_miss = ['velocity']")).unwrap();
    let outcome = excused.outcome(&[found]);
    assert!(outcome.good && outcome.says.contains("4 of 5 under velocity"), "{}", outcome.says);
    let unknown: ramp::Plan = toml::from_str(&format!("{text}may_miss = ['soft']")).unwrap();
    let message = unknown.run(0).unwrap_err().to_string();
    assert_eq!(message, "ramp: may_miss: there is no way named \"soft\"");
}

#[test]
fn smoothed_friction_creeps_by_the_formula_and_rows_of_friction_do_not() {
    let plan = creep::Plan { friction: 0.6, dampings: vec![20.0], duration: 1.5 };
    let found = plan.run(0).unwrap().0;
    // W sin θ/(4 d): 2 kg at 20° on four corners.
    let expected = 2.0 * 9.81 * 20f64.to_radians().sin() / 80.0;
    assert!((found[0].speed / expected - 1.0).abs() < 1e-3, "{:?}", found[0]);
    let rows: Vec<_> = found.iter().filter(|finding| finding.damping.is_none()).collect();
    assert!(!rows.is_empty());
    for finding in rows {
        assert!(finding.speed.abs() < 1e-6, "{finding:?}");
    }
    assert!(plan.outcome(&[found]).good);
}

#[test]
fn forces_on_painleves_rod_end_where_its_geometry_says() {
    let plan = painleve::Plan { frictions: vec![1.2, 1.33, 1.36, 1.5] };
    let found = plan.run(0).unwrap().0;
    // 4/3 for a rod without thickness; this one is 50 times as long as thick.
    assert!((found[0].critical - 4.0 / 3.0).abs() < 0.01);
    for finding in &found {
        let possible = matches!(finding.forces, Forces::Found(_));
        assert_eq!(possible, finding.mu < finding.critical, "{finding:?}");
        assert!(finding.impulse > 1.0); // pressed harder than by its weight
    }
    assert!(plan.outcome(&[found]).good);
}

/// The end slides through the step, or where it would turn back within it stops: tried in this order, in the plane.
#[test]
fn painleves_rod_is_pressed_as_a_rod_in_the_plane() {
    let (half, turn) = ([0.5, 0.01], 63.434_948_822_922_01_f64.to_radians());
    let (sin, cos) = turn.sin_cos();
    let [x, z] = [half[0] * cos - half[1] * sin, -half[0] * sin - half[1] * cos]; // of the lower end
    let inertia = (1.0 + 0.02 * 0.02) / 12.0;
    let (gravity, dt, speed) = (9.81, 1e-3, 0.2);
    let plan = painleve::Plan { frictions: vec![0.2, 0.6, 1.0, 1.2, 1.3, 1.5, 2.0] };
    for finding in plan.run(0).unwrap().0 {
        // What a unit of normal impulse with friction f does to the end's velocity, up and ahead.
        let up = |f: f64| 1.0 + x * (x - f * z) / inertia;
        let ahead = |f: f64| f - z * (x - f * z) / inertia;
        let slides = gravity * dt / up(-finding.mu);
        let goes_on = slides > 0.0 && speed + slides * ahead(-finding.mu) > 0.0;
        let stops = {
            let (c, d) = (1.0 + z * z / inertia, -x * z / inertia);
            let (a, rest) = (1.0 + x * x / inertia, gravity * dt);
            (rest * c + speed * d) / (a * c - d * d)
        };
        let expected = if goes_on { slides } else { stops } / (gravity * dt);
        assert!((finding.impulse / expected - 1.0).abs() < 1e-5, "{finding:?}: {expected}");
        if let Forces::Found(force) = finding.forces {
            assert!((force / expected - 1.0).abs() < 1e-5, "{finding:?}: {expected}");
        }
    }
}

#[test]
fn every_claim_on_friction_problems_is_accepted() {
    let plan: friction_solvers::Plan = toml::from_str(
        "families = ['pushed-rod']\nmodels = ['coupled-box', 'polygon-4', 'coulomb-cone']\n\
         solvers = ['pgs', 'lemke', 'cone-pgs']",
    )
    .unwrap();
    let (found, times) = plan.run(0).unwrap();
    let pairs: Vec<_> =
        found.iter().map(|row| (row.model.as_deref().unwrap(), row.solver.as_str())).collect();
    assert!(
        pairs.contains(&("polygon-4", "lemke")) && pairs.contains(&("coulomb-cone", "cone-pgs"))
    );
    assert!(found.iter().all(|row| row.claimed == row.accepted && row.seconds == 0.0));
    assert_eq!(times.len(), found.len());
    assert!(plan.outcome(&[found]).good);
}
