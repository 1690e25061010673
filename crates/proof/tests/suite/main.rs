//! Proofs, held against closed forms and against a second checker.
