//! The four models as problems: sizes, entries, invalid input.

use lcplab_judge::{Demand, Verdict, judge_friction};
use lcplab_lcp::file::Problem;
use lcplab_lcp::friction::{
    ConeProblem, Contact, FrictionProblem, Law, Model, Polyhedral, ProblemForm, project,
};
use lcplab_lcp::{Complementarity, Coupling, Lcp, Question, merit};
use lcplab_solver::{Apgd, ConeSolver, Settings, Start, Status};
use proptest::prelude::*;

use lcplab_testing::{INF, boxed, cases, contacts, pushed_mass, rubbing};

#[test]
fn the_coupled_box_leads_back_to_the_contacts() {
    let problem = pushed_mass(2.0, 3.0, 30.0);
    let again = FrictionProblem::of(&problem.coupled_box()).unwrap();
    assert_eq!(again.contacts(), [Contact { rows: [0, 1, 2], mu: 0.5 }]);
    assert_eq!(again.lcp().bounds(1, &[1.0, 0.0, 0.0]), (-INF, INF));
}

#[test]
fn the_frozen_box_has_the_size_of_the_given_impulse() {
    let lcp = pushed_mass(2.0, 3.0, 30.0).frozen_box(&[4.0]);
    assert_eq!((lcp.lo(), lcp.hi()), (&[0.0, -2.0, -2.0][..], &[INF, 2.0, 2.0][..]));
    let lifted = pushed_mass(2.0, 3.0, 30.0).frozen_box(&[-4.0]);
    assert_eq!(lifted.bounds(1, &[]), (-0.0, 0.0));
}

#[test]
fn four_directions_give_the_matrix_of_stewart_and_trinkle() {
    let polyhedral = Polyhedral::new(&pushed_mass(2.0, 3.0, 0.0), 4).unwrap();
    let expected = [
        [1.0, 0.0, 0.0, 0.0, 0.0, 0.0],
        [0.0, 1.0, 0.0, -1.0, 0.0, 1.0],
        [0.0, 0.0, 1.0, 0.0, -1.0, 1.0],
        [0.0, -1.0, 0.0, 1.0, 0.0, 1.0],
        [0.0, 0.0, -1.0, 0.0, 1.0, 1.0],
        [0.5, -1.0, -1.0, -1.0, -1.0, 0.0],
    ];
    let matrix = polyhedral.lcp().matrix();
    for (i, row) in expected.iter().enumerate() {
        for (j, a) in row.iter().enumerate() {
            assert_eq!(matrix.entry(i, j), *a, "entry {i} {j}");
        }
    }
    assert_eq!(polyhedral.lcp().b(), [-2.0, -3.0, 0.0, 3.0, 0.0, 0.0]);
    assert_eq!(polyhedral.x(&[2.0, 0.75, 0.25, 0.0, 0.5, 9.0]), [2.0, 0.75, -0.25]);
}

#[test]
fn other_numbers_of_directions_are_refused() {
    let error = Polyhedral::new(&pushed_mass(2.0, 3.0, 0.0), 6).unwrap_err();
    assert_eq!(
        error.to_string(),
        "polyhedral friction: directions: must be a positive multiple of 4, is 6"
    );
}

#[test]
fn contacts_that_cannot_be_are_listed() {
    let lcp = contacts(&[&[1.0, 0.0], &[0.0, 1.0]], &[0.0, 0.0]);
    let error = FrictionProblem::new(lcp, vec![Contact { rows: [0, 0, 2], mu: -1.0 }]).unwrap_err();
    assert_eq!(
        error.to_string(),
        "contacts: 3 defects\n  contact 0: mu must be ≥ 0, is -1\n  contact 0: row t1 = 0 is used \
         twice\n  contact 0: row t2 = 2 does not exist, there are only 2 rows"
    );
    let lcp = contacts(&[&[1.0, 0.0, 0.0], &[0.0, 1.0, 0.0], &[0.0, 0.0, 1.0]], &[0.0; 3]);
    let error = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 1.0 }]).unwrap_err();
    assert!(error.to_string().contains("row t1 = 1 has bounds 0 and inf, not -inf and inf"));
}

#[test]
fn friction_rows_that_are_no_pair_are_listed() {
    let rows: [&[f64]; 3] = [&[1.0, 0.0, 0.0], &[0.0, 1.0, 0.0], &[0.0, 0.0, 1.0]];
    let lcp = boxed(&rows, &[0.0; 3], &[0.0, -INF, -INF], &[INF; 3]);
    let coupled = |index: [Option<usize>; 3], mu: [f64; 3]| {
        let coupling = Coupling::new(index.to_vec(), mu.to_vec()).unwrap();
        let lcp = lcp.clone().with_coupling(coupling).unwrap();
        FrictionProblem::of(&lcp).unwrap_err().to_string()
    };
    assert_eq!(
        coupled([None, Some(0), None], [0.0, 1.0, 0.0]),
        "contacts: row 0: bounds 1 friction rows, not 2"
    );
    let four = Coupling::new(vec![None, Some(0), Some(0), Some(0), Some(0)], vec![0.5; 5]).unwrap();
    let unit = |i: usize| (0..5).map(move |j| f64::from(u8::from(i == j))).collect::<Vec<f64>>();
    let rows: Vec<Vec<f64>> = (0..5).map(unit).collect();
    let rows: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
    let five = boxed(&rows, &[0.0; 5], &[0.0, -INF, -INF, -INF, -INF], &[INF; 5]);
    let message = FrictionProblem::of(&five.with_coupling(four).unwrap()).unwrap_err().to_string();
    assert!(message.contains("bounds 4 friction rows, not 2; rolling and torsional"), "{message}");
    assert_eq!(
        coupled([None, Some(0), Some(0)], [0.0, 1.0, 0.5]),
        "contacts: row 0: mu is 1 along t1, 0.5 along t2: multiply row and column 2 of A, and \
         b[2], by their ratio 0.5, and give both rows the mu of t1"
    );
}

#[test]
fn the_unknowns_of_a_polygon_follow_from_x() {
    // Pushed at 30°, the diamond rubs along t1 alone: w_t = (1 − 3 cos 30°, −1.5), γ = −w_t1.
    let diamond = Polyhedral::new(&pushed_mass(2.0, 3.0, 30.0), 4).unwrap();
    let slides = diamond.z(&[2.0, 1.0, 0.0]);
    assert_eq!(slides[..5], [2.0, 1.0, 0.0, 0.0, 0.0]);
    assert!((slides[5] - (3.0 * 0.75f64.sqrt() - 1.0)).abs() < 1e-15);
    // It sticks: no speed, and x_t between d_1 and d_2.
    let sticks = Polyhedral::new(&pushed_mass(4.0, 1.25, 0.0), 4).unwrap();
    assert_eq!(sticks.z(&[4.0, 1.25, 0.0]), [4.0, 1.25, 0.0, 0.0, 0.0, 0.0]);
    assert_eq!(sticks.z(&[4.0, -0.5, 0.25])[..5], [4.0, 0.0, 0.25, 0.5, 0.0]);
    assert_eq!([0, 1, 4, 5].map(|unknown| sticks.row(unknown)), [0, 1, 1, 0]);
}

#[test]
fn the_slip_of_a_polygon_belongs_to_its_contact_beside_smooth_ones() {
    // Contacts with μ = 0, ½, 0, ¼: four x_n, two times four β, and a γ for the second and the
    // fourth.
    let rows: Vec<Vec<f64>> =
        (0..12).map(|i| (0..12).map(|j| f64::from(i == j)).collect()).collect();
    let rows: Vec<&[f64]> = rows.iter().map(Vec::as_slice).collect();
    let lo: Vec<f64> = (0..12).map(|i| if i % 3 == 0 { 0.0 } else { -INF }).collect();
    let contact = |(c, mu)| Contact { rows: [0, 1, 2].map(|i| i + 3 * c), mu };
    let contacts = [0.0, 0.5, 0.0, 0.25].into_iter().enumerate().map(contact).collect();
    let problem = FrictionProblem::new(boxed(&rows, &[0.0; 12], &lo, &[INF; 12]), contacts);
    let polyhedral = Polyhedral::new(&problem.unwrap(), 4).unwrap();
    assert_eq!([12, 13].map(|unknown| polyhedral.row(unknown)), [3, 9]);
}

#[test]
fn a_cone_is_open_along_its_own_directions_whatever_their_length() {
    // |d_t| ≤ d_n / 2, and Coulomb's law has no fixed cone.
    let of = |law| ConeProblem::new(pushed_mass(2.0, 3.0, 0.0), law);
    let open = |d: [f64; 3]| of(Law::Associated).recedes(&d);
    for length in [0.25, 1.0, 4.0] {
        assert!(open([2.5, 0.75, 1.0].map(|d| d * length)), "on it, {length}");
        assert!(!open([2.5, 0.75, 1.25].map(|d| d * length)), "beside it, {length}");
    }
    assert!(!of(Law::Coulomb).recedes(&[1.0, 0.0, 0.0]));
}

#[test]
fn contacts_beside_a_coupling_are_refused() {
    let coupled = pushed_mass(2.0, 3.0, 0.0).coupled_box();
    let error = FrictionProblem::new(coupled, vec![]).unwrap_err().to_string();
    assert!(
        error.contains("friction_index: is given, and so are contacts: one of them is enough"),
        "{error}"
    );
}

#[test]
fn softened_rows_yield_by_a_part_of_their_diagonal_entry() {
    let problem = pushed_mass(2.0, 3.0, 0.0); // A = 1
    let softened = problem.softened(0.25).unwrap();
    assert_eq!(softened.contacts(), problem.contacts());
    assert_eq!((0..3).map(|i| softened.lcp().matrix().diagonal(i)).collect::<Vec<_>>(), [1.25; 3]);
    assert_eq!(softened.lcp().b(), problem.lcp().b());
    let polyhedral = Polyhedral::new(&problem, 4).unwrap().softened(0.25).unwrap();
    let diagonal: Vec<_> = (0..6).map(|i| polyhedral.lcp().matrix().diagonal(i)).collect();
    assert_eq!(diagonal, [1.25, 1.25, 1.25, 1.25, 1.25, 0.0]); // γ has no row of A
    assert!(problem.softened(INF).is_err());
}

#[test]
fn each_model_poses_its_own_problem() {
    let problem = pushed_mass(2.0, 3.0, 0.0);
    let missing = Model::FrozenBox.pose(&problem, None).unwrap_err().to_string();
    assert!(missing.contains("frozen_at: is missing"), "{missing}");
    let ProblemForm::Boxed(frozen) =
        Model::FrozenBox.pose(&problem, Some(&[4.0, 0.0, 0.0])).unwrap()
    else {
        panic!()
    };
    assert_eq!(frozen.bounds(1, &[0.0; 3]), (-2.0, 2.0));
    for (model, expected) in
        [(Model::AssociatedCone, Law::Associated), (Model::CoulombCone, Law::Coulomb)]
    {
        let ProblemForm::Cone(cone) = model.pose(&problem, None).unwrap() else { panic!() };
        assert_eq!(cone.law(), expected);
    }
    assert!(Model::Polyhedral { directions: 6 }.pose(&problem, None).is_err());
    assert_eq!("polygon-20".parse(), Ok(Model::Polyhedral { directions: 20 }));
}

#[test]
fn models_have_names_that_lead_back_to_them() {
    for model in Model::ALL {
        assert_eq!(model.to_string().parse(), Ok(model));
    }
    for wrong in ["polygon-6", "polygon-0", "polygon-1000000000", "polygon-", "cone", ""] {
        assert!(wrong.parse::<Model>().is_err(), "{wrong}");
    }
}

/// A point in space.
fn point() -> impl Strategy<Value = [f64; 3]> {
    [-2.0..2.0, -2.0..2.0, -2.0..2.0]
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn the_projection_is_the_nearest_point_of_the_cone(mu in 0.0..3.0, v in point()) {
        // Moreau: p in K, v − p in the polar cone −K*, both orthogonal.
        let p = project(mu, v);
        let d: [f64; 3] = std::array::from_fn(|i| v[i] - p[i]);
        prop_assert!(p[1].hypot(p[2]) <= mu * p[0] + 1e-12 && p[0] >= 0.0);
        prop_assert!(mu * d[1].hypot(d[2]) <= -d[0] + 1e-12);
        prop_assert!((0..3).map(|i| p[i] * d[i]).sum::<f64>().abs() < 1e-12);
    }

    #[test]
    fn a_contact_without_friction_has_a_ray_for_a_cone(v in point()) {
        prop_assert_eq!(project(0.0, v), [v[0].max(0.0), 0.0, 0.0]);
    }

    #[test]
    fn polyhedral_matrices_are_copositive(
        problem in rubbing(2, 4, 0.0), z in proptest::collection::vec(0.0..2.0, 21),
    ) {
        // zᵀ M z = xᵀ A x + Σ μ x_n γ for 1 + 2 + 2·8 + 2 unknowns, less those of contacts with
        // μ = 0.
        let polyhedral = Polyhedral::new(&problem, 8).unwrap();
        let rubbing = || problem.contacts().iter().enumerate().filter(|(_, c)| c.mu > 0.0);
        let z = &z[..3 + 9 * rubbing().count()];
        prop_assert_eq!(polyhedral.lcp().len(), z.len());
        let gammas = &z[3 + 8 * rubbing().count()..];
        let power: f64 =
            rubbing().zip(gammas).map(|((c, contact), gamma)| contact.mu * z[1 + c] * gamma).sum();
        let square = |lcp: &Lcp, x: &[f64]| 2.0 * merit::objective(&lcp.homogeneous(), x);
        let energy = square(problem.lcp(), &polyhedral.x(z));
        prop_assert!((square(polyhedral.lcp(), z) - energy - power).abs() < 1e-9);
    }

    #[test]
    fn a_polygons_unknowns_give_x_back(
        problem in rubbing(2, 6, 0.0), x in proptest::collection::vec(-1.0..1.0, 7),
        quarters in 1usize..5,
    ) {
        // β are coordinates of x_t; a contact without friction has none.
        let polyhedral = Polyhedral::new(&problem, 4 * quarters).unwrap();
        let z = polyhedral.z(&x);
        prop_assert_eq!(z.len(), polyhedral.lcp().len());
        prop_assert!(z[3..].iter().all(|z| *z >= 0.0));
        let back = polyhedral.x(&z);
        let smooth = problem.contacts().iter().filter(|contact| contact.mu == 0.0);
        let bare: Vec<usize> = smooth.flat_map(|contact| contact.rows[1..].to_vec()).collect();
        for i in 0..x.len() {
            let expected = if bare.contains(&i) { 0.0 } else { x[i] };
            prop_assert!((back[i] - expected).abs() < 1e-14, "row {}", i);
        }
    }

    #[test]
    fn coulombs_law_is_the_associated_one_frozen_at_x(
        problem in rubbing(2, 6, 1.0), x in proptest::collection::vec(-1.0..1.0, 7),
    ) {
        let coulomb = ConeProblem::new(problem, Law::Coulomb);
        let settings = Settings::default().with_tolerance(1e-12);
        let solver = Apgd { settings };
        let solution = ConeSolver::solve(&solver, &coulomb, &Start::default(), &mut ());
        if solution.status == Status::Solved {
            let frozen = coulomb.frozen_at(&solution.x);
            prop_assert!(frozen.scaled_residual(&solution.x) < 1e-10);
            let off: Vec<f64> = solution.x.iter().map(|x| x + 0.125).collect();
            prop_assert!(coulomb.scaled_residual(&off) > 1e-6);
            prop_assert!(coulomb.frozen_at(&off).scaled_residual(&off) > 1e-6);
        }
        let frozen = coulomb.frozen_at(&x);
        for contact in coulomb.friction().contacts() {
            let step = |problem: &ConeProblem| {
                let w = contact.of(&problem.lcp().w(&x));
                problem.step(contact, contact.of(&x), w, problem.scale(contact))
            };
            for (a, b) in step(&coulomb).iter().zip(step(&frozen)) {
                prop_assert!((a - b).abs() < 1e-12);
            }
        }
    }
}

#[test]
fn a_normal_force_that_is_wrong_is_refused_however_stiff_the_tangents_are() {
    // A = diag(1, s, s), b = (−1, 0, −s), μ = 10: x = (1, 0, 1) with w = 0, the only solution.
    for s in [1.0, 1e4, 1e7, 1e12] {
        let a = [1.0, 0.0, 0.0, 0.0, s, 0.0, 0.0, 0.0, s];
        let lcp = Lcp::new(
            lcplab_lcp::Matrix::dense(3, &a),
            vec![-1.0, 0.0, -s],
            vec![0.0, -INF, -INF],
            vec![INF; 3],
        );
        let friction =
            FrictionProblem::new(lcp.unwrap(), vec![Contact { rows: [0, 1, 2], mu: 10.0 }])
                .unwrap();
        for law in [Law::Associated, Law::Coulomb] {
            let problem = ConeProblem::new(friction.clone(), law);
            assert_eq!(problem.scaled_residual(&[1.0, 0.0, 1.0]), 0.0);
            for wrong in [-1.0, 0.1, 0.5, 2.0] {
                let residual = problem.scaled_residual(&[wrong, 0.0, 1.0]);
                assert!(residual > 0.1, "{law:?}, s = {s:e}, x_n = {wrong}: {residual:e}");
            }
        }
    }
}

#[test]
fn the_smallest_numbers_are_seen_beside_rows_of_zeros() {
    // No force, no friction: x_t = 0 and nothing else, however small.
    let rows = [&[1e-8, 0.0, 0.0][..], &[0.0, 1e-8, 0.0], &[0.0, 0.0, 1e-8]];
    let lcp = boxed(&rows, &[0.0; 3], &[0.0, -INF, -INF], &[INF; 3]);
    let friction = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.0 }]).unwrap();
    for law in [Law::Associated, Law::Coulomb] {
        let problem = ConeProblem::new(friction.clone(), law);
        assert!(problem.scaled_residual(&[0.0, 0.0, 2.3399e-319]) > 0.5, "{law:?}");
        assert_eq!(problem.scaled_residual(&[0.0; 3]), 0.0);
    }
}

#[test]
fn a_polygon_s_proof_is_a_proof_of_x_and_not_of_the_slips_beside_it() {
    // Pushed with 1e9 against μ x_n = 0.3: x_t = −0.3. The slip of 1e9 is part of z, and makes +0.3
    // near.
    let rows = [&[1.0, 0.0, 0.0][..], &[0.0, 1.0, 0.0], &[0.0, 0.0, 1.0]];
    let lcp = boxed(&rows, &[-1.0, 1e9, 0.0], &[0.0, -INF, -INF], &[INF; 3]);
    let friction = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.3 }]).unwrap();
    let posed = ProblemForm::Polyhedral(Polyhedral::new(&friction, 4).unwrap());
    let verdict = |x: [f64; 3]| judge_friction(&posed, &x, &Demand::default()).verdict;
    assert!(matches!(verdict([1.0, -0.3, 0.0]), Verdict::Proved { .. }));
    for wrong in [[1.0, 0.3, 0.0], [1.0, 0.0, 0.3]] {
        assert!(!matches!(verdict(wrong), Verdict::Proved { .. }), "{wrong:?}");
    }
}

/// In the plane the cone is an interval, |x_t| ≤ μ x_n.
#[test]
fn in_the_plane_cones_and_polygons_are_the_coupled_box() {
    let with = |model: &str| {
        let text = format!(
            r#"{{"A": {{"dense": [[1, 0.2], [0.2, 1]]}}, "b": [-1, -2],
                "friction_index": [-1, 0], "mu": [0, 0.5], "model": "{model}"}}"#
        );
        let problem = Problem::parse(&text, "plane").unwrap();
        Question::new(&problem, None, "plane").map_err(|error| error.to_string())
    };
    for model in ["coupled-box", "polygon-4", "polygon-16", "coulomb-cone"] {
        let question = with(model).unwrap();
        assert_eq!(question.model(), None, "{model}");
        assert_eq!(question.boxed().unwrap().bounds(1, &[2.0, 0.0]), (-1.0, 1.0));
    }
    // Its law is another one: w_n = μ |w_t| while it slides.
    let message = with("associated-cone").unwrap_err();
    assert!(message.starts_with("plane: model: is associated-cone"), "{message}");
    assert!(with("frozen-box").unwrap_err().starts_with("plane: model: is frozen-box"));
}
