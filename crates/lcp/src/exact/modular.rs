//! Exact solution of integer linear systems by p-adic lifting (Dixon 1982).
//!
//! With C = A⁻¹ mod p for one prime p, each step gives the next p-adic digit of the solution:
//!
//! ```text
//! x_k = C r_k mod p,   r_{k+1} = (r_k − A x_k) / p,   x = Σ x_k p^k  (mod p^K)
//! ```
//!
//! The fractions are reconstructed from x mod p^K and then *verified* in A x = r, so the answer
//! does not depend on a bound. A step costs n² operations on small integers; elimination over the
//! integers multiplies numbers of thousands of digits.
//!
//! ```
//! use dashu_int::IBig;
//! use lcplab_lcp::exact::modular::{rank_profile, solve};
//!
//! // Row 1 is twice row 0.
//! let rows = [[1, 2], [2, 4], [0, 1]].map(|row| row.map(IBig::from).to_vec());
//! assert_eq!(rank_profile(&rows).rows, [0, 2]);
//!
//! // 2 x + y = 1 and x + 3 y = 2: x = 1/5, y = 3/5.
//! let a = [[2, 1], [1, 3]].map(|row| row.map(IBig::from).to_vec());
//! let (numerators, denominator) = solve(&a, &[1.into(), 2.into()]).unwrap();
//! assert_eq!((numerators, denominator), (vec![1.into(), 3.into()], 5.into()));
//! ```

use dashu_int::IBig;
use dashu_int::ops::{Abs, BitTest, UnsignedAbs};

/// The prime 2⁶¹ − 1.
const P: u64 = (1 << 61) - 1;

/// The rows and columns of a largest submatrix that is invertible mod p, hence invertible.
pub struct RankProfile {
    /// Its rows, ascending.
    pub rows: Vec<usize>,
    /// Its columns, ascending.
    pub columns: Vec<usize>,
}

/// Gaussian elimination mod p. The rows and columns are in ascending order.
pub fn rank_profile(a: &[Vec<IBig>]) -> RankProfile {
    let mut m: Vec<Vec<u64>> = a.iter().map(|row| row.iter().map(residue).collect()).collect();
    let mut order: Vec<usize> = (0..m.len()).collect();
    let mut columns = Vec::new();
    for j in 0..m.first().map_or(0, Vec::len) {
        let r = columns.len();
        let Some(pivot) = (r..m.len()).find(|&i| m[i][j] != 0) else { continue };
        m.swap(r, pivot);
        order.swap(r, pivot);
        let inverse = invert(m[r][j]);
        let (top, below) = m.split_at_mut(r + 1);
        for row in below {
            let factor = mul(row[j], inverse);
            eliminate(row, &top[r], factor, j);
        }
        columns.push(j);
    }
    let mut rows = order[..columns.len()].to_vec();
    rows.sort_unstable();
    RankProfile { rows, columns }
}

/// The solution of the square system A x = r as numerators over one positive denominator; `None`
/// if A is singular mod p.
pub fn solve(a: &[Vec<IBig>], r: &[IBig]) -> Option<(Vec<IBig>, IBig)> {
    if a.is_empty() {
        return Some((Vec::new(), IBig::ONE));
    }
    let (inverse, words) = (inverse(a)?, Words::of(a));
    let steps = bound_in_digits(a, r);
    let p = IBig::from(P);
    let (mut x, mut rest, mut power) = (vec![IBig::ZERO; a.len()], r.to_vec(), IBig::ONE);
    let mut next_try = 4;
    for step in 1..=steps {
        let digit = digit(&inverse, &rest);
        for (rest, row) in rest.iter_mut().zip(&words.rows) {
            *rest = (&*rest - words.product(row, &digit)) / &p;
        }
        for (x, digit) in x.iter_mut().zip(digit) {
            *x += &power * IBig::from(digit);
        }
        power *= &p;
        if step == next_try || step == steps {
            if let Some(solution) = reconstruct(&x, &power).filter(|s| satisfies(a, r, s)) {
                return Some(solution);
            }
            next_try *= 4;
        }
    }
    None
}

/// The nonzero entries of A as 64-bit words, the same number of words for each. The product with a
/// digit is accumulated in 128-bit sums, one per word, without allocating a number for each term.
struct Words {
    /// For each row the columns, each with its sign and the position of its first word.
    rows: Vec<Vec<(usize, bool, usize)>>,
    /// The words, least significant first within each entry.
    words: Vec<u64>,
    /// The number of words per entry.
    count: usize,
}

impl Words {
    fn of(a: &[Vec<IBig>]) -> Self {
        let most = a.iter().flatten().map(BitTest::bit_len).max().unwrap_or(0);
        let (count, mut words) = (most.div_ceil(64).max(1), Vec::new());
        let mut entry = |(j, entry): (usize, &IBig)| {
            let first = words.len();
            words.extend(entry.unsigned_abs().to_le_bytes().chunks(8).map(word));
            words.resize(first + count, 0);
            (j, *entry < IBig::ZERO, first)
        };
        let row = |row: &Vec<IBig>| {
            let entries = row.iter().enumerate().filter(|(_, a)| **a != IBig::ZERO);
            entries.map(&mut entry).collect()
        };
        Words { rows: a.iter().map(row).collect(), words, count }
    }

    /// The product of a row with x, whose digits are below 2⁶¹.
    fn product(&self, row: &[(usize, bool, usize)], x: &[u64]) -> IBig {
        let mut sums = [vec![0_u128; self.count + 1], vec![0_u128; self.count + 1]];
        for &(j, is_negative, first) in row {
            let (sum, x) = (&mut sums[usize::from(is_negative)], u128::from(x[j]));
            for (k, &word) in self.words[first..first + self.count].iter().enumerate() {
                let product = u128::from(word) * x;
                sum[k] += product & u128::from(u64::MAX);
                sum[k + 1] += product >> 64;
            }
        }
        let [above, below] = sums.map(|sum| {
            let words = sum.iter().rev();
            words.fold(IBig::ZERO, |total, &word| (total << 64) + IBig::from(word))
        });
        above - below
    }
}

/// The number in up to eight bytes, least significant first.
fn word(bytes: &[u8]) -> u64 {
    bytes.iter().rev().fold(0, |word, &byte| word << 8 | u64::from(byte))
}

/// A number of digits sufficient for every numerator and denominator, by Cramer's rule and
/// Hadamard's bound.
fn bound_in_digits(a: &[Vec<IBig>], r: &[IBig]) -> usize {
    let norm_bits = |row: &[IBig]| {
        row.iter().map(BitTest::bit_len).max().unwrap_or(0) + row.len().ilog2() as usize / 2 + 1
    };
    let determinant: usize = a.iter().map(|row| norm_bits(row)).sum();
    let rhs = norm_bits(r);
    2 * (determinant + rhs + 1) / 61 + 2
}

fn digit(inverse: &[Vec<u64>], rest: &[IBig]) -> Vec<u64> {
    let rest: Vec<u64> = rest.iter().map(residue).collect();
    let row = |row: &Vec<u64>| row.iter().zip(&rest).fold(0, |sum, (&c, &r)| add(sum, mul(c, r)));
    inverse.iter().map(row).collect()
}

/// Small numerators N_i and one small denominator D with N_i / D ≡ x_i mod m.
fn reconstruct(x: &[IBig], m: &IBig) -> Option<(Vec<IBig>, IBig)> {
    let limit = IBig::ONE << ((m.bit_len() - 2) / 2);
    let mut denominator = IBig::ONE;
    for x in x {
        let numerator = symmetric(x * &denominator, m);
        if (&numerator).abs() > limit {
            denominator *= fraction(&numerator, m, &limit)?.1;
            if denominator > limit {
                return None;
            }
        }
    }
    let numerators = x.iter().map(|x| symmetric(x * &denominator, m)).collect();
    Some((numerators, denominator))
}

/// (N, D) with N ≡ D x mod m, |N| ≤ limit, 0 < D: the extended Euclidean algorithm, stopped
/// halfway (Wang 1981).
fn fraction(x: &IBig, m: &IBig, limit: &IBig) -> Option<(IBig, IBig)> {
    let (mut r0, mut r1) = (m.clone(), symmetric(x.clone(), m));
    let (mut t0, mut t1) = (IBig::ZERO, IBig::ONE);
    while (&r1).abs() > *limit {
        let quotient = &r0 / &r1;
        (r0, r1) = (r1.clone(), r0 - &quotient * r1);
        (t0, t1) = (t1.clone(), t0 - quotient * t1);
    }
    if t1 == IBig::ZERO {
        return None;
    }
    if t1 < IBig::ZERO { Some((-r1, -t1)) } else { Some((r1, t1)) }
}

fn satisfies(a: &[Vec<IBig>], r: &[IBig], (numerators, denominator): &(Vec<IBig>, IBig)) -> bool {
    let product =
        |row: &[IBig]| row.iter().zip(numerators).fold(IBig::ZERO, |sum, (a, x)| sum + a * x);
    a.iter().zip(r).all(|(row, r)| product(row) == r * denominator)
}

/// The representative of x mod m with the smallest absolute value.
fn symmetric(x: IBig, m: &IBig) -> IBig {
    let x = x % m;
    let twice = &x + &x;
    if &twice > m {
        x - m
    } else if -twice > *m {
        x + m
    } else {
        x
    }
}

fn inverse(a: &[Vec<IBig>]) -> Option<Vec<Vec<u64>>> {
    let n = a.len();
    let mut m: Vec<Vec<u64>> = a.iter().map(|row| row.iter().map(residue).collect()).collect();
    for (i, row) in m.iter_mut().enumerate() {
        row.extend((0..n).map(|j| u64::from(i == j)));
    }
    for j in 0..n {
        let pivot = (j..n).find(|&i| m[i][j] != 0)?;
        m.swap(j, pivot);
        let inverse = invert(m[j][j]);
        m[j].iter_mut().for_each(|value| *value = mul(*value, inverse));
        let pivot_row = m[j].clone();
        for (i, row) in m.iter_mut().enumerate() {
            if i != j {
                let factor = row[j];
                eliminate(row, &pivot_row, factor, j);
            }
        }
    }
    Some(m.into_iter().map(|row| row[n..].to_vec()).collect())
}

/// row ← row − factor · pivot, from column j on.
fn eliminate(row: &mut [u64], pivot: &[u64], factor: u64, j: usize) {
    if factor != 0 {
        for (value, &pivot) in row[j..].iter_mut().zip(&pivot[j..]) {
            *value = add(*value, P - mul(factor, pivot));
        }
    }
}

fn residue(x: &IBig) -> u64 {
    let r = i64::try_from(x % IBig::from(P)).expect("a remainder below 2⁶¹");
    if r < 0 { (r + P as i64) as u64 } else { r as u64 }
}

fn add(a: u64, b: u64) -> u64 {
    let sum = a + b;
    if sum >= P { sum - P } else { sum }
}

fn mul(a: u64, b: u64) -> u64 {
    let product = u128::from(a) * u128::from(b);
    // 2⁶¹ ≡ 1
    add((product as u64) & P, (product >> 61) as u64)
}

fn invert(a: u64) -> u64 {
    // The inverse by Fermat's little theorem.
    let (mut result, mut base, mut exponent) = (1, a, P - 2);
    while exponent > 0 {
        if exponent & 1 == 1 {
            result = mul(result, base);
        }
        base = mul(base, base);
        exponent >>= 1;
    }
    result
}
