//! Whether something is more frequent in one sample than in another: Fisher's exact test.

/// The largest probability of taking samples of one population for samples of two.
pub(crate) const CHANCE: f64 = 0.005;

/// A number of frames, and of those among them with some property.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Part {
    pub(crate) with: usize,
    pub(crate) all: usize,
}

impl Part {
    /// Whether chance explains only with [`CHANCE`] that the property is so much more frequent here
    /// than in the other sample: of as many frames with the property in both samples together, at
    /// least as many are here in this part of all ways to divide the frames (R. A. Fisher, 1935).
    pub(crate) fn is_more_frequent_than(self, other: Part) -> bool {
        self.with * other.all > other.with * self.all && self.chance(other) <= CHANCE
    }

    /// The probability of at least this many, if both samples are of one population.
    fn chance(self, other: Part) -> f64 {
        let (with, all) = (self.with + other.with, self.all + other.all);
        let sums = sums_of_logarithms(all);
        let choices = |n: usize, k: usize| sums[n] - sums[k] - sums[n - k];
        let ways = |k: usize| choices(with, k) + choices(all - with, self.all - k);
        let total = choices(all, self.all);
        (self.with..=with.min(self.all)).map(|k| (ways(k) - total).exp()).sum()
    }
}

/// ln k! for k = 0 … n.
fn sums_of_logarithms(n: usize) -> Vec<f64> {
    let mut sum = 0.0;
    let next = |k: usize| {
        sum += (k.max(1) as f64).ln();
        sum
    };
    (0..=n).map(next).collect()
}

#[cfg(test)]
mod tests {
    use super::Part;

    #[test]
    fn the_lady_tasting_tea_has_the_probabilities_of_fishers_book() {
        // 4 and 3 of 4 cups right: 1/70 and 17/70.
        let right = |k: usize| Part { with: k, all: 4 }.chance(Part { with: 4 - k, all: 4 });
        assert!((right(4) - 1.0 / 70.0).abs() < 1e-14);
        assert!((right(3) - 17.0 / 70.0).abs() < 1e-14);
    }

    #[test]
    fn at_least_five_frames_each_are_needed_to_tell_two_samples_apart() {
        let all =
            |n: usize| Part { with: n, all: n }.is_more_frequent_than(Part { with: 0, all: n });
        assert!(!all(4) && all(5)); // 1/70 and 1/252
        // Of 100 frames each, 8 above the largest of the others: C(100, 8) / C(200, 8) = 0.0034.
        let of_100 =
            |k: usize| Part { with: k, all: 100 }.is_more_frequent_than(Part { with: 0, all: 100 });
        assert!(!of_100(7) && of_100(8)); // 0.0070 and 0.0034
    }

    #[test]
    fn what_is_less_frequent_is_not_more_frequent() {
        let few = Part { with: 0, all: 10_000 };
        assert!(!few.is_more_frequent_than(Part { with: 5_000, all: 10_000 }));
        assert!(!few.is_more_frequent_than(few));
    }
}
