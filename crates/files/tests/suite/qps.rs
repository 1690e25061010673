use lcplab_files as exchange;
use lcplab_problem::file::Problem;
use lcplab_problem::library;
use proptest::prelude::*;

use super::{again, assert_same, boxes, message, parse, refusal, rows, sample};
use lcplab_testing::{INF, assert_proved, cases, contacts};

const BOX: &str = "\
* min x² − x y + 2 y² − x + 0 y, 0 ≤ x ≤ 0.25
NAME   a box
ROWS
 N  cost
COLUMNS
 x  cost -1
 y  cost 0
RHS
 rhs cost 5
BOUNDS
 UP bnd x 0.25
 FR bnd y
QUADOBJ
 x x 2 y -1
 y y 4
ENDATA
";

#[test]
fn a_box_qp_is_its_lcp() {
    let problem = parse("qps", BOX).unwrap();
    assert_eq!(problem.name, "a box");
    assert_eq!(rows(problem.lcp.matrix()), [[2.0, -1.0], [-1.0, 4.0]]);
    assert_eq!(problem.lcp.b(), [-1.0, 0.0]);
    assert_eq!((problem.lcp.lo(), problem.lcp.hi()), (&[0.0, -INF][..], &[0.25, INF][..]));
    assert_proved(&problem.lcp, &[0.25, 0.0625]);
}

#[test]
fn what_highs_writes_is_read() {
    let lcp = exchange::read(&sample("highs.qps"), None).unwrap().lcp;
    let third = 0.333333333333333; // HiGHS writes 15 digits
    assert_eq!(rows(lcp.matrix()), [[2.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, third]]);
    assert_eq!(lcp.b(), [-1.0, 0.1, 3.0]);
    assert_eq!((lcp.lo(), lcp.hi()), (&[0.0, -INF, -2.5][..], &[INF, 7.0, -third][..]));
}

#[test]
fn qmatrix_is_all_of_q() {
    let full = BOX.replace("QUADOBJ", "QMATRIX").replace(" y y 4", " y y 4 x -1");
    assert_same(&parse("qps", &full).unwrap().lcp, &parse("qps", BOX).unwrap().lcp);
    let half = BOX.replace("QUADOBJ", "QMATRIX");
    assert_eq!(message("qps", &half), "p: Q[0][1]: is not that of the other triangle");
}

#[test]
fn each_defect_has_its_line() {
    let with = |from: &str, to: &str| message("qps", &BOX.replace(from, to));
    assert_eq!(
        with(" N  cost", " N  cost\n L  row"),
        "p: line 5: row \"row\" is a constraint: only boxes are read"
    );
    assert_eq!(with(" FR bnd y", " FR bnd z"), "p: line 12: there is no column \"z\"");
    assert_eq!(with(" FR bnd y", " BV bnd y"), "p: line 12: integers are not read");
    assert_eq!(with(" FR bnd y", " FR other y"), "p: line 12: a second set of bounds, \"other\"");
    assert_eq!(with("0.25", "much"), "p: line 11: must be a number, is \"much\"");
    assert_eq!(
        with("ENDATA\n", "ENDATA\n* a comment\n\n z z 3\n"),
        "p: line 19: not understood, after ENDATA: \"z z 3\""
    );
    assert_eq!(with("BOUNDS", "BOUNDS 7"), "p: line 10: there is no section \"BOUNDS 7\"");
    assert_eq!(with("ENDATA\n", ""), "p: line 15: the file ends before ENDATA");
    assert_eq!(
        with(" y y 4", " y x -1"),
        "p: line 15: this entry of Q was there already, perhaps in the other triangle"
    );
    assert!(with("0.25", "-1").starts_with("p: column 0 (from 0): has an upper bound below 0"));
    assert_eq!(with("RHS", "OBJSENSE MAX\nRHS"), "p: line 8: \"MAX\" is not read: only MIN");
}

#[test]
fn huge_bounds_are_infinite() {
    let problem = parse("qps", &BOX.replace("0.25", "1e30")).unwrap();
    assert_eq!(problem.lcp.hi(), [INF, INF]);
}

#[test]
fn an_upper_bound_of_0_leaves_the_lower_one_at_0() {
    let problem = parse("qps", &BOX.replace("0.25", "0")).unwrap();
    assert_eq!((problem.lcp.lo(), problem.lcp.hi()), (&[0.0, -INF][..], &[0.0, INF][..]));
}

#[test]
fn only_symmetric_problems_without_friction_are_written() {
    let skew = Problem::new("skew", contacts(&[&[1.0, 2.0], &[0.0, 1.0]], &[0.0, 0.0]));
    assert!(refusal(&skew, "qps").contains("A: is not symmetric"));
    let pushed = library::by_name("pushed-mass").unwrap().generate(&[]).unwrap();
    assert!(refusal(&pushed, "qps").contains("friction_index: is given"));
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn every_bit_survives_the_round_trip(problem in boxes()) {
        let back = again(&problem, "qps");
        assert_same(&problem.lcp, &back.lcp);
        prop_assert_eq!(back.name, "boxes");
    }
}
