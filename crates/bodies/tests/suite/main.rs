//! Bodies and constraints by themselves, compared with closed forms and difference quotients.

mod body;
mod degenerate;
mod verify;
