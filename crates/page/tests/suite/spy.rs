use lcplab_page::plot::{Figure, Spy};

use super::assert_well_formed;

fn spy(shape: (usize, usize), entries: Vec<(usize, usize)>) -> Spy {
    Spy::new("a", "Pattern of A", "Where A is not zero.", shape, entries).unwrap()
}

#[test]
fn counts_are_exact() {
    let pattern = spy((4, 5), vec![(0, 0), (3, 4), (1, 2), (3, 4)]);
    assert_eq!((pattern.nonzeros(), pattern.fill()), (3, 15.0));
    assert_eq!(pattern.csv(), "row,column\n0,0\n1,2\n3,4\n");
    assert!(pattern.svg().contains("4 × 5,  3 nonzeros,  15 % filled"));
    assert_well_formed(&pattern);
}

#[test]
fn a_large_pattern_stays_small_and_whole() {
    let band = (0..760usize)
        .flat_map(|i| [0, 1, 39].map(|d| (i, (i + d).min(759))))
        .chain([(759, 0)])
        .collect();
    let pattern = spy((760, 760), band);
    let svg = pattern.svg();
    assert!(svg.len() < 40_000, "{} bytes", svg.len());
    assert!(svg.contains("M0 755h5v5h-5z"), "a lone entry in the corner is seen");
    assert_eq!(pattern.csv().lines().count(), pattern.nonzeros() + 1);
    assert_well_formed(&pattern);
}

#[test]
fn every_shape_is_drawn() {
    for shape in [(0, 0), (0, 3), (1, 1), (1, 5000), (5000, 1), (161, 161), (7, 300)] {
        let entries = if shape.0 * shape.1 > 0 { vec![(shape.0 - 1, shape.1 - 1)] } else { vec![] };
        assert_well_formed(&spy(shape, entries));
    }
}

#[test]
fn an_entry_outside_is_an_error_with_its_place() {
    let error = Spy::new("a", "Pattern of A", "", (2, 3), [(0, 2), (2, 0)]).unwrap_err();
    assert_eq!(error.to_string(), "Pattern of A: entry (2, 0): is outside 2 × 3");
}

#[test]
fn a_raster_counts_the_entries_of_each_cell() {
    use lcplab_page::plot::Raster;
    let raster = |n: usize| Raster::new((n, n), 8, |mark| (0..n).for_each(|i| mark(i, i)));
    assert_eq!(raster(3).cells, ["4", "04", "004"]);
    // 20 rows in cells of 3: three of nine entries are a third; the last cell has two of four.
    assert_eq!((raster(20).block, raster(20).nonzeros), (3, 20));
    assert_eq!(raster(20).cells[0], "3");
    assert_eq!(raster(20).cells[6], "0000004");
}

#[test]
fn blocks_with_a_common_body_can_be_pointed_at_and_the_data_names_them() {
    use lcplab_page::plot::scene_matrix::{Block, SceneMatrix};
    let block = |name: &str, bodies: &[usize]| Block {
        name: name.into(),
        bodies: bodies.into(),
        second: vec![false, true],
    };
    let figure = SceneMatrix {
        id: "a".into(),
        title: "A is half full".into(),
        caption: String::new(),
        scene: "<g data-body=\"1\"><path d=\"M0 0h9v9z\"/></g>".into(),
        blocks: vec![block("<ground> – a", &[1]), block("a – b", &[1, 2]), block("b – c", &[2, 3])],
        kinds: ["normal".into(), "friction".into()],
        entries: vec![(0, 0, 2.0), (0, 2, -1.0), (3, 1, 0.01)],
        factors: Vec::new(),
    };
    assert_well_formed(&figure);
    let svg = figure.svg();
    // Three diagonal blocks, and two neighbors on either side.
    assert_eq!(svg.matches("class=\"pair\"").count(), 7);
    assert_eq!(svg.matches("data-bodies=\"1 2\"").count(), 1);
    assert!(figure.csv().ends_with("3,1,0.01,a – b,<ground> – a\n"));
}
