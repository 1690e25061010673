//! The tests, one module a folder of `src`.

mod page;
mod plot;
