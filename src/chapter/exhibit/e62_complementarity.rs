//! E62: the name of the problem.

use super::{Evidence, Exhibit, Severity};

pub(super) const EXHIBIT: Exhibit = Exhibit {
    id: "E62",
    title: "the name of the problem",
    place: "K&M title and text",
    severity: Severity::Misprint,
    may_be_scan: false,
    printed: "Linear complementary problem; in one place, complementarily.",
    holds: "Linear complementarity problem.",
    why: "The problem is not complementary to anything. It is named for its condition, complementarity: of \
          x_i and w_i one is at its limit, so that they complement each other, pair by pair. Literature and \
          libraries are found under that word.",
    evidence: Evidence::Words("it is a word."),
};
