//! The laws of friction: each is posed as what it is.

use lcplab_mechanics::scene::Scene;
use lcplab_problem::friction::Model;
use lcplab_study::explain::{Method, step};

use super::sections;
use lcplab_page::document::{Document, Format};

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
    let text = sections(&document, &["velocity: the LCP"]);
    insta::assert_snapshot!(text, @r"
    6 Step 1, velocity: the LCP
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
    x stays within its bounds; w > 0 only where x is at the lower one, w < 0 only at the upper one.
             ⎡ 0 ⎤       ⎡ ∞ ⎤
             ⎢ 0 ⎥       ⎢ ∞ ⎥
        lo = ⎢ 0 ⎥ ≤ x ≤ ⎢ ∞ ⎥ = hi   units row by row
             ⎢ 0 ⎥       ⎢ ∞ ⎥
             ⎢ 0 ⎥       ⎢ ∞ ⎥
             ⎣ 0 ⎦       ⎣ ∞ ⎦
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
        for part in
            [law, "cone, μ = 0.5, on row 0", "the box beside it, by Dantzig's", "both answers"]
        {
            assert!(text.contains(part), "{part} in {text}");
        }
        assert!(document.written(Format::Html).is_ok());
    }
}

#[test]
fn a_frozen_box_has_the_bounds_of_the_step_before() {
    // From the second step on the box is pressed by m g cos 20° dt = 0.184368 N s, of which each of its
    // four contacts has a quarter; in the first step nothing is known, and nothing rubs.
    let document = modelled("incline", Model::FrozenBox, 2);
    let first = sections(&document, &["Step 1, velocity: friction in a frozen box"]);
    assert_eq!(first.matches("= 0 N s   [0, 0] N s").count(), 8, "{first}");
    let second = sections(&document, &["Step 2, velocity: friction in a frozen box"]);
    let quarter = "0.0460919 N s   [−0.0138276, 0.0138276] N s";
    assert_eq!(second.matches(quarter).count(), 8, "{second}");
}
