//! Compensated sums of products, as accurate as if computed in twice the precision.
//!
//! Each product and each sum is split without error into a rounded value and its rounding error
//! (Dekker, Knuth); the errors are summed separately (`Dot2` of Ogita, Rump & Oishi 2005). The
//! result is as accurate as a quadruple-precision sum rounded once.

use super::merit;

/// A running sum Σ a·b with its accumulated rounding errors.
#[derive(Debug, Clone, Copy, Default)]
pub struct Sum {
    value: f64,
    error: f64,
}

impl Sum {
    fn add(&mut self, term: f64) {
        let sum = self.value + term;
        let part = sum - self.value;
        // value + term − sum
        self.error += (self.value - (sum - part)) + (term - part);
        self.value = sum;
    }
}

impl merit::Sum for Sum {
    fn add_product(&mut self, a: f64, b: f64) {
        let product = a * b;
        // a b − product
        self.error += a.mul_add(b, -product);
        self.add(product);
    }

    fn value(&self) -> f64 {
        self.value + self.error
    }
}
