use lcplab_judge::{Demand, judge};
use lcplab_problem::file::Problem;
use lcplab_problem::friction::{Contact, Model};
use lcplab_problem::{Coupling, Lcp, Matrix, library};
use lcplab_solver::{Options, Start, by_name};
use proptest::prelude::*;

use super::{again, assert_same, frictions, message, parse, refusal, rows};
use lcplab_testing::{INF, assert_proved, cases};

/// The portfolio problem of Cottle, Pang & Stone, column by column.
const PORTFOLIO: &str = "4
0
4
4
4\t4
11 0 10 1
0 11 10 1
10 10 21 1
-1 -1 -1 0
50 50 10 -6
";

#[test]
fn friction_without_contacts_has_no_model_and_survives_as_json() {
    let problem = parse("siconos", "3 0 0 0 0 0 0\n").unwrap();
    assert_eq!((problem.lcp.len(), problem.model), (0, None));
    assert!(Problem::parse(&problem.to_json().to_string(), "again").is_ok());
}

#[test]
fn a_dense_matrix_is_listed_by_columns() {
    let problem = parse("siconos", PORTFOLIO).unwrap();
    assert_eq!(rows(problem.lcp.matrix())[0], [11.0, 0.0, 10.0, -1.0]);
    assert_eq!((problem.lcp.lo(), problem.lcp.hi()), (&[0.0; 4][..], &[INF; 4][..]));
    assert_proved(&problem.lcp, &[2.0, 2.0, 2.0, 92.0]);
    let published = library::by_name("cps-4").unwrap().generate(&[]).unwrap();
    assert_same(&published.lcp, &problem.lcp);
}

/// Read by rows, the portfolio has no solution: why Siconos' own files were once called insoluble.
#[test]
fn read_by_rows_the_portfolio_would_be_insoluble() {
    let by_rows = "4\n0\n4\n4\n4 4\n11 0 10 -1 0 11 10 -1 10 10 21 -1 1 1 1 0\n50 50 10 -6";
    let lcp = parse("siconos", by_rows).unwrap().lcp; // the matrix transposed
    let solver = by_name("enumeration", &Options::default()).unwrap();
    let x = solver.solve(&lcp, &Start::default(), &mut ()).x;
    assert!(!judge(&lcp, &x, &Demand::default()).verdict.is_solution());
}

/// Two blocks on the diagonal and one beside them, each by columns.
const BLOCKS: &str = "3
1
3
3
3
2
2
2\t3\t
2\t3\t
3
3
0\t2\t3\t
0\t1\t1\t
0
 1 2 3 4
1
 5 6
2
 7
 -1 -2 -3 ";

#[test]
fn blocks_are_read_and_each_is_listed_by_columns() {
    let lcp = parse("siconos", BLOCKS).unwrap().lcp;
    assert_eq!(rows(lcp.matrix()), [[1.0, 3.0, 5.0], [2.0, 4.0, 6.0], [0.0, 0.0, 7.0]]);
    assert_eq!(lcp.b(), [-1.0, -2.0, -3.0]);
}

#[test]
fn a_friction_problem_has_its_contacts_as_n_t1_t2() {
    let text = "3\n1\n0\n3\n3\n3 3\n2 0 1\n0 3 0\n0 0 4\n-1 2 0\n0.5\n and what follows";
    let problem = parse("siconos", text).unwrap();
    assert_eq!(rows(problem.lcp.matrix())[2], [1.0, 0.0, 4.0]);
    assert_eq!(problem.model, Some(Model::CoulombCone));
    let contacts = problem.friction().unwrap().unwrap().contacts().to_vec();
    assert_eq!(contacts, [Contact { rows: [0, 1, 2], mu: 0.5 }]);
    assert!(problem.warnings[0].ends_with("what follows the problem is ignored"));
}

#[test]
fn each_defect_has_its_line() {
    let cases = [
        ("", "p: line 0: the file ends before the number of rows"),
        ("2 0 2 2 2 3", "p: line 1: 2 × 3 here, 2 × 2 before"),
        ("1\n2\n1\n1", "p: line 4: storage 2 is not read: only 0, dense, and 1, blocks"),
        ("1 0 1 1 1 1 5", "p: line 1: the file ends before q[0]"),
        ("2 4 0 8 8", "p: line 1: neither an LCP nor contacts in space: dimension 2"),
        ("3\n2\n0\n3\n3\n3 3\n1 0 0 0 1 0 0 0 1", "p: line 7: 2 contacts have not 3 rows"),
        ("1 0 1 1 1 1 5 x", "p: line 1: q[0] must be a number, is \"x\""),
    ];
    for (text, expected) in cases {
        assert_eq!(message("siconos", text), expected);
    }
    let with = |from: &str, to: &str| message("siconos", &BLOCKS.replacen(from, to, 1));
    assert_eq!(with("0\t1\t1", "0\t5\t1"), "p: line 16: block 1 lies outside 3 × 3");
    assert_eq!(with("0\t2\t3", "0\t2\t4"), "p: line 13: the lists do not tell where 3 blocks are");
}

#[test]
fn boxes_are_not_written() {
    let boxed = library::by_name("manufactured").unwrap().generate(&[("boxed", 1.0)]).unwrap();
    assert!(refusal(&boxed, "siconos").contains("has other bounds than 0 and inf"));
}

#[test]
fn a_friction_problem_has_its_contacts_and_nothing_else() {
    // Row 3 is an equation of no contact; with a lower bound it is not even that.
    let with = |lo: f64| {
        let a = Matrix::dense(4, &std::array::from_fn::<_, 16, _>(|k| f64::from(k % 5 == 0)));
        let lcp = Lcp::new(a, vec![0.0; 4], vec![0.0, -INF, -INF, lo], vec![INF; 4]).unwrap();
        let index = vec![None, Some(0), Some(0), None];
        let coupling = Coupling::new(index, vec![0.0, 0.5, 0.5, 0.0]).unwrap();
        refusal(&Problem::new("", lcp.with_coupling(coupling).unwrap()), "siconos")
    };
    assert_eq!(
        with(-INF),
        "siconos: row 3: belongs to no contact: a friction problem of Siconos has no other rows"
    );
    assert_eq!(
        with(0.0),
        "siconos: row 3: is neither a contact with friction nor an equation for siconos"
    );
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn every_bit_survives_the_round_trip(friction in frictions(0)) {
        assert_same(&friction.lcp, &again(&friction, "siconos").lcp);
    }
}
