//! Known solutions of a problem: the key `expected` of its file.

use dashu_int::{IBig, UBig};
use dashu_ratio::RBig;
use serde_json::{Value, json};

use super::Problem;

/// Exact solutions, each as integers over one denominator.
///
/// ```json
/// {"solutions": [{"numerators": ["14", "0", "4", "6"], "denominator": "5"}], "complete": true}
/// ```
///
/// A solution solves the problem *exactly*, with the numbers as written in the file. The integers
/// are written as text because they may have any length.
///
/// ```
/// use lcplab_lcp::file::Expected;
///
/// let expected = Expected::unique(vec![1.into(), 0.into()]);
/// assert!(expected.complete && !expected.is_impossible());
/// let json = expected.json();
/// assert_eq!(json["solutions"][0]["numerators"], serde_json::json!(["1", "0"]));
///
/// assert!(!Expected::one_of_several(vec![1.into(), 0.into()]).complete);
/// let none = Expected { solutions: vec![], complete: true };
/// assert!(none.is_impossible());
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Expected {
    /// The solutions.
    pub solutions: Vec<Vec<RBig>>,
    /// Whether there are no others, apart from segments between the listed solutions and rays from
    /// them. With no listed solution: whether none exists.
    pub complete: bool,
}

impl Expected {
    /// The one solution.
    pub fn unique(x: Vec<RBig>) -> Self {
        Expected { solutions: vec![x], complete: true }
    }

    /// One solution; there may be others.
    pub fn one_of_several(x: Vec<RBig>) -> Self {
        Expected { solutions: vec![x], complete: false }
    }

    /// The expected solutions stored in a problem; `None` if there are none or they have another
    /// form.
    pub fn of(problem: &Problem) -> Option<Self> {
        let expected = problem.extra.get("expected")?;
        let solutions = expected["solutions"].as_array()?.iter().map(solution);
        let complete = expected["complete"].as_bool()?;
        Some(Expected { solutions: solutions.collect::<Option<_>>()?, complete })
    }

    /// Whether it is known that there is no solution.
    pub fn is_impossible(&self) -> bool {
        self.complete && self.solutions.is_empty()
    }

    /// The value of the key.
    pub fn json(&self) -> Value {
        let solutions: Vec<Value> =
            self.solutions.iter().map(|x| over_one_denominator(x)).collect();
        json!({ "solutions": solutions, "complete": self.complete })
    }
}

fn over_one_denominator(x: &[RBig]) -> Value {
    // d/q in lowest terms has the denominator q / gcd(d, q).
    let multiple = |d: UBig, x: &RBig| {
        let part = RBig::from_parts(d.clone().into(), x.denominator().clone());
        d * part.denominator()
    };
    let denominator = x.iter().fold(UBig::ONE, multiple);
    let numerator =
        |x: &RBig| (x.numerator() * IBig::from(&denominator / x.denominator())).to_string();
    let numerators: Vec<String> = x.iter().map(numerator).collect();
    json!({ "numerators": numerators, "denominator": denominator.to_string() })
}

fn solution(value: &Value) -> Option<Vec<RBig>> {
    let denominator: UBig = value["denominator"].as_str()?.parse().ok()?;
    if denominator == UBig::ZERO {
        return None;
    }
    let entry = |numerator: &Value| {
        let numerator: IBig = numerator.as_str()?.parse().ok()?;
        Some(RBig::from_parts(numerator, denominator.clone()))
    };
    value["numerators"].as_array()?.iter().map(entry).collect()
}
