use lcplab_files as files;
use lcplab_judge::{Demand, judge, judge_friction};
use lcplab_lcp::file::Problem;
use lcplab_lcp::friction::{Contact, Model};
use lcplab_lcp::{Coupling, Lcp, Matrix, library};
use lcplab_solver::{Options, Registry, Start};
use proptest::prelude::*;

use super::{again, assert_same, frictions, message, parse, refusal, rows, sample};
use lcplab_testing::{INF, assert_proved, cases};

/// The problem of a file of this name among the samples.
fn sample_of(name: &str) -> Problem {
    files::read(&sample(&format!("siconos/{name}.dat")), None).unwrap()
}

/// The text of such a file.
fn text_of(name: &str) -> String {
    std::fs::read_to_string(sample(&format!("siconos/{name}.dat"))).unwrap()
}

const BEGINS_LIKE_NONE: &str = "p: line 1: does not begin like a problem of Siconos: an LCP, a relay \
                                problem, a mixed LCP, or contacts";

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
    let solver = Registry::standard().entry("enumeration").unwrap().build(&Options::default());
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
    let problem = sample_of("contacts");
    assert_eq!(rows(problem.lcp.matrix())[2], [1.0, 0.0, 4.0]);
    assert_eq!(problem.model, Some(Model::CoulombCone));
    let contacts = problem.friction().unwrap().unwrap().contacts().to_vec();
    assert_eq!(contacts, [Contact { rows: [0, 1, 2], mu: 0.5 }]);
}

/// A unit mass on a plane of friction ½ slides: x_t = x_n / 2 and 1.1 x_n = 1.
#[test]
fn contacts_in_the_plane_are_boxes_of_a_normal_and_a_tangent() {
    let problem = sample_of("plane");
    assert_eq!(problem.model, None);
    assert_eq!(problem.lcp.coupled_to(1), Some((0, 0.5)));
    assert_eq!((problem.lcp.lo()[0], problem.lcp.hi()[0]), (0.0, f64::INFINITY));
    assert_proved(&problem.lcp, &[10.0 / 11.0, 5.0 / 11.0]);
}

/// M = diag(1, 2) as triplets and H = [1 0; 1 1] by columns: A = Hᵀ M⁻¹ H, b = Hᵀ M⁻¹ q + b.
#[test]
fn sparse_matrices_are_read_as_csparse_lists_them() {
    let lcp = sample_of("plane_global").lcp;
    assert_eq!(rows(lcp.matrix()), [[1.5, 0.5], [0.5, 0.5]]);
    assert_eq!(lcp.b(), [-1.0, 0.25]);
    // It slides against the tangent: 1.25 x_n = 1.
    assert_proved(&lcp, &[0.8, -0.4]);
    let problem = sample_of("sparse");
    assert_eq!(rows(problem.lcp.matrix()), [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    assert_eq!(problem.model, Some(Model::CoulombCone));
    let with =
        |from: &str, to: &str| message("siconos", &text_of("plane_global").replacen(from, to, 1));
    assert_eq!(with("nnz: 2", "nnz: 3"), "p: line 13: is no entry of the 2 × 2 matrix M");
    assert_eq!(with("    1 1 : 2", "    1 2 : 2"), "p: line 10: is no entry of the 2 × 2 matrix M");
    assert_eq!(with("nnz: 3", "nnz: 4"), "p: line 21: H has 3 numbers, nnz is 4");
    assert_eq!(with("col 1", "col 2"), "p: line 20: is not line 1: \"col 2 : locations 2 to 2\"");
    assert_eq!(
        with("2-by-2", "2-by-3"),
        "p: line 8: must state 2-by-2 and nnz of M: \"triplet: 2-by-3, nzmax: 2 nnz: 2\""
    );
}

/// The same matrix by rows.
#[test]
fn rows_of_a_listing_are_not_taken_for_columns() {
    let by_rows = text_of("plane_global").replace("col", "row").replacen(
        "2-by-2, nzmax: 3",
        "2-by-2, nzmax: 9",
        1,
    );
    // H is then [1 1; 0 1]: A = [1 1; 1 1.5].
    let lcp = parse("siconos", &by_rows).unwrap().lcp;
    assert_eq!(rows(lcp.matrix()), [[1.0, 1.0], [1.0, 1.5]]);
}

#[test]
fn each_defect_has_its_line() {
    let cases = [
        ("", "p: is empty"),
        ("only words", "p: has no numbers"),
        ("2 0 2 2 2 3", "p: line 1: 2 × 3 here, 2 × 2 before"),
        ("1\n2\n1\n1", "p: line 4: the file ends before the origin of M"),
        ("1\n2\n1\n1\n1\nno 1", "p: line 6: the listing of M must begin with CSparse"),
        ("1 0 1 1 1 1 5", "p: line 1: the file ends before q[0]"),
        ("4 4 4 8 8", BEGINS_LIKE_NONE),
        ("x 4 4 8 8", BEGINS_LIKE_NONE),
        ("3\n2\n0\n3\n3\n3 3\n1 0 0 0 1 0 0 0 1", "p: line 7: 2 contacts have not 3 rows"),
        ("1 0 1 1 1 1 5 x", "p: line 1: q[0] must be a number, is \"x\""),
    ];
    for (text, expected) in cases {
        assert_eq!(message("siconos", text), expected);
    }
    let with = |from: &str, to: &str| message("siconos", &BLOCKS.replacen(from, to, 1));
    assert_eq!(with("0\t1\t1", "0\t5\t1"), "p: line 16: block 1 lies outside 3 × 3");
    assert_eq!(
        with("0\t2\t3", "0\t2\t4"),
        "p: line 13: the lists do not determine the positions of 3 blocks"
    );
}

#[test]
fn only_the_bounds_of_an_lcp_or_of_a_relay_problem_are_written() {
    let with = |lo: [f64; 2], hi: [f64; 2]| {
        let a = Matrix::dense(2, &[1.0, 0.0, 0.0, 1.0]);
        Problem::new("", Lcp::new(a, vec![0.0; 2], lo.to_vec(), hi.to_vec()).unwrap())
    };
    let relay = with([-1.0, 0.0], [1.0, 2.5]);
    assert_same(&relay.lcp, &again(&relay, "siconos").lcp);
    let message = refusal(&with([0.0, -1.0], [INF, 1.0]), "siconos");
    assert!(message.starts_with("siconos: row 0: has an infinite bound"), "{message}");
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

/// M = [2 0.5; −1 1], q = (−3, 1), −1 ≤ x_0 ≤ 1, x_1 ≤ 2: x = (1, 0) where 2 + 0 − 3 < 0 and −1 + 0
/// + 1 = 0.
#[test]
fn a_relay_problem_keeps_its_bounds() {
    let lcp = sample_of("relay").lcp;
    assert_eq!(rows(lcp.matrix()), [[2.0, 0.5], [-1.0, 1.0]]);
    assert_eq!((lcp.lo(), lcp.hi()), (&[-1.0, -INF][..], &[1.0, 2.0][..]));
    assert_proved(&lcp, &[1.0, 0.0]);
}

/// The equations are the rows of blocks with the flag 0, or the first ones.
#[test]
fn equations_of_a_mixed_lcp_have_no_bounds() {
    let lcp = sample_of("mixed").lcp;
    assert_eq!(rows(lcp.matrix()), [[2.0, 0.0, -1.0], [0.0, 3.0, 1.0], [1.0, -1.0, 0.0]]);
    assert_eq!((lcp.lo(), lcp.hi()), (&[0.0, 0.0, -INF][..], &[INF; 3][..]));
    let lcp = sample_of("mixed_parts").lcp;
    assert_eq!(rows(lcp.matrix()), [[4.0, -1.0, 0.5], [1.0, 2.0, 1.0], [-0.5, 1.0, 3.0]]);
    assert_eq!((lcp.b(), lcp.lo()), (&[-3.0, 1.0, -2.0][..], &[-INF, 0.0, 0.0][..]));
    assert_same(&lcp, &sample_of("mixed_both").lcp);
}

/// M = [2 1; 1 2] ⊕ 4 ⊕ 1 has the inverse [2 −1; −1 2]/3 ⊕ ¼ ⊕ 1, and H the columns e0 + e3, e1 and
/// 2 e2.
#[test]
fn contacts_with_their_bodies_become_contacts_alone() {
    let problem = sample_of("global");
    let third = 1.0 / 3.0;
    let expected = [[5.0 * third, -third, 0.0], [-third, 2.0 * third, 0.0], [0.0, 0.0, 1.0]];
    assert_near(&rows(problem.lcp.matrix()).concat(), &expected.concat());
    assert_near(problem.lcp.b(), &[-1.0, -2.0, 2.5]);
    assert_eq!(problem.model, Some(Model::CoulombCone));
    let contacts = problem.friction().unwrap().unwrap().contacts().to_vec();
    assert_eq!(contacts, [Contact { rows: [0, 1, 2], mu: 0.5 }]);
}

#[track_caller]
fn assert_near(found: &[f64], expected: &[f64]) {
    let is_near = |(a, b): (&f64, &f64)| (a - b).abs() <= 4.0 * f64::EPSILON;
    assert!(found.iter().zip(expected).all(is_near), "{found:?}");
}

/// Where M has as many rows as the contacts, the file begins like one of contacts alone.
#[test]
fn bodies_with_as_many_rows_as_contacts_are_not_taken_for_contacts_alone() {
    let lcp = sample_of("global_of_three_rows").lcp;
    assert_eq!(rows(lcp.matrix()), [[0.5, 0.0, 0.0], [0.0, 0.5, 0.0], [0.0, 0.0, 0.5]]);
    assert_eq!(lcp.b(), [-4.0, -1.0, 0.5]);
}

/// M = [2 1; −1 1] ⊕ 1, whose inverse is [1 −1; 1 2]/3 ⊕ 1, and q = (0, 3, 0).
#[test]
fn bodies_may_have_an_unsymmetric_matrix() {
    let lcp = sample_of("global_unsymmetric").lcp;
    let third = 1.0 / 3.0;
    let expected = [[third, -third, 0.0], [third, 2.0 * third, 0.0], [0.0, 0.0, 1.0]];
    assert_near(&rows(lcp.matrix()).concat(), &expected.concat());
    assert_near(lcp.b(), &[-1.0, 2.0, 0.0]);
}

#[test]
fn a_matrix_without_inverse_or_half_of_one_is_refused() {
    let with = |mass: &str| {
        let text = text_of("global_of_three_rows");
        message("siconos", &text.replacen("2 0 0\n0 2 0\n0 0 2", mass, 1))
    };
    assert_eq!(with("2 0 0\n0 0 0\n0 0 2"), "p: M: is not positive definite");
    assert_eq!(with("2 0 0\n0 -2 0\n0 0 2"), "p: M: is not positive definite");
    assert!(with("1 2 0\n3 6 0\n0 0 2").starts_with("p: M: is singular"));
    assert!(
        with("2 1 0\n0 2 0\n0 0 2").starts_with("p: M: has entries on one side of its diagonal")
    );
}

/// Hilbert's matrix of ten rows has the condition 1.6e13: of its inverse few digits are known.
#[test]
fn a_badly_conditioned_matrix_of_bodies_is_refused() {
    let hilbert: Vec<String> =
        (0..100).map(|k| format!("{:?}", 1.0 / f64::from(k / 10 + k % 10 + 1))).collect();
    let unit: Vec<&str> = (0..30).map(|k| if k % 11 == 0 { "1" } else { "0" }).collect();
    let text = format!(
        "3 1\n0 10 10 10 10\n{}\n0 10 3 10 3\n{}\n{}\n1 0 0\n0.5",
        hilbert.join(" "),
        unit.join(" "),
        "1 ".repeat(10)
    );
    let message = message("siconos", &text);
    assert!(message.starts_with("p: M: is singular, or so ill-conditioned"), "{message}");
}

#[test]
fn kinds_that_are_not_read_are_refused_by_name() {
    for (name, expected) in [
        ("rolling", "line 1: this seems to be contacts with rolling friction (RFC3D or GRFC3D)"),
        ("plasticity", "line 1: this seems to be a problem of plasticity"),
        (
            "plasticity_of_old",
            "line 15: not understood: 2 numbers after mu; this seems to be contacts",
        ),
        ("cones_of_two", "line 12: a cone of 2 rows: only cones of 3 rows are read"),
        (
            "generic",
            "line 22: a block of the kind 9 in a generic mechanical problem (GMP): only 0, an LCP,",
        ),
        ("matrix", "line 1: this seems to be a matrix alone"),
        ("rectangular", "line 12: M of this mixed LCP (MLCP) is 3 × 2"),
        ("three_more", "line 9: not understood: 3 numbers after q, with which an LCP ends"),
        ("labels", "line 9: not understood: 6 numbers after q"),
        ("two_mixed", "M[0][1]: is -1, but -0.5 in A to D of this mixed LCP (MLCP)"),
    ] {
        let message = message("siconos", &text_of(&format!("refused_{name}")));
        assert!(message.starts_with(&format!("p: {expected}")), "{message}");
    }
}

/// Whether the judge accepts x under the friction model of the file.
fn is_solution(problem: &Problem, x: &[f64]) -> bool {
    let friction = problem.friction().unwrap().unwrap();
    let posed = problem.model.unwrap().pose(&friction, None).unwrap();
    judge_friction(&posed, x, &Demand::default()).verdict.is_solution()
}

/// As Siconos' own files end: z and w of an answer, without the first number of z.
#[test]
fn an_answer_behind_a_mixed_problem_is_left_out_with_a_warning() {
    let problem = sample_of("mixed_answer");
    assert_eq!(rows(problem.lcp.matrix()), [[1.0, -1.0], [0.0, 1.0]]);
    assert_eq!((problem.lcp.b(), problem.lcp.lo()), (&[-1.0, 1.0][..], &[-INF, 0.0][..]));
    let expected = "not part of the problem: the last 2 numbers, a known answer";
    assert!(problem.warnings.len() == 1 && problem.warnings[0].ends_with(expected));
}

/// One complementary row, one equation and one contact: 2 x₀ + x₁ = 1 and 4 x₁ = −2; the contact
/// slides with x_n = 1.
#[test]
fn a_generic_mechanical_problem_has_complementary_rows_equations_and_contacts() {
    let problem = sample_of("generic");
    assert_eq!(problem.model, Some(Model::CoulombCone));
    assert_eq!(rows(problem.lcp.matrix())[0], [2.0, 1.0, 0.0, 0.0, 0.0]);
    assert_eq!(problem.lcp.lo(), [0.0, -INF, 0.0, -INF, -INF]);
    let contacts = problem.friction().unwrap().unwrap().contacts().to_vec();
    assert_eq!(contacts, [Contact { rows: [2, 3, 4], mu: 0.5 }]);
    assert!(is_solution(&problem, &[0.75, -0.5, 1.0, 0.5, 0.0]));
    assert!(!is_solution(&problem, &[0.5, -0.5, 1.0, 0.5, 0.0]));
}

/// With A = 1 the answer is the nearest point of the cone ‖x_t‖ ≤ x_n / 2: that to (1, 2, 0) lies
/// on the edge (1, ½, 0) at 2 / 1.25. Under Coulomb's law x_n would be 1.
#[test]
fn second_order_cones_are_the_associated_cone() {
    for (name, expected) in
        [("cones", &[1.6, 0.8, 0.0, 1.0, 0.0, 0.0][..]), ("cones_flag", &[1.0, 0.0, 0.0][..])]
    {
        let problem = sample_of(name);
        assert_eq!(problem.model, Some(Model::AssociatedCone));
        assert!(is_solution(&problem, expected), "{name}");
    }
}

#[test]
fn a_comment_behind_the_numbers_is_reported() {
    let warnings = sample_of("lcp_blocks_comment").warnings;
    let expected = "line 20: text taken as a comment: \"# two rows of Murty (1988)\"";
    assert!(warnings.len() == 1 && warnings[0].ends_with(expected), "{warnings:?}");
    for quiet in ["contacts", "contacts_blocks_flag", "global", "relay", "mixed_both"] {
        assert_eq!(sample_of(quiet).warnings, [""; 0], "{quiet}");
    }
}

/// The samples, and by how many numbers more or fewer each is still the whole of a problem: an LCP
/// of two rows becomes a relay problem with four more, the flag may stand behind mu or not, and a
/// mixed LCP of one equation and two complementary rows may end with four numbers of an answer.
const WHOLE: [(&str, &[isize]); 14] = [
    ("plane", &[0]),
    ("lcp", &[0, 4]),
    ("lcp_blocks_comment", &[0, 4]),
    ("relay", &[-4, 0]),
    ("mixed", &[0, 4]),
    ("mixed_parts", &[0, 4]),
    ("mixed_both", &[0, 4]),
    ("contacts", &[0]),
    ("contacts_blocks_flag", &[-1, 0]),
    ("global", &[-1, 0]),
    ("global_of_three_rows", &[0]),
    ("global_unsymmetric", &[0]),
    ("generic", &[0]),
    ("cones", &[0]),
];

proptest! {
    #![proptest_config(cases(300))]

    /// The law: all numbers of a file are understood, or it is refused.
    #[test]
    fn a_file_with_a_number_too_many_or_too_few_is_refused(
        k in 0..WHOLE.len(),
        change in -40isize..40,
        number in prop_oneof![Just("7.5"), Just("0"), Just("3"), Just("nan"), Just("-inf")],
    ) {
        let (name, whole) = WHOLE[k];
        let text = text_of(name);
        let words: Vec<&str> = text.split('#').next().unwrap().split_whitespace().collect();
        let kept = words.len().saturating_add_signed(change.min(0));
        let mut changed = words[..kept].to_vec();
        changed.extend(std::iter::repeat_n(number, change.max(0) as usize));
        let is_read = parse("siconos", &changed.join(" ")).is_ok();
        let is_flag = change == 1 && number == "0" && whole[0] == 0 && name.starts_with(['c', 'g', 'p'])
            && name != "generic";
        prop_assert!(!is_read || whole.contains(&change) || is_flag, "{name} {change} {number}");
        prop_assert!(is_read || change != 0, "{name}");
    }
}
