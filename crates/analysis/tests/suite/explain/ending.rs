//! Steps with a second solve, and steps that have no solution.

use lcplab_analysis::explain::{Method, steps};
use lcplab_mechanics::scene::{Scene, Scheme};
use lcplab_page::document::Format;

use super::{explained, sections};

#[test]
fn a_bounce_is_a_second_lcp_with_half_of_the_speed_as_its_wish() {
    // After 79 steps of 0.01 s the ball falls with 7.7499 m/s; e = 1/2 sends it back with 3.87495.
    let scene = Scene::load("bouncing_ball").unwrap();
    let document = steps(&scene, &Method::named("dantzig").unwrap(), 80..=80).unwrap();
    assert!(document.is_accepted);
    let text = sections(&document, &["restitution: constraints", "restitution: the new motion"]);
    insta::assert_snapshot!(text, @r"
    Constraints
      Restitution, the rows
        row   constraint               c (m)   J u (m/s)   J'u (m/s²)   bias (m/s)   bounds of x (N s)
          0   normal ground – ball   0.03924     −7.7499            0     −3.87495   [0, ∞)
    Contacts bounce if they have an impulse in the first answer and approached at 0.1 m/s or faster.
    They have the bias e J u with e = 0.5 and J u from the table, so w = J u⁺ + e J u ≥ 0 requires a
    separation at e times the approach speed. The other rows keep their bias.

    The new motion
        u⁺ = u* + M⁻¹Jᵀ x = [ −7.848 ] + [ 11.7229 ] = [ 3.87495 ]   m/s
    ");
}

#[test]
fn the_rod_of_painleve_is_explained_to_the_proof_that_no_force_helps() {
    // d adds to row 0 a multiple of row 3 such that column 3 of Aᵀd is 0: 0.406477/0.790164. The
    // rest of column 0, −0.790164 + 0.514422·0.406477, is negative, and so is bᵀd = −9.81·1.514422.
    for solver in ["pgs", "lemke"] {
        let document = explained("painleve", Scheme::Acceleration, solver);
        assert!(!document.is_accepted);
        let text = document.written(Format::Text).unwrap();
        for part in
            ["−1.5 x₀, 0 x₀", "A = J M⁻¹Jᵀ S =", "no variable reaches 0: a ray", "cannot be solved"]
        {
            assert!(text.contains(part), "{part} in {text}");
        }
        let moves =
            document.sections.iter().any(|section| section.title.contains("the new motion"));
        assert!(!moves, "{text}");
        let text = sections(&document, &["why there is no solution"]);
        insta::allow_duplicates! {
            insta::assert_snapshot!(text, @r"
            Why there is no solution
            A solution has wᵢ ≥ 0 if xᵢ has no upper bound, and wᵢ ≤ 0 if xᵢ has no lower bound. Let d be
            positive only in rows of the first kind and negative only in rows of the second kind. Then dᵀw ≥
            0 at every solution. But dᵀw = (Aᵀd)ᵀx + bᵀd, which is negative for every x within the bounds:
                0 ≤ dᵀw = (Aᵀd)ᵀx + bᵀd ≤ max (Aᵀd)ᵀx + bᵀd < 0
              Forces, the vector d in its relevant rows
                row                                             d          (Aᵀd)ᵢ   bounds of x   largest (Aᵀd)ᵢ xᵢ   bᵢ dᵢ (m/s²)
                0 normal ground rod 0 at face 0 on vertex 1     1       −0.383687   [0, ∞)                        0   −9.81·1 = −9.81
                1 friction ground rod 1 at face 0 on vertex 1   0         2.32611   [0, 0]                        0   200·0 = 0
                2 friction ground rod 2 at face 0 on vertex 1   0   3.33067×10⁻¹⁶   [0, 0]                        0   0·0 = 0
                3 normal ground rod 0 at face 0 on vertex 3     1       −0.383687   [0, ∞)                        0   −9.81·1 = −9.81
                4 friction ground rod 1 at face 0 on vertex 3   0         2.32611   [0, 0]                        0   200·0 = 0
            The sum is dᵀw ≤ 0 + (−19.62) = −19.62 m/s² for every x within its bounds, but a solution has
            dᵀw ≥ 0. Therefore no solution exists, for any solver. The comparison was made in exact
            arithmetic.
            ");
        }
    }
}

#[test]
fn two_nails_and_a_rod_contradict_each_other_whatever_the_solver() {
    // The nails are 3 m apart, the rod is 1 m long: b = β/dt · 2 m = 40 m/s, and no w of the three
    // rows along x can be 0 together.
    for solver in Method::NAMES {
        let document = explained("fig8", Scheme::Velocity, solver);
        assert!(!document.is_accepted);
        let text = sections(&document, &["why there is no solution"]);
        for row in ["0 coincidence world left 0", "3 coincidence world right 0", "6 distance left"]
        {
            assert!(text.contains(row), "{solver}: {text}");
        }
        assert!(text.contains("40·(−"), "{solver}: {text}");
    }
}
