//! The known mistakes that give exactly this x, each made here by an independent program.

mod chance;
mod contact_solver;
mod kinds;
mod plain;
mod planted;
mod redundant;

use lcplab_analysis::diagnosis::{
    Conclusion, Mistake, MistakeKind, Precision, find_mistakes, single_precision,
};
use lcplab_lcp::friction::ProblemForm;
use lcplab_lcp::library;
use lcplab_lcp::{Coupling, Lcp, Matrix};
use lcplab_solver::{Dantzig, Solver, Start};

use lcplab_testing::{boxed, contacts};
use oorandom::Rand64;

fn mistakes(lcp: &Lcp, x: &[f64]) -> Vec<Mistake> {
    find_mistakes(&ProblemForm::Boxed(lcp.clone()), x, None).mistakes
}

/// A column of eight, with unequal masses and pushes.
fn column() -> Lcp {
    let n = 8;
    let entry = |k: usize| {
        let (i, j) = (k / n, k % n);
        match i.abs_diff(j) {
            0 => 2.0 + 0.1 * i as f64,
            1 => -1.0,
            _ => 0.0,
        }
    };
    let entries: Vec<f64> = (0..n * n).map(entry).collect();
    let b = (0..n).map(|i| if i == 5 { 9.0 } else { -1.0 - 0.3 * i as f64 }).collect();
    Lcp::new(Matrix::dense(n, &entries), b, vec![0.0; n], vec![f64::INFINITY; n]).unwrap()
}

fn exact(lcp: &Lcp) -> Vec<f64> {
    Dantzig::default().solve(lcp, &Start::default(), &mut ()).x
}

fn w(lcp: &Lcp, x: &[f64], i: usize) -> f64 {
    let terms = (0..x.len()).map(|j| lcp.matrix().entry(i, j) * x[j]);
    terms.fold(lcp.b()[i], |sum, term| sum + term)
}

/// Textbook sweeps over these rows.
fn swept(lcp: &Lcp, rows: &[usize], sweeps: usize) -> Vec<f64> {
    let mut x = vec![0.0; lcp.len()];
    for _ in 0..sweeps {
        for &i in rows {
            x[i] = (x[i] - w(lcp, &x, i) / lcp.matrix().diagonal(i)).max(0.0);
        }
    }
    x
}

fn first(lcp: &Lcp, x: &[f64]) -> String {
    let found = mistakes(lcp, x);
    assert!(found.first().is_some_and(|own| own.distance < 1e-12), "{x:?}: {found:?}");
    found[0].what.clone()
}

#[test]
fn sweeps_that_were_stopped_are_counted_in_every_order() {
    let lcp = column();
    let (forth, back): (Vec<usize>, Vec<usize>) = ((0..8).collect(), (0..8).rev().collect());
    for sweeps in [1, 3, 10] {
        let plural = if sweeps == 1 { "" } else { "s" };
        let ends = format!("stopped after {sweeps} sweep{plural}");
        assert_eq!(
            first(&lcp, &swept(&lcp, &forth, sweeps)),
            format!("projected Gauss-Seidel, {ends}")
        );
        let found = first(&lcp, &swept(&lcp, &back, sweeps));
        assert_eq!(found, format!("projected Gauss-Seidel from the last row to the first, {ends}"));
    }
}

#[test]
fn the_clamp_after_the_sweep_and_all_rows_at_once_are_distinguished() {
    let lcp = column();
    let (mut late, mut jacobi) = (vec![0.0; 8], vec![0.0; 8]);
    for _ in 0..4 {
        for i in 0..8 {
            late[i] -= w(&lcp, &late, i) / lcp.matrix().diagonal(i);
        }
        late.iter_mut().for_each(|x: &mut f64| *x = x.max(0.0));
        let moved =
            (0..8).map(|i| (jacobi[i] - w(&lcp, &jacobi, i) / lcp.matrix().diagonal(i)).max(0.0));
        jacobi = moved.collect();
    }
    assert_eq!(
        first(&lcp, &late),
        "Gauss-Seidel with the clamp after the sweep, stopped after 4 sweeps"
    );
    assert_eq!(first(&lcp, &jacobi), "Jacobi instead of Gauss-Seidel, stopped after 4 sweeps");
}

#[test]
fn mistakes_in_the_problem_are_named() {
    let lcp = column();
    let with = |b: Vec<f64>| lcp.with_b(b).unwrap();
    let other_sign = with(lcp.b().iter().map(|b| -b).collect());
    assert_eq!(first(&lcp, &exact(&other_sign)), "the solution with the opposite sign of b");
    let without_dt = with(lcp.b().iter().map(|b| 60.0 * b).collect());
    assert_eq!(
        first(&lcp, &exact(&without_dt)),
        "the solution with b times 60 (check the time step and the unit)"
    );
    let mut lo = lcp.lo().to_vec();
    lo[5] = f64::NEG_INFINITY;
    let free = Lcp::new(lcp.matrix().clone(), lcp.b().to_vec(), lo, lcp.hi().to_vec()).unwrap();
    assert_eq!(first(&lcp, &exact(&free)), "the solution with row 5 without its bounds");
    let mut soft = lcp.matrix().to_dense();
    for i in 0..8 {
        soft[(i, i)] += 1e-3;
    }
    let entries: Vec<f64> = soft.transpose().as_slice().to_vec();
    let soft = Lcp::new(
        Matrix::dense(8, &entries),
        lcp.b().to_vec(),
        vec![0.0; 8],
        vec![f64::INFINITY; 8],
    )
    .unwrap();
    let found = mistakes(&lcp, &exact(&soft));
    assert_eq!(found[0].what, "the solution with compliance (CFM) 0.001 on the diagonal of A");
}

#[test]
fn friction_that_was_forgotten_or_has_no_limit_is_named() {
    let family = library::by_name("pushed-mass").unwrap();
    let lcp = family.generate(&[("degrees", 30.0), ("push", 3.0)]).unwrap().lcp; // press 2, μ = ½
    // A is the identity: one sweep from the last row to the first gives the same.
    let found = mistakes(&lcp, &[2.0, 0.0, 0.0]);
    assert!(
        found
            .iter()
            .any(|own| own.what == "the solution with friction left out" && own.distance == 0.0),
        "{found:?}"
    );
    let wanted = [3.0 * 30f64.to_radians().cos(), 1.5];
    let found = mistakes(&lcp, &[2.0, wanted[0], wanted[1]]);
    assert_eq!(found[0].what, "the solution with friction without a limit");
}

#[test]
fn single_precision_is_seen_and_is_the_yardstick() {
    let lcp = column();
    let sweeps = |count: usize| -> Vec<f64> {
        let mut x = [0.0_f32; 8];
        for i in (0..count).flat_map(|_| 0..8) {
            let row = (0..8).filter(|&j| lcp.matrix().entry(i, j) != 0.0);
            let w =
                row.fold(lcp.b()[i] as f32, |sum, j| sum + lcp.matrix().entry(i, j) as f32 * x[j]);
            x[i] = (x[i] - w / lcp.matrix().diagonal(i) as f32).max(0.0);
        }
        x.map(f64::from).to_vec()
    };
    // The same sweeps in double precision are equally near, as far as 32 bits can distinguish.
    let found = mistakes(&lcp, &sweeps(10));
    assert_eq!(
        found[0].what,
        "projected Gauss-Seidel in single precision, stopped after 10 sweeps"
    );
    assert!(found.iter().any(|own| own.what == "projected Gauss-Seidel, stopped after 10 sweeps"));
    // Converged, they are the solution up to the last bits.
    assert_eq!(mistakes(&lcp, &sweeps(300)), []);
    let rounded: Vec<f64> = exact(&lcp).iter().map(|&x| f64::from(x as f32)).collect();
    let [own, least] = single_precision(&lcp, &rounded).unwrap();
    assert_eq!(own, least);
    assert!(own > 1e-9 && own < 1e-6, "{own}");
}

#[test]
fn a_right_answer_is_no_mistake_and_an_unknown_one_stays_unknown() {
    let lcp = column();
    assert_eq!(mistakes(&lcp, &exact(&lcp)), []);
    assert_eq!(mistakes(&lcp, &[0.3, 1.7, 0.2, 5.0, 0.1, 0.9, 0.4, 2.2]), []);
}

#[test]
fn hostile_numbers_agree_with_nothing() {
    // A massless row: sweeps divide by 0, and NaN agrees with no x.
    let hole = Matrix::dense(2, &[0.0, 1.0, 1.0, 2.0]);
    let lcp = Lcp::new(hole, vec![-1.0, 1.0], vec![0.0; 2], vec![f64::INFINITY; 2]).unwrap();
    assert_eq!(mistakes(&lcp, &[3.0, 0.25]), []);
    let lcp = column();
    for wrong in [f64::NAN, f64::INFINITY, f64::MAX] {
        let mut x = exact(&lcp);
        x[3] = wrong;
        assert_eq!(mistakes(&lcp, &x), [], "{wrong}");
    }
    assert_eq!(mistakes(&lcp, &[0.0; 8])[0].what, "the start, x = 0, not updated");
}

#[test]
fn what_looks_like_compliance_in_the_free_rows_but_breaks_another_row_is_not_called_so() {
    // w = −ε x in rows 0 and 1; row 2 closes too, and would have to push.
    let a = Matrix::dense(3, &[2.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 2.0]);
    let b = vec![-1.0, -2.0, -3.0];
    let lcp = Lcp::new(a, b, vec![0.0; 3], vec![f64::INFINITY; 3]).unwrap();
    let x = [1.0 / 2.5, 2.0 / 2.5, 0.0];
    let found = mistakes(&lcp, &x);
    assert!(found.iter().all(|own| !own.what.contains("CFM")), "{found:?}");
}

#[test]
fn mistakes_that_have_to_do_with_the_last_frame_are_named() {
    let lcp = column();
    let last: Vec<f64> =
        exact(&lcp).iter().enumerate().map(|(i, x)| x * (1.0 + 0.1 * i as f64)).collect();
    let first = |x: &[f64], last: &[f64]| {
        let found = find_mistakes(&ProblemForm::Boxed(lcp.clone()), x, Some(last)).mistakes;
        assert!(found[0].distance < 1e-12, "{found:?}");
        found[0].what.clone()
    };
    let rows: Vec<usize> = (0..8).collect();
    assert_eq!(
        first(&swept(&lcp, &rows, 3), &last),
        "projected Gauss-Seidel from 0 (a missing warm start), stopped after 3 sweeps"
    );
    // The same sweeps from the last answer.
    let mut x = last.clone();
    for &i in rows.iter().chain(&rows) {
        x[i] = (x[i] - w(&lcp, &x, i) / lcp.matrix().diagonal(i)).max(0.0);
    }
    assert_eq!(
        first(&x, &last),
        "projected Gauss-Seidel from the last answer, stopped after 2 sweeps"
    );
    assert_eq!(first(&last, &last), "the last answer, not updated");
}

#[test]
fn friction_that_is_limited_by_the_last_normal_forces_is_named() {
    // A block of weight 2 that is pushed by 3 with μ = ½, where the last step had 4: friction 2
    // instead of 1.
    let matrix = Matrix::dense(2, &[1.0, 0.0, 0.0, 1.0]);
    let free = [f64::NEG_INFINITY, f64::INFINITY];
    let lcp = Lcp::new(matrix, vec![-2.0, -3.0], vec![0.0, free[0]], vec![free[1]; 2]).unwrap();
    let lcp =
        lcp.with_coupling(Coupling::new(vec![None, Some(0)], vec![0.0, 0.5]).unwrap()).unwrap();
    let found =
        find_mistakes(&ProblemForm::Boxed(lcp.clone()), &[2.0, 2.0], Some(&[4.0, 2.0])).mistakes;
    // A sweep from the friction row to the normal row, starting at the last answer, gives the same
    // x.
    let all: Vec<(&str, f64)> =
        found.iter().map(|mistake| (mistake.what.as_str(), mistake.distance)).collect();
    assert!(
        all.contains(&(
            "the solution with friction limited by the normal forces of the previous step",
            0.0
        )),
        "{all:?}"
    );
}

#[test]
fn whatever_is_near_a_solution_is_not_a_mistake_that_leads_to_it() {
    // x = (1, 1) is the solution; Gauss-Seidel and Jacobi come equally near on their way.
    let lcp = contacts(&[&[2.0, 1.0], &[1.0, 2.0]], &[-3.0, -3.0]);
    let found = find_mistakes(&ProblemForm::Boxed(lcp.clone()), &[1.000_000_3, 0.999_999_8], None);
    assert_eq!(found.mistakes, []);
    let Conclusion::Compared { solution_distance } = found.conclusion else { panic!("{found:?}") };
    assert!((solution_distance / 3e-7 - 1.0).abs() < 1e-5, "{solution_distance}");
}

#[test]
fn a_negative_factor_of_b_is_none() {
    // With −2 b the solution is 0, not −2 times the solution.
    let lcp = contacts(&[&[2.0, 1.0], &[1.0, 2.0]], &[-3.0, -3.0]);
    assert_eq!(mistakes(&lcp, &[-2.0, -2.0]), []);
}

#[test]
fn a_factor_that_fits_any_answer_explains_none() {
    let one = contacts(&[&[1.0]], &[-2.0]);
    assert_eq!(mistakes(&one, &[2.04]), []);
    // So does one pressing contact among others that do not press.
    let two = contacts(&[&[2.0, 1.0], &[1.0, 2.0]], &[-2.0, 7.0]);
    assert_eq!(mistakes(&two, &[1.02, 0.0]), []);
    // Of two numbers one is left to be explained.
    let both = contacts(&[&[2.0, 1.0], &[1.0, 2.0]], &[-3.0, -2.0]); // (4, 1)/3
    let found = mistakes(&both, &[1.02 * 4.0 / 3.0, 1.02 / 3.0]);
    assert_eq!(found[0].kind, MistakeKind::FactorOfB, "{found:?}");
}

#[test]
fn mistakes_that_are_as_near_are_all_named() {
    // One sweep of Gauss-Seidel reaches no bound: clamping in the sweep or after it gives the same.
    let lcp =
        contacts(&[&[2.0, 1.0, 0.0], &[1.0, 2.0, 1.0], &[0.0, 1.0, 2.0]], &[-2.0, -3.0, -1.0]);
    let found = mistakes(&lcp, &[1.0, 1.0, 0.0]);
    let kinds: Vec<MistakeKind> = found.iter().map(|own| own.kind).collect();
    for kind in [MistakeKind::StoppedSweeps, MistakeKind::LateClamp, MistakeKind::SinglePrecision] {
        assert!(kinds.contains(&kind), "{found:?}");
    }
}

#[test]
fn clamped_increments_are_named_although_their_first_sweep_is_a_right_one() {
    // Both first sweeps give (1, 1, 0). The second ones differ: the change of row 0 is -1/2, which
    // is clamped to 0, and the sum 1/2 is not. So clamped increments stay there.
    let a = Matrix::dense(3, &[2.0, 1.0, 0.0, 1.0, 2.0, 1.0, 0.0, 1.0, 2.0]);
    let lcp = Lcp::new(a, vec![-2.0, -3.0, -1.0], vec![0.0; 3], vec![f64::INFINITY; 3]).unwrap();
    let named: Vec<String> =
        mistakes(&lcp, &[1.0, 1.0, 0.0]).into_iter().map(|own| own.what).collect();
    for what in [
        "projected Gauss-Seidel, stopped after 1 sweep",
        "Gauss-Seidel with clamped increments, after 1 sweep or more",
    ] {
        assert!(named.iter().any(|own| own == what), "{what}: {named:?}");
    }
}

#[test]
fn a_converged_result_is_not_called_stopped() {
    // x is the limit of 19 sweeps whose friction limit is that of the first one.
    let a = Matrix::dense(3, &[2.0, -1.0, 0.5, -1.0, 2.0, 0.3, 0.5, 0.3, 1.0]);
    let inf = f64::INFINITY;
    let parts = (vec![-2.0, -3.0, -5.0], vec![0.0, 0.0, -inf], vec![inf; 3]);
    let lcp = Lcp::new(a, parts.0, parts.1, parts.2).unwrap();
    let lcp = lcp
        .with_coupling(Coupling::new(vec![None, None, Some(0)], vec![0.0, 0.0, 0.5]).unwrap())
        .unwrap();
    let named: Vec<String> = mistakes(&lcp, &[2.1166666666525997, 2.4833333333263, 0.5])
        .into_iter()
        .map(|own| own.what)
        .collect();
    let what = "Gauss-Seidel with the friction limits of the first sweep, converged";
    assert!(named.iter().any(|own| own == what), "{named:?}");
    // A hundred sweeps on the transpose of A, which converge slowly: more are not compared.
    let a = [[1.0, -0.9, 0.1], [-1.1, 1.0, 0.0], [0.2, 0.0, 1.0]];
    let b = [-2.0, -2.5, -1.0];
    let mut x = [0.0_f64; 3];
    for _ in 0..100 {
        for i in 0..3 {
            let w: f64 = (0..3).map(|j| a[j][i] * x[j]).sum::<f64>() + b[i];
            x[i] = (x[i] - w / a[i][i]).max(0.0);
        }
    }
    let lcp = contacts(&a.each_ref().map(|row| &row[..]), &b);
    let found = mistakes(&lcp, &x);
    let what = "A transposed, projected Gauss-Seidel, after 100 sweeps or more";
    assert!(found.iter().any(|own| own.what == what), "{found:?}");
}

#[test]
fn with_redundant_rows_any_solution_of_the_changed_problem_counts() {
    // Rows 0 and 1 are the same contact: x_0 + x_1 = 1, in any split; x_2 = 2, x_3 = 1, x_4 = 2.
    let rows = [
        [2.0, 2.0, 1.0, 0.0, 0.0],
        [2.0, 2.0, 1.0, 0.0, 0.0],
        [1.0, 1.0, 2.0, 0.0, 0.0],
        [0.0, 0.0, 0.0, 3.0, 0.0],
        [0.0, 0.0, 0.0, 0.0, 3.0],
    ];
    let a = Matrix::dense(5, &rows.concat());
    let b = vec![-4.0, -4.0, -5.0, -3.0, -6.0];
    let lcp = Lcp::new(a, b, vec![0.0; 5], vec![f64::INFINITY; 5]).unwrap();
    let split = 0.123_456_789_012_345;
    let named = first(&lcp, &[split, 0.5 - split, 1.0, 0.5, 1.0]);
    assert_eq!(named, "the solution with b times 0.5 (check the time step and the unit)");
}

#[test]
fn what_random_digits_could_give_as_well_is_only_possible() {
    let mut random = Rand64::new(7);
    let mut digit = |below: u64| random.rand_range(0..below) as f64;
    let mut named = 0;
    for _ in 0..300 {
        let (off, x) = ([-1.0, 0.0][digit(2) as usize], [1.0 + digit(3), 1.0 + digit(3)]);
        let a = Matrix::dense(2, &[4.0 + digit(7), off, off, 4.0 + digit(7)]);
        let b = vec![-1.0 - digit(5), -1.0 - digit(5)];
        let lcp = Lcp::new(a, b, vec![0.0; 2], vec![f64::INFINITY; 2]).unwrap();
        let found = mistakes(&lcp, &x);
        named += usize::from(!found.is_empty());
        assert!(found.iter().all(|own| own.may_be_chance), "{x:?}: {found:?}");
    }
    assert!(named > 0, "some random digits agree with a mistake");
    let x = swept(&column(), &[0, 1, 2, 3, 4, 5, 6, 7], 3);
    assert!(mistakes(&column(), &x).iter().all(|own| !own.may_be_chance), "all digits agree");
}

#[test]
fn an_answer_is_as_precise_as_its_digits() {
    assert_eq!(Precision::of(&[1.0 / 3.0, 2.0]), Precision::Double);
    assert_eq!(Precision::of(&[f64::from(0.1_f32), 2.0]), Precision::Single);
    assert_eq!(Precision::of(&[0.25, 1250.0, 0.0]), Precision::Decimal { digits: 3, decimals: 2 });
    assert_eq!(Precision::of(&[1.25e-9, 3e4]), Precision::Decimal { digits: 3, decimals: 11 });
    assert_eq!(Precision::of(&[0.0, 0.0]), Precision::Double);
    // Half a unit of the last place of a format that may have written them.
    let printed = Precision::of(&[0.333, 12.345]);
    assert!((printed.half_unit(12.345) / 0.0005 - 1.0).abs() < 1e-12);
    assert!((printed.half_unit(0.333) / 0.0005 - 1.0).abs() < 1e-12);
}

#[test]
fn a_solution_printed_with_few_digits_is_no_mistake() {
    let lcp = column();
    for decimals in [2, 3, 6] {
        let unit = 10f64.powi(decimals);
        let printed: Vec<f64> = exact(&lcp).iter().map(|x| (x * unit).round() / unit).collect();
        let found = find_mistakes(&ProblemForm::Boxed(lcp.clone()), &printed, None);
        assert!(matches!(found.conclusion, Conclusion::RoundedSolution { .. }), "{found:?}");
    }
}

/// A contact with μ = ½ that slides in its first direction: x₁ = x₀ / 2, so 1.1 x₀ = 1.
fn pushed_contact() -> Lcp {
    let lcp = boxed(
        &[&[1.0, 0.2, 0.0], &[0.2, 2.0, 0.0], &[0.0, 0.0, 2.0]],
        &[-1.0, -3.0, -0.5],
        &[0.0, f64::NEG_INFINITY, f64::NEG_INFINITY],
        &[f64::INFINITY; 3],
    );
    lcp.with_coupling(Coupling::new(vec![None, Some(0), Some(0)], vec![0.0, 0.5, 0.5]).unwrap())
        .unwrap()
}

/// Without friction x = (1, 0, 0), which is also (0.91, 0.45, 0.25) without any decimals.
#[test]
fn an_answer_of_whole_numbers_is_not_taken_for_a_rounded_solution() {
    let found = mistakes(&pushed_contact(), &[1.0, 0.0, 0.0]);
    assert!(found.iter().any(|own| own.kind == MistakeKind::FrictionLeftOut), "{found:?}");
}

#[test]
fn the_same_mistake_is_named_once() {
    // Friction without a limit, found by sweeps and by a pivoting solver.
    let found = mistakes(&pushed_contact(), &[1.0 / 1.4, 2.0 / 1.4, 0.25]);
    let named: Vec<&str> = found.iter().map(|own| own.what.as_str()).collect();
    let is_once = |what: &&str| named.iter().filter(|other| other == &what).count() == 1;
    assert!(named.len() > 1 && named.iter().all(is_once), "{named:#?}");
}

#[test]
fn of_many_solutions_the_one_beside_x_is_compared() {
    // Two copies of a contact: every x₀ + x₁ = 1 solves it. Sweeps end at (1, 0).
    let lcp = contacts(&[&[1.0, 1.0], &[1.0, 1.0]], &[-1.0, -1.0]);
    let found = find_mistakes(&ProblemForm::Boxed(lcp.clone()), &[0.3, 0.700_002], None);
    let Conclusion::Compared { solution_distance } = found.conclusion else { panic!("{found:?}") };
    assert!(solution_distance < 1e-5 && found.mistakes.is_empty(), "{found:?}");
}

#[test]
fn without_a_solution_nothing_is_named() {
    let lcp = contacts(&[&[1.0, -1.0], &[-1.0, 1.0]], &[-1.0, -1.0]); // walls that close in
    let found = find_mistakes(&ProblemForm::Boxed(lcp.clone()), &[1.0, 2.0], None);
    assert_eq!((found.conclusion, found.mistakes), (Conclusion::NoSolutionKnown, vec![]));
    let bounded = boxed(&[&[1.0]], &[-1.0], &[0.0], &[2.0]);
    assert_eq!(
        find_mistakes(&ProblemForm::Boxed(bounded.clone()), &[1.0], None).conclusion,
        Conclusion::Accepted
    );
}
