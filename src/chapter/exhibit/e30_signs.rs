//! E30: three sign conventions side by side, K&M (10), (15), (23), (34), (44) and Code 7.

use super::common::contacts;
use super::setting::{one, single};
use super::{Finding, Measure};
use crate::chapter::code::code06_solver as code06;
use crate::document::notation::vector;
use crate::error::Result;

/// The sign convention of a contact between a unit mass and the ground.
#[derive(Clone, Copy, PartialEq)]
struct Signs {
    /// J as a multiple of ∂c/∂s.
    jacobian: f64,
    /// b of w = A x + b as a multiple of J u*.
    offset: f64,
    /// The step as a multiple of M⁻¹ Jᵀ x.
    step: f64,
    /// Whether x ≥ 0, else x ≤ 0.
    is_positive: bool,
}

/// The library's convention.
const CORRECTED: Signs = Signs { jacobian: 1.0, offset: 1.0, step: 1.0, is_positive: true };
/// Code 7 with the contact of (42).
const CODE_7: Signs = Signs { offset: -1.0, step: -1.0, ..CORRECTED };
/// The step of Figure 4 with the contact of (42).
const FIGURE_4: Signs = Signs { offset: -1.0, ..CORRECTED };

/// The sources of combinations.
const KNOWN: [(Signs, &str); 6] = [
    (CORRECTED, "(10), (15) with (42); this library"),
    (CODE_7, "Code 7 with (42)"),
    (Signs { is_positive: false, ..CODE_7 }, "Code 7 with (42) and x ≤ 0"),
    (Signs { jacobian: -1.0, ..CODE_7 }, "Code 7 with (44)"),
    (Signs { jacobian: -1.0, ..CORRECTED }, "(10), (15) with (44)"),
    (FIGURE_4, "Figure 4 with (42)"),
];

impl Signs {
    /// All combinations.
    fn all() -> impl Iterator<Item = Signs> {
        (0..16).map(|k| {
            let sign = |bit: u32| if k >> bit & 1 == 0 { 1.0 } else { -1.0 };
            Signs { jacobian: sign(3), offset: sign(2), step: sign(1), is_positive: k & 1 == 0 }
        })
    }

    /// x of the contact of a body that would move at u* (m/s).
    fn x(self, free: f64) -> Result<f64> {
        let bound = if self.is_positive { (Some([0.0]), None) } else { (None, Some([0.0])) };
        let (lo, hi) = (bound.0.as_ref().map(|b| &b[..]), bound.1.as_ref().map(|b| &b[..]));
        let b = single(self.offset * self.jacobian * free);
        Ok(code06::corrected(&one(1.0), &b, lo, hi, 1)?[0])
    }

    /// u⁺ of a body that approaches at 1 m/s, and of one that separates at 1 m/s.
    fn speeds(self) -> Result<[f64; 2]> {
        let after =
            |free: f64| -> Result<f64> { Ok(free + self.step * self.jacobian * self.x(free)?) };
        Ok([after(-1.0)?, after(1.0)?])
    }

    /// A row of the table.
    fn row(self) -> Result<Vec<String>> {
        let sign = |value: f64| if value > 0.0 { "" } else { "−" };
        let speeds = self.speeds()?;
        let origin = KNOWN.iter().find(|(signs, _)| *signs == self).map_or("", |(_, words)| words);
        Ok(vec![
            format!("{}∂c/∂s", sign(self.jacobian)),
            format!("{}J u*", sign(self.offset)),
            format!("u* {} M⁻¹Jᵀx", if self.step > 0.0 { "+" } else { "−" }),
            format!("x {} 0", if self.is_positive { "≥" } else { "≤" }),
            vector(&speeds),
            if speeds == HOLDS { "✓ right".into() } else { "wrong".into() },
            origin.into(),
        ])
    }
}

/// The correct result: the ground stops an approaching body and does not hold a separating one
/// (m/s).
const HOLDS: [f64; 2] = [0.0, 1.0];

/// One contact with all sixteen combinations.
pub(super) fn example() -> Result<Finding> {
    let mut finding = Finding::new(
        "A body of 1 kg touches the ground, once approaching at 1 m/s, once parting at 1 m/s; no forces. \
         The ground stops the first and does not hold the second: u⁺ = 0 and u⁺ = 1. All b are in the sign of \
         w = A x + b, where Code 7's A x = J u* has b = −J u*.",
    );
    let right = CORRECTED.speeds()?;
    let measure = |signs: Signs, words: &str| -> Result<Measure> {
        let measure = Measure::new(words, "m/s", signs.speeds()?, right);
        Ok(measure.truth(&HOLDS, "the ground's law", 0.0))
    };
    let contact_of_44 = Signs { jacobian: -1.0, ..CORRECTED };
    finding = finding
        .measure(measure(CODE_7, "u⁺, Code 7 with (42) and x ≥ 0")?)
        .measure(measure(contact_of_44, "u⁺, (10), (15) with (44)")?)
        .measure(measure(FIGURE_4, "u⁺, Figure 4 with (42) and λ ≥ 0")?)
        .measure(
            measure(Signs { jacobian: -1.0, ..CODE_7 }, "u⁺, Code 7 with (44) and x ≥ 0")?
                .agreeing(),
        );
    for (words, free) in [("approaching: A = 1, b = −1", -1.0), ("parting: A = 1, b = 1", 1.0)] {
        finding = finding.judged(
            words,
            &contacts(&[1.0], &[free])?,
            &[CODE_7.x(free)?],
            &[CORRECTED.x(free)?],
        );
    }
    let columns = ["J", "b", "u⁺", "bound", "u⁺ of −1 and 1", "verdict", "found in"];
    let rows = Signs::all().map(Signs::row).collect::<Result<Vec<_>>>()?;
    Ok(finding.table("All sixteen combinations", &columns, rows))
}
