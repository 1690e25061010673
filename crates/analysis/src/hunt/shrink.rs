//! Shrinks a counterexample to the smallest problem that still shows the behavior: fewer rows,
//! simpler bounds, shorter numbers, as in property-based testing.

use std::ops::Range;

use super::numbers::Numbers;

/// Maximum number of rows for which numbers are simplified.
const NUMBERED: usize = 24;

/// Rows to remove: halves, quarters, eighths, and so on, down to single rows.
fn parts(n: usize) -> impl Iterator<Item = Range<usize>> {
    let sizes = (1..).map(move |k| n >> k).take_while(|&size| size > 1).chain([1]);
    sizes
        .filter(move |_| n > 1)
        .flat_map(move |size| (0..n.div_ceil(size)).map(move |k| k * size..((k + 1) * size).min(n)))
}

/// A simplification.
pub(super) enum Simpler {
    /// Remove these rows. The problem is built only when it is tried, because one with a thousand
    /// rows takes 8 MB.
    Without(Range<usize>),
    /// Replace the problem by this one.
    Numbers(Numbers),
}

impl Simpler {
    /// The simpler problem.
    pub fn than(&self, numbers: &Numbers) -> Numbers {
        match self {
            Simpler::Without(rows) => numbers.without(rows.clone()),
            Simpler::Numbers(simpler) => simpler.clone(),
        }
    }
}

impl Numbers {
    /// The possible simplifications of this problem, the largest first.
    pub fn simpler(&self) -> Vec<Simpler> {
        let n = self.len();
        let numbers = if n > NUMBERED { Vec::new() } else { self.plainer() };
        parts(n).map(Simpler::Without).chain(numbers.into_iter().map(Simpler::Numbers)).collect()
    }

    /// The same rows with simpler numbers.
    fn plainer(&self) -> Vec<Numbers> {
        let (n, mut all) = (self.len(), Vec::new());
        if self.friction.is_some() {
            // The friction rows then have no bounds.
            all.push(Numbers { friction: None, ..self.clone() });
        }
        self.simpler_all(&mut all);
        for i in 0..n {
            self.simpler_bounds(i, &mut all);
            for b in simpler(self.b[i]) {
                all.push(self.with(|new| new.b[i] = b));
            }
            if let Some((_, mu)) = &self.friction {
                self.simpler_friction(i, mu[i], &mut all);
            }
        }
        let is_symmetric = self.is_symmetric();
        for (i, j) in (0..n).flat_map(|i| (0..n).map(move |j| (i, j))) {
            if is_symmetric && j > i {
                continue;
            }
            for a in simpler(self.a[i][j]) {
                all.push(self.with(|new| {
                    new.a[i][j] = a;
                    if is_symmetric {
                        new.a[j][i] = a;
                    }
                }));
            }
        }
        all.retain(|new| new.effort() < self.effort());
        all
    }

    /// All of A, or of b, nearer to 1, and with fewer digits.
    fn simpler_all(&self, all: &mut Vec<Numbers>) {
        let largest = |numbers: &mut dyn Iterator<Item = &f64>| {
            numbers.fold(0.0, |most: f64, value| most.max(value.abs()))
        };
        let entries = |change: &dyn Fn(f64) -> f64, numbers: &mut Numbers| {
            numbers.a.iter_mut().flatten().for_each(|value| *value = change(*value));
        };
        let [a, b] = [largest(&mut self.a.iter().flatten()), largest(&mut self.b.iter())];
        for unit in [a, b].map(|size| size.log2().floor().exp2()) {
            if unit.is_normal() && unit != 1.0 {
                all.push(self.with(|new| entries(&|value| value / unit, new)));
                all.push(self.with(|new| new.b.iter_mut().for_each(|value| *value /= unit)));
            }
        }
        for i in 0..self.len() {
            let unit = self.a[i][i].abs().log2().mul_add(0.5, 0.5).floor().exp2();
            if unit.is_normal() && unit != 1.0 {
                all.push(self.with(|new| new.scale(i, 1.0 / unit)));
            }
        }
        for count in [0, 1, 2, 4] {
            all.push(self.with(|new| entries(&|value| rounded(value, count), new)));
        }
    }

    fn with(&self, change: impl Fn(&mut Numbers)) -> Numbers {
        let mut new = self.clone();
        change(&mut new);
        new
    }

    /// Bounds of a contact, of an equation, or shorter ones.
    fn simpler_bounds(&self, i: usize, all: &mut Vec<Numbers>) {
        if self.is_coupled(i) {
            return;
        }
        let (lo, hi) = (self.lo[i], self.hi[i]);
        let mut bounds = vec![(0.0, f64::INFINITY)];
        if !self.bounds_another(i) {
            bounds.push((f64::NEG_INFINITY, f64::INFINITY));
        }
        bounds.extend([(lo, f64::INFINITY), (f64::NEG_INFINITY, hi)]);
        bounds.extend(simpler(lo).into_iter().map(|lo| (lo, hi)));
        bounds.extend(simpler(hi).into_iter().map(|hi| (lo, hi)));
        all.extend(
            bounds.into_iter().map(|(lo, hi)| self.with(|new| (new.lo[i], new.hi[i]) = (lo, hi))),
        );
    }

    /// One μ for all rows of a contact.
    fn simpler_friction(&self, i: usize, mu: f64, all: &mut Vec<Numbers>) {
        all.extend(simpler(mu).into_iter().map(|simple| {
            self.with(|new| {
                if let Some((index, all)) = &mut new.friction {
                    let normal = index[i];
                    let of_contact = |k: &Option<usize>| k.is_some() && *k == normal;
                    for row in 0..index.len() {
                        if row == i || (of_contact(&index[row]) && all[row] == mu) {
                            all[row] = simple;
                        }
                    }
                }
            })
        }));
    }

    /// The complexity for a reader: first the number of rows, then the digits of all numbers.
    pub fn effort(&self) -> (usize, usize) {
        let a = self.a.iter().flatten();
        let mu = self.friction.iter().flat_map(|(index, mu)| {
            // the first tangent of a contact represents all of them
            index.iter().zip(mu).map(|(k, mu)| if k.is_some() { *mu } else { 0.0 })
        });
        let numbers = a.chain(&self.b).copied().chain(mu);
        let bounds = (0..self.len()).map(|i| {
            let contact = self.lo[i] == 0.0 && self.hi[i] == f64::INFINITY;
            if contact { 0 } else { 1 + length(self.lo[i]) + length(self.hi[i]) }
        });
        let friction = usize::from(self.friction.is_some());
        (self.len(), friction + bounds.sum::<usize>() + numbers.map(length).sum::<usize>())
    }
}

/// The number of characters needed to write a number; 0 for 0.
fn length(value: f64) -> usize {
    if value == 0.0 { usize::from(value.is_sign_negative()) } else { format!("{value:?}").len() }
}

/// Shorter numbers, the shortest first.
fn simpler(value: f64) -> Vec<f64> {
    if !value.is_finite() {
        return Vec::new();
    }
    let digits = |count| rounded(value, count);
    let power = value.abs().log2().round().exp2().copysign(value);
    let mut all = vec![0.0, 1.0, -1.0, 2.0, -2.0];
    if value.abs() < 1e15 {
        all.extend([(0.5 * value).trunc(), value.trunc(), value.round()]);
    }
    all.extend([value.abs(), power, digits(0), digits(1), digits(2), digits(4)]);
    all.retain(|new: &f64| new.is_finite() && length(*new) < length(value));
    all.sort_by_key(|new| length(*new));
    all.dedup();
    all
}

/// The number rounded to one digit plus this many more.
fn rounded(value: f64, count: usize) -> f64 {
    format!("{value:.count$e}").parse().unwrap_or(value)
}
