use dashu_ratio::RBig;
use lcplab_judge::{Demand, judge_friction};
use lcplab_lcp::Lcp;
use lcplab_lcp::file::{Expected, Problem};
use lcplab_lcp::friction::Model;
use lcplab_lcp::library::{self, Family};
use lcplab_solver::all_solutions;

/// The expected solutions, and whether there are no others; `None` where nothing is known.
fn expected(problem: &Problem) -> Option<(Vec<Vec<RBig>>, bool)> {
    let Expected { solutions, complete } = Expected::of(problem)?;
    Some((solutions, complete))
}

fn rational(x: f64) -> RBig {
    RBig::try_from(x).unwrap()
}

/// The bounds of row i, ±μ max(x_k, 0) for a friction row; `None` for an infinite one.
fn bounds(lcp: &Lcp, i: usize, x: &[RBig]) -> [Option<RBig>; 2] {
    let coupled = lcp.coupling().and_then(|coupling| Some((coupling.index(i)?, coupling.mu(i))));
    match coupled {
        Some((k, mu)) => {
            let limit = rational(mu) * x[k].clone().max(RBig::ZERO);
            [Some(-limit.clone()), Some(limit)]
        }
        None => [lcp.lo()[i], lcp.hi()[i]].map(|b| b.is_finite().then(|| rational(b))),
    }
}

/// The definition of a solution, word for word, in exact arithmetic.
#[track_caller]
fn assert_solves(lcp: &Lcp, x: &[RBig], name: &str) {
    assert_eq!(x.len(), lcp.len(), "{name}");
    for i in 0..x.len() {
        let row = lcp.matrix().row(i).iter();
        let w = row.fold(rational(lcp.b()[i]), |w, (j, a)| w + rational(a) * &x[j]);
        let [lo, hi] = bounds(lcp, i, x);
        assert!(lo.as_ref().is_none_or(|lo| x[i] >= *lo), "{name}, row {i}");
        assert!(hi.as_ref().is_none_or(|hi| x[i] <= *hi), "{name}, row {i}");
        let is_at = |bound: Option<RBig>| bound.is_some_and(|bound| x[i] == bound);
        assert!(w <= RBig::ZERO || is_at(lo), "{name}, row {i}: w = {w}, x = {}", x[i]);
        assert!(w >= RBig::ZERO || is_at(hi), "{name}, row {i}: w = {w}, x = {}", x[i]);
    }
}

#[test]
fn every_expected_solution_solves_its_problem_exactly() {
    let variants: [&[(&str, f64)]; 10] = [
        &[],
        &[("n", 1.0), ("bodies", 1.0)],
        &[("n", 3.0), ("seed", 2.0)],
        &[("n", 12.0), ("boxed", 0.5), ("degenerate", 0.25), ("active", 0.25), ("rank", 0.5)],
        &[("n", 2.0), ("ratio", 1e9), ("contacts", 7.0), ("bits", 20.0), ("side", 10.0)],
        &[("n", 16.0), ("reversed", 1.0), ("condition", 1e6), ("pairs", 3.0), ("ratio", 3.0)],
        &[("mu", 1.0), ("spin", 0.5), ("fall", 0.3)],
        &[("mu", 1.5), ("spin", 2.0), ("fall", -0.01)],
        &[("mu", 3.0), ("tan", 0.7), ("spin", 5.0), ("fall", -2.0)],
        &[("mu", 0.0), ("spin", 1.0), ("fall", 1.0)],
    ];
    for family in library::all() {
        for variant in variants {
            let of_this = |v: &&(&str, f64)| {
                family
                    .parameters()
                    .iter()
                    .any(|p| p.name == v.0 && (p.least..=p.most).contains(&v.1))
            };
            let values: Vec<_> = variant.iter().filter(of_this).copied().collect();
            let problem = family.generate(&values).unwrap();
            for x in expected(&problem).into_iter().flat_map(|(solutions, _)| solutions) {
                assert_solves(&problem.lcp, &x, &problem.name);
            }
        }
    }
}

#[test]
fn complete_lists_are_those_of_exact_enumeration() {
    let mut compared = 0;
    for family in library::all() {
        let has_n = family.parameters().iter().any(|p| p.name == "n");
        let values = if has_n { vec![("n", 4.0)] } else { Vec::new() };
        let problem = family.generate(&values).unwrap();
        let Some((mut listed, true)) = expected(&problem) else { continue };
        let Some(mut found) = all_solutions(&problem.lcp) else { continue };
        listed.sort();
        found.sort();
        assert_eq!(listed, found, "{}", problem.name);
        compared += 1;
    }
    assert!(compared > 20, "{compared}");
}

#[test]
fn the_same_parameters_make_the_same_bits_and_survive_the_file() {
    for family in library::all() {
        let [first, second] = [(); 2].map(|()| family.generate(&[]).unwrap().to_json().to_string());
        assert_eq!(first, second, "{}", family.name());
        let back = Problem::parse(&first, "p.json").unwrap();
        assert_eq!(back.warnings, [""; 0], "{}", family.name());
        assert_eq!(back.to_json().to_string(), first, "{}", family.name());
    }
}

#[test]
fn another_seed_makes_another_problem() {
    for family in library::all() {
        if family.parameters().iter().any(|p| p.name == "seed") {
            let rows = |seed| {
                let lcp = family.generate(&[("seed", seed)]).unwrap().lcp;
                (lcp.matrix().to_dense(), lcp.b().to_vec())
            };
            assert_ne!(rows(1.0), rows(2.0), "{}", family.name());
        }
    }
}

#[test]
fn names_are_unique_and_values_are_checked() {
    let mut names: Vec<&str> = library::all().map(Family::name).collect();
    names.sort_unstable();
    names.dedup();
    assert_eq!(names.len(), library::all().count());
    let message = |given: &[(&str, f64)]| {
        library::by_name("murty").unwrap().generate(given).unwrap_err().to_string()
    };
    assert_eq!(message(&[("n", 0.0)]), "murty: n: must lie in 1 … 50, is 0");
    assert_eq!(message(&[("n", 2.5)]), "murty: n: must be a whole number, is 2.5");
    assert_eq!(message(&[("n", f64::NAN)]), "murty: n: must lie in 1 … 50, is NaN");
    assert_eq!(
        message(&[("m", 1.0)]),
        "murty: m: is no parameter of this family; there are n, reversed"
    );
    let unknown = library::by_name("murphy").err().unwrap().to_string();
    assert!(unknown.starts_with("there is no problem family named \"murphy\"; there are manufact"));
}

#[test]
fn every_family_says_what_it_is_and_where_it_comes_from() {
    for family in library::all() {
        assert!(!family.about().is_empty() && !family.source().is_empty(), "{}", family.name());
    }
}

#[test]
fn only_the_top_of_a_stack_is_heavier_and_the_ground_carries_all() {
    let given = [("n", 5.0), ("ratio", 8.0)];
    let problem = library::by_name("stack").unwrap().generate(&given).unwrap();
    let diagonal: Vec<f64> = (0..5).map(|i| problem.lcp.matrix().diagonal(i)).collect();
    assert_eq!(diagonal, [1.0, 2.0, 2.0, 2.0, 1.125]); // sums of inverse masses
    let (solutions, _) = expected(&problem).unwrap();
    assert_eq!(solutions, [[12, 11, 10, 9, 8].map(RBig::from)]);
}

/// 100 cubes, each with velocities of its own: 0.1 m/s in each component, 0.01 in their mean.
#[test]
fn cubes_fall_as_gravity_lets_them_in_a_step() {
    let of_corners = |seed| {
        let given = [("boxes", 1.0), ("seed", f64::from(seed))];
        let lcp = library::by_name("box-stack").unwrap().generate(&given).unwrap().lcp;
        lcp.b().iter().sum::<f64>() / 4.0
    };
    let mean = (0..100).map(of_corners).sum::<f64>() / 100.0;
    assert!((mean + 9.81 / 60.0).abs() < 0.05, "{mean}");
}

#[test]
fn the_corners_of_a_cube_move_as_a_rigid_body_lets_them() {
    // Moments 1/6 and corners at ±1/2: a_ij = 1 + 6 (x_i x_j + y_i y_j), 4 for a corner itself, 1
    // for the two beside it, −2 for the opposite one.
    let problem = library::by_name("box-stack").unwrap().generate(&[("boxes", 1.0)]).unwrap();
    for i in 0..4 {
        let mut row: Vec<f64> = (0..4).map(|j| problem.lcp.matrix().entry(i, j)).collect();
        assert_eq!(row[i], 4.0);
        row.sort_by(f64::total_cmp);
        assert_eq!(row, [-2.0, 1.0, 1.0, 4.0], "corner {i}");
    }
}

#[test]
fn contacts_with_friction_part_slide_and_stick_in_turns() {
    // x as (x_n, friction against t1, friction), then what the slip is
    let made = |name, contacts| {
        let problem = library::by_name(name).unwrap().generate(&[("contacts", contacts)]).unwrap();
        let x = expected(&problem).unwrap().0.swap_remove(0);
        let x: Vec<f64> = x.iter().map(|x| x.to_f64().value()).collect();
        (problem.lcp.w(&x), x)
    };
    let (w, x) = made("friction-blocks", 6.0);
    for k in 0..6 {
        let (w, x) = (&w[6 * k..], &x[6 * k..]);
        let rubs: f64 = x[1..5].iter().sum();
        assert_eq!((w[0] > 0.0, x[0] > 0.0), (k % 3 == 0, k % 3 != 0), "block {k}");
        assert_eq!((x[5] > 0.0, rubs == 0.5 * x[0]), (k % 3 < 2, k % 3 < 2), "block {k}");
    }
    let (w, x) = made("friction-pile", 6.0);
    for k in 0..6 {
        let (w, x) = (&w[3 * k..], &x[3 * k..]);
        assert_eq!((w[0] > 0.0, x[0] > 0.0), (k % 3 == 0, k % 3 != 0), "contact {k}");
        let (rubs, slips) = (x[1].hypot(x[2]), w[1].hypot(w[2]));
        assert_eq!(slips == 0.0 && rubs < 0.5 * x[0], k % 3 == 2, "contact {k}");
    }
}

#[test]
fn pressures_on_a_grid_have_the_eigenvalues_of_laplace() {
    // 6 − 2 Σ cos(k π/4), k from 1 to 3 along each of three edges with three cells
    let lcp = library::by_name("fluid").unwrap().generate(&[("n", 3.0)]).unwrap().lcp;
    let mut found = lcp.matrix().to_dense().symmetric_eigenvalues().as_slice().to_vec();
    let part = |k: usize| 2.0 - 2.0 * (k as f64 * std::f64::consts::FRAC_PI_4).cos();
    let each = |k: usize| part(1 + k % 3) + part(1 + k / 3 % 3) + part(1 + k / 9);
    let mut expected: Vec<f64> = (0..27).map(each).collect();
    [&mut found, &mut expected].into_iter().for_each(|values| values.sort_by(f64::total_cmp));
    for (found, expected) in found.iter().zip(&expected) {
        assert!((found - expected).abs() < 1e-12, "{found} for {expected}");
    }
}

#[test]
fn the_solutions_of_cps_5_are_a_ray() {
    // w = (1 + x1 − x2, −1 − x1 + x2) vanishes along x2 = 1 + x1.
    let lcp = library::by_name("cps-5").unwrap().generate(&[]).unwrap().lcp;
    for x1 in [0, 1, 7] {
        assert_solves(&lcp, &[x1, x1 + 1].map(RBig::from), "cps-5");
    }
}

#[test]
fn every_contact_of_a_graph_joins_a_body_to_another_one() {
    let given = [("bodies", 3.0), ("contacts", 100.0)];
    let lcp = library::by_name("contact-graph").unwrap().generate(&given).unwrap().lcp;
    // Contacts of a body with itself would give a zero on the diagonal.
    assert!((0..100).all(|i| lcp.matrix().diagonal(i) > 0.0));
}

#[test]
fn a_manufactured_problem_has_the_rank_and_the_condition_asked_for() {
    let make = |given: &[(&str, f64)]| {
        library::by_name("manufactured").unwrap().generate(given).unwrap().lcp
    };
    let eigenvalues = |lcp: &Lcp| {
        let mut values = lcp.matrix().to_dense().symmetric_eigenvalues().as_slice().to_vec();
        values.sort_by(f64::total_cmp);
        values
    };
    let regular = eigenvalues(&make(&[("n", 30.0), ("condition", 1e4)]));
    let ratio = regular[29] / regular[0];
    assert!((0.8e4..1.2e4).contains(&ratio), "{ratio}");
    let singular = eigenvalues(&make(&[("n", 30.0), ("rank", 0.4)]));
    assert_eq!(singular.iter().filter(|&&value| value > 1e-12).count(), 12);
}

#[test]
fn a_manufactured_problem_has_the_active_set_asked_for() {
    let given = [("n", 40.0), ("active", 0.5), ("degenerate", 0.25), ("boxed", 0.5)];
    let problem = library::by_name("manufactured").unwrap().generate(&given).unwrap();
    let lcp = &problem.lcp;
    let x: Vec<f64> = expected(&problem).unwrap().0[0].iter().map(|x| x.to_f64().value()).collect();
    let w = lcp.w(&x);
    let at_bound = |i: &usize| x[*i] == lcp.lo()[*i] || x[*i] == lcp.hi()[*i];
    assert_eq!((0..40).filter(|&i| w[i] != 0.0).count(), 20);
    assert_eq!((0..40).filter(|i| at_bound(i) && w[*i] == 0.0).count(), 10);
    assert_eq!(lcp.hi().iter().filter(|hi| hi.is_finite()).count(), 20);
    assert!(w.iter().any(|&w| w < 0.0), "some row is pushed to its upper bound");
}

#[test]
fn what_friction_families_expect_holds_under_every_model_but_the_associated_one() {
    for family in ["friction-table", "friction-pile"] {
        let problem = library::by_name(family).unwrap().generate(&[]).unwrap();
        let (solutions, _) = expected(&problem).unwrap();
        let x: Vec<f64> = solutions[0].iter().map(|x| x.to_f64().value()).collect();
        let friction = problem.friction().unwrap().unwrap();
        for model in Model::ALL {
            // Model 1 holds for boxes frozen at the x_n of this x.
            let posed = model.pose(&friction, Some(&x)).unwrap();
            let verdict = judge_friction(&posed, &x, &Demand::default()).verdict;
            assert_eq!(verdict.is_solution(), model != Model::AssociatedCone, "{family}, {model}");
        }
    }
}
