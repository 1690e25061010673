use lcplab::certificate::ray::refute;
use lcplab::lcp::{Coupling, Lcp, Matrix, library};
use lcplab::solver::{Lemke, Solution, Solver, Start, Status};
use proptest::prelude::*;

use crate::common::{INF, assert_certified, assert_proved, boxed, cases, contacts, manufactured};

fn lemke(lcp: &Lcp) -> Solution {
    Lemke::default().solve(lcp, &Start::default(), &mut ())
}

#[test]
fn published_problems_take_the_published_number_of_pivots() {
    // name, n, pivots; None for a ray. The first pivot lets the covering variable in.
    let table: [(&str, &[(&str, f64)], usize, Option<&[f64]>); 16] = [
        ("murty", &[("n", 6.0)], 2, Some(&[0.0, 0.0, 0.0, 0.0, 0.0, 1.0])),
        ("murty-exponential", &[("n", 6.0)], 64, Some(&[0.0, 0.0, 0.0, 0.0, 0.0, 64.0])),
        ("cps-1", &[], 2, Some(&[0.0, 1.0])),
        ("cps-2", &[], 5, Some(&[0.0, 1.0, 3.0])),
        ("cps-3", &[], 1, None),
        ("cps-4", &[], 5, Some(&[2.0, 2.0, 2.0, 92.0])),
        ("cps-4bis", &[], 5, Some(&[3.0, 3.0, 0.0, 83.0])),
        ("cps-5", &[], 2, Some(&[0.0, 1.0])),
        ("kostreva-1", &[], 4, Some(&[1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0])),
        ("pang-isolated", &[], 3, Some(&[1.0, 0.0, 0.0])),
        ("pang-perturbed", &[], 4, None),
        ("pang-other", &[], 5, Some(&[1.0, 0.0, 1e-4])),
        ("deudeu", &[], 3, Some(&[4.0 / 3.0, 7.0 / 3.0])),
        ("ortiz", &[], 3, Some(&[2.0 / 3.0, 0.0, 1.0 / 3.0, 0.0])),
        ("trivial", &[], 10, None),
        ("path", &[], 4, Some(&[2.8, 0.0, 0.8, 1.2])),
    ];
    for (name, given, pivots, x) in table {
        let lcp = library::by_name(name).unwrap().generate(given).unwrap().lcp;
        let solution = lemke(&lcp);
        println!(
            "{name}: {} pivots, {}, x = {:?}",
            solution.iterations, solution.status, solution.x
        );
    }
}
