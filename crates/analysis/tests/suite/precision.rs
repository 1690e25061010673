//! Errors in single precision.

use lcplab_analysis::precision::{Precision, Stage, TextbookSolver};
use lcplab_lcp::Question;
use lcplab_lcp::file::Problem;
use serde_json::json;

const STEP: f64 = 0.0981; // g dt in m/s

/// A column of bodies with these masses in kg, from the ground up, at rest.
fn stack(masses: &[f64]) -> Question {
    stack_with(masses, &vec![0.0; masses.len()])
}

/// The same with a bias of the rows, in m/s.
fn stack_with(masses: &[f64], bias: &[f64]) -> Question {
    let n = masses.len();
    let inverse = |i: usize| 1.0 / masses[i];
    let mut a = vec![vec![0.0; n]; n];
    let mut jacobian = Vec::new();
    for i in 0..n {
        a[i][i] = inverse(i) + if i > 0 { inverse(i - 1) } else { 0.0 };
        jacobian.push(json!([i, i, 1]));
        if i > 0 {
            (a[i][i - 1], a[i - 1][i]) = (-inverse(i - 1), -inverse(i - 1));
            jacobian.push(json!([i, i - 1, -1]));
        }
    }
    let mut b = bias.to_vec();
    b[0] -= STEP;
    let mass: Vec<_> = masses.iter().enumerate().map(|(i, m)| json!([i, i, m])).collect();
    let zeros = vec![0.0; n];
    let problem = json!({"A": {"dense": a}, "b": b, "motion": {
        "mass": mass, "jacobian": jacobian, "bias": bias, "compliance": zeros,
        "target": vec![-STEP; n], "level": "velocity"}});
    let problem = Problem::parse(&problem.to_string(), "stack.json").unwrap();
    Question::new(&problem, None, "stack.json").unwrap()
}

/// Masses of n bodies that differ by 10 %, the top one heavier, or every second one if the ratio is
/// negative.
fn masses(random: &mut oorandom::Rand64, n: usize, ratio: f64) -> Vec<f64> {
    let common = 1.0 + 9.0 * random.rand_float();
    let mass = |i: usize| {
        let is_heavy = if ratio < 0.0 { i % 2 == 1 } else { i + 1 == n };
        let own = common * (0.9 + 0.2 * random.rand_float());
        if is_heavy { ratio.abs() * own } else { own }
    };
    (0..n).map(mass).collect()
}

#[test]
fn the_motion_error_of_stacks_is_predicted_within_a_factor_of_three() {
    let ratios = [0.01, 1.0, 10.0, 100.0, 1e4, -30.0, -1000.0];
    let all = ratios.iter().flat_map(|&ratio| [2, 5, 10, 20].map(|n| (n, ratio)));
    let direct = all.flat_map(|(n, ratio)| {
        [TextbookSolver::Dantzig, TextbookSolver::Newton].map(|solver| (solver, n, ratio))
    });
    // Those that converge in a second.
    let sweeps = [(2, 0.01), (2, 1.0), (5, 1.0), (10, 1.0), (20, 1.0), (2, 10.0), (5, 10.0)];
    let sweeps = [&sweeps[..], &[(10, 10.0), (2, 100.0), (5, 100.0), (2, -30.0), (10, -30.0)]];
    let sweeps = sweeps.concat().into_iter().map(|(n, ratio)| (TextbookSolver::Pgs, n, ratio));
    let (mut stacks, mut near) = (0.0, 0.0);
    for (solver, n, ratio) in direct.chain(sweeps) {
        let mut random = oorandom::Rand64::new(59);
        let (mut measured, mut predicted) = (0.0_f64, 0.0_f64);
        for _ in 0..10 {
            let masses = masses(&mut random, n, ratio);
            let precision = Precision::of(&stack(&masses), Some(solver), None, 1e-3).unwrap();
            let (own, expected) = (precision.single.relative, precision.predicted.unwrap());
            assert!(precision.double.relative < 1e-7, "{solver:?}, {n} bodies, ratio {ratio}");
            assert!(own < 3.0 * expected, "{solver:?}, {masses:?}: {own} of {expected}");
            (measured, predicted) = (measured.hypot(own), predicted.hypot(expected));
            stacks += 1.0;
            near += f64::from(own > expected / 3.0);
        }
        let quotient = measured / predicted;
        assert!((1.0 / 3.0..3.0).contains(&quotient), "{solver:?}, {n}, {ratio}: {quotient}");
    }
    // Roundings of a single stack can cancel, and some masses are numbers of 24 bits.
    assert!(near / stacks > 0.75, "{near} of {stacks}");
}

#[test]
fn the_prediction_is_the_closed_form_of_a_stack() {
    // Of n bodies of mass 1, body k carries n − k; A⁻¹ has n − i on its diagonal, and the terms of
    // row i are (n − i + 1, 2 (n − i), n − i − 1) g dt, those of the ground (n, n − 1, 1) g dt.
    let n = 8;
    let terms = |i: usize| {
        let load = (n - i) as f64;
        match i {
            0 => load.powi(2) + (load - 1.0).powi(2) + 1.0,
            _ => (load + 1.0).powi(2) + 4.0 * load.powi(2) + (load - 1.0).powi(2),
        }
    };
    let square: f64 = (0..n).map(|i| (n - i) as f64 * terms(i)).sum::<f64>() / n as f64;
    let velocities = 2.0; // u* and M⁻¹Jᵀx, both −g dt; u = 0
    let rms = (1.0 / (8.0 * 2f64.ln())).sqrt() * 2f64.powi(-24); // of one rounding
    let expected = rms * (square + velocities).sqrt();
    for solver in [TextbookSolver::Dantzig, TextbookSolver::Newton] {
        let precision = Precision::of(&stack(&[1.0; 8]), Some(solver), None, 1e-3).unwrap();
        let predicted = precision.predicted.unwrap();
        assert!((predicted / expected - 1.0).abs() < 1e-9, "{predicted} and {expected}");
    }
}

#[test]
fn rounded_masses_still_rest_but_rounded_sums_do_not() {
    // Any masses rest on the ground, so data in single precision cost nothing, as long as all
    // stages use the same ones.
    let precision =
        Precision::of(&stack(&[1.1, 2.3, 0.7, 97.0]), Some(TextbookSolver::Pgs), None, 1e-3)
            .unwrap();
    let losses = precision.stages.iter().map(|own| (own.stage, own.alone.relative));
    let losses: Vec<(Stage, f64)> = losses.collect();
    let stages = losses.iter().map(|(stage, _)| *stage);
    assert_eq!(
        stages.collect::<Vec<_>>(),
        [Stage::Data, Stage::Assembly, Stage::Sums, Stage::Velocity]
    );
    assert!(losses[0].1 < 1e-9 && losses[2].1 > 1e-6, "{losses:?}");
    assert_eq!(precision.worst().unwrap().stage, Stage::Sums);
}

#[test]
fn sums_in_double_mend_sweeps_if_the_matrix_is_exact() {
    // 1/m + 1/m of equal masses is not rounded: what is left is the rounding of 1/m, which acts
    // as another mass, and that of x. This one is √(Σ a_ii r_i²), r_i = 0.42 × 2⁻²⁴ x_i, and x_i
    // is the load of 20 − i bodies.
    let squares: f64 = (1..=20).map(|load| f64::from(load).powi(2)).sum();
    let of_x = 0.42 * 2f64.powi(-24) * (2.0 * squares / 20.0).sqrt();
    let precision =
        Precision::of(&stack(&[1.1; 20]), Some(TextbookSolver::Pgs), None, 1e-6).unwrap();
    assert!(!precision.suffices());
    let best = precision.best_mended().unwrap();
    assert_eq!(best.stage, Stage::Sums);
    let (mended, single) = (best.mended.relative, precision.single.relative);
    assert!(mended < 3.0 * of_x && single > 3.0 * of_x, "{mended}, {single}, {of_x}");
}

#[test]
fn positions_in_single_precision_lose_more_than_all_stages() {
    // Five boxes of 0.2 m on a floor at a height of 1 m. The gap is a difference of positions, each
    // wrong by up to 2⁻²⁴ m, and the rows ask for the velocity −gap/dt.
    let (n, dt) = (5, 0.01);
    let height = |k: usize| f64::from((1.1 + 0.2 * k as f64) as f32);
    let gap = |k: usize| match k {
        0 => height(0) - f64::from(1.1_f32),
        _ => height(k) - height(k - 1) - 0.2,
    };
    let gaps: Vec<f64> = (0..n).map(|k| gap(k) / dt).collect();
    let precision = Precision::of(&stack_with(&[1.1; 5], &gaps), None, None, 1e-3).unwrap();
    let moved = precision.u.as_ref().unwrap().iter().fold(0.0_f64, |most, u| most.max(u.abs()));
    assert!(moved < 2.0 * 2f64.powi(-24) / dt && moved > 2f64.powi(-25) / dt, "{moved} m/s");
    let solver = precision.single.largest_entry;
    assert!(solver < 0.02 * moved, "{solver} of {moved} m/s");
}

#[test]
fn numbers_beyond_single_precision_are_an_infinite_error() {
    // 10³⁹ m/s upward, above the largest number of 24 bits, 3.4 × 10³⁸; the contact is open.
    let problem = json!({"A": {"dense": [[1]]}, "b": [1e39], "motion": {
        "mass": [[0, 0, 1], [1, 1, 1]], "jacobian": [[0, 0, 1]], "bias": [0], "compliance": [0],
        "target": [1e39, 0], "level": "velocity"}});
    let problem = Problem::parse(&problem.to_string(), "fast.json").unwrap();
    let question = Question::new(&problem, None, "fast.json").unwrap();
    let precision = Precision::of(&question, None, None, 1e-3).unwrap();
    assert_eq!((precision.double.relative, precision.single.relative), (0.0, f64::INFINITY));
    let velocity = precision.stages.iter().find(|own| own.stage == Stage::Velocity).unwrap();
    assert_eq!(velocity.alone.relative, f64::INFINITY);
    assert!(!precision.suffices());
}

#[test]
fn a_problem_without_masses_is_measured_by_its_rows() {
    let problem = json!({"A": {"dense": [[3, 1], [1, 7]]}, "b": [-1, -1]});
    let problem = Problem::parse(&problem.to_string(), "two.json").unwrap();
    let question = Question::new(&problem, None, "two.json").unwrap();
    let precision = Precision::of(&question, None, None, 1e-3).unwrap();
    assert!(precision.u.is_none() && precision.is_proved);
    let names: Vec<&str> = precision.stages.iter().map(|own| own.stage.name()).collect();
    assert_eq!(names, ["data", "factor", "sums"]);
    // x = (6, 2)/20, |x|²_A = −bᵀx = 0.4; an error of x by its rounding, u x/2, is all there is.
    assert!((precision.effect - 0.4f64.sqrt()).abs() < 1e-15);
    assert!(precision.single.relative < 2f64.powi(-24) && precision.single.relative > 0.0);
}

#[test]
fn a_motion_that_contradicts_the_matrix_is_refused_and_not_left_out() {
    let problem = json!({"A": {"dense": [[1]]}, "b": [-2], "motion": {
        "mass": [[0, 0, 1]], "jacobian": [[0, 0, 1]], "bias": [0], "compliance": [0],
        "target": [-3], "level": "velocity"}});
    let problem = Problem::parse(&problem.to_string(), "other.json").unwrap();
    let question = Question::new(&problem, None, "other.json").unwrap();
    let error = Precision::of(&question, None, None, 1e-3).unwrap_err().to_string();
    assert!(error.contains("row 0") && error.contains("contradicts"), "{error}");
}
