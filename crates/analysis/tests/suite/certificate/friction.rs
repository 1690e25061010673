//! Each model's certificate judges x, from any source.

use lcplab_judge::{Demand, Verdict, judge, judge_friction};
use lcplab_lcp::Coupling;
use lcplab_lcp::friction::{Contact, FrictionProblem, Model, ProblemForm};

use lcplab_testing::{INF, boxed, cases, pushed_mass, rubbing};
use proptest::prelude::*;

fn verdict(problem: &FrictionProblem, model: Model, x: &[f64]) -> Verdict {
    let posed = model.pose(problem, Some(x)).unwrap();
    judge_friction(&posed, x, &Demand::default()).verdict
}

#[test]
fn each_model_accepts_its_own_closed_form_and_no_other() {
    // Pressed with 2, pushed with 3 at 30°, μ = ½. Square: both tangents are at their limits.
    // Diamond: the nearer corner. Octagon: the corner at 45° is 15° off, that at 0° is 30° off.
    // Disk: opposite to the push.
    let problem = pushed_mass(2.0, 3.0, 30.0);
    let (half, root) = (0.5f64.sqrt(), 0.75f64.sqrt());
    // Associated: x_n = (2 + 3/2)/(1 + 1/4) = 2.8, |x_t| = 1.4.
    let answers = [
        (vec![Model::FrozenBox, Model::CoupledBox], [2.0, 1.0, 1.0]),
        (vec![Model::Polyhedral { directions: 4 }], [2.0, 1.0, 0.0]),
        (vec![Model::Polyhedral { directions: 8 }], [2.0, half, half]),
        (vec![Model::CoulombCone, Model::Polyhedral { directions: 12 }], [2.0, root, 0.5]),
        (vec![Model::AssociatedCone], [2.8, 1.4 * root, 0.7]),
    ];
    for (own, x) in &answers {
        let models = Model::ALL.into_iter().chain([Model::Polyhedral { directions: 12 }]);
        for model in models.filter(|model| *model != Model::Polyhedral { directions: 16 }) {
            let accepted = verdict(&problem, model, x).is_solution();
            assert_eq!(accepted, own.contains(&model), "{model} on {x:?}");
        }
    }
}

#[test]
fn no_speed_of_the_slip_hides_friction_that_is_missing() {
    // Pressed with 1, pushed with s v along the tangents, which have inverse mass s: for any v > 1,
    // x = (1, ½, 0).
    for (s, v) in [(1.0, 10.0), (1.0, 1e9), (1e-4, 1e8), (1e4, 1e10)] {
        let rows: [&[f64]; 3] = [&[1.0, 0.0, 0.0], &[0.0, s, 0.0], &[0.0, 0.0, s]];
        let lcp = boxed(&rows, &[-1.0, -s * v, 0.0], &[0.0, -INF, -INF], &[INF; 3]);
        let problem =
            FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }]).unwrap();
        for model in [
            Model::CoupledBox,
            Model::FrozenBox,
            Model::Polyhedral { directions: 4 },
            Model::CoulombCone,
        ] {
            assert!(verdict(&problem, model, &[1.0, 0.5, 0.0]).is_solution(), "{model:?} {s} {v}");
            for wrong in [0.0, -0.5, 0.499, 0.501, 0.5 * (1.0 - 1e-7), 0.5 * (1.0 + 1e-7)] {
                let verdict = verdict(&problem, model, &[1.0, wrong, 0.0]);
                assert!(!verdict.is_solution(), "{model:?} {s} {v} {wrong}: {verdict}");
            }
        }
    }
}

#[test]
fn no_unit_and_no_mass_hides_friction_that_is_missing_or_pushes_with_the_slip() {
    // Masses 1/a and 1/s, pressed with p and pushed with v p: x = p (1, ½, 0), in units of x from
    // 2⁻⁶⁰ to 2⁶⁰.
    let units = (-60..=60).step_by(12).map(|k| 2f64.powi(k));
    let weights = [1.0, 2f64.powi(-60), 2f64.powi(60)];
    let speeds = [1.0, 1e3, 1e14];
    let all = units.flat_map(|p| weights.map(|s| (p, s)));
    for (p, s, v) in all.flat_map(|(p, s)| speeds.map(|v| (p, s, v))) {
        for a in [1.0 / p, 1.0] {
            let (s, push) = (s * a, s * a * v * p);
            let rows: [&[f64]; 3] = [&[a, 0.0, 0.0], &[0.0, s, 0.0], &[0.0, 0.0, s]];
            let lcp = boxed(&rows, &[-a * p, -push, 0.0], &[0.0, -INF, -INF], &[INF; 3]);
            let contact = Contact { rows: [0, 1, 2], mu: 0.5 };
            let problem = FrictionProblem::new(lcp, vec![contact]).unwrap();
            for model in [
                Model::CoupledBox,
                Model::Polyhedral { directions: 4 },
                Model::Polyhedral { directions: 8 },
                Model::CoulombCone,
            ] {
                let is_solution =
                    |x: [f64; 3]| verdict(&problem, model, &x.map(|x| p * x)).is_solution();
                assert!(is_solution([1.0, 0.5, 0.0]), "{model} {p} {a} {s} {v}");
                for wrong in [[1.0, 0.0, 0.0], [1.0, 0.25, 0.0], [1.0, -0.5, 0.0], [1.0, 0.0, 0.5]]
                {
                    assert!(!is_solution(wrong), "{model} {p} {a} {s} {v} {wrong:?}");
                }
            }
        }
    }
}

#[test]
fn friction_that_no_row_feels_is_friction_all_the_same() {
    // w_t = 1 for any x, so x_t = −μ x_n; the normal may be coupled to it or not.
    for (a_nt, n, x) in
        [(0.0, 1.0, [1.0, -0.5]), (0.0, 1e15, [1e15, -0.5e15]), (1.0, 1e15, [2e15, -1e15])]
    {
        let lcp = boxed(&[&[1.0, a_nt], &[0.0, 0.0]], &[-n, 1.0], &[0.0, -INF], &[INF; 2]);
        let coupling = Coupling::new(vec![None, Some(0)], vec![0.0, 0.5]).unwrap();
        let lcp = lcp.with_coupling(coupling).unwrap();
        let is_solution = |x: [f64; 2]| judge(&lcp, &x, &Demand::default()).verdict.is_solution();
        assert!(is_solution(x) && !is_solution([n, 0.0]), "{n}");
    }
}

#[test]
fn a_cone_that_no_row_feels_holds_friction_to_its_direction_in_any_unit() {
    // Slip 1/p along t1 for any x: x = p (1, −μ, 0), and w_n = 0 under Coulomb's law, μ/p under the
    // associated one.
    for p in (-60..=60).step_by(12).map(|k| 2f64.powi(k)) {
        for (model, lift) in [(Model::CoulombCone, 0.0), (Model::AssociatedCone, 1.0 / p)] {
            let rows: [&[f64]; 3] = [&[1.0, 0.0, 0.0], &[0.0; 3], &[0.0; 3]];
            let lcp = boxed(&rows, &[lift - p, 1.0 / p, 0.0], &[0.0, -INF, -INF], &[INF; 3]);
            let contact = Contact { rows: [0, 1, 2], mu: 1.0 };
            let problem = FrictionProblem::new(lcp, vec![contact]).unwrap();
            let is_solution =
                |x: [f64; 3]| verdict(&problem, model, &x.map(|x| p * x)).is_solution();
            assert!(is_solution([1.0, -1.0, 0.0]), "{model} {p}");
            let wrong = [[1.0, 1.0, 0.0], [1.0, 0.0, 0.0], [1.0, 0.0, 1.0], [1.0, -0.5, 0.0]];
            // Below, x is negligible relative to terms_n / s_n.
            if model == Model::CoulombCone || p >= 1.0 {
                assert!(wrong.iter().all(|&x| !is_solution(x)), "{p}");
            }
        }
    }
}

#[test]
fn a_contact_that_sticks_is_accepted_where_the_tangents_move_as_one() {
    // x_1 ± x_2 = c leaves w_t = 0, inside the square, the polygons and the disk.
    for (sign, c) in [(1.0, 0.0), (-1.0, 0.0), (1.0, 1.0), (-1.0, 1.0)] {
        let rows: [&[f64]; 3] = [&[1.0, 0.0, 0.0], &[0.0, 1.0, sign], &[0.0, sign, 1.0]];
        let lcp = boxed(&rows, &[-4.0, -c, -sign * c], &[0.0, -INF, -INF], &[INF; 3]);
        let contact = Contact { rows: [0, 1, 2], mu: 0.5 };
        let problem = FrictionProblem::new(lcp, vec![contact]).unwrap();
        for (model, x_1) in
            Model::ALL.into_iter().flat_map(|m| [0.3, 0.5, 0.75, 0.95].map(|x| (m, x)))
        {
            let x = [4.0, x_1, sign * (c - x_1)];
            assert!(verdict(&problem, model, &x).is_solution(), "{model} {x:?}");
        }
    }
}

/// One contact with rows n, t1, t2 and this A, b and μ.
fn contact(a: [[f64; 3]; 3], b: [f64; 3], mu: f64) -> FrictionProblem {
    let rows: Vec<&[f64]> = a.iter().map(|row| &row[..]).collect();
    let lcp = boxed(&rows, &b, &[0.0, -INF, -INF], &[INF; 3]);
    FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu }]).unwrap()
}

fn diagonal([n, t1, t2]: [f64; 3]) -> [[f64; 3]; 3] {
    [[n, 0.0, 0.0], [0.0, t1, 0.0], [0.0, 0.0, t2]]
}

const SQUARE: Model = Model::Polyhedral { directions: 4 };
const OCTAGON: Model = Model::Polyhedral { directions: 8 };

#[test]
fn under_a_polygon_no_speed_of_the_slip_makes_an_impulse_small() {
    // Pressed with 1 at a slip of 1e16: x_n = 1. Pulled away with 1: x = 0.
    let pressed = contact(diagonal([1.0; 3]), [-1.0, -1e16, 0.0], 0.5);
    let drawn = contact(diagonal([1.0; 3]), [1.0, 1e16, 0.0], 0.5);
    for model in [SQUARE, OCTAGON] {
        assert!(verdict(&pressed, model, &[1.0, 0.5, 0.0]).is_solution());
        assert!(!verdict(&pressed, model, &[0.0; 3]).is_solution());
        assert!(verdict(&drawn, model, &[0.0; 3]).is_solution());
        assert!(!verdict(&drawn, model, &[3.0, -1.5, 0.0]).is_solution());
    }
}

#[test]
fn under_a_polygon_the_speed_of_the_slip_is_the_one_that_fits_best() {
    // An open contact with an impulse that is negligible relative to the terms of w_n.
    let open = contact(diagonal([1.0; 3]), [1.0, -3.0, 0.0], 0.5);
    assert!(verdict(&open, SQUARE, &[1e-9, 0.0, 0.0]).is_solution());
    // Sticking with x_t at an edge of the octagon: w = 0, |x_t| ≤ x_n.
    let sticks = contact(diagonal([0.3, 2.0, 2.0]), [-2.0, 2.0, -2.0], 1.0);
    let x = [2.0 / 0.3, -1.0, 1.0f64.next_down()];
    assert!(verdict(&sticks, OCTAGON, &x).is_solution());
}

#[test]
fn under_a_square_an_exact_solution_within_rounding_of_x_is_proved() {
    // x = (0.002, 2e-13, −1e-13) up to the last digits: they are rounding relative to x_n.
    let problem = contact(diagonal([10.0, 1e6, 1e6]), [-0.02, -2e-7, 1e-7], 3.0);
    assert!(matches!(
        verdict(&problem, SQUARE, &[0.002, 2.00001e-13, -1e-13]),
        Verdict::Proved { distance } if distance < 1e-17
    ));
}

#[test]
fn a_refused_polygon_names_the_largest_residual() {
    let a = [[2.0, 0.0, -1.0], [0.0, 3.0, -1.0], [-1.0, -1.0, 1.0]];
    let problem = contact(a, [-2.0, 1.0, 1.0], 0.25);
    let posed = SQUARE.pose(&problem, None).unwrap();
    let certificate = judge_friction(&posed, &[2.0, -0.5, 0.0], &Demand::default());
    let Verdict::NotASolution { row, amount, .. } = certificate.verdict else { panic!() };
    assert_eq!((row, amount), (certificate.worst_row, certificate.scaled_residual));
    assert_eq!(certificate.residuals[row], amount);
    assert_eq!(certificate.rounded_by, None);
}

#[test]
fn a_sticking_contact_is_not_called_impossible_under_an_octagon() {
    // Pushed along both tangents and sticking: w = 0 at x. Only friction rows push there.
    let problem = contact(diagonal([3.0, 8.0, 8.0]), [-2.0, -1.0, 1.0], 0.5);
    assert!(verdict(&problem, OCTAGON, &[2.0 / 3.0, 0.125, -0.125]).is_solution());
    // A floor that no force can stop.
    let floor = contact(diagonal([0.0, 8.0, 8.0]), [-2.0, 0.0, 0.0], 0.5);
    assert!(!verdict(&floor, OCTAGON, &[1e12, 0.0, 0.0]).is_solution());
}

#[test]
fn a_refused_row_is_one_of_x() {
    let problem = pushed_mass(2.0, 3.0, 0.0);
    for model in Model::ALL {
        let Verdict::NotASolution { row, .. } = verdict(&problem, model, &[2.0, 0.5, 0.0]) else {
            panic!("{model} accepts half of the friction");
        };
        assert!(row < 3, "{model}");
    }
}

#[test]
fn a_contact_without_friction_must_not_rub() {
    let problem = pushed_mass(2.0, 3.0, 0.0);
    let contacts = vec![Contact { mu: 0.0, ..problem.contacts()[0] }];
    let smooth = FrictionProblem::new(problem.lcp().clone(), contacts).unwrap();
    for model in Model::ALL {
        assert!(verdict(&smooth, model, &[2.0, 0.0, 0.0]).is_solution(), "{model}");
        assert!(!verdict(&smooth, model, &[2.0, 0.5, 0.0]).is_solution(), "{model}");
    }
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn without_friction_all_models_judge_alike(
        problem in rubbing(2, 6, 0.25), x_n in proptest::collection::vec(-1.0..1.0, 2),
        lambda in -1.0..1.0,
    ) {
        let contacts = problem.contacts().iter().map(|c| Contact { mu: 0.0, ..*c }).collect();
        let smooth = FrictionProblem::new(problem.lcp().clone(), contacts).unwrap();
        let x = [lambda, x_n[0], 0.0, 0.0, x_n[1], 0.0, 0.0];
        let solved = Model::ALL.map(|model| verdict(&smooth, model, &x).is_solution());
        prop_assert!(solved.iter().all(|s| *s == solved[0]), "{:?}", solved);
    }
}

#[test]
fn without_a_normal_force_every_friction_is_rejected() {
    // Nothing presses: x_n = 0 and all terms of its row are 0. w_t1 = x_t1 − 1 vanishes at 1.
    let lcp = boxed(
        &[&[1.0, 0.0, 0.0], &[0.0, 1.0, 0.0], &[0.0, 0.0, 1.0]],
        &[0.0, -1.0, 0.0],
        &[0.0, -INF, -INF],
        &[INF; 3],
    );
    let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }]).unwrap();
    for model in Model::ALL.into_iter().filter(|model| *model != Model::FrozenBox) {
        assert!(!verdict(&problem, model, &[0.0, 1.0, 0.0]).is_solution(), "{model}");
        // The associated law lifts a contact that slips.
        let rests = model != Model::AssociatedCone;
        assert_eq!(verdict(&problem, model, &[0.0; 3]).is_solution(), rests, "{model}");
        if let ProblemForm::Polyhedral(own) = model.pose(&problem, None).unwrap() {
            assert!(!own.is_solution(&[0.0, 1.0, 0.0], 1e-8), "{model}: the solvers' own test");
        }
    }
}

#[test]
fn large_terms_of_one_tangent_do_not_hide_that_friction_is_missing_along_the_other() {
    // The contact slips along t1 at full speed without friction; t2 is in equilibrium with row 3 at
    // forces of 1e9.
    let lcp = boxed(
        &[
            &[1.0, 0.0, 0.0, 0.0],
            &[0.0, 1.0, 0.0, 0.0],
            &[0.0, 0.0, 1.0, 1.0],
            &[0.0, 0.0, 0.0, 1.0],
        ],
        &[-1.0, -1.0, -1e9, -1e9],
        &[0.0, -INF, -INF, -INF],
        &[INF; 4],
    );
    let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }]).unwrap();
    for model in [
        Model::CoupledBox,
        Model::Polyhedral { directions: 4 },
        Model::Polyhedral { directions: 8 },
    ] {
        assert!(!verdict(&problem, model, &[1.0, 0.0, 0.0, 1e9]).is_solution(), "{model}");
        assert!(verdict(&problem, model, &[1.0, 0.5, 0.0, 1e9]).is_solution(), "{model}");
    }
}

#[test]
fn a_rejected_answer_has_no_distance_from_an_accepted_one() {
    // Rows 3 and 4 contradict each other; x_n = 1e-17 is rounding of 0.
    let tiny = 2f64.powi(-60);
    let lcp = boxed(
        &[
            &[1.0, 0.0, 0.0, 0.0, 0.0],
            &[0.0, 1.0, 0.0, 0.0, 0.0],
            &[0.0, 0.0, 1.0, 0.0, 0.0],
            &[tiny, 0.0, 0.0, 1.0, 1.0],
            &[0.0, 0.0, 0.0, 1.0, 1.0],
        ],
        &[0.0, 0.0, 0.0, -1.0, -1.0 - 2f64.powi(-30)],
        &[0.0, -INF, -INF, -INF, -INF],
        &[INF; 5],
    );
    let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }]).unwrap();
    let posed = Model::CoulombCone.pose(&problem, None).unwrap();
    let certificate = judge_friction(&posed, &[1e-17, 0.0, 0.0, 0.5, 0.5], &Demand::default());
    assert!(!certificate.verdict.is_solution());
    assert_eq!(certificate.rounded_by, None);
}
