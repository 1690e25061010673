//! The chapter's matrices: the same behavior for every form of storage.

mod impulses;
mod laws;
mod memory;
mod ordering;
mod sweeps;
