//! Bodies and constraints by themselves, held against closed forms and differences.

mod body;
mod degenerate;
mod verify;
