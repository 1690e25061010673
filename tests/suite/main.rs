//! The tests, one binary. The modules mirror `src`.

mod architecture;
mod chapter;
mod cli;
mod film;
mod frames;
mod lesson;
mod long_run;
mod messages;
mod own_constraint;
mod report;
mod storage;
mod words;
