//! Redundant contacts, move by move: two contacts at one point, and a third that takes over their
//! load.

use lcplab_analysis::explain::{Method, problem};
use lcplab_lcp::file::Problem;
use lcplab_page::document::Format;

use super::question;

#[test]
fn a_move_to_the_middle_is_explained_with_its_direction_and_its_ends() {
    // A = JJᵀ, J = (1 0; 1 0; 1 1). Rows 0 and 1 share x₀ + x₁ = 1. Row 2 then has w = 1 − 1.8; x₀
    // falls as x₂ rises, and reaches 0 at x₂ = ½, where x₁ = ½. Along (−1, 1, 0) the distances are
    // 0 and ½.
    let text = r#"{"A": {"dense": [[1, 1, 1], [1, 1, 1], [1, 1, 2]]}, "b": [-1, -1, -1.8]}"#;
    let read = Problem::parse(text, "shared.json").unwrap();
    let document = problem(&question(&read), &Method::named("dantzig").unwrap()).unwrap();
    assert!(document.is_accepted);
    let text = document.written(Format::Text).unwrap();
    let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
    for part in [
        "Row 1 has w₁ = 0 and depends on F. Along d = (−1, 1, 0) no w changes. x could change by 1 \
         forward and by 0 backward; it moves to the middle, by 0.5. Row 1 is now dependent: its w \
         stays 0 together with that of F. Now x = (0.5, 0.5, 0).",
        "The move ends at t = 0.5: x₀ reaches a bound. But row 0 need not leave F: w₁ = 0, and row 1 \
         depends on F. Along d = (−1, 1, 0) no w changes. x could change by 0 forward and by 0.5 \
         backward; it moves to the middle, by −0.25. Row 1 is now dependent: its w stays 0 together \
         with that of F. Now x = (0.25, 0.25, 0.5).",
        "row 0 leaves F to its lower bound. Now x = (0, 0.25, 0.75).",
    ] {
        assert!(text.contains(part), "{part} in {text}");
    }
}
