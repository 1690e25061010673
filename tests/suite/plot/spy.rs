use lcplab::plot::{Figure, Spy};

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
