//! The laws of friction, each in its own formulation.

use lcplab_analysis::explain::{Method, problem, step};
use lcplab_lcp::Question;
use lcplab_lcp::file::Problem;
use lcplab_lcp::friction::Model;
use lcplab_mechanics::scene::Scene;
use lcplab_page::document::{Document, Format};

use super::sections;

fn modelled(scene: &str, model: Model, steps: usize) -> Document {
    let mut scene = Scene::load(scene).unwrap();
    scene.contact.model = model;
    step(&scene, &Method::named("dantzig").unwrap(), steps).unwrap()
}

#[test]
fn polygons_are_the_lcp_of_stewart_and_trinkle_solved_by_lemke() {
    // A ball of 1 kg: 1/m along the normal, 1/m + r²/I = 1 + 0.25·10 along each direction, −3.5 for
    // opposite ones, 0 across; then ones for γ, and μ = 0.5 with −Eᵀ below.
    let document = modelled("sphere_plane", Model::Polyhedral { directions: 4 }, 1);
    assert!(document.is_accepted);
    let text = sections(&document, &["impulses: the LCP"]);
    insta::assert_snapshot!(text, @r"
    The LCP
        w = A x + b
            ⎡   1     0     0     0     0  0 ⎤
            ⎢   0   3.5     0  −3.5     0  1 ⎥
        A = ⎢   0     0   3.5     0  −3.5  1 ⎥   units row by row
            ⎢   0  −3.5     0   3.5     0  1 ⎥
            ⎢   0     0  −3.5     0   3.5  1 ⎥
            ⎣ 0.5    −1    −1    −1    −1  0 ⎦
            ⎡ −0.0981 ⎤
            ⎢       0 ⎥
        b = ⎢       0 ⎥   units row by row
            ⎢       0 ⎥
            ⎢       0 ⎥
            ⎣       0 ⎦
    Every x ≥ 0 and w ≥ 0, and w > 0 only if x = 0.
    ");
    let text = document.written(Format::Text).unwrap();
    for part in ["γ of row 0", "Lemke's method, tableau by tableau", "x_t = D β", "0.0981 N s"] {
        assert!(text.contains(part), "{part} in {text}");
    }
}

#[test]
fn many_directions_and_contacts_are_explained_too() {
    let document = modelled("incline", Model::Polyhedral { directions: 8 }, 1);
    assert!(document.is_accepted);
    let text = document.written(Format::Text).unwrap();
    assert!(text.replace('\n', " ").contains("8 directions d, 45° apart"), "{text}");
    assert!(!text.contains("units row by row:"), "{text}");
}

#[test]
fn cones_are_stated_and_the_box_stands_beside_them() {
    for (model, law) in [
        (Model::CoulombCone, "ŵ = A x + b + μ |w_t| n"),
        (Model::AssociatedCone, "x in K,   w in K*,   x·w = 0"),
    ] {
        let document = modelled("sliding", model, 1);
        assert!(document.is_accepted);
        let text = document.written(Format::Text).unwrap();
        for part in [
            law,
            "cone, μ = 0.5, on row 0",
            "The coupled box for comparison, by Dantzig's",
            "both answers",
        ] {
            assert!(text.contains(part), "{part} in {text}");
        }
        assert!(document.written(Format::Html).is_ok());
    }
}

#[test]
fn a_frozen_box_has_the_bounds_of_the_step_before() {
    // From the second step on the box is pressed by m g cos 20° dt = 0.184368 N s, a quarter at
    // each of its four contacts; in the first step the normal forces are unknown, and there is no
    // friction.
    let document = modelled("incline", Model::FrozenBox, 2);
    let first = sections(&document, &["Step 1, impulses: friction in a frozen box"]);
    assert_eq!(first.matches("= 0 N s   [0, 0] N s").count(), 8, "{first}");
    let second = sections(&document, &["Step 2, impulses: friction in a frozen box"]);
    let quarter = "0.0460919 N s   [−0.0138276, 0.0138276] N s";
    assert_eq!(second.matches(quarter).count(), 8, "{second}");
}

/// A ball of 1 kg, pressed with 2 N s and pushed along both tangents with 3 N s; μ = ½, and a box
/// frozen at x_n = 1.
const PUSHED: &str = r#"{"A": {"dense": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "b": [-2, -3, -3],
    "friction_index": [-1, 0, 0], "mu": [0, 0.5, 0.5], "frozen_at": [1, 0, 0], "model": "coulomb-cone",
    "rows": [{"unit": "N s"}, {"unit": "N s"}, {"unit": "N s"}]}"#;

/// The explanation of it, under a given model or its own.
fn pushed(model: Option<Model>) -> (Document, String) {
    let read = Problem::parse(PUSHED, "pushed.json").unwrap();
    let question = Question::new(&read, model, "pushed.json").unwrap();
    let document = problem(&question, &Method::named("dantzig").unwrap()).unwrap();
    let text = document.written(Format::Text).unwrap();
    (document, text)
}

#[test]
fn a_problem_file_is_explained_and_judged_under_its_own_model() {
    // x_n = 2, and friction 1: along the diagonal in the disk, in both directions in the box; along
    // it in polygons with such a corner, along both adjacent corners in the one with four; ½ in the
    // frozen box.
    let half = |model| (Some(model), "0.5 N s");
    for (model, friction) in [
        (None, "(0.707107,"), // the other number may stand in the next line
        (Some(Model::CoulombCone), "(0.707107,"),
        (Some(Model::AssociatedCone), "cone"),
        (Some(Model::CoupledBox), "x₁ = 1 N s"),
        half(Model::FrozenBox),
        half(Model::Polyhedral { directions: 4 }),
        (Some(Model::Polyhedral { directions: 8 }), "0.707107 N s"),
    ] {
        let (document, text) = pushed(model);
        assert!(document.is_accepted, "{model:?}: {text}");
        assert!(text.contains(friction), "{model:?}: {text}");
        let name = model.unwrap_or(Model::CoulombCone).to_string();
        assert!(document.lead.contains(&name), "{}", document.lead);
    }
    // For a cone the judge's only verdict is about the cone.
    let (document, text) = pushed(None);
    assert_eq!(text.matches("The judge sees").count(), 1, "{text}");
    assert!(document.title.contains("under coulomb-cone"), "{}", document.title);
    assert!(
        text.contains("Friction within cones") && text.contains("The coupled box for comparison"),
        "{text}"
    );
}

#[test]
fn the_unknowns_of_polygons_have_the_units_of_their_rows() {
    let (_, text) = pushed(Some(Model::Polyhedral { directions: 4 }));
    let line = |name: &str| text.lines().find(|line| line.contains(name)).unwrap_or_default();
    let ends = |name: &str, units: &str| {
        let line = line(name).split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(line.ends_with(units), "{line}");
    };
    ends("x_n of row 0", "N s m/s");
    ends("β at 0° of row 0", "N s m/s");
    ends("γ of row 0", "m/s N s");
}
