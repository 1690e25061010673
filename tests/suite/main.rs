//! The tests, one binary. The modules mirror `src`.

mod animation;
mod architecture;
mod chapter;
mod cli;
mod documentation;
mod field;
mod frames;
mod lesson;
mod long_run;
mod messages;
mod own_constraint;
mod report;
mod storage;
mod words;
