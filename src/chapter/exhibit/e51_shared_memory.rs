//! E51: a copy of Code 10's matrix shares its memory.

use super::{Evidence, Exhibit, Severity};

pub(super) const EXHIBIT: Exhibit = Exhibit {
    id: "E51",
    title: "a copied matrix frees its memory twice",
    place: "K&M Code 10",
    severity: Severity::Wrong,
    may_be_scan: false,
    printed: "A class with a raw pointer and a destructor that deletes it; copying is not mentioned.",
    holds: "Copy constructor and assignment must copy the entries, or moves must take them over; or the \
            entries lie in a std::vector, which does both.",
    why: "Without them C++ copies the pointer. Both objects then own the same entries: the first destructor \
          frees them, the second frees them again, and in between one of them reads what is no longer there. \
          Code 7 does this in Q = 0.5f * Q. Built with an address sanitizer that line is reported as use \
          after free; without one the program is aborted.",
    evidence: Evidence::Words(
        "safe Rust has no raw pointer that frees: a Vec is moved or cloned, and the compiler refuses the \
         use of what was moved away. The fault cannot be built, which is the lesson.",
    ),
};
