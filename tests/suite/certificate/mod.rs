mod cone;
mod cross_check;
mod error_bound;
mod exact;
mod friction;
mod ray;
mod verdict;
