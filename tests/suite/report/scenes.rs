//! The sheet of scenes: a small picture of each, which opens its animation.

use lcplab::report::study::Study;
use lcplab::report::study::scenes::Plan;
use lcplab::report::view::ReportPage;
use lcplab::solver::Registry;

#[test]
fn every_scene_is_a_closed_thumbnail_that_holds_its_animation() {
    let names = ["free_fall", "stack"];
    let plan = Plan { scenes: names.map(String::from).into() };
    let run = |task: usize| plan.run(task, Registry::standard()).unwrap().0;
    let page = ReportPage::of(&plan, &[run(0), run(1)]).page.render().unwrap();
    let pieces: Vec<&str> = page.split("<details class=\"thumbnail\"").collect();
    assert_eq!(pieces.len(), 3);
    assert!(!pieces[0].contains("<figure class=\"player\""), "an animation outside of the sheet");
    for (piece, name) in pieces[1..].iter().zip(names) {
        assert!(piece.starts_with(&format!(" id=\"scene-{name}\"><summary><svg ")), "{name}");
        assert_eq!(piece.matches("<figure class=\"player\"").count(), 1, "{name}");
    }
    // One body: five instants over each other. Several bodies would hide each other.
    let instants =
        |piece: &str| piece.split("</summary>").next().unwrap().matches("<g opacity=").count();
    assert_eq!((instants(pieces[1]), instants(pieces[2])), (5, 1));
}
