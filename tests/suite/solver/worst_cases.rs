use lcplab::lcp::{Lcp, library};
use lcplab::solver::{Options, Start, by_name};

fn pivots(solver: &str, family: &str, given: &[(&str, f64)]) -> usize {
    let lcp: Lcp = library::by_name(family).unwrap().generate(given).unwrap().lcp;
    let solution =
        by_name(solver, &Options::default()).unwrap().solve(&lcp, &Start::default(), &mut ());
    println!("{solver} {family} {given:?}: {} {}", solution.iterations, solution.status);
    solution.iterations
}

#[test]
fn table() {
    for family in ["murty", "fathi"] {
        for reversed in [0.0, 1.0] {
            for solver in ["pgs", "dantzig", "murty", "block-pivoting", "lemke", "enumeration"] {
                for n in [2.0, 3.0, 4.0, 6.0, 8.0, 10.0, 12.0] {
                    pivots(solver, family, &[("n", n), ("reversed", reversed)]);
                }
            }
        }
    }
}
