//! Every J and J'u against exact derivatives.
//!
//! Along p(t) = p + v t and q(t) = exp(ω t) q with constant v and ω, u' = 0, so c'(0) = J u and
//! c''(0) = J'u. Second-order dual numbers give both without rounding beyond the last digits.

mod degenerate;
mod dual;
mod friction;
