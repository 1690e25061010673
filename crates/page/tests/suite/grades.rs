//! Matrices of deviations.

use lcplab_page::figure::Figure;
use lcplab_page::plot::grades::{Grade, Grades};

fn matrix() -> Grades {
    let group = |name: &str| (name.to_string(), vec!["a".to_string(), "b".to_string()]);
    let cells = vec![Grade::Obeyed, Grade::Missed(3.0), Grade::Unknown, Grade::Missed(2e4)];
    Grades {
        id: "laws".into(),
        title: "Laws".into(),
        caption: String::new(),
        groups: vec![group("as installed"), group("accurate")],
        rows: vec![("free fall".into(), cells)],
        links: Vec::new(),
        has_counts: false,
    }
}

#[test]
fn groups_stand_side_by_side_or_on_a_narrow_picture_one_below_the_other() {
    let heights = |svg: &str| {
        let height = |name: &str| -> f64 {
            let tag = svg.split(&format!(">{name}<")).next().unwrap();
            let tag = tag.rsplit("<text ").next().unwrap();
            tag.split(" y=\"").nth(1).unwrap().split('"').next().unwrap().parse().unwrap()
        };
        [height("as installed"), height("accurate")]
    };
    let [left, right] = heights(&matrix().svg());
    assert_eq!(left, right);
    let narrow = matrix().narrow().unwrap();
    let [upper, lower] = heights(&narrow);
    assert!(upper + 21.0 < lower, "{upper}, {lower}");
    // Each group has its own row of the law, with its own cells: 3 in one, 2·10⁴ in the other.
    assert_eq!(narrow.matches(">free fall<").count(), 2);
    let first = narrow.find(">3<").unwrap();
    assert!(first < narrow.find(">accurate<").unwrap());
    assert!(narrow.rfind("#ffffff\">").unwrap() > narrow.find(">accurate<").unwrap());
    // With sixty laws it takes both columns of a printed page.
    assert!(!matrix().svg().contains("class=\"broad\""));
    let mut long = matrix();
    long.rows = vec![long.rows[0].clone(); 60];
    assert!(long.svg().contains("class=\"broad\"") && !long.narrow().unwrap().contains("broad"));
}

#[test]
fn a_deviation_of_thousands_fits_its_cell() {
    for (miss, word) in [
        (1.9, "1.9"),
        (640.0, "640"),
        (999.0, "1k"),
        (6400.0, "6.4k"),
        (2e4, "20k"),
        (190_800.0, "190k"),
        (949_000.0, "950k"),
    ] {
        let mut one = matrix();
        one.rows[0].1[1] = Grade::Missed(miss);
        let svg = one.svg();
        assert!(svg.contains(&format!(">{word}<")) && word.chars().count() <= 4, "{miss}: {svg}");
    }
}
