//! The four models beside each other, against closed forms.

use lcplab::judge::cross_check::max_difference;
use lcplab::lcp::friction::{Contact, FrictionProblem};
use lcplab::lcp::merit;
use lcplab::report::study::friction::{Answer, ContactAnswer, Model, compare};
use lcplab::solver::Settings;
use proptest::prelude::*;

use lcplab_testing::{INF, boxed, cases, pushed_mass, rubbing};

const POLYGON: Model = Model::Polyhedral { directions: 4 };

fn answers(problem: &FrictionProblem, models: &[Model]) -> Vec<Answer> {
    let settings = Settings::default().with_tolerance(1e-11);
    compare(problem, models, &settings).unwrap()
}

fn answer(problem: &FrictionProblem, model: Model) -> Answer {
    answers(problem, &[model]).pop().unwrap()
}

/// The answer for a unit mass, pressed with 2 N s; μ = ½, so that friction is 1 N s at most.
fn pushed(model: Model, push: f64, degrees: f64) -> ContactAnswer {
    let answer = answer(&pushed_mass(2.0, push, degrees), model);
    assert_ne!(answer.verdict, "not_a_solution", "{model}");
    assert_eq!(answer.status, "solved", "{model}");
    answer.contacts[0].clone()
}

#[track_caller]
fn assert_near(found: f64, expected: f64) {
    assert!((found - expected).abs() < 1e-9, "{found} is not {expected}");
}

#[test]
fn across_the_tangents_the_box_holds_41_percent_too_much_and_the_diamond_29_too_little() {
    for (model, strength) in [
        (Model::FrozenBox, 2f64.sqrt()),
        (Model::CoupledBox, 2f64.sqrt()),
        (POLYGON, 0.5f64.sqrt()),
        (Model::CoulombCone, 1.0),
    ] {
        assert_near(pushed(model, strength * 0.999, 45.0).velocity[1], 0.0);
        let slides = pushed(model, strength * 1.001, 45.0);
        assert!(slides.velocity[1] < -1e-4, "{model}");
        assert_near(slides.strength.unwrap(), strength);
    }
}

#[test]
fn what_a_model_gives_up_is_its_residual_in_coulombs_law() {
    let at_45 = answers(&pushed_mass(2.0, 3.0, 45.0), &Model::ALL);
    let follows = |answer: &&Answer| answer.coulomb_residual < 1e-9;
    let who: Vec<Model> = at_45.iter().filter(follows).map(|answer| answer.model).collect();
    // 45° is a corner of the polygons with 8 and 16.
    let polygons = [8, 16].map(|directions| Model::Polyhedral { directions });
    assert_eq!(who, [polygons[0], polygons[1], Model::CoulombCone]);
}

/// A rod of mass 1 and radius of gyration ½ lies along t1 on its ends at ±1, pressed unevenly and
/// pushed; 2 contacts, 6 rows.
fn rod() -> FrictionProblem {
    // Columns of J: v_z, v_x, v_y, ω_y, ω_z; inverse inertia 4.
    let j =
        |x: f64| [[1.0, 0.0, 0.0, -x, 0.0], [0.0, 1.0, 0.0, 0.25, 0.0], [0.0, 0.0, 1.0, 0.0, x]];
    let rows: Vec<[f64; 5]> = [j(-1.0), j(1.0)].concat();
    let inverse_mass = [1.0, 1.0, 1.0, 4.0, 4.0];
    let u = [-1.0, 0.7, 0.4, 0.3, 0.2];
    let product =
        |a: &[f64; 5], b: &[f64; 5]| -> f64 { (0..5).map(|k| a[k] * inverse_mass[k] * b[k]).sum() };
    let a: Vec<Vec<f64>> =
        rows.iter().map(|r| rows.iter().map(|s| product(r, s)).collect()).collect();
    let a: Vec<&[f64]> = a.iter().map(Vec::as_slice).collect();
    let b: Vec<f64> = rows.iter().map(|r| (0..5).map(|k| r[k] * u[k]).sum()).collect();
    let lo = [0.0, -INF, -INF, 0.0, -INF, -INF];
    let contact = |first| Contact { rows: [first, first + 1, first + 2], mu: 0.3 };
    FrictionProblem::new(boxed(&a, &b, &lo, &[INF; 6]), vec![contact(0), contact(3)]).unwrap()
}

#[test]
fn polygons_of_many_corners_approach_coulombs_cone_for_two_coupled_contacts() {
    let problem = rod();
    let w = |answer: &Answer| problem.lcp().w(&answer.x);
    let exact = answer(&problem, Model::CoulombCone);
    assert!(exact.contacts.iter().all(|contact| contact.misalignment.is_some()), "both slide");
    let difference = |directions: usize| {
        let polygon = answer(&problem, Model::Polyhedral { directions });
        assert_ne!(polygon.verdict, "not_a_solution");
        max_difference(&w(&polygon), &w(&exact))
    };
    let differences = [8, 16, 32, 64].map(difference);
    assert!(differences[3] < 0.1 * differences[0], "{differences:?}");
    assert!(differences[3] < 0.01, "{differences:?}");
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn no_model_is_refuted_and_friction_takes_energy(problem in rubbing(2, 7, 0.5)) {
        for answer in answers(&problem, &Model::ALL) {
            let name = answer.model.to_string();
            if answer.verdict == "not_a_solution" {
                // Freezing and Lemke's path can fail, and then they say so.
                let may_fail = matches!(
                    answer.model,
                    Model::CoupledBox | Model::CoulombCone | Model::Polyhedral { .. }
                );
                prop_assert!(may_fail && answer.status != "solved", "{}", name);
                continue;
            }
            prop_assert!(merit::objective(problem.lcp(), &answer.x) <= 1e-9, "{}", name);
            for contact in &answer.contacts {
                let ([_, x1, x2], [_, w1, w2]) = (contact.impulse, contact.velocity);
                prop_assert!(x1 * w1 + x2 * w2 <= 1e-9, "{}", name);
            }
        }
    }
}
