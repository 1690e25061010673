use lcplab_judge::gap_bound::{EllipticCone, GapBound, answer_bound, gap_bound};
use lcplab_judge::motion_bound::Unproved;
use lcplab_lcp::Gauss;
use proptest::prelude::*;

use lcplab_testing::{INF, cases};

/// Columns of M: two pairs, each with M = 2ᵏ [2 1; 1 1], whose inverse is [1 −1; −1 2] / 2ᵏ.
const COLUMNS: usize = 4;

/// A problem with its exact solution; all numbers are short enough for exact arithmetic.
#[derive(Debug, Clone)]
struct Known {
    gauss: Gauss,
    cones: Vec<EllipticCone>,
    x: Vec<f64>,
    u: Vec<f64>,
}

/// The state of a contact or a row at the solution.
#[derive(Debug, Clone, Copy)]
enum State {
    /// No force.
    Open,
    /// Inside bounds or cone.
    Inside,
    /// On the surface: the contact slides, or the force is at its upper bound.
    Limit,
}

/// x and w = J û + bias + γ x of a contact with one coefficient per axis, on 5² = 3² + 4² or
/// 3² = 1² + 2² + 2².
fn contact(state: State, mu: &[f64]) -> (Vec<f64>, Vec<f64>) {
    let sides: &[f64] = if mu.len() == 2 { &[5.0, 3.0, 4.0] } else { &[3.0, 1.0, 2.0, 2.0] };
    let (normal, sides) = (sides[0], &sides[1..]);
    let with = |first: f64, part: &dyn Fn(f64, f64) -> f64| {
        let rest = sides.iter().zip(mu).map(|(&side, &mu)| part(side, mu));
        [first].into_iter().chain(rest).collect::<Vec<f64>>()
    };
    let zero = vec![0.0; mu.len() + 1];
    match state {
        State::Open => (zero, with(normal + 1.0, &|side, mu| side / mu)),
        State::Inside => (with(normal + 1.0, &|side, mu| side * mu), zero),
        State::Limit => (with(normal, &|side, mu| side * mu), with(normal, &|side, mu| -side / mu)),
    }
}

/// x, w, lo and hi of a row with bounds.
fn boxed(state: State, is_equation: bool) -> (f64, f64, f64, f64) {
    match (is_equation, state) {
        (true, _) => (1.5, 0.0, -INF, INF),
        (false, State::Open) => (0.0, 0.75, 0.0, INF),
        (false, State::Inside) => (0.5, 0.0, 0.0, INF),
        (false, State::Limit) => (1.0, -0.5, -1.0, 1.0),
    }
}

fn state() -> impl Strategy<Value = State> {
    prop_oneof![Just(State::Open), Just(State::Inside), Just(State::Limit)]
}

/// One contact of two axes, one of three, and rows with bounds.
fn known() -> impl Strategy<Value = Known> {
    let quarter = || (-4..=4i32).prop_map(|k| f64::from(k) / 4.0);
    let axis = || (-2..=1i32).prop_map(|k| 2f64.powi(k));
    let entries = proptest::collection::vec(proptest::collection::vec(quarter(), COLUMNS), 12);
    let contacts = (
        state(),
        proptest::collection::vec(axis(), 2),
        state(),
        proptest::collection::vec(axis(), 3),
    );
    let boxes = proptest::collection::vec((state(), any::<bool>()), 5);
    let soft = proptest::collection::vec((-6..=1i32).prop_map(|k| 2f64.powi(k)), 12);
    (entries, contacts, boxes, soft, -2..=2i32).prop_map(|(entries, contacts, boxes, soft, k)| {
        let size = 2f64.powi(k);
        let mass = [0, 2]
            .into_iter()
            .flat_map(|j| [(j, j, 2.0 * size), (j, j + 1, size), (j + 1, j + 1, size)]);
        let (mut x, mut w) = (Vec::new(), Vec::new());
        let (mut lo, mut hi, mut cones) = (Vec::new(), Vec::new(), Vec::new());
        for (state, mu) in [(contacts.0, contacts.1), (contacts.2, contacts.3)] {
            let normal = x.len();
            let friction = (normal + 1..).zip(mu.iter().copied()).collect();
            let (force, speed) = contact(state, &mu);
            lo.extend(std::iter::once(0.0).chain(mu.iter().map(|_| -INF)));
            hi.extend(force.iter().map(|_| INF));
            x.extend(force);
            w.extend(speed);
            cones.push(EllipticCone { normal, friction });
        }
        for (state, is_equation) in boxes {
            let row = boxed(state, is_equation);
            x.push(row.0);
            w.push(row.1);
            lo.push(row.2);
            hi.push(row.3);
        }
        let jacobian: Vec<Vec<(usize, f64)>> =
            entries.into_iter().map(|row| row.into_iter().enumerate().collect()).collect();
        let gauss = Gauss {
            mass: mass.collect(),
            jacobian,
            compliance: soft,
            target: vec![1.0, -2.0, 0.5, 3.0],
            lo,
            hi,
            ..Gauss::default()
        };
        let u = motion(&gauss, &x);
        let bias = (0..x.len()).map(|i| w[i] - along(&gauss, i, &u) - gauss.compliance[i] * x[i]);
        Known { gauss: Gauss { bias: bias.collect(), ..gauss.clone() }, cones, x, u }
    })
}

fn along(gauss: &Gauss, row: usize, u: &[f64]) -> f64 {
    gauss.jacobian[row].iter().map(|&(j, value)| value * u[j]).sum()
}

/// u* + M⁻¹Jᵀx by the inverse of the pairs.
fn motion(gauss: &Gauss, x: &[f64]) -> Vec<f64> {
    let mut push = [0.0; COLUMNS];
    for (row, x) in gauss.jacobian.iter().zip(x) {
        row.iter().for_each(|&(j, value)| push[j] += value * x);
    }
    let size = gauss.mass[1].2;
    let inverse = |j: usize| match j % 2 {
        0 => (push[j] - push[j + 1]) / size,
        _ => (2.0 * push[j] - push[j - 1]) / size,
    };
    (0..COLUMNS).map(|j| gauss.target[j] + inverse(j)).collect()
}

/// |u − v|_M.
fn distance(gauss: &Gauss, u: &[f64], v: &[f64]) -> f64 {
    let change: Vec<f64> = u.iter().zip(v).map(|(u, v)| u - v).collect();
    let term = |&(i, j, m): &(usize, usize, f64)| {
        m * change[i] * change[j] * if i == j { 1.0 } else { 2.0 }
    };
    gauss.mass.iter().map(term).sum::<f64>().max(0.0).sqrt()
}

fn perturbed(values: &[f64], by: &[f64], size: f64) -> Vec<f64> {
    values.iter().zip(by).map(|(value, by)| value + size * by).collect()
}

fn bound(known: &Known, x: &[f64], v: &[f64]) -> GapBound {
    gap_bound(&known.gauss, &known.cones, x, v).unwrap()
}

proptest! {
    #![proptest_config(cases(500))]

    #[test]
    fn no_error_is_larger_than_its_bound(
        known in known(),
        of_x in proptest::collection::vec(-1.0..1.0f64, 12),
        of_v in proptest::collection::vec(-1.0..1.0f64, COLUMNS),
        sizes in (0..14i32, 0..14i32),
        follows in any::<bool>(),
    ) {
        let x = perturbed(&known.x, &of_x, 10f64.powi(-sizes.0));
        let v = match follows {
            true => motion(&known.gauss, &x),
            false => perturbed(&known.u, &of_v, 10f64.powi(-sizes.1)),
        };
        let bound = bound(&known, &x, &v);
        let rounding = 1e-13; // of the test's own distances
        let error = distance(&known.gauss, &v, &known.u);
        prop_assert!(bound.motion >= error * (1.0 - 1e-12) - rounding, "{bound:?} {error}");
        let of_answer = distance(&known.gauss, &motion(&known.gauss, &x), &known.u);
        prop_assert!(bound.answer >= of_answer * (1.0 - 1e-12) - rounding, "{bound:?} {of_answer}");
        let between = distance(&known.gauss, &v, &motion(&known.gauss, &x));
        prop_assert!(bound.closure >= between * (1.0 - 1e-12) - rounding, "{bound:?} {between}");
    }

    #[test]
    fn the_exact_motion_has_a_bound_of_rounding(known in known()) {
        // √ε of the forces: where r and x are orthogonal on the surface of a cone, rounding of
        // either is the square of the bound.
        let bound = bound(&known, &known.x, &known.u);
        prop_assert!(bound.motion < 1e-6 && bound.answer < 1e-6, "{bound:?}");
        let of_answer = answer_bound(&known.gauss, &known.cones, &known.x).unwrap();
        prop_assert!(of_answer.energy_norm < 1e-6, "{of_answer:?}");
    }
}

/// 2 kg that a row of compliance γ = ½ stops from 3 m/s: x = 3 N s, û = −1.5 m/s.
fn stop() -> Gauss {
    Gauss {
        mass: vec![(0, 0, 2.0)],
        jacobian: vec![vec![(0, 1.0)]],
        bias: vec![0.0],
        compliance: vec![0.5],
        target: vec![-3.0],
        lo: vec![0.0],
        hi: vec![INF],
        level: None,
    }
}

#[test]
fn a_motion_that_its_forces_do_not_explain_has_a_closure() {
    // Half of the force is reported: u(x) = −2.25 m/s, 0.75 m/s from v, times √2.
    let bound = gap_bound(&stop(), &[], &[1.5], &[-1.5]).unwrap();
    assert!((bound.closure - 0.75 * 2f64.sqrt()).abs() < 1e-12, "{bound:?}");
    assert!(bound.motion < 1e-12, "{bound:?}"); // the motion itself is exact
}

#[test]
fn the_worst_row_is_the_one_that_was_changed() {
    let mut gauss = stop();
    gauss.mass.push((1, 1, 2.0));
    gauss.jacobian.push(vec![(1, 1.0)]);
    for values in [&mut gauss.bias, &mut gauss.lo] {
        values.push(0.0);
    }
    gauss.compliance.push(0.5);
    gauss.target.push(-3.0);
    gauss.hi.push(INF);
    let bound = gap_bound(&gauss, &[], &[3.0, 2.9], &[-1.5, -1.55]).unwrap();
    assert_eq!(bound.row, Some(1));
}

#[test]
fn a_violated_contact_without_compliance_has_no_bound() {
    let gauss = Gauss { compliance: vec![0.0], ..stop() };
    let violated = gap_bound(&gauss, &[], &[0.0], &[-3.0]);
    assert_eq!(violated, Err(Unproved::NoRoom { row: 0 }));
    let at_rest = gap_bound(&gauss, &[], &[6.0], &[0.0]).unwrap();
    assert!(at_rest.motion < 1e-15, "{at_rest:?}");
}

#[test]
fn a_row_with_a_fixed_force_has_any_speed() {
    // x = 1 N s: û = −3 + 1/2 m/s, and w = û + x/2 = −2 m/s is negative although x is at both
    // bounds.
    let gauss = Gauss { lo: vec![1.0], hi: vec![1.0], ..stop() };
    let exact = gap_bound(&gauss, &[], &[1.0], &[-2.5]).unwrap();
    assert!(exact.motion < 1e-12 && exact.answer < 1e-12, "{exact:?}");
}

#[test]
fn an_axis_without_friction_has_no_force_and_leaves_the_normal_force_alone() {
    // M = J = 1, γ = ½: x = (3, 0, 0) gives û = (3, 0, 0), and the bias makes w = (0, 0.7, 0).
    let gauss = Gauss {
        mass: (0..3).map(|j| (j, j, 1.0)).collect(),
        jacobian: (0..3).map(|j| vec![(j, 1.0)]).collect(),
        bias: vec![-4.5, 0.7, 0.0],
        compliance: vec![0.5; 3],
        target: vec![0.0; 3],
        lo: vec![0.0, -INF, -INF],
        hi: vec![INF; 3],
        level: None,
    };
    let cone = EllipticCone { normal: 0, friction: vec![(1, 0.0), (2, 0.5)] };
    let bound = gap_bound(&gauss, &[cone], &[3.0, 1e-20, 0.0], &[3.0, 0.0, 0.0]).unwrap();
    assert!(bound.motion < 1e-7 && bound.answer < 1e-7, "{bound:?}");
}

#[test]
fn a_negative_compliance_has_no_bound() {
    let gauss = Gauss { compliance: vec![-0.5], ..stop() };
    let refused = gap_bound(&gauss, &[], &[3.0], &[-1.5]);
    assert_eq!(refused, Err(Unproved::NegativeCompliance { row: 0 }));
}

#[test]
fn thousands_of_sparse_rows_have_a_bound() {
    // A wall of spheres of 1 kg in a line, pressed together: x_i = i, û = 0, γ = 1/1024.
    let n = 5_000;
    let soft = 1.0 / 1024.0;
    let x: Vec<f64> = (0..n).map(|i| (n - i) as f64).collect();
    let gauss = Gauss {
        mass: (0..n).map(|j| (j, j, 1.0)).collect(),
        jacobian: (0..n)
            .map(|i| if i == 0 { vec![(0, 1.0)] } else { vec![(i - 1, -1.0), (i, 1.0)] })
            .collect(),
        bias: x.iter().map(|x| -soft * x).collect(),
        compliance: vec![soft; n],
        target: vec![-1.0; n],
        lo: vec![0.0; n],
        hi: vec![INF; n],
        level: None,
    };
    let exact = gap_bound(&gauss, &[], &x, &vec![0.0; n]).unwrap();
    assert!(exact.motion < 1e-9, "{exact:?}");
    let mut v = vec![0.0; n];
    v[7] = 1e-3;
    let wrong = gap_bound(&gauss, &[], &x, &v).unwrap();
    assert!(wrong.motion >= 1e-3 && wrong.motion < 1.0, "{wrong:?}");
}
