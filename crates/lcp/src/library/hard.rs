//! Problems that are hard for some method and easy to write down.

use dashu_int::UBig;
use dashu_ratio::RBig;
use nalgebra::DMatrix;

use super::{Expected, Generated, Parameter, contacts, offset};
use crate::Matrix;
use crate::file::Problem;

const ORDER: Parameter =
    Parameter::whole("reversed", "1: rows in reverse order, which makes it easy", 0, [0, 1]);

pub(super) const FAMILIES: &[Generated] = &[
    Generated {
        name: "murty",
        about: "1 on the diagonal, 2 above; b = −1: the least-index rule needs 2ⁿ − 1 pivots",
        source: "Murty 1978; Handbook of Test Problems 10.2.1",
        parameters: &[Parameter::whole("n", "number of rows", 6, [1, 50]), ORDER],
        make: |values| triangular(values.whole("n"), values.whole("reversed") == 1),
    },
    Generated {
        name: "murty-exponential",
        about: "Murty's matrix, b_i = 2^i − 2^(n+1): Lemke's path has 2ⁿ pieces, no ties",
        source: "Murty 1978; lcp_exp_murty2 of Siconos",
        parameters: &[Parameter::whole("n", "number of rows", 6, [1, 50])],
        make: |values| {
            let n = values.whole("n");
            let power = |k: usize| 2f64.powi(k as i32);
            let b = (1..=n).map(|i| power(i) - power(n + 1)).collect();
            let x = unit(n, n - 1).into_iter().map(|x| x * power_of_two(n)).collect();
            contacts(Matrix::from(murty(n).as_view()), b, &Expected::unique(x))
        },
    },
    Generated {
        name: "fathi",
        about: "F = U Uᵀ with Murty's U, positive definite; b = −1: five methods need 1 to 2ⁿ steps, by the numbering of the rows",
        source: "Fathi 1979",
        parameters: &[Parameter::whole("n", "number of rows", 6, [1, 50]), ORDER],
        make: |values| {
            let (n, u) = (values.whole("n"), murty(values.whole("n")));
            last_unit(n, &u * u.transpose(), values.whole("reversed") == 1)
        },
    },
    Generated {
        name: "csizmadia",
        about: "1 on the diagonal, −1 below; b = −1: handicap κ grows as 4ⁿ, x_i = 2^(i−1)",
        source: "Csizmadia; de Klerk & E.-Nagy 2011",
        parameters: &[Parameter::whole("n", "number of rows", 6, [1, 50])],
        make: |values| {
            let n = values.whole("n");
            let a = DMatrix::from_fn(n, n, |i, j| {
                f64::from(u8::from(i == j)) - f64::from(u8::from(i > j))
            });
            let x = (0..n).map(power_of_two).collect();
            contacts(Matrix::from(a.as_view()), vec![-1.0; n], &Expected::unique(x))
        },
    },
    Generated {
        name: "hilbert",
        about: "Hilbert's matrix, scaled to integer entries; x = 1, 0, 1, 0, …",
        source: "Hilbert 1894; condition about 33ⁿ",
        parameters: &[Parameter::whole("n", "number of rows", 8, [1, 16])],
        make: |values| hilbert(values.whole("n")),
    },
    Generated {
        name: "several",
        about: "pairs [1 2; 2 1], b = −2: three solutions per pair, 3^pairs in total",
        source: "made of pairs; the determinant of each is −3, so A is no P-matrix",
        parameters: &[Parameter::whole("pairs", "number of pairs", 1, [1, 5])],
        make: |values| several(values.whole("pairs")),
    },
    Generated {
        name: "wedged",
        about: "a ring of n bodies pressed together: Σ w = −n for every x, so no solution exists",
        source: "Farkas vector (1, …, 1)",
        parameters: &[Parameter::whole("n", "number of contacts", 4, [2, 1000])],
        make: |values| {
            let n = values.whole("n");
            let pairs = (0..n).flat_map(|i| {
                [(i, i, 1.0), (i, i, 1.0), (i, (i + 1) % n, -1.0), ((i + 1) % n, i, -1.0)]
            });
            let a = Matrix::sparse(n, &pairs.collect::<Vec<_>>());
            contacts(a, vec![-1.0; n], &Expected { solutions: Vec::new(), complete: true })
        },
    },
];

/// The triangular matrix of Murty's example.
fn murty(n: usize) -> DMatrix<f64> {
    DMatrix::from_fn(n, n, |i, j| f64::from(u8::from(i <= j) + u8::from(i < j)))
}

fn triangular(n: usize, is_reversed: bool) -> Problem {
    last_unit(n, murty(n), is_reversed)
}

/// b = −1 with the solution e_n, or e_1 if the rows are numbered backward.
fn last_unit(n: usize, a: DMatrix<f64>, is_reversed: bool) -> Problem {
    let place = |i: usize| if is_reversed { n - 1 - i } else { i };
    let a = DMatrix::from_fn(n, n, |i, j| a[(place(i), place(j))]);
    let x = unit(n, place(n - 1));
    contacts(Matrix::from(a.as_view()), vec![-1.0; n], &Expected::unique(x))
}

fn unit(n: usize, k: usize) -> Vec<RBig> {
    (0..n).map(|i| if i == k { RBig::ONE } else { RBig::ZERO }).collect()
}

fn power_of_two(k: usize) -> RBig {
    RBig::from(UBig::ONE << k)
}

/// The Hilbert matrix times L: L / (i + j − 1), L the least common multiple of 1, 2, …, 2n − 1.
fn hilbert(n: usize) -> Problem {
    let gcd = |mut a: u64, mut b: u64| {
        while b != 0 {
            (a, b) = (b, a % b);
        }
        a
    };
    let multiple = (1..2 * n as u64).fold(1, |l, k| l / gcd(l, k) * k);
    let a = DMatrix::from_fn(n, n, |i, j| (multiple / (i + j + 1) as u64) as f64);
    let a = Matrix::from(a.as_view());
    let x: Vec<f64> = (0..n).map(|i| f64::from(u8::from(i % 2 == 0))).collect();
    let w: Vec<f64> = x.iter().map(|x| (1.0 - x) * multiple as f64).collect();
    let b = offset(&a, &x, &w);
    contacts(a, b, &Expected::unique(x.into_iter().map(super::rational).collect()))
}

/// Each pair has the solutions (2, 0), (0, 2) and (2/3, 2/3).
fn several(pairs: usize) -> Problem {
    let n = 2 * pairs;
    let entry = |i: usize, j: usize| match (i == j, i / 2 == j / 2) {
        (true, _) => 1.0,
        (false, true) => 2.0,
        _ => 0.0,
    };
    let a = DMatrix::from_fn(n, n, entry);
    let thirds = |a: i32, b: i32| [RBig::from(a) / RBig::from(3), RBig::from(b) / RBig::from(3)];
    let of_a_pair = [thirds(6, 0), thirds(0, 6), thirds(2, 2)];
    let solution = |number: usize| {
        let choice = |k: u32| of_a_pair[number / 3usize.pow(k) % 3].clone();
        (0..pairs as u32).flat_map(choice).collect()
    };
    let solutions = (0..3usize.pow(pairs as u32)).map(solution).collect();
    contacts(Matrix::from(a.as_view()), vec![-2.0; n], &Expected { solutions, complete: true })
}
