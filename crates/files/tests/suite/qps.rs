use lcplab_files as files;
use lcplab_lcp::file::Problem;
use lcplab_lcp::library;
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
    let lcp = files::read(&sample("highs.qps"), None).unwrap().lcp;
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
    assert_eq!(with(" N  cost", " N  cost\n N  other"), "p: line 5: there are two objectives");
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

/// min x² + y² − x with these rows.
fn constrained(rows: &str, columns: [&str; 2], rhs: &str) -> Problem {
    let [x, y] = columns;
    let text = format!(
        "NAME c\nROWS\n N cost\n{rows}COLUMNS\n x cost -1 {x}\n y {y}\n{rhs}BOUNDS\n FR bnd x\n \
         FR bnd y\nQUADOBJ\n x x 2\n y y 2\nENDATA\n"
    );
    parse("qps", &text).unwrap()
}

/// Each minimum by hand, from the gradient (2x − 1, 2y) = y₁ a.
#[test]
fn constraints_are_rows_of_their_multipliers() {
    // x + y ≥ 2: (2x − 1, 2y) = (z, z) and x + y = 2.
    let least = constrained(" G sum\n", ["sum 1", "sum 1"], "RHS\n rhs sum 2\n");
    assert_proved(&least.lcp, &[1.25, 0.75, 1.5]);
    assert_eq!(least.extra["rows"][2]["label"], "multiplier of sum");
    // x + y ≤ −1: the multiplier pushes down.
    let most = constrained(" L sum\n", ["sum 1", "sum 1"], "RHS\n rhs sum -1\n");
    assert_proved(&most.lcp, &[-0.25, -0.75, -1.5]);
    // x = 3, and x − y between 1 and 2, at 2.
    let rows = constrained(
        " E fix\n L apart\n",
        ["fix 1 apart 1", "apart -1"],
        "RHS\n rhs fix 3 apart 2\nRANGES\n rng apart 1\n",
    );
    assert_proved(&rows.lcp, &[3.0, 1.0, 7.0, -2.0, 2.0]);
    // A range of an equation: 1 ≤ x ≤ 3 if positive, −1 ≤ x ≤ 1 if negative.
    for (range, x, multiplier) in [("2", 1.0, 1.0), ("-2", 0.5, 0.0)] {
        let rhs = format!("RHS\n rhs fix 1\nRANGES\n rng fix {range}\n");
        let problem = constrained(" E fix\n", ["fix 1", "fix 0"], &rhs);
        assert_proved(&problem.lcp, &[x, 0.0, multiplier, x]);
    }
}

#[test]
fn each_defect_of_a_constraint_has_its_line() {
    let text = "NAME c\nROWS\n N cost\n G sum\nCOLUMNS\n x cost 1 sum 1\nRHS\n rhs sum 2\nENDATA\n";
    let with = |from: &str, to: &str| message("qps", &text.replace(from, to));
    assert_eq!(with(" G sum", " Q sum"), "p: line 4: there is no kind of row \"Q\"");
    assert_eq!(with(" G sum", " G sum\n L sum"), "p: line 5: a second row \"sum\"");
    assert_eq!(with("rhs sum 2", "rhs sun 2"), "p: line 8: there is no row \"sun\"");
    assert_eq!(
        with("rhs sum 2", "rhs sum 2\n rhs sum 3"),
        "p: line 9: a second right-hand side of row \"sum\""
    );
    assert_eq!(with("rhs sum 2", "rhs cost 2\n b sum 3"), "p: line 9: a second set of RHS, \"b\"");
    assert_eq!(
        with(" x cost 1 sum 1", " x sum 1\n x sum 2"),
        "p: line 7: a second entry of this column in row \"sum\""
    );
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
