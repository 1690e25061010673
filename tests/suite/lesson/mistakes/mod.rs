//! Wrong answers that students give, at least two an exercise, with what the check says.

mod lesson01;
mod lesson02;
mod lesson03;
mod lesson04;
mod lesson05;
mod lesson06;
mod lesson07;
mod lesson08;
mod lesson09;
mod lesson10;
mod lesson11;
mod lesson12;

use lcplab::lesson::exercise::Verdict;

/// The exercise of each mistake, and the check's word.
pub fn all() -> Vec<(&'static str, Verdict)> {
    [
        lesson01::mistakes(),
        lesson02::mistakes(),
        lesson03::mistakes(),
        lesson04::mistakes(),
        lesson05::mistakes(),
        lesson06::mistakes(),
        lesson07::mistakes(),
        lesson08::mistakes(),
        lesson09::mistakes(),
        lesson10::mistakes(),
        lesson11::mistakes(),
        lesson12::mistakes(),
    ]
    .concat()
}
