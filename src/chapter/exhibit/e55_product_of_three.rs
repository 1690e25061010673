//! E55: a product of three that standard C++ refuses, Code 11.

use super::{Evidence, Exhibit, Severity};

pub(super) const EXHIBIT: Exhibit = Exhibit {
    id: "E55",
    title: "a product of three that does not compile",
    place: "K&M Code 11",
    severity: Severity::Misprint,
    may_be_scan: false,
    printed: "DMatrixSTL operator*( DMatrixSTL &a, DMatrixSTL &b ), used for J * MInverse * Jt.",
    holds: "The operands must be const references: const DMatrixSTL &a, const DMatrixSTL &b.",
    why: "J * MInverse is a temporary, and standard C++ does not bind a temporary to a reference through which \
          it may be changed. One compiler lets it pass as an extension, which explains the print; others stop \
          with an error. The other operators of the listing have their const.",
    evidence: Evidence::Words(
        "it is a rule of C++ types. Rust lends a temporary to a function that asks for a mutable \
         reference, so the same line compiles.",
    ),
};
