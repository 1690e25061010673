//! Derivatives of solutions: closed forms, and mistakes that are planted.
//!
//! Random problems are compared with exact difference quotients in
//! `tests/independent/gradients.py`.

use lcplab_analysis::gradient::{Comparison, Direction, Gradient, Status, Theirs};
use lcplab_lcp::error::Result;
use lcplab_lcp::file::Problem;
use lcplab_lcp::{Coupling, Lcp, Matrix};
use nalgebra::DMatrix;
use serde_json::{Value, json};

use lcplab_testing::INF;

fn problem(value: &Value) -> Problem {
    Problem::parse(&value.to_string(), "test.json").unwrap()
}

fn one_sided(gradient: &Gradient, direction: &str) -> [Vec<f64>; 2] {
    let direction = Direction::read(direction, "direction").unwrap();
    let numbers = |v: &[dashu_ratio::RBig]| v.iter().map(|x| x.to_f64().value()).collect();
    gradient.directional(&direction).unwrap().map(|side| numbers(&side.x.unwrap()))
}

#[test]
fn one_contact_has_the_derivative_of_its_closed_form() {
    // x = max(0, −b/a): dx/db = −1/a and dx/da = b/a² where b < 0, else 0.
    for (b, x, slope, of_a) in [(-3.0, 0.75, "-1/4", "-3/16"), (3.0, 0.0, "0", "0")] {
        let gradient =
            Gradient::of(&problem(&json!({"A": {"dense": [[4]]}, "b": [b]})), &[x]).unwrap();
        assert_eq!(gradient.status(), &Status::Differentiable);
        let pullback = gradient.pullback(&[1.0], None).unwrap();
        assert_eq!(
            (pullback.b[0].to_string(), pullback.a(0, 0).to_string()),
            (slope.into(), of_a.into())
        );
    }
    let kink = Gradient::of(&problem(&json!({"A": {"dense": [[4]]}, "b": [0]})), &[0.0]).unwrap();
    assert_eq!(kink.status(), &Status::Kink(vec![0]));
    assert_eq!(one_sided(&kink, r#"{"b": [1]}"#), [[0.0], [-0.25]]);
    let error = kink.pullback(&[1.0], None).unwrap_err().to_string();
    assert_eq!(error, "gradient: x: x has a kink at row 0: it has one-sided derivatives only");
}

#[test]
fn a_bound_passes_its_change_on_and_a_free_neighbor_follows() {
    // x_1 = lo_1 = 1, 2 x_0 − x_1 = 1: dx_0/dlo_1 = 1/2.
    let given =
        json!({"A": {"dense": [[2, -1], [-1, 2]]}, "b": [-1, 2], "lo": [0, 1], "hi": [9, 9]});
    let gradient = Gradient::of(&problem(&given), &[1.0, 1.0]).unwrap();
    let pullback = gradient.pullback(&[1.0, 0.0], None).unwrap();
    assert_eq!(pullback.lo[1].to_string(), "1/2");
    assert_eq!(one_sided(&gradient, r#"{"lo": [0, 1]}"#), [[0.5, 1.0], [0.5, 1.0]]);
}

#[test]
fn sliding_friction_follows_the_normal_force_and_its_coefficient() {
    // x_0 = −b_0/a, x_1 = μ x_0: dx_1/dμ = x_0, dx_1/db_0 = −μ/a.
    let given = json!({"A": {"dense": [[2, 0], [0, 2]]}, "b": [-4, -9], "friction_index": [-1, 0], "mu": [0, 0.5]});
    let gradient = Gradient::of(&problem(&given), &[2.0, 1.0]).unwrap();
    let pullback = gradient.pullback(&[0.0, 1.0], None).unwrap();
    assert_eq!(
        (pullback.mu[1].to_string(), pullback.b[0].to_string()),
        ("2".into(), "-1/4".into())
    );
    assert!(pullback.lo.iter().chain(&pullback.hi).all(|own| *own == 0.into()));
}

#[test]
fn a_contact_that_closes_without_slip_sticks_or_slides_by_the_direction() {
    // Force and slip are 0. For b + t (−2, −s): x_0 = t, x_1 = min(s/2, μ) t.
    let given = json!({"A": {"dense": [[2, 0], [0, 2]]}, "b": [0, 0], "friction_index": [-1, 0], "mu": [0, 0.5]});
    let gradient = Gradient::of(&problem(&given), &[0.0, 0.0]).unwrap();
    assert_eq!(gradient.status(), &Status::Kink(vec![0, 1]));
    assert_eq!(one_sided(&gradient, r#"{"b": [-2, -0.5]}"#), [[1.0, 0.25], [0.0, 0.0]]);
    assert_eq!(one_sided(&gradient, r#"{"b": [-2, -8]}"#), [[1.0, 0.5], [0.0, 0.0]]);
    assert_eq!(one_sided(&gradient, r#"{"b": [-2, 8]}"#), [[1.0, -0.5], [0.0, 0.0]]);
}

#[test]
fn a_kink_whose_directions_have_several_answers_is_not_unique() {
    // det A < 0: near b = 0 there are three solutions or one.
    let gradient =
        Gradient::of(&problem(&json!({"A": {"dense": [[1, 2], [2, 1]]}, "b": [0, 0]})), &[0.0; 2]);
    assert_eq!(gradient.unwrap().status(), &Status::NotUnique);
}

#[test]
fn twelve_kinks_are_examined_and_thirteen_are_not() {
    let at_rest = |n: usize, index: Vec<i64>| {
        let entry = |i: usize, j: usize| if i == j { 40.0 } else { -1.0 };
        let dense: Vec<Vec<f64>> = (0..n).map(|i| (0..n).map(|j| entry(i, j)).collect()).collect();
        let mu = vec![0.5; n];
        let given =
            json!({"A": {"dense": dense}, "b": vec![0.0; n], "friction_index": index, "mu": mu});
        Gradient::of(&problem(&given), &vec![0.0; n]).unwrap()
    };
    assert!(matches!(at_rest(12, vec![-1; 12]).status(), Status::Kink(rows) if rows.len() == 12));
    assert!(matches!(at_rest(13, vec![-1; 13]).status(), Status::NotExamined(_)));
    // A contact without force and slip has 2 × 3 × 3 choices: two are examined, four are not.
    assert!(matches!(at_rest(6, vec![-1, 0, 0, -1, 3, 3]).status(), Status::Kink(_)));
    let four = vec![-1, 0, 0, -1, 3, 3, -1, 6, 6, -1, 9, 9];
    assert!(matches!(at_rest(12, four).status(), Status::NotExamined(_)));
}

#[test]
fn rounding_next_to_a_kink_is_reported() {
    let given = json!({"A": {"dense": [[1, 1], [1, 2]]}, "b": [-1, -0.9999999999999999]});
    let gradient = Gradient::of(&problem(&given), &[1.0, 0.0]).unwrap();
    assert_eq!((gradient.status(), gradient.near_kink()), (&Status::Differentiable, &[1][..]));
    assert!(gradient.certificate().ends_with("within rounding of a kink at row 1"));
}

#[test]
fn a_table_on_four_feet_has_the_derivative_of_its_motion_only() {
    // Mass 2, feet at (±1, ±1), inertias 1; two of the feet carry the load, or all do.
    let feet = [[1.0, 1.0], [1.0, -1.0], [-1.0, -1.0], [-1.0, 1.0]];
    let a = |i: usize, j: usize| 0.5 + feet[i][0] * feet[j][0] + feet[i][1] * feet[j][1];
    let dense: Vec<Vec<f64>> = (0..4).map(|i| (0..4).map(|j| a(i, j)).collect()).collect();
    let jacobian: Vec<Value> = (0..4)
        .flat_map(|i| [json!([i, 0, 1]), json!([i, 1, feet[i][0]]), json!([i, 2, feet[i][1]])])
        .collect();
    let given = json!({"A": {"dense": dense}, "b": [-1, -1, -1, -1], "motion": {
        "mass": [[0, 0, 2], [1, 1, 1], [2, 2, 1]], "jacobian": jacobian,
        "bias": [0, 0, 0, 0], "compliance": [0, 0, 0, 0], "target": [-1, 0, 0]}});
    for x in [[0.5; 4], [1.0, 0.0, 1.0, 0.0]] {
        let gradient = Gradient::of(&problem(&given), &x).unwrap();
        assert_eq!(gradient.status(), &Status::NotUnique);
        assert!(gradient.is_of_motion());
        // It stays at rest, whatever pushes it.
        let target = Direction { target: vec![1.0, 0.5, 0.25], ..Direction::default() };
        let [right, _] = gradient.directional(&target).unwrap();
        assert_eq!((right.x, right.u.unwrap()), (None, vec![0.into(), 0.into(), 0.into()]));
        let foot = Direction { bias: vec![1.0, 0.0, 0.0, 0.0], ..Direction::default() };
        assert!(
            gradient.directional(&foot).unwrap_err().to_string().contains("target and mass only")
        );
        assert!(gradient.pullback(&[1.0; 4], None).is_err());
    }
}

#[test]
fn a_free_body_pushed_by_one_contact_has_the_derivatives_of_newton() {
    // u = u* + x/m, x = −m (u* + bias): at the contact u stays −bias, and x is −m u*.
    let given = json!({"A": {"dense": [[0.5]]}, "b": [-3], "motion": {
        "mass": [[0, 0, 2]], "jacobian": [[0, 0, 1]], "bias": [0], "compliance": [0], "target": [-3]}});
    let gradient = Gradient::of(&problem(&given), &[6.0]).unwrap();
    let of_x = gradient.pullback(&[1.0], None).unwrap().motion.unwrap();
    assert_eq!(
        (of_x.target[0].to_string(), of_x.mass[0][0].to_string()),
        ("-2".into(), "3".into())
    );
    // x = −m u*/j: dx/dj = m u*/j² = −6.
    assert_eq!(
        (of_x.jacobian[0][0].to_string(), of_x.bias[0].to_string()),
        ("-6".into(), "-2".into())
    );
    let of_u = gradient.pullback(&[0.0], Some(&[1.0])).unwrap().motion.unwrap();
    assert_eq!((of_u.target[0].to_string(), of_u.bias[0].to_string()), ("0".into(), "-1".into()));
    assert_eq!(
        (of_u.mass[0][0].to_string(), of_u.jacobian[0][0].to_string()),
        ("0".into(), "0".into())
    );
}

#[test]
fn a_wrong_answer_has_no_derivative() {
    let given = problem(&json!({"A": {"dense": [[4]]}, "b": [-3]}));
    let error = Gradient::of(&given, &[0.5]).unwrap_err().to_string();
    assert!(
        error.starts_with("answer: x: no exact solution is known next to it (not a solution"),
        "{error}"
    );
}

/// Nine rows: a contact that slides along its second row and sticks along its third, an open
/// contact, and a weld.
struct Mechanism {
    problem: Problem,
    x: Vec<f64>,
    a: DMatrix<f64>,
}

const FREE: [usize; 5] = [0, 2, 6, 7, 8];
/// Row 1 slides on its upper bound, μ = 1/2.
const SLIDES: &[(usize, usize, f64)] = &[(1, 0, 0.5)];

impl Mechanism {
    fn new() -> Result<Self> {
        let g = DMatrix::from_fn(9, 9, |i, j| ((7 * i + 3 * j + i * j) % 5) as f64 / 4.0 - 0.5);
        let a = &g * g.transpose() + DMatrix::identity(9, 9) * 3.0;
        let x = vec![1.0, 0.5, 0.125, 0.0, 0.0, 0.0, 0.75, -0.5, 0.25];
        let w = [0.0, -1.0, 0.0, 2.0, 0.5, -0.5, 0.0, 0.0, 0.0];
        let ax = &a * DMatrix::from_column_slice(9, 1, &x);
        let b: Vec<f64> = (0..9).map(|i| w[i] - ax[i]).collect();
        let rows: Vec<Vec<f64>> = (0..9).map(|i| (0..9).map(|j| a[(i, j)]).collect()).collect();
        let entries: Vec<f64> = rows.concat();
        let lo = [0.0, -INF, -INF, 0.0, -INF, -INF, -INF, -INF, -INF].to_vec();
        let index = vec![None, Some(0), Some(0), None, Some(3), Some(3), None, None, None];
        let mu = vec![0.0, 0.5, 0.5, 0.0, 0.5, 0.5, 0.0, 0.0, 0.0];
        let lcp = Lcp::new(Matrix::dense(9, &entries), b, lo, vec![INF; 9])?;
        let lcp = lcp.with_coupling(Coupling::new(index, mu)?)?;
        let mut problem = Problem::new("mechanism", lcp);
        problem.extra.insert("dt".into(), json!(0.01));
        Ok(Mechanism { problem, x, a })
    }

    /// dx/db with these free rows, where others follow a free one in the equations and in x.
    fn derivative(
        &self,
        free: &[usize],
        in_equations: &[(usize, usize, f64)],
        in_x: &[(usize, usize, f64)],
    ) -> DMatrix<f64> {
        let place = |k: usize| free.iter().position(|&i| i == k).unwrap();
        let spread = |follow: &[(usize, usize, f64)]| {
            let mut t = DMatrix::zeros(9, free.len());
            free.iter().enumerate().for_each(|(c, &i)| t[(i, c)] = 1.0);
            follow.iter().for_each(|&(i, k, factor)| t[(i, place(k))] = factor);
            t
        };
        let selection = spread(&[]).transpose();
        let k = &selection * &self.a * spread(in_equations);
        -spread(in_x) * k.try_inverse().unwrap() * selection
    }

    fn right(&self) -> DMatrix<f64> {
        self.derivative(&FREE, SLIDES, SLIDES)
    }

    fn compared(&self, d: &DMatrix<f64>, h: Option<f64>) -> Comparison {
        let gradient = Gradient::of(&self.problem, &self.x).unwrap();
        assert_eq!(gradient.status(), &Status::Differentiable);
        let dx_db = (0..9).map(|i| (0..9).map(|j| d[(i, j)]).collect()).collect();
        let theirs = Theirs { dx_db, h, tolerance: Theirs::TOLERANCE };
        gradient.compare(&theirs).unwrap()
    }

    /// Difference quotients of solutions that Dantzig's method computes.
    fn quotients(&self, h: f64) -> DMatrix<f64> {
        use lcplab_solver::{Dantzig, Solver, Start};
        let lcp = &self.problem.lcp;
        let solved = |j: usize, step: f64| {
            let b = (0..9).map(|i| lcp.b()[i] + if i == j { step } else { 0.0 }).collect();
            Dantzig::default().solve(&lcp.with_b(b).unwrap(), &Start::default(), &mut ()).x
        };
        let columns: Vec<[Vec<f64>; 2]> = (0..9).map(|j| [solved(j, h), solved(j, 0.0)]).collect();
        DMatrix::from_fn(9, 9, |i, j| (columns[j][0][i] - columns[j][1][i]) / h)
    }
}

#[test]
fn a_right_gradient_is_accused_of_nothing() {
    let own = Mechanism::new().unwrap();
    let right = own.right();
    let noisy = right.map_with_location(|i, j, g| g * (1.0 + 1e-6 * (3 * i + j) as f64 / 30.0));
    let added = right.map_with_location(|i, j, g| g + 1e-6 * ((i + 2 * j) % 3) as f64);
    let quotients = own.quotients(1e-6);
    for (d, h) in [
        (right, None),
        (noisy, None),
        (added, None),
        (quotients.clone(), None),
        (quotients, Some(1e-6)),
    ] {
        let found = own.compared(&d, h);
        assert!(found.is_right && found.faults.is_empty(), "{}", found.text());
    }
}

#[test]
fn every_planted_mistake_is_named() {
    let own = Mechanism::new().unwrap();
    let right = own.right();
    let block = |i: usize, j: usize| right[(i - i % 3 + j % 3, j - j % 3 + i % 3)];
    let outer = |i: usize, j: usize| right[(j - j % 3 + i % 3, i - i % 3 + j % 3)];
    let is_weld = |i: usize| i >= 6;
    let mut not_finite = right.clone();
    not_finite[(2, 6)] = f64::NAN;
    // Rounded as if x had been computed with an error of ε |x| / h.
    let step = 1e-13;
    let rounded = right.map_with_location(|i, j, g| g + f64::EPSILON / step * ((i + j) % 3) as f64);
    let planted = [
        ("sign", -&right, None),
        ("transposed", right.transpose(), None),
        ("transposed-blocks", DMatrix::from_fn(9, 9, block), None),
        ("transposed-blocks", DMatrix::from_fn(9, 9, outer), None),
        (
            "missing-constraint",
            right.map_with_location(|i, _, g| if is_weld(i) { 0.0 } else { g }),
            None,
        ),
        (
            "missing-constraint",
            right.map_with_location(|i, j, g| if is_weld(i) || is_weld(j) { 0.0 } else { g }),
            None,
        ),
        ("missing-constraint", own.derivative(&[0, 2], SLIDES, SLIDES), None),
        ("clamped-as-free", own.derivative(&[0, 2, 3, 6, 7, 8], SLIDES, SLIDES), None),
        ("clamped-as-free", own.derivative(&[0, 1, 2, 3, 4, 5, 6, 7, 8], &[], &[]), None),
        ("free-as-clamped", own.derivative(&[0, 6, 7, 8], SLIDES, SLIDES), None),
        ("active-set", own.derivative(&[0, 3, 6, 7, 8], SLIDES, SLIDES), None),
        ("no-coupling", own.derivative(&FREE, &[], &[]), None),
        ("no-coupling", own.derivative(&FREE, &[], SLIDES), None),
        ("finite-differences", own.quotients(3.0), Some(3.0)),
        ("finite-differences", rounded, Some(step)),
        ("factor", &right * 0.01, None),
        ("factor", &right * 0.5, None),
        ("zero", &right * 0.0, None),
        ("not-finite", not_finite, None),
    ];
    for (name, d, h) in planted {
        let found = own.compared(&d, h);
        let names: Vec<&str> = found.faults.iter().map(|(name, _)| *name).collect();
        assert!(!found.is_right && names == [name], "{name}: {}", found.text());
    }
    let text = own.compared(&(&right * -0.01), None).text();
    assert!(
        text.contains("sign: the sign is reversed") && text.contains("0.01, the time step"),
        "{text}"
    );
    let other = own.compared(&right.map(|g| g * g), None);
    assert_eq!(other.faults[0].0, "unknown");
}

#[test]
fn one_side_of_a_kink_is_accepted_and_named() {
    let given = problem(&json!({"A": {"dense": [[2, 1], [1, 2]]}, "b": [0, -1]}));
    // x_1 = 1/2, w_0 = 1/2: strictly open; at b_0 = −1/2 it closes.
    let kink = problem(&json!({"A": {"dense": [[2, 1], [1, 2]]}, "b": [-0.5, -1]}));
    let at = |problem: &Problem, dx_db: Vec<Vec<f64>>| {
        let gradient = Gradient::of(problem, &[0.0, 0.5]).unwrap();
        gradient.compare(&Theirs { dx_db, h: None, tolerance: 1e-4 }).unwrap()
    };
    let [open, third] = [
        vec![vec![0.0, 0.0], vec![0.0, -0.5]],
        vec![vec![-2.0 / 3.0, 1.0 / 3.0], vec![1.0 / 3.0, -2.0 / 3.0]],
    ];
    assert!(at(&given, open.clone()).faults.is_empty());
    for one in [open, third] {
        let found = at(&kink, one);
        assert!(found.is_right);
        assert_eq!(found.faults[0].0, "one-sided");
    }
    let found = at(&kink, vec![vec![2.0 / 3.0, -1.0 / 3.0], vec![-1.0 / 3.0, 2.0 / 3.0]]);
    assert!(!found.is_right);
}

#[test]
fn each_piece_of_a_kink_is_accepted_also_up_to_rounding() {
    let compared = |b: [f64; 2], x: [f64; 2], dx_db: Vec<Vec<f64>>| {
        let given = problem(&json!({"A": {"dense": [[2, 1], [1, 2]]}, "b": b}));
        let gradient = Gradient::of(&given, &x).unwrap();
        gradient.compare(&Theirs { dx_db, h: None, tolerance: 1e-4 }).unwrap()
    };
    // Both contacts touch without force: each may open or close.
    for free in [vec![], vec![0], vec![1], vec![0, 1]] {
        let dx_db: Vec<Vec<f64>> = match free.len() {
            2 => vec![vec![-2.0 / 3.0, 1.0 / 3.0], vec![1.0 / 3.0, -2.0 / 3.0]],
            _ => (0..2)
                .map(|i| {
                    (0..2).map(|j| if i == j && free.contains(&i) { -0.5 } else { 0.0 }).collect()
                })
                .collect(),
        };
        assert!(compared([0.0, 0.0], [0.0, 0.0], dx_db).is_right, "{free:?}");
    }
    // Contact 1 is pressed with 1e-16: that of the open one is accepted, its negative is not.
    let almost = [-1.0, -0.5 - 1e-16];
    let open = vec![vec![-0.5, 0.0], vec![0.0, 0.0]];
    assert!(compared(almost, [0.5, 0.0], open.clone()).is_right);
    let negative: Vec<Vec<f64>> = open.iter().map(|row| row.iter().map(|g| -g).collect()).collect();
    assert!(!compared(almost, [0.5, 0.0], negative).is_right);
}

#[test]
fn changes_that_leave_the_domain_are_refused() {
    let refused = |given: Value, x: &[f64], direction: &str| {
        let gradient = Gradient::of(&problem(&given), x).unwrap();
        let direction = Direction::read(direction, "direction").unwrap();
        gradient.directional(&direction).unwrap_err().to_string()
    };
    let fixed = json!({"A": {"dense": [[1]]}, "b": [0], "lo": [1], "hi": [1]});
    assert!(refused(fixed, &[1.0], r#"{"hi": [1]}"#).contains("change both"));
    let friction = |b: f64, mu: f64| {
        json!({"A": {"dense": [[1, 0], [0, 1]]}, "b": [b, 1],
        "friction_index": [-1, 0], "mu": [0, mu]})
    };
    assert!(refused(friction(1.0, 0.5), &[0.0, 0.0], r#"{"lo": [1, 0]}"#).contains("open contact"));
    assert!(refused(friction(-1.0, 0.0), &[1.0, 0.0], r#"{"mu": [0, 1]}"#).contains("leaves 0"));
    assert!(
        refused(friction(-1.0, 0.5), &[1.0, -0.5], r#"{"A": [[0, 2, 1]]}"#)
            .contains("within 2 × 2")
    );
    assert!(refused(friction(-1.0, 0.5), &[1.0, -0.5], r#"{"b": [1]}"#).contains("must have 2"));
}
