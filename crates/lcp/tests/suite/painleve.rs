//! Painlevé's rod against its closed forms.

use dashu_ratio::RBig;
use lcplab_judge::ray::refute;
use lcplab_lcp::Lcp;
use lcplab_lcp::file::{Expected, Problem};
use lcplab_lcp::library;
use lcplab_solver::{Options, Registry, Start, Status, all_solutions};
use nalgebra::{Matrix2, Vector2, Vector3};

use lcplab_testing::assert_proved;

fn make(family: &str, values: &[(&str, f64)]) -> Problem {
    library::by_name(family).unwrap().generate(values).unwrap()
}

fn listed(problem: &Problem) -> Vec<Vec<f64>> {
    let solutions = Expected::of(problem).unwrap().solutions;
    solutions.iter().map(|x| x.iter().map(|x| x.to_f64().value()).collect()).collect()
}

/// A_nn, A_nt, A_tt as products J M⁻¹ Jᵀ at an angle, with mass 1 and half-length 1.
fn delassus(angle: f64) -> [f64; 3] {
    let (sin, cos) = angle.sin_cos();
    let (normal, tangent) = (Vector3::new(0.0, 1.0, -cos), Vector3::new(1.0, 0.0, sin));
    let inverse_mass = Vector3::new(1.0, 1.0, 3.0); // m a²/3 is the moment of inertia
    let product = |a: &Vector3<f64>, b: &Vector3<f64>| a.component_mul(&inverse_mass).dot(b);
    [product(&normal, &normal), product(&normal, &tangent), product(&tangent, &tangent)]
}

fn critical(tan: f64) -> f64 {
    let (sin, cos) = tan.atan().sin_cos();
    (1.0 + 3.0 * cos * cos) / (3.0 * sin * cos)
}

#[test]
fn friction_turns_the_coefficient_negative_above_the_critical_mu_which_is_four_thirds_at_least() {
    for tan in [0.3, 0.7, 1.0, 2.0, 3.0, 20.0] {
        let a = |mu: f64| make("painleve", &[("tan", tan), ("mu", mu)]).lcp.matrix().diagonal(0);
        let mu = critical(tan);
        assert!(a(0.999 * mu) > 0.0 && a(1.001 * mu) < 0.0, "{tan}");
        let [nn, nt, _] = delassus(tan.atan());
        assert!((a(2.5) - nn - 2.5 * nt).abs() < 1e-14);
        assert!(mu >= 4.0 / 3.0 - 1e-15);
    }
    assert!((critical(2.0) - 4.0 / 3.0).abs() < 1e-15);
}

#[test]
fn forces_are_none_one_or_two_as_mu_and_the_spin_say() {
    for tan in [0.7, 2.0, 5.0] {
        for (above, spin, count) in [
            (true, 0.5, 0), // inconsistent
            (true, 2.0, 2), // indeterminate
            (true, 1.0, 1),
            (false, 0.5, 1), // ordinary
            (false, 2.0, 1),
        ] {
            let mu = critical(tan) * if above { 1.2 } else { 0.8 };
            let problem = make("painleve", &[("tan", tan), ("mu", mu), ("spin", spin)]);
            let [nn, nt, _] = delassus(tan.atan());
            let (mut list, balance) = (listed(&problem), (1.0 - spin) / (nn + mu * nt));
            assert_eq!(list.len(), count, "{}", problem.name);
            list.sort_by(|a, b| a[0].total_cmp(&b[0]));
            if spin >= 1.0 {
                assert_eq!(list[0], [0.0]);
            }
            if count == 2 || !above && spin < 1.0 {
                assert!((list[count - 1][0] - balance).abs() < 1e-12 * balance.abs());
            }
            assert_eq!(all_solutions(&problem.lcp).unwrap().len(), count);
            for x in list {
                assert_proved(&problem.lcp, &x);
            }
        }
    }
}

#[test]
fn the_inconsistent_rod_is_refuted_by_a_farkas_vector_and_no_other_is() {
    let refuted = |values: &[(&str, f64)]| {
        refute(&make("painleve", values).lcp, 0, &[1.0]).map(|farkas| farkas.vector)
    };
    assert_eq!(refuted(&[]), Some(vec![RBig::ONE]));
    assert_eq!(refuted(&[("mu", 1.0)]), None);
    assert_eq!(refuted(&[("spin", 2.0)]), None);
    let lcp = make("painleve", &[]).lcp;
    let exact = Registry::standard().entry("enumeration").unwrap().build(&Options::default());
    assert_eq!(exact.solve(&lcp, &Start::default(), &mut ()).status, Status::NoSolution);
}

/// x_n and x_t = β_1 − β_3 of Lemke's answer, which the judge proves.
fn impulse(lcp: &Lcp) -> [f64; 2] {
    let lemke = Registry::standard().entry("lemke").unwrap().build(&Options::default());
    let z = lemke.solve(lcp, &Start::default(), &mut ()).x;
    assert_proved(lcp, &z);
    [z[0], z[1] - z[3]]
}

#[test]
fn impulses_always_exist_and_are_those_of_sliding_below_and_of_sticking_above() {
    for tan in [0.7, 2.0, 5.0] {
        for (factor, fall) in [(0.3, 0.01), (0.8, 0.001), (0.8, 5.0), (1.2, 0.01), (3.0, 1.0)] {
            let mu = factor * critical(tan);
            let [nn, nt, tt] = delassus(tan.atan());
            let stick =
                Matrix2::new(nn, nt, nt, tt).try_inverse().unwrap() * Vector2::new(fall, 1.0);
            let x_n = fall / (nn + mu * nt);
            let slides = x_n > 0.0 && (nt + mu * tt) * x_n < 1.0;
            let expected = if slides { [x_n, mu * x_n] } else { [stick[0], stick[1]] };
            let problem = make("painleve-impulse", &[("tan", tan), ("mu", mu), ("fall", fall)]);
            let found = impulse(&problem.lcp);
            let list = listed(&problem);
            assert_eq!(list.len(), 1, "{}", problem.name);
            for (k, (&found, &expected)) in found.iter().zip(&expected).enumerate() {
                assert!((found - expected).abs() < 1e-9 * expected.abs(), "{}", problem.name);
                let listed = if k == 0 { list[0][0] } else { list[0][1] - list[0][3] };
                assert!((listed - expected).abs() < 1e-12 * expected.abs());
            }
        }
    }
}

#[test]
fn the_impulse_of_the_inconsistent_rod_does_not_vanish_with_the_time_step() {
    // ¾ sin θ cos θ, tan θ = 2: 0.3.
    for fall in [1e-3, 1e-6, 1e-9] {
        let [x_n, _] = impulse(&make("painleve-impulse", &[("fall", fall)]).lcp);
        assert!((x_n - 0.3).abs() < fall, "{x_n}");
    }
}

#[test]
fn the_indeterminate_rod_may_part_slide_or_stick() {
    let list = listed(&make("painleve-impulse", &[("fall", -0.125)]));
    let a = 1.0 + 3.0 * (0.2 - 2.0 * 0.4); // −0.8
    let expected = [0.0, -0.125 / a, (-0.125 * 3.4 + 1.2) / 4.0];
    assert_eq!(list.len(), 3);
    for (z, expected) in list.iter().zip(expected) {
        assert!((z[0] - expected).abs() < 1e-14, "{z:?}");
    }
    // Below the critical μ only one is left.
    assert_eq!(listed(&make("painleve-impulse", &[("fall", -0.125), ("mu", 1.0)])).len(), 1);
}
