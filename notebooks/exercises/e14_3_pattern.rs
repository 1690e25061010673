//! Exercise 14.3: the pattern of A before its numbers.
//!
//! Each row of J touches two bodies, given by number; None is a fixed one, the ground for example.

/// How many entries of A = J M⁻¹ Jᵀ may differ from zero.
pub fn answer(rows: &[[Option<usize>; 2]]) -> usize {
    todo!()
}
