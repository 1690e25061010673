//! E06: bounds applied after the sweep, K&M Code 6.

use super::common::{contacts, enumerated, last};
use super::{Finding, Measure};
use crate::error::Result;
use crate::solver::{Code6, Options, Pgs, Registry, Start};

/// A wrong limit in two rows, another between three balls, divergence in three.
pub(super) fn example() -> Result<Finding> {
    let problems: [(&str, &[f64], &[f64]); 3] = [
        ("A = [1 ½; ½ 1], b = (1, −1)", &[1.0, 0.5, 0.5, 1.0], &[1.0, -1.0]),
        ("A = [2 −1; −1 2], b = (1, −1)", &[2.0, -1.0, -1.0, 2.0], &[1.0, -1.0]),
        (
            "A = [3 1 2; 1 4 3; 2 3 3], b = (0, 0, −1)",
            &[3.0, 1.0, 2.0, 1.0, 4.0, 3.0, 2.0, 3.0, 3.0],
            &[0.0, 0.0, -1.0],
        ),
    ];
    let mut finding = Finding::new(
        "Three problems w = A x + b ≥ 0, x ≥ 0, b in this library's sign. In the first, Code 6 ends at a \
         vector that is no solution; in the second, the middle one of three equal balls runs into the \
         third at 1 m/s, and the pair goes on closing at ⅓; in the third its first sweep from 0 hits the \
         solution (0, 0, ⅓), but it does not stay there. All start at (2, …, 2) and make \
         10000 sweeps at most.",
    );
    let quantities = ["x₂ of two rows", "x₂, three balls", "x₃ of three rows"];
    for (quantity, (name, a, b)) in quantities.into_iter().zip(problems) {
        let lcp = contacts(a, b)?;
        let start = vec![2.0; b.len()];
        let answer = |solver: &str| -> Result<Vec<f64>> {
            let solver = Registry::standard().entry(solver)?.build(&Options::default());
            Ok(solver.solve(&lcp, &Start::at(&start), &mut ()).x)
        };
        let (printed, corrected) = (answer(Code6::NAME)?, answer(Pgs::NAME)?);
        let end = b.len() - 1;
        let x = Measure::new(quantity, "", printed[end], corrected[end]);
        finding = finding
            .measure(x.truth(&last(enumerated(&lcp))[end..], "enumeration", 1e-7))
            .judged(name, &lcp, &printed, &corrected);
    }
    Ok(finding)
}
