//! Explanations. The two one-dimensional examples were verified by hand.

mod centering;
mod ending;
mod figure6;
mod figure7;
mod friction;

use lcplab_analysis::explain::{Method, problem, step};
use lcplab_lcp::Question;
use lcplab_lcp::file::Problem;
use lcplab_mechanics::scene::{Scene, Scheme};
use lcplab_page::document::{Document, Format, Formula, SHOWN, Section};
use lcplab_page::number::readable;
use lcplab_solver::Options;

fn explained(scene: &str, level: Scheme, solver: &str) -> Document {
    let mut scene = Scene::load(scene).unwrap();
    scene.step.scheme = level;
    step(&scene, &Method::named(solver).unwrap(), 1).unwrap()
}

/// A problem under the model that it states.
fn question(problem: &Problem) -> Question {
    Question::new(problem, None, "problem").unwrap()
}

/// The sections and parts with these words in their titles, as text; a part's title begins with
/// that of its section: `Impact: The answer`.
fn sections(document: &Document, titles: &[&str]) -> String {
    let text = document.written(Format::Text).unwrap();
    let (mut section, mut wanted) = (String::new(), Vec::new());
    for part in text.trim_end().split("\n\n").skip(1) {
        let title = part.lines().next().unwrap_or_default();
        let title = match title.split_once(' ') {
            Some((number, title)) if number.parse::<usize>().is_ok() => {
                section = title.to_string();
                section.clone()
            }
            _ => format!("{section}: {title}"),
        };
        if titles.iter().any(|wanted| title.to_lowercase().contains(&wanted.to_lowercase())) {
            wanted.push(part);
        }
    }
    wanted.join("\n\n")
}

/// One section with one formula, as Markdown.
fn markdown(formula: Formula) -> String {
    let mut section = Section::new("one");
    section.formula(formula);
    let mut document = Document::default();
    document.add("", section);
    document.written(Format::Markdown).unwrap()
}

#[test]
fn a_problem_file_starts_at_a_and_b_with_the_units_it_states() {
    let text = r#"{"name": "pair <1>", "A": {"dense": [[2, -1], [-1, 2]]}, "b": [-1, 2],
        "rows": [{"label": "left", "unit": "N s"}, {"label": "right", "unit": "N s"}]}"#;
    let read = Problem::parse(text, "pair.json").unwrap();
    let document = problem(&question(&read), &Method::named("pgs").unwrap()).unwrap();
    assert!(document.is_accepted);
    let text = document.written(Format::Text).unwrap();
    for part in ["1 The LCP", "x₀ = 0.5 N s", "w₁ = 1.5 m/s", "1/kg", "0 left", "1 right"] {
        assert!(text.contains(part), "{part} in {text}");
    }
    assert!(document.written(Format::Markdown).unwrap().starts_with("# pair \\<1\\>, by pgs\n"));
}

#[test]
fn of_large_problems_twelve_rows_are_written_and_the_rest_is_counted() {
    let document = explained("stack", Scheme::Velocity, "lemke");
    let text = document.written(Format::Text).unwrap();
    assert!(text.contains("(12 of 60 rows and 12 of 60 columns are written)"));
    assert!(text.contains("    and 48 more\n"));
    let brackets = |line: &&str| line.contains('⎢');
    let runs = text.lines().collect::<Vec<_>>();
    let longest = runs.split(|line| !brackets(line)).map(<[&str]>::len).max().unwrap();
    assert_eq!(longest, SHOWN - 1); // twelve rows and the dots, less the first and the last line
}

#[test]
fn every_shipped_scene_is_explained_in_every_form_or_says_why_not() {
    for scene in ["fig6", "fig7", "incline", "pendulum", "sphere_plane", "painleve"] {
        for level in Scheme::LEVELS {
            let document = explained(scene, level, "dantzig");
            let impossible = scene == "painleve" && level == Scheme::Acceleration;
            assert_eq!(document.is_accepted, !impossible, "{scene}");
            for format in [Format::Text, Format::ColoredText, Format::Markdown, Format::Html] {
                assert!(document.written(format).unwrap().len() > 300, "{scene}");
            }
        }
    }
    let mut other = Scene::load("fig6").unwrap();
    other.step.scheme = Scheme::Xpbd;
    let error = step(&other, &Method::named("pgs").unwrap(), 1).unwrap_err().to_string();
    assert_eq!(error, "fig6: scheme: only velocity and acceleration can be explained, not xpbd");
}

#[test]
fn a_later_step_starts_where_the_one_before_ended() {
    let scene = Scene::load("fig7").unwrap();
    let document = step(&scene, &Method::named("pgs").unwrap(), 2).unwrap();
    let text = sections(&document, &["Step 2, impulses: projected"]);
    assert!(text.contains("The start is x = (4, 3, 1) N s."), "{text}"); // the impulses of step 1
    // Each x is the weight above the contact.
    assert!(text.contains("with x = (3, 2, 1) N s: solved."), "{text}");
}

#[test]
fn the_lead_states_the_load_on_fixed_bodies_and_claims_no_solution_of_a_solver_without_one() {
    let lead = |scene, level| explained(scene, level, "dantzig").lead;
    let (sin, cos) = 20f64.to_radians().sin_cos();
    // A box of 2 kg slides with μ = 0.3: normal force and friction along the vertical.
    let sliding = 2.0 * 9.81 * cos * (cos + 0.3 * sin);
    for (scene, level, supported, weight) in [
        ("fig7", Scheme::Acceleration, 3.0, 3.0),
        ("stack", Scheme::Velocity, 5.0 * 9.81, 5.0 * 9.81),
        ("incline", Scheme::Velocity, sliding, 2.0 * 9.81),
        ("pendulum", Scheme::Velocity, 0.0, 9.81), // its rod is horizontal
    ] {
        let [supported, weight] = [supported, weight].map(|force| readable(force, 3));
        let lead = lead(scene, level);
        assert!(lead.contains(&format!(" push with {supported} N")), "{lead}");
        assert!(lead.contains(&format!(" the weight of {weight} N. ")), "{lead}");
        assert!(lead.contains(" finds ") && lead.ends_with("The judge accepts every answer."));
    }
    let method = Method::with("pgs", Options::default().with_max_iterations(3)).unwrap();
    let lead = step(&Scene::load("fig7").unwrap(), &method, 1).unwrap().lead;
    assert!(!lead.contains(" finds ") && !lead.contains("The judge accepts"), "{lead}");
}

#[test]
fn an_unknown_solver_is_an_error_that_lists_those_that_are_explained() {
    let error = Method::named("admm").unwrap_err().to_string();
    assert_eq!(
        error,
        "there is no solver with a derivation named \"admm\"; there are pgs, sor, dantzig, lemke"
    );
}

#[test]
fn a_page_has_mathml_and_fetches_nothing() {
    let document = explained("fig7", Scheme::Acceleration, "lemke");
    let html = document.written(Format::Html).unwrap();
    assert_eq!(html, document.written(Format::Html).unwrap());
    assert!(html.matches("<math").count() > 20);
    for fetch in ["http:", "https:", "src=\"", "@import", "<link rel=\"stylesheet"] {
        assert!(!html.contains(fetch), "{fetch}");
    }
}

#[test]
fn numbers_are_written_in_latex_as_on_the_terminal() {
    for (value, latex) in [
        (-0.25, "-0.25"),
        (1.105e-4, "1.105\\times 10^{-4}"),
        (-1e6, "-10^{6}"),
        (1010.0, "1{,}010"),
        (f64::NEG_INFINITY, "-\\infty"),
    ] {
        let text = markdown(Formula::default().symbols("x =", "x =").number(value).unit("m/s²"));
        assert!(text.contains(&format!("$$\nx = {latex} \\quad \\text{{m/s²}}\n$$")), "{text}");
    }
}
