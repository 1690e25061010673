//! Wrong answers that students give, at least two an exercise, with what the check says.

mod complementarity;
mod drift;
mod evidence;
mod friction;
mod impacts;
mod jacobians;
mod newton;
mod own_constraint;
mod pivoting;
mod sparsity;
mod stack;
mod sweeping;

use lcplab::lesson::exercise::Verdict;

/// The exercise of each mistake, and the check's word.
pub fn all() -> Vec<(&'static str, Verdict)> {
    [
        complementarity::mistakes(),
        jacobians::mistakes(),
        newton::mistakes(),
        sweeping::mistakes(),
        pivoting::mistakes(),
        evidence::mistakes(),
        drift::mistakes(),
        friction::mistakes(),
        impacts::mistakes(),
        sparsity::mistakes(),
        stack::mistakes(),
        own_constraint::mistakes(),
    ]
    .concat()
}
