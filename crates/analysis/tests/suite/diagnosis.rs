//! Each cause of failure listed by the chapter has an input that shows it and a message that names
//! it.

use lcplab_analysis::diagnosis::{Cause, Diagnosis, Proof, problem, scene};
use lcplab_judge::Demand;
use lcplab_judge::regularity::regularity;
use lcplab_lcp::file::Problem;
use lcplab_lcp::{Lcp, Matrix};
use lcplab_mechanics::scene::{Scene, Scheme, catalogue};
use proptest::prelude::*;

use lcplab_testing::{INF, boxed, cases, contacts};

fn of_lcp(lcp: Lcp) -> Diagnosis {
    problem(&Problem::new("problem", lcp)).unwrap()
}

fn of_scene(name: &str) -> Diagnosis {
    scene(&Scene::load(name).unwrap(), 1).unwrap()
}

fn of_text(text: &str) -> Diagnosis {
    scene(&Scene::from_toml("test.toml", text).unwrap(), 1).unwrap()
}

fn names(found: &Diagnosis) -> Vec<&'static str> {
    found.causes.iter().map(Cause::name).collect()
}

/// Equations with this matrix and b.
fn equations(rows: &[&[f64]], b: &[f64]) -> Lcp {
    boxed(rows, b, &vec![-INF; b.len()], &vec![INF; b.len()])
}

#[test]
fn friction_of_a_polygon_that_no_forces_satisfy_is_called_impossible() {
    // Every piece of the polygon's LCP was also tried by hand-written rational code: none contains
    // a solution.
    let text = r#"{"A": {"dense": [[1, -1, 0], [0, -1, -2], [-2, 2, 2]]}, "b": [-2, 0, 0],
                   "friction_index": [-1, 0, 0], "mu": [0, 2, 2], "model": "polygon-4"}"#;
    let found = problem(&Problem::parse(text, "polygon").unwrap()).unwrap();
    assert!(!found.is_sound(), "{:?}", names(&found));
}

#[test]
fn a_regular_problem_has_nothing_wrong() {
    let found = of_lcp(contacts(&[&[2.0, -1.0], &[-1.0, 2.0]], &[-1.0, 2.0]));
    let regular = found.regularity.as_ref().unwrap();
    assert_eq!((names(&found), regular.rank), (vec![], 2));
    assert!((regular.condition - 3.0).abs() < 1e-14); // eigenvalues 1 and 3
    assert!(found.is_sound());
}

#[test]
fn the_three_rows_of_figure_8_are_proved_impossible() {
    let found = of_scene("fig8");
    let Cause::Impossible { rows, proof: Proof::Vector } = &found.causes[0] else {
        panic!("{found:?}")
    };
    assert_eq!(
        rows,
        &[
            "0 (coincidence world left 0)",
            "3 (coincidence world right 0)",
            "6 (distance left right 0)"
        ]
    );
    assert_eq!(names(&found), ["impossible", "drift", "over-constrained"]);
    assert!(!found.is_sound());
}

#[test]
fn a_body_wedged_between_walls_that_close_in_is_proved_impossible() {
    // Both walls push it, w = (x₀ − x₁ − 1, x₁ − x₀ − 1): the sum is −2, for any x.
    let found = of_lcp(contacts(&[&[1.0, -1.0], &[-1.0, 1.0]], &[-1.0, -1.0]));
    assert!(
        matches!(&found.causes[0], Cause::Impossible { rows, proof: Proof::Vector } if rows == &["0", "1"])
    );
    // Compliant walls leave a solution.
    let found = of_lcp(contacts(&[&[1.0, -1.0], &[-1.0, 1.0]], &[-1.0, 1.0]));
    assert_eq!(names(&found), ["over-constrained"]);
    assert!(found.is_sound());
}

#[test]
fn friction_does_not_hide_a_contradiction() {
    let text = catalogue::text("fig8").unwrap().to_string()
        + r#"
[contact]
friction = 0.5
[[bodies]]
name = "ground"
fixed = true
shape = { plane = [0, 1, 0] }
position = [0, -10, 0]
[[bodies]]
name = "box"
shape = { box = [1, 1, 1] }
mass = 1
position = [0, -9.5, 0]
"#;
    let found = of_text(&text);
    assert!(
        matches!(&found.causes[0], Cause::Impossible { proof: Proof::Vector, .. }),
        "{found:?}"
    );
}

#[test]
fn a_rounded_contradiction_is_reported_though_not_proved() {
    // Two rods between the same points, of different length, along a direction that rounds.
    let n = [0.6_f64.sin(), 0.6_f64.cos()];
    let row = |k: f64| [k * n[0], k * n[1]];
    let j = [row(1.0), row(3.0)];
    let entry = |i: usize, k: usize| {
        j[i][0] * j[k][0] + j[i][1] * j[k][1] + if i + k == 2 { 1e-15 } else { 0.0 }
    };
    let rows = [[entry(0, 0), entry(0, 1)], [entry(1, 0), entry(1, 1)]];
    let found = of_lcp(equations(&[&rows[0], &rows[1]], &[1.0, 2.0]));
    assert!(
        matches!(&found.causes[0], Cause::Impossible { proof: Proof::Rounding, .. }),
        "{found:?}"
    );
    let found = of_lcp(equations(&[&rows[0], &rows[1]], &[1.0, 3.0]));
    assert_eq!(names(&found), ["over-constrained"]);
}

#[test]
fn equal_rows_that_differ_by_a_rounding_contradict_each_other_in_the_last_digits_only() {
    // Two equations x₀ + x₁ = b₀ and x₀ + x₁ = b₁: without a solution as soon as b₀ ≠ b₁. The
    // margin of d = (1, -1) is |b₀ - b₁| / (|b₀| + |b₁|).
    let proofs = [1.0 + f64::EPSILON, 1.0 + 1e-9].map(|second| {
        let found = of_lcp(equations(&[&[1.0, 1.0], &[1.0, 1.0]], &[1.0, second]));
        match &found.causes[0] {
            Cause::Impossible { proof, .. } => *proof,
            other => panic!("{other}"),
        }
    });
    assert_eq!(proofs, [Proof::LastDigits, Proof::Vector]);
}

#[test]
fn large_consistent_rows_do_not_make_a_contradiction_one_of_the_last_digits() {
    // x₀ + x₁ = 1 and = 2, next to two equal rows whose b are 10²⁰: alone, and in one A.
    let apart = [[1.0, 1.0, 0.0, 0.0], [0.0, 0.0, 1.0, 1.0]];
    let joined = [[1.0, 1.0, 1.0, 1.0], [1.0, 1.0, 2.0, 2.0]];
    for [small, large] in [apart, joined] {
        let b = [1.0, 2.0, 1e20, 1e20];
        let found = of_lcp(equations(&[&small, &small, &large, &large], &b));
        assert!(
            matches!(&found.causes[0], Cause::Impossible { rows, proof: Proof::Vector } if rows == &["0", "1"]),
            "{found:?}"
        );
    }
}

#[test]
fn a_row_that_acts_on_nothing_is_named() {
    let found = of_lcp(equations(&[&[1.0, 0.0], &[0.0, 0.0]], &[1.0, 0.0]));
    assert_eq!(found.causes, [Cause::ZeroRow { row: "1".into() }]);
    assert_eq!(found.regularity.unwrap().zero_rows, [1]);
    // With an additional demand it cannot be satisfied.
    let found = of_lcp(equations(&[&[1.0, 0.0], &[0.0, 0.0]], &[1.0, 2.0]));
    assert_eq!(names(&found), ["impossible", "zero row"]);
}

#[test]
fn points_that_coincide_are_named() {
    let mut pendulum = Scene::load("pendulum").unwrap();
    pendulum.states[0].pose.p.x = 0.0;
    let found = scene(&pendulum, 1).unwrap();
    assert_eq!(names(&found), ["no direction"]);
    let message = found.causes[0].to_string();
    assert!(message.contains("constraints[0]: the two points coincide"), "{message}");
    assert!(message.contains("(world and bob)"), "{message}");
    assert!(!found.is_sound());
}

#[test]
fn a_bad_start_and_an_overlap_are_measured() {
    let drift = |name: &str| {
        let found = of_scene(name);
        found.causes.iter().find_map(|cause| match cause {
            Cause::Apart { error, .. } => Some(error.clone()),
            _ => None,
        })
    };
    assert_eq!(drift("fig8").as_deref(), Some("2 m")); // a rod of 1 m between nails 3 m apart
    assert_eq!(drift("pendulum"), None);
}

#[test]
fn a_heavy_body_on_a_light_one_is_ill_conditioned() {
    // Scaled, A = [1 −c; −c 1] with c² = 1/(1 + r), r = 10⁻⁸: condition (1 + c)/(1 − c).
    let r = 1e-8_f64;
    let found = of_lcp(contacts(&[&[1.0, -1.0], &[-1.0, 1.0 + r]], &[-1.0, 0.0]));
    let Cause::IllConditioned { condition } = found.causes[0] else { panic!("{found:?}") };
    let c = (1.0 / (1.0 + r)).sqrt();
    assert!((condition / ((1.0 + c) / (1.0 - c)) - 1.0).abs() < 1e-5);
    assert!(found.is_sound());
}

#[test]
fn signs_and_blocks_gone_wrong_are_seen_in_a() {
    let found = of_lcp(equations(&[&[1.0, 2.0], &[2.0, 1.0]], &[0.0, 0.0]));
    let Cause::Indefinite { eigenvalue } = found.causes[0] else { panic!("{found:?}") };
    assert!((eigenvalue + 1.0).abs() < 1e-14); // 1 ± 2
    let found = of_lcp(equations(&[&[1.0, 0.5], &[0.0, 1.0]], &[0.0, 0.0]));
    assert_eq!(names(&found), ["not symmetric"]);
}

#[test]
fn every_cause_ends_its_sentences_and_names_its_rows() {
    let rows = || vec!["0".to_string(), "1".into()];
    let causes = [
        Cause::NoDirection { constraint: "constraints[0]: the two points coincide".into() },
        Cause::ZeroRow { row: "1".into() },
        Cause::ImmovableRow { row: "1".into(), diagonal: 1e-20, impulse: 1e20 },
        Cause::ImmovableRow { row: "1".into(), diagonal: 1e-310, impulse: INF },
        Cause::Impossible { rows: rows(), proof: Proof::Vector },
        Cause::Impossible { rows: rows(), proof: Proof::LastDigits },
        Cause::Impossible { rows: Vec::new(), proof: Proof::CaseSplit { pieces: 6 } },
        Cause::Impossible { rows: rows(), proof: Proof::Rounding },
        Cause::Redundant { rows: rows(), spare: 1 },
        Cause::Slow { radius: 0.9999, sweeps: 184_000.0 },
        Cause::Apart { row: "1".into(), error: "0.5 m".into() },
        Cause::IllConditioned { condition: 2e8 },
        Cause::Unsymmetric,
        Cause::Indefinite { eigenvalue: -0.5 },
        Cause::Failed { reason: "\"bob\" diverged".into() },
    ];
    for cause in causes {
        let message = cause.to_string();
        assert!(message.ends_with('.') && !message.contains(".."), "{message}");
        assert!(cause.rows().iter().all(|row| message.contains(row)), "{message}");
    }
}

#[test]
fn a_motion_that_fails_on_the_way_is_reported() {
    let mut pendulum = Scene::load("pendulum").unwrap();
    pendulum.step.scheme = lcplab_mechanics::scene::Scheme::Acceleration;
    pendulum.step.alpha = 1000.0; // far beyond what a step of 0.01 s can follow
    let found = scene(&pendulum, 1000).unwrap();
    let fails = |cause: &Cause| matches!(cause, Cause::Failed { reason } if reason.contains("\"bob\" diverged"));
    assert!(found.causes.iter().any(fails), "{:?}", names(&found));
}

#[test]
fn mechanisms_have_their_degrees_of_freedom() {
    let left = |found: Diagnosis| found.degrees_of_freedom.unwrap().left();
    // Bricard's mechanism moves although 30 rows meet 30 components.
    let bricard = of_scene("bricard");
    let degrees_of_freedom = bricard.degrees_of_freedom.unwrap();
    assert_eq!(
        (degrees_of_freedom.components, degrees_of_freedom.rows, degrees_of_freedom.rank),
        (30, 30, 29)
    );
    assert_eq!(names(&bricard), ["over-constrained", "slow"]);
    assert_eq!(left(of_scene("pendulum")), 2); // a point on a sphere
    assert_eq!(left(of_scene("fig7")), 18); // contacts are no equations
    assert_eq!(left(of_text(FOUR_BAR)), 1);
    assert_eq!(left(of_text(TWO_NAILS)), 1); // E19: 6 rows, rank 5
}

/// Three links of a plane parallelogram on four hinges: 20 rows, 18 components, and it swings.
const FOUR_BAR: &str = r#"
bodies = [
    { name = "left", shape = { box = [0.1, 1, 0.1] }, mass = 1, position = [0, 0.5, 0] },
    { name = "top", shape = { box = [1, 0.1, 0.1] }, mass = 1, position = [0.5, 1, 0] },
    { name = "right", shape = { box = [0.1, 1, 0.1] }, mass = 1, position = [1, 0.5, 0] },
]
constraints = [
    { kind = "hinge", bodies = ["left"], point = [0, 0, 0], axis = [0, 0, 1] },
    { kind = "hinge", bodies = ["left", "top"], point = [0, 1, 0], axis = [0, 0, 1] },
    { kind = "hinge", bodies = ["top", "right"], point = [1, 1, 0], axis = [0, 0, 1] },
    { kind = "hinge", bodies = ["right"], point = [1, 0, 0], axis = [0, 0, 1] },
]
"#;

/// A box nailed at two of its points can rotate about the line through them.
const TWO_NAILS: &str = r#"
bodies = [{ name = "box", shape = { box = [1, 1, 1] }, mass = 1 }]
constraints = [
    { kind = "nail", bodies = ["box"], point = [-0.5, 0, 0] },
    { kind = "nail", bodies = ["box"], point = [0.5, 0, 0] },
]
"#;

#[test]
fn the_feet_of_a_table_are_a_null_vector() {
    // J = (1, ±1, ±1) for the four feet of a table with unit mass and inertias: K&M E10.
    let feet = [[1.0, 1.0, 1.0], [1.0, 1.0, -1.0], [1.0, -1.0, 1.0], [1.0, -1.0, -1.0]];
    let a: Vec<f64> = feet
        .iter()
        .flat_map(|p| feet.iter().map(move |q| p.iter().zip(q).map(|(a, b)| a * b).sum()))
        .collect();
    let found = regularity(&Matrix::dense(4, &a)).unwrap();
    assert_eq!(found.rank, 3);
    let [d] = found.dependencies.as_slice() else { panic!("{found:?}") };
    for (d, sign) in d.iter().zip([1.0, -1.0, -1.0, 1.0]) {
        assert!((d * d0(&found.dependencies) - sign).abs() < 1e-12, "{d}");
    }
}

/// The first entry, whose sign is free.
fn d0(dependencies: &[Vec<f64>]) -> f64 {
    dependencies[0][0]
}

proptest! {
    #![proptest_config(cases(64))]

    #[test]
    fn the_rank_of_j_jt_is_found_whatever_the_units(
        entries in prop::collection::vec(-3_i32..=3, 24), powers in prop::collection::vec(-20_i32..=20, 6),
    ) {
        // Six rows in four columns: rank at most 4, found by exact elimination over the integers.
        let j: Vec<Vec<f64>> = entries.chunks(4).map(|row| row.iter().map(|&e| f64::from(e)).collect()).collect();
        let scaled = |i: usize, k: usize| {
            let product: f64 = j[i].iter().zip(&j[k]).map(|(a, b)| a * b).sum();
            product * 2.0_f64.powi(powers[i] + powers[k])
        };
        let a: Vec<f64> = (0..36).map(|e| scaled(e / 6, e % 6)).collect();
        let found = regularity(&Matrix::dense(6, &a)).unwrap();
        prop_assert_eq!(found.rank, integer_rank(&entries));
        prop_assert_eq!(found.dependencies.len(), 6 - found.rank);
        for d in &found.dependencies {
            for k in 0..6 {
                let terms: Vec<f64> = (0..6).map(|i| d[i] * a[6 * i + k]).collect();
                let size: f64 = terms.iter().map(|term| term.abs()).sum();
                prop_assert!(terms.iter().sum::<f64>().abs() <= 1e-8 * size);
            }
        }
    }
}

/// The rank of a 6 × 4 matrix of small integers, by fraction-free elimination.
fn integer_rank(entries: &[i32]) -> usize {
    let mut rows: Vec<Vec<i128>> =
        entries.chunks(4).map(|row| row.iter().map(|&e| i128::from(e)).collect()).collect();
    let mut rank = 0;
    for column in 0..4 {
        let Some(pivot) = (rank..rows.len()).find(|&r| rows[r][column] != 0) else { continue };
        rows.swap(rank, pivot);
        let own = rows[rank].clone();
        for row in rows.iter_mut().skip(rank + 1) {
            let factor = row[column];
            for (entry, own_entry) in row.iter_mut().zip(&own) {
                *entry = *entry * own[column] - factor * own_entry;
            }
        }
        rank += 1;
    }
    rank
}

#[test]
fn the_diagnosis_looks_at_the_level_that_the_scene_is_stepped_on() {
    // Painlevé's rod slides: at acceleration level no force keeps it from penetrating the ground.
    let mut rod = Scene::load("painleve").unwrap();
    rod.step.scheme = Scheme::Acceleration;
    let found = scene(&rod, 1).unwrap();
    assert!(!found.is_sound() && names(&found).contains(&"impossible"), "{:?}", found.causes);
    let mut at_velocity_level = rod.clone();
    at_velocity_level.step.scheme = Scheme::Velocity;
    assert!(scene(&at_velocity_level, 1).unwrap().is_sound());
}

#[test]
fn a_problem_with_two_answers_is_said_to_have_them() {
    // A = −1, b = 1: x = 0 with w = 1, and x = 1 with w = 0.
    let two = r#"{"A": {"dense": [[-1, 0], [1, 1]]}, "b": [1, 1]}"#;
    let found = problem(&Problem::parse(two, "two.json").unwrap()).unwrap();
    assert!(found.causes.contains(&Cause::Several { answers: 2 }), "{:?}", found.causes);
    assert!(!found.is_unique && found.is_sound());
}

#[test]
fn numbers_too_large_for_singular_values_are_no_error() {
    // x = (1, 1e-200·(−2))… w = (1 + x0 + 1e200 x1, 1 + x1) ≥ 0 at x = 0.
    let text = r#"{"A": {"dense": [[1, 1e200], [0, 1]]}, "b": [1, 1]}"#;
    let found = problem(&Problem::parse(text, "large.json").unwrap()).unwrap();
    assert!(found.is_sound() && !found.is_unique, "{found:?}");
}

#[test]
fn of_shipped_scenes_those_are_called_impossible_that_have_no_solution() {
    for shipped in catalogue::SHIPPED.iter().filter(|shipped| shipped.name != "tower") {
        let scene = Scene::load(shipped.name).unwrap();
        let found = lcplab_analysis::diagnosis::scene(&scene, 1).unwrap();
        let mut scene = scene;
        if scene.solver.name == "pgs" {
            // Some stop after a few sweeps, so that they can be examined.
            (scene.solver.name, scene.solver.max_iterations) = ("dantzig".into(), 10_000);
        }
        let step = lcplab_mechanics::simulation::Step::of(&scene, 1);
        let is_solved = step.is_ok_and(|step| {
            step.solves.iter().all(|solve| solve.judged(&Demand::default()).verdict.is_solution())
        });
        assert_eq!(found.is_sound(), is_solved, "{}: {:?}", shipped.name, found.causes);
    }
}

/// The causes found in an LCP with bounds 0 and ∞.
fn causes(rows: &[&[f64]], b: &[f64]) -> Vec<Cause> {
    of_lcp(contacts(rows, b)).causes
}

#[test]
fn a_row_that_hardly_any_impulse_moves_is_named_with_the_impulse() {
    let row =
        |row: &str, diagonal, impulse| Cause::ImmovableRow { row: row.into(), diagonal, impulse };
    let [found] = causes(&[&[1.0, 0.0], &[0.0, 1e-20]], &[-1.0, -1.0]).try_into().unwrap();
    assert_eq!(found, row("1", 1e-20, 1e20));
    assert!(!found.is_fatal() && found.to_string().contains("10²⁰"), "{found}");
    assert!(!found.to_string().contains("pivoting"), "{found}");
    // Alone too; and b / a may overflow.
    assert_eq!(causes(&[&[1e-20]], &[-1.0]), [row("0", 1e-20, 1e20)]);
    assert_eq!(causes(&[&[1e-310]], &[-1.0]), [row("0", 1e-310, INF)]);
    assert_eq!(causes(&[&[1.0, 0.0], &[0.0, 1e-310]], &[-1.0, -1.0]), [row("1", 1e-310, INF)]);
    // A contact that separates needs no impulse, and a motor at most its effort.
    assert_eq!(causes(&[&[1.0, 0.0], &[0.0, 1e-20]], &[-1.0, 1.0]), []);
    let motor = boxed(&[&[1.0, 0.0], &[0.0, 1e-20]], &[-1.0; 2], &[0.0; 2], &[INF, 10.0]);
    assert_eq!(of_lcp(motor).causes, []);
    // Units alone: the second row counts in units 10¹⁰ times smaller.
    assert_eq!(causes(&[&[1.0, 5e-11], &[5e-11, 1e-20]], &[-1.0, -1e-10]), []);
}

#[test]
fn no_number_of_sweeps_is_given_that_is_none() {
    let scales = [(1e-310, 1e-310), (1e-300, 1e150), (1e30, 1e-30), (5e9, 1.0)];
    for (first, second) in scales {
        let beside = 0.5 * f64::sqrt(first) * f64::sqrt(second);
        let b = [-first.sqrt(), -second.sqrt()];
        let found = of_lcp(contacts(&[&[first, beside], &[beside, second]], &b));
        assert_eq!((names(&found), found.is_unique), (vec![], true), "{first}, {second}");
    }
}

#[test]
fn the_smallest_numbers_are_called_indefinite_exactly_where_they_are() {
    const LEAST: f64 = 5e-324; // whole multiples of it are exact
    for (p, q, r) in
        (1..=9).flat_map(|p| (0..=9).flat_map(move |q| (1..=9).map(move |r| (p, q, r))))
    {
        let [first, beside, second] = [p, q, r].map(|k: i32| f64::from(k) * LEAST);
        let found = of_lcp(equations(&[&[first, beside], &[beside, second]], &[0.0, 0.0]));
        let is_indefinite =
            found.causes.iter().any(|cause| matches!(cause, Cause::Indefinite { .. }));
        assert_eq!(is_indefinite, q * q > p * r, "{p}, {q}, {r}: {:?}", found.causes);
        assert_eq!(found.is_unique, q * q < p * r, "{p}, {q}, {r}");
    }
}

/// A random J Jᵀ + shift, b = J u, and the same in units 2^-k_i.
fn in_units(n: usize, columns: usize, shift: f64, numbers: &[i32], k: &[i32]) -> [Lcp; 2] {
    let j = |r: usize, c: usize| f64::from(numbers[r * columns + c]);
    let product = |r: usize, s: usize| (0..columns).map(|c| j(r, c) * j(s, c)).sum::<f64>();
    let entry = |r: usize, s: usize| product(r, s) + if r == s { shift } else { 0.0 };
    let b = |r: usize| (0..columns).map(|c| j(r, c) * (c as f64 - 0.5)).sum::<f64>();
    let power = |exponent: i32| 2f64.powi(exponent);
    let problem = |k: &dyn Fn(usize) -> i32| {
        let scaled = |e: usize| entry(e / n, e % n) * power(k(e / n)) * power(k(e % n));
        let a: Vec<f64> = (0..n * n).map(scaled).collect();
        let b = (0..n).map(|r| b(r) * power(k(r))).collect();
        Lcp::new(Matrix::dense(n, &a), b, vec![0.0; n], vec![INF; n]).unwrap()
    };
    [problem(&|_| 0), problem(&|i| k[i])]
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn the_diagnosis_of_a_definite_problem_is_the_same_in_all_units(
        n in 2..=5usize, numbers in prop::collection::vec(-3_i32..=3, 25),
        k in prop::collection::vec(-500_i32..=500, 5), shift in prop::sample::select(vec![1e-9, 1e-3, 0.5]),
    ) {
        let [plain, scaled] = in_units(n, n, shift, &numbers, &k).map(of_lcp);
        prop_assert_eq!(&plain.causes, &scaled.causes);
        prop_assert_eq!(plain.is_unique, scaled.is_unique);
        prop_assert!(!names(&plain).contains(&"indefinite"));
        let is_finite = |cause: &Cause| match cause {
            Cause::Slow { radius, sweeps } => *radius < 1.0 && sweeps.is_finite(),
            _ => true,
        };
        prop_assert!(plain.causes.iter().all(is_finite));
    }

    #[test]
    fn an_indefinite_problem_is_never_called_definite(
        n in 2..=5usize, numbers in prop::collection::vec(-3_i32..=3, 25),
        k in prop::collection::vec(-500_i32..=500, 5), beyond in 1.001..4.0f64,
    ) {
        let [plain, _] = in_units(n, n, 0.5, &numbers, &k);
        let diagonal = |i: usize| plain.matrix().diagonal(i);
        let beside = beyond * (diagonal(0) * diagonal(1)).sqrt();
        let entry = |r: usize, s: usize| if r + s == 1 { beside } else { plain.matrix().entry(r, s) };
        let scaled = |e: usize| entry(e / n, e % n) * 2f64.powi(k[e / n]) * 2f64.powi(k[e % n]);
        let a: Vec<f64> = (0..n * n).map(scaled).collect();
        let lcp = Lcp::new(Matrix::dense(n, &a), vec![0.0; n], vec![-INF; n], vec![INF; n]);
        let found = of_lcp(lcp.unwrap());
        prop_assert!(!found.is_unique);
        prop_assert!(names(&found).contains(&"indefinite"), "{:?}", found.causes);
        prop_assert!(!names(&found).contains(&"slow"));
    }
}
