//! Methods of both kinds on friction problems under each model.

use lcplab_lcp::friction::{Contact, FrictionProblem, Model, Polyhedral, ProblemForm};
use lcplab_lcp::merit;
use lcplab_solver::{
    KNOWN_WRONG, Lemke, Method, Options, PolygonPgs, Registry, Settings, Start, Status,
    solve_polyhedral,
};

use lcplab_testing::{INF, boxed, pushed_mass};

fn method(name: &str) -> Method {
    let method = Registry::standard().methods().find(|method| method.name() == name);
    method.unwrap_or_else(|| panic!("no method {name}")).clone()
}

fn posed(model: Model, problem: &FrictionProblem) -> ProblemForm {
    model.pose(problem, Some(&[2.0, 0.0, 0.0])).unwrap()
}

#[test]
fn a_model_is_taken_by_the_methods_whose_theory_holds_for_it() {
    let polygon = Model::Polyhedral { directions: 8 };
    // Its matrix is copositive, not symmetric, and has zeros on its diagonal: Lemke's alone.
    let takes = |name: &str| {
        let models = [
            Model::FrozenBox,
            Model::CoupledBox,
            polygon,
            Model::AssociatedCone,
            Model::CoulombCone,
        ];
        models.map(|model| method(name).takes(Some(model)))
    };
    assert_eq!(takes("pgs"), [true, true, false, false, false]);
    assert_eq!(takes("dantzig"), [true, true, false, false, false]);
    assert_eq!(takes("lemke"), [true, true, true, false, false]);
    assert_eq!(takes("cone-pgs"), [false, false, false, true, true]);
    assert!(method("lemke").takes(None) && !method("cone-pgs").takes(None));
    let code6 = Method::Boxed(KNOWN_WRONG[0].clone()); // it knows no coupled rows
    assert!(code6.takes(Some(Model::FrozenBox)) && !code6.takes(Some(Model::CoupledBox)));
}

#[test]
fn a_method_that_does_not_take_a_model_says_why() {
    let why = |name: &str, model: Option<Model>| method(name).refusal(model).unwrap();
    let polygon = Some(Model::Polyhedral { directions: 8 });
    assert_eq!(
        why("pgs", polygon),
        "it divides by the diagonal of A, which has zeros for polygon-8"
    );
    let definite = why("dantzig", polygon);
    assert!(definite.starts_with("it needs A symmetric positive"), "{definite}");
    assert_eq!(why("lemke", Some(Model::CoulombCone)), "it supports boxes, not coulomb-cone");
    let none = "it supports only friction cones, and the problem has none";
    assert_eq!(why("cone-pgs", None), none);
    let boxes = why("cone-pgs", Some(Model::CoupledBox));
    assert_eq!(boxes, "it supports only friction cones, not coupled-box");
}

#[test]
fn friction_along_the_slip_is_no_solution_however_small_the_load() {
    // Pressed with 1e-9 and pushed with 3: friction of 5e-10 is a rounding error of the slip, but
    // counts.
    let problem = pushed_mass(1e-9, 3.0, 0.0);
    let polygon = Polyhedral::new(&problem, 8).unwrap();
    let settings = Settings::default().with_tolerance(1e-8);
    let wrong = [1e-9, -5e-10, 0.0];
    assert!(!polygon.is_solution(&wrong, settings.tolerance));
    let swept = PolygonPgs { settings }.solve(&polygon, &Start::at(&wrong), &mut ());
    assert_eq!(swept.status, Status::Solved);
    assert!((swept.x[1] - 5e-10).abs() < 1e-16, "{:?}", swept.x);
}

#[test]
fn a_pushed_mass_slides_with_mu_times_its_load_under_each_model() {
    // Pressed with 2, pushed with 3 along t1, μ = ½: friction can take 1 of the 3.
    let problem = pushed_mass(2.0, 3.0, 0.0);
    let polygon = Model::Polyhedral { directions: 4 };
    for (name, model) in [
        ("pgs", Model::FrozenBox),
        ("pgs", Model::CoupledBox),
        ("lemke", polygon),
        ("cone-pgs", Model::CoulombCone),
    ] {
        let solution = method(name).solve(&posed(model, &problem), &Options::default(), &mut ());
        assert_eq!(solution.status, Status::Solved, "{name}, {model}");
        for (x, expected) in solution.x.iter().zip([2.0, 1.0, 0.0]) {
            assert!((x - expected).abs() < 1e-7, "{name}, {model}: {:?}", solution.x);
        }
        assert!((solution.w[1] + 2.0).abs() < 1e-7, "{:?}", solution.w); // what is left of the push
    }
}

#[test]
fn a_problem_of_the_other_kind_is_outside_the_class() {
    let problem = pushed_mass(2.0, 3.0, 0.0);
    let options = Options::default();
    let refused = |name: &str, model: Model, expected: &str| {
        let solution = method(name).solve(&posed(model, &problem), &options, &mut ());
        assert_eq!(solution.status.to_string(), format!("outside the solver's class: {expected}"));
        assert_eq!((solution.x, solution.iterations), (vec![0.0; 3], 0));
    };
    refused("pgs", Model::CoulombCone, "the problem has cones, not bounds");
    refused("cone-pgs", Model::CoupledBox, "the problem has bounds, not cones");
    refused("cone-pgs", Model::Polyhedral { directions: 4 }, "the problem has bounds, not cones");
}

#[test]
fn a_polyhedral_problem_goes_on_from_an_x_and_names_rows_of_x() {
    let problem = pushed_mass(2.0, 3.0, 0.0);
    let polyhedral = Polyhedral::new(&problem, 4).unwrap();
    let solved =
        |start: &Start<'_>| solve_polyhedral(&Lemke::default(), &polyhedral, start, 1e-8, &mut ());
    let solution = solved(&Start::at(&[2.0, 1.0, 0.0]));
    assert_eq!((&solution.status, &solution.x), (&Status::Solved, &vec![2.0, 1.0, 0.0]));
    assert_eq!(merit::natural_residual(polyhedral.lcp(), &polyhedral.z(&solution.x)), 0.0);
    // A floor that pulls (a_nn = 0, b_n < 0) can push back with no impulse: a ray along x_n.
    let floor = boxed(
        &[&[0.0, 0.0, 0.0], &[0.0, 1.0, 0.0], &[0.0, 0.0, 1.0]],
        &[-1.0, 0.0, 0.0],
        &[0.0, -INF, -INF],
        &[INF; 3],
    );
    let impossible =
        FrictionProblem::new(floor, vec![Contact { rows: [0, 1, 2], mu: 0.5 }]).unwrap();
    let polyhedral = Polyhedral::new(&impossible, 4).unwrap();
    let status =
        solve_polyhedral(&Lemke::default(), &polyhedral, &Start::default(), 1e-8, &mut ()).status;
    let Status::Ray { row, direction } = status else { panic!("{status}") };
    assert_eq!((row, direction.len()), (0, 3));
    let [n, t1, t2] = direction[..] else { unreachable!() };
    assert!(n > 0.0 && t1.abs() + t2.abs() <= 0.5 * n, "{direction:?}");
}

#[test]
fn a_solver_that_is_easily_satisfied_is_not_believed() {
    // With this tolerance it accepts any start as a solution.
    let settings = Settings::default().with_tolerance(1.0);
    let polyhedral = Polyhedral::new(&pushed_mass(2.0, 3.0, 30.0), 8).unwrap();
    let status = |tolerance: f64| {
        let lemke = Lemke { settings: settings.clone() };
        solve_polyhedral(&lemke, &polyhedral, &Start::default(), tolerance, &mut ()).status
    };
    assert_eq!(status(1.0), Status::Solved);
    assert_eq!(status(1e-8), Status::Inaccurate);
}
