use lcplab_page::page::{Block, Page, Section, Tile};
use lcplab_page::plot::Scale;

fn rendered(block: Block) -> String {
    let section = Section { id: "one".into(), blocks: vec![block], ..Section::default() };
    Page { title: "A page".into(), sections: vec![section], ..Page::default() }.render().unwrap()
}

#[test]
fn a_comma_after_a_formula_stays_on_its_line() {
    let page = rendered(Block::Text("The bounds $lo$, which hold, and $x$ too.".into()));
    let after = |name: &str| page.split(&format!("{name}</mi>")).nth(1).unwrap().to_string();
    assert!(page.contains("</math>,</span> which hold"), "{}", after("o"));
    assert_eq!(page.matches("class=\"nobr\"").count(), 1, "nothing but the comma is tied");
}

#[test]
fn the_parts_of_an_equation_can_stand_below_each_other() {
    let formulas = |latex: &str| {
        let page = rendered(Block::Equation { latex: latex.into(), label: None });
        page.matches("<math").count()
    };
    assert_eq!(formulas("w = A x + b, \\quad lo \\le x, \\qquad x \\le hi"), 3);
    assert_eq!(formulas("w = A x + b"), 1);
    // What stands in brackets that grow, or in a matrix, cannot be separated.
    assert_eq!(formulas("\\left( a \\quad b \\right)"), 1);
}

#[test]
fn a_good_result_and_a_bad_one_are_marked() {
    let tile = |good| Tile {
        value: "3 of 4".into(),
        label: "answers accepted".into(),
        section: "one".into(),
        good,
    };
    for (good, class) in [(true, "good"), (false, "bad")] {
        let page = rendered(Block::Tiles(vec![tile(good)]));
        assert!(page.contains(&format!("<b class=\"{class}\">3 of 4</b>")));
    }
}

#[test]
fn a_linear_axis_has_at_least_three_ticks() {
    for most in [9.0, 40.5, 41.0, 90.0, 99.0, 1.3, 7e-4] {
        for wanted in 2..9 {
            let ticks = Scale::Linear.ticks((0.0, most), wanted).len();
            assert!((3..=2 * wanted + 1).contains(&ticks), "{most}, {wanted}: {ticks}");
        }
    }
}
